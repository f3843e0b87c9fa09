// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPrintableFilter.h"

#include "Callback.h"
#include "ClosedSurface.h"
#include "ManifoldSurface.h"
#include "Orientation.h"
#include "Printable.h"
#include "SurfaceMeasures.h"
#include "vtkFilterSupport.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using SphericalStyle::DerivedSurface;
using SphericalStyle::Points;
using SphericalStyle::PrintableMeasures;
using SphericalStyle::PrintableResult;
using SphericalStyle::TriangleMesh;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkPrintableFilter);

namespace
{
/// A surface without holes, and where it comes from.
struct ClosedInput
{
  TriangleMesh Mesh;
  std::vector<vtkIdType> InputPoints; // of each point
  std::vector<vtkIdType> InputCells;  // of each triangle; -1 in filled holes
  int NonManifoldEdges = 0;           // of the input
  int HolesClosed = 0;
};

/// For each point the nearest of the first n.
void TakeNearest(const Points& P, Eigen::Index n, std::vector<vtkIdType>& inputPoints)
{
  if (n == P.rows())
  {
    return;
  }
  vtkNew<vtkPoints> first;
  first->SetDataTypeToDouble();
  first->SetNumberOfPoints(n);
  for (Eigen::Index i = 0; i < n; ++i)
  {
    first->SetPoint(i, P.row(i).data());
  }
  vtkNew<vtkPolyData> points;
  points->SetPoints(first);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(points);
  locator->BuildLocator();
  for (Eigen::Index i = n; i < P.rows(); ++i)
  {
    inputPoints.push_back(inputPoints[locator->FindClosestPoint(P.row(i).data())]);
  }
}

/// @throw std::invalid_argument naming the first point where the surface cannot be closed
ClosedInput Close(const vtkSurfaceMesh& surface, bool closeHoles)
{
  ClosedInput closed;
  closed.InputPoints = surface.FirstInputPoints();
  const auto at = [&](int point) { return std::to_string(closed.InputPoints[point]); };
  closed.NonManifoldEdges = SphericalStyle::FindOpenEdges(surface.Mesh.F).nonManifold;
  const std::vector<int> kept = SphericalStyle::WithoutRepetitions(surface.Mesh.F);
  const SphericalStyle::Triangles F = surface.Mesh.F(kept, SphericalStyle::AllColumns);
  DerivedSurface manifold =
    SphericalStyle::Underived({ surface.Mesh.P, SphericalStyle::OrientOutward(surface.Mesh.P, F) });
  manifold.triangles = kept;
  SphericalStyle::MakeManifold(manifold);
  for (std::size_t i = closed.InputPoints.size(); i < manifold.ends.size(); ++i)
  {
    closed.InputPoints.push_back(closed.InputPoints[manifold.ends[i][0]]);
  }
  for (const int f : manifold.triangles)
  {
    closed.InputCells.push_back(surface.GetCell(f));
  }
  closed.Mesh = manifold.mesh;
  SphericalStyle::OpenEdges open = SphericalStyle::FindOpenEdges(closed.Mesh.F);
  if (open.borders == 0)
  {
    return closed;
  }
  if (!closeHoles)
  {
    throw std::invalid_argument("The surface is open: it has " +
      Count(open.borders, "border edge") + ", the first at point " + at(open.firstBorder) +
      ". CloseHoles fills the holes; Surface Diagnostics shows them");
  }
  const Eigen::Index before = closed.Mesh.P.rows();
  closed.HolesClosed = SphericalStyle::FillHoles(closed.Mesh);
  TakeNearest(closed.Mesh.P, before, closed.InputPoints);
  closed.InputCells.resize(closed.Mesh.F.rows(), -1);
  open = SphericalStyle::FindOpenEdges(closed.Mesh.F);
  if (open.borders + open.nonManifold + open.misoriented > 0)
  {
    throw std::invalid_argument("CloseHoles: a hole cannot be filled, at point " +
      at(std::max({ open.firstBorder, open.firstNonManifold, open.firstMisoriented })) +
      "; close it in a modeling program");
  }
  closed.Mesh.F = SphericalStyle::OrientOutward(closed.Mesh.P, closed.Mesh.F);
  return closed;
}

/// @throw std::invalid_argument where there is nothing to print
vtkSurfaceMesh ReadSurface(vtkPrintableFilter* self, vtkPolyData* input)
{
  vtkSurfaceMesh surface = vtkSurfaceMeshConversion::FromPolyData(input, true);
  vtkSurfaceMeshConversion::CheckArrays(input); // new points take values from all of them
  Warn(self, vtkSurfaceMeshConversion::FannedRemark(surface));
  Warn(self, vtkSurfaceMeshConversion::SkippedRemark(surface));
  if (surface.Mesh.F.rows() == 0)
  {
    throw std::invalid_argument("There is no triangle with an area, so there is nothing to print");
  }
  return surface;
}

/// z up, on the plate.
Points OnPlate(const Points& P, int axis)
{
  Points placed(P.rows(), 3);
  for (int k = 0; k < 3; ++k)
  {
    const PlateAxis from = PlateAxes(axis)[k];
    const Eigen::VectorXd x = from.Sign * P.col(from.Axis);
    placed.col(k) = x.array() - (k == 2 ? x.minCoeff() : 0.5 * (x.minCoeff() + x.maxCoeff()));
  }
  return placed;
}

/// Of coordinates: of those of double precision a volume is measured.
double Largest(int type)
{
  return type == VTK_FLOAT ? std::numeric_limits<float>::max() : 1e100;
}

void FillOutput(vtkPolyData* output, vtkPolyData* input, const ClosedInput& closed,
  const DerivedSurface& made, int type)
{
  vtkPointData* data = output->GetPointData();
  const auto n = static_cast<vtkIdType>(made.mesh.P.rows());
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  points->SetNumberOfPoints(n);
  data->CopyNormalsOff();
  data->InterpolateAllocate(input->GetPointData(), n);
  for (vtkIdType i = 0; i < n; ++i)
  {
    if (!(made.mesh.P.row(i).cwiseAbs().maxCoeff() <= Largest(type)))
    {
      throw std::range_error("point " + std::to_string(i) + " is beyond what " +
        (type == VTK_FLOAT ? "single" : "double") +
        " precision can hold and measure; make Height, Volume or the model smaller");
    }
    points->SetPoint(i, made.mesh.P.row(i).data());
    const vtkIdType first = closed.InputPoints[made.ends[i][0]];
    const vtkIdType second = closed.InputPoints[made.ends[i][1]];
    if (made.shares[i] == 0.0)
    {
      data->CopyData(input->GetPointData(), first, i);
    }
    else
    {
      data->InterpolateEdge(input->GetPointData(), i, first, second, made.shares[i]);
    }
  }
  const auto m = static_cast<vtkIdType>(made.mesh.F.rows());
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(m, 3 * m);
  vtkNew<vtkUnsignedCharArray> foot;
  foot->SetName("Foot");
  foot->SetNumberOfValues(m);
  vtkCellData* cells = output->GetCellData();
  cells->CopyNormalsOff();
  cells->CopyAllocate(input->GetCellData(), m);
  cells->SetNumberOfTuples(m); // NullData passes over strings
  for (vtkIdType f = 0; f < m; ++f)
  {
    const vtkIdType corners[3] = { made.mesh.F(f, 0), made.mesh.F(f, 1), made.mesh.F(f, 2) };
    triangles->InsertNextCell(3, corners);
    const vtkIdType cell = made.triangles[f] < 0 ? -1 : closed.InputCells[made.triangles[f]];
    foot->SetValue(f, cell < 0 ? 1 : 0);
    if (cell < 0)
    {
      cells->NullData(f);
    }
    else
    {
      cells->CopyData(input->GetCellData(), cell, f);
    }
  }
  output->SetPoints(points);
  output->SetPolys(triangles);
  cells->AddArray(foot);
  output->GetFieldData()->ShallowCopy(input->GetFieldData());
}

/// Whether points at one place have one normal, so that the surface has no creases.
bool AreSmooth(vtkDataArray* normals, const vtkSurfaceMesh& surface)
{
  constexpr double Alike = 0.99; // cosine: 8 degrees
  const std::vector<vtkIdType> first = surface.FirstInputPoints();
  for (vtkIdType i = 0; i < static_cast<vtkIdType>(surface.MeshPoint.size()); ++i)
  {
    const int to = surface.MeshPoint[i];
    if (to >= 0 && first[to] != i)
    {
      Eigen::Vector3d own, other;
      normals->GetTuple(i, own.data());
      normals->GetTuple(first[to], other.data());
      if (!(own.stableNormalized().dot(other.stableNormalized()) >= Alike))
      {
        return false;
      }
    }
  }
  return true;
}

/// Those of the surface without its foot, so that it is shaded as before down to the foot's border.
/// The foot itself is shaded as what is above its border.
/// @param isOfModel  of each triangle
void AddNormals(vtkPolyData* output, vtkDataArray* before, const TriangleMesh& mesh,
  const std::vector<char>& isOfModel)
{
  SphericalStyle::Triangles F(mesh.F.rows(), 3);
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    if (isOfModel[f])
    {
      F.row(kept++) = mesh.F.row(f);
    }
  }
  F.conservativeResize(kept, 3);
  const Points ofModel = SphericalStyle::PointNormals(mesh.P, F);
  const Points all = SphericalStyle::PointNormals(mesh.P, mesh.F);
  const auto normals = vtkSmartPointer<vtkDataArray>::Take(before->NewInstance());
  normals->SetName(before->GetName() ? before->GetName() : "Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(mesh.P.rows());
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    normals->SetTuple(i, (ofModel.row(i).isZero(0.0) ? all : ofModel).row(i).data());
  }
  output->GetPointData()->SetNormals(normals);
}

