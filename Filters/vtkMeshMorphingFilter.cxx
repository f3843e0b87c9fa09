// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshMorphingFilter.h"

#include "CarriedField.h"
#include "VolumeMorphing.h"
#include "vtkFilterSupport.h"
#include "vtkSurfaceMeshConversion.h"
#include "vtkTurnedArrays.h"
#include "vtkVolumeCells.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkStaticPointLocator.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using SphericalStyle::Points;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkMeshMorphingFilter);

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
/// Of the diagonal: how far a point of the boundary may be from its point of the surface.
constexpr double Tolerance = 1e-6;
constexpr double Farthest = 1e300;               // coordinate, as of all points
constexpr vtkIdType MostPoints = 2147483647 / 3; // rows of the linear system

/// The surface as it was at rest, all points, and what moved them.
struct MovedSurface
{
  vtkSmartPointer<vtkPolyData> Rest;
  Points Displacements; ///< of its points
  double Largest = 0.0; ///< coordinate
  bool Single = false;  ///< whether points have single precision
};

/// @throw std::invalid_argument
MovedSurface FindRest(vtkPolyData* surface)
{
  const vtkIdType n = surface->GetNumberOfPoints();
  vtkDataArray* displacement = surface->GetPointData()->GetArray("Displacement");
  if (!displacement || displacement->GetNumberOfComponents() != 3 ||
    displacement->GetNumberOfTuples() != n)
  {
    throw std::invalid_argument("there is no point array Displacement with 3 components for each "
                                "point; Spherical Style makes it (GenerateDisplacement)");
  }
  MovedSurface moved;
  const Points x = vtkSurfaceMeshConversion::PointsOf(surface);
  moved.Largest = x.cwiseAbs().maxCoeff();
  moved.Displacements.resize(n, 3);
  vtkNew<vtkPoints> rest;
  rest->SetDataTypeToDouble();
  rest->SetNumberOfPoints(n);
  for (vtkIdType i = 0; i < n; ++i)
  {
    displacement->GetTuple(i, moved.Displacements.row(i).data());
    const Eigen::RowVector3d place = x.row(i) - moved.Displacements.row(i);
    if (!(place.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= Farthest))
    {
      std::ostringstream message;
      message << "Displacement of point " << i << " is not finite, or leads too far away: ("
              << moved.Displacements.row(i) << ")";
      throw std::invalid_argument(message.str());
    }
    rest->SetPoint(i, place.data());
  }
  moved.Single = surface->GetPoints()->GetDataType() != VTK_DOUBLE;
  moved.Rest = vtkSmartPointer<vtkPolyData>::New();
  moved.Rest->CopyStructure(surface);
  moved.Rest->SetPoints(rest);
  return moved;
}

/// The field that the surface carries the space around it with.
SphericalStyle::CarriedField MakeField(const MovedSurface& surface, int threads)
{
  const vtkSurfaceMesh mesh = vtkSurfaceMeshConversion::FromPolyData(surface.Rest, true);
  Points Q = mesh.Mesh.P;
  Q += surface.Displacements(mesh.FirstInputPoints(), SphericalStyle::AllColumns);
  return { mesh.Mesh, Q, threads };
}

/// Runs a step on the surface; what it throws is about the second input.
template <typename Step>
auto OfSurface(const Step& step)
{
  try
  {
    return step();
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(std::string("Surface: ") + error.what());
  }
}

/// VTK_FLOAT or VTK_DOUBLE
int OutputType(vtkDataSet* input)
{
  auto* points = vtkPointSet::SafeDownCast(input);
  return points && points->GetPoints() && points->GetPoints()->GetDataType() == VTK_FLOAT
    ? VTK_FLOAT
    : VTK_DOUBLE;
}

/// n cells with the first flag among them, in words; empty for none.
struct Flagged
{
  vtkIdType Count = 0;
  vtkIdType First = -1;
  double Smallest = std::numeric_limits<double>::infinity();

  void Add(vtkIdType cell, double jacobian)
  {
    this->First = this->Count == 0 ? cell : this->First;
    this->Smallest = std::min(this->Smallest, jacobian);
    ++this->Count;
  }
  std::string Text() const
  {
    std::ostringstream text;
    text << ::Count(this->Count, "cell") << (this->Count == 1 ? " is" : " are")
         << " inverted, the first is cell " << this->First << "; the smallest scaled Jacobian is "
         << this->Smallest;
    return text.str();
  }
};

void AddNumber(vtkFieldData* data, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data->AddArray(array);
}
}

