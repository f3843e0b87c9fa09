// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The points that a vtkSelection means. Private.
#ifndef vtkSelectedPoints_h
#define vtkSelectedPoints_h

#include <vector>

class vtkPolyData;
class vtkSelection;

/// @return one per point of the input: 1 for selected points and points of selected cells
/// @throw std::invalid_argument for selections that need ParaView's query language
std::vector<char> vtkSelectedPoints(vtkPolyData* input, vtkSelection* selection);

#endif
