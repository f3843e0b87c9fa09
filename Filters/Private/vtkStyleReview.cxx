// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStyleReview.h"

#include "ClosedFormStyle.h"
#include "SurfaceGrid.h"
#include "SurfaceMeasures.h"
#include "vtkFilterSupport.h"
#include "vtkStyleHistory.h"
#include "vtkTargetSphere.h"

#include <sstream>
#include <utility>

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

/// Cosine of 60 degrees; and the share of the area from which on it is worth a word.
constexpr double NormalOff = 0.5;
constexpr double OffShare = 0.1;

/// Normals that do not fit the surface, as some programs write them for one side of a box. Those of
/// a surface that is inside out fit if all are turned.
std::string NormalsRemark(const vtkSurfaceMesh& surface, const Points& normals)
{
  const TriangleMesh& mesh = surface.Mesh;
  const Points own = PointNormals(mesh.P, mesh.F, surface.Part);
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.P.rows());
  const Eigen::VectorXd ofTriangles = TriangleAreas(mesh.P, mesh.F);
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      areas(mesh.F(f, k)) += ofTriangles(f) / 3.0;
    }
  }
  Eigen::VectorXd cosines = own.cwiseProduct(normals).rowwise().sum();
  cosines *= surface.Part.Sum(areas.dot(cosines)) < 0.0 ? -1.0 : 1.0;
  double off = 0.0;
  Eigen::Index first = -1;
  for (Eigen::Index i = 0; i < cosines.size(); ++i)
  {
    // 0 is no direction
    if (cosines(i) < NormalOff && !normals.row(i).isZero(0.0) && !own.row(i).isZero(0.0))
    {
      off += areas(i);
      first = first < 0 ? i : first;
    }
  }
  const double share = surface.Part.Sum(off) / surface.Part.Sum(areas.sum());
  if (!(share > OffShare))
  {
    return {};
  }
  std::ostringstream text;
  text << "the normals of the model do not fit its surface: on " << std::lround(100.0 * share)
       << " % of the area they are off by more than 60 degrees";
  if (surface.Part.IsWhole())
  {
    text << ", the first at point " << surface.FirstInputPoint(static_cast<int>(first));
  }
  text << ", and the result follows them where it is rounded limb by limb (NormalBlend). A "
          "DetailSize above 0 does without them, and Generate Surface Normals in ParaView, "
          "vtkPolyDataNormals in VTK, makes new ones";
  return text.str();
}

/// With directions from one center the closed form [blend] brings no two points nearer than to what
/// is left of their way, but for the size of a triangle.
bool CannotThin(const MethodOptions& o, const StyleReport& report)
{
  if (report.closedForm && o.detailSize > 0.0)
  {
    return true; // walls are held together [wall]
  }
  return report.closedForm && o.normalBlend == 0.0 && o.normalBlends.size() == 0 &&
    o.targets.rows() == 0 && o.Factors().size() == 0 &&
    1.0 - SphericalStyle::ShareOfWay(o.lambda) >= ThinnedBelow;
}
}

std::vector<std::string> vtkStyleReview::Warnings(const vtkSurfaceMesh& surface,
  const MethodOptions& o, const StyleReport& report, const Request& request)
{
  std::vector<std::string> warnings = vtkSurfaceMeshConversion::Remarks(surface);
  if (o.radiusMode == RadiusMode::EqualVolume && report.spheres.size() == 1)
  {
    warnings.push_back(vtkTargetSphere::VolumeRemark("the surface", surface.Mesh, surface.Part));
  }
  warnings.push_back(vtkTargetSphere::OnCenter(report.pointsOnCenter, surface));
  if (request.OwnNormals && o.detailSize == 0.0 &&
    surface.Part.Max(o.normals.rows() > 0 ? 1.0 : 0.0) > 0.0)
  {
    warnings.push_back(NormalsRemark(surface, o.normals));
  }
  if (request.CellEnergy && report.closedForm)
  {
    warnings.emplace_back(
      "GenerateCellEnergy: the result is in closed form, no energy was minimized, and there is "
      "no array CellEnergy; SphericalWeighting Uniform minimizes one");
  }
  if (report.coarserGrid)
  {
    std::ostringstream text;
    text << "DetailSize " << o.detailSize
         << " is too small for the area of this model: the base is as smooth as with DetailSize "
         << SurfaceGrid::SpacingsPerSize * report.gridSpacing
         << "; take that or more, or details smaller than it count as base";
    warnings.push_back(text.str());
  }
  if (!report.hasMinimum)
  {
    warnings.push_back(
      "the system matrix is not positive definite: with full-edge weights the energy of this "
      "surface has no minimum, and iterations lead away from it without end; take EdgeWeighting "
      "HalfEdge" +
      std::string(request.Thesis ? " without ReproduceThesis" : ""));
  }
  else if (surface.Part.Max(surface.Mesh.F.rows() > 0 ? 1.0 : 0.0) > 0.0)
  {
    for (std::string& remark : vtkStyleHistory::Remarks(report))
    {
      warnings.push_back(std::move(remark));
    }
  }
  return warnings;
}

std::string vtkStyleReview::ThinnedParts(
  const vtkSurfaceMesh& surface, int generation, const Points& Q, int threads)
{
  this->Probes.Update(generation,
    [&](ThicknessProbes& probes)
    {
      probes = PlaceThicknessProbes(
        surface.Mesh, EveryFew(static_cast<int>(surface.Mesh.P.rows())), threads);
    });
  const Eigen::VectorXd ratios = ThicknessRatios(surface.Mesh, Q, this->Probes.Get());
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
    std::to_string(surface.FirstInputPoint(this->Probes->points[first])) +
    "; a lower Roundness or a larger DetailSize leaves more";
}

vtkStyleReview::Remarks vtkStyleReview::Review(const vtkSurfaceMesh& surface, int generation,
  const Points& Q, const MethodOptions& o, const StyleReport& report, AdviceChoices choices)
{
  this->Facts.Update(generation,
    [&](SurfaceFacts& facts)
    { facts = MeasureSurface(surface.Mesh, report.components, surface.Part); });
  Remarks remarks;
  if (surface.Part.IsWhole() && !CannotThin(o, report))
  {
    remarks.Thinned = this->ThinnedParts(surface, generation, Q, o.threads);
  }
  choices.canAvoidFolds = WithCgal;
  remarks.Advice = Advise(o, this->Facts.Get(),
    MeasureResult(surface.Mesh, this->Facts.Get(), Q, o, report, surface.Part), choices);
  return remarks;
}
