// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPartRows.h"

#include "pqColors.h"
#include "pqPropertyWidget.h"
#include "pqScalarValueListPropertyWidget.h"
#include "pqSourceOf.h"
#include "pqView.h"
#include "vtkDataObject.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

#include <QAbstractItemModel>
#include <QEvent>
#include <QHeaderView>
#include <QIntValidator>
#include <QLineEdit>
#include <QStyledItemDelegate>
#include <QTableView>

#include <algorithm>
#include <set>

namespace
{
/// A number and its color.
class PartDelegate : public QStyledItemDelegate
{
public:
  PartDelegate(const pqPartRows* rows, QObject* owner)
    : QStyledItemDelegate(owner)
    , Rows(rows)
  {
  }

  QWidget* createEditor(
    QWidget* parent, const QStyleOptionViewItem&, const QModelIndex&) const override
  {
    auto* editor = new QLineEdit(parent);
    editor->setValidator(new QIntValidator(editor));
    return editor;
  }

protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override
  {
    this->QStyledItemDelegate::initStyleOption(option, index);
    const QColor color = this->Rows->colorOf(index.data().toDouble());
    if (color.isValid())
    {
      const int size = option->fontMetrics.height();
      QPixmap square(size, size);
      square.fill(color);
      option->icon = QIcon(square);
      option->icon.addPixmap(square, QIcon::Selected); // as it is
      option->decorationSize = square.size();
      option->features |= QStyleOptionViewItem::HasDecoration;
    }
  }

private:
  const pqPartRows* Rows;
};

vtkSMSourceProxy* InputOf(vtkSMProxy* proxy, int& port)
{
  const vtkSMPropertyHelper input(proxy, "Input");
  port = static_cast<int>(input.GetOutputPort());
  return vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
}
}

pqPartRows::pqPartRows(vtkPVXMLElement* xml, pqPropertyWidget* widget)
  : pqPropertyWidgetDecorator(xml, widget)
  , Property(xml->GetAttributeOrEmpty("property"))
  , Default(xml->GetAttributeOrEmpty("array"))
  , List(qobject_cast<pqScalarValueListPropertyWidget*>(widget)) // or in it
  , Table(widget->findChild<QTableView*>())
{
  if (!this->List)
  {
    this->List = widget->findChild<pqScalarValueListPropertyWidget*>();
  }
  if (!this->List || !this->Table)
  {
    return;
  }
  // Not while ParaView still adds the row.
  QObject::connect(
    this->Table->model(), &QAbstractItemModel::rowsInserted, this,
    [this](const QModelIndex&, int row) { this->completeRow(row); }, Qt::QueuedConnection);
  this->Table->verticalHeader()->hide(); // numbers of rows beside those of parts
  this->Table->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  this->Table->viewport()->installEventFilter(this);
  this->Table->setItemDelegateForColumn(0, new PartDelegate(this, this));
}

/// ParaView gives the columns widths of its own when it fills the table.
bool pqPartRows::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Resize || event->type() == QEvent::Show)
  {
    QHeaderView* header = this->Table->horizontalHeader();
    header->setStretchLastSection(false);
    header->setSectionResizeMode(QHeaderView::Stretch);
  }
  return this->pqPropertyWidgetDecorator::eventFilter(watched, event);
}

/// A new row, if it is as ParaView makes it: empty, or a copy of the one before.
void pqPartRows::completeRow(int row)
{
  QVariantList numbers = this->List ? this->List->scalars() : QVariantList();
  const int at = 2 * row;
  if (at + 1 >= static_cast<int>(numbers.size()))
  {
    return;
  }
  const bool isEmpty = numbers[at].toString().isEmpty() && numbers[at + 1].toString().isEmpty();
  if (!isEmpty && (at < 2 || numbers.mid(at, 2) != numbers.mid(at - 2, 2)))
  {
    return;
  }
  numbers[at] = this->nextPart(numbers.mid(0, at) + numbers.mid(at + 2));
  numbers[at + 1] = 1.0;
  this->List->setScalars(numbers);
  this->Table->setCurrentIndex(this->Table->model()->index(row, 1));
}

QByteArray pqPartRows::array() const
{
  const vtkSMPropertyHelper chosen(
    this->parentWidget()->proxy(), this->Property.data(), /*quiet=*/true);
  const QByteArray name = chosen.GetNumberOfElements() > 4 ? chosen.GetAsString(4) : "";
  return name.isEmpty() || name == "None" ? this->Default : name;
}

/// @param numbers  of the other rows
double pqPartRows::nextPart(const QVariantList& numbers) const
{
  int port = 0;
  vtkSMSourceProxy* input = InputOf(this->parentWidget()->proxy(), port);
  vtkPVDataInformation* data = input ? input->GetDataInformation(port) : nullptr;
  vtkPVArrayInformation* array =
    data ? data->GetArrayInformation(this->array().data(), vtkDataObject::POINT) : nullptr;
  auto* result = vtkSMSourceProxy::SafeDownCast(this->parentWidget()->proxy());
  if (!array && result && pqExecutedSourceOf(result)) // found by the filter
  {
    array = result->GetDataInformation(0)->GetArrayInformation(
      this->array().data(), vtkDataObject::POINT);
  }
  std::set<double> taken;
  for (int k = 0; k < numbers.size(); k += 2)
  {
    taken.insert(numbers[k].toDouble());
  }
  double part = array ? std::max(array->GetComponentRange(0)[0], 0.0) : 0.0;
  while (taken.count(part) > 0)
  {
    part += 1.0;
  }
  return part;
}

QColor pqPartRows::colorOf(double part) const
{
  const pqPropertyWidget* widget = this->parentWidget();
  vtkSMViewProxy* view = widget->view() ? widget->view()->getViewProxy() : nullptr;
  int port = 0;
  vtkSMSourceProxy* input = InputOf(widget->proxy(), port);
  if (!view)
  {
    return {};
  }
  for (vtkSMProxy* shown :
    { view->FindRepresentation(vtkSMSourceProxy::SafeDownCast(widget->proxy()), 0),
      input ? view->FindRepresentation(input, port) : nullptr })
  {
    auto* display = vtkSMPVRepresentationProxy::SafeDownCast(shown);
    QColor color = display && pqColors::get(display, view).Array == this->array()
      ? pqColors::ofName(display, part)
      : QColor();
    if (color.isValid())
    {
      return color;
    }
  }
  return {};
}
