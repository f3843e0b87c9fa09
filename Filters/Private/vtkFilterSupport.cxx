// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFilterSupport.h"

#include "Parallel.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkVersion.h"

#include <cmath>
#include <cstdlib>
#include <new>
#include <sstream>
#include <stdexcept>

namespace
{
/// In the filter's own information: the composite data that it runs over.
vtkInformationObjectBaseKey* Composite()
{
  static auto* key = vtkInformationObjectBaseKey::MakeKey("COMPOSITE", "SphericalStyle");
  return key;
}

/// The pipeline runs a filter once for each block, with the block in place of the composite data.
/// Only when the whole run starts and ends the data itself is there.
void NoteComposite(vtkObject* caller, unsigned long event, void*, void*)
{
  auto* self = static_cast<vtkAlgorithm*>(caller);
  if (self->GetNumberOfInputConnections(0) == 0)
  {
    return;
  }
  vtkDataObject* data = self->GetInputDataObject(0, 0);
  if (vtkCompositeDataSet::SafeDownCast(data))
  {
    self->GetInformation()->Set(Composite(), event == vtkCommand::StartEvent ? data : nullptr);
  }
}

vtkDataObjectTree* Tree(vtkAlgorithm* self)
{
  return vtkDataObjectTree::SafeDownCast(self->GetInformation()->Get(Composite()));
}

/// Names from the top of the tree to the leaf; empty if it is not there.
std::string PathOf(vtkDataObjectTree* top, vtkDataObject* leaf)
{
  std::vector<std::pair<vtkDataObjectTree*, std::string>> trees = { { top, "" } };
  for (std::size_t k = 0; k < trees.size(); ++k)
  {
    const auto [tree, above] = trees[k];
    const auto children = vtkSmartPointer<vtkDataObjectTreeIterator>::Take(tree->NewTreeIterator());
    children->TraverseSubTreeOff();
    children->VisitOnlyLeavesOff();
    children->SkipEmptyNodesOff();
    int number = 0;
    for (children->InitTraversal(); !children->IsDoneWithTraversal(); children->GoToNextItem())
    {
      const char* name = children->HasCurrentMetaData()
        ? children->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME())
        : nullptr;
      std::string path = above;
      path += name && *name ? name : std::to_string(number);
      vtkDataObject* child = children->GetCurrentDataObject();
      if (child && child == leaf)
      {
        return path;
      }
      if (auto* subtree = vtkDataObjectTree::SafeDownCast(child))
      {
        path += "/";
        trees.emplace_back(subtree, path);
      }
      ++number;
    }
  }
  return {};
}
}

namespace vtkFilterSupport
{
void NoteBlocks(vtkAlgorithm* self)
{
  vtkNew<vtkCallbackCommand> note;
  note->SetCallback(NoteComposite);
  self->AddObserver(vtkCommand::StartEvent, note);
  self->AddObserver(vtkCommand::EndEvent, note);
}

std::string InBlock(vtkAlgorithm* self)
{
  vtkDataObjectTree* tree = Tree(self);
  const std::string path = tree ? PathOf(tree, self->GetInputDataObject(0, 0)) : "";
  return path.empty() ? "" : "block \"" + path + "\": ";
}

void Warn(vtkAlgorithm* self, const std::string& text)
{
  if (!text.empty())
  {
    vtkWarningWithObjectMacro(self, << InBlock(self) << text);
  }
}

vtkSmartPointer<vtkDataObject> InTree(vtkAlgorithm* self, vtkDataObject* surface)
{
  vtkDataObjectTree* tree = Tree(self);
  if (!tree)
  {
    return surface;
  }
  const auto alone = vtkSmartPointer<vtkDataObjectTree>::Take(tree->NewInstance());
  alone->CopyStructure(tree);
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(tree->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    if (leaves->GetCurrentDataObject() == self->GetInputDataObject(0, 0))
    {
      alone->SetDataSet(leaves, surface);
    }
  }
  return alone;
}

void TakeDataSet(vtkInformation* port)
{
  port->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
}

void ReportFailure(vtkAlgorithm* self, vtkInformationVector* outputs, const char* what)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    if (vtkDataObject* data = vtkDataObject::GetData(outputs, port))
    {
      data->Initialize();
    }
  }
  if (!*what)
  {
    return;
  }
  try
  {
    vtkErrorWithObjectMacro(self, << InBlock(self) << what);
  }
  catch (const std::bad_alloc&) // no memory for words: the pipeline says that the filter failed
  {
  }
}

const char* WordsOf(const std::exception& error)
{
  return dynamic_cast<const std::bad_alloc*>(&error) ? "not enough memory" : error.what();
}

