// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Meshes to measure with, and the files in which programs hand them to each other.
#ifndef SphericalStyle_BenchmarkMesh_h
#define SphericalStyle_BenchmarkMesh_h

#include "TriangleMesh.h"

#include <string>

namespace Benchmarks
{
/// Two triangulations of one shape, a bumpy body with a head and four limbs, with the same
/// triangles on the same number of points.
enum class Family
{
  Even,   ///< angles of about 20 to 120 degrees, points a little off a regular pattern
  Slivers ///< the same points slid along the surface: half of the triangles are obtuse, the
          ///< thinnest have angles below a tenth of a degree
};

/// @throw std::invalid_argument for another name than "even" and "slivers"
Family FamilyNamed(const std::string& name);

/// Closed, one component, 10 f^2 + 2 points with f chosen to come near the number asked for.
/// Coordinates are those of single precision, as files of models have them.
SphericalStyle::TriangleMesh MakeMesh(Family family, int numberOfPoints);

/// A file is 8 bytes "SSMESH1\n", n and m (64-bit integers), n x 3 doubles and m x 3 32-bit
/// integers, in the order of the machine: quick to read, so that no program's time or memory is
/// that of a reader. @throw std::runtime_error where it cannot be written or read @{
void WriteMesh(const SphericalStyle::TriangleMesh& mesh, const std::string& path);
SphericalStyle::TriangleMesh ReadMesh(const std::string& path);
/// @}
} // namespace Benchmarks

#endif
