// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// CGAL's Surface_mesh_deformation, spokes and rims: the nearest peer of the method.
#include "BenchmarkProgram.h"
#include "ConstrainedCholesky.h"
#include "PeerProblem.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>
#include <Eigen/SparseCholesky>
#ifdef BENCHMARKS_WITH_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

namespace
{
constexpr const char* Usage =
  "usage: CgalDeformation MESH [--solver cgal|ldlt|cholmod] [--iterations N]\n"
  "  --solver  what CGAL takes by itself (Eigen's SparseLU), Eigen's SimplicialLDLT, or CHOLMOD";

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
template <typename Solver>
using Deformation = CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default,
  CGAL::SPOKES_AND_RIMS, CGAL::Default, Solver>;
using Sparse = Eigen::SparseMatrix<double>;

Mesh ToCgal(const SphericalStyle::TriangleMesh& mesh)
{
  Mesh result;
  result.reserve(mesh.P.rows(), 3 * mesh.F.rows() / 2, mesh.F.rows());
  for (const auto& p : mesh.P.rowwise())
  {
    result.add_vertex({ p[0], p[1], p[2] });
  }
  for (const auto& f : mesh.F.rowwise())
  {
    const auto added =
      result.add_face(Mesh::Vertex_index(f[0]), Mesh::Vertex_index(f[1]), Mesh::Vertex_index(f[2]));
    if (added == Mesh::null_face())
    {
      throw std::runtime_error("CGAL refuses the mesh: it is no oriented manifold");
    }
  }
  return result;
}

template <typename Solver>
void Run(const SphericalStyle::TriangleMesh& input, int iterations, Benchmarks::Record& record)
{
  const auto handles = Benchmarks::MakeHandles(input.P);
  Mesh mesh = ToCgal(input);

  const Benchmarks::Timer total;
  Deformation<Solver> deformation(mesh);
  deformation.insert_roi_vertices(mesh.vertices_begin(), mesh.vertices_end());
  for (const auto& handle : handles)
  {
    deformation.insert_control_vertex(Mesh::Vertex_index(handle.point));
  }
  if (!deformation.preprocess())
  {
    throw std::runtime_error("CGAL cannot factor");
  }
  const double setUp = total.Seconds();
  for (const auto& handle : handles)
  {
    const Eigen::Vector3d& q = handle.position;
    deformation.set_target_position(Mesh::Vertex_index(handle.point), { q[0], q[1], q[2] });
  }
  deformation.deform(iterations, 0.0); // 0: no test of convergence
  const double all = total.Seconds();
  const double processor = total.ProcessorSeconds();

  SphericalStyle::Points Q(mesh.number_of_vertices(), 3);
  for (const Mesh::Vertex_index v : mesh.vertices())
  {
    Q.row(v.idx()) << mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2];
  }
  if (!Q.allFinite())
  {
    throw std::runtime_error("CGAL's result is not finite");
  }
  record.Add("setup_seconds", setUp)
    .Add("iterations", iterations)
    .Add("seconds_per_iteration", (all - setUp) / iterations)
    .Add("total_seconds", all)
    .Add("processor_seconds", processor)
    .Add("mean_displacement", (Q - input.P).rowwise().norm().mean());
}
}

int main(int argc, char* argv[])
{
  return Benchmarks::Main(Usage,
    [&]
    {
      const Benchmarks::Arguments arguments(
        argc, argv, { { "--solver", "cgal" }, { "--iterations", "30" } });
      const double atStart = Benchmarks::PeakMegabytes();
      const auto mesh = Benchmarks::ReadMesh(arguments.At(0));
      const std::string& solver = arguments.Text("--solver");
      const int iterations = arguments.Integer("--iterations");
      Benchmarks::Record record;
      record.Add("points", static_cast<double>(mesh.P.rows())).Add("solver", solver);
      if (solver == "cgal")
      {
        Run<CGAL::Default>(mesh, iterations, record);
      }
      else if (solver == "ldlt")
      {
        Run<ConstrainedCholesky<Eigen::SimplicialLDLT<Sparse>>>(mesh, iterations, record);
      }
#ifdef BENCHMARKS_WITH_CHOLMOD
      else if (solver == "cholmod")
      {
        Run<ConstrainedCholesky<Eigen::CholmodSupernodalLLT<Sparse>>>(mesh, iterations, record);
      }
#endif
      else
      {
        throw std::invalid_argument("no solver of this build is called " + solver);
      }
      record.Add("start_megabytes", atStart)
        .Add("peak_megabytes", Benchmarks::PeakMegabytes())
        .Print();
    });
}
