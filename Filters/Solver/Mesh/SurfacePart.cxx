// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfacePart.h"

#include "SharedNumbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>

namespace SphericalStyle
{
SurfacePart SurfacePart::Apart() const
{
  SurfacePart apart;
  apart.processes = this->processes;
  return apart;
}

void SurfacePart::Sum(double* numbers, std::size_t size) const
{
  if (this->processes)
  {
    this->processes->Reduce(numbers, size,
      [size](double* into, const double* from)
      {
        for (std::size_t i = 0; i < size; ++i)
        {
          into[i] += from[i];
        }
      });
  }
}

double SurfacePart::Sum(double number) const
{
  this->Sum(&number, 1);
  return number;
}

void SurfacePart::Max(double* numbers, std::size_t size) const
{
  if (this->processes)
  {
    this->processes->Reduce(numbers, size,
      [size](double* into, const double* from)
      {
        for (std::size_t i = 0; i < size; ++i)
        {
          into[i] = std::max(into[i], from[i]);
        }
      });
  }
}

double SurfacePart::Max(double number) const
{
  this->Max(&number, 1);
  return number;
}

std::vector<double> SurfacePart::Concatenate(const std::vector<double>& own) const
{
  return this->processes ? this->processes->Concatenate(own) : own;
}

void SurfacePart::SumAtShared(double* numbers, int columns) const
{
  if (this->numberOfShared == 0)
  {
    return;
  }
  std::vector<double> sums(static_cast<std::size_t>(this->numberOfShared) * columns, 0.0);
  const auto rowOf = [columns](int i) { return static_cast<std::ptrdiff_t>(i) * columns; };
  for (std::size_t k = 0; k < this->shared.size(); ++k)
  {
    std::copy_n(numbers + rowOf(this->shared[k]), columns, sums.begin() + rowOf(this->numbers[k]));
  }
  this->Sum(sums.data(), sums.size());
  for (std::size_t k = 0; k < this->shared.size(); ++k)
  {
    std::copy_n(sums.begin() + rowOf(this->numbers[k]), columns, numbers + rowOf(this->shared[k]));
  }
}

std::pair<Eigen::RowVector3d, Eigen::RowVector3d> BoundsOf(const Points& P, const SurfacePart& part)
{
  Eigen::Matrix<double, 1, 6> most; // -low, high
  most.setConstant(-std::numeric_limits<double>::infinity());
  if (P.rows() > 0)
  {
    most << -P.colwise().minCoeff(), P.colwise().maxCoeff();
  }
  part.Max(most.data(), 6);
  return { -most.head<3>(), most.tail<3>() };
}

namespace
{
/// Halvings along an axis at which cells are compared; a cell has a number of 51 bits, which a
/// double holds.
constexpr int Halvings[] = { 7, 9, 11, 13, 15, 17 };
constexpr int MostHalvings = 17;

using CellAt = std::array<std::int64_t, 3>;

/// The cells of places after most halvings of the bounds of all processes.
std::vector<CellAt> FinestCells(const Points& x, const SurfacePart& everybody)
{
  const auto [low, high] = BoundsOf(x, everybody);
  constexpr std::int64_t Cells = std::int64_t(1) << MostHalvings;
  std::vector<CellAt> cells(x.rows());
  for (Eigen::Index i = 0; i < x.rows(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double extent = 0.5 * high(axis) - 0.5 * low(axis);
      const double share =
        extent > 0.0 ? (0.5 * x(i, axis) - 0.5 * low(axis)) / extent * Cells : 0.0;
      cells[i][axis] = std::clamp(static_cast<std::int64_t>(share), std::int64_t(0), Cells - 1);
    }
  }
  return cells;
}

/// The points in cells that others have points in, at all levels.
std::vector<int> PointsNearOthers(
  const Points& x, const Processes& processes, const SurfacePart& everybody)
{
  const std::vector<CellAt> cells = FinestCells(x, everybody);
  std::vector<int> near(x.rows());
  std::iota(near.begin(), near.end(), 0);
  for (const int halvings : Halvings)
  {
    const auto numberOf = [&](int i)
    {
      std::int64_t number = 0;
      for (const std::int64_t at : cells[i])
      {
        number = (number << halvings) + (at >> (MostHalvings - halvings));
      }
      return static_cast<double>(number);
    };
    std::vector<double> own(near.size());
    std::transform(near.begin(), near.end(), own.begin(), numberOf);
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    const std::vector<double> several = HadBySeveral(own, processes);
    near.erase(
      std::remove_if(near.begin(), near.end(),
        [&](int i) { return !std::binary_search(several.begin(), several.end(), numberOf(i)); }),
      near.end());
  }
  return near;
}

/// A point of some process.
struct PointElsewhere
{
  std::array<double, 3> place;
  int rank;
  int id;
  bool ghost;
};
/// The points of all processes near others, those at one place after each other.
std::vector<PointElsewhere> PointsOfAll(
  const Points& x, const std::vector<char>& ghost, const Processes& processes)
{
  SurfacePart everybody;
  everybody.processes = { &processes, [](const Processes*) {} };
  const std::vector<int> near = PointsNearOthers(x, processes, everybody);
  const int rank = processes.GetRank();
  std::vector<double> rows;
  for (const int i : near)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      rows.push_back(x(i, axis) + 0.0); // -0 and 0 are one place
    }
    rows.insert(rows.end(),
      { static_cast<double>(rank), static_cast<double>(i), static_cast<double>(ghost[i]) });
  }
  rows = processes.Concatenate(rows);
  std::vector<PointElsewhere> points;
  for (std::size_t k = 0; k < rows.size(); k += 6)
  {
    points.push_back({ { rows[k], rows[k + 1], rows[k + 2] }, static_cast<int>(rows[k + 3]),
      static_cast<int>(rows[k + 4]), rows[k + 5] != 0.0 });
  }
  std::sort(points.begin(), points.end(),
    [](const PointElsewhere& a, const PointElsewhere& b)
    { return std::tie(a.place, a.rank, a.id) < std::tie(b.place, b.rank, b.id); });
  return points;
}

