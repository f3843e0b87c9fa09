// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of known quality, which points a boundary has, and numberings the other way round.
#include "Check.h"
#include "Volumes.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

using namespace Volumes;

namespace
{
VolumeMesh MakeBestCell(CellShape shape)
{
  VolumeMesh mesh;
  mesh.Offsets.push_back(0);
  std::vector<int> ids(NumberOfPoints(shape));
  std::iota(ids.begin(), ids.end(), 0);
  AddCell(mesh, shape, ids);
  const double h = std::sqrt(0.75);
  Points P(NumberOfPoints(shape), 3);
  switch (shape)
  {
    case CellShape::Tetrahedron:
      P << 0, 0, 0, 1, 0, 0, 0.5, h, 0, 0.5, h / 3, std::sqrt(2.0 / 3.0);
      break;
    case CellShape::Pyramid:
      P << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, std::sqrt(0.5);
      break;
    case CellShape::Wedge:
      P << 0, 0, 0, 1, 0, 0, 0.5, h, 0, 0, 0, 1, 1, 0, 1, 0.5, h, 1;
      break;
    case CellShape::Hexahedron:
      P << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1;
      break;
  }
  mesh.P = P;
  return mesh;
}

void TestBestCells()
{
  Meshes::Random random(7);
  for (const CellShape shape : AllShapes)
  {
    const VolumeMesh mesh = MakeBestCell(shape);
    const int name = static_cast<int>(shape);
    CHECK_NEAR(ScaledJacobian(mesh, 0, mesh.P), 1.0, 1e-14, "best cell of shape " << name);
    const Eigen::Matrix3d R =
      Eigen::AngleAxisd(1.0, random.InCube().normalized()).toRotationMatrix();
    const Points turned = 3.0 * mesh.P * R.transpose();
    CHECK_NEAR(ScaledJacobian(mesh, 0, turned), 1.0, 1e-13, "turned and scaled, shape " << name);
    Points mirrored = mesh.P;
    mirrored.col(0) *= -1.0;
    CHECK(ScaledJacobian(mesh, 0, mirrored) < -0.9, "shape " << name << " should be inverted");
    Points flat = mesh.P;
    flat.col(2).setZero();
    CHECK(ScaledJacobian(mesh, 0, flat) == 0.0, "flat shape " << name);
  }
}

// A cube sheared by an angle: all corners have the determinant 1 and one edge of 1 / cos.
void TestShearedCube()
{
  const VolumeMesh mesh = MakeBestCell(CellShape::Hexahedron);
  for (const double angle : { 0.1, 0.7, 1.4 })
  {
    Points sheared = mesh.P;
    sheared.col(0) += std::tan(angle) * mesh.P.col(2);
    CHECK_NEAR(ScaledJacobian(mesh, 0, sheared), std::cos(angle), 1e-14, "sheared by " << angle);
  }
}

// det of the columns over the product of their lengths
double Normalized(const Eigen::Matrix3d& edges)
{
  return edges.determinant() / edges.colwise().norm().prod();
}

// A hexahedron is as good as the worst of its corners and of its middle, where the map from the
// unit cube has the slope that is its mean over the edges.
void TestAnyHexahedra()
{
  const VolumeMesh cube = MakeBestCell(CellShape::Hexahedron);
  Meshes::Random random(11);
  int middles = 0;
  for (int trial = 0; trial < 500; ++trial)
  {
    // Twisted by up to half a turn, which only the middle notices.
    const Eigen::Rotation2Dd twist(Pi * random.Unit());
    Points P = cube.P.rowwise() - Eigen::RowVector3d(0.5, 0.5, 0.0);
    for (int i = 0; i < 8; ++i)
    {
      if (cube.P(i, 2) == 1.0)
      {
        P.row(i).head<2>() = (twist * P.row(i).head<2>().transpose()).transpose().eval();
      }
      P.row(i) += 0.2 * random.InCube().transpose();
    }
    double corners = 2.0;
    Eigen::Matrix3d middle = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 8; ++i)
    {
      Eigen::Matrix3d edges;
      for (int axis = 0; axis < 3; ++axis)
      {
        Eigen::RowVector3d other = cube.P.row(i);
        other(axis) = 1.0 - other(axis);
        Eigen::Index j = 0;
        (cube.P.rowwise() - other).rowwise().squaredNorm().minCoeff(&j);
        edges.col(axis) = (P.row(j) - P.row(i)) * (cube.P(i, axis) == 0.0 ? 1.0 : -1.0);
      }
      corners = std::min(corners, Normalized(edges));
      middle += edges / 8.0;
    }
    middles += Normalized(middle) < corners ? 1 : 0;
    CHECK_NEAR(ScaledJacobian(cube, 0, P), std::min(corners, Normalized(middle)), 1e-13,
      "hexahedron " << trial);
  }
  CHECK(middles > 0, "a middle should be worse than the corners, of " << middles);
}

