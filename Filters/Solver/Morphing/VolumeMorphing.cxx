// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeMorphing.h"

#include "Frame.h"
#include "LinearSystem.h"
#include "Parallel.h"
#include "UntanglingEnergy.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace SphericalStyle
{
namespace
{
using System = LinearSystem::Matrix;

constexpr int MostSteps = 100;
/// Where the energy could fall by this share of what it is above its minimum without a boundary,
/// the next step would not be seen.
constexpr double Converged = 1e-3;
/// The same of the volume, for motions that are rigid up to rounding.
constexpr double Nothing = 1e-22;
constexpr double Rounding = 1e-14; // of a sum of energies
constexpr double SmallestEpsilon = 1e-9;
/// Corners that are flatter at rest than this, in units of the best one, are to become the best.
constexpr double FlatCorner = 1e-6;

/// A corner of a cell as a linear element: J = sum over k of x_k gradient_k^T.
struct Element
{
  CellCorner points;                     ///< of the mesh
  Eigen::Matrix<double, 4, 3> gradients; ///< of the four hat functions, 1 / length
  double weight = 0.0;                   ///< volume
};

/// @param P  of the mesh, in the frame
std::vector<Element> MakeElements(const VolumeMesh& mesh, const Points& P)
{
  std::vector<Element> elements;
  for (int cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    const int* ids = mesh.PointsOf(cell);
    const CellShape shape = mesh.Shapes[cell];
    const std::vector<CellCorner>& corners = CornersOf(shape);
    // A tetrahedron is the same at each of its corners.
    const std::size_t count = shape == CellShape::Tetrahedron ? 1 : corners.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      Element element;
      Eigen::Matrix3d edges;
      for (int j = 0; j < 4; ++j)
      {
        element.points[j] = ids[corners[k][j]];
      }
      for (int j = 0; j < 3; ++j)
      {
        edges.col(j) = (P.row(element.points[j + 1]) - P.row(element.points[0])).transpose();
      }
      const Eigen::RowVector3d lengths = edges.colwise().norm();
      if (!(lengths.minCoeff() > 0.0))
      {
        continue; // an edge without a length, as in a hexahedron that is a wedge
      }
      if (!(edges.determinant() > FlatCorner * BestDeterminant(shape) * lengths.prod()))
      {
        edges = std::cbrt(lengths.prod()) * BestCorner(shape);
      }
      const Eigen::Matrix3d inverse = edges.inverse();
      element.gradients << -inverse.colwise().sum(), inverse;
      element.weight = edges.determinant() / 6.0;
      elements.push_back(element);
    }
  }
  return elements;
}

Eigen::Matrix3d JacobianOf(const Element& element, const Points& P)
{
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 4; ++k)
  {
    J += P.row(element.points[k]).transpose() * element.gradients.row(k);
  }
  return J;
}

/// Numbers of the points that move, in order; -1 for the others.
std::vector<int> NumberUnknowns(
  const std::vector<Element>& elements, const std::vector<char>& isFixed)
{
  std::vector<char> used(isFixed.size(), 0);
  for (const Element& element : elements)
  {
    for (const int i : element.points)
    {
      used[i] = 1;
    }
  }
  std::vector<int> unknowns(isFixed.size(), -1);
  int count = 0;
  for (std::size_t i = 0; i < isFixed.size(); ++i)
  {
    if (used[i] && !isFixed[i])
    {
      unknowns[i] = count++;
    }
  }
  return unknowns;
}

int CountOf(const std::vector<int>& unknowns)
{
  return static_cast<int>(
    std::count_if(unknowns.begin(), unknowns.end(), [](int u) { return u >= 0; }));
}

/// The lower triangle of a symmetric matrix of blocks, one block row for each point that moves, and
/// where in it the blocks of an element are.
class BlockMatrix
{
public:
  /// @param size  rows of a block
  BlockMatrix(int size, const std::vector<Element>& elements, const std::vector<int>& unknowns)
    : Size(size)
    , Elements(&elements)
    , Unknowns(&unknowns)
  {
    const int n = CountOf(unknowns);
    this->Below.resize(n);
    this->ForPairs([this](int row, int column) { this->Below[column].push_back(row); });
    Eigen::VectorXi counts(size * n);
    for (int j = 0; j < n; ++j)
    {
      std::vector<int>& rows = this->Below[j];
      std::sort(rows.begin(), rows.end());
      rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
      for (int b = 0; b < size; ++b)
      {
        counts[size * j + b] = size - b + size * static_cast<int>(rows.size());
      }
    }
    this->Values.resize(size * n, size * n);
    this->Values.reserve(counts);
    for (int j = 0; j < n; ++j)
    {
      for (int b = 0; b < size; ++b)
      {
        for (int a = b; a < size; ++a)
        {
          this->Values.insert(size * j + a, size * j + b) = 0.0;
        }
        for (const int row : this->Below[j])
        {
          for (int a = 0; a < size; ++a)
          {
            this->Values.insert(size * row + a, size * j + b) = 0.0;
          }
        }
      }
    }
    this->Values.makeCompressed();
  }

