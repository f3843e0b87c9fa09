// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Open3D's deform_as_rigid_as_possible.
#include "BenchmarkProgram.h"
#include "PeerProblem.h"

#include <open3d/geometry/TriangleMesh.h>
#include <open3d/utility/Logging.h>

namespace
{
constexpr const char* Usage = "usage: Open3DDeformation MESH [--iterations N]";

open3d::geometry::TriangleMesh ToOpen3D(const SphericalStyle::TriangleMesh& mesh)
{
  open3d::geometry::TriangleMesh result;
  result.vertices_.resize(mesh.P.rows());
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    result.vertices_[i] = mesh.P.row(i);
  }
  result.triangles_.resize(mesh.F.rows());
  for (Eigen::Index t = 0; t < mesh.F.rows(); ++t)
  {
    result.triangles_[t] = mesh.F.row(t);
  }
  return result;
}
}

int main(int argc, char* argv[])
{
  return Benchmarks::Main(Usage,
    [&]
    {
      const Benchmarks::Arguments arguments(argc, argv, { { "--iterations", "30" } });
      const double atStart = Benchmarks::PeakMegabytes();
      open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
      const auto input = Benchmarks::ReadMesh(arguments.At(0));
      const auto mesh = ToOpen3D(input);
      std::vector<int> points;
      std::vector<Eigen::Vector3d> positions;
      for (const auto& handle : Benchmarks::MakeHandles(input.P))
      {
        points.push_back(handle.point);
        positions.push_back(handle.position);
      }
      // Set-up and iterations are one call: the difference of two runs is what iterations take.
      const int iterations = arguments.Integer("--iterations");
      const Benchmarks::Timer shortRun;
      mesh.DeformAsRigidAsPossible(points, positions, 1);
      const double one = shortRun.Seconds();
      const Benchmarks::Timer longRun;
      const auto result = mesh.DeformAsRigidAsPossible(points, positions, iterations);
      const double all = longRun.Seconds();
      const double processor = longRun.ProcessorSeconds();

      double sum = 0.0;
      for (Eigen::Index i = 0; i < input.P.rows(); ++i)
      {
        const Eigen::Vector3d& q = result->vertices_[i];
        if (!q.allFinite())
        {
          throw std::runtime_error("Open3D's result is not finite");
        }
        sum += (q - input.P.row(i).transpose()).norm();
      }
      const double perIteration = (all - one) / (iterations - 1);
      Benchmarks::Record()
        .Add("points", static_cast<double>(input.P.rows()))
        .Add("setup_seconds", one - perIteration)
        .Add("iterations", iterations)
        .Add("seconds_per_iteration", perIteration)
        .Add("total_seconds", all)
        .Add("processor_seconds", processor)
        .Add("mean_displacement", sum / input.P.rows())
        .Add("start_megabytes", atStart)
        .Add("peak_megabytes", Benchmarks::PeakMegabytes())
        .Print();
    });
}
