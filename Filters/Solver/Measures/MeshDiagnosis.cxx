// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshDiagnosis.h"

#include "EdgeWeights.h"
#include "MeshQuality.h"
#include "MeshTopology.h"
#include "SurfaceMeasures.h"
#include "TriangleTree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>

namespace SphericalStyle
{
namespace
{
/// A closed component with a volume below this times its area to the 3/2 is flat and has no inside.
constexpr double FlatVolume = 1e-12;

/// Which of a number of things hang together.
class Groups
{
public:
  explicit Groups(std::size_t size)
    : Parent(size)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
  }
  int Root(int i)
  {
    while (this->Parent[i] != i)
    {
      this->Parent[i] = this->Parent[this->Parent[i]];
      i = this->Parent[i];
    }
    return i;
  }
  void Join(int i, int j)
  {
    i = this->Root(i);
    j = this->Root(j);
    this->Parent[std::max(i, j)] = std::min(i, j);
  }

private:
  std::vector<int> Parent;
};

/// The first point at the place of each point; points that are not finite stay alone.
std::vector<int> FirstAtPlace(const Points& P)
{
  std::vector<int> first(P.rows());
  std::iota(first.begin(), first.end(), 0);
  std::vector<int> order;
  for (const int i : first)
  {
    if (P.row(i).allFinite())
    {
      order.push_back(i);
    }
  }
  const auto place = [&P](int i) { return std::make_tuple(P(i, 0), P(i, 1), P(i, 2)); };
  std::sort(order.begin(), order.end(),
    [&place](int i, int j)
    {
      return std::tuple_cat(place(i), std::make_tuple(i)) <
        std::tuple_cat(place(j), std::make_tuple(j));
    });
  for (std::size_t k = 1; k < order.size(); ++k)
  {
    if (place(order[k]) == place(order[k - 1]))
    {
      first[order[k]] = first[order[k - 1]];
    }
  }
  return first;
}

/// One component for what is asked of its inside.
struct Part
{
  bool closed = true;
  double volume = 0.0;
  double area = 0.0;
  int point = -1; ///< one of it, that volumes are measured from
  Eigen::AlignedBox3d bounds;
  std::vector<int> triangles;
};

/// Of a line from a to b seen from p, along z: positive where p lies to its left. Where p lies on
/// it, as if p were moved a little along x, and much less along y. The other way round the sign is
/// the other one, so that of two triangles at an edge exactly one has p.
int SideOf(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const Eigen::RowVector3d& p)
{
  const auto signOf = [](double x) { return x > 0.0 ? 1 : x < 0.0 ? -1 : 0; };
  const double area = (a.x() - p.x()) * (b.y() - p.y()) - (a.y() - p.y()) * (b.x() - p.x());
  if (area != 0.0)
  {
    return signOf(area);
  }
  return a.y() != b.y() ? signOf(a.y() - b.y()) : signOf(b.x() - a.x());
}

/// +1 where a ray from p along z leaves what the triangle bounds, -1 where it enters, 0 where it
/// does not meet the triangle.
int CrossingOf(const TriangleMesh& mesh, int f, const Eigen::RowVector3d& p)
{
  const Eigen::RowVector3d a = mesh.P.row(mesh.F(f, 0));
  const Eigen::RowVector3d b = mesh.P.row(mesh.F(f, 1));
  const Eigen::RowVector3d c = mesh.P.row(mesh.F(f, 2));
  const int side = SideOf(a, b, p);
  if (side == 0 || SideOf(b, c, p) != side || SideOf(c, a, p) != side)
  {
    return 0;
  }
  return side * TripleProduct(mesh.P, mesh.F, f, p) > 0.0 ? side : 0;
}

/// How often closed surfaces go around a point: the crossings of a ray.
/// @param counts  whether a triangle does
template <typename Counts>
int WindingNumber(
  const TriangleTree& tree, const TriangleMesh& mesh, int point, const Counts& counts)
{
  const Eigen::RowVector3d p = mesh.P.row(point);
  int number = 0;
  std::vector<TriangleTree::Node> nodes = { tree.GetRoot() };
  while (!nodes.empty())
  {
    const TriangleTree::Node node = nodes.back();
    nodes.pop_back();
    const Eigen::AlignedBox3d& box = tree.GetBox(node);
    if (p.x() < box.min().x() || p.x() > box.max().x() || p.y() < box.min().y() ||
      p.y() > box.max().y() || p.z() > box.max().z())
    {
      continue;
    }
    if (!TriangleTree::IsLeaf(node))
    {
      nodes.push_back(tree.GetRight(node));
      nodes.push_back(tree.GetLeft(node));
      continue;
    }
    for (const int* f = tree.Begin(node); f != tree.End(node); ++f)
    {
      number += counts(*f) ? CrossingOf(mesh, *f, p) : 0;
    }
  }
  return number;
}

/// One diagnosis. Triangles of `Mesh` are the usable ones, around the origin at size 1, so that
/// neither angles nor volumes overflow.
class Examination
{
public:
  Examination(const Points& P, const Triangles& F, const DiagnosisOptions& options)
    : P(P)
    , F(F)
    , Options(options)
  {
    this->D.pointMarks.assign(P.rows(), 0);
    this->D.triangleMarks.assign(F.rows(), 0);
    this->D.components.assign(F.rows(), -1);
  }

