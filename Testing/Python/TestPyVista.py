# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""PyVista's own meshes, where PyVista is installed; TestRound.py has a stand-in for it on every system.
usage: TestPyVista.py DATA_FOLDER PAGE..."""
import os
import re
import sys

try:
    import pyvista
except ImportError as missing:
    print(f"skipped: no PyVista here ({missing})")
    sys.exit(77)

import numpy as np
import sphericalstyle as ss

data = sys.argv[1]
creature = pyvista.read(os.path.join(data, "creature.vtp"))
creature["height"] = creature.points[:, 1].copy()
before = creature.copy()

# The result is PyVista's: its own points, the arrays of the input, and nothing done to the input.
result = ss.round(creature, preset="Toy", roundness=1.2)
assert type(result) is pyvista.PolyData and result.n_cells == creature.n_cells
expected, faces = ss.round((creature.points, creature.regular_faces), preset="Toy", roundness=1.2)
assert np.array_equal(result.points, expected) and np.array_equal(result.regular_faces, faces)
assert np.array_equal(result["height"], creature["height"]) and not np.array_equal(result.points, creature.points)
assert creature == before
assert np.array_equal(ss.round(creature, roundness=0).points, creature.points)

# Meshes that PyVista makes: with triangles, with quadrilaterals, with arrays by name.
sphere = pyvista.Sphere(radius=2.0, theta_resolution=40, phi_resolution=40)
radii = np.linalg.norm(ss.round(sphere, roundness=3.0, detail_size=0.0, normal_blend=0.0).points, axis=1)
assert np.ptp(radii) < 0.01 and abs(radii.mean() - 2.0) < 0.01
box = pyvista.Box(level=8)
box.clear_data()
for roundness in (0.5, 2.0):
    lengths = [np.linalg.norm(mesh.points - mesh.points.mean(axis=0), axis=1)
               for mesh in (box, ss.round(box.clean(), roundness=roundness, detail_size=0.0, normal_blend=0.0))]
    assert np.ptp(lengths[1]) / lengths[1].mean() < np.ptp(lengths[0]) / lengths[0].mean()
creature["kept"] = (creature.points[:, 1] < 0.6).astype(float)
part = ss.round(creature, region="kept")
still = creature["kept"] == 0
assert np.array_equal(part.points[still], creature.points[still]) and not np.array_equal(part.points, creature.points)

# Further functions keep the kind as well.
larger = ss.resize(creature, {0: 1.3})
assert type(larger) is pyvista.PolyData and larger.n_points == creature.n_points

# What is wrong is raised with the message of the filter.
flat = pyvista.PolyData(np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, np.nan]]), [3, 0, 1, 2])
for mesh, words in ((flat, "point 2 is not finite"), (pyvista.ImageData(dimensions=(3, 3, 3)), "not a surface")):
    try:
        ss.round(mesh)
        raise AssertionError(words)
    except ss.Error as error:
        assert words in str(error), error

# The accessor, where PyVista has accessors.
version = tuple(int(number) for number in re.findall(r"\d+", pyvista.__version__)[:2])
assert (version >= (0, 48)) == hasattr(pyvista, "register_dataset_accessor"), pyvista.__version__
if hasattr(pyvista, "register_dataset_accessor"):
    assert np.array_equal(creature.spherical_style.round(preset="Ball").points, ss.round(creature, preset="Ball").points)

# The examples of the pages that use PyVista.
os.chdir(os.path.dirname(os.path.abspath(data)))
tried = 0
for page in sys.argv[2:]:
    with open(page, encoding="utf-8") as file:
        for example in re.findall(r"^```python\n(.*?)^```", file.read(), re.MULTILINE | re.DOTALL):
            if "pyvista" in example:
                exec(compile(example, page, "exec"), {})
                tried += 1
assert tried > 0
print(f"PyVista {pyvista.__version__}: passed")
