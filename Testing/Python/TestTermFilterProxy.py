# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, the proxy of a filter whose style is a term runs, and outputs and facts arrive.

For the filters that have no test of their own: with every entry of every enumeration, and what more weight does.

usage: pvpython TestTermFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE NameOfTheFilter
"""
import os
import sys

from paraview import servermanager
from paraview.simple import *
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import sphericalstyle
from FilterTable import FILTERS
from ProxyTesting import arrays, bounds, check_entries, check_state, make_long_sphere, update

LoadPlugin(sys.argv[1], remote=False, ns=globals())
entry = FILTERS[sys.argv[3]]
weight = entry["weight"]

model = make_long_sphere()
n = model.GetDataInformation().GetNumberOfPoints()

# ----------------------------------------------------------------- defaults, as the panel gets them
proxy = globals()[entry["proxy"]](Input=model)
fresh = getattr(sphericalstyle, entry["class"])()
for name in (weight, "Tolerance", "MaximumNumberOfIterations"):
    assert proxy.GetPropertyValue(name) == getattr(fresh, "Get" + name)(), name
assert proxy.StopRule == "Converged" and proxy.OutputPointsPrecision == "Default"
update(proxy)
assert servermanager.Fetch(proxy).GetNumberOfPoints() == n
assert arrays(proxy) == {"Normals": 3, "Displacement": 3}, arrays(proxy)
small = bounds(proxy)
proxy.SetPropertyWithName(weight, 0.0)
update(proxy)
assert max(abs(a - b) for a, b in zip(bounds(proxy), bounds(model))) < 1e-6
proxy.SetPropertyWithName(weight, 4.0 * getattr(fresh, "Get" + weight)())
update(proxy)
assert bounds(proxy) != small

# ---------------------------------------------------------------- facts of the execution, the table
fact = proxy.GetPropertyValue
filter_ = proxy.SMProxy.GetClientSideObject()
assert fact("NumberOfIterations") == filter_.GetNumberOfIterations() > 0
assert fact("Converged") == 1, fact("Converged")
assert fact("FinalEnergy") == filter_.GetFinalEnergy() > 0.0
table = servermanager.Fetch(proxy, idx=1)
assert table.GetClassName() == "vtkTable"
assert table.GetNumberOfRows() == fact("NumberOfIterations") + 1
assert table.GetColumnByName(entry["outputs"][0]) is not None, "the term has a column of the filter's name"
controller = vtkSMParaViewPipelineControllerWithRendering()
assert controller.ShowInPreferredView(proxy.SMProxy, 1, None) is None
assert not GetViews(), "a view opened for the energy table"

check_entries(proxy, entry["enumerations"])

# ------------------------------------------------------------------------------------------ state
kept = check_state(proxy, os.path.join(sys.argv[2], f"Test{sys.argv[3]}Proxy.pvsm"))
assert kept.GetPropertyValue(weight) == 4.0 * getattr(fresh, "Get" + weight)()
