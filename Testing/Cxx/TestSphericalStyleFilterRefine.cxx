// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// RefineLongEdges: the surface stays the same and in one piece, no edge is too long, arrays and
// selections go along, and a flat box becomes round.
#include "ArrayTesting.h"

#include <limits>
#include <numeric>
#include <set>

using namespace FilterTesting;

namespace
{
constexpr double Rounding = 1e-12;
constexpr int RegionArray = 4;
constexpr int CenterIdArray = 5;

/// 8 points, 12 triangles, faces outward.
Surface Box(const Vector& size, int type = VTK_DOUBLE)
{
  std::vector<Vector> x;
  for (int i = 0; i < 8; ++i)
  {
    x.push_back({ size[0] * (i & 1), size[1] * (i >> 1 & 1), size[2] * (i >> 2 & 1) });
  }
  return MakeSurface(x,
    { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 }, { 2, 6, 7 },
      { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } },
    type);
}

/// The filter on a surface, refining, at Roundness 0: nothing moves.
struct Refining : WatchedFilter
{
  explicit Refining(vtkPolyData* surface, double length = 0.1, double roundness = 0.0)
    : WatchedFilter(surface)
  {
    SetUpEnergy(this->Get());
    (*this)->SetRefineLongEdgesToOn();
    (*this)->SetMaximumEdgeLength(length);
    (*this)->SetRoundness(roundness);
    if (roundness == 0.0)
    {
      (*this)->SetCenterModeToCustom(); // or a new point may lie on it
      (*this)->SetCenter(70.0, 80.0, 90.0);
    }
  }
};

double Area(const Vector& a, const Vector& b, const Vector& c)
{
  Vector u, v, n;
  vtkMath::Subtract(b.data(), a.data(), u.data());
  vtkMath::Subtract(c.data(), a.data(), v.data());
  vtkMath::Cross(u.data(), v.data(), n.data());
  return 0.5 * vtkMath::Norm(n.data());
}

using Edge = std::pair<vtkIdType, vtkIdType>;

/// Number of triangles at each edge, of the smaller point id first.
std::map<Edge, int> Edges(vtkPolyData* surface)
{
  std::map<Edge, int> edges;
  for (const auto& t : TriangleCorners(surface))
  {
    for (int k = 0; k < 3; ++k)
    {
      ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    }
  }
  return edges;
}

/// Total length of the edges with that many triangles.
double LengthOfEdges(vtkPolyData* surface, int triangles)
{
  double sum = 0.0;
  for (const auto& [edge, count] : Edges(surface))
  {
    sum += count == triangles
      ? Distance(PointOf(surface, edge.first), PointOf(surface, edge.second))
      : 0.0;
  }
  return sum;
}

/// What holds of every refined surface of triangles that has not moved.
void CheckRefined(Checker& check, vtkPolyData* input, Refining& filter, double length)
{
  vtkPolyData* output = filter.Output();
  const double diagonal = Diagonal(input);
  check(filter.Errors.empty() && filter.Warnings.empty(),
    "no message expected" + Joined(filter.Errors) + Joined(filter.Warnings));
  check(output->GetNumberOfPoints() > input->GetNumberOfPoints(), "there should be new points");
  check.AtMost(
    LargestDistanceInPart(input, output) / diagonal, Rounding, "move of the first points");
  vtkDataArray* isNew = PointArray(output, "RefinedPoint");
  vtkDataArray* from = output->GetCellData()->GetArray("OriginalCell");
  if (!check(isNew && from, "RefinedPoint and OriginalCell should be there"))
  {
    return;
  }
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    check(isNew->GetComponent(i, 0) == (i < input->GetNumberOfPoints() ? 0.0 : 1.0),
      "RefinedPoint of point " + Text(i));
  }
  double longest = 0.0;
  for (const auto& edge : Edges(output))
  {
    longest = std::max(
      longest, Distance(PointOf(output, edge.first.first), PointOf(output, edge.first.second)));
  }
  check.AtMost(longest / diagonal, length * (1.0 + Rounding), "longest edge");

  // The area of every triangle of the input is that of its children, and in the same plane.
  const auto parents = TriangleCorners(input);
  std::vector<double> area(parents.size(), 0.0);
  const auto children = TriangleCorners(output);
  for (std::size_t c = 0; c < children.size(); ++c)
  {
    area[static_cast<std::size_t>(from->GetComponent(static_cast<vtkIdType>(c), 0))] +=
      Area(PointOf(output, children[c][0]), PointOf(output, children[c][1]),
        PointOf(output, children[c][2]));
  }
  for (std::size_t t = 0; t < parents.size(); ++t)
  {
    const double before = Area(
      PointOf(input, parents[t][0]), PointOf(input, parents[t][1]), PointOf(input, parents[t][2]));
    check.AtMost(std::abs(area[t] - before) / before, Rounding,
      "change of the area of triangle " + std::to_string(t));
  }
}

