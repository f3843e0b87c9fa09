// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A short note in a panel: text that wraps and can be copied, in the colors of tool tips, which
/// are those that a desktop has for this; a serious one stands out.
#ifndef pqNote_h
#define pqNote_h

#include <QLabel>

class pqNote : public QLabel
{
  Q_OBJECT

public:
  explicit pqNote(QWidget* parent);

  void setSerious(bool serious);
};

#endif
