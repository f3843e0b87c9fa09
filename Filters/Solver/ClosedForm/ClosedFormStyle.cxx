// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClosedFormStyle.h"

#include "CarriedDetails.h"
#include "ClosedFormPreview.h"
#include "LimbThickness.h"
#include "LocalStep.h"
#include "Orientation.h"
#include "Parallel.h"
#include "PartShares.h"
#include "Stage.h"
#include "Stopwatch.h"
#include "SurfaceGrid.h"
#include "SurfaceMeasures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace SphericalStyle
{
namespace
{
/// Of the normals around, |mean| to mean of lengths: below it, as where the two sides of a thin
/// wall cancel, a normal fades.
constexpr double LeastAgreement = 0.2;
/// The base counts in full where smoothing takes 1 to within 1 %, and not where it is off by 3 %.
constexpr double MostKnown = 1.5;
constexpr double LossOfKnown = 50.0;
/// Of the grid on which parts with a style of their own keep together, fraction of the diagonal.
constexpr double SizeOfMoves = 0.03;

struct BaseKey
{
  double detailSize;

  bool operator==(const BaseKey& other) const { return this->detailSize == other.detailSize; }
};

/// What makes B of positions; nothing with detail size 0.
struct Smoother
{
  SurfaceGrid Grid;
  int Walls = 0;
  std::vector<std::pair<int, double>> Unknown; // points whose e_i is less than 1, and e_i
};

/// Nothing with detail size 0.
struct SmoothBase
{
  Points B;
  BaseSlopes Slopes;
};

/// Of the pose that is shown.
struct OfPose
{
  int pose;

  bool operator==(const OfPose& other) const { return this->pose == other.pose; }
};

/// Of that and of what has smoothed it.
struct PosedKey
{
  int smoother; // version
  int pose;

  bool operator==(const PosedKey& other) const
  {
    return this->smoother == other.smoother && this->pose == other.pose;
  }
};

/// Of what depends on nothing but one thing made before.
struct OfVersion
{
  int version;

  bool operator==(const OfVersion& other) const { return this->version == other.version; }
};

struct ThicknessKey
{
  int smoother;  // version
  double radius; // that bounds it

  bool operator==(const ThicknessKey& other) const
  {
    return this->smoother == other.smoother && this->radius == other.radius;
  }
};

struct SphereKey
{
  int base; // version
  CenterMode center;
  RadiusMode radius;

  bool operator==(const SphereKey& other) const
  {
    return this->base == other.base && this->center == other.center && this->radius == other.radius;
  }
};

struct ShapeKey
{
  int base; // version
  int pose;
  ShapeOptions shape;
  bool equalVolume;

  bool operator==(const ShapeKey& other) const
  {
    return this->base == other.base && this->pose == other.pose && this->shape == other.shape &&
      this->equalVolume == other.equalVolume;
  }
};

struct SharesKey
{
  std::vector<int> ids;
  double blend;

  bool operator==(const SharesKey& other) const
  {
    return this->ids == other.ids && this->blend == other.blend;
  }
};

struct CenterJoints
{
  SurfaceGrid Grid;
  Fields Shares; // n x centers
};

struct PreviewKey
{
  std::shared_ptr<const PreviewPlaces> places;
  int base; // versions; 0 of what has no say
  int normals;
  int thickness;

  bool operator==(const PreviewKey& other) const
  {
    return this->places == other.places && this->base == other.base &&
      this->normals == other.normals && this->thickness == other.thickness;
  }
};

struct LengthKey
{
  KeepSize keep;
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  int pose;

  bool operator==(const LengthKey& other) const
  {
    return this->keep == other.keep && this->up == other.up && this->pose == other.pose;
  }
};

/// That of the rigid motion nearest to the one from P to X.
Eigen::Matrix3d RotationToPose(const Points& P, const Points& X)
{
  return ClosestRotation(
    (P.rowwise() - P.colwise().mean()).transpose() * (X.rowwise() - X.colwise().mean()));
}

/// Where that motion takes the origin.
Eigen::RowVector3d OriginInPose(const Points& P, const Points& X)
{
  const Eigen::RowVector3d from = P.colwise().mean();
  return X.colwise().mean() - (RotationToPose(P, X) * from.transpose()).transpose();
}

/// Area and volume of a surface that is there several times are those of all.
double RadiusOfCopy(const ClosedFormOptions& o, double radius)
{
  switch (o.radiusMode)
  {
    case RadiusMode::EqualArea:
      return radius / std::sqrt(o.size.copies);
    case RadiusMode::EqualVolume:
      return radius / std::cbrt(o.size.copies);
    case RadiusMode::Custom:
      break;
  }
  return radius;
}

/// What moves as a whole.
struct MovedPart
{
  std::vector<int> points;
  Triangles F; // none where all move
};

MovedPart AllPoints(Eigen::Index n)
{
  MovedPart all;
  all.points.resize(n);
  std::iota(all.points.begin(), all.points.end(), 0);
  return all;
}

/// The points that are not fixed, and the triangles without one that is.
MovedPart PartOf(const Triangles& F, Eigen::Index n, const std::vector<int>& fixedPoints)
{
  std::vector<char> fixed(n, 0);
  for (const int i : fixedPoints)
  {
    fixed[i] = 1;
  }
  MovedPart part;
  for (int i = 0; i < n; ++i)
  {
    if (!fixed[i])
    {
      part.points.push_back(i);
    }
  }
  std::vector<int> inside;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    if (!fixed[F(f, 0)] && !fixed[F(f, 1)] && !fixed[F(f, 2)])
    {
      inside.push_back(static_cast<int>(f));
    }
  }
  part.F = F(inside, AllColumns);
  return part;
}
}

