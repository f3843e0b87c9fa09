// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Printable.h"

#include "SelfIntersections.h"
#include "Standing.h"
#include "SurfaceMeasures.h"
#include "WallThickness.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace SphericalStyle
{
namespace
{
/// Share of the height within which points lie on the ground.
constexpr double OnGround = 1e-6;
/// How often a cut that runs through itself is tried somewhat higher, and how much, a share of the
/// height.
constexpr int Tries = 5;
constexpr double Higher = 1e-3;
/// By how much a foot grows on which the model cannot stand.
constexpr double LargerFoot = 1.2;
/// How often walls are made thicker again because the model became smaller.
constexpr int Thickenings = 10;
/// By which share the least thickness has to grow for another try.
constexpr double WorthATry = 1e-3;

std::string Text(double number)
{
  std::ostringstream text;
  text.precision(3);
  text << number;
  return text.str();
}

double Extent(const Points& P, int axis)
{
  return P.col(axis).maxCoeff() - P.col(axis).minCoeff();
}

/// Triangles with points at one place as one, so that parts that were taken apart do not touch.
Triangles Joined(const TriangleMesh& mesh)
{
  const auto position = [&mesh](int i)
  { return std::make_tuple(mesh.P(i, 0), mesh.P(i, 1), mesh.P(i, 2)); };
  std::vector<int> order(mesh.P.rows());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&](int i, int j) { return std::make_pair(position(i), i) < std::make_pair(position(j), j); });
  std::vector<int> first(mesh.P.rows());
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    const bool isSame = k > 0 && position(order[k]) == position(order[k - 1]);
    first[order[k]] = isSame ? first[order[k - 1]] : order[k];
  }
  Triangles joined = mesh.F.unaryExpr([&first](int i) { return first[i]; });
  Eigen::Index kept = 0; // a triangle whose points lie at one place has no area
  for (Eigen::Index f = 0; f < joined.rows(); ++f)
  {
    const Eigen::RowVector3i t = joined.row(f);
    if (t(0) != t(1) && t(1) != t(2) && t(2) != t(0))
    {
      joined.row(kept++) = t;
    }
  }
  joined.conservativeResize(kept, 3);
  return joined;
}

int CountIntersecting(const TriangleMesh& mesh)
{
  const std::vector<char> intersecting = IntersectingTriangles({ mesh.P, Joined(mesh) });
  return static_cast<int>(std::count(intersecting.begin(), intersecting.end(), 1));
}

Eigen::Vector2d Across(const Eigen::Vector3d& p, int axis)
{
  return { p((axis + 1) % 3), p((axis + 2) % 3) };
}

/// All but the thickness.
PrintableMeasures Measure(const TriangleMesh& mesh, int axis)
{
  PrintableMeasures measures;
  measures.height = Extent(mesh.P, axis);
  const double tolerance = OnGround * measures.height;
  measures.footLevel = mesh.P.col(axis).minCoeff();
  measures.footArea = GroundArea(mesh, axis, tolerance);
  measures.volume = EnclosedVolume(mesh.P, mesh.F);
  measures.centerOfMass = CenterOfMass(mesh);
  measures.tiltAngle = TiltAngle(FindSupport(mesh.P, axis, tolerance),
    Across(measures.centerOfMass, axis), measures.centerOfMass(axis) - measures.footLevel);
  measures.selfIntersecting = CountIntersecting(mesh);
  return measures;
}

/// What the model stands on.
struct Stand
{
  DerivedSurface surface;
  double depth = 0.0; // of the cut
  double lean = 0.0;  // degrees
  Eigen::Vector2d shear = Eigen::Vector2d::Zero();
  std::string problem;       // why there is none
  bool isOutOfReach = false; // a larger foot is as well
};

