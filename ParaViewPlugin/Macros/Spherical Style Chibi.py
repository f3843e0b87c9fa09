# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
from sphericalstyle import window

window.apply_preset("Chibi")
