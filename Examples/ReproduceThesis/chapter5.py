# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Chapter 5: the convex proxy, vtkConvexProxyDeformFilter."""
import numpy as np
from vtkmodules.vtkCommonCore import mutable
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator
from vtkmodules.vtkFiltersSources import vtkCubeSource

import models
import sphericalstyle
from context import history
from measures import areas
from mesh_measures import (angles, diagonal, dihedral_angles, dihedral_change, edge_weights,
                           inner_edges, laplacian, normals_of, obtuse, open_edges, places, spread,
                           turned_over, volume, welded)
from report import NOT_REPRODUCED, experiment
from sphericalstyle import vtkThesisStyleFilter as Style
from surfaces import array, moved, part, points, surface, triangles, with_array

PROXY = ("vtkConvexProxyDeformFilter",)
SPHERE = ("vtkSphereProjectionFilter",)
Proxy = getattr(sphericalstyle, PROXY[0], None)  # builds without CGAL have none
MESHERS = {name: number for number, name in enumerate((  # as in ProxyMeshers
    "IsotropicRemeshing", "BallPivoting", "AdvancingFront", "SubdividedHull"))}


def proxied(context, model, **properties):
    """The executed filter, points in double precision."""
    return context.run(PROXY[0], model, OutputPointsPrecision=1, **properties)


def result(context, model, **properties):
    return proxied(context, model, **properties).GetOutput()


def rest(proxy):
    """The proxy before it was rounded."""
    return moved(proxy, array(proxy, "RestPosition"))


def distances(x, target):
    """The distance from each point to the nearest point of a surface, by VTK's locator."""
    locator = vtkStaticCellLocator()
    locator.SetDataSet(target)
    locator.BuildLocator()
    found, cell, part_of, square = [0.0] * 3, mutable(0), mutable(0), mutable(0.0)
    result = np.empty(len(x))
    for i, place in enumerate(x):
        locator.FindClosestPoint(place, found, cell, part_of, square)
        result[i] = np.sqrt(float(square))
    return result


def feet(deform):
    """Where each input point is projected to, on the proxy at rest."""
    return points(deform.GetOutput(2)).reshape(-1, 2, 3)[:, 1]


def on_proxy(deform, proxy):
    """The point of the proxy that each input point's coefficients stand for."""
    corners = triangles(proxy)[array(deform.GetOutput(), "ProxyCell").astype(int)]
    return np.einsum("ik,ikd->id", array(deform.GetOutput(), "Barycentric"), points(proxy)[corners])


def as_round_as(context, model, F, wanted, **properties):
    """(result, Roundness) of the direct method with the wanted spread of radii, by bisection."""
    low, high = 0.01, 50.0
    for _ in range(12):
        roundness = np.sqrt(low * high)
        direct = context.style(model, Roundness=roundness, **properties).GetOutput()
        low, high = (roundness, high) if spread(points(direct), F) > wanted else (low, roundness)
    return direct, roundness


def cars(context):
    """(name, model) of our car, and of the real one if it is there."""
    both = [("our car", context.model("car")), ("real car", context.real("car"))]
    return [(name, model) for name, model in both if model]


def along_y(x, low=0.0, high=1.0):
    """0..1 between two fractions of the extent along y."""
    s = (x[:, 1] - x[:, 1].min()) / np.ptp(x[:, 1])
    return np.clip((s - low) / (high - low), 0.0, 1.0)


# ---------------------------------------------------------------------------------------------- 5.1
def jittered_ball(amount):
    """An icosphere of 642 points that slid over the ball by up to amount times the edge length."""
    ball = models.SHAPES["icosphere"](level=3)
    x = points(ball)
    edge = np.linalg.norm(x[triangles(ball)[:, 0]] - x[triangles(ball)[:, 1]], axis=1).mean()
    x = x + amount * edge * np.random.RandomState(5).uniform(-1.0, 1.0, x.shape)
    return moved(ball, x / np.linalg.norm(x, axis=1)[:, None])


@experiment("A5.1", "A6.9", title="Why a proxy: obtuse triangles", where="5.1, abstract", claim={
    "A5.1": "Obtuse triangles give negative cotangent weights, which λ does not always mend;"
    " the matrix is then no longer positive definite, and badly conditioned.",
    "A6.9": "On obtuse triangles the direct method fails."})
