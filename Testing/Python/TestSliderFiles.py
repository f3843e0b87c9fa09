# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""sphericalstyle.write_page, and the program with --slider and --html.

usage: TestSliderFiles.py PROGRAM DATA_FOLDER
"""
import base64
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import GLTFFiles
import sphericalstyle as ss

program, data = sys.argv[1], os.path.abspath(sys.argv[2])
folder = tempfile.mkdtemp()
warnings.simplefilter("ignore", ss.StyleWarning)  # of thin parts
snowman = ss.read(os.path.join(data, "snowman.vtp"))


def place(name):
    return os.path.join(folder, name)


def data_of(page):
    """What the page shows; it asks for nothing else."""
    with open(page, encoding="utf-8") as file:
        text = file.read()
    assert not re.search(r"https?:|src=|href=|import |fetch\(|@\w+@", text), "no network"
    return json.loads(text.partition('type="application/json">')[2].partition("</script>")[0]), text


def decoded(text, kind):
    return np.frombuffer(base64.b64decode(text), kind)


# ------------------------------------------------------------------------------------------------------- the page
ss.write_page(place("page.html"), snowman, title="<Snow & man>")
shown, text = data_of(place("page.html"))
assert "<title>&lt;Snow &amp; man&gt;</title>" in text
names = [preset["name"] for preset in shown["presets"]]
assert names[0] == "Toy" and sorted(names) == sorted(ss.presets.PRESETS), names
model = decoded(shown["points"], np.float32).reshape(-1, 3)
assert (model == vtk_to_numpy(snowman.GetPoints().GetData())).all() and shown["up"] == np.eye(3).tolist()
size = shown["size"]
for preset in shown["presets"]:
    # Opened where the preset is: the filter's result, within the error of few targets and of 16 bits.
    weights = GLTFFiles.chain(preset["places"], preset["start"])
    moved = model + sum(weight * scale * decoded(moves, np.int16).reshape(-1, 3) for weight, scale, moves
                        in zip(weights, preset["scales"], preset["targets"]))
    rounded = vtk_to_numpy(ss.round(snowman, preset=preset["name"]).GetPoints().GetData())
    error = np.linalg.norm(moved - rounded, axis=1).max() / size
    print(f"{preset['name']}: {len(weights)} targets, {error:.2g} of the diagonal from the filter")
    assert error < 0.006 and preset["start"] <= shown["end"]
ss.write_page(place("own.html"), snowman, preset="Ball", roundness=2, up_axis="Z")
shown, _ = data_of(place("own.html"))
assert shown["presets"][0]["name"] == "As chosen" and len(shown["presets"]) == 1 + len(ss.presets.PRESETS)
assert abs(shown["presets"][0]["start"] - 2 * 3 ** 0.5 / (1 + 2 * 3 ** 0.5)) < 1e-6 and shown["up"][1] == [0, 0, 1]
triangle = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
ss.write_page(place("chibi.html"), triangle, preset="chibi", maximum_targets=2)
names = [preset["name"] for preset in data_of(place("chibi.html"))[0]["presets"]]
assert names[0] == "Chibi" and sorted(names) == sorted(ss.presets.PRESETS), "a name in any letters is that preset"
ss.write(place("bare.glb"), snowman)  # has no normals
ss.write_page(place("bare.html"), place("bare.glb"))
shown, _ = data_of(place("bare.html"))
assert len(decoded(shown["points"], np.float32)) >= 3 * snowman.GetNumberOfPoints() and not shown["colors"]
maker = GLTFFiles.Maker(scene=0, scenes=[{"nodes": [0, 1]}])  # a page shows all meshes, where the scene has them
P, _, F, _ = GLTFFiles.ball()
primitive = {"attributes": {"POSITION": maker.add(P, bounds=True)}, "indices": maker.add(F.ravel(), np.uint32)}
maker.root |= {"meshes": [{"primitives": [primitive]}], "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}]}
ss.write_page(place("two.html"), maker.save(place("two.glb")))
shown, _ = data_of(place("two.html"))
X = decoded(shown["points"], np.float32).reshape(-1, 3)[:, 0]
assert np.allclose([X.min(), X.max()], [P[:, 0].min(), P[:, 0].max() + 5], atol=1e-6), (X.min(), X.max())
try:
    ss.write_page(place("page.txt"), snowman)
    raise AssertionError("not refused")
except ss.Error as error:
    assert "ends in .html" in str(error)


# ---------------------------------------------------------------------------------------------------- the program
def run(*arguments, code=0):
    result = subprocess.run([program, *arguments], capture_output=True, text=True)
    assert result.returncode == code, (arguments, result)
    return result.stdout + result.stderr


plain = ["--detail-size", "0", "--keep-size", "Off"]
source = os.path.join(data, "snowman.vtp")
out = run(source, place("snow.glb"), "--slider", "--html", place("snow.html"), "--roundness", "2", *plain)
assert "snow.glb: " in out, out
root, binary = GLTFFiles.load(place("snow.glb"))
assert root["meshes"][0]["extras"]["targetNames"] == ["Roundness"] and os.path.exists(place("snow.html"))
moved = GLTFFiles.points(root, binary, root["meshes"][0]["weights"])
rounded = vtk_to_numpy(ss.round(snowman, roundness=2, detail_size=0, keep_size="Off").GetPoints().GetData())
assert np.linalg.norm(moved - rounded, axis=1).max() < 1e-6 * size
# A .glb is copied, and not read as a surface and written anew.
run(place("snow.glb"), place("again.gltf"), "--slider", *plain)
again, _ = GLTFFiles.load(place("again.gltf"))
assert again["meshes"][0]["extras"]["targetNames"] == ["Roundness", "Roundness"]
out = run(source, os.path.join(data, "cube.vtp"), "--output", place("many"), "--slider", "--html", place("pages"), *plain)
assert sorted(os.listdir(place("many"))) == ["cube.vtp.glb", "snowman.vtp.glb"], out
assert sorted(os.listdir(place("pages"))) == ["cube.vtp.html", "snowman.vtp.html"]
# What the file has to say is told here, too.
run(source, place("round.vtp"))
out = run(place("round.vtp"), place("round.glb"), "--slider", "--report", place("round.json"), *plain)
notes = json.loads(pathlib.Path(place("round.json")).read_text(encoding="utf-8"))["models"][0]["warnings"]
assert [note for note in notes if "rounded already" in note] and "rounded already" in out, (notes, out)
assert "has to end in .glb or .gltf" in run(source, place("snow.ply"), "--slider", code=2)
assert "ends in .html" in run(source, place("snow.ply"), "--html", place("x.png"), code=2)
said = run(source, source, "--output", place("o"), "--html", "x.html", code=2)
assert "--html: give a folder, not a file, with --output" in said, said
assert "the format is glb or gltf" in run(source, source, "--output", place("o"), "--slider", "--format", "ply", code=2)
