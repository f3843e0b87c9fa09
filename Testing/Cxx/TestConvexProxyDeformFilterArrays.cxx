// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// What comes in with the points goes out with them; what the filter adds is what its formulas say,
/// evaluated here a second time; what it takes as arrays does what the property does.
#include "ArrayTesting.h"
#include "ConvexProxyTesting.h"

#include <numeric>
#include <set>

using namespace FilterTesting;

namespace
{
/// The proxy before it was rounded.
Surface RestOf(vtkPolyData* proxy)
{
  vtkNew<vtkPoints> places;
  places->SetData(PointArray(proxy, "RestPosition"));
  auto rest = Surface::New();
  rest->ShallowCopy(proxy);
  rest->SetPoints(places);
  return rest;
}

/// MoveOfCentroid of the proxy since its rest.
double MoveOfProxy(vtkPolyData* proxy)
{
  std::vector<vtkIdType> points(proxy->GetNumberOfPoints());
  std::iota(points.begin(), points.end(), 0);
  return MoveOfCentroid(RestOf(proxy), proxy, points);
}

/// Tolerance for two evaluations of one formula in double, of the diagonal.
constexpr double Rounding = 1e-12;

void EveryArray(Checker& check)
{
  for (const auto faces : { Faces::Triangles, Faces::Strips })
  {
    check.About("arrays of the input");
    const Surface input = MakeEllipsoid({ 1.0, 0.8, 2.0 }, faces);
    input->GetPoints()->InsertNextPoint(0.1, 0.2, 0.3);
    input->SetVerts(MakeCells({ { 3 }, { 7 } }));
    input->SetLines(MakeCells({ { 1, 2, 3 } }));
    AddArrays(input);
    input->GetPointData()->SetTCoords(
      MakeAny<vtkFloatArray>("texture", input->GetNumberOfPoints(), 2));
    vtkNew<vtkPolyData> before;
    before->DeepCopy(input);
    WatchedProxyFilter filter(input);
    vtkPolyData* output = filter.Output();
    check(SamePolyData(before, input), "the input should stay as it is");
    check(SameCells(input, output), "cells should come out byte for byte");
    CheckPassedOn(check, input->GetPointData(), output->GetPointData(), "my normals");
    CheckPassedOn(check, input->GetCellData(), output->GetCellData(), "");
    CheckPassedOn(check, input->GetFieldData(), output->GetFieldData(), "");
    check(SameActiveAttributes(input->GetPointData(), output->GetPointData()) &&
        SameActiveAttributes(input->GetCellData(), output->GetCellData()),
      "active attributes should stay active");
    check(
      output->GetPointData()->GetNumberOfArrays() == input->GetPointData()->GetNumberOfArrays() + 2,
      "only t and Displacement should be new");
  }
  check.About("an input array of the name t");
  const Surface input = MakeDented();
  input->GetPointData()->AddArray(
    MakeArray("t", input, 1, [](vtkIdType i, int) { return (i % 5) / 8.0; }));
  WatchedProxyFilter filter(input);
  filter->SetBlendFunctionToArray();
  filter->SetInputArrayToProcess(BlendArray, 0, 0, OfPoints, "t");
  check(SameArray(PointArray(input, "t"), PointArray(filter.Output(), "t")),
    "used as t, it should come out as it went in");
}

void CheckArray(
  Checker& check, vtkDataArray* array, const char* name, int type, int components, vtkIdType tuples)
{
  check(array && array->GetDataType() == type && array->GetNumberOfComponents() == components &&
      array->GetNumberOfTuples() == tuples && AllFinite(array),
    std::string(name) + " should have type " + Text(type) + ", " + Text(components) +
      " components and " + Text(tuples) + " finite tuples");
}

/// What the three outputs promise, by the header.
void Promises(Checker& check, vtkPolyData* model, const char* name)
{
  const vtkIdType n = model->GetNumberOfPoints();
  const double diagonal = Diagonal(model);
  const bool single = model->GetPoints()->GetDataType() == VTK_FLOAT;
  vtkNew<vtkIdList> ids;
  const Surface input = Surface::New();
  input->ShallowCopy(model);
  input->GetPointData()->AddArray(
    MakeArray("t3", input, 3, [](vtkIdType i, int k) { return ((3 * i + k) % 9) / 8.0; }));
  input->GetPointData()->AddArray(
    MakeArray("d", input, 3, [](vtkIdType i, int k) { return std::sin(i + 2.0 * k); }));
  for (const int projection : { 0, 1, 2, 3 })
  {
    for (const bool perAxis : { false, true })
    {
      check.About(std::string(name) + ", projection " + Text(projection) +
        (perAxis ? ", t per axis" : ", t along an axis"));
      WatchedProxyFilter filter(input);
      filter->SetProjection(projection);
      filter->SetInputArrayToProcess(DirectionsArray, 0, 0, OfPoints, "d");
      filter->SetInputArrayToProcess(BlendArray, 0, 0, OfPoints, "t3");
      filter->SetBlendFunction(perAxis ? 5 : 4);
      filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
      filter->GenerateProjectionArraysOn();
      vtkPolyData* output = filter.Output();
      vtkPolyData* proxy = filter.Output(1);
      vtkPolyData* lines = filter.Output(2);
      check(filter.Errors.empty(), "no error" + Joined(filter.Errors));
      vtkDataArray* t = PointArray(output, "t");
      vtkDataArray* cells = PointArray(output, "ProxyCell");
      vtkDataArray* barycentric = PointArray(output, "Barycentric");
      vtkDataArray* cases = PointArray(output, "ProjectionCase");
      CheckArray(check, t, "t", VTK_DOUBLE, perAxis ? 3 : 1, n);
      CheckArray(check, PointArray(output, "Displacement"), "Displacement", VTK_DOUBLE, 3, n);
      CheckArray(check, cells, "ProxyCell", VTK_ID_TYPE, 1, n);
      CheckArray(check, barycentric, "Barycentric", VTK_DOUBLE, 3, n);
      check(!cases == (projection != 1), "ProjectionCase is for NearestVertices only");
      int counts[3] = { 0, 0, 0 };
      if (cases)
      {
        CheckArray(check, cases, "ProjectionCase", VTK_INT, 1, n);
        for (vtkIdType i = 0; i < n; ++i)
        {
          const auto number = static_cast<int>(cases->GetComponent(i, 0));
          check(number >= 1 && number <= 3, "cases are 1 to 3");
          ++counts[std::min(2, std::max(0, number - 1))];
        }
        check(filter->GetProjectionError() >= 0.0 && filter->GetProjectionError() < 1.0,
          "the projection error should be a fraction");
      }
      for (int k = 0; k < 3; ++k)
      {
        // Counts of places, of which coincident points share one.
        check(CoincidentPoints(input).empty() ? counts[k] == filter->GetProjectionCaseCounts()[k]
                                              : counts[k] >= filter->GetProjectionCaseCounts()[k],
          "the case counts should be those of the array");
      }

      const vtkIdType m = proxy->GetNumberOfPoints();
      CheckArray(check, PointArray(proxy, "RestPosition"), "RestPosition", VTK_DOUBLE, 3, m);
      CheckArray(check, PointArray(proxy, "Displacement"), "proxy Displacement", VTK_DOUBLE, 3, m);
      double off = 0.0;
      for (vtkIdType i = 0; i < m; ++i)
      {
        const Vector rest = TupleOf(PointArray(proxy, "RestPosition"), i);
        const Vector moved = TupleOf(PointArray(proxy, "Displacement"), i);
        Vector sum;
        vtkMath::Add(rest.data(), moved.data(), sum.data());
        off = std::max(off, Distance(sum, PointOf(proxy, i)));
      }
      check.AtMost(off, Rounding * diagonal, "proxy at rest + Displacement - proxy");
      check.AtMost(MoveOfProxy(proxy), Rounding * diagonal, "move of the proxy's centroid");
      vtkDataArray* seconds = proxy->GetFieldData()->GetArray("StageSeconds");
      const char* stages[] = { "Proxy", "Round", "Project", "Transfer" };
      CheckArray(check, seconds, "StageSeconds", VTK_DOUBLE, 4, 1);
      for (int k = 0; seconds && k < 4; ++k)
      {
        check(std::string(seconds->GetComponentName(k)) == stages[k] &&
            seconds->GetComponent(0, k) > 0.0,
          std::string("seconds of ") + stages[k]);
      }

      check(lines->GetNumberOfPoints() == 2 * n && lines->GetNumberOfLines() == n &&
          lines->GetPoints()->GetDataType() == (single ? VTK_FLOAT : VTK_DOUBLE),
        "output 2 should be one line per point");
      vtkDataArray* pointId = lines->GetCellData()->GetArray("PointId");
      vtkDataArray* lineT = lines->GetCellData()->GetArray("t");
      CheckArray(check, pointId, "PointId", VTK_ID_TYPE, 1, n);
      CheckArray(check, lineT, "t of the lines", VTK_DOUBLE, perAxis ? 3 : 1, n);

      double worst[5] = { 0.0, 0.0, 0.0, 0.0, 0.0 };
      const auto worse = [&worst](int k, double value)
      { worst[k] = value <= worst[k] ? worst[k] : value; };
      for (vtkIdType i = 0; i < n; ++i)
      {
        const double cell = cells->GetComponent(i, 0);
        if (!check(cell >= 0.0 && cell < static_cast<double>(proxy->GetNumberOfPolys()),
              "ProxyCell should be a cell of the proxy"))
        {
          return;
        }
        const Vector b = TupleOf(barycentric, i);
        check(b[0] >= 0.0 && b[1] >= 0.0 && b[2] >= 0.0, "Barycentric should be 0 or more");
        worse(0, std::abs(b[0] + b[1] + b[2] - 1.0));
        const Vector q = AtFoot(
          output, proxy, i,
          [&](vtkIdType k) { return TupleOf(PointArray(proxy, "RestPosition"), k); }, ids);
        lines->GetLines()->GetCellAtId(i, ids);
        const vtkIdType from = ids->GetId(0);
        const vtkIdType to = ids->GetId(1);
        worse(1, Distance(q, PointOf(lines, to)));
        check(SamePoint(input, i, lines, from) && pointId->GetComponent(i, 0) == i,
          "line " + Text(i) + " should start at its point");
        // Eq. 5.18.
        const Vector rounded = AtFoot(
          output, proxy, i, [&](vtkIdType k) { return PointOf(proxy, k); }, ids);
        const Vector p = PointOf(input, i);
        const Vector moved = PointOf(output, i);
        for (int k = 0; k < 3; ++k)
        {
          const double s = t->GetComponent(i, perAxis ? k : 0);
          check(s == lineT->GetComponent(i, perAxis ? k : 0), "the lines should have the same t");
          check(s >= 0.0 && s <= 1.0, "t should be within 0..1");
          worse(2, std::abs((1.0 - s) * rounded[k] + s * p[k] - moved[k]));
          worse(
            3, std::abs(moved[k] - p[k] - PointArray(output, "Displacement")->GetComponent(i, k)));
        }
      }
      check.AtMost(worst[0], 4e-16, "|sum of Barycentric - 1|");
      check.AtMost(worst[1], (single ? 1e-7 : Rounding) * diagonal,
        "distance of a foot to the end of its line");
      check.AtMost(worst[2], Rounding * diagonal, "difference to Eq. 5.18");
      check.AtMost(worst[3], Rounding * diagonal, "output - input - Displacement");
    }
  }
}

void Switches(Checker& check)
{
  check.About("switches of the output arrays");
  WatchedProxyFilter filter(MakeDented());
  const auto has = [&](const char* name)
  { return filter.Output()->GetPointData()->HasArray(name) != 0; };
  check(
    has("t") && has("Displacement") && filter.Output()->GetPointData()->GetNumberOfArrays() == 2,
    "two arrays should be there by default");
  filter->GenerateNormalsOn();
  check(has("Normals") && filter.Output()->GetPointData()->GetNormals(),
    "GenerateNormals should add active normals");
  filter->GenerateProjectionArraysOn();
  check(has("ProxyCell") && has("Barycentric") && !has("ProjectionCase"), "arrays of the feet");
  filter->SetProjectionToNearestVertices();
  check(has("ProjectionCase"), "NearestVertices has cases");
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    filter->SetInputData(MakeDented(type));
    for (const auto& precision : { std::make_pair(int(vtkAlgorithm::SINGLE_PRECISION), VTK_FLOAT),
           std::make_pair(int(vtkAlgorithm::DOUBLE_PRECISION), VTK_DOUBLE),
           std::make_pair(int(vtkAlgorithm::DEFAULT_PRECISION), type) })
    {
      filter->SetOutputPointsPrecision(precision.first);
      vtkPolyData* output = filter.Output();
      check(output->GetPoints()->GetDataType() == precision.second &&
          PointArray(output, "Displacement")->GetDataType() == precision.second,
        "points and Displacement should have the type asked for");
      check(PointArray(output, "t")->GetDataType() == VTK_DOUBLE, "t is double");
    }
  }
}

