# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Ways to spoil a clean mesh. Each takes points x, triangles F and a numpy RandomState and gives a Variant."""
import numpy as np

import measures


class Variant:
    """x, F: a mesh. kept: clean points that are there still; at: which points of x they are, moved
    by shift. clean: the mesh to compare with, where it is not the one given."""

    def __init__(self, x, F, kept, at, shift=0.0, clean=None):
        self.x, self.F, self.kept, self.at, self.shift, self.clean = x, F, kept, at, shift, clean


def same_points(x, F, count, **others):
    """The first points are the clean ones."""
    return Variant(x, F, np.arange(count), np.arange(count), **others)


def without(x, F, gone):
    """The triangles that are not gone and the points they use."""
    used, G = np.unique(F[~gone], return_inverse=True)
    return Variant(x[used], G.reshape(-1, 3), used, np.arange(len(used)))


def centroids(x, F):
    return x[F].mean(axis=1)


def near(x, F, random, size):
    """Triangles around a random point; size: a fraction of the diagonal."""
    distance = np.linalg.norm(centroids(x, F) - x[random.choice(F.ravel())], axis=1)
    return distance < size * measures.diagonal(x)


# ---------------------------------------------------------------------------------------- cut open
def hole(x, F, random):
    """A hole of a tenth of the diagonal."""
    return without(x, F, near(x, F, random, 0.05))


def holes(x, F, random):
    """One triangle in fifty is missing."""
    return without(x, F, random.random_sample(len(F)) < 0.02)


def slit(x, F, random):
    """The triangles that a half plane from the center cuts are missing."""
    normal, along = np.linalg.qr(random.normal(size=(3, 2)))[0].T
    middle = centroids(x, F).mean(axis=0)
    side = (x - middle) @ normal > 0
    mixed = side[F].any(axis=1) & ~side[F].all(axis=1)
    return without(x, F, mixed & ((centroids(x, F) - middle) @ along > 0))


# ----------------------------------------------------------------------------------------- detached
def detached(x, F, random, parts=1, size=0.15, gap=0.003):
    """Pieces have points of their own and stand off by gap times the diagonal."""
    length, middle = measures.diagonal(x), x.mean(axis=0)
    piece = np.zeros(len(F), dtype=int)
    for k in range(1, parts + 1):
        piece[near(x, F, random, size) & (piece == 0)] = k
    X, G = [x], F.copy()
    at, shift, count = np.arange(len(x)), np.zeros_like(x), len(x)
    for k in range(1, parts + 1):
        own, local = np.unique(F[piece == k], return_inverse=True)
        away = x[own].mean(axis=0) - middle
        move = gap * length * away / np.linalg.norm(away)
        G[piece == k] = count + local.reshape(-1, 3)
        X.append(x[own] + move)
        inside = ~np.isin(own, F[piece != k])
        at[own[inside]] = count + np.flatnonzero(inside)
        shift[own[inside]] = move
        count += len(own)
    # A border between two pieces belongs to neither, and its first points are of no triangle now.
    kept = np.flatnonzero(np.isin(at, G))
    return Variant(np.concatenate(X), G, kept, at[kept], shift=shift)


def three_detached(x, F, random):
    """Three pieces."""
    return detached(x, F, random, parts=3, size=0.1)


# ----------------------------------------------------------------------------------------- slivers
def edge_slivers(x, F, random, share=0.1, at=1e-3):
    """Edges are split a thousandth of their length from an end: both triangles get a needle."""
    half = np.concatenate([F[:, [1, 2]], F[:, [2, 0]], F[:, [0, 1]]])
    key = np.sort(half, axis=1) @ np.array([len(x), 1])
    new, free, G = [], np.ones(len(F), dtype=bool), list(map(tuple, F))
    chosen = random.permutation(np.unique(key))[:int(share * len(np.unique(key)))]
    order = np.argsort(key, kind="stable")
    first, last = (np.searchsorted(key[order], chosen, side) for side in ("left", "right"))
    for i, j in zip(first, last):
        at_edge = order[i:j]
        if not free[at_edge % len(F)].all():
            continue  # each triangle is split once at most
        free[at_edge % len(F)] = False
        near_end = half[at_edge[0], 0]
        new.append((1 - at) * x[near_end] + at * x[half[at_edge[0], 1]])
        middle = len(x) + len(new) - 1
        for h in at_edge:
            (u, v), f, w = half[h], h % len(F), F[h % len(F), h // len(F)]
            G[f] = (u, middle, w)
            G.append((middle, v, w))
    return same_points(np.concatenate([x, new]), np.array(G), len(x))


def caps(x, F, random, share=0.1, height=1e-3):
    """Points inside triangles, a thousandth of the height from an edge: angles of nearly 180 degrees."""
    chosen = np.flatnonzero(random.random_sample(len(F)) < share)
    a, b, c = x[F[chosen]].transpose(1, 0, 2)
    along = random.uniform(0.2, 0.8, size=(len(chosen), 1))
    new = (1 - height) * ((1 - along) * a + along * b) + height * c
    G = F.copy()
    ids = len(x) + np.arange(len(chosen))
    u, v, w = F[chosen].T
    G[chosen] = np.column_stack([u, v, ids])
    more = np.concatenate([np.column_stack([v, w, ids]), np.column_stack([w, u, ids])])
    return same_points(np.concatenate([x, new]), np.concatenate([G, more]), len(x))


# --------------------------------------------------------------- points, orientation, scale, fans
def soup(x, F, random):
    """Each triangle has points of its own."""
    at = np.full(len(x), -1)
    at[F.ravel()] = np.arange(F.size)
    kept = np.flatnonzero(at >= 0)
    return Variant(x[F.ravel()], np.arange(F.size).reshape(-1, 3), kept, at[kept])


def flipped(x, F, random):
    """Three triangles in ten face inward."""
    G = F.copy()
    turned = random.random_sample(len(F)) < 0.3
    G[turned] = G[turned][:, ::-1]
    return same_points(x, G, len(x))


def unreferenced(x, F, random):
    """A fifth more points, of no triangle, ten times the model's size around it."""
    extra = x.mean(axis=0) + 10 * measures.diagonal(x) * random.normal(size=(len(x) // 5, 3))
    return same_points(np.concatenate([x, extra]), F, len(x))


def scaled(x, F, random):
    """A hundred times as long along z, and half of the triangles split in three: compared with the
    same long shape unsplit."""
    long = x * np.array([1.0, 1.0, 100.0])
    chosen = random.random_sample(len(F)) < 0.5
    u, v, w = F[chosen].T
    middle = len(x) + np.arange(chosen.sum())
    fans = [np.column_stack([a, b, middle]) for a, b in ((u, v), (v, w), (w, u))]
    return same_points(np.concatenate([long, centroids(long, F[chosen])]),
                       np.concatenate([F[~chosen], *fans]), len(x), clean=(long, F))


KINDS = {
    "cut open": (hole, holes, slit),
    "parts detached": (detached, three_detached),
    "slivers": (edge_slivers, caps),
    "points duplicated": (soup,),
    "triangles flipped": (flipped,),
    "points unreferenced": (unreferenced,),
    "scaled by 100": (scaled,),
}
