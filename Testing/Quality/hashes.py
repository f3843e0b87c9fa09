# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Hashes of results: is a change of the code none of the results?

Every model through many settings of the filters; a line for each: model, case, and the start of the SHA-256 of the
points, the cells and the arrays that come out. Keep the lines of one build, make those of the other, and compare:

    hashes.py > before.txt;  hashes.py > after.txt;  diff before.txt after.txt

Claims nothing by itself, so it is no test: results differ between compilers and instruction sets.
"""
import hashlib

from vtkmodules.util.numpy_support import vtk_to_numpy

import sphericalstyle
from sphericalstyle import presets

import surfaces

STYLE = "vtkSphericalStyleFilter"
THESIS = "vtkThesisStyleFilter"
NONLINEAR = "vtkNonlinearStyleFilter"
ENERGY = {"DetailSize": 0, "MaximumNumberOfIterations": 20}
ALL_ARRAYS = {f"Generate{name}": 1 for name in ("TargetDirection", "Displacement", "Normals", "Rotation")}
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


def hashes(surface, kind, properties):
    """One of each output; the errors of the filter are part of the result, too."""
    algorithm = getattr(sphericalstyle, kind)()
    algorithm.SetInputData(surface)
    surfaces.set_properties(algorithm, properties)
    messages = []
    for event in ("ErrorEvent", "WarningEvent"):
        algorithm.AddObserver(event, lambda _source, name: messages.append(name[:1]))
    algorithm.Update()
    outputs = [algorithm.GetOutputDataObject(port) for port in range(algorithm.GetNumberOfOutputPorts())]
    return " ".join([of(output) for output in outputs] + messages)


def main():
    parser = surfaces.parser(__doc__)
    surfaces.add_models(parser)
    parser.add_argument("names", nargs="*", metavar="MODEL", help="all if none is named")
    arguments = parser.parse_args()
    for name, path in surfaces.model_paths(arguments.models).items():
        if arguments.names and name not in arguments.names:
            continue
        surface = surfaces.polydata(*surfaces.read(path))
        for case, (kind, properties) in CASES.items():
            if surface.GetNumberOfPoints() > SLOW and case not in QUICK or not hasattr(sphericalstyle, kind):
                continue
            print(f"{name}, {case}: {hashes(surface, kind, properties)}", flush=True)


if __name__ == "__main__":
    main()
