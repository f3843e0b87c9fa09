// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Facts by hand, the order of the advice, and for each advice a mesh that gets it and no longer
/// does once it is followed.
#include "Advice.h"
#include "Check.h"
#include "Meshes.h"

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
MethodOptions Defaults()
{
  MethodOptions options;
  options.sphericalWeighting = SphericalWeighting::Cotangent;
  options.centerMode = CenterMode::AreaCentroid;
  options.normalRadius = NormalRadius::WholeModel;
  return options;
}

struct Outcome
{
  SurfaceFacts surface;
  ResultFacts result;
  std::string advice;
};

Outcome Run(const TriangleMesh& mesh, const MethodOptions& options)
{
  SphericalStyleMethod method;
  method.SetMesh(mesh);
  const StyleReport report = method.Solve(options);
  Outcome outcome;
  outcome.surface = MeasureSurface(mesh, report.components);
  outcome.result = MeasureResult(mesh, outcome.surface, method.GetPositions(), options, report);
  outcome.advice = Advise(options, outcome.surface, outcome.result, {});
  return outcome;
}

/// The advice must begin with `expected` and must hold the figure; after `follow` it is gone.
template <typename Follow>
void ExpectAdvice(const char* about, const TriangleMesh& mesh, MethodOptions options,
  const std::string& expected, const std::string& figure, const Follow& follow)
{
  const Outcome before = Run(mesh, options);
  CHECK(before.advice.rfind(expected + ": ", 0) == 0,
    about << ": '" << expected << "' should be advised, not '" << before.advice << "'");
  CHECK(before.advice.find(figure) != std::string::npos &&
      before.advice.find('\n') == std::string::npos,
    about << ": '" << before.advice << "' should say " << figure << " in one line");
  follow(options);
  const Outcome after = Run(mesh, options);
  CHECK(after.advice.rfind(expected, 0) != 0,
    about << ": followed, the advice should be gone and is '" << after.advice << "'");
}

/// Two balls that run into each other at a waist of radius 0.2: concave, star-shaped around 0.
TriangleMesh Peanut()
{
  TriangleMesh mesh = Meshes::Icosphere(4);
  for (int i = 0; i < mesh.P.rows(); ++i)
  {
    const double z = mesh.P(i, 2);
    mesh.P.row(i) *= 0.2 + 0.8 * z * z;
  }
  return mesh;
}

/// Two balls four radii from the origin, on a bar through it: three eighths of each face away.
TriangleMesh Dumbbell()
{
  std::vector<std::array<double, 2>> profile = { { 0.0, 5.0 } };
  for (int j = 1; j < 30; ++j) // the upper ball down to the bar
  {
    const double a = (Meshes::Pi - 0.1) * j / 29;
    profile.push_back({ std::sin(a), 4.0 + std::cos(a) });
  }
  const std::array<double, 2> end = profile.back();
  for (int j = 1; j < 20; ++j)
  {
    profile.push_back({ end[0], (1.0 - j / 10.0) * end[1] });
  }
  for (int j = 29; j >= 0; --j)
  {
    profile.push_back({ profile[j][0], -profile[j][1] });
  }
  return Meshes::Revolved(profile, 32);
}

/// A ball with bumps, of many times the curvature of a ball.
TriangleMesh Bumpy()
{
  TriangleMesh mesh = Meshes::Icosphere(5);
  for (int i = 0; i < mesh.P.rows(); ++i)
  {
    const Vector3d p = mesh.P.row(i);
    mesh.P.row(i) *=
      1.0 + 0.03 * std::sin(25.0 * p.x()) * std::sin(25.0 * p.y()) * std::sin(25.0 * p.z());
  }
  return mesh;
}

