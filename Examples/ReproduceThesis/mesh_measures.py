# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Shape, edges and angles of triangle meshes: points x (n x 3), triangles F (m x 3)."""
import numpy as np
from vtkmodules.vtkFiltersCore import vtkFeatureEdges

from measures import areas, dot, length
from surfaces import points, triangles

SLIVER = 1e-3  # degrees; with a smaller angle, a triangle has no reliable normal


def places(x):
    """For each point, the first point at the same position."""
    _, first, place = np.unique(x, axis=0, return_index=True, return_inverse=True)
    return first[place]


def welded(surface):
    """The triangles without slivers, with coincident points replaced by the first of them."""
    x = points(surface)
    F = places(x)[triangles(surface)]
    return F[angles(x, F).min(axis=1) > SLIVER]


# ----------------------------------------------------------------------------------- size and shape
def diagonal(x):
    return np.linalg.norm(np.ptp(x, axis=0))


def crosses(x, F):
    """Twice the area times the normal of each triangle."""
    return np.cross(x[F[:, 1]] - x[F[:, 0]], x[F[:, 2]] - x[F[:, 0]])


def normals_of(x, F):
    """Unit normals of the triangles; zeros where there is no area."""
    normal = crosses(x, F)
    size = length(normal)
    return normal / np.where(size > 0.0, size, 1.0)[:, None]


def volume(x, F):
    return dot(x[F[:, 0]], np.cross(x[F[:, 1]], x[F[:, 2]])).sum() / 6.0


def angles(x, F):
    """The angles at the corners of the triangles, degrees (m, 3)."""
    result = np.empty(F.shape)
    for k in range(3):
        a, b = x[F[:, k - 2]] - x[F[:, k]], x[F[:, k - 1]] - x[F[:, k]]
        result[:, k] = np.degrees(np.arctan2(length(np.cross(a, b)), dot(a, b)))
    return result


def obtuse(x, F):
    """Which triangles have an angle above 90 degrees."""
    return angles(x, F).max(axis=1) > 90.0


def spread(x, F):
    """Standard deviation over mean of the distances from the area centroid, by area."""
    area, middle = areas(x, F), x[F].mean(axis=1)
    radius = length(middle - np.average(middle, axis=0, weights=area))
    mean = np.average(radius, weights=area)
    return np.sqrt(np.average((radius - mean) ** 2, weights=area)) / mean


def turned_over(before, after, F):
    """Triangles whose normal turned by more than 90 degrees."""
    return int((dot(crosses(before, F), crosses(after, F)) < 0.0).sum())


# -------------------------------------------------------------------------------------------- edges
def corner_table(F):
    """(u, v, opposite corner) of all half-edges, and the triangle of each."""
    corners = np.concatenate([F[:, (0, 1, 2)], F[:, (1, 2, 0)], F[:, (2, 0, 1)]])
    return corners, np.tile(np.arange(len(F)), 3)


def edge_weights(x, F):
    """Edges (u < v) and their w_uv: the sum of half the cotangents opposite (Eq. 2.4)."""
    corners, _ = corner_table(F)
    u, v, o = corners.T
    a, b = x[u] - x[o], x[v] - x[o]
    cotangent = dot(a, b) / length(np.cross(a, b))
    edges, edge = np.unique(np.sort(corners[:, :2], axis=1), axis=0, return_inverse=True)
    return edges, np.bincount(edge, 0.5 * cotangent)


def laplacian(n, edges, w):
    """The dense matrix whose row u is sum_v w_uv (p_u - p_v)."""
    L = np.zeros((n, n))
    u, v = edges.T
    np.add.at(L, (u, v), -w)
    np.add.at(L, (v, u), -w)
    np.add.at(L, (u, u), w)
    np.add.at(L, (v, v), w)
    return L


def inner_edges(F):
    """Edges (u, v) of exactly two triangles, and these two."""
    corners, owner = corner_table(F)
    ends = np.sort(corners[:, :2], axis=1)
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    ends, owner = ends[order], owner[order]
    same = (ends[1:] == ends[:-1]).all(axis=1)
    alone = np.append(True, ~same)  # the first half-edge of its edge
    count = np.diff(np.append(np.flatnonzero(alone), len(ends)))
    first = np.flatnonzero(alone)[count == 2]
    return ends[first], owner[first], owner[first + 1]


def dihedral_angles(x, F):
    """Signed angle between the two triangles of each inner edge, radians."""
    ends, a, b = inner_edges(F)
    normal = normals_of(x, F)
    along = x[ends[:, 1]] - x[ends[:, 0]]
    along = along / np.maximum(length(along), 1e-300)[:, None]
    return np.arctan2(dot(np.cross(normal[a], normal[b]), along), dot(normal[a], normal[b]))


def dihedral_change(before, after, F):
    """By how much the dihedral angles changed, rms, degrees: 0 if every detail kept its shape."""
    turned = dihedral_angles(after, F) - dihedral_angles(before, F)
    turned = (turned + np.pi) % (2.0 * np.pi) - np.pi
    return np.degrees(np.sqrt((turned ** 2).mean()))


def open_edges(surface):
    """Edges with one triangle or with more than two."""
    edges = vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.FeatureEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


# ------------------------------------------------------------------------------------------- shapes
def aligned(a, b, scale=False):
    """b translated, rotated and optionally scaled to fit a (Kabsch, Umeyama), and the scale factor."""
    ca, cb = a.mean(axis=0), b.mean(axis=0)
    U, S, Vt = np.linalg.svd((b - cb).T @ (a - ca))
    handed = np.sign(np.linalg.det(U @ Vt))
    S[2] *= handed
    U[:, 2] *= handed
    factor = S.sum() / dot(b - cb, b - cb).sum() if scale else 1.0
    return ca + factor * (b - cb) @ U @ Vt, factor


def distance(a, b):
    """Rms distance of corresponding points after the best rigid motion, divided by the diagonal of a."""
    off = a - aligned(a, b)[0]
    return np.sqrt(dot(off, off).mean()) / diagonal(a)


def similar(a, b):
    """The same after the best rigid motion and scaling, and the scale factor."""
    near, factor = aligned(a, b, scale=True)
    return np.sqrt(dot(a - near, a - near).mean()) / diagonal(a), factor


# ----------------------------------------------------------------------------------------- energies
def rises(changes, scale):
    """How many changes of an energy are above 0, beyond rounding."""
    return int((changes > 1e-10 * abs(scale)).sum())
