// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// What vtkPartSizesFilter makes of a snowman whose parts are known, in points and table; what it
/// refuses and passes on. TestPartSizes looks at the formula.
#include "ArrayTesting.h"
#include "PropertyTesting.h"

#include "vtkCallbackCommand.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkPartSizesFilter.h"
#include "vtkSphericalStyleFilter.h"
#include "vtkSurfacePartsFilter.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>

using namespace FilterTesting;

namespace
{
constexpr int Body = 7; // the numbers in the array
constexpr int HeadPart = 3;
constexpr int Ear = 9;

bool Near(double a, double b)
{
  return std::abs(a - b) < 0.05;
}

Surface Copied(vtkPolyData* surface)
{
  Surface copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(surface);
  return copy;
}

class Sizes : public Watched<vtkPartSizesFilter>
{
public:
  explicit Sizes(vtkPolyData* input) { this->Get()->SetInputData(input); }

  vtkTable* Table()
  {
    this->Get()->Update();
    return vtkTable::SafeDownCast(this->Get()->GetOutputDataObject(1));
  }
  double Entry(vtkIdType row, const char* column)
  {
    return vtkDataArray::SafeDownCast(this->Table()->GetColumnByName(column))->GetComponent(row, 0);
  }
};

Surface Ball(double radius, double y)
{
  return Shifted(
    MakeEllipsoid({ radius, radius, radius }, Faces::Triangles, 48, 25), { 0.0, y, 0.0 });
}

void Number(vtkPolyData* surface, vtkIdType first, const char* name = "PartId")
{
  vtkNew<vtkIntArray> ids;
  ids->SetName(name);
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    ids->InsertNextValue(i < first ? Body : HeadPart);
  }
  surface->GetPointData()->AddArray(ids);
}

/// A ball on another one, with numbers of parts.
Surface Snowman()
{
  const Surface body = Ball(1.0, 0.0);
  Surface snowman = Together({ body, Ball(0.6, 1.4) });
  Number(snowman, body->GetNumberOfPoints());
  return snowman;
}

/// The same with a small ball on top of its head.
Surface WithEar()
{
  const Surface snowman = Snowman();
  Surface all = Together({ snowman, Ball(0.25, 2.1) });
  vtkNew<vtkIntArray> ids;
  ids->DeepCopy(snowman->GetPointData()->GetArray("PartId"));
  while (ids->GetNumberOfValues() < all->GetNumberOfPoints())
  {
    ids->InsertNextValue(Ear);
  }
  all->GetPointData()->AddArray(ids);
  return all;
}

/// Lowest and highest of some points along an axis.
std::pair<double, double> Range(vtkPolyData* surface, int part, int axis = 1)
{
  vtkDataArray* ids = surface->GetPointData()->GetArray("PartId");
  std::pair<double, double> range(HUGE_VAL, -HUGE_VAL);
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    if (part < 0 || ids->GetComponent(i, 0) == part)
    {
      const double x = PointOf(surface, i)[axis];
      range = { std::min(range.first, x), std::max(range.second, x) };
    }
  }
  return range;
}

double Height(vtkPolyData* surface, int part, int axis = 1)
{
  const auto [low, high] = Range(surface, part, axis);
  return high - low;
}

