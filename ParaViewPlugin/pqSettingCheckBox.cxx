// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqSettingCheckBox.h"

#include "pqApplicationCore.h"
#include "pqSettings.h"

#include <QApplication>

namespace
{
const QString Group = "SphericalStyle/";
}

pqSettingCheckBox::pqSettingCheckBox(
  const QString& name, const QString& label, bool checked, QWidget* parentWidget)
  : QCheckBox(label, parentWidget)
{
  this->setObjectName(name);
  this->setChecked(
    pqApplicationCore::instance()->settings()->value(Group + name, checked).toBool());
  QObject::connect(this, &QCheckBox::toggled, this, &pqSettingCheckBox::keep);
}

void pqSettingCheckBox::keep(bool checked)
{
  pqApplicationCore::instance()->settings()->setValue(Group + this->objectName(), checked);
  for (QWidget* widget : QApplication::allWidgets())
  {
    auto* other = qobject_cast<pqSettingCheckBox*>(widget);
    if (other && other->objectName() == this->objectName())
    {
      other->setChecked(checked);
    }
  }
}
