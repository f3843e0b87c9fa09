// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLocalTermAlgorithm
 * @brief   superclass of filters whose style is one further term of the local step
 *
 * The iteration, when it ends, and the table of the energy are those of vtkIterativeStyleAlgorithm.
 *
 * Input port 0: vtkPolyData. Triangles, quads, polygons and strips take part in the solve
 * (triangulated inside, cells unchanged on output); lines, vertices and points of no face are
 * carried along unmoved. Open borders, several components (each keeps its centroid), non-manifold
 * edges and coincident points (solved as one) are allowed.
 *
 * Output port 0: vtkPolyData with the cells, point order and every array of the input, and the
 * point arrays Displacement (3; output minus input point, model length) and normals, recomputed if
 * the input had some or GenerateNormals is on.
 *
 * Energy, minimized over points p' and rotations R by local and global steps:
 *
 *     E = sum over triangles f, half-edges h = uv of f, corners y of f of c_h |e'_uv - R_y e_uv|^2
 *       + sum over points y of the filter's own term of R_y
 *
 * with half cotangents c_h. The own term says nothing of p', so that the matrix is that of the
 * first sum: one sparse factorization (about n log n in practice), kept while the points stay.
 *
 * @sa vtkCubicStyleFilter vtkNormalAnalogyFilter
 */
#ifndef vtkLocalTermAlgorithm_h
#define vtkLocalTermAlgorithm_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkIterativeStyleAlgorithm.h"

#include <memory> // for std::unique_ptr, std::shared_ptr

class vtkPolyData;
struct vtkSurfaceMesh;

namespace SphericalStyle
{
class LocalTerm;
struct StyleReport;
}

class SPHERICALSTYLEFILTERS_EXPORT vtkLocalTermAlgorithm : public vtkIterativeStyleAlgorithm
{
public:
  vtkTypeMacro(vtkLocalTermAlgorithm, vtkIterativeStyleAlgorithm);

protected:
  vtkLocalTermAlgorithm();
  ~vtkLocalTermAlgorithm() override;

  /// The term, as the filter is set. @throw std::invalid_argument naming the property or input
  virtual std::shared_ptr<SphericalStyle::LocalTerm> MakeTerm(vtkInformationVector** inputs) = 0;

  /// Name of the term's column in the table.
  virtual const char* GetTermName() const = 0;

  /// After the solve: point arrays of the filter's own. Adds none by default.
  virtual void AddArrays(
    const SphericalStyle::LocalTerm& term, const vtkSurfaceMesh& surface, vtkPolyData* output);

  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkLocalTermAlgorithm(const vtkLocalTermAlgorithm&) = delete;
  void operator=(const vtkLocalTermAlgorithm&) = delete;

  /// RequestData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);
  SphericalStyle::StyleReport Solve(const std::shared_ptr<SphericalStyle::LocalTerm>& term);

  struct Internals; // what is kept between executions
  std::unique_ptr<Internals> Internal;
};

#endif
