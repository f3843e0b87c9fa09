// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceMeshConversion.h"

#include "MeshDiagnosis.h"
#include "MeshEdges.h"
#include "SurfaceMeasures.h"
#include "vtkFilterSupport.h"

#include "vtkAlgorithm.h"
#include "vtkArrayDispatch.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersionMacros.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <new>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

namespace
{
using SphericalStyle::Points;

[[noreturn]] void Refuse(const std::ostringstream& message)
{
  throw std::invalid_argument(message.str());
}

/// Whether test(ids) holds for the point ids of all cells, one after the other, in the number type
/// that the cells are stored with. VTK 9.6 has more storages than the two of 32 and 64 bits.
template <typename Test>
bool HoldsForPointIds(vtkCellArray* cells, Test&& test)
{
  bool holds = false;
  const auto worker = [&](auto* ids) { holds = test(vtk::DataArrayValueRange<1>(ids)); };
  vtkDataArray* ids = cells->GetConnectivityArray();
  if (!vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Integrals>::Execute(ids, worker))
  {
    worker(ids);
  }
  return holds;
}

/// Whether all point ids of the cells lie in 0..numberOfPoints - 1.
bool AllInRange(vtkCellArray* cells, vtkIdType numberOfPoints)
{
  return HoldsForPointIds(cells,
    [numberOfPoints](const auto& ids)
    {
      return std::all_of(ids.begin(), ids.end(),
        [numberOfPoints](auto i)
        { return static_cast<vtkIdType>(i) >= 0 && static_cast<vtkIdType>(i) < numberOfPoints; });
    });
}

[[noreturn]] void RefuseFirstOutOfRange(
  vtkCellArray* cells, vtkIdType firstCell, vtkIdType numberOfPoints)
{
  std::ostringstream message;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, ids);
    const vtkIdType* bad = std::find_if(ids->begin(), ids->end(),
      [numberOfPoints](vtkIdType i) { return i < 0 || i >= numberOfPoints; });
    if (bad != ids->end())
    {
      message << "Cells: cell " << firstCell + cell << " names point " << *bad << ", the input has "
              << numberOfPoints;
      Refuse(message);
    }
  }
  message << "Cells: there are point ids out of range behind those of the last cell";
  Refuse(message);
}

/// Cells of all kinds, also those that no filter moves: output and views follow their ids, too.
void CheckCells(vtkPolyData* input)
{
  vtkIdType firstCell = 0;
  for (vtkCellArray* cells :
    { input->GetVerts(), input->GetLines(), input->GetPolys(), input->GetStrips() })
  {
    if (!cells->IsValid())
    {
      std::ostringstream message;
      message << "Cells: the offsets of the cells from cell " << firstCell
              << " on do not fit their point ids";
      Refuse(message);
    }
    if (!AllInRange(cells, input->GetNumberOfPoints()))
    {
      RefuseFirstOutOfRange(cells, firstCell, input->GetNumberOfPoints());
    }
    firstCell += cells->GetNumberOfCells();
  }
}

/// Calls triangle(cell, a, b, c) for every triangle of the faces of a vtkPolyData.
class FaceTriangles
{
public:
  explicit FaceTriangles(vtkPolyData* input)
    : Input(input)
  {
  }

  template <typename Visitor>
  void Visit(Visitor&& triangle)
  {
    vtkIdType cell = this->Input->GetNumberOfVerts() + this->Input->GetNumberOfLines();
    auto polys = vtk::TakeSmartPointer(this->Input->GetPolys()->NewIterator());
    for (polys->GoToFirstCell(); !polys->IsDoneWithTraversal(); polys->GoToNextCell(), ++cell)
    {
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      polys->GetCurrentCell(size, ids);
      if (size == 3)
      {
        triangle(cell, ids[0], ids[1], ids[2]);
      }
      else if (size > 3)
      {
        if (!this->Polygon)
        {
          this->Polygon = vtkSmartPointer<vtkPolygon>::New();
        }
        this->Cut(cell, size, ids);
        for (vtkIdType i = 0; i + 2 < this->Cuts->GetNumberOfIds(); i += 3)
        {
          triangle(cell, ids[this->Cuts->GetId(i)], ids[this->Cuts->GetId(i + 1)],
            ids[this->Cuts->GetId(i + 2)]);
        }
      }
    }
    auto strips = vtk::TakeSmartPointer(this->Input->GetStrips()->NewIterator());
    for (strips->GoToFirstCell(); !strips->IsDoneWithTraversal(); strips->GoToNextCell(), ++cell)
    {
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      strips->GetCurrentCell(size, ids);
      for (vtkIdType i = 0; i + 2 < size; ++i)
      {
        triangle(cell, ids[i], ids[i + 1 + i % 2], ids[i + 2 - i % 2]); // every other one turns
      }
    }
  }

  vtkIdType Fanned = 0;
  vtkIdType FirstFanned = -1;

private:
  /// Cuts a polygon into triangles (positions in the polygon, three by three).
  void Cut(vtkIdType cell, vtkIdType size, const vtkIdType* ids)
  {
    Points corners(size, 3);
    for (vtkIdType i = 0; i < size; ++i)
    {
      this->Input->GetPoints()->GetPoint(ids[i], corners.row(i).data());
    }
    // Around the origin at size 1: the cut must not depend on place and scale.
    corners.rowwise() -= corners.row(0).eval();
    const double largest = corners.cwiseAbs().maxCoeff();
    corners /= largest > 0.0 ? largest : 1.0;
    if (!corners.allFinite()) // not finite, or too far apart: nothing for vtkPolygon
    {
      this->Fan(cell, size);
      return;
    }
    this->Polygon->PointIds->SetNumberOfIds(size);
    this->Polygon->Points->SetDataTypeToDouble();
    this->Polygon->Points->SetNumberOfPoints(size);
    for (vtkIdType i = 0; i < size; ++i)
    {
      this->Polygon->PointIds->SetId(i, i);
      this->Polygon->Points->SetPoint(i, corners.row(i).data());
    }
    this->Cuts->Reset();
    if (this->CutPolygon() && this->Cuts->GetNumberOfIds() == 3 * (size - 2))
    {
      return;
    }
    this->Fan(cell, size);
  }

