# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Blocks keep to themselves, and the picture: a model and what the filter makes of it.

usage: pvpython TestCubicStyleFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import servermanager, smtesting
from paraview.simple import *

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())


def points(data_set):
    return [data_set.GetPoint(i) for i in range(data_set.GetNumberOfPoints())]


# ---------------------------------------------------------------------- blocks keep to themselves
stone = XMLPolyDataReader(FileName=[data + "/go-stone.vtp"])
ico = XMLPolyDataReader(FileName=[data + "/icosahedron.vtp"])
alone = [CubicStyle(Input=model) for model in (stone, ico)]
together = CubicStyle(Input=GroupDatasets(Input=[stone, ico]))
UpdatePipeline(proxy=together)
blocks = servermanager.Fetch(together)
assert blocks.GetNumberOfBlocks() == 2
for k, single in enumerate(alone):
    UpdatePipeline(proxy=single)
    own = servermanager.Fetch(single)
    assert own.GetNumberOfPoints() > 0 and points(own) == points(blocks.GetBlock(k)), k

# ------------------------------------------------------------------------------------- the picture
creature = XMLPolyDataReader(FileName=[data + "/creature.vtp"])
view = CreateRenderView(ViewSize=[800, 200], UseColorPaletteForBackground=0,
                        Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)
for place, output in enumerate((
        creature,
        CubicStyle(Input=creature, Cubeness=0.1,
                   StopRule="Fixed Iterations", MaximumNumberOfIterations=40),
        CubicStyle(Input=creature, Cubeness=0.5,
                   StopRule="Fixed Iterations", MaximumNumberOfIterations=40),
        CubicStyle(Input=creature, Cubeness=2.0,
                   StopRule="Fixed Iterations", MaximumNumberOfIterations=40))):
    display = Show(output, view)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = [0.88, 0.62, 0.47]
    display.Position = [1.3 * place, 0.0, 0.0]
Render(view)  # the first one resets the camera
view.CameraPosition, view.CameraFocalPoint = [1.95, 0.9, 8.0], [1.95, 0.45, 0.0]
view.CameraViewUp, view.CameraViewAngle = [0.0, 1.0, 0.0], 9.0
Render(view)
if not smtesting.DoRegressionTesting(view.SMProxy):
    sys.exit("Failed Image Test")
