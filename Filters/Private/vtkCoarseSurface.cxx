// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCoarseSurface.h"

#include "DisjointSets.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

using SphericalStyle::JoinSets;
using SphericalStyle::Points;
using SphericalStyle::RootOf;
using SphericalStyle::Triangles;

namespace
{
constexpr int None = -1;
constexpr double CellsOfArea = 1.5;  // that a surface meets, of the size of a face, in the mean
constexpr double MostCells = 1000.0; // along the diagonal
constexpr int Attempts = 3;
constexpr double FarOff = 1.5; // from the wanted number of points
constexpr int PartsOfCell = 2; // more in the mean are no sides of walls: no points are shared

/// Which input points become one.
class Clusters
{
public:
  Clusters(const vtkSurfaceMesh& surface)
    : Surface(surface)
    , Corners(surface.GetCorners())
    , Parents(surface.MeshPoint.size())
    , Cells(surface.MeshPoint.size())
  {
  }

  /// @param size  of a cell
  void Merge(const Eigen::RowVector3d& low, double size);
  /// Joins those of this process that are one on another: the border between the two may leave a
  /// cell and come back. To be called by all. @param onBorder  of each mesh point
  void JoinAcross(const std::vector<char>& onBorder);
  int GetNumber() const { return this->Number; }
  /// Of each input point; None where no triangle has it.
  std::vector<int> NumberThem();

private:
  int Root(int i) { return RootOf(this->Parents, i); }
  void Join(int i, int j) { JoinSets(this->Parents, i, j); }
  int CountRoots();
  void JoinCells();

  const vtkSurfaceMesh& Surface;
  const Triangles& Corners;
  std::vector<int> Parents; // None for points of no triangle
  std::vector<std::uint32_t> Cells;
  int Number = 0;
};

void Clusters::Merge(const Eigen::RowVector3d& low, double size)
{
  const Points& P = this->Surface.Mesh.P;
  const auto cells = static_cast<std::uint32_t>(MostCells) + 1;
  std::fill(this->Parents.begin(), this->Parents.end(), None);
  for (Eigen::Index k = 0; k < this->Corners.size(); ++k)
  {
    const int i = this->Corners.data()[k];
    if (this->Parents[i] == None)
    {
      this->Parents[i] = i;
      const Eigen::RowVector3d at = (P.row(this->Surface.MeshPoint[i]) - low) / size;
      std::uint32_t cell = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        cell = cells * cell + static_cast<std::uint32_t>(std::clamp(at(axis), 0.0, MostCells));
      }
      this->Cells[i] = cell;
    }
  }
  for (Eigen::Index f = 0; f < this->Corners.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int i = this->Corners(f, k);
      const int j = this->Corners(f, (k + 1) % 3);
      if (this->Cells[i] == this->Cells[j])
      {
        this->Join(i, j);
      }
    }
  }
  this->Number = this->CountRoots();
  std::unordered_set<std::uint32_t> different;
  for (std::size_t i = 0; i < this->Parents.size(); ++i)
  {
    if (this->Parents[i] == static_cast<int>(i))
    {
      different.insert(this->Cells[i]);
    }
  }
  if (static_cast<std::size_t>(this->Number) > PartsOfCell * different.size())
  {
    this->JoinCells();
    this->Number = this->CountRoots();
  }
}

int Clusters::CountRoots()
{
  int count = 0;
  for (std::size_t i = 0; i < this->Parents.size(); ++i)
  {
    count += this->Parents[i] == static_cast<int>(i) ? 1 : 0;
  }
  return count;
}

void Clusters::JoinCells()
{
  std::unordered_map<std::uint32_t, int> firsts;
  for (std::size_t i = 0; i < this->Parents.size(); ++i)
  {
    if (this->Parents[i] != None)
    {
      this->Join(
        firsts.emplace(this->Cells[i], static_cast<int>(i)).first->second, static_cast<int>(i));
    }
  }
}

