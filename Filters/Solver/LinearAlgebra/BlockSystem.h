// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Sparse systems with three rows for each point, assembled from elements and solved without a
/// factor.
#ifndef SphericalStyle_BlockSystem_h
#define SphericalStyle_BlockSystem_h

#include "ConjugateGradients.h"

#include <array>
#include <cstddef>
#include <vector>

namespace SphericalStyle
{
/// Which pairs of unknown points share an element: the lower triangle of a symmetric matrix, column
/// by column, with the diagonal first.
class PairPattern
{
public:
  /// Points of an element; -1 for one that is no unknown.
  using Element = std::array<int, 4>;

  PairPattern(int numberOfUnknowns, const std::vector<Element>& elements);

  int GetNumberOfUnknowns() const { return static_cast<int>(this->Starts.size()) - 1; }
  std::size_t GetNumberOfPairs() const { return this->Rows.size(); }
  /// Where the pair is, in any order. It must be one of an element.
  int PlaceOf(int a, int b) const;
  /// The lower triangle with one number for each pair, in the order of the places, all 0.
  ConjugateGradients::Matrix MakeMatrix() const;

private:
  friend class BlockSystem;
  std::vector<int> Starts;
  std::vector<int> Rows;
};

/// A X = B, A symmetric positive semidefinite, of blocks of 3 x 3 numbers for the pairs of a
/// pattern.
///
/// Solved by conjugate gradients on L^-1 A L^-T, L the Cholesky factors of the blocks on the
/// diagonal. No number of that is above 1, so that it is stored in single precision, which takes
/// half of the time and memory. What that costs in accuracy, 1e-7 of the condition, is for the
/// caller to see: it is meant for steps of Newton's method.
class BlockSystem
{
public:
  using Rows = FullMatrix::Rows; ///< n x 3, one row for each unknown

  /// @param pattern  must outlive this
  explicit BlockSystem(const PairPattern& pattern);

  void SetZero();
  /// Adds to the block of (row, column), row > column; its transpose if `turned`.
  template <typename Derived>
  void Add(int place, bool turned, const Eigen::MatrixBase<Derived>& block)
  {
    Eigen::Map<Eigen::Matrix3d> to(&this->Values[9 * static_cast<std::size_t>(place)]);
    if (turned)
    {
      to += block.transpose();
    }
    else
    {
      to += block;
    }
  }

  /// Steps of one solve, at most.
  static constexpr int LargestNumberOfSteps = 1000;

  /// B must be in the range of A. Solves from X = 0 with the blocks added so far, until the last
  /// steps together lower 1/2 X A X
  /// - X B by less than a share of what all have. The same bits for any number of threads.
  /// @return the number of steps
  int Solve(const Rows& B, Rows& X, double share, int threads);

private:
  void Scale(int threads);
  void Multiply(const Rows& X, Rows& Y, int threads) const;

  const PairPattern* Pattern;
  std::vector<double> Values; ///< 9 for each pair, column by column
  std::vector<int> Starts;    ///< of the rows of both triangles
  std::vector<int> Columns;
  std::vector<int> Sources;              ///< the pair; ~ of it where its transpose is meant
  std::vector<float> Scaled;             ///< 9 for each of Columns, column by column
  std::vector<Eigen::Matrix3d> Inverses; ///< L^-1
};
} // namespace SphericalStyle

#endif
