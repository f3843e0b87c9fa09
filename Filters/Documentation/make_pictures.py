# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Make the pictures of this folder's pages, in pictures/.

    PYTHONPATH=BUILD/lib/python3/dist-packages pvpython make_pictures.py [NAME ...]

NAME: pictures to make, as car for car.png; all without one. presets.png, gallery-*.png, parts.png, van.png and wall.png
need the folder of real models SPHERICALSTYLE_MODELS, and stay as they are without. dragging.png is made by
Testing/Window/drag.py --strip.
"""
import os
import pathlib
import re
import sys

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from PIL import Image
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkCutter, vtkPolyDataNormals, vtkQuadricDecimation, vtkThreshold
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersModeling import vtkLoopSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkColorTransferFunction, vtkPolyDataMapper

matplotlib.use("Agg")

BLUE, YELLOW, RED = (0.16, 0.27, 0.62), (0.98, 0.84, 0.20), (0.80, 0.12, 0.10)

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(ROOT / "Testing" / "Python"), str(ROOT / "Testing" / "Quality")]

import FilterTable  # noqa: E402
import pictures  # noqa: E402
import sphericalstyle  # noqa: E402
from sphericalstyle import model_files, model_pictures, presets  # noqa: E402
from sphericalstyle import (  # noqa: E402
    vtkConvexProxyDeformFilter, vtkGaussMapFilter, vtkNonlinearStyleFilter,
    vtkNormalAnalogyFilter, vtkSphereProjectionFilter, vtkSphericalStyleFilter, vtkSurfaceMetrics,
    vtkSurfacePartsFilter, vtkThesisStyleFilter)


def run(deform, surface, properties):
    """The executed filter."""
    deform.SetInputData(surface)
    for name, value in properties.items():
        getattr(deform, f"Set{name}")(value)
    deform.Update()
    return deform


def rounded(surface, **properties):
    return run(vtkSphericalStyleFilter(), surface, properties).GetOutput()


def proxied(surface, **properties):
    return run(vtkConvexProxyDeformFilter(), surface, properties).GetOutput()


def analogy(surface, **properties):
    return run(vtkNormalAnalogyFilter(), surface, properties).GetOutput()


def on_sphere(surface, **properties):
    return run(vtkSphereProjectionFilter(), surface, properties).GetOutput()


def projection_lines(surface, **properties):
    return run(vtkConvexProxyDeformFilter(), surface, properties).GetOutput(2)


def wanted(name):
    return len(sys.argv) == 1 or pathlib.Path(name).stem in sys.argv[1:]


def quantize(file):
    """A third of the size."""
    Image.open(file).convert("RGB").quantize(128).save(file, optimize=True)


def picture(name, size, panels, view, points, few_colors=True, **options):
    if wanted(name):
        file = HERE / "pictures" / name
        model_pictures.picture(file, size, panels, "y", view, points, **options)
        if few_colors:
            quantize(file)


MODELS = pathlib.Path(os.environ.get("SPHERICALSTYLE_MODELS", ROOT.parent / "shared" / "models"))
# The linear blend of model and sphere, of the model's own triangles.
PLAIN = {"NormalBlend": 0.0, "DetailSize": 0.0, "KeepSize": vtkSphericalStyleFilter.NO_SIZE,
         "RefineLongEdges": vtkSphericalStyleFilter.NEVER}

creature = model_files.read(ROOT / "Data" / "creature.vtp")
cube = model_files.read(ROOT / "Data" / "cube.vtp")

picture("series.png", (1200, 810), [
    [(creature, "model")] + [
        (rounded(creature, Roundness=roundness, NormalBlend=blend), f"Roundness {roundness:g}, NormalBlend {blend:g}")
        for roundness in (0.3, 1.0, 2.0, 5.0)]
    for blend in (0.0, 0.6, 1.0)], 25.0, 12)

picture("details.png", (1000, 330), [[
    (rounded(creature, Roundness=2.0, DetailSize=size), f"DetailSize {size:g}")
    for size in (0.0, 0.02, 0.06, 0.15)]], 25.0, 13)


def preset(surface, name):
    style = vtkSphericalStyleFilter()
    presets.apply(style, name)
    return run(style, surface, {}).GetOutput()


def of_size_one(surface, length):
    """So that models of any size go into one picture."""
    transform = vtkTransform()
    transform.Scale([1.0 / length] * 3)
    scale = vtkTransformPolyDataFilter()
    scale.SetTransform(transform)
    scale.SetInputData(surface)
    scale.Update()
    return scale.GetOutput()


def presets_of(surface, label):
    return [(of_size_one(result, surface.GetLength()), words) for result, words in
            [(surface, label)] + [(preset(surface, name), name) for name in presets.PRESETS]]


def gallery(name, models, make_row=presets_of):
    """A picture with a row for each model, seen from its front. The page names the sources of the real ones."""
    files = [path for path in (MODELS / f"{model}.ply" if "/" not in model else ROOT / f"{model}.vtp" for model in models)]
    if not wanted(name) or not all(file.is_file() for file in files):
        return
    rows = []
    for file in files:
        up, view = pictures.VIEWS.get(file.stem, ("y", 25.0))
        row = make_row(model_files.read(file), file.stem)
        strip = HERE / "pictures" / "strip.png"
        model_pictures.picture(strip, (190 * len(row), 215), [row], up, view, 12, ground=True)
        rows.append(Image.open(strip).convert("RGB"))
        strip.unlink()
    sheet = Image.new("RGB", (rows[0].width, sum(row.height for row in rows)), "white")
    for k, row in enumerate(rows):
        sheet.paste(row, (0, k * row.height))
    sheet.save(HERE / "pictures" / name)
    quantize(HERE / "pictures" / name)


gallery("presets.png", ["Data/creature", "spot", "nefertiti"])
gallery("gallery-characters.png", ["Data/creature", "spot", "koala", "human-parts"])
gallery("gallery-busts.png", ["nefertiti", "demosthenes-bust", "skull"])
gallery("gallery-things.png", ["boot", "goblet-vase", "wingnut", "Data/stone-house"])
gallery("gallery-machines.png", ["car", "lidar-sensor", "plane-holes", "Data/car"])

# How to
picture("how-to-face.png", (1000, 370), [[(creature, "model")] + [
    (rounded(creature, Roundness=2.0, DetailSize=size), f"Detail Size {size:g}") for size in (0.02, 0.06, 0.12)]],
    25.0, 13, ground=True)
picture("how-to-limbs.png", (1000, 370), [[
    (creature, "model"), (rounded(creature, NormalBlend=0.0), "Limbs 0"), (preset(creature, "Chibi"), "Limbs 1, Chibi"),
    (preset(creature, "Puffy"), "Puffy")]], 25.0, 13, ground=True)
middle = 0.5 * sum(creature.GetBounds()[2:4])
upper = numpy_support.vtk_to_numpy(creature.GetPoints().GetData())[:, 1] > middle
picture("how-to-part.png", (600, 370), [[
    (creature, "model"), (sphericalstyle.round(creature, region=upper, roundness=2, border_width=0.1), "upper half")]],
    25.0, 13, ground=True)
a_car = model_files.read(ROOT / "Data" / "car.vtp")
picture("how-to-car.png", (1000, 300), [[
    (a_car, "model"), (rounded(a_car), "defaults"), (preset(a_car, "Soft"), "Soft"),
    (proxied(a_car, Blend=0.5), "Convex Proxy Deform")]], 40.0, 13, ground=True)
few = run(vtkQuadricDecimation(), model_files.read(ROOT / "Data" / "creature.vtp"), {"TargetReduction": 0.94}).GetOutput()
fine = run(vtkLoopSubdivisionFilter(), few, {"NumberOfSubdivisions": 2}).GetOutput()
picture("how-to-few.png", (700, 370), [[
    (few, "model"), (preset(few, "Toy"), "Toy"),
    (sphericalstyle.round(fine, preset="Toy", generate_normals=True), "Loop Subdivision, Toy")]], 25.0, 13, ground=True)
picture("how-to-target.png", (1200, 300), [[(creature, "model")] + [
    (sphericalstyle.round(creature, target=target, roundness=2, normal_blend=0.2), target)
    for target in ("Sphere", "Ellipsoid", "Capsule", "Cylinder", "RoundedBox")]], 25.0, 13, ground=True)


def points_of(surface):
    return numpy_support.vtk_to_numpy(surface.GetPoints().GetData()).astype(float)


def with_points(surface, points):
    copy = surface.NewInstance()
    copy.DeepCopy(surface)
    copy.GetPoints().SetData(numpy_support.numpy_to_vtk(points, deep=True))
    return copy


def base_of(surface):
    """[base]. The filter does not give it out, but where all targets are O, the base shrinks and no detail turns:
    P' = P + m (O - B)."""
    roundness = 0.01
    m = 1.0 - 1.0 / (1.0 + np.sqrt(3.0) * roundness)
    zeros = numpy_support.numpy_to_vtk(np.zeros((surface.GetNumberOfPoints(), 3)), deep=True)
    zeros.SetName("Targets")
    aimed = surface.NewInstance()
    aimed.ShallowCopy(surface)
    aimed.GetPointData().AddArray(zeros)
    style = vtkSphericalStyleFilter()
    style.SetInputArrayToProcess(3, 0, 0, 0, "Targets")
    style = run(style, aimed, {"Roundness": roundness, "KeepSize": vtkSphericalStyleFilter.NO_SIZE,
                               "OutputPointsPrecision": vtkSphericalStyleFilter.DOUBLE_PRECISION})
    return np.array(style.GetEffectiveCenter()) + (points_of(surface) - points_of(style.GetOutput())) / m


