// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeMatrix.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace SphericalStyle
{
namespace
{
/// A half-edge that adds below the diagonal.
struct Entry
{
  int row;
  int halfEdge;
};

/// Entries column by column, rows ascending: those of column c at [offset[c], offset[c + 1]).
/// Where both ends are one point there is none.
std::vector<Entry> SortEntries(
  const Triangles& F, const std::vector<int>& rows, std::vector<int>& offset)
{
  const int halfEdges = static_cast<int>(F.size());
  const auto ends = [&](int h) {
    return std::minmax({ rows[StartPoint(F, h)], rows[EndPoint(F, h)] });
  };
  const auto below = [&](int h) { return ends(h).first >= 0 && ends(h).first != ends(h).second; };
  for (int h = 0; h < halfEdges; ++h)
  {
    if (below(h))
    {
      ++offset[ends(h).first + 1];
    }
  }
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  std::vector<Entry> entries(offset.back());
  std::vector<int> next(offset.begin(), offset.end() - 1);
  for (int h = 0; h < halfEdges; ++h)
  {
    if (below(h))
    {
      entries[next[ends(h).first]++] = { ends(h).second, h };
    }
  }
  for (std::size_t c = 0; c + 1 < offset.size(); ++c)
  {
    std::sort(entries.begin() + offset[c], entries.begin() + offset[c + 1],
      [](const Entry& a, const Entry& b)
      { return std::make_pair(a.row, a.halfEdge) < std::make_pair(b.row, b.halfEdge); });
  }
  return entries;
}
}

EdgeMatrix::EdgeMatrix(const MeshTopology& topology, const std::vector<char>& fixed)
{
  this->NumberRows(fixed);
  this->BuildPattern(topology.GetTriangles());
}

void EdgeMatrix::NumberRows(const std::vector<char>& fixed)
{
  int rows = 0;
  this->Rows.assign(fixed.size(), -1);
  for (std::size_t i = 0; i < fixed.size(); ++i)
  {
    this->Rows[i] = fixed[i] ? -1 : rows++;
  }
  this->DiagonalSlots.resize(rows);
}

void EdgeMatrix::BuildPattern(const Triangles& F)
{
  const int rows = this->GetNumberOfRows();
  std::vector<int> offset(rows + 1, 0);
  const std::vector<Entry> entries = SortEntries(F, this->Rows, offset);

  this->HalfEdgeSlots.assign(F.size(), { -1, -1, -1 });
  std::vector<int> outer(rows + 1, 0);
  std::vector<int> inner;
  inner.reserve(entries.size() / 2 + rows);
  for (int c = 0; c < rows; ++c)
  {
    this->DiagonalSlots[c] = static_cast<int>(inner.size());
    inner.push_back(c);
    for (int at = offset[c]; at < offset[c + 1]; ++at)
    {
      if (entries[at].row != inner.back())
      {
        inner.push_back(entries[at].row);
      }
      this->HalfEdgeSlots[entries[at].halfEdge].below = static_cast<int>(inner.size()) - 1;
    }
    outer[c + 1] = static_cast<int>(inner.size());
  }
  for (std::size_t h = 0; h < this->HalfEdgeSlots.size(); ++h)
  {
    const auto f = static_cast<Eigen::Index>(h / 3);
    const int k = static_cast<int>(h % 3);
    if (F(f, HalfEdgeStart(k)) == F(f, HalfEdgeEnd(k)))
    {
      continue;
    }
    const int start = this->Rows[F(f, HalfEdgeStart(k))];
    const int end = this->Rows[F(f, HalfEdgeEnd(k))];
    this->HalfEdgeSlots[h].start = start < 0 ? -1 : this->DiagonalSlots[start];
    this->HalfEdgeSlots[h].end = end < 0 ? -1 : this->DiagonalSlots[end];
  }
  this->A.resize(rows, rows);
  this->A.resizeNonZeros(static_cast<Eigen::Index>(inner.size()));
  std::copy(outer.begin(), outer.end(), this->A.outerIndexPtr());
  std::copy(inner.begin(), inner.end(), this->A.innerIndexPtr());
}

const SparseCholesky::Matrix& EdgeMatrix::Assemble(
  const HalfEdgeScalars& k, const Eigen::VectorXd& d)
{
  double* value = this->A.valuePtr();
  std::fill(value, value + this->A.nonZeros(), 0.0);
  for (std::size_t i = 0; d.size() > 0 && i < this->Rows.size(); ++i)
  {
    if (this->Rows[i] >= 0)
    {
      value[this->DiagonalSlots[this->Rows[i]]] = d(static_cast<Eigen::Index>(i));
    }
  }
  for (std::size_t h = 0; h < this->HalfEdgeSlots.size(); ++h)
  {
    const Slots& slots = this->HalfEdgeSlots[h];
    const double weight = k.data()[h];
    if (slots.start >= 0)
    {
      value[slots.start] += weight;
    }
    if (slots.end >= 0)
    {
      value[slots.end] += weight;
    }
    if (slots.below >= 0)
    {
      value[slots.below] -= weight;
    }
  }
  return this->A;
}
} // namespace SphericalStyle
