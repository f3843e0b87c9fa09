// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqNotice.h"

#include "vtkCommand.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"

#include <QLabel>
#include <QVBoxLayout>

pqNotice::pqNotice(vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget)
  , Text(smgroup->GetProperty("Text"))
  , Title(smgroup->GetXMLLabel())
  , Label(new QLabel(this))
{
  this->setShowLabel(false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Label);
  this->Label->setObjectName("Text");
  this->Label->setWordWrap(true);
  this->Label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  this->Label->setToolTip(pqPropertyWidget::getTooltip(this->Text));
  // The colors of tool tips are those that a desktop has for short notes.
  this->Label->setFrameShape(QFrame::StyledPanel);
  this->Label->setMargin(4);
  this->Label->setAutoFillBackground(true);
  this->Label->setBackgroundRole(QPalette::ToolTipBase);
  this->Label->setForegroundRole(QPalette::ToolTipText);
  this->Observer = this->Text->AddObserver(vtkCommand::ModifiedEvent, this, &pqNotice::updateText);
  this->updateText();
}

pqNotice::~pqNotice()
{
  this->Text->RemoveObserver(this->Observer);
}

void pqNotice::updateText()
{
  const QString text = vtkSMPropertyHelper(this->Text).GetAsString();
  this->Label->setText(QString("<b>%1:</b> %2").arg(this->Title, text.toHtmlEscaped()));
}
