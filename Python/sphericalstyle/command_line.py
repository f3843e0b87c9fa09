# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The program sphericalstyle: rounds models in files."""
import argparse
import csv
import decimal
import json
import multiprocessing
import multiprocessing.connection
import os
import pathlib
import re
import sys
import time
import warnings
from typing import NamedTuple, Optional

from vtkmodules.vtkCommonCore import vtkPoints, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from . import __version__, presets
from .messages import Error, printable
from .model_files import (READERS, UP_AXES, WRITERS, cannot_write, is_gltf, largest_move, place_in, read, up_axis_of,
                          whole, write)
from .pages import PAGES, write_page
from .properties import closest, properties
from .rounding import ARRAYS, execute, make
from .sliders import write_slider

COLUMNS = ["model", "points", "new points", "largest move", "seconds", "result"]

DESCRIPTION = """\
Rounds 3D models like toys: a round body, short thick limbs, and details that keep their shape.

OUTPUT is a file, or a folder for several models or a folder of models. There a model keeps its name. The endings of
the names choose the formats."""

EPILOG = f"""\
formats:
  read   {' '.join(sorted(READERS))}
  written  {' '.join(sorted(WRITERS))}
  Texture coordinates and arrays are kept where the format has them: .vtp and .vtk keep everything, .ply colors and
  texture coordinates, .obj texture coordinates, .glb these and colors that are the active scalars, .stl and .3mf shape
  alone. The unit of .3mf is the millimeter.
  Files that exist are replaced.

exit codes:
  0  every model was rounded
  1  a model could not be read, rounded or written; the others were
  2  the command was wrong, and nothing was done

examples:
  sphericalstyle bunny.ply round.ply
  sphericalstyle bunny.obj round.glb --preset Chibi --roundness 1.2 --picture round.png --report round.json
  sphericalstyle bunny.ply bunny.glb --slider --html bunny.html
  sphericalstyle bunny.stl bunny.3mf --keep-on-ground
  sphericalstyle models/*.stl --output rounded
  sphericalstyle models rounded --recursive --format ply --report rounded.csv"""


class Job(NamedTuple):
    name: str  #: for the table
    source: pathlib.Path
    folder: Optional[pathlib.Path]  #: that the result must not leave, if there is one
    target: pathlib.Path  #: in the folder, or any
    picture: Optional[pathlib.Path]
    page: Optional[pathlib.Path] = None
    slider: bool = False


def add_properties(parser):
    """Gives the parser an option for each property and array of the filter."""
    shape = parser.add_argument_group("shape")
    names = "; ".join(f"{name}: {preset.description.lower()}" for name, preset in presets.PRESETS.items())
    shape.add_argument("--preset", type=_preset, metavar="NAME",
                       help=f"set the properties below as in a preset; those that are also given replace its values."
                            f" {names}")
    more = parser.add_argument_group("more properties of the filter")
    for place, (keyword, property_) in enumerate(properties().items()):
        group = shape if place < 3 else more
        property_ = property_._replace(choices=tuple(choice for choice in property_.choices if choice != "Mesh"))
        range_ = "" if property_.kind == "switch" else f"{property_.range}; "
        text = f"{_help_of(property_)} ({range_}default: {_default(property_)})"
        options = {"dest": keyword, "help": text}
        if property_.kind == "switch":
            group.add_argument(_option(keyword), action=argparse.BooleanOptionalAction, default=None, **options)
        elif property_.kind == "choice":
            group.add_argument(_option(keyword), metavar="NAME", **options)
        elif property_.kind == "vector":
            group.add_argument(_option(keyword), nargs=3, type=float, metavar=("X", "Y", "Z"), **options)
        else:
            kind = int if property_.kind == "integer" else float
            group.add_argument(_option(keyword), type=kind, metavar="N" if kind is int else "X", **options)
    arrays = parser.add_argument_group("point arrays of the models, by name")
    words = {"region": "where it is 0 the point stays", "roundness_factor": "multiplies --roundness",
             "target_directions": "directions to take in place of the sphere's",
             "normals": "normals, where no details are kept",
             "center_id": "points with the same number have a center of their own"}
    for keyword in ARRAYS:
        if keyword not in properties():
            arrays.add_argument(_option(keyword), metavar="ARRAY", dest=keyword, help=words[keyword])


def _preset(text):
    """For argparse, which says the message of this exception, and of no ValueError."""
    try:
        return presets.name_of(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error).partition(": ")[2]) from None


