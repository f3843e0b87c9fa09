#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Ball, can and box beside Blender's modifier Cast: whose details keep their shape better.

Both go the same share of the way: Cast moves each point by a factor toward its shape; Roundness moves the base by mu / (1 + mu), mu = sqrt(3)
Roundness. NormalBlend is 0 and KeepSize Off, for Cast knows neither limbs nor size. Cast's box is that of the bounds,
and its cylinder stands along y and has no ends. Needs blender (Debian).
"""
import json
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np

import measures
import pictures
import surfaces

CAST = {"Sphere": "SPHERE", "Cylinder": "CYLINDER", "RoundedBox": "CUBOID"}
NAMES = ("Data/creature", "bunny", "koala", "skull", "nefertiti", "spot")
#: Errors of Cast over ours, at least.
GAIN = {"Sphere": 1.05, "Cylinder": 5.0, "RoundedBox": 1.2}
DETAIL_SIZE = 0.06
ROUNDNESS = 1.0
COLUMNS = ("model", "target", "error", "error of Cast", "gain", "error without base", "that of Cast",
           "gain without base")
BLENDER = """
import bpy, json, numpy as np, sys
asked = json.load(open(sys.argv[sys.argv.index("--") + 1]))
x, F = np.load(asked["points"]), np.load(asked["triangles"])
mesh = bpy.data.meshes.new("model")
mesh.from_pydata(x.tolist(), [], F.tolist())
model = bpy.data.objects.new("model", mesh)
bpy.context.collection.objects.link(model)
for kind, path in asked["kinds"].items():
    model.modifiers.clear()
    cast = model.modifiers.new("cast", "CAST")
    cast.cast_type, cast.factor = kind, asked["factor"]
    shown = model.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    np.save(path, np.array([v.co[:] for v in shown.vertices]))
print("Blender " + bpy.app.version_string)
"""


def cast(x, F, center, factor):
    """Points of each kind of CAST, and Blender's version. The axis of its cylinder is y here."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        kinds = {kind: str(folder / f"{kind}.npy") for kind in CAST.values()}
        np.save(folder / "points.npy", np.roll(x - center, 1, axis=1))
        np.save(folder / "triangles.npy", F)
        (folder / "script.py").write_text(BLENDER, encoding="utf-8")
        (folder / "asked.json").write_text(json.dumps({
            "points": str(folder / "points.npy"), "triangles": str(folder / "triangles.npy"), "kinds": kinds,
            "factor": factor}), encoding="utf-8")
        told = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                               folder / "script.py", "--", folder / "asked.json"], check=True, capture_output=True, text=True)
        version = next(line for line in told.stdout.splitlines() if line.startswith("Blender "))
        return {kind: np.roll(np.load(path), -1, axis=1) + center for kind, path in kinds.items()}, version


class Cast:
    """As surfaces.Result, for the pictures."""

    failed = False

    def __init__(self, x, F):
        self.x, self.F = x, F


def compare(check, name, path):
    """Rows of COLUMNS, and what pictures.sheets takes."""
    x, F = surfaces.read(path)
    measured = measures.Details(x, F, DETAIL_SIZE)
    style = surfaces.Style(x, F, {"RefineLongEdges": 0, "NormalBlend": 0.0, "DetailSize": DETAIL_SIZE, "Roundness": ROUNDNESS,
                                  "KeepSize": "Off", "TargetEdges": 0.0})
    area = np.linalg.norm(measures.crosses(x, F), axis=1)
    center = (area[:, None] * x[F].mean(axis=1)).sum(axis=0) / area.sum()
    mu = np.sqrt(3.0) * ROUNDNESS
    others, version = cast(x, F, center, mu / (1.0 + mu))
    size = np.ptp(x, axis=0)
    width = 0.5 * (size[0] + size[2])
    lengths = {"Sphere": size, "Cylinder": np.array([width, size[1], width]), "RoundedBox": size}
    rows, shown = [], []
    for target, kind in CAST.items():
        ours = style.result({"Target": target, "TargetLengths": lengths[target]})
        (whole, alone), (cast_whole, cast_alone) = measured.errors(ours.x), measured.errors(others[kind])
        rows.append(dict(zip(COLUMNS, [name, target, whole, cast_whole, cast_whole / whole, alone, cast_alone,
                                       cast_alone / alone])))
        print("  {model:10s} {target:10s} error {error:.5f} of {error of Cast:.5f}: {gain:.2f} times less; without base "
              "{error without base:.5f} of {that of Cast:.5f}: {gain without base:.2f}".format(**rows[-1]), flush=True)
        for column in ("gain", "gain without base"):
            check(rows[-1][column] >= GAIN[target], f"{name}, {target}: {column} at least {GAIN[target]}")
        shown += [ours, Cast(others[kind], F)]
    return rows, (name, x, F, shown), version


def main():
    arguments, paths = surfaces.chosen_models(__doc__, NAMES)
    if not shutil.which("blender"):
        surfaces.skip("no Blender")
    check = surfaces.Checks()
    rows, sheets = [], []
    for name, path in paths.items():
        more, sheet, version = compare(check, name, path)
        rows += more
        sheets.append(sheet)
    print(f"{version}; {len(rows)} pairs")
    if arguments.output:
        surfaces.write_table(arguments.output, "targets.csv", COLUMNS, rows)
        if arguments.pictures:
            pictures.sheets(arguments.output, sheets, [f"{who}, {target}" for target in CAST for who in ("ours", "Cast")])
    check.exit()


if __name__ == "__main__":
    main()
