// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClosedFormPreview.h"

#include "LocalStep.h"
#include "Parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SphericalStyle
{
namespace
{
/// Of a cell: how far the places are from x_k, along each axis, that the slope of Q is taken from.
/// Points of a sub-cell are as far from its middle in the mean square.
constexpr double SlopeReach = 1.0 / 12.0;
/// Of a cell, the least distance of a sample from the center that the expansion of d is good for.
constexpr double NearestToCenter = 1.0 / 3.0;
using GradientOf = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
using GradientInto = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

/// H: the gradient of d = b / |b| along the surface. @param b  from the center to the mean of B
/// @param G  of B @param squares  of the products of B about its mean, samples x 9 each
/// @param k  the sample @param nearest  length
Eigen::Matrix3d DirectionGradient(const Eigen::Vector3d& b, const Eigen::Matrix3d& G,
  const std::array<Fields, 2>& squares, int k, double nearest)
{
  const double length = std::max(b.norm(), nearest);
  const Eigen::Vector3d u = b / length;
  Eigen::Matrix3d H = (G - u * (u.transpose() * G)) / length;
  if (b.norm() < 2.0 * nearest)
  {
    return H;
  }
  // Half of the second derivatives, -(I_ca u_b + I_cb u_a + I_ab u_c - 3 u_a u_b u_c) / |b|^2,
  // times the gradients of the products.
  const GradientOf first(squares[0].row(k).data());
  const GradientOf second(squares[1].row(k).data());
  Eigen::Matrix<double, 9, 3> products; // row 3 a + b
  products << first.row(0), first.row(1), first.row(2), first.row(1), second.row(0), second.row(1),
    first.row(2), second.row(1), second.row(2);
  Eigen::RowVector3d trace = Eigen::RowVector3d::Zero();
  Eigen::Matrix3d along = Eigen::Matrix3d::Zero(); // sum over b of u_b times the product of c and b
  for (int c = 0; c < 3; ++c)
  {
    trace += products.row(4 * c);
    for (int a = 0; a < 3; ++a)
    {
      along.row(c) += u(a) * products.row(3 * c + a);
    }
  }
  const Eigen::RowVector3d twice = u.transpose() * along;
  H -= (2.0 * along + u * trace - 3.0 * u * twice) / (2.0 * length * length);
  return H;
}
}

ClosedFormPreview::ClosedFormPreview(
  const ModelAtRest& model, const PreviewPlaces& places, int threads)
  : NumberOfPoints(static_cast<int>(places.points.size()))
{
  std::vector<int> rows = places.points;
  this->ProbeAreas.resize(static_cast<Eigen::Index>(places.probes.size()));
  for (std::size_t k = 0; k < places.probes.size(); ++k)
  {
    const auto corners = model.F.row(places.probes[k]);
    rows.insert(rows.end(), corners.begin(), corners.end());
    const Eigen::RowVector3d a = model.P.row(corners(0));
    const Eigen::RowVector3d b = model.P.row(corners(1));
    const Eigen::RowVector3d c = model.P.row(corners(2));
    this->ProbeAreas(static_cast<Eigen::Index>(k)) = 0.5 * (b - a).cross(c - a).norm();
  }
  this->AreaOfProbe = places.areaOfProbe;
  this->P = model.P(rows, AllColumns);
  this->B = model.B(rows, AllColumns);
  if (model.normals)
  {
    this->Limbs = (*model.normals)(rows, AllColumns);
    if (model.thickness)
    {
      this->Limbs = (*model.thickness)(rows).asDiagonal() * this->Limbs;
    }
  }
  if (model.grid.GetNumberOfFunctions() > 0)
  {
    this->TakeMeans(model, threads);
  }
}

void ClosedFormPreview::TakeMeans(const ModelAtRest& model, int threads)
{
  const SurfaceGrid& grid = model.grid;
  SampleMeans& means = this->Samples;
  means.base = grid.Means(model.B, threads);
  const Fields slopes = grid.Gradients(model.B, threads);
  // Products of coordinates a and b, then about their means.
  constexpr int Pairs[2][3][2] = { { { 0, 0 }, { 0, 1 }, { 0, 2 } },
    { { 1, 1 }, { 1, 2 }, { 2, 2 } } };
  Points products(model.B.rows(), 3);
  for (int half = 0; half < 2; ++half)
  {
    for (int j = 0; j < 3; ++j)
    {
      const auto [a, b] = Pairs[half][j];
      products.col(j) = model.B.col(a).cwiseProduct(model.B.col(b));
    }
    means.squares[half] = grid.Gradients(products, threads);
    for (int j = 0; j < 3; ++j)
    {
      const auto [a, b] = Pairs[half][j];
      means.squares[half].middleCols<3>(3 * j) -=
        means.base.col(a).asDiagonal() * slopes.middleCols<3>(3 * b) +
        means.base.col(b).asDiagonal() * slopes.middleCols<3>(3 * a);
    }
  }
  if (model.normals)
  {
    products = *model.normals;
    if (model.thickness)
    {
      products = model.thickness->asDiagonal() * products;
    }
    means.limbs = grid.Gradients(products, threads);
  }
  const Points details = model.P - model.B;
  means.details = grid.Gradients(details, threads);
  for (int axis = 0; axis < 3; ++axis)
  {
    products = model.P.col(axis).asDiagonal() * details;
    means.detailMoments[axis] = grid.Gradients(products, threads);
    means.detailMoments[axis] -= grid.GetPlaces().col(axis).asDiagonal() * means.details;
  }
}

BaseSlopes ClosedFormPreview::SlopesOf(const ClosedFormOptions& o, const Sphere& sphere,
  const SurfaceGrid& grid, const BaseSlopes& slopes) const
{
  const double moved = ShareOfWay(o.lambda);
  const double a = o.normalBlend;
  const bool own = o.normalRadius == NormalRadius::OwnThickness;
  BaseSlopes after;
  after.gradients.resize(grid.GetNumberOfSamples(), 9);
  ParallelFor(grid.GetNumberOfSamples(), o.threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        const GradientOf G(slopes.gradients.row(k).data());
        Eigen::Matrix3d target = (1.0 - a) * sphere.radius *
          DirectionGradient(this->Samples.base.row(k).transpose() - sphere.center, G,
            this->Samples.squares, k, NearestToCenter * grid.GetSpacing());
        if (a > 0.0)
        {
          target += a * (own ? 1.0 : sphere.radius) * GradientOf(this->Samples.limbs.row(k).data());
        }
        GradientInto(after.gradients.row(k).data()) = (1.0 - moved) * G + moved * target;
      }
    });
  after.areaVectors = grid.AreaVectorsUnder(after.gradients, o.threads);
  return after;
}