class ClosedFormStyle::State
{
public:
  const Points* P = nullptr;
  const Points* X = nullptr; // the pose; P where there is none
  int Pose = 0;              // another one for every pose
  const Triangles* F = nullptr;
  SurfacePart Part;
  // Of the mesh.
  Stage<OfMesh, Triangles> Turned; // facing outward; none where they do already
  Stage<BaseKey, Smoother> Smooth;
  Stage<OfVersion, Points> RestBase;       // none without a pose, as the next one
  Stage<OfVersion, BaseSlopes> RestSlopes; // of P
  Stage<ThicknessKey, Eigen::VectorXd> Thickness;
  Stage<OfMesh, SurfaceGrid> Moves; // of parts
  // Of the pose.
  Stage<OfPose, Eigen::VectorXd> Areas; // of the points
  Stage<LengthKey, double> RestLength;  // of the whole model
  Stage<PosedKey, SmoothBase> Base;
  Stage<OfVersion, Points> OwnNormals;  // of the base
  Stage<OfVersion, Points> PosedAreas;  // N_k, none without a pose
  Stage<SphereKey, Sphere> WholeSphere; // of the whole base
  Stage<ShapeKey, TargetShape> Shape;
  Stage<SharesKey, CenterJoints> Joints;
  Stage<PreviewKey, ClosedFormPreview> Preview;
  // Of the last solve.
  Callback Asked;
  int Steps = 0;
  ClosedFormResult Result;

  const Points& GetBase() const { return this->HasDetails() ? this->Base->B : *this->X; }
  const Points& GetRestBase(const ClosedFormOptions& o);
  bool IsPosed() const { return this->X != this->P; }
  const SurfaceGrid& GetGrid() const { return this->Smooth->Grid; }
  bool HasDetails() const { return this->GetGrid().GetNumberOfFunctions() > 0; }
  void Start(const Callback& callback);
  void Step();
  const Triangles& Outward();
  void UpdateBase(const ClosedFormOptions& o, ClosedFormReport& report);
  void MakeSmoother(const ClosedFormOptions& o, Smoother& smoother);
  void FindUnknown(int threads, Smoother& smoother) const;
  Points BaseOf(const Points& positions, int threads) const;
  BaseSlopes SlopesOf(const Points& positions, int threads) const;
  const Points& AreaVectors(int threads);
  void MakeAreaVectors(int threads, Points& N);
  void MakeBase(const ClosedFormOptions& o, SmoothBase& base);
  const Points& Normals(const ClosedFormOptions& o);
  void MakeNormals(int threads, Points& normals) const;
  void UpdateThickness(const ClosedFormOptions& o, double radius);
  void UpdateJoints(const ClosedFormOptions& o);
  std::vector<Sphere> Spheres(const ClosedFormOptions& o);
  Sphere SphereOfAll(const ClosedFormOptions& o);
  void UpdateShape(const ClosedFormOptions& o);
  Points Directions(const ClosedFormOptions& o, const Sphere& sphere, std::vector<int>& onCenter);
  Points MakeTargets(const ClosedFormOptions& o, ClosedFormReport& report);
  Points JointMoves(const ClosedFormOptions& o, const std::vector<Points>& targets) const;
  Points PartMoves(const ClosedFormOptions& o, const Points& targets);
  void BlendBase(const ClosedFormOptions& o, Points& targets) const;
  void CarryDetails(const ClosedFormOptions& o, Points moved);
  void Place(const ClosedFormOptions& o, ClosedFormReport& report);
};

void ClosedFormStyle::State::Start(const Callback& callback)
{
  this->Asked = callback;
  this->Steps = 0;
}

