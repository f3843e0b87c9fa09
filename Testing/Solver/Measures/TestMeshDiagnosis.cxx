// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Defects made by hand are counted and found where they are, sound meshes have none, and nothing of
// it depends on place and scale. [diagnosis]
#include "Check.h"
#include "MeshDiagnosis.h"
#include "MeshQuality.h"
#include "Meshes.h"

#include <algorithm>
#include <initializer_list>
#include <limits>

using namespace SphericalStyle;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinite = std::numeric_limits<double>::infinity();

struct Expected
{
  Defect defect;
  int count;
  int first;
};

/// The diagnosis has the findings given and no others; counts of points and triangles are those of
/// the marks. @param also  bits that may be there besides
MeshDiagnosis CheckFindings(const std::string& about, const TriangleMesh& mesh,
  const std::vector<Expected>& expected, unsigned also = 0, const DiagnosisOptions& options = {})
{
  MeshDiagnosis d = Diagnose(mesh.P, mesh.F, options);
  CHECK(d.pointMarks.size() == static_cast<std::size_t>(mesh.P.rows()) &&
      d.triangleMarks.size() == static_cast<std::size_t>(mesh.F.rows()) &&
      d.components.size() == d.triangleMarks.size(),
    about << ": there should be marks for all");
  for (int k = 0; k < NumberOfDefects; ++k)
  {
    const auto defect = static_cast<Defect>(k);
    if ((also & Bit(defect)) != 0)
    {
      continue;
    }
    Expected should = { defect, 0, -1 };
    for (const Expected& e : expected)
    {
      should = e.defect == defect ? e : should;
    }
    CHECK(d[defect].count == should.count && d[defect].first == should.first,
      about << ": defect " << k << " should be found " << should.count << " times, first at "
            << should.first << ", and is " << d[defect].count << " times, first at "
            << d[defect].first);
    const auto& marks = IsOfPoints(defect) ? d.pointMarks : d.triangleMarks;
    const auto marked = std::count_if(
      marks.begin(), marks.end(), [defect](unsigned mark) { return (mark & Bit(defect)) != 0; });
    CHECK((marked > 0) == (should.count > 0), about << ": defect " << k << " should be marked");
    CHECK(defect > Defect::ObtuseTriangles || marked == should.count,
      about << ": defect " << k << " marks " << marked << " of " << should.count);
  }
  return d;
}

constexpr unsigned Angles = Bit(Defect::ObtuseTriangles) | Bit(Defect::NegativeWeights);
constexpr unsigned Border = Bit(Defect::BorderEdges);

TriangleMesh WithPoint(TriangleMesh mesh, double x, double y, double z)
{
  mesh.P.conservativeResize(mesh.P.rows() + 1, 3);
  mesh.P.bottomRows<1>() << x, y, z;
  return mesh;
}

TriangleMesh WithTriangle(TriangleMesh mesh, int a, int b, int c)
{
  mesh.F.conservativeResize(mesh.F.rows() + 1, 3);
  mesh.F.bottomRows<1>() << a, b, c;
  return mesh;
}

TriangleMesh InsideOut(TriangleMesh mesh)
{
  mesh.F.col(1).swap(mesh.F.col(2));
  return mesh;
}

void TestSound()
{
  for (const TriangleMesh& mesh : { Meshes::Icosphere(2), Meshes::Box(4) })
  {
    const MeshDiagnosis d = CheckFindings("sound", mesh, {});
    CHECK(d.parts.count == 1 && d.parts.first == -1 && d.borderLoops.count == 0,
      "one part without border");
    CHECK(d.usableTriangles == mesh.F.rows() && d.points == mesh.P.rows() &&
        d.edges * 2 == mesh.F.rows() * 3,
      "all should be used");
    CHECK_NEAR(d.diagonal, Meshes::Diagonal(mesh.P), 1e-15, "diagonal");
    CHECK_NEAR(d.largest, 1.0, 1e-15, "largest coordinate");
  }
}

