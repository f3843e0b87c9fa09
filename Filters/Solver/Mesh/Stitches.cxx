// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Stitches.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace SphericalStyle
{
namespace
{
constexpr double LongStitch = 10.0; // extents of the smaller part
constexpr double LeastStitchWeight = 1e-6;

/// Points joined so far, as numbers of groups.
class Groups
{
public:
  explicit Groups(const std::vector<int>& parts)
    : Parts(parts)
    , Parent(1 + *std::max_element(parts.begin(), parts.end()))
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
    this->Count = static_cast<int>(this->Parent.size());
  }

  int GetCount() const { return this->Count; }

  bool Join(int a, int b)
  {
    a = this->Root(a);
    b = this->Root(b);
    this->Parent[std::max(a, b)] = std::min(a, b);
    this->Count -= a != b;
    return a != b;
  }

  std::vector<int> OfPoints()
  {
    std::vector<int> groups(this->Parts.size());
    std::transform(this->Parts.begin(), this->Parts.end(), groups.begin(),
      [this](int part) { return this->Root(part); });
    return groups;
  }

private:
  int Root(int i)
  {
    while (this->Parent[i] != i)
    {
      i = this->Parent[i] = this->Parent[this->Parent[i]];
    }
    return i;
  }

  const std::vector<int>& Parts;
  std::vector<int> Parent;
  int Count;
};

/// From a point to the nearest one of another group.
struct Link
{
  int from;
  int to;
  double length;
};

/// Nearest points of other groups. A node of the tree knows the group of all its points, if they
/// are of one, so that a search does not look through its own group.
class OtherGroups
{
public:
  explicit OtherGroups(const Points& P)
    : P(P)
  {
    std::vector<int> points(P.rows());
    std::iota(points.begin(), points.end(), 0);
    std::vector<Tree::Volume> boxes;
    boxes.reserve(points.size());
    for (const int i : points)
    {
      boxes.emplace_back(Eigen::Vector3d(P.row(i)));
    }
    this->Hierarchy.init(points.begin(), points.end(), boxes.begin(), boxes.end());
  }

  void SetGroups(const std::vector<int>& groups)
  {
    this->Group = groups;
    this->NodeGroup.clear();
    for (int node = 0; node <= this->Hierarchy.getRootIndex(); ++node) // children before parents
    {
      const Children children(this->Hierarchy, node);
      std::vector<int> found;
      for (const auto* child = children.boxes; child != children.boxesEnd; ++child)
      {
        found.push_back(this->NodeGroup[*child]);
      }
      for (const auto* point = children.points; point != children.pointsEnd; ++point)
      {
        found.push_back(groups[*point]);
      }
      const bool one = std::equal(found.begin() + 1, found.end(), found.begin());
      this->NodeGroup.push_back(one ? found.front() : Several);
    }
  }

  Link Nearest(int point) const
  {
    Link best = { point, -1, std::numeric_limits<double>::infinity() };
    this->Search(this->Hierarchy.getRootIndex(), best);
    best.length = std::sqrt(best.length);
    return best;
  }

private:
  using Tree = Eigen::KdBVH<double, 3, int>;
  static constexpr int Several = -1;

  struct Children
  {
    Children(const Tree& tree, int node)
    {
      tree.getChildren(node, this->boxes, this->boxesEnd, this->points, this->pointsEnd);
    }
    Tree::VolumeIterator boxes = nullptr;
    Tree::VolumeIterator boxesEnd = nullptr;
    Tree::ObjectIterator points = nullptr;
    Tree::ObjectIterator pointsEnd = nullptr;
  };

  // best.length is squared here. Of points equally near the first counts.
  void Search(int node, Link& best) const
  {
    const Children children(this->Hierarchy, node);
    const Eigen::Vector3d p = this->P.row(best.from);
    for (const auto* point = children.points; point != children.pointsEnd; ++point)
    {
      const double length = (this->P.row(*point).transpose() - p).squaredNorm();
      if (this->Group[*point] != this->Group[best.from] &&
        std::make_pair(length, *point) < std::make_pair(best.length, best.to))
      {
        best.to = *point;
        best.length = length;
      }
    }
    std::pair<double, int> nodes[2];
    int count = 0;
    for (const auto* child = children.boxes; child != children.boxesEnd; ++child)
    {
      if (this->NodeGroup[*child] != this->Group[best.from])
      {
        nodes[count++] = { this->Hierarchy.getVolume(*child).squaredExteriorDistance(p), *child };
      }
    }
    if (count == 2 && nodes[1] < nodes[0])
    {
      std::swap(nodes[0], nodes[1]);
    }
    for (int i = 0; i < count; ++i)
    {
      if (nodes[i].first <= best.length)
      {
        this->Search(nodes[i].second, best);
      }
    }
  }

  const Points& P;
  Tree Hierarchy;
  std::vector<int> Group;
  std::vector<int> NodeGroup;
};

/// Mean length of the edges at each point.
Eigen::VectorXd EdgeLengths(const Points& P, const Triangles& F)
{
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(P.rows());
  Eigen::VectorXd count = Eigen::VectorXd::Zero(P.rows());
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = F(f, HalfEdgeStart(k));
      const int v = F(f, HalfEdgeEnd(k));
      const double length = (P.row(u) - P.row(v)).norm();
      sum(u) += length;
      sum(v) += length;
      count(u) += 1.0;
      count(v) += 1.0;
    }
  }
  return sum.array() / count.array();
}

