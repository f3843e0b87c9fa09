# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin's XML says what the C++ class does: every property, its default, range, entries.

The class is asked through its Python wrapping, so a new C++ property without XML fails here.

usage: TestSphericalStyleFilterXML.py SphericalStyleFilter.xml
"""
import re
import sys
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkCommonExecutionModel import vtkPolyDataAlgorithm

from sphericalstyle import vtkSphericalStyleFilter as Filter

VTK_INT_MAX = 2**31 - 1

# C++ enumeration of each property; the entries in the panel are its words.
ENUMERATIONS = {
    "CenterMode": ["Point Mean", "Area Centroid", "Custom"],
    "RadiusMode": ["Equal Area", "Equal Volume", "Custom"],
    "SphericalWeighting": ["Uniform", "Cotangent"],
    "ConcaveEdges": ["Keep", "Flip", "Zero"],
    "EdgeWeighting": ["Half Edge", "Full Edge"],
    "StopRule": ["Converged", "Thesis", "Fixed Iterations"],
    "Anchor": ["Centroid", "Last Point"],
    "InitialGuess": ["Blend", "Rest"],
    "OutputPointsPrecision": ["Single", "Double", "Default"],
}
# Not clamped in C++ (a bad value is an error that names it): range of the panel.
UNCLAMPED = {"Roundness": (0.0, 10.0), "Radius": (0.0, None)}
ARRAYS = ["NormalsArray", "RoundnessFactorArray", "NormalBlendArray", "TargetDirectionsArray"]

failures = []


def check(condition, message):
    if not condition:
        failures.append(message)


def methods(prefix, cls, base):
    """Names after the prefix of the methods that cls adds to base."""
    new = set(dir(cls)) - set(dir(base))
    return {m[len(prefix):] for m in new if m.startswith(prefix)}


def numbers(text):
    return [float(t) for t in text.split()]


def range_of(element):
    """(min, max) of the first range, boolean or enumeration domain; None where it is open."""
    for domain in element:
        if domain.tag in ("DoubleRangeDomain", "IntRangeDomain"):
            return tuple(
                float(domain.get(side)) if domain.get(side) else None for side in ("min", "max"))
        if domain.tag == "BooleanDomain":
            return (0.0, 1.0)
        if domain.tag == "EnumerationDomain":
            values = [float(entry.get("value")) for entry in domain]
            return (min(values), max(values))
    return (None, None)


def check_documentation(name, element):
    text = element.find("Documentation")
    check(text is not None and len((text.text or "").split()) > 1, f"{name}: no Documentation")


def check_settable(name, element):
    """Default and range of one XML property against those of a fresh C++ object."""
    check(element.get("command") == "Set" + name, f"{name}: command {element.get('command')}")
    check(element.get("label") is None, f"{name}: the label is to be made from the name")
    value = getattr(Filter(), "Get" + name)()
    value = list(value) if isinstance(value, tuple) else [value]
    xml_value = numbers(element.get("default_values"))
    check(xml_value == value, f"{name}: default {xml_value} in XML, {value} in C++")
    check(int(element.get("number_of_elements")) == len(value), f"{name}: number_of_elements")

    low, high = range_of(element)
    if name in UNCLAMPED:
        check((low, high) == UNCLAMPED[name], f"{name}: range {low} .. {high}")
    elif hasattr(Filter, f"Get{name}MinValue"):
        cxx_low = getattr(Filter(), f"Get{name}MinValue")()
        cxx_high = getattr(Filter(), f"Get{name}MaxValue")()
        cxx_high = None if cxx_high == VTK_INT_MAX else cxx_high
        check((low, high) == (cxx_low, cxx_high),
              f"{name}: range {low} .. {high} in XML, {cxx_low} .. {cxx_high} in C++")


def check_enumeration(name, element):
    """Entries in the order of C++, which has a setter SetNameToEntry for each but the precision."""
    entries = [(e.get("text"), int(e.get("value"))) for e in element.find("EnumerationDomain")]
    check(entries == [(text, i) for i, text in enumerate(ENUMERATIONS[name])],
          f"{name}: entries {entries}")
    setters = methods(f"Set{name}To", Filter, vtkPolyDataAlgorithm)
    if name != "OutputPointsPrecision":
        check(setters == {text.replace(" ", "") for text, _ in entries},
              f"{name}: C++ has {setters}, XML {entries}")
    for text, value in entries:
        setter = getattr(Filter, f"Set{name}To{text.replace(' ', '')}", None)
        if setter:
            filter_ = Filter()
            setter(filter_)
            check(getattr(filter_, "Get" + name)() == value, f"{name}: value of {text}")


def check_array(index, name, element):
    check(element.get("command") == "SetInputArrayToProcess", f"{name}: command")
    check(element.get("default_values") == f"{index};0;0;0;None", f"{name}: default_values")
    check(element.find("ArrayListDomain").get("none_string") == "None", f"{name}: none_string")


proxy = ElementTree.parse(sys.argv[1]).getroot().find("./ProxyGroup[@name='filters']/SourceProxy")
check(proxy.get("name") == "SphericalStyleFilter", "name of the proxy")
check(proxy.get("class") == Filter.__name__, "class of the proxy")
check(proxy.get("label") == "Spherical Style", "label of the proxy")

elements = {e.get("name"): e for e in proxy if re.search("Property$", e.tag)}
for name, element in elements.items():
    check_documentation(name, element)

getters = methods("Get", Filter, vtkPolyDataAlgorithm)
limits = {g for g in getters if re.search("M(in|ax)Value$", g)}
settable = {s for s in methods("Set", Filter, vtkPolyDataAlgorithm) if s in getters}
read_only = getters - settable - limits
information = {n for n, e in elements.items() if e.get("information_only") == "1"}

# Without these the comparisons below would hold of nothing.
check({"Roundness", "Center", "GenerateRotation"} <= settable, f"settable: {sorted(settable)}")
check(settable == set(elements) - information - set(ARRAYS) - {"Input"},
      "settable in C++ or in XML only: "
      f"{sorted(settable ^ (set(elements) - information - set(ARRAYS) - {'Input'}))}")
check(read_only == information,
      f"read-only in C++ or in XML only: {sorted(read_only ^ information)}")

for name in sorted(settable & set(elements)):
    check_settable(name, elements[name])
for name in ENUMERATIONS:
    check_enumeration(name, elements[name])
with_entries = {n for n, e in elements.items() if e.find("EnumerationDomain") is not None}
check(with_entries == set(ENUMERATIONS), f"enumerations: {sorted(with_entries)}")
for index, name in enumerate(ARRAYS):
    check_array(index, name, elements[name])
for name in information:
    check(elements[name].get("command") == "Get" + name, f"{name}: command")

# A group that names a property that is not there is dropped by ParaView without a word.
for group in proxy.findall("PropertyGroup"):
    for part in group.findall("Property"):
        check(part.get("name") in elements, f"group {group.get('label')}: {part.get('name')}")

for failure in failures:
    print(failure, file=sys.stderr)
sys.exit(1 if failures else 0)
