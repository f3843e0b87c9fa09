// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A supernodal Cholesky factor in the order in which a solve reads it.
#ifndef SphericalStyle_PackedFactor_h
#define SphericalStyle_PackedFactor_h

#include "SupernodalPattern.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>

namespace SphericalStyle
{
/// Solves A X = B for three right-hand sides at once with the factor of A.
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
  /// Room for a factor of this pattern, which is not needed afterwards.
  explicit PackedFactor(const SupernodalPattern& pattern);
  ~PackedFactor();
  PackedFactor(PackedFactor&&) noexcept;
  PackedFactor& operator=(PackedFactor&&) noexcept;

  const SupernodalTasks& GetTasks() const;
  /// Copies the numbers of a supernode, laid out as SupernodePanel says. Each has to be set;
  /// several threads may set several at once.
  void Set(int s, const double* panel);

  using RightHandSides = Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>;
  /// Replaces B (n x 3) by A^-1 B. The same bits for any number of threads. Not for two threads at
  /// once.
  void Solve(RightHandSides B, int threads = 1) const;

  /// Bytes of the numbers of a factor of this pattern.
  static std::size_t GetMemorySize(const SupernodalPattern& pattern);

private:
  struct Data;
  std::unique_ptr<Data> D;
};

extern template class PackedFactor<float>;
extern template class PackedFactor<double>;
} // namespace SphericalStyle

#endif
