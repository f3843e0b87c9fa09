// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The projection to a sphere: on its ray, at the right distance, and what stays.
#include "Check.h"
#include "Meshes.h"
#include "SphereProjection.h"

using namespace SphericalStyle;
using Eigen::RowVector3d;
using Eigen::Vector3d;

namespace
{
// |p' - O| = (1 - s) |p - O| + s r along the direction of p - O, which is another way to say it.
void TestDistances()
{
  for (const Meshes::Named& named :
    { Meshes::Named{ "house", Meshes::House() }, Meshes::Named{ "patch", Meshes::Patch(8, 0.4) } })
  {
    const Points& P = named.mesh.P;
    for (const Vector3d& center : { Vector3d(0.1, 0.2, 0.3), Vector3d(5.0, -3.0, 9.0) })
    {
      const double outer = OuterRadius(P, center);
      for (const double radius : { outer, 0.2, 7.0 })
      {
        for (const double s : { 0.0, 0.3, 0.5, 1.0 })
        {
          std::vector<int> onCenter = { 1 };
          const Points Q = ProjectToSphere(P, { center, radius }, s, 1, onCenter);
          CHECK(onCenter.empty(), named.name << ": no point lies on the center");
          for (Eigen::Index i = 0; i < P.rows(); ++i)
          {
            const Vector3d before = P.row(i).transpose() - center;
            const Vector3d after = Q.row(i).transpose() - center;
            const double distance = before.norm();
            CHECK(distance <= outer * (1.0 + 1e-15), named.name << ": outer radius");
            CHECK_NEAR(after.norm(), (1.0 - s) * distance + s * radius, 1e-13 * (outer + radius),
              named.name << ": distance of point " << i);
            CHECK(after.dot(before) > 0.0 &&
                after.cross(before).norm() <= 1e-13 * after.norm() * distance,
              named.name << ": point " << i << " should stay on its ray");
          }
          CHECK(s > 0.0 || Q == P, named.name << ": s = 0 should be the model to the last bit");
        }
      }
    }
  }
}

void TestPointsOnCenter()
{
  Points P(4, 3);
  P << 1, 0, 0, 0.5, 0.25, 2, 0, 1, 0, 0.5, 0.25, 2;
  const Sphere sphere = { Vector3d(0.5, 0.25, 2), 3.0 };
  std::vector<int> onCenter;
  const Points Q = ProjectToSphere(P, sphere, 1.0, 1, onCenter);
  CHECK((onCenter == std::vector<int>{ 1, 3 }), "points 1 and 3 lie on the center");
  CHECK(Q.row(1) == P.row(1) && Q.row(3) == P.row(3), "they should stay");
  CHECK_NEAR((Q.row(0) - sphere.center.transpose()).norm(), 3.0, 1e-15, "the others move");

  const Points same = RowVector3d(1e5, 2, 3).replicate(3, 1);
  CHECK(OuterRadius(same, Vector3d(1e5, 2, 3)) == 0.0, "the outer radius of one place is 0");
  CHECK(ProjectToSphere(same, { Vector3d(1e5, 2, 3), 0.0 }, 0.5, 1, onCenter) == same &&
      onCenter.size() == 3,
    "points at one place are all on their mean and stay");
  CHECK(OuterRadius(Points(0, 3), Vector3d::Zero()) == 0.0, "no points, no radius");
}
} // namespace

int main()
{
  TestDistances();
  TestPointsOnCenter();
  return CheckResult();
}