/// NaN where there is no other side.
void AddThickness(vtkPolyData* output, const Eigen::VectorXd& thickness, int type)
{
  const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName("WallThickness");
  array->SetNumberOfTuples(thickness.size());
  for (Eigen::Index i = 0; i < thickness.size(); ++i)
  {
    array->SetTuple1(i, std::isfinite(thickness(i)) ? thickness(i) : std::nan(""));
  }
  output->GetPointData()->AddArray(array);
}

/// Of walls that stayed thinner than wanted; empty where there are none.
std::string ThinRemark(const PrintableResult& result, double wanted)
{
  const Eigen::VectorXd& thickness = result.thickness;
  Eigen::Index thinnest = 0;
  const double least = thickness.minCoeff(&thinnest);
  if (!(least < wanted))
  {
    return {};
  }
  const auto count = static_cast<vtkIdType>((thickness.array() < wanted).count());
  std::ostringstream text;
  text.precision(3);
  text
    << "MinimumThickness: walls stay thinner than " << wanted << " at " << Count(count, "point")
    << ", the thinnest with " << least << " at point " << thinnest
    << (result.isSizeShort
           ? ", because with thicker walls the model is larger, and scaled back to its size its "
             "walls are no thicker"
           : ", where the surface would run through itself, or where a cut leaves a sharp rim on "
             "the plate")
    << "; the array WallThickness shows them. Choose a larger Height or a smaller "
       "MinimumThickness; a slicer leaves out what is thinner than its line";
  return text.str();
}

