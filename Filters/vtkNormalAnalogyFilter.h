// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNormalAnalogyFilter
 * @brief   give a surface the normals of a style shape
 *
 * The output is the input with moved points: each piece of the surface turns to the normal of the
 * style shape that is closest to its own, as far as Weight says, and stays as rigid as that allows.
 * A cube as style makes a model blocky, a tetrahedron makes it pointed. A style with many normals,
 * such as a fine sphere, changes next to nothing: every direction is already one of the style's.
 *
 * Input port 0 and the outputs are those of vtkLocalTermAlgorithm, with one more point array,
 * TargetNormal (3; t, see GenerateTargetNormal); the term's column in the table is Analogy.
 *
 * Input port 1, optional: vtkPolyData, the style shape for Style Mesh. Only the normals of its
 * faces count, so they must point outward (vtkPolyDataNormals); equal ones count once.
 *
 * Energy [analogy]: that of vtkLocalTermAlgorithm with
 *
 *     Weight * sum over points y of a_y |R_y n_y - t_y|^2
 *
 * n_y the normal and a_y the area (a third of the triangles at y) of point y, t_y the style normal
 * closest to n_y.
 *
 * Source: H.-T. D. Liu, A. Jacobson, Normal-Driven Spherical Shape Analogies, Computer Graphics
 * Forum 40(5), SGP 2021, with the closest-normal mapping: the method that the thesis compares with
 * in Fig. 4.23. The bracketed labels are those of Filters/Documentation/NormalAnalogy.md.
 *
 * Cost: one sparse factorization, then per iteration one 3 x 3 rotation per point and one
 * triangular solve.
 *
 * @sa vtkCubicStyleFilter vtkSphericalStyleFilter vtkPlatonicSolidSource
 */
#ifndef vtkNormalAnalogyFilter_h
#define vtkNormalAnalogyFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkLocalTermAlgorithm.h"
#include "vtkSetRangeMacro.h" // for its macro

class SPHERICALSTYLEFILTERS_EXPORT vtkNormalAnalogyFilter : public vtkLocalTermAlgorithm
{
public:
  static vtkNormalAnalogyFilter* New();
  vtkTypeMacro(vtkNormalAnalogyFilter, vtkLocalTermAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Styles
  {
    TETRAHEDRON = 0,
    CUBE = 1,
    OCTAHEDRON = 2,
    ICOSAHEDRON = 3,
    DODECAHEDRON = 4,
    MESH = 5
  };

  ///@{
  /**
   * The style shape of input port 1, for Style Mesh.
   */
  void SetStyleMeshConnection(vtkAlgorithmOutput* mesh);
  void SetStyleMeshData(vtkPolyData* mesh);
  ///@}

  ///@{
  /**
   * Shape whose normals the surface gets: one of the five regular solids as vtkPlatonicSolidSource
   * places them, with normals that face outward (Cube, the default, along the axes), or Mesh, input
   * port 1.
   */
  vtkSetRangeMacro(Style, int, TETRAHEDRON, MESH);
  vtkGetMacro(Style, int);
  void SetStyleToTetrahedron() { this->SetStyle(TETRAHEDRON); }
  void SetStyleToCube() { this->SetStyle(CUBE); }
  void SetStyleToOctahedron() { this->SetStyle(OCTAHEDRON); }
  void SetStyleToIcosahedron() { this->SetStyle(ICOSAHEDRON); }
  void SetStyleToDodecahedron() { this->SetStyle(DODECAHEDRON); }
  void SetStyleToMesh() { this->SetStyle(MESH); }
  ///@}

  ///@{
  /**
   * Weight lambda of the normals. 0 leaves the model as it is, larger is nearer to the style, 10 is
   * large. No unit. Range 0 and up; a negative or non-finite value is an error. Default 1.
   */
  vtkSetMacro(Weight, double);
  vtkGetMacro(Weight, double);
  ///@}

  ///@{
  /**
   * Add the point array TargetNormal. Default on.
   */
  vtkSetMacro(GenerateTargetNormal, bool);
  vtkGetMacro(GenerateTargetNormal, bool);
  vtkBooleanMacro(GenerateTargetNormal, bool);
  ///@}

  /// Fact of the last execution: normals that the style has.
  vtkGetMacro(NumberOfStyleNormals, int);

protected:
  vtkNormalAnalogyFilter();
  ~vtkNormalAnalogyFilter() override;

  std::shared_ptr<SphericalStyle::LocalTerm> MakeTerm(vtkInformationVector** inputs) override;
  const char* GetTermName() const override { return "Analogy"; }
  void AddArrays(const SphericalStyle::LocalTerm& term, const vtkSurfaceMesh& surface,
    vtkPolyData* output) override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkNormalAnalogyFilter(const vtkNormalAnalogyFilter&) = delete;
  void operator=(const vtkNormalAnalogyFilter&) = delete;

  int Style = CUBE;
  double Weight = 1.0;
  bool GenerateTargetNormal = true;

  int NumberOfStyleNormals = 0;
};

#endif
