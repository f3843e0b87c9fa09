# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Experiments, their sections in the report, and the pages made from them.

A chapter is a file of functions like this one:

    @experiment("A4.15", title="A shape like a ball", where="4.5.1, Fig. 4.3-4.4",
                claim="The larger the roundness, the rounder the model.")
    def sphere_like(section, context):
        surface = context.model("perturbed-icosphere")
        ...
        section.picture("Results", [(surface, "model"), (rounded, "λ = 0.5")])
        section.table("Roundness", ["λ", "asphericity"], rows)
        section.check(falling, "asphericity falls with λ", f"{first:.3f} to {last:.3f}")

Decorating registers the function. The verdict of every row follows from the section's checks: all
true "holds", some "holds in part", none "does not hold". If checks cannot decide, the function
returns section.verdict(kind, why). An exception marks the section as "failed"; the others still run.
"""
import csv
import html
import math
import re
import time
import traceback

import pictures
import plots
from sphericalstyle import model_files

HOLDS, IN_PART, FAILS = "holds", "holds in part", "does not hold"
NOT_REPRODUCED = "not reproduced"  # out of scope, or without the filter or model it needs
FAILED = "failed"  # the experiment stopped with an error
KINDS = [HOLDS, IN_PART, FAILS, NOT_REPRODUCED, FAILED]

EXPERIMENTS = []


class Experiment:
    """The arguments of the decorator, and the function."""

    def __init__(self, rows, title, where, needs, function):
        self.rows = rows  # row id -> statement of the thesis
        self.title = title
        self.where = where
        self.needs = needs
        self.function = function

    @property
    def chapter(self):
        return chapter_of(next(iter(self.rows)))

    @property
    def anchor(self):
        return slug(next(iter(self.rows)))


def experiment(*ids, title, where, claim, needs=()):
    """Register a function(section, context).

    ids: row ids as "A4.15"; several where one experiment answers several rows.
    where: section, figures and equations of the thesis.
    claim: what the thesis says there, in our words: one text for all rows, or {id: text}.
    needs: names of classes of the package; without one of them the section says so and ends.
    """
    rows = {i: claim[i] if isinstance(claim, dict) else claim for i in ids}

    def register(function):
        known = {row for other in EXPERIMENTS for row in other.rows}
        if known & set(rows):
            raise ValueError(f"registered twice: {sorted(known & set(rows))}")
        EXPERIMENTS.append(Experiment(rows, title, where, needs, function))
        return function

    return register


def chapter_of(row):
    """'4' of 'A4.15'; the rows A8 are the errata."""
    chapter = re.match(r"A(\d+)\.", row).group(1)
    return "errata" if chapter == "8" else chapter


def order_of(row):
    return [int(number) for number in re.findall(r"\d+", row)]


def slug(text):
    return re.sub(r"[^a-z0-9.]+", "-", text.lower()).strip("-.")


# ------------------------------------------------------------------------------------------ sections
class Section:
    """The section of one experiment. Its parts appear in the order of the calls."""

    def __init__(self, experiment, folder):
        self.experiment = experiment
        self.folder = folder
        self.parts = []  # HTML
        self.checks = []  # (holds, statement, found, row or None)
        self.verdicts = {}  # row -> (kind, why)
        self.seconds = 0.0
        self.message = ""  # of an error
        self.names = set()

    def text(self, text):
        """A paragraph, plain text."""
        self.parts.append(f"<p>{html.escape(text)}</p>")

    def picture(self, name, panels, array=None, range=None, view=25.0, up="y", caption="",
                columns=None, wires=False):
        """Surfaces side by side, all in one scale.

        panels: [(surface, label)] or rows of such lists; a panel may go on (surface, label, lines)
        and (surface, label, lines, view) as in model_pictures.image_of. columns: where to break one long row.
        array: name of a point or cell array of one component to color by; "TCoords" for a checker
        by the texture coordinates. Panels without it stay in clay. range: (low, high), default the
        array's; diverging colors if it is symmetric about zero. wires: draw the edges too.
        """
        rows = panels if isinstance(panels[0], list) else [panels]
        if len(rows) == 1:
            step = columns or (3 if len(panels) in (5, 6) else 4)
            rows = [rows[0][i:i + step] for i in _steps(len(rows[0]), step)]
        file = self._file("pictures", name, ".png")
        bar = pictures.write(self.folder / file, rows, array, range, view, up, wires)
        self._figure(file, name, caption, bar)

    def image(self, name, data, caption=""):
        """A vtkImageData of unsigned char or one component, magnified to the page's width."""
        file = self._file("pictures", name, ".png")
        pictures.write_image(self.folder / file, data)
        self._figure(file, name, caption)

    def plot(self, name, series, x="", y="", logx=False, logy=False, equal=False, caption=""):
        """Curves. series: {label: (xs, ys)} or {label: ys} over 0, 1, 2, ...; a CSV comes along.
        Or {panel title: {label: ...}} for panels side by side. equal: one scale for x and y."""
        file = self._file("plots", name, ".svg")
        lines = plots.write(self.folder / file, series, x, y, logx, logy, equal)
        data = self._csv(name, [x or "x", "series", y or "y"], lines)
        self._figure(file, name, caption, link=data)

    def table(self, name, columns, rows, caption=""):
        """A table on the page, and all digits in a CSV. Cells: text, numbers, or None for none."""
        rows = [[_plain(cell) for cell in row] for row in rows]
        for row in rows:
            if len(row) != len(columns):
                raise ValueError(f"{name}: {len(row)} cells in {len(columns)} columns: {row}")
        data = self._csv(name, columns, rows)
        head = "".join(f"<th>{html.escape(str(column))}</th>" for column in columns)
        body = "".join("<tr>" + "".join(_cell(cell) for cell in row) + "</tr>" for row in rows)
        text = f"{html.escape(caption)}. " if caption else ""
        self.parts.append(f'<p class="caption"><b>{html.escape(name)}.</b> {text}'
                          f'<a class="data" href="{data}">CSV</a></p><div class="wide"><table>'
                          f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>")

    def check(self, holds, statement, found="", row=None):
        """A part of the verdict: a statement with its threshold, what was found (with numbers), and
        whether it holds, computed by the caller. row: of this row only. Returns holds."""
        if row is not None and row not in self.experiment.rows:
            raise ValueError(f"{row} is no row of this section")
        self.checks.append((bool(holds), statement, str(found), row))
        return bool(holds)

    def verdict(self, kind=None, why="", row=None):
        """The verdict of one row, or of all that have none yet. kind: HOLDS, IN_PART, FAILS or
        NOT_REPRODUCED, computed by the caller; default: what the checks say."""
        for name in [row] if row else self.experiment.rows:
            if row or name not in self.verdicts:
                self.verdicts[name] = (kind or self._kind_of(name), why)

    def _kind_of(self, row):
        results = [holds for holds, _, _, of in self.checks if of in (None, row)]
        if not results:
            raise ValueError(f"{row}: no check and no verdict")
        return HOLDS if all(results) else IN_PART if any(results) else FAILS

    def failed(self, message):
        self.message = message
        self.verdicts = {row: (FAILED, message.strip().splitlines()[-1])
                         for row in self.experiment.rows}

    # -- files and figures
    def _file(self, folder, name, ending):
        name = f"{self.experiment.anchor}-{slug(name)}"
        if (folder, name) in self.names:
            raise ValueError(f"{name}: two {folder} of one name")
        self.names.add((folder, name))
        file = f"{folder}/{name}{ending}"
        model_files.place_in(self.folder, file)
        return file

    def _csv(self, name, columns, rows):
        file = self._file("numbers", name, ".csv")
        with open(self.folder / file, "w", newline="", encoding="utf-8") as stream:
            lines = csv.writer(stream)
            lines.writerow(columns)
            lines.writerows(rows)
        return file

    def _figure(self, file, name, caption, bar="", link=""):
        link = f' <a class="data" href="{link}">CSV</a>' if link else ""
        text = f"<b>{html.escape(name)}.</b> {html.escape(caption)}{link}"
        self.parts.append(f'<figure><img src="{file}" alt="{html.escape(name)}" loading="lazy">'
                          f"<figcaption>{text}{bar}</figcaption></figure>")

    # -- HTML
    def html(self):
        e = self.experiment
        rows = "".join(
            f'<tr id="{row}"><th>{row}</th><td>{html.escape(claim)}</td>'
            f"<td>{badge(self.verdicts[row][0])}</td></tr>" for row, claim in e.rows.items())
        checks = "".join(
            f'<tr><td class="{"yes" if holds else "no"}">{"✓" if holds else "✗"}</td>'
            f"<td>{html.escape(statement)}{f' ({row})' if row and len(e.rows) > 1 else ''}</td>"
            f"<td>{html.escape(found)}</td></tr>" for holds, statement, found, row in self.checks)
        if checks:
            checks = ("<table class='checks'><thead><tr><th></th><th>Checked</th><th>Found</th></tr>"
                      f"</thead><tbody>{checks}</tbody></table>")
        reasons = dict.fromkeys(why for _, why in self.verdicts.values() if why)
        why = "".join(f'<p class="why">{html.escape(text)}</p>' for text in reasons)
        message = f"<pre>{html.escape(self.message)}</pre>" if self.message else ""
        return (f'<section id="{e.anchor}"><h2>{", ".join(e.rows)}: {html.escape(e.title)}</h2>'
                f'<p class="where">Thesis {html.escape(e.where)}</p>'
                f'<table class="claims"><thead><tr><th>Row</th><th>The thesis</th><th>Verdict</th>'
                f"</tr></thead><tbody>{rows}</tbody></table>"
                f'{"".join(self.parts)}{checks}{why}{message}'
                f'<p class="time">{self.seconds:.1f} s</p></section>')


def _steps(count, step):
    return range(0, count, step)


def _plain(value):
    """Converts a numpy number to a Python number."""
    return value.item() if hasattr(value, "item") else value


def _cell(value):
    if isinstance(value, bool):
        value = "yes" if value else "no"
    if value is None:
        return "<td></td>"
    if isinstance(value, (int, float)):
        return f'<td class="number">{number(value)}</td>'
    return f"<td>{html.escape(str(value))}</td>"


def number(value):
    """Four digits, and plain zeros where a power of ten would only confuse."""
    if isinstance(value, int):
        return f"{value:,}"
    if not math.isfinite(value):
        return "not finite"
    return f"{value:.4g}"


def badge(kind):
    return f'<span class="badge {slug(kind)}">{kind}</span>'


# ----------------------------------------------------------------------------------------------- run
def run(experiment, context, folder):
    """Runs one experiment and returns its section, even if the experiment fails."""
    section = Section(experiment, folder)
    start = time.perf_counter()
    missing = [name for name in experiment.needs if not context.has(name)]
    try:
        if missing:
            section.verdict(NOT_REPRODUCED, f"not built: {', '.join(missing)}")
        else:
            experiment.function(section, context)
            section.verdict()
    except model_files.ModelError as error:
        section.failed(str(error))
    except Exception:  # noqa: BLE001, a report is written whatever an experiment does
        section.failed(traceback.format_exc())
    section.seconds = time.perf_counter() - start
    return section


# --------------------------------------------------------------------------------------------- pages
TITLES = {
    "2": "Chapter 2: related methods",
    "3": "Chapter 3: nonlinear spherical feature",
    "4": "Chapter 4: linear spherical feature",
    "5": "Chapter 5: convex proxy",
    "errata": "Errata",
}

STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.5 Georgia, 'DejaVu Serif', serif; color: #222; max-width: 62rem; margin: 0 auto;
  padding: 1rem 1.5rem 4rem; }
