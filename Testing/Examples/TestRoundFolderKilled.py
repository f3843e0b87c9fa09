# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A folder of models, interrupted by a kill at any place and continued: nothing is lost, nothing is done twice. A
process that is lost is told, and another takes what it had."""
import csv
import os
import pathlib
import shutil
import signal
import subprocess

import numpy as np

from ExampleTesting import data, examples, output, points, python, rounded_points

DRIVER = pathlib.Path(__file__).parent / "drive_round_folder.py"
models = output / "models"
models.mkdir()
for name in ("creature.vtp", "cube.vtp", "go-stone.vtp"):
    shutil.copy(data / name, models)
(models / "empty.ply").write_text("", encoding="utf-8")
by_size = sorted((path.name for path in models.iterdir()), key=lambda name: (models / name).stat().st_size, reverse=True)


def start(place, rounded, *options, rank="-", meeting="-"):
    return subprocess.Popen([python, DRIVER, examples, place, rank, str(meeting), models, rounded, "--processes", "1",
                             *options], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def run(place, rounded, *options, **more):
    """Exit code and what was printed."""
    process = start(place, rounded, *options, **more)
    text = process.communicate(timeout=1200)[0]
    return process.returncode, text


def results(folder):
    """What tells whether a file has been written again."""
    return {path.name: (path.stat().st_ino, path.stat().st_mtime_ns) for path in folder.glob("*.vtp")}


def done_in(text):
    """The models that were rounded, or tried to, in this run."""
    return [line.split("] ")[1].split(": ")[0] for line in text.splitlines() if line.startswith("[")]


def check_complete(folder):
    """Every model has its result and its line, once; no file of the work is left."""
    with open(folder / "summary.csv", newline="", encoding="utf-8") as file:
        lines = [line["model"] for line in csv.DictReader(file)]
    assert lines == sorted(by_size), lines
    assert sorted(path.name for path in folder.iterdir()) == sorted(
        [f"{name}.vtp" for name in by_size if name != "empty.ply"] + ["summary.csv"]), list(folder.iterdir())
    for name in by_size:
        if name != "empty.ply":
            assert np.array_equal(points(folder / f"{name}.vtp"), rounded_points(data / name)), name


for place, at_place, in_journal in (("unwritten", 1, 1), ("cut", 1, 1), ("written", 1, 2), ("table", 3, 4),
                                    ("removal", 3, 4)):
    rounded = output / place
    code, text = run(place, rounded)
    assert code == -signal.SIGKILL, (place, code, text)
    first = results(rounded)
    assert sorted(first) == sorted(f"{name}.vtp" for name in by_size[:at_place]), (place, first)
    code, text = run("no", rounded)
    assert code == 1 and "3 of 4 models rounded" in text, (place, code, text)
    assert f"{in_journal} of 4 models are done already" in text, (place, text)
    assert done_in(text) == by_size[in_journal:], (place, text)
    told = f"{by_size[1]}: process 0 was rounding it when it was interrupted" in text
    assert told == (place in ("unwritten", "cut")), (place, text)
    assert first.items() <= results(rounded).items(), place
    check_complete(rounded)

# Killed again and again: each run does a model more.
rounded, seen = output / "again", []
for _ in range(len(by_size)):
    code, text = run("unwritten", rounded)
    seen += done_in(text)
    if code != -signal.SIGKILL:
        break
assert code == 1 and seen == by_size, (code, seen)
check_complete(rounded)

# The system kills what rounds one of the models, as when there is no memory left: the same command tries it again, and
# nothing else.
rounded = output / "model"
code, text = run("model", rounded)
assert code == 1 and "creature.vtp: broke off with exit code -9" in text, (code, text)
assert "2 of 4 models rounded" in text and "1 broke off; the same command tries" in text, text
first = results(rounded)
assert sorted(first) == ["cube.vtp.vtp", "go-stone.vtp.vtp"], first
code, text = run("no", rounded)
assert "3 of 4 models are done already" in text and done_in(text) == ["creature.vtp"], text
assert code == 1 and "3 of 4 models rounded" in text and "broke off" not in text, (code, text)
assert first.items() <= results(rounded).items()
check_complete(rounded)

# What has changed in between is done again: a model, or a property. What somebody has removed comes back.
rounded = output / "changed"
run("table", rounded)
os.utime(models / "cube.vtp", ns=(0, 0))
(rounded / "go-stone.vtp.vtp").unlink()
code, text = run("table", rounded)
assert done_in(text) == [name for name in by_size if name in ("cube.vtp", "go-stone.vtp")], text
code, text = run("no", rounded, "--roundness", "2")
assert "All models are rounded again" in text and done_in(text) == by_size, text
assert np.array_equal(points(rounded / "cube.vtp.vtp"), rounded_points(data / "cube.vtp", Roundness=2.0))

# One of two processes is lost with the largest model, the first or the other one: the other takes it and says so.
for lost in (1, 0):
    rounded, meeting = output / f"lost-{lost}", output / f"meeting-{lost}"
    options = ("--limit", "1")
    processes = {0: start("first" if lost == 0 else "no", rounded, *options, rank="0", meeting=meeting)}
    if lost == 0:
        meeting.with_suffix(".go").touch()
        assert processes[0].wait(timeout=1200) == -signal.SIGKILL
    code, text = run("first" if lost == 1 else "no", rounded, *options, rank="1", meeting=meeting)
    if lost == 1:
        assert code == -signal.SIGKILL, (code, text)
        meeting.with_suffix(".go").touch()
        text = processes[0].communicate(timeout=1200)[0]
        code = processes[0].returncode
    assert code == 1 and "3 of 4 models rounded" in text, (code, text)
    assert f"process {lost} has shown no sign of life for 1 s. It was working on {by_size[0]}." in text, text
    check_complete(rounded)
