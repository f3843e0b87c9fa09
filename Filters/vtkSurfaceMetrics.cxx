// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceMetrics.h"

#include "vtkFilterSupport.h"
#include "vtkProcesses.h"
#include "vtkStyleHistory.h"
#include "vtkSurfacePair.h"

#include "DeformationMeasures.h"
#include "EdgeWeights.h"
#include "MatrixCondition.h"
#include "MeshQuality.h"
#include "SharedNumbers.h"
#include "SurfaceMeasures.h"
#include "SurroundedMesh.h"
#include "TargetDirections.h"
#include "Thickness.h"
#ifdef SPHERICALSTYLE_WITH_CGAL
#include "SelfIntersections.h"
#endif

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using SphericalStyle::EdgePart;
using SphericalStyle::MeshEdges;
using SphericalStyle::Points;
using SphericalStyle::SurfacePart;
using SphericalStyle::Triangles;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkSurfaceMetrics);

namespace
{
constexpr double Degrees = 180.0 / SphericalStyle::Pi;
constexpr double ConditionTolerance = 1e-6;
constexpr double None = std::numeric_limits<double>::quiet_NaN();
using Names = std::vector<std::int64_t>;                // of triangles, the same on all processes
using Pairs = std::vector<std::array<std::int64_t, 2>>; // of names, the smaller first, in order

double VolumeIfClosed(const Points& P, const Triangles& F, const SurfacePart& part, bool closed)
{
  return closed ? SphericalStyle::EnclosedVolume(P, F, part) : None;
}

double CountBelow(const Eigen::VectorXd& x, double limit)
{
  return static_cast<double>((x.array() < limit).count());
}

double Least(const Eigen::VectorXd& x, const SurfacePart& part)
{
  return -part.Max(x.size() > 0 ? -x.minCoeff() : -std::numeric_limits<double>::infinity());
}

double Most(const Eigen::VectorXd& x, const SurfacePart& part)
{
  return part.Max(x.size() > 0 ? x.maxCoeff() : -std::numeric_limits<double>::infinity());
}

double Rms(const Eigen::VectorXd& x, const SurfacePart& part)
{
  Eigen::Vector2d sums(x.squaredNorm(), static_cast<double>(x.size()));
  part.Sum(sums);
  return sums(1) > 0.0 ? std::sqrt(sums(0) / sums(1)) : 0.0;
}

/// The numbers at points that count here.
Eigen::VectorXd ThatCount(const Eigen::VectorXd& x, const SurfacePart& part)
{
  std::vector<double> counted;
  for (Eigen::Index i = 0; i < x.size(); ++i)
  {
    if (part.Counts(i))
    {
      counted.push_back(x(i));
    }
  }
  return Eigen::Map<Eigen::VectorXd>(counted.data(), static_cast<Eigen::Index>(counted.size()));
}

vtkSmartPointer<vtkDataArray> MakeArray(const char* name, int type, const Eigen::VectorXd& values)
{
  auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  array->SetName(name);
  array->SetNumberOfTuples(values.size());
  for (vtkIdType i = 0; i < values.size(); ++i)
  {
    array->SetComponent(i, 0, values(i));
  }
  return array;
}

#ifdef SPHERICALSTYLE_WITH_CGAL
/// Pairs with a triangle of this process.
Pairs FindPairs(
  const SphericalStyle::TriangleMesh& mesh, const Names& names, const SurfacePart& part)
{
  const SphericalStyle::SurroundedMesh all = SphericalStyle::SurroundByOthers(mesh, names, part);
  std::vector<char> isOwn(all.mesh.F.rows(), 0);
  std::fill_n(isOwn.begin(), mesh.F.rows(), char(1));
  Pairs pairs;
  for (const auto& [f, g] : SphericalStyle::SelfIntersections(all.mesh, isOwn))
  {
    const auto [less, more] = std::minmax(all.names[f], all.names[g]);
    pairs.push_back({ less, more });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}
#endif
}

//------------------------------------------------------------------------------------------------
/// One execution: measures and writes what it finds to both outputs.
struct vtkSurfaceMetrics::Measurement
{
  vtkSurfaceMetrics* Self;
  const vtkSurfaceMesh& Surface;
  vtkPolyData* Output;
  vtkTable* Table;
  vtkSurfaceMeshConversion::GhostTriangles Ghosts = {};
  std::int64_t FirstName = 0; // of the triangles of this process

