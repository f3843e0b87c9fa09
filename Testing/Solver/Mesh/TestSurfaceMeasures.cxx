// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Measures of one surface and of a pair: values by hand, and what must not change them.
#include "Check.h"
#include "DeformationMeasures.h"
#include "EdgeWeights.h"
#include "MeshQuality.h"
#include "Meshes.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <set>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
constexpr double Degree = Meshes::Pi / 180.0;

Points Rigid(const Points& P, const Eigen::Matrix3d& turn, const Vector3d& by)
{
  return (P * turn.transpose()).rowwise() + by.transpose();
}

double Rms(const Eigen::VectorXd& x)
{
  return std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

void TestEdges()
{
  struct Expected
  {
    TriangleMesh mesh;
    int edges, border, nonManifold, misoriented;
    bool closed;
  };
  const TriangleMesh tetrahedron = Meshes::Tetrahedron();
  TriangleMesh turned = tetrahedron;
  turned.F.row(0).reverseInPlace();
  TriangleMesh open = tetrahedron;
  open.F.conservativeResize(3, 3);
  // Two tetrahedra at one edge: closed, though four triangles meet there.
  TriangleMesh joined = tetrahedron;
  joined.P.conservativeResize(6, 3);
  joined.P.row(4) << 3, 0.5, 0;
  joined.P.row(5) << 3, 0, 0.5;
  joined.F.conservativeResize(8, 3);
  joined.F.bottomRows(4) << 0, 1, 4, 0, 5, 1, 0, 4, 5, 1, 5, 4;
  const Expected all[] = { { tetrahedron, 6, 0, 0, 0, true }, { turned, 6, 0, 0, 3, false },
    { open, 6, 3, 0, 0, false }, { joined, 11, 0, 1, 0, true },
    { Meshes::ThreeAtAnEdge(), 7, 6, 1, 0, false }, { Meshes::Icosphere(2), 480, 0, 0, 0, true },
    { { Points(0, 3), Triangles(0, 3) }, 0, 0, 0, 0, false } };
  int number = 0;
  for (const Expected& e : all)
  {
    const MeshEdges edges(e.mesh.F);
    const EdgeCounts counts = CountEdges(e.mesh.F, edges);
    CHECK(edges.GetNumberOfEdges() == e.edges && counts.border == e.border &&
        counts.nonManifold == e.nonManifold && counts.misoriented == e.misoriented &&
        counts.closed == e.closed,
      "mesh " << number << ": " << edges.GetNumberOfEdges() << " edges, " << counts.border
              << " border, " << counts.nonManifold << " non-manifold, " << counts.misoriented
              << " misoriented, closed " << counts.closed);
    std::set<int> halfEdges(edges.GetHalfEdges().begin(), edges.GetHalfEdges().end());
    CHECK(static_cast<Eigen::Index>(halfEdges.size()) == e.mesh.F.size(), "each half-edge once");
    ++number;
  }
}

void TestAngles()
{
  // 30, 60, 90 degrees; 120, 30, 30; and a tetrahedron.
  const double h = std::sqrt(3.0);
  const TriangleMesh mesh =
    Meshes::Make({ { 0, 0, 0 }, { h, 0, 0 }, { 0, 1, 0 }, { -h / 2, -0.5, 0 }, { h / 2, -0.5, 0 } },
      { { 0, 1, 2 }, { 0, 3, 4 } });
  const Eigen::MatrixX2d angles = ExtremeAngles(mesh.P, mesh.F);
  Eigen::MatrixX2d expected(2, 2);
  expected << 30, 90, 30, 120;
  CHECK((angles - expected).cwiseAbs().maxCoeff() <= 1e-12, "angles are\n" << angles);
  const TriangleMesh tetrahedron = Meshes::Tetrahedron();
  CHECK((ExtremeAngles(tetrahedron.P, tetrahedron.F).array() - 60.0).abs().maxCoeff() <= 1e-12,
    "angles of a tetrahedron");

  const Eigen::VectorXd dihedral =
    DihedralAngles(tetrahedron.P, tetrahedron.F, MeshEdges(tetrahedron.F));
  CHECK(dihedral.size() == 6 &&
      (dihedral.array() - (Meshes::Pi - std::acos(1.0 / 3.0))).abs().maxCoeff() <= 1e-12,
    "dihedral angles of a tetrahedron, seen from outside");
  TriangleMesh turned = tetrahedron; // inside out: all concave
  turned.F.col(0).swap(turned.F.col(1));
  CHECK((DihedralAngles(turned.P, turned.F, MeshEdges(turned.F)) + dihedral).norm() <= 1e-12,
    "the sign should turn with the orientation");
  // 12 k edges of a cube are right angles, all other edges flat: rms 90 degrees sqrt(12 k / edges).
  const TriangleMesh box = Meshes::Box(3);
  const MeshEdges edges(box.F);
  CHECK_NEAR(Rms(DihedralAngles(box.P, box.F, edges)),
    90.0 * Degree * std::sqrt(36.0 / edges.GetNumberOfEdges()), 1e-12, "roughness of a box");
  CHECK(DihedralAngles(Meshes::ThreeAtAnEdge().P, Meshes::ThreeAtAnEdge().F,
          MeshEdges(Meshes::ThreeAtAnEdge().F))
          .size() == 0,
    "edges of one or three triangles have no dihedral angle");
}

WeightReport Weights(const TriangleMesh& mesh)
{
  return CheckWeights(HalfEdgeCotangents(mesh.P, mesh.F), MeshEdges(mesh.F));
}

void TestWeights()
{
  CHECK(Weights(Meshes::Icosphere(2)).negative == 0, "a ball has no negative weight");
  CHECK(Weights(Meshes::Box(4)).negative == 0 && Weights(Meshes::Box(4)).lambdaStar == 0.0,
    "right angles are not obtuse, w = 0 is not negative");
  // Two triangles with 120 degrees opposite of their common edge: w = cot 120 = -1 / sqrt 3. The
  // others, cot 30 / 2, are borders.
  const TriangleMesh kite =
    Meshes::Make({ { -std::sqrt(3.0), 0, 0 }, { std::sqrt(3.0), 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } },
      { { 0, 1, 2 }, { 1, 0, 3 } });
  CHECK(Weights(kite).negative == 1, "one negative edge");
  CHECK_NEAR(Weights(kite).lambdaStar, 1.0 / std::sqrt(3.0), 1e-14, "lambda* of an inner edge");
  TriangleMesh half = kite;
  half.F.conservativeResize(1, 3);
  CHECK(Weights(half).negative == 1, "a negative border edge");
  CHECK_NEAR(Weights(half).lambdaStar, 1.0 / std::sqrt(3.0), 1e-14, "c + lambda / 2 at a border");

  // A8.6: w + lambda >= 0 on all edges if and only if lambda >= lambda*.
  for (const TriangleMesh& mesh : { Meshes::House(), Meshes::Slivers() })
  {
    const double star = Weights(mesh).lambdaStar;
    const HalfEdgeScalars w = EdgeSums(HalfEdgeCotangents(mesh.P, mesh.F), mesh.F);
    CHECK(star > 0.0 && std::abs(w.minCoeff() + star) <= 1e-12 * star, "closed: lambda* = -min w");
    int negative = 0; // each edge has two half-edges
    for (const double value : w.reshaped())
    {
      negative += value < 0.0;
    }
    CHECK(Weights(mesh).negative == negative / 2, "number of negative edges");
  }
}

void TestSphereFit()
{
  Meshes::Random random(3);
  for (const double scale : { 1e-6, 1.0, 1e6 })
  {
    const Vector3d center = 3.0 * scale * random.InCube();
    const double radius = 0.7 * scale;
    Points P = radius * Meshes::Icosphere(2).P;
    P.rowwise() += center.transpose();
    FittedSphere sphere = FitSphere(P);
    CHECK((sphere.center - center).norm() <= 1e-12 * scale, "center of a sphere");
    CHECK_NEAR(sphere.radius, radius, 1e-12 * scale, "radius of a sphere");
    CHECK(sphere.error <= 1e-12, "a sphere is " << sphere.error << " off itself");

    // A cap still tells where the sphere is.
    const Points cap = P.topRows(40);
    CHECK((FitSphere(cap).center - center).norm() <= 1e-9 * scale, "center of a part of a sphere");
  }
  // The corners of a box and a ring around it: no small step improves a least-squares sphere.
  Points P = Meshes::Ellipsoid(2).P;
  P.row(5) *= 1.7;
  const FittedSphere sphere = FitSphere(P);
  const auto squares = [&P](const Vector3d& center, double radius)
  { return ((P.rowwise() - center.transpose()).rowwise().norm().array() - radius).square().sum(); };
  const double least = squares(sphere.center, sphere.radius);
  CHECK_NEAR(sphere.error, std::sqrt(least / P.rows()) / sphere.radius, 1e-14, "its error");
  for (int k = 0; k < 4; ++k)
  {
    for (const double step : { -1e-5, 1e-5 })
    {
      Vector3d center = sphere.center;
      double radius = sphere.radius;
      (k < 3 ? center[k] : radius) += step;
      CHECK(squares(center, radius) > least, "a step of " << step << " along " << k << " improves");
    }
  }
  CHECK(std::isnan(FitSphere(Meshes::Patch(4, 0.0).P).radius), "points in a plane have no sphere");
  CHECK(std::isnan(FitSphere(Points::Zero(1, 3)).radius), "nor has one point");
}

void TestDirections()
{
  const TriangleMesh ball = Meshes::Icosphere(2);
  const Eigen::VectorXd inside =
    RadialCosines(ball.P, PointNormals(ball.P, ball.F), Vector3d(0.5, 0, 0));
  CHECK(inside.minCoeff() > 0.0, "a ball is star-shaped around each point in it");
  const Eigen::VectorXd outside = RadialCosines(ball.P, ball.P, Vector3d(2.0, 0, 0));
  for (int i = 0; i < ball.P.rows(); ++i)
  {
    // (p - c).p = 1 - 2 x
    CHECK(
      (outside(i) < -1e-9) == (1.0 - 2.0 * ball.P(i, 0) < -1e-9), "seen from outside, point " << i);
  }
  CHECK(RadialCosines(Points::Zero(1, 3), Points::Ones(1, 3), Vector3d::Zero())(0) == 0.0,
    "a point on the center");

  const auto opposition = [](const TriangleMesh& mesh)
  { return FindOpposition(mesh.P, PointNormals(mesh.P, mesh.F), mesh.F, MeshEdges(mesh.F)); };
  CHECK(opposition(ball).edges == 0 && opposition(ball).share.isZero(0.0), "convex: no edge");
  TriangleMesh hollow = ball;
  hollow.F.col(0).swap(hollow.F.col(1));
  CHECK(opposition(hollow).edges == 480 && opposition(hollow).share.isOnes(0.0), "hollow: all");
  CHECK(opposition(Meshes::Patch(5, 0.0)).edges == 0, "flat: none");
  // A valley: a sheet bent upwards along y opposes across the bend, and along it nothing changes.
  TriangleMesh valley = Meshes::Patch(8, 0.0);
  valley.P.col(2) = valley.P.col(0).array().square();
  const OppositionReport bent = opposition(valley);
  int across = 0;
  const MeshEdges edges(valley.F);
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int h = edges.GetHalfEdges()[edges.GetOffset()[e]];
    across += valley.P(valley.F(h / 3, HalfEdgeStart(h % 3)), 0) !=
      valley.P(valley.F(h / 3, HalfEdgeEnd(h % 3)), 0);
  }
  CHECK(bent.edges == across, bent.edges << " edges oppose, " << across << " run across the bend");
}

