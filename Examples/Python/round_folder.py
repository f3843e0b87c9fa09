# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round all models of a folder, several at a time.

    python3 round_folder.py MODELS OUTPUT [--roundness 1] [--detail-size 0.06] [--normal-blend 0.6]
                                          [--processes N] [--recursive]

It also runs in pvpython, and on several machines with mpirun -np N pvbatch --sym: each MPI process rounds a part of
the models, and the first process prints the table. The result of bunny.ply is OUTPUT/bunny.ply.vtp, so that it does
not conflict with bunny.stl. With --recursive, OUTPUT gets the same subfolders as MODELS. OUTPUT/summary.csv has a
line for each model. A model that cannot be read or rounded does not stop the others, but the exit code is then 1.
Nothing is written outside OUTPUT, regardless of the names of the models and of links in OUTPUT.
"""
import argparse
import csv
import multiprocessing
import multiprocessing.connection
import os
import pathlib
import sys
import time

from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from model_files import READERS, ModelError, largest_move, place_in, printable, read, rounded, whole, write
from mpi_processes import Processes

COLUMNS = ["model", "points", "new points", "largest move", "seconds", "result"]


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


def find_models(folder, output, recursive):
    """The sorted paths of the models, relative to the folder. Leaves out files in the output folder."""
    files = folder.rglob("*") if recursive else folder.glob("*")
    return sorted(file.relative_to(folder) for file in files
                  if file.suffix.lower() in READERS and file.is_file()
                  and output.resolve() not in file.resolve().parents)


def round_one(model, arguments):
    """Rounds one model. Returns its line of the table."""
    start = time.perf_counter()
    surface = read(arguments.models / model)
    place = place_in(arguments.output, model.with_name(model.name + ".vtp"))
    style = rounded(surface, Roundness=arguments.roundness, DetailSize=arguments.detail_size,
                    NormalBlend=arguments.normal_blend)
    with whole(place) as part:
        write(vtkXMLPolyDataWriter(), part, style.GetOutput())
    added = style.GetOutput().GetNumberOfPoints() - surface.GetNumberOfPoints()
    return {"points": surface.GetNumberOfPoints(), "new points": added,
            "largest move": f"{largest_move(style.GetOutput()):.4g}",
            "seconds": f"{time.perf_counter() - start:.2f}", "result": "rounded"}


def work(model, arguments, connection):
    """Runs in its own process, so that a reader that crashes does not affect other models."""
    try:
        connection.send(round_one(model, arguments))
    except (ModelError, OSError, RuntimeError, ValueError) as error:
        connection.send({"result": "\n".join(map(printable, str(error).splitlines()))})


def round_all(models, arguments):
    """Yields (model, line of the table), in the order in which they are finished."""
    context = multiprocessing.get_context("fork")  # spawning does not work in pvpython
    waiting, running = list(reversed(models)), {}
    while waiting or running:
        while waiting and len(running) < arguments.processes:
            model = waiting.pop()
            receiver, sender = context.Pipe(duplex=False)
            process = context.Process(target=work, args=(model, arguments, sender))
            process.start()
            sender.close()
            running[process.sentinel] = model, process, receiver
        for sentinel in multiprocessing.connection.wait(list(running)):
            model, process, receiver = running.pop(sentinel)
            process.join()
            try:
                line = receiver.recv()
            except EOFError:
                line = {"result": f"broke off with exit code {process.exitcode}"}
            yield model, {"model": name_of(model)} | line


def name_of(model):
    """The model's relative path for the table, changed if a spreadsheet would take it for a formula."""
    path = model.as_posix()
    return "./" + path if path[0] in "=+-@\t\r" else path


def share_of(models, folder, mpi):
    """The models for this MPI process; every process gets a similar mix of large and small ones."""
    by_size = sorted(models, key=lambda model: (folder / model).stat().st_size, reverse=True)
    return by_size[mpi.rank::mpi.count]


def print_table(lines):
    rows = [COLUMNS] + [[printable(line.get(column, "")) for column in COLUMNS[:-1]]
                        + [" ".join(line["result"].split())] for line in lines]
    widths = [max(len(row[k]) for row in rows) for k in range(len(COLUMNS) - 1)]
    for row in rows:
        cells = [row[0].ljust(widths[0])] + [cell.rjust(w) for cell, w in zip(row[1:-1], widths[1:])]
        print("  ".join(cells + row[-1:]))


def main():
    mpi = Processes()
    arguments = parse(len(os.sched_getaffinity(0)) if mpi.count == 1 else 1)
    found = find_models(arguments.models, arguments.output, arguments.recursive)
    if not found:
        sys.exit(f"{arguments.models}: no models ({' '.join(sorted(READERS))})")
    models = share_of(found, arguments.models, mpi) if mpi.count > 1 else found
    arguments.output.mkdir(parents=True, exist_ok=True)
    # The processes share the processors.
    threads = max(1, len(os.sched_getaffinity(0)) // (mpi.count * min(arguments.processes, max(1, len(models)))))
    os.environ.setdefault("VTK_SMP_MAX_THREADS", str(threads))

    lines = []
    for model, line in round_all(models, arguments):
        lines.append(line)
        print(f"{mpi.name}[{len(lines)}/{len(models)}] {printable(model.as_posix())}: {line['result']}", flush=True)
    lines = mpi.gather(lines)
    if mpi.rank > 0:
        return 0
    lines.sort(key=lambda line: line["model"])

    print()
    print_table(lines)
    with whole(arguments.output / "summary.csv") as part:
        # File names are bytes; write them unchanged.
        with open(part, "w", newline="", encoding="utf-8", errors="surrogateescape") as file:
            table = csv.DictWriter(file, COLUMNS)
            table.writeheader()
            table.writerows(lines)
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
