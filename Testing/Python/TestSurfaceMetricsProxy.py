# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy measures with every entry of its enumeration, the reference comes and
goes, and arrays and table arrive.

usage: pvpython TestSurfaceMetricsProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
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


def metrics(model, **properties):
    """A filter whose errors are kept and not printed."""
    filter_ = SurfaceMetrics(Input=model, **properties)
    client_side = filter_.SMProxy.GetClientSideObject()
    for sender in (client_side, client_side.GetExecutive()):
        sender.AddObserver("ErrorEvent", keep_error)
    return filter_


def table(filter_):
    """The only row of the second output."""
    UpdatePipeline(proxy=filter_)
    assert not errors, errors
    measures = servermanager.Fetch(filter_, idx=1)
    assert measures.GetNumberOfRows() == 1, measures.GetNumberOfRows()
    columns = [measures.GetColumn(i) for i in range(measures.GetNumberOfColumns())]
    return {c.GetName(): c.GetComponent(0, 0) for c in columns}


sphere = Sphere(ThetaResolution=32, PhiResolution=32)
long_sphere = Calculator(Input=sphere, Function="coordsX*iHat + coordsY*jHat + 2*coordsZ*kHat",
                         CoordinateResults=1)
UpdatePipeline(proxy=long_sphere)

# ----------------------------------------------------------------- defaults, as the panel gets them
plain = SurfaceMetrics(Input=sphere)
assert plain.CenterMode == "Point Mean" and plain.Reference is None
assert (plain.FindSelfIntersections, plain.EstimateCondition, plain.Roundness) == (1, 0, 0.5)
assert plain.WeldCoincidentPoints == 1
assert all(abs(c) < 1e-6 for c in plain.Center), list(plain.Center)

# ---------------------------------------------------------------------------- outputs of one surface
whole = metrics(sphere)
row = table(whole)
assert row["Closed"] == 1 and row["Components"] == 1 and row["EulerCharacteristic"] == 2, row
assert 0.98 < row["Sphericity"] < 1.0 and abs(row["FittedRadius"] - 0.5) < 1e-6, row
assert "AreaRatio" not in row and "Condition" not in row, row
cells = {"SmallestAngle", "LargestAngle"}
if "SelfIntersectionPairs" in row:  # not in a build without CGAL
    assert row["SelfIntersectionPairs"] == 0
    cells.add("SelfIntersections")
assert set(whole.CellData.keys()) == cells, whole.CellData.keys()
assert {"RadialCosine", "Opposition"} <= set(whole.PointData.keys())
assert set(whole.FieldData.keys()) == set(row), whole.FieldData.keys()

# ------------------------------------------------------------------------------------ the reference
pair = metrics(long_sphere, Reference=sphere, EstimateCondition=1)
row = table(pair)
assert abs(row["VolumeRatio"] - 2.0) < 1e-5 and row["TurnedOver"] == 0, row
assert abs(row["LargestDisplacement"] - 0.5) < 1e-6 and row["PinnedCondition"] > row["Condition"] > 1
assert {"AreaRatio", "TurnedOver"} <= set(pair.CellData.keys())
assert pair.MeasureThickness == 1 and abs(row["SmallestThicknessRatio"] - 1.0) < 0.01, row
assert row["ThinnedShare"] == 0 and "ThicknessRatio" in pair.PointData.keys()
pair.Reference = None
assert "VolumeRatio" not in table(pair)
pair.Reference = Sphere(ThetaResolution=16, PhiResolution=16)
UpdatePipeline(proxy=pair)
assert any("Reference: it has" in text for text in errors), errors
errors.clear()
pair.Reference = sphere
assert table(pair)["VolumeRatio"] == row["VolumeRatio"]

# ---------------------------------------------------------------------- every entry of enumerations
entries = list(pair.GetProperty("CenterMode").GetAvailable())
assert entries == ["Point Mean", "Area Centroid", "Custom"], entries
for value, entry in enumerate(entries):
    pair.CenterMode = entry
    assert math.isfinite(table(pair)["RadiusSpread"]), entry
    assert pair.SMProxy.GetClientSideObject().GetCenterMode() == value, entry

# ------------------------------------------------------- what Apply shows, and what the eyes show
controller = vtkSMParaViewPipelineControllerWithRendering()
view = CreateRenderView()
assert controller.ShowInPreferredView(whole.SMProxy, 0, view.SMProxy) is not None
assert controller.ShowInPreferredView(whole.SMProxy, 1, view.SMProxy) is None
assert len(GetViews()) == 1

# ------------------------------------------------------------------------------------------ state
pair.Center = [0.0, 0.0, 0.25]
RenameSource("Kept", pair)
before = table(pair)
state = os.path.join(sys.argv[2], "TestSurfaceMetricsProxy.pvsm")
SaveState(state)
ResetSession()
LoadState(state)
kept = FindSource("Kept")
assert kept.CenterMode == "Custom" and list(kept.Center) == [0.0, 0.0, 0.25]
assert kept.Reference is not None
after = table(kept)
assert after == before, (before, after)
