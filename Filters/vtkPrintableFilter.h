// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPrintableFilter
 * @brief   make a model ready for a 3D printer: walls, a flat foot, balance and size
 *
 * Walls of the closed surface that are too thin become thicker [walls]. It is cut flat so low that
 * its foot has the wanted area [foot], leans until its center of mass is above the foot by a margin
 * [stands], and is scaled to its volume or height [volume]. Cut, lean and size are exact, and
 * nothing of this makes a self-intersection.
 *
 * Input port 0: vtkPolyData. Triangles, quads, polygons and strips take part; lines, vertices and
 * points of no face do not come out. Coincident points are one. Holes are filled; with CloseHoles
 * off an open surface is an error that names the first point where it is. Parts that touch in a
 * point or along an edge are taken apart there [manifold], and a wall or fin that ends at an edge
 * of other faces is open. A surface that is spread over processes is gathered
 * (vtkWholeSurfaceAlgorithm).
 *
 * Output port 0: vtkPolyData, a closed surface of triangles that face outward. Arrays of points are
 * interpolated where edges are cut, and at points in filled holes those of the nearest point;
 * arrays of cells are those of the cell that was cut, and 0 on the foot and in filled holes.
 * Normals are recomputed, except that a surface with creases, where points at one place have
 * different ones, comes out without any. The cell array Foot is 1 on new triangles and 0 elsewhere.
 * The point array WallThickness is the distance to the other side of the wall [walls], in the unit
 * of the result, and NaN where there is none. The field array UpAxis (int) is the axis that points
 * up in the result; vtk3MFWriter puts the model onto the plate by it.
 *
 * Output port 1: vtkTable, what was changed: Name, Before (lengths of the model), After (those of
 * the result) and Unit. The rows are FootLevel (the lowest level along UpAxis), FootArea (of what
 * lies on it), Height, Volume, CenterOfMassX, Y and Z, MinimumThickness, TiltAngle (by which the
 * model can be tilted before it falls over), CutDepth, Lean, Thickened (the longest motion of a
 * point for it), Factor (of the size), HolesClosed, NonManifoldEdges, Points, Triangles and
 * SelfIntersectingTriangles.
 *
 * The bracketed labels are those of Filters/Documentation/Printable.md. Needs CGAL.
 *
 * Cost: some passes over the triangles, and twice the search for self-intersections: about a second
 * for 100 000 triangles. Thickening takes up to 20 passes, each with two rays for most points: 8 to
 * 15 s where many of 50 000 points have thin walls that are near to each other.
 *
 * @sa vtkSphericalStyleFilter vtkSurfaceMetrics vtkSurfaceDiagnostics
 */
#ifndef vtkPrintableFilter_h
#define vtkPrintableFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkWholeSurfaceAlgorithm.h"

