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

TAG = 5207  # any number


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

    def gather(self, values):
        """On the first process, the concatenated lists of all processes; on the others, their own list."""
        if self.rank > 0:
            text = np.frombuffer(json.dumps(values).encode(), dtype=np.uint8)
            self.controller.Send(numpy_to_vtk(text, deep=True), 0, TAG)
            return values
        gathered = list(values)
        for rank in range(1, self.count):
            text = vtkUnsignedCharArray()
            self.controller.Receive(text, rank, TAG)
            gathered += json.loads(vtk_to_numpy(text).tobytes())
        return gathered


def runs_everywhere():
    """Whether every process runs the script, not only the first one."""
    from paraview.modules.vtkRemotingCore import vtkProcessModule
    return vtkProcessModule.GetProcessModule().GetSymmetricMPIMode()
