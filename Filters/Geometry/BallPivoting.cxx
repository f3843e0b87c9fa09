// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BallPivoting.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace SphericalStyle
{
namespace
{
using Vector = Eigen::Vector3d;

// All lengths below are in units of the smallest radius.

/// Every point is moved by about this much. Points of a lattice, or of any circle, are then in
/// general position: whichever way the ball comes, it meets them in an order that agrees.
constexpr double Shift = 1e-7;
/// A point may be this much nearer than the radius and the ball still counts as empty: far below
/// the shift, far above rounding.
constexpr double Slack = 1e-10;
/// Nearer points are one point.
constexpr double SamePlace = 1e-4;
/// An angle this little below a full turn is rounding, and really 0.
constexpr double AngleSlack = 1e-7;
/// Radius below which rounding of the coordinates decides, as a fraction of the largest coordinate.
constexpr double SmallestRadius = 1e-11;
/// A seed is made of a point and two of its nearest this many.
constexpr std::size_t SeedNeighbors = 24;

/// Points by cells of a uniform grid.
class Grid
{
public:
  explicit Grid(double cellSize)
    : CellSize(cellSize)
  {
  }

  void Insert(int id, const Vector& point) { this->Cells[this->CellOf(point)].push_back(id); }

  /// All points of the cell of a place and the 26 around it: whatever is within one cell's size.
  void Around(const Vector& place, std::vector<int>& ids) const
  {
    ids.clear();
    const Cell middle = this->CellOf(place);
    for (int k = 0; k < 27; ++k)
    {
      const Cell cell = { middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1 };
      const auto found = this->Cells.find(cell);
      if (found != this->Cells.end())
      {
        ids.insert(ids.end(), found->second.begin(), found->second.end());
      }
    }
  }

private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash
  {
    std::size_t operator()(const Cell& cell) const
    {
      std::uint64_t h = 0;
      for (const std::int64_t c : cell)
      {
        h = (h ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15U;
        h ^= h >> 29U;
      }
      return h;
    }
  };

  Cell CellOf(const Vector& point) const
  {
    Cell cell;
    for (int k = 0; k < 3; ++k)
    {
      cell[k] = static_cast<std::int64_t>(std::floor(point[k] / this->CellSize));
    }
    return cell;
  }

  double CellSize;
  std::unordered_map<Cell, std::vector<int>, Hash> Cells;
};

/// The triangles so far. Joining and gluing of fronts needs no steps of its own: an edge is on a
/// front as long as its triangle has no neighbor in the opposite direction.
class Surface
{
public:
  explicit Surface(std::size_t n)
    : Fans(n)
    , Closed(n, false)
  {
  }

  /// Third corner of the triangle that has the edge in this direction, -1 if none has.
  int Apex(int from, int to) const
  {
    for (const Spoke& spoke : this->Fans[from])
    {
      if (spoke.to == to)
      {
        return spoke.apex;
      }
    }
    return -1;
  }

  bool IsUsed(int point) const { return !this->Fans[point].empty(); }

  /// Whether no edge would be used twice in one direction, and no point get a second closed fan.
  bool CanAdd(int a, int b, int c) const
  {
    return this->CanAddCorner(a, b, c) && this->CanAddCorner(b, c, a) &&
      this->CanAddCorner(c, a, b);
  }

  void Add(int a, int b, int c)
  {
    this->All.push_back({ a, b, c });
    this->AddCorner(a, b, c);
    this->AddCorner(b, c, a);
    this->AddCorner(c, a, b);
  }

  Triangles ToTriangles() const
  {
    Triangles F(static_cast<Eigen::Index>(this->All.size()), 3);
    for (std::size_t f = 0; f < this->All.size(); ++f)
    {
      F.row(static_cast<Eigen::Index>(f)) << this->All[f][0], this->All[f][1], this->All[f][2];
    }
    return F;
  }

private:
  /// A triangle at a point: the corner after the point, and the corner before it.
  struct Spoke
  {
    int to;
    int apex;
  };

  /// Triangles of the fan from spoke `from` on, until a border or spoke `last`.
  /// @return their number and whether `last` was met
  std::pair<std::size_t, bool> Walk(int point, int from, int last) const
  {
    std::size_t count = 0;
    while (from != last && from >= 0)
    {
      from = this->Apex(point, from);
      ++count;
    }
    return { count, from == last };
  }

  bool CanAddCorner(int a, int b, int c) const
  {
    if (this->Closed[a] || this->Apex(a, b) >= 0)
    {
      return false;
    }
    const auto [count, closes] = this->Walk(a, c, b);
    // Two triangles around a point lie on each other; a fan beside a closed one is not a manifold.
    return !closes || (count >= 2 && count == this->Fans[a].size());
  }

  void AddCorner(int a, int b, int c)
  {
    this->Closed[a] = this->Walk(a, c, b).second;
    this->Fans[a].push_back({ b, c });
  }

  std::vector<std::vector<Spoke>> Fans;
  std::vector<bool> Closed;
  std::vector<std::array<int, 3>> All;
};

class Pivoting
{
public:
  Pivoting(std::vector<Vector> points, std::vector<Vector> normals)
    : P(std::move(points))
    , Normals(std::move(normals))
    , Mesh(this->P.size())
  {
  }

  void Roll(double radius);
  const Surface& GetMesh() const { return this->Mesh; }

private:
  /// Edge of a triangle that still lacks its neighbor, in the direction of the triangle, and the
  /// center of the ball that lies on the triangle.
  struct Edge
  {
    int from;
    int to;
    Vector center;
  };
  struct Hit
  {
    double angle;
    int id;
    bool operator<(const Hit& other) const
    {
      return std::tie(this->angle, this->id) < std::tie(other.angle, other.id);
    }
  };

  void FindNear(const Vector& place);
  bool IsEmpty(const Vector& center, int a, int b, int c) const;
  std::optional<Vector> BallOn(int a, int b, int c) const;
  Vector NormalOf(int a, int b, int c) const;
  bool AgreesAtOne(int a, int b, int c) const;
  bool AgreesAtAll(int a, int b, int c) const;

  void Add(int a, int b, int c, const Vector& center);
  void ResumeBorder();
  void RollFront();
  bool Pivot(const Edge& edge);
  bool Seed(int point);
  bool TrySeed(int a, int b, int c);

  std::vector<Vector> P;
  std::vector<Vector> Normals;
  Surface Mesh;
  double Radius = 0.0;
  std::optional<Grid> Cells;
  std::deque<Edge> Front;
  std::vector<Edge> Border; ///< edges that no ball got over
  std::vector<int> Near;    ///< points within two radii of where the ball is
  std::vector<int> Found;
  std::vector<Hit> Hits;
};

void Pivoting::FindNear(const Vector& place)
{
  this->Cells->Around(place, this->Found);
  this->Near.clear();
  const double reach = 4.0 * this->Radius * this->Radius * (1.0 + Slack);
  for (const int id : this->Found)
  {
    if ((this->P[id] - place).squaredNorm() <= reach)
    {
      this->Near.push_back(id);
    }
  }
}

bool Pivoting::IsEmpty(const Vector& center, int a, int b, int c) const
{
  const double inner = this->Radius * this->Radius * (1.0 - 2.0 * Slack);
  return std::none_of(this->Near.begin(), this->Near.end(),
    [&](int id)
    { return id != a && id != b && id != c && (this->P[id] - center).squaredNorm() < inner; });
}

/// Center of the ball that touches the corners from the side that sees them counterclockwise.
std::optional<Vector> Pivoting::BallOn(int a, int b, int c) const
{
  const Vector u = this->P[b] - this->P[a];
  const Vector v = this->P[c] - this->P[a];
  const Vector n = u.cross(v);
  const double nn = n.squaredNorm();
  if (!(nn > 0.0))
  {
    return std::nullopt;
  }
  const Vector toCenter =
    (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2.0 * nn);
  const double height = this->Radius * this->Radius - toCenter.squaredNorm();
  if (!(height >= 0.0))
  {
    return std::nullopt;
  }
  return this->P[a] + toCenter + std::sqrt(height / nn) * n;
}

Vector Pivoting::NormalOf(int a, int b, int c) const
{
  return (this->P[b] - this->P[a]).cross(this->P[c] - this->P[a]);
}

/// A ball that has come round to the back of an open surface finds no normal on its side. At a
/// sharp edge two of three normals may well point away from a ball that is outside.
bool Pivoting::AgreesAtOne(int a, int b, int c) const
{
  const Vector n = this->NormalOf(a, b, c);
  return n.dot(this->Normals[a]) > 0.0 || n.dot(this->Normals[b]) > 0.0 ||
    n.dot(this->Normals[c]) > 0.0;
}

bool Pivoting::AgreesAtAll(int a, int b, int c) const
{
  const Vector n = this->NormalOf(a, b, c);
  return n.dot(this->Normals[a]) > 0.0 && n.dot(this->Normals[b]) > 0.0 &&
    n.dot(this->Normals[c]) > 0.0;
}

void Pivoting::Add(int a, int b, int c, const Vector& center)
{
  this->Mesh.Add(a, b, c);
  for (const auto& [from, to] : { std::pair(a, b), std::pair(b, c), std::pair(c, a) })
  {
    if (this->Mesh.Apex(to, from) < 0)
    {
      this->Front.push_back({ from, to, center });
    }
  }
}

/// Puts a ball of the new radius on the triangles at the border, where there is room for it.
void Pivoting::ResumeBorder()
{
  std::vector<Edge> stays;
  for (Edge& edge : this->Border)
  {
    if (this->Mesh.Apex(edge.to, edge.from) >= 0)
    {
      continue; // another edge's ball has closed it
    }
    const int apex = this->Mesh.Apex(edge.from, edge.to);
    const std::optional<Vector> center = this->BallOn(edge.from, edge.to, apex);
    this->FindNear(this->P[edge.from]);
    if (center && this->IsEmpty(*center, edge.from, edge.to, apex))
    {
      edge.center = *center;
      this->Front.push_back(edge);
    }
    else
    {
      stays.push_back(edge);
    }
  }
  this->Border = std::move(stays);
}

void Pivoting::RollFront()
{
  while (!this->Front.empty())
  {
    const Edge edge = this->Front.front();
    this->Front.pop_front();
    if (this->Mesh.Apex(edge.to, edge.from) < 0 && !this->Pivot(edge))
    {
      this->Border.push_back(edge);
    }
  }
}

/// Turns the ball around the edge, away from its triangle, to the first point it meets.
bool Pivoting::Pivot(const Edge& edge)
{
  const int i = edge.from;
  const int j = edge.to;
  const Vector middle = 0.5 * (this->P[i] + this->P[j]);
  const Vector axis = (this->P[j] - this->P[i]).normalized();
  // The center moves on a circle around the middle: start + angle 0 at u, a quarter turn on at v.
  const double quarter = 0.25 * (this->P[j] - this->P[i]).squaredNorm();
  const double rho = std::sqrt(std::max(0.0, this->Radius * this->Radius - quarter));
  const Vector start = edge.center - middle;
  const Vector u = (start - axis.dot(start) * axis).normalized();
  const Vector v = axis.cross(u);
  if (!(rho > SamePlace * this->Radius))
  {
    return false; // the ball hangs between the two points and has nowhere to turn
  }
  this->FindNear(middle);
  const int apex = this->Mesh.Apex(i, j);
  this->Hits.clear();
  for (const int k : this->Near)
  {
    // Where the circle enters the ball around k: |middle + rho (u cos + v sin) - k| = radius.
    const Vector d = this->P[k] - middle;
    const double x = d.dot(u);
    const double y = d.dot(v);
    const double along = (rho * rho + d.squaredNorm() - this->Radius * this->Radius) / (2.0 * rho);
    const double across = std::hypot(x, y);
    if (k == i || k == j || k == apex || !(std::abs(along) <= across))
    {
      continue;
    }
    double angle = std::atan2(y, x) - std::acos(along / across);
    angle -= 2.0 * Pi * std::floor((angle + AngleSlack) / (2.0 * Pi));
    this->Hits.push_back({ angle, k });
  }
  // Only the first can leave the ball empty, but for points that are met at once.
  std::sort(this->Hits.begin(), this->Hits.end());
  return std::any_of(this->Hits.begin(), this->Hits.end(),
    [&](const Hit& hit)
    {
      const Vector center = middle + rho * (std::cos(hit.angle) * u + std::sin(hit.angle) * v);
      const bool fits = this->Mesh.CanAdd(j, i, hit.id) && this->AgreesAtOne(j, i, hit.id) &&
        this->IsEmpty(center, i, j, hit.id);
      if (fits)
      {
        this->Add(j, i, hit.id, center);
      }
      return fits;
    });
}

bool Pivoting::TrySeed(int a, int b, int c)
{
  if (this->NormalOf(a, b, c).dot(this->Normals[a]) < 0.0)
  {
    std::swap(b, c);
  }
  if (!this->AgreesAtAll(a, b, c) || !this->Mesh.CanAdd(a, b, c))
  {
    return false;
  }
  const std::optional<Vector> center = this->BallOn(a, b, c);
  if (!center || !this->IsEmpty(*center, a, b, c))
  {
    return false;
  }
  this->Add(a, b, c, *center);
  return true;
}

/// Starts a surface at a point that no triangle uses.
bool Pivoting::Seed(int point)
{
  this->FindNear(this->P[point]);
  std::vector<std::pair<double, int>> nearest;
  for (const int id : this->Near)
  {
    if (id != point)
    {
      nearest.emplace_back((this->P[id] - this->P[point]).squaredNorm(), id);
    }
  }
  const std::size_t count = std::min(nearest.size(), SeedNeighbors);
  std::partial_sort(
    nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count), nearest.end());
  for (std::size_t second = 1; second < count; ++second)
  {
    for (std::size_t first = 0; first < second; ++first)
    {
      if (this->TrySeed(point, nearest[first].second, nearest[second].second))
      {
        return true;
      }
    }
  }
  return false;
}

void Pivoting::Roll(double radius)
{
  this->Radius = radius;
  this->Cells.emplace(2.0 * radius * (1.0 + Slack));
  const int n = static_cast<int>(this->P.size());
  for (int i = 0; i < n; ++i)
  {
    this->Cells->Insert(i, this->P[i]);
  }
  this->ResumeBorder();
  this->RollFront();
  for (int i = 0; i < n; ++i)
  {
    if (!this->Mesh.IsUsed(i) && this->Seed(i))
    {
      this->RollFront();
    }
  }
}

/// A number in [-1, 1] that depends on i alone (splitmix64).
double Noise(std::uint64_t i)
{
  i = (i + 1U) * 0x9e3779b97f4a7c15U;
  i = (i ^ (i >> 30U)) * 0xbf58476d1ce4e5b9U;
  i = (i ^ (i >> 27U)) * 0x94d049bb133111ebU;
  i ^= i >> 31U;
  return static_cast<double>(i >> 11U) * 0x1p-52 - 1.0;
}

/// Points around the origin in units of the length.
Points InUnits(const Points& P, double length)
{
  const double largest = P.cwiseAbs().maxCoeff();
  if (!(largest > 0.0))
  {
    return P;
  }
  const Points unit = P / largest; // first: differences of huge numbers overflow
  const Eigen::RowVector3d middle = 0.5 * (unit.colwise().minCoeff() + unit.colwise().maxCoeff());
  return (unit.rowwise() - middle) / (length / largest);
}

/// The first of every place.
std::vector<int> WithoutDuplicates(const Points& P)
{
  Grid grid(SamePlace);
  std::vector<int> kept;
  std::vector<int> near;
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    const Vector p = P.row(i);
    grid.Around(p, near);
    if (std::none_of(near.begin(), near.end(),
          [&](int other) { return (P.row(other).transpose() - p).norm() < SamePlace; }))
    {
      const int id = static_cast<int>(i);
      grid.Insert(id, p);
      kept.push_back(id);
    }
  }
  return kept;
}

void CheckArguments(const Points& P, const Points& normals, const std::vector<double>& radii)
{
  if (P.rows() != normals.rows())
  {
    throw std::invalid_argument("ball pivoting needs one normal a point");
  }
  double last = 0.0;
  for (const double radius : radii)
  {
    if (!(radius > last) || !std::isfinite(radius))
    {
      throw std::invalid_argument("the radii of ball pivoting must be above 0 and ascend");
    }
    last = radius;
  }
}
} // namespace

Triangles BallPivoting(const Points& P, const Points& normals, const std::vector<double>& radii)
{
  CheckArguments(P, normals, radii);
  if (P.rows() < 3 || radii.empty() || radii.front() < SmallestRadius * P.cwiseAbs().maxCoeff())
  {
    return {};
  }
  const Points unit = InUnits(P, radii.front());
  const std::vector<int> kept = WithoutDuplicates(unit);
  std::vector<Vector> points;
  std::vector<Vector> directions;
  for (const int i : kept)
  {
    const auto k = static_cast<std::uint64_t>(i) * 3U;
    const Vector noise(Noise(k), Noise(k + 1U), Noise(k + 2U));
    points.emplace_back(unit.row(i).transpose() + Shift * noise);
    directions.emplace_back(normals.row(i).stableNormalized());
  }
  Pivoting pivoting(std::move(points), std::move(directions));
  for (const double radius : radii)
  {
    pivoting.Roll(radius / radii.front());
  }
  Triangles F = pivoting.GetMesh().ToTriangles();
  for (int& corner : F.reshaped())
  {
    corner = kept[corner];
  }
  return F;
}
} // namespace SphericalStyle
