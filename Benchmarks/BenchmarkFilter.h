// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// vtkSphericalStyleFilter as a user has it: single-precision points in, everything else default.
#ifndef SphericalStyle_BenchmarkFilter_h
#define SphericalStyle_BenchmarkFilter_h

#include "BenchmarkMesh.h"
#include "BenchmarkProgram.h"
#include "vtkSphericalStyleFilter.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

namespace Benchmarks
{
inline vtkSmartPointer<vtkPolyData> ToPolyData(const SphericalStyle::TriangleMesh& mesh)
{
  vtkNew<vtkPoints> points; // single precision, as readers give them
  points->SetNumberOfPoints(mesh.P.rows());
  for (vtkIdType i = 0; i < mesh.P.rows(); ++i)
  {
    points->SetPoint(i, mesh.P.row(i).data());
  }
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(mesh.F.rows(), 3 * mesh.F.rows());
  for (vtkIdType t = 0; t < mesh.F.rows(); ++t)
  {
    const vtkIdType corners[3] = { mesh.F(t, 0), mesh.F(t, 1), mesh.F(t, 2) };
    triangles->InsertNextCell(3, corners);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

/// E after the start and after each iteration, and E_0 of the unmoved model. None, and 0, where
/// nothing was minimised.
struct Energies
{
  explicit Energies(vtkSphericalStyleFilter* filter)
  {
    auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
    auto* total = vtkDataArray::SafeDownCast(table->GetColumnByName("Total"));
    for (vtkIdType k = 0; k < total->GetNumberOfTuples(); ++k)
    {
      this->Totals.push_back(total->GetComponent(k, 0));
    }
    auto* change = vtkDataArray::SafeDownCast(table->GetColumnByName("GlobalChange"));
    this->Rest = this->Totals.empty() ? 0.0 : this->Totals.front() - change->GetComponent(0, 0);
  }

  std::vector<double> Totals;
  double Rest = 0.0;
};

/// Seconds of each stage of the last execution, by name.
inline std::map<std::string, double> StageSeconds(vtkSphericalStyleFilter* filter)
{
  auto* stages = filter->GetOutputDataObject(1)->GetFieldData()->GetArray("StageSeconds");
  std::map<std::string, double> seconds;
  for (int k = 0; k < stages->GetNumberOfComponents(); ++k)
  {
    seconds[stages->GetComponentName(k)] = stages->GetComponent(0, k);
  }
  return seconds;
}

inline std::string HashOfPoints(vtkSphericalStyleFilter* filter)
{
  vtkDataArray* data = filter->GetOutput()->GetPoints()->GetData();
  return Hash(data->GetVoidPointer(0),
    static_cast<std::size_t>(data->GetNumberOfValues()) * data->GetDataTypeSize());
}
} // namespace Benchmarks

#endif
