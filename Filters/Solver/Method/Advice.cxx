// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Advice.h"

#include "DeformationMeasures.h"
#include "MeshDiagnosis.h"
#include "MeshQuality.h"
#include "Parallel.h"
#include "SurfaceMeasures.h"
#include "UnitScale.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

namespace SphericalStyle
{
namespace
{
// From where on a fact is worth a word. "Models" are 15 scans and drawings.

/// Models with directions from the center have 0.5 % or less, with normals 2 % or more.
constexpr double TurnedOverLimit = 0.01;
/// Meshes of even triangles have 2 % or less, what scanners and drawing programs give 24 % or more.
constexpr double ObtuseLimit = 0.2;
/// Even triangles are within 1.3, and 2 is already one more level of refinement somewhere.
constexpr double AreaFactorLimit = 2.0;
/// Bodies with limbs have 0.1 to 0.22, assemblies and what curls around its center 0.4 or more.
constexpr double FacingAwayLimit = 0.3;
/// Of 57 models at Toy, open ones that crumple have 1.7 and 3.4 %, the other open ones .4 % or
/// less. Closed ones with 1 % and more look as they should. Of 33 models at Toy whose folds are
/// avoided, two that crumple have 1.8 and 2.6 %, the others .8 % or less.
constexpr double CreasedLimit = 0.01;
/// Length of the border over the square root of the area: open shells have 1 or more, a figure with
/// a hole .1, a cut bust .7.
constexpr double BorderLimit = 1.0;
/// A model of fewer points, and of edges that are bent by more (8 degrees): its outline is a
/// polygon. Of up to twice as many points where edges are bent by 20 degrees, as those of 26 small
/// bones are, and little of it is faces: animals have 16 or less, devices more and faces, too.
constexpr int FewPoints = 1500;
constexpr double AngularLimit = 2.0 * Pi / 45.0;
constexpr double VeryAngularLimit = Pi / 9.0;
constexpr double FewFaces = 0.25;
/// A closed body of flat faces: half of its area is within faces, and it has sharp edges, in length
/// this times the square root of its area: a box has 4.9, a cylinder 2.5.
constexpr double PlanarLimit = 0.5;
constexpr double BoxEdgeLimit = 1.0;
/// As much bent in and out again as a ball is bent; animals have 7 or more, a box or a cylinder 1.
/// With corners, more: machine parts have up to 5. Cars, houses and devices have 9 and more, and
/// without their details triangles turn over.
constexpr double CurvatureLimit = 2.0;
constexpr double CurvatureLimitOfParts = 5.0;
/// Times as long as wide, from which on a ball is a bulge in the middle of such a body.
constexpr double LongLimit = 3.0;
/// Area whose long edges were split, from which on a model is drawn of panels.
constexpr double PanelLimit = 0.5;
/// Machine parts and what is drawn have more of their curvature in corners, round bodies none.
constexpr double CornerLimit = 0.25;

// What is advised.

/// DetailSize of the defaults: a smooth base carries the details, and does not fold. Of 28 models
/// with triangles turned over without it, none has 1 % of them with it, and 23 have with FewLimbs.
constexpr double Details = 0.06;
/// NormalBlend of the defaults: a body that faces away from one center is rounded limb by limb.
constexpr double Limbs = 0.6;
/// NormalBlend where limbs run into each other: that of the preset Chubby, half of the defaults.
constexpr double FewLimbs = 0.3;
/// Roundness of the preset Soft; less is no style anymore.
constexpr double LeastRoundness = 0.5;

std::string Percent(double share)
{
  return std::to_string(std::lround(100.0 * share)) + " %";
}

/// With two decimals at most, as 0.3 or 1.25.
std::string Number(double value)
{
  std::ostringstream text;
  text << std::round(100.0 * value) / 100.0;
  return text.str();
}

/// Whether a model has so few points that its outline stays angular.
bool IsAngular(const ModelFacts& model)
{
  const bool isFew = model.points < FewPoints && model.meanAngle >= AngularLimit;
  const bool isVery = model.meanAngle >= VeryAngularLimit && model.planarShare < FewFaces;
  return model.points > 0 && (isFew || isVery);
}

/// Whether it is an open shell.
bool IsOpen(const SurfaceFacts& surface)
{
  return surface.border >= BorderLimit;
}

/// Whether it is a closed, simple body of flat faces.
bool IsOfFaces(const SurfaceFacts& surface)
{
  const bool isSimple = surface.curvature < CurvatureLimit ||
    (surface.curvature < CurvatureLimitOfParts && surface.cornerShare >= CornerLimit);
  return isSimple && surface.planarShare >= PlanarLimit && surface.boxEdges >= BoxEdgeLimit &&
    !IsOpen(surface);
}

using Sums = Eigen::Array4d;

/// Triangles that are enough to see shares of a surface by. A drag of the center looks at no more.
constexpr int Enough = 20000;

/// Sum of item(f) over every `step`-th triangle f.
template <typename Item>
Sums SumTriangles(
  const TriangleMesh& mesh, const SurfacePart& part, int step, int threads, const Item& item)
{
  const auto count = (static_cast<int>(mesh.F.rows()) + step - 1) / step;
  Sums all = ParallelSum(count, threads, Sums(Sums::Zero()),
    [&item, step](int begin, int end)
    {
      Sums sum = Sums::Zero();
      for (int k = begin; k < end; ++k)
      {
        sum += item(step * k);
      }
      return sum;
    });
  part.Sum(all);
  return all;
}

/// So that about Enough triangles are looked at; odd, for cells often come in pairs.
int StepOf(const TriangleMesh& mesh, const SurfacePart& part)
{
  return static_cast<int>(part.Sum(static_cast<double>(mesh.F.rows())) / Enough) | 1;
}

void MeasureCenter(const TriangleMesh& mesh, const SurfacePart& part, const Eigen::Vector3d& O,
  int threads, ResultFacts& facts)
{
  const auto measure = [&](int f) -> Sums
  {
    const Eigen::Vector3d a = mesh.P.row(mesh.F(f, 0));
    const Eigen::Vector3d b = mesh.P.row(mesh.F(f, 1));
    const Eigen::Vector3d c = mesh.P.row(mesh.F(f, 2));
    const double product = TripleProduct(mesh.P, mesh.F, f, O);
    const double area = 0.5 * (b - a).cross(c - a).norm();
    return { SolidAngle(mesh.P, mesh.F, f, O), product, product < 0.0 ? area : 0.0,
      product < 0.0 ? 0.0 : area };
  };
  const int step = StepOf(mesh, part);
  Sums sums = SumTriangles(mesh, part, step, threads, measure);
  const double away = sums[1] < 0.0 ? sums[3] : sums[2]; // inside out
  facts.facingAwayShare = away / (sums[2] + sums[3]);
  // The sum is a multiple of 4 pi if the surface is closed, and 0 from outside.
  if (step > 1 && std::abs(step * sums[0]) < Pi)
  {
    sums = SumTriangles(mesh, part, 1, threads, measure);
  }
  facts.centerOutside = std::abs(sums[0]) < 1e-6 && sums[1] != 0.0;
}

Eigen::Vector3d CentroidOfArea(const TriangleMesh& mesh, const SurfacePart& part)
{
  const Eigen::VectorXd areas = TriangleAreas(mesh.P, mesh.F);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      sum += areas(f) / 3.0 * mesh.P.row(mesh.F(f, k)).transpose();
    }
  }
  const double area = part.Sum(areas.sum());
  return Eigen::Vector3d{ part.Sum(sum[0]), part.Sum(sum[1]), part.Sum(sum[2]) } / area;
}

