// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMovedSurface.h"

#include "DeformationMeasures.h"
#include "SurfaceMeasures.h" // for BoundsOf
#include "UnitScale.h"
#include "vtkFilterSupport.h"
#include "vtkStyleAlgorithm.h"
#include "vtkTurnedArrays.h"

#include "vtkPolyData.h"

using SphericalStyle::Matrices;
using SphericalStyle::Points;

namespace
{
/// Of each mesh point, from the mesh to Q.
Matrices RotationsOf(const vtkSurfaceMesh& surface, const Points& Q, int threads)
{
  const auto [low, high] = SphericalStyle::BoundsOf(surface.Mesh.P, surface.Part);
  const double unit = SphericalStyle::UnitScale(low.cwiseAbs().cwiseMax(high.cwiseAbs()));
  return SphericalStyle::SurfaceRotations(
    { unit * surface.Mesh.P, surface.Mesh.F }, unit * Q, threads, surface.Part);
}

/// Of each mesh point: whether a triangle at it has moved. Elsewhere nothing turns, not by rounding
/// either.
Eigen::VectorXd TouchedBy(const vtkSurfaceMesh& surface, const Points& Q)
{
  const Points& P = surface.Mesh.P;
  Eigen::VectorXd touched = Eigen::VectorXd::Zero(P.rows());
  for (const auto& f : surface.Mesh.F.rowwise())
  {
    const bool moved =
      Q.row(f[0]) != P.row(f[0]) || Q.row(f[1]) != P.row(f[1]) || Q.row(f[2]) != P.row(f[2]);
    for (int k = 0; k < 3 && moved; ++k)
    {
      touched[f[k]] = 1.0;
    }
  }
  surface.Part.SumAtShared(touched.data(), 1);
  return touched;
}

void TurnVectors(vtkPolyData* output, const vtkSurfaceMesh& surface, const Points& Q, int threads)
{
  const Matrices R = RotationsOf(surface, Q, threads);
  const Eigen::VectorXd touched = TouchedBy(surface, Q);
  vtkTurnedArrays::Turn(output,
    [&](vtkIdType i) -> const Eigen::Matrix3d*
    {
      const int from = surface.MeshPoint[i];
      return from >= 0 && touched[from] > 0.0 ? &R[from] : nullptr;
    });
}
}

void vtkMovedSurface::Fill(
  vtkStyleAlgorithm* self, vtkPolyData* output, const vtkSurfaceMesh& surface, const Points& Q)
{
  vtkSurfaceMeshConversion::ReplacePoints(
    output, surface, Q, self->GetOutputPointsPrecision(), self->GetGenerateNormals());
  if (self->GetTransformAllInputVectors() && surface.Part.Max(Q.rows() > 0 ? 1.0 : 0.0) > 0.0)
  {
    TurnVectors(output, surface, Q, vtkFilterSupport::ThreadsToUse(self->GetNumberOfThreads()));
  }
}