void TestSurfaceFacts()
{
  // Box of half edges 1, 2, 3: right angles and diagonals, all edges long, areas 2, 3 and 6
  // times 2.
  const SurfaceFacts box = MeasureSurface(Meshes::Box(1, { 1, 2, 3 }), 1);
  CHECK(
    box.obtuseShare == 0.0 && box.longEdgeShare == 1.0, "a box has no obtuse triangle, long edges");
  CHECK_NEAR(box.curvature, 1.0, 1e-14, "curvature of a convex body");
  CHECK_NEAR(box.cornerShare, 1.0, 1e-14, "all curvature of a box is in its corners");
  const Eigen::Array3d logarithms(std::log(2.0), std::log(3.0), std::log(6.0));
  CHECK_NEAR(box.areaFactor, std::exp(std::sqrt((logarithms - logarithms.mean()).square().mean())),
    1e-13, "areas of a box");
  const SurfaceFacts fine = MeasureSurface(Meshes::Box(40, { 1, 2, 3 }), 1);
  CHECK_NEAR(fine.cornerShare, 1.0, 1e-9, "and so it is however fine the box");
  CHECK(MeasureSurface(Meshes::Icosphere(2), 1).cornerShare == 0.0, "a ball has no corners");
  CHECK_NEAR(fine.boxEdges, 4.0 * (2.0 + 4.0 + 6.0) / std::sqrt(88.0), 0.2, "sharp edges of a box");
  CHECK(fine.planarShare > 0.95 && fine.border == 0.0, "faces of a box");
  CHECK(fine.longEdgeShare == 0.0, "a fine box has no long edges: " << fine.longEdgeShare);
  // Integral of x^2 over the faces of a box of half edges 1, 2, 3, over 8, axis by axis.
  const auto moment = [](double a, double b, double c)
  { return a * a * b * c + a * a * a / 3.0 * (b + c); };
  CHECK_NEAR(
    fine.elongation, std::sqrt(moment(3, 1, 2) / moment(2, 1, 3)), 1e-12, "how long a box is");
  CHECK_NEAR(MeasureSurface(Meshes::Box(24), 1).elongation, 1.0, 1e-12, "how long a cube is");

  const TriangleMesh house = Meshes::House();
  CHECK_NEAR(MeasureSurface(house, 1).obtuseShare,
    static_cast<double>(Meshes::CountObtuse(house)) / static_cast<double>(house.F.rows()), 1e-15,
    "obtuse triangles of the house");
  StyleSolver solver;
  solver.SetMesh(Meshes::TwoComponents());
  CHECK(solver.Solve({}).components == 2, "two parts");
  // Border points have no curvature: what is left of a flat sheet is 0.
  CHECK_NEAR(MeasureSurface(Meshes::Patch(8, 0.0), 1).curvature, 0.0, 1e-12, "a flat sheet");
  CHECK_NEAR(MeasureSurface(Meshes::Ellipsoid(4), 1).curvature, 1.0, 1e-12, "a convex body");
  CHECK(MeasureSurface(Bumpy(), 1).curvature > 10.0, "bumps are bent");
  const TriangleMesh moved = { (1e3 * Bumpy().P).rowwise() + Eigen::RowVector3d(1e4, 0, 0),
    Bumpy().F };
  CHECK_NEAR(MeasureSurface(moved, 1).curvature, MeasureSurface(Bumpy(), 1).curvature, 1e-6,
    "moved and scaled");
}

void TestModelFacts()
{
  // Two rings of squares around a box: see TestCreases for its angles.
  const ModelFacts box = MeasureModel(Meshes::Box(2), false);
  CHECK(box.points == 26 && box.isSubdividable, "a box of 26 points");
  CHECK_NEAR(box.meanAngle, 0.5 * Pi * 12.0 / 36.0, 1e-12, "angles of a box");
  CHECK(!MeasureModel(Meshes::Box(2), true).isSubdividable, "points that coincide");
  CHECK(!MeasureModel(Meshes::ThreeAtAnEdge(), false).isSubdividable, "three at an edge");
  CHECK_NEAR(box.planarShare, 24.0 / 36.0, 1e-12, "edges within faces of a box");
  CHECK(MeasureModel(Meshes::Icosphere(4), false).points == 2562, "2562 points");
  CHECK(MeasureModel(Meshes::Icosphere(5), false).points == 0, "10242 points are many");
}

