// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every measure of vtkSurfaceMetrics on surfaces whose values are known by hand, and what must not
/// change them.
#include "SurfaceMetricsTesting.h"

#include "vtkSphereSource.h"

using namespace FilterTesting;

namespace
{
/// Half edges 1, 2, 3 around (5, 0, 0); quads, cut into triangles by the filter.
Surface MakeBox()
{
  std::vector<Vector> x;
  for (int i = 0; i < 8; ++i)
  {
    x.push_back({ 5.0 + (i & 1 ? 1.0 : -1.0), i & 2 ? 2.0 : -2.0, i & 4 ? 3.0 : -3.0 });
  }
  return MakeSurface(x,
    { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 },
      { 1, 3, 7, 5 } });
}

Surface MakeTetrahedron(const std::vector<Vector>& corners)
{
  return MakeSurface(corners, { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } });
}

/// The corner of a tetrahedron (cell 7 .. ) through one face of another: 3 pairs.
Surface MakeSpike()
{
  return Together({ MakeTetrahedron({ { 0, 0, 0 }, { 9, 0, 0 }, { 0, 9, 0 }, { 0, 0, 9 } }),
    MakeTetrahedron({ { 1, 1, -5 }, { 3, 1, -5 }, { 1, 3, -5 }, { 2, 2, 1 } }) });
}

void Box(Checker& check)
{
  check.About("a box of quads");
  WatchedMetrics m(MakeBox());
  m.ExpectSilence(check);
  m.Expect(check, "Points", 8);
  m.Expect(check, "Triangles", 12);
  m.Expect(check, "DegenerateTriangles", 0);
  m.Expect(check, "Edges", 18);
  m.Expect(check, "BorderEdges", 0);
  m.Expect(check, "NonManifoldEdges", 0);
  m.Expect(check, "MisorientedEdges", 0);
  m.Expect(check, "Closed", 1);
  m.Expect(check, "Components", 1);
  m.Expect(check, "EulerCharacteristic", 2);
  m.Expect(check, "Area", 88.0, 1e-12);
  m.Expect(check, "Volume", 48.0, 1e-12);
  const double pi = vtkMath::Pi();
  m.Expect(check, "Sphericity", std::cbrt(pi * 36.0 * 48.0 * 48.0) / 88.0, 1e-14);
  m.Expect(check, "RadiusSpread", 0.0, 1e-14); // all corners are equally far
  m.Expect(check, "FittedRadius", std::sqrt(14.0), 1e-12);
  m.Expect(check, "FittedSphereError", 0.0, 1e-12);
  m.Expect(check, "Center", 5.0, 1e-14);
  m.Expect(check, "FittedCenter", 5.0, 1e-12);
  m.Expect(check, "OverhangShare", 0.0);
  m.Expect(check, "ObtuseShare", 0.0);
  m.Expect(check, "LargestAngle", 90.0, 1e-12);
  m.Expect(check, "SmallestAngle", std::atan(1.0 / 3.0) * 180.0 / pi, 1e-12);
  m.Expect(check, "RmsDihedral", 90.0 * std::sqrt(12.0 / 18.0), 1e-12);
  m.Expect(check, "NegativeWeights", 0);
  m.Expect(check, "LambdaStar", 0.0);
  m.Expect(check, "OpposedEdges", 0);
  check(m.Table()->GetNumberOfRows() == 1, "there should be one row");
  check(!m.Has("AreaRatio") && !m.Has("Condition"), "what was not measured should not be there");
  check(m.Has("SelfIntersectionPairs") == WithCgal, "self-intersections should be looked for");
  const char* perCell[] = { "SmallestAngle", "LargestAngle" };
  const double angle[2] = { std::atan(1.0 / 2.0) * 180.0 / pi, 90.0 }; // bottom: 2 by 4
  for (int k = 0; k < 2; ++k)
  {
    check.AtMost(std::abs(m.OfCell(perCell[k], 0) - angle[k]), 1e-12, perCell[k]);
  }
  vtkFieldData* field = m.Output()->GetFieldData();
  for (vtkIdType i = 0; i < m.Table()->GetNumberOfColumns(); ++i)
  {
    vtkAbstractArray* column = m.Table()->GetColumn(i);
    check(SameArray(column, field->GetAbstractArray(column->GetName())),
      std::string(column->GetName()) + " should be field data as well");
  }
}

