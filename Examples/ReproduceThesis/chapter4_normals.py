# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Section 4.5: results with normals as targets, a = 1."""
import numpy as np
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkCurvatures

from common import METRICS, check_descent, check_monotone, energy_plot, result_table
from measures import areas, dot, edge_curvatures, edges, length, spearman
from mesh_measures import dihedral_angles
from report import NOT_REPRODUCED, experiment
from surfaces import array, moved, points, triangles, with_array

GROWTH = (-2.0, 2.0)  # of the colors of log2 area ratio: four times smaller to four times larger


def with_growth(result, surface):
    """The result with the cell array log2 of the area ratio."""
    F = triangles(surface)
    ratio = areas(points(result), F) / areas(points(surface), F)
    return with_array(result, "log2 area ratio", np.log2(ratio))


def normals_of(surface):
    """Point normals, no point split."""
    normals = vtkPolyDataNormals()
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.SetInputData(surface)
    normals.Update()
    return array(normals.GetOutput(), "Normals").astype(float)


def middles(surface):
    return points(surface)[triangles(surface)].mean(axis=1)


def growth(section, result, surface, grown, shrunk, names, row=None):
    """Area of some triangles grows, that of others shrinks. grown, shrunk: flags of triangles."""
    F = triangles(surface)
    after, before = areas(points(result), F), areas(points(surface), F)
    ratios = [after[flags].sum() / before[flags].sum() for flags in (grown, shrunk)]
    section.check(ratios[0] > 1.0 > ratios[1],
                  f"At the largest λ the {names[0]} grow (area ratio above 1) and the {names[1]} "
                  "shrink (below 1)", f"{ratios[0]:.2f} and {ratios[1]:.2f}", row)


def rounder_with_roundness(section, context, surface, values=(0.5, 1.0, 5.0), views=(25.0,)):
    """Pictures, measures, energies and the checks of Fig. 4.3 to 4.8. Returns the thesis' runs."""
    letter = {f"λ = {v:g}": context.thesis(surface, NormalBlend=1.0, Roundness=v) for v in values}
    default = {f"λ = {v:g}, minimum": context.style(surface, NormalBlend=1.0, Roundness=v)
               for v in values}
    section.picture("Results", [[(surface, "model", None, view)] + [
        (with_growth(run.GetOutput(), surface), label, None, view) for label, run in letter.items()]
        for view in views], array="log2 area ratio", range=GROWTH,
        caption="Above from the top, below from the side." if len(views) > 1 else "")
    found = result_table(section, context, "Measures", surface, letter | default)
    errors = [context.metrics(surface)["FittedSphereError"]] + [
        found[label]["FittedSphereError"] for label in letter]
    check_monotone(section, errors, "The larger λ, the smaller the asphericity")
    energy_plot(section, "Energy", letter)
    check_descent(section, letter.values())
    return list(letter.values())


@experiment("A4.15", title="Model 1, like a ball", where="4.5.1, Fig. 4.3-4.4", needs=METRICS,
            claim="The larger λ, the rounder the model; every global step lowers the energy.")
def model1(section, context):
    rounder_with_roundness(section, context, context.model("perturbed-icosphere"))


@experiment("A4.16", title="Model 2, a go stone", where="4.5.1, Fig. 4.5-4.6", needs=METRICS,
            claim="The larger λ, the rounder; the sides grow, top and bottom shrink; the energy falls.")
def model2(section, context):
    surface = context.model("go-stone")
    runs = rounder_with_roundness(section, context, surface, views=(0.0, 90.0))
    x, y, z = middles(surface).T
    growth(section, runs[-1].GetOutput(), surface, np.hypot(x, y) > 0.9, np.abs(z) > 0.35,
           ("sides", "top and bottom"))


@experiment("A4.17", title="Model 3, two tetrahedra", where="4.5.1, Fig. 4.7-4.8", needs=METRICS,
            claim="Corners get rounder with λ; at large λ they grow too much and flat areas shrink.")
def model3(section, context):
    surface = context.model("bipyramid")
    runs = rounder_with_roundness(section, context, surface)
    P = points(surface)
    peak = P[np.argsort(-length(P))[:2]]
    away = np.min([length(middles(surface) - p) for p in peak], axis=0)
    flat = flatness(surface) < 1e-6
    growth(section, runs[-1].GetOutput(), surface, away < 0.3, flat, ("corners", "flat areas"))


