// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The style in closed form against a second implementation with dense matrices, and what it
// promises: nothing with lambda 0, no dependence on place, size, numbering and threads, mirrored
// results of mirrored models, and next to none on directions of space and on triangles.
#include "Check.h"
#include "ClosedFormReference.h"
#include "Meshes.h"
#include "SurfaceGrid.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <map>
#include <string>

using namespace SphericalStyle;

namespace
{
using Meshes::Vector;

MethodOptions Closed(double lambda, double normalBlend, double detailSize)
{
  MethodOptions o;
  o.sphericalWeighting = SphericalWeighting::Cotangent;
  o.centerMode = CenterMode::AreaCentroid;
  o.lambda = lambda;
  o.normalBlend = normalBlend;
  o.detailSize = detailSize;
  return o;
}

Points Deformed(const TriangleMesh& mesh, const MethodOptions& options)
{
  SphericalStyleMethod method;
  method.SetMesh(mesh);
  const StyleReport report = method.Solve(options);
  CHECK(report.closedForm, "a solve that should be in closed form was not");
  return method.GetPositions();
}

/// A bent body with bumps; nothing of it is symmetric.
TriangleMesh Body(int level)
{
  TriangleMesh mesh = Meshes::Scaled(Meshes::Icosphere(level), { 1.0, 0.24, 0.19 });
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    const double x = mesh.P(i, 0);
    const double bump = 1.0 + 0.06 * std::sin(19.0 * x + 31.0 * mesh.P(i, 1) + 0.5);
    mesh.P.row(i).tail<2>() *= bump * (1.0 + 0.35 * std::sin(4.0 * x + 0.3));
    mesh.P(i, 1) += 0.12 * x * x;
    mesh.P(i, 0) += 0.03 * std::cos(7.0 * mesh.P(i, 2));
  }
  return mesh;
}

Eigen::Matrix3d TurnedTwice()
{
  return (Eigen::AngleAxisd(Meshes::Pi / 6.0, Vector::UnitX()) *
    Eigen::AngleAxisd(Meshes::Pi * 40.0 / 180.0, Vector::UnitY()))
    .toRotationMatrix();
}

double Rms(const Points& A, const Points& B)
{
  return std::sqrt((A - B).rowwise().squaredNorm().mean());
}

//------------------------------------------------------------------------------------------------
// Coordinates without order: no quadrature point lies on the border of a sub-cell.
std::vector<Meshes::Named> SmallMeshes()
{
  using namespace Meshes;
  return { { "body", Perturbed(Body(2), 0.013, 11) },
    { "sheet",
      Turned(Perturbed(Scaled(Patch(9, 0.3), { 1.0, 0.35, 1.0 }), 0.01, 3), Random(8).Rotation()) },
    { "two parts",
      Perturbed(Together({ Scaled(Icosphere(1), { 0.4, 0.1, 0.12 }),
                  Moved(Scaled(Icosphere(1), { 0.15, 0.11, 0.1 }), { 0.7, 0.13, 0.04 }) }),
        0.01, 4) },
    { "coarse cuboid",
      Turned(Perturbed(Box(1, { 1.0, 0.11, 0.09 }), 0.02, 7), Random(5).Rotation()) },
    { "plate", Turned(Perturbed(Box(5, { 0.8, 0.3, 0.05 }), 0.007, 9), Random(2).Rotation()) } };
}

