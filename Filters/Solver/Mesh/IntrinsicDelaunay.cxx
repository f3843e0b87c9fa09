// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "IntrinsicDelaunay.h"

#include "MeshEdges.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <utility>

namespace SphericalStyle
{
namespace
{
constexpr int MostFlipsPerEdge = 100;
/// Flat squares have 0 on their diagonal, up to rounding: they are left as they are.
constexpr double WeightRounding = 1e-13;
constexpr double Negative = -1e-12;

/// Triangles glued along edges. Half-edge h = 3 f + k lies opposite corner k of triangle f.
class Gluing
{
public:
  Gluing(const Points& P, const Triangles& F, const HalfEdgeScalars& cotangents);

  void FlipToDelaunay();
  IntrinsicTriangulation Take();

private:
  /// A number for each of the points opposite an edge.
  struct Apexes
  {
    double a;
    double b;
  };
  /// A flip as it would be: squared length of the new edge; of the new triangles (u, b, a) and
  /// (v, a, b) twice the areas and the half cotangents.
  struct Flipped
  {
    double squaredLength;
    std::array<double, 2> doubleAreas;
    std::array<Eigen::RowVector3d, 2> cotangents;
  };

  static int Next(int h) { return h - h % 3 + (h + 1) % 3; }
  static int Previous(int h) { return h - h % 3 + (h + 2) % 3; }

  bool IsFlippable(int edge) const;
  double Weight(int edge) const;
  Flipped TryFlip(int edge) const;
  void Reverse(int h);
  void Flip(int edge, const Flipped& flipped);
  void Place(int h, int point, int edge, int twin);
  void Enqueue(int edge);

