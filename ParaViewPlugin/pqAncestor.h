// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a widget of a panel lies in: pqPropertiesPanel, pqProxyWidget, QScrollArea.
#ifndef pqAncestor_h
#define pqAncestor_h

#include <QWidget>

/// The nearest widget of a class around this one, or nullptr.
template <class T>
T* pqAncestor(const QWidget* widget)
{
  T* ancestor = nullptr;
  for (QWidget* around = widget->parentWidget(); around && !ancestor;
       around = around->parentWidget())
  {
    ancestor = qobject_cast<T*>(around);
  }
  return ancestor;
}

#endif
