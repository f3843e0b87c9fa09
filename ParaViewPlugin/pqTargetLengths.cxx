// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqTargetLengths.h"

#include "pqSourceOf.h"
#include "vtkBoundingBox.h"
#include "vtkPVDataInformation.h"
#include "vtkSMSourceProxy.h"

#include <algorithm>
#include <cmath>

namespace
{
/// With the volume kept, one length of three grows with this root of its ratio to the others.
constexpr double RootOfRatio = 1.5;
constexpr double Shortest = 0.1; // of the longest, as in vtkSphericalStyleFilter
}

pqTargetLengths::pqTargetLengths(
  vtkSMProxy* smproxy, vtkSMPropertyGroup* /*group*/, QWidget* parentWidget)
  : pqViewHandles(smproxy, smproxy->GetProperty("TargetLengths"),
      tr("Drag the handles in the view to change the lengths: red along X, yellow along Y, green "
         "along Z."),
      parentWidget)
{
}

pqTargetLengths::Extent pqTargetLengths::extent() const
{
  Extent extent;
  auto* source = vtkSMSourceProxy::SafeDownCast(this->proxy());
  if (!pqExecutedSourceOf(this->proxy()) || !source)
  {
    return extent;
  }
  vtkBoundingBox bounds(
    source->GetDataInformation(source->GetOutputPortIndex("Target Sphere"))->GetBounds());
  if (bounds.IsValid())
  {
    bounds.GetCenter(extent.Center.data());
    bounds.GetLengths(extent.Half.data());
    std::for_each(extent.Half.begin(), extent.Half.end(), [](double& length) { length *= 0.5; });
    extent.IsKnown = *std::min_element(extent.Half.begin(), extent.Half.end()) > 0.0;
  }
  return extent;
}

std::vector<pqViewHandles::Place> pqTargetLengths::places() const
{
  const Extent now = this->extent();
  std::vector<Place> places;
  for (std::size_t axis = 0; axis < 3 && now.IsKnown; ++axis)
  {
    places.push_back(now.Center);
    places.back()[axis] += now.Half[axis];
  }
  return places;
}

/// As of the axes in the corner of the view.
QColor pqTargetLengths::color(std::size_t handle) const
{
  return std::array<Qt::GlobalColor, 3>{ Qt::red, Qt::yellow, Qt::green }[handle];
}

void pqTargetLengths::dragBegins()
{
  this->Begin = this->extent();
}

void pqTargetLengths::handleMoved(int handle, const Place& to)
{
  if (!this->Begin.IsKnown)
  {
    return;
  }
  const double half = this->Begin.Half[handle];
  const double factor = std::max((to[handle] - this->Begin.Center[handle]) / half, 0.0);
  std::vector<double> lengths;
  for (const double other : this->Begin.Half)
  {
    lengths.push_back(2.0 * other);
  }
  lengths[handle] *= std::pow(factor, RootOfRatio);
  const double longest = *std::max_element(lengths.begin(), lengths.end());
  lengths[handle] = std::max(lengths[handle], Shortest * longest);
  this->showNumbers(lengths);
}
