// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the tests of the comparators share: the contract that each filter keeps whatever it
/// computes, and that of those whose style is a term of the local step.
#ifndef ComparatorTesting_h
#define ComparatorTesting_h

#include "ArrayTesting.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkTable.h"

#include <limits>
#include <sstream>

namespace FilterTesting
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// A dented ellipsoid away from the origin: nothing in it is symmetric to an axis.
inline Surface MakeModel(int type = VTK_DOUBLE)
{
  return Mapped(
    MakeEllipsoid({ 1.0, 0.8, 2.0 }),
    [](const Vector& x)
    {
      const double dent = x[0] > 0.5 ? 0.85 : 1.0;
      return Vector{ dent * x[0] + 0.2 * x[2] + 0.1, x[1] - 0.2 * x[0], x[2] + 0.3 };
    },
    type);
}

/// Executes after `spoil`, expects one error with all words and empty outputs, and afterwards, with
/// `repair`, what a new filter gives.
template <typename FilterType>
void ExpectError(Checker& check, const std::string& about, const std::vector<std::string>& words,
  const std::function<void(FilterType*, vtkPolyData*)>& spoil,
  const std::function<void(FilterType*)>& repair)
{
  check.About(about);
  const Surface input = MakeModel();
  Watched<FilterType> filter(input);
  filter.Output();
  check(filter.Errors.empty(), "the model should be good before");
  spoil(filter.Get(), input);
  input->Modified();
  vtkPolyData* output = filter.Output();
  if (check(filter.Errors.size() == 1, "there should be one error"))
  {
    for (const std::string& word : words)
    {
      check(Contains(filter.Errors[0], word),
        "the error should say \"" + word + "\" and says " + filter.Errors[0]);
    }
  }
  check(output->GetNumberOfPoints() == 0 && output->GetPointData()->GetNumberOfArrays() == 0,
    "the output should be empty");
  input->DeepCopy(MakeModel());
  repair(filter.Get());
  Watched<FilterType> fresh(MakeModel());
  check(SamePolyData(filter.Output(), fresh.Output()) && filter.Errors.size() == 1,
    "repaired, it should give what a new filter gives");
}

