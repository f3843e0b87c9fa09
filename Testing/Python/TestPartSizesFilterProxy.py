# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads, its proxy resizes the parts that rows say, after Surface Parts and Spherical Style; table and
arrays arrive, and a state brings the rows back.

usage: pvpython TestPartSizesFilterProxy.py SphericalStyle.so FOLDER_FOR_A_STATE
"""
import os
import sys

from paraview import servermanager
from paraview.simple import *
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import sphericalstyle  # gives the C++ object behind the proxy its methods

LoadPlugin(sys.argv[1], remote=False, ns=globals())


def sizes_of(filter_):
    """The rows of the second output."""
    UpdatePipeline(proxy=filter_)
    table = servermanager.Fetch(filter_, idx=1)
    columns = [table.GetColumn(i) for i in range(table.GetNumberOfColumns())]
    assert [column.GetName() for column in columns] == ["Part", "Size", "HeightBefore", "Height"]
    return [[column.GetValue(row) for column in columns] for row in range(table.GetNumberOfRows())]


# ----------------------------------------------------------------- defaults, as the panel gets them
body = Sphere(ThetaResolution=32, PhiResolution=32, Radius=1.0)
head = Sphere(ThetaResolution=32, PhiResolution=32, Radius=0.6, Center=[0.0, 1.35, 0.0])
parts = SurfaceParts(Input=AppendGeometry(Input=[body, head]))
rounded = SphericalStyle(Input=parts)
sized = PartSizes(Input=rounded)
assert (list(sized.PartSize), sized.HeadHeight, sized.Head, list(sized.PartArray)[-1]) \
    == ([], 0.0, -1, "None"), (list(sized.PartSize), list(sized.PartArray))
assert [row[:2] for row in sizes_of(sized)] == [[0, 1.0], [1, 1.0]]

# -------------------------------------------------------------------------------------------- rows
sized.PartSize = [1, 1.6, 0, 0.8]
rows = sizes_of(sized)
assert [row[:2] for row in rows] == [[0, 0.8], [1, 1.6]], rows
assert rows[1][3] > 1.3 * rows[1][2], rows
sized.PartSize = [1, 1.6]
assert [row[:2] for row in sizes_of(sized)] == [[0, 1.0], [1, 1.6]]
sized.PartSize = []
sized.PartRoundness, sized.PartNormalBlend = [0, 0.0], [0, 0.25, 1, 1.0]
sized.UpdatePipeline()
assert {"PartRoundness", "PartNormalBlend"} <= set(sized.PointData.keys()), sized.PointData.keys()
assert sized.PointData["PartRoundness"].GetRange(0)[0] < 1e-3, "a part that is not rounded"
sized.PartRoundness, sized.PartNormalBlend = [], []
assert [row[:2] for row in sizes_of(sized)] == [[0, 1.0], [1, 1.0]]

# ------------------------------------------------------------------------------------ head to body
sized.HeadHeight = 0.5
rows = sizes_of(sized)
assert abs(rows[1][3] / rows[0][3] - 0.5) < 1e-4, rows

# --------------------------------------------------------------------------- what Apply shows
controller = vtkSMParaViewPipelineControllerWithRendering()
view = CreateRenderView()
assert controller.ShowInPreferredView(sized.SMProxy, 0, view.SMProxy) is not None
assert controller.ShowInPreferredView(sized.SMProxy, 1, view.SMProxy) is None
assert len(GetViews()) == 1

# ------------------------------------------------------------------------------------------ state
sized.PartSize = [1, 1.2, 0, 0.9]
RenameSource("Kept", sized)
before = sizes_of(sized)
state = os.path.join(sys.argv[2], "TestPartSizesFilterProxy.pvsm")
SaveState(state)
ResetSession()
LoadState(state)
kept = FindSource("Kept")
assert list(kept.PartSize) == [1, 1.2, 0, 0.9] and kept.HeadHeight == 0.5, list(kept.PartSize)
assert sizes_of(kept) == before, sizes_of(kept)
