// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a filter has to say, as text in its panel that wraps and can be copied. For an information
/// property of one string:
///
///     <PropertyGroup label="Advice" panel_widget="Notice">
///       <Property function="Text" name="Advice"/>
///     </PropertyGroup>
///
/// A text "Property Value: reason" comes as the reason, with a button that sets the property in the
/// panel and presses Apply. "Input LoopSubdivision: reason" has one that puts the filter Loop
/// Subdivision in front. A group, since ParaView disables the widgets of information properties,
/// and text that is grayed out looks as if it did not apply.
#ifndef pqNotice_h
#define pqNotice_h

#include "pqObservers.h"
#include "pqPropertyWidget.h"
#include "vtkSmartPointer.h"

class QPushButton;
class pqNote;
class vtkSMPropertyGroup;

class pqNotice : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqNotice(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

private:
  void updateText();
  void follow();
  void subdivide();

  vtkSmartPointer<vtkSMProperty> Text;
  QString Title;
  pqNote* Note;
  QPushButton* Button;
  QPushButton* SubdivideButton;
  vtkSmartPointer<vtkSMProperty> Advised; // what the button sets, and to what
  double Value = 0.0;
  pqObservers Observers;
};

#endif