struct vtkMeshMorphingFilter::Execution
{
  vtkDataSet* Input = nullptr;
  vtkPointSet* Output = nullptr;
  Points P; ///< of the input
  Points Q; ///< of the output
  MovedSurface Surface;
  vtkVolumeCells::Volume Volume;
  std::vector<char> Fixed;            ///< points of the boundary
  Eigen::VectorXd Before;             ///< scaled Jacobians
  bool HasNormals = false;            ///< of points or cells
  bool Turns = false;                 ///< normals or vectors
  SphericalStyle::Matrices Rotations; ///< of the points, if any turn
  int Threads = 1;
};

//------------------------------------------------------------------------------------------------
vtkMeshMorphingFilter::vtkMeshMorphingFilter()
{
  NoteBlocks(this);
  this->SetNumberOfInputPorts(2);
}

void vtkMeshMorphingFilter::SetSurfaceConnection(vtkAlgorithmOutput* surface)
{
  this->SetInputConnection(SURFACE, surface);
}

void vtkMeshMorphingFilter::SetSurfaceData(vtkPolyData* surface)
{
  this->SetInputData(SURFACE, surface);
}

int vtkMeshMorphingFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), port == SURFACE ? "vtkPolyData" : "vtkDataSet");
  if (port == SURFACE)
  {
    info->Set(INPUT_IS_OPTIONAL(), 1); // Execute says in words that it is missing
  }
  return 1;
}

int vtkMeshMorphingFilter::RequestDataObject(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* input = vtkDataSet::GetData(inputVector[0], 0);
  if (!input || vtkPointSet::SafeDownCast(input))
  {
    return this->Superclass::RequestDataObject(request, inputVector, outputVector);
  }
  if (!vtkStructuredGrid::GetData(outputVector, 0))
  {
    vtkNew<vtkStructuredGrid> grid;
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), grid);
  }
  return 1;
}

int vtkMeshMorphingFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(this, outputVector,
    [&]
    {
      try
      {
        return this->Execute(inputVector, outputVector);
      }
      catch (const SphericalStyle::SolveAborted&)
      {
        vtkDataObject::GetData(outputVector, 0)->Initialize();
        return 1;
      }
    });
}

int vtkMeshMorphingFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->NumberOfVolumeCells = this->NumberOfInvertedCells = 0;
  this->SmallestScaledJacobianBefore = this->SmallestScaledJacobianAfter = NaN;
  this->NumberOfIterations = 0;
  Execution e;
  e.Input = vtkDataSet::GetData(inputVector[0], 0);
  e.Output = vtkPointSet::GetData(outputVector, 0);
  vtkPolyData* surface = vtkPolyData::GetData(inputVector[SURFACE], 0);
  if (!e.Input || e.Input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  if (e.Input->GetNumberOfPoints() > MostPoints)
  {
    throw std::invalid_argument("more than " + std::to_string(MostPoints) + " points");
  }
  if (!surface)
  {
    throw std::invalid_argument(
      "Surface: choose what Spherical Style makes of Extract Surface of this mesh, "
      "so that the mesh can follow it");
  }
  if (surface->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument("Surface: it has no points; take the surface of the input, rounded "
                                "(Extract Surface, then Spherical Style)");
  }
  const auto withoutEmptyArrays = vtkSurfaceMeshConversion::WithoutEmptyArrays(e.Input);
  e.Input = withoutEmptyArrays;
  e.Threads = ThreadsToUse(0);
  e.HasNormals = e.Input->GetPointData()->GetNormals() || e.Input->GetCellData()->GetNormals();
  e.Turns = e.HasNormals || this->TransformAllInputVectors;
  e.P = vtkSurfaceMeshConversion::PointsOf(e.Input);
  e.Q = e.P;
  e.Volume = vtkVolumeCells::FromDataSet(e.Input, e.P);
  vtkSurfaceMeshConversion::CheckArrays(e.Input);
  e.Surface = OfSurface([&] { return FindRest(surface); });
  this->GoOn(0.05);
  if (!e.Volume.Cells.empty())
  {
    this->MoveVolume(e);
  }
  this->GoOn(0.6);
  this->MoveOthers(e);
  this->FillOutput(e);
  this->GoOn(1.0);
  return 1;
}

