#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Volume meshes whose surface is rounded: quality of the cells before and after, ours beside Laplacian morphing.

Laplacian morphing moves each inner point to the mean displacement of its neighbors, as far as that goes. Scaled
Jacobians are those of vtkMeshQuality, which knows nothing of the filter.

A MESH is one of those made here or a file of VTK (.vtk, .vtu, .vts), such as those of
https://github.com/pyvista/vtk-data in Data/. A file may have cells that cannot be kept; that is no failure.

--large times the filter alone on large meshes, with the memory that it takes at its peak.

usage: PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Testing/Quality/mesh_morphing.py
         [--roundness R ...] [--large] [--output FOLDER] [MESH ...]
"""
import argparse
import pathlib
import resource
import sys
import time

try:
    import numpy as np
    import scipy.optimize
    import scipy.sparse
    import scipy.sparse.linalg
    from scipy.spatial import cKDTree
except ImportError:
    print("numpy and scipy are needed")
    sys.exit(77)  # what ctest takes for "skipped"
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_DOUBLE, vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_HEXAHEDRON, VTK_PYRAMID, VTK_TETRA, VTK_WEDGE, vtkImageData, vtkPolyData,
                                           vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkDelaunay3D
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkFiltersModeling import vtkSelectEnclosedPoints
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
from vtkmodules.vtkIOXML import vtkXMLGenericDataObjectReader, vtkXMLPolyDataReader

import sphericalstyle
import surfaces

COLUMNS = ["mesh", "cells", "`Roundness`", "before", "Laplacian, inverted", "Mesh Morphing, inverted", "steps", "seconds"]
CORNERS = {VTK_TETRA: [(0, 1, 2, 3)],
           VTK_HEXAHEDRON: [(0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7), (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2),
                            (7, 6, 4, 3)]}
DATA = pathlib.Path(__file__).resolve().parents[2] / "Data"


def updated(filter_, *inputs):
    for port, data in enumerate(inputs):
        filter_.SetInputDataObject(port, data)
    filter_.Update()
    return filter_.GetOutputDataObject(0)


def points_of(grid):
    return vtk_to_numpy(grid.GetPoints().GetData()).astype(float)


def with_points(grid, points):
    moved = grid.NewInstance()
    moved.ShallowCopy(grid)
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True, array_type=VTK_DOUBLE))
    moved.SetPoints(vtk_points)
    return moved


def image(dimensions, size):
    result = vtkImageData()
    result.SetDimensions(*dimensions)
    result.SetSpacing(*(s / (d - 1) for s, d in zip(size, dimensions)))
    return result


def cells(image_, cut):
    """The cells of an image as a grid. cut(corners, middle) are (type, ids) of each, of 8 corners in VTK's order."""
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    points.SetDataTypeToDouble()
    for i in range(image_.GetNumberOfPoints()):
        points.InsertNextPoint(image_.GetPoint(i))
    ids = vtkIdList()
    for cell in range(image_.GetNumberOfCells()):
        image_.GetCellPoints(cell, ids)
        corners = [ids.GetId(k) for k in (0, 1, 3, 2, 4, 5, 7, 6)]
        for type_, own in cut(cell, corners, points):
            grid.InsertNextCell(type_, len(own), own)
    grid.SetPoints(points)
    return grid


def hexahedra(_cell, c, _points):
    return [(VTK_HEXAHEDRON, c)]


def mixed(cell, c, points):
    """Hexahedra, pairs of wedges, and six pyramids around a point in the middle, layer by layer."""
    layer = cell % 3
    if layer == 0:
        return [(VTK_HEXAHEDRON, c)]
    if layer == 1:
        return [(VTK_WEDGE, [c[k] for k in (0, 1, 2, 4, 5, 6)]), (VTK_WEDGE, [c[k] for k in (0, 2, 3, 4, 6, 7)])]
    middle = points.InsertNextPoint(*np.mean([points.GetPoint(i) for i in c], axis=0))
    faces = (0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)
    return [(VTK_PYRAMID, [c[k] for k in face] + [middle]) for face in faces]


def bent(grid):
    """A bar, bent by a right angle."""
    x = points_of(grid)
    length = np.ptp(x[:, 0])
    angle, radius = 0.5 * np.pi * x[:, 0] / length, 1.5 * length / np.pi + x[:, 1]
    return with_points(grid, np.column_stack([radius * np.sin(angle), radius * np.cos(angle), x[:, 2]]))


