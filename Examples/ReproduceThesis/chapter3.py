# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Chapter 3: the nonlinear spherical feature, vtkSphericalStyleFilter with Feature Nonlinear."""
import numpy as np

import models
from context import history
from measures import dot, length, rotations, scatter
from mesh_measures import (corner_table, crosses, diagonal, distance, edge_weights, laplacian,
                           rises,
                           similar)
from report import experiment
from sphericalstyle import vtkSphericalStyleFilter as Style
from surfaces import array, moved, points, triangles, with_array


def nonlinear(context, model, iterations=30, **properties):
    """Plain local and global steps, so many of them."""
    properties.setdefault("Roundness", 1.0)
    return context.style(model, Feature=Style.NONLINEAR, Acceleration=False,
                         StopRule=Style.FIXED_ITERATIONS, MaximumNumberOfIterations=iterations,
                         GenerateRotation=True, GenerateAuxiliaryScale=True, **properties)


def as_written(context, model, iterations=30, **properties):
    """The same with Eq. 3.12 and 3.26 - 3.42 to the letter."""
    return nonlinear(context, model, iterations, CenterConstraint=Style.AS_WRITTEN, **properties)


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
                 y="over the energy at the start")


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

    def turn(self, p, s):
        """Eq. 3.7 - 3.9."""
        rigid = self.w[:, None, None] * self.e[:, :, None] * (p[self.i] - p[self.j])[:, None, :]
        aimed = s[self.ring_j, None] * p[self.ring_j]
        spherical = self.n[self.ring_j][:, :, None] * aimed[:, None, :]
        return rotations(scatter(self.i, rigid, len(p)) +
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
    """The model with unit point normals of our own, and these."""
    x, F = points(model), triangles(model)
    n = scatter(F.T.ravel(), np.tile(crosses(x, F), (3, 1)), len(x))
    n /= length(n)[:, None]
    return with_array(model, "N", n), n


NORMALS = {0: (0, "N")}


@experiment("A3.1", "A3.2", "A3.3", "A3.4", "A3.5", title="Energy and steps, by hand",
            where="3.2-3.4, Eq. 3.1-3.25", claim={
                "A3.1": "Energy: ARAP of spokes plus λ |R_i n_j - (p'_j - o) / |p'_j - o||².",
                "A3.2": "An auxiliary s_j takes the place of 1 / |p'_j - o|.",
                "A3.3": "The local step takes R_i from the singular value decomposition of S_i.",
                "A3.4": "s_j has a closed form, a ratio of sums.",
                "A3.5": "The global step is a linear system for p'."})
def by_hand(section, context):
    rows = []
    ratios = {}
    for name in ("go-stone", "stone-house"):
        model, n = with_normals(context.model(name))
        before, after = (nonlinear(context, model, k, arrays=NORMALS) for k in (4, 5))
        center = np.array(after.GetEffectiveCenter())
        p, q = (points(run.GetOutput()) - center for run in (before, after))
        s_before, s = (array(run.GetOutput(), "AuxiliaryScale") for run in (before, after))
        R = array(after.GetOutput(), "Rotation").reshape(-1, 3, 3)
        hand = ByHand(points(model) - center, triangles(model), n, after.GetEffectiveRadius() ** 2)
        own_R = hand.turn(p, s_before)
        scale = diagonal(q)
        rows.append((name, abs(hand.energy(q, R, s) / after.GetFinalEnergy() - 1.0),
                     np.abs(own_R - R).max(), np.abs(np.linalg.det(R) - 1.0).max(),
                     np.abs(hand.scales(p, R) / s - 1.0).max(),
                     np.abs(hand.solve(R, s) - q).max() / scale))
        ratios[name] = s * length(q)
    section.table("Fifth iteration", [
        "model", "energy, relative difference", "R, largest difference", "|det R - 1|",
        "s, relative difference", "p', difference over the diagonal"], rows,
        caption="The filter against the formulas in numpy, λ = 1")
    worst = [max(row[k] for row in rows) for k in range(1, 6)]
    section.check(worst[0] < 1e-9, "the filter's energy is Eq. 3.2 summed by hand, to 1e-9",
                  f"{worst[0]:.0e}", "A3.1")
    section.check(worst[1] < 1e-9 and worst[2] < 1e-12, "rotations are those of Eq. 3.7-3.9, to"
                  " 1e-9, with determinant 1", f"{worst[1]:.0e}", "A3.3")
    section.check(worst[3] < 1e-9, "s_j is the minimum for each point, to 1e-9 (Eq. 3.12 as it is"
                  " meant; A8.4 has what it says)", f"{worst[3]:.0e}", "A3.4")
    section.check(worst[4] < 1e-9, "points solve Eq. 3.17 with o = 0, to 1e-9 diagonals",
                  f"{worst[4]:.0e}",
                  "A3.5")
    quantiles = [(name, *np.quantile(r, (0.0, 0.05, 0.5, 0.95, 1.0))) for name, r in ratios.items()]
    section.table("s |p' - o|", ["model", "least", "5 %", "median", "95 %", "largest"], quantiles,
                  caption="1 where s is the reciprocal of the distance")
    section.check(all(row[3] > 0.9 for row in quantiles),
                  "s |p' - o| is above 0.9 for half of the points: s stands for the reciprocal"
                  " there", ", ".join(f"{row[0]}: {row[3]:.2f}" for row in quantiles),
                  "A3.2")
    section.check(all(row[1] > 0.9 for row in quantiles), "it is above 0.9 everywhere",
                  ", ".join(f"{row[0]}: {row[1]:.2f}"
                            for row in quantiles) + "; where normals point across, s gives way",
                  "A3.2")


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


@experiment("A3.10", "A3.12", "A3.15", title="Go stone", where="3.6, Fig. 3.1-3.3", claim={
    "A3.10": "386 points, λ = 1: the energy is reduced, and the middle of top and bottom becomes a"
    " little concave.",
    "A3.12": "Energies per iteration, and their change by the global step, which is below 0.",
    "A3.15": "The radius is not constrained. Where the normal is parallel to p' - o, the surface"
    " may become concave."})
def go_stone(section, context):
    stone = context.model("go-stone")
    runs = {"as written": as_written(context, stone), "corrected": nonlinear(context, stone)}
    long_run = nonlinear(context, stone, 400)
    section.picture("Go stone", [
        [(model, label, None, view) for label, model in (
            ("model", stone), *((f"{label}, 30 iterations", run.GetOutput()) for label,
                                run in runs.items()))]
        for view in (25.0, 90.0)], caption="λ = 1, from the front and from the side")
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
                      f"{iterations} of 30 do",
                      "A3.10")
        section.check(steps == 0, f"{label}: the change by the global step is never above 0",
                      f"{steps} of 30 are", "A3.12")
    sums = np.abs(np.diff(table["Total"]) - table["LocalChange"][1:] - table["GlobalChange"][1:])
    section.check(sums.max() < 1e-9 * table["Total"][0],
                  "total = previous total + both changes, to 1e-9",
                  row="A3.12")
    depths = {"model": pole_depths(stone),
              "as written, 30": pole_depths(runs["as written"].GetOutput()),
              "corrected, 30": pole_depths(runs["corrected"].GetOutput()),
              "corrected, 400": pole_depths(long_run.GetOutput())}
    section.table("Poles", ["iterations", "depth of one pole, % of the diagonal", "of the other"],
                  [(label, *(100.0 * d for d in both)) for label, both in depths.items()],
                  caption="Below the ring of points around it; above 0 is concave")
    for row in ("A3.10", "A3.15"):
        for label in ("as written, 30", "corrected, 30"):
            section.check(min(depths[label]) > 0.0, f"{label} iterations: both poles are concave",
                          f"{100.0 * min(depths[label]):.2f} % of the diagonal", row)
    sizes = {roundness: length(points(nonlinear(context, stone,
                                                Roundness=roundness).GetOutput())).mean()
             for roundness in (0.1, 1.0, 5.0)}
    spread = max(sizes.values()) / min(sizes.values())
    section.check(spread > 1.05, "the mean distance from o changes by more than a twentieth with λ:"
                  " nothing holds the radius", ", ".join(f"λ {k:g}: {v:.3f}" for k,
                                                         v in sizes.items()), "A3.15")
    least = min(array(run.GetOutput(), "AuxiliaryScale").min() for run in runs.values())
    section.text(f"The smallest s of these runs is {least:.3f}; the corrected form keeps s at 0 or"
                 " above.")


