# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the macros of ParaView's window do, for scripts as well.

    from sphericalstyle import window
    style = window.apply_preset("Toy")  # of the active source
    window.show_energy_chart(style)
    window.compare(style)

Every function takes the Spherical Style filter to work on; without one, that of the active source: itself, or
a new one behind it if it is something else.
"""
import re

from paraview import simple

from sphericalstyle import presets


def find_style(source=None):
    """The Spherical Style filter that is meant. @return proxy @raise RuntimeError without a source"""
    source = source or simple.GetActiveSource()
    if source is None:
        raise RuntimeError("Spherical Style: open a model, or select one in the pipeline browser, first")
    if source.GetXMLName() == "SphericalStyleFilter":
        return simple.OutputPort(source, 0)  # another one may be selected
    return simple.SphericalStyle(Input=source)


def _render_view():
    """The active view, if it shows surfaces, else the first or a new one that does."""
    view = simple.GetActiveView()
    if view is not None and view.GetXMLName() == "RenderView":
        return view
    return simple.FindViewOrCreate("RenderView1", "RenderView")


def _show(style, view):
    """The result in place of the model."""
    simple.Show(style, view)
    simple.Hide(style.Input, view)
    simple.SetActiveSource(style)
    simple.Render(view)


def apply_preset(name, source=None):
    """Sets what the preset says, executes and shows the result.
    @param name  of sphericalstyle.presets.PRESETS @return the filter"""
    preset = presets.find(name)
    style = find_style(source)
    for property_, value in preset.properties.items():
        words = re.sub("(?<=[a-z])(?=[A-Z])", " ", value) if isinstance(value, str) else value  # as in the panel
        style.SetPropertyWithName(property_, words)
    _show(style, _render_view())
    return style


def show_energy_chart(source=None):
    """Energy over the iterations, in a chart beside the active view. @return the chart's view

    A result in closed form minimizes nothing: the chart is then empty, and its title says so.
    @raise RuntimeError where the filter has no result"""
    style = find_style(source)
    view = _render_view()
    _show(style, view)
    if style.GetDataInformation(0).GetNumberOfPoints() == 0:
        raise RuntimeError("Spherical Style: the filter has no result; its panel says why")
    chart = simple.CreateView("XYChartView")
    rows = style.GetDataInformation(1).GetNumberOfRows()
    chart.ChartTitle = "Energy" if rows > 1 else "Energy: no iteration" if rows == 1 else \
        "No energy: the result is in closed form"
    chart.LeftAxisTitle = "energy (length squared)"
    chart.BottomAxisTitle = "iteration"
    simple.AssignViewToLayout(view=chart, layout=simple.GetLayout(view), hint=0)
    display = simple.Show(simple.OutputPort(style, 1), chart)
    names = ("Total", "Rigid", "Spherical")
    display.UseIndexForXAxis = 0
    display.XArrayName = "Iteration"
    display.SeriesVisibility = list(names) if rows > 1 else [""]  # VTK's lines of one point are errors
    display.SeriesMarkerStyle = [text for name in names for text in (name, "4")]  # circles
    simple.Render(chart)
    simple.SetActiveView(view)
    simple.SetActiveSource(style)
    return chart


def compare(source=None):
    """Model and result side by side, in a layout of their own with one camera. @return both views"""
    style = find_style(source)
    layout = simple.CreateLayout("Before and After")
    before, after = simple.CreateView("RenderView"), simple.CreateView("RenderView")
    simple.AssignViewToLayout(view=before, layout=layout, hint=0)
    layout.SplitHorizontal(0, 0.5)
    simple.AssignViewToLayout(view=after, layout=layout, hint=2)
    simple.Show(style.Input, before)
    simple.Show(style, after)
    simple.AddCameraLink(before, after, f"Before and After {layout.GetGlobalIDAsString()}")
    simple.ResetCamera(before)
    for view in (before, after):
        simple.Render(view)
    simple.SetActiveView(after)
    simple.SetActiveSource(style)
    return before, after