  bool CutPolygon()
  {
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 20240617) // in ParaView 5.13
    return this->Polygon->TriangulateLocalIds(0, this->Cuts) != 0;
#else
    return this->Polygon->Triangulate(this->Cuts) != 0;
#endif
  }

  void Fan(vtkIdType cell, vtkIdType size)
  {
    this->FirstFanned = this->Fanned++ == 0 ? cell : this->FirstFanned;
    this->Cuts->Reset();
    for (vtkIdType i = 1; i + 1 < size; ++i)
    {
      this->Cuts->InsertNextId(0);
      this->Cuts->InsertNextId(i);
      this->Cuts->InsertNextId(i + 1);
    }
  }

  vtkPolyData* Input;
  vtkSmartPointer<vtkPolygon> Polygon; // for the first cell that is no triangle
  vtkNew<vtkIdList> Cuts;
};

/// Calls body(tuples) with the tuples of three of any array, of its own number type where that is
/// float or double.
template <typename Body>
void WithTuples(vtkDataArray* array, Body&& body)
{
  const auto worker = [&body](auto* typed) { body(vtk::DataArrayTupleRange<3>(typed)); };
  if (!vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Reals>::Execute(array, worker))
  {
    worker(array);
  }
}

/// Arrays that the filters read tuple by tuple: VTK looks at them when they are set, and not when
/// their number of components is changed afterwards.
void CheckComponents(vtkDataArray* array, const char* what)
{
  if (array->GetNumberOfComponents() != 3)
  {
    std::ostringstream message;
    message << what << ": array \"" << (array->GetName() ? array->GetName() : "") << "\" has "
            << array->GetNumberOfComponents() << " components, not 3";
    Refuse(message);
  }
}

Points AllPoints(vtkPointSet* input)
{
  CheckComponents(input->GetPoints()->GetData(), "Points");
  Points x(input->GetNumberOfPoints(), 3);
  WithTuples(input->GetPoints()->GetData(),
    [&x](const auto& tuples)
    {
      Eigen::Index i = 0;
      for (const auto tuple : tuples)
      {
        for (int k = 0; k < 3; ++k)
        {
          x(i, k) = static_cast<double>(tuple[k]);
        }
        ++i;
      }
    });
  return x;
}

/// Sums over as many points as there may be stay finite below this.
constexpr double LargestCoordinate = 1e300;

void CheckSize(std::size_t triangles, std::size_t points)
{
  constexpr std::size_t Most = SphericalStyle::MostTriangles;
  if (triangles > Most || points > Most)
  {
    std::ostringstream message;
    message << "Input: " << triangles << " triangles with " << points
            << " points are more than the " << Most << " that can be solved at once";
    Refuse(message);
  }
}

/// Whether all faces are the triangles given, and nothing else.
bool HasTriangles(vtkPolyData* input, const vtkSurfaceMesh& surface)
{
  vtkCellArray* polys = input->GetPolys();
  const vtkIdType first = input->GetNumberOfVerts() + input->GetNumberOfLines();
  const SphericalStyle::Triangles& corners = surface.GetCorners();
  const vtkIdType size = corners.rows();
  if (input->GetNumberOfStrips() > 0 || polys->GetNumberOfCells() != size || size == 0 ||
    polys->IsHomogeneous() != 3 || surface.GetCell(0) != first)
  {
    return false;
  }
  return HoldsForPointIds(polys,
    [&corners](const auto& ids)
    {
      return std::equal(ids.begin(), ids.end(), corners.data(),
        [](auto id, int corner) { return static_cast<vtkIdType>(id) == corner; });
    });
}

/// Whether the points stand where those of the mesh do, and the others where they did.
bool HasPoints(vtkPolyData* input, const vtkSurfaceMesh& surface)
{
  if (static_cast<std::size_t>(input->GetNumberOfPoints()) != surface.MeshPoint.size() ||
    input->GetPoints()->GetData()->GetNumberOfComponents() != 3)
  {
    return false;
  }
  bool same = true;
  WithTuples(input->GetPoints()->GetData(),
    [&](const auto& tuples)
    {
      auto point = surface.MeshPoint.begin();
      auto notMoved = surface.NotMovedPoints.begin();
      for (const auto tuple : tuples)
      {
        const int at = *point++;
        for (int k = 0; k < 3; ++k)
        {
          const auto x = static_cast<double>(tuple[k]);
          same &= at >= 0 ? x == surface.Mesh.P(at, k) : x == *notMoved++;
        }
      }
    });
  return same;
}

/// Active normals are recomputed one by one, so there must be one per point or cell.
void CheckNormals(vtkDataSetAttributes* attributes, vtkIdType number, const char* what)
{
  vtkDataArray* normals = attributes->GetNormals();
  if (!normals)
  {
    return;
  }
  CheckComponents(normals, "Normals");
  if (normals->GetNumberOfTuples() != number)
  {
    std::ostringstream message;
    message << "Normals: array \"" << (normals->GetName() ? normals->GetName() : "") << "\" has "
            << normals->GetNumberOfTuples() << " tuples for " << number << " " << what;
    Refuse(message);
  }
}

void CheckAllNormals(vtkPolyData* input)
{
  CheckNormals(input->GetPointData(), input->GetNumberOfPoints(), "points");
  CheckNormals(input->GetCellData(), input->GetNumberOfCells(), "cells");
}

/// @param number  of the points or cells that the arrays describe @return the index of an array
/// without a tuple, or -1
int FindEmptyArray(vtkDataSetAttributes* attributes, vtkIdType number)
{
  int k = number > 0 ? attributes->GetNumberOfArrays() - 1 : -1;
  while (k >= 0 && attributes->GetAbstractArray(k)->GetNumberOfTuples() > 0)
  {
    --k;
  }
  return k;
}

void RemoveEmptyArrays(vtkDataSetAttributes* attributes, vtkIdType number)
{
  for (int k = FindEmptyArray(attributes, number); k >= 0; k = FindEmptyArray(attributes, number))
  {
    attributes->RemoveArray(k);
  }
}

void CheckSizes(vtkDataSetAttributes* attributes, vtkIdType number, const char* what)
{
  for (int k = 0; k < attributes->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(k);
    if (array->GetNumberOfTuples() != number)
    {
      std::ostringstream message;
      message << "Input: array \"" << (array->GetName() ? array->GetName() : "") << "\" has "
              << array->GetNumberOfTuples() << " tuples for " << number << " " << what;
      Refuse(message);
    }
  }
}

