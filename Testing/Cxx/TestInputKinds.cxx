// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every filter over every kind of input: what Filters/Documentation/Inputs.md says, in its words.
/// The output is finite and has the input's points and cells, or there is an error and no output;
/// and a filter that has run over anything gives what a new one gives, also where it comes back
/// to a good surface.
#include "FaultTesting.h"

#include "vtkBitArray.h"

#include <limits>

using namespace FilterTesting;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// What a filter says.
struct Outcome
{
  enum
  {
    Quiet,
    Warns,
    Refuses
  } kind = Quiet;
  const char* word = "";
};

Outcome Warns(const char* word)
{
  return { Outcome::Warns, word };
}

Outcome Refuses(const char* word)
{
  return { Outcome::Refuses, word };
}

struct Kind
{
  std::string name; ///< the row of the page
  Surface input;
  Outcome main;  ///< of vtkSphericalStyleFilter
  Outcome proxy; ///< of vtkConvexProxyDeformFilter
};

using Grid = std::function<Vector(double u, double v)>;

/// An n x m grid of u and v in 0..1, joined to itself: u = 1 with u = 0, turned round with `twist`,
/// and v = 1 with v = 0 with `tube`.
Surface MakeBand(vtkIdType n, vtkIdType m, bool twist, bool tube, const Grid& place)
{
  const vtkIdType rows = tube ? m : m + 1;
  std::vector<Vector> points;
  for (vtkIdType i = 0; i < n; ++i)
  {
    for (vtkIdType j = 0; j < rows; ++j)
    {
      points.push_back(place(1.0 * i / n, 1.0 * j / m));
    }
  }
  const auto id = [&](vtkIdType i, vtkIdType j)
  {
    j = i == n && twist ? m - j : j;
    return (i % n) * rows + (tube ? j % m : j);
  };
  std::vector<Cell> cells;
  for (vtkIdType i = 0; i < n; ++i)
  {
    for (vtkIdType j = 0; j < m; ++j)
    {
      cells.push_back({ id(i, j), id(i + 1, j), id(i + 1, j + 1) });
      cells.push_back({ id(i, j), id(i + 1, j + 1), id(i, j + 1) });
    }
  }
  return MakeSurface(points, cells);
}

Surface MakeMoebiusStrip()
{
  return MakeBand(24, 4, true, false,
    [](double u, double v)
    {
      const double phi = 2.0 * vtkMath::Pi() * u;
      const double s = 0.6 * (v - 0.5);
      const double r = 1.0 + s * std::cos(0.5 * phi);
      return Vector{ r * std::cos(phi), r * std::sin(phi), s * std::sin(0.5 * phi) };
    });
}

/// The figure-8 immersion.
Surface MakeKleinBottle()
{
  return MakeBand(24, 12, true, true,
    [](double u, double v)
    {
      const double phi = 2.0 * vtkMath::Pi() * u;
      const double t = 2.0 * vtkMath::Pi() * v;
      const double x = std::cos(0.5 * phi) * std::sin(t) - std::sin(0.5 * phi) * std::sin(2 * t);
      const double z = std::sin(0.5 * phi) * std::sin(t) + std::cos(0.5 * phi) * std::sin(2 * t);
      return Vector{ (2.0 + x) * std::cos(phi), (2.0 + x) * std::sin(phi), z };
    });
}

/// In a plane, with no point in the middle.
Surface MakeSheet()
{
  std::vector<Vector> points;
  std::vector<Cell> quads;
  for (vtkIdType i = 0; i < 24; ++i)
  {
    points.push_back({ static_cast<double>(i % 6), std::floor(static_cast<double>(i) / 6.0), 2.5 });
    if (i >= 6 && i % 6 > 0)
    {
      quads.push_back({ i - 7, i - 6, i, i - 1 });
    }
  }
  return MakeSurface(points, quads);
}

/// A tetrahedron with a flat triangle of a height on one of its edges.
Surface MakeSliver(double height)
{
  return MakeSurface(
    { { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, height, 0 }, { 0.5, -1, 0 }, { 0.5, 0, 1 } },
    { { 0, 1, 2 }, { 0, 3, 1 }, { 0, 2, 4 }, { 2, 1, 4 }, { 0, 4, 3 }, { 1, 3, 4 } });
}

