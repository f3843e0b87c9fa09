// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStyleGLTFWriter.h"

#include "vtkFilterSupport.h"
#include "vtkGLTFDocument.h"
#include "vtkGLTFScene.h"
#include "vtkGLTFTargets.h"
#include "vtkRoundnessTargets.h"
#include "vtkSphericalStyleFilter.h"
#include "vtkWholeFile.h"

#include "vtkCommand.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkStyleGLTFWriter);

namespace
{
/// Whether a filter that moves points has made it.
bool IsRounded(vtkPolyData* model)
{
  return model->GetPointData()->HasArray("Displacement") &&
    model->GetPointData()->HasArray("TargetDirection");
}
} // namespace

vtkStyleGLTFWriter::vtkStyleGLTFWriter()
  : Style(vtkSmartPointer<vtkSphericalStyleFilter>::New())
{
}

vtkStyleGLTFWriter::~vtkStyleGLTFWriter()
{
  this->vtkStyleGLTFWriter::SetFileName(nullptr);
  this->vtkStyleGLTFWriter::SetSourceFileName(nullptr);
}

void vtkStyleGLTFWriter::SetStyle(vtkSphericalStyleFilter* style)
{
  if (this->Style != style)
  {
    this->Style =
      style ? vtk::MakeSmartPointer(style) : vtkSmartPointer<vtkSphericalStyleFilter>::New();
    this->Modified();
  }
}

vtkSphericalStyleFilter* vtkStyleGLTFWriter::GetStyle()
{
  return this->Style;
}

int vtkStyleGLTFWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkStyleGLTFWriter::Write()
{
  if (!this->SourceFileName)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError); // where the input fails WriteData is not called
    return this->Superclass::Write();
  }
  this->WriteData(); // the superclass would ask for an input
  return this->GetErrorCode() == vtkErrorCode::NoError ? 1 : 0;
}

void vtkStyleGLTFWriter::WriteData()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkNew<vtkInformationVector> noOutputs;
  const auto execute = [this]
  {
    this->Execute(vtkPolyData::SafeDownCast(this->GetInput()));
    this->UpdateProgress(1.0);
    return 1;
  };
  if (vtkFilterSupport::RunGuarded(this, noOutputs, execute) == 0 &&
    this->GetErrorCode() == vtkErrorCode::NoError)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
}

void vtkStyleGLTFWriter::Execute(vtkPolyData* input)
{
  const std::string name = this->FileName ? this->FileName : "";
  if (!vtkWholeFile::EndsIn(name, { ".glb", ".gltf" }))
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    throw std::runtime_error("FileName must end in .glb or .gltf; it is \"" + name + "\"");
  }
  // The Style is executed with other values only.
  vtkFilterSupport::RequireTarget(this->Style->GetRoundness(), nullptr, nullptr);
  vtkFilterSupport::Require(!std::isnan(this->MaximumRoundness), "MaximumRoundness",
    "a number from 0.01 to 1000", this->MaximumRoundness);
  vtkFilterSupport::Require(
    !std::isnan(this->Tolerance), "Tolerance", "a number from 0.00001 to 1", this->Tolerance);
  vtkRoundnessTargets::Options options;
  options.MaximumRoundness = std::max(this->MaximumRoundness, this->Style->GetRoundness());
  options.Tolerance = this->Tolerance;
  options.MaximumNumber = this->MaximumNumberOfTargets;
  options.Progress = [this](double share) { this->UpdateProgress(share); };
  vtkGLTFDocument document;
  vtkGLTFScene::Scene scene;
  if (this->SourceFileName)
  {
    vtkWholeFile::Naming(this->SourceFileName,
      [&]
      {
        document = vtkGLTFDocument::Read(this->SourceFileName);
        scene = vtkGLTFScene::FromDocument(document);
      });
    options.MayRefine = false;
    options.WithNormals = scene.HasNormals;
    input = scene.Surface;
  }
  else if (!input || input->GetNumberOfPolys() + input->GetNumberOfStrips() == 0)
  {
    throw std::runtime_error("the model has no faces");
  }
  double slider = vtkRoundnessTargets::SliderOf(this->Style->GetRoundness());
  if (!this->SourceFileName && IsRounded(input))
  {
    slider = 0.0;
    this->Note("the model is rounded already: the file shows it as it looks, with the slider at 0, "
               "and the slider rounds it further. For a slider that starts at the original, write "
               "the model that it was made from");
  }
  const vtkRoundnessTargets::Targets targets =
    vtkRoundnessTargets::Make(input, this->Style, options);
  for (const std::string& warning : targets.Warnings)
  {
    vtkWarningMacro(<< warning);
  }
  vtkWholeFile::Naming(this->SourceFileName ? this->SourceFileName : this->FileName,
    [&]
    {
      if (!this->SourceFileName)
      {
        scene = vtkGLTFScene::FromSurface(document, targets.Model);
      }
      vtkGLTFTargets::Add(document, scene, targets, slider);
    });
  vtkWholeFile::Naming(this->FileName, [&] { document.Write(this->FileName); });
  this->NumberOfTargets = static_cast<int>(targets.All.size());
  this->LargestError = targets.Error;
  this->LargestJump = targets.Jump;
  this->Linear = targets.Linear;
}

/// To those who listen to warnings, else to the output window as plain text: nothing is wrong.
void vtkStyleGLTFWriter::Note(const char* text)
{
  if (this->HasObserver(vtkCommand::WarningEvent))
  {
    this->InvokeEvent(vtkCommand::WarningEvent, const_cast<char*>(text));
  }
  else
  {
    vtkOutputWindowDisplayText((std::string(this->FileName) + ": " + text + "\n").c_str());
  }
}

void vtkStyleGLTFWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "SourceFileName: " << (this->SourceFileName ? this->SourceFileName : "(none)")
     << "\n";
  os << indent << "MaximumRoundness: " << this->MaximumRoundness << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfTargets: " << this->MaximumNumberOfTargets << "\n";
  os << indent << "NumberOfTargets: " << this->NumberOfTargets << "\n";
  os << indent << "LargestError: " << this->LargestError << "\n";
  os << indent << "LargestJump: " << this->LargestJump << "\n";
  os << indent << "Linear: " << (this->Linear ? "yes" : "no") << "\n";
  os << indent << "Style:\n";
  this->Style->PrintSelf(os, indent.GetNextIndent());
}