/// Three of some links: the first, the one farthest from it, and the one farthest from the line
/// through both (by their middles), with its distance from that line.
struct Tripod
{
  Link feet[3];
  double height = 0.0;

  template <typename Iterator>
  Tripod(const Points& P, Iterator begin, Iterator end)
  {
    const auto middle = [&P](const Link& link) -> Eigen::Vector3d
    { return 0.5 * (P.row(link.from) + P.row(link.to)); };
    std::fill_n(this->feet, 3, *begin);
    const Eigen::Vector3d first = middle(*begin);
    double length = 0.0;
    for (Iterator link = begin; link != end; ++link)
    {
      const double distance = (middle(*link) - first).norm();
      if (distance > length)
      {
        length = distance;
        this->feet[1] = *link;
      }
    }
    const Eigen::Vector3d line = (middle(this->feet[1]) - first).stableNormalized();
    for (Iterator link = begin; link != end; ++link)
    {
      const double distance = line.cross(middle(*link) - first).norm();
      if (distance > this->height)
      {
        this->height = distance;
        this->feet[2] = *link;
      }
    }
  }
};

class Stitcher
{
public:
  Stitcher(const Points& P, const Triangles& F, const std::vector<int>& components)
    : P(P)
    , Lengths(EdgeLengths(P, F))
    , Parts(components)
    , Others(P)
  {
  }

  std::vector<Stitch> Run()
  {
    while (this->Parts.GetCount() > 1)
    {
      this->JoinNearest();
    }
    const auto ends = [](const Stitch& s) { return std::make_pair(s.u, s.v); };
    std::sort(this->Stitches.begin(), this->Stitches.end(),
      [&](const Stitch& a, const Stitch& b)
      { return std::make_pair(ends(a), -a.weight) < std::make_pair(ends(b), -b.weight); });
    this->Stitches.erase(std::unique(this->Stitches.begin(), this->Stitches.end(),
                           [&](const Stitch& a, const Stitch& b) { return ends(a) == ends(b); }),
      this->Stitches.end());
    return this->Stitches;
  }

private:
  using Iterator = std::vector<Link>::const_iterator;

  /// A link's pair of groups, to sort by.
  std::pair<int, int> Pair(const Link& link) const
  {
    return std::minmax({ this->Group[link.from], this->Group[link.to] });
  }

  double EdgeLength(const Link& link) const
  {
    return std::min(this->Lengths(link.from), this->Lengths(link.to));
  }

  /// One round: every group is joined to the one nearest to it at least.
  void JoinNearest()
  {
    this->Group = this->Parts.OfPoints();
    this->Others.SetGroups(this->Group);
    this->FindExtents();
    std::vector<Link> links;
    links.reserve(this->P.rows());
    for (int i = 0; i < this->P.rows(); ++i)
    {
      links.push_back(this->Others.Nearest(i));
    }
    this->FindGaps(links);
    std::vector<Link> kept;
    std::copy_if(links.begin(), links.end(), std::back_inserter(kept),
      [this](const Link& link)
      { return link.length <= 1.5 * this->LargerGap(link) + this->EdgeLength(link); });
    this->KeepClosest(kept);
    for (const Link& link : kept)
    {
      this->Add(link);
    }
    this->JoinGroups(std::move(links), std::move(kept));
  }

  void FindGaps(const std::vector<Link>& links)
  {
    this->Gap.assign(this->P.rows(), std::numeric_limits<double>::infinity());
    for (const Link& link : links)
    {
      double& gap = this->Gap[this->Group[link.from]];
      gap = std::min(gap, link.length);
    }
  }

