# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Blocks keep to themselves, and the picture: a model and what the filter makes of it.

usage: pvpython TestNormalAnalogyFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import smtesting
from paraview.simple import *

from ProxyTesting import check_blocks, same_picture

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())

check_blocks(NormalAnalogy, data)

# ------------------------------------------------------------------------------------- the picture
creature = XMLPolyDataReader(FileName=[data + "/creature.vtp"])
if not same_picture((
        creature,
        NormalAnalogy(Input=creature, Style="Tetrahedron", Weight=10.0),
        NormalAnalogy(Input=creature, Style="Cube", Weight=10.0),
        NormalAnalogy(Input=creature, Style="Icosahedron", Weight=10.0))):
    sys.exit("Failed Image Test")