def delaunay(surface, n):
    """Tetrahedra of the points of a surface and of a grid inside of it; the surface is its convex hull."""
    x = points_of(surface)
    low, high = x.min(axis=0), x.max(axis=0)
    step = (high - low).max() / n
    grid = np.stack(np.meshgrid(*(np.arange(a + 0.5 * step, b, step) for a, b in zip(low, high)), indexing="ij"), -1)
    grid = grid.reshape(-1, 3) + 0.2 * step * np.random.default_rng(1).uniform(-1, 1, (grid.size // 3, 3))
    cloud = with_points(vtkPolyData(), grid)
    inside = vtkSelectEnclosedPoints()
    inside.SetSurfaceData(surface)
    flags = vtk_to_numpy(updated(inside, cloud).GetPointData().GetArray("SelectedPoints")).astype(bool)
    mesher = vtkDelaunay3D()
    mesher.SetTolerance(1e-6)
    return updated(mesher, with_points(vtkPolyData(), np.vstack([x, grid[flags]])))


def ellipsoid():
    source = vtkSphereSource()
    source.SetThetaResolution(24)
    source.SetPhiResolution(16)
    source.Update()
    return with_points(source.GetOutput(), points_of(source.GetOutput()) * (1.0, 0.6, 1.8))


def creature():
    """Hexahedra of a grid whose middles are inside of a model: a surface of steps, with limbs."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(DATA / "creature.vtp"))
    reader.Update()
    model = reader.GetOutput()
    low, high = np.array(model.GetBounds()[::2]), np.array(model.GetBounds()[1::2])
    step = (high - low).max() / 28
    n = np.ceil((high - low) / step).astype(int) + 1
    grid = vtkImageData()
    grid.SetOrigin(*low)
    grid.SetSpacing(step, step, step)
    grid.SetDimensions(*map(int, n))
    middles = np.array([(low + step * (np.array(np.unravel_index(c, n[::-1] - 1))[::-1] + 0.5))
                        for c in range(grid.GetNumberOfCells())])
    inside = vtkSelectEnclosedPoints()
    inside.SetSurfaceData(model)
    flags = vtk_to_numpy(updated(inside, with_points(vtkPolyData(), middles)).GetPointData()
                         .GetArray("SelectedPoints")).astype(bool)
    whole = cells(grid, lambda cell, c, _points: [(VTK_HEXAHEDRON, c)] if flags[cell] else [])
    used = np.unique(vtk_to_numpy(whole.GetCells().GetConnectivityArray()))
    number = np.full(whole.GetNumberOfPoints(), -1)
    number[used] = np.arange(len(used))
    part = vtkUnstructuredGrid()
    ids = vtkIdList()
    for cell in range(whole.GetNumberOfCells()):
        whole.GetCellPoints(cell, ids)
        part.InsertNextCell(VTK_HEXAHEDRON, 8, [int(number[ids.GetId(k)]) for k in range(8)])
    return with_points(part, points_of(whole)[used])


MESHES = {
    "ellipsoid, tetrahedra": lambda: delaunay(ellipsoid(), 16),
    "bar, hexahedra": lambda: cells(image((31, 9, 9), (4.0, 1.0, 1.0)), hexahedra),
    "bar, tetrahedra": lambda: updated(vtkDataSetTriangleFilter(), image((31, 9, 9), (4.0, 1.0, 1.0))),
    "bent bar, mixed": lambda: bent(cells(image((31, 9, 9), (4.0, 1.0, 1.0)), mixed)),
    "creature, hexahedra": creature,
    "creature, tetrahedra": lambda: updated(vtkDataSetTriangleFilter(), creature()),
}

LARGE = {
    "bar, hexahedra": lambda: cells(image((61, 21, 21), (4.0, 1.3, 1.3)), hexahedra),
    "bar, tetrahedra": lambda: updated(vtkDataSetTriangleFilter(), image((81, 23, 23), (4.0, 1.1, 1.1))),
}


def rounded_surface(grid, roundness):
    style = sphericalstyle.vtkSphericalStyleFilter()
    style.SetRoundness(roundness)
    style.SetRefineLongEdgesToOff()
    return updated(style, updated(vtkDataSetSurfaceFilter(), grid))


def read(path):
    """The mesh in a file; structured grids as unstructured ones."""
    reader = (vtkGenericDataObjectReader if path.endswith(".vtk") else vtkXMLGenericDataObjectReader)()
    reader.SetFileName(path)
    reader.Update()
    return updated(vtkAppendFilter(), reader.GetOutputDataObject(0))


def qualities(grid):
    """Scaled Jacobians by VTK."""
    measure = vtkMeshQuality()
    for shape in ("Tet", "Pyramid", "Wedge", "Hex"):
        getattr(measure, f"Set{shape}QualityMeasureToScaledJacobian")()
    return vtk_to_numpy(updated(measure, grid).GetCellData().GetArray("Quality")).copy()


def quality(grid, signs):
    """(smallest, mean) scaled Jacobian and number of inverted cells. signs: -1 for what is numbered the other way round"""
    values = signs * qualities(grid)
    return values.min(), values.mean(), int((values <= 0.0).sum())


def middles(grid):
    """The mean of the points of each cell."""
    x = points_of(grid)
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    ids = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    return np.array([x[ids[a:b]].mean(axis=0) for a, b in zip(offsets, offsets[1:])])


def boundary(grid, surface):
    """Which points of the grid are on the surface, and the displacements of these."""
    x = points_of(grid)
    moves = vtk_to_numpy(surface.GetPointData().GetArray("Displacement"))
    distance, near = cKDTree(points_of(surface) - moves).query(x)
    fixed = distance < 1e-5 * np.ptp(x)
    return fixed, np.where(fixed[:, None], moves[near], 0.0)


def without_place(grid, surface):
    """Number of inner points that are nowhere on the right side of all corners, of tetrahedra and hexahedra, whose other
    points are on the surface: each leaves a half-space, and these have nothing in common. If any, no positions exist."""
    x = points_of(grid)
    fixed, u = boundary(grid, surface)
    y = x + u
    sides = {}  # of an inner point: rows a, b with a . place + b > 0
    for c, type_ in enumerate(vtk_to_numpy(grid.GetCellTypesArray())):
        ids = grid.GetCell(c).GetPointIds()
        for corner in CORNERS.get(type_, ()):
            i = np.array([ids.GetId(k) for k in corner])
            if np.count_nonzero(fixed[i]) == 3:
                free = int(np.flatnonzero(~fixed[i])[0])
                sign = np.sign(np.linalg.det(x[i[1:]] - x[i[0]]))
                values = []
                for place in np.vstack([np.zeros(3), np.eye(3)]):  # the determinant is linear in one point
                    corners = y[i]
                    corners[free] = place
                    values.append(sign * np.linalg.det(corners[1:] - corners[0]))
                sides.setdefault(i[free], []).append([*(np.array(values[1:]) - values[0]), values[0]])
    count = 0
    for rows in sides.values():
        rows = np.array(rows)
        rows /= np.linalg.norm(rows[:, :3], axis=1)[:, None]
        # The place that is farthest inside of all; t is how far.
        found = scipy.optimize.linprog([0, 0, 0, -1], np.column_stack([-rows[:, :3], np.ones(len(rows))]), rows[:, 3],
                                       bounds=[(None, None)] * 3 + [(None, np.ptp(x))])
        count += found.status == 0 and found.x[3] < -1e-9 * np.ptp(x)
    return count


def laplacian(grid, surface):
    """Each inner point takes the mean displacement of the points that it shares an edge with."""
    x = points_of(grid)
    edges = set()
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        for k in range(cell.GetNumberOfEdges()):
            ids = cell.GetEdge(k).GetPointIds()
            edges.add(tuple(sorted((ids.GetId(0), ids.GetId(1)))))
    i, j = np.array(sorted(edges)).T
    ones = np.ones(len(i))
    adjacency = scipy.sparse.coo_matrix((ones, (i, j)), shape=(len(x), len(x)))
    adjacency = (adjacency + adjacency.T).tocsr()
    matrix = scipy.sparse.diags(np.asarray(adjacency.sum(axis=1)).ravel()) - adjacency
    fixed, u = boundary(grid, surface)
    fixed |= matrix.diagonal() == 0  # in no cell
    start = time.perf_counter()
    solve = scipy.sparse.linalg.factorized(matrix[~fixed][:, ~fixed].tocsc())
    right = -matrix[~fixed][:, fixed] @ u[fixed]
    u[~fixed] = np.column_stack([solve(right[:, k]) for k in range(3)])
    return with_points(grid, x + u), time.perf_counter() - start


def ours(grid, surface):
    """(result or None, what it said, seconds, the filter)"""
    morphing, said = sphericalstyle.vtkMeshMorphingFilter(), []

    def note(_caller, _event, text):
        said.append(text.strip().split("): ", 1)[-1])

    note.CallDataType = "string0"
    for event in ("ErrorEvent", "WarningEvent"):
        morphing.AddObserver(event, note)
    morphing.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    start = time.perf_counter()
    result = updated(morphing, grid, surface)
    return (result if result.GetNumberOfPoints() else None), said, time.perf_counter() - start, morphing


def row(name, grid, roundness):
    """Measures a mesh and prints a line of the table. @return whether the filter keeps what it promises, and the line"""
    surface = rounded_surface(grid, roundness)
    result, said, seconds, morphing = ours(grid, surface)
    # Where the filter finds no inverted cell before, what VTK takes as one is numbered the other way round. Of such
    # hexahedra and wedges VTK then has the best corner.
    signs = np.where((qualities(grid) < 0) & (morphing.GetSmallestScaledJacobianBefore() > 0), -1, 1)
    before = quality(grid, signs)
    theirs, their_seconds = laplacian(grid, surface)
    laplace = quality(theirs, signs)
    differ = np.isin(vtk_to_numpy(grid.GetCellTypesArray()), (VTK_PYRAMID, VTK_WEDGE)).any() or (signs < 0).any()
    steps = ""
    if result:
        own = quality(result, signs)
        outcome = f"{own[0]:.3f} ({own[1]:.3f}), {own[2]}"
        steps = f"{morphing.GetNumberOfIterations()}"
        good = own[2] <= before[2]
        if not differ:  # VTK compares pyramids and wedges with others than we do
            good = good and abs(own[0] - morphing.GetSmallestScaledJacobianAfter()) < 1e-5
    else:
        by_surface = "no motion of inner points" in said[0]
        count = said[0].split(' is ')[0].split(' are ')[0].split('surface ')[-1]
        if by_surface:
            outcome = f"error: the surface inverts {count}"
        else:
            outcome = f"error: {count} inverted, {without_place(grid, surface)} inner points have no place"
        good = by_surface or name not in MESHES
    cells = [pathlib.Path(name).name, f"{grid.GetNumberOfCells()}", f"{roundness:g}", f"{before[0]:.3f} ({before[1]:.3f})",
             f"{laplace[0]:.3f} ({laplace[1]:.3f}), {laplace[2]}", outcome, steps, f"{their_seconds:.2f}, {seconds:.2f}"]
    print(f"| {' | '.join(cells)} |", flush=True)
    if not good:
        print("ERROR: should hold: no cell is inverted that was not before, unless the surface inverts it:", *said)
    return good, dict(zip(COLUMNS, cells))


def time_large():
    """The filter on large meshes. @return whether no cell is inverted"""
    print("| mesh | cells | smallest scaled Jacobian | steps | seconds | of the processor | MB |")
    print("|---|---|---|---|---|---|---|")
    good = True
    for name, make in LARGE.items():
        grid = make()
        surface = rounded_surface(grid, 0.5)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        start = time.process_time()
        result, _said, seconds, morphing = ours(grid, surface)
        of_processor = time.process_time() - start
        memory = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024.0
        print(f"| {pathlib.Path(name).name} | {grid.GetNumberOfCells()} | {morphing.GetSmallestScaledJacobianAfter():.3f} | "
              f"{morphing.GetNumberOfIterations()} | {seconds:.2f} | {of_processor:.2f} | {memory:.0f} |", flush=True)
        good = good and result is not None
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("meshes", nargs="*", metavar="MESH", help=f"of {', '.join(MESHES)}, or a file")
    parser.add_argument("--roundness", type=float, nargs="+", default=[1.0, 5.0])
    parser.add_argument("--large", action="store_true", help="time the filter on large meshes instead")
    parser.add_argument("--output", type=pathlib.Path, metavar="FOLDER", help="for the table")
    chosen = parser.parse_args()
    if chosen.large:
        return 0 if time_large() else 1
    print(f"| {' | '.join(COLUMNS)} |\n{'|---' * len(COLUMNS)}|")
    table = []
    good = True
    for name in chosen.meshes or MESHES:
        grid = MESHES[name]() if name in MESHES else read(name)
        for roundness in chosen.roundness:
            holds, line = row(name, grid, roundness)
            good = good and holds
            table.append(line)
    if chosen.output:
        surfaces.write_table(chosen.output, "mesh-morphing.csv", COLUMNS, table)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
