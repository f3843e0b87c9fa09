# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Reproduce the experiments of the thesis and write a report.

    pvpython reproduce_thesis.py [--output DIR] [--models DIR] [--only LIST] [--size small|full]

DIR/index.html is the report (default: thesis-report/), beside it a page per chapter, pictures/,
plots/ and numbers/ (CSV). Files of the same names in DIR are replaced, others stay. The exit code
is 1 if an experiment stopped with an error, which the report shows. A claim that does not hold is a
result, not an error.

The package sphericalstyle is taken from PYTHONPATH, or else from build/ of the project. Without a
screen the command starts itself again under xvfb-run.
"""
import argparse
import importlib
import os
import pathlib
import platform
import shutil
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CHAPTERS = ["chapter2", "chapter3", "chapter4", "chapter5", "errata"]


def parse():
    parser = argparse.ArgumentParser(description="Run the experiments of the thesis again.")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("thesis-report"))
    parser.add_argument("--models", type=pathlib.Path,
                        help="folder of real models: bunny.ply, nefertiti.ply, spot.ply, ...")
    parser.add_argument("--only", default="",
                        help="chapters (2 to 5, errata) and rows (A4.15), with commas between")
    parser.add_argument("--size", choices=["small", "full"], default="full",
                        help="small: coarser models and fewer values, below a minute")
    arguments = parser.parse_args()
    if arguments.models and not arguments.models.is_dir():
        parser.error(f"{arguments.models}: no such folder")
    return arguments


def need_screen():
    """VTK's OpenGL window needs an X server even off screen, and aborts without one."""
    if os.environ.get("DISPLAY"):
        return
    if not shutil.which("xvfb-run"):
        sys.exit("There is no screen (DISPLAY) and no xvfb-run to make one; install xvfb.")
    os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset", "pvpython",
                           "--dr", *sys.argv])


def need_package():
    """Find the package and the modules of this folder."""
    sys.path.insert(0, str(HERE))
    try:
        importlib.import_module("sphericalstyle")
    except ImportError:
        sys.path.insert(0, str(ROOT / "build" / "lib" / "python3" / "dist-packages"))
        try:
            importlib.import_module("sphericalstyle")
        except ImportError as error:
            sys.exit(f"The package sphericalstyle is not found ({error}): build the project"
                     " (Utilities/demo.sh does) or set PYTHONPATH.")
    if not hasattr(sys.modules["sphericalstyle"], "vtkConvexProxyDeformFilter"):
        sys.exit("This build has no CGAL (SPHERICALSTYLE_WITH_CGAL), which the report needs for chapter 5"
                 " and to find self-intersections.")
    try:
        importlib.import_module("matplotlib")
    except ImportError:
        sys.exit("The plots need matplotlib: apt-get install python3-matplotlib")


def chosen(experiments, only):
    """The experiments of these chapters and rows, in the order of the thesis."""
    from report import order_of

    names = {name.strip() for name in only.split(",") if name.strip()}
    picked = [e for e in experiments if not names or e.chapter in names or names & set(e.rows)]
    known = {e.chapter for e in experiments} | {row for e in experiments for row in e.rows}
    if names - known:
        sys.exit(f"--only: neither chapter nor row: {', '.join(sorted(names - known))}")
    return sorted(picked, key=lambda e: order_of(next(iter(e.rows))))


def main():
    arguments = parse()
    need_screen()
    need_package()
    import report
    from context import Context

    for chapter in CHAPTERS:
        if (HERE / f"{chapter}.py").is_file():
            importlib.import_module(chapter)
    try:
        arguments.output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        sys.exit(str(error))
    context = Context(arguments.size, arguments.models)
    start = time.perf_counter()
    sections = []
    for experiment in chosen(report.EXPERIMENTS, arguments.only):
        section = report.run(experiment, context, arguments.output)
        sections.append(section)
        verdicts = ", ".join(dict.fromkeys(kind for kind, _ in section.verdicts.values()))
        print(f"{section.seconds:6.1f} s  {', '.join(experiment.rows)}: {verdicts}", flush=True)
        if section.message:
            print(section.message, file=sys.stderr)
    minutes = (time.perf_counter() - start) / 60.0
    report.write(arguments.output, sections, [
        ("Size", arguments.size),
        ("Real models", ", ".join(sorted(context.read))
         or ("none read" if arguments.models else "none (--models DIR)")),
        ("Time", f"{minutes:.1f} minutes, {os.cpu_count()} cores, {platform.machine()}"),
    ])
    print(f"{arguments.output / 'index.html'}, {minutes:.1f} minutes")
    return 1 if any(section.message for section in sections) else 0


if __name__ == "__main__":
    sys.exit(main())
