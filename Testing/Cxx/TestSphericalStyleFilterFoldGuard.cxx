// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// AvoidSelfIntersections [guard], with vtkSurfaceMetrics as the judge: no triangle turned over, no
// new pair that intersects, whatever else is set; and nothing changed where there was none.
#include "ArrayTesting.h"
#include "SurfaceMetricsTesting.h"

using namespace FilterTesting;

namespace
{
constexpr int RoundnessArray = 1;
constexpr int RegionArray = 4;
constexpr int CenterIdArray = 5;

using Change = std::function<void(vtkThesisStyleFilter*)>;

void SetUp(vtkSphericalStyleFilter* filter)
{
  SetUpUniform(filter); // folds more, and iterates
  filter->SetNormalBlend(1.0);
  filter->SetRoundness(5.0);
  filter->AvoidSelfIntersectionsOn();
}

#ifdef SPHERICALSTYLE_WITH_CGAL
/// The defaults again, but for the guard and the long edges.
void Defaults(vtkSphericalStyleFilter* filter)
{
  filter->SetRoundness(1.0);
  filter->SetNormalBlend(0.6);
  filter->SetNormalRadiusToOwnThickness();
  filter->SetDetailSize(0.06);
  filter->SetKeepSizeToArea();
  filter->SetSphericalWeightingToCotangent();
}

// Two balls with a waist, where normals as targets fold; arrays to choose parts with.
Surface Dumbbell(int type = VTK_DOUBLE)
{
  const Surface ball = MakeEllipsoid({ 1.0, 0.8, 1.5 }, Faces::Triangles, 20, 21);
  Surface model = Mapped(
    ball,
    [](const Vector& x)
    {
      const double z = x[2] / 1.5;
      const double waist = 0.3 + 0.7 * z * z;
      return Vector{ waist * x[0], waist * x[1], x[2] };
    },
    type);
  const auto heights = [&](const std::function<double(double)>& value)
  { return [&model, value](vtkIdType i, int) { return value(PointOf(model, i)[2]); }; };
  model->GetPointData()->AddArray(
    MakeArray("region", model, 1, heights([](double z) { return z > -0.7 ? 1.0 : 0.0; })));
  model->GetPointData()->AddArray(
    MakeArray("part", model, 1, heights([](double z) { return z > 0.0 ? 3.0 : 8.0; })));
  model->GetPointData()->AddArray(
    MakeArray("factor", model, 1, heights([](double z) { return 1.0 + 0.5 * z; })));
  return model;
}

int Component(vtkTable* table, const char* name, int component)
{
  auto* array = vtkArrayDownCast<vtkDataArray>(table->GetFieldData()->GetAbstractArray(name));
  return array && component < array->GetNumberOfComponents()
    ? static_cast<int>(array->GetComponent(0, component))
    : -2;
}

/// In words what the numbers say, until something changes.
void CheckSummary(Checker& check, vtkSphericalStyleFilter* guarded, int repaired)
{
  const auto count = [](int n, const char* noun)
  { return Text(n) + " " + noun + (n == 1 ? "" : "s"); };
  const std::string summary = guarded->GetFoldSummary();
  const int over = guarded->GetTurnedOverBefore();
  const int pairs = guarded->GetNewIntersectionsBefore();
  check(over + pairs > 0
      ? Contains(summary, count(over, "triangle") + " turned over and " + count(pairs, "pair"))
      : Contains(summary, "nothing turned over"),
    "the summary should have the counts: " + summary);
  check(Contains(summary, count(repaired, "point") + " repaired") == (repaired > 0),
    "the summary should say what was repaired: " + summary);
  const double roundness = guarded->GetRoundness();
  guarded->SetRoundness(2.0 * roundness + 1.0);
  check(std::string(guarded->GetFoldSummary()).empty(), "it is that of the last execution");
  guarded->SetRoundness(roundness);
}

/// The counts of the filter beside those of vtkSurfaceMetrics, and none after.
/// @param folds  whether there must be some before
void CheckGuarded(Checker& check, vtkPolyData* model, const Change& change, bool folds = true)
{
  WatchedFilter plain(model);
  SetUp(plain.Get());
  change(plain.Get());
  plain->AvoidSelfIntersectionsOff();
  WatchedFilter guarded(model);
  SetUp(guarded.Get());
  change(guarded.Get());
  vtkPolyData* output = guarded.Output();
  check(
    guarded.Errors.empty() && (guarded.Warnings.empty() || Contains(guarded.Warnings[0], "leaves")),
    "no other message expected" + Joined(guarded.Errors) + Joined(guarded.Warnings));

  WatchedMetrics before(plain.Output(), model);
  WatchedMetrics after(output, model);
  check(guarded->GetTurnedOverBefore() == before["TurnedOver"] &&
      guarded->GetNewIntersectionsBefore() == before["NewSelfIntersectionPairs"],
    "the counts before should be those of the metrics: " + Text(guarded->GetTurnedOverBefore()) +
      ", " + Text(guarded->GetNewIntersectionsBefore()));
  check(!folds || before["TurnedOver"] + before["NewSelfIntersectionPairs"] > 0,
    "unguarded it should fold");
  after.Expect(check, "TurnedOver", 0);
  after.Expect(check, "NewSelfIntersectionPairs", 0);
  check(guarded->GetTurnedOverAfter() == 0 && guarded->GetNewIntersectionsAfter() == 0,
    "nothing should be left");
  auto* table = vtkTable::SafeDownCast(guarded->GetOutputDataObject(1));
  check(Component(table, "TurnedOver", 0) == guarded->GetTurnedOverBefore() &&
      Component(table, "TurnedOver", 1) == 0 &&
      Component(table, "NewIntersectingPairs", 0) == guarded->GetNewIntersectionsBefore() &&
      Component(table, "NewIntersectingPairs", 1) == 0,
    "the table should have the counts");
  const int solves = Component(table, "GuardSolves", 0);
  check(folds ? solves > 1 && solves <= 26 : solves >= 1, Text(solves) + " solves");
  const int repaired = Component(table, "GuardRepairedPoints", 0);
  check(repaired >= 0 && repaired < output->GetNumberOfPoints() / 10, Text(repaired) + " points");
  check(PointArray(output, "RemainingRoundness") != nullptr, "RemainingRoundness is missing");
  CheckSummary(check, guarded.Get(), repaired);
}

void NothingIsLeft(Checker& check, int argc, char* argv[])
{
  for (const char* name : { "tangram-prism.vtp", "stone-house.vtp" })
  {
    check.About(name);
    CheckGuarded(check, ReadModel(argc, argv, name), [](vtkSphericalStyleFilter*) {});
  }
  check.About("stretched tetrahedron");
  CheckGuarded(check,
    Mapped(ReadModel(argc, argv, "tetrahedron.vtp"),
      [](const Vector& x) {
        return Vector{ 1.8 * x[0], x[1], 0.3 * x[2] };
      }),
    [](vtkSphericalStyleFilter*) {});
  using F = vtkThesisStyleFilter;
  const std::pair<const char*, Change> settings[] = {
    { "as it is", [](F*) {} },
    { "region", [](F* f) { f->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region"); } },
    { "two centers",
      [](F* f) { f->SetInputArrayToProcess(CenterIdArray, 0, 0, OfPoints, "part"); } },
    { "roundness array",
      [](F* f) { f->SetInputArrayToProcess(RoundnessArray, 0, 0, OfPoints, "factor"); } },
    { "very round", [](F* f) { f->SetRoundness(1000.0); } },
    { "cotangent", [](F* f) { f->SetSphericalWeightingToCotangent(); } },
    { "single precision", [](F* f) { f->SetOutputPointsPrecision(F::SINGLE_PRECISION); } },
  };
  for (const auto& [name, change] : settings)
  {
    check.About(std::string("dumbbell, ") + name);
    CheckGuarded(check, Dumbbell(), change);
  }
  const std::pair<const char*, Change> milder[] = {
    { "half normals", [](F* f) { f->SetNormalBlend(0.5); } },
    { "defaults", Defaults },
    { "defaults, much of them",
      [](F* f)
      {
        Defaults(f);
        f->SetRoundness(5.0);
        f->SetNormalBlend(1.0);
      } },
    { "defaults and a region",
      [](F* f)
      {
        Defaults(f);
        f->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region");
      } },
    { "defaults and two centers",
      [](F* f)
      {
        Defaults(f);
        f->SetInputArrayToProcess(CenterIdArray, 0, 0, OfPoints, "part");
      } },
    { "its area", [](F* f) { f->SetKeepSizeToArea(); } },
    { "details", [](F* f) { f->SetDetailSize(0.03); } },
    { "flip", [](F* f) { f->SetConcaveEdgesToFlip(); } },
    { "zero", [](F* f) { f->SetConcaveEdgesToZero(); } },
  };
  for (const auto& [name, change] : milder)
  {
    check.About(std::string("dumbbell, ") + name);
    CheckGuarded(check, Dumbbell(VTK_FLOAT), change, false);
  }
}

/// Lambda of the points, at most what was asked; 1 and the array in place of Roundness give the
/// result again.
void RemainingRoundness(Checker& check)
{
  check.About("RemainingRoundness");
  const Surface model = Dumbbell();
  WatchedFilter guarded(model);
  SetUp(guarded.Get());
  guarded->SetInputArrayToProcess(RoundnessArray, 0, 0, OfPoints, "factor");
  vtkPolyData* output = guarded.Output();
  vtkDataArray* remaining = PointArray(output, "RemainingRoundness");
  vtkDataArray* factor = PointArray(model, "factor");
  int less = 0;
  for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
  {
    const double asked = 5.0 * factor->GetComponent(i, 0);
    const double left = remaining->GetComponent(i, 0);
    check(left > 0.0 && left <= asked, "more than 0 and no more than asked at " + Text(i));
    less += left < asked;
  }
  check(less > 0, "somewhere less should remain");

  WatchedFilter again(output);
  const Surface rest = Mapped(model, [](const Vector& x) { return x; });
  rest->GetPointData()->AddArray(remaining);
  again->SetInputData(rest);
  SetUpUniform(again.Get());
  again->SetNormalBlend(1.0);
  again->SetRoundness(1.0);
  again->SetInputArrayToProcess(RoundnessArray, 0, 0, OfPoints, "RemainingRoundness");
  check(SamePoints(again.Output(), output), "the array as factors should give the same bits");
  check(again->GetNumberOfIterations() == guarded->GetNumberOfIterations() &&
      again->GetFinalEnergy() == guarded->GetFinalEnergy(),
    "and the facts should be those of that solve");
}

/// Nothing folds, or nothing is asked for: the bits of the filter without the guard.
void CleanModels(Checker& check, int argc, char* argv[])
{
  const std::pair<const char*, Change> cases[] = {
    { "go-stone.vtp", [](vtkSphericalStyleFilter* f) { f->SetNormalBlend(0.0); } },
    { "go-stone.vtp", [](vtkSphericalStyleFilter* f) { f->SetSphericalWeightingToCotangent(); } },
    { "cube.vtp",
      [](vtkSphericalStyleFilter* f)
      {
        f->SetNormalBlend(0.0);
        f->SetRoundness(0.5);
        f->SetDetailSize(0.03);
      } },
    { "stone-house.vtp", [](vtkSphericalStyleFilter* f) { f->SetRoundness(0.0); } },
    { "go-stone.vtp", Defaults },
    { "stone-house.vtp",
      [](vtkSphericalStyleFilter* f)
      {
        Defaults(f);
        f->SetRoundness(0.0);
      } },
  };
  for (const auto& [name, change] : cases)
  {
    check.About(std::string("clean ") + name);
    const Surface model = ReadModel(argc, argv, name);
    WatchedFilter plain(model);
    SetUp(plain.Get());
    change(plain.Get());
    plain->AvoidSelfIntersectionsOff();
    WatchedFilter guarded(model);
    SetUp(guarded.Get());
    change(guarded.Get());
    vtkPolyData* output = guarded.Output();
    check(guarded.Warnings.empty() && guarded.Errors.empty(), "no message expected");
    check(guarded->GetTurnedOverBefore() == 0 && guarded->GetNewIntersectionsBefore() == 0,
      "it should have no folds");
    vtkDataArray* remaining = PointArray(output, "RemainingRoundness");
    for (vtkIdType i = 0; remaining && i < remaining->GetNumberOfTuples(); ++i)
    {
      check(remaining->GetComponent(i, 0) == guarded->GetRoundness(), "all should remain");
    }
    output->GetPointData()->RemoveArray("RemainingRoundness");
    check(SamePolyData(output, plain.Output()), "every bit should be that of the filter without");
    check(!PointArray(plain.Output(), "RemainingRoundness") && plain->GetTurnedOverBefore() == -1 &&
        plain->GetTurnedOverAfter() == -1 && plain->GetNewIntersectionsBefore() == -1 &&
        plain->GetNewIntersectionsAfter() == -1,
      "without it nothing should be counted");
    check(std::string(plain->GetFoldSummary()).empty() &&
        Contains(guarded->GetFoldSummary(), "nothing turned over"),
      std::string("without folds there is nothing to tell: ") + guarded->GetFoldSummary());
  }
}

/// A head with eyes in it, which slide as it becomes round: that takes nothing.
void RestIntersections(Checker& check)
{
  check.About("intersections of the input");
  const Surface eye = MakeEllipsoid({ 0.25, 0.25, 0.25 }, Faces::Triangles, 30, 29);
  const Surface model = Together({ MakeEllipsoid({ 1.0, 1.4, 0.8 }, Faces::Triangles, 60, 59),
    Shifted(eye, { 0.4, 0.3, 0.6 }), Shifted(eye, { -0.4, 0.3, 0.6 }) });
  WatchedMetrics rest(model);
  check(rest["SelfIntersectionPairs"] > 0, "the input should intersect itself");
  WatchedFilter guarded(model);
  guarded->AvoidSelfIntersectionsOn();
  vtkDataArray* remaining = PointArray(guarded.Output(), "RemainingRoundness");
  WatchedMetrics after(guarded.Output(), model);
  check(after["NewSelfIntersectionPairs"] > 0, "other triangles should intersect");
  check(guarded.Errors.empty() && guarded.Warnings.empty() &&
      guarded->GetNewIntersectionsBefore() == 0 && remaining && remaining->GetRange()[0] == 1.0,
    "eyes may slide" + Joined(guarded.Warnings));
}

/// Weights whose energy has no minimum fold whatever lambda is: a warning, and still nothing is
/// left.
void LastResort(Checker& check, int argc, char* argv[])
{
  check.About("last resort");
  const Surface model = ReadModel(argc, argv, "tangram-prism.vtp");
  WatchedFilter guarded(model);
  SetUp(guarded.Get());
  guarded->SetRoundness(0.1);
  guarded->SetEdgeWeightingToFullEdge();
  vtkPolyData* output = guarded.Output();
  int told = 0;
  for (const std::string& warning : guarded.Warnings)
  {
    told += Contains(warning, "moved back toward the input");
  }
  check(guarded.Errors.empty() && told == 1, "one warning should say so");
  check(guarded->GetNewIntersectionsBefore() > 0, "unguarded it should fold");
  WatchedMetrics after(output, model);
  after.Expect(check, "TurnedOver", 0);
  after.Expect(check, "NewSelfIntersectionPairs", 0);
  check(guarded->GetTurnedOverAfter() == 0 && guarded->GetNewIntersectionsAfter() == 0, "counts");
}

/// Any number of threads and any execution: the same bits.
void Deterministic(Checker& check, const char* about, const Change& change)
{
  check.About(std::string("threads, ") + about);
  const Surface model = Dumbbell();
  WatchedFilter one(model);
  SetUp(one.Get());
  change(one.Get());
  one->SetRoundness(5.0);
  one->SetNumberOfThreads(1);
  WatchedFilter three(model);
  SetUp(three.Get());
  change(three.Get());
  three->SetRoundness(5.0);
  three->SetNumberOfThreads(3);
  check(SamePolyData(one.Output(), three.Output()), "one and three threads: the same bits");
  three->Modified();
  check(SamePolyData(one.Output(), three.Output()), "again: the same bits");
  three->SetRoundness(0.1);
  three.Output();
  three->SetRoundness(5.0);
  check(SamePolyData(one.Output(), three.Output()), "after another roundness: the same bits");
}

void Aborts(Checker& check)
{
  check.About("abort");
  const Surface model = Dumbbell();
  double highest = 0.0;
  bool rises = true;
  for (const double at : { 0.15, 0.5, 0.7, 2.0 })
  {
    vtkNew<vtkSphericalStyleFilter> filter;
    SetUp(filter);
    filter->SetInputData(model);
    highest = 0.0;
    vtkNew<vtkCallbackCommand> watch;
    std::pair<double, double*> data = { at, &highest };
    watch->SetClientData(&data);
    watch->SetCallback(
      [](vtkObject* caller, unsigned long, void* client, void*)
      {
        auto* self = static_cast<vtkSphericalStyleFilter*>(caller);
        auto* limits = static_cast<std::pair<double, double*>*>(client);
        *limits->second = std::max(*limits->second, self->GetProgress());
        if (self->GetProgress() >= limits->first && self->GetProgress() < 1.0)
        {
          self->AbortExecuteOn();
        }
      });
    filter->AddObserver(vtkCommand::ProgressEvent, watch);
    filter->Update();
    rises = rises && highest >= std::min(at, 0.9);
    check(at > 1.0 ? filter->GetTurnedOverAfter() == 0 : filter->GetTurnedOverAfter() == -1,
      "an aborted run should claim nothing, at " + vtkVariant(at).ToString());
  }
  check(rises, "progress should go on over all solves");
}

/// The hand of the bear is in its cheek. Limbs get room by moving less as a whole: the bear stays
/// as round and bends less than without the guard.
void LimbsStayWhole(Checker& check, int argc, char* argv[])
{
  check.About("a bear");
  const Surface bear = ReadModel(argc, argv, "creature.vtp");
  for (const double roundness : { 1.0, 2.0 })
  {
    WatchedDefaults filter(bear);
    filter->SetRoundness(roundness);
    const Surface plain = Mapped(filter.Output(), [](const Vector& x) { return x; });
    filter->AvoidSelfIntersectionsOn();
    WatchedMetrics before(plain, bear);
    WatchedMetrics after(filter.Output(), bear);
    check(before["NewSelfIntersectionPairs"] > 100, "unguarded it should fold");
    after.Expect(check, "NewSelfIntersectionPairs", 0);
    check(after["DihedralChange"] < before["DihedralChange"],
      "edges bend by " + vtkVariant(after["DihedralChange"]).ToString() + " degrees");
    check(after["Sphericity"] > 0.98 * before["Sphericity"],
      "sphericity " + vtkVariant(after["Sphericity"]).ToString());
    check(after["SmallestThicknessRatio"] > before["SmallestThicknessRatio"], "nothing is thinner");
    check(std::string(filter->GetAdvice()).empty(), filter->GetAdvice());
  }
}

/// Where hardly anything may become round, a warning says so.
void LittleIsLeft(Checker& check, int argc, char* argv[])
{
  check.About("a prism");
  WatchedFilter filter(ReadModel(argc, argv, "tangram-prism.vtp"));
  SetUp(filter.Get());
  filter.Output();
  check(filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "leaves 5 % of Roun"),
    Joined(filter.Warnings));
}

/// A part that shares no edge with the rest keeps about as much as its surroundings.
void LoosePartsStay(Checker& check, int argc, char* argv[])
{
  check.About("a car");
  WatchedDefaults filter(ReadModel(argc, argv, "car.vtp"));
  filter->AvoidSelfIntersectionsOn();
  vtkPolyData* output = filter.Output();
  vtkDataArray* remaining = PointArray(output, "RemainingRoundness");
  const double* range = remaining->GetRange();
  check(range[1] < 8.0 * range[0], // three octaves, and more than a diagonal long
    "from " + vtkVariant(range[0]).ToString() + " to " + vtkVariant(range[1]).ToString());
}
#endif

void Refusals(Checker& check)
{
  check.About("refusals");
  const Surface model = MakeEllipsoid({ 1.0, 0.7, 0.5 });
  WatchedFilter thesis(model);
  SetUp(thesis.Get());
  thesis->ReproduceThesisOn();
  WatchedFilter plain(model);
  SetUp(plain.Get());
  plain->ReproduceThesisOn();
  plain->AvoidSelfIntersectionsOff();
  check(SamePolyData(thesis.Output(), plain.Output()) && thesis.Errors.empty(),
    "ReproduceThesis should override it");

  WatchedFilter empty(MakeSurface({}, {}));
  SetUp(empty.Get());
  check(empty.Output()->GetNumberOfPoints() == 0 && empty.Errors.empty(), "empty stays empty");

#ifndef SPHERICALSTYLE_WITH_CGAL
  WatchedFilter without(model);
  SetUp(without.Get());
  without.Output();
  check(without.Errors.size() == 1 && Contains(without.Errors.front(), "without it"),
    "an error should say that there is no CGAL");
#endif
}
}

int TestSphericalStyleFilterFoldGuard(int argc, char* argv[])
{
  Checker check;
  Refusals(check);
#ifdef SPHERICALSTYLE_WITH_CGAL
  NothingIsLeft(check, argc, argv);
  RemainingRoundness(check);
  CleanModels(check, argc, argv);
  RestIntersections(check);
  LastResort(check, argc, argv);
  Deterministic(check, "energy", [](vtkSphericalStyleFilter*) {});
  Deterministic(check, "defaults", Defaults);
  Aborts(check);
  LimbsStayWhole(check, argc, argv);
  LittleIsLeft(check, argc, argv);
  LoosePartsStay(check, argc, argv);
#else
  (void)argc;
  (void)argv;
#endif
  return check.Result();
}
