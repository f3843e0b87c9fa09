// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Feet on a proxy against searches over all its triangles that are written another way.
#include "Check.h"
#include "Meshes.h"
#include "SurfaceProjection.h"

#include <Eigen/LU>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Degree = Pi / 180.0;

Vector3d Corner(const TriangleMesh& mesh, int f, int k)
{
  return mesh.P.row(mesh.F(f, k)).transpose();
}

// Ericson, Real-Time Collision Detection, 5.1.5: by the region of the plane that p is above.
Vector3d ClosestByRegion(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const Vector3d ab = b - a, ac = c - a;
  const double d1 = ab.dot(p - a), d2 = ac.dot(p - a);
  const double d3 = ab.dot(p - b), d4 = ac.dot(p - b);
  const double d5 = ab.dot(p - c), d6 = ac.dot(p - c);
  if (d1 <= 0 && d2 <= 0)
  {
    return a;
  }
  if (d3 >= 0 && d4 <= d3)
  {
    return b;
  }
  if (d6 >= 0 && d5 <= d6)
  {
    return c;
  }
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0)
  {
    return a + d1 / (d1 - d3) * ab;
  }
  if (vb <= 0 && d2 >= 0 && d6 <= 0)
  {
    return a + d2 / (d2 - d6) * ac;
  }
  if (va <= 0 && d4 >= d3 && d5 >= d6)
  {
    return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
  }
  return a + (vb * ab + vc * ac) / (va + vb + vc);
}

Vector3d ClosestOfAll(const TriangleMesh& mesh, const Vector3d& p)
{
  Vector3d best = Vector3d::Constant(Infinity);
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    const Vector3d q =
      ClosestByRegion(p, Corner(mesh, f, 0), Corner(mesh, f, 1), Corner(mesh, f, 2));
    if (!best.allFinite() || (q - p).norm() < (best - p).norm())
    {
      best = q;
    }
  }
  return best;
}

// Moeller and Trumbore. @return the least length >= 0 along d, or infinity
double FirstHitOfAll(const TriangleMesh& mesh, const Vector3d& p, const Vector3d& d)
{
  double best = Infinity;
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    const Vector3d a = Corner(mesh, f, 0), e1 = Corner(mesh, f, 1) - a, e2 = Corner(mesh, f, 2) - a;
    const Vector3d h = d.cross(e2);
    const double det = e1.dot(h);
    const double u = (p - a).dot(h) / det;
    const Vector3d g = (p - a).cross(e1);
    const double v = d.dot(g) / det, t = e2.dot(g) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && t >= 0)
    {
      best = std::min(best, t);
    }
  }
  return best;
}

// The definition: every orthogonal foot that is not too far and the nearest point, then the rule of
// one degree.
Vector3d SmallestAngleOfAll(const TriangleMesh& mesh, const Vector3d& p, const Vector3d& n)
{
  struct Candidate
  {
    double angle;
    Vector3d q;
  };
  const auto angle = [&](const Vector3d& v) -> double
  { return std::atan2(v.cross(n).norm(), std::abs(v.dot(n))); };
  const Vector3d closest = ClosestOfAll(mesh, p);
  const double farthest = std::max(0.15 * Meshes::Diagonal(mesh.P), 2.0 * (closest - p).norm());
  std::vector<Candidate> candidates = { { angle(closest - p), closest } };
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    Eigen::Matrix3d M;
    M.col(0) = Corner(mesh, f, 1) - Corner(mesh, f, 0);
    M.col(1) = Corner(mesh, f, 2) - Corner(mesh, f, 0);
    M.col(2) = M.col(0).cross(M.col(1)).normalized();
    const Vector3d x = M.inverse() * (p - Corner(mesh, f, 0));
    if (x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1 && std::abs(x[2]) <= farthest)
    {
      candidates.push_back({ angle(M.col(2)), p - x[2] * M.col(2) });
    }
  }
  double smallest = Infinity;
  for (const Candidate& c : candidates)
  {
    smallest = std::min(smallest, c.angle);
  }
  Vector3d best = Vector3d::Constant(Infinity);
  for (const Candidate& c : candidates)
  {
    if (c.angle <= smallest + Degree && !((c.q - p).norm() >= (best - p).norm()))
    {
      best = c.q;
    }
  }
  return best;
}

// Points in the mesh's box, made larger by a factor.
Points Around(const TriangleMesh& mesh, int n, double factor, std::uint32_t seed)
{
  Meshes::Random random(seed);
  const Eigen::RowVector3d low = mesh.P.colwise().minCoeff(), high = mesh.P.colwise().maxCoeff();
  Points P(n, 3);
  for (int i = 0; i < n; ++i)
  {
    P.row(i) =
      0.5 * (low + high) + 0.5 * factor * random.InCube().transpose().cwiseProduct(high - low);
  }
  return P;
}

