# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Chapter 2 and section 1.1: what the method is built on and compared with."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from common import METRICS, RISE, check_monotone
from measures import (cell_energies, edge_sums, half_cotangents, half_edges, length,
                      rigid_deformation, terms)
from mesh_measures import obtuse, turned_over
from report import NOT_REPRODUCED, experiment
from surfaces import array, moved, points, triangles

KINDS = {"spokes": "spokes, full weights", "rims": "spokes and rims, full weights",
         "triangles": "spokes and rims, each triangle's own"}


@experiment("A2.1", "A2.2", "A2.3", title="Cells of the rigidity energy", where="2.3, Eq. 2.1-2.3, Fig. 2.3",
            claim={
                "A2.1": "The energy of a cell of spokes measures how far the edges at a point are from "
                        "a rotation of what they were.",
                "A2.2": "A cell of spokes and rims holds all edges of the triangles at a point: an "
                        "inner edge counts twice for each end and once for each opposite point.",
                "A2.3": "Spokes alone may lead to artifacts, as their energy can be indefinite."})
def cells(section, context):
    section.text("The energies are summed and lowered here with small dense matrices, as the filter "
                 "holds no points to pull at. Its cells are spokes and rims, and spokes alone with the "
                 "nonlinear feature; A4.4 and A3.1 compare its energies with such sums. Full weights, "
                 "as in the thesis, give each half-edge the weight of the whole edge (Eq. 2.4).")
    surface = context.model("stone-house")
    P, F = points(surface), triangles(surface)
    ball = context.model("icosphere", level=2)
    rows, lowest, plotted, panels, over = [], {}, {}, [(surface, "model")], {}
    height = (P[:, 1] - P[:, 1].min()) / np.ptp(P[:, 1])
    top, bottom = height > 0.75, height < 0.05
    held = np.flatnonzero(top | bottom)
    pulled = P[held] + 0.3 * surface.GetLength() * top[held][:, None] * np.array([1.0, 0.0, 0.0])
    for kind, name in KINDS.items():
        term = terms(P, F, kind)
        energies, Q = rigid_deformation(P, term, held, pulled, context.choose(10, 40))
        energies = energies[1:] / surface.GetLength() ** 2
        lowest[kind], over[kind] = energies.min(), turned_over(P, Q, F)
        rows.append([name, rigid_energy(ball, kind), rigid_energy(surface, kind), lowest[kind],
                     over[kind]])
        plotted[name] = (np.arange(1, len(energies) + 1), energies)
        panels.append((moved(surface, Q), name))
    section.picture("The roof pulled aside", panels, caption="The ridge and above by 0.3 of the "
                    "diagonal, the base held")
    section.table("Energies", ["cells", "rigid motion of a ball", "rigid motion of the house",
                               "lowest with the roof pulled", "triangles turned over then"], rows,
                  f"Over the squared diagonal, each cell with its best rotation; "
                  f"{100.0 * obtuse(P, F).mean():.0f} % of the house's triangles are obtuse")
    section.plot("Energy with the roof pulled", plotted, x="Iteration", y="energy / squared diagonal")
    section.check(abs(rows[0][1]) < 1e-20, "Spokes: a rigid motion of a ball, whose weights are "
                  "positive, has no energy (1e-20 of the squared diagonal)", f"{rows[0][1]:.2g}", "A2.1")
    rise = largest_rise_with_handle(ball)
    section.check(rise <= RISE, "Spokes: with a point of that ball pulled out, no iteration raises the "
                  f"energy (by {RISE:g} of it or more)", f"largest change {rise:.2g} of the first energy",
                  "A2.1")
    for surface_, edge, expected, statement in (
            (ball, "inner", [1, 1, 2, 2], "an inner edge counts 2, 2 for its ends and 1, 1 for the "
             "points opposite"),
            (context.model("open-ellipsoid"), "border", [1, 1, 1], "a border edge counts 1 for each "
             "corner of its triangle")):
        counts = rim_counts(surface_, edge == "border")
        section.check(counts == expected, f"In spokes and rims {statement}",
                      ", ".join(map(str, counts)), "A2.2")
    section.check(lowest["spokes"] < 0.0 and rows[0][2] < 0.0, "On the house the energy of spokes "
                  "falls below 0, even without any deformation",
                  f"lowest {lowest['spokes']:.3g}, rigid {rows[0][2]:.2g}", "A2.3")
    section.check(over["spokes"] > max(over["rims"], over["triangles"]), "Spokes turn over more triangles "
                  "of it than spokes and rims", f"{over['spokes']}, {over['rims']} and "
                  f"{over['triangles']}", "A2.3")
    section.check(lowest["triangles"] >= 0.0 and rows[2][2] > -1e-20, "With each triangle's own "
                  "cotangents the energy never falls below 0", f"lowest {lowest['triangles']:.3g}, rigid "
                  f"{rows[2][2]:.2g}; spokes and rims with full weights: {lowest['rims']:.3g} and "
                  f"{rows[1][2]:.2g}, see A8.6", "A2.3")


