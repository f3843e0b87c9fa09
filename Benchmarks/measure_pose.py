# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Whether the result of a model that moves jitters, and what a step takes, without and with a rest pose.

usage: measure_pose.py [--steps N] [MODEL ...]

Each model, or the creature of Data/, is bent back and forth once in N steps (default 60), smoothly. Jitter is the root
of the mean square of the second differences of the points in time, of the result over that of the model; next to it
the largest one. Seconds are the median of the steps after the first. Run with
PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3. No test checks the times.
"""
import argparse
import pathlib
import time
import warnings

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

import sphericalstyle as ss

CREATURE = pathlib.Path(__file__).resolve().parents[1] / "Data" / "creature.vtp"
SETTINGS = {"defaults": {}, "Ball": {"preset": "Ball"}, "NormalBlend 0": {"normal_blend": 0},
            "DetailSize 0": {"detail_size": 0}}


def points_of(surface):
    return vtk_to_numpy(surface.GetPoints().GetData()).astype(float)


def pose(points, turn):
    """The points at one angle of the wave, 0 to 2 pi."""
    center, size = points.mean(axis=0), np.linalg.norm(np.ptp(points, axis=0))
    x, y, z = ((points - center) / size).T
    bend = 0.5 * np.sin(turn) * y + 0.3 * np.sin(2 * turn) * x
    moved = [np.cos(bend) * x - np.sin(bend) * y, np.sin(bend) * x + np.cos(bend) * y, z + 0.1 * np.sin(turn + 3 * x)]
    return np.stack(moved, axis=1) * size + center


def with_points(surface, points):
    moved = vtkPolyData()
    moved.ShallowCopy(surface)
    moved_points = vtkPoints()
    moved_points.SetData(numpy_to_vtk(points, deep=True))
    moved.SetPoints(moved_points)
    return moved


def second_differences(steps):
    """Lengths, of a motion that comes back to where it began."""
    return np.linalg.norm(np.roll(steps, -1, axis=0) - 2 * steps + np.roll(steps, 1, axis=0), axis=2)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=60, metavar="N", help="default: %(default)s")
    parser.add_argument("models", nargs="*", metavar="MODEL", default=[CREATURE])
    arguments = parser.parse_args()
    warnings.simplefilter("ignore", ss.StyleWarning)  # of thin parts
    print("| model | points | setting | rest pose | jitter | largest | seconds a step |")
    print("|---|--:|---|---|--:|--:|--:|")
    for path in arguments.models:
        surface = ss.read(path)
        rest = points_of(surface)
        given = np.array([pose(rest, 2 * np.pi * k / arguments.steps) for k in range(arguments.steps)])
        moves = second_differences(given)
        for setting, keywords in SETTINGS.items():
            for with_rest in (False, True):
                style = ss.rounding.make(**keywords, refine_long_edges="Off")
                if with_rest:
                    style.SetRestPoseData(surface)
                results, seconds = [], []
                for points in given:
                    style.SetInputData(with_points(surface, points))
                    start = time.perf_counter()
                    style.Update()
                    seconds.append(time.perf_counter() - start)
                    results.append(points_of(style.GetOutput()))
                jitter = second_differences(np.array(results))
                print(f"| {pathlib.Path(path).name} | {len(rest)} | {setting} | {'yes' if with_rest else 'no'}"
                      f" | {np.sqrt((jitter ** 2).mean() / (moves ** 2).mean()):.2f}"
                      f" | {jitter.max() / moves.max():.2f} | {np.median(seconds[1:]):.4f} |", flush=True)


if __name__ == "__main__":
    main()