/// What of the mesh alone the arrays are made of.
void AddArrays(
  const TriangleMesh& mesh, Meshes::Random& random, MethodOptions& o, std::string& what)
{
  const int n = static_cast<int>(mesh.P.rows());
  const auto coin = [&](const char* name)
  {
    const bool heads = random.Unit() < 0.3;
    what += heads ? std::string(" ") + name : "";
    return heads;
  };
  const auto choose = [&](int count) { return static_cast<int>(random.Unit() * count); };
  if (coin("factors"))
  {
    o.roundnessFactors.resize(n);
    for (double& factor : o.roundnessFactors)
    {
      factor = random.Unit() < 0.2 ? 0.0 : 2.0 * random.Unit();
    }
  }
  if (coin("blends"))
  {
    o.normalBlends.resize(n);
    for (double& blend : o.normalBlends)
    {
      blend = random.Unit();
    }
  }
  if (coin("targets"))
  {
    o.targets.resize(n, 3);
    for (int i = 0; i < n; ++i)
    {
      o.targets.row(i) = random.InCube().transpose();
    }
  }
  if (coin("normals"))
  {
    o.normals.resize(n, 3);
    for (int i = 0; i < n; ++i)
    {
      o.normals.row(i) = random.InCube().normalized().transpose();
    }
  }
  const Eigen::RowVector3d middle =
    0.5 * (mesh.P.colwise().maxCoeff() + mesh.P.colwise().minCoeff());
  Eigen::RowVector3d extent = mesh.P.colwise().maxCoeff() - mesh.P.colwise().minCoeff();
  int along = 0;
  extent.maxCoeff(&along);
  if (coin("fixed"))
  {
    const int across = (along + 1) % 3;
    std::vector<Eigen::RowVector3d> positions;
    for (int i = 0; i < n; ++i)
    {
      if (mesh.P(i, across) > middle(across) + 0.15 * extent(across))
      {
        o.fixedPoints.push_back(i);
        positions.emplace_back(mesh.P.row(i) + 0.01 * random.InCube().transpose());
      }
    }
    o.fixedPositions.resize(positions.size(), 3);
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      o.fixedPositions.row(i) = positions[i];
    }
    o.sphereOfFreePoints = n > 8 && coin("free sphere");
  }
  if (n > 8 && coin("centers"))
  {
    o.centerBlend = random.Unit() < 0.5 ? 0.08 : 0.15;
    for (int i = 0; i < n; ++i)
    {
      o.centerIds.push_back(mesh.P(i, along) > middle(along) + 0.1 * extent(along) ? 1 : 0);
    }
    if (coin("given"))
    {
      o.centers.resize(2, 3);
      o.centers.row(0) = middle - 0.2 * extent;
      o.centers.row(1) = middle + 0.3 * extent;
    }
  }
  o.centerMode = static_cast<CenterMode>(choose(3));
  o.radiusMode = static_cast<RadiusMode>(choose(3));
  o.custom.center = middle.transpose() + 0.1 * extent.norm() * random.InCube();
  o.custom.radius = (0.1 + 0.3 * random.Unit()) * extent.norm();
  o.anchor = random.Unit() < 0.7 ? Anchor::Centroid : Anchor::LastPoint;
  what += " center mode " + std::to_string(static_cast<int>(o.centerMode)) + " radius mode " +
    std::to_string(static_cast<int>(o.radiusMode)) +
    (o.anchor == Anchor::Centroid ? "" : " last point");
}

struct Worst
{
  double position = 0.0;
  double direction = 0.0;
  double rotation = 0.0;
  int solves = 0;
  int yields = 0;
  int thrown = 0;
};

void Compare(const Meshes::Named& named, SphericalStyleMethod& method,
  ClosedFormReference& reference, MethodOptions o, const std::string& what, Worst& worst)
{
  const double diagonal = Meshes::Diagonal(named.mesh.P);
  const int n = static_cast<int>(named.mesh.P.rows());
  o.keepRotations = true;
  o.threads = 1 + worst.solves % 2;
  reference.Solve(o);
  ++worst.solves;
  worst.yields += reference.GetYield() > 0.0;
  StyleReport report;
  try
  {
    report = method.Solve(o);
  }
  catch (const std::invalid_argument& error)
  {
    // What is open can turn inside out: it has no volume that could be kept.
    ++worst.thrown;
    CHECK(o.size.keep == KeepSize::Volume && !(reference.GetSizeFactor() > 0.0),
      what << " throws: " << error.what() << "; factor " << reference.GetSizeFactor());
    return;
  }
  const double position =
    Meshes::Distance(method.GetPositions(), reference.GetPositions()) / diagonal;
  worst.position = std::max(worst.position, position);
  CHECK(position <= 1e-9,
    what << ": positions differ from the reference by " << position
         << " diagonals, should be below 1e-9; margin " << reference.GetMargin());
  const double direction = Meshes::Distance(method.GetDirections(), reference.GetDirections());
  worst.direction = std::max(worst.direction, direction);
  CHECK(direction <= 1e-8, what << ": directions differ by " << direction);
  CHECK(static_cast<int>(method.GetRotations().size()) == n, what << ": there are no rotations");
  for (std::size_t i = 0; i < method.GetRotations().size(); ++i)
  {
    worst.rotation =
      std::max(worst.rotation, (method.GetRotations()[i] - reference.GetRotations()[i]).norm());
  }
  CHECK(report.closedForm, what << ": not in closed form");
  CHECK(report.gridFunctions == reference.GetFunctions(),
    what << ": " << report.gridFunctions << " functions, should be " << reference.GetFunctions());
  CHECK(report.walls == reference.GetWalls(),
    what << ": " << report.walls << " walls, should be " << reference.GetWalls());
  CHECK_NEAR(report.sizeFactor, reference.GetSizeFactor(), 1e-9 * reference.GetSizeFactor(),
    what + ": factor of the size");
  CHECK(report.spheres.size() == reference.GetSpheres().size(), what << ": number of spheres");
  for (std::size_t k = 0; k < reference.GetSpheres().size(); ++k)
  {
    CHECK_NEAR(report.spheres[k].radius, reference.GetSpheres()[k].radius, 1e-11 * diagonal,
      what + ": radius");
    CHECK((report.spheres[k].center - reference.GetSpheres()[k].center).norm() <= 1e-9 * diagonal,
      what << ": the center differs");
  }
  for (std::size_t i = 0; i < o.fixedPoints.size(); ++i)
  {
    CHECK(method.GetPositions().row(o.fixedPoints[i]) == o.fixedPositions.row(i),
      what << ": a fixed point is not where it is to be");
  }
}

