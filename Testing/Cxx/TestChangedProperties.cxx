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
  /// Whether it goes on from the last result: then only what follows is compared.
  bool goesOn = false;
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
    if (changes[k].goesOn)
    {
      continue;
    }
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

using Main = vtkSphericalStyleFilter;

/// What a solve with details keeps: factor, pulls, base, weights, the last shape.
void DetailsKept(Checker& check, vtkPolyData* input)
{
  const auto begin = [](Main* f)
  {
    f->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    f->SetDetailSize(0.05);
    f->SetMaximumNumberOfIterations(40);
    f->GenerateRotationOn();
    f->GenerateCellEnergyOn();
    f->GenerateTargetDirectionOn();
  };
  CheckChanges<Main>(check, "details kept", input, begin,
    { { "conjugate gradients", [](Main* f) { f->SetLinearSolverToConjugateGradients(); } },
      { "another roundness", [](Main* f) { f->SetRoundness(3.0); } },
      { "a factor", [](Main* f) { f->SetLinearSolverToFactor(); } },
      { "single precision", [](Main* f) { f->SetLinearSolverToSinglePrecisionFactor(); } },
      { "full-edge weights", [](Main* f) { f->SetEdgeWeightingToFullEdge(); } },
      { "Delaunay weights", [](Main* f) { f->SetEdgeWeightingToIntrinsicDelaunay(); } },
      { "conjugate gradients again", [](Main* f) { f->SetLinearSolverToConjugateGradients(); } },
      { "half-edge weights", [](Main* f) { f->SetEdgeWeightingToHalfEdge(); } },
      { "a factor again", [](Main* f) { f->SetLinearSolverToFactor(); } },
      { "an iteration in time",
        [](Main* f)
        {
          f->SetTimeBudget(1e-9);
          f->SetInitialGuessToLastResult();
        },
        true },
      { "from the last result", [](Main* f) { f->SetRoundness(0.7); }, true },
      { "in time and from the blend", [](Main* f) { f->SetInitialGuessToBlend(); } },
      { "without end", [](Main* f) { f->SetTimeBudget(0.0); } },
      { "from rest", [](Main* f) { f->SetInitialGuessToRest(); } },
      { "from the last result again", [](Main* f) { f->SetInitialGuessToLastResult(); }, true },
      { "another center from the last result",
        [](Main* f)
        {
          f->SetCenterModeToCustom();
          f->SetCenter(0.1, 0.2, 0.3);
        },
        true },
      { "from the blend", [](Main* f) { f->SetInitialGuessToBlend(); } },
      { "another center", [](Main* f) { f->SetCenter(0.3, 0.0, -0.2); } },
      { "no details", [](Main* f) { f->SetDetailSize(0.0); } },
      { "other details", [](Main* f) { f->SetDetailSize(0.08); } },
      { "normals", [](Main* f) { f->SetNormalBlend(0.6); } },
      { "no acceleration", [](Main* f) { f->AccelerationOff(); } },
      { "uniform weights", [](Main* f) { f->SetSphericalWeightingToUniform(); } },
      { "a number of iterations",
        [](Main* f)
        {
          f->SetStopRuleToFixedIterations();
          f->SetMaximumNumberOfIterations(3);
        } },
      { "another radius",
        [](Main* f)
        {
          f->SetRadiusModeToCustom();
          f->SetRadius(2.0);
        } } });
}

/// What decides about the mesh, the method and the result.
void MethodsInTurn(Checker& check, vtkPolyData* input)
{
  const auto begin = [](Main* f)
  {
    f->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    f->SetMaximumNumberOfIterations(10);
    f->SetNormalBlend(0.3);
    f->SetRoundness(2.0);
  };
  CheckChanges<Main>(check, "methods in turn", input, begin,
    { { "the thesis", [](Main* f) { f->ReproduceThesisOn(); } },
      { "not the thesis", [](Main* f) { f->ReproduceThesisOff(); } },
      { "nonlinear", [](Main* f) { f->SetFeatureToNonlinear(); } },
      { "nonlinear, as written", [](Main* f) { f->SetCenterConstraintToAsWritten(); } },
      { "linear", [](Main* f) { f->SetFeatureToLinear(); } },
      { "seams open", [](Main* f) { f->WeldCoincidentPointsOff(); } },
      { "parts apart", [](Main* f) { f->SetComponentCouplingToIndependent(); } },
      { "seams shut", [](Main* f) { f->WeldCoincidentPointsOn(); } },
      { "parts together", [](Main* f) { f->SetComponentCouplingToStitched(); } },
      { "long edges split",
        [](Main* f)
        {
          f->RefineLongEdgesOn();
          f->SetMaximumEdgeLength(0.08);
        } },
      { "long edges as they are", [](Main* f) { f->RefineLongEdgesOff(); } },
#ifdef SPHERICALSTYLE_WITH_CGAL
      { "without folds",
        [](Main* f)
        {
          f->AvoidSelfIntersectionsOn();
          f->SetNormalBlend(1.0);
        } },
      { "with folds", [](Main* f) { f->AvoidSelfIntersectionsOff(); } },
#endif
      { "hollows turned", [](Main* f) { f->SetConcaveEdgesToFlip(); } },
      { "other arrays",
        [](Main* f)
        {
          f->GenerateNormalsOn();
          f->GenerateDisplacementOff();
        } } });
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
  CheckChanges<Proxy>(check, "vtkConvexProxyDeformFilter", input,
    [](Proxy* f) { f->SetNumberOfProxyPoints(200); },
    { { "less round", [](Proxy* f) { f->SetRoundness(0.3); } },
      { "more points", [](Proxy* f) { f->SetNumberOfProxyPoints(300); } },
      { "another mesher", [](Proxy* f) { f->SetProxyMesher((f->GetProxyMesher() + 1) % 4); } },
      { "another projection", [](Proxy* f) { f->SetProjection(Proxy::SMALLEST_ANGLE); } },
      { "offsets", [](Proxy* f) { f->SetTransfer(1 - f->GetTransfer()); } },
      { "the first mesher", [](Proxy* f) { f->SetProxyMesher((f->GetProxyMesher() + 3) % 4); } },
      { "less of it", [](Proxy* f) { f->SetBlend(0.8); } },
      { "fewer points", [](Proxy* f) { f->SetNumberOfProxyPoints(150); } } });
#endif
}
}

int TestChangedProperties(int, char*[])
{
  Checker check;
  const Surface ball = MakeBumpyBall(24, 13);
  DetailsKept(check, ball);
  MethodsInTurn(check, WithSeamAndPart(ball));
  OtherFilters(check, ball);
  return check.Result();
}
