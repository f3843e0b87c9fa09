# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A snowman's parts become round around centers of their own, at once and one after the other."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from ExampleTesting import count_shapes, data, output, pixels, points, rounded_points, run, run_well, surface

model = data / "snowman.vtp"
text = run_well("round_by_parts.py", model, "CenterId", "--output", output / "parts")
part = vtk_to_numpy(surface(model).GetPointData().GetArray("CenterId"))
assert f"{len(set(part))} parts" in text, text


def unevenness(shape, number):
    """Spread of the distances from the middle of a part, in parts of their mean: 0 on a sphere."""
    own = shape[part == number]
    distance = np.linalg.norm(own - own.mean(axis=0), axis=1)
    return distance.std() / distance.mean()


whole = rounded_points(model, Roundness=5.0, NormalBlend=0.0)
for way in ("at-once", "one-by-one"):
    rounded = points(output / f"parts-{way}.vtp")
    assert rounded.shape == points(model).shape, way
    for number in set(part):
        assert unevenness(rounded, number) < unevenness(whole, number), (way, number)
assert count_shapes(pixels(output / "parts.png")) == 4

done = run("round_by_parts.py", model, "Nothing", "--output", output / "none")
assert done.returncode != 0 and "no point array Nothing" in done.stdout, done.stdout
