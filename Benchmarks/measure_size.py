# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""How time and memory of vtkSphericalStyleFilter grow with the size of a model, up to tens of millions of points.

usage: measure_size.py [--points N ...] [--kinds body scan parts] [--threads N ...] [--detail-size S] [--runs N]

Models are generated: body, a smooth bumpy body with limbs; scan, the same with noise of a third of an edge along its
normals, as a scanner leaves it; parts, many small closed bodies on its surface. Points are in single precision and ids
in 64 bits, as readers leave them. The generator runs in a process of its own, and so does each measurement, which reads
the model from a temporary folder without a copy.

For each, the median of the runs: seconds, then those of the stages (reading and checking the input, sides, grid, walls,
factor, base, thickness of limbs, targets, details, output), and peak memory of the process by the system's own count
(VmHWM of /proc/self/status): in all, with Python, VTK, input and output; and what it had more than before the
execution, in bytes a point. At the end the exponent p of n^p over the sizes. --memory also prints the peak of each
stage above what the process had before the execution. Run with PYTHONPATH=build/lib/python3/dist-packages
/usr/bin/python3. No test checks the times.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import benchmark_support as support
import numpy as np

KINDS = ("body", "scan", "parts")
STAGES = ("read", "sides", "grid", "walls", "factor", "base", "limbs", "targets", "details", "output")
POINTS_OF_PART = 2000


# ------------------------------------------------------------------------------------------- models
def sphere(rings):
    """4 rings^2 + 2 directions, and triangles that face outward: an octahedron whose edges are cut in `rings`."""
    sizes = [1] + [4 * k for k in range(1, rings)]
    sizes = np.array(sizes + [4 * rings] + sizes[::-1])
    first = np.concatenate([[0], np.cumsum(sizes)])
    points = np.empty((first[-1], 3))
    triangles = np.empty((2 * (first[-1] - 2), 3), dtype=np.int64)
    used = 0
    for k in range(2 * rings + 1):
        along = np.arange(sizes[k])
        n = min(k, 2 * rings - k)  # points on each of the four sides
        side, at = (along // n, along % n) if n else (along, along)
        turn = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])
        flat = turn[side % 4] * (n - at)[:, None] + turn[(side + 1) % 4] * at[:, None]
        points[first[k]:first[k + 1], :2] = flat
        points[first[k]:first[k + 1], 2] = rings - k
    for k in range(2 * rings):
        upper = k >= rings  # from here on the ring above is the longer one
        wide, narrow = (k, k + 1) if upper else (k + 1, k)
        n = min(wide, 2 * rings - wide)
        side, at = np.divmod(np.arange(sizes[wide]), n)

        def number(ring, sides, places, length):
            return first[ring] + (sides * length + places) % sizes[ring]
        a, b = number(wide, side, at, n), number(wide, side, at + 1, n)
        c = number(narrow, side, at, n - 1)
        inner = at + 1 < n
        d = number(narrow, side, at + 1, n - 1)
        rows = (np.column_stack([a, b, c]), np.column_stack([b[inner], d[inner], c[inner]]))
        for row in rows:
            triangles[used:used + len(row)] = row[:, ::-1] if upper else row
            used += len(row)
    assert used == len(triangles)
    points /= np.linalg.norm(points, axis=1)[:, None]
    return points, triangles


def bumpy(directions):
    """The distance from the middle: a head, four limbs, and ripples of several sizes."""
    limbs = np.array([[0.0, 0.2, 1.0], [0.9, 0.0, 0.4], [-0.9, 0.0, 0.4], [0.5, 0.1, -0.9], [-0.5, 0.1, -0.9]])
    limbs /= np.linalg.norm(limbs, axis=1)[:, None]
    distance = np.ones(len(directions))
    for limb, sharp, height in zip(limbs, (6.0, 14.0, 14.0, 16.0, 16.0), (0.5, 0.7, 0.7, 0.8, 0.8)):
        distance += height * np.exp(sharp * (directions @ limb - 1.0))
    for waves, height in ((9, 0.02), (23, 0.007), (61, 0.002)):
        distance += height * np.prod(np.sin(waves * directions + 0.3), axis=1)
    return distance


