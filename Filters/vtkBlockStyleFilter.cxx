// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBlockStyleFilter.h"

#include "BlockStyle.h"
#include "vtkFilterSupport.h"

#include "vtkObjectFactory.h"

#include <cmath>

vtkStandardNewMacro(vtkBlockStyleFilter);

vtkBlockStyleFilter::vtkBlockStyleFilter() = default;
vtkBlockStyleFilter::~vtkBlockStyleFilter() = default;

std::shared_ptr<SphericalStyle::LocalTerm> vtkBlockStyleFilter::MakeTerm(vtkInformationVector**)
{
  vtkFilterSupport::Require(std::isfinite(this->Blockiness) && this->Blockiness >= 0.0,
    "Blockiness", "finite and 0 or more", this->Blockiness);
  return std::make_shared<SphericalStyle::BlockStyle>(this->Blockiness);
}

void vtkBlockStyleFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Blockiness: " << this->Blockiness << "\n";
}