void TestPoints()
{
  const TriangleMesh ball = Meshes::Icosphere(1); // 42 points
  CheckFindings("unused", WithPoint(ball, 9, 9, 9), { { Defect::UnusedPoints, 1, 42 } });
  CheckFindings("on another", WithPoint(ball, ball.P(7, 0), ball.P(7, 1), ball.P(7, 2)),
    { { Defect::CoincidentPoints, 1, 42 } });
  DiagnosisOptions apart;
  apart.weld = false;
  CheckFindings("on another, not welded", WithPoint(ball, ball.P(7, 0), ball.P(7, 1), ball.P(7, 2)),
    { { Defect::CoincidentPoints, 1, 42 }, { Defect::UnusedPoints, 1, 42 } }, 0, apart);
  for (const double bad : { NaN, Infinite, -Infinite })
  {
    const MeshDiagnosis alone = CheckFindings("not finite, unused",
      WithPoint(WithPoint(ball, 0, bad, 0), bad, 0, 0), { { Defect::NonFinitePoints, 2, 42 } });
    CHECK(alone.usableTriangles == 80, "nothing of the surface is lost");
    TriangleMesh hole = ball;
    hole.P(0, 2) = bad; // of five triangles
    const MeshDiagnosis d =
      CheckFindings("not finite, used", hole, { { Defect::NonFinitePoints, 1, 0 } }, Border);
    CHECK(d.usableTriangles == 75 && d.borderLoops.count == 1 && d[Defect::BorderEdges].count == 5,
      "five triangles should be missing");
    CHECK(std::isfinite(d.diagonal), "the diagonal should be of finite points");
  }
  // 0 and -0 are one place.
  const TriangleMesh zeros =
    Meshes::Make({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 1, 0 }, { -0.0, 0, -0.0 }, { 0.5, -1, 0 } },
      { { 0, 1, 2 }, { 1, 3, 4 } });
  CheckFindings("zeros", zeros, { { Defect::CoincidentPoints, 1, 3 } }, Border | Angles);
}

void TestTriangles()
{
  const TriangleMesh ball = Meshes::Icosphere(1);
  CheckFindings(
    "a point twice", WithTriangle(ball, 3, 3, 5), { { Defect::DegenerateTriangles, 1, 80 } });
  const TriangleMesh line =
    Meshes::Make({ { 0, 0, 0 }, { 1, 1, 1 }, { 3, 3, 3 } }, { { 0, 1, 2 } });
  const MeshDiagnosis none = CheckFindings(
    "a line", line, { { Defect::DegenerateTriangles, 1, 0 }, { Defect::UnusedPoints, 3, 0 } });
  CHECK(none.usableTriangles == 0 && none.diagonal == 0.0 && none.components[0] == -1,
    "nothing should be left");

  // The same once more turns every edge of it into one of three triangles.
  for (const bool turned : { false, true })
  {
    const auto t = ball.F.row(4);
    const TriangleMesh twice =
      turned ? WithTriangle(ball, t(2), t(1), t(0)) : WithTriangle(ball, t(1), t(2), t(0));
    CheckFindings("twice", twice,
      { { Defect::DuplicateTriangles, 1, 80 }, { Defect::NonManifoldEdges, 3, 4 } },
      Bit(Defect::NonManifoldEdges));
    CHECK(Diagnose(twice.P, twice.F)[Defect::NonManifoldEdges].count == 3, "three edges");
  }

  // Smallest angle of a triangle of height h over base 1: atan(2 h).
  for (const double degrees : { 0.9, 1.1 })
  {
    const double h = 0.5 * std::tan(degrees * Pi / 180.0);
    const TriangleMesh thin =
      Meshes::Make({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, h, 0 } }, { { 0, 1, 2 } });
    const int slivers = degrees < 1.0 ? 1 : 0;
    CheckFindings("thin", thin,
      { { Defect::Slivers, slivers, slivers - 1 }, { Defect::ObtuseTriangles, 1, 0 },
        { Defect::NegativeWeights, 1, 0 }, { Defect::BorderEdges, 3, 0 } });
  }
}

