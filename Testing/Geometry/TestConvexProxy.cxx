// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Hull, remeshing and the four meshers of the proxy: what is promised of any mesh that comes out,
// measured by other means than those that made it.
#include "Check.h"
#include "ClosedSurface.h"
#include "ConvexHull.h"
#include "ConvexProxy.h"
#include "Meshes.h"
#include "Remeshing.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace SphericalStyle;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
constexpr double Degree = Pi / 180.0;

constexpr ProxyMesher Meshers[] = { ProxyMesher::IsotropicRemeshing, ProxyMesher::BallPivoting,
  ProxyMesher::AdvancingFront, ProxyMesher::SubdividedHull };

std::string NameOf(ProxyMesher mesher)
{
  const char* names[] = { "IsotropicRemeshing", "BallPivoting", "AdvancingFront",
    "SubdividedHull" };
  return names[static_cast<int>(mesher)];
}

bool IsSampled(ProxyMesher mesher)
{
  return mesher == ProxyMesher::BallPivoting || mesher == ProxyMesher::AdvancingFront;
}

Points Cloud(int n, std::uint32_t seed, const std::function<Vector3d(Meshes::Random&)>& point)
{
  Meshes::Random random(seed);
  Points P(n, 3);
  for (int i = 0; i < n; ++i)
  {
    P.row(i) = point(random).transpose();
  }
  return P;
}

Points InCube(int n, std::uint32_t seed)
{
  return Cloud(n, seed, [](Meshes::Random& random) { return random.InCube(); });
}

Points InSinglePrecision(const Points& P)
{
  return P.cast<float>().cast<double>();
}

Points Turned(const Points& P, const Matrix3d& turn, const Vector3d& by = Vector3d::Zero())
{
  return (P * turn.transpose()).rowwise() + by.transpose();
}

Vector3d At(const Points& P, Eigen::Index i)
{
  return P.row(i).transpose();
}

/// Points minus edges plus triangles.
int EulerNumber(const TriangleMesh& mesh)
{
  std::set<std::pair<int, int>> edges;
  for (const auto& t : mesh.F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    }
  }
  return static_cast<int>(mesh.P.rows() - static_cast<Eigen::Index>(edges.size()) + mesh.F.rows());
}

bool UsesEveryPoint(const TriangleMesh& mesh)
{
  const auto corners = mesh.F.reshaped();
  return static_cast<Eigen::Index>(std::set<int>(corners.begin(), corners.end()).size()) ==
    mesh.P.rows();
}

bool SameBits(const TriangleMesh& a, const TriangleMesh& b)
{
  return Meshes::SameBits(a.P, b.P) && a.F.rows() == b.F.rows() && a.F == b.F;
}

/// How far the points lie outside the planes of the triangles of a convex surface. Rounding decides
/// on the planes of slivers: they do not count.
double LargestWayOut(const TriangleMesh& hull, const Points& P)
{
  const double diagonal = Meshes::Diagonal(hull.P);
  double largest = 0.0;
  for (const auto& t : hull.F.rowwise())
  {
    const Vector3d a = At(hull.P, t[0]) / diagonal;
    const Vector3d u = At(hull.P, t[1]) / diagonal - a;
    const Vector3d v = At(hull.P, t[2]) / diagonal - a;
    const double height = u.cross(v).norm() / std::max({ u.norm(), v.norm(), (v - u).norm() });
    if (height > 1e-4)
    {
      const Vector3d n = u.cross(v).normalized();
      largest = std::max(largest, (P * n).maxCoeff() - diagonal * a.dot(n));
    }
  }
  return largest;
}

double LongestEdge(const TriangleMesh& mesh)
{
  double longest = 0.0;
  for (const auto& t : mesh.F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      longest = std::max(longest, (mesh.P.row(t[k]) - mesh.P.row(t[(k + 1) % 3])).norm());
    }
  }
  return longest;
}

/// Share of the angles above `degrees`.
double ShareOfAnglesAbove(const TriangleMesh& mesh, double degrees)
{
  int above = 0;
  for (const auto& t : mesh.F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vector3d a = At(mesh.P, t[(k + 1) % 3]) - At(mesh.P, t[k]);
      const Vector3d b = At(mesh.P, t[(k + 2) % 3]) - At(mesh.P, t[k]);
      above += std::atan2(a.cross(b).norm(), a.dot(b)) > degrees * Degree;
    }
  }
  return static_cast<double>(above) / (3.0 * static_cast<double>(mesh.F.rows()));
}

double Area(const TriangleMesh& mesh)
{
  return TriangleAreas(mesh.P, mesh.F).sum();
}

