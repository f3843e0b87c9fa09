// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LinearSystem.h"

#include "Process.h"
#include "TriangleMesh.h"

namespace SphericalStyle
{
namespace
{
constexpr int SmallestSingle = 20000; // rows; below, a solve takes no time worth halving
}

LinearSystem::LinearSystem(LinearMethod method)
  : Method(method)
  , LargestFactor(0.5 * MemoryOfMachine())
{
}

void LinearSystem::Analyze(const Matrix& A)
{
  this->Chosen = this->Method;
  if (this->Method == LinearMethod::Automatic)
  {
    this->Chosen = this->Choose(A);
  }
  else if (this->Method != LinearMethod::ConjugateGradients)
  {
    this->Cholesky.Analyze(A);
  }
}

LinearMethod LinearSystem::Choose(const Matrix& A)
{
  try
  {
    this->Cholesky.Analyze(A);
    if (this->Cholesky.GetFactorBytes() <= this->LargestFactor)
    {
      return A.rows() < SmallestSingle ? LinearMethod::Factor : LinearMethod::SingleFactor;
    }
  }
  catch (const SolverError&) // too large to be counted in 32 bits
  {
  }
  this->Cholesky = SparseCholesky();
  return LinearMethod::ConjugateGradients;
}

void LinearSystem::Factor(const Matrix& A, int threads)
{
  this->Used = this->Chosen; // whatever the last numbers needed
  this->NumberOfSteps = 0;
  this->NumberOfUnfinishedSolves = 0;
  this->Full = {};
  this->Gradients = {};
  if (this->Used == LinearMethod::ConjugateGradients)
  {
    this->Full = FullMatrix(A);
    if (this->Gradients.SetMatrix(A))
    {
      return;
    }
    this->Full = {}; // not positive definite
    this->Used = LinearMethod::Factor;
    this->Cholesky.Analyze(A);
  }
  const bool single = this->Used == LinearMethod::SingleFactor;
  this->Cholesky.Factor(
    A, single ? SparseCholesky::Precision::Single : SparseCholesky::Precision::Double, threads);
  if (this->Cholesky.GetPrecision() == SparseCholesky::Precision::Single)
  {
    this->Full = FullMatrix(A);
  }
}

void LinearSystem::Solve(const RightHandSides& B, RightHandSides& X, int threads)
{
  if (this->Used == LinearMethod::ConjugateGradients)
  {
    const int steps = this->Gradients.Solve(this->Full, B, X, this->ShareLeft, threads);
    this->NumberOfSteps += steps;
    this->NumberOfUnfinishedSolves += steps == ConjugateGradients::LargestNumberOfSteps ? 1 : 0;
    if (!X.allFinite())
    {
      throw SolverError("the system matrix is singular to machine precision");
    }
  }
  else if (this->Cholesky.GetPrecision() == SparseCholesky::Precision::Single)
  {
    // Each correction leaves the square of its error of what could be gained.
    const double left = this->Cholesky.GetError() * this->Cholesky.GetError();
    double share = 1.0;
    do
    {
      RightHandSides correction = this->Full.Residual(B, X, threads);
      this->Cholesky.Solve(correction, threads);
      X += correction;
      share *= left;
    } while (share > this->ShareLeft);
  }
  else
  {
    X = B;
    this->Cholesky.Solve(X, threads);
  }
}

bool LinearSystem::IsDefinite() const
{
  return this->Used == LinearMethod::ConjugateGradients || this->Cholesky.IsDefinite();
}

std::string LinearSystem::GetName() const
{
  return this->Used == LinearMethod::ConjugateGradients ? "conjugate gradients, incomplete Cholesky"
                                                        : this->Cholesky.GetName();
}
} // namespace SphericalStyle
