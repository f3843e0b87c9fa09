# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Tables and checks that several experiments share."""
import numpy as np

from context import history

METRICS = ("vtkSurfaceMetrics",)
RISE = 1e-10  # fraction of the first energy by which rounding may raise an energy


def energy_plot(section, name, runs, caption=""):
    """Total energy, and its change by the global step, as in Fig. 4.4. runs: {label: filter}."""
    tables = {label: history(run) for label, run in runs.items()}
    section.plot(name, {
        "Total energy": {label: table["Total"] for label, table in tables.items()},
        "Change by the global step": {
            label: (np.arange(1, len(table["Total"])), table["GlobalChange"][1:])
            for label, table in tables.items()},
    }, x="Iteration", y="Energy", caption=caption)


def largest_rise(run, column="GlobalChange"):
    """The largest change of the energy in any iteration, relative to the first energy."""
    table = history(run)
    changes = table[column][1:]
    return float(changes.max() / abs(table["Total"][0])) if len(changes) else 0.0


def check_descent(section, runs, row=None):
    """Every global step lowers the energy."""
    rises = [largest_rise(run) for run in runs]
    section.check(max(rises) <= RISE, f"No global step raises the energy (by {RISE:g} of it or more)",
                  f"largest change of any step {max(rises):.2g} of the first energy", row)


def check_monotone(section, values, statement, falling=True, row=None, digits=4):
    """Each value is below (above) the one before."""
    steps = np.diff(values)
    section.check((steps < 0).all() if falling else (steps > 0).all(), statement,
                  ", ".join(f"{value:.{digits}g}" for value in values), row)


MEASURED = {  # column of our tables: column of vtkSurfaceMetrics
    "sphericity": "Sphericity",
    "asphericity": "FittedSphereError",
    "area spread": "AreaRatioSpread",
    "intersecting": "SelfIntersectingTriangles",
    "turned over": "TurnedOver",
}
COUNTS = ("intersecting", "turned over")
EXPLAINED = ("Sphericity is 1 for a ball; asphericity is the rms distance to the fitted sphere over "
             "its radius; area spread is the standard deviation of the logarithm of the triangles' "
             "area ratios; intersecting and turned over are counts of triangles")


def result_table(section, context, name, surface, runs, caption=""):
    """A table with a row per run: measures compared with the model, and iterations. Returns {label: metrics}."""
    before = context.metrics(surface)
    results = {label: context.metrics(run.GetOutput(), surface) for label, run in runs.items()}
    rows = [["model", _finite(before["Sphericity"]), before["FittedSphereError"], None,
             int(before["SelfIntersectingTriangles"]), None, None]]
    for label, m in results.items():
        rows.append([label] + [
            int(m[column]) if name in COUNTS else _finite(m[column])
            for name, column in MEASURED.items()] + [runs[label].GetNumberOfIterations()])
    open_ = "" if np.isfinite(before["Sphericity"]) else ". An open surface has no sphericity"
    section.table(name, ["", *MEASURED, "iterations"], rows, caption or EXPLAINED + open_)
    return results


def _finite(value):
    return value if np.isfinite(value) else None
