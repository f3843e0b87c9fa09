// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The vectors of the compiler and their twin for compilers without: the same bits, by each
// operation and by all that is built on them, for every instruction set. Neither fuses products and
// sums here.
#include "Check.h"
#include "TwinResults.h"

#include <cmath>
#include <cstring>

namespace
{
bool SameBits(double a, double b)
{
  return std::memcmp(&a, &b, sizeof(a)) == 0 || (std::isnan(a) && std::isnan(b));
}

void CheckSame(const TwinResult& vectors, const TwinResult& scalars)
{
  CHECK(vectors.name == scalars.name, vectors.name << " should be compared with itself");
  CHECK(!vectors.numbers.empty() && vectors.numbers.size() == scalars.numbers.size(),
    vectors.name << ": " << vectors.numbers.size() << " and " << scalars.numbers.size()
                 << " numbers");
  for (std::size_t i = 0; i < vectors.numbers.size() && i < scalars.numbers.size(); ++i)
  {
    CHECK(SameBits(vectors.numbers[i], scalars.numbers[i]),
      vectors.name << ", number " << i << ": " << vectors.numbers[i] << " with vectors, "
                   << scalars.numbers[i] << " without");
  }
}

/// Fronts come to the same bits for every instruction set, too.
void CheckInstructionSets(const std::vector<TwinResult>& results)
{
  const TwinResult* first = nullptr;
  int sets = 0;
  for (const TwinResult& result : results)
  {
    if (result.name.rfind("factor", 0) == 0)
    {
      first = first ? first : &result;
      ++sets;
      CHECK(result.numbers == first->numbers,
        result.name << " should have the bits of " << first->name);
    }
  }
  CHECK(sets == 6, "there are " << sets << " factors");
}
}

int main()
{
  const std::vector<TwinResult> vectors = VectorTwin::GetResults();
  const std::vector<TwinResult> scalars = ScalarTwin::GetResults();
  CHECK(vectors.size() == scalars.size(), "each result should have its twin");
  for (std::size_t i = 0; i < vectors.size() && i < scalars.size(); ++i)
  {
    CheckSame(vectors[i], scalars[i]);
  }
  CheckInstructionSets(vectors);
  return CheckResult();
}