def obtuse_triangles(section, context):
    subjects = [(name, context.model(name)) for name in ("cube", "stone-house", "tangram-prism")]
    subjects += [(f"ball, points moved by {amount:g} edges", jittered_ball(amount))
                 for amount in (0.0, 0.2, 0.35)]
    rows = []
    for name, model in subjects:
        x, F = points(model), triangles(model)
        edges, w = edge_weights(x, F)
        eigenvalues = np.linalg.eigvalsh(laplacian(len(x), edges, w))
        rows.append((name, len(x), 100.0 * obtuse(x, F).mean(), 100.0 * (w < 0.0).mean(),
                     max(0.0, -w.min()),
                     100.0 * (w + 0.5 < 0.0).mean(), eigenvalues[0] / eigenvalues[-1],
                     eigenvalues[-1] / eigenvalues[1]))
    section.table("Matrices", [
        "model", "points", "obtuse triangles, %", "edges with w < 0, %", "λ* = -min w",
        "edges with w + 0.5 < 0, %", "smallest / largest eigenvalue", "condition number"], rows,
        caption="The cotangent matrix. From λ* on no w + λ is negative; the condition number is"
                  " the largest eigenvalue over the smallest, leaving out the 0 of translations")
    bad = [row for row in rows if row[2] > 25.0]
    section.check(all(row[3] > 0.0 for row in bad), "models with obtuse triangles have weights w <"
                  " 0",
                  f"{min(row[3] for row in bad):.0f} to {max(row[3] for row in bad):.0f} % of the"
                  " edges",
                  "A5.1")
    section.check(any(row[5] > 0.0 for row in bad), "some w + λ are negative at λ = 0.5",
                  f"up to {max(row[5] for row in bad):.0f} % of the edges", "A5.1")
    least = min(row[6] for row in rows)
    section.check(least < -1e-10, "the matrix gets negative eigenvalues (below -1e-10 of the"
                  " largest)",
                  f"least {least:.1g} of the largest, which is rounding: the cotangent matrix is"
                  " positive semidefinite on every mesh", "A5.1")
    smooth, rough = rows[3][-1], rows[5][-1]
    section.check(rough > 2.0 * smooth, "the condition number at least doubles on the moved points",
                  f"{smooth:.0f} to {rough:.0f}", "A5.1")

    rows = []
    for name in ("stone-house", "tangram-prism"):
        model = context.model(name)
        x, F = points(model), triangles(model)
        panels = [(model, "model")]
        for label, weighting in (("full edge (thesis)", Style.FULL_EDGE),
                                 ("per triangle", Style.HALF_EDGE)):
            style = context.style(model, Roundness=0.1, EdgeWeighting=weighting, Acceleration=False,
                                  InitialGuess=Style.REST, StopRule=Style.FIXED_ITERATIONS,
                                  MaximumNumberOfIterations=40)
            q = points(style.GetOutput())
            rows.append((name, label, history(style)["Total"][0], history(style)["Total"].min(),
                         turned_over(x, q, F), (areas(q, F) / areas(x, F)).max()))
            panels.append((style.GetOutput(), f"weights {label}"))
        section.picture(name, panels, caption="Directly, λ = 0.1, 40 iterations")
    section.table("Direct method", ["model", "weights", "energy at the start", "lowest energy",
                                    "triangles turned over", "largest growth of a triangle"], rows)
    thesis, ours = rows[2], rows[3]
    section.check(thesis[3] < 0.0 or thesis[4] > 0, "the thesis' weights fail on the prism:"
                  " negative energy or triangles turned over",
                  f"energy {thesis[3]:.1f}, {thesis[4]} turned over",
                  "A6.9")
    section.check(ours[3] < 0.0 or ours[4] > 0, "so does the direct method where each triangle has"
                  " its own cotangents", f"energy {ours[3]:.2f}, {ours[4]} turned over; see A8.6",
                  "A6.9")


@experiment("A5.2", title="Local remeshing", where="5.1",
            claim="Local remeshing would be a cure but makes T-junctions.")
def local_remeshing(section, _context):
    section.verdict(NOT_REPRODUCED, "The thesis considers and drops it. The filters here never"
                    " change the triangles of a model; A8.6 has weights that do not need it.")


# ---------------------------------------------------------------------------------------------- 5.2
def proxy_of(context, model, mesher, count):
    """The filter, the proxy at rest and its measures: points, open edges, Euler characteristic,
    share of angles above 25 degrees and of obtuse triangles (%), longest over shortest edge."""
    deform = proxied(context, model, ProxyMesher=mesher, NumberOfProxyPoints=count)
    proxy = rest(deform.GetOutput(1))
    x, F = points(proxy), triangles(proxy)
    sides = np.linalg.norm(x[F] - x[np.roll(F, 1, axis=1)], axis=2)
    return deform, proxy, (len(x), open_edges(proxy), len(x) - len(F) // 2,
                           100.0 * (angles(x, F) > 25.0).mean(), 100.0 * obtuse(x, F).mean(),
                           sides.max() / sides.min())


def outside(model, hull):
    """How far points lie outside of a convex surface at most, over the diagonal."""
    x, F = points(hull), triangles(hull)
    F = F[angles(x, F).min(axis=1) > 0.1]  # the normal of a sliver is only rounding error
    normal = normals_of(x, F)
    offset = np.einsum("ij,ij->i", normal, x[F[:, 0]])
    p = points(model)
    return max((some @ normal.T - offset).max() for some in np.array_split(p, 20)) / diagonal(p)


@experiment("A5.3", "A5.4", "A5.5", needs=PROXY, title="The proxy: hull, even points, triangles",
            where="5.2, Fig. 5.1", claim={
                "A5.3": "The convex hull of the model comes first.",
                "A5.4": "Poisson-disk sampling puts even points on it.",
                "A5.5": "Ball pivoting makes a proxy of mostly regular triangles."})
def make_proxy(section, context):
    count = context.choose(1500, 5000)
    car = context.model("car")
    section.picture("Proxies", [(proxy_of(context, car, number, 1200)[1], mesher)
                                for mesher, number in MESHERS.items()], wires=True,
                    caption="Of the car, coarser than those of the table")
    rows, spacing = [], []
    for name in ("car", "bottle", "creature"):
        model = context.model(name)
        for mesher, number in MESHERS.items():
            measures = proxy_of(context, model, number, count)[2]
            rows.append((name, mesher, *measures))
            if number == Proxy.BALL_PIVOTING:
                spacing.append(measures[-1])
    section.table("Proxies", ["model", "mesher", "points", "open edges", "Euler characteristic",
                              "angles above 25°, %", "obtuse triangles, %",
                              "longest / shortest edge"], rows)
    hulls = [(model, *proxy_of(context, model, Proxy.SUBDIVIDED_HULL, 4)[1:])
             for model in map(context.model, ("car", "bottle", "creature"))]
    beyond = max(0.0, *(outside(model, hull) for model, hull, _ in hulls))
    section.check(beyond < 1e-9, "no point lies outside of the hull of its model by more than 1e-9"
                  " diagonals", f"{beyond:.1g}", "A5.3")
    section.check(all(measures[1:3] == (0, 2) for _, _, measures in hulls),
                  "the hulls are closed, with the Euler characteristic of a ball", "3 models",
                  "A5.3")
    section.check(max(spacing) < 4.0, "between samples that keep a distance r and leave no hole"
                  " of radius 2 r, the longest edge is less than 4 times the shortest",
                  f"at most {max(spacing):.2f}", "A5.4")
    first, second = (points(proxy_of(context, car, Proxy.BALL_PIVOTING, count)[1])
                     for _ in range(2))
    section.check(np.array_equal(first, second), "the same seed gives the same bits", row="A5.4")
    pivoted = [row for row in rows if row[1] == "BallPivoting"]
    section.check(all(row[3] == 0 and row[4] == 2 for row in pivoted),
                  "ball pivoting: closed, and of the topology of a ball", f"{len(pivoted)} models",
                  "A5.5")
    good = min(row[5] for row in pivoted)
    section.check(good > 95.0, "ball pivoting: more than 95 % of the angles above 25°",
                  f"at least {good:.2f} %", "A5.5")
    remeshed = [row for row in rows if row[1] == "IsotropicRemeshing"]
    section.text(f"Ball pivoting leaves up to {max(row[6] for row in pivoted):.0f} % obtuse"
                 " triangles; remeshing the hull, the default of the filter, up to"
                 f" {max(row[6] for row in remeshed):.1f} %.")


