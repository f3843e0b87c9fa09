# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""This project's filter beside CGAL and Open3D: time and memory on the same meshes.

usage: /usr/bin/python3 compare_peers.py [--sizes N ...] [--models DIR] [--repetitions N] [--output DIR] ...

Every run is a process of its own; the methods take turns on each mesh, as often as asked for.
Writes comparison.md (medians, ratios, growth), comparison.csv (every run), comparison.json and
comparison.png. README.md here says what is measured.
"""
import argparse
import csv
import json
import math
import os
import statistics
import sys
import tempfile

import matplotlib
matplotlib.use("Agg")
from matplotlib import pyplot

import benchmark_support as support

ITERATIONS = "30"  # of the peers, whose own test of convergence is off
SIZES = [35000, 99000, 237000, 949000]
FAMILIES = ["even", "slivers"]
# Real models for the same two families, each subdivided to come near the sizes.
MODELS = {"even": "armadillo.ply", "slivers": "koala.ply"}

# The energy of the thesis: the pull toward one ball, of the model as it is. All else of ours has a closed form.
ENERGY = ["--weighting", "uniform", "--roundness", "0.5", "--normal-blend", "0", "--detail-size", "0"]
# Name in files and options: label, program, its arguments.
METHODS = {
    "default": ("ours, default", "RoundMesh", []),
    "details": ("ours, DetailSize 0.03", "RoundMesh", ["--detail-size", "0.03"]),
    "uniform": ("ours, uniform weights", "RoundMesh", ENERGY),
    "uniform-30": ("ours, uniform weights, 30 plain iterations", "RoundMesh",
                   [*ENERGY, "--iterations", ITERATIONS, "--acceleration", "0"]),
    "cgal": ("CGAL", "CgalDeformation", ["--solver", "cgal", "--iterations", ITERATIONS]),
    "cgal-ldlt": ("CGAL with Eigen's LDLT", "CgalDeformation",
                  ["--solver", "ldlt", "--iterations", ITERATIONS]),
    "cgal-cholmod": ("CGAL with CHOLMOD", "CgalDeformation",
                     ["--solver", "cholmod", "--iterations", ITERATIONS]),
    "open3d": ("Open3D", "Open3DDeformation", ["--iterations", ITERATIONS]),
}
PEERS = ["cgal", "cgal-ldlt", "cgal-cholmod", "open3d"]
# Configurations of ours that iterate to a tolerance: their gap is measured against a long run.
ITERATING = ["uniform"]
REFERENCE_TOLERANCE = "1e-9"


def parse(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES)
    parser.add_argument("--families", nargs="+", choices=FAMILIES, default=FAMILIES)
    parser.add_argument("--methods", nargs="+", choices=list(METHODS),
                        default=[method for method in METHODS if method != "cgal-ldlt"])
    parser.add_argument("--models", metavar="DIR", help="subdivide " + " and ".join(MODELS.values())
                        + " of this folder instead of generating")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--once-above", type=float, default=60.0, metavar="SECONDS",
                        help="a method that took longer on a mesh is not repeated there")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--timeout", type=float, default=3600.0, help="seconds for one run")
    parser.add_argument("--no-reference", action="store_true",
                        help="do not measure gaps: saves a long run on each mesh")
    parser.add_argument("--programs", default=support.PROGRAMS, help="default: build/Benchmarks")
    parser.add_argument("--output", default="comparison")
    return parser.parse_args(arguments)


def read_number_of_points(model):
    with open(model, "rb") as file:
        for line in file:
            if line.startswith(b"element vertex"):
                return int(line.split()[2])
    raise SystemExit(f"{model} has no points")


def subdivisions(points, size):
    """How often faces are to be cut into four to come nearest to the size."""
    return max(0, round(math.log(size / points, 4)))


def make_meshes(options, folder):
    """(family, file, facts) for each mesh, small ones first, none twice."""
    make = os.path.join(options.programs, "MakeMesh")
    made = {}
    for size in sorted(options.sizes):
        for family in options.families:
            source, number = family, size
            if options.models:
                source = os.path.join(options.models, MODELS[family])
                number = subdivisions(read_number_of_points(source), size)
            if (family, number) in made:
                continue
            path = os.path.join(folder, f"{family}-{number}.mesh")
            facts = support.run([make, source, str(number), path], 1)
            if "error" in facts:
                raise SystemExit(f"no mesh {family} {number}: {facts['error']}")
            made[family, number] = (family, path, facts)
    return list(made.values())


def command(options, method, mesh, extra=()):
    _, program, arguments = METHODS[method]
    threads = ["--threads", str(options.threads)] if program == "RoundMesh" else []
    return [os.path.join(options.programs, program), mesh, *arguments, *threads, *extra]


def measure_mesh(options, family, mesh, facts):
    """The runs on one mesh, in turn."""
    runs = []
    slow = set()
    for repetition in range(options.repetitions):
        for method in options.methods:
            if method in slow:
                continue
            record = support.run(command(options, method, mesh), options.threads, options.timeout)
            runs.append({"family": family, "points": facts["points"], "method": method,
                         "repetition": repetition, **record})
            seconds = record.get("total_seconds", math.inf)  # what fails will fail again
            if seconds > options.once_above:
                slow.add(method)
            told = record.get("error", f"{seconds:.3g} s")
            print(f"{family} {facts['points']:.0f} {method}: {told}", file=sys.stderr, flush=True)
    return runs


def measure_gaps(options, mesh, runs):
    """Adds the gap at the end and the iterations to 1e-4 to the runs that iterate."""
    for method in set(options.methods).intersection(ITERATING):
        reference = support.run(command(options, method, mesh, ["--tolerance", REFERENCE_TOLERANCE]),
                                options.threads, options.timeout)
        for record in runs:
            if record["method"] == method and "energies" in record and "energies" in reference:
                lowest = min(reference["energies"] + record["energies"])
                gaps = support.gaps(record, lowest)
                record["gap"] = gaps[-1]
                # A run that stopped above the gap would have gone on as the long one did.
                further = gaps + support.gaps(reference, lowest)[len(gaps):]
                record["iterations_to_1e-4"] = support.iterations_to(1e-4, further)


def measure(options):
    for method in list(options.methods):
        if not os.path.exists(os.path.join(options.programs, METHODS[method][1])):
            print(f"{METHODS[method][1]} was not built: left out", file=sys.stderr)
            options.methods.remove(method)
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for family, mesh, facts in make_meshes(options, folder):
            runs = measure_mesh(options, family, mesh, facts)
            if not options.no_reference:
                measure_gaps(options, mesh, runs)
            results += runs
            write(options, results)  # so that a long comparison can be looked at, or ended, early
            os.remove(mesh)
    return results


def summarize(results):
    """{(family, points, method): medians}, in the order measured."""
    groups = {}
    for record in results:
        key = (record["family"], int(record["points"]), record["method"])
        groups.setdefault(key, []).append(record)
    return {key: support.medians(records) for key, records in groups.items()}


def ratio(of, to):
    """How many times as long the peer takes."""
    if of is None or "error" in of or "error" in to:
        return None
    return of["total_seconds"] / to["total_seconds"]


def table(summary, family, points):
    rows = []
    cell = support.significant
    for (a_family, a_points, method), r in summary.items():
        if (a_family, a_points) != (family, points):
            continue
        if "error" in r:
            rows.append([METHODS[method][0], "fails: " + r["error"]] + [""] * 11)
            continue
        iterating = r["iterations"] > 0
        rows.append([
            METHODS[method][0], cell(r["setup_seconds"]),
            cell(1e3 * r["seconds_per_iteration"]) if iterating else "-",
            cell(r["iterations"]), cell(r["total_seconds"]), cell(r["processor_seconds"]),
            *(cell(ratio(summary.get((family, points, peer)), r))
              for peer in ("cgal", "cgal-cholmod", "open3d")),
            cell(r["peak_megabytes"]), cell(r.get("gap")), cell(r.get("iterations_to_1e-4"))])
    return support.markdown(
        ["method", "set-up s", "ms an iteration", "iterations", "total s", "processor s", "CGAL takes",
         "CGAL with CHOLMOD takes", "Open3D takes", "peak MB", "gap", "to 1e-4"], rows)


def own_memory(r):
    """Without what the process has before it does anything, MB."""
    return r["peak_megabytes"] - r["start_megabytes"]


def growth(summary):
    """[family, method, exponent of time, exponent of memory] over the sizes measured."""
    series = {}
    for (family, points, method), r in summary.items():
        if "error" not in r:
            series.setdefault((family, method), []).append((points, r))
    rows = []
    for (family, method), measured in series.items():
        sizes = [points for points, _ in measured]
        rows.append([family, METHODS[method][0],
                     support.exponent(sizes, [r["total_seconds"] for _, r in measured]),
                     support.exponent(sizes, [own_memory(r) for _, r in measured])])
    return rows


def overview(summary):
    """Seconds and peak MB of every method, one row a mesh."""
    methods = list(dict.fromkeys(method for _, _, method in summary))
    rows = []
    for family, points in dict.fromkeys((f, p) for f, p, _ in summary):
        records = [summary.get((family, points, method), {"error": ""}) for method in methods]
        rows.append([f"{family}, {points}", *(
            "-" if "error" in r else support.significant(r["total_seconds"]) + " s, "
            + support.significant(r["peak_megabytes"]) + " MB" for r in records)])
    return support.markdown(["mesh, points", *(METHODS[method][0] for method in methods)], rows)


def busy(options, results):
    """What share of its time a run had a processor, at the median; says so where it had to wait."""
    shares = [r["processor_seconds"] / r["total_seconds"] for r in results if "error" not in r]
    if options.threads > 1 or not shares or statistics.median(shares) > 0.95:
        return ""
    return (f"**The machine was busy with something else: runs had a processor for "
            f"{100 * statistics.median(shares):.0f} % of their time. Ratios hold roughly, seconds do not.**\n")


def report(options, results):
    summary = summarize(results)
    text = ["# Comparison with peers\n",
            f"{support.machine(options.threads)}; medians of {options.repetitions} run(s) of each "
            f"method, in turn; of one where it takes over {options.once_above:g} s. Peers: "
            f"{ITERATIONS} iterations, test of convergence off.\n",
            busy(options, results), overview(summary)]
    for family, points in dict.fromkeys((f, p) for f, p, _ in summary):
        text.append(f"## {family}, {points} points\n")
        text.append(table(summary, family, points))
    text.append("## Growth: exponent of the number of points\n")
    text.append(support.markdown(["family", "method", "total time", "memory"], [
        [family, label, support.significant(time), support.significant(memory)]
        for family, label, time, memory in growth(summary)]))
    return "\n".join(text)


def plot(summary, path):
    families = list(dict.fromkeys(family for family, _, _ in summary))
    figure, axes = pyplot.subplots(len(families), 2, figsize=(11, 0.8 + 4.2 * len(families)),
                                   squeeze=False, sharex=True, sharey="col")
    quantities = [("total s", lambda r: r["total_seconds"]),
                  ("peak MB", lambda r: r["peak_megabytes"])]
    for row, family in enumerate(families):
        for column, (title, value) in enumerate(quantities):
            axis = axes[row][column]
            for index, (method, (label, _, _)) in enumerate(METHODS.items()):
                points = [(p, value(r)) for (f, p, m), r in summary.items()
                          if (f, m) == (family, method) and "error" not in r]
                if points:
                    axis.loglog(*zip(*points), "s--" if method in PEERS else "o-",
                                color=f"C{index}", label=label)
            axis.grid(True, which="both", alpha=0.3)
            axis.set_title(f"{family}: {title}")
            if row + 1 == len(families):
                axis.set_xlabel("points")
    figure.legend(*axes[0][0].get_legend_handles_labels(), loc="lower center", ncol=4, fontsize=9)
    figure.tight_layout(rect=(0, 0.5 / figure.get_figheight(), 1, 1))
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def write(options, results):
    os.makedirs(options.output, exist_ok=True)
    inside = lambda name: os.path.join(options.output, name)
    with open(inside("comparison.json"), "w", encoding="utf-8") as file:
        json.dump(results, file, indent=1)
    fields = list(dict.fromkeys(name for r in results for name in r if name != "energies"))
    with open(inside("comparison.csv"), "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, fields, extrasaction="ignore")
        writer.writeheader()
        writer.writerows(results)
    summary = summarize(results)
    text = report(options, results)
    with open(inside("comparison.md"), "w", encoding="utf-8") as file:
        file.write(text)
    plot(summary, inside("comparison.png"))
    return text


if __name__ == "__main__":
    chosen = parse()
    print(write(chosen, measure(chosen)))
