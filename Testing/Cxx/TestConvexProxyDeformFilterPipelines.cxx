// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The filter among others, as people put pipelines together.
#include "ConvexProxyTesting.h"

#include "vtkCurvatures.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyDataNormals.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"

#include <set>

using namespace FilterTesting;

namespace
{
void Read(vtkXMLPolyDataReader* reader, int argc, char* argv[], const char* name)
{
  char* path = vtkTestUtilities::ExpandDataFileName(argc, argv, name);
  reader->SetFileName(path);
  delete[] path;
}

void CarToCurvatures(Checker& check, int argc, char* argv[])
{
  check.About("reader -> filter -> normals -> curvatures, car.vtp");
  vtkNew<vtkXMLPolyDataReader> reader;
  Read(reader, argc, argv, "car.vtp");
  WatchedProxyFilter filter;
  filter->SetInputConnection(reader->GetOutputPort());
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(filter->GetOutputPort());
  normals->SplittingOff();
  vtkNew<vtkCurvatures> curvatures;
  curvatures->SetCurvatureTypeToMean();
  curvatures->SetInputConnection(normals->GetOutputPort());
  double spread = RadiusSpread(
    [&]
    {
      reader->Update();
      return reader->GetOutput();
    }());
  for (const double t : { 0.8, 0.5, 0.2 }) // A5.12
  {
    filter->SetBlend(t);
    curvatures->Update();
    vtkPolyData* output = curvatures->GetOutput();
    check(filter.Errors.empty(), "no error should be reported" + Joined(filter.Errors));
    check(output->GetPointData()->GetNormals() != nullptr, "there should be normals");
    check(AllFinite(output->GetPoints()->GetData()), "points should be finite");
    vtkDataArray* mean = PointArray(output, "Mean_Curvature");
    check(mean && mean->GetNumberOfTuples() == output->GetNumberOfPoints(), "and curvatures");
    check(output->GetPointData()->HasArray("Displacement") && output->GetPointData()->HasArray("t"),
      "arrays of the filter should come through");
    const double now = RadiusSpread(filter->GetOutput());
    check(now < spread, "less t should be rounder");
    spread = now;
  }
  check(filter.Starts.size() == 3, "it should execute once for each t");
}

void Chain(Checker& check, int argc, char* argv[])
{
  check.About("filter after filter");
  const Surface bottle = ReadModel(argc, argv, "bottle.vtp");
  WatchedProxyFilter filters[3];
  filters[0]->SetInputData(bottle);
  filters[1]->SetInputConnection(filters[0]->GetOutputPort());
  filters[2]->SetInputConnection(filters[1]->GetOutputPort());
  filters[2]->Update();
  double spread = RadiusSpread(bottle);
  for (WatchedProxyFilter& filter : filters)
  {
    check(filter.Errors.empty() && filter.Starts.size() == 1, "each should execute once");
    check(RadiusSpread(filter->GetOutput()) < spread, "each should be rounder than before");
    spread = RadiusSpread(filter->GetOutput());
  }
  filters[1]->SetBlend(0.9);
  filters[2]->Update();
  check(
    filters[0].Starts.size() == 1 && filters[1].Starts.size() == 2 && filters[2].Starts.size() == 2,
    "a change in the middle should execute what comes after it");
  WatchedProxyFilter fresh(filters[1]->GetOutput());
  check(SamePoints(fresh.Output(), filters[2]->GetOutput()), "as the last gives alone");

  check.About("filter and the rounding of a whole model");
  WatchedFilter style;
  style->SetInputConnection(filters[0]->GetOutputPort());
  check(style.Output()->GetNumberOfPoints() == bottle->GetNumberOfPoints() && style.Errors.empty(),
    "one should take what the other gives");

  check.About("proxy of one filter as that of the next");
  WatchedProxyFilter other(bottle);
  other->SetProxyConnection(filters[0]->GetOutputPort(1)); // the rounded one
  check(other.Output()->GetNumberOfPoints() == bottle->GetNumberOfPoints() && other.Errors.empty(),
    "output 1 should do as input 1" + Joined(other.Errors));
}

void Blocks(Checker& check)
{
  check.About("multi-block input");
  const Surface model = MakeDented();
  const Surface other = MakeEllipsoid({ 3.0, 0.8, 1.0 }, Faces::Quads);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, model);
  blocks->SetBlock(1, Surface::New());
  blocks->SetBlock(2, nullptr);
  blocks->SetBlock(3, other);
  WatchedProxyFilter filter;
  filter->SetInputDataObject(blocks);
  filter->Update();
  check(filter.Errors.empty() && filter.Warnings.empty(), "the filter should say nothing");
  for (int port = 0; port < 3; ++port)
  {
    auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(port));
    if (!check(output && output->GetNumberOfBlocks() == 4, "blocks should come out as blocks"))
    {
      return;
    }
    const auto block = [&](unsigned int i)
    { return vtkPolyData::SafeDownCast(output->GetBlock(i)); };
    WatchedProxyFilter alone(model);
    WatchedProxyFilter otherAlone(other);
    check(block(0) && SamePoints(block(0), alone.Output(port)) &&
        SameCells(block(0), alone.Output(port)),
      "block 0 should be as it is alone, output " + Text(port));
    check(block(3) && SamePoints(block(3), otherAlone.Output(port)),
      "block 3 should be as it is alone, output " + Text(port));
    check(!block(1) || block(1)->GetNumberOfPoints() == 0, "the empty block should be empty");
    check(!block(2), "a block that is not there should not be there");
  }

  check.About("multi-block input with one proxy and one selection");
  vtkNew<vtkMultiBlockDataSet> two;
  two->SetBlock(0, model);
  two->SetBlock(1, Shifted(model, { 0.1, 0.0, 0.0 }));
  const auto selection = MakeSelection({ 3, 4, 5, 60 }, vtkSelectionNode::POINT);
  const Surface proxy = MakeEllipsoid({ 1.3, 1.1, 2.4 });
  WatchedProxyFilter both;
  both->SetInputDataObject(two);
  both->SetProxyData(proxy);
  both->SetSelectionData(selection);
  both->Update();
  check(both.Errors.empty(), "no error" + Joined(both.Errors));
  auto* output = vtkMultiBlockDataSet::SafeDownCast(both->GetOutputDataObject(0));
  for (unsigned int i = 0; i < 2; ++i)
  {
    WatchedProxyFilter alone(vtkPolyData::SafeDownCast(two->GetBlock(i)));
    alone->SetProxyData(proxy);
    alone->SetSelectionData(selection);
    auto* block = output ? vtkPolyData::SafeDownCast(output->GetBlock(i)) : nullptr;
    check(block && SamePoints(block, alone.Output()), "each block should be as it is alone");
  }

  filter->SetInputDataObject(model);
  filter->Update();
  auto* single = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  WatchedProxyFilter alone(model);
  check(single && SamePoints(single, alone.Output()), "then one surface should work again");
}

