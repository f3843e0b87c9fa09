// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "TargetShape.h"

#include "FirstHit.h"
#include "Orientation.h"
#include "SurfaceMeasures.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace SphericalStyle
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
constexpr double Flattest = 0.1;          // half length over the longest
constexpr double SameLengths = 1.1;       // ratio of lengths below which axes are open
constexpr double NearAxis = 0.9396926208; // cosine of 20 degrees
constexpr double EdgeOn = 1e-9; // of the sine below which a triangle is seen from its edge

/// Of the surface of the points within rho of the box of half lengths b about the origin.
/// @param x  not 0
double RoundedBoxRadius(const Vector3d& x, const Vector3d& b, double rho)
{
  const Vector3d a = x.cwiseAbs();
  const auto leaves = [&](int i) { return a[i] > 0.0 ? b[i] / a[i] : INFINITY; };
  std::array<int, 3> order = { 0, 1, 2 };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return leaves(i) < leaves(j); });
  double A = 0.0;
  double B = 0.0;
  double crosses = 0.0;
  double R = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const int i = order[k];
    for (int j = 0; j < k; ++j)
    {
      const double cross = a[i] * b[order[j]] - a[order[j]] * b[i];
      crosses += cross * cross;
    }
    A += a[i] * a[i];
    B += a[i] * b[i];
    R = (B + std::sqrt(std::max(0.0, A * rho * rho - crosses))) / A;
    if (k == 2 || R <= leaves(order[k + 1]))
    {
      break;
    }
  }
  return R;
}

/// Triangles of an eighth of the sphere, with their corners of length 1.
TriangleMesh EighthOfSphere()
{
  constexpr int n = 64;
  TriangleMesh mesh;
  mesh.P.resize((n + 1) * (n + 2) / 2, 3);
  mesh.F.resize(n * n, 3);
  const auto at = [](int i, int j) { return i * (i + 1) / 2 + j; };
  Eigen::Index f = 0;
  for (int i = 0; i <= n; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      mesh.P.row(at(i, j)) = Vector3d(i - j, j, n - i).normalized();
      if (i < n)
      {
        mesh.F.row(f++) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      }
      if (i < n && j < i)
      {
        mesh.F.row(f++) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
      }
    }
  }
  return mesh;
}

