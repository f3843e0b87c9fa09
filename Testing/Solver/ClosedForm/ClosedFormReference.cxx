// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClosedFormReference.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

using namespace SphericalStyle;

namespace
{
using Matrix = Eigen::MatrixXd;
using Matrix3 = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;
using Cell = std::array<int, 3>;

constexpr double OfNothing = -1.0;

/// Quadratic B-spline around 0, of width 3.
double Spline(double u)
{
  const double a = std::abs(u);
  return a < 0.5 ? 0.75 - a * a : a < 1.5 ? 0.5 * (1.5 - a) * (1.5 - a) : 0.0;
}

double SplineSlope(double u)
{
  const double a = std::abs(u);
  return a < 0.5 ? -2.0 * u : a < 1.5 ? (u > 0.0 ? a - 1.5 : 1.5 - a) : 0.0;
}

Vector RowOf(const Points& X, int i)
{
  return X.row(i).transpose();
}

double AreaOf(const Vector& a, const Vector& b, const Vector& c)
{
  return 0.5 * (b - a).cross(c - a).norm();
}

/// det(G) G^-T, which also exists where G has no inverse: what G does to area vectors.
Matrix3 Cofactors(const Matrix3& G)
{
  Matrix3 C;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      C(i, j) = G(i1, j1) * G(i2, j2) - G(i1, j2) * G(i2, j1);
    }
  }
  return C;
}

