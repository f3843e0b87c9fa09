# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Measures that no filter provides, on n x 3 points P and m x 3 triangles F."""
import numpy as np
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkFiltersGeneral import vtkOBBTree

from surfaces import points, triangles


def edges(F):
    """All edges, each once: an array k x 2."""
    return np.unique(np.sort(np.concatenate([F[:, :2], F[:, 1:], F[:, ::2]]), axis=1), axis=0)


def dot(a, b):
    return (a * b).sum(axis=-1)


def length(a):
    return np.linalg.norm(a, axis=-1)


def half_cotangents(P, F):
    """m x 3: half the cotangent at corner k, which lies opposite the half-edge from k+1 to k+2."""
    result = []
    for k in range(3):
        a, b = P[F[:, (k + 1) % 3]] - P[F[:, k]], P[F[:, (k + 2) % 3]] - P[F[:, k]]
        result.append(0.5 * dot(a, b) / length(np.cross(a, b)))
    return np.column_stack(result)


def half_edges(F):
    """Start and end of the half-edges opposite corners 0, 1, 2: two arrays m x 3."""
    return F[:, [1, 2, 0]], F[:, [2, 0, 1]]


def edge_sums(F, values):
    """m x 3 -> m x 3: the sum over the half-edges of the same edge, for each of them."""
    u, v = half_edges(F)
    keys = np.sort(np.stack([u, v], axis=-1).reshape(-1, 2), axis=1)
    _, which = np.unique(keys, axis=0, return_inverse=True)
    return np.bincount(which.ravel(), values.ravel())[which.ravel()].reshape(values.shape)


def terms(P, F, kind):
    """Terms weight |e'_uv - R_cell e_uv|^2 of the rigidity energy: (cell, u, v, weight).

    kind "spokes": the edges at a point, full cotangent weights (Eq. 2.1); "rims": all half-edges of
    the triangles at it, full weights (Eq. 4.9); "triangles": the same with each triangle's own."""
    c = half_cotangents(P, F)
    w = edge_sums(F, c)
    u, v = half_edges(F)
    if kind == "spokes":
        pairs, first = np.unique(np.sort(np.stack([u, v], axis=-1).reshape(-1, 2), axis=1), axis=0,
                                 return_index=True)
        a, b = pairs.T
        weight = w.ravel()[first]
        return (np.concatenate([a, b]), np.concatenate([a, b]), np.concatenate([b, a]),
                np.concatenate([weight, weight]))
    weight = {"rims": w, "triangles": c}[kind]
    cell = np.repeat(F, 3, axis=1).ravel()  # each corner with the three half-edges
    return cell, np.tile(u, 3).ravel(), np.tile(v, 3).ravel(), np.tile(weight, 3).ravel()


def rotations(S):
    """The rotations R with the largest tr(R S), n x 3 x 3."""
    U, _, Qt = np.linalg.svd(S)
    U[:, :, 2] *= np.sign(np.linalg.det(U) * np.linalg.det(Qt))[:, None]
    return np.swapaxes(Qt, 1, 2) @ np.swapaxes(U, 1, 2)


def scatter(index, values, count):
    """For each index, the sum of the rows of values with that index."""
    flat = values.reshape(len(values), -1)
    sums = [np.bincount(index, flat[:, k], count) for k in range(flat.shape[1])]
    return np.column_stack(sums).reshape(count, *values.shape[1:])


def cell_energies(P, Q, term):
    """Energy of every cell with its best rotation, and the rotations."""
    cell, u, v, weight = term
    e, moved = P[u] - P[v], Q[u] - Q[v]
    S = scatter(cell, weight[:, None, None] * e[:, :, None] * moved[:, None, :], len(P))
    R = rotations(S)
    off = moved - np.einsum("nij,nj->ni", R[cell], e)
    return np.bincount(cell, weight * dot(off, off), len(P)), R


def rigid_deformation(P, term, held, positions, iterations):
    """As-rigid-as-possible iterations with held points, by dense matrices: energies, last points."""
    cell, u, v, weight = term
    count = len(P)
    L = np.zeros((count, count))
    for a, b, sign in ((u, u, 1.0), (v, v, 1.0), (u, v, -1.0), (v, u, -1.0)):
        np.add.at(L, (a, b), sign * weight)
    free = np.setdiff1d(np.arange(count), held)
    inverse = np.linalg.inv(L[np.ix_(free, free)])
    Q = P.copy()
    Q[held] = positions
    history = []
    for _ in range(iterations):
        energy, R = cell_energies(P, Q, term)
        history.append(energy.sum())
        pull = weight[:, None] * np.einsum("nij,nj->ni", R[cell], P[u] - P[v])
        b = scatter(u, pull, count) - scatter(v, pull, count)
        Q[free] = inverse @ (b[free] - L[np.ix_(free, held)] @ Q[held])
    return np.array(history), Q


def style_energy(P, Q, F, t, R, radius, roundness):
    """Eq. 4.16 term by term, full edge weights."""
    cell, u, v, weight = terms(P, F, "rims")
    moved = Q[u] - Q[v]
    rigid = moved - np.einsum("nij,nj->ni", R[cell], P[u] - P[v])
    round_ = moved - radius * np.einsum("nij,nj->ni", R[cell], t[u] - t[v])
    return (weight * dot(rigid, rigid) + roundness * dot(round_, round_)).sum()


def spearman(x, y):
    """Rank correlation."""
    ranks = [np.argsort(np.argsort(values)) for values in (x, y)]
    return np.corrcoef(*ranks)[0, 1]


def fit_sphere(P):
    """(center, radius, rms distance to it over the radius), least squares."""
    solution = np.linalg.lstsq(np.column_stack([2.0 * P, np.ones(len(P))]), dot(P, P), rcond=None)[0]
    center = solution[:3]
    radius = np.sqrt(solution[3] + dot(center, center))
    return center, radius, np.sqrt(((length(P - center) - radius) ** 2).mean()) / radius


def areas(P, F):
    return 0.5 * length(np.cross(P[F[:, 1]] - P[F[:, 0]], P[F[:, 2]] - P[F[:, 0]]))


def edge_curvatures(P, normals, E):
    """Normal curvature along each edge: change of the normal divided by length, below 0 where concave."""
    e = P[E[:, 0]] - P[E[:, 1]]
    return dot(normals[E[:, 0]] - normals[E[:, 1]], e) / dot(e, e)


def ray_crossings(surface, origin, directions):
    """For each ray with crossings: [(triangle, barycentric)], from the origin outward."""
    tree = vtkOBBTree()
    tree.SetDataSet(surface)
    tree.BuildLocator()
    P, F = points(surface), triangles(surface)
    found = []
    for direction in directions:
        hits, cells = vtkPoints(), vtkIdList()
        tree.IntersectWithLine(origin, np.asarray(origin) + 2.0 * surface.GetLength() * direction,
                               hits, cells)
        crossings = []
        for i in range(cells.GetNumberOfIds()):
            a, b, c = P[F[cells.GetId(i)]]
            system = np.vstack([np.column_stack([a, b, c]), np.ones(3)])
            weights = np.linalg.lstsq(system, np.append(hits.GetPoint(i), 1.0), rcond=None)[0]
            crossings.append((cells.GetId(i), weights))
        if crossings:
            found.append(crossings)
    return found
