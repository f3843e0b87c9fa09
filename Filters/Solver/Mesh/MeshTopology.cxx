// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshTopology.h"

#include "DisjointSets.h"

#include <numeric>
#include <string>

namespace SphericalStyle
{
HalfEdgeVectors HalfEdgeDifferences(const Points& x, const Triangles& F)
{
  HalfEdgeVectors d(F.rows(), 9);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      d.block<1, 3>(f, 3 * k) = x.row(F(f, HalfEdgeStart(k))) - x.row(F(f, HalfEdgeEnd(k)));
    }
  }
  return d;
}

namespace
{
void CheckTriangles(const Triangles& F, int n, RepeatedPoints repeated)
{
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const auto t = F.row(f);
    if (t.minCoeff() < 0 || t.maxCoeff() >= n)
    {
      throw std::invalid_argument(
        "triangle " + std::to_string(f) + " names a point outside the mesh");
    }
    if (repeated == RepeatedPoints::Refused && (t(0) == t(1) || t(1) == t(2) || t(2) == t(0)))
    {
      throw std::invalid_argument("triangle " + std::to_string(f) + " uses a point twice");
    }
  }
}
}

std::vector<int> FirstPointsOfComponents(const Triangles& F, int numberOfPoints)
{
  std::vector<int> first(numberOfPoints);
  std::iota(first.begin(), first.end(), 0);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    JoinSets(first, F(f, 0), F(f, 1));
    JoinSets(first, F(f, 0), F(f, 2));
  }
  for (int i = 0; i < numberOfPoints; ++i)
  {
    first[i] = RootOf(first, i);
  }
  return first;
}

MeshTopology::MeshTopology(const Triangles& F, int numberOfPoints, RepeatedPoints repeated)
  : F(F)
{
  const int n = numberOfPoints;
  CheckTriangles(this->F, n, repeated);

  this->CornerOffset.assign(n + 1, 0);
  const int corners = static_cast<int>(this->F.size());
  const int* corner = this->F.data(); // row-major: corner 3 f + k
  for (int c = 0; c < corners; ++c)
  {
    ++this->CornerOffset[corner[c] + 1];
  }
  for (int i = 0; i < n; ++i)
  {
    if (this->CornerOffset[i + 1] == 0)
    {
      throw std::invalid_argument("point " + std::to_string(i) + " belongs to no triangle");
    }
  }
  std::partial_sum(
    this->CornerOffset.begin(), this->CornerOffset.end(), this->CornerOffset.begin());
  this->Corners.resize(corners);
  std::vector<int> next(this->CornerOffset.begin(), this->CornerOffset.end() - 1);
  for (int c = 0; c < corners; ++c)
  {
    this->Corners[next[corner[c]]++] = c;
  }

  const std::vector<int> first = FirstPointsOfComponents(this->F, n);
  std::vector<int> number(n, -1);
  this->Components.resize(n);
  for (int i = 0; i < n; ++i)
  {
    int& id = number[first[i]];
    if (id < 0)
    {
      id = static_cast<int>(this->LastPoints.size());
      this->LastPoints.push_back(i);
    }
    this->Components[i] = id;
    this->LastPoints[id] = i;
  }
}

Points MeshTopology::ComponentMeans(const Points& x, const Eigen::VectorXd& weights) const
{
  Points mean = Points::Zero(this->GetNumberOfComponents(), 3);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(this->GetNumberOfComponents());
  for (int i = 0; i < this->GetNumberOfPoints(); ++i)
  {
    mean.row(this->Components[i]) += weights[i] * x.row(i);
    sum(this->Components[i]) += weights[i];
  }
  return mean.array().colwise() / sum.array();
}
} // namespace SphericalStyle