/// The rotation R with the largest trace of R S.
Matrix3 RotationOf(const Matrix3& S)
{
  if (S.norm() == 0.0)
  {
    return Matrix3::Identity();
  }
  const Eigen::JacobiSVD<Matrix3> svd(S, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector signs(1.0, 1.0, 1.0);
  signs(2) = svd.matrixU().determinant() * svd.matrixV().determinant() > 0.0 ? 1.0 : -1.0;
  return svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
}

/// What is kept of details that the rotation of S turns: less where det S < 0 and the two smaller
/// singular values come close, since the rotation flips where they are equal.
double KeptShare(const Matrix3& S)
{
  const Vector values = Eigen::JacobiSVD<Matrix3>(S).singularValues();
  if (S.determinant() >= 0.0)
  {
    return 1.0;
  }
  const double c = (values(1) - values(2)) / (values(1) + values(2));
  return c * c * (3.0 - 2.0 * c);
}

/// Nine numbers as a 3 x 3 matrix, row by row.
Matrix3 MatrixOf(const Matrix& rows, Eigen::Index k)
{
  Matrix3 M;
  M << rows(k, 0), rows(k, 1), rows(k, 2), rows(k, 3), rows(k, 4), rows(k, 5), rows(k, 6),
    rows(k, 7), rows(k, 8);
  return M;
}

void PutMatrix(const Matrix3& M, Matrix& rows, Eigen::Index k)
{
  rows.row(k) << M.row(0), M.row(1), M.row(2);
}

struct Hit
{
  int triangle = -1;
  double distance = std::numeric_limits<double>::infinity();
  Vector place = Vector::Zero();
  double cosine = 0.0; // of the direction to the normal
};

/// The nearest triangle that the ray meets within its reach; those that it meets from their outside
/// nearer than `blind` do not count.
Hit FirstHitOf(const Points& X, const Triangles& F, const Vector& origin, const Vector& direction,
  double reach, double blind)
{
  constexpr double nearest = 1e-6;
  constexpr double rounding = 1e-9;
  Hit hit;
  for (int f = 0; f < F.rows(); ++f)
  {
    const Vector a = RowOf(X, F(f, 0));
    const Vector b = RowOf(X, F(f, 1)) - a;
    const Vector c = RowOf(X, F(f, 2)) - a;
    const Vector n = b.cross(c);
    const double across = n.dot(direction);
    if (std::abs(across) <= 1e-12 * b.norm() * c.norm())
    {
      continue;
    }
    const double distance = n.dot(a - origin) / across;
    if (!(distance > nearest && distance < reach && distance < hit.distance) ||
      (across < 0.0 && distance < blind))
    {
      continue;
    }
    const Vector x = origin + distance * direction;
    const double u = n.dot((x - a).cross(c)) / n.squaredNorm();
    const double v = n.dot(b.cross(x - a)) / n.squaredNorm();
    if (u >= -rounding && v >= -rounding && u + v <= 1.0 + rounding)
    {
      hit = { f, distance, x, across / n.norm() };
    }
  }
  return hit;
}

/// How much of a full turn arcs cover together: middles, and halves of lengths.
double TurnOf(const std::vector<std::pair<double, double>>& arcs)
{
  const double turn = 2.0 * std::acos(-1.0);
  std::vector<std::pair<double, double>> spans;
  for (const auto& [middle, half] : arcs)
  {
    const double from = middle - half - turn * std::floor((middle - half) / turn);
    spans.emplace_back(from, std::min(turn, from + 2.0 * half));
    if (from + 2.0 * half > turn)
    {
      spans.emplace_back(0.0, from + 2.0 * half - turn);
    }
  }
  std::sort(spans.begin(), spans.end());
  double covered = 0.0, end = 0.0;
  for (const auto& [from, to] : spans)
  {
    covered += std::max(0.0, to - std::max(end, from));
    end = std::max(end, to);
  }
  return covered;
}

/// Gauss' rule on -1..1.
constexpr double GaussPlaces[] = { -0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
  0.8611363115940526 };
constexpr double GaussWeights[] = { 0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
  0.3478548451374538 };

/// Functions on the grid, all matrices full.
class DenseGrid
{
public:
  struct Quadrature
  {
    int triangle;
    Vector barycentric;
    double weight;
  };
  struct Sample
  {
    std::vector<Quadrature> quadrature;
    double weight = 0.0;
    Vector place = Vector::Zero();
    Vector areaVector = Vector::Zero();
    Matrix3 along = Matrix3::Zero();
    Matrix3 across = Matrix3::Zero();
    Matrix3 spread = Matrix3::Zero();
  };
  struct Pair
  {
    Vector u = Vector::Zero();
    Vector v = Vector::Zero();
    double weight = 0.0;
  };

  double Size;
  double Spacing;
  double Margin = 0.5;
  std::vector<Sample> Samples;

  DenseGrid(const Points& p, const Triangles& f, double size)
    : Size(size)
    , Spacing(size / 1.5)
    , P(p)
    , F(f)
  {
    std::map<Cell, Sample> subCells;
    for (int t = 0; t < f.rows(); ++t)
    {
      this->Cut(t, subCells);
    }
    for (const Cell& cell : this->Cells)
    {
      for (int k = 0; k < 27; ++k)
      {
        this->Functions.insert(
          { { cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1 }, 0 });
      }
    }
    int number = 0;
    for (auto& function : this->Functions)
    {
      function.second = number++;
    }
    for (auto& subCell : subCells)
    {
      if (subCell.second.weight > 0.0)
      {
        this->Samples.push_back(subCell.second);
        this->Sum(this->Samples.back());
      }
    }
  }

  int Count() const { return static_cast<int>(this->Functions.size()); }

  /// @param across  factor of the slope across the surface
  void Factor(double mass, double stiffness, double across, const std::vector<Pair>& pairs)
  {
    const int n = this->Count();
    Matrix A = Matrix::Zero(n, n);
    std::map<Cell, Matrix3> normals;
    for (const Sample& sample : this->Samples)
    {
      const std::vector<Value> values = this->At(sample.place);
      for (const Value& a : values)
      {
        for (const Value& b : values)
        {
          A(a.function, b.function) += mass * sample.weight * a.phi * b.phi +
            stiffness * a.gradient.dot(sample.along * b.gradient);
        }
      }
      if (across > 0.0)
      {
        auto& ofCell =
          normals.insert({ this->CellOf(sample.place), Matrix3::Zero() }).first->second;
        ofCell += across * stiffness * sample.across;
      }
    }
    for (const auto& cell : normals)
    {
      this->AddAcross(cell.first, cell.second, A);
    }
    A.diagonal().array() += 1e-7 * A.trace() / n;
    this->AddPairs(pairs, A);
    this->Factored.compute(A);
  }

  /// Means over the samples of what is linear on the triangles.
  Matrix Means(const Matrix& X) const
  {
    Matrix means = Matrix::Zero(this->Samples.size(), X.cols());
    for (std::size_t k = 0; k < this->Samples.size(); ++k)
    {
      for (const Quadrature& q : this->Samples[k].quadrature)
      {
        for (int corner = 0; corner < 3; ++corner)
        {
          means.row(k) += q.weight / this->Samples[k].weight * q.barycentric(corner) *
            X.row(this->F(q.triangle, corner));
        }
      }
    }
    return means;
  }

  /// Means of the Jacobian along the surface, row by row.
  Matrix Gradients(const Points& X) const
  {
    Matrix gradients = Matrix::Zero(this->Samples.size(), 9);
    for (std::size_t k = 0; k < this->Samples.size(); ++k)
    {
      Matrix3 sum = Matrix3::Zero();
      for (const Quadrature& q : this->Samples[k].quadrature)
      {
        const Vector& n = this->Normal(q.triangle);
        // Edge to edge, and the normal to nothing.
        Matrix3 from, to;
        from << this->Edge(this->P, q.triangle, 1), this->Edge(this->P, q.triangle, 2), n;
        to << this->Edge(X, q.triangle, 1), this->Edge(X, q.triangle, 2), Vector::Zero();
        sum += q.weight * from.transpose().colPivHouseholderQr().solve(to.transpose()).transpose();
      }
      PutMatrix(sum / this->Samples[k].weight, gradients, static_cast<Eigen::Index>(k));
    }
    return gradients;
  }

  /// @param Y  samples x 3 c, or no rows
  Matrix Solve(const Matrix& X, const Matrix& Y = Matrix(0, 0)) const
  {
    Matrix b = Matrix::Zero(this->Count(), X.cols());
    for (std::size_t k = 0; k < this->Samples.size(); ++k)
    {
      for (const Value& a : this->At(this->Samples[k].place))
      {
        b.row(a.function) += this->Samples[k].weight * a.phi * X.row(k);
        for (Eigen::Index j = 0; Y.rows() > 0 && j < X.cols(); ++j)
        {
          b(a.function, j) += a.gradient.dot(Y.row(k).segment(3 * j, 3).transpose());
        }
      }
    }
    return this->Factored.solve(b);
  }

  Matrix AtSamples(const Matrix& coefficients) const
  {
    Points places(this->Samples.size(), 3);
    for (std::size_t k = 0; k < this->Samples.size(); ++k)
    {
      places.row(k) = this->Samples[k].place.transpose();
    }
    return this->AtPoints(coefficients, places);
  }

  Matrix AtPoints(const Matrix& coefficients, const Points& x) const
  {
    Matrix result = Matrix::Zero(x.rows(), coefficients.cols());
    for (int i = 0; i < x.rows(); ++i)
    {
      for (const Value& a : this->At(RowOf(x, i)))
      {
        result.row(i) += a.phi * coefficients.row(a.function);
      }
    }
    return result;
  }

  /// Two implicit steps.
  Matrix SmoothTwice(const Matrix& X) const { return this->Solve(this->AtSamples(this->Solve(X))); }

private:
  struct Value
  {
    int function;
    double phi;
    Vector gradient;
  };

  Vector Edge(const Points& X, int t, int corner) const
  {
    return RowOf(X, this->F(t, corner)) - RowOf(X, this->F(t, 0));
  }

  Vector Normal(int t) const
  {
    return this->Edge(this->P, t, 1).cross(this->Edge(this->P, t, 2)).normalized();
  }

  /// Cells have their middles at multiples of the spacing.
  Cell CellOf(const Vector& x) const
  {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis)
    {
      cell[axis] = static_cast<int>(std::floor(x(axis) / this->Spacing + 0.5));
    }
    return cell;
  }

  Cell SubCellOf(const Vector& x)
  {
    Cell cell = this->CellOf(x);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double at = 3.0 * (x(axis) / this->Spacing + 0.5 - cell[axis]);
      this->Margin = std::min(this->Margin, std::abs(at - std::round(at)) / 3.0);
      cell[axis] = 3 * cell[axis] + std::clamp(static_cast<int>(std::floor(at)), 0, 2);
    }
    return cell;
  }

  std::vector<Value> At(const Vector& x) const
  {
    std::vector<Value> values;
    const Cell cell = this->CellOf(x);
    if (this->Cells.count(cell) == 0)
    {
      return values;
    }
    for (int k = 0; k < 27; ++k)
    {
      const Cell at = { cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1 };
      Vector w, slope;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double u = x(axis) / this->Spacing - at[axis];
        w(axis) = Spline(u);
        slope(axis) = SplineSlope(u) / this->Spacing;
      }
      values.push_back({ this->Functions.at(at), w.prod(),
        { slope(0) * w(1) * w(2), w(0) * slope(1) * w(2), w(0) * w(1) * slope(2) } });
    }
    return values;
  }

  void Add(int t, const Vector& barycentric, double weight, std::map<Cell, Sample>& subCells)
  {
    Vector x = Vector::Zero();
    for (int k = 0; k < 3; ++k)
    {
      x += barycentric(k) * RowOf(this->P, this->F(t, k));
    }
    const Cell subCell = this->SubCellOf(x);
    this->Cells.insert(this->CellOf(x));
    Sample& sample = subCells[subCell];
    sample.quadrature.push_back({ t, barycentric, weight });
    sample.weight += weight;
  }

  void Cut(int t, std::map<Cell, Sample>& subCells)
  {
    const Vector a = RowOf(this->P, this->F(t, 0));
    const Vector b = RowOf(this->P, this->F(t, 1));
    const Vector c = RowOf(this->P, this->F(t, 2));
    const double area = AreaOf(a, b, c);
    const double longest =
      std::max({ (a - b).norm(), (b - c).norm(), (c - a).norm() }) / this->Spacing;
    this->Margin = std::min(this->Margin, std::abs(longest - 1.0 / 6.0));
    const Cell middle = this->CellOf((a + b + c) / 3.0);
    if (longest <= 1.0 / 6.0 && this->CellOf(a) == middle && this->CellOf(b) == middle &&
      this->CellOf(c) == middle)
    {
      this->Add(t, Vector::Constant(1.0 / 3.0), area, subCells);
      return;
    }
    const double parts = longest / 0.75;
    const int n = std::max(1, static_cast<int>(std::ceil(parts)));
    this->Margin = std::min(this->Margin, std::abs(parts - std::round(parts)));
    const auto corner = [n](int i, int j) -> Vector
    { return Vector(n - i - j, i, j) / static_cast<double>(n); };
    const auto add = [&](const Vector& x, const Vector& y, const Vector& z)
    {
      const double share = area / n / n;
      this->Add(t, (x + y + z) / 3.0, 0.75 * share, subCells);
      for (const Vector& k : { x, y, z })
      {
        this->Add(t, k, share / 12.0, subCells);
      }
    };
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; i + j < n; ++j)
      {
        add(corner(i, j), corner(i + 1, j), corner(i, j + 1));
        if (i + j + 2 <= n)
        {
          add(corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
        }
      }
    }
  }

  void Sum(Sample& sample) const
  {
    std::map<int, std::pair<double, Vector>> ofTriangles; // what of each lies in it, and where
    for (const Quadrature& q : sample.quadrature)
    {
      Vector x = Vector::Zero();
      for (int k = 0; k < 3; ++k)
      {
        x += q.barycentric(k) * RowOf(this->P, this->F(q.triangle, k));
      }
      const Vector n = this->Normal(q.triangle);
      sample.place += q.weight / sample.weight * x;
      sample.areaVector += q.weight * n;
      const Matrix3 across = n * n.transpose();
      sample.along += q.weight * (Matrix3::Identity() - across);
      sample.across += q.weight * across;
      auto& part = ofTriangles.insert({ q.triangle, { 0.0, Vector::Zero() } }).first->second;
      part.first += q.weight;
      part.second += q.weight * x;
    }
    for (const auto& part : ofTriangles)
    {
      const double weight = part.second.first;
      if (weight > 0.0)
      {
        const Vector away = part.second.second / weight - sample.place;
        sample.spread += weight / sample.weight * away * away.transpose();
      }
    }
  }

  /// The mean over a cell of grad phi^T normals grad phi.
  void AddAcross(const Cell& cell, const Matrix3& normals, Matrix& A) const
  {
    const Vector middle = this->Spacing * Vector(cell[0], cell[1], cell[2]);
    for (int q = 0; q < 64; ++q) // Gauss, 4 places along each axis
    {
      const Vector place(GaussPlaces[q % 4], GaussPlaces[q / 4 % 4], GaussPlaces[q / 16]);
      const double weight =
        GaussWeights[q % 4] * GaussWeights[q / 4 % 4] * GaussWeights[q / 16] / 8.0;
      const std::vector<Value> values = this->At(middle + 0.5 * this->Spacing * place);
      for (const Value& a : values)
      {
        for (const Value& b : values)
        {
          A(a.function, b.function) += weight * a.gradient.dot(normals * b.gradient);
        }
      }
    }
  }

  void AddPairs(const std::vector<Pair>& pairs, Matrix& A) const
  {
    std::map<std::pair<Cell, Cell>, Pair> sums;
    std::vector<Pair> apart; // in one cell nothing says which side is which
    const auto order = [](const Cell& cell) { return Cell{ cell[2], cell[1], cell[0] }; };
    for (const Pair& pair : pairs)
    {
      Vector u = pair.u, v = pair.v;
      if (this->Cells.count(this->CellOf(u)) == 0 || this->Cells.count(this->CellOf(v)) == 0)
      {
        continue;
      }
      if (order(this->CellOf(v)) < order(this->CellOf(u)))
      {
        std::swap(u, v);
      }
      if (this->CellOf(u) == this->CellOf(v))
      {
        apart.push_back(pair);
        apart.back().u *= pair.weight;
        apart.back().v *= pair.weight;
        continue;
      }
      Pair& sum = sums[{ this->CellOf(u), this->CellOf(v) }];
      sum.u += pair.weight * u;
      sum.v += pair.weight * v;
      sum.weight += pair.weight;
    }
    for (const auto& both : sums)
    {
      apart.push_back(both.second);
    }
    for (const Pair& sum : apart)
    {
      Eigen::VectorXd difference = Eigen::VectorXd::Zero(this->Count());
      std::set<int> functions;
      for (const double sign : { 1.0, -1.0 })
      {
        for (const Value& a : this->At((sign > 0.0 ? sum.u : sum.v) / sum.weight))
        {
          difference(a.function) += sign * a.phi;
          functions.insert(a.function);
        }
      }
      for (const int a : functions)
      {
        for (const int b : functions)
        {
          A(a, b) += this->Size * this->Size * sum.weight * difference(a) * difference(b);
        }
      }
    }
  }

  const Points& P;
  const Triangles& F;
  std::set<Cell> Cells;
  std::map<Cell, int> Functions; // by their middles
  Eigen::LLT<Matrix> Factored;
};

