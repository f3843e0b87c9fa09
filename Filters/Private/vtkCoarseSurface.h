// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A surface of few points to look at in place of one of many [preview]. Private.
#ifndef vtkCoarseSurface_h
#define vtkCoarseSurface_h

#include "ClosedFormStyle.h" // for PreviewPlaces
#include "vtkSmartPointer.h"
#include "vtkSurfaceMeshConversion.h"

#include <memory>

class vtkPolyData;

/// Points are merged in the cells of a regular grid (Rossignac, Borrel, Multi-resolution 3D
/// approximations for rendering complex scenes, 1993), those of one cell where edges within the
/// cell join them: sides of a thin wall and of a texture seam stay apart. Each merged point is one
/// of them, with all of its arrays, the nearest to their mean; along seams one that the other side
/// has, too, so that little gapes there. What triangles are left have the arrays of their cells;
/// cells without faces are left out. Where the triangles share no points, all points of a cell are
/// one.
///
/// Of a surface that is spread over processes each makes its own part coarse, in the same cells.
/// Points where triangles of several processes meet go before others, in an order that all of them
/// know, so that little gapes between the parts.
struct vtkCoarseSurface
{
  vtkSmartPointer<vtkPolyData> Model; ///< at rest
  vtkSurfaceMesh Surface;             ///< of Model
  /// Where each point of Surface is in the mesh of the model, and some triangles of that.
  std::shared_ptr<const SphericalStyle::PreviewPlaces> Places;

  /// To be called by all processes that the surface is spread over.
  /// @param model, surface  what is made coarse
  /// @param wanted  points that are to remain, about, of all processes
  /// @param probes  triangles, the same @param scale  diagonal of the model, length
  static std::shared_ptr<const vtkCoarseSurface> Make(
    vtkPolyData* model, const vtkSurfaceMesh& surface, int wanted, int probes, double scale);
};

#endif
