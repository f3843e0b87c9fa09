# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of claims about real models share: the folder of models, claims, sections.

Their arguments are [--models DIR] [section ...]; the folder may also be $SPHERICALSTYLE_MODELS. Without it they leave
with 77, which ctest takes for "skipped". All sections run when none is named. Every figure is printed, every claim is
checked; a section that checks nothing fails.
"""
import argparse
import os
import sys

from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Data")
# What makes vtkSphericalStyleFilter the energy of the thesis' chapter 4, minimized; the rest is by default.
ENERGY = dict(Roundness=0.5, NormalBlend=0.0, DetailSize=0.0, NormalRadius=1, KeepSize=0, RefineLongEdges=0,
              SphericalWeighting=0)
checks = 0
failures = []
models = ""


def check(good, claim):
    global checks
    checks += 1
    if not good:
        failures.append(claim)
        print("ERROR: should hold:", claim)


def read(name):
    """A model of the folder; our-NAME is one of ours."""
    ours = name.startswith("our-")
    reader = vtkXMLPolyDataReader() if ours else vtkPLYReader()
    reader.SetFileName(os.path.join(DATA, name[4:] + ".vtp") if ours else os.path.join(models, name + ".ply"))
    reader.Update()
    assert reader.GetOutput().GetNumberOfPoints() > 0, name
    return reader.GetOutput()


def main(sections):
    """Runs the sections (a function for each name) that are asked for, and ends the process."""
    global models
    parser = argparse.ArgumentParser()
    parser.add_argument("--models", default=os.environ.get("SPHERICALSTYLE_MODELS", ""))
    parser.add_argument("sections", nargs="*", choices=[[], *sections])
    arguments = parser.parse_args()
    models = arguments.models
    if not os.path.isdir(models):
        print("no folder of models: skipped")
        sys.exit(77)
    for section in arguments.sections or sections:
        print(section)
        before = checks
        sections[section]()
        check(checks > before, f"{section}: something is checked")
    sys.exit(1 if failures else 0)
