# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round a model with the ParaView plugin, several times, and show the results in a row.

    pvpython round_model.py MODEL [--roundness 0.3 1 3] [--normal-blend 0.6] [--detail-size 0.06]
                                  [--output NAME] [--plugin SphericalStyle.so]

Writes NAME-<roundness>.vtp for each roundness and the picture NAME.png. Without --plugin ParaView must find the
plugin by itself: either installed, or through the environment variable PV_PLUGIN_PATH.
"""
import sys

from paraview import servermanager
from paraview.simple import *

from paraview_examples import end, load_plugin, open_model, parse, parser_for, save_result, save_row

parser = parser_for("Round a model with the ParaView plugin.", "rounded")
parser.add_argument("--roundness", type=float, nargs="+", default=[0.3, 1.0, 3.0])
parser.add_argument("--normal-blend", type=float, default=0.6, help="0: one ball, 1: every limb by its own thickness")
parser.add_argument("--detail-size", type=float, default=0.06, help="details up to this size keep their shape")
arguments = parse(parser)
load_plugin(arguments.plugin, "SphericalStyle", globals())

model = open_model(arguments.model)
row = [model]
for roundness in arguments.roundness:
    style = SphericalStyle(Input=model, Roundness=roundness, NormalBlend=arguments.normal_blend,
                           DetailSize=arguments.detail_size)
    save_result(f"{arguments.output}-{roundness:g}.vtp", style)
    if servermanager.Fetch(style, idx=2).GetNumberOfPoints() == 0:  # output port 2, the target sphere
        sys.exit(f"{arguments.model}: there is nothing to round in it")
    print(f"Roundness {roundness:g}: points moved by up to {style.PointData['Displacement'].GetRange(-1)[1]:.4g}")
    row.append(style)

# ParaView leaves room to turn the row upright; the zoom removes it.
save_row(f"{arguments.output}.png", row, 1.1, [400 * len(row), 500], 0.55 * len(row))
end()