Points Directions(int n, std::uint32_t seed)
{
  Meshes::Random random(seed);
  Points D(n, 3);
  for (int i = 0; i < n; ++i)
  {
    D.row(i) = random.InCube().transpose();
  }
  return D;
}

// Points on the mesh, moved by up to height to both sides.
Points NearSurface(const TriangleMesh& mesh, int n, double height, std::uint32_t seed)
{
  Meshes::Random random(seed);
  Points P(n, 3);
  for (int i = 0; i < n; ++i)
  {
    const int f = static_cast<int>(random.Unit() * mesh.F.rows());
    double u = random.Unit(), v = random.Unit();
    if (u + v > 1.0)
    {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Vector3d a = Corner(mesh, f, 0), e1 = Corner(mesh, f, 1) - a, e2 = Corner(mesh, f, 2) - a;
    P.row(i) =
      (a + u * e1 + v * e2 + height * random.Signed() * e1.cross(e2).normalized()).transpose();
  }
  return P;
}

bool SameBits(const Feet& a, const Feet& b)
{
  return a.cell == b.cell && Meshes::SameBits(a.barycentric, b.barycentric) &&
    a.projectionCase.size() == b.projectionCase.size() &&
    (a.projectionCase.array() == b.projectionCase.array()).all() &&
    a.byClosestPoint.size() == b.byClosestPoint.size() &&
    (a.byClosestPoint.array() == b.byClosestPoint.array()).all();
}

// What holds for all feet. @return their places
Points CheckFeet(const TriangleMesh& mesh, const Feet& feet, int n, const std::string& what)
{
  CHECK(feet.cell.size() == n && feet.barycentric.rows() == n, what << ": one foot per point");
  for (int i = 0; i < n; ++i)
  {
    CHECK(feet.cell[i] >= 0 && feet.cell[i] < mesh.F.rows(),
      what << ": cell " << feet.cell[i] << " of point " << i);
    CHECK(feet.barycentric.row(i).minCoeff() >= 0.0,
      what << ": coefficients of point " << i << ": " << feet.barycentric.row(i));
    CHECK_NEAR(feet.barycentric.row(i).sum(), 1.0, 1e-15, what << ": sum of coefficients of " << i);
  }
  return Interpolate(mesh.F, feet, mesh.P);
}

// --------------------------------------------------------------------------------- one triangle
// q is the nearest point of a convex set if and only if no corner lies on p's side of the plane
// through q that is perpendicular to p - q.
void CheckBarycentric(const Vector3d& p, const Vector3d& A, const Vector3d& B, const Vector3d& C,
  double scale, const std::string& what)
{
  const Vector3d b = ClosestBarycentric(p, A, B, C);
  CHECK(b.allFinite() && b.minCoeff() >= 0.0, what << ": coefficients " << b.transpose());
  CHECK_NEAR(b.sum(), 1.0, 1e-15, what << ": sum");
  const Vector3d q = b[0] * A + b[1] * B + b[2] * C;
  for (const Vector3d& x : { A, B, C })
  {
    CHECK((x - q).dot(p - q) <= 1e-12 * scale * scale,
      what << ": the corner " << x.transpose() << " is nearer to " << p.transpose() << " than q by "
           << (x - q).dot(p - q) / (scale * scale));
  }
}

void TestBarycentric()
{
  Meshes::Random random(1);
  for (const double scale : { 1e-8, 1.0, 1e8 })
  {
    const std::string at = " at scale " + std::to_string(std::log10(scale));
    for (int k = 0; k < 3000; ++k)
    {
      const Vector3d A = scale * random.InCube(), B = scale * random.InCube();
      const Vector3d C = scale * random.InCube(), p = 2.0 * scale * random.InCube();
      CheckBarycentric(p, A, B, C, scale, "random" + at);
      const Vector3d q = ClosestByRegion(p, A, B, C);
      const Vector3d b = ClosestBarycentric(p, A, B, C);
      CHECK((b[0] * A + b[1] * B + b[2] * C - q).norm() <= 1e-11 * scale,
        "the nearest point" << at << " should be that of the regions");
      // A5.8: the coefficients of a point of the triangle are found again, q to 1e-12.
      double u = random.Unit(), v = random.Unit() * (1.0 - u);
      const Vector3d inside = (1.0 - u - v) * A + u * B + v * C;
      const Vector3d found = ClosestBarycentric(inside, A, B, C);
      CHECK((found[0] * A + found[1] * B + found[2] * C - inside).norm() <= 1e-12 * scale,
        "a point of the triangle" << at << " should be found again");
      const double height = (B - A).cross(C - A).norm() / (scale * scale);
      CHECK((found - Vector3d(1.0 - u - v, u, v)).norm() <= 1e-13 / std::min(1.0, height * height),
        "coefficients" << at << " are " << found.transpose());
      // Without area: three points of a line, two equal points, one point.
      const double t = 3.0 * random.Signed();
      CheckBarycentric(p, A, B, A + t * (B - A), 4.0 * scale, "on a line" + at);
      CheckBarycentric(p, A, A, B, scale, "A = B" + at);
      CheckBarycentric(p, A, B, A, scale, "A = C" + at);
      CheckBarycentric(p, B, A, A, scale, "B = C" + at);
      CheckBarycentric(p, A, A, A, scale, "a point" + at);
      const Vector3d thin = 0.5 * (A + B) + std::pow(10.0, -14.0 * random.Unit()) * (C - A);
      CheckBarycentric(p, A, B, thin, 2.0 * scale, "a sliver" + at);
    }
    // Each pair of axes, where the thesis' equations divide by 0 or change the branch.
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector3d e1 = scale * Vector3d::Unit((axis + 1) % 3);
      const Vector3d e2 = scale * Vector3d::Unit((axis + 2) % 3), up = scale * Vector3d::Unit(axis);
      const Vector3d p = 0.25 * e1 + 0.5 * e2 + 3.0 * up;
      CHECK(
        (ClosestBarycentric(p, up, up + e1, up + e2) - Vector3d(0.25, 0.25, 0.5)).norm() <= 1e-15,
        "a triangle perpendicular to axis " << axis << at);
      CHECK(ClosestBarycentric(up + e1, up, up + e1, up + e2) == Vector3d(0, 1, 0),
        "a corner of it" << at);
      CHECK((ClosestBarycentric(up + 2 * e1 + 2 * e2, up, up + e1, up + e2) - Vector3d(0, 0.5, 0.5))
              .norm() <= 1e-15,
        "beyond its long edge" << at);
    }
  }
}

