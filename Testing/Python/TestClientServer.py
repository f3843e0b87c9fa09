# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The filters on a server give what they give in the built-in one: points, arrays, all outputs, facts.

Where there is no PV_PLUGIN_PATH the client loads the plugin here and there.

usage: run_with_server.py PVSERVER PROCESSES pvpython TestClientServer.py PLUGIN DATA PORT PROCESSES
"""
import os
import sys

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

from FilterTable import SURFACE_FILTERS

PLUGIN, DATA = sys.argv[1:3]
PORT, PROCESSES = map(int, sys.argv[3:5])

# What is asked of the filters that have more to say than the table knows; the others get its quick settings.
RUNS = {
    "Spherical Style": ("SphericalStyle", {"Roundness": 1.0, "SphericalWeighting": "Uniform", "GenerateRotation": 1}),
    "Nonlinear Style": ("NonlinearStyle", {"GenerateCellEnergy": 1, "GenerateAuxiliaryScale": 1}),
    "details kept": ("SphericalStyle", {"Roundness": 1.0, "DetailSize": 0.03, "CenterMode": "Custom",
                                        "Center": [0.0, 0.6, 0.1], "KeepOnGround": 1}),
    "blown up": ("SphericalStyle", {"Roundness": 5.0, "NormalBlend": 1.0, "NormalRadius": "Whole Model",
                                    "DetailSize": 0.0, "KeepSize": "Off"}),
    "long edges split": ("SphericalStyle", {"RefineLongEdges": "On", "MaximumEdgeLength": 0.02}),
    "Convex Proxy Deform": ("ConvexProxyDeform", {"Blend": 0.3, "NumberOfProxyPoints": 500}),
    "Handle Deform": ("HandleDeform", {"Handle": [0, 0, 0, 0.3, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0.2, 0.1, 1, 0.1, 0, 40, 0]}),
    "Surface Metrics": ("SurfaceMetrics", {"EstimateCondition": 1, "FindSelfIntersections": 0}),
}
RUNS |= {entry["label"]: (entry["proxy"], entry["quick"]) for entry in SURFACE_FILTERS.values() if entry["label"] not in RUNS}


def contents(data):
    """All numbers and words of a data object, by name."""
    found = {}
    if hasattr(data, "GetPoints") and data.GetPoints():
        found["points"] = vtk_to_numpy(data.GetPoints().GetData()).copy()
    if hasattr(data, "GetPolys"):
        for kind in ("Verts", "Lines", "Polys", "Strips"):
            found[kind] = vtk_to_numpy(getattr(data, "Get" + kind)().GetConnectivityArray()).copy()
    for association in ("PointData", "CellData", "FieldData", "RowData"):
        arrays = getattr(data, "Get" + association, lambda: None)()
        for k in range(arrays.GetNumberOfArrays() if arrays else 0):
            array = arrays.GetAbstractArray(k)
            name = f"{association}/{array.GetName()}"
            if "Seconds" in name or array.GetNumberOfTuples() == 0:  # a table without rows comes without columns
                continue
            if hasattr(array, "GetTuple1"):
                found[name] = vtk_to_numpy(array).copy()
            else:
                found[name] = [str(array.GetVariantValue(i)) for i in range(array.GetNumberOfValues())]
    return found


def facts(proxy):
    """What the filter tells of its execution: the read-only properties."""
    proxy.UpdatePipelineInformation()
    names = [name for name in proxy.ListProperties()
             if proxy.GetProperty(name).SMProperty.GetInformationOnly()]
    return {name: str(proxy.GetPropertyValue(name)) for name in names}


def run_all():
    """{run: (contents of each output, facts)} in the server that we are connected to"""
    LoadPlugin(PLUGIN, remote=False, ns=globals())
    results = {}
    for title, (name, properties) in RUNS.items():
        if name not in globals():
            assert name == "ConvexProxyDeform", name  # needs CGAL
            continue
        model = XMLPolyDataReader(FileName=[os.path.join(DATA, "creature.vtp")])
        if name == "PartSizes":
            model, properties = SurfaceParts(Input=model), {**properties, "PartSize": [1, 1.3]}
        proxy = globals()[name](Input=model, **properties)
        UpdatePipeline(proxy=proxy)
        outputs = [contents(servermanager.Fetch(proxy, idx=k)) for k in range(proxy.SMProxy.GetNumberOfOutputPorts())]
        assert all(outputs), title
        results[title] = outputs, facts(proxy)
    return results


# What each process runs: the cells of its piece, and the points that they use. RedistributeDataSet would send pieces
# as XML, which VTK 9.2 cannot read back with the expat of 2024's security updates (VTK issue 19258).
OWN_PIECE = """
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkFiltersCore import vtkCleanPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

