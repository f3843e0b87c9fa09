// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWholeSurfaceAlgorithm.h"

#include "vtkDistributedSurface.h"
#include "vtkFilterSupport.h"
#include "vtkProcesses.h"
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
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace vtkFilterSupport;

vtkCxxSetObjectMacro(vtkWholeSurfaceAlgorithm, Controller, vtkMultiProcessController);

namespace
{
using Pieces = std::vector<vtkSmartPointer<vtkPolyData>>;

/// What a port has, on some process; the greatest counts.
enum Contents
{
  NOTHING_TO_GATHER,
  SELECTED_CELLS,
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

/// Whether a surface can only be in parts because somebody downstream asks for pieces.
bool IsOneProcess()
{
  vtkMultiProcessController* all = vtkMultiProcessController::GetGlobalController();
  return !all || all->GetNumberOfProcesses() == 1;
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

/// @return the inputs with surfaces that have no empty arrays, or nullptr where they have none
/// @throw std::bad_alloc
std::unique_ptr<Inputs> WithoutEmptyArrays(vtkInformationVector** original, int ports)
{
  std::unique_ptr<Inputs> inputs;
  for (int p = 0; p < ports; ++p)
  {
    auto* surface = vtkPolyData::SafeDownCast(vtkDataObject::GetData(original[p], 0));
    if (!surface)
    {
      continue;
    }
    const auto without = vtkSurfaceMeshConversion::WithoutEmptyArrays(surface);
    if (without != surface)
    {
      if (!inputs)
      {
        inputs = std::make_unique<Inputs>(original, ports);
      }
      inputs->Set(p, without);
    }
  }
  return inputs;
}

/// WithoutEmptyArrays; where memory ends they stay, and will be refused.
std::unique_ptr<Inputs> Needed(vtkAlgorithm* self, vtkInformationVector** original, int ports)
{
  try
  {
    return WithoutEmptyArrays(original, ports);
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(self, << "leaving out empty arrays: " << error.what());
    return nullptr;
  }
}

/// A surface that is large for one process is told when it is gathered. To be called by all.
void TellSize(vtkAlgorithm* self, vtkMultiProcessController* controller, vtkPolyData* piece)
{
  constexpr double ManyPoints = 1e6; // below that any machine has the memory
  constexpr double KilobytesOfMegabyte = 1024.0;
  const double own[] = { static_cast<double>(piece->GetNumberOfPoints()),
    static_cast<double>(piece->GetNumberOfCells()),
    static_cast<double>(piece->GetActualMemorySize()) };
  double all[] = { 0.0, 0.0, 0.0 };
  controller->Reduce(own, all, 3, vtkCommunicator::SUM_OP, 0);
  if (controller->GetLocalProcessId() == 0 && all[0] >= ManyPoints)
  {
    std::ostringstream text;
    text << "the surface is gathered on the first process, since this needs all of it: "
         << std::llround(all[0]) << " points and " << std::llround(all[1]) << " cells, "
         << std::llround(all[2] / KilobytesOfMegabyte)
         << " MB, and several times as much to work with";
    Warn(self, text.str());
  }
}

/// Puts the wholes, and the marks as a selection, in the place of the parts. @return the model
vtkSmartPointer<vtkPolyData> Assemble(const std::vector<int>& contents, const Pieces& pieces,
  std::vector<vtkDistributedSurface>& surfaces, Inputs& inputs)
{
  vtkSmartPointer<vtkPolyData> model;
  for (std::size_t p = 0; p < surfaces.size(); ++p)
  {
    const int port = static_cast<int>(p);
    if (pieces[p])
    {
      const vtkSmartPointer<vtkPolyData> whole = surfaces[p].Assemble();
      inputs.Set(port, whole);
      model = p == 0 ? whole : model;
    }
    else if (contents[p] == SELECTED_CELLS)
    {
      inputs.Set(port, TakeMarks(model));
    }
  }
  return model;
}
}

struct vtkWholeSurfaceAlgorithm::Internals
{
  std::vector<int> Contents; // by port, agreed on
  bool Gathers = false;      // whether this execution does

