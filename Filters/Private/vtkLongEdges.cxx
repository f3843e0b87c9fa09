// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLongEdges.h"

#include "Advice.h"
#include "Frame.h"

#include "vtkAdaptiveSubdivisionFilter.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkNonMergingPointLocator.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>

using vtkLongEdges::Origin;
using vtkSurfaceMeshConversion::FaceTriangle;

namespace
{
constexpr const char* Barycentric = "Barycentric";
constexpr const char* Parent = "Parent";

bool HasLongEdge(const FaceTriangle& triangle, vtkPoints* points, double length)
{
  double x[3][3];
  for (int k = 0; k < 3; ++k)
  {
    points->GetPoint(triangle.Corners[k], x[k]);
  }
  const auto isLong = [&](int i, int j) // compared as the filter does
  { return vtkMath::Distance2BetweenPoints(x[i], x[j]) > length * length; };
  return isLong(0, 1) || isLong(1, 2) || isLong(2, 0);
}

/// All triangles of the cells of which one has a long edge.
std::vector<FaceTriangle> LongTriangles(vtkPolyData* input, vtkPoints* points, double length)
{
  std::vector<FaceTriangle> triangles = vtkSurfaceMeshConversion::Triangles(input);
  std::vector<char> isLong(input->GetNumberOfCells(), 0);
  for (const FaceTriangle& triangle : triangles)
  {
    isLong[triangle.Cell] |= HasLongEdge(triangle, points, length);
  }
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                    [&](const FaceTriangle& triangle) { return !isLong[triangle.Cell]; }),
    triangles.end());
  return triangles;
}

/// In the frame, so that nothing depends on place and scale; rounded, so that two equally short
/// diagonals stay equal there, and with few enough bits that middles are exact.
vtkSmartPointer<vtkPoints> PointsInFrame(vtkPolyData* input, const SphericalStyle::Frame& frame)
{
  constexpr double Steps = 17592186044416.0; // 2^44 per diagonal
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(input->GetNumberOfPoints());
  SphericalStyle::Points x(1, 3);
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    input->GetPoint(i, x.data());
    x = (Steps * frame.Into(x)).array().round() / Steps;
    points->SetPoint(i, x.data());
  }
  return points;
}

/// The triangles apart from each other, every point with its barycentric coordinates in the
/// triangle that it started in, every cell with that triangle's place in the list.
vtkSmartPointer<vtkPolyData> TrianglesApart(
  const std::vector<FaceTriangle>& triangles, vtkPoints* inFrame)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> barycentric;
  barycentric->SetName(Barycentric);
  barycentric->SetNumberOfComponents(3);
  vtkNew<vtkIdTypeArray> parent;
  parent->SetName(Parent);
  vtkNew<vtkCellArray> cells;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    cells->InsertNextCell(3);
    for (int k = 0; k < 3; ++k)
    {
      cells->InsertCellPoint(points->InsertNextPoint(inFrame->GetPoint(triangles[t].Corners[k])));
      barycentric->InsertNextTuple3(k == 0, k == 1, k == 2);
    }
    parent->InsertNextValue(static_cast<vtkIdType>(t));
  }
  auto apart = vtkSmartPointer<vtkPolyData>::New();
  apart->SetPoints(points);
  apart->SetPolys(cells);
  apart->GetPointData()->AddArray(barycentric);
  apart->GetCellData()->AddArray(parent);
  return apart;
}

/// Halves long edges pass by pass, so that the number of triangles can be looked at.
vtkSmartPointer<vtkPolyData> HalveLongEdges(vtkSmartPointer<vtkPolyData> triangles, double length)
{
  vtkNew<vtkAdaptiveSubdivisionFilter> filter;
  vtkNew<vtkNonMergingPointLocator> apart;
  filter->SetLocator(apart);
  filter->SetMaximumEdgeLength(length);
  filter->SetMaximumTriangleArea(VTK_DOUBLE_MAX);
  filter->SetMaximumNumberOfPasses(1);
  for (vtkIdType before = 0; before != triangles->GetNumberOfCells();)
  {
    before = triangles->GetNumberOfCells();
    filter->SetInputData(triangles);
    filter->Update();
    triangles = vtkSmartPointer<vtkPolyData>::New();
    triangles->ShallowCopy(filter->GetOutput());
    if (triangles->GetNumberOfCells() > vtkLongEdges::MaximumNumberOfTriangles)
    {
      std::ostringstream message;
      message << "MaximumEdgeLength: with " << length
              << " long edges would be split into more than "
              << vtkLongEdges::MaximumNumberOfTriangles << " triangles; it must be larger";
      throw std::invalid_argument(message.str());
    }
  }
  return triangles;
}