void MakeTable(vtkTable* table, const PrintableResult& result, const ClosedInput& closed)
{
  table->Initialize(); // an observer of progress may have asked for an update, which filled it
  vtkNew<vtkStringArray> names, units;
  vtkNew<vtkDoubleArray> before, after;
  const auto add = [&](const char* name, double old, double made, const char* unit)
  {
    names->InsertNextValue(name);
    before->InsertNextValue(old);
    after->InsertNextValue(made);
    units->InsertNextValue(unit);
  };
  const auto orNaN = [](double x) { return std::isfinite(x) ? x : std::nan(""); };
  const PrintableMeasures& old = result.before;
  const PrintableMeasures& made = result.after;
  add("FootLevel", old.footLevel, made.footLevel, "length");
  add("FootArea", old.footArea, made.footArea, "length^2");
  add("Height", old.height, made.height, "length");
  add("Volume", old.volume, made.volume, "length^3");
  const char* centers[3] = { "CenterOfMassX", "CenterOfMassY", "CenterOfMassZ" };
  for (int k = 0; k < 3; ++k)
  {
    add(centers[k], old.centerOfMass(k), made.centerOfMass(k), "length");
  }
  add("MinimumThickness", orNaN(old.thickness), orNaN(made.thickness), "length");
  add("TiltAngle", old.tiltAngle, made.tiltAngle, "degrees");
  add("CutDepth", 0.0, result.cutDepth * result.factor, "length");
  add("Lean", 0.0, result.lean, "degrees");
  add("Thickened", 0.0, result.thickened * result.factor, "length");
  add("Factor", 1.0, result.factor, "");
  add("HolesClosed", 0.0, closed.HolesClosed, "");
  add("NonManifoldEdges", closed.NonManifoldEdges, 0.0, "");
  add("Points", static_cast<double>(closed.Mesh.P.rows()),
    static_cast<double>(result.surface.mesh.P.rows()), "");
  add("Triangles", static_cast<double>(closed.Mesh.F.rows()),
    static_cast<double>(result.surface.mesh.F.rows()), "");
  add("SelfIntersectingTriangles", old.selfIntersecting, made.selfIntersecting, "");
  AddColumn(table, names, "Name");
  AddColumn(table, before, "Before");
  AddColumn(table, after, "After");
  AddColumn(table, units, "Unit");
}
}