/// Of what is not a closed surface, the cones from an apex.
double VolumeOf(const Points& X, const Triangles& F, const Vector& apex)
{
  double volume = 0.0;
  for (int f = 0; f < F.rows(); ++f)
  {
    Matrix3 corners;
    corners << RowOf(X, F(f, 0)) - apex, RowOf(X, F(f, 1)) - apex, RowOf(X, F(f, 2)) - apex;
    volume += corners.determinant() / 6.0;
  }
  return volume;
}

double AreaOf(const Points& X, const Triangles& F)
{
  double area = 0.0;
  for (int f = 0; f < F.rows(); ++f)
  {
    area += AreaOf(RowOf(X, F(f, 0)), RowOf(X, F(f, 1)), RowOf(X, F(f, 2)));
  }
  return area;
}

/// Triangles on both sides of an edge agree, most of the area of what hangs together stays, and the
/// whole encloses a volume above zero.
Triangles FacingOutward(const Points& P, const Triangles& F)
{
  std::map<std::pair<int, int>, std::vector<std::pair<int, bool>>> edges;
  for (int f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = F(f, k), v = F(f, (k + 1) % 3);
      edges[{ std::min(u, v), std::max(u, v) }].push_back({ f, u < v });
    }
  }
  std::vector<int> side(F.rows(), 0);
  Triangles oriented = F;
  for (int seed = 0; seed < F.rows(); ++seed)
  {
    if (side[seed] != 0)
    {
      continue;
    }
    std::vector<int> patch = { seed };
    side[seed] = 1;
    for (std::size_t at = 0; at < patch.size(); ++at)
    {
      for (const auto& edge : edges)
      {
        if (edge.second.size() != 2)
        {
          continue;
        }
        for (int end = 0; end < 2; ++end)
        {
          const auto& here = edge.second[end];
          const auto& there = edge.second[1 - end];
          if (here.first == patch[at] && side[there.first] == 0)
          {
            side[there.first] = here.second == there.second ? -side[here.first] : side[here.first];
            patch.push_back(there.first);
          }
        }
      }
    }
    double agree = 0.0;
    for (const int f : patch)
    {
      agree += side[f] * AreaOf(RowOf(P, F(f, 0)), RowOf(P, F(f, 1)), RowOf(P, F(f, 2)));
    }
    for (const int f : patch)
    {
      if (side[f] * agree < 0.0)
      {
        std::swap(oriented(f, 1), oriented(f, 2));
      }
    }
  }
  if (VolumeOf(P, oriented, P.colwise().mean().transpose()) < 0.0)
  {
    oriented.col(1).swap(oriented.col(2));
  }
  return oriented;
}

