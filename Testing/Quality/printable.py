#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Models at Toy made ready for a printer, and what admesh and PrusaSlicer find in them.

Each is rounded, made 60 high with walls of at least 1 and a foot of .05, and written as STL. admesh has to find nothing to repair, and
PrusaSlicer has to call it a manifold and slice it without repair. Pictures show the model before and after, and layers
of the print on their plate. Without admesh or prusa-slicer (Debian) what they say is left out.

usage: PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Testing/Quality/printable.py [--models FOLDER]
           [--output FOLDER --pictures] [MODEL ...]
"""
import pathlib
import re
import shutil
import subprocess
import tempfile
import types

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPlane, vtkPlaneCollection
from vtkmodules.vtkFiltersGeneral import vtkClipClosedSurface

import sphericalstyle
import surfaces

NAMES = ("Data/creature", "Data/snowman", "bunny", "koala", "skull", "spot", "armadillo", "demosthenes-bust", "human-parts",
         "nefertiti", "wingnut", "boot", "lucy")
HEIGHT, THICKNESS, ANGLE = 60.0, 1.0, 10.0  # mm, mm, degrees
FOOT = 0.05  # of the rectangle of the bounds
VOLUME_ERROR = 1e-6
#: Points that stay thinner: where the rounded model runs through itself already, at ears, lips and folds of cloth
#: (human-parts, lucy), and at the sharp rim that a slanting cut leaves on the plate (demosthenes-bust).
THIN = {"demosthenes-bust": 1, "human-parts": 204, "lucy": 362}
UP_AXES = {"lucy": "Z", "goblet-vase": "Z"}
#: What admesh counts before it repairs anything, and has to be 0 of.
DEFECTS = ("Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges", "Normals fixed",
           "Degenerate facets")
EXTRUDED = re.compile(r"G1 X([\d.]+) Y([\d.]+)(?: E([\d.]+))?")


def admesh_defects(path):
    """What admesh would have to repair."""
    if not shutil.which("admesh"):
        return {}
    text = subprocess.run(["admesh", path], check=True, capture_output=True, text=True).stdout
    counts = {name: sum(map(int, re.findall(rf"{name}\s*:\s*(\d+)", text))) for name in DEFECTS}
    disconnected = re.search(r"Total disconnected facets\s*:\s*(\d+)", text)
    counts["Total disconnected facets"] = int(disconnected[1])
    return {name: count for name, count in counts.items() if count}


def sliced(path, folder):
    """Whether PrusaSlicer takes the file for a manifold, its complaints, and its layers as segments of extrusion."""
    if not shutil.which("prusa-slicer"):
        return True, [], {}
    info = subprocess.run(["prusa-slicer", "--info", path], check=True, capture_output=True, text=True).stdout
    gcode = folder / "plate.gcode"
    run = subprocess.run(["prusa-slicer", "--export-gcode", "--center", "100,100", "--output", gcode, path], check=False,
                         capture_output=True, text=True)
    said = run.stdout + run.stderr
    complaints = [line for line in said.splitlines() if re.search(r"error|warning|repair|empty layer|stability", line, re.I)]
    return "manifold = yes" in info, complaints if run.returncode == 0 else [*complaints, f"ends with {run.returncode}"], layers_of(gcode)


def layers_of(gcode):
    """{height: n x 4 segments that are extruded}"""
    layers, z, place = {}, None, None
    for line in gcode.read_text(encoding="utf-8").splitlines() if gcode.exists() else []:
        if line.startswith(";Z:"):
            z = float(line[3:])
        elif move := EXTRUDED.match(line):
            to = float(move[1]), float(move[2])
            if z is not None and place and move[3] and float(move[3]) > 0:
                layers.setdefault(z, []).append((*place, *to))
            place = to
    return {z: np.array(segments) for z, segments in layers.items()}


def draw_plates(path, plates):
    """Layers of each print: the first one, and at a quarter, half and three quarters of the height."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    from matplotlib.collections import LineCollection
    figure, axes = pyplot.subplots(len(plates), 4, figsize=(12, 3 * len(plates)), squeeze=False)
    for row, (name, layers) in zip(axes, plates):
        levels = sorted(layers)
        for axis, share in zip(row, (0.0, 0.25, 0.5, 0.75)):
            z = levels[int(share * len(levels))]
            axis.add_collection(LineCollection(layers[z].reshape(-1, 2, 2), linewidths=0.5, colors="#c4722f"))
            axis.set_aspect("equal")
            axis.autoscale()
            axis.set_title(f"{name}, z = {z:.1f}", fontsize=9)
    figure.tight_layout()
    figure.savefig(path, dpi=80)


def printed(name, surface, thickness=THICKNESS):
    """The filter after it has run, with HEIGHT and walls of this thickness."""
    filter_ = sphericalstyle.vtkPrintableFilter()
    surfaces.set_properties(filter_, {"Height": HEIGHT, "MinimumThickness": thickness, "FootArea": FOOT, "StabilityAngle": ANGLE,
                                      "CloseHoles": 1, "PlaceOnPlate": 1, "OutputPointsPrecision": 1,
                                      "UpAxis": "XYZ".index(UP_AXES.get(name, "Y"))})
    filter_.SetInputData(surface)
    result = surfaces.Deformed(filter_)
    table = filter_.GetOutputDataObject(1)
    rows = {table.GetColumn(0).GetValue(k): (table.GetColumn(1).GetValue(k), table.GetColumn(2).GetValue(k))
            for k in range(table.GetNumberOfRows())}
    return filter_.GetOutput(), result, rows