# ---------------------------------------------------------------------------------------------- 5.3
@experiment("A5.6", "A5.7", needs=PROXY, title="Projection by nearest vertices", where="5.3.1",
            claim={
    "A5.6": "The shortest projection is found on the triangles at the k = 4 nearest proxy points.",
    "A5.7": "There are three cases: one foot, several, none; with none the nearest foot outside of"
    " its triangle is projected again."})
def projection_cases(section, context):
    subjects = [("stone-house", context.model("stone-house")),
                ("creature", context.model("creature"))]
    if not context.small and context.real("koala"):
        subjects.append(("koala", context.real("koala")))
    rows, panels = [], []
    for name, model in subjects:
        x = points(model)
        for mesher in ("IsotropicRemeshing", "BallPivoting", "SubdividedHull"):
            exact = proxied(context, model, ProxyMesher=MESHERS[mesher])
            nearest = np.linalg.norm(feet(exact) - x, axis=1)
            for k in (4,) if name == "koala" else (4, 20):
                deform = proxied(context, model, ProxyMesher=MESHERS[mesher],
                                 Projection=Proxy.NEAREST_VERTICES, NumberOfNeighbors=k,
                                 GenerateProjectionArrays=True)
                surplus = (np.linalg.norm(feet(deform) - x, axis=1) - nearest) / diagonal(x)
                rows.append((name, mesher, k, *deform.GetProjectionCaseCounts(),
                             100.0 * (surplus > 1e-6).mean(), 100.0 * max(surplus.max(), 0.0)))
                if name == "creature" and k == 4:
                    cases = array(deform.GetOutput(), "ProjectionCase").astype(float)
                    panels.append((with_array(model, "Case", cases), mesher))
    section.picture("Case", panels, array="Case", range=(1.0, 3.0),
                    caption="k = 4. Light: I, orange: II, dark: III")
    section.table("Cases", ["model", "proxy", "k", "I: one foot", "II: several", "III: none",
                            "not the nearest point, %", "largest surplus, % of the diagonal"], rows)
    for label, chosen in (("even proxies", ("IsotropicRemeshing", "BallPivoting")),
                          ("the hull's own slivers", ("SubdividedHull",))):
        missed = max(row[6] for row in rows if row[1] in chosen and row[2] == 4)
        section.check(missed == 0.0, f"k = 4 on {label}: every point gets the nearest point of the"
                      " proxy, to 1e-6 diagonals", f"up to {missed:.1f} % do not", "A5.6")
    most = max(row[6] for row in rows if row[2] == 4)
    section.check(most < 10.0, "k = 4 finds the nearest point for nine of ten points or more",
                  f"at least {100.0 - most:.1f} % of a model; the foot is farther by at most"
                  f" {max(row[7] for row in rows if row[2] == 4):.2f} % of the diagonal. Earlier"
                  " measurement: all on even proxies, 82 % on slivers", "A5.6")
    section.text("More neighbors do not help where no foot lies inside of its triangle, because the"
                 " nearest point is on an edge or a corner: case III then starts from the plane of"
                 " any triangle around. The filter's default, ClosestPoint, is exact.")
    occur = np.array([row[3:6] for row in rows if row[2] == 4]).sum(axis=0)
    section.check(occur.min() > 0, "with k = 4 all three cases occur",
                  f"{occur[0]}, {occur[1]} and {occur[2]} points", "A5.7")


@experiment("A5.8", needs=PROXY, title="Interpolation coefficients", where="5.3.2, Eq. 5.1-5.17",
            claim="Each foot is q = b1 q1 + b2 q2 + b3 q3 on its triangle.")
def barycentric(section, context):
    rows = []
    for name in ("car", "stone-house", "bottle"):
        model = context.model(name)
        x = points(model)
        deform = proxied(context, moved(model, x), GenerateProjectionArrays=True)  # in double
        b = array(deform.GetOutput(), "Barycentric")
        proxy = rest(deform.GetOutput(1))
        q = on_proxy(deform, proxy)
        apart = np.linalg.norm(q - feet(deform), axis=1).max() / diagonal(x)
        farther = np.abs(np.linalg.norm(q - x, axis=1) - distances(x, proxy)).max() / diagonal(x)
        rows.append((name, apart, farther, np.abs(b.sum(axis=1) - 1.0).max(), b.min()))
    section.table("Coefficients", ["model", "q from the end of its line, diagonals",
                                   "|p - q| less the distance from the proxy, diagonals",
                                   "largest |Σb - 1|", "smallest b"], rows,
                  caption="Largest of all points; q is b1 q1 + b2 q2 + b3 q3, the distance is by a"
                  " locator of VTK")
    section.check(max(row[2] for row in rows) < 1e-12, "q is the point of the proxy nearest to p:"
                  " its distance is right to 1e-12 diagonals", f"{max(row[2] for row in rows):.1g}")
    section.check(max(row[1] for row in rows) < 1e-12, "the line of p ends there, to 1e-12"
                  " diagonals", f"{max(row[1] for row in rows):.1g}")
    section.check(max(row[3] for row in rows) < 1e-12, "they sum to 1, to 1e-12")
    section.check(min(row[4] for row in rows) >= 0.0, "none is negative")
    section.text("The filter takes ratios of areas, which need none of the cases of Eq. 5.5-5.17;"
                 " A8.21 compares both.")


