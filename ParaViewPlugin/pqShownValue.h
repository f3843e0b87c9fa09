// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Values of properties as the panel shows them: typed or chosen, but maybe not applied yet.
/// ParaView calls them unchecked. Whoever sets one in a widget emits changeAvailable() after it.
#ifndef pqShownValue_h
#define pqShownValue_h

#include <QString>

class pqPropertyWidget;
class vtkSMProperty;
class vtkSMProxy;

namespace pqShownValue
{
/// Of a property with one number.
double get(vtkSMProperty* property);
void set(vtkSMProperty* property, double value);

/// Sets one and presses Apply. What that executes may change the widget, so nothing comes after it.
void apply(pqPropertyWidget* widget, vtkSMProperty* property, double value);

/// A number, a word of the class ("OwnThickness", which the panel shows as "Own Thickness"), On or
/// Off.
double fromText(vtkSMProperty* property, const QString& text);

/// The words of the panel for a property and for such a text.
QString label(vtkSMProperty* property);
QString words(const QString& text);

/// A message in which properties of the filter have the names of the panel, not those of scripts.
QString inWordsOfPanel(QString text, vtkSMProxy* filter);
}

#endif
