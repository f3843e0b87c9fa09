# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Chapter 2 and section 1.1: what the method is built on and compared with."""
import numpy as np

from common import METRICS, check_monotone
from measures import (cell_energies, edge_sums, half_cotangents, half_edges, length,
                      rigid_deformation, terms)
from report import NOT_REPRODUCED, experiment
from surfaces import array, points, triangles

KINDS = {"spokes": "spokes, full weights", "rims": "spokes and rims, full weights",
         "triangles": "spokes and rims, each triangle's own"}


@experiment("A2.1", "A2.2", "A2.3", title="Cells of the rigidity energy", where="2.3, Eq. 2.1-2.3, Fig. 2.3",
            claim={
                "A2.1": "The energy of a cell of spokes measures how far the edges at a point are from "
                        "a rotation of what they were.",
                "A2.2": "A cell of spokes and rims holds all edges of the triangles at a point: an "
                        "inner edge counts twice for each end and once for each opposite point.",
                "A2.3": "Spokes alone may lead to artefacts, as their energy can be indefinite."})
def cells(section, context):
    section.text("The energies are summed and lowered here with small dense matrices; the filter itself "
                 "has no cells of spokes alone.")
    surface = context.model("stone-house")
    P, F = points(surface), triangles(surface)
    ball = context.model("icosphere", level=2)
    rows, lowest, plotted = [], {}, {}
    top, bottom = P[:, 1] > 0.75 * P[:, 1].max(), P[:, 1] < 0.95 * P[:, 1].min()
    held = np.flatnonzero(top | bottom)
    pulled = P[held] + 0.3 * surface.GetLength() * top[held][:, None] * np.array([1.0, 0.0, 0.0])
    for kind, name in KINDS.items():
        term = terms(P, F, kind)
        energies = rigid_deformation(P, term, held, pulled, context.choose(10, 40))
        rows.append([name, rigid_energy(ball, kind), rigid_energy(surface, kind), energies.min()])
        lowest[kind], plotted[name] = energies[1:].min(), energies[1:]
    section.table("Energies", ["cells", "rigid motion of a ball", "rigid motion of the house",
                               "lowest energy"], rows,
                  "Energy over the squared diagonal of a rigid motion, each cell with its best "
                  "rotation; and the lowest energy of the stone house (half of its triangles are "
                  "obtuse) when its roof is pulled aside by 0.3 of the diagonal")
    section.plot("Energy", plotted, x="Iteration", y="Energy")
    section.check(abs(rows[0][1]) < 1e-20, "Spokes: a rigid motion of a ball, whose weights are "
                  "positive, has no energy (1e-20 of the squared diagonal)", f"{rows[0][1]:.2g}", "A2.1")
    counts = rim_counts(context)
    section.check(counts == [1, 1, 2, 2], "In spokes and rims an inner edge counts 2, 2 for its ends and "
                  "1, 1 for the points opposite", str(counts), "A2.2")
    section.check(lowest["spokes"] < 0.0 and rows[0][2] < 0.0, "On the house the energy of spokes "
                  "falls below 0, even without any deformation",
                  f"lowest {lowest['spokes']:.3g}, rigid {rows[0][2]:.2g}", "A2.3")
    section.check(lowest["triangles"] >= 0.0, "With each triangle's own cotangents it never does",
                  f"lowest {lowest['triangles']:.3g}; spokes and rims with full weights: "
                  f"{lowest['rims']:.3g}", "A2.3")


