// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A check box in panels for something that holds for all of them: on at first, kept in ParaView's
/// settings, and the same wherever it is seen.
#ifndef pqSettingCheckBox_h
#define pqSettingCheckBox_h

#include <QCheckBox>

class pqSettingCheckBox : public QCheckBox
{
  Q_OBJECT

public:
  /// @param name  of the setting, and of the widget
  pqSettingCheckBox(const QString& name, const QString& label, QWidget* parent);

private:
  void keep(bool checked);
};

#endif