/// Of P' before details give way.
Points ClosedFormPreview::CarriedAreas(const ClosedFormOptions& o, const SurfaceGrid& grid,
  const Fields& smooth, const BaseSlopes& after) const
{
  // The corners of a tetrahedron around x_k.
  constexpr double Corners[4][3] = { { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } };
  const int samples = grid.GetNumberOfSamples();
  const double step = SlopeReach * grid.GetSpacing();
  std::array<Fields, 4> S;
  for (int j = 0; j < 4; ++j)
  {
    S[j] = grid.AtSamples(smooth, o.threads, SlopeReach * Eigen::Vector3d(Corners[j]));
  }
  Fields gradients = after.gradients;
  ParallelBlocks(samples, o.threads,
    [&](int, int begin, int end)
    {
      std::array<Matrices, 4> R;
      for (int j = 0; j < 4; ++j)
      {
        R[j].assign(end - begin, Eigen::Matrix3d::Identity());
        FitRotations(S[j].row(begin).data(), end - begin, R[j].data());
      }
      for (int k = begin; k < end; ++k)
      {
        Eigen::Matrix3d Q = Eigen::Matrix3d::Zero();
        std::array<Eigen::Matrix3d, 3> slope = { Q, Q, Q };
        for (int j = 0; j < 4; ++j)
        {
          const Eigen::Matrix3d& turned = R[j][k - begin];
          const Eigen::Map<const Eigen::Matrix3d> covariance(S[j].row(k).data());
          const Eigen::Matrix3d corner = 0.25 * CertainShare(covariance, turned) * turned;
          Q += corner;
          for (int axis = 0; axis < 3; ++axis)
          {
            slope[axis] += Corners[j][axis] / step * corner;
          }
        }
        GradientInto sum(gradients.row(k).data());
        sum += Q * GradientOf(this->Samples.details.row(k).data());
        for (int axis = 0; axis < 3; ++axis)
        {
          sum += slope[axis] * GradientOf(this->Samples.detailMoments[axis].row(k).data());
        }
      }
    });
  return grid.AreaVectorsUnder(gradients, o.threads);
}

