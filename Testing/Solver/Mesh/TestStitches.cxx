// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Edges between the parts of a model [stitch]. Which points they join: all parts, the nearest ones,
// and enough of them to hold a part in position and orientation. And what they do in a solve.
#include "Check.h"
#include "Dense.h"
#include "EnergyTriangles.h"
#include "FixedIterations.h"
#include "Frame.h"
#include "Meshes.h"
#include "Solved.h"
#include "Stitches.h"
#include "StyleSolver.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <set>

using namespace SphericalStyle;
using Eigen::Vector3d;
using Meshes::Moved;
using Meshes::Named;
using Meshes::Together;
using Meshes::Turned;

namespace
{
TriangleMesh Triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  return Meshes::Make({ a, b, c }, { { 0, 1, 2 } });
}

TriangleMesh Cone(const Vector3d& apex)
{
  return Moved(Meshes::Make({ { 0, 0, 0 }, { 0.5, 0, 1 }, { -0.2, 0.4, 1 }, { -0.3, -0.4, 1 } },
                 { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 1, 3, 2 } }),
    apex);
}

TriangleMesh RandomParts(int parts)
{
  Meshes::Random random(31);
  std::vector<TriangleMesh> meshes;
  for (int k = 0; k < parts; ++k)
  {
    TriangleMesh mesh = k % 3 == 0 ? Meshes::Patch(1 + k % 4, 0.3)
      : k % 3 == 1                 ? Meshes::Icosphere(k % 4 == 0 ? 2 : 1)
                                   : Meshes::Box(1 + k % 3);
    mesh = Meshes::Perturbed(mesh, 0.05, 100 + k);
    mesh.P *= 0.1 + 0.5 * random.Unit();
    const Eigen::Matrix3d rotation = random.Rotation();
    meshes.push_back(Moved(Turned(mesh, rotation), 4.0 * random.InCube()));
  }
  return Together(meshes);
}

TriangleMesh Chain(int parts)
{
  std::vector<TriangleMesh> meshes;
  for (int k = 0; k < parts; ++k)
  {
    meshes.push_back(
      Moved(Meshes::Perturbed(Meshes::Icosphere(2), 0.01, k), { 2.15 * k, 0.1 * k, 0.0 }));
  }
  return Together(meshes);
}

std::vector<Named> Assemblies()
{
  return { { "two cubes",
             Together({ Meshes::Perturbed(Meshes::Box(3), 0.02, 1),
               Moved(Meshes::Perturbed(Meshes::Box(4), 0.02, 2), { 2.2, 0.1, 0 }) }) },
    { "nested spheres",
      Together({ Meshes::Perturbed(Meshes::Icosphere(2), 0.01, 3),
        Meshes::Scaled(Meshes::Perturbed(Meshes::Icosphere(3), 0.01, 4), { 1.2, 1.2, 1.2 }) }) },
    { "chain", Chain(6) }, { "19 random parts", RandomParts(19) },
    { "60 random parts", RandomParts(60) }, { "mixed order", Meshes::TwoComponents() },
    { "triangles",
      Together({ Triangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }),
        Triangle({ 0.1, 0, 0.3 }, { 1, 0.1, 0.3 }, { 0.2, 1, 0.4 }),
        Triangle({ 3, 0, 0.5 }, { 4, 0.3, 0 }, { 3.2, 1, 0.1 }) }) } };
}

std::vector<int> Parts(const TriangleMesh& mesh)
{
  return MeshTopology(mesh.F, static_cast<int>(mesh.P.rows())).GetComponents();
}

int LargestPart(const TriangleMesh& mesh)
{
  const std::vector<int> parts = Parts(mesh);
  return *std::max_element(parts.begin(), parts.end());
}

std::vector<Stitch> Find(const TriangleMesh& mesh)
{
  return FindStitches(mesh.P, mesh.F, Parts(mesh));
}

double Length(const TriangleMesh& mesh, const Stitch& s)
{
  return (mesh.P.row(s.u) - mesh.P.row(s.v)).norm();
}

