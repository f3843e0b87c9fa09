// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// vtkHandleDeformFilter: the contract, its rows, that handles are where they were put, and what it
/// refuses. TestHandles looks at the method.
#include "ComparatorTesting.h"
#include "PropertyTesting.h"

#include "vtkHandleDeformFilter.h"
#include "vtkObjectFactory.h"

#include <cmath>

using namespace FilterTesting;

namespace
{
using FilterType = vtkHandleDeformFilter;

constexpr double Pinned[10] = { 0.0, 0.0, -1.6, 0.7, 0.0, 0.0, -1.6, 0.0, 0.0, 0.0 };
constexpr double Lifted[10] = { 0.4, 0.0, 2.2, 0.7, 0.7, 0.6, 2.5, 0.0, 40.0, 10.0 };

/// As the tests of the contract make it: one end stays, the other is lifted.
class Posed : public vtkHandleDeformFilter
{
public:
  static Posed* New();
  vtkTypeMacro(Posed, vtkHandleDeformFilter);

protected:
  Posed()
  {
    this->AddHandle(Pinned);
    this->AddHandle(Lifted);
  }
};
vtkStandardNewMacro(Posed);

void Properties(Checker& check)
{
  check.About("properties");
  vtkNew<FilterType> filter;
  RoundTrip(ComponentCoupling, 0, 1);
  RoundTrip(StopRule, 0, 1);
  RoundTrip(Tolerance, 1e-5, 1e-4);
  RoundTrip(MaximumNumberOfIterations, 500, 7);
  RoundTrip(OutputPointsPrecision, 2, 1);
  Mode(ComponentCoupling, Stitched, STITCHED, 0);
  Mode(ComponentCoupling, Independent, INDEPENDENT, 1);
  Clamped(ComponentCoupling, 2, 1);

  check.About("rows");
  check(filter->GetNumberOfHandles() == 0 && !filter->GetHandle(1), "there should be no row");
  filter->AddHandle(Pinned);
  const vtkMTimeType time = filter->GetMTime();
  filter->AddHandle(Lifted);
  check(filter->GetMTime() > time && filter->GetNumberOfHandles() == 2, "there should be two rows");
  check(std::equal(Pinned, Pinned + 10, filter->GetHandle(1)) &&
      std::equal(Lifted, Lifted + 10, filter->GetHandle(2)),
    "rows should be as they were added");
  check(!filter->GetHandle(0) && !filter->GetHandle(3), "there should be no other row");
  const vtkMTimeType before = filter->GetMTime();
  filter->SetHandle(2, Lifted);
  check(filter->GetMTime() == before, "the same row should change nothing");
  filter->SetHandle(1, Lifted);
  check(filter->GetMTime() > before && std::equal(Lifted, Lifted + 10, filter->GetHandle(1)),
    "a row should be replaced");
  Watched<FilterType> watched;
  watched->SetHandle(1, Lifted);
  check(watched.Errors.size() == 1 && Contains(watched.Errors[0], "there is no row 1"),
    "a row that there is not should be an error");
  filter->RemoveAllHandles();
  check(filter->GetNumberOfHandles() == 0, "all rows should be removed");
}

/// Of the points of a row: how far they are from where it takes them.
double FarFromPlace(vtkPolyData* input, vtkPolyData* output, int number, const double* row)
{
  vtkDataArray* rows = PointArray(output, "Handle");
  double angle = vtkMath::Norm(row + 7);
  const Vector axis = { row[7] / angle, row[8] / angle, row[9] / angle };
  angle = vtkMath::RadiansFromDegrees(angle);
  double largest = 0.0;
  int points = 0;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    if (rows->GetComponent(i, 0) != number)
    {
      continue;
    }
    ++points;
    // Rodrigues
    Vector x = PointOf(input, i);
    Vector cross;
    vtkMath::Subtract(x.data(), row, x.data());
    vtkMath::Cross(axis.data(), x.data(), cross.data());
    const double along = vtkMath::Dot(axis.data(), x.data()) * (1.0 - std::cos(angle));
    Vector to;
    for (int k = 0; k < 3; ++k)
    {
      to[k] = row[4 + k] + std::cos(angle) * x[k] + std::sin(angle) * cross[k] + along * axis[k];
    }
    largest = std::max(largest, Distance(to, PointOf(output, i)));
  }
  return points > 3 ? largest : HUGE_VAL;
}

