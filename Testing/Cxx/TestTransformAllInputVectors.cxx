// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Vectors and tensors turn with the surface [vectors]: three constant vectors show R, which is the
/// rotation closest to the change of the edges; all else is compared with that.
#include "FilterTesting.h"

#include "vtkBlockStyleFilter.h"
#include "vtkCubicStyleFilter.h"
#include "vtkMeshMorphingFilter.h"
#include "vtkNonlinearStyleFilter.h"
#include "vtkSphereProjectionFilter.h"
#ifdef SPHERICALSTYLE_WITH_CGAL
#include "vtkConvexProxyDeformFilter.h"
#endif

#include "vtkDataSetSurfaceFilter.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkUnstructuredGrid.h"

using namespace FilterTesting;

namespace
{
using Matrix = std::array<Vector, 3>;
constexpr const char* Axes[] = { "X", "Y", "Z" };
/// Of a tensor with 6 components.
constexpr int Symmetric[6][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 1, 2 }, { 0, 2 } };
const Vector Direction = { 3.0, -4.0, 12.0 };

template <typename Array>
void Add(vtkDataSetAttributes* to, const std::string& name, vtkIdType tuples,
  const std::vector<double>& value)
{
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(value.size()));
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    array->SetTuple(i, value.data());
  }
  to->AddArray(array);
}

void AddArrays(vtkDataSetAttributes* to, vtkIdType n)
{
  const auto& d = Direction;
  std::vector<double> full;
  std::vector<double> symmetric;
  for (int a = 0; a < 3; ++a)
  {
    for (int b = 0; b < 3; ++b)
    {
      full.push_back(a == 0 ? d[b] : 0.0); // x d^T
    }
  }
  for (const auto& [a, b] : Symmetric)
  {
    symmetric.push_back(d[a] * d[b]);
  }
  for (int k = 0; k < 3; ++k)
  {
    std::vector<double> axis(3, 0.0);
    axis[k] = 1.0;
    Add<vtkDoubleArray>(to, Axes[k], n, axis);
  }
  Add<vtkDoubleArray>(to, "Direction", n, { d[0], d[1], d[2] });
  Add<vtkFloatArray>(to, "Float", n, { 1.0, 0.0, 0.0 });
  Add<vtkDoubleArray>(to, "Full", n, full);
  Add<vtkDoubleArray>(to, "Symmetric", n, symmetric);
  Add<vtkIntArray>(to, "Whole", n, { 1.0, 2.0, 3.0 });
  Add<vtkDoubleArray>(to, "Pair", n, { 1.0, 2.0 });
  Add<vtkDoubleArray>(to, "Texture", n, { 0.25, 0.5, 0.75 });
  to->SetActiveTCoords("Texture");
  to->SetActiveVectors("Direction");
  to->SetActiveScalars("Direction");
  vtkNew<vtkDoubleArray> nameless;
  nameless->SetNumberOfComponents(3);
  nameless->SetNumberOfTuples(n);
  nameless->Fill(1.0);
  to->AddArray(nameless);
}

std::vector<double> Tuple(vtkDataSetAttributes* arrays, const char* name, vtkIdType i)
{
  vtkDataArray* array = arrays->GetArray(name);
  std::vector<double> tuple(array->GetNumberOfComponents());
  array->GetTuple(i, tuple.data());
  return tuple;
}

/// Column k is what became of axis k.
Matrix RotationAt(vtkDataSetAttributes* arrays, vtkIdType i)
{
  Matrix R;
  for (int k = 0; k < 3; ++k)
  {
    const std::vector<double> column = Tuple(arrays, Axes[k], i);
    for (int a = 0; a < 3; ++a)
    {
      R[a][k] = column[a];
    }
  }
  return R;
}

Vector Times(const Matrix& R, const Vector& v)
{
  Vector product;
  for (int a = 0; a < 3; ++a)
  {
    product[a] = vtkMath::Dot(R[a].data(), v.data());
  }
  return product;
}