//------------------------------------------------------------------------------------------------
vtkPrintableFilter::vtkPrintableFilter()
{
  NoteBlocks(this);
  this->SetNumberOfOutputPorts(2);
}

vtkPrintableFilter::~vtkPrintableFilter() = default;

int vtkPrintableFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  TakeDataSet(info);
  return 1;
}

int vtkPrintableFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkPrintableFilter::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(this, outputVector, [&] { return this->Execute(inputVector, outputVector); });
}

void vtkPrintableFilter::CheckProperties() const
{
  Require(!std::isnan(this->FootArea), "FootArea", "a number from 0 to 1", this->FootArea);
  Require(!std::isnan(this->StabilityAngle), "StabilityAngle", "a number from 0 to 45",
    this->StabilityAngle);
  for (const auto& [name, value] : { std::make_pair("MinimumThickness", this->MinimumThickness),
         std::make_pair("Volume", this->Volume), std::make_pair("Height", this->Height) })
  {
    Require(value >= 0.0 && std::isfinite(value), name, "0 or more", value);
  }
  if (this->Volume > 0.0 && this->Height > 0.0)
  {
    throw std::invalid_argument(
      "Volume and Height: the model cannot be scaled to both; set one of them to 0");
  }
}

int vtkPrintableFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  this->Factor = 1.0;
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  this->CheckProperties();
  const vtkSurfaceMesh surface = ReadSurface(this, input);
  this->SetProgressText("Making the model printable");
  this->UpdateProgress(0.1);
  const ClosedInput closed = Close(surface, this->CloseHoles);
  if (Aborted(this))
  {
    return 1; // nothing comes out, as everywhere in VTK
  }
  SphericalStyle::PrintableOptions options;
  options.axis = this->UpAxis;
  options.footArea = this->FootArea;
  options.stabilityAngle = this->StabilityAngle;
  options.thickness = this->MinimumThickness;
  options.volume = this->Volume;
  options.height = this->Height;
  options.threads = ThreadsToUse(0);
  int steps = 0; // nobody knows how many there will be
  options.onStep = [this, &steps]
  {
    this->UpdateProgress(0.9 - 0.8 * std::pow(0.95, ++steps));
    if (Aborted(this))
    {
      throw SphericalStyle::SolveAborted();
    }
  };
  PrintableResult result;
  try
  {
    result = SphericalStyle::MakePrintable(closed.Mesh, options);
  }
  catch (const SphericalStyle::SolveAborted&)
  {
    return 1; // nothing comes out, as everywhere in VTK
  }
  this->Factor = result.factor;
  this->UpdateProgress(0.9);
  if (this->PlaceOnPlate)
  {
    result.surface.mesh.P = OnPlate(result.surface.mesh.P, this->UpAxis);
  }
  const int type = vtkSurfaceMeshConversion::OutputPointType(input, this->OutputPointsPrecision);
  FillOutput(output, input, closed, result.surface, type);
  vtkDataArray* normals = input->GetPointData()->GetNormals();
  if (normals && AreSmooth(normals, surface))
  {
    std::vector<char> isOfModel;
    for (const int triangle : result.surface.triangles)
    {
      isOfModel.push_back(triangle >= 0 && closed.InputCells[triangle] >= 0 ? 1 : 0);
    }
    AddNormals(output, normals, result.surface.mesh, isOfModel);
  }
  AddThickness(output, result.thickness, type);
  AddCount(output->GetFieldData(), "UpAxis", this->PlaceOnPlate ? Z_AXIS : this->UpAxis);
  Warn(this, ThinRemark(result, this->MinimumThickness));
  for (const std::string& remark : result.remarks)
  {
    Warn(this, remark);
  }
  MakeTable(vtkTable::GetData(outputVector, 1), result, closed);
  return 1;
}

void vtkPrintableFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FootArea: " << this->FootArea << "\n";
  os << indent << "StabilityAngle: " << this->StabilityAngle << "\n";
  os << indent << "MinimumThickness: " << this->MinimumThickness << "\n";
  os << indent << "Volume: " << this->Volume << "\n";
  os << indent << "Height: " << this->Height << "\n";
  os << indent << "CloseHoles: " << OnOff(this->CloseHoles) << "\n";
  os << indent << "PlaceOnPlate: " << OnOff(this->PlaceOnPlate) << "\n";
  os << indent << "UpAxis: " << this->UpAxis << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "Factor: " << this->Factor << "\n";
}
