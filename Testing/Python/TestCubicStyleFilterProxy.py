# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy runs with every entry of every enumeration, and outputs and facts arrive.

usage: pvpython TestCubicStyleFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
import math
import os
import sys

from paraview import servermanager
from paraview.simple import *
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import sphericalstyle  # gives the C++ object behind the proxy its methods

LoadPlugin(sys.argv[1], remote=False, ns=globals())


def update(proxy):
    UpdatePipeline(proxy=proxy)
    proxy.UpdatePipelineInformation()


def bounds(proxy):
    return proxy.GetDataInformation().GetBounds()


def arrays(proxy):
    data = servermanager.Fetch(proxy).GetPointData()
    return {data.GetArrayName(k): data.GetArray(k).GetNumberOfComponents()
            for k in range(data.GetNumberOfArrays())}


def check_entries(proxy, names):
    """Each entry of each enumeration reaches C++ and runs."""
    for name in names:
        in_cxx = getattr(proxy.SMProxy.GetClientSideObject(), "Get" + name)
        entries = list(proxy.GetProperty(name).GetAvailable())
        assert len(entries) > 1, (name, entries)
        default = entries[in_cxx()]
        for value, entry in enumerate(entries):
            proxy.SetPropertyWithName(name, entry)
            update(proxy)
            assert in_cxx() == value, (name, entry, in_cxx())
            assert all(map(math.isfinite, bounds(proxy))), (name, entry)
        proxy.SetPropertyWithName(name, default)


sphere = Sphere(ThetaResolution=32, PhiResolution=32)
model = Calculator(Input=sphere, Function="coordsX*iHat + coordsY*jHat + 2*coordsZ*kHat",
                   CoordinateResults=1)
UpdatePipeline(proxy=model)
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
RenameSource("Kept", cubic)
update(cubic)
kept_bounds = bounds(cubic)
state = os.path.join(sys.argv[2], "TestCubicStyleFilterProxy.pvsm")
SaveState(state)
ResetSession()
LoadState(state)
kept = FindSource("Kept")
update(kept)
assert kept.Cubeness == 2.0
assert bounds(kept) == kept_bounds, (bounds(kept), kept_bounds)
