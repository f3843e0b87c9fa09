#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Changes one operator, constant or condition of Filters/ at a time, and looks whether a test fails.

A change that no test notices (a survivor) is a place that nothing checks, or one that does not matter: look at each.
Which changes are made follows from the sources and the seed alone. Files are changed in place and put back, so use a
clone that nothing else uses, with a build whose tests pass:

    cmake --preset release -DCMAKE_UNITY_BUILD=OFF -DCMAKE_LINK_DEPENDS_NO_SHARED=ON && cmake --build build
    Utilities/mutate.py build --count 200

Results are appended to a file; started again, the script goes on after the last one. Each change is tried with the
tests of the file's name, then with those of its folder (such as Solver/Mesh), the quick ones of Solver or Geometry, the
quick ones of Cxx, and with a surface that is spread over two processes. Headers are not changed: half of the project
would be built again.
"""
import argparse
import collections
import json
import random
import re
import resource
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SWAPS = {
    "+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=",
    "<": ">=", ">=": "<", ">": "<=", "<=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&",
    "std::min(": "std::max(", "std::max(": "std::min(", "true": "false", "false": "true",
}  # fmt: skip
# clang-format puts a space on both sides of an operator that has two operands, and of no other.
OPERATOR = re.compile(r"(?<=[\w)\]}] )(?:[-+*/]=?|<=?|>=?|==|!=|&&|\|\|)(?=\s)")
WORD = re.compile(r"std::(?:min|max)\(|\b(?:true|false)\b")
CONSTANT = re.compile(r"(?<![\w.<\[])(?:\d+\.\d*(?:e[-+]?\d+)?|\d+)(?![\w.>\]])")
CONDITION = re.compile(r"\bif \(")
GROUPS = ("Solver.", "Geometry.", "Cxx.")
SPREAD = "ParaView.SurfaceInParts2"  # what only several processes do
OTHERS = {  # tests in Python, by a part of the name of the file
    "3MF": "Python.3MFWriter",
    "Distributed": "ParaView.DistributedSurface",
    "GLTF": "Python.StyleGLTFWriter",
    "Zip": "Python.3MFWriter",
}
TESTS_AT_ONCE = 12
SLOW = 20.0  # seconds of a test that is left out, unless it has the name of the file or is of its folder
LIMIT = 300  # seconds of a processor, of a test that was changed into an endless loop
MEMORY = 8 << 30  # bytes, of one that allocates without end


def without_text(source):
    """The source with blanks for comments, strings, and lines of the preprocessor."""
    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^#[^\n]*|\bstatic_assert\([^;]*;'
    return re.sub(
        pattern, lambda m: re.sub(r"[^\n]", " ", m.group()), source, flags=re.DOTALL | re.MULTILINE
    )


def end_of_parenthesis(code, begin):
    depth = 1
    for at in range(begin, len(code)):
        depth += {"(": 1, ")": -1}.get(code[at], 0)
        if depth == 0:
            return at
    raise ValueError("a parenthesis is not closed")


def changed_constant(text):
    if "." not in text:
        return str(int(text) + 1)
    return repr(1.5 * float(text)) if float(text) else "1.0"


def changes_of(path):
    """All (begin, end, replacement, kind) of a file."""
    code = without_text(path.read_text(encoding="utf-8"))
    for m in OPERATOR.finditer(code):
        if m.group() in SWAPS:
            yield m.start(), m.end(), SWAPS[m.group()], "operator"
    for m in WORD.finditer(code):
        yield m.start(), m.end(), SWAPS[m.group()], "operator"
    for m in CONSTANT.finditer(code):
        yield m.start(), m.end(), changed_constant(m.group()), "constant"
    for m in CONDITION.finditer(code):
        yield m.end(), end_of_parenthesis(code, m.end()), "false", "condition"


def folder_of(path):
    folder = path.parent.relative_to(ROOT / "Filters").as_posix()
    return "Filters" if folder == "." else folder


def limit():
    """Of a process and each that it starts; the limit of ctest would not change that of a test."""
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.RLIM_INFINITY))


def is_long(test):
    """Whether a test of ctest's list has the label Long: its code is run by others, too."""
    return any(p["name"] == "LABELS" and "Long" in p["value"] for p in test["properties"])


