// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Every filter, the main one with several settings: for tests of what all of them keep to.
#ifndef EveryFilter_h
#define EveryFilter_h

#include "FilterTesting.h"
#include "TermFilters.h"

#include "vtkGaussMapFilter.h"
#include "vtkHandleDeformFilter.h"
#include "vtkNonlinearStyleFilter.h"
#include "vtkPartSizesFilter.h"
#include "vtkSphereProjectionFilter.h"
#include "vtkSurfaceDiagnostics.h"
#include "vtkSurfaceMetrics.h"
#include "vtkSurfacePartsFilter.h"
#ifdef SPHERICALSTYLE_WITH_CGAL
#include "vtkConvexProxyDeformFilter.h"
#include "vtkPrintableFilter.h"
#endif

namespace FilterTesting
{
/// A filter, as one setting makes it.
struct Subject
{
  std::string name;
  std::function<vtkSmartPointer<vtkPolyDataAlgorithm>()> make;
  bool deforms = true; ///< output 0 is the input with other points
  bool refuses = true; ///< what the main filter refuses
  bool isSlow = false; ///< looks for parts, which takes half a second for any surface
};

/// Whether every filter is to meet everything, with the argument --all. Else a test leaves out what
/// other filters meet, to take less time.
inline bool IsComplete(int argc, char* argv[])
{
  return std::any_of(
    argv, argv + argc, [](const char* argument) { return std::string("--all") == argument; });
}

template <typename Filter>
Subject SubjectOf(
  const char* name, const std::function<void(Filter*)>& set = [](Filter*) {})
{
  return { name,
    [set]
    {
      auto filter = vtkSmartPointer<Filter>::New();
      set(filter);
      return vtkSmartPointer<vtkPolyDataAlgorithm>(filter);
    } };
}

template <typename Filter>
Subject ObserverOf(
  const char* name, const std::function<void(Filter*)>& set = [](Filter*) {})
{
  Subject subject = SubjectOf<Filter>(name, set);
  subject.deforms = false;
  return subject;
}

inline Subject Slow(Subject subject)
{
  subject.isSlow = true;
  return subject;
}

inline std::vector<Subject> Subjects()
{
  using Main = vtkSphericalStyleFilter;
  std::vector<Subject> all = { SubjectOf<Main>("vtkSphericalStyleFilter", SetUpDefaults),
    ObserverOf<Main>("vtkSphericalStyleFilter with long edges split where it is coarse",
      [](Main* f) { f->SetMaximumEdgeLength(0.1); }), // it has more points then
    SubjectOf<Main>("vtkSphericalStyleFilter without details", SetUpEnergy),
    SubjectOf<Main>("vtkSphericalStyleFilter with normals",
      [](Main* f)
      {
        SetUpDefaults(f);
        f->SetNormalBlend(1.0);
        f->SetDetailSize(0.0);
      }),
    SubjectOf<Main>("vtkSphericalStyleFilter with fine details, on the ground",
      [](Main* f)
      {
        SetUpDefaults(f);
        f->SetDetailSize(0.05);
        f->SetRoundness(5.0);
        f->SetKeepSizeToExtent();
        f->KeepOnGroundOn();
      }),
    SubjectOf<Main>("vtkSphericalStyleFilter with a plane of symmetry",
      [](Main* f)
      {
        SetUpDefaults(f);
        f->SetSymmetryToX();
      }),
    SubjectOf<Main>("vtkSphericalStyleFilter with a box as the target",
      [](Main* f)
      {
        SetUpDefaults(f);
        f->SetTargetToRoundedBox();
      }),
    SubjectOf<Main>("vtkSphericalStyleFilter with uniform weights",
      [](Main* f)
      {
        SetUpUniform(f);
        f->SetMaximumNumberOfIterations(20);
        f->SetRoundness(50.0);
      }),
    SubjectOf<Main>("vtkSphericalStyleFilter with uniform weights and details",
      [](Main* f)
      {
        SetUpDefaults(f);
        f->SetSphericalWeightingToUniform();
        f->SetMaximumNumberOfIterations(5);
      }),
    SubjectOf<vtkThesisStyleFilter>("vtkThesisStyleFilter with Delaunay weights",
      [](vtkThesisStyleFilter* f)
      {
        SetUpEnergy(f);
        f->SetEdgeWeightingToIntrinsicDelaunay();
        f->SetInitialGuessToRest(); // or the weights do not matter
        f->SetDetailSize(0.06);
      }),
    SubjectOf<vtkNonlinearStyleFilter>("vtkNonlinearStyleFilter",
      [](vtkNonlinearStyleFilter* f) { f->SetMaximumNumberOfIterations(5); }),
    ObserverOf<Main>("vtkSphericalStyleFilter with long edges split",
      [](Main* f)
      {
        SetUpEnergy(f);
        f->SetRefineLongEdgesToOn();
      }),
    SubjectOf<vtkSphereProjectionFilter>("vtkSphereProjectionFilter"),
    SubjectOf<vtkHandleDeformFilter>("vtkHandleDeformFilter",
      [](vtkHandleDeformFilter* f)
      {
        // Of whatever surface the outermost points of two directions.
        const double low[10] = { -7, -20, -50, 0, -7, -20, -50, 0, 0, 0 };
        const double high[10] = { 7, 20, 50, 0, 7, 20.2, 50.3, 0.2, -0.1, 0.1 };
        f->AddHandle(low);
        f->AddHandle(high);
        f->SetMaximumNumberOfIterations(20);
      }),
    Slow(SubjectOf<vtkPartSizesFilter>("vtkPartSizesFilter",
      [](vtkPartSizesFilter* f)
      {
        f->SetPartSize(0, 1.3);
        f->SetPartRoundness(0, 0.5);
        f->KeepOnGroundOn();
      })),
    ObserverOf<vtkGaussMapFilter>("vtkGaussMapFilter"),
    ObserverOf<vtkSurfaceMetrics>("vtkSurfaceMetrics"),
    Slow(ObserverOf<vtkSurfacePartsFilter>("vtkSurfacePartsFilter",
      [](vtkSurfacePartsFilter* f) { f->SetNumberOfParts(1); })), // a search takes longer still
    ObserverOf<vtkSurfacePartsFilter>("vtkSurfacePartsFilter by connectivity",
      [](vtkSurfacePartsFilter* f) { f->SetMethodToConnectivity(); }),
    ObserverOf<vtkSurfaceDiagnostics>("vtkSurfaceDiagnostics") };
  all.back().refuses = false; // it tells
#define SUBJECT(Filter, setWeight) all.push_back(SubjectOf<Filter>(#Filter));
  SPHERICALSTYLE_TERM_FILTERS(SUBJECT)
#undef SUBJECT
#ifdef SPHERICALSTYLE_WITH_CGAL
  all.push_back(SubjectOf<Main>("vtkSphericalStyleFilter without folds",
    [](Main* f)
    {
      SetUpDefaults(f);
      f->AvoidSelfIntersectionsOn();
      f->SetNormalBlend(1.0);
      f->SetRoundness(5.0);
    }));
  all.push_back(SubjectOf<vtkConvexProxyDeformFilter>("vtkConvexProxyDeformFilter",
    [](vtkConvexProxyDeformFilter* f)
    {
      f->SetRefineLongEdgesToOff();
      f->SetNumberOfProxyPoints(500);
    }));
  all.push_back(ObserverOf<vtkPrintableFilter>(
    "vtkPrintableFilter", [](vtkPrintableFilter* f) { f->SetMinimumThickness(0.05); }));
#endif
  return all;
}

}

#endif