void ClosedFormStyle::State::Step()
{
  const bool ends = this->Asked && !this->Asked(++this->Steps, 0.0);
  if (this->Part.Max(ends ? 1.0 : 0.0) > 0.0)
  {
    throw SolveAborted{};
  }
}

/// The triangles, made to agree on their outside and turned so that the volume is positive.
const Triangles& ClosedFormStyle::State::Outward()
{
  this->Turned.Update({},
    [&](Triangles& turned)
    {
      Triangles oriented = OrientOutward(*this->P, *this->F, this->Part);
      if (oriented == *this->F)
      {
        oriented.resize(0, 3);
      }
      turned = std::move(oriented);
    });
  return this->Turned->rows() > 0 ? this->Turned.Get() : *this->F;
}

/// [grid] [base]
void ClosedFormStyle::State::UpdateBase(const ClosedFormOptions& o, ClosedFormReport& report)
{
  const Stopwatch watch;
  this->Smooth.Update({ o.detailSize }, [&](Smoother& made) { this->MakeSmoother(o, made); });
  this->Base.Update(
    { this->Smooth.GetVersion(), this->Pose }, [&](SmoothBase& base) { this->MakeBase(o, base); });
  report.functions = this->GetGrid().GetNumberOfFunctions();
  report.spacing = this->GetGrid().GetSpacing();
  report.coarser = this->HasDetails() && this->GetGrid().IsCoarser();
  report.walls = this->Smooth->Walls;
  report.baseSeconds += watch.Seconds();
}

void ClosedFormStyle::State::MakeSmoother(const ClosedFormOptions& o, Smoother& smoother)
{
  smoother = {}; // its memory is needed
  if (o.detailSize == 0.0)
  {
    return;
  }
  const Triangles& outward = this->Outward();
  this->Step();
  SurfaceGrid& grid = smoother.Grid;
  grid = SurfaceGrid(*this->P, outward, o.detailSize, o.threads, this->Part);
  this->Step();
  const std::vector<GridPair> walls = FindWalls(grid, *this->P, outward, o.threads, this->Part);
  smoother.Walls = static_cast<int>(walls.size());
  this->Step();
  grid.Factor(walls, o.threads);
  this->FindUnknown(o.threads, smoother);
  this->Step();
}

/// A loose part may be so small that the ridge of A_s outweighs it: what is smoothed there becomes
/// 0. Where the field 1 does not stay 1, the base is the model.
void ClosedFormStyle::State::FindUnknown(int threads, Smoother& smoother) const
{
  const SurfaceGrid& grid = smoother.Grid;
  const Fields ones = Fields::Ones(grid.GetNumberOfSamples(), 1);
  const Fields known = grid.AtPoints(grid.SmoothTwice(ones, threads), *this->P, threads);
  for (Eigen::Index i = 0; i < known.rows(); ++i)
  {
    const double share =
      std::clamp(MostKnown - LossOfKnown * std::abs(1.0 - known(i, 0)), 0.0, 1.0);
    if (share < 1.0)
    {
      smoother.Unknown.emplace_back(static_cast<int>(i), share);
    }
  }
}

/// @param positions  of the points, in any pose
Points ClosedFormStyle::State::BaseOf(const Points& positions, int threads) const
{
  const SurfaceGrid& grid = this->GetGrid();
  const bool atRest = &positions == this->P; // then it is known where the samples are
  const Fields places = atRest ? Fields(grid.GetPlaces()) : grid.Means(positions, threads);
  Points B = grid.AtPoints(grid.SmoothTwice(places, threads), *this->P, threads);
  for (const auto& [i, share] : this->Smooth->Unknown)
  {
    B.row(i) = positions.row(i) + share * (B.row(i) - positions.row(i));
  }
  return B;
}

void ClosedFormStyle::State::MakeBase(const ClosedFormOptions& o, SmoothBase& base)
{
  base = {}; // its memory is needed
  if (!this->HasDetails())
  {
    return;
  }
  if (this->IsPosed())
  {
    // The ridge of A_s takes 1 to slightly less: about the origin, as at rest.
    const Eigen::RowVector3d origin = OriginInPose(*this->P, *this->X);
    base.B = this->BaseOf(this->X->rowwise() - origin, o.threads).rowwise() + origin;
  }
  else
  {
    base.B = this->BaseOf(*this->X, o.threads);
  }
  base.Slopes = this->SlopesOf(base.B, o.threads);
  this->Step();
}

BaseSlopes ClosedFormStyle::State::SlopesOf(const Points& positions, int threads) const
{
  BaseSlopes slopes;
  slopes.gradients = this->GetGrid().Gradients(positions, threads);
  slopes.areaVectors = this->GetGrid().AreaVectorsUnder(slopes.gradients, threads);
  return slopes;
}

