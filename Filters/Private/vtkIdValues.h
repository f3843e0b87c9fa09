// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whole numbers that say which points or cells belong together. Private.
#ifndef vtkIdValues_h
#define vtkIdValues_h

#include "vtkType.h" // for vtkIdType

#include <string>
#include <vector>

class vtkDataArray;
struct vtkSurfaceMesh;

class vtkIdValues
{
public:
  /// @param purpose  what messages begin with @param count  of points or cells
  /// @param noun  "point" or "cell"
  /// @throw std::invalid_argument unless there is 1 component and a value for each
  vtkIdValues(vtkDataArray* array, const char* purpose, vtkIdType count, const char* noun);

  /// "Purpose: array 'Name'"
  const std::string& GetName() const { return this->Name; }
  /// @throw std::invalid_argument naming the point or cell where it is no whole number
  vtkIdType operator[](vtkIdType i) const;

  /// Of each mesh point: that of the first of the input points that it stands for.
  std::vector<vtkIdType> OfMesh(const vtkSurfaceMesh& surface) const;

  /// @param values  gets the ids that occur, ascending @return of each id, its place among these
  static std::vector<int> Ranks(const std::vector<vtkIdType>& ids, std::vector<vtkIdType>& values);

private:
  vtkDataArray* Array;
  std::string Name;
  std::string Noun;
};

#endif
