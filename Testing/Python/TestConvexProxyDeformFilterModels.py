# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Claims about vtkConvexProxyDeformFilter that only real models can show, measured and checked.

usage: TestConvexProxyDeformFilterModels.py [--models DIR] [section ...]

Sections: meshers car cases region house. The rest is as ModelTesting.py says.
"""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkFeatureEdges
from vtkmodules.vtkFiltersModeling import vtkHausdorffDistancePointSetFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource

from sphericalstyle import vtkConvexProxyDeformFilter, vtkSphericalStyleFilter

import ModelTesting
from ModelTesting import ENERGY, check, main

MESHERS = ("IsotropicRemeshing", "BallPivoting", "AdvancingFront", "SubdividedHull")


def box(name, x, y, z):
    source = vtkCubeSource()
    source.SetXLength(x)
    source.SetYLength(y)
    source.SetZLength(z)
    source.Update()
    return source.GetOutput()


def read(name):
    """A model as ModelTesting reads it, or a box."""
    if name == "plate":
        return box(name, 1.0, 1.0, 0.02)
    if name == "needle":
        return box(name, 1.0, 0.02, 0.02)
    return ModelTesting.read(name)


def run(filter_class, surface, **properties):
    """The filter on a surface, executed, in double precision."""
    f = filter_class()
    f.SetInputData(surface)
    f.SetOutputPointsPrecision(1)
    for name, value in properties.items():
        setter = getattr(f, "Set" + name)
        setter(*value) if isinstance(value, tuple) else setter(value)
    f.Update()
    return f


def proxy_deform(surface, **properties):
    """Of the points that the model has, so that they can be held against it."""
    return run(vtkConvexProxyDeformFilter, surface, **{"RefineLongEdges": 0, **properties})


def points(surface):
    return vtk_to_numpy(surface.GetPoints().GetData()).astype(float)


def triangles(surface):
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def rest(proxy):
    """The proxy before it was rounded."""
    surface = vtkPolyData()
    surface.ShallowCopy(proxy)
    copy = proxy.GetPoints().NewInstance()
    copy.SetData(proxy.GetPointData().GetArray("RestPosition"))
    surface.SetPoints(copy)
    return surface


def diagonal(surface):
    return np.linalg.norm(np.ptp(points(surface), axis=0))


def angles(x, F):
    """The angles of all triangles, degrees."""
    result = []
    for k in range(3):
        a, b = x[F[:, (k + 1) % 3]] - x[F[:, k]], x[F[:, (k + 2) % 3]] - x[F[:, k]]
        result.append(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), (a * b).sum(1))))
    return np.concatenate(result)


def open_edges(surface):
    """Edges with one triangle or with more than two."""
    edges = vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.FeatureEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


def hausdorff(a, b):
    distance = vtkHausdorffDistancePointSetFilter()
    distance.SetInputData(0, a)
    distance.SetInputData(1, b)
    distance.SetTargetDistanceMethodToPointToCell()
    distance.Update()
    return distance.GetHausdorffDistance()


# -- proxy meshers --------------------------------------------------------------------------------
def meshers():
    print(f"  {'model':12s} {'mesher':20s} {'made by':20s} {'asked':>6s} {'got':>6s} open  chi  "
          "deviation  >25 deg  least angle")
    for name in ("car", "boot", "armadillo", "koala", "our-bottle", "plate", "needle"):
        surface = read(name)
        thin = name in ("plate", "needle")
        hull = rest(proxy_deform(surface, ProxyMesher=3, NumberOfProxyPoints=30000).GetOutput(1))
        for number, mesher in enumerate(MESHERS):
            f = proxy_deform(surface, ProxyMesher=number)
            proxy = rest(f.GetOutput(1))
            x, F = points(proxy), triangles(proxy)
            made = f.GetEffectiveProxyMesher()
            deviation = hausdorff(proxy, hull) / diagonal(surface)
            corners = angles(x, F)
            good = (corners > 25.0).mean()
            euler = len(x) - len(F) // 2
            open_count = open_edges(proxy)
            print(f"  {name:12s} {mesher:20s} {MESHERS[made]:20s} {5000:6d} {len(x):6d} {open_count:4d} "
                  f"{euler:4d}  {deviation:9.5f}  {100 * good:6.2f}%  {corners.min():11.3f}")
            check(open_count == 0 and euler == 2, f"{name}, {mesher}: closed and manifold")
            check(deviation < 0.015, f"{name}, {mesher}: within 1.5 % of the hull")
            if number == 0:
                check(made == 0, f"{name}: the default mesher works")
                check(thin or good >= 0.95, f"{name}: 95 % of the angles above 25 degrees")
                check(abs(len(x) - 5000) <= 500, f"{name}: as many points as asked for, about")


# -- direct against proxy -------------------------------------------------------------------------
def dihedral_angles(x, F):
    """Signed angle between the two triangles of each inner edge of a welded mesh, radians."""
    normals = np.cross(x[F[:, 1]] - x[F[:, 0]], x[F[:, 2]] - x[F[:, 0]])
    lengths = np.linalg.norm(normals, axis=1)
    normals = normals / np.where(lengths > 0.0, lengths, 1.0)[:, None]
    half = np.sort(np.concatenate([F[:, (0, 1)], F[:, (1, 2)], F[:, (2, 0)]]), axis=1)
    owner = np.tile(np.arange(len(F)), 3)
    order = np.lexsort((half[:, 1], half[:, 0]))
    half, owner = half[order], owner[order]
    first = np.flatnonzero((half[1:] == half[:-1]).all(axis=1))
    a, b = owner[first], owner[first + 1]
    edge = x[half[first, 1]] - x[half[first, 0]]
    edge /= np.linalg.norm(edge, axis=1)[:, None]
    cosine = (normals[a] * normals[b]).sum(1)
    sine = (np.cross(normals[a], normals[b]) * edge).sum(1)
    return np.arctan2(sine, cosine)


def welded(surface):
    """Triangles over places instead of points; without those that have no area."""
    x, F = points(surface), triangles(surface)
    _, place = np.unique(x, axis=0, return_inverse=True)
    first = np.full(place.max() + 1, -1)
    first[place[::-1]] = np.arange(len(x))[::-1]
    F = first[place[F]]
    return F[angles(x, F).reshape(3, -1).min(axis=0) > 1e-3]


def spread(x, F):
    """Standard deviation over mean of the distances from the area centroid, by area."""
    area = 0.5 * np.linalg.norm(np.cross(x[F[:, 1]] - x[F[:, 0]], x[F[:, 2]] - x[F[:, 0]]), axis=1)
    middle = x[F].mean(axis=1)
    center = np.average(middle, axis=0, weights=area)
    radius = np.linalg.norm(middle - center, axis=1)
    mean = np.average(radius, weights=area)
    return np.sqrt(np.average((radius - mean) ** 2, weights=area)) / mean


def direct_of_spread(surface, F, wanted, **properties):
    """The direct filter's points at the Roundness of the same spread, by bisection."""
    low, high = 0.01, 50.0
    for _ in range(20):
        middle = np.sqrt(low * high)
        q = points(run(vtkSphericalStyleFilter, surface,
                       **{**ENERGY, "SphericalWeighting": 1, "Roundness": middle, **properties}).GetOutput())
        low, high = (middle, high) if spread(q, F) > wanted else (low, middle)
    return q, middle


