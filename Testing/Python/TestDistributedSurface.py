# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces and blocks spread over processes come out as they do in one process.

Every process runs this script; each has the whole model as well, to compare with.

usage: mpirun -np N pvbatch --sym TestDistributedSurface.py DATA [CHECK... | --without CHECK...]
"""
import math
import os
import sys
import time
import traceback

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import VTK_STRING, vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkDataSetAttributes, vtkImageData, vtkMultiBlockDataSet,
                                           vtkPartitionedDataSetCollection, vtkPolyData, vtkSelection,
                                           vtkSelectionNode, vtkUnstructuredGrid)
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkPolyDataNormals
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersParallel import vtkAggregateDataSetFilter
from vtkmodules.vtkImagingCore import vtkImageShiftScale
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

import sphericalstyle

DATA = sys.argv[1]
controller = vtkMultiProcessController.GetGlobalController()
RANK, RANKS = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
GHOSTS = vtkDataSetAttributes.GhostArrayName()
TOLERANCE = 1e-9
if RANKS < 2:
    print("There is one process only: this program was not started by the mpirun of its MPI, or has none.")
    sys.exit(77)


# ------------------------------------------------------------------------------------------- models
def model(name):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(DATA, name))
    reader.Update()
    return in_double(reader.GetOutput())


def in_double(surface):
    """A copy with points in double precision and normals: 1e-9 says something of them."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(surface)
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.Update()
    result = vtkPolyData()
    result.ShallowCopy(normals.GetOutput())
    points = vtkPoints()
    points.SetData(numpy_to_vtk(coordinates(result).astype(float), deep=True))
    result.SetPoints(points)
    add(result.GetPointData(), "height", coordinates(result)[:, 1] - coordinates(result)[:, 1].min())
    add(result.GetCellData(), "number", np.arange(result.GetNumberOfCells()))
    return result


def coordinates(surface):
    points = surface.GetPoints()
    return vtk_to_numpy(points.GetData()) if points else np.zeros((0, 3))