void TestCenterFacts()
{
  MethodOptions options = Defaults();
  options.centerMode = CenterMode::Custom;
  const TriangleMesh ball = Meshes::Icosphere(5);
  TriangleMesh insideOut = ball;
  insideOut.F = ball.F.rowwise().reverse().eval();
  for (const TriangleMesh& mesh : { ball, insideOut })
  {
    // From two radii away a ball shows the quarter of its area that is nearer than a polar angle of
    // 60 degrees; the normals there point toward O.
    options.custom.center = { 0.0, 0.0, 2.0 };
    const ResultFacts outside = Run(mesh, options).result;
    CHECK(outside.centerOutside, "two radii away is outside");
    CHECK_NEAR(outside.facingAwayShare, 0.25, 0.01, "what faces O");
    options.custom.center = { 0.0, 0.3, 0.9 };
    const ResultFacts inside = Run(mesh, options).result;
    CHECK(!inside.centerOutside && inside.facingAwayShare == 0.0, "nothing faces O from inside");
  }
  // An open surface has no outside.
  options.custom.center = { 0.0, 0.0, 9.0 };
  CHECK(!Run(Meshes::Patch(8, 0.3), options).result.centerOutside, "a sheet has no outside");
}

void TestNothingToAdvise()
{
  for (const Meshes::Named& m :
    { Meshes::Named{ "ball", Meshes::Icosphere(3) },
      Meshes::Named{ "ellipsoid", Meshes::Ellipsoid(3) }, Meshes::Named{ "box", Meshes::Box(20) },
      Meshes::Named{ "peanut", Peanut() }, Meshes::Named{ "bumps", Bumpy() } })
  {
    const std::string advice = Run(m.mesh, Defaults()).advice;
    CHECK(advice.empty(), m.name << " with defaults: '" << advice << "'");
  }
  // Without details kept they flatten: that is what DetailSize 0 is chosen for.
  for (const double lambda : { 0.0, 5.0 })
  {
    MethodOptions options = Defaults();
    options.lambda = lambda;
    const std::string advice = Run(Bumpy(), options).advice;
    CHECK(advice.empty(), "bumps at lambda " << lambda << ": '" << advice << "'");
  }
}

void TestEachAdvice()
{
  MethodOptions options = Defaults();
  options.normalBlend = 1.0;
  ExpectAdvice("normals as targets without details", Peanut(), options, "DetailSize 0.06",
    " % of the triangles", [](MethodOptions& o) { o.detailSize = 0.06; });
  options.detailSize = 0.06;
  options.lambda = 5.0;
  ExpectAdvice("normals as targets", Dumbbell(), options, "NormalBlend 0.3", " % of the triangles",
    [](MethodOptions& o) { o.normalBlend = 0.3; });
  options.normalBlends = Eigen::VectorXd::Ones(Dumbbell().P.rows());
  ExpectAdvice("normals by array", Dumbbell(), options, "AvoidSelfIntersections On",
    " % of the triangles", [](MethodOptions& o) { o.normalBlends *= 0.0; });

  options = Defaults();
  options.centerMode = CenterMode::Custom;
  options.custom.center = { 0.0, 0.0, 2.0 };
  ExpectAdvice("O outside", Meshes::Icosphere(3), options, "CenterMode AreaCentroid", "outside",
    [](MethodOptions& o) { o.centerMode = CenterMode::AreaCentroid; });
  const auto outside = Run(Meshes::Cup(0.1), options).result;
  CHECK(outside.centerOutside && outside.centroidOutside, "the centroid of a cup is in its hollow");

  options = Defaults();
  options.sphericalWeighting = SphericalWeighting::Uniform;
  const auto cotangent = [](MethodOptions& o)
  { o.sphericalWeighting = SphericalWeighting::Cotangent; };
  const TriangleMesh house = Meshes::House();
  ExpectAdvice("obtuse triangles", house, options, "SphericalWeighting Cotangent",
    std::to_string(std::lround(100.0 * Meshes::CountObtuse(house) / house.F.rows())) +
      " % of the triangles are obtuse",
    cotangent);
  // Rings that crowd together toward one end, of right triangles.
  TriangleMesh uneven = Meshes::Box(12);
  uneven.P = (uneven.P.array() + 1.05).pow(3.0).matrix().eval();
  ExpectAdvice("uneven triangles", uneven, options, "SphericalWeighting Cotangent", "", cotangent);

  options = Defaults();
  const auto limbs = [](MethodOptions& o) { o.normalBlend = 0.6; };
  ExpectAdvice("a cup around O", Meshes::Cup(0.1), options, "NormalBlend 0.6", "outside", limbs);
  ExpectAdvice("two balls on a bar", Dumbbell(), options, "NormalBlend 0.6",
    " % of the surface faces away", limbs);
}

