# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in ParaView's window, beside a player: opens a model of two solids from an STL file, and one with colors from a
PLY file, which is then the active one."""
import pathlib
import tempfile

from paraview import simple

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
COLORS = [(250, 0, 0), (0, 250, 0), (0, 0, 250), (99, 99, 99)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def solid(name, x):
    facets = "".join("facet normal 0 0 0\nouter loop\n"
                     + "".join(f"vertex {POINTS[k][0] + x} {POINTS[k][1]} {POINTS[k][2]}\n" for k in face)
                     + "endloop\nendfacet\n" for face in FACES)
    return f"solid {name}\n{facets}endsolid {name}\n"


def ply():
    head = ["ply", "format ascii 1.0", f"element vertex {len(POINTS)}", *(f"property float {x}" for x in "xyz"),
            *(f"property uchar {color}" for color in ("red", "green", "blue")), f"element face {len(FACES)}",
            "property list uchar int vertex_indices", "end_header"]
    rows = [point + color for point, color in zip(POINTS, COLORS)] + [(3,) + face for face in FACES]
    return "\n".join(head + [" ".join(map(str, row)) for row in rows]) + "\n"


view = simple.GetActiveViewOrCreate("RenderView")
with tempfile.TemporaryDirectory() as folder:
    for name, text in (("solids.stl", solid("a", 0) + solid("b", 2)), ("colors.ply", ply())):
        path = pathlib.Path(folder) / name
        path.write_text(text, encoding="ascii")
        model = simple.OpenDataFile(str(path))
        display = simple.Show(model, view)  # reads it
        if path.suffix == ".stl":
            simple.ColorBy(display, ("CELLS", "STLSolidLabeling"))  # as ParaView does after Apply
simple.SetActiveSource(model)
simple.Render(view)
