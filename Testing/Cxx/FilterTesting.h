// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the tests of the filter share: counted checks, caught messages, bitwise comparison of data
/// sets, small surfaces.
#ifndef FilterTesting_h
#define FilterTesting_h

#include "vtkThesisStyleFilter.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTestUtilities.h"
#include "vtkTriangle.h"
#include "vtkTriangleFilter.h"
#include "vtkVariant.h"
#include "vtkXMLPolyDataReader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace FilterTesting
{
using Vector = std::array<double, 3>;
using Cell = std::vector<vtkIdType>;
using Surface = vtkSmartPointer<vtkPolyData>;

/// Counts what is not as it should be and says it.
class Checker
{
public:
  /// Title of what follows, printed before a message.
  void About(const std::string& subject) { this->Subject = subject; }

  bool operator()(bool good, const std::string& shouldBe)
  {
    ++this->Checks;
    if (!good)
    {
      std::cerr << this->Subject << ": " << shouldBe << "\n";
      ++this->Failures;
    }
    return good;
  }

  /// value <= limit, and not NaN.
  bool AtMost(double value, double limit, const std::string& what)
  {
    return (*this)(value <= limit,
      what + " should be at most " + vtkVariant(limit).ToString() + " and is " +
        vtkVariant(value).ToString());
  }

  /// The exit code of a test, which fails too if nothing was checked.
  int Result() const
  {
    if (this->Checks == 0)
    {
      std::cerr << "nothing was checked\n";
    }
    if (this->Failures > 0)
    {
      std::cerr << this->Failures << " checks failed\n";
    }
    return this->Checks > 0 && this->Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  }

private:
  std::string Subject;
  int Checks = 0;
  int Failures = 0;
};

constexpr int OfPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int OfCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

inline std::string Text(vtkIdType number)
{
  return std::to_string(number);
}

/// Adds the text of every such event of the object to a list, which must outlive the object.
inline void Watch(vtkObject* object, unsigned long event, std::vector<std::string>& into)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&into);
  command->SetCallback(
    [](vtkObject*, unsigned long, void* messages, void* text)
    {
      static_cast<std::vector<std::string>*>(messages)->emplace_back(
        text ? static_cast<const char*>(text) : "");
    });
  object->AddObserver(event, command);
}

/// A filter, with its messages caught instead of printed and its executions counted.
template <typename FilterType>
class Watched
{
public:
  Watched()
  {
    Watch(this->Filter, vtkCommand::ErrorEvent, this->Errors);
    Watch(this->Filter, vtkCommand::WarningEvent, this->Warnings);
    // The executive adds that the algorithm has failed; not counted, it is not ours.
    Watch(this->Filter->GetExecutive(), vtkCommand::ErrorEvent, this->ExecutiveErrors);
    Watch(this->Filter, vtkCommand::StartEvent, this->Starts);
  }

  explicit Watched(vtkPolyData* input)
    : Watched()
  {
    this->Filter->SetInputData(input);
  }

  FilterType* operator->() { return this->Filter; }
  FilterType* Get() { return this->Filter; }

  vtkPolyData* Output(int port = 0)
  {
    this->Filter->Update();
    return vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(port));
  }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
  std::vector<std::string> ExecutiveErrors;
  std::vector<std::string> Starts; ///< one per execution

private:
  vtkNew<FilterType> Filter;
};

/// The main filter, with the choices of the class for study: with their defaults the two are one
/// (TestThesisStyleFilter).
using WatchedFilter = Watched<vtkThesisStyleFilter>;

/// For tests of the energy and of the plain blend: nothing but the model and one sphere. With
/// Uniform weights, FullEdge, InitialGuess Rest or FixedIterations the energy is minimized, with
/// none of them the result is the closed form.
inline void SetUpEnergy(vtkSphericalStyleFilter* filter)
{
  filter->SetRoundness(0.5);
  filter->SetNormalBlend(0.0);
  filter->SetNormalRadiusToWholeModel();
  filter->SetDetailSize(0.0);
  filter->SetKeepSizeToOff();
  filter->SetRefineLongEdgesToOff();
}

/// The same, with an energy that is minimized.
inline void SetUpUniform(vtkSphericalStyleFilter* filter)
{
  SetUpEnergy(filter);
  filter->SetSphericalWeightingToUniform();
}

/// The defaults, on the points of the input and on no more.
inline void SetUpDefaults(vtkSphericalStyleFilter* filter)
{
  filter->SetRefineLongEdgesToOff();
}

