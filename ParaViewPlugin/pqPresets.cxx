// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPresets.h"

#include "pqShownValue.h"
#include "vtkCommand.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMProxy.h"

#include <QComboBox>
#include <QEvent>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QResource>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <QVariant>

#include <algorithm>
#include <set>

bool pqPresets::Preset::IsShown() const
{
  return std::all_of(this->Values.begin(), this->Values.end(),
    [](const auto& value)
    { return qFuzzyCompare(1.0 + pqShownValue::get(value.first), 1.0 + value.second); });
}

pqPresets::pqPresets(vtkSMProxy* smproxy, vtkSMPropertyGroup*, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget)
  , List(new QComboBox(this))
  , Description(new QLabel(this))
{
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->List);
  layout->addWidget(this->Description);
  this->List->setObjectName("List");
  this->setToolTip(tr("Sets the properties below to values that go well together."));
  this->List->setToolTip(this->toolTip());
  this->List->setFocusPolicy(Qt::StrongFocus);
  this->List->installEventFilter(this);
  this->Description->setObjectName("Description");
  this->Description->setWordWrap(true);

  this->readPresets();
  this->List->addItem(tr("Custom"));
  this->List->setItemData(
    this->List->count() - 1, tr("All other values of the properties below."), Qt::ToolTipRole);
  this->showChoice();
  QObject::connect(
    this->List, qOverload<int>(&QComboBox::currentIndexChanged), this, &pqPresets::choose);
}

bool pqPresets::isSingleRowItem() const
{
  return true;
}

/// The wheel scrolls the panel, also where the mouse happens to be above the list.
bool pqPresets::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Wheel && !this->List->hasFocus())
  {
    event->ignore();
    return true;
  }
  return this->pqPropertyWidget::eventFilter(watched, event);
}

void pqPresets::readPresets()
{
  const QByteArray text = QResource(":/SphericalStyle/presets.json").uncompressedData();
  const QJsonObject table = QJsonDocument::fromJson(text).object();
  std::set<vtkSMProperty*> observed;
  for (const QJsonValue entry : table["presets"].toArray())
  {
    Preset preset{ entry["description"].toString(), {} };
    QJsonObject values = table["common"].toObject();
    const QJsonObject own = entry["properties"].toObject();
    for (auto value = own.begin(); value != own.end(); ++value)
    {
      values[value.key()] = value.value();
    }
    for (auto value = values.constBegin(); value != values.constEnd(); ++value)
    {
      if (vtkSMProperty* property = this->proxy()->GetProperty(value.key().toUtf8()))
      {
        preset.Values.emplace_back(
          property, pqShownValue::fromText(property, value.value().toVariant().toString()));
        observed.insert(property);
      }
    }
    this->List->addItem(entry["name"].toString());
    this->List->setItemData(this->List->count() - 1, preset.Description, Qt::ToolTipRole);
    this->Presets.push_back(preset);
  }
  for (vtkSMProperty* property : observed)
  {
    for (const auto event :
      { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
    {
      this->Observers.add(property, event, this, &pqPresets::showChoice);
    }
  }
}

void pqPresets::choose(int row)
{
  if (row >= 0 && row < static_cast<int>(this->Presets.size()))
  {
    for (const auto& [property, value] : this->Presets[row].Values)
    {
      pqShownValue::set(property, value);
    }
    Q_EMIT this->changeAvailable();
  }
  this->showChoice(); // also where "Custom" was chosen, which sets nothing
}

void pqPresets::showChoice()
{
  const auto shown = std::find_if(this->Presets.begin(), this->Presets.end(),
    [](const Preset& preset) { return preset.IsShown(); });
  const QSignalBlocker blocker(this->List); // the values are there already
  this->List->setCurrentIndex(static_cast<int>(shown - this->Presets.begin()));
  this->Description->setText(
    shown != this->Presets.end() ? shown->Description : tr("Values of your own"));
}
