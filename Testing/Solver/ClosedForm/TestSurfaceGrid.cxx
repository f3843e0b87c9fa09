// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Smooth fields on a grid of B-splines: sums over the surface, what is exact for linear fields, and
// the system that is solved.
#include "Check.h"
#include "Frame.h"
#include "LimbThickness.h"
#include "Meshes.h"
#include "SurfaceGrid.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <sys/resource.h>

using namespace SphericalStyle;

namespace
{
using Meshes::Vector;

struct Framed
{
  std::string name;
  Points P;
  Triangles F;
};

std::vector<Framed> Surfaces()
{
  using namespace Meshes;
  std::vector<Named> named = { { "ellipsoid", Perturbed(Ellipsoid(3), 0.01, 1) },
    { "fine ellipsoid", Ellipsoid(6) }, { "coarse cuboid", Perturbed(Box(1), 0.05, 2) },
    { "wavy sheet", Patch(14, 0.4) }, { "cup", Cup(0.1) }, { "two parts", TwoComponents() },
    { "fan", NonManifoldFan() }, { "slivers", Slivers() } };
  // Triangles without area count for nothing.
  TriangleMesh degenerate = Perturbed(Ellipsoid(2), 0.01, 3);
  degenerate.F.conservativeResize(degenerate.F.rows() + 1, 3);
  degenerate.F.bottomRows(1) << 0, 0, 1;
  named.push_back({ "degenerate", degenerate });
  std::vector<Framed> surfaces;
  for (const Named& one : named)
  {
    const Frame frame = FrameOf(one.mesh.P);
    surfaces.push_back({ one.name, frame.Into(one.mesh.P), one.mesh.F });
  }
  return surfaces;
}

const Eigen::Matrix3d Slope =
  (Eigen::Matrix3d() << 0.7, -0.4, 0.2, 1.1, 0.3, -0.6, 0.5, -0.9, 0.8).finished();
const Eigen::RowVector3d Offset(0.3, -0.7, 0.4);

/// x -> Slope x + Offset
Points Linear(const Points& x)
{
  return (x * Slope.transpose()).rowwise() + Offset;
}

double Largest(const Fields& X)
{
  return X.allFinite() ? X.cwiseAbs().maxCoeff() : INFINITY;
}

void Sums(const Framed& s, double size)
{
  const std::string what = s.name + ", s " + std::to_string(size);
  const SurfaceGrid grid(s.P, s.F, size, 2);
  const double area = TriangleAreas(s.P, s.F).sum();
  CHECK_NEAR(grid.GetWeights().sum(), area, 1e-12 * area, what + ": sum of the weights");
  CHECK(grid.GetWeights().minCoeff() > 0.0, what << ": a sample has no area");
  Eigen::RowVector3d vectors = Eigen::RowVector3d::Zero();
  Eigen::RowVector3d moment = Eigen::RowVector3d::Zero();
  for (Eigen::Index f = 0; f < s.F.rows(); ++f)
  {
    const Vector a = s.P.row(s.F(f, 0)), b = s.P.row(s.F(f, 1)), c = s.P.row(s.F(f, 2));
    vectors += 0.5 * (b - a).cross(c - a).transpose();
    moment += 0.5 * (b - a).cross(c - a).norm() * (a + b + c).transpose() / 3.0;
  }
  CHECK((grid.GetAreaVectors().colwise().sum() - vectors).norm() <= 1e-12 * area,
    what << ": the area vectors do not add up");
  CHECK((grid.GetWeights().transpose() * grid.GetPlaces() - moment).norm() <= 1e-12 * area,
    what << ": the first moments of the area do not add up");
  double widest = 0.0;
  for (int k = 0; k < grid.GetNumberOfSamples(); ++k)
  {
    CHECK(grid.GetAreaVectors().row(k).norm() <= grid.GetWeights()(k) * (1.0 + 1e-12),
      what << ": an area vector is longer than its area");
    widest = std::max(widest, grid.GetSpreads()[k].trace());
  }
  // The diagonal of half a sub-cell, squared.
  CHECK(widest <= 3.0 * std::pow(0.5 * grid.GetSpacing() / 3.0, 2) * 4.0,
    what << ": a sample is as wide as " << std::sqrt(widest));
}

void LinearFields(const Framed& s, double size)
{
  const std::string what = s.name + ", s " + std::to_string(size);
  SurfaceGrid grid(s.P, s.F, size, 2);
  const Fields means = grid.Means(Linear(s.P), 1);
  CHECK(Largest(means - Fields(Linear(grid.GetPlaces()))) < 1e-12,
    what << ": means of a linear field are not its values at the places");
  // G = Slope (I - n n^T) where the sample is flat; in all of them, seen from its own triangles.
  const Fields gradients = grid.Gradients(Linear(s.P), 2);
  const Fields places = grid.Gradients(s.P, 2);
  double worst = 0.0;
  for (int k = 0; k < grid.GetNumberOfSamples(); ++k)
  {
    Eigen::Matrix3d G, T;
    G << gradients.row(k).segment<3>(0), gradients.row(k).segment<3>(3),
      gradients.row(k).segment<3>(6);
    T << places.row(k).segment<3>(0), places.row(k).segment<3>(3), places.row(k).segment<3>(6);
    worst = std::max(worst, (G - Slope * T).cwiseAbs().maxCoeff());
    CHECK(std::abs(T.trace() - 2.0) < 1e-9,
      what << ": the mean of I - n n^T has the trace " << T.trace());
    CHECK((T - T.transpose()).cwiseAbs().maxCoeff() < 1e-9, what << ": I - n n^T is not symmetric");
  }
  CHECK(worst < 1e-9, what << ": gradients of a linear field differ by " << worst);

  // B-splines add up to 1.
  const Fields ones = Fields::Ones(grid.GetNumberOfFunctions(), 5);
  CHECK(Largest(grid.AtPoints(ones, s.P, 2) - Fields::Ones(s.P.rows(), 5)) < 1e-13,
    what << ": the functions do not add up to 1 at the points");
  CHECK(Largest(grid.AtSamples(ones, 2) - Fields::Ones(grid.GetNumberOfSamples(), 5)) < 1e-13,
    what << ": the functions do not add up to 1 at the samples");
  // Smoothing keeps constants, but for the small multiple of I in the matrix.
  grid.Factor({}, 2);
  const Fields one = grid.Smooth(Fields::Ones(grid.GetNumberOfSamples(), 1), 2);
  const double constant = Largest(grid.AtPoints(one, s.P, 1) - Fields::Ones(s.P.rows(), 1));
  CHECK(constant < 1e-3, what << ": a constant differs by " << constant << " after smoothing");
  // The linear field with the gradient that K takes from it put back, without slopes across.
  Fields Y(grid.GetNumberOfSamples(), 9);
  const Fields X = Linear(grid.GetPlaces());
  for (int k = 0; k < grid.GetNumberOfSamples(); ++k)
  {
    Y.row(k) = size * size * grid.GetWeights()(k) * gradients.row(k);
  }
  SurfaceGrid along(s.P, s.F, size, 2);
  along.FactorAlong(2);
  const Fields linear = along.AtPoints(along.Solve(X, Y, 2), s.P, 2);
  const double difference = Largest(linear - Fields(Linear(s.P)));
  std::cout << what << ": " << grid.GetNumberOfFunctions() << " functions, "
            << grid.GetNumberOfSamples() << " samples; constants within " << constant
            << ", linear fields within " << difference << std::endl;
  CHECK(difference < 1e-3, what << ": a linear field differs by " << difference);
  // Smoothing brings nothing beyond what is there.
  Meshes::Random random(5);
  Fields noise(grid.GetNumberOfSamples(), 2);
  for (Eigen::Index i = 0; i < noise.size(); ++i)
  {
    noise.data()[i] = random.Signed();
  }
  const auto M = grid.GetWeights().asDiagonal();
  const Fields smooth = grid.AtSamples(grid.Smooth(noise, 2), 2);
  // <x, S y> is symmetric, positive, and no more than <x, x>.
  const Eigen::Matrix2d products = noise.transpose() * M * smooth;
  const Eigen::Matrix2d plain = noise.transpose() * M * noise;
  CHECK_NEAR(products(0, 1), products(1, 0), 1e-12 * plain.norm(), what + ": symmetry");
  CHECK(products(0, 0) > 0.0 && products(0, 0) < plain(0, 0) && products(1, 1) > 0.0 &&
      products.determinant() > 0.0,
    what << ": smoothing is not positive definite");
  // Linear in its input, and columns do not meet.
  Fields wide(noise.rows(), 14);
  for (int j = 0; j < 14; ++j)
  {
    wide.col(j) = noise.col(0) + 0.3 * j * noise.col(1);
  }
  const Fields coefficients = grid.Smooth(wide, 2);
  const Fields both = grid.Smooth(noise, 1);
  const Fields ofWide = grid.AtPoints(coefficients, s.P, 2);
  const Fields ofBoth = grid.AtPoints(both, s.P, 2);
  for (int j = 0; j < 14; ++j)
  {
    CHECK(Largest(ofWide.col(j) - ofBoth.col(0) - 0.3 * j * ofBoth.col(1)) < 1e-9,
      what << ": column " << j << " is not what it would be alone");
  }
}

/// Pairs leave constants as they are, and those of the same two cells add up.
void Pairs(const Framed& s)
{
  SurfaceGrid grid(s.P, s.F, 0.06, 1);
  // Along an edge.
  Points ends = s.P(std::vector<int>{ s.F(0, 0), s.F(0, 1) }, AllColumns);
  ends.row(1) = ends.row(0) +
    std::min(1.0, 0.1 / (ends.row(1) - ends.row(0)).norm()) * (ends.row(1) - ends.row(0));
  const Fields X = grid.GetPlaces().col(0);
  for (const double weight : { 1e-2, 1.0, 1e2 })
  {
    grid.Factor({ { ends.row(0), ends.row(1), weight } }, 1);
    const Fields one =
      grid.AtPoints(grid.Smooth(Fields::Ones(grid.GetNumberOfSamples(), 1), 1), s.P, 1);
    CHECK(Largest(one - Fields::Ones(s.P.rows(), 1)) < 1e-3, s.name << ": a pair moves constants");
    // Half of it twice, either way round, is the same.
    const Fields expected = grid.Smooth(X, 1);
    grid.Factor(
      { { ends.row(0), ends.row(1), 0.5 * weight }, { ends.row(1), ends.row(0), 0.5 * weight } },
      1);
    CHECK(Largest(grid.AtPoints(grid.Smooth(X, 1) - expected, s.P, 1)) < 1e-10,
      s.name << ": two halves of a pair differ from the whole");
  }
}

/// A plate, 1 above and -1 below: pairs through it leave of that what the formula says. Far from
/// the rim, with a pair of weight q w_k from each sample on both sides, u the value above:
/// (u - 1) + 2 s^2 q (u - (-u)) + c u = 0, with c for the slope across, which is there without
/// pairs.
void Walls()
{
  constexpr double Size = 0.1;
  const double spacing = Size / 1.5;
  Meshes::Random random(11);
  for (int turn = 0; turn < 3; ++turn)
  {
    const Eigen::Matrix3d R =
      turn == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : random.Rotation();
    for (const double cells : { 0.8, 1.3, 1.7, 2.9 })
    {
      const double d = cells * spacing;
      const TriangleMesh plate = Meshes::Turned(Meshes::Box(24, { 0.6, 0.35, 0.5 * d }), R);
      SurfaceGrid grid(plate.P, plate.F, Size, 2);
      const Points places = grid.GetPlaces() * R;
      Fields X = Fields::Zero(places.rows(), 1);
      for (Eigen::Index k = 0; k < X.rows(); ++k)
      {
        X(k, 0) = std::abs(places(k, 2)) < 0.499 * d ? 0.0 : places(k, 2) > 0.0 ? 1.0 : -1.0;
      }
      const auto above = [&](double stiffness)
      {
        std::vector<GridPair> pairs;
        for (Eigen::Index k = 0; k < X.rows() && stiffness > 0.0; ++k)
        {
          if (X(k, 0) != 0.0)
          {
            const Vector u = grid.GetPlaces().row(k);
            pairs.push_back(
              { u, u - d * X(k, 0) * R.col(2), stiffness / (Size * Size) * grid.GetWeights()(k) });
          }
        }
        grid.Factor(pairs, 2);
        const Fields at = grid.AtSamples(grid.Smooth(X, 2), 2);
        double sum = 0.0;
        int count = 0;
        for (Eigen::Index k = 0; k < X.rows(); ++k)
        {
          if (X(k, 0) == 1.0 && std::abs(places(k, 0)) < 0.25 && std::abs(places(k, 1)) < 0.12)
          {
            sum += at(k, 0);
            ++count;
          }
        }
        return sum / count;
      };
      const double without = above(0.0);
      for (const double stiffness : { 0.5, 5.0 })
      {
        const double with = above(stiffness);
        const double expected = 1.0 / (1.0 / without + 4.0 * stiffness);
        std::cout << "a wall of " << cells << " cells, turn " << turn << ", s^2 q " << stiffness
                  << ": pairs leave " << with << " of " << without << ", should be " << expected
                  << std::endl;
        CHECK_NEAR(with, expected, 0.01, "what pairs leave of a difference");
      }
    }
  }
}

/// The slope across a sheet says nothing of fields that go straight outward.
void Straight()
{
  Meshes::Random random(3);
  constexpr double Size = 0.08;
  for (int turn = 0; turn < 3; ++turn)
  {
    const Eigen::Matrix3d R = random.Rotation();
    const TriangleMesh sheet =
      Meshes::Turned(Meshes::Scaled(Meshes::Patch(14, 0.0), { 0.4, 0.4, 1.0 }), R);
    SurfaceGrid grid(sheet.P, sheet.F, Size, 2);
    grid.Factor({}, 2);
    const Fields X = Linear(grid.GetPlaces());
    Fields Y = grid.Gradients(Linear(sheet.P), 2);
    for (int k = 0; k < grid.GetNumberOfSamples(); ++k)
    {
      Y.row(k) *= Size * Size * grid.GetWeights()(k);
    }
    const Fields field = grid.AtPoints(grid.Solve(X, Y, 2), sheet.P, 2);
    const double difference = Largest(field - Fields(Linear(sheet.P)));
    std::cout << "turned sheet " << turn << ": a linear field within " << difference << std::endl;
    CHECK(difference < 1e-4, "a linear field on a turned sheet differs by " << difference);
  }
}

/// A scale beside a sheet is much smaller than s, and alone would shrink to a point: it moves along
/// with the sheet, wherever borders of cells and sub-cells lie between them.
void Scales()
{
  constexpr double Size = 0.06;
  constexpr double Half = 0.02; // of the scale
  const double subCell = Size / 4.5;
  double least = 1.0;
  double most = 0.0;
  for (int shift = 0; shift < 9; ++shift)
  {
    const double z = subCell * shift / 3.0;
    const TriangleMesh sheet =
      Meshes::Moved(Meshes::Scaled(Meshes::Patch(40, 0.0), { 0.4, 0.4, 1.0 }), { 0.0, 0.0, z });
    const TriangleMesh scale = Meshes::Moved(
      Meshes::Scaled(Meshes::Patch(6, 0.0), { Half, Half, 1.0 }), { 0.0, 0.0, z + 0.5 * subCell });
    const TriangleMesh both = Meshes::Together({ sheet, scale });
    SurfaceGrid grid(both.P, both.F, Size, 2);
    grid.Factor({}, 2);
    const Fields base = grid.AtPoints(grid.SmoothTwice(Fields(grid.GetPlaces()), 2), both.P, 2);
    const auto ofScale = base.bottomRows(scale.P.rows()).col(0);
    const double width = (ofScale.maxCoeff() - ofScale.minCoeff()) / (2.0 * Half);
    std::cout << "a scale " << shift << " thirds of a sub-cell on: its base is " << width
              << " as wide" << std::endl;
    least = std::min(least, width);
    most = std::max(most, width);
  }
  CHECK(
    least > 0.5 && most < 1.1, "the base of a scale is " << least << " to " << most << " as wide");
}

/// K Y = grad^T g gives back a field with these gradients, but for a constant.
void Poisson(const Framed& s)
{
  SurfaceGrid grid(s.P, s.F, 0.06, 2);
  grid.FactorPoisson(2);
  Fields g = grid.Gradients(Linear(s.P), 1);
  for (int k = 0; k < grid.GetNumberOfSamples(); ++k)
  {
    g.row(k) *= grid.GetWeights()(k);
  }
  const Fields Y =
    grid.AtPoints(grid.Solve(Fields::Zero(grid.GetNumberOfSamples(), 3), g, 2), s.P, 1);
  const Fields difference = Y - Fields(Linear(s.P)); // one constant for each part
  double largest = 0.0;
  for (Eigen::Index f = 0; f < s.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      largest =
        std::max(largest, (difference.row(s.F(f, k)) - difference.row(s.F(f, (k + 1) % 3))).norm());
    }
  }
  CHECK(largest < 2e-3,
    s.name << ": the gradient of a linear field leads to another, by " << largest << " an edge");
}

