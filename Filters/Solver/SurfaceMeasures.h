// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Areas, volume, normals and the measures of section [measures].
#ifndef SphericalStyle_SurfaceMeasures_h
#define SphericalStyle_SurfaceMeasures_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// m triangle areas, length^2.
Eigen::VectorXd TriangleAreas(const Points& P, const Triangles& F);
/// n lumped areas: a third of each triangle to each corner, length^2. They sum to the surface area.
Eigen::VectorXd PointAreas(const Points& P, const Triangles& F);
/// Signed volume of a closed surface, positive when oriented outward; for an open one, of the cones
/// from the mean point to its triangles. length^3.
double EnclosedVolume(const Points& P, const Triangles& F);
/// Mean of the triangles' centroids, weighted by their areas.
Eigen::Vector3d AreaCentroid(const Points& P, const Triangles& F);
/// m x 3 unit normals of the triangles; 0 where there is no area.
Points TriangleNormals(const Points& P, const Triangles& F);
/// n x 3 unit normals, triangle normals weighted by the angle at the point (Thuermer, Wuethrich,
/// Computing vertex normals from polygonal facets, 1998); 0 where they cancel.
Points PointNormals(const Points& P, const Triangles& F);

/// Sphericity pi^(1/3) (6 V)^(2/3) / A: 1 for a ball, less for all else. [measures]
double Sphericity(const Points& P, const Triangles& F);
/// Standard deviation of |p - O| over its mean. [measures]
double RadiusSpread(const Points& P, const Eigen::Vector3d& center);
/// Detail error [measures]: rms difference of the cotangent-Laplacian vectors sum_j w_ij (p_i -
/// p_j) of P turned by R and of Q, relative to the diagonal of P.
/// @param R  n rotations of the cells, rest to deformed
double DetailError(const Points& P, const Points& Q, const Triangles& F, const Matrices& R);
} // namespace SphericalStyle

#endif
