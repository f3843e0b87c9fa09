// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceMetrics.h"

#include "vtkFilterSupport.h"
#include "vtkSurfacePair.h"

#include "DeformationMeasures.h"
#include "EdgeWeights.h"
#include "MatrixCondition.h"
#include "MeshQuality.h"
#include "SurfaceMeasures.h"
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
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

using SphericalStyle::MeshEdges;
using SphericalStyle::Points;
using SphericalStyle::Triangles;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkSurfaceMetrics);

namespace
{
constexpr double Degrees = 180.0 / SphericalStyle::Pi;
constexpr double ConditionTolerance = 1e-6;
constexpr double None = std::numeric_limits<double>::quiet_NaN();
using Pairs = std::vector<std::array<int, 2>>;

double VolumeIfClosed(const Points& P, const Triangles& F, bool closed)
{
  return closed ? SphericalStyle::EnclosedVolume(P, F) : None;
}

Eigen::Index CountBelow(const Eigen::VectorXd& x, double limit)
{
  return (x.array() < limit).count();
}

double Rms(const Eigen::VectorXd& x)
{
  return x.size() > 0 ? std::sqrt(x.squaredNorm() / static_cast<double>(x.size())) : 0.0;
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
/// Triangles that a pair names.
vtkIdType CountTriangles(const Pairs& pairs)
{
  std::vector<int> triangles;
  for (const auto& pair : pairs)
  {
    triangles.insert(triangles.end(), pair.begin(), pair.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return std::unique(triangles.begin(), triangles.end()) - triangles.begin();
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

  void AddArray(vtkDataArray* array) const
  {
    this->Table->AddColumn(array);
    this->Output->GetFieldData()->AddArray(array);
  }
  void AddCount(const char* name, vtkIdType value) const
  {
    vtkNew<vtkIdTypeArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
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
  double& AtCell(Eigen::VectorXd& values, std::size_t triangle) const
  {
    return values(this->Surface.GetCell(static_cast<Eigen::Index>(triangle)));
  }

  void MeasureEdges(const MeshEdges& edges, const SphericalStyle::EdgeCounts& counts,
    const SphericalStyle::MeshTopology& topology) const;
  void MeasureShape(bool closed) const;
  void MeasureQuality(const MeshEdges& edges) const;
  void MeasureCondition(const SphericalStyle::MeshTopology& topology) const;
  Pairs MeasureSelfIntersections() const;
  void MeasureDeformation(const vtkSurfacePair& pair, bool closed) const;
  void MeasureAreaRatios(const vtkSurfacePair& pair) const;
  void MeasureThicknessRatios(const vtkSurfacePair& pair) const;
  void MeasureNewSelfIntersections(const vtkSurfacePair& pair, const Pairs& now) const;
  void Measure(vtkPolyData* reference) const;
};

void vtkSurfaceMetrics::Measurement::MeasureEdges(const MeshEdges& edges,
  const SphericalStyle::EdgeCounts& counts, const SphericalStyle::MeshTopology& topology) const
{
  const vtkIdType n = topology.GetNumberOfPoints();
  const vtkIdType m = topology.GetNumberOfTriangles();
  this->AddCount("Points", n);
  this->AddCount("Triangles", m);
  this->AddCount("DegenerateTriangles", this->Surface.DegenerateTriangles);
  this->AddCount("Edges", edges.GetNumberOfEdges());
  this->AddCount("BorderEdges", counts.border);
  this->AddCount("NonManifoldEdges", counts.nonManifold);
  this->AddCount("MisorientedEdges", counts.misoriented);
  this->AddCount("Closed", counts.closed);
  this->AddCount("Components", topology.GetNumberOfComponents());
  this->AddCount("EulerCharacteristic", n - edges.GetNumberOfEdges() + m);
}

void vtkSurfaceMetrics::Measurement::MeasureShape(bool closed) const
{
  using namespace SphericalStyle;
  const Points& P = this->Surface.Mesh.P;
  const Triangles& F = this->Surface.Mesh.F;
  this->AddNumber("Area", TriangleAreas(P, F).sum());
  this->AddNumber("Volume", VolumeIfClosed(P, F, closed));
  this->AddNumber("Sphericity", closed ? Sphericity(P, F) : None);

  const Eigen::Vector3d center =
    TargetSphere(P, F, static_cast<SphericalStyle::CenterMode>(this->Self->CenterMode),
      RadiusMode::EqualArea, { Eigen::Vector3d(this->Self->Center), 1.0 })
      .center;
  const Eigen::VectorXd cosines = RadialCosines(P, PointNormals(P, F), center);
  this->AddPosition("Center", center);
  this->AddNumber("RadiusSpread", RadiusSpread(P, center));
  this->AddNumber("OverhangShare",
    static_cast<double>(CountBelow(cosines, -RightAngle)) / static_cast<double>(P.rows()));
  this->AddPointArray("RadialCosine", cosines);

  const FittedSphere fitted = FitSphere(P);
  this->AddPosition("FittedCenter", fitted.center);
  this->AddNumber("FittedRadius", fitted.radius);
  this->AddNumber("FittedSphereError", fitted.error);
}

void vtkSurfaceMetrics::Measurement::MeasureQuality(const MeshEdges& edges) const
{
  using namespace SphericalStyle;
  const Points& P = this->Surface.Mesh.P;
  const Triangles& F = this->Surface.Mesh.F;
  const Eigen::MatrixX2d angles = ExtremeAngles(P, F);
  Eigen::VectorXd smallest = this->PerCell();
  Eigen::VectorXd largest = smallest;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    double& least = this->AtCell(smallest, f);
    double& most = this->AtCell(largest, f);
    least = most > 0.0 ? std::min(least, angles(f, 0)) : angles(f, 0);
    most = std::max(most, angles(f, 1));
  }
  this->AddCellArray("SmallestAngle", VTK_DOUBLE, smallest);
  this->AddCellArray("LargestAngle", VTK_DOUBLE, largest);
  this->AddNumber("SmallestAngle", angles.col(0).minCoeff());
  this->AddNumber("LargestAngle", angles.col(1).maxCoeff());
  const Eigen::VectorXd cosines = (angles.col(1) / Degrees).array().cos();
  this->AddNumber("ObtuseShare",
    static_cast<double>(CountBelow(cosines, -RightAngle)) / static_cast<double>(F.rows()));
  this->AddNumber("RmsDihedral", Degrees * Rms(DihedralAngles(P, F, edges)));

  const WeightReport weights = CheckWeights(HalfEdgeCotangents(P, F), edges);
  this->AddCount("NegativeWeights", weights.negative);
  this->AddNumber("LambdaStar", weights.lambdaStar);

  const OppositionReport opposition = FindOpposition(P, PointNormals(P, F), F, edges);
  this->AddCount("OpposedEdges", opposition.edges);
  this->AddPointArray("Opposition", opposition.share);
}

void vtkSurfaceMetrics::Measurement::MeasureCondition(
  const SphericalStyle::MeshTopology& topology) const
{
  const SphericalStyle::HalfEdgeScalars k =
    SphericalStyle::HalfEdgeCotangents(this->Surface.Mesh.P, this->Surface.Mesh.F).array() +
    0.5 * this->Self->Roundness;
  const SphericalStyle::MatrixCondition condition =
    SphericalStyle::EstimateCondition(topology, k, 0.5 * ConditionTolerance);
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

Pairs vtkSurfaceMetrics::Measurement::MeasureSelfIntersections() const
{
  Pairs pairs;
#ifdef SPHERICALSTYLE_WITH_CGAL
  pairs = SphericalStyle::SelfIntersections(this->Surface.Mesh);
  Eigen::VectorXd count = this->PerCell();
  for (const auto& [f, g] : pairs)
  {
    this->AtCell(count, f) += 1.0;
    if (this->Surface.GetCell(f) != this->Surface.GetCell(g))
    {
      this->AtCell(count, g) += 1.0;
    }
  }
  this->AddCellArray("SelfIntersections", VTK_INT, count);
  this->AddCount("SelfIntersectionPairs", static_cast<vtkIdType>(pairs.size()));
  this->AddCount("SelfIntersectingTriangles", CountTriangles(pairs));
#else
  vtkWarningWithObjectMacro(this->Self,
    << InBlock(this->Self)
    << "self-intersections are not looked for: this library was built without CGAL. Switch "
       "FindSelfIntersections off to measure the rest without this warning");
#endif
  return pairs;
}

void vtkSurfaceMetrics::Measurement::MeasureAreaRatios(const vtkSurfacePair& pair) const
{
  const Triangles& F = pair.Rest.F;
  const Eigen::VectorXd before = SphericalStyle::TriangleAreas(pair.Rest.P, F);
  const Eigen::VectorXd after = SphericalStyle::TriangleAreas(pair.Deformed, F);
  Eigen::VectorXd cellBefore = this->PerCell();
  Eigen::VectorXd ratio = cellBefore;
  for (std::size_t f = 0; f < pair.Triangle.size(); ++f)
  {
    this->AtCell(cellBefore, pair.Triangle[f]) += before(static_cast<Eigen::Index>(f));
    this->AtCell(ratio, pair.Triangle[f]) += after(static_cast<Eigen::Index>(f));
  }
  std::vector<double> ratios;
  for (Eigen::Index cell = 0; cell < ratio.size(); ++cell)
  {
    if (cellBefore(cell) > 0.0)
    {
      ratio(cell) /= cellBefore(cell);
      ratios.push_back(ratio(cell));
    }
  }
  this->AddCellArray("AreaRatio", VTK_DOUBLE, ratio);
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  this->AddNumber("SmallestAreaRatio", *least);
  this->AddNumber("LargestAreaRatio", *most);
  this->AddNumber("AreaRatioSpread",
    SphericalStyle::LogSpread(
      Eigen::Map<Eigen::VectorXd>(ratios.data(), static_cast<Eigen::Index>(ratios.size()))));
}

void vtkSurfaceMetrics::Measurement::MeasureDeformation(
  const vtkSurfacePair& pair, bool closed) const
{
  using namespace SphericalStyle;
  const TriangleMesh& now = this->Surface.Mesh;
  const TriangleMesh& before = pair.Reference;
  this->AddNumber(
    "AreaRatio", TriangleAreas(now.P, now.F).sum() / TriangleAreas(before.P, before.F).sum());
  const bool bothClosed = closed && CountEdges(before.F, MeshEdges(before.F)).closed;
  this->AddNumber("VolumeRatio",
    VolumeIfClosed(now.P, now.F, bothClosed) / VolumeIfClosed(before.P, before.F, bothClosed));
  this->MeasureAreaRatios(pair);

  const Triangles& F = pair.Rest.F;
  const Matrices R = SurfaceRotations(pair.Rest, pair.Deformed, ThreadsToUse(0));
  const std::vector<char> turnedOver = SphericalStyle::TurnedOver(pair.Rest.P, pair.Deformed, F, R);
  Eigen::VectorXd cells = this->PerCell();
  for (std::size_t f = 0; f < turnedOver.size(); ++f)
  {
    double& cell = this->AtCell(cells, pair.Triangle[f]);
    cell = std::max(cell, static_cast<double>(turnedOver[f]));
  }
  this->AddCellArray("TurnedOver", VTK_INT, cells);
  this->AddCount("TurnedOver", std::count(turnedOver.begin(), turnedOver.end(), 1));
  this->AddNumber("DetailError", DetailError(pair.Rest.P, pair.Deformed, F, R));
  this->AddNumber(
    "DihedralChange", Degrees * DihedralChange(pair.Rest.P, pair.Deformed, F, MeshEdges(F)));
  this->AddNumber("LargestDisplacement", (pair.Deformed - pair.Rest.P).rowwise().norm().maxCoeff());
}

void vtkSurfaceMetrics::Measurement::MeasureThicknessRatios(const vtkSurfacePair& pair) const
{
  std::vector<int> points(pair.Rest.P.rows());
  std::iota(points.begin(), points.end(), 0);
  const SphericalStyle::ThicknessProbes probes =
    SphericalStyle::PlaceThicknessProbes(pair.Rest, points, ThreadsToUse(0));
  const Eigen::VectorXd found = SphericalStyle::ThicknessRatios(pair.Rest, pair.Deformed, probes);
  Eigen::VectorXd ratio = Eigen::VectorXd::Constant(pair.Rest.P.rows(), None);
  ratio(probes.points) = found;
  Eigen::VectorXd ofInput = Eigen::VectorXd::Constant(this->Output->GetNumberOfPoints(), None);
  for (vtkIdType i = 0; i < ofInput.size(); ++i)
  {
    if (pair.Point[i] != vtkSurfaceMesh::NotMoved)
    {
      ofInput(i) = ratio(pair.Point[i]);
    }
  }
  this->Output->GetPointData()->AddArray(MakeArray("ThicknessRatio", VTK_DOUBLE, ofInput));
  const bool any = found.size() > 0;
  this->AddNumber("SmallestThicknessRatio", any ? found.minCoeff() : None);
  this->AddNumber("ThinnedShare",
    any ? static_cast<double>(CountBelow(found, SphericalStyle::ThinnedBelow)) /
        static_cast<double>(found.size())
        : None);
}

void vtkSurfaceMetrics::Measurement::MeasureNewSelfIntersections(
  const vtkSurfacePair& pair, const Pairs& now) const
{
#ifdef SPHERICALSTYLE_WITH_CGAL
  Pairs before = SphericalStyle::SelfIntersections(pair.Rest);
  for (auto& [f, g] : before)
  {
    f = pair.Triangle[f];
    g = pair.Triangle[g];
  }
  Pairs added;
  std::set_difference(
    now.begin(), now.end(), before.begin(), before.end(), std::back_inserter(added));
  this->AddCount("NewSelfIntersectionPairs", static_cast<vtkIdType>(added.size()));
  this->AddCount("NewSelfIntersectingTriangles", CountTriangles(added));
#else
  (void)pair;
  (void)now;
#endif
}

void vtkSurfaceMetrics::Measurement::Measure(vtkPolyData* reference) const
{
  const SphericalStyle::TriangleMesh& mesh = this->Surface.Mesh;
  vtkSurfacePair pair; // first, since it may be refused
  if (reference)
  {
    pair =
      vtkMakeSurfacePair(this->Output, this->Surface, reference, this->Self->WeldCoincidentPoints);
  }
  const MeshEdges edges(mesh.F);
  const SphericalStyle::EdgeCounts counts = SphericalStyle::CountEdges(mesh.F, edges);
  const SphericalStyle::MeshTopology topology(mesh.F, static_cast<int>(mesh.P.rows()));
  this->MeasureEdges(edges, counts, topology);
  this->MeasureShape(counts.closed);
  this->MeasureQuality(edges);
  this->Self->UpdateProgress(0.2);
  if (reference)
  {
    this->MeasureDeformation(pair, counts.closed);
    if (this->Self->MeasureThickness)
    {
      this->MeasureThicknessRatios(pair);
    }
  }
  if (this->Self->FindSelfIntersections && !Aborted(this->Self))
  {
    this->Self->UpdateProgress(0.3);
    const Pairs pairs = this->MeasureSelfIntersections();
    if (reference)
    {
      this->MeasureNewSelfIntersections(pair, pairs);
    }
  }
  if (this->Self->EstimateCondition && !Aborted(this->Self))
  {
    this->Self->UpdateProgress(0.6);
    this->MeasureCondition(topology);
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

int vtkSurfaceMetrics::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[MODEL], 0);
  vtkPolyData* reference = vtkPolyData::GetData(inputVector[REFERENCE], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  vtkTable* table = vtkTable::GetData(outputVector, 1);
  if (!IsSurface(this, inputVector[MODEL]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }

  this->SetProgressText("Measuring");
  RequireTarget(
    this->Roundness, this->CenterMode == CUSTOM_CENTER ? this->Center : nullptr, nullptr);
  const vtkSurfaceMesh surface =
    vtkSurfaceMeshConversion::FromPolyData(input, this->WeldCoincidentPoints);
  output->ShallowCopy(input);
  if (surface.Mesh.F.rows() > 0)
  {
    Measurement{ this, surface, output, table }.Measure(reference);
  }
  if (Aborted(this)) // half of the measures are none
  {
    output->Initialize();
    table->Initialize();
    return 1;
  }
  if (surface.Mesh.F.rows() == 0)
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