  System& Get() { return this->Values; }
  void SetZero() { std::fill_n(this->Values.valuePtr(), this->Values.nonZeros(), 0.0); }

  /// Adds the matrix of an element, (4 Size) x (4 Size), of which the lower triangle counts.
  template <typename Derived>
  void Add(const Element& element, const Eigen::MatrixBase<Derived>& H)
  {
    for (int k = 0; k < 4; ++k)
    {
      for (int l = 0; l <= k; ++l)
      {
        const int row = (*this->Unknowns)[element.points[k]];
        const int column = (*this->Unknowns)[element.points[l]];
        if (row >= 0 && column >= 0)
        {
          this->AddBlock(
            row, column, H.block(this->Size * k, this->Size * l, this->Size, this->Size));
        }
      }
    }
  }

private:
  /// Calls body(row, column), row > column, for pairs of unknowns that share an element.
  template <typename Body>
  void ForPairs(const Body& body)
  {
    for (const Element& element : *this->Elements)
    {
      for (const int i : element.points)
      {
        for (const int j : element.points)
        {
          const int row = (*this->Unknowns)[i];
          const int column = (*this->Unknowns)[j];
          if (column >= 0 && row > column)
          {
            body(row, column);
          }
        }
      }
    }
  }

  template <typename Derived>
  void AddBlock(int row, int column, const Eigen::MatrixBase<Derived>& block)
  {
    const bool turned = row < column;
    const int low = std::min(row, column);
    const int high = std::max(row, column);
    const int* starts = this->Values.outerIndexPtr();
    double* values = this->Values.valuePtr();
    const std::vector<int>& rows = this->Below[low];
    const auto place = low == high ? 0
                                   : this->Size *
        static_cast<int>(std::lower_bound(rows.begin(), rows.end(), high) - rows.begin());
    for (int b = 0; b < this->Size; ++b)
    {
      double* column0 = values + starts[this->Size * low + b];
      if (low == high)
      {
        for (int a = b; a < this->Size; ++a)
        {
          column0[a - b] += block(a, b);
        }
        continue;
      }
      for (int a = 0; a < this->Size; ++a)
      {
        column0[this->Size - b + place + a] += turned ? block(b, a) : block(a, b);
      }
    }
  }

  int Size;
  const std::vector<Element>* Elements;
  const std::vector<int>* Unknowns;
  std::vector<std::vector<int>> Below; // of each column, the block rows below the diagonal
  System Values;
};

/// Displacements of the unknowns, in the frame.
void ExtendHarmonically(
  const std::vector<Element>& elements, const std::vector<int>& unknowns, Points& U, int threads)
{
  BlockMatrix K(1, elements, unknowns);
  LinearSystem::RightHandSides right = LinearSystem::RightHandSides::Zero(K.Get().rows(), 3);
  for (const Element& element : elements)
  {
    const Eigen::Matrix4d stiffness =
      element.weight * element.gradients * element.gradients.transpose();
    K.Add(element, stiffness);
    for (int k = 0; k < 4; ++k)
    {
      for (int l = 0; l < 4; ++l)
      {
        const int row = unknowns[element.points[k]];
        if (row >= 0 && unknowns[element.points[l]] < 0)
        {
          right.row(row) -= stiffness(k, l) * U.row(element.points[l]);
        }
      }
    }
  }
  LinearSystem system;
  system.SetShareLeft(1e-12);
  system.Analyze(K.Get());
  system.Factor(K.Get(), threads);
  LinearSystem::RightHandSides solution = LinearSystem::RightHandSides::Zero(right.rows(), 3);
  system.Solve(right, solution, threads);
  for (std::size_t i = 0; i < unknowns.size(); ++i)
  {
    if (unknowns[i] >= 0)
    {
      U.row(static_cast<Eigen::Index>(i)) = solution.row(unknowns[i]);
    }
  }
}

/// Newton's method. Points are in the frame.
class Untangling
{
public:
  Untangling(const std::vector<Element>& elements, const std::vector<int>& unknowns, int threads)
    : Elements(elements)
    , Unknowns(unknowns)
    , Threads(threads)
    , Hessian(3, elements, unknowns)
  {
    this->System.Analyze(this->Hessian.Get());
  }

