// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// A plane of symmetry [symmetry]: mirror images stay mirror images, also of a model with a bump on
// one side; what is symmetric along an axis anyway gets what it gets without a plane.
#include "Check.h"
#include "Meshes.h"
#include "SphericalStyleMethod.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
/// A bent body with bumps, the mirror image of itself where x changes its sign. The bump that is
/// not on both sides is on the side of larger x.
TriangleMesh Body(double bump)
{
  TriangleMesh mesh = Meshes::Scaled(Meshes::Icosphere(4), { 1.0, 0.35, 0.25 });
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    const double x = mesh.P(i, 0);
    const double y = mesh.P(i, 1);
    mesh.P.row(i).tail<2>() *=
      (1.0 + 0.06 * std::sin(19.0 * x * x + 31.0 * y)) * (1.0 + 0.5 * x * x);
    mesh.P(i, 1) += 0.2 * x * x + 0.05 * std::sin(9.0 * mesh.P(i, 2));
    const double away = (x - 0.8) / 0.07;
    mesh.P(i, 2) += bump * std::exp(-away * away);
  }
  return mesh;
}

/// The mirror image of each point of the body without a bump, by its coordinates.
std::vector<int> Twins()
{
  const Points P = Body(0.0).P;
  std::map<std::array<double, 3>, int> numbers;
  for (int i = 0; i < P.rows(); ++i)
  {
    numbers[{ P(i, 0), P(i, 1), P(i, 2) }] = i;
  }
  std::vector<int> twins(P.rows());
  for (int i = 0; i < P.rows(); ++i)
  {
    const auto found = numbers.find({ -P(i, 0), P(i, 1), P(i, 2) });
    CHECK(found != numbers.end(), "point " << i << " of the body has no mirror image");
    twins[i] = found == numbers.end() ? i : found->second;
  }
  return twins;
}

/// How the body lies in the world, and its plane with it.
struct Placed
{
  TriangleMesh mesh;
  MirrorPlane plane;
};

Placed Place(const TriangleMesh& mesh, const Eigen::Matrix3d& R, const Vector3d& move, double scale)
{
  Placed placed{ mesh, {} };
  placed.mesh.P = ((scale * mesh.P) * R.transpose()).rowwise() + move.transpose();
  placed.plane.normal = R.col(0).normalized();
  placed.plane.origin = move + R * Vector3d(0.0, 0.3, -0.2); // any point of it
  return placed;
}

std::vector<MethodOptions> Styles()
{
  std::vector<MethodOptions> styles;
  for (const double detailSize : { 0.0, 0.03, 0.08 })
  {
    for (const double blend : { 0.0, 0.6, 1.0 })
    {
      MethodOptions o;
      o.lambda = 1.0;
      o.sphericalWeighting = SphericalWeighting::Cotangent;
      o.detailSize = detailSize;
      o.normalBlend = blend;
      o.centerMode = blend > 0.5 ? CenterMode::AreaCentroid : CenterMode::PointMean;
      o.size.keep = detailSize > 0.05 ? KeepSize::Extent : KeepSize::Area;
      o.keepRotations = true;
      styles.push_back(o);
    }
  }
  return styles;
}

struct Outcome
{
  Points Q;
  Matrices R;
  Points T;
  StyleReport report;
};

Outcome Solve(
  const TriangleMesh& mesh, const MethodOptions& o, const std::optional<MirrorPlane>& plane)
{
  SphericalStyleMethod method;
  method.SetMesh(std::make_shared<const TriangleMesh>(mesh), {}, nullptr, plane);
  Outcome outcome;
  outcome.report = method.Solve(o);
  outcome.Q = method.GetPositions();
  outcome.R = method.GetRotations();
  outcome.T = method.GetDirections();
  return outcome;
}

/// Largest distance between the mirror image of a point and its twin, where both are on the part
/// that has no bump.
double Asymmetry(const Points& Q, const MirrorPlane& plane, const std::vector<int>& twins,
  const Points& body, double mostX)
{
  double most = 0.0;
  for (int i = 0; i < Q.rows(); ++i)
  {
    if (std::abs(body(i, 0)) < mostX)
    {
      const Vector3d image = plane.Mirror(Q.row(i).transpose());
      most = std::max(most, (image - Q.row(twins[i]).transpose()).norm());
    }
  }
  return most / Meshes::Diagonal(Q);
}

void MirrorImages()
{
  Meshes::Random random(17);
  const std::vector<int> twins = Twins();
  const Points body = Body(0.0).P;
  double with = 0.0;
  double turns = 0.0;
  double leastWithout = 1.0;
  for (const double bump : { 0.0, 0.12 })
  {
    const double mostX = bump > 0.0 ? 0.3 : 2.0; // the bump is below rounding there
    for (const MethodOptions& o : Styles())
    {
      const Placed placed = Place(Body(bump), random.Rotation(), 3.0 * random.InCube(), 0.7);
      const Outcome found = Solve(placed.mesh, o, placed.plane);
      const double asymmetry = Asymmetry(found.Q, placed.plane, twins, body, mostX);
      with = std::max(with, asymmetry);
      CHECK(asymmetry < 1e-11,
        "s " << o.detailSize << " a " << o.normalBlend << " bump " << bump << ": " << asymmetry);
      const Vector3d n = placed.plane.normal;
      const Eigen::Matrix3d M = Eigen::Matrix3d::Identity() - 2.0 * n * n.transpose();
      for (int i = 0; i < found.Q.rows(); ++i)
      {
        if (std::abs(body(i, 0)) < mostX)
        {
          turns = std::max(turns, (M * found.R[i] * M - found.R[twins[i]]).norm());
        }
      }
      if (bump > 0.0 || o.detailSize > 0.0)
      {
        const Outcome free = Solve(placed.mesh, o, {});
        leastWithout = std::min(leastWithout, Asymmetry(free.Q, placed.plane, twins, body, mostX));
      }
    }
  }
  CHECK(turns < 1e-10, "rotations of mirror images differ by " << turns);
  CHECK(leastWithout > 1e-6, "without a plane the difference is no more than " << leastWithout);
  std::cout << "mirror images: " << with << " of the diagonal, rotations " << turns
            << "; without a plane at least " << leastWithout << "\n";
}

