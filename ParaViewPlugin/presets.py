# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The presets: a few good ways to set vtkSphericalStyleFilter. The only place that knows their values.

    from sphericalstyle import presets, vtkSphericalStyleFilter
    style = vtkSphericalStyleFilter()
    presets.apply(style, "Toy")

Needs no ParaView; in ParaView sphericalstyle.window.apply_preset does the same with the filter of the pipeline.
"""
from typing import NamedTuple


class Preset(NamedTuple):
    properties: dict  #: values by the names of properties; words are those of the class, such as "WholeModel"
    description: str  #: one line


def _preset(description, roundness, normal_blend, detail_size, **more):
    """What is not named here is as in the filter's defaults, whatever was set before."""
    properties = dict(Roundness=roundness, NormalBlend=normal_blend, DetailSize=detail_size,
                      NormalRadius="OwnThickness", SphericalWeighting="Cotangent", EdgeWeighting="HalfEdge",
                      StopRule="Converged", ReproduceThesis=0)
    assert set(more) <= set(properties), more
    return Preset(properties | more, description)


#: Center, radius, size, region and the rest of the method stay as they are.
PRESETS = {  # ------------------------------------- Roundness, NormalBlend, DetailSize
    "Soft": _preset("Edges and limbs a little rounder", 0.5, 0.6, 0.06),
    "Toy": _preset("Round body, round limbs, details kept", 1.0, 0.6, 0.06),
    "Chibi": _preset("Every limb short and round by its own thickness", 1.0, 1.0, 0.08),
    "Puffy": _preset("Fat limbs, as if blown up", 0.1, 1.0, 0.03, NormalRadius="WholeModel"),
    "Chubby": _preset("A round belly on short limbs", 2.0, 0.3, 0.05),
    "Ball": _preset("Nearly a ball that wears the details", 5.0, 0.0, 0.03),
    "Pebble": _preset("Smooth and round, details flattened", 2.0, 0.0, 0.0),
}


def find(name):
    """The preset. @raise ValueError with the names that there are"""
    if name not in PRESETS:
        raise ValueError(f"Spherical Style: there is no preset '{name}', only {', '.join(PRESETS)}")
    return PRESETS[name]


def apply(style, name):
    """Sets what the preset says. @param style  a vtkSphericalStyleFilter @param name  of PRESETS"""
    for property_, value in find(name).properties.items():
        if isinstance(value, str):
            getattr(style, f"Set{property_}To{value}")()
        else:
            getattr(style, f"Set{property_}")(value)
