# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""vtkStyleGLTFWriter and sphericalstyle.write_slider: the slider is the filter, and nothing else changes in a file.

usage: TestStyleGLTFWriter.py DATA_FOLDER
"""
import functools
import json
import os
import resource
import signal
import sys
import tempfile
import warnings

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkStripper
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkPointSource, vtkSphereSource

import GLTFFiles
import SurfaceTesting
import sphericalstyle as ss
from GLTFFiles import ball, chain
from SurfaceTesting import points
from sphericalstyle.messages import Messages

data = os.path.abspath(sys.argv[1])
read = functools.partial(SurfaceTesting.read, data)
folder = tempfile.mkdtemp()
MU = 3 ** 0.5
warnings.simplefilter("ignore", ss.StyleWarning)  # of thin parts


def diagonal(P):
    return np.linalg.norm(np.ptp(P, axis=0))


def slider_of(roundness):
    return MU * roundness / (1 + MU * roundness)


def largest(P, Q):
    return np.linalg.norm(P - Q, axis=1).max()


def write(name, mesh, **keywords):
    path = os.path.join(folder, name)
    slider = ss.write_slider(path, mesh, **keywords)
    return (slider, *GLTFFiles.load(path))


# ------------------------------------------------------------------------------------------------- one target is all
creature = read("creature.vtp")
plain = dict(detail_size=0, keep_size="Off")
for blend in (0, 0.6):
    slider, root, binary = write("line.glb", creature, roundness=1.5, normal_blend=blend, **plain)
    mesh = root["meshes"][0]
    assert slider == (1, 0, 0, True) and mesh["extras"]["targetNames"] == ["Roundness"], (slider, mesh)
    assert mesh["extras"]["sphericalStyle"]["roundness"] == "w / (1 - w) / sqrt(3)" and "animations" not in root
    assert mesh["weights"] == [np.float32(slider_of(1.5))]
    size, worst = diagonal(points(creature)), 0
    for roundness in (0, 0.05, 0.1, 0.3, 0.5, 1, 2, 5, 20, 1000):
        result = ss.round(creature, roundness=roundness, normal_blend=blend, **plain)
        moved = GLTFFiles.points(root, binary, [slider_of(roundness)])
        worst = max(worst, largest(moved, points(result)) / size)
    print(f"NormalBlend {blend}: one target, ten values of Roundness, largest difference {worst:.1e} of the diagonal")
    assert worst < 1e-6
    # Normals lie on no line; one target fits them best where nothing crumples.
    result = ss.round(creature, roundness=1, normal_blend=blend, generate_normals=True, **plain)
    exact = vtk_to_numpy(result.GetPointData().GetNormals())
    normals = GLTFFiles.points(root, binary, [slider_of(1)], attribute="NORMAL")
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    angle = np.degrees(np.arccos(np.clip((normals * exact).sum(axis=1), -1, 1)))
    print(f"normals at Roundness 1: {np.mean(angle):.1f} degrees in the mean, {np.quantile(angle, .99):.1f} for 99 %")
    assert np.mean(angle) < (2 if blend == 0 else 8)
flat = GLTFFiles.numbers(root, binary, root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"])
assert np.allclose(np.linalg.norm(flat, axis=1), 1, atol=1e-6)

# --------------------------------------------------------------------------------------------------- several targets
# The filter's result may change fast on the way; the slider has no targets closer than 1/256 of its range.
print("with details: tolerance, targets, largest error and jump that were found; between them: median, largest")
for preset, tolerances in (("Toy", (0.01, 0.003, 0.001)), ("Ball", (0.001,)), ("Pebble", (0.001,)), ("Puffy", (0.003,))):
    counts = []
    style = ss.rounding.make(preset)
    style.SetInputData(creature)
    for tolerance in tolerances:
        slider, root, binary = write("chain.glb", creature, preset=preset, tolerance=tolerance)
        told = root["meshes"][0]["extras"]["sphericalStyle"]
        places = told["places"]
        assert slider.targets == len(places) == told["numberOfTargets"] and not slider.linear
        assert slider.error == told["largestError"] and slider.jump == told["largestJump"]
        worst = []
        for w in np.linspace(0, places[-1], 30):  # at 1/29 and so on, where the writer has not looked
            style.SetRoundness(w / (1 - w) / MU)
            style.Update()
            moved = GLTFFiles.points(root, binary, chain(places, w))
            near = slider.jump > 0 and any(a - 1 / 256 < w < b + 1 / 256 for a, b in zip([0, *places], places)
                                           if b - a < 2.1 / 256)
            if not near:
                worst.append(largest(moved, points(style.GetOutput())) / size)
        worst.sort()
        print(f"  {preset} {tolerance}: {slider.targets}, {slider.error:.2g}, {slider.jump:.2g};"
              f" {np.median(worst):.2g}, {worst[-1]:.2g}")
        counts.append(slider.targets)
        assert slider.targets <= 32
        assert slider.error <= tolerance and worst[-1] <= tolerance, worst
    assert counts == sorted(counts), counts

# ------------------------------------------------------------------------------------------------ kinds of surfaces
cube = vtkCubeSource()
cube.Update()
slider, root, binary = write("cube.gltf", cube.GetOutput())  # coarse: it is split first, polygons are cut
primitive = root["meshes"][0]["primitives"][0]
P = GLTFFiles.numbers(root, binary, primitive["attributes"]["POSITION"])
F = GLTFFiles.numbers(root, binary, primitive["indices"]).reshape(-1, 3)
rounded = ss.round(cube.GetOutput())
assert len(P) == rounded.GetNumberOfPoints() > 100 and F.max() == len(P) - 1
assert (P.min(axis=0) == -0.5).all() and (P.max(axis=0) == 0.5).all()
at_one = chain(root["meshes"][0]["extras"]["sphericalStyle"]["places"], slider_of(1))
assert np.allclose(root["meshes"][0]["weights"], at_one, atol=1e-6)  # opened at the Roundness of the filter
assert largest(GLTFFiles.points(root, binary, at_one), points(rounded)) < 0.001 * diagonal(P)

sphere = vtkSphereSource()
sphere.SetThetaResolution(30)
sphere.SetPhiResolution(30)
sphere.Update()
stripper = vtkStripper()
stripper.SetInputData(sphere.GetOutput())
stripper.Update()
assert stripper.GetOutput().GetNumberOfStrips() > 0
_, root, binary = write("strips.glb", stripper.GetOutput())
assert root["accessors"][root["meshes"][0]["primitives"][0]["indices"]]["count"] == 3 * sphere.GetOutput().GetNumberOfPolys()

colored = vtkPolyData()
colored.DeepCopy(sphere.GetOutput())
count = colored.GetNumberOfPoints()
coordinates = np.random.default_rng(1).random((count, 2)).astype(np.float32)
colors = np.random.default_rng(2).integers(0, 256, (count, 3), dtype=np.uint8)
for values, name in ((coordinates, "UV"), (colors, "RGB")):
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    colored.GetPointData().AddArray(array)
colored.GetPointData().SetActiveTCoords("UV")
_, root, binary = write("colored.glb", colored)
attributes = root["meshes"][0]["primitives"][0]["attributes"]
assert (GLTFFiles.numbers(root, binary, attributes["TEXCOORD_0"]) == coordinates).all()
written = GLTFFiles.numbers(root, binary, attributes["COLOR_0"])
assert (written[:, :3] == colors).all() and (written[:, 3] == 255).all()
normals = vtk_to_numpy(sphere.GetOutput().GetPointData().GetNormals())
assert np.allclose(GLTFFiles.numbers(root, binary, attributes["NORMAL"]), normals, atol=1e-6)

# VTK's own reader takes it, where the slider is.
again = ss.read(os.path.join(folder, "colored.glb"))
shown = GLTFFiles.points(root, binary, root["meshes"][0]["weights"])
assert again.GetNumberOfPoints() == count and largest(points(again), shown) < 1e-6, largest(points(again), shown)

# A part of the model, by an array of it; and as arrays of numpy.
region = points(colored)[:, 2] > 0
_, root, binary = write("part.glb", colored, region=region)
moved = GLTFFiles.points(root, binary, chain(root["meshes"][0]["extras"]["sphericalStyle"]["places"], 0.6))
still = (moved == points(colored)).all(axis=1)
assert still[~region].all() and not still.all()
triangles = vtk_to_numpy(colored.GetPolys().GetConnectivityArray()).reshape(-1, 3)
write("arrays.glb", (points(colored), triangles))

# The filter is somebody's: it is as before.
style = ss.vtkSphericalStyleFilter()
style.SetInputData(creature)
style.SetRoundness(0.7)
style.Update()
before = points(style.GetOutput())
writer = ss.vtkStyleGLTFWriter()
writer.SetStyle(style)
writer.SetInputData(sphere.GetOutput())
writer.SetFileName(os.path.join(folder, "own.glb"))
assert writer.Write() == 1
style.Update()
assert style.GetInput() is creature and style.GetRoundness() == 0.7 and not style.GetGenerateNormals()
assert (points(style.GetOutput()) == before).all()
# What comes before has failed, and said so.
before_it = ss.vtkSphericalStyleFilter()
before_it.SetInputData(creature)
before_it.SetRoundness(-1)
messages = Messages(before_it)
writer.SetFileName(os.path.join(folder, "none.glb"))
writer.SetInputConnection(before_it.GetOutputPort())
assert writer.Write() == 0 and writer.GetErrorCode() != 0 and not os.path.exists(os.path.join(folder, "none.glb"))
assert len(messages.errors) == 1, messages.errors
writer.SetInputData(sphere.GetOutput())
# It shows few points of a large model while something is dragged, which a file is not made of.
large = vtkSphereSource()
large.SetThetaResolution(250)
large.SetPhiResolution(220)
large.Update()
style.SetDetailSize(0)
style.SetKeepSizeToOff()
style.PreviewOn()
writer.SetInputData(large.GetOutput())
writer.SetFileName(os.path.join(folder, "large.glb"))
assert writer.Write() == 1 and style.GetPreview()
root, binary = GLTFFiles.load(os.path.join(folder, "large.glb"))
assert len(GLTFFiles.points(root, binary, [0] * writer.GetNumberOfTargets())) == large.GetOutput().GetNumberOfPoints() > 50000
# Arrays of other lengths belong to no point.
short = vtkPolyData()
short.DeepCopy(colored)
for name in ("UV", "RGB"):
    short.GetPointData().GetArray(name).SetNumberOfTuples(5)
_, root, _ = write("short.glb", short)
assert not {"TEXCOORD_0", "COLOR_0"} & set(root["meshes"][0]["primitives"][0]["attributes"])
messages = Messages(writer)
writer.SetFileName(os.path.join(folder, "own.ply"))
assert writer.Write() == 0 and "must end in .glb or .gltf" in messages.errors[0], messages.errors
assert not os.path.exists(os.path.join(folder, "own.ply"))
writer.SetFileName(os.path.join(folder, "own.glb"))

# --------------------------------------------------------------------------------------------------- rounded already
# The file shows it as it looks, whatever Roundness was asked for, and a note says so. The slider rounds it further.
result = ss.round(creature)
for keywords in (dict(roundness=2, tolerance=0.01), dict(roundness=2, **plain)):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        slider, root, binary = write("again.glb", result, **keywords)
    mesh = root["meshes"][0]
    assert mesh["weights"] == [0.0] * slider.targets, mesh["weights"]
    P = GLTFFiles.points(root, binary, mesh["weights"])
    assert largest(P, points(result)) < 1e-6 * diagonal(P)
    assert largest(GLTFFiles.points(root, binary, np.eye(slider.targets)[-1]), P) > 0.01 * diagonal(P)
    said = [str(w.message) for w in caught if "rounded already" in str(w.message)]
    assert len(said) == 1 and "slider at 0" in said[0], said

# ------------------------------------------------------------------------------------------- targets for other files
PNG = bytes.fromhex("89504e470d0a1a0a0000000d4948445200000001000000010802000000907753de0000000c49444154789c63f8cfc000"
                    "0003010100c9fe92ef0000000049454e44ae426082")


def make_scene():
    """A file with all that has to stay: a texture, a skin, morph targets with an animation, a node that mirrors and
    one that scales unevenly, a mesh shown twice, lines, somebody's extras and an extension, in an order of its own."""
    maker = GLTFFiles.Maker(extras={"author": "somebody", "number": 0.1}, extensionsUsed=["KHR_materials_unlit"],
                            scene=0)
    view = maker.view(PNG)
    maker.root |= {
        "images": [{"bufferView": view, "mimeType": "image/png"}], "textures": [{"source": 0}],
        "materials": [{"name": "Skin", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0.25},
                       "extensions": {"KHR_materials_unlit": {}}}]}
    P, N, F, UV = ball((0, 0, 0), (1, 2, 0.7))
    indices = maker.add(F.ravel(), np.uint16, target=34963)
    shape = {"POSITION": maker.add(P, bounds=True, target=34962), "NORMAL": maker.add(N, target=34962),
             "TEXCOORD_0": maker.add(UV, target=34962)}
    grin = maker.add(np.where(P[:, 1:2] > 1, np.float32(0.2), np.float32(0)) * [0, 1, 0], bounds=True, target=34962)
    weights = np.zeros((len(P), 4), np.float32)
    weights[:, 0] = (P[:, 1] + 2) / 4
    weights[:, 1] = 1 - weights[:, 0]
    bones = np.zeros((len(P), 4), np.uint8)
    bones[:, 1] = 1
    skinned = shape | {"JOINTS_0": maker.add(bones, np.uint8, target=34962),
                       "WEIGHTS_0": maker.add(weights, target=34962)}
    line = maker.add([[0, 0, 0], [0, 3, 0]], bounds=True, target=34962)
    bind = np.tile(np.eye(4, dtype=np.float32), (2, 1, 1))
    bind[:, 3, :3] = [[0, -1, 0], [0, 1, 0]]
    matrices = maker.add(bind.reshape(2, 16))
    times = maker.add([0, 1, 2], bounds=True)
    smile = maker.add([0, 1, 0])
    turns = maker.add([[0, 0, 0, 1], [0, 0.6, 0, 0.8], [0, 0, 0, 1]])
    maker.root |= {
        "meshes": [
            {"name": "Face", "extras": {"targetNames": ["Grin"], "keep": [1, 2.5]}, "weights": [0.25], "primitives": [
                {"attributes": shape, "indices": indices, "material": 0, "targets": [{"POSITION": grin}]}]},
            {"name": "Body", "primitives": [{"attributes": skinned, "indices": indices, "material": 0}]},
            {"name": "Wheel", "primitives": [{"attributes": {"POSITION": shape["POSITION"]}, "indices": indices}]},
            {"name": "Line", "primitives": [{"attributes": {"POSITION": line}, "mode": 1}]}],
        "skins": [{"joints": [5, 6], "inverseBindMatrices": matrices}],
        "nodes": [
            {"name": "Root", "children": [1, 2, 3, 4, 5, 7], "scale": [2, 2, 2]},
            {"name": "Face", "mesh": 0, "translation": [0, 3, 0], "rotation": [0, 0.6, 0, 0.8], "weights": [0.5]},
            {"name": "Body", "mesh": 1, "skin": 0, "translation": [100, 0, 0]},
            {"name": "Left", "mesh": 2, "translation": [-3, -2, 0], "scale": [0.5, 1, 1.5]},
            {"name": "Right", "mesh": 2, "matrix": [-0.5, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.5, 0, 3, -2, 0, 1]},
            {"name": "Hip", "translation": [0, 1, 0], "children": [6]}, {"name": "Head", "translation": [0, -2, 0]},
            {"name": "Line", "mesh": 3}],
        "scenes": [{"nodes": [0]}],
        "animations": [{"name": "Smile", "samplers": [{"input": times, "output": smile}, {"input": times, "output": turns}],
                        "channels": [{"sampler": 0, "target": {"node": 1, "path": "weights"}},
                                     {"sampler": 1, "target": {"node": 3, "path": "rotation"}}]}]}
    return maker


