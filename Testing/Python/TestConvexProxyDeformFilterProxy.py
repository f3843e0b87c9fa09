# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy runs with every entry of every enumeration, inputs come and go, and
all outputs and the read-only properties arrive.

usage: pvpython TestConvexProxyDeformFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
import math
import os
import sys

from paraview import servermanager
from paraview.simple import *
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import sphericalstyle  # gives the C++ object behind the proxy its methods

LoadPlugin(sys.argv[1], remote=False, ns=globals())
errors = []


def keep_error(sender, event, text):
    errors.append(text)


keep_error.CallDataType = "string0"


def deform(model, **properties):
    """A filter with a proxy of few points whose errors are kept and not printed."""
    filter_ = ConvexProxyDeform(Input=model, NumberOfProxyPoints=300, **properties)
    client_side = filter_.SMProxy.GetClientSideObject()
    for sender in (client_side, client_side.GetExecutive()):
        sender.AddObserver("ErrorEvent", keep_error)
    return filter_


def update(proxy):
    UpdatePipeline(proxy=proxy)
    proxy.UpdatePipelineInformation()
    assert not errors, errors


def bounds(proxy):
    return proxy.GetDataInformation().GetBounds()


def moved(filter_, block=None):
    """Ids of the points that are not where they were."""
    output = servermanager.Fetch(filter_)
    surface = output if block is None else output.GetBlock(block)
    displacement = surface.GetPointData().GetArray("Displacement")
    return [i for i in range(displacement.GetNumberOfTuples())
            if displacement.GetTuple3(i) != (0.0, 0.0, 0.0)]


# Twice as long as wide, so that there is something to round; with arrays of 1, 2 and 3 components.
sphere = Sphere(ThetaResolution=32, PhiResolution=32)
long_sphere = Calculator(Input=sphere, Function="coordsX*iHat + coordsY*jHat + 2*coordsZ*kHat",
                         CoordinateResults=1)
scalar = Calculator(Input=long_sphere, Function="0.25", ResultArrayName="quarter")
vector = Calculator(Input=scalar, Function="1*iHat + 0*jHat + 0.25*kHat", ResultArrayName="axes")
model = TextureMaptoSphere(Input=vector)
UpdatePipeline(proxy=model)
n = model.GetDataInformation().GetNumberOfPoints()

# ----------------------------------------------------------------- defaults, as the panel gets them
plain = ConvexProxyDeform(Input=model)
assert plain.BlendFunction == "Constant" and plain.Blend == 0.5 and plain.Roundness == 5.0
assert list(plain.BlendAxis) == [0, 1, 0] and list(plain.BlendRange) == [0, 1]
assert (plain.BlendAtStart, plain.BlendAtEnd, plain.TanhSteepness) == (0.0, 1.0, 3.0)
assert plain.Projection == "Closest Point" and plain.Transfer == "Blend"
assert plain.ProxyMesher == "Isotropic Remeshing" and plain.NumberOfProxyPoints == 5000
assert plain.SphericalWeighting == "Cotangent" and plain.OutputPointsPrecision == "Default"
assert list(plain.AxisGain) == [1, 1, 1] and plain.BorderWidth == 0.2 and plain.HullOf == "Region"
assert plain.RefineLongEdges == "Automatic"
assert plain.Proxy is None and plain.Selection is None
for array in (plain.NormalsArray, plain.DirectionsArray, plain.BlendArray, plain.RegionArray):
    assert list(array) == ["POINTS", "None"], list(array)
assert all(abs(c) < 1e-6 for c in plain.Center), list(plain.Center)
for name, limits in (("Blend", (0, 1)), ("BorderWidth", (0, 1)), ("NumberOfNeighbors", (1, 100)),
                     ("NumberOfProxyPoints", (4, 1000000)), ("AxisGain", (0, None))):
    domain = plain.SMProxy.GetProperty(name).FindDomain("vtkSMDoubleRangeDomain") or \
        plain.SMProxy.GetProperty(name).FindDomain("vtkSMIntRangeDomain")
    assert domain.GetMinimum(0) == limits[0], name
    assert limits[1] is None or domain.GetMaximum(0) == limits[1], name


def choices(name):
    """Arrays that the panel offers."""
    domain = plain.SMProxy.GetProperty(name).FindDomain("vtkSMArrayListDomain")
    return {domain.GetString(i) for i in range(domain.GetNumberOfStrings())}


assert choices("BlendArray") == {"None", "quarter", "axes", "Normals"}, choices("BlendArray")
assert choices("RegionArray") == {"None", "quarter"}, choices("RegionArray")
assert choices("DirectionsArray") == choices("NormalsArray") == {"None", "axes", "Normals"}