void Threads(const Framed& s)
{
  const auto bits = [&](int threads)
  {
    SurfaceGrid grid(s.P, s.F, 0.05, threads);
    grid.Factor(FindWalls(grid, s.P, s.F, threads), threads);
    const Fields coefficients = grid.Smooth(grid.Means(Linear(s.P), threads), threads);
    const Fields at = grid.AtPoints(coefficients, s.P, threads);
    const Fields samples = grid.AtSamples(coefficients, threads);
    const Fields gradients = grid.Gradients(Linear(s.P), threads);
    std::vector<double> all(at.data(), at.data() + at.size());
    all.insert(all.end(), samples.data(), samples.data() + samples.size());
    all.insert(all.end(), gradients.data(), gradients.data() + gradients.size());
    all.insert(
      all.end(), grid.GetPlaces().data(), grid.GetPlaces().data() + grid.GetPlaces().size());
    return all;
  };
  const std::vector<double> expected = bits(1);
  for (const int threads : { 2, 3, 7 })
  {
    CHECK(bits(threads) == expected, s.name << ": " << threads << " threads change bits");
  }
}

void Coarser(const Framed& s)
{
  SurfaceGrid fine(s.P, s.F, 0.03, 2);
  CHECK(!fine.IsCoarser(), s.name << ": a grid of .03 is coarser");
  CHECK_NEAR(fine.GetSpacing(), 0.02, 1e-15, s.name + ": spacing");
  const SurfaceGrid grid(s.P, s.F, 0.004, 2);
  CHECK(grid.IsCoarser() && grid.GetSpacing() > 0.004 / 1.5 && grid.GetSize() == 0.004,
    s.name << ": a grid of .004 is not coarser, spacing " << grid.GetSpacing());
  CHECK(grid.GetNumberOfFunctions() <= SurfaceGrid::MaximumNumberOfFunctions &&
      grid.GetNumberOfFunctions() > SurfaceGrid::MaximumNumberOfFunctions / 4,
    s.name << ": " << grid.GetNumberOfFunctions() << " functions");
  // The number of functions depends on area and spacing.
  const double per =
    fine.GetNumberOfFunctions() * std::pow(fine.GetSpacing(), 2) / TriangleAreas(s.P, s.F).sum();
  std::cout << s.name << ": " << per << " functions per spacing^2" << std::endl;
  CHECK(per > 2.0 && per < 15.0, s.name << ": " << per << " functions per spacing^2");
}

