// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Handles in the view that can be dragged, any number of them, for numbers that have a widget of
/// their own in the panel. Base of widgets of groups. The handles are there while the filter is
/// selected, the widget is shown and the filter was applied once; nothing hides them.
///
/// The first three signals are those that pqUpdateWhileDragging follows. ParaView enables keys of
/// the widget, which other widgets may have too, with the last one.
#ifndef pqViewHandles_h
#define pqViewHandles_h

#include "pqObservers.h"
#include "pqPropertyWidget.h"
#include "vtkSmartPointer.h"

#include <QColor>
#include <QTimer>

#include <array>
#include <memory>
#include <vector>

class vtkSMNewWidgetRepresentationProxy;

class pqViewHandles : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(int shownHandles READ shownHandles) ///< for tests

public:
  using Place = std::array<double, 3>;

  /// @param numbers  the handles follow them @param hint  what the panel says of them
  pqViewHandles(vtkSMProxy* proxy, vtkSMProperty* numbers, const QString& hint, QWidget* parent);
  ~pqViewHandles() override;

  void select() override;
  void deselect() override;
  void setView(pqView* view) override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

  int shownHandles() const;
  bool isDragged() const { return this->Dragged != nullptr; }

Q_SIGNALS:
  void startInteraction();
  void interaction();
  void endInteraction();
  void widgetVisibilityUpdated(bool visible);

protected:
  vtkSMProperty* numbers() const { return this->Numbers; }
  /// As the panel shows them. @{
  std::vector<double> shownNumbers() const;
  void showNumbers(const std::vector<double>& values);
  /// @}
  void refreshSoon();

  virtual std::vector<Place> places() const = 0;
  virtual QColor color(std::size_t handle) const;
  virtual void dragBegins() {}
  virtual void handleMoved(int handle, const Place& to) = 0;

private:
  class Handle;

  bool isInUse() const;
  void updateVisibility();
  void refresh();
  void dragged(Handle* handle, unsigned long event);

  vtkSmartPointer<vtkSMProperty> Numbers;
  pqObservers Observers;
  QTimer Timer;
  std::vector<std::unique_ptr<Handle>> Handles;
  Handle* Dragged = nullptr;
};

#endif