/// Sets Q of the points of volume cells, and Fixed.
void vtkMeshMorphingFilter::MoveVolume(Execution& e)
{
  const SphericalStyle::VolumeMesh& mesh = e.Volume.Mesh;
  this->NumberOfVolumeCells = static_cast<vtkIdType>(e.Volume.Cells.size());
  e.Before = ScaledJacobians(mesh, mesh.P, e.Threads);
  this->SmallestScaledJacobianBefore = e.Before.minCoeff();
  e.Fixed = BoundaryPoints(mesh);

  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(e.Surface.Rest);
  locator->BuildLocator();
  const double rounding = e.Surface.Single ? 4.0 * std::numeric_limits<float>::epsilon() : 0.0;
  const double far = std::max(Tolerance * e.Input->GetLength(), rounding * e.Surface.Largest);
  Points displacements = Points::Zero(e.P.rows(), 3);
  for (Eigen::Index i = 0; i < e.P.rows(); ++i)
  {
    if (!e.Fixed[i])
    {
      continue;
    }
    const vtkIdType k = locator->FindClosestPoint(e.P.row(i).data());
    Eigen::RowVector3d rest;
    e.Surface.Rest->GetPoint(k, rest.data());
    const double distance = (rest - e.P.row(i)).norm();
    if (!(distance <= far))
    {
      std::ostringstream message;
      message << "point " << i << " on the boundary of the volume is no point of the surface, of "
              << "which the nearest is " << distance << " away; take the surface of this input "
              << "(Extract Surface), rounded in one piece";
      auto* controller = vtkMultiProcessController::GetGlobalController();
      if (controller && controller->GetNumberOfProcesses() > 1)
      {
        message << ". A mesh that is spread over processes has a boundary where its parts meet: "
                << "bring it to one process (Aggregate Dataset) before Extract Surface";
      }
      throw std::invalid_argument(message.str());
    }
    displacements.row(i) = e.Surface.Displacements.row(k);
  }

  Flagged byBoundary;
  const Points onBoundary = e.P + displacements;
  const std::vector<char> flags = InvertedByBoundary(mesh, e.Fixed, onBoundary);
  for (std::size_t c = 0; c < flags.size(); ++c)
  {
    if (const auto cell = static_cast<int>(c); flags[c] && e.Before[cell] > 0.0)
    {
      byBoundary.Add(e.Volume.Cells[c], ScaledJacobian(mesh, cell, onBoundary));
    }
  }
  if (byBoundary.Count > 0)
  {
    throw std::invalid_argument("at a corner with all of its points on the surface " +
      byBoundary.Text() +
      ", and no motion of inner points changes that; round less (Roundness), or cut these cells");
  }
  const SphericalStyle::MorphedVolume result = MorphVolume(mesh, e.Fixed, displacements, e.Threads,
    [this](int step, double)
    {
      this->GoOn(0.1 + 0.5 * step / (step + 10.0));
      return true;
    });
  this->NumberOfIterations = result.iterations;
  e.Q = result.P;
  if (e.Turns)
  {
    e.Rotations = VolumeRotations(mesh, e.Q, e.Threads);
  }
}

/// Sets Q of the points of no volume cell.
void vtkMeshMorphingFilter::MoveOthers(Execution& e)
{
  const std::vector<char> used = UsedPoints(e.Volume.Mesh);
  std::vector<Eigen::Index> others;
  for (Eigen::Index i = 0; i < e.P.rows(); ++i)
  {
    if (!used[i])
    {
      others.push_back(i);
    }
  }
  if (others.empty())
  {
    return;
  }
  const SphericalStyle::CarriedField field =
    OfSurface([&] { return MakeField(e.Surface, e.Threads); });
  constexpr std::size_t block = 20000; // points between two looks for an abort
  for (std::size_t begin = 0; begin < others.size(); begin += block)
  {
    const std::size_t end = std::min(begin + block, others.size());
    const std::vector<Eigen::Index> some(others.begin() + static_cast<std::ptrdiff_t>(begin),
      others.begin() + static_cast<std::ptrdiff_t>(end));
    const Points x = e.P(some, SphericalStyle::AllColumns);
    const Points u = field.At(x, e.Threads);
    for (std::size_t k = 0; k < some.size(); ++k)
    {
      e.Q.row(some[k]) += u.row(static_cast<Eigen::Index>(k));
    }
    if (e.Turns)
    {
      const SphericalStyle::Matrices R = field.RotationsAt(x, e.Threads);
      e.Rotations.resize(e.P.rows(), Eigen::Matrix3d::Identity());
      for (std::size_t k = 0; k < some.size(); ++k)
      {
        e.Rotations[some[k]] = R[k];
      }
    }
    this->GoOn(0.6 + 0.35 * static_cast<double>(end) / static_cast<double>(others.size()));
  }
}

