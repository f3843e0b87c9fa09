# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Chapter 3: the nonlinear spherical feature, vtkNonlinearStyleFilter."""
import numpy as np

import models
from context import history
from measures import dot, length, rotations, scatter
from mesh_measures import (corner_table, crosses, diagonal, distance, edge_weights, laplacian,
                           rises,
                           similar)
from report import experiment
from sphericalstyle import vtkNonlinearStyleFilter as Nonlinear
from surfaces import array, moved, points, triangles, with_array


def nonlinear(context, model, iterations=30, **properties):
    """Runs a given number of plain local and global steps."""
    properties.setdefault("Roundness", 1.0)
    return context.nonlinear(model, StopRule=Nonlinear.FIXED_ITERATIONS, MaximumNumberOfIterations=iterations,
                             GenerateRotation=True, GenerateAuxiliaryScale=True, **properties)


def as_written(context, model, iterations=30, **properties):
    """The same, with Eq. 3.12 and 3.26 - 3.42 exactly as printed."""
    return nonlinear(context, model, iterations, CenterConstraint=Nonlinear.AS_WRITTEN, **properties)


def energy_plots(section, name, runs, first=1):
    """Figures 3.3 and 3.5: energy per iteration, and its change by the global step, from iteration
    first on: what comes before is so much larger that it hides the rest."""
    totals, changes = {}, {}
    for label, run in runs.items():
        table = history(run)
        steps = np.arange(first, len(table["Total"]))
        totals[label] = (steps, table["Total"][first:] / table["Total"][0])
        changes[label] = (steps, table["GlobalChange"][first:] / table["Total"][0])
    section.plot(name, {"energy": totals, "change by the global step": changes}, x="Iteration",
                 y="over the energy at the start", caption=f"From iteration {first} on")


def count_rises(run):
    """(global steps, iterations) that raise the energy, beyond rounding."""
    table = history(run)
    start = table["Total"][0]
    return (rises(table["GlobalChange"][1:], start), rises(np.diff(table["Total"]), start))


# --------------------------------------------------------------------------- the formulas, in numpy
class ByHand:
    """Eq. 3.2 - 3.25 in numpy, o at the origin: spokes-only cells, full cotangent weights."""

    def __init__(self, x, F, n, weight):
        self.x, self.n, self.weight = x, n, weight  # weight: λ r², the unit of length of the filter
        edges, w = edge_weights(x, F)
        self.L = laplacian(len(x), edges, w)
        self.i, self.j = np.concatenate([edges, edges[:, ::-1]]).T  # j in N(i)
        self.w = np.concatenate([w, w])
        own = np.arange(len(x))
        self.ring_i, self.ring_j = np.append(self.i, own), np.append(self.j, own)  # and j = i
        self.e = x[self.i] - x[self.j]

    def pull(self, R):
        """R_i n_j of all pairs."""
        return np.einsum("hij,hj->hi", R[self.ring_i], self.n[self.ring_j])

    def energy(self, p, R, s):
        """Eq. 3.2."""
        rigid = p[self.i] - p[self.j] - np.einsum("hij,hj->hi", R[self.i], self.e)
        spherical = self.pull(R) - s[self.ring_j, None] * p[self.ring_j]
        return (self.w * dot(rigid, rigid)).sum() + self.weight * dot(spherical, spherical).sum()

    def covariances(self, p, s):
        """S_i of Eq. 3.7."""
        rigid = self.w[:, None, None] * self.e[:, :, None] * (p[self.i] - p[self.j])[:, None, :]
        aimed = s[self.ring_j, None] * p[self.ring_j]
        spherical = self.n[self.ring_j][:, :, None] * aimed[:, None, :]
        return (scatter(self.i, rigid, len(p)) +
                self.weight * scatter(self.ring_i, spherical, len(p)))

    def scales(self, p, R):
        """The minimum over each s_j of the total, which Eq. 3.12 means."""
        along = np.bincount(self.ring_j, dot(p[self.ring_j], self.pull(R)))
        return np.maximum(0.0, along / (np.bincount(self.ring_j) * dot(p, p)))

    def solve(self, R, s):
        """Eq. 3.17 with o = 0, no point eliminated."""
        edge = self.w[:, None] * np.einsum("hij,hj->hi", R[self.i] + R[self.j], self.e)
        b = scatter(self.i, edge, len(s))
        b += self.weight * s[:, None] * scatter(self.ring_j, self.pull(R), len(s))
        A = 2.0 * self.L + self.weight * np.diag(np.bincount(self.ring_j) * s ** 2)
        return np.linalg.solve(A, b)