void Executions(Checker& check)
{
  check.About("executions");
  const Surface input = MakeDented();
  input->GetPointData()->AddArray(
    MakeArray("t", input, 1, [](vtkIdType i, int) { return (i % 8) / 7.0; }));
  const auto selection = MakeSelection({ 1, 2, 3, 4, 50, 60 }, vtkSelectionNode::POINT);
  WatchedProxyFilter filter(input);
  filter.Output();
  check(filter.Starts.size() == 1, "the first Update should execute");
  filter.Output();
  check(filter.Starts.size() == 1, "a second Update should not execute");
  filter->SetBlend(filter->GetBlend());
  filter.Output();
  check(filter.Starts.size() == 1, "setting the value that is set should not execute");
  std::size_t expected = 1;
  const auto changed = [&](const char* what, bool visible = true)
  {
    const Surface before = Surface::New();
    before->DeepCopy(filter->GetOutput());
    filter.Output();
    check(filter.Starts.size() == ++expected, std::string(what) + " should execute once more");
    filter.Output();
    check(filter.Starts.size() == expected, std::string(what) + " should execute once");
    check(!visible || !SamePoints(before, filter->GetOutput()),
      std::string(what) + " should change the result");
    check(filter.Errors.empty(), "no error" + Joined(filter.Errors));
  };
  filter->SetBlend(0.3);
  changed("Blend");
  filter->SetRoundness(1.0);
  changed("Roundness");
  filter->SetCenter(0.1, 0.0, 0.0);
  changed("Center", false);
  filter->SetAxisGain(1.0, 1.5, 1.0);
  changed("AxisGain");
  filter->SetProjectionToSmallestAngle();
  changed("Projection", false); // on a model that is about convex, the nearest foot
  filter->SetBlendFunctionToLinear();
  changed("BlendFunction");
  filter->SetBlendAxis(1.0, 0.0, 0.0);
  changed("BlendAxis");
  filter->SetBlendRange(0.2, 0.7);
  changed("BlendRange");
  filter->SetBlendFunctionToArray();
  filter->SetInputArrayToProcess(BlendArray, 0, 0, OfPoints, "t");
  changed("the t array");
  vtkDoubleArray::SafeDownCast(PointArray(input, "t"))->SetValue(3, 0.9);
  PointArray(input, "t")->Modified();
  input->Modified();
  changed("a value of the t array");
  filter->SetSelectionData(selection);
  changed("a selection");
  selection->AddNode(MakeSelection({ 70 }, vtkSelectionNode::POINT)->GetNode(0));
  selection->Modified();
  changed("another node of the selection");
  filter->SetBorderWidth(0.0);
  changed("BorderWidth");
  filter->SetSelectionConnection(nullptr);
  changed("no selection");
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(2.5);
  sphere->SetThetaResolution(20);
  sphere->SetPhiResolution(17);
  filter->SetProxyConnection(sphere->GetOutputPort());
  changed("an own proxy");
  sphere->SetRadius(3.0);
  changed("another radius of it");
  filter->SetProxyConnection(nullptr);
  changed("no proxy");
  input->GetPoints()->SetPoint(0, 0.0, 0.0, -2.5);
  input->GetPoints()->Modified();
  changed("a moved point");
  input->GetPoints()->InsertNextPoint(0.0, 3.0, 0.0);
  vtkDoubleArray::SafeDownCast(PointArray(input, "t"))->InsertNextValue(0.5);
  input->GetPoints()->Modified();
  input->Modified();
  changed("another point");
}