def rigid_energy(surface, kind):
    turn = np.linalg.qr(np.random.RandomState(2).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    P = points(surface)
    energies, _ = cell_energies(P, P @ turn.T + 3.0, terms(P, triangles(surface), kind))
    return energies.sum() / surface.GetLength() ** 2


def largest_rise_with_handle(surface):
    """The largest change of the energy of spokes, over the first, with one point pulled out."""
    P, F = points(surface), triangles(surface)
    held = np.array([P[:, 1].argmin(), P[:, 1].argmax()])
    pulled = P[held] + np.array([(0.0, 0.0, 0.0), (0.0, 0.3 * surface.GetLength(), 0.0)])
    energies, _ = rigid_deformation(P, terms(P, F, "spokes"), held, pulled, 20)
    return np.diff(energies[1:]).max() / energies[1]


def rim_counts(surface, border):
    """How often the cells hold one edge, of the border or not, ascending."""
    P, F = points(surface), triangles(surface)
    cell, u, v, _ = terms(P, F, "rims")
    starts, ends = half_edges(F)
    count = edge_sums(F, np.ones(F.shape))
    k = np.flatnonzero(count.ravel() == (1 if border else 2))[0]
    a, b = starts.ravel()[k], ends.ravel()[k]
    on = ((u == a) & (v == b)) | ((u == b) & (v == a))
    return sorted(np.unique(cell[on], return_counts=True)[1].tolist())


@experiment("A2.4", title="Cotangent weights", where="2.4, Eq. 2.4-2.5, Fig. 2.4",
            claim="The weight of an edge is half the sum of the cotangents opposite it. That keeps the "
                  "geometry better than uniform weights.")
def cotangents(section, context):
    triangle = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.5, np.sqrt(0.75), 0.0)])
    both = np.concatenate([triangle, [(0.5, -np.sqrt(0.75), 0.0)]])
    F = np.array([(0, 1, 2), (1, 0, 3)])
    weight = edge_sums(F, half_cotangents(both, F))[0, 2]
    section.check(abs(weight - 1.0 / np.sqrt(3.0)) < 1e-15, "Between two equilateral triangles the "
                  "weight is cot 60° = 0.57735", f"{weight:.5f}")
    surface = context.model("box", size=(1.0, 0.2, 1.0), divisions=(12, 2, 12))
    P, F = points(surface), triangles(surface)
    random, top = np.random.RandomState(24), np.isclose(P[:, 1], P[:, 1].max())
    inner = top & (np.abs(P[:, [0, 2]]).max(axis=1) < 0.49)
    P[inner] += random.uniform(-0.02, 0.02, P[inner].shape) * (1.0, 0.0, 1.0)
    u, v = half_edges(F)
    off = {}
    for name, w in (("cotangent", half_cotangents(P, F)), ("uniform", np.ones(F.shape))):
        flow = w.ravel() * (P[u.ravel(), 0] - P[v.ravel(), 0])
        laplacian = np.bincount(u.ravel(), flow, len(P)) - np.bincount(v.ravel(), flow, len(P))
        degree = np.bincount(u.ravel(), np.abs(w).ravel(), len(P))
        off[name] = np.abs(laplacian[inner] / degree[inner]).max() * 12.0
    section.table("Laplacian of a linear function", ["weights", "largest value / edge length"],
                  list(off.items()), "Of x on an uneven flat patch, where it should vanish")
    section.check(off["cotangent"] < 1e-6 < off["uniform"], "On an uneven flat patch the cotangent "
                  "Laplacian of x vanishes to 1e-6 and the uniform one does not",
                  f"{off['cotangent']:.2g} and {off['uniform']:.2g}")


