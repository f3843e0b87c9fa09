# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Claims that only real models can show, measured and checked.

usage: TestSphericalStyleFilterModels.py [--models DIR] [section ...]

Sections: energy nonlinear thesis converged sphere blend parts foldguard. The rest is as ModelTesting.py says.
"""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from sphericalstyle import (
    presets, vtkNonlinearStyleFilter, vtkSphericalStyleFilter, vtkSurfaceMetrics, vtkThesisStyleFilter,
)

from ModelTesting import ENERGY, check, main, read

LAMBDAS = (0.1, 0.5, 5.0)


def style(surface, **properties):
    """The filter on a surface, executed, in double precision, with one ball as the target of the model as it is."""
    f = vtkThesisStyleFilter()
    f.SetInputData(surface)
    f.SetOutputPointsPrecision(1)
    for name, value in {**ENERGY, "SphericalWeighting": 1, **properties}.items():
        getattr(f, "Set" + name)(value)
    f.Update()
    return f


UNIFORM = {"SphericalWeighting": 0}  # iterates, where cotangent weights have a closed form


def column(f, name):
    return vtk_to_numpy(f.GetOutputDataObject(1).GetColumnByName(name)).astype(float)


def rest_energy(f):
    """E_0: what the start began from."""
    return column(f, "Total")[0] - column(f, "GlobalChange")[0]


def points(surface):
    return vtk_to_numpy(surface.GetPoints().GetData()).astype(float)


def triangles(surface):
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def minimum(surface, **properties):
    """E* of a run to 1e-12."""
    f = style(surface, Tolerance=1e-12, MaximumNumberOfIterations=3000, **properties)
    return column(f, "Total").min()


# -- energy never rises ---------------------------------------------------------------------------
def energy():
    worst = 0.0
    for name in ("spot", "bunny", "nefertiti", "boot", "human-parts", "demosthenes-bust", "plane-holes"):
        surface = read(name)
        here = -np.inf
        for a in (0.0, 0.5, 1.0):
            for l in LAMBDAS:
                for plain in (0, 1):
                    f = style(surface, Roundness=l, NormalBlend=a, StopRule=2 * plain, Tolerance=1e-14,
                              MaximumNumberOfIterations=15, **UNIFORM)
                    total = column(f, "Total")
                    local, glob = column(f, "LocalChange"), column(f, "GlobalChange")
                    here = max(here, (np.diff(total) / total[1:]).max(), (local / total).max(), (glob / total).max())
        print(f"  {name:18s} largest relative rise of any step {here:9.2e}")
        worst = max(worst, here)
    check(worst < 1e-12, "energy rises in no step (1e-12 of itself)")


# -- chapter 3 ------------------------------------------------------------------------------------
def fixed(surface, iterations=30, **properties):
    """Of chapter 3, with the thesis' center."""
    f = vtkNonlinearStyleFilter()
    f.SetInputData(surface)
    f.SetOutputPointsPrecision(1)
    f.SetCenterModeToPointMean()
    f.SetStopRuleToFixedIterations()
    f.SetMaximumNumberOfIterations(iterations)
    for name, value in properties.items():
        getattr(f, "Set" + name)(value)
    f.Update()
    return f


def rises(f, name):
    """In how many iterations a column of changes is above rounding."""
    return int((column(f, name)[1:] > 1e-12 * rest_energy(f)).sum())


def nonlinear():
    for name in ("our-go-stone", "our-stone-house", "spot", "bunny"):
        surface = read(name)
        for l in (0.1, 1.0, 5.0):
            f = fixed(surface, Roundness=l)
            total = column(f, "Total")
            count = [rises(f, c) for c in ("LocalChange", "GlobalChange")] + [
                int((np.diff(total) > 1e-12 * rest_energy(f)).sum())]
            print(f"  {name:12s} lambda {l:<4g} corrected: E {rest_energy(f) / total[-1]:8.1f} times smaller after 30 "
                  f"iterations; local, global steps and totals that rise: {count}")
            check(sum(count) == 0, f"{name}, lambda {l}: the energy falls in each of 30 iterations")
    for name in ("our-go-stone", "our-stone-house"):
        f = fixed(read(name), Roundness=0.1, CenterConstraint=1)
        steps = rises(f, "GlobalChange")
        totals = int((np.diff(column(f, "Total")) > 1e-12 * rest_energy(f)).sum())
        print(f"  {name:12s} lambda 0.1  as written: {steps} global steps and {totals} totals of 30 rise")
        check((steps > 0) == (totals > 0) == (name == "our-stone-house"), f"{name}: as written")


