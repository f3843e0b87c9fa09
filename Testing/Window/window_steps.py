# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Steps of a test in ParaView's window, as a generator. A step begins when the window has done what came of the one
before."""
import os
import traceback

from paraview import simple


def settle():
    """Steps for what takes more than one."""
    for _ in range(4):
        yield


def play(steps, view, word):
    """Takes the steps one after another, prints the word at the end, or an error, and ends the window."""

    def step(*_):
        """Next one; the window handles its own events before the next tick."""
        if steps.gi_running:
            return  # a step that takes long, in which the window handles events, too
        try:
            next(steps)
            return
        except StopIteration:
            outcome = word
        except BaseException:  # also AssertionError
            outcome = traceback.format_exc() + "ERROR: see above"
        os.write(1, f"{outcome}\n".encode())  # print is buffered by ParaView, and _exit drops that
        os._exit(0 if outcome == word else 1)

    simple.Render(view)
    interactor = view.GetInteractor()
    interactor.AddObserver("TimerEvent", step)
    interactor.CreateRepeatingTimer(150)