//------------------------------------------------------------------------------------------------
void TestRigidMotion()
{
  Meshes::Random random(21);
  for (const Meshes::Named& named :
    std::vector<Meshes::Named>{ { "ellipsoid", Meshes::Ellipsoid(2) }, { "house", Meshes::House() },
      { "sheet", Meshes::Patch(6, 0.3) }, { "fan", Meshes::NonManifoldFan() },
      { "parts", Meshes::TwoComponents() } })
  {
    const TriangleMesh& mesh = named.mesh;
    const Points Q = Rigid(mesh.P, random.Rotation(), random.InCube());
    const Matrices R = SurfaceRotations(mesh, Q, 1);
    CHECK(CountTurnedOver(mesh.P, Q, mesh.F, R) == 0, named.name << ": triangles turned over");
    CHECK(DetailError(mesh.P, Q, mesh.F, R) <= 1e-13, named.name << ": detail error");
    CHECK(DihedralChange(mesh.P, Q, mesh.F, MeshEdges(mesh.F)) <= 1e-7, named.name << ": dihedral");
    const Eigen::VectorXd ratio =
      TriangleAreas(Q, mesh.F).array() / TriangleAreas(mesh.P, mesh.F).array();
    CHECK(LogSpread(ratio) <= 1e-13, named.name << ": area spread");
  }
}

