// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FoldGuard.h"

#include "AffineFit.h"
#include "DeformationMeasures.h"
#include "Frame.h"
#include "OneRings.h"
#include "ShortestPaths.h"
#include "Smoothstep.h"
#include "Stitches.h"
#include "SurfaceMeasures.h"
#include "UnitScale.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace SphericalStyle
{
namespace
{
using Pair = std::array<int, 2>;

// Octaves: a share s is kept as log2 s, 0 or less.
constexpr double Slope = 3.0;         ///< most octaves over the diagonal: limbs move as a whole
constexpr double LocalSlope = 25.0;   ///< the same of the last resort, where the way is short
constexpr double LocalLowering = 1.0; ///< and where something folds then
constexpr double Lowering = 0.5;      ///< of all, in the first rounds
constexpr double Hurry = 2.0;         ///< of all, in further ones
constexpr int FineLowerings = 6;      ///< first rounds
constexpr double Raising = 1.0;       ///< where there is room
constexpr double Correction = 0.5;    ///< where raising was too much
constexpr double NoGain = 0.1;        ///< less is not worth a solve
constexpr int Corrections = 3;        ///< before a raising is given up
constexpr double LockWidth = 0.03;    ///< of the diagonal: no further raising around a new fold

// Repair.
constexpr double RepairWidth = 0.005; ///< of the diagonal, from the folds on; then doubled
constexpr double MostRepaired = 0.01; ///< of the surface
constexpr double FarthestMove = 0.02; ///< of the diagonal

Eigen::VectorXd Shares(const Eigen::VectorXd& octaves)
{
  return octaves.unaryExpr([](double x) { return std::exp2(x); }); // of 0 exactly 1
}

/// The triangles, of those of the mesh, whose points have an area.
std::vector<int> WithArea(const Points& Q, const Triangles& F)
{
  std::vector<int> triangles;
  for (int f = 0; f < F.rows(); ++f)
  {
    if (!IsDegenerate(Q.row(F(f, 0)), Q.row(F(f, 1)), Q.row(F(f, 2))))
    {
      triangles.push_back(f);
    }
  }
  return triangles;
}

/// Connected places of a surface.
struct Places
{
  std::vector<std::vector<int>> points;
  std::vector<int> placeOf; ///< n: -1 outside

  /// The triangles with a point in each place.
  std::vector<std::vector<int>> Triangles(const SphericalStyle::Triangles& F) const
  {
    std::vector<std::vector<int>> triangles(this->points.size());
    for (int f = 0; f < F.rows(); ++f)
    {
      for (const int i : F.row(f))
      {
        if (this->placeOf[i] >= 0)
        {
          triangles[this->placeOf[i]].push_back(f);
          break; // its other points are in no other place, since it joins them
        }
      }
    }
    return triangles;
  }
};

/// Fields of octaves, and of weights, on the points of a mesh.
class OctaveFields
{
public:
  explicit OctaveFields(const TriangleMesh& rest)
    : Mesh(rest)
    , Unit(FrameOf(rest.P))
    , InUnit(Unit.Into(rest.P))
    , Weights(PointAreas(InUnit, rest.F))
    , Stitched(rest.P.rows())
  {
    this->Weights /= this->Weights.sum();
    const MeshTopology topology(rest.F, static_cast<int>(rest.P.rows()));
    this->Rings = OneRings(topology, HalfEdgeScalars::Zero(rest.F.rows(), 3));
    // Parts that share no edge are to move with their surroundings, too.
    for (const Stitch& s : FindStitches(this->InUnit, rest.F, topology.GetComponents()))
    {
      this->Stitched[s.u].push_back(s.v);
      this->Stitched[s.v].push_back(s.u);
    }
  }

  /// The largest field that is nowhere above the given one (0 or less) and whose slope along the
  /// edges is at most so much per diagonal.
  Eigen::VectorXd Limit(Eigen::VectorXd field, double slope) const
  {
    std::vector<int> starts;
    for (int i = 0; i < field.size(); ++i)
    {
      if (field(i) < 0.0)
      {
        starts.push_back(i);
      }
    }
    LowerAlongPaths(field, starts,
      [&](int i, const auto& visit)
      {
        this->ForEachNeighbor(
          i, [&](int j) { visit(j, slope * (this->InUnit.row(i) - this->InUnit.row(j)).norm()); });
      });
    return field;
  }

  /// The field lowered at the corners of the triangles, and as far around them as the slope asks.
  Eigen::VectorXd Lower(const Eigen::VectorXd& field, const std::vector<int>& triangles,
    double octaves, double slope) const
  {
    return this->Limit(field - octaves * this->Corners(triangles), slope);
  }

  /// 1 at the corners of the triangles, falling to 0 over a width, of the diagonal.
  Eigen::VectorXd Around(const std::vector<int>& triangles, double width) const
  {
    return -this->Limit(-this->Corners(triangles), 1.0 / width);
  }

  /// Share of the surface at the points with a positive weight.
  double Area(const Eigen::VectorXd& weights) const
  {
    return this->Weights.dot((weights.array() > 0.0).cast<double>().matrix());
  }

  /// The largest distance between points of the two, of the diagonal.
  double LargestMove(const Points& Q, const Points& moved) const
  {
    return ((moved - Q) / this->Unit.scale).rowwise().norm().maxCoeff();
  }

  /// Where the weights are positive, along edges and stitches.
  Places FindPlaces(const Eigen::VectorXd& weights) const;

  /// Q with each place moved by an affine map of its own, fitted to its points and those next to
  /// it; points with smaller weights count more in the fit. A point of weight 1 goes all the way to
  /// where the map puts it, one of weight 0 stays (smoothstep). So does a point that Q leaves at
  /// rest. All stay within the bounds of Q, so that nothing gets below the ground.
  Points WithPlacesMoved(
    const Points& Q, const Places& places, const Eigen::VectorXd& weights) const;

  /// Mean share over the surface.
  double MeanShare(const Eigen::VectorXd& field) const { return this->Weights.dot(Shares(field)); }

private:
  template <typename Function>
  void ForEachNeighbor(int i, Function function) const
  {
    for (const OneRings::Neighbor& neighbor : this->Rings[i])
    {
      function(neighbor.point);
    }
    std::for_each(this->Stitched[i].begin(), this->Stitched[i].end(), function);
  }

  Eigen::VectorXd Corners(const std::vector<int>& triangles) const
  {
    Eigen::VectorXd marks = Eigen::VectorXd::Zero(this->Mesh.P.rows());
    for (const int f : triangles)
    {
      marks(this->Mesh.F.row(f).transpose()).setOnes();
    }
    return marks;
  }

  const TriangleMesh& Mesh;
  Frame Unit;
  Points InUnit; // at rest
  OneRings Rings;
  Eigen::VectorXd Weights;
  std::vector<std::vector<int>> Stitched; // points of other parts
};

Places OctaveFields::FindPlaces(const Eigen::VectorXd& weights) const
{
  Places places;
  places.placeOf.assign(weights.size(), -1);
  for (int start = 0; start < weights.size(); ++start)
  {
    if (weights(start) <= 0.0 || places.placeOf[start] >= 0)
    {
      continue;
    }
    const int place = static_cast<int>(places.points.size());
    std::vector<int> points = { start };
    places.placeOf[start] = place;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      this->ForEachNeighbor(points[k],
        [&](int j)
        {
          if (weights(j) > 0.0 && places.placeOf[j] < 0)
          {
            places.placeOf[j] = place;
            points.push_back(j);
          }
        });
    }
    places.points.push_back(std::move(points));
  }
  return places;
}

Points OctaveFields::WithPlacesMoved(
  const Points& Q, const Places& places, const Eigen::VectorXd& weights) const
{
  const Eigen::RowVector3d low = Q.colwise().minCoeff();
  const Eigen::RowVector3d high = Q.colwise().maxCoeff();
  Points moved = Q;
  for (const std::vector<int>& place : places.points)
  {
    std::vector<int> fitted = place;
    for (const int i : place)
    {
      this->ForEachNeighbor(i,
        [&](int j)
        {
          if (places.placeOf[j] < 0)
          {
            fitted.push_back(j);
          }
        });
    }
    std::sort(fitted.begin(), fitted.end());
    fitted.erase(std::unique(fitted.begin(), fitted.end()), fitted.end());
    Eigen::VectorXd a = this->Weights(fitted);
    for (Eigen::Index k = 0; k < a.size(); ++k)
    {
      a(k) *= 1.0 - Smoothstep(weights(fitted[k]));
    }
    const std::optional<AffineMap> map =
      FitAffineMap(this->InUnit(fitted, AllColumns), this->Unit.Into(Q(fitted, AllColumns)), a);
    for (const int i : place)
    {
      if (map && Q.row(i) != this->Mesh.P.row(i))
      {
        const Points there = this->Unit.OutOf((*map)(this->InUnit.row(i)));
        moved.row(i) += Smoothstep(weights(i)) * (there.row(0) - Q.row(i));
        moved.row(i) = moved.row(i).cwiseMax(low).cwiseMin(high);
      }
    }
  }
  return moved;
}

/// One run of [guard].
class Guard
{
public:
  Guard(const TriangleMesh& rest, const FoldGuardOptions& options, const IntersectionSearch& search,
    const ShareSolve& solve)
    : Rest(rest)
    , Options(options)
    , Finder(rest, search, options.singlePrecision, options.threads)
    , Solve(solve)
  {
  }

  FoldGuardReport Run();

private:
  bool Try(const Eigen::VectorXd& field);
  bool Repair();
  void Lower();
  void Raise();
  bool Correct(Eigen::VectorXd& field, Eigen::VectorXd& lock);
  void Blend();
  Points Blended(const Eigen::VectorXd& shares) const;

  const TriangleMesh& Rest;
  const FoldGuardOptions& Options;
  FoldFinder Finder;
  const ShareSolve& Solve;
  Eigen::VectorXd Field;              // accepted
  Folds Found;                        // by the last Try
  std::optional<OctaveFields> Fields; // once something folds
  int Raisings = 0;
  FoldGuardReport Report;
};

/// Solves, looks, and repairs. @return whether there are no folds
bool Guard::Try(const Eigen::VectorXd& field)
{
  this->Report.shares = Shares(field);
  this->Report.positions = this->Solve(this->Report.shares);
  this->Report.repaired = 0;
  this->Report.aborted = this->Report.positions.rows() == 0;
  if (this->Report.aborted)
  {
    return false;
  }
  this->Found = this->Finder.Find(this->Report.positions);
  if (++this->Report.solves == 1)
  {
    this->Report.before = this->Found;
  }
  return !this->Found.Any() || this->Repair();
}

/// Small places with folds move as their surroundings move. @return whether that leaves none
bool Guard::Repair()
{
  if (!this->Fields)
  {
    this->Fields.emplace(this->Rest);
  }
  double width = RepairWidth;
  for (int round = 0; round < this->Options.repairs; ++round, width *= 2.0)
  {
    const Eigen::VectorXd weights = this->Fields->Around(this->Found.triangles, width);
    if (this->Fields->Area(weights) > MostRepaired)
    {
      return false;
    }
    const Places places = this->Fields->FindPlaces(weights);
    const Points moved = this->Fields->WithPlacesMoved(this->Report.positions, places, weights);
    if (this->Fields->LargestMove(this->Report.positions, moved) <= FarthestMove &&
      !this->Finder.Find(moved, places.Triangles(this->Rest.F)).Any())
    {
      this->Report.repaired =
        static_cast<int>(((moved - this->Report.positions).array() != 0.0).rowwise().any().count());
      this->Report.positions = moved;
      this->Found = {};
      return true;
    }
  }
  return false;
}

/// The same share everywhere, so that the model moves as a whole, and ever less until nothing
/// folds.
void Guard::Lower()
{
  double octaves = 0.0;
  for (int round = 0; round < this->Options.lowerings; ++round)
  {
    octaves += round < FineLowerings ? Lowering : Hurry;
    this->Field.setConstant(-octaves);
    if (this->Try(this->Field) || this->Report.aborted)
    {
      return;
    }
  }
}

/// Takes a little back where raising brought folds, until there are none or it was tried often
/// enough. @param lock  grows by where they were
bool Guard::Correct(Eigen::VectorXd& field, Eigen::VectorXd& lock)
{
  for (int k = 0; this->Raisings++ < this->Options.raisings; ++k)
  {
    if (this->Try(field))
    {
      return true;
    }
    if (this->Report.aborted || k == Corrections)
    {
      return false;
    }
    lock = lock.cwiseMax(this->Fields->Around(this->Found.triangles, LockWidth));
    field = this->Fields->Lower(field, this->Found.triangles, Correction, Slope);
  }
  return false;
}

/// From a field without folds to a larger one. Folds can come far from where lambda grew, so each
/// trial is solved; what is accepted has none and is larger in the mean.
void Guard::Raise()
{
  Eigen::VectorXd lock = Eigen::VectorXd::Zero(this->Field.size());
  bool atAccepted = true; // the last solve is that of the field
  while (this->Raisings < this->Options.raisings && !this->Report.aborted)
  {
    const Eigen::VectorXd room = Raising * (1.0 - lock.array());
    Eigen::VectorXd field = this->Fields->Limit((this->Field + room).cwiseMin(0.0), Slope);
    if ((field - this->Field).maxCoeff() < NoGain)
    {
      break;
    }
    atAccepted = this->Correct(field, lock) &&
      this->Fields->MeanShare(field) > this->Fields->MeanShare(this->Field);
    if (atAccepted)
    {
      this->Field = field;
    }
  }
  if (!atAccepted && !this->Report.aborted)
  {
    this->Try(this->Field); // the same bits as before
  }
}

Points Guard::Blended(const Eigen::VectorXd& shares) const
{
  return this->Rest.P + shares.asDiagonal() * (this->Report.positions - this->Rest.P);
}

/// The last resort: toward the rest shape, where the folds are and then all over.
void Guard::Blend()
{
  this->Report.blended = true;
  Eigen::VectorXd field = Eigen::VectorXd::Zero(this->Field.size());
  for (int round = 0; round < this->Options.blends && this->Found.Any(); ++round)
  {
    field = this->Fields->Lower(field, this->Found.triangles, LocalLowering, LocalSlope);
    this->Found = this->Finder.Find(this->Blended(Shares(field)));
  }
  const Eigen::VectorXd local = Shares(field);
  double good = this->Found.Any() ? 0.0 : 1.0; // 0 is the rest shape
  double bad = 1.0;
  for (int round = 0; round < this->Options.blends && good < bad; ++round)
  {
    const double middle = 0.5 * (good + bad);
    (this->Finder.Find(this->Blended(middle * local)).Any() ? bad : good) = middle;
  }
  this->Report.positions = good > 0.0 ? this->Blended(good * local) : this->Rest.P;
  this->Found = {};
}

FoldGuardReport Guard::Run()
{
  this->Field = Eigen::VectorXd::Zero(this->Rest.P.rows());
  if (!this->Try(this->Field) && !this->Report.aborted)
  {
    this->Lower();
    if (this->Found.Any() && !this->Report.aborted)
    {
      this->Blend();
    }
    else
    {
      this->Raise();
    }
    this->Report.meanShare = this->Fields->MeanShare(this->Field);
  }
  this->Report.after = this->Found;
  return std::move(this->Report);
}
}