/// All arrays against R, which must be a rotation.
void CheckArrays(Checker& check, vtkDataSetAttributes* arrays, vtkIdType n)
{
  double rotation = 0.0;
  double vectors = 0.0;
  double tensors = 0.0;
  double single = 0.0;
  bool kept = true;
  for (vtkIdType i = 0; i < n; ++i)
  {
    const Matrix R = RotationAt(arrays, i);
    for (int a = 0; a < 3; ++a)
    {
      for (int b = 0; b < 3; ++b)
      {
        rotation = std::max(
          rotation, std::abs(vtkMath::Dot(R[a].data(), R[b].data()) - (a == b ? 1.0 : 0.0)));
      }
    }
    double m[3][3];
    std::memcpy(m, R.data(), sizeof m);
    rotation = std::max(rotation, std::abs(vtkMath::Determinant3x3(m) - 1.0));
    const Vector turned = Times(R, Direction);
    const Vector x = { R[0][0], R[1][0], R[2][0] };
    const std::vector<double> direction = Tuple(arrays, "Direction", i);
    const std::vector<double> full = Tuple(arrays, "Full", i);
    const std::vector<double> symmetric = Tuple(arrays, "Symmetric", i);
    const std::vector<double> floats = Tuple(arrays, "Float", i);
    for (int a = 0; a < 3; ++a)
    {
      vectors = std::max(vectors, std::abs(direction[a] - turned[a]));
      single = std::max(single, std::abs(floats[a] - x[a]));
      for (int b = 0; b < 3; ++b)
      {
        tensors = std::max(tensors, std::abs(full[3 * a + b] - x[a] * turned[b]));
      }
    }
    for (int k = 0; k < 6; ++k)
    {
      const auto& [a, b] = Symmetric[k];
      tensors = std::max(tensors, std::abs(symmetric[k] - turned[a] * turned[b]));
    }
    kept = kept && Tuple(arrays, "Whole", i) == std::vector<double>({ 1.0, 2.0, 3.0 }) &&
      Tuple(arrays, "Pair", i) == std::vector<double>({ 1.0, 2.0 }) &&
      Tuple(arrays, "Texture", i) == std::vector<double>({ 0.25, 0.5, 0.75 });
  }
  check.AtMost(rotation, 1e-12, "R is a rotation");
  check.AtMost(vectors, 1e-11, "vectors");
  check.AtMost(tensors, 1e-10, "tensors");
  check.AtMost(single, 1e-6, "vectors of single precision");
  check(kept, "whole numbers, pairs and texture coordinates should stay");
  check(arrays->GetVectors() == arrays->GetArray("Direction") &&
      arrays->GetScalars() == arrays->GetArray("Direction") &&
      arrays->GetTCoords() == arrays->GetArray("Texture"),
    "active arrays should stay active");
}

/// sum over the triangles at a point, over their half-edges, of c e' e^T, row by row.
std::vector<Matrix> EdgeSums(vtkPolyData* rest, vtkPolyData* moved)
{
  std::vector<Matrix> sums(rest->GetNumberOfPoints(), Matrix{});
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < rest->GetNumberOfPolys(); ++c)
  {
    rest->GetPolys()->GetCellAtId(c, ids);
    Matrix sum = {};
    for (int k = 0; k < 3; ++k)
    {
      const vtkIdType u = ids->GetId((k + 1) % 3);
      const vtkIdType v = ids->GetId((k + 2) % 3);
      const Vector corner = PointOf(rest, ids->GetId(k));
      Vector a = PointOf(rest, u);
      Vector b = PointOf(rest, v);
      Vector e;
      vtkMath::Subtract(a.data(), b.data(), e.data());
      vtkMath::Subtract(a.data(), corner.data(), a.data());
      vtkMath::Subtract(b.data(), corner.data(), b.data());
      Vector normal;
      vtkMath::Cross(a.data(), b.data(), normal.data());
      const double weight = vtkMath::Dot(a.data(), b.data()) / vtkMath::Norm(normal.data());
      const Vector p = PointOf(moved, u);
      const Vector q = PointOf(moved, v);
      for (int i = 0; i < 3; ++i)
      {
        for (int j = 0; j < 3; ++j)
        {
          sum[i][j] += weight * (p[i] - q[i]) * e[j];
        }
      }
    }
    for (int k = 0; k < 3; ++k)
    {
      for (int i = 0; i < 3; ++i)
      {
        for (int j = 0; j < 3; ++j)
        {
          sums[ids->GetId(k)][i][j] += sum[i][j];
        }
      }
    }
  }
  return sums;
}

