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
import report_goals


def record(method, points, seconds, megabytes=100.0, family="even", **more):
    return {"family": family, "points": points, "method": method, "total_seconds": seconds,
            "processor_seconds": 0.5 * seconds,
            "setup_seconds": seconds / 4, "seconds_per_iteration": seconds / 40, "iterations": 30,
            "start_megabytes": 10.0, "peak_megabytes": megabytes, **more}


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

    def test_gaps_run_from_the_unmoved_model_to_the_minimum(self):
        gaps = support.gaps({"rest_energy": 12.0, "energies": [7.0, 3.0, 2.5, 2.0]}, 2.0)
        self.assertEqual(gaps, [0.5, 0.1, 0.05, 0.0])
        self.assertEqual(support.iterations_to(0.06, gaps), 2)
        self.assertEqual(support.iterations_to(0.5, gaps), 0)
        self.assertIsNone(support.iterations_to(1e-4, gaps[:-1]))

    def test_numbers_of_tables(self):
        told = [support.significant(x) for x in (None, math.nan, 0, 0.01234, 1.234, 99.9, 12345.6, 4.2e-6)]
        self.assertEqual(told, ["-", "-", "0", "0.0123", "1.23", "99.9", "12346", "4.2e-06"])

    def test_failures_of_programs_are_told(self):
        program = [sys.executable, "-c", "import sys; sys.exit('no mesh')"]
        self.assertEqual(support.run(program, 1), {"error": "no mesh"})
        sleeper = [sys.executable, "-c", "import time; time.sleep(60)"]
        self.assertIn("took more than", support.run(sleeper, 1, timeout=0.2)["error"])


class Comparison(unittest.TestCase):
    def test_models_are_subdivided_to_the_nearest_size(self):
        self.assertEqual([compare_peers.subdivisions(50000, size) for size in (1000, 50000, 99000, 120000, 949000)],
                         [0, 0, 0, 1, 2])

    def test_table_has_ratios_and_failures(self):
        summary = compare_peers.summarize([
            record("details", 100, 0.5, gap=2e-5), record("details", 100, 0.1, gap=2e-5),
            record("details", 100, 0.2, gap=2e-5), record("cgal", 100, 4.0),
            {"family": "even", "points": 100, "method": "open3d", "error": "not finite"}])
        ours, cgal, open3d = compare_peers.table(summary, "even", 100).splitlines()[2:]
        cells = [cell.strip() for cell in ours.split("|")]
        self.assertEqual(cells[5:9], ["0.2", "0.1", "20", "-"])  # total s, processor s, CGAL takes, with CHOLMOD
        self.assertEqual(cells[11], "2.0e-05")
        self.assertIn("| 1 |", cgal)
        self.assertIn("fails: not finite", open3d)

    def test_a_busy_machine_is_told(self):
        runs = [record("uniform", 100, 1.0) for _ in range(3)]
        self.assertIn("50 % of their time", compare_peers.busy(compare_peers.parse([]), runs))
        self.assertEqual(compare_peers.busy(compare_peers.parse(["--threads", "2"]), runs), "")
        idle = [{**r, "processor_seconds": 0.99} for r in runs]
        self.assertEqual(compare_peers.busy(compare_peers.parse([]), idle), "")

    def test_growth_of_memory_is_without_the_empty_process(self):
        summary = compare_peers.summarize(
            [record("uniform", n, 1e-6 * n ** 1.2, megabytes=10.0 + 2e-3 * n) for n in (1000, 10000)])
        ((family, _, time, memory),) = compare_peers.growth(summary)
        self.assertEqual(family, "even")
        self.assertAlmostEqual(time, 1.2)
        self.assertAlmostEqual(memory, 1.0)


class Goals(unittest.TestCase):
    def test_verdicts(self):
        self.assertEqual(report_goals.verdict(0.4, 0.1), "0.4 of 0.1: missed")
        self.assertEqual(report_goals.verdict(0.1, 0.1), "0.1 of 0.1: reached")
        self.assertEqual(report_goals.verdict(30.0, 20, True), "30 of 20: reached")
        self.assertEqual(report_goals.verdict(None, 1), "-")

    def test_sizes_are_the_nearest_measured(self):
        summary = compare_peers.summarize(
            [record("uniform", n, float(n)) for n in (2000, 34812, 90000, 98012, 600000)])
        found = report_goals.at_sizes(summary, "even", "uniform")
        self.assertEqual([r and r["points"] for r in found], [34812, 98012, None, None])

    def test_ratios_to_peers(self):
        summary = compare_peers.summarize([record("uniform", 35000, 0.1), record("uniform-30", 35000, 0.4),
                                           record("cgal-cholmod", 35000, 8.0)])
        rows = {row[0]: row[1] for row in report_goals.against_peers(summary)}
        self.assertEqual(rows["whole run, even: CGAL with CHOLMOD / ours, uniform weights"], "80 of 20: reached")
        self.assertEqual(rows["an iteration, even: CGAL with CHOLMOD / ours"], "20 of 15: reached")
        self.assertEqual(rows["an iteration, even: Open3D / ours"], "-")

    def test_iterations_that_never_reach_the_gap_miss(self):
        summary = compare_peers.summarize([
            record("uniform", 35000, 1.0, gap=1e-3, **{"iterations_to_1e-4": None}),
            record("uniform", 35000, 1.0, family="slivers", gap=1e-5, **{"iterations_to_1e-4": 4})])
        rows = {row[0]: row[1] for row in report_goals.memory_and_iterations(summary)}
        self.assertEqual(rows["iterations to 1e-4, even: ours, uniform weights"], "inf of 5: missed")
        self.assertEqual(rows["iterations to 1e-4, slivers: ours, uniform weights"], "4 of 25: reached")
        self.assertFalse([name for name in rows if "iterations" in name and "DetailSize" in name])  # it has none

    def test_stages_with_other_bits_are_told(self):
        stage = {"real_time": 4.0, "s_per_point": 1e-8, "bytes": 5e9}
        limits = {"Limit:Read": {"bytes": 1e10}, "Limit:ReadHugePages": {"bytes": 2e10},
                  "Limit:Arithmetic": {"flops": 1e11}}
        stages = {1: {**limits, "Solve": {**stage, "label": "a"}, "Energy": {**stage, "label": "b"}},
                  2: {**limits, "Solve": {**stage, "label": "a", "real_time": 2.0},
                      "Energy": {**stage, "label": "c"}}}
        self.assertEqual(report_goals.same_bits(stages), ["Energy"])
        table = report_goals.stage_table(stages)
        self.assertIn("| Solve | 4 | 10 | 25 % | - | 2 of 1.6: reached | yes |", table)
        self.assertIn("| Energy | 4 | 10 | 25 % | - | 1 of 1.6: missed | no |", table)


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
