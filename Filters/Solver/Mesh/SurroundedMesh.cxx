// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurroundedMesh.h"

#include "SharedNumbers.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace SphericalStyle
{
namespace
{
/// Cells of the bounds of all processes, 2^halvings along an axis.
class CoveredCells
{
public:
  static constexpr int FirstHalvings = 3;
  static constexpr int LastHalvings = 17; // 51 bits, which a double holds

  CoveredCells(const TriangleMesh& mesh, const SurfacePart& part)
    : Mesh(mesh)
  {
    const auto [low, high] = BoundsOf(mesh.P, part);
    this->Low = 0.5 * low;
    this->Extent = 0.5 * high - 0.5 * low;
  }

  void SetHalvings(int halvings) { this->Halvings = halvings; }

  double Count(int f) const
  {
    const auto [first, last] = this->RangeOf(f);
    return (last - first + Range::Ones()).cast<double>().prod();
  }

  template <typename Function>
  void Visit(int f, const Function& visit) const
  {
    const auto [first, last] = this->RangeOf(f);
    for (std::int64_t x = first(0); x <= last(0); ++x)
    {
      for (std::int64_t y = first(1); y <= last(1); ++y)
      {
        for (std::int64_t z = first(2); z <= last(2); ++z)
        {
          visit(static_cast<double>((((x << this->Halvings) + y) << this->Halvings) + z));
        }
      }
    }
  }

private:
  using Range = Eigen::Array<std::int64_t, 3, 1>;

  std::int64_t CellOf(double x, int axis) const
  {
    const double extent = this->Extent(axis);
    const auto cells = static_cast<double>(std::int64_t(1) << this->Halvings);
    const double share = extent > 0.0 ? (0.5 * x - this->Low(axis)) / extent * cells : 0.0;
    return static_cast<std::int64_t>(std::clamp(share, 0.0, cells - 1.0));
  }

  std::pair<Range, Range> RangeOf(int f) const
  {
    const Eigen::Matrix3d corners = this->Mesh.P(this->Mesh.F.row(f), AllColumns);
    Range first;
    Range last;
    for (int axis = 0; axis < 3; ++axis)
    {
      first(axis) = this->CellOf(corners.col(axis).minCoeff(), axis);
      last(axis) = this->CellOf(corners.col(axis).maxCoeff(), axis);
    }
    return { first, last };
  }

  const TriangleMesh& Mesh;
  Eigen::RowVector3d Low;
  Eigen::RowVector3d Extent;
  int Halvings = FirstHalvings;
};

/// The triangles in cells that others have triangles in, at all levels.
std::vector<int> TrianglesNearOthers(const TriangleMesh& mesh, const SurfacePart& part)
{
  constexpr double MostCells = 12.0; // a triangle, on the mean: at its own size it is in eight
  CoveredCells cells(mesh, part);
  std::vector<int> near(mesh.F.rows());
  std::iota(near.begin(), near.end(), 0);
  for (int halvings = CoveredCells::FirstHalvings; halvings <= CoveredCells::LastHalvings;
       ++halvings)
  {
    cells.SetHalvings(halvings);
    Eigen::Vector2d sums(0.0, static_cast<double>(near.size()));
    for (const int f : near)
    {
      sums(0) += cells.Count(f);
    }
    part.Sum(sums);
    if (sums(0) > MostCells * sums(1) || sums(1) == 0.0)
    {
      break;
    }
    std::vector<double> own;
    for (const int f : near)
    {
      cells.Visit(f, [&own](double cell) { own.push_back(cell); });
    }
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    const std::vector<double> several = HadBySeveral(own, *part.processes);
    near.erase(std::remove_if(near.begin(), near.end(),
                 [&](int f)
                 {
                   bool found = false;
                   cells.Visit(f,
                     [&](double cell) {
                       found = found || std::binary_search(several.begin(), several.end(), cell);
                     });
                   return !found;
                 }),
      near.end());
  }
  return near;
}

/// A triangle that is sent: its name, the numbers of its points, and their places.
constexpr std::size_t SentTriangle = 13;
}

SurroundedMesh SurroundByOthers(
  const TriangleMesh& mesh, const std::vector<std::int64_t>& names, const SurfacePart& part)
{
  SurroundedMesh result{ mesh, names };
  if (part.IsWhole())
  {
    return result;
  }
  // The same number on all processes for shared points, others for all else.
  const double first = part.numberOfShared + CountBefore(part, static_cast<double>(mesh.P.rows()));
  std::vector<double> numberOf(mesh.P.rows());
  std::iota(numberOf.begin(), numberOf.end(), first);
  std::map<double, int> pointOf;
  for (std::size_t k = 0; k < part.shared.size(); ++k)
  {
    numberOf[part.shared[k]] = part.numbers[k];
    pointOf[part.numbers[k]] = part.shared[k];
  }
  std::vector<double> rows;
  const std::vector<int> near = TrianglesNearOthers(mesh, part);
  for (const int f : near)
  {
    rows.push_back(static_cast<double>(names[f]));
    for (const int i : mesh.F.row(f))
    {
      rows.push_back(numberOf[i]);
    }
    for (const int i : mesh.F.row(f))
    {
      rows.insert(rows.end(), mesh.P.row(i).begin(), mesh.P.row(i).end());
    }
  }
  const auto before = static_cast<std::size_t>(CountBefore(part, static_cast<double>(near.size())));
  rows = part.Concatenate(rows);

  Eigen::AlignedBox3d box;
  for (const int f : near)
  {
    for (const int i : mesh.F.row(f))
    {
      box.extend(mesh.P.row(i).transpose());
    }
  }
  std::vector<double> points(mesh.P.data(), mesh.P.data() + mesh.P.size());
  std::vector<int> corners(mesh.F.data(), mesh.F.data() + mesh.F.size());
  for (std::size_t k = 0; k < rows.size() / SentTriangle; ++k)
  {
    const double* row = rows.data() + k * SentTriangle;
    Eigen::AlignedBox3d around;
    for (int corner = 0; corner < 3; ++corner)
    {
      around.extend(Eigen::Map<const Eigen::Vector3d>(row + 4 + 3 * corner));
    }
    if ((k >= before && k < before + near.size()) || !around.intersects(box))
    {
      continue;
    }
    result.names.push_back(static_cast<std::int64_t>(row[0]));
    for (int corner = 0; corner < 3; ++corner)
    {
      const auto found = pointOf.emplace(row[1 + corner], static_cast<int>(points.size() / 3));
      if (found.second)
      {
        points.insert(points.end(), row + 4 + 3 * corner, row + 7 + 3 * corner);
      }
      corners.push_back(found.first->second);
    }
  }
  result.mesh.P =
    Eigen::Map<Points>(points.data(), static_cast<Eigen::Index>(points.size()) / 3, 3);
  result.mesh.F =
    Eigen::Map<Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size()) / 3, 3);
  return result;
}
} // namespace SphericalStyle
