// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// [gaussmap]: counts against counting by hand, measures against their definitions, and what they
/// say of spheres, cubes and turned models.
#include "Check.h"
#include "GaussMap.h"
#include "Meshes.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <map>

using namespace SphericalStyle;
using Meshes::Random;
using Meshes::Turned;
using Meshes::Vector;

namespace
{
const SphereUnits& EqualAngle()
{
  static const SphereUnits units = SphereUnits::EqualAngle(360, 180);
  return units;
}

Eigen::VectorXd CountFaces(const SphereUnits& units, const TriangleMesh& mesh, bool byArea = false)
{
  const Eigen::VectorXd weights =
    RelativeWeights(mesh.F.rows(), byArea ? TriangleAreas(mesh.P, mesh.F) : Eigen::VectorXd());
  return CountNormals(units, TriangleNormals(mesh.P, mesh.F), weights);
}

/// Every normal is in its unit, and the numbers of the units are those of the image.
void Counts()
{
  const TriangleMesh mesh = Turned(Meshes::Slivers(), Random(3).Rotation());
  const Points n = TriangleNormals(mesh.P, mesh.F);
  const Eigen::VectorXd area = TriangleAreas(mesh.P, mesh.F);
  std::map<int, double> count;
  std::map<int, double> countOfAreas;
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    const Vector a = mesh.P.row(mesh.F(f, 0)), b = mesh.P.row(mesh.F(f, 1)),
                 c = mesh.P.row(mesh.F(f, 2));
    const Vector normal = (b - a).cross(c - a).normalized();
    CHECK_NEAR((normal - n.row(f).transpose()).norm(), 0.0, 1e-14, "normal of triangle " << f);
    const double longitude = std::atan2(normal.y(), normal.x()) * 180.0 / Pi;
    const double latitude = std::asin(normal.z()) * 180.0 / Pi;
    const int unit = static_cast<int>(std::floor(longitude + 180.0 + SphereUnits::BorderAngle)) +
      360 * static_cast<int>(std::floor(latitude + 90.0 + SphereUnits::BorderAngle));
    count[unit] += 1.0;
    countOfAreas[unit] += area(f) * mesh.F.rows() / area.sum();
  }
  const Eigen::VectorXd found = CountFaces(EqualAngle(), mesh);
  const Eigen::VectorXd foundOfAreas = CountFaces(EqualAngle(), mesh, true);
  CHECK(found.size() == 360 * 180, "units: " << found.size());
  CHECK(count.size() > 100, "the mesh should hit many units");
  for (int k = 0; k < found.size(); ++k)
  {
    CHECK(found(k) == (count.count(k) ? count[k] : 0.0), "count of unit " << k);
    CHECK_NEAR(foundOfAreas(k), countOfAreas.count(k) ? countOfAreas[k] : 0.0, 1e-12,
      "count of areas of unit " << k);
  }
  CHECK(found.sum() == mesh.F.rows(), "counts should sum to the number of normals");
  CHECK_NEAR(foundOfAreas.sum(), mesh.F.rows(), 1e-10, "sum of the counts of areas");
  CHECK(UnitsAbove(found, 0.0) == static_cast<int>(count.size()), "units hit");
  CHECK(UnitsAbove(found, found.maxCoeff()) == 0 && UnitsAbove(found, found.maxCoeff() - 1.0) > 0,
    "above means more than");
}

void Densities()
{
  const TriangleMesh mesh = Meshes::Ellipsoid(4);
  for (const auto& units : { EqualAngle(), SphereUnits::EqualArea(1000) })
  {
    for (const bool byArea : { false, true })
    {
      const Eigen::VectorXd density = Density(units, CountFaces(units, mesh, byArea));
      double integral = 0.0;
      for (int k = 0; k < density.size(); ++k)
      {
        integral += density(k) * units.SolidAngle(k);
      }
      CHECK_NEAR(integral, 4.0 * Pi, 1e-11, "integral of the density");
    }
    Eigen::VectorXd even(units.NumberOfUnits());
    for (int k = 0; k < even.size(); ++k)
    {
      even(k) = 17.0 * units.SolidAngle(k);
    }
    CHECK_NEAR((Density(units, even).array() - 1.0).abs().maxCoeff(), 0.0, 1e-12,
      "density of a uniform spread minus 1");
    CHECK(Density(units, Eigen::VectorXd::Zero(even.size())).isZero(0.0), "density of nothing");
  }
}