//------------------------------------------------------------------------------------------------
Vector Normal(vtkPolyData* surface, const std::array<vtkIdType, 3>& t)
{
  const Vector a = PointOf(surface, t[0]);
  const Vector b = PointOf(surface, t[1]);
  const Vector c = PointOf(surface, t[2]);
  Vector u;
  Vector v;
  Vector n;
  vtkMath::Subtract(b.data(), a.data(), u.data());
  vtkMath::Subtract(c.data(), a.data(), v.data());
  vtkMath::Cross(u.data(), v.data(), n.data());
  vtkMath::Normalize(n.data());
  return n;
}

/// Largest angle between the normals of two triangles at an edge with a point inside and one
/// outside of the region near by, degrees.
double LargestJump(vtkPolyData* surface, const std::vector<char>& nearBorder)
{
  std::map<std::pair<vtkIdType, vtkIdType>, Vector> first;
  double largest = 0.0;
  for (const auto& t : TriangleCorners(surface))
  {
    const Vector n = Normal(surface, t);
    for (int k = 0; k < 3; ++k)
    {
      const auto edge = std::minmax(t[k], t[(k + 1) % 3]);
      const auto known = first.insert({ { edge.first, edge.second }, n });
      if (!known.second && (nearBorder[edge.first] || nearBorder[edge.second]))
      {
        const double angle = vtkMath::DegreesFromRadians(
          vtkMath::AngleBetweenVectors(known.first->second.data(), n.data()));
        largest = std::max(largest, angle);
      }
    }
  }
  return largest;
}