def add(attributes, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    attributes.AddArray(array)
    return array


def triangles(surface):
    assert surface.GetPolys().IsHomogeneous() == 3 and surface.GetNumberOfPolys() == surface.GetNumberOfCells()
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


class Piece:
    """The cells of a model that one process has, and which points and cells of the model those are."""

    def __init__(self, whole, owner, global_ids=False, ghost_levels=0, last_owns=False):
        """owner: the process of each cell. A point belongs to the first of the processes of its cells, or to the last."""
        corners = triangles(whole)
        has = owner == RANK
        for _ in range(ghost_levels):
            has |= np.isin(corners, corners[has]).any(axis=1)
        self.cells = np.flatnonzero(has)
        self.points = np.unique(corners[has])
        self.data = vtkPolyData()
        if self.cells.size == 0:
            return
        points = vtkPoints()
        points.SetData(numpy_to_vtk(coordinates(whole)[self.points], deep=True))
        self.data.SetPoints(points)
        cells = vtkCellArray()
        local = np.searchsorted(self.points, corners[self.cells])
        cells.SetData(3, numpy_to_vtkIdTypeArray(np.ascontiguousarray(local).ravel(), deep=True))
        self.data.SetPolys(cells)
        self.copy(whole.GetPointData(), self.points, self.data.GetPointData())
        self.copy(whole.GetCellData(), self.cells, self.data.GetCellData())
        if global_ids:
            for attributes, ids in ((self.data.GetPointData(), self.points),
                                    (self.data.GetCellData(), self.cells)):
                array = numpy_to_vtkIdTypeArray(ids.astype(np.int64), deep=True)
                array.SetName("GlobalIds")
                attributes.SetGlobalIds(array)
        if ghost_levels > 0:
            point_owner = np.full(whole.GetNumberOfPoints(), -1 if last_owns else RANKS)
            (np.maximum if last_owns else np.minimum).at(point_owner, corners.ravel(), np.repeat(owner, 3))
            add(self.data.GetCellData(), GHOSTS, (owner[self.cells] != RANK).astype(np.uint8))
            add(self.data.GetPointData(), GHOSTS, (point_owner[self.points] != RANK).astype(np.uint8))

    @staticmethod
    def copy(source, ids, target):
        for k in range(source.GetNumberOfArrays()):
            array = source.GetArray(k)
            copy = add(target, array.GetName(), vtk_to_numpy(array)[ids])
            if array is source.GetNormals():
                target.SetNormals(copy)


def in_slices(whole, processes=RANKS):
    """The process of each cell: along x, about as many each."""
    middles = coordinates(whole)[triangles(whole)].mean(axis=1)[:, 0]
    rank_of = np.empty(middles.size, dtype=int)
    rank_of[np.argsort(middles, kind="stable")] = np.arange(middles.size) * processes // middles.size
    return rank_of


def scattered(whole):
    """Neighboring cells on different processes, everywhere."""
    return np.random.default_rng(1).integers(0, RANKS, whole.GetNumberOfCells())


def in_boxes(whole):
    """The process of each cell by a kd-tree, as VTK redistributes data: across the longest axis of what is left, and
    about as many cells for each process."""
    middles = coordinates(whole)[triangles(whole)].mean(axis=1)
    owner = np.empty(len(middles), dtype=int)

    def split(cells, first, processes):
        if processes == 1:
            owner[cells] = first
            return
        axis = np.argmax(np.ptp(middles[cells], axis=0))
        cells = cells[np.argsort(middles[cells, axis], kind="stable")]
        half = processes // 2
        cut = len(cells) * half // processes
        split(cells[:cut], first, half)
        split(cells[cut:], first + half, processes - half)
    split(np.arange(len(middles)), 0, RANKS)
    return owner


# ---------------------------------------------------------------------------------- runs, compared
class Run:
    """A filter's outputs and errors; alone: in this process, as if there were no other."""

    def __init__(self, Filter, data, alone=False, prepare=None, **properties):
        self.errors, self.warnings, self.told = [], [], []

        def note(_caller, _event, text):
            self.errors.append(text)

        def tell(_caller, _event, text):
            self.warnings.append(1)
            self.told.append(text)

        note.CallDataType = tell.CallDataType = VTK_STRING
        self.filter = Filter()
        if alone:
            self.filter.SetController(None)
        for name, value in properties.items():
            getattr(self.filter, "Set" + name)(value)
        self.filter.AddObserver("ErrorEvent", note)
        self.filter.AddObserver("WarningEvent", tell)
        self.filter.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
        self.filter.SetInputDataObject(0, data)
        if prepare:
            prepare(self.filter)
        self.filter.Update()
        self.output = self.filter.GetOutputDataObject(0)


class AloneRun(Run):
    """In the first process, as if there were no other. The others have no filter, and get its output."""

    def __init__(self, Filter, data, **options):
        if RANK == 0:
            super().__init__(Filter, data, alone=True, **options)
        else:
            self.errors, self.output = [], vtkPolyData()
        controller.Broadcast(self.output, 0)


def names(attributes):
    return [attributes.GetArrayName(k) for k in range(attributes.GetNumberOfArrays())]


def greatest(value):
    """Of all processes."""
    mine, all_ = (numpy_to_vtk(np.array([float(value)]), deep=True) for _ in range(2))
    controller.AllReduce(mine, all_, vtkCommunicator.MAX_OP)
    return all_.GetValue(0)


def difference(a, b):
    """The largest; none where neither is a number, infinite where one is."""
    no_numbers = np.isnan(a) & np.isnan(b)
    differences = np.where(no_numbers, 0.0, np.abs(a - b))
    return float(np.nan_to_num(differences, nan=np.inf).max()) if a.size else 0.0


def compare(piece, output, alone, tolerance=TOLERANCE):
    """The largest difference of the points of the output from those of a run over the whole."""
    assert output.GetNumberOfPoints() == piece.points.size, (output.GetNumberOfPoints(), piece.points.size)
    assert output.GetNumberOfCells() == piece.cells.size
    if piece.points.size == 0:
        return 0.0
    assert (triangles(output) == triangles(piece.data)).all()
    for mine, given, whole, ids in (
            (output.GetPointData(), piece.data.GetPointData(), alone.GetPointData(), piece.points),
            (output.GetCellData(), piece.data.GetCellData(), alone.GetCellData(), piece.cells)):
        own = {"GlobalIds", GHOSTS}
        assert set(names(mine)) - own == set(names(whole)), (names(mine), names(whole))
        assert set(names(mine)) & own == set(names(given)) & own, names(mine)
        for name in set(names(given)) & own:
            assert mine.GetArray(name) is given.GetArray(name), name
        for name in names(whole):
            values = vtk_to_numpy(whole.GetArray(name))[ids]
            # Rounding of the number type: normals are in single precision.
            most = tolerance * np.abs(values[np.isfinite(values)]).max(initial=1.0)
            most += (values.dtype == np.float32) * 2e-7
            assert difference(vtk_to_numpy(mine.GetArray(name)), values) <= most, (
                name, difference(vtk_to_numpy(mine.GetArray(name)), values))
        assert (mine.GetNormals() is None) == (whole.GetNormals() is None)
    return difference(coordinates(output), coordinates(alone)[piece.points])


def check_spread(title, Filter, whole, owner, exact=False, global_ids=False, ghost_levels=0, **options):
    piece = Piece(whole, owner, global_ids, ghost_levels)
    before = vtkPolyData()
    before.DeepCopy(piece.data)
    run = Run(Filter, piece.data, **options)
    alone = AloneRun(Filter, whole, **options)
    assert not run.errors and not alone.errors
    size = coordinates(whole).max() - coordinates(whole).min()
    largest = greatest(compare(piece, run.output, alone.output) / size)
    assert difference(coordinates(before), coordinates(piece.data)) == 0.0
    assert names(before.GetPointData()) == names(piece.data.GetPointData())
    moved = greatest(difference(coordinates(alone.output), coordinates(whole)) / size)
    if RANK == 0:
        print(f"{title}: largest difference of points {largest:.2g} of the size, largest move {moved:.2g}",
              flush=True)
        assert len(run.warnings) == len(alone.warnings), (run.warnings, alone.warnings)
        check_facts(run.filter, alone.filter)
    assert moved > 1e-3 and largest <= (0.0 if exact else TOLERANCE), largest
    return run, alone


def check_facts(filter_, alone):
    """What the first process tells is what one process tells."""
    for name in ("EffectiveCenter", "EffectiveRadius", "FinalEnergy", "NumberOfIterations"):
        if hasattr(filter_, "Get" + name):
            values = [np.array(getattr(f, "Get" + name)()) for f in (filter_, alone)]
            assert np.allclose(*values, rtol=1e-7, atol=1e-9), (name, values)
    for port in range(1, filter_.GetNumberOfOutputPorts()):
        ours, other = (f.GetOutputDataObject(port) for f in (filter_, alone))
        for kind in (0, 1):
            assert ours.GetNumberOfElements(kind) == other.GetNumberOfElements(kind), (port, kind)


Style = sphericalstyle.vtkSphericalStyleFilter
ITERATES = {"SphericalWeighting": Style.UNIFORM}
creature = model("creature.vtp")
small = model("go-stone.vtp")


def check_one_surface():
    """In pieces of every kind."""
    first, last = np.zeros(creature.GetNumberOfCells(), int), np.full(creature.GetNumberOfCells(), RANKS - 1)
    check_spread("slices", Style, creature, in_slices(creature))
    check_spread("slices, details flattened", Style, creature, in_slices(creature), DetailSize=0.0)
    check_spread("slices, minimized", Style, creature, in_slices(creature), **ITERATES)
    check_spread("scattered cells", Style, creature, scattered(creature), **ITERATES)
    check_spread("ghost cells", Style, creature, in_slices(creature), ghost_levels=1, **ITERATES)
    check_spread("two layers of ghost cells, scattered", Style, small, scattered(small), ghost_levels=2)
    check_spread("global ids", Style, creature, scattered(creature), exact=True, global_ids=True, **ITERATES)
    check_spread("global ids and ghost cells", Style, creature, in_slices(creature), exact=True,
                 global_ids=True, ghost_levels=1, **ITERATES)
    check_spread("some processes empty", Style, creature, in_slices(creature, 2) * (RANKS - 1))
    check_spread("all on the last process", Style, creature, last, exact=True, **ITERATES)
    check_spread("all on the first process", Style, creature, first, exact=True)
    check_spread("all kinds of arrays", sphericalstyle.vtkThesisStyleFilter, small, in_slices(small), ghost_levels=1, NormalBlend=0.3,
                 GenerateCellEnergy=True, GenerateRotation=True, GenerateNormals=True, **ITERATES)
    check_spread("another filter: nonlinear", sphericalstyle.vtkNonlinearStyleFilter, small, in_slices(small),
                 exact=True, global_ids=True, MaximumNumberOfIterations=5)
    # Its energy is flat between two axes, and rounding grows there; with ids there is none.
    check_spread("another filter: cubic", sphericalstyle.vtkCubicStyleFilter, small, in_slices(small),
                 exact=True, global_ids=True)
    check_spread("another filter: analogy", sphericalstyle.vtkNormalAnalogyFilter, small, in_slices(small))
    check_spread("another filter: projection", sphericalstyle.vtkSphereProjectionFilter, small, in_slices(small))
    check_spread("another filter: part sizes, of parts that it looks for", sphericalstyle.vtkPartSizesFilter, small,
                 in_slices(small), prepare=lambda f: f.SetPartSize(0, 1.3))
    run = Run(sphericalstyle.vtkSurfacePartsFilter, Piece(small, in_slices(small)).data)
    assert not run.errors and run.output.GetCellData().GetScalars().GetName() == "PartId"
    if hasattr(sphericalstyle, "vtkConvexProxyDeformFilter"):
        check_spread("another filter: proxy", sphericalstyle.vtkConvexProxyDeformFilter, creature,
                     in_slices(creature), Blend=0.3)


def bytes_exchanged(run):
    """Sent and received by each process, or None where the surface was gathered; known to the first process."""
    array = run.filter.GetOutputDataObject(1).GetFieldData().GetArray("BytesExchanged")
    return vtk_to_numpy(array) if array else None


def check_parts():
    """In closed form each process rounds its own part, whatever it is, as one process rounds the whole."""
    flat = {"DetailSize": 0.0}
    cases = {
        "as by default": {},
        "no normals": {"NormalBlend": 0.0},
        "small details, normals of the whole": {"DetailSize": 0.04, "NormalRadius": Style.WHOLE_MODEL_RADIUS},
        "flat": flat,
        "flat, normals of the whole": {**flat, "NormalRadius": Style.WHOLE_MODEL_RADIUS, "GenerateRotation": True},
        "volume": {"KeepSize": Style.VOLUME, "KeepOnGround": True, "UpAxis": 2, "RadiusMode": Style.EQUAL_VOLUME,
                   "CenterMode": Style.POINT_MEAN, "GenerateRotation": True, "TransformAllInputVectors": True},
        "flat, extent": {**flat, "KeepSize": Style.EXTENT, "CenterMode": Style.CUSTOM_CENTER,
                         "Center": (0.1, 0.5, 0.0), "NormalBlend": 0.2},
    }
    whole = vtkPolyData()
    whole.ShallowCopy(creature)
    places = coordinates(whole)
    add(whole.GetPointData(), "factor", 0.5 + places[:, 1] ** 2)
    add(whole.GetPointData(), "blend", np.clip(places[:, 1] - places[:, 1].min(), 0.0, 1.0))
    add(whole.GetPointData(), "target", np.sin(7.0 * places))
    cells = whole.GetNumberOfCells()
    not_first = np.where(in_slices(whole) == 0, RANKS - 1, in_slices(whole))
    pieces = {
        "slices": (in_slices(whole), {}),
        "scattered": (scattered(whole), {}),
        "boxes of a kd-tree": (in_boxes(whole), {}),
        "boxes and ghost cells": (in_boxes(whole), {"ghost_levels": 1}),
        "all on the last process": (np.full(cells, RANKS - 1), {}),
        "nothing on the first process": (not_first, {}),
        "ghost cells": (in_slices(whole), {"ghost_levels": 1}),
        "two layers of ghost cells, scattered": (scattered(whole), {"ghost_levels": 2}),
        "global ids and ghost cells": (in_slices(whole), {"ghost_levels": 1, "global_ids": True}),
    }

    def arrays(filter_):
        for index, name in ((1, "factor"), (2, "blend")):
            filter_.SetInputArrayToProcess(index, 0, 0, 0, name)

    def targets(filter_):
        filter_.SetInputArrayToProcess(3, 0, 0, 0, "target")

    styled = vtkPolyData()  # how parts are to be rounded, taken by these names
    styled.ShallowCopy(whole)
    high = np.clip(places[:, 1] - places[:, 1].mean(), 0.0, 1.0)
    add(styled.GetPointData(), "PartRoundness", 1.0 - high)
    add(styled.GetPointData(), "PartNormalBlend", np.stack([0.25 + 0.0 * high, high], axis=1))

    jobs = [(case, whole, {**options}, None) for case, options in cases.items()]
    jobs += [("arrays", whole, {}, arrays), ("flat, arrays", whole, flat, arrays), ("targets", whole, flat, targets),
             ("parts", styled, {}, None)]
    largest = 0.0
    for case, model, options, prepare in jobs:
        alone = AloneRun(Style, model, prepare=prepare, **options)
        for title, (owner, kind) in pieces.items():
            if title not in ("slices", "scattered") and case not in ("volume", "flat, arrays"):
                continue
            piece = Piece(model, owner, **kind)
            if kind:  # what a process has of a point that another one owns does not count
                ghosts = vtk_to_numpy(piece.data.GetPointData().GetArray(GHOSTS)) > 0
                vtk_to_numpy(piece.data.GetPointData().GetArray("factor"))[ghosts] = 1e3
            runs = [Run(Style, piece.data, prepare=prepare, **options) for _ in range(2)]
            assert not alone.errors + runs[0].errors, (title, case, runs[0].errors)
            if kind:
                runs[0].output.GetPointData().RemoveArray("factor")
                reference = vtkPolyData()
                reference.ShallowCopy(alone.output)
                reference.GetPointData().RemoveArray("factor")
            else:
                reference = alone.output
            found = greatest(compare(piece, runs[0].output, reference) / np.ptp(places))
            largest = max(largest, found)
            assert found <= 1e-10, (case, title, found)
            assert difference(coordinates(runs[0].output), coordinates(runs[1].output)) == 0.0, (case, title)
            if RANK == 0 and RANKS > 1:
                assert bytes_exchanged(runs[0]).shape == (RANKS, 2), (case, title)
                check_facts(runs[0].filter, alone.filter)
                assert runs[0].filter.GetAdvice() == alone.filter.GetAdvice(), (case, title)
    if RANK == 0:
        print(f"parts: largest difference of points {largest:.2g} of the size", flush=True)


def check_bytes():
    """What is sent does not grow with the number of points, but for those on the borders of the parts."""
    divide = vtkLinearSubdivisionFilter()
    divide.SetInputData(creature)
    divide.Update()
    fine = in_double(divide.GetOutput())
    sent = []
    for surface in (creature, fine):
        run = Run(Style, Piece(surface, in_slices(surface)).data, DetailSize=0.12)  # with triangles in all its cells
        sent.append(bytes_exchanged(run))
    if RANK == 0:
        print(f"bytes sent and received at {creature.GetNumberOfPoints()} points: {sent[0].tolist()}, "
              f"at {fine.GetNumberOfPoints()}: {sent[1].tolist()}", flush=True)
        assert (sent[1] <= 1.5 * sent[0]).all()


def gathered(values):
    """The rows of all processes, on all of them."""
    values = np.ascontiguousarray(values, dtype=float)
    mine, all_ = numpy_to_vtk(values, deep=True), vtkDoubleArray()
    all_.SetNumberOfComponents(values.shape[1])
    controller.AllGatherV(mine, all_)
    return vtk_to_numpy(all_).reshape(-1, values.shape[1])


def numbers_of(output):
    """Those of its points in the whole model."""
    return vtk_to_numpy(output.GetPointData().GetArray("point")) if output.GetNumberOfPoints() else np.zeros(0, int)


def count_open_edges(output):
    """Edges that an odd number of triangles has, of all processes together; several may have the same triangle."""
    corners = numbers_of(output)[triangles(output)] if output.GetNumberOfCells() else np.zeros((0, 3))
    corners = gathered(corners)
    first = np.argmin(corners, axis=1)[:, np.newaxis]
    corners = np.unique(np.take_along_axis(corners, (first + [0, 1, 2]) % 3, axis=1), axis=0)
    edges = np.sort(np.concatenate([corners[:, k] for k in ([0, 1], [1, 2], [2, 0])]), axis=1)
    return int(np.sum(np.unique(edges, axis=0, return_counts=True)[1] % 2))


def drag(filter_, by=1.0):
    filter_.SetCenterModeToCustom()
    filter_.SetCenter(0.03, 0.5 + 0.01 * by, 0.02)
    filter_.SetRoundness(1.0 + 0.2 * by)


def preview(run):
    """After the full result."""
    drag(run.filter)
    run.filter.PreviewOn()
    run.filter.Update()
    assert not run.errors, run.errors
    return run.output


def size_of_all(run):
    return int(gathered([[run.output.GetNumberOfPoints()]]).sum())


def large_creature():
    """So large that it has a preview."""
    divide = vtkLinearSubdivisionFilter()
    divide.SetNumberOfSubdivisions(2)
    divide.SetInputData(creature)
    divide.Update()
    large = in_double(divide.GetOutput())
    add(large.GetPointData(), "point", np.arange(large.GetNumberOfPoints()))
    return large


def check_preview():
    """Each process makes a coarse copy of its part, which lies on the full result of one process; where one of them
    cannot, the result is full on all."""
    # From the full result, of the diagonal; measured: 1e-4 to 6e-4, and 2e-3 or more where a sum or mean is wrong.
    wanted, most = 25000, 1e-3
    whole = large_creature()
    diagonal = np.linalg.norm(np.ptp(coordinates(whole), axis=0))
    slices = in_slices(whole)
    not_first = np.where(slices == 0, RANKS - 1, slices)
    flat = {"DetailSize": 0.0, "NormalBlend": 0.0, "KeepSize": Style.VOLUME}
    ground = {"KeepSize": Style.EXTENT, "KeepOnGround": True, "GenerateRotation": True}
    for title, options, owner, kind in (
            ("slices", {}, slices, {}), ("boxes and ghost cells", ground, in_boxes(whole), {"ghost_levels": 1}),
            ("nothing on the first process", flat, not_first, {})):
        alone = AloneRun(Style, whole, prepare=drag, **options)
        piece = Piece(whole, owner, **kind)
        run = Run(Style, piece.data, **options)
        assert size_of_all(run) >= whole.GetNumberOfPoints()
        coarse = preview(run)
        total = size_of_all(run)
        assert wanted / 2 < total < wanted * 2, (title, total)
        assert (coarse.GetNumberOfPoints() > 0) == (piece.points.size > 0), title
        ids = numbers_of(coarse)
        full = coordinates(alone.output)[ids]
        farthest = greatest(difference(coordinates(coarse), full)) / diagonal
        assert farthest < most, (title, farthest)
        for name in names(alone.output.GetPointData()) if ids.size else ():
            assert coarse.GetPointData().HasArray(name), (title, name)
        assert difference(vtk_to_numpy(coarse.GetPointData().GetArray("height")) if ids.size else full[:, 0],
                          vtk_to_numpy(whole.GetPointData().GetArray("height"))[ids]) == 0.0, title
        # What several processes have is at one place, and little gapes.
        rows = gathered(np.column_stack([ids, coordinates(coarse)]))
        rows = rows[np.argsort(rows[:, 0], kind="stable")]
        again = np.flatnonzero(rows[1:, 0] == rows[:-1, 0])
        assert difference(rows[again, 1:], rows[again + 1, 1:]) <= 1e-12 * diagonal, title
        opened = count_open_edges(coarse)
        if RANK == 0:
            history = run.filter.GetOutputDataObject(1)
            assert history.GetFieldData().GetArray("BytesExchanged").GetNumberOfTuples() == RANKS, title
        # Where three processes meet, not all of them may have the point that the others keep.
        assert (again.size > 50) == (np.unique(owner).size > 1), (title, again.size)
        assert opened <= (0 if RANKS == 2 else 0.05 * again.size), (title, opened, again.size)
        facts = gathered([[*run.filter.GetEffectiveCenter(), run.filter.GetEffectiveRadius()]])
        assert difference(facts, facts[:1]) == 0.0 and np.allclose(facts[0, :3], (0.03, 0.51, 0.02)), (title, facts)
        print_first(f"preview, {title}: {total} points, {farthest:.2g} of the diagonal from the full result, {opened} open"
                    f" edges, {again.size} points of two processes")
        # At rest to the bit, and after it the bits of no preview.
        run.filter.SetRoundness(0.0)
        run.filter.Update()
        assert difference(coordinates(run.output), coordinates(whole)[numbers_of(run.output)]) == 0.0, title
        drag(run.filter)
        run.filter.PreviewOff()
        run.filter.Update()
        without = Run(Style, piece.data, prepare=drag, **options)
        assert size_of_all(run) == size_of_all(without)
        assert coordinates(run.output).tobytes() == coordinates(without.output).tobytes(), title
    check_full_previews(whole)


def print_first(text):
    if RANK == 0:
        print(text, flush=True)


def check_full_previews(whole):
    """What makes a process ask for the full result makes all of them do so, and none waits."""
    piece = Piece(whole, in_slices(whole)).data
    nothing, last = vtkPolyData(), RANKS - 1
    run = Run(Style, piece)
    full = size_of_all(run)

    def update(is_full, title):
        drag(run.filter, update.count)
        update.count += 1
        run.filter.Update()
        assert not run.errors, (title, run.errors)
        assert (size_of_all(run) >= full) == is_full, (title, size_of_all(run))

    update.count = 0
    run.filter.SetPreview(RANK == 0)
    update(True, "on the first process only")
    run.filter.PreviewOn()
    update(False, "on all")
    if RANK == last:
        run.filter.ReleaseCache()
    update(True, "cache released on one")
    update(False, "cache there again")
    if RANK == last:
        piece.GetPoints().GetData().Modified()
    piece.Modified()
    update(True, "part of one changed")
    update(False, "all of them known")
    run.filter.SetRoundness(0.1 + 0.01 * RANK)
    run.filter.Update()
    assert not run.errors and size_of_all(run) >= full, "properties that differ"
    update(True, "known to be gathered")
    for title, data in (("all on the first process", whole if RANK == 0 else nothing),
                        ("parts again", piece), ("the part of the first process alone", piece if RANK == 0 else nothing)):
        full = int(gathered([[data.GetNumberOfPoints()]]).sum())
        run.filter.SetInputDataObject(0, data)
        update(True, title)
        update(full <= 50000, title)
    run.filter.SetInputDataObject(0, piece)
    full = int(gathered([[piece.GetNumberOfPoints()]]).sum())
    update(True, "parts")
    update(False, "parts")
    run.filter.SetRoundness(-1.0)
    run.filter.Update()
    assert len(run.errors) == (RANK == 0) and run.output.GetNumberOfPoints() == 0, run.errors
    run.errors.clear()
    update(True, "after a fault")
    update(False, "and known again")


def check_gathered():
    """What needs all of a surface still has it."""
    owner = in_slices(small)
    for options in (ITERATES, {"RefineLongEdges": Style.ALWAYS}, {"ReproduceThesis": True}):
        run = Run(Style, Piece(small, owner).data, **options)
        assert not run.errors and bytes_exchanged(run) is None, options
        assert not any("gathered" in text for text in run.told), run.told

    # A large one is told: a million loose points are as large as others, and nothing has to be solved for them.
    large = vtkPolyData()
    large.SetPoints(vtkPoints())
    many = 1 + 10**6 // RANKS
    places = np.random.default_rng(RANK).random((many, 3))
    large.GetPoints().SetData(numpy_to_vtk(places, deep=True))
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(np.arange(3, dtype=np.int64), deep=True))
    large.SetPolys(cells)
    run = Run(Style, large, ReproduceThesis=True)
    words = f"gathered on the first process, since this needs all of it: {RANKS * many} points and {RANKS} cells, "
    assert not run.errors and [words in text for text in run.told if "gathered" in text] == [True] * (RANK == 0), run.told


