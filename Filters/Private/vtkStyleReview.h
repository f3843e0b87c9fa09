// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What vtkSphericalStyleFilter says of its own results: parts that lost their thickness, and what
/// would improve them. Private.
#ifndef vtkStyleReview_h
#define vtkStyleReview_h

#include "vtkSurfaceMeshConversion.h"

#include "Advice.h"
#include "Thickness.h"

#include <string>

/// Keeps what depends on the mesh alone, so that a review of the next result of the same mesh is a
/// few passes over its triangles.
class vtkStyleReview
{
public:
  struct Remarks
  {
    std::string Thinned; ///< a warning, empty where all parts keep their thickness
    std::string Advice;  ///< see SphericalStyle::Advise
  };

  /// @param generation  another one for another mesh: SphericalStyleMethod::GetMeshGeneration
  /// @param Q  points of the result @param o, report  those of the solve that led there
  Remarks Look(const vtkSurfaceMesh& surface, int generation, const SphericalStyle::Points& Q,
    const SphericalStyle::MethodOptions& o, const SphericalStyle::StyleReport& report);

private:
  void SetMesh(const SphericalStyle::TriangleMesh& mesh, int components, int generation);
  std::string LookAtThickness(
    const vtkSurfaceMesh& surface, const SphericalStyle::Points& Q, int threads);

  int Generation = -1; // of the mesh that the rest is of
  SphericalStyle::SurfaceFacts Facts;
  bool HasProbes = false;
  SphericalStyle::ThicknessProbes Probes;
};

#endif
