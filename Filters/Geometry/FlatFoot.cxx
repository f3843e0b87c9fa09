// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FlatFoot.h"

#include "MeshEdges.h"
#include "MeshTopology.h"
#include "PlanarPolygons.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace SphericalStyle
{
namespace
{
/// Where an edge is cut nearer to one of its ends than this, that end is moved onto the level.
constexpr double ShortestPiece = 0.05;
/// Levels that are looked at before the search between two of them.
constexpr int NumberOfLevels = 256;

std::uint64_t Key(int u, int v)
{
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(u)) << 32U) |
    static_cast<std::uint32_t>(v);
}

/// Moves points onto the level where edges would be cut close to them.
void MoveOntoLevel(Points& P, const Triangles& F, int axis, double level)
{
  std::vector<char> moves(P.rows(), 0);
  for (const auto& t : F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = t[k];
      const int v = t[(k + 1) % 3];
      const double above = P(u, axis) - level;
      const double other = P(v, axis) - level;
      if ((above > 0.0) != (other > 0.0) && above != 0.0 && other != 0.0)
      {
        const double share = above / (above - other);
        moves[u] = moves[u] || share < ShortestPiece ? 1 : 0;
        moves[v] = moves[v] || share > 1.0 - ShortestPiece ? 1 : 0;
      }
    }
  }
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    if (moves[i])
    {
      P(i, axis) = level;
    }
  }
}

/// Leaves out points that no triangle has.
void DropUnused(DerivedSurface& surface)
{
  std::vector<int> number(surface.mesh.P.rows(), -1);
  for (const auto& t : surface.mesh.F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      number[t[k]] = 0;
    }
  }
  int n = 0;
  for (std::size_t i = 0; i < number.size(); ++i)
  {
    if (number[i] == 0)
    {
      surface.mesh.P.row(n) = surface.mesh.P.row(static_cast<Eigen::Index>(i)).eval();
      surface.ends[n] = surface.ends[i];
      surface.shares[n] = surface.shares[i];
      number[i] = n++;
    }
  }
  surface.mesh.P.conservativeResize(n, 3);
  surface.ends.resize(n);
  surface.shares.resize(n);
  surface.mesh.F = surface.mesh.F.unaryExpr([&](int i) { return number[i]; }).eval();
}

/// A surface while it is cut.
class FlatCut
{
public:
  FlatCut(const TriangleMesh& mesh, int axis, double level)
    : Mesh(mesh)
    , Axis(axis)
    , Level(level)
    , P(mesh.P)
    , Made(Underived(mesh))
  {
    MoveOntoLevel(this->P, mesh.F, axis, level);
    this->Made.triangles.clear();
  }

  void KeepAbove();
  /// @return false where a part of the section runs through itself
  bool CloseFoot();
  DerivedSurface Take()
  {
    this->Made.triangles.resize(this->Kept.size(), -1);
    this->Made.mesh = { this->P, ToTriangles(this->Kept) };
    return std::move(this->Made);
  }

private:
  using Edges = std::vector<std::array<int, 2>>;
  double Height(int i) const { return this->P(i, this->Axis) - this->Level; }
  int PointOn(int u, int v);
  void KeepAbove(Eigen::Index f);
  Edges Borders() const;
  bool IsOriented(std::vector<std::array<int, 3>> foot) const;

  const TriangleMesh& Mesh;
  int Axis;
  double Level;
  Points P;
  DerivedSurface Made;
  std::vector<Eigen::RowVector3d> Added; // points
  std::unordered_map<std::uint64_t, int> OnEdge;
  std::vector<std::array<int, 3>> Kept; // triangles
};

/// @param u, v  one above, one below
int FlatCut::PointOn(int u, int v)
{
  const int a = std::min(u, v);
  const int b = std::max(u, v);
  const int next = static_cast<int>(this->Mesh.P.rows() + this->Added.size());
  const auto [place, isNew] = this->OnEdge.emplace(Key(a, b), next);
  if (isNew)
  {
    const double share = this->Height(a) / (this->Height(a) - this->Height(b));
    Eigen::RowVector3d p = this->P.row(a) + share * (this->P.row(b) - this->P.row(a));
    p(this->Axis) = this->Level;
    this->Added.emplace_back(p);
    this->Made.ends.push_back({ a, b });
    this->Made.shares.push_back(share);
  }
  return place->second;
}

void FlatCut::KeepAbove()
{
  for (Eigen::Index f = 0; f < this->Mesh.F.rows(); ++f)
  {
    this->KeepAbove(f);
  }
  AppendPoints(this->P, this->Added);
}

void FlatCut::KeepAbove(Eigen::Index f)
{
  std::vector<int> polygon; // what is above
  bool isAbove = false;
  for (int k = 0; k < 3; ++k)
  {
    const int u = this->Mesh.F(f, k);
    const int v = this->Mesh.F(f, (k + 1) % 3);
    if (this->Height(u) >= 0.0)
    {
      polygon.push_back(u);
      isAbove = isAbove || this->Height(u) > 0.0;
    }
    if (this->Height(u) * this->Height(v) < 0.0)
    {
      polygon.push_back(this->PointOn(u, v));
    }
  }
  for (std::size_t k = 2; isAbove && k < polygon.size(); ++k)
  {
    this->Kept.push_back({ polygon[0], polygon[k - 1], polygon[k] });
    this->Made.triangles.push_back(static_cast<int>(f));
  }
}

