# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""sphericalstyle.read with files that end too early or are damaged: with some of them VTK's readers end the process, and
others they take for models.

usage: TestFileDamage.py FOLDER
"""
import pathlib
import random
import struct
import sys

import numpy as np
from vtkmodules.vtkCommonCore import vtkLogger
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOPLY import vtkPLYWriter

import sphericalstyle as ss
from SurfaceTesting import points

folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # readers report what this test wants


def refused(name, data, *words):
    """The message for a file with these bytes."""
    file = folder / name
    file.write_bytes(data)
    try:
        surface = ss.read(file)
    except ss.Error as error:
        assert str(error).startswith(str(file)) and all(word in str(error) for word in words), (words, error)
        return str(error)
    raise AssertionError(f"read with {surface.GetNumberOfPoints()} points, and should say {words}")


source = vtkSphereSource()
source.SetThetaResolution(16)
source.SetPhiResolution(12)
source.Update()
ball = source.GetOutput()
COUNTS = ball.GetNumberOfPoints(), ball.GetNumberOfPolys()

# ------------------------------------------------------------------- a model that is cut off, wherever that is
for suffix in (".ply", ".stl", ".vtk", ".vtp", ".glb", ".gltf"):
    whole = folder / f"ball{suffix}"
    ss.write(whole, ball)
    data = whole.read_bytes()
    assert ss.read(whole).GetNumberOfPolys() == COUNTS[1]
    for size in [*range(len(data) // 16, len(data) - 1, max(1, len(data) // 16)), len(data) - 5]:
        refused("cut" + suffix, data[:size])
data = (folder / "ball.ply").read_bytes()
refused("last.ply", data[:-1], "cut off", f"promises {COUNTS[1]}", f"has {COUNTS[1] - 1}")
data = (folder / "ball.stl").read_bytes()
refused("last.stl", data[:-1], "cut off", f"promises {COUNTS[1]} triangles", f"has {COUNTS[1] - 1}")

# --------------------------------------------------------------------------- PLY: as text, and with other lists
writer = vtkPLYWriter()
writer.SetFileTypeToASCII()
writer.SetFileName(str(folder / "text.ply"))
writer.SetInputData(ball)
writer.Write()
text = (folder / "text.ply").read_bytes()
assert (points(ss.read(folder / "text.ply")) == points(ss.read(folder / "ball.ply"))).all()
for size in range(len(text) // 8, len(text) - 10, len(text) // 8):
    refused("cut.ply", text[:size])

HEAD = ("ply\nformat {format}\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\n"
        "element face {faces}\nproperty list {types} vertex_indices\nend_header\n")
CORNERS = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n"


def lines(body, count=4, faces=1, types="uchar int"):
    return (HEAD.format(format="ascii 1.0", count=count, faces=faces, types=types) + body).encode()


(folder / "good.ply").write_bytes(lines(CORNERS + "3 0 1 2\n4 0 1 3 2\n", faces=2))
assert ss.read(folder / "good.ply").GetNumberOfPolys() == 2
refused("list.ply", lines(CORNERS + "-1\n"), 'number 0 of "face" has a list of -1')
refused("short.ply", lines(CORNERS + "3 0 1 2\n3 0 1\n", faces=2), 'number 1 of "face" has 3 of 4 numbers')
refused("more.ply", lines(CORNERS + "3 0 1 2\n", count=30), 'promises 30 of "vertex"', "has 5")
refused("empty.ply", lines("\n" + CORNERS + "3 0 1 2\n"), 'number 0 of "vertex" has 0 of 3 numbers')
refused("id.ply", lines(CORNERS + "3 0 1 4\n"), "names point 4", "4 points")
refused("below.ply", lines(CORNERS + "3 0 1 -1\n"), "names point -1")
refused("type.ply", lines(CORNERS + "3 0 1 2\n", types="uchar word"), "uchar word")
refused("real.ply", lines(CORNERS + "3 0 1 2\n", types="float int"), "float int")

refused("names.ply", lines(CORNERS + "3 0 1 2\n").replace(b"vertex_indices", b"corners"), "no list vertex_indices")
refused("names.ply", lines(CORNERS + "3 0 1 2\n").replace(b"float z", b"float h"), "no x, y and z")
refused("head.ply", lines(CORNERS + "3 0 1 2\n").replace(b"end_header", b"begin"), "its head has no end")
refused("format.ply", lines(CORNERS + "3 0 1 2\n").replace(b"ascii", b"text"), "names no format")
refused("line.ply", lines(CORNERS + "3 0 1 2\n").replace(b"element f", b"elements f"), "elements face 1")
refused("count.ply", lines(CORNERS + "3 0 1 2\n").replace(b"face 1", b"face one"), "element face one")

# VTK's reader takes the numbers of what stands before points or faces for theirs.
OTHER = b"element camera 1\nproperty float fov\n"
data = lines(CORNERS + "3 0 1 2\n")
refused("first.ply", data.replace(b"element v", OTHER + b"element v").replace(b"end_header\n", b"end_header\n9\n"),
        '"camera" stands before')
refused("none.ply", data.replace(b"vertex 4", b"corner 4"), "no points")
refused("last.ply", data.replace(b"element vertex", b"element face 0\nproperty list int int vertex_indices\n"
                                 b"element vertex"), "not in front")
(folder / "good.ply").write_bytes(data.replace(b"end_header", OTHER + b"end_header") + b"9\n")
assert (points(ss.read(folder / "good.ply")) == np.array(CORNERS.split(), float).reshape(-1, 3)).all()

for order, format_ in (("<", "binary_little_endian 1.0"), (">", "binary_big_endian 1.0")):
    for letter, types in (("B", "uchar int"), ("i", "int int"), ("H", "ushort int")):
        def faces(*rows):
            return b"".join(struct.pack(f"{order}{letter}{len(row)}i", len(row), *row) for row in rows)

        corners = np.array(CORNERS.split(), order + "f4").tobytes()
        head = HEAD.format(format=format_, count=4, faces=3, types=types).encode()
        for rows in ([(0, 1, 2), (1, 2, 3), (0, 1, 3)], [(0, 1, 2), (0, 1, 3, 2), (1, 2, 3)]):
            body = head + corners + faces(*rows)
            (folder / "good.ply").write_bytes(body)
            assert ss.read(folder / "good.ply").GetNumberOfPolys() == 3
            for cut in (1, 4, len(faces(rows[2])), len(faces(*rows)) + 1):
                refused("cut.ply", body[:-cut], "cut off")
    bad = corners + struct.pack(f"{order}i3i", 3, 0, 1, 2) + struct.pack(f"{order}i", -2) + bytes(100)
    refused("list.ply", HEAD.format(format=format_, count=4, faces=3, types="int int").encode() + bad,
            'number 1 of "face" has a list of -2')

# A PLY of any bytes: a message or a model, and no end of the process.
chance = random.Random(1)
data = (folder / "ball.ply").read_bytes()
head = data.index(b"end_header") + 11
for _ in range(400):
    changed = bytearray(data)
    within = chance.choice((head, len(data)))
    for _ in range(chance.choice((1, 3, 20))):
        changed[chance.randrange(within)] = chance.choice((chance.randrange(256), chance.choice(b" \n-0129")))
    (folder / "any.ply").write_bytes(changed)
    try:
        surface = ss.read(folder / "any.ply")
    except ss.Error:
        continue
    assert surface.GetNumberOfPolys() > 0

# --------------------------------------------------------------------------------------------- JSON, and cells
refused("cut.gltf", b'{"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"x', "line 1, column")
refused("array.gltf", b"[1, 2]", "no glTF")
refused("bytes.gltf", b'{"asset": "\xff"}', "no JSON")
VTK = ("# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
       "POLYGONS 1 4\n3 0 1 {}\n")
(folder / "good.vtk").write_text(VTK.format(2))
assert ss.read(folder / "good.vtk").GetNumberOfPolys() == 1
refused("id.vtk", VTK.format(7).encode(), "names point 7", "3 points")
print("every damaged file is refused")
