// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Properties change and change back while a filter keeps what it can for the next execution: each
/// result is that of a new filter with the same properties, all outputs to the bit.
#include "FaultTesting.h"

using namespace FilterTesting;

namespace
{
template <typename Filter>
struct Change
{
  const char* name;
  std::function<void(Filter*)> set;
};

/// @param prepare  what both filters begin with
template <typename Filter>
void CheckChanges(Checker& check, const std::string& about, vtkPolyData* input,
  const std::function<void(Filter*)>& prepare, const std::vector<Change<Filter>>& changes)
{
  const auto make = [&](Watched<Filter>& filter)
  {
    filter->SetInputData(input);
    prepare(filter.Get());
  };
  Watched<Filter> kept;
  make(kept);
  kept->Update();
  auto before = AllOutputs(kept.Get());
  for (std::size_t k = 0; k < changes.size(); ++k)
  {
    check.About(about + ", " + changes[k].name);
    changes[k].set(kept.Get());
    kept->Update();
    check(kept.Errors.empty(), "there should be no error" + Joined(kept.Errors));
    check(kept.Starts.size() == k + 2, "should execute once more");
    Watched<Filter> fresh;
    make(fresh);
    for (std::size_t i = 0; i <= k; ++i)
    {
      changes[i].set(fresh.Get());
    }
    fresh->Update();
    const auto outputs = AllOutputs(kept.Get());
    check(SameOutputs(outputs, AllOutputs(fresh.Get())), "should give what a new filter gives");
    check(!SameOutputs(outputs, before), "should change something, or this test is none");
    before = outputs;
  }
}

/// The surface cut in two that lie at one place, so that welding matters, and again beside it, so
/// that coupling does.
Surface WithSeamAndPart(vtkPolyData* surface)
{
  Surface parts[2];
  for (int k = 0; k < 2; ++k)
  {
    parts[k] = Surface::New();
    parts[k]->SetPoints(surface->GetPoints());
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkIdList> ids;
    for (vtkIdType i = 0; i < surface->GetNumberOfPolys(); ++i)
    {
      surface->GetPolys()->GetCellAtId(i, ids);
      if ((i < surface->GetNumberOfPolys() / 2) == (k == 0))
      {
        cells->InsertNextCell(ids);
      }
    }
    parts[k]->SetPolys(cells);
  }
  return Together({ parts[0], parts[1], Shifted(surface, { 0.9, 0.0, 0.0 }) });
}

using Main = vtkThesisStyleFilter;

/// Arrays to choose from, none of them active.
Surface WithArrays(vtkPolyData* surface)
{
  auto copy = Surface::New();
  copy->DeepCopy(surface);
  const auto add = [&](const char* name, int components, auto value)
  {
    copy->GetPointData()->AddArray(MakeArray(name, surface, components,
      [&](vtkIdType i, int k) { return value(PointOf(surface, i), k); }));
  };
  add("leaning", 3, [](const Vector& x, int k) { return x[k] + (k == 0 ? 0.4 : 0.0); });
  add("factor", 1, [](const Vector& x, int) { return 1.0 + 0.4 * x[2]; });
  add("blend", 1, [](const Vector& x, int) { return x[2] > 0.0 ? 0.9 : 0.2; });
  add("targets", 3, [](const Vector& x, int k) { return 0.5 * x[(k + 1) % 3]; });
  add("region", 1, [](const Vector& x, int) { return x[2] > -0.8 ? 1.0 : 0.0; });
  add("part", 1, [](const Vector& x, int) { return x[2] > 0.1 ? 3.0 : 8.0; });
  return copy;
}

std::function<void(Main*)> Choose(int index, const char* name)
{
  return [=](Main* f) { f->SetInputArrayToProcess(index, 0, 0, OfPoints, name); };
}

/// What the closed form keeps: the grid, the base, its normals, the thickness, shares of centers.
void ClosedForm(Checker& check, vtkPolyData* input)
{
  const auto begin = [](Main* f)
  {
    SetUpDefaults(f);
    f->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    f->GenerateRotationOn();
  };
  CheckChanges<Main>(check, "closed form", input, begin,
    { { "less roundness", [](Main* f) { f->SetRoundness(0.4); } },
      { "no normals", [](Main* f) { f->SetNormalBlend(0.0); } },
      { "more normals", [](Main* f) { f->SetNormalBlend(0.8); } },
      { "radius of the whole model", [](Main* f) { f->SetNormalRadiusToWholeModel(); } },
      { "finer details", [](Main* f) { f->SetDetailSize(0.03); } },
      { "radius of each limb", [](Main* f) { f->SetNormalRadiusToOwnThickness(); } },
      { "symmetric", [](Main* f) { f->SetSymmetryToAutomatic(); } },
      { "symmetric across x", [](Main* f) { f->SetSymmetryToX(); } },
      { "symmetric across z", [](Main* f) { f->SetSymmetryToZ(); } },
      { "not symmetric", [](Main* f) { f->SetSymmetryToOff(); } },
      { "a box as the target", [](Main* f) { f->SetTargetToRoundedBox(); } },
      { "sharper edges of it", [](Main* f) { f->SetTargetEdges(0.1); } },
      { "other lengths of it", [](Main* f) { f->SetTargetLengths(3.0, 1.0, 1.0); } },
      { "those of the model", [](Main* f) { f->SetTargetLengths(0.0, 0.0, 0.0); } },
      { "the sphere", [](Main* f) { f->SetTargetToSphere(); } },
      { "no details", [](Main* f) { f->SetDetailSize(0.0); } },
      { "given normals", Choose(0, "leaning") },
      { "computed normals",
        [](Main* f)
        { f->SetInputArrayToProcess(0, 0, 0, OfPoints, vtkDataSetAttributes::NORMALS); } },
      { "details", [](Main* f) { f->SetDetailSize(0.06); } },
      { "another center",
        [](Main* f)
        {
          f->SetCenterModeToCustom();
          f->SetCenter(0.1, 0.2, 0.3);
        } },
      { "a third center", [](Main* f) { f->SetCenter(0.3, 0.0, -0.2); } },
      { "mean of the points", [](Main* f) { f->SetCenterModeToPointMean(); } },
      { "another radius",
        [](Main* f)
        {
          f->SetKeepSizeToOff(); // or only the details tell
          f->SetRadiusModeToCustom();
          f->SetRadius(2.0);
        } },
      { "a third radius", [](Main* f) { f->SetRadius(0.7); } },
      { "radius of the volume", [](Main* f) { f->SetRadiusModeToEqualVolume(); } },
      { "radius of the area", [](Main* f) { f->SetRadiusModeToEqualArea(); } },
      { "centroid of the area", [](Main* f) { f->SetCenterModeToAreaCentroid(); } },
      { "last point", [](Main* f) { f->SetAnchorToLastPoint(); } },
      { "centroid", [](Main* f) { f->SetAnchorToCentroid(); } },
      { "single precision",
        [](Main* f) { f->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION); } },
      { "as it comes",
        [](Main* f) { f->SetOutputPointsPrecision(vtkAlgorithm::DEFAULT_PRECISION); } } });
}

