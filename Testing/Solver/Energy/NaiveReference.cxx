// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "NaiveReference.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <map>

namespace
{
using namespace SphericalStyle;
using Vector = Eigen::Vector3d;

Vector Row(const Points& x, int i)
{
  return x.row(i).transpose();
}

double Area(const Points& P, const Triangles& F, int f)
{
  return 0.5 * (Row(P, F(f, 1)) - Row(P, F(f, 0))).cross(Row(P, F(f, 2)) - Row(P, F(f, 0))).norm();
}

// c_h: half the cotangent of the angle at corner k, which lies opposite half-edge k.
double HalfCotangent(const Points& P, const Triangles& F, int f, int k)
{
  const Vector x = Row(P, F(f, (k + 1) % 3)) - Row(P, F(f, k));
  const Vector y = Row(P, F(f, (k + 2) % 3)) - Row(P, F(f, k));
  return 0.5 * x.dot(y) / x.cross(y).norm();
}

// Unit triangle normals weighted by the angle at the point.
Points AngleWeightedNormals(const Points& P, const Triangles& F)
{
  Points N = Points::Zero(P.rows(), 3);
  for (int f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vector x = Row(P, F(f, (k + 1) % 3)) - Row(P, F(f, k));
      const Vector y = Row(P, F(f, (k + 2) % 3)) - Row(P, F(f, k));
      const double angle = std::acos(std::clamp(x.dot(y) / (x.norm() * y.norm()), -1.0, 1.0));
      N.row(F(f, k)) += angle * x.cross(y).normalized().transpose();
    }
  }
  for (int i = 0; i < N.rows(); ++i)
  {
    N.row(i) = Row(N, i).normalized().transpose();
  }
  return N;
}
} // namespace

