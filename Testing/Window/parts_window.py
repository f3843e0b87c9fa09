# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in ParaView's window, beside a player that adds three rows to Part Sizes, the last one behind the first: three
balls one above the other, which are three parts. Prints "parted" where the rows are those of the three parts, with size
1, and the view shows them in three colors, when the player colors them."""
from paraview import servermanager, simple

balls = [simple.Sphere(ThetaResolution=32, PhiResolution=32, Radius=radius, Center=[0.0, y, 0.0])
         for radius, y in ((1.0, 0.0), (0.6, 1.35), (0.3, 2.1))]
model = simple.AppendGeometry(Input=balls)
view = simple.GetActiveViewOrCreate("RenderView")
for shown in (balls[0], model):
    simple.Show(shown, view)
simple.SetActiveSource(model)
simple.Render(view)
undo = servermanager.vtkSMProxyManager.GetProxyManager().GetUndoStackBuilder().GetUndoStack()


def check(*_):
    for source in simple.GetSources().values():
        if source.GetXMLName() != "PartSizesFilter":
            continue
        if undo.CanUndo() and undo.GetUndoSetLabel(0).startswith("Color by"):
            display = simple.GetDisplayProperties(source, view)
            shown = display.SMProxy.GetRepresentedDataInformation().GetBounds()
            expected = model.GetDataInformation().GetBounds()
            colors = simple.GetColorTransferFunction("PartId").IndexedColors
            several = len({tuple(colors[k:k + 3]) for k in range(0, 9, 3)})
            if (list(source.PartSize) == [0.0, 1.0, 2.0, 1.0, 1.0, 1.0] and several == 3
                    and max(abs(a - b) for a, b in zip(shown, expected)) < 1e-5):
                print("parted", flush=True)
            else:
                print("\nERROR: shown", list(source.PartSize), several, shown, "and not", expected, flush=True)


undo.AddObserver("ModifiedEvent", check)
