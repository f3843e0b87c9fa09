# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy runs with every entry of every enumeration, and outputs and facts arrive.

usage: pvpython TestCubicStyleFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
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
cubic = CubicStyle(Input=model)
assert cubic.Cubeness == 0.5 and cubic.StopRule == "Converged" and cubic.Tolerance == 0.001
assert cubic.MaximumNumberOfIterations == 500 and cubic.OutputPointsPrecision == "Default"
update(cubic)
assert servermanager.Fetch(cubic).GetNumberOfPoints() == n
assert arrays(cubic) == {"Normals": 3, "Displacement": 3}, arrays(cubic)
small = bounds(cubic)
cubic.Cubeness = 0.0
update(cubic)
assert max(abs(a - b) for a, b in zip(bounds(cubic), bounds(model))) < 1e-6
cubic.Cubeness = 2.0
update(cubic)
assert bounds(cubic) != small

# ---------------------------------------------------------------- facts of the execution, the table
fact = cubic.GetPropertyValue
filter_ = cubic.SMProxy.GetClientSideObject()
assert fact("NumberOfIterations") == filter_.GetNumberOfIterations() > 0
assert fact("Converged") == 1, fact("Converged")
assert fact("FinalEnergy") == filter_.GetFinalEnergy() > 0.0
table = servermanager.Fetch(cubic, idx=1)
assert table.GetClassName() == "vtkTable"
assert table.GetNumberOfRows() == fact("NumberOfIterations") + 1
assert table.GetColumnByName("Cubic") is not None
controller = vtkSMParaViewPipelineControllerWithRendering()
assert controller.ShowInPreferredView(cubic.SMProxy, 1, None) is None
assert not GetViews(), "a view opened for the energy table"

check_entries(cubic, ("StopRule", "OutputPointsPrecision"))

# ------------------------------------------------------------------------------------------ state
kept = check_state(cubic, os.path.join(sys.argv[2], "TestCubicStyleFilterProxy.pvsm"))
assert kept.Cubeness == 2.0