void OneSize(Checker& check)
{
  check.About("one size");
  const Surface snowman = Snowman();
  Sizes sizes(snowman);
  check(SamePoints(sizes.Output(), snowman) && SameCells(sizes.Output(), snowman),
    "without sizes the surface should stay to the bit");
  sizes->SetPartSize(HeadPart, 2.0);
  sizes->SetBlendWidth(0.01);
  vtkPolyData* output = sizes.Output();
  check(sizes.Errors.empty() && sizes.Warnings.empty(), "there should be no message");
  check(SameCells(output, snowman) &&
      SameArray(
        output->GetPointData()->GetArray("PartId"), snowman->GetPointData()->GetArray("PartId")),
    "cells and arrays should pass");
  check.AtMost(std::abs(Height(output, HeadPart, 0) - 2.4), 0.02, "width of the head beside 2.4");
  check.AtMost(std::abs(Range(output, Body).first + 1.0), 0.01, "move of the ground");
  check(sizes.Table()->GetNumberOfRows() == 2 && sizes.Entry(0, "Part") == HeadPart &&
      sizes.Entry(1, "Part") == Body && sizes.Entry(0, "Size") == 2.0 &&
      sizes.Entry(1, "Size") == 1.0,
    "the table should tell the sizes");
  check.AtMost(std::abs(sizes.Entry(0, "HeightBefore") - Height(snowman, HeadPart)) +
      std::abs(sizes.Entry(0, "Height") - Height(output, HeadPart)),
    1e-6, "heights in the table");
  double largest = 0.0;
  for (vtkIdType i = 0; i < snowman->GetNumberOfPoints(); ++i)
  {
    double moved[3];
    output->GetPointData()->GetArray("Displacement")->GetTuple(i, moved);
    for (int k = 0; k < 3; ++k)
    {
      largest =
        std::max(largest, std::abs(PointOf(output, i)[k] - PointOf(snowman, i)[k] - moved[k]));
    }
  }
  check.AtMost(largest, 1e-6, "displacement beside the move");
  sizes->RemoveAllPartSizes();
  check(SamePoints(sizes.Output(), snowman), "without sizes again the surface should stay");

  check.About("another place, size and number of threads");
  const Surface far = Mapped(snowman,
    [](const Vector& x) {
      return Vector{ 1e3 * x[0] + 7e3, 1e3 * x[1] - 2e3, 1e3 * x[2] };
    });
  sizes->SetPartSize(HeadPart, 2.0);
  Sizes other(far);
  other->SetPartSize(HeadPart, 2.0);
  other->SetBlendWidth(0.01);
  other->SetNumberOfThreads(3);
  double off = 0.0;
  for (vtkIdType i = 0; i < far->GetNumberOfPoints(); ++i)
  {
    off = std::max(
      off, std::abs(PointOf(other.Output(), i)[1] - (1e3 * PointOf(sizes.Output(), i)[1] - 2e3)));
  }
  check.AtMost(off, 0.02, "what place and size change");
}

void OnTheGround(Checker& check)
{
  check.About("on the ground");
  const Surface snowman = Snowman();
  for (int axis = 0; axis < 3; ++axis)
  {
    Sizes sizes(snowman);
    sizes->SetPartSize(Body, 1.5);
    sizes->SetPartSize(HeadPart, 0.5);
    sizes->SetUpAxis(axis);
    sizes->KeepOnGroundOn();
    check.AtMost(std::abs(Range(sizes.Output(), -1, axis).first - Range(snowman, -1, axis).first),
      1e-6, "height of the ground");
  }
}

/// What hangs on the head alone goes along, unless it has a size of its own.
void GoingAlong(Checker& check)
{
  const Surface model = WithEar();
  Sizes sizes(model);
  sizes->SetBlendWidth(0.01);
  const auto expect = [&](const char* about, double head, double body, double ear)
  {
    check.About(about);
    check(sizes.Table()->GetNumberOfRows() == 3 && sizes.Entry(0, "Part") == HeadPart &&
        sizes.Entry(1, "Part") == Body && sizes.Entry(2, "Part") == Ear,
      "there should be three parts");
    check.AtMost(std::abs(sizes.Entry(0, "Size") - head) + std::abs(sizes.Entry(1, "Size") - body) +
        std::abs(sizes.Entry(2, "Size") - ear),
      1e-12, "sizes");
    check(sizes.Errors.empty() && sizes.Warnings.empty(), "there should be no message");
  };
  expect("no row, which needs no head", 1.0, 1.0, 1.0);
  check(sizes->GetEffectiveHead() == -1, "there should be no head");
  sizes->SetPartSize(HeadPart, 1.6);
  expect("an ear goes along with the head", 1.6, 1.0, 1.6);
  check(sizes->GetEffectiveHead() == HeadPart, "the head should be known");
  check.AtMost(std::abs(Height(sizes.Output(), Ear, 0) - 0.5 * 1.6), 0.02, "width of the ear");
  sizes->SetPartSize(Ear, 1.0);
  expect("an ear with a size", 1.6, 1.0, 1.0);
  check.AtMost(std::abs(Height(sizes.Output(), Ear, 0) - 0.5), 0.05, "width of the ear");
  sizes->RemoveAllPartSizes();
  sizes->SetPartSize(Body, 0.5);
  expect("a body takes nothing along", 1.0, 0.5, 1.0);
  sizes->SetHead(Body);
  expect("a head that is told, on which nothing hangs", 1.0, 0.5, 1.0);
  check(sizes->GetEffectiveHead() == Body, "the head should be what is told");
  sizes->SetHead(HeadPart);
  sizes->RemoveAllPartSizes();
  sizes->SetPartSize(Ear, 2.0);
  expect("the size of an ear alone", 1.0, 1.0, 2.0);

  check.About("HeadHeight with a size for the head");
  sizes->RemoveAllPartSizes();
  sizes->SetHeadHeight(0.5);
  sizes.Output();
  const double found = sizes.Entry(0, "Size");
  check.AtMost(std::abs(sizes.Entry(2, "Size") - found), 0.0, "size of the ear beside the head");
  check.AtMost(std::abs(sizes.Entry(0, "Height") / sizes.Entry(1, "Height") - 0.5), 1e-5,
    "height of the head, without the ear");
  sizes->SetPartSize(HeadPart, 1.6);
  sizes.Output();
  check.AtMost(std::abs(sizes.Entry(0, "Size") - found) + std::abs(sizes.Entry(2, "Size") - found),
    1e-9, "head and ear, which are as with HeadHeight alone");
}