  const SurfacePart& Part() const { return this->Surface.Part; }

  void AddArray(vtkDataArray* array) const
  {
    if (this->Part().IsWhole() || this->Part().processes->GetRank() == 0)
    {
      this->Table->AddColumn(array);
      this->Output->GetFieldData()->AddArray(array);
    }
  }
  void AddCount(const char* name, double value) const
  {
    vtkNew<vtkIdTypeArray> array;
    array->SetName(name);
    array->InsertNextValue(static_cast<vtkIdType>(value));
    this->AddArray(array);
  }
  void AddNumber(const char* name, double value) const
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    this->AddArray(array);
  }
  void AddPosition(const char* name, const Eigen::Vector3d& position) const
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(3);
    array->InsertNextTuple(position.data());
    this->AddArray(array);
  }
  void AddPointArray(const char* name, const Eigen::VectorXd& values) const
  {
    vtkSurfaceMeshConversion::AddPointArray(this->Output, this->Surface, name, VTK_DOUBLE, values);
  }
  void AddCellArray(const char* name, int type, const Eigen::VectorXd& values) const
  {
    this->Output->GetCellData()->AddArray(MakeArray(name, type, values));
  }

  Eigen::VectorXd PerCell(double initial = 0.0) const
  {
    return Eigen::VectorXd::Constant(this->Output->GetNumberOfCells(), initial);
  }
  double& AtCell(Eigen::VectorXd& values, std::int64_t triangle) const
  {
    return values(this->Surface.GetCell(static_cast<Eigen::Index>(triangle)));
  }
  bool IsOwn(std::int64_t name) const
  {
    return name >= this->FirstName && name < this->FirstName + this->Surface.Mesh.F.rows();
  }
  /// Asked by all processes at once.
  bool IsAborted() const { return this->Part().Max(Aborted(this->Self) ? 1.0 : 0.0) > 0.0; }

  /// Triangles and their cells; those of cells of other processes come last, since these cells are
  /// shown here, too.
  struct Shown
  {
    Triangles F;
    std::vector<vtkIdType> Cells;
  };
  /// @param triangles  of F by their numbers in the surface, empty: all
  /// @param pointOf  numbers of input points
  Shown WithGhosts(const Triangles& F, const std::vector<int>& triangles,
    const std::vector<int>& pointOf, const Points& P) const;

  double CountTriangles(const Pairs& pairs) const;
  double CountPairs(const Pairs& pairs) const;
  void ShowAtGhosts(Eigen::VectorXd& cells) const;

  void MeasureEdges(const SphericalStyle::EdgeCounts& counts) const;
  void MeasureShape(bool closed) const;
  void MeasureQuality(const MeshEdges& edges, const EdgePart& edgePart) const;
  void MeasureCondition() const;
  Pairs MeasureSelfIntersections() const;
  void MeasureDeformation(const vtkSurfacePair& pair, bool closed) const;
  void MeasureAreaRatios(const vtkSurfacePair& pair, const Shown& shown) const;
  void MeasureThicknessRatios(const vtkSurfacePair& pair) const;
  void MeasureNewSelfIntersections(const vtkSurfacePair& pair, const Pairs& now) const;
  void Measure(vtkPolyData* reference);
};

