// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ManifoldSurface.h"

#include "DisjointSets.h"
#include "MeshEdges.h"
#include "MeshQuality.h"
#include "SurfaceMeasures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

namespace SphericalStyle
{
namespace
{
/// Each number a set of its own.
std::vector<int> Singles(Eigen::Index count)
{
  std::vector<int> parents(count);
  std::iota(parents.begin(), parents.end(), 0);
  return parents;
}

/// A triangle at an edge from u to v.
struct Leaf
{
  double angle; // about the edge, counterclockwise seen from v
  bool closes;  // its inside is where angles are smaller
  int halfEdge;
};

/// For each triangle the area of what hangs together with it at edges of two, and less than 0 where
/// that has a border: a wall or a fin, which comes off first.
Eigen::VectorXd PatchAreas(
  const TriangleMesh& mesh, const MeshEdges& edges, const std::vector<int>& opposite)
{
  const Eigen::VectorXd areas = TriangleAreas(mesh.P, mesh.F);
  const double whole = areas.sum();
  std::vector<int> patches = Singles(mesh.F.rows()); // of triangles
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h)
  {
    if (opposite[h] > h)
    {
      JoinSets(patches, h / 3, opposite[h] / 3);
    }
  }
  Eigen::VectorXd ofPatch = Eigen::VectorXd::Zero(mesh.F.rows());
  for (int f = 0; f < static_cast<int>(mesh.F.rows()); ++f)
  {
    ofPatch(RootOf(patches, f)) += areas(f);
  }
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    if (edges.GetValence(e) == 1)
    {
      const int f = edges.GetHalfEdges()[edges.GetOffset()[e]] / 3;
      double& area = ofPatch(RootOf(patches, f));
      area = area > 0.0 ? area - whole : area;
    }
  }
  Eigen::VectorXd sizes(mesh.F.rows());
  for (int f = 0; f < static_cast<int>(mesh.F.rows()); ++f)
  {
    sizes(f) = ofPatch(RootOf(patches, f));
  }
  return sizes;
}

/// The triangles around edge e. Of two at one angle the one that ends an inside comes first.
std::vector<Leaf> LeavesOf(const TriangleMesh& mesh, const MeshEdges& edges, int e)
{
  const auto begin = edges.GetHalfEdges().begin();
  const std::vector<int> sides(begin + edges.GetOffset()[e], begin + edges.GetOffset()[e + 1]);
  const int u = std::min(StartPoint(mesh.F, sides[0]), EndPoint(mesh.F, sides[0]));
  const int v = std::max(StartPoint(mesh.F, sides[0]), EndPoint(mesh.F, sides[0]));
  const Eigen::Vector3d axis = (mesh.P.row(v) - mesh.P.row(u)).stableNormalized();
  const Eigen::Vector3d x = axis.unitOrthogonal();
  const Eigen::Vector3d y = axis.cross(x);
  std::vector<Leaf> leaves;
  for (const int h : sides)
  {
    const Eigen::Vector3d a = mesh.P.row(mesh.F(h / 3, h % 3)) - mesh.P.row(u);
    leaves.push_back({ std::atan2(a.dot(y), a.dot(x)), StartPoint(mesh.F, h) == u, h });
  }
  std::sort(leaves.begin(), leaves.end(),
    [](const Leaf& a, const Leaf& b)
    { return std::tie(a.angle, b.closes, a.halfEdge) < std::tie(b.angle, a.closes, b.halfEdge); });
  return leaves;
}

/// Takes away, of the least patches, what one direction has more than the other.
void Balance(const Eigen::VectorXd& patchAreas, std::vector<Leaf>& leaves)
{
  const auto closing =
    std::count_if(leaves.begin(), leaves.end(), [](const Leaf& leaf) { return leaf.closes; });
  auto excess = 2 * closing - static_cast<std::ptrdiff_t>(leaves.size());
  const bool closes = excess > 0;
  for (excess = std::abs(excess); excess > 0; --excess)
  {
    leaves.erase(std::min_element(leaves.begin(), leaves.end(),
      [&](const Leaf& a, const Leaf& b)
      {
        const auto rank = [&](const Leaf& leaf)
        { return std::make_pair(leaf.closes != closes, patchAreas(leaf.halfEdge / 3)); };
        return rank(a) < rank(b);
      }));
  }
}

/// As brackets belong together, around and around.
void PairLeaves(const std::vector<Leaf>& leaves, std::vector<int>& opposite)
{
  std::vector<int> open; // half-edges
  for (int round = 0; round < 2; ++round)
  {
    for (const Leaf& leaf : leaves)
    {
      if (opposite[leaf.halfEdge] >= 0)
      {
        continue;
      }
      if (!leaf.closes && round == 0)
      {
        open.push_back(leaf.halfEdge);
      }
      else if (leaf.closes && !open.empty())
      {
        opposite[leaf.halfEdge] = open.back();
        opposite[open.back()] = leaf.halfEdge;
        open.pop_back();
      }
    }
  }
}

