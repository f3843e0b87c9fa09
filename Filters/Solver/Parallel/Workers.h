// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Threads that lie in wait for work, for the loops of Parallel.h.
#ifndef SphericalStyle_Workers_h
#define SphericalStyle_Workers_h

#include <functional>

namespace SphericalStyle
{
/// Calls work(0), ..., work(count - 1), each once, on this thread and on up to threads - 1 others.
///
/// The others are started when they are first wanted and stay. This thread never waits for one that
/// has not begun: on a busy machine, or where the system has no thread to give, it does the work
/// itself. Any number of threads may call this at once, and so may work().
/// @throw what the work threw, once all of it has ended; the first in order if there is more
void RunOnWorkers(int count, int threads, const std::function<void(int)>& work);
} // namespace SphericalStyle

#endif