def slivers(name, toy):
    """Triangles at the foot with an edge below a hundredth of the median: of the filter, and of vtkClipClosedSurface where
    it cuts at the same level."""
    axis = "XYZ".index(UP_AXES.get(name, "Y"))
    filter_ = sphericalstyle.vtkPrintableFilter()
    surfaces.set_properties(filter_, {"FootArea": FOOT, "StabilityAngle": 0, "OutputPointsPrecision": 1, "UpAxis": axis})
    filter_.SetInputData(toy)
    filter_.Update()
    level = filter_.GetOutputDataObject(1).GetValue(0, 2).ToDouble()
    plane = vtkPlane()
    plane.SetOrigin([level] * 3)
    plane.SetNormal(*np.eye(3)[axis])
    planes = vtkPlaneCollection()
    planes.AddItem(plane)
    clip = vtkClipClosedSurface()
    clip.SetInputData(toy)
    clip.SetClippingPlanes(planes)
    clip.Update()
    counts = []
    for output in (filter_.GetOutput(), clip.GetOutput()):
        P, F = surfaces.points(output), surfaces.triangles(output)
        lengths = np.linalg.norm(P[F] - P[np.roll(F, 1, axis=1)], axis=2)
        is_at_foot = (np.abs(P[F][:, :, axis] - level) < 1e-6 * np.ptp(P[:, axis])).any(axis=1)
        counts.append(int(np.sum(is_at_foot & (lengths < np.median(lengths) / 100).any(axis=1))))
    return counts


def count_thin(output):
    """Points with a thinner wall than THICKNESS."""
    return int(np.sum(vtk_to_numpy(output.GetPointData().GetArray("WallThickness")) < THICKNESS))


def main():
    chosen, paths = surfaces.chosen_models(__doc__, NAMES)
    if not hasattr(sphericalstyle, "vtkPrintableFilter"):
        surfaces.skip("built without CGAL")
    checks = surfaces.Checks()
    sheet, plates, all_slivers = [], [], []
    print("| model | tilt, degrees | lean | cut, % | thinnest before | after | points below 1 | self-intersecting |"
          " admesh | layers | s |\n|---|---|---|---|---|---|---|---|---|---|---|")
    for name, model in paths.items():
        x, F = surfaces.read(model)
        toy = sphericalstyle.round(surfaces.polydata(x, F), preset="Toy")
        output, result, rows = printed(name, toy)
        checks(not result.failed, f"{name}: {result.messages}")
        if result.failed:
            continue
        with tempfile.TemporaryDirectory() as folder_name:
            folder = pathlib.Path(folder_name)
            path = folder / "toy.stl"
            sphericalstyle.write(path, output)
            defects = admesh_defects(path)
            is_manifold, complaints, layers = sliced(path, folder)
        thin = count_thin(output)
        thin_before = count_thin(printed(name, toy, 0.0)[0])
        row = {key: value[1] for key, value in rows.items()}
        height = rows["Height"][0] * row["Factor"]
        print(f"| {name} | {row['TiltAngle']:.1f} | {row['Lean']:.1f} | {100 * row['CutDepth'] / height:.1f}"
              f" | {rows['MinimumThickness'][0] * row['Factor']:.3f} | {row['MinimumThickness']:.3f}"
              f" | {thin_before} to {thin}"
              f" | {rows['SelfIntersectingTriangles'][0]:.0f} to {row['SelfIntersectingTriangles']:.0f}"
              f" | {defects or 'clean'} | {len(layers)} | {result.seconds:.1f} |", flush=True)
        checks(row["TiltAngle"] >= ANGLE - 1e-6, f"{name}: stands")
        checks(abs(row["Height"] / HEIGHT - 1.0) < VOLUME_ERROR, f"{name}: has its height")
        checks(thin <= THIN.get(name, 0), f"{name}: walls are {row['MinimumThickness']:.3f} thick or more,"
               f" {thin} points below {THICKNESS}: {result.messages}")
        checks(row["SelfIntersectingTriangles"] <= rows["SelfIntersectingTriangles"][0], f"{name}: nothing runs through it")
        checks(not defects, f"{name}: admesh: {defects}")
        checks(is_manifold, f"{name}: PrusaSlicer takes it for a manifold")
        checks(not complaints, f"{name}: PrusaSlicer: {complaints}")
        all_slivers.append(slivers(name, toy))
        scale = height / HEIGHT
        sheet.append((name, x, F, [types.SimpleNamespace(x=surfaces.points(toy), F=surfaces.triangles(toy), failed=False),
                                   types.SimpleNamespace(x=scale * upright(result.x, name), F=result.F, failed=False)]))
        if layers:
            plates.append((name, layers))
    own, of_vtk = np.sum(all_slivers, axis=0)
    print(f"triangles at the foot of {len(all_slivers)} models with an edge below a hundredth of the median: {own},"
          f" and {of_vtk} where vtkClipClosedSurface cuts")
    checks(own <= of_vtk, "the foot has no more slivers than VTK makes")
    if chosen.pictures:
        import pictures
        pictures.sheets(chosen.output, sheet, ["Toy", f"printable, {HEIGHT:.0f} high, walls of {THICKNESS:.0f}"])
        if plates:
            draw_plates(chosen.output / "plates.png", plates)
    checks.exit()


def upright(x, name):
    """Points on the plate with the axes of the model again."""
    return x if UP_AXES.get(name) == "Z" else np.column_stack([x[:, 0], x[:, 2], -x[:, 1]])


if __name__ == "__main__":
    main()