double Volume(const TriangleMesh& mesh)
{
  return EnclosedVolume(mesh.P, mesh.F);
}

/// Darts in the order of the samples, dropped when too near to an earlier one, found in a grid of
/// cells as wide as the radius.
std::vector<int> ThinOut(const Points& samples, const Points&, double radius)
{
  std::map<std::array<long, 3>, std::vector<int>> grid;
  std::vector<int> kept;
  for (Eigen::Index i = 0; i < samples.rows(); ++i)
  {
    std::array<long, 3> at;
    for (int k = 0; k < 3; ++k)
    {
      at[k] = static_cast<long>(std::floor(samples(i, k) / radius));
    }
    bool free = true;
    for (long x = at[0] - 1; x <= at[0] + 1; ++x)
    {
      for (long y = at[1] - 1; y <= at[1] + 1; ++y)
      {
        for (long z = at[2] - 1; z <= at[2] + 1 && free; ++z)
        {
          const auto cell = grid.find({ x, y, z });
          free = cell == grid.end() ||
            std::all_of(cell->second.begin(), cell->second.end(),
              [&](int j) { return (samples.row(i) - samples.row(j)).norm() >= radius; });
        }
      }
    }
    if (free)
    {
      grid[at].push_back(static_cast<int>(i));
      kept.push_back(static_cast<int>(i));
    }
  }
  return kept;
}

/// Holes all over the memory: what goes by addresses comes out in another order then.
class ScatteredMemory
{
public:
  explicit ScatteredMemory(std::uint32_t seed)
  {
    Meshes::Random random(seed);
    for (int i = 0; i < 20000; ++i)
    {
      Blocks.emplace_back(static_cast<std::size_t>(16.0 + 2000.0 * random.Unit()));
    }
    for (int i = 0; i < 10000; ++i)
    {
      std::swap(
        Blocks[static_cast<std::size_t>(random.Unit() * static_cast<double>(Blocks.size()))],
        Blocks.back());
      Blocks.pop_back();
    }
  }

private:
  std::vector<std::vector<char>> Blocks;
};

ConvexProxyOptions With(ProxyMesher mesher, int numberOfPoints, std::uint32_t seed = 0)
{
  ConvexProxyOptions options;
  options.mesher = mesher;
  options.numberOfPoints = numberOfPoints;
  options.seed = seed;
  options.poissonDisk = ThinOut;
  return options;
}

//------------------------------------------------------------------------------------------------
void CheckHull(
  const std::string& name, const Points& P, double volume = -1.0, double tolerance = 0.0)
{
  const Hull hull = ConvexHull(P);
  const double diagonal = Meshes::Diagonal(P);
  CHECK(hull.dimension == 3, name << ": the dimension is " << hull.dimension);
  CHECK(IsClosedManifold(hull.mesh.F, static_cast<int>(hull.mesh.P.rows())),
    name << ": the hull should be a closed manifold");
  CHECK(EulerNumber(hull.mesh) == 2, name << ": chi is " << EulerNumber(hull.mesh));
  CHECK(UsesEveryPoint(hull.mesh), name << ": the hull should have no point to spare");
  CHECK(Volume(hull.mesh) > 0.0, name << ": the hull should be oriented outward");
  const double out = LargestWayOut(hull.mesh, P);
  CHECK(out <= 1e-9 * diagonal,
    name << ": a point lies " << out / diagonal << " diagonals outside of the hull");
  // Corners of the hull are points of the cloud, to the bit.
  std::set<std::array<double, 3>> cloud;
  for (const auto& p : P.rowwise())
  {
    cloud.insert({ p[0], p[1], p[2] });
  }
  for (const auto& p : hull.mesh.P.rowwise())
  {
    CHECK(cloud.count({ p[0], p[1], p[2] }) == 1, name << ": a corner of the hull is no point");
  }
  if (volume >= 0.0)
  {
    CHECK_NEAR(Volume(hull.mesh) / volume, 1.0, tolerance, name << ": volume");
  }
}