/// Of points at one place, those that are one: the first of each process, the second, ...
struct Turns
{
  std::vector<std::size_t> owners; ///< the point that counts, of each turn
  std::vector<std::size_t> of;     ///< the turn of each point
};

Turns TurnsOf(const std::vector<PointElsewhere>& points, std::size_t begin, std::size_t end)
{
  Turns turns;
  for (std::size_t k = begin; k < end; ++k)
  {
    const bool again = k > begin && points[k].rank == points[k - 1].rank;
    turns.of.push_back(again ? turns.of.back() + 1 : 0);
    const std::size_t turn = turns.of.back();
    if (turn == turns.owners.size())
    {
      turns.owners.push_back(k);
    }
    else if (points[turns.owners[turn]].ghost && !points[k].ghost)
    {
      turns.owners[turn] = k;
    }
  }
  return turns;
}
}

SharedPlaces FindSharedPlaces(
  const Points& x, const std::vector<char>& ghost, const Processes& processes)
{
  const int rank = processes.GetRank();
  const std::vector<PointElsewhere> points = PointsOfAll(x, ghost, processes);
  SharedPlaces shared;
  shared.counts.assign(x.rows(), 1);
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end)
  {
    while (end < points.size() && points[end].place == points[begin].place)
    {
      ++end;
    }
    const auto [owners, turnOf] = TurnsOf(points, begin, end);
    if (points[begin].rank == points[end - 1].rank)
    {
      continue;
    }
    for (std::size_t k = begin; k < end; ++k)
    {
      if (points[k].rank == rank)
      {
        const std::size_t turn = turnOf[k - begin];
        const bool counts = owners[turn] == k;
        shared.points.push_back(points[k].id);
        shared.places.push_back(shared.numberOfPlaces);
        shared.copies.push_back(shared.numberOfCopies + static_cast<int>(turn));
        shared.isFirst.push_back(counts && turn == 0 ? 1 : 0);
        shared.counts[points[k].id] = counts ? 1 : 0;
      }
    }
    ++shared.numberOfPlaces;
    shared.numberOfCopies += static_cast<int>(owners.size());
  }
  return shared;
}
} // namespace SphericalStyle
