# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""sphericalstyle.round: the result is the filter's to the bit, for every kind of mesh; what cannot be is said.

usage: TestRound.py DATA_FOLDER PAGE...
PAGE: of the documentation; its examples in Python are run.
"""
import ast
import contextlib
import doctest
import functools
import inspect
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import types
import warnings

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkSphereSource

import FilterTable
import SurfaceTesting
import sphericalstyle as ss
from sphericalstyle import (handles, meshes, model_files, part_sizes, presets, printing, properties, rounding,
                            surface_parts)
from SurfaceTesting import faces, points

data = os.path.abspath(sys.argv[1])
read = functools.partial(SurfaceTesting.read, data)


def filtered(surface, prepare=lambda style: None, **values):
    """The filter's own result; values by the names of VTK."""
    style = ss.vtkSphericalStyleFilter()
    style.SetInputData(surface)
    prepare(style)
    for name, value in values.items():
        getattr(style, "Set" + name)(value)
    style.Update()
    return style.GetOutput()


def same(a, b):
    return a.shape == b.shape and a.dtype == b.dtype and np.array_equal(a, b)


def fails(kind, words, *arguments, of=ss.round, **keywords):
    """round(), or another function, raises exactly this kind of exception, with these words, and prints nothing."""
    window, printed = vtkOutputWindow.GetInstance(), vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(printed)
    try:
        of(*arguments, **keywords)
    except Exception as error:
        assert type(error) is kind, (kind, repr(error))
        assert words in str(error), (words, str(error))
    else:
        raise AssertionError(f"no {kind.__name__} for {keywords}")
    finally:
        vtkOutputWindow.SetInstance(window)
    assert not printed.GetOutput(), (keywords, printed.GetOutput())


creature = read("creature.vtp")
before = points(creature).copy()
P, F = before, faces(creature)
expected = filtered(creature)

# ------------------------------------------------------------------------------------------------ kinds of meshes
result = ss.round(creature)
assert type(result) is type(creature) and isinstance(result, vtkPolyData) and result is not creature
assert same(points(result), points(expected)) and same(faces(result), faces(expected))
assert not np.array_equal(points(result), before) and same(points(creature), before), "the mesh itself stays"
names = [expected.GetPointData().GetArrayName(k) for k in range(expected.GetPointData().GetNumberOfArrays())]
assert [result.GetPointData().GetArrayName(k) for k in range(len(names))] == names

Q, G = ss.round((P, F))
assert type(Q) is np.ndarray and same(Q, points(expected)) and same(G, F) and G is not F
Q, G = ss.round((P.astype(np.float64), F.astype(np.int32)), refine_long_edges="Off")
assert Q.dtype == np.float64 and np.allclose(Q, points(expected), atol=1e-5) and G.dtype == np.int32
Q, G = ss.round([P.tolist(), F.tolist()])
assert Q.dtype == np.float64 and G == F.tolist()
blocks = vtkMultiBlockDataSet()
blocks.SetBlock(0, creature)
assert same(points(ss.round(blocks).GetBlock(0)), points(expected))

# A box of quads: its long edges are split, and all faces with them; or it keeps its faces, in its own numbers.
box = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 3)])
quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]], dtype=np.uint16)
Q, G = ss.round((box, quads))
assert G.dtype == np.uint16 and G.shape[1] == 3 and len(Q) > len(box) and G.max() == len(Q) - 1
Q, G = ss.round((box, quads), refine_long_edges="Off")
assert Q.shape == box.shape and Q.dtype == np.float64 and same(G, quads)
mixed = [[0, 1, 3], [0, 3, 2], *quads[1:].tolist()]
assert ss.round((box, mixed), refine_long_edges="Off")[1] == mixed
Q, G = ss.round((box, mixed))
assert len(G) > len(mixed) and all(len(face) == 3 and max(face) < len(Q) for face in G)


