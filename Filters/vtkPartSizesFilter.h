// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPartSizesFilter
 * @brief   give each part of a surface a size and a roundness of its own: a large head, small hands
 *
 * Parts are what an array of points says, such as PartId of vtkSurfacePartsFilter. Each part k is
 * scaled by its size s_k where it is, and moved so that it meets its neighbors at their joints: a
 * head grows out of its neck, and a hand goes along with its arm. With omega_k the shares of the
 * parts, which pass into each other over BlendWidth,
 *
 *     p' = sum_k omega_k(p) (s_k p + b_k)                                             [sizes]
 *
 * The b_k are those for which neighbors agree best at their joints, all of them where these form a
 * tree; the largest part stays in place. All of it is in closed form. It can be used before
 * vtkSphericalStyleFilter or after it, which passes the array on.
 *
 * Used before it, it can also say how that filter rounds each part: omega_k blends values that are
 * given for parts into arrays of points which vtkSphericalStyleFilter takes by their names
 * [styles].
 *
 * Input port 0: vtkPolyData. Triangles, quads, polygons and strips take part; lines, vertices and
 * points of no face are carried along unmoved. Defects do not matter, as parts pass into each other
 * on a grid that does not know the triangles. A surface that is spread over processes is gathered
 * (vtkWholeSurfaceAlgorithm).
 *
 * Input array to process 0: the part of each point, 1 component, whole numbers, at most 256
 * different ones. Coincident points are of the part of the first of them. Default: the one named
 * PartId, or where there is none what vtkSurfacePartsFilter makes, which comes out as PartId. The
 * search takes a second or more, and its result is kept while the surface stays the same.
 *
 * Output port 0: vtkPolyData with the cells, point order and every array of the input, the point
 * array Displacement (3; output minus input point, model length), and normals, recomputed if the
 * input had some or GenerateNormals is on. With rows of PartRoundness the point array PartRoundness
 * (1; a factor), with rows of PartNormalBlend the point array PartNormalBlend (2; a value, and its
 * weight against the NormalBlend of the filter that takes it, both 0..1).
 *
 * Output port 1: vtkTable, one row per part: Part (its number in the array), Size, and its extent
 * along UpAxis before and after, HeightBefore and Height (model length).
 *
 * Warnings name rows of parts that do not occur, and parts with several. The bracketed labels are
 * those of Filters/Documentation/PartSizes.md.
 *
 * Cost: a pass over the triangles, a factor of some thousand functions of a grid, and a few passes
 * over the points: about .2 s for 100 000 points. Without the factor, which is kept, while surface,
 * parts and BlendWidth stay the same.
 *
 * @sa vtkSurfacePartsFilter vtkSphericalStyleFilter
 */
#ifndef vtkPartSizesFilter_h
#define vtkPartSizesFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkSmartPointer.h"             // for vtkSmartPointer
#include "vtkStyleAlgorithm.h"

#include <map>    // for std::map
#include <memory> // for std::shared_ptr
#include <set>    // for std::set

class vtkPolyData;
struct vtkPartValues;
struct vtkResizedParts;
struct vtkSurfaceMesh;

