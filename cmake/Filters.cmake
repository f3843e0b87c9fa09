# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Reads the table of filters, Filters/filters.json, into lists. These lists have the names, without "vtk", of the
# filters that are built:
#   sphericalstyle_filters       all filters
#   sphericalstyle_tools         all filters except those for study
#   sphericalstyle_term_filters  filters whose style is a term of the local step
# sphericalstyle_<name>_<key> is an entry of the table: label, page, kind, needs, term, weight. sphericalstyle_terms
# lists all terms, sphericalstyle_pages all pages.
file(READ "${PROJECT_SOURCE_DIR}/Filters/filters.json" table)
set_property(DIRECTORY "${PROJECT_SOURCE_DIR}" APPEND PROPERTY
  CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/Filters/filters.json")
set(sphericalstyle_filters)
set(sphericalstyle_tools)
set(sphericalstyle_term_filters)
set(sphericalstyle_terms)
set(sphericalstyle_pages)
string(JSON last LENGTH "${table}" filters)
math(EXPR last "${last} - 1")
foreach (k RANGE ${last})
  string(JSON name GET "${table}" filters ${k} name)
  foreach (key IN ITEMS label page kind needs term weight)
    string(JSON value ERROR_VARIABLE absent GET "${table}" filters ${k} ${key})
    if (absent)
      set(value)
    endif ()
    set(sphericalstyle_${name}_${key} "${value}")
  endforeach ()
  list(APPEND sphericalstyle_pages ${sphericalstyle_${name}_page})
  if (sphericalstyle_${name}_needs AND NOT SPHERICALSTYLE_WITH_${sphericalstyle_${name}_needs})
    continue ()
  endif ()
  list(APPEND sphericalstyle_filters ${name})
  if (NOT sphericalstyle_${name}_kind STREQUAL "study")
    list(APPEND sphericalstyle_tools ${name})
  endif ()
  if (sphericalstyle_${name}_term)
    list(APPEND sphericalstyle_term_filters ${name})
    list(APPEND sphericalstyle_terms ${sphericalstyle_${name}_term})
  endif ()
endforeach ()
