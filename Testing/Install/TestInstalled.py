# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""ParaView has loaded the installed plugin by itself, and its filters run.

usage: pvpython TestInstalled.py PREFIX PVSERVER FILTER...
PREFIX: where the plugin and the Python package have to come from. PVSERVER: the program of a server that has
to know the filters too, or - for none. FILTER: names in Python.
"""
import os
import socket
import subprocess
import sys

from paraview.modules.vtkRemotingCore import vtkPVPluginTracker
from paraview.simple import *

import sphericalstyle

prefix, server, filters = os.path.realpath(sys.argv[1]) + os.sep, sys.argv[2], sys.argv[3:]
assert "PV_PLUGIN_PATH" not in os.environ and filters

tracker = vtkPVPluginTracker.GetInstance()
places = {tracker.GetPluginName(i): tracker.GetPluginFileName(i)
          for i in range(tracker.GetNumberOfPlugins()) if tracker.GetPluginLoaded(i)}
assert "SphericalStyle" in places, places
for place in (places["SphericalStyle"], sphericalstyle.__file__):
    assert os.path.realpath(place).startswith(prefix), (place, prefix)


def size(proxy):
    """The lengths of its bounding box, and how many points it has."""
    UpdatePipeline(proxy=proxy)
    data = proxy.GetDataInformation()
    bounds = data.GetBounds()
    return [bounds[2 * k + 1] - bounds[2 * k] for k in range(3)], data.GetNumberOfPoints()


def try_filters():
    model = Calculator(Input=Sphere(ThetaResolution=32, PhiResolution=32), CoordinateResults=1,
                       Function="coordsX*iHat + coordsY*jHat + 2*coordsZ*kHat")
    (x, _, z), count = size(model)
    assert 1.9 < z / x < 2.1, (x, z)
    for name in filters:
        assert name in globals(), f"ParaView does not know the filter {name}"
        further = {"Surface": SphericalStyle(Input=model)} if name == "MeshMorphing" else {}
        given = SurfaceParts(Input=model) if name == "PartSizes" else model
        assert size(globals()[name](Input=given, **further))[1] > 0, f"{name} has no output"
    (x, _, z), rounded_count = size(SphericalStyle(Input=model, Roundness=5.0))
    assert rounded_count == count and 1.0 <= z / x < 1.3, (count, rounded_count, z / x)


def start_server():
    """It tries until somebody listens, says so in words of errors, and ends when this program ends."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    subprocess.Popen([server, "--reverse-connection", "--client-host=127.0.0.1", f"--server-port={port}"],
                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return port


# ParaView lists what is in Macros/ beside its programs, and follows the links there.
macros = os.path.join(prefix, "bin", "Macros")
for name in os.listdir(macros):
    place = os.path.join(macros, name)
    assert name.endswith(".py") and os.path.realpath(place).startswith(prefix), place
    with open(place) as file:
        assert "sphericalstyle" in file.read(), place
assert len(os.listdir(macros)) == 2, os.listdir(macros)

try_filters()
print(f"{len(filters)} filters from {places['SphericalStyle']}")
if server != "-":
    ReverseConnect(str(start_server()))
    assert servermanager.ActiveConnection.IsRemote()
    try_filters()
    print("The server has them too")
