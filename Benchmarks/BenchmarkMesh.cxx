// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkMesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <random>
#include <utility>

namespace Benchmarks
{
namespace
{
using Eigen::Vector3d;
using SphericalStyle::Points;
using SphericalStyle::TriangleMesh;

// Corners and faces of an icosahedron, outward.
const std::array<Vector3d, 12>& IcosahedronCorners()
{
  static const std::array<Vector3d, 12> corners = []
  {
    const double g = (1.0 + std::sqrt(5.0)) / 2.0;
    std::array<Vector3d, 12> c = { Vector3d(-1, g, 0), Vector3d(1, g, 0), Vector3d(-1, -g, 0),
      Vector3d(1, -g, 0), Vector3d(0, -1, g), Vector3d(0, 1, g), Vector3d(0, -1, -g),
      Vector3d(0, 1, -g), Vector3d(g, 0, -1), Vector3d(g, 0, 1), Vector3d(-g, 0, -1),
      Vector3d(-g, 0, 1) };
    for (Vector3d& corner : c)
    {
      corner.normalize();
    }
    return c;
  }();
  return corners;
}
constexpr int IcosahedronFaces[20][3] = { { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 },
  { 0, 10, 11 }, { 1, 5, 9 }, { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 },
  { 3, 4, 2 }, { 3, 2, 6 }, { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 },
  { 8, 6, 7 }, { 9, 8, 1 } };

/// The icosahedron with every edge cut into f pieces, its points on the unit sphere.
class CutIcosahedron
{
public:
  explicit CutIcosahedron(int f)
    : Pieces(f)
  {
    const auto& corners = IcosahedronCorners();
    this->Directions.assign(corners.begin(), corners.end());
    for (const auto& face : IcosahedronFaces)
    {
      this->CutFace(face);
    }
  }

  std::vector<Vector3d> Directions;
  std::vector<std::array<int, 3>> Faces;

private:
  /// The point i pieces from corner a toward b, shared by both faces at the edge.
  int OnEdge(int a, int b, int i)
  {
    if (i == 0 || i == this->Pieces)
    {
      return i == 0 ? a : b;
    }
    if (a > b)
    {
      std::swap(a, b);
      i = this->Pieces - i;
    }
    const auto added = this->FirstOnEdge.try_emplace({ a, b }, this->Directions.size());
    if (added.second)
    {
      const auto& corners = IcosahedronCorners();
      for (int k = 1; k < this->Pieces; ++k)
      {
        this->Directions.push_back(((this->Pieces - k) * corners[a] + k * corners[b]).normalized());
      }
    }
    return static_cast<int>(added.first->second) + i - 1;
  }

  void CutFace(const int (&face)[3])
  {
    const auto& corners = IcosahedronCorners();
    const int f = this->Pieces;
    const auto [a, b, c] = face;
    // Row r lies r pieces from a; its points go from edge ab to edge ac.
    std::vector<int> above = { a };
    for (int r = 1; r <= f; ++r)
    {
      std::vector<int> row(r + 1);
      row.front() = this->OnEdge(a, b, r);
      row.back() = this->OnEdge(a, c, r);
      for (int k = 1; k < r; ++k)
      {
        if (r == f)
        {
          row[k] = this->OnEdge(b, c, k);
          continue;
        }
        row[k] = static_cast<int>(this->Directions.size());
        this->Directions.push_back(
          ((f - r) * corners[a] + (r - k) * corners[b] + k * corners[c]).normalized());
      }
      for (int k = 0; k < r; ++k)
      {
        this->Faces.push_back({ above[k], row[k], row[k + 1] });
        if (k > 0)
        {
          this->Faces.push_back({ above[k - 1], row[k], above[k] });
        }
      }
      above = std::move(row);
    }
  }