/// Edges of a minimum spanning tree over parts with these distances, ascending; infinite ones where
/// there is no connection.
std::vector<double> SpanningTree(const Eigen::MatrixXd& distance)
{
  const auto parts = static_cast<int>(distance.rows());
  std::vector<int> inside = { 0 };
  std::vector<double> edges;
  while (static_cast<int>(inside.size()) < parts)
  {
    double least = std::numeric_limits<double>::infinity();
    int next = -1;
    for (int k = 0; k < parts; ++k)
    {
      const bool out = std::find(inside.begin(), inside.end(), k) == inside.end();
      for (const int i : inside)
      {
        if (out && (next < 0 || distance(i, k) < least))
        {
          least = distance(i, k);
          next = k;
        }
      }
    }
    inside.push_back(next);
    edges.push_back(least);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Distances of all pairs of parts, from every pair of points; or from the stitches alone.
Eigen::MatrixXd Distances(const TriangleMesh& mesh, const std::vector<Stitch>* stitches)
{
  const std::vector<int> part = Parts(mesh);
  const int parts = 1 + LargestPart(mesh);
  Eigen::MatrixXd distance =
    Eigen::MatrixXd::Constant(parts, parts, std::numeric_limits<double>::infinity());
  const auto note = [&](const Stitch& s)
  {
    double& least = distance(part[s.u], part[s.v]);
    least = std::min(least, Length(mesh, s));
    distance(part[s.v], part[s.u]) = least;
  };
  if (stitches)
  {
    std::for_each(stitches->begin(), stitches->end(), note);
    return distance;
  }
  for (int u = 0; u < mesh.P.rows(); ++u)
  {
    for (int v = u + 1; v < mesh.P.rows(); ++v)
    {
      note({ u, v });
    }
  }
  return distance;
}

double LargestMeanEdge(const TriangleMesh& mesh)
{
  double largest = 0.0;
  for (int i = 0; i < mesh.P.rows(); ++i)
  {
    double sum = 0.0;
    int count = 0;
    for (int h = 0; h < mesh.F.size(); ++h)
    {
      const int u = mesh.F(h / 3, HalfEdgeStart(h % 3)), v = mesh.F(h / 3, HalfEdgeEnd(h % 3));
      if (u == i || v == i)
      {
        sum += (mesh.P.row(u) - mesh.P.row(v)).norm();
        ++count;
      }
    }
    largest = std::max(largest, sum / count);
  }
  return largest;
}

// Every part is tied in by the shortest of all possible connections: the stitches hold a minimum
// spanning tree of the parts. None is longer than a multiple of its longest edge, plus mesh edges.
void TestNearestConnected()
{
  for (const Named& named : Assemblies())
  {
    const TriangleMesh& mesh = named.mesh;
    const std::vector<Stitch> stitches = Find(mesh);
    const std::vector<double> tree = SpanningTree(Distances(mesh, nullptr));
    const std::vector<double> stitched = SpanningTree(Distances(mesh, &stitches));
    for (std::size_t i = 0; i < tree.size(); ++i)
    {
      CHECK_NEAR(stitched[i], tree[i], 1e-12, named.name << ": edge " << i << " of the tree");
    }
    const double bound = 2.0 * (1.5 * tree.back() + LargestMeanEdge(mesh));
    const std::vector<int> part = Parts(mesh);
    for (const Stitch& s : stitches)
    {
      CHECK(s.u < s.v && part[s.u] != part[s.v],
        named.name << ": stitch " << s.u << " - " << s.v << " in part " << part[s.u]);
      CHECK(Length(mesh, s) <= bound,
        named.name << ": stitch " << s.u << " - " << s.v << " is " << Length(mesh, s)
                   << " long, above " << bound);
    }
  }
}

/// Second largest extent (standard deviation) of the stitches' middles.
double Spread(const TriangleMesh& mesh, const std::vector<Stitch>& stitches)
{
  Points middle(stitches.size(), 3);
  for (std::size_t i = 0; i < stitches.size(); ++i)
  {
    middle.row(static_cast<Eigen::Index>(i)) =
      0.5 * (mesh.P.row(stitches[i].u) + mesh.P.row(stitches[i].v));
  }
  middle.rowwise() -= middle.colwise().mean().eval();
  return std::sqrt(
    Dense::Eigenvalues(middle.transpose() * middle)(1) / static_cast<double>(stitches.size()));
}

// Parts that touch in one point or along one edge only would hang on a hinge.
void TestNoHinge()
{
  const TriangleMesh plate = Meshes::Patch(8, 0.0); // edges of .25 and .2
  const Named joints[] = { { "cone on a plate", Together({ plate, Cone({ 0.02, 0.01, 0 }) }) },
    { "cone far from a plate", Together({ plate, Cone({ 0.02, 0.01, 1.5 }) }) },
    { "cones tip to tip",
      Together(
        { Turned(Cone({ 0, 0, 0 }), Vector3d(1, -1, -1).asDiagonal()), Cone({ 0, 0, 0.1 }) }) },
    { "cubes edge to edge",
      Together({ Meshes::Box(1), Moved(Meshes::Box(1), { 2.01, 2.01, 0 }) }) },
    { "cubes corner to corner", Together({ Meshes::Box(3), Moved(Meshes::Box(3), { 2, 2, 2 }) }) },
    { "triangles in line",
      Together({ Triangle({ 0, 0, 0 }, { -1, 0.4, 0 }, { -1, -0.3, 0 }),
        Triangle({ 0.1, 0, 0 }, { 1, 0.4, 0 }, { 1, -0.3, 0 }) }) } };
  for (const Named& joint : joints)
  {
    const std::vector<Stitch> stitches = Find(joint.mesh);
    CHECK(stitches.size() >= 3, joint.name << ": " << stitches.size() << " stitches");
    const double spread = Spread(joint.mesh, stitches);
    CHECK(spread >= 0.02, joint.name << ": the stitches lie within " << spread << " of a line");
  }
  // Where all points lie in a line there is nothing to hold on to, and nothing goes wrong.
  const TriangleMesh needles = Together({ Triangle({ 0, 0, 0 }, { -1, 1e-9, 0 }, { -2, 0, 0 }),
    Triangle({ 0.1, 0, 0 }, { 1, 1e-9, 0 }, { 2, 0, 0 }) });
  CHECK(!Find(needles).empty(), "needles in line should be joined");
}

using Pairs = std::set<std::pair<int, int>>;

Pairs AsPairs(const std::vector<Stitch>& stitches, const std::function<int(int)>& renumber)
{
  Pairs pairs;
  for (const Stitch& s : stitches)
  {
    pairs.insert(std::minmax({ renumber(s.u), renumber(s.v) }));
  }
  CHECK(pairs.size() == stitches.size(), "every stitch should be there once");
  return pairs;
}

// Meshes on which the answer is plain.
void TestKnownStitches()
{
  const auto same = [](int i) { return i; };
  // Facing points of two cubes, none beside or behind them.
  const TriangleMesh cube = Meshes::Box(3);
  const Vector3d apart(2.3, 0, 0);
  const auto n = static_cast<int>(cube.P.rows());
  Pairs facing;
  for (int u = 0; u < n; ++u)
  {
    for (int v = 0; v < n; ++v)
    {
      const Vector3d between = cube.P.row(v) - cube.P.row(u);
      if ((between + apart).isApprox(Vector3d(0.3, 0, 0)))
      {
        facing.insert({ u, n + v });
      }
    }
  }
  CHECK(facing.size() == 16, "a side of the cube should have 16 points");
  CHECK(AsPairs(Find(Together({ cube, Moved(cube, apart) })), same) == facing,
    "two cubes should be joined at the facing points");

  // One inside the other, and one on the other: every point to its own copy.
  const TriangleMesh sphere = Meshes::Icosphere(2);
  const auto k = static_cast<int>(sphere.P.rows());
  Pairs copies;
  for (int i = 0; i < k; ++i)
  {
    copies.insert({ i, k + i });
  }
  for (const double size : { 0.97, 0.9, 1.0 })
  {
    CHECK(AsPairs(Find(Together({ sphere, Meshes::Scaled(sphere, { size, size, size }) })), same) ==
        copies,
      "a sphere " << size << " times as large should be joined point by point");
  }
  CHECK(Find(sphere).empty(), "one part needs no stitch");

  // A ring of parts is closed: every part holds on to both of its neighbors.
  std::vector<TriangleMesh> ring;
  for (int i = 0; i < 12; ++i)
  {
    const double angle = 2.0 * Meshes::Pi * i / 12;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
    ring.push_back(Turned(Moved(Meshes::Box(2), { 5, 0, 0 }), turn));
  }
  const TriangleMesh wheel = Together(ring);
  const std::vector<Stitch> stitches = Find(wheel);
  const Eigen::MatrixXd distances = Distances(wheel, &stitches);
  for (int i = 0; i < 12; ++i)
  {
    CHECK(std::isfinite(distances(i, (i + 1) % 12)), "box " << i << " and the next are not joined");
    CHECK(!std::isfinite(distances(i, (i + 2) % 12)), "box " << i << " reaches past the next");
  }
}

// The same stitches at another place, size, pose and order of the points, and for parts in any
// order.
void TestInvariance()
{
  Meshes::Random random(5);
  for (const Named& named : Assemblies())
  {
    const TriangleMesh& mesh = named.mesh;
    const auto n = static_cast<int>(mesh.P.rows());
    const Pairs expected = AsPairs(Find(mesh), [](int i) { return i; });
    const auto check = [&](const TriangleMesh& other, const char* what)
    {
      CHECK(AsPairs(Find(other), [](int i) { return i; }) == expected,
        named.name << ": other stitches " << what);
    };
    check(Moved(mesh, { 3, -2, 5 }), "at another place");
    check(Meshes::Scaled(mesh, { 1e-6, 1e-6, 1e-6 }), "a million times smaller");
    check(Meshes::Scaled(mesh, { 1e6, 1e6, 1e6 }), "a million times larger");
    check(Turned(mesh, random.Rotation()), "turned");

    const std::vector<int> place = random.Permutation(n);
    std::vector<int> original(n);
    for (int i = 0; i < n; ++i)
    {
      original[place[i]] = i;
    }
    const TriangleMesh shuffled = Meshes::Renumbered(mesh, place);
    CHECK(AsPairs(Find(shuffled), [&](int i) { return original[i]; }) == expected,
      named.name << ": other stitches with points in another order");
  }
}

EnergyTriangles Surface(const TriangleMesh& mesh)
{
  EnergyTriangles surface;
  surface.Topology = MeshTopology(mesh.F, static_cast<int>(mesh.P.rows()));
  surface.Cotangents = HalfEdgeCotangents(mesh.P, mesh.F);
  return surface;
}

// A stitch is an edge in the cells of its two ends only: of the same weights as an edge between two
// equilateral triangles, which lies in four cells, together.
void CheckEnergy(const TriangleMesh& mesh, const EnergyTriangleOptions& options,
  const std::vector<Stitch>& stitches)
{
  Meshes::Random random(9);
  EnergyTriangles triangles;
  UpdateEnergyTriangles(mesh.P, Surface(mesh), options, triangles);
  const Triangles& F = triangles.Topology.GetTriangles();
  CHECK(!stitches.empty() && F.rows() == mesh.F.rows() + 2 * static_cast<int>(stitches.size()) &&
      triangles.NumberOfStitches == static_cast<int>(stitches.size()),
    "a stitch should be a pair of triangles");
  CHECK(triangles.Topology.GetNumberOfComponents() == 1, "stitched parts should be one component");

  const double lambda = 0.7;
  const auto n = static_cast<int>(mesh.P.rows());
  Points Q = mesh.P, T = mesh.P;
  Matrices R;
  for (int i = 0; i < n; ++i)
  {
    Q.row(i) = random.InCube().transpose();
    T.row(i) = random.InCube().transpose();
    R.push_back(random.Rotation());
  }
  struct Style
  {
    EdgeWeighting edges;
    SphericalWeighting spherical;
    double c, l; // of an edge between two equilateral triangles, in all cells of both
  };
  const double c = 0.5 / std::sqrt(3.0);
  for (const Style& style :
    { Style{ EdgeWeighting::HalfEdge, SphericalWeighting::Uniform, 6.0 * c, 3.0 * lambda },
      Style{ EdgeWeighting::HalfEdge, SphericalWeighting::Cotangent, 6.0 * c, 3.0 * lambda },
      Style{ EdgeWeighting::FullEdge, SphericalWeighting::Uniform, 12.0 * c, 6.0 * lambda } })
  {
    const auto energy = [&](const EnergyTriangles& of)
    {
      const Triangles& G = of.Topology.GetTriangles();
      EdgeWeights weights = ComputeEdgeWeights(of.Cotangents, G,
        Eigen::VectorXd::Constant(n, lambda), style.edges, style.spherical, of.NumberOfStitches);
      return StyleEnergy(of.Topology, std::move(weights), HalfEdgeDifferences(mesh.P, G),
        HalfEdgeDifferences(T, G), 1)
        .Evaluate(Q, R);
    };
    const EnergyTriangles surface = Surface(mesh);
    double rigid = 0.0, spherical = 0.0;
    for (const Stitch& s : stitches)
    {
      const auto difference = [&s](const Points& x) -> Vector3d { return x.row(s.u) - x.row(s.v); };
      for (const int y : { s.u, s.v })
      {
        rigid += 0.5 * style.c * (difference(Q) - R[y] * difference(mesh.P)).squaredNorm();
        spherical += 0.5 * style.l * (difference(Q) - R[y] * difference(T)).squaredNorm();
      }
    }
    CHECK_NEAR(energy(triangles).rigid - energy(surface).rigid, rigid, 1e-12 * rigid,
      "rigid energy of stitches");
    CHECK_NEAR(energy(triangles).spherical - energy(surface).spherical, spherical,
      1e-12 * spherical, "spherical energy of stitches");
  }
}

void TestEnergyOfAStitch()
{
  const TriangleMesh parts = Together({ Triangle({ 0, 0, 0 }, { -1, 0.4, 0 }, { -1, -0.3, 0.1 }),
    Triangle({ 0.1, 0, 0 }, { 1, 0.4, 0.2 }, { 1, -0.3, 0 }) });
  EnergyTriangleOptions options;
  options.stitched = true;
  CheckEnergy(parts, options, Find(parts));
}

StyleOptions Coupled(StyleOptions options)
{
  options.componentCoupling = ComponentCoupling::Stitched;
  return options;
}

// Where one part is held at another place and turned, the others follow as one body: stitches hold
// position and orientation, and a rigid motion costs nothing.
void TestPartsFollow()
{
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.6, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  std::vector<Named> few = Assemblies(); // the way along many parts is long
  few.erase(std::remove_if(few.begin(), few.end(),
              [](const Named& named) { return LargestPart(named.mesh) > 2; }),
    few.end());
  few.push_back({ "chain of three", Chain(3) });
  few.push_back({ "5 random parts", RandomParts(5) });
  for (const Named& named : few)
  {
    const TriangleMesh& mesh = named.mesh;
    const std::vector<int> part = Parts(mesh);
    const Points moved = Moved(Turned(mesh, turn), { 0.4, -0.3, 0.2 }).P;
    StyleOptions options = Coupled({});
    options.lambda = 0.0;
    options.loop.tolerance = 1e-13;
    options.loop.maximumNumberOfIterations = 3000;
    for (int i = 0; i < mesh.P.rows(); ++i)
    {
      if (part[i] == 0)
      {
        options.fixedPoints.push_back(i);
      }
    }
    options.fixedPositions = moved(options.fixedPoints, AllColumns);
    const double difference = Meshes::Distance(Solved(mesh, options), moved);
    CHECK(difference <= 1e-3 * Meshes::Diagonal(mesh.P),
      named.name << ": parts should follow the one that is held, differ by "
                 << difference / Meshes::Diagonal(mesh.P) << " diagonals");
  }
}

// [blend] holds with stitches: a minimum in closed form, of one component.
void TestBlend()
{
  for (const Named& named : Assemblies())
  {
    const TriangleMesh& mesh = named.mesh;
    StyleOptions options = Coupled({});
    options.sphericalWeighting = SphericalWeighting::Cotangent;
    StyleSolver solver;
    solver.SetMesh(mesh);
    const StyleReport report = solver.Solve(options);
    const Points closed = solver.GetPositions();
    CHECK(report.closedForm && report.loop.iterations == 0,
      named.name << ": the minimum should be known");
    CHECK(
      report.stitches == static_cast<int>(Find({ FrameOf(mesh.P).Into(mesh.P), mesh.F }).size()),
      named.name << ": " << report.stitches << " stitches");
    const double mu = std::sqrt(3.0) * options.lambda;
    const double diagonal = Meshes::Diagonal(mesh.P);
    Points blend = (mesh.P + mu * report.sphere.radius * solver.GetDirections()) / (1.0 + mu);
    const Eigen::VectorXd areas = PointAreas(mesh.P, mesh.F);
    blend.rowwise() += (areas.transpose() * (mesh.P - blend) / areas.sum()).eval();
    CHECK(Meshes::Distance(closed, blend) <= 1e-12 * diagonal,
      named.name << ": the closed form should be the blend with the sphere, in one piece");
    // The steps find nothing lower.
    const StyleReport stepped = solver.Solve(Fixed(options, 5));
    CHECK(!stepped.closedForm && Meshes::Distance(solver.GetPositions(), closed) <= 1e-8 * diagonal,
      named.name << ": steps leave the closed form by "
                 << Meshes::Distance(solver.GetPositions(), closed) / diagonal << " diagonals");
    CHECK_NEAR(stepped.loop.history.back().energy.Total(), report.loop.history[0].energy.Total(),
      1e-9 * report.loop.restEnergy, named.name << ": energy after five steps");
  }
}

/// The mesh with the triangles of one side of the plane z = 0 on points of their own.
TriangleMesh Cut(const TriangleMesh& mesh, std::vector<int>& original)
{
  std::vector<Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  for (const double side : { 1.0, -1.0 })
  {
    std::vector<int> number(mesh.P.rows(), -1);
    for (int f = 0; f < mesh.F.rows(); ++f)
    {
      std::array<int, 3> triangle{};
      double height = 0.0;
      for (int k = 0; k < 3; ++k)
      {
        height += mesh.P(mesh.F(f, k), 2);
      }
      for (int k = 0; side * height > 0.0 && k < 3; ++k)
      {
        int& id = number[mesh.F(f, k)];
        if (id < 0)
        {
          id = static_cast<int>(points.size());
          points.emplace_back(mesh.P.row(mesh.F(f, k)));
          original.push_back(mesh.F(f, k));
        }
        triangle[k] = id;
      }
      if (side * height > 0.0)
      {
        triangles.push_back(triangle);
      }
    }
  }
  return Meshes::Make(points, triangles);
}

/// How far the halves of a cut ball end from the whole, largest distance in diagonals.
struct CutResult
{
  double stitched;
  double independent;
};

CutResult SolveCut(const TriangleMesh& ball, int ring, StyleOptions options)
{
  std::vector<int> original;
  const TriangleMesh halves = Cut(ball, original);
  CHECK(halves.P.rows() == ball.P.rows() + ring && halves.F.rows() == ball.F.rows(),
    "the cut should run along a ring of " << ring << " points");
  options.centerMode = CenterMode::Custom; // the points along the cut count twice otherwise
  options.custom.center = ball.P.colwise().mean();
  options.loop.tolerance = 1e-6;
  const Points whole = Solved(ball, options)(original, AllColumns);
  const auto difference = [&](Points result)
  {
    result.rowwise() += (whole - result).colwise().mean().eval();
    return Meshes::Distance(result, whole) / Meshes::Diagonal(ball.P);
  };
  return { difference(Solved(halves, Coupled(options))), difference(Solved(halves, options)) };
}

// A ball cut in two and stitched comes out as the ball, within a 200th of its diagonal; the halves
// alone do not.
void TestCutBall()
{
  for (const double lambda : { 0.5, 5.0 })
  {
    for (const int around : { 32, 64 })
    {
      TriangleMesh ball = Meshes::EllipsoidUV(around, around - 11); // with a ring where z = 0
      ball.P.col(0).array() += 0.5 * ball.P.col(2).array().square();
      StyleOptions options;
      options.lambda = lambda;
      const CutResult result = SolveCut(ball, around, options);
      std::cout << "ball cut along " << around << " points, lambda " << lambda << ": stitched "
                << result.stitched << ", independent " << result.independent
                << " diagonals from the whole" << std::endl;
      CHECK(
        result.stitched <= 0.005, "stitched halves differ by " << result.stitched << " diagonals");
      CHECK(result.independent >= 3.0 * result.stitched && result.independent >= 0.01,
        "independent halves differ by " << result.independent << " diagonals only");
    }
  }
}

// What is kept between solves, and what models of one part see of it: nothing.
void TestKept()
{
  const TriangleMesh mesh = Meshes::TwoComponents();
  const StyleOptions options = Fixed({}, 5);
  const Points apart = Solved(mesh, options), together = Solved(mesh, Coupled(options));
  CHECK(Meshes::Distance(apart, together) > 0.01, "stitches should matter");
  StyleSolver solver;
  solver.SetMesh(mesh);
  for (const bool coupled : { false, true, false, true })
  {
    solver.Solve(coupled ? Coupled(options) : options);
    CHECK(Meshes::SameBits(solver.GetPositions(), coupled ? together : apart),
      "a change of the coupling should give the bits of a fresh solver");
  }
  StyleOptions other = Coupled(options);
  other.normalBlend = 0.5;
  CHECK(!solver.Solve(other).factored, "other targets need no other stitches");
  TriangleMesh moved = mesh;
  moved.P.array() += 0.01 * Meshes::Ellipsoid(1).P(0, 0);
  moved.P(3, 1) += 0.02;
  solver.SetMesh(moved);
  solver.Solve(Coupled(options));
  CHECK(Meshes::SameBits(solver.GetPositions(), Solved(moved, Coupled(options))),
    "other points should give the bits of a fresh solver");

  const TriangleMesh one = Meshes::Perturbed(Meshes::Ellipsoid(2), 0.02, 1);
  CHECK(Meshes::SameBits(Solved(one, options), Solved(one, Coupled(options))),
    "a model of one part should come out the same");
  CHECK(ThesisOptions(Coupled({})).componentCoupling == ComponentCoupling::Independent,
    "the thesis has no stitches");
}

// With full weights, per-point lambda, normals and several centers the solve is sound too.
void TestOtherOptions()
{
  const TriangleMesh mesh = RandomParts(19);
  const auto n = static_cast<int>(mesh.P.rows());
  std::vector<std::pair<const char*, StyleOptions>> styles(5, { "", Coupled({}) });
  styles[4].first = "intrinsic triangles";
  styles[4].second.edgeWeighting = EdgeWeighting::IntrinsicDelaunay;
  styles[0].first = "full edges";
  styles[0].second.edgeWeighting = EdgeWeighting::FullEdge;
  styles[0].second.lambda = 5.0;
  styles[1].first = "per-point lambda";
  styles[1].second.sphericalWeighting = SphericalWeighting::Cotangent;
  styles[1].second.roundnessFactors = Eigen::VectorXd::LinSpaced(n, 0.0, 2.0);
  styles[2].first = "normals";
  styles[2].second.normalBlend = 0.3;
  styles[3].first = "several centers";
  styles[3].second.centerIds = Parts(mesh);
  styles[3].second.centerBlend = 0.02;
  for (const auto& [name, options] : styles)
  {
    StyleSolver solver;
    solver.SetMesh(mesh);
    const StyleReport report = solver.Solve(options);
    CHECK(solver.GetPositions().allFinite(), name << ": positions should be finite");
    CHECK(CountRises(report.loop).iterations == 0, name << ": the energy should never rise");
    CHECK_NEAR(solver.GetCellEnergies().sum(), report.loop.history.back().energy.Total(),
      1e-9 * report.loop.restEnergy, name << ": sum of the cells' energies");
  }
}
}

int main()
{
  TestNearestConnected();
  TestNoHinge();
  TestKnownStitches();
  TestInvariance();
  TestEnergyOfAStitch();
  TestPartsFollow();
  TestBlend();
  TestCutBall();
  TestKept();
  TestOtherOptions();
  return CheckResult();
}
