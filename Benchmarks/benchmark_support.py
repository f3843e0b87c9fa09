# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts that compare have in common: runs of programs, medians, exponents, tables."""
import json
import math
import os
import platform
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
PROGRAMS = os.path.join(HERE, "..", "build", "Benchmarks")


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
    """p of values ~ sizes^p, least squares in logarithms; NaN from fewer than two sizes."""
    x = [math.log(s) for s in sizes]
    y = [math.log(v) for v in values]
    if len(set(sizes)) < 2:
        return math.nan
    mean_x, mean_y = statistics.fmean(x), statistics.fmean(y)
    return (sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y))
            / sum((a - mean_x) ** 2 for a in x))


def gaps(record, lowest):
    """(E_k - E*) / (E_0 - E*) after the start and each iteration, E* = lowest."""
    return [(e - lowest) / (record["rest_energy"] - lowest) for e in record["energies"]]


def iterations_to(gap, all_gaps):
    """Number of the first iteration with at most that gap; None if there is none."""
    return next((k for k, g in enumerate(all_gaps) if g <= gap), None)


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


def machine(threads):
    """One line on what it ran on."""
    model = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as info:
            model = next(line.split(":", 1)[1].strip() for line in info
                         if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{model}, {os.cpu_count()} cores, {threads} thread(s) used"