maker = make_scene()
other = b"\x04\0\0\0TEST1234"  # a chunk that nobody knows
source = maker.save(os.path.join(folder, "scene.glb"), other)
with open(source, "rb") as file:
    original = file.read()
for keywords in (dict(detail_size=0.0, keep_size="Off"), dict(preset="Toy")):
    slider, root, binary = write("scene-slider.glb", source, **keywords)
    with open(os.path.join(folder, "scene-slider.glb"), "rb") as file:
        assert file.read().endswith(other)
    with open(source, "rb") as file:
        assert file.read() == original
    n = slider.targets
    before, old = GLTFFiles.load(source)
    size = before["buffers"][0]["byteLength"]
    assert binary[:size] == old[:size], "what was in the buffer is as it was"
    left = GLTFFiles.without_slider(root, binary, before)
    assert left == before and json.dumps(left) == json.dumps(before), "the JSON is the same, also in its order"
    for k, (mesh, had) in enumerate(zip(root["meshes"], before["meshes"])):
        targets = had["primitives"][0].get("targets", [])
        assert mesh["extras"]["targetNames"][:len(targets)] == ["Grin"][:len(targets)]
        assert len(mesh["extras"]["targetNames"]) == len(mesh["weights"]) == len(targets) + n
        assert mesh["extras"]["sphericalStyle"]["firstTarget"] == len(targets)
        for primitive, own in zip(mesh["primitives"], had["primitives"]):
            new = primitive["targets"][len(targets):]
            assert primitive["targets"][:len(targets)] == targets and len(new) == n
            assert all(set(target) == {"POSITION", "NORMAL"} & set(own["attributes"]) for target in new)
        assert k != 0 or mesh["weights"][:1] == [0.25]
    places = root["meshes"][0]["extras"]["sphericalStyle"].get("places")
    assert root["nodes"][1]["weights"][0] == 0.5 and len(root["nodes"][1]["weights"]) == 1 + n
    assert root["nodes"][4]["mesh"] == 4 and len(root["meshes"]) == 5  # shown twice: each place moves in its own way
    smile = root["animations"][0]["samplers"][0]
    output = GLTFFiles.numbers(root, binary, smile["output"]).reshape(3, 1 + n)
    assert output[:, 0].tolist() == [0, 1, 0] and (output[:, 1:] == np.float32(root["meshes"][0]["weights"][1:])).all()
    assert len(root["animations"]) == (1 if n == 1 else 2)

    # In space, all meshes are rounded as one model: the filter's result of them.
    turn = np.array([[0.28, 0, 0.96], [0, 1, 0], [-0.96, 0, 0.28]])
    P, N, F, UV = ball((0, 0, 0), (1, 2, 0.7))
    matrices = [2 * turn, 2 * np.eye(3), 2 * np.diag([0.5, 1, 1.5]), 2 * np.diag([-0.5, 1, 1.5])]
    shifts = 2 * np.array([[0, 3, 0], [0, 0, 0], [-3, -2, 0], [3, -2, 0]])
    order = [0, 1, 2, 3]
    world = [P @ matrix.T + shift for matrix, shift in zip(matrices, shifts)]
    model = ss.meshes.surface_of(np.concatenate(world).astype(np.float32).astype(float),
                                 np.concatenate([(F if k < 3 else F[:, ::-1]) + k * len(P) for k in order]))
    for w in (0.3, 0.8):
        rounded = points(ss.round(model, refine_long_edges="Off", roundness=w / (1 - w) / MU, **keywords)).reshape(4, -1, 3)
        for k in order:
            weights = [w] if n == 1 else chain(places, w)
            weights = [0] * (k == 0) + weights
            local = GLTFFiles.points(root, binary, weights, k if k < 3 else 4)
            found = local @ matrices[k].T + shifts[k]
            error = largest(found, rounded[k]) / diagonal(np.concatenate(world))
            assert error < (3e-6 if n == 1 else 0.0015), (k, w, error)
            seam = local.reshape(13, 25, 3)
            assert (seam[:, 0] == seam[:, -1]).all(), "the seam is shut"
    line = GLTFFiles.points(root, binary, [0.8] * n, 3)
    assert (line == [[0, 0, 0], [0, 3, 0]]).all()
    print(f"scene with {n} target(s): JSON and buffer as before, points as the filter's")