  Triangles F;
  HalfEdgeScalars Cotangents;
  std::vector<double> DoubleAreas; // per triangle
  std::vector<int> Edges;          // of each half-edge
  std::vector<int> Twins;          // of each half-edge; -1 where not two triangles meet
  std::vector<int> HalfEdges;      // of each edge: one of its own
  // Whether both half-edges of the edge run the same way: their triangles are oriented against
  // each other. With edges that return to their point the corners cannot tell.
  std::vector<char> Opposed;
  std::vector<char> Waits;
  std::vector<double> SquaredLengths; // per edge
  std::deque<int> Queue;              // of edges
  int NumberOfFlips = 0;
};

Gluing::Gluing(const Points& P, const Triangles& F, const HalfEdgeScalars& cotangents)
  : F(F)
  , Cotangents(cotangents)
  , DoubleAreas(F.rows())
  , Edges(F.size())
  , Twins(F.size(), -1)
{
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Eigen::Vector3d x = P.row(F(f, 1)) - P.row(F(f, 0));
    const Eigen::Vector3d y = P.row(F(f, 2)) - P.row(F(f, 0));
    this->DoubleAreas[f] = x.cross(y).norm();
  }
  const MeshEdges edges(F);
  const std::vector<int>& offset = edges.GetOffset();
  const int numberOfEdges = edges.GetNumberOfEdges();
  this->HalfEdges.resize(numberOfEdges);
  this->SquaredLengths.resize(numberOfEdges);
  this->Opposed.assign(numberOfEdges, 0);
  this->Waits.assign(numberOfEdges, 0);
  for (int e = 0; e < numberOfEdges; ++e)
  {
    const int* h = edges.GetHalfEdges().data() + offset[e];
    const auto start = [&](int i) { return StartPoint(F, h[i]); };
    const int end = EndPoint(F, h[0]);
    this->HalfEdges[e] = h[0];
    this->SquaredLengths[e] = (P.row(start(0)) - P.row(end)).squaredNorm();
    for (int i = 0; i < edges.GetValence(e); ++i)
    {
      this->Edges[h[i]] = e;
    }
    if (edges.GetValence(e) == 2)
    {
      this->Twins[h[0]] = h[1];
      this->Twins[h[1]] = h[0];
      this->Opposed[e] = start(0) == start(1) ? 1 : 0;
    }
  }
}

/// Of an edge that has the same triangle on both sides, the opposite angles are two of one
/// triangle: it is Delaunay.
bool Gluing::IsFlippable(int edge) const
{
  const int h = this->HalfEdges[edge];
  return this->Twins[h] >= 0 && this->Twins[h] / 3 != h / 3;
}

double Gluing::Weight(int edge) const
{
  const int h = this->HalfEdges[edge];
  return this->Cotangents.data()[h] + this->Cotangents.data()[this->Twins[h]];
}

void Gluing::Enqueue(int edge)
{
  if (!this->Waits[edge] && this->IsFlippable(edge) && this->Weight(edge) < -WeightRounding)
  {
    this->Waits[edge] = 1;
    this->Queue.push_back(edge);
  }
}

void Gluing::FlipToDelaunay()
{
  const auto numberOfEdges = static_cast<int>(this->HalfEdges.size());
  for (int e = 0; e < numberOfEdges; ++e)
  {
    this->Enqueue(e);
  }
  std::int64_t flipsLeft = std::int64_t(MostFlipsPerEdge) * numberOfEdges;
  while (!this->Queue.empty() && flipsLeft > 0)
  {
    const int edge = this->Queue.front();
    this->Queue.pop_front();
    this->Waits[edge] = 0;
    if (!this->IsFlippable(edge) || !(this->Weight(edge) < -WeightRounding))
    {
      continue; // a flip beside it has mended it
    }
    const Flipped flipped = this->TryFlip(edge);
    // By exact numbers always so. Otherwise the four points lie on a circle up to rounding.
    if (flipped.doubleAreas[0] > 0.0 && flipped.doubleAreas[1] > 0.0 &&
      flipped.cotangents[0][0] + flipped.cotangents[1][0] >= 0.0)
    {
      this->Flip(edge, flipped);
      --flipsLeft;
    }
  }
}

/// Half-edge h = u -> v of triangle (a, u, v), g = v -> u of (b, v, u), unfolded with u in the
/// origin and v on the first axis.
Gluing::Flipped Gluing::TryFlip(int edge) const
{
  const int h = this->HalfEdges[edge], g = this->Twins[h];
  const auto squared = [this](int halfEdge) { return this->SquaredLengths[this->Edges[halfEdge]]; };
  const bool opposed = this->Opposed[edge];
  const double uv = squared(h), va = squared(Next(h)), au = squared(Previous(h));
  const double ub = squared(opposed ? Previous(g) : Next(g));
  const double bv = squared(opposed ? Next(g) : Previous(g));
  const double A = this->DoubleAreas[h / 3], B = this->DoubleAreas[g / 3];
  // Times |uv|: the first coordinates of a and b from u and, backward, from v. The second are A
  // and -B.
  const Apexes u = { 0.5 * (uv + au - va), 0.5 * (uv + ub - bv) };
  const Apexes v = { 0.5 * (uv + va - au), 0.5 * (uv + bv - ub) };
  const double along = u.a - u.b, across = A + B; // of the new edge
  Flipped flipped;
  const double ab = (along * along + across * across) / uv;
  flipped.squaredLength = ab;
  const auto set = [&](int i, double doubleArea, const Eigen::RowVector3d& squaredSides)
  {
    flipped.doubleAreas[i] = doubleArea;
    flipped.cotangents[i] =
      (0.25 / doubleArea) * (squaredSides.sum() - 2.0 * squaredSides.array()).matrix();
  };
  set(0, (u.a * B + u.b * A) / uv, { ab, au, ub });
  set(1, (v.a * B + v.b * A) / uv, { ab, bv, va });
  return flipped;
}

/// Orients the triangle of half-edge h the other way: h stays, the other two change places. Comes
/// before a flip of h, which gives the triangle new cotangents.
void Gluing::Reverse(int h)
{
  const int next = Next(h), previous = Previous(h);
  for (const int i : { h, next, previous })
  {
    this->Opposed[this->Edges[i]] ^= 1;
  }
  const int nextTwin = this->Twins[next], previousTwin = this->Twins[previous];
  const bool glued = nextTwin == previous; // to each other: the pair stays a pair
  const int nextEdge = this->Edges[next], previousEdge = this->Edges[previous];
  const int nextPoint = this->F.data()[next], previousPoint = this->F.data()[previous];
  this->Place(next, previousPoint, previousEdge, glued ? previous : previousTwin);
  this->Place(previous, nextPoint, nextEdge, glued ? next : nextTwin);
}

/// Puts a corner and the half-edge opposite it into a slot.
void Gluing::Place(int h, int point, int edge, int twin)
{
  this->F.data()[h] = point;
  this->Edges[h] = edge;
  this->Twins[h] = twin;
  this->HalfEdges[edge] = h;
  if (twin >= 0)
  {
    this->Twins[twin] = h;
  }
}

/// (a, u, v) and (b, v, u) become (u, b, a) and (v, a, b), in the same rows.
void Gluing::Flip(int edge, const Flipped& flipped)
{
  if (this->Opposed[edge])
  {
    this->Reverse(this->Twins[this->HalfEdges[edge]]);
  }
  const int h = this->HalfEdges[edge], g = this->Twins[h];
  const int f = 3 * (h / 3), s = 3 * (g / 3); // first slots of the two triangles
  const int* point = this->F.data();
  const int a = point[h], u = point[Next(h)], v = point[Previous(h)], b = point[g];
  // Where the four outer half-edges are and where they go.
  const std::array<int, 4> from = { Previous(h), Next(g), Previous(g), Next(h) }; // au ub bv va
  const std::array<int, 4> to = { f + 1, f + 2, s + 1, s + 2 };
  std::array<int, 4> edges;
  std::array<int, 4> twins;
  for (int i = 0; i < 4; ++i)
  {
    edges[i] = this->Edges[from[i]];
    twins[i] = this->Twins[from[i]];
    for (int j = 0; j < 4; ++j)
    {
      if (twins[i] == from[j]) // glued among themselves
      {
        twins[i] = to[j];
        break;
      }
    }
  }
  const std::array<int, 4> corners = { b, a, a, b }; // opposite au ub bv va
  this->Place(f, u, edge, s);
  this->Place(s, v, edge, f);
  for (int i = 0; i < 4; ++i)
  {
    this->Place(to[i], corners[i], edges[i], twins[i]);
  }
  this->Opposed[edge] = 0;
  this->SquaredLengths[edge] = flipped.squaredLength;
  for (const int i : { 0, 1 })
  {
    const int triangle = (i == 0 ? f : s) / 3;
    this->DoubleAreas[triangle] = flipped.doubleAreas[i];
    this->Cotangents.row(triangle) = flipped.cotangents[i];
  }
  ++this->NumberOfFlips;
  for (const int outer : edges)
  {
    this->Enqueue(outer);
  }
}

IntrinsicTriangulation Gluing::Take()
{
  // A half-edge without a twin lies on an edge of one, or of three and more, triangles.
  std::vector<double> weights(this->HalfEdges.size(), 0.0);
  for (std::size_t h = 0; h < this->Edges.size(); ++h)
  {
    weights[this->Edges[h]] += this->Cotangents.data()[h];
  }
  IntrinsicTriangulation result;
  for (const double weight : weights)
  {
    result.NumberOfNegativeEdges += weight < Negative;
  }
  result.NumberOfFlips = this->NumberOfFlips;
  result.Twins = std::move(this->Twins);
  result.F = std::move(this->F);
  result.Cotangents = std::move(this->Cotangents);
  return result;
}
}

IntrinsicTriangulation IntrinsicDelaunay(
  const Points& P, const Triangles& F, const HalfEdgeScalars& cotangents)
{
  Gluing gluing(P, F, cotangents);
  gluing.FlipToDelaunay();
  return gluing.Take();
}
} // namespace SphericalStyle
