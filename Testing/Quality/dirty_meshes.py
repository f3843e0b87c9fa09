# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Dirty meshes: what spoils the mesh must not spoil the result.

66 variants of six clean models, made with fixed seeds, rounded by the thesis, with details kept and with the defaults,
and compared with the result of the clean model at the points that both have. Ways to spoil: dirt.py; figures: README.md.
"""
import zlib

import numpy as np

import dirt
import measures
import surfaces

MODELS = ("creature", "go-stone", "bottle", "snowman", "icosahedron", "cube")
CASES = {"thesis": {**surfaces.THESIS, "Roundness": 0.5},
         "closed form": {"Roundness": 0.5, "NormalBlend": 0.0, "DetailSize": 0.03}, "defaults": {}}
BOUND = 0.002  # largest difference, a fraction of the diagonal
# What exceeds it, and why: {way: (why, {case: bound})}.
EXCEPTIONS = {
    "hole": ("a piece of the surface is missing, and base, center and area with it",
             {"thesis": 0.0027, "closed form": 0.021, "defaults": 0.0291}),
    "holes": ("a piece of the surface is missing, and a ray that looks for a wall can pass it",
              {"thesis": 0.0031, "closed form": 0.005, "defaults": 0.0139}),
    "slit": ("a piece of the surface is missing", {"thesis": 0.0065, "closed form": 0.028, "defaults": 0.04}),
    "detached": ("the gap alone is 0.003, and a ray that looks for a wall can pass it",
                 {"thesis": 0.004, "closed form": 0.0045, "defaults": 0.011}),
    "three_detached": ("as detached", {"defaults": 0.011}),
    "caps": ("the grid and the rays look at other samples of the same surface, and KeepSize at the area of slivers",
             {"defaults": 0.011}),
    # The cube differs by .11 with GCC 12 and by .17 with GCC 16, so this bounds the length and no more.
    "scaled": ("needles, thinner than a cell of the grid: which way they turn about their axis is left to rounding",
               {"closed form": 0.2, "defaults": 0.2}),
}
COLUMNS = ["kind", "variant", "model", "parts", "case", "spike", "median", "largest"]


def clean_model(name):
    """Coincident points of a texture seam as one."""
    x, F = surfaces.read(surfaces.ROOT / "Data" / f"{name}.vtp")
    used, W = np.unique(measures.weld(x, F), return_inverse=True)
    return x[used], W.reshape(-1, 3)


def difference(clean, dirty, variant, length):
    """Of the results at each common point, fractions of the diagonal."""
    shift = np.broadcast_to(variant.shift, clean.x.shape)
    return np.linalg.norm(
        dirty.x[variant.at] - clean.x[variant.kept] - shift[variant.kept], axis=1) / length


def measured(variant, mesh, properties, cache, case):
    """(spike, median, largest); NaN where there is no result. cache: {case: clean result}."""
    if variant.clean:
        mesh = variant.clean
        clean = surfaces.Result(*mesh, properties)
    else:
        if case not in cache:
            cache[case] = surfaces.Result(*mesh, properties)
        clean = cache[case]
    dirty = surfaces.Result(variant.x, variant.F, properties)
    without_size = surfaces.Result(variant.x, variant.F, {**properties, "KeepSize": 0})
    used = np.unique(dirty.F)
    factor = measures.diagonal(dirty.x[used]) / measures.diagonal(without_size.x[used])
    spike = measures.spike(variant.x, dirty.x[:len(variant.x)], np.unique(variant.F), dirty.center, dirty.radius,
                           factor)
    d = difference(clean, dirty, variant, measures.diagonal(mesh[0]))
    return spike, np.median(d), d.max()


def main():
    parser = surfaces.parser(__doc__)
    parser.add_argument("names", nargs="*", default=MODELS, help="models of Data/")
    arguments = parser.parse_args()
    properties = dict(arguments.set)
    check = surfaces.Checks()
    table = []
    for name in arguments.names:
        mesh = clean_model(name)
        cache = {}
        for kind, ways in dirt.KINDS.items():
            for way in ways:
                seed = zlib.crc32(f"{name} {way.__name__}".encode())
                variant = way(*mesh, np.random.RandomState(seed))
                parts = measures.component_ids(
                    len(variant.x), measures.weld(variant.x, variant.F)).max() + 1
                for case, settings in CASES.items():
                    table.append(dict(zip(COLUMNS, [
                        kind, way.__name__, name, parts, case,
                        *measured(variant, mesh, {**settings, **properties}, cache, case)])))
    report(table)
    for line in table:
        judge(check, line)
    if arguments.output:
        surfaces.write_table(arguments.output, "dirty-meshes.csv", COLUMNS, table)
    check.exit()


def judge(check, line):
    why, known = EXCEPTIONS.get(line["variant"], ("", {}))
    bound = known.get(line["case"], BOUND)
    check(line["spike"] < 1.5 and line["largest"] <= bound,
          "{model}, {variant}, {case}: spike {spike:.2f} and largest difference {largest:.5f} within ".format(**line)
          + f"1.5 and {bound:g} {why}")


def report(table):
    """Worst of each way to spoil."""
    for way in dict.fromkeys(row["variant"] for row in table):
        for case in CASES:
            rows = [row for row in table if row["variant"] == way and row["case"] == case]
            median, largest = (max(rows, key=lambda row: row[c]) for c in ("median", "largest"))
            print(f"  {way:15s} {case:11s} median {median['median']:8.5f} ({median['model']}), "
                  f"largest {largest['largest']:8.5f} ({largest['model']})")



main()