def check_owners():
    """Where a surface is gathered, what counts of a point is what its owner has, and a cell without an owner has none."""
    def factors(filter_):
        filter_.SetInputArrayToProcess(1, 0, 0, 0, "factor")
    whole = vtkPolyData()
    whole.ShallowCopy(small)
    add(whole.GetPointData(), "factor", 0.5 + coordinates(small)[:, 1] ** 2)
    add(whole.GetCellData(), "Normals", np.tile([0.0, 0.0, 1.0], (small.GetNumberOfCells(), 1)))
    whole.GetCellData().SetActiveNormals("Normals")
    owner = in_slices(whole)
    alone = AloneRun(Style, whole, prepare=factors, **ITERATES)
    for last_owns in (False, True):
        piece = Piece(whole, owner, ghost_levels=1, last_owns=last_owns)
        ghosts = vtk_to_numpy(piece.data.GetPointData().GetArray(GHOSTS)) > 0
        assert ghosts.any()
        vtk_to_numpy(piece.data.GetPointData().GetArray("factor"))[ghosts] = 1e3
        run = Run(Style, piece.data, prepare=factors, **ITERATES)
        assert not run.errors and not alone.errors, run.errors
        found = greatest(difference(coordinates(run.output), coordinates(alone.output)[piece.points]))
        assert found <= TOLERANCE * np.ptp(coordinates(whole)), (last_owns, found)

    corners = triangles(whole)
    beside = (owner == 1) & np.isin(corners, corners[owner == 0]).any(axis=1)
    lost = np.flatnonzero(beside)[0]
    piece = Piece(whole, owner, ghost_levels=1)
    at = np.flatnonzero(piece.cells == lost)
    vtk_to_numpy(piece.data.GetCellData().GetArray(GHOSTS))[at] = 1
    run = Run(Style, piece.data, **ITERATES)
    lengths = np.linalg.norm(vtk_to_numpy(run.output.GetCellData().GetNormals()), axis=1)
    assert not run.errors and (lengths[at] == 0.0).all() and np.allclose(np.delete(lengths, at), 1.0), lengths[at]
    assert greatest(at.size) == 1.0 and (RANK > 1 or at.size == 1), "the first two processes should have the cell"