/// Numbers points by what they lie between.
class PointNumbers
{
public:
  explicit PointNumbers(vtkIdType first)
    : First(first)
  {
  }

  /// @param parent  place of the triangle among all, to which points inside of it belong
  vtkIdType Find(vtkIdType parent, const FaceTriangle& triangle, const double* barycentric)
  {
    std::map<vtkIdType, double> shares; // a corner may be there twice
    for (int k = 0; k < 3; ++k)
    {
      if (barycentric[k] > 0.0)
      {
        shares[triangle.Corners[k]] += barycentric[k];
      }
    }
    Origin origin(shares.begin(), shares.end());
    if (origin.size() == 1)
    {
      return origin.front().first;
    }
    const vtkIdType next = this->First + static_cast<vtkIdType>(this->Origins.size());
    const auto found = this->Numbers.insert({ { origin.size() == 3 ? parent : -1, origin }, next });
    if (found.second)
    {
      this->Origins.push_back(std::move(origin));
    }
    return found.first->second;
  }

  std::vector<Origin> Origins;

private:
  vtkIdType First;
  std::map<std::pair<vtkIdType, Origin>, vtkIdType> Numbers;
};

/// The triangles in place of each cell that is split, three point ids each; nothing for the others.
std::vector<std::vector<vtkIdType>> Children(const std::vector<FaceTriangle>& triangles,
  vtkPolyData* split, vtkIdType numberOfCells, PointNumbers& numbers)
{
  std::vector<std::vector<vtkIdType>> children(numberOfCells);
  vtkDataArray* barycentric = split->GetPointData()->GetArray(Barycentric);
  vtkDataArray* parents = split->GetCellData()->GetArray(Parent);
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < split->GetNumberOfCells(); ++c)
  {
    const auto parent = static_cast<vtkIdType>(parents->GetComponent(c, 0));
    split->GetPolys()->GetCellAtId(c, corners);
    for (const vtkIdType i : *corners)
    {
      double b[3];
      barycentric->GetTuple(i, b);
      children[triangles[parent].Cell].push_back(numbers.Find(parent, triangles[parent], b));
    }
  }
  return children;
}

/// Cells of one kind: kept, or replaced by children. @param from  of each new cell, the old one
void AddCells(vtkCellArray* before, vtkIdType firstCell,
  const std::vector<std::vector<vtkIdType>>& children, vtkCellArray* kept, vtkCellArray* split,
  std::vector<vtkIdType>& keptFrom, std::vector<vtkIdType>& splitFrom)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < before->GetNumberOfCells(); ++i)
  {
    const vtkIdType cell = firstCell + i;
    if (children[cell].empty())
    {
      before->GetCellAtId(i, ids);
      kept->InsertNextCell(ids);
      keptFrom.push_back(cell);
    }
    for (std::size_t k = 0; k < children[cell].size(); k += 3)
    {
      split->InsertNextCell(3, &children[cell][k]);
      splitFrom.push_back(cell);
    }
  }
}

/// Gives the surface the input's cells, split where there are children. @return their cells
std::vector<vtkIdType> SetCells(
  vtkPolyData* surface, vtkPolyData* input, const std::vector<std::vector<vtkIdType>>& children)
{
  const vtkIdType firstPoly = input->GetNumberOfVerts() + input->GetNumberOfLines();
  std::vector<vtkIdType> from(firstPoly);
  std::vector<vtkIdType> fromStrips;
  for (vtkIdType cell = 0; cell < firstPoly; ++cell)
  {
    from[cell] = cell;
  }
  vtkNew<vtkCellArray> polys;
  vtkNew<vtkCellArray> strips;
  AddCells(input->GetPolys(), firstPoly, children, polys, polys, from, from);
  AddCells(input->GetStrips(), firstPoly + input->GetNumberOfPolys(), children, strips, polys,
    fromStrips, from);
  from.insert(from.end(), fromStrips.begin(), fromStrips.end());
  surface->SetPolys(polys);
  if (strips->GetNumberOfCells() > 0)
  {
    surface->SetStrips(strips);
  }
  if (input->GetNumberOfVerts() > 0)
  {
    surface->SetVerts(input->GetVerts());
  }
  if (input->GetNumberOfLines() > 0)
  {
    surface->SetLines(input->GetLines());
  }
  return from;
}

