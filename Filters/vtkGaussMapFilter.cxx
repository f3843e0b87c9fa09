// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGaussMapFilter.h"

#include "GaussMap.h"
#include "SurfaceMeasures.h"
#include "UnitScale.h"
#include "vtkFilterSupport.h"
#include "vtkProcesses.h"
#include "vtkStyleHistory.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

using SphericalStyle::Points;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkGaussMapFilter);

namespace
{
constexpr int Longitudes = 360;
constexpr int Latitudes = 180;
constexpr int Extent[6] = { 0, Longitudes - 1, 0, Latitudes - 1, 0, 0 };
constexpr double Origin[3] = { -179.5, -89.5, 0.0 }; // degrees, the middle of the first unit
constexpr double Spacing[3] = { 1.0, 1.0, 1.0 };

struct WeightedNormals
{
  Points normals;          ///< N x 3, none of them 0
  Eigen::VectorXd weights; ///< N, areas; empty: all the same
  int without = 0;         ///< faces or points left out because their normal is 0
};

/// Leaves out normals of 0, such as those where the faces at a point cancel, and what does not
/// count on this process.
template <typename Function>
WeightedNormals WithDirection(
  const Points& normals, const Eigen::VectorXd& weights, const Function& counts)
{
  std::vector<Eigen::Index> good;
  WeightedNormals result;
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
  {
    if (counts(i) && !normals.row(i).isZero(0.0))
    {
      good.push_back(i);
    }
    else if (counts(i))
    {
      ++result.without;
    }
  }
  result.normals = normals(good, SphericalStyle::AllColumns);
  if (weights.size() > 0)
  {
    result.weights = weights(good);
  }
  return result;
}

/// Points at about size 1, the same power of two on all processes.
Points AtUnitSizeOfAll(const Points& P, const SphericalStyle::SurfacePart& part)
{
  const double largest = part.Max(P.size() > 0 ? P.cwiseAbs().maxCoeff() : 0.0);
  return SphericalStyle::UnitScale(Eigen::Array<double, 1, 1>(largest)) * P;
}

/// What the processes have of given normals at points that several of them have. Copies of a point
/// that differ, as at a crease, have other ids or normals; of those that do not, the first of each
/// process are one, the second, and so on.
/// @param normals, areas  one per input point; areas become those of all processes
/// @return per input point whether it counts here
std::vector<char> JoinGivenNormals(vtkPolyData* input, const vtkSurfaceMesh& surface,
  const Points& normals, std::vector<double>& areas, std::vector<char> used)
{
  const SphericalStyle::SurfacePart& part = surface.InputPart;
  vtkDataArray* ids = input->GetPointData()->GetGlobalIds();
  const bool byIds = surface.IsEverywhere(ids);
  std::vector<int> placeOf(surface.Mesh.P.rows(), -1);
  for (std::size_t k = 0; k < surface.Part.shared.size(); ++k)
  {
    placeOf[surface.Part.shared[k]] = surface.Part.numbers[k];
  }
  using Name = std::array<double, 6>; // place, id or normal, turn
  std::map<Name, double> turns;
  std::map<Name, std::size_t> own;
  std::vector<double> rows;
  const int rank = part.processes->GetRank();
  for (std::size_t i = 0; i < used.size(); ++i)
  {
    const int place = surface.MeshPoint[i] >= 0 ? placeOf[surface.MeshPoint[i]] : -1;
    if (place < 0)
    {
      continue;
    }
    const auto row = static_cast<Eigen::Index>(i);
    Name name = { static_cast<double>(place),
      byIds ? ids->GetComponent(static_cast<vtkIdType>(i), 0) : 0.0, 0.0, 0.0, 0.0, 0.0 };
    if (!byIds)
    {
      std::copy_n(normals.row(row).data(), 3, name.begin() + 2);
    }
    name.back() = turns[name]++;
    own[name] = i;
    rows.insert(rows.end(), name.begin(), name.end());
    rows.insert(rows.end(), { static_cast<double>(rank), static_cast<double>(used[i]), areas[i] });
  }
  rows = part.Concatenate(rows);
  struct Copies
  {
    int First = -1; // process that uses it
    double Area = 0.0;
  };
  std::map<Name, Copies> all;
  for (std::size_t k = 0; k < rows.size(); k += 9)
  {
    Name name;
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(k), name.size(), name.begin());
    Copies& copies = all[name];
    copies.Area += rows[k + 8];
    copies.First =
      copies.First < 0 && rows[k + 7] > 0.0 ? static_cast<int>(rows[k + 6]) : copies.First;
  }
  for (const auto& [name, i] : own)
  {
    const Copies& copies = all[name];
    used[i] = copies.First == rank ? 1 : 0;
    areas[i] = copies.Area;
  }
  return used;
}

