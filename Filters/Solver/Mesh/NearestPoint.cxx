// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "NearestPoint.h"

#include <utility>

namespace SphericalStyle
{
Eigen::Vector3d NearestOfTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double abFromA = ab.dot(p - a);
  const double acFromA = ac.dot(p - a);
  if (abFromA <= 0.0 && acFromA <= 0.0)
  {
    return a;
  }
  const double abFromB = ab.dot(p - b);
  const double acFromB = ac.dot(p - b);
  if (abFromB >= 0.0 && acFromB <= abFromB)
  {
    return b;
  }
  const double overC = abFromA * acFromB - abFromB * acFromA; // area over ab, times that of abc
  if (overC <= 0.0 && abFromA >= 0.0 && abFromB <= 0.0)
  {
    return a + abFromA / (abFromA - abFromB) * ab;
  }
  const double abFromC = ab.dot(p - c);
  const double acFromC = ac.dot(p - c);
  if (acFromC >= 0.0 && abFromC <= acFromC)
  {
    return c;
  }
  const double overB = abFromC * acFromA - abFromA * acFromC;
  if (overB <= 0.0 && acFromA >= 0.0 && acFromC <= 0.0)
  {
    return a + acFromA / (acFromA - acFromC) * ac;
  }
  const double overA = abFromB * acFromC - abFromC * acFromB;
  const double fromB = acFromB - abFromB;
  const double fromC = abFromC - acFromC;
  if (overA <= 0.0 && fromB >= 0.0 && fromC >= 0.0)
  {
    return b + fromB / (fromB + fromC) * (c - b);
  }
  const double whole = overA + overB + overC;
  return a + overB / whole * ab + overC / whole * ac;
}

/// Nearest boxes first.
void NearestPoint::Search(const TriangleTree& tree, const TriangleTree::Node& node)
{
  if (TriangleTree::IsLeaf(node))
  {
    std::for_each(tree.Begin(node), tree.End(node), [this](int f) { this->Test(f); });
    return;
  }
  TriangleTree::Node near = tree.GetLeft(node);
  TriangleTree::Node far = tree.GetRight(node);
  double toNear = tree.GetBox(near).squaredExteriorDistance(this->Place);
  double toFar = tree.GetBox(far).squaredExteriorDistance(this->Place);
  if (toFar < toNear)
  {
    std::swap(near, far);
    std::swap(toNear, toFar);
  }
  if (toNear < this->Square)
  {
    this->Search(tree, near);
  }
  if (toFar < this->Square)
  {
    this->Search(tree, far);
  }
}

void NearestPoint::Test(int f)
{
  const auto corners = this->F.row(f);
  const Eigen::Vector3d nearest =
    NearestOfTriangle(this->Place, this->P.row(corners(0)).transpose(),
      this->P.row(corners(1)).transpose(), this->P.row(corners(2)).transpose());
  const double square = (this->Place - nearest).squaredNorm();
  if (square < this->Square)
  {
    this->Square = square;
    this->Triangle = f;
    this->Point = nearest;
  }
}
} // namespace SphericalStyle
