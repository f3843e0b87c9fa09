# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy inspects a dirty surface, table and arrays arrive, Threshold takes what
is marked, and a state brings it back.

usage: pvpython TestSurfaceDiagnosticsProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
import os
import sys

from paraview import servermanager
from paraview.simple import *
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import sphericalstyle  # gives the C++ object behind the proxy its methods

LoadPlugin(sys.argv[1], remote=False, ns=globals())


def table(filter_):
    """{name: (count, first id)} of the second output."""
    UpdatePipeline(proxy=filter_)
    findings = servermanager.Fetch(filter_, idx=1)
    columns = {findings.GetColumnName(i): findings.GetColumn(i) for i in range(findings.GetNumberOfColumns())}
    assert list(columns) == ["Name", "Count", "Value", "Association", "FirstId", "Meaning", "Consequence"]
    return {columns["Name"].GetValue(row): (columns["Count"].GetValue(row), columns["FirstId"].GetValue(row))
            for row in range(findings.GetNumberOfRows())}


# ----------------------------------------------------------------- defaults, as the panel gets them
sphere = Sphere(ThetaResolution=24, PhiResolution=24)
plain = SurfaceDiagnostics(Input=sphere)
assert (plain.SliverAngle, plain.WeldCoincidentPoints) == (1.0, 1)

# ------------------------------------------------------------------------------ a sound and a cut one
sound = table(plain)
assert len(sound) == 19 and sound["BorderEdges"] == (0, -1) and sound["Components"] == (1, -1), sound
marks = {"DegenerateTriangles", "DuplicateTriangles", "Slivers", "ObtuseTriangles", "NonManifoldEdges",
         "BorderEdges", "MisorientedEdges", "NegativeWeights", "InsideOutComponents"}
assert set(plain.CellData.keys()) == marks | {"Diagnosis", "Component"}, plain.CellData.keys()
assert {"Diagnosis", "NonFinitePoints", "CoincidentPoints", "UnusedPoints", "NonManifoldPoints",
        "BorderEdges"} <= set(plain.PointData.keys()), plain.PointData.keys()

half = ExtractSurface(Input=Clip(Input=sphere, ClipType="Plane"))
cut = SurfaceDiagnostics(Input=half)
found = table(cut)
assert found["BorderLoops"][0] == 1 and found["BorderEdges"][0] >= 24, found

# -------------------------------------------------- what is marked is what Threshold finds, and all
border = Threshold(Input=cut, Scalars=["POINTS", "BorderEdges"], LowerThreshold=1.0, UpperThreshold=1.0,
                   AllScalars=0)
UpdatePipeline(proxy=border)
assert 0 < border.GetDataInformation().GetNumberOfCells() < cut.GetDataInformation().GetNumberOfCells()

# ------------------------------------------------------------------------------------- properties
cut.SliverAngle = 60.0
assert table(cut)["Slivers"][0] > found["Slivers"][0]
assert cut.SMProxy.GetClientSideObject().GetSliverAngle() == 60.0
box = SurfaceDiagnostics(Input=Box())  # each side has corners of its own
assert table(box)["Components"][0] == 1 and table(box)["CoincidentPoints"][0] == 16, table(box)
box.WeldCoincidentPoints = 0
assert table(box)["Components"][0] == 6 and table(box)["BorderLoops"][0] == 6, table(box)

# ------------------------------------------------------- what Apply shows, and what the eyes show
controller = vtkSMParaViewPipelineControllerWithRendering()
view = CreateRenderView()
assert controller.ShowInPreferredView(plain.SMProxy, 0, view.SMProxy) is not None
assert controller.ShowInPreferredView(plain.SMProxy, 1, view.SMProxy) is None
assert len(GetViews()) == 1

# ------------------------------------------------------------------------------------------ state
RenameSource("Kept", box)
before = table(box)
state = os.path.join(sys.argv[2], "TestSurfaceDiagnosticsProxy.pvsm")
SaveState(state)
ResetSession()
LoadState(state)
kept = FindSource("Kept")
assert kept.WeldCoincidentPoints == 0 and table(kept) == before, table(kept)
