// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A surface as a glTF document, and all surfaces of a document as one in the space of its scene.
/// Private.
#ifndef vtkGLTFScene_h
#define vtkGLTFScene_h

#include "vtkGLTFDocument.h"

#include "vtkSmartPointer.h" // for what is made

#include <Eigen/Core>

#include <cstddef>
#include <vector>

class vtkPolyData;

namespace vtkGLTFScene
{
/// Where the points of a primitive are in the surface.
struct Placement
{
  std::size_t Mesh = 0;
  std::size_t Primitive = 0;
  std::size_t Node = 0; ///< that shows it
  /// Of what brings its points into the scene: one for all, or with bones one for each.
  std::vector<Eigen::Matrix3d> Linear = { Eigen::Matrix3d::Identity() };
  std::size_t First = 0; ///< point
  std::size_t Count = 0;
  bool HasNormals = false;

  const Eigen::Matrix3d& LinearOf(std::size_t point) const
  {
    return this->Linear.size() == 1 ? this->Linear.front() : this->Linear[point];
  }
};

/// Whether the map leaves space flat, so that nothing can be carried back through it.
bool IsFlat(const Eigen::Matrix3d& linear);

struct Scene
{
  vtkSmartPointer<vtkPolyData> Surface;
  std::vector<Placement> Placements; ///< primitives of a mesh one after another
  bool HasNormals = false;           ///< one of them, at least
};

/// Makes the document that of the surface: its triangles, normals, colors and texture coordinates.
/// @param document  an empty one
Scene FromSurface(vtkGLTFDocument& document, vtkPolyData* surface);

/// All primitives that the scene shows. A mesh that several nodes show is repeated in the document,
/// since each place of it moves in its own way; what it is made of is not.
/// @throw std::runtime_error saying what is wrong with the document
Scene FromDocument(vtkGLTFDocument& document);
}

#endif
