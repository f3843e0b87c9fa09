# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Shapes of the experiments that are not in Data/, made by code: SHAPES[name](**parameters).

Y is up, triangles face outward, points are in double precision. Random numbers come from
RandomState, whose stream numpy keeps frozen.
"""
import pathlib
import sys

import numpy as np

from surfaces import points, surface, triangles

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "Data"))
import generate_models as data  # noqa: E402

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
    """Like a ball, with soft bumps: model1."""
    directions, faces = data.SubdivideLinear(*ICOSAHEDRON, level)
    d = _unit(directions)
    radius = 1.0 + 0.16 * np.sin(3.0 * d[:, 0] + 1.0) * np.cos(2.5 * d[:, 1]) + 0.10 * np.sin(
        4.0 * d[:, 2] + 0.5)
    return surface(radius[:, None] * d, faces)


@shape("ellipsoid")
def ellipsoid(around=24, rings=16, axes=(1.0, 0.45, 1.0)):
    """UV ellipsoid about Y: around * rings + 2 points."""
    theta = np.pi * np.arange(rings + 2) / (rings + 1)
    positions, faces = data.Revolve(np.sin(theta), -np.cos(theta), around)
    return surface(positions * np.asarray(axes), faces)


@shape("open-ellipsoid")
def open_ellipsoid(around=24, rings=16, axes=(1.0, 0.45, 1.0), kept=0.75):
    """The same without its cap above kept times the height."""
    whole = ellipsoid(around, rings, axes)
    positions, faces = points(whole), triangles(whole)
    faces = faces[(positions[faces, 1] <= kept * axes[1] + 1e-9).all(axis=1)]
    used, faces = np.unique(faces, return_inverse=True)
    return surface(positions[used], faces.reshape(-1, 3))


@shape("box")
def box(size=(1.0, 1.0, 1.0), divisions=(10, 10, 10), alternate=True):
    """Box at the origin. alternate: diagonals that keep its mirror planes, else all one way."""
    return data.MakeBox(size, divisions, alternate)
