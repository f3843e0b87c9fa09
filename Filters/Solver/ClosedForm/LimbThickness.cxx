// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LimbThickness.h"

#include "FirstHit.h"
#include "Parallel.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
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
constexpr double BlindSubCells = 0.5; // of the spacing: the sheet that a ray starts from

/// f(k) for every sample: some rays are longer than others, so threads take few at a time.
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
  const Fields places = grid.Means(B, threads);
  Points normals = grid.AreaVectorsUnder(grid.Gradients(B, threads), threads);
  grid.ForgetPoints(); // the tree needs memory
  for (int k = 0; k < samples; ++k)
  {
    normals.row(k) = normals.row(k).stableNormalized().eval();
  }
  const Fields around = grid.AtSamples(grid.Smooth(normals, threads), threads);
  const OwnTriangles triangles(B, F);
  const double blind = BlindSubCells * grid.GetSpacing();

  Fields distances = Fields::Constant(samples, 1, FirstHit::Nothing);
  ForSamples(grid, threads,
    [&](int k)
    {
      const Eigen::Vector3d n = normals.row(k);
      if (n.squaredNorm() > 0.5 && around.row(k).dot(n.transpose()) >= Against)
      {
        FirstHit hit(B, F, places.row(k), -n, FirstHit::Nothing);
        hit.SkipOutsides(blind);
        triangles.Search(hit);
        distances(k, 0) = hit.GetDistance();
      }
    });
  TakeNearest(part, distances);
  std::vector<double> found(samples); // 0 where nothing is known
  ForSamples(grid, threads,
    [&](int k)
    {
      const double distance = distances(k, 0);
      const double rho = distance < FirstHit::Nothing ? std::max(Thinnest, 0.5 * distance) : 0.0;
      const double facing = grid.GetAreaVectors().row(k).norm() / grid.GetWeights()(k);
      const double sheet =
        facing < FacesOneWay ? std::max(Thinnest, HalfOfSheet(grid, k)) : Thinnest;
      const double share = std::min(1.0, facing / FacesOneWay);
      found[k] = share == 1.0 ? rho
        : rho > 0.0           ? std::exp(share * std::log(rho) + (1.0 - share) * std::log(sheet))
                              : sheet;
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
