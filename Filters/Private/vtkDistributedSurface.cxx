// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDistributedSurface.h"

#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace
{
enum Tags // any numbers that nobody else sends at the same time
{
  PIECE = 73101,
  REPLY
};

constexpr int NumberOfKinds = 4;

/// In the order in which vtkPolyData numbers its cells.
std::array<vtkCellArray*, NumberOfKinds> Kinds(vtkPolyData* surface)
{
  return { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() };
}

/// Points of a cell; valid until the next one is asked for.
struct CellOfPiece
{
  int Kind;
  vtkIdType Size;
  const vtkIdType* Corners;
};

CellOfPiece FindCell(vtkPolyData* piece, vtkIdType id)
{
  const auto kinds = Kinds(piece);
  CellOfPiece cell = { 0, 0, nullptr };
  while (id >= kinds[cell.Kind]->GetNumberOfCells())
  {
    id -= kinds[cell.Kind++]->GetNumberOfCells();
  }
  kinds[cell.Kind]->GetCellAtId(id, cell.Size, cell.Corners);
  return cell;
}

/// Marks of points or cells that another piece owns; nullptr without.
vtkUnsignedCharArray* Ghosts(vtkDataSetAttributes* attributes)
{
  return vtkUnsignedCharArray::SafeDownCast(
    attributes->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
}

bool IsDuplicate(vtkUnsignedCharArray* ghosts, vtkIdType i, unsigned char duplicate)
{
  return ghosts && (ghosts->GetValue(i) & duplicate) != 0;
}

/// A place in space, or a global id.
using Key = std::array<std::uint64_t, 3>;

Key KeyOfPlace(const double x[3])
{
  Key key;
  for (int k = 0; k < 3; ++k)
  {
    const double value = x[k] + 0.0; // -0 and 0 are one place
    std::memcpy(&key[k], &value, sizeof(value));
  }
  return key;
}

/// Global ids of all pieces, or none.
template <typename Attributes>
std::vector<vtkDataArray*> GlobalIds(
  const std::vector<vtkSmartPointer<vtkPolyData>>& pieces, Attributes attributes)
{
  std::vector<vtkDataArray*> ids;
  for (const auto& piece : pieces)
  {
    vtkDataArray* own = attributes(piece)->GetGlobalIds();
    if (!own && piece->GetNumberOfPoints() > 0)
    {
      return {};
    }
    ids.push_back(own);
  }
  return ids;
}

std::uint64_t GlobalId(vtkDataArray* ids, vtkIdType i)
{
  return static_cast<std::uint64_t>(ids->GetComponent(i, 0));
}

vtkDataSetAttributes* PointData(vtkPolyData* surface)
{
  return surface->GetPointData();
}

vtkDataSetAttributes* CellData(vtkPolyData* surface)
{
  return surface->GetCellData();
}

/// A point of a piece, which others may have, too.
struct PointOfPiece
{
  Key Where;
  int Piece;
  vtkIdType Id;
  bool Ghost;
};

/// The points of all pieces, by key and then by piece. @param byIds  whether keys are global ids
std::vector<PointOfPiece> SortedPoints(
  const std::vector<vtkSmartPointer<vtkPolyData>>& pieces, bool& byIds)
{
  const std::vector<vtkDataArray*> ids = GlobalIds(pieces, PointData);
  byIds = !ids.empty();
  std::vector<PointOfPiece> points;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    vtkPolyData* piece = pieces[k];
    vtkUnsignedCharArray* ghosts = Ghosts(piece->GetPointData());
    for (vtkIdType i = 0; i < piece->GetNumberOfPoints(); ++i)
    {
      points.push_back({ byIds ? Key{ GlobalId(ids[k], i), 0, 0 } : KeyOfPlace(piece->GetPoint(i)),
        static_cast<int>(k), i, IsDuplicate(ghosts, i, vtkDataSetAttributes::DUPLICATEPOINT) });
    }
  }
  std::sort(points.begin(), points.end(),
    [](const PointOfPiece& a, const PointOfPiece& b)
    { return std::tie(a.Where, a.Piece, a.Id) < std::tie(b.Where, b.Piece, b.Id); });
  return points;
}

/// Which points are one: those of one key, and of those of one piece the first with the first, the
/// second with the second.
/// @param owners  the point that each of the joined ones is taken from: no ghost, if there is one
/// @return the joined point of each point
std::vector<std::size_t> JoinCopies(
  const std::vector<PointOfPiece>& points, std::vector<std::size_t>& owners)
{
  std::vector<std::size_t> joined(points.size());
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end)
  {
    const std::size_t first = owners.size();
    std::size_t turn = 0; // among those of this piece
    for (; end < points.size() && points[end].Where == points[begin].Where; ++end)
    {
      turn = end > begin && points[end].Piece == points[end - 1].Piece ? turn + 1 : 0;
      joined[end] = first + turn;
      if (joined[end] == owners.size())
      {
        owners.push_back(end);
      }
      else if (points[owners[joined[end]]].Ghost && !points[end].Ghost)
      {
        owners[joined[end]] = end;
      }
    }
  }
  return joined;
}

