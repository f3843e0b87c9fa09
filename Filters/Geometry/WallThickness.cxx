// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "WallThickness.h"

#include "EdgeWeights.h"
#include "FirstHit.h"
#include "Frame.h"
#include "Parallel.h"
#include "SelfIntersections.h"
#include "ShortestPaths.h"
#include "SurfaceMeasures.h"
#include "TriangleTree.h"

#include <Eigen/Geometry>
#include <Eigen/Sparse>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace SphericalStyle
{
namespace
{
constexpr int Passes = 20;
/// Walls become thicker than wanted by this share, so that the rounding of what follows, and the
/// points between those that were looked at, are on the right side.
constexpr double WallSurplus = 0.01;
/// What is missing, or the number of thin points, falls to this share in a pass, or there is no
/// room for more.
constexpr double LeastGain = 0.95;
/// By how much less the surface moves, over the distance, away from a thin wall.
constexpr double WallSlope = 0.5;
/// How often a motion that makes triangles run through each other is halved before the points there
/// stay.
constexpr int Halvings = 2;

/// By how much rays are tilted away from what the one before met, in degrees.
constexpr std::array<double, 3> Tilts = { 0.0, 15.0, 30.0 };

/// The solid of a model whose parts may run through each other.
class Solid
{
public:
  explicit Solid(const TriangleMesh& mesh)
    : Frame(FrameOf(mesh.P))
    , P(Frame.Into(mesh.P))
    , F(mesh.F)
    , Normals(PointNormals(P, F))
    , OfTriangles(TriangleNormals(P, F))
    , Tree(P, F)
  {
  }

  /// Whether another part covers a point: a ray outward leaves more parts than it enters. It is
  /// tilted somewhat: in symmetric models rays along normals meet points and edges.
  bool Covers(int point) const
  {
    const Eigen::Vector3d tilt(0.0071, -0.0113, 0.0094);
    int parts = 0;
    this->Walk(point, (this->Normals.row(point).transpose() + tilt).normalized(), FirstHit::Nothing,
      [&](const Hit& hit)
      {
        parts += hit.isWayOut ? 1 : -1;
        return true;
      });
    return parts > 0;
  }

  struct Wall
  {
    double thickness = std::numeric_limits<double>::infinity(); // length
    int opposite = -1; // triangle that the ray against the normal meets
  };
  /// The wall that a point is on: to where the ray against its normal leaves the parts that it runs
  /// through; or, where that side does not face away, a ray tilted away from it, if longer.
  /// @param reach  length
  Wall FindWall(int point, double reach) const
  {
    const double away = std::cos(WallAngle * Pi / 180.0);
    const Eigen::Vector3d normal = this->Normals.row(point);
    Eigen::Vector3d aside = Eigen::Vector3d::Zero();
    double thickness = 0.0;
    for (const double tilt : Tilts)
    {
      const double angle = tilt * Pi / 180.0;
      const Eigen::Vector3d inward = -std::cos(angle) * normal - std::sin(angle) * aside;
      const auto [length, f] = this->AlongRay(point, inward, reach);
      thickness = std::max(thickness, length);
      if (f < 0)
      {
        break;
      }
      const Eigen::Vector3d side = this->OfTriangles.row(f);
      if (normal.dot(side) <= away)
      {
        return { thickness, tilt == 0.0 ? f : -1 };
      }
      aside = (side - side.dot(normal) * normal).normalized();
    }
    return {};
  }

private:
  struct Hit
  {
    int triangle;
    bool isWayOut; // of a part: the ray meets it from inside
    Eigen::Vector3d barycentric;
  };

  /// What a ray from a point meets, one after the other, until `visit` returns false.
  /// @param reach  fraction of the diagonal
  template <typename Visit>
  void Walk(int point, const Eigen::Vector3d& direction, double reach, const Visit& visit) const
  {
    constexpr int MostCrossings = 200;
    Eigen::Vector3d place = this->P.row(point);
    for (int k = 0; k < MostCrossings; ++k)
    {
      FirstHit ray(this->P, this->F, place, direction, reach);
      ray.SkipPoint(k == 0 ? point : -1);
      ray.Search(this->Tree);
      const int f = ray.GetTriangle();
      if (f < 0 || !visit({ f, this->OfTriangles.row(f).dot(direction) > 0.0, ray.GetPlace() }))
      {
        break;
      }
      place += ray.GetDistance() * direction;
      reach -= ray.GetDistance();
    }
  }

  /// To where a ray inward leaves the last of the parts that it runs through.
  Wall AlongRay(int point, const Eigen::Vector3d& inward, double reach) const
  {
    Wall wall;
    int parts = 1;
    this->Walk(point, inward, reach / this->Frame.scale,
      [&](const Hit& hit)
      {
        parts -= hit.isWayOut ? 1 : -1;
        if (parts == 0)
        {
          const Eigen::RowVector3d opposite =
            hit.barycentric.transpose() * this->P(this->F.row(hit.triangle), AllColumns);
          wall = { this->Frame.scale * (opposite - this->P.row(point)).norm(), hit.triangle };
        }
        return parts > 0;
      });
    return wall;
  }

  SphericalStyle::Frame Frame;
  Points P; // in the frame
  Triangles F;
  Points Normals;
  Points OfTriangles; // normals
  TriangleTree Tree;
};

/// The least field on the edges that is no less than d anywhere, with this slope (Dijkstra).
/// @param aboveBase  becomes that of the point that d comes from
void SpreadAlongEdges(const TriangleMesh& mesh, Eigen::VectorXd& d, std::vector<char>& aboveBase)
{
  std::vector<std::vector<int>> neighbors(mesh.P.rows());
  for (const auto& t : mesh.F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      neighbors[t[k]].push_back(t[(k + 1) % 3]); // of a closed surface each edge has both
    }
  }
  std::vector<int> starts;
  for (int i = 0; i < d.size(); ++i)
  {
    if (d(i) > 0.0)
    {
      starts.push_back(i);
    }
  }
  // The paths along which d falls are those along which the way to no motion becomes longer.
  Eigen::VectorXd ways = -d / WallSlope;
  LowerAlongPaths(ways, starts,
    [&](int i, const auto& visit)
    {
      for (const int j : neighbors[i])
      {
        if (visit(j, (mesh.P.row(i) - mesh.P.row(j)).norm()))
        {
          aboveBase[j] = aboveBase[i];
        }
      }
    });
  d = -WallSlope * ways;
}

/// Normals without what is smaller than h, so that points that are near to each other do not part:
/// (M + h^2 L) N = M n, with the areas M of the points and the Laplacian L of linear elements
/// without its negative weights. Normals of a ball, a rod and a sheet stay as they are, however
/// thin.
Points SmoothNormals(const TriangleMesh& mesh, double h)
{
  const Eigen::Index n = mesh.P.rows();
  if (n == 0)
  {
    return {};
  }
  const Points normals = PointNormals(mesh.P, mesh.F);
  const Eigen::VectorXd areas = PointAreas(mesh.P, mesh.F);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < n; ++i)
  {
    entries.emplace_back(i, i, areas(i));
  }
  const HalfEdgeScalars cotangents = HalfEdgeCotangents(mesh.P, mesh.F);
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int i = mesh.F(f, HalfEdgeStart(k));
      const int j = mesh.F(f, HalfEdgeEnd(k));
      const double weight = h * h * cotangents(f, k);
      if (!(weight > 0.0) || !std::isfinite(weight)) // a triangle without an area has none
      {
        continue;
      }
      entries.emplace_back(i, i, weight);
      entries.emplace_back(j, j, weight);
      entries.emplace_back(i, j, -weight);
      entries.emplace_back(j, i, -weight);
    }
  }
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(A);
  solver.setTolerance(1e-4);
  Points smooth = normals;
  for (int k = 0; k < 3; ++k)
  {
    smooth.col(k) = solver.solveWithGuess(areas.cwiseProduct(normals.col(k)), normals.col(k));
  }
  NormalizeSums(smooth);
  return smooth;
}

