// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeMesh.h"

#include "Parallel.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace SphericalStyle
{
namespace
{
using Face = std::array<int, 4>; // within the cell; -1 in the place of the fourth of a triangle

const std::vector<Face>& FacesOf(CellShape shape)
{
  static const std::array<std::vector<Face>, 4> faces = {
    std::vector<Face>{ { 0, 1, 2, -1 }, { 0, 1, 3, -1 }, { 1, 2, 3, -1 }, { 0, 2, 3, -1 } },
    std::vector<Face>{
      { 0, 1, 2, 3 }, { 0, 1, 4, -1 }, { 1, 2, 4, -1 }, { 2, 3, 4, -1 }, { 3, 0, 4, -1 } },
    std::vector<Face>{
      { 0, 1, 2, -1 }, { 3, 4, 5, -1 }, { 0, 1, 4, 3 }, { 1, 2, 5, 4 }, { 2, 0, 3, 5 } },
    std::vector<Face>{ { 0, 1, 2, 3 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 },
      { 2, 3, 7, 6 }, { 3, 0, 4, 7 } }
  };
  return faces[static_cast<std::size_t>(shape)];
}

/// Swaps that turn a cell inside out.
const std::vector<std::array<int, 2>>& MirrorOf(CellShape shape)
{
  using Swaps = std::vector<std::array<int, 2>>;
  static const std::array<Swaps, 4> swaps = { Swaps{ { 2, 3 } }, Swaps{ { 1, 3 } },
    Swaps{ { 0, 3 }, { 1, 4 }, { 2, 5 } }, Swaps{ { 0, 4 }, { 1, 5 }, { 2, 6 }, { 3, 7 } } };
  return swaps[static_cast<std::size_t>(shape)];
}

Eigen::Matrix3d EdgesAt(const int* ids, const CellCorner& corner, const Points& P)
{
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k)
  {
    edges.col(k) = (P.row(ids[corner[k + 1]]) - P.row(ids[corner[0]])).transpose();
  }
  return edges;
}

double Scaled(const Eigen::Matrix3d& edges)
{
  const Eigen::RowVector3d lengths = edges.colwise().norm();
  if (!(lengths.minCoeff() > 0.0))
  {
    return 0.0;
  }
  const Eigen::Matrix3d units = edges.array().rowwise() / lengths.array();
  return units.determinant();
}

/// Of a hexahedron: sums of the four edges along each axis.
Eigen::Matrix3d MiddleAxes(const int* ids, const Points& P)
{
  constexpr int far[3][4] = { { 1, 2, 5, 6 }, { 2, 3, 6, 7 }, { 4, 5, 6, 7 } };
  constexpr int near[3][4] = { { 0, 3, 4, 7 }, { 0, 1, 4, 5 }, { 0, 1, 2, 3 } };
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      axes.col(k) += (P.row(ids[far[k][j]]) - P.row(ids[near[k][j]])).transpose();
    }
  }
  return axes;
}
} // namespace

int NumberOfPoints(CellShape shape)
{
  constexpr std::array<int, 4> numbers = { 4, 5, 6, 8 };
  return numbers[static_cast<std::size_t>(shape)];
}

const std::vector<CellCorner>& CornersOf(CellShape shape)
{
  static const std::array<std::vector<CellCorner>, 4> corners = {
    std::vector<CellCorner>{ { 0, 1, 2, 3 }, { 1, 2, 0, 3 }, { 2, 0, 1, 3 }, { 3, 1, 0, 2 } },
    std::vector<CellCorner>{ { 0, 1, 3, 4 }, { 1, 2, 0, 4 }, { 2, 3, 1, 4 }, { 3, 0, 2, 4 } },
    std::vector<CellCorner>{ { 0, 1, 2, 3 }, { 1, 2, 0, 4 }, { 2, 0, 1, 5 }, { 3, 5, 4, 0 },
      { 4, 3, 5, 1 }, { 5, 4, 3, 2 } },
    std::vector<CellCorner>{ { 0, 1, 3, 4 }, { 1, 2, 0, 5 }, { 2, 3, 1, 6 }, { 3, 0, 2, 7 },
      { 4, 7, 5, 0 }, { 5, 4, 6, 1 }, { 6, 5, 7, 2 }, { 7, 6, 4, 3 } }
  };
  return corners[static_cast<std::size_t>(shape)];
}

