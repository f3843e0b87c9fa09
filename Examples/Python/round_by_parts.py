# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round the parts of a model, each around a center of its own, in two ways.

    pvpython round_by_parts.py MODEL ARRAY [--roundness 5] [--output NAME] [--plugin SphericalStyle.so]

ARRAY is a point array that has one whole number for each part, such as CenterId of Data/snowman.vtp.
At once: one solve with a center for each part. One after the other: the way of the thesis (4.6.6), part by
part in descending order (head, body, feet), with the points of all other parts held. Writes NAME-at-once.vtp,
NAME-one-by-one.vtp and the picture NAME.png: model, one center, at once, one by one. Without --plugin the environment
variable PV_PLUGIN_PATH has to name the folder with sphericalstyle.plugins.xml.
"""
import argparse
import os
import sys

from paraview.simple import *


def parse():
    parser = argparse.ArgumentParser(description="Round a model part by part.")
    parser.add_argument("model", help="any file of a surface that ParaView can open")
    parser.add_argument("array", help="point array with the number of the part")
    parser.add_argument("--roundness", type=float, default=5.0)
    parser.add_argument("--output", default="parts", help="how the names of the files begin")
    parser.add_argument("--plugin", help="SphericalStyle.so, if PV_PLUGIN_PATH is not set")
    arguments = parser.parse_args()
    if not os.path.isfile(arguments.model):
        parser.error(f"{arguments.model}: no such file")
    return arguments


def part_numbers(surface, name):
    """The whole numbers of the array, ascending."""
    array = surface.PointData.GetArray(name)
    if array is None:
        sys.exit(f"{arguments.model}: there is no point array {name}")
    values = servermanager.Fetch(surface).GetPointData().GetArray(name)
    return sorted({int(values.GetValue(i)) for i in range(values.GetNumberOfTuples())})


def one_by_one(surface, name, numbers):
    """Part after part, each with the mean of its points as the center."""
    for number in reversed(numbers):
        mask = Calculator(Input=surface, ResultArrayName="Part", Function=f"{name} == {number}")
        surface = SphericalStyle(Input=mask, RegionArray=["POINTS", "Part"], BorderWidth=0.0,
                                 Roundness=arguments.roundness)
    return surface


def show(surface, view, place, width):
    """The surface in clay at a place of the row, counted from the left."""
    display = Show(surface, view)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = [0.88, 0.62, 0.47]
    display.Position = [1.2 * place * width, 0.0, 0.0]


arguments = parse()
if arguments.plugin:
    LoadPlugin(arguments.plugin, remote=False, ns=globals())
if "SphericalStyle" not in globals():
    sys.exit("The plugin is not loaded: use --plugin or set PV_PLUGIN_PATH.")

model = OpenDataFile(arguments.model)
model.UpdatePipeline()
numbers = part_numbers(model, arguments.array)
whole = SphericalStyle(Input=model, Roundness=arguments.roundness)
at_once = SphericalStyle(Input=model, Roundness=arguments.roundness,
                         CenterIdArray=["POINTS", arguments.array])
in_turn = one_by_one(model, arguments.array, numbers)
SaveData(f"{arguments.output}-at-once.vtp", proxy=at_once)
SaveData(f"{arguments.output}-one-by-one.vtp", proxy=in_turn)
print(f"{len(numbers)} parts")

view = CreateView("RenderView")
bounds = model.GetDataInformation().GetBounds()
for place, surface in enumerate((model, whole, at_once, in_turn)):
    show(surface, view, place, bounds[1] - bounds[0])
view.UseColorPaletteForBackground = 0
view.Background = [1.0, 1.0, 1.0]
view.OrientationAxesVisibility = 0
view.ViewSize = [1100, 400]
ResetCamera(view)
GetActiveCamera().Zoom(1.6)
SaveScreenshot(f"{arguments.output}.png", view)
