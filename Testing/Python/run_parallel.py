# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs a program in several processes with MPI; exit code 77, for "skipped", where there is no mpirun.

usage: run_parallel.py PROCESSES PROGRAM [ARGUMENT...]
"""
import shutil
import subprocess
import sys


def launcher(processes):
    """The command before the program; more processes than processors, also as root, will do."""
    mpirun = shutil.which("mpirun")
    if not mpirun:
        print("No mpirun: install openmpi-bin, or the program that starts your ParaView's MPI.")
        sys.exit(77)
    version = subprocess.run([mpirun, "--version"], capture_output=True, text=True, check=False).stdout
    open_mpi = ["--oversubscribe", "--bind-to", "none", "--allow-run-as-root"] if "Open MPI" in version else []
    return [mpirun, *open_mpi, "-np", processes]


if __name__ == "__main__":
    sys.exit(subprocess.run(launcher(sys.argv[1]) + sys.argv[2:], check=False).returncode)