/// Every combination of the properties that are not arrays, one mesh after the other; arrays and
/// modes as they fall, each pair of them many times.
void AgainstReference()
{
  const std::vector<Meshes::Named> meshes = SmallMeshes();
  std::vector<SphericalStyleMethod> methods(meshes.size());
  std::vector<std::unique_ptr<ClosedFormReference>> references;
  for (std::size_t m = 0; m < meshes.size(); ++m)
  {
    methods[m].SetMesh(meshes[m].mesh);
    references.push_back(std::make_unique<ClosedFormReference>(meshes[m].mesh));
  }
  Meshes::Random random(17);
  Worst worst;
  int combination = 0;
  for (const double detailSize : { 0.0, 0.06, 0.1 })
  {
    for (const double blend : { 0.0, 0.6, 1.0 })
    {
      for (const NormalRadius radius : { NormalRadius::OwnThickness, NormalRadius::WholeModel })
      {
        for (const KeepSize keep :
          { KeepSize::Off, KeepSize::Area, KeepSize::Volume, KeepSize::Extent })
        {
          for (const bool ground : { false, true })
          {
            for (const int up : { 0, 1, 2 })
            {
              const std::size_t m = combination++ % meshes.size();
              MethodOptions o = Closed(random.Unit() < 0.5 ? 0.6 : 3.0, blend, detailSize);
              o.normalRadius = radius;
              o.size = { keep, Vector::Unit(up), ground };
              std::ostringstream what;
              what << meshes[m].name << ": lambda " << o.lambda << " a " << blend << " s "
                   << detailSize << (radius == NormalRadius::OwnThickness ? " own" : " whole")
                   << " keep " << static_cast<int>(keep) << " up " << up
                   << (ground ? " ground" : "");
              std::string text = what.str();
              if (combination % 3 > 0)
              {
                AddArrays(meshes[m].mesh, random, o, text);
              }
              Compare(meshes[m], methods[m], *references[m], o, text, worst);
            }
          }
        }
      }
    }
  }
  // Two centers that do not pass into each other: their joint is as wide as the finest grid.
  const Meshes::Named rod = { "rod",
    Meshes::Perturbed(Meshes::Box(4, { 1.0, 0.02, 0.025 }), 0.003, 21) };
  SphericalStyleMethod method;
  method.SetMesh(rod.mesh);
  ClosedFormReference reference(rod.mesh);
  for (const double blend : { 0.0, 0.6 })
  {
    MethodOptions o = Closed(0.8, blend, 0.1);
    for (Eigen::Index i = 0; i < rod.mesh.P.rows(); ++i)
    {
      o.centerIds.push_back(rod.mesh.P(i, 0) > 0.2 ? 1 : 0);
    }
    Compare(rod, method, reference, o, "rod: two centers without a blend", worst);
  }
  for (std::size_t m = 0; m < meshes.size(); ++m)
  {
    CHECK(references[m]->GetMargin() > 1e-10,
      meshes[m].name << " has a point within " << references[m]->GetMargin()
                     << " cells of a border: rounding decides");
  }
  CHECK(worst.yields > 3, "details gave way in " << worst.yields << " solves only");
  CHECK(worst.rotation < 1e-6, "rotations differ by " << worst.rotation);
  std::cout << worst.solves << " solves against the reference: positions within " << worst.position
            << " diagonals, directions " << worst.direction << ", rotations " << worst.rotation
            << "; details gave way in " << worst.yields << ", " << worst.thrown << " without volume"
            << std::endl;
}