def steps(surface):
    """Model, base, target, moved base, result, at the defaults."""
    style = run(vtkSphericalStyleFilter(), surface, {})
    mu = np.sqrt(3.0) * style.GetRoundness()
    base = base_of(surface)
    t = numpy_support.vtk_to_numpy(style.GetOutput().GetPointData().GetArray("TargetDirection"))
    target = np.array(style.GetEffectiveCenter()) + style.GetEffectiveRadius() * t
    return [(surface, "P, the model"), (with_points(surface, base), "B, its smooth base"),
            (with_points(surface, target), "T, the target"),
            (with_points(surface, (base + mu * target) / (1.0 + mu)), "B', blended"),
            (style.GetOutput(), "P', with the details")]


if wanted("method.png"):
    picture("method.png", (1200, 300), [steps(creature)], 25.0, 12)

top = cube.GetBounds()[3]
center = [0.5 * (cube.GetBounds()[2 * i] + cube.GetBounds()[2 * i + 1]) for i in range(3)]


def around(height):
    return rounded(cube, Roundness=1.0, CenterMode=vtkSphericalStyleFilter.CUSTOM_CENTER,
                   Center=(center[0], top + height, center[2]), **PLAIN)


picture("center.png", (1000, 330), [[
    (cube, "model"),
    (rounded(cube, Roundness=1.0, **PLAIN), "center: Area Centroid"),
    (around(-0.15), "0.15 below the top"),
    (around(0.15), "0.15 above the top"),
]], 25.0, 13)

