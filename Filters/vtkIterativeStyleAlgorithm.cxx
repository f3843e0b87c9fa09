// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIterativeStyleAlgorithm.h"

#include "LocalGlobal.h"
#include "vtkFilterSupport.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"

using namespace vtkFilterSupport;

vtkIterativeStyleAlgorithm::vtkIterativeStyleAlgorithm()
{
  this->SetNumberOfOutputPorts(2);
}

vtkIterativeStyleAlgorithm::~vtkIterativeStyleAlgorithm() = default;

int vtkIterativeStyleAlgorithm::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

SphericalStyle::LoopOptions vtkIterativeStyleAlgorithm::MakeLoopOptions() const
{
  Require(this->Tolerance > 0.0 && this->Tolerance < 1.0, "Tolerance", "above 0 and below 1",
    this->Tolerance);
  SphericalStyle::LoopOptions loop;
  loop.stopRule = static_cast<SphericalStyle::StopRule>(this->StopRule);
  loop.tolerance = this->Tolerance;
  loop.maximumNumberOfIterations = this->MaximumNumberOfIterations;
  loop.acceleration = this->StopRule == CONVERGED;
  return loop;
}

void vtkIterativeStyleAlgorithm::SetLoopFacts(const SphericalStyle::LoopReport& loop)
{
  this->NumberOfIterations = loop.iterations;
  this->Converged = loop.converged;
  this->FinalEnergy = loop.history.empty() ? 0.0 : loop.history.back().energy.Total();
}

void vtkIterativeStyleAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "StopRule: " << this->StopRule << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "Converged: " << OnOff(this->Converged) << "\n";
  os << indent << "FinalEnergy: " << this->FinalEnergy << "\n";
}