/// The axes of moments as a rotation whose columns are nearest to the axes of the coordinates.
Matrix3d NearestAxes(const Matrix3d& vectors)
{
  std::array<int, 3> order = { 0, 1, 2 };
  std::array<int, 3> best = order;
  double most = -1.0;
  do
  {
    const double sum = std::abs(vectors(0, order[0])) + std::abs(vectors(1, order[1])) +
      std::abs(vectors(2, order[2]));
    if (sum > most + 1e-9)
    {
      most = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  Matrix3d E;
  for (int k = 0; k < 3; ++k)
  {
    E.col(k) = std::copysign(1.0, vectors(k, best[k])) * vectors.col(best[k]);
  }
  return E;
}

/// Turned so that column k is axis k of the coordinates; the others follow, onto theirs where they
/// are near.
Matrix3d WithAxis(const Matrix3d& E, int k)
{
  const Vector3d axis = Vector3d::Unit(k);
  const Matrix3d turned = Eigen::Quaterniond::FromTwoVectors(E.col(k), axis).toRotationMatrix() * E;
  const int next = (k + 1) % 3;
  if (turned(next, next) >= NearAxis)
  {
    return Matrix3d::Identity();
  }
  Matrix3d result;
  result.col(k) = axis;
  result.col(next) = turned.col(next) - turned(k, next) * axis;
  result.col(next).normalize();
  result.col((k + 2) % 3) = axis.cross(result.col(next));
  return result;
}

/// E of the moments, in the coordinates of the model.
Matrix3d OwnAxes(const Matrix3d& moments)
{
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(moments);
  const Vector3d lengths = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const bool lowOpen = lengths(1) < SameLengths * lengths(0);
  const bool highOpen = lengths(2) < SameLengths * lengths(1);
  if (lowOpen && highOpen)
  {
    return Matrix3d::Identity();
  }
  if (lowOpen || highOpen)
  {
    // One axis is known: the least turn that takes the nearest of the coordinates there.
    const Vector3d known = solver.eigenvectors().col(lowOpen ? 2 : 0);
    int k = 0;
    const double cosine = known.cwiseAbs().maxCoeff(&k);
    return cosine >= NearAxis
      ? Matrix3d::Identity()
      : Eigen::Quaterniond::FromTwoVectors(Vector3d::Unit(k), std::copysign(1.0, known(k)) * known)
          .toRotationMatrix();
  }
  const Matrix3d E = NearestAxes(solver.eigenvectors());
  int k = 0;
  return E.diagonal().maxCoeff(&k) >= NearAxis ? WithAxis(E, k) : E;
}
}

StarMesh::StarMesh(const TriangleMesh& mesh)
{
  if (mesh.F.rows() == 0)
  {
    throw std::invalid_argument("there is no triangle");
  }
  if (!mesh.P.allFinite())
  {
    throw std::invalid_argument("a point is not finite");
  }
  const Eigen::RowVector3d low = mesh.P.colwise().minCoeff();
  const Eigen::RowVector3d high = mesh.P.colwise().maxCoeff();
  const double diagonal = 2.0 * (0.5 * high - 0.5 * low).stableNorm();
  if (!(diagonal > 0.0) || !std::isfinite(diagonal))
  {
    throw std::invalid_argument("the points are all equal or too far apart");
  }
  this->P = (mesh.P.rowwise() - (0.5 * low + 0.5 * high)) / diagonal;
  this->F = mesh.F;
  const Eigen::VectorXd areas = TriangleAreas(this->P, this->F);
  this->Area = areas.sum();
  if (!(this->Area > 0.0))
  {
    throw std::invalid_argument("it has no area");
  }
  const Vector3d O = AreaCentroid(this->P, this->F);
  double angles = 0.0;
  for (Eigen::Index f = 0; f < this->F.rows(); ++f)
  {
    angles += SolidAngle(this->P, this->F, f, O);
  }
  // Of a closed surface a multiple of 4 pi, from outside 0, as from within the plane of a sheet.
  const double turns = angles / (4.0 * Pi);
  if (std::abs(turns - std::round(turns)) > 1e-6 || VolumeAmbiguity(this->P, this->F) > 1e-6)
  {
    throw std::invalid_argument("it is open, or its triangles do not all face the same way");
  }
  this->P.rowwise() -= O.transpose();
  this->Outward = std::copysign(1.0, EnclosedVolume(this->P, this->F));
  for (Eigen::Index f = 0; f < this->F.rows(); ++f)
  {
    const double volume = this->Outward * TripleProduct(this->P, this->F, f, Vector3d::Zero());
    const double distance = this->P(this->F.row(f), AllColumns).rowwise().norm().maxCoeff();
    if (areas(f) > 0.0 && volume <= 2.0 * areas(f) * distance * EdgeOn)
    {
      throw NotStarShaped(static_cast<int>(f));
    }
    this->Volume += volume / 6.0;
  }
  this->Tree = std::make_unique<TriangleTree>(this->P, this->F);
}

/// The triangle that d leaves through. A search along the ray passes by what is very near O or
/// seen from its edge; then it is the one whose cone of three planes through O has d deepest
/// inside.
int StarMesh::TriangleToward(const Vector3d& d) const
{
  FirstHit hit(this->P, this->F, Vector3d::Zero(), d, FirstHit::Nothing);
  hit.Search(*this->Tree);
  if (hit.GetTriangle() >= 0)
  {
    return hit.GetTriangle();
  }
  constexpr double Nowhere = -std::numeric_limits<double>::infinity();
  double deepest = Nowhere;
  int toward = 0;
  for (int f = 0; f < static_cast<int>(this->F.rows()); ++f)
  {
    // Barycentric coordinates of d in f, each times the same factor.
    const Vector3d a = this->P.row(this->F(f, 0));
    const Vector3d b = this->P.row(this->F(f, 1));
    const Vector3d c = this->P.row(this->F(f, 2));
    const Vector3d parts(d.dot(b.cross(c)), d.dot(c.cross(a)), d.dot(a.cross(b)));
    const double sum = this->Outward * parts.sum();
    const double depth = sum > 0.0 ? this->Outward * parts.minCoeff() / sum : Nowhere;
    if (depth > deepest)
    {
      deepest = depth;
      toward = f;
    }
  }
  return toward;
}

/// Where d meets the plane of triangle f.
double StarMesh::RadiusAt(int f, const Vector3d& d) const
{
  const Vector3d a = this->P.row(this->F(f, 0));
  const Vector3d n =
    (this->P.row(this->F(f, 1)).transpose() - a).cross(this->P.row(this->F(f, 2)).transpose() - a);
  return n.dot(a) / n.dot(d);
}

double StarMesh::RadiusAlong(const Vector3d& d) const
{
  return this->RadiusAt(this->TriangleToward(d.normalized()), d);
}

bool ShapeOptions::operator==(const ShapeOptions& other) const
{
  return this->kind == other.kind && this->edges == other.edges && this->lengths == other.lengths &&
    this->mesh == other.mesh && this->axes == other.axes;
}

TargetShape::TargetShape(const ShapeOptions& options, const Matrix3d& moments, bool equalVolume)
  : Kind(options.kind)
  , Edges(options.edges)
  , Axes(options.axes)
  , Mesh(options.mesh)
{
  switch (this->Kind)
  {
    case TargetKind::Sphere:
      return;
    case TargetKind::Mesh:
      this->Scale = equalVolume ? std::cbrt(4.0 / 3.0 * Pi / this->Mesh->GetVolume())
                                : std::sqrt(4.0 * Pi / this->Mesh->GetArea());
      return;
    case TargetKind::Ellipsoid:
    case TargetKind::Capsule:
    case TargetKind::Cylinder:
    case TargetKind::Box:
    case TargetKind::Superquadric:
      break;
  }
  if (options.lengths.isZero(0.0))
  {
    const Matrix3d inModel = options.axes.transpose() * moments * options.axes;
    const Matrix3d own = OwnAxes(inModel);
    this->Axes = options.axes * own;
    this->MatchMoments((own.transpose() * inModel * own).diagonal());
  }
  else
  {
    this->HalfLengths = options.lengths / options.lengths.maxCoeff();
    this->FindAxis();
    this->BoundLengths();
  }
  // Against the sphere of as many triangles, so that it is the sphere where it is one.
  const TargetShape sphere;
  const Size unit = sphere.MeasureSize();
  const Size size = this->MeasureSize();
  this->HalfLengths *=
    equalVolume ? std::cbrt(unit.volume / size.volume) : std::sqrt(unit.area / size.area);
}

/// Along which cylinders and capsules lie.
void TargetShape::FindAxis()
{
  std::array<int, 3> order = { 0, 1, 2 };
  std::stable_sort(order.begin(), order.end(),
    [this](int i, int j) { return this->HalfLengths(i) < this->HalfLengths(j); });
  const Vector3d sorted = this->HalfLengths(order);
  const bool isDisk =
    this->Kind == TargetKind::Cylinder && sorted(0) * sorted(2) < sorted(1) * sorted(1);
  this->Axis = order[isDisk ? 0 : 2];
}

/// What the kind of shape, and its least flatness, make of half lengths.
void TargetShape::BoundLengths()
{
  Vector3d& h = this->HalfLengths;
  h = h.cwiseMax(Flattest * h.maxCoeff());
  if (this->Kind == TargetKind::Cylinder || this->Kind == TargetKind::Capsule)
  {
    const double along = h(this->Axis);
    const double radius = 0.5 * (h.sum() - along);
    h.setConstant(radius);
    h(this->Axis) = this->Kind == TargetKind::Capsule ? std::max(along, radius) : along;
  }
}

/// Half lengths with which the surface has these moments, up to its size.
void TargetShape::MatchMoments(const Vector3d& moments)
{
  constexpr int Rounds = 30;
  const Vector3d wanted = moments.cwiseMax(1e-6 * moments.maxCoeff()).cwiseSqrt();
  this->HalfLengths = wanted / wanted.maxCoeff();
  this->FindAxis();
  this->BoundLengths();
  for (int round = 0; round < Rounds; ++round)
  {
    const Vector3d before = this->HalfLengths;
    const Vector3d now = this->MeasureSize().moments.cwiseSqrt();
    this->HalfLengths = before.cwiseProduct(wanted).cwiseQuotient(now);
    this->HalfLengths /= this->HalfLengths.maxCoeff();
    this->BoundLengths();
    if ((this->HalfLengths - before).cwiseAbs().maxCoeff() < 1e-12)
    {
      break;
    }
  }
}

/// Sums over triangles between points of an eighth of the surface; moments by area.
TargetShape::Size TargetShape::MeasureSize() const
{
  static const TriangleMesh eighth = EighthOfSphere();
  Points P = eighth.P;
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    P.row(i) *= this->Unscaled(eighth.P.row(i));
  }
  Size size = { 0.0, 0.0, Vector3d::Zero() };
  for (Eigen::Index f = 0; f < eighth.F.rows(); ++f)
  {
    const Vector3d a = P.row(eighth.F(f, 0));
    const Vector3d b = P.row(eighth.F(f, 1));
    const Vector3d c = P.row(eighth.F(f, 2));
    const double area = 0.5 * (b - a).cross(c - a).norm();
    size.area += area;
    size.volume += std::abs(a.dot(b.cross(c)));
    size.moments +=
      area / 12.0 * (a.cwiseAbs2() + b.cwiseAbs2() + c.cwiseAbs2() + (a + b + c).cwiseAbs2());
  }
  size.moments /= size.area;
  return size;
}

