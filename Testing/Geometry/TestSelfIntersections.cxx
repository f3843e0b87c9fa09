// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Pairs of intersecting triangles: counted by hand on small scenes, and against a test of all
/// pairs in whole numbers, where no predicate can err.
#include "Check.h"
#include "Meshes.h"
#include "SelfIntersections.h"

#include <algorithm>
#include <iterator>
#include <set>

using namespace SphericalStyle;
using Pairs = std::vector<std::array<int, 2>>;

namespace
{
/// A second mesh beside the first; no common points.
TriangleMesh Together(const TriangleMesh& a, const TriangleMesh& b)
{
  TriangleMesh mesh;
  mesh.P.resize(a.P.rows() + b.P.rows(), 3);
  mesh.P << a.P, b.P;
  mesh.F.resize(a.F.rows() + b.F.rows(), 3);
  mesh.F << a.F, (b.F.array() + static_cast<int>(a.P.rows())).matrix();
  return mesh;
}

TriangleMesh Moved(TriangleMesh mesh, const Meshes::Vector& by)
{
  mesh.P.rowwise() += by.transpose();
  return mesh;
}

//------------------------------------------------------------------------------------------------
// Reference: what two triangles have in common, in whole numbers of 64 bits.
using Whole = std::int64_t;
using W3 = std::array<Whole, 3>;

W3 operator-(const W3& a, const W3& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

W3 Cross(const W3& a, const W3& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Whole Dot(const W3& a, const W3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int Sign(Whole x)
{
  return (x > 0) - (x < 0);
}

using Corners = std::array<W3, 3>;

/// Whether two closed convex polygons meet: only if no axis parts them (their normals, the products
/// of their edges, and in one plane the normals of the edges in it). `strict` asks for more than a
/// touch along that axis.
bool Parted(const Corners& s, const Corners& t, const W3& axis, bool strict)
{
  Whole range[2][2] = {};
  for (int m = 0; m < 2; ++m)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Whole x = Dot(axis, m == 0 ? s[k] : t[k]);
      range[m][0] = k == 0 ? x : std::min(range[m][0], x);
      range[m][1] = k == 0 ? x : std::max(range[m][1], x);
    }
  }
  return strict ? range[0][1] <= range[1][0] || range[1][1] <= range[0][0]
                : range[0][1] < range[1][0] || range[1][1] < range[0][0];
}

bool Meet(const Corners& s, const Corners& t)
{
  const W3 ns = Cross(s[1] - s[0], s[2] - s[0]);
  const W3 nt = Cross(t[1] - t[0], t[2] - t[0]);
  std::vector<W3> axes = { ns, nt };
  for (int i = 0; i < 3; ++i)
  {
    const W3 a = s[(i + 1) % 3] - s[i];
    axes.push_back(Cross(ns, a));
    axes.push_back(Cross(nt, t[(i + 1) % 3] - t[i]));
    for (int j = 0; j < 3; ++j)
    {
      axes.push_back(Cross(a, t[(j + 1) % 3] - t[j]));
    }
  }
  return std::none_of(
    axes.begin(), axes.end(), [&](const W3& axis) { return Parted(s, t, axis, false); });
}

/// Whether the triangle meets the segment a b, which is a triangle of two equal corners here.
bool MeetSegment(const Corners& s, const W3& a, const W3& b)
{
  const W3 n = Cross(s[1] - s[0], s[2] - s[0]);
  std::vector<W3> axes = { n, Cross(n, b - a) };
  for (int i = 0; i < 3; ++i)
  {
    const W3 edge = s[(i + 1) % 3] - s[i];
    axes.push_back(Cross(n, edge));
    axes.push_back(Cross(edge, b - a));
  }
  // Along the segment itself, for one in the plane of the triangle.
  axes.push_back(b - a);
  const Corners segment = { a, b, b };
  return std::none_of(
    axes.begin(), axes.end(), [&](const W3& axis) { return Parted(s, segment, axis, false); });
}

bool Intersect(const Triangles& F, const std::vector<W3>& x, int f, int g)
{
  const Corners s = { x[F(f, 0)], x[F(f, 1)], x[F(f, 2)] };
  const Corners t = { x[F(g, 0)], x[F(g, 1)], x[F(g, 2)] };
  std::vector<int> common;
  std::vector<int> ofF;
  std::vector<int> ofG;
  for (int k = 0; k < 3; ++k)
  {
    const bool inG = (F.row(g).array() == F(f, k)).any();
    (inG ? common : ofF).push_back(F(f, k));
    if (!(F.row(f).array() == F(g, k)).any())
    {
      ofG.push_back(F(g, k));
    }
  }
  if (common.empty())
  {
    return Meet(s, t);
  }
  if (common.size() == 1)
  {
    return MeetSegment(s, x[ofG[0]], x[ofG[1]]) || MeetSegment(t, x[ofF[0]], x[ofF[1]]);
  }
  if (common.size() == 3)
  {
    return true;
  }
  const W3 edge = x[common[1]] - x[common[0]];
  const W3 n1 = Cross(edge, x[ofF[0]] - x[common[0]]);
  const W3 n2 = Cross(edge, x[ofG[0]] - x[common[0]]);
  return Cross(n1, n2) == W3{ 0, 0, 0 } && Sign(Dot(n1, n2)) > 0;
}

Pairs AllPairs(const TriangleMesh& mesh)
{
  std::vector<W3> x(mesh.P.rows());
  for (int i = 0; i < mesh.P.rows(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      x[i][k] = static_cast<Whole>(mesh.P(i, k));
      CHECK(static_cast<double>(x[i][k]) == mesh.P(i, k), "the reference needs whole numbers");
    }
  }
  Pairs pairs;
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    for (int g = f + 1; g < mesh.F.rows(); ++g)
    {
      if (Intersect(mesh.F, x, f, g))
      {
        pairs.push_back({ f, g });
      }
    }
  }
  return pairs;
}

//------------------------------------------------------------------------------------------------
void TestNone()
{
  const std::vector<Meshes::Named> meshes = { { "nothing", { Points(0, 3), Triangles(0, 3) } },
    { "tetrahedron", Meshes::Tetrahedron() }, { "ball", Meshes::Icosphere(3) },
    { "box", Meshes::Box(4) }, { "flat sheet", Meshes::Patch(6, 0.0) },
    { "three at an edge", Meshes::ThreeAtAnEdge() }, { "three sheets", Meshes::NonManifoldFan() },
    { "slivers", Meshes::Slivers() }, { "house", Meshes::House() } };
  for (const Meshes::Named& named : meshes)
  {
    CHECK(SelfIntersections(named.mesh).empty(),
      named.name << " has " << SelfIntersections(named.mesh).size() << " pairs, should have none");
  }
}

void TestByHand()
{
  // The point of a tetrahedron through one face of another: its three other faces cross that face.
  const TriangleMesh still = Meshes::Make({ { 0, 0, 0 }, { 9, 0, 0 }, { 0, 9, 0 }, { 0, 0, 9 } },
    { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } });
  const TriangleMesh spike = Meshes::Make({ { 1, 1, -5 }, { 3, 1, -5 }, { 1, 3, -5 }, { 2, 2, 1 } },
    { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } });
  const Pairs expected = { { 0, 5 }, { 0, 6 }, { 0, 7 } };
  CHECK(SelfIntersections(Together(still, spike)) == expected, "a spike through a face: its sides");
  const Meshes::Vector touching(0, 0, -1); // the tip is on the face
  CHECK(SelfIntersections(Together(still, Moved(spike, touching))).size() == 3, "a tip on a face");
  const Meshes::Vector away(0, 0, -1.0 - 1e-15);
  CHECK(SelfIntersections(Together(still, Moved(spike, away))).empty(), "a tip above a face");

  // A strip of two squares folded flat: neighbors at the fold overlap, and so do the others.
  TriangleMesh strip =
    Meshes::Make({ { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 2, 0, 0 }, { 2, 1, 0 } },
      { { 0, 2, 1 }, { 2, 3, 1 }, { 2, 4, 3 }, { 4, 5, 3 } });
  CHECK(SelfIntersections(strip).empty(), "a flat strip");
  strip.P.row(4) << 0, 0, 1e-300;
  strip.P.row(5) << 0, 1, 1e-300;
  CHECK(SelfIntersections(strip).empty(), "folded, and not quite closed");
  strip.P.row(4) << 0.25, 0, 0;
  strip.P.row(5) << 0.25, 1, 0;
  const Pairs folded = SelfIntersections(strip);
  CHECK(std::find(folded.begin(), folded.end(), std::array<int, 2>{ 1, 2 }) != folded.end(),
    "triangles folded onto each other at their common edge");
  CHECK(folded.size() == 4, "folded flat: 4 pairs, not " << folded.size());

  // Two triangles at one point: apart, touching with an edge, overlapping in their plane.
  const auto atOnePoint = [](double x, double y, double z)
  {
    return SelfIntersections(
      Meshes::Make({ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { x, y, z }, { x, y, z - 2 } },
        { { 0, 1, 2 }, { 0, 3, 4 } }))
      .size();
  };
  CHECK(atOnePoint(-1, -1, 1) == 0, "only the point in common");
  CHECK(atOnePoint(1, 1, 1) == 1, "through the other triangle");
  CHECK(atOnePoint(1, 1, 2) == 1, "an edge that ends in the other triangle");
  CHECK(atOnePoint(1, 1, 3) == 0, "beside it but for the point");
  CHECK(atOnePoint(9, 9, 1) == 1, "crossing it along a line from the point");
  const TriangleMesh twice =
    Meshes::Make({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 }, { 2, 1, 0 } });
  CHECK(SelfIntersections(twice).size() == 1, "a triangle and its back side");
  // Two boxes that share a face's plane: triangles that overlap in it intersect.
  const TriangleMesh box = Meshes::Box(1);
  CHECK(!SelfIntersections(Together(box, Moved(box, { 2, 0, 0 }))).empty(), "boxes side by side");
  CHECK(SelfIntersections(Together(box, Moved(box, { 2.125, 0, 0 }))).empty(), "boxes apart");
}

