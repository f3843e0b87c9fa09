# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in ParaView's window, started by drag.py: rounds a model around a center of its own, and writes a line of
JSON to a file for each event, in their order: an execution, a message, a movement of the mouse or its button down in
the view, a change of what can be undone. Settings come in the environment variable DRAG."""
import json
import os
import tempfile
import time

import numpy
from paraview import servermanager, simple, smstate
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonCore import vtkOutputWindow

settings = json.loads(os.environ["DRAG"])
log = open(settings["log"], "w", buffering=1)


def write(**facts):
    log.write(json.dumps(facts) + "\n")


def values(name, size, unchecked=False):
    """Of a property: as applied, or as the panel shows it."""
    helper = servermanager.vtkSMPropertyHelper(style.SMProxy, name)
    helper.SetUseUnchecked(unchecked)
    return [helper.GetAsDouble(i) for i in range(size)]


general = simple.GetSettingsProxy("GeneralSettings")
general.AutoApply = settings["auto_apply"]
if settings["resolution"]:  # a ball of that number of points, squared
    model = simple.Sphere(ThetaResolution=settings["resolution"], PhiResolution=settings["resolution"])
else:
    model = simple.OpenDataFile(settings["model"])
style = simple.SphericalStyle(Input=model, **settings["properties"])
style.UpdatePipeline()
style.SMProxy.UpdatePropertyInformation()
center, radius = values("EffectiveCenter", 3), values("EffectiveRadius", 1)[0]
view = simple.GetActiveViewOrCreate("RenderView")
simple.Show(style, view)
simple.ResetCamera(view)
simple.Render(view)
simple.SetActiveSource(style)


# As chosen in the panel: the widget that shows the target sphere begins with what was shown.
for name, mode, shown in (("Center", "CenterMode", center), ("Radius", "RadiusMode", [radius])):
    if name == "Center" or settings["sphere"]:
        helper = servermanager.vtkSMPropertyHelper(style.SMProxy, mode)
        helper.SetUseUnchecked(True)
        helper.Set(2)
        begin = values(name, len(shown), unchecked=True)
        if begin != shown:
            raise RuntimeError(f"{name} begins with {begin}, but it was {shown}")
        style.SetPropertyWithName(mode, "Custom")
        style.SetPropertyWithName(name, shown)
simple.Render(view)


renderer = view.GetRenderer()


def to_screen(point):
    renderer.SetWorldPoint(*point, 1.0)
    renderer.WorldToDisplay()
    return renderer.GetDisplayPoint()


def moved_by(right, up):
    """Where the center comes to with the mouse so many pixels away, in a plane parallel to the screen through what is
    dragged: the cross in the center, or the front of the sphere."""
    into_screen = renderer.GetActiveCamera().GetDirectionOfProjection()
    depth = -radius if settings["sphere"] else 0.0
    grabbed = [c + depth * e for c, e in zip(center, into_screen)]
    x, y, z = to_screen(grabbed)
    renderer.SetDisplayPoint(x + right, y + up, z)
    renderer.DisplayToWorld()
    point = renderer.GetWorldPoint()
    return [c + p / point[3] - g for c, p, g in zip(center, point, grabbed)]


@calldata_type(VTK_STRING)
def write_message(_, __, text):
    write(message=text)


for event in ("WarningEvent", "ErrorEvent"):
    vtkOutputWindow.GetInstance().AddObserver(event, write_message)

updates = 0


def states():
    """As a script and as XML."""
    with tempfile.NamedTemporaryFile("r", suffix=".pvsm") as file:
        servermanager.ProxyManager().SaveXMLState(file.name)
        return smstate.get_state() + file.read()


def write_update(*_):
    """The trace ends with undo, since no other event comes here when all is done."""
    global updates
    updates += 1
    write(center=values("Center", 3), points=style.GetDataInformation().GetNumberOfPoints(), time=time.monotonic())
    if settings["coarse"] and updates == 2:
        write(state=states())
    if servermanager.vtkSMTrace.GetActiveTracer() and updates > 1 and numpy.allclose(values("Center", 3), center):
        write(trace=servermanager.vtkSMTrace.StopTrace())


style.SMProxy.AddObserver("UpdateDataEvent", write_update)
if settings["trace"]:
    servermanager.vtkSMTrace.StartTrace()


def write_mouse(interactor, event):
    """Movements until the button is down, with what depends on the size of the window: that may still change. The
    handle is in pixels right and down from the upper left corner."""
    if event != "MouseMoveEvent":
        interactor.RemoveObserver(movements)
        write(pressed=True)
        return
    x, y, _ = to_screen(center)
    mouse = interactor.GetEventPosition()
    write(handle=[x, view.ViewSize[1] - y], off=[mouse[0] - x, mouse[1] - y], released=moved_by(*settings["released"]))


interactor = view.GetInteractor()
FIRST = 10.0  # before the widgets, which keep events for themselves
movements = interactor.AddObserver("MouseMoveEvent", write_mouse, FIRST)
interactor.AddObserver("LeftButtonPressEvent", write_mouse, FIRST)
undo = servermanager.vtkSMProxyManager.GetProxyManager().GetUndoStackBuilder().GetUndoStack()
undo.AddObserver("StartEvent", lambda *_: write(undoes="start"))
undo.AddObserver("ModifiedEvent", lambda *_: write(undo=undo.GetUndoSetLabel(0) if undo.CanUndo() else ""))
x, y, _ = to_screen(center)
write(ready=dict(handle=[x, view.ViewSize[1] - y], center=center, radius=radius,
            points=style.GetDataInformation().GetNumberOfPoints()))
