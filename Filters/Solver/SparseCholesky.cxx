// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SparseCholesky.h"

#include "PackedFactor.h"
#include "TriangleMesh.h"

#include <Eigen/SparseCholesky>

#include <mutex>

#ifdef SPHERICALSTYLE_WITH_CHOLMOD
#include <cholmod.h>

// Present when the BLAS behind CHOLMOD is OpenBLAS, absent otherwise.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));
extern "C" int openblas_get_num_threads() __attribute__((weak));
#endif

namespace SphericalStyle
{
class SparseCholesky::Implementation
{
public:
  virtual ~Implementation() = default;
  virtual const char* GetName() const = 0;
  virtual void Analyze(const Matrix& A) = 0;
  virtual void Factor(const Matrix& A, int threads) = 0;
  virtual void Solve(RightHandSides& B, int threads) const = 0;
};

//------------------------------------------------------------------------------------------------
class SparseCholesky::EigenImplementation : public SparseCholesky::Implementation
{
public:
  const char* GetName() const override { return "Eigen LDLT"; }
  void Analyze(const Matrix& A) override { this->Ldlt.analyzePattern(A); }
  void Factor(const Matrix& A, int) override
  {
    this->Ldlt.factorize(A);
    if (this->Ldlt.info() != Eigen::Success)
    {
      throw SolverError("the system matrix is singular: it cannot be factored");
    }
  }
  void Solve(RightHandSides& B, int) const override { B = this->Ldlt.solve(B).eval(); }

private:
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> Ldlt;
};

#ifdef SPHERICALSTYLE_WITH_CHOLMOD
//------------------------------------------------------------------------------------------------
namespace
{
/// One BLAS thread while any of these is in scope: the blocks of these factors are small, and the
/// order of additions must not depend on the machine. Several threads may factor at once.
class SingleThreadedBlas
{
public:
  SingleThreadedBlas()
  {
    const std::lock_guard<std::mutex> lock(Guard);
    if (Scopes++ == 0 && openblas_get_num_threads && openblas_set_num_threads)
    {
      Before = openblas_get_num_threads();
      openblas_set_num_threads(1);
    }
  }
  ~SingleThreadedBlas()
  {
    const std::lock_guard<std::mutex> lock(Guard);
    if (--Scopes == 0 && Before > 0)
    {
      openblas_set_num_threads(Before);
    }
  }
  SingleThreadedBlas(const SingleThreadedBlas&) = delete;
  SingleThreadedBlas& operator=(const SingleThreadedBlas&) = delete;

private:
  static inline std::mutex Guard;
  static inline int Scopes = 0;
  static inline int Before = 0;
};

/// A view of an Eigen matrix, nothing is copied.
cholmod_sparse View(const SparseCholesky::Matrix& A)
{
  cholmod_sparse view = {};
  view.nrow = static_cast<std::size_t>(A.rows());
  view.ncol = static_cast<std::size_t>(A.cols());
  view.nzmax = static_cast<std::size_t>(A.nonZeros());
  view.p = const_cast<int*>(A.outerIndexPtr());
  view.i = const_cast<int*>(A.innerIndexPtr());
  view.x = const_cast<double*>(A.valuePtr());
  view.stype = -1; // lower triangle
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}
}

class SparseCholesky::CholmodImplementation : public SparseCholesky::Implementation
{
public:
  CholmodImplementation()
  {
    cholmod_start(&this->Common);
    this->Common.print = 0;
    this->Common.supernodal = CHOLMOD_SUPERNODAL;
    this->Common.nmethods = 1;
    this->Common.method[0].ordering = CHOLMOD_AMD;
    this->Common.postorder = 1;
  }
  ~CholmodImplementation() override
  {
    cholmod_free_factor(&this->Cholesky, &this->Common);
    cholmod_finish(&this->Common);
  }
  CholmodImplementation(const CholmodImplementation&) = delete;
  CholmodImplementation& operator=(const CholmodImplementation&) = delete;

  const char* GetName() const override
  {
    return this->Indefinite ? this->Indefinite->GetName() : "CHOLMOD supernodal LLT";
  }

  void Analyze(const Matrix& A) override
  {
    const SingleThreadedBlas scope;
    cholmod_free_factor(&this->Cholesky, &this->Common);
    this->Indefinite.reset();
    cholmod_sparse view = View(A);
    this->Cholesky = cholmod_analyze(&view, &this->Common);
    if (!this->Cholesky)
    {
      throw SolverError("not enough memory to order the system matrix");
    }
  }

  void Factor(const Matrix& A, int threads) override
  {
    const SingleThreadedBlas scope;
    cholmod_sparse view = View(A);
    this->Indefinite.reset();
    this->Packed = {}; // its memory is needed
    cholmod_factorize(&view, this->Cholesky, &this->Common);
    if (this->Common.status == CHOLMOD_NOT_POSDEF)
    {
      this->Indefinite = std::make_unique<EigenImplementation>();
      this->Indefinite->Analyze(A);
      this->Indefinite->Factor(A, threads);
    }
    else if (this->Common.status < CHOLMOD_OK)
    {
      throw SolverError("not enough memory to factor the system matrix");
    }
    else
    {
      this->Packed = PackedFactor<double>(this->ViewFactor(), threads);
    }
    // Solves need the values no more; ordering and symbolic factor stay.
    cholmod_change_factor(CHOLMOD_PATTERN, 1, 1, 1, 1, this->Cholesky, &this->Common);
  }

  void Solve(RightHandSides& B, int threads) const override
  {
    if (this->Indefinite)
    {
      this->Indefinite->Solve(B, threads);
      return;
    }
    this->Packed.Solve(B, threads);
  }

private:
  SupernodalFactor ViewFactor() const
  {
    const cholmod_factor& L = *this->Cholesky;
    const auto ints = [](void* p) { return static_cast<const int*>(p); };
    return { static_cast<int>(L.n), static_cast<int>(L.nsuper), ints(L.super), ints(L.pi),
      ints(L.s), ints(L.px), static_cast<const double*>(L.x), ints(L.Perm) };
  }

  cholmod_common Common = {};
  cholmod_factor* Cholesky = nullptr;
  PackedFactor<double> Packed;
  std::unique_ptr<EigenImplementation> Indefinite; // set when the matrix is not positive definite
};
#endif

//------------------------------------------------------------------------------------------------
bool SparseCholesky::HasCholmod()
{
#ifdef SPHERICALSTYLE_WITH_CHOLMOD
  return true;
#else
  return false;
#endif
}

SparseCholesky::SparseCholesky(Backend backend)
{
  if (backend == Backend::Cholmod && !HasCholmod())
  {
    throw std::invalid_argument("CHOLMOD was not built in");
  }
#ifdef SPHERICALSTYLE_WITH_CHOLMOD
  if (backend != Backend::Eigen)
  {
    this->Impl = std::make_unique<CholmodImplementation>();
    return;
  }
#endif
  this->Impl = std::make_unique<EigenImplementation>();
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

void SparseCholesky::Factor(const Matrix& A, int threads)
{
  this->Impl->Factor(A, threads);
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
