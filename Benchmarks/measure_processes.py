# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What gathering a surface from the processes of MPI costs beside rounding it.

    mpirun -np 4 pvbatch --sym measure_processes.py [--halvings 0 1 2 3 4] [--detail-size 0.06] [--repeat 5]
                                                           [--head-start 0.5]

The creature of Data/ with its edges halved, in slices over the processes; each also has the whole. Times are those that
a processor works on the first process, in milliseconds, with one thread, the least of several: rounded alone; spread,
where the others have sent before; spread again with another Roundness. Memory is the peak of the first process
so far, in MB, after each of the first two.
"""
import argparse
import pathlib
import resource
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkParallelCore import vtkMultiProcessController

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


def execute(data, mpi, arguments, again=False):
    """Milliseconds of a first execution, or of one after it."""
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
    time.sleep(arguments.head_start if RANK == 0 else 0)  # waiting would be work
    start = time.process_time()
    style.Update()
    return 1e3 * (time.process_time() - start)


def memory():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description="What gathering a surface from processes costs.")
    parser.add_argument("--halvings", type=int, nargs="+", default=[0, 1, 2, 3, 4])
    parser.add_argument("--detail-size", type=float, help="of the filter, by default as there")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--head-start", type=float, default=0.5, help="seconds that the others get to send in")
    arguments = parser.parse_args()
    if RANK == 0:
        print(f"{RANKS} processes\n   points    alone   spread    again  MB alone  MB spread", flush=True)
    for times in arguments.halvings:
        points, triangles = halved(times)
        whole, piece = surface(points, triangles), slice_of(points, triangles)

        def least(*how):
            return min(execute(*how) for _ in range(arguments.repeat))
        # The others wait meanwhile.
        alone = least(whole if RANK == 0 else vtkPolyData(), None, arguments)
        memory_alone = memory()
        spread = least(piece, controller, arguments)
        memory_spread = memory()
        again = least(piece, controller, arguments, True)
        if RANK == 0:
            print(f"{len(points):9d}{alone:9.0f}{spread:9.0f}{again:9.0f}{memory_alone:10.0f}{memory_spread:11.0f}",
                  flush=True)


main()
