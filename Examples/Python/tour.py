# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A tour of sphericalstyle.round, in cells for Jupyter, Visual Studio Code and Spyder, or as a script.

    python3 tour.py [MODEL [FOLDER]]

It also runs in pvpython. Writes a picture for each cell to FOLDER (default: tour). Without MODEL it takes
creature.vtp. Without a display: xvfb-run -a.
"""
# %% A mesh of VTK. The other examples work with PyVista meshes, trimesh objects and arrays just as well.
import pathlib
import sys
import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import sphericalstyle as ss
from sphericalstyle.model_pictures import picture

arguments = [] if "ipykernel" in sys.modules else sys.argv[1:]  # those of Jupyter are not for us
if arguments[:1] in (["-h"], ["--help"]):
    print(__doc__)
    sys.exit()
# The creature is in a folder above this one: where the examples are installed, or in Data/ of a clone.
here = pathlib.Path(globals().get("__file__", "tour.py")).resolve()
creatures = [place / name for place in here.parents for name in ("creature.vtp", "Data/creature.vtp")]
creature = next((file for file in creatures if file.exists()), "Data/creature.vtp")
model = pathlib.Path(arguments[0] if arguments else creature)
folder = pathlib.Path(arguments[1] if len(arguments) > 1 else "tour")
folder.mkdir(parents=True, exist_ok=True)
mesh = ss.read(model)
points = vtk_to_numpy(mesh.GetPoints().GetData())


def show(name, **meshes):
    """Writes a picture of meshes side by side; keywords are the labels."""
    row = [(surface, label.replace("_", " ")) for label, surface in meshes.items()]
    picture(folder / f"{name}.png", (400 * len(row), 420), [row], "y", 25.0, 14, ground=True)
    print(folder / f"{name}.png")


# %% Without a word it makes a toy.
show("toy", model=mesh, toy=ss.round(mesh))

# %% The presets, and one of them with a property of its own.
show("presets", **{name: ss.round(mesh, preset=name) for name in ss.presets.PRESETS})
show("chibi", chibi=ss.round(mesh, preset="Chibi"), rounder=ss.round(mesh, preset="Chibi", roundness=2))

# %% Three properties make the shape.
show("roundness", **{f"roundness_{x:g}": ss.round(mesh, roundness=x) for x in (0.3, 1, 3)})
show("limbs", **{f"normal_blend_{x:g}": ss.round(mesh, normal_blend=x) for x in (0, 0.6, 1)})
show("details", **{f"detail_size_{x:g}": ss.round(mesh, detail_size=x, roundness=2) for x in (0, 0.02, 0.1)})

# %% Only a part: a mask of the points that may move.
height = points[:, 1]
upper = height > 0.5 * (height.min() + height.max())
show("part", model=mesh, upper_half=ss.round(mesh, region=upper, roundness=2))

# %% A property that changes over the model: an array with a value for each point.
share = np.interp(height, [height.min(), height.max()], [0.0, 1.0])
show("gradient", one_for_all=ss.round(mesh, roundness=2), more_above=ss.round(mesh, roundness=2, roundness_factor=share))

# %% Arrays in, arrays out. A box has coarse panels, so it is split first.
box = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 2.0) for z in (0.0, 1.0)])
quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
new_points, new_faces = ss.round((box, quads), preset="Pebble")
print(f"{len(box)} points and {len(quads)} faces became {len(new_points)} and {len(new_faces)}")

# %% What is wrong is said, and what is doubtful is a warning of Python.
for wrong in ({"roundnes": 2}, {"normal_blend": 7}, {"keep_size": "Mass"}):
    try:
        ss.round(mesh, **wrong)
    except (TypeError, ValueError) as error:
        print(error)
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    ss.round((box[:3], [[0, 0, 1]]))
print(caught[0].message)
