# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Sections 4.2 to 4.4 and 4.8: feature, parameters, the two steps, convergence and stability."""
import time

import numpy as np

from common import METRICS, RISE, check_descent, check_monotone, energy_plot, largest_rise
from context import history
from measures import fit_sphere, length, style_energy
from mesh_measures import distance, rises
from report import experiment
from surfaces import array, moved, points, triangles, with_array


@experiment("A4.1", "A4.2", title="The spherical feature on a sphere", where="4.2, Eq. 4.1-4.5, Fig. 4.1",
            claim={"A4.1": "On a sphere p1 - p2 = r (n1 - n2) for the normals of any two points.",
                   "A4.2": "The same holds for the directions d from the center."})
def feature(section, context):
    surface = context.model("icosphere")
    P, radius = points(surface), 1.7
    P = radius * P + (0.3, -0.2, 0.5)
    d = (P - P.mean(axis=0)) / length(P - P.mean(axis=0))[:, None]
    normals = (P - (0.3, -0.2, 0.5)) / radius  # of the sphere itself
    random = np.random.RandomState(4)
    i, j = random.randint(0, len(P), (2, 2000))
    rows = []
    for row, name, t in (("A4.1", "normals n", normals), ("A4.2", "directions d", d)):
        off = length(P[i] - P[j] - radius * (t[i] - t[j])).max() / radius
        rows.append([name, off])
        section.check(off < 1e-12, f"{name}: largest deviation of 2,000 random pairs below 1e-12 r",
                      f"{off:.2g} r", row)
    section.table("Deviation from Eq. 4.1 and 4.5", ["target", "largest deviation / r"], rows)


@experiment("A4.3", title="Interpolated targets", where="4.2, Eq. 4.6-4.7",
            claim="t = (1 - a) d + a n, for a from 0 to 1.")
def targets(section, context):
    surface = context.model("bipyramid")
    # Normals that are unambiguous at corners and edges: the filter's own, at a = 1.
    get = {a: array(context.style(surface, NormalBlend=a, MaximumNumberOfIterations=0, StopRule=2
                                  ).GetOutput(), "TargetDirection").astype(float)
           for a in (0.0, 0.3, 0.5, 1.0)}
    P = points(surface)
    d = (P - P.mean(axis=0)) / length(P - P.mean(axis=0))[:, None]
    rows = []
    for a, t in get.items():
        rows.append([a, np.abs(t - (1.0 - a) * d - a * get[1.0]).max(), length(t).min()])
    section.table("Array TargetDirection against the formula",
                  ["a", "largest deviation", "shortest t"], rows)
    worst = max(row[1] for row in rows)
    section.check(worst < 1e-6, "TargetDirection is (1 - a) d + a n to 1e-6", f"{worst:.2g}")
    section.text("t is not unit for 0 < a < 1: where d and n disagree, the radius that it aims at is r "
                 "times the length of t.")


@experiment("A4.4", "A4.8", "A4.9", title="Energy, local step, global step",
            where="4.3-4.4, Eq. 4.8-4.27, Alg. 1", claim={
                "A4.4": "The energy is the rigidity of every cell plus λ times its distance from the "
                        "sphere's differences.",
                "A4.8": "The local step takes every cell's best rotation from an SVD, the sign of "
                        "the last column set right: the energy does not rise.",
                "A4.9": "The global step solves one linear system with coefficients w + λ and the "
                        "rotations (2R_i + 2R_j + R_m + R_n) / 6: the energy does not rise."})