void Clusters::JoinAcross(const std::vector<char>& onBorder)
{
  const SphericalStyle::SurfacePart& part = this->Surface.InputPart;
  std::vector<int> points; // on the border
  std::vector<int> numbers;
  for (std::size_t k = 0; k < part.shared.size(); ++k)
  {
    const int i = part.shared[k];
    if (this->Parents[i] != None && onBorder[this->Surface.MeshPoint[i]])
    {
      points.push_back(i);
      numbers.push_back(part.numbers[k]);
    }
  }
  std::unordered_map<int, int> firsts;
  std::vector<double> pairs; // of numbers that are one
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const auto [first, isNew] = firsts.emplace(this->Root(points[k]), numbers[k]);
    if (!isNew)
    {
      pairs.insert(
        pairs.end(), { static_cast<double>(first->second), static_cast<double>(numbers[k]) });
    }
  }
  pairs = part.Concatenate(pairs);
  std::vector<int> parents(part.numberOfShared);
  std::iota(parents.begin(), parents.end(), 0);
  for (std::size_t k = 0; k < pairs.size(); k += 2)
  {
    JoinSets(parents, static_cast<int>(pairs[k]), static_cast<int>(pairs[k + 1]));
  }
  firsts.clear();
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    this->Join(firsts.emplace(RootOf(parents, numbers[k]), points[k]).first->second, points[k]);
  }
  this->Number = this->CountRoots();
}

std::vector<int> Clusters::NumberThem()
{
  std::vector<int> numbers(this->Parents.size(), None);
  int next = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (this->Parents[i] != None)
    {
      const int root = this->Root(static_cast<int>(i)); // never behind i
      numbers[i] = root == static_cast<int>(i) ? next++ : numbers[root];
    }
  }
  return numbers;
}

double AreaOf(const Points& P, const Eigen::RowVector3i& corners)
{
  const Eigen::RowVector3d a = P.row(corners(0));
  const Eigen::RowVector3d b = P.row(corners(1));
  const Eigen::RowVector3d c = P.row(corners(2));
  return 0.5 * (b - a).cross(c - a).norm();
}

/// Of each mesh point, whether triangles of several processes meet there.
std::vector<char> OnBorder(const vtkSurfaceMesh& surface)
{
  Eigen::VectorXd users = Eigen::VectorXd::Zero(surface.Mesh.P.rows()); // processes
  for (Eigen::Index k = 0; k < surface.Mesh.F.size(); ++k)
  {
    users(surface.Mesh.F.data()[k]) = 1.0;
  }
  surface.Part.SumAtShared(users.data(), 1);
  std::vector<char> onBorder(users.size());
  std::transform(users.begin(), users.end(), onBorder.begin(),
    [](double number) { return number > 1.0 ? 1 : 0; });
  return onBorder;
}

/// Which points go before others, so that both sides of a border take the same ones: of each mesh
/// point a number, the same on all processes for points where triangles of several of them meet;
/// then those that several input points are, as along seams; LastRank for all others.
constexpr int LastRank = std::numeric_limits<int>::max();
std::vector<int> Ranks(const vtkSurfaceMesh& surface, const std::vector<char>& onBorder)
{
  constexpr int Met = LastRank - 1;
  std::vector<int> ranks(surface.Mesh.P.rows(), LastRank);
  for (const int i : surface.MeshPoint)
  {
    if (i != vtkSurfaceMesh::NotMoved)
    {
      ranks[i] = ranks[i] == LastRank ? Met : surface.Part.numberOfShared + i;
    }
  }
  std::replace(ranks.begin(), ranks.end(), Met, LastRank);
  for (std::size_t k = 0; k < surface.Part.shared.size(); ++k)
  {
    const int i = surface.Part.shared[k];
    ranks[i] = onBorder[i] ? surface.Part.numbers[k] : ranks[i];
  }
  return ranks;
}