void TestEdgesAndFans()
{
  CheckFindings("one triangle",
    Meshes::Make({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 1, 0 } }, { { 0, 1, 2 } }),
    { { Defect::BorderEdges, 3, 0 } });
  TriangleMesh turned = Meshes::Icosphere(1);
  std::swap(turned.F(9, 0), turned.F(9, 1));
  const MeshDiagnosis d = CheckFindings("one turned round", turned,
    { { Defect::MisorientedEdges, 3, 0 } }, Bit(Defect::MisorientedEdges));
  CHECK(d[Defect::MisorientedEdges].count == 3, "its three edges");
  CHECK((d.triangleMarks[9] & Bit(Defect::MisorientedEdges)) != 0, "it should be marked");

  // Two tetrahedra: point 2 of the second is on point 1 of the first.
  const TriangleMesh tetrahedron = Meshes::Tetrahedron();
  const TriangleMesh tie =
    Meshes::Together({ tetrahedron, Meshes::Moved(tetrahedron, { 2, -2, 0 }) });
  const MeshDiagnosis bow = CheckFindings("bow-tie", tie,
    { { Defect::NonManifoldPoints, 1, 1 }, { Defect::CoincidentPoints, 1, 6 } },
    Bit(Defect::NonManifoldPoints));
  CHECK(bow[Defect::NonManifoldPoints].count == 1 && bow[Defect::NonManifoldPoints].first == 1,
    "one place");
  CHECK((bow.pointMarks[6] & Bit(Defect::NonManifoldPoints)) != 0, "marked on both points there");
  CHECK(bow.parts.count == 1, "they hang together by it");
  DiagnosisOptions apart;
  apart.weld = false;
  CHECK(Diagnose(tie.P, tie.F, apart).parts.count == 2 &&
      Diagnose(tie.P, tie.F, apart)[Defect::NonManifoldPoints].count == 0,
    "and not without welding");

  const MeshDiagnosis fan = Diagnose(Meshes::ThreeAtAnEdge().P, Meshes::ThreeAtAnEdge().F);
  CHECK(fan[Defect::NonManifoldEdges].count == 1 && fan[Defect::NonManifoldPoints].count == 0,
    "three at an edge hang together");
}

void TestBordersAndParts()
{
  const TriangleMesh patch = Meshes::Patch(6, 0.3);
  const MeshDiagnosis open = Diagnose(patch.P, patch.F);
  CHECK(open.borderLoops.count == 1 && open.borderLoops.first == 0, "a patch has one border");
  // Two triangles that do not touch taken out of a ball.
  TriangleMesh holes = Meshes::Icosphere(2);
  holes.F.row(0).setZero();
  holes.F.bottomRows<1>().setZero();
  const MeshDiagnosis two = Diagnose(holes.P, holes.F);
  CHECK(two.borderLoops.count == 2 && two[Defect::BorderEdges].count == 6 &&
      two[Defect::DegenerateTriangles].count == 2,
    "two holes of three edges");

  const TriangleMesh parts =
    Meshes::Together({ Meshes::Icosphere(1), Meshes::Moved(Meshes::Icosphere(0), { 0, 0, 9 }),
      Meshes::Moved(Meshes::Icosphere(0), { 5, 0, 0 }) });
  const MeshDiagnosis three = Diagnose(parts.P, parts.F);
  CHECK(three.parts.count == 3 && three.parts.first == 80 && three.components[80] == 1 &&
      three.components[100] == 2,
    "three parts");

  // Many edges at once, against the counts of the measures.
  const TriangleMesh mixed = Meshes::Together(
    { Meshes::NonManifoldFan(), patch, Meshes::Moved(Meshes::Slivers(), { 9, 0, 0 }) });
  DiagnosisOptions apart;
  apart.weld = false;
  const MeshDiagnosis d = Diagnose(mixed.P, mixed.F, apart);
  const MeshEdges edges(mixed.F);
  const EdgeCounts counts = CountEdges(mixed.F, edges);
  CHECK(d.edges == edges.GetNumberOfEdges() && d[Defect::BorderEdges].count == counts.border &&
      d[Defect::NonManifoldEdges].count == counts.nonManifold &&
      d[Defect::MisorientedEdges].count == counts.misoriented && counts.nonManifold > 0,
    "edges should be those that are measured");
  CHECK(d[Defect::ObtuseTriangles].count == Meshes::CountObtuse(mixed), "obtuse triangles");
}

