// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SparseCholesky.h"

#include "MultifrontalCholesky.h"
#include "PackedFactor.h"
#include "TriangleMesh.h"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <new>
#include <random>

namespace SphericalStyle
{
class SparseCholesky::Implementation
{
public:
  virtual ~Implementation() = default;
  virtual const char* GetName() const = 0;
  virtual void Analyze(const Matrix& A) = 0;
  virtual double GetFactorBytes() const { return 0.0; }
  virtual void Factor(const Matrix& A, Precision precision, int threads) = 0;
  virtual Precision GetPrecision() const { return Precision::Double; }
  virtual double GetError() const { return 0.0; }
  virtual bool IsDefinite() const = 0;
  virtual void Solve(RightHandSides& B, int threads) const = 0;
};

//------------------------------------------------------------------------------------------------
class SparseCholesky::EigenImplementation : public SparseCholesky::Implementation
{
public:
  const char* GetName() const override { return "Eigen LDLT"; }
  void Analyze(const Matrix& A) override { this->Ldlt.analyzePattern(A); }
  void Factor(const Matrix& A, Precision, int) override
  {
    this->Ldlt.factorize(A);
    if (this->Ldlt.info() != Eigen::Success)
    {
      throw SolverError("the system matrix is singular: it cannot be factored");
    }
  }
  bool IsDefinite() const override { return (this->Ldlt.vectorD().array() > 0.0).all(); }
  void Solve(RightHandSides& B, int) const override { B = this->Ldlt.solve(B).eval(); }

private:
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> Ldlt;
};

//------------------------------------------------------------------------------------------------
namespace
{
constexpr double LargestError = 1e-3; // of a solution in single precision

/// Error of A^-1 b by the factor, in the norm of A and relative, for numbers b that have nothing to
/// do with each other: smooth solutions, where the error is largest, come out of them too.
double ErrorOf(const PackedFactor<float>& factor, const SparseCholesky::Matrix& A, int threads)
{
  SparseCholesky::RightHandSides b(A.rows(), 3);
  std::minstd_rand random; // the same numbers everywhere
  for (double& value : b.reshaped())
  {
    value = static_cast<double>(random()) / std::minstd_rand::max() - 0.5;
  }
  SparseCholesky::RightHandSides x = b;
  factor.Solve(x, threads);
  const SparseCholesky::RightHandSides left = b - A.selfadjointView<Eigen::Lower>() * x;
  SparseCholesky::RightHandSides error = left;
  factor.Solve(error, threads);
  const double whole = x.cwiseProduct(b).sum();
  const double off = std::abs(error.cwiseProduct(left).sum());
  return whole > 0.0 && std::isfinite(off) ? std::sqrt(off / whole) : 1.0;
}
}

class SparseCholesky::MultifrontalImplementation : public SparseCholesky::Implementation
{
public:
  const char* GetName() const override
  {
    if (this->Indefinite)
    {
      return this->Indefinite->GetName();
    }
    return this->Used == Precision::Single ? "multifrontal LLT in single precision"
                                           : "multifrontal LLT";
  }

  void Analyze(const Matrix& A) override
  {
    this->Indefinite.reset();
    this->Pattern = SupernodalPattern(A);
  }

  double GetFactorBytes() const override
  {
    return static_cast<double>(PackedFactor<double>::GetMemorySize(this->Pattern));
  }

  void Factor(const Matrix& A, Precision precision, int threads) override
  {
    this->Indefinite.reset();
    this->Double = {}; // their memory is needed
    this->Single = {};
    this->Used = precision;
    this->Error = 0.0;
    try
    {
      if (!this->FactorIn(A, threads))
      {
        this->Used = Precision::Double;
        this->Double = {};
        this->Single = {};
        this->Indefinite = std::make_unique<EigenImplementation>();
        this->Indefinite->Analyze(A);
        this->Indefinite->Factor(A, precision, threads);
      }
    }
    catch (const std::bad_alloc&)
    {
      throw SolverError("not enough memory to factor the system matrix");
    }
  }

  void Solve(RightHandSides& B, int threads) const override
  {
    if (this->Indefinite)
    {
      this->Indefinite->Solve(B, threads);
      return;
    }
    this->Used == Precision::Single ? this->Single.Solve(B, threads)
                                    : this->Double.Solve(B, threads);
  }
  Precision GetPrecision() const override { return this->Used; }
  double GetError() const override { return this->Error; }
  bool IsDefinite() const override { return !this->Indefinite || this->Indefinite->IsDefinite(); }

private:
  /// In single precision if that will do. False if A is not positive definite.
  bool FactorIn(const Matrix& A, int threads)
  {
    if (this->Used == Precision::Single)
    {
      if (!this->FactorTo(this->Single, A, threads))
      {
        return false;
      }
      this->Error = ErrorOf(this->Single, A, threads);
      if (this->Error <= LargestError)
      {
        return true;
      }
      this->Single = {};
      this->Error = 0.0;
      this->Used = Precision::Double;
    }
    return this->FactorTo(this->Double, A, threads);
  }

  template <typename Scalar>
  bool FactorTo(PackedFactor<Scalar>& factor, const Matrix& A, int threads) const
  {
    factor = PackedFactor<Scalar>(this->Pattern);
    return MultifrontalCholesky(A, this->Pattern, factor.GetTasks(), threads,
      [&factor](int s, const double* panel) { factor.Set(s, panel); });
  }

  SupernodalPattern Pattern;
  PackedFactor<double> Double; // one of the two
  PackedFactor<float> Single;
  Precision Used = Precision::Double;
  double Error = 0.0;
  std::unique_ptr<EigenImplementation> Indefinite; // set when the matrix is not positive definite
};

//------------------------------------------------------------------------------------------------
SparseCholesky::SparseCholesky(Backend backend)
{
  if (backend == Backend::Multifrontal)
  {
    this->Impl = std::make_unique<MultifrontalImplementation>();
  }
  else
  {
    this->Impl = std::make_unique<EigenImplementation>();
  }
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

const char* SparseCholesky::GetName() const
{
  return this->Impl->GetName();
}

void SparseCholesky::Analyze(const Matrix& A)
{
  this->Impl->Analyze(A);
}

double SparseCholesky::GetFactorBytes() const
{
  return this->Impl->GetFactorBytes();
}

void SparseCholesky::Factor(const Matrix& A, Precision precision, int threads)
{
  this->Impl->Factor(A, precision, threads);
}

SparseCholesky::Precision SparseCholesky::GetPrecision() const
{
  return this->Impl->GetPrecision();
}

double SparseCholesky::GetError() const
{
  return this->Impl->GetError();
}

bool SparseCholesky::IsDefinite() const
{
  return this->Impl->IsDefinite();
}

void SparseCholesky::Solve(RightHandSides& B, int threads) const
{
  this->Impl->Solve(B, threads);
  if (!B.allFinite())
  {
    throw SolverError(
      "the system matrix is singular to machine precision: its solution is not finite");
  }
}
} // namespace SphericalStyle
