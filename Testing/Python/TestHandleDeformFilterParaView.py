# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pipelines of ParaView: blocks are posed one by one, and the picture of a creature, as it is, posed, and posed and
rounded.

usage: pvpython TestHandleDeformFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import servermanager, smtesting
from paraview.simple import *

import ProxyTesting

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())

# ---------------------------------------------------------------------- blocks keep to themselves
STAND = [0.0, 0.0, 0.0, 0.15, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
NOD = [0.0, 1.1, 0.0, 0.15, 0.1, 1.1, 0.2, 25.0, 0.0, -20.0]
models = [XMLPolyDataReader(FileName=[f"{data}/{name}.vtp"]) for name in ("snowman", "creature")]
together = HandleDeform(Input=GroupDatasets(Input=models), Handle=STAND + NOD)
UpdatePipeline(proxy=together)
for k, model in enumerate(models):
    alone = HandleDeform(Input=model, Handle=STAND + NOD)
    UpdatePipeline(proxy=alone)
    expected = ProxyTesting.points(servermanager.Fetch(alone))
    assert ProxyTesting.points(servermanager.Fetch(together).GetBlock(k)) == expected, k
    assert expected != ProxyTesting.points(servermanager.Fetch(model)), k

# ------------------------------------------- the picture: original, with other arm, tail and head, and rounded
creature = models[1]
FEET = [0.0, 0.0, 0.0, 0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
HAND = [0.45, 0.64, 0.07, 0.08, 0.4, 0.24, 0.12, 0.0, 0.0, -100.0]
TAIL = [-0.47, 0.38, -0.15, 0.08, -0.5, 0.5, -0.18, 0.0, 0.0, -40.0]
HEAD = [0.05, 0.75, 0.0, 0.2, -0.02, 0.74, 0.02, 0.0, -30.0, 18.0]
posed = HandleDeform(Input=creature, Handle=FEET + HAND + TAIL + HEAD)
view = CreateRenderView(ViewSize=[600, 300], UseColorPaletteForBackground=0,
                        Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)
for place, shown in enumerate((creature, posed, SphericalStyle(Input=posed, KeepOnGround=1))):
    moved = Transform(Input=shown, Transform="Transform")
    moved.Transform.Translate = [1.3 * place, 0.0, 0.0]
    display = Show(moved, view)
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = [0.88, 0.62, 0.47]
Render(view)  # the first one resets the camera
view.CameraFocalPoint, view.CameraPosition = [1.3, 0.5, 0.0], [1.3, 0.7, 5.2]
view.CameraViewUp, view.CameraViewAngle = [0.0, 1.0, 0.0], 22.0
Render(view)
if not smtesting.DoRegressionTesting(view.SMProxy):
    sys.exit("Failed Image Test")
