// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceGrid.h"

#include "Parallel.h"
#include "Vector4.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

namespace SphericalStyle
{
namespace
{
constexpr int Near = 27; // functions at a place
constexpr int SubCells =
  3; // along an axis; odd, so that the middle of the bounds lies inside of one
constexpr int SubCellsOfCell = 27;
constexpr double LongestPart = 0.75; // of the spacing
constexpr double LongestWhole = 1.0 / 6.0;
constexpr double CentroidShare = 0.75;         // of the area; the corners have the rest
constexpr double Ridge = 1e-7;                 // of the mean diagonal
constexpr double Across = 0.1;                 // of N, the slope across the surface
constexpr double PoissonMass = 1e-6;           // holds the constant, which has no gradient
constexpr int MostCutsToSearch = 4;            // of an edge: beyond, parts of a triangle are hashed
constexpr std::size_t MostCutParts = 10000000; // 400 MB; 18 sheets with as many as there may be
constexpr int TrianglesOfTask = 1 << 15;
constexpr int CellsOfTask = 64;
constexpr int PointsOfPacket = 4096;
/// What is known of a sub-cell: its number among all, area w, then the sums of w x, w n, w (I - n
/// n^T) and w x x^T over what lies in it; of symmetric matrices xx, xy, xz, yy, yz, zz.
constexpr int NumbersOfSample = 20;
using SampleSums = std::array<double, NumbersOfSample>;
constexpr int Outside = -1;

/// Weights of the three functions along an axis at t in 0..1 of a cell.
SPHERICALSTYLE_INLINE void Spline(double t, double* w)
{
  w[0] = 0.5 * (1.0 - t) * (1.0 - t);
  w[1] = 0.75 - (t - 0.5) * (t - 0.5);
  w[2] = 0.5 * t * t;
}

/// Their derivatives, by t.
SPHERICALSTYLE_INLINE void SplineSlope(double t, double* w)
{
  w[0] = t - 1.0;
  w[1] = 1.0 - 2.0 * t;
  w[2] = t;
}

/// Products of the weights along the axes: function x + 3 y + 9 z.
SPHERICALSTYLE_INLINE void Products(const double* x, const double* y, const double* z, double* phi)
{
  for (int k = 0; k < 3; ++k)
  {
    for (int j = 0; j < 3; ++j)
    {
      const double yz = y[j] * z[k];
      for (int i = 0; i < 3; ++i)
      {
        phi[9 * k + 3 * j + i] = x[i] * yz;
      }
    }
  }
}

/// A function and its gradient at each of the 27, in units of a cell.
struct LocalFunctions
{
  double phi[Near];
  double gradient[3][Near];

  explicit LocalFunctions(const Eigen::Vector3d& t)
  {
    double w[3][3];
    double slope[3][3];
    for (int axis = 0; axis < 3; ++axis)
    {
      Spline(t(axis), w[axis]);
      SplineSlope(t(axis), slope[axis]);
    }
    Products(w[0], w[1], w[2], this->phi);
    Products(slope[0], w[1], w[2], this->gradient[0]);
    Products(w[0], slope[1], w[2], this->gradient[1]);
    Products(w[0], w[1], slope[2], this->gradient[2]);
  }
};

/// sum over 27 functions of phi times rows of c, Blocks times four numbers each.
template <int Blocks>
SPHERICALSTYLE_INLINE void SumRows(
  const double* phi, const int* functions, const double* c, Vector4* sum)
{
  for (int b = 0; b < Blocks; ++b)
  {
    sum[b] = Vector4{};
  }
  for (int g = 0; g < Near; ++g)
  {
    const double* row = c + static_cast<std::ptrdiff_t>(functions[g]) * 4 * Blocks;
    for (int b = 0; b < Blocks; ++b)
    {
      sum[b] += phi[g] * Load4(row + 4 * b);
    }
  }
}

/// @param t  places in their cells, 3 each @param functions  of these cells
template <int Blocks>
SPHERICALSTYLE_INLINE void EvaluateRows(const double* t, const int* const* functions, int count,
  const double* c, int columns, double* result)
{
  for (int i = 0; i < count; ++i)
  {
    double* row = result + static_cast<std::ptrdiff_t>(i) * columns;
    if (!functions[i])
    {
      std::fill_n(row, columns, 0.0);
      continue;
    }
    double w[3][3];
    double phi[Near];
    for (int axis = 0; axis < 3; ++axis)
    {
      Spline(t[3 * i + axis], w[axis]);
    }
    Products(w[0], w[1], w[2], phi);
    Vector4 sum[Blocks];
    SumRows<Blocks>(phi, functions[i], c, sum);
    for (int k = 0; k < columns; ++k)
    {
      row[k] = sum[k / 4][k % 4];
    }
  }
}

SPHERICALSTYLE_PER_INSTRUCTION_SET
void Evaluate4(const double* t, const int* const* functions, int count, const double* c,
  int columns, double* result)
{
  EvaluateRows<1>(t, functions, count, c, columns, result);
}

SPHERICALSTYLE_PER_INSTRUCTION_SET
void Evaluate12(const double* t, const int* const* functions, int count, const double* c,
  int columns, double* result)
{
  EvaluateRows<3>(t, functions, count, c, columns, result);
}

/// block += u u^T for the lower triangle of a 28 x 28 block, four vectors u at once.
SPHERICALSTYLE_PER_INSTRUCTION_SET
void AddOuterProducts(const double* u, double* block)
{
  constexpr int Width = 28;
  for (int i = 0; i < Near; ++i)
  {
    for (int j = 0; j < Width; j += 4)
    {
      if (j > i)
      {
        break;
      }
      Vector4 sum = Load4(block + Width * i + j);
      for (int k = 0; k < 4; ++k)
      {
        sum += u[Width * k + i] * Load4(u + Width * k + j);
      }
      Store4(block + Width * i + j, sum);
    }
  }
}

using Block = std::array<double, 28 * 28>;

/// Shifts by up to two cells along each axis, in the order of the functions; those that lead to a
/// function with a larger number, and 0, are Half + 0, 1, ...
constexpr int Shifts = 125;
constexpr int HalfOfShifts = 62;

int ShiftOf(int a, int b)
{
  return (b % 3 - a % 3 + 2) + 5 * (b / 3 % 3 - a / 3 % 3 + 2) + 25 * (b / 9 - a / 9 + 2);
}
}

struct SurfaceGrid::Place
{
  std::array<int, 3> cell; // of the box
  Eigen::Vector3d t;       // 0..1 in it
};

inline SurfaceGrid::Place SurfaceGrid::Locate(const Eigen::RowVector3d& x) const
{
  Place place;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double at = x(axis) * this->PerSpacing + 0.5 + this->Half[axis];
    const int cell = std::clamp(static_cast<int>(at), 0, 2 * this->Half[axis]);
    place.cell[axis] = cell;
    place.t(axis) = at - cell;
  }
  return place;
}

