# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round the parts of a model, each around a center of its own, in two ways.

    pvpython round_by_parts.py MODEL ARRAY [--roundness 5] [--output NAME] [--plugin SphericalStyle.so]

ARRAY is a point array that has one whole number for each part, such as CenterId of Data/snowman.vtp.
At once: one solve with a center for each part. One after the other: the way of the thesis (4.6.6), part by
part in descending order (head, body, feet), with the points of all other parts held. Writes NAME-at-once.vtp,
NAME-one-by-one.vtp and the picture NAME.png: model, one center, at once, one by one.
Without --plugin ParaView has to find the plugin by itself: installed, or by the environment variable PV_PLUGIN_PATH.
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
    """Part after part, each with the mean of its points as the center."""
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