vtkSurfaceMetrics::Measurement::Shown vtkSurfaceMetrics::Measurement::WithGhosts(const Triangles& F,
  const std::vector<int>& triangles, const std::vector<int>& pointOf, const Points& P) const
{
  Shown shown;
  shown.F.resize(F.rows() + this->Ghosts.Corners.rows(), 3);
  shown.F.topRows(F.rows()) = F;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    shown.Cells.push_back(this->Surface.GetCell(triangles.empty() ? f : triangles[f]));
  }
  for (Eigen::Index f = 0; f < this->Ghosts.Corners.rows(); ++f)
  {
    const Eigen::RowVector3i corners =
      this->Ghosts.Corners.row(f).unaryExpr([&](int i) { return pointOf[i]; });
    if (!SphericalStyle::IsDegenerate(P.row(corners(0)), P.row(corners(1)), P.row(corners(2))))
    {
      shown.F.row(static_cast<Eigen::Index>(shown.Cells.size())) = corners;
      shown.Cells.push_back(this->Ghosts.Cells[f]);
    }
  }
  shown.F.conservativeResize(static_cast<Eigen::Index>(shown.Cells.size()), 3);
  return shown;
}

void vtkSurfaceMetrics::Measurement::MeasureEdges(const SphericalStyle::EdgeCounts& counts) const
{
  const Points& P = this->Surface.Mesh.P;
  const Triangles& F = this->Surface.Mesh.F;
  Eigen::Vector2d sums(0.0, static_cast<double>(F.rows()));
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    sums(0) += this->Part().Counts(i) ? 1.0 : 0.0;
  }
  this->Part().Sum(sums);
  const auto edges = static_cast<double>(counts.edges);
  this->AddCount("Points", sums(0));
  this->AddCount("Triangles", sums(1));
  this->AddCount("DegenerateTriangles", static_cast<double>(this->Surface.DegenerateTriangles));
  this->AddCount("Edges", edges);
  this->AddCount("BorderEdges", static_cast<double>(counts.border));
  this->AddCount("NonManifoldEdges", static_cast<double>(counts.nonManifold));
  this->AddCount("MisorientedEdges", static_cast<double>(counts.misoriented));
  this->AddCount("Closed", counts.closed ? 1.0 : 0.0);
  this->AddCount("Components", SphericalStyle::CountComponents(F, P.rows(), this->Part()));
  this->AddCount("EulerCharacteristic", sums(0) - edges + sums(1));
}

void vtkSurfaceMetrics::Measurement::MeasureShape(bool closed) const
{
  using namespace SphericalStyle;
  const Points& P = this->Surface.Mesh.P;
  const Triangles& F = this->Surface.Mesh.F;
  const SurfacePart& part = this->Part();
  this->AddNumber("Area", part.Sum(TriangleAreas(P, F).sum()));
  this->AddNumber("Volume", VolumeIfClosed(P, F, part, closed));
  this->AddNumber("Sphericity", closed ? Sphericity(P, F, part) : None);

  const Eigen::Vector3d center =
    TargetSphere(P, F, static_cast<SphericalStyle::CenterMode>(this->Self->CenterMode),
      RadiusMode::EqualArea, { Eigen::Vector3d(this->Self->Center), 1.0 }, part)
      .center;
  const Eigen::VectorXd cosines = RadialCosines(P, PointNormals(P, F, part), center);
  this->AddPosition("Center", center);
  this->AddNumber("RadiusSpread", RadiusSpread(P, center, part));
  const Eigen::VectorXd counted = ThatCount(cosines, part);
  Eigen::Vector2d overhang(CountBelow(counted, -RightAngle), static_cast<double>(counted.size()));
  part.Sum(overhang);
  this->AddNumber("OverhangShare", overhang(0) / overhang(1));
  this->AddPointArray("RadialCosine", cosines);

  const FittedSphere fitted = FitSphere(P, part);
  this->AddPosition("FittedCenter", fitted.center);
  this->AddNumber("FittedRadius", fitted.radius);
  this->AddNumber("FittedSphereError", fitted.error);
}

