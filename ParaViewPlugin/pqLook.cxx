// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqLook.h"

#include "pqAncestor.h"
#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqPropertiesPanel.h"
#include "pqServerManagerModel.h"
#include "pqShownValue.h"
#include "pqSourceOf.h"
#include "pqUndoStack.h"
#include "pqView.h"
#include "vtkAlgorithm.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

#include <QGridLayout>
#include <QPushButton>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>

namespace
{
/// More would be wider than the panel at first; what comes then has the next row for itself.
constexpr int ButtonsInRow = 2;

constexpr int ZAxis = 2;

void SetVisible(vtkSMProxy* representation, bool visible)
{
  if (representation)
  {
    vtkSMPropertyHelper(representation, "Visibility").Set(visible);
    representation->UpdateVTKObjects();
  }
}

bool IsVisible(vtkSMProxy* representation)
{
  return representation && vtkSMPropertyHelper(representation, "Visibility").GetAsInt() != 0;
}

bool HasPoints(vtkSMProxy* proxy)
{
  auto* source = vtkSMSourceProxy::SafeDownCast(proxy);
  vtkPVDataInformation* data = source ? source->GetDataInformation(0) : nullptr;
  return data && data->GetNumberOfPoints() > 0;
}

/// Whether the last execution had a result, in this process.
bool HasOutput(vtkSMProxy* proxy)
{
  auto* filter = vtkAlgorithm::SafeDownCast(proxy->GetClientSideObject());
  vtkDataObject* data = filter ? filter->GetOutputDataObject(0) : nullptr;
  return data && data->GetNumberOfElements(vtkDataObject::POINT) > 0;
}

vtkBoundingBox BoundsOf(vtkSMSourceProxy* source, unsigned int port)
{
  return source ? vtkBoundingBox(source->GetDataInformation(port)->GetBounds()) : vtkBoundingBox();
}

/// Of an output that is there; asking for it executes nothing.
vtkBoundingBox KnownBounds(vtkSMSourceProxy* source, unsigned int port)
{
  return source && pqExecutedSourceOf(source) ? BoundsOf(source, port) : vtkBoundingBox();
}

/// Of an array of points that a display shows.
std::pair<double, double> RangeOf(vtkSMPVRepresentationProxy* display, const QByteArray& array)
{
  vtkPVDataInformation* data = display->GetRepresentedDataInformation();
  vtkPVArrayInformation* values =
    data ? data->GetArrayInformation(array.data(), vtkDataObject::POINT) : nullptr;
  return values ? std::pair(values->GetComponentRange(0)[0], values->GetComponentRange(0)[1])
                : std::pair(0.0, 0.0);
}

/// A view with a camera; null without a view, and for a chart or a table.
vtkSMRenderViewProxy* RenderViewOf(const pqView* view)
{
  return vtkSMRenderViewProxy::SafeDownCast(view ? view->getViewProxy() : nullptr);
}

/// Whether the camera is among the points of a box.
bool IsFromInside(const pqView* view, const vtkBoundingBox& box)
{
  vtkSMRenderViewProxy* shown = RenderViewOf(view);
  return shown && box.ContainsPoint(shown->GetActiveCamera()->GetPosition());
}

/// The axis that a direction is nearest to: "x" or "-x".
QString AxisOf(const double* direction)
{
  const double* longest = std::max_element(direction, direction + 3,
    [](double one, double other) { return std::abs(one) < std::abs(other); });
  return QString(*longest < 0.0 ? "-" : "") + "xyz"[longest - direction];
}

/// A direction of the model, in the axes of a result whose z-axis is an axis of the model.
void Turn(double* direction, int axis)
{
  if (axis != ZAxis)
  {
    std::swap(direction[axis], direction[ZAxis]);
    direction[axis] = -direction[axis];
  }
}

void TurnBack(double* direction, int axis)
{
  if (axis != ZAxis)
  {
    direction[axis] = -direction[axis];
    std::swap(direction[axis], direction[ZAxis]);
  }
}

void TurnCamera(vtkSMRenderViewProxy* shown, int from, int to)
{
  vtkCamera* camera = shown->GetActiveCamera();
  double focus[3], back[3], up[3];
  camera->GetFocalPoint(focus);
  camera->GetPosition(back);
  vtkMath::Subtract(back, focus, back);
  camera->GetViewUp(up);
  for (double* direction : { back, up })
  {
    TurnBack(direction, from);
    Turn(direction, to);
  }
  vtkMath::Add(focus, back, back);
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper(shown, "CameraFocalPoint").Set(focus, 3);
  vtkSMPropertyHelper(shown, "CameraPosition").Set(back, 3);
  vtkSMPropertyHelper(shown, "CameraViewUp").Set(up, 3);
  shown->UpdateVTKObjects();
}

/// What a display is colored by, and whether the array has the colors itself.
QString ColorWords(vtkSMPVRepresentationProxy* display)
{
  return vtkSMPropertyHelper(display, "ColorArrayName").GetInputArrayNameToProcess() +
    QString(pqColors::areMapped(display) ? "" : " itself");
}

bool HasPointArray(vtkSMSourceProxy* source, const char* name)
{
  vtkPVDataInformation* data = source->GetDataInformation(0);
  return data && data->GetArrayInformation(name, vtkDataObject::POINT);
}
}