def car():
    for name in ("our-car", "car"):
        surface = read(name)
        x, F = points(surface), welded(surface)
        before = dihedral_angles(x, F)
        proxied = points(proxy_deform(surface).GetOutput())
        wanted = spread(proxied, F)

        def change(q):
            turned = dihedral_angles(q, F) - before
            return np.degrees(np.sqrt((((turned + np.pi) % (2 * np.pi) - np.pi) ** 2).mean()))

        direct, roundness = direct_of_spread(surface, F, wanted)
        thesis, thesis_roundness = direct_of_spread(surface, F, wanted, ReproduceThesis=1)
        print(f"  {name:8s} spread: model {spread(x, F):.4f}, proxy t .5 {wanted:.4f}, direct Roundness {roundness:.3f} "
              f"{spread(direct, F):.4f}, as in the thesis {thesis_roundness:.3f} {spread(thesis, F):.4f}")
        print(f"  {name:8s} rms change of dihedral angles, degrees: proxy {change(proxied):.2f}, direct "
              f"{change(direct):.2f}, as in the thesis {change(thesis):.2f}")
        check(abs(spread(direct, F) - wanted) < 0.02 * wanted, f"{name}: the roundness is matched")
        check(change(proxied) < change(thesis), f"{name}: the proxy's surface is smoother than the thesis' direct one")
        spreads = [spread(points(proxy_deform(surface, Blend=t).GetOutput()), F) for t in (1.0, 0.8, 0.5, 0.2)]
        print(f"  {name:8s} spread at t 1, .8, .5, .2: " + " ".join(f"{s:.4f}" for s in spreads))
        check(spreads == sorted(spreads, reverse=True), f"{name}: rounder with smaller t")
        for axis, letter in ((1, "y"), (2, "z")):
            gain = [1.0, 1.0, 1.0]
            gain[axis] = 1.5
            q = points(proxy_deform(surface, AxisGain=tuple(gain)).GetOutput())
            grown = np.ptp(q, axis=0) / np.ptp(proxied, axis=0)
            print(f"  {name:8s} emphasis on {letter}: extents times {np.round(grown, 3)}")
            check(grown[axis] > 1.1 and np.delete(grown, axis).max() < 1.01, f"{name}: only {letter} grows")
        # Coincident points stay so.
        _, place = np.unique(x, axis=0, return_inverse=True)
        for properties in ({}, {"Blend": 0.0}, {"Projection": 2}, {"Transfer": 1}, {"Projection": 1}):
            q = points(proxy_deform(surface, **properties).GetOutput())
            representative = np.zeros((place.max() + 1, 3))
            representative[place] = q
            gap = np.abs(q - representative[place]).max()
            check(gap == 0.0, f"{name} {properties}: largest gap of coincident points is 0, not {gap}")
        print(f"  {name:8s} {len(x) - place.max() - 1} points coincide with others: largest gap afterwards {gap:g}")


