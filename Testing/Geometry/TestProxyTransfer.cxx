// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// From the rounded proxy to the model against the formulas written out a second time, and what the
// whole method keeps between calls: never anything that a fresh object would not come to.
#include "Check.h"
#include "DeformationMeasures.h"
#include "LocalStep.h"
#include "Meshes.h"
#include "ProxyDeformation.h"
#include "SurfaceMeasures.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <string>

using namespace SphericalStyle;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

Vector3d At(const Points& P, Eigen::Index i)
{
  return P.row(i).transpose();
}

bool SameBits(const Matrices& a, const Matrices& b)
{
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
  {
    if (std::memcmp(a[i].data(), b[i].data(), sizeof(Matrix3d)) != 0)
    {
      return false;
    }
  }
  return a.size() == b.size();
}

Points Turned(const Points& P, const Matrix3d& turn)
{
  return P * turn.transpose();
}

bool Throws(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const std::exception&)
  {
    return true;
  }
  return false;
}

double LargestDifference(const Matrices& a, const Matrices& b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max(largest, (a[i] - b[i]).norm());
  }
  return largest;
}

/// Bent along a circle, as a sheet of paper is, and stretched a little.
Points Bent(const Points& P, double amount)
{
  Points Q = P;
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    const double angle = amount * P(i, 0);
    const double radius = 1.0 / amount - P(i, 2);
    Q.row(i) << radius * std::sin(angle), 1.1 * P(i, 1), 1.0 / amount - radius * std::cos(angle);
  }
  return Q;
}

Matrices AllThe(const Matrix3d& R, Eigen::Index n)
{
  return Matrices(static_cast<std::size_t>(n), R);
}

/// A proxy that was deformed somehow, points around it and their feet.
struct Scene
{
  explicit Scene(std::uint32_t seed)
  {
    Meshes::Random random(seed);
    Proxy.rest = Meshes::Ellipsoid(2);
    Proxy.rounded = Bent(Proxy.rest.P, 0.8);
    Proxy.rotations = SurfaceRotations(Proxy.rest, Proxy.rounded, 1);
    P = Meshes::Perturbed(Meshes::Ellipsoid(3), 0.2, seed).P;
    Foot = SurfaceProjection(Proxy.rest).ClosestPoint(P, 1);
    Rotations = RotationsAtFeet(Proxy, Foot, 1);
    t.resize(P.rows(), 3);
    for (double& x : t.reshaped())
    {
      x = random.Unit();
    }
  }

  /// sum_k b_k x_k, by hand.
  Vector3d AtFoot(const Points& x, Eigen::Index i) const
  {
    Vector3d sum = Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
    {
      sum += Foot.barycentric(i, k) * At(x, Proxy.rest.F(Foot.cell[i], k));
    }
    return sum;
  }

  DeformedProxy Proxy;
  Points P;
  Feet Foot;
  Matrices Rotations;
  Points t;
};

