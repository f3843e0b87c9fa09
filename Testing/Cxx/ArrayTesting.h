// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Arrays and selections, for tests that look at what becomes of them.
#ifndef ArrayTesting_h
#define ArrayTesting_h

#include "FilterTesting.h"

#include "vtkBitArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkLongLongArray.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkShortArray.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

namespace FilterTesting
{
/// All messages in one line, for the text of a check.
inline std::string Joined(const std::vector<std::string>& messages)
{
  std::string all;
  for (const std::string& message : messages)
  {
    all += " | " + message;
  }
  return all;
}

inline vtkDataArray* PointArray(vtkPolyData* surface, const char* name)
{
  return surface->GetPointData()->GetArray(name);
}

/// An array of doubles, one tuple a point, filled by its id.
inline vtkSmartPointer<vtkDoubleArray> MakeArray(const char* name, vtkPolyData* surface,
  int components, const std::function<double(vtkIdType, int)>& value)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    for (int k = 0; k < components; ++k)
    {
      array->SetComponent(i, k, value(i, k));
    }
  }
  return array;
}

inline vtkSmartPointer<vtkSelection> MakeSelection(
  const std::vector<vtkIdType>& ids, int field, int content = vtkSelectionNode::INDICES)
{
  vtkNew<vtkIdTypeArray> list;
  for (const vtkIdType id : ids)
  {
    list->InsertNextValue(id);
  }
  vtkNew<vtkSelectionNode> node;
  node->SetFieldType(field);
  node->SetContentType(content);
  node->SetSelectionList(list);
  auto selection = vtkSmartPointer<vtkSelection>::New();
  selection->AddNode(node);
  return selection;
}

/// An array of any number type with values that differ from tuple to tuple.
template <typename Array>
vtkSmartPointer<Array> MakeAny(const char* name, vtkIdType tuples, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    for (int k = 0; k < components; ++k)
    {
      array->SetComponent(i, k, static_cast<double>((7 * i + 3 * k) % 101) + 0.5 * (i % 2));
    }
  }
  return array;
}

inline vtkSmartPointer<vtkStringArray> MakeStrings(const char* name, vtkIdType values)
{
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetName(name);
  for (vtkIdType i = 0; i < values; ++i)
  {
    array->InsertNextValue("value " + std::to_string(i));
  }
  return array;
}

/// Arrays of every association and many types, most attributes active.
inline void AddArrays(vtkPolyData* surface)
{
  const vtkIdType n = surface->GetNumberOfPoints();
  vtkPointData* points = surface->GetPointData();
  points->AddArray(MakeAny<vtkUnsignedCharArray>("colors", n, 4));
  points->SetNormals(MakeAny<vtkFloatArray>("my normals", n, 3));
  points->AddArray(MakeAny<vtkShortArray>("shorts", n, 2));
  points->SetScalars(MakeAny<vtkDoubleArray>("scalars", n, 1));
  points->SetVectors(MakeAny<vtkFloatArray>("vectors", n, 3));
  points->SetTensors(MakeAny<vtkDoubleArray>("tensors", n, 9));
  points->SetGlobalIds(MakeAny<vtkIdTypeArray>("ids", n, 1));
  points->AddArray(MakeStrings("names", n));
  points->AddArray(MakeAny<vtkBitArray>("bits", n, 1));
  points->AddArray(MakeAny<vtkLongLongArray>("longs", n, 1));

  const vtkIdType m = surface->GetNumberOfCells();
  vtkCellData* cells = surface->GetCellData();
  cells->SetScalars(MakeAny<vtkIntArray>("cell scalars", m, 1));
  cells->AddArray(MakeAny<vtkFloatArray>("cell floats", m, 5));
  cells->SetVectors(MakeAny<vtkDoubleArray>("cell vectors", m, 3));
  cells->AddArray(MakeStrings("cell names", m));
  cells->SetPedigreeIds(MakeAny<vtkIdTypeArray>("cell ids", m, 1));

  vtkFieldData* fields = surface->GetFieldData();
  fields->AddArray(MakeAny<vtkDoubleArray>("field", 5, 2));
  fields->AddArray(MakeStrings("comment", 2));
}

/// The arrays of `in` are the first of `out`, in order and byte for byte, except the one of name
/// `but`.
inline void CheckPassedOn(Checker& check, vtkFieldData* in, vtkFieldData* out, const char* but)
{
  for (int i = 0; i < in->GetNumberOfArrays(); ++i)
  {
    const std::string name = in->GetArrayName(i);
    const char* there = i < out->GetNumberOfArrays() ? out->GetArrayName(i) : nullptr;
    check(there && name == there,
      "array " + Text(i) + " should be " + name + " and is " + (there ? there : "missing"));
    check(name == but || SameArray(in->GetAbstractArray(i), out->GetAbstractArray(name.c_str())),
      "array " + name + " should come out byte for byte");
  }
}
}

#endif
