// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqShownValue.h"

#include "pqAncestor.h"
#include "pqPropertiesPanel.h"
#include "pqPropertyWidget.h"
#include "vtkPVXMLElement.h"
#include "vtkSMEnumerationDomain.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxy.h"
#include "vtkSmartPointer.h"

#include <QRegularExpression>

namespace pqShownValue
{
double get(vtkSMProperty* property)
{
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(true);
  return helper.GetAsDouble();
}

void set(vtkSMProperty* property, double value)
{
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(true);
  helper.Set(value);
}

void apply(pqPropertyWidget* widget, vtkSMProperty* property, double value)
{
  set(property, value);
  Q_EMIT widget->changeAvailable();
  if (auto* panel = pqAncestor<pqPropertiesPanel>(widget))
  {
    panel->apply();
  }
}

double fromText(vtkSMProperty* property, const QString& text)
{
  auto* words = property->FindDomain<vtkSMEnumerationDomain>();
  for (unsigned int i = 0; words && i < words->GetNumberOfEntries(); ++i)
  {
    if (QString(words->GetEntryText(i)).remove(' ') == text)
    {
      return words->GetEntryValue(i);
    }
  }
  return text == "On" ? 1.0 : text.toDouble();
}

QString label(vtkSMProperty* property)
{
  vtkPVXMLElement* hints = property->GetHints();
  for (unsigned int i = 0; hints && i < hints->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* hint = hints->GetNestedElement(i);
    if (QString(hint->GetAttributeOrEmpty("type")) == "PanelLabel")
    {
      return hint->GetAttributeOrEmpty("text");
    }
  }
  return property->GetXMLLabel();
}

QString inWordsOfPanel(QString text, vtkSMProxy* filter)
{
  vtkSmartPointer<vtkSMPropertyIterator> property;
  property.TakeReference(filter->NewPropertyIterator());
  for (property->Begin(); !property->IsAtEnd(); property->Next())
  {
    // A name of one word may be an ordinary word, and has the same label mostly.
    const QString name = property->GetKey();
    if (words(name) != name)
    {
      text.replace(QRegularExpression("\\b" + name + "\\b"), label(property->GetProperty()));
    }
  }
  return text;
}

QString words(const QString& text)
{
  static const QRegularExpression border("(?<=[a-z])(?=[A-Z])");
  return QString(text).replace(border, " ");
}
}
