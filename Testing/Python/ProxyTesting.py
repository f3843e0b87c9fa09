# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of several proxies share: a model, what arrives of an execution, states, pictures."""
import math
import os

from paraview import servermanager, smtesting
from paraview.simple import *

import sphericalstyle  # noqa: F401, gives the C++ object behind a proxy its methods


def make_long_sphere():
    """A ball of radius 0.5, stretched to twice its height."""
    sphere = Sphere(ThetaResolution=32, PhiResolution=32)
    model = Calculator(Input=sphere, Function="coordsX*iHat + coordsY*jHat + 2*coordsZ*kHat",
                       CoordinateResults=1)
    UpdatePipeline(proxy=model)
    return model


def make_growing_sphere():
    """A ball of radius 0.5 with three time steps, at each of which its height is the time."""
    return ProgrammableSource(
        OutputDataSetType="vtkPolyData",
        ScriptRequestInformation="""
executive = self.GetExecutive()
information = executive.GetOutputInformation(0)
information.Set(executive.TIME_STEPS(), [1.0, 2.0, 3.0], 3)
information.Set(executive.TIME_RANGE(), [1.0, 3.0], 2)
""",
        Script="""
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
executive = self.GetExecutive()
time = executive.GetOutputInformation(0).Get(executive.UPDATE_TIME_STEP())
source, stretch, transform = vtkSphereSource(), vtkTransform(), vtkTransformPolyDataFilter()
source.SetThetaResolution(24)
source.SetPhiResolution(24)
stretch.Scale(1.0, 1.0, time)
transform.SetTransform(stretch)
transform.SetInputConnection(source.GetOutputPort())
transform.Update()
self.GetOutput().ShallowCopy(transform.GetOutput())
""")


def update(proxy):
    UpdatePipeline(proxy=proxy)
    proxy.UpdatePipelineInformation()


def bounds(proxy):
    return proxy.GetDataInformation().GetBounds()


def arrays(proxy):
    """{name: components} of the point arrays."""
    data = servermanager.Fetch(proxy).GetPointData()
    return {data.GetArrayName(k): data.GetArray(k).GetNumberOfComponents()
            for k in range(data.GetNumberOfArrays())}


def points(data_set):
    return [data_set.GetPoint(i) for i in range(data_set.GetNumberOfPoints())]


def check_entries(proxy, names):
    """Each entry of each enumeration reaches C++ and runs."""
    for name in names:
        in_cxx = getattr(proxy.SMProxy.GetClientSideObject(), "Get" + name)
        entries = list(proxy.GetProperty(name).GetAvailable())
        assert len(entries) > 1, (name, entries)
        default = entries[in_cxx()]
        for value, entry in enumerate(entries):
            proxy.SetPropertyWithName(name, entry)
            update(proxy)
            assert in_cxx() == value, (name, entry, in_cxx())
            assert all(map(math.isfinite, bounds(proxy))), (name, entry)
        proxy.SetPropertyWithName(name, default)


def check_state(proxy, file):
    """The proxy comes back from a state file with the same bounds. @return the one of the file"""
    RenameSource("Kept", proxy)
    update(proxy)
    kept_bounds = bounds(proxy)
    SaveState(file)
    ResetSession()
    LoadState(file)
    kept = FindSource("Kept")
    update(kept)
    assert bounds(kept) == kept_bounds, (bounds(kept), kept_bounds)
    return kept


def check_blocks(make_filter, data):
    """Blocks keep to themselves: each comes out as it does alone."""
    models = [XMLPolyDataReader(FileName=[os.path.join(data, name)])
              for name in ("go-stone.vtp", "icosahedron.vtp")]
    together = make_filter(Input=GroupDatasets(Input=models))
    UpdatePipeline(proxy=together)
    blocks = servermanager.Fetch(together)
    assert blocks.GetNumberOfBlocks() == 2
    for k, model in enumerate(models):
        single = make_filter(Input=model)
        UpdatePipeline(proxy=single)
        own = servermanager.Fetch(single)
        assert own.GetNumberOfPoints() > 0 and points(own) == points(blocks.GetBlock(k)), k


def move(display, x):
    """Shows it moved by x along the first axis."""
    setattr(display, "Position" if GetParaViewVersion() < (5, 13) else "Translation", [x, 0.0, 0.0])


def same_picture(outputs, representation="Surface"):
    """Whether the outputs side by side look like the baseline of the command line."""
    view = CreateRenderView(ViewSize=[800, 200], UseColorPaletteForBackground=0,
                            Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)
    for place, output in enumerate(outputs):
        display = Show(output, view)
        display.ColorArrayName = ["POINTS", ""]
        display.Representation = representation
        display.AmbientColor = display.DiffuseColor = [0.88, 0.62, 0.47]
        move(display, 1.3 * place)
    Render(view)  # the first one resets the camera
    view.CameraPosition, view.CameraFocalPoint = [1.95, 0.9, 8.0], [1.95, 0.45, 0.0]
    view.CameraViewUp, view.CameraViewAngle = [0.0, 1.0, 0.0], 9.0
    Render(view)
    return smtesting.DoRegressionTesting(view.SMProxy)