/// Size and ground, in closed form and after an energy.
void Sizes(Checker& check, vtkPolyData* input)
{
  const std::pair<const char*, std::function<void(Main*)>> methods[] = {
    { "size", [](Main* f) { SetUpDefaults(f); } },
    { "size, without details",
      [](Main* f)
      {
        SetUpDefaults(f);
        f->SetDetailSize(0.0);
      } },
    { "size, after an energy",
      [](Main* f)
      {
        SetUpDefaults(f);
        f->SetSphericalWeightingToUniform();
        f->SetMaximumNumberOfIterations(5);
      } },
    { "size, after an energy without details",
      [](Main* f)
      {
        SetUpUniform(f);
        f->SetMaximumNumberOfIterations(5);
        f->SetKeepSizeToArea();
        f->GenerateRotationOn();
      } }
  };
  for (const auto& [about, begin] : methods)
  {
    CheckChanges<Main>(check, about, input, begin,
      { { "none", [](Main* f) { f->SetKeepSizeToOff(); } },
        { "volume", [](Main* f) { f->SetKeepSizeToVolume(); } },
        { "extent along y", [](Main* f) { f->SetKeepSizeToExtent(); } },
        { "extent along x", [](Main* f) { f->SetUpAxisToX(); } },
        { "extent along z", [](Main* f) { f->SetUpAxisToZ(); } },
        { "area", [](Main* f) { f->SetKeepSizeToArea(); } },
        { "on the ground at z", [](Main* f) { f->KeepOnGroundOn(); } },
        { "on the ground at x", [](Main* f) { f->SetUpAxisToX(); } },
        { "on the ground at y", [](Main* f) { f->SetUpAxisToY(); } },
        { "neither size nor ground",
          [](Main* f)
          {
            f->SetKeepSizeToOff();
            f->KeepOnGroundOff();
          } } });
  }
}