void ClosedSurface(Checker& check)
{
  for (const double length : { 0.4, 0.1, 0.03 })
  {
    check.About("box, " + std::to_string(length));
    const Surface box = Box({ 1.0, 2.0, 0.3 });
    auto before = Surface::New();
    before->DeepCopy(box);
    Refining filter(box, length);
    CheckRefined(check, box, filter, length);
    check(SamePolyData(before, box), "the input should stay as it is");
    vtkPolyData* output = filter.Output();
    for (const auto& edge : Edges(output))
    {
      check(edge.second == 2, "every edge should have two triangles");
    }
    std::set<Edge> directed;
    for (const auto& t : TriangleCorners(output))
    {
      for (int k = 0; k < 3; ++k)
      {
        check(directed.insert({ t[k], t[(k + 1) % 3] }).second, "one orientation");
      }
    }
    check(CoincidentPoints(output).empty(), "no point should be there twice");
    auto first = Surface::New();
    first->DeepCopy(output);
    Refining again(box, length);
    check(SamePolyData(first, again.Output()), "the same bits in a second run");
  }
}

void OpenAndNonManifold(Checker& check)
{
  check.About("open sheet");
  const Surface sheet = MakeSurface(
    { { 0, 0, 0 }, { 2, 0, 0 }, { 3, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 }, { 0, 2, 3 } });
  Refining filter(sheet);
  CheckRefined(check, sheet, filter, 0.1);
  check.AtMost(std::abs(LengthOfEdges(filter.Output(), 1) - 6.0 - std::sqrt(2.0)), Rounding,
    "change of the border");

  check.About("fan of three panels");
  std::vector<Vector> x = { { 0, 0, 0 }, { 0, 0, 1 } };
  std::vector<Cell> cells;
  for (int k = 0; k < 3; ++k)
  {
    const double phi = 2.0 * vtkMath::Pi() * k / 3.0;
    x.push_back({ std::cos(phi), std::sin(phi), 0 });
    x.push_back({ std::cos(phi), std::sin(phi), 1 });
    cells.push_back({ 0, 2 + 2 * k, 3 + 2 * k });
    cells.push_back({ 0, 3 + 2 * k, 1 });
  }
  const Surface fan = MakeSurface(x, cells);
  Refining three(fan);
  CheckRefined(check, fan, three, 0.1);
  check.AtMost(std::abs(LengthOfEdges(three.Output(), 3) - 1.0), Rounding, "change of the middle");
  check.AtMost(std::abs(LengthOfEdges(three.Output(), 1) - 9.0), Rounding, "change of the border");
  check(CoincidentPoints(three.Output()).empty(), "no point should be there twice");
}

/// Two faces on the same points share what is on their edges, and nothing inside.
void TwoSides(Checker& check)
{
  check.About("a panel with two sides");
  const Surface panel =
    MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.3, 1, 0 } }, { { 0, 1, 2 }, { 0, 2, 1 } });
  Refining filter(panel);
  CheckRefined(check, panel, filter, 0.1);
  const auto twins = CoincidentPoints(filter.Output());
  check(twins.size() > 10, "the insides should be apart");
  check(LengthOfEdges(filter.Output(), 1) == 0.0, "there should be no border");
}

/// A sheet of five triangles around its middle, cut from there to the border at y = 0 and to
/// nowhere else: points 1 and 5 are at one place, with different texture coordinates.
Surface CutSheet()
{
  Surface sheet = MakeSurface({ { 0, 0, 0 }, { 1, 0, 0.2 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 },
                                { 1, 0, 0.2 }, { 1, 1, 0.5 } },
    { { 0, 1, 6 }, { 5, 2, 6 }, { 2, 3, 6 }, { 3, 4, 6 }, { 4, 0, 6 } });
  const double u[] = { 0.0, 0.5, 0.1, 0.2, 0.3, 0.9, 0.7 };
  const auto coordinates = MakeArray(
    "uv", sheet, 2, [&](vtkIdType i, int k) { return k == 0 ? u[i] : PointOf(sheet, i)[1]; });
  sheet->GetPointData()->SetTCoords(coordinates);
  return sheet;
}

