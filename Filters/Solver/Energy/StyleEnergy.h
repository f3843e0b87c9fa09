// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The energy of the linear feature [energy] (Eq. 4.8):
///
///     E(P', R) = sum_f sum_{h in f} sum_{y in f} c_h |e'_h - R_y e_h|^2 + l_h |e'_h - R_y tau_h|^2
///
/// Every style is a choice of c, l and tau and not a new solver.
#ifndef SphericalStyle_StyleEnergy_h
#define SphericalStyle_StyleEnergy_h

#include "CellCoefficients.h"
#include "EdgeWeights.h"
#include "HalfEdgeField.h"

namespace SphericalStyle
{
/// The two terms of the energy, length^2.
struct EnergyTerms
{
  double rigid = 0.0;
  double spherical = 0.0;
  double Total() const { return this->rigid + this->spherical; }
  EnergyTerms& operator+=(const EnergyTerms& other)
  {
    this->rigid += other.rigid;
    this->spherical += other.spherical;
    return *this;
  }
};

class StyleEnergy
{
public:
  StyleEnergy() = default;
  /// @param topology  kept by reference, must outlive this
  /// @param e  rest edges @param tau  their targets, length
  StyleEnergy(const MeshTopology& topology, EdgeWeights weights, HalfEdgeField e, HalfEdgeField tau,
    int threads);

  const EdgeWeights& GetWeights() const { return this->Weights; }
  const MeshTopology& GetTopology() const { return *this->Topology; }
  int GetThreads() const { return this->Threads; }

  /// E(Q, R). Summed from residuals, so that it keeps its digits near zero.
  EnergyTerms Evaluate(const Points& Q, const Matrices& R) const;
  /// The share of each cell (point) in E(Q, R), n values that sum to it.
  Eigen::VectorXd CellEnergies(const Points& Q, const Matrices& R) const;
  /// Makes the three steps below ready; to be called before any of them.
  /// @param pattern  that of the topology; kept by reference, must outlive this
  void PrepareSteps(const CellPattern& pattern);
  /// S_y = sum_{f at y} sum_{h in f} (c e + l tau) e'^T (Eq. 4.13) [local].
  void Covariances(const Points& Q, Matrices& S) const;
  /// R_y := the rotation closest to S_y, without storing S. @return the change of E, <= 0
  double FitRotations(const Points& Q, Matrices& R) const;
  /// Row u: sum over half-edges uv of (R_a + R_b + R_c)(c e + l tau) (Eq. 4.26) [global].
  void RightHandSide(const Matrices& R, Points& b) const;
  /// A scale to hold energies against: sum 3 (c |e|^2 + l |tau|^2), signs dropped.
  double GetScale() const { return this->Scale; }

private:
  const MeshTopology* Topology = nullptr;
  EdgeWeights Weights;
  HalfEdgeField Edges;           // e
  HalfEdgeField Targets;         // tau
  CellCoefficients Coefficients; // of g = c e + l tau
  double Scale = 0.0;
  int Threads = 1;
};
} // namespace SphericalStyle

#endif