# -- the thesis' own rule -------------------------------------------------------------------------
def thesis():
    for name in ("our-go-stone", "our-icosahedron", "spot"):
        surface = read(name)
        for a in (0.0, 1.0):
            counts = []
            for l in LAMBDAS:
                f = style(surface, Roundness=l, NormalBlend=a, ReproduceThesis=1)
                residual = column(f, "Residual")
                check(residual[-1] < 1e-3 <= residual[1:-1].min(initial=1.0), f"{name} stops at the first res < .001 (Eq. 3.46)")
                counts.append(f.GetNumberOfIterations())
            print(f"  {name:18s} a = {a:g}: iterations at lambda .1/.5/5: {counts}")


# -- Converged means converged --------------------------------------------------------------------
def converged():
    for name in ("spot", "bunny", "nefertiti"):
        surface = read(name)
        for l in LAMBDAS:
            low = minimum(surface, Roundness=l, **UNIFORM)
            row = []
            for accelerated in (1, 0):
                f = style(surface, Roundness=l, Acceleration=accelerated, MaximumNumberOfIterations=2000,
                          **UNIFORM)
                gap = (column(f, "Total")[-1] - low) / (rest_energy(f) - low)
                check(f.GetConverged() and f.GetNumberOfIterations() > 0 and gap < 2e-4, f"{name} lambda {l}: true gap {gap:.2e} below twice the tolerance")
                row.append(f"{f.GetNumberOfIterations():4d} iterations, gap {gap:.1e}")
            print(f"  {name:18s} lambda {l:<4g} accelerated {row[0]}; plain {row[1]}")


# -- a ball at the end ----------------------------------------------------------------------------
def sphere():
    for name in ("our-go-stone", "our-cuboid", "our-stone-house"):
        f = style(read(name), Roundness=50.0)
        x = points(f.GetOutput())
        # least-squares sphere: |x|^2 = 2 c.x + (r^2 - |c|^2)
        solution = np.linalg.lstsq(np.c_[2 * x, np.ones(len(x))], (x**2).sum(1), rcond=None)[0]
        fitted = np.sqrt(solution[3] + (solution[:3] ** 2).sum())
        ratio = fitted / f.GetEffectiveRadius()
        print(f"  {name:18s} lambda 50: fitted radius / r = {ratio:.5f}")
        check(abs(ratio - 1.0) < 0.005, f"{name}: fitted radius within .5 % of r")
    box = read("our-cube")
    rest = points(box)
    high = rest[:, 2].max()
    middle = rest[:, :2].mean(axis=0)
    top = np.flatnonzero(rest[:, 2] == high)
    center = top[np.argmin(((rest[top, :2] - middle) ** 2).sum(1))]
    corners = top[np.argsort(-((rest[top, :2] - middle) ** 2).sum(1))[:4]]
    half = (high - rest[:, 2].min()) / 2
    for z in (-0.6, 0.0, 0.6, 0.9, 1.5, 3.0):
        o = (middle[0], middle[1], high - half + 2 * half * z / 2)
        f = style(box, Roundness=2.0, CenterMode=2, Center=o)
        q = points(f.GetOutput())
        sag = (q[center, 2] - q[corners, 2].mean()) / f.GetEffectiveRadius()
        print(f"  cube, center at {z:4g} half heights: sag of the top / r = {sag:6.3f}")
        check((sag > 0) == (z < 1.0), "top convex with the center inside, concave outside")