/// The other way round than in the triangles that are kept.
FlatCut::Edges FlatCut::Borders() const
{
  const Triangles F = ToTriangles(this->Kept);
  const MeshEdges edges(F);
  Edges borders;
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    if (edges.GetValence(e) == 1)
    {
      const int h = edges.GetHalfEdges()[edges.GetOffset()[e]];
      borders.push_back({ EndPoint(F, h), StartPoint(F, h) });
    }
  }
  return borders;
}

/// A solid in another one would become a hole of its foot.
bool FlatCut::IsOriented(std::vector<std::array<int, 3>> foot) const
{
  foot.insert(foot.end(), this->Kept.begin(), this->Kept.end());
  return FindOpenEdges(ToTriangles(foot)).misoriented == 0;
}

bool FlatCut::CloseFoot()
{
  const Edges all = this->Borders();
  std::vector<std::array<int, 3>> foot;
  const auto placeOf = [this](int i) -> Eigen::Vector2d // seen from below
  {
    return { this->P(i, (this->Axis + 2) % 3), this->P(i, (this->Axis + 1) % 3) };
  };
  bool filled = FillPlanarPolygons(all, placeOf, foot) && this->IsOriented(foot);
  if (!filled)
  {
    // Parts that run through each other, or lie in each other, are closed one by one.
    foot.clear();
    const auto n = static_cast<int>(this->Mesh.P.rows());
    const std::vector<int> parts = MeshTopology(this->Mesh.F, n).GetComponents();
    std::map<int, Edges> borders;
    for (const auto& border : all)
    {
      borders[parts[this->Made.ends[border[1]][0]]].push_back(border);
    }
    filled = std::all_of(borders.begin(), borders.end(),
      [&](const auto& part) { return FillPlanarPolygons(part.second, placeOf, foot); });
  }
  this->Kept.insert(this->Kept.end(), foot.begin(), foot.end());
  return filled && !this->Kept.empty();
}
} // namespace

double SectionArea(const TriangleMesh& mesh, int axis, double level)
{
  const int x = (axis + 1) % 3;
  const int y = (axis + 2) % 3;
  double twice = 0.0;
  const Eigen::RowVector3d O = mesh.P.row(mesh.F(0, 0));
  for (const auto& t : mesh.F.rowwise())
  {
    Eigen::Vector2d from = Eigen::Vector2d::Zero();
    Eigen::Vector2d to = Eigen::Vector2d::Zero();
    bool crosses = false;
    for (int k = 0; k < 3; ++k)
    {
      const int u = t[k];
      const int v = t[(k + 1) % 3];
      const bool up = mesh.P(u, axis) < level && mesh.P(v, axis) >= level;
      const bool down = mesh.P(u, axis) >= level && mesh.P(v, axis) < level;
      if (up || down)
      {
        const double share = (level - mesh.P(u, axis)) / (mesh.P(v, axis) - mesh.P(u, axis));
        const Eigen::RowVector3d p = mesh.P.row(u) - O + share * (mesh.P.row(v) - mesh.P.row(u));
        (up ? from : to) = Eigen::Vector2d(p(x), p(y));
        crosses = true;
      }
    }
    if (crosses)
    {
      twice += to(0) * from(1) - to(1) * from(0);
    }
  }
  return 0.5 * twice;
}

double GroundArea(const TriangleMesh& mesh, int axis, double tolerance)
{
  const double ground = mesh.P.col(axis).minCoeff() + tolerance;
  double area = 0.0;
  for (const auto& t : mesh.F.rowwise())
  {
    if (mesh.P(t[0], axis) <= ground && mesh.P(t[1], axis) <= ground &&
      mesh.P(t[2], axis) <= ground)
    {
      const Eigen::RowVector3d u = mesh.P.row(t[1]) - mesh.P.row(t[0]);
      const Eigen::RowVector3d v = mesh.P.row(t[2]) - mesh.P.row(t[0]);
      area += 0.5 * std::abs(u.cross(v)(axis));
    }
  }
  return area;
}

double FootLevel(const TriangleMesh& mesh, int axis, double wanted, double deepest, double& most)
{
  const double ground = mesh.P.col(axis).minCoeff();
  most = 0.0;
  double low = ground;
  for (int k = 1; k <= NumberOfLevels; ++k)
  {
    double high = ground + (deepest - ground) * k / NumberOfLevels;
    const double area = SectionArea(mesh, axis, high);
    most = std::max(most, area);
    if (area >= wanted)
    {
      for (int step = 0; step < 60; ++step)
      {
        const double middle = 0.5 * (low + high);
        (SectionArea(mesh, axis, middle) >= wanted ? high : low) = middle;
      }
      return high;
    }
    low = high;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

DerivedSurface CutFlat(const TriangleMesh& mesh, int axis, double level)
{
  FlatCut cut(mesh, axis, level);
  cut.KeepAbove();
  if (!cut.CloseFoot())
  {
    return {};
  }
  DerivedSurface made = cut.Take();
  const OpenEdges open = FindOpenEdges(made.mesh.F);
  if (open.borders + open.nonManifold + open.misoriented > 0)
  {
    return {};
  }
  MakeManifold(made);
  DropUnused(made);
  return made;
}
} // namespace SphericalStyle
