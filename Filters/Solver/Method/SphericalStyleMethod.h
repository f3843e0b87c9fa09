// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The whole style: in closed form, or by the energy where that is asked for.
#ifndef SphericalStyle_SphericalStyleMethod_h
#define SphericalStyle_SphericalStyleMethod_h

#include "ClosedFormStyle.h"
#include "Frame.h"
#include "MirroredMesh.h"
#include "StyleSolver.h"

#include <memory>
#include <optional>
#include <utility>

namespace SphericalStyle
{
/// What the user wants, in model units.
struct MethodOptions
  : StyleOptions
  , DetailOptions
{
};

/// The thesis to the letter.
MethodOptions ThesisOptions(MethodOptions options);

/// @param n  number of points @throw std::invalid_argument for options out of range or of wrong
/// size
void CheckOptions(const MethodOptions& options, int n);

/// Whether nothing has to be minimized: cotangent weights, edges of concave places kept, half-edge
/// or intrinsic Delaunay weights, and a rule that stops. Else B' is the base of what minimizes the
/// energy of StyleSolver, without details, and details are carried on it.
bool IsClosedForm(const StyleOptions& options);

/// Keeps what depends on the mesh and on few options, see ClosedFormStyle and StyleSolver.
class SphericalStyleMethod
{
public:
  /// Takes the mesh; an equal one changes nothing.
  /// @param part  of a surface that is spread over processes, whose closed form alone is there
  /// then; where one process fails, all need a new SphericalStyleMethod
  /// @param rest  the mesh in its rest pose, with the same triangles, or nullptr: what is made of
  /// it is kept while the mesh moves [pose]; the closed form alone is there then
  /// @param plane  that the deformation is to be symmetric about [symmetry], of a whole surface
  /// without a rest pose; the closed form alone is there then
  /// @throw std::invalid_argument for a mesh without triangles, points that are not finite or all
  /// equal, a rest pose of another mesh
  void SetMesh(std::shared_ptr<const TriangleMesh> mesh, SurfacePart part = {},
    std::shared_ptr<const TriangleMesh> rest = nullptr,
    const std::optional<MirrorPlane>& plane = {});
  /// The same with a copy of it.
  void SetMesh(const TriangleMesh& mesh);
  /// Counts the meshes that were not equal to the one before.
  int GetMeshGeneration() const { return this->MeshGeneration; }

  /// @param callback  asked after each step of the closed form and each iteration of the energy;
  /// where the closed form is ended by it, the result is the model at rest, without directions
  /// @throw std::invalid_argument, PartWithoutSphere, SolverError
  /// and of a surface that is spread WholeSurfaceNeeded, for a surface with one side
  StyleReport Solve(const MethodOptions& options, const Callback& callback = {});

  /// What Solve gives in closed form, at some points of the mesh of the last Solve: see
  /// ClosedFormStyle::Preview. Positions, directions and rotations are theirs.
  /// @param options  without arrays and regions, with one center, and in closed form
  StyleReport Preview(const std::shared_ptr<const PreviewPlaces>& places,
    const MethodOptions& options, const Callback& callback = {});
  /// Units of the solve, of the last mesh.
  const Frame& GetFrame() const { return this->MeshFrame; }

  /// P' of the last solve; it is not kept here.
  Points TakePositions() { return std::exchange(this->Positions, Points(0, 3)); }
  /// Lets go of what the last solve has led to. What the next one can use is kept.
  void ForgetResult();

  const Points& GetPositions() const { return this->Positions; } ///< P', n x 3, model units
  const Points& GetDirections() const { return this->T; }        ///< t, n x 3
  const Matrices& GetRotations() const { return this->R; }       ///< R, n, where it was wanted
  /// n, length^2; no row where nothing was minimized.
  const Eigen::VectorXd& GetCellEnergies() const { return this->CellEnergies; }

private:
  void TakeAtRest(const TriangleMesh& still, const std::optional<MirrorPlane>& plane, bool known);
  ClosedFormOptions InFrame(const MethodOptions& options) const;
  void ReportClosedForm(const ClosedFormReport& closed, StyleReport& report) const;
  void SolveClosedForm(const MethodOptions& options, const Callback& callback, StyleReport& report);
  void SolveEnergy(const MethodOptions& options, const Callback& callback, StyleReport& report);
  void HoldFixedPoints(const MethodOptions& options);
  void StayAtRest(const MethodOptions& options);
  Points Take(const MethodOptions& options, const ClosedFormReport& closed, StyleReport& report);

  std::shared_ptr<const TriangleMesh> Mesh; // none at first, and where SetMesh has thrown
  std::shared_ptr<const TriangleMesh> Rest; // none without a rest pose
  std::optional<MirroredMesh> Mirrored;     // none without a plane of symmetry
  SurfacePart Part;
  Frame MeshFrame;
  Points P; // of the rest pose or the mesh, in the frame
  Points X; // of the mesh, in the frame; none without a rest pose
  int MeshGeneration = 0;
  ClosedFormStyle Closed;
  StyleSolver Energy;
  Points Positions;
  Points T;
  Matrices R;
  Eigen::VectorXd CellEnergies;
};
} // namespace SphericalStyle

#endif