/// Marks the corners of triangles that have a marked one.
void GrowByOneRing(const Triangles& F, std::vector<char>& points)
{
  const std::vector<char> before = points;
  for (const auto& t : F.rowwise())
  {
    if (before[t[0]] || before[t[1]] || before[t[2]])
    {
      points[t[0]] = points[t[1]] = points[t[2]] = 1;
    }
  }
}

bool LiesOnGround(const TriangleMesh& mesh, int f, const Ground& ground)
{
  return (mesh.P(mesh.F.row(f), ground.axis).array() == ground.level).all();
}

/// Points on the ground with all their triangles: their side of a wall stays.
std::vector<char> PointsInBase(const TriangleMesh& mesh, const Ground& ground)
{
  std::vector<char> inBase(mesh.P.rows(), 1);
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    if (!LiesOnGround(mesh, f, ground))
    {
      inBase[mesh.F(f, 0)] = inBase[mesh.F(f, 1)] = inBase[mesh.F(f, 2)] = 0;
    }
  }
  return inBase;
}

/// Points of walls whose other side lies on the ground, and stays.
std::vector<char> PointsAboveBase(
  const TriangleMesh& mesh, const Walls& walls, const Ground& ground)
{
  std::vector<char> aboveBase(mesh.P.rows(), 0);
  for (std::size_t i = 0; i < aboveBase.size(); ++i)
  {
    const int f = walls.opposite[i];
    aboveBase[i] = f >= 0 && LiesOnGround(mesh, f, ground) ? 1 : 0;
  }
  return aboveBase;
}