/// A WatchedFilter that begins with SetUp.
template <void (*SetUp)(vtkSphericalStyleFilter*)>
struct WatchedAs : WatchedFilter
{
  explicit WatchedAs(vtkPolyData* input = nullptr)
  {
    if (input)
    {
      (*this)->SetInputData(input);
    }
    SetUp(this->Get());
  }
};

using WatchedEnergy = WatchedAs<SetUpEnergy>;
using WatchedUniform = WatchedAs<SetUpUniform>;
using WatchedDefaults = WatchedAs<SetUpDefaults>;

/// For tests that run once for each of several settings: what their filters begin with.
inline void (*Begin)(vtkSphericalStyleFilter*) = SetUpDefaults;
inline void BeginAsSet(vtkSphericalStyleFilter* filter)
{
  Begin(filter);
}
using Tested = WatchedAs<BeginAsSet>;

/// Runs the tests with each setting and says which.
inline void WithEach(
  const std::vector<std::pair<const char*, void (*)(vtkSphericalStyleFilter*)>>& settings,
  const std::function<void()>& tests)
{
  for (const auto& [name, setting] : settings)
  {
    std::cerr << "with " << name << "\n";
    Begin = setting;
    tests();
  }
  Begin = SetUpDefaults;
}

inline bool Contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// Executes the filter: its progress should be told `times` times or more, from 0 to 1.
inline void CheckProgress(Checker& check, vtkAlgorithm* filter, std::size_t times)
{
  std::vector<double> progress;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&progress);
  command->SetCallback([](vtkObject*, unsigned long, void* data, void* value)
    { static_cast<std::vector<double>*>(data)->push_back(*static_cast<double*>(value)); });
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, command);
  filter->Update();
  filter->RemoveObserver(tag);
  check(progress.size() >= times,
    "it should be told " + Text(static_cast<vtkIdType>(times)) + " times or more, not " +
      Text(static_cast<vtkIdType>(progress.size())));
  check(std::is_sorted(progress.begin(), progress.end()) && !progress.empty() &&
      progress.front() >= 0.0 && progress.back() == 1.0,
    "it should rise from 0 to 1");
}

// ------------------------------------------------------------------------------------- models

inline Surface ReadModel(int argc, char* argv[], const char* name)
{
  char* path = vtkTestUtilities::ExpandDataFileName(argc, argv, name);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path);
  reader->Update();
  delete[] path;
  Surface model = reader->GetOutput();
  if (model->GetNumberOfPoints() == 0)
  {
    std::cerr << "cannot read " << name << "; is -D the folder with the models?\n";
    std::exit(EXIT_FAILURE);
  }
  return model;
}

