# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Run clang-tidy on the sources that the build compiles. Utilities/check.sh runs this script.

A file without findings is skipped until it, a header that it includes, the command that compiles it, or clang-tidy
itself changes. BUILD/tidy has the hashes of the clean files.
"""
import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import threading
import time

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def run(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, **options)


def compiled(project, build):
    """Our own sources and the commands that compile them, without generated sources."""
    commands = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = pathlib.Path(entry["file"])
        if file.is_relative_to(project) and not file.is_relative_to(build):
            commands.setdefault(file.relative_to(project), entry)
    return commands


def git_names(project, *arguments):
    done = run("git", "-C", str(project), *arguments)
    if done.returncode:
        sys.exit(f"git {' '.join(arguments)}: {done.stderr.strip()}")
    return {pathlib.Path(name) for name in done.stdout.split("\0") if name}


def changed_since(project, ref):
    return (git_names(project, "diff", "--name-only", "-z", ref, "--") |
            git_names(project, "ls-files", "-z", "--others", "--exclude-standard"))


def order_of(project, sources, changed):
    """The sources in which the change can cause findings, the most likely first: changed sources, one source for each
    changed header (preferably of the same name), then all others that include one of these directly or indirectly."""
    if any(file.name == ".clang-tidy" for file in changed):
        return sorted(sources)
    files = set(sources) | git_names(project, "ls-files", "-z", "--cached", "--others", "--exclude-standard", "*.h")
    included = {file: {pathlib.PurePosixPath(name).name for name in INCLUDE.findall((project / file).read_text())}
                for file in files if (project / file).is_file()}

    def includers(header):
        found, names = set(), [header.name]
        while names:
            name = names.pop()
            more = {file for file, headers in included.items() if name in headers} - found
            found |= more
            names += [file.name for file in more if file.suffix == ".h"]
        return found & set(sources)

    first = sorted(set(sources) & changed)
    second, third = [], []
    for header in sorted(file for file in changed if file.suffix == ".h"):
        users = sorted(includers(header), key=lambda file: (file.stem != header.stem, file))
        second += users[:1]
        third += users[1:]
    return list(dict.fromkeys([*first, *second, *third]))


class Tidy:
    def __init__(self, project, build):
        self.project, self.build, self.clean = project, build, build / "tidy"
        self.clean.mkdir(exist_ok=True)
        self.version = run("clang-tidy", "--version", check=True).stdout

    @functools.cache
    def content(self, file):
        return hashlib.sha256(pathlib.Path(file).read_bytes()).hexdigest()

    def configuration(self, file):
        """The .clang-tidy files that apply to a source."""
        return [folder / ".clang-tidy" for folder in (self.project / file).parents
                if folder.is_relative_to(self.project) and (folder / ".clang-tidy").exists()]

    def key(self, file, entry):
        """A hash of everything that the result depends on; None if the compiler cannot list what the file includes."""
        words = shlex.split(entry["command"])
        if pathlib.Path(words[0]).name in ("ccache", "distcc"):
            del words[0]
        at = words.index("-o")
        words = [word for word in words[:at] + words[at + 2:] if word != "-c"]
        done = run(*words, "-M", "-MT", "x", cwd=entry["directory"])
        if done.returncode:
            return None
        headers = shlex.split(done.stdout.replace("\\\n", " "))[1:]
        state = hashlib.sha256(f"{self.version}{words}".encode())
        for name in [*sorted({os.path.normpath(os.path.join(entry["directory"], name)) for name in headers}),
                     *map(str, self.configuration(file))]:
            state.update(f"{name} {self.content(name)}\n".encode())
        return state.hexdigest()

    def check(self, file, entry):
        """The findings of clang-tidy in a file, and whether clang-tidy was run."""
        key = self.key(file, entry)
        if key and (self.clean / key).exists():
            return "", False
        done = run("clang-tidy", "--quiet", "-p", str(self.build), str(self.project / file))
        if done.returncode == 0 and key:
            (self.clean / key).touch()
        # stderr counts suppressed findings; it matters only if clang-tidy failed without any output on stdout.
        return (done.stdout or done.stderr or "failed") if done.returncode else "", True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="a configured build folder with compile_commands.json")
    parser.add_argument("--since", metavar="REF", help="only files that changed since this commit, and files that include them")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="start no further file after this time")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    arguments = parser.parse_args()

    start = time.monotonic()
    project, build = pathlib.Path(__file__).resolve().parents[1], arguments.build.resolve()
    commands = compiled(project, build)
    if not commands:
        sys.exit(f"{build}/compile_commands.json names no source of ours")
    files = sorted(commands)
    if arguments.since:
        files = order_of(project, files, changed_since(project, arguments.since))
    tidy = Tidy(project, build)
    asked, found, reached, lock = 0, 0, 0, threading.Lock()

    def one(file):
        nonlocal asked, found, reached
        if time.monotonic() - start > arguments.seconds:
            return
        report, was_asked = tidy.check(file, commands[file])
        with lock:
            reached, asked, found = reached + 1, asked + was_asked, found + bool(report)
            if report:
                print(f"{report.rstrip()}\n", flush=True)

    with concurrent.futures.ThreadPoolExecutor(max_workers=arguments.jobs) as pool:
        list(pool.map(one, files))
    print(f"clang-tidy: {reached} of {len(commands)} sources, {asked} of them checked now, findings in {found}, "
          f"{time.monotonic() - start:.0f} s")
    if reached < len(files):
        print(f"clang-tidy: no time left for {len(files) - reached} sources that the change concerns: "
              f"{' '.join(map(str, files[reached:reached + 5]))} ...")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