Eigen::Matrix3d BestCorner(CellShape shape)
{
  Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
  switch (shape)
  {
    case CellShape::Tetrahedron:
      edges.col(1) << 0.5, std::sqrt(0.75), 0.0;
      edges.col(2) << 0.5, std::sqrt(1.0 / 12.0), std::sqrt(2.0 / 3.0);
      break;
    case CellShape::Pyramid:
      edges.col(2) << 0.5, 0.5, std::sqrt(0.5);
      break;
    case CellShape::Wedge:
      edges.col(1) << 0.5, std::sqrt(0.75), 0.0;
      break;
    case CellShape::Hexahedron:
      break;
  }
  return edges;
}

double BestDeterminant(CellShape shape)
{
  return BestCorner(shape).determinant();
}

bool OrientCells(VolumeMesh& mesh)
{
  std::array<double, 4> volumes = {};
  for (int cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    const CellShape shape = mesh.Shapes[cell];
    for (const CellCorner& corner : CornersOf(shape))
    {
      volumes[static_cast<std::size_t>(shape)] +=
        EdgesAt(mesh.PointsOf(cell), corner, mesh.P).determinant();
    }
  }
  bool any = false;
  for (int cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    const CellShape shape = mesh.Shapes[cell];
    if (volumes[static_cast<std::size_t>(shape)] < 0.0)
    {
      any = true;
      int* ids = &mesh.Ids[mesh.Offsets[cell]];
      for (const auto& [a, b] : MirrorOf(shape))
      {
        std::swap(ids[a], ids[b]);
      }
    }
  }
  return any;
}

double ScaledJacobian(const VolumeMesh& mesh, int cell, const Points& P)
{
  const CellShape shape = mesh.Shapes[cell];
  const int* ids = mesh.PointsOf(cell);
  double smallest =
    shape == CellShape::Hexahedron ? Scaled(MiddleAxes(ids, P)) : BestDeterminant(shape);
  for (const CellCorner& corner : CornersOf(shape))
  {
    smallest = std::min(smallest, Scaled(EdgesAt(ids, corner, P)));
  }
  return smallest / BestDeterminant(shape);
}

Eigen::VectorXd ScaledJacobians(const VolumeMesh& mesh, const Points& P, int threads)
{
  Eigen::VectorXd all(mesh.GetNumberOfCells());
  ParallelFor(mesh.GetNumberOfCells(), threads,
    [&](int begin, int end)
    {
      for (int cell = begin; cell < end; ++cell)
      {
        all[cell] = ScaledJacobian(mesh, cell, P);
      }
    });
  return all;
}

std::vector<char> BoundaryPoints(const VolumeMesh& mesh)
{
  // A face by its points, in order; a face with a point twice is a triangle, as in a hexahedron
  // that is a wedge.
  std::vector<Face> faces;
  for (int cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    const int* ids = mesh.PointsOf(cell);
    for (const Face& local : FacesOf(mesh.Shapes[cell]))
    {
      Face face = { -1, -1, -1, -1 };
      std::transform(local.begin(), local.end(), face.begin(),
        [ids](int corner) { return corner < 0 ? -1 : ids[corner]; });
      std::sort(face.begin(), face.end(), std::greater<>());
      std::fill(std::unique(face.begin(), face.end()), face.end(), -1);
      if (face[2] >= 0)
      {
        faces.push_back(face);
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  std::vector<char> flags(mesh.P.rows(), 0);
  for (std::size_t k = 0; k < faces.size();)
  {
    std::size_t end = k + 1;
    while (end < faces.size() && faces[end] == faces[k])
    {
      ++end;
    }
    for (const int i : faces[k])
    {
      if (end == k + 1 && i >= 0)
      {
        flags[i] = 1;
      }
    }
    k = end;
  }
  return flags;
}

std::vector<char> UsedPoints(const VolumeMesh& mesh)
{
  std::vector<char> flags(mesh.P.rows(), 0);
  for (const int i : mesh.Ids)
  {
    flags[i] = 1;
  }
  return flags;
}
} // namespace SphericalStyle