Surface MakeBowTies()
{
  return MakeSurface({ { 0, 0, 0 }, { 1, 0.2, 0 }, { 1, 1, 0.3 }, { -1, 0, 0.1 }, { -1, -1, 0 },
                       { 0, 1, -1 }, { 0.4, 1, -1.4 } },
    { { 0, 1, 2 }, { 0, 3, 4 }, { 0, 5, 6 } });
}

/// Tetrahedra in rows of 100.
Surface MakeDust(vtkIdType n)
{
  std::vector<Vector> points;
  std::vector<Cell> cells;
  for (vtkIdType k = 0; k < n; ++k)
  {
    const Vector at = { static_cast<double>(k % 100), std::floor(static_cast<double>(k) / 100.0),
      0.01 * static_cast<double>(k % 7) };
    const vtkIdType i = 4 * k;
    for (const Vector& x : { Vector{ 0, 0, 0 }, { 0.4, 0, 0 }, { 0, 0.4, 0 }, { 0, 0, 0.4 } })
    {
      points.push_back({ at[0] + x[0], at[1] + x[1], at[2] + x[2] });
    }
    for (const Cell& c : { Cell{ 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } })
    {
      cells.push_back({ i + c[0], i + c[1], i + c[2] });
    }
  }
  return MakeSurface(points, cells);
}

/// Coordinates whose differences are infinite.
Surface MakeWidest()
{
  const double far = std::numeric_limits<double>::max();
  return MakeSurface({ { -far, 0, 0 }, { far, 0, 0 }, { 0, far, far }, { 0, -far, 0 } },
    { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 2, 3 } });
}

/// A pyramid on a star of n corners.
Surface MakeStar(vtkIdType n)
{
  std::vector<Vector> points;
  std::vector<Cell> cells(1);
  for (vtkIdType i = 0; i < n; ++i)
  {
    const double phi = 2.0 * vtkMath::Pi() * i / n;
    const double r = i % 2 == 0 ? 1.0 : 0.6;
    points.push_back({ r * std::cos(phi), r * std::sin(phi), 0.0 });
    cells[0].push_back(n - 1 - i);
    cells.push_back({ i, (i + 1) % n, n });
  }
  points.push_back({ 0.1, 0.2, 1.0 });
  return MakeSurface(points, cells);
}

Surface MakeBall(Faces faces = Faces::Triangles, int type = VTK_DOUBLE)
{
  return MakeEllipsoid({ 1.0, 0.8, 2.0 }, faces, 12, 7, type);
}

Surface Scaled(double by, int type = VTK_DOUBLE)
{
  return Mapped(
    MakeBall(),
    [by](const Vector& x) {
      return Vector{ by * x[0], by * x[1], by * x[2] };
    },
    type);
}

Surface Squeezed(const Vector& by)
{
  return Mapped(MakeBall(),
    [by](const Vector& x) {
      return Vector{ by[0] * x[0], by[1] * x[1], by[2] * x[2] };
    });
}

/// Ball with cells of another kind, or none.
Surface WithCells(const std::vector<Cell>& verts, const std::vector<Cell>& lines,
  const std::vector<Cell>& polygons, const std::vector<Cell>& strips)
{
  Surface surface = MakeBall();
  surface->SetVerts(MakeCells(verts));
  surface->SetLines(MakeCells(lines));
  surface->SetPolys(MakeCells(polygons));
  surface->SetStrips(MakeCells(strips));
  return surface;
}

Surface With(const std::function<void(vtkPolyData*)>& change)
{
  Surface surface = MakeBall();
  change(surface);
  return surface;
}

vtkSmartPointer<vtkDataArray> BadArray(const char* name, vtkIdType tuples, int components)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->FillValue(NaN);
  return array;
}