pqLook::pqLook(vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget)
  , Before(new QPushButton(tr("&Before"), this))
  , Source(pqSourceOf(smproxy))
{
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Before, 0, 0);
  this->Before->setObjectName("Before");
  this->Before->setCheckable(true);
  this->Before->setToolTip(
    tr("Shows the model in place of the result, until you click again. Alt+B does the same."));
  QObject::connect(this->Before, &QPushButton::toggled, this, &pqLook::showModel);
  vtkPVXMLElement* hints = smgroup->GetHints();
  for (unsigned int i = 0; hints && i < hints->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* hint = hints->GetNestedElement(i);
    if (QString(hint->GetName()) == "Color")
    {
      this->addColor(hint);
    }
    else if (QString(hint->GetName()) == "Turn")
    {
      this->IsTurned = smproxy->GetProperty(hint->GetAttributeOrEmpty("property"));
      this->Up = smproxy->GetProperty(hint->GetAttributeOrEmpty("axis"));
    }
    else
    {
      const bool plain = QString(hint->GetName()) == "Plain";
      (plain ? this->Plain : this->Names).insert(hint->GetAttributeOrEmpty("array"));
    }
  }
  layout->setColumnStretch(ButtonsInRow, 1);
  if (auto* filter = vtkAlgorithm::SafeDownCast(smproxy->GetClientSideObject()))
  {
    this->FilterObservers.add(filter, vtkCommand::EndEvent, this, &pqLook::noteExecution);
  }
  if (this->Source)
  {
    // Not in the middle of the update that tells of it.
    QObject::connect(this->Source.data(),
      qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this, &pqLook::refresh,
      Qt::QueuedConnection);
  }
  this->Framed = KnownBounds(vtkSMSourceProxy::SafeDownCast(smproxy), 0);
  this->FramedUp = this->upOfResult();
  this->refresh();
}

void pqLook::addColor(vtkPVXMLElement* xml)
{
  Color color{ xml->GetAttributeOrEmpty("array"), xml->GetAttributeOrEmpty("none"),
    QString(xml->GetAttributeOrEmpty("scale")) == "log",
    this->proxy()->GetProperty(xml->GetAttributeOrEmpty("of")),
    this->proxy()->GetProperty(xml->GetAttributeOrEmpty("least")),
    this->proxy()->GetProperty(xml->GetAttributeOrEmpty("property")),
    new QPushButton(xml->GetAttributeOrEmpty("text"), this) };
  color.Button->setObjectName(color.Array);
  color.Button->setCheckable(true);
  color.Button->setToolTip(tr("Colors the result by %1, with a legend in the view. %2")
                             .arg(pqShownValue::words(color.Array).toLower(),
                               QString::fromUtf8(xml->GetAttributeOrEmpty("note"))));
  const int place = 1 + static_cast<int>(this->Colors.size());
  qobject_cast<QGridLayout*>(this->layout())
    ->addWidget(color.Button, place / ButtonsInRow, place % ButtonsInRow, 1,
      place == ButtonsInRow ? ButtonsInRow : 1);
  QObject::connect(color.Button, &QPushButton::toggled, this,
    [this, color](bool on) { this->colorBy(color, on); });
  this->Colors.push_back(color);
}

