// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGaussMapFilter.h"

#include "GaussMap.h"
#include "SurfaceMeasures.h"
#include "vtkFilterSupport.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
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
constexpr double Origin[3] = { -179.5, -89.5, 0.0 }; // degrees, the middle of the first unit
constexpr double Spacing[3] = { 1.0, 1.0, 1.0 };

struct WeightedNormals
{
  Points normals;          ///< N x 3, none of them 0
  Eigen::VectorXd weights; ///< N, areas; empty: all the same
  int without = 0;         ///< faces or points left out because their normal is 0
};

/// Leaves out normals of 0, such as those where the faces at a point cancel.
WeightedNormals WithDirection(const Points& normals, const Eigen::VectorXd& weights)
{
  std::vector<Eigen::Index> good;
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
  {
    if (!normals.row(i).isZero(0.0))
    {
      good.push_back(i);
    }
  }
  WeightedNormals result;
  result.normals = normals(good, SphericalStyle::AllColumns);
  if (weights.size() > 0)
  {
    result.weights = weights(good);
  }
  result.without = static_cast<int>(normals.rows() - result.normals.rows());
  return result;
}

/// @param wanted  vtkAlgorithm::GetInputArrayInformation
/// @param surface  the triangles that were looked at, for messages
WeightedNormals GatherNormals(vtkInformation* wanted, bool ofPoints, bool areaWeighted,
  vtkPolyData* input, vtkSurfaceMesh& surface)
{
  using namespace vtkSurfaceMeshConversion;
  const bool given =
    ofPoints && FindPointArray(wanted, input, NormalsRule.Purpose, NormalsRule.Attribute);
  // Given normals may differ between points at one place, as at a crease.
  surface = FromPolyData(input, !given);
  const SphericalStyle::Points& P = surface.Mesh.P;
  const SphericalStyle::Triangles& F = surface.Mesh.F;
  Eigen::VectorXd areas; // relative ones, which are finite at any size
  if (areaWeighted)
  {
    const SphericalStyle::Points unit = SphericalStyle::AtUnitSize(P);
    areas = ofPoints ? SphericalStyle::PointAreas(unit, F) : SphericalStyle::TriangleAreas(unit, F);
  }
  if (!ofPoints)
  {
    return WithDirection(SphericalStyle::TriangleNormals(P, F), areas);
  }
  return WithDirection(given ? GatherPointArray(wanted, input, surface, NormalsRule)
                             : SphericalStyle::PointNormals(P, F),
    areas);
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
  NoteBlocks(this);
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
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* image = outputVector->GetInformationObject(1);
  const int extent[6] = { 0, Longitudes - 1, 0, Latitudes - 1, 0, 0 };
  image->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  image->Set(vtkDataObject::ORIGIN(), Origin, 3);
  image->Set(vtkDataObject::SPACING(), Spacing, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(image, VTK_DOUBLE, 1);
  return 1;
}

int vtkGaussMapFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(this, outputVector, [&] { return this->Execute(inputVector, outputVector); });
}

int vtkGaussMapFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace SphericalStyle;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  this->SetFacts({});
  vtkImageData::GetData(outputVector, 1)->Initialize(); // an image keeps its array otherwise
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  const auto taken = vtkSurfaceMeshConversion::WithoutEmptyArrays(input);

  Require(std::isfinite(this->OftenThreshold) && this->OftenThreshold >= 0.0, "OftenThreshold",
    "finite and 0 or more", this->OftenThreshold);
  vtkSurfaceMesh surface;
  const WeightedNormals found = GatherNormals(this->GetInputArrayInformation(0),
    this->NormalSource == POINT_NORMALS, this->AreaWeighted, taken, surface);

  const auto equalAngle = SphericalStyle::SphereUnits::EqualAngle(Longitudes, Latitudes);
  const auto equalArea = SphericalStyle::SphereUnits::EqualArea(this->NumberOfEqualAreaUnits);
  const Eigen::VectorXd weights = RelativeWeights(found.normals.rows(), found.weights);
  const Counts counts = { CountNormals(equalAngle, found.normals, weights),
    CountNormals(equalArea, found.normals, weights), found.normals.rows() };

  const bool showAngle = this->SphereUnits == EQUAL_ANGLE;
  FillSphere(vtkPolyData::GetData(outputVector, 0), showAngle ? equalAngle : equalArea,
    showAngle ? counts.EqualAngle : counts.EqualArea);
  FillImage(vtkImageData::GetData(outputVector, 1), counts.EqualAngle);
  this->SetFacts(counts);
  this->FillTable(vtkTable::GetData(outputVector, 2));
  if (counts.Normals == 0)
  {
    Warn(this, "the input has no normals to count");
  }
  Warn(this, vtkSurfaceMeshConversion::FannedRemark(surface));
  Warn(this, vtkSurfaceMeshConversion::SkippedRemark(surface));
  if (found.without > 0)
  {
    Warn(this, "skipped " + Count(found.without, "normal") + " of length 0");
  }
  return 1;
}

void vtkGaussMapFilter::SetFacts(const Counts& counts)
{
  using SphericalStyle::UnitsAbove;
  const double sizeOfUnit =
    static_cast<double>(counts.EqualAngle.size()) / static_cast<double>(counts.EqualArea.size());
  this->NumberOfNormals = static_cast<int>(counts.Normals);
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
  addNumber("Normals", this->NumberOfNormals);
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
