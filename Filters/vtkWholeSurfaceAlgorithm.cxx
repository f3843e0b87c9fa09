// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWholeSurfaceAlgorithm.h"

#include "vtkDistributedSurface.h"
#include "vtkFilterSupport.h"
#include "vtkSurfaceMeshConversion.h"
#include "vtkSurfaceRegion.h"

#include "vtkCallbackCommand.h"
#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataSet.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

using namespace vtkFilterSupport;

vtkCxxSetObjectMacro(vtkWholeSurfaceAlgorithm, Controller, vtkMultiProcessController);

namespace
{
/// What a port has, on some process; the greatest counts.
enum Contents
{
  NOTHING_TO_GATHER,
  SELECTION,
  POINTS_ELSEWHERE, // on another process than the first
  COMPOSITE
};

/// What became of the whole.
enum Outcomes
{
  FAILED,
  GIVE_BACK,
  STAYS // on the first process
};

/// A port's data as a surface, without cells if it is another point set; empty if there is none.
vtkSmartPointer<vtkPolyData> Surface(vtkInformationVector* port)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  vtkDataObject* data = vtkDataObject::GetData(port, 0);
  if (auto* own = vtkPolyData::SafeDownCast(data))
  {
    surface->ShallowCopy(own);
  }
  else if (auto* points = vtkPointSet::SafeDownCast(data))
  {
    surface->SetPoints(points->GetPoints());
    surface->GetPointData()->ShallowCopy(points->GetPointData());
  }
  return surface;
}

/// The nodes for one process; those of others with nothing in them, so that an expression still
/// finds them.
vtkSmartPointer<vtkSelection> SelectionOf(vtkSelection* selection, int process)
{
  auto own = vtkSmartPointer<vtkSelection>::New();
  own->DeepCopy(selection);
  for (unsigned int i = 0; i < own->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = own->GetNode(i);
    vtkInformation* properties = node->GetProperties();
    const int of = properties->Has(vtkSelectionNode::PROCESS_ID())
      ? properties->Get(vtkSelectionNode::PROCESS_ID())
      : -1;
    if (of >= 0 && of != process)
    {
      node->SetSelectionList(vtkSmartPointer<vtkIdTypeArray>::New());
    }
    properties->Remove(vtkSelectionNode::PROCESS_ID());
  }
  return own;
}

/// The marked points of the whole as a selection, and the marks taken away.
vtkSmartPointer<vtkSelection> TakeMarks(vtkPolyData* whole)
{
  vtkNew<vtkIdTypeArray> ids;
  vtkDataArray* marks = whole->GetPointData()->GetArray(vtkDistributedSurface::MarksName);
  for (vtkIdType i = 0; marks && i < marks->GetNumberOfTuples(); ++i)
  {
    if (marks->GetComponent(i, 0) != 0.0)
    {
      ids->InsertNextValue(i);
    }
  }
  whole->GetPointData()->RemoveArray(vtkDistributedSurface::MarksName);
  vtkNew<vtkSelectionNode> node;
  node->SetFieldType(vtkSelectionNode::POINT);
  node->SetContentType(vtkSelectionNode::INDICES);
  node->SetSelectionList(ids);
  auto selection = vtkSmartPointer<vtkSelection>::New();
  selection->AddNode(node);
  return selection;
}

bool SameSize(vtkPolyData* a, vtkPolyData* b)
{
  return a->GetNumberOfPoints() == b->GetNumberOfPoints() &&
    a->GetNumberOfCells() == b->GetNumberOfCells();
}

/// The data at all ports, for as long as an execution needs it: whoever watches its progress may
/// take inputs away.
std::vector<vtkSmartPointer<vtkDataObject>> Held(vtkInformationVector** inputs, int ports)
{
  std::vector<vtkSmartPointer<vtkDataObject>> held;
  for (int p = 0; p < ports; ++p)
  {
    for (int k = 0; k < inputs[p]->GetNumberOfInformationObjects(); ++k)
    {
      held.emplace_back(vtkDataObject::GetData(inputs[p], k));
    }
  }
  return held;
}

/// Input vectors with other data in them.
class Inputs
{
public:
  Inputs(vtkInformationVector** original, int ports)
  {
    for (int p = 0; p < ports; ++p)
    {
      this->Owned.push_back(vtkSmartPointer<vtkInformationVector>::New());
      this->Owned.back()->Copy(original[p], 1);
      this->Vectors.push_back(this->Owned.back());
    }
  }
  void Set(int port, vtkDataObject* data)
  {
    if (this->Vectors[port]->GetNumberOfInformationObjects() == 0)
    {
      this->Vectors[port]->SetNumberOfInformationObjects(1);
    }
    this->Vectors[port]->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), data);
  }
  vtkInformationVector** Get() { return this->Vectors.data(); }

