// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The units of the sphere: areas, lookup against geometry, the rule for borders, polygons.
#include "Check.h"
#include "Meshes.h"
#include "SphereUnits.h"

#include <algorithm>
#include <map>
#include <set>

using namespace SphericalStyle;
using Meshes::Random;
using Meshes::Vector;

namespace
{
constexpr double Degree = Pi / 180.0;

Vector Direction(double longitude, double latitude) // degrees
{
  return { std::cos(latitude * Degree) * std::cos(longitude * Degree),
    std::cos(latitude * Degree) * std::sin(longitude * Degree), std::sin(latitude * Degree) };
}

struct NamedUnits
{
  std::string name;
  SphereUnits units;
};

std::vector<NamedUnits> AllUnits()
{
  std::vector<NamedUnits> all = { { "360 x 180", SphereUnits::EqualAngle(360, 180) },
    { "3 x 2", SphereUnits::EqualAngle(3, 2) }, { "7 x 5", SphereUnits::EqualAngle(7, 5) } };
  for (const int number : { 4, 5, 6, 7, 10, 12, 33, 100, 1000, 1001, 64800 })
  {
    all.push_back({ std::to_string(number) + " equal areas", SphereUnits::EqualArea(number) });
  }
  return all;
}

void EqualAreas()
{
  for (int number = 4; number <= 3000; number += number < 300 ? 1 : 97)
  {
    const SphereUnits units = SphereUnits::EqualArea(number);
    CHECK(units.NumberOfUnits() == number, "number of units of " << number);
    double largest = 0.0;
    for (int k = 0; k < number; ++k)
    {
      largest = std::max(largest, std::abs(units.SolidAngle(k) * number / (4.0 * Pi) - 1.0));
    }
    CHECK_NEAR(largest, 0.0, 1e-12, "area over mean area minus 1, of " << number);
    CHECK(units.NumberOfSectors(0) == 1 && units.NumberOfSectors(units.NumberOfZones() - 1) == 1,
      "the ends of " << number << " should be caps");
  }
}

/// Step 2 and 3 of the algorithm: between caps of one unit, zones of equal height in latitude, as
/// high as a square unit is wide, moved until they hold whole units: by less than half a unit.
void Zones()
{
  for (const int number : { 4, 10, 33, 500, 1000, 64800 })
  {
    const SphereUnits units = SphereUnits::EqualArea(number);
    const double cap = std::acos(1.0 - 2.0 / number);
    const int between = units.NumberOfZones() - 2;
    const double height = (Pi - 2.0 * cap) / between;
    CHECK(std::abs((Pi - 2.0 * cap) / std::sqrt(4.0 * Pi / number) - between) <= 0.5,
      between << " zones between the caps of " << number);
    for (int j = 1; j <= between + 1; ++j)
    {
      const double ideal = 0.5 * number * (1.0 - std::cos(cap + (j - 1) * height));
      CHECK_NEAR(units.FirstUnitOfZone(j), ideal, 0.5 + 1e-9, "units before zone " << j);
      CHECK_NEAR(0.5 * number * (units.Height(j) + 1.0), units.FirstUnitOfZone(j), 1e-9,
        "area before zone " << j << " in units");
    }
  }
}

/// No unit is long: diameters stay below 6.5 / sqrt(N).
void SmallDiameters()
{
  for (const int number : { 10, 33, 100, 1000, 10000 })
  {
    const SphereUnits units = SphereUnits::EqualArea(number);
    const SphereUnits::Polygons polygons = units.MakePolygons();
    double largest = 0.0;
    for (const std::vector<int>& unit : polygons.units)
    {
      for (const int a : unit)
      {
        for (const int b : unit)
        {
          largest = std::max(largest, (polygons.points.row(a) - polygons.points.row(b)).norm());
        }
      }
    }
    CHECK(largest < 6.5 / std::sqrt(number), "diameter " << largest << " of " << number);
  }
}

/// Looks at all borders, one unit after the other.
int FindSlowly(const SphereUnits& units, const Vector& x)
{
  int found = -1;
  for (int j = 0; j < units.NumberOfZones(); ++j)
  {
    const int m = units.NumberOfSectors(j);
    for (int k = 0; k < m; ++k)
    {
      const double longitude = std::atan2(x.y(), x.x()) + Pi;
      const bool inside = units.Height(j) <= x.z() && x.z() < units.Height(j + 1) &&
        2.0 * Pi * k / m <= longitude && longitude < 2.0 * Pi * (k + 1) / m;
      if (inside)
      {
        CHECK(found < 0, "one unit only should hold a direction");
        found = units.FirstUnitOfZone(j) + k;
      }
    }
  }
  return found;
}

/// Whether the border rule, with some margin, may say something about a direction.
bool NearBorder(const SphereUnits& units, const Vector& x)
{
  const double margin = 2.0 * SphereUnits::BorderAngle * Degree;
  const double latitude = std::asin(x.z());
  const double longitude = std::atan2(x.y(), x.x()) + Pi;
  for (int j = 0; j < units.NumberOfZones(); ++j)
  {
    if (std::abs(latitude - std::asin(units.Height(j))) < margin)
    {
      return true;
    }
    if (units.Height(j) <= x.z() && x.z() < units.Height(j + 1))
    {
      const double sectors = longitude * units.NumberOfSectors(j) / (2.0 * Pi);
      if (std::abs(sectors - std::round(sectors)) / units.NumberOfSectors(j) * 2.0 * Pi < margin)
      {
        return true;
      }
    }
  }
  return 0.5 * Pi - std::abs(latitude) < margin;
}

void Lookup()
{
  Random random(1);
  for (const auto& [name, units] : AllUnits())
  {
    std::vector<Vector> directions;
    while (directions.size() < (units.NumberOfUnits() > 5000 ? 60u : 600u))
    {
      const Vector x = random.InCube().normalized();
      if (!NearBorder(units, x))
      {
        directions.push_back(x);
      }
    }
    long double total = 0.0; // rounding of many small numbers is not what is looked at
    for (int k = 0; k < units.NumberOfUnits(); ++k)
    {
      total += units.SolidAngle(k);
      CHECK(units.SolidAngle(k) > 0.0, name << ": area of unit " << k);
    }
    CHECK_NEAR(static_cast<double>(total), 4.0 * Pi, 1e-12, name << ": sum of the areas");
    for (const Vector& x : directions)
    {
      const int unit = units.Find(x);
      CHECK(unit == FindSlowly(units, x), name << ": unit of " << x.transpose());
      CHECK(units.Find(1e-200 * x) == unit && units.Find(1e150 * x) == unit,
        name << ": length should not matter");
    }
  }
}

/// The share of evenly spread directions that falls into a unit is its share of the sphere.
void Shares()
{
  for (const auto& units : { SphereUnits::EqualArea(50), SphereUnits::EqualAngle(8, 6) })
  {
    const int number = 400000; // a Fibonacci lattice
    Eigen::VectorXd count = Eigen::VectorXd::Zero(units.NumberOfUnits());
    for (int i = 0; i < number; ++i)
    {
      const double z = 1.0 - (2.0 * i + 1.0) / number;
      const double r = std::sqrt(1.0 - z * z);
      const double phi = Pi * (3.0 - std::sqrt(5.0)) * i;
      count(units.Find({ r * std::cos(phi), r * std::sin(phi), z })) += 1.0;
    }
    for (int k = 0; k < units.NumberOfUnits(); ++k)
    {
      const double share = units.SolidAngle(k) / (4.0 * Pi);
      CHECK_NEAR(count(k) / number / share, 1.0, 0.01, "share of unit " << k);
    }
  }
}

/// Directions that differ by less than the rule's angle around a border are in one unit, the one
/// behind the border.
void Borders()
{
  const SphereUnits units = SphereUnits::EqualAngle(360, 180);
  Random random(2);
  const double far = 0.9 * SphereUnits::BorderAngle;
  for (const int longitude : { -180, -90, -37, 0, 1, 45, 90, 179 })
  {
    for (const int latitude : { -89, -45, -1, 0, 30, 89 })
    {
      const int expected = 360 * (latitude + 90) + longitude + 180;
      for (int i = 0; i < 20; ++i)
      {
        const Vector x =
          Direction(longitude + far * random.Signed(), latitude + far * random.Signed());
        CHECK(units.Find(x) == expected,
          "border " << longitude << ", " << latitude << " gave unit " << units.Find(x));
      }
      CHECK(units.Find(Direction(longitude - 0.01, latitude)) ==
          360 * (latitude + 90) + (longitude + 359 + 180) % 360,
        "before the border at longitude " << longitude);
    }
  }
  for (const auto& all : AllUnits())
  {
    const auto& u = all.units;
    const std::vector<Vector> axes = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -1, 0, 0 },
      { 0, -1, 0 }, { 0, 0, -1 } };
    for (const Vector& axis : axes)
    {
      const int expected = u.Find(axis);
      for (int i = 0; i < 50; ++i)
      {
        const Vector x = axis + std::pow(10.0, -5.0 - 12.0 * random.Unit()) * random.InCube();
        CHECK(u.Find(x) == expected, all.name << ": noise on the axis " << axis.transpose());
      }
      Vector zeros = axis; // a sign of 0 is noise too
      for (int k = 0; k < 3; ++k)
      {
        zeros[k] = zeros[k] == 0.0 ? -0.0 : zeros[k];
        CHECK(u.Find(zeros) == expected, all.name << ": zeros of " << axis.transpose());
      }
    }
    CHECK(u.Find({ 0, 0, -1 }) < u.NumberOfSectors(0), all.name << ": south pole");
    CHECK(
      u.Find({ 0, 0, 1 }) >= u.FirstUnitOfZone(u.NumberOfZones() - 1), all.name << ": north pole");
  }
}

