// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A supernodal Cholesky factor in the order in which a solve reads it.
#ifndef SphericalStyle_PackedFactor_h
#define SphericalStyle_PackedFactor_h

#include "SupernodalFactor.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace SphericalStyle
{
/// Solves A X = B for three right-hand sides at once with the factor of A, of which it holds a
/// copy: the factor itself is not needed any more.
///
/// Four columns of a supernode are a block: the inverse of its 4 x 4 triangle, and then tiles of
/// eight rows by four columns for the rows below it. Forward substitution reads all of it in
/// ascending order, backward substitution in descending order, and both work on eight rows at once.
/// What a solve costs is therefore reading the values twice.
///
/// @tparam Scalar  double, or float for half of that cost and of the memory: the result is then
/// right to about 1e-7 times the condition number of A
template <typename Scalar>
class PackedFactor
{
public:
  PackedFactor();
  /// Called with pieces of the factor's values that are copied and not read again.
  using Release = std::function<void(const double* begin, const double* end)>;
  explicit PackedFactor(
    const SupernodalFactor& factor, int threads = 1, const Release& release = {});
  ~PackedFactor();
  PackedFactor(PackedFactor&&) noexcept;
  PackedFactor& operator=(PackedFactor&&) noexcept;

  using RightHandSides = Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>;
  /// Replaces B (n x 3) by A^-1 B. The same bits for any number of threads. Not for two threads at
  /// once.
  void Solve(RightHandSides B, int threads = 1) const;

  /// Of the values.
  std::size_t GetMemorySize() const;

private:
  struct Data;
  std::unique_ptr<Data> D;
};

extern template class PackedFactor<float>;
extern template class PackedFactor<double>;
} // namespace SphericalStyle

#endif