// --------------------------------------------------------------------------------- the nearest
void TestClosestPoint()
{
  const std::vector<Meshes::Named> proxies = { { "icosphere", Meshes::Icosphere(2) },
    { "ellipsoid", Meshes::Ellipsoid(2) }, { "box", Meshes::Box(4, { 1, 0.5, 2 }) },
    { "slivers", Meshes::Slivers() }, { "two parts", Meshes::TwoComponents() },
    { "open", Meshes::Patch(10, 0.4) }, { "fan", Meshes::NonManifoldFan() } };
  double worst = 0.0;
  for (const auto& [name, mesh] : proxies)
  {
    const int n = 10000;
    const Points P = Around(mesh, n, 1.5, 2);
    const double diagonal = Meshes::Diagonal(mesh.P);
    const Points Q = CheckFeet(mesh, SurfaceProjection(mesh).ClosestPoint(P, 2), n, name);
    int ties = 0;
    for (int i = 0; i < n; ++i)
    {
      const Vector3d p = P.row(i).transpose(), q = ClosestOfAll(mesh, p);
      const double error = std::abs((Q.row(i).transpose() - p).norm() - (q - p).norm()) / diagonal;
      worst = std::max(worst, error);
      CHECK(error <= 1e-12, name << ": the distance of point " << i << " is off by " << error);
      ties += (Q.row(i).transpose() - q).norm() > 1e-9 * diagonal ? 1 : 0;
    }
    CHECK(ties == 0, name << ": " << ties << " feet stand elsewhere");
  }
  std::cout << "distances to the nearest point differ by " << worst << " of the diagonal"
            << std::endl;
}

void TestPointsOnTheProxy()
{
  const TriangleMesh mesh = Meshes::Icosphere(2);
  const SurfaceProjection projection(mesh);
  const int n = mesh.P.rows(), m = mesh.F.rows();
  const Points normals = Points::Ones(n, 3);
  const Feet atPoints = projection.ClosestPoint(mesh.P, 1);
  CHECK(Meshes::SameBits(Interpolate(mesh.F, atPoints, mesh.P), mesh.P),
    "the feet of the proxy's own points should be these points to the last bit");
  for (int i = 0; i < n; ++i)
  {
    int lowest = 0;
    while ((mesh.F.row(lowest).array() != i).all())
    {
      ++lowest;
    }
    CHECK(atPoints.cell[i] == lowest, "of the triangles at point " << i << " the first is taken");
  }
  Feet angle = projection.SmallestAngle(mesh.P, normals, 1);
  CHECK(angle.byClosestPoint.isZero(), "points on the proxy need no stand-in");
  angle.byClosestPoint.resize(0);
  CHECK(SameBits(angle, atPoints), "points on the proxy have no projection vector: nearest point");
  CHECK(Meshes::Distance(
          Interpolate(mesh.F, projection.NearestVertices(mesh.P, 4, 1), mesh.P), mesh.P) <= 1e-12,
    "the thesis' search should find the proxy's own points");
  Points middles(3 * m, 3), D(3 * m, 3);
  for (int f = 0; f < m; ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      middles.row(3 * f + k) =
        0.5 * (Corner(mesh, f, k) + Corner(mesh, f, (k + 1) % 3)).transpose();
      D.row(3 * f + k) = middles.row(3 * f + k);
    }
  }
  const Feet onEdges = projection.NearestVertices(middles, 4, 1);
  CHECK(Meshes::Distance(Interpolate(mesh.F, onEdges, mesh.P), middles) <= 1e-12,
    "the thesis' search should find middles of edges");
  CHECK((onEdges.projectionCase.array() == SeveralFeet).all(),
    "a point on an edge has feet in both triangles");
  CHECK(Meshes::Distance(
          Interpolate(mesh.F, projection.ClosestPoint(middles, 1), mesh.P), middles) <= 1e-15,
    "middles of edges are on the proxy");
  // No ray slips through between two triangles, or starts behind the one it starts on.
  for (const double share : { 0.0, 0.5, 1.0 })
  {
    const Feet hit = projection.AlongDirections(share * middles, D, 1);
    CHECK(hit.byClosestPoint.isZero(), "rays through edges should hit, from " << share);
    CHECK(Meshes::Distance(Interpolate(mesh.F, hit, mesh.P), middles) <= 1e-12,
      "rays through edges should hit these edges, from " << share);
  }
  const Feet hit = projection.AlongDirections(0.1 * mesh.P, mesh.P, 1);
  CHECK(Meshes::Distance(Interpolate(mesh.F, hit, mesh.P), mesh.P) <= 1e-12,
    "rays through points should hit these points");
}

