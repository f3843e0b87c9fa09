// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleTree.h"

#include <algorithm>
#include <cstdint>

namespace SphericalStyle
{
namespace
{
constexpr double Cells = 1024.0; // along each axis

/// Ten bits, two zeros after each.
std::uint32_t Spread(std::uint32_t x)
{
  x = (x | x << 16) & 0x030000ffU;
  x = (x | x << 8) & 0x0300f00fU;
  x = (x | x << 4) & 0x030c30c3U;
  return (x | x << 2) & 0x09249249U;
}

/// Where triangles are on the curve, ascending: the cell, and below it the triangle.
std::vector<std::uint64_t> AlongMortonCurve(const Points& P, const Triangles& F)
{
  const Eigen::Array3d low = P.colwise().minCoeff();
  const double size = (P.colwise().maxCoeff().transpose().array() - low).maxCoeff();
  const double scale = size > 0.0 ? Cells / size : 0.0;
  std::vector<std::uint64_t> keys(F.rows());
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Eigen::Array3d center =
      (P.row(F(f, 0)) + P.row(F(f, 1)) + P.row(F(f, 2))).transpose().array() / 3.0;
    const Eigen::Array3d cell = ((center - low) * scale).max(0.0).min(Cells - 1.0);
    const std::uint64_t code = Spread(static_cast<std::uint32_t>(cell[0])) |
      Spread(static_cast<std::uint32_t>(cell[1])) << 1 |
      Spread(static_cast<std::uint32_t>(cell[2])) << 2;
    keys[f] = code << 32 | static_cast<std::uint32_t>(f);
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}
}

class TriangleTree::Builder
{
public:
  Builder(TriangleTree& tree, const Points& P, const Triangles& F)
    : Tree(tree)
    , P(P)
    , F(F)
    , Keys(AlongMortonCurve(P, F))
  {
    tree.Order.resize(this->Keys.size());
    std::transform(this->Keys.begin(), this->Keys.end(), tree.Order.begin(),
      [](std::uint64_t key) { return static_cast<int>(key & 0xffffffffU); });
    const std::size_t nodes = 2 * static_cast<std::size_t>(tree.CountGroups()) - 1;
    tree.Boxes.resize(nodes);
    tree.Middles.resize(nodes);
  }

  void Build(const Node& node)
  {
    Eigen::AlignedBox3d box;
    if (IsLeaf(node))
    {
      for (const int* f = this->Tree.Begin(node); f != this->Tree.End(node); ++f)
      {
        for (int k = 0; k < 3; ++k)
        {
          box.extend(this->P.row(this->F(*f, k)).transpose());
        }
      }
    }
    else
    {
      this->Tree.Middles[node.index] = this->Split(node.first, node.last);
      for (const Node& part : { this->Tree.GetLeft(node), this->Tree.GetRight(node) })
      {
        this->Build(part);
        box.extend(this->Tree.GetBox(part));
      }
    }
    this->Tree.Boxes[node.index] = box;
  }

private:
  std::uint64_t KeyOf(int group) const
  {
    return this->Keys[static_cast<std::size_t>(GroupSize) * group];
  }

  /// The first group that lies in the other half of the smallest cell that holds all of them.
  int Split(int first, int last) const
  {
    std::uint64_t bit = this->KeyOf(first) ^ this->KeyOf(last - 1); // not 0: keys differ
    while ((bit & (bit - 1)) != 0)
    {
      bit &= bit - 1;
    }
    int low = first;     // is not in the other half
    int high = last - 1; // is
    while (high - low > 1)
    {
      const int middle = low + (high - low) / 2;
      ((this->KeyOf(middle) & bit) == 0 ? low : high) = middle;
    }
    return high;
  }

  TriangleTree& Tree;
  const Points& P;
  const Triangles& F;
  std::vector<std::uint64_t> Keys;
};

TriangleTree::TriangleTree(const Points& P, const Triangles& F)
{
  Builder(*this, P, F).Build(this->GetRoot());
}
} // namespace SphericalStyle
