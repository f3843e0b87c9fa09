# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy runs with every entry of every enumeration, and outputs and facts arrive.

usage: pvpython TestNonlinearStyleFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
import os
import sys

from paraview import servermanager
from paraview.simple import *
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

from ProxyTesting import arrays, bounds, check_entries, check_state, make_long_sphere, update

LoadPlugin(sys.argv[1], remote=False, ns=globals())

model = make_long_sphere()

# ----------------------------------------------------------------- defaults, as the panel gets them
nonlinear = NonlinearStyle(Input=model)
assert nonlinear.Roundness == 1.0 and nonlinear.CenterConstraint == "Corrected"
assert nonlinear.CenterMode == "Area Centroid" and nonlinear.StopRule == "Converged"
update(nonlinear)
assert arrays(nonlinear) == {"Normals": 3, "Displacement": 3}, arrays(nonlinear)
assert bounds(nonlinear) != bounds(model)
nonlinear.GenerateAuxiliaryScale = nonlinear.GenerateCellEnergy = nonlinear.GenerateRotation = 1
update(nonlinear)
assert arrays(nonlinear) == {"Normals": 3, "Displacement": 3, "AuxiliaryScale": 1, "CellEnergy": 1, "Rotation": 9}
assert nonlinear.PointData.GetArray("AuxiliaryScale").GetRange()[0] > 0.0

# ---------------------------------------------------------------- facts of the execution, the table
fact = nonlinear.GetPropertyValue
filter_ = nonlinear.SMProxy.GetClientSideObject()
assert fact("NumberOfIterations") == filter_.GetNumberOfIterations() > 0
assert fact("Converged") == 1
assert fact("FinalEnergy") == filter_.GetFinalEnergy() > 0.0
assert fact("EffectiveRadius") == filter_.GetEffectiveRadius() > 0.0
table = servermanager.Fetch(nonlinear, idx=1)
assert table.GetNumberOfRows() == fact("NumberOfIterations") + 1
controller = vtkSMParaViewPipelineControllerWithRendering()
assert controller.ShowInPreferredView(nonlinear.SMProxy, 1, None) is None
assert not GetViews(), "a view opened for the energy table"

nonlinear.CenterConstraint = "As Written"
update(nonlinear)
assert servermanager.Fetch(nonlinear, idx=1).GetFieldData().GetAbstractArray(
    "LinearSolver").GetValue(0) == "Eigen SparseLU"
nonlinear.MaximumNumberOfIterations = 5
check_entries(nonlinear, ("CenterMode", "CenterConstraint", "StopRule", "OutputPointsPrecision"))

# ------------------------------------------------------------------------------------------ state
kept = check_state(nonlinear, os.path.join(sys.argv[2], "TestNonlinearStyleFilterProxy.pvsm"))
assert kept.GenerateRotation == 1