def two_steps(section, context):
    rows, local, global_, off, risen = [], [], [], [], 0
    names = context.choose(["go-stone", "cube"], ["go-stone", "cube", "stone-house", "quadruped"])
    literal = dict(InitialGuess=1, Acceleration=False, EdgeWeighting=1, StopRule=2, Anchor=1,
                   MaximumNumberOfIterations=context.choose(10, 60))
    for name in names:
        surface = context.model(name)
        for a in (0.0, 1.0):
            style = context.style(surface, NormalBlend=a, GenerateRotation=True, **literal)
            q = style.GetOutput()
            table = history(style)
            energy = style_energy(
                points(surface), points(q), triangles(surface),
                array(q, "TargetDirection").astype(float),
                array(q, "Rotation").astype(float).reshape(-1, 3, 3), style.GetEffectiveRadius(), 0.5)
            off.append(abs(energy - table["Total"][-1]) / abs(table["Total"][0]))
            risen += rises(table["GlobalChange"][1:], table["Total"][0])
            local.append(largest_rise(style, "LocalChange"))
            global_.append(largest_rise(style))
            rows.append([name, a, table["Total"][0], table["Total"][-1], off[-1], local[-1],
                         global_[-1]])
    section.table("Energy, full edge weights, λ = 0.5", [
        "model", "a", "first energy", "last energy", "brute-force sum differs by",
        "largest local change", "largest global change"], rows,
        "Eq. 4.16 to the letter; the last three columns are relative to the first energy. A change "
        "above 0 would be a rise")
    section.check(max(off) < 1e-6, "Filter's energy equals Eq. 4.16 summed term by term, to 1e-6",
                  f"{max(off):.2g}", "A4.4")
    section.check(max(local) <= RISE, f"No local step raises the energy (by {RISE:g})",
                  f"largest change {max(local):.2g}", "A4.8")
    section.check(max(global_) <= RISE, f"No global step raises the energy (by {RISE:g})",
                  f"largest change {max(global_):.2g}: {risen} rises in {len(rows)} runs of "
                  f"{literal['MaximumNumberOfIterations']} iterations; earlier measurement: 0 in 8 cases",
                  "A4.9")


@experiment("A4.5", title="Roundness λ", where="4.2.1", needs=METRICS,
            claim="λ is above 0; the larger it is, the rounder the result, and 5 is very large.")
def roundness(section, context):
    surface = context.model("quadruped")
    values = [0.05, 0.1, 0.5, 1.0, 5.0, 10.0]
    runs = {value: context.style(surface, Roundness=value) for value in values}
    letter = {value: context.thesis(surface, Roundness=value) for value in values}
    found = {}
    for name, group in (("minimum", runs), ("to the letter", letter)):
        found[name] = [context.metrics(run.GetOutput())["Sphericity"] for run in group.values()]
        check_monotone(section, found[name], f"Sphericity rises with λ ({name})", falling=False)
    before = context.metrics(surface)["Sphericity"]
    more = (found["minimum"][5] - found["minimum"][4]) / (found["minimum"][4] - before)
    section.check(more < 0.1, "5 is very large: twice as much adds less than a tenth of what 5 gained",
                  f"{100 * more:.1f} %")
    section.table("Sphericity over roundness", ["λ", *found], list(zip(values, *found.values())),
                  f"Sphericity over λ; the model has {before:.3f}")
    section.plot("Sphericity", {name: (values, f) for name, f in found.items()}, x="λ",
                 y="Sphericity", logx=True)
    section.picture("Roundness", [(surface, "model")] + [
        (runs[value].GetOutput(), f"λ = {value:g}") for value in (0.1, 0.5, 1.0, 5.0)])


@experiment("A4.6", "A4.14", title="Sphere center", where="4.2.1", claim={
    "A4.6": "The center O is the mean of the points unless the user sets it.",
    "A4.14": "The nearer the surface is to O, the rounder it gets; with O outside the model the "
             "surface becomes concave."})
def center(section, context):
    surface = context.model("cube")
    P = points(surface)
    style = context.style(surface, Roundness=2.0)
    off = length(np.array(style.GetEffectiveCenter()) - P.mean(axis=0))
    section.check(off < 1e-9, "The center lies at the mean of the points, to 1e-9", f"{off:.2g}",
                  "A4.6")
    top, half = P[:, 1].max(), 0.5 * np.ptp(P[:, 1])
    on_top = np.flatnonzero(np.isclose(P[:, 1], top))
    away = np.abs(P[on_top][:, [0, 2]]).max(axis=1)
    middle, rim = on_top[away.argmin()], on_top[np.isclose(away, half)]
    rows, panels = [], [(surface, "model")]
    for height, earlier in ((0.0, 0.26), (0.3, None), (0.6, 0.54), (0.9, 0.77), (1.5, -0.49),
                            (3.0, -0.10)):
        run = context.style(surface, Roundness=2.0, CenterMode=2, Center=(0.0, height * half, 0.0))
        q = points(run.GetOutput())
        rows.append([height, (q[middle, 1] - q[rim, 1].mean()) / run.GetEffectiveRadius(), earlier])
        panels.append((run.GetOutput(), f"O at {height:g}"))
    section.table("Bulge of the top", ["height of O / half edge", "bulge / r",
                                         "earlier measurement"], rows,
                  "Height of the middle of the cube's top over its rim, λ = 2; the top is at 1")
    section.picture("Center moved up", panels)
    inside = [row[1] for row in rows if row[0] < 1.0]
    outside = [row[1] for row in rows if row[0] > 1.0]
    check_monotone(section, inside, "The top bulges more the nearer O comes from inside",
                   falling=False, row="A4.14")
    section.check(max(outside) < 0.0, "With O outside the facing side is concave",
                  ", ".join(f"{bulge:.3f}" for bulge in outside), "A4.14")