def with_normals(model):
    """The model with our own unit point normals, and these normals."""
    x, F = points(model), triangles(model)
    n = scatter(F.T.ravel(), np.tile(crosses(x, F), (3, 1)), len(x))
    n /= length(n)[:, None]
    return with_array(model, "N", n), n


NORMALS = {0: (0, "N")}


def slope(energy, before, after, random):
    """The largest slope of the energy at after, over the mean one at before, in random directions."""
    found = []
    for _ in range(8):
        step = 1e-3 * np.abs(before).mean() * random.normal(size=before.shape)
        found.append([abs(energy(x + step) - energy(x - step)) for x in (before, after)])
    at_before, at_after = np.transpose(found)
    return at_after.max() / at_before.mean()


@experiment("A3.1", "A3.2", "A3.3", "A3.4", "A3.5", title="Energy and steps, by hand",
            where="3.2-3.4, Eq. 3.1-3.25", claim={
                "A3.1": "The energy is that of as-rigid-as-possible cells of spokes, plus λ times the sum"
                " over the points j of each cell of |R_i n_j - (p'_j - o) / |p'_j - o||².",
                "A3.2": "An auxiliary s_j takes the place of 1 / |p'_j - o|.",
                "A3.3": "The local step takes R_i from the singular value decomposition of S_i.",
                "A3.4": "s_j has a closed form, a ratio of sums.",
                "A3.5": "The global step is a linear system for p'."})