//------------------------------------------------------------------------------------------------
/// The input's bits: points, and normals where there are some.
void Identity(Checker& check, vtkPolyData* model, const char* name)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    const Surface input = WithPointsOf(model, type);
    input->GetPoints()->SetPoint(0, -0.0, input->GetPoint(0)[1], -0.0);
    input->GetPointData()->SetNormals(
      MakeArray("n", input, 3, [](vtkIdType i, int k) { return std::cos(i + 1.0 * k); }));
    input->GetPointData()->AddArray(
      MakeArray("ones", input, 1, [](vtkIdType, int) { return 1.0; }));
    input->GetPointData()->AddArray(
      MakeArray("three", input, 3, [](vtkIdType, int) { return 1.0; }));
    input->GetPointData()->AddArray(
      MakeArray("nowhere", input, 1, [](vtkIdType, int) { return 0.0; }));
    const std::pair<const char*, std::function<void(vtkConvexProxyDeformFilter*)>> cases[] = {
      { "Blend 1", [](auto* filter) { filter->SetBlend(1.0); } },
      { "Linear from 1 to 1",
        [](auto* filter)
        {
          filter->SetBlendFunctionToLinear();
          filter->SetBlendAtStart(1.0);
        } },
      { "Tanh behind its range",
        [](auto* filter)
        {
          filter->SetBlendFunctionToTanh();
          filter->SetBlendRange(-1.0, -0.5);
        } },
      { "an array of ones",
        [](auto* filter)
        {
          filter->SetBlendFunctionToArray();
          filter->SetInputArrayToProcess(BlendArray, 0, 0, OfPoints, "ones");
        } },
      { "an array of three ones",
        [](auto* filter)
        {
          filter->SetBlendFunctionToArray();
          filter->SetInputArrayToProcess(BlendArray, 0, 0, OfPoints, "three");
        } },
      { "outside of the region",
        [](auto* filter)
        {
          filter->SetBlend(0.0);
          filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "nowhere");
        } },
    };
    for (const auto& c : cases)
    {
      for (const int transfer : { 0, 1 })
      {
        check.About(std::string(name) + ", " + c.first + ", type " + Text(type));
        WatchedProxyFilter filter(input);
        filter->SetTransfer(transfer);
        filter->SetAxisGain(2.0, 1.0, 0.5);
        c.second(filter.Get());
        vtkPolyData* output = filter.Output();
        check(filter.Errors.empty(), "no error" + Joined(filter.Errors));
        check(SamePoints(input, output), "the output should have the input's bits");
        check(SameArray(input->GetPointData()->GetNormals(), output->GetPointData()->GetNormals()),
          "normals should keep their bits");
      }
    }
  }
}

