// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Weights, targets and the energy: identities that hold for each of them alone.
#include "CellCoefficients.h"
#include "Check.h"
#include "DeformationMeasures.h"
#include "Meshes.h"
#include "StyleEnergy.h"
#include "SurfaceMeasures.h"
#include "TargetDirections.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>

using namespace SphericalStyle;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
using Meshes::Named;

std::vector<Named> AllMeshes()
{
  return { { "tetrahedron", Meshes::Tetrahedron() }, { "icosphere", Meshes::Icosphere(2) },
    { "ellipsoid", Meshes::EllipsoidUV() }, { "box", Meshes::Box(4) },
    { "perturbed box", Meshes::Perturbed(Meshes::Box(4), 0.1, 1) }, { "house", Meshes::House() },
    { "patch", Meshes::Patch(8, 0.4) }, { "two components", Meshes::TwoComponents() },
    { "fan", Meshes::NonManifoldFan() }, { "three at an edge", Meshes::ThreeAtAnEdge() },
    { "slivers", Meshes::Slivers() } };
}

Points RandomPoints(int n, Meshes::Random& random)
{
  Points x(n, 3);
  for (int i = 0; i < n; ++i)
  {
    x.row(i) = random.InCube().transpose();
  }
  return x;
}

Matrices RandomRotations(int n, Meshes::Random& random)
{
  Matrices R(n);
  for (Matrix3d& rotation : R)
  {
    rotation = random.Rotation();
  }
  return R;
}

// An energy with everything in it: per-point lambda and any targets.
StyleEnergy RandomEnergy(const MeshTopology& topology, const Points& P, Meshes::Random& random,
  EdgeWeighting edges, SphericalWeighting spherical, int threads = 1)
{
  const Triangles& F = topology.GetTriangles();
  Eigen::VectorXd lambda(P.rows());
  for (int i = 0; i < lambda.size(); ++i)
  {
    lambda[i] = random.Unit();
  }
  const double size = Meshes::Diagonal(P);
  return StyleEnergy(topology,
    ComputeEdgeWeights(HalfEdgeCotangents(P, F), F, lambda, edges, spherical),
    HalfEdgeDifferences(P, F), HalfEdgeDifferences(0.3 * size * RandomPoints(P.rows(), random), F),
    threads);
}