private:
  std::vector<vtkSmartPointer<vtkInformationVector>> Owned;
  std::vector<vtkInformationVector*> Vectors;
};
}

//------------------------------------------------------------------------------------------------
struct vtkWholeSurfaceAlgorithm::Internals
{
  std::vector<int> Contents; // by port, agreed on
  bool Gathers = false;      // whether this execution does

  int Depth = 0; // of executions: one of composite data has one per block in it

  /// The pipeline tells the start and the end of each execution.
  static void NoteDepth(vtkObject* caller, unsigned long event, void*, void*);
  /// Once per execution, before the first block: all processes come here, whatever they have.
  void Agree(vtkWholeSurfaceAlgorithm* self);

  /// What goes to the first process. @throw std::invalid_argument
  struct Parts
  {
    std::vector<vtkSmartPointer<vtkPolyData>> Surfaces; // by port; nullptr for none to gather
  };
  Parts Prepare(vtkWholeSurfaceAlgorithm* self, vtkInformationVector** inputs) const;
  /// Prepare on all processes. @return whether none has failed
  bool PrepareAll(
    vtkWholeSurfaceAlgorithm* self, vtkInformationVector** inputs, Parts& parts) const;
  /// Puts the wholes, and the marks as a selection, in the place of the parts. @return the model
  vtkSmartPointer<vtkPolyData> Assemble(
    const Parts& parts, std::vector<vtkDistributedSurface>& surfaces, Inputs& inputs) const;
};

void vtkWholeSurfaceAlgorithm::Internals::NoteDepth(
  vtkObject* caller, unsigned long event, void*, void*)
{
  auto* self = static_cast<vtkWholeSurfaceAlgorithm*>(caller);
  int& depth = self->Internal->Depth;
  if (event == vtkCommand::EndEvent)
  {
    --depth;
  }
  else if (depth++ == 0)
  {
    self->Internal->Agree(self);
  }
}

void vtkWholeSurfaceAlgorithm::Internals::Agree(vtkWholeSurfaceAlgorithm* self)
{
  this->Gathers = false;
  vtkMultiProcessController* controller = self->Controller;
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return;
  }
  const int ports = self->GetNumberOfInputPorts();
  std::vector<int> own(ports, NOTHING_TO_GATHER);
  for (int p = 0; p < ports; ++p)
  {
    vtkDataObject* data =
      self->GetNumberOfInputConnections(p) > 0 ? self->GetInputDataObject(p, 0) : nullptr;
    auto* points = vtkPointSet::SafeDownCast(data);
    if (vtkCompositeDataSet::SafeDownCast(data))
    {
      own[p] = COMPOSITE;
    }
    else if (vtkSelection::SafeDownCast(data))
    {
      own[p] = SELECTION;
    }
    else if (points && points->GetNumberOfPoints() > 0 && controller->GetLocalProcessId() > 0)
    {
      own[p] = POINTS_ELSEWHERE;
    }
  }
  this->Contents.resize(ports);
  controller->AllReduce(own.data(), this->Contents.data(), ports, vtkCommunicator::MAX_OP);
  const auto has = [this](int what)
  { return std::count(this->Contents.begin(), this->Contents.end(), what) > 0; };
  this->Gathers = has(POINTS_ELSEWHERE) && !has(COMPOSITE);
}

vtkWholeSurfaceAlgorithm::Internals::Parts vtkWholeSurfaceAlgorithm::Internals::Prepare(
  vtkWholeSurfaceAlgorithm* self, vtkInformationVector** inputs) const
{
  Parts parts;
  for (std::size_t p = 0; p < this->Contents.size(); ++p)
  {
    // The model always, so that the first process gives the others theirs back.
    const bool gathered = p == 0 || this->Contents[p] == POINTS_ELSEWHERE;
    parts.Surfaces.push_back(gathered ? Surface(inputs[p]) : nullptr);
    if (gathered)
    {
      vtkSurfaceMeshConversion::CheckPiece(parts.Surfaces[p]);
    }
  }
  vtkPolyData* model = parts.Surfaces[0];
  for (std::size_t p = 0; p < this->Contents.size(); ++p)
  {
    vtkSelection* selection = vtkSelection::GetData(inputs[p], 0);
    if (this->Contents[p] == SELECTION && model->GetNumberOfPoints() > 0)
    {
      std::vector<char> selected(model->GetNumberOfPoints(), 0);
      if (selection)
      {
        selected = vtkSurfaceRegion::SelectedPoints(
          self, model, SelectionOf(selection, self->Controller->GetLocalProcessId()));
      }
      vtkNew<vtkCharArray> marks;
      marks->SetName(vtkDistributedSurface::MarksName);
      marks->SetNumberOfTuples(model->GetNumberOfPoints());
      std::copy(selected.begin(), selected.end(), marks->GetPointer(0));
      model->GetPointData()->AddArray(marks);
    }
  }
  return parts;
}