void Ball(Checker& check)
{
  check.About("a ball");
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(96);
  source->SetPhiResolution(96);
  source->SetRadius(2.0);
  source->SetCenter(1.0, 2.0, 3.0);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  WatchedMetrics m(source->GetOutput());
  m.ExpectSilence(check);
  check(m["Sphericity"] > 0.998 && m["Sphericity"] < 1.0, "the sphericity should be nearly 1");
  m.Expect(check, "FittedRadius", 2.0, 1e-6);
  check.AtMost(m["FittedSphereError"], 1e-6, "distance from the sphere");
  check.AtMost(m["RadiusSpread"], 1e-6, "radius spread");
  m.Expect(check, "OverhangShare", 0.0);
  check(!WithCgal || m["SelfIntersectionPairs"] == 0.0, "no triangles should intersect");
  for (vtkIdType i = 0; i < m.Output()->GetNumberOfPoints(); ++i)
  {
    check(m.OfPoint("RadialCosine", i) > 0.999, "normals should point from the center");
  }

  check.About("a ball from outside");
  m->SetCenterModeToCustom();
  // Two radii away: the third of the latitudes that it sees looks the wrong way.
  m->SetCenter(1.0, 2.0, 7.0);
  m.Expect(check, "OverhangShare", 1.0 / 3.0, 0.02);
  m->SetCenterModeToAreaCentroid();
  m.Expect(check, "Center", 1.0, 1e-6);
}

void Obtuse(Checker& check)
{
  check.About("a kite of two triangles of 120 degrees");
  const double h = std::sqrt(3.0);
  WatchedMetrics m(MakeSurface(
    { { -h, 0, 0 }, { h, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } }, { { 0, 1, 2 }, { 1, 0, 3 } }));
  m.ExpectSilence(check);
  m.Expect(check, "ObtuseShare", 1.0);
  m.Expect(check, "LargestAngle", 120.0, 1e-12);
  m.Expect(check, "NegativeWeights", 1);
  m.Expect(check, "LambdaStar", 1.0 / h, 1e-14);
  m.Expect(check, "Closed", 0);
  m.Expect(check, "BorderEdges", 4);
  m.Expect(check, "EulerCharacteristic", 1);
  for (const char* undefined : { "Volume", "Sphericity", "FittedRadius", "FittedSphereError" })
  {
    check(m.Has(undefined) && std::isnan(m[undefined]),
      std::string(undefined) + " of a flat sheet should be NaN");
  }
}

void SelfIntersections(Checker& check)
{
  check.About("a spike through a face");
  WatchedMetrics m(MakeSpike());
  m.ExpectSilence(check);
  m.Expect(check, "SelfIntersectionPairs", 3);
  m.Expect(check, "SelfIntersectingTriangles", 4);
  const double expected[] = { 3, 0, 0, 0, 0, 1, 1, 1 };
  for (vtkIdType cell = 0; cell < 8; ++cell)
  {
    check(m.OfCell("SelfIntersections", cell) == expected[cell], "pairs of cell " + Text(cell));
  }

  check.About("polygons: a needle through a pentagon, behind a vertex and a line");
  auto surface = MakeSurface({ { 0, 0, 0 }, { 4, 0, 0 }, { 5, 3, 0 }, { 2, 5, 0 }, { -1, 3, 0 },
                               { 2, 2, -1 }, { 2.1, 2.5, -1 }, { 2, 2.3, 1 } },
    { { 0, 1, 2, 3, 4 }, { 5, 6, 7 } });
  surface->SetVerts(MakeCells({ { 0 } }));
  surface->SetLines(MakeCells({ { 0, 1 } }));
  WatchedMetrics needle(surface);
  needle.ExpectSilence(check);
  check(
    needle.OfCell("SelfIntersections", 2) >= 1.0 && needle.OfCell("SelfIntersections", 3) >= 1.0,
    "both polygons should intersect");
  check(
    needle.OfCell("SelfIntersections", 0) == 0.0 && needle.OfCell("SelfIntersections", 1) == 0.0,
    "vertex and line should not");

  check.About("a strip folded flat");
  auto strip = MakeSurface(
    { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0.25, 0, 0 }, { 0.25, 1, 0 } }, {});
  strip->SetStrips(MakeCells({ { 0, 1, 2, 3, 4, 5 } }));
  WatchedMetrics folded(strip);
  folded.ExpectSilence(check);
  check(folded["SelfIntersectionPairs"] > 0 &&
      folded.OfCell("SelfIntersections", 0) == folded["SelfIntersectionPairs"],
    "each pair of a cell with itself should count once");

  check.About("switched off");
  m->FindSelfIntersectionsOff();
  check(
    !m.Has("SelfIntersectionPairs") && !m.Output()->GetCellData()->HasArray("SelfIntersections"),
    "there should be nothing");
}