/// One point at the place of each point, the same for all that coincide.
std::vector<vtkIdType> Representatives(Points& x, bool weld)
{
  std::vector<vtkIdType> representative(x.rows());
  std::iota(representative.begin(), representative.end(), 0);
  if (!weld)
  {
    return representative;
  }
  // Not by vtkStaticPointLocator, which compares all points of a bucket with each other: one point
  // far away, and all others are in one bucket.
  struct Place
  {
    double x, y, z;
    vtkIdType id;
    bool operator<(const Place& other) const
    {
      return std::tie(this->x, this->y, this->z, this->id) <
        std::tie(other.x, other.y, other.z, other.id);
    }
  };
  std::vector<Place> places(x.rows());
  for (const vtkIdType id : representative)
  {
    places[id] = { x(id, 0), x(id, 1), x(id, 2), id };
  }
  std::sort(places.begin(), places.end());
  for (std::size_t k = 1; k < places.size(); ++k)
  {
    const Place& place = places[k];
    const Place& before = places[k - 1];
    if (place.x == before.x && place.y == before.y && place.z == before.z)
    {
      representative[place.id] = representative[before.id];
    }
  }
  return representative;
}

/// Puts input points into groups that share one normal: those at one mesh point whose normals were
/// equal (or all of them, without `before`), so that seams stay smooth and creases stay sharp.
/// @param place  mesh point of each group @return group of each input point, -1 where nothing moves
std::vector<int> NormalGroups(
  const vtkSurfaceMesh& surface, vtkDataArray* before, std::vector<int>& place)
{
  std::vector<int> group(surface.MeshPoint.size(), -1);
  std::vector<int> firstGroup(surface.Mesh.P.rows(), -1); // of a mesh point
  std::vector<int> nextGroup;                             // at the same mesh point
  std::vector<Eigen::Vector3d> normal;                    // of a group
  for (std::size_t i = 0; i < group.size(); ++i)
  {
    const int at = surface.MeshPoint[i];
    if (at < 0)
    {
      continue;
    }
    Eigen::Vector3d n = Eigen::Vector3d::Zero();
    if (before)
    {
      before->GetTuple(static_cast<vtkIdType>(i), n.data());
    }
    int g = firstGroup[at];
    while (g >= 0 && normal[g] != n)
    {
      g = nextGroup[g];
    }
    if (g < 0)
    {
      g = static_cast<int>(place.size());
      place.push_back(at);
      normal.push_back(n);
      nextGroup.push_back(firstGroup[at]);
      firstGroup[at] = g;
    }
    group[i] = g;
  }
  return group;
}

/// Puts new normals in the place of the old ones among the arrays.
void ReplaceNormals(vtkDataSetAttributes* attributes, vtkDataArray* normals)
{
  vtkDataArray* before = attributes->GetNormals();
  if (before && before->GetName())
  {
    attributes->AddArray(normals); // a name that is there keeps its place
    attributes->SetActiveNormals(normals->GetName());
  }
  else
  {
    attributes->SetNormals(normals);
  }
}

/// Groups at a corner of a triangle that has moved: the others keep their normals.
std::vector<char> MovedGroups(const SphericalStyle::Triangles& F, const vtkSurfaceMesh& surface,
  const Points& Q, std::size_t numberOfGroups)
{
  std::vector<char> moved(numberOfGroups, 0);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const auto corners = surface.Mesh.F.row(f);
    if (Q(corners, SphericalStyle::AllColumns) !=
      surface.Mesh.P(corners, SphericalStyle::AllColumns))
    {
      moved[F(f, 0)] = moved[F(f, 1)] = moved[F(f, 2)] = 1;
    }
  }
  return moved;
}

/// The normals with those of the owner where several processes have a point; as they are where the
/// surface is not spread.
vtkSmartPointer<vtkDataArray> NormalsOfOwners(const vtkSurfaceMesh& surface, vtkDataArray* normals)
{
  if (surface.Part.IsWhole() || !surface.IsEverywhere(normals))
  {
    return surface.Part.IsWhole() ? normals : nullptr;
  }
  Points values = Points::Zero(static_cast<Eigen::Index>(surface.MeshPoint.size()), 3);
  for (const int i : surface.InputPart.shared)
  {
    if (surface.InputPart.Counts(i))
    {
      normals->GetTuple(i, values.row(i).data());
    }
  }
  surface.InputPart.SumAtShared(values.data(), 3);
  if (!normals) // nothing is here
  {
    return nullptr;
  }
  auto owned = vtk::TakeSmartPointer(normals->NewInstance());
  owned->DeepCopy(normals);
  for (const int i : surface.InputPart.shared)
  {
    owned->SetTuple(i, values.row(i).data());
  }
  return owned;
}

/// Adds what triangles of other processes give to the groups at points that these have, too: groups
/// with equal normals before are one.
/// @param group, place  see NormalGroups @param sums, moved  one per group
void SumGroups(const vtkSurfaceMesh& surface, vtkDataArray* before, const std::vector<int>& group,
  const std::vector<int>& place, Points& sums, std::vector<char>& moved)
{
  if (surface.Part.IsWhole())
  {
    return;
  }
  std::map<int, int> numberOf; // of mesh points that others have, too
  for (std::size_t k = 0; k < surface.Part.shared.size(); ++k)
  {
    numberOf[surface.Part.shared[k]] = surface.Part.numbers[k];
  }
  using Key = std::array<std::uint64_t, 4>;
  constexpr std::size_t RowSize = 8; // number of the point, normal before, sum, whether it moved
  const auto keyOf = [](const double* row)
  {
    Key key;
    std::memcpy(key.data(), row, sizeof(key)); // whatever the normals are
    return key;
  };
  std::vector<int> groups;
  std::vector<double> own;
  std::vector<char> done(place.size(), 0);
  for (const int i : surface.InputPart.shared)
  {
    const int g = group[i];
    if (g < 0 || done[g])
    {
      continue;
    }
    done[g] = 1;
    Eigen::Vector3d n = Eigen::Vector3d::Zero();
    if (before)
    {
      before->GetTuple(i, n.data());
    }
    n.array() += 0.0; // -0 and 0 are equal
    groups.push_back(g);
    own.insert(own.end(),
      { static_cast<double>(numberOf.at(place[g])), n(0), n(1), n(2), sums(g, 0), sums(g, 1),
        sums(g, 2), static_cast<double>(moved[g]) });
  }
  const std::vector<double> all = surface.Part.Concatenate(own);
  std::map<Key, Eigen::Vector4d> total;
  for (std::size_t at = 0; at < all.size(); at += RowSize)
  {
    const auto found = total.insert({ keyOf(all.data() + at), Eigen::Vector4d::Zero() }).first;
    found->second += Eigen::Map<const Eigen::Vector4d>(all.data() + at + 4);
  }
  for (std::size_t k = 0; k < groups.size(); ++k)
  {
    const Eigen::Vector4d& sum = total.at(keyOf(own.data() + RowSize * k));
    sums.row(groups[k]) = sum.head<3>();
    moved[groups[k]] = sum(3) > 0.0;
  }
}

