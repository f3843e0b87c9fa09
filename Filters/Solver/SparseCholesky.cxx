// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SparseCholesky.h"

#include "PackedFactor.h"
#include "TriangleMesh.h"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <cstdint>
#include <mutex>
#include <new>
#include <random>

#ifdef SPHERICALSTYLE_WITH_CHOLMOD
#include <cholmod.h>
#include <sys/mman.h>
#include <unistd.h>

// Present when the BLAS behind CHOLMOD is OpenBLAS, absent otherwise.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));
extern "C" int openblas_get_num_threads() __attribute__((weak));
// Present when CHOLMOD was built with OpenMP.
extern "C" void omp_set_max_active_levels(int) __attribute__((weak));
extern "C" int omp_get_max_active_levels() __attribute__((weak));
#endif

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
  void Solve(RightHandSides& B, int) const override { B = this->Ldlt.solve(B).eval(); }

private:
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> Ldlt;
};

#ifdef SPHERICALSTYLE_WITH_CHOLMOD
//------------------------------------------------------------------------------------------------
namespace
{
/// One BLAS thread while any of these is in scope: the blocks of these factors are small, and the
/// order of additions must not depend on the machine. Several threads may factor at once. No OpenMP
/// threads either: where the system has none to give, OpenMP ends the process.
class SingleThreadedBlas
{
public:
  SingleThreadedBlas()
  {
    if (omp_get_max_active_levels && omp_set_max_active_levels)
    {
      this->LevelsBefore = omp_get_max_active_levels();
      omp_set_max_active_levels(0);
    }
    const std::lock_guard<std::mutex> lock(Guard);
    if (Scopes++ == 0 && openblas_get_num_threads && openblas_set_num_threads)
    {
      Before = openblas_get_num_threads();
      openblas_set_num_threads(1);
    }
  }
  ~SingleThreadedBlas()
  {
    if (this->LevelsBefore >= 0)
    {
      omp_set_max_active_levels(this->LevelsBefore);
    }
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
  int LevelsBefore = -1; // OpenMP keeps it per thread
};

/// OpenBLAS waits forever for its buffer of 128 MB if there is no room for it: asks first. Memory
/// that nobody touches costs nothing. @throw std::bad_alloc
void RequireRoomForBlas()
{
  constexpr std::size_t room = std::size_t(160) << 20;
  if (openblas_set_num_threads)
  {
    ::operator delete(::operator new(room));
  }
}

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

/// Gives the whole pages of an array back to the system; they read as zeros from then on.
void ReleasePages(const double* begin, const double* end)
{
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
  const auto last = reinterpret_cast<std::uintptr_t>(end) / page * page;
  if (first < last)
  {
    madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
  }
}

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
    if (this->Indefinite)
    {
      return this->Indefinite->GetName();
    }
    return this->Used == Precision::Single ? "CHOLMOD supernodal LLT in single precision"
                                           : "CHOLMOD supernodal LLT";
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

  double GetFactorBytes() const override
  {
    return sizeof(double) * static_cast<double>(this->Cholesky->xsize);
  }

  void Factor(const Matrix& A, Precision precision, int threads) override
  {
    const SingleThreadedBlas scope;
    RequireRoomForBlas();
    cholmod_sparse view = View(A);
    this->Indefinite.reset();
    this->Double = {}; // their memory is needed
    this->Single = {};
    this->Used = Precision::Double;
    this->Error = 0.0;
    cholmod_factorize(&view, this->Cholesky, &this->Common);
    if (this->Common.status == CHOLMOD_NOT_POSDEF)
    {
      this->Indefinite = std::make_unique<EigenImplementation>();
      this->Indefinite->Analyze(A);
      this->Indefinite->Factor(A, precision, threads);
    }
    else if (this->Common.status < CHOLMOD_OK)
    {
      throw SolverError("not enough memory to factor the system matrix");
    }
    else
    {
      this->Pack(A, precision, threads);
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
    this->Used == Precision::Single ? this->Single.Solve(B, threads)
                                    : this->Double.Solve(B, threads);
  }
  Precision GetPrecision() const override { return this->Used; }
  double GetError() const override { return this->Error; }

private:
  /// Copies the factor in the precision asked for, if that will do. Memory is given back as it is
  /// copied, so that there is never more than one factor.
  void Pack(const Matrix& A, Precision precision, int threads)
  {
    if (precision == Precision::Single)
    {
      this->Single = PackedFactor<float>(this->ViewFactor(), threads, ReleasePages);
      this->Error = ErrorOf(this->Single, A, threads);
      if (this->Error <= LargestError)
      {
        this->Used = Precision::Single;
        return;
      }
      this->Single = {};
      this->Error = 0.0;
      cholmod_sparse view = View(A);
      cholmod_factorize(&view, this->Cholesky, &this->Common);
    }
    this->Double = PackedFactor<double>(this->ViewFactor(), threads, ReleasePages);
  }

  SupernodalFactor ViewFactor() const
  {
    const cholmod_factor& L = *this->Cholesky;
    const auto ints = [](void* p) { return static_cast<const int*>(p); };
    return { static_cast<int>(L.n), static_cast<int>(L.nsuper), ints(L.super), ints(L.pi),
      ints(L.s), ints(L.px), static_cast<const double*>(L.x), ints(L.Perm) };
  }

  cholmod_common Common = {};
  cholmod_factor* Cholesky = nullptr;
  PackedFactor<double> Double; // one of the two
  PackedFactor<float> Single;
  Precision Used = Precision::Double;
  double Error = 0.0;
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