bool pqLook::isSingleRowItem() const
{
  return true;
}

/// Not when the result is there: as long as it is hidden, it is not computed.
void pqLook::apply()
{
  this->Before->setChecked(false);
  this->pqPropertyWidget::apply();
  auto* panel = pqAncestor<pqPropertiesPanel>(this);
  if (panel && !this->result() && !this->FirstApply)
  {
    // After ParaView, which displays the result then, and in the same step of undo.
    this->FirstApply = QObject::connect(
      panel, qOverload<pqProxy*>(&pqPropertiesPanel::applied), this, &pqLook::showFirst);
  }
}

void pqLook::showFirst(pqProxy* applied)
{
  if (applied != this->Source)
  {
    return;
  }
  QObject::disconnect(this->FirstApply);
  this->FirstApply = {};
  const vtkSMPropertyHelper input(this->proxy(), "Input");
  this->Framed =
    KnownBounds(vtkSMSourceProxy::SafeDownCast(input.GetAsProxy()), input.GetOutputPort());
  this->FramedUp = ZAxis;
  vtkSMPVRepresentationProxy* display = this->result();
  if (display && HasPoints(this->proxy()))
  {
    this->colorFirst(display);
    // The panel says that it was executed only after this.
    this->frame(BoundsOf(vtkSMSourceProxy::SafeDownCast(this->proxy()), 0), this->upOfResult());
  }
  else
  {
    this->FirstFailed = display != nullptr;
  }
}

void pqLook::colorFirst(vtkSMPVRepresentationProxy* display)
{
  vtkSMViewProxy* smview = this->view()->getViewProxy();
  const QByteArray array = pqColors::get(display, smview).Array;
  vtkSMPVRepresentationProxy* before = this->model(); // is to have the colors of the result
  if (this->Names.contains(array))
  {
    pqColors::nameNumbers(display, true);
  }
  else if (this->Plain.contains(array))
  {
    pqColors::set(display, smview, {});
    if (before && this->Plain.contains(pqColors::get(before, smview).Array))
    {
      pqColors::set(before, smview, {});
    }
  }
  else if (pqColors::areShown(display))
  {
    pqColors::setMapped(display, false);
    display->SetScalarBarVisibility(smview, false);
    if (before && pqColors::areShown(before))
    {
      pqColors::setMapped(before, false);
      before->SetScalarBarVisibility(smview, false);
    }
  }
}

/// What ParaView does at the first Apply, where that had no result.
void pqLook::colorAfterFailure()
{
  vtkSMPVRepresentationProxy* display = this->result();
  if (!this->FirstFailed || !display || !HasPoints(this->proxy()))
  {
    return;
  }
  this->FirstFailed = false;
  vtkSMViewProxy* smview = this->view()->getViewProxy();
  vtkSMPVRepresentationProxy* before = this->model();
  if (before && !display->GetUsingScalarColoring())
  {
    SCOPED_UNDO_EXCLUDE();
    pqColors::set(display, smview, pqColors::get(before, smview));
    this->colorFirst(display);
    this->view()->render();
  }
}

/// Known of filters in this process; those of a server do not tell.
void pqLook::noteExecution()
{
  if (!HasOutput(this->proxy()))
  {
    this->Failed = true;
  }
  else if (this->Failed) // not in the middle of the update
  {
    QMetaObject::invokeMethod(this, &pqLook::showAfterFailure, Qt::QueuedConnection);
  }
}