void TestBoundary()
{
  const int n = 4;
  for (const CellShape shape : AllShapes)
  {
    const VolumeMesh mesh = MakeCube(n, shape);
    CHECK(ScaledJacobians(mesh, mesh.P, 1).minCoeff() > 0.3,
      "no cell of a cube is inverted, shape " << static_cast<int>(shape));
    const std::vector<char> boundary = BoundaryPoints(mesh);
    for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
    {
      const Eigen::RowVector3d x = mesh.P.row(i);
      const bool outside = x.minCoeff() == 0.0 || x.maxCoeff() == 1.0;
      CHECK((boundary[i] != 0) == outside, "point " << i << " at " << x);
    }
  }
}

// A wedge written as a hexahedron with an edge of no length is a wedge to its neighbor.
void TestCollapsedHexahedron()
{
  VolumeMesh mesh = MakeBestCell(CellShape::Wedge);
  AddCell(mesh, CellShape::Hexahedron, { 3, 4, 5, 5, 6, 7, 8, 8 });
  Points P(9, 3);
  P.topRows(6) = mesh.P;
  P.bottomRows(3) = mesh.P.bottomRows(3);
  P.bottomRows(3).col(2).setConstant(2.0);
  mesh.P = P;
  // Of nine points all lie outside; with a third one on top the triangle between is inside, so that
  // only a point in its middle would be.
  const std::vector<char> boundary = BoundaryPoints(mesh);
  CHECK(std::count(boundary.begin(), boundary.end(), 1) == 9, "all points are outside");
  CHECK(ScaledJacobian(mesh, 1, mesh.P) == 0.0, "an edge without a length counts as flat");
}

void TestOrientation()
{
  for (const CellShape shape : AllShapes)
  {
    VolumeMesh mesh = MakeCube(2, shape);
    CHECK(!OrientCells(mesh), "a good mesh stays");
    mesh.P.col(1) *= -1.0;
    CHECK(OrientCells(mesh), "a mirrored mesh is turned");
    CHECK(ScaledJacobians(mesh, mesh.P, 1).minCoeff() > 0.3, "no cell is inverted then");

    // Some cells numbered the other way round, as VTK's own data has them.
    const VolumeMesh good = MakeCube(3, shape);
    mesh = good;
    for (int cell = 0; cell < mesh.GetNumberOfCells(); cell += 1 + cell % 3)
    {
      int* ids = &mesh.Ids[mesh.Offsets[cell]];
      if (shape == CellShape::Tetrahedron)
      {
        std::swap(ids[0], ids[1]);
      }
      else if (shape == CellShape::Pyramid)
      {
        std::swap(ids[0], ids[2]);
      }
      else
      {
        const int half = NumberOfPoints(shape) / 2;
        std::swap_ranges(ids, ids + half, ids + half);
      }
    }
    CHECK(ScaledJacobians(mesh, mesh.P, 1).minCoeff() < -0.3, "they are negative");
    CHECK(OrientCells(mesh), "they are turned");
    CHECK(ScaledJacobians(mesh, mesh.P, 1).minCoeff() > 0.3, "no cell is inverted then");

    // A point that is pulled through the others turns cells inside out, which agree with their
    // neighbors: that is no question of numbers.
    mesh = good;
    Points& P = mesh.P;
    for (int i = 0; i < P.rows(); ++i)
    {
      if ((P.row(i).array() > 0.1 && P.row(i).array() < 0.5).all())
      {
        P.row(i).setConstant(0.95);
      }
    }
    const double before = ScaledJacobians(mesh, P, 1).minCoeff();
    CHECK(before < 0.0 && !OrientCells(mesh), "inverted cells stay");
    CHECK(ScaledJacobians(mesh, P, 1).minCoeff() == before, "inverted cells stay inverted");
  }
}
}

int main()
{
  TestBestCells();
  TestShearedCube();
  TestAnyHexahedra();
  TestBoundary();
  TestCollapsedHexahedron();
  TestOrientation();
  return CheckResult();
}