  int Pieces;
  std::map<std::pair<int, int>, std::size_t> FirstOnEdge;
};

/// Moves a direction within an eighth of an edge, so that no two triangles are alike.
Vector3d Jitter(const Vector3d& d, double edge, std::mt19937& engine)
{
  const auto number = [&engine] { return engine() / 2147483648.0 - 1.0; };
  const double x = number();
  const double y = number();
  const double z = number();
  return (d + 0.13 * edge * Vector3d(x, y, z)).normalized();
}

/// Slides a direction along the sphere: parallels gather in bands and meridians wind.
Vector3d Slide(const Vector3d& d)
{
  constexpr int Bands = 6;
  constexpr double Gathering = 0.99; // below 1, or bands fold
  constexpr double Winding = 0.3;
  const double polar = std::acos(std::clamp(d.z(), -1.0, 1.0));
  const double slid = polar + Gathering * std::sin(2 * Bands * polar) / (2 * Bands);
  const double azimuth = std::atan2(d.y(), d.x()) + Winding * std::sin(2.0 * polar);
  return { std::sin(slid) * std::cos(azimuth), std::sin(slid) * std::sin(azimuth), std::cos(slid) };
}

/// The point of the surface in a direction: a bumpy ellipsoid with a head and four limbs.
Vector3d OnSurface(const Vector3d& d)
{
  static const Vector3d limbs[] = { { 0.0, 0.3, 1.0 }, { 0.9, 0.6, 0.3 }, { -0.9, 0.6, 0.3 },
    { 0.5, 0.3, -0.9 }, { -0.5, 0.3, -0.9 } };
  constexpr double Length = 0.7;
  constexpr double Width = 0.45; // radians
  double radius = 1.0 + 0.1 * std::sin(3.0 * d.x() + 1.0) * std::sin(3.0 * d.y() + 2.0) +
    0.02 * std::sin(11.0 * d.x()) * std::sin(13.0 * d.y() + 1.0);
  for (const Vector3d& limb : limbs)
  {
    radius += Length * std::exp((d.dot(limb.normalized()) - 1.0) / (Width * Width / 2.0));
  }
  return radius * Vector3d(1.1 * d.x(), d.y(), 0.9 * d.z());
}

constexpr char Magic[] = "SSMESH1\n";
constexpr std::size_t MagicSize = sizeof(Magic) - 1;

template <typename T>
void Write(std::ostream& os, const T* values, std::size_t count)
{
  os.write(reinterpret_cast<const char*>(values), count * sizeof(T));
}

template <typename T>
void Read(std::istream& is, T* values, std::size_t count)
{
  is.read(reinterpret_cast<char*>(values), count * sizeof(T));
}
}

Family FamilyNamed(const std::string& name)
{
  if (name != "even" && name != "slivers")
  {
    throw std::invalid_argument("no family of meshes is called \"" + name + "\"");
  }
  return name == "even" ? Family::Even : Family::Slivers;
}

TriangleMesh MakeMesh(Family family, int numberOfPoints)
{
  const int pieces =
    std::max(1, static_cast<int>(std::lround(std::sqrt((numberOfPoints - 2) / 10.0))));
  const CutIcosahedron sphere(pieces);
  const double edge = 1.1 / pieces;
  std::mt19937 engine(1);
  TriangleMesh mesh;
  mesh.P.resize(sphere.Directions.size(), 3);
  for (std::size_t i = 0; i < sphere.Directions.size(); ++i)
  {
    Vector3d d = Jitter(sphere.Directions[i], edge, engine);
    d = family == Family::Slivers ? Slide(d) : d;
    mesh.P.row(i) = OnSurface(d).transpose();
  }
  mesh.P = mesh.P.cast<float>().cast<double>().eval();
  mesh.F.resize(sphere.Faces.size(), 3);
  for (std::size_t t = 0; t < sphere.Faces.size(); ++t)
  {
    mesh.F.row(t) << sphere.Faces[t][0], sphere.Faces[t][1], sphere.Faces[t][2];
  }
  return mesh;
}

void WriteMesh(const TriangleMesh& mesh, const std::string& path)
{
  std::ofstream os(path, std::ios::binary);
  const std::int64_t sizes[2] = { mesh.P.rows(), mesh.F.rows() };
  Write(os, Magic, MagicSize);
  Write(os, sizes, 2);
  Write(os, mesh.P.data(), mesh.P.size());
  Write(os, mesh.F.data(), mesh.F.size());
  if (!os.flush())
  {
    throw std::runtime_error("cannot write " + path);
  }
}

TriangleMesh ReadMesh(const std::string& path)
{
  std::ifstream is(path, std::ios::binary);
  char magic[MagicSize] = {};
  std::int64_t sizes[2] = { 0, 0 };
  Read(is, magic, MagicSize);
  Read(is, sizes, 2);
  if (!is || std::memcmp(magic, Magic, MagicSize) != 0)
  {
    throw std::runtime_error(path + " is not a mesh that MakeMesh wrote");
  }
  TriangleMesh mesh;
  mesh.P.resize(sizes[0], 3);
  mesh.F.resize(sizes[1], 3);
  Read(is, mesh.P.data(), mesh.P.size());
  Read(is, mesh.F.data(), mesh.F.size());
  if (!is)
  {
    throw std::runtime_error(path + " ends too early");
  }
  return mesh;
}
} // namespace Benchmarks
