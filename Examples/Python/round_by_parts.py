# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round each part of a model around its own center, in two ways.

    pvpython round_by_parts.py MODEL ARRAY [--roundness 5] [--output NAME] [--plugin SphericalStyle.so]

ARRAY is a point array that has one whole number for each part, such as CenterId of Data/snowman.vtp.
The first way rounds all parts at once, in one solve with a center for each part. The second way is that of the
thesis (4.6.6): one part after the other in descending order (head, body, feet), with the points of all other parts
held fixed. Writes NAME-at-once.vtp, NAME-one-by-one.vtp and the picture NAME.png, which shows the model, the result
with one center, and the results of both ways. Without --plugin ParaView must find the plugin by itself: either
installed, or through the environment variable PV_PLUGIN_PATH.
"""
import sys

from paraview.simple import *

from paraview_examples import end, load_plugin, open_model, parse, parser_for, save_result, save_row


def part_numbers(surface, name):
    """The whole numbers of the array, ascending."""
    array = surface.PointData.GetArray(name)
    if array is None:
        sys.exit(f"{arguments.model}: there is no point array {name}")
    values = servermanager.Fetch(surface).GetPointData().GetArray(name)
    return sorted({int(values.GetValue(i)) for i in range(values.GetNumberOfTuples())})


def one_by_one(surface, name, numbers):
    """Rounds one part after the other, each with the mean of its points as the center."""
    for number in reversed(numbers):
        mask = Calculator(Input=surface, ResultArrayName="Part", Function=f"{name} == {number}")
        surface = SphericalStyle(Input=mask, RegionArray=["POINTS", "Part"], BorderWidth=0.0, **BALL)
    return surface


parser = parser_for("Round a model part by part.", "parts")
parser.add_argument("array", help="point array with the number of the part")
parser.add_argument("--roundness", type=float, default=5.0)
arguments = parse(parser)
load_plugin(arguments.plugin, "SphericalStyle", globals())

BALL = dict(Roundness=arguments.roundness, NormalBlend=0.0)  # away from the center, not along the normals
model = open_model(arguments.model)
numbers = part_numbers(model, arguments.array)
whole = SphericalStyle(Input=model, **BALL)
at_once = SphericalStyle(Input=model, CenterIdArray=["POINTS", arguments.array], **BALL)
in_turn = one_by_one(model, arguments.array, numbers)
save_result(f"{arguments.output}-at-once.vtp", at_once)
save_result(f"{arguments.output}-one-by-one.vtp", in_turn)
print(f"{len(numbers)} parts")

save_row(f"{arguments.output}.png", (model, whole, at_once, in_turn), 1.2, [1100, 400], 1.6)
end()
