# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pipelines of ParaView: blocks, a rounding measured against its input, and the picture.

usage: pvpython TestSurfaceMetricsParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import servermanager, smtesting
from paraview.simple import *

from ProxyTesting import move

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())


def measure(proxy, name):
    UpdatePipeline(proxy=proxy)
    return servermanager.Fetch(proxy, idx=1).GetColumnByName(name).GetValue(0)


# ---------------------------------------------------------------------- blocks keep to themselves
cube = XMLPolyDataReader(FileName=[data + "/cube.vtp"])
stone = XMLPolyDataReader(FileName=[data + "/go-stone.vtp"])
together = SurfaceMetrics(Input=GroupDatasets(Input=[cube, stone]))
UpdatePipeline(proxy=together)
tables = servermanager.Fetch(together, idx=1)
for k, model in enumerate((cube, stone)):
    own = measure(SurfaceMetrics(Input=model), "Sphericity")
    assert tables.GetBlock(k).GetColumnByName("Sphericity").GetValue(0) == own, k

# ------------------------------ the picture: a model, its area ratios rounded, its smallest angles
model = XMLPolyDataReader(FileName=[data + "/creature.vtp"])
UpdatePipeline(proxy=model)
rounded = SphericalStyle(Input=model, Roundness=2.0, NormalBlend=0.0, DetailSize=0.0, KeepSize="Off")
before, after = SurfaceMetrics(Input=model), SurfaceMetrics(Input=rounded, Reference=model)
assert measure(after, "Sphericity") > measure(before, "Sphericity")
assert measure(after, "RadiusSpread") < measure(before, "RadiusSpread")
view = CreateRenderView(ViewSize=[600, 240], UseColorPaletteForBackground=0,
                        Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)
for place, (proxy, association, array, limits) in enumerate((
        (before, "POINTS", "RadialCosine", (-1.0, 1.0)),
        (after, "CELLS", "AreaRatio", (0.0, 2.0)),
        (after, "CELLS", "SmallestAngle", (0.0, 60.0)))):
    copy = PassArrays(Input=proxy, PointDataArrays=["RadialCosine"],
                      CellDataArrays=["AreaRatio", "SmallestAngle"])
    display = Show(copy, view)
    ColorBy(display, (association, array))
    GetColorTransferFunction(array).RescaleTransferFunction(*limits)
    display.SetScalarBarVisibility(view, False)
    move(display, 1.0 * place)
Render(view)  # the first one resets the camera
view.CameraPosition, view.CameraFocalPoint = [1.0, 0.9, 4.4], [1.0, 0.5, 0.0]
view.CameraViewUp, view.CameraViewAngle = [0.0, 1.0, 0.0], 16.0
Render(view)
if not smtesting.DoRegressionTesting(view.SMProxy):
    sys.exit("Failed Image Test")