namespace
{
/// Of 27, from the place in a cell.
int SubCellOf(const Eigen::Vector3d& t)
{
  int sub = 0;
  for (int axis = 2; axis >= 0; --axis)
  {
    sub = SubCells * sub + std::clamp(static_cast<int>(SubCells * t(axis)), 0, SubCells - 1);
  }
  return sub;
}

int BoxIndex(const std::array<int, 3>& half, const std::array<int, 3>& cell)
{
  return cell[0] + (2 * half[0] + 1) * (cell[1] + (2 * half[1] + 1) * cell[2]);
}
}

const int* SurfaceGrid::FunctionsAt(const Place& place) const
{
  const int cell = this->CellOfBox[BoxIndex(this->Half, place.cell)];
  return cell == Outside ? nullptr
                         : this->Functions.data() + static_cast<std::ptrdiff_t>(Near) * cell;
}

//------------------------------------------------------------------------------------------------
/// Cuts triangles into what lies in each sub-cell, and adds that up.
class SurfaceGrid::Splatter
{
public:
  Splatter(SurfaceGrid& grid, const Points& p, const Triangles& f, int threads)
    : Grid(grid)
    , P(p)
    , F(f)
    , Threads(threads)
  {
  }

  /// @return the active cells of the box, ascending, or nothing where there would be too many parts
  std::optional<std::vector<int>> Cut();
  void Sum(const std::vector<int>& cells);

private:
  /// What of a triangle lies in a sub-cell.
  struct Part
  {
    int box;
    int triangle;
    int subCell;
    int shares; // where they are, or -1 for a third of all for each corner
  };
  struct Parts
  {
    std::vector<Part> parts;
    std::vector<Eigen::Vector3d>
      shares; // of the area, for each corner; they sum to the part's share
  };
  struct Samples;

  std::vector<std::size_t> Merge(std::vector<SampleSums>& sums) const;
  void TakeSums(const std::vector<SampleSums>& sums, std::size_t cells);
  void Cut(int triangle, Parts& parts);
  void CutEvenly(int triangle, int n, Parts& parts);
  bool AreTooMany() const { return this->NumberOfCutParts > MostCutParts; }
  /// @param cell  number among the active ones
  void SumCell(int cell, const Part* begin, const Part* end, Samples& samples) const;
  /// @param number  of the sub-cell among those of all active cells
  void SumSubCell(double number, const Part* begin, const Part* end, Samples& samples) const;
  /// Where each sample is in its cell.
  void PlaceInCells(const std::vector<int>& cells);

  SurfaceGrid& Grid;
  const Points& P;
  const Triangles& F;
  int Threads;
  std::vector<Parts> Tasks;
  /// Of cut triangles, by all tasks. Once they are too many, nothing more is cut.
  std::atomic<std::size_t> NumberOfCutParts{ 0 };
};

struct SurfaceGrid::Splatter::Samples
{
  std::vector<SampleSums> sums;
  std::vector<int> entryCounts;
  std::vector<int> points;
  std::vector<double> entries;
  // While a sub-cell is added up: where its points are, by their hash.
  std::vector<int> slots;
  std::vector<Part> sorted;
};

void SurfaceGrid::Splatter::CutEvenly(int triangle, int n, Parts& parts)
{
  const std::size_t first = parts.parts.size();
  std::unordered_map<std::int64_t, std::size_t> numbers; // of its parts, where they are many
  const auto partAt = [&](int box, int subCell) -> const Part&
  {
    std::size_t number = first;
    if (n > MostCutsToSearch)
    {
      const std::int64_t key = static_cast<std::int64_t>(box) * SubCellsOfCell + subCell;
      number = numbers.insert({ key, parts.parts.size() }).first->second;
    }
    while (number < parts.parts.size() &&
      (parts.parts[number].box != box || parts.parts[number].subCell != subCell))
    {
      ++number;
    }
    if (number == parts.parts.size())
    {
      parts.parts.push_back({ box, triangle, subCell, static_cast<int>(parts.shares.size()) });
      parts.shares.emplace_back(Eigen::Vector3d::Zero());
    }
    return parts.parts[number];
  };
  const Eigen::Matrix3d corners = this->P(this->F.row(triangle), AllColumns).transpose();
  const double area = 1.0 / (static_cast<double>(n) * n);
  const auto add = [&](const Eigen::Vector3d& barycentric, double share)
  {
    const Place place = this->Grid.Locate((corners * barycentric).transpose());
    const Part& part = partAt(BoxIndex(this->Grid.Half, place.cell), SubCellOf(place.t));
    parts.shares[part.shares] += share * area * barycentric;
  };
  const auto addTriangle = [&](const Eigen::Vector3i& row, const Eigen::Vector3i& column)
  {
    Eigen::Matrix3d barycentric;
    for (int k = 0; k < 3; ++k)
    {
      barycentric.col(k) << n - row(k), row(k) - column(k), column(k);
    }
    barycentric /= n;
    add(barycentric.rowwise().mean(), CentroidShare);
    for (int k = 0; k < 3; ++k)
    {
      add(barycentric.col(k), (1.0 - CentroidShare) / 3.0);
    }
  };
  std::size_t counted = parts.shares.size();
  for (int row = 0; row < n && !this->AreTooMany(); ++row)
  {
    for (int column = 0; column <= row; ++column)
    {
      addTriangle({ row, row + 1, row + 1 }, { column, column, column + 1 });
      if (column < row)
      {
        addTriangle({ row, row + 1, row }, { column, column + 1, column + 1 });
      }
    }
    // A triangle with so many lies in more cells than there may be, each with functions.
    const bool isAlone = parts.parts.size() - first > SubCellsOfCell * MaximumNumberOfFunctions;
    this->NumberOfCutParts += isAlone ? MostCutParts + 1 : parts.shares.size() - counted;
    counted = parts.shares.size();
  }
}