//------------------------------------------------------------------------------------------------
FoldFinder::FoldFinder(
  const TriangleMesh& rest, IntersectionSearch search, bool singlePrecision, int threads)
  : Rest(rest)
  , Search(std::move(search))
  , SinglePrecision(singlePrecision)
  , Threads(threads)
{
}

Points FoldFinder::Written(const Points& Q) const
{
  return this->SinglePrecision ? Points(Q.cast<float>().cast<double>()) : Q;
}

std::vector<Pair> FoldFinder::Pairs(const Points& Q, const std::vector<int>& triangles) const
{
  std::vector<Pair> pairs = this->Search({ Q, this->Rest.F(triangles, AllColumns) });
  for (auto& [f, g] : pairs)
  {
    f = triangles[f];
    g = triangles[g];
  }
  return pairs;
}

std::vector<int> FoldFinder::Near(const Points& Q, const std::vector<int>& triangles,
  const std::vector<std::vector<int>>& places) const
{
  const auto boxOf = [&](int f)
  {
    Eigen::AlignedBox3d box;
    for (const int i : this->Rest.F.row(f))
    {
      box.extend(Q.row(i).transpose());
    }
    return box;
  };
  std::vector<Eigen::AlignedBox3d> boxes(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    for (const int f : places[k])
    {
      boxes[k].extend(boxOf(f));
    }
  }
  std::vector<int> near;
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(near),
    [&](int f)
    {
      const Eigen::AlignedBox3d own = boxOf(f);
      return std::any_of(boxes.begin(), boxes.end(),
        [&own](const Eigen::AlignedBox3d& box) { return box.intersects(own); });
    });
  return near;
}