/// Of each cell: sum of the rotations at its points.
std::vector<Matrix> CornerSums(vtkPointSet* moved)
{
  std::vector<Matrix> sums(moved->GetNumberOfCells(), Matrix{});
  vtkNew<vtkIdList> ids;
  for (std::size_t c = 0; c < sums.size(); ++c)
  {
    moved->GetCellPoints(static_cast<vtkIdType>(c), ids);
    for (const vtkIdType id : *ids)
    {
      const Matrix R = RotationAt(moved->GetPointData(), id);
      for (int i = 0; i < 3; ++i)
      {
        for (int j = 0; j < 3; ++j)
        {
          sums[c][i][j] += R[i][j];
        }
      }
    }
  }
  return sums;
}

/// R is the closest rotation to S if and only if R^T S is symmetric with a sum of any two
/// eigenvalues of 0 or more: S turned back has no rotation left.
void CheckClosest(Checker& check, vtkDataSetAttributes* arrays, const std::vector<Matrix>& S)
{
  double skew = 0.0;
  bool nearest = true;
  for (std::size_t i = 0; i < S.size(); ++i)
  {
    const Matrix R = RotationAt(arrays, static_cast<vtkIdType>(i));
    double H[3][3];
    double size = 0.0;
    for (int a = 0; a < 3; ++a)
    {
      for (int b = 0; b < 3; ++b)
      {
        H[a][b] = 0.0;
        for (int k = 0; k < 3; ++k)
        {
          H[a][b] += R[k][a] * S[i][k][b];
        }
        size = std::max(size, std::abs(H[a][b]));
      }
    }
    double values[3];
    double vectors[3][3];
    for (int a = 0; a < 3; ++a)
    {
      for (int b = 0; b < a; ++b)
      {
        skew = std::max(skew, std::abs(H[a][b] - H[b][a]) / size);
      }
    }
    vtkMath::Diagonalize3x3(H, values, vectors);
    std::sort(values, values + 3);
    nearest = nearest && values[0] + values[1] > -1e-9 * size;
  }
  check.AtMost(skew, 1e-9, "R^T S is symmetric");
  check(nearest, "no other rotation should be closer");
}

Surface MakeModel()
{
  Surface model = MakeEllipsoid({ 1.0, 0.7, 2.0 }, Faces::Triangles, 20, 15);
  for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i) // a head to one side
  {
    Vector p = PointOf(model, i);
    p[0] += 0.3 * p[2] * p[2];
    model->GetPoints()->SetPoint(i, p.data());
  }
  AddArrays(model->GetPointData(), model->GetNumberOfPoints());
  AddArrays(model->GetCellData(), model->GetNumberOfCells());
  return model;
}

template <typename FilterType, typename SetUp>
void CheckFilter(Checker& check, const std::string& about, const SetUp& setUp)
{
  check.About(about);
  const Surface model = MakeModel();
  Watched<FilterType> filter(model);
  setUp(filter.Get());
  const auto unturned = [&](vtkDataSetAttributes* before, vtkDataSetAttributes* after)
  {
    return before->GetArray("Direction") == after->GetArray("Direction") &&
      before->GetArray("Full") == after->GetArray("Full");
  };
  vtkPolyData* output = filter.Output();
  check(!filter->GetTransformAllInputVectors() &&
      unturned(model->GetPointData(), output->GetPointData()) &&
      unturned(model->GetCellData(), output->GetCellData()),
    "arrays should be passed by default");

  filter->TransformAllInputVectorsOn();
  output = filter.Output();
  check(filter.Errors.empty(), "there should be no error");
  CheckArrays(check, output->GetPointData(), output->GetNumberOfPoints());
  CheckArrays(check, output->GetCellData(), output->GetNumberOfCells());
  CheckClosest(check, output->GetPointData(), EdgeSums(model, output));
  CheckClosest(check, output->GetCellData(), CornerSums(output));
  check(Tuple(model->GetPointData(), "Direction", 7) ==
      std::vector<double>(Direction.begin(), Direction.end()),
    "the input should stay as it is");
  double most = 0.0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const std::vector<double> x = Tuple(output->GetPointData(), "X", i);
    most = std::max(most, 1.0 - x[0]);
  }
  check(most > 1e-4, "something should have turned");
}