def by_hand(section, context):
    rows = []
    ratios = {}
    random = np.random.RandomState(33)
    for name in ("go-stone", "stone-house"):
        model, n = with_normals(context.model(name))
        before, after = (nonlinear(context, model, k, arrays=NORMALS) for k in (4, 5))
        center = np.array(after.GetEffectiveCenter())
        p, q = (points(run.GetOutput()) - center for run in (before, after))
        s_before, s = (array(run.GetOutput(), "AuxiliaryScale") for run in (before, after))
        R = array(after.GetOutput(), "Rotation").reshape(-1, 3, 3)
        hand = ByHand(points(model) - center, triangles(model), n, after.GetEffectiveRadius() ** 2)
        S = hand.covariances(p, s_before)
        others = rotations(random.normal(size=(200, 3, 3)))
        better = np.einsum("nij,nji->n", R, S) - np.einsum("kij,nji->kn", others, S).max(axis=0)
        rest, still = hand.x, np.broadcast_to(np.eye(3), R.shape)
        first = hand.energy(rest, still, 1.0 / length(rest))
        rows.append((name, abs(first / history(after)["Total"][0] - 1.0),
                     abs(hand.energy(q, R, s) / after.GetFinalEnergy() - 1.0),
                     np.abs(rotations(S) - R).max(), np.abs(np.linalg.det(R) - 1.0).max(),
                     better.min() / length(S.reshape(-1, 9)).mean(),
                     np.abs(hand.scales(p, R) / s - 1.0).max(),
                     slope(lambda v: hand.energy(p, R, v), s_before, s, random),
                     np.abs(hand.solve(R, s) - q).max() / diagonal(q),
                     slope(lambda v: hand.energy(v, R, s), p, q, random)))
        ratios[name] = s * length(q)
    names = ["model", "energy at the start", "energy", "R", "|det R - 1|", "margin of R", "s",
             "slope in s", "p'", "slope in p'"]
    section.table("Fifth iteration", names, rows,
                  caption="The filter against the formulas in numpy, λ = 1: largest differences,"
                  " relative or in diagonals. Margin: by how much tr(R S) is above that of 200 random"
                  " rotations, over |S|. Slope: of the energy along random directions, over its slope"
                  " before the step")
    worst = {name: max(row[k] for row in rows) for k, name in enumerate(names) if k}
    section.check(worst["energy at the start"] < 1e-9, "the filter's energy of the model is Eq. 3.1"
                  " summed by hand, to 1e-9", f"{worst['energy at the start']:.0e}", "A3.1")
    section.check(worst["energy"] < 1e-9, "its energy after five iterations is Eq. 3.2 summed by"
                  " hand, to 1e-9", f"{worst['energy']:.0e}", "A3.1")
    section.check(worst["R"] < 1e-9 and worst["|det R - 1|"] < 1e-12, "rotations are those of"
                  " Eq. 3.7-3.9, to 1e-9, with determinant 1, to 1e-12",
                  f"{worst['R']:.0e} and {worst['|det R - 1|']:.0e}", "A3.3")
    margin, off_points = min(row[5] for row in rows), worst["p'"]
    section.check(margin >= 0.0, "no random rotation gives a larger tr(R S)",
                  f"{200 * sum(len(s) for s in ratios.values())} tries, least margin {margin:.2g}",
                  "A3.3")
    section.check(worst["s"] < 1e-9, "s_j is the minimum for each point, to 1e-9 (Eq. 3.12 as it is"
                  " meant; A8.4 has what it says)", f"{worst['s']:.0e}", "A3.4")
    section.check(worst["p'"] < 1e-9, "points solve Eq. 3.17 with o = 0, to 1e-9 diagonals",
                  f"{off_points:.0e}", "A3.5")
    for row, name in (("A3.4", "slope in s"), ("A3.5", "slope in p'")):
        section.check(worst[name] < 1e-6, f"the {name} of the energy, by finite differences, is 0 then,"
                      " to 1e-6 of what it was", f"{worst[name]:.0e}", row)
    quantiles = [(name, *np.quantile(r, (0.0, 0.05, 0.5, 0.95, 1.0))) for name, r in ratios.items()]
    section.table("s |p' - o|", ["model", "least", "5 %", "median", "95 %", "largest"], quantiles,
                  caption="1 where s is the reciprocal of the distance")
    section.check(all(abs(row[3] - 1.0) < 0.1 for row in quantiles), "the median of s |p' - o| is 1,"
                  " to a tenth", ", ".join(f"{row[0]}: {row[3]:.2f}" for row in quantiles), "A3.2")
    section.check(all(abs(row[k] - 1.0) < 0.1 for row in quantiles for k in (1, 5)),
                  "s |p' - o| is 1 for every point, to a tenth",
                  ", ".join(f"{row[0]}: {row[1]:.2f} to {row[5]:.2f}" for row in quantiles)
                  + "; s is smaller where turned normals point across p' - o", "A3.2")


# --------------------------------------------------------------------------- go stone, Fig. 3.1-3.3
def pole_depths(model):
    """How deep the two poles of the go stone, which lies flat in z, lie below the rings around
    them; over the diagonal, above 0 is concave."""
    x = points(model)
    far = np.argsort(np.abs(points(models.data.MakeGoStone())[:, 2]))[-2:]
    corners, _ = corner_table(triangles(model))
    depths = []
    for pole in far:
        ring = np.unique(corners[corners[:, 0] == pole, 1])
        up = np.sign(x[pole, 2] - x[:, 2].mean())
        depths.append(up * (x[ring, 2].mean() - x[pole, 2]) / diagonal(x))
    return depths