void HeadHeight(Checker& check)
{
  check.About("head to body");
  const Surface snowman = Snowman();
  for (const double wanted : { 0.25, 0.5, 1.0 })
  {
    Sizes sizes(snowman);
    sizes->SetHeadHeight(wanted);
    vtkPolyData* output = sizes.Output();
    check.AtMost(std::abs(Height(output, HeadPart) / Height(output, Body) / wanted - 1.0), 1e-5,
      "head to body beside " + Text(wanted));
    check(sizes.Entry(1, "Size") == 1.0, "the body should keep its size");
    check.AtMost(std::abs(sizes.Entry(0, "Height") / sizes.Entry(1, "Height") / wanted - 1.0), 1e-5,
      "the same in the table");
  }
  // After rounding, which passes the array on.
  vtkNew<vtkSphericalStyleFilter> style;
  style->SetInputData(snowman);
  vtkNew<vtkPartSizesFilter> after;
  after->SetInputConnection(style->GetOutputPort());
  after->SetHeadHeight(0.5);
  after->Update();
  check.AtMost(
    std::abs(Height(after->GetOutput(), HeadPart) / Height(after->GetOutput(), Body) / 0.5 - 1.0),
    1e-5, "head to body of a rounded model");
  // The other one as the head.
  Sizes sizes(snowman);
  sizes->SetHeadHeight(1.0);
  sizes->SetHead(Body);
  check.AtMost(std::abs(Height(sizes.Output(), HeadPart) / Height(sizes.Output(), Body) - 1.0),
    1e-5, "body to head");
}

