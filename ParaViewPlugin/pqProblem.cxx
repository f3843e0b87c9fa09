// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqProblem.h"

#include "pqAncestor.h"
#include "pqFilterInFront.h"
#include "pqNote.h"
#include "pqOutputWidget.h"
#include "pqPipelineSource.h"
#include "pqPropertyWidgetDecorator.h"
#include "pqServerManagerModel.h"
#include "pqShownValue.h"
#include "pqSourceOf.h"
#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkOutputWindow.h"
#include "vtkPVDataInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QPushButton>
#include <QRegularExpression>
#include <QStringList>
#include <QVBoxLayout>

#include <algorithm>

namespace
{
/// None before the input was executed: asking for it would do that.
vtkPVDataInformation* KnownData(vtkSMProxy* proxy)
{
  const vtkSMPropertyHelper input(proxy, "Input");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  const pqPipelineSource* item = pqSourceOf(source);
  return item && item->modifiedState() != pqProxy::UNINITIALIZED
    ? source->GetDataInformation(input.GetOutputPort())
    : nullptr;
}

bool IsNoSurface(vtkPVDataInformation* data)
{
  return data && !data->IsNull() && !data->IsCompositeDataSet() &&
    !data->DataSetTypeIsA("vtkPolyData");
}
}

/// ParaView asks decorators whether a widget is to be seen.
class pqProblem::Visibility : public pqPropertyWidgetDecorator
{
public:
  explicit Visibility(pqPropertyWidget* widget)
    : pqPropertyWidgetDecorator(nullptr, widget)
  {
  }

  bool canShowWidget(bool) const override { return this->Visible; }

  void setVisible(bool visible)
  {
    if (visible != this->Visible)
    {
      this->Visible = visible;
      Q_EMIT this->visibilityChanged();
    }
  }

private:
  bool Visible = false;
};

