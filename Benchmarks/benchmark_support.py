# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts that compare have in common: meshes, runs of programs, medians, exponents, tables."""
import json
import math
import os
import platform
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
PROGRAMS = os.path.join(HERE, "..", "build", "Benchmarks")
SIZES = [35000, 99000, 237000, 949000]
FAMILIES = ["even", "slivers"]


def add_options(parser, families):
    """The options that all comparisons have. families: those measured by default."""
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, metavar="N", help="points")
    parser.add_argument("--families", nargs="+", choices=FAMILIES, default=families)
    parser.add_argument("--repetitions", type=int, default=3, metavar="N", help="runs of each kind, in turn")
    parser.add_argument("--programs", default=PROGRAMS, metavar="DIR", help="default: build/Benchmarks")
    parser.add_argument("--output", default="comparison", metavar="DIR")


def environment(threads):
    """Every library that has threads of its own gets as many as we do."""
    return {**os.environ, **{name: str(threads) for name in (
        "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "VTK_SMP_MAX_THREADS")}}


def run(command, threads, timeout=3600.0):
    """The JSON object that a program prints; {"error": why} where it fails."""
    try:
        done = subprocess.run(command, env=environment(threads), capture_output=True, text=True,
                              timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        return {"error": f"took more than {timeout:g} s"}
    except FileNotFoundError:
        sys.exit(f"{command[0]}: no such program; build with -DSPHERICALSTYLE_BUILD_BENCHMARKS=ON, see README.md")
    if done.returncode != 0:
        told = done.stderr.strip().splitlines()
        return {"error": told[0] if told else f"ended with {done.returncode}"}
    return json.loads(done.stdout)


def medians(records):
    """One record from several of the same kind: the median of each number, else the first value."""
    failed = [r for r in records if "error" in r]
    if failed:
        return failed[0]
    result = dict(records[0])
    for name, value in result.items():
        if isinstance(value, (int, float)):
            result[name] = statistics.median(r[name] for r in records)
    return result


def exponent(sizes, values):
    """p of values ~ sizes^p, least squares in logarithms; NaN from fewer than two sizes, or where a value is 0."""
    if len(set(sizes)) < 2 or min(values) <= 0.0:
        return math.nan
    x = [math.log(s) for s in sizes]
    y = [math.log(v) for v in values]
    mean_x, mean_y = statistics.fmean(x), statistics.fmean(y)
    return (sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y))
            / sum((a - mean_x) ** 2 for a in x))


def make_meshes(options):
    """(family, number of points, file) for each mesh, small ones first; the file is there until the next one."""
    program = os.path.join(options.programs, "MakeMesh")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "body.mesh")
        for size in sorted(options.sizes):
            for family in options.families:
                facts = run([program, family, str(size), path], 1)
                if "error" in facts:
                    sys.exit(f"no mesh {family} {size}: {facts['error']}")
                yield family, int(facts["points"]), path


def summarize(results):
    """{(family, points, method): medians}, in the order measured."""
    groups = {}
    for record in results:
        groups.setdefault((record["family"], record["points"], record["method"]), []).append(record)
    return {key: medians(records) for key, records in groups.items()}


def busy(results):
    """What share of its time a run on one thread had a processor, at the median, where it had to wait; else ''."""
    shares = [r["processor_seconds"] / r["total_seconds"] for r in results if "error" not in r]
    if not shares or statistics.median(shares) > 0.95:
        return ""
    return (f"**The machine was busy with something else: runs had a processor for "
            f"{100 * statistics.median(shares):.0f} % of their time. Ratios hold roughly, seconds do not.**\n")


def write_text(options, name, text):
    os.makedirs(options.output, exist_ok=True)
    with open(os.path.join(options.output, name), "w", encoding="utf-8") as file:
        file.write(text)


def significant(x, digits=3):
    """A number for a table; a dash where there is none."""
    if x is None or (isinstance(x, float) and math.isnan(x)):
        return "-"
    if x == 0:
        return "0"
    if abs(x) >= 10 ** (digits - 1):
        return f"{x:.0f}"
    return f"{x:.{digits}g}" if abs(x) >= 1e-3 else f"{x:.1e}"


def markdown(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def machine():
    """In words what it ran on."""
    model = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as info:
            model = next(line.split(":", 1)[1].strip() for line in info
                         if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{model}, {os.cpu_count()} cores"
