// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The style in closed form: a smooth base is blended with its target, details are carried along
/// [base] [toy] [carry].
#ifndef SphericalStyle_ClosedFormStyle_h
#define SphericalStyle_ClosedFormStyle_h

#include "Callback.h"
#include "ModelSize.h"
#include "TargetDirections.h"

#include <memory>

namespace SphericalStyle
{
/// How thick a limb becomes that follows its normals (NormalBlend).
enum class NormalRadius
{
  OwnThickness, ///< as it is: rho_i [limb]
  WholeModel    ///< as the whole model: r (thesis)
};

/// What the closed form knows beyond the target.
struct DetailOptions
{
  /// s, fraction of the diagonal of the bounds: what is smaller is a detail [base]; 0: the model is
  /// its own base. With details the given normals are not used, for the base has its own.
  double detailSize = 0.0;
  NormalRadius normalRadius = NormalRadius::OwnThickness;
  SizeOptions size;
  bool keepRotations = false; ///< R is wanted
};

/// The share of its way to the target that a point goes: mu / (1 + mu), mu = sqrt(3) lambda [toy].
/// @param lambda  0 or more @return 0..1
double ShareOfWay(double lambda);

/// What is wanted, in the units of the frame.
struct ClosedFormOptions
  : TargetOptions
  , DetailOptions
{
  bool keepLastPoint = false; ///< the last point stays, and not the mean
};

struct ClosedFormReport
{
  std::vector<Sphere> spheres;     ///< of every center
  TargetShape shape;               ///< in the place of the spheres
  std::vector<int> pointsOnCenter; ///< points without a direction of their own
  int functions = 0;               ///< of the grid; 0 without details
  double spacing = 0.0;            ///< of the grid
  bool coarser = false;            ///< the grid could not be as fine as the details
  int walls = 0;                   ///< pairs through walls
  double scale = 1.0;              ///< by which the result was scaled [size]
  double baseSeconds = 0.0;        ///< grid, base, normals, thickness, where they were made anew
  double carrySeconds = 0.0;
};

struct ClosedFormResult
{
  Points positions;   ///< P', n x 3
  Points directions;  ///< t, n x 3, of Solve
  Matrices rotations; ///< R, n, or none
};

/// Where a preview looks at a large model.
struct PreviewPlaces
{
  std::vector<int> points; ///< of the mesh, those wanted
  /// Triangles that stand for all of this process, each for the same area; one may come again. None
  /// without area.
  std::vector<int> probes;
  double areaOfProbe = 0.0; ///< that area, in the frame
};

/// Nothing iterates, and nothing is factored that is as large as the mesh.
///
///     T_i = O + (1 - a) r R_i d_i + a rho_i n_i        B'_i = B_i + mu / (1 + mu) (T_i - B_i)
///     P'_i = B'_i + c_i R_i (P_i - B_i)
///
/// R_i = R(d_i) is 1 for the sphere, else as far as the target shape reaches (TargetShape).
///
/// The stages of its State, with their keys, are what a change redoes; all that is in no key redoes
/// targets, rotations and the sum.
///
/// Base: with sigma = smooth_s(smooth_s(1)), which the ridge of A_s makes less than 1 on loose
/// parts that are small against a cell, and e_i = clamp(1.5 - 50 |1 - sigma_i|, 0, 1),
///
///     B_i = P_i + e_i (smooth_s(smooth_s(P))_i - P_i).
///
/// Normals of the base: with N the area vectors that the gradients of B make of N_k, and (v, u) =
/// N / w_k and |N| / w_k smoothed once, n_i = v_i / max(|v_i|, u_i / 5):
/// shorter than 1 where the two sides of a thin wall cancel. Triangles are turned to agree with
/// their neighbors and to enclose a positive volume before.
///
/// Rotations: with G_k and G'_k the mean gradients of B and B' in sample k, N and N' the area
/// vectors that they make of N_k, R_i is the rotation closest to
///
///     smooth_s(smooth_s(G'_k G_k^T + N' N^T / (w_k sqrt(|N'| |N|)))).
///
/// Call this matrix S_i. R_i is not determined where det S_i < 0 and the two smaller singular
/// values are equal. c_i, the smoothstep of RotationCertainty, is 1 where det S_i >= 0 and goes to
/// 0 toward such a place.
///
/// Details give way where they would fold: with a_k the area of B' in sample k
/// along the turned normal R_k N_k, b_k that of P', and g_k = a_k / 2 - b_k > 0, the share that
/// brings b_k to a_k / 2 is y_k = min(1, g_k / max(a_k - b_k, -a_k / 2)), else 0. It fades with
/// c_k, and where a_k < 0 or g_k is small beside the usual u_k = .2 |N_k|^2 sum |N'| / sum |N|:
/// times clamp(1 + a_k / u_k, 0, 1) and min(1, g_k / u_k). P'_i moves toward B'_i by the share
/// smooth_s(y^2)_i / (smooth_s(y)_i + .01): the mean of y where it is not 0, which fades where few
/// such places are near. P' does not jump while lambda changes.
///
/// With OwnThickness rho is bounded by the largest radius of all centers. What is outside of the
/// region takes part in base, normals, rotations and thickness, but not in mean, size and ground.
/// The result is moved so that its mean stays, then scaled about it, then put on the ground [size].
///
/// Several centers: T_i = sum_k omega_k (O_k + ...) + Y, omega the smooth shares of the centers,
/// and Y the field with grad Y nearest to - sum_k (O_k + ...) grad omega_k: parts keep together,
/// each moves as a whole [centers]. The grid of shares and joints has the size of the blend, but at
/// least .02.
///
/// Parts with a factor of lambda or a blend of their own: B'_i as above, plus a field Y with grad Y
/// nearest to - (T - B) grad m - m dT/da grad a, m = mu / (1 + mu): so that parts keep together and
/// are not drawn out where m and a change [styles]. Its grid has the size .03.
///
/// Of a surface that is spread over processes each calls SetMesh, Solve and Carry with its part and
/// the same options but for arrays, and gets its part of the result: that of one process up to
/// rounding. Sent are the samples of the grids and sums over them, whatever the number of points,
/// and some numbers for each point that several processes have. All processes are aborted together.
///
/// Cost at n points: a pass over the triangles for the grid, sums over its samples and a factor of
/// G functions (SurfaceGrid), the pairs of samples of a coarse grid; then a change costs some
/// 20 small solves and a few passes over points and triangles. Memory about 400 bytes a point.
class ClosedFormStyle
{
public:
  ClosedFormStyle();
  ~ClosedFormStyle();

