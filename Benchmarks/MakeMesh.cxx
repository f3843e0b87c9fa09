// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes a mesh to measure with and prints what it is like.
#include "BenchmarkMesh.h"
#include "BenchmarkProgram.h"
#include "MeshQuality.h"

namespace
{
constexpr const char* Usage = "usage: MakeMesh even|slivers NUMBER_OF_POINTS OUTPUT";
}

int main(int argc, char* argv[])
{
  return Benchmarks::Main(Usage,
    [&]
    {
      const Benchmarks::Arguments arguments(argc, argv, {});
      const auto mesh =
        Benchmarks::MakeMesh(Benchmarks::FamilyNamed(arguments.At(0)), std::stoi(arguments.At(1)));
      Benchmarks::WriteMesh(mesh, arguments.At(2));
      const Eigen::MatrixX2d angles = SphericalStyle::ExtremeAngles(mesh.P, mesh.F);
      Benchmarks::Record()
        .Add("points", static_cast<double>(mesh.P.rows()))
        .Add("triangles", static_cast<double>(mesh.F.rows()))
        .Add("smallest_angle", angles.col(0).minCoeff())
        .Add("largest_angle", angles.col(1).maxCoeff())
        .Add("obtuse_share", (angles.col(1).array() > 90.0).cast<double>().mean())
        .Print();
    });
}
