# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round a model with the ParaView plugin, several times, and show the results in a row.

    pvpython round_model.py MODEL [--roundness 0.1 0.5 2] [--detail-size 0.03]
                                  [--output NAME] [--plugin SphericalStyle.so]

Writes NAME-<roundness>.vtp for each roundness and the picture NAME.png. Without --plugin ParaView has to find the
plugin by itself: installed, or by the environment variable PV_PLUGIN_PATH.
"""
import sys

from paraview import servermanager
from paraview.simple import *

from paraview_examples import end, load_plugin, open_model, parse, parser_for, save_result, save_row

parser = parser_for("Round a model with the ParaView plugin.", "rounded")
parser.add_argument("--roundness", type=float, nargs="+", default=[0.1, 0.5, 2.0])
parser.add_argument("--detail-size", type=float, default=0.0)
arguments = parse(parser)
load_plugin(arguments.plugin, "SphericalStyle", globals())

model = open_model(arguments.model)
row = [model]
for roundness in arguments.roundness:
    style = SphericalStyle(Input=model, Roundness=roundness, DetailSize=arguments.detail_size)
    save_result(f"{arguments.output}-{roundness:g}.vtp", style)
    energies = servermanager.Fetch(style, idx=1)  # output port 1, one row per iteration
    last = energies.GetNumberOfRows() - 1
    if last < 0:
        sys.exit(f"{arguments.model}: there is nothing to round in it")
    print(f"Roundness {roundness:g}: {last} iterations,"
          f" energy {energies.GetValueByName(last, 'Total').ToDouble():.4g}")
    row.append(style)

# ParaView leaves room for turning the row upright: the zoom takes it away.
save_row(f"{arguments.output}.png", row, 1.1, [400 * len(row), 500], 0.55 * len(row))
end()
