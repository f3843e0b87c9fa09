// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHandleDeformFilter
 * @brief   bend, stretch or pose a surface by handles, and carry its details along
 *
 * A handle is a row of ten numbers: a place c, a radius, where c moves to, and a rotation vector.
 * The points within the radius of c go where the handle takes them, to the last bit:
 *
 *     p' = c' + R (p - c)                                                           [handles]
 *
 * All other points go to where the surface is bent and stretched least: to a minimum of the
 * as-rigid-as-possible energy of vtkSphericalStyleFilter without its sphere (Roundness 0),
 *
 *     E = sum over triangles f, half-edges h = uv of f, corners y of f of c_h |e'_uv - R_y e_uv|^2
 *
 * with half cotangents c_h. It can be used before vtkSphericalStyleFilter or after it. Rotations
 * start from a field that passes smoothly from one handle to the next, so that a handle can turn by
 * half a turn, and by more where the piece between is long.
 *
 * Input port 0: vtkPolyData. Triangles, quads, polygons and strips are deformed (triangulated
 * inside, cells unchanged on output); lines, vertices and points of no face stay. Open borders,
 * several components (ComponentCoupling), non-manifold edges and coincident points (solved as one)
 * are allowed. A surface that is spread over processes is gathered (vtkWholeSurfaceAlgorithm).
 *
 * Input array to process 0: which points a handle holds, in the place of its radius: 1 component,
 * the number of the row, from 1 on, or 0 for free points. Default: none.
 *
 * Output port 0: vtkPolyData with the cells, point order and every array of the input, the point
 * arrays Displacement (3; output minus input point, model length) and Handle (1; the number of the
 * row that holds the point, from 1 on, 0 for free points), and normals, recomputed if the input had
 * some or GenerateNormals is on. Points of handles have the bits of [handles] in double precision,
 * see OutputPointsPrecision; those of a handle that neither moves nor turns have the bits of the
 * input.
 *
 * Output port 1: vtkTable, see vtkIterativeStyleAlgorithm, without a term of the filter's own. No
 * rows where no handle moves: the surface then stays as it is, bit for bit.
 *
 * With one handle the model moves as a whole. The result does not depend on what the handles were
 * before: it is that of a new filter.
 *
 * Errors name a row that is not finite, has a radius below 0 or turns by more than 36 000 degrees,
 * and the first point that two rows hold.
 *
 * Source: O. Sorkine, M. Alexa, As-Rigid-As-Possible Surface Modeling, Symposium on Geometry
 * Processing 2007. The bracketed label is that of Filters/Documentation/HandleDeform.md.
 *
 * Cost: one sparse factorization (about n log n in practice), kept as long as the same points of
 * the same surface are held, so that moving and turning handles only iterates.
 *
 * @sa vtkSphericalStyleFilter vtkPartSizesFilter
 */
#ifndef vtkHandleDeformFilter_h
#define vtkHandleDeformFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkIterativeStyleAlgorithm.h"
#include "vtkWrappingHints.h" // for VTK_SIZEHINT

#include <array>  // for std::array
#include <memory> // for std::unique_ptr
#include <vector> // for std::vector

class vtkPolyData;
struct vtkSurfaceMesh;

namespace SphericalStyle
{
struct Handle;
struct StyleReport;
}

class SPHERICALSTYLEFILTERS_EXPORT vtkHandleDeformFilter : public vtkIterativeStyleAlgorithm
{
public:
  static vtkHandleDeformFilter* New();
  vtkTypeMacro(vtkHandleDeformFilter, vtkIterativeStyleAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ComponentCouplings
  {
    STITCHED = 0,
    INDEPENDENT = 1
  };

  ///@{
  /**
   * The rows, one for each handle: place x, y, z, radius, move-to x, y, z (model coordinates and
   * length) and rotation vector x, y, z (degrees; its direction is the axis, its length the angle,
   * up to 36 000). The handle holds all points within the radius of the place, 0 or more, and
   * always the nearest one; it turns them about the place, and then moves the place to the move-to
   * point. A handle that stays, with the place as its move-to point and no rotation, pins its
   * points. No point may be in two handles.
   *
   * SetHandle replaces a row, counted from 1 on as in the array Handle; GetHandle returns nullptr
   * for a row that there is not. Default: no handle.
   */
  void AddHandle(const double row[10]);
  void SetHandle(int number, const double row[10]);
  const double* GetHandle(int number) VTK_SIZEHINT(10);
  int GetNumberOfHandles();
  void RemoveAllHandles();
  ///@}

  ///@{
  /**
   * What holds parts together that share no edge (eyeballs in a head): Stitched (default; near
   * points of different parts are joined by edges, so that parts without a handle go along with
   * their surroundings) or Independent (nothing: parts without a handle stay where they are, to the
   * bit).
   */
  vtkSetRangeMacro(ComponentCoupling, int, STITCHED, INDEPENDENT);
  vtkGetMacro(ComponentCoupling, int);
  void SetComponentCouplingToStitched() { this->SetComponentCoupling(STITCHED); }
  void SetComponentCouplingToIndependent() { this->SetComponentCoupling(INDEPENDENT); }
  ///@}

protected:
  vtkHandleDeformFilter();
  ~vtkHandleDeformFilter() override;

  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkHandleDeformFilter(const vtkHandleDeformFilter&) = delete;
  void operator=(const vtkHandleDeformFilter&) = delete;

  /// RequestData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);
  std::vector<SphericalStyle::Handle> MakeHandles() const;
  std::vector<int> HoldPoints(vtkPolyData* input, const vtkSurfaceMesh& surface,
    const std::vector<SphericalStyle::Handle>& handles);
  SphericalStyle::StyleReport Solve(
    const std::vector<SphericalStyle::Handle>& handles, const std::vector<int>& ofPoints);

  std::vector<std::array<double, 10>> Handles;
  int ComponentCoupling = STITCHED;

  struct Internals; // what is kept between executions
  std::unique_ptr<Internals> Internal;
};

#endif
