# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The project's goals of speed and memory, line by line, beside what is measured.

usage: /usr/bin/python3 report_goals.py [--comparison DIR] [--stage-size N] [--output DIR] ...

Takes the comparison of compare_peers.py from DIR, or runs it with the same options where DIR has
none; drags the centre and Roundness; runs every stage with one thread and with two. Writes goals.md
and goals.json.
"""
import argparse
import json
import math
import os
import sys
import tempfile

import benchmark_support as support
import compare_peers

SIZES = compare_peers.SIZES
# Seconds, ratios and updates a second at SIZES.
FIRST_RESULT = {"even": [0.1, 0.3, 0.6, 2.5], "slivers": [0.3, 1.0, 2.5, 10.0]}
WHOLE_RUN = [20, 30, 30, 40]
DRAGGING = [60, 20, 8, 2]
ITERATION = {"cgal-cholmod": [15, 20, 25, 30], "open3d": [30, 35, 40, 50]}
SET_UP = [3, 6, 5, 10]
KILOBYTES_PER_POINT = {"default": 0.5, "uniform-30": 1.0}  # without and with a factor
ITERATIONS = {"even": 5, "slivers": 25}  # to a gap of 1e-4
EXPONENTS = [1.05, 1.0]  # total time, memory
SPEED_UP = 1.6
GAP = 1e-4
DRAGGING_GAP = 1e-3

# Stages that threads of ours can share; the others are reported all the same.
STAGES = ["Topology", "Cotangents", "Weights", "Splat", "Walls", "Base", "Limbs", "Carry", "Targets", "PrepareSteps", "Matrix", "Ordering",
          "Factorization", "Covariances", "Rotations", "LocalStep", "RightHandSide", "Solve",
          "SolveSingle", "Energy", "Iteration", "Solver:default", "Solver:details", "Solver:uniform"]


def verdict(measured, goal, larger_is_better=False):
    """'0.4 of 0.1: missed'; a dash where nothing was measured."""
    if measured is None or math.isnan(measured):
        return "-"
    reached = measured >= goal if larger_is_better else measured <= goal
    return f"{support.significant(measured)} of {goal:g}: {'reached' if reached else 'missed'}"


def at_sizes(summary, family, method):
    """The medians at each of SIZES: of the number of points nearest to it, within a half."""
    result = []
    for size in SIZES:
        near = {abs(math.log(points / size)): r for (f, points, m), r in summary.items()
                if (f, m) == (family, method) and abs(math.log(points / size)) < math.log(1.5)}
        result.append(near[min(near)] if near else None)
    return result


def usable(*records):
    return all(r is not None and "error" not in r for r in records)


def row(line, values, goals, larger_is_better=False):
    return [line, *(verdict(v, g, larger_is_better) for v, g in zip(values, goals))]


def quotient(name, of, to):
    """of[name] / to[name] at each size, None where one of them is missing."""
    return [a[name] / b[name] if usable(a, b) else None for a, b in zip(of, to)]


def first_results(summary):
    rows = []
    for family, goals in FIRST_RESULT.items():
        for method in ("default", "details", "uniform"):
            records = at_sizes(summary, family, method)
            label = compare_peers.METHODS[method][0]
            rows.append(row(f"first result, {family}: {label}, s",
                            [r["total_seconds"] if usable(r) else None for r in records], goals))
            if method in compare_peers.ITERATING:
                rows.append(row(f"its gap, {family}: {label}",
                                [r.get("gap") if usable(r) else None for r in records],
                                [GAP] * len(SIZES)))
    return rows


def against_peers(summary):
    rows = []
    for family in compare_peers.FAMILIES:
        of = lambda method, family=family: at_sizes(summary, family, method)
        for method in ("details", "uniform"):
            for peer in ("cgal", "cgal-cholmod"):
                label = compare_peers.METHODS[method][0]
                rows.append(row(f"whole run, {family}: {compare_peers.METHODS[peer][0]} / {label}",
                                quotient("total_seconds", of(peer), of(method)), WHOLE_RUN, True))
        for peer, goals in ITERATION.items():
            rows.append(row(f"an iteration, {family}: {compare_peers.METHODS[peer][0]} / ours",
                            quotient("seconds_per_iteration", of(peer), of("uniform-30")), goals,
                            True))
        for peer in ("cgal", "cgal-cholmod"):
            rows.append(row(f"set-up, {family}: {compare_peers.METHODS[peer][0]} / ours",
                            quotient("setup_seconds", of(peer), of("uniform-30")), SET_UP, True))
    return rows


def memory_and_iterations(summary):
    rows = []
    for method, goal in KILOBYTES_PER_POINT.items():
        records = at_sizes(summary, "even", method)
        rows.append(row(f"peak memory, KB a point: {compare_peers.METHODS[method][0]}",
                        [1024 * compare_peers.own_memory(r) / r["points"] if usable(r) else None
                         for r in records], [goal] * len(SIZES)))
    for family, goal in ITERATIONS.items():
        for method in compare_peers.ITERATING:
            records = at_sizes(summary, family, method)
            # A run that ends above the gap never reaches it.
            rows.append(row(f"iterations to 1e-4, {family}: {compare_peers.METHODS[method][0]}",
                            [(math.inf if r.get("iterations_to_1e-4") is None
                              else r["iterations_to_1e-4"]) if usable(r) and "gap" in r else None
                             for r in records], [goal] * len(SIZES)))
    return rows


def growth_table(summary):
    large = {key: r for key, r in summary.items()
             if key[1] > 30000 and key[2] not in compare_peers.PEERS}
    return support.markdown(
        ["family", "method", "total time", "memory"],
        [[family, label, *(verdict(round(value, 2), goal) for value, goal in zip(values, EXPONENTS))]
         for family, label, *values in compare_peers.growth(large)])


# -------------------------------------------------------------------------------------- dragging
def drag(options):
    """{points: {variant: record}} on the even family."""
    variants = {name: compare_peers.METHODS[name][2] for name in ("default", "details")}
    program = os.path.join(options.programs, "Dragging")
    result = {}
    with tempfile.TemporaryDirectory() as folder:
        generated = argparse.Namespace(**{**vars(options), "families": ["even"]})
        for _, mesh, facts in compare_peers.make_meshes(generated, folder):
            result[facts["points"]] = {
                name: support.run([program, mesh, "--tolerance", str(DRAGGING_GAP), "--threads",
                                   str(options.threads), *arguments], options.threads)
                for name, arguments in variants.items()}
            print(f"dragged at {facts['points']:.0f} points", file=sys.stderr, flush=True)
    return result


def dragging_rows(dragged):
    summary = {("even", int(points), name): record for points, variants in dragged.items()
               for name, record in variants.items()}
    rows = []
    for name in ("default", "details"):
        records = at_sizes(summary, "even", name)
        for what in ("center", "roundness"):
            rows.append(row(f"updates a second, {what}, even: {compare_peers.METHODS[name][0]}",
                            [r[f"{what}_updates_per_second"] if usable(r) else None
                             for r in records], DRAGGING, True))
            gaps = [max(r[f"{what}_gaps"], default=None) if usable(r) else None for r in records]
            if any(gap is not None for gap in gaps):  # none in closed form
                rows.append(row(f"largest gap of them, {what}: {compare_peers.METHODS[name][0]}", gaps,
                                [DRAGGING_GAP] * len(SIZES)))
    return rows


# ---------------------------------------------------------------------------------------- stages
def run_stages(options, threads):
    """{stage: record of Google Benchmark} of one process."""
    command = [os.path.join(options.programs, "Stages"), "--benchmark_format=json",
               f"--benchmark_min_time={options.stage_seconds}",
               "--benchmark_filter=-^Filter",
               "--sizes", str(options.stage_size), "--families", options.stage_family,
               "--threads", str(threads)]
    found = support.run(command, threads)
    if "error" in found:
        raise SystemExit("Stages: " + found["error"])
    return {record["name"].split("/")[0]: record for record in found["benchmarks"]}


def measure_stages(options):
    """One and two threads in turn, {threads: {stage: medians}}."""
    runs = {1: [], 2: []}
    for _ in range(options.repetitions):
        for threads, done in runs.items():
            done.append(run_stages(options, threads))
            print(f"stages with {threads} thread(s)", file=sys.stderr, flush=True)
    return {threads: {stage: support.medians([run[stage] for run in done]) for stage in done[0]}
            for threads, done in runs.items()}


def same_bits(stages):
    """Stages whose result depends on the number of threads."""
    return [stage for stage in STAGES if stage in stages[1] and
            stages[1][stage].get("label") != stages[2][stage].get("label")]


def stage_table(stages):
    one, two = stages[1], stages[2]
    read = max(one["Limit:Read"]["bytes"], one["Limit:ReadHugePages"]["bytes"])
    flops = one["Limit:Arithmetic"]["flops"]
    different = same_bits(stages)
    rows = []
    for stage in STAGES:
        if stage not in one:
            continue
        r = one[stage]
        percent = lambda name, limit, r=r: (
            f"{100 * r[name] / limit:.0f} %" if r.get(name) else "-")
        speed_up = r["real_time"] / two[stage]["real_time"]
        rows.append([stage, support.significant(r["real_time"]),
                     support.significant(1e9 * r["s_per_point"]), percent("bytes", read),
                     percent("flops", flops), verdict(speed_up, SPEED_UP, True),
                     "no" if stage in different else "yes"])
    limits = (f"Limits, one thread / two: read {read / 1e9:.1f} / "
              f"{max(two['Limit:Read']['bytes'], two['Limit:ReadHugePages']['bytes']) / 1e9:.1f} "
              f"GB/s, arithmetic {flops / 1e9:.0f} / {two['Limit:Arithmetic']['flops'] / 1e9:.0f} "
              "GFLOP/s in double precision.\n")
    heads = ["stage", "ms", "ns a point", "of read limit", "of arithmetic limit",
             "speed-up of two threads", "same bits"]
    return limits + "\n" + support.markdown(heads, rows)


# ------------------------------------------------------------------------------------------ main
def parse(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--comparison", default="comparison", metavar="DIR",
                        help="where compare_peers.py wrote, or is to write")
    parser.add_argument("--stage-size", type=int, default=237000)
    parser.add_argument("--stage-family", default="even", choices=compare_peers.FAMILIES)
    parser.add_argument("--stage-seconds", type=float, default=0.5,
                        help="least time spent on each stage")
    parser.add_argument("--output", default="comparison")
    own, rest = parser.parse_known_args(arguments)
    options = compare_peers.parse(rest)
    for name, value in vars(own).items():
        setattr(options, name, value)
    return options


def comparison(options):
    path = os.path.join(options.comparison, "comparison.json")
    if not os.path.exists(path):
        output, options.output = options.output, options.comparison
        compare_peers.write(options, compare_peers.measure(options))
        options.output = output
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def report(options, results, dragged, stages):
    summary = compare_peers.summarize(results)
    rows = (first_results(summary) + against_peers(summary) + dragging_rows(dragged)
            + memory_and_iterations(summary))
    return "\n".join([
        "# Goals\n", f"{support.machine(options.threads)}. Each cell: measured, goal, verdict.\n",
        compare_peers.busy(options, results),
        support.markdown(["goal", *(f"{size // 1000}k" for size in SIZES)],
                         [r for r in rows if set(r[1:]) != {"-"}]),
        "## Growth between 35k and 949k points: exponent of the number of points\n",
        growth_table(summary),
        f"## Stages, {options.stage_family}, {options.stage_size} points\n", stage_table(stages)])


def main():
    options = parse()
    results = comparison(options)
    dragged = drag(options)
    stages = measure_stages(options)
    os.makedirs(options.output, exist_ok=True)
    with open(os.path.join(options.output, "goals.json"), "w", encoding="utf-8") as file:
        json.dump({"dragging": dragged, "stages": stages}, file, indent=1)
    text = report(options, results, dragged, stages)
    with open(os.path.join(options.output, "goals.md"), "w", encoding="utf-8") as file:
        file.write(text)
    print(text)


if __name__ == "__main__":
    main()
