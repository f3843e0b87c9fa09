// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Shapes in place of the target sphere [target]: points on them satisfy their equations, sizes and
// moments are those that they should be, and shapes follow the model.
#include "Check.h"
#include "Meshes.h"
#include "SurfaceMeasures.h"
#include "TargetDirections.h"
#include "TargetShape.h"

#include <algorithm>

using namespace SphericalStyle;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
constexpr double Tolerance = 1e-12;
const Matrix3d NoMoments = Matrix3d::Identity();
const Vector3d Lengths(1.0, 2.0, 0.7);

ShapeOptions Of(TargetKind kind, double edges = 0.5, const Vector3d& lengths = Lengths)
{
  ShapeOptions options;
  options.kind = kind;
  options.edges = edges;
  options.lengths = lengths;
  return options;
}

Vector3d Direction(Meshes::Random& random)
{
  return random.InCube().normalized();
}

Matrix3d Turn(double degrees, const Vector3d& axis)
{
  return Eigen::AngleAxisd(degrees * Pi / 180.0, axis.normalized()).toRotationMatrix();
}

/// Distance from the surface of all that is within rho of a box.
double FromRoundedBox(const Vector3d& x, const Vector3d& b, double rho)
{
  const Vector3d beyond = x.cwiseAbs() - b;
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0) - rho;
}

/// How far a point is from the equation of the shape, by other formulas than those of the solver.
double Residual(TargetKind kind, double edges, const Vector3d& h, const Vector3d& x)
{
  switch (kind)
  {
    case TargetKind::Ellipsoid:
      return x.cwiseQuotient(h).squaredNorm() - 1.0;
    case TargetKind::Superquadric:
      return x.cwiseQuotient(h).array().abs().pow(2.0 / edges).sum() - 1.0;
    case TargetKind::Box:
    {
      const double rho = edges * h.minCoeff();
      return FromRoundedBox(x, h.array() - rho, rho);
    }
    case TargetKind::Capsule: // along y, the longest
      return (x - Vector3d(0.0, std::clamp(x.y(), h.x() - h.y(), h.y() - h.x()), 0.0)).norm() -
        h.x();
    case TargetKind::Cylinder:
    {
      const double rho = edges * std::min(h.x(), h.y());
      return FromRoundedBox(
        { std::hypot(x.x(), x.z()), x.y(), 0.0 }, { h.x() - rho, h.y() - rho, 0.0 }, rho);
    }
    default:
      return NAN;
  }
}

void TestEquations()
{
  Meshes::Random random(1);
  for (const auto& [kind, name] : { std::pair(TargetKind::Ellipsoid, "ellipsoid"),
         std::pair(TargetKind::Capsule, "capsule"), std::pair(TargetKind::Cylinder, "cylinder"),
         std::pair(TargetKind::Box, "box"), std::pair(TargetKind::Superquadric, "superquadric") })
  {
    for (const double edges : { 0.1, 0.5, 1.0 })
    {
      const TargetShape shape(Of(kind, edges), NoMoments);
      for (int k = 0; k < 200; ++k)
      {
        Vector3d d = Direction(random);
        if (k < 3)
        {
          d = Vector3d::Unit(k);
        }
        const Vector3d x = shape.Reach(d);
        CHECK_NEAR(Residual(kind, edges, shape.GetHalfLengths(), x), 0.0, Tolerance / edges,
          name << " " << edges << " toward " << d.transpose());
        CHECK(x.cross(d).norm() < Tolerance && x.dot(d) > 0.0, name << ": should lie on the ray");
        CHECK((shape.Reach(0.3 * d) - 0.3 * x).norm() < Tolerance, name << ": a shorter direction");
      }
    }
  }
  const TargetShape sharp(Of(TargetKind::Box, 0.0, { 1.0, 1.0, 1.0 }), NoMoments);
  const double half = sharp.GetHalfLengths().x();
  CHECK_NEAR(sharp.RadiusAlong(Vector3d::Ones().normalized()), std::sqrt(3.0) * half, Tolerance,
    "the corner of a cube");
  const TargetShape limit(Of(TargetKind::Superquadric, 0.0, { 1.0, 1.0, 1.0 }), NoMoments);
  CHECK_NEAR(limit.RadiusAlong(Vector3d::UnitX()), half, Tolerance, "a superquadric with q = 0");
}

TriangleMesh MeshOf(const TargetShape& shape)
{
  TriangleMesh mesh = Meshes::Icosphere(5);
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    mesh.P.row(i) = shape.Reach(mesh.P.row(i).transpose().normalized());
  }
  return mesh;
}

