// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// vtkPolyData to triangle mesh and back, and the only place where input is validated. Private.
#ifndef vtkSurfaceMeshConversion_h
#define vtkSurfaceMeshConversion_h

#include "SurfacePart.h"
#include "vtkDataSetAttributes.h" // for the attribute types
#include "vtkSmartPointer.h"      // for vtkSmartPointer
#include "vtkType.h"              // for vtkIdType

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataSet;
class vtkInformation;
class vtkPolyData;

/// The part of a vtkPolyData that takes part in a solve.
struct vtkSurfaceMesh
{
  /// Triangles of polygons and strips; only points that a triangle uses, or all (TakePoints).
  SphericalStyle::TriangleMesh Mesh;
  /// The same triangles by input points, m x 3.
  const SphericalStyle::Triangles& GetCorners() const
  {
    return this->Corners.rows() > 0 ? this->Corners : this->Mesh.F;
  }
  /// Input cell of a triangle; ascends with the triangle.
  vtkIdType GetCell(Eigen::Index triangle) const
  {
    return this->Cells.empty() ? this->FirstCell + static_cast<vtkIdType>(triangle)
                               : this->Cells[triangle];
  }
  /// Both take as much memory as the mesh, so there are none where they say nothing: where the mesh
  /// points are the input points, and where the cells are triangles and none is left out. @{
  SphericalStyle::Triangles Corners;
  std::vector<vtkIdType> Cells;
  /// @}
  vtkIdType FirstCell = 0; ///< of the first triangle
  /// Mesh point of each input point; NotMoved for points that are not taken.
  std::vector<int> MeshPoint;
  static constexpr int NotMoved = -1;
  /// Coordinates of those, in order: one that moves to the place of another is one with it.
  std::vector<double> NotMovedPoints;
  bool Welded = false; ///< whether points at one place are one

  /// Of a surface that is spread over processes: what this one has of the mesh, and of the input's
  /// points, where a point counts if its values do and not those that another process has of it.
  SphericalStyle::SurfacePart Part;
  SphericalStyle::SurfacePart InputPart;
  /// Whether all processes that have points have an array. To be called by all of them.
  bool IsEverywhere(vtkDataArray* array) const;

  /// What was left out or repaired, with the first cell id, and the process that has that cell; -1
  /// for a surface that is not spread.
  vtkIdType DegenerateTriangles = 0;
  vtkIdType FirstDegenerateCell = -1;
  int FirstDegenerateProcess = -1;
  vtkIdType FannedPolygons = 0;
  vtkIdType FirstFannedPolygon = -1;
  int FirstFannedProcess = -1;

  /// First input point of mesh point i. A search: where many are wanted, take all.
  vtkIdType FirstInputPoint(int i) const;
  /// That of each mesh point.
  std::vector<vtkIdType> FirstInputPoints() const;
};

