# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Blender shows the filter's results: it imports a file with a slider as shape keys and an action, and renders them.
Leaves with 77 (skipped) without Blender.

usage: TestSliderInBlender.py DATA_FOLDER [FOLDER_FOR_PICTURES]
"""
import os
import shutil
import sys
import tempfile
import warnings

import numpy as np

import GLTFFiles
import SliderViewers
import SurfaceTesting
import sphericalstyle as ss
from SurfaceTesting import points

if not shutil.which("blender"):
    print("no Blender: skipped")
    sys.exit(77)
warnings.simplefilter("ignore", ss.StyleWarning)  # of thin parts
creature = SurfaceTesting.read(sys.argv[1], "creature.vtp")
output = sys.argv[2] if len(sys.argv) > 2 else None
ROUNDNESS = (0, 0.3, 1, 3, 4.9)
SECONDS = (0.2, 1, 1.8)  # of 2
low, high = (end(points(creature), axis=0) for end in (np.min, np.max))
center, half = (low + high) / 2, 0.65 * max((high - low)[:2])
file = os.path.join(tempfile.mkdtemp(), "slider.glb")
for name, keywords, properties in (("line", dict(detail_size=0, keep_size="Off"), dict(detail_size=0, keep_size="Off")),
                                   ("Toy", dict(preset="Toy", tolerance=0.01), dict(preset="Toy"))):
    slider = ss.write_slider(file, creature, roundness=1, **keywords)
    mesh = GLTFFiles.load(file)[0]["meshes"][0]
    places = mesh["extras"]["sphericalStyle"].get("places", [1])

    def weights_at(roundness):
        return GLTFFiles.chain(places, 3 ** 0.5 * roundness / (1 + 3 ** 0.5 * roundness))

    seen = SliderViewers.in_blender(file, [weights_at(roundness) for roundness in ROUNDNESS],
                                    [] if slider.linear else SECONDS, center, half)
    assert seen["names"] == ["Basis", *mesh["extras"]["targetNames"]], seen["names"]
    if slider.linear:  # the action of several shows where the timeline is instead
        assert np.allclose(seen["opened"], weights_at(1), atol=1e-6), seen["opened"]
    assert len(seen["actions"]) == (0 if slider.linear else 1), seen["actions"]
    for seconds, weights in zip(SECONDS, seen["played"]):
        assert np.allclose(weights, GLTFFiles.chain(places, seconds / 2 * places[-1]), atol=1e-4), (seconds, weights)
    worst, off = 0, 0
    for k, roundness in enumerate(ROUNDNESS):
        result = points(ss.round(creature, roundness=roundness, **properties))
        worst = max(worst, np.linalg.norm(seen["points"][k] - result, axis=1).max() / np.linalg.norm(high - low))
        border = SliderViewers.silhouette_of(seen["points"][k], center, half)
        off = max(off, np.abs(SliderViewers.silhouette(seen["pictures"][k]) - border).max())
    print(f"Blender {seen['version']}, {name}, {slider.targets} shape keys, {len(ROUNDNESS)} values of Roundness: points at"
          f" most {worst:.1e} of the diagonal from the filter's, the border of the picture {off:.1f} pixels of"
          f" {SliderViewers.SIZE}")
    assert worst < (1e-6 if slider.linear else 0.01), worst
    assert off < 2, off
    if output:
        os.makedirs(output, exist_ok=True)
        SliderViewers.sheet(seen["pictures"], os.path.join(output, f"blender-{name}.png"), len(ROUNDNESS))