/// A closed surface on the sphere, oriented outward, with the units' areas.
void Surface()
{
  for (const auto& [name, units] : AllUnits())
  {
    const SphereUnits::Polygons polygons = units.MakePolygons();
    CHECK(static_cast<int>(polygons.units.size()) == units.NumberOfUnits(),
      name << ": one polygon per unit");
    CHECK_NEAR((polygons.points.rowwise().norm().array() - 1.0).abs().maxCoeff(), 0.0, 1e-15,
      name << ": distance from the sphere");
    std::set<std::pair<int, int>> edges;
    bool good = true;
    for (const std::vector<int>& unit : polygons.units)
    {
      good =
        good && unit.size() > 2 && std::set<int>(unit.begin(), unit.end()).size() == unit.size();
      for (std::size_t i = 0; i < unit.size(); ++i)
      {
        good = good && edges.insert({ unit[i], unit[(i + 1) % unit.size()] }).second;
      }
    }
    for (const auto& edge : edges)
    {
      good = good && edges.count({ edge.second, edge.first }) == 1;
    }
    CHECK(good, name << ": should be closed, each edge once in each direction");

    for (int k = 0; k < units.NumberOfUnits(); k += 1 + k / 100)
    {
      const std::vector<int>& unit = polygons.units[k];
      Vector area = Vector::Zero();
      Vector middle = Vector::Zero();
      for (std::size_t i = 0; i < unit.size(); ++i)
      {
        const Vector a = polygons.points.row(unit[i]);
        const Vector b = polygons.points.row(unit[(i + 1) % unit.size()]);
        area += 0.5 * a.cross(b);
        middle += a / unit.size();
      }
      CHECK(area.dot(middle) > 0.0, name << ": orientation of unit " << k);
      if (units.NumberOfUnits() >= 1000)
      {
        CHECK_NEAR(area.norm() / units.SolidAngle(k), 1.0, 0.03, name << ": area of unit " << k);
        CHECK(units.Find(middle) == k, name << ": the middle of unit " << k);
      }
    }
  }
}

void Errors()
{
  CHECK_THROWS(std::invalid_argument, SphereUnits::EqualArea(3), "equal-area units");
  CHECK_THROWS(std::invalid_argument, SphereUnits::EqualArea(-5), "-5");
  CHECK_THROWS(std::invalid_argument, SphereUnits::EqualAngle(2, 5), "longitudes");
  CHECK_THROWS(std::invalid_argument, SphereUnits::EqualAngle(5, 1), "latitudes");
}
}

int main()
{
  EqualAreas();
  Zones();
  SmallDiameters();
  Lookup();
  Shares();
  Borders();
  Surface();
  Errors();
  return CheckResult();
}