//------------------------------------------------------------------------------------------------
void LambdaZero()
{
  TriangleMesh mesh = Body(3);
  mesh.P *= 3.7;
  mesh.P.rowwise() += Eigen::RowVector3d(11.0, -5.0, 0.3);
  for (const double detailSize : { 0.0, 0.06 })
  {
    for (const KeepSize keep :
      { KeepSize::Off, KeepSize::Area, KeepSize::Volume, KeepSize::Extent })
    {
      MethodOptions o = Closed(0.0, 0.6, detailSize);
      o.size = { keep, Vector::UnitZ(), true };
      CHECK(Meshes::SameBits(Deformed(mesh, o), mesh.P), "lambda 0 moves points");
      o.lambda = 2.0;
      o.roundnessFactors = Eigen::VectorXd::Zero(mesh.P.rows());
      CHECK(Meshes::SameBits(Deformed(mesh, o), mesh.P), "roundness factors of 0 move points");
    }
  }
  // What is fixed somewhere else goes there all the same.
  MethodOptions o = Closed(0.0, 0.0, 0.06);
  o.fixedPoints = { 3 };
  o.fixedPositions = mesh.P.row(3) + Eigen::RowVector3d(0.1, 0.2, 0.3);
  CHECK(Deformed(mesh, o).row(3) == o.fixedPositions.row(0),
    "lambda 0: a fixed point is not where it is to be");
}

std::vector<MethodOptions> Styles()
{
  std::vector<MethodOptions> styles = { Closed(0.5, 0.0, 0.03), Closed(1.0, 0.6, 0.06),
    Closed(3.0, 1.0, 0.06), Closed(0.7, 0.5, 0.0) };
  styles[1].size = { KeepSize::Area, Vector::UnitY(), true };
  styles[2].size = { KeepSize::Extent, Vector::UnitZ(), false };
  styles[3].size = { KeepSize::Volume, Vector::UnitX(), true };
  return styles;
}

void Invariance()
{
  const TriangleMesh mesh = Body(4);
  const double diagonal = Meshes::Diagonal(mesh.P);
  const int n = static_cast<int>(mesh.P.rows());
  Meshes::Random random(29);
  const std::vector<int> place = random.Permutation(n);
  const std::vector<int> order = random.Permutation(static_cast<int>(mesh.F.rows()));
  TriangleMesh renumbered = Meshes::Renumbered(mesh, place);
  const Triangles given = renumbered.F;
  for (Eigen::Index f = 0; f < given.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      renumbered.F(order[f], k) = given(f, (k + order[f]) % 3);
    }
  }
  double largest = 0.0;
  for (MethodOptions o : Styles())
  {
    const std::string what =
      "s " + std::to_string(o.detailSize) + " a " + std::to_string(o.normalBlend);
    for (int twoCenters = 0; twoCenters < 2; ++twoCenters)
    {
      if (twoCenters == 1)
      {
        o.centerBlend = 0.1;
        for (int i = 0; i < n; ++i)
        {
          o.centerIds.push_back(mesh.P(i, 0) > 0.1 ? 1 : 0);
        }
      }
      SphericalStyleMethod method;
      method.SetMesh(mesh);
      method.Solve(o);
      const Points expected = method.GetPositions();
      CHECK(expected.allFinite(), what << ": not finite");
      method.Solve(Closed(2.0, 1.0, 0.08));
      method.Solve(o);
      CHECK(Meshes::SameBits(expected, method.GetPositions()),
        what << ": another solve in between changes bits");
      method.Solve(o);
      CHECK(Meshes::SameBits(expected, method.GetPositions()), what << ": a second run differs");
      for (const int threads : { 2, 7 })
      {
        MethodOptions parallel = o;
        parallel.threads = threads;
        CHECK(Meshes::SameBits(expected, Deformed(mesh, parallel)),
          what << ": " << threads << " threads change bits");
      }
      for (const double scale : { 1.0, 1e-6, 1e6 })
      {
        TriangleMesh moved = mesh;
        const Eigen::RowVector3d away = diagonal * Eigen::RowVector3d(3.0, -7.0, 2.0);
        moved.P = scale * (mesh.P.rowwise() + away);
        const Points back = (Deformed(moved, o) / scale).rowwise() - away;
        const double distance = Meshes::Distance(back, expected) / diagonal;
        largest = std::max(largest, distance);
        CHECK(distance <= 1e-9,
          what << ": moved and scaled by " << scale << ", the result differs by " << distance);
      }
      MethodOptions permuted = o;
      for (int i = 0; i < n && twoCenters == 1; ++i)
      {
        permuted.centerIds[place[i]] = o.centerIds[i];
      }
      const Points there = Deformed(renumbered, permuted);
      const double distance = Meshes::Distance(there(place, AllColumns), expected) / diagonal;
      largest = std::max(largest, distance);
      CHECK(distance <= 1e-9, what << ": numbered anew, the result differs by " << distance);
    }
  }
  std::cout << "moved, scaled, numbered anew: within " << largest << " diagonals" << std::endl;
}

