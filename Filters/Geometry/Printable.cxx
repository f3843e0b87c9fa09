// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Printable.h"

#include "SelfIntersections.h"
#include "Standing.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

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

int CountIntersecting(const TriangleMesh& mesh)
{
  std::set<int> triangles;
  for (const auto& pair : SelfIntersections(mesh))
  {
    triangles.insert(pair.begin(), pair.end());
  }
  return static_cast<int>(triangles.size());
}

Eigen::Vector2d Across(const Eigen::Vector3d& p, int axis)
{
  return { p((axis + 1) % 3), p((axis + 2) % 3) };
}

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

/// The whole mesh, nothing cut.
DerivedSurface Whole(const TriangleMesh& mesh)
{
  DerivedSurface whole = Underived(mesh);
  SplitFans(whole);
  return whole;
}

/// [foot]
DerivedSurface GiveFoot(const TriangleMesh& mesh, const PrintableOptions& options, double& depth)
{
  const int axis = options.axis;
  const double rectangle = Extent(mesh.P, (axis + 1) % 3) * Extent(mesh.P, (axis + 2) % 3);
  const double wanted = options.footArea * rectangle;
  const double height = Extent(mesh.P, axis);
  const double ground = mesh.P.col(axis).minCoeff();
  const double has = GroundArea(mesh, axis, OnGround * height);
  depth = 0.0;
  if (wanted <= has)
  {
    DerivedSurface whole = Whole(mesh);
    for (auto p : whole.mesh.P.rowwise())
    {
      p(axis) = p(axis) <= ground + OnGround * height ? ground : p(axis);
    }
    return whole;
  }
  double most = 0.0;
  const double level = FootLevel(mesh, axis, wanted, ground + DeepestCut * height, most);
  if (std::isnan(level))
  {
    throw std::invalid_argument("FootArea: a cut of up to a fifth of the height makes a foot of " +
      Text(std::floor(std::max(most, has) / rectangle * 1e3) / 1e3) +
      " of the rectangle that the model covers on the ground, not " + Text(options.footArea) +
      "; choose less, or see UpAxis");
  }
  for (int k = 0; k < Tries; ++k)
  {
    depth = level - ground + k * Higher * height;
    DerivedSurface cut = CutFlat(mesh, axis, ground + depth);
    if (cut.mesh.F.rows() > 0)
    {
      return cut;
    }
  }
  throw std::invalid_argument("FootArea: the model runs through itself where it would be cut, " +
    Text(depth) +
    " above its lowest point; Surface Metrics shows where. Choose another FootArea, "
    "or 0 for no cut");
}

/// [stands]
double MakeStable(const PrintableOptions& options, Points& P, const Triangles& F)
{
  const int axis = options.axis;
  const double level = P.col(axis).minCoeff();
  const SupportPolygon support = FindSupport(P, axis, OnGround * Extent(P, axis));
  const Eigen::Vector3d center = CenterOfMass({ P, F });
  const double height = center(axis) - level;
  Eigen::Vector2d place;
  double most = 0.0;
  const std::string wanted = "StabilityAngle: " + Text(options.stabilityAngle) + " degrees ";
  if (!NearestStablePlace(
        support, Across(center, axis), height, options.stabilityAngle, place, most))
  {
    throw std::invalid_argument(wanted +
      (support.size() < 3
          ? "need a flat foot, and the model stands on a point or a line; set FootArea to more "
            "than "
            "0, or StabilityAngle to 0"
          : "cannot be reached with the largest foot that is allowed: the center of mass above its "
            "middle makes " +
            Text(std::floor(most * 10.0) / 10.0) + "; choose less, or see FootArea and UpAxis"));
  }
  const Eigen::Vector2d shear = (place - Across(center, axis)) / height;
  const double lean = std::atan(shear.norm()) * 180.0 / Pi;
  if (lean > MostLean)
  {
    throw std::invalid_argument(wanted + "would need a lean of " + Text(lean) +
      " degrees with the largest foot that is allowed, and more than " + Text(MostLean) +
      " are not done; choose less, or see FootArea and UpAxis");
  }
  if (lean > 0.0)
  {
    const Eigen::VectorXd above = P.col(axis).array() - level;
    P.col((axis + 1) % 3) += shear(0) * above;
    P.col((axis + 2) % 3) += shear(1) * above;
  }
  return lean;
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
} // namespace

PrintableResult MakePrintable(const TriangleMesh& mesh, const PrintableOptions& options)
{
  PrintableResult result;
  result.before = Measure(mesh, options.axis);
  if (!(result.before.volume > 0.0) || !(result.before.height > 0.0))
  {
    throw std::invalid_argument("The surface encloses no volume, so there is nothing to print");
  }
  result.surface = options.footArea > 0.0 ? GiveFoot(mesh, options, result.cutDepth) : Whole(mesh);
  for (PrintableOptions larger = options; options.stabilityAngle > 0.0;)
  {
    try
    {
      result.lean = MakeStable(options, result.surface.mesh.P, result.surface.mesh.F);
      break;
    }
    catch (const std::invalid_argument&)
    {
      larger.footArea *= LargerFoot;
      if (!(larger.footArea > 0.0 && larger.footArea <= 1.0))
      {
        throw;
      }
      DerivedSurface grown;
      try
      {
        grown = GiveFoot(mesh, larger, result.cutDepth);
      }
      catch (const std::invalid_argument&) // what is said below is what the user wants to know
      {
        MakeStable(options, result.surface.mesh.P, result.surface.mesh.F);
      }
      result.surface = grown;
    }
  }
  TriangleMesh& made = result.surface.mesh;
  const bool isKept = options.volume == 0.0 && options.height == 0.0 && result.cutDepth == 0.0;
  if (!isKept) // else to the bit
  {
    result.factor = MakeSize(result.before.volume, options, made.P, made.F);
  }
  result.after = Measure(made, options.axis);
  return result;
}
} // namespace SphericalStyle
