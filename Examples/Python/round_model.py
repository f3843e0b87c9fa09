# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round a model with the ParaView plugin, several times, and show the results in a row.

    pvpython round_model.py MODEL [--roundness 0.1 0.5 2] [--detail-size 0.03]
                                  [--output NAME] [--plugin SphericalStyle.so]

Writes NAME-<roundness>.vtp for each roundness and the picture NAME.png. Without --plugin the
environment variable PV_PLUGIN_PATH has to name the folder with sphericalstyle.plugins.xml.
"""
import argparse
import os
import sys

from paraview import servermanager
from paraview.simple import *


def parse():
    parser = argparse.ArgumentParser(description="Round a model with the ParaView plugin.")
    parser.add_argument("model", help="any file of a surface that ParaView can open")
    parser.add_argument("--roundness", type=float, nargs="+", default=[0.1, 0.5, 2.0])
    parser.add_argument("--detail-size", type=float, default=0.0)
    parser.add_argument("--output", default="rounded", help="how the names of the files begin")
    parser.add_argument("--plugin", help="SphericalStyle.so, if PV_PLUGIN_PATH is not set")
    arguments = parser.parse_args()
    if not os.path.isfile(arguments.model):
        parser.error(f"{arguments.model}: no such file")
    return arguments


def show(surface, view, place):
    """The surface in clay at a place of the row, counted from the left."""
    bounds = model.GetDataInformation().GetBounds()
    display = Show(surface, view)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = [0.88, 0.62, 0.47]
    display.Position = [1.1 * place * (bounds[1] - bounds[0]), 0.0, 0.0]


arguments = parse()
if arguments.plugin:
    LoadPlugin(arguments.plugin, remote=False, ns=globals())
if "SphericalStyle" not in globals():
    sys.exit("The plugin is not loaded: use --plugin or set PV_PLUGIN_PATH.")

model = OpenDataFile(arguments.model)
view = CreateView("RenderView")
show(model, view, 0)
for place, roundness in enumerate(arguments.roundness, start=1):
    style = SphericalStyle(Input=model, Roundness=roundness, DetailSize=arguments.detail_size)
    style.UpdatePipeline()
    energies = servermanager.Fetch(style, idx=1)  # output port 1, one row per iteration
    last = energies.GetNumberOfRows() - 1
    if last < 0:
        sys.exit("The filter gave no result and has said why.")
    print(f"Roundness {roundness:g}: {last} iterations,"
          f" energy {energies.GetValueByName(last, 'Total').ToDouble():.4g}")
    SaveData(f"{arguments.output}-{roundness:g}.vtp", proxy=style)
    show(style, view, place)

view.UseColorPaletteForBackground = 0
view.Background = [1.0, 1.0, 1.0]
view.OrientationAxesVisibility = 0
columns = 1 + len(arguments.roundness)
view.ViewSize = [400 * columns, 500]
ResetCamera(view)
GetActiveCamera().Zoom(0.55 * columns)  # ParaView leaves room for turning the row upright
SaveScreenshot(f"{arguments.output}.png", view)
