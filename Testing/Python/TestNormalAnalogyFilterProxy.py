# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy runs with every style, the style mesh comes and goes, and outputs and
facts arrive.

usage: pvpython TestNormalAnalogyFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
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
analogy = NormalAnalogy(Input=model)
assert analogy.Style == "Cube" and analogy.Weight == 1.0 and analogy.StyleMesh is None
assert analogy.StopRule == "Converged" and analogy.Tolerance == 0.0001
update(analogy)
assert servermanager.Fetch(analogy).GetNumberOfPoints() == n
assert arrays(analogy) == {"Normals": 3, "Displacement": 3, "TargetNormal": 3}, arrays(analogy)
assert analogy.GetPropertyValue("NumberOfStyleNormals") == 6

# ---------------------------------------------------------------- facts of the execution, the table
fact = analogy.GetPropertyValue
filter_ = analogy.SMProxy.GetClientSideObject()
assert fact("NumberOfIterations") == filter_.GetNumberOfIterations() > 0
assert fact("Converged") == 1, fact("Converged")
assert fact("FinalEnergy") == filter_.GetFinalEnergy() > 0.0
table = servermanager.Fetch(analogy, idx=1)
assert table.GetClassName() == "vtkTable"
assert table.GetNumberOfRows() == fact("NumberOfIterations") + 1
assert table.GetColumnByName("Analogy") is not None
controller = vtkSMParaViewPipelineControllerWithRendering()
assert controller.ShowInPreferredView(analogy.SMProxy, 1, None) is None
assert not GetViews(), "a view opened for the energy table"

# ------------------------------------------------------------------------------------------ styles
shapes = {}
for style, normals in (("Tetrahedron", 4), ("Cube", 6), ("Octahedron", 8), ("Icosahedron", 20),
                       ("Dodecahedron", 12)):
    analogy.Style = style
    update(analogy)
    assert analogy.GetPropertyValue("NumberOfStyleNormals") == normals, style
    shapes[bounds(analogy)] = style
assert len(shapes) == 5, shapes
cube_bounds = next(b for b, style in shapes.items() if style == "Cube")
analogy.Style = "Mesh"
analogy.StyleMesh = Box(XLength=3.0)
update(analogy)
assert analogy.GetPropertyValue("NumberOfStyleNormals") == 6
assert max(abs(a - b) for a, b in zip(bounds(analogy), cube_bounds)) < 1e-6
analogy.StyleMesh = None
errors = []
filter_.AddObserver("ErrorEvent", lambda *_: errors.append(1))
filter_.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
UpdatePipeline(proxy=analogy)
assert errors, "Style Mesh without a mesh should be an error"
analogy.StyleMesh = Box(registrationName="MyBox", YLength=2.0)
check_entries(analogy, ("Style", "StopRule", "OutputPointsPrecision"))

# ------------------------------------------------------------------------------------------ state
kept = check_state(analogy, os.path.join(sys.argv[2], "TestNormalAnalogyFilterProxy.pvsm"))
assert kept.Style == "Mesh" and kept.StyleMesh is not None
