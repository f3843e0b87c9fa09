# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Every cell of the tour runs, and its pictures have as many shapes as it shows."""
from ExampleTesting import count_shapes, data, output, pixels, run_well
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