Sphere SphereOf(const Points& X, const Triangles& F, const std::vector<int>& points,
  const std::vector<int>& triangles, const Vector& apex, const MethodOptions& o,
  const Sphere& custom)
{
  Sphere sphere = custom;
  double area = 0.0;
  double volume = 0.0;
  Vector centroid = Vector::Zero();
  for (const int f : triangles)
  {
    const Vector a = RowOf(X, F(f, 0)), b = RowOf(X, F(f, 1)), c = RowOf(X, F(f, 2));
    area += AreaOf(a, b, c);
    centroid += AreaOf(a, b, c) * (a + b + c) / 3.0;
    Matrix3 corners;
    corners << a - apex, b - apex, c - apex;
    volume += corners.determinant() / 6.0;
  }
  if (o.centerMode == CenterMode::AreaCentroid)
  {
    sphere.center = centroid / area;
  }
  else if (o.centerMode == CenterMode::PointMean)
  {
    sphere.center.setZero();
    for (const int i : points)
    {
      sphere.center += RowOf(X, i) / static_cast<double>(points.size());
    }
  }
  if (o.radiusMode == RadiusMode::EqualArea)
  {
    sphere.radius = std::sqrt(area / (4.0 * EIGEN_PI));
  }
  else if (o.radiusMode == RadiusMode::EqualVolume)
  {
    sphere.radius = std::cbrt(3.0 * std::abs(volume) / (4.0 * EIGEN_PI));
  }
  return sphere;
}
}

class ClosedFormReference::State
{
public:
  /// All that depends on the detail size alone.
  struct Base
  {
    std::unique_ptr<DenseGrid> grid; // none without details
    int walls = 0;
    Points B;
    Matrix gradients;
    Points normals;
    Matrix thickness; // rho of the samples of the grid of limbs, 0 where there is none
  };

  TriangleMesh Mesh;
  Eigen::RowVector3d Origin;
  double Diagonal;
  Points P;
  Triangles Outward;
  double Margin = 0.5;
  std::map<double, Base> Bases;
  std::unique_ptr<DenseGrid> Limbs;
  struct Joints
  {
    std::unique_ptr<DenseGrid> grid;
    Matrix shares;
  };
  std::map<std::pair<double, std::vector<int>>, Joints> AllJoints;

  Points Positions;
  Points T;
  Matrices R;
  std::vector<Sphere> Spheres;
  double SizeFactor = 1.0;
  double LargestYield = 0.0;
  int Functions = 0;
  int Walls = 0;

  explicit State(const TriangleMesh& mesh)
    : Mesh(mesh)
  {
    const Eigen::RowVector3d low = mesh.P.colwise().minCoeff();
    const Eigen::RowVector3d high = mesh.P.colwise().maxCoeff();
    this->Origin = 0.5 * (low + high);
    this->Diagonal = (high - low).norm();
    this->P = (mesh.P.rowwise() - this->Origin) / this->Diagonal;
    this->Outward = FacingOutward(this->P, mesh.F);
  }

  const Triangles& F() const { return this->Mesh.F; }
  int Count() const { return static_cast<int>(this->P.rows()); }

  std::vector<DenseGrid::Pair> FindWalls(const DenseGrid& grid) const
  {
    const double s = grid.Size;
    std::vector<DenseGrid::Pair> walls;
    for (const DenseGrid::Sample& sample : grid.Samples)
    {
      const double facing = sample.areaVector.norm() / sample.weight;
      if (facing <= 0.5)
      {
        continue;
      }
      const Hit hit = FirstHitOf(this->P, this->Outward, sample.place,
        -sample.areaVector.normalized(), 2.0 * s, 0.5 * grid.Spacing);
      if (hit.triangle >= 0 && hit.cosine > 0.0)
      {
        const double d = std::max(hit.distance, 0.1 * s);
        walls.push_back({ sample.place, hit.place,
          24.0 * sample.weight * hit.cosine * hit.cosine * (1.0 / (d * d) - 1.0 / (4.0 * s * s)) });
      }
    }
    return walls;
  }