# -- the closed form [blend] and the start --------------------------------------------------------
def blend():
    for name in ("spot", "wingnut"):
        surface = read(name)
        f = style(surface, SphericalWeighting=1)
        check(f.GetNumberOfIterations() == 0 and f.GetConverged(), "the closed form needs no iteration")
        start = style(surface, SphericalWeighting=1, StopRule=2, MaximumNumberOfIterations=0)
        apart = np.abs(points(start.GetOutput()) - points(f.GetOutput())).max() / surface.GetLength()
        check(apart < 1e-10, f"{name}: the closed form is where the energy starts from, to {apart:.1e} diagonals")
        closed = start.GetFinalEnergy()
        g = style(surface, SphericalWeighting=1, InitialGuess=1, Tolerance=1e-12, MaximumNumberOfIterations=5000)
        off = abs(g.GetFinalEnergy() - closed) / closed
        print(f"  {name:18s} cotangent weights from Rest: {g.GetNumberOfIterations()} iterations, energy off the blend's by {off:.1e}")
        check(off < 1e-8, f"{name}: the solver reaches the blend's energy to 1e-8")
    surface = read("spot")
    for l in LAMBDAS:
        low = minimum(surface, Roundness=l, **UNIFORM)
        f = style(surface, Roundness=l, StopRule=2, MaximumNumberOfIterations=3, **UNIFORM)
        total = column(f, "Total")
        gaps = [(total[k] - low) / (rest_energy(f) - low) for k in (0, 1, 3)]
        print(f"  spot lambda {l:<4g} gap from Blend after 0/1/3 iterations: " + " ".join(f"{x:.1e}" for x in gaps))


# -- parts ----------------------------------------------------------------------------------------
def parts_of(surface):
    """The smallest point id of each point's part."""
    F, ids = triangles(surface), np.arange(surface.GetNumberOfPoints())
    while True:
        smaller = ids.copy()
        for k in range(3):
            np.minimum.at(smaller, F[:, k], ids[F].min(axis=1))
        if (smaller == ids).all():
            return ids
        ids = smaller


def parts():
    surface = read("human-parts")
    x, ids = points(surface), parts_of(surface)
    diagonal = surface.GetLength()
    head, *eyes = sorted(set(ids), key=lambda part: -(ids == part).sum())
    check(len(eyes) == 2, "the person has two eyes")
    skin = np.flatnonzero(ids == head)
    pairs = []  # of an eye's points that lie near the skin, and the nearest of the skin
    for eye in eyes:
        own = np.flatnonzero(ids == eye)
        distance = np.linalg.norm(x[own][:, None] - x[skin][None], axis=2)
        near = distance.min(axis=1) < 0.003 * diagonal
        pairs.append((own[near], skin[distance.argmin(axis=1)[near]]))
    eye, skin = np.hstack(pairs)


    def apart(**properties):
        q = points(style(surface, **properties).GetOutput())
        return np.linalg.norm(q[eye] - q[skin], axis=1).max() / diagonal

    for l in LAMBDAS:
        stitched, independent = (apart(Roundness=l, ComponentCoupling=coupling, **UNIFORM) for coupling in (0, 1))
        print(f"  human-parts, uniform weights, lambda {l:<4g} eyes at most .003 diagonals from the skin: stitched "
              f"{stitched:.4f}, independent {independent:.4f}")
        check(stitched < 0.004 < independent, "stitched eyes stay in the head, independent ones leave it")
        # Without details each eye goes along normals of its own.
        for size, blend in ((0.0, 0.0), (0.03, 0.0), (0.03, 0.6), (0.06, 0.6)):
            closed = apart(Roundness=l, DetailSize=size, NormalBlend=blend, NormalRadius=0)
            print(f"    in closed form, DetailSize {size:<4g} NormalBlend {blend:g}: {closed:.4f}")
            check(closed < 0.004, "in closed form the eyes stay in the head")


# -- no folds -------------------------------------------------------------------------------------
def measures(surface, reference):
    """The numbers of vtkSurfaceMetrics."""
    f = vtkSurfaceMetrics()
    f.SetInputData(surface)
    f.SetReferenceData(reference)
    f.Update()
    columns = (f.GetOutputDataObject(1).GetColumn(i) for i in range(f.GetOutputDataObject(1).GetNumberOfColumns()))
    return {c.GetName(): c.GetValue(0) for c in columns if c.GetNumberOfComponents() == 1}


