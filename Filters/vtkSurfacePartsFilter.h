// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfacePartsFilter
 * @brief   the parts of a surface: head, hands, legs
 *
 * Gives every point and every cell the number of its part, so that parts can be colored, selected
 * (vtkThreshold), and treated each by itself: as the center ids of vtkSphericalStyleFilter, for
 * instance.
 *
 * Input port 0: vtkPolyData of any polygons. By shape, cracks, loose triangles and the
 * triangulation do not matter: what lies within a hundredth of the diagonal of the bounds hangs
 * together [parts].
 *
 * Input array to process 0, with Method Array: points or cells, 1 component, whole numbers.
 *
 * Output port 0: vtkPolyData, the input with the array
 *  - PartId (1), points and cells: from 0, the part with the largest area, on; -1 for points of no
 *    polygon, and cells that are none (by Array everything that has a value is in a part). A cell
 *    is of the part that most of its points are of, of the lowest of several; with an array of
 *    cells a point is of the part of its first cell.
 *
 * Output port 1: vtkTable, one row for each part, in their order: Part, Points, Cells, Area
 * (length^2), Center (3; area centroid of its cells, length), Thickness (half of the thickness of
 * the limb [limb], geometric mean, length; NaN unless by shape).
 *
 * Method Shape: cuts the surface again and again where the border is shortest for what it cuts off,
 * in concave places, and between thick and thin [parts]. The bracketed labels are those of
 * Filters/Documentation/SurfaceParts.md and SphericalStyleMethod.md.
 *
 * Source: not in the thesis. The minima rule (D. Hoffman, W. Richards, Parts of recognition,
 * Cognition 18, 1984); ratio cuts of samples (N. Garcia Trillos, D. Slepcev, J. von Brecht, T.
 * Laurent, X. Bresson, Consistency of Cheeger and ratio graph cuts, JMLR 17, 2016); shape diameter
 * (L. Shapira, A. Shamir, D. Cohen-Or, Consistent mesh partitioning and skeletonisation using the
 * shape diameter function, The Visual Computer 24, 2008).
 *
 * Errors: what vtkSphericalStyleFilter refuses; with Method Array no such array, one of another
 * number of components or tuples, or a value that is no whole number (the first id is named).
 * Warnings: fewer or more parts than NumberOfParts.
 *
 * Cost: by shape 1 to 3 seconds, more with many parts, whatever the number of points.
 *
 * @sa vtkSphericalStyleFilter vtkConnectivityFilter vtkThreshold
 */
#ifndef vtkSurfacePartsFilter_h
#define vtkSurfacePartsFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkWholeSurfaceAlgorithm.h"

class vtkPolyData;
struct vtkFoundParts;
struct vtkSurfaceMesh;

class SPHERICALSTYLEFILTERS_EXPORT vtkSurfacePartsFilter : public vtkWholeSurfaceAlgorithm
{
public:
  static vtkSurfacePartsFilter* New();
  vtkTypeMacro(vtkSurfacePartsFilter, vtkWholeSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Methods
  {
    SHAPE = 0,
    CONNECTIVITY = 1,
    ARRAY = 2
  };

  ///@{
  /**
   * What makes a part: Shape (default), Connectivity (what shares points; coincident points are
   * one) or Array (what has the same value).
   */
  vtkSetRangeMacro(Method, int, SHAPE, ARRAY);
  vtkGetMacro(Method, int);
  void SetMethodToShape() { this->SetMethod(SHAPE); }
  void SetMethodToConnectivity() { this->SetMethod(CONNECTIVITY); }
  void SetMethodToArray() { this->SetMethod(ARRAY); }
  ///@}

  ///@{
  /**
   * How many parts, by shape: the best cuts are made first, so that more parts divide those that
   * fewer give. 0 (default): as many as there are good cuts. Range 0..256.
   */
  vtkSetRangeMacro(NumberOfParts, int, 0, 256);
  vtkGetMacro(NumberOfParts, int);
  ///@}

  /**
   * How many parts the last execution found. 0 where it failed or was stopped.
   */
  vtkGetMacro(EffectiveNumberOfParts, int);

protected:
  vtkSurfacePartsFilter();
  ~vtkSurfacePartsFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSurfacePartsFilter(const vtkSurfacePartsFilter&) = delete;
  void operator=(const vtkSurfacePartsFilter&) = delete;

  /// RequestWholeData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);
  vtkFoundParts FindByShape(const vtkSurfaceMesh& surface);
  vtkFoundParts FindByArray(
    vtkInformationVector** inputVector, vtkPolyData* input, const vtkSurfaceMesh& surface);

  int Method = SHAPE;
  int NumberOfParts = 0;
  int EffectiveNumberOfParts = 0;
};

#endif