/// [size] of the probes. What cannot be scaled stays as large as it is: the full result says why.
/// @return the factor
double ClosedFormPreview::Place(
  const ClosedFormOptions& o, const SurfacePart& part, Points& Q) const
{
  const auto probes = static_cast<int>(this->ProbeAreas.size());
  const auto corner = [this](const Points& X, int probe, int k) -> Eigen::RowVector3d
  { return X.row(this->NumberOfPoints + 3 * static_cast<Eigen::Index>(probe) + k); };
  // Sums of the area at rest, and of a third of it at each corner.
  Eigen::Matrix<double, 1, 7> sums = Eigen::Matrix<double, 1, 7>::Zero();
  for (int p = 0; p < probes; ++p)
  {
    sums(0) += this->AreaOfProbe;
    for (int k = 0; k < 3; ++k)
    {
      sums.segment<3>(1) += this->AreaOfProbe / 3.0 * corner(this->P, p, k);
      sums.segment<3>(4) += this->AreaOfProbe / 3.0 * corner(Q, p, k);
    }
  }
  part.Sum(sums);
  const Eigen::RowVector3d mean = sums.segment<3>(1) / sums(0);
  Q.rowwise() += mean - sums.segment<3>(4) / sums(0);

  const auto highest = [&part](const Points& X, const Eigen::Vector3d& up)
  {
    const Eigen::VectorXd heights = X * up;
    const double none = -std::numeric_limits<double>::infinity();
    return part.Max(heights.size() > 0 ? heights.maxCoeff() : none);
  };
  const auto lengthOf = [&](const Points& X)
  {
    switch (o.size.keep)
    {
      case KeepSize::Area:
      case KeepSize::Volume:
      {
        double sum = 0.0;
        for (int p = 0; p < probes; ++p)
        {
          const Eigen::RowVector3d a = corner(X, p, 0);
          const Eigen::RowVector3d normal =
            (corner(X, p, 1) - a).cross(corner(X, p, 2) - a) / (2.0 * this->ProbeAreas(p));
          sum += this->AreaOfProbe *
            (o.size.keep == KeepSize::Area ? normal.norm() : normal.dot(a - mean) / 3.0);
        }
        sum = part.Sum(sum);
        return o.size.keep == KeepSize::Area ? std::sqrt(sum) : std::cbrt(sum);
      }
      case KeepSize::Extent:
      {
        const double top = highest(X, o.size.up);
        return top + highest(X, -o.size.up);
      }
      case KeepSize::Off:
        break;
    }
    return 1.0;
  };
  double factor = lengthOf(this->P) / lengthOf(Q);
  if (!(factor > 0.0) || !std::isfinite(factor))
  {
    factor = 1.0;
  }
  Q = (factor * (Q.rowwise() - mean)).rowwise() + mean;
  if (o.size.keepOnGround)
  {
    const double rise = highest(Q, -o.size.up) - highest(this->P, -o.size.up);
    Q.rowwise() += rise * o.size.up.transpose();
  }
  return factor;
}

ClosedFormResult ClosedFormPreview::Solve(const ClosedFormOptions& o, const Sphere& sphere,
  const SurfaceGrid& grid, const BaseSlopes& slopes, const SurfacePart& part, double& scale) const
{
  const double share = ShareOfWay(o.lambda);
  const double a = o.normalBlend;
  std::vector<int> onCenter;
  ClosedFormResult result;
  Points& t = result.directions;
  t = CenterDirections(this->B, Triangles(0, 3), sphere.center, onCenter);
  if (a > 0.0)
  {
    const double limbs = o.normalRadius == NormalRadius::OwnThickness ? 1.0 / sphere.radius : 1.0;
    t = (1.0 - a) * t + a * limbs * this->Limbs;
  }
  const Points targets = (sphere.radius * t).rowwise() + sphere.center.transpose();
  const Points moved = this->B + share * (targets - this->B);
  Points& Q = result.positions;
  if (grid.GetNumberOfFunctions() > 0)
  {
    const BaseSlopes after = this->SlopesOf(o, sphere, grid, slopes);
    const Fields smooth =
      grid.SmoothTwice(DetailCovariances(grid, slopes, after, o.threads), o.threads);
    CarryDetails(grid, smooth, { this->P, this->P, this->B }, moved, o.threads, Q,
      o.keepRotations ? &result.rotations : nullptr);
    const Points carried = this->CarriedAreas(o, grid, smooth, after);
    const Fields yields = DetailYields(grid.AtSamples(smooth, o.threads),
      { grid.GetAreaVectors(), after.areaVectors, carried }, o.threads);
    if (!yields.isZero(0.0))
    {
      GiveWay(grid, grid.Smooth(yields, o.threads), this->P, moved, o.threads, Q);
    }
  }
  else
  {
    Q = moved;
    result.rotations.assign(o.keepRotations ? Q.rows() : 0, Eigen::Matrix3d::Identity());
  }
  scale = this->Place(o, part, Q);
  Q.conservativeResize(this->NumberOfPoints, 3);
  t.conservativeResize(this->NumberOfPoints, 3);
  result.rotations.resize(o.keepRotations ? this->NumberOfPoints : 0);
  return result;
}
} // namespace SphericalStyle
