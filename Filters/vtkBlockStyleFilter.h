// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBlockStyleFilter
 * @brief   Turn each part of a surface into blocks along its own axes
 *
 * The output is the input with moved points: the normals of each part gather along three axes at
 * right angles, as far as Blockiness says, and every small piece stays as rigid as that allows. The
 * axes are the part's own: those that its normals are nearest to.
 *
 * Inputs and outputs are those of vtkLocalTermAlgorithm; the term's column in the table is
 * Block.
 *
 * Energy [block]: that of vtkLocalTermAlgorithm with
 *
 *     Blockiness * sum over points y of a_y |R_y n_y - t_y|^2
 *
 * n_y the normal and a_y the area (a third of the triangles at y) of point y, t_y the half axis of
 * its part closest to n_y.
 *
 * Source: the term is that of H.-T. D. Liu, A. Jacobson, Normal-Driven Spherical Shape Analogies,
 * Computer Graphics Forum 40(5), SGP 2021; what its targets are is our own. The bracketed label is
 * that of Filters/Documentation/BlockStyle.md.
 *
 * Cost: one sparse factorization, then per iteration one 3 x 3 rotation per point and one
 * triangular solve.
 *
 * @sa vtkNormalAnalogyFilter vtkCubicStyleFilter vtkSphericalStyleFilter
 */
#ifndef vtkBlockStyleFilter_h
#define vtkBlockStyleFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkLocalTermAlgorithm.h"

class SPHERICALSTYLEFILTERS_EXPORT vtkBlockStyleFilter : public vtkLocalTermAlgorithm
{
public:
  static vtkBlockStyleFilter* New();
  vtkTypeMacro(vtkBlockStyleFilter, vtkLocalTermAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Weight lambda of the style. 0 leaves the model as it is, larger is nearer to the style, 10 is
   * large. No unit. Range 0 and up; a negative or non-finite value is an error. Default 1.
   */
  vtkSetMacro(Blockiness, double);
  vtkGetMacro(Blockiness, double);
  ///@}

protected:
  vtkBlockStyleFilter();
  ~vtkBlockStyleFilter() override;

  std::shared_ptr<SphericalStyle::LocalTerm> MakeTerm(vtkInformationVector** inputs) override;
  const char* GetTermName() const override { return "Block"; }

private:
  vtkBlockStyleFilter(const vtkBlockStyleFilter&) = delete;
  void operator=(const vtkBlockStyleFilter&) = delete;

  double Blockiness = 1.0;
};

#endif
