// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStyleAlgorithm.h"

#include "vtkFilterSupport.h"

vtkStyleAlgorithm::vtkStyleAlgorithm() = default;

vtkStyleAlgorithm::~vtkStyleAlgorithm() = default;

int vtkStyleAlgorithm::FillInputPortInformation(int, vtkInformation* info)
{
  vtkFilterSupport::TakeDataSet(info);
  return 1;
}

void vtkStyleAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "GenerateNormals: " << vtkFilterSupport::OnOff(this->GenerateNormals) << "\n";
  os << indent
     << "TransformAllInputVectors: " << vtkFilterSupport::OnOff(this->TransformAllInputVectors)
     << "\n";
}