def body(points):
    directions, triangles = sphere(max(2, round((max(points, 2) / 4 - 0.5) ** 0.5)))
    return directions * bumpy(directions)[:, None], triangles


def make(kind, points):
    """Points and triangles of a model with about as many points."""
    if kind != "parts":
        places, triangles = body(points)
        if kind == "scan":
            edge = np.linalg.norm(places[triangles[:, 0]] - places[triangles[:, 1]], axis=1).mean()
            places *= 1.0 + np.random.default_rng(1).normal(0.0, edge / 3.0, len(places))[:, None]
        return places, triangles
    count = max(1, round(points / POINTS_OF_PART))
    middles = body(2 * count + 20)[0]
    middles = middles[np.linspace(0, len(middles) - 1, count).round().astype(int)]
    part, corners = body(POINTS_OF_PART)
    size = 1.5 / count ** 0.5
    places = (middles[:, None, :] + size * part[None]).reshape(-1, 3)
    return places, (corners[None] + len(part) * np.arange(len(middles))[:, None, None]).reshape(-1, 3)


def generate(kind, points, folder):
    places, triangles = make(kind, points)
    np.save(folder / "points.npy", places.astype(np.float32))
    np.save(folder / "triangles.npy", triangles)


# ---------------------------------------------------------------------------------------- one run
def memory(what):
    """VmRSS or VmHWM: now and the peak, in bytes."""
    with open("/proc/self/status", encoding="ascii") as status:
        return 1024 * next(int(line.split()[1]) for line in status if line.startswith(what))


def forget_peak():
    """The peak counts from now on."""
    pathlib.Path("/proc/self/clear_refs").write_text("5", encoding="ascii")