inline vtkSmartPointer<vtkCellArray> MakeCells(const std::vector<Cell>& cells)
{
  auto array = vtkSmartPointer<vtkCellArray>::New();
  for (const Cell& cell : cells)
  {
    array->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  return array;
}

inline Surface MakeSurface(
  const std::vector<Vector>& points, const std::vector<Cell>& polygons, int type = VTK_DOUBLE)
{
  vtkNew<vtkPoints> p;
  p->SetDataType(type);
  for (const Vector& x : points)
  {
    p->InsertNextPoint(x.data());
  }
  auto surface = Surface::New();
  surface->SetPoints(p);
  surface->SetPolys(MakeCells(polygons));
  return surface;
}

enum class Faces
{
  Triangles,
  Quads,
  Strips
};

/// Points and faces of an ellipsoid: `rings` circles of `around` points between two poles, which
/// are the first and the last point.
inline Surface MakeEllipsoid(const Vector& halfAxes, Faces faces = Faces::Triangles,
  vtkIdType around = 16, vtkIdType rings = 9, int type = VTK_DOUBLE)
{
  std::vector<Vector> x = { { 0.0, 0.0, -halfAxes[2] } };
  for (vtkIdType j = 1; j <= rings; ++j)
  {
    const double theta = vtkMath::Pi() * j / (rings + 1);
    for (vtkIdType i = 0; i < around; ++i)
    {
      const double phi = 2.0 * vtkMath::Pi() * i / around;
      x.push_back({ halfAxes[0] * std::sin(theta) * std::cos(phi),
        halfAxes[1] * std::sin(theta) * std::sin(phi), -halfAxes[2] * std::cos(theta) });
    }
  }
  x.push_back({ 0.0, 0.0, halfAxes[2] });
  const auto last = static_cast<vtkIdType>(x.size()) - 1;
  const auto id = [&](vtkIdType j, vtkIdType i) { return 1 + j * around + i % around; };
  std::vector<Cell> polygons;
  std::vector<Cell> strips;
  for (vtkIdType i = 0; i < around; ++i)
  {
    polygons.push_back({ 0, id(0, i + 1), id(0, i) });
    polygons.push_back({ last, id(rings - 1, i), id(rings - 1, i + 1) });
  }
  for (vtkIdType j = 0; j + 1 < rings; ++j)
  {
    Cell strip;
    for (vtkIdType i = 0; i < around; ++i)
    {
      const Cell quad = { id(j, i), id(j, i + 1), id(j + 1, i + 1), id(j + 1, i) };
      if (faces == Faces::Quads)
      {
        polygons.push_back(quad);
      }
      else if (faces == Faces::Triangles) // cut as a strip of the ring is
      {
        polygons.push_back({ quad[3], quad[0], quad[2] });
        polygons.push_back({ quad[0], quad[1], quad[2] });
      }
      strip.push_back(quad[3]);
      strip.push_back(quad[0]);
    }
    strip.push_back(id(j + 1, 0));
    strip.push_back(id(j, 0));
    strips.push_back(strip);
  }
  Surface surface = MakeSurface(x, polygons, type);
  if (faces == Faces::Strips)
  {
    surface->SetStrips(MakeCells(strips));
  }
  return surface;
}

/// A copy with other points, in number type `type`; nothing else changes.
inline Surface Mapped(
  vtkPolyData* surface, const std::function<Vector(const Vector&)>& map, int type = VTK_DOUBLE)
{
  auto copy = Surface::New();
  copy->DeepCopy(surface);
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  points->SetNumberOfPoints(surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    Vector x;
    surface->GetPoint(i, x.data());
    points->SetPoint(i, map(x).data());
  }
  copy->SetPoints(points);
  return copy;
}

/// An ellipsoid of `rings` with bumps, and so with creases, in which details give way.
inline Surface MakeBumps(int rings)
{
  const Surface ellipsoid = MakeEllipsoid({ 1.0, 1.5, 0.8 }, Faces::Triangles, rings, rings);
  return Mapped(ellipsoid,
    [](const Vector& x)
    {
      const double r = 1.0 + 0.25 * std::sin(7.0 * x[0]) * std::cos(8.0 * x[1] + x[2]);
      return Vector{ r * x[0], r * x[1], r * x[2] };
    });
}

/// A copy with points of number type `type`.
inline Surface WithPointsOf(vtkPolyData* surface, int type)
{
  return Mapped(
    surface, [](const Vector& x) { return x; }, type);
}

inline Surface Shifted(vtkPolyData* surface, const Vector& by)
{
  return Mapped(surface,
    [&](const Vector& x) {
      return Vector{ x[0] + by[0], x[1] + by[1], x[2] + by[2] };
    });
}

/// The points and polygons of all parts, one after the other.
inline Surface Together(const std::vector<Surface>& parts)
{
  std::vector<Vector> points;
  std::vector<Cell> polygons;
  vtkNew<vtkIdList> ids;
  for (const Surface& part : parts)
  {
    const auto first = static_cast<vtkIdType>(points.size());
    for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i)
    {
      points.emplace_back();
      part->GetPoint(i, points.back().data());
    }
    for (vtkIdType c = 0; c < part->GetNumberOfPolys(); ++c)
    {
      part->GetPolys()->GetCellAtId(c, ids);
      Cell cell(ids->begin(), ids->end());
      for (vtkIdType& id : cell)
      {
        id += first;
      }
      polygons.push_back(cell);
    }
  }
  return MakeSurface(points, polygons);
}

// ----------------------------------------------------------------------------------- comparison

/// Type, name, size and every byte.
inline bool SameArray(vtkAbstractArray* a, vtkAbstractArray* b)
{
  if (!a || !b)
  {
    return a == b;
  }
  const std::string nameOfA = a->GetName() ? a->GetName() : "";
  const std::string nameOfB = b->GetName() ? b->GetName() : "";
  if (a->GetDataType() != b->GetDataType() || nameOfA != nameOfB ||
    a->GetNumberOfComponents() != b->GetNumberOfComponents() ||
    a->GetNumberOfTuples() != b->GetNumberOfTuples())
  {
    return false;
  }
  const std::size_t bytes = static_cast<std::size_t>(a->GetNumberOfValues()) * a->GetDataTypeSize();
  if (vtkArrayDownCast<vtkDataArray>(a) && a->GetDataTypeSize() > 0)
  {
    return bytes == 0 || std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0), bytes) == 0;
  }
  for (vtkIdType i = 0; i < a->GetNumberOfValues(); ++i) // strings, bits
  {
    if (a->GetVariantValue(i) != b->GetVariantValue(i))
    {
      return false;
    }
  }
  return true;
}

