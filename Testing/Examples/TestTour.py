# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Every cell of the tour runs, and its pictures have as many shapes as it shows. The first one finds the creature in
Jupyter, whose arguments are not those of the tour: in a clone, and where the examples are installed."""
import os
import shutil
import sys
import types

from ExampleTesting import count_shapes, data, examples, output, pixels, run_well
from sphericalstyle import presets

text = run_well("tour.py", data / "creature.vtp", output / "tour")
assert "did you mean 'roundness'?" in text and "8 points and 6 faces became" in text, text
assert "no triangle with an area" in text.splitlines()[-1], text
shapes = {"toy": 2, "presets": len(presets.PRESETS), "chibi": 2, "roundness": 3, "limbs": 3, "details": 3, "part": 2,
          "gradient": 2}
assert {file.stem for file in (output / "tour").iterdir()} == set(shapes)
for name, count in shapes.items():
    image = pixels(output / "tour" / f"{name}.png")
    assert image.shape == (420, 400 * count, 3), (name, image.shape)
    assert count_shapes(image[40:]) == count, name  # above the labels

first_cell = "#" + (examples / "tour.py").read_text(encoding="utf-8").split("\n# %%")[1]
sys.modules["ipykernel"] = types.ModuleType("ipykernel")
sys.argv = ["ipykernel_launcher.py", "-f", "kernel.json"]
for place, model in (("clone/Examples/Python", "clone/Data"), ("installed/Python", "installed")):
    (output / place).mkdir(parents=True)
    (output / model).mkdir(exist_ok=True)
    shutil.copy(data / "creature.vtp", output / model)
    os.chdir(output / place)
    names = {}
    exec(first_cell, names)
    assert names["model"].samefile(output / model / "creature.vtp"), names["model"]
    assert names["mesh"].GetNumberOfPoints() > 0 and os.listdir() == ["tour"], os.listdir()
