# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pipelines of ParaView: blocks, time steps, a filter after the filter, and the picture.

usage: pvpython TestSphericalStyleFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import servermanager, smtesting
from paraview.simple import *

from ProxyTesting import bounds, make_growing_sphere, move

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())


def points(proxy):
    return servermanager.Fetch(proxy).GetPoints()


# ---------------------------------------------------------------------- blocks keep to themselves
ITERATES = dict(SphericalWeighting="Uniform")  # for the tables
cube = XMLPolyDataReader(FileName=[data + "/cube.vtp"])
stone = XMLPolyDataReader(FileName=[data + "/go-stone.vtp"])
alone = [SphericalStyle(Input=model, **ITERATES) for model in (cube, stone)]
group = GroupDatasets(Input=[cube, stone])
rounded = SphericalStyle(Input=group, **ITERATES)
UpdatePipeline(proxy=rounded)
blocks, tables = servermanager.Fetch(rounded), servermanager.Fetch(rounded, idx=1)
assert blocks.GetNumberOfBlocks() == tables.GetNumberOfBlocks() == 2
for k in range(2):
    UpdatePipeline(proxy=alone[k])
    own = points(alone[k])
    block = blocks.GetBlock(k).GetPoints()
    assert own.GetNumberOfPoints() == block.GetNumberOfPoints()
    assert all(own.GetPoint(i) == block.GetPoint(i) for i in range(own.GetNumberOfPoints()))
    assert tables.GetBlock(k).GetNumberOfRows() > 0

# --------------------------------------------------------------------- every time step is a model
style = SphericalStyle(Input=make_growing_sphere(), Roundness=50.0, NormalBlend=0.0, DetailSize=0.0)
heights = []
for time in (1.0, 3.0, 2.0, 3.0):
    UpdatePipeline(time=time, proxy=style)
    b = bounds(style)
    heights.append(b[5] - b[4])
    assert abs((b[1] - b[0]) / (b[5] - b[4]) - 1.0) < 0.05, (time, b)
assert heights[1] == heights[3] and heights[0] < heights[2] < heights[1], heights

# ------------------------------------------------------------- filter after filter, and the picture
model = XMLPolyDataReader(FileName=[data + "/creature.vtp"])
UpdatePipeline(proxy=model)
first = SphericalStyle(Input=model, GenerateNormals=1)
second = SphericalStyle(Input=first, Roundness=5.0, NormalBlend=0.0, DetailSize=0.03)
view = CreateRenderView(ViewSize=[600, 240], UseColorPaletteForBackground=0,
                        Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)
for place, proxy in enumerate((model, first, second)):
    display = Show(proxy, view)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = [0.88, 0.62, 0.47]
    move(display, 1.0 * place)
Render(view)  # the first one resets the camera
view.CameraPosition, view.CameraFocalPoint = [1.0, 0.9, 4.4], [1.0, 0.5, 0.0]
view.CameraViewUp, view.CameraViewAngle = [0.0, 1.0, 0.0], 16.0
Render(view)
if not smtesting.DoRegressionTesting(view.SMProxy):
    sys.exit("Failed Image Test")