/// A new array without values. Its memory is asked for here: VTK built with assertions, as in
/// Debian, ends the process where there is none.
/// @throw std::bad_alloc
vtkSmartPointer<vtkDataArray> NewArray(int type, vtkIdType tuples, int components)
{
  auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  array->SetNumberOfComponents(components);
  const vtkIdType count = tuples * components;
  if (type == VTK_BIT) // frees what it is given as if it came from new
  {
    array->SetNumberOfTuples(tuples);
  }
  else if (count > 0)
  {
    const auto size = static_cast<std::size_t>(array->GetDataTypeSize());
    void* values = std::malloc(static_cast<std::size_t>(count) * size);
    if (!values)
    {
      throw std::bad_alloc();
    }
    array->SetVoidArray(values, count, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  }
  return array;
}

/// Normals of the moved surface; points that no moved triangle touches keep theirs.
void ReplacePointNormals(
  vtkPolyData* output, const vtkSurfaceMesh& surface, const Points& Q, bool generate)
{
  const vtkSmartPointer<vtkDataArray> before =
    NormalsOfOwners(surface, output->GetPointData()->GetNormals());
  if (!surface.IsEverywhere(before) && !generate)
  {
    return;
  }
  std::vector<int> place;
  const std::vector<int> group = NormalGroups(surface, before, place);
  const SphericalStyle::Triangles F =
    surface.GetCorners().unaryExpr([&group](int i) { return group[i]; });
  Points n = SphericalStyle::PointNormalSums(Q(place, SphericalStyle::AllColumns), F);
  std::vector<char> moved = MovedGroups(F, surface, Q, place.size());
  SumGroups(surface, before, group, place, n, moved);
  SphericalStyle::NormalizeSums(n);

  auto normals =
    NewArray(before ? before->GetDataType() : VTK_FLOAT, static_cast<vtkIdType>(group.size()), 3);
  normals->SetName(before && before->GetName() ? before->GetName() : "Normals");
  const double none[3] = { 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < group.size(); ++i)
  {
    const auto id = static_cast<vtkIdType>(i);
    if (before && (group[i] < 0 || !moved[group[i]]))
    {
      normals->SetTuple(id, id, before);
    }
    else
    {
      normals->SetTuple(id, group[i] >= 0 ? n.row(group[i]).data() : none);
    }
  }
  ReplaceNormals(output->GetPointData(), normals);
}

/// Normals of the faces with a moved point; all other cells keep theirs.
void ReplaceCellNormals(vtkPolyData* output, const std::vector<char>& moved)
{
  vtkDataArray* before = output->GetCellData()->GetNormals();
  if (!before)
  {
    return;
  }
  auto normals = vtk::TakeSmartPointer(before->NewInstance());
  normals->DeepCopy(before);
  vtkNew<vtkIdList> ids;
  double normal[3];
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    output->GetCellPoints(cell, ids);
    const int type = output->GetCellType(cell);
    const bool strip = type == VTK_TRIANGLE_STRIP;
    const bool face = strip || type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_POLYGON;
    const bool hasMoved =
      std::any_of(ids->begin(), ids->end(), [&moved](vtkIdType i) { return moved[i] != 0; });
    if (face && hasMoved && ids->GetNumberOfIds() >= 3)
    {
      vtkPolygon::ComputeNormal(output->GetPoints(),
        static_cast<int>(strip ? 3 : ids->GetNumberOfIds()), ids->GetPointer(0), normal);
      normals->SetTuple(cell, normal);
    }
  }
  ReplaceNormals(output->GetCellData(), normals);
}

/// A new array. @param value  (tuple, component) -> double
/// @param what  tuple -> its name in the message @throw std::range_error std::bad_alloc
template <typename Value, typename What>
vtkSmartPointer<vtkDataArray> NewArray(
  int type, vtkIdType tuples, int components, const Value& value, const What& what)
{
  auto array = NewArray(type, tuples, components);
  vtkIdType beyond = -1; // the first tuple that has no number
  const auto fill = [&](auto* typed)
  {
    using Number = vtk::GetAPIType<std::remove_pointer_t<decltype(typed)>>;
    auto to = vtk::DataArrayValueRange(typed).begin();
    for (vtkIdType i = 0; i < tuples; ++i)
    {
      for (int k = 0; k < components; ++k)
      {
        const auto x = static_cast<Number>(value(i, k));
        beyond = beyond < 0 && !std::isfinite(x) ? i : beyond;
        *to++ = x;
      }
    }
  };
  if (!vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Reals>::Execute(array, fill))
  {
    fill(array.Get()); // whole numbers
  }
  if (beyond >= 0)
  {
    throw std::range_error(what(beyond) + " is beyond the range of " +
      (type == VTK_FLOAT ? "single" : "double") +
      " precision; make the model, Radius and the distance to Center smaller");
  }
  return array;
}

/// The same for the points of a surface, with a name.
template <typename Value>
vtkSmartPointer<vtkDataArray> NewPointArray(
  const char* name, int type, vtkIdType tuples, int components, const Value& value)
{
  auto array = NewArray(type, tuples, components, value,
    [name](vtkIdType i) { return std::string(name) + " at point " + std::to_string(i); });
  array->SetName(name);
  return array;
}

