// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The fuzz target of the filters: bytes choose a filter, its properties and its inputs. Whatever
/// they are: the output is finite and has the input's points and cells, or there is one error and
/// no output; the input is unchanged; and a filter that has run before gives what a new one gives.
/// Built for libFuzzer, and with Replay.cxx for everybody else.
#include "FuzzTesting.h"
#include "GridFromBytes.h"
#include "TermFilters.h"

#include "vtkGaussMapFilter.h"
#include "vtkHandleDeformFilter.h"
#include "vtkMeshMorphingFilter.h"
#include "vtkNonlinearStyleFilter.h"
#include "vtkPartSizesFilter.h"
#include "vtkSphereProjectionFilter.h"
#include "vtkSurfaceDiagnostics.h"
#include "vtkSurfaceMetrics.h"
#include "vtkSurfacePartsFilter.h"
#include "vtkThesisStyleFilter.h"
#ifdef SPHERICALSTYLE_WITH_CGAL
#include "vtkConvexProxyDeformFilter.h"
#include "vtkPrintableFilter.h"
#endif

#include "vtkInformation.h"

using namespace FilterTesting;

namespace
{
struct Subject
{
  vtkSmartPointer<vtkAlgorithm> Filter;
  bool Deforms = true;                       ///< output 0 is the input with other points
  vtkSmartPointer<vtkDataSet> Own = nullptr; ///< what it is for, where that is no surface
};

constexpr int Enough = 8; // values of an enumeration; the setters clamp

template <typename Filter>
void SetLoop(Bytes& bytes, Filter* f)
{
  constexpr double tolerances[] = { 1e-5, 1e-14, 1e-9, 0.5, 2.0 };
  f->SetTolerance(tolerances[bytes.Below(5)]);
  f->SetStopRule(bytes.Below(Enough));
  f->SetMaximumNumberOfIterations(bytes.Below(7));
  f->SetOutputPointsPrecision(bytes.Below(Enough));
  f->SetGenerateNormals(bytes.Flag());
  f->SetNumberOfThreads(1 + bytes.Below(2));
}

template <typename Filter>
void SetSphere(Bytes& bytes, Filter* f)
{
  f->SetCenterMode(bytes.Below(Enough));
  f->SetRadiusMode(bytes.Below(Enough));
  if (bytes.Flag())
  {
    const double x = bytes.Any();
    const double y = bytes.Any();
    f->SetCenter(x, y, bytes.Any());
    f->SetRadius(bytes.Any());
  }
}

void SetArrays(Bytes& bytes, vtkAlgorithm* f, int last)
{
  for (int index = 0; index <= last; ++index)
  {
    const int kind = bytes.Below(8);
    if (kind < 3)
    {
      f->SetInputArrayToProcess(index, 0, 0, kind == 1 ? OfCells : OfPoints, ArrayName(bytes));
    }
  }
}

Subject MakeSphericalStyle(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkThesisStyleFilter>::New();
  SetLoop(bytes, f.Get());
  SetSphere(bytes, f.Get());
  constexpr double roundness[] = { 1.0, 0.0, 0.1, 5.0, 50.0 };
  f->SetRoundness(bytes.Flag() ? bytes.Any() : roundness[bytes.Below(5)]);
  f->SetNormalBlend(bytes.Share());
  f->SetDetailSize(bytes.Flag() ? 0.2 * bytes.Share() : 0.0);
  f->SetSphereOf(bytes.Below(Enough));
  f->SetBorderWidth(bytes.Share());
  f->SetCenterBlendWidth(bytes.Share());
  f->SetSphericalWeighting(bytes.Below(2));
  f->SetConcaveEdges(bytes.Below(2));
  f->SetAcceleration(bytes.Flag());
  f->SetEdgeWeighting(bytes.Below(2));
  f->SetAnchor(bytes.Below(2));
  f->SetComponentCoupling(bytes.Below(2));
  f->SetWeldCoincidentPoints(bytes.Below(4) != 1);
  f->SetInitialGuess(bytes.Below(4) % 2);
  const int size = bytes.Byte();
  f->SetKeepSize(size % 4);
  f->SetKeepOnGround(size & 4);
  f->SetUpAxis(size / 8 % 4);
  f->SetNormalRadius(size / 32 % 2);
  constexpr int refinements[] = { vtkSphericalStyleFilter::NEVER, vtkSphericalStyleFilter::ALWAYS,
    vtkSphericalStyleFilter::WHERE_COARSE, vtkSphericalStyleFilter::NEVER };
  f->SetRefineLongEdges(refinements[bytes.Below(4)]);
  f->SetMaximumEdgeLength(0.1 + bytes.Share());
  f->SetReproduceThesis(bytes.Below(8) == 1);
#ifdef SPHERICALSTYLE_WITH_CGAL
  f->SetAvoidSelfIntersections(bytes.Below(4) == 1);
#else
  bytes.Byte();
#endif
  const int arrays = bytes.Byte();
  f->SetTransformAllInputVectors(arrays & 1);
  f->SetGenerateDisplacement(arrays & 2);
  f->SetGenerateCellEnergy(arrays & 4);
  f->SetGenerateRotation(arrays & 8);
  SetArrays(bytes, f, 5);
  const int ports = bytes.Below(16);
  if (ports == 1 || ports == 2)
  {
    f->SetCentersData(SurfaceFromBytes(bytes));
  }
  if (ports == 2 || ports == 3)
  {
    f->SetSelectionData(SelectionFromBytes(bytes));
  }
  const int symmetry = bytes.Below(16);
  f->SetSymmetry(symmetry <= vtkSphericalStyleFilter::ACROSS_Z ? symmetry : 0);
  const int target = bytes.Below(32);
  if (target > 0 && target <= vtkSphericalStyleFilter::TARGET_MESH)
  {
    f->SetTarget(target);
    f->SetTargetEdges(bytes.Share());
    if (bytes.Flag())
    {
      const double x = bytes.Any();
      const double y = bytes.Any();
      f->SetTargetLengths(x, y, bytes.Any());
    }
    if (target == vtkSphericalStyleFilter::TARGET_MESH)
    {
      f->SetTargetMeshData(SurfaceFromBytes(bytes));
    }
  }
  return { f,
    f->GetRefineLongEdges() == vtkSphericalStyleFilter::NEVER || f->GetReproduceThesis() };
}

Subject MakeNonlinearStyle(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkNonlinearStyleFilter>::New();
  SetLoop(bytes, f.Get());
  constexpr double roundness[] = { 1.0, 0.0, 0.1, 5.0, 50.0 };
  f->SetRoundness(bytes.Flag() ? bytes.Any() : roundness[bytes.Below(5)]);
  f->SetCenterConstraint(bytes.Below(Enough));
  f->SetCenterMode(bytes.Below(Enough));
  if (bytes.Flag())
  {
    const double x = bytes.Any();
    const double y = bytes.Any();
    f->SetCenter(x, y, bytes.Any());
  }
  f->SetReproduceThesis(bytes.Below(8) == 1);
  const int arrays = bytes.Byte();
  f->SetGenerateCellEnergy(arrays & 1);
  f->SetGenerateRotation(arrays & 2);
  f->SetGenerateAuxiliaryScale(arrays & 4);
  SetArrays(bytes, f, 0);
  return { f };
}

template <typename Filter>
Subject MakeTermFilter(Bytes& bytes, void (Filter::*setWeight)(double))
{
  const auto f = vtkSmartPointer<Filter>::New();
  SetLoop(bytes, f.Get());
  (f->*setWeight)(bytes.Any());
  return { f };
}

/// One of the filters whose style is a term, with what they have in common.
Subject MakeTermFilter(Bytes& bytes)
{
  using Make = Subject (*)(Bytes&);
#define MAKE(Filter, setWeight)                                                                    \
  [](Bytes& from) { return MakeTermFilter<Filter>(from, &Filter::setWeight); },
  constexpr Make all[] = { SPHERICALSTYLE_TERM_FILTERS(MAKE) };
#undef MAKE
  return all[bytes.Below(std::size(all))](bytes);
}

Subject MakeNormalAnalogy(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkNormalAnalogyFilter>::New();
  SetLoop(bytes, f.Get());
  f->SetWeight(bytes.Any());
  f->SetStyle(bytes.Below(Enough));
  f->SetGenerateTargetNormal(bytes.Flag());
  if (f->GetStyle() == vtkNormalAnalogyFilter::MESH)
  {
    f->SetStyleMeshData(SurfaceFromBytes(bytes));
  }
  return { f };
}

Subject MakeSphereProjection(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkSphereProjectionFilter>::New();
  SetSphere(bytes, f.Get());
  f->SetCoefficient(bytes.Share());
  f->SetNumberOfThreads(1 + bytes.Below(2));
  f->SetOutputPointsPrecision(bytes.Below(Enough));
  f->SetGenerateNormals(bytes.Flag());
  return { f };
}

Subject MakeGaussMap(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkGaussMapFilter>::New();
  f->SetNormalSource(bytes.Below(2));
  f->SetAreaWeighted(bytes.Flag());
  f->SetOftenThreshold(bytes.Any());
  f->SetNumberOfEqualAreaUnits(bytes.Byte());
  f->SetSphereUnits(bytes.Below(2));
  SetArrays(bytes, f, 0);
  return { f, false };
}

Subject MakeMetrics(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkSurfaceMetrics>::New();
  f->SetCenterMode(bytes.Below(Enough));
  f->SetRoundness(bytes.Any());
  f->SetEstimateCondition(bytes.Below(4) == 1);
  f->SetMeasureThickness(bytes.Flag());
  f->SetWeldCoincidentPoints(bytes.Below(4) != 1);
#ifdef SPHERICALSTYLE_WITH_CGAL
  f->SetFindSelfIntersections(bytes.Below(4) == 1);
#else
  bytes.Byte();
#endif
  if (bytes.Flag())
  {
    f->SetReferenceData(SurfaceFromBytes(bytes));
  }
  return { f, false };
}

Subject MakeDiagnostics(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkSurfaceDiagnostics>::New();
  f->SetSliverAngle(bytes.Any());
  f->SetWeldCoincidentPoints(bytes.Flag());
  return { f, false };
}

Subject MakeParts(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkSurfacePartsFilter>::New();
  f->SetMethod(bytes.Below(Enough));
  f->SetNumberOfParts(bytes.Below(6));
  SetArrays(bytes, f, 0);
  return { f, false };
}

Subject MakePartSizes(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkPartSizesFilter>::New();
  SetArrays(bytes, f, 0);
  for (int row = bytes.Below(4); row > 0; --row)
  {
    const int part = bytes.Below(8);
    f->SetPartSize(part, bytes.Any());
  }
  f->SetBlendWidth(bytes.Any());
  f->SetHeadHeight(bytes.Flag() ? bytes.Any() : 0.0);
  f->SetHead(bytes.Below(8) - 1);
  f->SetKeepOnGround(bytes.Flag());
  f->SetUpAxis(bytes.Below(3));
  for (int row = bytes.Below(3); row > 0; --row)
  {
    const int part = bytes.Below(8);
    f->SetPartRoundness(part, bytes.Any());
    f->SetPartNormalBlend(part, bytes.Any());
  }
  const bool hasArray = f->GetInputArrayInformation(0)->Has(vtkDataObject::FIELD_NAME()) != 0;
  if (!hasArray && bytes.Below(8) < 7) // a search for parts takes a second
  {
    f->SetInputArrayToProcess(0, 0, 0, OfPoints, ArrayName(bytes));
  }
  return { f, true };
}

Subject MakeMeshMorphing(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkMeshMorphingFilter>::New();
  f->SetTransformAllInputVectors(bytes.Flag());
  const auto grid = GridFromBytes(bytes);
  if (bytes.Below(16) != 1)
  {
    f->SetSurfaceData(MovedFromBytes(bytes, grid));
  }
  else
  {
    f->SetSurfaceData(Surface::New());
  }
  return { f, true, grid };
}

Subject MakeHandleDeform(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkHandleDeformFilter>::New();
  SetLoop(bytes, f.Get());
  f->SetComponentCoupling(bytes.Below(2));
  SetArrays(bytes, f, 0);
  for (int count = bytes.Below(5); count > 0; --count)
  {
    // Mostly near the model: among numbers of every kind hardly a row would be good.
    const bool wild = bytes.Below(8) == 1;
    double row[10];
    for (double& number : row)
    {
      number = wild ? bytes.Any() : bytes.Small();
    }
    row[3] = wild ? row[3] : 0.1 * std::abs(row[3]);
    for (int k = 7; k < 10; ++k)
    {
      row[k] *= 20.0;
    }
    f->AddHandle(row);
  }
  return { f, true };
}

#ifdef SPHERICALSTYLE_WITH_CGAL
Subject MakePrintable(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkPrintableFilter>::New();
  f->SetFootArea(bytes.Any());
  f->SetStabilityAngle(bytes.Any());
  f->SetVolume(bytes.Below(4) == 1 ? bytes.Any() : 0.0);
  f->SetHeight(bytes.Below(4) == 1 ? bytes.Any() : 0.0);
  f->SetCloseHoles(bytes.Below(4) != 1);
  f->SetPlaceOnPlate(bytes.Flag());
  f->SetUpAxis(bytes.Below(3));
  f->SetMinimumThickness(bytes.Below(4) == 1 ? bytes.Any() : 0.0);
  return { f, false };
}

Subject MakeConvexProxy(Bytes& bytes)
{
  const auto f = vtkSmartPointer<vtkConvexProxyDeformFilter>::New();
  SetSphere(bytes, f.Get());
  f->SetProxyMesher(bytes.Below(Enough));
  f->SetHullOf(bytes.Below(2));
  f->SetNumberOfProxyPoints(4 + bytes.Below(60));
  f->SetSeed(bytes.Byte());
  f->SetRoundness(bytes.Flag() ? bytes.Any() : bytes.Share());
  f->SetSphericalWeighting(bytes.Below(2));
  f->SetProjection(bytes.Below(Enough));
  f->SetNumberOfNeighbors(bytes.Byte());
  f->SetBlendFunction(bytes.Below(Enough));
  f->SetBlend(bytes.Share());
  if (bytes.Flag())
  {
    const double x = bytes.Any();
    const double y = bytes.Any();
    f->SetBlendAxis(x, y, bytes.Any());
    const double from = bytes.Any();
    f->SetBlendRange(from, bytes.Any());
    f->SetTanhSteepness(bytes.Any());
    const double gain = bytes.Any();
    f->SetAxisGain(gain, bytes.Any(), 1.0);
  }
  f->SetBlendAtStart(bytes.Share());
  f->SetBlendAtEnd(bytes.Share());
  f->SetBorderWidth(bytes.Share());
  f->SetTransfer(bytes.Below(2));
  f->SetOutputPointsPrecision(bytes.Below(Enough));
  f->SetGenerateNormals(bytes.Flag());
  const int more = bytes.Byte();
  f->SetGenerateProjectionArrays(more & 1);
  f->SetRefineLongEdges(more / 2 % 8 == 1 ? vtkConvexProxyDeformFilter::ALWAYS
      : more / 2 % 8 == 2                 ? vtkConvexProxyDeformFilter::WHERE_COARSE
                                          : vtkConvexProxyDeformFilter::NEVER);
  SetArrays(bytes, f, 3);
  const int ports = bytes.Below(8);
  if (ports == 1 || ports == 2)
  {
    f->SetProxyData(SurfaceFromBytes(bytes));
  }
  if (ports == 2 || ports == 3)
  {
    f->SetSelectionData(SelectionFromBytes(bytes));
  }
  return { f, f->GetRefineLongEdges() == vtkConvexProxyDeformFilter::NEVER };
}
#endif

Subject SubjectFromBytes(Bytes& bytes)
{
  switch (bytes.Below(18))
  {
    case 0:
      return MakeTermFilter(bytes);
    case 1:
      return MakeNormalAnalogy(bytes);
    case 2:
      return MakeSphereProjection(bytes);
    case 3:
      return MakeGaussMap(bytes);
    case 4:
      return MakeMetrics(bytes);
    case 5:
      return MakeDiagnostics(bytes);
    case 10:
      return MakeNonlinearStyle(bytes);
    case 14:
      return MakePartSizes(bytes);
    case 15:
      return MakeParts(bytes);
    case 17:
      return MakeHandleDeform(bytes);
    case 11:
      return MakeMeshMorphing(bytes);
#ifdef SPHERICALSTYLE_WITH_CGAL
    case 6:
    case 7:
    case 8:
    case 9:
      return MakeConvexProxy(bytes);
    case 16:
      return MakePrintable(bytes);
#endif
    default:
      return MakeSphericalStyle(bytes);
  }
}

bool FinitePoints(vtkDataSet* data)
{
  bool all = true;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const double* x = data->GetPoint(i);
    all = all && std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
  }
  return all;
}

