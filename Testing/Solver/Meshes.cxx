// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace Meshes
{
TriangleMesh Make(
  const std::vector<Vector>& points, const std::vector<std::array<int, 3>>& triangles)
{
  TriangleMesh mesh;
  mesh.P.resize(points.size(), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    mesh.P.row(i) = points[i].transpose();
  }
  mesh.F.resize(triangles.size(), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f)
  {
    mesh.F.row(f) << triangles[f][0], triangles[f][1], triangles[f][2];
  }
  return mesh;
}

double Diagonal(const Points& P)
{
  return (P.colwise().maxCoeff() - P.colwise().minCoeff()).norm();
}

double Distance(const Points& A, const Points& B)
{
  const Points difference = A - B;
  return difference.allFinite() ? difference.rowwise().norm().maxCoeff()
                                : std::numeric_limits<double>::infinity();
}

bool SameBits(const Points& A, const Points& B)
{
  return A.rows() == B.rows() && std::memcmp(A.data(), B.data(), A.size() * sizeof(double)) == 0;
}

TriangleMesh Tetrahedron()
{
  return Make({ { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } },
    { { 0, 1, 2 }, { 0, 3, 1 }, { 0, 2, 3 }, { 1, 3, 2 } });
}

TriangleMesh Subdivide(const TriangleMesh& coarse)
{
  std::vector<Vector> points;
  for (int i = 0; i < coarse.P.rows(); ++i)
  {
    points.push_back(coarse.P.row(i).transpose());
  }
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int u, int v)
  {
    const auto found =
      middles.insert({ { std::min(u, v), std::max(u, v) }, static_cast<int>(points.size()) });
    if (found.second)
    {
      const Vector m = 0.5 * (points[u] + points[v]);
      points.push_back(m);
    }
    return found.first->second;
  };
  std::vector<std::array<int, 3>> triangles;
  for (int f = 0; f < coarse.F.rows(); ++f)
  {
    const int a = coarse.F(f, 0), b = coarse.F(f, 1), c = coarse.F(f, 2);
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    triangles.push_back({ a, ab, ca });
    triangles.push_back({ ab, b, bc });
    triangles.push_back({ ca, bc, c });
    triangles.push_back({ ab, bc, ca });
  }
  return Make(points, triangles);
}

TriangleMesh Icosphere(int level)
{
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh =
    Make({ { -1, g, 0 }, { 1, g, 0 }, { -1, -g, 0 }, { 1, -g, 0 }, { 0, -1, g }, { 0, 1, g },
           { 0, -1, -g }, { 0, 1, -g }, { g, 0, -1 }, { g, 0, 1 }, { -g, 0, -1 }, { -g, 0, 1 } },
      { { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 }, { 0, 10, 11 }, { 1, 5, 9 },
        { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 }, { 3, 4, 2 },
        { 3, 2, 6 }, { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 }, { 8, 6, 7 },
        { 9, 8, 1 } });
  mesh.P.rowwise().normalize();
  for (int k = 0; k < level; ++k)
  {
    mesh = Subdivide(mesh);
    mesh.P.rowwise().normalize();
  }
  return mesh;
}

TriangleMesh Scaled(TriangleMesh mesh, const Vector& factors)
{
  mesh.P = (mesh.P * factors.asDiagonal()).eval();
  return mesh;
}

TriangleMesh Together(const std::vector<TriangleMesh>& meshes)
{
  Eigen::Index n = 0, m = 0;
  for (const TriangleMesh& mesh : meshes)
  {
    n += mesh.P.rows();
    m += mesh.F.rows();
  }
  TriangleMesh all = { Points(n, 3), Triangles(m, 3) };
  n = m = 0;
  for (const TriangleMesh& mesh : meshes)
  {
    all.P.middleRows(n, mesh.P.rows()) = mesh.P;
    all.F.middleRows(m, mesh.F.rows()) = mesh.F.array() + static_cast<int>(n);
    n += mesh.P.rows();
    m += mesh.F.rows();
  }
  return all;
}

TriangleMesh Moved(TriangleMesh mesh, const Vector& move)
{
  mesh.P.rowwise() += move.transpose();
  return mesh;
}

