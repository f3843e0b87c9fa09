// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The energy of the linear feature: options in, deformed points and a report out.
#ifndef SphericalStyle_StyleSolver_h
#define SphericalStyle_StyleSolver_h

#include "StyleSteps.h"
#include "TargetDirections.h"

#include <memory>

namespace SphericalStyle
{
/// What holds the parts of a model together.
enum class ComponentCoupling
{
  Stitched,   ///< edges between near parts: the model is one component [stitch]
  Independent ///< nothing: each component has an anchor of its own (thesis)
};

enum class InitialGuess
{
  Blend, ///< R = I, or see fixedTurns, and one global step, not counted [start]
  Rest   ///< the rest points (thesis)
};

/// What the user wants, in model units.
struct StyleOptions : TargetOptions
{
  SphericalWeighting sphericalWeighting = SphericalWeighting::Uniform;
  ConcaveEdges concaveEdges = ConcaveEdges::Keep;
  EdgeWeighting edgeWeighting = EdgeWeighting::HalfEdge;
  Anchor anchor = Anchor::Centroid;
  ComponentCoupling componentCoupling = ComponentCoupling::Independent;
  InitialGuess initialGuess = InitialGuess::Blend;
  LoopOptions loop;
  LinearMethod linearMethod = LinearMethod::Automatic;

  Points fixedPositions; ///< one row per fixed point, where it is exactly
  /// One rotation vector per fixed point, radians, or none. The start then has rotations that pass
  /// from one fixed point to the next, harmonic fields of the vectors [handles], in the place of
  /// R = I. For InitialGuess::Blend without a local term.
  Points fixedTurns;

  /// Another style in the local step; with lambda = 0 it is the whole style. Starts from rest: the
  /// blend is not near its minimum. Counts as the second term of the history.
  std::shared_ptr<LocalTerm> localTerm;
};

/// The method of the thesis to the letter: the options with everything else overridden.
StyleOptions ThesisOptions(StyleOptions options);

/// @param n  number of points @throw std::invalid_argument for options out of range or of wrong
/// size
void CheckOptions(const StyleOptions& options, int n);

/// Wall time of the stages of one solve, seconds.
struct StageSeconds
{
  double triangles = 0.0; ///< those of the energy, where they are not the surface's
  double base = 0.0;      ///< grid and base [base], shares of several centers
  double weights = 0.0;   ///< cotangents, weights, targets
  double analyze = 0.0;   ///< matrix, ordering, symbolic factor
  double factor = 0.0;    ///< numeric factor
  double iterate = 0.0;   ///< start and loop
};

struct StyleReport
{
  LoopReport loop;
  Sphere sphere;                   ///< what was used, model units; of the first center
  std::vector<Sphere> spheres;     ///< of every center
  TargetShape shape;               ///< in the place of the spheres [target]
  bool closedForm = false;         ///< the minimum was known: nothing was solved [blend]
  int components = 0;              ///< of the triangles as given
  std::vector<int> pointsOnCenter; ///< points without a direction of their own
  int concaveHalfEdges = 0;        ///< flipped or zeroed
  int edgeFlips = -1;              ///< with IntrinsicDelaunay; -1 otherwise
  int negativeEdges = -1;          ///< see IntrinsicTriangulation; -1 otherwise
  int stitches = 0;                ///< edges between parts [stitch]
  bool factored = false;           ///< whether this solve had to factor
  bool hasMinimum = true;          ///< false only with full-edge weights: E is unbounded below
  std::string linearSolver = "none";
  int unfinishedSolves = 0; ///< by conjugate gradients, of this matrix: ended at their limit
  int gridFunctions = 0;    ///< of the grid [grid]; 0 without details
  double gridSpacing = 0.0; ///< fraction of the diagonal
  bool coarserGrid = false; ///< the grid could not be as fine as the details
  int walls = 0;            ///< pairs through thin walls, in the grid [wall]
  double sizeFactor = 1.0;  ///< by which the result was scaled [size]
  StageSeconds seconds;
};

struct StyleResult
{
  Points positions;             ///< P', n x 3, model units
  Points directions;            ///< t, n x 3
  Matrices rotations;           ///< R, n, rest to deformed
  Eigen::VectorXd cellEnergies; ///< n, length^2, without a local term
};

/// Built once per mesh and kept: a solve redoes only what its options make stale. The stages of its
/// State, with their keys, are what that is; numeric factors are made again for other weights.
/// Other triangles redo all, other points all but topology, ordering and symbolic factor; all that
/// is in no key redoes targets.
class StyleSolver
{
public:
  StyleSolver();
  ~StyleSolver();

  /// Takes the mesh; keeps everything that an equal mesh or equal triangles allow to keep.
  /// @throw std::invalid_argument: see MeshTopology; points not finite; triangles without area
  void SetMesh(std::shared_ptr<const TriangleMesh> mesh);
  /// The same with a copy of it.
  void SetMesh(const TriangleMesh& mesh);

  /// Counts the meshes that were not equal to the one before: what else depends on the mesh alone
  /// can be kept as long as this stays.
  int GetMeshGeneration() const { return this->MeshGeneration; }

  /// Deforms the mesh. @throw std::invalid_argument for options out of range or of wrong size, and
  /// without a mesh
  /// @throw SolverError @return the report; positions and rotations are then at hand
  StyleReport Solve(const StyleOptions& options, const Callback& callback = {});

  /// Of the last solve; it is not kept here, nor what it was worked out from.
  StyleResult TakeResult();
  /// The same, as long as it is here. @{
  const Points& GetPositions() const;      ///< P', n x 3, model units
  const Points& GetDirections() const;     ///< t, n x 3
  const Matrices& GetRotations() const;    ///< R, n, rest to deformed
  Eigen::VectorXd GetCellEnergies() const; ///< n, length^2, without a local term
  /// @}

private:
  class State;
  std::unique_ptr<State> S;
  int MeshGeneration = 0;
};
} // namespace SphericalStyle

#endif