@experiment("A4.7", title="Sphere radius", where="4.2",
            claim="r = sqrt(A / 4π) of the model's area A is the radius that results.")
def radius(section, context):
    rows = []
    for name in ("go-stone", "cuboid", "cube"):
        surface = context.model(name)
        for value in (0.5, 5.0, 50.0):
            style = context.style(surface, Roundness=value)
            _, fitted, error = fit_sphere(points(style.GetOutput()))
            rows.append([name, value, fitted / style.GetEffectiveRadius(), error])
    section.table("Fitted radius", ["model", "λ", "fitted radius / r", "asphericity"], rows)
    found = [row[2] for row in rows if row[1] == 50.0]
    section.check(max(abs(ratio - 1.0) for ratio in found) < 0.005,
                  "At λ = 50 the fitted radius is r to 0.5 %",
                  ", ".join(f"{ratio:.4f}" for ratio in found) + "; earlier measurement: 1.000")


@experiment("A4.10", title="The fixed point", where="4.4, Eq. 4.28-4.33",
            claim="The system is singular; fixing any one point makes the solution unique.")
def anchor(section, context):
    surface = context.model("quadruped")
    for a in (0.0, 1.0):
        runs = [points(context.style(surface, NormalBlend=a, Anchor=way, StopRule=2,
                                     Acceleration=False, MaximumNumberOfIterations=20).GetOutput()) for way in (0, 1)]
        shift = (runs[1] - runs[0]).mean(axis=0)
        off = length(runs[1] - runs[0] - shift).max() / surface.GetLength()
        section.check(off < 1e-9, f"a = {a:g}: last point fixed and centroid fixed give one shape up "
                      "to a shift, to 1e-9 of the diagonal",
                      f"{off:.2g}; the shift is {length(shift) / surface.GetLength():.3f}")
    section.text("The thesis explains the singular matrix by rotations. Its null space is the "
                 "constant vectors, that is translations: one per connected part.")


@experiment("A4.11", title="One factorization", where="4.4, Eq. 4.34-4.38",
            claim="The matrix stays the same and is factored once; an iteration only substitutes.")
def factorization(section, context):
    surface = context.real("bunny") or context.model("creature")
    style = context.style(surface, Roundness=0.5)
    start = time.perf_counter()
    first = stages(style)
    style.SetCenterMode(2)
    style.SetCenter(*(np.array(style.GetEffectiveCenter()) + 0.1 * style.GetEffectiveRadius()))
    style.Update()
    again, seconds = stages(style), time.perf_counter() - start
    section.table("Milliseconds by stage", ["", *first, "sum"], [
        [label] + [1e3 * value for value in [*values.values(), sum(values.values())]]
        for label, values in (("first run", first), ("after the center was moved", again))],
        f"Milliseconds of one run each, {surface.GetNumberOfPoints():,} points; the second took "
        f"{1e3 * seconds:.0f} ms in all")
    section.check(first["Factor"] > 0.0 and again["Analyze"] + again["Factor"] == 0.0,
                  "A moved center neither analyzes nor factors the matrix again",
                  f"{1e3 * first['Factor']:.1f} ms at first, {1e3 * again['Factor']:.1f} ms after")


def stages(style):
    data = style.GetOutputDataObject(1).GetFieldData().GetArray("StageSeconds")
    return {data.GetComponentName(k): data.GetComponent(0, k)
            for k in range(data.GetNumberOfComponents())}


@experiment("A4.12", title="The stop rule", where="4.4 and 3.5, Eq. 3.43-3.48",
            claim="The iteration stops when the largest step is small beside the largest displacement.")
