// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause

// Remeshes a closed triangle surface evenly. VTK has no isotropic remesher,
// and a contour of a grid is full of slivers, so that this one step of the
// model generator is done with CGAL.
//
//   CreatureMesher input.off output.off edgeLength

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

int main(int argc, char* argv[])
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  namespace PMP = CGAL::Polygon_mesh_processing;

  if (argc != 4)
  {
    std::cerr << "Usage: " << argv[0] << " input.off output.off edgeLength\n";
    return EXIT_FAILURE;
  }

  Mesh mesh;
  std::ifstream input(argv[1]);
  const double edgeLength = std::atof(argv[3]);
  if (!(input >> mesh) || !CGAL::is_closed(mesh) || !CGAL::is_triangle_mesh(mesh) ||
    !(edgeLength > 0.0))
  {
    std::cerr << "Need a closed triangle mesh and a positive edge length.\n";
    return EXIT_FAILURE;
  }

  // Many rounds, and several tangential smoothings in each of them, because
  // evenness matters here and time does not.
  PMP::isotropic_remeshing(mesh.faces(), edgeLength, mesh,
    PMP::parameters::number_of_iterations(12).number_of_relaxation_steps(3));
  mesh.collect_garbage();

  std::ofstream output(argv[2]);
  output.precision(17);
  output << mesh;
  return output ? EXIT_SUCCESS : EXIT_FAILURE;
}
