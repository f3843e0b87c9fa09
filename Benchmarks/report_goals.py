# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The project's goals of speed and memory beside what the filter takes, with one thread and with two.

usage: /usr/bin/python3 report_goals.py [--sizes N ...] [--families even slivers] [--output DIR] ...

Default settings. Every run is a process of its own: a first result, then a drag of the center and one of Roundness.
Prints the tables and writes them to goals.md.
"""
import argparse
import math
import os
import sys

import benchmark_support as support

THREADS = [1, 2]
# At most, with one thread, by the number of points asked for.
FIRST_RESULT = {99000: 0.25, 949000: 3.5}  # seconds
UPDATE = {99000: 25, 949000: 250}  # milliseconds after a moved center, or another Roundness
KILOBYTES_PER_POINT = dict.fromkeys(support.SIZES, 0.6)  # beyond input and output
EXPONENT = 1.05  # of the number of points, over all sizes
# At least, with two threads.
SPEED_UP = dict.fromkeys(support.SIZES, 1.6)


def parse(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    support.add_options(parser, families=support.FAMILIES)
    parser.add_argument("--updates", type=int, default=12, metavar="N", help="of a drag")
    return parser.parse_args(arguments)


def measure(options):
    """A record for each run; its method is the number of threads."""
    program = os.path.join(options.programs, "RoundMesh")
    results = []
    for family, points, mesh in support.make_meshes(options):
        for _ in range(options.repetitions):
            for threads in THREADS:
                record = support.run([program, mesh, "--updates", str(options.updates), "--threads", str(threads)],
                                     threads)
                if "error" in record:
                    sys.exit(f"{family}, {points} points: {record['error']}")
                results.append({**record, "family": family, "points": points, "method": threads})
        print(f"{family}, {points} points: measured", file=sys.stderr, flush=True)
    return results


def verdict(measured, goal, at_least=False):
    """'0.4 of 0.25: missed'; without a goal the number alone."""
    number = support.significant(measured)
    if goal is None or math.isnan(measured):
        return number
    reached = measured >= goal if at_least else measured <= goal
    return f"{number} of {goal:g}: {'reached' if reached else 'missed'}"


def goal_near(goals, points):
    """The goal for the number of points that was asked for, within a tenth of those measured."""
    return next((goal for size, goal in goals.items() if abs(math.log(points / size)) < 0.1), None)


def kilobytes_per_point(r):
    """Of the process, without what it has before and without input and output."""
    own = r["peak_megabytes"] - r["start_megabytes"] - r["input_megabytes"] - r["output_megabytes"]
    return 1024 * own / r["points"]


# Line of the table, what of a record, goals.
ONE_THREAD = [
    ("first result, s", lambda r: r["total_seconds"], FIRST_RESULT),
    ("moved center, ms", lambda r: 1e3 * r["center_seconds"], UPDATE),
    ("slowest of the drag, ms", lambda r: 1e3 * r["center_slowest_seconds"], {}),
    ("another Roundness, ms", lambda r: 1e3 * r["roundness_seconds"], UPDATE),
    ("slowest of the drag, ms", lambda r: 1e3 * r["roundness_slowest_seconds"], {}),
    ("memory beyond input and output, KB a point", kilobytes_per_point, KILOBYTES_PER_POINT),
]
TIMES = [("first result", "total_seconds"), ("moved center", "center_seconds"),
         ("another Roundness", "roundness_seconds")]


def goal_table(summary, family):
    sizes = [points for a_family, points, threads in summary if (a_family, threads) == (family, 1)]
    one, two = ([summary[family, points, threads] for points in sizes] for threads in THREADS)
    rows = [[line, *(verdict(value(r), goal_near(goals, r["points"])) for r in one)]
            for line, value, goals in ONE_THREAD]
    rows += [[f"speed-up by two threads: {line}",
              *(verdict(a[name] / b[name], goal_near(SPEED_UP, a["points"]), at_least=True) for a, b in zip(one, two))]
             for line, name in TIMES]
    rows.append(["same bits with two threads", *("yes" if a["hash"] == b["hash"] else "no" for a, b in zip(one, two))])
    return support.markdown([family, *(f"{points:,} points" for points in sizes)], rows)


def growth_table(summary):
    rows = []
    for family in dict.fromkeys(family for family, _, _ in summary):
        records = [r for (a_family, _, threads), r in summary.items() if (a_family, threads) == (family, 1)]
        sizes = [r["points"] for r in records]
        exponents = [support.exponent(sizes, [r[name] for r in records]) for _, name in TIMES]
        rows.append([family, *(verdict(x, EXPONENT) for x in exponents)])
    return support.markdown(["family", *(line for line, _ in TIMES)], rows)


def report(options, results):
    summary = support.summarize(results)
    return "\n".join([
        "# Goals\n",
        f"{support.machine()}. One thread where nothing else is said; medians of {options.repetitions} run(s). Each "
        "cell: measured, goal, verdict.\n",
        support.busy([r for r in results if r["method"] == 1]),
        *(goal_table(summary, family) for family in options.families),
        "## Growth: exponent of the number of points\n", growth_table(summary)])


def main():
    options = parse()
    results = measure(options)
    text = report(options, results)
    support.write_text(options, "goals.md", text)
    print(text)
    hashes = {}
    for (family, points, _), record in support.summarize(results).items():
        hashes.setdefault((family, points), set()).add(record["hash"])
    if different := [case for case, of_case in hashes.items() if len(of_case) > 1]:
        sys.exit(f"two threads give other bits than one: {different}")


if __name__ == "__main__":
    main()