/// N_k, in a pose turned and scaled as the surface there is.
const Points& ClosedFormStyle::State::AreaVectors(int threads)
{
  if (!this->IsPosed())
  {
    return this->GetGrid().GetAreaVectors();
  }
  this->PosedAreas.Update(
    { this->Base.GetVersion() }, [&](Points& N) { this->MakeAreaVectors(threads, N); });
  return this->PosedAreas.Get();
}

void ClosedFormStyle::State::MakeAreaVectors(int threads, Points& N)
{
  this->RestSlopes.Update({ this->Smooth.GetVersion() },
    [&](BaseSlopes& slopes) { slopes = this->SlopesOf(*this->P, threads); });
  const BaseSlopes& atRest = this->RestSlopes.Get();
  const BaseSlopes posed = this->SlopesOf(*this->X, threads);
  const Fields S = DetailCovariances(this->GetGrid(), atRest, posed, threads);
  N = this->GetGrid().GetAreaVectors();
  for (Eigen::Index k = 0; k < N.rows(); ++k)
  {
    const double before = atRest.areaVectors.row(k).norm();
    const double ratio = before > 0.0 ? posed.areaVectors.row(k).norm() / before : 0.0;
    const Eigen::Matrix3d R = ClosestRotation(Eigen::Map<const Eigen::Matrix3d>(S.row(k).data()));
    N.row(k) = ratio * (R * N.row(k).transpose()).transpose();
  }
}

/// That of the mesh, whatever the pose.
const Points& ClosedFormStyle::State::GetRestBase(const ClosedFormOptions& o)
{
  if (!this->IsPosed())
  {
    return this->GetBase();
  }
  if (!this->HasDetails())
  {
    return *this->P;
  }
  this->RestBase.Update(
    { this->Smooth.GetVersion() }, [&](Points& base) { base = this->BaseOf(*this->P, o.threads); });
  return this->RestBase.Get();
}

/// Those of the base; without details, those that are given.
const Points& ClosedFormStyle::State::Normals(const ClosedFormOptions& o)
{
  if (!this->HasDetails() && this->Part.Max(o.normals.rows() > 0 ? 1.0 : 0.0) > 0.0)
  {
    return o.normals;
  }
  this->OwnNormals.Update({ this->Base.GetVersion() },
    [&](Points& normals)
    {
      if (this->HasDetails())
      {
        this->MakeNormals(o.threads, normals);
      }
      else
      {
        normals = PointNormals(*this->X, this->Outward(), this->Part);
      }
    });
  return this->OwnNormals.Get();
}

void ClosedFormStyle::State::MakeNormals(int threads, Points& normals) const
{
  const Points& areaVectors = this->Base->Slopes.areaVectors;
  Fields means(areaVectors.rows(), 4);
  means << areaVectors, areaVectors.rowwise().norm();
  const SurfaceGrid& grid = this->GetGrid();
  means = grid.GetWeights().cwiseInverse().asDiagonal() * means;
  const Fields smooth = grid.AtPoints(grid.Smooth(means, threads), *this->P, threads);
  normals = Points::Zero(smooth.rows(), 3);
  for (Eigen::Index i = 0; i < smooth.rows(); ++i)
  {
    const double length = std::max(smooth.row(i).head<3>().norm(), LeastAgreement * smooth(i, 3));
    if (length > 0.0)
    {
      normals.row(i) = smooth.row(i).head<3>() / length;
    }
  }
}

/// [limb]
void ClosedFormStyle::State::UpdateThickness(const ClosedFormOptions& o, double radius)
{
  const auto make = [&](Eigen::VectorXd& thickness)
  {
    thickness =
      LimbThickness(*this->P, this->GetRestBase(o), this->Outward(), radius, o.threads, this->Part);
  };
  if (this->Thickness.Update({ this->Smooth.GetVersion(), radius }, make))
  {
    this->Step();
  }
}

void ClosedFormStyle::State::UpdateJoints(const ClosedFormOptions& o)
{
  const auto make = [&](CenterJoints& joints)
  {
    joints = {};
    joints.Shares = PartShares(o.centerIds, o.NumberOfCenters(this->Part));
    constexpr double Finest = 0.02; // the grid of the joints, where their width is less
    joints.Grid =
      SurfaceGrid(*this->P, *this->F, std::max(o.centerBlend, Finest), o.threads, this->Part);
    if (o.centerBlend > 0.0)
    {
      joints.Grid.FactorAlong(o.threads);
      joints.Shares = SmoothShares(joints.Grid, joints.Shares, *this->P, o.threads);
    }
    joints.Grid.FactorPoisson(o.threads);
  };
  const SharesKey key = { o.centerIds, o.centerBlend };
  if (this->Part.Max(this->Joints.Has(key) ? 0.0 : 1.0) > 0.0)
  {
    this->Joints.Forget(); // other points of this process or another one
  }
  if (this->Joints.Update(key, make))
  {
    this->Step();
  }
}