/// Barycentric coordinates of a point in the plane of a triangle.
Vector BarycentricIn(const Vector& a, const Vector& b, const Vector& c, const Vector& x)
{
  const double all = Area(a, b, c);
  return { Area(x, b, c) / all, Area(a, x, c) / all, Area(a, b, x) / all };
}

void Seams(Checker& check)
{
  check.About("seam that ends inside");
  const Surface sheet = CutSheet();
  Refining rest(sheet, 0.05);
  CheckRefined(check, sheet, rest, 0.05);
  vtkPolyData* flat = rest.Output();

  // The texture coordinates of every corner are those of its place in the triangle it is part of.
  const auto parents = TriangleCorners(sheet);
  const auto children = TriangleCorners(flat);
  vtkDataArray* from = flat->GetCellData()->GetArray("OriginalCell");
  vtkDataArray* before = sheet->GetPointData()->GetTCoords();
  vtkDataArray* uv = flat->GetPointData()->GetTCoords();
  if (!check(uv && uv->GetNumberOfTuples() == flat->GetNumberOfPoints(), "texture coordinates"))
  {
    return;
  }
  double error = 0.0;
  for (std::size_t c = 0; c < children.size(); ++c)
  {
    const auto& t =
      parents[static_cast<std::size_t>(from->GetComponent(static_cast<vtkIdType>(c), 0))];
    for (const vtkIdType i : children[c])
    {
      const Vector b = BarycentricIn(
        PointOf(sheet, t[0]), PointOf(sheet, t[1]), PointOf(sheet, t[2]), PointOf(flat, i));
      for (int k = 0; k < 2; ++k)
      {
        const double expected = b[0] * before->GetComponent(t[0], k) +
          b[1] * before->GetComponent(t[1], k) + b[2] * before->GetComponent(t[2], k);
        error = std::max(error, std::abs(uv->GetComponent(i, k) - expected));
      }
    }
  }
  check.AtMost(error, 1e-7, "error of the texture coordinates"); // areas of slivers by square roots

  // Each side of the cut has its own points, from the border to the middle.
  check.AtMost(std::abs(LengthOfEdges(flat, 1) - 2.0 * (std::sqrt(1.09) + std::sqrt(1.04)) - 6.0),
    Rounding, "change of the border");
  const auto sorted = [](std::vector<Cell> groups)
  {
    std::sort(groups.begin(), groups.end());
    return groups;
  };
  const auto twins = sorted(CoincidentPoints(flat));
  check(twins.size() == 8, "there should be 7 new points on each side of the cut");
  for (const double roundness : { 0.5, 5.0 })
  {
    Refining bent(sheet, 0.05, roundness);
    vtkPolyData* output = bent.Output();
    check(LargestDistance(flat, output) > 0.01, "it should move");
    check(sorted(CoincidentPoints(output)) == twins, "the cut should stay shut to the last bit");
    WatchedFilter made(sheet);
    made->SetRoundness(roundness);
    made->SetRefineLongEdgesToOn();
    made->SetMaximumEdgeLength(0.05);
    check(LargestDistance(flat, made.Output()) > 0.01, "with the defaults it should move");
    check(sorted(CoincidentPoints(made.Output())) == twins, "with the defaults too");
  }

  check.About("a point on the middle of another panel's edge");
  const Surface panels =
    Together({ MakeSurface({ { 0, 0, 0 }, { 2, 0, 0 }, { 1, 2, 0 } }, { { 0, 1, 2 } }),
      MakeSurface({ { 1, 0, 0 }, { 1.1, -0.1, 0 }, { 0.9, -0.1, 0 } }, { { 0, 2, 1 } }) });
  Refining touching(panels, 0.5);
  vtkPolyData* output = touching.Output();
  const std::vector<Cell> expected = { { 3, 6 } };
  check(CoincidentPoints(output) == expected, "they should not become one point");
}