namespace vtkSurfaceMeshConversion
{
enum class TakePoints
{
  OfTriangles,
  All
};

/// @param weld  coincident input points become one mesh point
/// @param processes  that the surface is spread over, or nullptr; all call this with their parts
/// and `weld` then. Cells that vtkGhostType marks as duplicates take no part. Points that are on
/// several processes are those at the same coordinates. Triangles with an angle below 1e-10 (area
/// against the longest edge), or that use a mesh point twice, are skipped and counted; polygons
/// that cannot be triangulated become fans and are counted.
/// @throw std::invalid_argument naming the first point that is not finite or beyond 1e300, the
/// first
///        cell with a point id out of range, active normals of another number than points or cells,
///        or too many points
vtkSurfaceMesh FromPolyData(vtkPolyData* input, bool weld,
  TakePoints take = TakePoints::OfTriangles,
  const std::shared_ptr<const SphericalStyle::Processes>& processes = nullptr);

/// Makes `surface`, the result of an earlier call or nullptr, that of the input: a few passes over
/// the arrays where the input is triangles and nothing has changed, another FromPolyData otherwise.
/// Contents are compared, not times: arrays may have been written to in place.
/// @param take  the same in all calls for this surface @param processes  see FromPolyData
/// @return whether it was made anew, on all processes or on none
/// @throw see FromPolyData; `surface` is nullptr then
bool Update(vtkPolyData* input, bool weld, std::shared_ptr<const vtkSurfaceMesh>& surface,
  TakePoints take = TakePoints::OfTriangles,
  const std::shared_ptr<const SphericalStyle::Processes>& processes = nullptr);

/// The points of a data set, n x 3.
/// @throw std::invalid_argument naming the first that is not finite or beyond 1e300
SphericalStyle::Points PointsOf(vtkDataSet* input);

/// The data set without arrays of points or cells that have no tuple, although there are points or
/// cells: vtkOBJReader makes such normals where faces name some that are not in the file.
/// @return the input itself where it has no such array
vtkSmartPointer<vtkDataSet> WithoutEmptyArrays(vtkDataSet* input);

/// What FromPolyData refuses, and arrays of another number of tuples than points or cells.
/// @param piece  of a surface that is going to be put together
/// @throw std::invalid_argument see FromPolyData, or naming the array
void CheckPiece(vtkPolyData* piece);

/// @throw std::invalid_argument naming the first array of points or cells whose number of tuples is
///        another than theirs
void CheckArrays(vtkDataSet* input);

/// A triangle of a cell, by input points.
struct FaceTriangle
{
  vtkIdType Cell;
  std::array<vtkIdType, 3> Corners;
};

/// All triangles that FromPolyData takes from a surface, in its order, before any is skipped.
/// @param input  that FromPolyData has found good
std::vector<FaceTriangle> Triangles(vtkPolyData* input);

/// Triangles of cells that another process owns, as that takes them.
struct GhostTriangles
{
  SphericalStyle::Triangles Corners; ///< by input points
  std::vector<vtkIdType> Cells;      ///< input cell of each
};
/// @param surface  FromPolyData(input) with processes
GhostTriangles Ghosts(vtkPolyData* input, const vtkSurfaceMesh& surface);

/// A surface as it came in: all points, also those that are not finite, and all triangles.
struct WholeSurface
{
  SphericalStyle::TriangleMesh Mesh;
  std::vector<vtkIdType> Cells; ///< input cell of each triangle, ascending
  vtkIdType FannedPolygons = 0; ///< that cannot be triangulated
  vtkIdType FirstFannedPolygon = -1;
};

/// The input before anything is left out; a polygon with a point that is not finite is a fan.
/// @param input  may have no points at all
/// @throw std::invalid_argument naming the first cell with a point id out of range, or too many
///        triangles or points
WholeSurface Whole(vtkPolyData* input);

/// Makes a count that of all processes, and `first` that of the first process that has one.
/// @param process  that one; stays where the surface is not spread
void CountOnAll(
  const SphericalStyle::SurfacePart& everybody, vtkIdType& count, vtkIdType& first, int& process);
/// For messages, after a number: " of process 2"; empty for -1.
std::string OfProcess(int process);

/// Polygons that had to be cut as fans, triangles that were skipped, in words for warnings; empty
/// where there are none.
std::string FannedRemark(const vtkSurfaceMesh& surface);
std::string SkippedRemark(const vtkSurfaceMesh& surface);
/// These, and that nothing moves where there is no triangle: for filters that move points.
std::vector<std::string> Remarks(const vtkSurfaceMesh& surface);

/// What a point array must be like.
struct ArrayRule
{
  const char* Purpose; ///< property the array belongs to, for messages
  int Components;
  double Minimum;
  double Maximum;
  int Attribute = -1;         ///< active attribute to take where no array is named, -1 for none
  const char* Name = nullptr; ///< array to take where none is named, if it is there
};

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr ArrayRule NormalsRule = { "Normals", 3, -Infinity, Infinity,
  vtkDataSetAttributes::NORMALS };

/// The point array that an algorithm is told to process, or nullptr where none is asked for: unset,
/// or set back to "None" by a user interface, and then no array of the attribute type either.
/// @param wanted  vtkAlgorithm::GetInputArrayInformation
/// @param attribute  active attribute to take where none is named, -1 for none
/// @throw std::invalid_argument naming purpose and array that is not there
vtkDataArray* FindPointArray(
  vtkInformation* wanted, vtkPolyData* input, const char* purpose, int attribute = -1);

/// That array as one row per mesh point, the mean over coincident input points; no rows where none
/// is asked for.
/// @throw std::invalid_argument naming purpose, array and the first offending point
SphericalStyle::Points GatherPointArray(
  vtkInformation* wanted, vtkPolyData* input, const vtkSurfaceMesh& surface, const ArrayRule& rule);

/// Point normals, of length 1 or 0: those of the array or, where none is named, the active ones; no
/// rows where there are none. @throw see GatherPointArray
SphericalStyle::Points GatherNormals(
  vtkInformation* wanted, vtkPolyData* input, const vtkSurfaceMesh& surface);

/// One row per mesh point to a point array of the output, zero where nothing moves.
/// @throw std::range_error naming array and point of the first value that is not finite
/// @param type  VTK_FLOAT or VTK_DOUBLE
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
void AddPointArray(vtkPolyData* output, const vtkSurfaceMesh& surface, const char* name, int type,
  const Eigen::Ref<const Rows>& rows);

/// The array Rotation, 9 components, row by row, in the number type of the output's points.
void AddRotations(
  vtkPolyData* output, const vtkSurfaceMesh& surface, const SphericalStyle::Matrices& R);

/// The array Displacement: output minus input point, in the number type of the output's points.
/// @throw std::range_error naming the first point whose displacement is not finite
void AddDisplacement(vtkPolyData* output, vtkPolyData* input);

/// VTK_FLOAT or VTK_DOUBLE: the number type of the output's points.
/// @param precision  vtkAlgorithm::DesiredOutputPrecision
int OutputPointType(vtkPolyData* input, int precision);

/// Gives the output (a shallow copy of the input) the moved points Q and what follows from them:
/// point normals if it had some or `generate` is set, cell normals if it had some. Points that do
/// not move keep their bits, or the nearest of the new number type, and so do normals of points
/// that no moved triangle touches.
/// @throw std::range_error naming the first point that would not be finite
/// @param precision  vtkAlgorithm::DesiredOutputPrecision
void ReplacePoints(vtkPolyData* output, const vtkSurfaceMesh& surface,
  const SphericalStyle::Points& Q, int precision, bool generateNormals);
}

#endif