/// The marks of points or cells of which another process has the original; nullptr without.
vtkUnsignedCharArray* GhostMarks(vtkDataSetAttributes* attributes)
{
  return vtkUnsignedCharArray::SafeDownCast(
    attributes->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
}

bool IsMarked(vtkUnsignedCharArray* marks, vtkIdType i, unsigned char mark)
{
  return marks && (marks->GetValue(i) & mark) != 0;
}

using Corners = std::array<int, 3>; // input points; CheckSize knows that they fit

/// @param count  triangles before this one
void AddCell(vtkSurfaceMesh& surface, std::size_t count, vtkIdType cell)
{
  if (count == 0)
  {
    surface.FirstCell = cell;
  }
  if (surface.Cells.empty() && cell == surface.FirstCell + static_cast<vtkIdType>(count))
  {
    return;
  }
  if (surface.Cells.empty())
  {
    surface.Cells.resize(count);
    std::iota(surface.Cells.begin(), surface.Cells.end(), surface.FirstCell);
  }
  surface.Cells.push_back(cell);
}

/// The triangles that have an area, and what is to be said of the others and of polygons.
/// @param first  for each point, the first of those at its place
/// @param ghosts  marks of the cells, where those of other processes are to be left out, or nullptr
std::vector<Corners> TakeTriangles(vtkPolyData* input, const Points& x,
  const std::vector<vtkIdType>& first, vtkUnsignedCharArray* ghosts, vtkSurfaceMesh& surface)
{
  std::vector<Corners> triangles;
  triangles.reserve(input->GetNumberOfPolys());
  FaceTriangles faces(input);
  const auto isDegenerate = [&](vtkIdType a, vtkIdType b, vtkIdType c)
  {
    return a == b || b == c || c == a || SphericalStyle::IsDegenerate(x.row(a), x.row(b), x.row(c));
  };
  faces.Visit(
    [&](vtkIdType cell, vtkIdType a, vtkIdType b, vtkIdType c)
    {
      if (IsMarked(ghosts, cell, vtkDataSetAttributes::DUPLICATECELL))
      {
        return;
      }
      if (!isDegenerate(first[a], first[b], first[c]))
      {
        AddCell(surface, triangles.size(), cell);
        triangles.push_back({ static_cast<int>(a), static_cast<int>(b), static_cast<int>(c) });
      }
      else if (surface.DegenerateTriangles++ == 0)
      {
        surface.FirstDegenerateCell = cell;
      }
    });
  surface.FannedPolygons = faces.Fanned;
  surface.FirstFannedPolygon = faces.FirstFanned;
  return triangles;
}

/// Numbers the places in use in the order of the input, so that "last point" means the input's.
/// @param shared  places that triangles of other processes may use
/// @param number  NotMoved for other points @return how many there are
int NumberPlaces(const std::vector<Corners>& triangles, const std::vector<vtkIdType>& first,
  vtkSurfaceMeshConversion::TakePoints take, const SphericalStyle::SurfacePart& everybody,
  const SphericalStyle::SharedPlaces& shared, std::vector<int>& number)
{
  number.assign(first.size(), vtkSurfaceMesh::NotMoved);
  for (const Corners& t : triangles)
  {
    for (const int i : t)
    {
      number[first[i]] = 0;
    }
  }
  if (take == vtkSurfaceMeshConversion::TakePoints::All)
  {
    for (const vtkIdType i : first)
    {
      number[i] = 0;
    }
  }
  std::vector<double> used(shared.numberOfPlaces, 0.0);
  for (std::size_t k = 0; k < shared.points.size(); ++k)
  {
    used[shared.places[k]] =
      std::max(used[shared.places[k]], number[first[shared.points[k]]] == 0 ? 1.0 : 0.0);
  }
  everybody.Max(used.data(), used.size());
  for (std::size_t k = 0; k < shared.points.size(); ++k)
  {
    if (used[shared.places[k]] > 0.0)
    {
      number[first[shared.points[k]]] = 0;
    }
  }
  int count = 0;
  for (int& id : number)
  {
    id = id == 0 ? count++ : id;
  }
  return count;
}

/// The points that other processes have, too.
SphericalStyle::SharedPlaces SharedInputPoints(
  vtkPolyData* input, const Points& x, const SphericalStyle::Processes* processes)
{
  if (!processes)
  {
    return {};
  }
  std::vector<char> ghosts(x.rows());
  vtkUnsignedCharArray* marks = GhostMarks(input->GetPointData());
  for (std::size_t i = 0; i < ghosts.size(); ++i)
  {
    ghosts[i] =
      IsMarked(marks, static_cast<vtkIdType>(i), vtkDataSetAttributes::DUPLICATEPOINT) ? 1 : 0;
  }
  return SphericalStyle::FindSharedPlaces(x, ghosts, *processes);
}

/// What of the surface this process has.
void TakePart(const SphericalStyle::SurfacePart& everybody,
  const SphericalStyle::SharedPlaces& shared, vtkSurfaceMesh& surface)
{
  surface.Part = everybody;
  surface.Part.counts.assign(surface.Mesh.P.rows(), 1);
  surface.Part.numberOfShared = shared.numberOfPlaces;
  for (std::size_t k = 0; k < shared.points.size(); ++k)
  {
    const int point = surface.MeshPoint[shared.points[k]];
    if (point == vtkSurfaceMesh::NotMoved)
    {
      continue;
    }
    if (surface.Part.numbers.empty() || surface.Part.numbers.back() != shared.places[k])
    {
      surface.Part.shared.push_back(point);
      surface.Part.numbers.push_back(shared.places[k]);
      surface.Part.counts[point] = 0;
    }
    surface.Part.counts[point] |= shared.isFirst[k];
  }
  surface.InputPart = everybody;
  surface.InputPart.counts = shared.counts;
  surface.InputPart.shared = shared.points;
  surface.InputPart.numbers = shared.copies;
  surface.InputPart.numberOfShared = shared.numberOfCopies;
  vtkSurfaceMeshConversion::CountOnAll(everybody, surface.DegenerateTriangles,
    surface.FirstDegenerateCell, surface.FirstDegenerateProcess);
  vtkSurfaceMeshConversion::CountOnAll(
    everybody, surface.FannedPolygons, surface.FirstFannedPolygon, surface.FirstFannedProcess);
}
}

namespace
{
/// Global ids say which points are one even where each process has rounded them for itself, and so
/// do not stand at one place. Looked at are points on the border of a part, and the lowest ids, as
/// each process has made some for itself.
/// @throw WholeSurfaceNeeded where an id stands for several places
void CheckGlobalIds(vtkPolyData* input, const Points& x, const vtkSurfaceMesh& surface)
{
  vtkDataArray* ids = input->GetPointData()->GetGlobalIds();
  if (!surface.IsEverywhere(ids))
  {
    return;
  }
  std::vector<char> onBorder(surface.Mesh.P.rows(), 0);
  const SphericalStyle::MeshEdges edges(surface.Mesh.F);
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int h = edges.GetHalfEdges()[edges.GetOffset()[e]];
    for (int k = 1; k < 3 && edges.GetValence(e) == 1; ++k)
    {
      onBorder[surface.Mesh.F(h / 3, (h + k) % 3)] = 1;
    }
  }
  using Row = std::array<double, 4>; // id and place
  std::vector<Row> own;
  std::vector<Row> others;
  for (Eigen::Index i = 0; i < x.rows(); ++i)
  {
    const int point = surface.MeshPoint[i];
    (point >= 0 && onBorder[point] ? own : others)
      .push_back({ ids->GetComponent(i, 0), x(i, 0), x(i, 1), x(i, 2) });
  }
  constexpr std::size_t Lowest = 1000;
  const auto last = others.begin() + static_cast<std::ptrdiff_t>(std::min(Lowest, others.size()));
  std::partial_sort(others.begin(), last, others.end());
  own.insert(own.end(), others.begin(), last);
  std::vector<double> numbers;
  for (const Row& row : own)
  {
    numbers.insert(numbers.end(), row.begin(), row.end());
  }
  numbers = surface.Part.Concatenate(numbers);
  std::vector<Row> all(numbers.size() / 4);
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(4 * k), 4, all[k].begin());
  }
  std::sort(all.begin(), all.end());
  for (std::size_t k = 1; k < all.size(); ++k)
  {
    if (all[k][0] == all[k - 1][0] && all[k] != all[k - 1])
    {
      throw SphericalStyle::WholeSurfaceNeeded("a global id stands for several places");
    }
  }
}
}

