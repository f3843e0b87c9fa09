# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Limbs stay limbs and details stay details: arms and legs do not swing or cross, and a face survives.

Limbs: two models with arms and legs, at Roundness .5, NormalBlend 0, DetailSize .03. Details: four models against the
thesis at a Roundness that makes them as round. How both are measured, and the figures: README.md.
"""
import numpy as np

import measures
import surfaces

TURN = 25.0  # degrees, of a limb at most
CASES = {"closed form": {"Roundness": 0.5, "NormalBlend": 0.0, "DetailSize": 0.03}, **surfaces.STYLES}
CHECKED = "closed form"  # the others are shown
# Where the limbs are: {limb: ((from x, to x), (from y, to y))}, fractions of the model's bounds.
LIMBS = {
    "human-parts": {"left arm": ((0.0, 0.35), (0.6, 1.0)), "right arm": ((0.65, 1.0), (0.6, 1.0)),
                    "left leg": ((0.2, 0.5), (0.0, 0.4)), "right leg": ((0.5, 0.8), (0.0, 0.4))},
    "armadillo": {"left arm": ((0.0, 0.25), (0.6, 1.0)), "right arm": ((0.75, 1.0), (0.6, 1.0)),
                  "left leg": ((0.0, 0.42), (0.0, 0.4)), "right leg": ((0.63, 1.0), (0.0, 0.4))},
}
SLICES = 20  # of the height that both legs have in common
DETAIL_SIZE = 0.03
ROUNDNESSES = (0.5, 5.0)
# How many times smaller the errors are than those of the thesis, at least: {model: (whole, without the base)}; 3 was
# the goal. None: they are larger. On koala needles of a hundredth of a degree, a point in a thousand, make nine tenths
# of the sum, and its smooth back, which has no details, does the rest.
GAIN = {"armadillo": (2.2, 2.35), "boot": (2.25, 2.35), "koala": None, "nefertiti": (2.4, 2.8)}
LIMB_COLUMNS = ["model", "case", "limb", "points", "degrees", "gap", "own gap"]
DETAIL_COLUMNS = ["model", "Roundness", "KeepSize", "spread", "thesis Roundness", "error", "thesis error", "gain",
                  "error without base", "thesis error without base", "gain without base"]


# ------------------------------------------------------------------------------------------- limbs
def inside(x, box):
    at = (x - x.min(axis=0)) / np.ptp(x, axis=0)
    (x0, x1), (y0, y1) = box
    return np.flatnonzero((at[:, 0] >= x0) & (at[:, 0] < x1) & (at[:, 1] >= y0) & (at[:, 1] < y1))


def principal_axis(x, weight):
    """The direction along which the points lie, and how many times farther than across."""
    d = x - weight @ x / weight.sum()
    squares, axes = np.linalg.eigh((weight[:, None] * d).T @ d)
    return axes[:, 2], np.sqrt(squares[2] / squares[1])


def gap(left, right):
    """Smallest distance from the left to the right leg along x, over slices of the height they share: below 0
    they cross."""
    heights = np.linspace(max(left[:, 1].min(), right[:, 1].min()), min(left[:, 1].max(), right[:, 1].max()),
                          SLICES + 1)
    gaps = [np.inf]
    for low, high in zip(heights, heights[1:]):
        l, r = (leg[(leg[:, 1] >= low) & (leg[:, 1] <= high), 0] for leg in (left, right))
        if len(l) and len(r):
            gaps.append(r.min() - l.max())
    return min(gaps)


def limbs(check, name, path, properties):
    """Rows of LIMB_COLUMNS."""
    x, F = surfaces.read(path)
    weight = measures.point_areas(x, F)
    members = {limb: inside(x, box) for limb, box in LIMBS[name].items()}
    length = measures.diagonal(x)
    table = []
    for case, settings in CASES.items():
        y = surfaces.Result(x, F, {**settings, "RefineLongEdges": 0, **properties}).x
        legs, rest_legs = ([z[members[f"{side} leg"]] for side in ("left", "right")] for z in (y, x))
        between, own = gap(*legs) / length, gap(*rest_legs) / length
        for limb, points in members.items():
            before, slender = principal_axis(x[points], weight[points])
            check(slender > 1.9, f"{name}, {limb}: has an axis")
            after, _ = principal_axis(y[points], weight[points])
            turn = np.degrees(np.arccos(min(1.0, abs(before @ after))))
            table.append(dict(zip(LIMB_COLUMNS, [name, case, limb, len(points), turn, between, own])))
            if case == CHECKED:
                check(turn <= TURN, f"{name}, {limb}: turns by {turn:.1f}, at most {TURN:g} degrees")
        print(f"  {name:12s} {case:12s} " + ", ".join(
            f"{row['limb']} {row['degrees']:.1f}" for row in table[-len(members):])
            + f" degrees; legs apart by {between:.4f} (before {own:.4f})", flush=True)
        if case == CHECKED:
            check(between > 0.0, f"{name}: the legs do not cross")
    return table


# ----------------------------------------------------------------------------------------- details
def as_round_thesis(x, F, spread):
    """(Roundness, points) of the thesis with this radius spread."""
    style = surfaces.Style(x, F, surfaces.THESIS)
    low, high = 0.0, 50.0
    for _ in range(40):
        roundness = 0.5 * (low + high)
        y = style.result({"Roundness": roundness}).x
        found = measures.radius_spread(y, F)
        if abs(found / spread - 1.0) < 1e-4:
            break
        low, high = (roundness, high) if found > spread else (low, roundness)
    return roundness, y


def details(check, name, path, properties):
    """Rows of DETAIL_COLUMNS."""
    x, F = surfaces.read(path)
    measured = measures.Details(x, F, DETAIL_SIZE)
    style = surfaces.Style(x, F, {"RefineLongEdges": 0, **properties})
    table = []
    for roundness in ROUNDNESSES:
        for keep in ("Off", "Area"):
            y = style.result({"Roundness": roundness, "NormalBlend": 0.0, "DetailSize": DETAIL_SIZE,
                              "KeepSize": keep}).x
            spread = measures.radius_spread(y, F)
            if keep == "Off":  # the size is no matter of the spread
                equal, z = as_round_thesis(x, F, spread)
                thesis = measured.errors(z)
            whole, alone = measured.errors(y)
            row = dict(zip(DETAIL_COLUMNS, [name, roundness, keep, spread, equal, whole, thesis[0], thesis[0] / whole,
                                            alone, thesis[1], thesis[1] / alone]))
            table.append(row)
            print("  {model:10s} Roundness {Roundness:<3g} KeepSize {KeepSize:4s} spread {spread:.4f} (thesis "
                  "{thesis Roundness:.3f}), error {error:.5f} of {thesis error:.5f}: {gain:.2f} times less; without "
                  "base {error without base:.5f} of {thesis error without base:.5f}: {gain without base:.2f}".format(**row),
                  flush=True)
            for column, bound in zip(("gain", "gain without base"), GAIN[name] or ()):
                check(row[column] >= bound,
                      f"{name}, {roundness:g}, {keep}: {column} {row[column]:.2f} at least {bound:g}")
    return table


def main():
    parser = surfaces.parser(__doc__)
    surfaces.add_models(parser)
    parser.add_argument("names", nargs="*", help="of " + ", ".join(sorted({*LIMBS, *GAIN})))
    arguments = parser.parse_args()
    if not arguments.models.is_dir():
        surfaces.skip("no folder of models")
    check = surfaces.Checks()
    properties = dict(arguments.set)
    turns, errors = [], []
    for name in arguments.names or sorted({*LIMBS, *GAIN}):
        path = arguments.models / f"{name}.ply"
        turns += limbs(check, name, path, properties) if name in LIMBS else []
        errors += details(check, name, path, properties) if name in GAIN else []
    if arguments.output:
        surfaces.write_table(arguments.output, "limbs.csv", LIMB_COLUMNS, turns)
        surfaces.write_table(arguments.output, "details.csv", DETAIL_COLUMNS, errors)
    check.exit()


main()
