# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The programs of Benchmarks/ run, say what the scripts read, and give the same bits with one
thread and with two. No time is judged.

usage: TestBenchmarkPrograms.py BENCHMARKS_FOLDER PROGRAMS_FOLDER
"""
import contextlib
import csv
import io
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
        for family in support.FAMILIES:
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
        for mesh in (self.meshes[family, SHARED] for family in support.FAMILIES):
            for method in ("closed-form", "energy"):
                one, two = (run("RoundMesh", mesh, "--method", method, "--threads", t, threads=t) for t in (1, 2))
                self.assertEqual(one["hash"], two["hash"], method)

    def test_what_iterates(self):
        mesh = self.meshes["slivers", SMALL]
        self.assertEqual(run("RoundMesh", mesh)["iterations"], 0)
        self.assertGreater(run("RoundMesh", mesh, "--method", "energy")["iterations"], 1)
        self.assertEqual(run("RoundMesh", mesh, *compare_peers.METHODS["energy-30"][2])["iterations"], 30)

    def test_updates(self):
        r = run("RoundMesh", self.meshes["even", SHARED], "--updates", 4)
        for what in ("center", "roundness"):
            self.assertGreater(r[f"{what}_seconds"], 0.0)
            self.assertGreaterEqual(r[f"{what}_slowest_seconds"], r[f"{what}_seconds"])
        self.assertEqual(r["hash"], run("RoundMesh", self.meshes["even", SHARED])["hash"])  # of the first result

    def test_faults(self):
        for message, *arguments in (("no method is called", self.meshes["even", SMALL], "--method", "other"),
                                    ("--updates: not a number", self.meshes["even", SMALL], "--updates", "x"),
                                    ("is not a mesh", __file__), ("too few arguments",)):
            told = support.run([os.path.join(PROGRAMS, "RoundMesh"), *arguments], 1)
            self.assertIn(message, told.get("error", ""))

    def stages(self, threads, *arguments):
        found = run("Stages", "--benchmark_format=json", "--benchmark_min_time=0.01", "--threads", threads, *arguments,
                    threads=threads)
        return {record["name"].split("/")[0]: record for record in found["benchmarks"]}

    def test_stages(self):
        one, two = (self.stages(threads, "--sizes", SHARED) for threads in (1, 2))
        self.assertLessEqual({"Limit:Read", "Splat", "Update", "Factorization", "Iteration"}, set(one))
        self.assertEqual(set(one), set(two))
        for stage, record in one.items():
            self.assertGreater(record["real_time"], 0.0, stage)
            self.assertEqual(record.get("label"), two[stage].get("label"), stage)
        # Another hash for another mesh: one that is always the same would show nothing.
        other = self.stages(1, "--sizes", SMALL, "--benchmark_filter=^(Update|Iteration)")
        for stage, record in other.items():
            self.assertNotEqual(record["label"], one[stage]["label"], stage)

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

    @unittest.skipUnless(os.path.exists(os.path.join(PROGRAMS, "HandleDeformation")), "no CGAL")
    def test_handles_come_to_the_minimum_of_the_peer(self):
        for bumps in (0, 0.1):
            r = run("HandleDeformation", "--divisions", 2, "--bumps", bumps, "--repeats", 1)
            self.assertLess(r["cgal_rims_difference_to_limit"], 1e-5, bumps)
            self.assertLess(r["difference_to_limit"], 1e-3, bumps)
            self.assertAlmostEqual(r["energy"] / r["rims_energy"], 1.0, delta=1e-10, msg=bumps)
            self.assertAlmostEqual(r["cgal_rims_rims_energy"] / r["rims_energy_of_limit"], 1.0, delta=1e-8, msg=bumps)

    def test_comparison(self):
        output = os.path.join(self.folder.name, "comparison")
        options = compare_peers.parse(["--programs", PROGRAMS, "--sizes", "1000", str(SMALL), "--repetitions", "2",
                                       "--output", output])
        with contextlib.redirect_stderr(io.StringIO()):
            text = compare_peers.write(options, compare_peers.measure(options))
        self.assertNotIn("fails", text)
        with open(os.path.join(output, "comparison.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 2 * 2 * len(options.methods))
        for row in rows:
            # Open3D's set-up is a difference of two runs: anything on a busy machine.
            for name in ("total_seconds", "processor_seconds", "peak_megabytes"):
                self.assertGreater(float(row[name]), 0.0, row)
            self.assertGreaterEqual(float(row["peak_megabytes"]), float(row["start_megabytes"]))
        for method in options.methods:
            self.assertIn(compare_peers.METHODS[method][0], text)
        self.assertGreater(os.path.getsize(os.path.join(output, "comparison.png")), 10000)

    def test_goals(self):
        options = report_goals.parse(["--programs", PROGRAMS, "--sizes", str(SMALL), str(SHARED), "--repetitions", "1",
                                      "--updates", "3"])
        with contextlib.redirect_stderr(io.StringIO()):
            text = report_goals.report(options, report_goals.measure(options))
        for family in support.FAMILIES:
            self.assertIn(f"| {family} | 1,962 points | ", text)
        self.assertEqual(text.count("| same bits with two threads | yes | yes |"), 2)


if __name__ == "__main__":
    unittest.main()
