// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Persistent worker threads, for the loops of Parallel.h.
///
/// Why not oneTBB: it was tried (2021.8) under the same loops. Whole solves of 98,000 points on two
/// quiet cores take .90 to 1.00 of the time, but 1.16 to 1.65 times as long while other processes
/// use the cores: its idle threads give up their turn and miss the next loops. And where the system
/// refuses a thread while it starts its own, it hangs or ends the process; this class works on.
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