void OnTheProxy(Checker& check, vtkPolyData* model, const char* name)
{
  for (const int mesher : { 0, 1, 2, 3 })
  {
    for (const int projection : { 0, 1, 2 })
    {
      check.About(std::string(name) + " at t = 0, mesher " + Text(mesher) + ", projection " +
        Text(projection));
      WatchedProxyFilter filter(model);
      filter->SetProxyMesher(mesher);
      filter->SetProjection(projection);
      filter->SetBlend(0.0);
      filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
      filter->GenerateProjectionArraysOn();
      vtkPolyData* output = filter.Output();
      check.AtMost(LargestDistanceFromProxy(output, filter.Output(1)), Rounding * Diagonal(model),
        "distance from the rounded proxy");
    }
  }
}

void Offsets(Checker& check, vtkPolyData* model)
{
  check.About("Offset at t = 0");
  WatchedProxyFilter filter(model);
  filter->SetBlend(0.0);
  filter->SetTransferToOffset();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->GenerateProjectionArraysOn();
  vtkPolyData* output = filter.Output();
  vtkPolyData* proxy = filter.Output(1);
  vtkNew<vtkIdList> ids;
  double worst = 0.0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const Vector q = AtFoot(
      output, proxy, i, [&](vtkIdType k) { return TupleOf(PointArray(proxy, "RestPosition"), k); },
      ids);
    const Vector rounded = AtFoot(
      output, proxy, i, [&](vtkIdType k) { return PointOf(proxy, k); }, ids);
    worst = std::max(
      worst, std::abs(Distance(PointOf(model, i), q) - Distance(PointOf(output, i), rounded)));
  }
  check.AtMost(worst, Rounding * Diagonal(model), "change of the distance to the proxy");
}