/// What no drag changes is worked out once.
Sphere ClosedFormStyle::State::SphereOfAll(const ClosedFormOptions& o)
{
  this->WholeSphere.Update({ this->Base.GetVersion(), o.centerMode, o.radiusMode },
    [&](Sphere& sphere)
    {
      sphere =
        TargetSphere(this->GetBase(), *this->F, o.centerMode, o.radiusMode, o.custom, this->Part);
      if (this->IsPosed())
      {
        sphere.radius = TargetSphere(
          this->GetRestBase(o), *this->F, o.centerMode, o.radiusMode, o.custom, this->Part)
                          .radius;
      }
    });
  // Custom modes take what is given, and say what is wrong with it.
  const Sphere& known = this->WholeSphere.Get();
  const Sphere sphere = { o.centerMode == CenterMode::Custom ? o.custom.center : known.center,
    o.radiusMode == RadiusMode::Custom ? o.custom.radius : RadiusOfCopy(o, known.radius) };
  return TargetSphere(*this->P, *this->F, CenterMode::Custom, RadiusMode::Custom, sphere);
}

/// The target sphere of each center.
std::vector<Sphere> ClosedFormStyle::State::Spheres(const ClosedFormOptions& o)
{
  const bool ofAll = !o.HasFixedPoints(this->Part) || !o.sphereOfFreePoints;
  if (o.NumberOfCenters(this->Part) == 1 && ofAll)
  {
    return { this->SphereOfAll(o) };
  }
  std::vector<Sphere> spheres = SpheresOfCenters(this->GetBase(), *this->F, o, this->Part);
  if (this->IsPosed())
  {
    const std::vector<Sphere> atRest =
      SpheresOfCenters(this->GetRestBase(o), *this->F, o, this->Part);
    for (std::size_t k = 0; k < spheres.size(); ++k)
    {
      spheres[k].radius = atRest[k].radius;
    }
  }
  for (Sphere& sphere : spheres)
  {
    sphere.radius = RadiusOfCopy(o, sphere.radius);
  }
  return spheres;
}

/// [target], in a pose that of the rest pose, turned.
void ClosedFormStyle::State::UpdateShape(const ClosedFormOptions& o)
{
  this->Shape.Update(
    { this->Base.GetVersion(), this->Pose, o.shape, o.radiusMode == RadiusMode::EqualVolume },
    [&](TargetShape& shape)
    {
      shape = ShapeOf(this->GetRestBase(o), *this->F, o, this->Part);
      if (this->IsPosed())
      {
        shape.Turn(RotationToPose(*this->P, *this->X));
      }
    });
}

/// t = (T - O) / r for one center [toy].
Points ClosedFormStyle::State::Directions(
  const ClosedFormOptions& o, const Sphere& sphere, std::vector<int>& onCenter)
{
  if (o.HasTargets(this->Part))
  {
    return o.targets;
  }
  Points t = CenterDirections(this->GetBase(), *this->F, sphere.center, onCenter, this->Part);
  ReachShape(this->Shape.Get(), o.threads, t);
  if (!o.UsesNormals(this->Part))
  {
    return t;
  }
  const bool own = o.normalRadius == NormalRadius::OwnThickness;
  const Points& normals = this->Normals(o);
  const Eigen::VectorXd& thickness = this->Thickness.Get();
  ParallelFor(static_cast<int>(t.rows()), o.threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const double a = o.normalBlends.size() > 0 ? o.normalBlends(i) : o.normalBlend;
        const double rho = own ? thickness(i) / sphere.radius : 1.0;
        t.row(i) = (1.0 - a) * t.row(i) + a * rho * normals.row(i);
      }
    });
  return t;
}

namespace
{
/// Minus the gradient that a share of X has where the share changes, times the areas of the
/// samples: the right-hand side of the smooth field that undoes it.
/// @param gradient  of the share, samples x 3 @param X  n x 3 @param slope  samples x 9, added to
void UndoShare(
  const SurfaceGrid& grid, const Fields& gradient, const Points& X, int threads, Fields& slope)
{
  const Fields means = grid.Means(X, threads);
  for (Eigen::Index i = 0; i < slope.rows(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      slope.row(i).segment<3>(3 * axis) -= grid.GetWeights()(i) * means(i, axis) * gradient.row(i);
    }
  }
}

/// That field at points.
Points MovesOf(const SurfaceGrid& grid, const Fields& slope, const Points& P, int threads)
{
  const Fields none = Fields::Zero(grid.GetNumberOfSamples(), 3);
  return grid.AtPoints(grid.Solve(none, slope, threads), P, threads);
}
}

