// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Areas, volume, normals and the measures of one surface in section [measures].
#ifndef SphericalStyle_SurfaceMeasures_h
#define SphericalStyle_SurfaceMeasures_h

#include "SurfacePart.h"

namespace SphericalStyle
{
/// Whether a triangle has no usable angles: twice its area is 1e-10 times its longest edge squared,
/// or less.
bool IsDegenerate(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// P at about size 1, by a power of two, so that no digit changes: areas are infinite from 1e154
/// on.
Points AtUnitSize(const Points& P);
/// m triangle areas, length^2.
Eigen::VectorXd TriangleAreas(const Points& P, const Triangles& F);
/// n lumped areas: a third of each triangle to each corner, length^2. They sum to the surface area.
Eigen::VectorXd PointAreas(const Points& P, const Triangles& F);
/// Mean of the points.
Eigen::Vector3d PointMean(const Points& P, const SurfacePart& part = {});
/// Signed volume of a closed surface, positive when oriented outward; for an open one, of the cones
/// from the mean point to its triangles. length^3.
double EnclosedVolume(const Points& P, const Triangles& F, const SurfacePart& part = {});
/// By which share that volume changes where the apex moves by r, the radius of the ball of the same
/// volume: |sum of the area vectors| r / (3 V), which is |sum| / (4 pi r^2). 0 for what is closed
/// and faces one way all over, about a half for half a sphere, infinite for a flat sheet.
double VolumeAmbiguity(const Points& P, const Triangles& F, const SurfacePart& part = {});
/// Radius of the ball of that volume, whatever its sign.
double BallRadius(double volume);
/// Six times the signed volume of the tetrahedron of triangle f and an apex, length^3: its sum over
/// a closed surface is six times the volume, for any apex.
double TripleProduct(const Points& P, const Triangles& F, Eigen::Index f, const Eigen::Vector3d& O);
/// Of triangle f seen from O, with the sign of TripleProduct, -2 pi to 2 pi (Van Oosterom,
/// Strackee, The solid angle of a plane triangle, 1983). Its sum over a closed surface is 4 pi
/// times how often the surface goes around O.
double SolidAngle(const Points& P, const Triangles& F, Eigen::Index f, const Eigen::Vector3d& O);
/// Mean of the triangles' centroids, weighted by their areas.
Eigen::Vector3d AreaCentroid(const Points& P, const Triangles& F, const SurfacePart& part = {});
/// Second moments of the surface about that, by area, length^2.
Eigen::Matrix3d AreaMoments(const Points& P, const Triangles& F, const SurfacePart& part = {});
/// m x 3 unit normals of the triangles, at any size; 0 where there is no area.
Points TriangleNormals(const Points& P, const Triangles& F);
/// n x 3 unit normals, triangle normals weighted by the angle at the point (Thuermer, Wuethrich,
/// Computing vertex normals from polygonal facets, 1998), at any size; 0 where they cancel.
Points PointNormals(const Points& P, const Triangles& F, const SurfacePart& part = {});
/// The sums of which PointNormals takes the directions, where triangles elsewhere add to them.
Points PointNormalSums(const Points& P, const Triangles& F);
/// Makes directions of them.
void NormalizeSums(Points& normals);

/// Sphericity pi^(1/3) (6 V)^(2/3) / A: 1 for a ball, less for all else. [measures]
double Sphericity(const Points& P, const Triangles& F, const SurfacePart& part = {});
/// Standard deviation of |p - O| over its mean. [measures]
double RadiusSpread(const Points& P, const Eigen::Vector3d& center, const SurfacePart& part = {});

/// The sphere nearest to the points: the sum of (|p - center| - radius)^2 is least. [measures]
struct FittedSphere
{
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0.0;
  double error = 0.0; ///< rms distance of the points from it, over the radius
};
/// NaN for points in a plane (four on a sphere are needed).
FittedSphere FitSphere(const Points& P, const SurfacePart& part = {});

/// Cosine of the angle between the direction from the center and the normal, n: above 0 everywhere
/// on a surface that is star-shaped around the center. 0 for a point on the center.
/// @param normals  n x 3 unit normals
Eigen::VectorXd RadialCosines(
  const Points& P, const Points& normals, const Eigen::Vector3d& center);
} // namespace SphericalStyle

#endif