void SetPoints(vtkPolyData* surface, vtkPolyData* input, const std::vector<Origin>& newPoints)
{
  vtkPoints* before = input->GetPoints();
  const vtkIdType n = before->GetNumberOfPoints();
  vtkNew<vtkPoints> points;
  points->SetDataType(before->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE);
  points->SetNumberOfPoints(n + static_cast<vtkIdType>(newPoints.size()));
  for (vtkIdType i = 0; i < n; ++i)
  {
    points->SetPoint(i, before->GetPoint(i));
  }
  for (std::size_t i = 0; i < newPoints.size(); ++i)
  {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (const auto& [id, share] : newPoints[i])
    {
      x += share * Eigen::Vector3d(before->GetPoint(id));
    }
    points->SetPoint(n + static_cast<vtkIdType>(i), x.data());
  }
  surface->SetPoints(points);
}

/// The nearest point of an origin, the first one if several are equally near.
vtkIdType Nearest(const Origin& origin)
{
  return std::max_element(
    origin.begin(), origin.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
    ->first;
}

/// The first point of an origin where the region's array is 0, or else the nearest one.
vtkIdType OutsideOrNearest(const Origin& origin, vtkDataArray* region)
{
  const auto outside = std::find_if(origin.begin(), origin.end(),
    [region](const auto& point) { return region->GetComponent(point.first, 0) == 0.0; });
  return outside != origin.end() ? outside->first : Nearest(origin);
}

/// Whether numbers between two values of the array mean something.
bool CanBeBlended(vtkAbstractArray* array)
{
  const int components = array->GetNumberOfComponents();
  const int type = array->GetDataType();
  return type == VTK_FLOAT || type == VTK_DOUBLE ||
    (type == VTK_UNSIGNED_CHAR && (components == 3 || components == 4));
}

/// Appends the blend of the values at the points of an origin.
void AppendBlend(vtkAbstractArray* to, vtkIdType at, vtkAbstractArray* from, const Origin& origin)
{
  vtkNew<vtkIdList> ids;
  double shares[3];
  for (const auto& [id, share] : origin)
  {
    shares[ids->InsertNextId(id)] = share;
  }
  to->InterpolateTuple(at, ids, from, shares);
}

void Normalize(vtkDataArray* normals, vtkIdType first)
{
  for (vtkIdType i = first; i < normals->GetNumberOfTuples(); ++i)
  {
    Eigen::Vector3d n(normals->GetTuple(i));
    n = n.stableNormalized();
    normals->SetTuple(i, n.data());
  }
}

void SetPointArrays(vtkPolyData* surface, vtkPolyData* input, const std::vector<Origin>& newPoints,
  const vtkLongEdges::NominalArrays& nominal)
{
  const vtkIdType n = input->GetNumberOfPoints();
  vtkPointData* arrays = surface->GetPointData();
  arrays->DeepCopy(input->GetPointData());
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* from = input->GetPointData()->GetAbstractArray(k);
    vtkAbstractArray* to = arrays->GetAbstractArray(k);
    const bool blend = CanBeBlended(from) && from != nominal.Region && from != nominal.CenterId;
    for (std::size_t i = 0; i < newPoints.size() && from->GetNumberOfTuples() == n; ++i)
    {
      const vtkIdType at = n + static_cast<vtkIdType>(i);
      const Origin& origin = newPoints[i];
      if (blend)
      {
        AppendBlend(to, at, from, origin);
      }
      else
      {
        to->InsertTuple(at,
          from == nominal.Region ? OutsideOrNearest(origin, nominal.Region) : Nearest(origin),
          from);
      }
    }
  }
  if (arrays->GetNormals())
  {
    Normalize(arrays->GetNormals(), n);
  }
  arrays->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS); // no longer unique
}