void Places(Checker& check)
{
  check.About("places of handles");
  const Surface model = MakeModel();
  Watched<Posed> filter(model);
  vtkPolyData* output = filter.Output();
  check(filter->GetConverged() && filter.Warnings.empty(), "it should converge");
  vtkDataArray* rows = PointArray(output, "Handle");
  vtkIdType pinned = 0;
  for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
  {
    if (rows->GetComponent(i, 0) == 1.0)
    {
      ++pinned;
      check(SamePoint(model, i, output, i), "point " + Text(i) + " is pinned to the bit");
    }
    const Vector x = PointOf(model, i);
    const double distance = Distance(x, { Lifted[0], Lifted[1], Lifted[2] });
    check((rows->GetComponent(i, 0) == 2.0) == (distance <= Lifted[3]),
      "Handle should say what the radius does at point " + Text(i));
  }
  check(pinned > 3, "some points should be pinned");
  check.AtMost(FarFromPlace(model, output, 2, Lifted), 1e-15 * Diagonal(model), "lifted points");

  // The place of a handle goes to the bit where it is moved to, whatever the rotation.
  Vector center = PointOf(model, 40);
  double row[10] = { center[0], center[1], center[2], 0.0, 0.1, 0.7, 1.3, 70.0, -20.0, 300.0 };
  Watched<FilterType> one(model);
  one->AddHandle(Pinned);
  one->AddHandle(row);
  check(PointOf(one.Output(), 40) == Vector{ 0.1, 0.7, 1.3 }, "its place should be where it says");

  check.About("a handle alone");
  one->RemoveAllHandles();
  one->AddHandle(Lifted);
  const Surface moved = Surface::New();
  moved->DeepCopy(one.Output());
  const double first = Distance(PointOf(model, 3), PointOf(model, 100));
  check.AtMost(std::abs(Distance(PointOf(moved, 3), PointOf(moved, 100)) - first), 1e-12,
    "change of a distance");
  check(LargestDistance(model, moved) > 0.3, "the model should move as a whole");
  one->RemoveAllHandles();
  check(SamePoints(model, one.Output()), "without handles all points should keep their bits");
  one->AddHandle(Pinned);
  check(SamePoints(model, one.Output()), "with pins alone, too");
}

void Invariance(Checker& check)
{
  check.About("another place, turned");
  const Surface model = MakeModel();
  Watched<Posed> here(model);
  here->SetTolerance(1e-9);
  // A quarter about z: x, y -> -y, x.
  const auto turn = [](const Vector& x) { return Vector{ -x[1] + 30.0, x[0] - 20.0, x[2] + 7.0 }; };
  const auto turnedRow = [&](const double* row)
  {
    const Vector place = turn({ row[0], row[1], row[2] });
    const Vector to = turn({ row[4], row[5], row[6] });
    return std::array<double, 10>{ place[0], place[1], place[2], row[3], to[0], to[1], to[2],
      -row[8], row[7], row[9] };
  };
  Watched<FilterType> there(Mapped(model, turn));
  there->SetTolerance(1e-9);
  there->AddHandle(turnedRow(Pinned).data());
  there->AddHandle(turnedRow(Lifted).data());
  check.AtMost(LargestDistance(Mapped(here.Output(), turn), there.Output()), 1e-6 * Diagonal(model),
    "difference");

  check.About("threads");
  const Surface large = MakeBumps(60);
  Watched<FilterType> threads(large);
  for (const double z : { -0.8, 0.8 })
  {
    const double row[10] = { 0.0, 0.0, z, 0.3, 0.0, 0.0, 1.4 * z, 0.0, 0.0, 60.0 * z };
    threads->AddHandle(row);
  }
  threads->SetNumberOfThreads(1);
  const Surface expected = Surface::New();
  expected->DeepCopy(threads.Output());
  for (const int count : { 2, 3, 7 })
  {
    threads->SetNumberOfThreads(count);
    check(SamePolyData(expected, threads.Output()), Text(count) + " threads: the same bits");
  }
}

