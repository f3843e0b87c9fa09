// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeMorphing.h"

#include "BlockSystem.h"
#include "Frame.h"
#include "LinearSystem.h"
#include "LocalStep.h"
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
constexpr int MostSteps = 100;
/// Where the energy could fall by this share of what it is above its minimum without a boundary,
/// the next step would not be seen.
constexpr double Converged = 1e-3;
/// The same of the volume, for motions that are rigid up to rounding.
constexpr double Nothing = 1e-22;
constexpr double Rounding = 1e-14; // of a sum of energies
constexpr double SmallestEpsilon = 1e-9;
constexpr double SmallestEigenvalue = 1e-8; // of a second derivative, in units of the largest
/// Shares of what a solve could gain that may be left: of the start, and of a step.
constexpr double HarmonicShare = 1e-10;
constexpr double NewtonShare = 0.01;
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

/// The unknowns of each element.
std::vector<PairPattern::Element> UnknownsOf(
  const std::vector<Element>& elements, const std::vector<int>& unknowns)
{
  std::vector<PairPattern::Element> all(elements.size());
  for (std::size_t e = 0; e < all.size(); ++e)
  {
    std::transform(elements[e].points.begin(), elements[e].points.end(), all[e].begin(),
      [&](int i) { return unknowns[i]; });
  }
  return all;
}

/// Displacements of the unknowns, in the frame.
void ExtendHarmonically(const std::vector<Element>& elements, const std::vector<int>& unknowns,
  const PairPattern& pattern, Points& U, int threads)
{
  LinearSystem::Matrix K = pattern.MakeMatrix();
  LinearSystem::RightHandSides right = LinearSystem::RightHandSides::Zero(K.rows(), 3);
  for (const Element& element : elements)
  {
    const Eigen::Matrix4d stiffness =
      element.weight * element.gradients * element.gradients.transpose();
    for (int k = 0; k < 4; ++k)
    {
      const int row = unknowns[element.points[k]];
      for (int l = 0; l < 4 && row >= 0; ++l)
      {
        const int column = unknowns[element.points[l]];
        if (column < 0)
        {
          right.row(row) -= stiffness(k, l) * U.row(element.points[l]);
        }
        else if (column <= row)
        {
          K.valuePtr()[pattern.PlaceOf(row, column)] += stiffness(k, l);
        }
      }
    }
  }
  LinearSystem system(LinearMethod::ConjugateGradients);
  system.SetShareLeft(HarmonicShare);
  system.Analyze(K);
  system.Factor(K, threads);
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
  Untangling(const std::vector<Element>& elements, const std::vector<int>& unknowns,
    const PairPattern& pattern, int threads)
    : Elements(elements)
    , Unknowns(unknowns)
    , Threads(threads)
    , Places(elements.size())
    , Hessian(pattern)
  {
    for (std::size_t e = 0; e < elements.size(); ++e)
    {
      for (int pair = 0; pair < 10; ++pair)
      {
        const auto [k, l] = Pairs[pair];
        const int row = unknowns[elements[e].points[k]];
        const int column = unknowns[elements[e].points[l]];
        const bool both = row >= 0 && column >= 0;
        this->Places[e][pair] = both ? pattern.PlaceOf(row, column) : -1;
      }
    }
  }

  /// @return the number of steps
  int Run(Points& P, const Callback& callback)
  {
    const double weight = std::accumulate(this->Elements.begin(), this->Elements.end(), 0.0,
      [](double sum, const Element& element) { return sum + element.weight; });
    const double bottom = 5.0 * weight;
    double smallest = this->Measure(P).smallest;
    this->Epsilon = smallest > 0.0 ? SmallestEpsilon : 1.0;
    int step = 0;
    while (step < MostSteps)
    {
      const double before = this->Measure(P).energy;
      const double start = std::max(before - bottom, 0.0);
      this->Direct(P);
      const double slope = this->Gradient.cwiseProduct(this->Direction).sum();
      const bool moved = this->Search(P, before, slope, smallest > 0.0);
      const State after = this->Measure(P);
      smallest = after.smallest;
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
      this->Sharpen(before, after.energy, smallest);
    }
    return step;
  }

private:
  /// Pairs of the points of an element.
  static constexpr std::array<std::array<int, 2>, 10> Pairs = { { { 0, 0 }, { 1, 1 }, { 2, 2 },
    { 3, 3 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 2, 1 }, { 3, 1 }, { 3, 2 } } };
  using Blocks = std::array<Eigen::Matrix3d, 10>; // of Pairs

  struct State
  {
    double energy = 0.0;
    double smallest = std::numeric_limits<double>::infinity(); ///< determinant

    State& operator+=(const State& other)
    {
      this->energy += other.energy;
      this->smallest = std::min(this->smallest, other.smallest);
      return *this;
    }
  };

  State Measure(const Points& P) const
  {
    return ParallelSum(static_cast<int>(this->Elements.size()), this->Threads, State(),
      [&](int begin, int end)
      {
        State state;
        for (int e = begin; e < end; ++e)
        {
          const Eigen::Matrix3d J = JacobianOf(this->Elements[e], P);
          state +=
            State{ this->Elements[e].weight * UntanglingEnergy(J, this->Epsilon), J.determinant() };
        }
        return state;
      });
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
    constexpr int block = 8192; // elements at a time: what they add is kept for one thread to add
    this->Gradient.setZero(CountOf(this->Unknowns), 3);
    this->Hessian.SetZero();
    const int m = static_cast<int>(this->Elements.size());
    std::vector<Blocks> second(std::min(block, m));
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
            second[k] = this->SecondDerivative(element, J);
          }
        });
      for (int k = 0; k < count; ++k)
      {
        const Element& element = this->Elements[start + k];
        for (int pair = 0; pair < 10; ++pair)
        {
          if (const int place = this->Places[start + k][pair]; place >= 0)
          {
            const auto [row, column] = Pairs[pair];
            this->Hessian.Add(place,
              this->Unknowns[element.points[row]] < this->Unknowns[element.points[column]],
              second[k][pair]);
          }
        }
        for (int j = 0; j < 4; ++j)
        {
          if (const int row = this->Unknowns[element.points[j]]; row >= 0)
          {
            this->Gradient.row(row) += first[k].row(j);
          }
        }
      }
    }
    this->Hessian.Solve(-this->Gradient, this->Direction, NewtonShare, this->Threads);
  }

  Blocks SecondDerivative(const Element& element, const Eigen::Matrix3d& J) const
  {
    const UntanglingHessian psi = UntanglingSecondDerivative(J, this->Epsilon, SmallestEigenvalue);
    const Eigen::Matrix<double, 3, 4> g = psi.V.transpose() * element.gradients.transpose();
    Blocks blocks;
    for (const int pair : { 1, 2, 3, 7, 8, 9 })
    {
      const auto [k, l] = Pairs[pair];
      blocks[pair] = element.weight * (psi.U * psi.InAxes(g.col(k), g.col(l)) * psi.U.transpose());
    }
    // The gradients sum up to 0.
    blocks[4] = -(blocks[1] + (blocks[7] + blocks[8]).transpose());
    blocks[5] = -(blocks[7] + blocks[2] + blocks[9].transpose());
    blocks[6] = -(blocks[8] + blocks[9] + blocks[3]);
    blocks[0] = -(blocks[4] + blocks[5] + blocks[6]);
    return blocks;
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
      const State state = this->Measure(next);
      if ((!valid || state.smallest > 0.0) &&
        state.energy <= (1.0 + Rounding) * before + 1e-4 * length * slope)
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
  std::vector<std::array<int, 10>> Places; // of each element's Pairs in Hessian; -1 for none
  BlockSystem Hessian;
  BlockSystem::Rows Gradient;  // of the unknowns
  BlockSystem::Rows Direction; // the same
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
    , pattern(CountOf(unknowns), UnknownsOf(elements, unknowns))
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
      ExtendHarmonically(elements, unknowns, pattern, U, threads);
    }
  }

  Frame frame;
  Points P; ///< in the frame
  std::vector<Element> elements;
  std::vector<int> unknowns;
  PairPattern pattern;
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
    result.iterations =
      Untangling(setup.elements, setup.unknowns, setup.pattern, threads).Run(moved, callback);
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