void vtkSurfaceMetrics::Measurement::MeasureQuality(
  const MeshEdges& edges, const EdgePart& edgePart) const
{
  using namespace SphericalStyle;
  const Points& P = this->Surface.Mesh.P;
  const Triangles& F = this->Surface.Mesh.F;
  const SurfacePart& part = this->Part();
  const Shown shown = this->WithGhosts(F, {}, this->Surface.MeshPoint, P);
  Eigen::MatrixX2d angles = ExtremeAngles(P, shown.F);
  Eigen::VectorXd smallest = this->PerCell();
  Eigen::VectorXd largest = smallest;
  for (Eigen::Index f = 0; f < angles.rows(); ++f)
  {
    double& least = smallest(shown.Cells[f]);
    double& most = largest(shown.Cells[f]);
    least = most > 0.0 ? std::min(least, angles(f, 0)) : angles(f, 0);
    most = std::max(most, angles(f, 1));
  }
  this->AddCellArray("SmallestAngle", VTK_DOUBLE, smallest);
  this->AddCellArray("LargestAngle", VTK_DOUBLE, largest);
  angles.conservativeResize(F.rows(), 2);
  this->AddNumber("SmallestAngle", Least(angles.col(0), part));
  this->AddNumber("LargestAngle", Most(angles.col(1), part));
  const Eigen::VectorXd cosines = (angles.col(1) / Degrees).array().cos();
  Eigen::Vector2d obtuse(CountBelow(cosines, -RightAngle), static_cast<double>(F.rows()));
  part.Sum(obtuse);
  this->AddNumber("ObtuseShare", obtuse(0) / obtuse(1));
  this->AddNumber("RmsDihedral", Degrees * Rms(DihedralAngles(P, F, edges, edgePart), part));

  const WeightReport weights = CheckWeights(HalfEdgeCotangents(P, F), edges, edgePart);
  this->AddCount("NegativeWeights", static_cast<double>(weights.negative));
  this->AddNumber("LambdaStar", weights.lambdaStar);

  const OppositionReport opposition =
    FindOpposition(P, PointNormals(P, F, part), F, edges, part, edgePart);
  this->AddCount("OpposedEdges", static_cast<double>(opposition.edges));
  this->AddPointArray("Opposition", opposition.share);
}

void vtkSurfaceMetrics::Measurement::MeasureCondition() const
{
  const SphericalStyle::TriangleMesh& mesh = this->Surface.Mesh;
  const SphericalStyle::HalfEdgeScalars k =
    SphericalStyle::HalfEdgeCotangents(mesh.P, mesh.F).array() + 0.5 * this->Self->Roundness;
  const SphericalStyle::MatrixCondition condition = SphericalStyle::EstimateCondition(
    { mesh.F, static_cast<int>(mesh.P.rows()) }, k, 0.5 * ConditionTolerance);
  this->AddNumber("Condition", condition.nonZero);
  this->AddNumber("PinnedCondition", condition.pinned);
  this->AddNumber("ConditionAccuracy", condition.accuracy);
  if (!(condition.accuracy <= ConditionTolerance))
  {
    vtkWarningWithObjectMacro(this->Self,
      << InBlock(this->Self) << "the condition number is known to a relative accuracy of "
      << condition.accuracy << " only");
  }
}

/// Triangles that a pair names, of all processes.
double vtkSurfaceMetrics::Measurement::CountTriangles(const Pairs& pairs) const
{
  Names own;
  for (const auto& pair : pairs)
  {
    std::copy_if(pair.begin(), pair.end(), std::back_inserter(own),
      [this](std::int64_t name) { return this->IsOwn(name); });
  }
  std::sort(own.begin(), own.end());
  return this->Part().Sum(static_cast<double>(std::unique(own.begin(), own.end()) - own.begin()));
}

/// Of all processes: a pair of two of them counts on one.
double vtkSurfaceMetrics::Measurement::CountPairs(const Pairs& pairs) const
{
  return this->Part().Sum(static_cast<double>(std::count_if(
    pairs.begin(), pairs.end(), [this](const auto& pair) { return this->IsOwn(pair[0]); })));
}

