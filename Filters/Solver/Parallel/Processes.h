// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the processes that a surface is spread over tell each other.
#ifndef SphericalStyle_Processes_h
#define SphericalStyle_Processes_h

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

namespace SphericalStyle
{
/// Thrown by all processes alike, where the method needs all of a surface in one of them.
class WholeSurfaceNeeded : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Thrown in place of an answer where another process has failed: it says why.
class OtherProcessFailed : public std::runtime_error
{
public:
  OtherProcessFailed()
    : std::runtime_error("another process has failed")
  {
  }
};

/// All processes call the same functions in the same order, with as many numbers, and get the same
/// bits; for the same processes and numbers these are the same in every run. A process that fails
/// between two calls makes the next call of the others throw OtherProcessFailed.
class Processes
{
public:
  /// Puts what one process has to what a lower one has.
  using Join = std::function<void(double* into, const double* from)>;

  virtual ~Processes() = default;
  virtual int GetRank() const = 0;
  /// Joins the numbers of all processes, two by two, always the same two.
  virtual void Reduce(double* numbers, std::size_t size, const Join& join) const = 0;
  /// The numbers of all processes, in their order; each may have another number of them.
  virtual std::vector<double> Concatenate(const std::vector<double>& own) const = 0;
};
} // namespace SphericalStyle

#endif
