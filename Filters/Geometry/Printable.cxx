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
/// Volume over area^1.5 up to which a surface is flat: rounding of single precision gives it 1e-8.
constexpr double FlatSheet = 1e-6;
/// Share of the height within which points lie on the ground.
constexpr double OnGround = 1e-6;
/// How often a cut that runs through itself is tried somewhat higher, and how much, a share of the
/// height.
constexpr int Tries = 5;
constexpr double Higher = 1e-3;
/// By how much a foot grows on which the model cannot stand.
constexpr double LargerFoot = 1.2;
/// Share of the height from which on a remark says what the cut takes off.
constexpr double MuchCut = 0.1;
/// How often walls are made thicker again because the model became smaller.
constexpr int Thickenings = 10;
/// By which share the least thickness has to grow for another try.
constexpr double WorthATry = 1e-3;
/// What share may be left of what is missing where the thinnest wall became thinner.
constexpr double WorthAThinWall = 0.5;

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
  double depth = 0.0;     // of the cut
  double footDepth = 0.0; // of the cut for FootArea alone
  double lean = 0.0;      // degrees
  Eigen::Vector2d shear = Eigen::Vector2d::Zero();
  double tiltAngle = -std::numeric_limits<double>::infinity(); // or what is wanted, if more
  std::string problem;                                         // why there is none
  std::string footRemark; // the foot is smaller than wanted, or takes much off
  std::string tiltRemark; // the angle is
};

/// As it is, its ground flat to the bit.
Stand WithoutCut(const TriangleMesh& mesh, int axis, bool hasFoot)
{
  Stand stand;
  stand.surface = Underived(mesh);
  const double ground = mesh.P.col(axis).minCoeff();
  const double tolerance = OnGround * Extent(mesh.P, axis);
  for (auto p : stand.surface.mesh.P.rowwise())
  {
    p(axis) = hasFoot && p(axis) <= ground + tolerance ? ground : p(axis);
  }
  return stand;
}