void ExpectUndeformed(Checker& check, WatchedMetrics& m)
{
  m.ExpectSilence(check);
  m.Expect(check, "AreaRatio", 1.0, 1e-12);
  m.Expect(check, "VolumeRatio", 1.0, 1e-12);
  m.Expect(check, "SmallestAreaRatio", 1.0, 1e-11);
  m.Expect(check, "LargestAreaRatio", 1.0, 1e-11);
  m.Expect(check, "AreaRatioSpread", 0.0, 1e-12);
  m.Expect(check, "TurnedOver", 0);
  m.Expect(check, "DetailError", 0.0, 1e-12);
  m.Expect(check, "DihedralChange", 0.0, 1e-5); // the arc tangent near 0 and the degrees
  check(!WithCgal || m["NewSelfIntersectionPairs"] == 0.0, "no triangles should intersect");
}

Vector Turn(const Vector& x) // by 3-4-5 around z, then 5-12-13 around x
{
  const Vector y = { 0.6 * x[0] - 0.8 * x[1], 0.8 * x[0] + 0.6 * x[1], x[2] };
  return { y[0] + 7.0, (5.0 * y[1] - 12.0 * y[2]) / 13.0 - 2.0, (12.0 * y[1] + 5.0 * y[2]) / 13.0 };
}

void Pair(Checker& check)
{
  for (const Faces faces : { Faces::Triangles, Faces::Quads, Faces::Strips })
  {
    const Surface before = MakeEllipsoid({ 1.0, 0.7, 1.6 }, faces);
    check.About("a rigid motion, kind of faces " + Text(static_cast<int>(faces)));
    WatchedMetrics moved(Mapped(before, Turn), before);
    ExpectUndeformed(check, moved);
    check(moved["LargestDisplacement"] > 5.0, "it should have moved");

    check.About("twice the size");
    WatchedMetrics larger(Mapped(before,
                            [](const Vector& x) {
                              return Vector{ 2 * x[0], 2 * x[1], 2 * x[2] };
                            }),
      before);
    larger.ExpectSilence(check);
    larger.Expect(check, "AreaRatio", 4.0, 1e-12);
    larger.Expect(check, "VolumeRatio", 8.0, 1e-12);
    larger.Expect(check, "AreaRatioSpread", 0.0, 1e-12);
    larger.Expect(check, "DihedralChange", 0.0, 1e-5);
    larger.Expect(check, "LargestDisplacement", 1.6, 1e-12); // that of the poles
    check(larger["DetailError"] > 1e-3, "details should have grown");
    for (vtkIdType cell = 0; cell < before->GetNumberOfCells(); ++cell)
    {
      check(
        std::abs(larger.OfCell("AreaRatio", cell) - 4.0) < 1e-11, "ratio of cell " + Text(cell));
    }
  }

  check.About("one face of a box stretched");
  const Surface box = MakeBox();
  const Surface longer = Mapped(box,
    [](const Vector& x) {
      return Vector{ x[0] > 5.5 ? x[0] + 2.0 : x[0], x[1], x[2] };
    });
  WatchedMetrics m(longer, box);
  m.ExpectSilence(check);
  m.Expect(check, "VolumeRatio", 2.0, 1e-12);
  m.Expect(check, "LargestAreaRatio", 2.0, 1e-12);
  m.Expect(check, "SmallestAreaRatio", 1.0, 1e-12);
  // Four faces by 2, two stay: logarithms l, l, l, l, 0, 0 with l = ln 2.
  m.Expect(check, "AreaRatioSpread", std::log(2.0) * std::sqrt(2.0) / 3.0, 1e-12);
  m.Expect(check, "LargestDisplacement", 2.0, 1e-14);
  m.Expect(check, "DihedralChange", 0.0, 1e-5);
}