/// Types and points of the cells; the cells of images become hexahedra, so that only their number
/// counts.
bool SameCells(vtkDataSet* a, vtkDataSet* b)
{
  auto* surface = vtkPolyData::SafeDownCast(a);
  if (surface && vtkPolyData::SafeDownCast(b))
  {
    return FilterTesting::SameCells(surface, vtkPolyData::SafeDownCast(b));
  }
  bool same = a->GetNumberOfCells() == b->GetNumberOfCells();
  vtkNew<vtkIdList> ofA;
  vtkNew<vtkIdList> ofB;
  for (vtkIdType c = 0; c < a->GetNumberOfCells() && same && a->IsA(b->GetClassName()); ++c)
  {
    a->GetCellPoints(c, ofA);
    b->GetCellPoints(c, ofB);
    same = a->GetCellType(c) == b->GetCellType(c) &&
      std::equal(ofA->begin(), ofA->end(), ofB->begin(), ofB->end());
  }
  return same;
}

bool SameDataSet(vtkDataSet* a, vtkDataSet* b)
{
  if (auto* surface = vtkPolyData::SafeDownCast(a))
  {
    return SamePolyData(surface, vtkPolyData::SafeDownCast(b));
  }
  bool same = a->GetNumberOfPoints() == b->GetNumberOfPoints() && SameCells(a, b) &&
    SameActiveAttributes(a->GetPointData(), b->GetPointData()) &&
    SameActiveAttributes(a->GetCellData(), b->GetCellData());
  for (vtkIdType i = 0; i < a->GetNumberOfPoints() && same; ++i)
  {
    Vector x;
    Vector y;
    a->GetPoint(i, x.data());
    b->GetPoint(i, y.data());
    same = std::memcmp(x.data(), y.data(), sizeof(x)) == 0;
  }
  for (const int type : { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::FIELD })
  {
    vtkFieldData* ofA = a->GetAttributesAsFieldData(type);
    vtkFieldData* ofB = b->GetAttributesAsFieldData(type);
    same = same && ofA->GetNumberOfArrays() == ofB->GetNumberOfArrays() && SameArrays(ofA, ofB);
  }
  return same;
}

