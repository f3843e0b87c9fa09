// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Parts become as large as they are told to and stay together [sizes].
#include "Check.h"
#include "Frame.h"
#include "Meshes.h"
#include "PartSizes.h"
#include "SurfaceMeasures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace SphericalStyle;
using Meshes::Vector;

namespace
{
constexpr double Width = 0.01;
constexpr double Alone = 1e-4; // what other parts have in a point that is of one part
constexpr int Threads = 2;
enum DollParts
{
  Body,
  Top, // the head
  Arm,
  Hand,
  Count
};

/// A doll in the frame, whose right arm has a hand.
struct DollModel
{
  TriangleMesh mesh = Meshes::Doll();
  double scale = 1.0; // of the frame
  std::vector<int> parts;

  DollModel()
  {
    for (Eigen::Index i = 0; i < this->mesh.P.rows(); ++i)
    {
      const Vector x = this->mesh.P.row(i);
      const bool far = x.norm() > 1.05;
      this->parts.push_back(!far || x(1) < -0.6 || x(0) < -0.9 ? Body
          : x(1) > 0.8                                         ? Top
          : x(0) < 1.8                                         ? Arm
                                                               : Hand);
    }
    const Frame frame = FrameOf(this->mesh.P);
    this->scale = frame.scale;
    this->mesh.P = frame.Into(this->mesh.P);
  }
  PartSizes Sized(double width = Width) const
  {
    return PartSizes(this->mesh.P, this->mesh.F, this->parts, Count, width, Threads);
  }
  /// Points that are of one part alone.
  std::vector<int> Inside(const PartSizes& sized, int part) const
  {
    std::vector<int> inside;
    for (Eigen::Index i = 0; i < this->mesh.P.rows(); ++i)
    {
      if (sized.GetShares()(i, part) > 1.0 - Alone)
      {
        inside.push_back(static_cast<int>(i));
      }
    }
    return inside;
  }
};

Eigen::VectorXd Sizes(double body, double head, double arm, double hand)
{
  return Eigen::Vector4d(body, head, arm, hand);
}

/// @return largest |x' - (s x + b)| over some points, b the mean that fits
double OffScaling(
  const Points& P, const Points& Q, const std::vector<int>& points, double s, Vector& b)
{
  const Points moves = Q(points, AllColumns) - s * P(points, AllColumns);
  b = moves.colwise().mean().transpose();
  return (moves.rowwise() - b.transpose()).rowwise().norm().maxCoeff();
}

void CheckScalings()
{
  const DollModel doll;
  const Points& P = doll.mesh.P;
  const PartSizes sized = doll.Sized();
  CHECK((sized.GetShares().rowwise().sum().array() - 1.0).abs().maxCoeff() < 1e-12,
    "shares should sum to 1");
  CHECK(Meshes::Distance(sized.Sized(Sizes(1, 1, 1, 1)), P) < 1e-12, "at size 1 nothing moves");
  // One size for all scales all, about the centroid of the largest part.
  const Points twice = sized.Sized(Sizes(2, 2, 2, 2));
  Eigen::RowVector4d body = Eigen::RowVector4d::Zero();
  const Eigen::VectorXd areas = PointAreas(P, doll.mesh.F);
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    if (doll.parts[i] == Body)
    {
      body += areas(i) * P.row(i).homogeneous();
    }
  }
  const Eigen::RowVector3d center = body.head<3>() / body(3);
  CHECK(Meshes::Distance(twice, (2.0 * P).rowwise() - center) < 1e-12,
    "one size for all should scale about the body");
  // Linear.
  const Points some = sized.Sized(Sizes(1, 1.6, 0.5, 2));
  CHECK(Meshes::Distance(0.5 * (some + twice), sized.Sized(Sizes(1.5, 1.8, 1.25, 2))) < 1e-12,
    "results should be linear in the sizes");
  // Each part is scaled as a whole where it is alone; the arm is too short for that.
  const double sizes[] = { 1.0, 1.6, 0.5, 2.0 };
  Vector moves[Count];
  for (const int part : { Body, Top, Hand })
  {
    const std::vector<int> inside = doll.Inside(sized, part);
    CHECK(inside.size() > 20, "part " << part << " should have points of its own");
    CHECK(OffScaling(P, some, inside, sizes[part], moves[part]) < 2.0 * Alone,
      "part " << part << " should be scaled as a whole");
  }
  CHECK(moves[Body].norm() < Alone, "the body should stay");
}

