# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy makes a ball that stands; the table arrives, Apply shows the surface alone, and a state
brings the properties back.

usage: pvpython TestPrintableFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
import os
import sys

from paraview import servermanager
from paraview.simple import *
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import sphericalstyle  # gives the C++ object behind the proxy its methods

LoadPlugin(sys.argv[1], remote=False, ns=globals())


def changes_of(filter_):
    """{name: (before, after)} of the second output."""
    UpdatePipeline(proxy=filter_)
    table = servermanager.Fetch(filter_, idx=1)
    columns = [table.GetColumn(i) for i in range(table.GetNumberOfColumns())]
    assert [column.GetName() for column in columns] == ["Name", "Before", "After", "Unit"]
    return {columns[0].GetValue(row): (columns[1].GetValue(row), columns[2].GetValue(row))
            for row in range(table.GetNumberOfRows())}


# ----------------------------------------------------------------- defaults, as the panel gets them
ball = Sphere(ThetaResolution=32, PhiResolution=32, Radius=1.0)
printed = Printable(Input=ball)
assert (printed.FootArea, printed.StabilityAngle, printed.Height, printed.Volume, printed.CloseHoles,
        printed.PlaceOnPlate, printed.UpAxis) == (0.03, 10.0, 0.0, 0.0, 1, 0, "Y")
changes = changes_of(printed)
assert changes["TiltAngle"][0] < 0.0 and changes["TiltAngle"][1] >= 10.0, changes
assert abs(changes["Volume"][1] / changes["Volume"][0] - 1.0) < 1e-6, changes

# ------------------------------------------------------------------------------------ on the plate
printed.Height, printed.PlaceOnPlate = 50.0, 1
UpdatePipeline(proxy=printed)
bounds = printed.GetDataInformation().GetBounds()
assert bounds[4] == 0.0 and abs(bounds[5] - 50.0) < 1e-4, bounds

# --------------------------------------------------------------------------- what Apply shows
controller = vtkSMParaViewPipelineControllerWithRendering()
view = CreateRenderView()
assert controller.ShowInPreferredView(printed.SMProxy, 0, view.SMProxy) is not None
assert controller.ShowInPreferredView(printed.SMProxy, 1, view.SMProxy) is None
assert len(GetViews()) == 1

# ------------------------------------------------------------------------------------------ state
RenameSource("Kept", printed)
before = changes_of(printed)
state = os.path.join(sys.argv[2], "TestPrintableFilterProxy.pvsm")
SaveState(state)
ResetSession()
LoadState(state)
kept = FindSource("Kept")
assert kept.Height == 50.0 and kept.PlaceOnPlate == 1
assert changes_of(kept) == before, changes_of(kept)