/// Whether the arrays that are not of the input are finite. Normals of the input that are not may
/// stay where nothing moves.
bool FiniteNewArrays(vtkFieldData* before, vtkFieldData* after)
{
  bool all = true;
  for (int i = 0; i < after->GetNumberOfArrays(); ++i)
  {
    auto* array = vtkArrayDownCast<vtkDataArray>(after->GetAbstractArray(i));
    auto* given =
      array ? vtkArrayDownCast<vtkDataArray>(before->GetAbstractArray(array->GetName())) : nullptr;
    const bool isNew = array && given != array && (!given || AllFinite(given));
    all &= !isNew || AllFinite(array);
  }
  return all;
}

/// What differs between two results, nothing if they are the same to the bit.
std::string Difference(vtkDataSet* a, vtkDataSet* b)
{
  std::string all;
  for (const auto& [x, y] :
    { std::pair<vtkFieldData*, vtkFieldData*>(a->GetPointData(), b->GetPointData()),
      std::pair<vtkFieldData*, vtkFieldData*>(a->GetCellData(), b->GetCellData()) })
  {
    for (int i = 0; i < std::min(x->GetNumberOfArrays(), y->GetNumberOfArrays()); ++i)
    {
      if (!SameArray(x->GetAbstractArray(i), y->GetAbstractArray(i)))
      {
        all += std::string(" ") + x->GetAbstractArray(i)->GetName();
      }
    }
  }
  return all.empty() && !SameDataSet(a, b) ? " points, cells, attributes or number of arrays" : all;
}