/// The other ball stays, or goes along; and points are named by an array.
void PartsAndArrays(Checker& check)
{
  check.About("parts");
  const Surface model = MakeModel();
  const Surface eye = Shifted(MakeEllipsoid({ 0.2, 0.2, 0.2 }), { 0.5, 0.0, 2.6 });
  const Surface both = Together({ model, eye });
  Watched<FilterType> filter(both);
  const double narrow[10] = { 0.4, 0.0, 1.8, 0.5, 0.7, 0.6, 2.5, 0.0, 40.0, 10.0 };
  filter->AddHandle(Pinned);
  filter->AddHandle(narrow);
  const vtkIdType first = model->GetNumberOfPoints();
  check(LargestDistanceInPart(eye, filter.Output(), first) > 0.3, "a part goes along by default");
  filter->SetComponentCouplingToIndependent();
  check(LargestDistanceInPart(eye, filter.Output(), first) == 0.0, "a part stays to the bit");

  check.About("specks");
  Watched<FilterType> alone(model);
  alone->AddHandle(Pinned);
  alone->AddHandle(Lifted);
  const Surface result = Mapped(alone.Output(), [](const Vector& x) { return x; });
  for (const double far : { 2.0, 30.0, 1e4 })
  {
    const Surface speck =
      Shifted(MakeSurface({ { 0, 0, 0 }, { 1e-3, 0, 0 }, { 0, 1e-3, 0 } }, { { 0, 1, 2 } }),
        { far, 0.3, 0.0 });
    Watched<FilterType> beside(Together({ model, speck }));
    beside->AddHandle(Pinned);
    beside->AddHandle(Lifted);
    check.AtMost(LargestDistanceInPart(result, beside.Output(), 0), 0.02,
      "the model beside a speck at " + vtkVariant(far).ToString());
  }

  check.About("array of handles");
  Watched<FilterType> expected(model);
  expected->AddHandle(Pinned);
  expected->AddHandle(Lifted);
  const Surface named = Surface::New();
  named->DeepCopy(expected.Output());
  named->SetPoints(model->GetPoints());
  named->GetPointData()->GetArray("Handle")->SetName("chosen");
  Watched<FilterType> chosen(named);
  const auto without = [](const double* row)
  {
    std::array<double, 10> other;
    std::copy_n(row, 10, other.begin());
    other[3] = 0.0;
    return other;
  };
  chosen->AddHandle(without(Pinned).data());
  chosen->AddHandle(without(Lifted).data());
  chosen->SetInputArrayToProcess(0, 0, 0, OfPoints, "chosen");
  check(SamePoints(expected.Output(), chosen.Output()) && chosen.Errors.empty(),
    "points of the array should be those of the radius");
  const auto refuses = [&](const char* words)
  {
    chosen.Errors.clear();
    chosen.Output();
    check(chosen.Errors.size() == 1 && Contains(chosen.Errors[0], words),
      std::string("an error says ") + words + Joined(chosen.Errors));
  };
  chosen->AddHandle(Lifted);
  refuses("gives no point to row 3");
  chosen->RemoveAllHandles();
  chosen->AddHandle(Pinned);
  refuses("names row 2 at point");
  chosen->SetInputArrayToProcess(0, 0, 0, OfPoints, "lost");
  refuses("lost");
}

void Refused(Checker& check)
{
  const auto with = [](int place, double value)
  {
    return [=](Posed* self, vtkPolyData*)
    {
      double row[10];
      std::copy_n(Lifted, 10, row);
      row[place] = value;
      self->SetHandle(2, row);
    };
  };
  const auto repair = [](Posed* self) { self->SetHandle(2, Lifted); };
  for (int k = 0; k < 10; ++k)
  {
    ExpectError<Posed>(check, "number " + Text(k) + " is NaN",
      { "Handle: row 2 has a number that is not finite" }, with(k, NaN), repair);
  }
  ExpectError<Posed>(check, "infinite", { "not finite" }, with(4, HUGE_VAL), repair);
  ExpectError<Posed>(check, "a radius below 0",
    { "Handle: row 2: the radius must be 0 or more; it is -0.1" }, with(3, -0.1), repair);
  ExpectError<Posed>(
    check, "many turns", { "row 2 turns by more than 36000" }, with(8, 4e4), repair);
  ExpectError<Posed>(check, "far away", { "row 2 takes points farther" }, with(5, 1e12), repair);
  ExpectError<Posed>(check, "two handles at one point",
    { "Handle: row 1 and row 2 both hold point 0; make a radius smaller" }, with(3, 9.0), repair);
}
}

int TestHandleDeformFilter(int, char*[])
{
  Checker check;
  Properties(check);
  CheckContract<Posed>(check, { "Handles", "ComponentCoupling", "Tolerance" });
  CheckIteration<Posed>(check, nullptr);
  Places(check);
  Invariance(check);
  PartsAndArrays(check);
  Refused(check);
  return check.Result();
}
