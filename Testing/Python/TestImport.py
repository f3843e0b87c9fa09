# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The Python package imports, knows its version and moves the points of a sphere.

usage: TestImport.py VERSION [PREFIX]
PREFIX: the package has to come from there.
"""
import os
import sys

from vtkmodules.vtkFiltersSources import vtkSphereSource

import sphericalstyle
from sphericalstyle import presets, vtkSphericalStyleFilter

assert sphericalstyle.__version__ == sys.argv[1], sphericalstyle.__version__
if len(sys.argv) > 2:
    assert os.path.realpath(sphericalstyle.__file__).startswith(os.path.realpath(sys.argv[2]) + os.sep)

# Twice as long as wide, so that there is something to round.
source = vtkSphereSource()
source.SetThetaResolution(24)
source.SetPhiResolution(24)
source.Update()
ellipsoid = source.GetOutput()
points = ellipsoid.GetPoints()
for i in range(points.GetNumberOfPoints()):
    x, y, z = points.GetPoint(i)
    points.SetPoint(i, x, y, 2 * z)


def elongation(polydata):
    bounds = polydata.GetBounds()
    return (bounds[5] - bounds[4]) / (bounds[1] - bounds[0])


rounded = vtkSphericalStyleFilter()
rounded.SetInputData(ellipsoid)
rounded.SetRoundness(2.0)
rounded.Update()
output = rounded.GetOutput()
table = rounded.GetOutputDataObject(1)

assert output.GetNumberOfPoints() == ellipsoid.GetNumberOfPoints()
assert output.GetNumberOfCells() == ellipsoid.GetNumberOfCells()
assert elongation(ellipsoid) > 1.9, elongation(ellipsoid)
assert 1.0 < elongation(output) < 1.6, elongation(output)
assert output.GetPointData().HasArray("Displacement")
assert rounded.GetConverged() and rounded.GetNumberOfIterations() == 0  # a closed form
assert table.GetNumberOfRows() == 0, table.GetNumberOfRows()
rounded.SetSphericalWeightingToUniform()
rounded.Update()
assert rounded.GetConverged() and table.GetNumberOfRows() == rounded.GetNumberOfIterations() + 1 > 1

# The presets: all say the same properties, in words that the class knows, and give shapes of their own.
shapes = set()
for name, preset in presets.PRESETS.items():
    assert set(preset.properties) == set(presets.PRESETS["Toy"].properties), name
    assert preset.description and "\n" not in preset.description, name
    style = vtkSphericalStyleFilter()
    style.SetInputData(ellipsoid)
    style.SetReproduceThesis(True)
    presets.apply(style, name)
    for property_ in ("Roundness", "NormalBlend", "DetailSize"):
        assert getattr(style, "Get" + property_)() == preset.properties[property_], (name, property_)
    assert not style.GetReproduceThesis()
    style.Update()
    shapes.add(style.GetOutput().GetBounds())
assert len(shapes) == len(presets.PRESETS), shapes
try:
    presets.apply(rounded, "Cube")
    raise SystemExit("there is no such preset")
except ValueError as error:
    assert "'Cube'" in str(error) and "Pebble" in str(error), error