/// A model that is its own mirror image in x, down to its triangles.
TriangleMesh Twins()
{
  TriangleMesh mesh = Meshes::Icosphere(4);
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    const double x = std::abs(mesh.P(i, 0));
    const double bump = 1.0 + 0.05 * std::sin(14.0 * x + 17.0 * mesh.P(i, 1) + 11.0 * mesh.P(i, 2));
    mesh.P.row(i) *= bump;
    mesh.P(i, 1) *= 0.5 + 0.2 * x;
    mesh.P(i, 2) = 0.4 * mesh.P(i, 2) + 0.1 * x * x;
  }
  return mesh;
}

void Mirror()
{
  const Vector flip(-1.0, 1.0, 1.0);
  double mirrored = 0.0;
  double twin = 0.0;
  for (MethodOptions o : Styles())
  {
    const std::string what =
      "s " + std::to_string(o.detailSize) + " a " + std::to_string(o.normalBlend);
    if (o.size.up(0) != 0.0) // there is no ground on one side of a mirror
    {
      o.size.up = Eigen::Vector3d::UnitY();
    }
    const TriangleMesh mesh = Body(4);
    for (int turned = 0; turned < 2; ++turned) // whether the mirror image still faces outward
    {
      TriangleMesh image = Meshes::Scaled(mesh, flip);
      if (turned == 0)
      {
        image.F = image.F.rowwise().reverse().eval();
      }
      // What faces inward all over has a negative volume, and the same one after.
      const Points result = Deformed(image, o) * flip.asDiagonal();
      const double distance =
        Meshes::Distance(result, Deformed(mesh, o)) / Meshes::Diagonal(mesh.P);
      mirrored = std::max(mirrored, distance);
      CHECK(distance <= 1e-9, what << ": the mirror image differs by " << distance);
    }

    const TriangleMesh twins = Twins();
    const Points Q = Deformed(twins, o);
    std::map<std::array<double, 3>, int> numbers;
    for (int i = 0; i < twins.P.rows(); ++i)
    {
      numbers[{ twins.P(i, 0), twins.P(i, 1), twins.P(i, 2) }] = i;
    }
    Points image(Q.rows(), 3);
    for (int i = 0; i < twins.P.rows(); ++i)
    {
      const double x = twins.P(i, 0) == 0.0 ? 0.0 : -twins.P(i, 0);
      const auto found = numbers.find({ x, twins.P(i, 1), twins.P(i, 2) });
      CHECK(found != numbers.end(), "point " << i << " has no twin");
      image.row(i) = Q.row(found != numbers.end() ? found->second : i) * flip.asDiagonal();
    }
    const double distance = Meshes::Distance(image, Q) / Meshes::Diagonal(twins.P);
    twin = std::max(twin, distance);
    CHECK(distance <= 1e-9, what << ": a symmetric model is off by " << distance);
  }
  std::cout << "mirror images within " << mirrored << ", symmetric within " << twin << " diagonals"
            << std::endl;
}

/// The grid knows directions in space, the model should not.
void Turned()
{
  const TriangleMesh mesh = Body(5);
  const double diagonal = Meshes::Diagonal(mesh.P);
  const Eigen::Matrix3d turn = TurnedTwice();
  const TriangleMesh turned = Meshes::Turned(mesh, turn);
  for (const MethodOptions& o : { Closed(0.5, 0.0, 0.03), Closed(1.0, 0.6, 0.06) })
  {
    MethodOptions same = o; // in model units: bounds turn too
    same.detailSize *= diagonal / Meshes::Diagonal(turned.P);
    const Points expected = Deformed(mesh, o);
    const Points back = Deformed(turned, same) * turn;
    const double rms = Rms(back, expected) / diagonal;
    const double largest = Meshes::Distance(back, expected) / diagonal;
    std::cout << "turned, s " << o.detailSize << " a " << o.normalBlend << ": rms " << rms
              << ", largest " << largest << " diagonals" << std::endl;
    CHECK(rms < 0.001 && largest < 0.003,
      "s " << o.detailSize << ": turned, the result differs by rms " << rms << ", largest "
           << largest);
  }
}

