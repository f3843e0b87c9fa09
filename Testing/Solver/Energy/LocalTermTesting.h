// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What must hold for every LocalTerm, and a minimizer over rotations that knows nothing of it.
#ifndef SphericalStyle_LocalTermTesting_h
#define SphericalStyle_LocalTermTesting_h

#include "Check.h"
#include "FixedIterations.h"
#include "LocalTerm.h"
#include "Meshes.h"
#include "StyleSolver.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace LocalTermTesting
{
using namespace SphericalStyle;
using Eigen::Matrix3d;
using Eigen::Vector3d;

using Term = std::shared_ptr<LocalTerm>;
/// A term of the weight lambda.
using MakeTerm = std::function<Term(double lambda)>;
/// lambda a |...| of cell i at R, written down anew. In any unit: n and a are given.
using TermOf = std::function<double(const Vector3d& n, double area, const Matrix3d& R)>;
using OfRotation = std::function<double(const Matrix3d& R)>;

/// Goes down from R by turns about the axes, as small as 1e-9.
inline double Refined(Matrix3d R, const OfRotation& value, double step)
{
  double least = value(R);
  while (step > 1e-9)
  {
    bool better = false;
    for (int side = 0; side < 6; ++side)
    {
      const Vector3d axis = Vector3d::Unit(side % 3);
      const Matrix3d turned = Eigen::AngleAxisd(side < 3 ? step : -step, axis) * R;
      const double here = value(turned);
      if (here < least)
      {
        least = here;
        R = turned;
        better = true;
      }
    }
    step *= better ? 1.0 : 0.5;
  }
  return least;
}

/// The least value over all rotations: the best of the samples, refined.
inline double LeastOver(const std::vector<Matrix3d>& samples, const OfRotation& value)
{
  std::vector<std::pair<double, int>> order;
  for (const Matrix3d& R : samples)
  {
    order.emplace_back(value(R), static_cast<int>(order.size()));
  }
  std::partial_sort(order.begin(), order.begin() + 5, order.end());
  double least = order[0].first;
  for (int k = 0; k < 5; ++k)
  {
    least = std::min(least, Refined(samples[order[k].second], value, 0.1));
  }
  return least;
}

/// Passes all on to a term and holds every local step of every third cell against LeastOver.
class CheckedTerm : public LocalTerm
{
public:
  CheckedTerm(Term term, TermOf value, std::string name)
    : Checked(std::move(term))
    , OfCell(std::move(value))
    , Name(std::move(name))
  {
    Meshes::Random random(7);
    for (int k = 0; k < 600; ++k)
    {
      this->Samples.push_back(random.Rotation());
    }
  }

  void SetMesh(const Points& P, const Triangles& F) override
  {
    this->Normals = PointNormals(P, F);
    this->Areas = PointAreas(P, F);
    this->Checked->SetMesh(P, F);
  }

  double Fit(Matrices& S, Matrices& R, int threads) override
  {
    const Matrices given = S; // the term may overwrite it
    const Matrices before = R;
    const double change = this->Checked->Fit(S, R, threads);
    double expected = 0.0;
    double scale = 0.0;
    for (int i = 0; i < static_cast<int>(R.size()); ++i)
    {
      const Vector3d n = this->Normals.row(i).transpose();
      const auto value = [&](const Matrix3d& X)
      { return -2.0 * (X * given[i]).trace() + this->OfCell(n, this->Areas[i], X); };
      expected += value(R[i]) - value(before[i]);
      const double size = 2.0 * given[i].norm() + this->OfCell(n, this->Areas[i], -R[i]) +
        this->OfCell(n, this->Areas[i], R[i]);
      scale += size;
      CHECK_NEAR((R[i].transpose() * R[i] - Matrix3d::Identity()).norm(), 0.0, 1e-12,
        this->Name << ", cell " << i << ": R^T R - I");
      CHECK(R[i].determinant() > 0.0, this->Name << ": a reflection in cell " << i);
      if (i % 3 == 0)
      {
        const double gap = (value(R[i]) - LeastOver(this->Samples, value)) / size;
        this->Worst = std::max(this->Worst, gap);
        CHECK(
          gap <= 1e-6, this->Name << ", cell " << i << ": a sampled rotation is better by " << gap);
      }
    }
    CHECK_NEAR(change, expected, 1e-12 * scale, this->Name << ": change of the energy");
    return change;
  }

  double Evaluate(const Matrices& R) const override { return this->Checked->Evaluate(R); }

  double Worst = 0.0;

private:
  Term Checked;
  TermOf OfCell;
  std::string Name;
  Points Normals;
  Eigen::VectorXd Areas;
  std::vector<Matrix3d> Samples;
};

/// lambda = 0, so that the term is the whole style.
inline StyleOptions OptionsOf(Term term)
{
  StyleOptions options;
  options.lambda = 0.0;
  options.localTerm = std::move(term);
  options.loop.maximumNumberOfIterations = 1000;
  return options;
}

inline std::vector<Meshes::Named> AllMeshes()
{
  return { { "ellipsoid", Meshes::Perturbed(Meshes::Ellipsoid(2), 0.02, 1) },
    { "slivers", Meshes::Slivers() }, { "house", Meshes::Perturbed(Meshes::House(), 0.02, 2) },
    { "patch", Meshes::Patch(8, 0.4) }, { "two components", Meshes::TwoComponents() },
    { "fan", Meshes::NonManifoldFan() } };
}

/// [local]: no rotation is better than the one that the term takes.
inline void CheckLocalSteps(const MakeTerm& make, const std::function<TermOf(double)>& valueOf)
{
  double worst = 0.0;
  for (const Meshes::Named& named : AllMeshes())
  {
    for (const double lambda : { 0.1, 1.0, 10.0 })
    {
      auto term = std::make_shared<CheckedTerm>(
        make(lambda), valueOf(lambda), named.name + ", lambda " + std::to_string(lambda));
      StyleSolver solver;
      solver.SetMesh(named.mesh);
      solver.Solve(Fixed(OptionsOf(term), 4));
      worst = std::max(worst, term->Worst);
    }
  }
  std::cout << "local step: the best sampled rotation is better by " << worst << " at most\n";
}

/// Energy and its history: falls in every step, is what the formula says, from the rest shape on.
inline void CheckDescent(const MakeTerm& make, const std::function<TermOf(double)>& valueOf)
{
  double worst = 0.0;
  for (const Meshes::Named& named : AllMeshes())
  {
    for (const double lambda : { 0.1, 1.0, 10.0 })
    {
      for (const bool acceleration : { false, true })
      {
        std::ostringstream what;
        what << named.name << ", lambda " << lambda << (acceleration ? ", accelerated" : "");
        StyleSolver solver;
        solver.SetMesh(named.mesh);
        StyleOptions options = OptionsOf(make(lambda));
        options.loop.acceleration = acceleration;
        const StyleReport report = solver.Solve(options);
        const std::vector<HistoryRow>& rows = report.loop.history;
        const double whole = report.loop.restEnergy;
        CHECK(
          !report.closedForm && report.loop.iterations > 0, what.str() << ": it should iterate");
        // Without acceleration a flat valley of |R n|_1 can take more than 1000 steps.
        CHECK(report.loop.converged || !acceleration, what.str() << ": it should converge");
        CHECK(rows[0].energy.rigid <= 1e-20 * whole && rows[0].globalChange == 0.0,
          what.str() << ": it should start from rest, starts with rigid energy "
                     << rows[0].energy.rigid);
        for (std::size_t k = 1; k < rows.size(); ++k)
        {
          const double rise = std::max({ rows[k].energy.Total() - rows[k - 1].energy.Total(),
                                rows[k].localChange, rows[k].globalChange }) /
            whole;
          worst = std::max(worst, rise);
          CHECK(rise <= 1e-13, what.str() << ": E rises by " << rise << " in step " << k);
        }
        CHECK(rows.back().energy.Total() < 0.999 * whole, what.str() << ": E should fall");

        const Points n = PointNormals(named.mesh.P, named.mesh.F);
        const Eigen::VectorXd a = PointAreas(named.mesh.P, named.mesh.F);
        double second = 0.0;
        for (Eigen::Index i = 0; i < n.rows(); ++i)
        {
          second += valueOf(lambda)(n.row(i).transpose(), a[i], solver.GetRotations()[i]);
        }
        CHECK_NEAR(rows.back().energy.spherical, second, 1e-10 * whole, what.str() + ": the term");
        CHECK_NEAR(rows.back().energy.rigid, solver.GetCellEnergies().sum(), 1e-10 * whole,
          what.str() + ": the rigid energy");
      }
    }
  }
  std::cout << "largest relative rise of the energy " << worst << std::endl;
}

/// Weight 0 is the model; place, size, threads and earlier solves do not matter.
inline void CheckInvariance(const MakeTerm& make)
{
  for (const Meshes::Named& named : AllMeshes())
  {
    const TriangleMesh& mesh = named.mesh;
    const double diagonal = Meshes::Diagonal(mesh.P);
    StyleSolver solver;
    solver.SetMesh(mesh);
    const StyleReport still = solver.Solve(OptionsOf(make(0.0)));
    CHECK(still.loop.converged && still.loop.iterations <= 1, named.name << ": weight 0 stops");
    CHECK(Meshes::Distance(solver.GetPositions(), mesh.P) <= 1e-15 * diagonal,
      named.name << ": weight 0 moves points by "
                 << Meshes::Distance(solver.GetPositions(), mesh.P));

    // Few steps, so that rounding cannot decide between two rotations of nearly one energy.
    const StyleOptions options = Fixed(OptionsOf(make(0.7)), 5);
    StyleSolver fresh;
    fresh.SetMesh(mesh);
    fresh.Solve(options);
    const Points expected = fresh.GetPositions();
    CHECK(Meshes::Distance(expected, mesh.P) >= 1e-3 * diagonal, named.name << ": it should move");
    solver.Solve(options);
    CHECK(Meshes::SameBits(solver.GetPositions(), expected),
      named.name << ": earlier solves should not show");
    for (const double scale : { 1e-6, 1e6 })
    {
      TriangleMesh other = mesh;
      const Eigen::RowVector3d move = scale * Eigen::RowVector3d(1.5, -20.0, 7.0);
      other.P = (scale * mesh.P).rowwise() + move;
      StyleSolver moved;
      moved.SetMesh(other);
      moved.Solve(options);
      const Points back = (moved.GetPositions().rowwise() - move) / scale;
      CHECK(Meshes::Distance(back, expected) <= 1e-9 * diagonal,
        named.name << ": moved and scaled by " << scale << " the result differs by "
                   << Meshes::Distance(back, expected));
    }
  }
  const TriangleMesh large = Meshes::Ellipsoid(5);
  StyleSolver one;
  one.SetMesh(large);
  StyleOptions options = Fixed(OptionsOf(make(1.0)), 4);
  options.loop.acceleration = true;
  one.Solve(options);
  for (const int threads : { 2, 3, 8 })
  {
    StyleSolver several;
    several.SetMesh(large);
    options.localTerm = make(1.0);
    options.threads = threads;
    several.Solve(options);
    CHECK(Meshes::SameBits(one.GetPositions(), several.GetPositions()),
      threads << " threads should give the same bits");
  }
}

/// Share of the area whose triangle normal is within some degrees of one of the directions.
inline double ShareNear(
  const Points& P, const Triangles& F, const Points& directions, double degrees)
{
  const Eigen::VectorXd area = TriangleAreas(P, F);
  double near = 0.0;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Vector3d a = P.row(F(f, 0));
    const Vector3d n =
      (P.row(F(f, 1)).transpose() - a).cross(P.row(F(f, 2)).transpose() - a).normalized();
    near += (directions * n).maxCoeff() >= std::cos(degrees * Meshes::Pi / 180.0) ? area[f] : 0.0;
  }
  return near / area.sum();
}

/// The six half axes.
inline Points HalfAxes()
{
  Points axes(6, 3);
  axes << Matrix3d::Identity(), -Matrix3d::Identity();
  return axes;
}
} // namespace LocalTermTesting

#endif