def stop_rule(section, context):
    rows, missing = [], []
    for name in context.choose(["go-stone"], ["go-stone", "icosahedron", "quadruped"]):
        surface = context.model(name)
        for value in (0.1, 0.5, 5.0):
            letter = context.thesis(surface, Roundness=value)
            far = context.style(surface, Roundness=value, EdgeWeighting=1, InitialGuess=1, Anchor=1,
                                Acceleration=False, Tolerance=1e-10, MaximumNumberOfIterations=4000)
            whole = length(points(far.GetOutput()) - points(surface)).max()
            short = length(points(letter.GetOutput()) - points(far.GetOutput())).max() / whole
            missing.append(short)
            residual = history(letter)["Residual"]
            rows.append([name, value, letter.GetNumberOfIterations(), residual[-1], short,
                         context.style(surface, Roundness=value).GetNumberOfIterations()])
            section.check(residual[-1] < 1e-3 <= residual[1:-1].min(initial=1.0),
                          f"{name}, λ = {value:g}: stops at the first residual below 0.001",
                          f"{residual[-1]:.2g} after {letter.GetNumberOfIterations()} iterations")
    section.table("Stop", ["model", "λ", "iterations", "residual", "missing", "iterations, minimum"],
                  rows, "Missing: largest distance to the fully converged result over its largest "
                        "displacement. The last column stops by the estimated energy gap, 1e-4")
    section.text(f"The rule compares squares: 0.001 is a step of 3.2 %. It leaves up to "
                 f"{100 * max(missing):.0f} % of the largest displacement undone.")


@experiment("A4.13", title="The start", where="4.8.1", needs=METRICS,
            claim="Several local minima may exist: the result depends on the start, λ and O.")
def start(section, context):
    surface = context.model("quadruped")
    rows, differences, gaps = [], [], []
    for a in (0.0, 1.0):
        runs = {name: context.style(surface, NormalBlend=a, InitialGuess=guess, Roundness=0.5,
                                    Tolerance=1e-10, MaximumNumberOfIterations=context.choose(300, 2000))
                for guess, name in ((1, "rest shape"), (0, "blend"))}
        differences.append(distance(*(points(run.GetOutput()) for run in runs.values())))
        energies = [run.GetFinalEnergy() for run in runs.values()]
        gaps.append(abs(energies[0] / energies[1] - 1.0))
        for name, run in runs.items():
            rows.append([a, name, f"{run.GetFinalEnergy():.7g}", run.GetNumberOfIterations(),
                         context.metrics(run.GetOutput())["Sphericity"], differences[-1]])
    section.table("Two starts", ["a", "start", "energy", "iterations", "sphericity",
                                 "distance of the results / diagonal"], rows,
                  "Distance: rms, after the best move and turn, which cost no energy; λ = 0.5")
    section.check(max(differences) > 1e-3, "Two starts give results that differ by more than 0.1 % "
                  "of the diagonal, for one a at least",
                  f"a = 0: {differences[0]:.2g}; a = 1: {differences[1]:.2g}")
    section.check(max(gaps) > 1e-4, "Their energies differ by more than 0.01 %: these are two minima, "
                  "not one approached slowly", f"a = 0: {gaps[0]:.2g}; a = 1: {gaps[1]:.2g}")


@experiment("A4.46", title="Cells may rise, the total falls", where="4.8.1, Fig. 4.38",
            claim="The total energy never rises, though that of some cells may.")
def cell_energies(section, context):
    surface = context.model("quadruped")
    literal = dict(NormalBlend=1.0, Roundness=0.5, InitialGuess=1, Acceleration=False, EdgeWeighting=1,
                   StopRule=2, GenerateCellEnergy=True)
    counts = range(1, context.choose(5, 9))
    runs = [context.style(surface, MaximumNumberOfIterations=count, **literal) for count in counts]
    energies = [array(run.GetOutput(), "CellEnergy").astype(float) for run in runs]
    rows = []
    for k in range(1, len(runs)):
        rise = energies[k] - energies[k - 1]
        rows.append([counts[k], energies[k].sum(), int((rise > RISE * energies[0].sum()).sum()),
                     rise.max(), rise.min()])
    section.table("Cells", ["iteration", "total", "cells that rise", "largest rise", "largest fall"],
                  rows)
    check_descent(section, runs)
    least = min(row[2] for row in rows)
    section.check(least > 0, "In every iteration some cells rise",
                  f"{least} to {max(row[2] for row in rows)} of {len(energies[0])} cells")
    rise = energies[-1] - energies[-2]
    last = with_array(runs[-1].GetOutput(), "Rise of the cell energy", rise)
    bound = float(np.quantile(np.abs(rise), 0.9))
    section.picture("Cells that rise and fall", [(surface, "model"), (last, "last iteration")],
                    array="Rise of the cell energy", range=(-bound, bound))
    energy_plot(section, "Energy", {"λ = 0.5, a = 1": runs[-1]})