def stretched(surface, factors):
    copy = vtkPolyData()
    copy.DeepCopy(surface)
    moved = vtkPoints()
    moved.SetData(numpy_to_vtk(np.ascontiguousarray(points(surface) * factors), deep=True))
    copy.SetPoints(moved)
    return copy


def area_weights(surface):
    """Share of the area at each point, a third of each triangle to each corner."""
    x, F = points(surface), triangles(surface)
    areas = np.linalg.norm(np.cross(x[F[:, 1]] - x[F[:, 0]], x[F[:, 2]] - x[F[:, 0]]), axis=1)
    weights = sum(np.bincount(F[:, k], areas, len(x)) for k in range(3))
    return weights / weights.sum()


def without_and_with_guard(name, preset):
    """The model, the filter with the guard, the measures without and with it, the points without."""
    surface = read(name)
    f = vtkSphericalStyleFilter()
    f.SetInputData(surface)
    f.SetOutputPointsPrecision(1)
    presets.apply(f, preset)
    f.Update()
    before = measures(f.GetOutput(), surface)
    unguarded = points(f.GetOutput()).copy()
    f.AvoidSelfIntersectionsOn()
    f.Update()
    return surface, f, before, measures(f.GetOutput(), surface), unguarded


def guarded_preset(name, preset):
    """Less roundness alone, and so gently that edges bend hardly more than without the guard."""
    surface, f, before, after, _ = without_and_with_guard(name, preset)
    field = f.GetOutputDataObject(1).GetFieldData()
    shares = vtk_to_numpy(f.GetOutput().GetPointData().GetArray("RemainingRoundness")) / f.GetRoundness()
    print(f"  {name}, {preset}: new pairs {before['NewSelfIntersectionPairs']} -> {after['NewSelfIntersectionPairs']}; "
          f"of lambda remain {100 * (area_weights(surface) * shares).sum():.2g} % in the mean, "
          f"{100 * shares.min():.2g} % at least; edges bend by {before['DihedralChange']:.1f} -> "
          f"{after['DihedralChange']:.1f} degrees; sphericity {before['Sphericity']:.3f} -> {after['Sphericity']:.3f}; "
          f"{field.GetAbstractArray('GuardSolves').GetValue(0)} solves, "
          f"{field.GetAbstractArray('GuardSeconds').GetValue(0):.1f} s")
    check(before["NewSelfIntersectionPairs"] > 0, f"{name}, {preset}: unguarded it folds")
    check(after["NewSelfIntersectionPairs"] == 0 and after["TurnedOver"] == 0, f"{name}, {preset}: no fold is left")
    check(after["DihedralChange"] < 1.1 * before["DihedralChange"], f"{name}, {preset}: nothing is crumpled")


def repaired_preset(name, preset):
    """Folds in small places alone: they are repaired, all of lambda stays, all other points have their bits."""
    surface, f, before, after, unguarded = without_and_with_guard(name, preset)
    field = f.GetOutputDataObject(1).GetFieldData()
    shares = vtk_to_numpy(f.GetOutput().GetPointData().GetArray("RemainingRoundness")) / f.GetRoundness()
    lengths = np.linalg.norm(points(f.GetOutput()) - unguarded, axis=1)
    repaired = field.GetAbstractArray("GuardRepairedPoints").GetValue(0)
    print(f"  {name}, {preset}: turned over {before['TurnedOver']} -> {after['TurnedOver']}, new pairs "
          f"{before['NewSelfIntersectionPairs']} -> {after['NewSelfIntersectionPairs']}; {repaired} of {len(lengths)} "
          f"points moved, by up to {100 * lengths.max() / surface.GetLength():.2g} % of the diagonal; "
          f"{field.GetAbstractArray('GuardSeconds').GetValue(0):.1f} s")
    check(before["TurnedOver"] + before["NewSelfIntersectionPairs"] > 0, f"{name}, {preset}: unguarded it folds")
    check(after["NewSelfIntersectionPairs"] == 0 and after["TurnedOver"] == 0, f"{name}, {preset}: no fold is left")
    check(shares.min() == 1.0 and field.GetAbstractArray("GuardSolves").GetValue(0) == 1,
          f"{name}, {preset}: all of lambda stays")
    check(0 < (lengths > 0.0).sum() <= repaired < 0.01 * len(lengths), f"{name}, {preset}: few points move")


