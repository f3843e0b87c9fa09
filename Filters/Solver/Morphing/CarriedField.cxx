// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "CarriedField.h"

#include "DeformationMeasures.h"
#include "Frame.h"
#include "LocalStep.h"
#include "Parallel.h"
#include "Smoothstep.h"
#include "SurfaceMeasures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <utility>

namespace SphericalStyle
{
namespace
{
constexpr int MostInLeaf = 8;
constexpr double Near = 4.0; // in radii of a group
constexpr double Far = 6.0;
/// Distances count as at least this, in the frame, so that the weight on a sample is finite.
constexpr double Touching = 1e-6;

double Weight(double area, double squaredDistance)
{
  const double d = squaredDistance + Touching * Touching;
  return area / (d * d);
}

/// 0 up to Near, 1 from Far on.
double ShareOfGroup(double distance, double radius)
{
  return Smoothstep(std::clamp((distance - Near * radius) / ((Far - Near) * radius), 0.0, 1.0));
}
} // namespace

CarriedField::CarriedField(const TriangleMesh& rest, const Points& moved, int threads)
  : Moves(moved != rest.P)
{
  if (rest.F.rows() == 0)
  {
    throw std::invalid_argument("it has no triangle with an area");
  }
  const Frame frame = FrameOf(rest.P);
  this->Origin = frame.origin;
  this->Scale = frame.scale;
  const TriangleMesh mesh = { frame.Into(rest.P), rest.F };
  const Points Q = frame.Into(moved);
  const Eigen::VectorXd areas = PointAreas(mesh.P, mesh.F);
  const Matrices R = SurfaceRotations(mesh, Q, threads);
  std::vector<Group> samples;
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    if (areas[i] > 0.0)
    {
      Group sample;
      sample.center = mesh.P.row(i);
      sample.area = areas[i];
      sample.offset = Q.row(i) - mesh.P.row(i);
      sample.turn = R[i] - Eigen::Matrix3d::Identity();
      samples.push_back(sample);
    }
  }
  std::vector<int> order(samples.size());
  std::iota(order.begin(), order.end(), 0);
  this->Samples = std::move(samples);
  this->Groups.emplace_back();
  this->Groups[0].end = static_cast<int>(order.size());
  for (int group = 0; group < static_cast<int>(this->Groups.size()); ++group)
  {
    this->Split(group, order);
  }
  std::vector<Group> sorted;
  sorted.reserve(order.size());
  for (const int k : order)
  {
    sorted.push_back(this->Samples[k]);
  }
  this->Samples = std::move(sorted);
  for (Group& group : this->Groups)
  {
    this->Summarize(group);
  }
}

/// In the middle of the longer side of its bounds.
void CarriedField::Split(int group, std::vector<int>& order)
{
  const int begin = this->Groups[group].begin;
  const int end = this->Groups[group].end;
  if (end - begin <= MostInLeaf)
  {
    return;
  }
  Eigen::AlignedBox3d box;
  for (int k = begin; k < end; ++k)
  {
    box.extend(this->Samples[order[k]].center);
  }
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
    [&](int a, int b)
    {
      return std::pair(this->Samples[a].center[axis], a) <
        std::pair(this->Samples[b].center[axis], b);
    });
  this->Groups[group].child = static_cast<int>(this->Groups.size());
  for (const auto& [from, to] : { std::pair(begin, middle), std::pair(middle, end) })
  {
    Group half;
    half.begin = from;
    half.end = to;
    this->Groups.push_back(half);
  }
}

void CarriedField::Summarize(Group& group) const
{
  for (int k = group.begin; k < group.end; ++k)
  {
    const Group& sample = this->Samples[k];
    group.area += sample.area;
    group.center += sample.area * sample.center;
  }
  group.center /= group.area;
  for (int k = group.begin; k < group.end; ++k)
  {
    const Group& sample = this->Samples[k];
    const double share = sample.area / group.area;
    group.radius = std::max(group.radius, (sample.center - group.center).norm());
    group.turn += share * sample.turn;
    group.offset += share * (sample.offset + sample.turn * (group.center - sample.center));
  }
}

CarriedField::Group CarriedField::Blend(const Eigen::Vector3d& x) const
{
  Group blend;
  const auto add = [&](const Group& group, double share)
  {
    const Eigen::Vector3d from = x - group.center;
    const double weight = share * Weight(group.area, from.squaredNorm());
    blend.offset += weight * (group.offset + group.turn * from);
    blend.turn += weight * group.turn;
    blend.area += weight;
  };
  std::vector<std::pair<int, double>> open = { { 0, 1.0 } }; // groups, and how much of them counts
  while (!open.empty())
  {
    const auto [index, share] = open.back();
    open.pop_back();
    const Group& group = this->Groups[index];
    const double ofGroup = ShareOfGroup((x - group.center).norm(), group.radius);
    if (ofGroup > 0.0)
    {
      add(group, share * ofGroup);
    }
    if (ofGroup < 1.0 && group.child >= 0)
    {
      open.emplace_back(group.child, share * (1.0 - ofGroup));
      open.emplace_back(group.child + 1, share * (1.0 - ofGroup));
    }
    else if (ofGroup < 1.0)
    {
      for (int k = group.begin; k < group.end; ++k)
      {
        add(this->Samples[k], share * (1.0 - ofGroup));
      }
    }
  }
  blend.offset /= blend.area;
  blend.turn /= blend.area;
  return blend;
}

Eigen::Vector3d CarriedField::IntoFrame(const Points& x, int row) const
{
  return (x.row(row) - this->Origin).transpose() / this->Scale;
}

Points CarriedField::At(const Points& x, int threads) const
{
  Points u = Points::Zero(x.rows(), 3);
  if (!this->Moves)
  {
    return u;
  }
  ParallelFor(static_cast<int>(x.rows()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        u.row(i) = this->Scale * this->Blend(this->IntoFrame(x, i)).offset.transpose();
      }
    });
  return u;
}

Matrices CarriedField::RotationsAt(const Points& x, int threads) const
{
  Matrices R(x.rows(), Eigen::Matrix3d::Identity());
  if (!this->Moves)
  {
    return R;
  }
  ParallelFor(static_cast<int>(x.rows()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const Eigen::Matrix3d turn = this->Blend(this->IntoFrame(x, i)).turn;
        if (!turn.isZero(0.0))
        {
          R[i] = ClosestRotation((turn + Eigen::Matrix3d::Identity()).transpose());
        }
      }
    });
  return R;
}
} // namespace SphericalStyle
