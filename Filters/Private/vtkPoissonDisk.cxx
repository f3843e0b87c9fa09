// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPoissonDisk.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPoissonDiskSampler.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <mutex>

std::vector<int> vtkPoissonDisk(
  const SphericalStyle::Points& samples, const SphericalStyle::Points& normals, double radius)
{
  const vtkIdType n = samples.rows();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(n);
  vtkNew<vtkDoubleArray> directions; // the sampler does not look at them, but crashes without
  directions->SetName("Normals");
  directions->SetNumberOfComponents(3);
  directions->SetNumberOfTuples(n);
  vtkNew<vtkIntArray> ids;
  ids->SetName("Sample");
  ids->SetNumberOfTuples(n);
  for (vtkIdType i = 0; i < n; ++i)
  {
    points->SetPoint(i, samples.row(i).data());
    directions->SetTuple(i, normals.row(i).data());
    ids->SetValue(i, static_cast<int>(i));
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  cloud->GetPointData()->SetNormals(directions);
  cloud->GetPointData()->AddArray(ids);

  vtkNew<vtkPoissonDiskSampler> sampler;
  sampler->SetInputData(cloud);
  sampler->SetRadius(radius);
  // In one thread: with more the sampler keeps other points each time, and too few. The setting is
  // of the whole process, so two filters at once take turns.
  static std::mutex oneAtATime;
  const std::lock_guard<std::mutex> lock(oneAtATime);
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config{ 1, "Sequential", false }, [&sampler] { sampler->Update(); });

  vtkPointSet* output = vtkPointSet::SafeDownCast(sampler->GetOutputDataObject(0));
  auto* kept = vtkIntArray::SafeDownCast(output->GetPointData()->GetArray("Sample"));
  std::vector<int> result(kept->Begin(), kept->End());
  std::sort(result.begin(), result.end());
  return result;
}
