# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A list of models that several processes work through together, and that a kill at any moment does not lose.

All that the processes say to each other is files in a folder that all of them see. VTK's controller in Python has no
receive that ends without a message, so nobody who waits for one could notice that the sender is gone.

    FOLDER/settings.json         what is done to each model; another content starts anew
    FOLDER/done-RUN-RANK.jsonl   a line for each model that is done, appended by one process
    FOLDER/complete              the table is written, and what is here is about to be removed, but for the journal
                                 where a model is to be tried again
    FOLDER/run-RUN/models.json   the models of a run, those with most work first
    FOLDER/run-RUN/K.0           model K is taken, by the process whose number is in the file; K.1 by the second, after
                                 the first was lost
    FOLDER/run-RUN/beat-RANK     changes as long as the process lives
    FOLDER/run-RUN/part-*        results that are not at their place yet

A result is written to a part, then its line to the journal, then the part is renamed. Whatever is killed in between,
the line says how many bytes the result has, so the next run knows whether to rename a part, to do nothing, or to do
the model (again, if there is no line of it).
"""
import json
import os
import re
import shutil
import time

from sphericalstyle.messages import printable

COMPLETE = "complete"


class Superseded(RuntimeError):
    """Somebody else has started to work on the same folder."""


class Complete(RuntimeError):
    """Another process has written the table."""


def _append(path, values):
    # One call for a complete line: a kill leaves all of it or nothing, but for a full disk.
    with open(path, "ab", buffering=0) as file:
        file.write(json.dumps(values).encode() + b"\n")


def _entries(path, offset=0):
    """What stands in the complete lines of a journal behind the offset, and where they end."""
    try:
        with open(path, "rb") as file:
            file.seek(offset)
            data = file.read()
    except FileNotFoundError:
        return [], offset
    end = data.rfind(b"\n") + 1
    entries = []
    for line in data[:end].splitlines():
        try:
            entries.append(json.loads(line))
        except ValueError:
            pass  # cut off on a full disk; the model is done again
    return entries, offset + end


def _is_whole(entry):
    """Whether a line has what ours have, and moves no other files."""
    return (isinstance(entry, dict) and {"model", "stamp", "line", "bytes", "part", "again"} <= entry.keys()
            and isinstance(entry["part"], str) and re.fullmatch(r"run-\d+/part-\d+-\d+\.vtp|", entry["part"]))


def _has_size(path, size):
    try:
        return path.stat().st_size == size
    except OSError:
        return False


class Plan:
    """What the first process finds in the folder, and how the models are shared out."""

    def __init__(self, folder, settings):
        """Starts anew where the folder has been used with other settings."""
        self.folder = folder
        settings = json.loads(json.dumps(settings))
        written = folder / "settings.json"
        self.other_settings = written.exists() and _entries(written)[0] != [settings]
        if self.other_settings:
            shutil.rmtree(folder)
        for left in (_away(folder), _away(folder / "run")):
            if left.exists():
                shutil.rmtree(left)
        folder.mkdir(parents=True, exist_ok=True)
        links = [path for path in folder.iterdir() if path.is_symlink()]
        if links:
            raise OSError(f"{links[0]} is a link; it could lead anywhere")
        self._runs = [int(run.name[4:]) for run in folder.iterdir() if re.fullmatch(r"run-\d+", run.name)]
        self._written = {entry["model"]: entry for journal in sorted(folder.glob("done-*.jsonl"))
                         for entry in _entries(journal)[0] if _is_whole(entry)}
        if not written.exists():
            _append(written, settings)

    def done(self, model, stamp, target):
        """The line of a model that is done, or None. Puts a result to its place that a kill has kept from it."""
        entry = self._written.get(model)
        if entry is None or entry["stamp"] != stamp or entry["again"]:
            return None
        part = self.folder / entry["part"] if entry["part"] else None
        if part and _has_size(part, entry["bytes"]):
            part.replace(target)
        elif part and not _has_size(target, entry["bytes"]):
            return None
        return entry["line"]

    def interrupted(self):
        """(model, process) of what an earlier run was working on when it ended."""
        for number in self._runs:
            run = self.folder / f"run-{number}"
            for models in _entries(run / "models.json")[0]:
                for claim in sorted(run.glob("*.[0-9]")):
                    model = models[int(claim.name.split(".")[0])]
                    if model not in self._written:
                        yield model, claim.read_text(encoding="ascii") or "?"

    def begin(self, models):
        """The number of a new run over these models."""
        (self.folder / COMPLETE).unlink(missing_ok=True)
        journals = [int(re.match(r"done-(\d+)", journal.name)[1]) for journal in self.folder.glob("done-[0-9]*.jsonl")]
        number = max(self._runs + journals, default=0) + 1
        for old in self._runs:
            shutil.rmtree(self.folder / f"run-{old}", ignore_errors=True)
        run = self.folder / f"run-{number}"
        run.mkdir()
        _append(run / "models.json", models)
        return number


class SharedWork:
    """The part of one process in a run."""

    def __init__(self, folder, number, models, rank, count, limit):
        """limit: seconds after which a process that shows no sign of life counts as lost"""
        self.folder, self.models, self.rank, self.limit = folder, models, rank, limit
        self.run = folder / f"run-{number}"
        self.silent = set()
        self._journals = {other: (folder / f"done-{number}-{other}.jsonl", 0) for other in range(count)}
        self._next, self._beats, self._looked = 0, 0, -float("inf")
        self._generations = {}
        self._finished, self._finished_by = {}, {}
        self._unnamed = {}
        self._heard = {other: (None, time.monotonic()) for other in range(count) if other != rank}

    def look(self):
        """Shows that this process lives, and returns the processes that are newly found to be lost. To be called
        several times within the limit; does nothing when it is too early."""
        now = time.monotonic()
        if now - self._looked < self.limit / 8:
            return []
        self._looked = now
        self._beats += 1
        try:
            (self.run / f"beat-{self.rank}").write_text(str(self._beats), encoding="ascii")
        except FileNotFoundError:
            self.check()
            raise
        lost = []
        for other, (beat, since) in self._heard.items():
            new = _text_of(self.run / f"beat-{other}")
            if new != beat:
                self._heard[other] = new, now
                self.silent.discard(other)
            elif now - since > self.limit and other not in self.silent:
                self.silent.add(other)
                lost.append(other)
        return lost

    def doubts(self):
        """Whether a process may be lost that is not in `silent` yet: it has shown no sign of life for half of the
        limit. Another process may have noticed first, and be through already."""
        now = time.monotonic()
        return any(now - since > self.limit / 2 for other, (_, since) in self._heard.items()
                   if other not in self.silent)

    def check(self):
        """@throw Complete, Superseded"""
        if self.run.is_dir():
            return
        if self.folder.is_dir() and not (self.folder / COMPLETE).exists():
            raise Superseded("another run has been started in this folder")
        raise Complete

    def claim(self):
        """The number of a model for this process, or None if there is none at the moment: first what a lost process
        has left, then the next that nobody has."""
        if self.silent:
            for number, generation, owner in self.unfinished():
                if owner in self.silent and self._take(number, generation + 1):
                    return number
        while self._next < len(self.models):
            self._next += 1
            if self._take(self._next - 1, 0):
                return self._next - 1
        return None

    def _take(self, number, generation):
        try:
            handle = os.open(self.run / f"{number}.{generation}", os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666)
        except FileExistsError:
            return False
        except FileNotFoundError:
            self.check()
            raise
        with open(handle, "w", encoding="ascii") as file:
            file.write(str(self.rank))
        self._generations[number] = generation
        return True

    def unfinished(self):
        """(number, generation, process) of the models that are taken and not done. The process is None where it has not
        written its number yet; if it has not within the limit, it is lost, and counts as any that is silent."""
        self._read_journals()
        for number, model in enumerate(self.models):
            if model in self._finished:
                continue
            if not (self.run / f"{number}.0").exists():
                return  # they are taken one after the other
            generation = 0
            while (self.run / f"{number}.{generation + 1}").exists():
                generation += 1
            text = _text_of(self.run / f"{number}.{generation}")
            since = self._unnamed.setdefault((number, generation), time.monotonic()) if not text else None
            late = since is not None and time.monotonic() - since > self.limit
            yield number, generation, int(text) if text else min(self.silent, default=None) if late else None

    def left_by(self, process):
        """The numbers of the models that a process has taken and not done, also where another one has them now."""
        self._read_journals()
        for number, model in enumerate(self.models):
            generation = 0
            while (claim := self.run / f"{number}.{generation}").exists():
                if self._finished_by.get(model) != process and _text_of(claim) == str(process):
                    yield number
                generation += 1
            if generation == 0:
                return  # they are taken one after the other

    def part(self, number):
        """Where the result is written first."""
        return self.run / f"part-{self.rank}-{number}.vtp"

    def finish(self, number, stamp, target, line):
        """Writes down that the model is done and puts its result to its place, if it has one: target may be None.
        Returns the line, another one if the result could not be put there."""
        self.check()
        if self._taken_from(number):
            return line | {"result": "left to the process that has taken it over"}
        part = self.part(number)
        entry = {"model": self.models[number], "stamp": stamp, "line": line, "bytes": 0, "part": "",
                 "again": line.get("again", False)}
        if target:
            entry |= {"bytes": part.stat().st_size, "part": part.relative_to(self.folder).as_posix()}
        journal = self._journals[self.rank][0]
        _append(journal, entry)
        if target:
            try:
                part.replace(target)
            except OSError as error:
                line = {"model": line["model"], "result": printable(f"{target}: {error.strerror}")}
                _append(journal, entry | {"part": "", "line": line})
        return line

    def _taken_from(self, number):
        """Whether another process has taken this model, since this one was thought lost."""
        return (self.run / f"{number}.{self._generations[number] + 1}").exists()

    def _read_journals(self):
        for other, (path, offset) in self._journals.items():
            entries, end = _entries(path, offset)
            self._journals[other] = path, end
            self._finished.update((entry["model"], entry["line"]) for entry in entries)
            self._finished_by.update((entry["model"], other) for entry in entries)

    def lines(self):
        """The lines of all models of the run once all are done, else None."""
        if self._next < len(self.models):
            return None
        self._read_journals()
        return list(self._finished.values()) if len(self._finished) == len(self.models) else None

    def writes_table(self):
        """Whether no process before this one lives."""
        return all(other in self.silent for other in range(self.rank))


def _text_of(path):
    try:
        return path.read_text(encoding="ascii")
    except FileNotFoundError:
        return ""


def remove(folder, with_journal):
    """Most is in the run, and takes long to remove: until it is gone, the journal says that all is done. What is half
    removed of the journal must not pass for one that says less than there was."""
    (folder / COMPLETE).touch()
    for run in folder.glob("run-*"):
        _remove_at_once(run, _away(folder / "run"))
    if with_journal:
        _remove_at_once(folder, _away(folder))


def _remove_at_once(folder, away):
    """Others that still write to it find nothing from now on."""
    folder.rename(away)
    shutil.rmtree(away)


def _away(folder):
    return folder.with_name(folder.name + ".removed")
