# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of examples share. Each is called with PYTHON EXAMPLES DATA OUTPUT: the program that runs the
example (python3 or pvpython), the folder of the examples, the models, and a folder to write to."""
import os
import pathlib
import resource
import shutil
import subprocess
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from sphericalstyle import vtkSphericalStyleFilter

python, examples, data, output = sys.argv[1], *map(pathlib.Path, sys.argv[2:])
shutil.rmtree(output, ignore_errors=True)
output.mkdir(parents=True)


def run(script, *arguments, largest_file=resource.RLIM_INFINITY):
    """The finished process, with what it printed. largest_file: bytes that a file may get, as on a full disk."""
    return subprocess.run([python, examples / script, *map(str, arguments)], check=False, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, preexec_fn=lambda: resource.setrlimit(
                              resource.RLIMIT_FSIZE, (largest_file, resource.RLIM_INFINITY)))


may_limit_files = "pvpython" not in python  # MPI, which that starts, needs large ones


def run_badly(script, *arguments, **options):
    """What it printed; it has to fail with words of its own."""
    done = run(script, *arguments, **options)
    assert done.returncode in (1, 2), (done.returncode, done.stdout)
    assert "Traceback" not in done.stdout, done.stdout
    return done.stdout


def check_faults(script, model):
    """What cannot be read, rounded or written is no success."""
    broken, no_points = output / "broken.vtp", output / "table.csv"
    broken.write_text("<VTKFile", encoding="utf-8")
    no_points.write_text("a,b\n1,2\n", encoding="utf-8")
    for bad in (broken, no_points):
        assert bad.name in run_badly(script, bad, "--output", output / "none").splitlines()[-1]
    run_badly(script, model, "--output", output / "nowhere" / "none")


def run_well(script, *arguments):
    """What it printed; it has to end with exit code 0."""
    done = run(script, *arguments)
    assert done.returncode == 0, (done.returncode, done.stdout)
    return done.stdout


def pixels(path):
    """height x width x 3 of a PNG, line by line from below."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)


def surface(path):
    """Of a VTP."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.fsencode(path))
    reader.Update()
    return reader.GetOutput()


def points(path):
    """n x 3 of a VTP."""
    return points_of(surface(path))


def points_of(polydata):
    return vtk_to_numpy(polydata.GetPoints().GetData())


def rounded_points(path, **properties):
    """What the filter makes of a VTP; properties by their names."""
    style = vtkSphericalStyleFilter()
    style.SetInputData(surface(path))
    for name, value in properties.items():
        getattr(style, "Set" + name)(value)
    style.Update()
    return points_of(style.GetOutput())


def count_shapes(image):
    """How many shapes stand side by side before a white background."""
    seen = np.any(image < 250, axis=(0, 2)).astype(int)
    return int(np.sum(np.diff(np.concatenate([[0], seen])) == 1))