void SurfaceGrid::Splatter::Cut(int triangle, Parts& parts)
{
  const auto corners = this->F.row(triangle);
  const Eigen::RowVector3d a = this->P.row(corners(0));
  const Eigen::RowVector3d b = this->P.row(corners(1));
  const Eigen::RowVector3d c = this->P.row(corners(2));
  const double longest =
    std::sqrt(std::max({ (a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm() }));
  const double spacing = this->Grid.Spacing;
  if (longest <= LongestWhole * spacing)
  {
    const Place place = this->Grid.Locate((a + b + c) / 3.0);
    const auto isHere = [&](const Eigen::RowVector3d& x)
    { return this->Grid.Locate(x).cell == place.cell; };
    if (isHere(a) && isHere(b) && isHere(c))
    {
      parts.parts.push_back(
        { BoxIndex(this->Grid.Half, place.cell), triangle, SubCellOf(place.t), -1 });
      return;
    }
  }
  this->CutEvenly(
    triangle, std::max(1, static_cast<int>(std::ceil(longest / (LongestPart * spacing)))), parts);
}

std::optional<std::vector<int>> SurfaceGrid::Splatter::Cut()
{
  const int m = static_cast<int>(this->F.rows());
  this->Tasks.assign((m + TrianglesOfTask - 1) / TrianglesOfTask, {});
  ParallelTasks(static_cast<int>(this->Tasks.size()), this->Threads,
    [&](int task)
    {
      Parts& parts = this->Tasks[task];
      const int end = std::min(m, (task + 1) * TrianglesOfTask);
      parts.parts.reserve(static_cast<std::size_t>(end - task * TrianglesOfTask) * 5 / 4);
      for (int f = task * TrianglesOfTask; f < end; ++f)
      {
        this->Cut(f, parts);
      }
    });
  // Whoever stops early has too many already, so the answer is that for all triangles.
  if (this->Grid.Everybody.Sum(static_cast<double>(this->NumberOfCutParts)) >
    static_cast<double>(MostCutParts))
  {
    return std::nullopt;
  }
  std::vector<char> touched(this->Grid.CellOfBox.size(), 0);
  for (const Parts& parts : this->Tasks)
  {
    for (const Part& part : parts.parts)
    {
      touched[part.box] = 1;
    }
  }
  std::vector<double> own;
  for (std::size_t box = 0; box < touched.size(); ++box)
  {
    if (touched[box])
    {
      own.push_back(static_cast<double>(box));
    }
  }
  std::vector<double> all = this->Grid.Everybody.Concatenate(own);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return std::vector<int>(all.begin(), all.end());
}

void SurfaceGrid::Splatter::SumSubCell(
  double number, const Part* begin, const Part* end, Samples& samples) const
{
  double weight = 0.0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector3d areaVector = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  std::array<double, 6> tangent = {};
  const std::size_t first = samples.points.size();
  std::size_t size = 16;
  while (size < 6 * static_cast<std::size_t>(end - begin))
  {
    size *= 2;
  }
  samples.slots.assign(size, Outside);
  const auto entryOf = [&](int point)
  {
    std::size_t slot = (static_cast<std::uint32_t>(point) * 2654435769U) & (size - 1);
    while (samples.slots[slot] != Outside && samples.points[samples.slots[slot]] != point)
    {
      slot = (slot + 1) & (size - 1);
    }
    if (samples.slots[slot] == Outside)
    {
      samples.slots[slot] = static_cast<int>(samples.points.size());
      samples.points.push_back(point);
      samples.entries.insert(samples.entries.end(), 4, 0.0);
    }
    return samples.entries.data() + 4 * static_cast<std::size_t>(samples.slots[slot]);
  };
  for (const Part* part = begin; part != end; ++part)
  {
    const auto corners = this->F.row(part->triangle);
    const Eigen::Matrix3d x = this->P(corners, AllColumns).transpose();
    const Eigen::Vector3d doubled = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0));
    const double length = doubled.norm();
    if (!(length > 0.0))
    {
      continue;
    }
    const Eigen::Vector3d n = doubled / length;
    const std::size_t task = static_cast<std::size_t>(part->triangle) / TrianglesOfTask;
    const Eigen::Vector3d shares = part->shares < 0 ? Eigen::Vector3d::Constant(1.0 / 3.0).eval()
                                                    : this->Tasks[task].shares[part->shares];
    const double share = shares.sum();
    const double area = 0.5 * length * share;
    const Eigen::Vector3d middle = x * shares * (0.5 * length);
    weight += area;
    place += middle;
    square += middle * middle.transpose() / area;
    areaVector += area * n;
    tangent[0] += area * (1.0 - n(0) * n(0));
    tangent[1] -= area * n(0) * n(1);
    tangent[2] -= area * n(0) * n(2);
    tangent[3] += area * (1.0 - n(1) * n(1));
    tangent[4] -= area * n(1) * n(2);
    tangent[5] += area * (1.0 - n(2) * n(2));
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d gradient = // its integral
        0.5 * share * n.cross(x.col(HalfEdgeEnd(k)) - x.col(HalfEdgeStart(k)));
      double* entry = entryOf(corners(k));
      entry[0] += 0.5 * length * shares(k);
      entry[1] += gradient(0);
      entry[2] += gradient(1);
      entry[3] += gradient(2);
    }
  }
  if (!(weight > 0.0))
  {
    samples.points.resize(first);
    samples.entries.resize(4 * first);
    return;
  }
  SampleSums sums = { number, weight };
  std::copy_n(place.data(), 3, sums.begin() + 2);
  std::copy_n(areaVector.data(), 3, sums.begin() + 5);
  std::copy_n(tangent.data(), 6, sums.begin() + 8);
  Eigen::Map<Eigen::Matrix<double, 1, 6>>(sums.data() + 14) << square(0, 0), square(0, 1),
    square(0, 2), square(1, 1), square(1, 2), square(2, 2);
  samples.sums.push_back(sums);
  samples.entryCounts.push_back(static_cast<int>(samples.points.size() - first));
}

void SurfaceGrid::Splatter::SumCell(
  int cell, const Part* begin, const Part* end, Samples& samples) const
{
  std::array<int, SubCellsOfCell + 1> first = {};
  for (const Part* part = begin; part != end; ++part)
  {
    ++first[part->subCell + 1];
  }
  for (int sub = 0; sub < SubCellsOfCell; ++sub)
  {
    first[sub + 1] += first[sub];
  }
  samples.sorted.resize(end - begin);
  std::array<int, SubCellsOfCell + 1> next = first;
  for (const Part* part = begin; part != end; ++part)
  {
    samples.sorted[next[part->subCell]++] = *part;
  }
  for (int sub = 0; sub < SubCellsOfCell; ++sub)
  {
    if (first[sub] < first[sub + 1])
    {
      this->SumSubCell(static_cast<double>(cell) * SubCellsOfCell + sub,
        samples.sorted.data() + first[sub], samples.sorted.data() + first[sub + 1], samples);
    }
  }
}

