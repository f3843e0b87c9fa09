// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SphereUnits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace SphericalStyle
{
namespace
{
constexpr double Degree = Pi / 180.0;

void RequireAtLeast(int least, int number, const char* what)
{
  if (number < least)
  {
    throw std::invalid_argument(std::string(what) + " must be " + std::to_string(least) +
      " or more; it is " + std::to_string(number));
  }
}

/// Numbers of sectors of Leopardi's zones from pole to pole, N > 3; they sum to N.
std::vector<int> EqualAreaSectors(int N)
{
  const double unitArea = 4.0 * Pi / N;
  const double cap = 2.0 * std::asin(std::sqrt(1.0 / N)); // colatitude of the polar cap
  const int zones = static_cast<int>(std::lround((Pi - 2.0 * cap) / std::sqrt(unitArea)));
  const double step = (Pi - 2.0 * cap) / zones;
  std::vector<int> sectors = { 1 };
  double carry = 0.0; // what rounding has left over so far
  for (int i = 0; i < zones; ++i)
  {
    const double area = 2.0 * Pi * (std::cos(cap + i * step) - std::cos(cap + (i + 1) * step));
    const double ideal = area / unitArea + carry;
    sectors.push_back(static_cast<int>(std::lround(ideal)));
    carry = ideal - sectors.back();
  }
  sectors.push_back(1);
  return sectors;
}

/// Places on a circle of latitude, as fractions of the turn from longitude -180 degrees: the
/// sectors' borders on both sides of it, and more so that the circle stays round.
class Ring
{
public:
  Ring(int below, int above)
    : Below(below * PartsOfSector(below))
    , Above(above * PartsOfSector(above))
  {
    std::int64_t a = 0;
    std::int64_t b = 0;
    while (a < this->Below || b < this->Above)
    {
      const std::int64_t order = a * this->Above - b * this->Below; // sign of a/Below - b/Above
      this->Fractions.push_back(
        order <= 0 ? static_cast<double>(a) / this->Below : static_cast<double>(b) / this->Above);
      a += order <= 0;
      b += order >= 0;
    }
  }

  int Size() const { return static_cast<int>(this->Fractions.size()); }
  double Longitude(int i) const { return 2.0 * Pi * this->Fractions[i] - Pi; }
  /// The place where sector k of m starts; Size() for k = m.
  int Place(int k, int m) const
  {
    const double fraction = static_cast<double>(k) / m - 1e-9; // before it, after the one before
    return static_cast<int>(
      std::lower_bound(this->Fractions.begin(), this->Fractions.end(), fraction) -
      this->Fractions.begin());
  }

private:
  static int PartsOfSector(int sectors)
  {
    constexpr int LeastPlaces = 72;
    return (LeastPlaces + sectors - 1) / sectors;
  }

  std::int64_t Below;
  std::int64_t Above;
  std::vector<double> Fractions;
};
}

SphereUnits::SphereUnits(std::vector<double> heights, const std::vector<int>& sectors)
  : Heights(std::move(heights))
  , FirstUnit(1, 0)
{
  for (const int m : sectors)
  {
    this->FirstUnit.push_back(this->FirstUnit.back() + m);
  }
}

SphereUnits SphereUnits::EqualAngle(int longitudes, int latitudes)
{
  RequireAtLeast(3, longitudes, "Number of longitudes");
  RequireAtLeast(2, latitudes, "Number of latitudes");
  std::vector<double> heights(latitudes + 1);
  for (int j = 0; j <= latitudes; ++j)
  {
    heights[j] = std::sin(Pi * (j - 0.5 * latitudes) / latitudes);
  }
  return { std::move(heights), std::vector<int>(latitudes, longitudes) };
}

SphereUnits SphereUnits::EqualArea(int number)
{
  RequireAtLeast(4, number, "Number of equal-area units");
  const std::vector<int> sectors = EqualAreaSectors(number);
  std::vector<double> heights = { -1.0 };
  int below = 0;
  for (const int m : sectors)
  {
    below += m;
    heights.push_back(2.0 * below / number - 1.0); // Archimedes: area goes with height
  }
  return { std::move(heights), sectors };
}

int SphereUnits::Find(const Eigen::Vector3d& direction) const
{
  constexpr double Border = BorderAngle * Degree;
  const double fromAxis = std::hypot(direction.x(), direction.y());
  const double latitude = std::atan2(direction.z(), fromAxis);
  const double longitude = fromAxis <= std::tan(Border) * std::abs(direction.z())
    ? 0.0
    : std::atan2(direction.y(), direction.x());

  const double height = std::sin(std::min(0.5 * Pi, latitude + Border));
  const auto above = std::upper_bound(this->Heights.begin() + 1, this->Heights.end() - 1, height);
  const int zone = static_cast<int>(above - this->Heights.begin()) - 1;
  const int m = this->NumberOfSectors(zone);
  const int sector = static_cast<int>(m * ((longitude + Border + Pi) / (2.0 * Pi)));
  return this->FirstUnit[zone] + sector % m; // longitude 180 degrees is -180
}

double SphereUnits::SolidAngle(int unit) const
{
  const auto next = std::upper_bound(this->FirstUnit.begin(), this->FirstUnit.end(), unit);
  const int zone = static_cast<int>(next - this->FirstUnit.begin()) - 1;
  return 2.0 * Pi * (this->Heights[zone + 1] - this->Heights[zone]) / this->NumberOfSectors(zone);
}

SphereUnits::Polygons SphereUnits::MakePolygons() const
{
  // Points: the south pole, rings of latitude, the north pole. A pole is used where several sectors
  // meet in it; a cap of one sector is its ring.
  const int zones = this->NumberOfZones();
  std::vector<Ring> rings;
  std::vector<int> firstPoint = { 1 };
  for (int j = 1; j < zones; ++j)
  {
    rings.emplace_back(this->NumberOfSectors(j - 1), this->NumberOfSectors(j));
    firstPoint.push_back(firstPoint.back() + rings.back().Size());
  }
  Polygons result;
  result.points.resize(firstPoint.back() + 1, 3);
  result.points.row(0) << 0.0, 0.0, -1.0;
  result.points.row(firstPoint.back()) << 0.0, 0.0, 1.0;
  for (int j = 1; j < zones; ++j)
  {
    const double z = this->Heights[j];
    const double radius = std::sqrt((1.0 - z) * (1.0 + z));
    for (int i = 0; i < rings[j - 1].Size(); ++i)
    {
      const double longitude = rings[j - 1].Longitude(i);
      result.points.row(firstPoint[j - 1] + i) << radius * std::cos(longitude),
        radius * std::sin(longitude), z;
    }
  }

  /// Appends the part of circle j that belongs to sector k of m, eastward or back.
  const auto append = [&](std::vector<int>& corners, int j, int k, int m, bool eastward)
  {
    if (j == 0 || j == zones)
    {
      if (m > 1)
      {
        corners.push_back(j == 0 ? 0 : firstPoint.back());
      }
      return;
    }
    const Ring& ring = rings[j - 1];
    const int first = ring.Place(k, m);
    const int last = ring.Place(k + 1, m) - (m == 1 ? 1 : 0); // a whole turn ends before its start
    for (int n = 0; n <= last - first; ++n)
    {
      corners.push_back(firstPoint[j - 1] + (eastward ? first + n : last - n) % ring.Size());
    }
  };
  for (int j = 0; j < zones; ++j)
  {
    const int m = this->NumberOfSectors(j);
    for (int k = 0; k < m; ++k)
    {
      result.units.emplace_back();
      append(result.units.back(), j, k, m, true);
      append(result.units.back(), j + 1, k, m, false);
    }
  }
  return result;
}
} // namespace SphericalStyle
