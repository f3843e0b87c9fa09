# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# cmake -DPREFIX=folder -DMODEL=file -DVERSION=version -DPYTHON_FOLDER=folder -P CommandLine.cmake
#
# The installed program finds the installed package by itself and rounds a model; the manual page is there.
cmake_minimum_required(VERSION 3.22)

set(program "${PREFIX}/bin/sphericalstyle")
set(result "${PREFIX}.ply")
file(REMOVE "${result}")
execute_process(COMMAND "${program}" --version OUTPUT_VARIABLE version COMMAND_ERROR_IS_FATAL ANY)
if (NOT version MATCHES "^sphericalstyle ${VERSION}, VTK ")
  message(FATAL_ERROR "${program} --version says ${version}")
endif ()
execute_process(COMMAND "${program}" "${MODEL}" "${result}" COMMAND_ERROR_IS_FATAL ANY)
if (NOT EXISTS "${result}")
  message(FATAL_ERROR "${result} was not written")
endif ()
file(REMOVE "${result}")
foreach (file IN ITEMS share/man/man1/sphericalstyle.1 ${PYTHON_FOLDER}/sphericalstyle/py.typed
    ${PYTHON_FOLDER}/sphericalstyle/__init__.pyi ${PYTHON_FOLDER}/sphericalstyle/SphericalStyleFilters.pyi)
  if (NOT EXISTS "${PREFIX}/${file}")
    message(FATAL_ERROR "${PREFIX}/${file} was not installed")
  endif ()
endforeach ()
