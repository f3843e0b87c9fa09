// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A quicker linear solver for CGAL's Surface_mesh_deformation than the SparseLU that it takes by
/// itself.
#ifndef SphericalStyle_ConstrainedCholesky_h
#define SphericalStyle_ConstrainedCholesky_h

#include <CGAL/Eigen_matrix.h>
#include <CGAL/Eigen_vector.h>
#include <Eigen/SparseCore>

#include <vector>

/// Model of CGAL's SparseLinearAlgebraWithFactorTraits_d. CGAL's matrix is symmetric but for the
/// rows of handles, which are those of the identity; their columns go to the right-hand side, so
/// that the rest can be factored by Cholesky.
/// @tparam Cholesky  factors a symmetric Eigen::SparseMatrix from its lower triangle
template <typename Cholesky>
class ConstrainedCholesky
{
public:
  using NT = double;
  using Matrix = CGAL::Eigen_sparse_matrix<double>;
  using Vector = CGAL::Eigen_vector<double>;
  using Index = Eigen::Index;

  bool factor(const Matrix& matrix, NT& denominator)
  {
    denominator = 1.0;
    const auto& A = matrix.eigen_object();
    this->NumberRows(A);
    std::vector<Eigen::Triplet<double>> free;
    std::vector<Eigen::Triplet<double>> coupling;
    for (int column = 0; column < A.outerSize(); ++column)
    {
      for (Iterator entry(A, column); entry; ++entry)
      {
        const int row = this->Rows[entry.row()];
        const int other = this->Rows[entry.col()];
        if (row >= 0 && other < 0)
        {
          coupling.emplace_back(row, static_cast<int>(entry.col()), entry.value());
        }
        else if (row >= other && other >= 0)
        {
          free.emplace_back(row, other, entry.value());
        }
      }
    }
    this->Coupling.resize(this->Free.size(), A.cols());
    this->Coupling.setFromTriplets(coupling.begin(), coupling.end());
    Sparse lower(this->Free.size(), this->Free.size());
    lower.setFromTriplets(free.begin(), free.end());
    this->Factor.compute(lower);
    return this->Factor.info() == Eigen::Success;
  }

  bool linear_solver(const Vector& b, Vector& x)
  {
    const Eigen::VectorXd& all = b.eigen_object();
    const Eigen::VectorXd free = all(this->Free);
    const Eigen::VectorXd solved = this->Factor.solve(free - this->Coupling * all);
    for (Index i = 0; i < all.size(); ++i)
    {
      x.set(i, this->Rows[i] >= 0 ? solved[this->Rows[i]] : all[i]);
    }
    return this->Factor.info() == Eigen::Success;
  }

private:
  using Sparse = Eigen::SparseMatrix<double>;
  using Iterator = typename Matrix::EigenType::InnerIterator;

  /// Rows of handles have a diagonal and nothing else.
  void NumberRows(const typename Matrix::EigenType& A)
  {
    std::vector<int> entries(A.rows(), 0);
    for (int column = 0; column < A.outerSize(); ++column)
    {
      for (Iterator entry(A, column); entry; ++entry)
      {
        ++entries[entry.row()];
      }
    }
    this->Rows.assign(A.rows(), -1);
    this->Free.clear();
    for (int i = 0; i < A.rows(); ++i)
    {
      if (entries[i] > 1)
      {
        this->Rows[i] = static_cast<int>(this->Free.size());
        this->Free.push_back(i);
      }
    }
  }

  std::vector<int> Rows; // of the factored matrix, -1 for a handle
  std::vector<int> Free;
  Sparse Coupling;
  Cholesky Factor;
};

#endif
