# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round all models of a folder, on several machines, and continue after an interruption.

    mpirun -np N pvbatch --sym round_folder.py MODELS OUTPUT [--preset Toy] [--roundness 1] [--detail-size 0.06]
                                                             [--normal-blend 0.6] [--processes N] [--recursive]
                                                             [--limit SECONDS]

On one machine the program sphericalstyle does the same, with more options; this script does it with python3 and
pvpython, too. With MPI each process takes the largest model that nobody has yet, until there is none, and the first
process prints the table. All have to see OUTPUT under the same name. The result of bunny.ply is OUTPUT/bunny.ply.vtp.
With --recursive, OUTPUT gets the same subfolders as MODELS. OUTPUT/summary.csv has a line for each model. A model that
cannot be read or rounded does not stop the others, but the exit code is then 1. Nothing is written outside OUTPUT,
regardless of the names of the models and of links in OUTPUT.

If the script is killed, the same command continues: what is done is not done again, and what was half done is. Models
that have changed since are rounded again, and all of them if the properties are others. OUTPUT/.round_folder has the
journal until all models are done, and longer if one broke off, as when the system has no memory left for it: the same
command then tries it again. A process that shows no sign of life within --limit is given up: one of the others says so
and takes its model. Most programs that start MPI end all processes instead; Open MPI goes on with
mpirun --enable-recovery.
"""
import argparse
import multiprocessing.connection
import os
import pathlib
import sys
import time

from mpi_processes import Processes
from shared_work import Complete, Plan, SharedWork, Superseded, remove
from sphericalstyle import __version__, presets
from sphericalstyle.command_line import Job, Running, find_models, print_table, share_processors, write_table
from sphericalstyle.messages import Error, printable
from sphericalstyle.model_files import READERS, place_in

JOURNAL = ".round_folder"


def say(text):
    """In one piece: processes write to the same place, and pvbatch would write the end of the line by itself."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def parse(default_processes):
    parser = argparse.ArgumentParser(description="Round all models of a folder.")
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--preset", type=str.capitalize, choices=presets.PRESETS,
                        help="the properties that the others below change")
    for name in ("--roundness", "--detail-size", "--normal-blend"):
        parser.add_argument(name, type=float, help="property of the filter; default: that of the filter")
    parser.add_argument("--processes", type=int, default=default_processes,
                        help="number of models at a time (default: one per processor; with MPI, one per process)")
    parser.add_argument("--recursive", action="store_true", help="also round the models in subfolders of MODELS")
    parser.add_argument("--limit", type=float, default=60.0, metavar="SECONDS",
                        help="after which a process that shows no sign of life is given up (default: %(default)g)")
    arguments = parser.parse_args()
    if not arguments.models.is_dir():
        parser.error(f"{arguments.models}: no such folder")
    if arguments.models.resolve() == arguments.output.resolve():
        parser.error("OUTPUT has to be another folder than MODELS")
    if arguments.processes < 1:
        parser.error("--processes: at least 1")
    if arguments.limit <= 0.0:
        parser.error("--limit: above 0")
    return arguments


def stamp_of(source):
    """Another one says that the model has changed."""
    status = source.stat()
    return [status.st_size, status.st_mtime_ns]


def target_of(name):
    return pathlib.Path(name + ".vtp")


def prepare(arguments, properties):
    """What there is to do, or why nothing can be done, for all processes; the first one looks."""
    try:
        return make_plan(arguments, properties)
    except (Error, OSError) as error:
        return {"error": printable(error)}


def make_plan(arguments, properties):
    """The largest models come first: what is left at the
    end is small, so that all processes end at about the same time."""
    found = find_models(arguments.models, arguments.output, arguments.recursive)
    if not found:
        return {"error": f"{arguments.models}: no models ({' '.join(sorted(READERS))})"}
    arguments.output.mkdir(parents=True, exist_ok=True)
    plan = Plan(place_in(arguments.output, JOURNAL), {"sphericalstyle": __version__} | properties)
    if plan.other_settings:
        say("All models are rounded again: the properties, or the version, are others than before.")
    names = {model.as_posix(): stamp_of(arguments.models / model) for model in found}
    kept = {}
    for name, stamp in names.items():
        line = plan.done(name, stamp, arguments.output / target_of(name))
        if line:
            kept[name] = line
    if kept:
        say(f"{len(kept)} of {len(names)} models are done already.")
    for name, process in plan.interrupted():
        say(f"{printable(name)}: process {process} was rounding it when it was interrupted.")
    left = sorted((name for name in names if name not in kept), key=lambda name: names[name], reverse=True)
    return {"run": plan.begin(left), "models": left, "kept": list(kept.values())}