/// For each half-edge the one of the triangle across, or -1 at a border.
std::vector<int> OppositesOf(const TriangleMesh& mesh)
{
  const MeshEdges edges(mesh.F);
  std::vector<int> opposite(mesh.F.size(), -1);
  std::vector<int> many; // edges of three or more
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int* sides = edges.GetHalfEdges().data() + edges.GetOffset()[e];
    if (edges.GetValence(e) == 2 && EdgeBalance(mesh.F, edges, e) == 0)
    {
      opposite[sides[0]] = sides[1];
      opposite[sides[1]] = sides[0];
    }
    else if (edges.GetValence(e) > 2)
    {
      many.push_back(e);
    }
  }
  if (many.empty())
  {
    return opposite;
  }
  const Eigen::VectorXd patchAreas = PatchAreas(mesh, edges, opposite);
  for (const int e : many)
  {
    std::vector<Leaf> leaves = LeavesOf(mesh, edges, e);
    Balance(patchAreas, leaves);
    PairLeaves(leaves, opposite);
  }
  return opposite;
}

/// @return of each new point the one that it was
std::vector<int> SplitFans(Triangles& F, int n, const std::vector<int>& opposite)
{
  std::vector<int> fans = Singles(F.size()); // of corners
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h)
  {
    const int g = opposite[h];
    if (g > h)
    {
      JoinSets(fans, 3 * (h / 3) + HalfEdgeStart(h % 3), 3 * (g / 3) + HalfEdgeEnd(g % 3));
      JoinSets(fans, 3 * (h / 3) + HalfEdgeEnd(h % 3), 3 * (g / 3) + HalfEdgeStart(g % 3));
    }
  }
  std::vector<int> sources;
  std::vector<char> taken(n, 0);
  std::vector<int> pointOf(F.size(), -1); // of the first corner of each fan
  for (int corner = 0; corner < static_cast<int>(F.size()); ++corner)
  {
    const int i = F(corner / 3, corner % 3);
    int& point = pointOf[RootOf(fans, corner)];
    if (point < 0)
    {
      point = taken[i] ? n + static_cast<int>(sources.size()) : i;
      if (taken[i])
      {
        sources.push_back(i);
      }
      taken[i] = 1;
    }
    F(corner / 3, corner % 3) = point;
  }
  return sources;
}

/// Of edges whose ends stay together, a half-edge of each two that belong together or of one that
/// is left over.
std::vector<int> EdgesThatCannotOpen(const Triangles& F, const std::vector<int>& opposite)
{
  const MeshEdges edges(F);
  std::vector<int> split;
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int* sides = edges.GetHalfEdges().data() + edges.GetOffset()[e];
    const int valence = edges.GetValence(e);
    const bool isGood = valence == 1 || (valence == 2 && opposite[sides[0]] == sides[1]);
    if (!isGood)
    {
      std::copy_if(sides, sides + valence, std::back_inserter(split),
        [&opposite](int h) { return opposite[h] < h; });
    }
  }
  return split;
}

/// Splits edges in the middle, one after the other.
class EdgeSplitter
{
public:
  explicit EdgeSplitter(DerivedSurface& surface)
    : Surface(surface)
    , Pieces(surface.mesh.F.rows())
  {
    for (const auto& t : surface.mesh.F.rowwise())
    {
      this->Corners.push_back({ t(0), t(1), t(2) });
    }
    for (int f = 0; f < static_cast<int>(this->Pieces.size()); ++f)
    {
      this->Pieces[f] = { f };
    }
  }

  /// @param h  a half-edge of the surface as it came @param other  the one across, or -1
  void Split(int h, int other)
  {
    const Triangles& F = this->Surface.mesh.F;
    const int u = StartPoint(F, h);
    const int v = EndPoint(F, h);
    const int middle = static_cast<int>(this->Surface.ends.size());
    // Of the mesh that this one is derived from; of ends that lie between two points, the first.
    this->Surface.ends.push_back({ this->Surface.ends[u][0], this->Surface.ends[v][0] });
    this->Surface.shares.push_back(0.5);
    this->Added.emplace_back(0.5 * (this->Surface.mesh.P.row(u) + this->Surface.mesh.P.row(v)));
    this->SplitTriangle(h / 3, u, v, middle);
    if (other >= 0)
    {
      this->SplitTriangle(other / 3, v, u, middle);
    }
  }

