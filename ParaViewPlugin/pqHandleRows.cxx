// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqHandleRows.h"

#include "pqPointPickingHelper.h"
#include "pqSourceOf.h"
#include "pqUndoStack.h"
#include "vtkBoundingBox.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"

namespace
{
constexpr std::size_t RowSize = 10; // place, radius, move-to, rotation
constexpr std::size_t MoveTo = 4;
constexpr double RadiusOfNew = 0.05; // of the diagonal

vtkSmartPointer<vtkSMSourceProxy> NewSource(vtkSMProxy* beside, const char* group, const char* name)
{
  vtkSmartPointer<vtkSMProxy> made;
  made.TakeReference(beside->GetSessionProxyManager()->NewProxy(group, name));
  made->PrototypeOn();
  return vtkSMSourceProxy::SafeDownCast(made);
}
}

pqHandleRows::pqHandleRows(
  vtkSMProxy* smproxy, vtkSMPropertyGroup* /*group*/, QWidget* parentWidget)
  : pqViewHandles(smproxy, smproxy->GetProperty("Handle"),
      tr("Click in the view, point at the model and press P to put a handle there. Drag handles; "
         "those that you leave where they are hold their place, all that is within their Radius."),
      parentWidget)
{
  auto* picking = new pqPointPickingHelper(QKeySequence(tr("P")), true, this);
  picking->connect(this, SIGNAL(viewChanged(pqView*)), SLOT(setView(pqView*)));
  this->connect(
    picking, SIGNAL(pick(double, double, double)), SLOT(addHandle(double, double, double)));
}

void pqHandleRows::addHandle(double x, double y, double z)
{
  if (!this->isSelected())
  {
    return;
  }
  const Place shown = { x, y, z };
  const Place place = this->placeOnModel(shown);
  const vtkSMPropertyHelper input(this->proxy(), "Input");
  auto* model = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  vtkBoundingBox bounds;
  if (model)
  {
    bounds.SetBounds(model->GetDataInformation(input.GetOutputPort())->GetBounds());
  }
  const double radius = bounds.IsValid() ? RadiusOfNew * bounds.GetDiagonalLength() : 0.0;
  std::vector<double> rows = this->shownNumbers();
  rows.insert(rows.end(), place.begin(), place.end());
  rows.push_back(radius);
  rows.insert(rows.end(), shown.begin(), shown.end());
  rows.resize(rows.size() + 3, 0.0);
  this->showNumbers(rows);
  Q_EMIT this->changeAvailable();
  Q_EMIT this->changeFinished();
}

/// Of a point of the result: where it was. Points of the model itself are not found in the result,
/// or have not moved.
pqHandleRows::Place pqHandleRows::placeOnModel(const Place& shown) const
{
  Place place = shown;
  if (!pqExecutedSourceOf(this->proxy()))
  {
    return place;
  }
  SCOPED_UNDO_EXCLUDE();
  const auto point = NewSource(this->proxy(), "extended_sources", "FixedRadiusPointSource");
  const auto probe = NewSource(this->proxy(), "filters", "ProbePoint");
  vtkNew<vtkSMParaViewPipelineController> controller;
  controller->InitializeProxy(point);
  vtkSMPropertyHelper(point, "Center").Set(shown.data(), 3);
  point->UpdateVTKObjects();
  controller->PreInitializeProxy(probe);
  vtkSMPropertyHelper(probe, "Input").Set(this->proxy(), 0);
  vtkSMPropertyHelper(probe, "Source").Set(point, 0);
  controller->PostInitializeProxy(probe);
  probe->UpdateVTKObjects();
  probe->UpdatePipeline();
  vtkPVDataSetAttributesInformation* values =
    probe->GetDataInformation(0)->GetPointDataInformation();
  vtkPVArrayInformation* found = values->GetArrayInformation("vtkValidPointMask");
  vtkPVArrayInformation* moved = values->GetArrayInformation("Displacement");
  if (found && moved && found->GetComponentRange(0)[1] > 0.0)
  {
    for (int k = 0; k < 3; ++k)
    {
      place[k] -= moved->GetComponentRange(k)[0];
    }
  }
  return place;
}

std::vector<pqViewHandles::Place> pqHandleRows::places() const
{
  const std::vector<double> rows = this->shownNumbers();
  std::vector<Place> places;
  for (std::size_t first = 0; first + RowSize <= rows.size(); first += RowSize)
  {
    const double* to = rows.data() + first + MoveTo;
    places.push_back({ to[0], to[1], to[2] });
  }
  return places;
}

void pqHandleRows::handleMoved(int handle, const Place& to)
{
  std::vector<double> rows = this->shownNumbers();
  const std::size_t first = handle * RowSize + MoveTo;
  if (first + to.size() <= rows.size())
  {
    std::copy(to.begin(), to.end(), rows.begin() + static_cast<std::ptrdiff_t>(first));
    this->showNumbers(rows);
  }
}
