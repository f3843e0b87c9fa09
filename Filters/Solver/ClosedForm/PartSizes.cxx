// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartSizes.h"

#include "DisjointSets.h"
#include "MeshTopology.h"
#include "PartShares.h"
#include "ShortestPaths.h"
#include "Smoothstep.h"
#include "SurfaceMeasures.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace SphericalStyle
{
namespace
{
constexpr double LeastShare = 1e-3;   // less is none
constexpr double LeastOverlap = 1e-7; // of two parts, of the area; less is none
constexpr double NearAlong = 1.5;     // in widths along edges: all of a share
constexpr double FarAlong = 4.0;      // none of it
constexpr int LookedAt = 2000;        // points of a loose part, and of the others
constexpr double LargestFactor = 20.0;
constexpr int Halvings = 50;         // of a range of factors: to rounding
constexpr double LeastOfHead = 0.05; // of the largest volume

/// The lowest and the highest point along an axis.
struct Range
{
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void Add(double x)
  {
    this->low = std::min(this->low, x);
    this->high = std::max(this->high, x);
  }
  double Extent() const { return std::max(this->high - this->low, 0.0); }
};

/// Shortest ways along edges.
class EdgeDistances
{
public:
  /// @param limit  what is farther is infinitely far
  EdgeDistances(const Points& p, const Triangles& F, double limit)
    : P(p)
    , Limit(limit)
    , First(p.rows() + 1, 0)
    , Others(2 * F.size())
  {
    for (Eigen::Index c = 0; c < F.size(); ++c)
    {
      this->First[F.data()[c] + 1] += 2;
    }
    std::partial_sum(this->First.begin(), this->First.end(), this->First.begin());
    std::vector<int> next(this->First.begin(), this->First.end() - 1);
    for (Eigen::Index f = 0; f < F.rows(); ++f)
    {
      for (int k = 0; k < 3; ++k)
      {
        this->Others[next[F(f, k)]++] = F(f, (k + 1) % 3);
        this->Others[next[F(f, k)]++] = F(f, (k + 2) % 3);
      }
    }
  }

  /// Of each point, to the nearest one of a part.
  std::vector<double> From(const std::vector<int>& parts, int part) const
  {
    std::vector<double> distances(parts.size(), std::numeric_limits<double>::infinity());
    std::vector<int> starts;
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      if (parts[i] == part)
      {
        distances[i] = 0.0;
        starts.push_back(static_cast<int>(i));
      }
    }
    LowerAlongPaths(
      distances, starts,
      [this](int i, const auto& visit)
      {
        for (int e = this->First[i]; e < this->First[i + 1]; ++e)
        {
          const int j = this->Others[e];
          visit(j, (this->P.row(i) - this->P.row(j)).norm());
        }
      },
      this->Limit);
    return distances;
  }

private:
  const Points& P;
  double Limit;
  std::vector<int> First;  // of each point, and one past the last
  std::vector<int> Others; // at the ends of its edges
};

/// Of an even choice of some.
std::vector<int> Some(const std::vector<int>& all)
{
  const std::size_t step = all.size() / LookedAt + 1;
  std::vector<int> some;
  for (std::size_t i = 0; i < all.size(); i += step)
  {
    some.push_back(all[i]);
  }
  return some;
}
}

PartSizes::PartSizes(const Points& p, const Triangles& F, const std::vector<int>& parts, int count,
  double width, int threads)
  : P(p)
  , Parts(parts)
{
  SurfaceGrid grid(p, F, width, threads);
  grid.FactorAlong(threads);
  this->Shares = SmoothShares(grid, PartShares(parts, count), p, threads);
  this->ShareNothingThroughAir(F, width);
  const Eigen::VectorXd areas = PointAreas(p, F);
  Eigen::VectorXd ofParts = Eigen::VectorXd::Zero(count);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    ofParts(parts[i]) += areas(static_cast<Eigen::Index>(i));
  }
  ofParts.maxCoeff(&this->Largest);
  this->Centroid.setZero();
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    if (parts[i] == this->Largest)
    {
      const auto at = static_cast<Eigen::Index>(i);
      this->Centroid += areas(at) / ofParts(this->Largest) * p.row(at);
    }
  }
  this->FindJoints(areas);
  this->JoinTheRest(areas);
}