snowman = model_files.read(ROOT / "Data" / "snowman.vtp")


def around_centers(surface):
    style = vtkSphericalStyleFilter()
    style.SetInputArrayToProcess(5, 0, 0, 0, "CenterId")
    return run(style, surface, {"Roundness": 5.0, **PLAIN}).GetOutput()


picture("snowman.png", (800, 330), [[
    (snowman, "model"),
    (rounded(snowman, Roundness=5.0, **PLAIN), "one center"),
    (around_centers(snowman), "three centers"),
]], 25.0, 13)


def section(surface):
    """Segments of the surface in the plane y = the middle of its bounds."""
    plane = vtkPlane()
    plane.SetNormal(0.0, 1.0, 0.0)
    plane.SetOrigin(surface.GetCenter())
    cutter = vtkCutter()
    cutter.SetCutFunction(plane)
    cutter.SetInputData(surface)
    cutter.Update()
    cut = cutter.GetOutput()
    points = numpy_support.vtk_to_numpy(cut.GetPoints().GetData())[:, [0, 2]]
    ends = numpy_support.vtk_to_numpy(cut.GetLines().GetConnectivityArray()).reshape(-1, 2)
    return (points - np.array(surface.GetCenter())[[0, 2]])[ends]


def wall_sections(name):
    """The goblet, and what its wall becomes without and with details."""
    if not wanted(name) or not (MODELS / "goblet-vase.ply").is_file():
        return
    goblet = model_files.read(MODELS / "goblet-vase.ply")
    panels = [("model", goblet)] + [
        (f"DetailSize {size:g}, Roundness {roundness:g}",
         rounded(goblet, Roundness=roundness, DetailSize=size, NormalBlend=0.0))
        for size in (0.0, 0.06) for roundness in (1.0, 5.0)]
    figure, axes = plt.subplots(1, len(panels), figsize=(14.0, 3.0), layout="constrained", sharex=True, sharey=True)
    for axis, (title, surface) in zip(axes, panels):
        axis.add_collection(LineCollection(section(surface), colors="black", linewidths=1.0))
        axis.set_title(title, fontsize=10)
        axis.set_aspect("equal")
        axis.autoscale()
        axis.axis("off")
    figure.savefig(HERE / "pictures" / name)
    quantize(HERE / "pictures" / name)


