// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The method a second time, straight from the formulas: loops over triangles, half-edges and
/// corner cells, dense matrices, no shared code with the solver but its option names. Slow, for
/// about a hundred points.
#ifndef SphericalStyle_NaiveReference_h
#define SphericalStyle_NaiveReference_h

#include "StyleSolver.h"

#include <Eigen/LU>

class NaiveReference
{
public:
  using Points = SphericalStyle::Points;
  using Vector = Eigen::Vector3d;

  /// Works out weights, targets, matrix and the start. Of the options' loop nothing is read.
  NaiveReference(
    const SphericalStyle::TriangleMesh& mesh, const SphericalStyle::StyleOptions& options);

  /// One local and one global step.
  void Iterate();

  SphericalStyle::EnergyTerms Energy() const;
  /// Share of each cell in the energy.
  Eigen::VectorXd CellEnergies() const;
  const Points& GetPositions() const { return this->Q; }
  const Points& GetDirections() const { return this->T; }
  const SphericalStyle::Matrices& GetRotations() const { return this->R; }
  Vector GetCenter() const { return this->O; }
  double GetRadius() const { return this->Radius; }
  int GetFlipped() const { return this->Flipped; }
  /// Smallest s_2 + sign(det S) s_3 over |S|, over all cells and steps so far: how well the
  /// rotations were determined.
  double GetConditioning() const { return this->Conditioning; }

private:
  // One half-edge of a triangle with all that the energy says about it.
  struct HalfEdge
  {
    int u;
    int v;
    int cells[3];
    double c;
    double l;
    Vector e;
    Vector tau;
  };

  void GlobalStep();
  void LocalStep();

  int N;
  Points P;
  Points Q;
  Points T;
  SphericalStyle::Matrices R;
  std::vector<HalfEdge> HalfEdges;
  Vector O;
  double Radius;
  int Flipped = 0;
  double Conditioning = 1.0;

  std::vector<double> PointArea; // of the rest shape
  std::vector<int> Component;
  std::vector<char> Pinned;   // per component: holds a point that the user fixed
  std::vector<int> LastPoint; // per component
  std::vector<int> Free;      // points that are unknowns
  std::vector<int> RowOf;     // of each point, -1 when it is none
  Points Held;                // positions of the others
  bool CentroidAnchor;
  Eigen::MatrixXd Full; // n x n
  Eigen::FullPivLU<Eigen::MatrixXd> Factor;
};

#endif