/// Arrays, regions and several centers.
void Arrays(Checker& check, vtkPolyData* input)
{
  CheckChanges<Main>(check, "arrays", WithArrays(input), SetUpDefaults,
    { { "factors", Choose(1, "factor") }, { "blends", Choose(2, "blend") },
      { "targets", Choose(3, "targets") }, { "no targets", Choose(3, "") },
      { "no blends", Choose(2, "") }, { "no factors", Choose(1, "") },
      { "a region", Choose(4, "region") }, { "a crease", [](Main* f) { f->SetBorderWidth(0.0); } },
      { "sphere of the whole model", [](Main* f) { f->SetSphereOfToWholeModel(); } },
      { "no size in the region", [](Main* f) { f->SetKeepSizeToOff(); } },
      { "no region", Choose(4, "") }, { "two centers", Choose(5, "part") },
      { "a wide blend", [](Main* f) { f->SetCenterBlendWidth(0.2); } },
      { "a sharp blend", [](Main* f) { f->SetCenterBlendWidth(0.0); } },
      { "a region with two centers", Choose(4, "region") }, { "one center", Choose(5, "") } });
}

/// What minimizing an energy keeps: factor, pulls, weights, and what details on it keep.
void Energy(Checker& check, vtkPolyData* input)
{
  const auto begin = [](Main* f)
  {
    SetUpEnergy(f);
    f->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    f->SetInitialGuessToRest();
    f->SetStopRuleToFixedIterations();
    f->SetMaximumNumberOfIterations(8);
    f->SetDetailSize(0.05);
    f->GenerateRotationOn();
    f->GenerateCellEnergyOn();
    f->TransformAllInputVectorsOn();
  };
  CheckChanges<Main>(check, "energy", input, begin,
    { { "another roundness", [](Main* f) { f->SetRoundness(3.0); } },
      { "full-edge weights", [](Main* f) { f->SetEdgeWeightingToFullEdge(); } },
      { "Delaunay weights", [](Main* f) { f->SetEdgeWeightingToIntrinsicDelaunay(); } },
      { "half-edge weights", [](Main* f) { f->SetEdgeWeightingToHalfEdge(); } },
      { "another center",
        [](Main* f)
        {
          f->SetCenterModeToCustom();
          f->SetCenter(0.1, 0.2, 0.3);
        } },
      { "no details", [](Main* f) { f->SetDetailSize(0.0); } },
      { "other details", [](Main* f) { f->SetDetailSize(0.08); } },
      { "normals", [](Main* f) { f->SetNormalBlend(0.6); } },
      { "thickness of limbs", [](Main* f) { f->SetNormalRadiusToOwnThickness(); } },
      { "thickness of limbs without details", [](Main* f) { f->SetDetailSize(0.0); } },
      { "hollows turned", [](Main* f) { f->SetConcaveEdgesToFlip(); } },
      { "hollows without targets", [](Main* f) { f->SetConcaveEdgesToZero(); } },
      { "hollows as they are", [](Main* f) { f->SetConcaveEdgesToKeep(); } },
      { "uniform weights", [](Main* f) { f->SetSphericalWeightingToUniform(); } },
      { "fewer iterations", [](Main* f) { f->SetMaximumNumberOfIterations(3); } },
      { "another radius",
        [](Main* f)
        {
          f->SetRadiusModeToCustom();
          f->SetRadius(2.0);
        } },
      { "from the blend", [](Main* f) { f->SetInitialGuessToBlend(); } },
      { "to convergence",
        [](Main* f)
        {
          f->SetStopRuleToConverged();
          f->SetMaximumNumberOfIterations(500);
        } },
      { "nearer", [](Main* f) { f->SetTolerance(1e-8); } },
      { "no acceleration", [](Main* f) { f->AccelerationOff(); } },
      { "rule of the thesis", [](Main* f) { f->SetStopRuleToThesis(); } },
      { "in closed form", [](Main* f) { f->SetSphericalWeightingToCotangent(); } },
      { "from rest", [](Main* f) { f->SetInitialGuessToRest(); } } });
}

