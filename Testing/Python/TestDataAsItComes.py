# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Every filter over data as people have it: blocks, time steps, pieces, and what is no surface.

usage: TestDataAsItComes.py DATA
"""
import math
import os
import re
import sys

from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import VTK_STRING, vtkDoubleArray, vtkIntArray
from vtkmodules.vtkCommonDataModel import (vtkDataAssembly, vtkImageData, vtkMultiBlockDataSet, vtkPartitionedDataSet,
                                           vtkPartitionedDataSetCollection, vtkPolyData)
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import sphericalstyle
import FilterTable

FILTERS = [getattr(sphericalstyle, entry["class"]) for name, entry in FilterTable.SURFACE_FILTERS.items()
           if name != "SurfaceDiagnostics"]
assert len(FILTERS) >= 6
TAKES_ALL = sphericalstyle.vtkSurfaceDiagnostics  # points that are not finite are no error for it


def model(name):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(sys.argv[1], f"{name}.vtp"))
    reader.Update()
    surface = reader.GetOutput()
    parts = vtkIntArray()  # for those that want to know
    parts.SetName("PartId")
    for i in range(surface.GetNumberOfPoints()):
        parts.InsertNextValue(2 * i // surface.GetNumberOfPoints())
    surface.GetPointData().AddArray(parts)
    return surface


class Run:
    """A filter's output and errors, of this run alone."""

    def __init__(self, Filter, data):
        self.errors = []
        self.filter = Filter()
        self.filter.AddObserver("ErrorEvent", self.note)
        self.filter.AddObserver("WarningEvent", lambda *_: None)
        self.filter.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)  # says that it failed
        self.again(data)

    def again(self, data):
        self.errors.clear()
        self.filter.SetInputDataObject(0, data)
        self.filter.Update()
        self.output = self.filter.GetOutputDataObject(0)

    def note(self, _caller, _event, text):
        self.errors.append(re.sub(r"^\w+: In .*\n\w+ \(0x[0-9a-f]+\): ", "", text.strip()))

    note.CallDataType = VTK_STRING


def points(surface):
    return [surface.GetPoint(i) for i in range(surface.GetNumberOfPoints())]


def broken(surface):
    """A copy with a point that is no number."""
    copy = vtkPolyData()
    copy.DeepCopy(surface)
    copy.GetPoints().SetPoint(3, math.nan, 0.0, 0.0)
    return copy


def volume(surface):
    """The surface as an unstructured grid."""
    append = vtkAppendFilter()
    append.AddInputData(surface)
    append.Update()
    return append.GetOutput()


def blocks(*named):
    """A multi-block of (name or None, block)."""
    data = vtkMultiBlockDataSet()
    for k, (name, block) in enumerate(named):
        data.SetBlock(k, block)
        if name:
            data.GetMetaData(k).Set(data.NAME(), name)
    return data


def partitions(*named):
    """A collection of (name, partition, partition, ...)."""
    data = vtkPartitionedDataSetCollection()
    for k, (name, *parts) in enumerate(named):
        own = vtkPartitionedDataSet()
        for number, part in enumerate(parts):
            own.SetPartition(number, part)
        data.SetPartitionedDataSet(k, own)
        data.GetMetaData(k).Set(vtkMultiBlockDataSet.NAME(), name)
    return data


stone, ball = model("go-stone"), model("icosahedron")


def test_what_is_no_surface(Filter):
    for data, name in ((volume(stone), "vtkUnstructuredGrid"), (vtkImageData(), "vtkImageData")):
        run = Run(Filter, data)
        assert len(run.errors) == 1, run.errors
        assert run.errors[0].startswith(f"the input is a {name} and not a surface"), run.errors
        assert "Extract Surface" in run.errors[0] and "vtkDataSetSurfaceFilter" in run.errors[0]
        assert run.output.GetNumberOfPoints() == 0
        run.again(stone)
        assert not run.errors and points(run.output) == points(Run(Filter, stone).output)


def test_blocks(Filter):
    inner = blocks((None, None), (None, broken(stone)), ("Wheel", broken(ball)))
    run = Run(Filter, blocks(("Body", stone), ("Car", inner), ("Nothing", vtkPolyData()), ("Gap", None),
                             ("Glass", volume(stone)), (None, ball)))
    assert [error.split(": ")[0] for error in run.errors] == [
        'block "Car/1"', 'block "Car/Wheel"', 'block "Glass"'], run.errors
    assert "point 3 is not finite" in run.errors[0], run.errors
    assert "Extract Surface" in run.errors[2], run.errors
    output = run.output
    assert output.GetNumberOfBlocks() == 6 and output.GetMetaData(0).Get(output.NAME()) == "Body"
    assert output.GetBlock(2).GetNumberOfPoints() == 0 and output.GetBlock(3) is None
    for k, alone in ((0, stone), (5, ball)):
        expected = points(Run(Filter, alone).output)
        assert expected and points(output.GetBlock(k)) == expected, k

    # Nothing of it is left for a surface alone.
    run.again(broken(stone))
    assert len(run.errors) == 1 and "block" not in run.errors[0], run.errors