# ---------------------------------------------------------- outputs and the facts of the execution
rounded = deform(model, Projection="Nearest Vertices", GenerateProjectionArrays=1)
update(rounded)
assert bounds(rounded)[5] < bounds(model)[5] and bounds(rounded)[1] > bounds(model)[1]
points, proxy, lines = (servermanager.Fetch(rounded, idx=k) for k in range(3))
assert points.GetNumberOfPoints() == n
arrays = {"Normals": 3, "quarter": 1, "axes": 3, "Texture Coordinates": 2, "t": 1,
          "Displacement": 3, "ProxyCell": 1, "Barycentric": 3, "ProjectionCase": 1}
data = points.GetPointData()
found = {data.GetArrayName(k): data.GetArray(k).GetNumberOfComponents()
         for k in range(data.GetNumberOfArrays())}
assert found == arrays, found
assert data.GetArray("t").GetRange() == (0.5, 0.5)
for name in ("RestPosition", "Displacement"):
    assert proxy.GetPointData().GetArray(name).GetNumberOfComponents() == 3, name
assert proxy.GetFieldData().GetArray("StageSeconds").GetNumberOfComponents() == 4
assert lines.GetNumberOfLines() == n and lines.GetNumberOfPoints() == 2 * n
assert [lines.GetCellData().GetArray("PointId").GetTuple1(i) for i in range(n)] == list(range(n))
assert lines.GetCellData().GetArray("t").GetRange() == (0.5, 0.5)

filter_ = rounded.SMProxy.GetClientSideObject()
fact = rounded.GetPropertyValue
assert fact("EffectiveNumberOfProxyPoints") == proxy.GetNumberOfPoints() > 0
assert fact("EffectiveProxyMesher") == 0
assert 0.95 < fact("ConvexityRatio") <= 1.0, fact("ConvexityRatio")
assert fact("TrianglesTurnedOver") == filter_.GetTrianglesTurnedOver()
assert sum(fact("ProjectionCaseCounts")) == n, list(fact("ProjectionCaseCounts"))
assert 0.0 <= fact("ProjectionError") == filter_.GetProjectionError() < 0.1
assert tuple(fact("EffectiveCenter")) == filter_.GetEffectiveCenter()
assert fact("EffectiveRadius") == filter_.GetEffectiveRadius() > 0.0

# ------------------------------------------------------------------ properties and enumerations
one = deform(model, CenterMode="Custom", Center=[0.0, 0.0, 0.1], RadiusMode="Custom", Radius=0.7,
             AxisGain=[1.0, 2.0, 1.0], BlendRange=[0.25, 0.5])
update(one)
assert math.dist(one.GetPropertyValue("EffectiveCenter"), (0.0, 0.0, 0.1)) < 1e-12
assert math.isclose(one.GetPropertyValue("EffectiveRadius"), 0.7, rel_tol=1e-12)
filter_ = one.SMProxy.GetClientSideObject()
assert filter_.GetAxisGain() == (1.0, 2.0, 1.0) and filter_.GetBlendRange() == (0.25, 0.5)

every = deform(model, DirectionsArray=["POINTS", "Normals"], BlendArray=["POINTS", "quarter"])
for name in ("BlendFunction", "Projection", "Transfer", "CenterMode", "RadiusMode", "ProxyMesher",
             "HullOf", "SphericalWeighting", "OutputPointsPrecision"):
    in_cxx = getattr(every.SMProxy.GetClientSideObject(), "Get" + name)
    entries = list(every.GetProperty(name).GetAvailable())
    assert len(entries) > 1, (name, entries)
    default = entries[in_cxx()]
    for value, entry in enumerate(entries):
        every.SetPropertyWithName(name, entry)
        update(every)
        assert in_cxx() == value, (name, entry, in_cxx())
        assert all(map(math.isfinite, bounds(every))), (name, entry)
        if name == "ProxyMesher":
            assert every.GetPropertyValue("EffectiveProxyMesher") == value, entry
    every.SetPropertyWithName(name, default)
assert every.BlendFunction == "Constant" and every.OutputPointsPrecision == "Default"

