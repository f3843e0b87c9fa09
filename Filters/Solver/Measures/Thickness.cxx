// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Thickness.h"

#include "FirstHit.h"
#include "Frame.h"
#include "Parallel.h"
#include "SharedNumbers.h"
#include "SurfaceMeasures.h"
#include "TriangleTree.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <utility>

namespace SphericalStyle
{
ThicknessProbes PlaceThicknessProbes(
  const TriangleMesh& rest, const std::vector<int>& points, int threads, double reach)
{
  ThicknessProbes probes;
  if (rest.F.rows() == 0 || points.empty())
  {
    return probes;
  }
  const Points P = FrameOf(rest.P).Into(rest.P);
  const double inward = EnclosedVolume(P, rest.F) < 0.0 ? 1.0 : -1.0;
  const Points normals = PointNormals(P, rest.F);
  const TriangleTree tree(P, rest.F);

  const int n = static_cast<int>(points.size());
  std::vector<int> triangles(n, -1);
  Points barycentric(n, 3);
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const Eigen::Vector3d normal = normals.row(points[i]);
        FirstHit hit(P, rest.F, P.row(points[i]), inward * normal, reach);
        hit.SkipPoint(points[i]);
        if (normal.norm() > 0.5)
        {
          hit.Search(tree);
        }
        if (hit.GetTriangle() >= 0)
        {
          triangles[i] = hit.GetTriangle();
          barycentric.row(i) = hit.GetPlace();
        }
      }
    });
  for (int i = 0; i < n; ++i)
  {
    if (triangles[i] >= 0)
    {
      barycentric.row(static_cast<Eigen::Index>(probes.points.size())) =
        barycentric.row(i).eval(); // no row is overtaken
      probes.points.push_back(points[i]);
      probes.triangles.push_back(triangles[i]);
    }
  }
  probes.barycentric = barycentric.topRows(static_cast<Eigen::Index>(probes.points.size()));
  return probes;
}

Eigen::VectorXd ThicknessRatios(
  const TriangleMesh& rest, const Points& deformed, const ThicknessProbes& probes)
{
  const auto thickness = [&](const Points& x, Eigen::Index i)
  {
    const auto corners = rest.F.row(probes.triangles[i]);
    Eigen::RowVector3d across = -x.row(probes.points[i]);
    for (int k = 0; k < 3; ++k)
    {
      across += probes.barycentric(i, k) * x.row(corners(k));
    }
    return across.norm();
  };
  Eigen::VectorXd ratio(static_cast<Eigen::Index>(probes.points.size()));
  for (Eigen::Index i = 0; i < ratio.size(); ++i)
  {
    ratio(i) = thickness(deformed, i) / thickness(rest.P, i);
  }
  return ratio;
}

