// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Smooth fields on a surface, on a regular grid of B-splines that does not know the triangles
/// [grid].
#ifndef SphericalStyle_SurfaceGrid_h
#define SphericalStyle_SurfaceGrid_h

#include "SparseCholesky.h"
#include "SurfacePart.h"

#include <array>

namespace SphericalStyle
{
/// One row per point, sample or function.
using Fields = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Two places whose values are held together, see SurfaceGrid::Factor.
struct GridPair
{
  Eigen::Vector3d u;
  Eigen::Vector3d v;
  double weight; ///< no unit, as half a cotangent
};

/// Quadratic B-splines phi_g on a regular grid of spacing h = s / 1.5, restricted to a surface
/// (Chuang, Luo, Brown, Rusinkiewicz, Kazhdan, Estimating the Laplace-Beltrami operator by
/// restricting 3D functions, Symposium on Geometry Processing 2009). Cells are those cubes of edge
/// h in which one set of 27 functions is not 0; cells with a sample are active, and only functions
/// of active cells count: their number depends on the area and on s, and not on the triangles. A
/// field is 0 at places in other cells.
///
/// Splat: integrals over the surface are sums over quadrature points, weighted 3/4 at the centroid
/// and 1/12 at each corner of a triangle; triangles longer than .75 h are cut evenly before. What
/// lies in one sub-cell, a 27th of a cell, is added up to one sample k, so that what follows does
/// not depend on the number of triangles: with q the quadrature points in the sub-cell, w_q their
/// areas, n_q their normals,
///
///     w_k = sum w_q,   x_k = sum w_q x_q / w_k,   N_k = sum w_q n_q,   Q_k = sum w_q (I - n_q
///     n_q^T).
///
/// A triangle no longer than h / 6 with its corners in one cell counts with its centroid alone.
///
/// Solve: with M = sum w_k phi phi^T and K = sum grad phi^T Q_k grad phi, both at x_k,
///
///     A_s = M + s^2 (K + .1 N) + 1e-7 mean(diag) I,      Smooth(X) = A_s^-1 sum w_k phi(x_k) X_k,
///     N = sum over cells of the mean in the cell of grad phi^T (sum w_k I - Q_k) grad phi.
///
/// N is the slope across the surface, all over a cell. On a surface alone it says next to nothing,
/// since a field can go on straight outward; but two sheets within a cell of each other move
/// together with it, wherever the borders of samples and cells are (normal derivative volume
/// stabilization: Grande, Lehrenfeld, Reusken, Analysis of a high-order trace finite element method
/// for PDEs on level set surfaces, SIAM Journal on Numerical Analysis 56(1), 2018).
///
/// Sample: a field is the sum of 27 products at any place near the surface.
///
/// Of a surface that is spread over processes each cuts its own triangles; samples are added up
/// over the processes, in their order, so that grid, samples, matrix and coefficients are the same
/// on all of them, and points are those of this process alone. The constructor, Means and Gradients
/// are to be called by all processes.
///
/// The origin, the middle of the bounds of a mesh in its Frame, is the middle of a cell and of a
/// sub-cell: a mirror image gets the mirrored grid. Results have the same bits for any number of
/// threads.
///
/// Processes send 20 numbers a sample to build a grid, and the rows of Means and Gradients.
///
/// Cost: one pass over the triangles; then for G functions (about 10 area / h^2) their factor,
/// about G^1.5, and about 45 bytes a point, 9 bytes for each cell of the box, of which there are at
/// most 4e7.
class SurfaceGrid
{
public:
  /// Most functions; beyond, the spacing grows until there are no more. Their factor takes about 2
  /// s and 1 GB.
  static constexpr int MaximumNumberOfFunctions = 60000;
  /// s / h
  static constexpr double SpacingsPerSize = 1.5;

  SurfaceGrid() = default;
  /// Splats the triangles. @param P  n x 3, in the frame @param F  m x 3, m > 0; those without area
  /// do not count
  /// @param size  s, above 0; fraction of the diagonal, as the frame's is 1
  SurfaceGrid(
    const Points& P, const Triangles& F, double size, int threads, const SurfacePart& part = {});

  /// The same grid with no other samples than these, and the functions that count there: for fields
  /// on a part of the surface, to factor and solve for, and to have at its samples. Knows no points
  /// and no factor.
  /// @param samples  ascending, some @return one whose sample i is samples[i]
  SurfaceGrid At(const std::vector<int>& samples) const;

  /// A_s, and its factor. The ridge is that of the sum without pairs. @param pairs  no more than
  /// three cells apart; those of the same two different cells count as one at their mean places.
  /// Each adds s^2 weight (phi(u) - phi(v)) (phi(u) - phi(v))^T [wall]; one with an end in a cell
  /// without samples does not count
  /// @throw SolverError
  void Factor(const std::vector<GridPair>& pairs, int threads);
  /// The same without N and pairs: nothing goes from one sheet to another through the air.
  /// @throw SolverError
  void FactorAlong(int threads);
  /// The same for K + 1e-6 M, to integrate gradients.
  void FactorPoisson(int threads);
  /// The same for sum kappa_k grad phi^T Q_k grad phi + mass M, where the surface conducts
  /// unevenly.
  /// @param conductivity  kappa_k of the samples, at least 0, no unit @param mass  above 0, 1 /
  /// length^2
  void FactorConduction(const Eigen::VectorXd& conductivity, double mass, int threads);