double ShareOfWay(double lambda)
{
  return 1.0 - 1.0 / (1.0 + std::sqrt(3.0) * lambda);
}

/// Several centers: parts keep together. Where the shares change, the targets of the centers do not
/// agree; the smooth field Y that undoes the gradient of that disagreement moves each part as a
/// whole [centers].
Points ClosedFormStyle::State::JointMoves(
  const ClosedFormOptions& o, const std::vector<Points>& targets) const
{
  const SurfaceGrid& grid = this->Joints->Grid;
  Fields slope = Fields::Zero(grid.GetNumberOfSamples(), 9);
  for (std::size_t k = 0; k < targets.size(); ++k)
  {
    Points share = Points::Zero(this->P->rows(), 3);
    share.col(0) = this->Joints->Shares.col(static_cast<Eigen::Index>(k));
    UndoShare(grid, grid.Gradients(share, o.threads).leftCols<3>(), targets[k], o.threads, slope);
  }
  return MovesOf(grid, slope, *this->P, o.threads);
}

/// T of each point, and t as a result.
Points ClosedFormStyle::State::MakeTargets(const ClosedFormOptions& o, ClosedFormReport& report)
{
  report.spheres = this->Spheres(o);
  this->UpdateShape(o);
  report.shape = this->Shape.Get();
  if (o.UsesNormals(this->Part))
  {
    this->Normals(o);
    if (o.normalRadius == NormalRadius::OwnThickness)
    {
      double largest = 0.0;
      for (const Sphere& sphere : report.spheres)
      {
        largest = std::max(largest, sphere.radius);
      }
      this->UpdateThickness(o, largest);
    }
  }
  if (report.spheres.size() == 1)
  {
    const Sphere& sphere = report.spheres.front();
    this->Result.directions = this->Directions(o, sphere, report.pointsOnCenter);
    return (sphere.radius * this->Result.directions).rowwise() + sphere.center.transpose();
  }
  this->UpdateJoints(o);
  this->Result.directions = Points::Zero(this->P->rows(), 3);
  Points shared = Points::Zero(this->P->rows(), 3);
  std::vector<Points> targets;
  for (std::size_t k = 0; k < report.spheres.size(); ++k)
  {
    const Sphere& sphere = report.spheres[k];
    const auto omega = this->Joints->Shares.col(static_cast<Eigen::Index>(k)).asDiagonal();
    std::vector<int> onCenter;
    const Points t = this->Directions(o, sphere, onCenter);
    this->Result.directions += omega * t;
    targets.emplace_back((sphere.radius * t).rowwise() + sphere.center.transpose());
    shared += omega * targets.back();
    report.pointsOnCenter.insert(report.pointsOnCenter.end(), onCenter.begin(), onCenter.end());
  }
  shared += this->JointMoves(o, targets);
  return shared;
}

/// Parts with a style of their own keep together: a part takes the shape of its style, and does not
/// travel by its style alone. With m the share of the way and a the blend of each point, both
/// smooth, Y undoes the gradients (T - B) grad m + m dT/da grad a. Factors of points that are
/// there, too, scale T - B.
/// @param targets  T @return Y, n x 3 [styles]
Points ClosedFormStyle::State::PartMoves(const ClosedFormOptions& o, const Points& targets)
{
  const Eigen::Index n = this->P->rows();
  Points styles = Points::Zero(n, 3); // m, a
  Points way = targets - this->GetBase();
  Eigen::VectorXd shares = Eigen::VectorXd::Constant(n, ShareOfWay(o.lambda));
  const Eigen::VectorXd factors = o.Factors();
  for (Eigen::Index i = 0; i < factors.size(); ++i)
  {
    shares(i) = ShareOfWay(o.lambda * factors(i));
  }
  if (o.partFactors.size() > 0)
  {
    for (Eigen::Index i = 0; i < n; ++i)
    {
      styles(i, 0) = ShareOfWay(o.lambda * o.partFactors(i));
      way.row(i) *= styles(i, 0) > 0.0 ? shares(i) / styles(i, 0) : 1.0;
    }
  }
  this->Moves.Update({},
    [&](SurfaceGrid& grid)
    {
      grid = SurfaceGrid(*this->P, *this->F, SizeOfMoves, o.threads, this->Part);
      grid.FactorPoisson(o.threads);
    });
  const SurfaceGrid& grid = this->Moves.Get();
  Fields slope = Fields::Zero(grid.GetNumberOfSamples(), 9);
  const bool byBlends = this->Part.Max(o.blendsOfParts ? 1.0 : 0.0) > 0.0;
  if (o.blendsOfParts)
  {
    styles.col(1) = o.normalBlends;
  }
  const Fields gradients = grid.Gradients(styles, o.threads);
  UndoShare(grid, gradients.leftCols<3>(), way, o.threads, slope);
  if (byBlends)
  {
    ClosedFormOptions ends = o;
    ends.normalBlends.resize(0);
    ClosedFormReport unused;
    ends.normalBlend = 1.0;
    Points change = this->MakeTargets(ends, unused);
    ends.normalBlend = 0.0;
    change -= this->MakeTargets(ends, unused);
    UndoShare(grid, gradients.middleCols<3>(3), shares.asDiagonal() * change, o.threads, slope);
  }
  return MovesOf(grid, slope, *this->P, o.threads);
}