std::vector<Pair> FoldFinder::NewPairs(const std::vector<Pair>& pairs)
{
  if (pairs.empty())
  {
    return {};
  }
  if (!this->RestPairs)
  {
    const Points P = this->Written(this->Rest.P);
    this->RestPairs = this->Pairs(P, WithArea(P, this->Rest.F));
    this->Contacts = RestContacts(this->Rest, *this->RestPairs);
  }
  std::vector<Pair> added;
  std::set_difference(pairs.begin(), pairs.end(), this->RestPairs->begin(), this->RestPairs->end(),
    std::back_inserter(added));
  added.erase(std::remove_if(added.begin(), added.end(),
                [this](const Pair& pair) { return this->Contacts.AreNear(pair); }),
    added.end());
  return added;
}

Folds FoldFinder::Find(const Points& Q, const std::vector<std::vector<int>>& places)
{
  const Points points = this->Written(Q);
  const std::vector<int> triangles = WithArea(points, this->Rest.F);
  Folds folds;
  const double unit = UnitScale(this->Rest.P); // areas are infinite from 1e154 on
  const TriangleMesh rest = { unit * this->Rest.P, this->Rest.F(triangles, AllColumns) };
  const Points moved = unit * points;
  const std::vector<char> over =
    TurnedOver(rest.P, moved, rest.F, SurfaceRotations(rest, moved, this->Threads));
  for (std::size_t k = 0; k < over.size(); ++k)
  {
    if (over[k])
    {
      folds.triangles.push_back(triangles[k]);
    }
  }
  folds.turnedOver = static_cast<int>(folds.triangles.size());

  const std::vector<Pair> added = this->NewPairs(
    this->Pairs(points, places.empty() ? triangles : this->Near(points, triangles, places)));
  folds.newPairs = static_cast<int>(added.size());
  for (const Pair& pair : added)
  {
    folds.triangles.insert(folds.triangles.end(), pair.begin(), pair.end());
  }
  std::sort(folds.triangles.begin(), folds.triangles.end());
  folds.triangles.erase(
    std::unique(folds.triangles.begin(), folds.triangles.end()), folds.triangles.end());
  return folds;
}

//------------------------------------------------------------------------------------------------
FoldGuardReport SolveWithoutFolds(const TriangleMesh& rest, const FoldGuardOptions& options,
  const IntersectionSearch& search, const ShareSolve& solve)
{
  return Guard(rest, options, search, solve).Run();
}
} // namespace SphericalStyle
