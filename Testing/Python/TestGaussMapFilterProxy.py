# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy runs with every entry of every enumeration, and all outputs and the
read-only properties arrive.

usage: pvpython TestGaussMapFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
import math
import os
import sys

from paraview import servermanager
from paraview.simple import *
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import sphericalstyle  # gives the C++ object behind the proxy its methods

LoadPlugin(sys.argv[1], remote=False, ns=globals())
errors = []


def keep_error(sender, event, text):
    errors.append(text)


keep_error.CallDataType = "string0"


def gauss_map(model, **properties):
    """A filter whose errors are kept and not printed."""
    filter_ = GaussMap(Input=model, **properties)
    client_side = filter_.SMProxy.GetClientSideObject()
    for sender in (client_side, client_side.GetExecutive()):
        sender.AddObserver("ErrorEvent", keep_error)
    return filter_


def update(proxy):
    UpdatePipeline(proxy=proxy)
    proxy.UpdatePipelineInformation()
    assert not errors, errors


# A box: six units, hit twice each. Its source brings point normals, those of the faces.
box = Box()
plain = gauss_map(box)
assert plain.NormalSource == "Face Normals" and plain.SphereUnits == "Equal Angle"
assert plain.AreaWeighted == 0 and plain.OftenThreshold == 5.0
assert plain.NumberOfEqualAreaUnits == 1000 and list(plain.NormalsArray) == ["POINTS", "None"]
for name, limits in (("OftenThreshold", (0, None)), ("NumberOfEqualAreaUnits", (10, 100000))):
    domain = plain.SMProxy.GetProperty(name).FindDomain("vtkSMDoubleRangeDomain") or \
        plain.SMProxy.GetProperty(name).FindDomain("vtkSMIntRangeDomain")
    assert domain.GetMinimum(0) == limits[0], name
    assert limits[1] is None or domain.GetMaximum(0) == limits[1], name

# ---------------------------------------------------------- outputs and the facts of the execution
update(plain)
sphere, image, table = (servermanager.Fetch(plain, idx=k) for k in range(3))
assert sphere.GetNumberOfCells() == 360 * 180
assert sphere.GetCellData().GetScalars().GetName() == "Density"
assert image.GetDimensions() == (360, 180, 1)
counts = image.GetPointData().GetArray("Count")
hit = [i for i in range(360 * 180) if counts.GetTuple1(i)]
assert len(hit) == 6 and all(counts.GetTuple1(i) == 2.0 for i in hit), hit
fact = plain.GetPropertyValue
assert fact("NumberOfNormals") == 12 and fact("UnitsHit") == 6 and fact("UnitsHitOften") == 0
assert fact("EqualAreaUnitsHit") == 6 and fact("EqualAreaUnitsHitOften") == 0
assert math.isclose(fact("Entropy"), math.log(6), rel_tol=1e-12)
assert math.isclose(fact("RelativeEntropy"), math.log(6, 1000), rel_tol=1e-12)
assert math.isclose(fact("KullbackLeiblerDivergence"), math.log(1000 / 6), rel_tol=1e-12)
assert math.isclose(fact("DistanceToUniform"), 0.994, rel_tol=1e-12)
row = {table.GetColumnName(k): table.GetValue(0, k).ToDouble()
       for k in range(table.GetNumberOfColumns())}
assert table.GetNumberOfRows() == 1 and len(row) == 10, row
for column, value in row.items():
    name = {"Normals": "NumberOfNormals", "EqualAreaUnits": "NumberOfEqualAreaUnits"}.get(column, column)
    assert fact(name) == value, (column, value, fact(name))

# ------------------------------------------------------------------ properties and enumerations
every = gauss_map(box, OftenThreshold=1.5, AreaWeighted=1, NumberOfEqualAreaUnits=200)
for name in ("NormalSource", "SphereUnits"):
    in_cxx = getattr(every.SMProxy.GetClientSideObject(), "Get" + name)
    entries = list(every.GetProperty(name).GetAvailable())
    assert len(entries) == 2, (name, entries)
    for value, entry in enumerate(entries):
        every.SetPropertyWithName(name, entry)
        update(every)
        assert in_cxx() == value, (name, entry, in_cxx())
        assert every.GetPropertyValue("UnitsHit") == every.GetPropertyValue("UnitsHitOften") == 6
assert servermanager.Fetch(every).GetNumberOfCells() == 200
assert every.GetPropertyValue("NumberOfNormals") == 24  # point normals

# ----------------------------------------------------------------------------------------- arrays
up = Calculator(Input=box, Function="kHat", ResultArrayName="up")
flat = Calculator(Input=up, Function="1", ResultArrayName="one")
named = gauss_map(flat, NormalSource="Point Normals", NormalsArray=["POINTS", "up"])
update(named)
assert named.GetPropertyValue("UnitsHit") == 1 and named.GetPropertyValue("Entropy") == 0.0
domain = named.SMProxy.GetProperty("NormalsArray").FindDomain("vtkSMArrayListDomain")
offered = {domain.GetString(i) for i in range(domain.GetNumberOfStrings())}
assert {"None", "up"} <= offered and "one" not in offered, offered
named.NormalsArray = ["POINTS", "None"]  # the box's own
update(named)
assert named.GetPropertyValue("UnitsHit") == 6

# ------------------------------------------------------- what Apply shows, and what the eyes show
controller = vtkSMParaViewPipelineControllerWithRendering()
view = CreateRenderView()
assert controller.ShowInPreferredView(plain.SMProxy, 0, view.SMProxy) is not None
display = GetDisplayProperties(plain, view)
assert list(display.ColorArrayName) == ["CELLS", "Density"], list(display.ColorArrayName)
for port in (1, 2):
    assert controller.ShowInPreferredView(plain.SMProxy, port, view.SMProxy) is None, port
    assert not controller.GetVisibility(plain.SMProxy, port, view.SMProxy), port
assert len(GetViews()) == 1

# ------------------------------------------------------------------------------------------ state
RenameSource("Kept", every)
state = os.path.join(sys.argv[2], "TestGaussMapFilterProxy.pvsm")
SaveState(state)
ResetSession()
LoadState(state)
kept = FindSource("Kept")
assert kept.NormalSource == "Point Normals" and kept.SphereUnits == "Equal Area"
assert kept.OftenThreshold == 1.5 and kept.AreaWeighted == 1 and kept.NumberOfEqualAreaUnits == 200
update(kept)
assert kept.GetPropertyValue("UnitsHitOften") == 6