  void AngleNormals(Points& normals) const
  {
    normals = Points::Zero(this->Count(), 3);
    for (int f = 0; f < this->Outward.rows(); ++f)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Vector p = RowOf(this->P, this->Outward(f, k));
        const Vector x = RowOf(this->P, this->Outward(f, (k + 1) % 3)) - p;
        const Vector y = RowOf(this->P, this->Outward(f, (k + 2) % 3)) - p;
        const Vector n = x.cross(y);
        normals.row(this->Outward(f, k)) +=
          std::acos(x.dot(y) / (x.norm() * y.norm())) * n.normalized().transpose();
      }
    }
    normals.rowwise().normalize();
  }

  Base& BaseOf(double size)
  {
    const auto found = this->Bases.find(size);
    if (found != this->Bases.end())
    {
      return found->second;
    }
    Base& base = this->Bases[size];
    if (size > 0.0)
    {
      base.grid = std::make_unique<DenseGrid>(this->P, this->Outward, size);
      DenseGrid& grid = *base.grid;
      this->Margin = std::min(this->Margin, grid.Margin);
      const std::vector<DenseGrid::Pair> walls = this->FindWalls(grid);
      base.walls = static_cast<int>(walls.size());
      grid.Factor(1.0, size * size, 0.1, walls);
      const Matrix smooth = grid.AtPoints(grid.SmoothTwice(grid.Means(this->P)), this->P);
      const Matrix sigma =
        grid.AtPoints(grid.SmoothTwice(Matrix::Ones(grid.Samples.size(), 1)), this->P);
      base.B = this->P;
      for (int i = 0; i < this->P.rows(); ++i)
      {
        const double e = 1.5 - 50.0 * std::abs(1.0 - sigma(i));
        base.B.row(i) += std::max(0.0, std::min(1.0, e)) * (smooth.row(i) - this->P.row(i));
      }
      base.gradients = grid.Gradients(base.B);
      Matrix normals(grid.Samples.size(), 3);
      Matrix lengths(grid.Samples.size(), 1);
      for (std::size_t k = 0; k < grid.Samples.size(); ++k)
      {
        const DenseGrid::Sample& sample = grid.Samples[k];
        normals.row(k) =
          (Cofactors(MatrixOf(base.gradients, k)) * sample.areaVector / sample.weight).transpose();
        lengths(k, 0) = normals.row(k).norm();
      }
      base.normals = grid.AtPoints(grid.Solve(normals), this->P);
      lengths = grid.AtPoints(grid.Solve(lengths), this->P);
      for (int i = 0; i < this->P.rows(); ++i)
      {
        base.normals.row(i) /= std::max(base.normals.row(i).norm(), 0.2 * lengths(i, 0));
      }
    }
    else
    {
      base.B = this->P;
      this->AngleNormals(base.normals);
    }
    this->Thickness(base);
    return base;
  }

  /// Of each sample of the grid of limbs, before anything bounds it from above.
  void Thickness(Base& base)
  {
    if (!this->Limbs)
    {
      this->Limbs = std::make_unique<DenseGrid>(this->P, this->Outward, 0.075);
      this->Limbs->Factor(1.0, 0.075 * 0.075, 0.0, {});
      this->Margin = std::min(this->Margin, this->Limbs->Margin);
    }
    const DenseGrid& grid = *this->Limbs;
    const Matrix places = grid.Means(base.B);
    const Matrix gradients = grid.Gradients(base.B);
    Matrix normals(grid.Samples.size(), 3);
    for (std::size_t k = 0; k < grid.Samples.size(); ++k)
    {
      normals.row(k) =
        (Cofactors(MatrixOf(gradients, k)) * grid.Samples[k].areaVector).normalized().transpose();
    }
    const Matrix around = grid.AtSamples(grid.Solve(normals));
    base.thickness = Matrix::Zero(grid.Samples.size(), 1);
    for (std::size_t k = 0; k < grid.Samples.size(); ++k)
    {
      if (!(around.row(k).dot(normals.row(k)) >= -0.3)) // a flipped sample
      {
        normals.row(k).setZero();
      }
    }
    for (std::size_t k = 0; k < grid.Samples.size(); ++k)
    {
      const DenseGrid::Sample& sample = grid.Samples[k];
      double rho = BallAt(grid, places, normals, k);
      const double facing = 2.0 * sample.areaVector.norm() / sample.weight;
      if (facing < 1.0) // both sides of a sheet
      {
        const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(sample.spread);
        const double sheet = std::max(0.002, std::sqrt(std::max(0.0, eigen.eigenvalues()(0))));
        rho = rho > 0.0 ? std::pow(rho, facing) * std::pow(sheet, 1.0 - facing) : sheet;
      }
      base.thickness(static_cast<Eigen::Index>(k), 0) = rho;
    }
  }

  /// The radius of the ball that touches at sample k [limb]; 0 where nothing bounds it.
  static double BallAt(
    const DenseGrid& grid, const Matrix& places, const Matrix& normals, std::size_t k)
  {
    const double cone = std::acos(-1.0) / 8.0;
    const Vector n = normals.row(k).transpose();
    if (n.norm() < 0.5)
    {
      return 0.0;
    }
    const Vector e = n.unitOrthogonal();
    struct Bound
    {
      double radius;
      bool alone;
      double azimuth;
      double half;
    };
    std::vector<Bound> bounds;
    for (std::size_t j = 0; j < grid.Samples.size(); ++j)
    {
      const Vector other = normals.row(j).transpose();
      const Vector y = (places.row(j) - places.row(k)).transpose();
      const Vector model = grid.Samples[j].place - grid.Samples[k].place;
      if (other.dot(n) >= -0.55)
      {
        continue;
      }
      if (y.norm() > 1e-6 && y.squaredNorm() < -2.0 * y.dot(n) &&
        y.squaredNorm() < 2.0 * y.dot(other))
      {
        const double angle = std::acos(std::min(1.0, -y.dot(n) / y.norm()));
        const double azimuth = std::atan2(y.dot(n.cross(e)), y.dot(e));
        bounds.push_back({ y.norm() / (2.0 * std::cos(angle)), angle <= cone, azimuth,
          angle <= cone ? 0.0 : std::asin(std::sin(cone) / std::sin(angle)) });
      }
      else if (y.norm() < grid.Spacing / 4.0 && model.norm() < 0.75 * grid.Spacing &&
        model.dot(n) < 0.0 && model.dot(other) > 0.0)
      {
        bounds.push_back({ y.norm() / 2.0, true, 0.0, 0.0 });
      }
    }
    std::sort(bounds.begin(), bounds.end(),
      [](const Bound& a, const Bound& b) { return a.radius < b.radius; });
    std::vector<std::pair<double, double>> arcs;
    for (const Bound& bound : bounds)
    {
      arcs.emplace_back(bound.azimuth, bound.half);
      if (bound.alone || TurnOf(arcs) >= 6.0 * cone)
      {
        return std::max(0.002, bound.radius);
      }
    }
    return 0.0;
  }

  /// rho at the points.
  Eigen::VectorXd ThicknessAtPoints(const Base& base, double radius) const
  {
    std::vector<double> known;
    for (Eigen::Index k = 0; k < base.thickness.rows(); ++k)
    {
      if (base.thickness(k) > 0.0)
      {
        known.push_back(base.thickness(k));
      }
    }
    if (known.empty())
    {
      return Eigen::VectorXd::Constant(this->Count(), radius);
    }
    std::sort(known.begin(), known.end());
    const double most = known[static_cast<std::size_t>(0.98 * (known.size() - 1.0))];
    const double largest = std::max(0.002, std::min(radius, most));
    Matrix answers = Matrix::Zero(base.thickness.rows(), 2);
    for (Eigen::Index k = 0; k < base.thickness.rows(); ++k)
    {
      if (base.thickness(k) > 0.0)
      {
        answers(k, 0) = 1.0;
        answers(k, 1) = std::log(std::min(largest, base.thickness(k)));
      }
    }
    const Matrix smooth = this->Limbs->AtPoints(this->Limbs->Solve(answers), this->P);
    Eigen::VectorXd rho(this->Count());
    for (int i = 0; i < this->Count(); ++i)
    {
      rho(i) = smooth(i, 0) > 0.01
        ? std::min(largest, std::max(0.002, std::exp(smooth(i, 1) / smooth(i, 0))))
        : radius;
    }
    return rho;
  }

  /// Points and triangles of each center.
  void MakeSpheres(const Points& B, const MethodOptions& o, int centers)
  {
    std::vector<int> parts(this->Count(), 0);
    for (int i = 0; i < this->Count() && !o.centerIds.empty(); ++i)
    {
      parts[i] = o.centerIds[i];
    }
    for (std::size_t i = 0; o.sphereOfFreePoints && i < o.fixedPoints.size(); ++i)
    {
      parts[o.fixedPoints[i]] = -1;
    }
    const bool whole = centers == 1 && (!o.sphereOfFreePoints || o.fixedPoints.empty());
    const Sphere custom = { (o.custom.center - this->Origin.transpose()) / this->Diagonal,
      o.custom.radius / this->Diagonal };
    this->Spheres.clear();
    for (int part = 0; part < centers; ++part)
    {
      std::vector<int> points, triangles;
      for (int i = 0; i < this->Count(); ++i)
      {
        if (parts[i] == part)
        {
          points.push_back(i);
        }
      }
      Vector apex = Vector::Zero();
      for (int f = 0; f < this->F().rows(); ++f)
      {
        const int a = parts[this->F()(f, 0)], b = parts[this->F()(f, 1)],
                  c = parts[this->F()(f, 2)];
        if ((b == c ? b : a) == part)
        {
          triangles.push_back(f);
          apex += RowOf(B, this->F()(f, 0)) + RowOf(B, this->F()(f, 1)) + RowOf(B, this->F()(f, 2));
        }
      }
      apex /= 3.0 * triangles.size();
      if (whole)
      {
        apex = B.colwise().mean().transpose();
      }
      this->Spheres.push_back(SphereOf(B, this->F(), points, triangles, apex, o, custom));
      if (o.centers.rows() > 0)
      {
        this->Spheres.back().center =
          ((o.centers.row(part) - this->Origin) / this->Diagonal).transpose();
      }
    }
  }

  Points Directions(const Base& base, const MethodOptions& o, const Sphere& sphere,
    const Eigen::VectorXd& rho) const
  {
    if (o.targets.rows() > 0)
    {
      return o.targets;
    }
    Points d = Points::Zero(this->Count(), 3);
    std::set<int> onCenter;
    const double diagonal = (base.B.colwise().maxCoeff() - base.B.colwise().minCoeff()).norm();
    for (int i = 0; i < this->Count(); ++i)
    {
      const Vector x = RowOf(base.B, i) - sphere.center;
      if (x.norm() > 1e-12 * diagonal)
      {
        d.row(i) = x.normalized().transpose();
      }
      else
      {
        onCenter.insert(i);
      }
    }
    const Points known = d;
    for (const int i : onCenter)
    {
      int others = 0;
      for (int f = 0; f < this->F().rows(); ++f)
      {
        for (int k = 0; k < 3; ++k)
        {
          if (this->F()(f, k) == i)
          {
            d.row(i) += known.row(this->F()(f, (k + 1) % 3)) + known.row(this->F()(f, (k + 2) % 3));
            others += 2;
          }
        }
      }
      d.row(i) /= std::max(1, others);
    }
    const Points& n = base.grid || o.normals.rows() == 0 ? base.normals : o.normals;
    Points t(this->Count(), 3);
    for (int i = 0; i < this->Count(); ++i)
    {
      const double a = o.normalBlends.size() > 0 ? o.normalBlends(i) : o.normalBlend;
      const double radius = o.normalRadius == NormalRadius::WholeModel ? sphere.radius : rho(i);
      t.row(i) = (1.0 - a) * d.row(i) + a * radius / sphere.radius * n.row(i);
    }
    return t;
  }

  const Joints& JointsOf(const MethodOptions& o, int centers)
  {
    Joints& joints = this->AllJoints[{ o.centerBlend, o.centerIds }];
    if (joints.grid)
    {
      return joints;
    }
    const double s = std::max(0.02, o.centerBlend);
    joints.grid = std::make_unique<DenseGrid>(this->P, this->F(), s);
    this->Margin = std::min(this->Margin, joints.grid->Margin);
    joints.shares = Matrix::Zero(this->Count(), centers);
    for (int i = 0; i < this->Count(); ++i)
    {
      joints.shares(i, o.centerIds[i]) = 1.0;
    }
    if (o.centerBlend > 0.0)
    {
      joints.grid->Factor(1.0, s * s, 0.0, {});
      joints.shares =
        joints.grid->AtPoints(joints.grid->SmoothTwice(joints.grid->Means(joints.shares)), this->P);
      for (int i = 0; i < this->Count(); ++i)
      {
        joints.shares.row(i) = joints.shares.row(i).cwiseMax(0.0);
        joints.shares.row(i) /= joints.shares.row(i).sum();
      }
    }
    joints.grid->Factor(1e-6, 1.0, 0.0, {});
    return joints;
  }

  Points Targets(const Base& base, const MethodOptions& o, int centers, const Eigen::VectorXd& rho)
  {
    if (centers == 1)
    {
      const Sphere& sphere = this->Spheres.front();
      this->T = this->Directions(base, o, sphere, rho);
      return (sphere.radius * this->T).rowwise() + sphere.center.transpose();
    }
    const Joints& joints = this->JointsOf(o, centers);
    const DenseGrid& grid = *joints.grid;
    Points targets = Points::Zero(this->Count(), 3);
    this->T = Points::Zero(this->Count(), 3);
    Matrix disagreement = Matrix::Zero(grid.Samples.size(), 9); // integrals of sum T_k grad omega_k
    for (int part = 0; part < centers; ++part)
    {
      const Sphere& sphere = this->Spheres[part];
      const Points t = this->Directions(base, o, sphere, rho);
      const Points target = (sphere.radius * t).rowwise() + sphere.center.transpose();
      this->T += joints.shares.col(part).asDiagonal() * t;
      targets += joints.shares.col(part).asDiagonal() * target;
      Points three = Points::Zero(this->Count(), 3);
      three.col(1) = joints.shares.col(part);
      const Matrix slopes = grid.Gradients(three);
      const Matrix means = grid.Means(target);
      for (std::size_t k = 0; k < grid.Samples.size(); ++k)
      {
        const Vector slope = slopes.row(k).segment(3, 3).transpose();
        for (int axis = 0; axis < 3; ++axis)
        {
          disagreement.row(k).segment(3 * axis, 3) +=
            grid.Samples[k].weight * means(k, axis) * slope.transpose();
        }
      }
    }
    const Matrix none = Matrix::Zero(grid.Samples.size(), 3);
    return targets + Points(grid.AtPoints(grid.Solve(none, -disagreement), this->P));
  }

  /// P' from B'.
  void Carry(const Base& base, const Points& moved)
  {
    this->LargestYield = 0.0;
    this->R.assign(this->Count(), Matrix3::Identity());
    this->Positions = moved;
    if (!base.grid)
    {
      return;
    }
    const DenseGrid& grid = *base.grid;
    const Matrix H = grid.Gradients(moved);
    Matrix S(grid.Samples.size(), 9);
    for (std::size_t k = 0; k < grid.Samples.size(); ++k)
    {
      const DenseGrid::Sample& sample = grid.Samples[k];
      const Vector before = Cofactors(MatrixOf(base.gradients, k)) * sample.areaVector;
      const Vector after = Cofactors(MatrixOf(H, k)) * sample.areaVector;
      Matrix3 covariance = MatrixOf(base.gradients, k) * MatrixOf(H, k).transpose();
      if (before.norm() * after.norm() > 0.0)
      {
        covariance +=
          before * after.transpose() / (sample.weight * std::sqrt(before.norm() * after.norm()));
      }
      PutMatrix(covariance, S, static_cast<Eigen::Index>(k));
    }
    const Matrix smooth = grid.SmoothTwice(S);
    const Matrix ofPoints = grid.AtPoints(smooth, this->P);
    for (int i = 0; i < this->Count(); ++i)
    {
      this->R[i] = RotationOf(MatrixOf(ofPoints, i));
      const Vector detail = RowOf(this->P, i) - RowOf(base.B, i);
      this->Positions.row(i) +=
        KeptShare(MatrixOf(ofPoints, i)) * (this->R[i] * detail).transpose();
    }
    this->Yield(grid, H, smooth, moved);
  }

  /// Where the carried surface is less than half as large as what it rides on, seen along the
  /// turned normal, details become smaller.
  void Yield(const DenseGrid& grid, const Matrix& H, const Matrix& smooth, const Points& moved)
  {
    const Matrix ofSamples = grid.AtSamples(smooth);
    const Matrix carried = grid.Gradients(this->Positions);
    double area = 0.0, areaOfBase = 0.0;
    for (const DenseGrid::Sample& sample : grid.Samples)
    {
      area += sample.areaVector.norm();
    }
    for (std::size_t k = 0; k < grid.Samples.size(); ++k)
    {
      areaOfBase += (Cofactors(MatrixOf(H, k)) * grid.Samples[k].areaVector).norm();
    }
    Matrix yields = Matrix::Zero(grid.Samples.size(), 1);
    for (std::size_t k = 0; k < grid.Samples.size(); ++k)
    {
      const Vector& N = grid.Samples[k].areaVector;
      const Vector turned = RotationOf(MatrixOf(ofSamples, k)) * N;
      const double ofBase = turned.dot(Cofactors(MatrixOf(H, k)) * N);
      const double ofAll = turned.dot(Cofactors(MatrixOf(carried, k)) * N);
      if (ofAll >= 0.5 * ofBase)
      {
        continue;
      }
      // The share of details to give up: all of them if the base itself faces backward and is the
      // better one. Else the x at which ofBase + (1 - x)(ofAll - ofBase) is half of ofBase, if the
      // base faces forward; between the two, what is linear from one to the other.
      double x = 1.0;
      if (ofBase >= 0.0)
      {
        x = (0.5 * ofBase - ofAll) / (ofBase - ofAll);
      }
      else if (ofAll > ofBase)
      {
        x = 2.0 * ofAll / ofBase - 1.0;
      }
      // None where nothing is as large as .2 of what is usual.
      const double little = 0.2 * areaOfBase / area * N.squaredNorm();
      const double forward = std::max(0.0, std::min(1.0, 1.0 + ofBase / little));
      const double missing = std::min(1.0, (0.5 * ofBase - ofAll) / little);
      yields(k, 0) = KeptShare(MatrixOf(ofSamples, k)) * forward * missing * x;
    }
    if (yields.maxCoeff() == 0.0)
    {
      return;
    }
    const Matrix first = grid.AtPoints(grid.Solve(yields), this->P);
    const Matrix second = grid.AtPoints(grid.Solve(yields.cwiseAbs2()), this->P);
    for (int i = 0; i < this->Count(); ++i)
    {
      const double x = std::max(0.0, std::min(1.0, second(i) / (std::max(0.0, first(i)) + 0.01)));
      this->LargestYield = std::max(this->LargestYield, x);
      this->Positions.row(i) = (1.0 - x) * this->Positions.row(i) + x * moved.row(i);
    }
  }

  /// Mean, size and ground.
  void Place(const MethodOptions& o)
  {
    this->SizeFactor = 1.0;
    const std::set<int> fixed(o.fixedPoints.begin(), o.fixedPoints.end());
    std::vector<int> members;
    for (int i = 0; i < this->Count(); ++i)
    {
      if (fixed.count(i) == 0)
      {
        members.push_back(i);
      }
    }
    Triangles inside(this->F().rows(), 3);
    int count = 0;
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(this->Count());
    for (int f = 0; f < this->F().rows(); ++f)
    {
      const auto corners = this->F().row(f);
      const double area =
        AreaOf(RowOf(this->P, corners(0)), RowOf(this->P, corners(1)), RowOf(this->P, corners(2)));
      int inRegion = 0;
      for (int k = 0; k < 3; ++k)
      {
        areas(corners(k)) += area / 3.0;
        inRegion += fixed.count(corners(k)) == 0 ? 1 : 0;
      }
      if (inRegion == 3)
      {
        inside.row(count++) = corners;
      }
    }
    inside.conservativeResize(count, 3);
    if (members.empty() || count == 0)
    {
      return;
    }
    const auto mean = [&](const Points& X)
    {
      Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
      double total = 0.0;
      for (const int i : members)
      {
        sum += areas(i) * X.row(i);
        total += areas(i);
      }
      return Eigen::RowVector3d(sum / total);
    };
    const int last = members.back();
    const Eigen::RowVector3d shift = o.anchor == Anchor::LastPoint
      ? Eigen::RowVector3d(this->P.row(last) - this->Positions.row(last))
      : Eigen::RowVector3d(mean(this->P) - mean(this->Positions));
    for (const int i : members)
    {
      this->Positions.row(i) += shift;
    }
    const auto range = [&](const Points& X)
    {
      double low = X.row(last).dot(o.size.up), high = low;
      for (const int i : members)
      {
        low = std::min(low, X.row(i).dot(o.size.up));
        high = std::max(high, X.row(i).dot(o.size.up));
      }
      return std::pair<double, double>(low, high);
    };
    switch (o.size.keep)
    {
      case KeepSize::Off:
        break;
      case KeepSize::Area:
        this->SizeFactor = std::sqrt(AreaOf(this->P, inside) / AreaOf(this->Positions, inside));
        break;
      case KeepSize::Volume:
        this->SizeFactor = std::cbrt(VolumeOf(this->P, inside, mean(this->P).transpose()) /
          VolumeOf(this->Positions, inside, mean(this->Positions).transpose()));
        break;
      case KeepSize::Extent:
        this->SizeFactor = (range(this->P).second - range(this->P).first) /
          (range(this->Positions).second - range(this->Positions).first);
        break;
    }
    const Eigen::RowVector3d middle = mean(this->Positions);
    for (const int i : members)
    {
      this->Positions.row(i) = middle + this->SizeFactor * (this->Positions.row(i) - middle);
    }
    if (o.size.keepOnGround)
    {
      const double rise = range(this->P).first - range(this->Positions).first;
      for (const int i : members)
      {
        this->Positions.row(i) += rise * o.size.up.transpose();
      }
    }
  }

  void Solve(const MethodOptions& o)
  {
    const int centers =
      o.centerIds.empty() ? 1 : 1 + *std::max_element(o.centerIds.begin(), o.centerIds.end());
    Base& base = this->BaseOf(o.detailSize);
    this->Functions = base.grid ? base.grid->Count() : 0;
    this->Walls = base.walls;
    this->MakeSpheres(base.B, o, centers);
    double radius = OfNothing;
    for (const Sphere& sphere : this->Spheres)
    {
      radius = std::max(radius, sphere.radius);
    }
    const Points targets = this->Targets(base, o, centers, this->ThicknessAtPoints(base, radius));
    Points moved(this->Count(), 3);
    for (int i = 0; i < this->Count(); ++i)
    {
      const double factor = o.roundnessFactors.size() > 0 ? o.roundnessFactors(i) : 1.0;
      const double mu = std::sqrt(3.0) * o.lambda * factor;
      moved.row(i) = (base.B.row(i) + mu * targets.row(i)) / (1.0 + mu);
    }
    this->Carry(base, moved);
    this->Place(o);
    this->Positions = (this->Diagonal * this->Positions).rowwise() + this->Origin;
    for (std::size_t i = 0; i < o.fixedPoints.size(); ++i)
    {
      this->Positions.row(o.fixedPoints[i]) = o.fixedPositions.row(i);
    }
    for (Sphere& sphere : this->Spheres)
    {
      sphere.center = this->Diagonal * sphere.center + this->Origin.transpose();
      sphere.radius *= this->Diagonal;
    }
  }
};

ClosedFormReference::ClosedFormReference(const TriangleMesh& mesh)
  : S(std::make_unique<State>(mesh))
{
}

ClosedFormReference::~ClosedFormReference() = default;

void ClosedFormReference::Solve(const MethodOptions& options)
{
  this->S->Solve(options);
}

const Points& ClosedFormReference::GetPositions() const
{
  return this->S->Positions;
}

const Points& ClosedFormReference::GetDirections() const
{
  return this->S->T;
}

const Matrices& ClosedFormReference::GetRotations() const
{
  return this->S->R;
}

const std::vector<Sphere>& ClosedFormReference::GetSpheres() const
{
  return this->S->Spheres;
}

double ClosedFormReference::GetSizeFactor() const
{
  return this->S->SizeFactor;
}

int ClosedFormReference::GetFunctions() const
{
  return this->S->Functions;
}

int ClosedFormReference::GetWalls() const
{
  return this->S->Walls;
}

double ClosedFormReference::GetYield() const
{
  return this->S->LargestYield;
}

double ClosedFormReference::GetMargin() const
{
  return this->S->Margin;
}
