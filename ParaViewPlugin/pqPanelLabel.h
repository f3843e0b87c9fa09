// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Another label for a property in the panel, and nowhere else. A decorator, in the XML of the
/// property:
///
///     <PropertyWidgetDecorator type="PanelLabel" text="Limbs"/>
///
/// The attribute label of a property in XML would be its name in ParaView's Python as well, so that
/// scripts and traces would no longer say what the class says. The panel's search still takes the
/// name of the property.
#ifndef pqPanelLabel_h
#define pqPanelLabel_h

#include "pqPropertyWidgetDecorator.h"

class pqPanelLabel : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqPanelLabel(vtkPVXMLElement* xml, pqPropertyWidget* widget);

  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  QString Text;
};

#endif