/// Makes B' of T, in its place [toy].
void ClosedFormStyle::State::BlendBase(const ClosedFormOptions& o, Points& targets) const
{
  const Points& B = this->GetBase();
  const Eigen::VectorXd factors = o.Factors();
  ParallelFor(static_cast<int>(B.rows()), o.threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const double share = ShareOfWay(o.lambda * (factors.size() > 0 ? factors(i) : 1.0));
        targets.row(i) = B.row(i) + share * (targets.row(i) - B.row(i));
      }
    });
}

/// P' = B' + c R (P - B) [carry]
/// @param moved  B'
void ClosedFormStyle::State::CarryDetails(const ClosedFormOptions& o, Points moved)
{
  this->Result.rotations.clear();
  if (!this->HasDetails())
  {
    this->Result.positions = std::move(moved);
    if (o.keepRotations)
    {
      this->Result.rotations.assign(this->P->rows(), Eigen::Matrix3d::Identity());
    }
    return;
  }
  const SmoothBase& base = this->Base.Get();
  const SurfaceGrid& grid = this->GetGrid();
  const BaseSlopes after = this->SlopesOf(moved, o.threads);
  const Fields smooth =
    grid.SmoothTwice(DetailCovariances(grid, base.Slopes, after, o.threads), o.threads);
  Points& positions = this->Result.positions;
  SphericalStyle::CarryDetails(grid, smooth, { *this->P, *this->X, base.B }, moved, o.threads,
    positions, o.keepRotations ? &this->Result.rotations : nullptr);
  const Points carried = this->SlopesOf(positions, o.threads).areaVectors;
  const Fields yields = DetailYields(grid.AtSamples(smooth, o.threads),
    { this->AreaVectors(o.threads), after.areaVectors, carried }, o.threads);
  if (!yields.isZero(0.0))
  {
    GiveWay(grid, grid.Smooth(yields, o.threads), *this->P, moved, o.threads, positions);
  }
}

/// [size], and what stays where it is.
void ClosedFormStyle::State::Place(const ClosedFormOptions& o, ClosedFormReport& report)
{
  const Points& P0 = *this->X;
  const bool moveAll = !o.HasFixedPoints(this->Part);
  const MovedPart moved =
    moveAll ? AllPoints(P0.rows()) : PartOf(*this->F, P0.rows(), o.fixedPoints);
  const std::vector<int>& members = moved.points;
  if (!moveAll &&
    (this->Part.Max(members.empty() ? 0.0 : 1.0) == 0.0 ||
      this->Part.Max(moved.F.rows() == 0 ? 0.0 : 1.0) == 0.0))
  {
    return;
  }
  const Triangles& F0 = moveAll ? *this->F : moved.F;
  this->Areas.Update(
    { this->Pose }, [&](Eigen::VectorXd& areas) { areas = PointAreas(P0, *this->F); });
  const Eigen::VectorXd& areas = this->Areas.Get();
  Eigen::RowVector4d sums = Eigen::RowVector4d::Zero(); // with the areas
  for (const int i : members)
  {
    sums.head<3>() += areas(i) * (P0.row(i) - this->Result.positions.row(i));
    sums(3) += areas(i);
  }
  this->Part.Sum(sums);
  Eigen::RowVector3d shift = sums.head<3>() / sums(3);
  if (o.keepLastPoint)
  {
    shift = P0.row(members.back()) - this->Result.positions.row(members.back());
  }
  for (const int i : members)
  {
    this->Result.positions.row(i) += shift;
  }
  const auto measure = [&]
  { return LengthOf(P0, F0, members, areas, o.size, o.threads, this->Part); };
  double before = 0.0;
  if (moveAll)
  {
    this->RestLength.Update(
      { o.size.keep, o.size.up, this->Pose }, [&](double& length) { length = measure(); });
    before = this->RestLength.Get();
  }
  else
  {
    before = measure();
  }
  report.scale = RestoreSize(
    P0, F0, members, areas, o.size, before, o.threads, this->Result.positions, this->Part);
}