def rigid_energy(surface, kind):
    turn = np.linalg.qr(np.random.RandomState(2).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    P = points(surface)
    energies, _ = cell_energies(P, P @ turn.T + 3.0, terms(P, triangles(surface), kind))
    return energies.sum() / surface.GetLength() ** 2


def rim_counts(context):
    """How often the cells hold one inner edge, ascending."""
    surface = context.model("icosphere", level=1)
    P, F = points(surface), triangles(surface)
    cell, u, v, _ = terms(P, F, "rims")
    a, b = F[0, :2]
    on = ((u == a) & (v == b)) | ((u == b) & (v == a))
    return sorted(np.unique(cell[on], return_counts=True)[1].tolist())


@experiment("A2.4", title="Cotangent weights", where="2.4, Eq. 2.4-2.5",
            claim="The weight of an edge is half the sum of the cotangents opposite it; uniform weights "
                  "are simpler and worse.")
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
                  list(off.items()), "x on an uneven flat patch, where it should vanish")
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
    section.picture("Cube as the style", [(surface, "model"), (blocky.GetOutput(), "style cube")])
    section.picture("Gauss images", [(before.GetOutput(), "model"), (run.GetOutput(), "style cube")],
                    array="Density", range=(0.0, 8.0))
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
    section.table("Balls as the style", ["faces of the style", "largest displacement / diagonal"], rows)
    section.plot("Largest displacement", {"weight 10": tuple(zip(*rows))}, x="faces of the ball",
                 y="largest displacement / diagonal", logx=True, logy=True)
    check_monotone(section, [row[1] for row in rows], "The finer the ball, the smaller the change",
                   row="A2.6")
    section.check(rows[-1][1] < 0.1 * rows[0][1], "The finest changes less than a tenth of the coarsest",
                  f"{rows[0][1]:.4f} to {rows[-1][1]:.4f}", "A2.6")


@experiment("A2.7", title="Other ways of style transfer", where="1.1.1, 1.1.2 and 2.1",
            claim="Skeleton-based, learned and local methods (GeoBrush, DECOR-GAN and others) are "
                  "surveyed.")
def survey(section, context):
    section.verdict(NOT_REPRODUCED, "a survey of the literature; the thesis runs none of these methods")


@experiment("A2.8", title="Toy rounding", where="1.1.3", needs=METRICS,
            claim="The aim: rounder, smoother, curved looks while the details stay, as with toys.")
def toy(section, context):
    surface = context.model("creature")
    runs = {f"λ = {v:g}, DetailSize {size:g}": context.style(surface, Roundness=v, DetailSize=size)
            for v in (0.5, 2.0) for size in (0.0, 0.03)}
    before = context.metrics(surface)
    found = {label: context.metrics(run.GetOutput(), surface) for label, run in runs.items()}
    section.picture("Results", [(surface, "model")] + [
        (run.GetOutput(), label) for label, run in runs.items()])
    section.table("Measures", ["", "sphericity", "radius spread", "detail error"], [
        ["model", before["Sphericity"], before["RadiusSpread"], None]] + [
        [label, m["Sphericity"], m["RadiusSpread"], m["DetailError"]] for label, m in found.items()])
    for v in (0.5, 2.0):
        plain, kept = (found[f"λ = {v:g}, DetailSize {size:g}"] for size in (0.0, 0.03))
        section.check(min(plain["Sphericity"], kept["Sphericity"]) > before["Sphericity"],
                      f"λ = {v:g}: sphericity rises", f"{before['Sphericity']:.3f} to "
                      f"{plain['Sphericity']:.3f}, details kept {kept['Sphericity']:.3f}")
        section.check(kept["DetailError"] < plain["DetailError"],
                      f"λ = {v:g}: with details kept the detail error is lower than to the letter",
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
            rows.append([model, name, same, array_names(surface) <= array_names(result)])
    section.table("Cells and arrays", ["model", "filter", "same cells", "all arrays"], rows)
    section.check(all(row[2] for row in rows), "Cells are identical, number by number",
                  f"{len(rows)} results")
    section.check(all(row[3] for row in rows), "Every array of the input is there",
                  f"{len(rows)} results")


def array_names(surface):
    return {(of, data.GetArrayName(k))
            for of, data in (("points", surface.GetPointData()), ("cells", surface.GetCellData()))
            for k in range(data.GetNumberOfArrays())}