void TestHulls()
{
  for (std::uint32_t seed = 1; seed <= 20; ++seed)
  {
    const std::string number = std::to_string(seed);
    CheckHull("random points " + number, InCube(50 * static_cast<int>(seed * seed), seed));
    CheckHull("few random points " + number, InCube(4 + static_cast<int>(seed % 4), seed));
    CheckHull("points on a ball " + number,
      Cloud(300, seed, [](Meshes::Random& random) { return random.InCube().normalized(); }));
    CheckHull("whole-numbered points " + number,
      Cloud(500, seed,
        [](Meshes::Random& random) { return Vector3d((4.0 * random.InCube()).array().round()); }),
      512.0, 0.6);
  }
  const Points cube = Meshes::Box(1).P;
  CheckHull("cube", cube, 8.0, 1e-15);
  CheckHull("cube with many points on its faces", Meshes::Box(12).P, 8.0, 1e-14);
  CheckHull("tetrahedron", Meshes::Tetrahedron().P, 8.0 / 3.0, 1e-15);
  CheckHull("points of the cube twice and its center",
    (Points(17, 3) << cube, cube, Points::Zero(1, 3)).finished(), 8.0, 1e-15);
  Meshes::Random random(9);
  for (int k = 0; k < 20; ++k)
  {
    const Matrix3d turn = random.Rotation();
    const Points P = Turned(Meshes::Box(8, { 1.0, 0.5, 0.2 }).P, turn, random.InCube());
    CheckHull("turned box", P, 0.8, 1e-13);
    const Eigen::Index corners = ConvexHull(P).mesh.P.rows();
    CHECK(corners == 8, "turned box: " << corners << " corners, with points in edges and faces");
    CheckHull("turned box in single precision", InSinglePrecision(P), 0.8, 1e-5);
  }
  for (const double scale : { 1e-100, 1e-30, 1e30, 1e100 })
  {
    CheckHull("cube of size " + std::to_string(std::log10(scale)), scale * Meshes::Box(5).P,
      8.0 * scale * scale * scale, 1e-13);
    CheckHull("ball of size " + std::to_string(std::log10(scale)), scale * Meshes::Icosphere(3).P);
  }
  const Points far = Meshes::Box(4).P.rowwise() + Eigen::RowVector3d(1e6, -1e6, 1e6);
  CheckHull("cube far away", far, 8.0, 1e-8);
  CheckHull("needle", Meshes::Scaled(Meshes::Icosphere(2), { 1e-3, 1.0, 1e-3 }).P);
  CheckHull("plate", Meshes::Scaled(Meshes::Icosphere(2), { 1.0, 1e-4, 1.0 }).P);
}

void TestDimensions()
{
  const auto dimension = [](const Points& P) { return ConvexHull(P).dimension; };
  CHECK(dimension(Points(0, 3)) == 0, "no point has dimension 0");
  CHECK(dimension(Points::Constant(1, 3, 7.0)) == 0, "one point has dimension 0");
  CHECK(dimension(Points::Constant(40, 3, 1.0 / 3.0)) == 0, "equal points have dimension 0");
  CHECK(dimension(Points::Constant(40, 3, 1e6 / 3.0)) == 0, "equal points far away, too");

  Meshes::Random random(11);
  for (int k = 0; k < 50; ++k)
  {
    const Matrix3d turn = random.Rotation();
    for (const double scale : { 1e-30, 1.0, 1e30 })
    {
      for (const double far : { 0.0, 1.0, 10.0 })
      {
        const Vector3d by = far * random.InCube();
        const Points line =
          Cloud(60, 5, [](Meshes::Random& r) { return Vector3d(r.Signed(), 0.0, 0.0); });
        const Points plane = Cloud(
          60, 6, [](Meshes::Random& r) { return Vector3d(r.Signed(), 0.7 * r.Signed(), 0.0); });
        const Points box = Cloud(60, 7,
          [](Meshes::Random& r)
          { return Vector3d(r.Signed(), 0.7 * r.Signed(), 1e-4 * r.Signed()); });
        const auto name = [&](const char* what)
        {
          return std::string(what) + " of size " + std::to_string(std::log10(scale)) + ", " +
            std::to_string(far) + " away";
        };
        const auto place = [&](const Points& P) -> Points { return scale * Turned(P, turn, by); };
        CHECK(dimension(place(line)) == 1, name("line") << ": the dimension should be 1");
        CHECK(dimension(place(plane)) == 2, name("plane") << ": the dimension should be 2");
        CHECK(dimension(place(box)) == 3, name("plate") << ": the dimension should be 3");
        if (far <= 1.0)
        {
          CHECK(dimension(InSinglePrecision(place(line))) == 1,
            name("single line") << ": the dimension should be 1");
          CHECK(dimension(InSinglePrecision(place(plane))) == 2,
            name("single plane") << ": the dimension should be 2");
        }
      }
    }
  }
  CHECK(dimension((Points(2, 3) << 1, 2, 3, 4, 5, 7).finished()) == 1, "two points: a line");
  CHECK(dimension((Points(3, 3) << 1, 2, 3, 4, 5, 7, 0, 0, 0).finished()) == 2,
    "three points: a plane");
}