def flatness(surface):
    """Per triangle, the largest angle between the normals of its corners, radians."""
    n = normals_of(surface)[triangles(surface)]
    cosines = [dot(n[:, k], n[:, k - 1]) for k in range(3)]
    return np.arccos(np.clip(np.min(cosines, axis=0), -1.0, 1.0))


@experiment("A4.18", title="Model 4, an icosahedron with a texture", where="4.5.1, Fig. 4.9",
            needs=METRICS, claim="At λ = 5 corners grow and flat parts shrink: the texture shows an "
                                 "uneven density. The energy still converges.")
def model4(section, context):
    surface = context.model("icosahedron")
    runs = {"λ = 5": context.thesis(surface, NormalBlend=1.0, Roundness=5.0),
            "λ = 5, minimum": context.style(surface, NormalBlend=1.0, Roundness=5.0)}
    result_table(section, context, "Measures", surface, runs)
    panels = [(surface, "model")] + [(run.GetOutput(), label) for label, run in runs.items()]
    section.picture("Texture", panels, array="TCoords")
    section.picture("Growth", [(with_growth(panel[0], surface), panel[1]) for panel in panels[1:]],
                    array="log2 area ratio", range=GROWTH)
    energy_plot(section, "Energy", runs)
    P = points(surface)
    corner = length(middles(surface)) > 0.93 * length(P).max()
    flat = length(middles(surface)) < 0.84 * length(P).max()
    result = runs["λ = 5"].GetOutput()
    growth(section, result, surface, corner, flat, ("corners", "flat parts"))
    before, after = (s.GetPointData().GetTCoords() for s in (surface, result))
    same = all(before.GetTuple(i) == after.GetTuple(i) for i in range(before.GetNumberOfTuples()))
    section.check(same, "Texture coordinates pass through unchanged", f"{len(P)} points")
    check_descent(section, runs.values())


@experiment("A4.19", title="The law of growth", where="4.5.1.1, Fig. 4.10",
            claim="Where r |n_i - n_j| is larger than |p_i - p_j| the surface grows at large λ; where "
                  "it is smaller it shrinks.")
def growth_law(section, context):
    rows, plotted = [], {}
    ball = context.model("icosphere")
    flat = moved(ball, points(ball) * (1.0, 0.45, 1.0))
    for name, earlier in (("ellipsoid", 0.999), ("go-stone", None), ("cube", None), ("bipyramid", None)):
        surface = flat if name == "ellipsoid" else context.model(name)
        run = context.style(surface, NormalBlend=1.0, Roundness=5.0)
        P, Q, E = points(surface), points(run.GetOutput()), edges(triangles(surface))
        n = array(run.GetOutput(), "TargetDirection").astype(float)
        before = length(P[E[:, 0]] - P[E[:, 1]])
        forecast = run.GetEffectiveRadius() * length(n[E[:, 0]] - n[E[:, 1]]) / before
        measured = length(Q[E[:, 0]] - Q[E[:, 1]]) / before
        agree = ((forecast > 1.0) == (measured > 1.0)).mean()
        rows.append([name, spearman(forecast, measured), earlier, 100 * agree])
        plotted[name] = forecast, measured
    section.table("Forecast", ["model", "rank correlation", "earlier measurement",
                               "foretold, % of the edges"], rows,
                  "Length ratio of the edges at λ = 5 against r |n_i - n_j| / |p_i - p_j|. Foretold: both "
                  "above 1 or both below. In cube and bipyramid most edges lie in flat faces, where all "
                  "forecasts are 0 and nothing can be ranked")
    bins = np.linspace(-5.0, 5.0, 21)
    section.plot("Growth of edges", {
        name: _binned(np.log2(np.maximum(forecast, 1e-9)), np.log2(measured), bins)
        for name, (forecast, measured) in plotted.items()},
        x="log2 of r |Δn| / |Δp| before", y="log2 of the edge ratio after",
        caption="Medians of bins; 0 is the border between growth and shrinking. Edges in flat faces "
                "have no forecast on this scale.")
    section.check(rows[0][1] > 0.95 and rows[1][1] > 0.95,
                  "On both ellipsoids the rank correlation is above 0.95",
                  f"{rows[0][1]:.3f}, {rows[1][1]:.3f}")
    share = min(row[3] for row in rows)
    section.check(share > 0.9, "On every model more than 90 % of the edges grow or shrink as foretold",
                  f"{share:.1f} % at least")


