# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The programs of Benchmarks/ run, say what the scripts read, and give the same bits with one
thread and with two. No time is judged.

usage: TestBenchmarkPrograms.py BENCHMARKS_FOLDER PROGRAMS_FOLDER
"""
import contextlib
import csv
import io
import math
import os
import sys
import tempfile
import unittest

PROGRAMS = sys.argv.pop(2)
sys.path.insert(0, sys.argv.pop(1))
import benchmark_support as support
import compare_peers
import report_goals

SMALL = 2000
SHARED = 10000  # points: enough that loops are shared by two threads


def run(program, *arguments, threads=1):
    found = support.run([os.path.join(PROGRAMS, program), *map(str, arguments)], threads)
    if "error" in found:
        raise AssertionError(f"{program} {arguments}: {found['error']}")
    return found


class Programs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.meshes, cls.facts = {}, {}
        for family in compare_peers.FAMILIES:
            for size in (SMALL, SHARED):
                path = os.path.join(cls.folder.name, f"{family}-{size}")
                cls.meshes[family, size] = path
                cls.facts[family, size] = run("MakeMesh", family, size, path)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_families(self):
        for (family, size), facts in self.facts.items():
            self.assertLess(abs(facts["points"] / size - 1.0), 0.05)
            self.assertEqual(facts["triangles"], 2 * facts["points"] - 4)  # closed, no holes
            if family == "even":
                self.assertGreater(facts["smallest_angle"], 20.0)
                self.assertLess(facts["obtuse_share"], 0.05)
            else:
                self.assertLess(facts["smallest_angle"], 2.0)
                self.assertGreater(facts["obtuse_share"], 0.4)

    def test_same_bits_for_one_and_two_threads(self):
        for family in compare_peers.FAMILIES:
            for method in ("default", "details", "uniform"):
                arguments = [self.meshes[family, SHARED], *compare_peers.METHODS[method][2]]
                one, two = (run("RoundMesh", *arguments, "--threads", t, threads=t) for t in (1, 2))
                self.assertEqual(one["hash"], two["hash"], f"{family} {method}")
                self.assertEqual(one["energies"], two["energies"], f"{family} {method}")

    def test_plain_iterations_lower_the_energy(self):
        r = run("RoundMesh", self.meshes["slivers", SMALL], *compare_peers.METHODS["uniform-30"][2])
        self.assertEqual(r["iterations"], 30)
        energies = [r["rest_energy"], *r["energies"]]
        self.assertEqual(len(energies), 32)
        for before, after in zip(energies, energies[1:]):
            self.assertLessEqual(after, before + 1e-12 * energies[0])

    def test_stages(self):
        options = report_goals.parse(["--programs", PROGRAMS, "--stage-size", str(SHARED),
                                      "--stage-seconds", "0.01", "--repetitions", "1"])
        with contextlib.redirect_stderr(io.StringIO()):
            stages = report_goals.measure_stages(options)
        for stage in report_goals.STAGES:
            for threads in (1, 2):
                self.assertGreater(stages[threads][stage]["real_time"], 0.0, stage)
                self.assertGreater(stages[threads][stage]["s_per_point"], 0.0, stage)
        self.assertEqual(report_goals.same_bits(stages), [])
        # Another hash for another mesh: one that is always the same would show nothing.
        other = run("Stages", "--benchmark_format=json", "--benchmark_filter=^Rotations",
                    "--benchmark_min_time=0.01", "--sizes", SMALL, "--families", "even")
        self.assertNotEqual(other["benchmarks"][0]["label"], stages[1]["Rotations"]["label"])
        self.assertEqual(report_goals.stage_table(stages).count("\n| "), len(report_goals.STAGES) + 1)

    def test_dragging(self):
        for arguments, gaps in ((["--detail-size", "0.03"], 0), (["--weighting", "uniform"], 2)):
            self.drag(arguments, gaps)

    def drag(self, arguments, gaps):
        r = run("Dragging", self.meshes["even", SMALL], *arguments, "--updates", "4", "--reference-every", "2")
        for what in ("center", "roundness"):
            self.assertGreater(r[f"{what}_updates_per_second"], 0.0)
            self.assertEqual(len(r[f"{what}_gaps"]), gaps)
            for gap in r[f"{what}_gaps"]:
                self.assertTrue(0.0 <= gap < 1e-3, gap)

    @unittest.skipUnless(os.path.exists(os.path.join(PROGRAMS, "CgalDeformation")), "no CGAL")
    def test_the_linear_solvers_of_the_peer_agree(self):
        found = {}
        for solver in ("cgal", "ldlt", "cholmod"):
            command = [os.path.join(PROGRAMS, "CgalDeformation"), self.meshes["even", SMALL], "--solver", solver]
            r = support.run(command, 1)
            if "error" not in r:
                found[solver] = r["mean_displacement"]
        self.assertIn("cgal", found)
        self.assertIn("ldlt", found)
        self.assertGreater(found["cgal"], 1e-3)
        for solver, displacement in found.items():
            self.assertAlmostEqual(displacement / found["cgal"], 1.0, delta=1e-9, msg=solver)

    def test_comparison(self):
        output = os.path.join(self.folder.name, "comparison")
        options = compare_peers.parse(["--programs", PROGRAMS, "--sizes", "500", str(SMALL), "--repetitions", "2",
                                       "--output", output])
        with contextlib.redirect_stderr(io.StringIO()):
            text = compare_peers.write(options, compare_peers.measure(options))
        self.assertNotIn("fails", text)
        with open(os.path.join(output, "comparison.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 2 * 2 * 2 * len(options.methods))
        for row in rows:
            # Open3D's set-up is a difference of two runs: anything on a busy machine.
            for name in ("total_seconds", "processor_seconds", "peak_megabytes"):
                self.assertGreater(float(row[name]), 0.0, row)
            self.assertGreater(float(row["peak_megabytes"]), float(row["start_megabytes"]))
            if row["method"] in compare_peers.ITERATING:
                self.assertTrue(math.isfinite(float(row["gap"])), row)
        for method in options.methods:
            self.assertIn(compare_peers.METHODS[method][0], text)
        self.assertGreater(os.path.getsize(os.path.join(output, "comparison.png")), 10000)


if __name__ == "__main__":
    unittest.main()