/// @param x  in the axes of the shape, of length 1
double TargetShape::Unscaled(const Vector3d& x) const
{
  const Vector3d& h = this->HalfLengths;
  switch (this->Kind)
  {
    case TargetKind::Sphere:
      return 1.0;
    case TargetKind::Ellipsoid:
      return 1.0 / x.cwiseQuotient(h).norm();
    case TargetKind::Superquadric:
    {
      const Vector3d y = x.cwiseQuotient(h).cwiseAbs();
      const double most = y.maxCoeff();
      if (this->Edges == 0.0)
      {
        return 1.0 / most;
      }
      const double sum = (y / most).array().pow(2.0 / this->Edges).sum();
      return std::pow(sum, -0.5 * this->Edges) / most;
    }
    case TargetKind::Box:
    {
      const double rho = this->Edges * h.minCoeff();
      return RoundedBoxRadius(x, h.array() - rho, rho);
    }
    case TargetKind::Cylinder:
    case TargetKind::Capsule:
    {
      const double along = x(this->Axis);
      const double away = std::hypot(x((this->Axis + 1) % 3), x((this->Axis + 2) % 3));
      const double length = h(this->Axis);
      const double radius = h((this->Axis + 1) % 3);
      const double rho =
        this->Kind == TargetKind::Capsule ? radius : this->Edges * std::min(length, radius);
      // No extent along a third axis: the ray never leaves it.
      return RoundedBoxRadius({ along, away, 0.0 }, { length - rho, radius - rho, 1.0 }, rho);
    }
    case TargetKind::Mesh:
      break;
  }
  return this->Scale * this->Mesh->RadiusAlong(x);
}

double TargetShape::RadiusAlong(const Vector3d& d) const
{
  return this->Unscaled(this->Axes.transpose() * d);
}

Vector3d TargetShape::Reach(const Vector3d& d) const
{
  const double length = d.norm();
  return length > 0.0 ? Vector3d(this->RadiusAlong(d / length) * d) : Vector3d(Vector3d::Zero());
}
} // namespace SphericalStyle