//------------------------------------------------------------------------------------------------
/// Displacement where a direction of the unit ball meets the triangles, before they were scaled.
Points DisplacementsAt(const std::vector<Vector>& directions, const TriangleMesh& ball,
  const TriangleMesh& mesh, const Points& Q)
{
  Points result = Points::Constant(directions.size(), 3, std::nan(""));
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    double best = -1e-3; // a crack is not far from its rim
    for (Eigen::Index f = 0; f < ball.F.rows(); ++f)
    {
      const Eigen::Matrix3d x = ball.P(ball.F.row(f), AllColumns).transpose();
      if (x.col(0).dot(directions[i]) < 0.5)
      {
        continue;
      }
      const Vector shares = x.inverse() * directions[i];
      if (shares.allFinite() && shares.minCoeff() > best)
      {
        best = shares.minCoeff();
        const Eigen::RowVector3i corners = ball.F.row(f);
        result.row(i) = (shares.transpose() / shares.sum()) *
          (Q(corners, AllColumns) - mesh.P(corners, AllColumns));
      }
    }
  }
  return result;
}

/// Triangles without common points, each moved by up to `apart`.
TriangleMesh Soup(const TriangleMesh& mesh, double apart, std::uint32_t seed)
{
  Meshes::Random random(seed);
  TriangleMesh soup = { Points(3 * mesh.F.rows(), 3), Triangles(mesh.F.rows(), 3) };
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    const Vector move = apart * random.InCube();
    for (int k = 0; k < 3; ++k)
    {
      soup.F(f, k) = static_cast<int>(3 * f + k);
      soup.P.row(3 * f + k) = mesh.P.row(mesh.F(f, k)) + move.transpose();
    }
  }
  return soup;
}

TriangleMesh WithFlips(TriangleMesh mesh, double share, std::uint32_t seed)
{
  Meshes::Random random(seed);
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    if (random.Unit() < share)
    {
      std::swap(mesh.F(f, 1), mesh.F(f, 2));
    }
  }
  return mesh;
}

/// A tenth of the triangles cut into two slivers and a triangle, at a point next to an edge.
TriangleMesh WithSlivers(const TriangleMesh& mesh, std::uint32_t seed)
{
  Meshes::Random random(seed);
  std::vector<Vector> points;
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    points.emplace_back(mesh.P.row(i).transpose());
  }
  std::vector<std::array<int, 3>> triangles;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    const int a = mesh.F(f, 0), b = mesh.F(f, 1), c = mesh.F(f, 2);
    if (random.Unit() < 0.1)
    {
      const double x = random.Unit();
      const int p = static_cast<int>(points.size());
      const Vector middle =
        1e-6 * points[a] + (1.0 - 1e-6) * (x * points[b] + (1.0 - x) * points[c]);
      points.push_back(middle);
      triangles.push_back({ a, b, p });
      triangles.push_back({ b, c, p });
      triangles.push_back({ c, a, p });
    }
    else
    {
      triangles.push_back({ a, b, c });
    }
  }
  return Meshes::Make(points, triangles);
}

void Triangulations()
{
  using namespace Meshes;
  const Vector axes(1.0, 0.55, 0.4);
  TriangleMesh latitudes = EllipsoidUV(200, 140);
  latitudes.P = latitudes.P * Vector(1.0, 1.0 / 0.7, 2.0).asDiagonal();
  TriangleMesh uneven = Icosphere(6);
  for (Eigen::Index i = 0; i < uneven.P.rows(); ++i)
  {
    // Twice as dense on one side as on the other.
    uneven.P.row(i) += 0.33 * Eigen::RowVector3d(0.6, -0.5, 0.62);
    uneven.P.row(i).normalize();
  }
  TriangleMesh slid = Perturbed(Icosphere(6), 0.003, 41);
  slid.P.rowwise().normalize();
  const TriangleMesh fine = Icosphere(6);
  std::vector<Named> balls = { { "icosphere", fine }, { "coarser", Icosphere(5) },
    { "latitudes", latitudes }, { "cube", RoundedBox(80, 1.0) }, { "uneven", uneven },
    { "slid", slid }, { "flips", WithFlips(fine, 0.04, 43) }, { "cracks", Soup(fine, 1e-7, 44) },
    { "soup", Soup(slid, 0.0, 45) },
    { "soup with flips", WithFlips(Soup(fine, 0.0, 46), 0.04, 47) },
    { "slivers", WithSlivers(fine, 48) } };
  Random random(49);
  std::vector<Vector> directions;
  for (int i = 0; i < 60; ++i)
  {
    directions.push_back(random.InCube().normalized());
  }
  const double diagonal = 2.0 * axes.norm();
  for (const MethodOptions& o : { Closed(0.5, 0.0, 0.03), Closed(1.0, 0.6, 0.06) })
  {
    Points expected;
    for (const Named& ball : balls)
    {
      const TriangleMesh mesh = Scaled(ball.mesh, axes);
      const Points moves = DisplacementsAt(directions, ball.mesh, mesh, Deformed(mesh, o));
      if (expected.rows() == 0)
      {
        expected = moves;
        continue;
      }
      const double largest = Distance(moves, expected) / diagonal;
      std::cout << "triangulation " << ball.name << ", s " << o.detailSize << " a " << o.normalBlend
                << ": largest difference " << largest << " diagonals" << std::endl;
      CHECK(largest < 0.002,
        ball.name << ", s " << o.detailSize << " a " << o.normalBlend
                  << ": other triangles move places by " << largest << " diagonals");
    }
  }
}