void TestWeights()
{
  TriangleMesh triangle =
    Meshes::Make({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, std::sqrt(0.75), 0 } }, { { 0, 1, 2 } });
  const double equilateral = 0.5 / std::sqrt(3.0);
  HalfEdgeScalars c = HalfEdgeCotangents(triangle.P, triangle.F);
  for (int k = 0; k < 3; ++k)
  {
    CHECK_NEAR(c(0, k), equilateral, 1e-15, "c of an equilateral triangle");
  }
  // Right angle at point 0: half-edge 0 lies opposite.
  triangle.P << 0, 0, 0, 2, 0, 0, 0, 1, 0;
  c = HalfEdgeCotangents(triangle.P, triangle.F);
  CHECK_NEAR(c(0, 0), 0.0, 1e-16, "c opposite a right angle");
  CHECK_NEAR(c(0, 1), 0.5 * 2.0, 1e-15, "c opposite the angle at point 1 (tangent 1/2)");
  CHECK_NEAR(c(0, 2), 0.5 * 0.5, 1e-15, "c opposite the angle at point 2 (tangent 2)");

  for (const Named& named : AllMeshes())
  {
    const TriangleMesh& mesh = named.mesh;
    c = HalfEdgeCotangents(mesh.P, mesh.F);
    // Area from cotangents: A = sum_h c_h |e_h|^2 / 2.
    const HalfEdgeVectors e = HalfEdgeDifferences(mesh.P, mesh.F);
    double area = 0.0;
    std::map<std::pair<int, int>, double> w;
    for (int f = 0; f < mesh.F.rows(); ++f)
    {
      for (int k = 0; k < 3; ++k)
      {
        area += 0.5 * c(f, k) * e.row(f).segment<3>(3 * k).squaredNorm();
        const int u = mesh.F(f, HalfEdgeStart(k)), v = mesh.F(f, HalfEdgeEnd(k));
        CHECK((e.row(f).segment<3>(3 * k) - (mesh.P.row(u) - mesh.P.row(v))).norm() == 0.0,
          named.name << ": a half-edge should be p_u - p_v");
        w[{ std::min(u, v), std::max(u, v) }] += c(f, k);
      }
    }
    CHECK_NEAR(area / TriangleAreas(mesh.P, mesh.F).sum(), 1.0, 1e-12,
      named.name + ": area from cotangents over area");
    const HalfEdgeScalars sums = EdgeSums(c, mesh.F);
    const double largest = c.cwiseAbs().maxCoeff();
    for (int f = 0; f < mesh.F.rows(); ++f)
    {
      for (int k = 0; k < 3; ++k)
      {
        const int u = mesh.F(f, HalfEdgeStart(k)), v = mesh.F(f, HalfEdgeEnd(k));
        CHECK_NEAR(sums(f, k), (w[{ std::min(u, v), std::max(u, v) }]), 1e-13 * largest,
          named.name + ": w of an edge");
      }
    }

    // The four kinds of weights for one lambda.
    const Eigen::VectorXd lambda = Eigen::VectorXd::Constant(mesh.P.rows(), 0.6);
    const double root = std::sqrt(3.0) * 0.6;
    const auto weights = [&](EdgeWeighting edges, SphericalWeighting spherical)
    { return ComputeEdgeWeights(c, mesh.F, lambda, edges, spherical); };
    const EdgeWeights halfUniform = weights(EdgeWeighting::HalfEdge, SphericalWeighting::Uniform);
    const EdgeWeights halfCot = weights(EdgeWeighting::HalfEdge, SphericalWeighting::Cotangent);
    const EdgeWeights fullUniform = weights(EdgeWeighting::FullEdge, SphericalWeighting::Uniform);
    const EdgeWeights fullCot = weights(EdgeWeighting::FullEdge, SphericalWeighting::Cotangent);
    CHECK(halfUniform.c == c && (halfUniform.l.array() - 0.3).abs().maxCoeff() <= 1e-15,
      named.name << ": half edges, uniform: c_h and lambda / 2");
    CHECK(halfCot.c == c && (halfCot.l - root * c).cwiseAbs().maxCoeff() <= 1e-14 * largest,
      named.name << ": half edges, cotangent: c_h and sqrt(3) lambda c_h");
    CHECK(fullUniform.c == sums && (fullUniform.l.array() - 0.6).abs().maxCoeff() <= 1e-15,
      named.name << ": full edges, uniform: w and lambda");
    CHECK(fullCot.c == sums && (fullCot.l - root * sums).cwiseAbs().maxCoeff() <= 1e-14 * largest,
      named.name << ": full edges, cotangent: w and sqrt(3) lambda w");
    CHECK(halfCot.proportional && fullCot.proportional && !halfUniform.proportional,
      named.name << ": only cotangent weights are proportional");
    CHECK_NEAR(halfCot.ratio, root, 1e-15, named.name + ": l / c");
  }
}