void Refused(Checker& check)
{
  const Surface snowman = Snowman();
  const auto refuse = [&](const char* about, const std::string& words,
                        const std::function<void(vtkPartSizesFilter*)>& set,
                        const std::function<void(vtkPartSizesFilter*)>& mend)
  {
    check.About(about);
    Sizes sizes(snowman);
    set(sizes.Get());
    sizes.Output();
    check(sizes.Errors.size() == 1 && Contains(sizes.Errors[0], words),
      "one error should say \"" + words + "\"" + Joined(sizes.Errors));
    check(sizes.Output()->GetNumberOfPoints() == 0, "nothing should come out");
    check(sizes->GetEffectiveHead() == -1, "there should be no head");
    sizes.Errors.clear();
    mend(sizes.Get());
    check(
      sizes.Output()->GetNumberOfPoints() == snowman->GetNumberOfPoints() && sizes.Errors.empty(),
      "it should work again" + Joined(sizes.Errors));
  };
  const auto clear = [](vtkPartSizesFilter* f) { f->RemoveAllPartSizes(); };
  for (const double size : { 0.0, -1.0, vtkMath::Nan(), vtkMath::Inf() })
  {
    refuse(
      "a size out of range", "Size of part 3 must be above 0",
      [=](vtkPartSizesFilter* f) { f->SetPartSize(HeadPart, size); }, clear);
  }
  const auto byNumber = [](double ratio)
  { return [ratio](vtkPartSizesFilter* f) { f->SetHeadHeight(ratio); }; };
  refuse("a ratio out of range", "HeadHeight must be 0 or more", byNumber(-0.5), byNumber(0.0));
  // The heights in reach are those of sizes of 1/20 and 20.
  double reach[2];
  for (const bool most : { false, true })
  {
    Sizes largest(snowman);
    largest->SetPartSize(HeadPart, most ? 20.0 : 1.0 / 20.0);
    reach[most] = largest.Entry(0, "Height") / largest.Entry(1, "Height");
    Sizes far(snowman);
    far->SetHeadHeight(most ? 1000.0 : 1e-4);
    far.Output();
    const std::string text = far.Errors.empty() ? "made 0 to 0 times" : far.Errors[0];
    double told[2];
    check(std::sscanf(text.substr(text.find("made ")).c_str(), "made %lg to %lg times", &told[0],
            &told[1]) == 2,
      "the heights in reach should be told" + Joined(far.Errors));
    check.AtMost(std::abs(told[most] / reach[most] - 1.0), 0.01, "height that is told");
    far.Errors.clear();
    far->SetHeadHeight(told[most]);
    check(far.Output()->GetNumberOfPoints() > 0 && far.Errors.empty(),
      "it should be in reach" + Joined(far.Errors));
    far->SetHeadHeight(reach[most] * (most ? 1.01 : 0.99));
    far.Output();
    check(far.Errors.size() == 1, "more should be out of reach");
  }
  refuse("a ratio out of reach", "by factors from 1/20 to 20, not 1000", byNumber(1000.0),
    byNumber(0.5));
  refuse(
    "no such head", "Head: there is no part 5; there are 3, 7",
    [](vtkPartSizesFilter* f)
    {
      f->SetHeadHeight(0.5);
      f->SetHead(5);
    },
    [](vtkPartSizesFilter* f) { f->SetHead(-1); });
  Sizes numbers(snowman);
  numbers->SetPartSize(3, 1.5);
  numbers->SetPartSize(std::nan(""), 2.0);
  check(numbers.Errors.size() == 1 && Contains(numbers.Errors.front(), "A part must be a number") &&
      numbers->GetPartSize(3) == 1.5,
    "NaN should be refused, and be no other part" + Joined(numbers.Errors));
  refuse(
    "no head below -1", "Head: there is no part -2; there are 3, 7",
    [](vtkPartSizesFilter* f)
    {
      f->SetHeadHeight(0.5);
      f->SetHead(-2);
    },
    [](vtkPartSizesFilter* f) { f->SetHead(-1); });
  const auto array = [](const char* name)
  { return [name](vtkPartSizesFilter* f) { f->SetInputArrayToProcess(0, 0, 0, OfPoints, name); }; };
  refuse("no such array", "no numeric point array \"Missing\"", array("Missing"), array("PartId"));
  vtkNew<vtkDoubleArray> halves;
  halves->SetName("Halves");
  halves->SetNumberOfValues(snowman->GetNumberOfPoints());
  halves->FillValue(1.0);
  halves->SetValue(5, 0.5);
  halves->SetValue(70, 0.5); // the first one is named
  snowman->GetPointData()->AddArray(halves);
  refuse("no whole numbers", "point 5 has 0.5", array("Halves"), array("PartId"));
  vtkNew<vtkIntArray> each;
  each->SetName("Each");
  for (vtkIdType i = 0; i < snowman->GetNumberOfPoints(); ++i)
  {
    each->InsertNextValue(static_cast<int>(i));
  }
  snowman->GetPointData()->AddArray(each);
  refuse("a part per point", "there can be 256 parts", array("Each"), array("PartId"));

  check.About("one part");
  const Surface ball = Ball(1.0, 0.0);
  Number(ball, ball->GetNumberOfPoints());
  Sizes one(ball);
  one->SetHeadHeight(0.5);
  one.Output();
  check(one.Errors.empty() && one.Warnings.size() == 1 &&
      Contains(one.Warnings[0], "the model has only one part") &&
      Contains(one.Warnings[0], "NumberOfParts of Surface Parts"),
    "one warning should say the cause and the way out" + Joined(one.Warnings));
  one->SetHeadHeight(0.0);
  one->SetPartSize(Body, 2.0);
  check.AtMost(std::abs(Height(one.Output(), Body) - 4.0), 1e-5, "height at size 2");
  check(one.Errors.empty(), "one part should have a size" + Joined(one.Errors));

  check.About("heights of 0");
  Sizes flat(Mapped(snowman, [](const Vector& x) { return Vector{ x[0], x[1], 0.0 }; }));
  flat->SetHead(HeadPart);
  flat->SetHeadHeight(0.5);
  flat->SetUpAxisToZ();
  flat.Output();
  check(flat.Errors.size() == 1 && Contains(flat.Errors[0], "no height along UpAxis"),
    "one error should say so" + Joined(flat.Errors));
  flat.Errors.clear();
  flat->SetUpAxisToY();
  check(flat.Output()->GetNumberOfPoints() > 0 && flat.Errors.empty(),
    "along y there are heights" + Joined(flat.Errors));

  check.About("no such part");
  Sizes sizes(snowman);
  sizes->SetPartSize(5, 2.0);
  check(SamePoints(sizes.Output(), snowman) && sizes.Warnings.size() == 1 &&
      Contains(sizes.Warnings[0], "no part 5 to be given a size; there are 3, 7"),
    "a warning should say so" + Joined(sizes.Warnings));
}