/// Rows of handles: the factor of the same points is kept, and no result shows what was before.
void HandleRows(Checker& check, vtkPolyData* input)
{
  using Handles = vtkHandleDeformFilter;
  const auto low = [](double radius, double turn)
  {
    const std::array<double, 10> row = { 0, 0, -2, radius, 0, 0, -2, turn, 0, 0 };
    return row;
  };
  const auto high = [](double radius, double lift, double turn)
  {
    const std::array<double, 10> row = { 0, 0, 2, radius, 0.1, 0, 2 + lift, 0, 0, turn };
    return row;
  };
  const auto begin = [=](Handles* f)
  {
    f->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    f->AddHandle(low(0.4, 0.0).data());
    f->AddHandle(high(0.4, 0.3, 0.0).data());
  };
  const auto set = [](int number, const std::array<double, 10>& row)
  { return [=](Handles* f) { f->SetHandle(number, row.data()); }; };
  CheckChanges<Handles>(check, "handles", input, begin,
    { { "dragged", set(2, high(0.4, 0.6, 0.0)) }, { "turned", set(2, high(0.4, 0.6, 90.0)) },
      { "both moved", set(1, low(0.4, 30.0)) }, { "more points", set(1, low(0.6, 30.0)) },
      { "fewer points", set(2, high(0.2, 0.6, 90.0)) },
      { "parts apart", [](Handles* f) { f->SetComponentCouplingToIndependent(); } },
      { "parts together", [](Handles* f) { f->SetComponentCouplingToStitched(); } },
      { "nearer", [](Handles* f) { f->SetTolerance(1e-8); } },
      { "one handle",
        [=](Handles* f)
        {
          f->RemoveAllHandles();
          f->AddHandle(high(0.2, 0.6, 90.0).data());
        } },
      { "none", [](Handles* f) { f->RemoveAllHandles(); } }, { "two again", begin } });
}

/// What decides about the mesh, the method and the result.
void MethodsInTurn(Checker& check, vtkPolyData* input)
{
  const auto begin = [](Main* f)
  {
    SetUpUniform(f);
    f->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    f->SetMaximumNumberOfIterations(10);
    f->SetNormalBlend(0.3);
    f->SetRoundness(2.0);
  };
  CheckChanges<Main>(check, "methods in turn", input, begin,
    { { "the thesis", [](Main* f) { f->ReproduceThesisOn(); } },
      { "not the thesis", [](Main* f) { f->ReproduceThesisOff(); } },
      { "seams open", [](Main* f) { f->WeldCoincidentPointsOff(); } },
      { "parts apart", [](Main* f) { f->SetComponentCouplingToIndependent(); } },
      { "seams shut", [](Main* f) { f->WeldCoincidentPointsOn(); } },
      { "parts together", [](Main* f) { f->SetComponentCouplingToStitched(); } },
      { "long edges split",
        [](Main* f)
        {
          f->SetRefineLongEdgesToOn();
          f->SetMaximumEdgeLength(0.08);
        } },
      { "long edges as they are", [](Main* f) { f->SetRefineLongEdgesToOff(); } },
#ifdef SPHERICALSTYLE_WITH_CGAL
      { "without folds",
        [](Main* f)
        {
          f->AvoidSelfIntersectionsOn();
          f->SetNormalBlend(1.0);
        } },
      { "with folds", [](Main* f) { f->AvoidSelfIntersectionsOff(); } },
#endif
      { "in closed form", [](Main* f) { f->SetSphericalWeightingToCotangent(); } },
      { "in closed form, seams open", [](Main* f) { f->WeldCoincidentPointsOff(); } },
      { "in closed form, seams shut", [](Main* f) { f->WeldCoincidentPointsOn(); } },
      { "in closed form, the thesis", [](Main* f) { f->ReproduceThesisOn(); } },
      { "in closed form, not the thesis", [](Main* f) { f->ReproduceThesisOff(); } },
      { "details",
        [](Main* f)
        {
          f->SetDetailSize(0.04);
          f->SetNormalBlend(0.3);
        } },
#ifdef SPHERICALSTYLE_WITH_CGAL
      { "details without folds",
        [](Main* f)
        {
          f->AvoidSelfIntersectionsOn();
          f->SetNormalBlend(1.0);
        } },
      { "details with folds", [](Main* f) { f->AvoidSelfIntersectionsOff(); } },
#endif
      { "other arrays",
        [](Main* f)
        {
          f->GenerateNormalsOn();
          f->GenerateDisplacementOff();
        } } });
}

