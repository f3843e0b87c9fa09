# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The creature as an implicit function: negative inside, roughly a distance.

A red-panda-like cub: Y is up, it looks toward +Z, its soles lie in y = 0.
It is a smooth union of ellipsoids and tapered capsules; the blending radius
of each union decides whether a part flows into the body (belly) or stays a
part of its own (eyes).
"""

import numpy as np


def Ellipsoid(p, center, radii):
    """Approximate distance to an ellipsoid (exact on its surface)."""
    q = p - np.asarray(center)
    radii = np.asarray(radii)
    k0 = np.linalg.norm(q / radii, axis=-1)
    k1 = np.linalg.norm(q / radii**2, axis=-1)
    return k0 * (k0 - 1.0) / np.maximum(k1, 1e-9)


def Capsule(p, a, b, radiusA, radiusB):
    """Segment with a radius that changes linearly from a to b."""
    a, b = np.asarray(a), np.asarray(b)
    axis = b - a
    t = np.clip((p - a) @ axis / (axis @ axis), 0.0, 1.0)
    return np.linalg.norm(p - a - t[..., None] * axis, axis=-1) - (radiusA + (radiusB - radiusA) * t)


def Limb(p, joints, radii, k=0.02):
    """Chain of capsules through the joints."""
    d = Capsule(p, joints[0], joints[1], radii[0], radii[1])
    for i in range(1, len(joints) - 1):
        d = Union(d, Capsule(p, joints[i], joints[i + 1], radii[i], radii[i + 1]), k)
    return d


def Union(a, b, k):
    """Smooth minimum; k is the width of the blend (cubic, so curvature stays continuous)."""
    h = np.maximum(k - np.abs(a - b), 0.0) / k
    return np.minimum(a, b) - h**3 * k / 6.0


def Intersection(a, b, k):
    return -Union(-a, -b, k)


def Difference(a, b, k):
    return Intersection(a, -b, k)


def Tilted(p, center, degrees):
    """Coordinates of p around center, turned about Z, so that parts can lean sideways."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    q = p - np.asarray(center)
    return np.stack([c * q[..., 0] + s * q[..., 1], -s * q[..., 0] + c * q[..., 1], q[..., 2]], axis=-1)


def Head(p):
    # A toy has a large head: scale it about the neck.
    scale = 1.12
    neck = np.array([0.0, 0.55, 0.0])
    return scale * UnscaledHead(neck + (p - neck) / scale)


def UnscaledHead(p):
    # The features come in pairs: fold the space at the mirror plane x = 0.
    # The fold leaves a kink only where a part crosses the plane, so the parts
    # that do (skull, nose, chin) are evaluated in the unfolded space.
    m = p.copy()
    m[..., 0] = np.abs(m[..., 0])

    d = Ellipsoid(p, (0, 0.715, 0.0), (0.215, 0.185, 0.180))
    d = Union(d, Ellipsoid(p, (0, 0.665, 0.02), (0.245, 0.115, 0.150)), 0.10)  # wide cheeks

    # Ears: thick leaning discs, hollow in front.
    e = Tilted(m, (0.178, 0.885, -0.015), -32.0)
    ear = Ellipsoid(e, (0, 0, 0), (0.083, 0.105, 0.042))
    ear = Difference(ear, Ellipsoid(e, (0, 0.002, 0.050), (0.058, 0.076, 0.050)), 0.016)
    d = Union(d, ear, 0.045)

    # Muzzle: two puffs and a chin; the creases between them draw the mouth.
    puffL = Ellipsoid(p, (0.050, 0.650, 0.168), (0.068, 0.056, 0.080))
    puffR = Ellipsoid(p, (-0.050, 0.650, 0.168), (0.068, 0.056, 0.080))
    muzzle = Union(puffL, puffR, 0.008)
    muzzle = Union(muzzle, Ellipsoid(p, (0, 0.596, 0.148), (0.060, 0.040, 0.062)), 0.005)
    d = Union(d, muzzle, 0.035)
    d = Union(d, Ellipsoid(p, (0, 0.700, 0.224), (0.047, 0.033, 0.038)), 0.006)  # nose

    # Eyes, and brows above them.
    d = Union(d, Ellipsoid(m, (0.098, 0.752, 0.146), (0.046, 0.060, 0.042)), 0.005)
    d = Union(d, Capsule(m, (0.072, 0.852, 0.122), (0.132, 0.838, 0.102), 0.021, 0.016), 0.020)
    return d


def Body(p):
    m = p.copy()
    m[..., 0] = np.abs(m[..., 0])

    d = Ellipsoid(p, (0, 0.325, -0.01), (0.178, 0.215, 0.150))
    d = Union(d, Ellipsoid(p, (0, 0.285, 0.050), (0.175, 0.150, 0.140)), 0.08)  # belly
    d = Union(d, Ellipsoid(p, (0, 0.480, 0.0), (0.130, 0.085, 0.100)), 0.08)  # shoulders

    # Legs and feet with three toes each.
    leg = Limb(m, [(0.098, 0.200, 0.0), (0.122, 0.065, 0.020)], [0.086, 0.072])
    foot = Ellipsoid(m, (0.130, 0.048, 0.072), (0.082, 0.056, 0.105))
    for x, z in ((0.074, 0.150), (0.130, 0.170), (0.186, 0.147)):
        foot = Union(foot, Ellipsoid(m, (x, 0.042, z), (0.034, 0.040, 0.040)), 0.006)
    d = Union(d, Union(leg, foot, 0.05), 0.045)

    # One arm rests, the other one waves.
    rest = Limb(p, [(-0.140, 0.490, 0.01), (-0.245, 0.390, 0.02), (-0.262, 0.300, 0.085)], [0.062, 0.054, 0.050], 0.04)
    rest = Union(rest, Ellipsoid(p, (-0.262, 0.285, 0.095), (0.060, 0.062, 0.060)), 0.03)
    wave = Limb(p, [(0.140, 0.490, 0.01), (0.295, 0.460, 0.03), (0.380, 0.570, 0.07)], [0.062, 0.054, 0.050], 0.04)
    wave = Union(wave, Ellipsoid(p, (0.396, 0.605, 0.078), (0.066, 0.066, 0.050)), 0.03)
    for x, y in ((0.352, 0.667), (0.403, 0.685), (0.453, 0.662)):
        wave = Union(wave, Ellipsoid(p, (x, y, 0.082), (0.028, 0.036, 0.030)), 0.008)
    d = Union(d, rest, 0.05)
    d = Union(d, wave, 0.05)

    # Bushy tail that swings out to the side of the resting arm.
    tail = Limb(p,
                [(0.0, 0.170, -0.110), (-0.110, 0.130, -0.215), (-0.265, 0.150, -0.240),
                 (-0.375, 0.250, -0.215), (-0.420, 0.375, -0.170), (-0.405, 0.450, -0.140)],
                [0.050, 0.064, 0.086, 0.094, 0.070, 0.030], 0.05)
    return Union(d, tail, 0.05)


def CreatureField(p):
    """Field value at the points p, an array of shape (..., 3)."""
    p = np.asarray(p, dtype=float)
    d = Union(Body(p), Head(p), 0.05)
    return Intersection(d, -p[..., 1], 0.02)  # flat soles on the ground


def CreatureGradient(p, h=1e-4):
    """Central differences of the field."""
    g = np.empty_like(p)
    for i in range(3):
        step = np.zeros(3)
        step[i] = h
        g[:, i] = (CreatureField(p + step) - CreatureField(p - step)) / (2.0 * h)
    return g