def _binned(x, y, bins):
    which = np.digitize(x, bins)
    found = [k for k in range(1, len(bins)) if (which == k).sum() > 5]
    return ([np.median(x[which == k]) for k in found], [np.median(y[which == k]) for k in found])


def mean_curvature(surface):
    """A copy with the point array Mean curvature, above 0 on a ball."""
    curvatures = vtkCurvatures()
    curvatures.SetCurvatureTypeToMean()
    curvatures.SetInputData(surface)
    curvatures.Update()
    return with_array(surface, "mean curvature",
                      array(curvatures.GetOutput(), "Mean_Curvature").astype(float))


@experiment("A4.20", title="A cube", where="4.5.2, Fig. 4.11", needs=METRICS,
            claim="At λ = 5 the corners grow too much, the flat areas shrink, and concave parts "
                  "appear where the two meet.")
def cube(section, context):
    surface = context.model("cube")
    runs = {"λ = 5": context.thesis(surface, NormalBlend=1.0, Roundness=5.0),
            "λ = 5, minimum": context.style(surface, NormalBlend=1.0, Roundness=5.0)}
    result_table(section, context, "Measures", surface, runs)
    curved = {label: mean_curvature(run.GetOutput()) for label, run in runs.items()}
    scale = 1.0 / runs["λ = 5"].GetEffectiveRadius()
    section.picture("Curvature", [(surface, "model")] + [(s, label) for label, s in curved.items()],
                    array="mean curvature", range=(-4.0 * scale, 4.0 * scale))
    section.picture("Mesh", [(surface, "model")] + [
        (run.GetOutput(), label) for label, run in runs.items()], wires=True)
    P = points(surface)
    corner = np.abs(middles(surface)).min(axis=1) > 0.35 * np.ptp(P[:, 0])
    flat = np.sort(np.abs(middles(surface)), axis=1)[:, 1] < 0.35 * np.ptp(P[:, 0])
    growth(section, runs["λ = 5"].GetOutput(), surface, corner, flat, ("corners", "flat areas"))
    before = int((array(mean_curvature(surface), "mean curvature") < -0.1 * scale).sum())
    for label, result in curved.items():
        concave = int((array(result, "mean curvature") < -0.1 * scale).sum())
        section.check(concave > before, f"{label}: more concave points (mean curvature below -0.1 / r) "
                      "than in the model", f"{concave} of {len(P)} points; model {before}")


def intersections(section, context, surface, name, values, view=25.0, literal=True, **properties):
    """Pictures and counts over λ. Returns the metrics of the results."""
    run = context.thesis if literal else context.style
    runs = {f"λ = {v:g}": run(surface, NormalBlend=1.0, Roundness=v, **properties) for v in values}
    return show_intersections(section, context, surface, name, runs, view)


def folded(metrics):
    return int(metrics["SelfIntersectingTriangles"])


def show_intersections(section, context, surface, name, runs, view):
    """The same of runs: {label: filter}."""
    found = result_table(section, context, f"Measures, {name}", surface, runs)
    marked = {label: context.run("vtkSurfaceMetrics", r.GetOutput(), {1: surface}).GetOutput()
              for label, r in runs.items()}
    section.picture(name, [(surface, "model", None, view)] + [
        (s, label, None, view) for label, s in marked.items()], array="SelfIntersections", range=(0, 1))
    return list(found.values())


@experiment("A4.21", title="A tetrahedron", where="4.5.2, Fig. 4.12", needs=METRICS,
            claim="At λ = 0.5 the corners get rounder; at λ = 5 they stretch so far that the mesh "
                  "intersects itself.")
