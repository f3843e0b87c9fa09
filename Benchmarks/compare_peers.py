# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""This project's filter beside CGAL and Open3D: time and memory on the same meshes.

usage: /usr/bin/python3 compare_peers.py [--sizes N ...] [--families even slivers] [--methods ...] [--output DIR] ...

Every run is a process of its own with one thread; the methods take turns on each mesh, as often as asked for.
Writes comparison.md (medians, ratios, growth), comparison.csv (every run) and comparison.png. README.md here says
what is measured.
"""
import argparse
import csv
import math
import os
import sys

import matplotlib
matplotlib.use("Agg")
from matplotlib import pyplot

import benchmark_support as support

ITERATIONS = "30"  # of the peers, whose own test of convergence is off
UPDATES = "9"  # of the center, then of Roundness
# Name in files and options: label, program, its arguments.
METHODS = {
    "closed-form": ("ours", "RoundMesh", ["--updates", UPDATES]),
    "energy": ("ours, energy of the thesis", "RoundMesh", ["--method", "energy"]),
    "energy-30": ("ours, 30 plain iterations of it", "RoundMesh",
                  ["--method", "energy", "--iterations", ITERATIONS]),
    "cgal": ("CGAL", "CgalDeformation", ["--solver", "cgal", "--iterations", ITERATIONS]),
    "cgal-cholmod": ("CGAL with CHOLMOD", "CgalDeformation", ["--solver", "cholmod", "--iterations", ITERATIONS]),
    "open3d": ("Open3D", "Open3DDeformation", ["--iterations", ITERATIONS]),
}
PEERS = ["cgal", "cgal-cholmod", "open3d"]


def parse(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    support.add_options(parser, families=["even"])
    parser.add_argument("--methods", nargs="+", choices=list(METHODS), default=list(METHODS))
    parser.add_argument("--once-above", type=float, default=10.0, metavar="SECONDS",
                        help="a method that took longer on a mesh is not repeated there")
    parser.add_argument("--timeout", type=float, default=3600.0, metavar="SECONDS", help="for one run")
    return parser.parse_args(arguments)


def command(options, method, mesh):
    _, program, arguments = METHODS[method]
    return [os.path.join(options.programs, program), mesh, *arguments]


def measure_mesh(options, family, points, mesh):
    """The runs on one mesh, in turn."""
    runs = []
    slow = set()
    for repetition in range(options.repetitions):
        for method in options.methods:
            if method in slow:
                continue
            record = support.run(command(options, method, mesh), 1, options.timeout)
            runs.append({**record, "family": family, "points": points, "method": method, "repetition": repetition})
            seconds = record.get("total_seconds", math.inf)  # what fails will fail again
            if seconds > options.once_above:
                slow.add(method)
            told = record.get("error", f"{seconds:.3g} s")
            print(f"{family} {points} {method}: {told}", file=sys.stderr, flush=True)
    return runs


def measure(options):
    for method in list(options.methods):
        if not os.path.exists(os.path.join(options.programs, METHODS[method][1])):
            print(f"{METHODS[method][1]} was not built: left out", file=sys.stderr)
            options.methods.remove(method)
    results = []
    for family, points, mesh in support.make_meshes(options):
        results += measure_mesh(options, family, points, mesh)
        write(options, results)  # so that a long comparison can be looked at, or ended, early
    return results


def ratio(of, to):
    """How many times as long the peer takes."""
    if of is None or "error" in of or "error" in to:
        return None
    return of["total_seconds"] / to["total_seconds"]


def meshes_of(summary):
    return list(dict.fromkeys((family, points) for family, points, _ in summary))


def overview(summary):
    """Seconds of everything, one row a mesh."""
    columns = [(METHODS[method][0], method, "total_seconds") for method in dict.fromkeys(m for _, _, m in summary)]
    if columns and columns[0][1] == "closed-form":
        columns[0] = ("ours: first result", *columns[0][1:])
        columns[1:1] = [("moved center", "closed-form", "center_seconds"),
                        ("another `Roundness`", "closed-form", "roundness_seconds")]
    rows = [[family, f"{points:,}", *(support.significant(summary.get((family, points, method), {}).get(name))
                                      for _, method, name in columns)] for family, points in meshes_of(summary)]
    return support.markdown(["mesh", "points", *(heading for heading, _, _ in columns)], rows)


def table(summary, family, points):
    rows = []
    cell = support.significant
    for (a_family, a_points, method), r in summary.items():
        if (a_family, a_points) != (family, points):
            continue
        if "error" in r:
            rows.append([METHODS[method][0], "fails: " + r["error"]] + [""] * 8)
            continue
        iterating = r["iterations"] > 0
        rows.append([
            METHODS[method][0], cell(r["setup_seconds"]),
            cell(1e3 * r["seconds_per_iteration"]) if iterating else "-",
            cell(r["iterations"]) if iterating else "-", cell(r["total_seconds"]), cell(r["processor_seconds"]),
            *(cell(ratio(summary.get((family, points, peer)), r)) for peer in PEERS),
            cell(r["peak_megabytes"])])
    return support.markdown(
        ["method", "set-up s", "ms an iteration", "iterations", "total s", "processor s",
         *(f"{METHODS[peer][0]} takes" for peer in PEERS), "peak MB"], rows)


def growth(summary):
    """[family, label, exponent of time, exponent of memory] over the sizes measured."""
    series = {}
    for (family, points, method), r in summary.items():
        if "error" not in r:
            series.setdefault((family, method), []).append((points, r))
    rows = []
    for (family, method), measured in series.items():
        sizes = [points for points, _ in measured]
        rows.append([family, METHODS[method][0],
                     support.exponent(sizes, [r["total_seconds"] for _, r in measured]),
                     support.exponent(sizes, [r["peak_megabytes"] - r["start_megabytes"] for _, r in measured])])
    return rows


def report(options, results):
    summary = support.summarize(results)
    text = ["# Comparison with peers\n",
            f"{support.machine()}, one thread; seconds, medians of {options.repetitions} run(s) of each method, in "
            f"turn; of one where it takes over {options.once_above:g} s. Peers: {ITERATIONS} iterations, test of "
            "convergence off.\n",
            support.busy(results), overview(summary)]
    for family, points in meshes_of(summary):
        text.append(f"## {family}, {points:,} points\n")
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
    quantities = [("seconds in all", "total_seconds"), ("peak memory, MB", "peak_megabytes")]
    for row, family in enumerate(families):
        for column, (title, name) in enumerate(quantities):
            axis = axes[row][column]
            for index, (method, (label, _, _)) in enumerate(METHODS.items()):
                points = [(p, r[name]) for (f, p, m), r in summary.items()
                          if (f, m) == (family, method) and "error" not in r]
                if points:
                    axis.loglog(*zip(*points), "s--" if method in PEERS else "o-",
                                color=f"C{index}", label=label)
            axis.grid(True, which="both", alpha=0.3)
            axis.set_title(f"{family}: {title}")
            if row + 1 == len(families):
                axis.set_xlabel("points")
    figure.legend(*axes[0][0].get_legend_handles_labels(), loc="lower center", ncol=3, fontsize=9)
    figure.tight_layout(rect=(0, 0.6 / figure.get_figheight(), 1, 1))
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def write(options, results):
    text = report(options, results)
    support.write_text(options, "comparison.md", text)
    fields = list(dict.fromkeys(name for r in results for name in r))
    with open(os.path.join(options.output, "comparison.csv"), "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, fields)
        writer.writeheader()
        writer.writerows(results)
    plot(support.summarize(results), os.path.join(options.output, "comparison.png"))
    return text


if __name__ == "__main__":
    chosen = parse()
    print(write(chosen, measure(chosen)))