TriangleMesh Turned(TriangleMesh mesh, const Eigen::Matrix3d& rotation)
{
  mesh.P = (mesh.P * rotation.transpose()).eval();
  return mesh;
}

TriangleMesh Renumbered(const TriangleMesh& mesh, const std::vector<int>& place)
{
  TriangleMesh result = mesh;
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    result.P.row(place[i]) = mesh.P.row(i);
  }
  result.F = mesh.F.unaryExpr([&](int i) { return place[i]; });
  return result;
}

TriangleMesh Perturbed(TriangleMesh mesh, double amount, std::uint32_t seed)
{
  Random random(seed);
  for (int i = 0; i < mesh.P.rows(); ++i)
  {
    mesh.P.row(i) += amount * random.InCube().transpose();
  }
  return mesh;
}

TriangleMesh Ellipsoid(int level)
{
  return Scaled(Icosphere(level), { 1.0, 0.7, 0.5 });
}

std::vector<std::array<int, 3>> CappedTube(int around, int rings)
{
  std::vector<std::array<int, 3>> triangles;
  const int before = around * rings;
  for (int i = 0; i < around; ++i)
  {
    const int k = (i + 1) % around;
    triangles.push_back({ before, i, k });
    triangles.push_back({ before + 1, (rings - 1) * around + k, (rings - 1) * around + i });
    for (int j = 0; j + 1 < rings; ++j)
    {
      const int a = j * around + i;
      const int b = j * around + k;
      triangles.push_back({ a, a + around, b + around });
      triangles.push_back({ a, b + around, b });
    }
  }
  return triangles;
}

TriangleMesh EllipsoidUV(int around, int rings)
{
  std::vector<Vector> points;
  for (int j = 0; j < rings; ++j)
  {
    const double theta = Pi * (j + 1) / (rings + 1);
    for (int i = 0; i < around; ++i)
    {
      const double phi = 2.0 * Pi * i / around;
      points.push_back({ std::sin(theta) * std::cos(phi), 0.7 * std::sin(theta) * std::sin(phi),
        0.5 * std::cos(theta) });
    }
  }
  points.push_back({ 0, 0, 0.5 });
  points.push_back({ 0, 0, -0.5 });
  return Make(points, CappedTube(around, rings));
}

TriangleMesh Revolved(const std::vector<std::array<double, 2>>& profile, int around)
{
  std::vector<Vector> points;
  for (std::size_t j = 1; j + 1 < profile.size(); ++j)
  {
    for (int i = 0; i < around; ++i)
    {
      const double phi = 2.0 * Pi * i / around;
      points.push_back(
        { profile[j][0] * std::cos(phi), profile[j][0] * std::sin(phi), profile[j][1] });
    }
  }
  points.push_back({ 0, 0, profile.front()[1] });
  points.push_back({ 0, 0, profile.back()[1] });
  return Make(points, CappedTube(around, static_cast<int>(profile.size()) - 2));
}

TriangleMesh Cup(double wall, double rim, int rings, int around)
{
  std::vector<std::array<double, 2>> profile;
  for (int j = 0; j <= rings; ++j) // up the inside seen from the axis, so from the bottom
  {
    const double a = rim * j / rings;
    profile.push_back({ (1.0 - wall) * std::sin(a), -(1.0 - wall) * std::cos(a) });
  }
  for (int j = rings; j >= 0; --j)
  {
    const double a = rim * j / rings;
    profile.push_back({ std::sin(a), -std::cos(a) });
  }
  return Revolved(profile, around);
}

TriangleMesh PlateOnBall(double plate, int around)
{
  std::vector<std::array<double, 2>> profile = { { 0.0, 1.3 + plate } };
  const auto to = [&](double r, double z, int steps)
  {
    const std::array<double, 2> from = profile.back();
    for (int k = 1; k <= steps; ++k)
    {
      const double x = static_cast<double>(k) / steps;
      profile.push_back({ from[0] + x * (r - from[0]), from[1] + x * (z - from[1]) });
    }
  };
  to(0.8, 1.3 + plate, 14);
  to(0.8, 1.3, 2);
  to(0.1, 1.3, 12);
  to(0.1, std::sqrt(0.99), 4);
  const double top = std::asin(0.1);
  for (int j = 1; j <= 36; ++j)
  {
    const double a = top + (Pi - top) * j / 36;
    profile.push_back({ j < 36 ? std::sin(a) : 0.0, std::cos(a) });
  }
  return Revolved(profile, around);
}

