# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Hashes of results: does a change of the code leave all results as they are?

Runs every model through many settings of the filters. Prints a line for each: model, case, and the start of the
SHA-256 of the points, the cells and the arrays of the result. To compare two builds:

    hashes.py > before.txt;  hashes.py > after.txt;  diff before.txt after.txt

Two systems have different compilers and math libraries, so the last bits of their results differ. To see by how much:

    hashes.py --save A        on one system, hashes.py --save B on the other
    hashes.py --compare A B   prints the largest distance between the two positions of a point, in percent of the
                              diagonal of the result, for each case over all models

This script is not a test: it has no expected result.
"""
import collections
import hashlib
import os

import numpy

from vtkmodules.util.numpy_support import vtk_to_numpy

import sphericalstyle
from sphericalstyle import presets

import surfaces

STYLE = "vtkSphericalStyleFilter"
THESIS = "vtkThesisStyleFilter"
NONLINEAR = "vtkNonlinearStyleFilter"
ENERGY = {"DetailSize": 0, "MaximumNumberOfIterations": 20}
ALL_ARRAYS = {f"Generate{name}": 1 for name in ("Displacement", "Normals", "Rotation")}
CASES = {name: (STYLE, preset.properties) for name, preset in presets.PRESETS.items()} | {
    "defaults": (STYLE, {}),
    "all arrays": (STYLE, ALL_ARRAYS),
    "thesis": (STYLE, {"ReproduceThesis": 1, "MaximumNumberOfIterations": 20}),
    "normals": (STYLE, {"DetailSize": 0, "NormalBlend": 0.5}),
    "volume, on the ground": (STYLE, {"KeepSize": "Volume", "KeepOnGround": 1, "UpAxis": "Z"}),
    "energy": (STYLE, {**ENERGY, "SphericalWeighting": "Uniform"}),
    "energy with details": (STYLE, {**ENERGY, "SphericalWeighting": "Uniform", "DetailSize": 0.06}),
    "full edges": (STYLE, {**ENERGY, "EdgeWeighting": "FullEdge", "SphericalWeighting": "Uniform"}),
    "intrinsic": (STYLE, {**ENERGY, "EdgeWeighting": "IntrinsicDelaunay", "SphericalWeighting": "Uniform"}),
    "concave": (THESIS, {**ENERGY, "ConcaveEdges": "Flip"}),
    "from rest, energies of cells": (THESIS, {**ENERGY, "InitialGuess": "Rest", "GenerateCellEnergy": 1}),
    "parts apart": (THESIS, {**ENERGY, "SphericalWeighting": "Uniform", "ComponentCoupling": "Independent"}),
    "guard": (STYLE, {"AvoidSelfIntersections": 1}),
    "nonlinear": (NONLINEAR, {"MaximumNumberOfIterations": 20}),
    "nonlinear, as written": (NONLINEAR, {"ReproduceThesis": 1, "MaximumNumberOfIterations": 20}),
}
CASES |= {entry["label"]: (entry["class"], entry["quick"]) for entry in surfaces.FILTERS
          if entry["class"] not in (STYLE, NONLINEAR)}
SLOW = 30_000  # points; larger models are left to the cases that take no minute
QUICK = {"defaults", "Chibi", "Ball", "all arrays", "Sphere Projection"}


def add(digest, array):
    if array is not None:
        digest.update(array.GetName().encode() if array.GetName() else b"")
        digest.update(vtk_to_numpy(array).tobytes())


def of(output):
    """Of a vtkDataSet or vtkTable; measured times do not count."""
    digest = hashlib.sha256()
    if output.IsA("vtkPolyData"):
        if output.GetPoints():
            add(digest, output.GetPoints().GetData())
        add(digest, output.GetPolys().GetConnectivityArray())
    table = output.IsA("vtkTable")
    for attributes in (output.GetRowData(),) if table else (output.GetPointData(), output.GetCellData()):
        for i in range(attributes.GetNumberOfArrays()):
            array = attributes.GetArray(i)  # None where it is of words
            if array is not None and "econds" not in array.GetName():
                add(digest, array)
    return digest.hexdigest()[:16]


def results(surface, kind, properties):
    """The outputs of a filter, and the first letter of each of its errors and warnings."""
    algorithm = getattr(sphericalstyle, kind)()
    surfaces.take(algorithm, surface)
    surfaces.set_properties(algorithm, properties)
    messages = []
    for event in ("ErrorEvent", "WarningEvent"):
        algorithm.AddObserver(event, lambda _source, name: messages.append(name[:1]))
    algorithm.Update()
    return [algorithm.GetOutputDataObject(port) for port in range(algorithm.GetNumberOfOutputPorts())], messages


def save(output, path):
    points, cells = output.GetPoints(), output.GetPolys()
    numpy.savez(path, points=vtk_to_numpy(points.GetData()) if points else numpy.zeros((0, 3)),
                cells=vtk_to_numpy(cells.GetConnectivityArray()).astype(numpy.int32))


def distances(one, other):
    """Largest and root mean square distance between corresponding points, in percent of the diagonal; None if the
    triangles differ."""
    with numpy.load(one) as a, numpy.load(other) as b:
        if len(a["points"]) != len(b["points"]) or not numpy.array_equal(a["cells"], b["cells"]):
            return None
        if not len(a["points"]):
            return 0, 0
        diagonal = numpy.linalg.norm(numpy.ptp(a["points"].astype(float), axis=0)) or 1
        squares = numpy.sum((a["points"].astype(float) - b["points"]) ** 2, axis=1)
        return 100 * numpy.sqrt(squares.max()) / diagonal, 100 * numpy.sqrt(squares.mean()) / diagonal


def compare(one, other):
    names = sorted(set(os.listdir(one)) | set(os.listdir(other)))
    cases = collections.defaultdict(list)
    for name in names:
        model, case = name[:-len(".npz")].split(", ", 1)
        paths = os.path.join(one, name), os.path.join(other, name)
        cases[case].append((distances(*paths) if all(map(os.path.exists, paths)) else None, model))
    print("| case | models | largest % | rms % | of the model | other triangles |")
    print("|---|--:|--:|--:|---|---|")
    for case, found in cases.items():
        worst, model = max(((d, model) for d, model in found if d), default=((numpy.nan, numpy.nan), ""))
        others = ", ".join(model for d, model in found if d is None)
        print(f"| {case} | {len(found)} | {worst[0]:.2g} | {worst[1]:.2g} | {model} | {others} |")


def main():
    parser = surfaces.parser(__doc__)
    surfaces.add_models(parser)
    parser.add_argument("--save", metavar="FOLDER", help="also write the points and triangles of the results there")
    parser.add_argument("--compare", nargs=2, metavar="FOLDER", help="compare two of these folders, run no filter")
    parser.add_argument("names", nargs="*", metavar="MODEL", help="all if none is named")
    arguments = parser.parse_args()
    if arguments.compare:
        compare(*arguments.compare)
        return
    if arguments.save:
        os.makedirs(arguments.save, exist_ok=True)
    for name, path in surfaces.model_paths(arguments.models).items():
        if arguments.names and name not in arguments.names:
            continue
        surface = surfaces.polydata(*surfaces.read(path))
        for case, (kind, properties) in CASES.items():
            if surface.GetNumberOfPoints() > SLOW and case not in QUICK or not hasattr(sphericalstyle, kind):
                continue
            outputs, messages = results(surface, kind, properties)
            print(f"{name}, {case}:", *map(of, outputs), *messages, flush=True)
            if arguments.save and outputs[0].IsA("vtkPolyData"):
                save(outputs[0], os.path.join(arguments.save, f"{name}, {case}.npz".replace("/", "_")))


if __name__ == "__main__":
    main()