void SurfaceGrid::Splatter::Sum(const std::vector<int>& cells)
{
  SurfaceGrid& grid = this->Grid;
  const int count = static_cast<int>(cells.size());
  std::vector<int> first(count + 1, 0);
  for (const Parts& parts : this->Tasks)
  {
    for (const Part& part : parts.parts)
    {
      ++first[grid.CellOfBox[part.box] + 1];
    }
  }
  for (int c = 0; c < count; ++c)
  {
    first[c + 1] += first[c];
  }
  std::vector<Part> sorted(first[count]);
  std::vector<int> next(first.begin(), first.end() - 1);
  for (Parts& parts : this->Tasks)
  {
    for (const Part& part : parts.parts)
    {
      sorted[next[grid.CellOfBox[part.box]]++] = part;
    }
    std::vector<Part>().swap(parts.parts);
  }
  std::vector<Samples> tasks((count + CellsOfTask - 1) / CellsOfTask);
  ParallelTasks(static_cast<int>(tasks.size()), this->Threads,
    [&](int task)
    {
      const int end = std::min(count, (task + 1) * CellsOfTask);
      for (int c = task * CellsOfTask; c < end; ++c)
      {
        this->SumCell(c, sorted.data() + first[c], sorted.data() + first[c + 1], tasks[task]);
      }
      std::vector<Part>().swap(tasks[task].sorted);
    });
  std::vector<Part>().swap(sorted);
  this->Tasks.clear();

  std::vector<SampleSums> sums;
  std::vector<int> counts; // of entries, of each of these
  // Exactly as much as there will be: growing would take twice that for a while.
  const std::size_t entries = std::accumulate(tasks.begin(), tasks.end(), std::size_t(0),
    [](std::size_t sum, const Samples& task) { return sum + task.points.size(); });
  grid.EntryPoints = {};
  grid.EntryPoints.reserve(entries);
  grid.Entries = {};
  grid.Entries.reserve(4 * entries);
  for (Samples& task : tasks)
  {
    sums.insert(sums.end(), task.sums.begin(), task.sums.end());
    counts.insert(counts.end(), task.entryCounts.begin(), task.entryCounts.end());
    grid.EntryPoints.insert(grid.EntryPoints.end(), task.points.begin(), task.points.end());
    grid.Entries.insert(grid.Entries.end(), task.entries.begin(), task.entries.end());
    task = {};
  }
  const std::vector<std::size_t> merged = this->Merge(sums);
  this->TakeSums(sums, cells.size());
  grid.FirstEntry.assign(sums.size() + 1, 0);
  for (std::size_t k = 0; k < merged.size(); ++k)
  {
    grid.FirstEntry[merged[k] + 1] = counts[k];
  }
  std::partial_sum(grid.FirstEntry.begin(), grid.FirstEntry.end(), grid.FirstEntry.begin());
  this->PlaceInCells(cells);
}

/// Makes of the sums of this process those of all. @return where its own have gone, ascending
std::vector<std::size_t> SurfaceGrid::Splatter::Merge(std::vector<SampleSums>& sums) const
{
  std::vector<std::size_t> merged(sums.size());
  std::iota(merged.begin(), merged.end(), std::size_t(0));
  if (this->Grid.Everybody.IsWhole())
  {
    return merged;
  }
  std::vector<double> numbers(NumbersOfSample * sums.size());
  for (std::size_t k = 0; k < sums.size(); ++k)
  {
    std::copy(sums[k].begin(), sums[k].end(),
      numbers.begin() + static_cast<std::ptrdiff_t>(NumbersOfSample * k));
  }
  numbers = this->Grid.Everybody.Concatenate(numbers);
  std::vector<SampleSums> all(numbers.size() / NumbersOfSample);
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(NumbersOfSample * k), NumbersOfSample,
      all[k].begin());
  }
  std::stable_sort(
    all.begin(), all.end(), [](const SampleSums& a, const SampleSums& b) { return a[0] < b[0]; });
  std::vector<SampleSums> joined;
  for (const SampleSums& one : all)
  {
    if (joined.empty() || joined.back()[0] != one[0])
    {
      joined.push_back(one);
      continue;
    }
    std::transform(one.begin() + 1, one.end(), joined.back().begin() + 1, joined.back().begin() + 1,
      [](double a, double b) { return b + a; });
  }
  for (std::size_t k = 0, at = 0; k < sums.size(); ++k)
  {
    while (joined[at][0] != sums[k][0])
    {
      ++at;
    }
    merged[k] = at;
  }
  sums = std::move(joined);
  return merged;
}

/// The samples, by cells. @param cells  number of the active ones
void SurfaceGrid::Splatter::TakeSums(const std::vector<SampleSums>& sums, std::size_t cells)
{
  SurfaceGrid& grid = this->Grid;
  const auto samples = static_cast<Eigen::Index>(sums.size());
  grid.Weights.resize(samples);
  grid.Places.resize(samples, 3);
  grid.AreaVectors.resize(samples, 3);
  grid.Tangents.resize(samples, 6);
  grid.Locals.resize(samples, 3);
  grid.Spreads.clear();
  grid.Spreads.reserve(sums.size());
  grid.FirstSample.assign(cells + 1, 0);
  for (Eigen::Index k = 0; k < samples; ++k)
  {
    const double* of = sums[k].data();
    const double weight = of[1];
    const Eigen::Vector3d place = Eigen::Map<const Eigen::Vector3d>(of + 2) / weight;
    Eigen::Matrix3d square;
    square << of[14], of[15], of[16], of[15], of[17], of[18], of[16], of[18], of[19];
    ++grid.FirstSample[static_cast<std::size_t>(of[0]) / SubCellsOfCell + 1];
    grid.Weights(k) = weight;
    grid.Places.row(k) = place;
    grid.AreaVectors.row(k) = Eigen::Map<const Eigen::RowVector3d>(of + 5);
    grid.Tangents.row(k) = Eigen::Map<const Eigen::Matrix<double, 1, 6>>(of + 8);
    grid.Spreads.emplace_back(square / weight - place * place.transpose());
  }
  std::partial_sum(grid.FirstSample.begin(), grid.FirstSample.end(), grid.FirstSample.begin());
}

void SurfaceGrid::Splatter::PlaceInCells(const std::vector<int>& cells)
{
  SurfaceGrid& grid = this->Grid;
  const int width = 2 * grid.Half[0] + 1;
  const int height = 2 * grid.Half[1] + 1;
  const Eigen::RowVector3d middle = { 0.5 + grid.Half[0], 0.5 + grid.Half[1], 0.5 + grid.Half[2] };
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    const int row = cells[c] / width;
    const int layer = row / height;
    const Eigen::RowVector3d cell(cells[c] % width, row % height, layer);
    for (int i = grid.FirstSample[c]; i < grid.FirstSample[c + 1]; ++i)
    {
      grid.Locals.row(i) =
        (grid.Places.row(i) * grid.PerSpacing + middle - cell).cwiseMax(0.0).cwiseMin(1.0);
    }
  }
}

