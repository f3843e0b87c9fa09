// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The target sphere, the directions t toward it and the edge targets tau [symbols].
#ifndef SphericalStyle_TargetDirections_h
#define SphericalStyle_TargetDirections_h

#include "Frame.h"
#include "MeshTopology.h"
#include "TargetShape.h"

namespace SphericalStyle
{
enum class CenterMode
{
  PointMean,    ///< mean of the points (thesis)
  AreaCentroid, ///< mean of the surface
  Custom
};

enum class RadiusMode
{
  EqualArea,   ///< sqrt(A / 4 pi) (thesis)
  EqualVolume, ///< cube root of 3 V / 4 pi
  Custom
};

/// What becomes of an edge target that opposes its edge on the rest shape (Eq. 4.39).
enum class ConcaveEdges
{
  Keep,
  Flip,
  Zero
};

struct Sphere
{
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< O
  double radius = 1.0;                              ///< r > 0
};

/// Where the surface is drawn, and how strongly. Lengths and positions are in one unit, that of the
/// model or of its frame. Arrays of 0 rows mean "none".
struct TargetOptions
{
  double lambda = 0.5;      ///< roundness, >= 0
  double normalBlend = 0.0; ///< a, 0..1
  CenterMode centerMode = CenterMode::PointMean;
  RadiusMode radiusMode = RadiusMode::EqualArea;
  Sphere custom;      ///< for the Custom modes
  ShapeOptions shape; ///< what is as large as the sphere, and the target in its place [target]

  Eigen::VectorXd roundnessFactors; ///< n, >= 0: lambda_i = lambda * factor
  Eigen::VectorXd normalBlends;     ///< n, 0..1: replaces a
  Eigen::VectorXd partFactors;      ///< n, >= 0: a factor more; parts keep together [styles]
  bool blendsOfParts = false;       ///< so they do where normalBlends change [styles]
  Points normals;                   ///< n x 3 unit normals; computed where absent
  Points targets;                   ///< n x 3, replaces t
  std::vector<int> fixedPoints;     ///< points outside of the region: they stay
  bool sphereOfFreePoints = false;  ///< O and r from the points that are not fixed alone

  std::vector<int> centerIds; ///< n, 0..K-1: the center that a point follows; none: one for all
  Points centers;             ///< K x 3, replace what centerMode gives; not for one center
  double centerBlend = 0.0;   ///< fraction of the diagonal over which centers pass into each other

  int threads = 1;

  /// What the arrays of all processes say, some of which may have no points. @{
  int NumberOfCenters(const SurfacePart& part = {}) const;
  bool HasTargets(const SurfacePart& part = {}) const;
  /// Whether anything is outside of the region.
  bool HasFixedPoints(const SurfacePart& part) const;
  /// Whether normals have a say anywhere.
  bool UsesNormals(const SurfacePart& part = {}) const;
  /// Whether parts have factors or blends of their own.
  bool HasPartStyles(const SurfacePart& part) const;
  /// @}
  /// Both factors of each point; no row where there are none.
  Eigen::VectorXd Factors() const;
  /// The same in the units of a frame.
  TargetOptions Into(const Frame& frame) const;
};

/// @param custom  what the Custom modes take
/// @throw std::invalid_argument when the radius is not above zero
Sphere TargetSphere(const Points& P, const Triangles& F, CenterMode center, RadiusMode radius,
  const Sphere& custom, const SurfacePart& part = {});

/// A part of a surface that has no target sphere.
class PartWithoutSphere : public std::invalid_argument
{
public:
  PartWithoutSphere(int part, const std::string& why)
    : std::invalid_argument("part " + std::to_string(part) + ": " + why)
    , Part(part)
    , Why(why)
  {
  }

  int Part;
  std::string Why; ///< without the part
};

/// The same for each part of a surface by itself: its points, and the triangles that have two or
/// three corners in it (of three parts at one triangle, the part of its first corner takes it).
/// @param parts  n, 0..numberOfParts-1, or -1 for points of no part
/// @throw PartWithoutSphere where TargetSphere throws, and for one without a point or triangle
std::vector<Sphere> TargetSpheres(const Points& P, const Triangles& F,
  const std::vector<int>& parts, int numberOfParts, CenterMode center, RadiusMode radius,
  const Sphere& custom, const SurfacePart& part = {});

/// The target sphere of each center, from points and options in one unit.
/// @throw PartWithoutSphere, std::invalid_argument
std::vector<Sphere> SpheresOfCenters(
  const Points& P, const Triangles& F, const TargetOptions& options, const SurfacePart& part = {});

/// d_i = (p_i - O) / |p_i - O| (Eq. 4.4). A point within 1e-12 diagonals of O has no direction: it
/// takes the mean over the other corners of its triangles (zero when they surround it evenly).
/// @param onCenter  those points, ascending
Points CenterDirections(const Points& P, const Triangles& F, const Eigen::Vector3d& O,
  std::vector<int>& onCenter, const SurfacePart& part = {});

/// The shape whose size and center are those of the target sphere, for a surface in these units.
TargetShape ShapeOf(
  const Points& P, const Triangles& F, const TargetOptions& options, const SurfacePart& part = {});

/// Makes directions d those to the shape, R(d) d [target].
void ReachShape(const TargetShape& shape, int threads, Points& d);

/// t_i = (1 - a_i) d_i + a_i n_i (Eq. 4.6), a of one entry per point.
Points BlendDirections(const Points& d, const Points& n, const Eigen::VectorXd& a);

/// Adds omega_uv r (t_u - t_v) per half-edge to tau (m x 9, length): the targets of one center
/// [energy].
/// @param omega  n, share of this center; an edge takes the mean of its ends, so that both follow
///        the same centers. No rows: 1
void AddEdgeTargets(const Points& t, double r, const Eigen::VectorXd& omega, const Triangles& F,
  HalfEdgeVectors& tau);

/// Flips or zeroes the targets that oppose their edge, tau . e < 0, once on the rest shape.
/// @param rest  rest edges e_uv @return number of half-edges changed
int ChangeConcaveTargets(const HalfEdgeVectors& rest, ConcaveEdges concave, HalfEdgeVectors& tau);
} // namespace SphericalStyle

#endif