def run_one(arguments):
    """Rounds the model in the folder and prints what it took."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    from sphericalstyle import vtkSphericalStyleFilter

    surface = vtkPolyData()
    places, triangles = np.load(arguments.one / "points.npy"), np.load(arguments.one / "triangles.npy")
    surface.SetPoints(vtkPoints())
    surface.GetPoints().SetData(numpy_to_vtk(places))
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(triangles.ravel()))
    surface.SetPolys(cells)
    style = vtkSphericalStyleFilter()
    style.SetNumberOfThreads(arguments.threads[0])
    style.SetRefineLongEdgesToOff()  # the cells stay those of the model
    if arguments.detail_size is not None:
        style.SetDetailSize(arguments.detail_size)
    style.SetInputData(surface)
    marks = []
    whole = memory("VmHWM")
    before = memory("VmRSS")

    def mark(*_):
        marks.append((time.perf_counter(), memory("VmHWM")))
        forget_peak()
    forget_peak()
    if arguments.memory:
        style.AddObserver("ProgressEvent", mark)
    else:
        style.AddObserver("ProgressEvent", lambda *_: marks.append((time.perf_counter(), 0)))
    start, processor = time.perf_counter(), time.process_time()
    style.Update()
    end = time.perf_counter()
    if style.GetOutput().GetNumberOfPoints() != len(places):
        sys.exit("The filter gave no result and has said why.")
    peak = max([memory("VmHWM")] + [high for _, high in marks])
    marks = [(start, 0)] + [(at, high) for at, high in marks if at > start]
    print(json.dumps({"points": len(places), "seconds": end - start, "processor": time.process_time() - processor,
                      "peak": max(peak, whole), "more": (peak - before) / len(places),
                      "stages": [b[0] - a[0] for a, b in zip(marks, marks[1:])],
                      "memory": [(high - before) / len(places) for _, high in marks[1:]]}))


# ------------------------------------------------------------------------------------------- table
def measure(arguments, folder, threads):
    """The median of the runs of one model; stages by their names."""
    command = [sys.executable, __file__, "--one", str(folder), "--threads", str(threads)]
    command += ["--memory"] * arguments.memory
    command += [] if arguments.detail_size is None else ["--detail-size", str(arguments.detail_size)]
    records = []
    for _ in range(arguments.runs):
        done = subprocess.run(command, check=False, text=True, capture_output=True)
        if done.returncode != 0:
            return {"error": done.stderr.strip().splitlines()[-1] if done.stderr.strip() else
                    f"ended with code {done.returncode}"}
        record = json.loads(done.stdout.splitlines()[-1])
        # The first two marks are the begin of the execution and of the solve, the last is its end.
        stages = record.pop("stages")
        names = STAGES if len(stages) == len(STAGES) + 1 else range(len(stages) - 1)
        used = record.pop("memory")
        record |= {f"s {name}": value for name, value in zip(names, [stages[0] + stages[1]] + stages[2:])}
        if arguments.memory:
            record |= {f"B {name}": value for name, value in zip(names, [max(used[:2])] + used[2:])}
        records.append(record)
    return support.medians(records)


def parse(arguments=None):
    parser = argparse.ArgumentParser(description="How time and memory grow with the size of a model.")
    parser.add_argument("--points", type=int, nargs="+", default=[35_000, 99_000, 237_000, 949_000])
    parser.add_argument("--kinds", choices=KINDS, nargs="+", default=["scan"])
    parser.add_argument("--threads", type=int, nargs="+", default=[1])
    parser.add_argument("--detail-size", type=float, help="of the filter, by default as there")
    parser.add_argument("--runs", type=int, default=1, help="of each (default: %(default)d)")
    parser.add_argument("--memory", action="store_true", help="also the peak of each stage")
    parser.add_argument("--one", type=pathlib.Path, metavar="FOLDER", help=argparse.SUPPRESS)
    parser.add_argument("--generate", help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if options.runs < 1 or min(options.points) < 1 or min(options.threads) < 1:
        parser.error("--runs, --points and --threads: at least 1")
    return options


def table(records):
    """Lines of a table; the stages are those of the first record that has some."""
    stages = [key for key in next((r for r in records if "error" not in r), {}) if key[:2] in ("s ", "B ")]
    rows = []
    for r in records:
        row = [r["kind"], r["points"], r["threads"]]
        if "error" in r:
            rows.append(row + [r["error"]] + [""] * (3 + len(stages)))
            continue
        rows.append(row + [support.significant(r["seconds"]), support.significant(r["processor"])]
                    + [round(r["peak"] / 1e6), round(r["more"])]
                    + [support.significant(r.get(key)) for key in stages])
    return support.markdown(["model", "points", "threads", "s", "processor s", "peak MB", "B a point"] + stages, rows)


def growth(records):
    """A line for each model and number of threads that has several sizes."""
    lines = []
    for kind, threads in dict.fromkeys((r["kind"], r["threads"]) for r in records):
        good = [r for r in records if (r["kind"], r["threads"]) == (kind, threads) and "error" not in r]
        if len(good) > 1:
            sizes = [r["points"] for r in good]
            seconds, memory_ = ([r[key] for r in good] for key in ("seconds", "peak"))
            lines.append(f"{kind}, {threads} threads: seconds grow as n^{support.exponent(sizes, seconds):.2f}, peak"
                         f" memory as n^{support.exponent(sizes, memory_):.2f}")
    return lines


def main():
    arguments = parse()
    if arguments.one and arguments.generate:
        generate(arguments.generate, arguments.points[0], arguments.one)
        return
    if arguments.one:
        run_one(arguments)
        return
    records = []
    for kind in arguments.kinds:
        for points in arguments.points:
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                subprocess.run([sys.executable, __file__, "--one", name, "--generate", kind, "--points", str(points)],
                               check=True)
                for threads in arguments.threads:
                    records.append({"kind": kind, "threads": threads, "points": points}
                                   | measure(arguments, folder, threads))
                    print(table(records[-1:]), flush=True)
    print()
    print("\n".join([table(records), "", *growth(records)]))


if __name__ == "__main__":
    main()