void TestInsideOut()
{
  const TriangleMesh ball = Meshes::Icosphere(1);
  const TriangleMesh inner = Meshes::Scaled(ball, { 0.5, 0.5, 0.5 });
  CheckFindings("turned", InsideOut(ball), { { Defect::InsideOutComponents, 1, 0 } });
  CheckFindings("a cavity", Meshes::Together({ ball, InsideOut(inner) }), {});
  CheckFindings("a ball in a ball", Meshes::Together({ ball, inner }), {});
  CheckFindings("beside", Meshes::Together({ ball, Meshes::Moved(InsideOut(inner), { 3, 0, 0 }) }),
    { { Defect::InsideOutComponents, 1, 80 } });
  // Within the bounds, but not within.
  CheckFindings("in the corner of the bounds",
    Meshes::Together({ ball,
      Meshes::Moved(InsideOut(Meshes::Scaled(ball, { 0.1, 0.1, 0.1 })), { 0.8, 0.8, 0.8 }) }),
    { { Defect::InsideOutComponents, 1, 80 } });
  // Along z from any point there are edges and points of the others.
  const TriangleMesh cube = Meshes::Box(2);
  const auto scaled = [&cube](double by) { return Meshes::Scaled(cube, { by, by, by }); };
  CheckFindings(
    "cubes", Meshes::Together({ scaled(4.0), InsideOut(scaled(2.0)), scaled(1.0) }), {});
  CheckFindings("an island that is turned",
    Meshes::Together({ scaled(4.0), InsideOut(scaled(2.0)), InsideOut(cube) }),
    { { Defect::InsideOutComponents, 1, 2 * static_cast<int>(cube.F.rows()) } });
  // A foam: every hole is one.
  std::vector<TriangleMesh> foam = { scaled(20.0) };
  for (int i = 0; i < 1000; ++i)
  {
    const Meshes::Vector place(i % 10, i / 10 % 10, i / 100);
    foam.push_back(Meshes::Moved(
      InsideOut(i % 2 == 0 ? cube : ball), 3.5 * (place - Meshes::Vector::Constant(4.5))));
  }
  CheckFindings("foam", Meshes::Together(foam), {});
  foam.front() = InsideOut(foam.front());
  CHECK(Diagnose(Meshes::Together(foam).P, Meshes::Together(foam).F)[Defect::InsideOutComponents]
          .count == 1001,
    "without a shell");
  TriangleMesh open = InsideOut(ball);
  open.F.conservativeResize(79, 3);
  CHECK(Diagnose(open.P, open.F)[Defect::InsideOutComponents].count == 0, "open: nobody can tell");
  const TriangleMesh pillow =
    Meshes::Make({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.4, 1, 0 } }, { { 0, 2, 1 }, { 0, 1, 2 } });
  CHECK(Diagnose(pillow.P, pillow.F)[Defect::InsideOutComponents].count == 0, "flat: no inside");
}

void TestScales()
{
  TriangleMesh mesh = Meshes::Together({ Meshes::Slivers(), Meshes::NonManifoldFan() });
  const MeshDiagnosis plain = Diagnose(mesh.P, mesh.F);
  CHECK(plain[Defect::ObtuseTriangles].count > 0, "the test should have something to find");
  for (const int power : { -900, -99, 99, 900 })
  {
    TriangleMesh scaled = mesh;
    scaled.P *= std::ldexp(1.0, power); // exact
    const MeshDiagnosis d = Diagnose(scaled.P, scaled.F);
    CHECK(d.pointMarks == plain.pointMarks && d.triangleMarks == plain.triangleMarks,
      "marks should not depend on the scale 2^" << power);
    CHECK_NEAR(d.diagonal / std::ldexp(plain.diagonal, power), 1.0, 1e-15, "diagonal");
  }
  // As far apart as numbers can be.
  const double far = std::numeric_limits<double>::max();
  const TriangleMesh widest =
    Meshes::Make({ { -far, 0, 0 }, { far, 0, 0 }, { 0, far, far } }, { { 0, 1, 2 } });
  CHECK(Diagnose(widest.P, widest.F).usableTriangles == 0, "no length of it is a number");

  CHECK_NEAR(DigitsLeft(1.0, 1e-7), 7.0, 1e-12, "digits");
  CHECK_NEAR(DigitsLeft(1e-300, 5e-324), 23.306, 1e-3, "digits of the smallest numbers");
  CHECK(DigitsLeft(1.0, 2.0) == 0.0 && DigitsLeft(0.0, 0.0) == 0.0, "none left");
}

void TestRefused()
{
  const TriangleMesh ball = Meshes::Icosphere(0);
  CHECK(Diagnose(Points(0, 3), Triangles(0, 3)).parts.count == 0, "nothing is sound");
  CHECK_THROWS(std::invalid_argument, Diagnose(ball.P, WithTriangle(ball, 0, 1, 12).F), "20");
  CHECK_THROWS(std::invalid_argument, Diagnose(ball.P, WithTriangle(ball, 0, -1, 2).F), "20");
}
}

int main()
{
  TestSound();
  TestPoints();
  TestTriangles();
  TestEdgesAndFans();
  TestBordersAndParts();
  TestInsideOut();
  TestScales();
  TestRefused();
  return CheckResult();
}