TriangleMesh HollowBall(double wall, int level)
{
  const TriangleMesh outer = Icosphere(level);
  TriangleMesh mesh = outer;
  const int n = outer.P.rows(), m = outer.F.rows();
  mesh.P.conservativeResize(2 * n, 3);
  mesh.P.bottomRows(n) = (1.0 - wall) * outer.P;
  mesh.F.conservativeResize(2 * m, 3);
  mesh.F.bottomRows(m) = outer.F.rowwise().reverse().array() + n;
  return mesh;
}

TriangleMesh Box(int k, const Vector& half)
{
  std::vector<Vector> points;
  std::vector<std::array<int, 3>> triangles;
  std::map<std::array<int, 3>, int> numbers;
  const auto number = [&](const std::array<int, 3>& place)
  {
    const auto found = numbers.insert({ place, static_cast<int>(points.size()) });
    if (found.second)
    {
      points.push_back({ half[0] * (2.0 * place[0] / k - 1.0), half[1] * (2.0 * place[1] / k - 1.0),
        half[2] * (2.0 * place[2] / k - 1.0) });
    }
    return found.first->second;
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int side = 0; side < 2; ++side)
    {
      for (int i = 0; i < k; ++i)
      {
        for (int j = 0; j < k; ++j)
        {
          const auto corner = [&](int di, int dj)
          {
            std::array<int, 3> place{};
            place[axis] = side * k;
            place[(axis + 1) % 3] = i + di;
            place[(axis + 2) % 3] = j + dj;
            return number(place);
          };
          const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (side == 1)
          {
            triangles.push_back({ a, b, c });
            triangles.push_back({ a, c, d });
          }
          else
          {
            triangles.push_back({ a, c, b });
            triangles.push_back({ a, d, c });
          }
        }
      }
    }
  }
  return Make(points, triangles);
}

TriangleMesh RoundedBox(int k, double share)
{
  TriangleMesh mesh = Box(k);
  for (int i = 0; i < mesh.P.rows(); ++i)
  {
    mesh.P.row(i) *= 1.0 - share + share / mesh.P.row(i).norm();
  }
  return mesh;
}

TriangleMesh House(int slices)
{
  const std::vector<std::array<double, 2>> outline = { { -1, 0 }, { 0, 0 }, { 1, 0 }, { 1, 0.6 },
    { 1, 1.2 }, { 0.5, 1.55 }, { 0, 1.9 }, { -0.5, 1.55 }, { -1, 1.2 }, { -1, 0.6 } };
  const int around = static_cast<int>(outline.size());
  std::vector<Vector> points;
  for (int s = 0; s < slices; ++s)
  {
    for (int i = 0; i < around; ++i)
    {
      // The ends stay plane; between them neighbors on the outline are shifted against each other.
      const double shear = s == 0 || s == slices - 1 ? 0.0 : 0.32 * ((i % 2) - 0.5);
      points.push_back({ outline[i][0], 2.4 * s / (slices - 1) + shear, outline[i][1] });
    }
  }
  points.push_back({ 0, 0, 0.9 });
  points.push_back({ 0, 2.4, 0.9 });
  return Make(points, CappedTube(around, slices));
}

TriangleMesh Patch(int k, double height)
{
  std::vector<Vector> points;
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j <= k; ++j)
  {
    for (int i = 0; i <= k; ++i)
    {
      const double x = 2.0 * i / k - 1.0, y = 1.6 * j / k - 0.8;
      points.push_back(
        { x, y, height * (std::sin(2.0 * x + 0.4) * std::cos(1.7 * y) + 0.5 * y * y) });
    }
  }
  for (int j = 0; j < k; ++j)
  {
    for (int i = 0; i < k; ++i)
    {
      const int a = j * (k + 1) + i, b = a + 1, c = b + k + 1, d = a + k + 1;
      triangles.push_back({ a, b, c });
      triangles.push_back({ a, c, d });
    }
  }
  return Make(points, triangles);
}

