# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What rounding a surface that is spread over the processes of MPI costs, beside rounding it in one.

    mpirun -np 4 pvbatch --sym measure_processes.py [--halvings 0 1 2 3 4] [--detail-size 0.06] [--repeat 5]
                                                    [--parts slices boxes scattered one] [--limit] [--measures]

The creature of Data/ with its edges halved, in parts over the processes: slices along x, boxes of a kd-tree, triangles
at random, or all on the last process. Each process also has the whole. Times are those that
a processor works, in milliseconds, with one thread, the least of several: rounded alone by the first process; spread,
the sum of all processes; the same again with another Roundness. Waiting for others counts as work. Memory is the peak
of an execution above what the process had before it, in MB: alone; spread, that of the process with most, and the mean.
Then the most kB that a process has sent and received, and the largest difference of a point from the result of one
process, as a fraction of the diagonal.

--limit shows what a surface needs that is too large for one process: it gathers the surface, then limits the address
space of each process to what it has and a third of what that took, and rounds the surface in parts and gathered again.
No process has the whole then.

--measures takes vtkSurfaceMetrics and vtkGaussMapFilter instead, the first with the model before as the reference, and
says for each the times alone and spread, the memory and the most kB sent and received.
"""
import argparse
import ctypes
import pathlib
import resource
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

from sphericalstyle import vtkGaussMapFilter, vtkSphericalStyleFilter, vtkSurfaceMetrics, vtkThesisStyleFilter

CREATURE = pathlib.Path(__file__).parent.parent / "Data" / "creature.vtp"
controller = vtkMultiProcessController.GetGlobalController()
if controller is None:
    sys.exit("This script measures processes of MPI: see how to start it at its head.")
RANK, RANKS = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()


def surface(points, triangles):
    result = vtkPolyData()
    result.SetPoints(vtkPoints())
    result.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(triangles.astype(np.int64).ravel(), deep=True))
    result.SetPolys(cells)
    return result


def halved(times):
    """Points and triangles of the creature, each triangle cut in four, so many times."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(CREATURE))
    divide = vtkLinearSubdivisionFilter()
    divide.SetInputConnection(reader.GetOutputPort())
    divide.SetNumberOfSubdivisions(times)
    last = divide if times > 0 else reader
    last.Update()
    model = last.GetOutput()
    return (vtk_to_numpy(model.GetPoints().GetData()).astype(float),
            vtk_to_numpy(model.GetPolys().GetConnectivityArray()).reshape(-1, 3))


def boxes(middles, numbers, first, processes):
    """The triangles of this process: along the longest axis of what is left, about as many for each, as in a kd-tree."""
    if processes == 1:
        return numbers
    axis = np.argmax(np.ptp(middles[numbers], axis=0))
    numbers = numbers[np.argsort(middles[numbers, axis], kind="stable")]
    half = processes // 2
    cut = len(numbers) * half // processes
    low = RANK < first + half
    return (boxes(middles, numbers[:cut], first, half) if low
            else boxes(middles, numbers[cut:], first + half, processes - half))


def part_of(points, triangles, kind):
    """What this process has, and the points of the whole that these are."""
    middles = points[triangles].mean(axis=1)
    numbers = np.arange(len(triangles))
    if kind == "slices":
        order = np.argsort(middles[:, 0], kind="stable")
        own = order[len(order) * RANK // RANKS:len(order) * (RANK + 1) // RANKS]
    elif kind == "boxes":
        own = boxes(middles, numbers, 0, RANKS)
    elif kind == "scattered":
        own = numbers[np.random.default_rng(1).integers(0, RANKS, len(numbers)) == RANK]
    else:
        own = numbers if RANK == RANKS - 1 else numbers[:0]
    used = np.unique(triangles[own])
    return surface(points[used], np.searchsorted(used, triangles[own])), used


def over_all(value, operation):
    mine, all_ = (numpy_to_vtk(np.array([float(value)]), deep=True) for _ in range(2))
    controller.AllReduce(mine, all_, operation)
    return all_.GetValue(0)


def memory(what):
    """VmRSS or VmHWM, now and the peak, in MB."""
    with open("/proc/self/status", encoding="ascii") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(what)) / 1024


