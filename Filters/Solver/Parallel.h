// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Loops over independent items on several threads. Results have the same bits for any number of
/// threads: items never share output, and sums are taken over blocks of fixed size, in order.
#ifndef SphericalStyle_Parallel_h
#define SphericalStyle_Parallel_h

#include <functional>

namespace SphericalStyle
{
/// Calls body(begin, end) on disjoint ranges that cover 0..n. body must not throw.
void ParallelFor(int n, int threads, const std::function<void(int, int)>& body);

/// Sum of body(begin, end) over blocks of fixed size, added in order.
double ParallelSum(int n, int threads, const std::function<double(int, int)>& body);
} // namespace SphericalStyle

#endif