def _help_of(property_):
    """The first sentence of the class' documentation, in words of the command line."""
    text = property_.description.split(". ")[0].rstrip(".").replace("%", "%%")
    text = re.sub(r" \[\w+\]| \(default\)|(?<=\()default; ", "", text)  # labels of equations; the default follows
    for keyword, other in properties().items():
        if other is not property_:
            text = re.sub(rf"\b{other.name}\b", _option(keyword), text)
    return text


def _option(keyword):
    return "--" + keyword.replace("_", "-")


def _default(property_):
    if property_.keyword == "up_axis":
        others = [f"{axis} for {suffix}" for suffix, axis in UP_AXES.items()]
        return ", ".join([*others, f"{property_.default} for others"])
    if property_.kind == "switch":
        return "on" if property_.default else "off"
    if property_.kind == "vector":
        return " ".join(f"{x:g}" for x in property_.default)
    return f"{property_.default:g}" if property_.kind == "number" else str(property_.default)


class _Formatter(argparse.RawDescriptionHelpFormatter):
    def __init__(self, prog):
        super().__init__(prog, max_help_position=30, width=min(120, max(60, _columns() - 2)))


def _columns():
    try:
        return os.get_terminal_size().columns
    except OSError:
        return 102


class _Parser(argparse.ArgumentParser):
    """Says which option was meant."""

    def error(self, message):
        unknown = message.partition("unrecognized arguments: ")[2].split()
        options = [option for action in self._actions for option in action.option_strings]
        super().error(message + (closest(unknown[0], options) if unknown else ""))


def make_parser():
    """Also what the manual page is made of."""
    parser = _Parser(prog="sphericalstyle", description=DESCRIPTION, epilog=EPILOG, formatter_class=_Formatter,
                     allow_abbrev=False, usage="%(prog)s INPUT OUTPUT [options]\n"
                                               "       %(prog)s INPUT ... --output FOLDER [options]")
    parser.add_argument("paths", nargs="+", type=pathlib.Path, metavar="INPUT",
                        help="models, or folders of models; without --output the last one is the OUTPUT")
    parser.add_argument("--version", action="version",
                        version=f"%(prog)s {__version__}, VTK {vtkVersion.GetVTKVersion()}")
    files = parser.add_argument_group("files")
    files.add_argument("--output", type=pathlib.Path, metavar="FOLDER", help="folder for the results of any inputs")
    files.add_argument("--format", choices=[suffix[1:] for suffix in WRITERS], metavar="ENDING",
                       help="format of the results in a folder, such as ply (default: that of each model, or vtp where"
                            " it cannot be written)")
    files.add_argument("--recursive", action="store_true", help="also round the models in subfolders")
    files.add_argument("--picture", type=pathlib.Path, metavar="FILE",
                       help="write a PNG with the model beside the result; for several models a folder of PNGs")
    files.add_argument("--view", type=float, default=0.0, metavar="DEGREES",
                       help="turn the picture's camera around the up axis (default: %(default)g, from the front)")
    files.add_argument("--slider", action="store_true",
                       help="write the model itself with a slider that rounds it (morph targets); the result is .glb or"
                            " .gltf. A model of these formats keeps textures, skins and animations")
    files.add_argument("--html", type=pathlib.Path, metavar="FILE",
                       help="write a web page with the model, a slider and the presets, which needs no network; for"
                            " several models a folder of pages")
    files.add_argument("--report", type=pathlib.Path, metavar="FILE",
                       help="write properties, sizes, warnings and advice as .json, or the table as .csv")
    files.add_argument("--processes", type=int, metavar="N",
                       help="number of models at a time (default: one per processor)")
    files.add_argument("--quiet", action="store_true", help="print errors only")
    add_properties(parser)
    return parser


# ----------------------------------------------------------------------------------------------- what is to be done
def find_models(folder, output, recursive):
    """The sorted paths of the models, relative to the folder. Leaves out files in the output folder."""
    files = folder.rglob("*") if recursive else folder.glob("*")
    return sorted(file.relative_to(folder) for file in files
                  if file.suffix.lower() in READERS and file.is_file()
                  and output.resolve() not in file.resolve().parents)


def name_in_folder(model, format_=None):
    """The name of a result in a folder. A model in another format keeps its ending in front of the new one, so that
    bunny.ply does not replace bunny.stl."""
    suffix = f".{format_}" if format_ else model.suffix.lower() if model.suffix.lower() in WRITERS else ".vtp"
    return model if model.suffix.lower() == suffix else model.with_name(model.name + suffix)