// The polygon of points in a plane: their extent, and nothing off the plane.
void TestPolygons()
{
  Meshes::Random random(12);
  for (int k = 0; k < 30; ++k)
  {
    const Matrix3d turn = k == 0 ? Matrix3d::Identity() : random.Rotation();
    const Points square = Meshes::Patch(8, 0.0).P; // 2 by 1.6, with points on its sides
    for (const bool single : { false, true })
    {
      Points P = Turned(square, turn, random.InCube());
      P = single ? InSinglePrecision(P) : P;
      const Hull hull = ConvexHull(P);
      CHECK(hull.dimension == 2, "square: the dimension is " << hull.dimension);
      CHECK(hull.mesh.P.rows() >= 4 && hull.mesh.F.rows() == hull.mesh.P.rows() - 2,
        "square: the fan has " << hull.mesh.F.rows() << " triangles for " << hull.mesh.P.rows()
                               << " corners");
      CHECK(EulerNumber(hull.mesh) == 1, "square: chi of a disc should be 1");
      CHECK_NEAR(Area(hull.mesh) / 3.2, 1.0, single ? 1e-6 : 1e-13, "square: area");
      const double off = ((hull.mesh.P.rowwise() - P.row(0)) * turn.col(2)).cwiseAbs().maxCoeff();
      CHECK(off <= (single ? 1e-6 : 1e-14), "square: a corner is off the plane by " << off);
      for (Eigen::Index f = 1; f < hull.mesh.F.rows(); ++f)
      {
        const auto normal = [&](Eigen::Index g) -> Vector3d
        {
          const Vector3d a = At(hull.mesh.P, hull.mesh.F(g, 0));
          return (At(hull.mesh.P, hull.mesh.F(g, 1)) - a)
            .cross(At(hull.mesh.P, hull.mesh.F(g, 2)) - a);
        };
        CHECK(normal(f).dot(normal(f - 1)) >= -1e-12, "square: the fan should not fold");
      }
    }
  }
}

//------------------------------------------------------------------------------------------------
struct Model
{
  std::string name;
  Points P;
  bool thin = false; ///< samplers may give up
};

std::vector<Model> Models()
{
  Meshes::Random random(21);
  const auto turn = random.Rotation();
  return { { "sphere", Meshes::Icosphere(4).P }, { "box", Meshes::Box(6).P },
    { "flat box", Meshes::Box(6, { 1.0, 0.6, 0.3 }).P }, { "ellipsoid", Meshes::Ellipsoid(4).P },
    { "tetrahedron", Meshes::Tetrahedron().P }, { "random", InCube(400, 3) },
    { "turned box in single precision",
      InSinglePrecision(Turned(Meshes::Box(9, { 1.0, 0.6, 0.3 }).P, turn, { 1.0, 2.0, 3.0 })) },
    { "turned box", Turned(Meshes::Box(9, { 1.0, 0.6, 0.3 }).P, turn, { 1.0, 2.0, 3.0 }) },
    { "turned box far away", Turned(Meshes::Box(5).P, turn, { 3e4, 2e4, -1e4 }) },
    { "box far away", Points(Meshes::Box(6).P.rowwise() + Eigen::RowVector3d(1e6, 1e6, -1e6)) },
    { "small ellipsoid", Points(1e-9 * Meshes::Ellipsoid(3).P) },
    { "large ellipsoid", Points(1e9 * Meshes::Ellipsoid(3).P) },
    { "tiny ellipsoid", Points(1e-100 * Meshes::Ellipsoid(3).P) },
    { "huge ellipsoid", Points(1e100 * Meshes::Ellipsoid(3).P) },
    { "plate", Meshes::Box(6, { 1.0, 1.0, 0.01 }).P, true },
    { "needle", Meshes::Box(6, { 0.01, 1.0, 0.01 }).P, true },
    { "round needle", Meshes::Scaled(Meshes::Icosphere(4), { 0.02, 1.0, 0.02 }).P, true },
    { "lens", Meshes::Scaled(Meshes::Icosphere(4), { 1.0, 0.02, 1.0 }).P, true } };
}

/// The power of two below the diagonal.
double SizeOf(const Points& P)
{
  const double largest = P.cwiseAbs().maxCoeff();
  return std::exp2(std::floor(std::log2(Meshes::Diagonal(P / largest) * largest)));
}

/// Areas and volumes of tiny models are below all numbers.
TriangleMesh AtUnitSize(TriangleMesh mesh, double size)
{
  mesh.P /= size;
  return mesh;
}