NaiveReference::NaiveReference(const TriangleMesh& mesh, const StyleOptions& options)
  : N(mesh.P.rows())
  , P(mesh.P)
  , CentroidAnchor(options.anchor == Anchor::Centroid)
{
  const Triangles& F = mesh.F;

  // The sphere.
  double area = 0.0;
  Vector areaCentroid = Vector::Zero();
  const Vector mean = P.colwise().mean().transpose();
  double volume = 0.0;
  for (int f = 0; f < F.rows(); ++f)
  {
    const Vector a = Row(P, F(f, 0)), b = Row(P, F(f, 1)), c = Row(P, F(f, 2));
    area += Area(P, F, f);
    areaCentroid += Area(P, F, f) * (a + b + c) / 3.0;
    volume += (a - mean).dot((b - mean).cross(c - mean)) / 6.0;
  }
  areaCentroid /= area;
  this->PointArea.assign(N, 0.0);
  for (int f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->PointArea[F(f, k)] += Area(P, F, f) / 3.0;
    }
  }
  this->O = options.centerMode == CenterMode::Custom ? options.custom.center
    : options.centerMode == CenterMode::AreaCentroid ? areaCentroid
                                                     : mean;
  this->Radius = options.radiusMode == RadiusMode::Custom ? options.custom.radius
    : options.radiusMode == RadiusMode::EqualVolume ? std::cbrt(3.0 * std::abs(volume) / (4.0 * Pi))
                                                    : std::sqrt(area / (4.0 * Pi));

  // t
  this->T.resize(N, 3);
  const Points normals = options.normals.rows() > 0 ? options.normals : AngleWeightedNormals(P, F);
  for (int i = 0; i < N; ++i)
  {
    const double a =
      options.normalBlends.size() > 0 ? options.normalBlends[i] : options.normalBlend;
    const Vector d = (Row(P, i) - this->O).normalized();
    this->T.row(i) = ((1.0 - a) * d + a * Row(normals, i)).transpose();
  }
  if (options.targets.rows() > 0)
  {
    this->T = options.targets;
  }

  // Half-edges.
  std::map<std::pair<int, int>, double> w;
  for (int f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = F(f, (k + 1) % 3), v = F(f, (k + 2) % 3);
      w[{ std::min(u, v), std::max(u, v) }] += HalfCotangent(P, F, f, k);
    }
  }
  const auto lambdaOf = [&](int i)
  {
    return options.lambda *
      (options.roundnessFactors.size() > 0 ? options.roundnessFactors[i] : 1.0);
  };
  const bool full = options.edgeWeighting == EdgeWeighting::FullEdge;
  for (int f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      HalfEdge h;
      h.u = F(f, (k + 1) % 3);
      h.v = F(f, (k + 2) % 3);
      std::copy_n(F.data() + 3 * f, 3, h.cells);
      h.c = full ? w[{ std::min(h.u, h.v), std::max(h.u, h.v) }] : HalfCotangent(P, F, f, k);
      if (options.sphericalWeighting == SphericalWeighting::Uniform)
      {
        h.l = (full ? 1.0 : 0.5) * 0.5 * (lambdaOf(h.u) + lambdaOf(h.v));
      }
      else
      {
        // The mean over the triangle, not the edge: see the proof in TestAgainstReference.
        const double lambda = (lambdaOf(F(f, 0)) + lambdaOf(F(f, 1)) + lambdaOf(F(f, 2))) / 3.0;
        h.l = std::sqrt(3.0) * lambda * h.c;
      }
      h.e = Row(P, h.u) - Row(P, h.v);
      h.tau = this->Radius * (Row(this->T, h.u) - Row(this->T, h.v));
      if (options.concaveEdges != ConcaveEdges::Keep && h.tau.dot(h.e) < 0.0)
      {
        ++this->Flipped;
        h.tau = options.concaveEdges == ConcaveEdges::Flip ? Vector(-h.tau) : Vector::Zero();
      }
      this->HalfEdges.push_back(h);
    }
  }

  // Components, by spreading the smallest number.
  this->Component.resize(N);
  for (int i = 0; i < N; ++i)
  {
    this->Component[i] = i;
  }
  for (bool changed = true; changed;)
  {
    changed = false;
    for (const HalfEdge& h : this->HalfEdges)
    {
      const int least = std::min(this->Component[h.u], this->Component[h.v]);
      changed = changed || this->Component[h.u] != least || this->Component[h.v] != least;
      this->Component[h.u] = this->Component[h.v] = least;
    }
  }
  this->Pinned.assign(N, 0);
  this->LastPoint.assign(N, -1);
  for (int i = 0; i < N; ++i)
  {
    this->LastPoint[this->Component[i]] = i;
  }

  // Knowns and unknowns.
  std::vector<char> held(N, 0);
  this->Held = P;
  for (std::size_t k = 0; k < options.fixedPoints.size(); ++k)
  {
    const int i = options.fixedPoints[k];
    held[i] = 1;
    this->Held.row(i) = options.fixedPositions.row(k);
    this->Pinned[this->Component[i]] = 1;
  }
  for (int i = 0; i < N; ++i)
  {
    const int component = this->Component[i];
    held[i] = held[i] || (!this->Pinned[component] && this->LastPoint[component] == i);
  }
  this->RowOf.assign(N, -1);
  for (int i = 0; i < N; ++i)
  {
    if (!held[i])
    {
      this->RowOf[i] = static_cast<int>(this->Free.size());
      this->Free.push_back(i);
    }
  }

  this->Full = Eigen::MatrixXd::Zero(N, N);
  for (const HalfEdge& h : this->HalfEdges)
  {
    for (int cell = 0; cell < 3; ++cell)
    {
      this->Full(h.u, h.u) += h.c + h.l;
      this->Full(h.v, h.v) += h.c + h.l;
      this->Full(h.u, h.v) -= h.c + h.l;
      this->Full(h.v, h.u) -= h.c + h.l;
    }
  }
  Eigen::MatrixXd reduced(this->Free.size(), this->Free.size());
  for (std::size_t i = 0; i < this->Free.size(); ++i)
  {
    for (std::size_t j = 0; j < this->Free.size(); ++j)
    {
      reduced(i, j) = this->Full(this->Free[i], this->Free[j]);
    }
  }
  this->Factor.compute(reduced);

  // The start.
  this->R.assign(N, Eigen::Matrix3d::Identity());
  this->Q = this->Held;
  if (options.initialGuess == InitialGuess::Blend)
  {
    this->GlobalStep();
  }
}

