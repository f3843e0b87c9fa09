# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Names of files and kinds of arrays that people have: no file of theirs is touched, and no number is taken for another.

usage: TestFilesAndArrays.py DATA_FOLDER
"""
import os
import pathlib
import sys
import tempfile
import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

import sphericalstyle as ss

data = pathlib.Path(sys.argv[1])
creature = ss.read(data / "creature.vtp")
P = vtk_to_numpy(creature.GetPoints().GetData()).astype(float)
F = vtk_to_numpy(creature.GetPolys().GetConnectivityArray()).reshape(-1, 3)
warnings.simplefilter("ignore", ss.StyleWarning)


def refused(kind, call, *words):
    try:
        call()
    except kind as error:
        assert all(word in str(error) for word in words) and ".part" not in str(error), error
        return
    raise AssertionError(f"not refused: {words}")


# --------------------------------------------------------------------------------------------------------------- files
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    kept = {}
    for own in ("toy.part.ply", "toy.part.glb", "toy.vtp.part", "toy.html.part", "toy.ply.part"):
        (folder / own).write_bytes(own.encode())
        kept[own] = own.encode()
    targets = ["toy.ply", "toy.vtp", "UP.PLY", "Up.Stl", "x" * 251 + ".ply"]
    if hasattr(ss, "vtkStyleGLTFWriter"):
        targets += ["toy.glb", "UP.GLB"]
        ss.write_slider(folder / "SLIDER.GLB", creature, detail_size=0, keep_size="Off")
        assert ss.read(folder / "SLIDER.GLB").GetNumberOfPoints() == len(P)
        ss.write_page(folder / "toy.html", creature, detail_size=0, keep_size="Off", normal_blend=0)
    for target in targets:
        ss.write(folder / target, creature)
        assert ss.read(folder / target).GetNumberOfPolys() == len(F), target
    assert all((folder / own).read_bytes() == content for own, content in kept.items())
    expected = {*kept, *targets, *(["SLIDER.GLB", "toy.html"] if "toy.glb" in targets else [])}
    assert set(os.listdir(folder)) == expected, set(os.listdir(folder)) ^ expected
    (folder / "is.ply").mkdir()
    refused(ss.Error, lambda: ss.write(folder / "is.ply", creature), "is.ply", "cannot be written", "directory")
    refused(ss.Error, lambda: ss.write(folder / "toy.vtp" / "x.ply", creature), "x.ply", "cannot be written")
    assert set(os.listdir(folder)) == expected | {"is.ply"}, "nothing is left behind"
    (folder / "UP.GLTF").write_text("{}", encoding="utf-8")
    refused(ss.Error, lambda: ss.read(folder / "UP.GLTF"), "UP.GLTF", "lower case")

# -------------------------------------------------------------------------------------------------------------- arrays
upper = P[:, 1] > np.median(P[:, 1])
factor = np.where(upper, 2.0, 1.0)
expected = vtk_to_numpy(ss.round(creature, roundness_factor=factor).GetPoints().GetData())
assert np.abs(expected - vtk_to_numpy(ss.round(creature).GetPoints().GetData())).max() > 0.01
for kind in (">f8", ">f4", "f2", np.longdouble, ">i2", "u1"):
    other = vtk_to_numpy(ss.round(creature, roundness_factor=factor.astype(kind)).GetPoints().GetData())
    assert (other == expected).all(), kind
refused(ValueError, lambda: ss.round(creature, roundness_factor=np.ma.masked_array(factor, mask=upper)), "masked")
refused(ValueError, lambda: ss.round((np.ma.masked_array(P, mask=P > 0), F)), "masked")
refused(TypeError, lambda: ss.round(creature, roundness_factor=factor, part_roundness={0: 0.5}, parts=upper.astype(int)),
        "roundness_factor", "part_roundness")

# Faces that are split have more points than a small type can count.
corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
most, triangles = ss.round((corners, quads))
for kind in (np.uint8, np.int8, np.uint16, np.int32, ">i4"):
    points, faces = ss.round((corners, quads.astype(kind)))
    assert (points == most).all() and (faces == triangles).all() and len(points) > 256, kind
    assert (faces.dtype == kind) == (np.iinfo(kind).max >= len(points)), (kind, faces.dtype)

# ------------------------------------------------------------------------------------------------------ what cannot be
blocks = vtkMultiBlockDataSet()
blocks.SetBlock(0, creature)
for call in (lambda: ss.deform(blocks, []), lambda: ss.resize(blocks, {0: 1.2}), lambda: ss.parts(blocks),
             *([lambda: ss.printable(blocks)] if hasattr(ss, "vtkPrintableFilter") else [])):
    refused(TypeError, call, "each block")
for axis in ("-Z", "-y", "W"):
    refused(ValueError, lambda axis=axis: ss.round(creature, keep_size="Extent", up_axis=axis), "up_axis", axis)