/// What does not move keeps its bits; in between, the surface turns by less.
void OutsideOfARegion(Checker& check)
{
  check.About("outside of a region");
  const Surface model = MakeModel();
  vtkNew<vtkDoubleArray> region;
  region->SetName("Region");
  for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
  {
    region->InsertNextValue(PointOf(model, i)[2] > 0.5 ? 1.0 : 0.0);
  }
  model->GetPointData()->AddArray(region);
  WatchedDefaults filter(model);
  filter->TransformAllInputVectorsOn();
  filter->SetInputArrayToProcess(4, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Region");
  vtkPolyData* output = filter.Output();
  bool kept = true;
  bool turned = false;
  for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
  {
    const bool same =
      Tuple(output->GetPointData(), "Direction", i) == Tuple(model->GetPointData(), "Direction", i);
    const bool outside = PointOf(model, i)[2] < 0.1; // and no triangle in common with the region
    kept = kept && (!outside || same);
    turned = turned || !same;
  }
  check(kept && turned, "only vectors in the region should turn");
}

/// Sizes whose squares no number can hold; what is not a number stays away from other points.
void AnySize(Checker& check)
{
  for (const double size : { 1e-200, 1e200 })
  {
    check.About("size " + vtkVariant(size).ToString());
    const Surface model = MakeModel();
    model->GetPointData()->GetArray("Direction")->SetComponent(3, 1, std::nan(""));
    WatchedDefaults reference(model);
    reference->TransformAllInputVectorsOn();
    Surface scaled = Surface::New();
    scaled->DeepCopy(model);
    for (vtkIdType i = 0; i < scaled->GetNumberOfPoints(); ++i)
    {
      Vector p = PointOf(model, i);
      vtkMath::MultiplyScalar(p.data(), size);
      scaled->GetPoints()->SetPoint(i, p.data());
    }
    WatchedDefaults filter(scaled);
    filter->TransformAllInputVectorsOn();
    double difference = 0.0;
    for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
    {
      for (int k = 0; k < 3 && i != 3; ++k)
      {
        difference = std::max(difference,
          std::abs(Tuple(filter.Output()->GetPointData(), "Direction", i)[k] -
            Tuple(reference.Output()->GetPointData(), "Direction", i)[k]));
      }
    }
    check.AtMost(difference, 1e-9, "vectors should not depend on the size");
  }
}
/// Around the origin, with all arrays.
vtkSmartPointer<vtkImageData> MakeImage()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(6, 5, 7);
  image->SetOrigin(-0.5, -0.4, -0.9);
  image->SetSpacing(0.2, 0.2, 0.3);
  AddArrays(image->GetPointData(), image->GetNumberOfPoints());
  AddArrays(image->GetCellData(), image->GetNumberOfCells());
  return image;
}

/// The same in tetrahedra, none like another, and a line that sticks out.
vtkSmartPointer<vtkUnstructuredGrid> MakeVolume()
{
  vtkNew<vtkDataSetTriangleFilter> cut;
  cut->SetInputData(MakeImage());
  cut->Update();
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->CopyStructure(cut->GetOutput());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    Vector p;
    grid->GetPoint(i, p.data());
    points->InsertNextPoint(
      p[0] + 0.2 * p[2] * p[2], p[1] + 0.03 * std::sin(20.0 * p[0]), p[2] + 0.1 * p[0] * p[1]);
  }
  const vtkIdType ends[] = { 0, points->InsertNextPoint(-2.0, -2.0, -2.0) };
  grid->SetPoints(points);
  grid->InsertNextCell(VTK_LINE, 2, ends);
  AddArrays(grid->GetPointData(), grid->GetNumberOfPoints());
  AddArrays(grid->GetCellData(), grid->GetNumberOfCells());
  return grid;
}