bool ManyTurned(const TriangleMesh& mesh, const SurfacePart& part, const Points& Q, int threads)
{
  const auto normal = [&mesh](const Points& x, int f) -> Eigen::Vector3d
  {
    const Eigen::Vector3d a = x.row(mesh.F(f, 0));
    const Eigen::Vector3d b = x.row(mesh.F(f, 1));
    const Eigen::Vector3d c = x.row(mesh.F(f, 2));
    return (b - a).cross(c - a);
  };
  const Sums sums = SumTriangles(mesh, part, StepOf(mesh, part), threads,
    [&](int f) -> Sums {
      return { normal(mesh.P, f).dot(normal(Q, f)) < 0.0 ? 1.0 : 0.0, 1.0, 0.0, 0.0 };
    });
  return sums[0] >= TurnedOverLimit * sums[1];
}

/// Curvature: sum over the points of |2 pi - their angles| over 4 pi. Points on a border do not
/// count: their triangles are no full turn, and then the numbers of the points around do not
/// cancel.
void MeasureCurvature(const TriangleMesh& mesh, const SurfacePart& part, Eigen::VectorXd& angleSums,
  SurfaceFacts& facts)
{
  // Another number for each point, the same on all processes.
  Eigen::VectorXd number(mesh.P.rows());
  const double first =
    part.IsWhole() ? 0.0 : MostTriangles * static_cast<double>(part.processes->GetRank());
  for (Eigen::Index i = 0; i < number.size(); ++i)
  {
    number(i) = first + static_cast<double>(i);
  }
  for (std::size_t k = 0; k < part.shared.size(); ++k)
  {
    number(part.shared[k]) = -1.0 - part.numbers[k];
  }
  Eigen::VectorXd balance = Eigen::VectorXd::Zero(mesh.P.rows());
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      balance(mesh.F(f, k)) +=
        number(mesh.F(f, HalfEdgeEnd(k))) - number(mesh.F(f, HalfEdgeStart(k)));
    }
  }
  part.SumAtShared(balance.data(), 1);
  part.SumAtShared(angleSums.data(), 1);
  double all = 0.0;
  double corners = 0.0;
  for (Eigen::Index i = 0; i < angleSums.size(); ++i)
  {
    if (balance(i) == 0.0 && angleSums(i) > 0.0 && part.Counts(i))
    {
      const double own = std::abs(2.0 * Pi - angleSums(i));
      all += own;
      corners += own >= Corner ? own : 0.0;
    }
  }
  all = part.Sum(all);
  corners = part.Sum(corners);
  facts.curvature = all / (4.0 * Pi);
  facts.cornerShare = all > 0.0 ? corners / all : 0.0;
}