bool vtkWholeSurfaceAlgorithm::Internals::PrepareAll(
  vtkWholeSurfaceAlgorithm* self, vtkInformationVector** inputs, Parts& parts) const
{
  int good = IsSurface(self, inputs[0]);
  try
  {
    parts = this->Prepare(self, inputs);
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(
      self, << "process " << self->Controller->GetLocalProcessId() << ": " << error.what());
    good = 0;
  }
  int all = 0;
  self->Controller->AllReduce(&good, &all, 1, vtkCommunicator::MIN_OP);
  return all != 0;
}

vtkSmartPointer<vtkPolyData> vtkWholeSurfaceAlgorithm::Internals::Assemble(
  const Parts& parts, std::vector<vtkDistributedSurface>& surfaces, Inputs& inputs) const
{
  vtkSmartPointer<vtkPolyData> model;
  for (std::size_t p = 0; p < surfaces.size(); ++p)
  {
    const int port = static_cast<int>(p);
    if (parts.Surfaces[p])
    {
      const vtkSmartPointer<vtkPolyData> whole = surfaces[p].Assemble();
      inputs.Set(port, whole);
      model = p == 0 ? whole : model;
    }
    else if (this->Contents[p] == SELECTION)
    {
      inputs.Set(port, TakeMarks(model));
    }
  }
  return model;
}

//------------------------------------------------------------------------------------------------
vtkWholeSurfaceAlgorithm::vtkWholeSurfaceAlgorithm()
  : Internal(std::make_unique<Internals>())
{
  this->vtkWholeSurfaceAlgorithm::SetController(vtkMultiProcessController::GetGlobalController());
  NoteBlocks(this);
  vtkNew<vtkCallbackCommand> note;
  note->SetCallback(Internals::NoteDepth);
  this->AddObserver(vtkCommand::StartEvent, note);
  this->AddObserver(vtkCommand::EndEvent, note);
}

vtkWholeSurfaceAlgorithm::~vtkWholeSurfaceAlgorithm()
{
  this->vtkWholeSurfaceAlgorithm::SetController(nullptr);
}

int vtkWholeSurfaceAlgorithm::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto held = Held(inputVector, this->GetNumberOfInputPorts());
  if (!this->Internal->Gathers)
  {
    return this->RequestWholeData(request, inputVector, outputVector);
  }
  Internals::Parts parts;
  if (!this->Internal->PrepareAll(this, inputVector, parts))
  {
    return 0;
  }
  this->SetProgressText("Gathering");
  std::vector<vtkDistributedSurface> surfaces(
    parts.Surfaces.size(), vtkDistributedSurface(this->Controller));
  for (std::size_t p = 0; p < surfaces.size(); ++p)
  {
    if (parts.Surfaces[p])
    {
      surfaces[p].Gather(parts.Surfaces[p]);
    }
  }

  vtkSmartPointer<vtkPolyData> whole;
  int outcome = FAILED;
  try
  {
    Inputs inputs(inputVector, this->GetNumberOfInputPorts());
    whole = this->Internal->Assemble(parts, surfaces, inputs);
    if (this->RequestWholeData(request, inputs.Get(), outputVector))
    {
      outcome = SameSize(vtkPolyData::GetData(outputVector, 0), whole) ? GIVE_BACK : STAYS;
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< "gathering the surface: " << error.what());
  }
  this->Controller->Broadcast(&outcome, 1, 0);
  if (outcome == GIVE_BACK)
  {
    parts.Surfaces[0]->GetPointData()->RemoveArray(vtkDistributedSurface::MarksName);
    vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
    vtkNew<vtkPolyData> result;
    result->ShallowCopy(output);
    surfaces[0].GiveBack(whole, result, parts.Surfaces[0], output);
    if (this->Controller->GetLocalProcessId() == 0)
    {
      output->SetFieldData(result->GetFieldData()); // facts of the whole
    }
  }
  return outcome != FAILED;
}

void vtkWholeSurfaceAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: ";
  if (this->Controller)
  {
    os << this->Controller->GetClassName() << "\n";
  }
  else
  {
    os << "(none)\n";
  }
}