class Tests:
    """The tests of a build but for those of the label Long, the quickest ones first."""

    def __init__(self, build):
        self.Build = build
        listed = subprocess.run(
            ["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True
        )
        kept = [t for t in json.loads(listed.stdout)["tests"] if t["name"] == SPREAD or not is_long(t)]
        self.Costs = {t["name"]: 0.0 for t in kept}
        while failed := self.first_failure(self.tried()):
            if failed not in self.Costs:
                sys.exit("ctest fails and names no test")
            print(f"without a change {failed} fails here: it is left out", flush=True)
            del self.Costs[failed]
        known = build / "Testing" / "Temporary" / "CTestCostData.txt"  # of these runs
        for line in known.read_text(encoding="utf-8").splitlines():
            name, *numbers = line.split()
            if len(numbers) == 2 and name in self.Costs:
                self.Costs[name] = float(numbers[1])

    def tried(self):
        """All that may be used for some file."""
        more = (SPREAD, *OTHERS.values())
        return [name for name in self.Costs if name.startswith(GROUPS) or name in more]

    def batches_for(self, path):
        own = f"Test{path.stem.removeprefix('vtk')}"
        other = next((test for word, test in OTHERS.items() if word in path.stem), None)
        beside = {test.stem for test in (ROOT / "Testing" / folder_of(path)).glob("Test*.cxx")}
        first = folder_of(path).split("/")[0]
        groups = [first, "Cxx"] if first in ("Solver", "Geometry") else ["Cxx"]
        left = sorted(self.Costs, key=self.Costs.get)
        for chosen in (
            lambda group, test: test.startswith(own) or f"{group}.{test}" == other,
            lambda group, test: test in beside,
            *(lambda group, test, g=g: group == g and self.Costs[f"{g}.{test}"] <= SLOW for g in groups),
            lambda group, test: f"{group}.{test}" == SPREAD,
        ):
            batch = [name for name in left if chosen(*name.split(".", 1))]
            left = [name for name in left if name not in batch]
            for k in range(0, len(batch), TESTS_AT_ONCE):
                yield batch[k : k + TESTS_AT_ONCE]

    def first_failure(self, names):
        if not names:
            return None
        pattern = "^(" + "|".join(re.escape(name) for name in names) + ")$"
        run = subprocess.run(
            ["ctest", "--test-dir", self.Build, "-R", pattern, "--stop-on-failure", "-j2"],
            check=False,
            capture_output=True,
            text=True,
            preexec_fn=limit,
        )
        failed = re.search(r"^\s*\d+ - (\S+) \(([^)]*)\)", run.stdout, re.MULTILINE)
        if run.returncode == 0:
            return None
        return failed.group(1) if failed else "ctest"


def build_passes(build):
    command = ["cmake", "--build", build, "-j2"]
    return subprocess.run(command, check=False, capture_output=True).returncode == 0


def verdict_of(path, change, build, tests):
    source = path.read_text(encoding="utf-8")
    begin, end, replacement, _ = change
    path.write_text(source[:begin] + replacement + source[end:], encoding="utf-8")
    try:
        if not build_passes(build):
            return "not compiled", None
        for batch in tests.batches_for(path):
            failed = tests.first_failure(batch)
            if failed:
                return "caught", failed
        return "survived", None
    finally:
        path.write_text(source, encoding="utf-8")


def table_of(results):
    counts = collections.defaultdict(collections.Counter)
    for result in results:
        counts[result["folder"]][result["verdict"]] += 1
        counts["all"][result["verdict"]] += 1
    lines = ["| folder | changes | caught | % |", "|---|---|---|---|"]
    for folder in sorted(counts):
        caught = counts[folder]["caught"]
        tried = caught + counts[folder]["survived"]
        if tried:
            lines.append(f"| {folder} | {tried} | {caught} | {100.0 * caught / tried:.0f} |")
    lines += [
        f"survived: {r['file']}:{r['line']}: {r['before']} -> {r['after']}: {r['text']}"
        for r in results
        if r["verdict"] == "survived"
    ]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("build", type=Path, help="build folder")
    parser.add_argument("--count", type=int, default=200, help="changes to try (default: 200)")
    parser.add_argument("--seed", type=int, default=1, help="of the choice (default: 1)")
    parser.add_argument("--folder", default="Filters", help="sources to change (default: Filters)")
    parser.add_argument("--results", type=Path, help="file (default: BUILD/mutations.jsonl)")
    parser.add_argument("--seconds", type=float, help="begin no other change after this time")
    args = parser.parse_args()
    build = args.build.resolve()
    journal = args.results or build / "mutations.jsonl"
    results = []
    if journal.exists():
        results = [json.loads(line) for line in journal.read_text(encoding="utf-8").splitlines()]
    verdicts = {(r["file"], r["begin"], r["after"]): r["verdict"] for r in results}

    changes = [
        (path, change)
        for path in sorted((ROOT / args.folder).rglob("*.cxx"))
        for change in changes_of(path)
    ]
    random.Random(args.seed).shuffle(changes)
    if not build_passes(build):
        sys.exit("the build fails without a change")
    tests = Tests(build)
    begin = time.monotonic()
    tried = 0
    for path, change in changes:
        if tried >= args.count or (args.seconds and time.monotonic() - begin > args.seconds):
            break
        name = path.relative_to(ROOT).as_posix()
        known = verdicts.get((name, change[0], change[2]))
        if known:
            tried += known != "not compiled"
            continue
        source = path.read_text(encoding="utf-8")
        line = source.count("\n", 0, change[0])
        verdict, failed = verdict_of(path, change, build, tests)
        result = {
            "file": name,
            "folder": folder_of(path),
            "line": line + 1,
            "begin": change[0],
            "kind": change[3],
            "before": source[change[0] : change[1]],
            "after": change[2],
            "text": source.splitlines()[line].strip(),
            "verdict": verdict,
            "test": failed,
        }
        results.append(result)
        with journal.open("a", encoding="utf-8") as out:
            out.write(json.dumps(result) + "\n")
        tried += verdict != "not compiled"
        print(
            f"{tried:4} {verdict:12} {name}:{line + 1}: {result['before']} -> {change[2]} {failed or ''}",
            flush=True,
        )
    build_passes(build)
    print(table_of(results))


if __name__ == "__main__":
    main()