/// 1 of what has no extent.
double Elongation(const TriangleMesh& mesh)
{
  const auto [low, high] = BoundsOf(mesh.P, {});
  const double unit = UnitScale(low.cwiseAbs().cwiseMax(high.cwiseAbs()));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
    AreaMoments(unit * mesh.P, mesh.F), Eigen::EigenvaluesOnly);
  const Eigen::Vector3d& moments = solver.eigenvalues(); // the largest one last
  return moments(2) > 0.0 ? std::sqrt(moments(2) / std::max(moments(1), 1e-12 * moments(2))) : 1.0;
}
}

double LongEdgeShare(const TriangleMesh& mesh, const SurfacePart& part)
{
  const auto [low, high] = BoundsOf(mesh.P, part);
  const double unit = UnitScale(low.cwiseAbs().cwiseMax(high.cwiseAbs()));
  const auto place = [&](Eigen::Index f, int k) -> Eigen::Vector3d
  { return unit * mesh.P.row(mesh.F(f, k)).transpose(); };
  const double long2 = LongEdge * LongEdge * (unit * high - unit * low).squaredNorm();
  double all = 0.0;
  double coarse = 0.0;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    const Eigen::Vector3d a = place(f, 0);
    const Eigen::Vector3d ab = place(f, 1) - a;
    const Eigen::Vector3d ac = place(f, 2) - a;
    const double area = ab.cross(ac).norm();
    all += area;
    coarse += std::max({ ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm() }) >= long2
      ? area
      : 0.0;
  }
  all = part.Sum(all);
  coarse = part.Sum(coarse);
  return all > 0.0 ? coarse / all : 0.0;
}