/// Cells, arrays, number types, points that coincide or are alone, empty inputs, blocks, PrintSelf.
/// @param properties  that PrintSelf has to name
template <typename FilterType>
void CheckContract(Checker& check, const std::vector<std::string>& properties)
{
  check.About("arrays and cells");
  const Surface input = MakeModel();
  AddArrays(input);
  const Surface before = Surface::New();
  before->DeepCopy(input);
  Watched<FilterType> filter(input);
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty() && filter.Warnings.empty(), "it should say nothing");
  check(SamePolyData(input, before), "the input should not change");
  check(SameCells(input, output), "cells should come out byte for byte");
  check(LargestDistance(input, output) > 1e-3 * Diagonal(input), "points should move");
  CheckPassedOn(check, input->GetPointData(), output->GetPointData(), "my normals");
  CheckPassedOn(check, input->GetCellData(), output->GetCellData(), "");
  CheckPassedOn(check, input->GetFieldData(), output->GetFieldData(), "");
  check(!SameArray(input->GetPointData()->GetNormals(), output->GetPointData()->GetNormals()),
    "normals should be those of the moved surface");
  vtkDataArray* displacement = output->GetPointData()->GetArray("Displacement");
  for (vtkIdType i = 0; displacement && i < input->GetNumberOfPoints(); ++i)
  {
    Vector moved = PointOf(input, i);
    const Vector by = TupleOf(displacement, i);
    vtkMath::Add(moved.data(), by.data(), moved.data());
    check.AtMost(Distance(moved, PointOf(output, i)), 1e-15 * Diagonal(input), "Displacement");
  }
  check(displacement != nullptr, "there should be Displacement");

  check.About("number types");
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    Watched<FilterType> typed(MakeModel(type));
    check(typed.Output()->GetPoints()->GetDataType() == type, "points should keep their type");
    typed->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
    check(typed.Output()->GetPoints()->GetDataType() == VTK_FLOAT, "single precision");
    typed->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    check(typed.Output()->GetPoints()->GetDataType() == VTK_DOUBLE, "double precision");
    check(!typed.Output()->GetPointData()->GetNormals(), "no normals should come from nowhere");
    typed->GenerateNormalsOn();
    check(typed.Output()->GetPointData()->GetNormals() != nullptr, "GenerateNormals");
  }

  check.About("coincident points");
  const Surface seam = MakeModel();
  const vtkIdType twin = seam->GetPoints()->InsertNextPoint(seam->GetPoint(20));
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0, left = 2; left > 0 && c < seam->GetNumberOfPolys(); ++c)
  {
    seam->GetPolys()->GetCellAtId(c, ids);
    if (ids->IsId(20) >= 0) // two triangles get the second point of the seam
    {
      ids->SetId(ids->IsId(20), twin);
      seam->GetPolys()->ReplaceCellAtId(c, ids);
      --left;
    }
  }
  Watched<FilterType> welded(seam);
  check(SamePoint(welded.Output(), 20, welded.Output(), twin), "they should stay together");
  Watched<FilterType> whole(MakeModel());
  check(SamePoint(welded.Output(), 20, whole.Output(), 20), "a seam should change nothing");

  check.About("quads and strips");
  Watched<FilterType> triangles(MakeEllipsoid({ 1.0, 0.8, 2.0 }, Faces::Triangles));
  Watched<FilterType> strips(MakeEllipsoid({ 1.0, 0.8, 2.0 }, Faces::Strips));
  check.AtMost(LargestDistance(triangles.Output(), strips.Output()), 1e-9, "strips, difference");

  check.About("nothing");
  Watched<FilterType> empty(Surface::New());
  check(empty.Output()->GetNumberOfPoints() == 0 && empty.Errors.empty() && empty.Warnings.empty(),
    "no points should give no points and no word");

  check.About("blocks");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeModel());
  blocks->SetBlock(1, Surface::New());
  blocks->SetBlock(2, Shifted(MakeModel(), { 3.0, 1.0, 0.0 }));
  Watched<FilterType> many;
  many->SetInputDataObject(blocks);
  many->Update();
  auto* parts = vtkMultiBlockDataSet::SafeDownCast(many->GetOutputDataObject(0));
  if (check(parts && parts->GetNumberOfBlocks() == 3, "blocks should come out as blocks"))
  {
    for (const unsigned int i : { 0u, 2u })
    {
      Watched<FilterType> alone(vtkPolyData::SafeDownCast(blocks->GetBlock(i)));
      check(SamePolyData(vtkPolyData::SafeDownCast(parts->GetBlock(i)), alone.Output()),
        "each block should be as it is alone");
    }
  }

  check.About("PrintSelf");
  std::ostringstream text;
  filter->Print(text);
  for (const std::string& property : properties)
  {
    check(Contains(text.str(), " " + property + ": "), "it should print " + property);
  }

  check.About("errors");
  const auto leave = [](FilterType*) {};
  ExpectError<FilterType>(
    check, "a point that is not finite", { "Points", "point 7 " },
    [](FilterType*, vtkPolyData* bad) { bad->GetPoints()->SetPoint(7, 0.0, NaN, 0.0); }, leave);
  ExpectError<FilterType>(
    check, "a point id out of range", { "cell 3 ", "point 999" },
    [](FilterType*, vtkPolyData* bad)
    {
      const vtkIdType ids[] = { 0, 1, 999 };
      bad->GetPolys()->ReplaceCellAtId(3, 3, ids);
    },
    leave);
}

