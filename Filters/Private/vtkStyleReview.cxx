// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStyleReview.h"

#include "vtkFilterSupport.h"

#include <cmath>
#include <vector>

using namespace SphericalStyle;

namespace
{
/// Looked at for their thickness; so many find a thin part that a user would see.
constexpr int LargestNumberOfProbes = 2000;

#ifdef SPHERICALSTYLE_WITH_CGAL
constexpr bool WithCgal = true;
#else
constexpr bool WithCgal = false;
#endif

std::vector<int> EveryFew(int n)
{
  const int stride = (n + LargestNumberOfProbes - 1) / LargestNumberOfProbes;
  std::vector<int> points;
  for (int i = 0; i < n; i += stride)
  {
    points.push_back(i);
  }
  return points;
}

/// With directions from one center the closed form [blend] brings no two points nearer than to
/// 1 / (1 + sqrt(3) lambda) of their distance, but for the size of a triangle.
bool CannotThin(const MethodOptions& o, const StyleReport& report)
{
  if (report.closedForm && o.detailSize > 0.0)
  {
    return true; // walls are held together [wall]
  }
  return report.closedForm && o.normalBlend == 0.0 && o.normalBlends.size() == 0 &&
    o.targets.rows() == 0 && o.roundnessFactors.size() == 0 &&
    1.0 / (1.0 + std::sqrt(3.0) * o.lambda) >= ThinnedBelow;
}
}

void vtkStyleReview::SetMesh(const TriangleMesh& mesh, int components, int generation)
{
  if (generation != this->Generation)
  {
    this->Facts = MeasureSurface(mesh, components);
    this->HasProbes = false;
    this->Generation = generation;
  }
}

std::string vtkStyleReview::LookAtThickness(
  const vtkSurfaceMesh& surface, const Points& Q, int threads)
{
  if (!this->HasProbes)
  {
    this->Probes = PlaceThicknessProbes(
      surface.Mesh, EveryFew(static_cast<int>(surface.Mesh.P.rows())), threads);
    this->HasProbes = true;
  }
  const Eigen::VectorXd ratios = ThicknessRatios(surface.Mesh, Q, this->Probes);
  const auto thinned = (ratios.array() < ThinnedBelow).count();
  if (thinned == 0)
  {
    return {};
  }
  Eigen::Index first = 0;
  while (!(ratios(first) < ThinnedBelow))
  {
    ++first;
  }
  return "less than a tenth of the thickness is left at " +
    vtkFilterSupport::Count(thinned, "point") + " of " + std::to_string(ratios.size()) +
    " looked at, the first is point " +
    std::to_string(surface.FirstInputPoint(this->Probes.points[first])) +
    "; a lower Roundness or a larger DetailSize leaves more";
}

vtkStyleReview::Remarks vtkStyleReview::Look(const vtkSurfaceMesh& surface, int generation,
  const Points& Q, const MethodOptions& o, const StyleReport& report)
{
  this->SetMesh(surface.Mesh, report.components, generation);
  Remarks remarks;
  if (!CannotThin(o, report))
  {
    remarks.Thinned = this->LookAtThickness(surface, Q, o.threads);
  }
  remarks.Advice = Advise(o, this->Facts, MeasureResult(surface.Mesh, Q, o, report), WithCgal);
  return remarks;
}
