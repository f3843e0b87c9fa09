// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What vtkSphericalStyleFilter says of its own results: parts that lost their thickness, and what
/// would improve them. Private.
#ifndef vtkStyleReview_h
#define vtkStyleReview_h

#include "vtkSurfaceMeshConversion.h"

#include "Advice.h"
#include "Stage.h"
#include "Thickness.h"

#include <string>
#include <vector>

/// Keeps what depends on the mesh alone, so that a review of the next result of the same mesh is a
/// few passes over its triangles.
class vtkStyleReview
{
public:
  /// What a solve was asked for that its options do not say.
  struct Request
  {
    bool Thesis = false;     ///< ReproduceThesis
    bool CellEnergy = false; ///< GenerateCellEnergy
    bool OwnNormals = false; ///< those of the model, not an array that the user has chosen
  };

  // Of a surface that is spread over processes all of them call both functions, and say the same.

  /// What there is to warn of without looking at the result: input, target spheres, the iteration.
  /// @param o, report  of the solve; of an empty mesh those that were made for it
  static std::vector<std::string> Warnings(const vtkSurfaceMesh& surface,
    const SphericalStyle::MethodOptions& o, const SphericalStyle::StyleReport& report,
    const Request& request);

  struct Remarks
  {
    std::string Thinned; ///< a warning, empty where all parts keep their thickness
    std::string Advice;  ///< see SphericalStyle::Advise
  };

  /// Of a surface that is spread over processes the thickness is not looked at.
  /// @param generation  another one for another mesh: SphericalStyleMethod::GetMeshGeneration
  /// @param Q  points of the result @param o, report  those of the solve that led there
  /// @param choices  as the filter's properties are; what needs CGAL is left out here
  Remarks Review(const vtkSurfaceMesh& surface, int generation, const SphericalStyle::Points& Q,
    const SphericalStyle::MethodOptions& o, const SphericalStyle::StyleReport& report,
    SphericalStyle::AdviceChoices choices);

private:
  std::string ThinnedParts(
    const vtkSurfaceMesh& surface, int generation, const SphericalStyle::Points& Q, int threads);

  // Keys: the generation of the mesh.
  SphericalStyle::Stage<int, SphericalStyle::SurfaceFacts> Facts;
  SphericalStyle::Stage<int, SphericalStyle::ThicknessProbes> Probes;
};

#endif