@experiment("A2.5", "A2.6", title="Mapping of normals", where="2.2, Fig. 2.1-2.2",
            needs=("vtkNormalAnalogyFilter", "vtkGaussMapFilter"), claim={
                "A2.5": "Normal-driven analogies map each normal to the nearest normal of the style: "
                        "with a cube there are six clusters.",
                "A2.6": "That mapping cannot produce a sphere: its style allows every direction, so "
                        "every normal stays as it is."})
def mapping(section, context):
    surface = context.model("head")
    blocky = context.run("vtkNormalAnalogyFilter", surface, Style=1, Weight=10.0, OutputPointsPrecision=1)
    run = context.run("vtkGaussMapFilter", blocky.GetOutput(), SphereUnits=1)
    before = context.run("vtkGaussMapFilter", surface, SphereUnits=1)
    section.picture("Cube as the style", [(surface, "model"), (blocky.GetOutput(), "style cube")],
                    caption="vtkNormalAnalogyFilter, weight 10")
    section.picture("Gauss images", [(before.GetOutput(), "model"), (run.GetOutput(), "style cube")],
                    array="Density", range=(0.0, 8.0), caption="The normals of the triangles on the "
                    "unit sphere; 1 is the density of evenly spread ones, 8 stands for all above, too")
    targets = np.unique(np.round(array(blocky.GetOutput(), "TargetNormal"), 6), axis=0)
    section.check(len(targets) == 6, "The targets are six normals", str(len(targets)), "A2.5")
    F, Q = triangles(surface), points(blocky.GetOutput())
    n = np.cross(Q[F[:, 1]] - Q[F[:, 0]], Q[F[:, 2]] - Q[F[:, 0]])
    shares = [(np.abs(m / length(m)[:, None]).max(axis=1) > np.cos(np.radians(15.0))).mean()
              for m in (n, np.cross(points(surface)[F[:, 1]] - points(surface)[F[:, 0]],
                                    points(surface)[F[:, 2]] - points(surface)[F[:, 0]]))]
    section.check(shares[0] > 2.0 * shares[1], "More than twice as many triangles as in the model lie "
                  "within 15° of one of them", f"{shares[0]:.2f} and {shares[1]:.2f}", "A2.5")
    rows = []
    for level in context.choose((0, 1, 2), (0, 1, 2, 3, 4)):
        style = context.model("icosphere", level=level)
        result = context.run("vtkNormalAnalogyFilter", surface, {1: style}, Style=5, Weight=10.0,
                             OutputPointsPrecision=1).GetOutput()
        rows.append([style.GetNumberOfCells(),
                     length(points(result) - points(surface)).max() / surface.GetLength()])
    section.table("Balls as the style", ["faces of the style", "largest displacement / diagonal"], rows,
                  "Icosahedron and finer balls, weight 10")
    section.plot("Largest displacement", {"weight 10": tuple(zip(*rows))}, x="faces of the style",
                 y="largest displacement / diagonal", logx=True, logy=True)
    check_monotone(section, [row[1] for row in rows], "The finer the ball, the smaller the change",
                   row="A2.6")
    section.check(rows[-1][1] < 0.1 * rows[0][1], "The finest changes less than a tenth of the coarsest",
                  f"{rows[0][1]:.4f} to {rows[-1][1]:.4f}", "A2.6")


