# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Claims about vtkGaussMapFilter that only real models can show, measured and checked.

usage: TestGaussMapFilterModels.py [--models DIR] [section ...]

Sections: face turns sphere. The rest is as ModelTesting.py says.
"""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkCellCenters, vtkCleanPolyData
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter

from sphericalstyle import vtkGaussMapFilter, vtkSphericalStyleFilter

from ModelTesting import ENERGY, check, main, read

# Chin to brow of nefertiti, in front of the ears; y is up, the face looks along z.
FACE = (-np.inf, np.inf, -108.0, 75.0, 70.0, np.inf)
MEASURES = ("Normals", "UnitsHit", "UnitsHitOften", "EqualAreaUnitsHit", "EqualAreaUnitsHitOften",
            "RelativeEntropy", "DistanceToUniform")


def part(surface, bounds):
    """The triangles with their center in the bounds, whole, and their points."""
    centers = vtkCellCenters()
    centers.SetInputData(surface)
    centers.Update()
    x = vtk_to_numpy(centers.GetOutput().GetPoints().GetData())
    outside = ((x < bounds[0::2]) | (x > bounds[1::2])).any(axis=1)
    rest = vtkPolyData()
    rest.DeepCopy(surface)
    rest.BuildCells()
    for cell in np.flatnonzero(outside):
        rest.DeleteCell(cell)
    rest.RemoveDeletedCells()
    used = vtkCleanPolyData()
    used.PointMergingOff()
    used.SetInputData(rest)
    used.Update()
    return used.GetOutput()


def rounded(surface, roundness):
    style = vtkSphericalStyleFilter()
    style.SetInputData(surface)
    for name, value in {**ENERGY, "Roundness": roundness}.items():
        getattr(style, "Set" + name)(value)
    style.SetCenterModeToPointMean()  # of the thesis
    style.SetOutputPointsPrecision(1)
    style.Update()
    return style.GetOutput()


def gauss_map(surface, **properties):
    """The row of measures of a surface, by name."""
    f = vtkGaussMapFilter()
    f.SetInputData(surface)
    for name, value in properties.items():
        getattr(f, "Set" + name)(value)
    f.Update()
    table = f.GetOutputDataObject(2)
    return {name: table.GetValueByName(0, name).ToDouble() for name in MEASURES}


def compare(surfaces, **properties):
    """Prints a table of the measures of surfaces, a row each, as Table 4.1; returns the rows.

    surfaces: by what they are called, the input first."""
    rows = {name: gauss_map(surface, **properties) for name, surface in surfaces.items()}
    print("  " + " " * 20 + "".join(f"{name:>24s}" for name in MEASURES), properties or "")
    for name, row in rows.items():
        print(f"  {name:20s}" + "".join(f"{row[measure]:24.6g}" for measure in MEASURES))
    return rows


# -- Table 4.1 ------------------------------------------------------------------------------------
def face():
    surface = part(read("nefertiti"), FACE)
    check(5000 < surface.GetNumberOfCells() < 10000, "the part is a face")
    surfaces = {"input": surface, "Roundness 0.5": rounded(surface, 0.5)}
    rows = compare(surfaces)
    before, after = rows["input"], rows["Roundness 0.5"]
    check(before["Normals"] == after["Normals"] == surface.GetNumberOfCells(), "all triangles count")
    check(after["UnitsHit"] > 1.03 * before["UnitsHit"], "more units are hit (Table 4.1: 1.09 times)")
    check(0 < before["UnitsHitOften"] and after["UnitsHitOften"] < 0.6 * before["UnitsHitOften"],
          "fewer units are hit often")
    for threshold in (2, 3, 4, 8):
        often = [gauss_map(s, OftenThreshold=threshold)["UnitsHitOften"] for s in surfaces.values()]
        print(f"  hit more than {threshold} times: {often[0]:g} -> {often[1]:g}")
        check(often[1] < often[0], f"fewer units are hit more than {threshold} times")
    for properties in ({}, {"AreaWeighted": True}, {"NormalSource": 1},
                       {"NumberOfEqualAreaUnits": 200}):
        rows = compare(surfaces, **properties)
        before, after = rows["input"], rows["Roundness 0.5"]
        check(after["DistanceToUniform"] < before["DistanceToUniform"], f"closer to uniform {properties}")
        check(after["RelativeEntropy"] > before["RelativeEntropy"], f"more entropy {properties}")


# -- A8.26: the model turned -------------------------------------------------------------------------
def turns():
    for name in ("spot", "goblet-vase"):
        surface = read(name)
        transform, turned = vtkTransform(), vtkTransformPolyDataFilter()
        turned.SetTransform(transform)
        turned.SetInputData(surface)
        surfaces = {}
        for k, axis in enumerate(((0, 0, 1), (1, 0, 0), (0, 1, 0), (1, 2, 3))):
            transform.Identity()
            transform.RotateWXYZ(73.0 * k, *axis)
            turned.Update()
            surfaces[f"{name} turned {k}"] = vtkPolyData()
            surfaces[f"{name} turned {k}"].ShallowCopy(turned.GetOutput())
        rows = compare(surfaces)

        def spread(measure):
            values = [row[measure] for row in rows.values()]
            return (max(values) - min(values)) / np.mean(values)

        angle, distance = spread("UnitsHit"), spread("DistanceToUniform")
        entropy = spread("RelativeEntropy")
        print(f"  range over mean: UnitsHit {angle:.4f}, DistanceToUniform {distance:.4f},"
              f" RelativeEntropy {entropy:.4f}")
        check(angle > 0.0, "equal-angle units depend on how a model is turned")
        check(entropy < 0.5 * angle, "entropy on equal-area units does less")


# -- a model and the ball it becomes --------------------------------------------------------------
def sphere():
    # Between them it may go up first: arms and ears point everywhere already.
    for name in ("spot", "bunny", "armadillo"):
        surface = read(name)
        rows = compare({f"{name} {r:g}": rounded(surface, r) for r in (0.0, 0.5, 5.0)},
                       AreaWeighted=True, NumberOfEqualAreaUnits=100)
        check(rows[f"{name} 5"]["DistanceToUniform"] < 0.7 * rows[f"{name} 0"]["DistanceToUniform"],
              f"{name}: nearly a ball is closer to uniform")


main({"face": face, "turns": turns, "sphere": sphere})
