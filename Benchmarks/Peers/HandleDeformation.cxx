// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Handles, beside CGAL's Surface_mesh_deformation: a bar of 4 x 4 x 20, held at one end, and turned
// by a quarter and moved at the other. Both iterate as far as it goes; energies of both results are
// summed by this program, with rotations of its own.
#include "BenchmarkProgram.h"
#include "ConstrainedCholesky.h"
#include "Handles.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>
#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace
{
using SphericalStyle::Points;
using SphericalStyle::TriangleMesh;
using SphericalStyle::Triangles;

constexpr const char* Usage =
  "usage: HandleDeformation [options]\n"
  "  --divisions N  edges of a triangle per unit of length (default 5)\n"
  "  --bumps H      height of bumps on the sides of the bar (default 0)\n"
  "  --tolerance T  of the filter (default 1e-5)\n"
  "  --repeats N    runs whose median counts (default 5)\n"
  "  --threads N    of the filter (default 1)";

const std::array<int, 3> Lengths = { 4, 4, 20 };
constexpr double HandleLength = 1.0;
constexpr double Near = 1.0 + 1e-6; // of energies: as low as ours

/// The surface of a box of unit cells cut into d x d squares of two triangles.
TriangleMesh MakeBar(int d, double bumps)
{
  const std::array<int, 3> n = { d * Lengths[0], d * Lengths[1], d * Lengths[2] };
  std::map<std::array<int, 3>, int> ids;
  std::vector<std::array<int, 3>> corners;
  const auto id = [&](const std::array<int, 3>& at)
  { return ids.try_emplace(at, static_cast<int>(ids.size())).first->second; };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (int k = 0; k < 2 * n[u] * n[v]; ++k)
    {
      const bool high = k % 2 == 1;
      std::array<int, 3> at = {};
      at[axis] = high ? n[axis] : 0;
      at[u] = k / 2 % n[u];
      at[v] = k / 2 / n[u];
      const auto corner = [&](int du, int dv)
      {
        std::array<int, 3> other = at;
        other[u] += du;
        other[v] += dv;
        return id(other);
      };
      const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), e = corner(0, 1);
      corners.push_back(high ? std::array<int, 3>{ a, b, c } : std::array<int, 3>{ a, c, b });
      corners.push_back(high ? std::array<int, 3>{ a, c, e } : std::array<int, 3>{ a, e, c });
    }
  }
  TriangleMesh mesh;
  mesh.P.resize(static_cast<Eigen::Index>(ids.size()), 3);
  for (const auto& [at, i] : ids)
  {
    Eigen::RowVector3d p(at[0], at[1], at[2]);
    p /= d;
    // Outward from the axis, none at the ends.
    const double z = p[2];
    const double bump = bumps * std::sin(3.0 * p[0] + 1.0) * std::sin(3.0 * p[1] + 2.0) *
      std::sin(2.5 * z) * std::min({ 1.0, 0.5 * z, 0.5 * (Lengths[2] - z) });
    p[0] += bump * (p[0] - 0.5 * Lengths[0]);
    p[1] += bump * (p[1] - 0.5 * Lengths[1]);
    mesh.P.row(i) = p;
  }
  mesh.F.resize(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t f = 0; f < corners.size(); ++f)
  {
    mesh.F.row(static_cast<Eigen::Index>(f)) << corners[f][0], corners[f][1], corners[f][2];
  }
  return mesh;
}

/// Half cotangents of the half-edges as rest shapes have them, m x 3.
SphericalStyle::HalfEdgeScalars HalfCotangents(const TriangleMesh& mesh)
{
  SphericalStyle::HalfEdgeScalars c(mesh.F.rows(), 3);
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d p = mesh.P.row(mesh.F(f, k));
      const Eigen::Vector3d a = mesh.P.row(mesh.F(f, (k + 1) % 3)).transpose() - p;
      const Eigen::Vector3d b = mesh.P.row(mesh.F(f, (k + 2) % 3)).transpose() - p;
      c(f, k) = 0.5 * a.dot(b) / a.cross(b).norm();
    }
  }
  return c;
}