/// A surface that is coarse enough for Automatic.
void LongEdges(Checker& check)
{
  const Surface coarse = MakeEllipsoid({ 1.0, 0.8, 2.0 }, Faces::Triangles, 8, 5);
  CheckChanges<Main>(check, "long edges", coarse, [](Main*) {},
    { { "as they are", [](Main* f) { f->SetRefineLongEdgesToOff(); } },
      { "shorter",
        [](Main* f)
        {
          f->SetRefineLongEdgesToOn();
          f->SetMaximumEdgeLength(0.08);
        } },
      { "as they are again", [](Main* f) { f->SetRefineLongEdgesToOff(); } },
      { "where they are coarse", [](Main* f) { f->SetRefineLongEdgesToAutomatic(); } },
      { "shorter where they are coarse", [](Main* f) { f->SetMaximumEdgeLength(0.05); } },
      { "as the thesis has them", [](Main* f) { f->ReproduceThesisOn(); } } });
}

/// Filters that measure the surface, or make it anew.
void Companions(Checker& check, vtkPolyData* input)
{
  using Metrics = vtkSurfaceMetrics;
  CheckChanges<Metrics>(check, "vtkSurfaceMetrics", WithSeamAndPart(input), [](Metrics*) {},
    { { "a reference",
        [input](Metrics* f) { f->SetReferenceData(WithSeamAndPart(Shifted(input, {}))); } },
      { "condition", [](Metrics* f) { f->EstimateConditionOn(); } },
      { "of another system", [](Metrics* f) { f->SetRoundness(3.0); } },
      { "seams open", [](Metrics* f) { f->WeldCoincidentPointsOff(); } },
      { "seams shut", [](Metrics* f) { f->WeldCoincidentPointsOn(); } },
      { "another center", [](Metrics* f) { f->SetCenterModeToAreaCentroid(); } },
      { "less of it",
        [](Metrics* f)
        {
          f->MeasureThicknessOff();
          f->EstimateConditionOff();
        } } });
  using Parts = vtkSurfacePartsFilter;
  CheckChanges<Parts>(check, "vtkSurfacePartsFilter", WithArrays(input), [](Parts*) {},
    { { "by connectivity", [](Parts* f) { f->SetMethodToConnectivity(); } },
      { "by shape", [](Parts* f) { f->SetMethodToShape(); } },
      { "three", [](Parts* f) { f->SetNumberOfParts(3); } },
      { "by an array",
        [](Parts* f)
        {
          f->SetMethodToArray();
          f->SetInputArrayToProcess(0, 0, 0, OfPoints, "part");
        } },
      { "by another array",
        [](Parts* f) { f->SetInputArrayToProcess(0, 0, 0, OfPoints, "region"); } } });
  using Sizes = vtkPartSizesFilter;
  CheckChanges<Sizes>(check, "vtkPartSizesFilter",
    WithArrays(Together({ input, Shifted(input, { 0.3, 0.2, 2.5 }) })),
    [](Sizes* f) { f->SetPartSize(0, 1.3); },
    { { "another part", [](Sizes* f) { f->SetPartSize(1, 0.8); } },
      { "roundness", [](Sizes* f) { f->SetPartRoundness(1, 0.5); } },
      { "wider", [](Sizes* f) { f->SetBlendWidth(0.2); } },
      { "on the ground", [](Sizes* f) { f->KeepOnGroundOn(); } },
      { "an array",
        [](Sizes* f)
        {
          f->SetInputArrayToProcess(0, 0, 0, OfPoints, "part");
          f->RemoveAllPartSizes();
          f->SetPartSize(8, 1.2);
          f->SetPartRoundness(8, 0.5);
        } },
      { "along z", [](Sizes* f) { f->SetUpAxisToZ(); } },
      { "head", [](Sizes* f) { f->SetHeadHeight(0.8); } },
      { "parts of its own",
        [](Sizes* f)
        {
          f->SetInputArrayToProcess(0, 0, 0, OfPoints, "");
          f->SetHeadHeight(0.0);
        } },
      { "sizes", [](Sizes* f) { f->SetPartSize(0, 1.3); } } });
#ifdef SPHERICALSTYLE_WITH_CGAL
  using Printable = vtkPrintableFilter;
  CheckChanges<Printable>(check, "vtkPrintableFilter", input, [](Printable*) {},
    { { "larger foot", [](Printable* f) { f->SetFootArea(0.1); } },
      { "no foot",
        [](Printable* f)
        {
          f->SetFootArea(0.0);
          f->SetStabilityAngle(0.0);
        } },
      { "walls", [](Printable* f) { f->SetMinimumThickness(1.7); } },
      { "volume", [](Printable* f) { f->SetVolume(3.0); } },
      { "height",
        [](Printable* f)
        {
          f->SetVolume(0.0);
          f->SetHeight(3.0);
        } },
      { "thinner walls", [](Printable* f) { f->SetMinimumThickness(0.0); } },
      { "along z", [](Printable* f) { f->SetUpAxisToZ(); } },
      { "on the plate", [](Printable* f) { f->PlaceOnPlateOn(); } },
      { "a foot again", [](Printable* f) { f->SetFootArea(0.05); } },
      { "stable", [](Printable* f) { f->SetStabilityAngle(30.0); } } });
#endif
}

