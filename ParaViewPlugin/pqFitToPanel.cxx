// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqFitToPanel.h"

#include "pqAncestor.h"
#include "pqDoubleLineEdit.h"
#include "pqDoubleRangeWidget.h"
#include "pqProxyWidget.h"

#include <QBoxLayout>
#include <QEvent>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QScrollArea>
#include <QSlider>
#include <QStyledItemDelegate>
#include <QTableView>

namespace
{
/// As many digits as there is room for, at most as many as ParaView's settings say. All of them
/// show while the number is edited.
void FitDigits(pqDoubleLineEdit* number)
{
  const int room = number->width() - 12; // its frame and margins
  const double value = number->text().toDouble();
  const auto width = [&](int digits)
  {
    return number->fontMetrics().horizontalAdvance(
      pqDoubleLineEdit::formatDouble(value, pqDoubleLineEdit::globalNotation(), digits));
  };
  int digits = pqDoubleLineEdit::globalPrecision();
  while (digits > 1 && width(digits) > room)
  {
    --digits;
  }
  number->setNotation(pqDoubleLineEdit::globalNotation());
  number->setPrecision(digits);
  number->setUseGlobalPrecisionAndNotation(digits == pqDoubleLineEdit::globalPrecision());
}

/// Numbers of a table with four digits. All of them show while a number is edited.
class ShortNumbers : public QStyledItemDelegate
{
public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QString displayText(const QVariant& value, const QLocale&) const override
  {
    bool isNumber = false;
    const double number = value.toDouble(&isNumber);
    return isNumber ? QString::number(number, 'g', 4) : value.toString();
  }
};

/// A label that is asked says what the widget beside it says.
void AddToolTips(const QWidget* properties)
{
  auto* grid = qobject_cast<QGridLayout*>(properties->layout());
  for (int row = 0; grid && row < grid->rowCount(); ++row)
  {
    QLayoutItem* left = grid->itemAtPosition(row, 0);
    QLayoutItem* right = grid->itemAtPosition(row, 1);
    auto* label = left ? qobject_cast<QLabel*>(left->widget()) : nullptr;
    if (label && right && right->widget() && label->toolTip().isEmpty())
    {
      label->setToolTip(right->widget()->toolTip());
    }
  }
}
}

pqFitToPanel::pqFitToPanel(vtkPVXMLElement* xml, pqPropertyWidget* widget)
  : pqPropertyWidgetDecorator(xml, widget)
{
  widget->installEventFilter(this); // the panel around it comes later
  for (auto* table : widget->findChildren<QTableView*>())
  {
    table->setItemDelegate(new ShortNumbers(table));
    table->viewport()->installEventFilter(this);
  }
}

bool pqFitToPanel::eventFilter(QObject* watched, QEvent* event)
{
  auto* table = watched->parent() ? qobject_cast<QTableView*>(watched->parent()) : nullptr;
  if (table && (event->type() == QEvent::Resize || event->type() == QEvent::Show))
  {
    // ParaView gives the columns widths of its own when it fills the table.
    table->horizontalHeader()->setStretchLastSection(false);
    table->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    return false;
  }
  auto* slider = qobject_cast<QSlider*>(watched);
  if (slider && event->type() == QEvent::Wheel && !slider->hasFocus())
  {
    event->ignore(); // left to what is around it
    return true;
  }
  if (watched == this->parentWidget() && event->type() == QEvent::Show)
  {
    this->watchPanel();
    this->fit();
  }
  else if (event->type() == QEvent::Resize)
  {
    auto* number = qobject_cast<pqDoubleLineEdit*>(watched);
    number ? FitDigits(number) : this->fit();
  }
  return false;
}

void pqFitToPanel::watchPanel()
{
  auto* panel = pqAncestor<QScrollArea>(this->parentWidget());
  auto* properties = pqAncestor<pqProxyWidget>(this->parentWidget());
  if (!panel || !panel->widget() || !properties || panel == this->Panel)
  {
    return;
  }
  this->Panel = panel;
  this->Properties = properties;
  AddToolTips(properties);
  panel->viewport()->installEventFilter(this);
  panel->widget()->installEventFilter(this);
  for (auto* range : properties->findChildren<pqDoubleRangeWidget*>())
  {
    if (auto* layout = qobject_cast<QBoxLayout*>(range->layout()))
    {
      layout->setStretch(0, 1); // half for the slider, which had a third
      layout->setStretch(1, 1);
    }
  }
  for (auto* slider : properties->findChildren<QSlider*>())
  {
    slider->setFocusPolicy(Qt::StrongFocus); // the wheel alone gives it none
    slider->installEventFilter(this);
  }
  for (auto* number : properties->findChildren<pqDoubleLineEdit*>())
  {
    number->installEventFilter(this);
    QObject::connect(number, &QLineEdit::textChanged, [number] { FitDigits(number); });
    FitDigits(number);
  }
}

void pqFitToPanel::fit()
{
  if (!this->Properties || !this->Panel)
  {
    return;
  }
  QLayout* layout = this->Properties->layout();
  QMargins margins = layout->contentsMargins();
  const int hidden = this->Panel->widget()->width() - this->Panel->viewport()->width();
  // Never so much that the properties themselves would make everything wider.
  const int spare = this->Properties->width() - (layout->minimumSize().width() - margins.right());
  margins.setRight(qMax(0, qMin(hidden, spare)));
  layout->setContentsMargins(margins);
}