/// Normals of the input's points, as they are.
WeightedNormals GivenNormals(
  vtkInformation* wanted, bool areaWeighted, vtkPolyData* input, const vtkSurfaceMesh& surface)
{
  using namespace vtkSurfaceMeshConversion;
  const auto size = static_cast<Eigen::Index>(surface.MeshPoint.size());
  GatherPointArray(wanted, input, surface, NormalsRule); // refuses what is wrong with them
  vtkDataArray* array =
    size > 0 ? FindPointArray(wanted, input, NormalsRule.Purpose, NormalsRule.Attribute) : nullptr;
  Points normals(size, 3);
  for (Eigen::Index i = 0; i < size; ++i)
  {
    array->GetTuple(i, normals.row(i).data());
  }
  std::vector<char> used(size, 0);
  std::vector<double> areas(size, 0.0);
  const Eigen::VectorXd ofTriangles =
    SphericalStyle::TriangleAreas(AtUnitSizeOfAll(surface.Mesh.P, surface.Part), surface.Mesh.F);
  for (Eigen::Index f = 0; f < surface.Mesh.F.rows(); ++f)
  {
    for (const int i : surface.GetCorners().row(f))
    {
      used[i] = 1;
      areas[i] += ofTriangles(f) / 3.0;
    }
  }
  if (!surface.Part.IsWhole())
  {
    used = JoinGivenNormals(input, surface, normals, areas, used);
  }
  return WithDirection(normals,
    areaWeighted ? Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(areas.data(), size))
                 : Eigen::VectorXd(),
    [&used](Eigen::Index i) { return used[i] != 0; });
}

/// @param wanted  vtkAlgorithm::GetInputArrayInformation
/// @param surface  the triangles that were looked at, for messages
WeightedNormals GatherNormals(vtkInformation* wanted, bool ofPoints, bool areaWeighted,
  vtkPolyData* input, const std::shared_ptr<const vtkProcesses>& processes, vtkSurfaceMesh& surface)
{
  using namespace vtkSurfaceMeshConversion;
  surface = FromPolyData(input, true, TakePoints::OfTriangles, processes);
  const SphericalStyle::SurfacePart& part = surface.Part;
  const SphericalStyle::Points& P = surface.Mesh.P;
  const SphericalStyle::Triangles& F = surface.Mesh.F;
  const bool here = ofPoints && !surface.MeshPoint.empty() &&
    FindPointArray(wanted, input, NormalsRule.Purpose, NormalsRule.Attribute);
  const bool missing = ofPoints && !surface.MeshPoint.empty() && !here;
  if (part.Max(here ? 1.0 : 0.0) > 0.0 && part.Max(missing ? 1.0 : 0.0) == 0.0)
  {
    // Given normals may differ between points at one place, as at a crease.
    return GivenNormals(wanted, areaWeighted, input, surface);
  }
  Eigen::VectorXd areas; // relative ones, which are finite at any size
  if (areaWeighted)
  {
    const SphericalStyle::Points unit = AtUnitSizeOfAll(P, part);
    areas = ofPoints ? SphericalStyle::PointAreas(unit, F) : SphericalStyle::TriangleAreas(unit, F);
  }
  if (!ofPoints)
  {
    return WithDirection(
      SphericalStyle::TriangleNormals(P, F), areas, [](Eigen::Index) { return true; });
  }
  if (areaWeighted)
  {
    part.SumAtShared(areas.data(), 1);
  }
  return WithDirection(SphericalStyle::PointNormals(P, F, part), areas,
    [&part](Eigen::Index i) { return part.Counts(i); });
}

vtkSmartPointer<vtkDoubleArray> MakeArray(const char* name, const Eigen::VectorXd& values)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfValues(values.size());
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

void FillSphere(
  vtkPolyData* output, const SphericalStyle::SphereUnits& units, const Eigen::VectorXd& counts)
{
  const SphericalStyle::SphereUnits::Polygons polygons = units.MakePolygons();
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(polygons.points.rows());
  vtkNew<vtkFloatArray> normals; // of the sphere: the units, cut into triangles, look round
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(polygons.points.rows());
  for (Eigen::Index i = 0; i < polygons.points.rows(); ++i)
  {
    points->SetPoint(i, polygons.points.row(i).data());
    normals->SetTuple(i, polygons.points.row(i).data());
  }
  vtkNew<vtkCellArray> cells;
  for (const std::vector<int>& unit : polygons.units)
  {
    cells->InsertNextCell(static_cast<int>(unit.size()));
    for (const int i : unit)
    {
      cells->InsertCellPoint(i);
    }
  }
  output->SetPoints(points);
  output->SetPolys(cells);
  output->GetPointData()->SetNormals(normals);
  output->GetCellData()->AddArray(MakeArray("Count", counts));
  output->GetCellData()->SetScalars(MakeArray("Density", SphericalStyle::Density(units, counts)));
}

