// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Thickness before and after: on boxes by hand, on a bumpy surface against a search through all
/// triangles, and what the style leaves of walls and plates.
#include "Check.h"
#include "Meshes.h"
#include "SphericalStyleMethod.h"
#include "SurfaceMeasures.h"
#include "Thickness.h"

#include <algorithm>
#include <array>
#include <numeric>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
ThicknessProbes ProbesOf(const TriangleMesh& mesh, int threads = 1, int stride = 1)
{
  std::vector<int> points;
  for (int i = 0; i < mesh.P.rows(); i += stride)
  {
    points.push_back(i);
  }
  return PlaceThicknessProbes(mesh, points, threads);
}

Vector3d Opposite(const TriangleMesh& mesh, const ThicknessProbes& probes, std::size_t i)
{
  const Points corners = mesh.P(mesh.F.row(probes.triangles[i]), AllColumns);
  return (probes.barycentric.row(static_cast<Eigen::Index>(i)) * corners).transpose();
}

bool Same(const ThicknessProbes& a, const ThicknessProbes& b)
{
  return a.points == b.points && a.triangles == b.triangles &&
    Meshes::SameBits(a.barycentric, b.barycentric);
}

void TestBox()
{
  const Vector3d half(1.0, 2.0, 3.0);
  const TriangleMesh box = Meshes::Box(6, half);
  const ThicknessProbes probes = ProbesOf(box);
  CHECK(static_cast<Eigen::Index>(probes.points.size()) == box.P.rows(),
    "every point of a box has an opposite one, " << probes.points.size() << " have");
  const Vector3d factors(2.0, 0.03, 1.0);
  const Eigen::VectorXd ratio = ThicknessRatios(box, Meshes::Scaled(box, factors).P, probes);
  int inFaces = 0;
  for (std::size_t i = 0; i < probes.points.size(); ++i)
  {
    const Vector3d p = box.P.row(probes.points[i]);
    const auto onSide = (p.cwiseAbs() - half).array().abs() < 1e-12;
    if (onSide.count() != 1)
    {
      continue; // normals of edges point elsewhere
    }
    ++inFaces;
    Vector3d mirrored = p;
    for (int k = 0; k < 3; ++k)
    {
      if (onSide(k))
      {
        mirrored[k] = -p[k];
        CHECK_NEAR(
          ratio(static_cast<Eigen::Index>(i)), factors[k], 1e-12, "ratio along axis " << k);
      }
    }
    CHECK_NEAR((Opposite(box, probes, i) - mirrored).norm(), 0.0, 1e-12,
      "distance from the point opposite " << p.transpose());
    CHECK_NEAR(probes.barycentric.row(static_cast<Eigen::Index>(i)).sum(), 1.0, 1e-14, "sum");
  }
  CHECK(inFaces == 6 * 25, inFaces << " points should lie in faces");
}

// A search through all triangles, by the volumes of the tetrahedra that segment and edges span.
void TestAgainstSearch()
{
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Ellipsoid(3), 0.03, 9);
  const Points normals = PointNormals(mesh.P, mesh.F);
  const ThicknessProbes probes = ProbesOf(mesh);
  const auto volume = [](const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d)
  { return (b - a).cross(c - a).dot(d - a); };
  std::size_t probe = 0;
  for (int i = 0; i < mesh.P.rows(); ++i)
  {
    const Vector3d p = mesh.P.row(i);
    const Vector3d far = p - 5.0 * normals.row(i).transpose();
    double nearest = 1.0;
    for (int f = 0; f < mesh.F.rows(); ++f)
    {
      if ((mesh.F.row(f).array() == i).any())
      {
        continue;
      }
      const Vector3d a = mesh.P.row(mesh.F(f, 0)), b = mesh.P.row(mesh.F(f, 1)),
                     c = mesh.P.row(mesh.F(f, 2));
      const double s = volume(p, far, a, b), t = volume(p, far, b, c), u = volume(p, far, c, a);
      const double before = volume(a, b, c, p), behind = volume(a, b, c, far);
      if (s * t >= 0.0 && t * u >= 0.0 && s * u >= 0.0 && before * behind < 0.0)
      {
        nearest = std::min(nearest, before / (before - behind));
      }
    }
    const bool found = probe < probes.points.size() && probes.points[probe] == i;
    CHECK(found == (nearest < 1.0), "point " << i << " should have an opposite one: " << !found);
    if (found)
    {
      CHECK_NEAR((Opposite(mesh, probes, probe) - p).norm(), 5.0 * nearest, 1e-9,
        "thickness at point " << i);
      ++probe;
    }
  }
  CHECK(probe > 600, "most points should have an opposite one, " << probe << " have");
}