// E is quadratic in Q: its gradient is 2 (L Q - b), here by differences, which are exact but for
// rounding. This ties Evaluate, RightHandSide and the matrix of the global step together.
void TestGradient()
{
  for (const Named& named : AllMeshes())
  {
    for (const EdgeWeighting edges : { EdgeWeighting::HalfEdge, EdgeWeighting::FullEdge })
    {
      for (const SphericalWeighting spherical :
        { SphericalWeighting::Uniform, SphericalWeighting::Cotangent })
      {
        Meshes::Random random(3);
        const Points& P = named.mesh.P;
        const Triangles& F = named.mesh.F;
        const int n = P.rows();
        const MeshTopology topology(F, n);
        StyleEnergy energy = RandomEnergy(topology, P, random, edges, spherical);
        const CellPattern pattern(topology);
        energy.PrepareSteps(pattern);
        const Matrices R = RandomRotations(n, random);
        Points b;
        energy.RightHandSide(R, b);
        const double scale = energy.GetScale() / Meshes::Diagonal(P); // of a gradient
        CHECK(b.colwise().sum().norm() <= 1e-12 * scale,
          named.name << ": the right-hand side should sum to zero");

        // L Q from the weights.
        const auto multiply = [&](const Points& Q)
        {
          Points LQ = Points::Zero(n, 3);
          for (int f = 0; f < F.rows(); ++f)
          {
            for (int k = 0; k < 3; ++k)
            {
              const int u = F(f, HalfEdgeStart(k)), v = F(f, HalfEdgeEnd(k));
              const Eigen::RowVector3d flow = 3.0 *
                (energy.GetWeights().c(f, k) + energy.GetWeights().l(f, k)) * (Q.row(u) - Q.row(v));
              LQ.row(u) += flow;
              LQ.row(v) -= flow;
            }
          }
          return LQ;
        };
        const Points Q = P + 0.2 * RandomPoints(n, random);
        const Points gradient = 2.0 * (multiply(Q) - b);
        for (int k = 0; k < 8; ++k)
        {
          const int i = static_cast<int>(random.Unit() * n), axis = k % 3;
          const double step = 0.5 * Meshes::Diagonal(P);
          Points plus = Q, minus = Q;
          plus(i, axis) += step;
          minus(i, axis) -= step;
          const double ePlus = energy.Evaluate(plus, R).Total();
          const double eMinus = energy.Evaluate(minus, R).Total();
          const double magnitude = std::abs(ePlus) + std::abs(eMinus) + energy.GetScale();
          CHECK_NEAR((ePlus - eMinus) / (2.0 * step), gradient(i, axis), 1e-12 * magnitude / step,
            named.name + ": gradient of the energy");
          // Symmetry and the diagonal: the second difference is 2 L_ii.
          Points unit = Points::Zero(n, 3);
          unit(i, axis) = 1.0;
          CHECK_NEAR((ePlus + eMinus - 2.0 * energy.Evaluate(Q, R).Total()) / (step * step),
            2.0 * multiply(unit)(i, axis), 1e-11 * magnitude / (step * step),
            named.name + ": second difference of the energy");
          const int j = static_cast<int>(random.Unit() * n);
          Points other = Points::Zero(n, 3);
          other(j, axis) = 1.0;
          CHECK_NEAR(multiply(unit)(j, axis), multiply(other)(i, axis), 1e-12 * scale,
            named.name + ": L_ij and L_ji");
        }
        // Row sums: a translation changes nothing.
        const Points constant = Eigen::VectorXd::Ones(n) * Eigen::RowVector3d(1, 2, 3);
        CHECK(multiply(constant).norm() == 0.0, named.name << ": the rows of L should sum to zero");
      }
    }
  }
}

// Covariances are the other derivative: tr((R - R') S) against the energies.
void TestCovariances()
{
  for (const Named& named : AllMeshes())
  {
    Meshes::Random random(4);
    const int n = named.mesh.P.rows();
    const MeshTopology topology(named.mesh.F, n);
    StyleEnergy energy = RandomEnergy(
      topology, named.mesh.P, random, EdgeWeighting::HalfEdge, SphericalWeighting::Uniform);
    const CellPattern pattern(topology);
    energy.PrepareSteps(pattern);
    const Points Q = named.mesh.P + 0.2 * RandomPoints(n, random);
    const Matrices R = RandomRotations(n, random), other = RandomRotations(n, random);
    Matrices S;
    energy.Covariances(Q, S);
    const Eigen::VectorXd cells = energy.CellEnergies(Q, R),
                          otherCells = energy.CellEnergies(Q, other);
    for (int y = 0; y < n; ++y)
    {
      CHECK_NEAR(otherCells[y] - cells[y], -2.0 * ((other[y] - R[y]) * S[y]).trace(),
        1e-12 * energy.GetScale(), named.name + ": change of a cell's energy with its rotation");
    }
    CHECK_NEAR(cells.sum(), energy.Evaluate(Q, R).Total(), 1e-12 * energy.GetScale(),
      named.name + ": sum of the cell energies");
  }
}

