// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqTargetLengths.h"

#include "pqSourceOf.h"
#include "pqView.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkPVDataInformation.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"

#include <algorithm>
#include <cmath>

namespace
{
/// With the volume kept, one length of three grows with this root of its ratio to the others.
constexpr double RootOfRatio = 1.5;
constexpr double AtTheViewer = 0.94; // cosine of 20 degrees
constexpr double Shortest = 0.1;     // of the longest, as in vtkSphericalStyleFilter
}

pqTargetLengths::pqTargetLengths(
  vtkSMProxy* smproxy, vtkSMPropertyGroup* /*group*/, QWidget* parentWidget)
  : pqViewHandles(smproxy, smproxy->GetProperty("TargetLengths"),
      tr("Drag the handles in the view to change the lengths: red along X, yellow along Y, green "
         "along Z. Drag one that points at you up or down."),
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
  auto* shown = vtkSMRenderViewProxy::SafeDownCast(this->view()->getProxy());
  double along[3] = {};
  Place up = {};
  if (shown)
  {
    double right[3];
    shown->GetActiveCamera()->GetDirectionOfProjection(along);
    vtkMath::Cross(along, shown->GetActiveCamera()->GetViewUp(), right);
    vtkMath::Cross(right, along, up.data());
    vtkMath::Normalize(up.data());
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Pull[axis] = {};
    this->Pull[axis][axis] = 1.0;
    if (std::abs(along[axis]) > AtTheViewer)
    {
      this->Pull[axis] = up;
    }
  }
}

void pqTargetLengths::handleMoved(int handle, const Place& to)
{
  if (!this->Begin.IsKnown)
  {
    return;
  }
  const double half = this->Begin.Half[handle];
  Place from = this->Begin.Center;
  from[handle] += half;
  Place motion;
  vtkMath::Subtract(to, from, motion);
  const double pulled = vtkMath::Dot(motion.data(), this->Pull[handle].data());
  const double factor = std::max(1.0 + pulled / half, 0.0);
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