class Mesh:
    """As those of trimesh: made of vertices and faces, with things of its own that a copy keeps."""

    def __init__(self, vertices, faces, process=True):
        assert not process
        self.vertices, self.faces, self.color = np.asarray(vertices), np.asarray(faces), "blue"

    def copy(self):
        other = Mesh(self.vertices.copy(), self.faces.copy(), process=False)
        other.color = self.color
        return other


mesh = Mesh(P, F, process=False)
mesh.color = "red"
result = ss.round(mesh)
assert type(result) is Mesh and result is not mesh and result.color == "red"
assert same(result.vertices, points(expected)) and same(result.faces, F) and same(mesh.vertices, before)
result = ss.round(Mesh(box, quads, process=False))
assert type(result) is Mesh and len(result.vertices) > len(box) and result.faces.shape[1] == 3
plain = types.SimpleNamespace(vertices=P, faces=F)
assert same(ss.round(plain).vertices, points(expected)) and same(plain.vertices, before)
fails(TypeError, 'refine_long_edges="Off" keeps the faces', type("Odd", (), {"vertices": box, "faces": quads})())

# ---------------------------------------------------------------- like PyVista: TestPyVista.py has PyVista itself
pyvista = types.ModuleType("pyvista")
pyvista.DataObject = type("DataObject", (), {})
pyvista.PolyData = type("PolyData", (vtkPolyData, pyvista.DataObject), {})
pyvista.registered = {}
pyvista.register_dataset_accessor = lambda name, kind: lambda cls: pyvista.registered.update({name: (kind, cls)})


def wrap(surface):
    wrapped = pyvista.PolyData()
    wrapped.ShallowCopy(surface)
    return wrapped


pyvista.wrap = wrap
sys.modules["pyvista"] = pyvista
cloth = wrap(creature)
rounding._register_accessor()
kind, accessor = pyvista.registered["spherical_style"]
assert kind is pyvista.PolyData
assert same(points(accessor(cloth).round(roundness=2.0)), points(filtered(creature, Roundness=2.0)))
result = ss.round(cloth, preset="Chibi")
assert isinstance(result, pyvista.PolyData) and result is not cloth
assert same(points(result), points(filtered(creature, lambda style: presets.apply(style, "Chibi"))))

# ------------------------------------------------------------------------------------------- presets and properties
with open(os.path.join(os.path.dirname(sys.argv[2]), "SphericalStyle.md"), encoding="utf-8") as file:
    rows = re.findall(r"^\| (\w+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|", file.read(), re.MULTILINE)
assert {name: [float(value) for value in values] for name, *values in rows} == {
    name: [preset.properties[property_] for property_ in ("Roundness", "NormalBlend", "DetailSize")]
    for name, preset in presets.PRESETS.items()}, "the table of the page"
for name in presets.PRESETS:  # what they are is not advised against
    for model in ("creature.vtp", "snowman.vtp"):
        style = ss.vtkSphericalStyleFilter()
        presets.apply(style, name)
        style.SetInputData(read(model))
        style.Update()
        advised = style.GetAdvice().partition(" ")[0]
        assert advised not in presets.PRESETS[name].properties, (name, model, style.GetAdvice())
    assert same(points(ss.round(creature, preset=name)),
                points(filtered(creature, lambda style: presets.apply(style, name)))), name
assert same(points(ss.round(creature, preset="Ball", roundness=1.2)),
            points(filtered(creature, lambda style: presets.apply(style, "Ball"), Roundness=1.2)))
assert same(points(ss.round(creature, keep_size="Volume", keep_on_ground=True, up_axis="z", normal_radius="whole_model",
                            output_points_precision="Double", number_of_threads=1)),
            points(filtered(creature, KeepSize=2, KeepOnGround=True, UpAxis=2, NormalRadius=1, OutputPointsPrecision=1)))
center = (0.1, 0.2, 0.3)
assert same(points(ss.round(creature, center=center, radius=0.5, normal_blend=0)),
            points(filtered(creature, Center=center, CenterMode=2, Radius=0.5, RadiusMode=2, NormalBlend=0.0)))