/// Ids that each piece has made for itself would sew together what is apart.
/// @throw std::invalid_argument naming the first id that stands for points at different places
void CheckPlaces(const std::vector<vtkSmartPointer<vtkPolyData>>& pieces,
  const std::vector<PointOfPiece>& points, const std::vector<std::size_t>& owners,
  const std::vector<std::size_t>& joined)
{
  vtkBoundingBox box;
  for (const auto& piece : pieces)
  {
    box.AddBounds(piece->GetBounds());
  }
  constexpr double SamePlace = 1e-4; // of the diagonal: each process may have rounded for itself
  const double most = SamePlace * box.GetDiagonalLength();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const PointOfPiece& other = points[owners[joined[i]]];
    double a[3];
    double b[3];
    pieces[points[i].Piece]->GetPoint(points[i].Id, a);
    pieces[other.Piece]->GetPoint(other.Id, b);
    if (vtkMath::Distance2BetweenPoints(a, b) > most * most)
    {
      throw std::invalid_argument("global id " + std::to_string(points[i].Where[0]) +
        " is at different places on processes " + std::to_string(other.Piece) + " and " +
        std::to_string(points[i].Piece) +
        "; make new ids with Generate Global Ids, or remove them");
    }
  }
}

/// The tuples of the origins, in their order, of the arrays that all pieces have.
template <typename Attributes, typename Origins>
void CopyArrays(const std::vector<vtkSmartPointer<vtkPolyData>>& pieces, Attributes attributes,
  const Origins& origins, vtkDataSetAttributes* to)
{
  vtkDataSetAttributes::FieldList arrays;
  std::vector<int> index(pieces.size(), 0);
  int count = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    if (pieces[k]->GetNumberOfPoints() > 0)
    {
      arrays.IntersectFieldList(attributes(pieces[k]));
      index[k] = count++;
    }
  }
  arrays.CopyAllocate(
    to, vtkDataSetAttributes::COPYTUPLE, static_cast<vtkIdType>(origins.size()), 0);
  for (std::size_t i = 0; i < origins.size(); ++i)
  {
    const auto [piece, id] = origins[i];
    arrays.CopyData(index[piece], attributes(pieces[piece]), id, to, static_cast<vtkIdType>(i));
  }
  to->RemoveArray(vtkDataSetAttributes::GhostArrayName());
}

using Arrays = std::vector<vtkSmartPointer<vtkAbstractArray>>;

/// What the result has in place of the arrays of the whole, or more than it, at the places of a
/// piece; zero where a place is none.
Arrays PickArrays(
  vtkDataSetAttributes* whole, vtkDataSetAttributes* result, const std::vector<vtkIdType>& places)
{
  vtkNew<vtkIdList> from;
  vtkNew<vtkIdList> at;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    if (places[i] >= 0)
    {
      from->InsertNextId(places[i]);
      at->InsertNextId(static_cast<vtkIdType>(i));
    }
  }
  Arrays picked;
  for (int k = 0; k < result->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = result->GetAbstractArray(k);
    if (!array->GetName() || whole->GetAbstractArray(array->GetName()) == array)
    {
      continue;
    }
    const auto own = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
    own->SetName(array->GetName());
    own->SetNumberOfComponents(array->GetNumberOfComponents());
    own->CopyComponentNames(array);
    own->SetNumberOfTuples(static_cast<vtkIdType>(places.size()));
    if (vtkDataArray* numbers = vtkDataArray::SafeDownCast(own))
    {
      numbers->Fill(0.0);
    }
    own->InsertTuples(at, from, array);
    picked.push_back(own);
  }
  return picked;
}
}

