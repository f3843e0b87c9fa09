# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pipelines of ParaView: blocks are printed one by one, and the picture of a rounded creature, as it is and on its
foot.

usage: pvpython TestPrintableFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import servermanager, smtesting
from paraview.simple import *

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())


def column(table):
    return [table.GetColumn(2).GetValue(row) for row in range(table.GetNumberOfRows())]


# ---------------------------------------------------------------------- blocks keep to themselves
models = [XMLPolyDataReader(FileName=[f"{data}/{name}.vtp"]) for name in ("snowman", "creature")]
together = Printable(Input=GroupDatasets(Input=models))
UpdatePipeline(proxy=together)
tables = servermanager.Fetch(together, idx=1)
for k, model in enumerate(models):
    alone = Printable(Input=model)
    UpdatePipeline(proxy=alone)
    assert column(tables.GetBlock(k)) == column(servermanager.Fetch(alone, idx=1)), k

# -------------------------------------------------------------- the picture, from below: rounded, on its foot
view = CreateRenderView(ViewSize=[500, 300], UseColorPaletteForBackground=0,
                        Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)
rounded = SphericalStyle(Input=models[1])
for place, shown in enumerate((rounded, Printable(Input=rounded, FootArea=0.08, StabilityAngle=15.0))):
    moved = Transform(Input=shown, Transform="Transform")
    moved.Transform.Translate = [1.1 * place, 0.0, 0.0]
    display = Show(moved, view)
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = [0.88, 0.62, 0.47]
Render(view)  # the first one resets the camera
view.CameraFocalPoint, view.CameraPosition = [0.55, 0.45, 0.0], [0.55, -3.4, 2.6]
view.CameraViewUp, view.CameraViewAngle = [0.0, 1.0, 0.0], 15.0
Render(view)
if not smtesting.DoRegressionTesting(view.SMProxy):
    sys.exit("Failed Image Test")
