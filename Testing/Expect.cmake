# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# cmake "-DTEXT=regular expression" -DEXIT=code -P Expect.cmake -- command...
#
# Passes where the command ends with this exit code and its output has the text. CTest's PASS_REGULAR_EXPRESSION asks
# for the text alone, whatever the exit code, also after a crash.
cmake_minimum_required(VERSION 3.22)

set(command)
set(dashes OFF)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach (i RANGE ${last})
  set(argument "${CMAKE_ARGV${i}}")
  if (dashes)
    string(REPLACE ";" "\\;" argument "${argument}")
    list(APPEND command "${argument}")
  elseif (argument STREQUAL "--")
    set(dashes ON)
  endif ()
endforeach ()
execute_process(COMMAND ${command} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output
  ECHO_OUTPUT_VARIABLE ECHO_ERROR_VARIABLE)
if (NOT code STREQUAL EXIT)
  message(FATAL_ERROR "The exit code should be ${EXIT}, and is ${code}")
endif ()
if (NOT output MATCHES "${TEXT}")
  message(FATAL_ERROR "The output should have: ${TEXT}")
endif ()