/// The arrays of a are the first of b, in order.
inline bool SameArrays(vtkFieldData* a, vtkFieldData* b)
{
  for (int i = 0; i < a->GetNumberOfArrays(); ++i)
  {
    if (!SameArray(a->GetAbstractArray(i), b->GetAbstractArray(i)))
    {
      return false;
    }
  }
  return true;
}

inline bool SameActiveAttributes(vtkDataSetAttributes* a, vtkDataSetAttributes* b)
{
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    vtkAbstractArray* ofA = a->GetAbstractAttribute(type);
    vtkAbstractArray* ofB = b->GetAbstractAttribute(type);
    if (!ofA != !ofB || (ofA && std::string(ofA->GetName()) != ofB->GetName()))
    {
      return false;
    }
  }
  return true;
}

inline bool SamePoints(vtkPolyData* a, vtkPolyData* b)
{
  return a->GetNumberOfPoints() == b->GetNumberOfPoints() &&
    (a->GetNumberOfPoints() == 0 ||
      SameArray(a->GetPoints()->GetData(), b->GetPoints()->GetData()));
}

/// Connectivity, offsets and their number types, of all four kinds.
inline bool SameCells(vtkPolyData* a, vtkPolyData* b)
{
  const auto same = [](vtkCellArray* x, vtkCellArray* y)
  {
    if (x->GetNumberOfCells() == 0 && y->GetNumberOfCells() == 0)
    {
      return true;
    }
    return x->IsStorage64Bit() == y->IsStorage64Bit() &&
      SameArray(x->GetOffsetsArray(), y->GetOffsetsArray()) &&
      SameArray(x->GetConnectivityArray(), y->GetConnectivityArray());
  };
  return same(a->GetVerts(), b->GetVerts()) && same(a->GetLines(), b->GetLines()) &&
    same(a->GetPolys(), b->GetPolys()) && same(a->GetStrips(), b->GetStrips());
}

inline bool SamePolyData(vtkPolyData* a, vtkPolyData* b)
{
  const auto same = [](vtkFieldData* x, vtkFieldData* y)
  { return x->GetNumberOfArrays() == y->GetNumberOfArrays() && SameArrays(x, y); };
  return SamePoints(a, b) && SameCells(a, b) && same(a->GetPointData(), b->GetPointData()) &&
    same(a->GetCellData(), b->GetCellData()) && same(a->GetFieldData(), b->GetFieldData()) &&
    SameActiveAttributes(a->GetPointData(), b->GetPointData()) &&
    SameActiveAttributes(a->GetCellData(), b->GetCellData());
}

inline bool SamePoint(vtkPolyData* a, vtkIdType i, vtkPolyData* b, vtkIdType j)
{
  Vector x;
  Vector y;
  a->GetPoint(i, x.data());
  b->GetPoint(j, y.data());
  return std::memcmp(x.data(), y.data(), sizeof(x)) == 0;
}

inline bool AllFinite(vtkDataArray* array)
{
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      if (!std::isfinite(array->GetComponent(i, k)))
      {
        return false;
      }
    }
  }
  return true;
}

inline double Distance(const Vector& x, const Vector& y)
{
  return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

inline Vector TupleOf(vtkDataArray* array, vtkIdType i)
{
  Vector x = { 0.0, 0.0, 0.0 };
  for (int k = 0; k < std::min(3, array->GetNumberOfComponents()); ++k)
  {
    x[k] = array->GetComponent(i, k);
  }
  return x;
}

inline Vector PointOf(vtkPolyData* surface, vtkIdType i)
{
  Vector x;
  surface->GetPoint(i, x.data());
  return x;
}

/// Of the points of its cells.
inline double Diagonal(vtkPolyData* surface)
{
  double bounds[6];
  surface->GetPoints()->GetBounds(bounds);
  return std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
}

/// Largest distance between the points of a part and those of the whole from id `first` on; NaN if
/// a point is not finite, infinite if the whole has too few.
inline double LargestDistanceInPart(vtkPolyData* part, vtkPolyData* whole, vtkIdType first = 0)
{
  if (first + part->GetNumberOfPoints() > whole->GetNumberOfPoints())
  {
    return HUGE_VAL;
  }
  double largest = 0.0;
  for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i)
  {
    const double distance = Distance(PointOf(part, i), PointOf(whole, first + i));
    largest = distance <= largest ? largest : distance;
  }
  return largest;
}