# ---------------------------------------------------------------------------------------------- 5.4
@experiment("A5.9", "A5.10", needs=PROXY, title="From proxy to model", where="5.4, Eq. 5.18",
            claim={
    "A5.9": "The proxy is rounded with a = 0 and a large λ such as 5, and gets much rounder.",
    "A5.10": "p' = (1 - t) q' + t p, 0 ≤ t ≤ 1."})
def transfer(section, context):
    car = context.model("car")
    x = points(car)
    ball = proxied(context, car, Blend=0.0, Roundness=5.0, GenerateProjectionArrays=True)
    half = result(context, car, Blend=0.5)
    proxy = ball.GetOutput(1)
    section.picture("Steps", [(car, "model"), (rest(proxy), "proxy"), (proxy, "proxy, rounded"),
                              (ball.GetOutput(), "t = 0"), (half, "t = 0.5")])
    before, after = (spread(points(p), triangles(p)) for p in (rest(proxy), proxy))
    section.check(after < 0.2 * before, "λ = 5 leaves less than a fifth of the proxy's spread of"
                  " radii",
                  f"{before:.3f} to {after:.3f}", "A5.9")
    section.check(np.array_equal(points(result(context, car, Blend=1.0)), x),
                  "t = 1 is the model, to the last bit", row="A5.10")
    off = np.abs(on_proxy(ball, proxy) - points(ball.GetOutput())).max() / diagonal(x)
    section.check(off < 1e-6, "t = 0 lies on the rounded proxy, to 1e-6 diagonals", f"{off:.1g}",
                  "A5.10")
    bent = np.abs(points(half) - 0.5 * (points(ball.GetOutput()) + x)).max() / diagonal(x)
    section.check(bent < 1e-12, "t = 0.5 is the mean of both, to 1e-12 diagonals", f"{bent:.1g}",
                  "A5.10")


# ---------------------------------------------------------------------------------------------- 5.5
def roughness(before, after, F, limit=20.0):
    """Rms dihedral angle where the model is smooth (below limit), degrees."""
    smooth = np.abs(np.degrees(dihedral_angles(before, F))) < limit
    return np.sqrt((np.degrees(dihedral_angles(after, F))[smooth] ** 2).mean())


@experiment("A5.11", needs=PROXY, title="Car, directly and through the proxy",
            where="5.5, Fig. 5.3",
            claim="The direct result is matte, as on roof and trunk; the result through the proxy"
            " is smoother.")
def car_smoothness(section, context):
    rows = []
    for name, car in cars(context):
        x, F = points(car), welded(car)
        through = result(context, car)
        wanted = spread(points(through), F)
        thesis, lambda_thesis = as_round_as(context, car, F, wanted, ReproduceThesis=True)
        ours, lambda_ours = as_round_as(context, car, F, wanted)
        results = [(f"direct, thesis, λ {lambda_thesis:.2f}", thesis),
                   (f"direct, ours, λ {lambda_ours:.2f}", ours), ("proxy, t 0.5", through)]
        section.picture(name, [(car, "model"), *((model, label) for label, model in results)])
        measured = [(spread(points(q), F), roughness(x, points(q), F),
                     dihedral_change(x, points(q), F))
                    for _, q in results]
        rows.append((name, "model", spread(x, F), roughness(x, x, F), 0.0))
        rows += [(name, label, *numbers) for (label, _), numbers in zip(results, measured)]
        for value, what in ((1, "the smooth parts (below 20°) bend less from triangle to triangle,"
                             " rms"),
                            (2, "angles between neighboring triangles change less, rms")):
            a, b, c = (numbers[value] for numbers in measured)
            section.check(c < a, f"{name}, through the proxy: {what}",
                          f"{c:.1f}° through the proxy, {a:.1f}° directly as in the thesis"
                          f" ({b:.1f}° with weights per triangle)")
    section.table("Smoothness at equal roundness", [
        "model", "result", "spread of radii", "rms angle where smooth, °",
        "rms change of angles, °"],
        rows, caption="The direct results have the λ of the same spread of radii")


@experiment("A5.12", needs=PROXY, title="Car, t = 0.8, 0.5, 0.2", where="5.5, Fig. 5.4",
            claim="The smaller t, the rounder the car; local details are preserved.")
def car_blend(section, context):
    ts = (1.0, 0.8, 0.5, 0.2)
    rows = []
    for name, car in cars(context):
        x, F = points(car), welded(car)
        panels = []
        for label, kind in (("Blend (thesis)", Proxy.BLEND), ("Offset", Proxy.OFFSET)):
            results = [result(context, car, Blend=t, Transfer=kind) for t in ts]
            panels.append([(q, f"t = {t:g}, {label}") for t, q in zip(ts, results)])
            changes = [dihedral_change(x, points(q), F) for q in results]
            spreads = [spread(points(q), F) for q in results]
            rows += [(name, label, *numbers) for numbers in zip(ts, spreads, changes)]
            if kind == Proxy.BLEND:
                section.check(spreads == sorted(spreads, reverse=True),
                              f"{name}: the spread of radii falls with t",
                              ", ".join(f"{s:.3f}" for s in spreads))
                own = np.degrees(np.sqrt((dihedral_angles(x, F) ** 2).mean()))
                section.check(changes[-1] < 0.5 * own, f"{name}: at t = 0.2 angles between"
                              " neighboring triangles change by less than half of what they are,"
                              " rms",
                              f"{changes[-1]:.1f}° of {own:.1f}°")
        section.picture(name, panels)
    section.table("Blend", ["model", "transfer", "t", "spread of radii", "rms change of angles, °"],
                  rows)
    section.text("Eq. 5.18 scales every distance from the proxy by t, so that details flatten with"
                 " it (A8.23). Transfer Offset keeps the distances and turns them with the proxy.")