namespace
{
/// Boxes that together hold the triangles of a process, so that it is seldom asked in vain.
constexpr std::size_t MostBoxes = 64;

std::vector<double> BoxesAround(const TriangleTree* tree)
{
  std::deque<TriangleTree::Node> nodes;
  if (tree)
  {
    nodes.push_back(tree->GetRoot());
  }
  for (std::size_t leaves = 0; leaves < nodes.size() && nodes.size() < MostBoxes;)
  {
    const TriangleTree::Node node = nodes.front();
    nodes.pop_front();
    if (TriangleTree::IsLeaf(node))
    {
      nodes.push_back(node);
      ++leaves;
      continue;
    }
    nodes.push_back(tree->GetLeft(node));
    nodes.push_back(tree->GetRight(node));
    leaves = 0;
  }
  std::vector<double> rows;
  for (const TriangleTree::Node& node : nodes)
  {
    const Eigen::AlignedBox3d& box = tree->GetBox(node);
    rows.insert(rows.end(), box.min().begin(), box.min().end());
    rows.insert(rows.end(), box.max().begin(), box.max().end());
  }
  return rows;
}

/// Those of the other processes.
std::vector<Eigen::AlignedBox3d> BoxesOfOthers(const TriangleTree* tree, const SurfacePart& part)
{
  std::vector<Eigen::AlignedBox3d> boxes;
  if (part.IsWhole())
  {
    return boxes;
  }
  const std::vector<double> own = BoxesAround(tree);
  const auto before = static_cast<std::size_t>(CountBefore(part, static_cast<double>(own.size())));
  const std::vector<double> all = part.Concatenate(own);
  for (std::size_t k = 0; k < all.size(); k += 6)
  {
    if (k < before || k >= before + own.size())
    {
      boxes.emplace_back(Eigen::Map<const Eigen::Vector3d>(all.data() + k),
        Eigen::Map<const Eigen::Vector3d>(all.data() + k + 3));
    }
  }
  return boxes;
}

/// A ray that other processes are asked about: number of its point or -1, origin, direction, and
/// the distance of what is hit here.
using AskedRay = Eigen::Matrix<double, 1, 8>;
/// Distance of a hit along a ray, and its place at rest and deformed.
using RayAnswer = Eigen::Matrix<double, 1, 7>;

/// Rays from points against their normals.
class ThicknessRays
{
public:
  ThicknessRays(const TriangleMesh& rest, const Points& deformed, const SurfacePart& part)
    : Rest(rest)
    , Deformed(deformed)
    , Part(part)
    , P(FrameOf(rest.P, part).Into(rest.P))
    , Normals(PointNormals(this->P, rest.F, part))
    , Tree(rest.F.rows() > 0 ? std::make_unique<TriangleTree>(this->P, rest.F) : nullptr)
    , NumberOf(rest.P.rows(), -1)
  {
    if (!(EnclosedVolume(this->P, rest.F, part) < 0.0))
    {
      this->Normals *= -1.0;
    }
    for (std::size_t k = 0; k < part.shared.size(); ++k)
    {
      this->NumberOf[part.shared[k]] = part.numbers[k];
    }
  }

  /// One answer for each point that counts here and has a direction; what is met first here.
  void Look(int threads)
  {
    for (Eigen::Index i = 0; i < this->P.rows(); ++i)
    {
      if (this->Part.Counts(i) && this->Normals.row(i).norm() > 0.5)
      {
        this->Origins.push_back(static_cast<int>(i));
      }
    }
    const std::vector<Eigen::AlignedBox3d> others = BoxesOfOthers(this->Tree.get(), this->Part);
    const int n = static_cast<int>(this->Origins.size());
    this->Answers.resize(n);
    this->Asked.assign(n, 0);
    ParallelFor(n, threads,
      [&](int begin, int end)
      {
        for (int k = begin; k < end; ++k)
        {
          const int i = this->Origins[k];
          FirstHit hit(
            this->P, this->Rest.F, this->P.row(i), this->Normals.row(i), FirstHit::Nothing);
          hit.SkipPoint(i);
          this->Answers[k] = this->Search(hit);
          const bool asked = std::any_of(others.begin(), others.end(),
            [&hit](const Eigen::AlignedBox3d& box) { return hit.MayMeet(box); });
          this->Asked[k] = asked ? 1 : 0;
        }
      });
  }