//------------------------------------------------------------------------------------------------
SurfaceGrid::SurfaceGrid(
  const Points& P, const Triangles& F, double size, int threads, const SurfacePart& part)
  : Everybody(part.Apart())
  , Size(size)
  , Spacing(size / SpacingsPerSize)
{
  const auto [low, high] = BoundsOf(P, part);
  const Eigen::RowVector3d extent = low.cwiseAbs().cwiseMax(high.cwiseAbs());
  for (;;)
  {
    this->PerSpacing = 1.0 / this->Spacing;
    const Eigen::Array3d half = (extent.transpose().array() * this->PerSpacing + 0.5).floor();
    const double boxes = (2.0 * half + 1.0).prod();
    // A box of more cells would have more functions than there may be, unless hardly any of it is
    // surface.
    constexpr double MostBoxes = 4e7;
    if (!(boxes <= MostBoxes))
    {
      const double thinnest = extent.maxCoeff() / MostBoxes; // the root below could overflow
      this->Spacing =
        std::max(thinnest, this->Spacing * 1.01 * std::cbrt(boxes / MostBoxes)); // of NaN, too
      continue;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Half[axis] = static_cast<int>(half(axis));
    }
    this->CellOfBox.assign(static_cast<std::size_t>(boxes), Outside);
    Splatter splatter(*this, P, F, threads);
    const std::optional<std::vector<int>> cells = splatter.Cut();
    if (!cells)
    {
      this->Spacing *= 2.0;
      continue;
    }
    // Each cell has a function of its own, so that there are at least as many.
    auto functions = static_cast<double>(cells->size());
    if (functions <= MaximumNumberOfFunctions)
    {
      this->NumberFunctions(*cells);
      functions = this->NumberOfFunctions;
    }
    if (functions > MaximumNumberOfFunctions)
    {
      this->Spacing *= 1.02 * std::sqrt(functions / MaximumNumberOfFunctions);
      continue;
    }
    splatter.Sum(*cells);
    return;
  }
}

void SurfaceGrid::NumberFunctions(const std::vector<int>& cells)
{
  const int nx = 2 * this->Half[0] + 1;
  const int ny = 2 * this->Half[1] + 1;
  const int nz = 2 * this->Half[2] + 1;
  std::vector<int> functions(static_cast<std::size_t>(nx + 2) * (ny + 2) * (nz + 2), Outside);
  const auto visit = [&](auto&& act)
  {
    for (std::size_t c = 0; c < cells.size(); ++c)
    {
      const int x = cells[c] % nx;
      const int y = cells[c] / nx % ny;
      const int z = cells[c] / nx / ny;
      for (int g = 0; g < Near; ++g)
      {
        const std::size_t at = x + g % 3 +
          static_cast<std::size_t>(nx + 2) *
            (y + g / 3 % 3 + static_cast<std::size_t>(ny + 2) * (z + g / 9));
        act(c, g, functions[at]);
      }
    }
  };
  visit([](std::size_t, int, int& function) { function = 0; });
  this->NumberOfFunctions = 0;
  for (int& function : functions)
  {
    if (function != Outside)
    {
      function = this->NumberOfFunctions++;
    }
  }
  this->Functions.resize(Near * cells.size());
  visit([this](std::size_t c, int g, int& function) { this->Functions[Near * c + g] = function; });
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    this->CellOfBox[cells[c]] = static_cast<int>(c);
  }
}

SurfaceGrid SurfaceGrid::At(const std::vector<int>& samples) const
{
  SurfaceGrid grid;
  grid.Everybody = this->Everybody;
  grid.Size = this->Size;
  grid.Spacing = this->Spacing;
  grid.PerSpacing = this->PerSpacing;
  grid.Half = this->Half;
  grid.CellOfBox.assign(this->CellOfBox.size(), Outside);
  std::vector<int> boxOf(this->FirstSample.size() - 1);
  for (std::size_t box = 0; box < this->CellOfBox.size(); ++box)
  {
    if (this->CellOfBox[box] != Outside)
    {
      boxOf[this->CellOfBox[box]] = static_cast<int>(box);
    }
  }
  std::vector<int> cells;
  auto sample = samples.begin();
  for (std::size_t c = 0; c < boxOf.size(); ++c)
  {
    const auto first = sample;
    sample = std::lower_bound(first, samples.end(), this->FirstSample[c + 1]);
    if (sample != first)
    {
      cells.push_back(boxOf[c]);
      grid.FirstSample.push_back(static_cast<int>(first - samples.begin()));
    }
  }
  grid.FirstSample.push_back(static_cast<int>(samples.size()));
  grid.NumberFunctions(cells);
  grid.Locals = this->Locals(samples, AllColumns);
  grid.Weights = this->Weights(samples);
  grid.Places = this->Places(samples, AllColumns);
  grid.AreaVectors = this->AreaVectors(samples, AllColumns);
  grid.Tangents = this->Tangents(samples, AllColumns);
  for (const int k : samples)
  {
    grid.Spreads.push_back(this->Spreads[k]);
  }
  return grid;
}