void TestPairByHand()
{
  // A uniform stretch: no spread, no dihedral change, and a detail error of the size of the
  // details.
  const TriangleMesh ball = Meshes::Icosphere(2);
  const Points larger = 2.0 * ball.P;
  const Matrices I(ball.P.rows(), Eigen::Matrix3d::Identity());
  CHECK(DihedralChange(ball.P, larger, ball.F, MeshEdges(ball.F)) <= 1e-12, "stretched: dihedral");
  CHECK(DetailError(ball.P, larger, ball.F, I) > 1e-3, "stretched: details grow");
  CHECK_NEAR(LogSpread(Eigen::Vector4d(1.0, 1.0, std::exp(2.0), std::exp(2.0))), 1.0, 1e-14,
    "spread of ratios 1 and e^2");
  CHECK(LogSpread(Eigen::VectorXd()) == 0.0, "spread of none");

  // A sheet bent by 30 degrees at one edge line of 10: rms 30 sqrt(1 / 3) for 1 of 3 edges bent.
  const TriangleMesh strip =
    Meshes::Make({ { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 2, 0, 0 }, { 2, 1, 0 } },
      { { 0, 2, 1 }, { 2, 3, 1 }, { 2, 4, 3 }, { 4, 5, 3 } });
  Points bent = strip.P;
  bent.row(4) << 1.0 + std::cos(30.0 * Degree), 0.0, std::sin(30.0 * Degree);
  bent.row(5) << 1.0 + std::cos(30.0 * Degree), 1.0, std::sin(30.0 * Degree);
  CHECK_NEAR(DihedralChange(strip.P, bent, strip.F, MeshEdges(strip.F)),
    30.0 * Degree / std::sqrt(3.0), 1e-12, "one of three edges bent by 30 degrees");
  // From 170 degrees one way to 170 the other it is 20 degrees, not 340.
  const auto folded = [&](double angle)
  {
    Points P = strip.P;
    P.row(4) << 1.0 + std::cos(angle * Degree), 0.0, std::sin(angle * Degree);
    P.row(5) << 1.0 + std::cos(angle * Degree), 1.0, std::sin(angle * Degree);
    return P;
  };
  CHECK_NEAR(DihedralChange(folded(170.0), folded(-170.0), strip.F, MeshEdges(strip.F)),
    20.0 * Degree / std::sqrt(3.0), 1e-12, "the shorter way around");
}