# ----------------------------------------------------------------------------------------- arrays
every.BlendFunction = "Array"
update(every)
assert every.PointData.GetArray("t").GetNumberOfComponents() == 1
every.BlendArray = ["POINTS", "axes"]  # 1, 0 and 1/4: x stays
update(every)
assert every.PointData.GetArray("t").GetNumberOfComponents() == 3
assert bounds(every)[:2] == bounds(model)[:2] and bounds(every)[2:4] != bounds(model)[2:4]
still = Calculator(Input=model, Function="coordsZ > 0", ResultArrayName="upper")
half = deform(still, RegionArray=["POINTS", "upper"], BorderWidth=0.0)
update(half)
assert bounds(half)[4] == bounds(model)[4] and bounds(half)[5] < bounds(model)[5], bounds(half)
assert math.isnan(half.GetPropertyValue("ConvexityRatio"))  # its hull is that of the upper half
half.HullOf = "Whole Model"
update(half)
assert half.GetPropertyValue("ConvexityRatio") > 0.95

# ---------------------------------------------------------------------- the optional inputs
whole = deform(model, BorderWidth=0.0)
update(whole)
assert moved(whole) == list(range(n))
whole_bounds = bounds(whole)
whole.Proxy = Sphere(Radius=2.0, ThetaResolution=24, PhiResolution=24)
update(whole)
assert whole.GetPropertyValue("EffectiveProxyMesher") == -1
assert math.isnan(whole.GetPropertyValue("ConvexityRatio"))
assert bounds(whole)[5] > whole_bounds[5]
whole.Proxy = None
update(whole)
assert bounds(whole) == whole_bounds and whole.GetPropertyValue("EffectiveProxyMesher") == 0

ids = [3, 17, 100]
pairs = [x for i in ids for x in (-1, i)]  # every process
whole.Selection = IDSelectionSource(FieldType="POINT", IDs=pairs)
update(whole)
assert moved(whole) == ids, moved(whole)
whole.Selection = IDSelectionSource(FieldType="CELL", IDs=[-1, 40])
update(whole)
cell = servermanager.Fetch(model).GetCell(40)
assert moved(whole) == sorted(cell.GetPointId(k) for k in range(3)), moved(whole)
whole.Selection = None
update(whole)
assert moved(whole) == list(range(n)) and bounds(whole) == whole_bounds

# Points that were picked in one block of several.
blocks = deform(GroupDatasets(Input=[model, long_sphere]),
                Selection=CompositeDataIDSelectionSource(FieldType="POINT",
                                                         IDs=[x for i in ids for x in (2, -1, i)]))
update(blocks)
assert moved(blocks, 0) == [] and moved(blocks, 1) == ids, (moved(blocks, 0), moved(blocks, 1))

# A query is an error that says so, and no crash; the filter works again without it.
whole.Selection = SelectionQuerySource(QueryString="id < 5")
UpdatePipeline(proxy=whole)
assert any("query" in text for text in errors), errors
errors.clear()
whole.Selection = None
update(whole)
assert bounds(whole) == whole_bounds

# ------------------------------------------------------- what Apply shows, and what the eyes show
controller = vtkSMParaViewPipelineControllerWithRendering()
view = CreateRenderView()
assert controller.ShowInPreferredView(rounded.SMProxy, 0, view.SMProxy) is not None
for port in (1, 2):
    assert controller.ShowInPreferredView(rounded.SMProxy, port, view.SMProxy) is None, port
    assert not controller.GetVisibility(rounded.SMProxy, port, view.SMProxy), port
    controller.SetVisibility(rounded.SMProxy, port, view.SMProxy, True)
    assert controller.GetVisibility(rounded.SMProxy, port, view.SMProxy), port
assert len(GetViews()) == 1

# ------------------------------------------------------------------------------------------ state
whole.BlendFunction, whole.BlendAxis, whole.TanhSteepness = "Tanh", [0.0, 0.0, 1.0], 2.0
whole.Proxy = Sphere(registrationName="MyProxy", Radius=2.0, ThetaResolution=24, PhiResolution=24)
whole.Selection = IDSelectionSource(FieldType="POINT", IDs=pairs)
RenameSource("Kept", whole)
update(whole)
kept_bounds = bounds(whole)
state = os.path.join(sys.argv[2], "TestConvexProxyDeformFilterProxy.pvsm")
SaveState(state)
ResetSession()
LoadState(state)
kept = FindSource("Kept")
assert kept.BlendFunction == "Tanh" and list(kept.BlendAxis) == [0.0, 0.0, 1.0]
assert kept.TanhSteepness == 2.0 and kept.NumberOfProxyPoints == 300
assert kept.Proxy is not None and kept.Selection is not None
update(kept)
assert bounds(kept) == kept_bounds, (bounds(kept), kept_bounds)
assert kept.GetPropertyValue("EffectiveProxyMesher") == -1
assert moved(kept) == ids, moved(kept)