assert same(points(ss.round(creature, center=center, center_mode="PointMean")), points(filtered(creature, CenterMode=0)))
assert same(points(ss.round(creature, roundness=None, preset=None)), points(expected))

# Every property of the class is a keyword, each choice is one of its values, and both show in help().
style = ss.vtkSphericalStyleFilter()
known = properties.properties()
for keyword, property_ in known.items():
    for value, choice in enumerate(property_.choices):
        property_.set(style, choice)
        assert getattr(style, "Get" + property_.name)() == value, (keyword, choice)
    assert property_.description, keyword
enumerations = {name for name, property_ in known.items() if property_.choices}
table = FilterTable.FILTERS["SphericalStyleFilter"]
assert enumerations >= {properties.keyword_of(name) for name in table["enumerations"]}, enumerations
assert set(known) >= {properties.keyword_of(name) for name in table["known"]}
arrays = [properties.keyword_of(name[:-len("Array")]) for name in table["arrays"]]
assert list(rounding.ARRAYS) == arrays and list(rounding.ARRAYS.values()) == list(range(len(arrays)))
signature = inspect.signature(ss.round).parameters
assert list(signature)[:3] == ["mesh", "preset", "roundness"] and set(known) <= set(signature)
assert signature["keep_size"].default == "Area" and signature["roundness"].default == style.GetRoundness()

# The types for editors say the same.
with open(os.path.join(os.path.dirname(ss.__file__), "__init__.pyi"), encoding="utf-8") as file:
    functions = {node.name: node for node in ast.parse(file.read()).body if isinstance(node, ast.FunctionDef)}
assert {"round", "read", "write"} <= set(functions) and all(callable(getattr(ss, name)) for name in functions)
function = functions["round"]
assert [argument.arg for argument in function.args.kwonlyargs] == list(signature)[1:]
for argument in function.args.kwonlyargs:
    words = re.findall(r"'(\w+)'", ast.unparse(argument.annotation))
    choices = list(presets.PRESETS) if argument.arg == "preset" else \
        known[argument.arg].choices if argument.arg in known else ()
    assert words == list(choices), (argument.arg, words)
assert os.path.exists(os.path.join(os.path.dirname(ss.__file__), "py.typed"))

# --------------------------------------------------------------------------------------------- values of each point
height = P[:, 1].astype(float)
upper = height > np.median(height)
result = ss.round(creature, region=upper)
assert same(points(result)[~upper], before[~upper]) and not np.array_equal(points(result)[upper], before[upper])
assert not result.GetPointData().HasArray("region") and not creature.GetPointData().HasArray("region")
assert same(ss.round((P, F), region=upper.tolist())[0], points(result))
named = vtkPolyData()
named.ShallowCopy(creature)
mask = numpy_to_vtk(upper.astype(float), deep=True)
mask.SetName("region")
named.GetPointData().AddArray(mask)
assert same(points(ss.round(named, region="region")), points(result))
again = ss.round(named, region=~upper)  # not to be mixed up with that of the mesh
assert same(points(again)[upper], before[upper])
assert np.array_equal(vtk_to_numpy(again.GetPointData().GetArray("region")), upper)
half = np.full(len(P), 0.5)
assert np.allclose(points(ss.round(creature, roundness_factor=half)), points(filtered(creature, Roundness=0.5)), atol=1e-6)
assert np.allclose(points(ss.round(creature, normal_blend=half)), points(filtered(creature, NormalBlend=0.5)), atol=1e-6)
ids = upper.astype(int)
two = ss.round(creature, center_id=ids, centers=[[0, -1, 0], [0, 1, 0]])
assert not np.array_equal(points(two), points(ss.round(creature, center_id=ids)))