/// Aborts the search for parts.
void AbortSearch(vtkObject* caller, unsigned long, void*, void*)
{
  auto* filter = vtkAlgorithm::SafeDownCast(caller);
  const char* text = filter->GetProgressText();
  if (text && std::string(text) == "Looking for parts")
  {
    filter->SetAbortExecute(1);
  }
}

/// Without an array the parts are those of vtkSurfacePartsFilter.
void PartsOfItsOwn(Checker& check)
{
  check.About("no array");
  const Surface bare = Together({ Ball(1.0, 0.0), Ball(0.6, 1.4) });
  const auto sizedAs = [&check](vtkPartSizesFilter* filter, vtkPolyData* surface)
  {
    vtkNew<vtkSurfacePartsFilter> parts;
    parts->SetInputData(surface);
    parts->Update();
    Sizes given(parts->GetOutput());
    given->SetPartSize(1, 1.5);
    vtkPolyData* output = filter->GetOutput();
    check(output->GetPointData()->HasArray("PartId") &&
        SameArray(output->GetPointData()->GetArray("PartId"),
          parts->GetOutput()->GetPointData()->GetArray("PartId")),
      "numbers should be those of Surface Parts");
    check(SamePoints(output, given.Output()), "the result should be that with their array");
  };
  const Surface input = Copied(bare);
  Sizes sizes(input);
  sizes->SetPartSize(1, 1.5);
  sizes.Output();
  check(sizes.Errors.empty() && sizes.Warnings.empty() && sizes.Table()->GetNumberOfRows() == 2,
    "there should be two parts" + Joined(sizes.Errors));
  sizedAs(sizes.Get(), input);
  const auto* kept = sizes.Get()->GetOutput()->GetPointData()->GetArray("PartId");
  sizes->SetPartSize(1, 1.2);
  sizes->SetPartSize(1, 1.5);
  sizes.Output();
  check(sizes.Get()->GetOutput()->GetPointData()->GetArray("PartId") == kept,
    "another size should look for no parts");
  double place[3];
  input->GetPoints()->GetPoint(0, place);
  input->GetPoints()->SetPoint(0, place[0], place[1] + 0.01, place[2]); // behind VTK's back
  sizes->Modified();
  sizes.Output();
  check(
    sizes.Get()->GetOutput()->GetPointData()->GetArray("PartId") != kept, "another surface should");
  sizedAs(sizes.Get(), input);

  check.About("a search that is aborted");
  Sizes aborted(bare);
  aborted->SetPartSize(1, 1.5);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(AbortSearch);
  const unsigned long tag = aborted->AddObserver(vtkCommand::ProgressEvent, abort);
  check(aborted.Output()->GetNumberOfPoints() == 0 && aborted.Errors.empty(),
    "nothing should come out" + Joined(aborted.Errors));
  aborted->RemoveObserver(tag);
  aborted->SetAbortExecute(0);
  aborted->Modified();
  aborted.Output();
  sizedAs(aborted.Get(), bare);
}

