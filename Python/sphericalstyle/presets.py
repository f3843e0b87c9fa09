# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The presets: a few good ways to set vtkSphericalStyleFilter. Their values are in presets.json beside this file.

    from sphericalstyle import presets, vtkSphericalStyleFilter
    style = vtkSphericalStyleFilter()
    presets.apply(style, "Toy")

Needs no ParaView; in ParaView sphericalstyle.window.apply_preset does the same with the filter of the pipeline.
"""
import json
import os
from typing import NamedTuple


class Preset(NamedTuple):
    properties: dict  #: values by the names of properties; words are those of the class, such as "WholeModel"
    description: str  #: one line


def _read():
    """The table that ParaView's panel shows as well."""
    with open(os.path.join(os.path.dirname(__file__), "presets.json"), encoding="utf-8") as file:
        table = json.load(file)
    return {preset["name"]: Preset(table["common"] | preset["properties"], preset["description"])
            for preset in table["presets"]}


PRESETS = _read()


def name_of(text):
    """A name in any letters, as the table has it. @raise ValueError with the names that there are"""
    name = str(text).capitalize()
    if name not in PRESETS:
        raise ValueError(f"Spherical Style: there is no preset '{text}', only {', '.join(PRESETS)}")
    return name


def find(name):
    """The preset. @raise ValueError with the names that there are"""
    return PRESETS[name_of(name)]


def shown_by(style):
    """The name of the first preset that says what the filter is set to, or None."""
    for name, preset in PRESETS.items():
        other = style.NewInstance()
        apply(other, name)
        if all(getattr(style, "Get" + property_)() == getattr(other, "Get" + property_)()
               for property_ in preset.properties):
            return name
    return None


def apply(style, name):
    """Sets what the preset says. @param style  a vtkSphericalStyleFilter @param name  of PRESETS"""
    for property_, value in find(name).properties.items():
        if isinstance(value, str):
            getattr(style, f"Set{property_}To{value}")()
        else:
            getattr(style, f"Set{property_}")(value)