class SPHERICALSTYLEFILTERS_EXPORT vtkPartSizesFilter : public vtkStyleAlgorithm
{
public:
  static vtkPartSizesFilter* New();
  vtkTypeMacro(vtkPartSizesFilter, vtkStyleAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum UpAxes
  {
    X_AXIS = 0,
    Y_AXIS = 1,
    Z_AXIS = 2
  };

  ///@{
  /**
   * How large a part becomes, as a multiple of what it is: 1.6 for a large head. No unit, above 0;
   * another one is an error. All other parts have size 1, except that what hangs on the head alone,
   * such as ears and hair, has the size of the head [head]. The part is its number in the array, a
   * whole one; numbers that do not occur lead to a warning, and NaN is an error at once.
   *
   * AddPartSize is for rows of a table, of which no two should be of one part: the last one counts,
   * and a warning names the part.
   */
  void SetPartSize(double part, double size);
  void AddPartSize(double part, double size);
  double GetPartSize(double part);
  void RemoveAllPartSizes();
  ///@}

  ///@{
  /**
   * How far a part is rounded, as a multiple of the Roundness of vtkSphericalStyleFilter: .5 for
   * less than the rest, 1.5 for more, 0 for a part that keeps its shape. Parts keep together
   * [styles]. No unit, not below 0. Parts without a row have 1, but what hangs on the head alone
   * goes along with it. Else as for PartSize.
   */
  void SetPartRoundness(double part, double factor);
  void AddPartRoundness(double part, double factor);
  double GetPartRoundness(double part);
  void RemoveAllPartRoundnesses();
  ///@}

  ///@{
  /**
   * What becomes round of a part, in place of the NormalBlend of vtkSphericalStyleFilter. 0: the
   * part is drawn toward the one ball of the model; 1: it becomes round by its own thickness. No
   * unit, 0..1. Parts without a row have the filter's, and GetPartNormalBlend is -1, but what hangs
   * on the head alone goes along with it. Else as for PartSize.
   */
  void SetPartNormalBlend(double part, double blend);
  void AddPartNormalBlend(double part, double blend);
  double GetPartNormalBlend(double part);
  void RemoveAllPartNormalBlends();
  ///@}

  ///@{
  /**
   * How far parts pass into each other, as a fraction of the diagonal of the bounds. Wider is
   * softer: a border that is as wide as a neck is thick bends it least. Range .01..1, default .05.
   */
  vtkSetRangeMacro(BlendWidth, double, 0.01, 1.0);
  vtkGetMacro(BlendWidth, double);
  ///@}

  ///@{
  /**
   * Chibi by numbers: the height of the head over that of the rest, both along UpAxis in the
   * output; .5 makes a figure three heads high. Both without what hangs on the head alone, such as
   * ears. The sizes of all that are multiplied by what it takes. 0 (default): they are not. Not
   * below 0; an error, with the heights in reach, where nothing between 1/20 and 20 will do. No
   * effect, with a warning, where there is only one part.
   */
  vtkSetMacro(HeadHeight, double);
  vtkGetMacro(HeadHeight, double);
  ///@}

  ///@{
  /**
   * The part that is the head, for HeadHeight and for what goes along with it. -1 (default): the
   * one whose center is highest along UpAxis, of those that enclose a twentieth of what the largest
   * one does, so that ears and hands are none.
   */
  vtkSetMacro(Head, int);
  vtkGetMacro(Head, int);
  ///@}

  ///@{
  /**
   * Move the result along UpAxis so that its lowest point lies on the level of the model's lowest
   * point. Without it the part with the largest area stays in place, and where that is a head that
   * grows, feet sink. Default off.
   */
  vtkSetMacro(KeepOnGround, bool);
  vtkGetMacro(KeepOnGround, bool);
  vtkBooleanMacro(KeepOnGround, bool);
  ///@}

  ///@{
  /**
   * The axis that points up, for heads, heights and KeepOnGround: X, Y (default) or Z.
   */
  vtkSetRangeMacro(UpAxis, int, X_AXIS, Z_AXIS);
  vtkGetMacro(UpAxis, int);
  void SetUpAxisToX() { this->SetUpAxis(X_AXIS); }
  void SetUpAxisToY() { this->SetUpAxis(Y_AXIS); }
  void SetUpAxisToZ() { this->SetUpAxis(Z_AXIS); }
  ///@}

  /**
   * The head of the last execution, by its number in the array. -1 where there was only one part,
   * or no row and no HeadHeight asked for it, and where the execution failed.
   */
  vtkGetMacro(EffectiveHead, vtkIdType);

protected:
  vtkPartSizesFilter();
  ~vtkPartSizesFilter() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPartSizesFilter(const vtkPartSizesFilter&) = delete;
  void operator=(const vtkPartSizesFilter&) = delete;

  /// RequestData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);
  void CheckProperties() const;
  vtkDataArray* FindIds(vtkPolyData* input);
  struct KnownParts;
  std::shared_ptr<KnownParts> Know(vtkPolyData* input, const vtkSurfaceMesh& surface, bool search);
  vtkSmartPointer<vtkDataArray> FindParts(vtkPolyData* input);
  vtkResizedParts TakeParts(
    vtkDataArray* ids, vtkIdType numberOfPoints, const vtkSurfaceMesh& surface);

  /// Of a table: parts, and what is set for them.
  struct Rows
  {
    std::map<double, double> Values;
    std::set<double> Repeated; // parts that were added more than once
  };
  void SetRow(Rows& rows, double part, double value);
  void AddRow(Rows& rows, double part, double value);
  void RemoveRows(Rows& rows);
  static double GetRow(const Rows& rows, double part, double otherwise);
  void TakeRows(
    const Rows& rows, const char* name, const vtkResizedParts& parts, vtkPartValues& values);

  Rows Sizes;
  Rows Roundness;
  Rows NormalBlends;
  double BlendWidth = 0.05;
  double HeadHeight = 0.0;
  int Head = -1;
  vtkIdType EffectiveHead = -1;
  bool KeepOnGround = false;
  int UpAxis = Y_AXIS;

  std::shared_ptr<KnownParts> Known; // kept while the surface stays the same
};

#endif