/// How far the points of thin walls have to move: both sides alike, or one of them where the other
/// stays.
/// @param walls  thinner than wanted @param stuck  points without room
Eigen::VectorXd WantedMotions(const TriangleMesh& mesh, const Walls& walls, double wanted,
  const std::vector<char>& stuck, const std::vector<char>& aboveBase)
{
  Eigen::VectorXd d = Eigen::VectorXd::Zero(mesh.P.rows());
  for (Eigen::Index i = 0; i < d.size(); ++i)
  {
    const double missing = wanted - walls.thickness(i);
    if (!(missing > 0.0) || walls.opposite[i] < 0)
    {
      continue;
    }
    d(i) = std::max(d(i), aboveBase[i] ? missing : 0.5 * missing);
    if (stuck[i])
    {
      for (const int j : mesh.F.row(walls.opposite[i]))
      {
        d(j) = std::max(d(j), missing);
      }
    }
  }
  return d;
}

/// How much farther points may move, so that what has no room does not grow elsewhere: half of what
/// is wanted in all, as both sides of a wall without a thickness need; all of it on the ground.
Eigen::VectorXd MotionsLeft(const TriangleMesh& mesh, const TriangleMesh& thick, double wanted,
  const std::vector<char>& aboveBase)
{
  Eigen::VectorXd left = -(thick.P - mesh.P).rowwise().norm();
  for (Eigen::Index i = 0; i < left.size(); ++i)
  {
    left(i) += aboveBase[i] ? wanted : 0.5 * wanted;
  }
  return left.cwiseMax(0.0);
}

/// Where points move: along their normals, and straight up where the other side lies on the ground.
/// There a normal would move the rim of a cut aside, and what is above it would be as sharp as
/// before.
Points Directions(
  const TriangleMesh& mesh, double h, const Ground& ground, const std::vector<char>& aboveBase)
{
  Points directions = SmoothNormals(mesh, h);
  for (Eigen::Index i = 0; i < directions.rows(); ++i)
  {
    if (aboveBase[i])
    {
      directions.row(i) = Eigen::RowVector3d::Unit(ground.axis);
    }
  }
  return directions;
}

/// Corners of triangles that run through each other since points have moved.
/// @param before  triangles that did so already: of a pair not both
/// @return whether there are any
bool FindNewCrossings(const TriangleMesh& mesh, const Points& start,
  const std::vector<char>& before, std::vector<char>& corners)
{
  std::vector<char> moved(mesh.F.rows(), 0); // others are as they were
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    const auto& t = mesh.F.row(f);
    moved[f] = mesh.P(t, AllColumns) != start(t, AllColumns) ? 1 : 0;
  }
  corners.assign(start.rows(), 0);
  bool any = false;
  for (const auto& pair : SelfIntersections(mesh, moved))
  {
    if (before[pair[0]] && before[pair[1]])
    {
      continue;
    }
    any = true;
    for (const int f : pair)
    {
      corners[mesh.F(f, 0)] = corners[mesh.F(f, 1)] = corners[mesh.F(f, 2)] = 1;
    }
  }
  return any;
}