// A reach leaves out what is farther away, and nothing else: none, some or all of them.
void TestReach()
{
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Ellipsoid(3), 0.03, 9);
  const double diagonal = Meshes::Diagonal(mesh.P);
  const ThicknessProbes all = ProbesOf(mesh);
  std::vector<int> points(mesh.P.rows());
  std::iota(points.begin(), points.end(), 0);
  for (const double reach : { 0.01, 0.4, 0.5, 2.0 })
  {
    const ThicknessProbes near = PlaceThicknessProbes(mesh, points, 1, reach);
    std::size_t at = 0;
    for (std::size_t i = 0; i < all.points.size(); ++i)
    {
      const Vector3d p = mesh.P.row(all.points[i]);
      const bool expected = (Opposite(mesh, all, i) - p).norm() < reach * diagonal;
      const bool found = at < near.points.size() && near.points[at] == all.points[i];
      CHECK(found == expected, "point " << all.points[i] << " within " << reach << ": " << found);
      CHECK(!found || near.triangles[at] == all.triangles[i], "another triangle is opposite");
      at += found;
    }
    std::cout << at << " of " << all.points.size() << " within " << reach << std::endl;
  }
}

void TestInvariance()
{
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Ellipsoid(3), 0.02, 3);
  const ThicknessProbes probes = ProbesOf(mesh);
  CHECK(Same(probes, ProbesOf(mesh, 7)), "threads should not matter");
  Meshes::Random random(5);
  const Points turned = (3.0 * mesh.P * random.Rotation()).rowwise() + Eigen::RowVector3d(1, 2, 3);
  const Eigen::VectorXd ratio = ThicknessRatios(mesh, turned, probes);
  CHECK_NEAR((ratio.array() - 3.0).abs().maxCoeff(), 0.0, 1e-11, "moved and three times as large");

  const ThicknessProbes few = ProbesOf(mesh, 1, 7);
  const Eigen::VectorXd ofFew = ThicknessRatios(mesh, mesh.P, few);
  CHECK(few.points.size() > 80 && (ofFew.array() == 1.0).all(), "undeformed, ratios should be 1");
  for (const int i : few.points)
  {
    CHECK(i % 7 == 0, "only points asked for, not " << i);
  }

  TriangleMesh insideOut = mesh;
  insideOut.F = mesh.F.rowwise().reverse().eval();
  const ThicknessProbes reversed = ProbesOf(insideOut);
  CHECK(reversed.points == probes.points && reversed.triangles == probes.triangles,
    "inside out, the opposite points should be the same");
}

void TestWithout()
{
  CHECK(ProbesOf(Meshes::Patch(12, 0.0)).points.empty(), "a flat sheet has no thickness");
  CHECK(PlaceThicknessProbes(Meshes::Box(2), {}, 1).points.empty(), "no point, no probe");
  CHECK(ProbesOf({ Points::Zero(2, 3), Triangles(0, 3) }).points.empty(), "no triangle, no probe");
  const TriangleMesh one = Meshes::Make({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } });
  CHECK(ProbesOf(one).points.empty(), "one triangle has no thickness");
}

// Rays along an axis meet what ends right at them: two flat sheets see each other up to the border.
void TestBorder()
{
  TriangleMesh lower = Meshes::Patch(12, 0.0);
  lower.F = lower.F.rowwise().reverse().eval();
  for (const Vector3d& turn : { Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1) })
  {
    const Eigen::Matrix3d rotation =
      Eigen::Quaterniond::FromTwoVectors(Vector3d(0, 0, 1), turn).toRotationMatrix();
    const TriangleMesh sheets = Meshes::Turned(
      Meshes::Together({ lower, Meshes::Moved(Meshes::Patch(12, 0.0), { 0, 0, 0.1 }) }), rotation);
    const ThicknessProbes probes = ProbesOf(sheets);
    CHECK(static_cast<Eigen::Index>(probes.points.size()) == sheets.P.rows(),
      "every point should have an opposite one, " << probes.points.size() << " have");
  }
}

// Both sides of the wall see each other, none sees through the cavity.
void TestHollowBall()
{
  const TriangleMesh ball = Meshes::HollowBall(0.1, 3);
  const ThicknessProbes probes = ProbesOf(ball);
  CHECK(
    static_cast<Eigen::Index>(probes.points.size()) == ball.P.rows(), "every point is on a wall");
  for (std::size_t i = 0; i < probes.points.size(); ++i)
  {
    const Vector3d p = ball.P.row(probes.points[i]);
    CHECK_NEAR((Opposite(ball, probes, i) - p).norm(), 0.1, 0.01, "wall at point " << i);
  }
}