/// What the filter keeps of a surface holds for its points, its parts and the width.
void Kept(Checker& check)
{
  check.About("what is kept");
  const Surface input = Snowman();
  Sizes sizes(input);
  sizes->SetPartSize(HeadPart, 1.5);
  const auto isAsNew = [&](const char* change)
  {
    input->Modified();
    Sizes anew(input);
    anew->SetPartSize(HeadPart, 1.5);
    anew->SetBlendWidth(sizes->GetBlendWidth());
    check(SamePoints(sizes.Output(), anew.Output()), std::string("after ") + change);
  };
  isAsNew("nothing");
  const Surface before = Copied(sizes.Output());
  sizes->SetPartSize(HeadPart, 1.2);
  sizes.Output();
  sizes->SetPartSize(HeadPart, 1.5);
  check(SamePoints(sizes.Output(), before), "after another size");
  sizes->SetBlendWidth(0.1);
  isAsNew("another width");
  Number(input, input->GetNumberOfPoints() / 4);
  isAsNew("other numbers");
  check(!SamePoints(sizes.Output(), before), "the other parts should show");
  double place[3];
  input->GetPoints()->GetPoint(0, place);
  input->GetPoints()->SetPoint(0, place[0], place[1] + 0.01, place[2]);
  isAsNew("another place of a point");
}

/// Rows of a table, of which two may be of one part.
void Rows(Checker& check)
{
  check.About("two rows for a part");
  const Surface snowman = Snowman();
  Sizes sizes(snowman);
  sizes->AddPartSize(HeadPart, 2.0);
  sizes->AddPartSize(Body, 0.5);
  check(sizes.Entry(0, "Size") == 2.0 && sizes.Warnings.empty(), "rows are sizes");
  sizes->AddPartSize(HeadPart, 1.5);
  for (int k = 0; k < 2; ++k)
  {
    sizes.Warnings.clear();
    sizes->Modified();
    check(sizes.Entry(0, "Size") == 1.5 && sizes.Entry(1, "Size") == 0.5 &&
        sizes.Warnings.size() == 1 &&
        Contains(sizes.Warnings[0], "Part 3 has more than one size; the last one counts: 1.5"),
      "the last one should count, and a warning say so" + Joined(sizes.Warnings));
  }
  sizes.Warnings.clear();
  sizes->RemoveAllPartSizes();
  sizes->AddPartSize(HeadPart, 1.5);
  sizes->SetPartSize(HeadPart, 1.2);
  check(sizes.Entry(0, "Size") == 1.2 && sizes.Warnings.empty(),
    "a size that is set anew is no second one" + Joined(sizes.Warnings));
}