/// Gives cells of other processes what these have found. A cell that several processes have is
/// known by its points, which they share.
void vtkSurfaceMetrics::Measurement::ShowAtGhosts(Eigen::VectorXd& cells) const
{
  const SurfacePart& part = this->Part();
  if (part.Max(this->Ghosts.Cells.empty() ? 0.0 : 1.0) == 0.0)
  {
    return;
  }
  std::vector<double> numberOf(this->Surface.Mesh.P.rows(), -1.0);
  for (std::size_t k = 0; k < part.shared.size(); ++k)
  {
    numberOf[part.shared[k]] = part.numbers[k];
  }
  using Cells = std::map<vtkIdType, std::vector<double>>; // numbers of their points
  const auto add = [&](Cells& to, vtkIdType cell, int point)
  { to[cell].push_back(numberOf[point]); };
  const auto sort = [](std::vector<double>& numbers)
  {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  };
  Cells found;
  for (Eigen::Index f = 0; f < this->Surface.Mesh.F.rows(); ++f)
  {
    const vtkIdType cell = this->Surface.GetCell(f);
    for (int k = 0; k < 3 && cells(cell) > 0.0; ++k)
    {
      add(found, cell, this->Surface.Mesh.F(f, k));
    }
  }
  std::vector<double> rows;
  for (auto& [cell, numbers] : found)
  {
    sort(numbers);
    if (numbers.front() >= 0.0)
    {
      rows.insert(rows.end(), { cells(cell), static_cast<double>(numbers.size()) });
      rows.insert(rows.end(), numbers.begin(), numbers.end());
    }
  }
  rows = part.Concatenate(rows);
  std::map<std::vector<double>, double> counts;
  for (auto row = rows.begin(); row != rows.end();)
  {
    const auto begin = row + 2;
    const auto end = begin + static_cast<std::ptrdiff_t>(row[1]);
    counts[{ begin, end }] = *row;
    row = end;
  }
  Cells ghosts;
  for (std::size_t f = 0; f < this->Ghosts.Cells.size(); ++f)
  {
    for (const int i : this->Ghosts.Corners.row(static_cast<Eigen::Index>(f)))
    {
      add(ghosts, this->Ghosts.Cells[f], this->Surface.MeshPoint[i]);
    }
  }
  for (auto& [cell, numbers] : ghosts)
  {
    sort(numbers);
    const auto count = counts.find(numbers);
    cells(cell) = count != counts.end() ? count->second : 0.0;
  }
}

Pairs vtkSurfaceMetrics::Measurement::MeasureSelfIntersections() const
{
  Pairs pairs;
#ifdef SPHERICALSTYLE_WITH_CGAL
  Names names(this->Surface.Mesh.F.rows());
  std::iota(names.begin(), names.end(), this->FirstName);
  pairs = FindPairs(this->Surface.Mesh, names, this->Part());
  Eigen::VectorXd count = this->PerCell();
  const auto cellOf = [this](std::int64_t name)
  { return this->Surface.GetCell(static_cast<Eigen::Index>(name - this->FirstName)); };
  for (const auto& [f, g] : pairs)
  {
    const bool both = this->IsOwn(f) && this->IsOwn(g);
    if (this->IsOwn(f))
    {
      count(cellOf(f)) += 1.0;
    }
    if (this->IsOwn(g) && !(both && cellOf(f) == cellOf(g)))
    {
      count(cellOf(g)) += 1.0;
    }
  }
  this->ShowAtGhosts(count);
  this->AddCellArray("SelfIntersections", VTK_INT, count);
  this->AddCount("SelfIntersectionPairs", this->CountPairs(pairs));
  this->AddCount("SelfIntersectingTriangles", this->CountTriangles(pairs));
#else
  if (this->Part().IsWhole() || this->Part().processes->GetRank() == 0)
  {
    vtkWarningWithObjectMacro(this->Self,
      << InBlock(this->Self)
      << "self-intersections are not looked for: this library was built without CGAL. Switch "
         "FindSelfIntersections off to measure the rest without this warning");
  }
#endif
  return pairs;
}

