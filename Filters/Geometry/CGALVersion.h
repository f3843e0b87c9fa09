// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// We support CGAL 5.5, 6.0 and 6.2. Included by source files of this folder only, before what
/// differs.
#ifndef SphericalStyle_CGALVersion_h
#define SphericalStyle_CGALVersion_h

#include <CGAL/version.h>

/// Whether boxes and triangles have the suffix _3, and iterators for the output are named
/// parameters.
#define SPHERICALSTYLE_CGAL_6 (CGAL_VERSION_NR >= 1060000000)

/// Whether the functions for borders belong to the namespace CGAL. Their old header makes calls in
/// CGAL's own headers ambiguous.
#define SPHERICALSTYLE_CGAL_6_2 (CGAL_VERSION_NR >= 1060200000)

#endif