# Two nodes share a seam, whose points are the same in single precision only: they stay together.
P, _, F, _ = ball((4, 4, 4), (1, 2, 0.7))
shift = 0.1
Q = (P - shift).astype(np.float32)
moved = Q.astype(float) + shift
assert (moved.astype(np.float32) == P).all() and (moved != P).any()
lower = P[F].mean(axis=1)[:, 2] < 4
maker = GLTFFiles.Maker()
maker.root |= {
    "meshes": [{"primitives": [{"attributes": {"POSITION": maker.add(places, bounds=True)},
                                "indices": maker.add(F[faces].ravel(), np.uint16)}]}
               for places, faces in ((P, lower), (Q, ~lower))],
    "nodes": [{"mesh": 0}, {"mesh": 1, "translation": [shift] * 3}], "scenes": [{"nodes": [0, 1]}]}
slider, root, binary = write("seam.glb", maker.save(os.path.join(folder, "halves.glb")), **plain)
halves = [GLTFFiles.points(root, binary, [0.5], mesh) + mesh * shift for mesh in (0, 1)]
seam = np.intersect1d(F[lower], F[~lower])
gap = largest(halves[0][seam], halves[1][seam]) / diagonal(P)
print(f"{len(seam)} points of two nodes stay together: {gap:.1e} of the diagonal apart")
assert gap < 1e-6