/// After an update that failed, ParaView does not update the display again.
void pqLook::showAfterFailure()
{
  vtkSMPVRepresentationProxy* display = this->result();
  if (this->Failed && display && HasOutput(this->proxy()))
  {
    this->Failed = false;
    display->UpdateProperty("Input", 1);
    this->view()->render();
  }
}

void pqLook::select()
{
  this->pqPropertyWidget::select();
  this->refresh();
}

void pqLook::deselect()
{
  this->Before->setChecked(false);
  this->pqPropertyWidget::deselect();
}

void pqLook::setView(pqView* newView)
{
  if (newView != this->view())
  {
    this->Before->setChecked(false);
    this->pqPropertyWidget::setView(newView);
    this->refresh();
  }
}

/// How the active view displays the result; none before the first Apply.
vtkSMPVRepresentationProxy* pqLook::result() const
{
  auto* source = vtkSMSourceProxy::SafeDownCast(this->proxy());
  vtkSMViewProxy* smview = this->view() ? this->view()->getViewProxy() : nullptr;
  return smview && this->Source
    ? vtkSMPVRepresentationProxy::SafeDownCast(smview->FindRepresentation(source, 0))
    : nullptr;
}

vtkSMPVRepresentationProxy* pqLook::model() const
{
  const vtkSMPropertyHelper input(this->proxy(), "Input");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  vtkSMViewProxy* smview = this->view() ? this->view()->getViewProxy() : nullptr;
  return smview ? vtkSMPVRepresentationProxy::SafeDownCast(
                    smview->FindRepresentation(source, input.GetOutputPort()))
                : nullptr;
}

QString pqLook::seen() const
{
  QStringList words;
  vtkSMPVRepresentationProxy* before = this->model();
  if (IsVisible(before))
  {
    words << "model";
    if (before->GetUsingScalarColoring())
    {
      words << ColorWords(before);
    }
  }
  vtkSMPVRepresentationProxy* display = this->result();
  if (IsVisible(display))
  {
    words << "result";
    if (display->GetUsingScalarColoring())
    {
      words << ColorWords(display) +
          (pqColors::countNames(display) > 0
              ? QString(" of %1 names").arg(pqColors::countNames(display))
              : QString(pqColors::isLogarithmic(display) ? " log" : ""));
    }
    if (display->IsScalarBarVisible(this->view()->getProxy()))
    {
      words << "legend";
    }
    if (IsFromInside(this->view(), KnownBounds(vtkSMSourceProxy::SafeDownCast(this->proxy()), 0)))
    {
      words << "from inside";
    }
    if (!this->IsDrawn)
    {
      words << "not drawn";
    }
  }
  return words.join(", ");
}

QString pqLook::range() const
{
  vtkSMPVRepresentationProxy* display = this->result();
  const std::pair<double, double> ends = display ? pqColors::range(display) : std::pair(0.0, 0.0);
  // ParaView makes the range of numbers that are all the same a little larger.
  return QString("%1 to %2").arg(ends.first, 0, 'g', 3).arg(ends.second, 0, 'g', 3);
}

QString pqLook::camera() const
{
  vtkSMRenderViewProxy* shown = RenderViewOf(this->view());
  if (!shown)
  {
    return {};
  }
  double from[3];
  shown->GetActiveCamera()->GetDirectionOfProjection(from);
  vtkMath::MultiplyScalar(from, -1.0);
  return AxisOf(shown->GetActiveCamera()->GetViewUp()) + " up, from " + AxisOf(from);
}