def check_still():
    """Factors of 0 leave the model as it is, to the bit, also where a process has none of it."""
    owner = np.maximum(in_slices(small), 1)
    still = vtkPolyData()
    still.ShallowCopy(small)
    add(still.GetPointData(), "factor", np.zeros(small.GetNumberOfPoints()))
    piece = Piece(still, owner)
    run = Run(Style, piece.data, prepare=lambda f: f.SetInputArrayToProcess(1, 0, 0, 0, "factor"))
    assert not run.errors and (piece.points.size == 0) == (RANK == 0), run.errors
    assert difference(coordinates(run.output), coordinates(piece.data)) == 0.0


def check_zeros():
    """A point at 0 is one point, also where a process has it at -0, and without welding."""
    owner = in_slices(small)
    corners = triangles(small)
    shared = np.intersect1d(corners[owner == 0], corners[owner != 0])
    moved = vtkPolyData()
    moved.DeepCopy(small)
    vtk_to_numpy(moved.GetPoints().GetData())[:] -= vtk_to_numpy(moved.GetPoints().GetData())[shared[0]].copy()
    options = {"WeldCoincidentPoints": False, **ITERATES}
    alone = AloneRun(sphericalstyle.vtkThesisStyleFilter, moved, **options)
    piece = Piece(moved, owner)
    places = vtk_to_numpy(piece.data.GetPoints().GetData())
    places[places == 0.0] = -0.0 if RANK % 2 else 0.0
    run = Run(sphericalstyle.vtkThesisStyleFilter, piece.data, **options)
    assert not run.errors and not alone.errors, run.errors
    found = greatest(difference(coordinates(run.output), coordinates(alone.output)[piece.points]))
    assert found <= TOLERANCE * np.ptp(coordinates(moved)), found