/// A prism over points of a parabola: all are corners, and its facets are flat to the last bit.
Points ParabolicPrism(int half)
{
  Points P(2 * (2 * half + 1), 3);
  for (int i = -half, k = 0; i <= half; ++i)
  {
    P.row(k++) << i, i * i / 1024.0, 0.0;
    P.row(k++) << i, i * i / 1024.0, 1000.0;
  }
  return P;
}

// The hull is that of a set: the order of the points does not matter, nor how often they are there.
void TestOrders()
{
  Meshes::Random random(13);
  std::vector<Model> models = Models();
  models.push_back({ "prism of 1602 corners", ParabolicPrism(400) });
  for (const Model& model : models)
  {
    const ScatteredMemory memory(14);
    const Points other = model.P(random.Permutation(static_cast<int>(model.P.rows())), AllColumns);
    const Points twice = (Points(2 * other.rows(), 3) << other, model.P).finished();
    const TriangleMesh hull = ConvexHull(model.P).mesh;
    CHECK(
      SameBits(hull, ConvexHull(other).mesh), model.name << ": hull of points in another order");
    CHECK(SameBits(hull, ConvexHull(twice).mesh), model.name << ": hull of points twice");
  }
}

/// What holds for every closed proxy.
/// @param least  share of the hull's volume; coarse triangles cut much from a needle
void CheckClosed(
  const std::string& name, const ConvexProxy& proxy, const Points& P, double least = 0.8)
{
  const double diagonal = SizeOf(P);
  const TriangleMesh mesh = AtUnitSize(proxy.mesh, diagonal);
  CHECK(!proxy.flat, name << ": it should not count as flat");
  CHECK(mesh.P.allFinite(), name << ": points should be finite");
  CHECK(IsClosedManifold(mesh.F, static_cast<int>(mesh.P.rows())),
    name << ": it should be a closed manifold");
  CHECK(EulerNumber(mesh) == 2, name << ": chi is " << EulerNumber(mesh));
  CHECK(UsesEveryPoint(mesh), name << ": there should be no point to spare");
  CHECK(TriangleAreas(mesh.P, mesh.F).minCoeff() > 0.0, name << ": a triangle has no area");
  const TriangleMesh hull = AtUnitSize(ConvexHull(P).mesh, diagonal);
  const double volume = proxy.hullVolume / diagonal / diagonal / diagonal;
  CHECK_NEAR(volume, Volume(hull), 1e-12 * volume, name << ": hullVolume");
  const double share = Volume(mesh) / volume;
  CHECK(share > least && share < 1.0 + 1e-6,
    name << ": it should be oriented outward and fill its hull; it fills " << share);
  const double out = LargestWayOut(hull, mesh.P);
  CHECK(out <= 1e-9, name << ": a point lies " << out << " diagonals outside of the hull");
}

void TestMeshers()
{
  for (const Model& model : Models())
  {
    for (const ProxyMesher mesher : Meshers)
    {
      for (const int asked : { 300, 1000 })
      {
        const std::string name =
          NameOf(mesher) + " of " + model.name + ", " + std::to_string(asked);
        const ConvexProxy proxy = MakeConvexProxy(model.P, With(mesher, asked));
        CheckClosed(name, proxy, model.P, model.thin ? 0.5 : 0.8);
        CHECK(model.thin || proxy.fallback.empty(), name << " fell back: " << proxy.fallback);
        const double got = static_cast<double>(proxy.mesh.P.rows()) / asked;
        if (mesher == ProxyMesher::SubdividedHull)
        {
          // Cutting in half all of a hull's edges gives four times the points.
          CHECK(
            got >= 0.25 && (got <= 4.0 || proxy.mesh.P.rows() == ConvexHull(model.P).mesh.P.rows()),
            name << " has " << got << " of the points asked for");
        }
        else if (!model.thin)
        {
          CHECK(std::abs(got - 1.0) <= 0.15, name << " has " << got << " of the points asked for");
        }
        std::cout << name << ": points " << got << ", angles above 25 degrees "
                  << ShareOfAnglesAbove(proxy.mesh, 25.0)
                  << (proxy.fallback.empty() ? "" : ", fell back: " + proxy.fallback) << std::endl;
        if (mesher == ProxyMesher::SubdividedHull)
        {
          const double size = SizeOf(model.P);
          CHECK_NEAR(Volume(AtUnitSize(proxy.mesh, size)) / (proxy.hullVolume / size / size / size),
            1.0, 1e-12, name << ": volume");
        }
        else if (!model.thin)
        {
          const double share = ShareOfAnglesAbove(AtUnitSize(proxy.mesh, SizeOf(model.P)), 25.0);
          CHECK(share >= 0.95, name << ": the share of angles above 25 degrees is " << share);
        }
        if (asked == 300) // again, in another place of the memory
        {
          const ScatteredMemory memory(static_cast<std::uint32_t>(asked) + 7);
          CHECK(SameBits(proxy.mesh, MakeConvexProxy(model.P, With(mesher, asked)).mesh),
            name << ": twice the same should have the same bits");
        }
      }
    }
  }
}

