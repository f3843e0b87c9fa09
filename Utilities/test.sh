#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/test.sh [-v] [--all] [OPTIONS OF ctest]
#
# Installs missing packages, builds, and runs the tests. You can run it on a fresh clone and again at any time.
#   Utilities/test.sh              all but those of the label Long, which take a third of the time
#   Utilities/test.sh --all        all
#   Utilities/test.sh -L Solver    only those with that label
#   Utilities/test.sh -v           show everything (the same as VERBOSE=1)
# BUILD_DIR=... chooses another build folder than build/.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

take_test_options "$@"
step_count=4
set_up
step "Configuring" configure.log configure release -DSPHERICALSTYLE_BUILD_TESTING=ON
step "Building" build.log cmake --build "$build"
run_tests
