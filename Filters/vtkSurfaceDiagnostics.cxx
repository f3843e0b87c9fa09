// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceDiagnostics.h"

#include "vtkFilterSupport.h"
#include "vtkSurfaceMeshConversion.h"

#include "MeshDiagnosis.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

using SphericalStyle::Defect;
using SphericalStyle::Finding;
using SphericalStyle::MeshDiagnosis;
using namespace vtkFilterSupport;
using vtkSurfaceMeshConversion::WholeSurface;

vtkStandardNewMacro(vtkSurfaceDiagnostics);

namespace
{
/// What the table says of a finding.
struct Words
{
  const char* name;
  const char* meaning;
  const char* consequence;
};

/// In the order of Defect.
constexpr Words DefectWords[SphericalStyle::NumberOfDefects] = {
  { "NonFinitePoints", "points with a coordinate that is NaN or infinite",
    "refused with an error: remove the points" },
  { "CoincidentPoints", "points at the place of an earlier one (texture seams, cracks)",
    "moved as one while WeldCoincidentPoints is on" },
  { "UnusedPoints", "points of no triangle with an area",
    "left where they are; Convex Proxy Deform moves them along" },
  { "NonManifoldPoints", "points where parts touch that share no edge there (bow-ties)",
    "solved as they are" },
  { "DegenerateTriangles", "triangles without an area, or with a point twice",
    "skipped with a warning; they come out and follow their points" },
  { "DuplicateTriangles", "triangles of the same points as an earlier one",
    "solved as they are: they count twice" },
  { "Slivers", "triangles with an angle below SliverAngle",
    "solved as they are; Roundness moves them unevenly with Uniform weights" },
  { "ObtuseTriangles", "triangles with an angle above 90 degrees", "solved as they are" },
  { "NonManifoldEdges", "edges of three or more triangles", "solved as they are" },
  { "BorderEdges", "edges of one triangle", "solved as they are: a border is free to move" },
  { "MisorientedEdges", "edges whose two triangles do not agree on the outside",
    "directions from the center are not affected; normals are wrong there" },
  { "NegativeWeights", "edges with a negative cotangent weight",
    "solved as they are; EdgeWeighting IntrinsicDelaunay has none" },
  { "InsideOutComponents", "closed parts that face inward",
    "directions from the center are not affected; normals point inward" },
};
constexpr Words LoopWords = { "BorderLoops", "borders that do not touch each other",
  "solved as they are" };
constexpr Words PartWords = { "Components", "parts that share no point",
  "held together by stitches, or each for itself (ComponentCoupling)" };
constexpr Words PolygonWords = { "UncutPolygons", "polygons that cannot be cut into triangles",
  "cut as fans with a warning" };
constexpr Words ScaleWords = { "ExtremeScale",
  "a diagonal whose square does not fit into single precision",
  "solved as it is; views and other filters may fail" };
constexpr Words DigitWords = { "FewDigits",
  "fewer than 4 decimal digits left: too far from the origin for the number type",
  "solved as it is: rounding of the points is visible; move the model, or use double points" };
constexpr Words SizeWords = { "ManyTriangles", "more than half of what can be solved at once",
  "solved until the limit, then refused with an error" };

/// The table, row by row.
class Report
{
public:
  explicit Report(vtkTable* table)
  {
    table->Initialize(); // an observer of progress may have asked for an update, which filled it
    AddColumn(table, this->Name, "Name");
    AddColumn(table, this->Count, "Count");
    AddColumn(table, this->Value, "Value");
    AddColumn(table, this->Association, "Association");
    AddColumn(table, this->FirstId, "FirstId");
    AddColumn(table, this->Meaning, "Meaning");
    AddColumn(table, this->Consequence, "Consequence");
  }

