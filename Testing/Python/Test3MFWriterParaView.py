# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Save Data in ParaView writes 3MF.

usage: pvpython Test3MFWriterParaView.py PLUGIN DATA_FOLDER OUTPUT_FOLDER
"""
import os
import sys

import numpy as np
import sphericalstyle
import ThreeMFFiles
from paraview import servermanager
from paraview.simple import LoadPlugin, OpenDataFile, SaveData, SphericalStyle, Wavelet
from vtkmodules.util.numpy_support import vtk_to_numpy

plugin, data, folder = sys.argv[1:]
LoadPlugin(plugin, remote=False, ns=globals())
model = OpenDataFile(os.path.join(data, "creature.vtp"))
style = SphericalStyle(Input=model)
style.UpdatePipeline()
factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
formats = factory.GetSupportedFileTypes(style.SMProxy)
assert "3MF for 3D printers" in formats and "*.3mf" in formats, formats
image = Wavelet()
image.UpdatePipeline()
assert "3MF" not in factory.GetSupportedFileTypes(image.SMProxy)

path = os.path.join(folder, "SaveData.3mf")
for unit, options in (("millimeter", {}), ("inch", {"Unit": "Inch"})):
    SaveData(path, proxy=style, **options)
    file = ThreeMFFiles.load(path)
    surface = servermanager.Fetch(style)
    assert file.unit == unit
    points = vtk_to_numpy(surface.GetPoints().GetData())
    assert np.array_equal(np.array(file.points).astype(points.dtype), points)
    assert np.array_equal(file.triangles, vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3))

# The panel has what the class has.
proxy, writer = servermanager.ProxyManager().NewProxy("writers", "3MFWriter"), sphericalstyle.vtk3MFWriter()
assert proxy.GetProperty("Unit").GetElement(0) == writer.GetUnit()
units = proxy.GetProperty("Unit").FindDomain("vtkSMEnumerationDomain")
assert units.GetNumberOfEntries() == writer.GetUnitMaxValue() + 1
for k in range(units.GetNumberOfEntries()):
    assert units.GetEntryValue(k) == getattr(writer, units.GetEntryText(k).upper()), units.GetEntryText(k)