/// An octahedron whose top is two points.
Surface MakeOctahedron(double gap)
{
  return MakeSurface({ { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
                       { 0, 0, -1 }, { 0, 0, 1 + gap } },
    { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 6 }, { 3, 0, 6 }, { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 },
      { 0, 3, 5 } });
}

/// A closed surface has a volume, and its ratio needs that of both.
void OpenSeam(Checker& check)
{
  check.About("a seam that is open in the reference");
  WatchedMetrics opened(MakeOctahedron(0.0), MakeOctahedron(0.5));
  opened.Expect(check, "Closed", 1);
  opened.Expect(check, "Volume", 4.0 / 3.0, 1e-14);
  check(opened.Has("VolumeRatio") && std::isnan(opened["VolumeRatio"]),
    "an open reference should have no volume");

  check.About("a seam that is open in the surface");
  WatchedMetrics open(MakeOctahedron(0.5), MakeOctahedron(0.0));
  open.Expect(check, "Closed", 0);
  check(open.Has("VolumeRatio") && std::isnan(open["VolumeRatio"]), "nor should the surface");

  check.About("a seam that is closed in both");
  WatchedMetrics closed(MakeOctahedron(0.0), MakeOctahedron(0.0));
  closed.Expect(check, "VolumeRatio", 1.0, 1e-14);
}

/// One point of a fine sheet pulled across its neighbors, and the sheet turned.
void TurnedOver(Checker& check)
{
  check.About("a fold in a sheet");
  std::vector<Vector> x;
  std::vector<Cell> triangles;
  const vtkIdType k = 11;
  for (vtkIdType i = 0; i < k * k; ++i)
  {
    const vtkIdType row = i / k;
    x.push_back({ 1.0 * (i % k), 1.0 * row, 0.0 });
  }
  for (vtkIdType i = 0; i + k + 1 < k * k; ++i)
  {
    if (i % k + 1 < k)
    {
      triangles.push_back({ i, i + 1, i + k + 1 });
      triangles.push_back({ i, i + k + 1, i + k });
    }
  }
  const Surface before = MakeSurface(x, triangles);
  const vtkIdType middle = 5 * k + 5;
  x[middle][0] += 1.5; // beyond its neighbor
  const Surface after = Mapped(MakeSurface(x, triangles), Turn);
  WatchedMetrics m(after, before);
  m.ExpectSilence(check);
  vtkIdType expected = 0;
  for (vtkIdType cell = 0; cell < after->GetNumberOfCells(); ++cell)
  {
    const Cell& t = triangles[cell];
    const double area = (x[t[1]][0] - x[t[0]][0]) * (x[t[2]][1] - x[t[0]][1]) -
      (x[t[2]][0] - x[t[0]][0]) * (x[t[1]][1] - x[t[0]][1]);
    expected += area < 0.0;
    check(m.OfCell("TurnedOver", cell) == (area < 0.0 ? 1.0 : 0.0), "cell " + Text(cell));
  }
  check(expected == 2, "the pull should turn two triangles over");
  m.Expect(check, "TurnedOver", static_cast<double>(expected));
  if (WithCgal)
  {
    WatchedMetrics inPlane(MakeSurface(x, triangles), before); // exactly in one plane
    check(inPlane["NewSelfIntersectionPairs"] > 0 &&
        inPlane["NewSelfIntersectionPairs"] == inPlane["SelfIntersectionPairs"],
      "what overlaps should be new");
  }
}