def profile(stone, model):
    """(x, z) of the points in the plane y = 0 of the stone, once around, from the mean."""
    rest, x = points(stone), points(model)
    ring = np.flatnonzero(np.abs(rest[:, 1]) < 1e-6)
    ring = ring[np.argsort(np.arctan2(rest[ring, 2], rest[ring, 0]))]
    return tuple((x[np.append(ring, ring[0])] - x.mean(axis=0))[:, [0, 2]].T)


@experiment("A3.10", "A3.12", "A3.15", title="Go stone", where="3.6.1, 3.6.2 (3), Fig. 3.1-3.3", claim={
    "A3.10": "386 points, λ = 1: the energy is reduced, and the middle of top and bottom becomes a"
    " little concave.",
    "A3.12": "Recorded are the energy after each iteration and its change by the global step, which is"
    " below 0.",
    "A3.15": "The radius is not constrained: points whose normal is parallel to p' - o may become a"
    " little concave."})
def go_stone(section, context):
    stone = context.model("go-stone")
    runs = {"as written": as_written(context, stone), "corrected": nonlinear(context, stone)}
    long_run = nonlinear(context, stone, 400)
    section.picture("Go stone", [
        [(model, label, None, view) for label, model in (
            ("model", stone), *((f"{label}, 30 iterations", run.GetOutput()) for label,
                                run in runs.items()))]
        for view in (25.0, 90.0)], caption="λ = 1, from the front and from the side")
    section.plot("Profile", {label: profile(stone, model) for label, model in (
        ("model", stone), *((f"{label}, 30 iterations", run.GetOutput()) for label, run in
                            runs.items()))}, x="x", y="z",
                 equal=True,
                 caption="Points in the plane y = 0 of the model; the axis of the stone is z")
    energy_plots(section, "Energy", runs)
    table = history(runs["corrected"])
    section.table("History", ["iteration", "total", "rigid", "spherical",
                              "change by the local step",
                              "change by the global step"],
                  [(k, *(table[c][k] if k or "Change" not in c else None for c in
                         ("Total", "Rigid", "Spherical", "LocalChange", "GlobalChange")))
                   for k in (0, 1, 2, 5, 10, 20, 30)], caption="Corrected, λ = 1")
    for label, run in runs.items():
        steps, iterations = count_rises(run)
        section.check(iterations == 0, f"{label}: no iteration raises the energy",
                      f"{iterations} of 30 do; earlier measurement: none", "A3.10")
        section.check(steps == 0, f"{label}: the change by the global step is never above 0",
                      f"{steps} of 30 are", "A3.12")
    sums = np.abs(np.diff(table["Total"]) - table["LocalChange"][1:] - table["GlobalChange"][1:])
    section.check(sums.max() < 1e-9 * table["Total"][0], "total = previous total + both changes, to"
                  " 1e-9 of the first", f"{sums.max() / table['Total'][0]:.0e}", "A3.12")
    depths = {"model": pole_depths(stone),
              "as written, 30": pole_depths(runs["as written"].GetOutput()),
              "corrected, 30": pole_depths(runs["corrected"].GetOutput()),
              "corrected, 400": pole_depths(long_run.GetOutput())}
    section.table("Poles", ["iterations", "depth of one pole, % of the diagonal", "of the other"],
                  [(label, *(100.0 * d for d in both)) for label, both in depths.items()],
                  caption="Below the ring of points around it; above 0 is concave")
    hollow = {label: min(depths[label]) for label in ("as written, 30", "corrected, 30")}
    for label, depth in hollow.items():
        section.check(depth > 0.0, f"{label} iterations: both poles are concave",
                      f"{100.0 * depth:.2f} % of the diagonal", "A3.10")
    section.check(max(hollow.values()) > 0.0, "the poles, where n is parallel to p' - o, become concave"
                  " in one form at least", "see A3.10", "A3.15")
    sizes = {roundness: length(points(nonlinear(context, stone,
                                                Roundness=roundness).GetOutput())).mean()
             for roundness in (0.1, 1.0, 5.0)}
    spread = max(sizes.values()) / min(sizes.values())
    section.check(spread > 1.05, "the mean distance from o changes by more than a twentieth with λ:"
                  " nothing holds the radius", ", ".join(f"λ {k:g}: {v:.3f}" for k,
                                                         v in sizes.items())
                  + f"; r is {long_run.GetEffectiveRadius():.3f}", "A3.15")
    least = min(array(run.GetOutput(), "AuxiliaryScale").min() for run in runs.values())
    section.text(f"The smallest s of these runs is {least:.3f}; the corrected form keeps s at 0 or"
                 f" above. The concave poles are a stage on the way: after 400 iterations, corrected,"
                 f" {'none is' if max(depths['corrected, 400']) < 0.0 else 'some are'} left.")
    formed = [label for label, depth in hollow.items() if depth > 0.0]
    if len(formed) == 1:
        section.verdict(why="A3.10: the energy falls in both forms, but the poles are concave in one"
                        f" only, {formed[0]} iterations. The thesis does not say after how many"
                        " iterations Fig. 3.2 was taken.", row="A3.10")


