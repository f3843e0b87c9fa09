# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One ellipsoid, five triangulations: the result must not tell them apart.

Half axes 1, .8, .5. Aspect of a result: its smallest extent over its largest. Spread: largest over smallest
aspect, minus one. How the triangulations are made, and the figures: README.md.
"""
import numpy as np
from vtkmodules.vtkFiltersCore import vtkCleanPolyData
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkPlatonicSolidSource

import measures
import surfaces

try:
    from scipy.spatial import ConvexHull
except ImportError:
    surfaces.skip("scipy is not installed")

HALF_AXES = np.array([1.0, 0.8, 0.5])
CASES = {"thesis": surfaces.THESIS, "details kept": {"NormalBlend": 0.0, "DetailSize": 0.03}, "defaults": {}}
ROUNDNESS = {"thesis": (0.1, 0.5, 5.0), "details kept": (0.1, 0.5, 5.0), "defaults": (1.0,)}
CENTER_MODES = {"AreaCentroid": 1, "PointMean": 0}
BOUND = 0.002  # largest spread
# What exceeds it: {(case, CenterMode): bound}. The mean of the points of a mesh that is finer at one end lies off the
# middle, and the sphere with it. With details kept the grid looks at samples of the surface, which are others on
# other triangles, and what is detail is so too.
EXCEPTIONS = {("thesis", "PointMean"): 0.011, ("details kept", "AreaCentroid"): 0.0025,
              ("details kept", "PointMean"): 0.019, ("defaults", "AreaCentroid"): 0.003, ("defaults", "PointMean"): 0.006}


# ------------------------------------------------------------------------ triangulations of a ball
def icosphere():
    """Even: an icosahedron, four times divided."""
    solid = vtkPlatonicSolidSource()
    solid.SetSolidTypeToIcosahedron()
    welded = vtkCleanPolyData()
    welded.SetInputConnection(solid.GetOutputPort())
    divided = vtkLinearSubdivisionFilter()
    divided.SetInputConnection(welded.GetOutputPort())
    divided.SetNumberOfSubdivisions(4)
    divided.Update()
    return on_ball(surfaces.points(divided.GetOutput()), surfaces.triangles(divided.GetOutput()))


def grid(parallels, meridians, polar):
    """Rings of points at the polar angles, and two poles."""
    azimuth = 2 * np.pi * np.arange(meridians) / meridians
    ring = np.array([np.cos(azimuth), np.sin(azimuth)]).T
    x = [[0, 0, 1]]
    for angle in polar(np.arange(1, parallels + 1) / (parallels + 1)):
        x += [[np.sin(angle) * c, np.sin(angle) * s, np.cos(angle)] for c, s in ring]
    x.append([0, 0, -1])

    def at(i, j):
        return 1 + i * meridians + j % meridians

    F = []
    for j in range(meridians):
        F.append([0, at(0, j), at(0, j + 1)])
        F.append([len(x) - 1, at(parallels - 1, j + 1), at(parallels - 1, j)])
        for i in range(parallels - 1):
            F.append([at(i, j), at(i + 1, j), at(i + 1, j + 1)])
            F.append([at(i, j), at(i + 1, j + 1), at(i, j + 1)])
    return on_ball(np.array(x, dtype=float), np.array(F))


def meridians():
    """A globe of quadrilaterals, all cut the same way: fine at the poles."""
    return grid(40, 64, lambda u: np.pi * u)


def stretched():
    """Triangles six times as long as wide, along 160 meridians."""
    return grid(24, 160, lambda u: np.pi * u)


def graded():
    """Ten times finer at one end than at the other."""
    return grid(48, 64, lambda u: np.pi * (0.18 * u + 0.82 * u ** 3))


def scattered():
    """Random points with the triangles of their hull, slivers included."""
    x = np.random.RandomState(1).normal(size=(2500, 3))
    x /= np.linalg.norm(x, axis=1)[:, None]
    return on_ball(x, ConvexHull(x).simplices.astype(np.int64))


def on_ball(x, F):
    """Points on the unit ball, triangles that face outward."""
    x = x / np.linalg.norm(x, axis=1)[:, None]
    inward = np.einsum("ij,ij->i", measures.crosses(x, F), x[F[:, 0]]) < 0
    F = F.copy()
    F[inward] = F[inward][:, ::-1]
    return x, F


TRIANGULATIONS = (icosphere, meridians, scattered, stretched, graded)
COLUMNS = ["case", "CenterMode", "Roundness", *(make.__name__ for make in TRIANGULATIONS), "spread"]


# ------------------------------------------------------------------------------------------ aspects
def aspect(x):
    extent = np.sort(np.ptp(x, axis=0))
    return extent[0] / extent[2]


def spread_over_triangulations(meshes, properties):
    """(aspects, spread of them)."""
    aspects = np.array([aspect(surfaces.Result(x, F, properties).x) for x, F in meshes])
    return aspects, aspects.max() / aspects.min() - 1.0


def main():
    arguments = surfaces.parser(__doc__).parse_args()
    check = surfaces.Checks()
    meshes = []
    for make in TRIANGULATIONS:
        x, F = make()
        meshes.append((x * HALF_AXES, F))
        print(f"  {make.__name__:10s} {len(x)} points, aspect {aspect(meshes[-1][0]):.4f}")
    table = []
    for case, settings in CASES.items():
        for mode, number in CENTER_MODES.items():
            bound = EXCEPTIONS.get((case, mode), BOUND)
            for roundness in ROUNDNESS[case]:
                aspects, spread = spread_over_triangulations(meshes, {
                    **settings, "CenterMode": number, "Roundness": roundness, **dict(arguments.set)})
                what = f"{case}, {mode}, Roundness {roundness:g}"
                print(f"  {what:42s} aspects " + " ".join(f"{a:.4f}" for a in aspects)
                      + f", spread {100 * spread:.2f} %")
                check(spread < bound, f"{what}: spread {100 * spread:.2f} below {100 * bound:g} %")
                table.append(dict(zip(COLUMNS, [case, mode, roundness, *aspects, spread])))
    if arguments.output:
        surfaces.write_table(arguments.output, "triangulations.csv", COLUMNS, table)
    check.exit()


main()
