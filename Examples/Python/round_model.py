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

from paraview_examples import load_plugin, parse, parser_for, save_row

parser = parser_for("Round a model with the ParaView plugin.", "rounded")
parser.add_argument("--roundness", type=float, nargs="+", default=[0.1, 0.5, 2.0])
parser.add_argument("--detail-size", type=float, default=0.0)
arguments = parse(parser)
load_plugin(arguments.plugin, "SphericalStyle", globals())

model = OpenDataFile(arguments.model)
model.UpdatePipeline()
row = [model]
for roundness in arguments.roundness:
    style = SphericalStyle(Input=model, Roundness=roundness, DetailSize=arguments.detail_size)
    style.UpdatePipeline()
    energies = servermanager.Fetch(style, idx=1)  # output port 1, one row per iteration
    last = energies.GetNumberOfRows() - 1
    if last < 0:
        sys.exit("The filter gave no result and has said why.")
    print(f"Roundness {roundness:g}: {last} iterations,"
          f" energy {energies.GetValueByName(last, 'Total').ToDouble():.4g}")
    SaveData(f"{arguments.output}-{roundness:g}.vtp", proxy=style)
    row.append(style)

# ParaView leaves room for turning the row upright: the zoom takes it away.
save_row(f"{arguments.output}.png", row, 1.1, [400 * len(row), 500], 0.55 * len(row))
