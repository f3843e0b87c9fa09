// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every filter over a tree of blocks, of which some are refused, empty, without a name or not
/// there: one error for each that is refused, which begins with its path, and the others come out
/// as they do alone.
#include "ArrayTesting.h"
#include "EveryFilter.h"

#include "vtkCompositeDataSet.h"
#include "vtkExtractSelection.h"
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

/// Points that are at another place in the output.
std::vector<vtkIdType> Moved(vtkDataSet* input, vtkDataSet* output)
{
  std::vector<vtkIdType> ids;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    Vector p;
    Vector q;
    input->GetPoint(i, p.data());
    output->GetPoint(i, q.data());
    if (p != q)
    {
      ids.push_back(i);
    }
  }
  return ids;
}

using Path = std::vector<unsigned int>;

vtkDataSet* At(const Path& path, vtkDataObject* tree)
{
  for (const unsigned int number : path)
  {
    tree = vtkMultiBlockDataSet::SafeDownCast(tree)->GetBlock(number);
  }
  return vtkDataSet::SafeDownCast(tree);
}

/// Points that vtkExtractSelection has marked.
std::vector<vtkIdType> Marked(vtkDataSet* data)
{
  std::vector<vtkIdType> ids;
  vtkDataArray* inside = data ? data->GetPointData()->GetArray("vtkInsidedness") : nullptr;
  for (vtkIdType i = 0; inside && i < inside->GetNumberOfTuples(); ++i)
  {
    if (inside->GetComponent(i, 0) > 0.0)
    {
      ids.push_back(i);
    }
  }
  return ids;
}

/// A node that names a block selects nothing of the others: as ParaView's selections of points do.
template <typename FilterType>
void CheckSelections(Checker& check)
{
  const Surface ball = MakeEllipsoid({ 1.0, 1.2, 1.5 });
  vtkNew<vtkMultiBlockDataSet> wheels; // 3, with 4 and 5 below
  AddBlock(wheels, nullptr, ball);
  AddBlock(wheels, nullptr, Shifted(ball, { 4.0, 0.0, 0.0 }));
  vtkNew<vtkMultiBlockDataSet> car;
  AddBlock(car, "Body", Shifted(ball, { 0.0, 4.0, 0.0 })); // 1
  AddBlock(car, "Gap", nullptr);                           // 2
  AddBlock(car, "Wheels", wheels);
  const Path leaves[] = { { 0 }, { 2, 0 }, { 2, 1 } };

  struct Node
  {
    std::vector<vtkIdType> ids;
    int block; ///< -1: none is named
    bool inverse;
  };
  const std::pair<const char*, std::vector<Node>> cases[] = {
    { "no block named", { { { 3, 40, 41, 60 }, -1, false } } },
    { "one block", { { { 3, 40, 41, 60 }, 5, false } } },
    { "two blocks", { { { 3, 40, 41 }, 1, false }, { { 90, 91 }, 4, false } } },
    { "all blocks below one", { { { 17, 18 }, 3, false } } },
    { "all but some of one block", { { { 17, 18 }, 4, true } } },
    { "a block that is not there", { { { 17, 18 }, 2, false } } },
  };
  for (const auto& [name, nodes] : cases)
  {
    vtkNew<vtkSelection> selection;
    for (const Node& node : nodes)
    {
      const auto single = MakeSelection(node.ids, vtkSelectionNode::POINT);
      vtkInformation* properties = single->GetNode(0)->GetProperties();
      if (node.block >= 0)
      {
        properties->Set(vtkSelectionNode::COMPOSITE_INDEX(), node.block);
      }
      properties->Set(vtkSelectionNode::INVERSE(), node.inverse ? 1 : 0);
      selection->AddNode(single->GetNode(0));
    }
    vtkNew<vtkExtractSelection> extract;
    extract->SetInputDataObject(0, car);
    extract->SetInputDataObject(1, selection);
    extract->PreserveTopologyOn();
    extract->Update();
    auto* marked = vtkMultiBlockDataSet::SafeDownCast(extract->GetOutputDataObject(0));

    Watched<FilterType> filter;
    filter->SetInputDataObject(car);
    filter->SetSelectionData(selection);
    filter->Update();
    auto* result = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    check(filter.Errors.empty(), "no errors" + Joined(filter.Errors));
    std::size_t all = 0;
    for (const Path& path : leaves)
    {
      check.About(std::string(filter->GetClassName()) + ", selection of " + name + ", block " +
        Text(path.front()) + (path.size() > 1 ? "/" + Text(path.back()) : ""));
      const std::vector<vtkIdType> expected = Marked(At(path, marked));
      all += expected.size();
      check(Moved(At(path, car), At(path, result)) == expected,
        "the selected points should move, and no others");
    }
    check((all == 0) == (nodes.front().block == 2), "the case should select something");
  }
}
}

int TestBlocks(int, char*[])
{
  Checker check;
  for (const Subject& subject : Subjects())
  {
    CheckBlocks(check, subject);
  }
  CheckSelections<vtkSphericalStyleFilter>(check);
#ifdef SPHERICALSTYLE_WITH_CGAL
  CheckSelections<vtkConvexProxyDeformFilter>(check);
#endif
  return check.Result();
}
