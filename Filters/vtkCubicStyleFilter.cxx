// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCubicStyleFilter.h"

#include "CubicStyle.h"
#include "vtkFilterSupport.h"
#include "vtkLocalTermStyle.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <cmath>
#include <stdexcept>

using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkCubicStyleFilter);

struct vtkCubicStyleFilter::Internals
{
  vtkLocalTermStyle Style;

  static void SetFacts(vtkCubicStyleFilter* self, const SphericalStyle::LoopReport& report);
};

void vtkCubicStyleFilter::Internals::SetFacts(
  vtkCubicStyleFilter* self, const SphericalStyle::LoopReport& report)
{
  self->NumberOfIterations = report.iterations;
  self->Converged = report.converged;
  self->FinalEnergy = report.history.empty() ? 0.0 : report.history.back().energy.Total();
}

//------------------------------------------------------------------------------------------------
vtkCubicStyleFilter::vtkCubicStyleFilter()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(2);
}

vtkCubicStyleFilter::~vtkCubicStyleFilter() = default;

int vtkCubicStyleFilter::FillInputPortInformation(int, vtkInformation* info)
{
  TakeDataSet(info);
  return 1;
}

int vtkCubicStyleFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkCubicStyleFilter::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(
    this, outputVector, [&] { return this->Execute(inputVector, outputVector); },
    [this] { this->Internal = std::make_unique<Internals>(); });
}

int vtkCubicStyleFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  Internals::SetFacts(this, {});
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  vtkLocalTermStyle& style = this->Internal->Style;
  Require(std::isfinite(this->Cubeness) && this->Cubeness >= 0.0, "Cubeness",
    "finite and 0 or more", this->Cubeness);
  const SphericalStyle::LoopOptions loop = vtkLocalTermStyle::MakeLoopOptions(
    this->StopRule, this->Tolerance, this->MaximumNumberOfIterations, this->Acceleration);
  style.Solve(this, input, loop, this->NumberOfThreads,
    std::make_shared<SphericalStyle::CubicStyle>(this->Cubeness));
  style.FillOutputs(this, input, vtkPolyData::GetData(outputVector, 0),
    vtkTable::GetData(outputVector, 1), this->OutputPointsPrecision, this->GenerateNormals,
    "Cubic");
  Internals::SetFacts(this, style.GetReport());
  return 1;
}

void vtkCubicStyleFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Cubeness: " << this->Cubeness << "\n";
  os << indent << "StopRule: " << this->StopRule << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "Acceleration: " << OnOff(this->Acceleration) << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "GenerateNormals: " << OnOff(this->GenerateNormals) << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "Converged: " << OnOff(this->Converged) << "\n";
  os << indent << "FinalEnergy: " << this->FinalEnergy << "\n";
}