@experiment("A5.13", needs=PROXY, title="Car, enlarged along an axis", where="5.5, Fig. 5.5",
            claim="Results can be enlarged against the y and the z axis.")
def car_emphasis(section, context):
    rows = []
    for name, car in cars(context):
        plain = result(context, car)
        panels = [(plain, "t = 0.5")]
        for axis, letter in ((1, "y"), (2, "z")):
            gain = np.where(np.arange(3) == axis, 1.5, 1.0)
            enlarged = result(context, car, AxisGain=tuple(gain))
            panels.append((enlarged, f"enlarged along {letter}"))
            grown = np.ptp(points(enlarged), axis=0) / np.ptp(points(plain), axis=0)
            round_, stretched = (result(context, car, Blend=0.0, AxisGain=tuple(g))
                                 for g in (np.ones(3), gain))
            factor = np.ptp(points(stretched), axis=0) / np.ptp(points(round_), axis=0)
            rows += [(name, letter, 0.5, *grown), (name, letter, 0.0, *factor)]
            section.check(grown[axis] > 1.1 and np.delete(grown, axis).max() < 1.01,
                          f"{name}: at t = 0.5 a gain of 1.5 enlarges {letter} by more than a"
                          " tenth, the others by less than a hundredth",
                          ", ".join(f"×{g:.3f}" for g in grown))
            section.check(np.abs(factor - gain).max() < 1e-9, f"{name}: at t = 0 it enlarges"
                          f" {letter} by its 1.5 and nothing else, to 1e-9",
                          ", ".join(f"×{g:.3f}" for g in factor))
        section.picture(name, panels)
    section.table("Extents", ["model", "gain 1.5 along", "t", "x, times", "y, times", "z, times"],
                  rows, caption="Of the bounding box, over those without the gain")
    section.text("The thesis gives no formula. Here the rounded proxy is stretched from its center,"
                 " q'' = O + G (q' - O), before Eq. 5.18.")


def dense_on_sparse():
    """A cube whose top has 16 divisions on sides of 2: (model, triangles of the sides, points of
    the top's border)."""
    sides, top = (models.SHAPES["box"](divisions=3 * (n,)) for n in (2, 16))
    sides, top = (part(box_, (normals_of(points(box_), triangles(box_))[:, 1] > 0.9) == is_top)
                  for box_, is_top in ((sides, False), (top, True)))
    x, y = points(sides), points(top)
    border = len(x) + np.flatnonzero(np.abs(y[:, ::2]).max(axis=1) > 0.5 - 1e-9)
    model = surface(np.concatenate([x, y]),
                    np.concatenate([triangles(sides), triangles(top) + len(x)]))
    return model, triangles(sides), border


@experiment("A5.14", needs=PROXY, title="Cracks", where="5.5, Fig. 5.3-5.5",
            claim="Where the model is not connected, cracks and holes open in the results.")
def cracks(section, context):
    rows = []
    for name, car in cars(context):
        x = points(car)
        place = places(x)
        ways = [("direct, point by point", context.style(car,
                                                         WeldCoincidentPoints=False).GetOutput()),
                ("direct", context.style(car).GetOutput())]
        ways += [(f"proxy, t 0.2, {label}", result(context, car, Blend=0.2, **properties))
                 for label, properties in (
                     ("ClosestPoint", {}), ("SmallestAngle", {"Projection": Proxy.SMALLEST_ANGLE}),
                     ("NearestVertices", {"Projection": Proxy.NEAREST_VERTICES}),
                     ("Transfer Offset", {"Transfer": Proxy.OFFSET}))]
        for label, q in ways:
            gap = np.linalg.norm(points(q) - points(q)[place], axis=1).max() / diagonal(x)
            rows.append((name, int((place != np.arange(len(x))).sum()), label, 100.0 * gap))
        if name == "our car":
            section.picture("Cracks", [(car, "model"), *((q, label) for label, q in ways[:3])])
    section.table("Gaps", ["model", "points at the place of another", "method",
                           "largest gap, % of the diagonal"], rows)
    apart = max(row[3] for row in rows if row[2].endswith("point by point"))
    section.check(apart > 0.1, "cracks open when coincident points are moved one by one (more than"
                  " 0.1 % of the diagonal)", f"{apart:.1f} %")
    kept = max(row[3] for row in rows if not row[2].endswith("point by point"))
    section.check(kept > 0.0, "there they open with the filters' defaults, too",
                  f"largest gap {kept:g}: coincident points stay coincident to the last bit")
    model, sides, border = dense_on_sparse()
    ways = [("model", model),
            ("direct", context.style(model, CenterMode=Style.AREA_CENTROID).GetOutput()),
            ("proxy, t 0.2", result(context, model, Blend=0.2))]
    section.picture("Dense and sparse", [(q, label) for label, q in ways], wires=True, view=10.0)
    gaps = [distances(points(q)[border], surface(points(q), sides)).max() / diagonal(points(model))
            for _, q in ways]
    section.table("Dense and sparse parts", ["result", "largest gap, % of the diagonal"],
                  [(label, 100.0 * gap) for (label, _), gap in zip(ways, gaps)],
                  caption="A cube whose top has 16 divisions and whose sides have 2: from the"
                  " border of the top to the sides")
    section.check(min(gaps[1:]) > 1e-3, "cracks open where a dense part meets a sparse one,"
                  " directly and through the proxy (more than 0.1 % of the diagonal)",
                  f"{100.0 * gaps[1]:.1f} % and {100.0 * gaps[2]:.1f} %: dense points follow the"
                  " curve, the sparse edge stays straight")