vtkDistributedSurface::vtkDistributedSurface(vtkMultiProcessController* controller)
  : Controller(controller)
{
}

void vtkDistributedSurface::Gather(vtkPolyData* piece)
{
  if (this->Controller->GetLocalProcessId() > 0)
  {
    this->Controller->Send(piece, 0, PIECE);
    return;
  }
  this->Gathered.resize(this->Controller->GetNumberOfProcesses());
  this->Place.assign(this->Gathered.size(), {});
  for (std::size_t k = 0; k < this->Gathered.size(); ++k)
  {
    this->Gathered[k] = vtkSmartPointer<vtkPolyData>::New();
    if (k == 0)
    {
      this->Gathered[k]->ShallowCopy(piece);
    }
    else
    {
      this->Controller->Receive(this->Gathered[k], static_cast<int>(k), PIECE);
    }
    this->Place[k].Points.assign(this->Gathered[k]->GetNumberOfPoints(), Nowhere);
  }
}

vtkSmartPointer<vtkPolyData> vtkDistributedSurface::Assemble()
{
  auto whole = vtkSmartPointer<vtkPolyData>::New();
  if (this->Gathered.empty())
  {
    return whole;
  }
  const std::vector<Origin> points = this->PlacePoints();
  const std::vector<Origin> cells = this->PlaceCells();
  this->PlaceGhostCells(cells, points.size());
  this->CopyPoints(points, whole);
  this->CopyCells(cells, whole);
  CopyArrays(this->Gathered, PointData, points, whole->GetPointData());
  CopyArrays(this->Gathered, CellData, cells, whole->GetCellData());
  this->JoinMarks(whole);
  whole->GetFieldData()->ShallowCopy(this->Gathered.front()->GetFieldData());
  this->Gathered.clear();
  return whole;
}

void vtkDistributedSurface::CopyPoints(const std::vector<Origin>& origins, vtkPolyData* whole) const
{
  const bool single = std::all_of(this->Gathered.begin(), this->Gathered.end(),
    [](vtkPolyData* piece)
    { return piece->GetNumberOfPoints() == 0 || piece->GetPoints()->GetDataType() == VTK_FLOAT; });
  vtkNew<vtkPoints> points;
  points->SetDataType(single ? VTK_FLOAT : VTK_DOUBLE);
  points->SetNumberOfPoints(static_cast<vtkIdType>(origins.size()));
  for (std::size_t i = 0; i < origins.size(); ++i)
  {
    const auto [piece, id] = origins[i];
    points->SetPoint(static_cast<vtkIdType>(i), this->Gathered[piece]->GetPoint(id));
  }
  whole->SetPoints(points);
}

void vtkDistributedSurface::CopyCells(const std::vector<Origin>& origins, vtkPolyData* whole) const
{
  std::array<vtkNew<vtkCellArray>, NumberOfKinds> cells;
  std::vector<vtkIdType> corners;
  for (const Origin& origin : origins)
  {
    const int kind = this->FindCorners(origin, corners);
    cells[kind]->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  }
  whole->SetVerts(cells[0]);
  whole->SetLines(cells[1]);
  whole->SetPolys(cells[2]);
  whole->SetStrips(cells[3]);
}

int vtkDistributedSurface::FindCorners(const Origin& origin, std::vector<vtkIdType>& corners) const
{
  const CellOfPiece cell = FindCell(this->Gathered[origin.Piece], origin.Id);
  const std::vector<vtkIdType>& places = this->Place[origin.Piece].Points;
  corners.resize(cell.Size);
  std::transform(cell.Corners, cell.Corners + cell.Size, corners.begin(),
    [&places](vtkIdType point) { return places[point]; });
  return cell.Kind;
}

