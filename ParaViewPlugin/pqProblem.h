// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Says in the panel of a filter for surfaces what is wrong: with its input, before Apply, with the
/// way out as a button where there is one; and with its last execution, of which ParaView tells in
/// its window of messages. That has the message too, but opens only for an error, and only where
/// the panel is not seen.
///
///     <PropertyGroup label="" panel_widget="Problem">
///       <Property name="FinalEnergy"/>
///     </PropertyGroup>
///
/// For a filter of all kinds of data, and of a second input that has to be there, the group has
///
///       <Hints>
///         <AnyDataSet/>
///         <Required property="Surface" text="what to say where it is not"/>
///       </Hints>
///
/// A property that a message names can be the way out. Its button sets it to 1 and presses Apply:
///
///       <Hints>
///         <Remedy property="CloseHoles"/>
///       </Hints>
///
/// The property is there for its place in the panel, see pqPresets.h. In XML the input of the
/// filter has to accept every vtkDataSet: otherwise ParaView does not even open the panel, and does
/// not say why.
#ifndef pqProblem_h
#define pqProblem_h

#include "pqObservers.h"
#include "pqPropertyWidget.h"
#include "vtkSmartPointer.h"

#include <QPointer>

#include <vector>

class QPushButton;
class pqNote;
class vtkSMPropertyGroup;

class pqProblem : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqProblem(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

  void select() override;
  void apply() override;
  bool eventFilter(QObject* messageDock, QEvent* event) override;

  /// The messages so far are of an execution that has ended, also where they came after it.
  void end();

private:
  class Visibility;

  void watchInput();
  void hear(vtkObject* window, unsigned long event, void* text);
  void hearPipeline(vtkObject* executive, unsigned long event, void* text);
  void begin();
  void updateLater();
  void updateText();
  QString problemOfInput() const;
  void extractSurface();
  void remedy();

  bool AnyDataSet = false;
  vtkSmartPointer<vtkSMProperty> Required;
  QString MissingText;
  pqNote* Note;
  QPushButton* Button;
  QPushButton* RemedyButton;
  vtkSmartPointer<vtkSMProperty> Remedy;
  Visibility* Shown;
  struct Message
  {
    QString Text;
    bool IsError;
  };
  std::vector<Message> Messages; // of the last execution, and of values set since
  QPointer<QWidget> MessageDock;
  bool Opened = false; // MessageDock, for the message of the moment
  std::size_t Old = 0; // those of the last execution: the next one begins without them
  QMetaObject::Connection InputUpdated;
  pqObservers Observers;
};

#endif