//------------------------------------------------------------------------------------------------
void EdgeCases()
{
  using namespace Meshes;
  const auto check = [](const TriangleMesh& mesh, MethodOptions o, const std::string& what)
  {
    for (const KeepSize keep : { KeepSize::Off, KeepSize::Area })
    {
      o.size.keep = keep;
      Points Q;
      try
      {
        Q = Deformed(mesh, o);
      }
      catch (const std::exception& error)
      {
        CHECK(false,
          what << ", s " << o.detailSize << " a " << o.normalBlend << " keep "
               << static_cast<int>(keep) << " throws: " << error.what());
        continue;
      }
      const Eigen::RowVector3d middle =
        0.5 * mesh.P.colwise().minCoeff() + 0.5 * mesh.P.colwise().maxCoeff();
      const double diagonal =
        (0.5 * mesh.P.colwise().maxCoeff() - 0.5 * mesh.P.colwise().minCoeff()).stableNorm() * 2.0;
      const double away = ((Q.rowwise() - middle) / diagonal).rowwise().norm().maxCoeff();
      CHECK(Q.allFinite() && away < 3.0,
        what << ", s " << o.detailSize << " a " << o.normalBlend << " keep "
             << static_cast<int>(keep) << ": a point lies " << away << " diagonals away");
    }
  };
  const TriangleMesh flat = Patch(8, 0.0);
  TriangleMesh needles = EllipsoidUV(10, 8);
  for (Eigen::Index i = 0; i < 10; ++i)
  {
    // Spikes without area at the first points, and needles at the next.
    const int tip = static_cast<int>(needles.P.rows());
    needles.P.conservativeResize(tip + 2, 3);
    needles.P.row(tip) = 1.3 * needles.P.row(i);
    needles.P.row(tip + 1) = 1.6 * needles.P.row(i);
    needles.F.conservativeResize(needles.F.rows() + 2, 3);
    needles.F.bottomRows(2) << static_cast<int>(i), tip, tip + 1, static_cast<int>(i),
      static_cast<int>(i) + 10, tip;
  }
  TriangleMesh onCenter = Ellipsoid(2);
  onCenter.P.conservativeResize(onCenter.P.rows() + 1, 3);
  onCenter.P.bottomRows(1).setZero();
  onCenter.F.conservativeResize(onCenter.F.rows() + 1, 3);
  onCenter.F.bottomRows(1) << 0, 1, static_cast<int>(onCenter.P.rows()) - 1;
  TriangleMesh loosePoint = Ellipsoid(2);
  loosePoint.P.conservativeResize(loosePoint.P.rows() + 1, 3);
  loosePoint.P.bottomRows(1) << 0.3, 0.2, 0.9;
  const std::vector<Named> meshes = {
    { "one triangle", Make({ { 0, 0, 0 }, { 1, 0.2, 0 }, { 0.3, 0.8, 0.5 } }, { { 0, 1, 2 } }) },
    { "flat, along an axis", flat }, { "flat", Meshes::Turned(flat, Random(3).Rotation()) },
    { "needles", needles }, { "point on the center", onCenter }, { "loose point", loosePoint },
    { "far parts", Together({ Ellipsoid(2), Moved(Ellipsoid(2), { 1e4, 3e3, 0.0 }) }) },
    { "tetrahedron", Tetrahedron() }
  };
  for (const Named& named : meshes)
  {
    for (const double detailSize : { 0.0, 0.06, 0.5 })
    {
      for (const double blend : { 0.0, 0.6, 1.0 })
      {
        check(named.mesh, Closed(1.0, blend, detailSize), named.name);
      }
    }
  }
  for (const double size : { 1e-150, 1e150 })
  {
    TriangleMesh mesh = Body(3);
    const Points expected = Deformed(mesh, Closed(1.0, 0.6, 0.06));
    mesh.P *= size;
    const Points Q = Deformed(mesh, Closed(1.0, 0.6, 0.06)) / size;
    CHECK(Distance(Q, expected) < 1e-9, "of size " << size << ", the result is another");
  }
  // A grid that would have too many functions, in a box of too many cells, gets coarser.
  const TriangleMesh mesh = Body(3);
  SphericalStyleMethod method;
  method.SetMesh(mesh);
  const StyleReport report = method.Solve(Closed(0.5, 0.0, 1e-12));
  CHECK(report.coarserGrid && report.gridFunctions <= SurfaceGrid::MaximumNumberOfFunctions &&
      report.gridFunctions > SurfaceGrid::MaximumNumberOfFunctions / 4,
    report.gridFunctions << " functions, coarser " << report.coarserGrid);
  std::cout << report.gridFunctions << " functions of spacing " << report.gridSpacing << std::endl;
  // Details that are not there: nearly the model without a base.
  const Points plain = Deformed(mesh, Closed(0.5, 0.0, 0.0));
  const double distance = Rms(method.GetPositions(), plain) / Diagonal(mesh.P);
  CHECK(distance < 0.01, "rms " << distance << " from no details");
}

