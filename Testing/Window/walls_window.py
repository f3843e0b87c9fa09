# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in ParaView's window: colors the result of Printable by the thickness of its walls, and then by another array.
Prints "colored" at the end, or an error, and ends the window. A step begins when the window has done what came of the
one before."""
import os
import traceback

from paraview import simple

view = simple.GetActiveViewOrCreate("RenderView")


def settle():
    for _ in range(4):
        yield


def steps():
    model = simple.Elevation(Input=simple.Sphere(ThetaResolution=32, PhiResolution=32), ScalarRange=[5000.0, 6000.0])
    printable = simple.Printable(Input=model)
    display = simple.Show(printable, view)
    simple.SetActiveSource(printable)
    yield from settle()
    simple.ColorBy(display, ("POINTS", "WallThickness"))
    yield from settle()
    walls = simple.GetColorTransferFunction("WallThickness")
    before = list(walls.RGBPoints)
    simple.ColorBy(display, ("POINTS", "Elevation"))
    yield from settle()
    after = list(walls.RGBPoints)
    assert after == before, ("another array changes the colors of the walls", before, after)


run = steps()


def step(*_):
    """Next one; the window handles its own events before the next tick."""
    try:
        next(run)
        return
    except StopIteration:
        outcome = "colored"
    except BaseException:  # also AssertionError
        outcome = traceback.format_exc() + "ERROR: see above"
    os.write(1, f"{outcome}\n".encode())  # print is buffered by ParaView, and _exit drops that
    os._exit(0 if outcome == "colored" else 1)


interactor = view.GetInteractor()
simple.Render(view)
observer = interactor.AddObserver("TimerEvent", step)
interactor.CreateRepeatingTimer(150)
