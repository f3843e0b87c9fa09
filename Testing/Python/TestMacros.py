# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Every macro runs, and does what its name says; presets by name, for scripts.

usage: pvpython TestMacros.py MACROS MODEL
PV_PLUGIN_PATH has to name the folder of the plugin.
"""
import os
import re
import sys

import ProxyTesting
from paraview.simple import *
from vtkmodules.vtkCommonCore import vtkLogger

from sphericalstyle import presets, window

macros, model_file = sys.argv[1:]
names = {name[len("Spherical Style "):-len(".py")] for name in os.listdir(macros)}
assert names == {"Energy Chart", "Before and After"}, names


def run(name):
    """As ParaView runs it: as the main program."""
    with open(os.path.join(macros, f"Spherical Style {name}.py")) as file:
        exec(compile(file.read(), name, "exec"), {"__name__": "__main__"})


def select_port(index):
    """As the pipeline browser does it. The filter of the port is meant."""
    model = servermanager.ProxyManager().GetSelectionModel("ActiveSources")
    model.SetCurrentProxy(style.SMProxy.GetOutputPort(index), model.CLEAR_AND_SELECT)
    assert GetActiveSource().Port == index


try:
    run("Before and After")
    raise SystemExit("there is nothing to round")
except RuntimeError as error:
    assert "open a model" in str(error), error

model = OpenDataFile(model_file)
view = CreateView("RenderView")
AssignViewToLayout(view=view, layout=CreateLayout("Layout"), hint=0)
Show(model, view)
SetActiveSource(model)

# ----------------------------------------------------------------------------------------- presets
style = window.apply_preset("Soft")
assert style == GetActiveSource()
assert style.GetXMLName() == "SphericalStyleFilter" and style.Input == model
assert GetRepresentation(style, view).Visibility == 1 and GetRepresentation(model, view).Visibility == 0
shapes = set()
for name, preset in presets.PRESETS.items():
    style.Center, style.ReproduceThesis = [0.1, 0.2, 0.3], 1
    style.SphericalWeighting = "Uniform"
    window.apply_preset(name)
    assert len(GetSources()) == 2 and GetActiveSource() == style  # the same filter, set anew
    for property_, value in preset.properties.items():
        words = re.sub("(?<=[a-z])(?=[A-Z])", " ", value) if isinstance(value, str) else value
        assert getattr(style, property_) == words, (name, property_, getattr(style, property_))
    assert not style.ReproduceThesis and list(style.Center) == [0.1, 0.2, 0.3]
    shapes.add(ProxyTesting.bounds(style))
assert len(shapes) == len(presets.PRESETS)
try:
    window.apply_preset("Cube")
    raise SystemExit("there is no such preset")
except ValueError as error:
    assert "'Cube'" in str(error) and "Pebble" in str(error), error

# ------------------------------------------------------------------------------------ energy chart
window.apply_preset("Toy")
run("Energy Chart")  # nothing in it, and it says why
chart, = (v for v in GetViews() if v.GetXMLName() == "XYChartView")
assert "closed form" in chart.ChartTitle, chart.ChartTitle
Delete(chart)
style.SphericalWeighting = "Uniform"  # iterates
run("Energy Chart")
chart, = (v for v in GetViews() if v.GetXMLName() == "XYChartView")
assert chart.ChartTitle == "Energy", chart.ChartTitle
display = GetRepresentation(OutputPort(style, 1), chart)
assert display.XArrayName == "Iteration" and display.Visibility == 1
assert list(display.SeriesVisibility) == ["Total", "Rigid", "Spherical"], list(display.SeriesVisibility)
assert GetLayout(chart) == GetLayout(view) and GetActiveView() == view

Delete(chart)
Hide(style, view)
select_port(1)
run("Energy Chart")
assert len(GetSources()) == 2 and GetRepresentation(style, view).Visibility == 1
count = len(GetViews())
style.Roundness = float("nan")
vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # that it fails is wanted
style.UpdatePipeline()
vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_WARNING)
try:
    window.show_energy_chart(style)
    raise SystemExit("there is no result")
except RuntimeError as error:
    assert "no result" in str(error) and len(GetViews()) == count, error
style.Roundness = 1.0

# ---------------------------------------------------------------------------------- before and after
select_port(2)
count = len(GetViews())
run("Before and After")
assert len(GetViews()) == count + 2 and len(GetSources()) == 2
after = GetActiveView()
before, = (v for v in GetViewsInLayout(GetLayout(after)) if v != after)
assert GetRepresentation(model, before).Visibility == 1 and GetRepresentation(style, after).Visibility == 1
assert [shown.Input.Port for shown in after.Representations] == [0]
before.CameraPosition = [1.0, 2.0, 3.0]
Render(before)  # the link follows it
assert list(after.CameraPosition) == [1.0, 2.0, 3.0], list(after.CameraPosition)
