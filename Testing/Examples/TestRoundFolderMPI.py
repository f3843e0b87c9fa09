# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A folder of models, shared out over processes of MPI: each model is rounded once, as it is alone, bad ones are told.
A process that is killed is told, and loses nothing.

usage: TestRoundFolderMPI.py PVBATCH EXAMPLES DATA OUTPUT RUN_PARALLEL
"""
import csv
import os
import pathlib
import shutil
import subprocess
import sys

import numpy as np

RUN_PARALLEL = sys.argv.pop()
from ExampleTesting import data, examples, output, points, python as pvbatch, rounded_points

PROCESSES = 4
DRIVER = pathlib.Path(__file__).parent / "drive_round_folder.py"


def run(models, rounded, *symmetric, script=(examples / "round_folder.py",), options=(), **environment):
    """Exit code and what was printed."""
    done = subprocess.run([sys.executable, RUN_PARALLEL, str(PROCESSES), pvbatch, *symmetric, *script, models, rounded,
                           "--roundness", "2", *options], env=os.environ | environment,
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



def check_complete(folder):
    """Each model has its result and its line, once; no file of the work is left."""
    with open(folder / "summary.csv", newline="", encoding="utf-8") as file:
        lines = [*csv.DictReader(file)]
    assert [line["model"] for line in lines] == sorted(good + bad), lines
    assert sorted(path.name for path in folder.iterdir()) == sorted([f"{name}.vtp" for name in good] + ["summary.csv"])
    for line in lines:
        name = line["model"]
        assert line["result"] == "rounded" if name in good else name in line["result"], line
    for name in good:
        assert np.array_equal(points(folder / f"{name}.vtp"), rounded_points(data / name, Roundness=2.0)), name


code, text = run(models, output / "rounded", "--sym")
assert code == 1 and "6 of 8 models rounded" in text, (code, text)
check_complete(output / "rounded")
for number in range(1, len(good + bad) + 1):
    assert text.count(f"[{number}/{len(good + bad)}] ") == 1, text

# Process 1 is killed with the largest model. With Open MPI the others may go on: one says so and takes its model. If
# they have to end, too, the next run continues. No model is done twice.
largest = max(good, key=lambda name: (models / name).stat().st_size)
for recovers in ("1", "0"):
    folder = output / f"recovers-{recovers}"
    _, text = run(models, folder, "--sym", script=(DRIVER, examples, "first", "mpi-1", "-"), options=("--limit", "5"),
                  OMPI_MCA_orte_enable_recovery=recovers)
    if "6 of 8 models rounded" in text:
        assert f"process 1 has shown no sign of life for 5 s. It was working on {largest}." in text, text
    else:
        assert not (folder / "summary.csv").exists(), text
        code, more = run(models, folder, "--sym")
        assert code == 1 and "6 of 8 models rounded" in more, (code, more)
        assert f"{largest}: process 1 was rounding it when it was interrupted." in more, more
        text += more
    for name in good + bad:
        assert text.count(f"] {name}: ") <= 1, (name, text)
    check_complete(folder)

# Good ones only, and fewer than processes: exit code 0.
for name in bad + good[2:]:
    (models / name).unlink()
code, text = run(models, output / "few", "--sym")
assert code == 0 and "2 of 2 models rounded" in text, (code, text)

# Where only the first process would run it, it says so.
code, text = run(models, output / "alone")
assert code != 0 and "pvbatch --sym" in text and not (output / "alone").exists(), (code, text)