def _plan(parser, arguments):
    """The jobs. Ends the program if the command is wrong."""
    inputs, output = arguments.paths, arguments.output
    if output is None:
        if len(inputs) != 2:
            parser.error("name one INPUT and an OUTPUT, or any number of INPUTs and --output FOLDER")
        inputs, output = inputs[:1], inputs[1]
    for path in inputs:
        if not path.exists():
            parser.error(f"{printable(path)}: no such file or folder")
    is_file = len(inputs) == 1 and not inputs[0].is_dir() and not output.is_dir() \
        and (arguments.output is None or output.suffix.lower() in WRITERS)
    if is_file:
        if output.suffix.lower() not in WRITERS:
            parser.error(cannot_write(output))
        if output.resolve() == inputs[0].resolve():
            parser.error("OUTPUT has to be another file than INPUT")
        if arguments.slider and not is_gltf(output):
            parser.error(f"--slider: {printable(output)} has to end in .glb or .gltf")
        if arguments.html and arguments.html.suffix.lower() not in PAGES:
            parser.error("--html: the name ends in .html")
        return [Job(str(inputs[0]), inputs[0], None, output, arguments.picture, arguments.html, arguments.slider)]
    return _plan_folder(parser, arguments, inputs, output)


def _plan_folder(parser, arguments, inputs, output):
    if output.suffix.lower() in WRITERS and not output.is_dir() or output.is_file():
        parser.error(f"{printable(output)}: several models need a folder for the results")
    where = "with --output" if arguments.output else "for several models"
    if arguments.picture and arguments.picture.suffix:
        parser.error(f"--picture: give a folder, not a file, {where}")
    if arguments.html and arguments.html.suffix:
        parser.error(f"--html: give a folder, not a file, {where}")
    if arguments.slider and arguments.format not in (None, "glb", "gltf"):
        parser.error("--slider: the format is glb or gltf")
    jobs, taken = [], {}
    for path in inputs:
        models = find_models(path, output, arguments.recursive) if path.is_dir() else [pathlib.Path(path.name)]
        for model in models:
            source = path / model if path.is_dir() else path
            format_ = "glb" if arguments.slider and not is_gltf(model) else None
            name = name_in_folder(model, arguments.format or format_)
            if name in taken and source.resolve() == taken[name].resolve():
                parser.error(f"{printable(source)} is named twice")
            if name in taken:
                parser.error(f"{printable(source)} and {printable(taken[name])} would both be written to"
                             f" {printable(output / name)}")
            if (output / name).resolve() == source.resolve():
                parser.error(f"{printable(source)}: the result would replace the model; name another folder")
            taken[name] = source
            picture = arguments.picture and arguments.picture / (str(model) + ".png")
            page = arguments.html and arguments.html / (str(model) + ".html")
            jobs.append(Job(model.as_posix() if len(inputs) == 1 else str(source), source, output, name, picture, page,
                            arguments.slider))
    if not jobs:
        inside = output.resolve() in [inputs[0].resolve(), *inputs[0].resolve().parents]
        parser.error(f"{printable(inputs[0])}: " + (f"is in the folder of the results, {printable(output)}, whose models"
                                                    " are left out; name another folder" if inside
                                                    else f"no models ({' '.join(sorted(READERS))})"))
    return jobs


# --------------------------------------------------------------------------------------------------- one model
def round_one(job, keywords, view=0.0, progress=None):
    """Rounds one model. Returns its line of the table, with what a report has besides."""
    start = time.perf_counter()
    keywords = {"up_axis": up_axis_of(job.source)} | keywords
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        surface = read(job.source)
        target = place_in(job.folder, job.target) if job.folder else job.target
        style, messages = execute(surface, progress=progress, **keywords)
        messages.warn()
        result = style.GetOutput()
        if job.slider:
            write_slider(target, job.source if is_gltf(job.source) else surface, **keywords)
        else:
            write(target, result)
        if job.page:
            job.page.parent.mkdir(parents=True, exist_ok=True)
            write_page(job.page, surface, title=job.source.stem, **keywords)
    if job.picture:
        from .model_pictures import before_after  # the program starts without OpenGL

        job.picture.parent.mkdir(parents=True, exist_ok=True)
        with whole(job.picture) as part:
            before_after(part, surface, style, "xyz"[style.GetUpAxis()], view, keywords.get("preset"))
    return {"points": surface.GetNumberOfPoints(),
            "new points": result.GetNumberOfPoints() - surface.GetNumberOfPoints(),
            "largest move": f"{largest_move(result):.4g}",
            "seconds": f"{time.perf_counter() - start:.2f}", "result": "rounded", "output": str(target),
            "warnings": list(dict.fromkeys(str(warning.message) for warning in told)), "advice": style.GetAdvice() or "",
            "folds": style.GetFoldSummary() or "", "up_axis": "XYZ"[style.GetUpAxis()],
            "center": list(style.GetEffectiveCenter()), "radius": style.GetEffectiveRadius()}