bool vtkSurfaceMesh::IsEverywhere(vtkDataArray* array) const
{
  const bool missing = !array && !this->MeshPoint.empty();
  double has[2] = { array ? 1.0 : 0.0, missing ? 1.0 : 0.0 };
  this->Part.Max(has, 2);
  return has[0] > 0.0 && has[1] == 0.0;
}

vtkIdType vtkSurfaceMesh::FirstInputPoint(int i) const
{
  return std::find(this->MeshPoint.begin(), this->MeshPoint.end(), i) - this->MeshPoint.begin();
}

std::vector<vtkIdType> vtkSurfaceMesh::FirstInputPoints() const
{
  std::vector<vtkIdType> first(this->Mesh.P.rows(), -1);
  for (std::size_t i = this->MeshPoint.size(); i-- > 0;)
  {
    if (this->MeshPoint[i] != NotMoved)
    {
      first[this->MeshPoint[i]] = static_cast<vtkIdType>(i);
    }
  }
  return first;
}

namespace vtkSurfaceMeshConversion
{
vtkSurfaceMesh FromPolyData(vtkPolyData* input, bool weld, TakePoints take,
  const std::shared_ptr<const SphericalStyle::Processes>& processes)
{
  CheckAllNormals(input);
  CheckCells(input);
  Points x = PointsOf(input);
  CheckSize(
    static_cast<std::size_t>(input->GetNumberOfPolys()), static_cast<std::size_t>(x.rows()));
  SphericalStyle::SurfacePart everybody;
  everybody.processes = processes;
  const SphericalStyle::SharedPlaces shared = SharedInputPoints(input, x, processes.get());
  std::vector<vtkIdType> first = Representatives(x, weld);

  vtkSurfaceMesh surface;
  surface.Welded = weld;
  std::vector<Corners> triangles =
    TakeTriangles(input, x, first, processes ? GhostMarks(input->GetCellData()) : nullptr, surface);
  CheckSize(triangles.size(), first.size());
  std::vector<int> number;
  const int count = NumberPlaces(triangles, first, take, everybody, shared, number);
  surface.MeshPoint.resize(first.size());
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    surface.MeshPoint[i] = number[first[i]];
    if (surface.MeshPoint[i] == vtkSurfaceMesh::NotMoved)
    {
      const auto place = x.row(static_cast<Eigen::Index>(i));
      surface.NotMovedPoints.insert(surface.NotMovedPoints.end(), place.begin(), place.end());
    }
  }
  std::vector<vtkIdType>().swap(first);
  const auto size = static_cast<Eigen::Index>(triangles.size());
  surface.Mesh.F.resize(size, 3);
  std::copy_n(
    triangles.empty() ? nullptr : triangles.front().data(), 3 * size, surface.Mesh.F.data());
  std::vector<Corners>().swap(triangles);
  if (static_cast<Eigen::Index>(count) == x.rows()) // the mesh points are the input points
  {
    surface.Mesh.P.swap(x);
  }
  else
  {
    surface.Corners = surface.Mesh.F;
    surface.Mesh.F = surface.Corners.unaryExpr([&](int i) { return surface.MeshPoint[i]; });
    surface.Mesh.P.resize(count, 3);
    for (std::size_t i = 0; i < number.size(); ++i)
    {
      if (number[i] >= 0)
      {
        surface.Mesh.P.row(number[i]) = x.row(static_cast<Eigen::Index>(i));
      }
    }
  }
  if (processes)
  {
    TakePart(everybody, shared, surface);
    CheckGlobalIds(input, x.rows() > 0 ? x : surface.Mesh.P, surface);
  }
  return surface;
}

bool Update(vtkPolyData* input, bool weld, std::shared_ptr<const vtkSurfaceMesh>& surface,
  TakePoints take, const std::shared_ptr<const SphericalStyle::Processes>& processes)
{
  SphericalStyle::SurfacePart everybody;
  everybody.processes = processes;
  const bool plain = surface && surface->DegenerateTriangles == 0 && surface->FannedPolygons == 0 &&
    surface->Part.processes == processes;
  const auto isMarked = [input]
  { return GhostMarks(input->GetPointData()) || GhostMarks(input->GetCellData()); };
  const auto isEqual = [&]
  {
    return processes && input->GetNumberOfPoints() == 0
      ? surface->MeshPoint.empty()
      : HasTriangles(input, *surface) && HasPoints(input, *surface) && !(processes && isMarked());
  };
  const bool same = plain && surface->Welded == weld && isEqual();
  if (everybody.Max(same ? 0.0 : 1.0) == 0.0)
  {
    CheckAllNormals(input);
    CheckCells(input);
    return false;
  }
  surface.reset(); // nothing of the old one is kept should the next line throw
  surface = std::make_shared<const vtkSurfaceMesh>(FromPolyData(input, weld, take, processes));
  return true;
}

SphericalStyle::Points PointsOf(vtkDataSet* input)
{
  Points x(input->GetNumberOfPoints(), 3);
  auto* points = vtkPointSet::SafeDownCast(input);
  if (points && x.rows() > 0)
  {
    x = AllPoints(points);
  }
  for (Eigen::Index i = 0; i < x.rows(); ++i)
  {
    if (!points)
    {
      input->GetPoint(i, x.row(i).data());
    }
    const double largest = x.row(i).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (!(largest <= LargestCoordinate))
    {
      std::ostringstream message;
      message << "Points: point " << i << " is "
              << (std::isfinite(largest) ? "farther from the origin than 1e300" : "not finite")
              << ": (" << x.row(i) << ")";
      Refuse(message);
    }
  }
  return x;
}