/// A5.20: the head of the creature becomes round, and nobody sees where it begins.
void Head(Checker& check, int argc, char* argv[])
{
  const Surface creature = WithPointsOf(ReadModel(argc, argv, "creature.vtp"), VTK_DOUBLE);
  double bounds[6];
  creature->GetPoints()->GetBounds(bounds);
  // The neck, along the axis that the creature is tallest in.
  int up = 0;
  for (int k = 1; k < 3; ++k)
  {
    up = bounds[2 * k + 1] - bounds[2 * k] > bounds[2 * up + 1] - bounds[2 * up] ? k : up;
  }
  const double neck = bounds[2 * up] + 0.6 * (bounds[2 * up + 1] - bounds[2 * up]);
  const auto inside = [&](vtkIdType i) { return PointOf(creature, i)[up] > neck; };
  creature->GetPointData()->AddArray(
    MakeArray("head", creature, 1, [&](vtkIdType i, int) { return inside(i) ? 1.0 : 0.0; }));
  std::vector<char> border(creature->GetNumberOfPoints(), 0);
  for (const auto& t : TriangleCorners(creature))
  {
    if (inside(t[0]) != inside(t[1]) || inside(t[1]) != inside(t[2]))
    {
      border[t[0]] = border[t[1]] = border[t[2]] = 1;
    }
  }
  double jumps[2];
  for (const int hullOf : { 0, 1 })
  {
    for (const double width : { 0.0, 0.2 })
    {
      check.About("head of the creature, HullOf " + Text(hullOf) + ", border " +
        vtkVariant(width).ToString());
      WatchedProxyFilter filter(creature);
      filter->SetHullOf(hullOf);
      filter->SetBlend(0.2);
      filter->SetBorderWidth(width);
      filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "head");
      vtkPolyData* output = filter.Output();
      check(filter.Errors.empty(), "no error" + Joined(filter.Errors));
      for (vtkIdType i = 0; i < creature->GetNumberOfPoints(); ++i)
      {
        check(inside(i) || SamePoint(creature, i, output, i), "outside no bit should change");
      }
      jumps[width > 0.0] = LargestJump(output, border);
      check(LargestDistance(creature, output) > 0.01 * Diagonal(creature), "the head should move");
    }
    const double before = LargestJump(creature, border);
    std::cout << "head of the creature, HullOf " << hullOf
              << ": largest jump of the normals at the border " << before << " degrees before, "
              << jumps[1] << " with a border of .2, " << jumps[0] << " with none\n";
    check.AtMost(jumps[1], before + 1.0, "largest jump at a smooth border, degrees");
    check.AtMost(jumps[1], 0.6 * jumps[0], "that, against a step");
  }
}

/// An aborted execution leaves nothing half done in the pipeline.
void Aborts(Checker& check, int argc, char* argv[])
{
  check.About("abort in a pipeline");
  vtkNew<vtkXMLPolyDataReader> reader;
  Read(reader, argc, argv, "car.vtp");
  WatchedProxyFilter filter;
  filter->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(filter->GetOutputPort());
  normals->SplittingOff();
  normals->Update();
  const vtkIdType whole = normals->GetOutput()->GetNumberOfPoints();
  for (const double at : { 0.0, 0.4, 0.6, 0.95 })
  {
    vtkNew<vtkCallbackCommand> command;
    double progress = at;
    command->SetClientData(&progress);
    command->SetCallback(
      [](vtkObject* caller, unsigned long, void* limit, void* value)
      {
        if (*static_cast<double*>(value) >= *static_cast<double*>(limit))
        {
          vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
        }
      });
    const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, command);
    filter->SetBlend(0.2 + 0.1 * at);
    normals->Update();
    check(filter.Errors.empty(), "abort should be no error" + Joined(filter.Errors));
    filter->RemoveObserver(tag);
    filter->SetAbortExecute(0);
    normals->SetAbortExecute(0);
    filter->Modified();
    normals->Modified();
    normals->Update();
    check(normals->GetOutput()->GetNumberOfPoints() == whole, "then it should work again");
    WatchedProxyFilter fresh(reader->GetOutput());
    fresh->SetBlend(0.2 + 0.1 * at);
    check(SamePoints(fresh.Output(), filter->GetOutput()), "as a new filter does");
  }
}
}

int TestConvexProxyDeformFilterPipelines(int argc, char* argv[])
{
  Checker check;
  CarToCurvatures(check, argc, argv);
  Chain(check, argc, argv);
  Blocks(check);
  Executions(check);
  Head(check, argc, argv);
  Aborts(check, argc, argv);
  return check.Result();
}