/// A joint is where both maps agree: on the border, and half of what is beyond stays half.
void CheckJoints()
{
  const DollModel doll;
  const Points& P = doll.mesh.P;
  const PartSizes sized = doll.Sized();
  const double s = 1.5;
  const Points head = sized.Sized(Sizes(1, s, 1, 1));
  Vector b;
  OffScaling(P, head, doll.Inside(sized, Top), s, b);
  // s j + b = j, j in the middle of the circle at which the head leaves the body.
  const Vector joint = b / (1.0 - s);
  double height = 0.0;
  double count = 0.0;
  for (Eigen::Index f = 0; f < doll.mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int i = doll.mesh.F(f, k);
      const int j = doll.mesh.F(f, (k + 1) % 3);
      if (doll.parts[i] == Top && doll.parts[j] == Body)
      {
        height += 0.5 * (P(i, 1) + P(j, 1));
        count += 1.0;
      }
    }
  }
  CHECK(std::abs(joint(0)) < 1e-3 && std::abs(joint(2)) < 1e-3, "the neck should be in the middle");
  CHECK_NEAR(joint(1), height / count, 0.5 * Width, "height of the neck");
  CHECK(doll.Inside(sized, Hand).size() > 20 &&
      (head - P)(doll.Inside(sized, Hand), AllColumns).rowwise().norm().maxCoeff() < Alone,
    "a hand should not move with the head");
  // A hand goes along with its arm, as a whole, by what the arm becomes longer.
  const Points arm = sized.Sized(Sizes(1, 1, s, 1));
  CHECK(
    OffScaling(P, arm, doll.Inside(sized, Hand), 1.0, b) < Alone, "a hand should keep its shape");
  const double length = (1.8 - 1.05) / doll.scale; // of the arm
  CHECK_NEAR(b(0), (s - 1.0) * length, 0.2 * length, "how far the hand goes");
  CHECK(std::abs(b(2)) < 0.02 * b(0), "it should go along the arm");
  // Neighbors pass into each other: no triangle turns over, and few do in creases where a thick arm
  // becomes a third and what is on it three times as large.
  const PartSizes soft = doll.Sized(0.05);
  const Points normals = TriangleNormals(P, doll.mesh.F);
  for (const auto& [size, most] : { std::pair(0.3, 10), { 0.6, 0 }, { 1.6, 5 }, { 3.0, 350 } })
  {
    const Points Q = soft.Sized(Sizes(1, size, 1 / size, size));
    const Points after = TriangleNormals(Q, doll.mesh.F);
    const auto turned = (normals.cwiseProduct(after).rowwise().sum().array() < 0.0).count();
    CHECK(turned <= most, turned << " triangles should not turn over at size " << size);
  }
}

void CheckLooseParts()
{
  // A ball, another one that touches nothing, and a third beyond that one.
  const TriangleMesh ball = Meshes::Icosphere(3);
  TriangleMesh mesh =
    Meshes::Together({ ball, Meshes::Moved(ball, { 3, 0, 0 }), Meshes::Moved(ball, { 6, 0, 0 }) });
  const auto n = static_cast<std::size_t>(ball.P.rows());
  std::vector<int> parts(3 * n, 0);
  std::fill(parts.begin() + n, parts.begin() + 2 * n, 1);
  std::fill(parts.begin() + 2 * n, parts.end(), 2);
  const Frame frame = FrameOf(mesh.P);
  const Points P = frame.Into(mesh.P);
  const PartSizes sized(P, mesh.F, parts, 3, Width, Threads);
  // They grow where the gaps between them are: about 1.5 and 4.5.
  const Points Q = frame.OutOf(sized.Sized(Eigen::Vector3d(1, 2, 1)));
  const auto place = [&](std::size_t k)
  { return Q(k * n, 0) - ball.P(0, 0) * (k == 1 ? 2.0 : 1.0); };
  CHECK_NEAR(place(0), 0.0, 1e-9, "the first should stay");
  CHECK_NEAR(place(1), 1.5 + 2.0 * (3.0 - 1.5), 0.1, "the second should grow from the gap");
  CHECK_NEAR(place(2), 1.5 + 2.0 * (4.5 - 1.5) + 6.0 - 4.5, 0.2, "the third should go along");
  const std::vector<int> hanging = sized.HangingOn(1, 0);
  CHECK(hanging == std::vector<int>{ 2 }, "the third should hang on the second");
}

void CheckHeads()
{
  const DollModel doll;
  const Points& P = doll.mesh.P;
  const PartSizes sized = doll.Sized();
  constexpr int Up = 1;
  const Head head = FindHead(sized, P, doll.mesh.F, doll.parts, Count, Up);
  CHECK(head.part == Top && head.along.empty(), "the ball on top should be the head");
  const Head arm = FindHead(sized, P, doll.mesh.F, doll.parts, Count, Up, Arm);
  CHECK(
    arm.part == Arm && arm.along == std::vector<int>{ Hand }, "the hand should go with the arm");
  Eigen::VectorXd sizes = Sizes(1, 1.3, 0.7, 2);
  for (const double wanted : { 0.3, 0.5, 1.0 })
  {
    const double factor = FactorForHeightRatio(sized, sizes, doll.parts, head, Up, wanted);
    const Points Q = sized.Sized(Sizes(1, 1.3 * factor, 0.7, 2));
    CHECK_NEAR(HeightRatio(Q, doll.parts, head, Up), wanted, 1e-9, "height of head to body");
  }
  CHECK(FactorForHeightRatio(sized, sizes, doll.parts, head, Up, 1e3) == 0.0 &&
      FactorForHeightRatio(sized, sizes, doll.parts, head, Up, 1e-3) == 0.0,
    "what cannot be reached should be told");
  const auto [least, most] = HeightRatiosInReach(sized, sizes, doll.parts, head, Up);
  CHECK_NEAR(least, HeightRatio(sized.Sized(Sizes(1, 1.3 / 20, 0.7, 2)), doll.parts, head, Up),
    1e-9, "least ratio in reach");
  CHECK_NEAR(most, HeightRatio(sized.Sized(Sizes(1, 1.3 * 20, 0.7, 2)), doll.parts, head, Up), 1e-9,
    "largest ratio in reach");
  for (const double ratio : { least, most })
  {
    CHECK(FactorForHeightRatio(sized, sizes, doll.parts, head, Up, 0.99 * ratio) == 0.0 ||
        FactorForHeightRatio(sized, sizes, doll.parts, head, Up, 1.01 * ratio) == 0.0,
      "what is beyond should be out of reach");
  }
}
}

int main()
{
  CheckScalings();
  CheckJoints();
  CheckLooseParts();
  CheckHeads();
  return CheckResult();
}
