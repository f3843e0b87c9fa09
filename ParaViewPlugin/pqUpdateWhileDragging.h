// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The model follows a handle or slider of the panel while it is dragged, not only when it is let
/// go. A decorator: in the XML of any property or group whose widget has the signals
/// startInteraction(), interaction() and endInteraction(), as ParaView's interactive widgets have,
///
///     <PropertyWidgetDecorator type="UpdateWhileDragging"/>
///
/// An update is an Apply of the filter's own panel and a rendering of the view. It begins when the
/// mouse events so far are handled, so that updates never queue up behind the mouse. Until then the
/// handle itself does not render the view, which the update does anyway. Where an update took
/// longer than SlowUpdate the rest of the drag waits for the release. Undo takes back the whole
/// drag. While a trace is recorded there is one update, on release. Warnings come on release, those
/// of the last update, and not once for each: what is said of shapes in between is no use.
///
/// A filter with the property Preview, 0 or 1, has it set meanwhile, so that it may give less than
/// the full result, and quicker; the update of the release is full. It is to be internal: neither
/// undo nor states nor traces know of it.
///
/// Widgets in the view get a check box, on by default and kept in ParaView's settings; a slider
/// follows while Auto Apply is on. Before the first Apply, and where neither says so, all is as
/// without the decorator.
#ifndef pqUpdateWhileDragging_h
#define pqUpdateWhileDragging_h

#include "pqPropertyWidgetDecorator.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <QTimer>

class pqSettingCheckBox;
class vtkRenderWindowInteractor;

class pqUpdateWhileDragging : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqUpdateWhileDragging(vtkPVXMLElement* xml, pqPropertyWidget* widget);
  ~pqUpdateWhileDragging() override;

  static constexpr int SlowUpdate = 500; ///< milliseconds

private Q_SLOTS:
  void start();
  void follow();
  void finish();
  void updateOnTime();

private:
  class HeldMessages;

  void addCheckBox();
  bool isWanted() const;
  void watchRenderings();
  bool rendersSoon(vtkObject*, unsigned long, void*);
  void update();
  void setPreview(bool on);
  void close();

  pqSettingCheckBox* CheckBox = nullptr;
  QTimer Timer;
  bool Dragging = false; // and an undo set is open
  bool Released = false; // the next update is the last one
  bool Previews = false; // the next update does
  int SlowUpdates = 0;   // in a row
  vtkSmartPointer<HeldMessages> Messages;
  vtkWeakPointer<vtkRenderWindowInteractor> Interactor; // of the view, in a drag
  unsigned long RenderObserver = 0;
};

#endif