def outer_sphere(context, model, t):
    """Each point on its way to the sphere around the model (4.6.2, Fig. 4.26)."""
    return context.run(SPHERE[0], model, Coefficient=1.0 - t, OutputPointsPrecision=1).GetOutput()


@experiment("A5.15", needs=PROXY + SPHERE, title="Stone house, hull against sphere",
            where="5.5, Fig. 5.6, 4.26",
            claim="At t = 0.5 the proxy keeps the shape of the stones better than the sphere around"
            " the model does.")
def house_details(section, context):
    house = context.model("stone-house")
    x, F = points(house), triangles(house)
    through = result(context, house)
    low, high = 0.0, 1.0  # the sphere's t of the same spread
    for _ in range(30):
        t = 0.5 * (low + high)
        rounder = spread(points(outer_sphere(context, house, t)), F) < spread(points(through), F)
        low, high = (t, high) if rounder else (low, t)
    results = [("proxy, t = 0.5", through), ("sphere around, t = 0.5",
                                             outer_sphere(context, house, 0.5)),
               (f"sphere around, as round, t = {t:.2f}", outer_sphere(context, house, t))]
    section.picture("House", [(house, "model"), *((q, label) for label, q in results)])
    changes = [dihedral_change(x, points(q), F) for _, q in results]
    section.table("House", ["result", "spread of radii", "rms change of angles, °",
                            "volume, times"],
                  [(label, spread(points(q), F), change, volume(points(q), F) / volume(x, F))
                   for (label, q), change in zip(results, changes)])
    for other, what in ((1, "the same t"), (2, "the same roundness")):
        section.check(changes[0] < changes[other], f"at {what}, angles between neighboring"
                      " triangles change less through the proxy",
                      f"{changes[0]:.1f}° against {changes[other]:.1f}°")


def door(x):
    """Points of the stone house's sunken door, and of the wall around it."""
    near = (np.abs(x[:, 0]) < 0.2) & (x[:, 1] < 0.36)
    return near & (x[:, 2] > 0.55) & (x[:, 2] < 0.63), near & (x[:, 2] > 0.63) & (x[:, 2] < 0.67)


@experiment("A5.16", "A5.17", needs=PROXY, title="Stone house, the door sinks",
            where="5.5, Fig. 5.6(b)",
            claim={"A5.16": "Points at the door are projected down, and the door gets a little more"
                   " concave; smallest angle first instead of shortest distance alleviates this.",
                   "A5.17": "So does a projection direction that the user sets for these points."})
def house_door(section, context):
    house = context.model("stone-house")
    x = points(house)
    panel, wall = door(x)
    ahead = np.where((panel | wall)[:, None], (0.0, 0.0, 1.0), 0.0)
    runs = [("shortest distance", proxied(context, house)),
            ("smallest angle", proxied(context, house, Projection=Proxy.SMALLEST_ANGLE)),
            ("directions", proxied(context, with_array(house, "Direction", ahead),
                                   Projection=Proxy.DIRECTION_ARRAY, arrays={1: (0, "Direction")}))]

    def depth(y):
        """How far the door lies behind the line that fits the wall from below to above."""
        line = np.polyfit(y[wall, 1], y[wall, 2], 1)
        return (np.polyval(line, y[panel, 1]) - y[panel, 2]).mean()

    rows = []
    for label, deform in runs:
        line = (feet(deform) - x)[panel | wall]
        down = -line[:, 1] > 0.7 * np.linalg.norm(line, axis=1)
        rows.append((label, int((panel | wall).sum()), int(down.sum()),
                     depth(points(deform.GetOutput())) / depth(x)))
    section.picture("Door", [(house, "model"), *((d.GetOutput(), label) for label, d in runs)],
                    view=0.0)
    near = (np.abs(x[:, 0]) < 0.45) & (x[:, 1] < 0.5) & (x[:, 2] > 0.5)
    flags = near[triangles(house)].all(axis=1)
    section.picture("Wall", [(part(q, flags), label) for q, label in (
        (house, "model"), *((d.GetOutput(), label) for label, d in runs))], view=35.0,
        caption="Only the wall around the door, from the side")
    section.table("Door", ["projection", "points at the door", "of these projected down",
                           "depth of the door, times"], rows,
                  caption="t = 0.5; depth: how far it lies behind the wall around, over that of the"
                  " model")
    shortest, smallest, directed = rows
    section.check(shortest[2] > 0, "with the shortest distance, points at the door are projected"
                  " down",
                  f"{shortest[2]} of {shortest[1]}", "A5.16")
    section.check(shortest[3] > 1.0, "the door gets deeper than it was", f"{shortest[3]:.2f} times",
                  "A5.16")
    section.check(shortest[3] > 0.5, "it stays deeper than Eq. 5.18 alone would leave it, t times",
                  f"{shortest[3]:.2f} times, t = 0.5", "A5.16")
    section.check(smallest[3] < shortest[3], "the door is less deep with the smallest angle",
                  f"{smallest[3]:.2f}", "A5.16")
    section.check(directed[3] < shortest[3], "the door is less deep with directions",
                  f"{directed[3]:.2f}", "A5.17")


# -------------------------------------------------------------------------------------- 5.5, bottle
@experiment("A5.18", "A5.19", "A5.20", needs=PROXY, title="Bottle, t along its axis",
            where="5.4, 5.5, Fig. 5.7", claim={
                "A5.18": "t is a function along an axis: quadratic on the whole bottle, linear and"
                " tanh on its lower part.",
                "A5.19": "Projection vectors are shown as short red lines.",
                "A5.20": "A part of the bottle is deformed; where t is 1 at its border, the"
                " connection is smooth."})