/// Moves points, less where that would make triangles run through each other.
/// @param before  triangles that do so already @param stuck  gets points that had no room
void MoveOutward(TriangleMesh& mesh, const Points& directions, Eigen::VectorXd d,
  const std::vector<char>& before, const Ground& ground, std::vector<char>& stuck,
  const std::function<void()>& onStep)
{
  const Points start = mesh.P;
  for (int k = 0;; ++k)
  {
    onStep();
    mesh.P = start + (directions.array().colwise() * d.array()).matrix();
    // At most half way down to the ground, and on it aside alone.
    const auto lowest = 0.5 * (start.col(ground.axis).array() + ground.level);
    mesh.P.col(ground.axis) = (start.col(ground.axis).array() == ground.level)
                                .select(ground.level, mesh.P.col(ground.axis).array().max(lowest));
    std::vector<char> touched;
    if (!FindNewCrossings(mesh, start, before, touched))
    {
      return; // in the end, as each time one point more stays
    }
    GrowByOneRing(mesh.F, touched);
    for (Eigen::Index i = 0; i < d.size(); ++i)
    {
      if (touched[i])
      {
        d(i) *= k < Halvings ? 0.5 : 0.0;
        stuck[i] = 1;
      }
    }
  }
}
}

Walls FindWalls(const TriangleMesh& mesh, int threads, double reach)
{
  const auto n = static_cast<int>(mesh.P.rows());
  Walls walls = { Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity()),
    std::vector<int>(n, -1) };
  if (mesh.F.rows() == 0)
  {
    return walls;
  }
  const Solid solid(mesh);
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const auto [thickness, opposite] = solid.FindWall(i, reach);
        if (std::isfinite(thickness) && !solid.Covers(i))
        {
          walls.thickness(i) = thickness;
          walls.opposite[i] = opposite;
        }
      }
    });
  return walls;
}

Points ThickenWalls(const TriangleMesh& mesh, double thickness, int threads, const Ground& ground,
  const std::function<void()>& onStep)
{
  TriangleMesh thick = mesh;
  std::vector<char> intersecting;
  std::vector<char> stuck = PointsInBase(mesh, ground);
  Points best = mesh.P;
  double least = std::numeric_limits<double>::infinity();
  double fewest = least;
  for (int pass = 0;; ++pass)
  {
    onStep();
    const double wanted = (1.0 + WallSurplus) * thickness;
    const Walls walls = FindWalls(thick, threads, wanted);
    const double missing = (thickness - walls.thickness.array().min(thickness)).sum();
    const auto thin = static_cast<double>((walls.thickness.array() < thickness).count());
    const bool isWorthMore = missing <= LeastGain * least || thin <= LeastGain * fewest;
    fewest = std::min(fewest, thin);
    if (missing < least)
    {
      least = missing;
      best = thick.P;
    }
    if (missing == 0.0 || !isWorthMore || pass == Passes)
    {
      break;
    }
    std::vector<char> aboveBase = PointsAboveBase(thick, walls, ground);
    const Eigen::VectorXd left = MotionsLeft(mesh, thick, wanted, aboveBase);
    Eigen::VectorXd d = WantedMotions(thick, walls, wanted, stuck, aboveBase).cwiseMin(left);
    SpreadAlongEdges(thick, d, aboveBase);
    d = d.cwiseMin(left);
    if (pass == 0)
    {
      intersecting = IntersectingTriangles(mesh);
    }
    const Points directions = Directions(thick, d.maxCoeff(), ground, aboveBase);
    MoveOutward(thick, directions, std::move(d), intersecting, ground, stuck, onStep);
  }
  return best;
}
} // namespace SphericalStyle
