# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Curves of the report, as SVG."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402, after the choice of its back end
import matplotlib.ticker as ticker  # noqa: E402
import numpy as np  # noqa: E402

matplotlib.rcParams.update({
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.grid": True,
    "font.size": 9.0,
    "grid.color": "#dddddd",
    "legend.frameon": False,
    "svg.hashsalt": "SphericalStyle",  # else ids differ from run to run
})
MARKERS_UP_TO = 12  # points; more would hide the line


def write(path, series, x, y, logx, logy, equal=False):
    """Draw {label: (xs, ys) or ys}, or {panel: {label: ...}}; returns the points as CSV rows."""
    panels = series if isinstance(next(iter(series.values())), dict) else {"": series}
    figure, all_axes = pyplot.subplots(1, len(panels), figsize=(max(5.6, 4.6 * len(panels)), 3.2),
                                       squeeze=False, layout="constrained")
    rows = []
    for axes, (title, curves) in zip(all_axes[0], panels.items()):
        for label, points in curves.items():
            xs, ys = points if isinstance(points, tuple) else (range(len(points)), points)
            xs, ys = np.asarray(xs, dtype=float), np.asarray(ys, dtype=float)
            marker = "o" if len(xs) <= MARKERS_UP_TO else None
            axes.plot(xs, ys, marker=marker, markersize=3.0, linewidth=1.3, label=label)
            name = f"{title}: {label}" if title else label
            rows += [(xv, name, yv) for xv, yv in zip(xs.tolist(), ys.tolist())]
        if x == "Iteration":
            axes.xaxis.set_major_locator(ticker.MaxNLocator(integer=True))
        axes.set_title(title, fontsize=9.5)
        axes.set_xlabel(x)
        axes.set_ylabel(y)
        if logx:
            axes.set_xscale("log")
        if logy:
            axes.set_yscale("log")
        if equal:
            axes.set_aspect("equal", "datalim")
        if len(curves) > 1 or not title:
            axes.legend()
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)
    return rows
