// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes a mesh to measure with, generated or a model of triangles whose faces are cut into four as
// often as asked for, and prints what it is like.
#include "BenchmarkMesh.h"
#include "BenchmarkProgram.h"
#include "MeshQuality.h"

#include "vtkCellArray.h"
#include "vtkLinearSubdivisionFilter.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkPolyData.h"

namespace
{
constexpr const char* Usage = "usage: MakeMesh even|slivers NUMBER_OF_POINTS OUTPUT\n"
                              "       MakeMesh MODEL.ply NUMBER_OF_SUBDIVISIONS OUTPUT";

SphericalStyle::TriangleMesh ReadModel(const std::string& path, int subdivisions)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  vtkNew<vtkLinearSubdivisionFilter> subdivide;
  subdivide->SetInputConnection(reader->GetOutputPort());
  subdivide->SetNumberOfSubdivisions(subdivisions);
  vtkAlgorithm* last = reader;
  if (subdivisions > 0)
  {
    last = subdivide;
  }
  last->Update();
  auto* surface = vtkPolyData::SafeDownCast(last->GetOutputDataObject(0));
  if (surface->GetNumberOfPolys() == 0)
  {
    throw std::runtime_error("no triangles in " + path);
  }
  SphericalStyle::TriangleMesh mesh;
  mesh.P.resize(surface->GetNumberOfPoints(), 3);
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    surface->GetPoint(i, mesh.P.row(i).data());
  }
  mesh.F.resize(surface->GetNumberOfPolys(), 3);
  for (vtkIdType t = 0; t < surface->GetNumberOfPolys(); ++t)
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    surface->GetPolys()->GetCellAtId(t, size, corners);
    if (size != 3)
    {
      throw std::runtime_error("a face that is not a triangle in " + path);
    }
    mesh.F.row(t) = Eigen::Map<const Eigen::Matrix<vtkIdType, 1, 3>>(corners).cast<int>();
  }
  return mesh;
}
}

int main(int argc, char* argv[])
{
  return Benchmarks::Main(Usage,
    [&]
    {
      const Benchmarks::Arguments arguments(argc, argv, {});
      if (arguments.Size() != 3)
      {
        throw std::invalid_argument("three arguments are needed");
      }
      const std::string& source = arguments.At(0);
      const int number = std::stoi(arguments.At(1));
      const bool model = source.size() > 4 && source.substr(source.size() - 4) == ".ply";
      const SphericalStyle::TriangleMesh mesh = model
        ? ReadModel(source, number)
        : Benchmarks::MakeMesh(Benchmarks::FamilyNamed(source), number);
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