/// Vertices, lines, a short and a long quad, a concave polygon, a strip of which all is long and
/// one of which nothing is.
void Cells(Checker& check)
{
  check.About("all kinds of cells");
  std::vector<Vector> x = { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 3, 0 }, { 0, 3, 0 },      // quad
    { 5, 0, 0 }, { 9, 0, 0 }, { 9, 3, 0 }, { 7, 1, 0 }, { 5, 3, 0 },                 // polygon
    { 10, 0, 0 }, { 10.1, 0, 0 }, { 10.1, 0.1, 0 }, { 10, 0.1, 0 },                  // short
    { 0, 4, 0 }, { 0, 7, 0 }, { 4, 4, 0 }, { 4, 7, 0 },                              // strip
    { 10, 4, 0 }, { 10, 4.1, 0 }, { 10.1, 4, 0 }, { 10.1, 4.1, 0 }, { -1, -1, 0 } }; // short
  const Surface mixed = MakeSurface(x, { { 0, 1, 2, 3 }, { 9, 10, 11, 12 }, { 4, 5, 6, 7, 8 } });
  mixed->SetVerts(MakeCells({ { 21 } }));
  mixed->SetLines(MakeCells({ { 0, 1 }, { 1, 2, 3 } }));
  mixed->SetStrips(MakeCells({ { 13, 14, 15, 16 }, { 17, 18, 19, 20 } }));
  mixed->GetCellData()->AddArray(MakeStrings("names", mixed->GetNumberOfCells()));
  mixed->GetCellData()->SetScalars(MakeAny<vtkIntArray>("numbers", mixed->GetNumberOfCells(), 2));
  mixed->GetCellData()->AddArray(MakeAny<vtkIntArray>("short", 2, 1));
  Refining filter(mixed, 0.05);
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty() && filter.Warnings.empty(), "no message" + Joined(filter.Warnings));
  check(output->GetNumberOfVerts() == 1 && output->GetNumberOfLines() == 2 &&
      output->GetNumberOfStrips() == 1,
    "vertices, lines and the short strip should be there");
  vtkDataArray* from = output->GetCellData()->GetArray("OriginalCell");
  vtkDataArray* numbers = output->GetCellData()->GetScalars();
  auto* names = vtkStringArray::SafeDownCast(output->GetCellData()->GetAbstractArray("names"));
  if (!check(from && numbers && names && from->GetNumberOfTuples() == output->GetNumberOfCells() &&
          numbers->GetNumberOfTuples() == output->GetNumberOfCells() &&
          names->GetNumberOfValues() == output->GetNumberOfCells(),
        "cell arrays should have a value for every cell"))
  {
    return;
  }
  check(
    SameArray(mixed->GetCellData()->GetArray("short"), output->GetCellData()->GetArray("short")),
    "an array without a value for every cell should stay");
  std::map<vtkIdType, double> areas;
  std::vector<vtkIdType> order;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    const auto parent = static_cast<vtkIdType>(from->GetComponent(c, 0));
    check(names->GetValue(c) == "value " + Text(parent), "name of cell " + Text(c));
    check(
      numbers->GetComponent(c, 1) == mixed->GetCellData()->GetScalars()->GetComponent(parent, 1),
      "number of cell " + Text(c));
    if (order.empty() || order.back() != parent)
    {
      order.push_back(parent);
    }
    output->GetCellPoints(c, ids);
    if (output->GetCellType(c) == VTK_TRIANGLE)
    {
      areas[parent] += Area(PointOf(output, ids->GetId(0)), PointOf(output, ids->GetId(1)),
        PointOf(output, ids->GetId(2)));
    }
    else
    {
      vtkNew<vtkIdList> old;
      mixed->GetCellPoints(parent, old);
      check(std::equal(ids->begin(), ids->end(), old->begin(), old->end()),
        "a kept cell should have its points");
    }
  }
  const std::vector<vtkIdType> expected = { 0, 1, 2, 3, 4, 5, 6, 7 };
  check(order == expected, "children should stand in the place of their parent");
  const std::map<vtkIdType, double> expectedAreas = { { 3, 12.0 }, { 5, 8.0 }, { 6, 12.0 } };
  check(areas.size() == 3, "three cells should be split");
  for (const auto& [parent, area] : expectedAreas)
  {
    check.AtMost(
      std::abs(areas[parent] - area), 1e-11, "error of the area of cell " + Text(parent));
  }
}

/// Same points and cells, byte for byte, where no edge is long.
void NothingLong(Checker& check)
{
  check.About("nothing is long");
  for (const Faces faces : { Faces::Triangles, Faces::Quads, Faces::Strips })
  {
    for (const int type : { VTK_FLOAT, VTK_DOUBLE })
    {
      const Surface model = MakeEllipsoid({ 1.0, 0.8, 2.0 }, faces, 16, 9, type);
      AddArrays(model);
      model->GetPolys()->ConvertTo32BitStorage();
      WatchedEnergy plain(model);
      Refining filter(model, 0.5, 0.5);
      vtkPolyData* output = filter.Output();
      check(SamePoints(plain.Output(), output), "the points should have the same bits");
      check(SameCells(plain.Output(), output), "the cells should be the same");
      output->GetPointData()->RemoveArray("RefinedPoint");
      output->GetCellData()->RemoveArray("OriginalCell");
      check(SamePolyData(plain.Output(), output), "and so should all arrays");
    }
  }
}

