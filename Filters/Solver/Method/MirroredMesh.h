// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A surface together with its mirror image: what is smooth on both has the symmetry of a plane
/// [symmetry].
#ifndef SphericalStyle_MirroredMesh_h
#define SphericalStyle_MirroredMesh_h

#include "ClosedFormStyle.h"
#include "Frame.h"
#include "MirrorPlane.h"

namespace SphericalStyle
{
/// Turns the plane to one of the coordinates, so that the grid of the closed form, which lies
/// symmetrically about the origin, has its symmetry to the last bit. Points n + i are the mirror
/// images of points i.
class MirroredMesh
{
public:
  /// @param mesh  in model units @param frame  its frame
  MirroredMesh(const TriangleMesh& mesh, const Frame& frame, const MirrorPlane& plane);

  /// 2 n x 3, in the frame, turned.
  const Points& GetPoints() const { return this->P; }
  const Triangles& GetTriangles() const { return this->F; }
  const MirrorPlane& GetPlane() const { return this->Plane; }
  /// Takes directions into the turned frame.
  const Eigen::Matrix3d& GetTurn() const { return this->Turn; }
  /// That of the mesh, its origin on the plane.
  const Frame& GetFrame() const { return this->MeshFrame; }

  /// Options of the mesh, in its frame, for the points here. A custom center goes to the foot of
  /// its perpendicular on the plane. @throw std::invalid_argument for several centers
  ClosedFormOptions Into(ClosedFormOptions options) const;
  /// What becomes of the n points of the mesh, in its frame.
  ClosedFormResult OutOf(ClosedFormResult result) const;
  Sphere OutOf(Sphere sphere) const;

private:
  Points Doubled(const Points& vectors) const; // turned

  MirrorPlane Plane;
  Frame MeshFrame;
  int Axis = 0;         // of the plane
  Eigen::Matrix3d Turn; // rows take x into the turned frame
  Points P;
  Triangles F;
};
} // namespace SphericalStyle

#endif
