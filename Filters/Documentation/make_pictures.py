# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Make the pictures of this folder's pages, in pictures/.

    PYTHONPATH=BUILD/lib/python3/dist-packages pvpython make_pictures.py
"""
import pathlib
import sys

from PIL import Image

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "Utilities"))

import demo  # noqa: E402, the demo's pictures look the same
from sphericalstyle import vtkSphericalStyleFilter  # noqa: E402


def rounded(surface, **properties):
    style = vtkSphericalStyleFilter()
    style.SetInputData(surface)
    for name, value in properties.items():
        getattr(style, f"Set{name}")(value)
    style.Update()
    return style.GetOutput()


def picture(name, size, panels, view, points):
    file = HERE / "pictures" / name
    demo.picture(file, size, panels, "y", view, points)
    Image.open(file).convert("RGB").quantize(128).save(file, optimize=True)  # a third of the size


creature = demo.read(ROOT / "Data" / "creature.vtp")
cube = demo.read(ROOT / "Data" / "cube.vtp")

picture("before-after.png", (1000, 560), [[
    (creature, "before"),
    (rounded(creature, Roundness=0.5, DetailSize=0.03), "after: Roundness 0.5, DetailSize 0.03"),
]], 25.0, 17)

picture("series.png", (1200, 560), [[
    (rounded(creature, Roundness=roundness, DetailSize=size),
     f"Roundness {roundness:g}, DetailSize {size:g}")
    for roundness in (0.0, 0.1, 0.5, 2.0, 5.0)] for size in (0.0, 0.03)], 25.0, 12)

picture("normal-blend.png", (1000, 330), [[(creature, "model")] + [
    (rounded(creature, Roundness=0.1, NormalBlend=blend), f"NormalBlend {blend:g}")
    for blend in (0.0, 0.5, 1.0)]], 25.0, 13)

top = cube.GetBounds()[3]
center = [0.5 * (cube.GetBounds()[2 * i] + cube.GetBounds()[2 * i + 1]) for i in range(3)]


def around(height):
    return rounded(cube, Roundness=1.0, CenterMode=vtkSphericalStyleFilter.CUSTOM_CENTER,
                   Center=(center[0], top + height, center[2]))


picture("center.png", (1000, 330), [[
    (cube, "model"),
    (rounded(cube, Roundness=1.0), "center: Point Mean"),
    (around(-0.15), "0.15 below the top"),
    (around(0.15), "0.15 above the top"),
]], 25.0, 13)
