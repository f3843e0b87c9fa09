# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The report of the thesis' experiments: every row is there, and failures are told.

usage: TestReproduceThesis.py FOLDER_OF_THE_COMMAND OUTPUT_FOLDER
"""
import contextlib
import io
import pathlib
import re
import runpy
import shutil
import sys
import tempfile

command, output = pathlib.Path(sys.argv[1]) / "reproduce_thesis.py", pathlib.Path(sys.argv[2])
ROWS = {"A2": 9, "A3": 15, "A4": 49, "A5": 24, "A8": 31}  # of the thesis' chapters, and errata
failures = 0


def check(good, claim):
    global failures
    if not good:
        failures += 1
        print("ERROR: should hold:", claim)


def run(*arguments):
    """The exit code of the command; it is told by its leaving."""
    sys.argv = [str(command), *map(str, arguments)]
    try:
        runpy.run_path(str(command), run_name="__main__")
    except SystemExit as leaving:
        return leaving.code
    return None


def pages(folder):
    return {file.name: file.read_text(encoding="utf-8") for file in folder.glob("*.html")}


# Everything, small.
shutil.rmtree(output, ignore_errors=True)
check(run("--size", "small", "--output", output) == 0, "the whole report runs without a failure")
found = pages(output)
rows = re.findall(r'<a href="([^"#]+)#(A\d\.\d+)">', found["index.html"])
expected = {f"{chapter}.{k}" for chapter, count in ROWS.items() for k in range(1, count + 1)}
missing = expected - {row for _, row in rows}
check(not missing, f"every row is in the overview; missing: {sorted(missing)}")
for page, row in rows:
    check(f'id="{row}"' in found.get(page, ""), f"the link to {row} leads somewhere")
check('class="badge failed"' not in found["index.html"], "no row is failed")
for page, text in found.items():
    for file in re.findall(r'(?:src|href)="((?:pictures|plots|numbers)/[^"]+)"', text):
        check((output / file).is_file() and (output / file).stat().st_size > 0, f"{page} shows {file}")

# An experiment that breaks off, beside one that does not.
import report  # noqa: E402, the command has put its folder into the path

kept = list(report.EXPERIMENTS)
report.EXPERIMENTS.clear()


@report.experiment("A4.90", title="Breaks", where="nowhere", claim="x")
def breaks(_section, _context):
    raise RuntimeError("<the reason>")


@report.experiment("A4.91", "A4.92", title="Goes on", where="nowhere", claim={"A4.91": "x", "A4.92": "y"})
def goes_on(section, _context):
    section.check(True, "one is one", row="A4.91")
    section.check(False, "one is two", row="A4.92")
    section.table("Numbers", ["third"], [[1.0 / 3.0]])


@report.experiment("A4.93", title="Needs", where="nowhere", claim="x", needs=("vtkNoSuchFilter",))
def needs(section, _context):
    raise AssertionError("must not be called")


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    error = io.StringIO()
    with contextlib.redirect_stderr(error):
        check(run("--output", folder) == 1, "a failed experiment makes the exit code 1")
    text = pages(folder)["chapter-4.html"]
    check("RuntimeError: &lt;the reason&gt;" in text, "the report tells why")
    check("<the reason>" in error.getvalue(), "so does the command")
    for row, kind in (("A4.90", report.FAILED), ("A4.91", report.HOLDS), ("A4.92", report.FAILS),
                      ("A4.93", report.NOT_REPRODUCED)):
        check(re.search(rf'id="{row}".*?>{kind}</span></td>', text), f"{row} {kind}")
    check("not built: vtkNoSuchFilter" in text, "a filter that is not there is named")
    check("0.3333333333333333" in (folder / "numbers" / "a4.91-numbers.csv").read_text(),
          "a CSV has all digits")
    check(run("--only", "A4.91", "--output", folder) == 0, "--only leaves the others out")
    check(run("--only", "A9.9", "--output", folder) not in (0, None), "--only of no row is an error")
report.EXPERIMENTS[:] = kept
sys.exit(1 if failures else 0)
