// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNormalAnalogyFilter.h"

#include "NormalAnalogy.h"
#include "SurfaceMeasures.h"
#include "vtkFilterSupport.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPlatonicSolidSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStaticPointLocator.h"

#include <cmath>
#include <stdexcept>
#include <string>

using SphericalStyle::Points;

vtkStandardNewMacro(vtkNormalAnalogyFilter);

namespace
{
Points NormalsOfSolid(int solid)
{
  vtkNew<vtkPlatonicSolidSource> source; // its solids have the numbers of our enumeration
  source->SetSolidType(solid);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  SphericalStyle::TriangleMesh mesh =
    vtkSurfaceMeshConversion::FromPolyData(source->GetOutput(), true).Mesh;
  if (SphericalStyle::EnclosedVolume(mesh.P, mesh.F) < 0.0)
  {
    mesh.F.col(0).swap(
      mesh.F.col(2)); // tetrahedron and icosahedron of VTK 9.2 and earlier face inward
  }
  return SphericalStyle::DistinctNormals(mesh.P, mesh.F);
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
vtkNormalAnalogyFilter::vtkNormalAnalogyFilter()
{
  this->SetNumberOfInputPorts(2);
}

vtkNormalAnalogyFilter::~vtkNormalAnalogyFilter() = default;

void vtkNormalAnalogyFilter::SetStyleMeshConnection(vtkAlgorithmOutput* mesh)
{
  this->SetInputConnection(vtkFilterSupport::STYLE_MESH, mesh);
}

void vtkNormalAnalogyFilter::SetStyleMeshData(vtkPolyData* mesh)
{
  this->SetInputData(vtkFilterSupport::STYLE_MESH, mesh);
}

int vtkNormalAnalogyFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == vtkFilterSupport::STYLE_MESH)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  return this->Superclass::FillInputPortInformation(port, info);
}

int vtkNormalAnalogyFilter::RequestWholeData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->NumberOfStyleNormals = 0;
  return this->Superclass::RequestWholeData(request, inputVector, outputVector);
}

std::shared_ptr<SphericalStyle::LocalTerm> vtkNormalAnalogyFilter::MakeTerm(
  vtkInformationVector** inputs)
{
  vtkFilterSupport::Require(std::isfinite(this->Weight) && this->Weight >= 0.0, "Weight",
    "finite and 0 or more", this->Weight);
  const Points normals = this->Style == MESH
    ? NormalsOfMesh(vtkPolyData::GetData(inputs[vtkFilterSupport::STYLE_MESH], 0))
    : NormalsOfSolid(this->Style);
  this->NumberOfStyleNormals = static_cast<int>(normals.rows());
  return std::make_shared<SphericalStyle::NormalAnalogy>(ClosestNormal(normals), this->Weight);
}

void vtkNormalAnalogyFilter::AddArrays(
  const SphericalStyle::LocalTerm& term, const vtkSurfaceMesh& surface, vtkPolyData* output)
{
  if (this->GenerateTargetNormal)
  {
    vtkSurfaceMeshConversion::AddPointArray(output, surface, "TargetNormal",
      output->GetPoints()->GetDataType(),
      static_cast<const SphericalStyle::NormalAnalogy&>(term).GetTargets());
  }
}

void vtkNormalAnalogyFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Style: " << this->Style << "\n";
  os << indent << "Weight: " << this->Weight << "\n";
  os << indent << "GenerateTargetNormal: " << vtkFilterSupport::OnOff(this->GenerateTargetNormal)
     << "\n";
  os << indent << "NumberOfStyleNormals: " << this->NumberOfStyleNormals << "\n";
}