def _try(job, keywords, view, progress=None):
    try:
        line = round_one(job, keywords, view, progress)
    except (Error, OSError, ValueError, TypeError) as error:
        line = {"result": "\n".join(map(printable, str(error).splitlines()))}
    return {"model": _name_for_tables(job.name)} | line


def _name_for_tables(name):
    """The model's path, changed if a spreadsheet would take it for a formula."""
    return "./" + name if name[0] in "=+-@\t\r" else name


def _work(job, keywords, view, connection):
    """Runs in its own process, so that a reader that crashes does not affect other models."""
    connection.send(_try(job, keywords, view))


class Running:
    """A model that is rounded in a process of its own. receiver: ready to be read when the process has ended."""

    def __init__(self, job, keywords, view=0.0):
        context = multiprocessing.get_context("fork")  # spawning does not work in pvpython
        self.job = job
        self.receiver, sender = context.Pipe(duplex=False)
        self.process = context.Process(target=_work, args=(job, keywords, view, sender))
        self.process.start()
        sender.close()

    def line(self):
        """Waits for the end. A process that did not get that far makes a line, too, with "again" in it."""
        try:
            line = self.receiver.recv()
            self.process.join()
        except EOFError:
            self.process.join()
            line = {"model": _name_for_tables(self.job.name), "again": True,
                    "result": f"broke off with exit code {self.process.exitcode}"}
        self.receiver.close()
        return line