# A mesh that another scene shows, too, has its targets once.
maker = GLTFFiles.figure()
maker.root["nodes"].append({"mesh": 0})
maker.root["scenes"].append({"nodes": [len(maker.root["nodes"]) - 1]})
slider, root, binary = write("scenes.glb", maker.save(os.path.join(folder, "two.glb")), **plain)
for mesh in root["meshes"]:
    counts = {len(mesh["weights"]), len(mesh["extras"]["targetNames"]),
              *(len(primitive["targets"]) for primitive in mesh["primitives"])}
    assert len(counts) == 1, counts
print("two scenes: as many weights and names as targets")

# Bones that are not in the pose that they were bound in: what is rounded is what is shown, here an arm that is bent, with
# a ball in its hand and a mesh that a bone hides.
def make_arm():
    """A file, its triangles, and for each mesh what brings its points into the scene, a 4 x 4 matrix each."""
    P, N, F, _ = ball((0, 0, 0), (0.4, 2, 0.4))
    maker = GLTFFiles.Maker(scene=0, scenes=[{"nodes": [0, 4, 5]}])
    indices = maker.add(F.ravel(), np.uint16, target=34963)
    bend = 0.6  # sine of half the angle
    share = np.rint(255 * np.clip(P[:, 1] + 0.5, 0, 1)).astype(np.uint8)  # of the second bone
    zeros = np.zeros_like(share)
    meshes = []
    for bones in (0, 2):
        joints = np.stack([np.full_like(share, bones), np.full_like(share, max(bones, 1)), zeros, zeros], axis=1)
        weights = np.stack([255 - share, share, zeros, zeros], axis=1)
        meshes.append({"primitives": [{"indices": indices, "attributes": {
            "POSITION": maker.add(P, bounds=True, target=34962), "NORMAL": maker.add(N, target=34962),
            "JOINTS_0": maker.add(joints, np.uint8, target=34962),
            "WEIGHTS_0": maker.add(weights, np.uint8, target=34962, normalized=True)}}]})
    meshes.append({"primitives": [{"indices": indices, "attributes": {"POSITION": maker.add(P, bounds=True)}}]})
    bind = np.tile(np.eye(4), (3, 1, 1))
    maker.root |= {
        "meshes": meshes, "skins": [{"joints": [0, 1, 2], "inverseBindMatrices": maker.add(bind.reshape(3, 16))}],
        "nodes": [{"name": "Upper", "scale": [2, 2, 2], "children": [1, 2]},
                  {"name": "Lower", "rotation": [0, 0, bend, (1 - bend * bend) ** 0.5], "children": [3]},
                  {"name": "Hidden", "scale": [0, 0, 0], "translation": [0, -2, 0]},
                  {"name": "Hand", "mesh": 2, "translation": [0, 2, 0], "scale": [1, 0.25, 1]},
                  {"mesh": 0, "skin": 0}, {"mesh": 1, "skin": 0}]}
    c, s = 1 - 2 * bend * bend, 2 * bend * (1 - bend * bend) ** 0.5
    upper, lower = np.diag([2.0, 2, 2, 1]), np.diag([2.0, 2, 2, 1])
    lower[:2, :2] = 2 * np.array([[c, -s], [s, c]])
    hand = lower @ np.array([[1, 0, 0, 0], [0, 0.25, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]])
    second = (share / 255)[:, None, None]
    hidden = np.diag([0.0, 0, 0, 1])
    hidden[1, 3] = -4
    return maker, F, [(1 - second) * upper + second * lower, np.tile(hidden, (len(P), 1, 1)), np.tile(hand, (len(P), 1, 1))]