void TestSizes()
{
  for (const TargetKind kind : { TargetKind::Ellipsoid, TargetKind::Capsule, TargetKind::Cylinder,
         TargetKind::Box, TargetKind::Superquadric })
  {
    for (const double edges : { 0.0, 0.5, 1.0 })
    {
      const TriangleMesh byArea = MeshOf(TargetShape(Of(kind, edges), NoMoments));
      CHECK_NEAR(TriangleAreas(byArea.P, byArea.F).sum() / (4.0 * Pi), 1.0, 0.01,
        "area of shape " << static_cast<int>(kind) << " with edges " << edges);
      const TriangleMesh byVolume = MeshOf(TargetShape(Of(kind, edges), NoMoments, true));
      CHECK_NEAR(EnclosedVolume(byVolume.P, byVolume.F) / (4.0 / 3.0 * Pi), 1.0, 0.01,
        "volume of shape " << static_cast<int>(kind) << " with edges " << edges);
    }
  }
  // By the formula of Steiner: sides 2 b, and what rho adds around them.
  const TargetShape box(Of(TargetKind::Box), NoMoments);
  const Vector3d h = box.GetHalfLengths();
  const double rho = 0.5 * h.minCoeff();
  const Vector3d b = h.array() - rho;
  CHECK_NEAR((8.0 * (b.x() * b.y() + b.y() * b.z() + b.z() * b.x()) + 4.0 * Pi * rho * b.sum() +
               4.0 * Pi * rho * rho) /
      (4.0 * Pi),
    1.0, 0.002, "area of a box with round edges");
  const TargetShape capsule(Of(TargetKind::Capsule, 0.0, { 1.0, 3.0, 1.0 }), NoMoments);
  const Vector3d c = capsule.GetHalfLengths();
  CHECK_NEAR(c.y() / c.x(), 3.0, Tolerance, "lengths of a capsule");
  CHECK_NEAR(c.x() * c.y(), 1.0, 0.002, "area of a capsule over that of the sphere");
}

void TestSphereIsSpecialCase()
{
  Meshes::Random random(2);
  for (const TargetKind kind :
    { TargetKind::Ellipsoid, TargetKind::Capsule, TargetKind::Cylinder, TargetKind::Box })
  {
    for (const bool equalVolume : { false, true })
    {
      const TargetShape shape(Of(kind, 1.0, Vector3d::Constant(5.0)), NoMoments, equalVolume);
      const Vector3d d = Direction(random);
      CHECK_NEAR(shape.RadiusAlong(d), 1.0, Tolerance, "a shape that is the sphere");
    }
  }
  const TargetShape sphere;
  CHECK(sphere.IsSphere() && sphere.Reach(Vector3d::UnitY()) == Vector3d::UnitY(),
    "the default is the sphere");
}

/// A model that is such a shape is its own target, wherever it is and however it is turned.
void TestOwnProportions()
{
  Meshes::Random random(3);
  for (const TargetKind kind : { TargetKind::Ellipsoid, TargetKind::Capsule, TargetKind::Cylinder,
         TargetKind::Box, TargetKind::Superquadric })
  {
    for (const bool turned : { false, true })
    {
      const Matrix3d R = Turn(turned ? 40.0 : 0.0, { 1.0, 1.0, -2.0 }); // no axis near another
      const TargetShape given(Of(kind), NoMoments);
      TriangleMesh mesh = MeshOf(given);
      mesh.P = (3.0 * mesh.P * R.transpose()).eval();
      mesh.P.rowwise() += Eigen::RowVector3d(1.0, -2.0, 5.0);
      const TargetShape own(Of(kind, 0.5, Vector3d::Zero()), AreaMoments(mesh.P, mesh.F));
      double worst = 0.0;
      for (int k = 0; k < 200; ++k)
      {
        const Vector3d d = Direction(random);
        worst = std::max(worst, std::abs(own.RadiusAlong(R * d) - given.RadiusAlong(d)));
      }
      CHECK(worst < 0.002,
        "shape " << static_cast<int>(kind) << (turned ? ", turned," : "")
                 << " is not its own target: off by " << worst);
    }
  }
}

