# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Save Data in ParaView writes glTF with a slider.

usage: pvpython TestStyleGLTFWriterParaView.py PLUGIN DATA_FOLDER OUTPUT_FOLDER
"""
import os
import sys

import GLTFFiles
import numpy as np
import sphericalstyle
from paraview import servermanager
from paraview.simple import LoadPlugin, OpenDataFile, SaveData, SphericalStyle
from vtkmodules.util.numpy_support import vtk_to_numpy

plugin, data, folder = sys.argv[1:]
LoadPlugin(plugin, remote=False, ns=globals())
model = OpenDataFile(os.path.join(data, "snowman.vtp"))
model.UpdatePipeline()
factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
formats = factory.GetSupportedFileTypes(model.SMProxy)
assert "glTF with a Roundness slider" in formats, formats

one = os.path.join(folder, "SaveData.glb")
SaveData(one, proxy=model, Roundness=2.0, DetailSize=0.0, KeepSize="Off")
root, binary = GLTFFiles.load(one)
mesh = root["meshes"][0]
w = 3 ** 0.5 * 2 / (1 + 3 ** 0.5 * 2)
assert mesh["extras"]["targetNames"] == ["Roundness"] and abs(mesh["weights"][0] - w) < 1e-6, mesh["weights"]

some = os.path.join(folder, "SaveData.gltf")
SaveData(some, proxy=model, MaximumRoundness=2.0, Tolerance=0.01)
root, binary = GLTFFiles.load(some)
told = root["meshes"][0]["extras"]["sphericalStyle"]
assert abs(told["places"][-1] - w) < 1e-12 and told["largestError"] < 0.01, told

# What is rounded already is opened as it looks.
style = SphericalStyle(Input=model)
again = os.path.join(folder, "SaveDataAgain.glb")
SaveData(again, proxy=style, MaximumRoundness=2.0, Tolerance=0.01)
root, binary = GLTFFiles.load(again)
mesh = root["meshes"][0]
assert mesh["weights"] == [0.0] * len(mesh["weights"]), mesh["weights"]
looks = vtk_to_numpy(servermanager.Fetch(style).GetPoints().GetData())
assert np.allclose(GLTFFiles.points(root, binary, mesh["weights"]), looks, rtol=0, atol=1e-6)

# The defaults are those of the classes.
proxy, writer = servermanager.ProxyManager().NewProxy("writers", "StyleGLTFWriter"), sphericalstyle.vtkStyleGLTFWriter()
for name in ("MaximumRoundness", "Tolerance", "MaximumNumberOfTargets", "Roundness", "NormalBlend", "DetailSize",
             "KeepSize"):
    owner = writer if hasattr(writer, "Get" + name) else writer.GetStyle()
    assert proxy.GetProperty(name).GetElement(0) == getattr(owner, "Get" + name)(), name
