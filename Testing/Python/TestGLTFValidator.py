# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Khronos' validator finds no error in files with a slider. Leaves with 77 (skipped) where it is not there.

usage: TestGLTFValidator.py DATA_FOLDER
$SPHERICALSTYLE_NODE_MODULES is the folder node_modules that "npm install gltf-validator" makes.
"""
import os
import sys
import tempfile
import warnings

import GLTFFiles
import sphericalstyle as ss

modules = GLTFFiles.find_validator()
if not modules:
    print("no validator: skipped")
    sys.exit(77)
warnings.simplefilter("ignore", ss.StyleWarning)  # of thin parts
data, folder = sys.argv[1], tempfile.mkdtemp()
files = []
for name in sorted(os.listdir(data)):
    if name.endswith(".vtp"):
        mesh = ss.read(os.path.join(data, name))
        one, some, more = (os.path.join(folder, name + end) for end in ("-one.gltf", "-some.glb", "-more.glb"))
        ss.write_slider(one, mesh, detail_size=0, keep_size="Off")
        ss.write_slider(some, mesh, tolerance=0.01)
        ss.write_slider(more, some, tolerance=0.01)
        files += [one, some, more]
reports = GLTFFiles.validate(modules, files)
for file, report in zip(files, reports):
    print(os.path.basename(file), *(f"{report[key]} {key[3:].lower()}" for key in ("numErrors", "numWarnings", "numInfos")))
    assert report["numErrors"] == report["numWarnings"] == 0, report["messages"]
assert len(reports) == len(files) > 30