/// The grid takes what is near for what hangs together, as a hand and the cheek that it touches.
/// Where triangles connect a point to a part, the share of that part fades with the distance along
/// edges. An eye that no triangle connects to its head keeps the shares of the face around it.
void PartSizes::ShareNothingThroughAir(const Triangles& F, double width)
{
  const auto count = static_cast<int>(this->Shares.cols());
  std::vector<int> connected(count); // parts, by triangles
  std::iota(connected.begin(), connected.end(), 0);
  this->Meet = Eigen::MatrixXi::Zero(count, count);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const int k = this->Parts[F(f, corner)];
      const int l = this->Parts[F(f, (corner + 1) % 3)];
      this->Meet(k, l) = 1;
      this->Meet(l, k) = 1;
      JoinSets(connected, k, l);
    }
  }
  for (int k = 0; k < count; ++k)
  {
    for (int l = 0; l < count; ++l)
    {
      this->Meet(k, l) |= RootOf(connected, k) != RootOf(connected, l) ? 1 : 0;
    }
  }
  const std::vector<int> pieces = FirstPointsOfComponents(F, static_cast<int>(this->Shares.rows()));
  const EdgeDistances distances(this->P, F, FarAlong * width);
  for (int l = 0; l < count; ++l)
  {
    const std::vector<double> along = distances.From(this->Parts, l);
    std::vector<char> isThere(pieces.size(), 0); // whether a piece has a point of the part
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      isThere[pieces[i]] |= this->Parts[i] == l ? 1 : 0;
    }
    for (Eigen::Index i = 0; i < this->Shares.rows(); ++i)
    {
      if (isThere[pieces[i]])
      {
        this->Shares(i, l) *=
          Smoothstep(std::clamp((FarAlong - along[i] / width) / (FarAlong - NearAlong), 0.0, 1.0));
      }
    }
  }
  for (Eigen::Index i = 0; i < this->Shares.rows(); ++i)
  {
    const double sum = this->Shares.row(i).sum();
    if (sum > LeastShare)
    {
      this->Shares.row(i) /= sum;
    }
    else // deep in another part, and of its own in name only
    {
      this->Shares.row(i).setZero();
      this->Shares(i, this->Parts[i]) = 1.0;
    }
  }
}

void PartSizes::FindJoints(const Eigen::VectorXd& areas)
{
  const Eigen::Index count = this->Shares.cols();
  Eigen::MatrixXd overlaps = Eigen::MatrixXd::Zero(count, count);
  std::vector<Eigen::RowVector3d> sums(count * count, Eigen::RowVector3d::Zero());
  std::vector<int> there;
  for (Eigen::Index i = 0; i < this->P.rows(); ++i)
  {
    there.clear();
    for (int k = 0; k < count; ++k)
    {
      if (this->Shares(i, k) > LeastShare)
      {
        there.push_back(k);
      }
    }
    for (std::size_t a = 0; a < there.size(); ++a)
    {
      for (std::size_t b = a + 1; b < there.size(); ++b)
      {
        const double w = areas(i) * this->Shares(i, there[a]) * this->Shares(i, there[b]);
        overlaps(there[a], there[b]) += w;
        sums[there[a] * count + there[b]] += w * this->P.row(i);
      }
    }
  }
  const double least = LeastOverlap * areas.sum();
  for (int k = 0; k < count; ++k)
  {
    for (int l = k + 1; l < count; ++l)
    {
      if (this->Meet(k, l) && overlaps(k, l) > least)
      {
        this->Joints.push_back({ k, l, overlaps(k, l), sums[k * count + l] / overlaps(k, l) });
      }
    }
  }
}

/// What hangs together with the largest part grows by the nearest of the others until it is all.
void PartSizes::JoinTheRest(const Eigen::VectorXd& areas)
{
  const auto count = static_cast<int>(this->Shares.cols());
  std::vector<int> parents(count);
  std::iota(parents.begin(), parents.end(), 0);
  for (const Joint& joint : this->Joints)
  {
    JoinSets(parents, joint.k, joint.l);
  }
  while (true)
  {
    std::vector<int> in;
    std::vector<int> out;
    for (std::size_t i = 0; i < this->Parts.size(); ++i)
    {
      const bool joined = RootOf(parents, this->Parts[i]) == RootOf(parents, this->Largest);
      (joined ? in : out).push_back(static_cast<int>(i));
    }
    if (out.empty())
    {
      return;
    }
    double nearest = std::numeric_limits<double>::infinity();
    int from = 0;
    int to = 0;
    const std::vector<int> some = Some(in);
    for (const int j : Some(out))
    {
      for (const int i : some)
      {
        const double distance = (this->P.row(i) - this->P.row(j)).squaredNorm();
        if (distance < nearest)
        {
          nearest = distance;
          from = i;
          to = j;
        }
      }
    }
    const int k = this->Parts[from];
    const int l = this->Parts[to];
    this->Joints.push_back({ k, l, areas.mean(), 0.5 * (this->P.row(from) + this->P.row(to)) });
    JoinSets(parents, k, l);
  }
}

Points PartSizes::Sized(const Eigen::VectorXd& sizes) const
{
  const Eigen::Index count = this->Shares.cols();
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(count, count);
  Points b = Points::Zero(count, 3);
  for (const Joint& joint : this->Joints)
  {
    const auto& [k, l, o, place] = joint;
    L(k, k) += o;
    L(l, l) += o;
    L(k, l) -= o;
    L(l, k) -= o;
    b.row(k) += o * (sizes(l) - sizes(k)) * place;
    b.row(l) += o * (sizes(k) - sizes(l)) * place;
  }
  // The largest part stays: b of it is known.
  const Eigen::RowVector3d known = (1.0 - sizes(this->Largest)) * this->Centroid;
  b -= L.col(this->Largest) * known;
  L.row(this->Largest).setZero();
  L.col(this->Largest).setZero();
  L(this->Largest, this->Largest) = 1.0;
  b.row(this->Largest) = known;
  const Eigen::VectorXd scales = L.diagonal().cwiseSqrt().cwiseInverse(); // overlaps differ a lot
  L = scales.asDiagonal() * L * scales.asDiagonal();
  const Eigen::LDLT<Eigen::MatrixXd> factor(L);
  const Points moves = scales.asDiagonal() * factor.solve(scales.asDiagonal() * b);
  return (this->Shares * sizes).asDiagonal() * this->P + this->Shares * moves;
}

