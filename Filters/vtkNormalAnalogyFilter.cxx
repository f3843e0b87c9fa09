// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNormalAnalogyFilter.h"

#include "NormalAnalogy.h"
#include "vtkFilterSupport.h"
#include "vtkLocalTermStyle.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPlatonicSolidSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStaticPointLocator.h"
#include "vtkTable.h"

#include <cmath>
#include <stdexcept>
#include <string>

using SphericalStyle::Points;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkNormalAnalogyFilter);

namespace
{
enum InputPorts
{
  MODEL = 0,
  STYLE_MESH = 1
};

Points NormalsOfSolid(int solid)
{
  vtkNew<vtkPlatonicSolidSource> source; // its solids have the numbers of our enumeration
  source->SetSolidType(solid);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  const vtkSurfaceMesh solidMesh =
    vtkSurfaceMeshConversion::FromPolyData(source->GetOutput(), true);
  return SphericalStyle::DistinctNormals(solidMesh.Mesh.P, solidMesh.Mesh.F);
}

/// @param mesh  input port 1 or nullptr @throw std::invalid_argument naming the style mesh
Points NormalsOfMesh(vtkPolyData* mesh)
{
  if (!mesh)
  {
    throw std::invalid_argument("StyleMesh: Style is Mesh, but nothing is connected to input 1");
  }
  Points normals;
  if (mesh->GetNumberOfPoints() > 0)
  {
    try
    {
      const vtkSurfaceMesh style = vtkSurfaceMeshConversion::FromPolyData(mesh, true);
      normals = SphericalStyle::DistinctNormals(style.Mesh.P, style.Mesh.F);
    }
    catch (const std::invalid_argument& error)
    {
      throw std::invalid_argument(std::string("StyleMesh: ") + error.what());
    }
  }
  if (normals.rows() == 0)
  {
    throw std::invalid_argument("StyleMesh: input 1 has no triangle with an area");
  }
  return normals;
}

/// Closest of the style's normals. Of unit vectors the nearest is the one at the smallest angle.
SphericalStyle::NormalAnalogy::NormalMap ClosestNormal(const Points& style)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < style.rows(); ++i)
  {
    points->InsertNextPoint(style.row(i).data());
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  auto locator = vtkSmartPointer<vtkStaticPointLocator>::New();
  locator->SetDataSet(cloud);
  if (style.rows() > 1) // it divides by the size of the bounds
  {
    locator->BuildLocator();
  }
  return [style, locator](const Points& normals)
  {
    Points targets(normals.rows(), 3);
    for (Eigen::Index i = 0; i < normals.rows(); ++i)
    {
      const vtkIdType closest =
        style.rows() > 1 ? locator->FindClosestPoint(normals.row(i).data()) : 0;
      targets.row(i) = style.row(closest);
    }
    return targets;
  };
}
}

//------------------------------------------------------------------------------------------------
struct vtkNormalAnalogyFilter::Internals
{
  vtkLocalTermStyle Style;

  static void SetFacts(
    vtkNormalAnalogyFilter* self, const SphericalStyle::LoopReport& report, int styleNormals);
};

void vtkNormalAnalogyFilter::Internals::SetFacts(
  vtkNormalAnalogyFilter* self, const SphericalStyle::LoopReport& report, int styleNormals)
{
  self->NumberOfStyleNormals = styleNormals;
  self->NumberOfIterations = report.iterations;
  self->Converged = report.converged;
  self->FinalEnergy = report.history.empty() ? 0.0 : report.history.back().energy.Total();
}

//------------------------------------------------------------------------------------------------
vtkNormalAnalogyFilter::vtkNormalAnalogyFilter()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkNormalAnalogyFilter::~vtkNormalAnalogyFilter() = default;

void vtkNormalAnalogyFilter::SetStyleMeshConnection(vtkAlgorithmOutput* mesh)
{
  this->SetInputConnection(STYLE_MESH, mesh);
}

void vtkNormalAnalogyFilter::SetStyleMeshData(vtkPolyData* mesh)
{
  this->SetInputData(STYLE_MESH, mesh);
}

int vtkNormalAnalogyFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  if (port == STYLE_MESH)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  else
  {
    TakeDataSet(info);
  }
  return 1;
}

int vtkNormalAnalogyFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkNormalAnalogyFilter::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(
    this, outputVector, [&] { return this->Execute(inputVector, outputVector); },
    [this] { this->Internal = std::make_unique<Internals>(); });
}

int vtkNormalAnalogyFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[MODEL], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  Internals::SetFacts(this, {}, 0);
  if (!IsSurface(this, inputVector[MODEL]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  vtkLocalTermStyle& style = this->Internal->Style;
  Require(std::isfinite(this->Weight) && this->Weight >= 0.0, "Weight", "finite and 0 or more",
    this->Weight);
  const SphericalStyle::LoopOptions loop = vtkLocalTermStyle::MakeLoopOptions(
    this->StopRule, this->Tolerance, this->MaximumNumberOfIterations, this->Acceleration);
  const Points normals = this->Style == MESH
    ? NormalsOfMesh(vtkPolyData::GetData(inputVector[STYLE_MESH], 0))
    : NormalsOfSolid(this->Style);
  const auto analogy =
    std::make_shared<SphericalStyle::NormalAnalogy>(ClosestNormal(normals), this->Weight);
  style.Solve(this, input, loop, this->NumberOfThreads, analogy);
  style.FillOutputs(this, input, output, vtkTable::GetData(outputVector, 1),
    this->OutputPointsPrecision, this->GenerateNormals, "Analogy");
  if (this->GenerateTargetNormal)
  {
    vtkSurfaceMeshConversion::AddPointArray(output, style.GetSurface(), "TargetNormal",
      output->GetPoints()->GetDataType(), analogy->GetTargets());
  }
  Internals::SetFacts(this, style.GetReport(), static_cast<int>(normals.rows()));
  return 1;
}

void vtkNormalAnalogyFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Style: " << this->Style << "\n";
  os << indent << "Weight: " << this->Weight << "\n";
  os << indent << "StopRule: " << this->StopRule << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "Acceleration: " << OnOff(this->Acceleration) << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "GenerateNormals: " << OnOff(this->GenerateNormals) << "\n";
  os << indent << "GenerateTargetNormal: " << OnOff(this->GenerateTargetNormal) << "\n";
  os << indent << "NumberOfStyleNormals: " << this->NumberOfStyleNormals << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "Converged: " << OnOff(this->Converged) << "\n";
  os << indent << "FinalEnergy: " << this->FinalEnergy << "\n";
}