/// Each function along an axis against the formula.
void BlendFunctions(Checker& check, vtkPolyData* model)
{
  const Vector axis = { 0.5, -2.0, 1.0 };
  const double start = 0.2;
  const double end = 0.9;
  std::vector<double> places;
  for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
  {
    places.push_back(vtkMath::Dot(axis.data(), PointOf(model, i).data()));
  }
  const double low = *std::min_element(places.begin(), places.end());
  const double extent = *std::max_element(places.begin(), places.end()) - low;
  const std::function<double(double)> shapes[] = { [](double s) { return s; },
    [](double s) { return s * s; },
    [](double s) { return 0.5 + 0.5 * std::tanh(4.0 * s - 2.0) / std::tanh(2.0); },
    [](double s) { return 3.0 * s * s - 2.0 * s * s * s; } };
  for (int k = 0; k < 4; ++k)
  {
    check.About("blend function " + Text(k + 1));
    WatchedProxyFilter filter(model);
    filter->SetBlendFunction(k + 1);
    filter->SetBlendAxis(axis[0], axis[1], axis[2]);
    filter->SetBlendRange(start, end);
    filter->SetBlendAtStart(0.9);
    filter->SetBlendAtEnd(0.3);
    filter->SetTanhSteepness(2.0);
    vtkDataArray* t = PointArray(filter.Output(), "t");
    double worst = 0.0;
    for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
    {
      const double s = std::min(1.0, std::max(0.0, ((places[i] - low) / extent - start) / 0.7));
      worst = std::max(worst, std::abs(t->GetComponent(i, 0) - (0.9 - 0.6 * shapes[k](s))));
    }
    check.AtMost(worst, 1e-12, "difference of t to the formula");
  }
}