wall_sections("wall.png")

# ----------------------------------------------------------------------------------- NonlinearStyle
stone = model_files.read(ROOT / "Data" / "go-stone.vtp")

def nonlinear(surface, **properties):
    return run(vtkNonlinearStyleFilter(), surface, properties).GetOutput()


thirty = {"StopRule": vtkSphericalStyleFilter.FIXED_ITERATIONS, "MaximumNumberOfIterations": 30}

picture("nonlinear-stone.png", (1000, 330), [[
    (stone, "model"),
    (rounded(stone, Roundness=1.0, **PLAIN), "Linear"),
    (nonlinear(stone, **thirty), "Nonlinear, 30 iterations"),
    (nonlinear(stone, Tolerance=1e-6), "Nonlinear, converged"),
]], 55.0, 13)


def energy_plot(name, surface, roundness):
    """Fig. 3.5: energy and global change, as written and corrected; what rises is red."""
    if not wanted(name):
        return
    figure, (total_axes, change_axes) = plt.subplots(1, 2, figsize=(10.0, 3.6), dpi=100)
    for label, constraint, style in (("as written", 1, "o-"), ("corrected", 0, "s-")):
        table = run(vtkNonlinearStyleFilter(), surface, {
            "Roundness": roundness, "CenterConstraint": constraint, **thirty,
        }).GetOutputDataObject(1)
        total, change = (numpy_support.vtk_to_numpy(table.GetColumnByName(column))
                         for column in ("Total", "GlobalChange"))
        for axes, first, values, rises in ((total_axes, 1, total, np.diff(total)),
                                           (change_axes, 2, change, change[1:])):
            iteration = np.arange(len(values))
            line, = axes.plot(iteration[first:], values[first:], style, markersize=3, label=label)
            up = np.flatnonzero(rises > 1e-12 * total[0]) + 1
            up = up[up >= first]
            axes.plot(iteration[up], values[up], "o", color="red", markersize=7, fillstyle="none")
    total_axes.set(xlabel="iteration", ylabel="energy after the iteration")
    change_axes.set(xlabel="iteration", ylabel="change of the energy by the global step")
    change_axes.set_yscale("symlog", linthresh=1e-3 * total[0])
    change_axes.axhline(0.0, color="black", linewidth=0.8)
    total_axes.legend()
    figure.tight_layout()
    figure.savefig(HERE / "pictures" / name)
    quantize(HERE / "pictures" / name)


energy_plot("nonlinear-energy.png", model_files.read(ROOT / "Data" / "stone-house.vtp"), 0.1)

# --------------------------------------------------------------------------------- ConvexProxyDeform
car = model_files.read(ROOT / "Data" / "car.vtp")
bottle = model_files.read(ROOT / "Data" / "bottle.vtp")
house = model_files.read(ROOT / "Data" / "stone-house.vtp")