namespace
{
// Entry `shift` of function g, the other function having a larger number, or g itself.
constexpr int EntriesOfFunction = Shifts - HalfOfShifts;

/// What a sample adds to the matrix. @param Q  Q_k times the stiffness @param root  of the mass of
/// the sample
void AddSample(
  const LocalFunctions& f, const Eigen::Matrix3d& Q, double root, double spacing, Block& block)
{
  // Q = L L^T, semidefinite: a flat piece has no say across itself.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(Q);
  const Eigen::Matrix3d L =
    eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  alignas(64) double u[4 * 28] = {};
  for (int g = 0; g < Near; ++g)
  {
    u[g] = root * f.phi[g];
    for (int axis = 0; axis < 3; ++axis)
    {
      u[28 * (axis + 1) + g] = (L(0, axis) * f.gradient[0][g] + L(1, axis) * f.gradient[1][g] +
                                 L(2, axis) * f.gradient[2][g]) /
        spacing;
    }
  }
  AddOuterProducts(u, block.data());
}

/// Means over a cell of products of slopes, for pairs of its functions: xx, xy + yx, xz + zx, yy,
/// yz + zy, zz.
std::array<Block, 6> MakeSlopeProducts()
{
  // Gauss' rule with three places is exact for them.
  const double far = 0.5 * std::sqrt(0.6);
  const double places[] = { 0.5 - far, 0.5, 0.5 + far };
  const double weights[] = { 5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0 };
  std::array<Block, 6> products = {};
  for (int q = 0; q < 27; ++q)
  {
    const double weight = weights[q % 3] * weights[q / 3 % 3] * weights[q / 9];
    const LocalFunctions f({ places[q % 3], places[q / 3 % 3], places[q / 9] });
    for (int a = 0; a < Near; ++a)
    {
      for (int b = 0; b < Near; ++b)
      {
        int at = 0;
        for (int i = 0; i < 3; ++i)
        {
          for (int j = i; j < 3; ++j, ++at)
          {
            const double product = f.gradient[i][a] * f.gradient[j][b];
            const double other = f.gradient[j][a] * f.gradient[i][b];
            products[at][28 * a + b] += weight * (i == j ? product : product + other);
          }
        }
      }
    }
  }
  return products;
}

/// What the slope across the surface adds, all over a cell. @param across  sum of w n n^T, times
/// stiffness and factor
void AddAcross(const Eigen::Matrix3d& across, double spacing, Block& block)
{
  static const std::array<Block, 6> products = MakeSlopeProducts();
  const Eigen::Matrix3d W = across / (spacing * spacing);
  for (std::size_t i = 0; i < block.size(); ++i)
  {
    block[i] += W(0, 0) * products[0][i] + W(0, 1) * products[1][i] + W(0, 2) * products[2][i] +
      W(1, 1) * products[3][i] + W(1, 2) * products[4][i] + W(2, 2) * products[5][i];
  }
}

/// Half of the matrix, with the ridge. @param others  the other function of each entry, or Outside
SparseCholesky::Matrix LowerMatrix(
  int functions, const std::vector<double>& values, const std::vector<int>& others)
{
  SparseCholesky::Matrix A(functions, functions);
  const auto entries =
    std::count_if(others.begin(), others.end(), [](int other) { return other != Outside; });
  A.resizeNonZeros(static_cast<Eigen::Index>(entries));
  double trace = 0.0;
  for (int g = 0; g < functions; ++g)
  {
    trace += values[static_cast<std::size_t>(g) * EntriesOfFunction];
  }
  int at = 0;
  for (int g = 0; g < functions; ++g)
  {
    A.outerIndexPtr()[g] = at;
    for (int s = 0; s < EntriesOfFunction; ++s)
    {
      const std::size_t from = static_cast<std::size_t>(g) * EntriesOfFunction + s;
      if (others[from] != Outside)
      {
        A.innerIndexPtr()[at] = others[from];
        A.valuePtr()[at] = values[from] + (s == 0 ? Ridge * trace / functions : 0.0);
        ++at;
      }
    }
  }
  A.outerIndexPtr()[functions] = at;
  return A;
}
}

SparseCholesky::Matrix SurfaceGrid::Assemble(
  double mass, const Eigen::VectorXd& stiffness, double across, int threads) const
{
  const int cells = static_cast<int>(this->Functions.size()) / Near;
  std::vector<double> values(
    static_cast<std::size_t>(this->NumberOfFunctions) * EntriesOfFunction, 0.0);
  std::vector<int> others(values.size(), Outside);
  std::array<std::array<int, Near>, Near> shift = {};
  for (int a = 0; a < Near; ++a)
  {
    for (int b = 0; b < Near; ++b)
    {
      shift[a][b] = ShiftOf(a, b) - HalfOfShifts;
    }
  }
  constexpr int CellsAtOnce = 4096;
  std::vector<Block> blocks(std::min(cells, CellsAtOnce));
  for (int begin = 0; begin < cells; begin += CellsAtOnce)
  {
    const int count = std::min(CellsAtOnce, cells - begin);
    ParallelTasks((count + CellsOfTask - 1) / CellsOfTask, threads,
      [&](int task)
      {
        const int end = std::min(count, (task + 1) * CellsOfTask);
        for (int c = task * CellsOfTask; c < end; ++c)
        {
          Block& block = blocks[c];
          block.fill(0.0);
          Eigen::Matrix3d normals = Eigen::Matrix3d::Zero(); // sum of w n n^T times stiffness
          for (int k = this->FirstSample[begin + c]; k < this->FirstSample[begin + c + 1]; ++k)
          {
            const auto t = this->Tangents.row(k);
            Eigen::Matrix3d Q;
            Q << t(0), t(1), t(2), t(1), t(3), t(4), t(2), t(4), t(5);
            normals += stiffness(k) * (this->Weights(k) * Eigen::Matrix3d::Identity() - Q);
            AddSample(LocalFunctions(this->Locals.row(k)), stiffness(k) * Q,
              std::sqrt(mass * this->Weights(k)), this->Spacing, block);
          }
          if (across > 0.0)
          {
            AddAcross(across * normals, this->Spacing, block);
          }
        }
      });
    for (int c = 0; c < count; ++c)
    {
      const int* functions =
        this->Functions.data() + static_cast<std::ptrdiff_t>(Near) * (begin + c);
      for (int a = 0; a < Near; ++a)
      {
        for (int b = 0; b <= a; ++b)
        {
          const std::size_t at =
            static_cast<std::size_t>(functions[b]) * EntriesOfFunction + shift[b][a];
          values[at] += blocks[c][28 * a + b];
          others[at] = functions[a];
        }
      }
    }
  }
  return LowerMatrix(this->NumberOfFunctions, values, others);
}

/// Pairs of the same two cells, added up.
struct SurfaceGrid::CellPair
{
  std::array<int, 2> cells; // active cells, ascending
  std::array<int, 3> apart; // from the first cell to the second
  double weight;
  std::array<Eigen::Vector3d, 2> t; // weighted places in these cells
};

std::vector<SurfaceGrid::CellPair> SurfaceGrid::CellPairs(const std::vector<GridPair>& pairs) const
{
  std::vector<CellPair> found;
  for (const GridPair& pair : pairs)
  {
    const std::array<Place, 2> places = { this->Locate(pair.u.transpose()),
      this->Locate(pair.v.transpose()) };
    std::array<int, 2> cells;
    for (int side = 0; side < 2; ++side)
    {
      cells[side] = this->CellOfBox[BoxIndex(this->Half, places[side].cell)];
    }
    const int first = cells[0] <= cells[1] ? 0 : 1;
    const Place& from = places[first];
    const Place& to = places[1 - first];
    const CellPair both = { { cells[first], cells[1 - first] },
      { to.cell[0] - from.cell[0], to.cell[1] - from.cell[1], to.cell[2] - from.cell[2] },
      pair.weight, { pair.weight * from.t, pair.weight * to.t } };
    if (both.cells[0] != Outside)
    {
      found.push_back(both);
    }
  }
  std::stable_sort(found.begin(), found.end(),
    [](const CellPair& a, const CellPair& b) { return a.cells < b.cells; });
  std::vector<CellPair> sums;
  for (const CellPair& pair : found)
  {
    // In one cell nothing says which side is which.
    const bool apart = pair.cells[0] != pair.cells[1];
    if (apart && !sums.empty() && sums.back().cells == pair.cells)
    {
      sums.back().weight += pair.weight;
      sums.back().t[0] += pair.t[0];
      sums.back().t[1] += pair.t[1];
    }
    else
    {
      sums.push_back(pair);
    }
  }
  return sums;
}