/// What an array gives and what the property gives.
void ArraysAsProperties(Checker& check)
{
  const Surface input = MakeDented();
  const auto add =
    [&](const char* name, int components, const std::function<double(vtkIdType, int)>& value)
  { input->GetPointData()->AddArray(MakeArray(name, input, components, value)); };
  add("quarter", 1, [](vtkIdType, int) { return 0.25; });
  add("quarter3", 3, [](vtkIdType, int) { return 0.25; });
  add("inside", 1, [](vtkIdType, int) { return -2.0; });
  const auto result = [&](const std::function<void(vtkConvexProxyDeformFilter*)>& change)
  {
    WatchedProxyFilter filter(input);
    change(filter.Get());
    Surface output = filter.Output();
    check(filter.Errors.empty(), "no error" + Joined(filter.Errors));
    return output;
  };
  check.About("arrays as properties");
  const Surface expected = result([](auto* filter) { filter->SetBlend(0.25); });
  for (const char* name : { "quarter", "quarter3" })
  {
    const Surface output = result(
      [name](auto* filter)
      {
        filter->SetBlendFunctionToArray();
        filter->SetInputArrayToProcess(BlendArray, 0, 0, OfPoints, name);
      });
    check(SamePoints(output, expected), std::string(name) + " should be Blend .25");
  }
  check(SamePoints(expected,
          result(
            [](auto* filter)
            {
              filter->SetBlend(0.25);
              filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "inside");
            })),
    "a region of all points is none");

  check.About("a direction of length 0");
  add("zero", 3, [](vtkIdType, int) { return 0.0; });
  check(SamePoints(result(
                     [](auto* filter)
                     {
                       filter->SetProjectionToDirectionArray();
                       filter->SetInputArrayToProcess(DirectionsArray, 0, 0, OfPoints, "zero");
                     }),
          result([](auto*) {})),
    "it should take the closest point");
}