/// [foot]
Stand GiveFoot(const TriangleMesh& mesh, const PrintableOptions& options, double footArea)
{
  const int axis = options.axis;
  const double rectangle = Extent(mesh.P, (axis + 1) % 3) * Extent(mesh.P, (axis + 2) % 3);
  const double wanted = footArea * rectangle;
  const double height = Extent(mesh.P, axis);
  const double ground = mesh.P.col(axis).minCoeff();
  const double has = GroundArea(mesh, axis, OnGround * height);
  Stand stand;
  if (footArea == 0.0 || wanted <= has)
  {
    stand.surface = Underived(mesh);
    for (auto p : stand.surface.mesh.P.rowwise())
    {
      p(axis) = footArea > 0.0 && p(axis) <= ground + OnGround * height ? ground : p(axis);
    }
    return stand;
  }
  double most = 0.0;
  const double level = FootLevel(mesh, axis, wanted, ground + DeepestCut * height, most);
  if (std::isnan(level))
  {
    stand.isOutOfReach = true;
    stand.problem = "FootArea: a cut of up to a fifth of the height makes a foot of " +
      Text(std::floor(std::max(most, has) / rectangle * 1e3) / 1e3) +
      " of the rectangle that the model covers on the ground, not " + Text(footArea) +
      "; choose less, or see UpAxis";
    return stand;
  }
  for (int k = 0; k < Tries; ++k)
  {
    stand.depth = level - ground + k * Higher * height;
    stand.surface = CutFlat(mesh, axis, ground + stand.depth);
    if (stand.surface.mesh.F.rows() > 0)
    {
      return stand;
    }
  }
  stand.problem = "FootArea: the model runs through itself where it would be cut, " +
    Text(stand.depth) +
    " above its lowest point; Surface Metrics shows where. Choose another FootArea, "
    "or 0 for no cut";
  return stand;
}

/// The lean that takes the center of mass above the foot [stands], or why there is none.
void FindLean(const PrintableOptions& options, Stand& stand)
{
  const int axis = options.axis;
  const TriangleMesh& mesh = stand.surface.mesh;
  const SupportPolygon support = FindSupport(mesh.P, axis, OnGround * Extent(mesh.P, axis));
  const Eigen::Vector3d center = CenterOfMass(mesh);
  const double height = center(axis) - mesh.P.col(axis).minCoeff();
  Eigen::Vector2d place;
  double most = 0.0;
  const std::string wanted = "StabilityAngle: " + Text(options.stabilityAngle) + " degrees ";
  if (!NearestStablePlace(
        support, Across(center, axis), height, options.stabilityAngle, place, most))
  {
    stand.problem = support.size() < 3 ? wanted +
        "need a flat foot, and the model stands on a point or a line; set FootArea to more than 0, "
        "or StabilityAngle to 0"
                                       : wanted +
        "cannot be reached with the largest foot that is allowed: the center of mass above its "
        "middle makes " +
        Text(std::floor(most * 10.0) / 10.0) + "; choose less, or see FootArea and UpAxis";
    return;
  }
  stand.shear = (place - Across(center, axis)) / height;
  stand.lean = std::atan(stand.shear.norm()) * 180.0 / Pi;
  if (stand.lean > MostLean)
  {
    stand.problem = wanted + "would need a lean of " + Text(stand.lean) +
      " degrees with the largest foot that is allowed, and more than " + Text(MostLean) +
      " are not done; choose less, or see FootArea and UpAxis";
  }
}

void LeanBy(const Eigen::Vector2d& shear, int axis, Points& P)
{
  if (!shear.isZero(0.0)) // else to the bit
  {
    const Eigen::VectorXd above = P.col(axis).array() - P.col(axis).minCoeff();
    P.col((axis + 1) % 3) += shear(0) * above;
    P.col((axis + 2) % 3) += shear(1) * above;
  }
}

/// Of feet from the wanted one on, the one that changes the model least [stands].
/// @throw std::invalid_argument where it cannot stand
Stand FindStand(const TriangleMesh& mesh, const PrintableOptions& options)
{
  const double deepest = DeepestCut * Extent(mesh.P, options.axis);
  const auto square = [](double x) { return x * x; };
  Stand best;
  double least = std::numeric_limits<double>::infinity();
  std::string problem;
  for (int k = 0;; ++k)
  {
    const double area = options.footArea * std::pow(LargerFoot, k);
    const bool isFirst = k == 0;
    if (area > 1.0 && !isFirst)
    {
      break;
    }
    Stand stand = GiveFoot(mesh, options, area);
    const bool isBeyond = stand.isOutOfReach || square(stand.depth / deepest) >= least;
    if (isBeyond && !isFirst)
    {
      break;
    }
    if (stand.problem.empty() && options.stabilityAngle > 0.0)
    {
      FindLean(options, stand);
    }
    if (isFirst || !stand.problem.empty())
    {
      problem = stand.problem;
    }
    const double change = square(stand.lean / MostLean) + square(stand.depth / deepest);
    if (stand.problem.empty() && change < least)
    {
      least = change;
      best = std::move(stand);
    }
    const bool stands = least < std::numeric_limits<double>::infinity() && best.lean == 0.0;
    if (stands || area == 0.0 || (isFirst && isBeyond))
    {
      break;
    }
  }
  if (best.surface.mesh.F.rows() == 0)
  {
    throw std::invalid_argument(problem);
  }
  return best;
}