  MeshDiagnosis Run()
  {
    this->ExaminePoints();
    this->TakeUsable();
    if (!this->Given.empty())
    {
      this->Normalize();
      const MeshEdges edges(this->Mesh.F);
      const MeshTopology topology(this->Mesh.F, static_cast<int>(this->Mesh.P.rows()));
      this->ExamineTriangles();
      this->ExamineEdges(edges);
      this->ExamineFans(edges);
      this->ExamineBorders(edges);
      this->ExamineParts(edges, topology);
    }
    this->SpreadPointMarks();
    this->FindFirst();
    return std::move(this->D);
  }

private:
  int& CountOf(Defect defect) { return this->D.findings[static_cast<std::size_t>(defect)].count; }
  void MarkGiven(Defect defect, std::vector<unsigned>& marks, std::size_t i)
  {
    marks[i] |= Bit(defect);
    ++this->CountOf(defect);
  }
  void MarkTriangle(Defect defect, int f) { this->D.triangleMarks[this->Given[f]] |= Bit(defect); }
  void CountTriangle(Defect defect, int f)
  {
    this->MarkTriangle(defect, f);
    ++this->CountOf(defect);
  }
  int EndOf(int h, int side) const { return this->Mesh.F(h / 3, (h % 3 + 1 + side) % 3); }

  void ExaminePoints()
  {
    this->Place = FirstAtPlace(this->P);
    for (std::size_t i = 0; i < this->Place.size(); ++i)
    {
      if (!this->P.row(static_cast<Eigen::Index>(i)).allFinite())
      {
        this->MarkGiven(Defect::NonFinitePoints, this->D.pointMarks, i);
      }
      if (this->Place[i] != static_cast<int>(i))
      {
        this->MarkGiven(Defect::CoincidentPoints, this->D.pointMarks, i);
      }
    }
    if (!this->Options.weld)
    {
      std::iota(this->Place.begin(), this->Place.end(), 0);
    }
  }

  bool IsUsable(const Eigen::RowVector3i& t, Eigen::Index f)
  {
    for (int k = 0; k < 3; ++k)
    {
      if (!this->P.row(t(k)).allFinite())
      {
        return false;
      }
    }
    if (t(0) == t(1) || t(1) == t(2) || t(2) == t(0) ||
      IsDegenerate(this->P.row(t(0)), this->P.row(t(1)), this->P.row(t(2))))
    {
      this->MarkGiven(
        Defect::DegenerateTriangles, this->D.triangleMarks, static_cast<std::size_t>(f));
      return false;
    }
    return true;
  }

