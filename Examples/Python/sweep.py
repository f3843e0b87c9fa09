# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round a model with several values of Roundness and NormalBlend, and show all results on one sheet.

    python3 sweep.py MODEL [--roundness 0 0.3 1 2 5] [--normal-blend 0 0.6 1] [--detail-size 0.06]
                           [--output sweep.png] [--up y] [--view 25]

It also runs in pvpython. The sheet has a column for each Roundness and a row for each NormalBlend.
"""
import argparse
import pathlib
import sys

from sphericalstyle import Error
from sphericalstyle.model_files import largest_move, read
from sphericalstyle.model_pictures import picture
from sphericalstyle.rounding import execute

PANEL = (320, 300)  # pixels


def parse():
    parser = argparse.ArgumentParser(description="Round a model with several settings, on one sheet.")
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument("--roundness", type=float, nargs="+", default=[0.0, 0.3, 1.0, 2.0, 5.0])
    parser.add_argument("--normal-blend", type=float, nargs="+", default=[0.0, 0.6, 1.0])
    parser.add_argument("--detail-size", type=float, help="property of the filter; default: that of the filter")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("sweep.png"))
    parser.add_argument("--up", choices="xyz", default="y", help="axis of the model that points up")
    parser.add_argument("--view", type=float, default=25.0,
                        help="angle of the camera around that axis, in degrees from the front")
    arguments = parser.parse_args()
    if arguments.output.suffix != ".png":  # so that no other kind of file is overwritten
        parser.error("--output: the sheet is a picture, its name ends in .png")
    return arguments


def main():
    arguments = parse()
    surface = read(arguments.model)
    sheet = []
    for blend in arguments.normal_blend:
        sheet.append([])
        for roundness in arguments.roundness:
            style, messages = execute(surface, roundness=roundness, normal_blend=blend,
                                      detail_size=arguments.detail_size)
            messages.print_warnings()
            print(f"Roundness {roundness:g}, NormalBlend {blend:g}: points moved by up to "
                  f"{largest_move(style.GetOutput()):.4g}")
            sheet[-1].append((style.GetOutput(), f"Roundness {roundness:g}, NormalBlend {blend:g}"))
    size = (PANEL[0] * len(arguments.roundness), PANEL[1] * len(arguments.normal_blend))
    picture(arguments.output, size, sheet, arguments.up, arguments.view, 13)
    print(arguments.output)


if __name__ == "__main__":
    try:
        main()
    except (Error, OSError, ValueError) as error:
        sys.exit(str(error))
