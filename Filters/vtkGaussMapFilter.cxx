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
#include <limits>
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

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr vtkSurfaceMeshConversion::ArrayRule NormalsRule = { "Normals", 3, -Infinity, Infinity,
  vtkDataSetAttributes::NORMALS };

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
  result.normals = normals(good, Eigen::all);
  if (weights.size() > 0)
  {
    result.weights = weights(good);
  }
  result.without = static_cast<int>(normals.rows() - result.normals.rows());
  return result;
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

//------------------------------------------------------------------------------------------------
struct vtkGaussMapFilter::Internals
{
  static WeightedNormals GatherNormals(
    vtkGaussMapFilter* self, vtkPolyData* input, vtkSurfaceMesh& surface);
  static void Measure(vtkGaussMapFilter* self, const Eigen::VectorXd& equalAngle,
    const Eigen::VectorXd& equalArea, Eigen::Index normals);
  static void FillTable(const vtkGaussMapFilter* self, vtkTable* table);
  static void Warn(vtkGaussMapFilter* self, const vtkSurfaceMesh& surface, int without);
};

/// @param surface  the triangles that were looked at, for messages
WeightedNormals vtkGaussMapFilter::Internals::GatherNormals(
  vtkGaussMapFilter* self, vtkPolyData* input, vtkSurfaceMesh& surface)
{
  using namespace vtkSurfaceMeshConversion;
  vtkInformation* wanted = self->GetInputArrayInformation(0);
  const bool ofPoints = self->NormalSource == POINT_NORMALS;
  const bool given =
    ofPoints && FindPointArray(wanted, input, NormalsRule.Purpose, NormalsRule.Attribute);
  // Given normals may differ between points at one place, as at a crease.
  surface = FromPolyData(input, !given);
  const SphericalStyle::Points& P = surface.Mesh.P;
  const SphericalStyle::Triangles& F = surface.Mesh.F;
  Eigen::VectorXd areas; // relative ones, which are finite at any size
  if (self->AreaWeighted)
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

void vtkGaussMapFilter::Internals::Measure(vtkGaussMapFilter* self,
  const Eigen::VectorXd& equalAngle, const Eigen::VectorXd& equalArea, Eigen::Index normals)
{
  using SphericalStyle::UnitsAbove;
  const double sizeOfUnit =
    static_cast<double>(equalAngle.size()) / static_cast<double>(equalArea.size());
  self->NumberOfNormals = static_cast<int>(normals);
  self->UnitsHit = UnitsAbove(equalAngle, 0.0);
  self->UnitsHitOften = UnitsAbove(equalAngle, self->OftenThreshold);
  self->EqualAreaUnitsHit = UnitsAbove(equalArea, 0.0);
  self->EqualAreaUnitsHitOften = UnitsAbove(equalArea, self->OftenThreshold * sizeOfUnit);
  const SphericalStyle::Spread spread = SphericalStyle::MeasureSpread(equalArea);
  self->Entropy = spread.entropy;
  self->RelativeEntropy = spread.relativeEntropy;
  self->KullbackLeiblerDivergence = spread.divergence;
  self->DistanceToUniform = spread.distanceToUniform;
}

void vtkGaussMapFilter::Internals::FillTable(const vtkGaussMapFilter* self, vtkTable* table)
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
  addNumber("Normals", self->NumberOfNormals);
  addNumber("UnitsHit", self->UnitsHit);
  addNumber("UnitsHitOften", self->UnitsHitOften);
  addNumber("EqualAreaUnits", self->NumberOfEqualAreaUnits);
  addNumber("EqualAreaUnitsHit", self->EqualAreaUnitsHit);
  addNumber("EqualAreaUnitsHitOften", self->EqualAreaUnitsHitOften);
  addMeasure("Entropy", self->Entropy);
  addMeasure("RelativeEntropy", self->RelativeEntropy);
  addMeasure("KullbackLeiblerDivergence", self->KullbackLeiblerDivergence);
  addMeasure("DistanceToUniform", self->DistanceToUniform);
}

void vtkGaussMapFilter::Internals::Warn(
  vtkGaussMapFilter* self, const vtkSurfaceMesh& surface, int without)
{
  const auto warn = [self](const std::string& text)
  { vtkWarningWithObjectMacro(self, << InBlock(self) << text); };
  if (self->NumberOfNormals == 0)
  {
    warn("the input has no normals to count");
  }
  for (const std::string& remark : { vtkSurfaceMeshConversion::FannedRemark(surface),
         vtkSurfaceMeshConversion::SkippedRemark(surface) })
  {
    if (!remark.empty())
    {
      warn(remark);
    }
  }
  if (without > 0)
  {
    warn("skipped " + Count(without, "normal") + " of length 0");
  }
}

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
  Internals::Measure(this, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1), 0); // of nothing
  vtkImageData::GetData(outputVector, 1)->Initialize(); // an image keeps its array otherwise
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }

  Require(std::isfinite(this->OftenThreshold) && this->OftenThreshold >= 0.0, "OftenThreshold",
    "finite and 0 or more", this->OftenThreshold);
  vtkSurfaceMesh surface;
  const WeightedNormals found = Internals::GatherNormals(this, input, surface);

  const auto equalAngle = SphericalStyle::SphereUnits::EqualAngle(Longitudes, Latitudes);
  const auto equalArea = SphericalStyle::SphereUnits::EqualArea(this->NumberOfEqualAreaUnits);
  const Eigen::VectorXd weights = RelativeWeights(found.normals.rows(), found.weights);
  const Eigen::VectorXd angleCounts = CountNormals(equalAngle, found.normals, weights);
  const Eigen::VectorXd areaCounts = CountNormals(equalArea, found.normals, weights);

  const bool showAngle = this->SphereUnits == EQUAL_ANGLE;
  FillSphere(vtkPolyData::GetData(outputVector, 0), showAngle ? equalAngle : equalArea,
    showAngle ? angleCounts : areaCounts);
  FillImage(vtkImageData::GetData(outputVector, 1), angleCounts);
  Internals::Measure(this, angleCounts, areaCounts, found.normals.rows());
  Internals::FillTable(this, vtkTable::GetData(outputVector, 2));
  Internals::Warn(this, surface, found.without);
  return 1;
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