void Measures()
{
  const auto spread = [](std::vector<double> counts)
  { return MeasureSpread(Eigen::Map<Eigen::VectorXd>(counts.data(), counts.size())); };
  const Spread even = spread({ 3, 3, 3, 3 });
  CHECK_NEAR(even.entropy, std::log(4.0), 1e-15, "entropy of a uniform spread");
  CHECK_NEAR(even.relativeEntropy, 1.0, 1e-15, "relative entropy of a uniform spread");
  CHECK_NEAR(even.divergence, 0.0, 1e-15, "divergence of a uniform spread");
  CHECK_NEAR(even.distanceToUniform, 0.0, 1e-15, "distance of a uniform spread");
  const Spread one = spread({ 0, 7, 0, 0 });
  CHECK(one.entropy == 0.0 && one.relativeEntropy == 0.0, "entropy of one unit " << one.entropy);
  CHECK_NEAR(one.divergence, std::log(4.0), 1e-15, "divergence of one unit");
  CHECK_NEAR(one.distanceToUniform, 0.75, 1e-15, "distance of one unit");
  const Spread two = spread({ 1, 1, 0, 2 }); // 1/4 1/4 0 1/2
  CHECK_NEAR(two.entropy, 1.5 * std::log(2.0), 1e-15, "entropy of 1/4, 1/4, 0, 1/2");
  CHECK_NEAR(two.distanceToUniform, 0.25, 1e-15, "distance of 1/4, 1/4, 0, 1/2");
  Random random(4);
  for (int i = 0; i < 100; ++i)
  {
    const Eigen::VectorXd counts =
      Eigen::VectorXd::NullaryExpr(50, [&] { return std::max(0.0, random.Signed()); });
    const Spread s = MeasureSpread(counts);
    CHECK_NEAR(s.divergence + s.entropy, std::log(50.0), 1e-13, "divergence and entropy");
    CHECK_NEAR(s.relativeEntropy, s.entropy / std::log(50.0), 1e-15, "relative entropy");
    CHECK(s.distanceToUniform >= 0.0 && s.distanceToUniform <= 0.98, "range of the distance");
    CHECK(2.0 * s.distanceToUniform * s.distanceToUniform <= s.divergence + 1e-14,
      "Pinsker's inequality");
    CHECK_NEAR(MeasureSpread(3.5 * counts).entropy, s.entropy, 1e-13, "size should not matter");
  }
  const Spread none = spread({ 0, 0 });
  CHECK(std::isnan(none.entropy) && std::isnan(none.relativeEntropy) &&
      std::isnan(none.divergence) && std::isnan(none.distanceToUniform),
    "nothing counted should be no number");
}

/// The finer the sphere is meshed, the closer to uniform.
void Spheres()
{
  const SphereUnits units = SphereUnits::EqualArea(200);
  double before = 1.0;
  for (int level = 3; level <= 6; ++level)
  {
    const Spread s = MeasureSpread(CountFaces(units, Meshes::Icosphere(level), true));
    std::cout << "icosphere of " << 20 * std::pow(4, level) << " triangles: distance to uniform "
              << s.distanceToUniform << ", relative entropy " << s.relativeEntropy << "\n";
    CHECK(s.distanceToUniform < 0.7 * before, "distance at level " << level);
    before = s.distanceToUniform;
  }
  CHECK(before < 0.03, "the finest should be near 0 and is " << before);

  // An even mesh has no poles: the same along any axis.
  double last = 1.0;
  for (const int number : { 1000, 10000, 100000 })
  {
    Points n(number, 3);
    for (int i = 0; i < number; ++i)
    {
      const double z = 1.0 - (2.0 * i + 1.0) / number;
      const double r = std::sqrt(1.0 - z * z);
      const double phi = Pi * (3.0 - std::sqrt(5.0)) * i;
      n.row(i) << r * std::cos(phi), r * std::sin(phi), z;
    }
    const double distance =
      MeasureSpread(CountNormals(units, n, Eigen::VectorXd::Ones(number))).distanceToUniform;
    std::cout << "Fibonacci lattice of " << number << ": distance to uniform " << distance << "\n";
    CHECK(distance < 0.4 * last, "distance at " << number << " directions");
    last = distance;
  }
  CHECK(last < 0.005, "the finest should be near 0 and is " << last);
}