/// A point of a fine sheet or ball pulled across its neighbors: some of the triangles at it turn
/// over, whatever the large turn that comes on top, and those that do are known by hand.
void TestTurnedOver()
{
  Meshes::Random random(22);
  const TriangleMesh sheet = Meshes::Patch(10, 0.0);
  const int middle = 5 * 11 + 5;
  Points pulled = sheet.P;
  pulled.row(middle) += 1.5 * (sheet.P.row(middle + 1) - sheet.P.row(middle));
  std::vector<char> expected(sheet.F.rows(), 0);
  for (int f = 0; f < sheet.F.rows(); ++f)
  {
    const Eigen::Vector3d a = pulled.row(sheet.F(f, 1)) - pulled.row(sheet.F(f, 0));
    const Eigen::Vector3d b = pulled.row(sheet.F(f, 2)) - pulled.row(sheet.F(f, 0));
    expected[f] = a.cross(b).z() < 0.0; // all look up before
  }
  const auto count = std::count(expected.begin(), expected.end(), 1);
  CHECK(count == 2, "the pull should turn 2 triangles over, not " << count);
  for (int k = 0; k < 20; ++k)
  {
    const Points Q = Rigid(pulled, random.Rotation(), random.InCube());
    CHECK(TurnedOver(sheet.P, Q, sheet.F, SurfaceRotations(sheet, Q, 1)) == expected,
      "the same triangles, however the sheet is turned");
    CHECK(TurnedOver(sheet.P, 1e-3 * Q, sheet.F, SurfaceRotations(sheet, 1e-3 * Q, 1)) == expected,
      "and scaled");
  }
  // Half the sheet folded over by 180 degrees along a line is a turn, not triangles turned over,
  // away from the fold.
  Points folded = sheet.P;
  for (int i = 0; i < folded.rows(); ++i)
  {
    folded(i, 0) = -std::abs(folded(i, 0));
  }
  const std::vector<char> over =
    TurnedOver(sheet.P, folded, sheet.F, SurfaceRotations(sheet, folded, 1));
  for (int f = 0; f < sheet.F.rows(); ++f)
  {
    const bool far = (sheet.P(sheet.F.row(f), AllColumns).col(0).array().abs() > 0.39).all();
    CHECK(!far || !over[f], "triangle " << f << " is far from the fold");
  }
  // The mean of the rotations at the corners decides.
  const TriangleMesh triangle = Meshes::Patch(1, 0.0);
  const Eigen::Matrix3d halfTurn = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  for (int k = 0; k < 3; ++k)
  {
    Matrices one(triangle.P.rows(), Eigen::Matrix3d::Identity());
    Matrices two(triangle.P.rows(), halfTurn);
    one[triangle.F(0, k)] = halfTurn;
    two[triangle.F(0, k)] = Eigen::Matrix3d::Identity();
    CHECK(!TurnedOver(triangle.P, triangle.P, triangle.F, one)[0], "one corner of three: " << k);
    CHECK(TurnedOver(triangle.P, triangle.P, triangle.F, two)[0], "all corners but " << k);
  }
}