pqProblem::pqProblem(vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget)
  , Note(new pqNote(this))
  , Button(new QPushButton(tr("Extract Surface"), this))
  , RemedyButton(new QPushButton(this))
  , Shown(new Visibility(this))
{
  this->setShowLabel(false);
  this->Note->setTextFormat(Qt::PlainText); // messages have names of arrays and files
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Note);
  layout->addWidget(this->Button, 0, Qt::AlignLeft);
  layout->addWidget(this->RemedyButton, 0, Qt::AlignLeft);
  this->Button->setObjectName("ExtractSurface");
  this->Button->setToolTip(tr("Puts the filter Extract Surface in front of this one."));
  // Not at once: the click makes another panel the active one.
  QObject::connect(
    this->Button, &QPushButton::clicked, this, &pqProblem::extractSurface, Qt::QueuedConnection);
  this->RemedyButton->setObjectName("Remedy");
  QObject::connect(this->RemedyButton, &QPushButton::clicked, this, &pqProblem::remedy);
  this->Observers.add(
    smproxy->GetProperty("Input"), vtkCommand::ModifiedEvent, this, &pqProblem::watchInput);
  for (const auto event : { vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
  {
    this->Observers.add(vtkOutputWindow::GetInstance(), event, this, &pqProblem::hear);
  }
  for (const QWidget* window : QApplication::topLevelWidgets())
  {
    if (const auto* log = window->findChild<pqOutputWidget*>())
    {
      this->MessageDock = pqAncestor<QDockWidget>(log);
    }
  }
  if (this->MessageDock)
  {
    this->MessageDock->installEventFilter(this);
  }
  vtkPVXMLElement* hints = smgroup->GetHints();
  this->AnyDataSet = hints && hints->FindNestedElementByName("AnyDataSet");
  if (vtkPVXMLElement* xml = hints ? hints->FindNestedElementByName("Required") : nullptr)
  {
    this->Required = smproxy->GetProperty(xml->GetAttributeOrEmpty("property"));
    this->MissingText = xml->GetAttributeOrEmpty("text");
    for (const auto event :
      { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
    {
      this->Observers.add(this->Required, event, this, &pqProblem::updateText);
    }
  }
  if (vtkPVXMLElement* xml = hints ? hints->FindNestedElementByName("Remedy") : nullptr)
  {
    this->Remedy = smproxy->GetProperty(xml->GetAttributeOrEmpty("property"));
    this->RemedyButton->setText(pqShownValue::label(this->Remedy));
    this->RemedyButton->setToolTip(tr("Turns it on and applies it. Undo takes it back."));
  }
  if (auto* filter = vtkAlgorithm::SafeDownCast(smproxy->GetClientSideObject()))
  {
    this->Observers.add(
      filter->GetExecutive(), vtkCommand::ErrorEvent, this, &pqProblem::hearPipeline);
    this->Observers.add(filter, vtkCommand::StartEvent, this, &pqProblem::begin);
    this->Observers.add(filter, vtkCommand::EndEvent, this, &pqProblem::end);
  }
  this->watchInput();
}

void pqProblem::select()
{
  this->pqPropertyWidget::select();
  this->updateText();
}

void pqProblem::watchInput()
{
  QObject::disconnect(this->InputUpdated);
  if (pqPipelineSource* input =
        pqSourceOf(vtkSMPropertyHelper(this->proxy(), "Input").GetAsProxy()))
  {
    // Not in the middle of the update that tells of it.
    this->InputUpdated =
      QObject::connect(input, qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
        &pqProblem::updateText, Qt::QueuedConnection);
  }
  this->updateText();
}

/// "vtkSphericalStyleFilter (0x55d0c0ffee00): what it says", maybe with file and line before it.
void pqProblem::hear(vtkObject*, unsigned long event, void* text)
{
  const QString name = this->proxy()->GetVTKClassName();
  const QRegularExpression form(
    name + R"( \((\w+)\): (.*))", QRegularExpression::DotMatchesEverythingOption);
  const QRegularExpressionMatch match = form.match(static_cast<const char*>(text));
  // That of a server is an address elsewhere; then it may be of another filter of the same class.
  const auto* object = this->proxy()->GetClientSideObject();
  const bool same =
    !object || match.captured(1).toULongLong(nullptr, 16) == reinterpret_cast<quintptr>(object);
  if (!match.hasMatch() || !same)
  {
    this->Opened = false; // for this one it stays open
    return;
  }
  // Warnings of another filter than the one in the panel are in its panel when it is chosen.
  const QWidget* panel = this->parentWidget();
  const bool isError = event == vtkCommand::ErrorEvent;
  if (this->Opened && panel && (panel->isVisible() || !isError))
  {
    this->MessageDock->hide();
  }
  this->Messages.push_back({ match.captured(2).trimmed(), isError });
  this->updateLater();
}

/// ParaView opens the dock before it tells of the message.
bool pqProblem::eventFilter(QObject* messageDock, QEvent* event)
{
  if (event->type() == QEvent::Show)
  {
    this->Opened = true;
    QMetaObject::invokeMethod(
      this, [this] { this->Opened = false; }, Qt::QueuedConnection);
  }
  return this->pqPropertyWidget::eventFilter(messageDock, event);
}

/// VTK's pipeline says of a filter that failed only that it did: not again where the filter has
/// said why.
void pqProblem::hearPipeline(vtkObject*, unsigned long, void* text)
{
  const auto* words = static_cast<const char*>(text);
  const bool known = std::any_of(this->Messages.begin() + static_cast<std::ptrdiff_t>(this->Old),
    this->Messages.end(), [](const Message& message) { return message.IsError; });
  if (!known || !QString(words).contains("returned failure for request"))
  {
    vtkOutputWindow::GetInstance()->DisplayErrorText(words);
  }
}

void pqProblem::begin()
{
  this->Messages.erase(
    this->Messages.begin(), this->Messages.begin() + static_cast<std::ptrdiff_t>(this->Old));
  this->Old = 0;
  this->updateLater();
}

void pqProblem::end()
{
  this->Old = this->Messages.size();
}

/// ParaView applies the panels of all filters. That is all that is known of executions of a server;
/// filters of this process tell when they execute.
void pqProblem::apply()
{
  const pqPipelineSource* item = pqSourceOf(this->proxy());
  if (!this->proxy()->GetClientSideObject() || !item ||
    item->modifiedState() != pqProxy::UNMODIFIED)
  {
    this->end();
    this->begin();
  }
  this->pqPropertyWidget::apply();
}

/// Not in the middle of the execution.
void pqProblem::updateLater()
{
  QMetaObject::invokeMethod(this, &pqProblem::updateText, Qt::QueuedConnection);
}

void pqProblem::updateText()
{
  const QString ofInput = this->problemOfInput();
  QStringList texts;
  bool serious = !ofInput.isEmpty();
  for (const Message& message : this->Messages)
  {
    texts << message.Text.left(1).toUpper() + message.Text.mid(1);
    serious = serious || message.IsError;
  }
  texts.removeDuplicates();
  const QString text = ofInput.isEmpty() ? texts.join("\n\n") : ofInput;
  if (!text.isEmpty()) // else it goes as it is
  {
    this->Note->setText(pqShownValue::inWordsOfPanel(text, this->proxy()));
    this->Note->setSerious(serious);
    this->Button->setVisible(!this->AnyDataSet && IsNoSurface(KnownData(this->proxy())));
    this->RemedyButton->setVisible(this->Remedy && text.contains(this->Remedy->GetXMLName()) &&
      pqShownValue::get(this->Remedy) == 0.0);
  }
  this->Shown->setVisible(!text.isEmpty());
}

/// Empty if there is none that can be seen without executing the filter.
QString pqProblem::problemOfInput() const
{
  if (this->Required)
  {
    vtkSMPropertyHelper chosen(this->Required);
    chosen.SetUseUnchecked(true);
    if (chosen.GetNumberOfElements() == 0 || !chosen.GetAsProxy())
    {
      return this->MissingText;
    }
  }
  vtkPVDataInformation* data = KnownData(this->proxy());
  if (!data || data->IsNull())
  {
    return {};
  }
  if (!this->AnyDataSet && IsNoSurface(data))
  {
    return tr("The input is not a surface but of the type %1. Take its outer surface first, or a "
              "surface inside of it with Contour.")
      .arg(data->GetPrettyDataTypeString());
  }
  if (data->GetNumberOfPoints() == 0)
  {
    return tr("The input is empty: it has no points. If it comes from a file, the reader found "
              "nothing in it that it knows: its format may be another one than its name says.");
  }
  if (!this->AnyDataSet && data->GetNumberOfCells() == 0)
  {
    return tr(
      "This is a point cloud: it has no faces, so there is no surface to work on. Make a surface "
      "of it first, for instance with Delaunay 3D and Extract Surface. An Alpha somewhat above the "
      "distance between points keeps hollows open; with 0 they are closed.");
  }
  return {};
}

void pqProblem::remedy()
{
  pqShownValue::apply(this, this->Remedy, 1.0);
}

void pqProblem::extractSurface()
{
  pqFilterInFront::insert(this, { "DataSetSurfaceFilter" }, tr("Extract Surface"));
}