/// As a surface has them that was cut for several processes, and then read by one: of each bit.
void MarkGhosts(vtkPolyData* surface)
{
  for (vtkDataSetAttributes* attributes :
    { static_cast<vtkDataSetAttributes*>(surface->GetPointData()),
      static_cast<vtkDataSetAttributes*>(surface->GetCellData()) })
  {
    const bool ofPoints = attributes == surface->GetPointData();
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    ghosts->SetNumberOfTuples(
      ofPoints ? surface->GetNumberOfPoints() : surface->GetNumberOfCells());
    for (vtkIdType i = 0; i < ghosts->GetNumberOfTuples(); ++i)
    {
      ghosts->SetValue(i, static_cast<unsigned char>(i % 9 == 0 ? 0 : 1 << (i % 8)));
    }
    attributes->AddArray(ghosts);
  }
}

void Append(std::vector<Kind>& all, const std::vector<Kind>& more)
{
  all.insert(all.end(), more.begin(), more.end());
}

std::vector<Kind> FewOrFlat()
{
  const vtkIdType n = MakeBall()->GetNumberOfPoints();
  return { { "no points and no cells", Surface::New(), {}, {} },
    { "NULL points", With([](vtkPolyData* s) { s->SetPoints(nullptr); }), {}, {} },
    { "one point", MakeSurface({ { 1, 2, 3 } }, {}), Warns("no triangle"), Refuses("one place") },
    { "one triangle", MakeSurface({ { 0, 0, 0 }, { 3, 0, 0 }, { 0, 1, 1 } }, { { 0, 1, 2 } }), {},
      Warns("plane") },
    { "planar", MakeSheet(), {}, Warns("plane") },
    { "points on a line", Squeezed({ 0, 0, 1 }), Warns("no triangle"), Refuses("line") },
    { "all points equal", Squeezed({ 0, 0, 0 }), Warns("no triangle"), Refuses("one place") },
    { "vertices and lines only", WithCells({ { 0 }, { 1, 2 } }, { { 3, 4, 5 } }, {}, {}),
      Warns("no triangle"), {} },
    { "points without cells", WithCells({}, {}, {}, {}), Warns("no triangle"), {} },
    { "polygons of one, two or no points",
      WithCells({}, {}, { { 0, 1 }, { 2 }, {}, { n - 1, 3, 4 } }, {}), {}, {} } };
}

std::vector<Kind> Scales()
{
  return { { "coordinates of 1e30", Scaled(1e30), {}, {} },
    { "coordinates of 1e30, single precision", Scaled(1e30, VTK_FLOAT), {}, {} },
    { "coordinates of 1e299", Scaled(1e299), {}, {} },
    { "coordinates of 1e-299", Scaled(1e-299), {}, {} },
    { "coordinates of 1e-30", Scaled(1e-30), {}, {} },
    { "coordinates of 1e-30, single precision", Scaled(1e-30, VTK_FLOAT), {}, {} },
    { "coordinates above 1e300", MakeWidest(), Refuses("point 0 is farther"),
      Refuses("point 0 is farther") },
    { "1e6 from the origin", Shifted(MakeBall(), { 1e6, -1e6, 1e6 }), {}, {} },
    { "points of single precision", MakeBall(Faces::Triangles, VTK_FLOAT), {}, {} },
    { "whole-numbered points",
      Mapped(
        Scaled(100), [](const Vector& x) { return x; }, VTK_INT),
      {}, {} } };
}

std::vector<Kind> Cells()
{
  const Surface warped = Mapped(MakeBall(Faces::Quads),
    [](const Vector& x) {
      return Vector{ x[0] + 0.4 * x[1] * x[2], x[1], x[2] + 0.3 * x[0] };
    });
  const std::vector<Vector> crossing = { { 0, 0, 0 }, { 2, 1, 0 }, { 2, 0, 0 }, { 0, 1, 0 },
    { 1, 3, 1 }, { -1, 2, 1 } };
  const std::vector<Vector> folded = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 1, 0, 0 },
    { 1, 2, 0 }, { 0, 1, 1 } };
  return { { "quads with warped faces", warped, {}, {} },
    { "polygons that cross themselves",
      MakeSurface(crossing, { { 0, 1, 2, 3 }, { 3, 1, 4 }, { 0, 1, 2, 4, 3, 5 } }), Warns("fan"),
      {} },
    { "polygons that cannot be triangulated",
      MakeSurface(folded, { { 0, 1, 2, 3, 0 }, { 0, 2, 4 }, { 0, 2, 5 } }), Warns("fan"), {} },
    { "polygons of thousands of corners", MakeStar(1002), {}, {} },
    { "strips", MakeBall(Faces::Strips), {}, {} },
    { "strips of one or two points", WithCells({}, {}, { { 0, 1, 2 } }, { { 3 }, { 4, 5 } }), {},
      {} } };
}