  void TakeUsable()
  {
    std::vector<Eigen::RowVector3i> usable;
    this->Number.assign(this->P.rows(), -1);
    for (Eigen::Index f = 0; f < this->F.rows(); ++f)
    {
      Eigen::RowVector3i t;
      for (int k = 0; k < 3; ++k)
      {
        const int i = this->F(f, k);
        if (i < 0 || i >= this->P.rows())
        {
          throw std::invalid_argument(
            "triangle " + std::to_string(f) + " names a point outside the mesh");
        }
        t(k) = this->Place[i];
      }
      if (this->IsUsable(t, f))
      {
        usable.push_back(t);
        this->Given.push_back(static_cast<int>(f));
        this->Number[t(0)] = this->Number[t(1)] = this->Number[t(2)] = 0;
      }
    }
    int count = 0;
    for (int& number : this->Number)
    {
      number = number == 0 ? count++ : number;
    }
    this->Mesh.P.resize(count, 3);
    for (std::size_t i = 0; i < this->Number.size(); ++i)
    {
      if (this->Number[i] >= 0)
      {
        this->Mesh.P.row(this->Number[i]) = this->P.row(static_cast<Eigen::Index>(i));
      }
    }
    this->Mesh.F.resize(static_cast<Eigen::Index>(usable.size()), 3);
    for (std::size_t f = 0; f < usable.size(); ++f)
    {
      this->Mesh.F.row(static_cast<Eigen::Index>(f)) =
        usable[f].unaryExpr([this](int i) { return this->Number[i]; });
    }
    this->MeshMarks.assign(count, 0);
    this->D.points = count;
    this->D.usableTriangles = static_cast<int>(usable.size());
  }

  void Normalize()
  {
    const Eigen::RowVector3d low = this->Mesh.P.colwise().minCoeff();
    const Eigen::RowVector3d high = this->Mesh.P.colwise().maxCoeff();
    this->D.largest = this->Mesh.P.cwiseAbs().maxCoeff();
    const Eigen::RowVector3d half = 0.5 * high - 0.5 * low; // finite, however far apart
    this->D.diagonal = 2.0 * half.stableNorm();
    this->Mesh.P.rowwise() -= 0.5 * low + 0.5 * high;
    this->Mesh.P /= half.maxCoeff();
  }

  void ExamineTriangles()
  {
    const Eigen::MatrixX2d angles = ExtremeAngles(this->Mesh.P, this->Mesh.F);
    std::vector<std::array<int, 4>> corners; // ascending, and the triangle
    for (int f = 0; f < this->Mesh.F.rows(); ++f)
    {
      if (angles(f, 0) < this->Options.sliverAngle)
      {
        this->CountTriangle(Defect::Slivers, f);
      }
      if (std::cos(angles(f, 1) * Pi / 180.0) < -RightAngle)
      {
        this->CountTriangle(Defect::ObtuseTriangles, f);
      }
      corners.push_back({ this->Mesh.F(f, 0), this->Mesh.F(f, 1), this->Mesh.F(f, 2), f });
      std::sort(corners.back().begin(), corners.back().begin() + 3);
    }
    std::sort(corners.begin(), corners.end());
    for (std::size_t k = 1; k < corners.size(); ++k)
    {
      if (std::equal(corners[k].begin(), corners[k].begin() + 3, corners[k - 1].begin()))
      {
        this->CountTriangle(Defect::DuplicateTriangles, corners[k][3]);
      }
    }
  }

  void ExamineEdges(const MeshEdges& edges)
  {
    const HalfEdgeScalars c = HalfEdgeCotangents(this->Mesh.P, this->Mesh.F);
    this->D.edges = edges.GetNumberOfEdges();
    for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
    {
      const int valence = edges.GetValence(e);
      const std::pair<Defect, bool> cases[] = { { Defect::NonManifoldEdges, valence > 2 },
        { Defect::BorderEdges, valence == 1 },
        { Defect::MisorientedEdges, valence == 2 && EdgeBalance(this->Mesh.F, edges, e) != 0 },
        { Defect::NegativeWeights, EdgeSum(c, edges, e) < -RightAngle } };
      for (const auto& [defect, found] : cases)
      {
        if (found)
        {
          this->CountEdge(defect, edges, e);
        }
      }
    }
  }