@experiment("A3.11", title="A larger λ changes only the size", where="3.6.1",
            claim="With a larger λ the go stone is bigger and of almost the same shape.")
def larger_lambda(section, context):
    stone = context.model("go-stone")
    values = (1.0, 2.0, 5.0, 20.0)
    rows, panels, found = [], [], []
    for form, constraint in (("as written", Nonlinear.AS_WRITTEN), ("corrected", Nonlinear.CORRECTED)):
        runs = [context.nonlinear(stone, Roundness=value, CenterConstraint=constraint, StopRule=Nonlinear.THESIS)
                for value in values]
        base = points(runs[0].GetOutput())
        panels.append([(run.GetOutput(), f"{form}, λ = {value:g}") for value, run in zip(values, runs)])
        measured = []
        for value, run in zip(values, runs):
            x = points(run.GetOutput())
            away, factor = similar(base, x)
            extent = np.ptp(x, axis=0)
            same = run is runs[0]
            measured.append((form, value, run.GetNumberOfIterations(), 1.0 / factor,
                             extent[2] / extent[0], None if same else away,
                             None if same else distance(base, x)))
        rows += measured
        found.append((form, measured, similar(points(stone), base)[0]))
    section.picture("Go stone", panels, view=90.0, caption="From the side, when res < 0.001")
    section.table("Against λ = 1", ["form", "λ", "iterations", "size, times", "thickness / width",
                                    "difference of shape, diagonals",
                                    "difference with its size, diagonals"], rows,
                  caption="Rms distance after the best move and turn, and for the shape the best"
                  " scale, when res < 0.001")
    alike = []
    for form, measured, changed in found:
        section.check(measured[-1][3] > 1.0, f"{form}, λ = 20 is larger than λ = 1",
                      f"×{measured[-1][3]:.2f}")
        alike.append(section.check(
            measured[-1][5] < 0.25 * changed, f"{form}, between λ = 1 and 20 the shape changes by less"
            " than a quarter of what λ = 1 does to the model",
            f"{measured[-1][5]:.4f} against {changed:.4f} diagonals"))
    if not any(alike):
        thinner = " and ".join(f"{measured[0][4]:.2f} to {measured[-1][4]:.2f} {form}"
                               for form, measured, _ in found)
        section.verdict(why="The size grows with λ, but the shape changes, too: thickness over width"
                        f" from {thinner}.")


# ------------------------------------------------------------------------ stone house, Fig. 3.4-3.5
@experiment("A3.6", "A3.13", title="Stone house", where="3.4.2, 3.6, Fig. 3.4-3.5", claim={
    "A3.6": "The center is the mean of the unknowns; the last point is eliminated by that and its"
    " row is dropped.",
    "A3.13": "On a simplified stone house the energy rises, in whole iterations and by the global"
    " step: with the auxiliary s, which changes the matrix, no convergence can be guaranteed."})
