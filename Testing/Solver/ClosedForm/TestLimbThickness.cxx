// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What follows its normals keeps the thickness of its limbs while its bones become shorter.
#include "Check.h"
#include "Dense.h"
#include "LimbThickness.h"
#include "Meshes.h"
#include "SphericalStyleMethod.h"

#include <algorithm>
#include <string>

using namespace SphericalStyle;

namespace
{
using Meshes::Vector;

/// A straight limb or, where its ends are one place, a ball.
struct Limb
{
  std::string name;
  Vector from;
  Vector to;
  double radius;
};

struct Model
{
  std::string name;
  TriangleMesh mesh;
  std::vector<Limb> limbs;
};

Model DumbBell()
{
  const Vector left(-0.72, 0.0, 0.0), right(0.72, 0.0, 0.0);
  constexpr double ball = 0.24, bar = 0.09;
  const auto f = [&](const Vector& x)
  {
    return std::min({ Meshes::Capsule(x, left, right, bar), (x - left).norm() - ball,
      (x - right).norm() - ball });
  };
  return { "dumb-bell",
    Meshes::Isosurface(f, { -1.013, -0.287, -0.291 }, { 1.02, 0.29, 0.29 }, 0.0197),
    { { "bar", left, right, bar }, { "left ball", left, left, ball },
      { "right ball", right, right, ball } } };
}

Model Table()
{
  constexpr double leg = 0.085, top = 0.1;
  std::vector<Limb> limbs;
  for (int k = 0; k < 4; ++k)
  {
    const double x = k % 2 == 0 ? -0.6 : 0.6, y = k / 2 == 0 ? -0.4 : 0.4;
    limbs.push_back({ "leg " + std::to_string(k), { x, y, -1.1 }, { x, y, 0.0 }, leg });
  }
  const auto f = [&](const Vector& x)
  {
    // A rounded plate.
    const Vector away = (x.cwiseAbs() - Vector(0.65, 0.45, 0.0)).cwiseMax(0.0);
    double distance = away.norm() - top;
    for (const Limb& limb : limbs)
    {
      distance = std::min(distance, Meshes::Capsule(x, limb.from, limb.to, limb.radius));
    }
    return distance;
  };
  return { "table", Meshes::Isosurface(f, { -0.793, -0.591, -1.227 }, { 0.79, 0.58, 0.13 }, 0.0211),
    limbs };
}

/// Points of a limb from one share of its length to another: of the shaft, or of the half of a ball
/// that looks away from the middle of the model.
std::vector<int> PointsOf(const Model& model, const Limb& limb, double from, double to)
{
  std::vector<int> points;
  const Vector along = limb.to - limb.from;
  for (int i = 0; i < model.mesh.P.rows(); ++i)
  {
    const Vector x = model.mesh.P.row(i).transpose() - limb.from;
    if (along.norm() == 0.0)
    {
      if (std::abs(x.norm() - limb.radius) < 0.02 * limb.radius && x.dot(limb.from) > 0.0)
      {
        points.push_back(i);
      }
      continue;
    }
    const double t = x.dot(along) / along.squaredNorm();
    if (t > from && t < to && (x - t * along).norm() < 1.02 * limb.radius)
    {
      points.push_back(i);
    }
  }
  return points;
}

/// Mean distance of points from the axis of a limb of that direction through their own middle, or
/// radius of the ball that fits them best.
double RadiusOf(const Points& Q, const std::vector<int>& points, const Vector& along)
{
  Points x(points.size(), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    x.row(i) = Q.row(points[i]);
  }
  if (along.norm() == 0.0)
  {
    Eigen::MatrixX4d A(x.rows(), 4);
    A << 2.0 * x, Eigen::VectorXd::Ones(x.rows());
    const Eigen::Vector4d fit = Dense::Solve(A, x.rowwise().squaredNorm());
    return std::sqrt(fit(3) + fit.head<3>().squaredNorm());
  }
  const Eigen::RowVector3d axis = along.normalized().transpose();
  x = x - (x * axis.transpose()) * axis;
  // Points are not spread evenly around the axis: the middle of the circle that fits them.
  const Vector u = axis.transpose().unitOrthogonal();
  const Vector v = Vector(axis.transpose()).cross(u);
  Eigen::MatrixX3d A(x.rows(), 3);
  A << 2.0 * x * u, 2.0 * x * v, Eigen::VectorXd::Ones(x.rows());
  const Eigen::Vector3d fit = Dense::Solve(A, x.rowwise().squaredNorm());
  return std::sqrt(fit(2) + fit.head<2>().squaredNorm());
}

Eigen::RowVector3d MiddleOf(const Points& Q, const std::vector<int>& points)
{
  return Q(points, AllColumns).colwise().mean();
}

void Measure(const Model& model)
{
  const double diagonal = Meshes::Diagonal(model.mesh.P);
  SphericalStyleMethod method;
  method.SetMesh(model.mesh);
  for (const double mu : { 1.0, 2.0 })
  {
    const double within = mu == 1.0 ? 0.026 : 0.035;
    // Near a ball the bar becomes thicker, and the normals of its base lean away from the ball: it
    // becomes shorter, the more so the larger mu. Near the end of a leg they lean outward.
    const double ofBarWithin = mu == 1.0 ? 0.06 : 0.12;
    const double ofLegWithin = mu == 1.0 ? 0.022 : 0.046;
    MethodOptions o;
    o.sphericalWeighting = SphericalWeighting::Cotangent;
    o.centerMode = CenterMode::AreaCentroid;
    o.lambda = mu / std::sqrt(3.0);
    o.normalBlend = 1.0;
    o.detailSize = 0.06;
    o.size.keep = KeepSize::Off;
    const StyleReport report = method.Solve(o);
    CHECK(report.closedForm, model.name << ": not in closed form");
    const Points& Q = method.GetPositions();
    const Points& P = model.mesh.P;
    for (const Limb& limb : model.limbs)
    {
      const std::string what = model.name + ", mu " + std::to_string(mu) + ": " + limb.name;
      const Vector along = limb.to - limb.from;
      const std::vector<int> middle = PointsOf(model, limb, 0.42, 0.58);
      const double thickness = RadiusOf(Q, middle, along) / RadiusOf(P, middle, along);
      std::cout << what << " of radius " << limb.radius / diagonal << " (" << middle.size()
                << " points) becomes " << thickness << " as thick";
      CHECK_NEAR(thickness, 1.0, within, what + ": thickness, of that at rest");
      if (along.norm() > 0.0)
      {
        const std::vector<int> a = PointsOf(model, limb, 0.3, 0.36);
        const std::vector<int> b = PointsOf(model, limb, 0.64, 0.7);
        const double length = (MiddleOf(Q, b) - MiddleOf(Q, a)).norm() /
          (MiddleOf(P, b) - MiddleOf(P, a)).norm() * (1.0 + mu);
        std::cout << ", " << length << " of 1 / (1 + mu) as long";
        CHECK_NEAR(length, 1.0, limb.name == "bar" ? ofBarWithin : ofLegWithin,
          what + ": length, of 1 / (1 + mu)");
      }
      std::cout << std::endl;
    }
    if (model.name == "dumb-bell")
    {
      const std::vector<int> a = PointsOf(model, model.limbs[1], 0.0, 1.0);
      const std::vector<int> b = PointsOf(model, model.limbs[2], 0.0, 1.0);
      // Halves of balls: their middles are off their centers by half a radius.
      const double off = model.limbs[1].radius;
      const double before = (MiddleOf(P, b) - MiddleOf(P, a)).norm() - off;
      const double after = (MiddleOf(Q, b) - MiddleOf(Q, a)).norm() - off;
      std::cout << model.name << ", mu " << mu << ": centers of the balls "
                << after / before * (1.0 + mu) << " of 1 / (1 + mu) apart" << std::endl;
      CHECK_NEAR(after / before * (1.0 + mu), 1.0, within,
        model.name + ": distance of the balls, of 1 / (1 + mu)");
    }
  }
}

/// Half of the thickness, in the units of the model.
Eigen::VectorXd ThicknessOf(const TriangleMesh& mesh, double radius)
{
  const Frame frame = FrameOf(mesh.P);
  const Points P = frame.Into(mesh.P);
  const Eigen::VectorXd rho = LimbThickness(P, P, mesh.F, radius, 2);
  CHECK(rho.size() == mesh.P.rows() && rho.allFinite() && rho.minCoeff() > 0.0,
    "the thickness must be above 0 everywhere");
  return frame.scale * rho;
}

/// Least and greatest of what is chosen.
template <typename Chosen>
Eigen::Vector2d RangeOf(const Eigen::VectorXd& rho, const Points& P, const Chosen& chosen)
{
  Eigen::Vector2d range(1e30, 0.0);
  for (int i = 0; i < P.rows(); ++i)
  {
    if (chosen(Vector(P.row(i))))
    {
      range << std::min(range(0), rho(i)), std::max(range(1), rho(i));
    }
  }
  return range;
}

/// A head on a body: what is opposite of the crown through the neck is the bottom of the body, but
/// the head is as thick as the head.
void Neck()
{
  const Vector body(0.0, 0.0, 0.0), head(0.0, 0.0, 1.05);
  const TriangleMesh mesh = Meshes::Isosurface([&](const Vector& x)
    { return std::min((x - body).norm() - 0.7, (x - head).norm() - 0.5); },
    { -0.813, -0.807, -0.791 }, { 0.82, 0.81, 1.67 }, 0.0401);
  const Eigen::VectorXd rho = ThicknessOf(mesh, 10.0);
  const Eigen::Vector2d crown = RangeOf(rho, mesh.P, [](const Vector& x) { return x.z() > 1.4; });
  const Eigen::Vector2d bottom = RangeOf(rho, mesh.P, [](const Vector& x) { return x.z() < -0.5; });
  std::cout << "crown of a head of .5: thickness " << crown.transpose()
            << "; bottom of a body of .7: " << bottom.transpose() << std::endl;
  CHECK(crown(0) > 0.49 && crown(1) < 0.51, "the crown has the thickness " << crown.transpose());
  CHECK(
    bottom(0) > 0.69 && bottom(1) < 0.71, "the bottom has the thickness " << bottom.transpose());
}

/// Edges do not make a box thin: what is beside a sample is not opposite.
void Edges()
{
  const TriangleMesh mesh = Meshes::Box(24);
  const Eigen::VectorXd rho = ThicknessOf(mesh, 10.0);
  std::cout << "box of half a width of 1: thickness " << rho.minCoeff() << " to " << rho.maxCoeff()
            << std::endl;
  CHECK(rho.minCoeff() > 0.99 && rho.maxCoeff() < 1.07,
    "a box has the half thickness " << rho.minCoeff() << " to " << rho.maxCoeff());
}

/// A sheet has no thickness, a ball has its radius, and a shell that of its wall.
void Shapes()
{
  using namespace Meshes;
  const Eigen::VectorXd ball = ThicknessOf(Icosphere(4), 10.0);
  CHECK(ball.maxCoeff() < 1.001 && ball.minCoeff() > 0.998,
    "a ball of radius 1 has the thickness " << ball.minCoeff() << " to " << ball.maxCoeff());
  const Eigen::VectorXd small = ThicknessOf(Icosphere(4), 0.1);
  CHECK_NEAR(small.maxCoeff(), 0.1 * std::sqrt(12.0), 1e-9, "a thickness above r");
  const TriangleMesh shell = HollowBall(0.4, 4);
  const Eigen::VectorXd wall = ThicknessOf(shell, 10.0);
  std::cout << "ball: thickness " << ball.minCoeff() << " to " << ball.maxCoeff()
            << "; wall of half thickness .2: " << wall.minCoeff() << " to " << wall.maxCoeff()
            << std::endl;
  CHECK(wall.maxCoeff() < 0.201 && wall.minCoeff() > 0.199,
    "a wall of .4 has the half thickness " << wall.minCoeff() << " to " << wall.maxCoeff());
  // Its base may be a sheet whose sides have changed places: the wall is thin, and not what is
  // behind it.
  const TriangleMesh thin = HollowBall(0.1, 4);
  const Frame frame = FrameOf(thin.P);
  const Points P = frame.Into(thin.P);
  Points B = P;
  for (int i = 0; i < B.rows(); ++i)
  {
    const double side = B.row(i).norm() > 0.95 / frame.scale ? -0.001 : 0.001;
    B.row(i) *= (0.95 / frame.scale + side) / B.row(i).norm();
  }
  const Eigen::VectorXd collapsed = LimbThickness(P, B, thin.F, 10.0, 2);
  std::cout << "wall whose base is a sheet: thickness " << collapsed.minCoeff() << " to "
            << collapsed.maxCoeff() << ", of the diagonal" << std::endl;
  CHECK(collapsed.maxCoeff() < 0.006,
    "a wall whose base is a sheet has the half thickness " << collapsed.maxCoeff());
  const double sheetRadius = 0.2;
  const Eigen::VectorXd sheet = ThicknessOf(Patch(12, 0.0), sheetRadius);
  CHECK_NEAR(sheet.minCoeff(), sheetRadius * Diagonal(Patch(12, 0.0).P), 1e-9,
    "a flat sheet, with nothing opposite,");
}
}

int main()
{
  Shapes();
  Neck();
  Edges();
  Measure(DumbBell());
  Measure(Table());
  return CheckResult();
}