  /// @return the number of steps
  int Run(Points& P, const Callback& callback)
  {
    const double weight = std::accumulate(this->Elements.begin(), this->Elements.end(), 0.0,
      [](double sum, const Element& element) { return sum + element.weight; });
    const double bottom = 5.0 * weight;
    double smallest = this->SmallestDeterminant(P);
    this->Epsilon = smallest > 0.0 ? SmallestEpsilon : 1.0;
    int step = 0;
    while (step < MostSteps)
    {
      const double before = this->Energy(P);
      const double start = std::max(before - bottom, 0.0);
      this->Direct(P);
      const double slope = this->Gradient.cwiseProduct(this->Direction).sum();
      const bool moved = this->Search(P, before, slope, smallest > 0.0);
      smallest = this->SmallestDeterminant(P);
      ++step;
      if (callback && !callback(step, slope / std::max(start, 1e-300)))
      {
        throw SolveAborted();
      }
      const bool small = -slope <= std::max(Converged * start, Nothing * weight);
      if (this->Epsilon <= SmallestEpsilon && (small || !moved))
      {
        break;
      }
      this->Sharpen(before, this->Energy(P), smallest);
    }
    return step;
  }

private:
  double Energy(const Points& P) const
  {
    return ParallelSum(static_cast<int>(this->Elements.size()), this->Threads,
      [&](int begin, int end)
      {
        double sum = 0.0;
        for (int e = begin; e < end; ++e)
        {
          sum += this->Elements[e].weight *
            UntanglingEnergy(JacobianOf(this->Elements[e], P), this->Epsilon);
        }
        return sum;
      });
  }

  double SmallestDeterminant(const Points& P) const
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Element& element : this->Elements)
    {
      smallest = std::min(smallest, JacobianOf(element, P).determinant());
    }
    return smallest;
  }

  /// The schedule of the source: an epsilon at which the next energy is no larger than what the
  /// last step has come to, so that it gets to the smallest one in finitely many steps.
  void Sharpen(double before, double after, double smallest)
  {
    const double sigma = std::max(1.0 - after / before, 0.1);
    const double mu = (1.0 - sigma) * RegularizedDeterminant(smallest, this->Epsilon);
    this->Epsilon = smallest < mu ? std::max(SmallestEpsilon, 2.0 * std::sqrt(mu * (mu - smallest)))
                                  : SmallestEpsilon;
  }

  /// Sets Gradient and Direction = -H^-1 Gradient, H the second derivative with its eigenvalues
  /// made positive, element by element.
  void Direct(const Points& P)
  {
    constexpr int block = 2048; // elements at a time: what they add is kept for one thread to add
    using Matrix12 = Eigen::Matrix<double, 12, 12>;
    this->Gradient.setZero(CountOf(this->Unknowns), 3);
    this->Hessian.SetZero();
    const int m = static_cast<int>(this->Elements.size());
    std::vector<Matrix12> second(std::min(block, m));
    std::vector<Eigen::Matrix<double, 4, 3>> first(second.size());
    for (int start = 0; start < m; start += block)
    {
      const int count = std::min(block, m - start);
      ParallelFor(count, this->Threads,
        [&](int begin, int end)
        {
          for (int k = begin; k < end; ++k)
          {
            const Element& element = this->Elements[start + k];
            const Eigen::Matrix3d J = JacobianOf(element, P);
            first[k] =
              element.weight * element.gradients * UntanglingGradient(J, this->Epsilon).transpose();
            second[k] = this->ElementHessian(element, J);
          }
        });
      for (int k = 0; k < count; ++k)
      {
        const Element& element = this->Elements[start + k];
        this->Hessian.Add(element, second[k]);
        for (int j = 0; j < 4; ++j)
        {
          if (const int row = this->Unknowns[element.points[j]]; row >= 0)
          {
            this->Gradient.row(row) += first[k].row(j);
          }
        }
      }
    }
    this->System.Factor(this->Hessian.Get(), this->Threads);
    // One right-hand side; the solver takes three.
    LinearSystem::RightHandSides right =
      LinearSystem::RightHandSides::Zero(this->Gradient.size(), 3);
    LinearSystem::RightHandSides solution = right;
    right.col(0) = -Eigen::Map<const Eigen::VectorXd>(this->Gradient.data(), this->Gradient.size());
    this->System.Solve(right, solution, this->Threads);
    this->Direction.resize(this->Gradient.rows(), 3);
    Eigen::Map<Eigen::VectorXd>(this->Direction.data(), this->Direction.size()) = solution.col(0);
  }

  Eigen::Matrix<double, 12, 12> ElementHessian(
    const Element& element, const Eigen::Matrix3d& J) const
  {
    const UntanglingHessian psi = UntanglingSecondDerivative(J, this->Epsilon);
    const double largest = *std::max_element(psi.Values, psi.Values + 9);
    Eigen::Matrix<double, 12, 9> vectors;
    Eigen::Matrix<double, 9, 1> values;
    for (int q = 0; q < 9; ++q)
    {
      const Eigen::Matrix<double, 3, 4> column = psi.Vectors[q] * element.gradients.transpose();
      vectors.col(q) = Eigen::Map<const Eigen::Matrix<double, 12, 1>>(column.data());
      values[q] = element.weight * std::max(psi.Values[q], 1e-8 * largest);
    }
    return vectors * values.asDiagonal() * vectors.transpose();
  }

  /// Goes along Direction, half as far as often as needed. @param valid  no cell may invert
  /// @return whether P has changed
  bool Search(Points& P, double before, double slope, bool valid) const
  {
    double length = 1.0;
    for (int tries = 0; tries < 40; ++tries, length *= 0.5)
    {
      Points next = P;
      for (std::size_t i = 0; i < this->Unknowns.size(); ++i)
      {
        if (this->Unknowns[i] >= 0)
        {
          next.row(static_cast<Eigen::Index>(i)) += length * this->Direction.row(this->Unknowns[i]);
        }
      }
      if ((!valid || this->SmallestDeterminant(next) > 0.0) &&
        this->Energy(next) <= (1.0 + Rounding) * before + 1e-4 * length * slope)
      {
        P = next;
        return true;
      }
    }
    return false;
  }

  const std::vector<Element>& Elements;
  const std::vector<int>& Unknowns;
  int Threads;
  BlockMatrix Hessian;
  LinearSystem System;
  Points Gradient;  // of the unknowns
  Points Direction; // the same
  double Epsilon = 1.0;
};

