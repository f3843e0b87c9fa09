// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCubicStyleFilter
 * @brief   give a surface the style of a cube
 *
 * The output is the input with moved points: the normals of the surface lean toward the coordinate
 * axes as far as Cubeness says, and every small piece of it stays as rigid as that allows. Flat
 * sides and sharp edges form; details stay. Turn the model first to choose the axes of the cube.
 *
 * Inputs and outputs are those of vtkLocalTermAlgorithm; the term's column in the table is Cubic.
 *
 * Energy [cubic]: that of vtkLocalTermAlgorithm with
 *
 *     Cubeness * sum over points y of a_y |R_y n_y|_1
 *
 * n_y the normal and a_y the area (a third of the triangles at y) of point y, |x|_1 the sum of the
 * absolute components: least for unit vectors on an axis.
 *
 * Source: H.-T. D. Liu, A. Jacobson, Cubic Stylization, ACM Transactions on Graphics 38(6),
 * SIGGRAPH Asia 2019, doi:10.1145/3355089.3356495. The bracketed labels are those of
 * Filters/Documentation/CubicStyle.md.
 *
 * Cost: one sparse factorization, then per iteration a small problem per point (some dozens of 3 x
 * 3 rotations) and one triangular solve. Some hundred iterations are usual: the energy is flat
 * where a normal is between two axes. So other defaults: Tolerance 1e-3, MaximumNumberOfIterations
 * 500.
 *
 * @sa vtkNormalAnalogyFilter vtkSphericalStyleFilter
 */
#ifndef vtkCubicStyleFilter_h
#define vtkCubicStyleFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkLocalTermAlgorithm.h"

class SPHERICALSTYLEFILTERS_EXPORT vtkCubicStyleFilter : public vtkLocalTermAlgorithm
{
public:
  static vtkCubicStyleFilter* New();
  vtkTypeMacro(vtkCubicStyleFilter, vtkLocalTermAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Weight lambda of the cubic term. 0 leaves the model as it is, larger is nearer to a cube; 0.1
   * to 1 is usual. No unit. Range 0 and up; a negative or non-finite value is an error. Default
   * 0.5.
   */
  vtkSetMacro(Cubeness, double);
  vtkGetMacro(Cubeness, double);
  ///@}

protected:
  vtkCubicStyleFilter();
  ~vtkCubicStyleFilter() override;

  std::shared_ptr<SphericalStyle::LocalTerm> MakeTerm(vtkInformationVector** inputs) override;
  const char* GetTermName() const override { return "Cubic"; }

private:
  vtkCubicStyleFilter(const vtkCubicStyleFilter&) = delete;
  void operator=(const vtkCubicStyleFilter&) = delete;

  double Cubeness = 0.5;
};

#endif