  int Depth = 0; // of executions: one of composite data has one per block in it
};

//------------------------------------------------------------------------------------------------
void vtkWholeSurfaceAlgorithm::NoteDepth(vtkObject* caller, unsigned long event, void*, void*)
{
  auto* self = static_cast<vtkWholeSurfaceAlgorithm*>(caller);
  int& depth = self->Internal->Depth;
  if (event == vtkCommand::EndEvent)
  {
    --depth;
  }
  else if (depth++ == 0)
  {
    self->Agree();
  }
}

void vtkWholeSurfaceAlgorithm::Agree()
{
  Internals& agreed = *this->Internal;
  agreed.Gathers = false;
  vtkMultiProcessController* controller = this->Controller;
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return;
  }
  const int ports = this->GetNumberOfInputPorts();
  std::vector<int> own(ports, NOTHING_TO_GATHER);
  for (int p = 0; p < ports; ++p)
  {
    vtkDataObject* data =
      this->GetNumberOfInputConnections(p) > 0 ? this->GetInputDataObject(p, 0) : nullptr;
    auto* points = vtkPointSet::SafeDownCast(data);
    if (vtkCompositeDataSet::SafeDownCast(data))
    {
      own[p] = COMPOSITE;
    }
    else if (vtkSelection::SafeDownCast(data))
    {
      own[p] = SELECTED_CELLS;
    }
    else if (points && points->GetNumberOfPoints() > 0 && controller->GetLocalProcessId() > 0)
    {
      own[p] = POINTS_ELSEWHERE;
    }
  }
  agreed.Contents.resize(ports);
  controller->AllReduce(own.data(), agreed.Contents.data(), ports, vtkCommunicator::MAX_OP);
  const auto has = [&agreed](int what)
  { return std::count(agreed.Contents.begin(), agreed.Contents.end(), what) > 0; };
  agreed.Gathers = has(POINTS_ELSEWHERE) && !has(COMPOSITE);
}

std::vector<vtkSmartPointer<vtkPolyData>> vtkWholeSurfaceAlgorithm::Prepare(
  vtkInformationVector** inputs)
{
  const std::vector<int>& contents = this->Internal->Contents;
  Pieces pieces;
  for (std::size_t p = 0; p < contents.size(); ++p)
  {
    // The model always, so that the first process gives the others theirs back.
    const bool gathered = p == 0 || contents[p] == POINTS_ELSEWHERE;
    pieces.push_back(gathered ? Surface(inputs[p]) : nullptr);
    if (gathered)
    {
      vtkSurfaceMeshConversion::CheckPiece(pieces[p]);
    }
  }
  vtkPolyData* model = pieces[0];
  for (std::size_t p = 0; p < contents.size(); ++p)
  {
    vtkSelection* selection = vtkSelection::GetData(inputs[p], 0);
    if (contents[p] == SELECTED_CELLS && model->GetNumberOfPoints() > 0)
    {
      std::vector<char> selected(model->GetNumberOfPoints(), 0);
      if (selection)
      {
        selected = vtkSurfaceRegion::SelectedPoints(
          this, model, SelectionOf(selection, this->Controller->GetLocalProcessId()));
      }
      vtkNew<vtkCharArray> marks;
      marks->SetName(vtkDistributedSurface::MarksName);
      marks->SetNumberOfTuples(model->GetNumberOfPoints());
      std::copy(selected.begin(), selected.end(), marks->GetPointer(0));
      model->GetPointData()->AddArray(marks);
    }
  }
  return pieces;
}

bool vtkWholeSurfaceAlgorithm::PrepareAll(
  vtkInformationVector** inputs, std::vector<vtkSmartPointer<vtkPolyData>>& pieces)
{
  int good = IsSurface(this, inputs[0]);
  try
  {
    pieces = this->Prepare(inputs);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< "process " << this->Controller->GetLocalProcessId() << ": " << error.what());
    good = 0;
  }
  int all = 0;
  this->Controller->AllReduce(&good, &all, 1, vtkCommunicator::MIN_OP);
  return all != 0;
}

//------------------------------------------------------------------------------------------------
vtkWholeSurfaceAlgorithm::vtkWholeSurfaceAlgorithm()
  : Internal(std::make_unique<Internals>())
{
  this->vtkWholeSurfaceAlgorithm::SetController(vtkMultiProcessController::GetGlobalController());
  NoteBlocks(this);
  vtkNew<vtkCallbackCommand> note;
  note->SetCallback(vtkWholeSurfaceAlgorithm::NoteDepth);
  this->AddObserver(vtkCommand::StartEvent, note);
  this->AddObserver(vtkCommand::EndEvent, note);
}

