// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeMatrix.h"

#include <algorithm>
#include <utility>

namespace SphericalStyle
{
EdgeMatrix::EdgeMatrix(const MeshTopology& topology, const std::vector<char>& fixed)
{
  const int n = topology.GetNumberOfPoints();
  this->Rows.assign(n, -1);
  int rows = 0;
  for (int i = 0; i < n; ++i)
  {
    if (!fixed[i])
    {
      this->Rows[i] = rows++;
    }
  }

  // Entries below the diagonal, column by column.
  const Triangles& F = topology.GetTriangles();
  struct Entry
  {
    int row;
    int halfEdge;
  };
  std::vector<int> count(rows + 1, 0);
  const auto ends = [&](int h)
  {
    const int f = h / 3;
    const int k = h % 3;
    return std::minmax({ this->Rows[F(f, HalfEdgeStart(k))], this->Rows[F(f, HalfEdgeEnd(k))] });
  };
  const int halfEdges = static_cast<int>(F.size());
  for (int h = 0; h < halfEdges; ++h)
  {
    if (ends(h).first >= 0)
    {
      ++count[ends(h).first + 1];
    }
  }
  for (int c = 0; c < rows; ++c)
  {
    count[c + 1] += count[c];
  }
  std::vector<Entry> entries(count[rows]);
  std::vector<int> next(count.begin(), count.end() - 1);
  for (int h = 0; h < halfEdges; ++h)
  {
    if (ends(h).first >= 0)
    {
      entries[next[ends(h).first]++] = { ends(h).second, h };
    }
  }

  this->HalfEdgeSlots.assign(halfEdges, { -1, -1, -1 });
  this->DiagonalSlots.resize(rows);
  std::vector<int> outer(rows + 1, 0);
  std::vector<int> inner;
  inner.reserve(entries.size() / 2 + rows);
  for (int c = 0; c < rows; ++c)
  {
    this->DiagonalSlots[c] = static_cast<int>(inner.size());
    inner.push_back(c);
    const auto first = entries.begin() + count[c];
    const auto last = entries.begin() + count[c + 1];
    std::sort(first, last,
      [](const Entry& a, const Entry& b)
      { return std::make_pair(a.row, a.halfEdge) < std::make_pair(b.row, b.halfEdge); });
    for (auto entry = first; entry != last; ++entry)
    {
      if (entry == first || entry->row != (entry - 1)->row)
      {
        inner.push_back(entry->row);
      }
      this->HalfEdgeSlots[entry->halfEdge].below = static_cast<int>(inner.size()) - 1;
    }
    outer[c + 1] = static_cast<int>(inner.size());
  }
  for (int h = 0; h < halfEdges; ++h)
  {
    const int start = this->Rows[F(h / 3, HalfEdgeStart(h % 3))];
    const int end = this->Rows[F(h / 3, HalfEdgeEnd(h % 3))];
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