/// Six units, wherever a cube's faces point to: on borders and poles, and turned.
void Cubes()
{
  const SphereUnits units = SphereUnits::EqualArea(1000);
  Random random(5);
  for (const int k : { 1, 7, 30 })
  {
    const TriangleMesh cube = Meshes::Box(k);
    std::vector<Eigen::Matrix3d> turns = { Eigen::Matrix3d::Identity() };
    for (const double degrees : { 1.0, 30.0, 45.0, 90.0, 180.0, -17.0 })
    {
      for (const int axis : { 0, 1, 2 })
      {
        turns.push_back(Eigen::AngleAxisd(degrees * Pi / 180.0, Vector::Unit(axis))
                          .toRotationMatrix()); // onto borders
      }
    }
    for (int i = 0; i < 20; ++i)
    {
      turns.push_back(random.Rotation());
    }
    for (std::size_t i = 0; i < turns.size(); ++i)
    {
      TriangleMesh turned = Turned(cube, turns[i]);
      for (const bool single : { false, true })
      {
        if (single) // as most files hold it
        {
          turned.P = turned.P.cast<float>().cast<double>().eval();
        }
        const Eigen::VectorXd angle = CountFaces(EqualAngle(), turned);
        const Eigen::VectorXd area = CountFaces(units, turned);
        CHECK(UnitsAbove(angle, 0.0) == 6 && UnitsAbove(angle, 2.0 * k * k - 1.0) == 6,
          "turn " << i << " of a cube of " << k << ": " << UnitsAbove(angle, 0.0) << " units");
        CHECK(UnitsAbove(area, 0.0) == 6,
          "turn " << i << ": " << UnitsAbove(area, 0.0) << " equal-area units");
        CHECK_NEAR(MeasureSpread(area).entropy, std::log(6.0), 1e-12, "entropy of a cube");
        CHECK_NEAR(
          MeasureSpread(area).distanceToUniform, 1.0 - 6.0 / 1000.0, 1e-12, "distance of a cube");
      }
    }
  }
}

/// A8.26: turning the model changes the number of equal-angle units hit, and that of equal-area
/// units less. In both cases relative to the mean over the turns.
void Turns()
{
  // Flat poles: most normals are near the axis.
  const TriangleMesh mesh = Meshes::Scaled(Meshes::Icosphere(5), { 1.0, 1.0, 0.3 });
  // As many equal-area units as are comparable with the equal-angle ones.
  const SphereUnits equalArea = SphereUnits::EqualArea(64800);
  const SphereUnits coarse = SphereUnits::EqualArea(500);
  Eigen::Array<double, 8, 1> hitAngle, hitArea, distance;
  Random random(6);
  for (int i = 0; i < 8; ++i)
  {
    const TriangleMesh turned =
      Turned(mesh, i == 0 ? Eigen::Matrix3d::Identity() : random.Rotation());
    hitAngle(i) = UnitsAbove(CountFaces(EqualAngle(), turned), 0.0);
    hitArea(i) = UnitsAbove(CountFaces(equalArea, turned), 0.0);
    distance(i) = MeasureSpread(CountFaces(coarse, turned)).distanceToUniform;
  }
  const auto range = [](const auto& x) { return (x.maxCoeff() - x.minCoeff()) / x.mean(); };
  std::cout << "eight turns of a flat ellipsoid, range over mean: units hit " << range(hitAngle)
            << ", of equal area " << range(hitArea) << ", distance to uniform " << range(distance)
            << "\n";
  CHECK(range(hitAngle) > 0.03, "turning should change the equal-angle units hit");
  CHECK(range(hitArea) < 0.4 * range(hitAngle), "and equal-area ones less");
  CHECK(range(distance) < 0.4 * range(hitAngle), "and the distance to uniform less");
}
}

int main()
{
  Counts();
  Densities();
  Measures();
  Spheres();
  Cubes();
  Turns();
  return CheckResult();
}