def share_processors(programs):
    """Takes as many threads for each program as there are processors for it."""
    threads = max(1, len(os.sched_getaffinity(0)) // programs)
    os.environ.setdefault("VTK_SMP_MAX_THREADS", str(threads))


def round_all(jobs, keywords, processes, view=0.0):
    """Yields (job, line of the table), in the order in which they are finished. The processes share the processors."""
    share_processors(min(processes, max(1, len(jobs))))
    waiting, running = list(reversed(jobs)), []
    while waiting or running:
        while waiting and len(running) < processes:
            running.append(Running(waiting.pop(), keywords, view))
        ready = multiprocessing.connection.wait([one.receiver for one in running])
        for one in [one for one in running if one.receiver in ready]:
            running.remove(one)
            yield one.job, one.line()


# ------------------------------------------------------------------------------------------------------- results
def print_table(lines):
    """A line for each model."""
    rows = [COLUMNS] + [[printable(line.get(column, "")) for column in COLUMNS[:-1]]
                        + [" ".join(line["result"].split())] for line in lines]
    widths = [max(len(row[k]) for row in rows) for k in range(len(COLUMNS) - 1)]
    for row in rows:
        cells = [row[0].ljust(widths[0])] + [cell.rjust(w) for cell, w in zip(row[1:-1], widths[1:])]
        print("  ".join(cells + row[-1:]))


def write_table(path, lines):
    """The table as CSV."""
    with whole(path) as part:
        # File names are bytes; write them unchanged.
        with open(part, "w", newline="", encoding="utf-8", errors="surrogateescape") as file:
            table = csv.DictWriter(file, COLUMNS, extrasaction="ignore")
            table.writeheader()
            table.writerows(lines)


def _write_report(path, lines, keywords):
    if path.suffix.lower() == ".csv":
        write_table(path, lines)
        return
    style = make(**keywords)
    values = {}
    for keyword, property_ in properties().items():
        value = getattr(style, "Get" + property_.name)()
        values[keyword] = property_.choices[value] if property_.choices else value
    if "up_axis" not in keywords:
        values["up_axis"] = None  # each model has its own
    models = []
    for line in lines:
        model = {key.replace(" ", "_"): value for key, value in line.items()}
        for key in ("largest_move", "seconds"):
            if key in model:
                model[key] = float(model[key])
        models.append(model)
    report = {"sphericalstyle": __version__, "vtk": vtkVersion.GetVTKVersion(),
              "preset": keywords.get("preset"), "properties": values,
              "arrays": {keyword: keywords[keyword] for keyword in ARRAYS if isinstance(keywords.get(keyword), str)},
              "models": models}
    with whole(path) as part:
        part.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")


class _Progress:
    """A bar on a terminal."""

    def __init__(self, name):
        self.name, self.shown = name, None

    def __call__(self, share):
        percent = int(100 * share)
        if percent != self.shown:
            bar = ("#" * (percent // 4)).ljust(25)
            sys.stderr.write(f"\r{self.name} [{bar}] {percent} %")
            sys.stderr.flush()
            self.shown = percent

    def end(self):
        if self.shown is not None:
            sys.stderr.write("\r\x1b[K")
            self.shown = None


def _say_warnings(line):
    for warning in line.get("warnings", []):
        print(f"{printable(line['model'])}: warning: {warning}", file=sys.stderr)


def _run_one(job, keywords, arguments):
    progress = None if arguments.quiet or not sys.stderr.isatty() else _Progress(printable(job.source.name))
    line = _try(job, keywords, arguments.view, progress)
    if progress:
        progress.end()
    if line["result"] != "rounded":
        print(line["result"], file=sys.stderr)
        return [line]
    if not arguments.quiet:
        _say_warnings(line)
        print(f"{printable(line['output'])}: {line['points'] + line['new points']} points, moved by up to"
              f" {line['largest move']}, {line['seconds']} s")
        for key in ("folds", "advice"):
            if line[key]:
                print(f"{key.capitalize()}: {line[key]}")
    return [line]


def _run_many(jobs, keywords, arguments):
    lines = []
    for job, line in round_all(jobs, keywords, arguments.processes, arguments.view):
        lines.append(line)
        text = f"{printable(job.name)}: {line['result']}"
        if line["result"] != "rounded" and arguments.quiet:
            print(text, file=sys.stderr)
        elif not arguments.quiet:
            _say_warnings(line)
            print(f"[{len(lines)}/{len(jobs)}] {text}", flush=True)
    lines.sort(key=lambda line: line["model"])
    if not arguments.quiet:
        print()
        print_table(lines)
        print(f"\n{sum(line['result'] == 'rounded' for line in lines)} of {len(lines)} models rounded")
    return lines


def keywords_of(parser, arguments):
    """What round() is called with. Ends the program if a value is out of range."""
    names = ["preset", *properties(), *ARRAYS]
    keywords = {name: value for name, value in vars(arguments).items() if name in names and value is not None}
    if keywords.get("target", "").lower() == "mesh":
        parser.error("--target Mesh needs a second model, which ParaView and Python take and this program does not")
    try:
        execute(_tetrahedron(), **{name: value for name, value in keywords.items() if name not in ARRAYS
                                   or name in properties()})
    except Error:
        pass  # of the tetrahedron
    except (ValueError, TypeError) as error:
        name, _, rest = str(error).partition(" ")
        parser.error(f"{_option(name)} {rest}" if name in names else str(error))
    return keywords


def _tetrahedron():
    """A model to try properties with: the filter itself looks at those that have no bounds in VTK."""
    surface = vtkPolyData()
    points, cells = vtkPoints(), vtkCellArray()
    for point in ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)):
        points.InsertNextPoint(point)
    for face in ((0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)):
        cells.InsertNextCell(3, face)
    surface.SetPoints(points)
    surface.SetPolys(cells)
    return surface


def _without_exponents(argument):
    """-1e-3 as -0.001: argparse would take it for an option."""
    number = re.fullmatch(r"-(\d+\.?\d*|\.\d+)[eE][-+]?\d{1,3}", argument)
    return f"{decimal.Decimal(argument):f}" if number else argument


def main(argv=None):
    """@return the exit code"""
    parser = make_parser()
    arguments = parser.parse_args([_without_exponents(argument) for argument in (sys.argv[1:] if argv is None else argv)])
    keywords = keywords_of(parser, arguments)
    if arguments.processes is None:
        arguments.processes = len(os.sched_getaffinity(0))
    if arguments.processes < 1:
        parser.error("--processes: at least 1")
    if arguments.report and arguments.report.suffix.lower() not in (".json", ".csv"):
        parser.error("--report: the name ends in .json or .csv")
    jobs = _plan(parser, arguments)
    if arguments.picture and not jobs[0].folder and arguments.picture.suffix.lower() != ".png":
        parser.error("--picture: the name ends in .png")
    if not jobs[0].folder and not jobs[0].target.parent.is_dir():
        parser.error(f"{printable(jobs[0].target)}: there is no folder {printable(jobs[0].target.parent)}")
    try:
        if arguments.picture:
            from .model_pictures import check_display  # fails before the work is done

            check_display()
        for folder in filter(None, [jobs[0].folder, arguments.report and arguments.report.parent]):
            folder.mkdir(parents=True, exist_ok=True)
        lines = (_run_many if jobs[0].folder else lambda jobs, *rest: _run_one(jobs[0], *rest))(
            jobs, keywords, arguments)
        if arguments.report:
            _write_report(arguments.report, lines, keywords)
    except (Error, OSError) as error:  # of a folder, the report or the display
        print(printable(error), file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    return 0 if all(line["result"] == "rounded" for line in lines) else 1