std::vector<int> PartSizes::HangingOn(int part, int other) const
{
  const auto count = static_cast<int>(this->Shares.cols());
  std::vector<Joint> joints = this->Joints;
  std::stable_sort(joints.begin(), joints.end(),
    [](const Joint& a, const Joint& b) { return a.overlap > b.overlap; });
  std::vector<int> tree(count);
  std::iota(tree.begin(), tree.end(), 0);
  std::vector<int> without = tree; // the part
  for (const Joint& joint : joints)
  {
    if (RootOf(tree, joint.k) != RootOf(tree, joint.l))
    {
      JoinSets(tree, joint.k, joint.l);
      if (joint.k != part && joint.l != part)
      {
        JoinSets(without, joint.k, joint.l);
      }
    }
  }
  std::vector<int> hanging;
  for (int k = 0; k < count; ++k)
  {
    if (k != part && RootOf(without, k) != RootOf(without, other))
    {
      hanging.push_back(k);
    }
  }
  return hanging;
}

Head FindHead(const PartSizes& sized, const Points& P, const Triangles& F,
  const std::vector<int>& parts, int count, int axis, int head)
{
  const Eigen::VectorXd areas = TriangleAreas(P, F);
  Points centers = Points::Zero(count, 3);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(count);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const int k = parts[F(f, 0)];
    centers.row(k) += areas(f) * P(F.row(f), AllColumns).colwise().mean();
    sums(k) += areas(f);
  }
  centers.array().colwise() /= sums.array().max(std::numeric_limits<double>::min());
  Eigen::VectorXd volumes = Eigen::VectorXd::Zero(count);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const int k = parts[F(f, 0)];
    volumes(k) += TripleProduct(P, F, f, centers.row(k).transpose());
  }
  volumes = volumes.cwiseAbs();
  if (head < 0)
  {
    const double least = LeastOfHead * volumes.maxCoeff();
    for (int k = 0; k < count; ++k)
    {
      if (volumes(k) >= least && (head < 0 || centers(k, axis) > centers(head, axis)))
      {
        head = k;
      }
    }
  }
  volumes(head) = -1.0;
  int body = head;
  volumes.maxCoeff(&body);
  return { head, count > 1 ? sized.HangingOn(head, body) : std::vector<int>() };
}

double HeightRatio(const Points& P, const std::vector<int>& parts, const Head& head, int axis)
{
  Range own;
  Range rest;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const double x = P(static_cast<Eigen::Index>(i), axis);
    if (parts[i] == head.part)
    {
      own.Add(x);
    }
    else if (!std::binary_search(head.along.begin(), head.along.end(), parts[i]))
    {
      rest.Add(x);
    }
  }
  return rest.Extent() > 0.0 ? own.Extent() / rest.Extent()
                             : std::numeric_limits<double>::infinity();
}

namespace
{
/// For a factor of the sizes of the head and of what goes along: x' is linear in it.
std::function<double(double)> RatioOfFactor(const PartSizes& sized, const Eigen::VectorXd& sizes,
  const std::vector<int>& parts, const Head& head, int axis)
{
  Eigen::VectorXd without = sizes;
  without(head.part) = 0.0;
  without(head.along).setZero();
  const Points start = sized.Sized(without);
  const Points slope = sized.Sized(sizes) - start;
  return [&parts, &head, axis, start, slope](double factor)
  { return HeightRatio(start + factor * slope, parts, head, axis); };
}
}

double FactorForHeightRatio(const PartSizes& sized, const Eigen::VectorXd& sizes,
  const std::vector<int>& parts, const Head& head, int axis, double wanted)
{
  const auto ratio = RatioOfFactor(sized, sizes, parts, head, axis);
  double low = 1.0 / LargestFactor;
  double high = LargestFactor;
  if (!(ratio(low) < wanted && ratio(high) > wanted))
  {
    return 0.0;
  }
  // By halves: the ratio has corners where another point is on top. As sizes are compared, by logs.
  for (int i = 0; i < Halvings; ++i)
  {
    const double middle = std::sqrt(low * high);
    (ratio(middle) < wanted ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

std::pair<double, double> HeightRatiosInReach(const PartSizes& sized, const Eigen::VectorXd& sizes,
  const std::vector<int>& parts, const Head& head, int axis)
{
  const auto ratio = RatioOfFactor(sized, sizes, parts, head, axis);
  return { ratio(1.0 / LargestFactor), ratio(LargestFactor) };
}
} // namespace SphericalStyle
