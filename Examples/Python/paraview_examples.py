# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the examples for pvpython share: arguments, the plugin, the model, and a picture of surfaces in a row."""
import argparse
import os
import sys

from paraview.simple import *
from vtkmodules.vtkCommonCore import vtkOutputWindow

errors = []  # one for each that was printed: ParaView's writers do not return that they failed
vtkOutputWindow.GetInstance().AddObserver("ErrorEvent", lambda *_: errors.append(True))


def parse(parser):
    """The arguments, with those that all these examples have."""
    parser.add_argument("--plugin", help="SphericalStyle.so, if ParaView does not find the plugin by itself")
    arguments = parser.parse_args()
    if not os.path.isfile(arguments.model):
        parser.error(f"{arguments.model}: no such file")
    return arguments


def parser_for(description, output):
    """A parser for examples that read a model; output: how the names of the files begin."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("model", help="any file of a surface that ParaView can open")
    parser.add_argument("--output", default=output, help="how the names of the files begin")
    return parser


def load_plugin(path, filter_name, namespace):
    """Into the namespace (globals()) of the example; ends it if there is no such filter afterwards."""
    if path:
        try:
            LoadPlugin(path, remote=False, ns=namespace)
        except RuntimeError as error:
            sys.exit(str(error))
    if filter_name not in namespace:
        sys.exit(f"ParaView has no {filter_name}: install the plugin, use --plugin or set PV_PLUGIN_PATH.")


def open_model(path):
    """The reader that has read the file; ends the example if there is nothing in it."""
    try:
        model = OpenDataFile(path)
    except RuntimeError as error:
        sys.exit(str(error))
    model.UpdatePipeline()
    if model.GetDataInformation().GetNumberOfPoints() == 0:
        sys.exit(f"{path}: no points could be read")
    return model


def save_result(path, filter_):
    """Its surface; ends the example if there is none."""
    filter_.UpdatePipeline()
    if filter_.GetDataInformation().GetNumberOfPoints() == 0:
        sys.exit("The filter gave no result and has said why.")
    SaveData(path, proxy=filter_)


def end():
    """Ends the example with a failure if there were errors."""
    if errors:
        sys.exit("Not everything could be done: see the errors above.")


def save_row(file, surfaces, spacing, size, zoom):
    """A picture of the surfaces in clay, from left to right. spacing: in widths of the first."""
    view = CreateView("RenderView")
    bounds = surfaces[0].GetDataInformation().GetBounds()
    for place, surface in enumerate(surfaces):
        display = Show(surface, view)
        display.ColorArrayName = ["POINTS", ""]
        display.AmbientColor = display.DiffuseColor = [0.88, 0.62, 0.47]
        display.Position = [spacing * place * (bounds[1] - bounds[0]), 0.0, 0.0]
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0
    view.ViewSize = size
    ResetCamera(view)
    GetActiveCamera().Zoom(zoom)
    SaveScreenshot(file, view)