void NaiveReference::LocalStep()
{
  for (int y = 0; y < N; ++y)
  {
    Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
    for (const HalfEdge& h : this->HalfEdges)
    {
      if (h.cells[0] == y || h.cells[1] == y || h.cells[2] == y)
      {
        const Vector e = Row(this->Q, h.u) - Row(this->Q, h.v);
        S += h.c * h.e * e.transpose() + h.l * h.tau * e.transpose();
      }
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(S, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d V = svd.matrixV();
    const double sign = (V * svd.matrixU().transpose()).determinant() > 0.0 ? 1.0 : -1.0;
    V.col(2) *= sign; // singular values descend: the last is the smallest
    this->R[y] = V * svd.matrixU().transpose();
    const Vector s = svd.singularValues();
    this->Conditioning = std::min(this->Conditioning, (s[1] + sign * s[2]) / s[0]);
  }
}

void NaiveReference::GlobalStep()
{
  Points b = Points::Zero(N, 3);
  for (const HalfEdge& h : this->HalfEdges)
  {
    for (const int y : h.cells)
    {
      const Vector pull = this->R[y] * (h.c * h.e + h.l * h.tau);
      b.row(h.u) += pull.transpose();
      b.row(h.v) -= pull.transpose();
    }
  }
  Eigen::MatrixXd right(this->Free.size(), 3);
  for (std::size_t i = 0; i < this->Free.size(); ++i)
  {
    right.row(i) = b.row(this->Free[i]);
    for (int j = 0; j < N; ++j)
    {
      if (this->RowOf[j] < 0)
      {
        right.row(i) -= this->Full(this->Free[i], j) * this->Held.row(j);
      }
    }
  }
  const Eigen::MatrixXd x = this->Factor.solve(right);
  this->Q = this->Held;
  for (std::size_t i = 0; i < this->Free.size(); ++i)
  {
    this->Q.row(this->Free[i]) = x.row(i);
  }
  // Centroids back to their places.
  for (int component = 0; this->CentroidAnchor && component < N; ++component)
  {
    if (this->LastPoint[component] < 0 || this->Pinned[component])
    {
      continue;
    }
    Eigen::RowVector3d shift = Eigen::RowVector3d::Zero();
    double sum = 0.0;
    for (int i = 0; i < N; ++i)
    {
      if (this->Component[i] == component)
      {
        shift += this->PointArea[i] * (P.row(i) - this->Q.row(i));
        sum += this->PointArea[i];
      }
    }
    for (int i = 0; i < N; ++i)
    {
      if (this->Component[i] == component)
      {
        this->Q.row(i) += shift / sum;
      }
    }
  }
}

void NaiveReference::Iterate()
{
  this->LocalStep();
  this->GlobalStep();
}

EnergyTerms NaiveReference::Energy() const
{
  EnergyTerms energy;
  for (const HalfEdge& h : this->HalfEdges)
  {
    const Vector e = Row(this->Q, h.u) - Row(this->Q, h.v);
    for (const int y : h.cells)
    {
      energy.rigid += h.c * (e - this->R[y] * h.e).squaredNorm();
      energy.spherical += h.l * (e - this->R[y] * h.tau).squaredNorm();
    }
  }
  return energy;
}

Eigen::VectorXd NaiveReference::CellEnergies() const
{
  Eigen::VectorXd cells = Eigen::VectorXd::Zero(N);
  for (const HalfEdge& h : this->HalfEdges)
  {
    const Vector e = Row(this->Q, h.u) - Row(this->Q, h.v);
    for (const int y : h.cells)
    {
      cells[y] +=
        h.c * (e - this->R[y] * h.e).squaredNorm() + h.l * (e - this->R[y] * h.tau).squaredNorm();
    }
  }
  return cells;
}
