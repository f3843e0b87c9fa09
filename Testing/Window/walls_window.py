# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in ParaView's window: colors the result of Printable by the thickness of its walls, and then by another array.
The colors of the walls begin at the thickness that is wanted, unless the user has locked their range. Prints "colored"
at the end, or an error, and ends the window."""
from paraview import simple
from window_steps import play, settle

view = simple.GetActiveViewOrCreate("RenderView")


def steps():
    model = simple.Elevation(Input=simple.Sphere(ThetaResolution=32, PhiResolution=32), ScalarRange=[5000.0, 6000.0],
                             LowPoint=[0.0, 0.0, -0.5], HighPoint=[0.0, 0.0, 0.5])
    printable = simple.Printable(Input=model)
    display = simple.Show(printable, view)
    simple.SetActiveSource(printable)
    yield from settle()
    simple.ColorBy(display, ("POINTS", "WallThickness"))
    yield from settle()
    walls = simple.GetColorTransferFunction("WallThickness")
    for mode, thickness in (("Grow and update on 'Apply'", 0.1), ("Never", 0.2)):
        walls.AutomaticRescaleRangeMode = mode
        printable.MinimumThickness = thickness
        printable.UpdatePipeline()
        simple.Render(view)
        yield from settle()
        assert abs(walls.RGBPoints[0] - 0.1) < 1e-12, (mode, list(walls.RGBPoints))
    before = list(walls.RGBPoints)
    simple.ColorBy(display, ("POINTS", "Elevation"))
    yield from settle()
    after = list(walls.RGBPoints)
    assert after == before, ("another array changes the colors of the walls", before, after)


play(steps(), view, "colored")
