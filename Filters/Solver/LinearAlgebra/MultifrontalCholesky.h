// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The numbers of a sparse Cholesky factor.
#ifndef SphericalStyle_MultifrontalCholesky_h
#define SphericalStyle_MultifrontalCholesky_h

#include "SupernodalPattern.h"

#include <functional>

namespace SphericalStyle
{
/// What fronts are worked on with. Results differ by rounding only.
enum class InstructionSet
{
  Best, ///< of those that the processor has
  Avx2,
  Baseline
};

/// Factors P A P^T = L L^T by the multifrontal method (I. S. Duff and J. K. Reid, The multifrontal
/// solution of indefinite sparse symmetric linear equations, 1983; J. W. H. Liu, The multifrontal
/// method for sparse matrix solution: theory and practice, 1992).
///
/// Each supernode is a dense matrix, its front: the columns of A and what its children leave for
/// its rows. Its own columns are eliminated and handed over; what that takes from later rows is
/// left for its parent. Subtrees are worked on side by side, and so are the rows of large fronts;
/// nothing is ever added in another order, so the bits are the same for any number of threads.
///
/// Memory: what the children on the way leave, a small part of the factor, and a copy of A.
///
/// @param A  its lower triangle
/// @param pattern  of L, with the parents after their children @param tasks  those of the pattern
/// @param keep  is called once with each supernode and its numbers, laid out as SupernodePanel
///   says; from several threads at once, for different supernodes
/// @param set  what the processor does not have is not taken
/// @return false if A is not positive definite
/// @throw std::bad_alloc
bool MultifrontalCholesky(const SupernodalPattern::Matrix& A, const SupernodalPattern& pattern,
  const SupernodalTasks& tasks, int threads,
  const std::function<void(int s, const double* panel)>& keep,
  InstructionSet set = InstructionSet::Best);
} // namespace SphericalStyle

#endif