h1, h2, th, nav, .badge, .data, .time, figcaption, .caption { font-family: Helvetica, Arial,
  'DejaVu Sans', sans-serif; }
h1 { font-size: 1.7rem; } h2 { font-size: 1.2rem; margin: 0 0 .3rem; }
section { border-top: 1px solid #ccc; padding-top: 1.2rem; margin-top: 2.2rem; }
nav { font-size: .9rem; } nav a { margin-right: 1.2em; }
a { color: #1b5a93; }
.where, .time { color: #666; font-size: .9rem; margin: .2rem 0 .6rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: .8rem 0; font-size: .88rem; }
.caption { margin: 1rem 0 -.5rem; break-after: avoid; }
th, td { border-bottom: 1px solid #ddd; padding: .22rem .7rem .22rem 0; text-align: left;
  vertical-align: top; }
thead th { border-bottom: 2px solid #888; }
td.number { font-variant-numeric: tabular-nums; text-align: right; }
.claims, .checks, .overview { width: 100%; }
.claims th:first-child, .overview th:first-child { width: 4rem; }
.overview th:nth-child(2) { width: 45%; }
.claims th:last-child, .overview th:last-child, .claims td:last-child, .overview td:last-child { white-space: nowrap; text-align: right;
  padding-right: 0; }
figure { margin: 1.2rem 0; break-inside: avoid; }
img { max-width: 100%; height: auto; }
figcaption, .caption { font-size: .85rem; color: #444; }
.bar { display: block; margin-top: .2rem; }
.badge { font-size: .78rem; padding: .08em .55em; border-radius: .8em; white-space: nowrap;
  border: 1px solid currentColor; }
.holds, .yes { color: #1a6b2d; } .holds-in-part { color: #8a5a00; } .does-not-hold, .no,
.failed { color: #a11616; } .not-reproduced { color: #555; }
.failed { font-weight: bold; }
.data { font-weight: normal; font-size: .8rem; }
pre { background: #f6f2ee; padding: .6rem; overflow-x: auto; font-size: .8rem; }
@media print { body { max-width: none; font-size: 10pt; } nav { display: none; }
  section { break-before: auto; } a { color: inherit; text-decoration: none; }
  .wide { overflow: visible; } }
"""


def page(title, body, navigation):
    return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width">'
            f"<title>{html.escape(title)}</title><style>{STYLE}</style></head><body>"
            f"<nav>{navigation}</nav><h1>{html.escape(title)}</h1>{body}</body></html>\n")


def chapter_file(chapter):
    return "errata.html" if chapter == "errata" else f"chapter-{chapter}.html"


def write(folder, sections, facts):
    """index.html and a page per chapter. facts: [(name, value)] of this run."""
    chapters = {}
    for section in sections:
        chapters.setdefault(section.experiment.chapter, []).append(section)
    links = "".join(f'<a href="{chapter_file(c)}">{html.escape(TITLES[c].split(":")[0])}</a>'
                    for c in chapters)
    navigation = f'<a href="index.html">Overview</a>{links}'
    for chapter, members in chapters.items():
        contents = "".join(
            f'<li><a href="#{s.experiment.anchor}">{", ".join(s.experiment.rows)}: '
            f"{html.escape(s.experiment.title)}</a></li>" for s in members)
        body = f"<ul>{contents}</ul>" + "".join(section.html() for section in members)
        with model_files.whole(folder / chapter_file(chapter)) as part:
            part.write_text(page(TITLES[chapter], body, navigation), encoding="utf-8")
    with model_files.whole(folder / "index.html") as part:
        part.write_text(page("The experiments of the thesis, reproduced", overview(chapters, facts), navigation),
                        encoding="utf-8")


INTRODUCTION = """
<p>Every experiment and claim of chapters 2 to 5 of the doctoral thesis <i>Research of Spherical
Style Deformation on Single Component Models</i>, reproduced with this project's filters, and the
mistakes found in its formulas. The models of the thesis are not available; generated shapes replace
them, and real models where a section names one. Where a section says "to the letter", the filter
ran with <code>ReproduceThesis</code>; otherwise it minimizes the half-edge energy, with the uniform
weights and the center of the thesis and the settings named there.</p>
<p>Each row below is one claim or experiment. Verdicts are computed from the numbers of this run:
<i>holds</i> if every check of the row is met, <i>holds in part</i> if some are, <i>does not hold</i>
if none is. In the errata, the claim is what the thesis says or implies, and <i>does not hold</i>
confirms the mistake. A row that is <i>not reproduced</i> names the reason; <i>failed</i> means that the
experiment stopped with an error message.</p>
"""


def overview(chapters, facts):
    rows = [(row, section) for members in chapters.values() for section in members
            for row in section.experiment.rows]
    counts = [(kind, sum(s.verdicts[row][0] == kind for row, s in rows)) for kind in KINDS]
    summary = ", ".join(f"{count} {badge(kind)}" for kind, count in counts if count)
    told = "".join(f"<tr><th>{html.escape(name)}</th><td>{html.escape(str(value))}</td></tr>"
                   for name, value in facts)
    parts = [INTRODUCTION, f"<p>{len(rows)} rows: {summary}.</p>", f"<table>{told}</table>"]
    for chapter, members in chapters.items():
        file = chapter_file(chapter)
        lines = "".join(
            f'<tr><th><a href="{file}#{row}">{row}</a></th><td>{html.escape(s.experiment.title)}'
            f"</td><td>{html.escape(s.experiment.where)}</td><td>{badge(s.verdicts[row][0])}</td></tr>"
            for row, s in sorted(((row, s) for s in members for row in s.experiment.rows),
                                 key=lambda pair: order_of(pair[0])))
        parts.append(f'<h2><a href="{file}">{html.escape(TITLES[chapter])}</a></h2>'
                     '<table class="overview"><thead><tr><th>Row</th><th>Experiment</th>'
                     f"<th>Thesis</th><th>Verdict</th></tr></thead><tbody>{lines}</tbody></table>")
    return "".join(parts)