def bottle_functions(section, context):
    bottle = context.model("bottle")
    x, F = points(bottle), triangles(bottle)
    part = {"BlendRange": (0.0, 0.55)}
    whole, s = along_y(x), along_y(x, 0.0, 0.55)
    cases = [("quadratic, whole", {"BlendFunction": Proxy.QUADRATIC}, whole ** 2),
             ("linear, lower part", {"BlendFunction": Proxy.LINEAR, **part}, s),
             ("tanh, lower part", {"BlendFunction": Proxy.TANH, **part},
              0.5 * (1.0 + np.tanh(3.0 * (2.0 * s - 1.0)) / np.tanh(3.0))),
             ("smoothstep, lower part", {"BlendFunction": Proxy.SMOOTHSTEP, **part},
              s * s * (3.0 - 2.0 * s))]
    runs = [(label, proxied(context, bottle, **properties), t) for label, properties, t in cases]
    lines = runs[0][1].GetOutput(2)
    section.picture("Bottle", [(bottle, "projection", lines),
                               *((deform.GetOutput(), label) for label, deform, _ in runs)])
    order = np.argsort(whole)
    section.plot("t", {label: (whole[order], t[order]) for label, _, t in runs},
                 x="height, fraction", y="t")
    ends = whole[inner_edges(F)[0]]
    border = (ends.min(axis=1) <= 0.55) & (ends.max(axis=1) >= 0.55)
    rows = []
    for label, deform, t in runs:
        q = points(deform.GetOutput())
        bend = np.degrees(np.abs(dihedral_angles(q, F) - dihedral_angles(x, F)))[border].max()
        rows.append((label, np.abs(array(deform.GetOutput(), "t") - t).max(), int((t >= 1.0).sum()),
                     np.array_equal(q[t >= 1.0], x[t >= 1.0]), bend if "part" in label else None))
    section.table("Bottle", ["t", "largest error of t", "points with t = 1",
                             "which keep their bits",
                             "bend where the part ends, °"], rows)
    section.check(max(row[1] for row in rows) < 1e-12, "t is its formula to 1e-12",
                  f"{max(row[1] for row in rows):.1g}", "A5.18")
    section.check(lines.GetNumberOfLines() == len(x), "output 2 has a line per point",
                  str(lines.GetNumberOfLines()), "A5.19")
    section.check(all(row[3] for row in rows), "points with t = 1 keep their bits, so no gap opens",
                  row="A5.20")
    for row in rows[1:]:
        section.check(row[4] < 1.0, f"{row[0]}: the surface bends by less than 1° where the part"
                      " ends",
                      f"{row[4]:.1f}°", "A5.20")


@experiment("A5.21", needs=PROXY, title="The head alone", where="5.5, Fig. 5.8",
            claim="The head of a bunny is deformed with linear and quadratic t; with t = 1 at its"
            " border the connection is smooth.")
def head(section, context):
    creature = context.model("creature")
    x, y, _ = points(creature).T  # the head without the raised paw
    subjects = [("creature", creature, (y > 0.52) & ((x < 0.26) | (y > 0.78)))]
    bunny = None if context.small else context.real("bunny")
    if bunny:
        x, y, _ = ((points(bunny) - points(bunny).min(axis=0)) / np.ptp(points(bunny), axis=0)).T
        subjects.append(("bunny", bunny, (y > 0.55) & (x < 0.6)))
    rows = []
    for name, model, inside in subjects:
        x, F = points(model), triangles(model)
        runs = [(label, result(context, with_array(model, "Head", inside.astype(float)),
                               arrays={3: (0, "Head")}, BlendFunction=function,
                               BlendRange=(along_y(x)[inside].min(), 1.0), BlendAtStart=1.0,
                               BlendAtEnd=0.2))
                for label, function in (("linear", Proxy.LINEAR), ("quadratic", Proxy.QUADRATIC))]
        section.picture(name, [[(model, "model", None, view),
                                *((q, f"head, {label}", None, view) for label, q in runs)]
                               for view in (25.0, 100.0)])
        ends = inside[inner_edges(F)[0]]
        border = ends.any(axis=1) & ~ends.all(axis=1)
        for label, q in runs:
            y = points(q)
            bend = np.degrees(np.abs(dihedral_angles(y, F) - dihedral_angles(x, F)))[border].max()
            rows.append((name, label, int(inside.sum()), np.array_equal(y[~inside], x[~inside]),
                         100.0 * np.linalg.norm(y - x, axis=1).max() / diagonal(x), bend))
    section.table("Head", ["model", "t", "points of the head", "others keep their bits",
                           "largest displacement, % of the diagonal", "bend at the border, °"],
                  rows)
    section.check(all(row[3] for row in rows), "points outside of the head keep their bits")
    section.check(min(row[4] for row in rows) > 1.0, "the head moves by more than 1 % of the"
                  " diagonal",
                  f"at least {min(row[4] for row in rows):.1f} %")
    section.check(max(row[5] for row in rows) < 1.0, "the surface bends by less than 1° at the"
                  " border",
                  f"at most {max(row[5] for row in rows):.2f}°")


# ---------------------------------------------------------------------------------- limits, 5.4-5.6
def unit(model):
    """A copy scaled to diagonal 1, for pictures of several models."""
    return moved(model, points(model) / diagonal(points(model)))


@experiment("A5.22", needs=PROXY, title="Models that are about convex", where="5.4",
            claim="Projection lines hardly cross on models that are about convex; on complex ones"
            " nothing is guaranteed.")
