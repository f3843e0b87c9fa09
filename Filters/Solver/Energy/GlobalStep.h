// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The global step [global] (Eq. 4.22 - 4.38): factor once, solve often.
#ifndef SphericalStyle_GlobalStep_h
#define SphericalStyle_GlobalStep_h

#include "EdgeMatrix.h"
#include "LinearSystem.h"

namespace SphericalStyle
{
/// Solves L Q = b, L = sum_h 3 s k_h (x_u - x_v)^2. The null space of L is one constant vector per
/// component, so one point of each is fixed: those the caller names, and the last point of every
/// component that has none.
class GlobalStep
{
public:
  GlobalStep() = default;
  /// @param topology  kept by reference, must outlive this @param pinned  points the user fixes
  GlobalStep(const MeshTopology& topology, const std::vector<int>& pinned,
    LinearMethod method = LinearMethod::Automatic);

  /// Sets L; to be called before Solve. Factors only if k differs from the weights factored last; a
  /// new scale costs nothing, and new k keep ordering and symbolic factor. @throw SolverError
  /// @return whether it factored
  bool SetWeights(const HalfEdgeScalars& k, double scale, int threads = 1);

  /// @param b  n x 3 @param Q  n x 3: fixed rows hold their positions; the others are replaced,
  /// from where they are by methods that go on from a guess
  void Solve(const Points& b, Points& Q, int threads = 1);

  /// n flags: points that Solve does not move.
  const std::vector<char>& GetFixed() const { return this->Fixed; }
  /// Flags per component: whether the caller fixed a point of it.
  const std::vector<char>& GetComponentIsPinned() const { return this->ComponentIsPinned; }

  double GetAnalyzeSeconds() const { return this->AnalyzeSeconds; }
  double GetFactorSeconds() const { return this->FactorSeconds; }
  /// Whether L is positive definite: or else the energy has no minimum.
  bool IsDefinite() const { return this->System.IsDefinite(); }
  std::string GetSolverName() const { return this->System.GetName(); }
  int GetNumberOfLinearSteps() const { return this->System.GetNumberOfSteps(); }
  int GetNumberOfUnfinishedSolves() const { return this->System.GetNumberOfUnfinishedSolves(); }

private:
  void BuildMatrix();

  const MeshTopology* Topology = nullptr;
  std::vector<char> Fixed;
  std::vector<char> ComponentIsPinned;
  EdgeMatrix Matrix;
  LinearSystem System;
  HalfEdgeScalars Factored; // the k of the factor
  double Scale = 1.0;
  bool Analyzed = false;
  struct Border // a half-edge between a free row and a fixed point
  {
    int row;
    int fixedPoint;
    int halfEdge;
  };
  std::vector<Border> Borders;
  LinearSystem::RightHandSides Right;
  LinearSystem::RightHandSides Solution;
  double AnalyzeSeconds = 0.0;
  double FactorSeconds = 0.0;
};
} // namespace SphericalStyle

#endif