/// kB
long PeakMemory()
{
  rusage used = {};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss;
}

/// A sheet is cut into as many parts as a grid could have, and not into those of a size that cannot
/// be had: these would take 2.8 GB. At any number of threads it ends with the same grid.
void Sheet()
{
  const long before = PeakMemory();
  const TriangleMesh sheet = Meshes::Patch(1, 0.0);
  const Framed s = { "a sheet", FrameOf(sheet.P).Into(sheet.P), sheet.F };
  const SurfaceGrid one(s.P, s.F, 0.0005, 1);
  const SurfaceGrid grid(s.P, s.F, 0.0005, 2);
  CHECK(grid.IsCoarser() && grid.GetNumberOfFunctions() > SurfaceGrid::MaximumNumberOfFunctions / 4,
    s.name << ": " << grid.GetNumberOfFunctions() << " functions");
  CHECK(one.GetSpacing() == grid.GetSpacing(),
    s.name << ": spacing " << one.GetSpacing() << " or " << grid.GetSpacing());
  const long more = PeakMemory() - before;
  CHECK(more < 500000, s.name << ": " << more << " kB");
  const SurfaceGrid least(s.P, s.F, std::numeric_limits<double>::denorm_min(), 2);
  CHECK(least.IsCoarser() && least.GetNumberOfFunctions() > 0, s.name << ": the least size");
}