def stone_house(section, context):
    house = context.model("stone-house")
    section.text("The thesis does not say which λ its figures have, nor what it scales to unit size;"
                 " the same λ weighs more on a smaller model. Here r, the radius of a ball of the"
                 " model's area, is 1, and λ has several values.")
    rows, shown = [], {}
    for value in (0.05, 0.1, 1.0, 5.0):
        for label, method in (("as written", as_written), ("corrected", nonlinear)):
            run = method(context, house, Roundness=value)
            shown[label, value] = run
            total = history(run)["Total"]
            rows.append((label, value, *count_rises(run), total.min() / total[0],
                         total[-1] / total[0]))
    section.picture("λ = 0.05", [(house, "model")] + [
        (shown[label, 0.05].GetOutput(), label) for label in ("as written", "corrected")],
                    caption="30 iterations")
    sizes = [diagonal(points(shown[label, 1.0].GetOutput())) / diagonal(points(house))
             for label in ("as written", "corrected")]
    section.picture("λ = 1", [(shown[label, 1.0].GetOutput(), label)
                              for label in ("as written", "corrected")],
                    caption="30 iterations, magnified: their diagonals are"
                    f" {sizes[0]:.2f} and {sizes[1]:.2f} of the model's")
    energy_plots(section, "Energy at λ = 0.05", {label: shown[label, 0.05] for label in (
        "as written", "corrected")}, first=3)
    section.table("As written and corrected", ["form", "λ", "global steps of 30 that raise E",
                                               "iterations that do",
                                               "least E / at the start",
                                               "E at last / at the start"], rows,
                  caption="An earlier measurement, on another house of 386 points: as written 20"
                  " global steps and 17 iterations of 30, corrected none")
    first = shown["as written", 0.05]
    mean = points(first.GetOutput()).mean(axis=0) - np.array(first.GetEffectiveCenter())
    off = length(mean) / diagonal(points(house))
    section.check(off < 1e-9, "as written, the mean of the points stays at the center, to 1e-9"
                  " diagonals",
                  f"{off:.0e}", "A3.6")
    written = [row for row in rows if row[0] == "as written"]
    found = ", ".join(f"λ {row[1]:g}: {{}}" for row in written)
    steps, iterations = (found.format(*(row[k] for row in written)) + " of 30" for k in (2, 3))
    if not section.check(all(row[2] == 0 for row in written), "as written, the global step gives the"
                         " least energy and so never raises it", steps, "A3.6"):
        section.verdict(why="A3.6: the mean is kept, but dropping the row of the last point leaves out"
                        " the multiplier of this constraint, so the energy is not the least: see A8.3.",
                        row="A3.6")
    section.check(any(row[3] > 0 for row in written), "as written, iterations raise the energy",
                  iterations, "A3.13")
    section.check(any(row[2] > 0 for row in written), "as written, global steps raise it", steps,
                  "A3.13")

    subjects = [(name, context.model(name)) for name in ("go-stone", "stone-house", "creature")]
    if not context.small:
        subjects += [(name, context.real(name)) for name in ("spot", "bunny") if context.real(name)]
    rows = []
    for name, model in subjects:
        for value in (0.1, 1.0, 5.0):
            run = nonlinear(context, model, context.choose(15, 30), Roundness=value)
            table = history(run)
            rows.append((name, len(points(model)), value, *count_rises(run),
                         table["Total"][-1] / table["Total"][0]))
    section.table("Corrected on other models", ["model", "points", "λ", "global steps that raise E",
                                                "iterations that do",
                                "E at last / at the start"], rows,
                  caption=f"{context.choose(15, 30)} iterations each")
    raised = sum(row[3] + row[4] for row in rows)
    if not section.check(raised > 0, "corrected, with the center fixed, no row dropped and an s of its"
                         " own for each point, steps still raise the energy: the cause is s",
                         f"{raised or 'none'} in {len(rows)} runs, λ 0.1 to 5", "A3.13"):
        section.verdict(why="A3.13: the energy rises as the thesis says, but for another reason:"
                        " the formulas for the center (A8.3) and for s (A8.4), not the auxiliary s as"
                        " such.", row="A3.13")


