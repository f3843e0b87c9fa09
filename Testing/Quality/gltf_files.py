# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Adds a slider to glTF files of others, and checks that nothing else changes.

usage: gltf_files.py [--preset NAME] [--output FOLDER] [--pictures] FILE...

For each file: its meshes, skins, targets and animations; the targets added, their error and jump, seconds, and what
Khronos' validator says of the file before and after, if $SPHERICALSTYLE_NODE_MODULES is the folder node_modules that
"npm install gltf-validator three" makes. Ends with 1 if JSON or buffers have changed besides the targets, or if the
validator finds an error that it has not found before. The models of
https://github.com/KhronosGroup/glTF-Sample-Models will do. --pictures shows each new file in three.js and Chromium, as
NAME-slider.glb.png with the slider at Roundness 0, 0.3, 1, 2 and 4.9, and compares the points there, with skins and all,
with the filter's result of the points at 0. Beyond twice the error and jump that the writer tells it ends with 1.
"""
import argparse
import os
import shutil
import sys
import tempfile
import time
import urllib.parse
import warnings

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Python"))
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import GLTFFiles
import SliderViewers
import sphericalstyle as ss

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Filters", "Documentation", "GLTF.md")
SHOWN = (0, 0.3, 1, 2, 4.9)


def issues(modules, files):
    """The numbers of errors and warnings that the validator finds in each file; (-1, -1) without a validator."""
    if not modules:
        return [(-1, -1)] * len(files)
    return [(report["numErrors"], report["numWarnings"]) for report in GLTFFiles.validate(modules, files)]


def copied(path, folder):
    """A folder of its own with the file and those that it refers to. @return the file there"""
    place = os.path.join(folder, os.path.splitext(os.path.basename(path))[0])
    root = GLTFFiles.load(path)[0]
    uris = [item["uri"] for item in root.get("buffers", []) + root.get("images", []) if "uri" in item]
    for name in [os.path.basename(path)] + [uri for uri in uris if not uri.startswith("data:")]:
        name = urllib.parse.unquote(name)
        to = os.path.join(place, name)
        os.makedirs(os.path.dirname(to), exist_ok=True)
        shutil.copyfile(os.path.join(os.path.dirname(path), name), to)
    return os.path.join(place, os.path.basename(path))


def show(file, picture, preset):
    """A picture of the file with the slider at several places. @return how far its points are from the filter's, at most,
    as a share of the diagonal"""
    modules = SliderViewers.find_three()
    assert modules, "pictures need Chromium, and three in $SPHERICALSTYLE_NODE_MODULES"
    seen, = SliderViewers.in_three(modules, [file], SHOWN, SliderViewers.function_of(PAGE))
    SliderViewers.sheet([shown["picture"] for shown in seen["shown"]], picture, len(SHOWN))
    rest, worst = seen["shown"][0]["points"], 0
    # In single precision, as the writer takes them, points of two meshes at one place are the same again.
    model = ss.meshes.surface_of(rest.astype(np.float32).astype(float), np.array(seen["triangles"]))
    for roundness, shown in zip(SHOWN[1:], seen["shown"][1:]):
        result = ss.round(model, preset=preset, roundness=roundness, refine_long_edges="Off")
        moved = vtk_to_numpy(result.GetPoints().GetData())
        worst = max(worst, np.linalg.norm(moved - shown["points"], axis=1).max())
    return worst / np.linalg.norm(np.ptp(rest, axis=0))


def check(path, folder, preset, modules, pictures):
    path = copied(path, folder)
    target = "-slider".join(os.path.splitext(path))
    before, old = GLTFFiles.load(path)
    start = time.perf_counter()
    slider = ss.write_slider(target, path, preset=preset)
    seconds = time.perf_counter() - start
    root, binary = GLTFFiles.load(target)
    size = before["buffers"][0]["byteLength"]
    kept = binary[:size] == old[:size]
    left = GLTFFiles.without_slider(root, binary, before)
    changed = [key for key in {**left, **before} if left.get(key) != before.get(key)]
    (errors, warnings_), (more_errors, more_warnings) = issues(modules, [path, target])
    primitives = [primitive for mesh in before["meshes"] for primitive in mesh["primitives"]]
    print(f"| {os.path.basename(path)} | {len(before['meshes'])} | {len(before.get('images', []))}"
          f" | {len(before.get('skins', []))} | {max(len(p.get('targets', [])) for p in primitives)}"
          f" | {len(before.get('animations', []))} | {slider.targets} | {slider.error:.2g} | {slider.jump:.2g}"
          f" | {seconds:.2f} | {errors}, {warnings_} | {more_errors}, {more_warnings}"
          f" | {'kept' if kept else 'CHANGED'} | {', '.join(changed) or 'kept'} |", flush=True)
    good = kept and not changed and more_errors <= errors
    if pictures:
        worst = show(target, os.path.join(folder, os.path.basename(target) + ".png"), preset)
        print(f"in three.js at most {worst:.2g} of the diagonal from the filter", flush=True)
        good = good and worst <= 2 * max(slider.error, slider.jump)
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--preset", default="Toy", help="default: %(default)s")
    parser.add_argument("--output", metavar="FOLDER", help="keep the new files there")
    parser.add_argument("--pictures", action="store_true", help="show the new files in a browser")
    parser.add_argument("files", nargs="+", metavar="FILE")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore", ss.StyleWarning)  # of thin parts
    folder = arguments.output or tempfile.mkdtemp()
    os.makedirs(folder, exist_ok=True)
    print("| file | meshes | images | skins | targets | animations | new targets | error | jump | seconds"
          " | errors, warnings before | after | buffers | JSON |")
    print("|---" * 14 + "|")
    modules = GLTFFiles.find_validator()
    good = True
    for path in arguments.files:
        try:
            good = check(path, folder, arguments.preset, modules, arguments.pictures) and good
        except ss.Error as error:
            print(f"| {os.path.basename(path)} | {error} |", flush=True)
            good = False
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
