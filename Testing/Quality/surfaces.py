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

from sphericalstyle import vtkSphericalStyleFilter
try:
    from sphericalstyle import vtkConvexProxyDeformFilter
except ImportError:  # built without CGAL
    vtkConvexProxyDeformFilter = None

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77  # what ctest takes for "skipped"


class Checks:
    """Claims that hold or do not; the exit code says whether all did."""

    def __init__(self):
        self.failures = 0

    def __call__(self, good, claim):
        if not good:
            self.failures += 1
            print("ERROR: should hold:", claim)

    def exit(self):
        print(f"{self.failures} claims do not hold" if self.failures else "all claims hold")
        sys.exit(1 if self.failures else 0)


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


def assignment(text):
    name, _, value = text.partition("=")
    if not hasattr(vtkSphericalStyleFilter, "Set" + name):
        raise argparse.ArgumentTypeError(f"the filter has no property {name}")
    number = float(value)
    return name, int(number) if number.is_integer() else number


def stitched(properties):
    """Whether parts are to travel together; Independent is no defect where it was asked for."""
    style = vtkSphericalStyleFilter()
    if not hasattr(style, "GetComponentCoupling"):
        return False
    return properties.get("ComponentCoupling", style.GetComponentCoupling()) == style.STITCHED


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
    """x: deformed points, of the points that were given. F: their triangles."""

    def __init__(self, algorithm, x, F, properties):
        self.messages = []
        for event in ("ErrorEvent", "WarningEvent"):
            algorithm.AddObserver(event, self._message)
        algorithm.SetInputData(polydata(x, F))
        algorithm.SetOutputPointsPrecision(1)
        for name, value in properties.items():
            getattr(algorithm, "Set" + name)(value)
        begin = time.perf_counter()
        algorithm.Update()
        self.seconds = time.perf_counter() - begin
        output = algorithm.GetOutput()
        self.failed = output.GetNumberOfPoints() == 0
        self.x = points(output) if not self.failed else np.full_like(x, np.nan)
        self.F = triangles(output) if not self.failed else F

    def _message(self, _source, _event, text):
        self.messages.append(text.strip().split("\n")[-1])

    _message.CallDataType = VTK_STRING


class ProxyResult(Deformed):
    """Of vtkConvexProxyDeformFilter; nothing is iterated on the model itself."""

    def __init__(self, x, F):
        super().__init__(vtkConvexProxyDeformFilter(), x, F, {})
        self.iterations = 0
        self.converged = not self.failed


class Result(Deformed):
    """Of vtkSphericalStyleFilter."""

    def __init__(self, x, F, properties):
        style = vtkSphericalStyleFilter()
        super().__init__(style, x, F, properties)
        self.center = np.array(style.GetEffectiveCenter())
        self.radius = style.GetEffectiveRadius()
        self.iterations = style.GetNumberOfIterations()
        self.converged = style.GetConverged()
