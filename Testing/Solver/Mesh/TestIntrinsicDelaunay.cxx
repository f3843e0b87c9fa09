// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Intrinsic Delaunay triangles: the metric of the surface stays, the weights turn nonnegative, and
// a plane gives the Laplacian of its Delaunay triangulation.
#include "Check.h"
#include "EdgeWeights.h"
#include "FixedIterations.h"
#include "IntrinsicDelaunay.h"
#include "Meshes.h"
#include "StyleSolver.h"
#include "SurfaceMeasures.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <string>

using namespace SphericalStyle;

namespace
{
using Meshes::Named;

IntrinsicTriangulation Delaunay(const TriangleMesh& mesh)
{
  return IntrinsicDelaunay(mesh.P, mesh.F, HalfEdgeCotangents(mesh.P, mesh.F));
}

/// sum_h c_h (x_u - x_v)^2 as a matrix.
Eigen::MatrixXd Laplacian(const Triangles& F, const HalfEdgeScalars& c, int n)
{
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
  for (int h = 0; h < F.size(); ++h)
  {
    const int u = F(h / 3, HalfEdgeStart(h % 3)), v = F(h / 3, HalfEdgeEnd(h % 3));
    const double k = c(h / 3, h % 3);
    L(u, u) += k;
    L(v, v) += k;
    L(u, v) -= k;
    L(v, u) -= k;
  }
  return L;
}

/// Triangles turned over at random: nothing may depend on orientation.
TriangleMesh Scrambled(TriangleMesh mesh, std::uint32_t seed)
{
  Meshes::Random random(seed);
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    if (random.Unit() < 0.5)
    {
      std::swap(mesh.F(f, 0), mesh.F(f, 1));
    }
  }
  return mesh;
}

