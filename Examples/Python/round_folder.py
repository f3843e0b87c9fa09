# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round all models of a folder, on several machines.

    mpirun -np N pvbatch --sym round_folder.py MODELS OUTPUT [--roundness 1] [--detail-size 0.06] [--normal-blend 0.6]
                                                             [--processes N] [--recursive]

On one machine the program sphericalstyle does the same, with more options; this script does it with python3 and
pvpython, too. With MPI each process rounds a part of the models, and the first process prints the table. The result of
bunny.ply is OUTPUT/bunny.ply.vtp. With --recursive, OUTPUT gets the same subfolders as MODELS. OUTPUT/summary.csv has
a line for each model. A model that cannot be read or rounded does not stop the others, but the exit code is then 1.
Nothing is written outside OUTPUT, regardless of the names of the models and of links in OUTPUT.
"""
import argparse
import os
import pathlib
import sys

from mpi_processes import Processes
from sphericalstyle.command_line import Job, find_models, print_table, round_all, write_table
from sphericalstyle.messages import printable
from sphericalstyle.model_files import READERS


def parse(default_processes):
    parser = argparse.ArgumentParser(description="Round all models of a folder.")
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    for name in ("--roundness", "--detail-size", "--normal-blend"):
        parser.add_argument(name, type=float, help="property of the filter; default: that of the filter")
    parser.add_argument("--processes", type=int, default=default_processes,
                        help="number of models at a time (default: one per processor; with MPI, one per process)")
    parser.add_argument("--recursive", action="store_true", help="also round the models in subfolders of MODELS")
    arguments = parser.parse_args()
    if not arguments.models.is_dir():
        parser.error(f"{arguments.models}: no such folder")
    if arguments.models.resolve() == arguments.output.resolve():
        parser.error("OUTPUT has to be another folder than MODELS")
    if arguments.processes < 1:
        parser.error("--processes: at least 1")
    return arguments


def share_of(models, folder, mpi):
    """The models for this MPI process; every process gets a similar mix of large and small ones."""
    by_size = sorted(models, key=lambda model: (folder / model).stat().st_size, reverse=True)
    return by_size[mpi.rank::mpi.count]


def main():
    mpi = Processes()
    arguments = parse(len(os.sched_getaffinity(0)) if mpi.count == 1 else 1)
    found = find_models(arguments.models, arguments.output, arguments.recursive)
    if not found:
        sys.exit(f"{arguments.models}: no models ({' '.join(sorted(READERS))})")
    models = share_of(found, arguments.models, mpi) if mpi.count > 1 else found
    arguments.output.mkdir(parents=True, exist_ok=True)

    jobs = [Job(model.as_posix(), arguments.models / model, arguments.output,
                model.with_name(model.name + ".vtp"), None) for model in models]
    properties = {"roundness": arguments.roundness, "detail_size": arguments.detail_size,
                  "normal_blend": arguments.normal_blend}
    lines = []
    for job, line in round_all(jobs, properties, arguments.processes, sharing=mpi.count):
        lines.append(line)
        print(f"{mpi.name}[{len(lines)}/{len(jobs)}] {printable(job.name)}: {line['result']}", flush=True)
    lines = mpi.gather(lines)
    if mpi.rank > 0:
        return 0
    lines.sort(key=lambda line: line["model"])

    print()
    print_table(lines)
    write_table(arguments.output / "summary.csv", lines)
    failed = sum(line["result"] != "rounded" for line in lines)
    print(f"\n{len(lines) - failed} of {len(lines)} models rounded")
    return 1 if failed else 0


if __name__ == "__main__":
    # After success an MPI process must return to pvbatch, which then ends MPI properly.
    try:
        code = main()
    except OSError as error:  # of the folder or the table; errors of a model are in its line
        sys.exit(printable(error))
    if code:
        sys.exit(code)
