# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy runs, and both outputs and the read-only properties arrive.

usage: pvpython TestSphericalStyleFilterProxy.py SphericalStyle.so
"""
import math
import sys

from paraview import servermanager
from paraview.simple import Calculator, GetViews, LoadPlugin, Sphere, UpdatePipeline
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import sphericalstyle  # gives the C++ object behind the proxy its methods

LoadPlugin(sys.argv[1], remote=False, ns=globals())


def bounds(proxy):
    return proxy.GetDataInformation().GetBounds()


# Twice as long as wide, so that there is something to round.
sphere = Sphere(ThetaResolution=32, PhiResolution=32)
long_sphere = Calculator(Input=sphere, Function="coordsX*iHat + coordsY*jHat + 2*coordsZ*kHat",
                         CoordinateResults=1)
UpdatePipeline(proxy=long_sphere)

# ----------------------------------------------------------------- defaults, as the panel gets them
rounded = SphericalStyle(Input=long_sphere)
assert rounded.Roundness == 1.0 and rounded.DetailSize == 0.06 and rounded.NormalBlend == 0.6
assert rounded.NormalRadius == "Own Thickness" and rounded.RefineLongEdges == "Automatic"
assert rounded.KeepSize == "Area" and rounded.KeepOnGround == 0 and rounded.UpAxis == "Y"
assert rounded.CenterMode == "Area Centroid" and rounded.RadiusMode == "Equal Area"
assert rounded.AvoidSelfIntersections == 0
assert rounded.StopRule == "Converged" and rounded.OutputPointsPrecision == "Default"
for array in (rounded.NormalsArray, rounded.RoundnessFactorArray, rounded.NormalBlendArray,
              rounded.TargetDirectionsArray):
    assert list(array) == ["POINTS", "None"], list(array)
assert all(abs(c) < 1e-6 for c in rounded.Center), list(rounded.Center)
UpdatePipeline(proxy=rounded)
default_height = bounds(rounded)[5]

# ------------------------------------------------------------------------------- size and ground
low, high = (bounds(long_sphere)[k] for k in (4, 5))
rounded.KeepSize, rounded.UpAxis = "Extent", "Z"
UpdatePipeline(proxy=rounded)
assert abs((bounds(rounded)[5] - bounds(rounded)[4]) / (high - low) - 1.0) < 1e-5, bounds(rounded)
rounded.KeepSize, rounded.KeepOnGround = "Off", 1
UpdatePipeline(proxy=rounded)
assert abs(bounds(rounded)[4] - low) < 1e-6 and bounds(rounded)[5] < high - 0.01, bounds(rounded)
for name, value in (("Roundness", 0.5), ("NormalBlend", 0.0), ("DetailSize", 0.0), ("KeepSize", "Off"), ("KeepOnGround", 0)):
    rounded.SetPropertyWithName(name, value)
UpdatePipeline(proxy=rounded)
assert default_height < high and bounds(rounded)[5] < high
default_height = bounds(rounded)[5]

# ---------------------------------------------------------------------------- properties reach C++
rounded.Roundness = 2.0
rounded.CenterMode = "Custom"
rounded.Center = [0.0, 0.0, 0.1]
rounded.RadiusMode = "Custom"
rounded.Radius = 0.7
rounded.GenerateRotation = 1
rounded.SphericalWeighting = "Uniform"  # iterates
UpdatePipeline(proxy=rounded)
assert bounds(rounded)[5] < default_height < bounds(long_sphere)[5]
filter_ = rounded.SMProxy.GetClientSideObject()
assert filter_.GetRoundness() == 2.0 and filter_.GetGenerateRotation()
assert filter_.GetCenter() == (0.0, 0.0, 0.1) and filter_.GetRadius() == 0.7
information = rounded.GetDataInformation()
assert information.GetNumberOfPoints() == long_sphere.GetDataInformation().GetNumberOfPoints()
assert rounded.PointData.GetArray("Displacement").GetNumberOfComponents() == 3

# ---------------------------------------------------------------- facts of the execution, the table
rounded.UpdatePipelineInformation()
fact = rounded.GetPropertyValue
assert fact("NumberOfIterations") == filter_.GetNumberOfIterations() > 0
assert fact("Converged") == 1, fact("Converged")
assert fact("FinalEnergy") == filter_.GetFinalEnergy() > 0
assert list(fact("EffectiveCenter")) == [0.0, 0.0, 0.1], list(fact("EffectiveCenter"))
assert math.isclose(fact("EffectiveRadius"), 0.7, rel_tol=1e-12), fact("EffectiveRadius")
for name in ("TurnedOverBefore", "TurnedOverAfter", "NewIntersectionsBefore", "NewIntersectionsAfter"):
    assert fact(name) == -1, (name, fact(name))
assert fact("FoldSummary") == "", fact("FoldSummary")
assert fact("Advice").startswith("SphericalWeighting Cotangent: "), fact("Advice")
assert fact("Advice") == filter_.GetAdvice()
assert rounded.GetProperty("Advice").SMProperty.GetPanelVisibility() == "default"
table = servermanager.Fetch(rounded, idx=1)
assert table.GetClassName() == "vtkTable"
assert table.GetNumberOfRows() == fact("NumberOfIterations") + 1
assert table.GetColumnByName("Total") is not None
assert table.GetFieldData().GetAbstractArray("Advice").GetValue(0) == fact("Advice")

# -------------------------------------------------------------------------------- the target sphere
assert fact("CenterPosition") == "Inside", fact("CenterPosition")
circles = servermanager.Fetch(rounded, idx=2)
assert circles.GetNumberOfLines() > 0
assert all(abs(a - b) < 1e-6 for a, b in zip(
    circles.GetBounds(), [-0.7, 0.7, -0.7, 0.7, -0.6, 0.8])), circles.GetBounds()
rounded.Center = [0.0, 0.0, 1.1]
rounded.UpdatePipelineInformation()  # without an execution
assert fact("CenterPosition") == "Outside", fact("CenterPosition")
rounded.Center = [0.0, 0.0, 0.1]
rounded.SphericalWeighting = "Cotangent"  # the advice followed
UpdatePipeline(proxy=rounded)
rounded.UpdatePipelineInformation()
assert fact("Advice") == "", fact("Advice")

# ------------------------------------------------------------------------------------------ arrays
weighted = Calculator(Input=long_sphere, Function="0", ResultArrayName="still")
fixed = SphericalStyle(Input=weighted, RoundnessFactorArray=["POINTS", "still"])
UpdatePipeline(proxy=fixed)
assert all(abs(a - b) < 1e-6 for a, b in zip(bounds(fixed), bounds(long_sphere))), bounds(fixed)

# -------------------------------------------------------------------------------- long edges split
coarse = Sphere(ThetaResolution=4, PhiResolution=4)
refined = SphericalStyle(Input=coarse, RefineLongEdges="Off")
assert refined.MaximumEdgeLength == 0.04
UpdatePipeline(proxy=refined)
assert refined.PointData.GetArray("RefinedPoint") is None
before = refined.GetDataInformation().GetNumberOfPoints()
refined.MaximumEdgeLength = 0.1
for value in ("On", "Automatic"):
    refined.RefineLongEdges = value
    UpdatePipeline(proxy=refined)
    assert refined.GetDataInformation().GetNumberOfPoints() > 10 * before, value
    assert refined.PointData.GetArray("RefinedPoint").GetRange() == (0.0, 1.0)
    assert refined.CellData.GetArray("OriginalCell").GetNumberOfComponents() == 1
fine = SphericalStyle(Input=long_sphere, MaximumEdgeLength=0.01)
for value, splits in (("Automatic", False), ("On", True)):
    fine.RefineLongEdges = value
    UpdatePipeline(proxy=fine)
    count = fine.GetDataInformation().GetNumberOfPoints()
    assert (count > long_sphere.GetDataInformation().GetNumberOfPoints()) == splits, (value, count)

# -------------------------------------------------------------- what Apply would open for the table
controller = vtkSMParaViewPipelineControllerWithRendering()
for port in (1, 2):
    assert controller.ShowInPreferredView(rounded.SMProxy, port, None) is None, port
assert not GetViews(), "a view opened for the energy table or the sphere"