picture("car.png", (1200, 560), [[
    (car, "model"),
    (rounded(car), "Spherical Style"),
    (proxied(car, Blend=0.5), "Convex Proxy Deform, t = 0.5"),
], [
    (proxied(car, Blend=0.8), "t = 0.8"),
    (proxied(car, Blend=0.2), "t = 0.2"),
    (proxied(car, Blend=0.2, Transfer=1), "t = 0.2, Transfer Offset"),
]], 40.0, 14)

# A real model, and so not among ours; the page names its source.
if (MODELS / "car.ply").is_file() and wanted("van.png"):
    van = model_files.read(MODELS / "car.ply")
    picture("van.png", (1200, 300), [[
        (van, "model"),
        (rounded(van, RefineLongEdges=vtkSphericalStyleFilter.NEVER), "RefineLongEdges Off"),
        (rounded(van), "Automatic"),
        (rounded(van, DetailSize=0.0), "Automatic, DetailSize 0"),
    ]], 60.0, 12)

picture("axis-gain.png", (1000, 330), [[
    (proxied(car), "t = 0.5"),
    (proxied(car, AxisGain=(1.0, 1.5, 1.0)), "AxisGain 1, 1.5, 1"),
    (proxied(car, AxisGain=(1.0, 1.0, 1.5)), "AxisGain 1, 1, 1.5"),
]], 40.0, 14)

part = {"BlendRange": (0.0, 0.55), "BlendAtStart": 0.0, "BlendAtEnd": 1.0}
runs = [({"BlendFunction": 2}, "Quadratic"), ({"BlendFunction": 1, **part}, "Linear, lower part"),
        ({"BlendFunction": 3, **part}, "Tanh, lower part")]
picture("bottle.png", (1200, 480), [
    [(bottle, "projection lines", projection_lines(bottle))] +
    [(proxied(bottle, **properties), label) for properties, label in runs]], 25.0, 14)

# The head without the raised paw; t falls from 1 at the neck to 0.2 at the top.
x, y, _ = numpy_support.vtk_to_numpy(creature.GetPoints().GetData()).T
head = numpy_support.numpy_to_vtk(((y > 0.52) & ((x < 0.26) | (y > 0.78))).astype(float), deep=True)
head.SetName("Head")
with_head = creature.NewInstance()
with_head.ShallowCopy(creature)
with_head.GetPointData().AddArray(head)


def round_head(function):
    deform = vtkConvexProxyDeformFilter()
    deform.SetInputArrayToProcess(3, 0, 0, 0, "Head")
    return run(deform, with_head, {"BlendFunction": function, "BlendRange": (0.5, 1.0),
                                   "BlendAtStart": 1.0, "BlendAtEnd": 0.2}).GetOutput()


picture("head.png", (1100, 700), [[
    (creature, "model", None, view),
    (round_head(1), "head, Linear", None, view),
    (round_head(2), "head, Quadratic", None, view),
] for view in (25.0, 100.0)], 25.0, 14)

picture("house.png", (1200, 330), [[
    (house, "model"),
    (proxied(house, RefineLongEdges=vtkConvexProxyDeformFilter.NEVER), "proxy, t = 0.5"),
    (proxied(house, RefineLongEdges=vtkConvexProxyDeformFilter.NEVER, Projection=2), "proxy, Smallest Angle"),
    (on_sphere(house, Coefficient=0.5), "sphere around the model, t = 0.5"),
]], 25.0, 13)


def by_share(surface):
    """In clay, or colored by the array log2 share if there is one."""
    actor = model_pictures.actor_of(surface)
    if surface.GetPointData().HasArray("log2 share"):
        colors = vtkColorTransferFunction()
        for at, color in ((-2.0, BLUE), (-1.0, YELLOW), (0.0, RED)):
            colors.AddRGBPoint(at, *color)
        normals = vtkPolyDataNormals()
        normals.SetFeatureAngle(60.0)
        normals.SetInputData(surface)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(normals.GetOutputPort())
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("log2 share")
        mapper.SetLookupTable(colors)
        mapper.UseLookupTableScalarRangeOn()
        actor.SetMapper(mapper)
    return actor


