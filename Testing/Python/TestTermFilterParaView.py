# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Blocks keep to themselves, and the picture: a model and what a filter whose style is a term makes of it.

For the filters that have no test of their own.

usage: pvpython TestTermFilterParaView.py SphericalStyle.so DATA NameOfTheFilter -T TEMPORARY -V BASELINE.png
"""
import sys

from paraview import smtesting
from paraview.simple import *

from FilterTable import FILTERS
from ProxyTesting import check_blocks, same_picture

plugin, data, name = sys.argv[1:4]
smtesting.ProcessCommandLineArguments()
LoadPlugin(plugin, remote=False, ns=globals())
entry = FILTERS[name]
Filter = globals()[entry["proxy"]]

check_blocks(Filter, data)

# ------------------------------------------------------------------------------------- the picture
creature = XMLPolyDataReader(FileName=[data + "/creature.vtp"])
if not same_picture((creature, *(
        Filter(Input=creature, **{entry["weight"]: value}, StopRule="Fixed Iterations", MaximumNumberOfIterations=40)
        for value in entry["shown"]))):
    sys.exit("Failed Image Test")
