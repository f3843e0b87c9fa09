# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""DetailSize, dragged: the result must follow it smoothly.

The preset Toy at nine sizes from 0.05 to 0.066. Jump: root of the mean square of the second differences of the points
over the sizes, as a fraction of the diagonal; a motion at constant speed has none. What jumps is a thin sheet whose
shape depends on how the cells of the grid happen to lie. Figures: README.md.
"""
import numpy as np

import surfaces

SIZES = np.linspace(0.05, 0.066, 9)
MODELS = ("armadillo", "car", "plane-holes", "spot", "wingnut", "Data/creature", "Data/bottle")
BOUND = 0.004  # largest jump
EXCEPTIONS = {"car": ("hard thin panels", 0.012)}
COLUMNS = ["model", "jump", "largest"]


def jumps(x, F, properties):
    """Of each point between three sizes at a time."""
    style = surfaces.Style(x, F, {"RefineLongEdges": 0, **properties})
    results = [style.result({"DetailSize": size}).x for size in SIZES]
    length = np.linalg.norm(np.ptp(x, axis=0))
    return np.array([np.linalg.norm(a - 2.0 * b + c, axis=1)
                     for a, b, c in zip(results, results[1:], results[2:])]) / length


def main():
    chosen, paths = surfaces.chosen_models(__doc__, MODELS)
    checks = surfaces.Checks()
    rows = []
    print("| model | jump | largest of a point |\n|---|---|---|")
    for name, path in paths.items():
        found = jumps(*surfaces.read(path), dict(chosen.set))
        row = {"model": name, "jump": float(np.sqrt(np.mean(found ** 2))), "largest": float(found.max())}
        print(f"| {name} | {row['jump']:.4f} | {row['largest']:.3f} |", flush=True)
        rows.append(row)
        bound = EXCEPTIONS.get(name, ("", BOUND))[1]
        checks(row["jump"] <= bound, f"{name}: the jump is {row['jump']:.4f}, above {bound}")
    if chosen.output:
        surfaces.write_table(chosen.output, "detail-sizes.csv", COLUMNS, rows)
    checks.exit()


if __name__ == "__main__":
    main()
