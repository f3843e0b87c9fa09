# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The MPI processes that run a script with pvbatch --sym; a single process without MPI."""
import json
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController


class Processes:
    """rank: number of this process, count: number of processes, name: a prefix for lines of output"""

    def __init__(self):
        self.controller = vtkMultiProcessController.GetGlobalController()
        self.rank = self.controller.GetLocalProcessId() if self.controller else 0
        self.count = self.controller.GetNumberOfProcesses() if self.controller else 1
        self.name = f"process {self.rank} " if self.count > 1 else ""
        started = int(os.environ.get("OMPI_COMM_WORLD_SIZE") or os.environ.get("PMI_SIZE") or 1)
        if self.count != max(started, self.count) or (self.count > 1 and not runs_everywhere()):
            sys.exit("With mpirun this script needs: pvbatch --sym")

    def share(self, value):
        """The first process' value, which JSON has to be able to hold, on all."""
        if self.count == 1:
            return value
        text = vtkUnsignedCharArray()
        if self.rank == 0:
            text = numpy_to_vtk(np.frombuffer(json.dumps(value).encode(), dtype=np.uint8), deep=True)
        self.controller.Broadcast(text, 0)
        return json.loads(vtk_to_numpy(text).tobytes())


def runs_everywhere():
    """Whether every process runs the script, not only the first one."""
    from paraview.modules.vtkRemotingCore import vtkProcessModule
    return vtkProcessModule.GetProcessModule().GetSymmetricMPIMode()
