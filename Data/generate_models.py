# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the example models of this folder; see README.md for what each one shows.

  generate_models.py                      all models but the creature
  generate_models.py --contour out.off    dense contour of the creature, to be remeshed
  generate_models.py --creature in.off    creature.vtp from the remeshed contour

generate_models.sh runs the three steps. All of it is deterministic: random
numbers come from RandomState, whose stream numpy keeps frozen.
"""

import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkDelaunay2D, vtkFlyingEdges3D
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

FOLDER = os.path.dirname(os.path.abspath(__file__))


# ---------------------------------------------------------------------------
# Helpers

def MakePolyData(points, triangles):
    triangles = np.asarray(triangles, dtype=np.int64)
    vtkPts = vtkPoints()
    vtkPts.SetData(numpy_to_vtk(np.asarray(points, dtype=np.float32), deep=True))
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtk(np.arange(0, triangles.size + 1, 3, dtype=np.int64), deep=True),
                  numpy_to_vtk(triangles.ravel(), deep=True))
    polyData = vtkPolyData()
    polyData.SetPoints(vtkPts)
    polyData.SetPolys(cells)
    return polyData


def AddArray(attributes, name, values):
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    attributes.AddArray(array)


def WriteModel(name, polyData):
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(os.path.join(FOLDER, name))
    writer.SetInputData(polyData)
    # Inline base64: raw appended data is no XML, and readers with a strict expat refuse it.
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToZLib()
    writer.SetCompressionLevel(9)
    writer.SetIdTypeToInt32()
    writer.Write()
    print("%-20s %5d points %5d triangles %7d bytes" % (
        name, polyData.GetNumberOfPoints(), polyData.GetNumberOfCells(),
        os.path.getsize(writer.GetFileName())))


def Weld(points, triangles, tolerance=1e-6):
    """Merges coincident points and drops the triangles that collapse."""
    keys = np.round(np.asarray(points) / tolerance).astype(np.int64)
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    # np.unique sorts; keep the order of first appearance instead.
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    t = rank[inverse.ravel()][np.asarray(triangles)]
    t = t[(t[:, 0] != t[:, 1]) & (t[:, 1] != t[:, 2]) & (t[:, 2] != t[:, 0])]
    return np.asarray(points)[first[order]], t


def SubdivideLinear(points, triangles, levels):
    """Splits each triangle into four, levels times, without moving the surface."""
    points = [np.asarray(p, dtype=float) for p in points]
    for _ in range(levels):
        middle = {}

        def Middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(points)
                points.append(0.5 * (points[a] + points[b]))
            return middle[key]

        finer = []
        for a, b, c in triangles:
            ab, bc, ca = Middle(a, b), Middle(b, c), Middle(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = finer
    return np.array(points), np.array(triangles)


def GridTriangles(rows, columns, flip=None):
    """Triangles of a grid of points, row after row; flip(i, j) picks the other diagonal."""
    triangles = []
    for i in range(rows - 1):
        for j in range(columns - 1):
            a, b = i * columns + j, i * columns + j + 1
            c, d = b + columns, a + columns
            if flip and flip(i, j):
                triangles += [(a, b, d), (b, c, d)]
            else:
                triangles += [(a, b, c), (a, c, d)]
    return triangles


def Revolve(radii, heights, around):
    """Closed surface around the Y axis; the first and last height are the poles."""
    angle = 2.0 * np.pi * np.arange(around) / around
    points = [(0.0, heights[0], 0.0)]
    for r, y in zip(radii[1:-1], heights[1:-1]):
        points += [(r * np.sin(a), y, r * np.cos(a)) for a in angle]
    points.append((0.0, heights[-1], 0.0))
    rings = len(radii) - 2
    last = len(points) - 1
    triangles = []
    for j in range(around):
        k = (j + 1) % around
        triangles.append((0, 1 + k, 1 + j))
        for i in range(rings - 1):
            a, b = 1 + i * around + j, 1 + i * around + k
            c, d = b + around, a + around
            triangles += [(a, b, c), (a, c, d)]
        base = 1 + (rings - 1) * around
        triangles.append((last, base + j, base + k))
    return np.array(points), np.array(triangles)


# ---------------------------------------------------------------------------
# Simple solids

def MakeGoStone():
    """UV ellipsoid of 24 x 16 points and two poles, flat along Z."""
    theta = np.pi * np.arange(18) / 17.0
    points, triangles = Revolve(np.sin(theta), -np.cos(theta), 24)
    # Lay the axis of revolution into Z (x, y, z) -> (z, x, y): a rotation, it
    # keeps the orientation.
    points = points[:, [2, 0, 1]] * (1.0, 1.0, 0.45)
    return MakePolyData(points, triangles)


def MakeIcosahedron():
    """Flat-faced icosahedron with a texture seam and arrays to pass through."""
    golden = 0.5 * (1.0 + np.sqrt(5.0))
    corners = []
    for s in (-1, 1):
        for t in (-golden, golden):
            corners += [(0, s, t), (s, t, 0), (t, 0, s)]
    corners = np.array(corners, dtype=float)
    triangles = []
    for a in range(12):
        for b in range(12):
            for c in range(12):
                p, q, r = corners[a], corners[b], corners[c]
                near = max(np.linalg.norm(p - q), np.linalg.norm(q - r), np.linalg.norm(r - p)) < 2.1
                if a < b and a < c and b != c and near and np.dot(np.cross(q - p, r - p), p) > 0:
                    triangles.append((a, b, c))
    points, triangles = SubdivideLinear(corners, triangles, 4)

    # The seam has to follow mesh edges. The plane through the origin normal to
    # a corner cuts the faces along lines between edge midpoints, and these are
    # mesh edges after one subdivision. It holds the Z axis when the corner is
    # (1, golden, 0), and Z meets the surface in an edge midpoint: our poles.
    pole = np.array([0.0, 0.0, 1.0])
    seam = np.array([golden, -1.0, 0.0]) / np.hypot(golden, 1.0)
    # New axes: Y is the pole, Z the seam, X completes a right-handed frame.
    points = points @ np.stack([np.cross(pole, seam), pole, seam], axis=1)
    points /= np.linalg.norm(points, axis=1).max()

    x, y, z = points.T
    onPole = np.hypot(x, z) < 1e-6
    onSeam = (np.abs(x) < 1e-6) & (z > 0) & ~onPole
    u = np.arctan2(x, z) / (2.0 * np.pi) % 1.0
    u[onSeam] = 0.0
    v = 0.5 + np.arcsin(y / np.linalg.norm(points, axis=1)) / np.pi

    # Copy the seam points for the triangles that end at u = 1, and give each
    # triangle at a pole a pole point of its own, halfway between its other two.
    points, u, v = list(points), list(u), list(v)
    triangles = triangles.copy()
    copies, usedPoles = {}, set()

    def Copy(index, newU):
        points.append(points[index])
        u.append(newU)
        v.append(v[index])
        return len(points) - 1

    for triangle in triangles:
        free = [i for i in triangle if not onPole[i] and not onSeam[i]]
        atEnd = np.mean([u[i] for i in free]) > 0.5
        for k in range(3):
            if onSeam[triangle[k]] and atEnd:
                original = int(triangle[k])
                if original not in copies:
                    copies[original] = Copy(original, 1.0)
                triangle[k] = copies[original]
        for k in range(3):
            if triangle[k] < len(onPole) and onPole[triangle[k]]:
                original = int(triangle[k])
                newU = 0.5 * (u[triangle[k - 1]] + u[triangle[k - 2]])
                if original in usedPoles:
                    triangle[k] = Copy(original, newU)
                else:
                    usedPoles.add(original)
                    u[original] = newU

    points = np.array(points)
    polyData = MakePolyData(points, triangles)
    AddArray(polyData.GetPointData(), "Elevation", points[:, 1].astype(np.float32))
    AddArray(polyData.GetCellData(), "CellIds", np.arange(len(triangles), dtype=np.int32))
    tcoords = numpy_to_vtk(np.column_stack([u, v]).astype(np.float32), deep=True)
    tcoords.SetName("TCoords")
    polyData.GetPointData().SetTCoords(tcoords)
    return polyData


def MakeTetrahedron():
    corners = np.array([(1, 1, 1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1)]) / np.sqrt(3.0)
    return MakePolyData(*SubdivideLinear(corners, [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)], 4))


def MakeBox(size, divisions, alternate):
    """Box centered at the origin; alternating diagonals keep all its mirror planes."""
    points, triangles = [], []
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3
        for sign in (-1, 1):
            first = len(points)
            for i in range(divisions[b] + 1):
                for j in range(divisions[c] + 1):
                    p = np.zeros(3)
                    p[axis] = 0.5 * sign * size[axis]
                    p[b] = (i / divisions[b] - 0.5) * size[b]
                    p[c] = (j / divisions[c] - 0.5) * size[c]
                    points.append(p)
            flip = (lambda i, j: (i + j) % 2 == 1) if alternate else None
            for t in GridTriangles(divisions[b] + 1, divisions[c] + 1, flip):
                # Rows run along b, columns along c: t turns against b x c = +axis.
                t = t if sign < 0 else t[::-1]
                triangles.append(tuple(first + k for k in t))
    return MakePolyData(*Weld(points, triangles))


def MakeTangramPrism():
    """Thin right-triangle prism; its two large faces are meshed badly on purpose.

    On regular and on Delaunay meshes the strong deformation did not fold in
    our trials. So the points are pushed around after the triangulation, which
    leaves slivers and edges that no Delaunay triangulation would have. The seed
    was picked for folds that come with a large roundness only.
    """
    random = np.random.RandomState(4222)
    n, height, inside, slimmest = 8, 0.11, 150, 1.0
    corners = np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 0.5)])
    # Uneven points on the outline; its corners stay.
    counts = [n, int(round(n * np.sqrt(2.0))), n]
    outline = []
    for k in range(3):
        t = np.arange(counts[k]) + np.append(0.0, random.uniform(-0.4, 0.4, counts[k] - 1))
        outline.append(corners[k] + (t / counts[k])[:, None] * (corners[(k + 1) % 3] - corners[k]))
    outline = np.concatenate(outline)

    def Sines(p):
        """Sine of the smallest angle of counterclockwise triangles, negative for flipped ones."""
        sides = [p[:, (k + 1) % 3] - p[:, k] for k in range(3)]
        lengths = [np.linalg.norm(e, axis=1) for e in sides]
        doubleArea = sides[0][:, 0] * sides[1][:, 1] - sides[0][:, 1] * sides[1][:, 0]
        return np.min([doubleArea / (lengths[k] * lengths[k - 1]) for k in range(3)], axis=0)

    def Face():
        # Random points, denser toward the right angle.
        flat = list(outline)
        while len(flat) < len(outline) + inside:
            p = random.rand(2) ** 1.3
            toOutline = min(p[0], p[1], (1.0 - p[0] - p[1]) / np.sqrt(2.0))
            p *= (1.0, 0.5)
            if toOutline > 0.01 and all(np.hypot(*(p - q)) > 0.006 for q in flat[len(outline):]):
                flat.append(p)
        flat = np.array(flat)
        delaunay = vtkDelaunay2D()
        delaunay.SetInputData(MakePolyData(np.column_stack([flat, np.zeros(len(flat))]), [(0, 1, 2)]))
        delaunay.SetOffset(20.0)  # the default leaves bays in the hull
        delaunay.Update()
        triangles = vtk_to_numpy(delaunay.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
        triangles = np.where((Sines(flat[triangles]) < 0)[:, None], triangles[:, ::-1], triangles)
        # The outline is straight: drop what Delaunay puts flat along it.
        triangles = triangles[Sines(flat[triangles]) > 1e-4]
        # Push the inner points, as long as no triangle gets too slim.
        for _ in range(30):
            for i in range(len(outline), len(flat)):
                old = flat[i].copy()
                flat[i] += random.uniform(-0.05, 0.05, 2)
                around = triangles[(triangles == i).any(axis=1)]
                if Sines(flat[around]).min() < np.sin(np.radians(slimmest)):
                    flat[i] = old
        return flat, triangles

    points, triangles = [], []
    for sign in (-1, 1):
        flat, faces = Face()
        faces = faces if sign > 0 else faces[:, ::-1]
        triangles += [tuple(t) for t in faces + len(points)]
        points += [(x, y, 0.5 * sign * height) for x, y in flat]
    for k in range(len(outline)):
        p, q = outline[k], outline[(k + 1) % len(outline)]
        first = len(points)
        points += [(*p, -0.5 * height), (*q, -0.5 * height), (*q, 0.5 * height), (*p, 0.5 * height)]
        triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    points, triangles = Weld(points, triangles)
    return MakePolyData(points - 0.5 * (points.min(axis=0) + points.max(axis=0)), triangles)


def MakeBottle():
    """Wine bottle: punt, belly, shoulder, neck and lip, sampled evenly along its outline."""
    # (radius, height) corners, and how much each of them is rounded.
    outline = [((0.00, 0.075), 0.00), ((0.11, 0.055), 0.05), ((0.19, 0.00), 0.02), ((0.27, 0.00), 0.06),
               ((0.28, 0.86), 0.22), ((0.095, 1.12), 0.16), ((0.085, 1.50), 0.01), ((0.112, 1.51), 0.012),
               ((0.112, 1.59), 0.02), ((0.00, 1.60), 0.00)]
    corner = np.array([c for c, _ in outline])
    dense = [corner[0]]
    for k in range(1, len(corner) - 1):
        rounding = outline[k][1]
        back, ahead = corner[k - 1] - corner[k], corner[k + 1] - corner[k]
        start = corner[k] + back * min(0.5, rounding / np.linalg.norm(back))
        end = corner[k] + ahead * min(0.5, rounding / np.linalg.norm(ahead))
        for t in np.linspace(0.0, 1.0, 40):
            dense.append((1 - t)**2 * start + 2 * t * (1 - t) * corner[k] + t**2 * end)
    dense.append(corner[-1])
    dense = np.array(dense)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(dense, axis=0), axis=1))])
    samples = np.linspace(0.0, length[-1], 53)
    radii, heights = np.interp(samples, length, dense[:, 0]), np.interp(samples, length, dense[:, 1])
    return MakePolyData(*Revolve(radii, heights, 30))


def MakeSnowman():
    """Three round-edged drums on top of each other, one surface; CenterId counts them from below."""
    drums = [(1.0, 0.0), (0.72, 1.22), (0.5, 2.1)]  # radius, height of the middle
    exponent, squash = 3.0, 0.8                     # 2 and 1 would be balls
    y = np.linspace(-squash, 2.1 + 0.5 * squash, 200001)
    outlines = np.array([r * np.maximum(0.0, 1.0 - np.abs((y - middle) / (squash * r))**exponent)**(1.0 / exponent)
                         for r, middle in drums])
    dense = np.stack([outlines.max(axis=0), y], axis=1)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(dense, axis=0), axis=1))])
    samples = np.linspace(0.0, length[-1], 81)
    radii, heights = np.interp(samples, length, dense[:, 0]), np.interp(samples, length, dense[:, 1])
    polyData = MakePolyData(*Revolve(radii, heights, 40))
    ids = np.interp(heights, y, outlines.argmax(axis=0)).round().astype(np.int32)
    AddArray(polyData.GetPointData(), "CenterId", np.concatenate([ids[:1], np.repeat(ids[1:-1], 40), ids[-1:]]))
    return polyData


# ---------------------------------------------------------------------------
# House

class QuadMesh:
    """Quads with the one operation the house needs: pull a patch out of the surface."""

    def __init__(self):
        self.Points = []
        self.Quads = []

    def Extrude(self, patch, offset, inset=0.0):
        """Moves the quads of the patch by offset, shrinks them, and closes the gap around."""
        used = sorted({i for q in patch for i in self.Quads[q]})
        center = np.mean([self.Points[i] for i in used], axis=0)
        new = {}
        for i in used:
            new[i] = len(self.Points)
            self.Points.append(self.Points[i] + inset * (center - self.Points[i]) + offset)
        edges = {(q[k], q[(k + 1) % 4]) for q in (self.Quads[p] for p in patch) for k in range(4)}
        for a, b in sorted(edges):
            if (b, a) not in edges:
                self.Quads.append((a, b, new[b], new[a]))
        for p in patch:
            self.Quads[p] = tuple(new[i] for i in self.Quads[p])
        return list(new.values())


def MakeStoneHouse():
    """Walls with protruding stones, door, windows, overhanging pitched roof and chimney.

    The house is a block of hexahedral cells bent into shape; its hull is closed
    and manifold by construction, and pulling patches out keeps it so. Shifted
    corners and arbitrary diagonals give it many obtuse triangles.
    """
    random = np.random.RandomState(34)
    # Grid lines. The first and the last cell in x and z are only there in the
    # roof layer (the topmost one), as its overhang.
    xs = np.array([-0.62, -0.48, -0.32, -0.16, 0.0, 0.16, 0.32, 0.48, 0.62])
    zs = np.array([-0.78, -0.66, -0.44, -0.22, 0.0, 0.22, 0.44, 0.66, 0.78])
    rows = np.array([0.0, 0.16, 0.33, 0.48, 0.64, 0.83, 1.0])
    wall, ridge, roof = 0.56, 1.02, 0.09
    nx, nz, ny = len(xs) - 1, len(zs) - 1, len(rows)  # ny cells: walls and the roof on top

    def Position(i, j, k):
        x, z = xs[i], zs[k]
        under = wall + (ridge - wall) * (1.0 - abs(x) / 0.48)
        if j == ny:
            return np.array([x, under + roof, z])
        t = rows[j]
        # Lower rows stay level, the upper ones follow the gable.
        return np.array([x, wall * t + (under - wall) * t**3, z])

    def Solid(i, j, k):
        if not (0 <= i < nx and 0 <= j < ny and 0 <= k < nz):
            return False
        return j == ny - 1 or (0 < i < nx - 1 and 0 < k < nz - 1)

    mesh = QuadMesh()
    number, tags = {}, []

    def Corner(*ijk):
        if ijk not in number:
            number[ijk] = len(mesh.Points)
            mesh.Points.append(Position(*ijk))
        return number[ijk]

    for i in range(nx):
        for j in range(ny):
            for k in range(nz):
                for axis in range(3):
                    for side in (0, 1):
                        step = [0, 0, 0]
                        step[axis] = 2 * side - 1
                        if not Solid(i, j, k) or Solid(i + step[0], j + step[1], k + step[2]):
                            continue
                        b, c = (axis + 1) % 3, (axis + 2) % 3
                        quad = []
                        for db, dc in ((0, 0), (1, 0), (1, 1), (0, 1)):
                            corner = [i, j, k]
                            corner[axis] += side
                            corner[b] += db
                            corner[c] += dc
                            quad.append(Corner(*corner))
                        mesh.Quads.append(tuple(quad if side else quad[::-1]))
                        tags.append((axis, side, i, j, k))
    face = {tag: q for q, tag in enumerate(tags)}

    # Door and attic window look toward +Z, each side wall has two windows.
    # Patches of quads, with depth and inset.
    openings = [([(2, 1, i, j, nz - 2) for i in (3, 4) for j in (0, 1, 2)], 0.05, 0.10),
                ([(2, 1, i, 4, nz - 2) for i in (3, 4)], 0.04, 0.25)]
    for i, side in ((nx - 2, 1), (1, 0)):
        for k in (2, nz - 3):
            openings.append(([(0, side, i, j, k) for j in (2, 3)], 0.04, 0.12))
    openings = [([face[tag] for tag in patch], depth, inset) for patch, depth, inset in openings]
    taken = {q for patch, _, _ in openings for q in patch}
    frames = {p for q in taken for p in mesh.Quads[q]}

    # Uneven courses: shift the wall points within their walls, not the floor,
    # the roof, the openings and the corners of the house.
    for (i, j, k), p in number.items():
        if 0 < j < ny - 1 and p not in frames:
            shift = random.uniform(-0.045, 0.045, 2)
            if i in (1, nx - 1) and 1 < k < nz - 1:
                mesh.Points[p] += (0.0, 0.6 * shift[1], shift[0])
            elif k in (1, nz - 1) and 1 < i < nx - 1:
                mesh.Points[p] += (shift[0], 0.6 * shift[1], 0.0)

    def Normal(q):
        p = [mesh.Points[i] for i in mesh.Quads[q]]
        n = np.cross(p[2] - p[0], p[3] - p[1])
        return n / np.linalg.norm(n)

    for patch, depth, inset in openings:
        mesh.Extrude(patch, -depth * Normal(patch[0]), inset)
    # Chimney: a roof patch pulled up, then widened to a rim and hollowed.
    patch = [face[(1, 1, nx - 3, ny - 1, 2)]]
    height = ridge + roof + 0.18
    for i in mesh.Extrude(patch, np.zeros(3), 0.12):
        mesh.Points[i][1] = height
    for offset, inset in ((0.0, -0.22), (0.07, 0.0), (0.0, 0.35), (-0.06, 0.0)):
        mesh.Extrude(patch, np.array([0.0, offset, 0.0]), inset)

    # Protruding stones.
    for q, (axis, side, i, j, k) in enumerate(tags):
        underEaves = axis == 0 and j == ny - 2  # no room for a stone there
        if axis == 1 or j == ny - 1 or underEaves or q in taken or random.rand() > 0.52:
            continue
        for p in mesh.Extrude([q], random.uniform(0.035, 0.065) * Normal(q), random.uniform(0.16, 0.30)):
            mesh.Points[p] += random.uniform(-0.008, 0.008, 3)

    triangles = []
    for a, b, c, d in mesh.Quads:
        triangles += [(a, b, c), (a, c, d)] if random.rand() < 0.5 else [(a, b, d), (b, c, d)]
    # A patch of several quads leaves its old inner points behind.
    used, triangles = np.unique(triangles, return_inverse=True)
    return MakePolyData(np.array(mesh.Points)[used], triangles.reshape(-1, 3))


# ---------------------------------------------------------------------------
# Car

def MakeCar():
    """Beetle-like car of separate panels, as exported by modelers that do not weld.

    Neighboring panels share the positions of their seam points but not the
    points. Crowded stations at the wheels and panels that span the whole width
    make slivers.
    """
    half = 0.95  # half length, Z is ahead
    wheels, wheelRadius, axle = (0.58, -0.58), 0.19, 0.19
    # Stations along Z: sparse between, crowded at the wheel arches.
    arch = np.array([-0.25, -0.2499, -0.235, -0.19, -0.12, 0.0, 0.12, 0.19, 0.235, 0.2499, 0.25])
    stations = sorted(list(wheels[0] + arch) + list(wheels[1] + arch) +
                      [-half, -0.90, -0.36, -0.30, -0.13, 0.05, 0.22, 0.30, 0.88, half])
    stations = np.array(stations)

    def Smooth(z, knots, values):
        """Interpolation with level tangents at the knots."""
        k = np.clip(np.searchsorted(knots, z) - 1, 0, len(knots) - 2)
        t = np.clip((z - knots[k]) / (knots[k + 1] - knots[k]), 0.0, 1.0)
        return values[k] + (values[k + 1] - values[k]) * t * t * (3.0 - 2.0 * t)

    def Belt(z):
        return 0.50 - 0.13 * abs(z / half)**3

    def Roof(z):
        # Hood, windscreen, roof, long sloping back.
        return Belt(z) + Smooth(z, [-half, -0.85, -0.12, 0.10, 0.34, half], [0.02, 0.03, 0.37, 0.37, 0.07, 0.03])

    def Sill(z):
        low = 0.17 + 0.08 * abs(z / half)**6
        for w in wheels:
            if abs(z - w) < 0.25:
                low = max(low, axle + np.sqrt(0.25**2 - (z - w)**2))
        return low

    def Width(z):
        fender = sum(0.05 * np.exp(-((z - w) / 0.2)**2) for w in wheels)
        return 0.40 * (1.0 - 0.30 * abs(z / half)**5) + fender

    def Section(z):
        """Right half of the cross section, from the sill up to the middle of the roof."""
        sill, belt, top, width = Sill(z), Belt(z), Roof(z), Width(z)
        side = [(width * (1.0 + 0.05 * np.sin(np.pi * s)), sill + s * (belt - sill)) for s in (0.0, 0.35, 0.7, 1.0)]
        # The rounding at the belt and the roof must fit the low hood, too.
        h = top - belt
        inner = width - 0.07 - 0.22 * h
        upper = [(width - 0.045, belt + min(0.012, 0.2 * h)), (inner + 0.02, belt + 0.65 * h),
                 (inner - 0.05, top - min(0.025, 0.2 * h)), (0.0, top + 0.01)]
        return np.array(side + upper)

    sections = np.array([[(x, y, z) for x, y in Section(z)] for z in stations])
    mirrored = sections * (-1.0, 1.0, 1.0)

    points, triangles, panels = [], [], []

    def Panel(grid, outward):
        """Adds a grid of points as a panel of its own, turned so that it faces outward."""
        grid = np.asarray(grid)
        t = np.array(GridTriangles(grid.shape[0], grid.shape[1]))
        flat = grid.reshape(-1, 3)
        # A grid row may collapse to a point: weld inside the panel only.
        flat, t = Weld(flat, t)
        n = np.cross(flat[t[:, 1]] - flat[t[:, 0]], flat[t[:, 2]] - flat[t[:, 0]]).sum(axis=0)
        if n @ np.asarray(outward) < 0:
            t = t[:, ::-1]
        triangles.extend((t + len(points)).tolist())
        points.extend(flat)
        panels.extend([panels[-1] + 1 if panels else 0] * len(t))

    # Cuts along the length: bonnet, cabin, tail.
    front = int(np.argmin(np.abs(stations - 0.345)))
    back = int(np.argmin(np.abs(stations + 0.36)))
    for s, sign in ((sections, 1), (mirrored, -1)):
        for first, last in ((0, back), (back, front), (front, len(stations) - 1)):
            Panel(s[first:last + 1, :4], (sign, 0, 0))  # fenders and door
        Panel(s[back:front + 1, 3:7], (sign, 0, 0))  # side windows
        Panel(s[:back + 1, 3:7], (sign, 1, 0))
        Panel(s[front:, 3:7], (sign, 1, 0))
    # Hood, roof and tail span the whole width with two strips of long triangles.
    for first, last in ((0, back), (back, front), (front, len(stations) - 1)):
        Panel(np.stack([sections[first:last + 1, 6], sections[first:last + 1, 7], mirrored[first:last + 1, 6]], 1),
              (0, 1, 0))
    # Floor and both ends are ladders from side to side: nothing but slivers.
    Panel(np.stack([sections[:, 0], mirrored[:, 0]], 1), (0, -1, 0))
    for end, direction in ((0, -1), (-1, 1)):
        Panel(np.stack([sections[end], mirrored[end]], 1), (0, 0, direction))

    # Wheels are closed, with the disc as a fan; headlights are open half spheres.
    profile = [(0.0, 0.035), (0.10, 0.035), (0.12, 0.055), (0.17, 0.055), (wheelRadius, 0.035),
               (wheelRadius, -0.035), (0.16, -0.055), (0.0, -0.055)]
    wheel, wheelTriangles = Revolve([r for r, _ in profile][::-1], [y for _, y in profile][::-1], 16)
    light, lightTriangles = Revolve([0.0, 0.05, 0.09, 0.12 * 0.866, 0.0], [0.06, 0.05, 0.03, 0.0, 0.0], 10)
    keep = (lightTriangles != len(light) - 1).all(axis=1)
    for w in wheels:
        for sign in (-1, 1):
            # Y of the profile becomes the outward X: a rotation about Z.
            p = np.column_stack([wheel[:, 1], -wheel[:, 0], wheel[:, 2]]) * (sign, 1, 1)
            t = wheelTriangles if sign > 0 else wheelTriangles[:, ::-1]
            triangles.extend((t + len(points)).tolist())
            panels.extend([panels[-1] + 1] * len(t))
            points.extend(p + (sign * 0.385, axle, w))
    for sign in (-1, 1):
        # Y of the profile becomes Z: a rotation about X.
        p = np.column_stack([light[:, 0], -light[:, 2], light[:, 1]])[:-1] * (0.75, 0.75, 1.0)
        t = lightTriangles[keep][:, ::-1]
        triangles.extend((t + len(points)).tolist())
        panels.extend([panels[-1] + 1] * len(t))
        points.extend(p + (sign * 0.25, 0.335, half - 0.01))

    polyData = MakePolyData(points, triangles)
    AddArray(polyData.GetCellData(), "PanelIds", np.array(panels, dtype=np.int32))
    return polyData


# ---------------------------------------------------------------------------
# Creature

def WriteCreatureContour(fileName):
    from creature_field import CreatureField

    spacing = 0.008
    low, high = np.array([-0.55, -0.03, -0.40]), np.array([0.54, 1.12, 0.36])
    dims = ((high - low) / spacing).astype(int) + 1
    z, y, x = np.meshgrid(*[low[i] + spacing * np.arange(dims[i]) for i in (2, 1, 0)], indexing="ij")
    image = vtkImageData()
    image.SetDimensions(*[int(d) for d in dims])
    image.SetOrigin(*low)
    image.SetSpacing(spacing, spacing, spacing)
    field = CreatureField(np.stack([x, y, z], axis=-1)).ravel()
    # A value of zero in a grid point gives triangles without area.
    field[np.abs(field) < 1e-6] = 1e-6
    image.GetPointData().SetScalars(numpy_to_vtk(field, deep=True))
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0.0)
    contour.ComputeNormalsOff()
    contour.Update()
    surface = contour.GetOutput()
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    # The field grows outward, flying edges face the other way: turn it over.
    triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)[:, ::-1]
    with open(fileName, "w") as off:
        off.write("OFF\n%d %d 0\n" % (len(points), len(triangles)))
        np.savetxt(off, points, fmt="%.9g")
        np.savetxt(off, np.column_stack([np.full(len(triangles), 3), triangles]), fmt="%d")


def MakeCreature(fileName):
    from creature_field import CreatureField, CreatureGradient

    with open(fileName) as off:
        values = off.read().split()
    count, faces = int(values[1]), int(values[2])
    points = np.array(values[4:4 + 3 * count], dtype=float).reshape(-1, 3)
    triangles = np.array(values[4 + 3 * count:4 + 3 * count + 4 * faces], dtype=np.int64).reshape(-1, 4)[:, 1:]
    # Remeshing cuts corners a little: Newton steps back onto the exact surface.
    for _ in range(4):
        g = CreatureGradient(points)
        step = CreatureField(points)[:, None] * g / np.maximum((g * g).sum(axis=1), 0.1)[:, None]
        points -= step * np.minimum(1.0, 0.004 / np.maximum(np.linalg.norm(step, axis=1), 1e-12))[:, None]
    return MakePolyData(points, triangles)


# ---------------------------------------------------------------------------

def Main(arguments):
    if len(arguments) == 2 and arguments[0] == "--contour":
        WriteCreatureContour(arguments[1])
    elif len(arguments) == 2 and arguments[0] == "--creature":
        WriteModel("creature.vtp", MakeCreature(arguments[1]))
    elif not arguments:
        WriteModel("go-stone.vtp", MakeGoStone())
        WriteModel("icosahedron.vtp", MakeIcosahedron())
        WriteModel("tetrahedron.vtp", MakeTetrahedron())
        WriteModel("cube.vtp", MakeBox((1.0, 1.0, 1.0), (10, 10, 10), True))
        WriteModel("cuboid.vtp", MakeBox((1.0, 1.6, 0.7), (10, 16, 7), False))
        WriteModel("tangram-prism.vtp", MakeTangramPrism())
        WriteModel("stone-house.vtp", MakeStoneHouse())
        WriteModel("bottle.vtp", MakeBottle())
        WriteModel("snowman.vtp", MakeSnowman())
        WriteModel("car.vtp", MakeCar())
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    Main(sys.argv[1:])