void pqLook::showModel(bool show)
{
  SCOPED_UNDO_EXCLUDE();
  if (show)
  {
    const vtkSMPropertyHelper input(this->proxy(), "Input");
    auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
    this->Hidden = this->result();
    if (!source || !this->Hidden)
    {
      return;
    }
    vtkSMProxy* known = this->model();
    this->WasShown = IsVisible(known);
    vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
    this->Shown =
      known ? known : controller->Show(source, input.GetOutputPort(), this->view()->getViewProxy());
    SetVisible(this->Shown, true);
    SetVisible(this->Hidden, false);
    this->frame(KnownBounds(source, input.GetOutputPort()), ZAxis);
  }
  else
  {
    SetVisible(this->Hidden, true);
    SetVisible(this->Shown, this->WasShown);
    this->frame(KnownBounds(vtkSMSourceProxy::SafeDownCast(this->proxy()), 0), this->upOfResult());
    this->Hidden = nullptr;
    this->Shown = nullptr;
  }
  if (this->view())
  {
    this->view()->render();
  }
}

void pqLook::colorBy(const Color& color, bool on)
{
  if (on && color.Switch && pqShownValue::get(color.Switch) == 0.0)
  {
    pqShownValue::apply(this, color.Switch, 1.0);
  }
  this->Before->setChecked(false);
  if (vtkSMPVRepresentationProxy* display = this->result())
  {
    vtkSMViewProxy* smview = this->view()->getViewProxy();
    const pqColors::Choice before = pqColors::get(display, smview);
    const bool own = std::none_of(this->Colors.begin(), this->Colors.end(),
      [&](const Color& other) { return other.Array == before.Array; });
    if (on && own)
    {
      this->OwnColors = before;
    }
    BEGIN_UNDO_SET(tr("Color by %1").arg(color.Button->text()));
    this->IsColoring = true;
    pqColors::set(display, smview,
      on ? pqColors::Choice{ color.Array, vtkDataObject::POINT, true } : this->OwnColors);
    this->IsColoring = false;
    if (on && this->Names.contains(color.Array))
    {
      pqColors::nameNumbers(display, true);
    }
    else if (on)
    {
      this->fitRange(color);
    }
    if (on && color.IsLogarithmic)
    {
      pqColors::setLogarithmic(display);
    }
    if (on && !color.None.isEmpty())
    {
      pqColors::nameNone(display, smview, color.None);
    }
    END_UNDO_SET();
    this->view()->render();
  }
  this->refresh();
}

/// What its scale is to show: the numbers, and the least one that is wanted, or what they are
/// shares of.
std::pair<double, double> pqLook::rangeOf(const Color& color) const
{
  std::pair<double, double> numbers = RangeOf(this->result(), color.Array);
  if (color.Whole)
  {
    return { 0.0, std::max(vtkSMPropertyHelper(color.Whole).GetAsDouble(), numbers.second) };
  }
  const double least = color.Least ? vtkSMPropertyHelper(color.Least).GetAsDouble() : 0.0;
  if (least > 0.0)
  {
    numbers.first = std::min(least, numbers.first);
  }
  return numbers;
}

/// Also where the user has locked the range.
void pqLook::fitRange(const Color& color)
{
  vtkSMPVRepresentationProxy* display = this->result();
  this->Fitted = this->rangeOf(color);
  if (this->Fitted != RangeOf(display, color.Array))
  {
    pqColors::setRange(display, this->Fitted.first, this->Fitted.second);
  }
  else
  {
    display->RescaleTransferFunctionToDataRange(/*extend=*/false, /*force=*/true);
  }
}

/// The axis of the model that is the z-axis of the result.
int pqLook::upOfResult() const
{
  const bool isTurned = this->IsTurned && vtkSMPropertyHelper(this->IsTurned).GetAsInt() != 0;
  return isTurned && this->Up ? vtkSMPropertyHelper(this->Up).GetAsInt() : ZAxis;
}

/// Whether the camera may not see what the view is to show now.
bool pqLook::isElsewhere(const vtkBoundingBox& now) const
{
  constexpr double Larger = 1.1;
  constexpr double MuchLarger = 3.0;
  const double size = now.GetDiagonalLength();
  const double before = this->Framed.GetDiagonalLength();
  double from[3], to[3];
  this->Framed.GetCenter(from);
  now.GetCenter(to);
  const bool comesAround = size > Larger * before && IsFromInside(this->view(), now) &&
    !IsFromInside(this->view(), this->Framed);
  return size > MuchLarger * before || before > MuchLarger * size || comesAround ||
    vtkMath::Distance2BetweenPoints(from, to) > before * before;
}

