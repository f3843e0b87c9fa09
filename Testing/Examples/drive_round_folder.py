# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs round_folder.py and kills it at a certain place, one process of MPI, or as one process of several without MPI.

usage: drive_round_folder.py EXAMPLES PLACE RANK MEETING MODELS OUTPUT [OPTION...]

PLACE says where the process kills itself: "unwritten", "cut", "written" when it writes the second line of its journal
(before, in the middle, behind), "first" before the first line, "table" behind the table, "removal" while it removes
the journal, "no" nowhere. With "model" it goes on, and the child that rounds creature.vtp kills itself.
RANK is 0 or 1 of 2 processes that share the plan through the file MEETING; process 0 goes on when there is a file
MEETING.go. With "-" it is alone. With MPI it is mpi-K, the process that kills itself; the others wait until that has
taken a model.
"""
import json
import os
import pathlib
import signal
import sys
import time

examples, place, rank, meeting = sys.argv[1:5]
del sys.argv[1:5]
sys.path.insert(0, examples)
import round_folder
import shared_work
from sphericalstyle import command_line

append, claim = shared_work._append, shared_work.SharedWork.claim
victim = rank[4:] if rank.startswith("mpi-") else None
if victim and victim not in (os.environ.get("OMPI_COMM_WORLD_RANK"), os.environ.get("PMI_RANK")):
    place = "no"
lines = 0


def die():
    os.kill(os.getpid(), signal.SIGKILL)


def write(path, values):
    global lines
    lines += path.name.startswith("done-")
    now = lines == (1 if place == "first" else 2)
    if now and place in ("first", "unwritten"):
        die()
    if now and place == "cut":
        path.write_bytes(path.read_bytes() + json.dumps(values).encode()[:-9])
        die()
    append(path, values)
    if now and place == "written":
        die()


class OneOfTwo:
    """In place of MPI."""

    def __init__(self):
        self.rank, self.count, self.name = int(rank), 2, f"process {rank} "

    def share(self, value):
        plan = pathlib.Path(meeting)
        if self.rank == 0:
            plan.with_suffix(".part").write_text(json.dumps(value), encoding="utf-8")
            plan.with_suffix(".part").replace(plan)
        wait_for = plan.with_suffix(".go") if self.rank == 0 else plan
        while not wait_for.exists():
            time.sleep(0.01)
        return json.loads(plan.read_text(encoding="utf-8"))


def claim_after_victim(work):
    """None as long as the victim has no model."""
    if any(taken.read_text(encoding="ascii") == victim for taken in work.run.glob("*.0")):
        shared_work.SharedWork.claim = claim
        return claim(work)
    return None


shared_work._append = write
if place == "table":
    round_folder.remove = lambda folder, with_journal: die()
if place == "removal":
    shared_work.shutil.rmtree = lambda folder: die()
if place == "model":
    work_on = command_line._try
    command_line._try = lambda job, *more: die() if job.name == "creature.vtp" else work_on(job, *more)
if victim and place == "no":
    shared_work.SharedWork.claim = claim_after_victim
elif rank != "-" and not victim:
    round_folder.Processes = OneOfTwo
exit_code = round_folder.main()
if exit_code:
    sys.exit(exit_code)