void TestSeeds()
{
  const Points P = Meshes::Ellipsoid(3).P;
  for (const ProxyMesher mesher : Meshers)
  {
    const ConvexProxy first = MakeConvexProxy(P, With(mesher, 400, 1));
    const ConvexProxy again = MakeConvexProxy(P, With(mesher, 400, 1));
    const ConvexProxy other = MakeConvexProxy(P, With(mesher, 400, 2));
    CHECK(SameBits(first.mesh, again.mesh), NameOf(mesher) << ": the same seed, the same bits");
    CHECK(SameBits(first.mesh, other.mesh) == !IsSampled(mesher),
      NameOf(mesher) << ": another seed should give other samples, where there are some");
    CheckClosed(NameOf(mesher) + ", seed 2", other, P);
  }
  for (const std::uint32_t seed : { 0u, 3u, 2147483647u, 4294967295u })
  {
    CheckClosed("seed " + std::to_string(seed),
      MakeConvexProxy(P, With(ProxyMesher::BallPivoting, 400, seed)), P);
  }
}

// Samples of the callback are those asked for: on the hull, with its normals, one radius.
void TestSamples()
{
  const Points P = Meshes::Box(3, { 0.5, 0.4, 0.3 }).P; // of unit size: not scaled for the meshers
  int calls = 0;
  ConvexProxyOptions options = With(ProxyMesher::BallPivoting, 500);
  Points kept;
  options.poissonDisk = [&](const Points& samples, const Points& normals, double radius)
  {
    ++calls;
    CHECK(samples.rows() == 20 * 500 && normals.rows() == samples.rows(), "twenty to choose from");
    int wrong = 0;
    Eigen::Vector3i onSides = Eigen::Vector3i::Zero();
    for (Eigen::Index i = 0; i < samples.rows(); ++i)
    {
      const Vector3d x = samples.row(i).transpose().cwiseQuotient(Vector3d(0.5, 0.4, 0.3));
      Eigen::Index axis = 0;
      const double largest = x.cwiseAbs().maxCoeff(&axis);
      ++onSides[axis];
      const Vector3d side = (x[axis] > 0.0 ? 1.0 : -1.0) * Vector3d::Unit(axis);
      wrong += std::abs(largest - 1.0) > 1e-12 || (normals.row(i) * side)[0] < 1.0 - 1e-12;
    }
    CHECK(wrong == 0, wrong << " samples are off the hull or have another normal");
    // Shares of the areas; 10,000 samples scatter by .005.
    const Vector3d areas(0.8 * 0.6, 0.6, 0.8);
    for (int k = 0; k < 3; ++k)
    {
      CHECK_NEAR(onSides[k] / 10000.0, areas[k] / areas.sum(), 0.02, "share of samples on a side");
    }
    std::vector<int> result = ThinOut(samples, normals, radius);
    kept = samples(result, AllColumns);
    // Poisson disk: none nearer than the radius, none could be put back (A5.4).
    double nearest = 1e9;
    for (Eigen::Index i = 0; i < kept.rows(); ++i)
    {
      for (Eigen::Index j = 0; j < i; ++j)
      {
        nearest = std::min(nearest, (kept.row(i) - kept.row(j)).norm());
      }
    }
    double gap = 0.0;
    for (const auto& x : samples.rowwise())
    {
      gap = std::max(gap, (kept.rowwise() - x).rowwise().norm().minCoeff());
    }
    CHECK(nearest >= radius && gap <= 2.0 * radius,
      "samples " << nearest / radius << " to " << gap / radius << " radii apart");
    return result;
  };
  const ConvexProxy proxy = MakeConvexProxy(P, options);
  CHECK(calls == 1 || calls == 2, "the samples were thinned out " << calls << " times");
  CHECK(proxy.fallback.empty(), "fell back: " << proxy.fallback);
  // Points of the proxy are samples: none is moved.
  std::set<std::array<double, 3>> all;
  for (const auto& p : kept.rowwise())
  {
    all.insert({ p[0], p[1], p[2] });
  }
  for (const auto& p : proxy.mesh.P.rowwise())
  {
    CHECK(all.count({ p[0], p[1], p[2] }) == 1, "a point of the proxy is no sample");
  }
  CHECK(static_cast<double>(proxy.mesh.P.rows()) > 0.97 * static_cast<double>(kept.rows()),
    "the proxy should use nearly all samples");
}