/// Whole numbers, and so few of them that touching, coplanar and collinear cases abound.
void TestAgainstAllPairs()
{
  std::size_t found = 0;
  std::set<int> shared;
  for (std::uint32_t seed = 1; seed <= 60; ++seed)
  {
    Meshes::Random random(seed);
    const int n = 14;
    const double range = seed % 3 == 0 ? 60.0 : 3.0;
    TriangleMesh mesh;
    mesh.P.resize(n, 3);
    for (double* x = mesh.P.data(); x < mesh.P.data() + mesh.P.size(); ++x)
    {
      *x = std::round(range * random.Signed());
    }
    std::vector<std::array<int, 3>> triangles;
    while (triangles.size() < 24)
    {
      const std::vector<int> order = random.Permutation(n);
      const Eigen::Vector3d a = mesh.P.row(order[1]) - mesh.P.row(order[0]);
      const Eigen::Vector3d b = mesh.P.row(order[2]) - mesh.P.row(order[0]);
      if (a.cross(b).squaredNorm() > 0.0)
      {
        triangles.push_back({ order[0], order[1], order[2] });
      }
    }
    mesh.F.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    for (std::size_t f = 0; f < triangles.size(); ++f)
    {
      mesh.F.row(static_cast<Eigen::Index>(f)) << triangles[f][0], triangles[f][1], triangles[f][2];
    }
    const Pairs expected = AllPairs(mesh);
    CHECK(SelfIntersections(mesh) == expected,
      "seed " << seed << ": " << SelfIntersections(mesh).size() << " pairs, all pairs give "
              << expected.size());
    std::vector<char> chosen(mesh.F.rows());
    std::generate(chosen.begin(), chosen.end(), [&random] { return random.Signed() > 0.5; });
    Pairs ofChosen;
    std::copy_if(expected.begin(), expected.end(), std::back_inserter(ofChosen),
      [&chosen](const auto& pair) { return chosen[pair[0]] || chosen[pair[1]]; });
    CHECK(SelfIntersections(mesh, chosen) == ofChosen, "seed " << seed << ": of a quarter");
    found += expected.size();
    for (const auto& [f, g] : expected)
    {
      int common = 0;
      for (int k = 0; k < 3; ++k)
      {
        common += (mesh.F.row(g).array() == mesh.F(f, k)).any();
      }
      shared.insert(common);
    }
  }
  CHECK(found > 1000 && shared.count(0) && shared.count(1) && shared.count(2),
    "the scenes should have pairs with 0, 1 and 2 points in common");

  // A surface: a creased ball, its points on a grid.
  TriangleMesh ball = Meshes::Icosphere(3);
  Meshes::Random random(7);
  for (int i = 0; i < ball.P.rows(); ++i)
  {
    ball.P.row(i) = (1000.0 * (1.0 + 0.25 * random.Signed()) * ball.P.row(i)).array().round();
    ball.P(i, 0) = std::abs(ball.P(i, 0)) - 300.0; // folded over: one half lies among the other
  }
  const Pairs expected = AllPairs(ball);
  CHECK(expected.size() > 500, "the ball should be creased, " << expected.size() << " pairs");
  CHECK(SelfIntersections(ball) == expected, "pairs of a creased ball");
}

void TestScales()
{
  TriangleMesh mesh =
    Together(Meshes::Icosphere(2), Moved(Meshes::Icosphere(2), { 0.7, 0.2, 0.1 }));
  const Pairs pairs = SelfIntersections(mesh);
  CHECK(pairs.size() > 50, "two balls should cross");
  for (const double scale : { std::ldexp(1.0, -300), std::ldexp(1.0, 200) })
  {
    CHECK(SelfIntersections({ scale * mesh.P, mesh.F }) == pairs, "the scale should not matter");
  }
  TriangleMesh turned = mesh;
  turned.F.col(0).swap(turned.F.col(2));
  CHECK(SelfIntersections(turned) == pairs, "nor which side is out");
}
}

int main()
{
  TestNone();
  TestByHand();
  TestAgainstAllPairs();
  TestScales();
  return CheckResult();
}