void pqLook::frame(const vtkBoundingBox& now, int up)
{
  vtkSMRenderViewProxy* shown = RenderViewOf(this->view());
  if (!now.IsValid() || !shown)
  {
    return;
  }
  const bool isTurned = up != this->FramedUp;
  if (this->Framed.IsValid() && (isTurned || this->isElsewhere(now)))
  {
    if (isTurned)
    {
      TurnCamera(shown, this->FramedUp, up);
    }
    shown->ResetCamera();
    this->IsDrawn = false;
    QObject::connect(
      this->view(), &pqView::endRender, this, &pqLook::noteDrawing, Qt::UniqueConnection);
    this->view()->render();
  }
  this->Framed = now;
  this->FramedUp = up;
}

void pqLook::noteDrawing()
{
  this->IsDrawn = true;
}

/// The display of the result may be another one, or have other colors.
void pqLook::refresh()
{
  this->colorAfterFailure();
  if (IsVisible(this->result()))
  {
    this->frame(KnownBounds(vtkSMSourceProxy::SafeDownCast(this->proxy()), 0), this->upOfResult());
  }
  this->Observers.clear();
  vtkSMPVRepresentationProxy* display = this->result();
  if (vtkSMProperty* colors = display ? display->GetProperty("ColorArrayName") : nullptr)
  {
    this->Observers.add(colors, vtkCommand::ModifiedEvent, this, &pqLook::fitColors);
    this->Observers.add(colors, vtkCommand::ModifiedEvent, this, &pqLook::updateButtons);
    this->fitColors();
  }
  this->updateButtons();
}

/// Numbers that are no colors need a color map again, new names colors, and what is new a range.
void pqLook::fitColors()
{
  vtkSMPVRepresentationProxy* display = this->result();
  const QByteArray array =
    display ? pqColors::get(display, this->view()->getViewProxy()).Array : QByteArray();
  // Where ParaView sets another array, the color map is still that of the array before.
  const auto kept = std::find_if(this->Colors.begin(), this->Colors.end(),
    [&](const Color& color)
    {
      return (color.IsLogarithmic || color.Whole) && color.Button->isChecked() &&
        color.Array == array;
    });
  // None yet where ParaView is about to set another array, or still that of the array before.
  const bool hasMap = kept != this->Colors.end() && !this->IsColoring &&
    vtkSMPropertyHelper(display, "LookupTable").GetAsProxy();
  if (hasMap && !pqColors::isLocked(display) && this->Fitted != this->rangeOf(*kept))
  {
    SCOPED_UNDO_EXCLUDE();
    this->fitRange(*kept);
  }
  if (this->Names.contains(array))
  {
    SCOPED_UNDO_EXCLUDE();
    pqColors::nameNumbers(display, false);
  }
  if (display && !pqColors::areMapped(display) && pqColors::areShown(display))
  {
    this->WithColors = display;
  }
  else if (display && display == this->WithColors)
  {
    pqColors::setMapped(display, !pqColors::areShown(display));
  }
}

void pqLook::updateButtons()
{
  vtkSMPVRepresentationProxy* display = this->result();
  this->Before->setEnabled(display);
  const char* array = display && display->GetUsingScalarColoring()
    ? vtkSMPropertyHelper(display, "ColorArrayName").GetInputArrayNameToProcess()
    : nullptr;
  for (const Color& color : this->Colors)
  {
    const QSignalBlocker blocker(color.Button);
    color.Button->setChecked(array && color.Array == array);
    color.Button->setEnabled(display);
    color.Button->setVisible(color.Switch ||
      (display && HasPointArray(vtkSMSourceProxy::SafeDownCast(this->proxy()), color.Array)));
  }
}
