// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqNotice.h"

#include "pqFilterInFront.h"
#include "pqNote.h"
#include "pqShownValue.h"
#include "vtkCommand.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QPushButton>
#include <QRegularExpression>
#include <QVBoxLayout>

pqNotice::pqNotice(vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget)
  , Text(smgroup->GetProperty("Text"))
  , Title(smgroup->GetXMLLabel())
  , Note(new pqNote(this))
  , Button(new QPushButton(this))
  , SubdivideButton(new QPushButton(this))
{
  this->setShowLabel(false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Note);
  layout->addWidget(this->Button, 0, Qt::AlignLeft);
  layout->addWidget(this->SubdivideButton, 0, Qt::AlignLeft);
  this->Note->setToolTip(pqPropertyWidget::getTooltip(this->Text));
  this->Button->setObjectName("Follow");
  QObject::connect(this->Button, &QPushButton::clicked, this, &pqNotice::follow);
  this->SubdivideButton->setObjectName("Subdivide");
  this->SubdivideButton->setToolTip(
    tr("Makes four triangles of each, on a smooth surface. Undo takes it back."));
  QObject::connect(
    this->SubdivideButton, &QPushButton::clicked, this, &pqNotice::subdivide, Qt::QueuedConnection);
  this->Observers.add(this->Text, vtkCommand::ModifiedEvent, this, &pqNotice::updateText);
  this->updateText();
}

void pqNotice::updateText()
{
  static const QRegularExpression advice("^(\\w+) (\\S+): (.*)$");
  QString text = vtkSMPropertyHelper(this->Text).GetAsString();
  const QRegularExpressionMatch match = advice.match(text);
  const bool subdivides = match.captured(1) == "Input" && match.captured(2) == "LoopSubdivision";
  this->Advised = match.hasMatch() && !subdivides
    ? this->proxy()->GetProperty(match.captured(1).toUtf8())
    : nullptr;
  if (this->Advised || subdivides)
  {
    text = match.captured(3);
  }
  if (this->Advised)
  {
    this->Value = pqShownValue::fromText(this->Advised, match.captured(2));
    this->Button->setText(
      tr("Set %1 to %2")
        .arg(pqShownValue::label(this->Advised), pqShownValue::words(match.captured(2))));
    this->Button->setToolTip(tr("Follows the advice and applies it. Undo takes it back."));
  }
  if (subdivides)
  {
    vtkSMProxy* input = vtkSMPropertyHelper(this->proxy(), "Input").GetAsProxy();
    this->SubdivideButton->setText(input && QString(input->GetXMLName()) == "LoopSubdivisionFilter"
        ? tr("Put another Loop Subdivision in front")
        : tr("Put Loop Subdivision in front"));
  }
  this->Button->setVisible(this->Advised != nullptr);
  this->SubdivideButton->setVisible(subdivides);
  this->Note->setText(
    QString("<b>%1:</b> %2")
      .arg(this->Title, pqShownValue::inWordsOfPanel(text, this->proxy()).toHtmlEscaped()));
}

void pqNotice::follow()
{
  if (this->Advised)
  {
    pqShownValue::apply(this, this->Advised, this->Value);
  }
}

/// The filter takes triangles only. Who wants a smooth outline wants no facets.
void pqNotice::subdivide()
{
  pqFilterInFront::insert(this, { "TriangleFilter", "LoopSubdivisionFilter" },
    tr("Loop Subdivision"), { "GenerateNormals" });
}