/// Half edges 1, 2, 3; every face a fan of four triangles whose tip lies opposite the one across.
Surface MakeFannedBox()
{
  const Surface box = MakeBox();
  std::vector<Vector> x;
  for (vtkIdType i = 0; i < 8; ++i)
  {
    x.push_back(PointOf(box, i));
  }
  std::vector<Cell> triangles;
  vtkNew<vtkIdList> quad;
  for (vtkIdType c = 0; c < 6; ++c)
  {
    box->GetPolys()->GetCellAtId(c, quad);
    const auto tip = static_cast<vtkIdType>(x.size());
    Vector middle = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 4; ++k)
    {
      triangles.push_back({ quad->GetId(k), quad->GetId((k + 1) % 4), tip });
      for (int axis = 0; axis < 3; ++axis)
      {
        middle[axis] += 0.25 * x[quad->GetId(k)][axis];
      }
    }
    x.push_back(middle);
  }
  return MakeSurface(x, triangles);
}

void Thickness(Checker& check)
{
  check.About("thickness of a box pressed flat");
  const Surface box = MakeFannedBox();
  const auto press = [](const Vector& x) { return Vector{ x[0], 0.05 * x[1], 2.0 * x[2] }; };
  const Surface pressed = Mapped(box, press);
  WatchedMetrics m(pressed, box);
  m.ExpectSilence(check);
  const double expected[] = { 2.0, 2.0, 0.05, 0.05, 1.0, 1.0 }; // tips, in the order of the faces
  for (vtkIdType face = 0; face < 6; ++face)
  {
    check.AtMost(std::abs(m.OfPoint("ThicknessRatio", 8 + face) - expected[face]), 1e-12,
      "error at the tip of face " + Text(face));
  }
  m.Expect(check, "SmallestThicknessRatio", 0.05, 1e-12);
  m.Expect(check, "ThinnedShare", 2.0 / 14.0, 1e-14);

  check.About("thickness behind a point of no triangle");
  std::vector<Vector> x = { { 9, 9, 9 } };
  std::vector<Cell> triangles;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < box->GetNumberOfPoints(); ++i)
  {
    x.push_back(PointOf(box, i));
  }
  for (vtkIdType c = 0; c < box->GetNumberOfCells(); ++c)
  {
    box->GetPolys()->GetCellAtId(c, ids);
    triangles.push_back({ ids->GetId(0) + 1, ids->GetId(1) + 1, ids->GetId(2) + 1 });
  }
  const Surface shifted = MakeSurface(x, triangles);
  WatchedMetrics more(Mapped(shifted, press), shifted);
  check(std::isnan(more.OfPoint("ThicknessRatio", 0)), "it should have none");
  for (vtkIdType i = 0; i < box->GetNumberOfPoints(); ++i)
  {
    check(more.OfPoint("ThicknessRatio", 1 + i) == m.OfPoint("ThicknessRatio", i),
      "point " + Text(i) + " should have the same as before");
  }
  more.Expect(check, "ThinnedShare", 2.0 / 14.0, 1e-14);

  check.About("thickness of a sheet");
  const Surface sheet =
    MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } });
  WatchedMetrics none(sheet, sheet);
  none.ExpectSilence(check);
  check(std::isnan(none.OfPoint("ThicknessRatio", 2)) && none.Has("ThinnedShare") &&
      std::isnan(none["ThinnedShare"]) && std::isnan(none["SmallestThicknessRatio"]),
    "it should have none");

  check.About("thickness switched off");
  m->MeasureThicknessOff();
  check(!m.Has("ThinnedShare") && !m.Output()->GetPointData()->HasArray("ThicknessRatio"),
    "there should be nothing");
}

