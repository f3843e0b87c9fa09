# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Every model through every filter: finite, same cells, no error, and no warning that the documents do not know.

The main filter runs over NormalBlend 0 and 1, Roundness .1, 5 and 50 and DetailSize 0, .03 and .06 on the cells as
they are, and over its defaults and presets, which split long edges; the others over what their defaults are.
Prints a line per model and filter: executions, seconds, and what was said how often.
"""
import collections
import itertools
import re
import time

import numpy as np
import sphericalstyle
from vtkmodules.util.numpy_support import vtk_to_numpy

import surfaces

NORMAL_BLENDS, ROUNDNESSES, DETAIL_SIZES = (0.0, 1.0), (0.1, 5.0, 50.0), (0.0, 0.03, 0.06)
MAIN = "vtkSphericalStyleFilter"
GRID = [{"NormalBlend": a, "Roundness": r, "DetailSize": s, "RefineLongEdges": 0}
        for a, r, s in itertools.product(NORMAL_BLENDS, ROUNDNESSES, DETAIL_SIZES)]
DEFAULTS = {"NormalBlend": 0.6, "Roundness": 1.0, "DetailSize": 0.06, "RefineLongEdges": 1}
FILTERS = {MAIN: GRID + [{**DEFAULTS, **style} for style in surfaces.STYLES.values()],
           "vtkConvexProxyDeformFilter": [{}, {"Blend": 0.0, "Roundness": 50.0}]}
FILTERS |= {entry["class"]: [{}] for entry in surfaces.FILTERS
            if entry["class"] not in FILTERS and entry["kind"] not in ("study", "print")}
DEFORMERS = [entry["class"] for entry in surfaces.FILTERS if entry["kind"] != "measure"]
# Warnings that the pages of the filters explain, each by words of its own.
KNOWN = {"thinned": "thickness", "degenerate": "degenerate", "fans": "as fans", "hull": "convex hull",
         "turned over": "turned over", "not converged": "not converge", "center": "on it", "iterations": "iterations",
         "normals": "normal"}
COLUMNS = ["model", "filter", "executions", "seconds", "said"]


def kind_of(message):
    """The word of KNOWN for a warning, or the message itself."""
    text = re.sub(r"^.*?\): ", "", message, flags=re.S).strip()
    return next((word for word, part in KNOWN.items() if part in text), text)


def same_cells(a, b):
    """Of b as of a, or pieces of them (RefineLongEdges)."""
    def ids(surface):
        return [vtk_to_numpy(array) for cells in (surface.GetVerts(), surface.GetLines(), surface.GetPolys(), surface.GetStrips())
                for array in (cells.GetOffsetsArray(), cells.GetConnectivityArray())]
    origin = b.GetCellData().GetArray("OriginalCell")
    if origin:  # split: every cell is still there, and the points come first
        return (np.array_equal(np.unique(vtk_to_numpy(origin)), np.arange(a.GetNumberOfCells()))
                and b.GetNumberOfPoints() >= a.GetNumberOfPoints())
    return a.GetNumberOfPoints() == b.GetNumberOfPoints() and all(map(np.array_equal, ids(a), ids(b)))


def finite(surface):
    arrays = [surface.GetPoints().GetData()] + [surface.GetPointData().GetArray(k)
                                                for k in range(surface.GetPointData().GetNumberOfArrays())]
    return all(np.isfinite(vtk_to_numpy(array)).all() for array in arrays if array)


class Watched:
    """A filter and what it says."""

    def __init__(self, name):
        self.filter = getattr(sphericalstyle, name)()
        self.errors, self.warnings = [], []
        for event, into in (("ErrorEvent", self.errors), ("WarningEvent", self.warnings)):
            def observer(caller, event_, text, into=into):
                into.append(text)
            observer.CallDataType = surfaces.VTK_STRING
            self.filter.AddObserver(event, observer)


def run(check, name, model, surface, settings):
    """One filter for all settings, as a user moves sliders: a row of the table."""
    watched = Watched(name)
    surfaces.take(watched.filter, surface)
    said = collections.Counter()
    start = time.perf_counter()
    for properties in settings:
        what = f"{model}, {name}, {properties}"
        watched.warnings.clear()
        surfaces.set_properties(watched.filter, properties)
        watched.filter.Update()
        output = watched.filter.GetOutput()
        check(not watched.errors, f"{what}: no error {watched.errors}")
        check(finite(output), f"{what}: finite")
        if name in DEFORMERS:
            check(same_cells(surface, output), f"{what}: the same cells and number of points")
        kinds = [kind_of(message) for message in watched.warnings]
        check(all(kind in KNOWN for kind in kinds), f"{what}: only known warnings {kinds}")
        said.update(kinds)
    seconds = time.perf_counter() - start
    return dict(zip(COLUMNS, [model, name, len(settings), round(seconds, 2),
                              ", ".join(f"{word} {n}" for word, n in sorted(said.items()))]))


def main():
    parser = surfaces.parser(__doc__)
    surfaces.add_models(parser)
    parser.add_argument("--filter", action="append", choices=FILTERS, help="only this one; as often as wanted")
    parser.add_argument("names", nargs="*", help="of models; all without")
    arguments = parser.parse_args()
    if not arguments.models.is_dir():
        surfaces.skip("no folder of models")
    check = surfaces.Checks()
    table = []
    for path in sorted(arguments.models.glob("*.ply")):
        if arguments.names and path.stem not in arguments.names:
            continue
        surface = surfaces.polydata(*surfaces.read(path))
        for name in arguments.filter or FILTERS:
            if not hasattr(sphericalstyle, name):  # built without CGAL
                continue
            settings = [{**properties, **dict(arguments.set)} for properties in FILTERS[name]]
            table.append(run(check, name, path.stem, surface, settings))
            print("  {model}, {filter}: {executions} executions, {seconds} s; {said}".format(**table[-1]), flush=True)
    models = len({row["model"] for row in table})
    print(f"{models} models, {sum(row['executions'] for row in table)} executions, "
          f"{sum(row['seconds'] for row in table):.0f} s")
    check(table, "there is a model")
    if arguments.output:
        surfaces.write_table(arguments.output, "every-model.csv", COLUMNS, table)
    check.exit()


main()