  double GetSize() const { return this->Size; }
  double GetSpacing() const { return this->Spacing; }
  /// Whether the spacing is larger than s / 1.5, for there would be too many functions or parts of
  /// triangles.
  bool IsCoarser() const { return this->Spacing > this->Size / SpacingsPerSize * (1.0 + 1e-12); }
  int GetNumberOfFunctions() const { return this->NumberOfFunctions; }
  int GetNumberOfSamples() const { return static_cast<int>(this->Weights.size()); }
  const Eigen::VectorXd& GetWeights() const { return this->Weights; } ///< w_k, area
  const Points& GetPlaces() const { return this->Places; }            ///< x_k
  const Points& GetAreaVectors() const { return this->AreaVectors; }  ///< N_k
  /// Mean of (x_q - x_k)(x_q - x_k)^T in a sample.
  const std::vector<Eigen::Matrix3d>& GetSpreads() const { return this->Spreads; }

  /// Means over each sample of a field that is linear on each triangle. @param X  n x c @return
  /// samples x c
  Fields Means(const Fields& X, int threads) const;
  /// Means of its gradient along the surface, dX_a / dx_b at 3 a + b. @param X  n x 3 @return
  /// samples x 9
  Fields Gradients(const Points& X, int threads) const;
  /// What becomes of the area vectors N_k where these are the gradients: |N_k| (G u) x (G v), u and
  /// v at right angles to N_k and to each other. @param gradients  samples x 9 @return samples x 3
  Points AreaVectorsUnder(const Fields& gradients, int threads) const;
  /// Lets go of what Means and Gradients need; they must not be called any more.
  void ForgetPoints();
  /// Coefficients of the field nearest to X. @param X  samples x c @return functions x c
  Fields Smooth(const Fields& X, int threads) const;
  /// The same of what one step has made of X: two implicit steps.
  Fields SmoothTwice(const Fields& X, int threads) const;
  /// The same for any right-hand side sum_k (w_k phi X_k + grad phi . Y_k); Y may have no rows.
  /// @param Y  samples x 3 c, the vector of component j at 3 j
  Fields Solve(const Fields& X, const Fields& Y, int threads) const;
  /// The field at the samples, or at places beside them as what it is in their cells, samples x c.
  /// @param offset  from x_k, in units of a cell
  Fields AtSamples(const Fields& coefficients, int threads,
    const Eigen::Vector3d& offset = Eigen::Vector3d::Zero()) const;
  /// The field at points of the surface. @param x  n x 3 @return n x c
  Fields AtPoints(const Fields& coefficients, const Points& x, int threads) const;

private:
  class Splatter;
  struct Place;    // of a point in the grid
  struct CellPair; // of pairs

  Place Locate(const Eigen::RowVector3d& x) const;
  const int* FunctionsAt(const Place& place) const;
  void NumberFunctions(const std::vector<int>& cells);
  /// @param stiffness  of the samples @param across  factor of N
  SparseCholesky::Matrix Assemble(
    double mass, const Eigen::VectorXd& stiffness, double across, int threads) const;
  std::vector<CellPair> CellPairs(const std::vector<GridPair>& pairs) const;
  void AddPairs(const std::vector<GridPair>& pairs, SparseCholesky::Matrix& A) const;
  /// @param locate  gives the functions at place i, or nullptr, and where it is in their cell
  template <typename Placing>
  Fields Evaluate(const Fields& coefficients, int count, const Placing& locate, int threads) const;

  SurfacePart Everybody; // the processes
  double Size = 0.0;
  double Spacing = 0.0;
  double PerSpacing = 0.0;
  std::array<int, 3> Half = {}; // cells on each side of the one in the middle
  std::vector<int> CellOfBox;   // active cell of each cell of the box, or -1
  std::vector<int> Functions;   // 27 of each active cell
  int NumberOfFunctions = 0;

  std::vector<int> FirstSample; // of each active cell, and one past the last
  Points Locals;                // x_k in its cell, 0..1
  Eigen::VectorXd Weights;
  Points Places;
  Points AreaVectors;
  Fields Tangents; // Q_k: xx, xy, xz, yy, yz, zz
  std::vector<Eigen::Matrix3d> Spreads;
  // What each point adds to a sample: W and the gradients of its hat function.
  std::vector<int> FirstEntry;
  std::vector<int> EntryPoints;
  std::vector<double> Entries; // 4 each: share of the area, then the integral of the gradient
  SparseCholesky System;
};
} // namespace SphericalStyle

#endif