void FillImage(vtkImageData* output, const Eigen::VectorXd& counts)
{
  output->SetExtent(0, Longitudes - 1, 0, Latitudes - 1, 0, 0);
  output->SetOrigin(Origin);
  output->SetSpacing(Spacing);
  output->GetPointData()->SetScalars(MakeArray("Count", counts));
}
}

/// Of one execution.
struct vtkGaussMapFilter::Counts
{
  Eigen::VectorXd EqualAngle = Eigen::VectorXd::Zero(1); ///< normals per unit
  Eigen::VectorXd EqualArea = Eigen::VectorXd::Zero(1);  ///< the same
  Eigen::Index Normals = 0;
};

//------------------------------------------------------------------------------------------------
vtkGaussMapFilter::vtkGaussMapFilter()
{
  this->SetNumberOfOutputPorts(3);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::NORMALS);
}

int vtkGaussMapFilter::FillInputPortInformation(int, vtkInformation* info)
{
  TakeDataSet(info);
  return 1;
}

int vtkGaussMapFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[] = { "vtkPolyData", "vtkImageData", "vtkTable" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

int vtkGaussMapFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* image = outputVector->GetInformationObject(1);
  // Where the image stays empty nobody shall ask for a part of it.
  const bool isElsewhere = this->Controller && this->Controller->GetLocalProcessId() > 0 &&
    !vtkCompositeDataSet::GetData(inputVector[0], 0);
  const int none[6] = { 0, -1, 0, -1, 0, -1 };
  image->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), isElsewhere ? none : Extent, 6);
  image->Set(vtkDataObject::ORIGIN(), Origin, 3);
  image->Set(vtkDataObject::SPACING(), Spacing, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(image, VTK_DOUBLE, 1);
  return 1;
}

int vtkGaussMapFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetFacts({});
  vtkImageData* image = vtkImageData::GetData(outputVector, 1);
  image->Initialize(); // an image keeps its array otherwise
  const int done = this->Superclass::RequestData(request, inputVector, outputVector);
  // There is no more of it, also where it is empty. The pipeline would execute again for what is
  // missing, on some of the processes, and these would wait for the others.
  image->GetInformation()->Set(vtkDataObject::ALL_PIECES_EXTENT(), Extent, 6);
  return done;
}

int vtkGaussMapFilter::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(this, outputVector, [&] { return this->Execute(inputVector, outputVector); });
}

int vtkGaussMapFilter::RequestPart(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto processes = std::make_shared<const vtkProcesses>(this->Controller);
  const int outcome = this->RunOnParts(inputVector, outputVector, *processes,
    [&] { this->Execute(inputVector, outputVector, processes); });
  if (outcome == PART_FAILED)
  {
    this->SetFacts({});
  }
  return outcome;
}

int vtkGaussMapFilter::Execute(vtkInformationVector** inputVector,
  vtkInformationVector* outputVector, const std::shared_ptr<const vtkProcesses>& processes)
{
  using namespace SphericalStyle;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!processes && (!input || input->GetNumberOfPoints() == 0))
  {
    return 1;
  }

  Require(std::isfinite(this->OftenThreshold) && this->OftenThreshold >= 0.0, "OftenThreshold",
    "finite and 0 or more", this->OftenThreshold);
  if (processes &&
    !processes->AreAlike({ static_cast<double>(this->NormalSource), this->AreaWeighted ? 1.0 : 0.0,
      this->OftenThreshold, static_cast<double>(this->NumberOfEqualAreaUnits) }))
  {
    throw std::invalid_argument(
      "NormalSource, AreaWeighted, OftenThreshold and NumberOfEqualAreaUnits must be the same on "
      "all processes");
  }
  vtkSurfaceMesh surface;
  const WeightedNormals found = GatherNormals(this->GetInputArrayInformation(0),
    this->NormalSource == POINT_NORMALS, this->AreaWeighted, input, processes, surface);

  const SurfacePart& part = surface.Part;
  const auto equalAngle = SphericalStyle::SphereUnits::EqualAngle(Longitudes, Latitudes);
  const auto equalArea = SphericalStyle::SphereUnits::EqualArea(this->NumberOfEqualAreaUnits);
  const Eigen::VectorXd weights = RelativeWeights(found.normals.rows(), found.weights, part);
  Counts counts = { CountNormals(equalAngle, found.normals, weights),
    CountNormals(equalArea, found.normals, weights), 0 };
  part.Sum(counts.EqualAngle);
  part.Sum(counts.EqualArea);
  counts.Normals = static_cast<Eigen::Index>(part.Sum(static_cast<double>(found.normals.rows())));
  const auto without = static_cast<vtkIdType>(part.Sum(static_cast<double>(found.without)));
  this->SetFacts(counts);
  const std::vector<double> bytes = processes ? processes->GetBytesOfAll() : std::vector<double>();
  if (processes && processes->GetRank() != 0)
  {
    return 1;
  }

  const bool showAngle = this->SphereUnits == EQUAL_ANGLE;
  FillSphere(vtkPolyData::GetData(outputVector, 0), showAngle ? equalAngle : equalArea,
    showAngle ? counts.EqualAngle : counts.EqualArea);
  FillImage(vtkImageData::GetData(outputVector, 1), counts.EqualAngle);
  vtkTable* table = vtkTable::GetData(outputVector, 2);
  this->FillTable(table);
  vtkStyleHistory::AddBytes(table, bytes);
  if (counts.Normals == 0)
  {
    Warn(this, "the input has no normals to count");
  }
  Warn(this, vtkSurfaceMeshConversion::FannedRemark(surface));
  Warn(this, vtkSurfaceMeshConversion::SkippedRemark(surface));
  if (without > 0)
  {
    Warn(this, "skipped " + Count(without, "normal") + " of length 0");
  }
  return 1;
}