def forget_peak():
    """@return MB that the process has now, without what it has freed and kept"""
    ctypes.CDLL(None).malloc_trim(0)
    pathlib.Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
    return memory("VmRSS")


def largest_difference(whole, part, used):
    """Of the results of all processes from that of the first one, as a fraction of the diagonal."""
    alone = numpy_to_vtk(coordinates(whole).copy(), deep=True) if RANK == 0 else vtkDoubleArray()
    controller.Broadcast(alone, 0)
    alone = vtk_to_numpy(alone)
    own = np.abs(coordinates(part) - alone[used]).max() if used.size else 0.0
    return over_all(own, vtkCommunicator.MAX_OP) / np.linalg.norm(np.ptp(alone, axis=0))


def coordinates(data):
    return vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else np.zeros((0, 3))


def execute(data, mpi, arguments, again=False):
    """Milliseconds of a first execution, or of one after it; its peak of memory in MB; kB sent and received; its
    result."""
    style = vtkSphericalStyleFilter()
    style.SetController(mpi)
    if arguments.detail_size is not None:
        style.SetDetailSize(arguments.detail_size)
    style.SetNumberOfThreads(1)
    style.SetInputData(data)
    if again:
        style.Update()
        style.SetRoundness(1.2)
    controller.Barrier()
    before = forget_peak()
    start = time.process_time()
    style.Update()
    used = 1e3 * (time.process_time() - start)
    array = style.GetOutputDataObject(1).GetFieldData().GetArray("BytesExchanged")
    return (used, memory("VmHWM") - before, vtk_to_numpy(array).max(axis=0) / 1e3 if array else np.zeros(2),
            style.GetOutput())


def measured(Filter, data, mpi):
    """Milliseconds, peak of memory in MB, and kB sent and received of a filter that measures."""
    filter_ = Filter()
    filter_.SetController(mpi)
    filter_.SetInputData(data)
    if Filter is vtkSurfaceMetrics:
        filter_.SetReferenceData(data)
    controller.Barrier()
    before = forget_peak()
    start = time.process_time()
    filter_.Update()
    used = 1e3 * (time.process_time() - start)
    table = filter_.GetOutputDataObject(filter_.GetNumberOfOutputPorts() - 1)
    array = table.GetFieldData().GetArray("BytesExchanged")
    return used, memory("VmHWM") - before, vtk_to_numpy(array).max(axis=0) / 1e3 if array else np.zeros(2)


def measure_measures(arguments):
    """Prints a line for each filter."""
    if RANK == 0:
        print(f"{RANKS} processes\n   points      parts              filter    alone   spread  MB alone   MB most"
              "   kB sent  kB received", flush=True)
    for times in arguments.halvings:
        for kind in arguments.parts:
            points, triangles = halved(times)
            whole, piece = surface(points, triangles), part_of(points, triangles, kind)[0]
            for Filter in (vtkSurfaceMetrics, vtkGaussMapFilter):
                used, peak, exchanged = measured(Filter, piece, controller)
                alone, peak_alone, _ = measured(Filter, whole if RANK == 0 else vtkPolyData(), None)
                used = over_all(used, vtkCommunicator.SUM_OP)
                peak = over_all(peak, vtkCommunicator.MAX_OP)
                if RANK == 0:
                    print(f"{len(points):9d}{kind:>11s}{Filter.__name__:>20s}{alone:9.0f}{used:9.0f}{peak_alone:10.0f}"
                          f"{peak:10.0f}{exchanged[0]:10.0f}{exchanged[1]:13.0f}", flush=True)