class Folder:
    """What one process does."""

    def __init__(self, arguments, properties, mpi, plan):
        self.arguments, self.properties, self.name = arguments, properties, mpi.name
        self.work = SharedWork(arguments.output / JOURNAL, plan["run"], plan["models"], mpi.rank, mpi.count,
                               arguments.limit)
        self.running = {}

    def start(self, number):
        name = self.work.models[number]
        source = self.arguments.models / name
        stamp = stamp_of(source) if source.exists() else None
        part = self.work.part(number).relative_to(self.work.run)
        job = Job(name, source, self.work.run, part, None)
        self.running[number] = Running(job, self.properties), stamp

    def finish(self, number):
        running, stamp = self.running.pop(number)
        line, target = running.line(), None
        if line["result"] == "rounded":
            try:
                target = place_in(self.arguments.output, target_of(running.job.name))
            except (Error, OSError) as error:
                line = {"model": line["model"], "result": printable(error)}
        part, place = str(self.work.part(number)), str(self.arguments.output / target_of(running.job.name))
        line = {key: value.replace(part, printable(place)) if isinstance(value, str) else value
                for key, value in line.items()}
        line = self.work.finish(number, stamp, target, line)
        say(f"{self.name}[{number + 1}/{len(self.work.models)}] {printable(running.job.name)}: {line['result']}")

    def look(self):
        """Says which processes are lost, and what they were working on."""
        lost = self.work.look()
        if not lost or not self.work.writes_table():
            return
        for other in lost:
            models = [self.work.models[number] for number in self.work.left_by(other)]
            doing = " and ".join(map(printable, models)) or "no model"
            say(f"{self.name}process {other} has shown no sign of life for {self.work.limit:g} s. It was working on"
                f" {doing}.")

    def round(self):
        """Until all models are done. Returns their lines."""
        pause = self.work.limit / 16
        idle = 1e-3
        while True:
            self.look()
            while len(self.running) < self.arguments.processes:
                number = self.work.claim()
                if number is None:
                    break
                self.start(number)
            if not self.running:
                lines = self.work.lines()
                if lines is not None:
                    return lines
                time.sleep(idle)
                idle = min(2.0 * idle, 1.0, pause)
                continue
            receivers = [running.receiver for running, _ in self.running.values()]
            ready = multiprocessing.connection.wait(receivers, timeout=pause)
            for number in [n for n, (running, _) in self.running.items() if running.receiver in ready]:
                self.finish(number)


def report(folder, lines):
    """The table. Returns the exit code."""
    lines.sort(key=lambda line: line["model"])
    print()
    print_table(lines)
    write_table(folder / "summary.csv", lines)
    failed = sum(line["result"] != "rounded" for line in lines)
    print(f"\n{len(lines) - failed} of {len(lines)} models rounded", flush=True)
    broke_off = sum(line.get("again", False) for line in lines)
    if broke_off:
        print(f"{broke_off} broke off; the same command tries only those again", flush=True)
    remove(folder / JOURNAL, with_journal=not broke_off)
    return 1 if failed else 0


def main():
    mpi = Processes()
    arguments = parse(len(os.sched_getaffinity(0)) if mpi.count == 1 else 1)
    share_processors(arguments.processes * mpi.count)
    properties = {name: getattr(arguments, name) for name in ("preset", "roundness", "detail_size", "normal_blend")}
    plan = mpi.share(prepare(arguments, properties) if mpi.rank == 0 else None)
    if "error" in plan:
        sys.exit(plan["error"] if mpi.rank == 0 else 1)
    folder = Folder(arguments, properties, mpi, plan)
    code = 0
    try:
        lines = folder.round()
        while not folder.work.writes_table():  # should its writer be lost, somebody has to be there to notice
            folder.work.check()
            folder.look()
            time.sleep(min(0.1, arguments.limit / 16))
        folder.look()
        while folder.work.doubts():  # a process that is lost is told, also where others have done its work
            time.sleep(min(0.1, arguments.limit / 16))
            folder.look()
        code = report(arguments.output, plan["kept"] + lines)
    except Complete:
        pass
    if folder.work.silent or folder.work.doubts():
        os._exit(code)  # the end of MPI would wait for those that are lost
    return code


if __name__ == "__main__":
    # After success an MPI process must return to pvbatch, which then ends MPI properly.
    try:
        exit_code = main()
    except (OSError, Superseded) as error:  # of the folder or the table; errors of a model are in its line
        sys.exit(printable(error))
    if exit_code:
        sys.exit(exit_code)
