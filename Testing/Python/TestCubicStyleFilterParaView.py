# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Blocks keep to themselves, and the picture: a model and what the filter makes of it.

usage: pvpython TestCubicStyleFilterParaView.py SphericalStyle.so DATA -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import smtesting
from paraview.simple import *

from ProxyTesting import check_blocks, same_picture

plugin, data = sys.argv[1:3]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())

check_blocks(CubicStyle, data)

# ------------------------------------------------------------------------------------- the picture
creature = XMLPolyDataReader(FileName=[data + "/creature.vtp"])
if not same_picture((
        creature,
        CubicStyle(Input=creature, Cubeness=0.1,
                   StopRule="Fixed Iterations", MaximumNumberOfIterations=40),
        CubicStyle(Input=creature, Cubeness=0.5,
                   StopRule="Fixed Iterations", MaximumNumberOfIterations=40),
        CubicStyle(Input=creature, Cubeness=2.0,
                   StopRule="Fixed Iterations", MaximumNumberOfIterations=40))):
    sys.exit("Failed Image Test")