def tetrahedron(section, context):
    flat = context.model("flat-tetrahedron", scale=(1.8, 1.0, 0.3))
    literal = dict(InitialGuess=1, Anchor=1, EdgeWeighting=1, Acceleration=False)
    runs = {f"λ = {v:g}": context.thesis(flat, NormalBlend=1.0, Roundness=v) for v in (0.5, 5.0)}
    runs["λ = 5, converged"] = context.style(flat, NormalBlend=1.0, Roundness=5.0, **literal,
                                             MaximumNumberOfIterations=2000)
    before = context.metrics(flat)["FittedSphereError"]
    low, high, end = show_intersections(section, context, flat, "Stretched tetrahedron", runs, 60.0)
    section.check(low["FittedSphereError"] < before, "Stretched: rounder at λ = 0.5 (asphericity)",
                  f"{before:.3f} to {low['FittedSphereError']:.3f}")
    section.check(folded(low) == 0, "Stretched: no triangles intersect at λ = 0.5",
                  f"{folded(low)}; earlier measurement: 0")
    section.check(folded(high) > 0, "Stretched: some triangles intersect at λ = 5",
                  f"{folded(high)} of {flat.GetNumberOfCells()}; earlier measurement: 16 of 1024")
    section.check(high["LargestAreaRatio"] > 10.0, "Stretched: corners stretch more than tenfold at λ = 5 "
                  "(largest area ratio)",
                  f"{high['LargestAreaRatio']:.1f}; earlier measurement: up to 47")
    *_, regular = intersections(section, context, context.model("tetrahedron"), "Regular tetrahedron",
                                (0.5, 5.0))
    section.text(f"The count depends on when the iteration stops: {folded(high)} triangles with the "
                 f"thesis' rule, {folded(end)} in the same iteration when it has converged. The regular "
                 f"tetrahedron has {folded(regular)} at λ = 5.")


@experiment("A4.22", title="A tangram prism", where="4.5.2, Fig. 4.13", needs=METRICS,
            claim="At λ = 0.1 corners deform more than flat areas; at λ = 0.5 growth makes the mesh "
                  "intersect itself.")
def prism(section, context):
    surface, values = context.model("tangram-prism"), (0.1, 0.5, 1.0)
    for name, literal in (("To the letter", True), ("Half-edge energy", False)):
        properties = {} if literal else dict(InitialGuess=1, Acceleration=False)
        counts = [folded(m) for m in intersections(section, context, surface, name, values,
                                                   literal=literal, **properties)]
        section.check(counts[0] == 0, f"{name}: no triangles intersect at λ = 0.1", str(counts[0]))
        section.check(counts[1] > 0, f"{name}: some triangles intersect at λ = 0.5",
                      f"{counts[1]}; {counts[2]} at λ = 1; earlier measurement, on a regular mesh: 0")
    run = context.style(surface, NormalBlend=1.0, Roundness=0.1, InitialGuess=1, Acceleration=False)
    before, after = (dihedral_angles(points(s), triangles(surface))
                     for s in (surface, run.GetOutput()))
    bend, sharp = np.degrees(np.abs(after - before)), np.abs(before) > 1e-3
    section.check(np.median(bend[sharp]) > np.median(bend[~sharp]),
                  "Half-edge energy: at λ = 0.1 sharp edges bend more than flat areas (median change of "
                  "the dihedral angle)",
                  f"{np.median(bend[sharp]):.2f} and {np.median(bend[~sharp]):.2f} degrees")
    section.verdict(why="The mesh of this prism is full of obtuse triangles. To the letter each of them "
                        "gets cotangents of triangles outside its cells, which folds the mesh already at "
                        "λ = 0.1; the half-edge energy, here from the thesis' start, takes each triangle's "
                        "own and folds only at larger λ.")


def bunny(context):
    """(name, surface) of the complex model."""
    real = context.real("spot-small" if context.small else "spot")
    return ("spot", real) if real else ("quadruped", context.model("quadruped"))


@experiment("A4.23", "A4.24", title="A complex model, and the cause of its folds",
            where="4.5.3, Fig. 4.14-4.15", needs=METRICS, claim={
                "A4.23": "At λ = 0.1 all parts get rounder, but the mesh intersects itself at "
                         "concave places as from neck to back.",
                "A4.24": "Folds come where the difference of the normals points against that of the "
                         "positions, which is at concave places."})