@experiment("A3.11", title="A larger λ changes only the size", where="3.6.1",
            claim="With a larger λ the go stone is bigger and of almost the same shape.")
def larger_lambda(section, context):
    stone = context.model("go-stone")
    values = (1.0, 2.0, 5.0, 20.0)
    runs = [context.style(stone, Feature=Style.NONLINEAR, Roundness=value, StopRule=Style.THESIS,
                          Acceleration=False) for value in values]
    results = [run.GetOutput() for run in runs]
    base = points(results[0])
    rows = []
    for value, run, model in zip(values, runs, results):
        away, factor = similar(base, points(model))
        rows.append((value, run.GetNumberOfIterations(), 1.0 / factor, away,
                     distance(base, points(model))))
    section.picture("Go stone", [(model, f"λ = {value:g}") for value,
                                 model in zip(values, results)], view=90.0)
    section.table("Against λ = 1", ["λ", "iterations", "size, times",
                                    "difference of shape, diagonals",
                                    "difference with its size, diagonals"], rows,
                  caption="Rms, after the best move and turn, and the best scale for the shape;"
                  " until res < 0.001")
    changed = similar(points(stone), base)[0]
    section.check(rows[-1][2] > 1.0, "λ = 20 is larger than λ = 1", f"×{rows[-1][2]:.2f}")
    section.check(rows[-1][3] < 0.25 * changed, "between λ = 1 and 20 the shape changes by less"
                  " than a quarter of what λ = 1 does to the model",
                  f"{rows[-1][3]:.4f} against {changed:.4f} diagonals")