@experiment("A2.7", title="Other ways of style transfer", where="1.1.1, 1.1.2 and 2.1",
            claim="Skeleton-based, learned and local methods (GeoBrush, DECOR-GAN and others) are "
                  "surveyed.")
def survey(section, context):
    section.verdict(NOT_REPRODUCED, "A survey of the literature: the thesis runs none of these methods.")


@experiment("A2.8", title="Toy rounding", where="1.1.3", needs=METRICS,
            claim="The aim: rounder, curved looks, as toys have them, while the details stay.")
def toy(section, context):
    surface = context.model("creature")
    runs = {f"λ = {v:g}, DetailSize {size:g}": context.style(surface, Roundness=v, DetailSize=size)
            for v in (0.5, 2.0) for size in (0.0, 0.03)}
    before = context.metrics(surface)
    found = {label: context.metrics(run.GetOutput(), surface) for label, run in runs.items()}
    section.picture("Results", [(surface, "model")] + [
        (run.GetOutput(), label) for label, run in runs.items()])
    section.table("Measures", ["", "sphericity", "radius spread", "detail error", "roughness, °"], [
        ["model", before["Sphericity"], before["RadiusSpread"], None, before["RmsDihedral"]]] + [
        [label, m["Sphericity"], m["RadiusSpread"], m["DetailError"], m["RmsDihedral"]]
        for label, m in found.items()],
        "Sphericity is 1 for a ball; radius spread is the standard deviation of the distance from the "
        "center over its mean; detail error is 0, in diagonals, where details are only turned; "
        "roughness is the rms angle between neighboring triangles. The creature is smooth "
        "from the start; A5.11 has a car that is not")
    for v in (0.5, 2.0):
        plain, kept = (found[f"λ = {v:g}, DetailSize {size:g}"] for size in (0.0, 0.03))
        section.check(min(plain["Sphericity"], kept["Sphericity"]) > before["Sphericity"],
                      f"λ = {v:g}: sphericity rises", f"{before['Sphericity']:.3f} to "
                      f"{plain['Sphericity']:.3f}, with DetailSize to {kept['Sphericity']:.3f}")
        section.check(kept["DetailError"] < plain["DetailError"],
                      f"λ = {v:g}: with DetailSize 0.03 the detail error is lower than with 0",
                      f"{kept['DetailError']:.3g} and {plain['DetailError']:.3g}")


@experiment("A2.9", title="Connectivity stays", where="1.1.2.2 and 3.1",
            claim="The connectivity of the mesh never changes.")
def connectivity(section, context):
    names = [name for name in ("vtkSphericalStyleFilter", "vtkConvexProxyDeformFilter",
                               "vtkSphereProjectionFilter", "vtkNormalAnalogyFilter",
                               "vtkCubicStyleFilter") if context.has(name)]
    rows = []
    for model in ("icosahedron", "car"):
        surface = context.model(model)
        for name in names:
            result = context.run(name, surface).GetOutput()
            same = (np.array_equal(triangles(result), triangles(surface))
                    and result.GetNumberOfPoints() == surface.GetNumberOfPoints())
            rows.append([model, name, same, has_arrays_of(surface, result)])
    section.table("Cells and arrays", ["model", "filter", "same cells", "all arrays"], rows)
    section.check(all(row[2] for row in rows), "Cells are identical, number by number",
                  f"{len(rows)} results")
    section.check(all(row[3] for row in rows), "Every array of the input is there, with its values",
                  f"{len(rows)} results")


def has_arrays_of(surface, result):
    """Whether all named arrays of the first are in the second, number by number."""
    for data, copy in ((surface.GetPointData(), result.GetPointData()),
                       (surface.GetCellData(), result.GetCellData())):
        for k in range(data.GetNumberOfArrays()):
            kept = copy.GetArray(data.GetArrayName(k))
            if kept is None or not np.array_equal(vtk_to_numpy(kept), vtk_to_numpy(data.GetArray(k))):
                return False
    return True
