// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "TwinResults.h"

#include "LocalStep.h"
#include "MultifrontalCholesky.h"
#include "PackedFactor.h"
#include "Vector4.h"

#include <Eigen/SparseCore>

#include <algorithm>
#include <limits>
#include <mutex>
#include <random>

namespace SphericalStyle // the name of a twin
{
namespace
{
/// Of all sizes, and some that are no ordinary numbers.
class Numbers
{
public:
  double Next()
  {
    static constexpr double Special[] = { 0.0, -0.0, 1.0, -1.0,
      std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(),
      std::numeric_limits<float>::denorm_min(), std::numeric_limits<double>::denorm_min() };
    const unsigned kind = this->Engine() % 16;
    return kind < std::size(Special) ? Special[kind] : this->Signed() * (kind < 12 ? 1.0 : 1e10);
  }
  double Signed() { return static_cast<double>(this->Engine()) / 0x7fffffff - 1.0; }

private:
  std::mt19937 Engine; // the same numbers everywhere, as its standard says
};

class Results
{
public:
  explicit Results(std::string name) { this->Result.name = std::move(name); }
  template <typename Vector>
  void Add(const Vector& x, int width)
  {
    for (int k = 0; k < width; ++k)
    {
      this->Result.numbers.push_back(static_cast<double>(x[k]));
    }
  }
  TwinResult Result;
};

template <typename Vector, typename Scalar, int Width>
TwinResult Operations(const char* name)
{
  Numbers numbers;
  Results results(name);
  // Not by Add: GCC 12 takes that of four lanes for that of two, which has the same code, and
  // warns.
  const auto add = [&](const Vector& x)
  {
    for (int lane = 0; lane < Width; ++lane)
    {
      results.Result.numbers.push_back(static_cast<double>(x[lane]));
    }
  };
  for (int k = 0; k < 1000; ++k)
  {
    Vector a;
    Vector b;
    for (int lane = 0; lane < Width; ++lane)
    {
      a[lane] = static_cast<Scalar>(numbers.Next());
      b[lane] = static_cast<Scalar>(numbers.Next());
    }
    const auto s = static_cast<Scalar>(numbers.Next());
    add(Vector{});
    add(-a);
    add(a + b);
    add(a - b);
    add(a * b);
    add(a / b);
    add(a + s);
    add(a - s);
    add(s - a);
    add(a * s);
    add(s * a);
    Vector x = a;
    add(x += b);
    add(x -= s * a);
    add(x *= s);
    add(x /= b);
  }
  return results.Result;
}

TwinResult Parts()
{
  Numbers numbers;
  Results results("loads, sums and magnitudes");
  for (int k = 0; k < 1000; ++k)
  {
    double x[13];
    std::generate(std::begin(x), std::end(x), [&] { return numbers.Next(); });
    results.Add(Load4(x + 1), 4);
    results.Add(Load3(x + 1), 4);
    const Columns4 columns = LoadColumns(x);
    results.Add(columns.z, 3);
    results.Add(columns * (x + 9), 3);
    results.Add(columns * Load4(x + 9), 3);
    double stored[4];
    Store4(stored, Load4(x + 2));
    results.Add(stored, 4);

    Vector8 eight[4];
    Float8 single[4];
    for (int i = 0; i < 4; ++i)
    {
      for (int lane = 0; lane < 8; ++lane)
      {
        eight[i][lane] = numbers.Next();
        single[i][lane] = static_cast<float>(numbers.Next());
      }
      results.Add(Magnitude(eight[i]), 8);
    }
    results.Add(SumEach<Vector4>(eight), 4);
    results.Add(SumEach<Float4>(single), 4);
  }
  return results.Result;
}

TwinResult Rotations()
{
  Numbers numbers;
  Results results("closest rotations");
  constexpr int count = 1001; // the last eight are not whole
  Matrices S(count);
  for (int i = 0; i < count; ++i)
  {
    for (double& x : S[i].reshaped())
    {
      x = i % 7 == 0 ? 0.0 : numbers.Signed();
    }
    S[i] *= i % 5 == 0 ? 1e-3 : 1.0;
    S[i].col(2) *= i % 11 == 0 ? 0.0 : 1.0; // of rank 2
  }
  Matrices R(count, Eigen::Matrix3d::Identity());
  const double change = FitRotations(S, R, 1);
  results.Add(&change, 1);
  results.Add(R.data()->data(), 9 * count);
  return results.Result;
}

/// Springs on a sheet, each point also held a little.
SupernodalPattern::Matrix Springs(int side)
{
  Numbers numbers;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int u, int v)
  {
    const double weight = 1.5 + numbers.Signed();
    entries.emplace_back(u, u, weight);
    entries.emplace_back(v, v, weight);
    entries.emplace_back(std::max(u, v), std::min(u, v), -weight);
  };
  for (int i = 0; i < side; ++i)
  {
    for (int j = 0; j < side; ++j)
    {
      const int u = i * side + j;
      entries.emplace_back(u, u, 0.1);
      if (i + 1 < side)
      {
        add(u, u + side);
      }
      if (j + 1 < side)
      {
        add(u, u + 1);
      }
    }
  }
  SupernodalPattern::Matrix A(side * side, side * side);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

template <typename Scalar>
void Solve(const SupernodalPattern::Matrix& A, const char* name, std::vector<TwinResult>& all)
{
  const SupernodalPattern pattern(A);
  for (const InstructionSet set :
    { InstructionSet::Best, InstructionSet::Avx2, InstructionSet::Baseline })
  {
    const std::string suffix = std::string(name) + " " + std::to_string(static_cast<int>(set));
    Results factor("factor, " + suffix);
    Results solved("solution, " + suffix);
    PackedFactor<Scalar> packed(pattern);
    const bool definite = MultifrontalCholesky(
      A, pattern, packed.GetTasks(), 1,
      [&](int s, const double* panel)
      {
        packed.Set(s, panel);
        const SupernodePanel layout(pattern.GetColumns(s), pattern.GetRowsBelow(s));
        factor.Add(panel, static_cast<int>(layout.GetSize()));
      },
      set);
    const double told = definite;
    factor.Add(&told, 1);
    Numbers numbers;
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> x(A.rows(), 3);
    std::generate(x.data(), x.data() + x.size(), [&] { return numbers.Signed(); });
    packed.Solve(x);
    solved.Add(x.data(), static_cast<int>(x.size()));
    all.push_back(factor.Result);
    all.push_back(solved.Result);
  }
}
}

std::vector<TwinResult> GetResults()
{
  std::vector<TwinResult> all = { Operations<Vector2, double, 2>("Vector2"),
    Operations<Vector4, double, 4>("Vector4"), Operations<Vector8, double, 8>("Vector8"),
    Operations<Float4, float, 4>("Float4"), Operations<Float8, float, 8>("Float8"), Parts(),
    Rotations() };
  const SupernodalPattern::Matrix A = Springs(60);
  Solve<double>(A, "double", all);
  Solve<float>(A, "float", all);
  return all;
}
} // namespace SphericalStyle