void NewSelfIntersections(Checker& check)
{
  check.About("old and new self-intersections");
  const Surface before = MakeSpike();
  const Surface after = Mapped(before,
    [](const Vector& x) {
      return Vector{ x[0], x[1], x[2] < -4.0 || x[2] == 1.0 ? x[2] + 2.0 : x[2] };
    });
  WatchedMetrics same(Mapped(before, Turn), before);
  same.Expect(check, "NewSelfIntersectionPairs", 0);
  same.Expect(check, "SelfIntersectionPairs", 3);
  // 2 up, the tip is at (2, 2, 3), still inside of the plane x + y + z = 9: the same three pairs.
  WatchedMetrics deeper(after, before);
  deeper.Expect(check, "NewSelfIntersectionPairs", 0);
  // 6 up, it leaves through that plane: three pairs more.
  const Surface through = Mapped(before,
    [](const Vector& x) {
      return Vector{ x[0], x[1], x[2] == 1.0 ? 7.0 : x[2] };
    });
  WatchedMetrics out(through, before);
  out.Expect(check, "SelfIntersectionPairs", 6);
  out.Expect(check, "NewSelfIntersectionPairs", 3);
  out.Expect(check, "NewSelfIntersectingTriangles", 4);
  WatchedMetrics back(before, through);
  back.Expect(check, "NewSelfIntersectionPairs", 0);
}

/// What has no unit must not change with place and size; areas, volumes and lengths as they must.
void Invariance(Checker& check)
{
  const Surface before = MakeEllipsoid({ 1.0, 0.7, 1.6 }, Faces::Quads);
  const Surface after = Mapped(before,
    [](const Vector& x) {
      return Vector{ x[0] + 0.2 * x[2] * x[2], 1.3 * x[1], x[2] };
    });
  WatchedMetrics m(after, before);
  m->EstimateConditionOn();
  for (const double scale : { 1e-6, 1e6 })
  {
    check.About("scaled by " + vtkVariant(scale).ToString());
    const auto place = [&](const Vector& x) {
      return Vector{ scale * (x[0] + 3.0), scale * (x[1] - 1.0), scale * x[2] };
    };
    WatchedMetrics scaled(Mapped(after, place), Mapped(before, place));
    scaled->EstimateConditionOn();
    scaled.ExpectSilence(check);
    for (vtkIdType i = 0; i < m.Table()->GetNumberOfColumns(); ++i)
    {
      const std::string name = m.Table()->GetColumnName(i);
      const int power = name == "Area"                            ? 2
        : name == "Volume"                                        ? 3
        : name == "FittedRadius" || name == "LargestDisplacement" ? 1
                                                                  : 0;
      if (name != "Center" && name != "FittedCenter" && name != "ConditionAccuracy")
      {
        const double expected = m[name.c_str()] * std::pow(scale, power);
        // Dihedral angles of flat quads are the arc tangent of rounding errors.
        scaled.Expect(check, name.c_str(), expected, 1e-6 * std::abs(expected));
      }
    }
  }
  check.About("again");
  WatchedMetrics again(after, before);
  again->EstimateConditionOn();
  check(SamePolyData(again.Output(), m.Output()), "the same input should give the same bits");
}

void Condition(Checker& check)
{
  check.About("condition of a regular tetrahedron");
  WatchedMetrics m(MakeTetrahedron({ { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } }));
  m->EstimateConditionOn();
  m.ExpectSilence(check);
  m.Expect(check, "Condition", 1.0, 1e-12);
  m.Expect(check, "PinnedCondition", 4.0, 1e-12);
  check.AtMost(m["ConditionAccuracy"], 1e-6, "the stated accuracy");
  check.About("condition and Roundness");
  WatchedMetrics slivers(MakeEllipsoid({ 1.0, 0.7, 0.2 }, Faces::Triangles, 24, 30));
  slivers->EstimateConditionOn();
  const double small = slivers["Condition"];
  slivers->SetRoundness(5.0);
  check(slivers["Condition"] < small, "uniform weights should make slivers better");
}
}

int TestSurfaceMetricsValues(int, char*[])
{
  Checker check;
  Box(check);
  Ball(check);
  Obtuse(check);
  Pair(check);
  OpenSeam(check);
  TurnedOver(check);
  Thickness(check);
  Invariance(check);
  Condition(check);
  if (WithCgal)
  {
    SelfIntersections(check);
    NewSelfIntersections(check);
  }
  return check.Result();
}
