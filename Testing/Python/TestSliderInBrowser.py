# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A real browser shows the filter's results: files with a slider in three.js, moved by the function of the page about
glTF and by the animation; and a web page with a slider. Leaves with 77 (skipped) without Chromium or three.js.

usage: TestSliderInBrowser.py DATA_FOLDER GLTF.md [FOLDER_FOR_PICTURES]
$SPHERICALSTYLE_NODE_MODULES is the folder node_modules that "npm install three" makes.
"""
import os
import sys
import tempfile
import warnings

import numpy as np

import GLTFFiles
import SliderViewers
import SurfaceTesting
import sphericalstyle as ss
from SurfaceTesting import points

modules = SliderViewers.find_three()
if not modules:
    print("no Chromium or no three.js: skipped")
    sys.exit(77)
warnings.simplefilter("ignore", ss.StyleWarning)  # of thin parts
creature = SurfaceTesting.read(sys.argv[1], "creature.vtp")
function = SliderViewers.function_of(sys.argv[2])
output = sys.argv[3] if len(sys.argv) > 3 else None
folder = tempfile.mkdtemp()
ROUNDNESS = (0, 0.05, 0.1, 0.3, 0.5, 1, 1.5, 2, 3, 4.9)
PLAYED = (0.1, 0.5, 0.9)
KINDS = {"line": dict(detail_size=0, keep_size="Off"), "Toy": dict(preset="Toy", tolerance=0.003), "Ball": dict(preset="Ball")}


def largest(P, Q):
    return np.linalg.norm(P - Q, axis=1).max() / np.linalg.norm(np.ptp(points(creature), axis=0))


def show(name, pictures):
    if output:
        os.makedirs(output, exist_ok=True)
        SliderViewers.sheet(pictures, os.path.join(output, name + ".png"), 5)


# ----------------------------------------------------------------------------------------------------------- three.js
files = [os.path.join(folder, name + ".glb") for name in KINDS]
sliders = [ss.write_slider(file, creature, roundness=1, **keywords) for file, keywords in zip(files, KINDS.values())]
for (name, keywords), file, slider, seen in zip(
        KINDS.items(), files, sliders, SliderViewers.in_three(modules, files, ROUNDNESS, function, PLAYED)):
    properties = {key: value for key, value in keywords.items() if key != "tolerance"}
    worst, off = 0, 0
    for roundness, shown in zip(ROUNDNESS, seen["shown"]):
        result = points(ss.round(creature, roundness=roundness, **properties))
        worst = max(worst, largest(shown["points"], result))
        border = SliderViewers.silhouette_of(shown["points"], seen["center"], seen["half"])
        off = max(off, np.abs(SliderViewers.silhouette(shown["picture"]) - border).max())
    print(f"three.js, {name}, {slider.targets} targets, {len(ROUNDNESS)} values of Roundness: points at most {worst:.1e} of"
          f" the diagonal from the filter's, the border of the picture {off:.1f} pixels of {SliderViewers.SIZE}")
    assert worst < (1e-6 if slider.linear else keywords.get("tolerance", 0.001)), worst
    assert off < 2, off
    pictures = [shown["picture"] for shown in seen["shown"]]
    assert len(set(pictures)) == len(pictures), "the picture should follow the slider"
    show("three-" + name, pictures)
    assert np.allclose(seen["opened"], seen["shown"][ROUNDNESS.index(1)]["weights"], atol=1e-6), seen["opened"]
    assert len(seen["played"]) == (0 if slider.linear else len(PLAYED))
    for share, weights in zip(PLAYED, seen["played"]):
        places = GLTFFiles.load(file)[0]["meshes"][0]["extras"]["sphericalStyle"]["places"]
        assert np.allclose(weights, GLTFFiles.chain(places, share * places[-1]), atol=1e-4), (share, weights)

# ----------------------------------------------------------------------------------------------------------- the page
ss.write_page(os.path.join(folder, "page.html"), creature)
seen, asked = SliderViewers.page_in_browser(os.path.join(folder, "page.html"))
assert not asked, "the page should ask for nothing"
assert {shown["preset"] for shown in seen} == set(ss.presets.PRESETS)
worst = 0
for shown in seen:
    result = ss.round(creature, preset=shown["preset"], roundness=float(shown["told"])) if shown["place"] else creature
    worst = max(worst, largest(shown["points"], points(result)))
    share = SliderViewers.drawn(shown["picture"])
    assert 0.02 < share < 0.6, (shown["preset"], shown["place"], share)
print(f"web page, {len(seen)} places of its slider: points at most {worst:.1e} of the diagonal from the filter's")
assert worst < 0.006, worst  # tolerance, 16 bits, and the two digits of Roundness on the page
show("page", [shown["picture"] for shown in seen])
