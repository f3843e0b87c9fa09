// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Loops over independent items on several threads. Results have the same bits for any number of
/// threads: items never share output, and sums are taken over blocks of fixed size, in order. What
/// a body throws is thrown here once all threads have ended, the first in order if there are
/// several; where the system has no thread to give, this one does the work.
#ifndef SphericalStyle_Parallel_h
#define SphericalStyle_Parallel_h

#include <algorithm>
#include <functional>
#include <vector>

namespace SphericalStyle
{
/// How many threads this process takes where nobody says: as many as it may run on (taskset,
/// containers and MPI's binding set that), and with several processes of MPI on this machine no
/// more than its share of the cores. The launcher tells how many they are (Open MPI, MPICH, Intel
/// MPI, MVAPICH). Where a container has only a part of the machine and processes in it are not
/// bound to cores, set the number of threads.
int ThreadsOfThisProcess();

/// Calls body(begin, end) on disjoint ranges that cover 0..n.
void ParallelFor(int n, int threads, const std::function<void(int, int)>& body);

/// Calls body(task) for 0..count-1, the next one on whichever thread is free. Tasks must not share
/// output.
void ParallelTasks(int count, int threads, const std::function<void(int)>& body);

/// Calls body(block, begin, end) for blocks of fixed size that cover 0..n.
void ParallelBlocks(int n, int threads, const std::function<void(int, int, int)>& body);
int NumberOfBlocks(int n);

/// Sum of body(begin, end) over blocks of fixed size, added to start in order.
template <typename Sum, typename Body>
Sum ParallelSum(int n, int threads, Sum start, const Body& body)
{
  std::vector<Sum> partial(NumberOfBlocks(n), start);
  ParallelBlocks(
    n, threads, [&](int block, int begin, int end) { partial[block] = body(begin, end); });
  for (const Sum& value : partial)
  {
    start += value;
  }
  return start;
}

template <typename Body>
double ParallelSum(int n, int threads, const Body& body)
{
  return ParallelSum(n, threads, 0.0, body);
}
} // namespace SphericalStyle

#endif