void TestFewPoints()
{
  for (const Model& model : Models())
  {
    for (const ProxyMesher mesher : Meshers)
    {
      for (const int asked : { 4, 5, 8, 12, 20, 60 })
      {
        const std::string name =
          NameOf(mesher) + " of " + model.name + ", " + std::to_string(asked);
        const ConvexProxy proxy = MakeConvexProxy(model.P, With(mesher, asked));
        CHECK(proxy.mesh.P.allFinite() && proxy.mesh.F.rows() >= 4, name << ": no surface");
        CHECK(IsClosedManifold(proxy.mesh.F, static_cast<int>(proxy.mesh.P.rows())),
          name << ": it should be a closed manifold");
        const TriangleMesh mesh = AtUnitSize(proxy.mesh, SizeOf(model.P));
        CHECK(TriangleAreas(mesh.P, mesh.F).minCoeff() > 0.0, name << ": a triangle has no area");
        CHECK(Volume(mesh) > 0.0, name << ": it should be oriented outward");
      }
    }
  }
}

// Where samples cannot work, the reason is stated and the hull remeshed.
void TestFallbacks()
{
  const Points plate = Meshes::Box(4, { 1.0, 1.0, 0.001 }).P;
  for (const ProxyMesher mesher : Meshers)
  {
    const ConvexProxy proxy = MakeConvexProxy(plate, With(mesher, 500));
    const std::string name = NameOf(mesher) + " of a thin plate";
    CheckClosed(name, proxy, plate);
    CHECK(proxy.fallback.empty() == !IsSampled(mesher), name << ": fallback: " << proxy.fallback);
    if (IsSampled(mesher))
    {
      CHECK(SameBits(
              proxy.mesh, MakeConvexProxy(plate, With(ProxyMesher::IsotropicRemeshing, 500)).mesh),
        name << ": it should be what IsotropicRemeshing gives");
    }
  }
}

void TestFlat()
{
  Meshes::Random random(31);
  for (int k = 0; k < 12; ++k)
  {
    const Matrix3d turn = k == 0 ? Matrix3d::Identity() : random.Rotation();
    const bool single = k % 2 == 1;
    Points P = Turned(k % 3 == 2
        ? Cloud(300, 8, [](Meshes::Random& r) { return Vector3d(r.Signed(), r.Signed(), 0.0); })
        : Meshes::Patch(9, 0.0).P,
      turn, random.InCube());
    P = single ? InSinglePrecision(P) : P;
    const double area = Area(ConvexHull(P).mesh);
    for (const ProxyMesher mesher : Meshers)
    {
      const std::string name =
        NameOf(mesher) + " of plane " + std::to_string(k) + (single ? ", single" : "");
      const ConvexProxy proxy = MakeConvexProxy(P, With(mesher, 400));
      CHECK(proxy.flat, name << ": it should count as flat");
      CHECK(proxy.hullVolume == 0.0, name << ": the hull has no volume");
      CHECK(proxy.fallback.empty() == !IsSampled(mesher), name << ": fallback " << proxy.fallback);
      CHECK(!IsSampled(mesher) || proxy.fallback.find("plane") != std::string::npos,
        name << ": the fallback should name the plane: " << proxy.fallback);
      CHECK(proxy.mesh.P.allFinite() && EulerNumber(proxy.mesh) == 1,
        name << ": chi of a disc should be 1, is " << EulerNumber(proxy.mesh));
      // Blunt corners of the border are rounded off.
      CHECK_NEAR(Area(proxy.mesh) / area, 1.0,
        mesher == ProxyMesher::SubdividedHull ? (single ? 1e-6 : 1e-12) : 2e-3, name << ": area");
      CHECK(TriangleAreas(proxy.mesh.P, proxy.mesh.F).minCoeff() > 0.0,
        name << ": a triangle has no area");
      const double off = ((proxy.mesh.P.rowwise() - P.row(0)) * turn.col(2)).cwiseAbs().maxCoeff();
      CHECK(off <= (single ? 1e-6 : 1e-14), name << ": off the plane by " << off);
      const double got = static_cast<double>(proxy.mesh.P.rows()) / 400.0;
      if (mesher != ProxyMesher::SubdividedHull)
      {
        CHECK(std::abs(got - 1.0) <= 0.15, name << " has " << got << " of the points asked for");
        const double share = ShareOfAnglesAbove(proxy.mesh, 25.0);
        CHECK(share >= 0.95, name << ": the share of angles above 25 degrees is " << share);
      }
    }
  }
}