/// Scales about a place on the ground. @return the factor
double MakeSize(double before, const PrintableOptions& options, Points& P, const Triangles& F)
{
  const double factor = options.height > 0.0
    ? options.height / Extent(P, options.axis)
    : std::cbrt((options.volume > 0.0 ? options.volume : before) / EnclosedVolume(P, F));
  if (factor != 1.0)
  {
    Eigen::RowVector3d place = CenterOfMass({ P, F }).transpose();
    place(options.axis) = P.col(options.axis).minCoeff();
    P = ((P.rowwise() - place) * factor).rowwise() + place;
  }
  return factor;
}

/// What the cut, or the surface between the points that were looked at, left too thin.
void ThickenOnFoot(const PrintableOptions& options, Stand& stand)
{
  TriangleMesh& made = stand.surface.mesh;
  const int axis = options.axis;
  made.P =
    ThickenWalls(made, options.thickness, options.threads, { axis, made.P.col(axis).minCoeff() });
  const Eigen::Vector2d before = stand.shear;
  if (options.stabilityAngle > 0.0)
  {
    FindLean(options, stand);
  }
  if (!stand.problem.empty())
  {
    throw std::invalid_argument(stand.problem);
  }
  LeanBy(stand.shear, axis, made.P);
  stand.shear += before;
  stand.lean = std::atan(stand.shear.norm()) * 180.0 / Pi;
}

/// @param isThick  whether walls of the mesh are, about, as thick as they have to be
void StandAndScale(
  const TriangleMesh& mesh, const PrintableOptions& options, bool isThick, PrintableResult& result)
{
  Stand stand = FindStand(mesh, options);
  TriangleMesh& made = stand.surface.mesh;
  LeanBy(stand.shear, options.axis, made.P);
  const bool isKept =
    options.volume == 0.0 && options.height == 0.0 && stand.depth == 0.0 && !isThick;
  result.factor = isKept ? 1.0 : MakeSize(result.before.volume, options, made.P, made.F);
  if (isThick)
  {
    ThickenOnFoot(options, stand);
    result.factor *= MakeSize(result.before.volume, options, made.P, made.F);
  }
  result.lean = stand.lean;
  result.cutDepth = stand.depth;
  result.thickness = FindWalls(made, options.threads).thickness;
  result.surface = std::move(stand.surface);
}
} // namespace

PrintableResult MakePrintable(const TriangleMesh& mesh, const PrintableOptions& options)
{
  PrintableResult result;
  result.before = Measure(mesh, options.axis);
  if (!(result.before.volume > 0.0) || !(result.before.height > 0.0))
  {
    throw std::invalid_argument("The surface encloses no volume, so there is nothing to print");
  }
  result.before.thickness = FindWalls(mesh, options.threads).thickness.minCoeff();
  StandAndScale(mesh, options, false, result);
  // Walls are made thicker before, so by more where the model becomes smaller.
  double wanted = options.thickness / result.factor;
  double reached = result.thickness.minCoeff();
  for (int k = 0; k < Thickenings && result.thickness.minCoeff() < options.thickness; ++k)
  {
    const Points P = ThickenWalls(mesh, wanted, options.threads);
    result.thickened = (P - mesh.P).rowwise().norm().maxCoeff();
    StandAndScale({ P, mesh.F }, options, true, result);
    const double next = options.thickness / result.factor;
    const double least = result.thickness.minCoeff();
    if (next <= wanted || least <= (1.0 + WorthATry) * reached)
    {
      break; // nothing more would change
    }
    wanted = next;
    reached = least;
  }
  result.after = Measure(result.surface.mesh, options.axis);
  result.after.thickness = result.thickness.minCoeff();
  return result;
}
} // namespace SphericalStyle
