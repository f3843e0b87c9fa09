# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy finds the parts of a surface, table and arrays arrive, Threshold takes one
of them, its ids are centers for Spherical Style, and a state brings it back.

usage: pvpython TestSurfacePartsFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
import os
import sys

from paraview import servermanager
from paraview.simple import *
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import sphericalstyle  # gives the C++ object behind the proxy its methods

LoadPlugin(sys.argv[1], remote=False, ns=globals())


def table(filter_):
    """{column: values} of the second output."""
    UpdatePipeline(proxy=filter_)
    parts = servermanager.Fetch(filter_, idx=1)
    columns = [parts.GetColumn(i) for i in range(parts.GetNumberOfColumns())]
    assert [column.GetName() for column in columns] == ["Part", "Points", "Cells", "Area", "Center", "Thickness"]
    return {column.GetName(): [column.GetTuple(row) for row in range(parts.GetNumberOfRows())] for column in columns}


# ----------------------------------------------------------------- defaults, as the panel gets them
body = Sphere(ThetaResolution=32, PhiResolution=32, Radius=1.0)
head = Sphere(ThetaResolution=32, PhiResolution=32, Radius=0.6, Center=[0.0, 1.35, 0.0])
snowman = AppendGeometry(Input=[body, head])
parts = SurfaceParts(Input=snowman)
assert (parts.Method, parts.NumberOfParts, list(parts.PartArray)) == ("Shape", 0, ["POINTS", ""]) \
    or parts.PartArray[1] in ("", "None"), parts.PartArray

# --------------------------------------------------------------------------------- head and body
found = table(parts)
assert len(found["Part"]) == 2, found
assert found["Center"][0][1] < 0.1 and found["Center"][1][1] > 1.2, found["Center"]
assert "PartId" in parts.PointData.keys() and "PartId" in parts.CellData.keys()
only = Threshold(Input=parts, Scalars=["CELLS", "PartId"], LowerThreshold=1.0, UpperThreshold=1.0)
UpdatePipeline(proxy=only)
assert only.GetDataInformation().GetNumberOfCells() == found["Cells"][1][0]

# ------------------------------------------------------------------- each with a center of its own
rounded = SphericalStyle(Input=parts, CenterIdArray=["POINTS", "PartId"], NormalBlend=0.0)
UpdatePipeline(proxy=rounded)
assert rounded.GetDataInformation().GetNumberOfPoints() == parts.GetDataInformation().GetNumberOfPoints()

# ------------------------------------------------------------------------------------- properties
parts.NumberOfParts = 1
assert len(table(parts)["Part"]) == 1
parts.Method = "Connectivity"
assert [count for count, in table(parts)["Points"]] == [body.GetDataInformation().GetNumberOfPoints(),
                                                        head.GetDataInformation().GetNumberOfPoints()]
elevation = Calculator(Input=parts, ResultArrayName="Sides", Function="floor(coordsX)")
by_array = SurfaceParts(Input=elevation, Method="Array", PartArray=["POINTS", "Sides"])
assert len(table(by_array)["Part"]) >= 2, table(by_array)
assert by_array.SMProxy.GetClientSideObject().GetMethod() == 2

# --------------------------------------------------------------------------- what Apply shows
controller = vtkSMParaViewPipelineControllerWithRendering()
view = CreateRenderView()
assert controller.ShowInPreferredView(parts.SMProxy, 0, view.SMProxy) is not None
assert list(GetDisplayProperties(parts, view=view).ColorArrayName) == ["CELLS", "PartId"]
assert controller.ShowInPreferredView(parts.SMProxy, 1, view.SMProxy) is None
assert len(GetViews()) == 1

# ------------------------------------------------------------------------------------------ state
RenameSource("Kept", by_array)
before = table(by_array)
state = os.path.join(sys.argv[2], "TestSurfacePartsFilterProxy.pvsm")
SaveState(state)
ResetSession()
LoadState(state)
kept = FindSource("Kept")
assert kept.Method == "Array" and list(kept.PartArray) == ["POINTS", "Sides"], kept.PartArray
assert str(table(kept)) == str(before), table(kept)