//------------------------------------------------------------------------------------------------
void TestRemeshing()
{
  const std::vector<Meshes::Named> models = { { "sphere", Meshes::Icosphere(3) },
    { "box", Meshes::Box(1) }, { "ellipsoid", Meshes::EllipsoidUV() },
    { "slivers", ConvexHull(Meshes::Slivers().P).mesh },
    { "random hull", ConvexHull(InCube(200, 4)).mesh }, { "patch", Meshes::Patch(6, 0.0) } };
  for (const auto& [name, mesh] : models)
  {
    const double area = Area(mesh);
    for (const double share : { 0.03, 0.06, 0.12 })
    {
      const double length = share * Meshes::Diagonal(mesh.P);
      const TriangleMesh even = IsotropicRemeshing(mesh, length);
      const double above = ShareOfAnglesAbove(even, 25.0);
      std::cout << "isotropic remeshing of " << name << " to " << share << ": " << even.P.rows()
                << " points, angles above 25 degrees " << above << std::endl;
      CHECK(above >= 0.95, name << ": the share of angles above 25 degrees is " << above);
      CHECK(EulerNumber(even) == EulerNumber(mesh), name << ": chi should stay");
      CHECK_NEAR(Area(even) / area, 1.0, 0.1, name << ": area");
      CHECK(
        LongestEdge(even) <= 2.0 * length, name << ": an edge of " << LongestEdge(even) / length);
    }

    for (const double share : { 0.02, 0.1, 0.5, 2.0 })
    {
      const double length = share * Meshes::Diagonal(mesh.P);
      const TriangleMesh split = SplitLongEdges(mesh, length);
      CHECK(LongestEdge(split) <= length * (1.0 + 1e-12),
        name << ": an edge is " << LongestEdge(split) / length << " times the longest allowed");
      CHECK_NEAR(Area(split) / area, 1.0, 1e-12, name << " split: area");
      CHECK(EulerNumber(split) == EulerNumber(mesh), name << " split: chi should stay");
      CHECK(Meshes::SameBits(split.P.topRows(mesh.P.rows()), mesh.P),
        name << " split: its points should keep bits and numbers");
      if (EulerNumber(mesh) == 2)
      {
        CHECK_NEAR(Volume(split) / Volume(mesh), 1.0, 1e-12, name << " split: volume");
        CHECK(IsClosedManifold(split.F, static_cast<int>(split.P.rows())),
          name << " split: it should be a closed manifold");
      }
      if (share == 2.0)
      {
        CHECK(SameBits(split, mesh), name << ": without a long edge nothing should change");
      }
    }
  }
  // n points in equilateral triangles: 2 n triangles of that edge.
  const double length = EdgeLengthFor(7.0, 1000);
  CHECK_NEAR(2000.0 * std::sqrt(3.0) / 4.0 * length * length, 7.0, 1e-12, "area by EdgeLengthFor");
}

void TestErrors()
{
  const Points ball = Meshes::Icosphere(1).P;
  for (const ProxyMesher mesher : Meshers)
  {
    for (const int bad : { 3, 0, -7 })
    {
      CHECK_THROWS(
        std::invalid_argument, MakeConvexProxy(ball, With(mesher, bad)), "4 points or more");
    }
    const Points line = (Points(3, 3) << 0, 0, 0, 1, 2, 3, 3, 6, 9).finished();
    CHECK_THROWS(std::invalid_argument, MakeConvexProxy(line, With(mesher, 100)), "one line");
    CHECK_THROWS(
      std::invalid_argument, MakeConvexProxy(line.topRows(2), With(mesher, 100)), "one line");
    CHECK_THROWS(
      std::invalid_argument, MakeConvexProxy(line.topRows(1), With(mesher, 100)), "one place");
    CHECK_THROWS(std::invalid_argument,
      MakeConvexProxy(Points::Constant(9, 3, 0.1), With(mesher, 100)), "one place");
    CHECK_THROWS(
      std::invalid_argument, MakeConvexProxy(Points(0, 3), With(mesher, 100)), "one place");
  }
}
} // namespace

int main(int argc, char**)
{
  if (argc > 1)
  {
    TestMeshers();
    return CheckResult();
  }
  TestHulls();
  TestDimensions();
  TestPolygons();
  TestRemeshing();
  TestMeshers();
  TestOrders();
  TestSeeds();
  TestSamples();
  TestFewPoints();
  TestFallbacks();
  TestFlat();
  TestErrors();
  return CheckResult();
}