/// Filters with an energy of their own.
void OtherEnergies(Checker& check, vtkPolyData* input)
{
  using Block = vtkBlockStyleFilter;
  CheckChanges<Block>(check, "vtkBlockStyleFilter", input,
    [](Block* f) { f->SetMaximumNumberOfIterations(2); },
    { { "more", [](Block* f) { f->SetBlockiness(3.0); } },
      { "longer", [](Block* f) { f->SetMaximumNumberOfIterations(4); } },
      { "less", [](Block* f) { f->SetBlockiness(0.1); } } });
  using Nonlinear = vtkNonlinearStyleFilter;
  CheckChanges<Nonlinear>(check, "vtkNonlinearStyleFilter", input,
    [](Nonlinear* f)
    {
      f->SetStopRuleToFixedIterations();
      f->SetMaximumNumberOfIterations(4);
    },
    { { "more", [](Nonlinear* f) { f->SetRoundness(2.0); } },
      { "longer", [](Nonlinear* f) { f->SetMaximumNumberOfIterations(6); } },
      { "as written", [](Nonlinear* f) { f->SetCenterConstraintToAsWritten(); } },
      { "corrected", [](Nonlinear* f) { f->SetCenterConstraintToCorrected(); } },
      { "another center", [](Nonlinear* f) { f->SetCenterModeToPointMean(); } },
      { "energies", [](Nonlinear* f) { f->GenerateCellEnergyOn(); } },
      { "the thesis", [](Nonlinear* f) { f->ReproduceThesisOn(); } },
      { "not the thesis", [](Nonlinear* f) { f->ReproduceThesisOff(); } } });
}