// --------------------------------------------------------------------------------- the thesis
struct Comparison
{
  int one = 0, several = 0, none = 0;
  int farther = 0;         // than the nearest point
  int fartherWithFoot = 0; // in cases 1 and 2
  double excess = 0.0;
};

Comparison CompareWithExact(const TriangleMesh& mesh, const Points& P, int k, const char* what)
{
  const SurfaceProjection projection(mesh);
  const int n = P.rows();
  const Feet feet = projection.NearestVertices(P, k, 2);
  const Points Q = CheckFeet(mesh, feet, n, what);
  const Points E = Interpolate(mesh.F, projection.ClosestPoint(P, 2), mesh.P);
  Comparison result;
  for (int i = 0; i < n; ++i)
  {
    const double excess = (Q.row(i) - P.row(i)).norm() - (E.row(i) - P.row(i)).norm();
    CHECK(excess >= -1e-12, what << ": nothing is nearer than the nearest point, by " << excess);
    const bool farther = excess > 1e-9;
    result.farther += farther ? 1 : 0;
    result.fartherWithFoot += farther && feet.projectionCase[i] != NoFoot ? 1 : 0;
    result.excess = std::max(result.excess, excess);
    result.one += feet.projectionCase[i] == OneFoot ? 1 : 0;
    result.several += feet.projectionCase[i] == SeveralFeet ? 1 : 0;
    result.none += feet.projectionCase[i] == NoFoot ? 1 : 0;
  }
  CHECK(result.one + result.several + result.none == n, what << ": every point has a case");
  std::cout << what << ": cases " << result.one << ", " << result.several << ", " << result.none
            << "; farther than the nearest point: " << result.farther << " of " << n
            << ", by up to " << result.excess << std::endl;
  return result;
}

// Points of the ellipsoid that a mesh was made from, moved along their rays by up to a share: many
// of those outside are above an edge, where no triangle holds a foot.
Points NearEllipsoid(const TriangleMesh& mesh, int n, double share, std::uint32_t seed)
{
  Meshes::Random random(seed);
  const Eigen::RowVector3d half = mesh.P.cwiseAbs().colwise().maxCoeff();
  Points P(n, 3);
  for (int i = 0; i < n; ++i)
  {
    const Vector3d d = random.InCube().normalized();
    P.row(i) = (1.0 + share * random.Signed()) * d.transpose().cwiseProduct(half);
  }
  return P;
}

void TestNearestVertices()
{
  const int n = 5000;
  const TriangleMesh even = Meshes::Icosphere(3);
  const Comparison above = CompareWithExact(even, NearSurface(even, n, 0.05, 3), 4, "even");
  CHECK(above.farther == 0, "above the triangles of an even proxy the search should be exact");
  CHECK(above.one > n / 2 && above.several > 0, "cases 1 and 2 should occur");
  const Comparison beside = CompareWithExact(even, NearEllipsoid(even, n, 0.1, 3), 4, "even, all");
  CHECK(beside.one > n / 2 && beside.several > 0 && beside.none > 0, "all cases should occur");
  CHECK(beside.fartherWithFoot == 0, "on an even proxy only points of case 3 should differ");
  CHECK(beside.excess < 0.05, "on an even proxy feet should be off by less than half of p q");
  const TriangleMesh thin = Meshes::EllipsoidUV(8, 100);
  const Points P = NearEllipsoid(thin, n, 0.1, 4);
  const Comparison four = CompareWithExact(thin, P, 4, "slivers, k = 4");
  CHECK(four.farther > n / 5, "slivers should mislead the search");
  CHECK(four.none > n / 5, "slivers should lead to case 3");
  const Comparison forty = CompareWithExact(thin, P, 40, "slivers, k = 40");
  CHECK(forty.farther < four.farther / 4, "more points should mislead less");
  const TriangleMesh box = Meshes::Box(1);
  const Comparison all = CompareWithExact(box, Around(box, n, 0.99, 5), 100, "a cube, k = all");
  CHECK(all.farther == 0 && all.several == n, "a cube, all looked at: at least six feet, exact");
  CompareWithExact(box, Around(box, 100, 2.0, 6), 0, "k = 0 counts as 1");
}