void vtkGaussMapFilter::SetFacts(const Counts& counts)
{
  using SphericalStyle::UnitsAbove;
  const double sizeOfUnit =
    static_cast<double>(counts.EqualAngle.size()) / static_cast<double>(counts.EqualArea.size());
  this->NumberOfNormals = counts.Normals;
  this->UnitsHit = UnitsAbove(counts.EqualAngle, 0.0);
  this->UnitsHitOften = UnitsAbove(counts.EqualAngle, this->OftenThreshold);
  this->EqualAreaUnitsHit = UnitsAbove(counts.EqualArea, 0.0);
  this->EqualAreaUnitsHitOften = UnitsAbove(counts.EqualArea, this->OftenThreshold * sizeOfUnit);
  const SphericalStyle::Spread spread = SphericalStyle::MeasureSpread(counts.EqualArea);
  this->Entropy = spread.entropy;
  this->RelativeEntropy = spread.relativeEntropy;
  this->KullbackLeiblerDivergence = spread.divergence;
  this->DistanceToUniform = spread.distanceToUniform;
}

void vtkGaussMapFilter::FillTable(vtkTable* table) const
{
  const auto addNumber = [table](const char* name, int value)
  {
    vtkNew<vtkIntArray> column;
    column->SetName(name);
    column->InsertNextValue(value);
    table->AddColumn(column);
  };
  const auto addMeasure = [table](const char* name, double value)
  { table->AddColumn(MakeArray(name, Eigen::VectorXd::Constant(1, value))); };
  vtkNew<vtkIdTypeArray> normals;
  normals->SetName("Normals");
  normals->InsertNextValue(this->NumberOfNormals);
  table->AddColumn(normals);
  addNumber("UnitsHit", this->UnitsHit);
  addNumber("UnitsHitOften", this->UnitsHitOften);
  addNumber("EqualAreaUnits", this->NumberOfEqualAreaUnits);
  addNumber("EqualAreaUnitsHit", this->EqualAreaUnitsHit);
  addNumber("EqualAreaUnitsHitOften", this->EqualAreaUnitsHitOften);
  addMeasure("Entropy", this->Entropy);
  addMeasure("RelativeEntropy", this->RelativeEntropy);
  addMeasure("KullbackLeiblerDivergence", this->KullbackLeiblerDivergence);
  addMeasure("DistanceToUniform", this->DistanceToUniform);
}

void vtkGaussMapFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NormalSource: " << this->NormalSource << "\n";
  os << indent << "AreaWeighted: " << OnOff(this->AreaWeighted) << "\n";
  os << indent << "OftenThreshold: " << this->OftenThreshold << "\n";
  os << indent << "NumberOfEqualAreaUnits: " << this->NumberOfEqualAreaUnits << "\n";
  os << indent << "SphereUnits: " << this->SphereUnits << "\n";
  os << indent << "NumberOfNormals: " << this->NumberOfNormals << "\n";
  os << indent << "UnitsHit: " << this->UnitsHit << "\n";
  os << indent << "UnitsHitOften: " << this->UnitsHitOften << "\n";
  os << indent << "EqualAreaUnitsHit: " << this->EqualAreaUnitsHit << "\n";
  os << indent << "EqualAreaUnitsHitOften: " << this->EqualAreaUnitsHitOften << "\n";
  os << indent << "Entropy: " << this->Entropy << "\n";
  os << indent << "RelativeEntropy: " << this->RelativeEntropy << "\n";
  os << indent << "KullbackLeiblerDivergence: " << this->KullbackLeiblerDivergence << "\n";
  os << indent << "DistanceToUniform: " << this->DistanceToUniform << "\n";
}
