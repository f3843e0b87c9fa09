// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LimbThickness.h"

#include "FirstHit.h"
#include "Parallel.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace SphericalStyle
{
namespace
{
constexpr double Thinnest = 0.002;   // fraction of the diagonal, as all lengths here
constexpr double MostSamples = 0.98; // have less than the upper bound
constexpr double Against = -0.3; // of the cosine to the surroundings below which a sample is wrong
constexpr double FacesOneWay = 0.5; // |N_k| / w_k below which a sample has both sides of a sheet
constexpr double WallStiffness =
  24.0; // at which no wall of TestThickness keeps less than elastic stitches kept
constexpr double FewestAnswers = 0.01;
constexpr double Opposite = -0.55;  // of the cosine, below which two samples are on opposite sides
constexpr double LargestBall = 1.0; // beyond, samples lie side by side
constexpr int MostOpposite = 10000; // of more samples, as sponges have, every second and so on
constexpr double OnePlace = 1e-6;   // nearer samples have no direction from each other
constexpr double HalfCone = M_PI / 8.0;       // about the direction to one, that it bounds
constexpr double LeastArc = 3.0 / 4.0 * M_PI; // around the normal, that must be bounded
// Both sides of a wall whose base is a sheet are within these, of the spacing.
constexpr double CollapsedOnBase = 0.25;
constexpr double CollapsedOnModel = 0.75;
constexpr double BlindSubCells = 0.5; // of the spacing: the sheet that a ray starts from

/// f(k) for every sample: some take longer than others, so threads take few at a time.
template <typename Function>
void ForSamples(const SurfaceGrid& grid, int threads, const Function& f)
{
  constexpr int AtOnce = 256;
  const int samples = grid.GetNumberOfSamples();
  ParallelTasks((samples + AtOnce - 1) / AtOnce, threads,
    [&](int task)
    {
      for (int k = AtOnce * task; k < std::min(samples, AtOnce * (task + 1)); ++k)
      {
        f(k);
      }
    });
}

/// Looks for what a ray meets first, also where this process has no triangles.
class OwnTriangles
{
public:
  OwnTriangles(const Points& P, const Triangles& F)
  {
    if (F.rows() > 0)
    {
      this->Tree.emplace(P, F);
    }
  }
  void Search(FirstHit& hit) const
  {
    if (this->Tree)
    {
      hit.Search(*this->Tree);
    }
  }

private:
  std::optional<TriangleTree> Tree;
};

/// Of the hits of all processes the nearest; of several at one distance that of the lowest process.
/// @param hits  one a row, the distance first
void TakeNearest(const SurfacePart& part, Fields& hits)
{
  if (part.IsWhole())
  {
    return;
  }
  const auto width = static_cast<std::size_t>(hits.cols());
  const auto size = static_cast<std::size_t>(hits.size());
  part.processes->Reduce(hits.data(), size,
    [width, size](double* into, const double* from)
    {
      for (std::size_t at = 0; at < size; at += width)
      {
        if (from[at] < into[at])
        {
          std::copy_n(from + at, width, into + at);
        }
      }
    });
}

/// Directions around an axis, as arcs that do not meet.
class Arcs
{
public:
  /// @param middle  -pi to pi @param half  0 to pi / 2
  void Add(double middle, double half)
  {
    const double from = middle - half, to = middle + half;
    this->AddOne(std::max(from, -M_PI), std::min(to, M_PI));
    if (from < -M_PI)
    {
      this->AddOne(from + 2.0 * M_PI, M_PI);
    }
    if (to > M_PI)
    {
      this->AddOne(-M_PI, to - 2.0 * M_PI);
    }
  }
  double GetLength() const { return this->Length; }

private:
  void AddOne(double from, double to)
  {
    // Arcs that it meets become one with it.
    const auto met = std::partition(this->Ends.begin(), this->Ends.end(),
      [&](const auto& arc) { return arc.second < from || arc.first > to; });
    for (auto arc = met; arc != this->Ends.end(); ++arc)
    {
      this->Length -= arc->second - arc->first;
      from = std::min(from, arc->first);
      to = std::max(to, arc->second);
    }
    this->Ends.erase(met, this->Ends.end());
    this->Ends.emplace_back(from, to);
    this->Length += to - from;
  }

  std::vector<std::pair<double, double>> Ends;
  double Length = 0.0;
};

/// A sample, or several one below the other.
template <int Rows>
struct Sides
{
  using Places = Eigen::Matrix<double, Rows, 3, Rows == 1 ? Eigen::RowMajor : Eigen::ColMajor>;
  Places x;       ///< place on the base
  Places ofModel; ///< and on the model
  Places n;       ///< unit normal, 0 of what says nothing
};
using Side = Sides<1>;
using Opposites = Sides<Eigen::Dynamic>;

/// The balls that touch the base at a sample.
struct Balls
{
  /// The smallest that one sample bounds alone, for it lies within the cone around the axis.
  double alone = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, int>> others; ///< radius, and the sample that it goes through
};

Balls BallsAt(const Side& side, const Opposites& opposites, double spacing)
{
  const auto& [x, ofModel, n] = opposites;
  const Eigen::Vector3d normal = side.n;
  const Eigen::VectorXd facing = n * normal;
  const double cosine = std::cos(HalfCone);
  const double onBase = CollapsedOnBase * spacing, onModel = CollapsedOnModel * spacing;
  Balls balls;
  for (int j = 0; j < facing.size(); ++j)
  {
    if (!(facing(j) < Opposite))
    {
      continue;
    }
    const Eigen::Vector3d y = x.row(j) - side.x;
    const double depth = -y.dot(normal);
    const double square = y.squaredNorm();
    const bool hasDirection = square > OnePlace * OnePlace;
    if (hasDirection && 0.5 * square < LargestBall * std::min(depth, y.dot(n.row(j))))
    {
      const double radius = 0.5 * square / depth;
      if (radius < balls.alone && depth * depth >= cosine * cosine * square)
      {
        balls.alone = radius;
      }
      else if (radius < balls.alone)
      {
        balls.others.emplace_back(radius, j);
      }
    }
    else if (square < std::min(onBase * onBase, 4.0 * balls.alone * balls.alone))
    {
      // On the model they are the right way round, and no further apart than a thin wall.
      const Eigen::Vector3d through = ofModel.row(j) - side.ofModel;
      if (through.squaredNorm() < onModel * onModel && through.dot(normal) < 0.0 &&
        through.dot(n.row(j)) > 0.0)
      {
        balls.alone = 0.5 * std::sqrt(square);
      }
    }
  }
  return balls;
}

/// rho_k of a sample [limb]; none where too little is opposite.
std::optional<double> RadiusOfBall(const Side& side, const Opposites& opposites, double spacing)
{
  auto [alone, others] = BallsAt(side, opposites, spacing);
  others.erase(std::remove_if(others.begin(), others.end(),
                 [most = alone](const auto& ball) { return ball.first >= most; }),
    others.end());
  std::sort(others.begin(), others.end());
  const Eigen::Vector3d normal = side.n;
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  Arcs bounded;
  for (const auto& [radius, j] : others)
  {
    const Eigen::Vector3d y = (opposites.x.row(j) - side.x).transpose().normalized();
    const double across = y.dot(u), along = y.dot(v);
    const double sine = std::sin(HalfCone) / std::hypot(across, along);
    bounded.Add(std::atan2(along, across), std::asin(std::min(1.0, sine)));
    if (bounded.GetLength() >= LeastArc)
    {
      return radius;
    }
  }
  return std::isfinite(alone) ? std::optional(alone) : std::nullopt;
}

/// Half of what is between the two sides of a sheet that lie in one sample.
double HalfOfSheet(const SurfaceGrid& grid, int k)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(grid.GetSpreads()[k]);
  return std::sqrt(std::max(0.0, spread.eigenvalues()(0)));
}
}

