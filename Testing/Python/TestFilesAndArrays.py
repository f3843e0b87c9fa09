# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Names of files and kinds of arrays that people have: no file of theirs is touched, and no number is taken for another.

usage: TestFilesAndArrays.py DATA_FOLDER
"""
import dataclasses
import json
import os
import pathlib
import sys
import tempfile
import types
import warnings
from typing import NamedTuple

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkMultiBlockDataSet, vtkPolyData, vtkTable,
                                           vtkUnstructuredGrid)

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
    for own in ("toy.part.ply", "toy.part.glb", "toy.vtp.part", "toy.html.part", "toy.ply.part", "toy.3mf.part"):
        (folder / own).write_bytes(own.encode())
        kept[own] = own.encode()
    targets = ["toy.ply", "toy.vtp", "UP.PLY", "Up.Stl", "x" * 251 + ".ply"]
    if hasattr(ss, "vtkStyleGLTFWriter"):
        targets += ["toy.glb", "UP.GLB"]
        ss.write_slider(folder / "SLIDER.GLB", creature, detail_size=0, keep_size="Off")
        assert ss.read(folder / "SLIDER.GLB").GetNumberOfPoints() == len(P)
        ss.write_page(folder / "toy.html", creature, detail_size=0, keep_size="Off", normal_blend=0)
    writer = ss.vtk3MFWriter()
    writer.SetFileName(str(folder / "toy.3mf"))
    writer.SetInputData(creature)
    assert writer.Write()
    for target in targets:
        ss.write(folder / target, creature)
        assert ss.read(folder / target).GetNumberOfPolys() == len(F), target
    assert all((folder / own).read_bytes() == content for own, content in kept.items())
    expected = {*kept, *targets, "toy.3mf", *(["SLIDER.GLB", "toy.html"] if "toy.glb" in targets else [])}
    assert set(os.listdir(folder)) == expected, set(os.listdir(folder)) ^ expected
    (folder / "is.ply").mkdir()
    refused(ss.Error, lambda: ss.write(folder / "is.ply", creature), "is.ply", "cannot be written", "directory")
    refused(ss.Error, lambda: ss.write(folder / "toy.vtp" / "x.ply", creature), "x.ply", "cannot be written")
    assert set(os.listdir(folder)) == expected | {"is.ply"}, "nothing is left behind"
    (folder / "UP.GLTF").write_text("{}", encoding="utf-8")
    refused(ss.Error, lambda: ss.read(folder / "UP.GLTF"), "UP.GLTF", "lower case")

# Pages: names that are not text, any title, and every preset opens within the slider.
if hasattr(ss, "vtkStyleGLTFWriter"):
    with tempfile.TemporaryDirectory() as name:
        page = pathlib.Path(os.fsdecode(os.fsencode(name) + b"/\xff.html"))
        for title, options in ((None, {}), ("@DATA@ <b>", {"roundness": 8.0, "maximum_roundness": 3.0})):
            ss.write_page(page, creature, title=title, detail_size=0, keep_size="Off", **options)
            text = page.read_text(encoding="utf-8")
            assert ("<title>@DATA@ &lt;b&gt;</title>" if title else "<title>\\udcff</title>") in text, title
            shown = json.loads(text.partition('type="application/json">')[2].partition("</script>")[0])
            assert shown["presets"][0]["linear"] and all(0 < preset["start"] <= shown["end"] < 1
                                                         for preset in shown["presets"]), shown["end"]

# What has no faces is not written, in any format, and what is written can be read again.
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    for suffix in ss.model_files.WRITERS:
        refused(ss.Error, lambda suffix=suffix: ss.write(folder / f"x{suffix}", vtkPolyData()), "0 points and no faces")
    assert not os.listdir(folder)
    strip = vtkPolyData()
    strip.SetPoints(creature.GetPoints())
    strip.SetStrips(vtkCellArray())
    strip.GetStrips().InsertNextCell(4, (0, 1, 2, 3))
    for suffix in set(ss.model_files.WRITERS) & set(ss.model_files.READERS):
        ss.write(folder / f"strip{suffix}", strip)
        assert ss.model_files.triangle_count(ss.read(folder / f"strip{suffix}")) == 2, suffix
    # Only colors are colors: the writer of glTF takes any active scalars for them.
    shares = np.abs(P - P.min(axis=0)) / np.ptp(P, axis=0)
    for values, is_color in ((P[:, 0], False), (P, False), (shares, True), (shares.astype(np.float32), True),
                             ((255 * shares).astype(np.uint8), True), ((65535 * shares).astype(np.uint16), True),
                             (shares > 0.5, True), ((255 * shares).astype(int), False), (shares[:, :2], False)):
        colored = vtkPolyData()
        colored.ShallowCopy(creature)
        scalars = ss.meshes.array_of(values, "scalars")
        scalars.SetName("scalars")
        colored.GetPointData().SetScalars(scalars)
        ss.write(folder / "colored.glb", colored)
        content = (folder / "colored.glb").read_bytes()
        assert (b"COLOR_0" in content) == is_color and ss.read(folder / "colored.glb"), values.dtype

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
refused(TypeError, lambda: ss.round(vtkTable()), "round()", "vtkTable")
for call in (ss.parts, lambda grid: ss.deform(grid, []), lambda grid: ss.resize(grid, {}, parts=[])):
    refused(TypeError, lambda call=call: call(vtkUnstructuredGrid()), "vtkUnstructuredGrid")
refused(TypeError, lambda: ss.round((P, None)), "faces must be", "None")
refused(TypeError, lambda: ss.deform(creature, [{"place": "abc"}]), "handle 1: place must be 3 numbers, not 'abc'")
refused(ValueError, lambda: ss.deform(creature, [{"place": (10**400, 0, 0)}]), "handle 1: place", "too large")
for keyword, value in (("roundness", 10**400), ("center", (0, 10**400, 0)), ("number_of_threads", 10**400)):
    refused(ValueError, lambda keyword=keyword, value=value: ss.round(creature, **{keyword: value}), keyword)
for call in (ss.round, ss.parts, lambda mesh: ss.resize(mesh, {0: 1.2}), lambda mesh: ss.deform(mesh, [])):
    for mesh in ((np.empty((0, 3)), np.empty((0, 3), int)), (P, []), vtkPolyData()):
        try:
            call(mesh)
        except (ss.Error, ValueError) as error:
            assert str(error), mesh
assert len(ss.parts(vtkPolyData())) == 0 and (ss.parts((P, [])) == -1).all()


# ------------------------------------------------------------------------------------- objects with vertices and faces
class Box:
    """As those of trimesh: made of lengths, and whoever sets vertices is not heard."""

    def __init__(self, lengths):
        self.lengths = lengths

    vertices = property(lambda self: self.lengths * corners, lambda self, values: None)
    faces = quads


class Mesh:
    def __init__(self, vertices, faces):
        self.vertices, self.faces = vertices, faces


class MeshBox(Mesh):
    def __init__(self, lengths):
        super().__init__(lengths * corners, quads)

    def __setattr__(self, name, value):
        if not hasattr(self, name):
            super().__setattr__(name, value)


@dataclasses.dataclass(frozen=True)
class Frozen:
    vertices: np.ndarray
    faces: np.ndarray
    name: str = ""


class Row(NamedTuple):
    vertices: np.ndarray
    faces: np.ndarray
    name: str = ""


expected = ss.round((corners, quads), refine_long_edges="Off")[0]
for mesh in (MeshBox(1.0), Frozen(corners, quads, "box"), Row(corners, quads, "box"), Mesh(corners, quads),
             types.SimpleNamespace(vertices=corners, faces=quads, name="box")):
    rounded = ss.round(mesh, refine_long_edges="Off")
    assert isinstance(rounded, Mesh if isinstance(mesh, MeshBox) else type(mesh)), rounded
    assert (rounded.vertices == expected).all() and (rounded.faces == quads).all(), rounded
    assert getattr(rounded, "name", "box") == "box" and (mesh.vertices == corners).all(), rounded
    if not isinstance(mesh, types.SimpleNamespace):
        split = ss.round(mesh)
        assert (split.vertices == most).all() and (split.faces == triangles).all(), split
refused(TypeError, lambda: ss.round(Box(1.0), refine_long_edges="Off"), "Box", "cannot be set")
assert (ss.round((corners, iter(quads.tolist())))[0] == most).all(), "faces that are given once"