std::vector<Kind> Topologies()
{
  const Surface needles = Squeezed({ 1e-7, 1e-7, 1 });
  const Surface doubled = MakeBall();
  for (vtkIdType cell = 0; cell < 5; ++cell)
  {
    vtkNew<vtkIdList> ids;
    doubled->GetPolys()->GetCellAtId(cell, ids);
    doubled->GetPolys()->InsertNextCell(ids);
  }
  return { { "10,000 components", MakeDust(10000), {}, Warns("hull") },
    { "bow-ties", MakeBowTies(), {}, {} }, { "Moebius strip", MakeMoebiusStrip(), {}, {} },
    { "Klein bottle", MakeKleinBottle(), {}, {} }, { "needles", needles, {}, Refuses("line") },
    { "slivers of 1e-7 degrees", MakeSliver(1e-9), {}, {} },
    { "slivers of 1e-9 degrees", MakeSliver(1e-11), Warns("degenerate"), {} },
    { "triangles twice", doubled, {}, {} } };
}

std::vector<Kind> Broken()
{
  const vtkIdType n = MakeBall()->GetNumberOfPoints();
  const auto normals = [](vtkIdType tuples) {
    return [tuples](vtkPolyData* s) { s->GetPointData()->SetNormals(BadArray("few", tuples, 3)); };
  };
  const auto point = [](double bad)
  { return [bad](vtkPolyData* s) { s->GetPoints()->SetPoint(3, bad, 0.0, 0.0); }; };
  const auto withNormals = [](const std::vector<Cell>& lines, const std::vector<Cell>& polygons)
  {
    Surface surface = WithCells({}, lines, polygons, {});
    auto array = MakeAny<vtkFloatArray>("n", surface->GetNumberOfCells(), 3);
    surface->GetCellData()->SetNormals(array);
    return surface;
  };
  return { { "points with NaN", With(point(NaN)), Refuses("point 3 is not finite"),
             Refuses("point 3 is not finite") },
    { "infinite points", With(point(HUGE_VAL)), Refuses("point 3 is not finite"),
      Refuses("point 3 is not finite") },
    { "point ids out of range", WithCells({}, {}, { { 0, 1, 2 }, { 0, 1, n } }, {}),
      Refuses("cell 1 names point"), Refuses("cell 1 names point") },
    { "point ids out of range in lines", withNormals({ { 0, n + 1000000 } }, { { 0, 1, 2 } }),
      Refuses("cell 0 names point"), Refuses("cell 0 names point") },
    { "point ids out of range in polygons of two points",
      withNormals({}, { { 0, 1, 2 }, { 0, -1000000 } }), Refuses("cell 1 names point -1000000"),
      Refuses("cell 1 names point -1000000") },
    { "offsets of cells that do not fit their ids",
      With(
        [](vtkPolyData* s)
        {
          vtkNew<vtkIdTypeArray> offsets, ids;
          for (const vtkIdType offset : { 0, 300, 3 })
          {
            offsets->InsertNextValue(offset);
          }
          for (const vtkIdType id : { 0, 1, 2 })
          {
            ids->InsertNextValue(id);
          }
          vtkNew<vtkCellArray> polys;
          polys->SetData(offsets, ids);
          s->SetPolys(polys);
        }),
      Refuses("offsets"), Refuses("offsets") },
    { "too few normals", With(normals(3)), Refuses("\"few\" has 3 tuples"),
      Refuses("\"few\" has 3 tuples") },
    { "normals without a tuple", With(normals(0)), {}, {} },
    { "normals that are bits",
      With(
        [n](vtkPolyData* s) { s->GetPointData()->SetNormals(MakeAny<vtkBitArray>("bits", n, 3)); }),
      {}, {} },
    { "arrays with NaN that nothing uses",
      With([n](vtkPolyData* s) { s->GetPointData()->AddArray(BadArray("bad", n, 2)); }), {}, {} },
    { "arrays named as the filters name theirs",
      With(
        [n](vtkPolyData* s)
        {
          for (const char* name : { "Displacement", "TargetDirection", "Normals", "Diagnosis" })
          {
            s->GetPointData()->AddArray(MakeStrings(name, n));
          }
        }),
      {}, {} },
    { "ghost points and cells", With(MarkGhosts), {}, {} },
    { "arrays without a name",
      With([n](vtkPolyData* s)
        { s->GetPointData()->AddArray(MakeAny<vtkDoubleArray>(nullptr, n, 1)); }),
      {}, {} } };
}