class SPHERICALSTYLEFILTERS_EXPORT vtkPrintableFilter : public vtkWholeSurfaceAlgorithm
{
public:
  static vtkPrintableFilter* New();
  vtkTypeMacro(vtkPrintableFilter, vtkWholeSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum UpAxes
  {
    X_AXIS = 0,
    Y_AXIS = 1,
    Z_AXIS = 2
  };

  ///@{
  /**
   * The least area of the flat foot, as a fraction of the rectangle that the bounds of the model
   * cover on the ground. The model is cut as low as that takes, and not at all where it has such a
   * foot; higher where it could not stand otherwise. 0: no cut. Range 0..1, default .03. Where a
   * cut of a fifth of the height is not enough, the foot is the largest one up to there, and a
   * warning names its area; a warning, too, where the cut takes more than a tenth.
   */
  vtkSetRangeMacro(FootArea, double, 0.0, 1.0);
  vtkGetMacro(FootArea, double);
  ///@}

  ///@{
  /**
   * By how much the model can be tilted, in any direction, before it falls over, in degrees. For
   * that the foot is made larger, by a cut of up to a fifth of the height, and the model leans, up
   * to 10 degrees: the foot stays, and all else moves aside in proportion to its height. Of all
   * pairs of cut and lean the one that changes the model least is taken. 0: neither. Range 0..45,
   * default 10. Where both together are not enough, the model is as stable as they make it, and a
   * warning names the angle.
   */
  vtkSetRangeMacro(StabilityAngle, double, 0.0, 45.0);
  vtkGetMacro(StabilityAngle, double);
  ///@}

  ///@{
  /**
   * The least thickness of walls, in the unit of the result: both sides of thinner ones move
   * outward, before the foot is cut. 0 (default): walls stay as they are. Not below 0. A warning
   * names the thinnest point where it cannot be reached, because the surface would run through
   * itself.
   */
  vtkSetMacro(MinimumThickness, double);
  vtkGetMacro(MinimumThickness, double);
  ///@}

  ///@{
  /**
   * The volume that the result encloses, in the unit of the model cubed: the model is scaled to it.
   * 0 (default): the volume of the model, also where a piece is cut off. Not below 0; an error if
   * Height is set as well.
   */
  vtkSetMacro(Volume, double);
  vtkGetMacro(Volume, double);
  ///@}

  ///@{
  /**
   * The height of the result along UpAxis, in the unit of the model: the model is scaled to it.
   * 0 (default): as Volume says. Not below 0.
   */
  vtkSetMacro(Height, double);
  vtkGetMacro(Height, double);
  ///@}

  ///@{
  /**
   * Fill the holes of an open surface (default). Off: an open surface is an error that says where.
   */
  vtkSetMacro(CloseHoles, bool);
  vtkGetMacro(CloseHoles, bool);
  vtkBooleanMacro(CloseHoles, bool);
  ///@}

  ///@{
  /**
   * Turn the result so that z points up, as programs for printers have it, with the foot on z = 0
   * and the middle of the bounds at x = y = 0. Where y points up, what faces z then faces -y, their
   * front. Default off: it stays where it is. vtk3MFWriter does the same to what it writes where x
   * or y points up, so it is for other formats, and for z.
   */
  vtkSetMacro(PlaceOnPlate, bool);
  vtkGetMacro(PlaceOnPlate, bool);
  vtkBooleanMacro(PlaceOnPlate, bool);
  ///@}

  ///@{
  /**
   * The axis of the model that points up: X, Y (default) or Z.
   */
  vtkSetRangeMacro(UpAxis, int, X_AXIS, Z_AXIS);
  vtkGetMacro(UpAxis, int);
  void SetUpAxisToX() { this->SetUpAxis(X_AXIS); }
  void SetUpAxisToY() { this->SetUpAxis(Y_AXIS); }
  void SetUpAxisToZ() { this->SetUpAxis(Z_AXIS); }
  ///@}

  ///@{
  /**
   * Number type of the output points: vtkAlgorithm::DEFAULT_PRECISION (default: as the input),
   * SINGLE_PRECISION or DOUBLE_PRECISION. Computed in double always.
   */
  vtkSetRangeMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  /**
   * By how much the last execution scaled the model: the Factor of the table. 1 where there is no
   * result.
   */
  vtkGetMacro(Factor, double);

protected:
  vtkPrintableFilter();
  ~vtkPrintableFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPrintableFilter(const vtkPrintableFilter&) = delete;
  void operator=(const vtkPrintableFilter&) = delete;

  /// @throw std::invalid_argument that names one
  void CheckProperties() const;
  /// RequestData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  double FootArea = 0.03;
  double StabilityAngle = 10.0;
  double MinimumThickness = 0.0;
  double Volume = 0.0;
  double Height = 0.0;
  bool CloseHoles = true;
  bool PlaceOnPlate = false;
  int UpAxis = Y_AXIS;
  int OutputPointsPrecision = DEFAULT_PRECISION;

  double Factor = 1.0;
};

#endif
