# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What a good result is, in numbers that do not depend on place, size and units.

x, y: points before and after (n x 3); F: triangles (m x 3) of a welded mesh, see weld().
"""
import numpy as np
from vtkmodules.vtkCommonCore import mutable
from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkStaticCellLocator

import surfaces

try:
    from scipy.sparse import coo_matrix, diags, identity
    from scipy.sparse.csgraph import connected_components
    from scipy.sparse.linalg import splu
except ImportError:
    surfaces.skip("scipy is not installed")


# --------------------------------------------------------------------------------------------- mesh
def diagonal(x):
    return np.linalg.norm(np.ptp(x, axis=0))


def weld(x, F):
    """The triangles with one point, the first, for all at a place; without those that collapse."""
    _, first, place = np.unique(x, axis=0, return_index=True, return_inverse=True)
    W = first[place.ravel()][F]
    return W[(W[:, 0] != W[:, 1]) & (W[:, 1] != W[:, 2]) & (W[:, 2] != W[:, 0])]


def component_ids(count, F):
    """The connected component of each point; points of no triangle: -1."""
    rows = np.concatenate([F[:, 0], F[:, 1]])
    columns = np.concatenate([F[:, 1], F[:, 2]])
    graph = coo_matrix((np.ones(len(rows)), (rows, columns)), shape=(count, count))
    ids = connected_components(graph, directed=False)[1]
    used = np.zeros(count, dtype=bool)
    used[F] = True
    result = np.full(count, -1)
    result[used] = np.unique(ids[used], return_inverse=True)[1]
    return result


def crosses(x, F):
    """Twice the area times the normal of each triangle."""
    return np.cross(x[F[:, 1]] - x[F[:, 0]], x[F[:, 2]] - x[F[:, 0]])


# -------------------------------------------------------------------------------- smooth reference
def toward_sphere(x, center, radius, roundness):
    """The linear blend with the sphere: the minimum of [blend]. A smooth map of space but at O, so
    it adds no roughness and moves parts that touch alike."""
    d = x - center
    d /= np.maximum(np.linalg.norm(d, axis=1), 1e-300)[:, None]
    mu = np.sqrt(3.0) * roundness
    return (x + mu * (center + radius * d)) / (1.0 + mu)


# ------------------------------------------------------------------------------------------- spikes
def spike(x, y, used, center, radius, factor=1.0):
    """Largest distance from the center, over that before or the radius, the larger of the two. A
    needle whose sphere is smaller counts as one of a twentieth of the diagonal. factor: by which y
    was scaled to keep its size (KeepSize)."""
    before = np.linalg.norm(x[used] - center, axis=1)
    allowed = np.maximum(before, max(radius, diagonal(x[used]) / 20.0))
    return (np.linalg.norm(y[used] - center, axis=1) / (factor * allowed)).max()


# -------------------------------------------------------------------------------------------- folds
class Folds:
    """The edges of two triangles."""

    def __init__(self, F):
        self.F = F
        half = np.concatenate([F[:, [1, 2]], F[:, [2, 0]], F[:, [0, 1]]])
        key = np.sort(half, axis=1) @ np.array([half.max() + 1, 1])
        order = np.argsort(key, kind="stable")
        _, start, count = np.unique(key[order], return_index=True, return_counts=True)
        a, b = order[start[count == 2]], order[start[count == 2] + 1]
        self.ends = half[a]
        self.left, self.right = a % len(F), b % len(F)
        # Two triangles that run along their edge the same way disagree on the outside.
        self.side = np.where((half[a] == half[b]).all(axis=1), -1.0, 1.0)

    def angles(self, x):
        """Signed angle between the triangles at each edge, radians; 0 is flat."""
        normal = crosses(x, self.F)
        length = np.linalg.norm(normal, axis=1)
        normal /= np.where(length > 0, length, 1.0)[:, None]
        left, right = normal[self.left], self.side[:, None] * normal[self.right]
        edge = x[self.ends[:, 1]] - x[self.ends[:, 0]]
        edge /= np.maximum(np.linalg.norm(edge, axis=1), 1e-300)[:, None]
        sine = np.einsum("ij,ij->i", np.cross(left, right), edge)
        return np.arctan2(sine, np.einsum("ij,ij->i", left, right))

    def weights(self, *positions):
        """How much of an edge is seen: the smaller of its triangles' areas, smallest of all
        positions, so that a triangle without an area, whose normal means nothing, does not count."""
        areas = np.min([np.linalg.norm(crosses(x, self.F), axis=1) for x in positions], axis=0)
        weight = np.minimum(areas[self.left], areas[self.right])
        return weight / weight.sum()


def wrapped(angle):
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


def rms_degrees(angle, weight):
    return np.degrees(np.sqrt((weight * angle ** 2).sum() / weight.sum()))


def fold_changes(folds, x, y, smooth):
    """(change, own, excess) in degrees: rms over the inner edges of the change of the folds from x
    to y, of that from x to the smooth reference, and of the difference of the two."""
    weight = folds.weights(x, y, smooth)
    before, after, reference = (folds.angles(p) for p in (x, y, smooth))
    return tuple(rms_degrees(wrapped(a), weight)
                 for a in (after - before, reference - before, after - reference))


# ------------------------------------------------------------------------------------------ turning
def nearest_rotations(M):
    U, _, V = np.linalg.svd(M)
    U[:, :, 2] *= np.linalg.det(U @ V)[:, None]
    return U @ V


def frames(x, F):
    """Two edges and the unit normal of each triangle as columns, and its area."""
    normal = crosses(x, F)
    doubled = np.linalg.norm(normal, axis=1)
    normal /= np.where(doubled > 0, doubled, 1.0)[:, None]
    return np.stack([x[F[:, 1]] - x[F[:, 0]], x[F[:, 2]] - x[F[:, 0]], normal], axis=2), doubled / 2


def turned_over(x, y, F, rotations):
    """Which triangles face against their normal before, turned by the mean rotation of their corners:
    against what their surroundings do. rotations: n x 3 x 3, of the points."""
    before, after = crosses(x, F), crosses(y, F)
    turned = np.einsum("fij,fj->fi", rotations[F].sum(axis=1), before)
    seen = np.linalg.norm(after, axis=1) > 1e-9 * np.linalg.norm(before, axis=1)
    return seen & (np.einsum("fi,fi->f", turned, after) < 0.0)


class Unevenness:
    """How unevenly the triangles turned, degrees: rms angle between the normal of a triangle and
    where the mean rotation of its surroundings (three rings, by area) takes it. Small for a smooth
    map however far it bends; details that only turn do not count."""

    def __init__(self, folds, x):
        self.F = folds.F
        count = len(self.F)
        pairs = np.concatenate([folds.left, folds.right]), np.concatenate([folds.right, folds.left])
        self.ring = identity(count) + coo_matrix((np.ones(len(pairs[0])), pairs), shape=(count, count))
        before, self.area = frames(x, self.F)
        self.normal = before[:, :, 2]
        self.inverse = np.linalg.pinv(before)

    def __call__(self, y):
        after, area = frames(y, self.F)
        turns = (self.area[:, None, None] * nearest_rotations(after @ self.inverse)).reshape(-1, 9)
        for _ in range(3):
            turns = self.ring @ turns
        expected = np.einsum("fij,fj->fi", nearest_rotations(turns.reshape(-1, 3, 3)), self.normal)
        angle = np.arctan2(np.linalg.norm(np.cross(expected, after[:, :, 2]), axis=1),
                           np.einsum("fi,fi->f", expected, after[:, :, 2]))
        return rms_degrees(angle, np.minimum(self.area, area))


# ---------------------------------------------------------------------------------------- details
def point_areas(x, F):
    """A third of each triangle to each corner."""
    area = np.linalg.norm(crosses(x, F), axis=1) / 6.0
    return np.bincount(F.ravel(), np.repeat(area, 3), len(x))


class Details:
    """What becomes of the details of a surface; cotangent weights and areas are those at rest."""

    def __init__(self, x, F, size):
        """size: that of details, a fraction of the diagonal."""
        self.x, self.F, self.diagonal = x, F, diagonal(x)
        self.start = np.concatenate([F[:, 1], F[:, 2], F[:, 0]])
        self.end = np.concatenate([F[:, 2], F[:, 0], F[:, 1]])
        opposite = F.T.ravel()
        a, b = x[self.start] - x[opposite], x[self.end] - x[opposite]
        self.weight = np.einsum("ij,ij->i", a, b) / (2.0 * np.linalg.norm(np.cross(a, b), axis=1))
        edges = coo_matrix((self.weight, (self.start, self.end)), shape=(len(x), len(x))).tocsr()
        edges = edges + edges.T
        self.laplacian = diags(np.asarray(edges.sum(axis=1)).ravel()) - edges
        self.areas = point_areas(x, F)
        matrix = diags(self.areas) + (size * self.diagonal) ** 2 * self.laplacian
        self.factor = splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0,
                           options={"SymmetricMode": True})
        self.own = x - self.base(x)

    def base(self, y):
        """Two implicit smoothing steps on the mesh: (M + s^2 L) B = M y. Not the grid of the filter."""
        for _ in range(2):
            y = self.factor.solve(self.areas[:, None] * y)
        return y

    def rotations(self, y):
        """Of the surface: SurfaceMetrics.md, R_i."""
        before, after = self.x[self.start] - self.x[self.end], y[self.start] - y[self.end]
        sums = self.weight[:, None, None] * after[:, :, None] * before[:, None, :]
        sums = sums.reshape(3, -1, 9).sum(axis=0)
        at_points = np.stack([np.bincount(self.F.ravel(), np.repeat(sums[:, k], 3), len(self.x))
                              for k in range(9)], axis=1)
        return nearest_rotations(at_points.reshape(-1, 3, 3))

    def errors(self, y):
        """(whole, without the base): rms of |L y - R L x| over the diagonal, as DetailError of
        vtkSurfaceMetrics; and the same of the details y - base(y) and x - base(x) alone."""
        R = self.rotations(y)

        def error(after, before):
            difference = self.laplacian @ after - np.einsum("nij,nj->ni", R, self.laplacian @ before)
            return np.sqrt((difference ** 2).sum(axis=1).mean()) / self.diagonal
        return error(y, self.x), error(y - self.base(y), self.own)


def radius_spread(x, F):
    """Standard deviation over mean of the distance of the points from the centroid of the surface."""
    area = np.linalg.norm(crosses(x, F), axis=1)
    radius = np.linalg.norm(x - area @ x[F].mean(axis=1) / area.sum(), axis=1)
    return radius.std() / radius.mean()


# -------------------------------------------------------------------------------------------- parts
def contacts(x, F, ids):
    """Where parts are near each other: (part, point, triangle, shares of its corners). For each part
    the points whose distance from the other parts is near the smallest."""
    near = []
    length = diagonal(x)
    of_triangle = ids[F[:, 0]]
    for part in range(ids.max() + 1 if ids.max() > 0 else 0):
        others = F[of_triangle != part]
        locator = vtkStaticCellLocator()
        locator.SetDataSet(surfaces.polydata(x, others))
        locator.BuildLocator()
        cell, foot = vtkGenericCell(), [0.0, 0.0, 0.0]
        which, sub, squared = mutable(0), mutable(0), mutable(0.0)
        found = []
        for point in np.flatnonzero(ids == part):
            locator.FindClosestPoint(x[point], foot, cell, which, sub, squared)
            found.append((np.sqrt(squared.get()), point, *others[which.get()], *foot))
        found = np.array(found)
        chosen = found[found[:, 0] <= 1.5 * found[:, 0].min() + 0.01 * length]
        near += [(part, *row) for row in chosen]
    return np.array(near).reshape(-1, 9)


def shares(x, corners, foot):
    """Barycentric coordinates of points in their triangles."""
    a, b, c = (x[corners[:, k]] for k in range(3))
    matrix = np.stack([b - a, c - a], axis=2)
    uv = np.einsum("nij,nj->ni", np.linalg.pinv(matrix), foot - a)
    return np.column_stack([1.0 - uv.sum(axis=1), uv])


class Parts:
    """The distances between parts that are neighbors."""

    def __init__(self, x, F):
        self.ids = component_ids(len(x), F)
        self.count = self.ids.max() + 1
        found = contacts(x, F, self.ids)
        self.part = found[:, 0].astype(int)
        self.point = found[:, 2].astype(int)
        self.corners = found[:, 3:6].astype(int)
        self.share = shares(x, self.corners, found[:, 6:9])
        self.diagonal = diagonal(x)
        self.rest = self.distances(x)

    def distances(self, x):
        foot = np.einsum("nk,nkj->nj", self.share, x[self.corners])
        return np.linalg.norm(x[self.point] - foot, axis=1) / self.diagonal

    def openings(self, y):
        """For each part how far it came away from its neighbors: the 95th percentile over its
        contacts of the growth of the distance, a fraction of the diagonal. Empty for one part."""
        growth = self.distances(y) - self.rest
        return np.array([np.percentile(growth[self.part == k], 95) for k in np.unique(self.part)])
