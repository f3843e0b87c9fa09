# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Blocks keep to themselves, and the picture: a model and what the filter makes of it.

usage: pvpython TestSphereProjectionFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import smtesting
from paraview.simple import *

from ProxyTesting import check_blocks, same_picture

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())

check_blocks(SphereProjection, data)

# ------------------------------------------------------------------------------------- the picture
creature = XMLPolyDataReader(FileName=[data + "/creature.vtp"])
if not same_picture((
        creature,
        SphereProjection(Input=creature, Coefficient=0.25, RadiusMode="Equal Area"),
        SphereProjection(Input=creature, Coefficient=0.5, RadiusMode="Equal Area"),
        SphereProjection(Input=creature, Coefficient=1.0, RadiusMode="Equal Area"))):
    sys.exit("Failed Image Test")