# ------------------------------------------------------------------------------------------------ what cannot be done
fails(TypeError, "round() has no keyword 'roundnes'; did you mean 'roundness'?", creature, roundnes=2)
fails(TypeError, "did you mean 'keep_on_ground'?", creature, KeepOnGround=True)
fails(TypeError, "round() has no keyword 'xyzzy'", creature, xyzzy=1)
fails(ValueError, "there is no preset 'Toyy', only Soft, Toy", creature, preset="Toyy")
fails(ValueError, "normal_blend must be 0 to 1; it is 1.5", creature, normal_blend=1.5)
fails(ValueError, "roundness must be finite and 0 or more; it is -1", creature, roundness=-1)
fails(ValueError, "roundness must be a number; it is nan", creature, roundness=float("nan"))
fails(ValueError, "number_of_threads must be 0 to 1024; it is -1", creature, number_of_threads=-1)
fails(ValueError, f"maximum_number_of_iterations must be 0 or more; it is {2**40}", creature,
      maximum_number_of_iterations=2**40)
fails(ValueError, 'keep_size must be "Off", "Area", "Volume" or "Extent"; it is \'Mass\'', creature, keep_size="Mass")
fails(TypeError, "keep_size must be", creature, keep_size=1)
fails(TypeError, "roundness must be a number; it is 'two'", creature, roundness="two")
fails(TypeError, "number_of_threads must be a whole number", creature, number_of_threads=1.5)
fails(TypeError, "keep_on_ground must be True or False", creature, keep_on_ground="yes")
fails(TypeError, "center must be three numbers", creature, center=(1, 2))
# A rest pose: the same mesh moved as a whole gets the moved result.
turn = np.array([[0.28, 0, 0.96], [0, 1, 0], [-0.96, 0, 0.28]])
turned, _ = ss.round((P @ turn.T + 3, F), rest_pose=(P, F), refine_long_edges="Off")
still, _ = ss.round((P.astype(float), F), refine_long_edges="Off")
assert np.abs(turned - (still @ turn.T + 3)).max() < 1e-6
fails(ss.Error, "rest pose has 3 points", (P, F), rest_pose=(P[:3], F[:0]))
fails(TypeError, "centers needs center_id", creature, centers=[[0, 0, 0]])
fails(ValueError, f"region must have a value for each of the {len(P)} points; it has 3", creature, region=[1, 0, 1])
fails(ValueError, "region must be an array", creature, region=["a"] * len(P))
fails(ss.Error, 'Region: there is no numeric point array "nothing"', creature, region="nothing")
fails(TypeError, "round() takes a vtkPolyData, a PyVista mesh", 3)
fails(ValueError, "points must be an array of n x 3 numbers; it is 5 x 2 of float64", (np.zeros((5, 2)), F))
fails(ValueError, "faces must be an array of m x 3", (P, F.ravel()))
fails(ValueError, "faces must be an array of m x 3", (P, F.astype(float)))
counted = np.insert(F, 0, 3, axis=1)  # as PyVista has them
fails(ValueError, "each face begins with 3", (P, counted))
fails(ValueError, "each face begins with 3", (P, counted.tolist()))
fails(ss.Error, f"names point {len(P)}, the input has {len(P)}", (P, [[0, 1, len(P)]]))
bad = P.copy()
bad[7] = np.nan
fails(ss.Error, "Points: point 7 is not finite", (bad, F))
fails(ss.Error, "not a surface (vtkPolyData)", vtkUnstructuredGrid())
flat = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
fails(ss.Error, "KeepSize", (flat, [[0, 1, 2]]), keep_size="Volume")

