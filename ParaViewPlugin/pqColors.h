// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the display of a surface is colored by, and how: by the numbers of an array, through a
/// color map and with a legend, or by an array of colors as they are.
#ifndef pqColors_h
#define pqColors_h

#include <QByteArray>
#include <QColor>

#include <utility>

class vtkSMPVRepresentationProxy;
class vtkSMViewProxy;

namespace pqColors
{
struct Choice
{
  QByteArray Array; // empty: one color everywhere
  int Association = 0;
  bool Legend = false;
};

Choice get(vtkSMPVRepresentationProxy* display, vtkSMViewProxy* view);
void set(vtkSMPVRepresentationProxy* display, vtkSMViewProxy* view, const Choice& choice);

/// Gray, with a text in the legend, where the numbers are none (NaN). With quantities only.
void nameNone(vtkSMPVRepresentationProxy* display, vtkSMViewProxy* view, const QByteArray& text);

/// The numbers of the first and the last color, with quantities only; else 0 and 0.
std::pair<double, double> range(vtkSMPVRepresentationProxy* display);
/// Stretches or shrinks the color map to these, also where the user has locked it. With quantities
/// only.
void setRange(vtkSMPVRepresentationProxy* display, double low, double high);
/// Whether the user has chosen that new numbers do not change the range ("Never").
bool isLocked(vtkSMPVRepresentationProxy* display);

/// A logarithmic color map, for lengths from far below to far above what matters. Where there are
/// numbers of 0 or less, the smallest ones get the last color. The colors are reversed, so that red
/// is what is thin. With quantities only.
void setLogarithmic(vtkSMPVRepresentationProxy* display);
bool isLogarithmic(vtkSMPVRepresentationProxy* display);

/// Whole numbers that name things, such as parts: each gets a color that differs from the others.
/// @param begin  also where the color map is one for quantities; else only new numbers get colors
void nameNumbers(vtkSMPVRepresentationProxy* display, bool begin);
/// 0 where the color map is one for quantities.
int countNames(vtkSMPVRepresentationProxy* display);
/// Not valid where the number has none.
QColor ofName(vtkSMPVRepresentationProxy* display, double number);

/// Whether the array that is shown has colors: bytes, three or four to a point or cell.
bool areShown(vtkSMPVRepresentationProxy* display);

/// Whether its numbers go through a color map. If not, the array must have colors.
bool areMapped(vtkSMPVRepresentationProxy* display);
void setMapped(vtkSMPVRepresentationProxy* display, bool mapped);
}

#endif
