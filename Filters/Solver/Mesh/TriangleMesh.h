// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Types that every part of the solver shares. Eigen only.
#ifndef SphericalStyle_TriangleMesh_h
#define SphericalStyle_TriangleMesh_h

#include <Eigen/Core>

#include <array>
#include <stdexcept>
#include <vector>

namespace SphericalStyle
{
/// n x 3, one point or vector per row.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// m x 3, 0-based corners of the triangles.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// m x 3, one number per half-edge. Half-edge k of triangle (a_0, a_1, a_2) lies opposite corner k
/// and runs from u = a_{k+1} to v = a_{k+2}; its vector is p_u - p_v.
using HalfEdgeScalars = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// m x 9, one vector per half-edge, in the order of the half-edges.
using HalfEdgeVectors = Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor>;
/// One 3 x 3 matrix per point (rotations R, covariances S).
using Matrices = std::vector<Eigen::Matrix3d>;

constexpr double Pi = EIGEN_PI;

/// P(ids, AllColumns) are the rows `ids` of P. Eigen 3.4 and 5 have this type under the same name,
/// but not the same constant.
inline const Eigen::placeholders::all_t AllColumns{};

/// Triangles in space. No orientation, closedness or manifoldness is asked for.
struct TriangleMesh
{
  Points P;    ///< n x 3, length
  Triangles F; ///< m x 3, 0-based
};

/// Whether the meshes have as many points as each other, and the same triangles.
inline bool HaveSameTriangles(const TriangleMesh& one, const TriangleMesh& other)
{
  return one.P.rows() == other.P.rows() && one.F.rows() == other.F.rows() && one.F == other.F;
}

/// Whether the meshes have the same points and triangles, number for number.
inline bool operator==(const TriangleMesh& one, const TriangleMesh& other)
{
  return &one == &other || (HaveSameTriangles(one, other) && one.P == other.P);
}

/// A linear system that cannot be factored, or a result that is not finite.
class SolverError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Corner that half-edge k starts from (u) and ends at (v).
inline int HalfEdgeStart(int k)
{
  return (k + 1) % 3;
}
inline int HalfEdgeEnd(int k)
{
  return (k + 2) % 3;
}
/// Points u and v of half-edge h = 3 * triangle + k.
inline int StartPoint(const Triangles& F, int h)
{
  return F(h / 3, HalfEdgeStart(h % 3));
}
inline int EndPoint(const Triangles& F, int h)
{
  return F(h / 3, HalfEdgeEnd(h % 3));
}

inline Triangles ToTriangles(const std::vector<std::array<int, 3>>& corners)
{
  Triangles F(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t f = 0; f < corners.size(); ++f)
  {
    F.row(static_cast<Eigen::Index>(f)) << corners[f][0], corners[f][1], corners[f][2];
  }
  return F;
}

inline void AppendPoints(Points& P, const std::vector<Eigen::RowVector3d>& more)
{
  const Eigen::Index n = P.rows();
  P.conservativeResize(n + static_cast<Eigen::Index>(more.size()), 3);
  for (std::size_t i = 0; i < more.size(); ++i)
  {
    P.row(n + static_cast<Eigen::Index>(i)) = more[i];
  }
}

/// x_u - x_v for every half-edge uv of a field x of one vector per point.
HalfEdgeVectors HalfEdgeDifferences(const Points& x, const Triangles& F);
} // namespace SphericalStyle

#endif
