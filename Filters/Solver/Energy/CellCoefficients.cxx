// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "CellCoefficients.h"

#include "Parallel.h"
#include "Vector4.h"

#include <algorithm>

namespace SphericalStyle
{
CellPattern::CellPattern(const MeshTopology& topology)
{
  const Triangles& F = topology.GetTriangles();
  const std::vector<int>& cornerOffset = topology.GetCornerOffset();
  const std::vector<int>& corners = topology.GetCorners();
  const int n = topology.GetNumberOfPoints();
  this->Offset.reserve(n + 1);
  this->Neighbors.reserve(corners.size() + n);
  std::vector<int> last(n, -1); // the point that found this one last
  for (int i = 0; i < n; ++i)
  {
    last[i] = i;
    for (int at = cornerOffset[i]; at < cornerOffset[i + 1]; ++at)
    {
      for (const int j : F.row(corners[at] / 3))
      {
        if (last[j] != i)
        {
          last[j] = i;
          this->Neighbors.push_back(j);
        }
      }
    }
    std::sort(this->Neighbors.begin() + this->Offset.back(), this->Neighbors.end());
    this->Offset.push_back(static_cast<int>(this->Neighbors.size()));
  }
}

CellCoefficients::CellCoefficients(const CellPattern& pattern, const MeshTopology& topology,
  const std::function<Eigen::Matrix3d(int)>& weightedEdges, int threads)
  : Pattern(&pattern)
  , OfCell(3 * pattern.GetNeighbors().size() + 1, 0.0)
  , OfPoint(3 * pattern.GetNeighbors().size() + 1, 0.0)
  , Own(Points::Zero(pattern.GetNumberOfPoints(), 3))
{
  const Triangles& F = topology.GetTriangles();
  const std::vector<int>& corners = topology.GetCorners();
  const auto row = [](std::vector<double>& values, std::ptrdiff_t at)
  { return Eigen::Map<Eigen::RowVector3d>(values.data() + 3 * at); };
  ParallelFor(pattern.GetNumberOfPoints(), threads,
    [&](int begin, int end)
    {
      for (int y = begin; y < end; ++y)
      {
        for (int at = topology.GetCornerOffset()[y]; at < topology.GetCornerOffset()[y + 1]; ++at)
        {
          const int f = corners[at] / 3;
          const Eigen::Matrix3d g = weightedEdges(f);
          // Corner k starts half-edge k + 2 and ends half-edge k + 1.
          const auto difference = [&g](int k) -> Eigen::RowVector3d
          { return g.col((k + 2) % 3) - g.col((k + 1) % 3); };
          const Eigen::RowVector3d own = difference(corners[at] % 3);
          for (int k = 0; k < 3; ++k)
          {
            const int j = F(f, k);
            if (j == y) // also the second corner of a triangle that uses a point twice
            {
              this->Own.row(y) += difference(k);
              continue;
            }
            const std::ptrdiff_t entry = pattern.Find(y, j);
            row(this->OfCell, entry) += difference(k);
            row(this->OfPoint, entry) += own;
          }
        }
      }
    });
}

namespace
{
SPHERICALSTYLE_PER_INSTRUCTION_SET
void SumCovariances(const double* w, const int* offset, const int* neighbors, const double* Q,
  int begin, int end, double* S)
{
  for (int y = begin; y < end; ++y, S += 9)
  {
    const double* q = Q + 3 * static_cast<std::ptrdiff_t>(y);
    Vector4 x = {};
    Vector4 y4 = {};
    Vector4 z = {};
    for (int at = offset[y]; at < offset[y + 1]; ++at)
    {
      const double* p = Q + 3 * static_cast<std::ptrdiff_t>(neighbors[at]);
      const Vector4 w4 = Load4(w + 3 * static_cast<std::ptrdiff_t>(at));
      x += w4 * (p[0] - q[0]);
      y4 += w4 * (p[1] - q[1]);
      z += w4 * (p[2] - q[2]);
    }
    Store4(S, x); // each column covers the number too many of the one before
    Store4(S + 3, y4);
    Store4(S + 6, z);
  }
}

SPHERICALSTYLE_PER_INSTRUCTION_SET
void SumNeighbors(const double* w, const double* own, const int* offset, const int* neighbors,
  const double* R, int begin, int end, double* b)
{
  for (int j = begin; j < end; ++j)
  {
    const auto row = 3 * static_cast<std::ptrdiff_t>(j);
    Vector4 sum = LoadColumns(R + 3 * row) * (own + row);
    for (int at = offset[j]; at < offset[j + 1]; ++at)
    {
      sum += LoadColumns(R + 9 * static_cast<std::ptrdiff_t>(neighbors[at])) *
        (w + 3 * static_cast<std::ptrdiff_t>(at));
    }
    for (int k = 0; k < 3; ++k)
    {
      b[row + k] = sum[k];
    }
  }
}
}

void CellCoefficients::Covariances(const Points& Q, int begin, int end, double* S) const
{
  SumCovariances(this->OfCell.data(), this->Pattern->GetOffset().data(),
    this->Pattern->GetNeighbors().data(), Q.data(), begin, end, S);
}

void CellCoefficients::RightHandSide(const Matrices& R, Points& b, int threads) const
{
  b.resize(this->Own.rows(), 3);
  ParallelFor(static_cast<int>(b.rows()), threads,
    [&](int begin, int end)
    {
      SumNeighbors(this->OfPoint.data(), this->Own.data(), this->Pattern->GetOffset().data(),
        this->Pattern->GetNeighbors().data(), R.data()->data(), begin, end, b.data());
    });
}
} // namespace SphericalStyle
