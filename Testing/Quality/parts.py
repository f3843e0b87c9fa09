#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Parts that vtkSurfacePartsFilter finds beside parts named by hand: Rand index, also on damaged and decimated copies.

The Rand index is the share of pairs of points on which both agree: together in one part, or apart. The parts of the
creature are those that its formula is made of, and those of the snowman its three drums. Those of the real models are
cut by planes and boxes, as fractions of the bounds, where a person would cut.

usage: PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Testing/Quality/parts.py [--models FOLDER] [MODEL ...]
"""
import pathlib
import sys

try:
    import numpy as np
    from scipy.spatial import cKDTree
except ImportError:
    print("numpy and scipy are needed")
    sys.exit(77)  # what ctest takes for "skipped"
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkQuadricDecimation

import dirt
import sphericalstyle
import surfaces

DATA = pathlib.Path(__file__).resolve().parents[2] / "Data"
sys.path.insert(0, str(DATA))
LEAST = 0.85  # Rand index
DAMAGED = (dirt.holes, dirt.slit, dirt.three_detached, dirt.edge_slivers, dirt.soup)
DECIMATED = 0.7  # share of the triangles that go


def creature(x):
    import creature_field as field

    def ellipsoids(p, *shapes):
        return np.min([field.Ellipsoid(p, center, axes) for center, axes in shapes], axis=0)

    def folded(p):
        return np.stack([np.abs(p[:, 0]), p[:, 1], p[:, 2]], axis=-1)

    scale, neck = 1.12, np.array([0.0, 0.55, 0.0])  # Head() of the creature
    u = neck + (x - neck) / scale
    skull = ellipsoids(u, ((0, 0.715, 0), (0.215, 0.185, 0.18)), ((0, 0.665, 0.02), (0.245, 0.115, 0.15)),
                       ((0, 0.7, 0.224), (0.047, 0.033, 0.038)))
    muzzle = ellipsoids(folded(u), ((0.05, 0.65, 0.168), (0.068, 0.056, 0.08)))
    ear = field.Ellipsoid(field.Tilted(folded(u), (0.178, 0.885, -0.015), -32.0), (0, 0, 0), (0.083, 0.105, 0.042))
    body = ellipsoids(x, ((0, 0.325, -0.01), (0.178, 0.215, 0.15)), ((0, 0.285, 0.05), (0.175, 0.15, 0.14)),
                      ((0, 0.48, 0), (0.13, 0.085, 0.1)))
    leg = np.minimum(field.Limb(folded(x), [(0.098, 0.2, 0), (0.122, 0.065, 0.02)], [0.086, 0.072]),
                     ellipsoids(folded(x), ((0.13, 0.048, 0.072), (0.082, 0.056, 0.105))))
    rest = field.Limb(x, [(-0.14, 0.49, 0.01), (-0.245, 0.39, 0.02), (-0.262, 0.3, 0.085)], [0.062, 0.054, 0.05], 0.04)
    wave = field.Limb(x, [(0.14, 0.49, 0.01), (0.295, 0.46, 0.03), (0.38, 0.57, 0.07)], [0.062, 0.054, 0.05], 0.04)
    hand = ellipsoids(x, ((0.396, 0.605, 0.078), (0.066, 0.066, 0.05)), ((0.352, 0.667, 0.082), (0.028, 0.036, 0.03)),
                      ((0.403, 0.685, 0.082), (0.028, 0.036, 0.03)), ((0.453, 0.662, 0.082), (0.028, 0.036, 0.03)))
    tail = field.Limb(x, [(0, 0.17, -0.11), (-0.11, 0.13, -0.215), (-0.265, 0.15, -0.24), (-0.375, 0.25, -0.215),
                          (-0.42, 0.375, -0.17), (-0.405, 0.45, -0.14)], [0.05, 0.064, 0.086, 0.094, 0.07, 0.03], 0.05)
    distances = [scale * np.minimum(skull, muzzle), scale * ear, body, leg, rest, np.minimum(wave, hand), tail]
    nearest = np.argmin(distances, axis=0)
    left = (x[:, 0] < 0.0) & np.isin(nearest, (1, 3))
    return np.where(left, nearest + len(distances), nearest)


def spot(x):
    x, y, z = fractions(x)
    parts = np.where(y - 0.5 > z - 0.33, 1, 0)
    return np.where(y < 0.2, 2 + (x > 0.5) + 2 * (z > 0.63), parts)


def human(x):
    x, y, _z = fractions(x)
    parts = np.where(y > 0.86, 1, 0)
    parts = np.where((np.abs(x - 0.5) > 0.13) & (y > 0.7) & (y <= 0.86), 2 + (x > 0.5), parts)
    return np.where(y < 0.46, 4 + (x > 0.5), parts)


def armadillo(x):
    x, y, z = fractions(x)
    parts = np.where((y < 0.48) & (np.abs(x - 0.5) > 0.06) & (z > 0.24), 1 + (x > 0.5), 0)
    parts = np.where((y > 0.62) & (np.abs(x - 0.5) > 0.24), 3 + (x > 0.5), parts)
    parts = np.where((y > 0.7) & (z > 0.6) & (np.abs(x - 0.5) < 0.24), 5, parts)
    return np.where((y < 0.42) & (z < 0.24), 6, parts)


def snowman(x):
    """Three drums, one on the other."""
    return np.searchsorted([0.745, 1.775], x[:, 1])


def fractions(x):
    return ((x - x.min(axis=0)) / np.ptp(x, axis=0)).T


NAMED = {"Data/creature": creature, "Data/snowman": snowman, "spot": spot, "human-parts": human, "armadillo": armadillo}


def rand_index(a, b):
    """Hubert, Arabie, Comparing partitions, Journal of Classification 2, 1985."""
    _, a = np.unique(a, return_inverse=True)
    _, b = np.unique(b, return_inverse=True)
    table = np.zeros((a.max() + 1, b.max() + 1))
    np.add.at(table, (a, b), 1.0)

    def pairs(counts):
        return np.sum(counts * (counts - 1.0)) / 2.0
    return 1.0 + (2.0 * pairs(table) - pairs(table.sum(axis=0)) - pairs(table.sum(axis=1))) / pairs(np.array([len(a)]))


def find(surface, **properties):
    """The parts of the points, and how many there are."""
    parts = sphericalstyle.vtkSurfacePartsFilter()
    surfaces.set_properties(parts, properties)
    parts.SetInputData(surface)
    parts.Update()
    return (vtk_to_numpy(parts.GetOutput().GetPointData().GetArray("PartId")),
            parts.GetOutputDataObject(1).GetNumberOfRows())


def decimated(surface):
    """With fewer triangles, and the nearest point of the surface to each point."""
    decimation = vtkQuadricDecimation()
    decimation.SetInputData(surface)
    decimation.SetTargetReduction(DECIMATED)
    decimation.Update()
    few = decimation.GetOutput()
    return few, cKDTree(surfaces.points(surface)).query(surfaces.points(few))[1]


def main():
    chosen, paths = surfaces.chosen_models(__doc__, NAMED)
    checks = surfaces.Checks()
    rows = []
    for name, path in paths.items():
        x, F = surfaces.read(path)
        surface = surfaces.polydata(x, F)
        hand = NAMED[name](x)
        found, count = find(surface)
        rows.append((name, "as it is", len(set(hand)), count, rand_index(hand, found)))
        few, at = decimated(surface)
        found_there, count = find(few)
        used = found_there >= 0
        rows.append((name, "decimated", len(set(hand)), count, rand_index(hand[at][used], found_there[used])))
        for damage in DAMAGED:
            dirty = damage(x, F, np.random.RandomState(1))
            found_there, count = find(surfaces.polydata(dirty.x, dirty.F))
            used = found_there[dirty.at] >= 0
            rows.append((name, damage.__name__.replace("_", " "), len(set(hand)), count,
                         rand_index(hand[dirty.kept][used], found_there[dirty.at][used])))
    print("| model | copy | parts by hand | found | Rand index |\n|---|---|---|---|---|")
    for name, copy, by_hand, count, index in rows:
        print(f"| {name} | {copy} | {by_hand} | {count} | {index:.3f} |")
        checks(index > LEAST, f"{name}, {copy}: Rand index {index:.3f} is not above {LEAST}")
    checks.exit()


if __name__ == "__main__":
    main()