Eigen::VectorXd LimbThickness(const Points& P, const Points& B, const Triangles& F, double radius,
  int threads, const SurfacePart& part)
{
  SurfaceGrid grid(P, F, LimbSize, threads, part);
  grid.FactorAlong(threads);
  const int samples = grid.GetNumberOfSamples();
  Points normals = grid.AreaVectorsUnder(grid.Gradients(B, threads), threads);
  for (int k = 0; k < samples; ++k)
  {
    normals.row(k) = normals.row(k).stableNormalized().eval();
  }
  const Fields around = grid.AtSamples(grid.Smooth(normals, threads), threads);
  const Eigen::VectorXd oneWay =
    grid.GetAreaVectors().rowwise().norm().array() / grid.GetWeights().array();
  const Points places = grid.Means(B, threads);
  for (int k = 0; k < samples; ++k)
  {
    if (!(around.row(k).dot(normals.row(k)) >= Against))
    {
      normals.row(k).setZero();
    }
  }
  const Eigen::Index step = std::max(1, (samples + MostOpposite - 1) / MostOpposite);
  const auto some = Eigen::seq(0, samples - 1, step);
  const Opposites opposites{ places(some, AllColumns), grid.GetPlaces()(some, AllColumns),
    normals(some, AllColumns) };
  std::vector<double> found(samples); // 0 where nothing is known
  ForSamples(grid, threads,
    [&](int k)
    {
      const std::optional<double> ball = RadiusOfBall(
        { places.row(k), grid.GetPlaces().row(k), normals.row(k) }, opposites, grid.GetSpacing());
      const double rho = ball ? std::max(Thinnest, *ball) : 0.0;
      if (oneWay(k) >= FacesOneWay)
      {
        found[k] = rho;
        return;
      }
      const double sheet = std::max(Thinnest, HalfOfSheet(grid, k));
      const double share = oneWay(k) / FacesOneWay;
      found[k] =
        rho > 0.0 ? std::exp(share * std::log(rho) + (1.0 - share) * std::log(sheet)) : sheet;
    });

  std::vector<double> sorted;
  std::copy_if(
    found.begin(), found.end(), std::back_inserter(sorted), [](double x) { return x > 0.0; });
  if (sorted.empty())
  {
    return Eigen::VectorXd::Constant(P.rows(), radius);
  }
  const auto at = static_cast<std::ptrdiff_t>(MostSamples * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + at, sorted.end());
  const double largest = std::max(Thinnest, std::min(radius, sorted[at]));

  Fields answers(samples, 2); // whether there is one, and its logarithm
  for (int k = 0; k < samples; ++k)
  {
    const bool known = found[k] > 0.0;
    answers.row(k) << (known ? 1.0 : 0.0), (known ? std::log(std::min(found[k], largest)) : 0.0);
  }
  const Fields smooth = grid.AtPoints(grid.Smooth(answers, threads), P, threads);
  Eigen::VectorXd rho(P.rows());
  for (Eigen::Index i = 0; i < rho.size(); ++i)
  {
    rho(i) = smooth(i, 0) > FewestAnswers
      ? std::clamp(std::exp(smooth(i, 1) / smooth(i, 0)), Thinnest, largest)
      : radius;
  }
  return rho;
}

