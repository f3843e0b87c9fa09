# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Where the time of the filters goes.

usage: measure_stages.py [--runs N] [--detail-size S] [--uniform] [--nonlinear] [--proxy [--mesher NAME]]
                         [MESH.ply or MESH.vtp ...]

vtkSphericalStyleFilter: first result, moved center, another Roundness, then the stages of the first. With --proxy
vtkConvexProxyDeformFilter: first result, another t, then its stages. Medians of N runs in milliseconds, default
settings but the detail size and, with --uniform, weights that iterate; without a mesh the models of Data/. With
--nonlinear an iteration of the energy with the linear feature, and with the nonlinear one, corrected and as written,
with the factorization where each iteration needs its own. Run with
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

MESHERS = ("IsotropicRemeshing", "BallPivoting", "AdvancingFront", "SubdividedHull")
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


def stages(table):
    """{stage: milliseconds} of the last execution."""
    seconds = table.GetFieldData().GetArray("StageSeconds")
    return {seconds.GetComponentName(k).lower(): 1e3 * seconds.GetComponent(0, k)
            for k in range(seconds.GetNumberOfComponents())}


def one_run(surface, arguments):
    f = sphericalstyle.vtkSphericalStyleFilter()
    f.SetInputData(surface)
    if arguments.detail_size is not None:
        f.SetDetailSize(arguments.detail_size)
    if arguments.uniform:
        f.SetSphericalWeightingToUniform()
    first = milliseconds(f)
    parts = {**stages(f.GetOutputDataObject(1)), "iterations": f.GetNumberOfIterations()}
    f.SetCenter(*(x + 0.1 * f.GetEffectiveRadius() for x in f.GetEffectiveCenter()))
    f.SetCenterModeToCustom()
    moved = milliseconds(f)
    f.SetRoundness(2.0 * f.GetRoundness())
    return {"first": first, "center": moved, "Roundness": milliseconds(f), **parts}


def one_iteration(f, surface):
    """Milliseconds, the mean of five."""
    f.SetInputData(surface)
    f.SetStopRuleToFixedIterations()
    f.SetMaximumNumberOfIterations(5)
    milliseconds(f)
    parts = stages(f.GetOutputDataObject(1))
    own_factor = f.IsA("vtkNonlinearStyleFilter")  # the linear feature factors once, before the first
    return (parts["iterate"] + (parts["factor"] if own_factor else 0.0)) / 5


def one_nonlinear_run(surface, _):
    f = sphericalstyle.vtkSphericalStyleFilter()
    f.SetNormalBlend(0.0)
    f.SetDetailSize(0.0)
    f.SetKeepSizeToOff()
    f.SetRefineLongEdgesToOff()
    linear = one_iteration(f, surface)
    corrected = one_iteration(sphericalstyle.vtkNonlinearStyleFilter(), surface)
    g = sphericalstyle.vtkNonlinearStyleFilter()
    g.SetCenterConstraintToAsWritten()
    written = one_iteration(g, surface)
    return {"linear": linear, "corrected": corrected, "as written": written, "x corrected": corrected / linear,
            "x as written": written / linear}


def one_proxy_run(surface, arguments):
    f = sphericalstyle.vtkConvexProxyDeformFilter()  # of builds with CGAL
    f.SetInputData(surface)
    f.SetProxyMesher(MESHERS.index(arguments.mesher))
    first = milliseconds(f)
    parts = {**stages(f.GetOutput(1)), "proxy points": f.GetEffectiveNumberOfProxyPoints()}
    f.SetBlend(0.3)
    return {"first": first, "other t": milliseconds(f), **parts}


parser = argparse.ArgumentParser()
parser.add_argument("--runs", type=int, default=5)
parser.add_argument("--detail-size", type=float, help="of the filter, by default as there")
parser.add_argument("--uniform", action="store_true", help="uniform weights")
parser.add_argument("--nonlinear", action="store_true", help="an iteration of each form of the energy")
parser.add_argument("--proxy", action="store_true")
parser.add_argument("--mesher", choices=MESHERS, default=MESHERS[0], help="of the proxy")
parser.add_argument("meshes", nargs="*")
arguments = parser.parse_args()
if arguments.runs < 1:
    parser.error("--runs: at least 1")
heads = None
for path in arguments.meshes or sorted(glob.glob(os.path.join(DATA, "*.vtp"))):
    surface = read(path)
    measure = one_proxy_run if arguments.proxy else one_nonlinear_run if arguments.nonlinear else one_run
    runs = [measure(surface, arguments) for _ in range(arguments.runs)]
    if heads is None:
        heads = list(runs[0])
        print(f"{'mesh':20s} {'points':>8s} " + " ".join(f"{h:>13s}" for h in heads))
    medians = [statistics.median(run[head] for run in runs) for head in heads]
    name = os.path.splitext(os.path.basename(path))[0]
    print(f"{name:20s} {surface.GetNumberOfPoints():8d} " + " ".join(f"{m:13.1f}" for m in medians))
