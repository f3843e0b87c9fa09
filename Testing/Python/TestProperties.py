# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Every property of every class is printed. A value beyond the range of a property is replaced by the nearest one inside,
with a warning that names the property; NaN is an error when the algorithm runs. So nothing is replaced in silence.

usage: TestProperties.py FOLDER   (where writers write)
"""
import math
import pathlib
import re
import sys

from vtkmodules.vtkCommonExecutionModel import vtkPointSetAlgorithm, vtkPolyDataAlgorithm
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOCore import vtkWriter

from sphericalstyle import SphericalStyleFilters
from sphericalstyle.messages import Messages

folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
source = vtkSphereSource()
source.Update()

# What makes use of a property that is not used by default.
USES = {
    "BlendAtStart": lambda proxied: proxied.SetBlendFunctionToLinear(),
    "BlendAtEnd": lambda proxied: proxied.SetBlendFunctionToLinear(),
    "vtkHandleDeformFilter": lambda posed: posed.AddHandle([0, 0, 0.5, 0.1, 0, 0, 0.7, 0, 0, 0]),
}


def executed(algorithm):
    """The errors of a run."""
    messages = Messages(algorithm)
    algorithm.SetInputData(source.GetOutput())
    if hasattr(algorithm, "SetFileName"):
        algorithm.SetFileName(str(folder / "properties.glb"))
        algorithm.Write()
    else:
        algorithm.Update()
    return messages.errors


def can_be_made(kind):
    try:
        return kind() is not None
    except TypeError:  # abstract
        return False


kinds = [getattr(SphericalStyleFilters, name) for name in dir(SphericalStyleFilters) if name.startswith("vtk")]
PLURALS = {"Handle": "Handles", "PartSize": "PartSizes"}  # rows
count = 0
for kind in filter(can_be_made, kinds):
    algorithm = kind()
    printed = re.findall(r"^ *(\w+):", str(algorithm), re.MULTILINE)
    names = [name[3:] for name in dir(kind) if name.startswith("Get") and hasattr(kind, "Set" + name[3:])
             and not any(hasattr(base, name) for base in (vtkPolyDataAlgorithm, vtkPointSetAlgorithm, vtkWriter))]
    for name in names:
        assert PLURALS.get(name, name) in printed, (kind, name, str(algorithm))
    count += len(names)
assert count > 100, count
print(f"{count} properties printed")

count = 0
for kind in filter(can_be_made, kinds):
    names = [name[3:-8] for name in dir(kind) if name.startswith("Get") and name.endswith("MinValue")]
    for name in (name for name in names if hasattr(kind, "Set" + name)):
        algorithm = kind()
        get, put = getattr(algorithm, "Get" + name), getattr(algorithm, "Set" + name)
        low, high = (getattr(algorithm, f"Get{name}{end}Value")() for end in ("Min", "Max"))
        for bound, beyond in ((low, low - 1), (high, 2 * high + 1)):
            if isinstance(low, int) and not -2**31 <= beyond < 2**31:
                continue
            messages = Messages(algorithm)
            put(beyond)
            assert get() == bound, (kind, name, beyond, get())
            assert len(messages.warnings) == 1, (kind, name, beyond, messages.warnings)
            assert messages.warnings[0].startswith(f"{name} must be "), messages.warnings
            count += 1
        if isinstance(low, float):
            algorithm = kind()
            for use in (name, kind.__name__.rpartition(".")[2]):
                USES.get(use, lambda _: None)(algorithm)
            assert not executed(algorithm), (kind, name, "without NaN")
            getattr(algorithm, "Set" + name)(math.nan)
            errors = executed(algorithm)
            assert errors and name in errors[0], (kind, name, errors)
            count += 1
assert count > 100, count
print(f"{count} values refused")
