# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in ParaView's window, beside a player that chooses the preset Ball and Keep On Ground, and presses Apply: one
step to undo, and a trace that sets what the preset says, the axis that is up in the view, and nothing else of the
shape. Prints "traced", or an error."""
import re

from paraview import servermanager, simple

model = simple.Sphere()
style = simple.SphericalStyle(registrationName="style", Input=model)
view = simple.GetActiveViewOrCreate("RenderView")
view.CameraViewUp = [0.0, 0.1, 1.0]
simple.Show(style, view)
simple.SetActiveSource(style)
simple.Render(view)
undo = servermanager.vtkSMProxyManager.GetProxyManager().GetUndoStackBuilder().GetUndoStack()
undo.Clear()
servermanager.vtkSMTrace.StartTrace()


def check(*_):
    if not undo.CanUndo() or undo.GetUndoSetLabel(0) != "Apply" or not servermanager.vtkSMTrace.GetActiveTracer():
        return
    trace = servermanager.vtkSMTrace.StopTrace()
    # style.Roundness = 5.0, and from ParaView 6 on style.Set(Roundness=5.0, ...)
    values = {name: float(value) for name, value in
              re.findall(r"\b(Roundness|NormalBlend|DetailSize|NormalRadius|KeepOnGround) ?= ?([\d.]+)", trace)}
    axis = re.findall(r"\bUpAxis ?= ?'(.)'", trace)
    steps = undo.GetNumberOfUndoSets()
    expected = {"Roundness": 5.0, "NormalBlend": 0.0, "DetailSize": 0.03, "KeepOnGround": 1.0}
    if values == expected and axis == ["Z"] and steps == 1:
        print("traced", values)
    else:
        print(f"\nERROR: {steps} steps to undo, values {values} and axis {axis} in the trace:\n{trace}")


undo.AddObserver("ModifiedEvent", check)
