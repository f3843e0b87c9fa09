// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MatrixCondition.h"

#include "EdgeMatrix.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace SphericalStyle
{
namespace
{
using Vector = Eigen::VectorXd;
using Operator = std::function<Vector(const Vector&)>;

struct Eigenvalue
{
  double value = 0.0;
  double accuracy = 0.0; // bound on the relative error
};

/// Numbers without a pattern, the same everywhere: no eigenvector is orthogonal to them.
Vector StartVector(Eigen::Index n)
{
  Vector x(n);
  std::uint32_t state = 1;
  for (double& value : x)
  {
    state = 1664525u * state + 1013904223u;
    value = state / 4294967296.0 - 0.5;
  }
  return x;
}

/// Largest eigenvalue of a positive semidefinite operator. No vectors are kept and orthogonalized:
/// what rounding then does is to find the outermost eigenvalues more than once (Paige 1972), and
/// the bound |beta s| on their distance holds all the same.
Eigenvalue LargestEigenvalue(const Operator& A, const Vector& start, double tolerance)
{
  constexpr int MaximumSteps = 2000;
  int nextLook = 10; // which takes step^3, so that there are fewer and fewer
  std::vector<double> alpha;
  std::vector<double> beta;
  Vector before = Vector::Zero(start.size());
  Vector v = start.normalized();
  Eigenvalue result;
  for (int step = 1; step <= MaximumSteps; ++step)
  {
    Vector w = A(v);
    alpha.push_back(v.dot(w));
    w -= alpha.back() * v + (beta.empty() ? 0.0 : beta.back()) * before;
    const double next = w.norm();
    const bool exhausted = !(next > 1e-14 * std::abs(alpha.front()));
    if (exhausted || step == nextLook || step == MaximumSteps)
    {
      nextLook += std::max(10, nextLook / 4);
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small;
      small.computeFromTridiagonal(Eigen::Map<const Vector>(alpha.data(), step),
        Eigen::Map<const Vector>(beta.data(), step - 1));
      result.value = small.eigenvalues()(step - 1);
      result.accuracy = next * std::abs(small.eigenvectors()(step - 1, step - 1)) / result.value;
      if (exhausted || result.accuracy <= tolerance)
      {
        break;
      }
    }
    beta.push_back(next);
    before.swap(v);
    v = w / next;
  }
  return result;
}

/// The symmetric matrix on the points that are not fixed, and its inverse.
class Matrix
{
public:
  Matrix(const MeshTopology& topology, const std::vector<char>& fixed, const HalfEdgeScalars& k)
    : Edges(topology, fixed)
    , Lower(this->Edges.Assemble(k))
  {
  }

  int GetNumberOfRows() const { return this->Edges.GetNumberOfRows(); }
  const std::vector<int>& GetRows() const { return this->Edges.GetRows(); }
  Vector Multiply(const Vector& x) const { return this->Lower.selfadjointView<Eigen::Lower>() * x; }

  void Factor()
  {
    this->Cholesky.Analyze(this->Lower);
    this->Cholesky.Factor(this->Lower);
  }
  Vector Solve(const Vector& b) const
  {
    SparseCholesky::RightHandSides B = SparseCholesky::RightHandSides::Zero(b.size(), 3);
    B.col(0) = b;
    this->Cholesky.Solve(B);
    return B.col(0);
  }

private:
  EdgeMatrix Edges;
  const SparseCholesky::Matrix& Lower; // lives in Edges
  SparseCholesky Cholesky;
};

/// x without its mean over each component: what the null space has no part in.
void RemoveMeans(const MeshTopology& topology, Vector& x)
{
  const std::vector<int>& component = topology.GetComponents();
  Vector sum = Vector::Zero(topology.GetNumberOfComponents());
  Vector count = sum;
  for (Eigen::Index i = 0; i < x.size(); ++i)
  {
    sum(component[i]) += x(i);
    count(component[i]) += 1.0;
  }
  for (Eigen::Index i = 0; i < x.size(); ++i)
  {
    x(i) -= sum(component[i]) / count(component[i]);
  }
}

/// The pseudo-inverse: with the last point of each component at 0, then around the mean.
Vector PseudoSolve(const MeshTopology& topology, const Matrix& pinned, Vector b)
{
  RemoveMeans(topology, b);
  const std::vector<int>& rows = pinned.GetRows();
  Vector reduced(pinned.GetNumberOfRows());
  for (Eigen::Index i = 0; i < b.size(); ++i)
  {
    if (rows[i] >= 0)
    {
      reduced(rows[i]) = b(i);
    }
  }
  reduced = pinned.Solve(reduced);
  Vector x = Vector::Zero(b.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
  {
    if (rows[i] >= 0)
    {
      x(i) = reduced(rows[i]);
    }
  }
  RemoveMeans(topology, x);
  return x;
}
}

MatrixCondition EstimateCondition(
  const MeshTopology& topology, const HalfEdgeScalars& k, double tolerance)
{
  const int n = topology.GetNumberOfPoints();
  std::vector<char> fixed(n, 0);
  const Matrix whole(topology, fixed, k);
  for (const int i : topology.GetLastPoints())
  {
    fixed[i] = 1;
  }
  Matrix pinned(topology, fixed, k);
  pinned.Factor();

  Vector start = StartVector(n);
  RemoveMeans(topology, start);
  const Vector pinnedStart = StartVector(pinned.GetNumberOfRows());
  const Eigenvalue largest =
    LargestEigenvalue([&](const Vector& x) { return whole.Multiply(x); }, start, tolerance);
  const Eigenvalue smallest = LargestEigenvalue(
    [&](const Vector& x) { return PseudoSolve(topology, pinned, x); }, start, tolerance);
  const Eigenvalue pinnedLargest =
    LargestEigenvalue([&](const Vector& x) { return pinned.Multiply(x); }, pinnedStart, tolerance);
  const Eigenvalue pinnedSmallest =
    LargestEigenvalue([&](const Vector& x) { return pinned.Solve(x); }, pinnedStart, tolerance);

  MatrixCondition condition;
  condition.nonZero = largest.value * smallest.value;
  condition.pinned = pinnedLargest.value * pinnedSmallest.value;
  condition.accuracy = std::max(
    largest.accuracy + smallest.accuracy, pinnedLargest.accuracy + pinnedSmallest.accuracy);
  return condition;
}
} // namespace SphericalStyle
