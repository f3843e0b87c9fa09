# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Dirty meshes: what spoils the mesh must not spoil the result.

66 variants of six clean models, made with fixed seeds, rounded with and without details kept and compared with the
result of the clean model at the points that both have. Ways to spoil: dirt.py; figures: README.md.
"""
import zlib

import numpy as np

import dirt
import measures
import surfaces

MODELS = ("creature", "go-stone", "bottle", "snowman", "icosahedron", "cube")
DETAIL_SIZES = (0.0, 0.03)
# (median, largest) difference at most, fractions of the diagonal: without and with details kept.
BOUNDS = {
    "cut open": ((0.0045, 0.0075), (0.015, 0.07)),  # with details kept the borders of a slit part
    "parts detached": ((0.0003, 0.0045), (0.0065, 0.018)),
    "slivers": ((1e-5, 1e-5), (0.0008, 0.0022)),
    "points duplicated": ((1e-6, 1e-6), (1e-6, 1e-6)),
    "triangles flipped": ((1e-6, 1e-6), (1e-6, 1e-6)),
    "points unreferenced": ((1e-6, 1e-6), (1e-6, 1e-6)),
    "scaled by 100": ((0.0001, 0.0001), (0.0006, 0.0018)),
}
COLUMNS = ["kind", "variant", "model", "parts", "DetailSize", "spike", "median", "largest"]


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


def measured(variant, mesh, properties, cache):
    """(spike, median, largest); NaN where there is no result. cache: {DetailSize: clean result}."""
    mesh = variant.clean or mesh
    detail = properties["DetailSize"]
    clean = cache.get(detail) if not variant.clean else None
    if clean is None:
        clean = surfaces.Result(*mesh, properties)
    if not variant.clean:
        cache[detail] = clean
    dirty = surfaces.Result(variant.x, variant.F, properties)
    spike = measures.spike(variant.x, dirty.x, np.unique(variant.F), dirty.center, dirty.radius)
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
                for detail in DETAIL_SIZES:
                    table.append(dict(zip(COLUMNS, [
                        kind, way.__name__, name, parts, detail,
                        *measured(variant, mesh, {"DetailSize": detail, **properties}, cache)])))
    report(table)
    for line in table:
        if line["parts"] == 1 or surfaces.stitched(properties):
            judge(check, line)
    if arguments.output:
        surfaces.write_table(arguments.output, "dirty-meshes.csv", COLUMNS, table)
    check.exit()


def judge(check, line):
    median, largest = BOUNDS[line["kind"]][DETAIL_SIZES.index(line["DetailSize"])]
    check(line["spike"] < 1.5 and line["median"] <= median and line["largest"] <= largest,
          "{model}, {variant}, DetailSize {DetailSize:g}: spike {spike:.2f}, median {median:.5f} and largest "
          "difference {largest:.5f} within 1.5, ".format(**line) + f"{median:g} and {largest:g}")


def report(table):
    """Worst of each way to spoil."""
    for way in dict.fromkeys(row["variant"] for row in table):
        for detail in DETAIL_SIZES:
            rows = [row for row in table if row["variant"] == way and row["DetailSize"] == detail]
            median, largest = (max(rows, key=lambda row: row[c]) for c in ("median", "largest"))
            print(f"  {way:15s} DetailSize {detail:<5g} median {median['median']:8.5f} ({median['model']}), "
                  f"largest {largest['largest']:8.5f} ({largest['model']})")


main()
