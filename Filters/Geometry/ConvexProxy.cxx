// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ConvexProxy.h"

#include "AdvancingFront.h"
#include "BallPivoting.h"
#include "ClosedSurface.h"
#include "ConvexHull.h"
#include "Remeshing.h"
#include "SurfaceMeasures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

namespace SphericalStyle
{
namespace
{
// Meshers are asked again when the number of points that came out is further off than this.
constexpr double AcceptedShare = 0.1;
// A reconstruction that holds less of the hull's volume has confused its two sides.
constexpr double LeastVolume = 0.8;
// Area of a triangle against the squares of its edges below which its angles are noise.
constexpr double SmallestArea = 1e-10;

bool IsNear(Eigen::Index got, int asked)
{
  return std::abs(static_cast<double>(got) - asked) <= AcceptedShare * asked;
}

struct Samples
{
  Points P;       ///< n x 3
  Points normals; ///< n x 3, of the triangles they lie on
};

/// Points spread over the surface by area, at random. The engine's numbers are the same everywhere,
/// the library's distributions are not.
Samples SampleSurface(const TriangleMesh& mesh, int count, std::uint32_t seed)
{
  const Eigen::VectorXd areas = TriangleAreas(mesh.P, mesh.F);
  std::vector<double> upTo(areas.size());
  std::partial_sum(areas.begin(), areas.end(), upTo.begin());
  std::mt19937 engine(seed);
  const auto unit = [&engine] { return (engine() + 0.5) / 4294967296.0; };

  Samples samples{ Points(count, 3), Points(count, 3) };
  for (int i = 0; i < count; ++i)
  {
    const auto found = std::lower_bound(upTo.begin(), upTo.end(), unit() * upTo.back());
    const auto f = std::min<Eigen::Index>(found - upTo.begin(), mesh.F.rows() - 1);
    const Eigen::RowVector3d a = mesh.P.row(mesh.F(f, 0));
    const Eigen::RowVector3d ab = mesh.P.row(mesh.F(f, 1)) - a;
    const Eigen::RowVector3d ac = mesh.P.row(mesh.F(f, 2)) - a;
    const double u = unit();
    const double v = unit();
    samples.P.row(i) = u + v > 1.0 ? a + (1.0 - u) * ab + (1.0 - v) * ac : a + u * ab + v * ac;
    samples.normals.row(i) = ab.cross(ac).stableNormalized();
  }
  return samples;
}

/// Evenly spread points of the hull, about as many as asked for.
Samples PoissonDiskSamples(
  const TriangleMesh& hull, const ConvexProxyOptions& options, double& radius)
{
  // Twenty candidates for each sample kept: more hardly fills the gaps further.
  const Samples dense = SampleSurface(hull, 20 * options.numberOfPoints, options.seed);
  const double area = TriangleAreas(hull.P, hull.F).sum();
  radius = std::sqrt(0.68 * area / options.numberOfPoints); // what such a thinning leaves
  std::vector<int> kept = options.poissonDisk(dense.P, dense.normals, radius);
  if (!IsNear(static_cast<Eigen::Index>(kept.size()), options.numberOfPoints))
  {
    radius *= std::sqrt(static_cast<double>(kept.size()) / options.numberOfPoints);
    kept = options.poissonDisk(dense.P, dense.normals, radius);
  }
  return { dense.P(kept, AllColumns), dense.normals(kept, AllColumns) };
}

/// Remeshes or splits the hull, with another edge length if the first gives too many or too few.
template <typename Mesher>
TriangleMesh MeshHull(const TriangleMesh& hull, int numberOfPoints, double factor, Mesher mesher)
{
  const double area = TriangleAreas(hull.P, hull.F).sum();
  const double length = factor * EdgeLengthFor(area, numberOfPoints);
  TriangleMesh mesh = mesher(hull, length);
  if (!IsNear(mesh.P.rows(), numberOfPoints))
  {
    mesh = mesher(hull, length * std::sqrt(static_cast<double>(mesh.P.rows()) / numberOfPoints));
  }
  return mesh;
}

/// Whether a triangle has no area that could be computed with.
bool HasNeedle(const TriangleMesh& mesh)
{
  const Eigen::VectorXd areas = TriangleAreas(mesh.P, mesh.F);
  const HalfEdgeVectors edges = HalfEdgeDifferences(mesh.P, mesh.F);
  for (Eigen::Index f = 0; f < areas.size(); ++f)
  {
    if (!(areas[f] > SmallestArea * edges.row(f).squaredNorm()))
    {
      return true;
    }
  }
  return false;
}

/// A power of two near the size of the points: divided by it, which changes no digit, the squares
/// of lengths that the meshers take stay in range.
double UnitOf(const Points& P)
{
  int exponent = 0;
  std::frexp((P.colwise().maxCoeff() - P.colwise().minCoeff()).maxCoeff(), &exponent);
  return std::ldexp(1.0, exponent - 1);
}

/// Puts the mesh of the sampling meshers into the proxy, or the reason why it cannot be used.
void MeshSamples(ConvexProxy& proxy, const TriangleMesh& hull, const ConvexProxyOptions& options)
{
  double radius = 0.0;
  const Samples samples = PoissonDiskSamples(hull, options, radius);
  const Triangles F = options.mesher == ProxyMesher::BallPivoting
    ? BallPivoting(samples.P, samples.normals, { 1.4 * radius, 2.0 * radius, 3.0 * radius })
    : AdvancingFront(samples.P);
  ClosedSurfaceResult surface = CloseSurface(samples.P, F);
  if (!surface.closed)
  {
    proxy.fallback = "its triangles do not form one closed surface";
    return;
  }
  if (EnclosedVolume(surface.mesh.P, surface.mesh.F) < LeastVolume * proxy.hullVolume)
  {
    proxy.fallback = "the hull is too thin for the spacing of the points";
    return;
  }
  proxy.mesh = std::move(surface.mesh);
}
} // namespace

ConvexProxy MakeConvexProxy(const Points& P, const ConvexProxyOptions& options)
{
  if (options.numberOfPoints < 4)
  {
    throw std::invalid_argument("a proxy needs 4 points or more");
  }
  Hull hull = ConvexHull(P);
  if (hull.dimension < 2)
  {
    throw std::invalid_argument(hull.dimension == 1
        ? "all points lie on one line: they have no convex hull with a surface"
        : "all points lie at one place: they have no convex hull");
  }
  const double unit = UnitOf(P);
  hull.mesh.P /= unit;
  ConvexProxy proxy;
  proxy.flat = hull.dimension == 2;
  proxy.hullVolume = proxy.flat ? 0.0 : EnclosedVolume(hull.mesh.P, hull.mesh.F);

  const bool sampled =
    options.mesher == ProxyMesher::BallPivoting || options.mesher == ProxyMesher::AdvancingFront;
  if (sampled && proxy.flat)
  {
    proxy.fallback = "the points lie in a plane";
  }
  else if (sampled)
  {
    MeshSamples(proxy, hull.mesh, options);
  }
  else if (options.mesher == ProxyMesher::SubdividedHull)
  {
    proxy.mesh = MeshHull(hull.mesh, options.numberOfPoints, 1.5, SplitLongEdges);
    if (HasNeedle(proxy.mesh))
    {
      proxy.fallback = "the hull has triangles without an area";
    }
  }
  if (proxy.mesh.F.rows() == 0 || !proxy.fallback.empty())
  {
    proxy.mesh = MeshHull(hull.mesh, options.numberOfPoints, 1.08, IsotropicRemeshing);
  }
  proxy.mesh.P *= unit;
  proxy.hullVolume *= unit * unit * unit;
  return proxy;
}
} // namespace SphericalStyle
