// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgePart.h"

#include "SharedNumbers.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace SphericalStyle
{
EdgePart::EdgePart(const Triangles& F, const MeshEdges& edges, const SurfacePart& points)
  : Everybody(points.Apart())
{
  if (points.IsWhole())
  {
    return;
  }
  int n = F.size() > 0 ? F.maxCoeff() + 1 : 0;
  for (const int i : points.shared)
  {
    n = std::max(n, i + 1);
  }
  std::vector<int> numberOf(n, -1);
  for (std::size_t k = 0; k < points.shared.size(); ++k)
  {
    numberOf[points.shared[k]] = points.numbers[k];
  }
  std::vector<std::array<double, 2>> names;
  std::vector<int> named;
  std::vector<char> turned(edges.GetNumberOfEdges(), 0);
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int h = edges.GetHalfEdges()[edges.GetOffset()[e]];
    const auto ends = std::minmax({ StartPoint(F, h), EndPoint(F, h) });
    const int u = numberOf[ends.first];
    const int v = numberOf[ends.second];
    if (u >= 0 && v >= 0)
    {
      names.push_back({ static_cast<double>(std::min(u, v)), static_cast<double>(std::max(u, v)) });
      named.push_back(e);
      turned[e] = u > v ? 1 : 0;
    }
  }
  this->Edges =
    PartByNames(names, named, static_cast<std::size_t>(edges.GetNumberOfEdges()), points);
  const auto count = static_cast<int>(this->Edges.shared.size());
  this->Rows.assign(edges.GetNumberOfEdges(), -1);
  this->OfRows = points.Apart();
  this->OfRows.numbers = this->Edges.numbers;
  this->OfRows.numberOfShared = this->Edges.numberOfShared;
  this->OfRows.shared.resize(count);
  std::iota(this->OfRows.shared.begin(), this->OfRows.shared.end(), 0);
  for (int row = 0; row < count; ++row)
  {
    this->Rows[this->Edges.shared[row]] = row;
    this->Turned.push_back(turned[this->Edges.shared[row]]);
  }
}

namespace
{
/// Sets that are joined two by two (union-find with path halving).
class JoinedSets
{
public:
  explicit JoinedSets(std::size_t size)
    : Parent(size)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), std::size_t(0));
  }
  std::size_t GetRoot(std::size_t i)
  {
    while (this->Parent[i] != i)
    {
      this->Parent[i] = this->Parent[this->Parent[i]];
      i = this->Parent[i];
    }
    return i;
  }
  void Join(std::size_t a, std::size_t b) { this->Parent[this->GetRoot(b)] = this->GetRoot(a); }

private:
  std::vector<std::size_t> Parent;
};
}

int CountComponents(const Triangles& F, Eigen::Index n, const SurfacePart& part)
{
  JoinedSets own(static_cast<std::size_t>(n));
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    own.Join(F(f, 0), F(f, 1));
    own.Join(F(f, 0), F(f, 2));
  }
  std::vector<int> number(n, -1);
  int count = 0;
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const std::size_t root = own.GetRoot(static_cast<std::size_t>(i));
    number[root] = number[root] < 0 ? count++ : number[root];
  }
  if (part.IsWhole())
  {
    return count;
  }
  const double before = CountBefore(part, count);
  const auto all = static_cast<std::size_t>(part.Sum(static_cast<double>(count)));
  std::vector<double> rows; // a place and a component of a process
  for (std::size_t k = 0; k < part.shared.size(); ++k)
  {
    const auto root = own.GetRoot(static_cast<std::size_t>(part.shared[k]));
    rows.insert(rows.end(), { static_cast<double>(part.numbers[k]), before + number[root] });
  }
  rows = part.Concatenate(rows);
  JoinedSets joined(all);
  std::vector<double> first(part.numberOfShared, -1.0);
  for (std::size_t k = 0; k < rows.size(); k += 2)
  {
    double& component = first[static_cast<std::size_t>(rows[k])];
    component = component < 0.0 ? rows[k + 1] : component;
    joined.Join(static_cast<std::size_t>(component), static_cast<std::size_t>(rows[k + 1]));
  }
  int components = 0;
  for (std::size_t i = 0; i < all; ++i)
  {
    components += joined.GetRoot(i) == i ? 1 : 0;
  }
  return components;
}
} // namespace SphericalStyle