/// Along an axis, through the middle of the bounds, the grid is symmetric as it is.
void AlongAnAxis()
{
  double most = 0.0;
  for (const MethodOptions& o : Styles())
  {
    const TriangleMesh mesh = Meshes::Moved(Body(0.0), { 2.0, 0.0, 0.0 });
    MirrorPlane plane;
    plane.origin = { 2.0, 5.0, 1.0 };
    const Outcome with = Solve(mesh, o, plane);
    const Outcome without = Solve(mesh, o, {});
    const double scale = Meshes::Diagonal(mesh.P);
    most = std::max(most, Meshes::Distance(with.Q, without.Q) / scale);
    CHECK_NEAR(with.report.sphere.radius, without.report.sphere.radius, 1e-12, "the radius");
    CHECK((with.report.sphere.center - without.report.sphere.center).norm() < 1e-12, "the center");
    CHECK_NEAR(with.report.sizeFactor, without.report.sizeFactor, 1e-9, "the factor of the size");
    CHECK((with.T - without.T).rowwise().norm().maxCoeff() < 1e-8, "the directions");
  }
  CHECK(most < 1e-9, "a plane along an axis changes the result by " << most);
  std::cout << "along an axis the plane changes " << most << " of the diagonal\n";
}

/// Up stays up, whatever the plane is turned to.
void Ground()
{
  Meshes::Random random(3);
  const Placed placed = Place(Body(0.1), random.Rotation(), { 0.1, 0.2, 0.3 }, 1.0);
  for (MethodOptions o : Styles())
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      o.size.up = Vector3d::Unit(axis);
      o.size.keep = KeepSize::Extent;
      o.size.keepOnGround = true;
      const Points Q = Solve(placed.mesh, o, placed.plane).Q;
      CHECK_NEAR(Q.col(axis).minCoeff(), placed.mesh.P.col(axis).minCoeff(), 1e-12, "the ground");
      CHECK_NEAR(Q.col(axis).maxCoeff(), placed.mesh.P.col(axis).maxCoeff(), 1e-12, "the height");
    }
  }
}

void Unmoved()
{
  const Placed placed = Place(Body(0.1), Meshes::Random(5).Rotation(), { 0.1, 0.2, 0.3 }, 1.0);
  MethodOptions o = Styles().back();
  o.lambda = 0.0;
  CHECK(Meshes::SameBits(Solve(placed.mesh, o, placed.plane).Q, placed.mesh.P), "lambda 0");
  o.lambda = 1.0;
  o.size = {};
  for (int i = 0; i < 100; ++i)
  {
    o.fixedPoints.push_back(3 * i);
  }
  o.fixedPositions = placed.mesh.P(o.fixedPoints, Eigen::indexing::all);
  const Points Q = Solve(placed.mesh, o, placed.plane).Q;
  CHECK(Meshes::SameBits(Q(o.fixedPoints, Eigen::indexing::all), o.fixedPositions), "fixed points");
  // The same mesh with another plane, and with none, is solved anew.
  SphericalStyleMethod method;
  const auto mesh = std::make_shared<const TriangleMesh>(placed.mesh);
  o = Styles().back();
  for (const std::optional<MirrorPlane>& plane :
    { std::optional<MirrorPlane>(), std::optional(placed.plane), std::optional<MirrorPlane>() })
  {
    method.SetMesh(mesh, {}, nullptr, plane);
    method.Solve(o);
    CHECK(Meshes::SameBits(method.GetPositions(), Solve(placed.mesh, o, plane).Q), "kept");
  }
}

void Refused()
{
  const Placed placed = Place(Body(0.1), Meshes::Random(5).Rotation(), { 0.1, 0.2, 0.3 }, 1.0);
  MethodOptions o = Styles().back();
  o.centerMode = CenterMode::Custom;
  o.custom.center = placed.plane.origin + 0.25 * placed.plane.normal;
  const Sphere sphere = Solve(placed.mesh, o, placed.plane).report.sphere;
  CHECK((sphere.center - placed.plane.origin).norm() < 1e-12, "a center off the plane");
  o = Styles().back();
  o.centerIds.assign(placed.mesh.P.rows(), 0);
  o.centerIds.back() = 1;
  CHECK_THROWS(std::invalid_argument, Solve(placed.mesh, o, placed.plane), "one center");
  o = Styles().back();
  o.sphericalWeighting = SphericalWeighting::Uniform;
  CHECK_THROWS(std::invalid_argument, Solve(placed.mesh, o, placed.plane), "closed form");
  SphericalStyleMethod method;
  const auto mesh = std::make_shared<const TriangleMesh>(placed.mesh);
  CHECK_THROWS(std::invalid_argument, method.SetMesh(mesh, {}, mesh, placed.plane), "rest pose");
}
}

int main()
{
  MirrorImages();
  AlongAnAxis();
  Ground();
  Unmoved();
  Refused();
  return CheckResult();
}