/// What both methods begin with.
struct Setup
{
  Setup(const VolumeMesh& rest, const std::vector<char>& isFixed, const Points& displacements,
    int threads)
    : frame(FrameOf(rest.P))
    , P(frame.Into(rest.P))
    , elements(MakeElements(rest, P))
    , unknowns(NumberUnknowns(elements, isFixed))
    , U(Points::Zero(P.rows(), 3))
  {
    for (std::size_t i = 0; i < isFixed.size(); ++i)
    {
      if (const auto point = static_cast<Eigen::Index>(i); isFixed[i])
      {
        U.row(point) = displacements.row(point) / frame.scale;
      }
    }
    if (CountOf(unknowns) > 0 && !U.isZero(0.0))
    {
      ExtendHarmonically(elements, unknowns, U, threads);
    }
  }

  Frame frame;
  Points P; ///< in the frame
  std::vector<Element> elements;
  std::vector<int> unknowns;
  Points U; ///< displacements, in the frame
};
} // namespace

Points HarmonicExtension(const VolumeMesh& rest, const std::vector<char>& isFixed,
  const Points& displacements, int threads)
{
  const Setup setup(rest, isFixed, displacements, threads);
  return rest.P + setup.frame.scale * setup.U;
}

MorphedVolume MorphVolume(const VolumeMesh& rest, const std::vector<char>& isFixed,
  const Points& displacements, int threads, const Callback& callback)
{
  const Setup setup(rest, isFixed, displacements, threads);
  MorphedVolume result;
  Points U = setup.U;
  if (CountOf(setup.unknowns) > 0 && !U.isZero(0.0))
  {
    Points moved = setup.P + U;
    result.iterations = Untangling(setup.elements, setup.unknowns, threads).Run(moved, callback);
    U = moved - setup.P;
  }
  result.P = rest.P;
  for (std::size_t i = 0; i < isFixed.size(); ++i)
  {
    const auto point = static_cast<Eigen::Index>(i);
    if (isFixed[i])
    {
      result.P.row(point) += displacements.row(point);
    }
    else if (setup.unknowns[i] >= 0)
    {
      result.P.row(point) += setup.frame.scale * U.row(point);
    }
  }
  return result;
}

std::vector<char> InvertedByBoundary(
  const VolumeMesh& mesh, const std::vector<char>& isFixed, const Points& P)
{
  std::vector<char> flags(mesh.GetNumberOfCells(), 0);
  for (int cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    const int* ids = mesh.PointsOf(cell);
    for (const CellCorner& corner : CornersOf(mesh.Shapes[cell]))
    {
      if (std::all_of(corner.begin(), corner.end(), [&](int k) { return isFixed[ids[k]] != 0; }))
      {
        Eigen::Matrix3d edges;
        for (int k = 0; k < 3; ++k)
        {
          edges.col(k) = (P.row(ids[corner[k + 1]]) - P.row(ids[corner[0]])).transpose();
        }
        if (!(edges.determinant() > 0.0))
        {
          flags[cell] = 1;
        }
      }
    }
  }
  return flags;
}
} // namespace SphericalStyle