  void CountEdge(Defect defect, const MeshEdges& edges, int e)
  {
    ++this->CountOf(defect);
    for (int i = edges.GetOffset()[e]; i < edges.GetOffset()[e + 1]; ++i)
    {
      const int h = edges.GetHalfEdges()[i];
      this->MarkTriangle(defect, h / 3);
      this->MeshMarks[this->EndOf(h, 0)] |= Bit(defect);
      this->MeshMarks[this->EndOf(h, 1)] |= Bit(defect);
    }
  }

  /// Points with more than one group of triangles that hang together by edges at the point.
  void ExamineFans(const MeshEdges& edges)
  {
    Groups corners(this->Mesh.F.size()); // 3 * triangle + k
    const auto cornerAt = [this](int h, int point)
    { return 3 * (h / 3) + (h % 3 + (this->EndOf(h, 0) == point ? 1 : 2)) % 3; };
    for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
    {
      const int first = edges.GetHalfEdges()[edges.GetOffset()[e]];
      for (int i = edges.GetOffset()[e] + 1; i < edges.GetOffset()[e + 1]; ++i)
      {
        for (const int point : { this->EndOf(first, 0), this->EndOf(first, 1) })
        {
          corners.Join(cornerAt(first, point), cornerAt(edges.GetHalfEdges()[i], point));
        }
      }
    }
    std::vector<int> fans(this->Mesh.P.rows(), 0);
    for (int corner = 0; corner < static_cast<int>(this->Mesh.F.size()); ++corner)
    {
      int& at = fans[this->Mesh.F.data()[corner]];
      at += corners.Root(corner) == corner;
      if (at > 1)
      {
        this->MeshMarks[this->Mesh.F.data()[corner]] |= Bit(Defect::NonManifoldPoints);
      }
    }
  }

  void ExamineBorders(const MeshEdges& edges)
  {
    Groups points(this->Mesh.P.rows());
    for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
    {
      const int h = edges.GetHalfEdges()[edges.GetOffset()[e]];
      if (edges.GetValence(e) == 1)
      {
        points.Join(this->EndOf(h, 0), this->EndOf(h, 1));
      }
    }
    for (int i = 0; i < this->Mesh.P.rows(); ++i)
    {
      if ((this->MeshMarks[i] & Bit(Defect::BorderEdges)) != 0 && points.Root(i) == i)
      {
        this->FirstLoop = this->D.borderLoops.count++ == 0 ? i : this->FirstLoop;
      }
    }
  }

  std::vector<Part> MakeParts(const MeshEdges& edges, const MeshTopology& topology) const
  {
    const Points& x = this->Mesh.P;
    std::vector<Part> parts(topology.GetNumberOfComponents());
    for (int f = 0; f < this->Mesh.F.rows(); ++f)
    {
      Part& part = parts[topology.GetComponents()[this->Mesh.F(f, 0)]];
      part.point = part.triangles.empty() ? this->Mesh.F(f, 0) : part.point;
      part.triangles.push_back(f);
      const Eigen::Vector3d a = x.row(this->Mesh.F(f, 0));
      const Eigen::Vector3d b = x.row(this->Mesh.F(f, 1));
      const Eigen::Vector3d c = x.row(this->Mesh.F(f, 2));
      part.volume += TripleProduct(x, this->Mesh.F, f, x.row(part.point)) / 6.0;
      part.area += 0.5 * (b - a).cross(c - a).norm();
      part.bounds.extend(a).extend(b).extend(c);
    }
    for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
    {
      if (EdgeBalance(this->Mesh.F, edges, e) != 0)
      {
        const int h = edges.GetHalfEdges()[edges.GetOffset()[e]];
        parts[topology.GetComponents()[this->EndOf(h, 0)]].closed = false;
      }
    }
    return parts;
  }

