# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's trace of what was done with a filter, run with an empty pipeline, does the same again.

usage: pvpython TestTrace.py DATA
PV_PLUGIN_PATH has to name the folder of the plugin, as the script of a trace does not load it.
"""
import os
import sys

import ProxyTesting
from FilterTable import SURFACE_FILTERS
from paraview import smtrace
from paraview.simple import *

data, = sys.argv[1:]


def result(name):
    """(points, scalar of the array names) of a source by its name in the pipeline."""
    proxy = FindSource(name)
    ProxyTesting.update(proxy)
    return ProxyTesting.points(servermanager.Fetch(proxy)), ProxyTesting.arrays(proxy)


def clear():
    for proxy in reversed(list(GetSources().values())):
        Delete(proxy)
    assert not GetSources()


def traced(filter_name, properties):
    """What the window does: make, show, change, apply, with the trace on. @return the trace's text"""
    smtrace.start_trace()
    model = OpenDataFile(os.path.join(data, "snowman.vtp"))
    if filter_name == "PartSizes":
        model = SurfaceParts(Input=model)
    proxy = globals()[filter_name](registrationName="Traced", Input=model)
    Show(proxy, GetActiveViewOrCreate("RenderView"))
    change = smtrace.PropertiesModified(proxy)  # as Apply does
    for name, value in properties.items():
        proxy.SetPropertyWithName(name, value)
    change.finalize()
    ProxyTesting.update(proxy)
    return smtrace.stop_trace()


CASES = {
    "SphericalStyle": [
        {"Roundness": 2.5, "DetailSize": 0.02, "NormalBlend": 0.25, "CenterMode": "Custom", "Center": [0.0, 0.4, 0.1]},
        {"Roundness": 5.0, "CenterIdArray": ["POINTS", "CenterId"], "EdgeWeighting": "Full Edge"},
    ],
    "ConvexProxyDeform": [{"Blend": 0.3, "Transfer": "Offset"}],
    "SurfaceDiagnostics": [{"SliverAngle": 5.0}],
    "PartSizes": [{"PartSize": [1.0, 1.5, 2.0, 0.7]}],
    "HandleDeform": [{"Handle": [0.0, -1.0, 0.0, 0.2, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0,
                                 0.0, 1.5, 0.0, 0.2, 0.1, 1.7, 0.0, 0.0, 50.0, 0.0]}],
}
CASES |= {entry["proxy"]: [{}] for entry in SURFACE_FILTERS.values() if entry["proxy"] not in CASES}
tried = 0
for filter_name, cases in CASES.items():
    if filter_name not in globals():
        continue  # built without CGAL
    for properties in cases:
        clear()
        text = traced(filter_name, properties)
        for name in properties:
            assert name in text, (filter_name, name, text)
        expected = result("Traced")
        assert expected[0], filter_name
        clear()
        exec(compile(text, f"trace of {filter_name}", "exec"), {})
        assert result("Traced") == expected, (filter_name, properties, text)
        tried += 1
assert tried >= 8, tried
