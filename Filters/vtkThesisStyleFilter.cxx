// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkThesisStyleFilter.h"

#include "vtkFilterSupport.h"

#include "vtkObjectFactory.h"

using vtkFilterSupport::OnOff;

vtkStandardNewMacro(vtkThesisStyleFilter);

vtkThesisStyleFilter::vtkThesisStyleFilter() = default;

vtkThesisStyleFilter::~vtkThesisStyleFilter() = default;

void vtkThesisStyleFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ConcaveEdges: " << this->ConcaveEdges << "\n";
  os << indent << "Acceleration: " << OnOff(this->Acceleration) << "\n";
  os << indent << "Anchor: " << this->Anchor << "\n";
  os << indent << "ComponentCoupling: " << this->ComponentCoupling << "\n";
  os << indent << "InitialGuess: " << this->InitialGuess << "\n";
  os << indent << "WeldCoincidentPoints: " << OnOff(this->WeldCoincidentPoints) << "\n";
  os << indent << "GenerateCellEnergy: " << OnOff(this->GenerateCellEnergy) << "\n";
}