# ----------------------------------------------------------------------------------- cost and scale
@experiment("A3.7", "A3.14", title="Time per iteration", where="3.4.2, 3.6.2 (1)", claim={
    "A3.7": "The matrix changes with s, is factored in every iteration, and this makes it very"
    " slow.",
    "A3.14": "Above 1000 points it takes too much time."})
def cost(section, context):
    levels = context.choose((2, 3, 4), (2, 3, 4, 5))
    rows, curves = [], {"linear": [], "nonlinear, corrected": [], "nonlinear, as written": []}

    def seconds(execute, iterations=10, repeats=3, **properties):
        """Per iteration, the best: steps, and the factorization where each needs its own."""
        best = np.inf
        for _ in range(repeats):
            style = execute(MaximumNumberOfIterations=iterations, StopRule=Nonlinear.FIXED_ITERATIONS, Roundness=1.0,
                            **properties)
            stages = style.GetOutputDataObject(1).GetFieldData().GetArray("StageSeconds")
            spent = {stages.GetComponentName(k): stages.GetComponent(0, k)
                     for k in range(stages.GetNumberOfComponents())}
            own = spent["Factor"] if style.IsA("vtkNonlinearStyleFilter") else 0.0
            best = min(best, (spent["Iterate"] + own) / iterations)
        return best

    for level in levels:
        ball = models.SHAPES["icosphere"](level=level)
        model = moved(ball, points(ball) * (1.0, 0.45, 1.0))
        n = model.GetNumberOfPoints()
        measured = {"linear": seconds(context.style, surface=model, InitialGuess=1),  # from rest
                    "nonlinear, corrected": seconds(context.nonlinear, surface=model),
                    "nonlinear, as written": seconds(
                        context.nonlinear, *((10, 3) if n < 3000 else (3, 1)), surface=model,
                        CenterConstraint=Nonlinear.AS_WRITTEN)}
        for label, value in measured.items():
            curves[label].append((n, value))
        rows.append((n, *(1000.0 * measured[label] for label in curves)))
    section.plot("Time", {label: tuple(zip(*line)) for label, line in curves.items()}, x="points",
                 y="seconds per iteration", logx=True, logy=True)
    section.table("Time per iteration", ["points", "linear, ms", "corrected, ms", "as written, ms"],
                  rows,
                  caption="Ellipsoids. As written the matrix is not symmetric and has rows without a"
                  " zero; corrected it is symmetric, and only its diagonal changes")
    n, linear, corrected, written = rows[-1]
    section.check(written > 10.0 * linear, "as written, an iteration takes more than ten times one of"
                  " the linear feature", f"×{written / linear:.1f} with {n} points, corrected"
                  f" ×{corrected / linear:.1f}", "A3.7")
    large = [row for row in rows if row[0] > 1000]
    slow = section.check(all(row[3] > 1000.0 for row in large), "as written, above 1000 points an"
                         " iteration takes more than a second",
                         ", ".join(f"{row[0]} points: {row[3]:.0f} ms" for row in large), "A3.14")
    growth = [np.log(rows[-1][k] / rows[0][k]) / np.log(rows[-1][0] / rows[0][0]) for k in (1, 2, 3)]
    section.check(growth[2] > 1.2, "as written, the time grows faster than the number of points to"
                  " the power 1.2", f"{growth[2]:.2f}; corrected {growth[1]:.2f}, linear"
                  f" {growth[0]:.2f}", "A3.14")
    if not slow:
        section.verdict(why="A3.14: the time does grow out of proportion as written, but with the"
                        " solvers and machines of today it is not too much at 1000 points.",
                        row="A3.14")


@experiment("A3.8", title="When to stop", where="3.5, Eq. 3.43-3.48",
            claim="res = max |p'_k - p'_(k-1)|² / max |p'_k - p|² < 0.001 ends the iteration.")
