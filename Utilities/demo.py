# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round a mesh and show it: the driver of Utilities/demo.sh, which see.

usage: pvpython demo.py MESH OUTPUT_FOLDER [--up x|y|z] [--view DEGREES]
"""
import argparse
import csv
import pathlib
import sys
import time

from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Examples" / "Python"))
from model_files import ModelError, place_in, read, rounded, triangle_count, write  # noqa: E402
from model_pictures import picture  # noqa: E402

ROUNDNESS, DETAIL_SIZE = 0.5, 0.03  # of the main result
SERIES_ROUNDNESS = [0.0, 0.1, 0.5, 2.0, 5.0]  # columns
SERIES_DETAIL_SIZE = [0.0, 0.03]  # rows


def write_table(path, table):
    columns = [table.GetColumn(c) for c in range(table.GetNumberOfColumns())]
    with open(path, "w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file)
        lines.writerow([column.GetName() for column in columns])
        for row in range(table.GetNumberOfRows()):
            lines.writerow([column.GetValue(row) for column in columns])


def demo(arguments):
    surface = read(arguments.mesh)
    folder = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)

    start = time.perf_counter()
    style = rounded(surface, Roundness=ROUNDNESS, DetailSize=DETAIL_SIZE)
    seconds = time.perf_counter() - start
    result = style.GetOutput()
    print(f"{arguments.mesh.name}: {surface.GetNumberOfPoints()} points, "
          f"{triangle_count(surface)} triangles, rounded in {seconds:.2f} s, "
          f"{style.GetNumberOfIterations()} iterations")

    series = []
    for detail_size in SERIES_DETAIL_SIZE:
        kept = f"details kept ({detail_size:g})" if detail_size else "details not kept"
        series.append([(rounded(surface, Roundness=roundness, DetailSize=detail_size).GetOutput(),
                        f"Roundness {roundness:g}, {kept}") for roundness in SERIES_ROUNDNESS])

    files = {
        kind: place_in(folder, f"{arguments.mesh.stem}-{kind}")
        for kind in ("rounded.vtp", "rounded.ply", "energy.csv", "before-after.png", "series.png")
    }
    write(vtkXMLPolyDataWriter(), files["rounded.vtp"], result)
    write(vtkPLYWriter(), files["rounded.ply"], result)
    write_table(files["energy.csv"], style.GetOutputDataObject(1))
    before_after = [[(surface, "before"),
                     (result, f"after: Roundness {ROUNDNESS:g}, DetailSize {DETAIL_SIZE:g}")]]
    picture(files["before-after.png"], (1600, 900), before_after, arguments.up, arguments.view, 26)
    picture(files["series.png"], (2000, 900), series, arguments.up, arguments.view, 18)
    for file in files.values():
        print(f"  {file}")


def main():
    parser = argparse.ArgumentParser(description="Round a mesh and show it.")
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--up", choices="xyz", default="y", help="axis that points up")
    parser.add_argument("--view", type=float, default=25.0,
                        help="where the camera stands, degrees around the up axis from the front")
    try:
        demo(parser.parse_args())
    except (ModelError, OSError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