void OtherFilters(Checker& check, vtkPolyData* input)
{
  using Cubic = vtkCubicStyleFilter;
  CheckChanges<Cubic>(check, "vtkCubicStyleFilter", input,
    [](Cubic* f) { f->SetMaximumNumberOfIterations(6); },
    { { "more", [](Cubic* f) { f->SetCubeness(1.5); } },
      { "longer", [](Cubic* f) { f->SetMaximumNumberOfIterations(9); } },
      { "less", [](Cubic* f) { f->SetCubeness(0.1); } } });
  using Analogy = vtkNormalAnalogyFilter;
  CheckChanges<Analogy>(check, "vtkNormalAnalogyFilter", input,
    [](Analogy* f) { f->SetMaximumNumberOfIterations(6); },
    { { "more", [](Analogy* f) { f->SetWeight(3.0); } },
      { "another shape", [](Analogy* f) { f->SetStyle((f->GetStyle() + 1) % 3); } },
      { "less", [](Analogy* f) { f->SetWeight(0.3); } } });
  using Projection = vtkSphereProjectionFilter;
  CheckChanges<Projection>(check, "vtkSphereProjectionFilter", input, [](Projection*) {},
    { { "less", [](Projection* f) { f->SetCoefficient(0.3); } },
      { "another center",
        [](Projection* f)
        {
          f->SetCenterModeToCustom();
          f->SetCenter(0.2, 0.0, 0.1);
        } } });
  using Map = vtkGaussMapFilter;
  CheckChanges<Map>(check, "vtkGaussMapFilter", input, [](Map*) {},
    { { "of points", [](Map* f) { f->SetNormalSource(Map::POINT_NORMALS); } },
      { "by area", [](Map* f) { f->SetAreaWeighted(!f->GetAreaWeighted()); } },
      { "fewer units", [](Map* f) { f->SetNumberOfEqualAreaUnits(100); } } });
  using Diagnostics = vtkSurfaceDiagnostics;
  CheckChanges<Diagnostics>(check, "vtkSurfaceDiagnostics", input, [](Diagnostics*) {},
    { { "wider slivers", [](Diagnostics* f) { f->SetSliverAngle(40.0); } },
      { "narrower slivers", [](Diagnostics* f) { f->SetSliverAngle(1.0); } } });
#ifdef SPHERICALSTYLE_WITH_CGAL
  using Proxy = vtkConvexProxyDeformFilter;
  const auto choose = [](int index, const char* name)
  { return [=](Proxy* f) { f->SetInputArrayToProcess(index, 0, 0, OfPoints, name); }; };
  CheckChanges<Proxy>(check, "vtkConvexProxyDeformFilter", WithArrays(input),
    [](Proxy* f)
    {
      f->SetNumberOfProxyPoints(200);
      f->SetRefineLongEdgesToOff();
    },
    { { "less round", [](Proxy* f) { f->SetRoundness(0.3); } },
      { "more points", [](Proxy* f) { f->SetNumberOfProxyPoints(300); } },
      { "another mesher", [](Proxy* f) { f->SetProxyMesher((f->GetProxyMesher() + 1) % 4); } },
      { "another projection", [](Proxy* f) { f->SetProjection(Proxy::SMALLEST_ANGLE); } },
      { "given normals", choose(0, "leaning") }, { "other normals", choose(0, "targets") },
      { "along directions",
        [](Proxy* f)
        {
          f->SetInputArrayToProcess(1, 0, 0, OfPoints, "leaning");
          f->SetProjection(Proxy::DIRECTION_ARRAY);
        } },
      { "other directions", choose(1, "targets") },
      { "nearest points, of slivers",
        [](Proxy* f)
        {
          f->SetProxyMesher(Proxy::SUBDIVIDED_HULL);
          f->SetProjection(Proxy::NEAREST_VERTICES);
          f->SetNumberOfNeighbors(1);
        } },
      { "more neighbors", [](Proxy* f) { f->SetNumberOfNeighbors(4); } },
      { "closest points",
        [](Proxy* f)
        {
          f->SetProxyMesher(Proxy::BALL_PIVOTING);
          f->SetProjection(Proxy::CLOSEST_POINT);
        } },
      { "another center",
        [](Proxy* f)
        {
          f->SetCenterMode(Proxy::CUSTOM_CENTER);
          f->SetCenter(0.1, 0.2, 0.3);
        } },
      { "a third center", [](Proxy* f) { f->SetCenter(0.3, 0.0, -0.2); } },
      { "another radius",
        [](Proxy* f)
        {
          f->SetRadiusMode(Proxy::CUSTOM_RADIUS);
          f->SetRadius(1.5);
        } },
      { "a third radius", [](Proxy* f) { f->SetRadius(0.7); } },
      { "offsets", [](Proxy* f) { f->SetTransfer(1 - f->GetTransfer()); } },
      { "the first mesher", [](Proxy* f) { f->SetProxyMesher((f->GetProxyMesher() + 3) % 4); } },
      { "less of it", [](Proxy* f) { f->SetBlend(0.8); } },
      { "long edges split", [](Proxy* f) { f->SetRefineLongEdgesToOn(); } },
      { "long edges as they are", [](Proxy* f) { f->SetRefineLongEdgesToOff(); } },
      { "fewer points", [](Proxy* f) { f->SetNumberOfProxyPoints(150); } } });
#endif
}
}

int TestChangedProperties(int, char*[])
{
  Checker check;
  const Surface ball = MakeBumpyBall(24, 13);
  ClosedForm(check, WithArrays(ball));
  Sizes(check, ball);
  Arrays(check, ball);
  LongEdges(check);
  MethodsInTurn(check, WithSeamAndPart(ball));
  OtherFilters(check, ball);
  OtherEnergies(check, ball);
  Companions(check, ball);
  HandleRows(check, WithSeamAndPart(ball));
  Energy(check, ball);
  return check.Result();
}
