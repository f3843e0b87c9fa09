// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Generated meshes for the tests. Closed ones are oriented outward.
#ifndef SphericalStyle_Meshes_h
#define SphericalStyle_Meshes_h

#include "TriangleMesh.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace Meshes
{
using SphericalStyle::Points;
using SphericalStyle::TriangleMesh;
using SphericalStyle::Triangles;
using Vector = Eigen::Vector3d;

constexpr double Pi = 3.14159265358979323846;

/// A mesh and what messages call it.
struct Named
{
  std::string name;
  TriangleMesh mesh;
};

/// Numbers in (0, 1) or (-1, 1). The library's distributions differ between compilers, its engines
/// do not.
class Random
{
public:
  explicit Random(std::uint32_t seed)
    : Engine(seed)
  {
  }
  double Unit() { return (this->Engine() + 0.5) / 4294967296.0; }
  double Signed() { return 2.0 * this->Unit() - 1.0; }
  Vector InCube() { return { this->Signed(), this->Signed(), this->Signed() }; }
  Eigen::Matrix3d Matrix()
  {
    Eigen::Matrix3d M;
    for (int i = 0; i < 9; ++i)
    {
      M(i) = this->Signed();
    }
    return M;
  }
  Eigen::Matrix3d Rotation()
  {
    Eigen::Quaterniond q(this->Signed(), this->Signed(), this->Signed(), this->Signed());
    return q.normalized().toRotationMatrix();
  }
  std::vector<int> Permutation(int n)
  {
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    for (int i = n - 1; i > 0; --i)
    {
      std::swap(order[i], order[static_cast<int>(this->Unit() * (i + 1))]);
    }
    return order;
  }

private:
  std::mt19937 Engine;
};

TriangleMesh Make(
  const std::vector<Vector>& points, const std::vector<std::array<int, 3>>& triangles);

double Diagonal(const Points& P);

/// Largest distance of two points of the same number; infinite when one is not finite (Eigen's
/// maximum may pass over NaN).
double Distance(const Points& A, const Points& B);

bool SameBits(const Points& A, const Points& B);

TriangleMesh Tetrahedron();

/// Every triangle into four.
TriangleMesh Subdivide(const TriangleMesh& coarse);

/// Unit sphere of 10 * 4^level + 2 points.
TriangleMesh Icosphere(int level);

TriangleMesh Scaled(TriangleMesh mesh, const Vector& factors);

/// The meshes one after the other.
TriangleMesh Together(const std::vector<TriangleMesh>& meshes);

TriangleMesh Moved(TriangleMesh mesh, const Vector& move);

TriangleMesh Turned(TriangleMesh mesh, const Eigen::Matrix3d& rotation);

/// The same mesh with point i at place[i].
TriangleMesh Renumbered(const TriangleMesh& mesh, const std::vector<int>& place);

/// Every point moved by up to amount along each axis.
TriangleMesh Perturbed(TriangleMesh mesh, double amount, std::uint32_t seed);

/// Icosphere pulled to the half axes 1, .7, .5.
TriangleMesh Ellipsoid(int level);

/// Triangles between rings of points and two poles: point i of ring j has the id j * around + i,
/// the pole before the first ring rings * around, the one behind the last ring the id after that.
std::vector<std::array<int, 3>> CappedTube(int around, int rings);

/// Rings of points between two poles: around * rings + 2 points, thin triangles at the poles.
TriangleMesh EllipsoidUV(int around = 24, int rings = 16);

/// A profile turned round the z axis; its points are (distance from the axis, z), the first and the
/// last on the axis, running downward where it is convex.
TriangleMesh Revolved(const std::vector<std::array<double, 2>>& profile, int around);

/// A cup: a spherical wall of outer radius 1 that ends at the angle `rim` from its bottom.
TriangleMesh Cup(double wall, double rim = 0.6 * Pi, int rings = 20, int around = 48);

/// A ball of radius 1 that carries a round plate on a stem, square to the axis.
TriangleMesh PlateOnBall(double plate, int around = 48);

/// Two spheres around the origin, the inner one facing inward: a wall without a rim.
TriangleMesh HollowBall(double wall, int level);

/// Surface of [-1, 1]^3 times half, k squares along every edge, every square split along the same
/// diagonal: 6 k^2 + 2 points.
TriangleMesh Box(int k, const Vector& half = { 1, 1, 1 });

/// A box of half edge 1 with every point `share` of the way to the unit sphere.
TriangleMesh RoundedBox(int k, double share);

/// A house: a pentagon swept along y, its slices sheared so far that most wall triangles are
/// obtuse; the gables are fans. (10 * slices + 2) points.
TriangleMesh House(int slices = 5);

/// A wavy sheet of k x k squares with a border, one-direction diagonals; flat for height 0.
TriangleMesh Patch(int k, double height);

/// Two meshes as one of two components, points and triangles in mixed order.
TriangleMesh Mixed(const TriangleMesh& first, const TriangleMesh& second, std::uint32_t seed);

/// Distance of x from it, below 0 inside.
double Capsule(const Vector& x, const Vector& a, const Vector& b, double radius);

/// The surface f = 0, f > 0 outside, by six tetrahedra in each cube of a lattice: watertight.
TriangleMesh Isosurface(const std::function<double(const Vector&)>& f, const Vector& low,
  const Vector& high, double edge);

/// A ball with four limbs and a head, each along an axis of its own.
TriangleMesh Doll();

/// An ellipsoid of 42 points beside a box of 26.
TriangleMesh TwoComponents();

/// Three sheets of width x length squares that meet in one line of edges; 1, 1: three triangle
/// pairs at one edge.
TriangleMesh NonManifoldFan(int width = 4, int length = 4);

/// Three triangles at one edge, no more.
TriangleMesh ThreeAtAnEdge();

/// An ellipsoid whose rings of points lie in close pairs: most triangles are slivers, with angles
/// down to about a degree.
TriangleMesh Slivers();

int CountObtuse(const TriangleMesh& mesh);
} // namespace Meshes

#endif
