# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Files that somebody else has named and made: nothing is written outside the output folder, no name is run or moves the
cursor, and no file that a model names is opened."""
import csv
import json
import os
import shutil
import subprocess

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from ExampleTesting import data, examples, output, points, python, rounded_points, surface

work = output / "work"  # where the script is started
work.mkdir()


def run(*arguments):
    """Exit code and what was printed. A pipe that is opened keeps the script waiting: the test then fails."""
    done = subprocess.run([python, examples / "round_folder.py", *arguments], cwd=work, check=False, timeout=1200,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode, done.stdout.decode("utf-8")


def files_in(folder):
    return sorted(file.relative_to(folder).as_posix() for file in folder.rglob("*"))


def summary(folder):
    with open(folder / "summary.csv", newline="", encoding="utf-8", errors="surrogateescape") as file:
        return {line["model"]: line["result"] for line in csv.DictReader(file)}


# Names that a shell, an option parser, a terminal, a spreadsheet, a format or a decoder would take for something else.
names = ["; touch ran;.vtp", "$(touch ran).vtp", "`touch ran`.vtp", "| touch ran.vtp", "-rf.vtp", "--processes.vtp",
         "=1+1.vtp", "line\nbreak.vtp", "\x1b[2Jcleared.vtp", "\r.vtp", "<b>&amp;\"'.vtp", "%s%n.vtp", "..x.vtp", "~.vtp",
         os.fsdecode(b"no text \xff.vtp"), " .vtp"]
too_long = "x" * 250 + ".vtp"
models, rounded = output / "models", output / "rounded"
models.mkdir()
for name in names + [too_long]:
    shutil.copy(data / "cube.vtp", models / name)
before = files_in(models)
code, text = run(models, rounded, "--processes", "2")
assert code == 1 and f"{len(names)} of {len(names) + 1} models rounded" in text, (code, text)
assert files_in(rounded) == sorted([name + ".vtp" for name in names] + ["summary.csv"]), files_in(rounded)
assert files_in(models) == before and not files_in(work), (files_in(models), files_in(work))
assert all(line.isprintable() for line in text.split("\n")), text
assert text.count("rounded\n") == 2 * len(names) + 1, text  # as each was ready, in the table, and the count
lines = summary(rounded)
assert len(lines) == len(names) + 1 and "too long" in lines.pop(too_long)
assert {str(models / name) for name in lines} >= {str(models / name) for name in names if name[0] not in "=-\r"}
assert {(models / name).resolve() for name in lines} == {(models / name).resolve() for name in names}
assert set(lines.values()) == {"rounded"} and not any(name[0] in "=+-@\r" for name in lines), lines
expected = rounded_points(data / "cube.vtp")
assert all(np.array_equal(points(rounded / (name + ".vtp")), expected) for name in names)

# Models that name files: none is opened. A pipe would keep whoever opens it waiting.
naming, named = output / "naming", output / "named"
naming.mkdir()
pipe = naming / "pipe"
os.mkfifo(pipe)
triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"
(naming / "material.obj").write_text(f"mtllib pipe\nmtllib {pipe}\ncall {pipe}\n{triangle}", encoding="utf-8")
header = "property float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices"
(naming / "texture.ply").write_text(f"ply\nformat ascii 1.0\ncomment TextureFile {pipe}\nelement vertex 3\n{header}\n"
                                    "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", encoding="utf-8")
cube = (data / "cube.vtp").read_text(encoding="latin-1").split("?>", 1)[-1]
(naming / "entity.vtp").write_text(f'<?xml version="1.0"?>\n<!DOCTYPE VTKFile [<!ENTITY % e SYSTEM "file://{pipe}"> %e; '
                                   f'<!ENTITY f SYSTEM "pipe">]>\n{cube}', encoding="latin-1")
arrays = surface(data / "cube.vtp")
array_names = ["../../elsewhere", "/elsewhere", "$(touch ran)", "; touch ran", "%s%n", "x" * 5000]
for name in array_names:
    array = numpy_to_vtk(np.ones(arrays.GetNumberOfPoints()), deep=True)
    array.SetName(name)
    arrays.GetPointData().AddArray(array)
writer = vtkXMLPolyDataWriter()
writer.SetFileName(str(naming / "arrays.vtp"))
writer.SetInputData(arrays)
writer.SetDataModeToBinary()  # VTK 9.2 cannot read some files with appended data with today's expat
writer.Write()
everything = files_in(output)
code, text = run(naming, named)
assert (code, files_in(work)) == (0, []), text
assert files_in(named) == ["arrays.vtp.vtp", "entity.vtp.vtp", "material.obj.vtp", "summary.csv", "texture.ply.vtp"]
assert [file for file in files_in(output) if not file.startswith("named")] == everything
assert np.array_equal(points(named / "entity.vtp.vtp"), expected)
after = surface(named / "arrays.vtp.vtp").GetPointData()
assert all(after.HasArray(name) for name in array_names)

# Links in the output folder, to folders and files, there and not there: nothing comes to where they lead.
linked, elsewhere = output / "linked", output / "elsewhere"
models = output / "few"
(models / "below" / "deeper").mkdir(parents=True)
for name in ("below/deeper/cube.vtp", "cube.vtp", "direct.vtp", "nowhere.vtp"):
    shutil.copy(data / "cube.vtp", models / name)
linked.mkdir()
elsewhere.mkdir()
(elsewhere / "kept").write_text("kept", encoding="utf-8")
(linked / "below").symlink_to(elsewhere, target_is_directory=True)
for name in ("cube.vtp.vtp.part", "direct.vtp.vtp", "summary.csv", "summary.csv.part"):
    (linked / name).symlink_to(elsewhere / "kept")
(linked / "nowhere.vtp.vtp.part").symlink_to(elsewhere / "new")
code, text = run(models, linked, "--recursive")
assert code == 1 and "2 of 4 models rounded" in text, (code, text)
lines = summary(linked)
assert lines.pop("cube.vtp") == lines.pop("nowhere.vtp") == "rounded"
assert all("leads out of" in line for line in lines.values()), lines
assert files_in(elsewhere) == ["kept"] and (elsewhere / "kept").read_text(encoding="utf-8") == "kept"
assert not any((linked / name).is_symlink() for name in ("cube.vtp.vtp", "nowhere.vtp.vtp", "summary.csv"))
assert (linked / "summary.csv.part").is_symlink()  # somebody's own; what is unfinished has a name that nobody has

# The same in the folder of the journal, and what a journal names that somebody else has written.
for k, link in enumerate((".round_folder", ".round_folder/done-1-0.jsonl", ".round_folder/run-0")):
    linked = output / f"linked-{k}"
    (linked / link).parent.mkdir(parents=True)
    (linked / link).symlink_to(elsewhere, target_is_directory=True)
    code, text = run(models, linked)
    assert code == 1 and ("leads out of" in text or "is a link" in text), (code, text)
    assert files_in(elsewhere) == ["kept"] and not list(linked.glob("*.vtp")), text
forged = output / "forged"
(forged / ".round_folder").mkdir(parents=True)
status = (models / "cube.vtp").stat()
for number, part in enumerate(("../../elsewhere/kept", str(elsewhere / "kept"), 5, None)):
    entry = {"model": "cube.vtp", "stamp": [status.st_size, status.st_mtime_ns], "again": False, "bytes": 4, "part": part,
             "line": {"model": "cube.vtp", "result": "rounded"}}
    (forged / ".round_folder" / f"done-{number}-0.jsonl").write_text(json.dumps(entry) + "\n", encoding="utf-8")
code, text = run(models, forged)
assert code == 0 and "3 of 3 models rounded" in text, (code, text)
assert files_in(elsewhere) == ["kept"] and np.array_equal(points(forged / "cube.vtp.vtp"), expected)