/// Every kind of array, on a box where a new point is the middle of two or lies in a triangle.
void Arrays(Checker& check)
{
  check.About("point arrays");
  const Surface box = Box({ 1.0, 2.0, 3.0 });
  AddArrays(box);
  vtkPointData* in = box->GetPointData();
  in->AddArray(MakeArray("linear", box, 2,
    [&](vtkIdType i, int k) { return 3.0 * PointOf(box, i)[k] - PointOf(box, i)[2] + 1.0; }));
  in->AddArray(MakeAny<vtkFloatArray>("short", 3, 1));
  Refining filter(box, 0.2);
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty(), "no error expected" + Joined(filter.Errors));
  vtkPointData* out = output->GetPointData();
  const vtkIdType n = output->GetNumberOfPoints();
  for (int k = 0; k < in->GetNumberOfArrays(); ++k)
  {
    const std::string name = in->GetArrayName(k);
    check(out->GetArrayName(k) == name, "array " + name + " should be in its place");
    vtkAbstractArray* array = out->GetAbstractArray(k);
    check(array->GetDataType() == in->GetAbstractArray(k)->GetDataType(), "type of " + name);
    check(name == "short" || array->GetNumberOfTuples() == n, "size of " + name);
    const bool blended =
      array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE || name == "colors";
    std::set<std::string> values; // of the input
    for (vtkIdType i = 0; i < in->GetAbstractArray(k)->GetNumberOfValues(); ++i)
    {
      values.insert(in->GetAbstractArray(k)->GetVariantValue(i).ToString());
    }
    for (vtkIdType i = 0; i < array->GetNumberOfValues() && !blended; ++i)
    {
      check(values.count(array->GetVariantValue(i).ToString()) == 1,
        name + " should have values of the input only");
    }
  }
  for (vtkIdType i = 0; i < n; ++i)
  {
    const Vector x = PointOf(output, i);
    for (int k = 0; k < 2; ++k)
    {
      check.AtMost(
        std::abs(PointArray(output, "linear")->GetComponent(i, k) - 3.0 * x[k] + x[2] - 1.0), 1e-12,
        "error of a linear array");
    }
    check.AtMost(std::abs(vtkMath::Norm(out->GetNormals()->GetTuple3(i)) - 1.0),
      i < 8 ? HUGE_VAL : 1e-6, "error of the length of a normal");
  }
  check(out->GetScalars() && std::string(out->GetScalars()->GetName()) == "scalars", "scalars");
  check(SameArray(PointArray(box, "short"), PointArray(output, "short")),
    "an array without a value for every point should stay");
  check(SameArrays(box->GetFieldData(), output->GetFieldData()), "field data should come along");
  check(!out->GetGlobalIds() && out->HasArray("ids"), "ids of two points are not global");
  check(output->GetCellData()->GetPedigreeIds() != nullptr, "but cells can have one origin");

  // A triangle with one long edge: the middle is between points 0 and 1, equally near.
  check.About("the middle of an edge");
  const Surface one = MakeSurface({ { 0, 0, 0 }, { 2, 0, 0 }, { 1, 0.1, 0 } }, { { 0, 1, 2 } });
  vtkNew<vtkIntArray> ids;
  ids->SetName("id");
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("color");
  colors->SetNumberOfComponents(3);
  for (const int value : { 10, 21, 30 })
  {
    ids->InsertNextValue(value);
    colors->InsertNextTuple3(value, 0, 255);
  }
  one->GetPointData()->AddArray(ids);
  one->GetPointData()->AddArray(colors);
  one->GetPointData()->SetNormals(
    MakeArray("n", one, 3, [](vtkIdType i, int k) { return i == k ? 5.0 : 0.0; }));
  Refining halved(one, 0.7);
  output = halved.Output();
  check(output->GetNumberOfPoints() == 4 && output->GetNumberOfCells() == 2, "two triangles");
  check(PointArray(output, "id")->GetComponent(3, 0) == 10.0, "the first of the two");
  check(PointArray(output, "color")->GetComponent(3, 0) == 16.0, "colors are blended");
}