  void ExamineParts(const MeshEdges& edges, const MeshTopology& topology)
  {
    const std::vector<Part> parts = this->MakeParts(edges, topology);
    std::optional<TriangleTree> tree; // of all triangles, where it is needed
    // Whether the closed parts but one go around its point: then that one is a cavity.
    const auto isCavity = [&](const Part& part)
    {
      if (!tree)
      {
        tree.emplace(this->Mesh.P, this->Mesh.F);
      }
      return WindingNumber(*tree, this->Mesh, part.point,
               [&](int f)
               {
                 const Part& other = parts[topology.GetComponents()[this->Mesh.F(f, 0)]];
                 return &other != &part && other.closed && other.bounds.contains(part.bounds);
               }) > 0;
    };
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
      const Part& part = parts[k];
      const bool insideOut = part.closed &&
        part.volume < -FlatVolume * part.area * std::sqrt(part.area) && !isCavity(part);
      this->CountOf(Defect::InsideOutComponents) += insideOut;
      for (const int f : part.triangles)
      {
        this->D.components[this->Given[f]] = static_cast<int>(k);
        if (insideOut)
        {
          this->MarkTriangle(Defect::InsideOutComponents, f);
        }
      }
    }
    this->D.parts.count = static_cast<int>(parts.size());
    const auto second = std::find(this->D.components.begin(), this->D.components.end(), 1);
    this->D.parts.first = second == this->D.components.end()
      ? -1
      : static_cast<int>(second - this->D.components.begin());
  }

  /// From the places to all points there.
  void SpreadPointMarks()
  {
    for (std::size_t i = 0; i < this->Place.size(); ++i)
    {
      const int at = this->Number[this->Place[i]];
      if (at >= 0)
      {
        this->D.pointMarks[i] |= this->MeshMarks[at];
        this->D.borderLoops.first = at == this->FirstLoop && this->D.borderLoops.first < 0
          ? static_cast<int>(i)
          : this->D.borderLoops.first;
      }
      else if ((this->D.pointMarks[i] & Bit(Defect::NonFinitePoints)) == 0)
      {
        this->MarkGiven(Defect::UnusedPoints, this->D.pointMarks, i);
      }
    }
    this->CountOf(Defect::NonManifoldPoints) =
      static_cast<int>(std::count_if(this->MeshMarks.begin(), this->MeshMarks.end(),
        [](unsigned marks) { return (marks & Bit(Defect::NonManifoldPoints)) != 0; }));
  }

  void FindFirst()
  {
    for (int k = 0; k < NumberOfDefects; ++k)
    {
      const auto defect = static_cast<Defect>(k);
      const auto& marks = IsOfPoints(defect) ? this->D.pointMarks : this->D.triangleMarks;
      const auto found = std::find_if(
        marks.begin(), marks.end(), [defect](unsigned mark) { return (mark & Bit(defect)) != 0; });
      this->D.findings[k].first =
        found == marks.end() ? -1 : static_cast<int>(found - marks.begin());
    }
  }

  const Points& P;
  const Triangles& F;
  const DiagnosisOptions& Options;
  MeshDiagnosis D;
  std::vector<int> Place;  ///< the point that each point is one with
  std::vector<int> Number; ///< mesh point of each place, -1 for none
  std::vector<int> Given;  ///< the triangle that each of the mesh is
  TriangleMesh Mesh;
  std::vector<unsigned> MeshMarks; ///< of mesh points
  int FirstLoop = -1;              ///< first mesh point on a border
};
}

MeshDiagnosis Diagnose(const Points& P, const Triangles& F, const DiagnosisOptions& options)
{
  if (P.rows() > MostTriangles || F.rows() > MostTriangles)
  {
    throw std::invalid_argument(
      "more than " + std::to_string(MostTriangles) + " triangles or points cannot be numbered");
  }
  return Examination(P, F, options).Run();
}

double DigitsLeft(double diagonal, double step)
{
  return diagonal > step ? std::log10(diagonal) - std::log10(step) : 0.0;
}
} // namespace SphericalStyle
