# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Code that the examples for pvpython share: arguments, plugin, model, and a picture of surfaces in a row."""
import argparse
import os
import sys

from paraview.simple import *
from vtkmodules.vtkCommonCore import vtkOutputWindow

errors = []  # one entry per printed error, since ParaView's writers do not report a failure otherwise
vtkOutputWindow.GetInstance().AddObserver("ErrorEvent", lambda *_: errors.append(True))


def parse(parser):
    """Parses the arguments, including those that all examples have."""
    parser.add_argument("--plugin", help="SphericalStyle.so, if ParaView does not find the plugin by itself")
    arguments = parser.parse_args()
    if not os.path.isfile(arguments.model):
        parser.error(f"{arguments.model}: no such file")
    return arguments


def parser_for(description, output):
    """A parser for examples that read a model. output: default prefix of the names of output files."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("model", help="a file with a surface, in any format that ParaView can open")
    parser.add_argument("--output", default=output, help="prefix of the names of output files")
    return parser


def load_plugin(path, filter_name, namespace):
    """Loads the plugin into the example's namespace (globals()). Ends the example if the filter is then missing."""
    if path:
        try:
            LoadPlugin(path, remote=False, ns=namespace)
        except RuntimeError as error:
            sys.exit(str(error))
    if filter_name not in namespace:
        sys.exit(f"ParaView has no {filter_name}: install the plugin, use --plugin or set PV_PLUGIN_PATH.")


def open_model(path):
    """The reader after it has read the file. Ends the example if the file has no points."""
    try:
        model = OpenDataFile(path)
    except RuntimeError as error:
        sys.exit(str(error))
    model.UpdatePipeline()
    if model.GetDataInformation().GetNumberOfPoints() == 0:
        sys.exit(f"{path}: no points could be read")
    return model


def save_result(path, filter_):
    """Saves the filter's surface as .vtp. Ends the example if there is none."""
    filter_.UpdatePipeline()
    if filter_.GetDataInformation().GetNumberOfPoints() == 0:
        sys.exit("The filter gave no result and has said why.")
    # Not appended, as by default: VTK 9.2 and earlier cannot read some of such files with today's expat.
    SaveData(path, proxy=filter_, DataMode="Binary")


def end():
    """Ends the example with an error code if there were errors."""
    if errors:
        sys.exit("Not everything could be done: see the errors above.")


def save_row(file, surfaces, spacing, size, zoom):
    """A picture of the surfaces from left to right. spacing: in widths of the first surface."""
    view = CreateView("RenderView")
    bounds = surfaces[0].GetDataInformation().GetBounds()
    for place, surface in enumerate(surfaces):
        display = Show(surface, view)
        display.ColorArrayName = ["POINTS", ""]
        display.AmbientColor = display.DiffuseColor = [0.88, 0.62, 0.47]
        position = "Position" if GetParaViewVersion() < (5, 13) else "Translation"
        setattr(display, position, [spacing * place * (bounds[1] - bounds[0]), 0.0, 0.0])
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0
    view.ViewSize = size
    ResetCamera(view)
    GetActiveCamera().Zoom(zoom)
    SaveScreenshot(file, view)
