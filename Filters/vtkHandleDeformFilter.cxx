// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHandleDeformFilter.h"

#include "Handles.h"
#include "vtkFilterSupport.h"
#include "vtkIdValues.h"
#include "vtkMovedSurface.h"
#include "vtkStyleHistory.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkDataObject.h"
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
#include <stdexcept>
#include <string>

using SphericalStyle::Handle;
using SphericalStyle::Points;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkHandleDeformFilter);

namespace
{
constexpr double MostDegrees = 36000.0; // a hundred turns: more is a slip of the unit

std::string RowText(std::size_t k)
{
  return "Handle: row " + std::to_string(k + 1);
}

void AddHandleArray(
  vtkPolyData* output, const vtkSurfaceMesh& surface, const std::vector<int>& ofPoints)
{
  vtkNew<vtkIntArray> rows;
  rows->SetName("Handle");
  rows->SetNumberOfTuples(output->GetNumberOfPoints());
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const int point = surface.MeshPoint[i];
    rows->SetValue(i, point == vtkSurfaceMesh::NotMoved ? 0 : ofPoints[point] + 1);
  }
  output->GetPointData()->AddArray(rows);
}
}

/// What is kept between executions.
struct vtkHandleDeformFilter::Internals
{
  SphericalStyle::StyleSolver Solver;
  std::shared_ptr<const vtkSurfaceMesh> Surface; // shared with the solver; or nullptr
};

//------------------------------------------------------------------------------------------------
vtkHandleDeformFilter::vtkHandleDeformFilter()
  : Internal(std::make_unique<Internals>())
{
  this->Tolerance = 1e-5; // points then are within some 1e-4 of the diagonal, see the page
  this->MaximumNumberOfIterations = 500;
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
}

vtkHandleDeformFilter::~vtkHandleDeformFilter() = default;

void vtkHandleDeformFilter::AddHandle(const double row[10])
{
  this->Handles.emplace_back();
  std::copy_n(row, 10, this->Handles.back().begin());
  this->Modified();
}

void vtkHandleDeformFilter::SetHandle(int number, const double row[10])
{
  if (number < 1 || number > this->GetNumberOfHandles())
  {
    vtkErrorMacro(<< "Handle: there is no row " << number << "; there are "
                  << this->GetNumberOfHandles() << ", counted from 1");
    return;
  }
  std::array<double, 10>& handle = this->Handles[number - 1];
  if (!std::equal(handle.begin(), handle.end(), row))
  {
    std::copy_n(row, 10, handle.begin());
    this->Modified();
  }
}

const double* vtkHandleDeformFilter::GetHandle(int number)
{
  return number < 1 || number > this->GetNumberOfHandles() ? nullptr
                                                           : this->Handles[number - 1].data();
}

int vtkHandleDeformFilter::GetNumberOfHandles()
{
  return static_cast<int>(this->Handles.size());
}

void vtkHandleDeformFilter::RemoveAllHandles()
{
  if (!this->Handles.empty())
  {
    this->Handles.clear();
    this->Modified();
  }
}

int vtkHandleDeformFilter::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(
    this, outputVector, [&] { return this->Execute(inputVector, outputVector); },
    [this] { this->Internal = std::make_unique<Internals>(); });
}

/// @throw std::invalid_argument naming the row
std::vector<Handle> vtkHandleDeformFilter::MakeHandles() const
{
  std::vector<Handle> handles;
  for (std::size_t k = 0; k < this->Handles.size(); ++k)
  {
    const std::array<double, 10>& row = this->Handles[k];
    if (!std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); }))
    {
      throw std::invalid_argument(RowText(k) + " has a number that is not finite");
    }
    Handle handle;
    handle.place = Eigen::Vector3d(row.data());
    handle.radius = row[3];
    handle.to = Eigen::Vector3d(&row[4]);
    const Eigen::Vector3d degrees(&row[7]);
    handle.turn = degrees * (SphericalStyle::Pi / 180.0);
    Require(handle.radius >= 0.0, (RowText(k) + ": the radius").c_str(), "0 or more", row[3]);
    if (!(degrees.stableNorm() <= MostDegrees))
    {
      throw std::invalid_argument(RowText(k) +
        " turns by more than 36000 degrees: its rotation is " + Triple(degrees.data()));
    }
    handles.push_back(handle);
  }
  return handles;
}

