// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "StyleSteps.h"

namespace SphericalStyle
{
double StyleSteps::FitLocal(const Points& Q)
{
  if (!this->Term)
  {
    return this->Energy.FitRotations(Q, this->R);
  }
  this->Energy.Covariances(Q, this->S);
  return this->Term->Fit(this->S, this->R, this->Energy.GetThreads());
}

void StyleSteps::SolveGlobal(Points& Q)
{
  this->Energy.RightHandSide(this->R, this->B);
  this->Global.Solve(this->B, Q, this->Energy.GetThreads());
  this->MoveComponents(Q);
}

EnergyTerms StyleSteps::Evaluate(const Points& Q) const
{
  EnergyTerms terms = this->Energy.Evaluate(Q, this->R);
  terms.spherical += this->Term ? this->Term->Evaluate(this->R) : 0.0;
  return terms;
}

void StyleSteps::MoveComponents(Points& Q) const
{
  const MeshTopology& topology = this->Energy.GetTopology();
  Points move;
  if (this->Anchored == Anchor::Centroid)
  {
    move = this->RestMeans - topology.ComponentMeans(Q, this->Areas);
  }
  else
  {
    const std::vector<int>& last = topology.GetLastPoints();
    move = this->P(last, AllColumns) - Q(last, AllColumns);
  }
  for (Eigen::Index c = 0; c < move.rows(); ++c)
  {
    if (this->Global.GetComponentIsPinned()[c])
    {
      move.row(c).setZero();
    }
  }
  const std::vector<int>& component = topology.GetComponents();
  for (Eigen::Index i = 0; i < Q.rows(); ++i)
  {
    Q.row(i) += move.row(component[i]);
  }
}
} // namespace SphericalStyle