/// Of each point: sum over the tetrahedra at it of their volume times their Jacobian.
std::vector<Matrix> JacobianSums(vtkPointSet* rest, vtkPointSet* moved)
{
  std::vector<Matrix> sums(rest->GetNumberOfPoints(), Matrix{});
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < rest->GetNumberOfCells(); ++c)
  {
    rest->GetCellPoints(c, ids);
    if (rest->GetCellType(c) != VTK_TETRA)
    {
      continue;
    }
    double before[3][3];
    double after[3][3];
    for (int k = 0; k < 3; ++k)
    {
      for (int a = 0; a < 3; ++a)
      {
        before[a][k] = rest->GetPoint(ids->GetId(k + 1))[a] - rest->GetPoint(ids->GetId(0))[a];
        after[a][k] = moved->GetPoint(ids->GetId(k + 1))[a] - moved->GetPoint(ids->GetId(0))[a];
      }
    }
    double inverse[3][3];
    double J[3][3];
    vtkMath::Invert3x3(before, inverse);
    vtkMath::Multiply3x3(after, inverse, J);
    const double volume = std::abs(vtkMath::Determinant3x3(before));
    for (const vtkIdType id : *ids)
    {
      for (int k = 0; k < 9; ++k)
      {
        sums[id][k / 3][k % 3] += volume * J[k / 3][k % 3];
      }
    }
  }
  return sums;
}

/// The surface of a volume, moved.
template <typename Motion>
Surface MovedSurface(vtkDataSet* volume, const Motion& motion)
{
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(volume);
  surface->Update();
  auto moved = Surface::New();
  moved->CopyStructure(surface->GetOutput());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> displacement;
  displacement->SetName("Displacement");
  displacement->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < moved->GetNumberOfPoints(); ++i)
  {
    const Vector p = PointOf(surface->GetOutput(), i);
    const Vector q = motion(p);
    points->InsertNextPoint(q.data());
    displacement->InsertNextTuple3(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
  }
  moved->SetPoints(points);
  moved->GetPointData()->AddArray(displacement);
  return moved;
}

/// Active ones along x.
void AddNormals(vtkDataSetAttributes* arrays, vtkIdType n)
{
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < n; ++i)
  {
    normals->InsertNextTuple3(1.0, 0.0, 0.0);
  }
  arrays->SetNormals(normals);
}

/// They turn by R and are still the active ones.
void CheckNormals(Checker& check, vtkDataSet* output, const Matrix& R)
{
  double difference = 0.0;
  for (vtkDataSetAttributes* arrays : { static_cast<vtkDataSetAttributes*>(output->GetPointData()),
         static_cast<vtkDataSetAttributes*>(output->GetCellData()) })
  {
    check(arrays->GetNormals() != nullptr, "normals should be active");
    for (vtkIdType i = 0; i < arrays->GetNumberOfTuples(); ++i)
    {
      const std::vector<double> n = Tuple(arrays, "Normals", i);
      for (int a = 0; a < 3; ++a)
      {
        difference = std::max(difference, std::abs(n[a] - R[a][0]));
      }
    }
  }
  check.AtMost(difference, 1e-12, "normals turn, whether or not vectors do");
}