namespace
{
/// |det E| J of a corner = sign(det E) E' adj E, for J = E' E^-1.
Eigen::Matrix3d WeightedJacobian(const Eigen::Matrix3d& before, const Eigen::Matrix3d& after)
{
  Eigen::Matrix3d adjugate;
  adjugate.row(0) = before.col(1).cross(before.col(2)).transpose();
  adjugate.row(1) = before.col(2).cross(before.col(0)).transpose();
  adjugate.row(2) = before.col(0).cross(before.col(1)).transpose();
  const double sign = adjugate.row(0).dot(before.col(0)) < 0.0 ? -1.0 : 1.0;
  return sign * after * adjugate;
}
}

Matrices VolumeRotations(const VolumeMesh& rest, const Points& Q, int threads)
{
  const Frame frame = FrameOf(rest.P);
  const Points P = frame.Into(rest.P);
  const Points moved = frame.Into(Q);
  const auto n = static_cast<std::size_t>(P.rows());
  Matrices rotations(n, Eigen::Matrix3d::Zero());
  std::vector<char> touched(n, 0);
  for (int cell = 0; cell < rest.GetNumberOfCells(); ++cell)
  {
    const int* ids = rest.PointsOf(cell);
    for (const CellCorner& corner : CornersOf(rest.Shapes[cell]))
    {
      Eigen::Matrix3d before;
      Eigen::Matrix3d after;
      bool same = true;
      for (int k = 0; k < 4; ++k)
      {
        const int i = ids[corner[k]];
        same = same && Q.row(i) == rest.P.row(i);
        if (k > 0)
        {
          before.col(k - 1) = (P.row(i) - P.row(ids[corner[0]])).transpose();
          after.col(k - 1) = (moved.row(i) - moved.row(ids[corner[0]])).transpose();
        }
      }
      const Eigen::Matrix3d jacobian = WeightedJacobian(before, after);
      for (const int k : corner)
      {
        rotations[ids[k]] += jacobian;
        touched[ids[k]] |= same ? 0 : 1;
      }
    }
  }
  ParallelFor(static_cast<int>(n), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        rotations[i] = touched[i] ? ClosestRotation(rotations[i].transpose())
                                  : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
      }
    });
  return rotations;
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
