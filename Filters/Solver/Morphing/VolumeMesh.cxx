// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeMesh.h"

#include "Parallel.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>

namespace SphericalStyle
{
namespace
{
/// Points, in a direction that is the same for all faces of a cell, seen from outside; -1 in the
/// place of the fourth of a triangle.
using Face = std::array<int, 4>;

/// Within the cell.
const std::vector<Face>& FacesOf(CellShape shape)
{
  static const std::array<std::vector<Face>, 4> faces = {
    std::vector<Face>{ { 0, 2, 1, -1 }, { 0, 1, 3, -1 }, { 1, 2, 3, -1 }, { 0, 3, 2, -1 } },
    std::vector<Face>{
      { 0, 3, 2, 1 }, { 0, 1, 4, -1 }, { 1, 2, 4, -1 }, { 2, 3, 4, -1 }, { 3, 0, 4, -1 } },
    std::vector<Face>{
      { 0, 2, 1, -1 }, { 3, 4, 5, -1 }, { 0, 1, 4, 3 }, { 1, 2, 5, 4 }, { 2, 0, 3, 5 } },
    std::vector<Face>{ { 0, 3, 2, 1 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 },
      { 2, 3, 7, 6 }, { 3, 0, 4, 7 } }
  };
  return faces[static_cast<std::size_t>(shape)];
}

struct CellFace
{
  Face Points; ///< descending, each once; faces of the same points are the same
  int Cell;
  bool Forward; ///< direction: whether the smaller neighbor of the smallest point is after it
};

bool operator<(const CellFace& a, const CellFace& b)
{
  return std::tie(a.Points, a.Cell) < std::tie(b.Points, b.Cell);
}

/// Of all cells, sorted. A face with a point twice is a triangle, as in a hexahedron that is a
/// wedge; those with fewer points are none.
std::vector<CellFace> AllFaces(const VolumeMesh& mesh)
{
  std::vector<CellFace> faces;
  for (int cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    const int* ids = mesh.PointsOf(cell);
    for (const Face& local : FacesOf(mesh.Shapes[cell]))
    {
      Face loop = { -1, -1, -1, -1 };
      int count = 0;
      for (const int corner : local)
      {
        if (corner >= 0 && (count == 0 || ids[corner] != loop[count - 1]))
        {
          loop[count++] = ids[corner];
        }
      }
      count -= count > 1 && loop[count - 1] == loop[0] ? 1 : 0;
      std::fill(loop.begin() + count, loop.end(), -1);
      if (count < 3)
      {
        continue;
      }
      const auto first =
        static_cast<int>(std::min_element(loop.begin(), loop.begin() + count) - loop.begin());
      const bool forward = loop[(first + 1) % count] < loop[(first + count - 1) % count];
      std::sort(loop.begin(), loop.end(), std::greater<>());
      std::fill(std::unique(loop.begin(), loop.end()), loop.end(), -1);
      if (loop[2] >= 0)
      {
        faces.push_back({ loop, cell, forward });
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// Calls function(begin, end) for the faces that are the same.
template <typename Function>
void ForSame(const std::vector<CellFace>& faces, const Function& function)
{
  for (std::size_t k = 0; k < faces.size();)
  {
    std::size_t end = k + 1;
    while (end < faces.size() && faces[end].Points == faces[k].Points)
    {
      ++end;
    }
    function(k, end);
    k = end;
  }
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

void Mirror(VolumeMesh& mesh, int cell)
{
  int* ids = &mesh.Ids[mesh.Offsets[cell]];
  for (const auto& [a, b] : MirrorOf(mesh.Shapes[cell]))
  {
    std::swap(ids[a], ids[b]);
  }
}

struct Neighbor
{
  int Cell;
  int Turn; ///< 1, or -1 where both pass their face in the same direction
};

/// Of each cell, those that have a face with it and with no other cell.
std::vector<std::vector<Neighbor>> NeighborsOf(const VolumeMesh& mesh)
{
  std::vector<std::vector<Neighbor>> neighbors(mesh.GetNumberOfCells());
  const std::vector<CellFace> faces = AllFaces(mesh);
  ForSame(faces,
    [&](std::size_t begin, std::size_t end)
    {
      const CellFace& a = faces[begin];
      const CellFace& b = faces[end - 1];
      if (end == begin + 2)
      {
        const int turn = a.Forward != b.Forward ? 1 : -1;
        neighbors[a.Cell].push_back({ b.Cell, turn });
        neighbors[b.Cell].push_back({ a.Cell, turn });
      }
    });
  return neighbors;
}

/// Sets the turns, 1 or -1, that make the cells agree that hang together with the first one.
/// @param turns  0 for cells that have none yet @return these cells
std::vector<int> Agree(
  const std::vector<std::vector<Neighbor>>& neighbors, int first, std::vector<int>& turns)
{
  std::vector<int> cells = { first };
  turns[first] = 1;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const int cell = cells[k];
    for (const Neighbor& neighbor : neighbors[cell])
    {
      if (turns[neighbor.Cell] == 0)
      {
        turns[neighbor.Cell] = turns[cell] * neighbor.Turn;
        cells.push_back(neighbor.Cell);
      }
    }
  }
  return cells;
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
  const int count = mesh.GetNumberOfCells();
  std::vector<double> volumes(count, 0.0); // some multiple of it
  for (int cell = 0; cell < count; ++cell)
  {
    for (const CellCorner& corner : CornersOf(mesh.Shapes[cell]))
    {
      volumes[cell] += EdgesAt(mesh.PointsOf(cell), corner, mesh.P).determinant();
    }
  }
  if (std::none_of(volumes.begin(), volumes.end(), [](double volume) { return volume < 0.0; }))
  {
    return false;
  }
  const std::vector<std::vector<Neighbor>> neighbors = NeighborsOf(mesh);
  std::vector<int> turns(count, 0); // 1 or, against the first cell that it hangs together with, -1
  bool any = false;
  for (int first = 0; first < count; ++first)
  {
    if (turns[first] != 0)
    {
      continue;
    }
    const std::vector<int> cells = Agree(neighbors, first, turns);
    const double volume = std::accumulate(cells.begin(), cells.end(), 0.0,
      [&](double sum, int cell) { return sum + turns[cell] * volumes[cell]; });
    for (const int cell : cells)
    {
      if ((turns[cell] < 0) != (volume < 0.0))
      {
        any = true;
        Mirror(mesh, cell);
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
  const std::vector<CellFace> faces = AllFaces(mesh);
  std::vector<char> flags(mesh.P.rows(), 0);
  ForSame(faces,
    [&](std::size_t begin, std::size_t end)
    {
      for (const int i : faces[begin].Points)
      {
        if (end == begin + 1 && i >= 0)
        {
          flags[i] = 1;
        }
      }
    });
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
