// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// A solver that ran out of memory at any of its allocations, in whatever thread, is as good as a
// new one: the next solve gives the same bits.
#include "Check.h"
#include "FixedIterations.h"
#include "Meshes.h"
#include "NonlinearFeature.h"
#include "SphericalStyleMethod.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace
{
std::atomic<long> Left = -1; // allocations until one fails; none does if negative

void* Allocate(std::size_t size, std::size_t alignment)
{
  void* memory = nullptr;
  if ((Left < 0 || Left-- != 0) &&
    posix_memalign(&memory, std::max(alignment, sizeof(void*)), size) == 0)
  {
    return memory;
  }
  throw std::bad_alloc();
}
}

void* operator new(std::size_t size)
{
  return Allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
  return Allocate(size, static_cast<std::size_t>(alignment));
}
// The library's own would call that above, a sanitizer's does not.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  try
  {
    return operator new(size);
  }
  catch (const std::bad_alloc&)
  {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}

using namespace SphericalStyle;

namespace
{
/// @param before  of the solve that fills what is kept @param options  of the one that fails
template <typename Solver, typename Options>
void CheckFaults(const char* name, const Options& before, const Options& options)
{
  const TriangleMesh first = Meshes::Perturbed(Meshes::Ellipsoid(1), 0.02, 1);
  TriangleMesh second = first;
  second.P.row(5) *= 1.1;
  Solver fresh;
  fresh.SetMesh(second);
  fresh.Solve(options);
  int faults = 0;
  for (bool failed = true; failed; faults += failed)
  {
    Solver solver;
    solver.SetMesh(first);
    solver.Solve(before);
    Left = faults;
    try
    {
      solver.SetMesh(second);
      solver.Solve(options);
    }
    catch (const std::bad_alloc&)
    {
    }
    catch (const SolverError&)
    {
    }
    failed = Left < 0; // or else it was the last
    Left = -1;
    solver.SetMesh(second);
    solver.Solve(options);
    CHECK(Meshes::SameBits(solver.GetPositions(), fresh.GetPositions()),
      name << ": after allocation " << faults << " failed the next solve is off by "
           << Meshes::Distance(solver.GetPositions(), fresh.GetPositions()));
  }
  CHECK(faults > 100, name << ": only " << faults << " allocations");
}

MethodOptions Method(const StyleOptions& options)
{
  MethodOptions method;
  static_cast<StyleOptions&>(method) = options;
  return method;
}
}

int main()
{
  StyleOptions before = Fixed({}, 3);
  before.lambda = 2.0;
  for (const int threads : { 1, 3 })
  {
    StyleOptions stitched = Fixed({}, 3);
    stitched.threads = threads;
    stitched.componentCoupling = ComponentCoupling::Stitched;
    stitched.edgeWeighting = EdgeWeighting::IntrinsicDelaunay;
    CheckFaults<StyleSolver>("intrinsic triangles, stitched", before, stitched);
    MethodOptions coarse = Method(before);
    coarse.detailSize = 0.3;
    MethodOptions details = Method(stitched);
    details.detailSize = 0.2;
    CheckFaults<SphericalStyleMethod>("details", coarse, details);
    StyleOptions held = Fixed({}, 3);
    held.threads = threads;
    held.fixedPoints = { 1, 2, 3 };
    held.fixedPositions = Points::Random(3, 3);
    held.linearMethod = LinearMethod::SingleFactor;
    held.sphericalWeighting = SphericalWeighting::Cotangent;
    CheckFaults<StyleSolver>("fixed points", before, held);
  }
  NonlinearOptions nonlinear;
  nonlinear.loop = before.loop;
  NonlinearOptions other = nonlinear;
  other.lambda = 2.0;
  CheckFaults<NonlinearFeature>("nonlinear", other, nonlinear);
  return CheckResult();
}