def levels(context):
    return range(1, context.choose(4, 5))


@experiment("A4.47", title="Condition of the matrix", where="4.8.2, Eq. 4.40", needs=METRICS,
            claim="The condition number σmax / σmin grows about as the number of points.")
def condition(section, context):
    rows = []
    for level in levels(context):
        surface = context.model("icosphere", level=level)
        m = context.metrics(surface, EstimateCondition=True, Roundness=0.5)
        rows.append([surface.GetNumberOfPoints(), m["Condition"], m["PinnedCondition"],
                     {42: 102, 162: 519, 642: 2579}.get(surface.GetNumberOfPoints())])
    section.table("Condition number", ["points", "smallest non-zero", "one point fixed",
                                       "earlier measurement, one point fixed"], rows,
                  "Condition of the matrix on balls, λ = 0.5, by the smallest singular value that is "
                  "not zero, and of the matrix with one point fixed as the thesis solves it")
    both = np.array([row for row in rows if row[3] is not None], dtype=float)
    powers = [np.polyfit(np.log(both[:, 0]), np.log(both[:, k]), 1)[0] for k in (2, 3)]
    section.text(f"On these meshes the matrix with a point fixed grows as the number of points to the "
                 f"power {powers[0]:.2f}, in the earlier measurement {powers[1]:.2f}; its shape and "
                 "fixed point are not known, so that only the growth can be compared.")
    n = np.array([row[0] for row in rows], dtype=float)
    section.plot("Condition", {"smallest non-zero": (n, [row[1] for row in rows]),
                               "one point fixed": (n, [row[2] for row in rows])},
                 x="points", y="condition number", logx=True, logy=True)
    for k, name in ((1, "smallest non-zero"), (2, "one point fixed")):
        slope = np.polyfit(np.log(n), np.log([row[k] for row in rows]), 1)[0]
        section.check(0.8 < slope < 1.3, f"{name}: grows as the number of points to a power of 0.8 to "
                      "1.3", f"power {slope:.2f}")


@experiment("A4.48", title="More points, more iterations", where="4.8.2, Fig. 4.39",
            claim="A finer mesh of the same shape needs more iterations.")
def mesh_size(section, context):
    rows, runs = [], {}
    for level in levels(context):
        ball = context.model("icosphere", level=level)
        surface = moved(ball, points(ball) * (1.0, 0.45, 1.0))
        letter = context.thesis(surface, Roundness=0.5)
        # The finer the mesh, the earlier the rule stops; this requires the same accuracy of all meshes.
        plain = context.style(surface, Roundness=0.5, InitialGuess=1, Acceleration=False,
                              Tolerance=1e-4, MaximumNumberOfIterations=4000)
        default = context.style(surface, Roundness=0.5)
        count = surface.GetNumberOfPoints()
        runs[f"{count} points"] = plain
        rows.append([count] + [run.GetNumberOfIterations() for run in (letter, plain, default)]
                    + [{42: 11, 162: 23, 642: 33}.get(count)])
    section.table("Iterations", ["points", "to the letter", "same energy gap, plain", "same, accelerated",
                                 "earlier measurement"], rows,
                  "Iterations on a ball pressed flat (1 : 0.45 : 1), λ = 0.5: with the thesis' stop "
                  "rule; its iteration until the estimated energy gap is 1e-4; the same gap with our "
                  "start and acceleration")
    energy_plot(section, "Energy", runs)
    for k, name in ((1, "to the letter"), (2, "same energy gap, plain")):
        counts = [row[k] for row in rows]
        section.check(counts[-1] > counts[0] and (np.diff(counts) >= 0).all(),
                      f"Iterations grow with the number of points ({name})",
                      ", ".join(map(str, counts)))
