// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Normals of a style shape for a surface [analogy]: the term of TargetNormals, t_y the style
/// normal closest to n_y. H.-T. D. Liu, A. Jacobson, Normal-Driven Spherical Shape Analogies,
/// Computer Graphics Forum 40(5), SGP 2021, with the closest-normal mapping.
#ifndef SphericalStyle_NormalAnalogy_h
#define SphericalStyle_NormalAnalogy_h

#include "TargetNormals.h"

#include <functional>

namespace SphericalStyle
{
/// The unit normals of the triangles, k x 3, in the order of their first triangle; those that agree
/// to about 1e-6 count once, triangles without an area not at all.
Points DistinctNormals(const Points& P, const Triangles& F);

class NormalAnalogy : public TargetNormals
{
public:
  /// Targets t (n x 3, unit) of unit normals n; a normal of 0 has none.
  using NormalMap = std::function<Points(const Points& normals)>;

  /// @param map  called once per solve @param lambda  weight, >= 0, no unit
  /// @throw std::invalid_argument for a lambda that is negative or not finite
  NormalAnalogy(NormalMap map, double lambda);

private:
  Points MakeTargets(const Points& P, const Triangles& F, const Points& normals) const override;

  NormalMap Map;
};
} // namespace SphericalStyle

#endif