# --------------------------------------------------------------------------------------------------------------- files
with tempfile.TemporaryDirectory() as folder:
    place = pathlib.Path(folder) / "round.vtp"
    ss.write(place, creature)
    assert same(points(ss.read(str(place))), points(creature))
    ss.write(os.path.join(folder, "arrays.ply"), (P, F))
    again = ss.read(os.path.join(folder, "arrays.ply"))
    assert np.allclose(points(again), P, atol=1e-6) and again.GetNumberOfPolys() == len(F)
    for path, words in (("nothing.ply", "no such file"), ("round.xyz", "cannot read files .xyz; known: ")):
        fails(model_files.ModelError, words, os.path.join(folder, path), of=ss.read)
    fails(model_files.ModelError, "cannot write files .xyz; known: ", os.path.join(folder, "round.xyz"), creature,
          of=ss.write)
    fails(model_files.ModelError, "a vtkUnstructuredGrid is not a surface", place, vtkUnstructuredGrid(), of=ss.write)
    fails(TypeError, "write() takes a vtkPolyData", place, 3, of=ss.write)
    assert sorted(os.listdir(folder)) == ["arrays.ply", "round.vtp"]

# A warning is Python's, and nothing is printed: not for an error either.
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    assert same(ss.round((flat, [[0, 1, 1]]))[0], flat)
assert {item.category for item in caught} == {ss.StyleWarning} and caught[0].filename == __file__
assert any("no triangle with an area" in str(item.message) for item in caught), [str(item.message) for item in caught]
if os.path.isfile(sys.executable):  # pvpython names a program that there is not
    quiet = subprocess.run([sys.executable, "-c", "import sphericalstyle as ss\ntry:\n  ss.round(([[0,0,float('nan')]],"
                            " [[0,0,0]]))\nexcept ss.Error as error:\n  print(error)"],
                           check=True, capture_output=True, text=True)
    assert "not finite" in quiet.stdout and quiet.stderr == "", quiet

# Python's own round stays what it is, and window is found without an import of its own where there is ParaView.
namespace = {}
exec("from sphericalstyle import *", namespace)
assert not set(functions) & set(namespace) and "vtkSphericalStyleFilter" in namespace and "presets" in namespace
try:
    ss.nothing
    raise SystemExit("there is no such attribute")
except AttributeError as error:
    assert "nothing" in str(error)

# ---------------------------------------------------------------------------- misspelled attributes of the classes
if hasattr(ss.vtkSphericalStyleFilter, "override"):
    style = ss.vtkSphericalStyleFilter()
    for attribute in ("Roundnes", "Roundness", "roundnes"):
        if hasattr(ss.vtkSphericalStyleFilter, attribute):
            continue
        try:
            setattr(style, attribute, 3)
            raise SystemExit(f"{attribute} was taken")
        except AttributeError as error:
            assert str(error) == f"vtkSphericalStyleFilter has no attribute '{attribute}'; did you mean SetRoundness()?"
    style._mine = 3  # what begins with an underscore is the user's own
    assert style._mine == 3 and isinstance(style, ss.vtkSphericalStyleFilter)
    assert isinstance(style, ss.vtkStyleAlgorithm) and style.GetClassName() == "vtkSphericalStyleFilter"
    thesis = ss.vtkThesisStyleFilter()
    assert isinstance(thesis, ss.vtkSphericalStyleFilter) and isinstance(thesis, ss.vtkThesisStyleFilter)
    thesis.SetAnchorToLastPoint()
    source = vtkSphereSource()
    style.SetInputConnection(source.GetOutputPort())
    assert style.GetOutputPort().GetProducer() is style

    class Own(ss.vtkSphericalStyleFilter):
        """May have any attribute."""

        def __init__(self):
            self.reader = source

    assert Own().reader is source and isinstance(Own(), ss.vtkSphericalStyleFilter)

# --------------------------------------------------------------------------------------------------------------- parts
ids = ss.parts(creature)
taller = ss.resize(creature, head_height=0.8, parts=ids)
assert type(taller) is type(creature) and not taller.GetPointData().HasArray("parts of sphericalstyle")
array_of = ss.resize((points(creature), faces(creature)), head_height=0.8, parts=ids)
assert np.allclose(array_of[0], points(taller), atol=1e-6)
assert same(points(ss.resize(creature)), points(creature))
assert not same(points(ss.resize(creature, {1: 1.2})), points(creature))
with warnings.catch_warnings(record=True) as caught:  # those of who calls
    warnings.simplefilter("always")
    ss.parts(creature, 200)
    ss.resize(creature, {77: 2}, parts=ids)
