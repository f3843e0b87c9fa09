# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy takes two inputs of any kinds that it is for, and the facts arrive.

usage: pvpython TestMeshMorphingFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
import math
import os
import sys

from paraview import servermanager
from paraview.simple import *

from ProxyTesting import arrays, bounds, check_state, update

LoadPlugin(sys.argv[1], remote=False, ns=globals())

grid = UnstructuredCellTypes(CellType="Hex", BlocksDimensions=[6, 4, 5])
style = SphericalStyle(Input=ExtractSurface(Input=grid), RefineLongEdges="Off")
update(style)
morphing = MeshMorphing(Input=grid, Surface=style)
update(morphing)
result = servermanager.Fetch(morphing)
assert result.GetClassName() == "vtkUnstructuredGrid" and result.GetNumberOfCells() == 6 * 4 * 5
assert arrays(morphing)["Displacement"] == 3, arrays(morphing)
assert max(abs(a - b) for a, b in zip(bounds(morphing), bounds(style))) < 1e-5, (bounds(morphing), bounds(style))

# -------------------------------------------------------------------------- facts of the execution
fact = morphing.GetPropertyValue
filter_ = morphing.SMProxy.GetClientSideObject()
assert fact("NumberOfVolumeCells") == 6 * 4 * 5 and fact("NumberOfInvertedCells") == 0
assert abs(fact("SmallestScaledJacobianBefore") - 1.0) < 1e-6
assert 0.0 < fact("SmallestScaledJacobianAfter") == filter_.GetSmallestScaledJacobianAfter() < 1.0
assert fact("NumberOfIterations") == filter_.GetNumberOfIterations() > 0
assert result.GetFieldData().GetArray("SmallestScaledJacobianAfter").GetTuple1(0) == fact("SmallestScaledJacobianAfter")

# --------------------------------------------------------------------------- an image becomes a grid
image = MeshMorphing(Input=Wavelet(WholeExtent=[-4, 4, -3, 3, -2, 2]), Surface=style)
update(image)
warped = servermanager.Fetch(image)
dimensions = [0, 0, 0]
warped.GetDimensions(dimensions)
assert warped.GetClassName() == "vtkStructuredGrid" and dimensions == [9, 7, 5]
assert math.isnan(image.GetPropertyValue("SmallestScaledJacobianAfter"))

# ------------------------------------------------------------------------------------------ state
kept = check_state(morphing, os.path.join(sys.argv[2], "TestMeshMorphingFilterProxy.pvsm"))
assert kept.Surface is not None and kept.Input is not None
