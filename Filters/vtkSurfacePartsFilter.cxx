// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfacePartsFilter.h"

#include "Frame.h"
#include "MeshTopology.h"
#include "Orientation.h"
#include "SurfaceMeasures.h"
#include "SurfaceParts.h"
#include "vtkFilterSupport.h"
#include "vtkIdValues.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkSurfacePartsFilter);

/// Parts by any numbers, before they are put in order.
struct vtkFoundParts
{
  std::vector<int> OfPoints;     ///< of each input point, NoPart for none
  std::vector<int> OfCells;      ///< of each input cell
  std::vector<double> Thickness; ///< of each part, length; none where it is not known
  static constexpr int NoPart = -1;
};

namespace
{
constexpr int NoPart = vtkFoundParts::NoPart;

/// One of several, by area.
struct PartMeasures
{
  vtkIdType points = 0;
  vtkIdType cells = 0;
  double area = 0.0;
  double center[3] = { 0.0, 0.0, 0.0 };
  double thickness = std::numeric_limits<double>::quiet_NaN();
};

/// The part that most of the points are of, of the lowest of several.
int PartOfMost(const std::set<int>& points, const std::vector<int>& ofPoints)
{
  std::map<int, int> votes;
  for (const int point : points)
  {
    if (ofPoints[point] != NoPart)
    {
      ++votes[ofPoints[point]];
    }
  }
  const auto best = std::max_element(
    votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return best == votes.end() ? NoPart : best->first;
}

/// Cells with triangles follow their points.
void LetCellsFollow(vtkPolyData* input, const vtkSurfaceMesh& surface, vtkFoundParts& found)
{
  found.OfCells.assign(input->GetNumberOfCells(), NoPart);
  const SphericalStyle::Triangles& corners = surface.GetCorners();
  std::set<int> points; // of the cell, whose triangles come one after the other
  for (Eigen::Index f = 0; f < corners.rows(); ++f)
  {
    points.insert({ corners(f, 0), corners(f, 1), corners(f, 2) });
    if (f + 1 == corners.rows() || surface.GetCell(f + 1) != surface.GetCell(f))
    {
      found.OfCells[surface.GetCell(f)] = PartOfMost(points, found.OfPoints);
      points.clear();
    }
  }
}

/// Points are of the part of their first cell.
void LetPointsFollow(vtkPolyData* input, vtkFoundParts& found)
{
  found.OfPoints.assign(input->GetNumberOfPoints(), NoPart);
  vtkNew<vtkIdList> points;
  vtkIdType cell = 0;
  for (vtkCellArray* cells :
    { input->GetVerts(), input->GetLines(), input->GetPolys(), input->GetStrips() })
  {
    for (vtkIdType i = 0; cells && i < cells->GetNumberOfCells(); ++i, ++cell)
    {
      cells->GetCellAtId(i, points);
      for (vtkIdType k = 0; k < points->GetNumberOfIds(); ++k)
      {
        int& part = found.OfPoints[points->GetId(k)];
        part = part == NoPart ? found.OfCells[cell] : part;
      }
    }
  }
}

std::vector<int> OfInputPoints(const vtkSurfaceMesh& surface, const std::vector<int>& ofMesh)
{
  std::vector<int> parts(surface.MeshPoint.size(), NoPart);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    if (surface.MeshPoint[i] != vtkSurfaceMesh::NotMoved)
    {
      parts[i] = ofMesh[surface.MeshPoint[i]];
    }
  }
  return parts;
}

/// What shares points.
vtkFoundParts FindConnected(const vtkSurfaceMesh& surface)
{
  vtkFoundParts found;
  found.OfPoints = OfInputPoints(surface,
    SphericalStyle::MeshTopology(surface.Mesh.F, static_cast<int>(surface.Mesh.P.rows()))
      .GetComponents());
  return found;
}

/// The parts that occur, with what they have, and the numbers they get: by area, the largest first.
std::vector<PartMeasures> PutInOrder(const vtkSurfaceMesh& surface, vtkFoundParts& found)
{
  int count = 0;
  for (const std::vector<int>* parts : { &found.OfPoints, &found.OfCells })
  {
    for (const int part : *parts)
    {
      count = std::max(count, part + 1);
    }
  }
  std::vector<PartMeasures> measures(count);
  const Eigen::VectorXd areas = SphericalStyle::TriangleAreas(surface.Mesh.P, surface.Mesh.F);
  for (Eigen::Index f = 0; f < areas.size(); ++f)
  {
    const int part = found.OfCells[surface.GetCell(f)];
    if (part != NoPart)
    {
      measures[part].area += areas(f);
      Eigen::Map<Eigen::RowVector3d>(measures[part].center) += areas(f) *
        surface.Mesh.P(surface.Mesh.F.row(f), SphericalStyle::AllColumns).colwise().mean();
    }
  }
  const auto countIn = [&](const std::vector<int>& parts, vtkIdType PartMeasures::*number)
  {
    for (const int part : parts)
    {
      if (part != NoPart)
      {
        ++(measures[part].*number);
      }
    }
  };
  countIn(found.OfPoints, &PartMeasures::points);
  countIn(found.OfCells, &PartMeasures::cells);
  for (std::size_t p = 0; p < found.Thickness.size(); ++p)
  {
    measures[p].thickness = found.Thickness[p];
  }
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
    order.begin(), order.end(), [&](int a, int b) { return measures[a].area > measures[b].area; });
  std::vector<int> numbers(count, NoPart);
  std::vector<PartMeasures> ordered;
  for (const int part : order)
  {
    PartMeasures& m = measures[part];
    if (m.points > 0 || m.cells > 0)
    {
      Eigen::Map<Eigen::RowVector3d>(m.center) /= m.area; // NaN where nothing has an area
      numbers[part] = static_cast<int>(ordered.size());
      ordered.push_back(m);
    }
  }
  for (std::vector<int>* parts : { &found.OfPoints, &found.OfCells })
  {
    for (int& part : *parts)
    {
      part = part == NoPart ? NoPart : numbers[part];
    }
  }
  return ordered;
}