/// An input point for each cluster.
std::vector<vtkIdType> Chosen(const vtkSurfaceMesh& surface, const std::vector<char>& onBorder,
  const std::vector<int>& clusters, int number)
{
  const Points& P = surface.Mesh.P;
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> sums; // with the number of points
  sums.setZero(number, 4);
  for (std::size_t i = 0; i < clusters.size(); ++i)
  {
    if (clusters[i] != None)
    {
      sums.row(clusters[i]) += P.row(surface.MeshPoint[i]).homogeneous();
    }
  }
  const std::vector<int> ranks = Ranks(surface, onBorder);
  std::vector<vtkIdType> chosen(number, None);
  std::vector<std::pair<int, double>> best(number);
  for (std::size_t i = 0; i < clusters.size(); ++i)
  {
    const int c = clusters[i];
    if (c == None)
    {
      continue;
    }
    const int at = surface.MeshPoint[i];
    const std::pair<int, double> rank(
      ranks[at], (P.row(at) - sums.row(c).head<3>() / sums(c, 3)).squaredNorm());
    if (chosen[c] == None || rank < best[c])
    {
      chosen[c] = static_cast<vtkIdType>(i);
      best[c] = rank;
    }
  }
  return chosen;
}

/// A triangle between three clusters, the lowest first, and the first triangle of the mesh there.
struct CoarseTriangle
{
  std::array<int, 3> clusters;
  int triangle;
};

std::vector<CoarseTriangle> TrianglesBetween(
  const Triangles& corners, const std::vector<int>& clusters)
{
  std::vector<CoarseTriangle> found;
  for (Eigen::Index f = 0; f < corners.rows(); ++f)
  {
    std::array<int, 3> c = { clusters[corners(f, 0)], clusters[corners(f, 1)],
      clusters[corners(f, 2)] };
    if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0])
    {
      std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
      found.push_back({ c, static_cast<int>(f) });
    }
  }
  std::stable_sort(found.begin(), found.end(),
    [](const CoarseTriangle& a, const CoarseTriangle& b) { return a.clusters < b.clusters; });
  found.erase(
    std::unique(found.begin(), found.end(),
      [](const CoarseTriangle& a, const CoarseTriangle& b) { return a.clusters == b.clusters; }),
    found.end());
  std::sort(found.begin(), found.end(),
    [](const CoarseTriangle& a, const CoarseTriangle& b) { return a.triangle < b.triangle; });
  return found;
}

/// Triangles at even steps of area, along the clusters, so that they are spread evenly in space.
/// @param probes  of all processes @param area  the same @param before  of those before this one
void TakeProbes(const vtkSurfaceMesh& surface, const std::vector<int>& clusters, int number,
  int probes, double area, double before, SphericalStyle::PreviewPlaces& places)
{
  const Triangles& corners = surface.GetCorners();
  std::vector<int> begin(number + 1, 0);
  for (Eigen::Index f = 0; f < corners.rows(); ++f)
  {
    ++begin[clusters[corners(f, 0)] + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<int> ordered(corners.rows());
  for (Eigen::Index f = 0; f < corners.rows(); ++f)
  {
    ordered[begin[clusters[corners(f, 0)]]++] = static_cast<int>(f);
  }
  places.areaOfProbe = area / probes;
  double next = // from the beginning
    (std::ceil(before / places.areaOfProbe - 0.5) + 0.5) * places.areaOfProbe;
  double sum = before;
  for (const int f : ordered)
  {
    sum += AreaOf(surface.Mesh.P, surface.Mesh.F.row(f));
    for (; next < sum && static_cast<int>(places.probes.size()) < probes;
         next += places.areaOfProbe)
    {
      places.probes.push_back(f);
    }
  }
}

/// @param points  filled with the points of the model, in their order in the result
vtkSmartPointer<vtkPolyData> Extract(vtkPolyData* model, const vtkSurfaceMesh& surface,
  const std::vector<vtkIdType>& chosen, const std::vector<CoarseTriangle>& triangles,
  vtkIdList* points)
{
  std::vector<vtkIdType> newId(chosen.size(), None);
  vtkNew<vtkIdList> cells;
  vtkNew<vtkCellArray> polygons;
  for (const CoarseTriangle& triangle : triangles)
  {
    vtkIdType ids[3];
    for (int k = 0; k < 3; ++k)
    {
      vtkIdType& id = newId[triangle.clusters[k]];
      if (id == None)
      {
        id = points->InsertNextId(chosen[triangle.clusters[k]]);
      }
      ids[k] = id;
    }
    polygons->InsertNextCell(3, ids);
    cells->InsertNextId(surface.GetCell(triangle.triangle));
  }
  auto coarse = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> places;
  if (model->GetPoints()) // where this process has a part
  {
    places->SetDataType(model->GetPoints()->GetDataType());
    model->GetPoints()->GetPoints(points, places);
  }
  coarse->SetPoints(places);
  coarse->SetPolys(polygons);
  const auto copy = [](vtkDataSetAttributes* from, vtkIdList* ids, vtkDataSetAttributes* to)
  {
    to->CopyAllOn();
    to->CopyAllocate(from, ids->GetNumberOfIds());
    to->SetNumberOfTuples(ids->GetNumberOfIds());
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      to->CopyData(from, ids->GetId(i), i);
    }
  };
  copy(model->GetPointData(), points, coarse->GetPointData());
  copy(model->GetCellData(), cells, coarse->GetCellData());
  coarse->SetFieldData(model->GetFieldData());
  return coarse;
}
}

