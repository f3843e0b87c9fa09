# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Models in, the filter over them, numpy out: what the scripts of this folder share."""
import argparse
import csv
import os
import pathlib
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from sphericalstyle import presets, vtkSphericalStyleFilter
try:
    from sphericalstyle import vtkConvexProxyDeformFilter
except ImportError:  # built without CGAL
    vtkConvexProxyDeformFilter = None

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "Testing/Python"))
import FilterTable  # noqa: E402

FILTERS = list(FilterTable.SURFACE_FILTERS.values())
# The method of the thesis in closed form, with cotangent weights: the smooth blend with the sphere.
THESIS = {"NormalBlend": 0.0, "DetailSize": 0.0, "KeepSize": 0, "RefineLongEdges": 0}
# What the sheet shows: the defaults and presets.
STYLES = {"defaults": {}} | {name: presets.find(name).properties for name in ("Soft", "Toy", "Chibi", "Ball")}
SKIPPED = 77  # what ctest takes for "skipped"


class Checks:
    """Claims that hold or do not; the exit code says whether all did."""

    def __init__(self):
        self.made = 0
        self.failures = 0

    def __call__(self, good, claim):
        self.made += 1
        if not good:
            self.failures += 1
            print("ERROR: should hold:", claim)

    def exit(self):
        print(f"{self.failures} of {self.made} claims do not hold" if self.failures else f"all {self.made} claims hold")
        sys.exit(1 if self.failures or not self.made else 0)


def parser(description):
    """A parser with the options that all scripts have."""
    result = argparse.ArgumentParser(
        description=description.split("\n\n", 1)[0], epilog=description.split("\n\n", 1)[1],
        formatter_class=argparse.RawDescriptionHelpFormatter)
    result.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", type=assignment,
                        help="a property of the filter, other than its default: EdgeWeighting=2")
    result.add_argument("--output", type=pathlib.Path, help="folder for tables and pictures")
    result.add_argument("--pictures", action="store_true", help="with --output: pictures too")
    return result


def add_models(parser_):
    parser_.add_argument("--models", type=pathlib.Path,
                         default=os.environ.get("SPHERICALSTYLE_MODELS", ROOT / "../shared/models"),
                         help="folder of real models; without it the script leaves with 77")


def model_paths(folder):
    """{name: path} of the real models, and of those of Data/ as "Data/car"."""
    paths = {path.stem: path for path in sorted(pathlib.Path(folder).glob("*.ply"))}
    return paths | {f"Data/{path.stem}": path for path in sorted((ROOT / "Data").glob("*.vtp"))}


def chosen_models(description, names):
    """(options, {name: path}) of a script for these models: those that the command line names, or all that are there."""
    parser_ = parser(description)
    add_models(parser_)
    parser_.add_argument("names", nargs="*", metavar="MODEL", help=f"of {', '.join(names)}")
    chosen = parser_.parse_args()
    paths = model_paths(chosen.models)
    missing = [name for name in chosen.names if name not in paths]
    if missing:
        skip(f"no model {', '.join(missing)}")
    return chosen, {name: paths[name] for name in chosen.names or names if name in paths}


def assignment(text):
    name, _, value = text.partition("=")
    if not hasattr(vtkSphericalStyleFilter, "Set" + name):
        raise argparse.ArgumentTypeError(f"the filter has no property {name}")
    number = float(value)
    return name, int(number) if number.is_integer() else number


def write_table(folder, name, columns, rows):
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / name, "w", newline="", encoding="utf-8") as file:
        lines = csv.DictWriter(file, columns)
        lines.writeheader()
        lines.writerows(rows)


def skip(why):
    print(f"{why}: skipped")
    sys.exit(SKIPPED)


# -------------------------------------------------------------------------------------- conversion
def read(path):
    reader = vtkPLYReader() if path.suffix == ".ply" else vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetOutput().GetNumberOfPoints() > 0, path
    return points(reader.GetOutput()), triangles(reader.GetOutput())


def points(surface):
    """n x 3, double."""
    return vtk_to_numpy(surface.GetPoints().GetData()).astype(float)


def triangles(surface):
    """m x 3; the surface has triangles only."""
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(np.int64)


def polydata(x, F):
    """A vtkPolyData in double precision."""
    positions = vtkPoints()
    positions.SetData(numpy_to_vtk(np.ascontiguousarray(x, dtype=float), deep=True))
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtk(np.arange(0, 3 * len(F) + 1, 3, dtype=np.int64), deep=True),
                  numpy_to_vtk(np.ascontiguousarray(F, dtype=np.int64).ravel(), deep=True))
    result = vtkPolyData()
    result.SetPoints(positions)
    result.SetPolys(cells)
    return result


