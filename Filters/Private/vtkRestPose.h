// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A model that moves, beside the same model in its rest pose [pose]. Private.
#ifndef vtkRestPose_h
#define vtkRestPose_h

#include "vtkStyleModel.h"

class vtkPolyData;

namespace vtkRestPose
{
/// The model with the points of its rest pose, and its own in an array of points, which long edges
/// split as they split the points.
/// @throw std::invalid_argument where the two have not the same number of points, or naming the
/// first cell that differs
vtkSmartPointer<vtkPolyData> AtRest(vtkPolyData* model, vtkPolyData* rest);

/// Puts what was solved for AtRest back where the model is.
/// @return the mesh in its rest pose
std::shared_ptr<const SphericalStyle::TriangleMesh> TakeBack(vtkStyleModel::Solved& solved);
}

#endif