def test_partitions(Filter):
    data = partitions(("Front", stone), ("Back", ball, broken(ball)))
    tree = vtkDataAssembly()
    tree.SetRootNodeName("Car")
    tree.AddDataSetIndex(tree.AddNode("Doors", tree.AddNode("Body")), 1)
    data.SetDataAssembly(tree)
    run = Run(Filter, data)
    assert len(run.errors) == 1 and run.errors[0].startswith('block "Back/1": '), run.errors
    assert points(run.output.GetPartition(1, 0)) == points(Run(Filter, ball).output)
    assert run.output.GetMetaData(1).Get(vtkMultiBlockDataSet.NAME()) == "Back"
    kept = run.output.GetDataAssembly()
    assert list(kept.GetDataSetIndices(kept.GetFirstNodeByPath("/Car/Body/Doors"))) == [1]


class Series(VTKPythonAlgorithmBase):
    """A stone that grows: at time t it is t times as large."""
    TIMES = [1.0, 2.0, 4.0]

    def __init__(self):
        VTKPythonAlgorithmBase.__init__(self, nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")

    def RequestInformation(self, _request, _inputs, outputs):
        info = outputs.GetInformationObject(0)
        info.Set(vtkStreamingDemandDrivenPipeline.TIME_STEPS(), self.TIMES, len(self.TIMES))
        info.Set(vtkStreamingDemandDrivenPipeline.TIME_RANGE(), [self.TIMES[0], self.TIMES[-1]], 2)
        return 1

    def RequestData(self, _request, _inputs, outputs):
        info = outputs.GetInformationObject(0)
        time = info.Get(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())
        output = vtkPolyData.GetData(outputs)
        output.DeepCopy(self.at(time))
        output.GetInformation().Set(output.DATA_TIME_STEP(), time)
        return 1

    @staticmethod
    def at(time):
        surface = vtkPolyData()
        surface.DeepCopy(stone)
        for i in range(surface.GetNumberOfPoints()):
            surface.GetPoints().SetPoint(i, [time * x for x in stone.GetPoint(i)])
        return surface


def test_time_steps(Filter):
    series, Filter_ = Series(), Filter()
    Filter_.SetInputConnection(series.GetOutputPort())
    for time in Series.TIMES + Series.TIMES[:1]:  # and back to the first
        Filter_.UpdateTimeStep(time)
        output = Filter_.GetOutput()
        assert points(output) == points(Run(Filter, Series.at(time)).output), time
        assert output.GetInformation().Get(output.DATA_TIME_STEP()) == time


class Source(VTKPythonAlgorithmBase):
    """The stone: in pieces, where pieces are asked for."""

    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")

    def RequestInformation(self, _request, _inputs, outputs):
        outputs.GetInformationObject(0).Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)
        return 1

    def RequestData(self, _request, _inputs, outputs):
        info = outputs.GetInformationObject(0)
        piece = info.Get(vtkStreamingDemandDrivenPipeline.UPDATE_PIECE_NUMBER())
        pieces = info.Get(vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_PIECES())
        output = vtkPolyData.GetData(outputs)
        output.DeepCopy(stone)
        for cell in range(stone.GetNumberOfCells()):
            if cell % pieces != piece:
                output.DeleteCell(cell)
        output.RemoveDeletedCells()
        return 1


def test_pieces(Filter):
    """Whoever asks for pieces gets the whole in the first one."""
    source, filter_ = Source(), Filter()
    filter_.SetInputConnection(source.GetOutputPort())
    filter_.UpdatePiece(0, 2, 0)
    assert points(filter_.GetOutput()) == points(Run(Filter, stone).output)
    filter_.UpdatePiece(1, 2, 0)
    assert filter_.GetOutput().GetNumberOfPoints() == 0


def test_arrays_of_other_lengths(Filter):
    """VTK's reader of old files lets them through. They come out as they are, or there is one error."""
    surface = vtkPolyData()
    surface.DeepCopy(stone)
    for data, count in ((surface.GetPointData(), 300000), (surface.GetCellData(), 300000), (surface.GetPointData(), 3)):
        array = vtkDoubleArray()
        array.SetName(f"of {count}")
        array.SetNumberOfComponents(3)
        array.SetNumberOfTuples(count)
        array.Fill(1.0)
        data.AddArray(array)
    filter_ = Filter()
    if hasattr(filter_, "TransformAllInputVectorsOn"):
        filter_.TransformAllInputVectorsOn()
    errors = []
    filter_.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    filter_.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    filter_.AddObserver("WarningEvent", lambda *_: None)
    filter_.SetInputData(surface)
    filter_.Update()
    assert len(errors) == (0 if filter_.GetOutput().GetNumberOfPoints() > 0 else 1), errors


for Filter in FILTERS + [TAKES_ALL]:
    for test in (test_what_is_no_surface, test_blocks, test_partitions, test_time_steps, test_pieces,
                 test_arrays_of_other_lengths):
        if Filter is TAKES_ALL and test in (test_blocks, test_partitions):
            continue
        try:
            test(Filter)
        except AssertionError:
            print(f"ERROR: {test.__name__} of {Filter.__name__}", file=sys.stderr)
            raise
