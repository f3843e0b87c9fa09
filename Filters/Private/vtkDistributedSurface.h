// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A surface in pieces on several processes, made one on the first, and its result given back.
/// Private.
#ifndef vtkDistributedSurface_h
#define vtkDistributedSurface_h

#include "vtkSmartPointer.h"
#include "vtkType.h" // for vtkIdType

#include <vector>

class vtkMultiProcessController;
class vtkPolyData;

/// Pieces meet where they have points of the same global id, or, where a piece has no global ids,
/// points with the same coordinates to the last bit; of points of one piece at one place the first
/// meets the first of the other piece, the second the second. Cells marked as duplicates in
/// vtkGhostType are left out, since another piece has them, and values of points marked so are
/// taken from the piece that owns them. With global ids on all pieces points and cells come in
/// their order, otherwise in that of the processes.
///
/// The first process needs the memory for all of it. Gather and GiveBack are to be called by all
/// processes of the controller.
class vtkDistributedSurface
{
public:
  /// Point array of a piece that says with other numbers than 0 which points are marked; a point of
  /// the whole is marked where it is on any piece.
  static constexpr const char* MarksName = "vtkDistributedSurfaceMarks";

  explicit vtkDistributedSurface(vtkMultiProcessController* controller);

  /// Sends the pieces to the first process.
  /// @param piece  checked (vtkSurfaceMeshConversion::CheckPiece); stays as it is
  void Gather(vtkPolyData* piece);

  /// After Gather: on the first process the whole, with the arrays that all pieces have and without
  /// vtkGhostType; elsewhere an empty surface.
  /// @throw std::invalid_argument naming a global id that stands for different places
  vtkSmartPointer<vtkPolyData> Assemble();

  /// Makes the output the piece, with the result's points and with the arrays that the result has
  /// in place of those of the whole, or more than it.
  /// @param whole, result  on the first process what Assemble gave and the same cells with other
  ///        points or arrays; not used elsewhere
  void GiveBack(vtkPolyData* whole, vtkPolyData* result, vtkPolyData* piece, vtkPolyData* output);

private:
  /// Where the points and cells of a piece are in the whole; Nowhere for duplicates of cells that
  /// no piece owns.
  struct Places
  {
    std::vector<vtkIdType> Points;
    std::vector<vtkIdType> Cells;
  };
  static constexpr vtkIdType Nowhere = -1;

  /// What a point or cell of the whole is taken from.
  struct Origin
  {
    int Piece;
    vtkIdType Id;
  };

  std::vector<Origin> PlacePoints();
  std::vector<Origin> PlaceCells();
  void PlaceGhostCells(const std::vector<Origin>& cells, std::size_t numberOfPoints);
  void CopyPoints(const std::vector<Origin>& origins, vtkPolyData* whole) const;
  void CopyCells(const std::vector<Origin>& origins, vtkPolyData* whole) const;
  void JoinMarks(vtkPolyData* whole) const;
  /// The corners of a cell by points of the whole. @return its kind: vertex, line, polygon, strip
  int FindCorners(const Origin& origin, std::vector<vtkIdType>& corners) const;
  vtkSmartPointer<vtkPolyData> Reply(
    vtkPolyData* whole, vtkPolyData* result, std::size_t piece) const;

  vtkMultiProcessController* Controller;
  std::vector<vtkSmartPointer<vtkPolyData>> Gathered; // one per process, on the first
  std::vector<Places> Place;                          // the same
};

#endif