def folds(section, context):
    name, surface = bunny(context)
    run = context.thesis(surface, NormalBlend=1.0, Roundness=0.1)
    runs = {"λ = 0.05": context.thesis(surface, NormalBlend=1.0, Roundness=0.05), "λ = 0.1": run,
            "λ = 0.1, minimum": context.style(surface, NormalBlend=1.0, Roundness=0.1),
            "λ = 0.1, a = 0": context.thesis(surface, Roundness=0.1)}
    before = context.metrics(surface)["FittedSphereError"]
    _, found, _, directions = show_intersections(section, context, surface, name, runs, 60.0)
    section.check(found["FittedSphereError"] < before, "Rounder at λ = 0.1 (asphericity)",
                  f"{before:.3f} to {found['FittedSphereError']:.3f}", "A4.23")
    cells = surface.GetNumberOfCells()
    section.check(folded(found) > 0, "Triangles intersect at λ = 0.1",
                  f"{folded(found)} of {cells} ({100 * folded(found) / cells:.1f} %); earlier "
                  "measurement, on spot of 5,856 triangles: 887 (15 %)", "A4.23")
    section.check(folded(directions) == 0, "None do with directions instead of normals (a = 0)",
                  str(folded(directions)), "A4.23")
    P, F = points(surface), triangles(surface)
    n = array(run.GetOutput(), "TargetDirection").astype(float)
    E = edges(F)
    curvature = edge_curvatures(P, n, E)
    opposed = np.bincount(E[curvature < 0.0].ravel(), minlength=len(P)) / np.bincount(
        E.ravel(), minlength=len(P))
    marks = context.run("vtkSurfaceMetrics", run.GetOutput(), {1: surface}).GetOutput()
    hit = array(marks, "SelfIntersections") > 0
    at = opposed[F].max(axis=1) > 0.0
    section.picture("Opposition", [
        (with_array(surface, "share of opposed edges", opposed), "model", None, 60.0),
        (with_array(run.GetOutput(), "share of opposed edges", opposed), "λ = 0.1", None, 60.0)],
        array="share of opposed edges", range=(0.0, 1.0))
    rows = [["all triangles", len(F), at.mean(), opposed[F].mean()],
            ["intersecting triangles", int(hit.sum()), at[hit].mean(), opposed[F][hit].mean()]]
    section.table("Opposed edges", ["", "count", "with an opposed edge at a corner",
                                    "mean share of opposed edges"], rows)
    most = section.check(rows[1][2] > 0.9, "More than 90 % of the intersecting triangles have an opposed "
                         "edge at a corner",
                         f"{100 * rows[1][2]:.0f} %; {100 * rows[0][2]:.0f} % of all", "A4.24")
    section.check(rows[1][3] > 1.5 * rows[0][3], "Their share of such edges is more than 1.5 times that "
                  "of all triangles", f"{rows[1][3]:.2f} and {rows[0][3]:.2f}", "A4.24")
    if not most:
        section.verdict(why="A4.24: most folds are at opposed edges but not all. Where a part has grown "
                            "into another one, the triangles of both count, and neither need be concave.",
                        row="A4.24")


@experiment("A4.25", "A4.26", title="Differences turned around", where="4.5.3.1, Eq. 4.39, Fig. 4.16-4.17",
            needs=METRICS, claim={
                "A4.25": "With Δn taken opposite where it makes more than 90° with Δp the folds are "
                         "avoided; convex gets more convex, concave more concave, and the energy "
                         "still converges.",
                "A4.26": "No application of it has been found."})
def flip(section, context):
    name, surface = bunny(context)
    values = (0.05, 0.1)
    kept = {f"kept, λ = {v:g}": context.thesis(surface, NormalBlend=1.0, Roundness=v) for v in values}
    runs = {f"turned, λ = {v:g}": context.thesis(surface, NormalBlend=1.0, Roundness=v, ConcaveEdges=1)
            for v in values}
    found = show_intersections(section, context, surface, name, kept | runs, 60.0)
    kept, turned = folded(found[1]), folded(found[3])
    energy_plot(section, "Energy, differences turned", runs)
    section.text("The angle is tested once, on the model. Earlier measurement: no rise of the energy "
                 "then, and rises in 15 of 80 iterations when tested anew on every shape.")
    check_descent(section, runs.values(), "A4.25")
    section.check(turned < 0.2 * kept, "At λ = 0.1 less than a fifth of the intersections are left",
                  f"{turned} of {kept}", "A4.25")
    section.check(turned == 0, "None is left", str(turned), "A4.25")
    result = runs["turned, λ = 0.1"].GetOutput()
    E = edges(triangles(surface))
    before = edge_curvatures(points(surface), normals_of(surface), E)
    after = edge_curvatures(points(result), normals_of(result), E)
    size = np.sqrt(areas(points(result), triangles(result)).sum()
                   / areas(points(surface), triangles(surface)).sum())
    rows = [[kind, int(flags.sum()), np.median(before[flags]), np.median(after[flags]) * size]
            for kind, flags in (("convex", before > 0.0), ("concave", before < 0.0))]
    section.table("Curvature along edges", ["edges of the model", "count", "median before",
                                            "median after, same size"], rows,
                  "Normal curvature along edges at λ = 0.1, in 1 / length; below 0 is concave")
    section.check(rows[0][3] > rows[0][2], "The median curvature of convex edges rises",
                  f"{rows[0][2]:.3f} to {rows[0][3]:.3f}", "A4.25")
    section.check(rows[1][3] < rows[1][2], "The median curvature of concave edges falls",
                  f"{rows[1][2]:.3f} to {rows[1][3]:.3f}", "A4.25")
    section.verdict(NOT_REPRODUCED, "A4.26 says that nothing is known, which no run can show; the "
                    "table shows what the mode is good for: relief that is exaggerated.", "A4.26")


