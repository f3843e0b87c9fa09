# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round a mesh and make pictures of it. Utilities/demo.sh runs this script.

usage: pvpython demo.py MESH OUTPUT_FOLDER [--up x|y|z] [--view DEGREES]
"""
import argparse
import pathlib
import sys
import time

from sphericalstyle import Error, presets
from sphericalstyle.model_files import place_in, read, triangle_count, up_axis_of, write
from sphericalstyle.model_pictures import before_after, picture
from sphericalstyle.rounding import execute

SERIES_ROUNDNESS = [0.0, 0.3, 1.0, 2.0, 5.0]  # columns
SERIES_NORMAL_BLEND = {0.0: "one ball", 0.6: "body and limbs", 1.0: "every limb"}  # rows


def demo(arguments):
    surface = read(arguments.mesh)
    up = arguments.up or up_axis_of(arguments.mesh).lower()
    folder = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)

    start = time.perf_counter()
    style, messages = execute(surface)  # default settings
    seconds = time.perf_counter() - start
    result = style.GetOutput()
    print(f"{arguments.mesh.name}: {surface.GetNumberOfPoints()} points, "
          f"{triangle_count(surface)} triangles, rounded in {seconds:.2f} s")
    messages.print_warnings()

    files = {
        kind: place_in(folder, f"{arguments.mesh.stem}-{kind}")
        for kind in ("rounded.vtp", "rounded.ply", "before-after.png", "presets.png", "series.png")
    }
    write(files["rounded.vtp"], result)
    write(files["rounded.ply"], result)
    before_after(files["before-after.png"], surface, style, up, arguments.view)
    panels = [(surface, "model")] + [(execute(surface, preset=name)[0].GetOutput(), name) for name in presets.PRESETS]
    picture(files["presets.png"], (2000, 1100), [panels[:4], panels[4:]], up, arguments.view, 20, ground=True)
    series = [[(execute(surface, roundness=roundness, normal_blend=blend)[0].GetOutput(),
                f"Roundness {roundness:g}, {becomes} ({blend:g})") for roundness in SERIES_ROUNDNESS]
              for blend, becomes in SERIES_NORMAL_BLEND.items()]
    picture(files["series.png"], (2000, 1350), series, up, arguments.view, 18, ground=True)
    for file in files.values():
        print(f"  {file}")


def main():
    parser = argparse.ArgumentParser(description="Round a mesh and make pictures of it.")
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--up", choices="xyz", help="axis that points up (default: z for .stl, y for others)")
    parser.add_argument("--view", type=float, default=25.0,
                        help="angle of the camera around the up axis, in degrees from the front")
    try:
        demo(parser.parse_args())
    except (Error, OSError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
