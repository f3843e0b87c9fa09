# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Where the time of the filters goes.

usage: measure_stages.py [--runs N] [--detail-size S] [--uniform] [--proxy] [MESH.ply or MESH.vtp ...]

vtkSphericalStyleFilter: first result, moved centre, changed Roundness. With --proxy
vtkConvexProxyDeformFilter: first result, another t. Medians of N runs in milliseconds, default
settings but the detail size and, with --uniform, weights that iterate; without a mesh the models of Data/. Run with
PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3.
"""
import argparse
import glob
import os
import statistics
import sys
import time

from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import sphericalstyle

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data")


def read(path):
    reader = vtkPLYReader() if path.endswith(".ply") else vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    if reader.GetOutput().GetNumberOfPoints() == 0:
        sys.exit(f"{path}: no points could be read")
    return reader.GetOutput()


def milliseconds(f):
    begin = time.perf_counter()
    f.Update()
    if f.GetOutput().GetNumberOfPoints() == 0:
        sys.exit("The filter gave no result and has said why.")
    return 1e3 * (time.perf_counter() - begin)


def one_run(surface, detail_size, uniform):
    """First, moved centre, changed Roundness, then the stages of the first."""
    f = sphericalstyle.vtkSphericalStyleFilter()
    f.SetInputData(surface)
    if detail_size is not None:
        f.SetDetailSize(detail_size)
    if uniform:
        f.SetSphericalWeightingToUniform()
    first = milliseconds(f)
    iterations = f.GetNumberOfIterations()
    stages = f.GetOutputDataObject(1).GetFieldData().GetArray("StageSeconds")
    seconds = [1e3 * stages.GetComponent(0, k) for k in range(stages.GetNumberOfComponents())]
    f.SetCenter(*(x + 0.1 * f.GetEffectiveRadius() for x in f.GetEffectiveCenter()))
    f.SetCenterModeToCustom()
    moved = milliseconds(f)
    f.SetRoundness(2.0 * f.GetRoundness())
    return [first, moved, milliseconds(f), *seconds, iterations]


def one_proxy_run(surface):
    """First, another t, then the stages of the first."""
    f = sphericalstyle.vtkConvexProxyDeformFilter()  # of builds with CGAL
    f.SetInputData(surface)
    first = milliseconds(f)
    stages = f.GetOutput(1).GetFieldData().GetArray("StageSeconds")
    seconds = [1e3 * stages.GetComponent(0, k) for k in range(stages.GetNumberOfComponents())]
    f.SetBlend(0.3)
    return [first, milliseconds(f), *seconds, f.GetEffectiveNumberOfProxyPoints()]


parser = argparse.ArgumentParser()
parser.add_argument("--runs", type=int, default=5)
parser.add_argument("--detail-size", type=float, help="of the filter, by default as there")
parser.add_argument("--uniform", action="store_true", help="uniform weights")
parser.add_argument("--proxy", action="store_true")
parser.add_argument("meshes", nargs="*")
arguments = parser.parse_args()
if arguments.runs < 1:
    parser.error("--runs: at least 1")
heads = ["first", "centre", "lambda", "base", "weights", "analyze", "factor", "iterate", "triangles", "iterations"]
if arguments.proxy:
    heads = ["first", "other t", "proxy", "round", "project", "transfer", "proxy points"]
print(f"{'mesh':20s} {'points':>8s} " + " ".join(f"{h:>12s}" for h in heads))
for path in arguments.meshes or sorted(glob.glob(os.path.join(DATA, "*.vtp"))):
    surface = read(path)
    runs = [one_proxy_run(surface) if arguments.proxy else one_run(surface, arguments.detail_size, arguments.uniform)
            for _ in range(arguments.runs)]
    medians = [statistics.median(column) for column in zip(*runs)]
    name = os.path.splitext(os.path.basename(path))[0]
    print(f"{name:20s} {surface.GetNumberOfPoints():8d} " + " ".join(f"{m:12.1f}" for m in medians))