/// An edge in the cell of a point.
struct Spoke
{
  int u;
  int v;
  double weight;
};
using CellsOfPoints = std::vector<std::vector<Spoke>>;

/// @param rims  all edges of the triangles at a point, as the filter and CGAL's SPOKES_AND_RIMS
///        have them; else its own edges, with weights below 0 as 0, as ORIGINAL_ARAP does
CellsOfPoints MakeCells(const TriangleMesh& mesh, bool rims)
{
  const auto c = HalfCotangents(mesh);
  CellsOfPoints cells(mesh.P.rows());
  std::map<std::pair<int, int>, double> edges;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = mesh.F(f, (k + 1) % 3);
      const int v = mesh.F(f, (k + 2) % 3);
      edges[std::minmax(u, v)] += c(f, k);
      for (int y = 0; y < 3 && rims; ++y)
      {
        cells[mesh.F(f, y)].push_back({ u, v, c(f, k) });
      }
    }
  }
  for (const auto& [edge, weight] : edges)
  {
    if (!rims)
    {
      cells[edge.first].push_back({ edge.first, edge.second, std::max(0.0, weight) });
      cells[edge.second].push_back({ edge.first, edge.second, std::max(0.0, weight) });
    }
  }
  return cells;
}

/// sum over cells and edges of w |e' - R e|^2 with the best rotations.
double Energy(const CellsOfPoints& cells, const Points& P, const Points& Q)
{
  double energy = 0.0;
  for (const std::vector<Spoke>& cell : cells)
  {
    Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
    for (const Spoke& s : cell)
    {
      S += s.weight * (Q.row(s.u) - Q.row(s.v)).transpose() * (P.row(s.u) - P.row(s.v));
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(S, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs(1.0, 1.0, 1.0);
    signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
    const Eigen::Matrix3d R = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    for (const Spoke& s : cell)
    {
      energy += s.weight *
        ((Q.row(s.u) - Q.row(s.v)).transpose() - R * (P.row(s.u) - P.row(s.v)).transpose())
          .squaredNorm();
    }
  }
  return energy;
}

double Median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Problem
{
  TriangleMesh Bar;
  std::vector<SphericalStyle::Handle> Handles;
  std::vector<int> OfPoints;
  SphericalStyle::StyleOptions Options;

  double Diagonal() const { return SphericalStyle::FrameOf(this->Bar.P).scale; }
};

/// One end stays, the other is turned by a quarter and moved.
Problem MakeProblem(const Benchmarks::Arguments& arguments)
{
  Problem problem;
  problem.Bar = MakeBar(arguments.Integer("--divisions"), arguments.Number("--bumps"));
  problem.Handles.resize(2);
  problem.Handles[0].place = problem.Handles[0].to = { 2.0, 2.0, 0.0 };
  problem.Handles[1].place = { 2.0, 2.0, 1.0 * Lengths[2] };
  problem.Handles[1].to = { 2.0, -12.5, 14.5 };
  problem.Handles[1].turn = { 0.5 * SphericalStyle::Pi, 0.0, 0.0 };
  problem.OfPoints.assign(problem.Bar.P.rows(), -1);
  for (Eigen::Index i = 0; i < problem.Bar.P.rows(); ++i)
  {
    const double z = problem.Bar.P(i, 2);
    problem.OfPoints[i] = z <= HandleLength ? 0 : z >= Lengths[2] - HandleLength ? 1 : -1;
  }
  problem.Options.lambda = 0.0;
  problem.Options.threads = arguments.Integer("--threads");
  problem.Options.loop.tolerance = arguments.Number("--tolerance");
  problem.Options.loop.maximumNumberOfIterations = 2000;
  SphericalStyle::HoldHandles(problem.Bar, problem.Handles, problem.OfPoints, problem.Options);
  return problem;
}

/// What the filter does: the first result, and further ones when a handle is dragged.
Points RunOurs(const Problem& problem, int repeats, Benchmarks::Record& record)
{
  std::vector<double> first;
  std::vector<double> dragged;
  Points Q;
  SphericalStyle::StyleReport report;
  const auto mesh = std::make_shared<const TriangleMesh>(problem.Bar);
  for (int k = 0; k < repeats; ++k)
  {
    SphericalStyle::StyleSolver solver;
    const Benchmarks::Timer total;
    solver.SetMesh(mesh);
    report = solver.Solve(problem.Options);
    Q = solver.GetPositions();
    first.push_back(total.Seconds());
    SphericalStyle::StyleOptions options = problem.Options;
    std::vector<SphericalStyle::Handle> handles = problem.Handles;
    handles[1].to[0] += 0.3;
    const Benchmarks::Timer again;
    SphericalStyle::HoldHandles(problem.Bar, handles, problem.OfPoints, options);
    if (solver.Solve(options).factored)
    {
      throw std::runtime_error("a dragged handle has factored again");
    }
    dragged.push_back(again.Seconds());
  }
  if (Q(problem.Options.fixedPoints, SphericalStyle::AllColumns) != problem.Options.fixedPositions)
  {
    throw std::runtime_error("points of handles are not where they were put");
  }
  record.Add("iterations", report.loop.iterations)
    .Add("start_energy", report.loop.history.front().energy.Total())
    .Add("energy", report.loop.history.back().energy.Total())
    .Add("first_seconds", Median(first))
    .Add("dragged_seconds", Median(dragged));
  return Q;
}

/// The same solver without a bound on its iterations, as far as digits go.
Points Limit(const Problem& problem)
{
  SphericalStyle::StyleSolver solver;
  solver.SetMesh(problem.Bar);
  SphericalStyle::StyleOptions options = problem.Options;
  options.loop.tolerance = 1e-13;
  options.loop.maximumNumberOfIterations = 20000;
  solver.Solve(options);
  return solver.GetPositions();
}

// Quicker than what CGAL takes by itself.
using Solver = ConstrainedCholesky<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>>;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh BarOfCgal(const TriangleMesh& mesh)
{
  Mesh result;
  for (const auto& p : mesh.P.rowwise())
  {
    result.add_vertex({ p[0], p[1], p[2] });
  }
  for (const auto& f : mesh.F.rowwise())
  {
    result.add_face(Mesh::Vertex_index(f[0]), Mesh::Vertex_index(f[1]), Mesh::Vertex_index(f[2]));
  }
  return result;
}

Points PointsOfCgal(const Mesh& mesh)
{
  Points Q(mesh.number_of_vertices(), 3);
  for (const Mesh::Vertex_index v : mesh.vertices())
  {
    Q.row(v.idx()) << mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2];
  }
  return Q;
}

/// CGAL's method, ready to iterate.
template <typename Deformation>
void SetUpCgal(const Problem& problem, const Mesh& mesh, Deformation& deformation)
{
  deformation.insert_roi_vertices(mesh.vertices_begin(), mesh.vertices_end());
  const SphericalStyle::StyleOptions& options = problem.Options;
  for (const int i : options.fixedPoints)
  {
    deformation.insert_control_vertex(Mesh::Vertex_index(i));
  }
  if (!deformation.preprocess())
  {
    throw std::runtime_error("CGAL cannot factor");
  }
  for (std::size_t k = 0; k < options.fixedPoints.size(); ++k)
  {
    const auto q = options.fixedPositions.row(static_cast<Eigen::Index>(k));
    deformation.set_target_position(
      Mesh::Vertex_index(options.fixedPoints[k]), { q[0], q[1], q[2] });
  }
}

/// Iterations of CGAL until ten of them move no point by 1e-8 of the diagonal.
/// @param reached  an energy @param iterations  takes how many lead to that, or -1
/// @return the points at the end
template <typename Deformation>
Points RunCgal(const Problem& problem, const CellsOfPoints& cells, double reached,
  const std::string& name, int& iterations, Benchmarks::Record& record)
{
  constexpr int AtATime = 10;
  constexpr int Most = 20000;
  Mesh mesh = BarOfCgal(problem.Bar);
  Deformation deformation(mesh);
  SetUpCgal(problem, mesh, deformation);
  iterations = -1;
  int done = 0;
  Points Q = problem.Bar.P;
  for (double moved = 1.0; moved > 1e-8 && done < Most;)
  {
    deformation.deform(AtATime, 0.0); // 0: no test of convergence
    done += AtATime;
    const Points next = PointsOfCgal(mesh);
    moved = (next - Q).rowwise().norm().maxCoeff() / problem.Diagonal();
    Q = next;
    if (iterations < 0 && Energy(cells, problem.Bar.P, Q) <= reached)
    {
      iterations = done;
    }
  }
  record.Add(name + "_iterations_to_the_end", done);
  return Q;
}

/// So many iterations of CGAL.
template <typename Deformation>
void TimeCgal(const Problem& problem, int iterations, int repeats, const std::string& name,
  Benchmarks::Record& record)
{
  std::vector<double> setUp;
  std::vector<double> iterating;
  for (int k = 0; k < repeats && iterations > 0; ++k)
  {
    Mesh mesh = BarOfCgal(problem.Bar);
    const Benchmarks::Timer total;
    Deformation deformation(mesh);
    SetUpCgal(problem, mesh, deformation);
    setUp.push_back(total.Seconds());
    deformation.deform(iterations, 0.0);
    iterating.push_back(total.Seconds() - setUp.back());
  }
  record.Add(name + "_iterations", iterations);
  if (!setUp.empty())
  {
    record.Add(name + "_setup_seconds", Median(setUp)).Add(name + "_seconds", Median(iterating));
  }
}

void Compare(const Problem& problem, int repeats, Benchmarks::Record& record)
{
  const Points& P = problem.Bar.P;
  const CellsOfPoints rims = MakeCells(problem.Bar, true);
  const CellsOfPoints spokes = MakeCells(problem.Bar, false);
  const Points ours = RunOurs(problem, repeats, record);
  const Points limit = Limit(problem);
  const auto difference = [&](const Points& a, const Points& b)
  { return (a - b).rowwise().norm().maxCoeff() / problem.Diagonal(); };
  const double reached = Energy(rims, P, ours);
  record.Add("rims_energy", reached)
    .Add("rims_energy_of_limit", Energy(rims, P, limit))
    .Add("spokes_energy", Energy(spokes, P, ours))
    .Add("difference_to_limit", difference(ours, limit));
  const auto run = [&](auto* method, const CellsOfPoints& cells, const std::string& name)
  {
    using Deformation = std::remove_pointer_t<decltype(method)>;
    int iterations = 0;
    const Points Q =
      RunCgal<Deformation>(problem, cells, Near * Energy(cells, P, ours), name, iterations, record);
    TimeCgal<Deformation>(problem, iterations, repeats, name, record);
    record.Add(name + "_rims_energy", Energy(rims, P, Q))
      .Add(name + "_spokes_energy", Energy(spokes, P, Q))
      .Add(name + "_difference", difference(ours, Q))
      .Add(name + "_difference_to_limit", difference(limit, Q));
  };
  using Rims = CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default,
    CGAL::SPOKES_AND_RIMS, CGAL::Default, Solver>;
  using Original = CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default,
    CGAL::ORIGINAL_ARAP, CGAL::Default, Solver>;
  run(static_cast<Rims*>(nullptr), rims, "cgal_rims");
  run(static_cast<Original*>(nullptr), spokes, "cgal_original");
}
}

int main(int argc, char* argv[])
{
  return Benchmarks::Main(Usage,
    [&]
    {
      const Benchmarks::Arguments arguments(argc, argv,
        { { "--divisions", "5" }, { "--bumps", "0" }, { "--tolerance", "1e-5" },
          { "--repeats", "5" }, { "--threads", "1" } });
      const Problem problem = MakeProblem(arguments);
      const int repeats = std::max(1, arguments.Integer("--repeats"));
      Benchmarks::Record record;
      record.Add("points", static_cast<double>(problem.Bar.P.rows()));
      Compare(problem, repeats, record);
      record.Print();
    });
}