namespace
{
/// Half of a matrix, for pairs of functions that are not far apart. The numbers of functions follow
/// their places, by z, then y, then x, so that an entry is found by how far the function of its row
/// is from that of its column.
class NearEntries
{
public:
  /// @param reach  the farthest along each axis @param used  of each function, whether it has some
  NearEntries(const std::array<int, 3>& reach, const std::vector<char>& used)
    : Stride{ 1, 2 * reach[0] + 1, (2 * reach[0] + 1) * (2 * reach[1] + 1) }
    , Length(1 + this->Along(reach))
    , Columns(used.size(), Outside)
  {
    int columns = 0;
    for (std::size_t g = 0; g < used.size(); ++g)
    {
      this->Columns[g] = used[g] ? columns++ : Outside;
    }
    this->Rows.assign(columns * this->Length, Outside);
    this->Values.assign(this->Rows.size(), 0.0);
  }

  int Along(const std::array<int, 3>& shift) const
  {
    return shift[0] * this->Stride[0] + shift[1] * this->Stride[1] + shift[2] * this->Stride[2];
  }
  /// @param apart  Along, from the function b to a
  void Add(int a, int b, int apart, double value)
  {
    const std::size_t at = this->Columns[std::min(a, b)] * this->Length + std::abs(apart);
    this->Rows[at] = std::max(a, b);
    this->Values[at] += value;
  }
  /// Entries that are not 0.
  SparseCholesky::Matrix Matrix() const
  {
    const auto functions = static_cast<int>(this->Columns.size());
    SparseCholesky::Matrix A(functions, functions);
    A.reserve(std::count_if(
      this->Values.begin(), this->Values.end(), [](double value) { return value != 0.0; }));
    for (int g = 0; g < functions; ++g)
    {
      A.startVec(g);
      const std::size_t begin = this->Columns[g] * this->Length;
      for (std::size_t at = begin; this->Columns[g] != Outside && at < begin + this->Length; ++at)
      {
        if (this->Values[at] != 0.0)
        {
          A.insertBack(this->Rows[at], g) = this->Values[at];
        }
      }
    }
    A.finalize();
    return A;
  }

private:
  std::array<int, 3> Stride;
  std::size_t Length;
  std::vector<int> Columns; // of each function, among those that have entries
  std::vector<int> Rows;
  std::vector<double> Values;
};
}

void SurfaceGrid::AddPairs(const std::vector<GridPair>& pairs, SparseCholesky::Matrix& A) const
{
  const std::vector<CellPair> sums = this->CellPairs(pairs);
  if (sums.empty())
  {
    return;
  }
  std::array<int, 3> reach = { 2, 2, 2 }; // of the functions of one cell
  std::vector<char> used(this->NumberOfFunctions, 0);
  for (const CellPair& sum : sums)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      reach[axis] = std::max(reach[axis], 2 + std::abs(sum.apart[axis]));
    }
    for (const int cell : sum.cells)
    {
      const int* functions = this->Functions.data() + static_cast<std::ptrdiff_t>(Near) * cell;
      std::for_each(functions, functions + Near, [&](int g) { used[g] = 1; });
    }
  }
  NearEntries entries(reach, used);
  const double scale = this->Size * this->Size;
  for (const CellPair& sum : sums)
  {
    std::array<int, 2 * Near> functions = {};
    std::array<int, 2 * Near> places = {};
    std::array<double, 2 * Near> phi = {};
    for (int side = 0; side < 2; ++side)
    {
      const LocalFunctions local(sum.t[side] / sum.weight);
      for (int g = 0; g < Near; ++g)
      {
        const int at = Near * side + g;
        functions[at] = this->Functions[static_cast<std::size_t>(Near) * sum.cells[side] + g];
        places[at] = side * entries.Along(sum.apart) + entries.Along({ g % 3, g / 3 % 3, g / 9 });
        phi[at] = side == 0 ? local.phi[g] : -local.phi[g];
      }
    }
    for (int a = 0; a < 2 * Near; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        // A function that both sides have comes twice off the diagonal of this block, and is on
        // that of A.
        const double share = a != b && functions[a] == functions[b] ? 2.0 : 1.0;
        entries.Add(functions[a], functions[b], places[a] - places[b],
          share * scale * sum.weight * phi[a] * phi[b]);
      }
    }
  }
  A += entries.Matrix();
  A.makeCompressed();
}

void SurfaceGrid::Factor(const std::vector<GridPair>& pairs, int threads)
{
  SparseCholesky::Matrix A = this->Assemble(1.0,
    Eigen::VectorXd::Constant(this->GetNumberOfSamples(), this->Size * this->Size), Across,
    threads);
  this->AddPairs(pairs, A);
  this->System.Analyze(A);
  this->System.Factor(A, SparseCholesky::Precision::Double, threads);
}

void SurfaceGrid::FactorAlong(int threads)
{
  this->FactorConduction(
    Eigen::VectorXd::Constant(this->GetNumberOfSamples(), this->Size * this->Size), 1.0, threads);
}

void SurfaceGrid::FactorPoisson(int threads)
{
  this->FactorConduction(Eigen::VectorXd::Ones(this->GetNumberOfSamples()), PoissonMass, threads);
}

void SurfaceGrid::FactorConduction(const Eigen::VectorXd& conductivity, double mass, int threads)
{
  const SparseCholesky::Matrix A = this->Assemble(mass, conductivity, 0.0, threads);
  this->System.Analyze(A);
  this->System.Factor(A, SparseCholesky::Precision::Double, threads);
}