//------------------------------------------------------------------------------------------------
// The closest rotation of the cotangent-weighted change of edges, point by point with the SVD.
Matrices FittedOneByOne(const TriangleMesh& rest, const Points& rounded)
{
  Matrices R;
  for (int i = 0; i < rest.P.rows(); ++i)
  {
    Matrix3d S = Matrix3d::Zero();
    for (const auto& t : rest.F.rowwise())
    {
      if (t[0] != i && t[1] != i && t[2] != i)
      {
        continue;
      }
      for (int k = 0; k < 3; ++k)
      {
        const int u = t[(k + 1) % 3], v = t[(k + 2) % 3];
        const Vector3d a = At(rest.P, u) - At(rest.P, t[k]), b = At(rest.P, v) - At(rest.P, t[k]);
        const double cotangent = a.dot(b) / a.cross(b).norm();
        // Columns: the rest edge, times the row of the deformed one.
        S += 0.5 * cotangent * (At(rest.P, u) - At(rest.P, v)) *
          (At(rounded, u) - At(rounded, v)).transpose();
      }
    }
    const Eigen::JacobiSVD<Matrix3d> svd(S, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Matrix3d sign = Matrix3d::Identity();
    sign(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
    R.push_back(svd.matrixV() * sign * svd.matrixU().transpose());
  }
  return R;
}

void TestSurfaceRotations()
{
  Meshes::Random random(1);
  const std::vector<Meshes::Named> models = { { "ellipsoid", Meshes::Ellipsoid(2) },
    { "box", Meshes::Box(4) }, { "slivers", Meshes::Slivers() }, { "patch", Meshes::Patch(8, 0.3) },
    { "flat patch", Meshes::Patch(8, 0.0) }, { "fan", Meshes::NonManifoldFan() },
    { "house", Meshes::House() }, { "two parts", Meshes::TwoComponents() } };
  for (const auto& [name, mesh] : models)
  {
    for (int k = 0; k < 20; ++k)
    {
      const Matrix3d turn = k == 0 ? Matrix3d::Identity() : random.Rotation();
      const Points moved = Turned(mesh.P, turn).rowwise() + random.InCube().transpose();
      const Matrices R = SurfaceRotations(mesh, moved, 1);
      const double off = LargestDifference(R, AllThe(turn, mesh.P.rows()));
      CHECK(off <= 1e-9, name << ": the rotation should be recovered, is off by " << off);
      // A change of size is no rotation.
      const double larger =
        LargestDifference(SurfaceRotations(mesh, 3.0 * moved, 1), AllThe(turn, mesh.P.rows()));
      CHECK(larger <= 1e-9, name << ": turned and enlarged, off by " << larger);
    }
    for (const double amount : { 0.2, 0.9 })
    {
      const Points bent = Bent(mesh.P, amount);
      const Matrices R = SurfaceRotations(mesh, bent, 1);
      const double off = LargestDifference(R, FittedOneByOne(mesh, bent));
      CHECK(off <= 1e-9, name << " bent by " << amount << ": off by " << off);
      double angle = 0.0;
      for (const Matrix3d& r : R)
      {
        angle = std::max(angle, (r - Matrix3d::Identity()).norm());
      }
      CHECK(angle > 0.1, name << ": the test should turn something");
      for (const int threads : { 2, 3, 7 })
      {
        CHECK(SameBits(R, SurfaceRotations(mesh, bent, threads)),
          name << ": " << threads << " threads should give the same bits as one");
      }
    }
  }
}

void TestRotationsAtFeet()
{
  const Scene scene(2);
  for (std::size_t i = 0; i < scene.Rotations.size(); ++i)
  {
    Matrix3d mean = Matrix3d::Zero();
    const auto at = static_cast<Eigen::Index>(i);
    for (int k = 0; k < 3; ++k)
    {
      mean += scene.Foot.barycentric(at, k) *
        scene.Proxy.rotations[scene.Proxy.rest.F(scene.Foot.cell[at], k)];
    }
    // The closest rotation to the mean, by its SVD.
    const Eigen::JacobiSVD<Matrix3d> svd(mean, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Matrix3d expected = svd.matrixU() * svd.matrixV().transpose();
    CHECK((scene.Rotations[i] - expected).norm() <= 1e-11,
      "rotation at foot " << i << " is off by " << (scene.Rotations[i] - expected).norm());
  }
  for (const int threads : { 2, 3, 7 })
  {
    CHECK(SameBits(scene.Rotations, RotationsAtFeet(scene.Proxy, scene.Foot, threads)),
      threads << " threads should give the same bits as one");
  }
  Meshes::Random random(3);
  DeformedProxy turned = scene.Proxy;
  const Matrix3d turn = random.Rotation();
  turned.rotations = AllThe(turn, turned.rest.P.rows());
  CHECK(LargestDifference(RotationsAtFeet(turned, scene.Foot, 1), AllThe(turn, scene.P.rows())) <=
      1e-12,
    "equal rotations at the corners should be that of the foot");
}

//------------------------------------------------------------------------------------------------
void TestFormula()
{
  for (const std::uint32_t seed : { 4u, 5u, 6u })
  {
    const Scene scene(seed);
    for (const Transfer transfer : { Transfer::Blend, Transfer::Offset })
    {
      for (const Vector3d& gain : { Vector3d(1, 1, 1), Vector3d(1.3, 0.7, 2.0), Vector3d(0, 1, 1) })
      {
        const Vector3d O(0.1, -0.2, 0.3);
        const Points Q = TransferFromProxy(
          scene.P, scene.Proxy, scene.Foot, scene.Rotations, scene.t, { transfer, gain, O });
        for (Eigen::Index i = 0; i < scene.P.rows(); ++i)
        {
          const Vector3d p = At(scene.P, i);
          Vector3d target = O + gain.cwiseProduct(scene.AtFoot(scene.Proxy.rounded, i) - O);
          if (transfer == Transfer::Offset)
          {
            target += scene.Rotations[static_cast<std::size_t>(i)] *
              (p - scene.AtFoot(scene.Proxy.rest.P, i));
          }
          for (int k = 0; k < 3; ++k)
          {
            const double t = scene.t(i, k);
            CHECK_NEAR(Q(i, k), (1.0 - t) * target[k] + t * p[k], 1e-14,
              "coordinate " << k << " of point " << i);
          }
        }
      }
    }
  }
}

void TestEnds()
{
  Scene scene(7);
  scene.P.row(3) << -0.0, 0.0, -0.0;
  scene.P.row(4) << 5e-324, -1e300, 1e-300;
  scene.Foot = SurfaceProjection(scene.Proxy.rest).ClosestPoint(scene.P, 1);
  scene.Rotations = RotationsAtFeet(scene.Proxy, scene.Foot, 1);
  const Points one = Points::Ones(scene.P.rows(), 3);
  const Points zero = Points::Zero(scene.P.rows(), 3);
  const auto move = [&](const Points& t, const TransferOptions& options)
  { return TransferFromProxy(scene.P, scene.Proxy, scene.Foot, scene.Rotations, t, options); };

  for (const Transfer transfer : { Transfer::Blend, Transfer::Offset })
  {
    CHECK(Meshes::SameBits(move(one, { transfer, { 2, 0, 3 }, { 1, 2, 3 } }), scene.P),
      "t = 1 should keep every bit, -0 too");
    Points mixed = scene.t;
    mixed.col(1).setOnes();
    const Points Q = move(mixed, { transfer, { 1, 1, 1 }, { 0, 0, 0 } });
    const Eigen::VectorXd before = scene.P.col(1), after = Q.col(1);
    CHECK(std::memcmp(before.data(), after.data(), before.size() * sizeof(double)) == 0,
      "t = 1 along one axis should keep the bits of its coordinate");
  }

  scene.P.row(4).setZero();
  scene.Foot = SurfaceProjection(scene.Proxy.rest).ClosestPoint(scene.P, 1);
  scene.Rotations = RotationsAtFeet(scene.Proxy, scene.Foot, 1);
  const double diagonal = Meshes::Diagonal(scene.P);
  const Points blended = move(zero, {});
  TransferOptions offset;
  offset.transfer = Transfer::Offset;
  const Points kept = move(zero, offset);
  for (Eigen::Index i = 0; i < scene.P.rows(); ++i)
  {
    const Vector3d q = scene.AtFoot(scene.Proxy.rest.P, i);
    const Vector3d rounded = scene.AtFoot(scene.Proxy.rounded, i);
    CHECK((At(blended, i) - rounded).norm() <= 1e-12 * diagonal,
      "t = 0 should put point " << i << " on the rounded proxy");
    CHECK_NEAR((At(kept, i) - rounded).norm(), (At(scene.P, i) - q).norm(), 1e-12 * diagonal,
      "Offset at t = 0: distance of point " << i);
  }

  // Points on the proxy have no distance to keep.
  Scene on(8);
  on.P = Interpolate(on.Proxy.rest.F, on.Foot, on.Proxy.rest.P);
  const Points a = TransferFromProxy(on.P, on.Proxy, on.Foot, on.Rotations, on.t, {});
  const Points b = TransferFromProxy(on.P, on.Proxy, on.Foot, on.Rotations, on.t, offset);
  CHECK(Meshes::Distance(a, b) <= 1e-15, "where p = q, Offset should equal Blend");

  CHECK(TransferFromProxy(Points(0, 3), on.Proxy, { Eigen::VectorXi(0), Points(0, 3), {}, {} }, {},
          Points(0, 3), {})
          .rows() == 0,
    "no points in, none out");
}

// Rigid motion of the proxy carries the model along.
void TestRigidMotion()
{
  Meshes::Random random(9);
  Scene scene(9);
  for (int k = 0; k < 20; ++k)
  {
    const Matrix3d turn = random.Rotation();
    const Vector3d by = random.InCube();
    scene.Proxy.rounded = Turned(scene.Proxy.rest.P, turn).rowwise() + by.transpose();
    scene.Proxy.rotations = SurfaceRotations(scene.Proxy.rest, scene.Proxy.rounded, 1);
    scene.Rotations = RotationsAtFeet(scene.Proxy, scene.Foot, 1);
    TransferOptions offset;
    offset.transfer = Transfer::Offset;
    const Points Q = TransferFromProxy(
      scene.P, scene.Proxy, scene.Foot, scene.Rotations, Points::Zero(scene.P.rows(), 3), offset);
    const Points expected = Turned(scene.P, turn).rowwise() + by.transpose();
    CHECK(Meshes::Distance(Q, expected) <= 1e-10,
      "Offset should carry the model along rigidly, off by " << Meshes::Distance(Q, expected));
  }
}

void TestTurnedOver()
{
  Meshes::Random random(10);
  const TriangleMesh mesh = Meshes::Ellipsoid(2);
  const auto n = mesh.P.rows();
  for (int k = 0; k < 50; ++k)
  {
    const Matrix3d turn = random.Rotation();
    const Points Q = Turned(mesh.P, turn).rowwise() + random.InCube().transpose();
    CHECK(CountTurnedOver(mesh.P, Q, mesh.F, AllThe(turn, n)) == 0,
      "a rigid motion should turn no triangle over");
    CHECK(CountTurnedOver(mesh.P, Q * 1e-3, mesh.F, AllThe(turn, n)) == 0, "nor should shrinking");
  }
  CHECK(CountTurnedOver(mesh.P, -mesh.P, mesh.F, AllThe(Matrix3d::Identity(), n)) == 0,
    "a point reflection leaves every normal");
  const Matrix3d half = Eigen::AngleAxisd(Pi, Vector3d::UnitZ()).toRotationMatrix();
  CHECK(CountTurnedOver(Meshes::Patch(4, 0.0).P, Meshes::Patch(4, 0.0).P, Meshes::Patch(4, 0.0).F,
          AllThe(Eigen::AngleAxisd(Pi, Vector3d::UnitX()).toRotationMatrix(), 25)) == 32,
    "a sheet that stays while its proxy turns over is turned over");
  CHECK(CountTurnedOver(mesh.P, mesh.P * half, mesh.F, AllThe(half, n)) == 0, "half a turn");

  // One point of a flat sheet pulled across the opposite edges: its triangles that fold.
  const TriangleMesh sheet =
    Meshes::Make({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.5, 0.5, 0 } },
      { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } });
  Points Q = sheet.P;
  Q.row(4) << 1.5, 0.5, 0.0;
  const Matrices I = AllThe(Matrix3d::Identity(), 5);
  CHECK(CountTurnedOver(sheet.P, Q, sheet.F, I) == 1,
    "one triangle should be turned over, not " << CountTurnedOver(sheet.P, Q, sheet.F, I));
  Q.row(4) << 1.5, 1.6, 0.0;
  CHECK(CountTurnedOver(sheet.P, Q, sheet.F, I) == 2,
    "two triangles should be turned over, not " << CountTurnedOver(sheet.P, Q, sheet.F, I));
  Q.row(4) << 1.0, 0.5, 0.0;
  CHECK(CountTurnedOver(sheet.P, Q, sheet.F, I) == 0, "a triangle without area does not count");
  for (const double scale : { 1e-100, 1e-30, 1e30, 1e70 })
  {
    Q = sheet.P;
    Q.row(4) << 1.5, 0.5, 0.0;
    CHECK(CountTurnedOver(scale * sheet.P, scale * Q, sheet.F, I) == 1,
      "the scale " << scale << " should not matter");
  }
  CHECK(CountTurnedOver(sheet.P, Q, Triangles(0, 3), I) == 0, "no triangle, none turned over");
}

//------------------------------------------------------------------------------------------------
// A model with parts off its hull, and options that exercise all stages.
TriangleMesh Model(int variant = 0)
{
  TriangleMesh mesh = Meshes::Perturbed(Meshes::Ellipsoid(2), 0.08, 11);
  if (variant == 1)
  {
    mesh.P.row(5) *= 1.4;
  }
  if (variant == 2)
  {
    mesh = Meshes::Box(4, { 1.0, 0.4, 0.3 });
  }
  return mesh;
}

std::vector<int> EverySample(const Points& samples, const Points&, double radius)
{
  std::vector<int> kept;
  for (Eigen::Index i = 0; i < samples.rows(); ++i)
  {
    if (std::all_of(kept.begin(), kept.end(),
          [&](int j) { return (samples.row(i) - samples.row(j)).norm() >= radius; }))
    {
      kept.push_back(static_cast<int>(i));
    }
  }
  return kept;
}

struct Job
{
  TriangleMesh model;
  ProxyDeformationOptions options;
};

Job Start()
{
  Job job;
  job.model = Model();
  job.options.convexProxy.numberOfPoints = 300;
  job.options.convexProxy.poissonDisk = EverySample;
  job.options.style.lambda = 5.0;
  job.options.t = Points::Constant(job.model.P.rows(), 3, 0.3);
  return job;
}

void SetModel(Job& job, const TriangleMesh& model)
{
  job.model = model;
  job.options.t = Points::Constant(model.P.rows(), 3, 0.3);
  job.options.normals.resize(0, 3);
  job.options.directions.resize(0, 3);
  job.options.hullPoints.clear();
  if (job.options.projection == Projection::DirectionArray)
  {
    job.options.projection = Projection::ClosestPoint;
  }
}

struct Change
{
  std::string name;
  std::function<void(Job&)> apply;
};

Points Radial(const Job& job)
{
  return job.model.P;
}

/// Every option by itself, to a value and to another one.
std::vector<Change> Changes()
{
  using O = ProxyDeformationOptions;
  const auto set = [](const std::function<void(O&)>& change)
  { return [change](Job& job) { change(job.options); }; };
  std::vector<Change> all;
  const char* meshers[] = { "IsotropicRemeshing", "BallPivoting", "AdvancingFront",
    "SubdividedHull" };
  for (int k = 0; k < 4; ++k)
  {
    all.push_back({ std::string("mesher ") + meshers[k],
      set([k](O& o) { o.convexProxy.mesher = static_cast<ProxyMesher>(k); }) });
  }
  for (const int n : { 200, 300 })
  {
    all.push_back({ std::to_string(n) + " proxy points",
      set([n](O& o) { o.convexProxy.numberOfPoints = n; }) });
  }
  for (const std::uint32_t seed : { 0u, 5u })
  {
    all.push_back(
      { "seed " + std::to_string(seed), set([seed](O& o) { o.convexProxy.seed = seed; }) });
  }
  all.push_back({ "own proxy", set([](O& o) { o.ownProxy = Meshes::Icosphere(2); }) });
  all.push_back({ "own open proxy", set([](O& o) { o.ownProxy = Meshes::Patch(6, 0.4); }) });
  all.push_back(
    { "own proxy of the same triangles", set([](O& o) { o.ownProxy = Meshes::Ellipsoid(2); }) });
  all.push_back({ "no own proxy", set([](O& o) { o.ownProxy = TriangleMesh(); }) });
  all.push_back({ "hull of some points",
    set(
      [](O& o) {
        o.hullPoints = { 0, 3, 5, 9, 12, 40 };
      }) });
  all.push_back({ "hull of other points",
    set(
      [](O& o) {
        o.hullPoints = { 0, 3, 5, 9, 12, 41 };
      }) });
  all.push_back({ "hull of points in a plane", set([](O& o) { o.hullPoints = { 1, 2, 3 }; }) });
  all.push_back({ "hull of all points", set([](O& o) { o.hullPoints.clear(); }) });
  for (int k = 0; k < 2; ++k)
  {
    all.push_back({ "spherical weighting " + std::to_string(k),
      set([k](O& o) { o.style.sphericalWeighting = static_cast<SphericalWeighting>(k); }) });
  }
  for (const double lambda : { 0.0, 1.0, 5.0 })
  {
    all.push_back(
      { "lambda " + std::to_string(lambda), set([lambda](O& o) { o.style.lambda = lambda; }) });
  }
  for (int k = 0; k < 3; ++k)
  {
    all.push_back({ "center mode " + std::to_string(k),
      set([k](O& o) { o.style.centerMode = static_cast<CenterMode>(k); }) });
    all.push_back({ "radius mode " + std::to_string(k),
      set(
        [k](O& o)
        {
          o.style.radiusMode = static_cast<RadiusMode>(k);
          if (o.style.radiusMode == RadiusMode::EqualVolume && o.ownProxy.F.rows() > 0)
          {
            o.ownProxy = Meshes::Icosphere(2); // an open one has no volume
          }
        }) });
  }
  for (const double x : { 0.0, 0.2 })
  {
    all.push_back({ "custom center " + std::to_string(x),
      set([x](O& o) { o.style.custom.center = Vector3d(x, 0.1, -x); }) });
    all.push_back({ "custom radius " + std::to_string(1.0 + x),
      set([x](O& o) { o.style.custom.radius = 1.0 + x; }) });
  }
  for (int k = 0; k < 3; ++k)
  {
    all.push_back({ "projection " + std::to_string(k),
      set([k](O& o) { o.projection = static_cast<Projection>(k); }) });
  }
  all.push_back({ "projection along directions",
    [](Job& job)
    {
      job.options.directions = Radial(job);
      job.options.projection = Projection::DirectionArray;
    } });
  all.push_back({ "other directions",
    [](Job& job)
    {
      job.options.directions = Radial(job);
      job.options.directions.col(1).setZero();
    } });
  for (const int k : { 1, 4, 9 })
  {
    all.push_back({ std::to_string(k) + " neighbors", set([k](O& o) { o.neighbors = k; }) });
  }
  all.push_back({ "normals of its own", [](Job& job) { job.options.normals = Radial(job); } });
  all.push_back({ "no normals", [](Job& job) { job.options.normals.resize(0, 3); } });
  for (const double t : { 0.0, 0.7, 1.0 })
  {
    all.push_back({ "t " + std::to_string(t), [t](Job& job) { job.options.t.setConstant(t); } });
  }
  all.push_back({ "t per axis", [](Job& job) { job.options.t.col(2).setConstant(0.9); } });
  for (int k = 0; k < 2; ++k)
  {
    all.push_back({ "transfer " + std::to_string(k),
      set([k](O& o) { o.transfer = static_cast<Transfer>(k); }) });
  }
  all.push_back({ "gain", set([](O& o) { o.gain = Vector3d(1.2, 0.8, 1.0); }) });
  all.push_back({ "no gain", set([](O& o) { o.gain = Vector3d::Ones(); }) });
  for (const int threads : { 1, 2, 3, 7 })
  {
    all.push_back(
      { std::to_string(threads) + " threads", set([threads](O& o) { o.threads = threads; }) });
  }
  for (int variant = 0; variant < 3; ++variant)
  {
    all.push_back({ "model " + std::to_string(variant),
      [variant](Job& job) { SetModel(job, Model(variant)); } });
  }
  all.push_back({ "no triangles", [](Job& job) { job.model.F.resize(0, 3); } });
  all.push_back({ "other triangles",
    [](Job& job)
    {
      if (job.model.F.rows() > 2)
      {
        job.model.F = job.model.F.topRows(job.model.F.rows() - 2).eval();
      }
    } });
  all.push_back({ "a flat model",
    [](Job& job)
    {
      TriangleMesh flat = Model();
      flat.P.col(2).setZero();
      SetModel(job, flat);
      job.options.ownProxy = TriangleMesh();
    } });
  all.push_back({ "nothing", [](Job&) {} });
  return all;
}

bool SameNumber(double a, double b)
{
  return a == b || (std::isnan(a) && std::isnan(b));
}

/// What the object says is what a fresh one says, to the bit.
void CheckFresh(const std::string& about, const ProxyDeformation& kept,
  const ProxyDeformationReport& report, const Job& job)
{
  ProxyDeformation fresh;
  const ProxyDeformationReport expected = fresh.Deform(job.model, job.options);
  CHECK(Meshes::SameBits(kept.GetPositions(), fresh.GetPositions()), about << ": points differ");
  CHECK(Meshes::SameBits(kept.GetProxy().rest.P, fresh.GetProxy().rest.P) &&
      kept.GetProxy().rest.F.rows() == fresh.GetProxy().rest.F.rows() &&
      kept.GetProxy().rest.F == fresh.GetProxy().rest.F,
    about << ": proxies differ");
  CHECK(Meshes::SameBits(kept.GetProxy().rounded, fresh.GetProxy().rounded),
    about << ": rounded proxies differ");
  CHECK(
    SameBits(kept.GetProxy().rotations, fresh.GetProxy().rotations), about << ": rotations differ");
  const Feet& a = kept.GetFeet();
  const Feet& b = fresh.GetFeet();
  const auto same = [](const Eigen::VectorXi& x, const Eigen::VectorXi& y)
  { return x.size() == y.size() && x == y; };
  CHECK(same(a.cell, b.cell) && Meshes::SameBits(a.barycentric, b.barycentric) &&
      same(a.projectionCase, b.projectionCase) && same(a.byClosestPoint, b.byClosestPoint),
    about << ": feet differ");
  CHECK(report.aborted == expected.aborted && report.flat == expected.flat &&
      report.fallback == expected.fallback &&
      SameNumber(report.convexityRatio, expected.convexityRatio) &&
      report.turnedOver == expected.turnedOver && report.withoutHit == expected.withoutHit &&
      report.firstWithoutHit == expected.firstWithoutHit &&
      report.caseCounts == expected.caseCounts &&
      report.projectionError == expected.projectionError &&
      report.style.sphere.center == expected.style.sphere.center &&
      report.style.sphere.radius == expected.style.sphere.radius,
    about << ": reports differ; projection errors " << report.projectionError << " and "
          << expected.projectionError << ", turned over " << report.turnedOver << " and "
          << expected.turnedOver << ", case counts " << report.caseCounts.transpose() << " and "
          << expected.caseCounts.transpose());
}

// Each change from the start and back.
void TestEachChange()
{
  for (const Change& change : Changes())
  {
    ProxyDeformation kept;
    Job job = Start();
    kept.Deform(job.model, job.options);
    change.apply(job);
    ProxyDeformationReport report = kept.Deform(job.model, job.options);
    CheckFresh(change.name, kept, report, job);
    job = Start();
    report = kept.Deform(job.model, job.options);
    CheckFresh(change.name + " taken back", kept, report, job);
  }
}

/// Options that have a meaning in one mode only, changed there and back. Each must tell.
void TestEachChangeInItsMode()
{
  struct Case
  {
    std::string name;
    std::function<void(Job&)> mode;
    std::function<void(Job&)> apply;
  };
  const auto angle = [](Job& job) { job.options.projection = Projection::SmallestAngle; };
  const auto directions = [](Job& job)
  {
    job.options.projection = Projection::DirectionArray;
    job.options.directions = Radial(job);
  };
  const auto vertices = [](Job& job)
  {
    job.options.convexProxy.mesher = ProxyMesher::SubdividedHull; // slivers: one is too few
    job.options.projection = Projection::NearestVertices;
    job.options.neighbors = 1;
  };
  const auto center = [](Job& job)
  {
    job.options.style.centerMode = CenterMode::Custom;
    job.options.style.custom.center = Vector3d(0.1, 0.0, 0.0);
  };
  const auto radius = [](Job& job)
  {
    job.options.style.radiusMode = RadiusMode::Custom;
    job.options.style.custom.radius = 1.0;
  };
  const auto balls = [](Job& job) { job.options.convexProxy.mesher = ProxyMesher::BallPivoting; };
  const std::vector<Case> cases = { { "directions", directions,
                                      [](Job& job) { job.options.directions.col(1).setZero(); } },
    { "neighbors", vertices, [](Job& job) { job.options.neighbors = 4; } },
    { "normals", angle, [](Job& job) { job.options.normals = Radial(job); } },
    { "triangles that make the normals", angle,
      [](Job& job) { job.model.F = job.model.F.topRows(job.model.F.rows() / 2).eval(); } },
    { "custom center", center,
      [](Job& job) { job.options.style.custom.center = Vector3d(0.0, 0.2, 0.1); } },
    { "custom radius", radius, [](Job& job) { job.options.style.custom.radius = 1.3; } },
    { "seed", balls, [](Job& job) { job.options.convexProxy.seed = 9; } } };
  for (const Case& c : cases)
  {
    ProxyDeformation kept;
    Job job = Start();
    c.mode(job);
    kept.Deform(job.model, job.options);
    const Points before = kept.GetPositions();
    Job changed = job;
    c.apply(changed);
    ProxyDeformationReport report = kept.Deform(changed.model, changed.options);
    CheckFresh(c.name + " in its mode", kept, report, changed);
    CHECK(!Meshes::SameBits(kept.GetPositions(), before), c.name << " should move points");
    report = kept.Deform(job.model, job.options);
    CheckFresh(c.name + " in its mode, taken back", kept, report, job);
  }
}

/// Errors of all kinds: each must throw.
std::vector<Change> Mistakes()
{
  return { { "lambda NaN", [](Job& job) { job.options.style.lambda = NaN; } },
    { "lambda below 0", [](Job& job) { job.options.style.lambda = -1.0; } },
    { "center NaN",
      [](Job& job)
      {
        job.options.style.centerMode = CenterMode::Custom;
        job.options.style.custom.center[1] = NaN;
      } },
    { "radius 0",
      [](Job& job)
      {
        job.options.style.radiusMode = RadiusMode::Custom;
        job.options.style.custom.radius = 0.0;
      } },
    { "3 points",
      [](Job& job)
      {
        job.options.ownProxy = TriangleMesh();
        job.options.convexProxy.numberOfPoints = 3;
      } },
    { "a line",
      [](Job& job)
      {
        TriangleMesh line = Model();
        line.P.rightCols(2).setZero();
        SetModel(job, line);
        job.options.ownProxy = TriangleMesh();
      } },
    { "one place",
      [](Job& job)
      {
        TriangleMesh dot = Model();
        dot.P.setConstant(0.1);
        SetModel(job, dot);
        job.options.ownProxy = TriangleMesh();
      } },
    { "own proxy NaN",
      [](Job& job)
      {
        job.options.ownProxy = Meshes::Icosphere(1);
        job.options.ownProxy.P(3, 1) = NaN;
      } },
    { "own proxy without area",
      [](Job& job)
      {
        job.options.ownProxy = Meshes::Icosphere(1);
        job.options.ownProxy.P.setZero();
      } } };
}

// Chains of changes at random, with errors and aborts between them.
void TestChains()
{
  Meshes::Random random(12);
  const std::vector<Change> changes = Changes();
  const std::vector<Change> mistakes = Mistakes();
  const auto pick = [&](const std::vector<Change>& all) -> const Change&
  { return all[static_cast<std::size_t>(random.Unit() * static_cast<double>(all.size()))]; };
  for (int chain = 0; chain < 12; ++chain)
  {
    ProxyDeformation kept;
    Job job = Start();
    std::string about = "chain " + std::to_string(chain);
    for (int step = 0; step < 14; ++step)
    {
      const double dice = random.Unit();
      if (dice < 0.2)
      {
        const Change& mistake = pick(mistakes);
        Job wrong = job;
        mistake.apply(wrong);
        about += ", error " + mistake.name;
        CHECK(Throws([&] { kept.Deform(wrong.model, wrong.options); }),
          mistake.name << " should throw");
        continue;
      }
      const Change& change = pick(changes);
      about += ", " + change.name;
      change.apply(job);
      if (dice < 0.45)
      {
        int calls = static_cast<int>(8.0 * random.Unit());
        about += " aborted after " + std::to_string(calls);
        kept.Deform(job.model, job.options, [&calls](double) { return calls-- > 0; });
        if (dice < 0.35)
        {
          continue;
        }
      }
      const ProxyDeformationReport report = kept.Deform(job.model, job.options);
      CheckFresh(about, kept, report, job);
    }
  }
}

void TestErrors()
{
  for (const Change& mistake : Mistakes())
  {
    for (const int projection : { 0, 1, 2 })
    {
      ProxyDeformation kept;
      Job job = Start();
      job.options.projection = static_cast<Projection>(projection);
      kept.Deform(job.model, job.options);
      Job wrong = job;
      mistake.apply(wrong);
      CHECK(
        Throws([&] { kept.Deform(wrong.model, wrong.options); }), mistake.name << " should throw");
      CHECK(
        Throws([&] { kept.Deform(wrong.model, wrong.options); }), mistake.name << " should throw");
      const ProxyDeformationReport report = kept.Deform(job.model, job.options);
      CheckFresh("after " + mistake.name, kept, report, job);
    }
  }
}

// An abort at each share: nothing half done is kept.
void TestAborts()
{
  for (const Change& change : Changes())
  {
    Job job = Start();
    ProxyDeformation counted;
    int total = 0;
    double last = -1.0;
    bool rises = true;
    Job changed = job;
    change.apply(changed);
    counted.Deform(changed.model, changed.options,
      [&](double share)
      {
        rises = rises && share >= last && share <= 1.0;
        last = share;
        ++total;
        return true;
      });
    CHECK(total >= 4 && rises, "shares should rise within 0..1");
    // Not every iteration for every change.
    for (int at = 0; at < total; at += at < 4 || at >= total - 3 ? 1 : std::max(1, total / 4))
    {
      ProxyDeformation kept;
      kept.Deform(job.model, job.options);
      int calls = 0;
      const ProxyDeformationReport aborted =
        kept.Deform(changed.model, changed.options, [&calls, at](double) { return calls++ < at; });
      const bool early = calls <= at; // what was kept needed fewer calls
      CHECK(aborted.aborted != early, change.name << ": aborted at " << at);
      CHECK(calls <= at + 1, change.name << ": it should not ask again after an abort");
      const ProxyDeformationReport report = kept.Deform(changed.model, changed.options);
      CheckFresh(
        change.name + " after an abort at call " + std::to_string(at), kept, report, changed);
    }
  }
}

// Stages that a change does not concern are kept.
void TestStages()
{
  struct Case
  {
    std::string name;
    std::function<void(Job&)> apply;
    bool proxy, round, project;
  };
  const auto radial = [](Job& job)
  {
    job.options.directions = Radial(job);
    job.options.projection = Projection::DirectionArray;
  };
  const std::vector<Case> cases = { { "nothing", [](Job&) {}, false, false, false },
    { "t", [](Job& job) { job.options.t.setConstant(0.6); }, false, false, false },
    { "transfer", [](Job& job) { job.options.transfer = Transfer::Offset; }, false, false, false },
    { "gain", [](Job& job) { job.options.gain[0] = 2.0; }, false, false, false },
    { "threads", [](Job& job) { job.options.threads = 2; }, false, false, false },
    { "triangles of the model", [](Job& job) { job.model.F = job.model.F.topRows(9).eval(); },
      false, false, false },
    { "roundness", [](Job& job) { job.options.style.lambda = 1.0; }, false, true, false },
    { "center", [](Job& job) { job.options.style.centerMode = CenterMode::AreaCentroid; }, false,
      true, false },
    { "radius", [](Job& job) { job.options.style.radiusMode = RadiusMode::EqualVolume; }, false,
      true, false },
    { "projection", [](Job& job) { job.options.projection = Projection::SmallestAngle; }, false,
      false, true },
    { "directions", radial, false, false, true },
    { "seed of a mesher without samples", [](Job& job) { job.options.convexProxy.seed = 9; }, false,
      false, false },
    { "number", [](Job& job) { job.options.convexProxy.numberOfPoints = 250; }, true, true, true },
    { "mesher", [](Job& job) { job.options.convexProxy.mesher = ProxyMesher::SubdividedHull; },
      true, true, true },
    { "spherical weighting",
      [](Job& job) { job.options.style.sphericalWeighting = SphericalWeighting::Cotangent; }, false,
      true, false },
    { "hull points",
      [](Job& job) {
        job.options.hullPoints = { 0, 3, 5, 9, 12, 40 };
      },
      true, true, true },
    { "own proxy", [](Job& job) { job.options.ownProxy = Meshes::Icosphere(2); }, true, true,
      true },
    { "a point", [](Job& job) { job.model.P(3, 1) += 0.01; }, true, true, true } };
  for (const Case& c : cases)
  {
    ProxyDeformation kept;
    Job job = Start();
    ProxyDeformationReport report = kept.Deform(job.model, job.options);
    CHECK(report.done.proxy && report.done.round && report.done.project,
      "the first time all stages are done");
    c.apply(job);
    report = kept.Deform(job.model, job.options);
    CHECK(report.done.proxy == c.proxy, c.name << ": the proxy");
    CHECK(report.done.round == c.round, c.name << ": the rounding");
    CHECK(report.done.project == c.project, c.name << ": the projection");
    const auto& s = report.seconds;
    CHECK(
      (c.proxy || s.proxy == 0.0) && (c.round || s.round == 0.0) && (c.project || s.project == 0.0),
      c.name << ": what is kept takes no time");
  }
  // An own proxy does not depend on the model: only feet do.
  ProxyDeformation kept;
  Job job = Start();
  job.options.ownProxy = Meshes::Icosphere(2);
  kept.Deform(job.model, job.options);
  job.model.P(3, 1) += 0.01;
  ProxyDeformationReport report = kept.Deform(job.model, job.options);
  CHECK(!report.done.proxy && !report.done.round && report.done.project,
    "another model and the same own proxy: only the projection");
  CheckFresh("another model and the same own proxy", kept, report, job);
  job.options.convexProxy.numberOfPoints = 77;
  report = kept.Deform(job.model, job.options);
  CHECK(!report.done.proxy, "the number of points means nothing to an own proxy");
}

void TestThreads()
{
  for (const int projection : { 0, 1, 2, 3 })
  {
    Job job = Start();
    SetModel(job, Meshes::Perturbed(Meshes::Ellipsoid(4), 0.02, 3)); // enough to share out
    job.options.projection = static_cast<Projection>(projection);
    job.options.directions = job.model.P;
    job.options.transfer = Transfer::Offset;
    ProxyDeformation one;
    one.Deform(job.model, job.options);
    for (const int threads : { 2, 3, 7 })
    {
      job.options.threads = threads;
      ProxyDeformation other;
      other.Deform(job.model, job.options);
      CHECK(Meshes::SameBits(one.GetPositions(), other.GetPositions()),
        threads << " threads should give the same bits as one, projection " << projection);
    }
  }
}

// The method as a whole.
void TestMethod()
{
  Job job = Start();
  job.options.t.setOnes();
  ProxyDeformation deformation;
  deformation.Deform(job.model, job.options);
  CHECK(Meshes::SameBits(deformation.GetPositions(), job.model.P), "t = 1 should be the identity");
  double spread = RadiusSpread(job.model.P, job.model.P.colwise().mean().transpose());
  for (const double t : { 0.8, 0.5, 0.2, 0.0 }) // A5.12
  {
    job.options.t.setConstant(t);
    deformation.Deform(job.model, job.options);
    const Points& Q = deformation.GetPositions();
    const double now = RadiusSpread(Q, Q.colwise().mean().transpose());
    CHECK(now < spread, "with less t it should be rounder: " << now << " at " << t);
    spread = now;
  }
  // Its centroid stays.
  const DeformedProxy& proxy = deformation.GetProxy();
  const Eigen::VectorXd areas = PointAreas(proxy.rest.P, proxy.rest.F);
  const double move = (areas.transpose() * (proxy.rounded - proxy.rest.P)).norm() / areas.sum();
  CHECK(move <= 1e-12, "the centroid of the proxy moved by " << move);

  // A convex model fills its hull, a closed one with a dent less, an open one has no volume.
  const auto ratio = [&](const TriangleMesh& mesh)
  {
    SetModel(job, mesh);
    return deformation.Deform(job.model, job.options).convexityRatio;
  };
  CHECK_NEAR(ratio(Meshes::Box(3)), 1.0, 1e-12, "convexity ratio of a box");
  TriangleMesh inward = Meshes::Box(3);
  inward.F.col(0).swap(inward.F.col(1));
  CHECK_NEAR(ratio(inward), 1.0, 1e-12, "convexity ratio of a box turned inside out");
  TriangleMesh dented = Meshes::Icosphere(2);
  dented.P.topRows(12) *= 0.5;
  CHECK(ratio(dented) < 0.95, "a dent should lower the convexity ratio");
  TriangleMesh open = Meshes::Box(3);
  open.F = open.F.topRows(open.F.rows() - 1).eval();
  CHECK(std::isnan(ratio(open)), "an open model has no convexity ratio");
  CHECK_NEAR(ratio(Meshes::Box(3)), 1.0, 1e-12, "convexity ratio of the same points, closed");
  open.F.resize(0, 3);
  CHECK(std::isnan(ratio(open)), "points have no convexity ratio");
}
} // namespace

int main()
{
  TestSurfaceRotations();
  TestRotationsAtFeet();
  TestFormula();
  TestEnds();
  TestRigidMotion();
  TestTurnedOver();
  TestMethod();
  TestStages();
  TestThreads();
  TestErrors();
  TestEachChange();
  TestEachChangeInItsMode();
  TestAborts();
  TestChains();
  return CheckResult();
}