// The cotangent matrix reproduces linear functions inside a planar patch: L x = 0 there.
void TestLinearPrecision()
{
  TriangleMesh mesh = Meshes::Patch(8, 0.0);
  Meshes::Random random(5);
  for (int i = 0; i < mesh.P.rows(); ++i)
  {
    mesh.P(i, 0) += 0.07 * random.Signed();
    mesh.P(i, 1) += 0.07 * random.Signed();
  }
  const Matrix3d turn = random.Rotation();
  mesh.P = (mesh.P * turn.transpose()).eval();
  const HalfEdgeScalars c = HalfEdgeCotangents(mesh.P, mesh.F);
  Points Lx = Points::Zero(mesh.P.rows(), 3);
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = mesh.F(f, HalfEdgeStart(k)), v = mesh.F(f, HalfEdgeEnd(k));
      Lx.row(u) += c(f, k) * (mesh.P.row(u) - mesh.P.row(v));
      Lx.row(v) -= c(f, k) * (mesh.P.row(u) - mesh.P.row(v));
    }
  }
  for (int j = 1; j < 8; ++j)
  {
    for (int i = 1; i < 8; ++i)
    {
      CHECK(Lx.row(9 * j + i).norm() <= 1e-13,
        "the cotangent Laplacian of a plane should vanish, is " << Lx.row(9 * j + i).norm());
    }
  }
}

void TestRigidTerm()
{
  for (const Named& named : AllMeshes())
  {
    Meshes::Random random(6);
    const Points& P = named.mesh.P;
    const Triangles& F = named.mesh.F;
    const int n = P.rows();
    const MeshTopology topology(F, n);
    const HalfEdgeVectors e = HalfEdgeDifferences(P, F);
    const Matrices identity(n, Matrix3d::Identity());
    const StyleEnergy rigid(topology,
      ComputeEdgeWeights(HalfEdgeCotangents(P, F), F, Eigen::VectorXd::Zero(n),
        EdgeWeighting::HalfEdge, SphericalWeighting::Uniform),
      e, HalfEdgeDifferences(RandomPoints(n, random), F), 1);
    CHECK(rigid.Evaluate(P, identity).Total() == 0.0,
      named.name << ": the energy at rest with lambda 0 should be zero");

    const StyleEnergy energy =
      RandomEnergy(topology, P, random, EdgeWeighting::HalfEdge, SphericalWeighting::Uniform);
    const Matrix3d turn = random.Rotation();
    const Eigen::RowVector3d shift = 3.0 * random.InCube().transpose();
    const Points moved = (P * turn.transpose()).rowwise() + shift;
    CHECK(energy.Evaluate(moved, Matrices(n, turn)).rigid <= 1e-26 * energy.GetScale(),
      named.name << ": the rigid term of a rigid motion should be zero, is "
                 << energy.Evaluate(moved, Matrices(n, turn)).rigid);
    // Of any shape: a motion on top, with the rotations turned along.
    const Points Q = P + 0.3 * RandomPoints(n, random);
    Matrices R = RandomRotations(n, random);
    const double before = energy.Evaluate(Q, R).rigid;
    for (Matrix3d& rotation : R)
    {
      rotation = (turn * rotation).eval();
    }
    const Points Qmoved = (Q * turn.transpose()).rowwise() + shift;
    CHECK_NEAR(energy.Evaluate(Qmoved, R).rigid, before, 1e-12 * before,
      named.name + ": rigid term after a motion");
  }
}