/// New points of a region and of a selection, and center ids that are floating-point numbers.
void Parts(Checker& check)
{
  const Surface box = Box({ 1.0, 1.0, 1.0 });
  // Points 4 to 7 are the face z = 1: cells 2 and 3.
  const auto onTop = [](const Vector& x) { return x[2] == 1.0; };
  box->GetPointData()->AddArray(
    MakeArray("region", box, 1, [&](vtkIdType i, int) { return i >= 4 ? 1.0 : 0.0; }));
  const auto expectTop = [&](const std::string& about, const std::function<void(Refining&)>& choose)
  {
    check.About(about);
    Refining rest(box);
    Refining filter(box, 0.1, 1.0);
    filter->SetBorderWidth(0.0);
    choose(filter);
    vtkPolyData* output = filter.Output();
    check(filter.Errors.empty(), "no error expected" + Joined(filter.Errors));
    check(output->GetNumberOfPoints() == rest.Output()->GetNumberOfPoints(), "the same points");
    vtkDataArray* weights = PointArray(output, "RegionWeight");
    for (vtkIdType i = 0; i < output->GetNumberOfPoints() && weights; ++i)
    {
      const Vector x = PointOf(rest.Output(), i);
      check(weights->GetComponent(i, 0) == (onTop(x) ? 1.0 : 0.0), "RegionWeight of " + Text(i));
    }
    check(weights != nullptr, "there should be RegionWeight");
  };
  expectTop("region",
    [](Refining& filter)
    { filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region"); });
  expectTop("selected points",
    [](Refining& filter) {
      filter->SetSelectionData(MakeSelection({ 4, 5, 6, 7 }, vtkSelectionNode::POINT));
    });
  expectTop("selected cells",
    [](Refining& filter) {
      filter->SetSelectionData(MakeSelection({ 2, 3 }, vtkSelectionNode::CELL));
    });

  check.About("nothing selected");
  Refining none(box, 0.1, 1.0);
  none->SetSelectionData(MakeSelection({}, vtkSelectionNode::POINT));
  Refining rest(box);
  check.AtMost(LargestDistance(rest.Output(), none.Output()), Rounding, "move");

  check.About("center ids");
  box->GetPointData()->AddArray(
    MakeArray("part", box, 1, [](vtkIdType i, int) { return i >= 4 ? 2.0 : 7.0; }));
  Refining centers(box, 0.1, 1.0);
  centers->SetInputArrayToProcess(CenterIdArray, 0, 0, OfPoints, "part");
  vtkPolyData* output = centers.Output();
  check(centers.Errors.empty(), "no error expected" + Joined(centers.Errors));
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const double z = PointOf(rest.Output(), i)[2];
    const double id = PointArray(output, "part")->GetComponent(i, 0);
    check(id == 2.0 || id == 7.0, "an id of the input");
    check(z > 0.125 || id == 7.0, "the id of the nearest point at the foot");
    check(z < 0.875 || id == 2.0, "the id of the nearest point at the top");
  }
}

/// Standard deviation over mean of the distance from the mean of points all over the surface.
double SpreadOfSurface(vtkPolyData* surface)
{
  constexpr int Cuts = 12;
  std::vector<Vector> samples;
  std::vector<double> weights;
  Vector mean = { 0.0, 0.0, 0.0 };
  for (const auto& t : TriangleCorners(surface))
  {
    const Vector a = PointOf(surface, t[0]), b = PointOf(surface, t[1]), c = PointOf(surface, t[2]);
    for (int i = 0; i < Cuts; ++i)
    {
      for (int j = 0; j + i < Cuts; ++j)
      {
        const double u = (i + 1.0 / 3.0) / Cuts, v = (j + 1.0 / 3.0) / Cuts;
        samples.emplace_back();
        for (int k = 0; k < 3; ++k)
        {
          samples.back()[k] = (1.0 - u - v) * a[k] + u * b[k] + v * c[k];
        }
        weights.push_back(Area(a, b, c));
      }
    }
  }
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (std::size_t s = 0; s < samples.size(); ++s)
  {
    for (int k = 0; k < 3; ++k)
    {
      mean[k] += weights[s] / all * samples[s][k];
    }
  }
  double sum = 0.0, squares = 0.0;
  for (std::size_t s = 0; s < samples.size(); ++s)
  {
    const double radius = Distance(samples[s], mean);
    sum += weights[s] / all * radius;
    squares += weights[s] / all * radius * radius;
  }
  return std::sqrt(std::max(0.0, squares - sum * sum)) / sum;
}

void BecomesRound(Checker& check)
{
  check.About("a flat box");
  const Surface box = Box({ 1.0, 1.5, 0.4 });
  WatchedEnergy coarse(box);
  coarse->SetRoundness(5.0);
  const double before = SpreadOfSurface(coarse.Output());
  double last = before;
  for (const double length : { 0.3, 0.1, 0.04 })
  {
    Refining fine(box, length, 5.0);
    fine->SetSphericalWeightingToCotangent();
    const double spread = SpreadOfSurface(fine.Output());
    check(fine.Errors.empty() && fine.Warnings.empty(), "no message" + Joined(fine.Warnings));
    check(spread < last, "finer should be rounder");
    last = spread;
  }
  std::cout << "spread of the radius: " << before << " with 12 triangles, " << last << " refined\n";
  check.AtMost(last, before / 4.0, "spread of the radius");

  check.About("its Displacement");
  Refining fine(box, 0.1, 5.0), rest(box, 0.1);
  vtkDataArray* displacement = PointArray(fine.Output(), "Displacement");
  for (vtkIdType i = 0; i < fine.Output()->GetNumberOfPoints(); ++i)
  {
    const Vector from = PointOf(rest.Output(), i), to = PointOf(fine.Output(), i);
    const Vector d = TupleOf(displacement, i);
    const Vector by = { to[0] - from[0], to[1] - from[1], to[2] - from[2] };
    check.AtMost(Distance(d, by), Rounding, "error of Displacement");
  }
}

/// Where a twentieth of the area has edges above a tenth of the diagonal, Automatic is On, else
/// Off.
void Automatic(Checker& check)
{
  const auto outputs = [](vtkPolyData* surface, int refine)
  {
    WatchedFilter filter(surface);
    filter->SetRefineLongEdges(refine);
    Surface output = Surface::New();
    output->DeepCopy(filter.Output());
    return output;
  };
  using F = vtkSphericalStyleFilter;
  // A fine ball beside a panel of two triangles with a share of all area.
  const Surface ball = MakeEllipsoid({ 1.0, 1.0, 1.0 }, Faces::Triangles, 48, 47);
  const double areaOfBall = 4.0 * vtkMath::Pi();
  for (const auto& [share, isCoarse] :
    { std::pair(0.0, false), std::pair(0.04, false), std::pair(0.06, true), std::pair(1.0, true) })
  {
    check.About("automatic, coarse share " + vtkVariant(share).ToString());
    const double side = std::sqrt(share < 1.0 ? areaOfBall * share / (1.0 - share) : 1.0);
    const Surface panel =
      MakeSurface({ { 3, 0, 0 }, { 3 + side, 0, 0 }, { 3 + side, side, 0 }, { 3, side, 0 } },
        { { 0, 1, 2 }, { 0, 2, 3 } });
    const Surface model = share == 0.0 ? ball
      : share == 1.0                   ? Box({ 1.0, 1.5, 0.4 })
                                       : Together({ ball, panel });
    const Surface automatic = outputs(model, F::WHERE_COARSE);
    check(SamePolyData(automatic, outputs(model, isCoarse ? F::ALWAYS : F::NEVER)),
      isCoarse ? "it should be On" : "it should be Off");
    check((automatic->GetNumberOfPoints() > model->GetNumberOfPoints()) == isCoarse,
      "new points where it is coarse");
  }

  check.About("automatic, and the thesis");
  WatchedFilter thesis(Box({ 1.0, 1.5, 0.4 }));
  thesis->ReproduceThesisOn();
  check(thesis.Output()->GetNumberOfPoints() == 8, "the thesis splits nothing");
}

/// The same triangles at every place and scale, with points of either type.
void Invariance(Checker& check)
{
  const Surface box = Box({ 1.0, 1.5, 0.375 });
  Refining filter(box, 0.1, 0.5);
  const Surface expected = filter.Output();
  for (const double scale : { 1e-60, 1e-6, 1e6, 1e60 })
  {
    check.About("scale " + vtkVariant(scale).ToString());
    const auto scaled = [&](const Vector& x) {
      return Vector{ scale * (x[0] + 3.0), scale * x[1], scale * x[2] };
    };
    const Surface model = Mapped(box, scaled);
    Refining other(model, 0.1, 0.5);
    check(SameCells(expected, other.Output()), "the same triangles");
    check.AtMost(
      LargestDistance(Mapped(expected, scaled), other.Output()) / scale, 1e-11, "difference");
  }
  check.About("single precision");
  Refining single(WithPointsOf(box, VTK_FLOAT), 0.1, 0.5);
  check(SameCells(expected, single.Output()), "the same triangles");
  check(single.Output()->GetPoints()->GetDataType() == VTK_FLOAT, "single it should stay");
  check.AtMost(LargestDistance(expected, single.Output()), 1e-6, "difference");

  check.About("at the end of single precision");
  const Surface far = Mapped(
    box,
    [](const Vector& x) {
      return Vector{ 32.0 * x[0] + 1e9, 64.0 * x[1], x[2] };
    },
    VTK_FLOAT);
  Refining there(far, 0.01, 0.5);
  there->SetMaximumNumberOfIterations(1);
  check(there.Output()->GetNumberOfPoints() > 8 && there.Errors.empty(), "it should end");
}

void BadInput(Checker& check)
{
  const auto expectError = [&](const std::string& about, const std::vector<std::string>& words,
                             const std::function<void(Refining&)>& spoil)
  {
    check.About(about);
    Refining filter(Box({ 1.0, 1.5, 0.4 }));
    spoil(filter);
    vtkPolyData* output = filter.Output();
    if (check(filter.Errors.size() == 1, "there should be one error"))
    {
      for (const std::string& word : words)
      {
        check(Contains(filter.Errors[0], word), "'" + word + "' expected in: " + filter.Errors[0]);
      }
    }
    check(output->GetNumberOfPoints() == 0, "no output");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  expectError("NaN", { "MaximumEdgeLength", "0.001..1" },
    [&](Refining& filter) { filter->SetMaximumEdgeLength(nan); });
  expectError("too many triangles", { "MaximumEdgeLength", "0.001", "2000000" },
    [&](Refining& filter) { filter->SetMaximumEdgeLength(0.001); });
  for (const double bad : { nan, infinite })
  {
    const Surface box = Box({ 1.0, 1.5, 0.4 });
    box->GetPoints()->SetPoint(5, 0.0, bad, 0.0);
    expectError(
      "a point not finite", { "point 5 " }, [&](Refining& filter) { filter->SetInputData(box); });
  }
  expectError("a cell without its point", { "cell 1 ", "point 9" },
    [](Refining& filter)
    {
      filter->SetInputData(
        MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 }, { 0, 1, 9 } }));
    });
  expectError("no such region", { "Region", "nowhere" },
    [](Refining& filter)
    { filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "nowhere"); });

  check.About("nothing to split");
  Refining points(MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 } }, {}));
  check(points.Output()->GetNumberOfPoints() == 2 && points.Errors.empty(), "points alone");
  Refining empty(Surface::New());
  check(empty.Output()->GetNumberOfPoints() == 0 && empty.Errors.empty(), "no points");
  Refining at(MakeSurface({ { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } }, { { 0, 1, 2 } }));
  check(at.Output()->GetNumberOfPoints() == 3 && at.Errors.empty(), "one place");

  check.About("a triangle without area");
  Refining thin(MakeSurface(
    { { 0, 0, 0 }, { 2, 0, 0 }, { 1, 0, 0 }, { 1, 2, 0 } }, { { 0, 1, 3 }, { 1, 0, 2 } }));
  vtkPolyData* output = thin.Output();
  check(thin.Errors.empty() && thin.Warnings.size() == 1 &&
      Contains(thin.Warnings[0],
        "1 degenerate triangle (without an area) left out, which is harmless, the first in cell 1"),
    "a warning in cells of the input" + Joined(thin.Warnings));
  check.AtMost(std::abs(LengthOfEdges(output, 1) - 2.0 - 2.0 * std::sqrt(5.0)), Rounding,
    "change of the border"); // no crack between the two

  check.About("off, and the thesis");
  const Surface box = Box({ 1.0, 1.5, 0.4 });
  WatchedEnergy plain(box);
  Refining filter(box, 0.1, 0.5);
  filter.Output();
  filter->SetRefineLongEdgesToOff();
  check(SamePolyData(plain.Output(), filter.Output()), "off it should be as if it had never been");
  filter->SetRefineLongEdgesToOn();
  filter->ReproduceThesisOn();
  check(filter.Output()->GetNumberOfPoints() == 8, "the thesis splits nothing");
}
}

int TestSphericalStyleFilterRefine(int, char*[])
{
  Checker check;
  ClosedSurface(check);
  OpenAndNonManifold(check);
  TwoSides(check);
  Seams(check);
  Cells(check);
  NothingLong(check);
  Arrays(check);
  Parts(check);
  BecomesRound(check);
  Automatic(check);
  Invariance(check);
  BadInput(check);
  return check.Result();
}
