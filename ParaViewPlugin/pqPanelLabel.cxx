// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPanelLabel.h"

#include "pqPropertyWidget.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"

#include <QEvent>
#include <QLabel>

pqPanelLabel::pqPanelLabel(vtkPVXMLElement* xml, pqPropertyWidget* widget)
  : pqPropertyWidgetDecorator(xml, widget)
  , Text(xml->GetAttributeOrEmpty("text"))
{
  widget->installEventFilter(this); // the panel makes the label after the widget
}

bool pqPanelLabel::eventFilter(QObject* watched, QEvent* event)
{
  pqPropertyWidget* widget = this->parentWidget();
  if (watched == widget && event->type() == QEvent::Show && widget->property() &&
    widget->parentWidget())
  {
    // A text in tags: "<p>Normal Blend</p>".
    const QString ofParaView = QString(">%1<").arg(widget->property()->GetXMLLabel());
    for (QLabel* label :
      widget->parentWidget()->findChildren<QLabel*>(QString(), Qt::FindDirectChildrenOnly))
    {
      label->setText(label->text().replace(ofParaView, QString(">%1<").arg(this->Text)));
    }
  }
  return false;
}