std::vector<vtkDistributedSurface::Origin> vtkDistributedSurface::PlacePoints()
{
  bool byIds = false;
  const std::vector<PointOfPiece> copies = SortedPoints(this->Gathered, byIds);
  std::vector<std::size_t> owners; // the copy that each point of the whole is taken from
  const std::vector<std::size_t> pointOf = JoinCopies(copies, owners);

  if (byIds)
  {
    CheckPlaces(this->Gathered, copies, owners, pointOf);
  }

  // With ids they are in order now. Without, they come in the order of the pieces.
  std::vector<std::size_t> order(owners.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  if (!byIds)
  {
    const auto place = [&](std::size_t point)
    { return std::tie(copies[owners[point]].Piece, copies[owners[point]].Id); };
    std::sort(order.begin(), order.end(),
      [&place](std::size_t a, std::size_t b) { return place(a) < place(b); });
  }
  std::vector<vtkIdType> rank(owners.size());
  std::vector<Origin> origins;
  origins.reserve(owners.size());
  for (const std::size_t point : order)
  {
    rank[point] = static_cast<vtkIdType>(origins.size());
    origins.push_back({ copies[owners[point]].Piece, copies[owners[point]].Id });
  }
  for (std::size_t i = 0; i < copies.size(); ++i)
  {
    this->Place[copies[i].Piece].Points[copies[i].Id] = rank[pointOf[i]];
  }
  return origins;
}

std::vector<vtkDistributedSurface::Origin> vtkDistributedSurface::PlaceCells()
{
  const auto& pieces = this->Gathered;
  struct Owned
  {
    int Kind;
    std::uint64_t GlobalId;
    Origin From;
  };
  const std::vector<vtkDataArray*> globalIds = GlobalIds(pieces, CellData);
  std::vector<Owned> owned;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    vtkUnsignedCharArray* ghosts = Ghosts(pieces[k]->GetCellData());
    this->Place[k].Cells.assign(pieces[k]->GetNumberOfCells(), Nowhere);
    vtkIdType id = 0;
    const auto kinds = Kinds(pieces[k]);
    for (int kind = 0; kind < NumberOfKinds; ++kind)
    {
      for (vtkIdType i = 0; i < kinds[kind]->GetNumberOfCells(); ++i, ++id)
      {
        if (!IsDuplicate(ghosts, id, vtkDataSetAttributes::DUPLICATECELL))
        {
          owned.push_back({ kind, globalIds.empty() ? 0 : GlobalId(globalIds[k], id),
            { static_cast<int>(k), id } });
        }
      }
    }
  }
  std::stable_sort(owned.begin(), owned.end(),
    [](const Owned& a, const Owned& b)
    { return std::tie(a.Kind, a.GlobalId) < std::tie(b.Kind, b.GlobalId); });
  std::vector<Origin> origins;
  for (const Owned& cell : owned)
  {
    this->Place[cell.From.Piece].Cells[cell.From.Id] = static_cast<vtkIdType>(origins.size());
    origins.push_back(cell.From);
  }
  return origins;
}

void vtkDistributedSurface::PlaceGhostCells(
  const std::vector<Origin>& cells, std::size_t numberOfPoints)
{
  const auto isGhost = [](vtkIdType cell) { return cell == Nowhere; };
  std::vector<int> pieces; // that have a cell to be found
  for (std::size_t k = 0; k < this->Place.size(); ++k)
  {
    if (std::any_of(this->Place[k].Cells.begin(), this->Place[k].Cells.end(), isGhost))
    {
      pieces.push_back(static_cast<int>(k));
    }
  }
  if (pieces.empty())
  {
    return;
  }
  const auto sortedCorners = [this](const Origin& cell)
  {
    std::vector<vtkIdType> corners;
    this->FindCorners(cell, corners);
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  // A cell of two pieces has points of both only.
  std::vector<int> copies(numberOfPoints, 0);
  for (const Places& places : this->Place)
  {
    for (const vtkIdType point : places.Points)
    {
      ++copies[point];
    }
  }
  std::map<std::vector<vtkIdType>, vtkIdType> owned;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    std::vector<vtkIdType> corners = sortedCorners(cells[i]);
    if (std::all_of(corners.begin(), corners.end(), [&](vtkIdType p) { return copies[p] > 1; }))
    {
      owned.emplace(std::move(corners), static_cast<vtkIdType>(i));
    }
  }
  for (const int piece : pieces)
  {
    std::vector<vtkIdType>& places = this->Place[piece].Cells;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const auto found = places[i] == Nowhere
        ? owned.find(sortedCorners({ piece, static_cast<vtkIdType>(i) }))
        : owned.end();
      places[i] = found != owned.end() ? found->second : places[i];
    }
  }
}

