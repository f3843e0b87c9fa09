// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqNote.h"

pqNote::pqNote(QWidget* parentWidget)
  : QLabel(parentWidget)
{
  this->setObjectName("Text");
  this->setWordWrap(true);
  this->setTextInteractionFlags(Qt::TextSelectableByMouse);
  this->setFrameShape(QFrame::StyledPanel);
  this->setMargin(4);
  this->setAutoFillBackground(true);
  this->setBackgroundRole(QPalette::ToolTipBase);
  this->setForegroundRole(QPalette::ToolTipText);
}

void pqNote::setSerious(bool serious)
{
  this->setStyleSheet(serious ? "background: #b35900; color: white; border-radius: 4px;" : "");
}