  void Add(
    const Words& words, vtkIdType count, double value, const char* association, vtkIdType firstId)
  {
    this->Name->InsertNextValue(words.name);
    this->Count->InsertNextValue(count);
    this->Value->InsertNextValue(value);
    this->Association->InsertNextValue(association);
    this->FirstId->InsertNextValue(firstId);
    this->Meaning->InsertNextValue(words.meaning);
    this->Consequence->InsertNextValue(words.consequence);
  }

private:
  vtkNew<vtkStringArray> Name, Association, Meaning, Consequence;
  vtkNew<vtkIdTypeArray> Count, FirstId;
  vtkNew<vtkDoubleArray> Value;
};

double Share(vtkIdType part, vtkIdType whole)
{
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

vtkIdType CellOf(const WholeSurface& surface, int triangle)
{
  return triangle >= 0 ? surface.Cells[triangle] : -1;
}

/// What a defect is counted among.
vtkIdType AllOf(Defect defect, const WholeSurface& surface, const MeshDiagnosis& d)
{
  switch (defect)
  {
    case Defect::NonFinitePoints:
    case Defect::CoincidentPoints:
    case Defect::UnusedPoints:
      return surface.Mesh.P.rows();
    case Defect::NonManifoldPoints:
      return d.points;
    case Defect::DegenerateTriangles:
      return surface.Mesh.F.rows();
    case Defect::DuplicateTriangles:
    case Defect::Slivers:
    case Defect::ObtuseTriangles:
      return d.usableTriangles;
    case Defect::NonManifoldEdges:
    case Defect::BorderEdges:
    case Defect::MisorientedEdges:
    case Defect::NegativeWeights:
      return d.edges;
    case Defect::InsideOutComponents:
      break;
  }
  return d.parts.count;
}

/// Distance from x, above 0, to the next smaller number of the points' type.
double NumberStep(int type, double x)
{
  if (type == VTK_FLOAT)
  {
    const auto y = static_cast<float>(x);
    return static_cast<double>(y) - std::nextafter(y, 0.0F);
  }
  return type == VTK_DOUBLE ? x - std::nextafter(x, 0.0) : 1.0;
}

void ReportNumbers(Report& report, vtkPolyData* input, const MeshDiagnosis& d)
{
  const bool any = d.usableTriangles > 0;
  const bool extreme = any &&
    (d.diagonal < SphericalStyle::SmallestDiagonal || d.diagonal > SphericalStyle::LargestDiagonal);
  report.Add(ScaleWords, extreme, d.diagonal, "", -1);
  const double digits = SphericalStyle::DigitsLeft(
    d.diagonal, any ? NumberStep(input->GetPoints()->GetDataType(), d.largest) : 1.0);
  report.Add(DigitWords, any && digits < SphericalStyle::FewDigits, digits, "", -1);
  const double full = Share(
    std::max<vtkIdType>(input->GetNumberOfPoints(), static_cast<vtkIdType>(d.triangleMarks.size())),
    SphericalStyle::MostTriangles);
  report.Add(SizeWords, full > 0.5, full, "", -1);
}

void MakeTable(
  vtkTable* table, vtkPolyData* input, const WholeSurface& surface, const MeshDiagnosis& d)
{
  Report report(table);
  for (int k = 0; k < SphericalStyle::NumberOfDefects; ++k)
  {
    const auto defect = static_cast<Defect>(k);
    const Finding& found = d[defect];
    const bool ofPoints = IsOfPoints(defect);
    report.Add(DefectWords[k], found.count, Share(found.count, AllOf(defect, surface, d)),
      ofPoints ? "point" : "cell", ofPoints ? found.first : CellOf(surface, found.first));
  }
  report.Add(LoopWords, d.borderLoops.count, 0.0, "point", d.borderLoops.first);
  report.Add(PartWords, d.parts.count, 0.0, "cell", CellOf(surface, d.parts.first));
  report.Add(PolygonWords, surface.FannedPolygons,
    Share(surface.FannedPolygons, input->GetNumberOfPolys()), "cell", surface.FirstFannedPolygon);
  ReportNumbers(report, input, d);
}

/// The sums of the bits.
void AddMask(vtkDataSetAttributes* attributes, const std::vector<unsigned>& marks)
{
  vtkNew<vtkIntArray> mask;
  mask->SetName("Diagnosis");
  mask->SetNumberOfTuples(static_cast<vtkIdType>(marks.size()));
  std::copy(marks.begin(), marks.end(), mask->GetPointer(0));
  attributes->AddArray(mask);
}

/// An array of 0 and 1 for each of the defects from first to last.
void AddMarks(
  vtkDataSetAttributes* attributes, const std::vector<unsigned>& marks, Defect first, Defect last)
{
  for (int k = static_cast<int>(first); k <= static_cast<int>(last); ++k)
  {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetName(DefectWords[k].name);
    array->SetNumberOfTuples(static_cast<vtkIdType>(marks.size()));
    const unsigned bit = Bit(static_cast<Defect>(k));
    std::transform(marks.begin(), marks.end(), array->GetPointer(0),
      [bit](unsigned mark) { return static_cast<unsigned char>((mark & bit) != 0); });
    attributes->AddArray(array);
  }
}

/// Points have the defects of points and edges.
void AddPointMarks(vtkPolyData* output, const std::vector<unsigned>& marks)
{
  AddMask(output->GetPointData(), marks);
  AddMarks(output->GetPointData(), marks, Defect::NonFinitePoints, Defect::NonManifoldPoints);
  AddMarks(output->GetPointData(), marks, Defect::NonManifoldEdges, Defect::NegativeWeights);
}

/// A cell has what one of its triangles has.
void AddCellMarks(vtkPolyData* output, const WholeSurface& surface, const MeshDiagnosis& d)
{
  const vtkIdType n = output->GetNumberOfCells();
  std::vector<unsigned> marks(n, 0);
  vtkNew<vtkIntArray> component;
  component->SetName("Component");
  component->SetNumberOfTuples(n);
  component->FillValue(-1);
  for (std::size_t f = 0; f < surface.Cells.size(); ++f)
  {
    const vtkIdType cell = surface.Cells[f];
    marks[cell] |= d.triangleMarks[f];
    component->SetValue(cell, std::max(component->GetValue(cell), d.components[f]));
  }
  AddMask(output->GetCellData(), marks);
  AddMarks(output->GetCellData(), marks, Defect::DegenerateTriangles, Defect::InsideOutComponents);
  output->GetCellData()->AddArray(component);
}
}

//------------------------------------------------------------------------------------------------
vtkSurfaceDiagnostics::vtkSurfaceDiagnostics()
{
  this->SetNumberOfOutputPorts(2);
}

int vtkSurfaceDiagnostics::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  TakeDataSet(info);
  return 1;
}