std::shared_ptr<const vtkCoarseSurface> vtkCoarseSurface::Make(
  vtkPolyData* model, const vtkSurfaceMesh& surface, int wanted, int probes, double scale)
{
  const Points& P = surface.Mesh.P;
  const SphericalStyle::SurfacePart& part = surface.Part;
  const Eigen::RowVector3d low = SphericalStyle::BoundsOf(P, part).first;
  double own = 0.0;
  for (Eigen::Index f = 0; f < surface.Mesh.F.rows(); ++f)
  {
    own += AreaOf(P, surface.Mesh.F.row(f));
  }
  const std::vector<double> areas = part.Concatenate({ own });
  const auto here = areas.begin() + (part.IsWhole() ? 0 : part.processes->GetRank());
  const double before = std::accumulate(areas.begin(), here, 0.0);
  const double area = std::accumulate(here, areas.end(), before);
  double size = std::sqrt(CellsOfArea * area / wanted);
  Clusters clusters(surface);
  for (int attempt = 0; attempt < Attempts; ++attempt)
  {
    size = std::max(size, scale / MostCells);
    clusters.Merge(low, size);
    const double share = part.Sum(clusters.GetNumber()) / wanted;
    if (share < FarOff && share > 1.0 / FarOff)
    {
      break;
    }
    size *= std::sqrt(share);
  }
  const std::vector<char> onBorder = OnBorder(surface);
  clusters.JoinAcross(onBorder);
  const std::vector<int> numbers = clusters.NumberThem();
  const int number = clusters.GetNumber();
  vtkNew<vtkIdList> points;
  auto coarse = std::make_shared<vtkCoarseSurface>();
  coarse->Model = Extract(model, surface, Chosen(surface, onBorder, numbers, number),
    TrianglesBetween(surface.GetCorners(), numbers), points);
  // All points: also those whose triangles have come to lie on a line.
  coarse->Surface = vtkSurfaceMeshConversion::FromPolyData(
    coarse->Model, surface.Welded, vtkSurfaceMeshConversion::TakePoints::All, part.processes);
  auto places = std::make_shared<SphericalStyle::PreviewPlaces>();
  for (const vtkIdType i : coarse->Surface.FirstInputPoints())
  {
    places->points.push_back(surface.MeshPoint[points->GetId(i)]);
  }
  if (area > 0.0)
  {
    TakeProbes(surface, numbers, number, probes, area, before, *places);
    places->areaOfProbe /= scale * scale;
  }
  coarse->Places = places;
  return coarse;
}