  /// Makes the answers to rays that may meet triangles elsewhere those of all processes.
  void AskOthers(int threads)
  {
    std::vector<int> asked;
    std::vector<double> rows;
    for (std::size_t k = 0; k < this->Origins.size(); ++k)
    {
      if (this->Asked[k] != 0)
      {
        const int i = this->Origins[k];
        asked.push_back(static_cast<int>(k));
        AskedRay ray;
        ray << static_cast<double>(this->NumberOf[i]), this->P.row(i), this->Normals.row(i),
          this->Answers[k](0);
        rows.insert(rows.end(), ray.begin(), ray.end());
      }
    }
    const auto before =
      static_cast<std::size_t>(CountBefore(this->Part, static_cast<double>(asked.size())));
    rows = this->Part.Concatenate(rows);
    const auto n = static_cast<int>(rows.size() / AskedRay::SizeAtCompileTime);
    std::vector<int> pointOf(this->Part.numberOfShared, -1);
    for (std::size_t k = 0; k < this->Part.shared.size(); ++k)
    {
      pointOf[this->Part.numbers[k]] = this->Part.shared[k];
    }
    std::vector<RayAnswer> answers(n, NoAnswer());
    ParallelFor(n, threads,
      [&](int begin, int end)
      {
        for (int k = begin; k < end; ++k)
        {
          const Eigen::Map<const AskedRay> ray(
            rows.data() + static_cast<std::ptrdiff_t>(k) * AskedRay::SizeAtCompileTime);
          const int number = static_cast<int>(ray(0));
          FirstHit hit(this->P, this->Rest.F, ray.segment<3>(1), ray.segment<3>(4), ray(7));
          hit.SkipPoint(number >= 0 ? pointOf[number] : -1);
          answers[k] = this->Search(hit);
        }
      });
    for (std::size_t k = 0; k < asked.size(); ++k)
    {
      answers[before + k] = this->Answers[asked[k]];
    }
    const auto size = static_cast<std::size_t>(n);
    this->Part.processes->Reduce(size > 0 ? answers.front().data() : nullptr,
      size * RayAnswer::SizeAtCompileTime,
      [size](double* into, const double* from)
      {
        constexpr std::ptrdiff_t Width = RayAnswer::SizeAtCompileTime;
        for (std::size_t k = 0; k < size; ++k, into += Width, from += Width)
        {
          if (*from < *into)
          {
            std::copy_n(from, Width, into);
          }
        }
      });
    for (std::size_t k = 0; k < asked.size(); ++k)
    {
      this->Answers[asked[k]] = answers[before + k];
    }
  }

  /// n, see ThicknessRatios.
  Eigen::VectorXd Ratios() const
  {
    Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>
      found; // ratio, and whether there is one
    found.setZero(this->P.rows(), 2);
    for (std::size_t k = 0; k < this->Origins.size(); ++k)
    {
      const int i = this->Origins[k];
      const RayAnswer& answer = this->Answers[k];
      if (answer(0) < FirstHit::Nothing)
      {
        found(i, 0) = (answer.segment<3>(4) - this->Deformed.row(i)).norm() /
          (answer.segment<3>(1) - this->Rest.P.row(i)).norm();
        found(i, 1) = 1.0;
      }
    }
    this->Part.SumAtShared(found.data(), 2);
    return (found.col(1).array() > 0.0)
      .select(found.col(0), std::numeric_limits<double>::quiet_NaN());
  }

private:
  static RayAnswer NoAnswer()
  {
    RayAnswer answer = RayAnswer::Zero();
    answer(0) = FirstHit::Nothing;
    return answer;
  }

  RayAnswer Search(FirstHit& hit) const
  {
    if (this->Tree)
    {
      hit.Search(*this->Tree);
    }
    RayAnswer answer = NoAnswer();
    if (hit.GetTriangle() >= 0)
    {
      const auto corners = this->Rest.F.row(hit.GetTriangle());
      answer(0) = hit.GetDistance();
      for (int k = 0; k < 3; ++k)
      {
        answer.segment<3>(1) += hit.GetPlace()(k) * this->Rest.P.row(corners(k));
        answer.segment<3>(4) += hit.GetPlace()(k) * this->Deformed.row(corners(k));
      }
    }
    return answer;
  }

  const TriangleMesh& Rest;
  const Points& Deformed;
  const SurfacePart& Part;
  Points P;       // in the frame
  Points Normals; // inward
  std::unique_ptr<TriangleTree> Tree;
  std::vector<int> NumberOf; // of shared points
  std::vector<int> Origins;  // that have a ray
  std::vector<RayAnswer> Answers;
  std::vector<char> Asked;
};
}

Eigen::VectorXd ThicknessRatios(
  const TriangleMesh& rest, const Points& deformed, int threads, const SurfacePart& part)
{
  ThicknessRays rays(rest, deformed, part);
  rays.Look(threads);
  if (!part.IsWhole())
  {
    rays.AskOthers(threads);
  }
  return rays.Ratios();
}
} // namespace SphericalStyle