# ------------------------------------------------------------------------ stone house, Fig. 3.4-3.5
@experiment("A3.6", "A3.13", title="Stone house", where="3.4.2, 3.6, Fig. 3.4-3.5", claim={
    "A3.6": "The center is the mean of the unknowns; the last point is eliminated by that and its"
    " row is dropped.",
    "A3.13": "On a simplified stone house the energy rises, in whole iterations and by the global"
    " step: no convergence can be guaranteed."})
def stone_house(section, context):
    house = context.model("stone-house")
    section.text("The thesis does not say which λ this was, nor what size counts as one; λ means"
                 " the more the smaller that is. So here are several, for r = 1.")
    rows, shown = [], {}
    for value in (0.05, 0.1, 1.0, 5.0):
        for label, method in (("as written", as_written), ("corrected", nonlinear)):
            run = method(context, house, Roundness=value)
            if value in (0.05, 1.0):
                shown[f"{label}, λ = {value:g}"] = run
            total = history(run)["Total"]
            rows.append((label, value, *count_rises(run), total.min() / total[0],
                         total[-1] / total[0]))
    section.picture("Stone house", [(house, "model"), *((run.GetOutput(), label)
                                                        for label, run in shown.items())],
                    caption="30 iterations")
    energy_plots(section, "Energy at λ = 0.05", {label: run for label, run in shown.items()
                                                 if label.endswith("0.05")}, first=3)
    section.table("As written and corrected", ["form", "λ", "global steps of 30 that raise E",
                                               "iterations that do",
                                               "least E / at the start",
                                               "E at last / at the start"], rows)
    first = shown["as written, λ = 0.05"]
    mean = points(first.GetOutput()).mean(axis=0) - np.array(first.GetEffectiveCenter())
    off = length(mean) / diagonal(points(house))
    section.check(off < 1e-9, "as written, the mean of the points stays at the center, to 1e-9"
                  " diagonals",
                  f"{off:.0e}", "A3.6")
    written = [row for row in rows if row[0] == "as written"]
    found = ", ".join(f"λ {row[1]:g}: {{}}" for row in written)
    steps, iterations = (found.format(*(row[k] for row in written)) + " of 30" for k in (2, 3))
    section.check(all(row[2] == 0 for row in written), "as written, the global step gives the least"
                  " energy and so never raises it", steps, "A3.6")
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
    section.check(raised > 0, "with the center fixed and no row dropped, steps still raise the"
                  " energy: it is the nonlinear feature that fails",
                  f"{raised or 'none'} in {len(rows)} runs, λ 0.1 to 5", "A3.13")


# ----------------------------------------------------------------------------------- cost and scale
@experiment("A3.7", "A3.14", title="Time per iteration", where="3.4.2, 3.6.2 (1)", claim={
    "A3.7": "The matrix changes with s, is factored in every iteration, and this makes it very"
    " slow.",
    "A3.14": "Above 1000 points it takes too much time."})