SurfaceFacts MeasureSurface(const TriangleMesh& mesh, int components, const SurfacePart& part)
{
  const Points& P = mesh.P;
  const Triangles& F = mesh.F;
  const Eigen::VectorXd areas = TriangleAreas(P, F);
  SurfaceFacts facts;
  Eigen::VectorXd angleSums = Eigen::VectorXd::Zero(P.rows());
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    bool obtuse = false;
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d x = P.row(F(f, HalfEdgeStart(k))) - P.row(F(f, k));
      const Eigen::Vector3d y = P.row(F(f, HalfEdgeEnd(k))) - P.row(F(f, k));
      obtuse |= x.dot(y) < -RightAngle * x.norm() * y.norm();
      angleSums(F(f, k)) += std::atan2(2.0 * areas(f), x.dot(y));
    }
    facts.obtuseShare += obtuse;
  }
  facts.obtuseShare = part.Sum(facts.obtuseShare) / part.Sum(static_cast<double>(F.rows()));
  facts.longEdgeShare = LongEdgeShare(mesh, part);
  facts.areaFactor = part.IsWhole() ? std::exp(LogSpread(areas)) : 1.0;
  MeasureCurvature(mesh, part, angleSums, facts);
  facts.components = components;
  if (part.IsWhole())
  {
    CreaseProbes creases = PlaceCreaseProbes(mesh, StepOf(mesh, part));
    facts.planarShare = creases.planarShare;
    facts.boxEdges = creases.boxEdges;
    facts.border = creases.border;
    facts.creases = std::move(creases);
    facts.elongation = IsOfFaces(facts) ? Elongation(mesh) : 1.0;
  }
  return facts;
}

ResultFacts MeasureResult(const TriangleMesh& mesh, const SurfaceFacts& surface, const Points& Q,
  const MethodOptions& o, const StyleReport& report, const SurfacePart& part)
{
  ResultFacts facts;
  facts.blendsByArray = part.Sum(static_cast<double>(o.normalBlends.size())) > 0.0;
  // Several need not be star-shaped around any; with normals limbs are round by themselves.
  if (report.spheres.size() == 1 && (!o.UsesNormals(part) || o.centerMode == CenterMode::Custom))
  {
    MeasureCenter(mesh, part, report.sphere.center, o.threads, facts);
    if (facts.centerOutside && o.centerMode == CenterMode::Custom)
    {
      ResultFacts around;
      MeasureCenter(mesh, part, CentroidOfArea(mesh, part), o.threads, around);
      facts.centroidOutside = around.centerOutside;
    }
  }
  if (IsOpen(surface))
  {
    facts.creasedShare = NewCreases(surface.creases, Q);
  }
  if (ManyTurned(mesh, part, Q, o.threads))
  {
    const Matrices R = SurfaceRotations(mesh, Q, o.threads, part);
    facts.turnedOverShare = part.Sum(static_cast<double>(CountTurnedOver(mesh.P, Q, mesh.F, R))) /
      part.Sum(static_cast<double>(mesh.F.rows()));
  }
  return facts;
}

ModelFacts MeasureModel(const TriangleMesh& mesh, bool hasCoincident)
{
  ModelFacts facts;
  if (mesh.P.rows() < 2 * FewPoints)
  {
    const CreaseProbes creases = PlaceCreaseProbes(mesh);
    facts.points = static_cast<int>(mesh.P.rows());
    facts.meanAngle = creases.meanAngle;
    facts.planarShare = creases.planarShare;
    facts.isSubdividable = creases.manifold && !hasCoincident;
  }
  return facts;
}

