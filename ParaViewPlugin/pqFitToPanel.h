// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keeps the properties of a filter within what is seen of the panel. A decorator, in the XML of
/// one property of the filter, whichever is always shown:
///
///     <PropertyWidgetDecorator type="FitToPanel"/>
///
/// ParaView's panel puts the properties of the filter, of its display and of the view below each
/// other, all as wide as the widest of them. That is the color editor of the display, which is
/// wider than the panel of a new window: without this the numbers at the right are cut off.
/// Numbers that are too long for their line edits show fewer digits, until they are edited. Labels
/// get the tool tips of their properties, which ParaView gives to the widgets beside them only. The
/// mouse wheel changes a slider only after a click on it.
#ifndef pqFitToPanel_h
#define pqFitToPanel_h

#include "pqPropertyWidgetDecorator.h"

#include <QPointer>

class QScrollArea;

class pqFitToPanel : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqFitToPanel(vtkPVXMLElement* xml, pqPropertyWidget* widget);

  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void watchPanel();
  void fit();

  QPointer<QWidget> Properties; // all of the filter
  QPointer<QScrollArea> Panel;
};

#endif