def posed(matrices, P):
    return np.einsum("ijk,ik->ij", matrices[:, :3, :3], P) + matrices[:, :3, 3]


maker, F, bones = make_arm()
source = maker.save(os.path.join(folder, "arm.glb"))
for keywords in (dict(normal_blend=0, **plain), dict(preset="Toy")):  # the last bits of points may turn normals
    slider, root, binary = write("arm-slider.glb", source, **keywords)
    before = GLTFFiles.load(source)[0]
    assert GLTFFiles.without_slider(root, binary, before) == before
    rest = [GLTFFiles.points(root, binary, [0] * slider.targets, k) for k in range(3)]
    world = np.concatenate([posed(matrices, P) for matrices, P in zip(bones, rest)])
    model = ss.meshes.surface_of(world.astype(np.float32).astype(float),
                                 np.concatenate([F + k * len(rest[0]) for k in range(3)]))
    for w in (0.3, 0.8):
        rounded = points(ss.round(model, refine_long_edges="Off", roundness=w / (1 - w) / MU, **keywords)).reshape(3, -1, 3)
        weights = [w] if slider.linear else chain(root["meshes"][0]["extras"]["sphericalStyle"]["places"], w)
        moved = [GLTFFiles.points(root, binary, weights, k) for k in range(3)]
        for k in (0, 2):
            error = largest(posed(bones[k], moved[k]), rounded[k]) / diagonal(world)
            assert error < (3e-6 if slider.linear else 0.0015), (k, w, error)
        assert largest(moved[0], rest[0]) > 0.1 and (moved[1] == rest[1]).all(), "nothing moves what is shrunk to a point"

