# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The upper part of a model changes, and the points below keep their bits."""
import numpy as np

from ExampleTesting import check_faults, count_shapes, data, output, pixels, points, run_well

model = data / "creature.vtp"
before = points(model)
for name, options in (("blend", []), ("offset", ["--offset"])):
    text = run_well("round_part.py", model, "--above", 0.6, "--output", output / name, *options)
    assert "proxy points" in text, text
    after = points(output / f"{name}.vtp")
    low, high = before[:, 1].min(), before[:, 1].max()
    above = before[:, 1] > low + 0.6 * (high - low)
    moved = np.any(after != before, axis=1)
    assert not np.any(moved & ~above), name
    assert np.mean(moved[above]) > 0.9, (name, np.mean(moved[above]))
    assert count_shapes(pixels(output / f"{name}.png")) == 2, name
assert not np.array_equal(points(output / "blend.vtp"), points(output / "offset.vtp"))

check_faults("round_part.py", model)