/// How parts are to be rounded, as arrays that vtkSphericalStyleFilter takes by their names.
void Styles(Checker& check)
{
  check.About("styles of parts");
  constexpr int RoundnessFactor = 1;
  constexpr int NormalBlend = 2;
  const Surface all = WithEar();
  Sizes parts(all);
  check(!parts.Output()->GetPointData()->HasArray("PartRoundness") &&
      !parts.Output()->GetPointData()->HasArray("PartNormalBlend"),
    "no row, no array");
  parts->SetPartRoundness(HeadPart, 0.0);
  parts->SetPartNormalBlend(HeadPart, 0.25);
  check(parts->GetPartRoundness(HeadPart) == 0.0 && parts->GetPartRoundness(Body) == 1.0 &&
      parts->GetPartNormalBlend(HeadPart) == 0.25 && parts->GetPartNormalBlend(Body) == -1.0,
    "rows and what there is without");
  const Surface styled = Copied(parts.Output());
  check(SamePoints(styled, all), "points stay");
  vtkDataArray* roundness = styled->GetPointData()->GetArray("PartRoundness");
  vtkDataArray* blend = styled->GetPointData()->GetArray("PartNormalBlend");
  const double* range = roundness->GetRange();
  check(Near(range[0], 0.0) && Near(range[1], 1.0), "factors of 0 to 1");
  for (vtkIdType i = 0; i < all->GetNumberOfPoints(); ++i)
  {
    const double y = all->GetPoint(i)[1];
    if (y < 0.0 || y > 1.6) // the head's ear goes along
    {
      const bool isHead = y > 1.0;
      check(Near(roundness->GetTuple1(i), isHead ? 0.0 : 1.0) &&
          Near(blend->GetComponent(i, 1), isHead ? 1.0 : 0.0) &&
          (!isHead || std::abs(blend->GetComponent(i, 0) - 0.25) < 1e-6),
        "values of point " + std::to_string(i));
    }
  }

  // The filter takes them, and parts keep together; arrays that are chosen come first.
  const auto rounded = [](vtkPolyData* input, bool choose, bool preview)
  {
    Watched<vtkSphericalStyleFilter> filter;
    filter->SetInputData(input);
    filter->SetNormalBlend(0.7);
    filter->SetPreview(preview);
    if (choose)
    {
      filter->SetInputArrayToProcess(RoundnessFactor, 0, 0, 0, "Factor");
      filter->SetInputArrayToProcess(NormalBlend, 0, 0, 0, "Blend");
    }
    filter->Update();
    return Copied(filter.Output());
  };
  const Surface chosen = Copied(all);
  vtkNew<vtkDoubleArray> factor, own;
  factor->SetName("Factor");
  own->SetName("Blend");
  for (vtkIdType i = 0; i < all->GetNumberOfPoints(); ++i)
  {
    const double w = blend->GetComponent(i, 1);
    factor->InsertNextValue(roundness->GetTuple1(i));
    own->InsertNextValue(w * blend->GetComponent(i, 0) + (1.0 - w) * 0.7);
  }
  chosen->GetPointData()->AddArray(factor);
  chosen->GetPointData()->AddArray(own);
  const Surface byName = rounded(styled, false, false);
  const auto headMoves = [&](vtkPolyData* result)
  {
    std::pair<double, double> range(HUGE_VAL, -HUGE_VAL);
    for (vtkIdType i = 0; i < all->GetNumberOfPoints(); ++i)
    {
      if (all->GetPoint(i)[1] > 1.6)
      {
        const double move = result->GetPoint(i)[1] - all->GetPoint(i)[1];
        range = { std::min(range.first, move), std::max(range.second, move) };
      }
    }
    return range;
  };
  const auto [least, most] = headMoves(byName);
  check(most < -0.1 && most - least < 0.1 * std::abs(most),
    "the head goes along with the body and keeps its shape: from " + std::to_string(least) +
      " to " + std::to_string(most));
  const auto [lowest, highest] = headMoves(rounded(chosen, true, false));
  check(std::abs(highest) < 0.5 * std::abs(most), "points with a factor of their own stay behind");
  check(!SamePoints(byName, rounded(all, false, false)), "they matter");
  check(SamePoints(byName, rounded(styled, false, true)), "a preview is the full result");
  const Surface both = Copied(styled);
  both->GetPointData()->AddArray(factor);
  for (vtkIdType i = 0; i < factor->GetNumberOfTuples(); ++i)
  {
    factor->SetValue(i, 1.0);
    own->SetValue(i, 0.7);
  }
  both->GetPointData()->AddArray(own);
  check(SamePoints(rounded(both, true, false), rounded(chosen, true, false)), "chosen ones first");

  vtkNew<vtkDoubleArray> directions;
  directions->SetName("TargetDirection");
  directions->SetNumberOfComponents(3);
  directions->SetNumberOfTuples(all->GetNumberOfPoints());
  directions->Fill(0.0);
  const Surface result = Copied(all);
  result->GetPointData()->AddArray(directions);
  Sizes late(result);
  late->SetPartSize(HeadPart, 1.2);
  late->Update();
  check(late.Warnings.empty(), "sizes may come after the rounding" + Joined(late.Warnings));
  late->SetPartRoundness(HeadPart, 2.0);
  late->Update();
  check(late.Warnings.size() == 1 && Contains(late.Warnings[0], "rounded already"),
    "a warning says that roundness comes too late" + Joined(late.Warnings));

  check.About("bad styles of parts");
  Sizes bad(all);
  bad->SetPartRoundness(HeadPart, -1.0);
  bad.Output();
  check(bad.Errors.size() == 1 && Contains(bad.Errors[0], "Roundness of part 3 must be 0 or more"),
    "an error says so" + Joined(bad.Errors));
  bad->RemoveAllPartRoundnesses();
  bad->AddPartNormalBlend(Body, 1.5);
  bad.Errors.clear();
  bad.Output();
  check(bad.Errors.size() == 1 && Contains(bad.Errors[0], "NormalBlend of part 7 must be in 0..1"),
    "an error says so" + Joined(bad.Errors));
  bad->RemoveAllPartNormalBlends();
  bad->AddPartRoundness(Body, 2.0);
  bad->AddPartRoundness(Body, 3.0);
  bad->AddPartNormalBlend(4, 0.5);
  bad.Errors.clear();
  bad.Output();
  check(bad.Errors.empty() && bad.Warnings.size() == 2 &&
      Contains(bad.Warnings[0], "Part 7 has more than one roundness; the last one counts: 3") &&
      Contains(bad.Warnings[1], "no part 4 to be given a blend"),
    "warnings say so" + Joined(bad.Warnings));
}

