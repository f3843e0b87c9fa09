# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in ParaView's window, beside a player that adds two rows to Part Sizes: three balls one above the other, which
are three parts. Prints an error where the rows are not those of the first two parts, with size 1, or where the view
does not show them, or not in three colors, when the player colors them."""
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
        if list(source.PartSize) not in ([], [0.0, 1.0, 1.0, 1.0]):
            print("\nERROR: rows", list(source.PartSize), flush=True)
        if undo.CanUndo() and undo.GetUndoSetLabel(0).startswith("Color by"):
            display = simple.GetDisplayProperties(source, view)
            shown = display.SMProxy.GetRepresentedDataInformation().GetBounds()
            expected = model.GetDataInformation().GetBounds()
            if max(abs(a - b) for a, b in zip(shown, expected)) > 1e-5:
                print("\nERROR: shown", shown, "and not", expected, flush=True)
            colors = simple.GetColorTransferFunction("PartId").IndexedColors
            if len({tuple(colors[k:k + 3]) for k in range(0, 9, 3)}) != 3:
                print("\nERROR: shown in", colors, flush=True)


undo.AddObserver("ModifiedEvent", check)
