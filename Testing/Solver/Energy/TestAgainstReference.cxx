// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The solver against the naive reference after exactly 1, 5 and 20 iterations, for every
// combination of the options that change the formula.
#include "Check.h"
#include "Meshes.h"
#include "NaiveReference.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <string>

using namespace SphericalStyle;

namespace
{
struct Case
{
  std::string name;
  TriangleMesh mesh;
};

// Closed, obtuse, open, in two parts, non-manifold. Every one is perturbed: on symmetric meshes the
// concave test meets products that are zero but for rounding.
std::vector<Case> Cases()
{
  return { { "ellipsoid", Meshes::Perturbed(Meshes::Ellipsoid(1), 0.03, 1) },
    { "house", Meshes::Perturbed(Meshes::House(5), 0.02, 2) },
    { "patch", Meshes::Perturbed(Meshes::Patch(6, 0.4), 0.03, 3) },
    { "two components", Meshes::TwoComponents() }, { "fan", Meshes::NonManifoldFan() } };
}

struct Worst
{
  double position = 0.0;
  double energy = 0.0;
  double conditioning = 1.0;
};

Eigen::VectorXd RoundnessFactors(const TriangleMesh& mesh)
{
  Eigen::VectorXd factors(mesh.P.rows());
  for (int i = 0; i < factors.size(); ++i)
  {
    factors[i] = 1.1 + std::sin(3.0 * mesh.P(i, 0) + 2.0 * mesh.P(i, 2));
  }
  return factors;
}

std::string Describe(const StyleOptions& o)
{
  std::ostringstream text;
  text << "lambda " << o.lambda << " a " << o.normalBlend
       << (o.edgeWeighting == EdgeWeighting::FullEdge ? " full" : " half")
       << (o.sphericalWeighting == SphericalWeighting::Uniform ? " uniform" : " cotangent")
       << " concave " << static_cast<int>(o.concaveEdges)
       << (o.anchor == Anchor::Centroid ? " centroid" : " last point")
       << (o.initialGuess == InitialGuess::Blend ? " blend" : " rest")
       << (o.roundnessFactors.size() > 0 ? " factors" : "") << " center "
       << static_cast<int>(o.centerMode) << " radius " << static_cast<int>(o.radiusMode);
  return text.str();
}

void Compare(StyleSolver& solver, const Case& c, StyleOptions options, Worst& worst)
{
  const std::string what = c.name + ": " + Describe(options);
  const double diagonal = Meshes::Diagonal(c.mesh.P);
  options.loop.stopRule = StopRule::FixedIterations;
  options.loop.acceleration = false;
  NaiveReference reference(c.mesh, options);
  int done = 0;
  for (const int iterations : { 1, 5, 20 })
  {
    for (; done < iterations; ++done)
    {
      reference.Iterate();
    }
    options.loop.maximumNumberOfIterations = iterations;
    const StyleReport report = solver.Solve(options);
    const std::string when = what + ", iteration " + std::to_string(iterations);

    const double difference =
      Meshes::Distance(solver.GetPositions(), reference.GetPositions()) / diagonal;
    worst.position = std::max(worst.position, difference);
    CHECK(difference <= 1e-9,
      when << ": positions differ from the reference by " << difference
           << " diagonals, should be below 1e-9; conditioning " << reference.GetConditioning());

    const EnergyTerms expected = reference.Energy();
    const EnergyTerms energy = report.loop.history.back().energy;
    const double scale = expected.Total();
    const double error = std::max({ std::abs(energy.rigid - expected.rigid),
                           std::abs(energy.spherical - expected.spherical),
                           std::abs(energy.Total() - expected.Total()) }) /
      scale;
    worst.energy = std::max(worst.energy, error);
    CHECK(error <= 1e-9,
      when << ": energies are " << energy.rigid << " + " << energy.spherical << ", should be "
           << expected.rigid << " + " << expected.spherical << "; conditioning "
           << reference.GetConditioning());
    const double cells =
      (solver.GetCellEnergies() - reference.CellEnergies()).cwiseAbs().maxCoeff() / scale;
    CHECK(cells <= 1e-9, when << ": cell energies differ by " << cells << " of the total");

    if (!report.closedForm) // which counts no iterations
    {
      CHECK(report.loop.iterations == iterations,
        when << ": " << report.loop.iterations << " iterations were done");
    }
    CHECK((solver.GetDirections() - reference.GetDirections()).cwiseAbs().maxCoeff() <= 1e-12,
      when << ": directions differ from the reference");
    CHECK_NEAR(report.sphere.radius, reference.GetRadius(), 1e-12 * diagonal, when + ": radius");
    CHECK((report.sphere.center - reference.GetCenter()).norm() <= 1e-12 * diagonal,
      when << ": the center differs from the reference");
    CHECK(options.concaveEdges == ConcaveEdges::Keep ||
        report.concaveHalfEdges == reference.GetFlipped(),
      when << ": " << report.concaveHalfEdges << " concave half-edges, should be "
           << reference.GetFlipped());
  }
  worst.conditioning = std::min(worst.conditioning, reference.GetConditioning());
}

void Print(const std::string& name, const Worst& worst)
{
  std::cout << name << ": positions " << worst.position << " diagonals, energy " << worst.energy
            << ", conditioning " << worst.conditioning << std::endl;
}

void TestEveryCombination()
{
  for (const Case& c : Cases())
  {
    StyleSolver solver;
    solver.SetMesh(c.mesh);
    Worst worst;
    for (int bits = 0; bits < 32; ++bits)
    {
      const auto bit = [bits](int k) { return ((bits >> k) & 1) != 0; };
      StyleOptions options;
      options.lambda = 0.7;
      options.edgeWeighting = bit(0) ? EdgeWeighting::FullEdge : EdgeWeighting::HalfEdge;
      options.sphericalWeighting =
        bit(1) ? SphericalWeighting::Cotangent : SphericalWeighting::Uniform;
      options.anchor = bit(2) ? Anchor::LastPoint : Anchor::Centroid;
      options.initialGuess = bit(3) ? InitialGuess::Rest : InitialGuess::Blend;
      if (bit(4))
      {
        options.roundnessFactors = RoundnessFactors(c.mesh);
      }
      for (const ConcaveEdges concave :
        { ConcaveEdges::Keep, ConcaveEdges::Flip, ConcaveEdges::Zero })
      {
        for (const double a : { 0.0, 0.5, 1.0 })
        {
          options.concaveEdges = concave;
          options.normalBlend = a;
          Compare(solver, c, options, worst);
        }
      }
    }
    Print(c.name, worst);
  }
}

// Options that do not multiply with the others: the sphere, arrays given by the user, fixed points.
void TestSphereAndArrays()
{
  for (const Case& c : Cases())
  {
    const int n = c.mesh.P.rows();
    StyleSolver solver;
    solver.SetMesh(c.mesh);
    Worst worst;
    StyleOptions basic;
    basic.normalBlend = 0.3;
    basic.custom.center = { 0.21, -0.13, 0.17 };
    basic.custom.radius = 0.83;
    for (const CenterMode center :
      { CenterMode::PointMean, CenterMode::AreaCentroid, CenterMode::Custom })
    {
      for (const RadiusMode radius :
        { RadiusMode::EqualArea, RadiusMode::EqualVolume, RadiusMode::Custom })
      {
        StyleOptions options = basic;
        options.centerMode = center;
        options.radiusMode = radius;
        Compare(solver, c, options, worst);
      }
    }
    for (const double lambda : { 0.05, 5.0 })
    {
      StyleOptions options = basic;
      options.lambda = lambda;
      Compare(solver, c, options, worst);
    }

    Meshes::Random random(17);
    StyleOptions options = basic;
    options.normalBlends.resize(n);
    for (int i = 0; i < n; ++i)
    {
      options.normalBlends[i] = random.Unit();
    }
    Compare(solver, c, options, worst);
    options.normals = c.mesh.P; // unit, and clearly not the computed ones
    options.normals.rowwise() -= Eigen::RowVector3d(0.1, 0.3, 0.05);
    options.normals.rowwise().normalize();
    Compare(solver, c, options, worst);

    options = basic;
    options.targets = c.mesh.P * 0.5;
    options.targets.col(0) += 0.3 * c.mesh.P.col(1).cwiseAbs2();
    Compare(solver, c, options, worst);
    options.concaveEdges = ConcaveEdges::Flip;
    Compare(solver, c, options, worst);

    options = basic;
    options.fixedPoints = { 7, 3, n - 2 };
    options.fixedPositions.resize(3, 3);
    options.fixedPositions.row(0) = c.mesh.P.row(7);
    options.fixedPositions.row(1) = c.mesh.P.row(3) * 1.1;
    options.fixedPositions.row(2) = c.mesh.P.row(n - 2) + Eigen::RowVector3d(0.05, 0.1, -0.05);
    for (const Anchor anchor : { Anchor::Centroid, Anchor::LastPoint })
    {
      for (const InitialGuess guess : { InitialGuess::Blend, InitialGuess::Rest })
      {
        for (const SphericalWeighting weighting :
          { SphericalWeighting::Uniform, SphericalWeighting::Cotangent })
        {
          options.anchor = anchor;
          options.initialGuess = guess;
          options.sphericalWeighting = weighting;
          Compare(solver, c, options, worst);
        }
      }
    }
    // One fixed point: the component is held by it alone, not by its centroid.
    options.fixedPoints.resize(1);
    options.fixedPositions.conservativeResize(1, 3);
    Compare(solver, c, options, worst);
    Print(c.name + ", sphere and arrays", worst);
  }
}

// 3 x 3 matrix of sum_h k_h |e'_h|^2 over the half-edges of one triangle.
Eigen::Matrix3d TriangleMatrix(const Eigen::Vector3d& k)
{
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  for (int h = 0; h < 3; ++h)
  {
    const int u = HalfEdgeStart(h), v = HalfEdgeEnd(h);
    A(u, u) += k[h];
    A(v, v) += k[h];
    A(u, v) -= k[h];
    A(v, u) -= k[h];
  }
  return A;
}

// Why cotangent spherical weights take lambda as the mean of the triangle, not of the edge.
void TestTriangleMeanOfLambda()
{
  // Angles 150 (at point 0), 15 and 15 degrees.
  const double height = std::tan(Meshes::Pi / 12.0);
  const TriangleMesh mesh =
    Meshes::Make({ { 0, height, 0 }, { -1, 0, 0 }, { 1, 0, 0 } }, { { 0, 1, 2 } });
  const HalfEdgeScalars c = HalfEdgeCotangents(mesh.P, mesh.F);
  CHECK_NEAR(c(0, 0), 0.5 / std::tan(150.0 * Meshes::Pi / 180.0), 1e-14, "c at 150 degrees");
  CHECK_NEAR(c(0, 1), 0.5 / std::tan(15.0 * Meshes::Pi / 180.0), 1e-14, "c at 15 degrees");

  // Round at the acute corners only: the long edge, whose cotangent is negative, is round in full,
  // the short edges that have to outweigh it are so by half.
  const Eigen::Vector3d lambda(0.0, 10.0, 10.0);
  Eigen::Vector3d edgeMean, triangleMean;
  for (int h = 0; h < 3; ++h)
  {
    const double ofEdge = 0.5 * (lambda[HalfEdgeStart(h)] + lambda[HalfEdgeEnd(h)]);
    edgeMean[h] = c(0, h) * (1.0 + std::sqrt(3.0) * ofEdge);
    triangleMean[h] = c(0, h) * (1.0 + std::sqrt(3.0) * lambda.mean());
  }
  using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;
  const double edge = Solver(TriangleMatrix(edgeMean)).eigenvalues()[0];
  const double triangle = Solver(TriangleMatrix(triangleMean)).eigenvalues()[0];
  std::cout << "lambda on an obtuse triangle: least eigenvalue " << edge
            << " with the mean of the edge, " << triangle << " with that of the triangle"
            << std::endl;
  CHECK(
    edge < -0.01, "the edge mean should make the form negative, its least eigenvalue is " << edge);
  CHECK(std::abs(triangle) < 1e-12,
    "the triangle mean should leave 0 (translation) as least eigenvalue, not " << triangle);

  const EdgeWeights weights =
    ComputeEdgeWeights(c, mesh.F, lambda, EdgeWeighting::HalfEdge, SphericalWeighting::Cotangent);
  for (int h = 0; h < 3; ++h)
  {
    CHECK_NEAR(weights.c(0, h) + weights.l(0, h), triangleMean[h], 1e-13, "the solver's weight");
  }
}

// A skewed sheet whose diagonals are the long ones: w_uv < 0 there. The letter of Eq. 4.13 lets a
// cell see such a weight without the triangle that would make up for it. Energies of cells fall
// below zero and rotations get close to undetermined (s_2 ~ -s_3), where two right programs part by
// rounding: no comparison of positions is asked for there. The half-edge form is fine on the same
// mesh and is compared.
void TestFullEdge()
{
  Case c{ "skewed sheet", Meshes::Perturbed(Meshes::Patch(6, 0.3), 0.02, 8) };
  c.mesh.P.col(0) += 1.6 * c.mesh.P.col(1);
  StyleOptions options;
  options.lambda = 0.1;
  CHECK(Meshes::CountObtuse(c.mesh) >= 0.7 * c.mesh.F.rows(),
    "the sheet should be obtuse, has " << Meshes::CountObtuse(c.mesh) << " obtuse triangles of "
                                       << c.mesh.F.rows());
  StyleSolver solver;
  solver.SetMesh(c.mesh);
  Worst worst;
  Compare(solver, c, options, worst);
  Print(c.name, worst);

  NaiveReference half(c.mesh, options);
  options.edgeWeighting = EdgeWeighting::FullEdge;
  NaiveReference full(c.mesh, options);
  double least = 0.0;
  for (int k = 0; k < 30; ++k)
  {
    half.Iterate();
    full.Iterate();
    least = std::min(least, full.CellEnergies().minCoeff());
    CHECK(half.CellEnergies().minCoeff() >= 0.0, "half-edge cells should have energies >= 0");
  }
  std::cout << "full edges there: least cell energy " << least << ", conditioning "
            << full.GetConditioning() << " (half edges " << half.GetConditioning() << ")"
            << std::endl;
  CHECK(least < 0.0, "full-edge weights should make a cell's energy negative");
}
} // namespace

int main()
{
  std::cout.precision(3);
  TestTriangleMeanOfLambda();
  TestFullEdge();
  TestSphereAndArrays();
  TestEveryCombination();
  return CheckResult();
}
