# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Generated shapes for the experiments, besides those in Data/: SHAPES[name](**parameters).

Y is up, triangles face outward, points are in double precision. Random numbers come from
RandomState, whose stream numpy keeps frozen.
"""
import pathlib
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

from surfaces import part, points, surface, triangles

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "Data"))
import generate_models as data  # noqa: E402

COARSE = {"head": {"cells": 30}, "mask": {"cells": 30}, "robot": {"cells": 28},
          "quadruped": {"cells": 32}, "compound": {"cells": 28}}  # of a small run
GOLDEN = 0.5 * (1.0 + np.sqrt(5.0))
SHAPES = {}


def shape(name):
    """Register a function that returns a vtkPolyData."""

    def register(function):
        SHAPES[name] = function
        return function

    return register


# ---------------------------------------------------------------------------------- Platonic solids
ICOSAHEDRON = (
    np.array([(-1, GOLDEN, 0), (1, GOLDEN, 0), (-1, -GOLDEN, 0), (1, -GOLDEN, 0),
              (0, -1, GOLDEN), (0, 1, GOLDEN), (0, -1, -GOLDEN), (0, 1, -GOLDEN),
              (GOLDEN, 0, -1), (GOLDEN, 0, 1), (-GOLDEN, 0, -1), (-GOLDEN, 0, 1)])
    / np.sqrt(1.0 + GOLDEN**2),
    [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
     (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9),
     (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)])
TETRAHEDRON = (np.array([(1, 1, 1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1)]) / np.sqrt(3.0),
               [(0, 1, 3), (0, 2, 1), (0, 3, 2), (1, 2, 3)])


def _unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


@shape("icosphere")
def icosphere(level=3):
    """Unit ball; 10 * 4^level + 2 points."""
    positions, faces = data.SubdivideLinear(*ICOSAHEDRON, level)
    return surface(_unit(positions), faces)


@shape("flat-icosahedron")
def flat_icosahedron(level=3):
    """Flat faces; Data/icosahedron.vtp is the same with a texture."""
    return surface(*data.SubdivideLinear(*ICOSAHEDRON, level))


@shape("flat-tetrahedron")
def flat_tetrahedron(level=4, scale=(1.0, 1.0, 1.0)):
    """Flat faces, 2 * 4^level + 2 points."""
    positions, faces = data.SubdivideLinear(*TETRAHEDRON, level)
    return surface(positions * np.asarray(scale), faces)


@shape("bipyramid")
def bipyramid(level=4):
    """Two regular tetrahedra joined at a face: model3."""
    around = 2.0 * np.pi * np.arange(3) / 3.0
    corners = [(np.sin(a), 0.0, np.cos(a)) for a in around]
    corners += [(0.0, np.sqrt(2.0), 0.0), (0.0, -np.sqrt(2.0), 0.0)]
    faces = [(k, (k + 1) % 3, 3) for k in range(3)] + [((k + 1) % 3, k, 4) for k in range(3)]
    return surface(*data.SubdivideLinear(corners, faces, level))


# ----------------------------------------------------------------------------------- smooth and boxes
@shape("perturbed-icosphere")
def perturbed_icosphere(level=3):
    """Like a ball, uneven but convex: model1."""
    directions, faces = data.SubdivideLinear(*ICOSAHEDRON, level)
    d = _unit(directions)
    radius = 1.0 + 0.10 * np.sin(2.0 * d[:, 0] + 1.0) * np.cos(1.8 * d[:, 1]) + 0.05 * np.sin(
        2.5 * d[:, 2] + 0.5)
    return surface(radius[:, None] * d, faces)


@shape("ellipsoid")
def ellipsoid(around=24, rings=16, axes=(1.0, 0.45, 1.0)):
    """UV ellipsoid about Y: around * rings + 2 points."""
    theta = np.pi * np.arange(rings + 2) / (rings + 1)
    positions, faces = data.Revolve(np.sin(theta), -np.cos(theta), around)
    return surface(positions * np.asarray(axes), faces)


@shape("open-ellipsoid")
def open_ellipsoid(around=24, rings=16, axes=(1.0, 0.45, 1.0), kept=0.75):
    """The same without its cap: only the lower part, up to kept times the height."""
    whole = ellipsoid(around, rings, axes)
    height = points(whole)[triangles(whole), 1]
    return part(whole, (height <= kept * axes[1] + 1e-9).all(axis=1))


@shape("box")
def box(size=(1.0, 1.0, 1.0), divisions=(10, 10, 10), alternate=True):
    """Box at the origin. alternate: diagonals preserve its mirror planes; otherwise all run in one direction."""
    return data.MakeBox(size, divisions, alternate)


# ------------------------------------------------------------------- characters, from implicit fields
def _ball(p, center, axes):
    """About the distance to an ellipsoid, negative inside; axes: three, or one radius."""
    axes = np.broadcast_to(np.asarray(axes, dtype=float), 3)
    scaled = (p - np.asarray(center)) / axes
    return (np.linalg.norm(scaled, axis=-1) - 1.0) * axes.min()


def _capsule(p, start, end, radius):
    """Distance to the segment from start to end, less the radius."""
    start, axis = np.asarray(start, dtype=float), np.subtract(end, start)
    t = np.clip(((p - start) @ axis) / (axis @ axis), 0.0, 1.0)
    return np.linalg.norm(p - start - t[..., None] * axis, axis=-1) - radius


def _union(first, second, blend):
    """The union of both, with a fillet about as wide as blend."""
    h = np.maximum(blend - np.abs(first - second), 0.0) / blend
    return np.minimum(first, second) - 0.25 * blend * h * h


def _without(first, second, blend):
    return -_union(-first, second, blend)


def _contoured(field, low, high, cells):
    """The surface field = 0 with even triangles. cells: of the grid, along its longest side."""
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    step = (high - low).max() / cells
    counts = np.ceil((high - low) / step).astype(int) + 1
    grid = np.stack(np.meshgrid(*(low[k] + step * np.arange(counts[k]) for k in range(3)),
                                indexing="ij"), axis=-1)
    image = vtkImageData()
    image.SetDimensions(*(int(count) for count in counts))
    image.SetOrigin(*low)
    image.SetSpacing(step, step, step)
    values = numpy_to_vtk(field(grid).ravel(order="F"), deep=True)
    image.GetPointData().SetScalars(values)
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0.0)
    contour.ComputeNormalsOff()
    contour.ComputeScalarsOff()
    contour.ComputeGradientsOff()
    contour.Update()
    positions, faces = points(contour.GetOutput()), triangles(contour.GetOutput())[:, ::-1]
    return surface(_relaxed(field, positions, faces, 1e-3 * step), faces)


def _relaxed(field, positions, faces, small, steps=20):
    """Points at the mean of their neighbors, back on the surface field = 0 after each step."""
    ends = np.concatenate([faces, np.roll(faces, 1, axis=1)], axis=1)
    starts = np.concatenate([np.roll(faces, 1, axis=1), faces], axis=1)
    count = np.bincount(starts.ravel(), minlength=len(positions))[:, None]
    for _ in range(steps):
        mean = np.column_stack([
            np.bincount(starts.ravel(), positions[ends.ravel(), k], len(positions))
            for k in range(3)]) / count
        positions = 0.5 * (positions + mean)
        for _ in range(2):
            gradient = np.column_stack([
                (field(positions + small * axis) - field(positions - small * axis)) / (2.0 * small)
                for axis in np.eye(3)])
            square = np.maximum((gradient**2).sum(axis=1), 0.01)
            positions = positions - (field(positions) / square)[:, None] * gradient
    return positions


@shape("head")
def head(cells=44):
    """Skull, nose, brows, eye sockets, mouth, chin, ears and a neck; looks along +Z."""

    def field(p):
        f = _ball(p, (0, 0.15, -0.05), (0.72, 0.82, 0.80))
        f = _union(f, _ball(p, (0, -0.45, 0.18), (0.46, 0.42, 0.50)), 0.35)  # jaw
        f = _union(f, _capsule(p, (0, -0.4, -0.15), (0, -1.1, -0.25), 0.36), 0.2)  # neck
        f = _union(f, _ball(p, (0, -0.70, 0.55), 0.13), 0.15)  # chin
        for side in (-1, 1):
            f = _union(f, _ball(p, (0.76 * side, 0.0, -0.05), (0.09, 0.24, 0.16)), 0.08)  # ears
            f = _without(f, _ball(p, (0.27 * side, 0.12, 0.86), (0.19, 0.12, 0.22)), 0.10)
            f = _union(f, _ball(p, (0.27 * side, 0.12, 0.62), 0.105), 0.03)  # eyeballs
            f = _union(f, _capsule(p, (0.13 * side, 0.29, 0.72), (0.42 * side, 0.28, 0.58), 0.06), 0.1)
        f = _union(f, _capsule(p, (0, 0.20, 0.72), (0, -0.10, 0.88), 0.085), 0.10)  # nose
        f = _union(f, _capsule(p, (-0.17, -0.36, 0.64), (0.17, -0.36, 0.64), 0.075), 0.10)  # lips
        return _without(f, _ball(p, (0, -0.36, 0.74), (0.19, 0.035, 0.12)), 0.04)  # mouth

    return _contoured(field, (-1.0, -1.6, -1.0), (1.0, 1.1, 1.1), cells)


@shape("robot")
def robot(cells=40):
    """A can with eyes, arms and two flat feet, in place of the doodlebot."""

    def field(p):
        q = np.stack([np.hypot(p[..., 0], p[..., 2]) - 0.42, np.abs(p[..., 1]) - 0.85], axis=-1)
        f = np.linalg.norm(np.maximum(q, 0.0), axis=-1) + np.minimum(q.max(axis=-1), 0.0) - 0.13
        for side in (-1, 1):
            f = _union(f, _ball(p, (0.22 * side, 0.55, 0.48), 0.12), 0.05)
            f = _union(f, _capsule(p, (0.5 * side, 0.05, 0), (0.85 * side, -0.25, 0.1), 0.12), 0.1)
            f = _union(f, _ball(p, (0.28 * side, -1.05, 0.12), (0.24, 0.14, 0.36)), 0.12)
        return f

    return _contoured(field, (-1.1, -1.35, -0.7), (1.1, 1.15, 0.7), cells)


@shape("quadruped")
def quadruped(cells=48):
    """Belly, head, ears, legs and a tail, in place of the bunny: concave at neck and legs."""

    def field(p):
        f = _ball(p, (0, 0, -0.15), (0.50, 0.52, 0.75))
        f = _union(f, _ball(p, (0, 0.62, 0.62), (0.38, 0.36, 0.40)), 0.18)
        f = _union(f, _ball(p, (0, 0.50, 0.97), (0.20, 0.15, 0.15)), 0.10)  # muzzle
        f = _union(f, _ball(p, (0, 0.05, -0.95), 0.18), 0.10)  # tail
        for side in (-1, 1):
            f = _union(f, _capsule(p, (0.18 * side, 0.85, 0.5), (0.28 * side, 1.40, 0.35), 0.11), 0.08)
            for z in (-0.5, 0.3):
                f = _union(f, _capsule(p, (0.30 * side, -0.2, z), (0.33 * side, -0.75, z), 0.15), 0.1)
        return f

    return _contoured(field, (-0.8, -1.1, -1.3), (0.8, 1.7, 1.3), cells)


@shape("compound")
def compound(cells=40):
    """A block, a ball and a peg in one piece."""

    def field(p):
        q = np.abs(p - np.array([0.0, -0.35, 0.0])) - np.array([0.75, 0.30, 0.55])
        f = np.linalg.norm(np.maximum(q, 0.0), axis=-1) + np.minimum(q.max(axis=-1), 0.0) - 0.04
        f = _union(f, _ball(p, (-0.3, 0.2, 0.0), 0.42), 0.08)
        return _union(f, _capsule(p, (0.45, 0.0, 0.0), (0.45, 0.75, 0.0), 0.2), 0.08)

    return _contoured(field, (-1.0, -0.9, -0.8), (1.0, 1.2, 0.8), cells)


@shape("mask")
def mask(cells=44):
    """The head's face with a rim of triangles that are long and thin, in place of the female face."""
    whole = head(cells)
    corners = points(whole)[triangles(whole)]
    face = part(whole, ((corners[:, :, 2] > 0.0) & (corners[:, :, 1] > -0.85)).all(axis=1))
    positions, faces = points(face), triangles(face)
    # Half-edges without a twin run along the border.
    edges = np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)])
    known = {tuple(edge) for edge in edges.tolist()}
    border = np.array([edge for edge in edges.tolist() if (edge[1], edge[0]) not in known])
    loop = np.unique(border)
    copy = np.full(len(positions), -1)
    copy[loop] = len(positions) + np.arange(len(loop))
    back = positions[loop] * (1.0, 1.0, 0.0) + (0.0, 0.0, -0.6)
    u, v = border.T
    rim = np.concatenate([np.column_stack([v, u, copy[u]]), np.column_stack([v, copy[u], copy[v]])])
    return surface(np.concatenate([positions, back]), np.concatenate([faces, rim]))
