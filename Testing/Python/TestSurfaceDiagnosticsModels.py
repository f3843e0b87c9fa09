# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the diagnosis says of real models is what another program has said of them: parts, borders and
obtuse triangles of the table in MODELS.md, beside the models.

usage: TestSurfaceDiagnosticsModels.py --models FOLDER   (exit code 77 without the models)
"""
import argparse
import os
import re
import sys

from vtkmodules.vtkIOPLY import vtkPLYReader

from sphericalstyle import vtkSurfaceDiagnostics

parser = argparse.ArgumentParser()
parser.add_argument("--models", required=True)
folder = parser.parse_args().models
table = os.path.join(folder, "MODELS.md")
if not os.path.exists(table):
    print("no models:", table)
    sys.exit(77)


def findings(name):
    reader, diagnostics = vtkPLYReader(), vtkSurfaceDiagnostics()
    reader.SetFileName(os.path.join(folder, f"{name}.ply"))
    diagnostics.SetInputConnection(reader.GetOutputPort())
    diagnostics.WeldCoincidentPointsOff()
    diagnostics.Update()
    rows = diagnostics.GetOutputDataObject(1)
    return {rows.GetValueByName(row, "Name").ToString():
            (rows.GetValueByName(row, "Count").ToInt(), rows.GetValueByName(row, "Value").ToDouble())
            for row in range(rows.GetNumberOfRows())}


checked = 0
for line in open(table, encoding="utf-8"):
    cells = [cell.strip() for cell in line.split("|")]
    if len(cells) < 13 or not cells[3].isdigit():
        continue
    name, closed, manifold, parts, loops, obtuse = (cells[k] for k in (1, 5, 6, 7, 8, 10))
    found = findings(name)
    assert found["Components"][0] == int(parts), (name, found["Components"], parts)
    assert found["BorderLoops"][0] == int(loops), (name, found["BorderLoops"], loops)
    assert (found["BorderEdges"][0] == 0) == (closed == "yes"), (name, found["BorderEdges"])
    # The table counts right angles that rounding has opened, too: drawings have some.
    less = float(obtuse) - 100.0 * found["ObtuseTriangles"][1]
    assert -0.06 < less < 1.0, (name, found["ObtuseTriangles"], obtuse)
    points = re.search(r"(\d+) nm verts", manifold)
    assert found["NonManifoldPoints"][0] == (int(points.group(1)) if points else 0), (name, found)
    assert found["NonManifoldEdges"][0] == 0 and found["NonFinitePoints"][0] == 0, (name, found)
    checked += 1
assert checked >= 10, checked