void TestAxes()
{
  const auto axesOf = [](const Vector3d& moments, const Matrix3d& R)
  {
    const Matrix3d C = R * moments.asDiagonal() * R.transpose();
    return TargetShape(Of(TargetKind::Ellipsoid, 0.5, Vector3d::Zero()), C).GetAxes();
  };
  const Vector3d apart(1.0, 4.0, 9.0);
  CHECK(axesOf(apart, Turn(15.0, { 1.0, 2.0, 3.0 })).isIdentity(), "near the coordinates: theirs");
  CHECK(axesOf(apart, Turn(30.0, Vector3d::UnitY())).isApprox(Turn(30.0, Vector3d::UnitY())),
    "about an axis of the coordinates");
  const Matrix3d leaning = Turn(10.0, Vector3d::UnitX()) * Turn(30.0, Vector3d::UnitY());
  const Matrix3d E = axesOf(apart, leaning);
  CHECK(E.col(1) == Vector3d::UnitY() && (E.transpose() * E).isIdentity() && !E.isIdentity(),
    "upright where it leans by 10 degrees");
  const Matrix3d any = Turn(40.0, { 1.0, 1.0, -2.0 });
  CHECK(axesOf(apart, any).isApprox(any), "far from the coordinates: its own");
  CHECK(axesOf({ 1.0, 1.01, 1.02 }, any).isIdentity(), "a ball has no axes");
  const Matrix3d disk = axesOf({ 4.0, 1.0, 4.01 }, Turn(30.0, Vector3d::UnitX()));
  CHECK(disk.isApprox(Turn(30.0, Vector3d::UnitX())), "a disk has one, and turns no further");
  CHECK(axesOf({ 4.0, 1.0, 4.01 }, Turn(77.0, Vector3d::UnitY())).isIdentity(),
    "about its own axis a disk does not turn");
}

void TestFlat()
{
  const TargetShape shape(
    Of(TargetKind::Box, 0.5, Vector3d::Zero()), Vector3d(1.0, 2.0, 0.0).asDiagonal());
  const Vector3d h = shape.GetHalfLengths();
  CHECK_NEAR(h.z(), 0.1 * h.maxCoeff(), Tolerance, "the least half length");
}

void TestMesh()
{
  TriangleMesh mesh = Meshes::Icosphere(2);
  mesh.P.col(0) *= 2.0;
  mesh.P.rowwise() += Eigen::RowVector3d(10.0, 20.0, 30.0);
  ShapeOptions options = Of(TargetKind::Mesh);
  options.mesh = std::make_shared<StarMesh>(mesh);
  const Eigen::RowVector3d O = AreaCentroid(mesh.P, mesh.F).transpose();
  const double scale = std::sqrt(4.0 * Pi / TriangleAreas(mesh.P, mesh.F).sum());
  const TargetShape shape(options, NoMoments);
  // Corners, middles of edges and inner points are on the target.
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    for (const Vector3d& b :
      { Vector3d(1.0, 0.0, 0.0), Vector3d(0.5, 0.5, 0.0), Vector3d(0.2, 0.3, 0.5) })
    {
      const Vector3d x =
        scale * ((b.transpose() * mesh.P(mesh.F.row(f), AllColumns)) - O).transpose();
      CHECK_NEAR((shape.Reach(x.normalized()) - x).norm(), 0.0, 1e-12, "triangle " << f);
    }
  }
  const TargetShape byVolume(options, NoMoments, true);
  CHECK_NEAR(byVolume.RadiusAlong(Vector3d::UnitX()) / shape.RadiusAlong(Vector3d::UnitX()),
    std::cbrt(4.0 / 3.0 * Pi / EnclosedVolume(mesh.P, mesh.F)) / scale, 1e-12, "by volume");
  // Inside out it is the same surface.
  TriangleMesh inward = mesh;
  inward.F.col(1).swap(inward.F.col(2));
  options.mesh = std::make_shared<StarMesh>(inward);
  CHECK_NEAR(TargetShape(options, NoMoments).RadiusAlong(Vector3d::UnitZ()),
    shape.RadiusAlong(Vector3d::UnitZ()), 1e-12, "inside out");

  // Nearer to the centroid than a search along a ray looks.
  TriangleMesh leaf = Meshes::Icosphere(3);
  leaf.P.col(2) *= 1e-7;
  options.mesh = std::make_shared<StarMesh>(leaf);
  const TargetShape thin(options, NoMoments);
  const double size = std::sqrt(4.0 * Pi / TriangleAreas(leaf.P, leaf.F).sum());
  for (Eigen::Index i = 0; i < leaf.P.rows(); ++i)
  {
    const Vector3d x = size * leaf.P.row(i);
    CHECK_NEAR((thin.Reach(x.normalized()) - x).norm(), 0.0, 1e-6 * x.norm(), "leaf, point " << i);
  }

  const TriangleMesh doll = Meshes::Doll();
  CHECK_THROWS(NotStarShaped, StarMesh{ doll }, "is not seen from");
  TriangleMesh open = mesh;
  open.F.conservativeResize(open.F.rows() - 1, 3);
  CHECK_THROWS(std::invalid_argument, StarMesh{ open }, "open");
  CHECK_THROWS(std::invalid_argument, StarMesh{ TriangleMesh() }, "no triangle");
  open.P(0, 0) = NAN;
  CHECK_THROWS(std::invalid_argument, StarMesh{ open }, "not finite");
}
}

int main()
{
  TestEquations();
  TestSizes();
  TestSphereIsSpecialCase();
  TestOwnProportions();
  TestAxes();
  TestFlat();
  TestMesh();
  return CheckResult();
}