/// Facts and options that bring every advice at once: the most important is given, and one goes
/// after the other in a fixed order.
void TestOrder()
{
  MethodOptions options;
  options.lambda = 5.0;
  options.normalBlend = 0.5;
  options.edgeWeighting = EdgeWeighting::FullEdge;
  SurfaceFacts surface;
  surface.obtuseShare = 0.534;
  surface.areaFactor = 4.2;
  surface.longEdgeShare = 0.55;
  surface.curvature = 30.0;
  surface.components = 19;
  ResultFacts result;
  result.centerOutside = true;
  result.facingAwayShare = 0.46;
  result.turnedOverShare = 0.123;
  AdviceChoices choices;
  const auto expect = [&](const std::string& advice)
  {
    const std::string given = Advise(options, surface, result, choices);
    CHECK(given == advice, "'" << advice << "' should be advised, not '" << given << "'");
  };
  expect("DetailSize 0.06: 12 % of the triangles turned over");
  options.detailSize = 0.06;
  expect("NormalBlend 0.3: 12 % of the triangles turned over");
  options.normalBlend = 0.3;
  expect("EdgeWeighting HalfEdge: 12 % of the triangles turned over");
  options.edgeWeighting = EdgeWeighting::HalfEdge;
  expect("ComponentCoupling Stitched: 19 parts share no edge");
  options.componentCoupling = ComponentCoupling::Stitched;
  options.centerMode = CenterMode::Custom;
  expect("CenterMode AreaCentroid: Center lies outside of the model");
  result.centroidOutside = true;
  options.normalBlend = 0.0;
  expect("NormalBlend 0.6: the center lies outside of the model");
  options.centerMode = CenterMode::AreaCentroid;
  options.normalBlend = 0.0;
  expect("NormalBlend 0.6: the center lies outside of the model");
  result.centerOutside = false;
  expect("AvoidSelfIntersections On: 12 % of the triangles turned over");
  choices.canAvoidFolds = false;
  expect("Roundness 2.5: 12 % of the triangles turned over");
  choices.canAvoidFolds = true;
  choices.avoidsFolds = true;
  expect("Roundness 2.5: 12 % of the triangles turned over");
  options.lambda = 0.8;
  expect("Roundness 0.5: 12 % of the triangles turned over");
  options.lambda = 0.5; // there is no less
  options.normalBlend = 0.2;
  result.creasedShare = 0.034;
  expect("SphericalWeighting Cotangent: 53 % of the triangles are obtuse"); // there is no less
  options.lambda = 1.2;
  result.turnedOverShare = 0.0;
  choices.avoidsFolds = false;
  expect("SphericalWeighting Cotangent: 53 % of the triangles are obtuse"); // it is closed
  choices.avoidsFolds = true;
  options.lambda = 0.5;
  result.turnedOverShare = 0.123;
  surface.border = 1.0;
  expect("NormalBlend 0: this open shell crumples when rounded limb by limb, on 3 % of its area");
  result.blendsByArray = true;
  expect("SphericalWeighting Cotangent: 53 % of the triangles are obtuse");
  result.blendsByArray = false;
  options.normalBlend = 0.0;
  expect("SphericalWeighting Cotangent: 53 % of the triangles are obtuse");
  surface.obtuseShare = 0.1;
  expect("SphericalWeighting Cotangent: areas of triangles differ by a factor of 4");
  options.sphericalWeighting = SphericalWeighting::Cotangent;
  expect("RefineLongEdges On: 55 % of the area has edges above a tenth of the diagonal");
  choices.refine = false;
  expect("MaximumEdgeLength 0.04: 55 % of the area has edges above a tenth of the diagonal");
  surface.longEdgeShare = 0.04;
  surface.curvature = 1.5;
  expect("NormalBlend 0.6: 46 % of the surface faces away from the center");
  result.facingAwayShare = 0.2;
  expect("");
  result.creasedShare = 0.0;
  surface.border = 0.0;
  // Faces of a body that is simple. What was advised against is not advised where triangles turn
  // over without it.
  surface.planarShare = 0.67;
  surface.boxEdges = 1.0;
  options.detailSize = 0.0;
  expect("");
  result.turnedOverShare = 0.123;
  expect("");
  result.turnedOverShare = 0.0;
  options.detailSize = 0.06;
  options.normalBlend = 0.6;
  expect("NormalBlend 0: 67 % of the area is flat faces with sharp edges, which stay flat when "
         "rounded limb by limb");
  result.blendsByArray = true;
  const std::string edges =
    "DetailSize 0: 67 % of the area is flat faces with sharp edges, which stay sharp as details";
  expect(edges);
  result.blendsByArray = false;
  surface.elongation = 2.9;
  options.normalBlend = 0.0;
  expect(edges);
  surface.elongation = 3.0;
  expect(
    "Target Ellipsoid: the model is 3 times as long as wide, so a ball is a bulge in its middle");
  options.shape.kind = TargetKind::Ellipsoid;
  expect(edges);
  options.shape.kind = TargetKind::Sphere;
  options.targets = Points::Zero(1, 3); // directions of one's own take no other target
  expect(edges);
  options.targets.resize(0, 3);
  surface.elongation = 1.0;
  surface.curvature = 2.0;
  expect("");
  surface.cornerShare = 0.25; // of a machine part
  expect(edges);
  surface.curvature = 5.0;
  expect("");
  surface.curvature = 1.5;
  surface.cornerShare = 0.0;
  surface.border = 1.0;
  expect("");
  surface.border = 0.9;
  surface.boxEdges = 0.99;
  expect("");
  surface.boxEdges = 1.0;
  surface.planarShare = 0.49;
  expect("");
  ModelFacts& model = choices.model;
  model.points = 1499;
  model.isSubdividable = true;
  expect("");
  model.meanAngle = 0.14;
  expect("Input LoopSubdivision: the model has only 1499 points, so its outline stays angular");
  model.isSubdividable = false;
  expect("The model has only 1499 points, so its outline stays angular. A subdivision surface "
         "makes it smooth, in a modeling program: some of its edges have three faces, or points "
         "that coincide");
  model.isSubdividable = true;
  model.points = 1500;
  model.meanAngle = 0.34;
  expect("");
  model.meanAngle = 0.35; // 20 degrees
  model.planarShare = 0.24;
  expect("Input LoopSubdivision: the model has only 1500 points, so its outline stays angular");
  model.planarShare = 0.25; // a device
  expect("");
  model.points = 1499;
  expect("Input LoopSubdivision: the model has only 1499 points, so its outline stays angular");
  surface.planarShare = 0.5;
  surface.boxEdges = 1.0;
  surface.border = 0.0;
  options.detailSize = 0.0; // and that was advised
  expect("");
  surface.planarShare = 0.4;
  surface.boxEdges = 1.0; // drawn of panels
  choices.splitShare = 0.5;
  expect("");
}
}

int main()
{
  TestSurfaceFacts();
  TestModelFacts();
  TestCenterFacts();
  TestNothingToAdvise();
  TestEachAdvice();
  TestOrder();
  return CheckResult();
}