// A point beside a square: no triangle holds its foot, and projecting again never ends.
void TestNoFootAtAll()
{
  const TriangleMesh square = Meshes::Make(
    { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 }, { 0, 2, 3 } });
  Points P(1, 3);
  P << 3.0, 0.5, 2.0;
  const Feet feet = SurfaceProjection(square).NearestVertices(P, 4, 1);
  CHECK(feet.projectionCase[0] == NoFoot, "case 3");
  CHECK(Meshes::Distance(
          Interpolate(square.F, feet, square.P), Points(Eigen::RowVector3d(1, 0.5, 0))) <= 1e-15,
    "case 3 should end at the nearest point of the candidates");
  // Thesis 5.3.1 (4) III: above a roof beyond the ridge, the foot outside has a foot itself.
  const TriangleMesh roof = Meshes::Make(
    { { -2, -1, -1 }, { -2, 1, -1 }, { 2, -1, -1.2 }, { 2, 1, -1.2 }, { 0, -1, 0 }, { 0, 1, 0 } },
    { { 0, 4, 5 }, { 0, 5, 1 }, { 4, 2, 3 }, { 4, 3, 5 } });
  P << 0.05, 0.2, 1.0;
  const Feet ridge = SurfaceProjection(roof).NearestVertices(P, 6, 1);
  CHECK(ridge.projectionCase[0] == NoFoot, "above the ridge neither side holds a foot");
  TriangleMesh flipped = roof;
  flipped.F.col(0).swap(flipped.F.col(1));
  CHECK(Meshes::Distance(
          Interpolate(flipped.F, SurfaceProjection(flipped).NearestVertices(P, 6, 1), roof.P),
          Interpolate(roof.F, ridge, roof.P)) <= 1e-15,
    "the orientation of the proxy should not matter");
  // By hand: the left plane z = x / 2 is nearest to p, its foot lies above the right side, whose
  // plane z = -0.6 x takes it.
  const Vector3d left = Vector3d(-0.5, 0, 1).normalized(), right = Vector3d(0.6, 0, 1).normalized();
  const Vector3d p(0.05, 0.2, 1.0);
  const Vector3d first = std::abs(left.dot(p)) < std::abs(right.dot(p))
    ? Vector3d(p - left.dot(p) * left)
    : Vector3d(p - right.dot(p) * right);
  const bool fromLeft = std::abs(left.dot(p)) < std::abs(right.dot(p));
  const Vector3d& other = fromLeft ? right : left;
  const Vector3d second = first - other.dot(first) * other;
  CHECK((Interpolate(roof.F, ridge, roof.P).row(0).transpose() - second).norm() <= 1e-12,
    "the foot outside should be projected to the other side: "
      << second.transpose() << ", is " << Interpolate(roof.F, ridge, roof.P).row(0));
}

// --------------------------------------------------------------------------------- angles
void TestSmallestAngle()
{
  for (const auto& [name, mesh] :
    { Meshes::Named{ "ellipsoid", Meshes::Ellipsoid(2) }, Meshes::Named{ "box", Meshes::Box(3) },
      Meshes::Named{ "house", Meshes::House() }, Meshes::Named{ "two", Meshes::TwoComponents() },
      Meshes::Named{ "open", Meshes::Patch(8, 0.5) } })
  {
    const int n = 4000;
    const SurfaceProjection projection(mesh);
    const Points P = Around(mesh, n, 1.2, 7), N = Directions(n, 8);
    const Feet feet = projection.SmallestAngle(P, N, 2);
    const Points Q = CheckFeet(mesh, feet, n, name);
    int differ = 0;
    for (int i = 0; i < n; ++i)
    {
      const Vector3d q = SmallestAngleOfAll(mesh, P.row(i).transpose(), N.row(i).transpose());
      CHECK((Q.row(i).transpose() - q).norm() <= 1e-9,
        name << ": the foot of point " << i << " is " << Q.row(i) << ", should be "
             << q.transpose());
    }
    const Points C = Interpolate(mesh.F, projection.ClosestPoint(P, 2), mesh.P);
    differ = static_cast<int>(((Q - C).rowwise().norm().array() > 1e-6).count());
    CHECK(differ > n / 20, name << ": only " << differ << " feet are not the nearest points");
    CHECK(SameBits(projection.SmallestAngle(P, -1e5 * N, 1), feet),
      name << ": the sign and length of the normals should not matter");
    CHECK(Meshes::Distance(Interpolate(mesh.F, projection.SmallestAngle(P, C - P, 1), mesh.P), C) <=
        1e-9,
      name << ": normals towards the nearest points should give these");
    Feet none = projection.SmallestAngle(P, Points::Zero(n, 3), 1);
    CHECK((none.byClosestPoint.array() == 1).all(), name << ": normals of length 0 are counted");
    none.byClosestPoint.resize(0);
    CHECK(
      SameBits(none, projection.ClosestPoint(P, 1)), name << ": without normals: nearest points");
    CHECK(feet.byClosestPoint.isZero(), name << ": with normals nothing stands in");
  }
}

