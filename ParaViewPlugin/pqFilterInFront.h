// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Puts filters of ParaView between the filter of a panel and its input, executes them, and presses
/// Apply. One step of undo.
#ifndef pqFilterInFront_h
#define pqFilterInFront_h

#include <QStringList>

class pqPropertyWidget;

namespace pqFilterInFront
{
/// To be called by a queued connection: it makes another panel the active one for a moment.
/// @param filters  names of proxies with one input, the one next to the old input first
/// @param name  of the step of undo
/// @param switches  properties of the panel's filter that are turned on
void insert(pqPropertyWidget* widget, const QStringList& filters, const QString& name,
  const QStringList& switches = {});
}

#endif
