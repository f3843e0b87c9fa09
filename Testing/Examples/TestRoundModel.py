# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One model, several times: the files have what the filter gives, the picture shows all of them."""
import numpy as np

from ExampleTesting import check_faults, count_shapes, data, output, pixels, points, rounded_points, run, run_well

model = data / "creature.vtp"
text = run_well("round_model.py", model, "--roundness", 0.5, 2, "--detail-size", 0.02, "--output", output / "r")
assert text.count("moved by up to") == 2, text
for roundness in (0.5, 2.0):
    expected = rounded_points(model, Roundness=roundness, DetailSize=0.02)
    assert np.array_equal(points(output / f"r-{roundness:g}.vtp"), expected), roundness
run_well("round_model.py", model, "--roundness", 1, "--output", output / "default")  # else as the filter
assert np.array_equal(points(output / "default-1.vtp"), rounded_points(model))
image = pixels(output / "r.png")
assert image.shape == (500, 1200, 3) and count_shapes(image) == 3, image.shape

done = run("round_model.py", output / "nowhere.ply")
assert done.returncode == 2 and "no such file" in done.stdout, done.stdout

check_faults("round_model.py", model)
