// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The part of a surface that this process has, and sums over all parts.
#ifndef SphericalStyle_SurfacePart_h
#define SphericalStyle_SurfacePart_h

#include "Processes.h"
#include "TriangleMesh.h"

#include <memory>
#include <utility>

namespace SphericalStyle
{
/// Each triangle is on one process; points may be on several, and on some without a triangle of
/// theirs. By default the surface is all here: nothing is sent, and sums stay what they are.
struct SurfacePart
{
  std::shared_ptr<const Processes> processes; ///< that the surface is spread over; none: all here
  std::vector<char> counts; ///< n, 1 where a point counts here: each on one process; none: all
  std::vector<int> shared;  ///< points that other processes have, too
  std::vector<int> numbers; ///< of those, the same on all processes, below numberOfShared
  int numberOfShared = 0;

  bool IsWhole() const { return !this->processes; }
  bool Counts(Eigen::Index i) const { return this->counts.empty() || this->counts[i] != 0; }
  /// The same processes for other points, of which each is on one of them.
  SurfacePart Apart() const;

  /// Over all processes, in a fixed order. All of them get the result. @{
  void Sum(double* numbers, std::size_t size) const;
  double Sum(double number) const;
  void Max(double* numbers, std::size_t size) const;
  double Max(double number) const;
  template <typename Derived>
  void Sum(Eigen::PlainObjectBase<Derived>& numbers) const
  {
    this->Sum(numbers.data(), static_cast<std::size_t>(numbers.size()));
  }
  /// @}
  std::vector<double> Concatenate(const std::vector<double>& own) const;
  /// Rows at points that several processes have become the sum of theirs.
  /// @param columns  of numbers @param numbers  n x columns, row by row
  void SumAtShared(double* numbers, int columns) const;
};

/// Lowest and highest coordinates of all points; infinite the wrong way round for none.
std::pair<Eigen::RowVector3d, Eigen::RowVector3d> BoundsOf(
  const Points& P, const SurfacePart& part = {});

/// Points of several processes at one place: the same coordinates to the last bit. Of those of one
/// process the first is one with the first of another process, the second with the second.
struct SharedPlaces
{
  std::vector<int> points;   ///< own points at a place that another process has, too
  std::vector<int> places;   ///< number of the place of each, the same on all processes
  std::vector<int> copies;   ///< the same for those that are one, of which a place may have more
  std::vector<char> isFirst; ///< whether each is the one that the place counts by
  std::vector<char> counts;  ///< n: 1 where the values of a point count and not those of another
  int numberOfPlaces = 0;
  int numberOfCopies = 0;
};

/// Finds them where cells of a grid that several processes have points in are halved again and
/// again, so that little is sent but what is near a border between two processes.
/// @param x  n x 3, all points of this process @param ghost  n, 1 for those that another one owns
SharedPlaces FindSharedPlaces(
  const Points& x, const std::vector<char>& ghost, const Processes& processes);
} // namespace SphericalStyle

#endif
