// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the operating system gives to this process: the only file that asks it.
#ifndef SphericalStyle_Process_h
#define SphericalStyle_Process_h

#include <cstddef>

namespace SphericalStyle
{
/// Number of this process; another one after a fork.
long ProcessId();
/// Cores that this process may run on, of `machine`, all that there are.
int CoresOfProcess(int machine);
/// Bytes of the machine; infinite where the system does not tell.
double MemoryOfMachine();
/// Asks for huge pages where the system has them. @param memory  starts at a multiple of 2 MiB
/// @param bytes  a multiple of 2 MiB
void UseHugePages(void* memory, std::size_t bytes);
} // namespace SphericalStyle

#endif
