# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the models of this folder and prints a table; fails if a model is not as README.md says."""

import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties, vtkPolyDataConnectivityFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

FOLDER = os.path.dirname(os.path.abspath(__file__))

# Name, points, closed. The closed ones are manifold, of genus 0, one piece,
# without coincident points, and face outward.
MODELS = [
    ("go-stone", 386, True),
    ("icosahedron", 2611, False),
    ("tetrahedron", 514, True),
    ("cube", 602, True),
    ("cuboid", 686, True),
    ("tangram-prism", None, True),
    ("stone-house", None, True),
    ("snowman", 3162, True),
    ("bottle", 1532, True),
    ("car", None, False),
    ("creature", None, True),
]


def CountEdges(polyData, boundary):
    edges = vtkFeatureEdges()
    edges.SetInputData(polyData)
    edges.SetBoundaryEdges(boundary)
    edges.SetNonManifoldEdges(not boundary)
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


def Angles(points, triangles):
    """Angles of all triangles in degrees, one row for each triangle."""
    p = points[triangles]
    result = []
    for k in range(3):
        a, b = p[:, (k + 1) % 3] - p[:, k], p[:, (k + 2) % 3] - p[:, k]
        result.append(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), (a * b).sum(axis=1)))
    return np.degrees(np.array(result).T)


def Check(name, count, closed):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(FOLDER, name + ".vtp"))
    reader.Update()
    polyData = reader.GetOutput()
    points = vtk_to_numpy(polyData.GetPoints().GetData())
    triangles = vtk_to_numpy(polyData.GetPolys().GetConnectivityArray()).reshape(-1, 3)

    boundary, nonManifold = CountEdges(polyData, True), CountEdges(polyData, False)
    pieces = vtkPolyDataConnectivityFilter()
    pieces.SetInputData(polyData)
    pieces.SetExtractionModeToAllRegions()
    pieces.Update()
    pieces = pieces.GetNumberOfExtractedRegions()
    duplicates = len(points) - len(np.unique(points, axis=0))
    angles = Angles(points.astype(float), triangles)
    smallest = angles.min(axis=1)
    obtuse = 100.0 * (angles.max(axis=1) > 90.001).mean()

    # Each directed edge once: oriented consistently.
    directed = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    oriented = len(np.unique(directed, axis=0)) == len(directed)
    a, b, c = (points[triangles[:, k]].astype(float) for k in range(3))
    volume = (a * np.cross(b, c)).sum() / 6.0  # signed: positive when it faces outward
    euler = len(points) - len(np.unique(np.sort(directed, axis=1), axis=0)) + len(triangles)

    errors = []
    if points.dtype != np.float32:
        errors.append("points are not float32")
    if count is not None and len(points) != count:
        errors.append("%d points instead of %d" % (len(points), count))
    if len(np.unique(triangles)) != len(points):
        errors.append("unused points")
    if nonManifold or not oriented or volume <= 0.0 or smallest.min() <= 0.0:
        errors.append("non-manifold, inside out or degenerate")
    if closed:
        mass = vtkMassProperties()
        mass.SetInputData(polyData)
        if boundary or duplicates or pieces != 1 or euler != 2 or abs(mass.GetVolume() - volume) > 1e-2 * volume:
            errors.append("not closed, in pieces, or volumes %g and %g differ" % (mass.GetVolume(), volume))
    if name == "creature":
        if (smallest > 20.0).mean() < 0.999:
            errors.append("more than 0.1 % of the triangles have an angle below 20 degrees")
        if abs(points[:, 1].min()) > 1e-3:
            errors.append("does not stand on y = 0")
    if name == "icosahedron":
        uv = vtk_to_numpy(polyData.GetPointData().GetTCoords())
        spread = np.ptp(uv[triangles][:, :, 0], axis=1)
        if uv.min() < 0.0 or uv.max() > 1.0 or spread.max() > 0.5 or not (uv[:, 0] == 1.0).any():
            errors.append("texture coordinates jump inside a triangle")
    if name == "car" and not duplicates:
        errors.append("has no duplicated seam points")

    print("%-14s %5d %5d %8d %7d %10d %6d %8.4f %8.2f %7.1f  %s" % (
        name, len(points), len(triangles), boundary, nonManifold, duplicates, pieces, volume,
        smallest.min(), obtuse, "; ".join(errors) or "ok"))
    return not errors


if __name__ == "__main__":
    print("%-14s %5s %5s %8s %7s %10s %6s %8s %8s %7s" % (
        "model", "pts", "tris", "boundary", "non-mfd", "duplicates", "pieces", "volume", "minangle", "obtuse%"))
    results = [Check(*model) for model in MODELS]
    sys.exit(0 if all(results) else 1)
