// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FoldGuard.h"

#include "DeformationMeasures.h"
#include "Frame.h"
#include "OneRings.h"
#include "Stitches.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <queue>
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

/// Fields of octaves on the points of a mesh.
class OctaveFields
{
public:
  explicit OctaveFields(const TriangleMesh& rest)
    : Mesh(rest)
    , Diagonal((rest.P.colwise().maxCoeff() - rest.P.colwise().minCoeff()).stableNorm())
    , Weights(PointAreas(rest.P, rest.F) / PointAreas(rest.P, rest.F).sum())
    , Stitched(rest.P.rows())
  {
    const MeshTopology topology(rest.F, static_cast<int>(rest.P.rows()));
    this->Rings = OneRings(topology, HalfEdgeScalars::Zero(rest.F.rows(), 3));
    // Parts that share no edge are to move with their surroundings, too.
    for (const Stitch& s :
      FindStitches(FrameOf(rest.P).Into(rest.P), rest.F, topology.GetComponents()))
    {
      this->Stitched[s.u].push_back(s.v);
      this->Stitched[s.v].push_back(s.u);
    }
  }

  /// The largest field that is nowhere above the given one (0 or less) and whose slope along the
  /// edges is at most so much per diagonal: Dijkstra's paths from the low points.
  Eigen::VectorXd Limit(Eigen::VectorXd field, double slope) const
  {
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (int i = 0; i < field.size(); ++i)
    {
      if (field(i) < 0.0)
      {
        queue.push({ field(i), i });
      }
    }
    while (!queue.empty())
    {
      const auto [value, i] = queue.top();
      queue.pop();
      if (value > field(i))
      {
        continue; // was lowered since
      }
      const auto reach = [&, from = i, start = value](int j)
      {
        const double length = (this->Mesh.P.row(from) - this->Mesh.P.row(j)).norm();
        const double bound = start + slope * length / this->Diagonal;
        if (bound < field(j))
        {
          field(j) = bound;
          queue.push({ bound, j });
        }
      };
      for (const OneRings::Neighbor& neighbor : this->Rings[i])
      {
        reach(neighbor.point);
      }
      std::for_each(this->Stitched[i].begin(), this->Stitched[i].end(), reach);
    }
    return field;
  }

  /// The field lowered at the corners of the triangles, and as far around them as the slope asks.
  Eigen::VectorXd Lower(const Eigen::VectorXd& field, const std::vector<int>& triangles,
    double octaves, double slope) const
  {
    return this->Limit(field - octaves * this->Corners(triangles), slope);
  }

  /// 1 at the corners of the triangles, falling to 0 over LockWidth.
  Eigen::VectorXd Around(const std::vector<int>& triangles) const
  {
    return -this->Limit(-this->Corners(triangles), 1.0 / LockWidth);
  }

  /// Mean share over the surface.
  double MeanShare(const Eigen::VectorXd& field) const { return this->Weights.dot(Shares(field)); }

private:
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
  OneRings Rings;
  double Diagonal;
  Eigen::VectorXd Weights;
  std::vector<std::vector<int>> Stitched; // points of other parts
};

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
  void SolveAt(const Eigen::VectorXd& field);
  bool Try(const Eigen::VectorXd& field);
  void Lower();
  void Raise(const OctaveFields& fields);
  bool Correct(const OctaveFields& fields, Eigen::VectorXd& field, Eigen::VectorXd& lock);
  void Blend(const OctaveFields& fields);
  Points Blended(const Eigen::VectorXd& shares) const;

  const TriangleMesh& Rest;
  const FoldGuardOptions& Options;
  FoldFinder Finder;
  const ShareSolve& Solve;
  Eigen::VectorXd Field; // accepted
  Folds Found;           // by the last Try
  int Raisings = 0;
  FoldGuardReport Report;
};

void Guard::SolveAt(const Eigen::VectorXd& field)
{
  this->Report.shares = Shares(field);
  this->Report.positions = this->Solve(this->Report.shares);
  this->Report.aborted = this->Report.positions.rows() == 0;
  this->Report.solves += this->Report.aborted ? 0 : 1;
}

/// Solves and looks. @return whether there are no folds
bool Guard::Try(const Eigen::VectorXd& field)
{
  this->SolveAt(field);
  if (this->Report.aborted)
  {
    return false;
  }
  this->Found = this->Finder.Find(this->Report.positions);
  return !this->Found.Any();
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
bool Guard::Correct(const OctaveFields& fields, Eigen::VectorXd& field, Eigen::VectorXd& lock)
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
    lock = lock.cwiseMax(fields.Around(this->Found.triangles));
    field = fields.Lower(field, this->Found.triangles, Correction, Slope);
  }
  return false;
}

/// From a field without folds to a larger one. Folds can come far from where lambda grew, so each
/// trial is solved; what is accepted has none and is larger in the mean.
void Guard::Raise(const OctaveFields& fields)
{
  Eigen::VectorXd lock = Eigen::VectorXd::Zero(this->Field.size());
  bool atAccepted = true; // the last solve is that of the field
  while (this->Raisings < this->Options.raisings && !this->Report.aborted)
  {
    const Eigen::VectorXd room = Raising * (1.0 - lock.array());
    Eigen::VectorXd field = fields.Limit((this->Field + room).cwiseMin(0.0), Slope);
    if ((field - this->Field).maxCoeff() < NoGain)
    {
      break;
    }
    atAccepted =
      this->Correct(fields, field, lock) && fields.MeanShare(field) > fields.MeanShare(this->Field);
    if (atAccepted)
    {
      this->Field = field;
    }
  }
  if (!atAccepted && !this->Report.aborted)
  {
    this->SolveAt(this->Field);
    this->Found = {}; // the same bits had none before
  }
}

Points Guard::Blended(const Eigen::VectorXd& shares) const
{
  return this->Rest.P + shares.asDiagonal() * (this->Report.positions - this->Rest.P);
}

/// The last resort: toward the rest shape, where the folds are and then all over.
void Guard::Blend(const OctaveFields& fields)
{
  this->Report.blended = true;
  Eigen::VectorXd field = Eigen::VectorXd::Zero(this->Field.size());
  for (int round = 0; round < this->Options.blends && this->Found.Any(); ++round)
  {
    field = fields.Lower(field, this->Found.triangles, LocalLowering, LocalSlope);
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
  const bool clean = this->Try(this->Field);
  this->Report.before = this->Found;
  if (!clean && !this->Report.aborted)
  {
    const OctaveFields fields(this->Rest);
    this->Lower();
    if (this->Found.Any() && !this->Report.aborted)
    {
      this->Blend(fields);
    }
    else
    {
      this->Raise(fields);
    }
    this->Report.meanShare = fields.MeanShare(this->Field);
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

Folds FoldFinder::Find(const Points& Q)
{
  const Points points = this->Written(Q);
  const std::vector<int> triangles = WithArea(points, this->Rest.F);
  Folds folds;
  const TriangleMesh rest = { this->Rest.P, this->Rest.F(triangles, AllColumns) };
  const std::vector<char> over =
    TurnedOver(rest.P, points, rest.F, SurfaceRotations(rest, points, this->Threads));
  for (std::size_t k = 0; k < over.size(); ++k)
  {
    if (over[k])
    {
      folds.triangles.push_back(triangles[k]);
    }
  }
  folds.turnedOver = static_cast<int>(folds.triangles.size());

  const std::vector<Pair> added = this->NewPairs(this->Pairs(points, triangles));
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