vtkSmartPointer<vtkDataSet> WithoutEmptyArrays(vtkDataSet* input)
{
  if (FindEmptyArray(input->GetPointData(), input->GetNumberOfPoints()) < 0 &&
    FindEmptyArray(input->GetCellData(), input->GetNumberOfCells()) < 0)
  {
    return input;
  }
  auto without = vtkSmartPointer<vtkDataSet>::Take(input->NewInstance());
  without->ShallowCopy(input);
  RemoveEmptyArrays(without->GetPointData(), input->GetNumberOfPoints());
  RemoveEmptyArrays(without->GetCellData(), input->GetNumberOfCells());
  return without;
}

void CheckPiece(vtkPolyData* piece)
{
  CheckCells(piece);
  PointsOf(piece);
  CheckArrays(piece);
}

void CheckArrays(vtkDataSet* input)
{
  CheckSizes(input->GetPointData(), input->GetNumberOfPoints(), "points");
  CheckSizes(input->GetCellData(), input->GetNumberOfCells(), "cells");
}

std::vector<FaceTriangle> Triangles(vtkPolyData* input)
{
  std::vector<FaceTriangle> triangles;
  FaceTriangles(input).Visit(
    [&triangles](vtkIdType cell, vtkIdType a, vtkIdType b, vtkIdType c) {
      triangles.push_back({ cell, { a, b, c } });
    });
  return triangles;
}

WholeSurface Whole(vtkPolyData* input)
{
  WholeSurface whole;
  CheckCells(input);
  whole.Mesh.P = input->GetPoints() ? AllPoints(input) : Points(0, 3);
  std::vector<int> corners;
  FaceTriangles faces(input);
  faces.Visit(
    [&](vtkIdType cell, vtkIdType a, vtkIdType b, vtkIdType c)
    {
      for (const vtkIdType i : { a, b, c })
      {
        corners.push_back(static_cast<int>(i));
      }
      whole.Cells.push_back(cell);
    });
  CheckSize(whole.Cells.size(), static_cast<std::size_t>(whole.Mesh.P.rows()));
  whole.Mesh.F = Eigen::Map<SphericalStyle::Triangles>(
    corners.data(), static_cast<Eigen::Index>(whole.Cells.size()), 3);
  whole.FannedPolygons = faces.Fanned;
  whole.FirstFannedPolygon = faces.FirstFanned;
  return whole;
}

GhostTriangles Ghosts(vtkPolyData* input, const vtkSurfaceMesh& surface)
{
  GhostTriangles ghosts;
  vtkUnsignedCharArray* marks = GhostMarks(input->GetCellData());
  if (surface.Part.IsWhole() || !marks)
  {
    return ghosts;
  }
  std::vector<int> corners;
  FaceTriangles faces(input);
  faces.Visit(
    [&](vtkIdType cell, vtkIdType a, vtkIdType b, vtkIdType c)
    {
      if (!IsMarked(marks, cell, vtkDataSetAttributes::DUPLICATECELL))
      {
        return;
      }
      const Corners mesh = { surface.MeshPoint[a], surface.MeshPoint[b], surface.MeshPoint[c] };
      const auto& P = surface.Mesh.P;
      const bool isTaken = *std::min_element(mesh.begin(), mesh.end()) >= 0 && mesh[0] != mesh[1] &&
        mesh[1] != mesh[2] && mesh[2] != mesh[0] &&
        !SphericalStyle::IsDegenerate(P.row(mesh[0]), P.row(mesh[1]), P.row(mesh[2]));
      if (isTaken)
      {
        for (const vtkIdType i : { a, b, c })
        {
          corners.push_back(static_cast<int>(i));
        }
        ghosts.Cells.push_back(cell);
      }
    });
  ghosts.Corners = Eigen::Map<SphericalStyle::Triangles>(
    corners.data(), static_cast<Eigen::Index>(ghosts.Cells.size()), 3);
  return ghosts;
}

void CountOnAll(
  const SphericalStyle::SurfacePart& everybody, vtkIdType& count, vtkIdType& first, int& process)
{
  if (everybody.IsWhole())
  {
    return;
  }
  const std::vector<double> all =
    everybody.Concatenate({ static_cast<double>(count), static_cast<double>(first) });
  count = 0;
  for (std::size_t k = 0; k < all.size(); k += 2)
  {
    if (count == 0 && all[k] > 0.0)
    {
      first = static_cast<vtkIdType>(all[k + 1]);
      process = static_cast<int>(k / 2);
    }
    count += static_cast<vtkIdType>(all[k]);
  }
}

std::string OfProcess(int process)
{
  return process >= 0 ? " of process " + std::to_string(process) : std::string();
}

std::string FannedRemark(const vtkSurfaceMesh& surface)
{
  if (surface.FannedPolygons == 0)
  {
    return {};
  }
  return vtkFilterSupport::Count(surface.FannedPolygons, "polygon") +
    " with an outline that crosses or folds over itself, cut as fans, which is harmless where "
    "they are small; the first is cell " +
    std::to_string(surface.FirstFannedPolygon) + OfProcess(surface.FirstFannedProcess);
}

std::string SkippedRemark(const vtkSurfaceMesh& surface)
{
  return surface.DegenerateTriangles == 0
    ? std::string()
    : vtkFilterSupport::Count(surface.DegenerateTriangles, "degenerate triangle") +
      " (without an area) left out, which is harmless, the first in cell " +
      std::to_string(surface.FirstDegenerateCell) + OfProcess(surface.FirstDegenerateProcess);
}

std::vector<std::string> Remarks(const vtkSurfaceMesh& surface)
{
  std::vector<std::string> remarks;
  if (surface.Part.Max(surface.Mesh.F.rows() > 0 ? 1.0 : 0.0) == 0.0)
  {
    std::string remark = "the input has no triangle with an area: nothing moves";
    if (surface.DegenerateTriangles == 0)
    {
      remark += ". If it is a point cloud, make a surface of it first, for instance with Delaunay "
                "3D and Extract Surface";
    }
    remarks.push_back(std::move(remark));
  }
  if (const std::string fanned = FannedRemark(surface); !fanned.empty())
  {
    remarks.push_back(fanned);
  }
  if (const std::string skipped = SkippedRemark(surface); !skipped.empty())
  {
    remarks.push_back(skipped + "; points of no other triangle stay in place");
  }
  return remarks;
}