# -- the thesis' search ---------------------------------------------------------------------------
def lengths(f):
    """Of the projection lines."""
    ends = points(f.GetOutput(2)).reshape(-1, 2, 3)
    return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)


def cases():
    for name, mesher in (("koala", 0), ("koala", 3), ("our-stone-house", 0), ("our-stone-house", 3)):
        surface = read(name)
        f = proxy_deform(surface, Projection=1, ProxyMesher=mesher, GenerateProjectionArrays=1)
        counts = f.GetProjectionCaseCounts()
        case = vtk_to_numpy(f.GetOutput().GetPointData().GetArray("ProjectionCase"))
        surplus = (lengths(f) - lengths(proxy_deform(surface, ProxyMesher=mesher))) / diagonal(surface)
        missed = [(surplus[case == k] > 1e-6).sum() for k in (1, 2, 3)]
        print(f"  {name:16s} on {MESHERS[mesher]:18s}: one foot {counts[0]}, several {counts[1]}, none {counts[2]}; not the "
              f"closest point {missed}, largest surplus of distance {f.GetProjectionError():.2e} diagonals")
        check(list(counts) == [(case == k).sum() for k in (1, 2, 3)], "the counts are those of the array")
        check(abs(surplus.max() - f.GetProjectionError()) < 1e-6, "the error is that of the lines")


# -- part of a model ------------------------------------------------------------------------------
def region():
    surface = read("our-creature")
    x, F = points(surface), triangles(surface)
    high = x[:, 1] > np.quantile(x[:, 1], 0.6)
    mask = numpy_to_vtk(high.astype(float), deep=1)
    mask.SetName("Head")
    surface.GetPointData().AddArray(mask)
    before = dihedral_angles(x, F)
    half = np.sort(np.concatenate([F[:, (0, 1)], F[:, (1, 2)], F[:, (2, 0)]]), axis=1)
    half = half[np.lexsort((half[:, 1], half[:, 0]))]
    inner = half[np.flatnonzero((half[1:] == half[:-1]).all(axis=1))]
    border = ~high[inner].all(axis=1)  # its two triangles may have a point inside
    for t in (0.5, 0.2):
        for width in (0.0, 0.1, 0.2, 0.3):
            f = vtkConvexProxyDeformFilter()
            f.SetInputData(surface)
            f.SetInputArrayToProcess(3, 0, 0, 0, "Head")
            f.SetBlend(t)
            f.SetBorderWidth(width)
            f.Update()
            q = vtk_to_numpy(f.GetOutput().GetPoints().GetData())
            same = (q == vtk_to_numpy(surface.GetPoints().GetData())).all(axis=1)
            check(same[~high].all(), "points outside keep their bits")
            check((~same[high]).mean() > 0.5, "points inside move")
            jump = np.degrees(np.abs(dihedral_angles(q.astype(float), F) - before))
            print(f"  creature's upper part, t {t:g}, border {width:g}: normals of neighboring triangles jump by up to "
                  f"{jump[border].max():.2f} degrees more at the border")
            check(width < 0.2 or jump[border].max() < (1.0 if width == 0.3 else 3.0), "no visible crease at the border")


# -- the house ------------------------------------------------------------------------------------
def house():
    """Against the outer-sphere blend: p' = (1 - t) (O + r d) + t p with the sphere around the model."""
    surface = read("our-stone-house")
    x, F = points(surface), triangles(surface)
    before = dihedral_angles(x, F)
    proxied = points(proxy_deform(surface).GetOutput())
    center = x.mean(axis=0)
    offset = x - center
    length = np.linalg.norm(offset, axis=1)
    for t in (0.5,):
        sphere = center + (t + (1.0 - t) * length.max() / length)[:, None] * offset

        def change(q):
            turned = dihedral_angles(q, F) - before
            return np.degrees(np.sqrt((((turned + np.pi) % (2 * np.pi) - np.pi) ** 2).mean()))

        print(f"  stone house, t {t}: rms change of dihedral angles: proxy {change(proxied):.2f}, "
              f"outer sphere {change(sphere):.2f} degrees; spread {spread(proxied, F):.4f}, {spread(sphere, F):.4f}")
        check(change(proxied) < change(sphere), "the proxy keeps more of the dihedral angles than the outer sphere")
        check(spread(proxied, F) < 0.8 * spread(x, F), "the proxy makes the house rounder")


main({"meshers": meshers, "car": car, "cases": cases, "region": region, "house": house})
