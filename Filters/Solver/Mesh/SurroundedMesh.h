// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The triangles of this process together with those of others that may touch them.
#ifndef SphericalStyle_SurroundedMesh_h
#define SphericalStyle_SurroundedMesh_h

#include "SurfacePart.h"

#include <cstdint>
#include <vector>

namespace SphericalStyle
{
struct SurroundedMesh
{
  TriangleMesh mesh;               ///< own points and triangles, then those of others
  std::vector<std::int64_t> names; ///< of all triangles
};

/// Finds triangles in cells of a grid that several processes have triangles in, where these are
/// halved again and again until they are about as large as triangles. Only those near other
/// processes are sent.
/// @param mesh  that of this process
/// @param names  of its triangles, others on each process
/// @param part  of its points
SurroundedMesh SurroundByOthers(
  const TriangleMesh& mesh, const std::vector<std::int64_t>& names, const SurfacePart& part);
} // namespace SphericalStyle

#endif
