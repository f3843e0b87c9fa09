# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The arithmetic of the scripts in Benchmarks/, on numbers known beforehand.

usage: TestBenchmarkScripts.py BENCHMARKS_FOLDER
"""
import math
import os
import subprocess
import sys
import unittest

sys.path.insert(0, sys.argv.pop(1))
import benchmark_support as support
import compare_peers
import measure_size
import numpy as np
import report_goals


def record(method, points, seconds, megabytes=100.0, family="even", **more):
    return {"family": family, "points": points, "method": method, "total_seconds": seconds,
            "processor_seconds": 0.5 * seconds,
            "setup_seconds": seconds / 4, "seconds_per_iteration": seconds / 40, "iterations": 30,
            "start_megabytes": 10.0, "peak_megabytes": megabytes, **more}


def rounded(points, seconds, threads=1, **more):
    """A run of our filter, as the goals take it."""
    drag = {f"{what}_seconds": seconds / 10 for what in ("center", "roundness")}
    slowest = {f"{what}_slowest_seconds": seconds / 5 for what in ("center", "roundness")}
    return record(threads, points, seconds, megabytes=13.0 + points / 2048, **{
        "input_megabytes": 2.0, "output_megabytes": 1.0, "hash": "a", **drag, **slowest, **more})


class Support(unittest.TestCase):
    def test_medians_take_each_number_by_itself(self):
        runs = [{"a": 3.0, "b": 1, "c": "x"}, {"a": 1.0, "b": 9, "c": "x"}, {"a": 2.0, "b": 4, "c": "x"}]
        self.assertEqual(support.medians(runs), {"a": 2.0, "b": 4, "c": "x"})

    def test_a_failed_run_is_what_remains(self):
        self.assertEqual(support.medians([{"a": 1.0}, {"error": "why"}]), {"error": "why"})

    def test_exponent_of_powers(self):
        sizes = [35e3, 99e3, 237e3, 949e3]
        for power in (-0.5, 1.0, 1.37):
            self.assertAlmostEqual(support.exponent(sizes, [7e-6 * s ** power for s in sizes]), power)
        self.assertTrue(math.isnan(support.exponent([100, 100], [1.0, 2.0])))
        self.assertTrue(math.isnan(support.exponent([100, 200], [0.0, 2.0])))

    def test_numbers_of_tables(self):
        told = [support.significant(x) for x in (None, math.nan, 0, 0.01234, 1.234, 99.9, 12345.6, 4.2e-6)]
        self.assertEqual(told, ["-", "-", "0", "0.0123", "1.23", "99.9", "12346", "4.2e-06"])

    def test_failures_of_programs_are_told(self):
        program = [sys.executable, "-c", "import sys; sys.exit('no mesh')"]
        self.assertEqual(support.run(program, 1), {"error": "no mesh"})
        sleeper = [sys.executable, "-c", "import time; time.sleep(60)"]
        self.assertIn("took more than", support.run(sleeper, 1, timeout=0.2)["error"])


    def test_a_busy_machine_is_told(self):
        runs = [record("energy", 100, 1.0) for _ in range(3)]
        self.assertIn("50 % of their time", support.busy(runs))
        self.assertEqual(support.busy([{**r, "processor_seconds": 0.99} for r in runs]), "")


class Size(unittest.TestCase):
    def test_models_are_closed_and_face_outward(self):
        for kind in measure_size.KINDS:
            for points in (1, 100, 9000):
                places, triangles = measure_size.make(kind, points)
                sides = np.vstack([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
                self.assertEqual(len(np.unique(sides, axis=0)), len(sides))
                self.assertTrue(np.array_equal(np.unique(sides, axis=0), np.unique(sides[:, ::-1], axis=0)))
                corners = places[triangles]
                volumes = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
                self.assertGreater(volumes.sum(), 0.0)
                self.assertEqual(np.unique(triangles).tolist(), list(range(len(places))))
        self.assertAlmostEqual(len(measure_size.make("scan", 9000)[0]) / 9000, 1.0, delta=0.02)

    def test_table_and_growth(self):
        records = [{"kind": "scan", "threads": 1, "points": n, "seconds": 1e-6 * n ** 1.1, "processor": 1.0, "peak": 400 * n,
                    "more": 300.0, "s grid": 0.25} for n in (1000, 10000)]
        self.assertEqual(measure_size.growth(records),
                         ["scan, 1 threads: seconds grow as n^1.10, peak memory as n^1.00"])
        text = measure_size.table([*records, {"kind": "scan", "threads": 1, "points": 10 ** 5, "error": "no memory"}])
        lines = text.splitlines()
        self.assertIn("| s grid |", lines[0])
        self.assertEqual([line.count("|") for line in lines], [9] * 5)
        self.assertIn("no memory", lines[4])


class Comparison(unittest.TestCase):
    def test_table_has_ratios_and_failures(self):
        summary = support.summarize([
            record("energy", 100, 0.5), record("energy", 100, 0.1), record("energy", 100, 0.2),
            record("cgal", 100, 4.0), {"family": "even", "points": 100, "method": "open3d", "error": "not finite"}])
        ours, cgal, open3d = compare_peers.table(summary, "even", 100).splitlines()[2:]
        cells = [cell.strip() for cell in ours.split("|")]
        self.assertEqual(cells[5:10], ["0.2", "0.1", "20", "-", "-"])  # total s, processor s, what the peers take
        self.assertIn("| 1 |", cgal)
        self.assertIn("fails: not finite", open3d)

    def test_overview_has_updates_beside_first_results(self):
        summary = support.summarize([
            record("closed-form", 1000, 0.5, center_seconds=0.05, roundness_seconds=0.04), record("cgal", 1000, 9.0),
            record("closed-form", 2000, 1.0, center_seconds=0.1, roundness_seconds=0.08)])
        heads, _, *rows = compare_peers.overview(summary).splitlines()
        self.assertEqual(heads, "| mesh | points | ours: first result | moved center | another `Roundness` | CGAL |")
        self.assertEqual(rows, ["| even | 1,000 | 0.5 | 0.05 | 0.04 | 9 |", "| even | 2,000 | 1 | 0.1 | 0.08 | - |"])

    def test_growth_of_memory_is_without_the_empty_process(self):
        summary = support.summarize(
            [record("energy", n, 1e-6 * n ** 1.2, megabytes=10.0 + 2e-3 * n) for n in (1000, 10000)])
        ((family, _, time, memory),) = compare_peers.growth(summary)
        self.assertEqual(family, "even")
        self.assertAlmostEqual(time, 1.2)
        self.assertAlmostEqual(memory, 1.0)


class Goals(unittest.TestCase):
    def test_verdicts(self):
        self.assertEqual(report_goals.verdict(0.4, 0.1), "0.4 of 0.1: missed")
        self.assertEqual(report_goals.verdict(0.1, 0.1), "0.1 of 0.1: reached")
        self.assertEqual(report_goals.verdict(30.0, 20, at_least=True), "30 of 20: reached")
        self.assertEqual(report_goals.verdict(30.0, None), "30")
        self.assertEqual(report_goals.verdict(math.nan, 1.05), "-")

    def test_goals_are_those_of_the_size_asked_for(self):
        goals = {99000: 1, 949000: 2}
        self.assertEqual([report_goals.goal_near(goals, n) for n in (2000, 98012, 236000, 948642)], [None, 1, None, 2])

    def test_memory_is_without_input_and_output(self):
        self.assertAlmostEqual(report_goals.kilobytes_per_point(rounded(98012, 1.0)), 0.5)

    def test_table(self):
        summary = support.summarize([rounded(2000, 0.1), rounded(2000, 0.05, threads=2), rounded(98012, 0.2),
                                     rounded(98012, 0.2, threads=2, hash="b")])
        rows = report_goals.goal_table(summary, "even").splitlines()
        self.assertEqual(rows[0], "| even | 2,000 points | 98,012 points |")
        self.assertIn("| first result, s | 0.1 | 0.2 of 0.25: reached |", rows)
        self.assertIn("| moved center, ms | 10 | 20 of 25: reached |", rows)
        self.assertIn("| memory beyond input and output, KB a point | 0.5 | 0.5 of 0.6: reached |", rows)
        self.assertIn("| speed-up by two threads: first result | 2 | 1 of 1.6: missed |", rows)
        self.assertIn("| same bits with two threads | yes | no |", rows)

    def test_growth(self):
        summary = support.summarize([rounded(n, 1e-6 * n ** power, family=family)
                                     for family, power in (("even", 1.0), ("slivers", 1.2)) for n in (1000, 10000)])
        rows = report_goals.growth_table(summary).splitlines()
        self.assertIn("| even | 1 of 1.05: reached |", rows[2])
        self.assertIn("| slivers | 1.2 of 1.05: missed |", rows[3])


class Stages(unittest.TestCase):
    """Every way to measure gives a number for each of its columns. No time is judged."""

    def columns(self, *arguments):
        done = subprocess.run([sys.executable, os.path.join(support.HERE, "measure_stages.py"), "--runs", "1", *arguments,
                               os.path.join(support.HERE, "..", "Data", "go-stone.vtp")], check=False, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout)
        heads, numbers = done.stdout.splitlines()
        self.assertEqual(len(numbers), len(heads), done.stdout)
        columns = [slice(at, at + 13) for at in range(30, len(heads), 14)]
        self.assertTrue(all(float(numbers[column]) >= 0.0 for column in columns), done.stdout)
        return [heads[column].strip() for column in columns]

    def test_both_ways_to_weigh(self):
        for arguments in ((), ("--uniform",)):
            self.assertEqual(self.columns(*arguments)[:3], ["first", "center", "Roundness"])

    def test_features(self):
        self.assertEqual(self.columns("--nonlinear")[:3], ["linear", "corrected", "as written"])


class Faults(unittest.TestCase):
    """What cannot be measured is said in a sentence."""

    def check(self, words, script, *arguments):
        done = subprocess.run([sys.executable, os.path.join(support.HERE, script), *arguments], check=False, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertIn(done.returncode, (1, 2), done.stdout)
        self.assertIn(words, done.stdout.splitlines()[-1])
        self.assertNotIn("Traceback", done.stdout)

    def test_a_mesh_that_is_not_there(self):
        self.check("nowhere.ply: no points", "measure_stages.py", "nowhere.ply")

    def test_no_runs(self):
        self.check("at least 1", "measure_stages.py", "--runs", "0")

    def test_programs_that_are_not_built(self):
        self.check("no such program", "compare_peers.py", "--programs", "nowhere", "--sizes", "100")

    def test_no_processes(self):
        self.check("processes of MPI", "measure_processes.py")


if __name__ == "__main__":
    unittest.main()