/// The wanted foot, or the largest one in reach. [foot]
Stand GiveFoot(const TriangleMesh& mesh, const PrintableOptions& options, double footArea)
{
  const int axis = options.axis;
  const double rectangle = Extent(mesh.P, (axis + 1) % 3) * Extent(mesh.P, (axis + 2) % 3);
  const double wanted = footArea * rectangle;
  const double height = Extent(mesh.P, axis);
  const double ground = mesh.P.col(axis).minCoeff();
  const double has = GroundArea(mesh, axis, OnGround * height);
  if (footArea == 0.0 || wanted <= has)
  {
    return WithoutCut(mesh, axis, footArea > 0.0);
  }
  const double deepest = ground + DeepestCut * height;
  double most = 0.0;
  double level = FootLevel(mesh, axis, wanted, deepest, most);
  Stand stand;
  if (std::isnan(level))
  {
    const std::string remark = "FootArea: a cut of up to a fifth of the height makes a foot of " +
      Text(std::floor(std::max(most, has) / rectangle * 1e3) / 1e3) +
      " of the rectangle that the model covers on the ground, not " + Text(footArea) +
      ", and that is what it has. A smaller foot takes less off the model; UpAxis chooses another "
      "side to stand on";
    if (most <= has)
    {
      stand = WithoutCut(mesh, axis, true);
      stand.footRemark = remark;
      return stand;
    }
    stand.footRemark = remark;
    level = FootLevel(mesh, axis, most, deepest, most);
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

/// Of a cut that takes much off; empty where it does not.
std::string CutRemark(const Stand& stand, const PrintableOptions& options, double height)
{
  if (stand.depth <= MuchCut * height)
  {
    return {};
  }
  const auto share = [height](double depth)
  { return std::to_string(std::lround(100.0 * depth / height)) + " % "; };
  return "The foot takes " + share(stand.depth) + "of the height along " + "XYZ"[options.axis] +
    " off the model" +
    (options.stabilityAngle > 0.0 && stand.footDepth < stand.depth
        ? " to make it stand, and " + share(stand.footDepth) + "with StabilityAngle 0; UpAxis"
        : ": a smaller FootArea takes less, and UpAxis") +
    " chooses another side to stand on";
}

/// Of a model that cannot be tilted as far as wanted; empty where it can.
std::string TiltRemark(double wanted, double reached, bool hasNoFoot)
{
  if (reached >= wanted)
  {
    return {};
  }
  const std::string begin = "StabilityAngle: ";
  const std::string most = "with the largest foot and a lean of up to " + Text(MostLean) +
    " degrees; see FootArea and UpAxis";
  if (hasNoFoot)
  {
    return begin +
      "the model stands on a point or a line, so it falls over; set FootArea to more than 0, or "
      "StabilityAngle to 0";
  }
  return begin +
    (reached > 0.0 ? "the model can be tilted by " + Text(std::floor(reached * 10.0) / 10.0) +
          " degrees before it falls over, not " + Text(wanted) + ", "
                   : "the model falls over even ") +
    most;
}

/// How the center of mass has to move so that the model can be tilted by an angle.
/// @return false where it would have to lean too much, or no place is good enough
bool FindShear(const SupportPolygon& support, const Eigen::Vector2d& center, double height,
  double angle, Eigen::Vector2d& shear)
{
  Eigen::Vector2d place;
  const bool isFound = NearestStablePlace(support, center, height, angle, place);
  shear = (place - center) / height;
  return isFound && std::atan(shear.norm()) <= MostLean * Pi / 180.0;
}

/// The lean that takes the center of mass above the foot, as far as a lean can. [stands]
void FindLean(const PrintableOptions& options, Stand& stand)
{
  const int axis = options.axis;
  const TriangleMesh& mesh = stand.surface.mesh;
  if (options.stabilityAngle == 0.0)
  {
    // Near a tip the cut can leave a foot without an area: a larger one is tried.
    const bool isPoint = options.footArea > 0.0 && GroundArea(mesh, axis, 0.0) == 0.0;
    stand.tiltAngle = isPoint ? -90.0 : 0.0;
    return;
  }
  const SupportPolygon support = FindSupport(mesh.P, axis, OnGround * Extent(mesh.P, axis));
  const Eigen::Vector3d centerOfMass = CenterOfMass(mesh);
  const Eigen::Vector2d center = Across(centerOfMass, axis);
  const double height = centerOfMass(axis) - mesh.P.col(axis).minCoeff();
  const double before = TiltAngle(support, center, height);
  stand.shear.setZero();
  stand.tiltAngle = std::min(before, options.stabilityAngle);
  Eigen::Vector2d shear;
  if (FindShear(support, center, height, options.stabilityAngle, shear))
  {
    stand.shear = shear;
    stand.tiltAngle = options.stabilityAngle;
  }
  else if (FindShear(support, center, height, std::max(0.0, before), shear))
  {
    double high = options.stabilityAngle;
    stand.tiltAngle = std::max(0.0, before);
    for (int step = 0; step < 60; ++step)
    {
      const double middle = 0.5 * (stand.tiltAngle + high);
      (FindShear(support, center, height, middle, shear) ? stand.tiltAngle : high) = middle;
    }
    FindShear(support, center, height, stand.tiltAngle, stand.shear);
  }
  stand.lean = std::atan(stand.shear.norm()) * 180.0 / Pi;
  stand.tiltRemark = TiltRemark(options.stabilityAngle, stand.tiltAngle, support.size() < 3);
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

/// Of feet from the wanted one on, the one that changes the model least [stands]; where none makes
/// it stand as wanted, the one that comes nearest.
/// @throw std::invalid_argument where it cannot be cut
Stand FindStand(const TriangleMesh& mesh, const PrintableOptions& options)
{
  const double deepest = DeepestCut * Extent(mesh.P, options.axis);
  const auto square = [](double x) { return x * x; };
  Stand best;
  double least = std::numeric_limits<double>::infinity();
  double footDepth = deepest;
  std::string problem;
  for (int k = 0;; ++k)
  {
    const double area = options.footArea * std::pow(LargerFoot, k);
    const bool isFirst = k == 0;
    const bool stands = best.tiltAngle >= options.stabilityAngle;
    if (!isFirst && (area > 1.0 || area == 0.0 || (stands && best.lean == 0.0)))
    {
      break;
    }
    options.onStep();
    Stand stand = GiveFoot(mesh, options, area);
    if (isFirst && stand.problem.empty())
    {
      footDepth = stand.depth;
    }
    const bool isLargest = !stand.footRemark.empty();
    if (!isFirst && (isLargest || (stands && square(stand.depth / deepest) >= least)))
    {
      break;
    }
    if (stand.problem.empty())
    {
      FindLean(options, stand);
      const double change = square(stand.lean / MostLean) + square(stand.depth / deepest);
      if (stand.tiltAngle > best.tiltAngle || (stand.tiltAngle == best.tiltAngle && change < least))
      {
        least = change;
        best = std::move(stand);
      }
    }
    else
    {
      problem = stand.problem;
    }
    if (isLargest)
    {
      break;
    }
  }
  if (best.surface.mesh.F.rows() == 0)
  {
    throw std::invalid_argument(problem);
  }
  best.footDepth = footDepth;
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
  made.P = ThickenWalls(made, options.thickness, options.threads,
    { axis, made.P.col(axis).minCoeff() }, options.onStep);
  const Eigen::Vector2d before = stand.shear;
  FindLean(options, stand);
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
  if (stand.footRemark.empty())
  {
    stand.footRemark = CutRemark(stand, options, Extent(mesh.P, options.axis));
  }
  result.remarks.clear();
  for (const std::string& remark : { stand.footRemark, stand.tiltRemark })
  {
    if (!remark.empty())
    {
      result.remarks.push_back(remark);
    }
  }
  result.thickness = FindWalls(made, options.threads).thickness;
  result.surface = std::move(stand.surface);
}

/// What walls are thinner than they have to be.
struct MissingWalls
{
  double least = std::numeric_limits<double>::infinity(); // thickness of the walls above the foot
  double above = 0.0;                                     // sum above the foot
  double all = 0.0;                                       // and with the rim that a cut leaves

  MissingWalls(const PrintableResult& result, const PrintableOptions& options)
  {
    const auto z = result.surface.mesh.P.col(options.axis);
    const double foot = z.minCoeff();
    for (Eigen::Index i = 0; i < z.size(); ++i)
    {
      const double thickness = std::min(result.thickness(i), options.thickness);
      this->all += options.thickness - thickness;
      if (z(i) > foot)
      {
        this->above += options.thickness - thickness;
        this->least = std::min(this->least, thickness);
      }
    }
  }
  /// Much less where the thinnest wall became thinner.
  bool IsLessThan(const MissingWalls& other) const
  {
    const double share = this->least < other.least ? WorthAThinWall : 1.0;
    return std::make_pair(this->above, this->all) < std::make_pair(share * other.above, other.all);
  }
};
} // namespace

PrintableResult MakePrintable(const TriangleMesh& mesh, const PrintableOptions& options)
{
  PrintableResult result;
  result.before = Measure(mesh, options.axis);
  const double area = TriangleAreas(mesh.P, mesh.F).sum();
  if (!(result.before.volume > FlatSheet * area * std::sqrt(area)) || !(result.before.height > 0.0))
  {
    throw std::invalid_argument("The surface is flat and encloses no volume, so there is nothing "
                                "to print. Give it a thickness first, for instance with Linear "
                                "Extrusion");
  }
  result.before.thickness = FindWalls(mesh, options.threads).thickness.minCoeff();
  const bool hasBase = result.before.footArea > 0.0;
  const TriangleMesh standing = WithoutCut(mesh, options.axis, hasBase).surface.mesh;
  // A flat base stays one.
  const Ground ground = hasBase ? Ground{ options.axis, result.before.footLevel } : Ground();
  StandAndScale(mesh, options, false, result);
  // Walls are made thicker before, so by more where the model becomes smaller.
  double wanted = options.thickness / result.factor;
  MissingWalls missing(result, options);
  for (int k = 0; k < Thickenings && missing.all > 0.0; ++k)
  {
    const Points P = ThickenWalls(standing, wanted, options.threads, ground, options.onStep);
    const PrintableResult thinner = result;
    result.thickened = (P - mesh.P).rowwise().norm().maxCoeff();
    StandAndScale({ P, mesh.F }, options, true, result);
    const MissingWalls stillMissing(result, options);
    if (!stillMissing.IsLessThan(missing))
    {
      result = thinner;
      result.isSizeShort = true;
      break;
    }
    const double next = options.thickness / result.factor;
    if (next <= wanted || stillMissing.least <= (1.0 + WorthATry) * missing.least)
    {
      break; // nothing more would change
    }
    wanted = next;
    missing = stillMissing;
  }
  result.after = Measure(result.surface.mesh, options.axis);
  result.after.thickness = result.thickness.minCoeff();
  return result;
}
} // namespace SphericalStyle