void vtkDistributedSurface::JoinMarks(vtkPolyData* whole) const
{
  vtkDataArray* joined = whole->GetPointData()->GetArray(MarksName);
  for (std::size_t k = 0; joined && k < this->Gathered.size(); ++k)
  {
    vtkDataArray* marks = this->Gathered[k]->GetPointData()->GetArray(MarksName);
    for (vtkIdType i = 0; i < this->Gathered[k]->GetNumberOfPoints(); ++i)
    {
      if (marks->GetComponent(i, 0) != 0.0)
      {
        joined->SetComponent(this->Place[k].Points[i], 0, 1.0);
      }
    }
  }
}

void vtkDistributedSurface::GiveBack(
  vtkPolyData* whole, vtkPolyData* result, vtkPolyData* piece, vtkPolyData* output)
{
  auto own = vtkSmartPointer<vtkPolyData>::New();
  if (this->Controller->GetLocalProcessId() == 0)
  {
    for (std::size_t k = 1; k < this->Place.size(); ++k)
    {
      if (!this->Place[k].Points.empty())
      {
        this->Controller->Send(this->Reply(whole, result, k), static_cast<int>(k), REPLY);
      }
    }
    own = this->Reply(whole, result, 0);
  }
  else if (piece->GetNumberOfPoints() > 0)
  {
    this->Controller->Receive(own, 0, REPLY);
  }
  output->ShallowCopy(piece);
  if (piece->GetNumberOfPoints() == 0)
  {
    return;
  }
  output->SetPoints(own->GetPoints());
  for (int k = 0; k < own->GetPointData()->GetNumberOfArrays(); ++k)
  {
    output->GetPointData()->AddArray(own->GetPointData()->GetAbstractArray(k));
  }
  if (vtkDataArray* normals = own->GetPointData()->GetNormals())
  {
    output->GetPointData()->SetNormals(normals);
  }
  for (int k = 0; k < own->GetFieldData()->GetNumberOfArrays(); ++k)
  {
    output->GetCellData()->AddArray(own->GetFieldData()->GetAbstractArray(k));
  }
}

vtkSmartPointer<vtkPolyData> vtkDistributedSurface::Reply(
  vtkPolyData* whole, vtkPolyData* result, std::size_t piece) const
{
  const Places& places = this->Place[piece];
  auto reply = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(result->GetPoints()->GetDataType());
  points->SetNumberOfPoints(static_cast<vtkIdType>(places.Points.size()));
  for (std::size_t i = 0; i < places.Points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), result->GetPoint(places.Points[i]));
  }
  reply->SetPoints(points);
  vtkDataArray* normals = result->GetPointData()->GetNormals();
  for (const auto& array : PickArrays(whole->GetPointData(), result->GetPointData(), places.Points))
  {
    reply->GetPointData()->AddArray(array);
    if (normals && normals == result->GetPointData()->GetAbstractArray(array->GetName()))
    {
      reply->GetPointData()->SetActiveNormals(array->GetName());
    }
  }
  // The reply has no cells, and without them no cell arrays arrive.
  for (const auto& array : PickArrays(whole->GetCellData(), result->GetCellData(), places.Cells))
  {
    reply->GetFieldData()->AddArray(array);
  }
  return reply;
}
