// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqColors.h"

#include "vtkColorSeries.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMViewProxy.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{
constexpr double MostNames = 1000.0; // more are no names

vtkPVArrayInformation* ShownArray(vtkSMPVRepresentationProxy* display)
{
  const vtkSMPropertyHelper input(display, "Input");
  const vtkSMPropertyHelper array(display, "ColorArrayName");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  vtkPVDataInformation* data = source ? source->GetDataInformation(input.GetOutputPort()) : nullptr;
  return data && display->GetUsingScalarColoring()
    ? data->GetArrayInformation(
        array.GetInputArrayNameToProcess(), array.GetInputArrayAssociation())
    : nullptr;
}

/// Of the color map; nullptr where there is none.
vtkSMProxy* MapOf(vtkSMPVRepresentationProxy* display)
{
  return display->GetUsingScalarColoring()
    ? vtkSMPropertyHelper(display, "LookupTable").GetAsProxy()
    : nullptr;
}

/// Red, green and blue, from 0 to 1, one after the other.
std::vector<double> DistinctColors()
{
  std::vector<double> values;
  vtkNew<vtkColorSeries> series;
  for (const int scheme :
    { vtkColorSeries::BREWER_QUALITATIVE_SET1, vtkColorSeries::BREWER_QUALITATIVE_SET3 })
  {
    series->SetColorScheme(scheme);
    for (int k = 0; k < series->GetNumberOfColors(); ++k)
    {
      for (int c = 0; c < 3; ++c)
      {
        values.push_back(series->GetColor(k)[c] / 255.0);
      }
    }
  }
  return values;
}
}