  void FindExtents()
  {
    std::vector<Eigen::AlignedBox3d> boxes(this->P.rows()); // of each group
    for (Eigen::Index i = 0; i < this->P.rows(); ++i)
    {
      boxes[this->Group[i]].extend(this->P.row(i).transpose());
    }
    this->Extent.resize(boxes.size());
    std::transform(boxes.begin(), boxes.end(), this->Extent.begin(),
      [](const auto& box) { return box.isEmpty() ? 0.0 : box.diagonal().stableNorm(); });
  }

  double LargerGap(const Link& link) const
  {
    return std::max(this->Gap[this->Group[link.from]], this->Gap[this->Group[link.to]]);
  }

  /// Of the links from one group to one point only the shortest.
  void KeepClosest(std::vector<Link>& links) const
  {
    const auto target = [this](const Link& l) { return std::make_pair(l.to, this->Group[l.from]); };
    std::sort(links.begin(), links.end(),
      [&](const Link& a, const Link& b)
      {
        return std::make_tuple(target(a), a.length, a.from) <
          std::make_tuple(target(b), b.length, b.from);
      });
    links.erase(std::unique(links.begin(), links.end(),
                  [&](const Link& a, const Link& b) { return target(a) == target(b); }),
      links.end());
  }

  /// Joins every group to the one nearest to it, nearest first, and braces what this brings
  /// together.
  void JoinGroups(std::vector<Link> all, std::vector<Link> kept)
  {
    const auto byPair = [this](const Link& a, const Link& b)
    {
      return std::make_tuple(this->Pair(a), a.length, a.from) <
        std::make_tuple(this->Pair(b), b.length, b.from);
    };
    const auto byPairOnly = [this](const Link& a, const Link& b)
    { return this->Pair(a) < this->Pair(b); };
    std::sort(all.begin(), all.end(), byPair);
    std::sort(kept.begin(), kept.end(), byPair);
    std::vector<std::pair<Iterator, Iterator>> joints; // kept links of one pair of groups
    for (auto at = kept.cbegin(); at != kept.end(); at = joints.back().second)
    {
      joints.emplace_back(at, std::upper_bound(at, kept.cend(), *at, byPairOnly));
    }
    std::sort(joints.begin(), joints.end(),
      [](const auto& a, const auto& b) {
        return std::make_tuple(a.first->length, a.first) <
          std::make_tuple(b.first->length, b.first);
      });
    for (const auto& [begin, end] : joints)
    {
      if (begin->length <= this->LargerGap(*begin) &&
        this->Parts.Join(this->Group[begin->from], this->Group[begin->to]))
      {
        const auto candidates = std::equal_range(all.cbegin(), all.cend(), *begin, byPairOnly);
        this->Brace(begin, end, candidates.first, candidates.second);
      }
    }
  }

  /// @param begin  kept links between two groups @param all  all links between them, shortest first
  void Brace(Iterator begin, Iterator end, Iterator all, Iterator allEnd)
  {
    const double needed = 0.25 * this->EdgeLength(*begin);
    if (Tripod(this->P, begin, end).height >= needed)
    {
      return;
    }
    double reach = 1.5 * begin->length + this->EdgeLength(*begin);
    for (;;)
    {
      reach *= 2.0;
      const auto within = std::upper_bound(
        all, allEnd, reach, [](double value, const Link& link) { return value < link.length; });
      const Tripod tripod(this->P, all, within);
      if (tripod.height >= needed || within == allEnd)
      {
        std::for_each(tripod.feet, tripod.feet + 3, [this](const Link& foot) { this->Add(foot); });
        return;
      }
    }
  }

  void Add(const Link& link)
  {
    const double smaller =
      std::min(this->Extent[this->Group[link.from]], this->Extent[this->Group[link.to]]);
    const double ratio = LongStitch * smaller / link.length; // infinite or NaN where they touch
    const double weight = ratio < 1.0 ? std::max(LeastStitchWeight, ratio * ratio) : 1.0;
    this->Stitches.push_back(
      { std::min(link.from, link.to), std::max(link.from, link.to), weight });
  }

  const Points& P;
  Eigen::VectorXd Lengths;
  Groups Parts;
  OtherGroups Others;
  std::vector<int> Group;     // of each point
  std::vector<double> Gap;    // of each group
  std::vector<double> Extent; // of each group
  std::vector<Stitch> Stitches;
};
}

std::vector<Stitch> FindStitches(
  const Points& P, const Triangles& F, const std::vector<int>& components)
{
  return Stitcher(P, F, components).Run();
}
} // namespace SphericalStyle