# ------------------------------------------------------------------------------------------ as other programs store it
# One ball, its points as floats, as floats of which a sparse accessor replaces some, all of them sparse, and as whole
# numbers of two bytes: they are rounded alike.
def of_points(add, **node):
    maker = GLTFFiles.Maker()
    maker.root |= {"meshes": [{"primitives": [{"attributes": {"POSITION": add(maker)},
                                               "indices": maker.add(F.ravel(), np.uint16)}]}],
                   "nodes": [{"mesh": 0, **node}], "scenes": [{"nodes": [0]}]}
    return maker


def sparse(maker, values, ids, **accessor):
    return {"count": len(values), "type": "VEC3", "componentType": 5126, **accessor,
            "sparse": {"count": len(ids), "indices": {"bufferView": maker.view(np.asarray(ids, np.uint16)),
                                                      "componentType": 5123},
                       "values": {"bufferView": maker.view(values[ids])}}}


def partly(maker):
    wrong = P.copy()
    wrong[::7] = 99
    number = maker.add(wrong)
    maker.root["accessors"][number] |= sparse(maker, P, np.arange(0, len(P), 7))
    return number


def wholly(maker):
    maker.root["accessors"].append(sparse(maker, P, np.flatnonzero((P != 0).any(axis=1))))
    return len(maker.root["accessors"]) - 1


P = (np.rint(ball()[0] * 1000) / 1000).astype(np.float32)
F = ball()[2]
stored = {"floats": of_points(lambda maker: maker.add(P)), "partly sparse": of_points(partly), "sparse": of_points(wholly),
          "whole numbers": of_points(lambda maker: maker.add(np.rint(P * 1000), np.int16), scale=[0.001] * 3),
          "shares of a number": of_points(lambda maker: maker.add(np.rint(P * 1000), np.int16, normalized=True),
                                          scale=[32.767] * 3)}
ends = {}
for name, maker in stored.items():
    slider, root, _ = write("stored-slider.glb", maker.save(os.path.join(folder, "stored.glb")), **plain)
    moves = root["meshes"][0]["primitives"][0]["targets"][0]["POSITION"]
    scale = root["nodes"][0].get("scale", [1])[0]
    ends[name] = P + scale * GLTFFiles.numbers(*GLTFFiles.load(os.path.join(folder, "stored-slider.glb")), moves)
    assert largest(ends[name], ends["floats"]) < 1e-5, (name, largest(ends[name], ends["floats"]))
assert largest(ends["floats"], P) > 0.1

# A buffer in a file beside the model: the result has to lie there, too.
two_files = os.path.join(folder, "in two files.gltf")
root = stored["floats"].root | {"buffers": [{"byteLength": len(stored["floats"].binary), "uri": "the%20buffer%4.bin"}]}
with open(two_files, "w", encoding="utf-8") as file:
    json.dump(root, file)
with open(os.path.join(folder, "the buffer%4.bin"), "wb") as file:
    file.write(stored["floats"].binary)