def check_seams():
    """Where a model is cut open, coincident points stay what they are: kept apart, or welded."""
    points, corners = coordinates(creature), triangles(creature).copy()
    upper = points[corners].mean(axis=1)[:, 1] > points[:, 1].mean()
    shared = np.intersect1d(corners[upper], corners[~upper])
    new = np.arange(len(points))
    new[shared] = len(points) + np.arange(shared.size)
    corners[upper] = new[corners[upper]]
    both = vtkPoints()
    both.SetData(numpy_to_vtk(np.vstack([points, points[shared]]), deep=True))
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(corners.astype(np.int64).ravel(), deep=True))
    seamed = vtkPolyData()
    seamed.SetPoints(both)
    seamed.SetPolys(cells)
    for weld in (True, False):  # which copy of a point is which only ids can tell
        _, alone = check_spread(f"a seam, welded: {weld}", sphericalstyle.vtkThesisStyleFilter, seamed, in_slices(seamed), exact=not weld,
                                global_ids=not weld, WeldCoincidentPoints=weld, SphericalWeighting=Style.UNIFORM,
                                DetailSize=0.0)  # details would ride on one base
        moved = coordinates(alone.output)
        opened = difference(moved[shared], moved[len(points):])
        assert (opened == 0.0) == weld, opened


def check_region():
    """A mask, and selections of ids of the piece, of cells, and of one process alone."""
    def mask(filter_):
        filter_.SetInputArrayToProcess(4, 0, 0, 0, "upper")
    upper = coordinates(creature)[:, 1] > coordinates(creature)[:, 1].mean()
    marked = vtkPolyData()
    marked.ShallowCopy(creature)
    add(marked.GetPointData(), "upper", upper.astype(np.uint8))
    owner = in_slices(marked)
    run, alone = check_spread("a mask", Style, marked, owner, ghost_levels=1, prepare=mask)

    def selection(field, ids, process=None):
        node = vtkSelectionNode()
        node.SetFieldType(field)
        node.SetContentType(vtkSelectionNode.INDICES)
        node.SetSelectionList(numpy_to_vtkIdTypeArray(np.ascontiguousarray(ids, dtype=np.int64), deep=True))
        if process is not None:
            node.GetProperties().Set(vtkSelectionNode.PROCESS_ID(), process)
        return node

    cells = upper[triangles(marked)].all(axis=1)
    of_first = Piece(marked, np.where(owner == 0, RANK, -1))  # what the first process has
    for title, field, which, of in (("points", vtkSelectionNode.POINT, upper, "points"),
                                    ("cells", vtkSelectionNode.CELL, cells, "cells")):
        mine = np.flatnonzero(which[getattr(Piece(marked, owner), of)])
        whole = vtkSelection()
        whole.AddNode(selection(field, np.flatnonzero(which)))
        own = vtkSelection()
        own.AddNode(selection(field, mine))
        alone = Run(Style, marked, alone=True, prepare=lambda f: f.SetSelectionData(whole))
        piece = Piece(marked, owner)
        run = Run(Style, piece.data, prepare=lambda f: f.SetSelectionData(own))
        largest = greatest(compare(piece, run.output, alone.output))
        assert not run.errors and largest <= TOLERANCE, (title, largest)
        assert greatest(difference(coordinates(alone.output), coordinates(marked))) > 1e-3

        # As ParaView has them: nodes of all processes, in each process.
        first = np.flatnonzero(which[getattr(of_first, of)])
        every = vtkSelection()
        every.AddNode(selection(field, first, process=0))
        only_first = vtkSelection()
        only_first.AddNode(selection(field, getattr(of_first, of)[first]))
        alone = Run(Style, marked, alone=True, prepare=lambda f: f.SetSelectionData(only_first))
        run = Run(Style, piece.data, prepare=lambda f: f.SetSelectionData(every))
        largest = greatest(compare(piece, run.output, alone.output))
        assert not run.errors and largest <= TOLERANCE, (title, "of one process", largest)


def check_further_ports():
    """Centers on other processes, in the order of the processes; a style mesh in slices."""
    parts = vtkPolyData()
    parts.ShallowCopy(creature)
    places = coordinates(creature)
    add(parts.GetPointData(), "part", (places[:, 1] > places[:, 1].mean()).astype(np.int32))
    given = np.array([[0.0, 0.4, 0.0], [0.0, 0.8, 0.0]])

    def with_centers(mine):
        centers = vtkPolyData()
        centers.SetPoints(vtkPoints())
        for k in mine:
            centers.GetPoints().InsertNextPoint(given[k])

        def prepare(filter_):
            filter_.SetInputArrayToProcess(5, 0, 0, 0, "part")
            filter_.SetCentersData(centers)
        return prepare

    piece = Piece(parts, in_slices(parts))
    alone = Run(Style, parts, alone=True, prepare=with_centers([0, 1]))
    mine = [0] if RANK == 0 else [1] if RANK == RANKS - 1 else []
    run = Run(Style, piece.data, prepare=with_centers(mine))
    assert not run.errors + alone.errors, run.errors
    assert greatest(compare(piece, run.output, alone.output)) <= TOLERANCE

    analogy = sphericalstyle.vtkNormalAnalogyFilter
    # With ids, since between two normals that are equally near rounding decides.
    piece = Piece(creature, in_slices(creature), global_ids=True)
    shape = Piece(small, in_slices(small), global_ids=True).data
    alone = Run(analogy, creature, alone=True, Style=analogy.MESH, prepare=lambda f: f.SetInputData(1, small))
    run = Run(analogy, piece.data, Style=analogy.MESH, prepare=lambda f: f.SetInputData(1, shape))
    assert not run.errors + alone.errors, run.errors
    assert greatest(difference(coordinates(run.output), coordinates(alone.output)[piece.points])) == 0.0