/// The grid at some of the samples: at all of them it is the same, and at those of one of two
/// surfaces that are far from each other it gives what both give there.
void AtSome(const Framed& two)
{
  SurfaceGrid whole(two.P, two.F, 0.05, 1);
  const int m = whole.GetNumberOfSamples();
  std::vector<int> all(m);
  std::iota(all.begin(), all.end(), 0);
  SurfaceGrid same = whole.At(all);
  const Fields X = Linear(whole.GetPlaces());
  whole.Factor({}, 1);
  same.Factor({}, 1);
  const Fields smooth = whole.AtSamples(whole.Smooth(X, 1), 1);
  CHECK(Largest(same.AtSamples(same.Smooth(X, 1), 1) - smooth) == 0.0, "all samples are the grid");

  std::vector<int> some = all; // beyond the widest gap along x
  const auto x = [&whole](int k) { return whole.GetPlaces()(k, 0); };
  std::sort(some.begin(), some.end(), [&](int k, int l) { return x(k) < x(l); });
  int after = 1;
  for (int i = 1; i < m; ++i)
  {
    after = x(some[i]) - x(some[i - 1]) > x(some[after]) - x(some[after - 1]) ? i : after;
  }
  some.erase(some.begin(), some.begin() + after);
  std::sort(some.begin(), some.end());
  SurfaceGrid part = whole.At(some);
  CHECK(part.GetNumberOfSamples() < m && part.GetNumberOfSamples() > 0 &&
      part.GetNumberOfFunctions() < whole.GetNumberOfFunctions(),
    "some samples have some functions");
  part.Factor({}, 1);
  const Fields there = part.AtSamples(part.Smooth(Linear(part.GetPlaces()), 1), 1);
  // The ridge is a share of the mean diagonal, which is that of both or of one.
  CHECK(Largest(there - Fields(smooth(some, AllColumns))) < 3e-4,
    "a part of its own differs by " << Largest(there - Fields(smooth(some, AllColumns))));
  CHECK_NEAR(
    part.GetWeights().sum(), Eigen::VectorXd(whole.GetWeights()(some)).sum(), 1e-15, "its area");
}

/// Nothing lies outside of the surface's cells.
void Outside(const Framed& s)
{
  SurfaceGrid grid(s.P, s.F, 0.02, 1);
  grid.Factor({}, 1);
  const Fields ones = grid.Smooth(Fields::Ones(grid.GetNumberOfSamples(), 1), 1);
  CHECK(grid.AtPoints(ones, Points::Zero(1, 3), 1)(0, 0) == 0.0,
    "a field is not 0 where there is no function");
}
}

int main()
{
  const std::vector<Framed> surfaces = Surfaces();
  for (const Framed& s : surfaces)
  {
    for (const double size : { 0.15, 0.05 })
    {
      Sums(s, size);
      LinearFields(s, size);
    }
    Pairs(s);
    Poisson(s);
    Threads(s);
  }
  Walls();
  Straight();
  Scales();
  Coarser(surfaces.front());
  Sheet();
  Outside(surfaces.front());
  AtSome(*std::find_if(
    surfaces.begin(), surfaces.end(), [](const Framed& s) { return s.name == "two parts"; }));
  return CheckResult();
}