def try_to_round(part, gathered):
    """The peak of memory in MB, and what came out, in words."""
    style = (vtkThesisStyleFilter if gathered else vtkSphericalStyleFilter)()
    if gathered:
        style.SetWeldCoincidentPoints(False)  # the same method, but it needs all of the surface
    style.SetNumberOfThreads(1)
    errors = []

    def note(_style, _event, text):
        errors.append(text.strip().splitlines()[-1])
    note.CallDataType = VTK_STRING
    style.AddObserver("ErrorEvent", note)
    style.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    style.SetInputData(part)
    controller.Barrier()
    before = forget_peak()
    style.Update()
    peak = memory("VmHWM") - before
    if errors:
        return peak, f"fails: {errors[0]}"
    if style.GetOutput().GetNumberOfPoints() < part.GetNumberOfPoints():
        return peak, "has no result"
    return peak, f"has its part of the result, with {peak:.0f} MB more than before"


def measure_with_limit(arguments):
    points, triangles = halved(arguments.halvings[0])
    part, _ = part_of(points, triangles, arguments.parts[0])
    if RANK == 0:
        print(f"{RANKS} processes, {len(points)} points", flush=True)
    del points, triangles
    need = over_all(try_to_round(part, True)[0], vtkCommunicator.MAX_OP)
    allowed = memory("VmSize") + need / 3.0
    resource.setrlimit(resource.RLIMIT_AS, (int(allowed * 2**20), resource.RLIM_INFINITY))
    if RANK == 0:
        print(f"gathered: at most {need:.0f} MB. Each process may now have {need / 3.0:.0f} MB more than it has.", flush=True)
    for gathered in (False, True):
        result = try_to_round(part, gathered)[1]
        controller.Barrier()
        for rank in range(RANKS):
            if RANK == rank:
                print(f"{'gathered' if gathered else 'in parts'}, process {RANK} {result}", flush=True)
            controller.Barrier()


def main():
    parser = argparse.ArgumentParser(description="What a surface costs that is spread over processes.")
    parser.add_argument("--halvings", type=int, nargs="+", default=[0, 1, 2, 3, 4])
    parser.add_argument("--detail-size", type=float, help="of the filter, by default as there")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--parts", nargs="+", choices=("slices", "boxes", "scattered", "one"), default=["slices"])
    parser.add_argument("--limit", action="store_true", help="with a limit of memory for each process")
    parser.add_argument("--measures", action="store_true", help="of the filters that measure")
    arguments = parser.parse_args()
    if arguments.measures:
        measure_measures(arguments)
        return
    if arguments.limit:
        measure_with_limit(arguments)
        return
    if RANK == 0:
        print(f"{RANKS} processes\n   points      parts    alone   spread    again  MB alone   MB most   MB mean   kB sent"
              "  kB received  difference", flush=True)
    for times in arguments.halvings:
        for kind in arguments.parts:
            measure(times, kind, arguments)


def measure(times, kind, arguments):
    """Prints a line."""
    points, triangles = halved(times)
    whole, (piece, used) = surface(points, triangles), part_of(points, triangles, kind)
    del points, triangles

    def least(data, mpi, again=False):
        return min((execute(data, mpi, arguments, again) for _ in range(arguments.repeat)), key=lambda run: run[0])
    spread, memory_spread, exchanged, parts = least(piece, controller)
    again = least(piece, controller, True)[0]
    # The others wait meanwhile.
    alone, memory_alone, _, result = least(whole if RANK == 0 else vtkPolyData(), None)
    difference = largest_difference(result, parts, used)
    spread, again, mean = (over_all(value, vtkCommunicator.SUM_OP) for value in (spread, again, memory_spread))
    most = over_all(memory_spread, vtkCommunicator.MAX_OP)
    if RANK == 0:
        print(f"{whole.GetNumberOfPoints():9d}{kind:>11s}{alone:9.0f}{spread:9.0f}{again:9.0f}{memory_alone:10.0f}"
              f"{most:10.0f}{mean / RANKS:10.0f}{exchanged[0]:10.0f}{exchanged[1]:13.0f}{difference:12.1e}", flush=True)


main()