def with_share(surface, roundness):
    """A copy with the array log2 share."""
    remaining = numpy_support.vtk_to_numpy(surface.GetPointData().GetArray("RemainingRoundness"))
    share = numpy_support.numpy_to_vtk(np.log2(remaining / roundness), deep=True)
    share.SetName("log2 share")
    copy = surface.NewInstance()
    copy.ShallowCopy(surface)
    copy.GetPointData().AddArray(share)
    return copy


if wanted("fold-guard.png"):
    guarded = rounded(creature, AvoidSelfIntersections=1)
    picture("fold-guard.png", (1200, 360), [[
        (creature, "model"),
        (rounded(creature), "Toy"),
        (guarded, "with AvoidSelfIntersections"),
        (with_share(guarded, 1.0), "kept: blue 1/4, yellow 1/2, red all"),
    ]], 25.0, 13, few_colors=False, make_actor=by_share)

# ------------------------------------------------------------------------------------ SurfaceMetrics


def with_intersections(label, **properties):
    """A panel of the rounded creature with its intersecting triangles in red."""
    surface = run(vtkThesisStyleFilter(), creature, {
        **PLAIN, "Roundness": 0.1, "NormalRadius": vtkSphericalStyleFilter.WHOLE_MODEL_RADIUS, **properties}).GetOutput()
    metrics = run(vtkSurfaceMetrics(), surface, {"ReferenceData": creature})
    found = vtkThreshold()
    found.SetInputData(metrics.GetOutput())
    found.SetInputArrayToProcess(0, 0, 0, 1, "SelfIntersections")
    found.SetUpperThreshold(0.5)
    found.SetThresholdFunction(vtkThreshold.THRESHOLD_UPPER)
    red = vtkGeometryFilter()
    red.SetInputConnection(found.GetOutputPort())
    red.Update()
    count = metrics.GetOutputDataObject(1).GetColumnByName("SelfIntersectingTriangles").GetValue(0)
    return surface, f"{label}: {count} triangles intersect", red.GetOutput()


picture("self-intersections.png", (1200, 420), [[
    with_intersections("NormalBlend 1", NormalBlend=1.0),
    with_intersections("NormalBlend 1, Flip", NormalBlend=1.0, ConcaveEdges=1),
    with_intersections("NormalBlend 0"),
]], 25.0, 14)

# ------------------------------------------------------------------------------------------ GaussMap


def painted(sphere, array, often):
    """Blue where there are no normals, yellow where there are some, red from `often` on."""
    colors = vtkColorTransferFunction()
    if array == "Count":  # whole numbers: no shades between none and one
        colors.AddRGBPoint(0.0, *BLUE)
        colors.AddRGBPoint(0.5, *BLUE)
        colors.AddRGBPoint(0.51, *YELLOW)
    else:
        colors.AddRGBPoint(0.0, *BLUE)
        colors.AddRGBPoint(0.5, *YELLOW)
    colors.AddRGBPoint(1.0, *YELLOW)
    colors.AddRGBPoint(often, *RED)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(sphere)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray(array)
    mapper.SetLookupTable(colors)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.35)
    actor.GetProperty().SetDiffuse(0.70)
    actor.SetScale(0.37)
    return actor


def gauss_panels(surface, label):
    """A column: the surface, its equal-angle counts, its equal-area density."""
    gauss = run(vtkGaussMapFilter(), surface, {"OftenThreshold": 5.0})
    angle = painted(gauss.GetOutput(), "Count", 6.0)
    hit = f"{gauss.GetUnitsHit()} units hit, {gauss.GetUnitsHitOften()} often"
    gauss = run(vtkGaussMapFilter(), surface, {"SphereUnits": 1, "AreaWeighted": True,
                                               "NumberOfEqualAreaUnits": 500})
    area = painted(gauss.GetOutput(), "Density", 4.0)
    model = model_pictures.actor_of(surface)
    model.SetScale(1.0 / surface.GetLength())
    return [(model, label), (angle, hit), (area, f"distance {gauss.GetDistanceToUniform():.2f}")]


