# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round the upper part of a model through its convex proxy, and show model and result.

    pvpython round_part.py MODEL [--above 0.5] [--axis x|y|z] [--blend 0.4] [--offset]
                                 [--output NAME] [--plugin SphericalStyle.so]

--above is a fraction of the model's extent along the axis; everything below it stays unchanged. --offset
preserves the details. Writes NAME.vtp and the picture NAME.png. Without --plugin ParaView must find the
plugin by itself: either installed, or through the environment variable PV_PLUGIN_PATH.
"""
from paraview.simple import *

from paraview_examples import end, load_plugin, open_model, parse, parser_for, save_result, save_row

parser = parser_for("Round the upper part of a model.", "part")
parser.add_argument("--above", type=float, default=0.5)
parser.add_argument("--axis", choices="xyz", default="y")
parser.add_argument("--blend", type=float, default=0.4, help="how much of the model stays: 1 is the model, 0 a ball")
parser.add_argument("--offset", action="store_true")
arguments = parse(parser)
load_plugin(arguments.plugin, "ConvexProxyDeform", globals())

model = open_model(arguments.model)
bounds = model.GetDataInformation().GetBounds()
axis = "xyz".index(arguments.axis)
low, high = bounds[2 * axis:2 * axis + 2]
limit = low + arguments.above * (high - low)

# The region is a point array: 1 where points may move, 0 elsewhere.
region = Calculator(Input=model, ResultArrayName="Region",
                    Function=f"coords{arguments.axis.upper()} > {limit!r}")
deform = ConvexProxyDeform(Input=region, RegionArray=["POINTS", "Region"], Blend=arguments.blend,
                           Transfer="Offset" if arguments.offset else "Blend")
save_result(f"{arguments.output}.vtp", deform)
deform.UpdatePipelineInformation()
print(f"{deform.GetPropertyValue('EffectiveNumberOfProxyPoints')} proxy points,"
      f" {deform.GetPropertyValue('TrianglesTurnedOver')} triangles turned over")

save_row(f"{arguments.output}.png", (model, deform), 1.1, [800, 500], 1.4)
end()