std::vector<GridPair> FindWalls(const SurfaceGrid& grid, const Points& P, const Triangles& F,
  int threads, const SurfacePart& part)
{
  const double size = grid.GetSize();
  const double thickest = 2.0 * size;
  const double thinnest = 0.1 * size;
  const OwnTriangles triangles(P, F);
  // Distance, place of the hit, and cos theta.
  Fields hits = Fields::Zero(grid.GetNumberOfSamples(), 5);
  hits.col(0).setConstant(FirstHit::Nothing);
  ForSamples(grid, threads,
    [&](int k)
    {
      const Eigen::Vector3d N = grid.GetAreaVectors().row(k);
      const Eigen::Vector3d direction = -N.stableNormalized();
      if (!(N.norm() > FacesOneWay * grid.GetWeights()(k)))
      {
        return; // both sides are in the sample: they are together already
      }
      FirstHit hit(P, F, grid.GetPlaces().row(k), direction, thickest);
      hit.SkipOutsides(BlindSubCells * grid.GetSpacing());
      triangles.Search(hit);
      if (hit.GetTriangle() < 0)
      {
        return;
      }
      const auto corners = F.row(hit.GetTriangle());
      const Eigen::Matrix3d x = P(corners, AllColumns).transpose();
      const Eigen::Vector3d face =
        (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).stableNormalized();
      hits(k, 0) = hit.GetDistance();
      hits.row(k).segment<3>(1) = (x * hit.GetPlace()).transpose();
      hits(k, 4) = face.dot(direction);
    });
  TakeNearest(part, hits);
  std::vector<GridPair> walls;
  for (int k = 0; k < grid.GetNumberOfSamples(); ++k)
  {
    const double outward = hits(k, 4);
    if (outward > 0.0)
    {
      const double d = std::max(hits(k, 0), thinnest);
      walls.push_back({ grid.GetPlaces().row(k), hits.row(k).segment<3>(1),
        WallStiffness * grid.GetWeights()(k) * outward * outward *
          (1.0 / (d * d) - 1.0 / (thickest * thickest)) });
    }
  }
  return walls;
}
} // namespace SphericalStyle