/// Normals decide between the two walls of a corner.
void NormalsDecide(Checker& check)
{
  const Surface corner =
    MakeSurface({ { 0, 0, 1 }, { 0, 1, 1 }, { 0, 1, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } },
      { { 0, 1, 2 }, { 0, 2, 3 }, { 3, 2, 5 }, { 3, 5, 4 } });
  std::vector<Vector> points;
  for (int i = 0; i < 16; ++i)
  {
    const int row = i / 4;
    points.push_back({ 0.10 + 0.01 * (i % 4), 0.31 + 0.1 * row, 0.15 });
  }
  const Surface input = MakeSurface(points, {});
  for (int k = 0; k < 3; ++k)
  {
    const char* names[] = { "x", "y", "z" };
    input->GetPointData()->AddArray(
      MakeArray(names[k], input, 3, [k](vtkIdType, int d) { return d == k ? -2.0 : 0.0; }));
  }
  const auto walls = [&](const char* name, bool active)
  {
    WatchedProxyFilter filter(input);
    filter->SetProxyData(corner);
    filter->SetProjectionToSmallestAngle();
    filter->GenerateProjectionArraysOn();
    input->GetPointData()->SetActiveNormals(active ? name : nullptr);
    if (!active && *name)
    {
      filter->SetInputArrayToProcess(NormalsArray, 0, 0, OfPoints, name);
    }
    vtkPolyData* output = filter.Output();
    check(filter.Errors.empty(), "no error" + Joined(filter.Errors));
    std::set<bool> floor;
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      floor.insert(PointArray(output, "ProxyCell")->GetComponent(i, 0) > 1.0);
    }
    return floor;
  };
  for (const bool active : { false, true })
  {
    check.About(active ? "active normals" : "normals by name");
    check(walls("x", active) == std::set<bool>{ false }, "normals along x should take the wall");
    check(walls("z", active) == std::set<bool>{ true }, "normals along z should take the floor");
  }
  check.About("no normals and no faces to have some");
  check(walls("", false) == std::set<bool>{ false }, "the wall is nearer");
}

void Normals(Checker& check)
{
  check.About("normals of a region");
  const Surface input = MakeDented();
  input->GetPointData()->SetNormals(
    MakeArray("mine", input, 3, [](vtkIdType i, int k) { return std::cos(i + 1.0 * k); }));
  input->GetPointData()->AddArray(MakeArray(
    "region", input, 1, [&](vtkIdType i, int) { return PointOf(input, i)[2] > 0.8 ? 1.0 : 0.0; }));
  WatchedProxyFilter filter(input);
  filter->SetBlend(0.0);
  filter->SetBorderWidth(0.0);
  filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region");
  vtkPolyData* output = filter.Output();
  vtkDataArray* before = input->GetPointData()->GetNormals();
  vtkDataArray* after = output->GetPointData()->GetNormals();
  if (!check(after && std::string(after->GetName()) == "mine", "normals should keep their name"))
  {
    return;
  }
  std::vector<char> touched(input->GetNumberOfPoints(), 0);
  for (const auto& t : TriangleCorners(input))
  {
    const bool moved = !SamePoint(input, t[0], output, t[0]) ||
      !SamePoint(input, t[1], output, t[1]) || !SamePoint(input, t[2], output, t[2]);
    for (const vtkIdType i : t)
    {
      touched[i] |= moved;
    }
  }
  vtkIdType kept = 0;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    const bool same = TupleOf(before, i) == TupleOf(after, i);
    kept += same;
    check(same != (touched[i] != 0), "normals change where a triangle moved, point " + Text(i));
    check(same || std::abs(vtkMath::Norm(TupleOf(after, i).data()) - 1.0) < 1e-6,
      "new normals should have length 1");
  }
  check(kept > 20 && kept + 20 < input->GetNumberOfPoints(), "the test should have both");
}

/// A5.13: what emphasis along an axis does to the extent.
void Gains(Checker& check)
{
  const Surface input = MakeDented();
  const auto extents = [&](const Vector& gain, double blend)
  {
    WatchedProxyFilter filter(input);
    filter->SetBlend(blend);
    filter->SetAxisGain(gain[0], gain[1], gain[2]);
    double b[6];
    filter.Output()->GetPoints()->GetBounds(b);
    return Vector{ b[1] - b[0], b[3] - b[2], b[5] - b[4] };
  };
  const Vector plain = extents({ 1, 1, 1 }, 0.0);
  for (const Vector& gain : { Vector{ 1, 2, 1 }, Vector{ 0.5, 1, 3 }, Vector{ 1, 1, 0 } })
  {
    check.About("gain");
    const Vector stretched = extents(gain, 0.0);
    for (int k = 0; k < 3; ++k)
    {
      check.AtMost(std::abs(stretched[k] - gain[k] * plain[k]), Rounding * Diagonal(input),
        "extent along axis " + Text(k) + " off its gain");
    }
  }
}