double Median(Eigen::VectorXd x)
{
  std::nth_element(x.begin(), x.begin() + x.size() / 2, x.end());
  return x(x.size() / 2);
}

Eigen::VectorXd Left(const TriangleMesh& mesh, double lambda, double detailSize)
{
  MethodOptions options;
  options.lambda = lambda;
  options.detailSize = detailSize;
  options.sphericalWeighting = SphericalWeighting::Cotangent;
  options.centerMode = CenterMode::AreaCentroid;
  SphericalStyleMethod method;
  method.SetMesh(mesh);
  const StyleReport report = method.Solve(options);
  CHECK(report.closedForm && (detailSize == 0.0 || report.walls > 0),
    report.walls << " pairs through walls should be found");
  return ThicknessRatios(mesh, method.GetPositions(), ProbesOf(mesh));
}

// [blend]: (p - q).(d_p - d_q) is never negative, so no two points come nearer than to
// 1 / (1 + sqrt(3) lambda), and on one ray from O they come as near as that.
void TestBlendBound()
{
  for (const double lambda : { 0.5, 2.0, 5.0, 10.0 })
  {
    const double least = 1.0 / (1.0 + std::sqrt(3.0) * lambda);
    for (const TriangleMesh& mesh :
      { Meshes::HollowBall(0.1, 3), Meshes::Cup(0.1), Meshes::PlateOnBall(0.08) })
    {
      const Eigen::VectorXd left = Left(mesh, lambda, 0.0);
      CHECK(left.minCoeff() >= 0.99 * least,
        "lambda " << lambda << " should leave " << least << ", it leaves " << left.minCoeff());
    }
    const Eigen::VectorXd wall = Left(Meshes::HollowBall(0.1, 3), lambda, 0.0);
    CHECK_NEAR(Median(wall), least, 0.02 * least, "a wall square to the rays, lambda " << lambda);
  }
}

/// The share of its thickness that a model keeps.
struct Share
{
  double least;
  double median;
};

// What details kept do for sheets, as the page of the filter tells it: the two sides of a wall are
// one base [wall] and keep nearly all of their distance, on coarse and fine triangles alike.
void TestDetailsKept()
{
  struct Shape
  {
    const char* name;
    TriangleMesh mesh;
    std::array<Share, 3> left; // at the three values of Roundness below, at least
  };
  constexpr double Rounding = 0.005; // of the figures on the page
  const auto always = [](double least, double median)
  {
    const Share share = { least + Rounding, median + Rounding };
    return std::array<Share, 3>{ share, share, share };
  };
  const Shape shapes[] = { { "hollow ball", Meshes::HollowBall(0.1, 4),
                             { { { 0.99, 0.99 }, { 0.97, 0.98 }, { 0.97, 0.98 } } } },
    { "cup", Meshes::Cup(0.1), { { { 0.95, 0.96 }, { 0.91, 0.92 }, { 0.91, 0.91 } } } },
    { "cup of few triangles", Meshes::Cup(0.1, 0.6 * Meshes::Pi, 8, 16),
      { { { 0.94, 0.96 }, { 0.89, 0.91 }, { 0.88, 0.91 } } } },
    { "cup of many triangles", Meshes::Cup(0.1, 0.6 * Meshes::Pi, 60, 144), always(0.85, 0.85) },
    { "cup, thin", Meshes::Cup(0.02), always(0.9, 0.95) },
    { "plate on a ball", Meshes::PlateOnBall(0.08),
      { { { 0.86, 0.96 }, { 0.77, 0.96 }, { 0.76, 0.96 } } } } };
  const double lambdas[] = { 0.5, 5.0, 10.0 };
  for (const Shape& shape : shapes)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::VectorXd plain = Left(shape.mesh, lambdas[k], 0.0);
      const Eigen::VectorXd kept = Left(shape.mesh, lambdas[k], 0.03);
      std::cout << shape.name << ", lambda " << lambdas[k] << ": least and median "
                << plain.minCoeff() << " " << Median(plain) << " without details, "
                << kept.minCoeff() << " " << Median(kept) << " with" << std::endl;
      CHECK(kept.minCoeff() >= shape.left[k].least - Rounding &&
          Median(kept) >= shape.left[k].median - Rounding,
        shape.name << ", lambda " << lambdas[k] << ": details should leave " << shape.left[k].least
                   << " at least and " << shape.left[k].median << " in the median");
    }
  }
}
}

int main()
{
  TestBox();
  TestAgainstSearch();
  TestReach();
  TestInvariance();
  TestWithout();
  TestBorder();
  TestHollowBall();
  TestBlendBound();
  TestDetailsKept();
  return CheckResult();
}