assert [os.path.samefile(warning.filename, __file__) for warning in caught] == [True, True], caught
assert "77" in str(caught[1].message), caught[1]
for wrong, words in (({"parts": ids[1:]}, "values for"), ({"up_axis": "up"}, ""), ({"sizes": {1: -2}}, "above 0")):
    try:
        ss.resize(creature, **wrong)
        raise AssertionError(wrong)
    except (ValueError, ss.Error) as error:
        assert words in str(error), error
for wrong, words in ((1.3, "not 1.3"), ([(1, 1.3)], "such as {0: 1.3}"), ({"head": 1.3}, "whole numbers"),
                     ({1.5: 1.3}, "not 1.5"), ({True: 1.3}, "not True"), ({1: "large"}, "value of part 1")):
    try:
        ss.resize(creature, wrong)
        raise AssertionError(wrong)
    except TypeError as error:
        assert words in str(error), error
assert same(points(ss.resize(creature, {np.int32(1): np.float32(1.5)}, parts=ids)),
            points(ss.resize(creature, {1: 1.5}, parts=ids)))
# What round() refuses, the others refuse likewise.
top = [{"place": (0, 1, 0)}]
for function, keyword, value, kind, words in (
        (ss.resize, "blend_width", 5, ValueError, "blend_width must be 0.01 to 1; it is 5"),
        (ss.resize, "head_height", -1, ValueError, "head_height must be 0 or more; it is -1"),
        (ss.resize, "up_axis", "up", ValueError, "up_axis must be \"X\", \"Y\" or \"Z\"; it is 'up'"),
        (ss.parts, "number", 999, ValueError, "number must be 0 to 256; it is 999"),
        (ss.parts, "number", 1.5, TypeError, "number must be a whole number; it is 1.5"),
        (ss.deform, "tolerance", 2, ValueError, "tolerance must be 1e-14 to 0.5; it is 2"),
        (ss.deform, "maximum_iterations", -1, ValueError, "maximum_iterations must be 0 or more; it is -1"),
        (ss.printable, "foot_area", 3, ValueError, "foot_area must be 0 to 1; it is 3"),
        (ss.printable, "height", -1, ValueError, "height must be 0 or more; it is -1"),
        (ss.printable, "close_holes", "x", TypeError, "close_holes must be True or False; it is 'x'")):
    if function is ss.printable and not hasattr(ss, "vtkPrintableFilter"):  # without CGAL
        continue
    try:
        function(creature, **{keyword: value}, **({"handles": top} if function is ss.deform else {}))
        raise AssertionError(words)
    except (TypeError, ValueError) as error:
        assert (type(error), str(error)) == (kind, words), error
# Ears, 7 and 8, go along with the head.
assert same(points(ss.resize(creature, {0: 1.3}, parts=ids)),
            points(ss.resize(creature, {0: 1.3, 7: 1.3, 8: 1.3}, parts=ids)))

# A part that is not rounded moves as a whole, but for where it passes into the next: the centroid of the model stays.
options = {"detail_size": 0.0, "keep_size": "Off", "refine_long_edges": "Off"}
head = ids == 0
bent = []
for rounded in (ss.round(creature, part_roundness={0: 0.0}, parts=ids, **options), ss.round(creature, **options)):
    moved = (points(rounded) - points(creature))[head]
    bent.append(np.median(np.linalg.norm(moved - np.median(moved, axis=0), axis=1)))