  void Finish()
  {
    AppendPoints(this->Surface.mesh.P, this->Added);
    this->Surface.mesh.F = ToTriangles(this->Corners);
  }

private:
  void SplitTriangle(int f, int u, int v, int middle)
  {
    for (const int piece : this->Pieces[f])
    {
      std::array<int, 3>& t = this->Corners[piece];
      for (int k = 0; k < 3; ++k)
      {
        if (t[k] == u && t[(k + 1) % 3] == v)
        {
          const int apex = t[(k + 2) % 3];
          t = { u, middle, apex };
          this->Pieces[f].push_back(static_cast<int>(this->Corners.size()));
          this->Corners.push_back({ middle, v, apex });
          this->Surface.triangles.push_back(this->Surface.triangles[f]);
          return;
        }
      }
    }
  }

  DerivedSurface& Surface;
  std::vector<std::vector<int>> Pieces; // of each triangle, the ones it is cut into
  std::vector<std::array<int, 3>> Corners;
  std::vector<Eigen::RowVector3d> Added; // points
};
} // namespace

DerivedSurface Underived(const TriangleMesh& mesh)
{
  DerivedSurface whole;
  whole.mesh = mesh;
  for (int i = 0; i < static_cast<int>(mesh.P.rows()); ++i)
  {
    whole.ends.push_back({ i, i });
    whole.shares.push_back(0.0);
  }
  for (int f = 0; f < static_cast<int>(mesh.F.rows()); ++f)
  {
    whole.triangles.push_back(f);
  }
  return whole;
}

OpenEdges FindOpenEdges(const Triangles& F)
{
  const MeshEdges edges(F);
  OpenEdges open;
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int point = StartPoint(F, edges.GetHalfEdges()[edges.GetOffset()[e]]);
    const auto count = [point](int& number, int& first)
    {
      ++number;
      first = first < 0 ? point : first;
    };
    const int valence = edges.GetValence(e);
    if (valence == 1)
    {
      count(open.borders, open.firstBorder);
    }
    else if (valence > 2)
    {
      count(open.nonManifold, open.firstNonManifold);
    }
    else if (EdgeBalance(F, edges, e) != 0)
    {
      count(open.misoriented, open.firstMisoriented);
    }
  }
  return open;
}

std::vector<int> WithoutRepetitions(const Triangles& F)
{
  struct Entry
  {
    std::array<int, 3> points; // ascending
    bool isEven;               // whether the triangle runs through them in this order
    int triangle;
  };
  std::vector<Entry> entries;
  for (int f = 0; f < static_cast<int>(F.rows()); ++f)
  {
    std::array<int, 3> t = { F(f, 0), F(f, 1), F(f, 2) };
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    const bool isEven = t[1] < t[2];
    std::sort(t.begin(), t.end());
    entries.push_back({ t, isEven, f });
  }
  std::sort(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b)
    { return std::tie(a.points, a.triangle) < std::tie(b.points, b.triangle); });
  std::vector<int> oneOfEachSide;
  std::vector<int> oneOfBoth;
  bool allHaveBoth = true;
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end)
  {
    std::array<bool, 2> has = { false, false };
    for (; end < entries.size() && entries[end].points == entries[begin].points; ++end)
    {
      bool& hasSide = has[entries[end].isEven ? 1 : 0];
      if (!hasSide)
      {
        oneOfEachSide.push_back(entries[end].triangle);
      }
      hasSide = true;
    }
    oneOfBoth.push_back(entries[begin].triangle);
    allHaveBoth = allHaveBoth && has[0] && has[1];
  }
  std::vector<int>& kept = allHaveBoth ? oneOfBoth : oneOfEachSide;
  std::sort(kept.begin(), kept.end());
  return std::move(kept);
}

void MakeManifold(DerivedSurface& surface)
{
  TriangleMesh& mesh = surface.mesh;
  const std::vector<int> opposite = OppositesOf(mesh);
  const auto n = static_cast<int>(mesh.P.rows());
  const std::vector<int> sources = SplitFans(mesh.F, n, opposite);
  std::vector<Eigen::RowVector3d> places;
  for (const int source : sources)
  {
    places.emplace_back(mesh.P.row(source));
    surface.ends.push_back(surface.ends[source]);
    surface.shares.push_back(surface.shares[source]);
  }
  AppendPoints(mesh.P, places);
  const std::vector<int> split = EdgesThatCannotOpen(mesh.F, opposite);
  if (!split.empty())
  {
    EdgeSplitter splitter(surface);
    for (const int h : split)
    {
      splitter.Split(h, opposite[h]);
    }
    splitter.Finish();
  }
}
} // namespace SphericalStyle