/// Of the filters of vtkLocalTermAlgorithm, and of one without a term of its own.
/// @param secondTerm  its column in the table, or nullptr
template <typename FilterType>
void CheckIteration(Checker& check, const char* secondTerm)
{
  check.About("table of the energy");
  const Surface input = MakeModel();
  Watched<FilterType> filter(input);
  filter.Output();
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  std::vector<std::string> names = { "Iteration", "Total", "Rigid", "LocalChange", "GlobalChange",
    "Residual", "Gap" };
  if (secondTerm)
  {
    names.insert(names.begin() + 3, secondTerm);
  }
  const auto columns = static_cast<int>(names.size());
  check(table->GetNumberOfColumns() == columns, "it should have " + Text(columns) + " columns");
  for (int k = 0; k < columns; ++k)
  {
    check(table->GetColumn(k) && std::string(table->GetColumn(k)->GetName()) == names[k],
      "column " + Text(k) + " should be " + names[k]);
  }
  const vtkIdType rows = table->GetNumberOfRows();
  check(rows == filter->GetNumberOfIterations() + 1 && rows > 2, "one row per iteration");
  check(filter->GetConverged(), "it should converge");
  check(table->GetValueByName(rows - 1, "Total").ToDouble() == filter->GetFinalEnergy(),
    "FinalEnergy should be that of the last row");
  for (vtkIdType r = 0; r < rows; ++r)
  {
    const double total = table->GetValueByName(r, "Total").ToDouble();
    const double second = secondTerm ? table->GetValueByName(r, secondTerm).ToDouble() : 0.0;
    check.AtMost(std::abs(total - table->GetValueByName(r, "Rigid").ToDouble() - second),
      1e-14 * total, "Total less its terms");
    check(r == 0 || total <= table->GetValueByName(r - 1, "Total").ToDouble() * (1.0 + 1e-13),
      "the energy should not rise in row " + Text(r));
  }
  check(table->GetFieldData()->HasArray("StageSeconds") &&
      table->GetFieldData()->HasArray("LinearSolver"),
    "field data of the table");

  check.About("stop rules");
  filter->SetStopRuleToFixedIterations();
  filter->SetMaximumNumberOfIterations(4);
  filter.Output();
  check(filter->GetNumberOfIterations() == 4 && filter.Warnings.empty(), "exactly 4 iterations");
  filter->SetStopRuleToConverged();
  filter->SetTolerance(1e-12);
  filter.Output();
  check(!filter->GetConverged() && filter.Warnings.size() == 1 &&
      Contains(filter.Warnings[0], "not converged after 4"),
    "4 iterations should not do, with a warning");

  check.About("threads");
  const Surface large = MakeEllipsoid({ 1.0, 0.7, 1.6 }, Faces::Triangles, 80, 79);
  Watched<FilterType> one(large);
  one->SetNumberOfThreads(1);
  one->SetMaximumNumberOfIterations(5);
  one->SetStopRuleToFixedIterations();
  const Surface expected = Surface::New();
  expected->DeepCopy(one.Output());
  one->SetNumberOfThreads(3);
  check(SamePoints(expected, one.Output()), "3 threads should give the same bits");

  check.About("no faces");
  const Surface loose = MakeModel();
  loose->SetPolys(MakeCells({}));
  Watched<FilterType> still(loose);
  check(SamePoints(loose, still.Output()) && still.Errors.empty() && still.Warnings.size() == 1 &&
      Contains(still.Warnings[0], "no triangle"),
    "points of no face should stay, with a warning");
  check(still->GetNumberOfIterations() == 0 && still->GetFinalEnergy() == 0.0, "facts of nothing");

  check.About("a point of no face");
  const Surface more = MakeModel();
  const vtkIdType alone = more->GetPoints()->InsertNextPoint(5.0, 6.0, 7.0);
  Watched<FilterType> other(more);
  check(SamePoint(other.Output(), alone, more, alone), "it should stay");

  check.About("abort");
  Watched<FilterType> aborted(input);
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
  aborted->AddObserver(vtkCommand::ProgressEvent, command);
  aborted.Output();
  check(aborted.Errors.empty() && aborted.Warnings.empty() && !aborted->GetConverged() &&
      aborted->GetNumberOfIterations() <= 1,
    "it should end without a word");
}
}

#endif