def cost(section, context):
    levels = context.choose((2, 3), (2, 3, 4, 5))
    rows, curves = [], {"linear": [], "nonlinear, corrected": [], "nonlinear, as written": []}

    def seconds(**properties):
        """Per iteration, best of three: steps, and the factorisation where each needs its own."""
        best = np.inf
        for _ in range(3):
            style = context.style(MaximumNumberOfIterations=10, **properties)
            stages = style.GetOutputDataObject(1).GetFieldData().GetArray("StageSeconds")
            spent = {stages.GetComponentName(k): stages.GetComponent(0, k)
                     for k in range(stages.GetNumberOfComponents())}
            own = spent["Factor"] if style.GetFeature() == Style.NONLINEAR else 0.0
            best = min(best, (spent["Iterate"] + own) / 10.0)
        return best

    for level in levels:
        ball = models.SHAPES["icosphere"](level=level)
        model = moved(ball, points(ball) * (1.0, 0.45, 1.0))
        n = model.GetNumberOfPoints()
        fixed = {"surface": model, "StopRule": Style.FIXED_ITERATIONS, "Acceleration": False,
                 "InitialGuess": Style.REST, "Roundness": 1.0}
        measured = {"linear": seconds(**fixed),
                    "nonlinear, corrected": seconds(Feature=Style.NONLINEAR, **fixed)}
        if n < 3000:
            measured["nonlinear, as written"] = seconds(
                Feature=Style.NONLINEAR, CenterConstraint=Style.AS_WRITTEN, **fixed)
        for label, value in measured.items():
            curves[label].append((n, value))
        rows.append((n, *(1000.0 * measured[label] if label in measured else None
                          for label in curves)))
    section.plot("Time", {label: tuple(zip(*line)) for label, line in curves.items()}, x="points",
                 y="seconds per iteration", logx=True, logy=True)
    section.table("Time per iteration", ["points", "linear, ms", "corrected, ms", "as written, ms"],
                  rows,
                  caption="Ellipsoids")
    n, linear, corrected, _ = rows[-1]
    section.check(corrected > linear, "an iteration takes longer than one of the linear feature",
                  f"{corrected / linear:.1f} times, {n} points", "A3.7")
    large = rows[-1]
    section.check(large[2] > 1000.0, "above 1000 points an iteration takes more than a second",
                  f"{large[2]:.0f} ms with {large[0]} points: the matrix is sparse, symmetric and"
                  " changes on its diagonal only", "A3.14")
    both = [(row[0], row[3] / row[2]) for row in rows if row[3] is not None]
    section.check(both[-1][1] > 2.0, "as written it takes more than twice as long as corrected, and"
                  " the more the more points", ", ".join(f"{n} points: ×{ratio:.1f}" for n,
                                                         ratio in both), "A3.14")


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
        stopped = context.style(model, Feature=Style.NONLINEAR, Roundness=1.0,
                                StopRule=Style.THESIS,
                                Acceleration=False)
        limit = nonlinear(context, model, context.choose(200, 1000))
        count = stopped.GetNumberOfIterations()
        off = length(points(stopped.GetOutput()) - points(limit.GetOutput())).max()
        rows.append((name, residual, abs(table[5] / residual - 1.0), count,
                     history(stopped)["Residual"][-1],
                     100.0 * off / length(points(limit.GetOutput()) - x).max()))
    section.table("Stop rule", ["model", "res of iteration 5, by hand", "relative difference",
                                "iterations until res < 0.001", "res then",
                                "of the largest displacement missing, %"], rows)
    section.check(all(row[2] < 1e-6 for row in rows), "the filter's Residual is Eq. 3.46, to 1e-6")
    section.check(all(row[4] < 1e-3 for row in rows), "the rule is met",
                  ", ".join(f"{row[0]}: after {row[3]}" for row in rows))
    section.check(all(row[5] < 3.2 for row in rows), "less than 3.2 % of the largest displacement"
                  " is missing then", ", ".join(f"{row[0]}: {row[5]:.1f} %"
                                                for row in rows) + "; see A8.1")


@experiment("A3.9", title="Unit size", where="3.4.2, 3.6.2 (2)",
            claim="The model is scaled to unit size so that W_i and g_i are of one order.")
def unit_size(section, context):
    rows = []
    for name in ("go-stone", "stone-house"):
        model = context.model(name)
        base = points(nonlinear(context, model).GetOutput())
        for factor in (1e-3, 1e3):
            copy = moved(model, factor * points(model))
            q = points(nonlinear(context, copy).GetOutput()) / factor
            rows.append((name, factor, np.abs(q - base).max() / diagonal(base)))
    section.table("Copies", ["model", "size, times", "difference after rescaling, diagonals"], rows)
    worst = max(row[2] for row in rows)
    section.check(worst < 1e-9, "copies of 1/1000 and 1000 times the size give the same shape, to"
                  " 1e-9 diagonals",
                  f"{worst:.0e}")
