# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Which weights when: bad meshes under either edge and spherical weighting, and through the proxy.

The method of the thesis: without details and normals, in its own size. Uniform weights minimize the energy; what
cotangent ones lead to is known in closed form. Prints the table of SphericalStyleMethod.md, "Which weights when";
--pictures shows what is in it.
"""
import numpy as np

import measures
import surfaces

ROUNDNESS = 0.5
NAMES = ["house", "car", "wingnut", "goblet-vase", "lidar-sensor", "skull", "koala"]
UNIFORM, DELAUNAY = {"SphericalWeighting": 0}, {"EdgeWeighting": 2}
WEIGHTS = {
    "Uniform, HalfEdge": UNIFORM,
    "Uniform, IntrinsicDelaunay": {**UNIFORM, **DELAUNAY},
    "Cotangent": {},  # the same on any triangles
}
PROXY = "proxy"
COLUMNS = ["model", "weights", "fold change", "turned over", "iterations"]


def turned_over(x, y, F):
    """Triangles whose normals of before and after are more than 90 degrees apart."""
    return int((np.einsum("ij,ij->i", measures.crosses(x, F), measures.crosses(y, F)) < 0.0).sum())


def line(name, x, F, folds, weights, result):
    change = measures.fold_changes(folds, x, result.x, result.x)[0]
    return dict(zip(COLUMNS, [name, weights, change, turned_over(x, result.x, F), result.iterations]))


def path_of(name, folder):
    return surfaces.ROOT / "Data" / "stone-house.vtp" if name == "house" else folder / f"{name}.ply"


def markdown(table):
    """One row per model, its cases side by side."""
    heads = [row["weights"] for row in table if row["model"] == table[0]["model"]]
    print("| model | " + " | ".join(heads) + " |\n" + "|---" * (len(heads) + 1) + "|")
    for name in dict.fromkeys(row["model"] for row in table):
        cells = [f"{row['fold change']:.1f} ({row['turned over']})" for row in table if row["model"] == name]
        print(f"| {name} | " + " | ".join(cells) + " |")


def main():
    parser = surfaces.parser(__doc__)
    surfaces.add_models(parser)
    parser.add_argument("names", nargs="*", help="of " + ", ".join(NAMES))
    arguments = parser.parse_args()
    if not arguments.models.is_dir():
        surfaces.skip("no folder of models")
    properties = {**surfaces.THESIS, "Roundness": ROUNDNESS, **dict(arguments.set)}
    check = surfaces.Checks()
    table, panels = [], []
    for name in arguments.names or NAMES:
        x, F = surfaces.read(path_of(name, arguments.models))
        folds = measures.Folds(measures.weld(x, F))
        results = []
        for weights, settings in WEIGHTS.items():
            results.append(surfaces.Result(x, F, {**properties, **settings}))
            table.append(line(name, x, F, folds, weights, results[-1]))
        if surfaces.vtkConvexProxyDeformFilter:
            results.append(surfaces.ProxyResult(x, F))
            table.append(line(name, x, F, folds, PROXY, results[-1]))
        for result in results:
            check(np.isfinite(result.x).all() and result.converged, f"{name}: finite and converged")
        panels.append((name, x, F, results))
        print(f"  {name}: " + ", ".join(f"{row['weights']}: {row['fold change']:.1f}" for row in table
                                        if row["model"] == name), flush=True)
    markdown(table)
    if arguments.output:
        surfaces.write_table(arguments.output, "weights.csv", COLUMNS, table)
    if arguments.output and arguments.pictures:
        import pictures  # needs a display
        pictures.sheets(arguments.output, panels, [*WEIGHTS, PROXY])
    check.exit()


main()