std::string Advise(const MethodOptions& o, const SurfaceFacts& surface, const ResultFacts& result,
  const AdviceChoices& choices)
{
  const bool turned = result.turnedOverShare >= TurnedOverLimit;
  const bool creased = result.creasedShare >= CreasedLimit;
  const std::string lessRoundness = Number(std::max(LeastRoundness, 0.5 * o.lambda));
  const std::string turnedOver = Percent(result.turnedOverShare) + " of the triangles turned over";
  const bool usesNormals = o.UsesNormals() || result.blendsByArray;
  const bool uniform = o.sphericalWeighting == SphericalWeighting::Uniform;
  const bool isOfFaces = IsOfFaces(surface);
  const std::string faces =
    Percent(surface.planarShare) + " of the area is flat faces with sharp edges, which ";
  const ModelFacts& model = choices.model;
  const bool isDrawn = choices.splitShare >= PanelLimit && surface.boxEdges >= BoxEdgeLimit;
  const bool isAngular = !isDrawn && !isOfFaces && IsAngular(model);
  const std::string angular =
    "the model has only " + std::to_string(model.points) + " points, so its outline stays angular";
  const std::string longEdges =
    Percent(surface.longEdgeShare) + " of the area has edges above a tenth of the diagonal";
  struct Rule
  {
    bool applies;
    std::string advice;
  };
  // What spoils the result comes before what is only not as good as it could be. Where the property
  // has the value already, or an array replaces it, the next rule is asked.
  const Rule rules[] = {
    { turned && o.detailSize == 0.0 && !isOfFaces,
      "DetailSize " + Number(Details) + ": " + turnedOver },
    { turned && !result.blendsByArray && o.normalBlend > FewLimbs,
      "NormalBlend " + Number(FewLimbs) + ": " + turnedOver },
    { turned && o.edgeWeighting == EdgeWeighting::FullEdge,
      "EdgeWeighting HalfEdge: " + turnedOver },
    { surface.components > 1 && o.componentCoupling == ComponentCoupling::Independent,
      "ComponentCoupling Stitched: " + std::to_string(surface.components) +
        " parts share no edge" },
    { result.centerOutside && !result.centroidOutside && o.centerMode == CenterMode::Custom,
      "CenterMode AreaCentroid: Center lies outside of the model" },
    { result.centerOutside && !usesNormals,
      "NormalBlend " + Number(Limbs) + ": the center lies outside of the model" },
    { turned && choices.canAvoidFolds && !choices.avoidsFolds,
      "AvoidSelfIntersections On: " + turnedOver },
    { turned && o.lambda > LeastRoundness, "Roundness " + lessRoundness + ": " + turnedOver },
    { creased && IsOpen(surface) && !result.blendsByArray && o.normalBlend > 0.0,
      "NormalBlend 0: this open shell crumples when rounded limb by limb, on " +
        Percent(result.creasedShare) + " of its area" },
    { uniform && surface.obtuseShare >= ObtuseLimit,
      "SphericalWeighting Cotangent: " + Percent(surface.obtuseShare) +
        " of the triangles are obtuse" },
    { uniform && surface.areaFactor >= AreaFactorLimit,
      "SphericalWeighting Cotangent: areas of triangles differ by a factor of " +
        std::to_string(std::lround(surface.areaFactor)) },
    { surface.longEdgeShare >= CoarseShare && choices.refine, "RefineLongEdges On: " + longEdges },
    { surface.longEdgeShare >= CoarseShare && !choices.refine,
      "MaximumEdgeLength 0.04: " + longEdges },
    { result.facingAwayShare >= FacingAwayLimit && !usesNormals,
      "NormalBlend " + Number(Limbs) + ": " + Percent(result.facingAwayShare) +
        " of the surface faces away from the center" },
    { isOfFaces && surface.elongation >= LongLimit && o.shape.kind == TargetKind::Sphere &&
        o.targets.rows() == 0,
      "Target Ellipsoid: the model is " + std::to_string(std::lround(surface.elongation)) +
        " times as long as wide, so a ball is a bulge in its middle" },
    { isOfFaces && !result.blendsByArray && o.normalBlend > 0.0,
      "NormalBlend 0: " + faces + "stay flat when rounded limb by limb" },
    { isOfFaces && o.detailSize > 0.0, "DetailSize 0: " + faces + "stay sharp as details" },
    // That filter wants a manifold, and tears the surface at points that coincide.
    { isAngular && model.isSubdividable, "Input LoopSubdivision: " + angular },
    { isAngular,
      "T" + angular.substr(1) +
        ". A subdivision surface makes it smooth, in a modeling "
        "program: some of its edges have three faces, or points that coincide" },
  };
  const auto* const rule =
    std::find_if(std::begin(rules), std::end(rules), [](const Rule& r) { return r.applies; });
  return o.lambda > 0.0 && rule != std::end(rules) ? rule->advice : std::string();
}
} // namespace SphericalStyle