/// A small loose part counts for little in the sums, and yet it goes where a larger one goes: not
/// quite, since the larger one has a say in where its surroundings go.
void SmallParts()
{
  using namespace Meshes;
  const TriangleMesh large = Ellipsoid(4);
  const Vector place(0.85, 0.7, 0.15);
  const auto moveOf = [&](double size)
  {
    const TriangleMesh mesh =
      Together({ large, Moved(Scaled(Icosphere(1), size * Vector::Ones()), place) });
    const Points moves = Deformed(mesh, Closed(1.0, 0.0, 0.06)) - mesh.P;
    return Eigen::RowVector3d(moves.bottomRows(42).colwise().mean());
  };
  const Eigen::RowVector3d expected = moveOf(0.01);
  for (const double size : { 1e-3, 1e-4, 1e-5, 1e-6 })
  {
    const double distance = (moveOf(size) - expected).norm() / Diagonal(large.P);
    std::cout << "a loose part of size " << size << ": " << distance << " diagonals off"
              << std::endl;
    CHECK(distance < 0.006, "a loose part of size " << size << " is " << distance << " off");
  }

  // Beside a base that an energy deforms: where the base is not known, the part goes as a whole.
  MethodOptions uniform = Closed(0.05, 0.0, 0.06);
  uniform.sphericalWeighting = SphericalWeighting::Uniform;
  for (const double size : { 1e-4, 1e-5, 1e-6 })
  {
    const TriangleMesh mesh =
      Together({ large, Moved(Scaled(Icosphere(1), size * Vector::Ones()), place) });
    SphericalStyleMethod method;
    method.SetMesh(mesh);
    method.Solve(uniform);
    const Eigen::RowVector3d mean = method.GetPositions().bottomRows(42).colwise().mean();
    const double distance = (mean - place.transpose()).norm() / place.norm();
    std::cout << "with an energy, a loose part of size " << size << " moves by " << distance
              << std::endl;
    CHECK(distance < 0.1, "with an energy, a loose part of size " << size << " flies away");
  }
}

/// How much of its area a fin keeps depends on the size of details smoothly, wherever the grid has
/// its borders: without the slope across the fin, the first would have 2.7 times its area.
void Fins()
{
  using namespace Meshes;
  const TriangleMesh fin = Moved(Box(30, { 0.5, 0.004, 0.35 }), { 0.9, 0.02, 0.0 });
  const TriangleMesh mesh = Together({ Ellipsoid(4), fin });
  for (int k = 0; k < 11; ++k)
  {
    const double size = 0.04 + 0.004 * k;
    const Points Q = Deformed(mesh, Closed(1.0, 0.0, size)).bottomRows(fin.P.rows());
    const double kept = TriangleAreas(Q, fin.F).sum() / TriangleAreas(fin.P, fin.F).sum();
    std::cout << "s " << size << ": a fin keeps " << kept << " of its area" << std::endl;
    CHECK_NEAR(kept, 0.65 + 3.0 * (size - 0.06), 0.02, "what a fin keeps of its area");
  }
}
}

int main()
{
  AgainstReference();
  LambdaZero();
  Invariance();
  Mirror();
  Turned();
  Triangulations();
  EdgeCases();
  SmallParts();
  Fins();
  return CheckResult();
}