/// Twice the area over the square of the longest edge.
double Thinness(const Meshes::Vector& a, const Meshes::Vector& b, const Meshes::Vector& c)
{
  return (b - a).cross(c - a).norm() /
    std::max({ (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() });
}

/// The square [0, 1]^2 with random points in it, each put into the triangle that it falls in; many
/// of them almost on an edge, `height` times the triangle's from it. Slivers of every size.
TriangleMesh SplitSquare(int points, double height, std::uint32_t seed)
{
  Meshes::Random random(seed);
  std::vector<Meshes::Vector> P = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  std::vector<std::array<int, 3>> F = { { 0, 1, 2 }, { 0, 2, 3 } };
  for (int i = 0; i < points; ++i)
  {
    const auto into = static_cast<std::size_t>(F.size() * random.Unit());
    const std::array<int, 3> t = F[into];
    double a = random.Unit(), b = random.Unit();
    if (a + b > 1.0)
    {
      a = 1.0 - a;
      b = 1.0 - b;
    }
    if (i % 3 == 0 && Thinness(P[t[0]], P[t[1]], P[t[2]]) > 0.01)
    {
      a = height;
      b = 0.4 + 0.2 * b;
    }
    const int p = static_cast<int>(P.size());
    P.push_back((1.0 - a - b) * P[t[0]] + a * P[t[1]] + b * P[t[2]]);
    F[into] = { t[0], t[1], p };
    F.push_back({ t[1], t[2], p });
    F.push_back({ t[2], t[0], p });
  }
  return Meshes::Make(P, F);
}

/// Every triangle whose circle holds no other point.
Triangles BruteForceDelaunay(const Points& P)
{
  const int n = static_cast<int>(P.rows());
  std::vector<std::array<int, 3>> found;
  for (int i = 0; i < n; ++i)
  {
    for (int j = i + 1; j < n; ++j)
    {
      for (int k = j + 1; k < n; ++k)
      {
        const Eigen::Vector2d a = P.row(i).head<2>(), b = P.row(j).head<2>(),
                              c = P.row(k).head<2>();
        Eigen::Matrix2d M;
        M << (b - a).transpose(), (c - a).transpose();
        const double area = M.determinant();
        bool empty = area != 0.0;
        for (int q = 0; q < n && empty; ++q)
        {
          if (q == i || q == j || q == k)
          {
            continue;
          }
          const Eigen::Vector2d p = P.row(q).head<2>();
          Eigen::Matrix3d D;
          D << (a - p).transpose(), (a - p).squaredNorm(), (b - p).transpose(),
            (b - p).squaredNorm(), (c - p).transpose(), (c - p).squaredNorm();
          empty = D.determinant() * area <= 0.0;
        }
        if (empty)
        {
          found.push_back({ i, j, k });
        }
      }
    }
  }
  Triangles F(found.size(), 3);
  for (std::size_t f = 0; f < found.size(); ++f)
  {
    F.row(f) << found[f][0], found[f][1], found[f][2];
  }
  return F;
}

TriangleMesh MoebiusStrip()
{
  const int around = 9;
  std::vector<Meshes::Vector> P;
  std::vector<std::array<int, 3>> F;
  for (int i = 0; i < around; ++i)
  {
    const double phi = 2.0 * Meshes::Pi * i / around;
    for (const double side : { -0.15, 0.15 })
    {
      const double out = 1.0 + side * std::cos(0.5 * phi);
      P.push_back({ out * std::cos(phi), out * std::sin(phi), side * std::sin(0.5 * phi) });
    }
    const bool last = i + 1 == around;
    const int a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    F.push_back({ a, b, d });
    F.push_back({ a, d, c });
  }
  return Meshes::Make(P, F);
}

/// A triangle of an angle of 120 degrees, twice: a pillow.
TriangleMesh Pillow()
{
  return Meshes::Make(
    { { 0, 0, 0 }, { 1, 0, 0 }, { -0.5, std::sqrt(0.75), 0 } }, { { 0, 1, 2 }, { 0, 2, 1 } });
}

/// A torus of few, long triangles.
TriangleMesh Torus(int around, int across)
{
  std::vector<Meshes::Vector> P;
  std::vector<std::array<int, 3>> F;
  for (int i = 0; i < around; ++i)
  {
    for (int j = 0; j < across; ++j)
    {
      const double phi = 2.0 * Meshes::Pi * i / around, psi = 2.0 * Meshes::Pi * j / across;
      const double out = 1.0 + 0.1 * std::cos(psi);
      P.push_back({ out * std::cos(phi), out * std::sin(phi), 0.1 * std::sin(psi) });
      const auto id = [&](int a, int b) { return (a % around) * across + b % across; };
      F.push_back({ id(i, j), id(i + 1, j), id(i + 1, j + 1) });
      F.push_back({ id(i, j), id(i + 1, j + 1), id(i, j + 1) });
    }
  }
  return Meshes::Make(P, F);
}

std::vector<Named> AllMeshes()
{
  return { { "tetrahedron", Meshes::Tetrahedron() }, { "pillow", Pillow() },
    { "stretched tetrahedron", Meshes::Scaled(Meshes::Tetrahedron(), { 9, 1, 0.3 }) },
    { "prism", Meshes::Scaled(Meshes::Box(1), { 9, 1, 0.8 }) }, { "torus", Torus(3, 3) },
    { "finer torus", Torus(5, 4) }, { "icosphere", Meshes::Icosphere(2) },
    { "flat ellipsoid", Meshes::Scaled(Meshes::EllipsoidUV(), { 5, 1, 0.2 }) },
    { "house", Meshes::House() }, { "patch", Meshes::Patch(8, 0.4) },
    { "skew patch", Meshes::Scaled(Meshes::Patch(8, 0.4), { 7, 1, 1 }) },
    { "two components", Meshes::TwoComponents() },
    { "fan", Meshes::Scaled(Meshes::NonManifoldFan(), { 1, 1, 6 }) },
    { "three at an edge", Meshes::ThreeAtAnEdge() }, { "slivers", Meshes::Slivers() },
    { "moebius strip", Meshes::Scaled(MoebiusStrip(), { 3, 1, 1 }) },
    { "split square", SplitSquare(60, 1e-3, 1) }, { "finer slivers", SplitSquare(40, 1e-4, 2) } };
}

/// Angles around each point: they make up its metric there.
Eigen::VectorXd AngleSums(const Triangles& F, const HalfEdgeScalars& c, int n)
{
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(n);
  for (int h = 0; h < F.size(); ++h)
  {
    sums[F(h / 3, h % 3)] += std::atan2(1.0, 2.0 * c(h / 3, h % 3));
  }
  return sums;
}

/// What must hold at the edges between two triangles.
void CheckGluing(const std::string& name, const IntrinsicTriangulation& T)
{
  const auto ends = [&T](int h) {
    return std::minmax({ T.F(h / 3, HalfEdgeStart(h % 3)), T.F(h / 3, HalfEdgeEnd(h % 3)) });
  };
  int negative = 0;
  for (int h = 0; h < T.F.size(); ++h)
  {
    const int twin = T.Twins[h];
    if (twin < 0)
    {
      continue;
    }
    CHECK(T.Twins[twin] == h && twin != h, name << ": twins should name each other");
    CHECK(ends(h) == ends(twin), name << ": twins should join the same points");
    const double w = T.Cotangents.data()[h] + T.Cotangents.data()[twin];
    CHECK(w >= -1e-12, name << ": the weight of an inner edge is " << w);
    negative += w < -1e-12;
  }
  CHECK(negative <= T.NumberOfNegativeEdges, name << ": negative edges should be counted");
}

void TestEverywhere()
{
  Meshes::Random random(3);
  for (const Named& named : AllMeshes())
  {
    for (const bool scrambled : { false, true })
    {
      const std::string name = named.name + (scrambled ? ", orientations mixed" : "");
      const TriangleMesh mesh = scrambled ? Scrambled(named.mesh, 7) : named.mesh;
      const int n = static_cast<int>(mesh.P.rows());
      const HalfEdgeScalars c = HalfEdgeCotangents(mesh.P, mesh.F);
      const IntrinsicTriangulation T = IntrinsicDelaunay(mesh.P, mesh.F, c);
      CHECK(T.F.rows() == mesh.F.rows(), name << ": flips should keep the number of triangles");
      CheckGluing(name, T);
      for (int f = 0; f < T.F.rows(); ++f)
      {
        const Eigen::RowVector3d k = T.Cotangents.row(f);
        // Of the half cotangents of angles that sum to pi.
        const double one = 4.0 * (k[0] * k[1] + k[1] * k[2] + k[2] * k[0]);
        CHECK_NEAR(one, 1.0, 1e-10 * (1.0 + k.squaredNorm()), name << ": triangle " << f);
      }
      CHECK_NEAR((AngleSums(T.F, T.Cotangents, n) - AngleSums(mesh.F, c, n)).cwiseAbs().maxCoeff(),
        0.0, 1e-8, name << ": the change of the angles around a point");
      // Of all triangulations the Delaunay one has the least Dirichlet energy (Rippa 1990).
      const Eigen::MatrixXd gain = Laplacian(mesh.F, c, n) - Laplacian(T.F, T.Cotangents, n);
      const double least = gain.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
      CHECK(least >= -1e-9 * (1.0 + c.cwiseAbs().maxCoeff()),
        name << ": no field should gain energy, one gains " << -least);
      CHECK((gain.norm() > 1e-9) == (T.NumberOfFlips > 0),
        name << ": " << T.NumberOfFlips << " flips should show in the matrix");
      // Twice the same.
      const IntrinsicTriangulation again = IntrinsicDelaunay(mesh.P, mesh.F, c);
      CHECK(again.F == T.F && again.Cotangents == T.Cotangents, name << ": the same bits again");
    }
  }
}

/// What cannot be flipped: borders and edges of three triangles.
void TestNegativeEdges()
{
  for (const Named& named : AllMeshes())
  {
    const IntrinsicTriangulation T = Delaunay(named.mesh);
    std::set<std::pair<int, int>> fixed; // an edge without twins is one of the mesh
    std::map<std::pair<int, int>, double> weights;
    for (int h = 0; h < T.F.size(); ++h)
    {
      if (T.Twins[h] < 0)
      {
        weights[std::minmax({ T.F(h / 3, HalfEdgeStart(h % 3)),
          T.F(h / 3, HalfEdgeEnd(h % 3)) })] += T.Cotangents.data()[h];
      }
    }
    int negative = 0;
    for (const auto& weight : weights)
    {
      negative += weight.second < -1e-12;
    }
    CHECK(negative == T.NumberOfNegativeEdges,
      named.name << ": " << T.NumberOfNegativeEdges << " negative edges reported, there are "
                 << negative);
  }
  const TriangleMesh obtuse =
    Meshes::Make({ { 0, 0, 0 }, { 2, 0, 0 }, { 1, 0.2, 0 } }, { { 0, 1, 2 } });
  CHECK(Delaunay(obtuse).NumberOfNegativeEdges == 1, "one obtuse triangle has a negative border");
}

void TestAlreadyDelaunay()
{
  for (const Named& named : std::vector<Named>{ { "tetrahedron", Meshes::Tetrahedron() },
         { "icosphere", Meshes::Icosphere(3) }, { "patch", Meshes::Patch(8, 0.0) },
         { "box", Meshes::Box(5) }, { "three at an edge", Meshes::ThreeAtAnEdge() } })
  {
    const TriangleMesh mesh = Scrambled(named.mesh, 5);
    const HalfEdgeScalars c = HalfEdgeCotangents(mesh.P, mesh.F);
    const IntrinsicTriangulation T = IntrinsicDelaunay(mesh.P, mesh.F, c);
    CHECK(T.NumberOfFlips == 0, named.name << " is Delaunay, " << T.NumberOfFlips << " flips");
    CHECK(T.F == mesh.F, named.name << ": the triangles should be the same");
    CHECK(std::memcmp(T.Cotangents.data(), c.data(), c.size() * sizeof(double)) == 0,
      named.name << ": the cotangents should keep their bits");
  }
}

/// In the plane: Delaunay is Delaunay.
void TestPlane()
{
  for (const double height : { 0.1, 1e-3, 1e-4 })
  {
    for (std::uint32_t seed = 1; seed <= 4; ++seed)
    {
      TriangleMesh mesh = Scrambled(SplitSquare(24, height, seed), seed);
      const int n = static_cast<int>(mesh.P.rows());
      const Triangles F = BruteForceDelaunay(mesh.P);
      const Eigen::MatrixXd expected = Laplacian(F, HalfEdgeCotangents(mesh.P, F), n);
      Meshes::Random random(seed);
      mesh.P = (mesh.P * random.Rotation().transpose()).eval();
      const IntrinsicTriangulation T = Delaunay(mesh);
      const Eigen::MatrixXd L = Laplacian(T.F, T.Cotangents, n);
      std::ostringstream name;
      name << "square, height " << height << ", seed " << seed;
      CHECK(F.rows() == mesh.F.rows(), name.str() << ": brute force should find all triangles");
      CHECK(T.NumberOfFlips > n, name.str() << ": the triangulation should be a poor one");
      const double largest = expected.cwiseAbs().maxCoeff();
      CHECK_NEAR((L - expected).cwiseAbs().maxCoeff(), 0.0, 1e-8 * largest,
        name.str() << ": the matrix, against brute force,");
      // Linear functions have the energy of their slope: |g|^2 times the area 1, here 3 - 1.
      CHECK_NEAR((mesh.P.transpose() * L * mesh.P).trace(), 2.0, 1e-11 * largest,
        name.str() << ": the energy of the coordinates");
    }
  }
}

/// Triangles that use a point twice.
void TestSelfEdges()
{
  const IntrinsicTriangulation T = Delaunay(Pillow());
  CHECK(T.NumberOfFlips == 1, "the edge opposite both 120 degrees should flip, once");
  int selfEdges = 0;
  for (int h = 0; h < 6; ++h)
  {
    selfEdges += T.F(h / 3, HalfEdgeStart(h % 3)) == T.F(h / 3, HalfEdgeEnd(h % 3));
  }
  CHECK(selfEdges == 2, "the new edge should return to its point");
  // Two cones around points 1 and 2, closed along one edge: unfolded, triangles of sides 1, 1 and
  // sqrt(3) with 60 degrees twice at the tip.
  const Eigen::MatrixXd L = Laplacian(T.F, T.Cotangents, 3);
  const double w = 1.0 / std::tan(Meshes::Pi / 3.0);
  Eigen::Matrix3d expected;
  expected << 2 * w, -w, -w, -w, w, 0, -w, 0, w;
  CHECK_NEAR((L - expected).cwiseAbs().maxCoeff(), 0.0, 1e-14, "the matrix of the pillow");
}

/// The solver on these triangles: E falls, nothing is lost between solves, acute meshes keep their
/// bits.
void TestSolver()
{
  for (const Named& named : AllMeshes())
  {
    StyleSolver solver;
    solver.SetMesh(named.mesh);
    for (const SphericalWeighting spherical :
      { SphericalWeighting::Uniform, SphericalWeighting::Cotangent })
    {
      std::ostringstream name;
      name << named.name << ", spherical weighting " << static_cast<int>(spherical);
      StyleOptions options = Fixed({}, 12);
      options.edgeWeighting = EdgeWeighting::IntrinsicDelaunay;
      options.sphericalWeighting = spherical;
      options.initialGuess = InitialGuess::Rest;
      const StyleReport report = solver.Solve(options);
      CHECK(report.edgeFlips == Delaunay(named.mesh).NumberOfFlips, name.str() << ": flips");
      const double negligible = 1e-12 * report.loop.restEnergy + report.loop.negligible;
      double before = report.loop.restEnergy;
      for (const HistoryRow& row : report.loop.history)
      {
        const double E = row.energy.Total();
        CHECK(E >= -negligible, name.str() << ": E is " << E);
        CHECK(E <= before + negligible, name.str() << ": E rose from " << before << " to " << E);
        before = E;
      }
    }
    // [blend]: with proportional weights the minimum is the blend, whatever the triangles.
    StyleOptions options;
    options.edgeWeighting = EdgeWeighting::IntrinsicDelaunay;
    options.sphericalWeighting = SphericalWeighting::Cotangent;
    const StyleReport closed = solver.Solve(options);
    CHECK(closed.closedForm, named.name << ": the minimum should be known");
    const Points blend = solver.GetPositions();
    const double least = closed.loop.history.back().energy.Total();
    options = Fixed(options, 40);
    const StyleReport iterated = solver.Solve(options);
    CHECK(!iterated.closedForm, named.name << ": fixed iterations should iterate");
    CHECK_NEAR(iterated.loop.history.back().energy.Total(), least,
      1e-10 * iterated.loop.restEnergy + iterated.loop.negligible,
      named.name << ": the energy after the iterations");
    CHECK_NEAR(Meshes::Distance(solver.GetPositions(), blend) / Meshes::Diagonal(blend), 0.0, 1e-6,
      named.name << ": the distance of the iterated points from the blend");
  }

  StyleSolver solver;
  solver.SetMesh(Meshes::Icosphere(2));
  StyleOptions options = Fixed({}, 5);
  solver.Solve(options);
  const Points half = solver.GetPositions();
  options.edgeWeighting = EdgeWeighting::IntrinsicDelaunay;
  CHECK(solver.Solve(options).edgeFlips == 0, "an icosphere is Delaunay");
  CHECK(Meshes::SameBits(half, solver.GetPositions()), "no flip: the bits of HalfEdge");
}
}

int main()
{
  TestEverywhere();
  TestNegativeEdges();
  TestAlreadyDelaunay();
  TestPlane();
  TestSelfEdges();
  TestSolver();
  return CheckResult();
}
