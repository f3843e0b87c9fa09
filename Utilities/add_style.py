#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Adds a filter for a new style: class, term, panel, icon, page and tests, and lists them in tables and pages.

The style is a term of the local step, defined by target normals. The generated code builds, but leaves every model as
it is: you implement the style itself. Filters/Documentation/AddAStyle.md describes the next steps.

usage: Utilities/add_style.py "Block Style" --weight Blockiness --brief "Turn each part of a surface into blocks"
"""
import argparse
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
# Each template, and the file that is made from it.
FILES = {
    "Term.h": "Filters/Solver/Energy/@Term@.h",
    "Term.cxx": "Filters/Solver/Energy/@Term@.cxx",
    "TestTerm.cxx": "Testing/Solver/Energy/Test@Term@.cxx",
    "Filter.h": "Filters/vtk@Name@.h",
    "Filter.cxx": "Filters/vtk@Name@.cxx",
    "TestFilter.cxx": "Testing/Cxx/Test@Name@.cxx",
    "Filter.xml": "ParaViewPlugin/@Name@.xml",
    "Icon.svg": "ParaViewPlugin/Icons/@Name@.svg",
    "Page.md": "Filters/Documentation/@Page@.md",
}
UNRELEASED = "## [Unreleased]\n\n"  # of the changelog
# Entries in tables and lists: the file, the text before, the new entry, and the text after. The entry goes to the
# first place where the text after directly follows the text before.
PLACES = [
    ("Filters/filters.json", "", """\
    {
      "name": "@Name@", "label": "@Label@", "page": "@Page@", "kind": "style",
      "term": "@Term@", "weight": "@Weight@", "shown": [0.3, 1, 10],
      "quick": {"MaximumNumberOfIterations": 20},
      "inputs": ["Input"],
      "outputs": ["@Output@", "Energy"],
      "arrays": [],
      "enumerations": ["StopRule", "OutputPointsPrecision"],
      "known": ["@Weight@", "GenerateNormals", "StopRule"],
      "unbounded": {"@Weight@": [0, 10]}
    },
""", '    {\n      "name": "SphereProjectionFilter"'),
    ("mkdocs.yml", "", "      - @Label@: Filters/Documentation/@Page@.md\n", "      - Sphere Projection:"),
    ("Filters/README.md", "", "| `vtk@Name@` | @brief@ | [@Page@](Documentation/@Page@.md) |\n",
     "| `vtkSphereProjectionFilter` |"),
    ("Filters/README.md", "", "| `Solver/Energy/@Term@` | its term | [@tag@](Documentation/@Page@.md#method-@tag@) |\n",
     "| `Solver/Targets/SphereProjection` |"),
    ("README.md", "", "| `vtk@Name@` | @brief@ | [@Label@](Filters/Documentation/@Page@.md) |\n",
     "| `vtkNonlinearStyleFilter` |"),
    ("CHANGELOG.md", "### Added\n\n", "- `vtk@Name@`, in ParaView @Label@. @brief@.\n", ""),
]


def fail(message):
    sys.exit(f"{pathlib.Path(__file__).name}: {message}")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("label", help='name in menus, such as "Block Style"')
    parser.add_argument("--weight", required=True, help="property that sets how strong the style is, such as Blockiness")
    parser.add_argument("--brief", required=True, help="what the filter does, in one line without a period")
    parser.add_argument("--root", type=pathlib.Path, default=HERE.parent, help="the project's folder (default: this one)")
    chosen = parser.parse_args()
    if not re.fullmatch(r"[A-Z][a-z]+( [A-Z][a-z]+)+", chosen.label):
        fail(f"the label {chosen.label!r} must have two or more words, each with a capital letter, like Block Style")
    if not re.fullmatch(r"[A-Z][A-Za-z]+", chosen.weight):
        fail(f"the weight {chosen.weight!r} must be the name of a property, like Blockiness")
    if not re.fullmatch(r"[A-Z][^\n|]{10,80}[^\n|.]", chosen.brief):
        fail("the brief must start with a capital letter, have 12 to 82 characters and end without a period")
    return chosen


def main():
    chosen = arguments()
    term = chosen.label.replace(" ", "")
    first = chosen.label.split()[0]
    words = {"Label": chosen.label, "Term": term, "Page": term, "Name": term + "Filter", "Weight": chosen.weight,
             "Output": first, "tag": first.lower(), "brief": chosen.brief,
             "picture": re.sub("(?<=[a-z])(?=[A-Z])", "-", term).lower()}

    def filled(text):
        for word, value in words.items():
            text = text.replace(f"@{word}@", value)
        return text

    # Everything is prepared before the first file is written.
    changed = {}
    for template, place in FILES.items():
        path = chosen.root / filled(place)
        if path.exists():
            fail(f"{path} already exists")
        changed[path] = filled((HERE / "StyleTemplate" / (template + ".in")).read_text())
    for place, before, more, behind in PLACES:
        path = chosen.root / place
        text = changed.get(path) or path.read_text()
        if path.name == "CHANGELOG.md" and before not in text.split("\n## ", maxsplit=2)[1]:
            text = text.replace(UNRELEASED, f"{UNRELEASED}{before}\n", 1)
        if before + behind not in text:
            fail(f"{path} does not contain the text next to which the entry belongs:\n{before}{behind}")
        changed[path] = text.replace(before + behind, before + filled(more) + behind, 1)
    for path, text in changed.items():
        path.write_text(text)
        print(path.relative_to(chosen.root))
    print(f"\nNext, write the targets in {term}.cxx, and complete what grep -rn TODO finds. "
          "See Filters/Documentation/AddAStyle.md.")


if __name__ == "__main__":
    main()