int vtkSurfaceDiagnostics::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkSurfaceDiagnostics::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(this, outputVector, [&] { return this->Execute(inputVector, outputVector); });
}

int vtkSurfaceDiagnostics::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  vtkTable* table = vtkTable::GetData(outputVector, 1);
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!input || (input->GetNumberOfPoints() == 0 && input->GetNumberOfCells() == 0))
  {
    return 1;
  }
  this->SetProgressText("Inspecting");
  Require(std::isfinite(this->SliverAngle), "SliverAngle", "finite", this->SliverAngle);
  const WholeSurface surface = vtkSurfaceMeshConversion::Whole(input);
  this->UpdateProgress(0.3);
  const MeshDiagnosis diagnosis = SphericalStyle::Diagnose(
    surface.Mesh.P, surface.Mesh.F, { this->WeldCoincidentPoints, this->SliverAngle });
  output->ShallowCopy(input);
  AddPointMarks(output, diagnosis.pointMarks);
  AddCellMarks(output, surface, diagnosis);
  MakeTable(table, input, surface, diagnosis);
  return 1;
}

void vtkSurfaceDiagnostics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SliverAngle: " << this->SliverAngle << "\n";
  os << indent << "WeldCoincidentPoints: " << OnOff(this->WeldCoincidentPoints) << "\n";
}