/// Areas and volumes are infinite at the large sizes and 0 at the small ones, but what has no unit
/// is the same, to the bit: powers of two change no digit.
void TestAtAnySize()
{
  const TriangleMesh mesh = Meshes::Ellipsoid(2);
  const Triangles open = mesh.F.topRows(100);
  const Vector3d center(0.1, 0.2, -0.3);
  const Points ofPoints = PointNormals(mesh.P, mesh.F);
  const Points ofTriangles = TriangleNormals(mesh.P, mesh.F);
  CHECK((ofPoints.rowwise().norm().array() - 1.0).abs().maxCoeff() <= 1e-15, "unit normals");
  for (const int exponent : { -990, -600, 600, 990 })
  {
    const double size = std::ldexp(1.0, exponent);
    const Points P = size * mesh.P;
    CHECK(PointNormals(P, mesh.F) == ofPoints, "normals of points at size 2^" << exponent);
    CHECK(TriangleNormals(P, mesh.F) == ofTriangles, "of triangles at size 2^" << exponent);
    CHECK(Sphericity(P, mesh.F) == Sphericity(mesh.P, mesh.F), "sphericity at 2^" << exponent);
    CHECK(RadiusSpread(P, size * center) == RadiusSpread(mesh.P, center),
      "radius spread at 2^" << exponent);
    CHECK(VolumeAmbiguity(P, open) == VolumeAmbiguity(mesh.P, open),
      "volume ambiguity at 2^" << exponent);
  }
  CHECK(PointNormals(Points::Zero(3, 3), Triangles{ { 0, 1, 2 } }).isZero(0.0), "at no size");
  CHECK(RadiusSpread(mesh.P, 1e200 * center) < 1e-15, "from far away all are equally far");
}

