// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The plane of symmetry of a surface, and how far the surface is from its mirror image [symmetry].
/// Private.
#ifndef vtkSymmetryPlane_h
#define vtkSymmetryPlane_h

#include "Frame.h"
#include "MirrorPlane.h"

#include <memory>
#include <vector>

class vtkStaticCellLocator;
class vtkStaticPointLocator;

/// Looks for planes about which a surface is nearest to its mirror image.
///
/// Samples x_k of equal area are mirrored, M x_k, and c_k is the place of the surface nearest to
/// that, in the direction m_k: at first another sample, m_k its normal. From 13 directions, those
/// to faces, edges and corners of a cube, and the three principal axes, all through the mean,
/// Gauss-Newton on
///
///     sum_k w_k (m_k . (M x_k - c_k))^2,    w_k = 1 / (1 + (|M x_k - c_k| / 3 median)^2)
///
/// over the normal and the distance of the plane leads to minima; the one with the smallest mean of
/// min(|M x_k - c_k|, .05 D) is taken, D the diagonal of the bounds. A sheet that was bent, an arm
/// that is raised and holes count little.
///
/// Why not a library: VTK's vtkReflectionFilter takes a plane, none finds one; CGAL and Open3D
/// neither. Source: iterated closest points for symmetry (N. J. Mitra, L. J. Guibas, M. Pauly,
/// Symmetrization, SIGGRAPH 2007). Cost: some 70,000 searches of a near
/// sample and at most 12,000 of a closest point of the surface: .4 s for 50,000 points.
class vtkSymmetryPlane
{
public:
  /// @param mesh  m > 0 triangles, one of them with an area
  vtkSymmetryPlane(const SphericalStyle::TriangleMesh& mesh, int threads);
  ~vtkSymmetryPlane();

  SphericalStyle::MirrorPlane Find();
  /// The best place of a plane across an axis. @param axis  0, 1, 2: x, y, z
  SphericalStyle::MirrorPlane FindAcross(int axis);
  /// The share of the area whose mirror image is nearer to the surface than .02 D.
  double ShareNear(const SphericalStyle::MirrorPlane& plane) const;

  /// Of the area, less of which makes a symmetry by chance alone.
  static constexpr double LeastShare = 0.6;

private:
  struct Image;
  struct Search; // how many samples, how many rounds, where they end
  std::vector<Image> Mirror(const SphericalStyle::MirrorPlane& plane, const Search& search) const;
  SphericalStyle::MirrorPlane Refined(
    SphericalStyle::MirrorPlane plane, const Search& search) const;
  double Cost(const SphericalStyle::MirrorPlane& plane, const Search& search) const;
  void BuildCells();

  SphericalStyle::MirrorPlane OutOfFrame(const SphericalStyle::MirrorPlane& plane) const;

  SphericalStyle::Frame Units;
  SphericalStyle::TriangleMesh Mesh; // in the frame, as all of this
  SphericalStyle::Points Samples;    // the first ones are spread over the surface, too
  SphericalStyle::Points Normals;    // of the samples
  int Threads = 1;
  std::shared_ptr<vtkStaticPointLocator> Points;
  std::shared_ptr<vtkStaticCellLocator> Cells; // of the surface, to find a plane
};

#endif