std::string PlainMessage(const char* text)
{
  std::string message = text ? text : "";
  const std::size_t address = message.find("): ");
  message = address == std::string::npos ? message : message.substr(address + 3);
  while (!message.empty() && message.back() == '\n')
  {
    message.pop_back();
  }
  return message;
}

int RunGuarded(vtkAlgorithm* self, vtkInformationVector* outputs,
  const std::function<int()>& execute, const std::function<void()>& forget)
{
  try
  {
    try
    {
      return execute();
    }
    catch (const std::invalid_argument&)
    {
      throw;
    }
    catch (...)
    {
      if (forget)
      {
        forget();
      }
      throw;
    }
  }
  catch (const std::exception& error)
  {
    ReportFailure(self, outputs, WordsOf(error));
  }
  catch (...)
  {
    ReportFailure(self, outputs, "a failure without a message");
  }
  return 0;
}

bool IsSurface(vtkAlgorithm* self, vtkInformationVector* port)
{
  vtkDataObject* data = vtkDataObject::GetData(port, 0);
  if (!data || vtkPolyData::SafeDownCast(data))
  {
    return true;
  }
  vtkErrorWithObjectMacro(
    self, << InBlock(self) << "the input is a " << data->GetClassName()
          << " and not a surface (vtkPolyData); make one of it with Extract Surface "
             "in ParaView, vtkDataSetSurfaceFilter in VTK");
  return false;
}

void Require(bool good, const char* name, const char* must, double value)
{
  if (!good)
  {
    std::ostringstream message;
    message << name << " must be " << must << "; it is " << value;
    throw std::invalid_argument(message.str());
  }
}

void RequireSphere(const double* center, const double* radius)
{
  if (radius)
  {
    Require(std::isfinite(*radius) && *radius > 0.0, "Radius", "finite and above 0", *radius);
  }
  for (int k = 0; center && k < 3; ++k)
  {
    Require(std::isfinite(center[k]), "Center", "finite", center[k]);
  }
}

void RequireTarget(double roundness, const double* center, const double* radius)
{
  Require(
    std::isfinite(roundness) && roundness >= 0.0, "Roundness", "finite and 0 or more", roundness);
  RequireSphere(center, radius);
}

void AddCount(vtkFieldData* data, const char* name, int count)
{
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  array->InsertNextValue(count);
  data->AddArray(array);
}

void AddColumn(vtkTable* table, vtkAbstractArray* column, const char* name)
{
  column->SetName(name);
  table->AddColumn(column);
}

void AddStageSeconds(vtkFieldData* data, const std::vector<std::pair<const char*, double>>& stages)
{
  vtkNew<vtkDoubleArray> seconds;
  seconds->SetName("StageSeconds");
  seconds->SetNumberOfComponents(static_cast<int>(stages.size()));
  seconds->SetNumberOfTuples(1);
  for (std::size_t k = 0; k < stages.size(); ++k)
  {
    seconds->SetComponentName(static_cast<vtkIdType>(k), stages[k].first);
    seconds->SetComponent(0, static_cast<int>(k), stages[k].second);
  }
  data->AddArray(seconds);
}

int ThreadsToUse(int wanted)
{
  if (wanted > 0)
  {
    return wanted;
  }
  // What was asked for, whatever the backend makes of it: the one that Debian's has is sequential.
  const int ofProgram =
    vtkSMPTools::Config(vtk::detail::smp::vtkSMPToolsAPI::GetInstance()).MaxNumberOfThreads;
  if (ofProgram > 0)
  {
    return ofProgram;
  }
  const char* limit = std::getenv("VTK_SMP_MAX_THREADS");
  const int ofEnvironment = limit ? std::atoi(limit) : 0;
  return ofEnvironment > 0 ? ofEnvironment : SphericalStyle::ThreadsOfThisProcess();
}

bool Aborted(vtkAlgorithm* self)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823) // the first with CheckAbort
  return self->CheckAbort();
#else
  return self->GetAbortExecute() != 0;
#endif
}

std::string Count(vtkIdType n, const char* noun)
{
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

const char* OnOff(bool on)
{
  return on ? "On" : "Off";
}

std::string Triple(const double* x)
{
  std::ostringstream text;
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
  return text.str();
}

std::array<PlateAxis, 3> PlateAxes(int upAxis)
{
  std::array<PlateAxis, 3> axes{ { { 0, 1.0 }, { 1, 1.0 }, { 2, 1.0 } } };
  if (upAxis != 2)
  {
    std::swap(axes[upAxis], axes[2]);
    axes[upAxis].Sign = -1.0;
  }
  return axes;
}
}