write("beside.gltf", two_files, **plain)
assert GLTFFiles.load(os.path.join(folder, "beside.gltf"))[0]["buffers"][0] == root["buffers"][0]

# From JSON with a buffer in it, to both kinds.
source = os.path.join(folder, "scene.glb")
text = os.path.join(folder, "scene.gltf")
ss.write_slider(text, source, **plain)
for name in ("again.glb", "again.gltf"):
    slider, root, binary = write(name, text, **plain)
    assert len(root["meshes"][0]["primitives"][0]["targets"]) == 3 and len(root["buffers"]) == (1 if name.endswith("b") else 2)
assert ss.read(os.path.join(folder, "again.glb")).GetNumberOfPoints() > 0

# ------------------------------------------------------------------------------------------------- what cannot be
sys.stdout.flush()


def refused(call, *words):
    try:
        call()
    except (ss.Error, ValueError, TypeError) as error:
        assert all(word in str(error) for word in words), error
        return str(error)
    raise AssertionError(f"not refused: {words}")


good = os.path.join(folder, "x.glb")
refused(lambda: ss.write_slider("x.ply", creature), "x.ply", ".glb and .gltf")
refused(lambda: ss.write_slider(good, creature, maximum_roundness=-1), "maximum_roundness must be 0.01 to 1000")
refused(lambda: ss.write_slider(good, creature, roundness=-1), "roundness must be", "-1")
refused(lambda: ss.write_slider(good, creature, roundnes=1), "roundnes")
refused(lambda: ss.write_slider(good, os.path.join(folder, "none.glb")), "no such file")
refused(lambda: ss.write_slider(os.path.join(folder, "no", "x.glb"), creature), "x.glb", "cannot be written")
cloud = vtkPointSource()
cloud.Update()
refused(lambda: ss.write_slider(good, cloud.GetOutput()), "no faces")
assert not os.path.exists(good)

# A disk that is full, or as good as: the file of before stays, and nothing of the new one.
own = os.path.join(folder, "own.glb")
with open(own, "rb") as file:
    before = file.read()
old = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
limit = resource.getrlimit(resource.RLIMIT_FSIZE)
resource.setrlimit(resource.RLIMIT_FSIZE, (len(before) // 2, limit[1]))
try:
    messages = Messages(writer)
    assert writer.Write() == 0 and "is there space" in messages.errors[0], messages.errors
finally:
    resource.setrlimit(resource.RLIMIT_FSIZE, limit)
    signal.signal(signal.SIGXFSZ, old)
with open(own, "rb") as file:
    assert file.read() == before
assert not os.path.exists(own + ".part")


def with_file(content):
    path = os.path.join(folder, "bad.glb")
    with open(path, "wb") as file:
        file.write(content)
    return lambda: ss.write_slider(good, path, **plain)


def changed(change):
    maker = make_scene()
    change(maker.root)
    return with_file(maker.bytes())


refused(with_file(b""), "bad.glb", "not glTF")
refused(with_file(b"solid nothing"), "bad.glb", "not glTF")
refused(with_file(b"[" * 100000), "nested")
refused(with_file(b'{"asset": {"version": "1.0"}}'), "version 1.0")
refused(with_file(b'{"asset": {"version": "2.0"}}'), "no triangles")
refused(changed(lambda root: root.update(extensionsRequired=["KHR_draco_mesh_compression"])), "gltf-transform")
refused(changed(lambda root: root["nodes"][6].update(children=[0])), "not a tree")
refused(changed(lambda root: root["nodes"][3].update(scale=[0, 1, 1])), "node 3", "flattened")
refused(changed(lambda root: root["nodes"][3].update(scale=[1, 1])), "node 3", "scale must be 3 numbers")
refused(changed(lambda root: root["nodes"][3].update(mesh=9)), "node 3", "item 9")
refused(changed(lambda root: root["skins"][0].update(joints=[5])), "mesh 1, primitive 0, point ", "only 1 joints")
refused(changed(lambda root: root["skins"][0].update(joints=[5, 6, 7])), "skin 0", "2 inverse bind matrices for 3 joints")
refused(changed(lambda root: root["skins"][0].update(joints=[])), "skin 0", "no joints")
refused(changed(lambda root: root["skins"][0].update(joints=[5, "x"])), "skin 0", "not numbers of nodes")
refused(changed(lambda root: root["meshes"][1]["primitives"][0]["attributes"].update(WEIGHTS_0=1)), "VEC4")
refused(changed(lambda root: root["accessors"][1].update(count=10 ** 7)), "accessor 1", "leads out of bufferView")
refused(changed(lambda root: root["accessors"][1].update(count=-1)), "accessor 1", "whole number")
refused(changed(lambda root: root["accessors"][1].update(componentType=7)), "componentType 7")
refused(changed(lambda root: root["bufferViews"][2].update(byteOffset=10 ** 9)), "bufferView 2", "leads out of buffer 0")
refused(changed(lambda root: root["meshes"][0]["primitives"][0].update(indices=2)), "SCALAR")
refused(changed(lambda root: root["nodes"][3].update(translation=[0, 0, 1e300])), "mesh 2, primitive 0, point 0", "node 3")
few = {"count": 1, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 2}}
refused(changed(lambda root: root["accessors"].__setitem__(1, {"componentType": 5126, "type": "VEC3", "count": 10 ** 8,
                                                               "sparse": few})), "accessor 1", "elements without data")


def text(**more):
    return with_file(json.dumps({"asset": {"version": "2.0"}, **more}).encode())


refused(text(buffers=[{"byteLength": 4, "uri": "/dev/zero"}]), "buffer 0", "/dev/zero", "is a device")
refused(text(buffers=[{"byteLength": 4, "uri": "https://host/a.bin"}]), "buffer 0", "not a file beside")
os.mkdir(os.path.join(folder, "sub"))
refused(text(buffers=[{"byteLength": 4, "uri": "sub"}]), "buffer 0", "the file sub is a folder")
refused(text(buffers=[{"byteLength": 4, "uri": "none.bin"}]), "buffer 0", "the file none.bin cannot be read")
refused(text(buffers=[{"byteLength": 4, "uri": "data:,1234"}]), "buffer 0", "not base64")
refused(text(buffers=[{"byteLength": 4, "uri": "data:;base64,12 4"}]), "buffer 0", "not base64")
refused(text(buffers=[{"byteLength": 4, "uri": "data:;base64,AAAA"}]), "buffer 0", "3 bytes of 4")
refused(text(buffers=[{"byteLength": 4, "uri": "\u00e9" * 99}]), "buffer 0", "the file " + "\u00e9" * 50 + "... cannot be")
refused(lambda: ss.write_slider(os.path.join(folder, "sub", "x.gltf"), two_files), "the buffer%4.bin", "the same folder")
refused(with_file(b"glTF\1\0\0\0" + bytes(20)), "bad.glb", "version 1")
refused(with_file(b"glTF\2\0\0\0\24\0\0\0" + bytes(8)), "bad.glb", "cut off")
refused(changed(lambda root: root["accessors"][1].update(count=10 ** 9)), "accessor 1", "too many elements, 1000000000")
refused(changed(lambda root: root["accessors"][1].pop("bufferView")), "accessor 1", "has no data")
refused(changed(lambda root: root["skins"][0].update(joints=[5, 0.5])), "skin 0", "not numbers of nodes")
refused(changed(lambda root: root["meshes"][1]["primitives"][0]["attributes"].update(JOINTS_0=0)), "VEC4")
refused(changed(lambda root: root["accessors"][5].update(count=4)), "mesh 1, primitive 0", "joints for 4 and weights for 325")
refused(changed(lambda root: root["accessors"][2].update(count=4)), "mesh 0, primitive 0", "4 normals for 325 points")
refused(changed(lambda root: root["meshes"][0]["primitives"].append({**root["meshes"][0]["primitives"][0], "targets": []})),
        "mesh 0", "different numbers of morph targets")
for words, change in (
        ("sparse indices lead out of their bufferView", lambda item: item["sparse"]["indices"].update(byteOffset=10 ** 6)),
        ("sparse values lead out of their bufferView", lambda item: item["sparse"]["values"].update(byteOffset=10 ** 6)),
        ("sparse indices lead out of it", lambda item: item.update(count=3)),
        ("has no sparse indices", lambda item: item["sparse"].pop("indices"))):
    maker = of_points(partly)
    change(maker.root["accessors"][0])
    refused(with_file(maker.bytes()), "accessor 0", words)
for long in (text(buffers=[{"byteLength": 4, "uri": "x" * 9999}]), text(nodes=[{"mesh": [0.5] * 9999}], scenes=[{"nodes": [0]}]),
             with_file(b'{"asset": {"version": "2.0' + b"0" * 9999)):
    assert len(refused(long, "bad.glb")) < 500 + len(folder)
for cut in range(0, len(original) - len(other), 97):
    refused(with_file(original[:cut]), "bad.glb")


def places_in(value, path=()):
    """The paths of all that the value holds."""
    for key, item in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield path + (key,)
        yield from places_in(item, path + (key,))


# Whatever stands in any place of the JSON, there is a file or one message, which is ours.
outcomes = {"written": 0, "refused": 0}
for path in places_in(GLTFFiles.figure().root):
    for value in (-1, 999, 0.5, 1e300, 2 ** 64 - 1, None, True, "x", [], {}, [5], {"a": 1}):
        maker = GLTFFiles.figure()
        holder = functools.reduce(lambda item, key: item[key], path[:-1], maker.root)
        holder[path[-1]] = value
        try:
            with_file(maker.bytes())()
            outcomes["written"] += 1
        except ss.Error as error:
            outcomes["refused"] += 1
            of_filter = "the filter", "RadiusMode EqualArea: the area"
            assert str(error).startswith((os.path.join(folder, "bad.glb"), *of_filter)), error
            assert "json.exception" not in str(error), error
print("changed files:", outcomes)
assert min(outcomes.values()) > 400
