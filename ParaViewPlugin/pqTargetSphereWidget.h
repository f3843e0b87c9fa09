// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Says in the panel of a filter whether its center is inside of the model. Shows the target sphere
/// in the view while the filter is selected, where that is asked for, and any target while its
/// lengths are dragged. For an information property, and an output port "Target Sphere":
///
///     <PropertyGroup panel_widget="TargetSphere">
///       <Property function="CenterPosition" name="CenterPosition"/>
///     </PropertyGroup>
///
/// The sphere is the output of that name, drawn by a representation that belongs to this widget:
/// it is neither in the pipeline browser nor in saved states. A sphere that can be dragged takes
/// its place. A center or radius that becomes custom in the panel starts as it was until then, and
/// so does the handle. After each execution the information properties of the filter are asked for
/// again, which ParaView does before it executes only.
#ifndef pqTargetSphereWidget_h
#define pqTargetSphereWidget_h

#include "pqObservers.h"
#include "pqPropertyWidget.h"
#include "vtkSmartPointer.h"

#include <QTimer>

class QLabel;
class pqSettingCheckBox;
class vtkSMPropertyGroup;

class pqTargetSphereWidget : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(bool sphereVisible READ isSphereVisible) ///< for tests

public:
  pqTargetSphereWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);
  ~pqTargetSphereWidget() override;

  void select() override;
  void deselect() override;
  void setView(pqView* view) override;

  bool isSphereVisible() const;

private Q_SLOTS:
  void refresh();
  void updateSphere();

private:
  void updateStatement();
  bool hasResult() const;
  void startCustom(vtkObject* mode, unsigned long, void*);
  bool isSphereWanted() const;
  void makeSphere();
  void addToView(bool add);

  vtkSmartPointer<vtkSMProperty> CenterPosition;
  QLabel* Statement;
  pqSettingCheckBox* ShowSphere;
  QTimer Timer;
  pqObservers Observers;
  vtkSmartPointer<vtkSMProxy> Sphere;
};

#endif
