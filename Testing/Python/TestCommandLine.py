# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The program sphericalstyle: files of every format, options, exit codes, folders, reports, pictures, manual page.

usage: TestCommandLine.py PROGRAM MANUAL DATA_FOLDER OUTPUT_FOLDER PAGE...
PAGE: of the documentation; its commands are run.
"""
import csv
import json
import os
import pathlib
import pty
import re
import shutil
import subprocess
import sys
from unittest import mock

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOGeometry import vtkOBJReader

import sphericalstyle as ss
from sphericalstyle import model_files, presets, properties
from sphericalstyle.command_line import make_parser
from SurfaceTesting import points

program, manual, data, output = sys.argv[1], *map(pathlib.Path, sys.argv[2:5])
shutil.rmtree(output, ignore_errors=True)
output.mkdir(parents=True)
creature = data / "creature.vtp"
package = pathlib.Path(ss.__file__).parent.parent
others = os.pathsep.join(folder for folder in os.environ.get("PYTHONPATH", "").split(os.pathsep)
                         if folder and pathlib.Path(folder).resolve() != package.resolve())


def run(*arguments, **options):
    """The finished program. It finds the package by itself."""
    environment = os.environ | {"PYTHONPATH": others} | options.pop("environment", {})
    return subprocess.run([program, *map(str, arguments)], check=False, text=True, capture_output=True,
                          env=environment, **options)


def run_well(*arguments, **options):
    done = run(*arguments, **options)
    assert done.returncode == 0, (arguments, done)
    return done


def refused(words, *arguments, code=2):
    """The program ends with this exit code, and the last line of what it says has these words."""
    done = run(*arguments)
    assert done.returncode == code and "Traceback" not in done.stderr, (arguments, done)
    assert words in done.stderr.splitlines()[-1], (words, done.stderr)


def rounded(surface, **keywords):
    return points(ss.round(surface, **keywords))


# --------------------------------------------------------------------------------------------- one model, all formats
surface = ss.read(creature)
count = surface.GetNumberOfPoints()
colored = vtkPolyData()
colored.ShallowCopy(surface)
colors = vtkUnsignedCharArray()
colors.SetName("RGB")
colors.SetNumberOfComponents(3)
colors.SetNumberOfTuples(count)
vtk_to_numpy(colors)[:] = np.arange(3 * count).reshape(-1, 3) % 251
colored.GetPointData().SetScalars(colors)
texture = numpy_to_vtk(points(surface)[:, :2].astype(np.float32).copy(), deep=True)
texture.SetName("TCoords")
colored.GetPointData().SetTCoords(texture)
# Shape alone in these: .stl has every triangle by itself, .glb and .byu have arrays of their own.
tolerance = {"obj": 1e-4, "byu": 1e-4}
readable = [suffix[1:] for suffix in model_files.WRITERS if suffix in model_files.READERS]
assert {"ply", "stl", "obj", "vtk", "vtp", "gltf", "byu"} <= set(readable)
for format_ in readable:
    try:
        ss.write(output / f"model.{format_}", colored)
    except model_files.ModelError as error:
        assert format_ == "glb" and "this version of VTK cannot write" in str(error), error
        continue
    model = ss.read(output / f"model.{format_}")
    run_well(output / f"model.{format_}", output / f"round.{format_}", "--roundness", 2, "--preset", "Soft", "--quiet")
    result = ss.read(output / f"round.{format_}")
    expected = rounded(model, preset="Soft", roundness=2.0)
    assert np.allclose(points(result), expected, rtol=0.0, atol=tolerance.get(format_, 0.0)), format_
    assert result.GetNumberOfPolys() == model.GetNumberOfPolys(), format_
    for name in ("RGB", "TCoords"):
        array, kept = model.GetPointData().GetArray(name), result.GetPointData().GetArray(name)
        assert format_ not in ("vtk", "vtp") or array, (format_, name)
        if array:
            assert np.allclose(vtk_to_numpy(array), vtk_to_numpy(kept), atol=1e-4), (format_, name)
assert ss.read(output / "round.ply").GetPointData().HasArray("RGB")
assert ss.read(output / "round.obj").GetPointData().GetTCoords()

# numpy_to_vtk makes a vtkTypeUInt8Array.
colors = numpy_to_vtk(vtk_to_numpy(colors), deep=True)
colors.SetName("RGB")
colored.GetPointData().SetScalars(colors)
ss.write(output / "numpy.ply", colored)
assert ss.read(output / "numpy.ply").GetPointData().HasArray("RGB")

# OBJ files with normals that no face names, and without those that faces name: the readers of VTK 9.1 and 9.2
# make arrays of one value and of none for five points, that of 9.4 makes no array.
corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt .5 .5\n"
bare = output / "bare.obj"
for count_, text in ((1, corners + "vn 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 2 5\nf 4 1 5\n"),
                     (0, corners + "f 1/1/1 2/2/2 3/3/3\nf 1/1/1 3/3/3 4/4/4\nf 1/1/1 2/2/2 5/5/5\n")):
    bare.write_text(text, encoding="utf-8")
    reader = vtkOBJReader()
    reader.SetFileName(str(bare))
    reader.Update()
    normals = reader.GetOutput().GetPointData().GetNormals()
    assert not normals or normals.GetNumberOfTuples() == count_
    run_well(bare, output / "bare.ply", "--refine-long-edges", "Off")
    assert ss.read(output / "bare.ply").GetNumberOfPoints() == 5
none = reader.GetOutput()
empty = vtkFloatArray()
empty.SetNumberOfComponents(3)
none.GetPointData().SetNormals(empty)
assert none.GetPointData().GetNormals() and not ss.round(none).GetPointData().GetNormals(), "not only for files"

# Names of presets in any letters, and a way out for what is no surface.
run_well(creature, output / "chibi.vtp", "--preset", "chIBI", "--quiet")
assert np.array_equal(points(ss.read(output / "chibi.vtp")), rounded(surface, preset="chibi"))
(output / "grid.vti").write_text("<VTKFile/>", encoding="ascii")
refused("save its surface in ParaView, with Extract Surface or Contour", output / "grid.vti", output / "a.vtp", code=1)

# ---------------------------------------------------------------------------------------------------------- what it says
done = run_well(creature, output / "a.vtp", "--report", output / "a.json", "--no-keep-on-ground", "--center", 0, 0.5, -1)
assert f"{count} points, moved by up to" in done.stdout and not done.stderr, done
report = json.loads((output / "a.json").read_text(encoding="utf-8"))
model, = report["models"]
style = ss.vtkSphericalStyleFilter()
assert report["sphericalstyle"] == ss.__version__ and report["preset"] is None
assert report["properties"]["center"] == [0, 0.5, -1] and report["properties"]["center_mode"] == "Custom"
assert report["properties"]["roundness"] == style.GetRoundness() and set(report["properties"]) == set(properties.properties())
assert model["result"] == "rounded" and model["points"] == count and model["output"] == str(output / "a.vtp")
assert np.allclose(model["center"], [0, 0.5, -1]) and model["largest_move"] > 0 and model["warnings"] == []
assert np.array_equal(points(ss.read(output / "a.vtp")), rounded(surface, center=(0, 0.5, -1)))
assert model["folds"] == "" and "Folds: " not in done.stdout, done
if hasattr(ss, "vtkPrintableFilter"):  # with CGAL
    done = run_well(creature, output / "b.vtp", "--avoid-self-intersections", "--report", output / "b.json")
    model, = json.loads((output / "b.json").read_text(encoding="utf-8"))["models"]
    assert " newly ran through each other; now none. " in model["folds"] and f"Folds: {model['folds']}\n" in done.stdout, done
done = run_well(creature, output / "a.vtp", "--quiet", "--report", output / "a.csv")
assert done.stdout == done.stderr == "", done
with open(output / "a.csv", newline="", encoding="utf-8") as file:
    line, = csv.DictReader(file)
assert line["result"] == "rounded" and int(line["points"]) == count and line["new points"] == "0", line

# The axis that points up is that of each format, unless it is given.
upright = vtkPolyData()
upright.CopyStructure(surface)
standing = vtkPoints()
standing.SetData(numpy_to_vtk(points(surface)[:, [0, 2, 1]] * np.float32([1, -1, 1]), deep=True))
upright.SetPoints(standing)
ss.write(output / "upright.stl", upright)
mixed = [output / "upright.stl", creature, "--output", output / "mixed", "--keep-on-ground", "--roundness", 5, "--quiet"]
run_well(*mixed, "--report", output / "a.json")
report = json.loads((output / "a.json").read_text(encoding="utf-8"))
assert report["properties"]["up_axis"] is None and [model["up_axis"] for model in report["models"]] == ["Y", "Z"], report
for name, model, axis in (("creature.vtp", surface, 1), ("upright.stl", upright, 2)):
    lowest = [points(mesh)[:, axis].min() for mesh in (ss.read(output / "mixed" / name), model)]
    assert np.isclose(*lowest, atol=1e-5), (name, lowest)
run_well(*mixed, "--up-axis", "x", "--report", output / "a.json")
report = json.loads((output / "a.json").read_text(encoding="utf-8"))
assert report["properties"]["up_axis"] == "X" and [model["up_axis"] for model in report["models"]] == ["X", "X"], report

# A bar on a terminal only.
leader, follower = pty.openpty()
process = subprocess.Popen([program, creature, output / "a.vtp"], stdout=subprocess.DEVNULL, stderr=follower)
os.close(follower)
shown = ""
try:
    while True:
        shown += os.read(leader, 4096).decode()
except OSError:  # how Linux says that nobody writes to the terminal any more
    assert process.wait() == 0
assert "creature.vtp [" in shown and "%" in shown and shown.endswith("\x1b[K"), shown

text = run_well("--help").stdout
flat = " ".join(text.split())
for keyword, property_ in properties.properties().items():
    assert "--" + keyword.replace("_", "-") in text, keyword
assert f"(0 to 1; default: {style.GetNormalBlend():g})" in flat, flat
assert 'default: Area)' in flat and "default: off)" in flat and "exit codes:" in text
assert "default: Z for .stl, Y for others)" in flat, flat
for name in presets.PRESETS:
    assert f"{name}: " in flat, name
for action in make_parser()._actions:  # every default is shown
    if action.option_strings and action.nargs != 0 and action.dest not in ("help", "version"):
        assert action.help, action
assert run_well("--version").stdout.startswith(f"sphericalstyle {ss.__version__}, VTK ")
page = manual.read_text(encoding="utf-8")
assert page.startswith(".TH SPHERICALSTYLE 1") and all(f".SH {name}" in page for name in ("NAME", "OPTIONS", "EXIT CODES"))
for action in make_parser()._actions:
    for option in action.option_strings:
        assert option.replace("-", "\\-") in page, option
if shutil.which("man"):
    printed = subprocess.run(["man", "--warnings", "-l", manual], check=True, capture_output=True,
                             env=os.environ | {"LC_ALL": "C.UTF-8", "MANWIDTH": "100"})
    words = " ".join(re.sub(".\b", "", printed.stdout.decode()).split())
    assert not printed.stderr and "round body, round limbs, details kept" in words, printed

# ------------------------------------------------------------------------------------------------------- wrong commands
refused("name one INPUT and an OUTPUT", creature)
refused("name one INPUT and an OUTPUT", creature, creature, output / "x.ply")
refused("no such file or folder", output / "nowhere.ply", output / "x.ply")
refused("cannot write files .doc; known: .3mf .byu", creature, output / "x.doc")
refused("OUTPUT has to be another file", creature, creature)
refused("--normal-blend must be 0 to 1; it is 3", creature, output / "x.ply", "--normal-blend", 3)
refused("--roundness must be finite and 0 or more; it is -1", creature, output / "x.ply", "--roundness", -1)
refused("argument --preset: there is no preset 'Toyy', only Soft, Toy, ", creature, output / "x.ply", "--preset", "Toyy")
refused('--keep-size must be "Off", "Area"', creature, output / "x.ply", "--keep-size", "Mass")
refused("did you mean '--roundness'?", creature, output / "x.ply", "--roundnes", 2)
refused("ends in .json or .csv", creature, output / "x.ply", "--report", output / "x.txt")
refused("ends in .png", creature, output / "x.ply", "--picture", output / "x.jpg")
refused("several models need a folder", data, output / "x.ply")
refused("--picture: give a folder, not a file, with --output", creature, "--output", output / "y", "--picture", "x.png")
refused("no models", output / "models", output / "y") if (output / "models").mkdir() is None else None
refused("is in the folder of the results", output / "models", "--output", output)
assert not (output / "x.ply").exists() and not (output / "y").exists()

# A model that fails: exit code 1, and what the reader, the filter or the writer says.
(output / "broken.vtp").write_text("<VTKFile", encoding="utf-8")
(output / "cloud.obj").write_text("v 0 0 0\nv 1 0 0\n", encoding="utf-8")
refused("", output / "broken.vtp", output / "x.ply", code=1)
refused("holds 2 points and no faces", output / "cloud.obj", output / "x.ply", code=1)
(output / "wrong.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", encoding="utf-8")
refused("the face in line 4 names point 4, and the file has 3", output / "wrong.obj", output / "x.ply", code=1)
refused('Region: there is no numeric point array "nothing"', creature, output / "x.ply", "--region", "nothing", code=1)
done = run(creature, output / "nowhere" / "x.ply")
assert done.returncode == 2 and f"{output / 'nowhere' / 'x.ply'}: there is no folder" in done.stderr, done
assert not (output / "x.ply").exists() and not list(output.glob("*.part*"))

# What the reader has to say is a warning as others, and the folder of a report is made as that of a picture.
(output / "misfit.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\n"
                                   "f 1/9 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", encoding="utf-8")
done = run_well(output / "misfit.obj", output / "misfit.ply", "--report", output / "reports" / "a.json", "--quiet",
                "--center", "-1e-3", "+1e-3", "-.2E-5")
report = json.loads((output / "reports" / "a.json").read_text(encoding="utf-8"))
assert "line 6 names texture coordinate 9" in report["models"][0]["warnings"][0] and not done.stderr, (report, done)
assert report["properties"]["center"] == [-0.001, 0.001, -0.000002], report

# -------------------------------------------------------------------------------------------------------------- folders
models = output / "models"
(models / "below").mkdir()
shutil.copy(creature, models)
shutil.copy(output / "model.ply", models / "below" / "creature.ply")
shutil.copy(output / "broken.vtp", models)
done = run(models, output / "all", "--recursive", "--report", output / "all.json")
assert done.returncode == 1 and "2 of 3 models rounded" in done.stdout, done
assert sorted(str(file.relative_to(output / "all")) for file in (output / "all").rglob("*.*")) == \
    ["below/creature.ply", "creature.vtp"]
table = done.stdout.split("\n\n")[1].splitlines()
assert table[0].split() == ["model", "points", "new", "points", "largest", "move", "seconds", "result"], table
assert [line.split()[0] for line in table[1:]] == ["below/creature.ply", "broken.vtp", "creature.vtp"], table
report = json.loads((output / "all.json").read_text(encoding="utf-8"))
assert [model["result"] == "rounded" for model in report["models"]] == [True, False, True]
assert np.array_equal(points(ss.read(output / "all" / "creature.vtp")), rounded(surface))
done = run(models, output / "ply", "--format", "ply", "--quiet", "--processes", 1)
assert done.returncode == 1 and done.stdout == "" and "broken.vtp: " in done.stderr, done
assert [file.name for file in (output / "ply").iterdir()] == ["creature.vtp.ply"]
run_well(creature, output / "model.ply", "--output", output / "two", "--roundness", 0)
assert np.array_equal(points(ss.read(output / "two" / "creature.vtp")), points(surface))
refused("would both be written to", creature, models / "creature.vtp", "--output", output / "twice")
refused("would replace the model", creature, "--output", data)
if (output / "linked").mkdir() is None:
    (output / "linked" / "creature.vtp").symlink_to(output / "elsewhere")
    assert run(creature, output / "cloud.obj", "--output", output / "linked").returncode == 1
    assert not (output / "elsewhere").exists()

# ------------------------------------------------------------------------------------------------------------- pictures
done = run(creature, output / "p.ply", "--picture", output / "p.png", environment={"DISPLAY": ""})
if done.returncode:
    assert done.returncode == 1 and "pictures need a display, and there is none" in done.stderr, done
    assert len(done.stderr.splitlines()) == 1 and not (output / "p.ply").exists(), "said before the work is done"
if os.environ.get("DISPLAY"):
    from vtkmodules.vtkIOImage import vtkPNGReader

    from sphericalstyle import model_pictures

    def seen_in(path):
        """Where a picture shows a model, above the labels."""
        reader = vtkPNGReader()
        reader.SetFileName(str(path))
        reader.Update()
        width, height, _ = reader.GetOutput().GetDimensions()
        image = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, 3)
        assert (image[-1] == 255).all(), "a light background"
        return np.any(image[height // 8:] < 250, axis=2)

    run_well(creature, output / "p.ply", "--picture", output / "p.png", "--roundness", 5, "--normal-blend", 0)
    seen = seen_in(output / "p.png")
    height, width = seen.shape
    left, right = seen[:, :width // 2], seen[:, width // 2:]
    assert left.any() and right.any() and not np.array_equal(left, right)
    feet = [int(np.argmax(half.any(axis=1))) for half in (left, right)]
    assert abs(feet[0] - feet[1]) < height // 10, ("both stand on one ground", feet)
    run_well(output / "upright.stl", output / "p.ply", "--picture", output / "stl.png", "--roundness", 5,
             "--normal-blend", 0)
    assert (seen_in(output / "stl.png") != seen).mean() < 1e-3, "an STL file stands on Z"
    for keywords, name in (({}, "Toy, "), ({"preset": "chubby", "detail_size": 0.1}, "Chubby, "), ({"roundness": 9}, "")):
        with mock.patch.object(model_pictures, "picture") as picture:
            style = ss.rounding.make(**keywords)
            style.SetInputData(surface)
            model_pictures.before_after(output / "p.png", surface, style, "y", 0, keywords.get("preset"))
        label = picture.call_args.args[2][0][1][1]
        assert label.startswith(f"after: {name}Roundness {style.GetRoundness():g}, NormalBlend"), label
    done = run(models, output / "all", "--picture", output / "pictures", "--quiet")
    assert [file.name for file in (output / "pictures").iterdir()] == ["creature.vtp.png"], done

# ------------------------------------------------------------------------------------------------------------- examples
for page in sys.argv[5:]:
    text = pathlib.Path(page).read_text(encoding="utf-8")
    commands = re.findall(r"^    (?:\S*/)?(sphericalstyle \S.*)$", text, re.MULTILINE)
    assert commands, page
    work = output / "page"
    shutil.rmtree(work, ignore_errors=True)
    (work / "models").mkdir(parents=True)
    (work / "Data").symlink_to(data)
    shutil.copy(creature, work / "models")
    shutil.copy(output / "model.obj", work / "bunny.obj")
    shutil.copy(output / "model.ply", work / "bunny.ply")
    for command in commands:
        command = command.partition(" #")[0]
        if "--picture" in command and not os.environ.get("DISPLAY"):
            continue
        done = subprocess.run(["sh", "-c", command.replace("sphericalstyle", f"'{program}'", 1)], cwd=work, check=False,
                              text=True, capture_output=True)
        assert done.returncode == 0, (command, done)