assert bent[0] < 0.15 * bent[1], bent
still = ss.round(creature, part_roundness={0: 0.0})
assert not still.GetPointData().HasArray("PartRoundness") and not still.GetPointData().HasArray("PartNormalBlend")
assert not same(points(ss.round(creature, part_normal_blend={0: 0.0})), points(ss.round(creature)))
for wrong, words in (({"parts": ids}, "needs part_roundness"), ({"part_roundness": 2.0}, "part_roundness must be a dict"),
                     ({"part_normal_blend": {"head": 0.5}}, "part_normal_blend: parts are whole numbers")):
    try:
        ss.round(creature, **wrong)
        raise AssertionError(wrong)
    except TypeError as error:
        assert words in str(error), error
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    assert same(points(ss.round(creature, part_roundness={99: 2.0}, parts=ids)), points(ss.round(creature)))
assert [warning for warning in caught if "99" in str(warning.message)], caught
try:
    ss.round(creature, part_normal_blend={0: 2.0}, parts=ids)
    raise AssertionError("out of range")
except (ValueError, ss.Error) as error:
    assert "NormalBlend of part 0 must be in 0..1" in str(error), error

# ------------------------------------------------------------------------------------------------------------- handles
low, high = before[before[:, 1].argmin()], before[before[:, 1].argmax()]
pin = {"place": low, "radius": 0.1}
up = {"place": high, "to": high + [0.0, 0.3, 0.1], "rotation": (0, 40, 0)}
posed = ss.deform((before.astype(float), F), [pin, up])
assert isinstance(posed, tuple) and posed[0].dtype == float
pinned = np.linalg.norm(before - low, axis=1) <= 0.1
assert pinned.sum() > 3 and same(posed[0][pinned], before[pinned].astype(float)), "pinned points keep their bits"
assert same(posed[0][before[:, 1].argmax()], np.asarray(up["to"], dtype=float)), "the place of a handle goes where it says"
assert same(ss.deform((before.astype(float), F), [(low, 0.1), (high, 0, up["to"], up["rotation"])])[0], posed[0])
assert same(points(ss.deform(creature, [])), points(creature))
for wrong, words in ((pin, "handle 1"), ([{"radius": 1}], "must have a place"), ([{**pin, "turn": 1}], "turn"),
                     ([7], "not 7"), ([{"place": 7}], "handle 1: place"), ([((0, 0), 1)], "3 numbers, not 2"),
                     ([pin, {**pin, "radius": 0.2}], "row 1 and row 2 both hold point"),
                     ([{**pin, "radius": -1}], "0 or more"), ([{**pin, "to": (0, np.nan, 0)}], "not finite")):
    try:
        ss.deform(creature, wrong)
        raise AssertionError(wrong)
    except (TypeError, ValueError, ss.Error) as error:
        assert words in str(error), error

# ----------------------------------------------------------------------------------------------------------- printable
if hasattr(ss, "vtkPrintableFilter"):
    printed = ss.printable((before, F), height=80, up_axis="y")
    assert isinstance(printed, tuple) and abs(np.ptp(printed[0][:, 2]) - 80) < 1e-4 and printed[0][:, 2].min() == 0
    assert (printed[0][:, 2] == 0).sum() > 10, "it has a foot"
    try:
        ss.printable((before, F[1:]), close_holes=False)
        raise AssertionError("an open mesh is refused")
    except ss.Error as error:
        assert "CloseHoles" in str(error), error

# ------------------------------------------------------------------------------------------------------------ examples
for module in (rounding, meshes, properties, part_sizes, surface_parts, handles,
               *([printing] if hasattr(ss, "vtkPrintableFilter") else [])):
    with contextlib.redirect_stdout(io.StringIO()) as said:  # pvpython's own stream has no encoding
        outcome = doctest.testmod(module)
    assert outcome.failed == 0, said.getvalue()
    assert module is not rounding or outcome.attempted > 0
for page in sys.argv[2:]:
    with open(page, encoding="utf-8") as file:
        examples = re.findall(r"^```python\n(.*?)^```", file.read(), re.MULTILINE | re.DOTALL)
    assert examples, page
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(data, os.path.join(folder, "Data"))
        os.chdir(folder)
        namespace = {}
        for example in examples:
            if "pyvista" not in example and "trimesh" not in example and "paraview" not in example:
                exec(compile(example, page, "exec"), namespace)
        os.chdir(data)
