# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pipelines of ParaView: blocks keep to themselves, and the picture of the creature's parts.

usage: pvpython TestSurfacePartsFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import servermanager, smtesting
from paraview.simple import *

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())


def areas(table):
    return [table.GetColumnByName("Area").GetValue(row) for row in range(table.GetNumberOfRows())]


# ---------------------------------------------------------------------- blocks keep to themselves
models = [XMLPolyDataReader(FileName=[f"{data}/{name}.vtp"]) for name in ("snowman", "creature")]
together = SurfaceParts(Input=GroupDatasets(Input=models))
UpdatePipeline(proxy=together)
tables = servermanager.Fetch(together, idx=1)
for k, model in enumerate(models):
    alone = SurfaceParts(Input=model)
    UpdatePipeline(proxy=alone)
    assert areas(tables.GetBlock(k)) == areas(servermanager.Fetch(alone, idx=1)), k

# ----------------------------------- the picture: what nine parts of the creature are, from two sides
view = CreateRenderView(ViewSize=[600, 360], UseColorPaletteForBackground=0,
                        Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)
colors = GetColorTransferFunction("PartId")
colors.InterpretValuesAsCategories = 1
colors.AnnotationsInitialized = 1
colors.Annotations = [text for k in range(9) for text in (str(k), str(k))]
colors.IndexedColors = [0.91, 0.44, 0.44, 0.36, 0.49, 0.87, 0.47, 0.62, 0.25, 0.93, 0.55, 0.15, 0.10, 0.86, 0.73, 0.56,
                        0.24, 0.60, 0.35, 0.30, 0.62, 0.95, 0.80, 0.30, 0.60, 0.60, 0.60]
for side in (0, 1):
    turned = Transform(Input=alone, Transform="Transform")
    turned.Transform.Rotate = [0.0, 180.0 * side, 0.0]
    turned.Transform.Translate = [1.2 * side, 0.0, 0.0]
    display = Show(turned, view)
    ColorBy(display, ("CELLS", "PartId"))
    display.SetScalarBarVisibility(view, False)
Render(view)  # the first one resets the camera
view.CameraFocalPoint, view.CameraPosition = [0.6, 0.5, 0.0], [0.6, 0.7, 3.4]
view.CameraViewUp, view.CameraViewAngle = [0.0, 1.0, 0.0], 23.0
Render(view)
if not smtesting.DoRegressionTesting(view.SMProxy):
    sys.exit("Failed Image Test")
