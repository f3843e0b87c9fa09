# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in ParaView's window: drags handles of Handle Deform, and the lengths of a target of Spherical Style, by mouse
events, and looks at what the model does meanwhile and afterward. Prints "dragged" at the end, or an error, and ends
the window."""
import ctypes
import shutil
import subprocess

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger
from window_steps import play, settle

view = simple.GetActiveViewOrCreate("RenderView")
undo = servermanager.vtkSMProxyManager.GetProxyManager().GetUndoStackBuilder().GetUndoStack()


def values(proxy, name):
    return numpy.array(proxy.GetPropertyValue(name)[:], dtype=float)


def points(proxy):
    return vtk_to_numpy(servermanager.Fetch(proxy).GetPoints().GetData()).astype(float)


def shape(style):
    """Extents of the target."""
    return numpy.diff(numpy.reshape(style.GetDataInformation(2).GetBounds(), (3, 2))).ravel()


def to_screen(point):
    renderer = view.GetRenderer()
    renderer.SetWorldPoint(*point, 1.0)
    renderer.WorldToDisplay()
    return [round(x) for x in renderer.GetDisplayPoint()[:2]]


def until(condition):
    """Steps until something has come, which takes longer on a busy machine; the test ends where it never does."""
    while not condition():
        yield


def mouse(event, place):
    interactor = view.GetInteractor()
    interactor.SetEventInformation(place[0], place[1], 0, 0, chr(0), 0, None)
    interactor.InvokeEvent(event)


def drag(begin, end):
    """From one pixel to another: the steps of it, after each of which the window does what comes of it."""
    mouse("MouseMoveEvent", begin)
    yield
    mouse("LeftButtonPressEvent", begin)
    yield
    for share in numpy.linspace(0.1, 1.0, 10):
        mouse("MouseMoveEvent", [round(a + share * (b - a)) for a, b in zip(begin, end)])
        yield
    yield
    yield "down"
    mouse("LeftButtonReleaseEvent", end)
    yield from settle()


def handles(bar):
    """Two handles, at the ends of a bar; the one on the right is dragged up."""
    posed = simple.HandleDeform(Input=bar)
    posed.Handle = [-2, 0, 0, 0.5, -2, 0, 0, 0, 0, 0, 2, 0, 0, 0.5, 2, 0, 0, 0, 0, 0]
    display = simple.Show(posed, view)
    simple.ColorBy(display, ("POINTS", "Displacement"))
    simple.Hide(bar, view)
    simple.SetActiveSource(posed)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 12], [0, 0, 0], [0, 1, 0]
    simple.Render(view)
    yield from settle()
    before = points(posed)
    right = before[:, 0] > 1.9
    begin = to_screen([2, 0, 0])
    end = to_screen([2, 1, 0])
    for state in drag(begin, end):
        if state == "down":
            moved = points(posed) - before
            # At the first step already. Where updates take long, later ones wait: see pqUpdateWhileDragging.
            assert moved[right, 1].min() > 0.05, ("the model does not follow while the button is down", moved[right, 1])
        yield
    rows = values(posed, "Handle").reshape(2, 10)
    assert abs(rows[1, 4:7] - [2, 1, 0]).max() < 0.05, ("the handle is not where it was let go", rows)
    assert abs(rows[0, 4:7] - [-2, 0, 0]).max() == 0.0, ("the other one has moved", rows)
    top = posed.GetDataInformation().GetBounds()[3]
    assert abs(top - rows[1, 5] - 0.25) < 1e-5, ("what it holds does not go where it is put", top, rows)
    largest = posed.PointData["Displacement"].GetRange(-1)[1]
    colored = simple.GetColorTransferFunction("Displacement").RGBPoints[-4]
    assert abs(colored - largest) < 1e-5, ("the colors end elsewhere", colored, largest)
    assert undo.GetUndoSetLabel(0) == "Drag", "Fetch leaves changes of its own, but only in the drag"
    undo.Undo()
    yield
    assert abs(values(posed, "Handle").reshape(2, 10)[1, 4:7] - [2, 0, 0]).max() == 0.0, "one undo should take it back"
    yield from let_go_meanwhile(posed)
    if shutil.which("xdotool"):
        yield from put_down(posed)
    simple.Delete(posed)


def let_go_meanwhile(posed):
    """ParaView 6.1 handles events in the middle of an execution; here that is done in every version."""
    filter_ = posed.SMProxy.GetClientSideObject()
    begin, end = to_screen([2, 0, 0]), to_screen([2, 1, 0])
    handle_events = ctypes.PyDLL(None)._ZN16QCoreApplication13processEventsE6QFlagsIN10QEventLoop17ProcessEventsFlagEE
    done = []

    def let_go(*_):
        if filter_.GetProgress() <= 0.1:
            return  # it begins with what it is given
        filter_.RemoveObserver(observer)
        mouse("MouseMoveEvent", end)
        mouse("LeftButtonReleaseEvent", end)
        for _ in range(3):
            handle_events(0)
        done.append(True)

    mouse("MouseMoveEvent", begin)
    yield
    mouse("LeftButtonPressEvent", begin)
    yield
    observer = filter_.AddObserver("ProgressEvent", let_go)
    mouse("MouseMoveEvent", [round(0.5 * (a + b)) for a, b in zip(begin, end)])
    yield from until(lambda: done)
    yield from settle()
    place, top = values(posed, "Handle")[15], posed.GetDataInformation().GetBounds()[3]
    assert abs(place - 1.0) < 0.05 and abs(top - place - 0.25) < 1e-5, ("not where it was let go", place, top)


def put_down(posed):
    """P over the result puts a handle there, whose place is that of the point on the model."""
    posed.Handle = [-2, 0, 0, 0.5, -2, 1, 0, 0, 0, 0, 2, 0, 0, 0.5, 2, 1, 0, 0, 0, 0]  # moves all of it up
    simple.Render(view)
    wanted = to_screen([0.25, 1.0, 0.25])
    interactor = view.GetInteractor()
    screen = [640, 480]
    while numpy.abs(numpy.subtract(interactor.GetEventPosition(), wanted)).max() > 1:
        subprocess.run(["xdotool", "mousemove"] + [str(x) for x in screen], check=True)
        before = interactor.GetEventPosition()
        yield from until(lambda: interactor.GetEventPosition() != before)
        x, y = interactor.GetEventPosition()  # where the view is on the screen shows where the mouse comes to
        screen = [screen[0] + wanted[0] - x, screen[1] - wanted[1] + y]
    subprocess.run(["xdotool", "search", "--name", "^ParaView", "windowfocus"], check=True)  # no window manager does
    pressed = []
    observer = interactor.AddObserver("LeftButtonReleaseEvent", lambda *_: pressed.append(True))
    subprocess.run(["xdotool", "click", "1"], check=True)
    yield from until(lambda: pressed)
    interactor.RemoveObserver(observer)
    subprocess.run(["xdotool", "key", "p"], check=True)
    yield from until(lambda: len(shown_numbers(posed)) == 30)
    row = shown_numbers(posed)[20:]
    assert abs(row[:3] - [0.25, 0.0, 0.25]).max() < 0.05, ("not the point under the mouse", row)
    assert abs(row[4:7] - row[:3] - [0.0, 1.0, 0.0]).max() < 1e-6, ("not where that point is on the model", row)
    assert abs(row[3] - 0.05 * (16 + 0.5) ** 0.5) < 1e-6 and not row[7:].any(), row
    yield from put_down_of_two(posed)


def put_down_of_two(posed):
    """Of two filters that have the key P it goes to the one that is selected, however often that changes."""
    other = simple.HandleDeform(Input=posed.Input)
    for selected in (other, posed):
        simple.SetActiveSource(selected)
        yield from settle()
    subprocess.run(["xdotool", "key", "p"], check=True)
    yield from until(lambda: [len(shown_numbers(filter_)) for filter_ in (posed, other)] != [30, 0])
    assert len(shown_numbers(other)) == 0, "P puts the handle into a filter that is not selected"
    simple.Delete(other)


def shown_numbers(proxy, name="Handle"):
    """As the panel shows them."""
    helper = servermanager.vtkSMPropertyHelper(proxy.SMProxy, name)
    helper.SetUseUnchecked(True)
    return numpy.array([helper.GetAsDouble(k) for k in range(helper.GetNumberOfElements())])


def lengths(ball):
    """A ball that is drawn toward an ellipsoid, which a handle makes longer."""
    style = simple.SphericalStyle(Input=ball, NormalBlend=0.0, Target="Ellipsoid")
    simple.Show(style, view)
    simple.Hide(ball, view)
    simple.SetActiveSource(style)
    view.CameraPosition, view.CameraFocalPoint = [0, 0, 8], [0, 0, 0]
    simple.Render(view)
    yield from settle()
    before = points(style)
    extent = shape(style)
    begin = to_screen([0.5 * extent[0], 0, 0])
    end = to_screen([0.75 * extent[0], 0, 0])
    for state in drag(begin, end):
        if state == "down":
            assert numpy.ptp(points(style)[:, 0]) > 1.01 * numpy.ptp(before[:, 0]), "the model does not follow"
        yield
    given, now = values(style, "TargetLengths"), shape(style)
    assert given[0] > 1.5 * given[1] and abs(given[1] / given[2] - 1.0) < 0.01, given
    assert 1.35 * extent[0] < now[0] < 1.7 * extent[0], ("the shape ends far from the mouse", extent, now)
    assert numpy.ptp(points(style)[:, 0]) > 1.2 * numpy.ptp(points(style)[:, 1]), "the model has the shape's lengths"
    yield from pointing_at_viewer(style, now)
    yield from right_button(to_screen([0.5 * shape(style)[0], 0, 0]))
    given = values(style, "TargetLengths")
    style.Target = "Sphere"
    simple.Render(view)
    yield from settle()
    there = to_screen([0.5 * shape(style)[0], 0, 0])
    for _ in drag(there, end):
        yield
    assert (values(style, "TargetLengths") == given).all(), "a sphere has no handles"


def pointing_at_viewer(style, extent):
    """The handle along z, in the middle of the view: dragged up, it makes the target longer."""
    before = values(style, "TargetLengths")
    middle = [0, 0, 0.5 * extent[2]]
    for _ in drag(to_screen(middle), to_screen([0, 0.25 * extent[2], 0.5 * extent[2]])):
        yield
    ratio = values(style, "TargetLengths") / before
    assert abs(ratio[0] / ratio[1] - 1.0) < 0.01 and ratio[2] / ratio[0] > 1.5, ("not longer along z", ratio)


def right_button(place):
    """Leaves a handle as large as the others."""
    hidden = view.SMProxy.GetProperty("HiddenRepresentations")
    shown = [hidden.GetProxy(k).GetRepresentationProxy() for k in range(hidden.GetNumberOfProxies())
             if hidden.GetProxy(k).GetXMLName() == "HandleWidgetRepresentation" and
             servermanager.vtkSMPropertyHelper(hidden.GetProxy(k), "Visibility").GetAsInt()]
    assert len(shown) == 3, shown

    def sizes():
        bounds = [handle.GetClientSideObject().GetBounds() for handle in shown]
        return numpy.ptp(numpy.reshape(bounds, (3, 3, 2)), axis=2)

    mouse("MouseMoveEvent", place)
    yield
    mouse("RightButtonPressEvent", place)
    for k in range(1, 6):
        mouse("MouseMoveEvent", [place[0], place[1] - 20 * k])
        yield
    mouse("RightButtonReleaseEvent", [place[0], place[1] - 100])
    yield
    assert sizes().min() > 0.5 * sizes().max(), ("one has another size", sizes())
    view.CameraPosition, view.CameraFocalPoint = [0, 0, 8], [0, 0, 0]  # the right button zooms
    simple.Render(view)
    yield


def custom_after_failure(image):
    """An image is no surface: there is no center that a custom one could begin with, so it stays as it is."""
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # that it fails is wanted
    style = simple.SphericalStyle(Input=image, Center=[1.0, 2.0, 3.0], Radius=4.0)
    simple.Show(style, view)
    simple.SetActiveSource(style)
    yield from settle()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_WARNING)
    for mode, name, shown in (("CenterMode", "Center", [1.0, 2.0, 3.0]), ("RadiusMode", "Radius", [4.0])):
        helper = servermanager.vtkSMPropertyHelper(style.SMProxy, mode)
        helper.SetUseUnchecked(True)
        helper.Set(2)
        assert shown_numbers(style, name).tolist() == shown, (name, shown_numbers(style, name))


def steps():
    box = simple.Box(XLength=4.0, YLength=0.5, ZLength=0.5)
    bar = simple.Subdivide(Input=simple.Triangulate(Input=box), NumberofSubdivisions=4)
    yield from handles(bar)
    yield from lengths(simple.Sphere(ThetaResolution=48, PhiResolution=48, Radius=1.0))
    yield from custom_after_failure(simple.Wavelet())


play(steps(), view, "dragged")
