// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A check box in panels for something that holds for all of them: kept in ParaView's settings, and
/// the same wherever it is seen.
#ifndef pqSettingCheckBox_h
#define pqSettingCheckBox_h

#include <QCheckBox>

class pqSettingCheckBox : public QCheckBox
{
  Q_OBJECT

public:
  /// @param name  of the setting, and of the widget @param checked  at first
  pqSettingCheckBox(const QString& name, const QString& label, bool checked, QWidget* parent);

private:
  void keep(bool checked);
};

#endif
