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
/// A group, since ParaView disables the widgets of information properties, and text that is grayed
/// out looks as if it did not apply.
#ifndef pqNotice_h
#define pqNotice_h

#include "pqPropertyWidget.h"
#include "vtkSmartPointer.h"

class QLabel;
class vtkSMPropertyGroup;

class pqNotice : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqNotice(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);
  ~pqNotice() override;

private:
  void updateText();

  vtkSmartPointer<vtkSMProperty> Text;
  unsigned long Observer;
  QString Title;
  QLabel* Label;
};

#endif