# ----------------------------------------------------------------------------------------- filters
class Deformed:
    """x: deformed points, of the points that were given or, with RefineLongEdges, have become of them.
    F: their triangles. rotations: the point array Rotation, or None."""

    def __init__(self, algorithm):
        messages = []

        def message(_source, _event, text):
            messages.append(text.strip().split("\n")[-1])
        message.CallDataType = VTK_STRING
        observers = [algorithm.AddObserver(event, message) for event in ("ErrorEvent", "WarningEvent")]
        begin = time.perf_counter()
        algorithm.Update()
        self.seconds = time.perf_counter() - begin
        for observer in observers:
            algorithm.RemoveObserver(observer)
        self.messages = messages
        output = algorithm.GetOutput()
        self.failed = output.GetNumberOfPoints() == 0
        surface = algorithm.GetInput() if self.failed else output
        self.x, self.F = points(surface), triangles(surface)
        if self.failed:
            self.x[:] = np.nan
        rotations = output.GetPointData().GetArray("Rotation")
        self.rotations = vtk_to_numpy(rotations).reshape(-1, 3, 3).copy() if rotations else None


def set_properties(algorithm, properties):
    """Words are those of the class: {"NormalRadius": "OwnThickness"}."""
    for name, value in properties.items():
        if isinstance(value, str):
            getattr(algorithm, f"Set{name}To{value}")()
        else:
            getattr(algorithm, "Set" + name)(value)


def take(algorithm, surface):
    """Gives it the surface; for vtkPartSizesFilter one with two parts, either side of the middle, and to
    vtkHandleDeformFilter a handle that stays, at the lowest point, and one that turns, at the highest one."""
    if algorithm.IsA("vtkHandleDeformFilter"):
        x = points(surface)
        low, high = x[x[:, 1].argmin()], x[x[:, 1].argmax()]
        algorithm.RemoveAllHandles()
        algorithm.AddHandle([*low, 0, *low, 0, 0, 0])
        algorithm.AddHandle([*high, 0, *(high + 0.1 * (high - low)), 0, 20, 0])
    if algorithm.IsA("vtkPartSizesFilter"):
        x = points(surface)
        array = numpy_to_vtk((x[:, 0] > x[:, 0].mean()).astype(np.int32), deep=True)
        array.SetName("PartId")
        numbered = surface.NewInstance()
        numbered.ShallowCopy(surface)
        numbered.GetPointData().AddArray(array)
        surface = numbered
        algorithm.SetPartSize(1, 1.3)
    algorithm.SetInputData(surface)


def prepared(algorithm, x, F, properties):
    algorithm.SetInputData(polydata(x, F))
    algorithm.SetOutputPointsPrecision(1)
    set_properties(algorithm, properties)
    return algorithm


class ProxyResult(Deformed):
    """Of vtkConvexProxyDeformFilter; nothing is iterated on the model itself."""

    def __init__(self, x, F):
        super().__init__(prepared(vtkConvexProxyDeformFilter(), x, F, {}))
        self.iterations = 0
        self.converged = not self.failed


class StyleResult(Deformed):
    """Of vtkSphericalStyleFilter."""

    def __init__(self, style):
        super().__init__(style)
        self.center = np.array(style.GetEffectiveCenter())
        self.radius = style.GetEffectiveRadius()
        self.iterations = style.GetNumberOfIterations()
        self.converged = style.GetConverged()


class Style:
    """vtkSphericalStyleFilter with a model in it, executed again and again as a user does."""

    def __init__(self, x, F, properties):
        self.properties = properties
        self.filter = prepared(vtkSphericalStyleFilter(), x, F, {})
        fresh = vtkSphericalStyleFilter()
        self.defaults = {name: getattr(fresh, "Get" + name)() for name in ("Roundness", "KeepSize")}
        self.defaults |= {name: getattr(fresh, "Get" + name)() for style in STYLES.values() for name in style}

    def result(self, properties):
        """What is not named is as in the defaults, or as it was given for all."""
        set_properties(self.filter, {**self.defaults, **properties, **self.properties})
        return StyleResult(self.filter)


def Result(x, F, properties):  # noqa: N802, as a class
    """The filter on a model, once."""
    return StyleResult(prepared(vtkSphericalStyleFilter(), x, F, properties))