  /// @param P  n x 3, in a frame of diagonal 1 @param F  m x 3; both must outlive this
  void SetMesh(const Points& P, const Triangles& F, SurfacePart part = {});
  /// The same mesh at another place in memory: everything is kept.
  void SetEqualMesh(const Points& P, const Triangles& F, SurfacePart part = {});
  /// Rounds the points of the mesh where they are now [pose], until SetMesh or SetEqualMesh.
  /// @param X  n x 3, must outlive this @param changed  whether they have moved since the last call
  void SetPose(const Points& X, bool changed);
  /// @param callback  asked after each step, with its number; what is done is kept for the next
  /// solve @throw std::invalid_argument, SolverError, PartWithoutSphere, SolveAborted
  ClosedFormReport Solve(const ClosedFormOptions& options, const Callback& callback = {});
  /// What Solve gives, at some points, in a time that does not depend on the number of points of
  /// the mesh where Solve was called with the same detail size before: see ClosedFormPreview. The
  /// thickness of limbs stays as it was, whatever the radius.
  /// @param places  must not change; what belongs to them is kept until there are others
  /// @param options  without arrays and regions, with one center
  ClosedFormReport Preview(const std::shared_ptr<const PreviewPlaces>& places,
    const ClosedFormOptions& options, const Callback& callback = {});
  /// Carries the details on a base that another method has deformed: P' = B' + R (P - B), B' the
  /// base of Q.
  /// @param Q  n x 3, what became of P
  ClosedFormReport Carry(
    const Points& Q, const ClosedFormOptions& options, const Callback& callback = {});

  /// (rho_i / r) n_i: normals by the thickness of the limb, for another method; r of the first
  /// center.
  Points ThickNormals(const ClosedFormOptions& options, const Callback& callback = {});

  /// Of the last solve; it is not kept here.
  ClosedFormResult TakeResult();
  /// The same, as long as it is here. @{
  const Points& GetPositions() const;   ///< P', n x 3
  const Points& GetDirections() const;  ///< t, n x 3
  const Matrices& GetRotations() const; ///< R, n, or none
  /// @}
  const Points& GetBase() const; ///< B, n x 3

private:
  class State;
  std::unique_ptr<State> S;
};
} // namespace SphericalStyle

#endif