/// The handle of each mesh point, -1 for none.
std::vector<int> vtkHandleDeformFilter::HoldPoints(
  vtkPolyData* input, const vtkSurfaceMesh& surface, const std::vector<Handle>& handles)
{
  vtkDataArray* array = vtkSurfaceMeshConversion::FindPointArray(
    this->GetInputArrayInformation(0), input, "HandleArray");
  if (!array)
  {
    try
    {
      return SphericalStyle::HandlesOfPoints(surface.Mesh.P, handles);
    }
    catch (const SphericalStyle::PointInTwoHandles& error)
    {
      throw std::invalid_argument(RowText(error.First) + " and row " +
        std::to_string(error.Second + 1) + " both hold point " +
        std::to_string(surface.FirstInputPoint(error.Point)) +
        "; make a radius smaller, or move their places apart");
    }
  }
  const vtkIdValues values(array, "HandleArray", input->GetNumberOfPoints(), "point");
  const auto count = static_cast<vtkIdType>(handles.size());
  std::vector<int> ofPoints;
  std::vector<char> used(handles.size(), 0);
  for (const vtkIdType row : values.OfMesh(surface))
  {
    if (row < 0 || row > count)
    {
      throw std::invalid_argument(values.GetName() + " names row " + std::to_string(row) +
        " at point " + std::to_string(surface.FirstInputPoint(static_cast<int>(ofPoints.size()))) +
        "; there are rows 1 to " + std::to_string(count) + ", and 0 for free points");
    }
    ofPoints.push_back(static_cast<int>(row) - 1);
    if (row > 0)
    {
      used[row - 1] = 1;
    }
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end())
  {
    throw std::invalid_argument(
      values.GetName() + " gives no point to row " + std::to_string(unused - used.begin() + 1));
  }
  return ofPoints;
}

int vtkHandleDeformFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  namespace Conversion = vtkSurfaceMeshConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  SphericalStyle::StyleReport report;
  this->SetLoopFacts(report.loop);
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  const std::vector<Handle> handles = this->MakeHandles();
  Conversion::Update(input, true, this->Internal->Surface);
  const vtkSurfaceMesh& surface = *this->Internal->Surface;
  std::vector<int> ofPoints(surface.Mesh.P.rows(), -1);
  Points Q = surface.Mesh.P;
  report.loop.converged = true;
  if (surface.Mesh.F.rows() > 0 && !handles.empty())
  {
    ofPoints = this->HoldPoints(input, surface, handles);
    if (!std::all_of(handles.begin(), handles.end(), [](const Handle& h) { return h.Stays(); }))
    {
      report = this->Solve(handles, ofPoints);
      Q = this->Internal->Solver.GetPositions();
    }
  }
  output->ShallowCopy(input);
  vtkMovedSurface::Fill(this, output, surface, Q);
  Conversion::AddDisplacement(output, input);
  AddHandleArray(output, surface, ofPoints);
  vtkStyleHistory::Fill(vtkTable::GetData(outputVector, 1), report, nullptr);
  for (const std::string& remark : Conversion::Remarks(surface))
  {
    Warn(this, remark);
  }
  for (const std::string& remark : vtkStyleHistory::Remarks(report))
  {
    Warn(this, remark);
  }
  this->SetLoopFacts(report.loop);
  return 1;
}

SphericalStyle::StyleReport vtkHandleDeformFilter::Solve(
  const std::vector<Handle>& handles, const std::vector<int>& ofPoints)
{
  const std::shared_ptr<const vtkSurfaceMesh>& surface = this->Internal->Surface;
  SphericalStyle::StyleSolver& solver = this->Internal->Solver;
  this->SetProgressText("Deforming");
  this->UpdateProgress(0.1);
  SphericalStyle::StyleOptions options;
  options.loop = this->MakeLoopOptions();
  options.lambda = 0.0; // no sphere: the handles are all that pulls
  options.componentCoupling =
    static_cast<SphericalStyle::ComponentCoupling>(this->ComponentCoupling);
  options.threads = ThreadsToUse(this->NumberOfThreads);
  SphericalStyle::HoldHandles(surface->Mesh, handles, ofPoints, options);
  solver.SetMesh(std::shared_ptr<const SphericalStyle::TriangleMesh>(surface, &surface->Mesh));
  return solver.Solve(options,
    [this](int iteration, double)
    {
      this->UpdateProgress(1.0 - 0.8 / (1.0 + 0.1 * iteration));
      return !Aborted(this);
    });
}

void vtkHandleDeformFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Handles: " << this->Handles.size() << "\n";
  for (const std::array<double, 10>& row : this->Handles)
  {
    os << indent.GetNextIndent() << Triple(row.data()) << " " << row[3] << " " << Triple(&row[4])
       << " " << Triple(&row[7]) << "\n";
  }
  os << indent << "ComponentCoupling: " << this->ComponentCoupling << "\n";
}
