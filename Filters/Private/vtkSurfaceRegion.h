// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The part of a surface that may move: a mask array, a vtkSelection, and a smooth border. Private.
#ifndef vtkSurfaceRegion_h
#define vtkSurfaceRegion_h

#include "TriangleMesh.h"

#include <vector>

class vtkAlgorithm;
class vtkInformation;
class vtkPolyData;
class vtkSelection;
struct vtkSurfaceMesh;

namespace vtkSurfaceRegion
{
/// One per point of the input: 1 for selected points and points of selected cells. Nodes that name
/// other blocks than the one that the filter runs over select nothing of it.
/// @throw std::invalid_argument for selections that need ParaView's query language
std::vector<char> SelectedPoints(vtkAlgorithm* self, vtkPolyData* input, vtkSelection* selection);

/// 1 for mesh points that may move: where the array is not 0 and that the selection takes, by
/// itself or by one of its cells. Of coincident points one is enough: they move together or not at
/// all. Empty when there is neither array nor selection.
/// @param mask  vtkAlgorithm::GetInputArrayInformation @param selection  or nullptr
/// @throw std::invalid_argument naming Region and the array's fault, or for selections that need
///        ParaView's query language
std::vector<char> Marks(vtkAlgorithm* self, vtkInformation* mask, vtkSelection* selection,
  vtkPolyData* input, const vtkSurfaceMesh& surface);

/// BorderWeights by the distance of every point inside to the nearest one outside. Distances are
/// straight, which makes borders across cracks and between parts smooth too.
/// @param P  n x 3 @param inside  n, 0 or 1 @param width  fraction of the diagonal of the bounds
/// @return n, 0 outside, 1 deep inside
Eigen::VectorXd Weights(
  const SphericalStyle::Points& P, const std::vector<char>& inside, double width, int threads);
}

#endif