/// Largest distance between points of the same id; NaN if a point is not finite, infinite if there
/// are not equally many.
inline double LargestDistance(vtkPolyData* a, vtkPolyData* b)
{
  return a->GetNumberOfPoints() == b->GetNumberOfPoints() ? LargestDistanceInPart(a, b) : HUGE_VAL;
}

/// Mean of the points first, ..., last - 1.
inline Vector MeanPoint(vtkPolyData* surface, vtkIdType first, vtkIdType last)
{
  Vector mean = { 0.0, 0.0, 0.0 };
  for (vtkIdType i = first; i < last; ++i)
  {
    const Vector x = PointOf(surface, i);
    for (int k = 0; k < 3; ++k)
    {
      mean[k] += x[k] / static_cast<double>(last - first);
    }
  }
  return mean;
}

/// A third of the area of each triangle to each of its corners.
inline std::vector<double> PointAreas(vtkPolyData* surface)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(surface);
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  triangles->Update();
  std::vector<double> areas(surface->GetNumberOfPoints(), 0.0);
  vtkNew<vtkIdList> corners;
  for (vtkIdType f = 0; f < triangles->GetOutput()->GetNumberOfCells(); ++f)
  {
    triangles->GetOutput()->GetCellPoints(f, corners);
    double x[3][3];
    for (int k = 0; k < 3; ++k)
    {
      surface->GetPoint(corners->GetId(k), x[k]);
    }
    for (int k = 0; k < 3; ++k)
    {
      areas[corners->GetId(k)] += vtkTriangle::TriangleArea(x[0], x[1], x[2]) / 3.0;
    }
  }
  return areas;
}

/// The mean move of the points, weighted by areas.
inline double MoveOfCentroid(
  vtkPolyData* input, vtkPolyData* output, const std::vector<vtkIdType>& points)
{
  const std::vector<double> areas = PointAreas(input);
  Vector move = { 0.0, 0.0, 0.0 };
  double sum = 0.0;
  for (const vtkIdType i : points)
  {
    for (int k = 0; k < 3; ++k)
    {
      move[k] += areas[i] * (PointOf(output, i)[k] - PointOf(input, i)[k]);
    }
    sum += areas[i];
  }
  return Distance(move, { 0.0, 0.0, 0.0 }) / sum;
}

/// Standard deviation over mean of the distances from the mean point: 0 on a sphere.
inline double RadiusSpread(vtkPolyData* surface)
{
  const vtkIdType n = surface->GetNumberOfPoints();
  const Vector mean = MeanPoint(surface, 0, n);
  double sum = 0.0;
  double squares = 0.0;
  for (vtkIdType i = 0; i < n; ++i)
  {
    const double radius = Distance(PointOf(surface, i), mean);
    sum += radius;
    squares += radius * radius;
  }
  const double meanRadius = sum / static_cast<double>(n);
  return std::sqrt(std::max(0.0, squares / static_cast<double>(n) - meanRadius * meanRadius)) /
    meanRadius;
}

/// Groups of two or more points at one place, ascending.
inline std::vector<Cell> CoincidentPoints(vtkPolyData* surface)
{
  std::map<Vector, Cell> places;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    places[PointOf(surface, i)].push_back(i);
  }
  std::vector<Cell> groups;
  for (const auto& place : places)
  {
    if (place.second.size() > 1)
    {
      groups.push_back(place.second);
    }
  }
  return groups;
}

/// The corners of a surface that consists of triangles only.
inline std::vector<std::array<vtkIdType, 3>> TriangleCorners(vtkPolyData* surface)
{
  std::vector<std::array<vtkIdType, 3>> corners;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < surface->GetNumberOfPolys(); ++c)
  {
    surface->GetPolys()->GetCellAtId(c, ids);
    corners.push_back({ ids->GetId(0), ids->GetId(1), ids->GetId(2) });
  }
  return corners;
}
}

#endif
