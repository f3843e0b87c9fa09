# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round the upper part of a model through its convex proxy, and show model and result.

    pvpython round_part.py MODEL [--above 0.5] [--axis x|y|z] [--blend 0.4] [--offset]
                                 [--output NAME] [--plugin SphericalStyle.so]

--above is a fraction of the model's extent along the axis; what lies below keeps its bits. --offset
keeps the details. Writes NAME.vtp and the picture NAME.png. Without --plugin the environment variable
PV_PLUGIN_PATH has to name the folder with sphericalstyle.plugins.xml.
"""
import argparse
import os
import sys

from paraview.simple import *


def parse():
    parser = argparse.ArgumentParser(description="Round the upper part of a model.")
    parser.add_argument("model", help="any file of a surface that ParaView can open")
    parser.add_argument("--above", type=float, default=0.5)
    parser.add_argument("--axis", choices="xyz", default="y")
    parser.add_argument("--blend", type=float, default=0.4, help="t: 1 is the model, 0 a ball")
    parser.add_argument("--offset", action="store_true")
    parser.add_argument("--output", default="part", help="how the names of the files begin")
    parser.add_argument("--plugin", help="SphericalStyle.so, if PV_PLUGIN_PATH is not set")
    arguments = parser.parse_args()
    if not os.path.isfile(arguments.model):
        parser.error(f"{arguments.model}: no such file")
    return arguments


def show(surface, view, place, width):
    """The surface in clay at a place of the row, counted from the left."""
    display = Show(surface, view)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = [0.88, 0.62, 0.47]
    display.Position = [1.1 * place * width, 0.0, 0.0]


arguments = parse()
if arguments.plugin:
    LoadPlugin(arguments.plugin, remote=False, ns=globals())
if "ConvexProxyDeform" not in globals():
    sys.exit("The plugin is not loaded: use --plugin or set PV_PLUGIN_PATH.")

model = OpenDataFile(arguments.model)
model.UpdatePipeline()
bounds = model.GetDataInformation().GetBounds()
axis = "xyz".index(arguments.axis)
low, high = bounds[2 * axis:2 * axis + 2]
limit = low + arguments.above * (high - low)

# The region is a point array: 1 where points may move, 0 elsewhere.
region = Calculator(Input=model, ResultArrayName="Region",
                    Function=f"coords{arguments.axis.upper()} > {limit!r}")
deform = ConvexProxyDeform(Input=region, RegionArray=["POINTS", "Region"], Blend=arguments.blend,
                           Transfer="Offset" if arguments.offset else "Blend")
SaveData(f"{arguments.output}.vtp", proxy=deform)
deform.UpdatePipelineInformation()
print(f"{deform.GetPropertyValue('EffectiveNumberOfProxyPoints')} proxy points,"
      f" {deform.GetPropertyValue('TrianglesTurnedOver')} triangles turned over")

view = CreateView("RenderView")
for place, surface in enumerate((model, deform)):
    show(surface, view, place, bounds[1] - bounds[0])
view.UseColorPaletteForBackground = 0
view.Background = [1.0, 1.0, 1.0]
view.OrientationAxesVisibility = 0
view.ViewSize = [800, 500]
ResetCamera(view)
GetActiveCamera().Zoom(1.4)
SaveScreenshot(f"{arguments.output}.png", view)