// The door of thesis 5.5: a point of a recess in the front, near the floor.
void TestRecess()
{
  const TriangleMesh box = Meshes::Box(4, { 1, 1, 1 });
  const SurfaceProjection projection(box);
  Points P(1, 3), N(1, 3);
  P << 0.1, -0.5, -0.93;
  CHECK(Meshes::Distance(Interpolate(box.F, projection.ClosestPoint(P, 1), box.P),
          Points(Eigen::RowVector3d(0.1, -0.5, -1))) <= 1e-15,
    "the nearest point of the door should lie on the floor");
  for (const double tilt : { 0.0, 0.4, -0.4 })
  {
    N << 0.2, -1.0, tilt;
    CHECK(Meshes::Distance(Interpolate(box.F, projection.SmallestAngle(P, N, 1), box.P),
            Points(Eigen::RowVector3d(0.1, -1, -0.93))) <= 1e-14,
      "the foot of the smallest angle should lie on the front");
  }
  // On the floor but for rounding: no projection vector, so no angle.
  P << 0.1, -0.5, -1.0 + 1e-12;
  N << 0.0, -1.0, 0.0;
  CHECK(Meshes::Distance(Interpolate(box.F, projection.SmallestAngle(P, N, 1), box.P), P) <= 1e-11,
    "a point on the floor should stay there");
}

// Two plates above the point: the nearer one is tilted.
void TestOneDegree()
{
  for (const double tilt : { 0.0, 0.5, 0.9, 1.1, 2.0, 30.0 })
  {
    const double slope = std::tan(tilt * Degree);
    const TriangleMesh plates =
      Meshes::Make({ { -5, -5, 1 - 5 * slope }, { 9, -5, 1 + 9 * slope }, { -5, 9, 1 - 5 * slope },
                     { -5, -5, 2 }, { 9, -5, 2 }, { -5, 9, 2 }, { 0.1, 0.1, 0.2 },
                     { 0.2, 0.1, 0.2 }, { 0.1, 0.1, 0.3 } },
        { { 0, 1, 2 }, { 3, 4, 5 }, { 6, 7, 8 } });
    Points P = Points::Zero(1, 3), N(1, 3);
    N << 0, 0, 1;
    const int cell = SurfaceProjection(plates).SmallestAngle(P, N, 1).cell[0];
    CHECK(cell == (tilt < 1.0 ? 0 : 1), "tilted by " << tilt << " degrees the foot is on " << cell);
  }
}

// --------------------------------------------------------------------------------- directions
void TestAlongDirections()
{
  int forward = 0, backward = 0, standIn = 0;
  for (const auto& [name, mesh] : { Meshes::Named{ "sphere", Meshes::Icosphere(2) },
         Meshes::Named{ "box", Meshes::Box(3) }, Meshes::Named{ "fan", Meshes::NonManifoldFan() } })
  {
    const int n = 5000;
    const SurfaceProjection projection(mesh);
    const Points P = Around(mesh, n, 1.6, 9), D = Directions(n, 10);
    const Feet feet = projection.AlongDirections(P, D, 2);
    const Points Q = CheckFeet(mesh, feet, n, name);
    for (int i = 0; i < n; ++i)
    {
      const Vector3d p = P.row(i).transpose(), d = D.row(i).transpose().normalized();
      const double ahead = FirstHitOfAll(mesh, p, d), behind = FirstHitOfAll(mesh, p, -d);
      const bool hits = ahead < Infinity || behind < Infinity;
      Vector3d expected = ClosestOfAll(mesh, p);
      if (hits)
      {
        expected = p + (ahead < Infinity ? ahead : -behind) * d;
      }
      CHECK((Q.row(i).transpose() - expected).norm() <= 1e-10,
        name << ": the foot of point " << i << " is " << Q.row(i) << ", should be "
             << expected.transpose());
      CHECK(feet.byClosestPoint[i] == (hits ? 0 : 1), name << ": stand-in of point " << i);
      (ahead < Infinity ? forward : hits ? backward : standIn) += 1;
    }
    CHECK(SameBits(projection.AlongDirections(P, std::ldexp(1.0, -600) * D, 1), feet),
      name << ": the length of directions should not matter");
    Feet none = projection.AlongDirections(P, Points::Zero(n, 3), 1);
    CHECK((none.byClosestPoint.array() == 1).all(), name << ": directions of length 0 are counted");
    none.byClosestPoint.resize(0);
    CHECK(SameBits(none, projection.ClosestPoint(P, 1)), name << ": without: nearest points");
  }
  CHECK(forward > 1000 && backward > 1000 && standIn > 1000,
    "all branches: " << forward << ", " << backward << ", " << standIn);

  const TriangleMesh sphere = Meshes::Icosphere(3);
  const Points outside = 1.02 * NearSurface(sphere, 1000, 0.0, 11);
  const Feet behind = SurfaceProjection(sphere).AlongDirections(outside, outside, 1);
  const Points Q = Interpolate(sphere.F, behind, sphere.P);
  CHECK(behind.byClosestPoint.isZero() && Meshes::Distance(Q, outside / 1.02) <= 1e-12,
    "points just outside should find the near side behind them");
  // Along the axes of a box: flat boxes, rays in planes of sides, through edges and points.
  const TriangleMesh box = Meshes::Box(2);
  const SurfaceProjection projection(box);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < 25; ++i)
    {
      Points P(1, 3), D = Points::Zero(1, 3);
      P(0, axis) = 0.125;
      P(0, (axis + 1) % 3) = -1.0 + 0.5 * (i % 5);
      const int row = i / 5;
      P(0, (axis + 2) % 3) = -1.0 + 0.5 * row;
      D(0, axis) = -2.0;
      Points expected = P;
      expected(0, axis) = -1.0;
      const Feet hit = projection.AlongDirections(P, D, 1);
      CHECK(hit.byClosestPoint[0] == 0 &&
          Meshes::Distance(Interpolate(box.F, hit, box.P), expected) <= 1e-14,
        "from " << P << " along axis " << axis << " the box is met at "
                << Interpolate(box.F, hit, box.P));
    }
  }
}

