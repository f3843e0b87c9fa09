# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pipelines of ParaView: blocks, the image and the table in filters of ParaView, and the picture.

usage: pvpython TestGaussMapFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import math
import sys

from paraview import servermanager, smtesting
from paraview.simple import *

from ProxyTesting import move

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())


def values(array):
    return [array.GetTuple1(i) for i in range(array.GetNumberOfTuples())]


# ---------------------------------------------------------------------- blocks keep to themselves
cube = XMLPolyDataReader(FileName=[data + "/cube.vtp"])
stone = XMLPolyDataReader(FileName=[data + "/go-stone.vtp"])
alone = [GaussMap(Input=model) for model in (cube, stone)]
together = GaussMap(Input=GroupDatasets(Input=[cube, stone]))
UpdatePipeline(proxy=together)
for k in range(2):
    UpdatePipeline(proxy=alone[k])
    blocks = [servermanager.Fetch(together, idx=port).GetBlock(k) for port in range(3)]
    own = [servermanager.Fetch(alone[k], idx=port) for port in range(3)]
    assert values(blocks[1].GetPointData().GetScalars()) == values(own[1].GetPointData().GetScalars())
    assert values(blocks[0].GetCellData().GetArray("Density")) == values(
        own[0].GetCellData().GetArray("Density"))
    assert blocks[2].GetValueByName(0, "Entropy") == own[2].GetValueByName(0, "Entropy")
alone[0].UpdatePipelineInformation()
assert alone[0].GetPropertyValue("UnitsHit") == 6

# ------------------------------------------------- ParaView's own filters on all three outputs
hit = Threshold(Input=alone[1], Scalars=["CELLS", "Count"], LowerThreshold=0.5,
                UpperThreshold=1e9)
UpdatePipeline(proxy=hit)
alone[1].UpdatePipelineInformation()
assert hit.GetDataInformation().GetNumberOfCells() == alone[1].GetPropertyValue("UnitsHit")
northern = ExtractSubset(Input=OutputPort(alone[1], 1), VOI=[0, 359, 90, 179, 0, 0])
UpdatePipeline(proxy=northern)
assert northern.GetDataInformation().GetBounds()[2:4] == (0.5, 89.5)
assert 0 < sum(values(servermanager.Fetch(northern).GetPointData().GetScalars())) < \
    alone[1].GetPropertyValue("NumberOfNormals")

# Mean of the density over the sphere's polygons, weighted by their areas: one.
integral = IntegrateVariables(Input=alone[1])
UpdatePipeline(proxy=integral)
cells = servermanager.Fetch(integral).GetCellData()
assert math.isclose(cells.GetArray("Density").GetTuple1(0), cells.GetArray("Area").GetTuple1(0),
                    rel_tol=1e-3)

# ---------- the picture: equal-angle and equal-area units of the creature, the same rounded, a cube
creature = XMLPolyDataReader(FileName=[data + "/creature.vtp"])
rounded = SphericalStyle(Input=creature, Roundness=2.0, NormalBlend=0.0, DetailSize=0.0)
view = CreateRenderView(ViewSize=[800, 220], UseColorPaletteForBackground=0,
                        Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)
for place, source in enumerate((
        GaussMap(Input=creature), GaussMap(Input=creature, SphereUnits="Equal Area"),
        GaussMap(Input=rounded, SphereUnits="Equal Area", AreaWeighted=1),
        GaussMap(Input=cube, SphereUnits="Equal Area", NumberOfEqualAreaUnits=100))):
    display = Show(source, view)
    ColorBy(display, ("CELLS", "Density"))
    move(display, 2.2 * place)
colors = GetColorTransferFunction("Density")
colors.RGBPoints = [0.0, 0.2, 0.3, 0.8, 0.5, 1.0, 0.9, 0.2, 4.0, 0.8, 0.1, 0.1]
colors.ColorSpace = "RGB"
Render(view)  # the first one resets the camera
view.CameraPosition, view.CameraFocalPoint = [3.3, -12.0, 5.0], [3.3, 0.0, 0.0]
view.CameraViewUp, view.CameraViewAngle = [0.0, 0.0, 1.0], 11.0
Render(view)
if not smtesting.DoRegressionTesting(view.SMProxy):
    sys.exit("Failed Image Test")