void WithoutTriangles(Checker& check)
{
  check.About("no polygon");
  const Surface snowman = Snowman();
  snowman->SetPolys(vtkNew<vtkCellArray>());
  Sizes sizes(snowman);
  sizes->SetPartSize(HeadPart, 2.0);
  check(SamePoints(sizes.Output(), snowman) && sizes.Errors.empty(), "points should stay");
  check.About("a point of no polygon");
  const Surface body = Ball(1.0, 0.0);
  const Surface more = Together({ body, Ball(0.6, 1.4) });
  more->GetPoints()->InsertNextPoint(3.0, 3.0, 3.0);
  Number(more, body->GetNumberOfPoints());
  Sizes alone(more);
  alone->SetPartSize(HeadPart, 2.0);
  check(PointOf(alone.Output(), more->GetNumberOfPoints() - 1) == Vector{ 3.0, 3.0, 3.0 } &&
      alone.Errors.empty(),
    "it should stay");
}

void Properties(Checker& check)
{
  check.About("properties");
  using FilterType = vtkPartSizesFilter;
  vtkNew<FilterType> filter;
  RoundTrip(BlendWidth, 0.05, 0.2);
  RoundTrip(HeadHeight, 0.0, 0.5);
  RoundTrip(Head, -1, 4);
  RoundTrip(KeepOnGround, false, true);
  RoundTrip(UpAxis, 1, 2);
  Mode(UpAxis, X, X_AXIS, 0);
  Mode(UpAxis, Y, Y_AXIS, 1);
  Mode(UpAxis, Z, Z_AXIS, 2);
  Clamped(BlendWidth, 0.0, 0.01);
  Clamped(BlendWidth, 2.0, 1.0);
  filter->SetPartSize(4, 1.5);
  const vtkMTimeType before = filter->GetMTime();
  filter->SetPartSize(4, 1.5);
  check(
    filter->GetMTime() == before && filter->GetPartSize(4) == 1.5 && filter->GetPartSize(5) == 1.0,
    "a size should be kept, and the same one change nothing");
  std::ostringstream printed;
  filter->Print(printed);
  for (const char* name :
    { "PartSizes: 4: 1.5", "BlendWidth: ", "HeadHeight: ", "Head: ", "KeepOnGround: ", "UpAxis: " })
  {
    check(Contains(printed.str(), std::string(" ") + name),
      std::string("PrintSelf should print ") + name);
  }
}
}

int TestPartSizesFilter(int, char*[])
{
  Checker check;
  OneSize(check);
  OnTheGround(check);
  GoingAlong(check);
  HeadHeight(check);
  Refused(check);
  Kept(check);
  Rows(check);
  PartsOfItsOwn(check);
  Styles(check);
  WithoutTriangles(check);
  Properties(check);
  return check.Result();
}
