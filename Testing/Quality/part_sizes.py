#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Characters as Chibi with a head half as high as the body, through vtkPartSizesFilter.

The parts are those of the original. Measured from the points: the height of the head over that of what is neither head
nor hangs on it, and how many triangles face away from where they did before the head grew.

usage: PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Testing/Quality/part_sizes.py [--models FOLDER]
           [--output FOLDER --pictures] [MODEL ...]
"""
import sys
import types

try:
    import numpy as np
except ImportError:
    print("numpy is needed")
    sys.exit(77)  # what ctest takes for "skipped"
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import sphericalstyle
import surfaces

CHARACTERS = ("Data/creature", "Data/snowman", "spot", "human-parts", "armadillo", "koala", "bunny")
WANTED = 0.5  # height of the head over that of the body
OFF = 0.01  # of it
TURNED = 0.1  # percent of the triangles


def normals(x, F):
    return np.cross(x[F[:, 1]] - x[F[:, 0]], x[F[:, 2]] - x[F[:, 0]])


def main():
    chosen, paths = surfaces.chosen_models(__doc__, CHARACTERS)
    checks = surfaces.Checks()
    sheet = []
    print("| model | parts | size of the head | head to body | turned over, % |\n|---|---|---|---|---|")
    for name, path in paths.items():
        x, F = surfaces.read(path)
        surface = surfaces.polydata(x, F)
        ids = sphericalstyle.parts(surface)
        rounded = sphericalstyle.round(surface, preset="Chibi", refine_long_edges="Off", keep_on_ground=True)
        array = numpy_to_vtk(ids, deep=True)
        array.SetName("PartId")
        rounded.GetPointData().AddArray(array)
        sizes = sphericalstyle.vtkPartSizesFilter()
        surfaces.set_properties(sizes, {"HeadHeight": WANTED, "KeepOnGround": 1})
        sizes.SetInputData(rounded)
        sizes.Update()
        resized = sizes.GetOutput()
        table = sizes.GetOutputDataObject(1)
        size = vtk_to_numpy(table.GetColumnByName("Size"))
        scaled = np.flatnonzero(size != 1.0)  # the head, and what goes along
        before, after = surfaces.points(rounded), surfaces.points(resized)
        heights = {k: np.ptp(after[ids == k, 1]) for k in scaled}
        head = max(heights, key=heights.get)
        ratio = heights[head] / np.ptp(after[~np.isin(ids, scaled), 1])
        turned = 100.0 * np.mean(np.sum(normals(before, F) * normals(after, F), axis=1) < 0.0)
        print(f"| {name} | {len(size)} | {size[head]:.2f} | {ratio:.5f} | {turned:.3f} |")
        checks(abs(ratio / WANTED - 1.0) < OFF, f"{name}: head to body is {ratio:.4f}, not {WANTED}")
        checks(turned < TURNED, f"{name}: {turned:.2f} % of the triangles turned over")
        sheet.append((name, x, F, [types.SimpleNamespace(x=y, F=F, failed=False) for y in (before, after)]))
    if chosen.pictures:
        import pictures
        pictures.sheets(chosen.output, sheet, ["Chibi", "head to body 1 : 2"])
    checks.exit()


if __name__ == "__main__":
    main()