// Each triangle's share is a Dirichlet energy: never below zero, whatever its angles, also with
// cotangent weights and lambda that differ from point to point.
void TestNeverNegative()
{
  Meshes::Random random(7);
  CHECK(Meshes::CountObtuse(Meshes::House()) > 20, "the house should be obtuse");
  for (int round = 0; round < 300; ++round)
  {
    // Flat triangles too, down to heights of 1e-3.
    const double height = std::pow(10.0, -3.0 * random.Unit());
    const TriangleMesh mesh = Meshes::Make(
      { { 2.0 * random.Signed(), height, 0 }, { -1, 0, 0 }, { 1, 0, 0 } }, { { 0, 1, 2 } });
    const MeshTopology topology(mesh.F, 3);
    const StyleEnergy energy = RandomEnergy(
      topology, mesh.P, random, EdgeWeighting::HalfEdge, SphericalWeighting::Cotangent);
    const Points Q = RandomPoints(3, random);
    const EnergyTerms terms = energy.Evaluate(Q, RandomRotations(3, random));
    CHECK(terms.rigid >= 0.0 && terms.spherical >= 0.0,
      "a triangle's energy should not be negative: " << terms.rigid << ", " << terms.spherical);
  }
  // Nearly without area, where only few digits of it are right, the form stays semidefinite up to
  // the rounding of its largest numbers.
  for (int round = 0; round < 300; ++round)
  {
    const double height = std::pow(10.0, -6.0 - 3.5 * random.Unit());
    const double foot = round % 3 == 0 ? 1.0 - height : random.Unit();
    const TriangleMesh mesh =
      Meshes::Turned(Meshes::Make({ { foot, height, 0 }, { 0, 0, 0 }, { 1, 0, 0 } },
                       { { round % 2, 1 - round % 2, 2 } }),
        random.Rotation());
    const Vector3d c = HalfEdgeCotangents(mesh.P, mesh.F).row(0);
    Matrix3d form;
    form << c(1) + c(2), -c(2), -c(1), -c(2), c(0) + c(2), -c(0), -c(1), -c(0), c(0) + c(1);
    const double least = Eigen::SelfAdjointEigenSolver<Matrix3d>(form).eigenvalues()(0);
    CHECK(least >= -1e-14 * form.cwiseAbs().maxCoeff(),
      "height " << height << ": the least eigenvalue of the form is " << least);
  }
  for (const Named& named : AllMeshes())
  {
    const int n = named.mesh.P.rows();
    const MeshTopology topology(named.mesh.F, n);
    for (int round = 0; round < 10; ++round)
    {
      const StyleEnergy energy = RandomEnergy(
        topology, named.mesh.P, random, EdgeWeighting::HalfEdge, SphericalWeighting::Cotangent);
      const Eigen::VectorXd cells =
        energy.CellEnergies(RandomPoints(n, random), RandomRotations(n, random));
      CHECK(cells.minCoeff() >= 0.0,
        named.name << ": a cell's energy is " << cells.minCoeff() << ", should not be negative");
    }
  }
}

void TestEdgeTargets()
{
  for (const Named& named : AllMeshes())
  {
    Meshes::Random random(8);
    const Points& P = named.mesh.P;
    const Triangles& F = named.mesh.F;
    const Points t = 0.3 * P + 0.5 * RandomPoints(P.rows(), random);
    const double r = 1.7;
    const HalfEdgeVectors rest = HalfEdgeDifferences(P, F);
    HalfEdgeVectors keep = HalfEdgeVectors::Zero(F.rows(), 9);
    AddEdgeTargets(t, r, {}, F, keep);
    HalfEdgeVectors flip = keep, zero = keep;
    const int changed = ChangeConcaveTargets(rest, ConcaveEdges::Keep, keep);
    CHECK(changed == 0, named.name << ": Keep should change nothing");
    const int flipped = ChangeConcaveTargets(rest, ConcaveEdges::Flip, flip);
    const int zeroed = ChangeConcaveTargets(rest, ConcaveEdges::Zero, zero);
    int concave = 0;
    std::map<std::pair<int, int>, bool> ofEdge;
    for (int f = 0; f < F.rows(); ++f)
    {
      for (int k = 0; k < 3; ++k)
      {
        const int u = F(f, HalfEdgeStart(k)), v = F(f, HalfEdgeEnd(k));
        const Eigen::RowVector3d tau = r * (t.row(u) - t.row(v));
        const bool opposed = tau.dot(P.row(u) - P.row(v)) < 0.0;
        concave += opposed;
        const auto at = [&](const HalfEdgeVectors& x) -> Eigen::RowVector3d
        { return x.row(f).segment<3>(3 * k); };
        const Eigen::RowVector3d mirrored = -tau, none = Eigen::RowVector3d::Zero();
        CHECK((at(keep) - tau).norm() <= 1e-14, named.name << ": tau should be r (t_u - t_v)");
        CHECK((at(flip) - (opposed ? mirrored : tau)).norm() <= 1e-14,
          named.name << ": the flipped tau is wrong");
        CHECK((at(zero) - (opposed ? none : tau)).norm() <= 1e-14,
          named.name << ": the zeroed tau is wrong");
        // Both half-edges of an edge have one answer.
        const bool isFlipped = at(flip).dot(tau) < 0.0;
        const auto found = ofEdge.insert({ { std::min(u, v), std::max(u, v) }, isFlipped });
        CHECK(found.first->second == isFlipped,
          named.name << ": the half-edges of an edge should be flipped together");
      }
    }
    CHECK(flipped == concave && zeroed == concave,
      named.name << ": " << flipped << " flipped, " << zeroed << " zeroed, should be " << concave);
  }
}

