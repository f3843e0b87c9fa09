// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every filter over a tree of blocks, of which some are refused, empty, without a name or not
/// there: one error for each that is refused, which begins with its path, and the others come out
/// as they do alone.
#include "ArrayTesting.h"
#include "EveryFilter.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"

#include <limits>

using namespace FilterTesting;

namespace
{
Surface Broken(vtkPolyData* surface)
{
  return Mapped(surface,
    [](const Vector& x) {
      return Vector{ x[0], std::numeric_limits<double>::quiet_NaN(), x[2] };
    });
}

void AddBlock(vtkMultiBlockDataSet* blocks, const char* name, vtkDataObject* block)
{
  const unsigned int number = blocks->GetNumberOfBlocks();
  blocks->SetBlock(number, block);
  if (name)
  {
    blocks->GetMetaData(number)->Set(vtkCompositeDataSet::NAME(), name);
  }
}

void CheckBlocks(Checker& check, const Subject& subject)
{
  check.About(subject.name);
  const Surface ball = MakeEllipsoid({ 1.0, 1.0, 1.0 });
  const Surface egg = MakeEllipsoid({ 1.0, 1.2, 1.5 }, Faces::Quads);
  vtkNew<vtkMultiBlockDataSet> wheels;
  AddBlock(wheels, nullptr, ball);
  AddBlock(wheels, nullptr, Broken(ball));
  AddBlock(wheels, "Spare", Broken(egg));
  vtkNew<vtkMultiBlockDataSet> car;
  AddBlock(car, "Body", egg);
  AddBlock(car, "Wheels", wheels);
  AddBlock(car, "Gap", nullptr);
  AddBlock(car, "Nothing", vtkNew<vtkPolyData>());
  AddBlock(car, "Glass", Broken(egg));
  AddBlock(car, nullptr, ball);

  std::vector<std::string> errors;
  std::vector<std::string> failures; // the pipeline's own word for the same
  const auto filter = subject.make();
  Watch(filter, vtkCommand::ErrorEvent, errors);
  Watch(filter->GetExecutive(), vtkCommand::ErrorEvent, failures);
  filter->SetInputDataObject(car);
  filter->Update();

  if (subject.refuses)
  {
    const char* const paths[] = { "Wheels/1", "Wheels/Spare", "Glass" };
    check(errors.size() == std::size(paths), "one error for each block refused" + Joined(errors));
    for (std::size_t k = 0; k < std::min(errors.size(), std::size(paths)); ++k)
    {
      check(Contains(errors[k], std::string("block \"") + paths[k] + "\": ") &&
          Contains(errors[k], "point 0 is not finite"),
        std::string("an error should name ") + paths[k] + Joined(errors));
    }
  }
  else
  {
    check(errors.empty(), "nothing is refused" + Joined(errors));
  }

  auto* result = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  if (!check(result && result->GetNumberOfBlocks() == 6, "the tree should come out"))
  {
    return;
  }
  check(!result->GetBlock(2), "what is not there should not come out");
  auto* resultWheels = vtkMultiBlockDataSet::SafeDownCast(result->GetBlock(1));
  const std::pair<vtkPolyData*, vtkDataObject*> whole[] = { { egg, result->GetBlock(0) },
    { ball, result->GetBlock(5) }, { ball, resultWheels ? resultWheels->GetBlock(0) : nullptr } };
  for (const auto& [input, output] : whole)
  {
    const auto alone = subject.make();
    alone->SetInputData(input);
    alone->Update();
    auto* expected = alone->GetOutput();
    auto* surface = vtkPolyData::SafeDownCast(output);
    check(surface && expected->GetNumberOfPoints() > 0 && SamePoints(surface, expected) &&
        SameCells(surface, expected),
      "a good block should come out as it does alone");
  }

  // Nothing of the tree is left for a surface alone.
  errors.clear();
  filter->SetInputData(Broken(ball));
  filter->Update();
  check(
    errors.size() == (subject.refuses ? 1 : 0) && (errors.empty() || !Contains(errors[0], "block")),
    "an error of a surface alone should name no block" + Joined(errors));
}
}

int TestBlocks(int, char*[])
{
  Checker check;
  for (const Subject& subject : Subjects())
  {
    CheckBlocks(check, subject);
  }
  return check.Result();
}
