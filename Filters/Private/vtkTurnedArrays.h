// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Vectors and tensors that turn with what has moved [vectors]. Private.
#ifndef vtkTurnedArrays_h
#define vtkTurnedArrays_h

#include "vtkType.h" // for vtkIdType

#include <Eigen/Core>

#include <functional>

class vtkDataSet;

namespace vtkTurnedArrays
{
/// Rotation of a point, or nullptr where nothing turns.
using RotationOfPoint = std::function<const Eigen::Matrix3d*(vtkIdType)>;

/// Replaces the arrays of floating-point numbers with 3, 6 or 9 components, of points and cells, by
/// turned ones. A cell turns by the rotation that is closest to the mean of those of its points.
/// Normals, texture coordinates and what turns nowhere stay.
void Turn(vtkDataSet* output, const RotationOfPoint& ofPoint);

/// The same for the active normals of points and cells alone.
void TurnNormals(vtkDataSet* output, const RotationOfPoint& ofPoint);
}

#endif
