// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCubicStyleFilter.h"

#include "CubicStyle.h"
#include "vtkFilterSupport.h"

#include "vtkObjectFactory.h"

#include <cmath>

vtkStandardNewMacro(vtkCubicStyleFilter);

vtkCubicStyleFilter::vtkCubicStyleFilter()
{
  this->Tolerance = 1e-3;
  this->MaximumNumberOfIterations = 500;
}

vtkCubicStyleFilter::~vtkCubicStyleFilter() = default;

std::shared_ptr<SphericalStyle::LocalTerm> vtkCubicStyleFilter::MakeTerm(vtkInformationVector**)
{
  vtkFilterSupport::Require(std::isfinite(this->Cubeness) && this->Cubeness >= 0.0, "Cubeness",
    "finite and 0 or more", this->Cubeness);
  return std::make_shared<SphericalStyle::CubicStyle>(this->Cubeness);
}

void vtkCubicStyleFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Cubeness: " << this->Cubeness << "\n";
}