void TestDirections()
{
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Icosphere(1), 0.1, 9);
  const MeshTopology topology(mesh.F, mesh.P.rows());
  const Vector3d O(0.1, -0.2, 0.15);
  std::vector<int> onCenter;
  const Points d = CenterDirections(mesh.P, topology.GetTriangles(), O, onCenter);
  CHECK(onCenter.empty(), "no point lies on the center");
  for (int i = 0; i < d.rows(); ++i)
  {
    const Eigen::RowVector3d expected = (mesh.P.row(i) - O.transpose()).normalized();
    CHECK((d.row(i) - expected).norm() <= 1e-14, "d should be (p - O) / |p - O|");
  }
  // The center on a point: it takes the mean of its neighbors' directions.
  const int on = 17;
  const Points d17 =
    CenterDirections(mesh.P, topology.GetTriangles(), mesh.P.row(on).transpose(), onCenter);
  CHECK(onCenter.size() == 1 && onCenter[0] == on, "point 17 should be reported as on the center");
  std::vector<char> neighbors(mesh.P.rows(), 0);
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      for (int j = 0; j < 3; ++j)
      {
        neighbors[mesh.F(f, j)] |= mesh.F(f, k) == on;
      }
    }
  }
  Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
  int count = 0;
  for (int i = 0; i < mesh.P.rows(); ++i)
  {
    if (neighbors[i] && i != on)
    {
      mean += (mesh.P.row(i) - mesh.P.row(on)).normalized();
      ++count;
    }
  }
  mean /= count;
  CHECK((d17.row(on) - mean).norm() <= 1e-14,
    "the direction on the center should be " << mean << ", is " << d17.row(on));
  // Evenly surrounded: zero, and finite.
  const TriangleMesh flat = Meshes::Patch(4, 0.0);
  const MeshTopology flatTopology(flat.F, flat.P.rows());
  const Points even =
    CenterDirections(flat.P, flatTopology.GetTriangles(), flat.P.row(12).transpose(), onCenter);
  CHECK(onCenter.size() == 1 && onCenter[0] == 12, "the middle point should be on the center");
  CHECK(even.row(12).norm() <= 1e-15,
    "an evenly surrounded point should have direction 0, has " << even.row(12));

  const Points n = PointNormals(mesh.P, mesh.F);
  Meshes::Random random(10);
  Eigen::VectorXd a(mesh.P.rows());
  for (int i = 0; i < a.size(); ++i)
  {
    CHECK_NEAR(n.row(i).norm(), 1.0, 1e-14, "length of a normal");
    a[i] = random.Unit();
  }
  const Points t = BlendDirections(d, n, a);
  for (int i = 0; i < a.size(); ++i)
  {
    CHECK((t.row(i) - (1.0 - a[i]) * d.row(i) - a[i] * n.row(i)).norm() <= 1e-15,
      "t should be (1 - a) d + a n, not normalized");
  }
}