void vtkSurfaceMetrics::Measurement::MeasureAreaRatios(
  const vtkSurfacePair& pair, const Shown& shown) const
{
  const Eigen::VectorXd before = SphericalStyle::TriangleAreas(pair.Rest.P, shown.F);
  const Eigen::VectorXd after = SphericalStyle::TriangleAreas(pair.Deformed, shown.F);
  Eigen::VectorXd cellBefore = this->PerCell();
  Eigen::VectorXd ratio = cellBefore;
  for (std::size_t f = 0; f < shown.Cells.size(); ++f)
  {
    cellBefore(shown.Cells[f]) += before(static_cast<Eigen::Index>(f));
    ratio(shown.Cells[f]) += after(static_cast<Eigen::Index>(f));
  }
  std::vector<char> counts(ratio.size(), 1);
  for (const vtkIdType cell : this->Ghosts.Cells)
  {
    counts[cell] = 0;
  }
  std::vector<double> counted;
  for (Eigen::Index cell = 0; cell < ratio.size(); ++cell)
  {
    if (cellBefore(cell) > 0.0)
    {
      ratio(cell) /= cellBefore(cell);
      if (counts[cell] != 0)
      {
        counted.push_back(ratio(cell));
      }
    }
  }
  this->AddCellArray("AreaRatio", VTK_DOUBLE, ratio);
  const Eigen::VectorXd ratios =
    Eigen::Map<Eigen::VectorXd>(counted.data(), static_cast<Eigen::Index>(counted.size()));
  this->AddNumber("SmallestAreaRatio", Least(ratios, this->Part()));
  this->AddNumber("LargestAreaRatio", Most(ratios, this->Part()));
  this->AddNumber("AreaRatioSpread", SphericalStyle::LogSpread(ratios, this->Part()));
}

void vtkSurfaceMetrics::Measurement::MeasureDeformation(
  const vtkSurfacePair& pair, bool closed) const
{
  using namespace SphericalStyle;
  const TriangleMesh& now = this->Surface.Mesh;
  const TriangleMesh& before = pair.Reference;
  const SurfacePart& part = this->Part();
  Eigen::Vector2d areas(TriangleAreas(now.P, now.F).sum(), TriangleAreas(before.P, before.F).sum());
  part.Sum(areas);
  this->AddNumber("AreaRatio", areas(0) / areas(1));
  const MeshEdges edgesBefore(before.F);
  const bool bothClosed = closed &&
    CountEdges(before.F, edgesBefore, { before.F, edgesBefore, pair.ReferencePart }).closed;
  this->AddNumber("VolumeRatio",
    VolumeIfClosed(now.P, now.F, part, bothClosed) /
      VolumeIfClosed(before.P, before.F, pair.ReferencePart, bothClosed));

  const Triangles& F = pair.Rest.F;
  const Shown shown = this->WithGhosts(F, pair.Triangle, pair.Point, pair.Rest.P);
  this->MeasureAreaRatios(pair, shown);
  const Matrices R = SurfaceRotations(pair.Rest, pair.Deformed, ThreadsToUse(0), pair.Part);
  const std::vector<char> turnedOver =
    SphericalStyle::TurnedOver(pair.Rest.P, pair.Deformed, shown.F, R);
  Eigen::VectorXd cells = this->PerCell();
  for (std::size_t f = 0; f < turnedOver.size(); ++f)
  {
    double& cell = cells(shown.Cells[f]);
    cell = std::max(cell, static_cast<double>(turnedOver[f]));
  }
  this->AddCellArray("TurnedOver", VTK_INT, cells);
  this->AddCount("TurnedOver",
    part.Sum(
      static_cast<double>(std::count(turnedOver.begin(), turnedOver.begin() + F.rows(), char(1)))));
  this->AddNumber("DetailError", DetailError(pair.Rest.P, pair.Deformed, F, R, pair.Part));
  const MeshEdges edges(F);
  this->AddNumber("DihedralChange",
    Degrees * DihedralChange(pair.Rest.P, pair.Deformed, F, edges, { F, edges, pair.Part }));
  this->AddNumber(
    "LargestDisplacement", Most((pair.Deformed - pair.Rest.P).rowwise().norm(), part));
}

