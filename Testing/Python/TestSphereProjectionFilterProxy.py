# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy runs with every entry of every enumeration, and the facts arrive.

usage: pvpython TestSphereProjectionFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
import math
import os
import sys

from paraview import servermanager
from paraview.simple import *
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

from ProxyTesting import arrays, bounds, check_entries, check_state, make_long_sphere, update

LoadPlugin(sys.argv[1], remote=False, ns=globals())

model = make_long_sphere()
n = model.GetDataInformation().GetNumberOfPoints()

# ----------------------------------------------------------------- defaults, as the panel gets them
projection = SphereProjection(Input=model)
assert projection.Coefficient == 0.5 and projection.CenterMode == "Point Mean"
assert projection.RadiusMode == "Outer" and projection.Radius == 1.0
assert all(abs(c) < 1e-6 for c in projection.Center), list(projection.Center)
update(projection)
assert servermanager.Fetch(projection).GetNumberOfPoints() == n
assert arrays(projection) == {"Normals": 3, "Displacement": 3}, arrays(projection)
assert abs(projection.GetPropertyValue("EffectiveRadius") - 1.0) < 1e-6
assert math.dist(projection.GetPropertyValue("EffectiveCenter"), (0.0, 0.0, 0.0)) < 1e-6
expected = (-0.75, 0.75, -0.75, 0.75, -1.0, 1.0)  # half way from 0.5, 0.5, 1 to 1
assert max(abs(a - b) for a, b in zip(bounds(projection), expected)) < 0.01, bounds(projection)
check_entries(projection, ("CenterMode", "RadiusMode", "OutputPointsPrecision"))

projection.Coefficient = 1.0
projection.CenterMode, projection.Center = "Custom", [0.0, 0.0, 0.25]
projection.RadiusMode, projection.Radius = "Custom", 3.0
update(projection)
assert tuple(projection.GetPropertyValue("EffectiveCenter")) == (0.0, 0.0, 0.25)
assert projection.GetPropertyValue("EffectiveRadius") == 3.0
assert abs(bounds(projection)[5] - 3.25) < 1e-6, bounds(projection)
assert vtkSMParaViewPipelineControllerWithRendering().ShowInPreferredView(
    projection.SMProxy, 0, CreateRenderView().SMProxy) is not None

# ------------------------------------------------------------------------------------------ state
kept = check_state(projection, os.path.join(sys.argv[2], "TestSphereProjectionFilterProxy.pvsm"))
assert kept.RadiusMode == "Custom" and kept.Radius == 3.0