void AddPartIds(vtkDataSetAttributes* attributes, const std::vector<int>& parts)
{
  vtkNew<vtkIntArray> ids;
  ids->SetName("PartId");
  ids->SetNumberOfValues(static_cast<vtkIdType>(parts.size()));
  std::copy(parts.begin(), parts.end(), ids->GetPointer(0));
  attributes->AddArray(ids);
}

void MakeTable(vtkTable* table, const std::vector<PartMeasures>& parts)
{
  table->Initialize(); // an observer of progress may have asked for an update, which filled it
  vtkNew<vtkIntArray> number;
  vtkNew<vtkIdTypeArray> points, cells;
  vtkNew<vtkDoubleArray> area, center, thickness;
  center->SetNumberOfComponents(3);
  for (const PartMeasures& part : parts)
  {
    number->InsertNextValue(static_cast<int>(number->GetNumberOfValues()));
    points->InsertNextValue(part.points);
    cells->InsertNextValue(part.cells);
    area->InsertNextValue(part.area);
    center->InsertNextTuple(part.center);
    thickness->InsertNextValue(part.thickness);
  }
  AddColumn(table, number, "Part");
  AddColumn(table, points, "Points");
  AddColumn(table, cells, "Cells");
  AddColumn(table, area, "Area");
  AddColumn(table, center, "Center");
  AddColumn(table, thickness, "Thickness");
}

/// Of each value of an array, its rank among all. @throw std::invalid_argument
std::vector<int> RanksOf(vtkDataArray* array, vtkIdType count, const char* noun)
{
  const vtkIdValues given(array, "Method Array", count, noun);
  std::vector<vtkIdType> ids(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    ids[i] = given[i];
  }
  std::vector<vtkIdType> values;
  return vtkIdValues::Ranks(ids, values);
}
}

//------------------------------------------------------------------------------------------------
vtkSurfacePartsFilter::vtkSurfacePartsFilter()
{
  NoteBlocks(this);
  this->SetNumberOfOutputPorts(2);
}

int vtkSurfacePartsFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  TakeDataSet(info);
  return 1;
}

int vtkSurfacePartsFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkSurfacePartsFilter::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(this, outputVector, [&] { return this->Execute(inputVector, outputVector); });
}

int vtkSurfacePartsFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  vtkTable* table = vtkTable::GetData(outputVector, 1);
  this->EffectiveNumberOfParts = 0;
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!input || (input->GetNumberOfPoints() == 0 && input->GetNumberOfCells() == 0))
  {
    return 1;
  }
  const vtkSurfaceMesh surface = vtkSurfaceMeshConversion::FromPolyData(input, true);
  Warn(this, vtkSurfaceMeshConversion::FannedRemark(surface));
  Warn(this, vtkSurfaceMeshConversion::SkippedRemark(surface));
  vtkFoundParts found;
  try
  {
    if (this->Method == ARRAY)
    {
      found = this->FindByArray(inputVector, input, surface);
    }
    else if (surface.Mesh.F.rows() == 0)
    {
      found.OfPoints.assign(input->GetNumberOfPoints(), NoPart);
      found.OfCells.assign(input->GetNumberOfCells(), NoPart);
    }
    else
    {
      found = this->Method == SHAPE ? this->FindByShape(surface) : FindConnected(surface);
      LetCellsFollow(input, surface, found);
    }
  }
  catch (const SphericalStyle::SolveAborted&)
  {
    return 1; // nothing comes out, as everywhere in VTK
  }
  output->ShallowCopy(input);
  const std::vector<PartMeasures> parts = PutInOrder(surface, found);
  AddPartIds(output->GetPointData(), found.OfPoints);
  AddPartIds(output->GetCellData(), found.OfCells);
  MakeTable(table, parts);
  this->EffectiveNumberOfParts = static_cast<int>(parts.size());
  return 1;
}

int vtkSurfacePartsFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int done = this->Superclass::RequestData(request, inputVector, outputVector);
  vtkCellData* cells = vtkPolyData::GetData(outputVector, 0)->GetCellData();
  if (cells->HasArray("PartId")) // also where this process has a part of the surface
  {
    cells->SetActiveScalars("PartId"); // so that Apply shows the parts
  }
  return done;
}

vtkFoundParts vtkSurfacePartsFilter::FindByShape(const vtkSurfaceMesh& surface)
{
  this->SetProgressText("Looking for parts");
  using namespace SphericalStyle;
  const Frame frame = FrameOf(surface.Mesh.P);
  const Points P = frame.Into(surface.Mesh.P);
  PartsOptions options;
  options.numberOfParts = this->NumberOfParts;
  options.threads = ThreadsToUse(0);
  const SurfacePartsResult parts = FindParts(P, OrientOutward(P, surface.Mesh.F), options,
    [this](int search, double)
    {
      this->UpdateProgress(1.0 - std::pow(0.9, search)); // nobody knows how many there will be
      return !Aborted(this);
    });
  if (this->NumberOfParts > 0 && parts.count != this->NumberOfParts)
  {
    Warn(this,
      parts.count < this->NumberOfParts
        ? "NumberOfParts is " + std::to_string(this->NumberOfParts) + ", and there are " +
          std::to_string(parts.count) + ": nothing more can be cut off that has points of its own"
        : "NumberOfParts is " + std::to_string(this->NumberOfParts) + ", and there are " +
          std::to_string(parts.count) + ": so many do not hang together");
  }
  vtkFoundParts found;
  found.OfPoints = OfInputPoints(surface, parts.parts);
  for (const double thickness : parts.thickness)
  {
    found.Thickness.push_back(frame.scale * thickness);
  }
  return found;
}

vtkFoundParts vtkSurfacePartsFilter::FindByArray(
  vtkInformationVector** inputVector, vtkPolyData* input, const vtkSurfaceMesh& surface)
{
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkInformation* wanted = this->GetInputArrayInformation(0);
  const bool isSet = wanted->Has(vtkDataObject::FIELD_NAME()) ||
    wanted->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()); // else VTK itself reports an error
  vtkDataArray* array = isSet ? this->GetInputArrayToProcess(0, inputVector, association) : nullptr;
  const bool ofCells = association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  if (!array || (!ofCells && association != vtkDataObject::FIELD_ASSOCIATION_POINTS))
  {
    throw std::invalid_argument(
      "Method Array: there is no such array of points or cells; choose one (PartArray, input array "
      "to process 0), or Method Shape");
  }
  vtkFoundParts found;
  if (!ofCells)
  {
    found.OfPoints = RanksOf(array, input->GetNumberOfPoints(), "point");
    LetCellsFollow(input, surface, found);
    return found;
  }
  found.OfCells = RanksOf(array, input->GetNumberOfCells(), "cell");
  LetPointsFollow(input, found);
  return found;
}

void vtkSurfacePartsFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "NumberOfParts: " << this->NumberOfParts << "\n";
  os << indent << "EffectiveNumberOfParts: " << this->EffectiveNumberOfParts << "\n";
}