def stop(section, context):
    rows = []
    for name in ("go-stone", "stone-house"):
        model = context.model(name)
        x = points(model)
        before, after = (points(nonlinear(context, model, k).GetOutput()) for k in (4, 5))
        residual = dot(after - before, after - before).max() / dot(after - x, after - x).max()
        table = history(nonlinear(context, model, 5))["Residual"]
        stopped = context.nonlinear(model, Roundness=1.0, StopRule=Nonlinear.THESIS)
        limit = nonlinear(context, model, context.choose(200, 1000))
        count = stopped.GetNumberOfIterations()
        off = length(points(stopped.GetOutput()) - points(limit.GetOutput())).max()
        rows.append((name, residual, abs(table[5] / residual - 1.0), count,
                     history(stopped)["Residual"][-1],
                     100.0 * off / length(points(limit.GetOutput()) - x).max()))
    section.table("Stop rule", ["model", "res of iteration 5, by hand", "relative difference",
                                "iterations until res < 0.001", "res then",
                                "of the largest displacement missing, %"], rows,
                  caption=f"λ = 1, corrected. Missing: largest distance from the points after"
                  f" {context.choose(200, 1000):,} iterations")
    section.check(all(row[2] < 1e-6 for row in rows), "the filter's Residual is Eq. 3.46, to 1e-6",
                  f"{max(row[2] for row in rows):.0e}")
    section.check(all(row[4] < 1e-3 for row in rows), "the rule is met",
                  ", ".join(f"{row[0]}: after {row[3]}" for row in rows))
    if not section.check(all(row[5] < 3.2 for row in rows), "less than 3.2 % (√0.001) of the largest"
                         " displacement is missing then", ", ".join(f"{row[0]}: {row[5]:.1f} %"
                                                                    for row in rows)):
        section.verdict(why="The rule can be applied, but the iteration is far from its end when it is"
                        " met: steps are small because convergence is slow. See A8.1.")


@experiment("A3.9", title="Unit size", where="3.4.2, 3.6.2 (2)",
            claim="The model is scaled to unit size so that W_i and g_i are of one order.")
def unit_size(section, context):
    rows, ratios = [], []
    for name in ("go-stone", "stone-house"):
        model = context.model(name)
        run = nonlinear(context, model)
        base = points(run.GetOutput())
        ends, w = edge_weights(points(model), triangles(model))
        W = np.bincount(ends.ravel(), np.repeat(w, 2))
        for when, s in (("at the start", 1.0 / length(points(model) - run.GetEffectiveCenter())),
                        ("after 30 iterations", array(run.GetOutput(), "AuxiliaryScale"))):
            g = 0.5 * (run.GetEffectiveRadius() * s) ** 2 * (np.bincount(ends.ravel()) + 1)
            ratios.append((name, when, *np.quantile(g / W, (0.05, 0.5, 0.95))))
        for factor in (1e-3, 1e3):
            copy = moved(model, factor * points(model))
            q = points(nonlinear(context, copy).GetOutput()) / factor
            rows.append((name, factor, np.abs(q - base).max() / diagonal(base)))
    section.table("Copies", ["model", "size, times", "difference after rescaling, diagonals"], rows)
    section.table("g_i / W_i", ["model", "", "5 %", "median", "95 %"], ratios, caption="Eq. 3.24 and"
                  " 3.25, λ = 1, r = 1. Without the scaling g_i would go with 1 / size², W_i not")
    worst = max(row[2] for row in rows)
    section.check(all(0.1 < row[3] < 10.0 for row in ratios), "the median of g_i / W_i is between 0.1"
                  " and 10", ", ".join(f"{row[0]} {row[1]}: {row[3]:.2f}" for row in ratios))
    section.check(worst < 1e-9, "copies of 1/1000 and 1000 times the size give the same shape, to"
                  " 1e-9 diagonals",
                  f"{worst:.0e}")