TriangleMesh Mixed(const TriangleMesh& first, const TriangleMesh& second, std::uint32_t seed)
{
  Random random(seed);
  const int n1 = first.P.rows(), n = n1 + second.P.rows();
  const int m1 = first.F.rows(), m = m1 + second.F.rows();
  const std::vector<int> place = random.Permutation(n), order = random.Permutation(m);
  TriangleMesh mesh;
  mesh.P.resize(n, 3);
  for (int i = 0; i < n; ++i)
  {
    mesh.P.row(place[i]) = i < n1 ? first.P.row(i) : second.P.row(i - n1);
  }
  mesh.F.resize(m, 3);
  for (int f = 0; f < m; ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      mesh.F(order[f], k) = place[f < m1 ? first.F(f, k) : second.F(f - m1, k) + n1];
    }
  }
  return mesh;
}

double Capsule(const Vector& x, const Vector& a, const Vector& b, double radius)
{
  const Vector along = b - a;
  const double t = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (x - a - t * along).norm() - radius;
}

TriangleMesh Isosurface(
  const std::function<double(const Vector&)>& f, const Vector& low, const Vector& high, double edge)
{
  std::array<int, 3> counts;
  for (int axis = 0; axis < 3; ++axis)
  {
    counts[axis] = static_cast<int>(std::ceil((high(axis) - low(axis)) / edge)) + 1;
  }
  const auto place = [&](int node)
  {
    const int row = node / counts[0];
    const int layer = row / counts[1];
    return Vector(low + edge * Vector(node % counts[0], row % counts[1], layer));
  };
  std::vector<double> values(static_cast<std::size_t>(counts[0]) * counts[1] * counts[2]);
  for (std::size_t node = 0; node < values.size(); ++node)
  {
    values[node] = f(place(static_cast<int>(node)));
  }
  std::vector<Vector> points;
  std::vector<std::array<int, 3>> triangles;
  std::map<std::pair<int, int>, int> numbers;
  const auto crossing = [&](int inside, int outside)
  {
    const auto found = numbers.insert({ { inside, outside }, static_cast<int>(points.size()) });
    if (found.second)
    {
      const double t = values[inside] / (values[inside] - values[outside]);
      points.push_back((1.0 - t) * place(inside) + t * place(outside));
    }
    return found.first->second;
  };
  const auto add = [&](int a, int b, int c, const Vector& outward)
  {
    const Vector n = (points[b] - points[a]).cross(points[c] - points[a]);
    triangles.push_back(
      n.dot(outward) > 0.0 ? std::array<int, 3>{ a, b, c } : std::array<int, 3>{ a, c, b });
  };
  const int steps[3] = { 1, counts[0], counts[0] * counts[1] };
  std::array<int, 3> order = { 0, 1, 2 };
  for (int z = 0; z + 1 < counts[2]; ++z)
  {
    for (int y = 0; y + 1 < counts[1]; ++y)
    {
      for (int x = 0; x + 1 < counts[0]; ++x)
      {
        std::sort(order.begin(), order.end());
        do
        {
          std::vector<int> inside, outside;
          int node = x * steps[0] + y * steps[1] + z * steps[2];
          (values[node] < 0.0 ? inside : outside).push_back(node);
          for (const int axis : order)
          {
            node += steps[axis];
            (values[node] < 0.0 ? inside : outside).push_back(node);
          }
          if (inside.empty() || outside.empty())
          {
            continue;
          }
          Vector outward = Vector::Zero();
          for (const int i : inside)
          {
            outward -= place(i) / static_cast<double>(inside.size());
          }
          for (const int i : outside)
          {
            outward += place(i) / static_cast<double>(outside.size());
          }
          if (inside.size() == 2)
          {
            const int a = crossing(inside[0], outside[0]), b = crossing(inside[0], outside[1]);
            const int c = crossing(inside[1], outside[1]), d = crossing(inside[1], outside[0]);
            add(a, b, c, outward);
            add(a, c, d, outward);
          }
          else if (inside.size() == 1)
          {
            add(crossing(inside[0], outside[0]), crossing(inside[0], outside[1]),
              crossing(inside[0], outside[2]), outward);
          }
          else
          {
            add(crossing(inside[0], outside[0]), crossing(inside[1], outside[0]),
              crossing(inside[2], outside[0]), outward);
          }
        } while (std::next_permutation(order.begin(), order.end()));
      }
    }
  }
  return Make(points, triangles);
}