// A sphere is at rest in its own style, by directions (A4.2) and by its true normals (A4.1).
void TestExactSphere()
{
  TriangleMesh mesh = Meshes::Icosphere(3);
  const Vector3d O(3.0, -2.0, 1.0);
  const double r = 2.5;
  const Points normals = mesh.P;
  mesh.P = (r * mesh.P).rowwise() + O.transpose();
  const int n = mesh.P.rows();
  const MeshTopology topology(mesh.F, n);
  std::vector<int> onCenter;
  const Points d = CenterDirections(mesh.P, topology.GetTriangles(), O, onCenter);
  const HalfEdgeVectors e = HalfEdgeDifferences(mesh.P, mesh.F);
  for (const double a : { 0.0, 0.5, 1.0 })
  {
    const Points t = BlendDirections(d, normals, Eigen::VectorXd::Constant(n, a));
    HalfEdgeVectors tau = HalfEdgeVectors::Zero(mesh.F.rows(), 9);
    AddEdgeTargets(t, r, {}, mesh.F, tau);
    const StyleEnergy energy(topology,
      ComputeEdgeWeights(HalfEdgeCotangents(mesh.P, mesh.F), mesh.F,
        Eigen::VectorXd::Constant(n, 5.0), EdgeWeighting::HalfEdge, SphericalWeighting::Uniform),
      e, tau, 1);
    const double spherical = energy.Evaluate(mesh.P, Matrices(n, Matrix3d::Identity())).spherical;
    CHECK(spherical <= 1e-26 * energy.GetScale(),
      "a = " << a << ": the spherical energy of a sphere should be zero, is " << spherical);
  }

  // The sphere the modes find: center exact by symmetry, radius of equal area and volume.
  const Sphere byArea =
    TargetSphere(mesh.P, mesh.F, CenterMode::PointMean, RadiusMode::EqualArea, {});
  const Sphere byVolume =
    TargetSphere(mesh.P, mesh.F, CenterMode::AreaCentroid, RadiusMode::EqualVolume, {});
  CHECK((byArea.center - O).norm() <= 1e-13, "the mean of the points should be the center");
  CHECK((byVolume.center - O).norm() <= 1e-13, "the area centroid should be the center");
  CHECK_NEAR(byArea.radius, std::sqrt(TriangleAreas(mesh.P, mesh.F).sum() / (4.0 * Meshes::Pi)),
    1e-14 * r, "radius of equal area");
  CHECK_NEAR(byVolume.radius, std::cbrt(3.0 * EnclosedVolume(mesh.P, mesh.F) / (4.0 * Meshes::Pi)),
    1e-14 * r, "radius of equal volume");
  CHECK(byArea.radius < r && byArea.radius > 0.98 * r, "an inscribed mesh has a smaller area");
  CHECK_THROWS(std::invalid_argument,
    TargetSphere(mesh.P, mesh.F, CenterMode::PointMean, RadiusMode::Custom, { O, 0.0 }), "Radius");
}

void TestMeasures()
{
  const TriangleMesh box = Meshes::Box(3, { 1, 2, 3 });
  CHECK_NEAR(TriangleAreas(box.P, box.F).sum(), 88.0, 1e-12, "area of a box");
  CHECK_NEAR(PointAreas(box.P, box.F).sum(), 88.0, 1e-12, "sum of the lumped areas");
  CHECK_NEAR(EnclosedVolume(box.P, box.F), 48.0, 1e-12, "volume of a box");
  TriangleMesh turned = box;
  turned.F.col(1).swap(turned.F.col(2));
  CHECK_NEAR(EnclosedVolume(turned.P, turned.F), -48.0, 1e-12, "volume of a box turned inside out");
  CHECK_NEAR(Sphericity(box.P, box.F),
    std::cbrt(Meshes::Pi) * std::pow(6.0 * 48.0, 2.0 / 3.0) / 88.0, 1e-13, "sphericity of a box");
  const TriangleMesh ball = Meshes::Icosphere(4);
  CHECK(Sphericity(ball.P, ball.F) > 0.999 && Sphericity(ball.P, ball.F) < 1.0,
    "sphericity of a fine icosphere is " << Sphericity(ball.P, ball.F));
  CHECK(RadiusSpread(ball.P, Vector3d::Zero()) <= 1e-14, "a sphere has no radius spread");
  // On a sphere the normals are the directions, to the order of the mesh's size squared.
  CHECK((PointNormals(ball.P, ball.F) - ball.P).rowwise().norm().maxCoeff() <= 5e-3,
    "normals of a sphere are off by "
      << (PointNormals(ball.P, ball.F) - ball.P).rowwise().norm().maxCoeff());
  const Points normals = PointNormals(box.P, box.F);
  for (int i = 0; i < box.P.rows(); ++i)
  {
    if (box.P.row(i).cwiseAbs().isApprox(Eigen::RowVector3d(1, 2, 3)))
    {
      // Angle weights: three right angles, however many triangles share them.
      const Eigen::RowVector3d expected = box.P.row(i).cwiseSign() / std::sqrt(3.0);
      CHECK((normals.row(i) - expected).norm() <= 1e-14,
        "the normal of a box's corner is " << normals.row(i) << ", should be " << expected);
    }
  }
  Meshes::Random random(11);
  const Matrix3d turn = random.Rotation();
  CHECK(DetailError(box.P, box.P * turn.transpose(), box.F, Matrices(box.P.rows(), turn)) <= 1e-14,
    "a turned copy has no detail error");
}

