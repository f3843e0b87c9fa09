// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceProjection.h"

#include "CGALVersion.h"
#include "Parallel.h"

#if SPHERICALSTYLE_CGAL_6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif
#include <CGAL/AABB_tree.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace SphericalStyle
{
namespace
{
using Eigen::Vector3d;
using Eigen::VectorXi;

// Only boxes and splits are CGAL's. Distances and hits are computed here, so that rounding and ties
// are ours to decide; no predicate is asked for.
using Cartesian = CGAL::Simple_cartesian<double>;
using Corners = std::vector<Cartesian::Triangle_3>;
#if SPHERICALSTYLE_CGAL_6
using Primitive = CGAL::AABB_triangle_primitive_3<Cartesian, Corners::const_iterator>;
using BoxTree = CGAL::AABB_tree<CGAL::AABB_traits_3<Cartesian, Primitive>>;
#else
using Primitive = CGAL::AABB_triangle_primitive<Cartesian, Corners::const_iterator>;
using BoxTree = CGAL::AABB_tree<CGAL::AABB_traits<Cartesian, Primitive>>;
#endif

using PointMap = CGAL::Pointer_property_map<Cartesian::Point_3>::type;
using PointTraits = CGAL::Search_traits_adapter<int, PointMap, CGAL::Search_traits_3<Cartesian>>;
using PointSearch = CGAL::Orthogonal_k_neighbor_search<PointTraits>;

// Lengths below are those of a proxy whose half diagonal lies between 1 and 2.
constexpr double OnSurface = 1e-9;        // nearer points have no projection vector
constexpr double BarycentricSlack = 1e-9; // a foot on an edge is inside for both triangles
constexpr double RaySlack = 1e-12;        // a ray that starts on the surface meets it there
constexpr double BoxSlack = 1e-9;         // boxes of triangles along an axis are flat
constexpr double OneDegree = Pi / 180.0;
// Feet beyond this share of the diagonal, and beyond so many times the distance of the nearest one,
// are no choice of SmallestAngle.
constexpr double ReachShare = 0.15;
constexpr double ReachFactor = 2.0;
constexpr int Rounds = 8; // of case 3: a foot outside in the plane of its own triangle stays there
constexpr double Infinity = std::numeric_limits<double>::infinity();

// Twice the area. 0 where the height is below 1e-10 of the edges: nothing of its direction is left.
Vector3d AreaVector(const Vector3d& A, const Vector3d& B, const Vector3d& C)
{
  const Vector3d u = B - A;
  const Vector3d v = C - A;
  const Vector3d N = u.cross(v);
  const double longest = std::max({ u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm() });
  return N.squaredNorm() > 1e-20 * longest * longest ? N : Vector3d(Vector3d::Zero());
}

// Rounding must not leave a sum beside 1: all of an error goes into the largest.
Vector3d WithSumOne(const Vector3d& ratios)
{
  Vector3d b = ratios.cwiseMax(0.0);
  b /= b.sum();
  Eigen::Index largest = 0;
  b.maxCoeff(&largest);
  b[largest] = 1.0 - b[(largest + 1) % 3] - b[(largest + 2) % 3];
  return b;
}

// The triangle of a cell, with what the tests of one point and many triangles need.
struct Facet
{
  std::array<Vector3d, 3> corner;
  Vector3d normal; // 0 without area
  // b_2 = grow[0] . (x - A), b_3 = grow[1] . (x - A), also for x off the plane. NaN without area:
  // such a triangle holds no foot.
  std::array<Vector3d, 2> grow;

  Facet(const Vector3d& A, const Vector3d& B, const Vector3d& C)
    : corner({ A, B, C })
    , normal(Vector3d::Zero())
  {
    const Vector3d N = AreaVector(A, B, C);
    const double square = N.squaredNorm();
    this->grow.fill(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    if (square > 0.0)
    {
      this->normal = N / std::sqrt(square);
      this->grow = { (C - A).cross(N) / square, N.cross(B - A) / square };
    }
  }

  bool HasArea() const { return !this->normal.isZero(0.0); }

  // Whether the orthogonal foot of x lies inside or on the edge.
  bool HoldsFoot(const Vector3d& x) const
  {
    const Vector3d r = x - this->corner[0];
    const double b2 = this->grow[0].dot(r);
    const double b3 = this->grow[1].dot(r);
    return b2 >= -BarycentricSlack && b3 >= -BarycentricSlack && b2 + b3 <= 1.0 + BarycentricSlack;
  }

  double Height(const Vector3d& x) const { return this->normal.dot(x - this->corner[0]); }
};

struct Foot
{
  int cell = 0;
  Vector3d b = Vector3d::UnitX();
  Vector3d q = Vector3d::Zero();
  double square = Infinity; // |p - q|^2

  Foot() = default;

  // The nearest point of one triangle.
  Foot(const Vector3d& p, const Facet& facet, int number)
    : cell(number)
    , b(ClosestBarycentric(p, facet.corner[0], facet.corner[1], facet.corner[2]))
    , q(b[0] * facet.corner[0] + b[1] * facet.corner[1] + b[2] * facet.corner[2])
    , square((p - q).squaredNorm())
  {
  }

  bool IsNearerThan(const Foot& other) const
  {
    return this->square < other.square || (this->square == other.square && this->cell < other.cell);
  }
};

// What CGAL's tree asks of a search through its boxes: near ones first, those beyond the best find
// not at all. The order depends on the query alone.
// NOLINTBEGIN(readability-identifier-naming)
template <class Search>
class Visitor
{
public:
  using Priority = double;
  Visitor(Search& search, Corners::const_iterator first)
    : TheSearch(search)
    , First(first)
  {
  }
  bool go_further() const { return true; }
  template <class Query, class Node>
  bool do_intersect(const Query&, const Node& node) const
  {
    return this->TheSearch.Entry(node.bbox()) <= this->TheSearch.Limit();
  }
  template <class Query, class Node>
  std::pair<bool, Priority> do_intersect_with_priority(const Query&, const Node& node) const
  {
    const double entry = this->TheSearch.Entry(node.bbox());
    return { entry <= this->TheSearch.Limit(), -entry };
  }
  template <class Query>
  void intersection(const Query&, const Primitive& primitive)
  {
    this->TheSearch.Visit(static_cast<int>(primitive.id() - this->First));
  }

private:
  Search& TheSearch;
  Corners::const_iterator First;
};
// NOLINTEND(readability-identifier-naming)

// The nearest point of all triangles.
class NearestSearch
{
public:
  NearestSearch(const std::vector<Facet>& facets, const Vector3d& p)
    : Facets(facets)
    , P(p)
  {
  }
  double Entry(const CGAL::Bbox_3& box) const
  {
    double square = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const double outside = std::max({ box.min(k) - this->P[k], this->P[k] - box.max(k), 0.0 });
      square += outside * outside;
    }
    return square;
  }
  double Limit() const { return this->Best.square; }
  void Visit(int cell)
  {
    const Foot foot(this->P, this->Facets[cell], cell);
    if (foot.IsNearerThan(this->Best))
    {
      this->Best = foot;
    }
  }
  const Foot& GetBest() const { return this->Best; }

private:
  const std::vector<Facet>& Facets;
  Vector3d P;
  Foot Best;
};

// The first triangle that a ray meets.
class RaySearch
{
public:
  RaySearch(const std::vector<Facet>& facets, const Vector3d& p, const Vector3d& direction)
    : Facets(facets)
    , P(p)
    , D(direction)
    , Inverse(direction.cwiseInverse())
  {
  }
  // Boxes are a little larger, so that rounding loses none. NaN (a ray in the plane of a side)
  // stands second, where max and min pass over it.
  double Entry(const CGAL::Bbox_3& box) const
  {
    double near = -RaySlack;
    double far = Infinity;
    for (int k = 0; k < 3; ++k)
    {
      const double t1 = (box.min(k) - BoxSlack - this->P[k]) * this->Inverse[k];
      const double t2 = (box.max(k) + BoxSlack - this->P[k]) * this->Inverse[k];
      near = std::max(near, std::min(t1, t2));
      far = std::min(far, std::max(t1, t2));
    }
    if (near > far)
    {
      return Infinity;
    }
    return near;
  }
  double Limit() const { return this->Length; }
  void Visit(int cell)
  {
    const Facet& facet = this->Facets[cell];
    const double t = -facet.Height(this->P) / facet.normal.dot(this->D);
    const bool first = t < this->Length || (t == this->Length && cell < this->Cell);
    if (t >= -RaySlack && first && facet.HoldsFoot(this->P + t * this->D))
    {
      this->Length = t;
      this->Cell = cell;
    }
  }
  bool HasHit() const { return this->Cell >= 0; }
  Foot GetHit() const
  {
    return { this->P + this->Length * this->D, this->Facets[this->Cell], this->Cell };
  }

private:
  const std::vector<Facet>& Facets;
  Vector3d P;
  Vector3d D;
  Vector3d Inverse;
  double Length = std::numeric_limits<double>::max(); // below the infinity of boxes not met
  int Cell = -1;
};

// Triangles near each other and of like normals, in a ball and (as lines) in a cone.
struct Cluster
{
  std::vector<int> cells;
  Vector3d center;
  double radius = 0.0;
  Vector3d axis;
  double angle = 0.0; // half the opening of the cone
  double cosine = 1.0;
  double sine = 0.0;
};

Cluster Enclose(const std::vector<Facet>& facets, std::vector<int> cells)
{
  Cluster cluster;
  Vector3d low = Vector3d::Constant(Infinity);
  Vector3d high = -low;
  Vector3d sum = Vector3d::Zero();
  for (const int cell : cells)
  {
    for (const Vector3d& x : facets[cell].corner)
    {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    sum += facets[cell].normal;
  }
  cluster.center = 0.5 * (low + high);
  cluster.axis = sum.norm() > 1e-3 ? sum.normalized() : facets[cells.front()].normal;
  double cosine = 1.0;
  for (const int cell : cells)
  {
    cosine = std::min(cosine, std::abs(cluster.axis.dot(facets[cell].normal)));
    for (const Vector3d& x : facets[cell].corner)
    {
      cluster.radius = std::max(cluster.radius, (x - cluster.center).norm());
    }
  }
  // Room for rounding; acos near 1 is good to 1e-8.
  cluster.radius += 1e-7;
  cluster.angle = std::min(0.5 * Pi, std::acos(cosine) + 1e-7);
  cluster.cosine = std::cos(cluster.angle);
  cluster.sine = std::sin(cluster.angle);
  cluster.cells = std::move(cells);
  return cluster;
}

// Halves the longest extent of places and normals, taken as six coordinates, until the parts are
// small: then there are about as many of them as triangles in each.
std::vector<Cluster> MakeClusters(const std::vector<Facet>& facets, std::vector<int> cells)
{
  using Place = Eigen::Array<double, 6, 1>;
  const auto place = [&facets](int cell)
  {
    const Facet& f = facets[cell];
    return (Place() << (f.corner[0] + f.corner[1] + f.corner[2]) / 3.0, f.normal).finished();
  };
  const auto enough = std::max<std::ptrdiff_t>(
    8, static_cast<std::ptrdiff_t>(0.5 * std::sqrt(static_cast<double>(cells.size()))));
  std::vector<Cluster> clusters;
  std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> parts;
  parts.emplace_back(0, static_cast<std::ptrdiff_t>(cells.size()));
  while (!parts.empty())
  {
    const auto [from, to] = parts.back();
    parts.pop_back();
    const auto begin = cells.begin() + from;
    const auto end = cells.begin() + to;
    if (to - from <= enough)
    {
      clusters.push_back(Enclose(facets, { begin, end }));
      continue;
    }
    Place low = Place::Constant(Infinity);
    Place high = -low;
    std::for_each(begin, end,
      [&](int cell)
      {
        const Place x = place(cell);
        low = low.min(x);
        high = high.max(x);
      });
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const std::ptrdiff_t half = (from + to) / 2;
    std::nth_element(begin, cells.begin() + half, end,
      [&](int a, int b)
      { return std::make_pair(place(a)[axis], a) < std::make_pair(place(b)[axis], b); });
    parts.emplace_back(from, half);
    parts.emplace_back(half, to);
  }
  return clusters;
}

// The smallest angle between the line of a normal and a line that is perpendicular to a triangle.
// Keeps its lists from point to point: one for each thread.
class AngleSearch
{
public:
  // @param reach  length within which feet are a choice
  AngleSearch(const std::vector<Facet>& facets, const std::vector<Cluster>& clusters, double reach)
    : Facets(facets)
    , Clusters(clusters)
    , ReachSquare(reach * reach)
  {
  }

  // @param n  of length 1 @param closest  not p itself
  Foot Find(const Vector3d& p, const Vector3d& n, const Foot& closest)
  {
    this->P = p;
    this->N = n;
    this->Smallest = Infinity;
    this->Candidates.clear();
    this->FarthestSquare = std::max(this->ReachSquare, ReachFactor * ReachFactor * closest.square);
    this->Offer(std::abs((p - closest.q).dot(n)) / std::sqrt(closest.square), closest);
    this->ListClusters();
    for (const auto& [angle, number] : this->Queue)
    {
      if (angle > this->Smallest + OneDegree)
      {
        break;
      }
      this->Visit(this->Clusters[number]);
    }
    return this->Nearest();
  }

private:
  struct Candidate
  {
    double angle;
    Foot foot;
  };

  void Offer(double cosine, const Foot& foot)
  {
    const double angle = std::acos(std::min(1.0, cosine));
    this->Candidates.push_back({ angle, foot });
    if (angle < this->Smallest)
    {
      this->Smallest = angle;
      this->CosineLimit = std::cos(std::min(0.5 * Pi, angle + OneDegree)) - 1e-12;
    }
  }

  // Those whose cone comes near enough to n, and into whose ball a line of their cone leads from p;
  // by the smallest angle that they may hold.
  void ListClusters()
  {
    this->Queue.clear();
    const double sineLimit = std::sqrt(std::max(0.0, 1.0 - this->CosineLimit * this->CosineLimit));
    for (std::size_t i = 0; i < this->Clusters.size(); ++i)
    {
      const Cluster& c = this->Clusters[i];
      const double cosine = std::abs(c.axis.dot(this->N));
      if (cosine < this->CosineLimit * c.cosine - sineLimit * c.sine)
      {
        continue;
      }
      const Vector3d u = c.center - this->P;
      const double beyond = u.squaredNorm() - c.radius * c.radius;
      if (beyond > 0.0 &&
        std::abs(c.axis.dot(u)) < c.cosine * std::sqrt(beyond) - c.sine * c.radius)
      {
        continue;
      }
      const double angle = std::acos(std::min(1.0, cosine)) - c.angle;
      this->Queue.emplace_back(angle, static_cast<int>(i));
    }
    std::sort(this->Queue.begin(), this->Queue.end());
  }

  void Visit(const Cluster& cluster)
  {
    for (const int cell : cluster.cells)
    {
      const Facet& facet = this->Facets[cell];
      const double cosine = std::abs(facet.normal.dot(this->N));
      if (cosine >= this->CosineLimit && facet.HoldsFoot(this->P))
      {
        const Foot foot(this->P, facet, cell);
        if (foot.square <= this->FarthestSquare)
        {
          this->Offer(cosine, foot);
        }
      }
    }
  }

  Foot Nearest() const
  {
    Foot best;
    for (const Candidate& candidate : this->Candidates)
    {
      if (candidate.angle <= this->Smallest + OneDegree && candidate.foot.IsNearerThan(best))
      {
        best = candidate.foot;
      }
    }
    return best;
  }

  const std::vector<Facet>& Facets;
  const std::vector<Cluster>& Clusters;
  double ReachSquare;
  Vector3d P;
  Vector3d N;
  double FarthestSquare = 0.0;
  double Smallest = Infinity;
  double CosineLimit = 0.0; // of the smallest angle and a degree
  std::vector<Candidate> Candidates;
  std::vector<std::pair<double, int>> Queue;
};

Feet MakeFeet(Eigen::Index n)
{
  Feet feet;
  feet.cell.resize(n);
  feet.barycentric.resize(n, 3);
  return feet;
}

void Store(Feet& feet, Eigen::Index i, const Foot& foot)
{
  feet.cell[i] = foot.cell;
  feet.barycentric.row(i) = foot.b.transpose();
}

// Any length but 0: (1e-200, 0, 0) is a direction.
bool MakeUnit(Vector3d& v)
{
  const double length = v.stableNorm();
  if (!(length > 0.0) || !std::isfinite(length))
  {
    return false;
  }
  v.stableNormalize();
  return true;
}
} // namespace

Points Interpolate(const Triangles& F, const Feet& feet, const Points& x)
{
  Points result(feet.cell.size(), 3);
  for (Eigen::Index i = 0; i < result.rows(); ++i)
  {
    const auto t = F.row(feet.cell[i]);
    const auto b = feet.barycentric.row(i);
    result.row(i) = b[0] * x.row(t[0]) + b[1] * x.row(t[1]) + b[2] * x.row(t[2]);
  }
  return result;
}

Eigen::Vector3d ClosestBarycentric(
  const Vector3d& p, const Vector3d& A, const Vector3d& B, const Vector3d& C)
{
  const Vector3d N = AreaVector(A, B, C);
  const double square = N.squaredNorm();
  if (square > 0.0)
  {
    const Vector3d ratios(
      (C - B).cross(p - B).dot(N), (A - C).cross(p - C).dot(N), (B - A).cross(p - A).dot(N));
    if (ratios.minCoeff() >= 0.0)
    {
      return WithSumOne(ratios / square);
    }
  }
  // Outside, or no area: on the nearest edge.
  const std::array<Vector3d, 3> corner = { A, B, C };
  Vector3d best = Vector3d::UnitX();
  double smallest = Infinity;
  for (int k = 0; k < 3; ++k)
  {
    const int next = (k + 1) % 3;
    const Vector3d edge = corner[next] - corner[k];
    const Vector3d r = p - corner[k];
    const double length = edge.squaredNorm();
    const double t = length > 0.0 ? std::clamp(edge.dot(r) / length, 0.0, 1.0) : 0.0;
    const double distance = (r - t * edge).squaredNorm();
    if (distance < smallest)
    {
      smallest = distance;
      best.setZero();
      best[k] = 1.0 - t;
      best[next] = t;
    }
  }
  return best;
}

// All of it in coordinates around the center, with a half diagonal between 1 and 2: limits need no
// unit, and a proxy far from the origin loses nothing. Coefficients do not change.
class SurfaceProjection::State
{
public:
  explicit State(const TriangleMesh& proxy)
  {
    this->Normalize(proxy);
    this->MakeFacets(proxy.F);
    this->BuildTrees(proxy.F);
    this->Clusters = MakeClusters(this->Facets, this->Cells);
  }

  Vector3d ToUnit(const Points& P, Eigen::Index i) const
  {
    return this->Scale * (P.row(i).transpose() - this->Center);
  }

  Foot Closest(const Vector3d& p) const
  {
    NearestSearch search(this->Facets, p);
    this->Traverse(search);
    return search.GetBest();
  }

  // @param direction  of length 1
  bool FirstHit(const Vector3d& p, const Vector3d& direction, Foot& hit) const
  {
    RaySearch search(this->Facets, p, direction);
    this->Traverse(search);
    if (search.HasHit())
    {
      hit = search.GetHit();
    }
    return search.HasHit();
  }

  // The thesis' method: @return the foot and the case of the first round
  std::pair<Foot, ProjectionCase> Near(const Vector3d& p, int k) const;

  AngleSearch MakeAngleSearch() const
  {
    return { this->Facets, this->Clusters, ReachShare * this->Diagonal };
  }

private:
  void Normalize(const TriangleMesh& proxy);
  void MakeFacets(const Triangles& F);
  void BuildTrees(const Triangles& F);

  template <class Search>
  void Traverse(Search& search) const
  {
    Visitor<Search> visitor(search, this->Shapes.begin());
    this->Boxes.traversal_with_priority(0, visitor);
  }

  std::vector<int> CellsAtNearest(const Vector3d& x, int k) const;

  Vector3d Center;
  double Scale = 1.0;
  double Diagonal = 0.0; // scaled
  Points V;              // the proxy's points
  std::vector<Facet> Facets;
  std::vector<int> Cells;                // those searched: all with area, or all if none has one
  std::vector<std::vector<int>> CellsAt; // those of them at each point
  std::vector<Cluster> Clusters;
  Corners Shapes; // of every cell
  BoxTree Boxes;
  std::vector<Cartesian::Point_3> Places; // of every point
  std::unique_ptr<PointSearch::Tree> PointTree;
};

void SurfaceProjection::State::Normalize(const TriangleMesh& proxy)
{
  Vector3d low = Vector3d::Constant(Infinity);
  Vector3d high = -low;
  for (Eigen::Index c = 0; c < proxy.F.size(); ++c)
  {
    const Vector3d x = proxy.P.row(proxy.F.data()[c]).transpose();
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  this->Center = 0.5 * (low + high);
  const double half = 0.5 * (high - low).stableNorm();
  // A power of two: scaling does not round.
  this->Scale = half > 0.0 ? std::ldexp(1.0, -std::ilogb(half)) : 1.0;
  this->Diagonal = 2.0 * half * this->Scale;
  this->V = this->Scale * (proxy.P.rowwise() - this->Center.transpose());
}

void SurfaceProjection::State::MakeFacets(const Triangles& F)
{
  for (int f = 0; f < static_cast<int>(F.rows()); ++f)
  {
    this->Facets.emplace_back(this->V.row(F(f, 0)).transpose(), this->V.row(F(f, 1)).transpose(),
      this->V.row(F(f, 2)).transpose());
    if (this->Facets.back().HasArea())
    {
      this->Cells.push_back(f);
    }
  }
  if (this->Cells.empty())
  {
    this->Cells.resize(F.rows());
    std::iota(this->Cells.begin(), this->Cells.end(), 0);
  }
}

// Both trees complete: CGAL would build them at the first search, which threads would share.
void SurfaceProjection::State::BuildTrees(const Triangles& F)
{
  for (const auto& v : this->V.rowwise())
  {
    this->Places.emplace_back(v[0], v[1], v[2]);
  }
  for (const auto& t : F.rowwise())
  {
    this->Shapes.emplace_back(this->Places[t[0]], this->Places[t[1]], this->Places[t[2]]);
  }
  this->CellsAt.resize(this->V.rows());
  for (const int cell : this->Cells)
  {
    this->Boxes.insert(Primitive(this->Shapes.cbegin() + cell));
    for (const int v : F.row(cell))
    {
      this->CellsAt[v].push_back(cell);
    }
  }
  this->Boxes.build();

  std::vector<int> used;
  for (int v = 0; v < static_cast<int>(this->CellsAt.size()); ++v)
  {
    if (!this->CellsAt[v].empty())
    {
      used.push_back(v);
    }
  }
  this->PointTree = std::make_unique<PointSearch::Tree>(used.begin(), used.end(),
    PointSearch::Tree::Splitter(), PointTraits(CGAL::make_property_map(this->Places)));
  this->PointTree->build();
}

// Thesis 5.3.1 (1), (2).
std::vector<int> SurfaceProjection::State::CellsAtNearest(const Vector3d& x, int k) const
{
  std::vector<int> cells;
  const PointSearch search(*this->PointTree, Cartesian::Point_3(x[0], x[1], x[2]),
    static_cast<unsigned int>(std::max(1, k)), 0.0, true,
    PointSearch::Distance(this->PointTree->traits().point_property_map()), false);
  for (const auto& [point, distance] : search)
  {
    cells.insert(cells.end(), this->CellsAt[point].begin(), this->CellsAt[point].end());
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

// Thesis 5.3.1 (3), (4).
std::pair<Foot, ProjectionCase> SurfaceProjection::State::Near(const Vector3d& p, int k) const
{
  ProjectionCase firstCase = NoFoot;
  Vector3d x = p;
  std::vector<int> cells;
  for (int round = 0; round < Rounds; ++round)
  {
    cells = this->CellsAtNearest(x, k);
    Foot inside;
    Vector3d outside = x;
    double height = Infinity;
    int feet = 0;
    for (const int cell : cells)
    {
      const Facet& facet = this->Facets[cell];
      const double h = facet.Height(x);
      if (facet.HoldsFoot(x))
      {
        const Foot foot(x, facet, cell);
        inside = feet == 0 || foot.IsNearerThan(inside) ? foot : inside;
        ++feet;
      }
      else if (std::abs(h) < height)
      {
        height = std::abs(h);
        outside = x - h * facet.normal;
      }
    }
    if (feet > 0)
    {
      return { inside, round > 0 ? firstCase : feet == 1 ? OneFoot : SeveralFeet };
    }
    x = outside;
  }
  Foot nearest;
  for (const int cell : cells)
  {
    const Foot foot(p, this->Facets[cell], cell);
    nearest = foot.IsNearerThan(nearest) ? foot : nearest;
  }
  return { nearest, firstCase };
}

SurfaceProjection::SurfaceProjection(const TriangleMesh& proxy)
{
  if (proxy.F.rows() == 0)
  {
    throw std::invalid_argument("a proxy without triangles has no surface to project to");
  }
  this->S = std::make_unique<State>(proxy);
}

SurfaceProjection::~SurfaceProjection() = default;

Feet SurfaceProjection::ClosestPoint(const Points& P, int threads) const
{
  Feet feet = MakeFeet(P.rows());
  ParallelFor(static_cast<int>(P.rows()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        Store(feet, i, this->S->Closest(this->S->ToUnit(P, i)));
      }
    });
  return feet;
}

Feet SurfaceProjection::NearestVertices(const Points& P, int k, int threads) const
{
  Feet feet = MakeFeet(P.rows());
  feet.projectionCase.resize(P.rows());
  ParallelFor(static_cast<int>(P.rows()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const auto [foot, firstCase] = this->S->Near(this->S->ToUnit(P, i), k);
        Store(feet, i, foot);
        feet.projectionCase[i] = firstCase;
      }
    });
  return feet;
}

Feet SurfaceProjection::SmallestAngle(const Points& P, const Points& normals, int threads) const
{
  Feet feet = MakeFeet(P.rows());
  feet.byClosestPoint = VectorXi::Zero(P.rows());
  ParallelFor(static_cast<int>(P.rows()), threads,
    [&](int begin, int end)
    {
      AngleSearch search = this->S->MakeAngleSearch();
      for (int i = begin; i < end; ++i)
      {
        const Vector3d p = this->S->ToUnit(P, i);
        Foot foot = this->S->Closest(p);
        Vector3d n = normals.row(i).transpose();
        const bool hasNormal = MakeUnit(n);
        feet.byClosestPoint[i] = hasNormal ? 0 : 1;
        if (hasNormal && foot.square > OnSurface * OnSurface)
        {
          foot = search.Find(p, n, foot);
        }
        Store(feet, i, foot);
      }
    });
  return feet;
}

Feet SurfaceProjection::AlongDirections(
  const Points& P, const Points& directions, int threads) const
{
  Feet feet = MakeFeet(P.rows());
  feet.byClosestPoint = VectorXi::Zero(P.rows());
  ParallelFor(static_cast<int>(P.rows()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const Vector3d p = this->S->ToUnit(P, i);
        Vector3d d = directions.row(i).transpose();
        Foot foot;
        if (!MakeUnit(d) || !(this->S->FirstHit(p, d, foot) || this->S->FirstHit(p, -d, foot)))
        {
          foot = this->S->Closest(p);
          feet.byClosestPoint[i] = 1;
        }
        Store(feet, i, foot);
      }
    });
  return feet;
}
} // namespace SphericalStyle
