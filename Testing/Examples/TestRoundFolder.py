# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A folder of models: each is rounded as it is alone, bad ones are told, and nothing is written elsewhere."""
import csv
import pathlib
import shutil

import numpy as np
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from ExampleTesting import data, may_limit_files, output, points, rounded_points, run, run_badly, run_well


def files_in(folder):
    return sorted(file.relative_to(folder).as_posix() for file in folder.rglob("*") if not file.is_dir())


def summary(folder):
    with open(folder / "summary.csv", newline="", encoding="utf-8") as file:
        return {line["model"]: line for line in csv.DictReader(file)}


# Two files of one name, one more in a folder below, and three that are no models.
models, rounded = output / "models", output / "models" / "rounded"
(models / "below").mkdir(parents=True)
for name in ("creature", "cube", "icosahedron"):
    shutil.copy(data / f"{name}.vtp", models)
shutil.copy(data / "go-stone.vtp", models / "below" / "cube.vtp")
reader, writer = vtkXMLPolyDataReader(), vtkSTLWriter()
reader.SetFileName(str(data / "cube.vtp"))
writer.SetInputConnection(reader.GetOutputPort())
writer.SetFileName(str(models / "cube.stl"))
writer.Write()
(models / "broken.vtp").write_text("<VTKFile", encoding="utf-8")
(models / "empty.ply").write_text("", encoding="utf-8")
(models / "notes.txt").write_text("no model", encoding="utf-8")
before = files_in(output)

done = run("round_folder.py", models, rounded, "--recursive", "--roundness", 2, "--processes", 3)
good = ["below/cube.vtp", "creature.vtp", "cube.stl", "cube.vtp", "icosahedron.vtp"]
bad = ["broken.vtp", "empty.ply"]
assert done.returncode == 1, (done.returncode, done.stdout)
assert files_in(rounded) == sorted([f"{name}.vtp" for name in good] + ["summary.csv"]), files_in(rounded)
assert [f for f in files_in(output) if not f.startswith("models/rounded/")] == before
lines = summary(rounded)
assert list(lines) == sorted(good + bad), lines
for name in good:
    assert lines[name]["result"] == "rounded", lines[name]
    assert int(lines[name]["points"]) == len(points(rounded / f"{name}.vtp")), lines[name]
for name in bad:
    assert lines[name]["result"] != "rounded" and name in lines[name]["result"], lines[name]
assert "5 of 7 models rounded" in done.stdout and "[7/7]" in done.stdout, done.stdout
for name, source in (("creature.vtp", "creature"), ("below/cube.vtp", "go-stone"), ("cube.vtp", "cube")):
    alone = rounded_points(data / f"{source}.vtp", Roundness=2.0)
    assert np.array_equal(points(rounded / f"{name}.vtp"), alone), name

# Again: what was written is not taken for models, though it lies in their folder, and is the same.
first = {name: (rounded / f"{name}.vtp").read_bytes() for name in good}
done = run("round_folder.py", models, rounded, "--recursive", "--roundness", 2, "--processes", 1)
assert done.returncode == 1 and "5 of 7" in done.stdout, done.stdout
for name in good:
    assert (rounded / f"{name}.vtp").read_bytes() == first[name], name

# Only good ones, no folders below: exit code 0.
for name in bad:
    (models / name).unlink()
run_well("round_folder.py", models, output / "good")
assert files_in(output / "good") == sorted([f"{n}.vtp" for n in good[1:]] + ["summary.csv"])

# A link does not lead out of the output folder.
elsewhere, linked = output / "elsewhere", output / "linked"
elsewhere.mkdir()
linked.mkdir()
(linked / "below").symlink_to(elsewhere, target_is_directory=True)
(linked / "cube.vtp.vtp").symlink_to(elsewhere / "cube.vtp.vtp")
done = run("round_folder.py", models, linked, "--recursive")
assert done.returncode == 1 and "leads out of" in done.stdout, done.stdout
assert not files_in(elsewhere), files_in(elsewhere)
assert summary(linked)["creature.vtp"]["result"] == "rounded"

# What cannot be done is said at once.
for arguments, words in (([output / "nowhere", rounded], "no such folder"),
                         ([models, models], "another folder"), ([elsewhere, rounded], "no models")):
    done = run("round_folder.py", *arguments)
    assert done.returncode != 0 and words in done.stdout, (arguments, done.stdout)
for arguments, words in (([models, models / "cube.vtp"], "File exists"),
                         ([models, output / "much", "--normal-blend", 3], "normal_blend must be 0 to 1; it is 3")):
    text = run_badly("round_folder.py", *arguments)
    assert words in text, (arguments, text)

# A full disk: what did not fit is gone, and the table says why there is none of a model.
if may_limit_files:
    text = run_badly("round_folder.py", models, output / "full", largest_file=150000)
    assert text.count("creature.vtp.vtp: cannot be written") == 2, text
    assert files_in(output / "full") == ["cube.stl.vtp", "cube.vtp.vtp", "icosahedron.vtp.vtp", "summary.csv"]
    assert "too large" in run_badly("round_folder.py", models, output / "fuller", largest_file=100)
    assert not list((output / "fuller").glob("*.vtp")), files_in(output / "fuller")
assert pathlib.Path(models / "cube.vtp").read_bytes() == (data / "cube.vtp").read_bytes()