void TestThreads()
{
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Ellipsoid(5), 0.002, 13);
  const int n = mesh.P.rows();
  const MeshTopology topology(mesh.F, n);
  double total = 0.0;
  Points right;
  Matrices covariances;
  Eigen::VectorXd shares;
  for (const int threads : { 1, 2, 3 })
  {
    Meshes::Random random(14);
    StyleEnergy energy = RandomEnergy(
      topology, mesh.P, random, EdgeWeighting::HalfEdge, SphericalWeighting::Uniform, threads);
    const CellPattern pattern(topology);
    energy.PrepareSteps(pattern);
    const Matrices R = RandomRotations(n, random);
    const Points Q = RandomPoints(n, random);
    Points b;
    energy.RightHandSide(R, b);
    Matrices S;
    energy.Covariances(Q, S);
    if (threads == 1)
    {
      total = energy.Evaluate(Q, R).Total();
      shares = energy.CellEnergies(Q, R);
      right = b;
      covariances = S;
      continue;
    }
    CHECK(energy.Evaluate(Q, R).Total() == total, threads << " threads: the energy differs");
    CHECK(energy.CellEnergies(Q, R) == shares, threads << " threads: the cell energies differ");
    CHECK(Meshes::SameBits(b, right), threads << " threads: the right-hand side differs");
    bool same = true;
    for (int i = 0; i < n; ++i)
    {
      same = same && S[i] == covariances[i];
    }
    CHECK(same, threads << " threads: the covariances differ");
  }
}

/// A disc around one point, as the end of a cylinder of very many sides: where a point has all the
/// others as its neighbors, sums over cells must not take the square of their number: each corner
/// of a triangle is visited once, and finds its neighbors by bisection.
void TestManyNeighbors()
{
  constexpr int around = 4000;
  TriangleMesh disc = { Points::Zero(around + 1, 3), Triangles(around, 3) };
  for (int i = 0; i < around; ++i)
  {
    const double angle = 2.0 * Pi * i / around;
    disc.P.row(i) << std::cos(angle), std::sin(angle), 0.0;
    disc.F.row(i) << i, (i + 1) % around, around;
  }
  const MeshTopology topology(disc.F, around + 1);
  const CellPattern pattern(topology);
  CHECK(pattern.GetNeighbors().size() == 4 * around,
    "each spoke and each side twice, not " << pattern.GetNeighbors().size() << " neighbors of "
                                           << around << " triangles");
  int visits = 0;
  const auto weightedEdges = [&visits](int) -> Matrix3d
  {
    ++visits;
    return Matrix3d::Identity();
  };
  const CellCoefficients coefficients(pattern, topology, weightedEdges, 1);
  CHECK(visits == 3 * around, visits << " visits of " << around << " triangles");
  int compared = 0;
  const auto less = [&compared](int a, int b)
  {
    ++compared;
    return a < b;
  };
  bool found = true;
  int most = 0;
  for (int j = 0; j < around; ++j)
  {
    compared = 0;
    found = found && pattern.GetNeighbors()[pattern.Find(around, j, less)] == j;
    most = std::max(most, compared);
  }
  CHECK(found, "each point is a neighbor of the middle, and found there");
  CHECK(most >= 1 && most <= 12, most << " comparisons to find one of " << around); // 2^12 > 4000
}
} // namespace

int main()
{
  TestWeights();
  TestGradient();
  TestCovariances();
  TestLinearPrecision();
  TestRigidTerm();
  TestNeverNegative();
  TestEdgeTargets();
  TestDirections();
  TestExactSphere();
  TestMeasures();
  TestThreads();
  TestManyNeighbors();
  return CheckResult();
}
