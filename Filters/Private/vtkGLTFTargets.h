// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Morph targets of a glTF document. Private.
#ifndef vtkGLTFTargets_h
#define vtkGLTFTargets_h

#include "vtkGLTFScene.h"
#include "vtkRoundnessTargets.h"

namespace vtkGLTFTargets
{
/// Adds the targets to every primitive of the scene: accessors, names, weights and, where there are
/// several, an animation that moves through them. Weights of animations that there are get values
/// for the new targets, as glTF demands; nothing else changes.
/// @param slider  where it is when the file is opened
/// @throw std::runtime_error saying what is wrong with the document
void Add(vtkGLTFDocument& document, const vtkGLTFScene::Scene& scene,
  const vtkRoundnessTargets::Targets& targets, double slider);
}

#endif
