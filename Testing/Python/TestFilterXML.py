# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A filter's XML says what its C++ class does: every property, its default, range, entries, ports.

The class is asked through its Python wrapping, so a new C++ property without XML fails here.

usage: TestFilterXML.py NameOfTheFilter.xml
"""
import os
import re
import sys
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

import sphericalstyle
from FilterTable import FILTERS

VTK_INT_MAX = 2**31 - 1

# The one enumeration without a setter for each entry: it is VTK's.
PRECISIONS = ["Single", "Double", "Default"]

xml_name = os.path.splitext(os.path.basename(sys.argv[1]))[0]
Filter = getattr(sphericalstyle, "vtk" + xml_name)
# What it has (Controller) is for programs alone.
Whole = sphericalstyle.vtkWholeSurfaceAlgorithm
Base = Whole if issubclass(Filter, Whole) else Filter.__mro__[1]
expected = FILTERS[xml_name]
# Not clamped in C++ (a bad value is an error that names it): range of the panel.
UNBOUNDED = {name: tuple(ends) for name, ends in expected.get("unbounded", {}).items()}
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


def entries_of(element):
    return [(e.get("text"), int(e.get("value"))) for e in element.find("EnumerationDomain")]


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
    if name in UNBOUNDED:
        check((low, high) == UNBOUNDED[name], f"{name}: range {low} .. {high}")
    elif hasattr(Filter, f"Get{name}MinValue"):
        cxx_low = getattr(Filter(), f"Get{name}MinValue")()
        cxx_high = getattr(Filter(), f"Get{name}MaxValue")()
        cxx_high = None if cxx_high == VTK_INT_MAX else cxx_high
        check((low, high) == (cxx_low, cxx_high),
              f"{name}: range {low} .. {high} in XML, {cxx_low} .. {cxx_high} in C++")
    elif not isinstance(value[0], bool):
        check((low, high) == (None, None), f"{name}: range {low} .. {high}, none in C++")


def enumeration_of(name):
    """Words and values of an enumeration of C++, which has a setter SetNameToWords for each."""
    if name == "OutputPointsPrecision":
        return list(zip(PRECISIONS, range(len(PRECISIONS))))
    values = []
    for words in methods(f"Set{name}To", Filter, Base):
        filter_ = Filter()
        getattr(filter_, f"Set{name}To{words}")()
        value = getattr(filter_, "Get" + name)()
        values.append((re.sub("(?<=[a-z])(?=[A-Z])", " ", words), value))
    return sorted(values, key=lambda entry: entry[1])


def check_rows(name, element):
    """Rows of numbers, such as the number of a part and its size: AddName(number, value)."""
    check(element.get("command") == "Add" + name, f"{name}: command {element.get('command')}")
    check(hasattr(Filter, "Add" + name), f"{name}: nothing adds a row")
    plural = name + ("es" if name.endswith("s") else "s")
    check(element.get("clean_command") == "RemoveAll" + plural, f"{name}: clean_command")
    check(hasattr(Filter, "RemoveAll" + plural), f"{name}: nothing removes all")
    labels = element.findall("Hints/ShowComponentLabels/ComponentLabel")
    check([label.get("component") for label in labels] == [str(k) for k in range(len(labels))], f"{name}: labels")
    check(element.get("number_of_elements_per_command") == str(len(labels)) != "0", f"{name}: values of a row")


def check_array(index, name, element):
    check(element.get("command") == "SetInputArrayToProcess", f"{name}: command")
    check(element.get("default_values") == f"{index};0;0;0;None", f"{name}: default_values")
    check(element.find("ArrayListDomain").get("none_string") == "None", f"{name}: none_string")


def check_input(port, name, element):
    check(element.get("command") == "SetInputConnection", f"{name}: command")
    check(int(element.get("port_index", "0")) == port, f"{name}: port_index")
    optional = Filter().GetInputPortInformation(port).Has(vtkAlgorithm.INPUT_IS_OPTIONAL())
    hint = element.find("Hints/Optional") is not None
    check(hint == bool(optional), f"{name}: Optional in XML {hint}, in C++ {optional}")
    # Without it an input that was set cannot be taken away.
    check((element.get("null_on_empty") == "1") == hint, f"{name}: null_on_empty")


def check_decorator(name, decorator):
    """One that names what is not there hides the property for good, without a word."""
    if decorator.get("type") in ("AlwaysInFront", "FitToPanel", "PanelLabel", "SmoothShading", "UpdateWhileDragging"):
        return  # of no other property
    if decorator.get("type") == "UpOfView" and "property" not in decorator.attrib:
        return  # where the panel opens
    if decorator.get("type") == "CompositeDecorator":
        return  # those in it are looked at one by one
    master = elements.get(decorator.get("property"))
    check(master is not None, f"{name}: decorator of {decorator.get('property')}")
    if master is not None and master.find("EnumerationDomain") is not None:
        values = {str(value) for _, value in entries_of(master)}
        named = (decorator.get("value") or decorator.get("values")).split()
        check(set(named) <= values, f"{name}: decorator for values {named}")


proxy = ElementTree.parse(sys.argv[1]).getroot().find("./ProxyGroup[@name='filters']/SourceProxy")
check(proxy.find("Documentation").get("short_help").startswith(proxy.get("label") + ": "),
      "the toolbar shows the short help alone, so it begins with the name")
check(proxy.get("name") == xml_name, "name of the proxy")
check(proxy.get("class") == Filter.__name__, "class of the proxy")
check(proxy.get("label") == expected["label"], "label of the proxy")

elements = {e.get("name"): e for e in proxy if re.search("Property$", e.tag)}
for name, element in elements.items():
    check_documentation(name, element)

getters = methods("Get", Filter, Base)
limits = {g for g in getters if re.search("M(in|ax)Value$", g)}
settable = {s for s in methods("Set", Filter, Base) if s in getters}
read_only = getters - settable - limits
information = {n for n, e in elements.items() if e.get("information_only") == "1"}
internal = {n for n, e in elements.items() if e.get("is_internal") == "1"}  # in no panel, state or trace
others = set(expected["arrays"]) | set(expected["inputs"])

check(set(expected["known"]) <= settable, f"settable: {sorted(settable)}")
in_xml = set(elements) - information - others
# A panel that can still be read; what only a study needs is in vtkThesisStyleFilter.
if xml_name == "SphericalStyleFilter":
    check(len(settable - internal) <= 33, f"{len(settable)} properties: {sorted(settable)}")
check(settable == in_xml, f"settable in C++ or in XML only: {sorted(settable ^ in_xml)}")
check(read_only == information,
      f"read-only in C++ or in XML only: {sorted(read_only ^ information)}")

for name in internal:
    check(elements[name].get("panel_visibility") == "never", f"{name}: in the panel")
rows = {n for n, e in elements.items() if e.get("repeat_command") == "1"}
for name in sorted(settable & set(elements)):
    (check_rows if name in rows else check_settable)(name, elements[name])
enumerations = {name: enumeration_of(name) for name in settable}
enumerations = {name: entries for name, entries in enumerations.items() if entries}
check(set(expected["enumerations"]) <= set(enumerations), "enumerations of C++")
for name, entries in sorted((n, e) for n, e in enumerations.items() if n in elements):
    check(entries_of(elements[name]) == entries,
          f"{name}: entries {entries_of(elements[name])} in XML, {entries} in C++")
with_entries = {n for n, e in elements.items() if e.find("EnumerationDomain") is not None}
check(with_entries == set(enumerations), f"enumerations: {sorted(with_entries)}")
for index, name in enumerate(expected["arrays"]):
    check_array(index, name, elements[name])
for name in information:
    check(elements[name].get("command") == "Get" + name, f"{name}: command")

# ------------------------------------------------------------------------------------------- ports
inputs = [n for n, e in elements.items() if e.tag == "InputProperty"]
check(set(inputs) == set(expected["inputs"]), f"inputs {inputs}")
check(len(inputs) == Filter().GetNumberOfInputPorts(), f"number of inputs: {len(inputs)}")
for port, name in enumerate(expected["inputs"]):
    check_input(port, name, elements[name])
outputs = [(int(e.get("index")), e.get("name")) for e in proxy.findall("OutputPort")]
check(outputs == list(enumerate(expected["outputs"])), f"outputs {outputs}")
check(len(outputs) == Filter().GetNumberOfOutputPorts(), f"number of outputs: {len(outputs)}")
# Only the first output is shown by Apply.
views = {(int(v.get("port")), v.get("type")) for v in proxy.findall("Hints/View")}
check(views == {(port, "None") for port, _ in outputs[1:]}, f"views {views}")

# ------------------------------------------------------------------------------------------- panel
# A group that names a property that is not there is dropped by ParaView without a word.
for group in proxy.findall("PropertyGroup"):
    for part in group.findall("Property"):
        check(part.get("name") in elements, f"group {group.get('label')}: {part.get('name')}")
for owner in list(elements.values()) + proxy.findall("PropertyGroup"):
    if owner.get("panel_widget", "").startswith("Interactive"):
        check(owner.find("Hints/PropertyWidgetDecorator[@type='UpdateWhileDragging']") is not None,
              f"{owner.get('label')}: the model does not follow the handle")
    if owner.get("panel_widget") == "InteractiveHandle":
        check(owner.find("Hints/PropertyWidgetDecorator[@type='AlwaysInFront']") is not None,
              f"{owner.get('label')}: the model hides the handle")
    for decorator in owner.findall("Hints//PropertyWidgetDecorator"):
        check_decorator(owner.get("name") or owner.get("label"), decorator)
fitted = [e for e in elements.values() if e.find("Hints/PropertyWidgetDecorator[@type='FitToPanel']") is not None]
check(len(fitted) == 1, f"FitToPanel at {len(fitted)} properties")
for element in fitted:
    check(element.get("panel_visibility") != "advanced" and not element.findall(".//*[@mode='visibility']"),
          f"{element.get('name')}: FitToPanel at a property that is not always shown")

for failure in failures:
    print(failure, file=sys.stderr)
sys.exit(1 if failures else 0)