vtkDataArray* FindPointArray(
  vtkInformation* wanted, vtkPolyData* input, const char* purpose, int attribute)
{
  const char* name = wanted->Get(vtkDataObject::FIELD_NAME());
  vtkPointData* arrays = input->GetPointData();
  if (name && *name && std::string(name) != "None")
  {
    vtkDataArray* array = arrays->GetArray(name);
    const int association = wanted->Get(vtkDataObject::FIELD_ASSOCIATION());
    if (!array || association == vtkDataObject::FIELD_ASSOCIATION_CELLS)
    {
      throw std::invalid_argument(
        std::string(purpose) + ": there is no numeric point array \"" + name + "\"");
    }
    return array;
  }
  if (!name && wanted->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    attribute = wanted->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
    if (attribute < 0 || attribute >= vtkDataSetAttributes::NUM_ATTRIBUTES) // VTK does not look
    {
      throw std::invalid_argument(
        std::string(purpose) + ": there is no attribute type " + std::to_string(attribute));
    }
  }
  return attribute >= 0 ? arrays->GetAttribute(attribute) : nullptr;
}

namespace
{
std::string RangeOf(const ArrayRule& rule)
{
  std::ostringstream range;
  range << "it must ";
  if (std::isfinite(rule.Maximum))
  {
    range << "lie in " << rule.Minimum << ".." << rule.Maximum;
  }
  else
  {
    range << "be finite";
    if (std::isfinite(rule.Minimum))
    {
      range << " and " << rule.Minimum << " or more";
    }
  }
  return range.str();
}
}

Points GatherNormals(vtkInformation* wanted, vtkPolyData* input, const vtkSurfaceMesh& surface)
{
  Points normals = GatherPointArray(wanted, input, surface, NormalsRule);
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
  {
    normals.row(i) = normals.row(i).stableNormalized();
  }
  return normals;
}

Points GatherPointArray(
  vtkInformation* wanted, vtkPolyData* input, const vtkSurfaceMesh& surface, const ArrayRule& rule)
{
  const bool hasNothing = !surface.Part.IsWhole() && surface.MeshPoint.empty();
  vtkDataArray* array =
    hasNothing ? nullptr : FindPointArray(wanted, input, rule.Purpose, rule.Attribute);
  if (!hasNothing && !array && rule.Name)
  {
    array = input->GetPointData()->GetArray(rule.Name);
  }
  if (!surface.IsEverywhere(array))
  {
    return {};
  }
  const auto numberOfPoints = static_cast<vtkIdType>(surface.MeshPoint.size());
  std::ostringstream message;
  message << rule.Purpose << ": array \"" << (array && array->GetName() ? array->GetName() : "")
          << "\" ";
  if (array && array->GetNumberOfComponents() != rule.Components)
  {
    message << "has " << array->GetNumberOfComponents() << " components, not " << rule.Components;
    Refuse(message);
  }
  if (array && array->GetNumberOfTuples() != numberOfPoints)
  {
    message << "has " << array->GetNumberOfTuples() << " tuples for " << numberOfPoints
            << " points: a point array is needed";
    Refuse(message);
  }
  Points sum = Points::Zero(surface.Mesh.P.rows(), 3);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(surface.Mesh.P.rows());
  double value[3] = { 0.0, 0.0, 0.0 };
  for (vtkIdType i = 0; i < numberOfPoints; ++i)
  {
    const int to = surface.MeshPoint[i];
    if (to < 0 || !surface.InputPart.Counts(i))
    {
      continue;
    }
    array->GetTuple(i, value);
    for (int k = 0; k < rule.Components; ++k)
    {
      if (!std::isfinite(value[k]) || value[k] < rule.Minimum || value[k] > rule.Maximum)
      {
        message << "is " << value[k] << " at point " << i << "; " << RangeOf(rule);
        Refuse(message);
      }
      sum(to, k) += value[k];
    }
    count(to) += 1.0;
  }
  surface.Part.SumAtShared(sum.data(), 3);
  surface.Part.SumAtShared(count.data(), 1);
  return sum.array().colwise() / count.array();
}

void AddPointArray(vtkPolyData* output, const vtkSurfaceMesh& surface, const char* name, int type,
  const Eigen::Ref<const Rows>& rows)
{
  output->GetPointData()->AddArray(
    NewPointArray(name, type, output->GetNumberOfPoints(), static_cast<int>(rows.cols()),
      [&](vtkIdType i, int k)
      {
        const int from = surface.MeshPoint[i];
        return from >= 0 ? rows(from, k) : 0.0;
      }));
}

void AddRotations(
  vtkPolyData* output, const vtkSurfaceMesh& surface, const SphericalStyle::Matrices& R)
{
  Rows rows(surface.Mesh.P.rows(), 9);
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
  {
    rows.row(i) = R[i].transpose().reshaped().transpose();
  }
  AddPointArray(output, surface, "Rotation", output->GetPoints()->GetDataType(), rows);
}

void AddDisplacement(vtkPolyData* output, vtkPolyData* input)
{
  vtkSmartPointer<vtkDataArray> displacement;
  WithTuples(input->GetPoints()->GetData(),
    [&](const auto& before)
    {
      WithTuples(output->GetPoints()->GetData(),
        [&](const auto& after)
        {
          displacement = NewPointArray("Displacement", output->GetPoints()->GetDataType(),
            output->GetNumberOfPoints(), 3,
            [&](vtkIdType i, int k)
            { return static_cast<double>(after[i][k]) - static_cast<double>(before[i][k]); });
        });
    });
  output->GetPointData()->AddArray(displacement);
}

int OutputPointType(vtkPolyData* input, int precision)
{
  if (precision == vtkAlgorithm::DEFAULT_PRECISION)
  {
    return input->GetPoints()->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE;
  }
  return precision == vtkAlgorithm::SINGLE_PRECISION ? VTK_FLOAT : VTK_DOUBLE;
}

void ReplacePoints(vtkPolyData* output, const vtkSurfaceMesh& surface, const Points& Q,
  int precision, bool generateNormals)
{
  std::vector<char> moved(surface.MeshPoint.size());
  for (std::size_t i = 0; i < moved.size(); ++i)
  {
    const int from = surface.MeshPoint[i];
    moved[i] = from >= 0 && Q.row(from) != surface.Mesh.P.row(from) ? 1 : 0;
  }
  vtkSmartPointer<vtkDataArray> positions;
  WithTuples(output->GetPoints()->GetData(),
    [&](const auto& before)
    {
      positions = NewArray(
        OutputPointType(output, precision), output->GetNumberOfPoints(), 3,
        [&](vtkIdType i, int k)
        { return moved[i] ? Q(surface.MeshPoint[i], k) : static_cast<double>(before[i][k]); },
        [](vtkIdType i) { return "point " + std::to_string(i) + " of the result"; });
    });
  positions->SetName("Points"); // as vtkPoints calls its own
  vtkNew<vtkPoints> points;
  points->SetData(positions);
  output->SetPoints(points);
  ReplacePointNormals(output, surface, Q, generateNormals);
  ReplaceCellNormals(output, moved);
}
}
