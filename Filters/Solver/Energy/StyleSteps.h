// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The local and the global step of StyleEnergy, for LocalGlobal.
#ifndef SphericalStyle_StyleSteps_h
#define SphericalStyle_StyleSteps_h

#include "GlobalStep.h"
#include "LocalGlobal.h"
#include "LocalTerm.h"

namespace SphericalStyle
{
enum class Anchor
{
  Centroid, ///< the mean of each component stays, points weighted by their rest areas
  LastPoint ///< the last point of each component stays (thesis)
};

/// Keeps references to all that it is made from.
class StyleSteps : public TwoStepEnergy
{
public:
  /// @param R  a rotation per point, where the local step starts and what it finds
  /// @param P  rest positions @param areas  of the points
  /// @param restMeans  of the components, for Anchor::Centroid
  /// @param term  further term of the local step, or nullptr
  StyleSteps(StyleEnergy& energy, GlobalStep& global, Matrices& R, const Points& P,
    const Eigen::VectorXd& areas, const Points& restMeans, Anchor anchor, LocalTerm* term)
    : Energy(energy)
    , Global(global)
    , R(R)
    , P(P)
    , Areas(areas)
    , RestMeans(restMeans)
    , Anchored(anchor)
    , Term(term)
  {
  }

  double FitLocal(const Points& Q) override;
  void SolveGlobal(Points& Q) override;
  EnergyTerms Evaluate(const Points& Q) const override;

  /// Puts the anchor of every component back where it was; components with a fixed point stay.
  void MoveComponents(Points& Q) const;

private:
  StyleEnergy& Energy;
  GlobalStep& Global;
  Matrices& R;
  const Points& P;
  const Eigen::VectorXd& Areas;
  const Points& RestMeans;
  Anchor Anchored;
  LocalTerm* Term;
  Matrices S;
  Points B;
};
} // namespace SphericalStyle

#endif