reader = vtkXMLPolyDataReader()
reader.SetFileName("FILE")
reader.Update()
model = reader.GetOutput()
ids = numpy_to_vtkIdTypeArray(np.arange(model.GetNumberOfPoints()), deep=True)
ids.SetName("PointIds")
model.GetPointData().AddArray(ids)
information = self.GetExecutive().GetOutputInformation(0)
piece = information.Get(Pipeline.UPDATE_PIECE_NUMBER())
pieces = information.Get(Pipeline.UPDATE_NUMBER_OF_PIECES())
corners = vtk_to_numpy(model.GetPolys().GetConnectivityArray()).reshape(-1, 3)
own = np.array_split(corners, pieces)[piece]
cells = vtkCellArray()
cells.SetData(3, numpy_to_vtkIdTypeArray(np.ascontiguousarray(own.ravel(), dtype=np.int64), deep=True))
part = vtkPolyData()
part.SetPoints(model.GetPoints())
part.GetPointData().ShallowCopy(model.GetPointData())
part.SetPolys(cells)
used = vtkCleanPolyData()
used.SetInputData(part)
used.PointMergingOff()
used.Update()
self.GetPolyDataOutput().ShallowCopy(used.GetOutput())
"""
ANY_PIECE = """
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
self.GetExecutive().GetOutputInformation(0).Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)
"""


def rounded_points(spread):
    """Points of a model by their ids, and facts. spread: whether all processes have parts of it"""
    file = os.path.join(DATA, "creature.vtp")
    model = XMLPolyDataReader(FileName=[file])
    if spread:
        model = ProgrammableSource(OutputDataSetType="vtkPolyData", ScriptRequestInformation=ANY_PIECE,
                                   Script=OWN_PIECE.replace("FILE", file))
        ids_of = globals().get("ProcessIds") or globals()["ProcessIdScalars"]  # the name of ParaView 6.1, that before
        processes = ids_of(Input=model)
        UpdatePipeline(proxy=processes)
        ids = processes.PointData.GetArray("ProcessId") or processes.PointData.GetArray("PointProcessIds")
        assert ids.GetRange() == (0.0, PROCESSES - 1.0)
    style = SphericalStyle(Input=model, SphericalWeighting="Uniform", OutputPointsPrecision="Double")
    UpdatePipeline(proxy=style)
    found = contents(servermanager.Fetch(style))
    numbers = found["PointData/PointIds"].ravel() if spread else np.arange(len(found["points"]))
    points = np.full((numbers.max() + 1, 3), np.nan)
    points[numbers] = found["points"]
    return points, facts(style)


def same(title, ours, other):
    assert set(ours) == set(other), (title, list(ours), list(other))
    for name, values in ours.items():
        equal = (np.array_equal(values, other[name], equal_nan=values.dtype.kind == "f")
                 if isinstance(values, np.ndarray) else values == other[name])
        assert equal, (title, name, values, other[name])


built_in, (built_in_points, told_built_in) = run_all(), rounded_points(spread=False)
assert built_in["details kept"][1]["CenterPosition"] == "NearSurface"
assert built_in["blown up"][1]["Advice"], built_in["blown up"][1]
Disconnect()

Connect("localhost", PORT)
assert servermanager.ActiveConnection.IsRemote()
assert servermanager.ActiveConnection.GetNumberOfDataPartitions() == PROCESSES
LoadPlugin(PLUGIN, remote=True)
remote = run_all()
assert list(remote) == list(built_in)
for title, (outputs, told) in built_in.items():
    for number, output in enumerate(outputs):
        same((title, number), output, remote[title][0][number])
    assert told == remote[title][1], (title, told, remote[title][1])
print(f"{len(built_in)} runs on a server of {PROCESSES} processes: outputs and facts have the same bits")

points, told = rounded_points(spread=PROCESSES > 1)
largest = np.abs(points - built_in_points).max() / np.ptp(built_in_points)  # NaN if a point is missing
print(f"one surface on {PROCESSES} processes: largest difference of points {largest:.2g} of the size")
assert largest <= (0.0 if PROCESSES == 1 else 1e-9), largest
assert told["NumberOfIterations"] == told_built_in["NumberOfIterations"] != "0"