/// Volumes and images that go with a surface.
void Morphing(Checker& check)
{
  const Matrix R = { { { 0.36, 0.48, -0.8 }, { -0.8, 0.6, 0.0 }, { 0.48, 0.64, 0.6 } } };
  const auto rigid = [&](const Vector& p)
  {
    Vector q = Times(R, p);
    q[1] += 3.0;
    return q;
  };
  const auto twist = [](const Vector& p)
  {
    const double c = std::cos(0.8 * p[2]);
    const double s = std::sin(0.8 * p[2]);
    return Vector{ c * p[0] - s * p[1], s * p[0] + c * p[1], p[2] + 0.3 * p[0] * p[0] };
  };
  const auto top = [](const Vector& p) {
    return Vector{ p[0], p[1], p[2] > 0.85 ? p[2] + 0.2 * p[0] : p[2] };
  };
  const auto volume = MakeVolume();
  const auto image = MakeImage();
  for (vtkDataSet* input : { static_cast<vtkDataSet*>(volume), static_cast<vtkDataSet*>(image) })
  {
    AddNormals(input->GetPointData(), input->GetNumberOfPoints());
    AddNormals(input->GetCellData(), input->GetNumberOfCells());
  }
  for (vtkDataSet* input : { static_cast<vtkDataSet*>(volume), static_cast<vtkDataSet*>(image) })
  {
    check.About(std::string("morphing: ") + input->GetClassName());
    Watched<vtkMeshMorphingFilter> filter;
    const auto run = [&](const Surface& surface)
    {
      filter->SetInputDataObject(0, input);
      filter->SetSurfaceData(surface);
      filter->Update();
      return vtkPointSet::SafeDownCast(filter->GetOutputDataObject(0));
    };
    vtkPointSet* output = run(MovedSurface(volume, rigid));
    check(!filter->GetTransformAllInputVectors() &&
        output->GetPointData()->GetArray("Direction") ==
          input->GetPointData()->GetArray("Direction") &&
        output->GetCellData()->GetArray("Full") == input->GetCellData()->GetArray("Full"),
      "arrays should be passed by default");
    CheckNormals(check, output, R);

    filter->TransformAllInputVectorsOn();
    output = run(MovedSurface(volume, rigid));
    check(filter.Errors.empty(), "there should be no error");
    CheckNormals(check, output, R);
    double difference = 0.0;
    for (vtkDataSetAttributes* arrays :
      { static_cast<vtkDataSetAttributes*>(output->GetPointData()),
        static_cast<vtkDataSetAttributes*>(output->GetCellData()) })
    {
      CheckArrays(check, arrays, arrays->GetNumberOfTuples());
      for (vtkIdType i = 0; i < arrays->GetNumberOfTuples(); ++i)
      {
        const Matrix own = RotationAt(arrays, i);
        for (int k = 0; k < 9; ++k)
        {
          difference = std::max(difference, std::abs(own[k / 3][k % 3] - R[k / 3][k % 3]));
        }
      }
    }
    check.AtMost(difference, 1e-12, "a surface that moves rigidly turns all vectors alike");
    vtkDataArray* displacement = output->GetPointData()->GetArray("Displacement");
    check.AtMost(
      std::abs(displacement->GetComponent(0, 0) + input->GetPoint(0)[0] - output->GetPoint(0)[0]),
      1e-12, "displacements do not turn");

    output = run(MovedSurface(volume, twist));
    check(filter.Errors.empty(), "there should be no error");
    CheckArrays(check, output->GetPointData(), output->GetNumberOfPoints());
    CheckArrays(check, output->GetCellData(), output->GetNumberOfCells());
    CheckClosest(check, output->GetCellData(), CornerSums(output));
    if (input == volume)
    {
      std::vector<Matrix> sums = JacobianSums(volume, output);
      sums.pop_back(); // the end of the line, which the surface nearby turns
      CheckClosest(check, output->GetPointData(), sums);
    }

    output = run(MovedSurface(volume, [](const Vector& p) { return p; }));
    check(SameArray(output->GetPointData()->GetNormals(), input->GetPointData()->GetNormals()) &&
        SameArray(output->GetPointData()->GetArray("Direction"),
          input->GetPointData()->GetArray("Direction")) &&
        SameArray(output->GetCellData()->GetArray("Full"), input->GetCellData()->GetArray("Full")),
      "where nothing moves all bits stay");
    output = run(MovedSurface(volume, top));
    double most = 0.0;
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      most = std::max(most, 1.0 - Tuple(output->GetPointData(), "X", i)[0]);
    }
    check(filter.Errors.empty() && most > 1e-4 && most < 0.1, "what moves turns, and no more");
  }
}
}

int TestTransformAllInputVectors(int, char*[])
{
  Checker check;
  CheckFilter<vtkSphericalStyleFilter>(check, "closed form", SetUpDefaults);
  CheckFilter<vtkSphericalStyleFilter>(check, "energy", SetUpUniform);
  CheckFilter<vtkNonlinearStyleFilter>(check, "nonlinear", [](auto*) {});
  CheckFilter<vtkCubicStyleFilter>(check, "cube", [](auto*) {});
  CheckFilter<vtkBlockStyleFilter>(check, "blocks", [](auto*) {});
  CheckFilter<vtkSphereProjectionFilter>(check, "projection", [](auto*) {});
#ifdef SPHERICALSTYLE_WITH_CGAL
  CheckFilter<vtkConvexProxyDeformFilter>(check, "proxy",
    [](vtkConvexProxyDeformFilter* f)
    {
      f->SetRefineLongEdgesToOff();
      f->SetBlend(0.5);
    });
#endif
  OutsideOfARegion(check);
  AnySize(check);
  Morphing(check);
  return check.Result();
}
