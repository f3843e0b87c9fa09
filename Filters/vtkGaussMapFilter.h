// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGaussMapFilter
 * @brief   how the normals of a surface are spread over the sphere
 *
 * The Gauss map takes every face (or point) of a surface to its unit normal. The normals of a ball
 * cover the sphere evenly, those of a cube are six points: the more even, the rounder the surface.
 * The sphere is cut into units, and normals are counted in each. This is how the thesis compares
 * its results with others (section 4.6.2, Table 4.1, Fig. 4.24). The surface may be open.
 *
 * Input port 0: vtkPolyData, the surface. Only faces take part, and points that a face uses.
 *
 * Input array to process, optional: 0: point normals, 3 components, of any length, for NormalSource
 * PointNormals (default: the active normals; computed when there are none).
 *
 * Output port 0: vtkPolyData, the unit sphere around the origin, one polygon per unit (SphereUnits
 * says which units), with the cell arrays
 *  - Count (1): see below;
 *  - Density (1): share of the count over share of the sphere. No unit; 1 everywhere for a uniform
 *    spread, 0 where there is no normal; its integral over the sphere is 4 pi.
 *
 * and the point array Normals (3) of the sphere. Cell ids are numbers of units: zone by zone from
 * the south pole (-z) to the north pole (+z), within a zone by longitude from -180 degrees
 * eastward. Longitude 0 is +x, 90 degrees is +y.
 *
 * Output port 1: vtkImageData of 360 x 180 points, longitude by latitude, one in the middle of each
 * equal-angle unit: origin (-179.5, -89.5, 0), spacing 1, both in degrees. Point array Count (1).
 *
 * Output port 2: vtkTable of one row:
 *  - Normals: how many were counted;
 *  - UnitsHit, UnitsHitOften: equal-angle units with a count above 0, above OftenThreshold: the
 *    yellow and red of Table 4.1;
 *  - EqualAreaUnits, EqualAreaUnitsHit, EqualAreaUnitsHitOften: number of equal-area units, and of
 *    those hit; hit often is a count above OftenThreshold * 64800 / EqualAreaUnits, so that it
 *    means the same number of normals per steradian as on an average equal-angle unit;
 *  - Entropy: H = - sum p ln p in nats, p: share of the count of each equal-area unit;
 *  - RelativeEntropy: H / ln(EqualAreaUnits), 0 (all in one unit) to 1 (uniform);
 *  - KullbackLeiblerDivergence: ln(EqualAreaUnits) - H in nats, 0 for uniform;
 *  - DistanceToUniform: total variation distance sum |p - 1 / EqualAreaUnits| / 2, between 0
 *    (uniform) and 1: the share of the normals that would have to move.
 *
 * The last four are not a number if there are no normals.
 *
 * A count is the number of normals in a unit, one per triangle or point (polygons are cut into
 * triangles first). With AreaWeighted each counts its area over the mean area, so that counts still
 * sum to Normals and OftenThreshold keeps its meaning.
 *
 * A normal within .001 degrees of a border belongs to the unit behind it (east, north), and one
 * within .001 degrees of a pole has longitude 0, so that rounding does not spread the normals of a
 * flat face over several units: a cube hits six, however it is turned.
 *
 * Which measure to look at: numbers of equal-angle units depend on how the model is turned, for the
 * units are small at the poles, and on the number of faces, for a face hits one unit at most. With
 * them, compare surfaces of the same triangles in the same position only. Entropy and distance on
 * equal-area units hardly depend on the position. With few normals per unit, chance alone keeps
 * them from uniform: there should be ten or more.
 *
 * Of a surface that is spread over processes each counts the normals of its part, and the counts
 * are added up. Outputs and messages are on the first process, facts on all; elsewhere the whole
 * extent of the image is empty, like the image. The table's field data have BytesExchanged, sent
 * and received by each process. Given point normals of several processes are one if they have the
 * same global id or, without global ids, the same place and the same bits.
 *
 * Source: Research of Spherical Style Deformation on Single Component Models (doctoral thesis),
 * section 4.6.2, Table 4.1; equal-area units: P. Leopardi, A partition of the unit sphere into
 * regions of equal area and small diameter, ETNA 25 (2006). The label [gaussmap] in comments is
 * that of Filters/Documentation/GaussMap.md.
 *
 * Cost: some tenths of a microsecond per face, and twenty milliseconds for the sphere.
 *
 * @sa vtkSphericalStyleFilter
 */
#ifndef vtkGaussMapFilter_h
#define vtkGaussMapFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkWholeSurfaceAlgorithm.h"

#include <memory> // for std::shared_ptr

class vtkProcesses;
class vtkTable;