void vtkMeshMorphingFilter::FillOutput(const Execution& e)
{
  const vtkIdType n = e.Input->GetNumberOfPoints();
  const int type = OutputType(e.Input);
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  points->SetNumberOfPoints(n);
  const auto displacement =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  displacement->SetName("Displacement");
  displacement->SetNumberOfComponents(3);
  displacement->SetNumberOfTuples(n);
  for (vtkIdType i = 0; i < n; ++i)
  {
    const Eigen::RowVector3d u = e.Q.row(i) - e.P.row(i);
    points->SetPoint(i, e.Q.row(i).data());
    displacement->SetTuple(i, u.data());
    double x[3];
    points->GetPoint(i, x);
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
    {
      throw std::range_error(
        "point " + std::to_string(i) + " would be beyond the range of its number type");
    }
  }
  if (auto* image = vtkImageData::SafeDownCast(e.Input))
  {
    vtkStructuredGrid::SafeDownCast(e.Output)->SetExtent(image->GetExtent());
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(e.Input))
  {
    vtkStructuredGrid::SafeDownCast(e.Output)->SetExtent(rectilinear->GetExtent());
  }
  else
  {
    e.Output->CopyStructure(e.Input);
  }
  e.Output->SetPoints(points);
  e.Output->GetPointData()->ShallowCopy(e.Input->GetPointData());
  e.Output->GetCellData()->ShallowCopy(e.Input->GetCellData());
  e.Output->GetFieldData()->ShallowCopy(e.Input->GetFieldData());
  const auto rotationOf = [&e](vtkIdType i) -> const Eigen::Matrix3d*
  {
    const Eigen::Matrix3d& R = e.Rotations[i];
    return R == Eigen::Matrix3d::Identity() ? nullptr : &R;
  };
  if (this->TransformAllInputVectors)
  {
    vtkTurnedArrays::Turn(e.Output, rotationOf);
  }
  if (e.HasNormals)
  {
    vtkTurnedArrays::TurnNormals(e.Output, rotationOf);
  }
  e.Output->GetPointData()->AddArray(displacement);
  if (!e.Volume.Cells.empty())
  {
    this->JudgeVolume(e);
  }
}

/// Says what became of the cells, as they are in the output.
void vtkMeshMorphingFilter::JudgeVolume(const Execution& e)
{
  const SphericalStyle::VolumeMesh& mesh = e.Volume.Mesh;
  const Eigen::VectorXd after =
    ScaledJacobians(mesh, vtkSurfaceMeshConversion::PointsOf(e.Output), e.Threads);
  this->SmallestScaledJacobianAfter = after.minCoeff();
  Flagged inverted;
  Flagged asBefore;
  for (Eigen::Index cell = 0; cell < after.size(); ++cell)
  {
    if (!(after[cell] > 0.0))
    {
      (e.Before[cell] > 0.0 ? inverted : asBefore).Add(e.Volume.Cells[cell], after[cell]);
    }
  }
  this->NumberOfInvertedCells = inverted.Count + asBefore.Count;
  if (inverted.Count > 0)
  {
    throw std::invalid_argument(inverted.Text() +
      ". No positions of the inner points without inverted cells were found: round less "
      "(Roundness), or refine the input there");
  }
  if (asBefore.Count > 0)
  {
    Warn(this, "as in the input, " + asBefore.Text());
  }
  AddNumber(
    e.Output->GetFieldData(), "SmallestScaledJacobianBefore", this->SmallestScaledJacobianBefore);
  AddNumber(
    e.Output->GetFieldData(), "SmallestScaledJacobianAfter", this->SmallestScaledJacobianAfter);
}

/// @throw SphericalStyle::SolveAborted
void vtkMeshMorphingFilter::GoOn(double progress)
{
  this->UpdateProgress(progress);
  if (Aborted(this))
  {
    throw SphericalStyle::SolveAborted();
  }
}

void vtkMeshMorphingFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TransformAllInputVectors: " << OnOff(this->TransformAllInputVectors) << "\n";
  os << indent << "NumberOfVolumeCells: " << this->NumberOfVolumeCells << "\n";
  os << indent << "NumberOfInvertedCells: " << this->NumberOfInvertedCells << "\n";
  os << indent << "SmallestScaledJacobianBefore: " << this->SmallestScaledJacobianBefore << "\n";
  os << indent << "SmallestScaledJacobianAfter: " << this->SmallestScaledJacobianAfter << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
}
