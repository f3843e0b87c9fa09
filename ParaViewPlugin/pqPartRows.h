// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rows of a part and a value, as Part Sizes has them. A decorator, for a list with two numbers to
/// a row:
///
///     <DoubleVectorProperty name="PartSize" panel_widget="ScalarValueList" ...>
///       <Hints>
///         <PropertyWidgetDecorator type="PartRows" property="PartArray" array="PartId"/>
///
/// ParaView's button for a new row makes an empty one, which counts as part 0 with the value 0, or
/// a copy of the last one. Here it gets the first part that has no row, and the value 1. Beside its
/// number a part has the color that it has in the view, where the result or the model is colored by
/// parts. Both columns are equally wide.
///
/// The parts are those of the array that the property names, or else of the other one.
#ifndef pqPartRows_h
#define pqPartRows_h

#include "pqPropertyWidgetDecorator.h"

#include <QByteArray>
#include <QColor>
#include <QPointer>

class pqScalarValueListPropertyWidget;
class QTableView;

class pqPartRows : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqPartRows(vtkPVXMLElement* xml, pqPropertyWidget* widget);

  bool eventFilter(QObject* watched, QEvent* event) override;

  /// Not valid where nothing is colored by parts.
  QColor colorOf(double part) const;

private:
  void completeRow(int row);
  QByteArray array() const;
  double nextPart(const QVariantList& numbers) const;

  QByteArray Property;
  QByteArray Default;
  QPointer<pqScalarValueListPropertyWidget> List;
  QPointer<QTableView> Table;
};

#endif