class SPHERICALSTYLEFILTERS_EXPORT vtkGaussMapFilter : public vtkWholeSurfaceAlgorithm
{
public:
  static vtkGaussMapFilter* New();
  vtkTypeMacro(vtkGaussMapFilter, vtkWholeSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum NormalSources
  {
    FACE_NORMALS = 0,
    POINT_NORMALS = 1
  };
  enum SphereUnitKinds
  {
    EQUAL_ANGLE = 0,
    EQUAL_AREA = 1
  };

  ///@{
  /**
   * Which normals are counted: FaceNormals (default), one per triangle, or PointNormals, one per
   * point. Point normals are those of the input, as they are; where it has none they are computed
   * from the triangles, weighted by angle, and coincident points count as one.
   */
  vtkSetRangeMacro(NormalSource, int, FACE_NORMALS, POINT_NORMALS);
  vtkGetMacro(NormalSource, int);
  void SetNormalSourceToFaceNormals() { this->SetNormalSource(FACE_NORMALS); }
  void SetNormalSourceToPointNormals() { this->SetNormalSource(POINT_NORMALS); }
  ///@}

  ///@{
  /**
   * Whether a normal counts its area (of the triangle, or a third of the triangles at the point)
   * over the mean area instead of one. The measures then do not depend on how finely which part is
   * meshed. Default off, as in the thesis.
   */
  vtkSetMacro(AreaWeighted, bool);
  vtkGetMacro(AreaWeighted, bool);
  vtkBooleanMacro(AreaWeighted, bool);
  ///@}

  ///@{
  /**
   * An equal-angle unit is hit often, red in the thesis, when its count is more than this; see
   * above for equal-area units. In normals. The thesis gives no value. Finite and 0 or more.
   * Default 5.
   */
  vtkSetMacro(OftenThreshold, double);
  vtkGetMacro(OftenThreshold, double);
  ///@}

  ///@{
  /**
   * Number of equal-area units. More resolve finer detail and need more normals: at least about
   * ten per unit. Range 10 to 100,000. Default 1000, about 6.4 degrees wide.
   */
  vtkSetRangeMacro(NumberOfEqualAreaUnits, int, 10, 100000);
  vtkGetMacro(NumberOfEqualAreaUnits, int);
  ///@}

  ///@{
  /**
   * Units that output 0 shows: EqualAngle (default; 360 x 180, Fig. 4.24) or EqualArea.
   */
  vtkSetRangeMacro(SphereUnits, int, EQUAL_ANGLE, EQUAL_AREA);
  vtkGetMacro(SphereUnits, int);
  void SetSphereUnitsToEqualAngle() { this->SetSphereUnits(EQUAL_ANGLE); }
  void SetSphereUnitsToEqualArea() { this->SetSphereUnits(EQUAL_AREA); }
  ///@}

  ///@{
  /**
   * Facts of the last execution, as in the table of output 2.
   */
  vtkGetMacro(NumberOfNormals, vtkIdType);
  vtkGetMacro(UnitsHit, int);
  vtkGetMacro(UnitsHitOften, int);
  vtkGetMacro(EqualAreaUnitsHit, int);
  vtkGetMacro(EqualAreaUnitsHitOften, int);
  vtkGetMacro(Entropy, double);
  vtkGetMacro(RelativeEntropy, double);
  vtkGetMacro(KullbackLeiblerDivergence, double);
  vtkGetMacro(DistanceToUniform, double);
  ///@}

protected:
  vtkGaussMapFilter();
  ~vtkGaussMapFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestPart(vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkGaussMapFilter(const vtkGaussMapFilter&) = delete;
  void operator=(const vtkGaussMapFilter&) = delete;

  /// RequestWholeData, which turns what this throws into a message, or RequestPart.
  /// @param processes  that the surface is spread over, or nullptr
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector,
    const std::shared_ptr<const vtkProcesses>& processes = nullptr);

  // Its steps.
  struct Counts;
  void SetFacts(const Counts& counts);
  void FillTable(vtkTable* table) const;

  int NormalSource = FACE_NORMALS;
  bool AreaWeighted = false;
  double OftenThreshold = 5.0;
  int NumberOfEqualAreaUnits = 1000;
  int SphereUnits = EQUAL_ANGLE;

  vtkIdType NumberOfNormals = 0;
  int UnitsHit = 0;
  int UnitsHitOften = 0;
  int EqualAreaUnitsHit = 0;
  int EqualAreaUnitsHitOften = 0;
  double Entropy = 0.0;
  double RelativeEntropy = 0.0;
  double KullbackLeiblerDivergence = 0.0;
  double DistanceToUniform = 0.0;
};

#endif
