# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The sheet has a panel for each pair of values, and the panels show what the values do."""
import shutil

import numpy as np

from ExampleTesting import data, output, pixels, run, run_badly, run_well

WIDTH, HEIGHT, LABEL = 320, 300, 40  # of a panel, and of the label at its foot

sheet = output / "sheet.png"
text = run_well("sweep.py", data / "creature.vtp", "--roundness", 0, 0.5, 5, "--normal-blend", 0, 1,
                "--detail-size", 0, "--output", sheet)
assert text.count("Roundness") == 6, text
image = pixels(sheet)
assert image.shape == (2 * HEIGHT, 3 * WIDTH, 3), image.shape


def panel(row, column):
    """True where the model is seen; rows from above."""
    bottom = (1 - row) * HEIGHT
    part = image[bottom + LABEL:bottom + HEIGHT, column * WIDTH:(column + 1) * WIDTH]
    return np.any(part < 250, axis=2)


def roundness(seen):
    """Of the outline: 1 for a disk, less for all else."""
    y, x = np.nonzero(seen)
    far = np.hypot(x - x.mean(), y - y.mean()).max()
    return seen.sum() / (np.pi * far**2)


assert np.array_equal(panel(0, 0), panel(1, 0))  # without roundness the blend does nothing
values = [[roundness(panel(row, column)) for column in range(3)] for row in range(2)]
for row in values:
    assert 0.3 < row[0] < row[1] < row[2] <= 1.01, values
assert values[0][2] > 0.85 and values[1][2] > 0.8, values
assert values[0][2] > values[1][2], values  # one ball is rounder than round limbs
assert not np.array_equal(panel(0, 1), panel(1, 1))

done = run("sweep.py", output / "nowhere.ply")
assert done.returncode == 1 and "no such file" in done.stdout, done.stdout
done = run("sweep.py", data / "cube.vtp", "--roundness", 1, "--output", output / "no" / "folder.png")
assert done.returncode == 1 and "cannot be written" in done.stdout, done.stdout

# Nothing but a picture is replaced, and no label says what was not done.
model = output / "model.vtp"
shutil.copy(data / "cube.vtp", model)
assert ".png" in run_badly("sweep.py", model, "--output", model)
assert model.read_bytes() == (data / "cube.vtp").read_bytes()
assert "normal_blend must be 0 to 1; it is 3" in run_badly("sweep.py", model, "--normal-blend", 3, "--output", output / "much.png")