/// Against the volumes from apices apart.
void TestVolumeAmbiguity()
{
  const TriangleMesh ball = Meshes::Icosphere(3);
  CHECK(VolumeAmbiguity(ball.P, ball.F) < 1e-14, "a closed surface has a volume");
  TriangleMesh open = ball;
  open.F.conservativeResize(open.F.rows() * 3 / 4, 3);
  TriangleMesh turned = ball;
  for (int f = 0; f < 7; ++f)
  {
    turned.F.row(f).reverseInPlace();
  }
  for (const TriangleMesh& mesh : { open, turned })
  {
    const double volume = EnclosedVolume(mesh.P, mesh.F);
    const double r = std::cbrt(3.0 * volume / (4.0 * Meshes::Pi));
    const Vector3d apex = mesh.P.colwise().mean();
    const auto from = [&mesh](const Vector3d& O)
    {
      double sixfold = 0.0;
      for (int f = 0; f < mesh.F.rows(); ++f)
      {
        sixfold += TripleProduct(mesh.P, mesh.F, f, O);
      }
      return sixfold / 6.0;
    };
    CHECK_NEAR(from(apex), volume, 1e-12, "cones from the mean point");
    // The apex may move anywhere: the largest change is along the gradient.
    const double step = 0.5;
    Vector3d gradient;
    for (int k = 0; k < 3; ++k)
    {
      gradient(k) = (from(apex + step * Vector3d::Unit(k)) - volume) / step;
    }
    CHECK_NEAR(VolumeAmbiguity(mesh.P, mesh.F), gradient.norm() * r / volume, 1e-12,
      "the share by which the volume changes");
  }
  CHECK(VolumeAmbiguity(turned.P, turned.F) > 1e-3, "not all triangles face one way");
  CHECK_NEAR(BallRadius(-4.0 / 3.0 * Meshes::Pi * 8.0), 2.0, 1e-15, "radius of a ball inside out");
}

void TestDegenerate()
{
  const Vector3d O = Vector3d::Zero();
  const Vector3d x = Vector3d::UnitX();
  for (const double scale : { 1e-150, 1e-6, 1.0, 1e150 })
  {
    CHECK(!IsDegenerate(O, scale * x, scale * Vector3d(0.5, 1e-9, 0)), "an angle of 2e-9");
    CHECK(IsDegenerate(O, scale * x, scale * Vector3d(0.5, 1e-11, 0)), "an angle of 2e-11");
    CHECK(IsDegenerate(O, scale * x, scale * x), "two points at one place");
  }
  CHECK(IsDegenerate(O, O, O), "three points at one place");
}
}

int main()
{
  TestEdges();
  TestAngles();
  TestWeights();
  TestSphereFit();
  TestDirections();
  TestRigidMotion();
  TestPairByHand();
  TestTurnedOver();
  TestAtAnySize();
  TestVolumeAmbiguity();
  TestDegenerate();
  return CheckResult();
}