// --------------------------------------------------------------------------------- all of them
using Search = std::function<Feet(const SurfaceProjection&, const Points&, int)>;

std::vector<std::pair<std::string, Search>> AllSearches()
{
  return { { "ClosestPoint",
             [](const SurfaceProjection& s, const Points& P, int threads)
             { return s.ClosestPoint(P, threads); } },
    { "NearestVertices",
      [](const SurfaceProjection& s, const Points& P, int threads)
      { return s.NearestVertices(P, 4, threads); } },
    { "SmallestAngle",
      [](const SurfaceProjection& s, const Points& P, int threads)
      { return s.SmallestAngle(P, Directions(P.rows(), 12), threads); } },
    { "AlongDirections", [](const SurfaceProjection& s, const Points& P, int threads) {
       return s.AlongDirections(P, Directions(P.rows(), 13), threads);
     } } };
}

void TestThreads()
{
  const TriangleMesh mesh = Meshes::TwoComponents();
  const SurfaceProjection projection(mesh);
  // Near and far, and the proxy's points, which are ties between many triangles.
  Points P = Around(mesh, 20000, 1.3, 14);
  P.topRows(mesh.P.rows()) = mesh.P;
  for (const auto& [name, search] : AllSearches())
  {
    const Feet one = search(projection, P, 1);
    for (const int threads : { 2, 3, 7 })
    {
      CHECK(SameBits(search(projection, P, threads), one),
        name << ": " << threads << " threads should give the same bits as one");
    }
    CHECK(SameBits(search(SurfaceProjection(mesh), P, 1), one), name << ": the same bits again");
    CHECK(search(projection, Points(0, 3), 2).cell.size() == 0, name << ": no points, no feet");
  }
}

void TestScaleAndPlace()
{
  const TriangleMesh mesh = Meshes::Ellipsoid(2);
  const Points P = Around(mesh, 3000, 1.3, 15);
  const SurfaceProjection projection(mesh);
  for (const auto& [name, search] : AllSearches())
  {
    const Feet feet = search(projection, P, 1);
    const Points Q = Interpolate(mesh.F, feet, mesh.P);
    for (const double power : { std::ldexp(1.0, -200), std::ldexp(1.0, 300) })
    {
      const TriangleMesh scaled{ power * mesh.P, mesh.F };
      CHECK(SameBits(search(SurfaceProjection(scaled), power * P, 1), feet),
        name << ": scaled by a power of two the bits should stay, factor " << power);
    }
    for (const double factor : { 1e-8, 1e8 })
    {
      const TriangleMesh scaled{ factor * mesh.P, mesh.F };
      const Feet other = search(SurfaceProjection(scaled), factor * P, 1);
      CHECK(Meshes::Distance(Interpolate(mesh.F, other, mesh.P), Q) <= 1e-11,
        name << ": feet should scale with the model, factor " << factor);
    }
    TriangleMesh moved = mesh;
    const Eigen::RowVector3d far(1e6, -2e6, 3e6);
    moved.P.rowwise() += far;
    const Points there = P.rowwise() + far;
    // Rounded places are what both see.
    TriangleMesh back = moved;
    back.P.rowwise() -= far;
    const Points here = there.rowwise() - far;
    const Points A = Interpolate(mesh.F, search(SurfaceProjection(moved), there, 1), back.P);
    const Points B = Interpolate(mesh.F, search(SurfaceProjection(back), here, 1), back.P);
    CHECK(Meshes::Distance(A, B) <= 1e-12,
      name << ": far from the origin the feet should be the same, "
              "differ by "
           << Meshes::Distance(A, B));
  }
}