/// Where the page says what the filter does; nullptr where it does so of other filters.
const Outcome* OutcomeOf(const Subject& subject, const Kind& kind)
{
  return subject.name == "vtkSphericalStyleFilter" ? &kind.main
    : subject.name == "vtkConvexProxyDeformFilter" ? &kind.proxy
                                                   : nullptr;
}

/// One filter with its messages.
class Run
{
public:
  explicit Run(const Subject& subject)
    : Filter(subject.make())
  {
    Watch(this->Filter, vtkCommand::ErrorEvent, this->Errors);
    Watch(this->Filter, vtkCommand::WarningEvent, this->Warnings);
    Watch(this->Filter->GetExecutive(), vtkCommand::ErrorEvent, this->ExecutiveErrors);
  }

  vtkPolyData* operator()(vtkPolyData* input)
  {
    this->Errors.clear();
    this->Warnings.clear();
    this->Filter->SetInputData(input);
    this->Filter->Modified(); // also when it is the same, changed without a word
    this->Filter->Update();
    return this->Filter->GetOutput();
  }

  /// Of the last execution.
  std::vector<vtkSmartPointer<vtkDataObject>> Outputs() const { return AllOutputs(this->Filter); }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;

private:
  vtkSmartPointer<vtkPolyDataAlgorithm> Filter;
  std::vector<std::string> ExecutiveErrors;
};

bool FinitePoints(vtkPolyData* surface)
{
  return surface->GetNumberOfPoints() == 0 || AllFinite(surface->GetPoints()->GetData());
}

/// Whether the arrays that are not of the input are finite.
bool FiniteNewArrays(vtkPolyData* input, vtkPolyData* output)
{
  const auto finite = [](vtkFieldData* before, vtkFieldData* after)
  {
    bool all = true;
    for (int i = before->GetNumberOfArrays(); i < after->GetNumberOfArrays(); ++i)
    {
      auto* array = vtkArrayDownCast<vtkDataArray>(after->GetAbstractArray(i));
      all &= !array || AllFinite(array);
    }
    return all;
  };
  return finite(input->GetPointData(), output->GetPointData()) &&
    finite(input->GetCellData(), output->GetCellData());
}

void CheckOutcome(Checker& check, const Run& run, const Outcome& expected)
{
  const auto& told = expected.kind == Outcome::Refuses ? run.Errors : run.Warnings;
  check(run.Errors.size() == (expected.kind == Outcome::Refuses ? 1 : 0),
    "errors should be as the page says:" + Joined(run.Errors));
  check(run.Warnings.empty() == (expected.kind != Outcome::Warns),
    "warnings should be as the page says:" + Joined(run.Warnings));
  const bool said = std::any_of(told.begin(), told.end(),
    [&expected](const std::string& message) { return Contains(message, expected.word); });
  check(said || expected.kind == Outcome::Quiet,
    std::string("it should say \"") + expected.word + "\"" + Joined(told));
}