def check_other_cells():
    """A surface with new cells is on the first process, whole."""
    piece = Piece(small, in_slices(small)).data
    run, alone = (Run(Style, data, alone=data is small, RefineLongEdges=Style.ALWAYS) for data in (piece, small))
    for count in ("GetNumberOfPoints", "GetNumberOfCells"):
        expected = getattr(alone.output, count)() if RANK == 0 else 0
        assert not run.errors and getattr(run.output, count)() == expected, (count, expected)
    assert alone.output.GetNumberOfPoints() > small.GetNumberOfPoints()


def columns(data):
    """Of a table, or of field data; text and names of arrays are kept as they are."""
    fields = data.GetRowData() if data.IsA("vtkTable") else data.GetFieldData()
    arrays = [fields.GetAbstractArray(k) for k in range(fields.GetNumberOfArrays())]
    return {a.GetName(): vtk_to_numpy(a) if a.IsA("vtkDataArray") else
            [a.GetValue(i) for i in range(a.GetNumberOfValues())] for a in arrays}


def check_same_columns(title, mine, whole, exact=False, closeness=1e-7):
    """On the first process those of the whole, elsewhere none. Numbers of cells come in another order unless exact."""
    mine, whole = columns(mine), columns(whole)
    if RANK > 0:
        assert not any(len(values) for values in mine.values()), (title, mine)
        return
    assert list(mine) == list(whole) and whole, (title, list(mine), list(whole))
    for name in set(whole) - (set() if exact else {"FirstId"}):
        bounds = dict(rtol=0.0, atol=0.0) if exact else dict(rtol=closeness, atol=1e-2 * closeness)
        same = (mine[name] == whole[name] if isinstance(whole[name], list) else
                np.allclose(mine[name], whole[name], equal_nan=True, **bounds))
        assert same, (title, name, mine[name], whole[name])


def kinds_of_parts(whole):
    """The process of each cell, and what the parts have besides."""
    cells = whole.GetNumberOfCells()
    slices = in_slices(whole)
    return {
        "slices": (slices, {}),
        "scattered": (scattered(whole), {}),
        "scattered with ids": (scattered(whole), {"global_ids": True}),
        "boxes of a kd-tree": (in_boxes(whole), {}),
        "boxes and ghost cells": (in_boxes(whole), {"ghost_levels": 1}),
        "two layers of ghost cells, scattered": (scattered(whole), {"ghost_levels": 2}),
        "all on the last process": (np.full(cells, RANKS - 1), {}),
        "some processes empty": (in_slices(whole, 2) * (RANKS - 1), {}),
        "nothing on the first process": (np.where(slices == 0, RANKS - 1, slices), {}),
    }


def is_gathered(run, port):
    """Known to the first process."""
    return RANK == 0 and not run.filter.GetOutputDataObject(port).GetFieldData().GetArray("BytesExchanged")


def deformed(whole, **options):
    return in_double(Run(Style, whole, alone=True, **options).output)


def without_some_cells(whole):
    """Open, with points of no triangle, and with a triangle twice."""
    cells = vtkCellArray()
    corners = triangles(whole)[np.arange(whole.GetNumberOfCells()) % 7 > 0]
    corners = np.ascontiguousarray(np.vstack([corners, corners[:1]]), dtype=np.int64)
    cells.SetData(3, numpy_to_vtkIdTypeArray(corners.ravel(), deep=True))
    result = vtkPolyData()
    result.SetPoints(whole.GetPoints())
    result.SetPolys(cells)
    return result


def check_measures():
    """What measures a surface sees all of it: no border where a part ends."""
    metrics = sphericalstyle.vtkSurfaceMetrics
    models = {
        "creature": (creature, deformed(creature, Roundness=2.0)),
        "folded": (creature, deformed(creature, NormalBlend=1.0, DetailSize=0.0, Roundness=0.5,
                                      NormalRadius=Style.WHOLE_MODEL_RADIUS)),
        "stone": (small, deformed(small, Roundness=1.0)),
        "open": (without_some_cells(small), without_some_cells(deformed(small, Roundness=1.0))),
    }
    crossing = 0
    for name, (before, after) in models.items():
        alone = Run(metrics, after, alone=True, prepare=lambda f, r=before: f.SetInputData(1, r))
        crossing += alone.output.GetFieldData().GetArray("NewSelfIntersectionPairs").GetValue(0)
        for title, (owner, kind) in kinds_of_parts(after).items():
            given, piece = (Piece(whole, owner, **kind) for whole in (before, after))
            run = Run(metrics, piece.data, prepare=lambda f, r=given.data: f.SetInputData(1, r))
            assert not run.errors + alone.errors, (name, title, run.errors, alone.errors)
            assert not is_gathered(run, 1), (name, title)
            assert greatest(compare(piece, run.output, alone.output, tolerance=1e-10)) == 0.0, (name, title)
            for mine, whole in ((run.filter.GetOutputDataObject(1), alone.filter.GetOutputDataObject(1)),
                                (run.output, alone.output)):
                check_same_columns((name, title), mine, whole, closeness=1e-10)
    assert crossing > 0
    # What still needs all of the surface, and its first point.
    for options in ({"EstimateCondition": True}, {"WeldCoincidentPoints": False}):
        run, alone = (Run(metrics, data, alone=data is small, FindSelfIntersections=False, **options)
                      for data in (Piece(small, in_slices(small), global_ids=True).data, small))
        assert not run.errors + alone.errors and greatest(is_gathered(run, 1)) == 1.0, options
        check_same_columns(options, run.filter.GetOutputDataObject(1), alone.filter.GetOutputDataObject(1), exact=True)


def check_measured_faults():
    """All processes fail, and the one that knows why says it."""
    last = RANKS - 1
    piece = Piece(small, in_slices(small))
    broken = vtkPolyData()
    broken.DeepCopy(piece.data)
    if RANK == last:
        broken.GetPoints().SetPoint(3, math.nan, 0.0, 0.0)
    for Filter in (sphericalstyle.vtkSurfaceMetrics, sphericalstyle.vtkGaussMapFilter):
        run = Run(Filter, broken)
        assert len(run.errors) == (RANK == last), (Filter, run.errors)
        assert all("point 3 is not finite" in error for error in run.errors), run.errors
        assert run.output.GetNumberOfPoints() == 0
    run = Run(sphericalstyle.vtkSurfaceMetrics, piece.data, prepare=lambda f: f.SetInputData(1, broken))
    assert len(run.errors) == (RANK == last) and run.output.GetNumberOfPoints() == 0, run.errors
    run = Run(sphericalstyle.vtkGaussMapFilter, piece.data, OftenThreshold=-1.0)
    assert len(run.errors) == (RANK == 0) and run.output.GetNumberOfPoints() == 0, run.errors
    run = Run(sphericalstyle.vtkGaussMapFilter, piece.data, NumberOfEqualAreaUnits=500 if RANK == last else 1000)
    assert len(run.errors) == (RANK == 0) and run.output.GetNumberOfPoints() == 0, run.errors


