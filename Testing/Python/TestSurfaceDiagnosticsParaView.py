# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pipelines of ParaView: blocks keep to themselves, and the picture of what is marked.

usage: pvpython TestSurfaceDiagnosticsParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import servermanager, smtesting
from paraview.simple import *

from ProxyTesting import move

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())


def counts(findings):
    return [findings.GetColumnByName("Count").GetValue(row) for row in range(findings.GetNumberOfRows())]


# ---------------------------------------------------------------------- blocks keep to themselves
models = [XMLPolyDataReader(FileName=[f"{data}/{name}.vtp"]) for name in ("creature", "car")]
together = SurfaceDiagnostics(Input=GroupDatasets(Input=models))
UpdatePipeline(proxy=together)
tables = servermanager.Fetch(together, idx=1)
for k, model in enumerate(models):
    alone = SurfaceDiagnostics(Input=model)
    UpdatePipeline(proxy=alone)
    assert counts(tables.GetBlock(k)) == counts(servermanager.Fetch(alone, idx=1)), k

# ------------------------------------ the picture: a car's parts, borders, obtuse triangles, slivers
car = SurfaceDiagnostics(Input=models[1], SliverAngle=10.0, WeldCoincidentPoints=0)
UpdatePipeline(proxy=car)
view = CreateRenderView(ViewSize=[800, 240], UseColorPaletteForBackground=0,
                        Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)
bounds = car.GetDataInformation().GetBounds()
size = [bounds[2 * k + 1] - bounds[2 * k] for k in range(3)]
center = [0.5 * (bounds[2 * k + 1] + bounds[2 * k]) for k in range(3)]
for place, (association, array) in enumerate((("CELLS", "Component"), ("POINTS", "BorderEdges"),
                                              ("CELLS", "ObtuseTriangles"), ("CELLS", "Slivers"))):
    copy = PassArrays(Input=car, PointDataArrays=["BorderEdges"],
                      CellDataArrays=["Component", "ObtuseTriangles", "Slivers"])
    display = Show(copy, view)
    ColorBy(display, (association, array))
    colors = GetColorTransferFunction(array)
    colors.RescaleTransferFunction(0.0, 23.0 if array == "Component" else 1.0)
    display.SetScalarBarVisibility(view, False)
    move(display, 1.4 * size[0] * place)
Render(view)  # the first one resets the camera
middle = [center[0] + 2.1 * size[0], center[1], center[2]]
view.CameraFocalPoint = middle
view.CameraPosition = [middle[0], middle[1] + 6.0 * size[0], middle[2] + 6.0 * size[0]]
view.CameraViewUp, view.CameraViewAngle = [0.0, 1.0, 0.0], 13.0
Render(view)
if not smtesting.DoRegressionTesting(view.SMProxy):
    sys.exit("Failed Image Test")
