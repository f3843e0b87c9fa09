// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTurnedArrays.h"

#include "LocalStep.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <vector>

namespace
{
/// Components xx, yy, zz, xy, yz, xz, as everywhere in VTK.
constexpr std::array<std::array<int, 2>, 6> SymmetricComponents = { { { 0, 0 }, { 1, 1 }, { 2, 2 },
  { 0, 1 }, { 1, 2 }, { 0, 2 } } };

/// R v of a vector, R T R^T of a tensor.
void TurnTuple(const Eigen::Matrix3d& R, int components, double* tuple)
{
  if (components == 3)
  {
    Eigen::Map<Eigen::Vector3d> v(tuple);
    v = (R * v).eval();
  }
  else if (components == 9)
  {
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> T(tuple);
    T = (R * T * R.transpose()).eval();
  }
  else
  {
    Eigen::Matrix3d T;
    for (int k = 0; k < 6; ++k)
    {
      const auto [a, b] = SymmetricComponents[k];
      T(a, b) = T(b, a) = tuple[k];
    }
    T = (R * T * R.transpose()).eval();
    for (int k = 0; k < 6; ++k)
    {
      const auto [a, b] = SymmetricComponents[k];
      tuple[k] = T(a, b);
    }
  }
}

enum class Kind
{
  Vectors, ///< and tensors
  Normals
};

/// @param count  of points or cells: an array of another length belongs to none of them
bool IsTurned(vtkDataSetAttributes* arrays, vtkDataArray* array, vtkIdType count, Kind kind)
{
  const int components = array->GetNumberOfComponents();
  const int type = array->GetDataType();
  return array->GetNumberOfTuples() == count &&
    (components == 3 || components == 6 || components == 9) &&
    (type == VTK_FLOAT || type == VTK_DOUBLE) &&
    (array == arrays->GetNormals()) == (kind == Kind::Normals) && array != arrays->GetTCoords();
}

/// @param rotation  of a tuple, or nullptr where it stays as it is
template <typename RotationOf>
vtkSmartPointer<vtkDataArray> Turned(vtkDataArray* given, const RotationOf& rotation)
{
  auto turned = vtkSmartPointer<vtkDataArray>::Take(given->NewInstance());
  turned->DeepCopy(given);
  turned->SetName(given->GetName());
  std::array<double, 9> tuple = {};
  for (vtkIdType i = 0; i < given->GetNumberOfTuples(); ++i)
  {
    if (const Eigen::Matrix3d* R = rotation(i))
    {
      given->GetTuple(i, tuple.data());
      TurnTuple(*R, given->GetNumberOfComponents(), tuple.data());
      turned->SetTuple(i, tuple.data());
    }
  }
  return turned;
}

/// All arrays in their order, for some may have no name to be replaced by.
template <typename RotationOf>
void TurnArrays(
  vtkDataSetAttributes* arrays, vtkIdType count, const RotationOf& rotation, Kind kind)
{
  std::vector<vtkSmartPointer<vtkAbstractArray>> all;
  std::array<int, vtkDataSetAttributes::NUM_ATTRIBUTES> attributes = {};
  arrays->GetAttributeIndices(attributes.data());
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* given = arrays->GetArray(k);
    all.emplace_back(arrays->GetAbstractArray(k));
    if (given && IsTurned(arrays, given, count, kind))
    {
      all.back() = Turned(given, rotation);
    }
  }
  arrays->Initialize();
  for (vtkAbstractArray* array : all)
  {
    arrays->AddArray(array);
  }
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    arrays->SetActiveAttribute(attributes[type], type);
  }
}

void TurnAll(vtkDataSet* output, const vtkTurnedArrays::RotationOfPoint& ofPoint, Kind kind)
{
  TurnArrays(output->GetPointData(), output->GetNumberOfPoints(), ofPoint, kind);
  vtkNew<vtkIdList> corners;
  Eigen::Matrix3d mean;
  TurnArrays(
    output->GetCellData(), output->GetNumberOfCells(),
    [&](vtkIdType cell) -> const Eigen::Matrix3d*
    {
      output->GetCellPoints(cell, corners);
      Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
      bool moves = false;
      for (const vtkIdType i : *corners)
      {
        const Eigen::Matrix3d* own = ofPoint(i);
        moves = moves || own;
        sum += own ? *own : Eigen::Matrix3d::Identity();
      }
      mean = SphericalStyle::ClosestRotation(sum.transpose()); // which is closest to its transpose
      return moves ? &mean : nullptr;
    },
    kind);
}
}

void vtkTurnedArrays::Turn(vtkDataSet* output, const RotationOfPoint& ofPoint)
{
  TurnAll(output, ofPoint, Kind::Vectors);
}

void vtkTurnedArrays::TurnNormals(vtkDataSet* output, const RotationOfPoint& ofPoint)
{
  TurnAll(output, ofPoint, Kind::Normals);
}
