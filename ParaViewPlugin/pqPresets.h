// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A list of the presets in Filters/presets.json, for the panel of a filter with their properties:
///
///     <PropertyGroup label="Preset" panel_widget="Presets">
///       <Property name="NumberOfIterations"/>
///     </PropertyGroup>
///
/// The property is only there because a group without one has no place in the panel. It must not be
/// one that a preset sets, since ParaView gives that no widget of its own then.
///
/// Choosing a preset changes the values in the panel, and Apply or Auto Apply takes them over, as
/// if they had been typed: one step of undo, and one of the trace. "Custom" stands for all other
/// values.
#ifndef pqPresets_h
#define pqPresets_h

#include "pqObservers.h"
#include "pqPropertyWidget.h"
#include "vtkSmartPointer.h"

#include <utility>
#include <vector>

class QComboBox;
class QLabel;
class vtkSMPropertyGroup;

class pqPresets : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqPresets(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

  bool isSingleRowItem() const override; // with a label as the numbers below have
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  struct Preset
  {
    QString Description;
    std::vector<std::pair<vtkSmartPointer<vtkSMProperty>, double>> Values;

    bool IsShown() const;
  };

  void readPresets();
  void choose(int row);
  void showChoice();

  std::vector<Preset> Presets; // as the rows of the list; the last row is "Custom"
  QComboBox* List;
  QLabel* Description;
  pqObservers Observers;
};

#endif
