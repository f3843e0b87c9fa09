// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// VTK's Poisson-disk sampler on Eigen matrices [proxy], step 2. Private.
#ifndef vtkPoissonDisk_h
#define vtkPoissonDisk_h

#include "TriangleMesh.h"

#include <vector>

/// Thins samples until no two are nearer than the radius and none could be put back.
/// @return the samples kept, ascending; the same ones each time
std::vector<int> vtkPoissonDisk(
  const SphericalStyle::Points& samples, const SphericalStyle::Points& normals, double radius);

#endif