vtkWholeSurfaceAlgorithm::~vtkWholeSurfaceAlgorithm()
{
  this->vtkWholeSurfaceAlgorithm::SetController(nullptr);
}

bool vtkWholeSurfaceAlgorithm::IsSpread() const
{
  return this->Internal->Gathers;
}

int vtkWholeSurfaceAlgorithm::RequestPart(vtkInformationVector**, vtkInformationVector*)
{
  return WHOLE_IS_NEEDED;
}

int vtkWholeSurfaceAlgorithm::RunOnParts(vtkInformationVector** inputs,
  vtkInformationVector* outputs, const vtkProcesses& processes,
  const std::function<void()>& execute)
{
  vtkPolyData* model = vtkPolyData::GetData(inputs[0], 0);
  if (!model->GetPoints())
  {
    model->SetPoints(vtkNew<vtkPoints>());
  }
  return this->RunTogether(model->GetNumberOfPoints() > 0, outputs, processes, execute);
}

int vtkWholeSurfaceAlgorithm::RunTogether(bool hasPoints, vtkInformationVector* outputs,
  const vtkProcesses& processes, const std::function<void()>& execute)
{
  std::string failure;
  try
  {
    if (processes.Run(execute, hasPoints, failure))
    {
      return PART_DONE;
    }
  }
  catch (const SphericalStyle::WholeSurfaceNeeded&)
  {
    return WHOLE_IS_NEEDED;
  }
  ReportFailure(this, outputs, failure.c_str());
  return PART_FAILED;
}

int vtkWholeSurfaceAlgorithm::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int done = this->Superclass::RequestUpdateExtent(request, inputs, outputs);
  for (int p = 0; IsOneProcess() && p < this->GetNumberOfInputPorts(); ++p)
  {
    for (int k = 0; k < inputs[p]->GetNumberOfInformationObjects(); ++k)
    {
      vtkInformation* input = inputs[p]->GetInformationObject(k);
      input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
      input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
      input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
  return done;
}

int vtkWholeSurfaceAlgorithm::RequestData(
  vtkInformation* request, vtkInformationVector** original, vtkInformationVector* outputVector)
{
  vtkInformation* wanted = outputVector->GetInformationObject(0);
  if (IsOneProcess() && wanted->Has(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) &&
    wanted->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    return 1; // the whole is in the first piece, and nothing in the others
  }
  const int ports = this->GetNumberOfInputPorts();
  const auto held = Held(original, ports);
  const std::unique_ptr<Inputs> without = Needed(this, original, ports);
  vtkInformationVector** inputVector = without ? without->Get() : original;
  if (!this->Internal->Gathers)
  {
    return this->RequestWholeData(request, inputVector, outputVector);
  }
  Pieces pieces;
  if (!this->PrepareAll(inputVector, pieces))
  {
    return 0;
  }
  Inputs parts(inputVector, this->GetNumberOfInputPorts());
  parts.Set(0, pieces[0]);
  const int done = this->RequestPart(parts.Get(), outputVector);
  if (done != WHOLE_IS_NEEDED)
  {
    return done == PART_DONE;
  }
  this->SetProgressText("Gathering");
  TellSize(this, this->Controller, pieces[0]);
  std::vector<vtkDistributedSurface> surfaces(
    pieces.size(), vtkDistributedSurface(this->Controller));
  for (std::size_t p = 0; p < surfaces.size(); ++p)
  {
    if (pieces[p])
    {
      surfaces[p].Gather(pieces[p]);
    }
  }

  vtkSmartPointer<vtkPolyData> whole;
  int outcome = FAILED;
  try
  {
    Inputs inputs(inputVector, ports);
    whole = Assemble(this->Internal->Contents, pieces, surfaces, inputs);
    if (this->RequestWholeData(request, inputs.Get(), outputVector))
    {
      outcome = SameSize(vtkPolyData::GetData(outputVector, 0), whole) ? GIVE_BACK : STAYS;
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< "gathering the surface: " << WordsOf(error));
  }
  this->Controller->Broadcast(&outcome, 1, 0);
  if (outcome == GIVE_BACK)
  {
    pieces[0]->GetPointData()->RemoveArray(vtkDistributedSurface::MarksName);
    vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
    vtkNew<vtkPolyData> result;
    result->ShallowCopy(output);
    surfaces[0].GiveBack(whole, result, pieces[0], output);
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