columns = [gauss_panels(surface, label) for surface, label in (
    (cube, "cube"), (creature, "creature"), (rounded(creature, Roundness=0.5, **PLAIN), "Roundness 0.5"),
    (rounded(creature, Roundness=5.0, **PLAIN), "Roundness 5"))]
picture("gauss-map.png", (800, 620), list(zip(*columns)), 25.0, 12, few_colors=False,
        make_actor=lambda actor: actor)

# ----------------------------------------------------------------------------------- mesh morphing
def cut_open(grid):
    """The cells of the lower half."""
    side = numpy_support.numpy_to_vtk(lower.astype(float), deep=True)
    side.SetName("Lower")
    grid.GetCellData().AddArray(side)
    half = vtkThreshold()
    half.SetInputData(grid)
    half.SetInputArrayToProcess(0, 0, 0, 1, "Lower")
    half.SetLowerThreshold(0.5)
    half.SetUpperThreshold(1.5)
    surface = vtkGeometryFilter()
    surface.SetInputConnection(half.GetOutputPort())
    surface.Update()
    return surface.GetOutput()


def with_edges(surface):
    actor = vtkActor()
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.ScalarVisibilityOff()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.88, 0.62, 0.47)
    actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetEdgeColor(0.2, 0.2, 0.25)
    return actor


if wanted("mesh-morphing.png"):
    import mesh_morphing  # needs scipy

    bar = mesh_morphing.MESHES["bent bar, mixed"]()
    lower = mesh_morphing.middles(bar)[:, 2] < 0.5
    round_bar = mesh_morphing.rounded_surface(bar, 5.0)
    picture("mesh-morphing.png", (1200, 330), [[
        (cut_open(bar), "at rest"),
        (cut_open(mesh_morphing.laplacian(bar, round_bar)[0]), "Laplacian morphing"),
        (cut_open(mesh_morphing.ours(bar, round_bar)[0]), "Mesh Morphing"),
    ]], 10.0, 13, make_actor=with_edges)

# ------------------------------------------------------------------------------------------- parts
PART_COLORS = ((0.91, 0.44, 0.44), (0.36, 0.49, 0.87), (0.47, 0.62, 0.25), (0.93, 0.55, 0.15), (0.10, 0.78, 0.68),
               (0.56, 0.24, 0.60), (0.36, 0.31, 0.62), (0.95, 0.80, 0.30), (0.60, 0.60, 0.60), (0.55, 0.35, 0.20))


def by_part(surface):
    colors = vtkColorTransferFunction()
    for part, color in enumerate(PART_COLORS):
        colors.AddRGBPoint(part, *color)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("PartId")
    mapper.SetLookupTable(colors)
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def parts_of(surface, turn=0.0, **properties):
    """turn: degrees about Y, so that a face looks at us."""
    transform = vtkTransform()
    transform.RotateY(turn)
    turned = vtkTransformPolyDataFilter()
    turned.SetTransform(transform)
    turned.SetInputData(run(vtkSurfacePartsFilter(), surface, properties).GetOutput())
    turned.Update()
    return of_size_one(turned.GetOutput(), surface.GetLength())


if wanted("parts.png") and (MODELS / "spot.ply").exists():
    spot = model_files.read(MODELS / "spot.ply")
    picture("parts.png", (1200, 330), [[
        (parts_of(creature), "creature: automatic, 9 parts"), (parts_of(creature, NumberOfParts=3), "NumberOfParts 3"),
        (parts_of(spot, 180.0), "spot: automatic, 6 parts"), (parts_of(spot, 180.0, NumberOfParts=2), "NumberOfParts 2"),
    ]], 25.0, 13, few_colors=False, make_actor=by_part)