void vtkSurfaceMetrics::Measurement::MeasureThicknessRatios(const vtkSurfacePair& pair) const
{
  const Eigen::VectorXd ratio =
    SphericalStyle::ThicknessRatios(pair.Rest, pair.Deformed, ThreadsToUse(0), pair.Part);
  Eigen::VectorXd ofInput = Eigen::VectorXd::Constant(this->Output->GetNumberOfPoints(), None);
  for (vtkIdType i = 0; i < ofInput.size(); ++i)
  {
    if (pair.Point[i] != vtkSurfaceMesh::NotMoved)
    {
      ofInput(i) = ratio(pair.Point[i]);
    }
  }
  this->Output->GetPointData()->AddArray(MakeArray("ThicknessRatio", VTK_DOUBLE, ofInput));
  std::vector<double> found;
  for (const double x : ThatCount(ratio, pair.Part))
  {
    if (!std::isnan(x))
    {
      found.push_back(x);
    }
  }
  const Eigen::VectorXd ratios =
    Eigen::Map<Eigen::VectorXd>(found.data(), static_cast<Eigen::Index>(found.size()));
  Eigen::Vector2d thinned(
    CountBelow(ratios, SphericalStyle::ThinnedBelow), static_cast<double>(ratios.size()));
  this->Part().Sum(thinned);
  const double smallest = Least(ratios, this->Part());
  this->AddNumber("SmallestThicknessRatio", thinned(1) > 0.0 ? smallest : None);
  this->AddNumber("ThinnedShare", thinned(1) > 0.0 ? thinned(0) / thinned(1) : None);
}

void vtkSurfaceMetrics::Measurement::MeasureNewSelfIntersections(
  const vtkSurfacePair& pair, const Pairs& now) const
{
#ifdef SPHERICALSTYLE_WITH_CGAL
  Names names(pair.Triangle.size());
  std::transform(pair.Triangle.begin(), pair.Triangle.end(), names.begin(),
    [this](int triangle) { return this->FirstName + triangle; });
  const Pairs before = FindPairs(pair.Rest, names, pair.Part);
  Pairs added;
  std::set_difference(
    now.begin(), now.end(), before.begin(), before.end(), std::back_inserter(added));
  this->AddCount("NewSelfIntersectionPairs", this->CountPairs(added));
  this->AddCount("NewSelfIntersectingTriangles", this->CountTriangles(added));
#else
  (void)pair;
  (void)now;
#endif
}

void vtkSurfaceMetrics::Measurement::Measure(vtkPolyData* reference)
{
  const SphericalStyle::TriangleMesh& mesh = this->Surface.Mesh;
  vtkSurfacePair pair; // first, since it may be refused
  if (reference)
  {
    pair =
      vtkMakeSurfacePair(this->Output, this->Surface, reference, this->Self->WeldCoincidentPoints);
  }
  this->Ghosts = vtkSurfaceMeshConversion::Ghosts(this->Output, this->Surface);
  this->FirstName = static_cast<std::int64_t>(
    SphericalStyle::CountBefore(this->Part(), static_cast<double>(mesh.F.rows())));
  const MeshEdges edges(mesh.F);
  const EdgePart edgePart(mesh.F, edges, this->Part());
  const SphericalStyle::EdgeCounts counts = SphericalStyle::CountEdges(mesh.F, edges, edgePart);
  this->MeasureEdges(counts);
  this->MeasureShape(counts.closed);
  this->MeasureQuality(edges, edgePart);
  this->Self->UpdateProgress(0.2);
  if (reference)
  {
    this->MeasureDeformation(pair, counts.closed);
    if (this->Self->MeasureThickness)
    {
      this->MeasureThicknessRatios(pair);
    }
  }
  if (this->Self->FindSelfIntersections && !this->IsAborted())
  {
    this->Self->UpdateProgress(0.3);
    const Pairs pairs = this->MeasureSelfIntersections();
    if (reference)
    {
      this->MeasureNewSelfIntersections(pair, pairs);
    }
  }
  if (this->Self->EstimateCondition && !this->IsAborted())
  {
    this->Self->UpdateProgress(0.6);
    this->MeasureCondition();
  }
}

//------------------------------------------------------------------------------------------------
vtkSurfaceMetrics::vtkSurfaceMetrics()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

void vtkSurfaceMetrics::SetReferenceConnection(vtkAlgorithmOutput* reference)
{
  this->SetInputConnection(REFERENCE, reference);
}