void TestInterpolate()
{
  const TriangleMesh mesh = Meshes::Box(3);
  const Points P = Around(mesh, 500, 1.3, 16);
  const Feet feet = SurfaceProjection(mesh).ClosestPoint(P, 1);
  Points x = mesh.P; // an affine map of the proxy maps the feet
  const Eigen::Matrix3d M = Meshes::Random(17).Matrix();
  x = ((mesh.P * M).rowwise() + Eigen::RowVector3d(1, 2, 3)).eval();
  const Points Q = Interpolate(mesh.F, feet, mesh.P);
  CHECK(Meshes::Distance(Interpolate(mesh.F, feet, x),
          Points((Q * M).rowwise() + Eigen::RowVector3d(1, 2, 3))) <= 1e-14,
    "feet should follow the proxy");
}

void TestDegenerate()
{
  CHECK_THROWS(std::invalid_argument,
    SurfaceProjection({ Meshes::Icosphere(0).P, Triangles(0, 3) }), "without triangles");
  const TriangleMesh one =
    Meshes::Make({ { 9, 9, 9 }, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 1, 2, 3 } });
  // The box of three points without area; the same with a tetrahedron that comes after them.
  const TriangleMesh line = Meshes::Make(
    { { 0, 0, 0 }, { 1, 1, 1 }, { 3, 3, 3 } }, { { 0, 1, 2 }, { 0, 0, 1 }, { 2, 2, 2 } });
  TriangleMesh point;
  point.P = Points::Constant(40, 3, 5.0);
  point.F.resize(38, 3);
  for (int f = 0; f < 38; ++f)
  {
    point.F.row(f) << f, f + 1, f + 2;
  }
  TriangleMesh mixed = Meshes::Tetrahedron();
  Triangles F(6, 3);
  F << 0, 0, 1, 2, 2, 2, mixed.F;
  mixed.F = F;
  for (const auto& [meshName, mesh] : { Meshes::Named{ "one", one }, Meshes::Named{ "line", line },
         Meshes::Named{ "point", point }, Meshes::Named{ "mixed", mixed } })
  {
    const SurfaceProjection projection(mesh);
    Points P = Around(mesh, 300, 2.0, 18);
    P.row(0) = mesh.P.row(1);
    for (const auto& [name, search] : AllSearches())
    {
      const Feet feet = search(projection, P, 1);
      const std::string what = std::string(name).append(" on ").append(meshName);
      CheckFeet(mesh, feet, 300, what);
      CHECK(meshName != "mixed" || feet.cell.minCoeff() >= 2,
        what << ": triangles without area should not be hit beside others");
    }
  }
  const Points P = Around(line, 300, 2.0, 19);
  const Points Q = Interpolate(line.F, SurfaceProjection(line).ClosestPoint(P, 1), line.P);
  for (int i = 0; i < 300; ++i)
  {
    const double t = std::min(3.0, std::max(0.0, P.row(i).sum() / 3.0));
    CHECK((Q.row(i) - Eigen::RowVector3d(t, t, t)).norm() <= 1e-14, "the nearest point of a line");
  }
  // One triangle, by hand: above it, beside an edge, beside a corner; never the point of no
  // triangle.
  Points R(3, 3), expected(3, 3);
  R << 0.2, 0.3, 4, 0.5, -2, 1, 5, -1, 9;
  expected << 0.2, 0.3, 0, 0.5, 0, 0, 1, 0, 0;
  const SurfaceProjection projection(one);
  CHECK(
    Meshes::Distance(Interpolate(one.F, projection.ClosestPoint(R, 1), one.P), expected) <= 1e-15,
    "the nearest points of one triangle");
  CHECK(Meshes::Distance(
          Interpolate(one.F, projection.NearestVertices(R, 4, 1), one.P), expected) <= 1e-15,
    "the thesis' feet on one triangle");
  // Not a number: any foot, but one that is there.
  R(1, 1) = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, search] : AllSearches())
  {
    const Feet feet = search(projection, R, 1);
    CHECK(feet.cell.isZero() && feet.barycentric.row(0).allFinite(), name << ": NaN does no harm");
  }
}
} // namespace

int main()
{
  TestBarycentric();
  TestClosestPoint();
  TestPointsOnTheProxy();
  TestNearestVertices();
  TestNoFootAtAll();
  TestSmallestAngle();
  TestRecess();
  TestOneDegree();
  TestAlongDirections();
  TestThreads();
  TestScaleAndPlace();
  TestInterpolate();
  TestDegenerate();
  return CheckResult();
}
