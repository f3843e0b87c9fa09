# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Roundness, NormalBlend and Center move as the animation view's tracks say, and each frame is what the
filter makes of the values by hand; a state file brings it all back.

usage: pvpython TestSphericalStyleFilterAnimation.py MODEL OUTPUT
PV_PLUGIN_PATH has to name the folder of the plugin.
"""
import os
import sys

import ProxyTesting
from paraview.simple import *

model_file, output = sys.argv[1:]
FRAMES = 5
TRACKS = {("Roundness", 0): (0.1, 2.1), ("NormalBlend", 0): (1.0, 0.0),
          ("Center", 0): (-0.1, 0.1), ("Center", 1): (0.2, 0.6)}


def play():
    """Values and bounds of the filter in each frame."""
    style, scene = FindSource("Style"), GetAnimationScene()
    frames = []
    scene.GoToFirst()
    for frame in range(FRAMES):
        values = tuple(style.GetPropertyValue(name)[index] if name == "Center" else style.GetPropertyValue(name)
                       for name, index in TRACKS)
        ProxyTesting.update(style)
        frames.append((values, ProxyTesting.bounds(style)))
        scene.GoToNext()
    return frames


def by_hand(values):
    style = SphericalStyle(Input=FindSource("Model"), CenterMode="Custom",
                           Roundness=values[0], NormalBlend=values[1], Center=[values[2], values[3], 0.0])
    ProxyTesting.update(style)
    bounds = ProxyTesting.bounds(style)
    Delete(style)
    return bounds


model = OpenDataFile(model_file, registrationName="Model")
style = SphericalStyle(registrationName="Style", Input=model, CenterMode="Custom", Center=[0.0, 0.0, 0.0])
Show(style, GetActiveViewOrCreate("RenderView"))
scene = GetAnimationScene()
scene.PlayMode, scene.NumberOfFrames, scene.StartTime, scene.EndTime = "Sequence", FRAMES, 0.0, 1.0
for (name, index), values in TRACKS.items():
    track = GetAnimationTrack(name, index=index, proxy=style)
    key_frames = [CompositeKeyFrame(KeyTime=float(time), KeyValues=[value], Interpolation="Ramp")
                  for time, value in enumerate(values)]
    track.KeyFrames = key_frames
    for time, key_frame in enumerate(key_frames):  # as the window does; others are not in state files
        servermanager.ProxyManager().RegisterProxy("animation", f"{name}{index}At{time}", key_frame)

played = play()
for frame, (values, bounds) in enumerate(played):
    t = frame / (FRAMES - 1)
    for (key, (first, last)), value in zip(TRACKS.items(), values):
        assert abs(value - (first + t * (last - first))) < 1e-12, (frame, key, value)
    assert max(abs(a - b) for a, b in zip(bounds, by_hand(values))) < 1e-6, (frame, bounds, by_hand(values))
assert len({bounds for _, bounds in played}) == FRAMES

state = os.path.join(output, "animation.pvsm")
SaveState(state)
ResetSession()
LoadState(state)
assert play() == played, "the state plays another animation"
