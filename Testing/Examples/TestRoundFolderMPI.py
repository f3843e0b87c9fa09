# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A folder of models, shared out over processes of MPI: each model is rounded once, as it is alone, bad ones are told.

usage: TestRoundFolderMPI.py PVBATCH EXAMPLES DATA OUTPUT RUN_PARALLEL
"""
import csv
import pathlib
import shutil
import subprocess
import sys

import numpy as np

RUN_PARALLEL = sys.argv.pop()
from ExampleTesting import data, examples, output, points, python as pvbatch, rounded_points

PROCESSES = 4


def run(models, rounded, *symmetric):
    """Exit code and what was printed."""
    done = subprocess.run([sys.executable, RUN_PARALLEL, str(PROCESSES), pvbatch, *symmetric,
                           examples / "round_folder.py", models, rounded, "--roundness", "2"],
                          check=False, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=1200)
    if done.returncode == 77:
        print(done.stdout)
        sys.exit(77)
    return done.returncode, done.stdout


good = ["cube.vtp", "creature.vtp", "go-stone.vtp", "icosahedron.vtp", "snowman.vtp", "tetrahedron.vtp"]
bad = ["empty.ply", "noise.stl"]
models = output / "models"
models.mkdir()
for name in good:
    shutil.copy(data / name, models)
(models / "empty.ply").write_text("", encoding="utf-8")
(models / "noise.stl").write_text("solid nothing\nendsolid\n", encoding="utf-8")

code, text = run(models, output / "rounded", "--sym")
assert code == 1 and "6 of 8 models rounded" in text, (code, text)
with open(output / "rounded" / "summary.csv", newline="", encoding="utf-8") as file:
    lines = {line["model"]: line for line in csv.DictReader(file)}
assert list(lines) == sorted(good + bad), lines
for name in good:
    assert lines[name]["result"] == "rounded", lines[name]
    assert np.array_equal(points(output / "rounded" / f"{name}.vtp"), rounded_points(data / name, Roundness=2.0)), name
for name in bad:
    assert name in lines[name]["result"], lines[name]
for number in range(1, len(good + bad) + 1):
    assert text.count(f"[{number}/{len(good + bad)}] ") == 1, text

# Good ones only, and fewer than processes: exit code 0.
for name in bad + good[2:]:
    (models / name).unlink()
code, text = run(models, output / "few", "--sym")
assert code == 0 and "2 of 2 models rounded" in text, (code, text)

# Where only the first process would run it, it says so.
code, text = run(models, output / "alone")
assert code != 0 and "pvbatch --sym" in text and not (output / "alone").exists(), (code, text)