void Facts(Checker& check)
{
  check.About("facts");
  const Surface input = MakeEllipsoid({ 1.0, 0.8, 2.0 });
  WatchedProxyFilter filter(input);
  filter.Output();
  check(filter->GetEffectiveNumberOfProxyPoints() == filter.Output(1)->GetNumberOfPoints(),
    "points of the proxy");
  check(filter->GetEffectiveProxyMesher() == 0, "the mesher asked for");
  check.AtMost(std::abs(filter->GetConvexityRatio() - 1.0), 1e-12, "convexity ratio - 1");
  check(filter->GetTrianglesTurnedOver() == 0, "no triangle should turn over");
  check(filter->GetProjectionCaseCounts()[0] == 0 && filter->GetProjectionError() == 0.0,
    "cases are for NearestVertices");
  const Surface rest = RestOf(filter.Output(1));
  const std::vector<double> areas = PointAreas(rest);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  Vector centroid = { 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      centroid[k] += areas[i] / area * PointOf(rest, static_cast<vtkIdType>(i))[k];
    }
  }
  Vector center;
  filter->GetEffectiveCenter(center.data());
  check.AtMost(Distance(centroid, center), 1e-12, "center off the centroid of the proxy");
  filter->SetCenterModeToPointMean();
  filter.Output();
  filter->GetEffectiveCenter(center.data());
  const Vector mean = MeanPoint(rest, 0, rest->GetNumberOfPoints());
  check.AtMost(Distance(mean, center), 1e-12, "center off the mean point of the proxy");
  filter->SetRadiusModeToCustom();
  filter->SetRadius(3.25);
  filter->SetCenterModeToCustom();
  filter->SetCenter(0.1, 0.2, 0.3);
  filter.Output();
  filter->GetEffectiveCenter(center.data());
  check(std::abs(filter->GetEffectiveRadius() - 3.25) < 1e-14 &&
      Distance(center, { 0.1, 0.2, 0.3 }) < 1e-14,
    "custom center and radius should be those used");

  check.About("seconds");
  const auto seconds = [&](int k)
  { return filter.Output(1)->GetFieldData()->GetArray("StageSeconds")->GetComponent(0, k); };
  check(seconds(0) == 0.0 && seconds(1) > 0.0 && seconds(2) == 0.0 && seconds(3) > 0.0,
    "another sphere should redo the rounding alone");
  filter->SetBlend(0.1);
  check(seconds(0) == 0.0 && seconds(1) == 0.0 && seconds(2) == 0.0 && seconds(3) > 0.0,
    "another t should redo the transfer alone");
  filter->SetProjectionToSmallestAngle();
  check(seconds(0) == 0.0 && seconds(1) == 0.0 && seconds(2) > 0.0, "another projection");
  filter->SetNumberOfProxyPoints(200);
  check(seconds(0) > 0.0 && seconds(1) > 0.0 && seconds(2) > 0.0, "another proxy redoes all");
}
}

int TestConvexProxyDeformFilterArrays(int argc, char* argv[])
{
  const Surface car = ReadModel(argc, argv, "car.vtp");
  const Surface bottle = ReadModel(argc, argv, "bottle.vtp");
  const Surface icosahedron = ReadModel(argc, argv, "icosahedron.vtp");
  Checker check;
  EveryArray(check);
  Promises(check, MakeDented(), "dented ellipsoid");
  Promises(check, car, "car");
  Promises(check, icosahedron, "icosahedron");
  Switches(check);
  Identity(check, MakeDented(), "dented ellipsoid");
  Identity(check, car, "car");
  OnTheProxy(check, MakeDented(), "dented ellipsoid");
  OnTheProxy(check, car, "car");
  Offsets(check, bottle);
  Offsets(check, MakeDented());
  BlendFunctions(check, bottle);
  ArraysAsProperties(check);
  NormalsDecide(check);
  Normals(check);
  Gains(check);
  Facts(check);
  return check.Result();
}