def convexity(section, context):
    subjects = [(name, context.model(name)) for name in ("go-stone", "bottle", "stone-house",
                                                         "creature")]
    if not context.small:
        subjects += [(name, context.real(name)) for name in ("spot", "armadillo")
                     if context.real(name)]
    rows, panels = [], []
    for name, model in subjects:
        nearest = proxied(context, model, Blend=0.2)
        angle = proxied(context, model, Blend=0.2, Projection=Proxy.SMALLEST_ANGLE)
        x, q = points(model), feet(nearest)
        u, v = edge_weights(x, triangles(model))[0].T
        parted = (np.linalg.norm(q[u] - q[v], axis=1) > 5.0 * np.linalg.norm(x[u] - x[v],
                                                                             axis=1)).mean()
        count = 0.01 * model.GetNumberOfCells()
        rows.append((name, nearest.GetConvexityRatio(), 100.0 * parted,
                     nearest.GetTrianglesTurnedOver() / count,
                     angle.GetTrianglesTurnedOver() / count))
        panels.append((unit(nearest.GetOutput()), name, None, 205.0 if name == "spot" else 25.0))
    section.picture("At t = 0.2", panels, columns=3, caption="ClosestPoint, all of one size")
    rows.sort(key=lambda row: -row[1])
    section.table("Convexity", ["model", "volume / volume of the hull", "edges whose feet part, %",
                                "triangles turned over at t = 0.2, %", "with SmallestAngle, %"],
                  rows,
                  caption="Feet part: they lie more than 5 times as far from each other as the"
                  " points")
    section.text("Lines to the nearest point never cross, on no model: where two of them met, both"
                 " points would be nearest. What happens away from convex is that neighbors get"
                 " feet on different sides of the hull, and the surface between them is stretched.")
    section.text("With SmallestAngle lines do cross, and triangles turn over.")
    convex, least = rows[0], rows[-1]
    section.check(max(convex[2:]) < 0.1, "on the most convex model less than 0.1 % of the edges"
                  " have feet that part, and of the triangles turn over, with both projections",
                  f"{convex[0]}: {convex[2]:.2f}, {convex[3]:.2f} and {convex[4]:.2f} %")
    section.check(least[2] > 0.5, "on the least convex one more than 0.5 % of the edges have feet"
                  " that part", f"{least[0]}: {least[2]:.2f} %")
    section.check(least[4] > 0.5, "and more than 0.5 % of its triangles turn over with"
                  " SmallestAngle",
                  f"{least[4]:.2f} %")


def box(x, y, z):
    source = vtkCubeSource()
    source.SetXLength(x)
    source.SetYLength(y)
    source.SetZLength(z)
    source.Update()
    return source.GetOutput()


@experiment("A5.23", needs=PROXY, title="Thin rims", where="5.6",
            claim="Where the hull is thin, as at a fish's fin, ball pivoting leaves holes or"
            " overlaps.")
def thin_rims(section, context):
    count = context.choose(1500, 5000)
    stone = context.model("go-stone")
    subjects = [("plate, 1 × 1 × 0.02", box(1.0, 1.0, 0.02)),
                ("plate, 1 × 1 × 0.005", box(1.0, 1.0, 0.005)),
                ("needle, 1 × 0.02 × 0.02", box(1.0, 0.02, 0.02)),
                ("go stone, 22 times flatter", moved(stone, points(stone) * (1.0, 1.0, 0.045)))]
    rows = []
    for name, model in subjects:
        for mesher in ("BallPivoting", "AdvancingFront", "IsotropicRemeshing"):
            deform, _, measures = proxy_of(context, model, MESHERS[mesher], count)
            rows.append((name, mesher, deform.GetEffectiveProxyMesher() == MESHERS[mesher],
                         *measures[:4]))
    section.table("Thin hulls", ["hull", "mesher", "in one closed piece", "points",
                                 "open edges",
                                 "Euler characteristic", "angles above 25°, %"], rows,
                  caption="Where a mesher fails, the proxy is that of IsotropicRemeshing")
    failed = [row[0] for row in rows if row[1] == "BallPivoting" and not row[2]]
    section.check(failed, "ball pivoting fails on some of the thin hulls",
                  ", ".join(failed) or "on none")
    closed = sum(row[4] == 0 and row[5] == 2 for row in rows)
    section.check(closed == len(rows), "the filter notices, warns and remeshes the hull itself:"
                  " every proxy is closed and of the topology of a ball",
                  f"{closed} of {len(rows)}")


@experiment("A5.24", needs=PROXY, title="Only a complement", where="5.1, 6.1",
            claim="The proxy complements the direct method, for obtuse triangles; it does not"
            " replace it.")
def complement(section, context):
    rows = []
    for name in ("creature", "stone-house", "car"):
        model = context.model(name)
        x, F = points(model), welded(model)
        through = result(context, model)
        wanted = spread(points(through), F)
        thesis, _ = as_round_as(context, model, F, wanted, ReproduceThesis=True)
        ours, roundness = as_round_as(context, model, F, wanted)
        section.picture(name, [(model, "model"), (thesis, "direct, thesis"), (ours, "direct, ours"),
                               (through, "proxy, t 0.5")], caption="At equal roundness")
        rows.append((name, 100.0 * obtuse(x, F).mean(), roundness,
                     *(dihedral_change(x, points(q), F) for q in (thesis, ours, through))))
    section.table("Both methods", ["model", "obtuse triangles, %", "λ, direct, ours",
                                   "direct, thesis, °", "direct, ours, °", "proxy, t 0.5, °"], rows,
                  caption="Rms change of the angles between neighboring triangles")
    even, *rough = rows
    section.check(even[3] < even[5], "on even triangles the direct method keeps details better",
                  f"{even[3]:.1f}° against {even[5]:.1f}°")
    for name, _, _, thesis, ours, through in rough:
        section.check(through < thesis, f"{name}: on obtuse triangles the proxy keeps them better"
                      " than the thesis' direct method", f"{through:.1f}° against {thesis:.1f}°"
                      f" ({ours:.1f}° directly with weights per triangle)")