def check_gauss_map():
    """Counts of all processes, each face and each point once."""
    gauss = sphericalstyle.vtkGaussMapFilter
    creased = vtkPolyDataNormals()
    creased.SetInputData(model("cube.vtp"))
    creased.SetFeatureAngle(30.0)
    creased.Update()
    plain = vtkPolyData()
    plain.ShallowCopy(creature)
    plain.GetPointData().SetNormals(None)
    for name in names(plain.GetPointData()):
        plain.GetPointData().RemoveArray(name)
    every, points = list(kinds_of_parts(small)), {"NormalSource": gauss.POINT_NORMALS}
    for whole, options, kinds in (
            (creature, {}, every),
            (small, points, ["scattered", "nothing on the first process"]),
            (without_some_cells(small), {"AreaWeighted": True}, ["slices", "scattered"]),
            # Normals that differ at one place are several; copies of one are not.
            (creased.GetOutput(), {"AreaWeighted": True, **points},
             ["slices", "scattered", "scattered with ids", "two layers of ghost cells, scattered"]),
            # Computed ones.
            (plain, {"AreaWeighted": True, "SphereUnits": gauss.EQUAL_AREA, **points},
             ["slices", "scattered", "two layers of ghost cells, scattered"])):
        alone = Run(gauss, whole, alone=True, **options)
        for title, (owner, kind) in kinds_of_parts(whole).items():
            if title not in kinds:
                continue
            run = Run(gauss, Piece(whole, owner, **kind).data, **options)
            assert not run.errors + alone.errors, (title, options, run.errors)
            assert not is_gathered(run, 2), (title, options)
            assert run.filter.GetNumberOfNormals() == alone.filter.GetNumberOfNormals(), (title, options)
            check_same_columns((title, options), run.filter.GetOutputDataObject(2),
                               alone.filter.GetOutputDataObject(2), closeness=1e-10)
            if RANK == 0:
                for port, kind_of in ((0, "GetCellData"), (1, "GetPointData")):
                    mine, its = (vtk_to_numpy(getattr(f.filter.GetOutputDataObject(port), kind_of)()
                                              .GetArray("Count")) for f in (run, alone))
                    assert difference(mine, its) <= 1e-10 * its.sum(), (title, options)


