// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The model of a style filter as it is solved: its mesh, with long edges split where that is
/// wanted. Private.
#ifndef vtkStyleModel_h
#define vtkStyleModel_h

#include "Advice.h" // for ModelFacts
#include "vtkLongEdges.h"
#include "vtkSmartPointer.h"
#include "vtkSurfaceMeshConversion.h"

#include <memory>

class vtkAlgorithm;
class vtkInformation;
class vtkPolyData;
class vtkSelection;

/// Keeps the mesh of the last input, so that an input that has not changed is only compared.
class vtkStyleModel
{
public:
  /// Which long edges are split, and the arrays whose values are not to be blended on them.
  struct Refinement
  {
    int When = vtkLongEdges::NEVER;     ///< a vtkLongEdges::Refinements
    double Length = 0.0;                ///< longest edge, fraction of the diagonal of the bounds
    vtkInformation* Region = nullptr;   ///< vtkAlgorithm::GetInputArrayInformation, or nullptr
    vtkInformation* CenterId = nullptr; ///< the same
  };

  /// What one execution solves. With long edges split, model and selection have the new points.
  struct Solved
  {
    vtkSmartPointer<vtkPolyData> Model;
    vtkSmartPointer<vtkSelection> Selection; ///< or nullptr
    std::shared_ptr<const vtkSurfaceMesh> Surface;
    /// Share of the area that was in triangles with long edges, 0..1; 0 where none were split.
    double SplitShare = 0.0;
    SphericalStyle::ModelFacts Facts; ///< of the model, before edges were split

    /// The mesh, as long as anybody has it: solvers recognize it by that.
    std::shared_ptr<const SphericalStyle::TriangleMesh> ShareMesh() const
    {
      return { this->Surface, &this->Surface->Mesh };
    }
  };

  explicit vtkStyleModel(
    vtkSurfaceMeshConversion::TakePoints take = vtkSurfaceMeshConversion::TakePoints::OfTriangles)
    : Take(take)
  {
  }

  /// @param self  the filter, for its progress and blocks @param selection  or nullptr
  /// @param weld  coincident input points become one mesh point
  /// @param processes  that the surface is spread over, or nullptr; see FromPolyData
  /// @return with what vtkSurfaceMeshConversion::Remarks says of the input
  /// @throw std::invalid_argument see FromPolyData, vtkLongEdges::Split, FindPointArray;
  /// WholeSurfaceNeeded where the edges of a surface that is spread are to be split
  Solved Update(vtkAlgorithm* self, vtkPolyData* input, vtkSelection* selection, bool weld,
    const Refinement& refinement,
    const std::shared_ptr<const SphericalStyle::Processes>& processes = nullptr);

  /// The mesh of the last input, before edges are split; nullptr where there was none.
  std::shared_ptr<const vtkSurfaceMesh> GetSurface() const { return this->Surface; }

private:
  Solved Refine(vtkAlgorithm* self, vtkPolyData* input, vtkSelection* selection, bool weld,
    const Refinement& refinement) const;

  const vtkSurfaceMeshConversion::TakePoints Take;
  std::shared_ptr<const vtkSurfaceMesh> Surface;
  double LongEdgeShare = 0.0; // of that
  SphericalStyle::ModelFacts Facts;
};

#endif