//------------------------------------------------------------------------------------------------
ClosedFormStyle::ClosedFormStyle()
  : S(std::make_unique<State>())
{
}

ClosedFormStyle::~ClosedFormStyle() = default;

void ClosedFormStyle::SetMesh(const Points& P, const Triangles& F, SurfacePart part)
{
  this->S = std::make_unique<State>();
  this->SetEqualMesh(P, F, std::move(part));
}

void ClosedFormStyle::SetEqualMesh(const Points& P, const Triangles& F, SurfacePart part)
{
  this->S->Part = std::move(part);
  this->S->P = &P;
  this->S->X = &P;
  this->S->F = &F;
}

void ClosedFormStyle::SetPose(const Points& X, bool changed)
{
  this->S->X = &X;
  this->S->Pose += changed ? 1 : 0;
}

ClosedFormResult ClosedFormStyle::TakeResult()
{
  return std::exchange(this->S->Result, {});
}

ClosedFormReport ClosedFormStyle::Solve(const ClosedFormOptions& options, const Callback& callback)
{
  State& s = *this->S;
  s.Start(callback);
  ClosedFormReport report;
  s.UpdateBase(options, report);
  const Stopwatch watch;
  Points moved = s.MakeTargets(options, report);
  if (options.HasPartStyles(s.Part))
  {
    const Points directions = s.Result.directions;
    const Points moves = s.PartMoves(options, moved);
    s.Result.directions = directions;
    s.BlendBase(options, moved);
    moved += moves;
  }
  else
  {
    s.BlendBase(options, moved);
  }
  s.Step();
  s.CarryDetails(options, std::move(moved));
  s.Step();
  s.Place(options, report);
  report.carrySeconds = watch.Seconds();
  return report;
}

ClosedFormReport ClosedFormStyle::Preview(const std::shared_ptr<const PreviewPlaces>& places,
  const ClosedFormOptions& options, const Callback& callback)
{
  State& s = *this->S;
  s.Start(callback);
  ClosedFormReport report;
  s.UpdateBase(options, report);
  const Stopwatch watch;
  report.spheres = s.Spheres(options);
  const Sphere& sphere = report.spheres.front();
  const bool limbs = options.normalBlend > 0.0;
  const bool own = limbs && options.normalRadius == NormalRadius::OwnThickness;
  const Points* normals = limbs ? &s.Normals(options) : nullptr;
  if (own && s.Thickness.GetKey().smoother != s.Smooth.GetVersion())
  {
    s.UpdateThickness(options, sphere.radius);
  }
  s.Preview.Update({ places, s.Base.GetVersion(), limbs ? s.OwnNormals.GetVersion() : 0,
                     own ? s.Thickness.GetVersion() : 0 },
    [&](ClosedFormPreview& preview)
    {
      preview = {};
      preview = ClosedFormPreview(
        { *s.P, *s.F, s.GetBase(), s.GetGrid(), normals, own ? &s.Thickness.Get() : nullptr },
        *places, options.threads);
    });
  s.Step();
  s.Result = s.Preview->Solve(options, sphere, s.GetGrid(), s.Base->Slopes, s.Part, report.scale);
  report.carrySeconds = watch.Seconds();
  return report;
}

ClosedFormReport ClosedFormStyle::Carry(
  const Points& Q, const ClosedFormOptions& options, const Callback& callback)
{
  State& s = *this->S;
  s.Start(callback);
  ClosedFormReport report;
  s.UpdateBase(options, report);
  const Stopwatch watch;
  Points moved = Q;
  if (s.HasDetails())
  {
    moved = s.BaseOf(Q, options.threads);
  }
  s.CarryDetails(options, std::move(moved));
  s.Place(options, report);
  report.carrySeconds = watch.Seconds();
  return report;
}

Points ClosedFormStyle::ThickNormals(const ClosedFormOptions& options, const Callback& callback)
{
  if (!options.UsesNormals())
  {
    return options.normals;
  }
  State& s = *this->S;
  s.Start(callback);
  ClosedFormReport report;
  s.UpdateBase(options, report);
  const double radius = s.Spheres(options).front().radius;
  const Points& normals = s.Normals(options);
  s.UpdateThickness(options, radius);
  return (s.Thickness.Get() / radius).asDiagonal() * normals;
}

const Points& ClosedFormStyle::GetPositions() const
{
  return this->S->Result.positions;
}

const Points& ClosedFormStyle::GetBase() const
{
  return this->S->GetBase();
}

const Points& ClosedFormStyle::GetDirections() const
{
  return this->S->Result.directions;
}

const Matrices& ClosedFormStyle::GetRotations() const
{
  return this->S->Result.rotations;
}
} // namespace SphericalStyle