struct Messages
{
  std::vector<std::string> Errors, Warnings, OfExecutive;
};

/// What was said, without the file, the line and the address that VTK begins with.
std::string Said(const std::vector<std::string>& messages)
{
  std::string all;
  for (const std::string& message : messages)
  {
    all += message.substr(message.find("): ") + 1);
  }
  return all;
}

vtkDataSet* OutputOf(const Subject& subject)
{
  return vtkDataSet::SafeDownCast(subject.Filter->GetOutputDataObject(0));
}

/// Runs the filter and looks at what comes out of it.
Messages RunAndCheck(const Subject& subject, vtkDataSet* input)
{
  Messages messages;
  vtkAlgorithm* filter = subject.Filter;
  filter->RemoveAllObservers(); // of NoteBlocks too: blocks are no part of this
  filter->GetExecutive()->RemoveAllObservers();
  Watch(filter, vtkCommand::ErrorEvent, messages.Errors);
  Watch(filter, vtkCommand::WarningEvent, messages.Warnings);
  Watch(filter->GetExecutive(), vtkCommand::ErrorEvent, messages.OfExecutive);
  const auto before = vtkSmartPointer<vtkDataSet>::Take(input->NewInstance());
  before->DeepCopy(input);
  Others()->Errors.clear();
  filter->SetInputDataObject(0, input);
  filter->Modified(); // the input may have changed without a word
  filter->Update();
  filter->RemoveAllObservers(); // they write to what is ours
  filter->GetExecutive()->RemoveAllObservers();

  vtkDataSet* output = OutputOf(subject);
  Demand(SameDataSet(before, input), "the input is unchanged", filter);
  Demand(Others()->Errors.empty(), "no other object complains", filter, Joined(Others()->Errors));
  Demand(messages.Errors.size() < 2, "one error at most", filter, Joined(messages.Errors));
  if (!messages.Errors.empty())
  {
    Demand(output->GetNumberOfPoints() == 0 && output->GetNumberOfCells() == 0,
      "no output with an error", filter, Joined(messages.Errors));
    return messages;
  }
  Demand(messages.OfExecutive.empty(), "no failure without an error", filter);
  Demand(FinitePoints(output) || !FinitePoints(input), "points are finite", filter);
  if (subject.Deforms)
  {
    const vtkIdType n = input->GetNumberOfPoints();
    Demand(output->GetNumberOfPoints() == n, "all points", filter);
    Demand(n == 0 || SameCells(input, output), "all cells", filter);
    Demand(FiniteNewArrays(input->GetPointData(), output->GetPointData()) &&
        FiniteNewArrays(input->GetCellData(), output->GetCellData()),
      "new arrays are finite", filter);
  }
  return messages;
}
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  Others();
  Bytes bytes(data, size);
  const bool again = bytes.Flag();
  Bytes same = bytes; // for a second filter like the first
  const Subject kept = SubjectFromBytes(bytes);
  const vtkSmartPointer<vtkDataSet> input =
    kept.Own ? kept.Own : vtkSmartPointer<vtkDataSet>(SurfaceFromBytes(bytes));
  RunAndCheck(kept, input);
  auto* points = vtkPointSet::SafeDownCast(input);
  if (!again || !points || points->GetNumberOfPoints() == 0)
  {
    return 0;
  }
  const vtkIdType moved = bytes.Byte() % points->GetNumberOfPoints();
  points->GetPoints()->GetData()->SetComponent(moved, bytes.Below(3), bytes.Small());
  const Messages ofKept = RunAndCheck(kept, input);
  const Subject fresh = SubjectFromBytes(same);
  const Messages ofFresh = RunAndCheck(fresh, input);
  const std::string saidByKept = Said(ofKept.Errors) + Said(ofKept.Warnings);
  const std::string saidByFresh = Said(ofFresh.Errors) + Said(ofFresh.Warnings);
  Demand(saidByKept == saidByFresh, "a filter that has run says what a new one says", kept.Filter,
    saidByKept + "and not" + saidByFresh);
  const std::string difference = Difference(OutputOf(kept), OutputOf(fresh));
  Demand(difference.empty(), "a filter that has run gives what a new one gives, but for",
    kept.Filter, difference);
  return 0;
}
