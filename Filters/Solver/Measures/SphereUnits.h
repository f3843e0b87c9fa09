// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The unit sphere cut into units that directions are counted in. [gaussmap]
#ifndef SphericalStyle_SphereUnits_h
#define SphericalStyle_SphereUnits_h

#include "TriangleMesh.h"

#include <vector>

namespace SphericalStyle
{
/// Zones between circles of latitude, each cut along meridians into sectors of equal width. Units
/// are numbered zone by zone from the south pole (-z) to the north pole (+z), within a zone from
/// longitude -180 degrees eastward; longitude 0 is +x, 90 degrees +y.
class SphereUnits
{
public:
  /// Every unit has the same width in longitude and the same height in latitude (thesis Table 4.1:
  /// 360 x 180), so units are the smaller the closer they are to a pole.
  /// @throw std::invalid_argument unless there are at least 3 longitudes and 2 latitudes
  static SphereUnits EqualAngle(int longitudes, int latitudes);

  /// Every unit has the same area, and none is much longer than wide: two polar caps and zones of
  /// sectors between them (P. Leopardi, A partition of the unit sphere into regions of equal area
  /// and small diameter, ETNA 25, 2006, section 3).
  /// @throw std::invalid_argument unless number is 4 or more
  static SphereUnits EqualArea(int number);

  /// Border rule: a direction within this angle (degrees) of a border belongs to the unit behind it
  /// (east, north), one within it of a pole has longitude 0. The last digits of a normal then do
  /// not spread a flat face over several units.
  static constexpr double BorderAngle = 1e-3;

  int NumberOfUnits() const { return this->FirstUnit.back(); }
  int NumberOfZones() const { return static_cast<int>(this->FirstUnit.size()) - 1; }
  /// Sectors of zone j.
  int NumberOfSectors(int j) const { return this->FirstUnit[j + 1] - this->FirstUnit[j]; }
  int FirstUnitOfZone(int j) const { return this->FirstUnit[j]; }
  /// Sine of the latitude (z on the sphere) at the lower end of zone j, and for j = NumberOfZones()
  /// at the north pole.
  double Height(int j) const { return this->Heights[j]; }

  /// The unit of a direction of any length but 0, by the border rule. Logarithmic in the zones.
  int Find(const Eigen::Vector3d& direction) const;
  /// Steradians, 2 pi (height above - height below) / sectors. They sum to 4 pi.
  double SolidAngle(int unit) const;

  /// The units as polygons on the unit sphere, counter-clockwise seen from outside, with shared
  /// points: a closed surface.
  struct Polygons
  {
    Points points;
    std::vector<std::vector<int>> units; ///< corners of each unit
  };
  Polygons MakePolygons() const;

private:
  SphereUnits(std::vector<double> heights, const std::vector<int>& sectors);

  std::vector<double> Heights; ///< one more than there are zones
  std::vector<int> FirstUnit;  ///< one more than there are zones
};
} // namespace SphericalStyle

#endif