/// A filter that has run gives and says what a new one does, all outputs to the bit.
void CheckSame(Checker& check, const Run& kept, const Run& fresh, const std::string& what)
{
  check(kept.Errors.size() == fresh.Errors.size(),
    "errors should be those of a new filter" + what + Joined(kept.Errors) + Joined(fresh.Errors));
  check(kept.Warnings.size() == fresh.Warnings.size(),
    "warnings should be those of a new filter" + what + Joined(kept.Warnings) +
      Joined(fresh.Warnings));
  check(SameOutputs(kept.Outputs(), fresh.Outputs()),
    "all outputs should be those of a new filter" + what);
}

void CheckSound(Checker& check, const Subject& subject, const Kind& kind, Run& run)
{
  const auto before = Surface::New();
  before->DeepCopy(kind.input);
  vtkPolyData* output = run(kind.input);
  check(SamePolyData(before, kind.input), "the input should be unchanged to the bit");
  if (!run.Errors.empty())
  {
    check(
      run.Errors.size() == 1 && output->GetNumberOfPoints() == 0 && output->GetNumberOfCells() == 0,
      "there should be one error and no output" + Joined(run.Errors));
  }
  else
  {
    check(FinitePoints(output) || !FinitePoints(kind.input), "points should be finite");
    if (subject.deforms)
    {
      check(output->GetNumberOfPoints() == kind.input->GetNumberOfPoints(), "all points");
      check(output->GetNumberOfPoints() == 0 || SameCells(kind.input, output), "all cells");
      check(FiniteNewArrays(kind.input, output), "new arrays should be finite");
    }
  }
  if (const Outcome* expected = OutcomeOf(subject, kind))
  {
    CheckOutcome(check, run, *expected);
  }
  else if (subject.refuses && kind.main.kind == Outcome::Refuses)
  {
    CheckOutcome(check, run, kind.main);
  }
}

/// @param number  of the subject: where the page says nothing of it, every third kind comes after
/// others, another third than for the next subject; a slow one gets only that third, and what is
/// refused
/// @param isComplete  or all are like slow ones, but where the page says what they do
void CheckKinds(Checker& check, const Subject& subject, bool isComplete, int number,
  const std::vector<Kind>& kinds)
{
  const Surface good = MakeBall();
  Run first(subject);
  first(good);
  Run kept(subject);
  kept(good);
  for (const Kind& kind : kinds)
  {
    check.About(subject.name + ", " + kind.name);
    const bool always = OutcomeOf(subject, kind) != nullptr;
    const bool isNext = ++number % 3 == 0;
    const bool hasThird = subject.isSlow || !(isComplete || always);
    if (hasThird && !isNext && kind.main.kind != Outcome::Refuses)
    {
      continue;
    }
    Run fresh(subject);
    CheckSound(check, subject, kind, fresh);
    const bool isLarge = kind.input->GetNumberOfPoints() > 2000; // takes seconds
    if (isLarge || (!always && !isNext))
    {
      continue;
    }
    kept(kind.input);
    CheckSame(check, kept, fresh, ", after another surface");
    if (always)
    {
      kept(good);
      CheckSame(check, kept, first, ", back at a good surface");
    }
  }
  kept(good);
  CheckSame(check, kept, first, ", back at a good surface");
}