void SetCellArrays(
  vtkPolyData* surface, vtkPolyData* input, const std::vector<vtkIdType>& originalCell)
{
  vtkCellData* arrays = surface->GetCellData();
  arrays->DeepCopy(input->GetCellData());
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* from = input->GetCellData()->GetAbstractArray(k);
    vtkAbstractArray* to = arrays->GetAbstractArray(k);
    if (from->GetNumberOfTuples() != input->GetNumberOfCells())
    {
      continue;
    }
    to->SetNumberOfTuples(static_cast<vtkIdType>(originalCell.size()));
    for (std::size_t cell = 0; cell < originalCell.size(); ++cell)
    {
      to->SetTuple(static_cast<vtkIdType>(cell), originalCell[cell], from);
    }
  }
  arrays->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS); // no longer unique
}

void AddMarks(
  vtkPolyData* surface, vtkIdType numberOfOldPoints, const std::vector<vtkIdType>& originalCell)
{
  vtkNew<vtkUnsignedCharArray> isNew;
  isNew->SetName("RefinedPoint");
  isNew->SetNumberOfTuples(surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    isNew->SetValue(i, i < numberOfOldPoints ? 0 : 1);
  }
  surface->GetPointData()->AddArray(isNew);
  vtkNew<vtkIdTypeArray> cells;
  cells->SetName("OriginalCell");
  for (const vtkIdType cell : originalCell)
  {
    cells->InsertNextValue(cell);
  }
  surface->GetCellData()->AddArray(cells);
}
}

namespace vtkLongEdges
{
Refined Split(
  vtkPolyData* input, const vtkSurfaceMesh& surface, double length, const NominalArrays& nominal)
{
  std::vector<FaceTriangle> triangles;
  vtkSmartPointer<vtkPoints> inFrame;
  if (surface.Mesh.F.rows() > 0)
  {
    inFrame = PointsInFrame(input, SphericalStyle::FrameOf(surface.Mesh.P));
    triangles = LongTriangles(input, inFrame, length);
  }
  Refined refined;
  refined.Surface = vtkSmartPointer<vtkPolyData>::New();
  std::vector<vtkIdType> originalCell(input->GetNumberOfCells());
  if (triangles.empty())
  {
    refined.Surface->ShallowCopy(input);
    std::iota(originalCell.begin(), originalCell.end(), 0);
  }
  else
  {
    PointNumbers numbers(input->GetNumberOfPoints());
    const auto split = HalveLongEdges(TrianglesApart(triangles, inFrame), length);
    const auto children = Children(triangles, split, input->GetNumberOfCells(), numbers);
    refined.NewPoints = std::move(numbers.Origins);
    refined.Surface->vtkDataObject::ShallowCopy(input); // field data, time
    SetPoints(refined.Surface, input, refined.NewPoints);
    SetPointArrays(refined.Surface, input, refined.NewPoints, nominal);
    originalCell = SetCells(refined.Surface, input, children);
    SetCellArrays(refined.Surface, input, originalCell);
  }
  AddMarks(refined.Surface, input->GetNumberOfPoints(), originalCell);
  return refined;
}

bool IsWanted(int refinement, double longEdgeShare)
{
  return refinement == ALWAYS ||
    (refinement == WHERE_COARSE && longEdgeShare >= SphericalStyle::CoarseShare);
}

vtkSmartPointer<vtkSelection> Select(const std::vector<char>& selected, const Refined& refined)
{
  vtkNew<vtkIdTypeArray> ids;
  const auto n = static_cast<vtkIdType>(selected.size());
  for (vtkIdType i = 0; i < n; ++i)
  {
    if (selected[i])
    {
      ids->InsertNextValue(i);
    }
  }
  for (std::size_t i = 0; i < refined.NewPoints.size(); ++i)
  {
    const Origin& origin = refined.NewPoints[i];
    if (std::all_of(origin.begin(), origin.end(),
          [&selected](const auto& point) { return selected[point.first] != 0; }))
    {
      ids->InsertNextValue(n + static_cast<vtkIdType>(i));
    }
  }
  vtkNew<vtkSelectionNode> node;
  node->SetFieldType(vtkSelectionNode::POINT);
  node->SetContentType(vtkSelectionNode::INDICES);
  node->SetSelectionList(ids);
  auto selection = vtkSmartPointer<vtkSelection>::New();
  selection->AddNode(node);
  return selection;
}
}
