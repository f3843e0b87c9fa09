# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pipelines of ParaView: blocks, time steps, all outputs in one view, and the picture.

usage: pvpython TestConvexProxyDeformFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import servermanager, smtesting
from paraview.simple import *

from ProxyTesting import bounds, make_growing_sphere, move, points

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())

# ---------------------------------------------------------------------- blocks keep to themselves
cube = XMLPolyDataReader(FileName=[data + "/cube.vtp"])
stone = XMLPolyDataReader(FileName=[data + "/go-stone.vtp"])
alone = [ConvexProxyDeform(Input=model, NumberOfProxyPoints=500) for model in (cube, stone)]
together = ConvexProxyDeform(Input=GroupDatasets(Input=[cube, stone]), NumberOfProxyPoints=500)
UpdatePipeline(proxy=together)
for port in range(3):
    blocks = servermanager.Fetch(together, idx=port)
    assert blocks.GetNumberOfBlocks() == 2, port
    for k in range(2):
        UpdatePipeline(proxy=alone[k])
        own = servermanager.Fetch(alone[k], idx=port)
        assert own.GetNumberOfPoints() > 0 and points(own) == points(blocks.GetBlock(k)), (port, k)

# --------------------------------------------------------------------- every time step is a model
ball = ConvexProxyDeform(Input=make_growing_sphere(), NumberOfProxyPoints=500, Blend=0.0, Roundness=50.0)
heights = []
for time in (1.0, 3.0, 2.0, 3.0):
    UpdatePipeline(time=time, proxy=ball)
    b = bounds(ball)
    heights.append(b[5] - b[4])
    assert abs((b[1] - b[0]) / (b[5] - b[4]) - 1.0) < 0.05, (time, b)
assert heights[1] == heights[3] and heights[0] < heights[2] < heights[1], heights

# ---- the picture: a car with the lines to its hull, rounded, with only its roof rounded; the proxy
model = XMLPolyDataReader(FileName=[data + "/car.vtp"])
UpdatePipeline(proxy=model)
all_of_it = ConvexProxyDeform(Input=model, NumberOfProxyPoints=500, Blend=0.3)
roof = ConvexProxyDeform(Input=model, NumberOfProxyPoints=500, BlendFunction="Tanh",
                         BlendAtStart=1.0, BlendAtEnd=0.0, Transfer="Offset", RefineLongEdges="Off")
view = CreateRenderView(ViewSize=[800, 240], UseColorPaletteForBackground=0,
                        Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)
for place, output, color in (
        (0, model, [0.88, 0.62, 0.47]), (0, OutputPort(roof, 2), [0.1, 0.2, 0.5]),
        (1, all_of_it, [0.88, 0.62, 0.47]), (2, roof, [0.88, 0.62, 0.47]),
        (3, OutputPort(roof, 1), [0.6, 0.7, 0.85])):
    display = Show(output, view)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = color
    move(display, 1.7 * place)
Render(view)  # the first one resets the camera
view.CameraPosition, view.CameraFocalPoint = [6.0, 4.6, 14.0], [2.65, 0.38, 0.0]
view.CameraViewUp, view.CameraViewAngle = [0.0, 1.0, 0.0], 7.4
Render(view)
if not smtesting.DoRegressionTesting(view.SMProxy):
    sys.exit("Failed Image Test")