//------------------------------------------------------------------------------------------------
/// Changes of an input that a filter has already run over, most of them behind VTK's back.
std::vector<std::pair<std::string, std::function<void(vtkPolyData*)>>> Changes()
{
  const auto raw = [](vtkPolyData* s)
  { return static_cast<double*>(s->GetPoints()->GetData()->GetVoidPointer(0)); };
  return { { "nothing", [](vtkPolyData*) {} },
    { "a coordinate in place", [raw](vtkPolyData* s) { raw(s)[3 * 5 + 1] += 0.3; } },
    { "all points in place",
      [raw](vtkPolyData* s) {
        std::for_each(raw(s), raw(s) + 3 * s->GetNumberOfPoints(), [](double& x) { x *= 1.25; });
      } },
    { "two points at one place",
      [raw](vtkPolyData* s) { std::copy_n(raw(s) + 15, 3, raw(s) + 18); } },
    { "a NaN in place", [raw](vtkPolyData* s) { raw(s)[3 * 7] = NaN; } },
    { "the NaN away", [raw](vtkPolyData* s) { raw(s)[3 * 7] = 0.5; } },
    { "a triangle turned round in place",
      [](vtkPolyData* s)
      {
        vtkNew<vtkIdList> ids;
        s->GetPolys()->GetCellAtId(4, ids);
        const vtkIdType turned[] = { ids->GetId(1), ids->GetId(0), ids->GetId(2) };
        s->GetPolys()->ReplaceCellAtId(4, 3, turned);
      } },
    { "an id out of range in place",
      [](vtkPolyData* s)
      {
        const vtkIdType ids[] = { 0, 1, 1000000 };
        s->GetPolys()->ReplaceCellAtId(4, 3, ids);
      } },
    { "another triangle in place",
      [](vtkPolyData* s)
      {
        const vtkIdType ids[] = { 0, 1, 30 };
        s->GetPolys()->ReplaceCellAtId(4, 3, ids);
      } },
    { "a line out of range",
      [](vtkPolyData* s) {
        s->SetLines(MakeCells({ { 0, 1000000 } }));
      } },
    { "a line",
      [](vtkPolyData* s) {
        s->SetLines(MakeCells({ { 0, 1 } }));
      } },
    { "a cell more",
      [](vtkPolyData* s)
      {
        const vtkIdType ids[] = { 0, 20, 40 };
        s->GetPolys()->InsertNextCell(3, ids);
      } },
    { "a point more", [](vtkPolyData* s) { s->GetPoints()->InsertNextPoint(3.0, 0.0, 0.0); } },
    { "that point, which no cell uses, to the place of another",
      [raw](vtkPolyData* s)
      { std::copy_n(raw(s) + 15, 3, raw(s) + 3 * (s->GetNumberOfPoints() - 1)); } },
    { "normals",
      [](vtkPolyData* s)
      {
        s->GetPointData()->SetNormals(
          MakeArray("n", s, 3, [](vtkIdType i, int k) { return k == i % 3 ? 1.0 : 0.1; }));
      } },
    { "the normals in place",
      [](vtkPolyData* s) { s->GetPointData()->GetNormals()->SetComponent(3, 0, -1.0); } },
    { "fewer normals",
      [](vtkPolyData* s) { s->GetPointData()->GetNormals()->SetNumberOfTuples(2); } },
    { "no normals", [](vtkPolyData* s) { s->GetPointData()->Initialize(); } },
    { "other points",
      [](vtkPolyData* s)
      {
        s->SetPoints(Mapped(s,
          [](const Vector& x) {
            return Vector{ x[1], x[2], x[0] };
          })->GetPoints());
      } },
    { "no points", [](vtkPolyData* s) { s->Initialize(); } },
    { "another surface", [](vtkPolyData* s) { s->DeepCopy(MakeKleinBottle()); } } };
}

/// @param all  or every third change, of a slow filter every ninth
/// @param number  of the subject: others than for the next one
void CheckChanges(Checker& check, const Subject& subject, bool all, int number)
{
  const int step = all ? 1 : subject.isSlow ? 9 : 3;
  const Surface input = MakeBall();
  Run kept(subject);
  kept(input);
  for (const auto& [name, change] : Changes())
  {
    check.About(subject.name + ", changed: " + name);
    change(input);
    if (++number % step != 0)
    {
      continue;
    }
    kept(input);
    const auto copy = Surface::New();
    copy->DeepCopy(input);
    Run fresh(subject);
    fresh(copy);
    CheckSame(check, kept, fresh, "");
  }
}
}

int TestInputKinds(int argc, char* argv[])
{
  std::vector<Kind> kinds;
  for (const auto& group : { FewOrFlat(), Scales(), Cells(), Topologies(), Broken() })
  {
    Append(kinds, group);
  }
  const bool isComplete = IsComplete(argc, argv);
  Checker check;
  int number = 0;
  for (const Subject& subject : Subjects())
  {
    CheckKinds(check, subject, isComplete, number, kinds);
    CheckChanges(check, subject, OutcomeOf(subject, kinds.front()) != nullptr, number);
    ++number;
  }
  return check.Result();
}
