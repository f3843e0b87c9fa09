// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Volume meshes for the tests: a unit cube of hexahedra, tetrahedra, wedges or pyramids.
#ifndef SphericalStyle_Volumes_h
#define SphericalStyle_Volumes_h

#include "Meshes.h"
#include "VolumeMesh.h"

namespace Volumes
{
using namespace SphericalStyle;

inline void AddCell(VolumeMesh& mesh, CellShape shape, const std::vector<int>& ids)
{
  mesh.Shapes.push_back(shape);
  mesh.Ids.insert(mesh.Ids.end(), ids.begin(), ids.end());
  mesh.Offsets.push_back(static_cast<int>(mesh.Ids.size()));
}

/// n x n x n cubes, each cut into cells of the shape: 5 tetrahedra, 6 pyramids around a point in
/// its middle, or 2 wedges.
inline VolumeMesh MakeCube(int n, CellShape shape)
{
  VolumeMesh mesh;
  mesh.Offsets.push_back(0);
  std::vector<Eigen::RowVector3d> points;
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        points.emplace_back(1.0 * i / n, 1.0 * j / n, 1.0 * k / n);
      }
    }
  }
  for (int k = 0; k < n; ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        const auto id = [&](int a, int b, int c)
        { return ((k + c) * (n + 1) + j + b) * (n + 1) + i + a; };
        const std::array<int, 8> h = { id(0, 0, 0), id(1, 0, 0), id(1, 1, 0), id(0, 1, 0),
          id(0, 0, 1), id(1, 0, 1), id(1, 1, 1), id(0, 1, 1) };
        switch (shape)
        {
          case CellShape::Hexahedron:
            AddCell(mesh, shape, { h.begin(), h.end() });
            break;
          case CellShape::Wedge:
            AddCell(mesh, shape, { h[0], h[1], h[2], h[4], h[5], h[6] });
            AddCell(mesh, shape, { h[0], h[2], h[3], h[4], h[6], h[7] });
            break;
          case CellShape::Pyramid:
          {
            const auto middle = static_cast<int>(points.size());
            points.push_back(0.5 * (points[h[0]] + points[h[6]]));
            for (const std::array<int, 4>& f : { std::array<int, 4>{ 0, 1, 2, 3 }, { 4, 7, 6, 5 },
                   { 0, 4, 5, 1 }, { 1, 5, 6, 2 }, { 2, 6, 7, 3 }, { 3, 7, 4, 0 } })
            {
              AddCell(mesh, shape, { h[f[0]], h[f[1]], h[f[2]], h[f[3]], middle });
            }
            break;
          }
          case CellShape::Tetrahedron:
            for (const std::array<int, 4>& t : (i + j + k) % 2 == 0
                ? std::array<std::array<int, 4>, 5>{ { { 0, 1, 2, 5 }, { 0, 2, 3, 7 },
                    { 0, 5, 7, 4 }, { 2, 7, 5, 6 }, { 0, 2, 7, 5 } } }
                : std::array<std::array<int, 4>, 5>{ { { 1, 2, 3, 6 }, { 0, 1, 3, 4 },
                    { 1, 6, 4, 5 }, { 3, 4, 6, 7 }, { 1, 3, 4, 6 } } })
            {
              AddCell(mesh, shape, { h[t[0]], h[t[1]], h[t[2]], h[t[3]] });
            }
            break;
        }
      }
    }
  }
  mesh.P.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    mesh.P.row(static_cast<Eigen::Index>(i)) = points[i];
  }
  return mesh;
}

constexpr std::array<CellShape, 4> AllShapes = { CellShape::Tetrahedron, CellShape::Pyramid,
  CellShape::Wedge, CellShape::Hexahedron };
} // namespace Volumes

#endif
