# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pipelines of ParaView: blocks have sizes of their own parts, and the picture of a creature with a large head, as it
is and rounded.

usage: pvpython TestPartSizesFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import servermanager, smtesting
from paraview.simple import *

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())


def rows(table):
    return [[table.GetColumn(i).GetValue(row) for i in range(4)] for row in range(table.GetNumberOfRows())]


# ---------------------------------------------------------------------- blocks keep to themselves
models = [SurfaceParts(Input=XMLPolyDataReader(FileName=[f"{data}/{name}.vtp"])) for name in ("snowman", "creature")]
together = PartSizes(Input=GroupDatasets(Input=models), HeadHeight=0.7)
UpdatePipeline(proxy=together)
tables = servermanager.Fetch(together, idx=1)
for k, model in enumerate(models):
    alone = PartSizes(Input=model, HeadHeight=0.7)
    UpdatePipeline(proxy=alone)
    assert rows(tables.GetBlock(k)) == rows(servermanager.Fetch(alone, idx=1)), k

# -------------------------------------------------------------- the picture: original, head, rounded and head
view = CreateRenderView(ViewSize=[600, 300], UseColorPaletteForBackground=0,
                        Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)
creature = models[1]
rounded = SphericalStyle(Input=creature, KeepOnGround=1)
for place, shown in enumerate((creature, PartSizes(Input=creature, HeadHeight=1.2, KeepOnGround=1),
                               PartSizes(Input=rounded, HeadHeight=1.2, KeepOnGround=1))):
    moved = Transform(Input=shown, Transform="Transform")
    moved.Transform.Translate = [1.3 * place, 0.0, 0.0]
    display = Show(moved, view)
    display.DiffuseColor = [0.88, 0.62, 0.47]
Render(view)  # the first one resets the camera
view.CameraFocalPoint, view.CameraPosition = [1.3, 0.55, 0.0], [1.3, 0.7, 5.2]
view.CameraViewUp, view.CameraViewAngle = [0.0, 1.0, 0.0], 22.0
Render(view)
if not smtesting.DoRegressionTesting(view.SMProxy):
    sys.exit("Failed Image Test")
