// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The plane of symmetry of a surface, and how far the surface is from its mirror image [symmetry].
/// Private.
#ifndef vtkSymmetryPlane_h
#define vtkSymmetryPlane_h

#include "MirrorPlane.h"

/// Looks for planes about which a surface is nearest to its mirror image.
///
/// Samples x_k of equal area are mirrored, M x_k, and c_k is the place of the surface nearest to
/// that; m_k is the normal of its triangle, in the last rounds the direction from c_k to M x_k.
/// From 13 directions, those to faces, edges and corners of a cube, and the three principal axes,
/// all through the mean, Gauss-Newton on
///
///     sum_k w_k (m_k . (M x_k - c_k))^2,    w_k = 1 / (1 + (|M x_k - c_k| / 3 median)^2)
///
/// over the normal and the distance of the plane leads to minima; the one with the smallest mean of
/// min(|M x_k - c_k|, .05 D) is taken, D the diagonal of the bounds. A sheet that was bent, an arm
/// that is raised and holes count little.
///
/// Why not a library: VTK's vtkReflectionFilter takes a plane, none finds one; CGAL and Open3D
/// neither. Source: iterated closest points for symmetry (N. J. Mitra, L. J. Guibas, M. Pauly,
/// Symmetrization, SIGGRAPH 2007). Cost: at most 190,000 searches of a closest point of the
/// surface, which take longest where the mirror image is far: .6 to 2 s in one thread on 16 models
/// of 800 to 50,000 points, and .1 to 3 s across an axis. Nobody can end it.
namespace vtkSymmetryPlane
{
struct Found
{
  SphericalStyle::MirrorPlane plane;
  double share = 0.0; ///< of the area whose mirror image is nearer to the surface than .02 D
};

/// Of the area, less of which makes a symmetry by chance alone.
constexpr double LeastShare = 0.6;

/// The best plane of all. @param mesh  m > 0 triangles, one of them with an area
Found Find(const SphericalStyle::TriangleMesh& mesh, int threads);
/// The best place of a plane across an axis. @param axis  0, 1, 2: x, y, z
Found FindAcross(const SphericalStyle::TriangleMesh& mesh, int axis, int threads);
}

#endif
