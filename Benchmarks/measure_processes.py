# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What rounding a surface that is spread over the processes of MPI costs, beside rounding it in one.

    mpirun -np 4 pvbatch --sym measure_processes.py [--halvings 0 1 2 3 4] [--detail-size 0.06] [--repeat 5]

The creature of Data/ with its edges halved, in slices over the processes; each also has the whole. Times are those that
a processor works, in milliseconds, with one thread, the least of several: rounded alone by the first process; spread,
the sum of all processes; the same again with another Roundness. Waiting for others counts as work. Memory is the peak
of an execution above what the process had before it, in MB: alone; spread, that of the process with most, and the mean.
A process keeps memory, so measure one size at a time for it. Then the most kB that a process has sent and received.
"""
import argparse
import pathlib
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

from sphericalstyle import vtkSphericalStyleFilter

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


def slice_of(points, triangles):
    """The triangles of this process: along x, as many for each."""
    order = np.argsort(points[triangles].mean(axis=1)[:, 0], kind="stable")
    mine = triangles[order[len(order) * RANK // RANKS:len(order) * (RANK + 1) // RANKS]]
    used = np.unique(mine)
    return surface(points[used], np.searchsorted(used, mine))


def over_all(value, operation):
    mine, all_ = (numpy_to_vtk(np.array([float(value)]), deep=True) for _ in range(2))
    controller.AllReduce(mine, all_, operation)
    return all_.GetValue(0)


def memory(what):
    """VmRSS or VmHWM, now and the peak, in MB."""
    with open("/proc/self/status", encoding="ascii") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(what)) / 1024


def forget_peak():
    pathlib.Path("/proc/self/clear_refs").write_text("5", encoding="ascii")


def execute(data, mpi, arguments, again=False):
    """Milliseconds of a first execution, or of one after it; its peak of memory in MB; kB sent and received."""
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
    before = memory("VmRSS")
    forget_peak()
    start = time.process_time()
    style.Update()
    used = 1e3 * (time.process_time() - start)
    array = style.GetOutputDataObject(1).GetFieldData().GetArray("BytesExchanged")
    return used, memory("VmHWM") - before, vtk_to_numpy(array).max(axis=0) / 1e3 if array else np.zeros(2)


def main():
    parser = argparse.ArgumentParser(description="What a surface costs that is spread over processes.")
    parser.add_argument("--halvings", type=int, nargs="+", default=[0, 1, 2, 3, 4])
    parser.add_argument("--detail-size", type=float, help="of the filter, by default as there")
    parser.add_argument("--repeat", type=int, default=5)
    arguments = parser.parse_args()
    if RANK == 0:
        print(f"{RANKS} processes\n   points    alone   spread    again  MB alone   MB most   MB mean   kB sent"
              "  kB received", flush=True)
    for times in arguments.halvings:
        points, triangles = halved(times)
        whole, piece = surface(points, triangles), slice_of(points, triangles)
        del points, triangles

        def least(data, mpi, again=False):
            return min((execute(data, mpi, arguments, again) for _ in range(arguments.repeat)), key=lambda run: run[0])
        spread, memory_spread, exchanged = least(piece, controller)
        again, _, _ = least(piece, controller, True)
        # The others wait meanwhile.
        alone, memory_alone, _ = least(whole if RANK == 0 else vtkPolyData(), None)
        spread, again, mean = (over_all(value, vtkCommunicator.SUM_OP) for value in (spread, again, memory_spread))
        most = over_all(memory_spread, vtkCommunicator.MAX_OP)
        if RANK == 0:
            print(f"{whole.GetNumberOfPoints():9d}{alone:9.0f}{spread:9.0f}{again:9.0f}{memory_alone:10.0f}{most:10.0f}"
                  f"{mean / RANKS:10.0f}{exchanged[0]:10.0f}{exchanged[1]:13.0f}", flush=True)


main()