TriangleMesh Doll()
{
  const auto distance = [](const Vector& x)
  {
    return std::min({ x.norm() - 1.0, (x - Vector(0, 1.6, 0)).norm() - 0.8,
      Capsule(x, { 0, 0, 0 }, { 2.4, 0.2, 0 }, 0.28),
      Capsule(x, { 0, 0, 0 }, { -2.4, 0.2, 0 }, 0.28),
      Capsule(x, { 0, 0, 0 }, { 0.8, -2.4, 0 }, 0.3),
      Capsule(x, { 0, 0, 0 }, { -0.8, -2.4, 0 }, 0.3) });
  };
  return Isosurface(distance, { -2.9, -2.9, -1.2 }, { 2.9, 2.6, 1.2 }, 0.09);
}

TriangleMesh TwoComponents()
{
  TriangleMesh box = Perturbed(Box(2, { 0.5, 0.6, 0.4 }), 0.06, 5);
  box.P.rowwise() += Eigen::RowVector3d(1.9, 0.3, -0.2);
  return Mixed(Perturbed(Ellipsoid(1), 0.04, 4), box, 6);
}

TriangleMesh NonManifoldFan(int width, int length)
{
  std::vector<Vector> points;
  std::vector<std::array<int, 3>> triangles;
  const auto place = [&](int sheet, int i, int j)
  { return i == 0 ? j : (length + 1) * (1 + sheet * width + i - 1) + j; };
  points.resize((length + 1) * (1 + 3 * width));
  for (int sheet = 0; sheet < 3; ++sheet)
  {
    const double angle = 2.0 * Pi * sheet / 3.0 + 0.3;
    for (int i = 0; i <= width; ++i)
    {
      for (int j = 0; j <= length; ++j)
      {
        const double x = 1.0 * i / width, z = 1.5 * j / length - 0.7;
        const double bend = angle + 0.35 * x * x + 0.2 * x * std::sin(2.0 * z + sheet);
        points[place(sheet, i, j)] = { x * std::cos(bend), x * std::sin(bend), z };
        if (i < width && j < length)
        {
          const int a = place(sheet, i, j), b = place(sheet, i + 1, j);
          const int c = place(sheet, i + 1, j + 1), d = place(sheet, i, j + 1);
          triangles.push_back({ a, b, c });
          triangles.push_back({ a, c, d });
        }
      }
    }
  }
  return Make(points, triangles);
}

TriangleMesh ThreeAtAnEdge()
{
  return Make({ { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0.4 }, { -0.6, 0.8, 0.5 }, { -0.5, -0.9, 0.6 } },
    { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } });
}

TriangleMesh Slivers()
{
  const int around = 16, rings = 10;
  TriangleMesh mesh = EllipsoidUV(around, rings);
  for (int j = 0; j < rings; j += 2)
  {
    for (int i = 0; i < around; ++i)
    {
      const int a = j * around + i, b = a + around;
      mesh.P.row(b) = (0.96 * mesh.P.row(a) + 0.04 * mesh.P.row(b)).eval();
    }
  }
  return mesh;
}

int CountObtuse(const TriangleMesh& mesh)
{
  int obtuse = 0;
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::RowVector3d p = mesh.P.row(mesh.F(f, k));
      obtuse +=
        (mesh.P.row(mesh.F(f, (k + 1) % 3)) - p).dot(mesh.P.row(mesh.F(f, (k + 2) % 3)) - p) < 0.0;
    }
  }
  return obtuse;
}
} // namespace Meshes
