// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The class for study: with its defaults, and with ReproduceThesis, it is the main filter; each of
/// its own properties changes something.
#include "FilterTesting.h"
#include "PropertyTesting.h"

#include <functional>
#include <sstream>

using namespace FilterTesting;

namespace
{
using Main = Watched<vtkSphericalStyleFilter>;
using Change = std::function<void(vtkThesisStyleFilter*)>;

void Properties(Checker& check)
{
  check.About("properties");
  WatchedFilter filter;
  using FilterType = vtkThesisStyleFilter;
  RoundTrip(ConcaveEdges, 0, 2);
  OnOff(Acceleration, true);
  RoundTrip(Anchor, 0, 1);
  RoundTrip(ComponentCoupling, 0, 1);
  RoundTrip(InitialGuess, 0, 1);
  OnOff(WeldCoincidentPoints, true);
  OnOff(GenerateCellEnergy, false);
  Clamped(ConcaveEdges, 3, 2);
  Clamped(InitialGuess, 2, 1);
  Mode(ConcaveEdges, Keep, KEEP, 0);
  Mode(ConcaveEdges, Flip, FLIP, 1);
  Mode(ConcaveEdges, Zero, ZERO, 2);
  Mode(Anchor, Centroid, CENTROID, 0);
  Mode(Anchor, LastPoint, LAST_POINT, 1);
  Mode(ComponentCoupling, Stitched, STITCHED, 0);
  Mode(ComponentCoupling, Independent, INDEPENDENT, 1);
  Mode(InitialGuess, Blend, BLEND, 0);
  Mode(InitialGuess, Rest, REST, 1);
  std::ostringstream printed;
  filter->Print(printed);
  for (const char* name : { "ConcaveEdges", "Acceleration", "Anchor", "ComponentCoupling",
         "InitialGuess", "WeldCoincidentPoints", "GenerateCellEnergy", "Roundness" })
  {
    check(Contains(printed.str(), std::string(" ") + name + ": "),
      std::string("PrintSelf should print ") + name);
  }
}

/// @param set  what both have
void SameAsMain(Checker& check, vtkPolyData* model, const char* about,
  const std::function<void(vtkSphericalStyleFilter*)>& set, const Change& change, bool same)
{
  check.About(about);
  Main main(model);
  set(main.Get());
  WatchedFilter thesis(model);
  set(thesis.Get());
  change(thesis.Get());
  check(SamePoints(main.Output(), thesis.Output()) == same,
    same ? "it should be the main filter" : "the property should matter");
  check(main.Errors.empty() && thesis.Errors.empty(), "there should be no error");
}
}

int TestThesisStyleFilter(int argc, char* argv[])
{
  const Surface stone = ReadModel(argc, argv, "stone-house.vtp");
  Checker check;
  Properties(check);
  using F = vtkThesisStyleFilter;
  const auto none = [](F*) {};
  const auto uniform = [](vtkSphericalStyleFilter* f) { SetUpUniform(f); };
  const auto reproduce = [](vtkSphericalStyleFilter* f)
  {
    f->ReproduceThesisOn();
    f->SetMaximumNumberOfIterations(5);
  };
  const auto all = [](F* f)
  {
    f->SetConcaveEdgesToKeep();
    f->AccelerationOff();
    f->SetAnchorToLastPoint();
    f->SetComponentCouplingToIndependent();
    f->SetInitialGuessToRest();
  };
  SameAsMain(check, stone, "defaults", SetUpDefaults, none, true);
  SameAsMain(check, stone, "defaults, uniform weights", uniform, none, true);
  SameAsMain(check, stone, "the thesis", reproduce, all, true);
  SameAsMain(
    check, stone, "Anchor", uniform, [](F* f) { f->SetAnchorToLastPoint(); }, false);
  SameAsMain(
    check, stone, "InitialGuess", uniform, [](F* f) { f->SetInitialGuessToRest(); }, false);
  SameAsMain(
    check, stone, "Acceleration", uniform, [](F* f) { f->AccelerationOff(); }, false);
  SameAsMain(
    check, stone, "ConcaveEdges",
    [](vtkSphericalStyleFilter* f)
    {
      SetUpUniform(f);
      f->SetNormalBlend(1.0);
    },
    [](F* f) { f->SetConcaveEdgesToFlip(); }, false);
  return check.Result();
}
