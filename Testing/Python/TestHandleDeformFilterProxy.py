# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy bends a long ball by rows of handles, which arrive in C++ as they are; points of handles
are where they were put, array and table come, an array of handles is followed, and a state brings the rows back.

usage: pvpython TestHandleDeformFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
import os
import sys

from paraview import servermanager
from paraview.simple import *
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import ProxyTesting

LoadPlugin(sys.argv[1], remote=False, ns=globals())


def fact(proxy, name):
    """What the filter tells of its last execution."""
    return proxy.GetProperty(name).GetData()



# ----------------------------------------------------------------- defaults, as the panel gets them
model = ProxyTesting.make_long_sphere()  # from z = -1 to 1
posed = HandleDeform(Input=model, OutputPointsPrecision="Double")
assert (list(posed.Handle), posed.ComponentCoupling, posed.StopRule, posed.Tolerance, posed.MaximumNumberOfIterations,
        list(posed.HandleArray)[-1]) == ([], "Stitched", "Converged", 1e-5, 500, "None"), list(posed.Handle)
ProxyTesting.update(posed)
before = ProxyTesting.points(servermanager.Fetch(model))
assert ProxyTesting.points(servermanager.Fetch(posed)) == before
assert fact(posed, "NumberOfHandles") == 0 and fact(posed, "NumberOfIterations") == 0

# -------------------------------------------------------------------------------------------- rows
PIN = [0, 0, -1, 0.4, 0, 0, -1, 0, 0, 0]
BENT = [0, 0, 1, 0.3, 0.9, 0, 0.3, 0, 80, 0]
posed.Handle = PIN + BENT
ProxyTesting.update(posed)
filter_ = posed.SMProxy.GetClientSideObject()
assert fact(posed, "NumberOfHandles") == 2 and [list(filter_.GetHandle(k)) for k in (1, 2)] == [PIN, BENT]
data = servermanager.Fetch(posed)
rows = [data.GetPointData().GetArray("Handle").GetValue(i) for i in range(data.GetNumberOfPoints())]
after = ProxyTesting.points(data)
pinned = [i for i, row in enumerate(rows) if row == 1]
assert len(pinned) > 10 and rows.count(2) > 10 and rows.count(0) > 100, rows
assert all(after[i] == before[i] for i in pinned), "pinned points keep their bits"
top = max(range(len(before)), key=lambda i: before[i][2])
assert before[top] == (0.0, 0.0, 1.0) and after[top] == (0.9, 0.0, 0.3), after[top]
assert fact(posed, "Converged") == 1 and fact(posed, "NumberOfIterations") > 2 and fact(posed, "FinalEnergy") > 0.0
table = servermanager.Fetch(posed, idx=1)
names = [table.GetColumn(k).GetName() for k in range(table.GetNumberOfColumns())]
assert names == ["Iteration", "Total", "Rigid", "LocalChange", "GlobalChange", "Residual", "Gap"], names
assert table.GetNumberOfRows() == fact(posed, "NumberOfIterations") + 1

# ------------------------------------------------------------------------------- enumerations, array
ProxyTesting.check_entries(posed, ["ComponentCoupling", "StopRule", "OutputPointsPrecision"])
again = HandleDeform(Input=Transform(Input=posed), Handle=[*PIN[:3], 0, *PIN[4:], *after[top], 0, 0, 0, 1, 0, 0, 0],
                     HandleArray=["POINTS", "Handle"])
ProxyTesting.update(again)
assert fact(again, "NumberOfIterations") > 0
data = servermanager.Fetch(again)
assert [data.GetPointData().GetArray("Handle").GetValue(i) for i in range(data.GetNumberOfPoints())] == rows

# --------------------------------------------------------------------------- what Apply shows
controller = vtkSMParaViewPipelineControllerWithRendering()
view = CreateRenderView()
assert controller.ShowInPreferredView(posed.SMProxy, 0, view.SMProxy) is not None
assert controller.ShowInPreferredView(posed.SMProxy, 1, view.SMProxy) is None
assert len(GetViews()) == 1

# ------------------------------------------------------------------------------------------ state
kept = ProxyTesting.check_state(posed, os.path.join(sys.argv[2], "TestHandleDeformFilterProxy.pvsm"))
assert list(kept.Handle) == PIN + BENT, list(kept.Handle)