Fields SurfaceGrid::Means(const Fields& X, int threads) const
{
  Fields means(this->GetNumberOfSamples(), X.cols());
  ParallelFor(this->GetNumberOfSamples(), threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        means.row(k).setZero();
        for (int e = this->FirstEntry[k]; e < this->FirstEntry[k + 1]; ++e)
        {
          means.row(k) +=
            this->Entries[4 * static_cast<std::size_t>(e)] * X.row(this->EntryPoints[e]);
        }
      }
    });
  this->Everybody.Sum(means);
  means.array().colwise() /= this->Weights.array();
  return means;
}

Fields SurfaceGrid::Gradients(const Points& X, int threads) const
{
  Fields gradients(this->GetNumberOfSamples(), 9);
  ParallelFor(this->GetNumberOfSamples(), threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        Eigen::Matrix3d G = Eigen::Matrix3d::Zero();
        for (int e = this->FirstEntry[k]; e < this->FirstEntry[k + 1]; ++e)
        {
          const Eigen::Map<const Eigen::RowVector3d> gradient(
            this->Entries.data() + 4 * static_cast<std::size_t>(e) + 1);
          G += X.row(this->EntryPoints[e]).transpose() * gradient;
        }
        gradients.row(k) << G.row(0), G.row(1), G.row(2);
      }
    });
  this->Everybody.Sum(gradients);
  gradients.array().colwise() /= this->Weights.array();
  return gradients;
}

void SurfaceGrid::ForgetPoints()
{
  this->FirstEntry = {};
  this->EntryPoints = {};
  this->Entries = {};
}

Fields SurfaceGrid::Smooth(const Fields& X, int threads) const
{
  return this->Solve(X, Fields(0, 0), threads);
}

Points SurfaceGrid::AreaVectorsUnder(const Fields& gradients, int threads) const
{
  Points images = Points::Zero(gradients.rows(), 3);
  ParallelFor(static_cast<int>(gradients.rows()), threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        const Eigen::Vector3d N = this->AreaVectors.row(k);
        const double length = N.norm();
        if (length > 0.0)
        {
          const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> G(
            gradients.row(k).data());
          const Eigen::Vector3d m = N / length;
          const Eigen::Vector3d u = m.unitOrthogonal();
          images.row(k) = length * (G * u).cross(G * m.cross(u));
        }
      }
    });
  return images;
}

Fields SurfaceGrid::SmoothTwice(const Fields& X, int threads) const
{
  return this->Smooth(this->AtSamples(this->Smooth(X, threads), threads), threads);
}

Fields SurfaceGrid::Solve(const Fields& X, const Fields& Y, int threads) const
{
  const Eigen::Index columns = X.cols();
  Fields b = Fields::Zero(this->NumberOfFunctions, columns);
  const int cells = static_cast<int>(this->Functions.size()) / Near;
  for (int c = 0; c < cells; ++c)
  {
    const int* functions = this->Functions.data() + static_cast<std::ptrdiff_t>(Near) * c;
    for (int k = this->FirstSample[c]; k < this->FirstSample[c + 1]; ++k)
    {
      const LocalFunctions f(this->Locals.row(k));
      for (int g = 0; g < Near; ++g)
      {
        b.row(functions[g]) += f.phi[g] * this->Weights(k) * X.row(k);
        if (Y.rows() > 0)
        {
          const Eigen::Vector3d slope =
            Eigen::Vector3d(f.gradient[0][g], f.gradient[1][g], f.gradient[2][g]) / this->Spacing;
          for (Eigen::Index j = 0; j < columns; ++j)
          {
            b(functions[g], j) += Y.row(k).segment<3>(3 * j).dot(slope);
          }
        }
      }
    }
  }
  for (Eigen::Index first = 0; first < columns; first += 3)
  {
    const Eigen::Index count = std::min<Eigen::Index>(3, columns - first);
    SparseCholesky::RightHandSides B =
      SparseCholesky::RightHandSides::Zero(this->NumberOfFunctions, 3);
    B.leftCols(count) = b.middleCols(first, count);
    this->System.Solve(B, threads);
    b.middleCols(first, count) = B.leftCols(count);
  }
  return b;
}

template <typename Placing>
Fields SurfaceGrid::Evaluate(
  const Fields& coefficients, int count, const Placing& locate, int threads) const
{
  const int columns = static_cast<int>(coefficients.cols());
  Fields result(count, columns);
  const int stride = columns <= 4 ? 4 : 12;
  for (int first = 0; first < columns; first += stride)
  {
    const int width = std::min(stride, columns - first);
    Fields packed = Fields::Zero(coefficients.rows(), stride);
    packed.leftCols(width) = coefficients.middleCols(first, width);
    ParallelTasks((count + PointsOfPacket - 1) / PointsOfPacket, threads,
      [&](int task)
      {
        const int begin = task * PointsOfPacket;
        const int number = std::min(PointsOfPacket, count - begin);
        std::vector<double> t(3 * static_cast<std::size_t>(number));
        std::vector<const int*> functions(number);
        for (int i = 0; i < number; ++i)
        {
          functions[i] = locate(begin + i, t.data() + 3 * static_cast<std::size_t>(i));
        }
        std::vector<double> values;
        double* into = result.data() + static_cast<std::ptrdiff_t>(begin) * columns;
        if (width < columns)
        {
          values.resize(static_cast<std::size_t>(number) * width);
          into = values.data();
        }
        (stride == 4 ? Evaluate4 : Evaluate12)(
          t.data(), functions.data(), number, packed.data(), width, into);
        if (width < columns)
        {
          result.block(begin, first, number, width) =
            Eigen::Map<const Fields>(values.data(), number, width);
        }
      });
  }
  return result;
}

Fields SurfaceGrid::AtSamples(
  const Fields& coefficients, int threads, const Eigen::Vector3d& offset) const
{
  std::vector<int> cells(this->GetNumberOfSamples());
  for (std::size_t c = 0; c + 1 < this->FirstSample.size(); ++c)
  {
    std::fill(cells.begin() + this->FirstSample[c], cells.begin() + this->FirstSample[c + 1],
      static_cast<int>(c));
  }
  return this->Evaluate(
    coefficients, this->GetNumberOfSamples(),
    [&](int k, double* t)
    {
      Eigen::Map<Eigen::RowVector3d>(t, 3) = this->Locals.row(k) + offset.transpose();
      return this->Functions.data() + static_cast<std::ptrdiff_t>(Near) * cells[k];
    },
    threads);
}

Fields SurfaceGrid::AtPoints(const Fields& coefficients, const Points& x, int threads) const
{
  return this->Evaluate(
    coefficients, static_cast<int>(x.rows()),
    [&](int i, double* t)
    {
      const Place place = this->Locate(x.row(i));
      std::copy_n(place.t.data(), 3, t);
      return this->FunctionsAt(place);
    },
    threads);
}
} // namespace SphericalStyle