@experiment("A4.27", title="A scale for every point", where="4.5.4", needs=METRICS,
            claim="Curved and concave points should deform with a smaller scale than flat and convex "
                  "ones; the exact law is not known.")
def point_scale(section, context):
    section.text("Two laws to try, one for each half of the claim. Curved: the roundness factor of a "
                 "point is 1 / (1 + r κ), κ the largest |n_i - n_j| / |p_i - p_j| of its edges. Concave: "
                 "the factor is a tenth at points with a concave edge. λ is then chosen so that all "
                 "results are equally far from a ball.")
    rows, better = [], {}
    for name, start in context.choose([("bipyramid", 1.0)],
                                      [("bipyramid", 1.0), ("cube", 1.0), ("quadruped", 0.1)]):
        surface = context.model(name)
        even = context.style(surface, NormalBlend=1.0, Roundness=start)
        goal = context.metrics(even.GetOutput(), surface)
        results = {"one λ": (start, even, goal)}
        for law, factors in point_factors(even, surface).items():
            if factors.min() < factors.max():
                value, run = same_asphericity(context, with_array(surface, "factor", factors),
                                              goal["FittedSphereError"])
                results[law] = value, run, context.metrics(run.GetOutput(), surface)
        section.picture(name, [(surface, "model")] + [
            (with_growth(run.GetOutput(), surface), label) for label, (_, run, _) in results.items()],
            array="log2 area ratio", range=GROWTH)
        for label, (value, _, m) in results.items():
            rows.append([f"{name}, {label}", value, m["FittedSphereError"], m["LargestAreaRatio"],
                         m["AreaRatioSpread"], folded(m)])
            if label == "one λ":
                continue
            same = abs(m["FittedSphereError"] / goal["FittedSphereError"] - 1.0) < 0.02
            for column, what in (("LargestAreaRatio", "the largest area ratio is lower"),
                                 ("AreaRatioSpread", "the areas are more even (area spread)"),
                                 ("SelfIntersectingTriangles", "fewer triangles intersect")):
                if goal[column] > 0.0:
                    better.setdefault(label, {}).setdefault(what, []).append(section.check(
                        same and m[column] < goal[column],
                        f"{name}, {label}: at the same asphericity (2 %), {what}",
                        f"{goal[column]:.4g} to {m[column]:.4g}"))
    section.table("One λ and one per point", ["", "λ", "asphericity", "largest area ratio",
                                              "area spread", "intersecting"], rows)
    section.verdict(why=" ".join(f"{label.capitalize()}: " + ", ".join(
        f"{what} on {sum(found)} of {len(found)}" for what, found in whats.items()) + "."
        for label, whats in better.items()))


def point_factors(style, surface):
    E, P = edges(triangles(surface)), points(surface)
    n = array(style.GetOutput(), "TargetDirection").astype(float)
    steep = length(n[E[:, 0]] - n[E[:, 1]]) / length(P[E[:, 0]] - P[E[:, 1]])
    kappa, least = np.zeros(len(P)), np.full(len(P), np.inf)
    for k in range(2):
        np.maximum.at(kappa, E[:, k], steep)
        np.minimum.at(least, E[:, k], edge_curvatures(P, n, E))
    return {"curved": 1.0 / (1.0 + style.GetEffectiveRadius() * kappa),
            "concave": np.where(least < -1e-6 / style.GetEffectiveRadius(), 0.1, 1.0)}


def same_asphericity(context, scaled, goal):
    """(λ, filter) with the point array factor and this asphericity, by bisection."""
    low, high = 0.01, 100.0
    for _ in range(14):
        value = np.sqrt(low * high)
        run = context.style(scaled, arrays={1: (0, "factor")}, NormalBlend=1.0, Roundness=value)
        error = context.metrics(run.GetOutput(), FindSelfIntersections=False)["FittedSphereError"]
        low, high = (value, high) if error > goal else (low, value)
    return value, run
