# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""vtk3MFWriter, sphericalstyle.write and the program write 3MF: every bit of the points, the triangles, the unit, what
a slicer has to repair, and no file where there cannot be one.

usage: Test3MFWriter.py PROGRAM DATA_FOLDER
"""
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import warnings
import zipfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkStripper
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkPointSource, vtkSphereSource

import SurfaceTesting
import ThreeMFFiles
import sphericalstyle as ss
from sphericalstyle.messages import Messages

program, data = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
folder = pathlib.Path(tempfile.mkdtemp())
MILLIMETERS = 1e-3, 1, 10, 25.4, 304.8, 1000  # of each unit


def surface(points, faces):
    """Of points in their own precision, and faces of any number of corners."""
    made, at, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    at.SetData(numpy_to_vtk(np.asarray(points), deep=True))
    for face in faces:
        cells.InsertNextCell(len(face), face)
    made.SetPoints(at)
    made.SetPolys(cells)
    return made


def write(mesh, name="model.3mf", unit=None):
    """What the class writes, and its warnings without what all have in common."""
    writer = ss.vtk3MFWriter()
    messages = Messages(writer)
    writer.SetFileName(os.fsencode(folder / name))
    writer.SetInputData(mesh)
    if unit is not None:
        writer.SetUnit(unit)
    assert writer.Write() == 1 and not messages.errors, messages.errors
    assert not (folder / (name + ".part")).exists()
    start, end = "The file is written, but a slicer has to repair the surface: it has ", ". The filter Printable "
    file = ThreeMFFiles.load(folder / name)
    length = np.ptp(np.array(file.points, float), axis=0).max() * MILLIMETERS[1 if unit is None else unit]
    tiny = [text for text in messages.warnings if "mm long" in text]
    assert len(tiny) == (length < 5) and all(f"only {length:.3g} mm long" in text for text in tiny), (length, tiny)
    told = []
    for text in messages.warnings:
        if text in tiny:
            continue
        assert text.startswith(start) and "fills holes" in text and "Surface Diagnostics" in text, text
        told += text[len(start):].partition(end)[0].split("; ")
    return file, told


def same_bits(texts, points):
    """Whether the texts are the points, to the bit, and the shortest ones."""
    kind = points.dtype.type
    numbers = np.array([[kind(text) for text in row] for row in texts])
    assert numbers.dtype == points.dtype
    shortest = all(len(text) <= len(str(number).removesuffix(".0"))
                   for row, line in zip(texts, numbers) for text, number in zip(row, line))
    return numbers.tobytes() == np.ascontiguousarray(points).tobytes() and shortest


def volume(P, F):
    return np.linalg.det(np.asarray(P, float)[np.asarray(F)]).sum() / 6


# ------------------------------------------------------------------------------------------- points and triangles
creature = SurfaceTesting.read(data, "creature.vtp")
file, told = write(creature)
P, F = SurfaceTesting.points(creature), SurfaceTesting.faces(creature)
assert told == [] and file.unit == "millimeter"
assert same_bits(file.points, P) and np.array_equal(file.triangles, F)
assert volume(file.points, file.triangles) > 0
size = (folder / "model.3mf").stat().st_size
print(f"creature: {len(P)} points, {len(F)} triangles, {size} bytes, {size / len(F):.1f} a triangle")
first = (folder / "model.3mf").read_bytes()
write(creature, "again.3mf")
assert (folder / "again.3mf").read_bytes() == first, "equal models make equal files"

# Numbers of all sizes, in both precisions: the smallest, the largest, zeros of both signs.
random = np.random.default_rng(1)
corners = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
for kind in (np.float32, np.float64):
    limits = np.finfo(kind)
    largest = float(limits.max) if kind is np.float32 else 1e300
    P = (random.standard_normal((4000, 3)) * 10.0 ** random.integers(-30, 30, (4000, 3))).astype(kind)
    P[:4] = [[0.0, -0.0, limits.tiny], [1, 0.1, -limits.tiny], [largest, -largest, 1 / 3], [1e-5, 1e22, 123456789]]
    P[4] = np.nextafter(kind(0), kind(1))  # the smallest of all
    faces = (corners + 4 * np.arange(1000)[:, None, None]).reshape(-1, 3)
    file, _ = write(surface(P, faces))
    assert same_bits(file.points, P) and np.array_equal(file.triangles, faces), kind
    assert file.points[0] == ["0", "-0", file.points[0][2]] and file.points[1][:2] == ["1", "0.1"], file.points[:2]

# Polygons and strips are cut, points at one place are one, points of no face are left out.
cube = vtkCubeSource()
cube.Update()
assert cube.GetOutput().GetNumberOfPoints() == 24
file, told = write(cube.GetOutput())
assert told == [] and len(file.points) == 8 and len(file.triangles) == 12
assert abs(volume(file.points, file.triangles) - 1) < 1e-15
sphere = vtkSphereSource()
sphere.Update()
stripper = vtkStripper()
stripper.SetInputData(sphere.GetOutput())
stripper.Update()
assert stripper.GetOutput().GetNumberOfStrips() > 0
strips, told = write(stripper.GetOutput())
polygons, _ = write(sphere.GetOutput())
assert told == [] and len(strips.triangles) == len(polygons.triangles) == sphere.GetOutput().GetNumberOfPolys()
assert np.isclose(volume(strips.points, strips.triangles), volume(polygons.points, polygons.triangles))

for number, name in enumerate(("micron", "millimeter", "centimeter", "inch", "foot", "meter")):
    assert write(cube.GetOutput(), unit=number)[0].unit == name
    writer = ss.vtk3MFWriter()
    getattr(writer, "SetUnitTo" + name.capitalize())()
    assert writer.GetUnit() == number == getattr(ss.vtk3MFWriter, name.upper())
messages = Messages(writer)
writer.SetUnit(6)
assert writer.GetUnit() == 5 and "Unit must be from 0 to 5" in messages.warnings[0]
assert ss.vtk3MFWriter().GetUnit() == 1
write(cube.GetOutput(), "Spielzeug \u00fc.3MF")

# -------------------------------------------------------------------------------------- what a slicer has to repair
unused = [[9.0, 9, 9]]  # before the others: messages count points of the input
box = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


def flaws(points, faces):
    shifted = [[k + 1 for k in face] for face in faces]
    file, told = write(surface(np.concatenate([unused, points]), shifted))
    assert same_bits(file.points, np.asarray(points, float)) and len(file.triangles) > 0
    return told


assert flaws(box, quads) == []
assert flaws(box, quads[1:]) == ["4 border edges, the first at point 1"]
assert flaws(box, [quad[::-1] for quad in quads]) == ["1 closed part with the inside out, the first at point 1"]
assert flaws(box, [quads[0][::-1], *quads[1:]]) == [
    "4 edges whose two faces disagree on the outside, the first at point 1"]
wall = [[3, 1, 9, 8]]  # on an edge of the box
assert flaws(np.concatenate([box, [[2, 1, 0], [2, 0, 0]]]), [*quads, *wall]) == [
    "3 border edges, the first at point 2", "1 edge of three or more faces, the first at point 2"]
inner = box / 2 + 0.25
hollow = [*quads, *([k + 8 for k in quad[::-1]] for quad in quads)]
assert flaws(np.concatenate([box, inner]), hollow) == [], "a cavity faces inward"
beside = np.concatenate([box, inner + 2])
assert flaws(beside, hollow) == ["1 closed part with the inside out, the first at point 9"]

# Parts that touch along an edge stay apart where their points are, as Printable leaves them.
touching = np.concatenate([box, box + [1, 1, 0]])
two = [*quads, *([k + 8 for k in quad] for quad in quads)]
assert flaws(touching, two) == []
shared = [[{8: 3, 12: 7}.get(k, k) for k in face] for face in two]
file, told = write(surface(touching, shared))
assert told == ["1 edge of three or more faces, the first at point 3"] and len(file.points) == 14, told
parts = ss.printable(surface(touching, shared), foot_area=0, stability_angle=0, place_on_plate=False)
file, told = write(parts)
assert told == [] and len(file.points) == 16, (told, len(file.points))

# A triangle without an area, between an edge and the two halves of it, closes the surface.
tip = np.array([[0.0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2], [1, 0, 0]])
split = [[0, 2, 4], [4, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 4, 1]]
file, told = write(surface(tip, split))
assert told == [] and np.array_equal(file.triangles, split) and same_bits(file.points, tip)
# One with a point twice, here after the points at one place are one, closes nothing.
again = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 4, 3], [0, 4, 2]]
file, told = write(surface(np.concatenate([tip[:4], tip[:1]]), again))
assert told == [] and len(file.points) == len(file.triangles) == 4

# ------------------------------------------------------------------------------------------------- what cannot be
sys.stdout.flush()
bad = box.copy()
bad[3, 1] = np.nan
cloud = vtkPointSource()
cloud.Update()
(folder / "folder.3mf").mkdir()
for mesh, name, words in (
        (cube.GetOutput(), "x.stl", "FileName must end in .3mf; it is "),
        (cube.GetOutput(), ".3mf/", "FileName must end in .3mf; it is "),
        (cube.GetOutput(), None, 'FileName must end in .3mf; it is ""'),
        (cube.GetOutput(), "no/x.3mf", "no/x.3mf: cannot be written; is there such a folder"),
        (cube.GetOutput(), "folder.3mf", "folder.3mf: cannot be written"),
        (vtkPolyData(), "x.3mf", "no faces"),
        (cloud.GetOutput(), "x.3mf", "no faces"),
        (surface(np.zeros((3, 3)), [[0, 1, 2]]), "x.3mf", "no triangle with three different points"),
        (surface(bad, quads), "x.3mf", "point 3"),
        (surface(box, [[0, 1, 9]]), "x.3mf", "names point 9, the input has 8")):
    writer = ss.vtk3MFWriter()
    messages = Messages(writer)
    if name:
        writer.SetFileName(os.fsencode(folder) + b"/" + name.encode())
    writer.SetInputData(mesh)
    before = sorted(folder.iterdir())
    assert writer.Write() == 0 and writer.GetErrorCode() != 0 and len(messages.errors) == 1, (name, messages.errors)
    assert words in messages.errors[0] and not messages.warnings, messages.errors
    assert sorted(folder.iterdir()) == before, "no file is left behind"

# What comes before has failed, and said so.
style = ss.vtkSphericalStyleFilter()
style.SetInputData(cube.GetOutput())
style.SetRoundness(-1)
messages = Messages(style)
writer = ss.vtk3MFWriter()
writer.SetFileName(os.fsencode(folder / "none.3mf"))
writer.SetInputConnection(style.GetOutputPort())
assert writer.Write() == 0 and writer.GetErrorCode() != 0 and not (folder / "none.3mf").exists()
assert len(messages.errors) == 1, messages.errors
style.SetRoundness(1)
assert writer.Write() == 1 and writer.GetErrorCode() == 0 and (folder / "none.3mf").exists()


def refused(path, mesh, *words):
    try:
        ss.write(path, mesh)
    except ss.Error as error:
        assert all(word in str(error) for word in words) and ".part" not in str(error), error
        return str(error)
    raise AssertionError(f"not refused: {words}")


text = refused(folder / "no" / "x.3mf", creature, "x.3mf: cannot be written; is there such a folder")
assert text.count("x.3mf") == 1, text
refused(folder / "x.3mf", cloud.GetOutput(), "x.3mf: cannot be written", "no faces")
refused(folder / "x.3mf", surface(box, [[0, 1, 9]]), "names point 9")

# A disk that is full, or as good as: the file of before stays, and nothing else.
old = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
limit = resource.getrlimit(resource.RLIMIT_FSIZE)
before = sorted(folder.iterdir())
resource.setrlimit(resource.RLIMIT_FSIZE, (20000, limit[1]))
try:
    refused(folder / "model.3mf", creature, "model.3mf: cannot be written", "space")
    refused(folder / "new.3mf", creature, "new.3mf: cannot be written", "space")
finally:
    resource.setrlimit(resource.RLIMIT_FSIZE, limit)
    signal.signal(signal.SIGXFSZ, old)
assert sorted(folder.iterdir()) == before and zipfile.ZipFile(folder / "model.3mf").testzip() is None

# ------------------------------------------------------------------------------------------- from Python, as a program
with warnings.catch_warnings():
    warnings.simplefilter("error")
    large = 10 * np.asarray(box)
    ss.write(folder / "toy.3mf", (large, [quad[:3] for quad in quads] + [[quad[0], *quad[2:]] for quad in quads]))
    assert len(ThreeMFFiles.load(folder / "toy.3mf").points) == 8
    if hasattr(ss, "vtkPrintableFilter"):
        warnings.simplefilter("ignore", ss.StyleWarning)  # of rounding
        toy = ss.round(creature, preset="Toy")
        warnings.simplefilter("error", ss.StyleWarning)
        toy = ss.printable(toy, height=80)
        ss.write(folder / "toy.3mf", toy)
        file = ThreeMFFiles.load(folder / "toy.3mf")
        assert same_bits(file.points, SurfaceTesting.points(toy))
        z = np.array(file.points, float)[:, 2]
        assert z.min() == 0 and abs(z.max() - 80) < 1e-5, (z.min(), z.max())
        # What stays where it was is placed by the file: as the filter places it.
        for up in "XYZ":
            filters = [ss.vtkPrintableFilter() for _ in range(2)]
            for place, printable in enumerate(filters):
                printable.SetInputData(creature)
                printable.SetUpAxis("XYZ".index(up))
                printable.SetHeight(80)
                printable.SetPlaceOnPlate(place)
                printable.Update()
            stays, _ = write(filters[0].GetOutput())
            placed, _ = write(filters[1].GetOutput())
            assert same_bits(stays.points, SurfaceTesting.points(filters[0].GetOutput()))
            assert placed.transform == [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]], placed.transform
            if up == "Z":
                assert stays.transform == placed.transform, "it stands already"
            else:
                difference = np.abs(np.array(stays.placed()) - np.array(placed.placed())).max()
                assert difference < 1e-5 and abs(np.linalg.det(stays.transform[:3]) - 1) == 0, difference
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    ss.write(folder / "open.3mf", surface(large, quads[1:]))
warning, = caught
assert warning.category is ss.StyleWarning and warning.filename == __file__, (warning.category, warning.filename)
assert "4 border edges, the first at point 0" in str(warning.message)


def run(*arguments):
    return subprocess.run([program, *map(str, arguments)], check=True, text=True, capture_output=True)


done = run(os.path.join(data, "creature.vtp"), folder / "round.3mf", "--preset", "Soft")
assert "slicer" not in done.stderr and len(ThreeMFFiles.load(folder / "round.3mf").triangles) == len(F)
ss.write(folder / "open.vtp", surface(box, quads[1:]))
done = run(folder / "open.vtp", folder / "open.3mf", "--refine-long-edges", "Off")
assert "open.vtp: warning: The file is written, but a slicer has to repair" in done.stderr, done.stderr
assert "4 border edges, the first at point 0" in done.stderr
assert "slicer" not in run(folder / "open.vtp", folder / "open.3mf", "--quiet").stderr
assert ".3mf" in run("--help").stdout
