// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Shapes in place of the target sphere [target].
#ifndef SphericalStyle_TargetShape_h
#define SphericalStyle_TargetShape_h

#include "TriangleTree.h"

#include <memory>

namespace SphericalStyle
{
enum class TargetKind
{
  Sphere,
  Ellipsoid,
  Capsule,
  Cylinder,
  Box,
  Superquadric,
  Mesh
};

/// A closed mesh whose whole surface is seen from the centroid of its area.
class StarMesh
{
public:
  /// @throw NotStarShaped @throw std::invalid_argument for a mesh without triangles, points that
  /// are not finite, and for one that is not closed
  explicit StarMesh(const TriangleMesh& mesh);

  /// Distance of the surface from the centroid. @param d  not 0; the length of it is the unit
  double RadiusAlong(const Eigen::Vector3d& d) const;
  double GetArea() const { return this->Area; }
  double GetVolume() const { return this->Volume; }

private:
  int TriangleToward(const Eigen::Vector3d& d) const;
  double RadiusAt(int f, const Eigen::Vector3d& d) const;

  Points P; // about the centroid, where the diagonal of the bounds is 1
  Triangles F;
  double Outward = 1.0; // -1 where the triangles face inward
  std::unique_ptr<TriangleTree> Tree;
  double Area = 0.0;
  double Volume = 0.0;
};

/// A mesh with a triangle that cannot be seen from the centroid.
class NotStarShaped : public std::invalid_argument
{
public:
  explicit NotStarShaped(int triangle)
    : std::invalid_argument(
        "triangle " + std::to_string(triangle) + " is not seen from the centroid of the surface")
    , Triangle(triangle)
  {
  }

  int Triangle;
};

struct ShapeOptions
{
  TargetKind kind = TargetKind::Sphere;
  double edges = 0.5; ///< q, 0..1: how round the edges of cylinders, boxes and superquadrics are
  /// Of the shape along the axes of the model's coordinates, > 0, in any unit; 0: the axes and
  /// proportions of the surface.
  Eigen::Vector3d lengths = Eigen::Vector3d::Zero();
  std::shared_ptr<const StarMesh> mesh; ///< of kind Mesh
  /// Columns are the axes of the model's coordinates.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  bool operator==(const ShapeOptions& other) const;
};

/// A star-shaped surface about the origin, with the area of the unit sphere or the volume of the
/// unit ball, by its radial function R: the surface is all R(d) d. With x = E^T d in its own axes E
/// and h its half lengths:
///
/// - Ellipsoid: R = 1 / |x / h|.
/// - Superquadric: R = (sum_i (|x_i| / h_i)^(2 / q))^(-q / 2).
/// - Box: all points within rho = q min(h) of the box of half lengths b = h - rho. With a = |x| and
///   the k axes whose b_i / a_i are smallest, A = sum a_i^2 and B = sum a_i b_i over them,
///   R = (B + sqrt(A rho^2 - sum_{i<j} (a_i b_j - a_j b_i)^2)) / A, for the first k for which that
///   is no more than the next b_i / a_i.
/// - Cylinder: the same with x = (along the axis, away from it); the axis is the longest of the
///   three where the other two differ less, else the shortest.
/// - Capsule: a cylinder along the longest axis, h no less than its radius rho.
/// - Mesh: that of the triangle which d meets.
///
/// E and h are those with which the surface of the shape has the second moments of the model's
/// surface: a model that is such a shape is its own target. h is no less than a tenth of the
/// longest. Axes within 20 degrees of an axis of the coordinates are that axis, and so are those
/// that two or three moments that differ by less than a tenth of their lengths leave open: most
/// models stand upright.
///
/// Cost: some 50,000 values of R to make; 20 to 100 ns for a value, a search of a tree for a mesh.
class TargetShape
{
public:
  TargetShape() = default; ///< the unit sphere
  /// @param moments  second moments of the model's surface about its centroid, by area, length^2 in
  /// the coordinates of directions; of no use where lengths are given
  TargetShape(
    const ShapeOptions& options, const Eigen::Matrix3d& moments, bool equalVolume = false);

  void Turn(const Eigen::Matrix3d& rotation) { this->Axes = rotation * this->Axes; }
  bool IsSphere() const { return this->Kind == TargetKind::Sphere; }
  /// @param d  0, or a direction of any length @return R(d / |d|) d
  Eigen::Vector3d Reach(const Eigen::Vector3d& d) const;
  /// R(d). @param d  of length 1
  double RadiusAlong(const Eigen::Vector3d& d) const;

  const Eigen::Matrix3d& GetAxes() const { return this->Axes; }               ///< E
  const Eigen::Vector3d& GetHalfLengths() const { return this->HalfLengths; } ///< h

private:
  struct Size
  {
    double area;
    double volume;
    Eigen::Vector3d moments;
  };
  double Unscaled(const Eigen::Vector3d& x) const;
  Size MeasureSize() const;
  void FindAxis();
  void MatchMoments(const Eigen::Vector3d& moments);
  void BoundLengths();

  TargetKind Kind = TargetKind::Sphere;
  double Edges = 0.0;
  int Axis = 0; // of cylinders and capsules
  Eigen::Matrix3d Axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d HalfLengths = Eigen::Vector3d::Ones();
  double Scale = 1.0; // of the mesh
  std::shared_ptr<const StarMesh> Mesh;
};
} // namespace SphericalStyle

#endif