def foldguard():
    for name, preset in (("our-creature", "Toy"), ("our-creature", "Chibi"), ("our-creature", "Ball"),
                         ("armadillo", "Chibi"), ("armadillo", "Chubby"), ("bunny", "Toy")):
        guarded_preset(name, preset)
    for name, preset in (("demosthenes-bust", "Chubby"), ("lucy", "Soft"), ("nefertiti", "Chibi"), ("skull", "Soft"),
                         ("wingnut", "Chubby")):
        repaired_preset(name, preset)
    for name in ("our-tetrahedron", "our-tangram-prism", "our-stone-house", "spot", "bunny"):
        surface = read(name)
        if name == "our-tetrahedron":
            name, surface = "stretched tetrahedron", stretched(surface, (1.8, 1.0, 0.3))
        settings = dict(Roundness=5.0, NormalBlend=1.0, OutputPointsPrecision=2)
        rest, before = measures(surface, surface), measures(style(surface, **settings).GetOutput(), surface)
        f = style(surface, AvoidSelfIntersections=1, **settings)
        after = measures(f.GetOutput(), surface)
        field = f.GetOutputDataObject(1).GetFieldData()
        shares = vtk_to_numpy(f.GetOutput().GetPointData().GetArray("RemainingRoundness")) / 5.0
        mean = (area_weights(surface) * shares).sum()
        print(f"  {name}: turned over {before['TurnedOver']} -> {after['TurnedOver']}, new pairs "
              f"{before['NewSelfIntersectionPairs']} -> {after['NewSelfIntersectionPairs']}; of lambda remain "
              f"{100 * mean:.2g} % in the mean, {100 * shares.min():.2g} % at least; sphericity at rest "
              f"{rest['Sphericity']:.3f}, unguarded {before['Sphericity']:.3f}, guarded {after['Sphericity']:.3f}; "
              f"{field.GetAbstractArray('GuardSolves').GetValue(0)} solves, "
              f"{field.GetAbstractArray('GuardSeconds').GetValue(0):.1f} s")
        folds = before["TurnedOver"] + before["NewSelfIntersectionPairs"] > 0
        check(folds or name == "stretched tetrahedron", f"{name}: unguarded it folds")
        check(after["TurnedOver"] == 0, f"{name}: no triangle turned over")
        check(after["NewSelfIntersectionPairs"] == 0, f"{name}: no new intersection")
        check((f.GetTurnedOverBefore(), f.GetNewIntersectionsBefore())
              == (before["TurnedOver"], before["NewSelfIntersectionPairs"]), f"{name}: counts of the filter")

        if not folds:
            check(shares.min() == 1.0 and not f.GetTurnedOverBefore(), f"{name}: nothing is taken where nothing folds")
            continue
        # The largest lambda without folds that is the same everywhere, within a factor of 1.2.
        low, high = 1e-4, 1.0
        while high > 1.2 * low:
            share = np.sqrt(low * high)
            m = measures(style(surface, **{**settings, "Roundness": 5.0 * share}).GetOutput(), surface)
            low, high = (low, share) if m["TurnedOver"] + m["NewSelfIntersectionPairs"] > 0 else (share, high)
        print(f"    one lambda for all points: {100 * low:.2g} %, {mean / low:.1f} times less")
        check(mean > high, f"{name}: more remains than of one lambda for all")


main({"energy": energy, "nonlinear": nonlinear, "thesis": thesis, "converged": converged, "sphere": sphere,
      "blend": blend, "parts": parts, "foldguard": foldguard})