def check_every_output():
    """Who asks for one output after the other makes no process execute again, which would wait for the others."""
    gauss, metrics = sphericalstyle.vtkGaussMapFilter, sphericalstyle.vtkSurfaceMetrics
    nothing = vtkPolyData()
    broken = vtkPolyData()
    broken.DeepCopy(small)
    broken.GetPoints().SetPoint(3, math.nan, 0.0, 0.0)
    blocks = vtkMultiBlockDataSet()
    for k in range(2 * RANKS):
        blocks.SetBlock(k, None if k // 2 != RANK else broken if k == 0 else small)
    for title, data in (("parts", Piece(small, in_slices(small)).data), ("no surface", nothing),
                        ("all on the first process", small if RANK == 0 else nothing),
                        ("all on the last process", small if RANK == RANKS - 1 else nothing),
                        ("fault of the first process", broken if RANK == 0 else nothing),
                        ("fault of the last process", broken if RANK == RANKS - 1 else small),
                        ("blocks, one with a fault", blocks)):
        for Filter in (gauss, metrics, Style):
            filter_ = Run(Filter, data).filter
            executions = []
            filter_.AddObserver("StartEvent", lambda *_, e=executions: e.append(1))
            for pieces in (1, RANKS):
                filter_.UpdatePiece(RANK % pieces, pieces, 0)
                controller.Barrier()
                executed = len(executions)
                for port in range(filter_.GetNumberOfOutputPorts()):
                    information = filter_.GetOutputInformation(port)
                    information.Set(vtkStreamingDemandDrivenPipeline.UPDATE_PIECE_NUMBER(), RANK % pieces)
                    information.Set(vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_PIECES(), pieces)
                    filter_.Update(port)
                again = len(executions) - executed
                assert again == 0 or data is blocks, (title, Filter.__name__, pieces)
                assert greatest(again) == -greatest(-again), (title, Filter.__name__, pieces)  # blocks: by all or none
    # What follows the image has nothing to do where there is none.
    for data in (Piece(small, in_slices(small)).data, small if RANK == 0 else nothing):
        scale = vtkImageShiftScale()
        scale.SetInputConnection(Run(gauss, data).filter.GetOutputPort(1))
        scale.SetScale(2.0)
        scale.UpdatePiece(RANK, RANKS, 0)
        image = scale.GetOutput()
        assert image.GetNumberOfPoints() == (360 * 180 if RANK == 0 else 0), image.GetExtent()
        if RANK == 0:
            counts = vtk_to_numpy(image.GetPointData().GetScalars())
            assert counts.sum() == 2.0 * small.GetNumberOfCells()


def check_diagnosis():
    """Gathered, and so has the bits of one process where global ids say the order."""
    diagnostics = sphericalstyle.vtkSurfaceDiagnostics
    for title, owner, options in (("slices", in_slices(creature), {}),
                                  ("scattered", scattered(creature), {"global_ids": True}),
                                  ("ghost cells", in_slices(creature), {"ghost_levels": 1})):
        piece = Piece(creature, owner, **options)
        run, alone = Run(diagnostics, piece.data), Run(diagnostics, creature, alone=True)
        assert not run.errors + alone.errors, (run.errors, alone.errors)
        assert greatest(compare(piece, run.output, alone.output)) == 0.0
        check_same_columns(title, run.filter.GetOutputDataObject(1), alone.filter.GetOutputDataObject(1),
                           "global_ids" in options)


def check_volume():
    """A volume in parts is refused with the way out, which works: bring it to one process."""
    def moved_surface(volume):
        extract = vtkDataSetSurfaceFilter()
        extract.SetInputDataObject(volume)
        extract.Update()
        add(extract.GetOutput().GetPointData(), "Displacement", np.zeros((extract.GetOutput().GetNumberOfPoints(), 3)))
        return extract.GetOutput()

    def grid(first, count):
        image = vtkImageData()
        image.SetExtent(first, first + count, 0, 3, 0, 3)
        append = vtkAppendFilter()
        append.SetInputData(image)
        append.Update()
        return append.GetOutput()

    def morphed(volume, surface):
        return Run(sphericalstyle.vtkMeshMorphingFilter, volume, prepare=lambda f: f.SetSurfaceData(surface))

    part, surface = grid(2 * RANK, 2), moved_surface(grid(0, 2 * RANKS))
    run = morphed(part, surface)
    assert len(run.errors) == 1 and run.output.GetNumberOfPoints() == 0, run.errors
    for words in ("on the boundary of the volume is no point of the surface", "spread over processes", "Aggregate Dataset"):
        assert words in run.errors[0], run.errors
    aggregate = vtkAggregateDataSetFilter()
    aggregate.SetInputData(part)
    aggregate.SetNumberOfTargetProcesses(1)
    aggregate.Update()
    whole = aggregate.GetOutputDataObject(0)
    assert whole.GetNumberOfCells() == (18 * RANKS if RANK == 0 else 0), whole.GetNumberOfCells()
    run = morphed(whole, surface)
    assert not run.errors and run.output.GetNumberOfPoints() == (16 * (2 * RANKS + 1) if RANK == 0 else 0), run.errors


class Growing(VTKPythonAlgorithmBase):
    """A surface over time: three steps, each higher than the last."""

    def __init__(self, surface):
        super().__init__(nInputPorts=0, outputType="vtkPolyData")
        self.surface = surface

    def RequestInformation(self, _request, _inputs, outputs):
        information = outputs.GetInformationObject(0)
        for key, times in ((vtkStreamingDemandDrivenPipeline.TIME_STEPS(), (0.0, 1.0, 2.0)),
                           (vtkStreamingDemandDrivenPipeline.TIME_RANGE(), (0.0, 2.0))):
            information.Set(key, times, len(times))
        return 1

    def RequestData(self, _request, _inputs, outputs):
        time = outputs.GetInformationObject(0).Get(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())
        output = vtkPolyData.GetData(outputs, 0)
        output.ShallowCopy(self.surface)
        if self.surface.GetNumberOfPoints():
            points = vtkPoints()
            points.SetData(numpy_to_vtk(coordinates(self.surface) * [1.0, 1.0 + time, 1.0], deep=True))
            output.SetPoints(points)
        return 1


def check_time_series():
    """Each step as in one process, also a step that comes again."""
    piece = Piece(creature, scattered(creature), global_ids=True)
    spread, alone = Style(), Style()
    alone.SetController(None)
    heights = []
    sources = [Growing(surface) for surface in (piece.data, creature)]
    for filter_, source in zip((spread, alone), sources):
        filter_.SetRoundness(1.0)
        filter_.SetInputConnection(source.GetOutputPort())
    for time in (0.0, 2.0, 1.0, 0.0):
        for filter_ in (spread, alone):
            filter_.UpdateTimeStep(time)
        assert greatest(compare(piece, spread.GetOutput(), alone.GetOutput())) <= TOLERANCE, time
        heights.append(np.ptp(coordinates(alone.GetOutput())[:, 1]))
    assert heights[0] == heights[3] < heights[2] < heights[1], heights


# ------------------------------------------------------------------------------------------- blocks
def check_blocks():
    """Each block where it is: no block is gathered, any number of them, and no process waits."""
    names_of = ["creature.vtp", "go-stone.vtp", "snowman.vtp", "bottle.vtp", "cube.vtp", "icosahedron.vtp"]
    surfaces = [model(name) for name in names_of]
    alone = [Run(Style, surface, alone=True).output for surface in surfaces]
    largest = 0.0
    for title, process_of in (
            ("spread", [k % RANKS for k in range(6)]),
            ("unevenly", [0, 0, 0, RANKS - 1, 0, 0]),
            ("fewer than processes", [1 % RANKS, RANKS - 1, None, None, None, None]),
            ("all on one", [RANKS - 1] * 6)):
        blocks = vtkMultiBlockDataSet()
        collection = vtkPartitionedDataSetCollection()
        for k, process in enumerate(process_of):
            blocks.SetBlock(k, surfaces[k] if process == RANK else None)
            if process == RANK:
                collection.SetPartition(k, 0, surfaces[k])
            else:
                collection.SetNumberOfPartitions(k, 0)
        for data in (blocks, collection):
            run = Run(Style, data)
            assert not run.errors
            for k, process in enumerate(process_of):
                block = (run.output.GetBlock(k) if data is blocks else
                         run.output.GetPartition(k, 0) if run.output.GetNumberOfPartitions(k) else None)
                assert (block is not None) == (process == RANK), (title, k)
                if block:
                    largest = max(largest, difference(coordinates(block), coordinates(alone[k])))
    largest = greatest(largest)
    if RANK == 0:
        print(f"blocks: largest difference of points {largest:.2g}", flush=True)
    assert largest == 0.0

    # A bad block is an error of the process that has it; the other blocks come out, there and elsewhere.
    bad = vtkPolyData()
    bad.DeepCopy(surfaces[1])
    bad.GetPoints().SetPoint(0, math.inf, 0.0, 0.0)
    blocks = vtkMultiBlockDataSet()
    for k in range(2 * RANKS):
        blocks.SetBlock(k, None if k // 2 != RANK else bad if k == 0 else surfaces[1])
    run = Run(Style, blocks)
    assert len(run.errors) == (RANK == 0), run.errors
    assert coordinates(run.output.GetBlock(2 * RANK + 1)).tobytes() == coordinates(alone[1]).tobytes()
    # Not of the same kind everywhere: nothing is gathered, and nobody waits.
    run = Run(Style, run.output if RANK == 0 else surfaces[1])
    assert not run.errors and (RANK == 0 or coordinates(run.output).tobytes() == coordinates(alone[1]).tobytes())
    # Blocks at another port than the first make a filter run over them, too.
    analogy = sphericalstyle.vtkNormalAnalogyFilter
    shapes = vtkMultiBlockDataSet()
    for k in range(RANK):
        shapes.SetBlock(k, surfaces[1])
    run = Run(analogy, Piece(small, in_slices(small)).data, Style=analogy.MESH,
              prepare=lambda f: f.SetInputDataObject(1, shapes))
    assert not run.errors and run.output.GetClassName() == "vtkMultiBlockDataSet"


# ------------------------------------------------------------------------------------------- faults
def check_fault(title, data, words, told_by, **options):
    """All processes fail, those that know why say it, and the next run is good."""
    run = Run(Style, data, **options)
    assert run.output.GetNumberOfPoints() == 0, title
    assert (len(run.errors) == 1) == (RANK in told_by), (title, RANK, run.errors)
    assert all(words in error for error in run.errors), (title, run.errors)
    good = Piece(small, in_slices(small))
    run.filter.SetRoundness(0.5)
    run.filter.SetInputArrayToProcess(1, 0, 0, 0, "")
    run.filter.SetInputDataObject(0, good.data)
    run.filter.Update()
    assert run.filter.GetOutput().GetNumberOfPoints() == good.points.size, title


def check_faults():
    last = RANKS - 1
    piece = Piece(small, in_slices(small)).data
    broken = vtkPolyData()
    broken.DeepCopy(piece)
    if RANK == last:
        broken.GetPoints().SetPoint(3, math.nan, 0.0, 0.0)
    check_fault("not finite", broken, f"process {last}: Points: point 3 is not finite", [last])
    short = vtkPolyData()
    short.ShallowCopy(piece)
    if RANK == last:
        add(short.GetPointData(), "short", np.zeros(2))
    check_fault("short array", short, f'process {last}: Input: array "short" has 2 tuples', [last])
    wild = vtkPolyData()
    wild.DeepCopy(piece)
    if RANK == last:
        wild.GetPolys().GetConnectivityArray().SetComponent(5, 0, 10**6)
    check_fault("point id out of range", wild, f"process {last}: ", [last])
    check_fault("no surface", vtkUnstructuredGrid() if RANK == last else piece, "Extract Surface", [last])
    own_ids = vtkPolyData()
    own_ids.ShallowCopy(piece)
    ids = numpy_to_vtkIdTypeArray(np.arange(piece.GetNumberOfPoints(), dtype=np.int64), deep=True)
    ids.SetName("GlobalIds")
    own_ids.GetPointData().SetGlobalIds(ids)
    check_fault("ids of each process' own", own_ids, "global id 0 is at different places on processes 0 and 1", [0])
    check_fault("bad property", piece, "Roundness must be", [0], Roundness=-1.0)
    bad = vtkPolyData()
    bad.ShallowCopy(piece)
    factors = np.ones(piece.GetNumberOfPoints())
    factors[5] = -1.0 if RANK == last else 1.0
    add(bad.GetPointData(), "factor", factors)
    check_fault("bad value", bad, f'process {last}: Roundness factor: array "factor" is -1 at point 5', [last],
                prepare=lambda f: f.SetInputArrayToProcess(1, 0, 0, 0, "factor"))
    check_fault("no such array", piece, "nowhere", [0],
                prepare=lambda f: f.SetInputArrayToProcess(1, 0, 0, 0, "nowhere"))
    empty = Run(Style, vtkPolyData())
    assert not empty.errors and empty.output.GetNumberOfPoints() == 0
    # Each process its own model, in its own time.
    for _ in range(RANK):
        own = Run(Style, small, alone=True)
        assert not own.errors and own.output.GetNumberOfPoints() == small.GetNumberOfPoints()


try:
    checks = (check_one_surface, check_parts, check_bytes, check_preview, check_gathered, check_owners, check_still,
              check_zeros, check_seams, check_region, check_further_ports, check_other_cells, check_measures,
              check_measured_faults, check_gauss_map, check_every_output, check_diagnosis, check_volume,
              check_time_series, check_blocks, check_faults)
    left_out = sys.argv[2:3] == ["--without"]
    for check in [check for check in checks if not sys.argv[2:] or (check.__name__ in sys.argv[2:]) != left_out]:
        begin = time.monotonic()
        check()
        controller.Barrier()
        if RANK == 0:
            print(f"{check.__name__}: passed on {RANKS} processes in {time.monotonic() - begin:.1f} s", flush=True)
except BaseException:
    traceback.print_exc()
    sys.stderr.flush()
    os._exit(1)  # without a farewell, so that mpirun ends the others that may wait