namespace pqColors
{
Choice get(vtkSMPVRepresentationProxy* display, vtkSMViewProxy* view)
{
  if (!display->GetUsingScalarColoring())
  {
    return {};
  }
  const vtkSMPropertyHelper array(display, "ColorArrayName");
  return { array.GetInputArrayNameToProcess(), array.GetInputArrayAssociation(),
    display->IsScalarBarVisible(view) };
}

void set(vtkSMPVRepresentationProxy* display, vtkSMViewProxy* view, const Choice& choice)
{
  display->SetScalarColoring(
    choice.Array.isEmpty() ? nullptr : choice.Array.data(), choice.Association);
  if (!choice.Array.isEmpty())
  {
    display->SetScalarBarVisibility(view, choice.Legend);
  }
  vtkNew<vtkSMTransferFunctionManager>()->UpdateScalarBars(
    view, vtkSMTransferFunctionManager::HIDE_UNUSED_SCALAR_BARS);
}

void nameNone(vtkSMPVRepresentationProxy* display, vtkSMViewProxy* view, const QByteArray& text)
{
  vtkSMProxy* map = MapOf(display);
  vtkSMProxy* legend =
    map ? vtkNew<vtkSMTransferFunctionManager>()->GetScalarBarRepresentation(map, view) : nullptr;
  if (!legend)
  {
    return;
  }
  const double gray[3] = { 0.6, 0.6, 0.6 };
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", map);
    vtkSMPropertyHelper(map, "NanColor").Set(gray, 3);
    map->UpdateVTKObjects();
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", legend);
  vtkSMPropertyHelper(legend, "DrawNanAnnotation").Set(1);
  vtkSMPropertyHelper(legend, "NanAnnotation").Set(text.data());
  legend->UpdateVTKObjects();
}

std::pair<double, double> range(vtkSMPVRepresentationProxy* display)
{
  vtkSMProxy* map = MapOf(display);
  if (!map)
  {
    return {};
  }
  // Number, red, green, blue, one after the other.
  const std::vector<double> values = vtkSMPropertyHelper(map, "RGBPoints").GetDoubleArray();
  return values.size() < 8 ? std::pair(0.0, 0.0) : std::pair(values[0], values[values.size() - 4]);
}

/// The header of vtkSMTransferFunctionProxy, which does this and setLogarithmic as well, needs one
/// of jsoncpp that Debian's package of ParaView 6.1 neither has nor depends on.
void setRange(vtkSMPVRepresentationProxy* display, double low, double high)
{
  const auto [begin, end] = range(display);
  const bool isLog = isLogarithmic(display) && begin > 0.0 && low > 0.0;
  if (!(begin < end) || !(low < high))
  {
    return;
  }
  vtkSMProxy* map = MapOf(display);
  vtkSMPropertyHelper points(map, "RGBPoints");
  std::vector<double> values = points.GetDoubleArray();
  for (std::size_t k = 0; k < values.size(); k += 4)
  {
    const double share = isLog ? std::log(values[k] / begin) / std::log(end / begin)
                               : (values[k] - begin) / (end - begin);
    values[k] = isLog ? low * std::pow(high / low, share) : (1.0 - share) * low + share * high;
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", map);
  points.Set(values.data(), static_cast<unsigned int>(values.size()));
  map->UpdateVTKObjects();
}

bool isLocked(vtkSMPVRepresentationProxy* display)
{
  vtkSMProxy* map = MapOf(display);
  return map &&
    vtkSMPropertyHelper(map, "AutomaticRescaleRangeMode").GetAsInt() ==
    vtkSMTransferFunctionManager::NEVER;
}

void setLogarithmic(vtkSMPVRepresentationProxy* display)
{
  constexpr double Least = 1e-4; // of the largest number
  vtkSMProxy* map = MapOf(display);
  if (!map || isLogarithmic(display))
  {
    return;
  }
  vtkSMPropertyHelper points(map, "RGBPoints");
  const std::vector<double> values = points.GetDoubleArray();
  const auto [from, high] = range(display);
  if (!(high > 0.0) || !(from < high))
  {
    return;
  }
  const double low = std::max(from, Least * high);
  std::vector<double> reversed;
  for (std::size_t k = values.size() / 4; k-- > 0;)
  {
    const double* point = &values[4 * k];
    const double share = (high - point[0]) / (high - from);
    reversed.insert(
      reversed.end(), { low * std::pow(high / low, share), point[1], point[2], point[3] });
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", map);
  points.Set(reversed.data(), static_cast<unsigned int>(reversed.size()));
  vtkSMPropertyHelper(map, "UseLogScale").Set(1);
  map->UpdateVTKObjects();
}

bool isLogarithmic(vtkSMPVRepresentationProxy* display)
{
  vtkSMProxy* map = MapOf(display);
  return map && vtkSMPropertyHelper(map, "UseLogScale").GetAsInt() != 0;
}

void nameNumbers(vtkSMPVRepresentationProxy* display, bool begin)
{
  vtkSMProxy* map = MapOf(display);
  vtkPVArrayInformation* array = ShownArray(display);
  if (!map || !array)
  {
    return;
  }
  const double* range = array->GetComponentRange(0);
  const bool isNamed = vtkSMPropertyHelper(map, "IndexedLookup").GetAsInt() != 0;
  if (!(isNamed || begin) || !(range[0] <= range[1] && range[1] - range[0] < MostNames))
  {
    return;
  }
  // Numbers and texts, one after the other.
  const vtkSMPropertyHelper known(map, "Annotations");
  std::vector<std::string> names;
  for (unsigned int k = 0; isNamed && k < known.GetNumberOfElements(); ++k)
  {
    names.emplace_back(known.GetAsString(k));
  }
  const std::size_t count = names.size();
  const auto last = static_cast<long long>(range[1]);
  for (auto number = static_cast<long long>(range[0]); number <= last; ++number)
  {
    const std::string name = std::to_string(number);
    std::size_t k = 0;
    while (k < count && names[k] != name)
    {
      k += 2;
    }
    if (k >= count)
    {
      names.insert(names.end(), { name, name });
    }
  }
  if (isNamed && names.size() == count)
  {
    return;
  }
  // ParaView keeps one color for each name and no more: the old ones, and others for the new.
  const vtkSMPropertyHelper old(map, "IndexedColors");
  std::vector<double> colors;
  for (unsigned int k = 0; isNamed && k < old.GetNumberOfElements(); ++k)
  {
    colors.push_back(old.GetAsDouble(k));
  }
  const std::vector<double> distinct = DistinctColors();
  for (std::size_t k = colors.size(); k < 3 * (names.size() / 2); ++k)
  {
    colors.push_back(distinct[k % distinct.size()]);
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", map);
  vtkSMPropertyHelper(map, "IndexedLookup").Set(1);
  vtkSMPropertyHelper(map, "IndexedColors")
    .Set(colors.data(), static_cast<unsigned int>(colors.size()));
  vtkSMPropertyHelper annotations(map, "Annotations");
  annotations.SetNumberOfElements(static_cast<unsigned int>(names.size()));
  for (unsigned int k = 0; k < names.size(); ++k)
  {
    annotations.Set(k, names[k].c_str());
  }
  map->UpdateVTKObjects();
}

int countNames(vtkSMPVRepresentationProxy* display)
{
  vtkSMProxy* map = MapOf(display);
  return map && vtkSMPropertyHelper(map, "IndexedLookup").GetAsInt() != 0
    ? static_cast<int>(vtkSMPropertyHelper(map, "Annotations").GetNumberOfElements() / 2)
    : 0;
}

QColor ofName(vtkSMPVRepresentationProxy* display, double number)
{
  const int count = countNames(display);
  if (count == 0)
  {
    return {};
  }
  const vtkSMPropertyHelper names(MapOf(display), "Annotations");
  const vtkSMPropertyHelper colors(MapOf(display), "IndexedColors");
  const unsigned int different = colors.GetNumberOfElements() / 3;
  for (unsigned int k = 0; k < static_cast<unsigned int>(count) && different > 0; ++k)
  {
    if (QString(names.GetAsString(2 * k)).toDouble() == number)
    {
      const unsigned int at = 3 * (k % different);
      return QColor::fromRgbF(
        colors.GetAsDouble(at), colors.GetAsDouble(at + 1), colors.GetAsDouble(at + 2));
    }
  }
  return {};
}

bool areShown(vtkSMPVRepresentationProxy* display)
{
  vtkPVArrayInformation* shown = ShownArray(display);
  return shown && shown->GetDataType() == VTK_UNSIGNED_CHAR &&
    (shown->GetNumberOfComponents() == 3 || shown->GetNumberOfComponents() == 4);
}

bool areMapped(vtkSMPVRepresentationProxy* display)
{
  return vtkSMPropertyHelper(display, "MapScalars", true).GetAsInt() != 0;
}

void setMapped(vtkSMPVRepresentationProxy* display, bool mapped)
{
  if (display->GetProperty("MapScalars") && mapped != areMapped(display))
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", display);
    vtkSMPropertyHelper(display, "MapScalars").Set(mapped);
    display->UpdateVTKObjects();
  }
}
}