# ------------------------------------------------------------------------------------------- sizes
if wanted("part-sizes.png") and (MODELS / "human-parts.ply").exists():
    human = model_files.read(MODELS / "human-parts.ply")
    parts, person = sphericalstyle.parts(creature), sphericalstyle.parts(human)
    chibi = {"preset": "Chibi", "keep_on_ground": True}
    picture("part-sizes.png", (1000, 640), [
        [(of_size_one(surface, creature.GetLength()), title) for surface, title in (
            (creature, "creature"),
            (sphericalstyle.resize(creature, {0: 0.75, 3: 1.7}, parts=parts, keep_on_ground=True), "head .75, arm 1.7"),
            (sphericalstyle.resize(sphericalstyle.round(creature, preset="Soft"), parts=parts, head_height=1.0,
                                   keep_on_ground=True), "Soft, HeadHeight 1"))],
        [(of_size_one(surface, human.GetLength()), title) for surface, title in (
            (human, "human-parts"),
            (sphericalstyle.resize(human, parts=person, head_height=0.35, keep_on_ground=True), "HeadHeight .35"),
            (sphericalstyle.resize(sphericalstyle.round(human, **chibi), parts=person, head_height=0.5,
                                   keep_on_ground=True), "Chibi, HeadHeight .5"))],
    ], 25.0, 13)

# ----------------------------------------------------------------------------------------- handles
if wanted("handle-deform.png"):
    feet = {"place": (0, 0, 0), "radius": 0.3}
    arm = {"place": (0.45, 0.64, 0.07), "radius": 0.08, "to": (0.4, 0.24, 0.12), "rotation": (0, 0, -100)}
    head = {"place": (0.05, 0.75, 0), "radius": 0.2, "to": (0.12, 0.74, 0.02), "rotation": (0, 30, -15)}
    posed = sphericalstyle.deform(creature, [feet, arm, head])
    picture("handle-deform.png", (1000, 320), [[(of_size_one(surface, creature.GetLength()), title)
                                                for surface, title in (
        (creature, "creature"), (posed, "three handles"),
        (sphericalstyle.round(posed, preset="Soft", keep_on_ground=True), "and Soft"))]], 25.0, 13)

# -------------------------------------------------------------------------------------- comparators
ours = (rounded(creature), "Spherical Style")

for entry in FilterTable.FILTERS.values():
    if "shown" in entry:  # CubicStyle: cubic-style.png
        style, weight = getattr(sphericalstyle, entry["class"]), entry["weight"]
        picture(re.sub("(?<=[a-z])(?=[A-Z])", "-", entry["page"]).lower() + ".png", (1200, 300),
                [[(creature, "model"), ours] + [
                    (run(style(), creature, {weight: value, "StopRule": style.FIXED_ITERATIONS,
                                             "MaximumNumberOfIterations": 100}).GetOutput(), f"{weight} {value:g}")
                    for value in entry["shown"]]], 25.0, 12)

ball = vtkSphereSource()
ball.SetThetaResolution(24)
ball.SetPhiResolution(16)
ball.Update()
picture("normal-analogy.png", (1200, 560), [[
    (creature, "model"),
    ours,
    (analogy(creature, Weight=10.0, Style=vtkNormalAnalogyFilter.TETRAHEDRON), "Tetrahedron"),
], [
    (analogy(creature, Weight=10.0, Style=vtkNormalAnalogyFilter.CUBE), "Cube"),
    (analogy(creature, Weight=10.0, Style=vtkNormalAnalogyFilter.ICOSAHEDRON), "Icosahedron"),
    (analogy(creature, Weight=10.0, Style=vtkNormalAnalogyFilter.MESH,
             StyleMeshData=ball.GetOutput()), "Mesh: a sphere of 672 triangles"),
]], 25.0, 13)

picture("sphere-projection.png", (1200, 300), [[
    (creature, "model"),
    ours,
    (on_sphere(creature), "Outer, Coefficient 0.5"),
    (on_sphere(creature, RadiusMode=vtkSphereProjectionFilter.EQUAL_AREA),
     "Equal Area, Coefficient 0.5"),
    (on_sphere(creature, RadiusMode=vtkSphereProjectionFilter.EQUAL_AREA, Coefficient=0.9),
     "Equal Area, Coefficient 0.9"),
]], 25.0, 12)
