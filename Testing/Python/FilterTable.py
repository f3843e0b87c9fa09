# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The table of the filters, Filters/filters.json: FILTERS[name] is an entry, with "class" and "proxy" besides.

A filter that needs what this build does without is not in it. SURFACE_FILTERS are those that need no second input.
"""
import json
import os

import sphericalstyle

PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Filters", "filters.json")
with open(PATH, encoding="utf-8") as file:
    ALL = {entry["name"]: {**entry, "class": "vtk" + entry["name"], "proxy": entry["label"].replace(" ", "")}
           for entry in json.load(file)["filters"]}
FILTERS = {name: entry for name, entry in ALL.items()
           if "needs" not in entry or hasattr(sphericalstyle, entry["class"])}
SURFACE_FILTERS = {name: entry for name, entry in FILTERS.items() if entry["kind"] != "carry"}