void vtkSurfaceMetrics::SetReferenceData(vtkPolyData* reference)
{
  this->SetInputData(REFERENCE, reference);
}

int vtkSurfaceMetrics::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  if (port == REFERENCE)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  else
  {
    TakeDataSet(info);
  }
  return 1;
}

int vtkSurfaceMetrics::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkSurfaceMetrics::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(this, outputVector, [&] { return this->Execute(inputVector, outputVector); });
}

bool vtkSurfaceMetrics::WorksOnParts(
  vtkInformationVector** inputVector, const vtkProcesses& processes) const
{
  vtkPolyData* reference = vtkPolyData::GetData(inputVector[REFERENCE], 0);
  const bool needsWhole = this->EstimateCondition || !this->WeldCoincidentPoints;
  // What differs between two processes counts as on the first one, which gathering leads to.
  return processes.AreAlike({ static_cast<double>(this->CenterMode), this->Center[0],
           this->Center[1], this->Center[2], this->FindSelfIntersections ? 1.0 : 0.0,
           this->MeasureThickness ? 1.0 : 0.0, needsWhole ? 1.0 : 0.0, this->Roundness,
           reference ? 1.0 : 0.0 }) &&
    !needsWhole;
}

int vtkSurfaceMetrics::RequestPart(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto processes = std::make_shared<const vtkProcesses>(this->Controller);
  if (!this->WorksOnParts(inputVector, *processes))
  {
    return WHOLE_IS_NEEDED;
  }
  return this->RunOnParts(inputVector, outputVector, *processes,
    [&] { this->Execute(inputVector, outputVector, processes); });
}

int vtkSurfaceMetrics::Execute(vtkInformationVector** inputVector,
  vtkInformationVector* outputVector, const std::shared_ptr<const vtkProcesses>& processes)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[MODEL], 0);
  vtkPolyData* reference = vtkPolyData::GetData(inputVector[REFERENCE], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  vtkTable* table = vtkTable::GetData(outputVector, 1);
  if (!IsSurface(this, inputVector[MODEL]))
  {
    return 0;
  }
  if (!processes && (!input || input->GetNumberOfPoints() == 0))
  {
    return 1;
  }

  this->SetProgressText("Measuring");
  RequireTarget(
    this->Roundness, this->CenterMode == CUSTOM_CENTER ? this->Center : nullptr, nullptr);
  const vtkSurfaceMesh surface = vtkSurfaceMeshConversion::FromPolyData(input,
    this->WeldCoincidentPoints, vtkSurfaceMeshConversion::TakePoints::OfTriangles, processes);
  output->ShallowCopy(input);
  const bool hasTriangles = surface.Part.Max(surface.Mesh.F.rows() > 0 ? 1.0 : 0.0) > 0.0;
  Measurement measurement{ this, surface, output, table };
  if (hasTriangles)
  {
    measurement.Measure(reference);
  }
  if (measurement.IsAborted()) // half of the measures are none
  {
    output->Initialize();
    table->Initialize();
    return 1;
  }
  const std::vector<double> bytes = processes ? processes->GetBytesOfAll() : std::vector<double>();
  if (processes && processes->GetRank() != 0)
  {
    return 1;
  }
  vtkStyleHistory::AddBytes(table, bytes);
  if (!hasTriangles)
  {
    Warn(this, "the input has no triangle with an area: there is nothing to measure");
  }
  Warn(this, vtkSurfaceMeshConversion::FannedRemark(surface));
  return 1;
}

void vtkSurfaceMetrics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CenterMode: " << this->CenterMode << "\n";
  os << indent << "Center: " << Triple(this->Center) << "\n";
  os << indent << "FindSelfIntersections: " << OnOff(this->FindSelfIntersections) << "\n";
  os << indent << "MeasureThickness: " << OnOff(this->MeasureThickness) << "\n";
  os << indent << "EstimateCondition: " << OnOff(this->EstimateCondition) << "\n";
  os << indent << "Roundness: " << this->Roundness << "\n";
  os << indent << "WeldCoincidentPoints: " << OnOff(this->WeldCoincidentPoints) << "\n";
}
