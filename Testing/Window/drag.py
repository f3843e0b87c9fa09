# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Drags the center in ParaView's real window with real mouse events, and looks at what the model does meanwhile.

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" python3 Testing/Window/drag.py build MODEL --pictures FOLDER

Prints updates per second; fails if the model does not follow while the button is down, if its center is not where the
handle was let go at the end, if there are not as many messages as expected, or if one undo does not take back the
whole drag. No time decides: each step waits for the event in the window that it needs, as drag_window.py logs it, and
what came before what is read from the order in the log. Needs xdotool, which sends the events; leaves with 77 without
it.
"""
import argparse
import glob
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

import numpy
from PIL import Image, ImageGrab

HERE = os.path.dirname(os.path.abspath(__file__))
FRAME = (0, 0, 255)  # around the active view; found on the screen, since no event says where a widget is
PREVIEW = re.compile(r"\bPreview\b")  # ParaView has a PreviewMode of its own
HANGS = 900  # seconds that no wait takes unless its event never comes; each takes a few, the start of the window ten


def wait_for(what, condition):
    """The first value of the condition that is not None."""
    end = time.monotonic() + HANGS
    while time.monotonic() < end:
        value = condition()
        if value is not None:
            return value
        time.sleep(0.05)
    raise SystemExit(f"drag: {what} did not come in {HANGS} s")


def read(path):
    """The lines so far; the last one may not be whole yet."""
    if not os.path.exists(path):
        return []
    with open(path) as file:
        return [json.loads(line) for line in file if line.endswith("\n")]


def first(log, key, value=None):
    """The first line with the key, and with the value if there is one."""
    return next((line for line in read(log) if key in line and value in (None, line[key])), None)


def last(log, key):
    return next((line for line in reversed(read(log)) if key in line), None)


def between(log, begin, end):
    """The lines after one of them, and before another one."""
    lines = read(log)
    return lines[lines.index(begin) + 1:lines.index(end)]


def centers(lines):
    """Those of executions."""
    return [line["center"] for line in lines if "center" in line]


def view_corner():
    """Upper left pixel of the view, inside of its frame."""
    pixels = numpy.asarray(ImageGrab.grab().convert("RGB"))
    rows, columns = numpy.nonzero((pixels == FRAME).all(axis=2))
    return (columns.min() + 2, rows.min() + 2) if rows.size > 1000 else None


def path(steps):
    """Pixels right and up from the start: an arc around the model that ends far from where it began."""
    angles = numpy.linspace(0.0, 1.5 * numpy.pi, steps)
    return [(round(120 * numpy.sin(a)), round(60 * (1 - numpy.cos(a)))) for a in angles]


PATH = path(240)


def move_mouse(x, y):
    subprocess.run(["xdotool", "mousemove", str(x), str(y)], check=True)


def mouse_on_handle(log):
    """Moves the mouse to the handle, wherever in the window the view is by now.
    @return pixel of the screen, the line of the movement; None if the mouse did not get there: try again"""
    known = last(log, "handle") or first(log, "ready")["ready"]
    x, y = (round(a + b) for a, b in zip(wait_for("the view", view_corner), known["handle"]))
    move_mouse(x - 40, y)
    move_mouse(x, y)
    for _ in range(40):
        line = last(log, "off")
        if line and numpy.abs(line["off"]).max() <= 2:
            return (x, y), line
        time.sleep(0.05)
    return None


def drag(log, points, options):
    """Button down at the first point, where the mouse is, up at the last one. @return pictures of the screen"""
    subprocess.run(["xdotool", "mousedown", "1"], check=True)
    down = wait_for("the button", lambda: first(log, "pressed"))

    def followed(times):
        lines = read(log)
        return True if len(centers(lines[lines.index(down):])) >= times else None

    done = 1
    if not options.trace:  # with it there is one update, on release
        for times in (1, 2):  # that is all there are if they take long: see pqUpdateWhileDragging
            for point in points[done:done + 10]:
                move_mouse(*point)
            done += 10
            wait_for(f"update {times} while dragging", lambda: followed(times))
    pause = ["sleep", f"{options.seconds / len(points):.4f}"]
    moves = [word for x, y in points[done:] for word in ["mousemove", str(x), str(y)] + pause]
    mouse = subprocess.Popen(["xdotool"] + moves)
    pictures = []
    while mouse.poll() is None:
        if options.pictures or options.strip:
            pictures.append(ImageGrab.grab())
        time.sleep(0.25)
    subprocess.run(["xdotool", "mouseup", "1"], check=True)
    return pictures


def save_pictures(pictures, folder):
    os.makedirs(folder, exist_ok=True)
    for i, picture in enumerate(pictures):
        picture.save(os.path.join(folder, f"drag-{i:03d}.png"))


def save_strip(pictures, middle, name):
    """Five of the pictures side by side, what is around the model only."""
    chosen = [pictures[round(i)] for i in numpy.linspace(0, len(pictures) - 1, 5)]
    x, y = middle
    strip = Image.new("RGB", (5 * 480, 480))
    for i, picture in enumerate(chosen):
        strip.paste(picture.crop((x - 240, y - 260, x + 240, y + 220)), (480 * i, 0))
    strip.resize((5 * 240, 240), Image.LANCZOS).quantize().save(name)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", help="build folder")
    parser.add_argument("model", help="file, or the root of the number of points of a ball")
    parser.add_argument("--coarse", action="store_true", help="while dragging a coarse copy is to be shown")
    parser.add_argument("--detail-size", type=float, default=0.06)
    parser.add_argument("--roundness", type=float, default=1.0)
    parser.add_argument("--normal-blend", type=float, default=0.0, help="0: the center does most")
    parser.add_argument("--handle", choices=("cross", "sphere"), default="cross",
                        help="sphere: the radius is custom, too")
    parser.add_argument("--messages", type=int, default=0, help="that are to come, however many updates there are")
    parser.add_argument("--trace", metavar="PVPYTHON", help="record a trace, and replay it with this program")
    parser.add_argument("--auto-apply", action="store_true", help="with ParaView's Auto Apply")
    parser.add_argument("--seconds", type=float, default=4.0, help="that the drag takes at least")
    parser.add_argument("--pictures", help="folder for pictures of the screen")
    parser.add_argument("--strip", help="file for five pictures of the model side by side")
    parser.add_argument("--paraview", default="paraview")
    parser.add_argument("--server", metavar="PVSERVER", help="with a server of this program")
    options = parser.parse_args()
    if not shutil.which("xdotool"):
        print("drag: skipped, there is no xdotool")
        return 77

    with tempfile.TemporaryDirectory() as folder:
        log = os.path.join(folder, "log")
        settings = dict(log=log, model=os.path.abspath(options.model),
                        resolution=int(options.model) if options.model.isdigit() else 0,
                        properties=properties_of(options),
                        sphere=options.handle == "sphere", released=PATH[-1], auto_apply=int(options.auto_apply),
                        trace=bool(options.trace), coarse=options.coarse)
        environment = dict(
            os.environ, DRAG=json.dumps(settings), HOME=folder,
            PV_PLUGIN_PATH=plugin_path(options))
        command = [options.paraview, "--dr", f"--script={HERE}/drag_window.py"]
        processes = []
        try:
            if options.server:
                server, url = start_server(options.server, environment)
                processes.append(server)
                command.append(f"--url={url}")
            processes.append(subprocess.Popen(command, env=environment))
            return watch(options, log)
        finally:
            for process in processes:
                process.send_signal(signal.SIGSTOP)  # window and server would tell of each other's end as an error
            for process in processes:
                process.kill()
                process.wait()


def properties_of(options):
    return dict(DetailSize=options.detail_size, Roundness=options.roundness, NormalBlend=options.normal_blend)


def plugin_path(options):
    """The folder has ParaView's version in its name."""
    folders = glob.glob(os.path.join(os.path.abspath(options.build), "lib", "paraview-*", "plugins"))
    if len(folders) != 1:
        raise SystemExit(f"drag: {options.build}/lib has {len(folders)} folders paraview-*/plugins, not one")
    return folders[0]


def start_server(program, environment):
    """On a port that is free. @return process, address"""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        port = probe.getsockname()[1]
    server = subprocess.Popen([program, f"--server-port={port}"], env=environment, stdout=subprocess.PIPE, text=True)
    for line in server.stdout:
        if "Accepting connection" in line:
            return server, f"cs://localhost:{port}"
    raise SystemExit("drag: the server did not start")


REPLAY = """
import json, sys
from paraview.simple import *
model, properties, trace = json.loads(sys.argv[1])
SphericalStyle(registrationName="SphericalStyle1", Input=OpenDataFile(model), **properties)
exec(trace)
print("replayed", json.dumps(list(FindSource("SphericalStyle1").Center)))
"""


def check_trace(options, trace, updates, center):
    """One change, that of the release, and a script of it moves the center to the same place."""
    properties = dict(properties_of(options), CenterMode="Custom")
    with tempfile.NamedTemporaryFile("w", suffix=".py") as script:
        script.write(REPLAY)
        script.flush()
        output = subprocess.run(
            [options.trace, "--dr", script.name, json.dumps([os.path.abspath(options.model), properties, trace])],
            env=dict(os.environ, PV_PLUGIN_PATH=plugin_path(options)), capture_output=True, text=True).stdout
    replayed = [json.loads(line.split(" ", 1)[1]) for line in output.splitlines() if line.startswith("replayed ")]
    # style.Center = [...], and from ParaView 6 on style.Set(Center=[...])
    changes = len(re.findall(r"\bCenter ?= ?\[", trace))
    print(f"trace: {changes} changes of Center, replayed {replayed}, dragged to {center}")
    if PREVIEW.search(trace) or updates != 1 or changes != 1 or not replayed or not numpy.allclose(replayed[0], center):
        print(f"FAILED: {updates} updates, and not 1; trace:\n{trace}")
        return 1
    print("passed")
    return 0


def check_points(options, updates, points):
    """Those shown: of a large model a coarse copy while dragging, and all of them after the release."""
    shown = [line["points"] for line in updates if "points" in line]
    pauses = numpy.diff([line["time"] for line in updates if "time" in line][:-1])
    if len(pauses):
        print(f"between updates: {numpy.median(pauses):.3f} s, at most {pauses.max():.3f} s; "
              f"points: {shown[0]} ... {shown[-1]}")
    few = [points == n for n in shown[:-1]] if not options.coarse else [12_500 < n < 37_500 for n in shown[:-1]]
    if not all(few) or shown[-1] != points:
        print(f"FAILED: points while dragging, and then: {shown}; of the model: {points}")
        return 1
    states = [line["state"] for line in updates if "state" in line]
    if options.coarse and (len(states) != 1 or "Roundness" not in states[0] or PREVIEW.search(states[0])):
        print(f"FAILED: a state while dragging knows of it:\n{states}")
        return 1
    return 0


def watch(options, log):
    ready = wait_for("the rounded model", lambda: first(log, "ready"))["ready"]
    (x, y), grabbed = wait_for("the mouse on the handle", lambda: mouse_on_handle(log))
    begin = time.monotonic()
    pictures = drag(log, [(x + right, y - up) for right, up in PATH], options)
    took = time.monotonic() - begin

    def center_is(center):
        return lambda: numpy.allclose(last(log, "center")["center"], center, atol=0.02 * ready["radius"]) or None

    # In this order: button up, the last update, a set of changes to undo, messages. Undo comes after all of them.
    dragged = wait_for("a change to undo", lambda: first(log, "undo", "Drag"))
    wait_for("the model where the handle was let go", center_is(grabbed["released"]))
    if options.pictures:
        save_pictures(pictures + [ImageGrab.grab()], options.pictures)
    if options.strip:
        save_strip(pictures, (x, y), options.strip)
    updates = between(log, grabbed, dragged)  # the last one is that of the release
    dragging = centers(updates)
    print(f"{os.path.basename(options.model)}: {len(dragging)} updates in {took:.1f} s, "
          f"{len(dragging) / took:.1f} per second")

    if failed := check_points(options, updates, ready["points"]):
        return failed
    subprocess.run(["xdotool", "key", "ctrl+z"], check=True)
    undoes = wait_for("undo", lambda: first(log, "undoes"))
    wait_for("the model as before the drag", center_is(ready["center"]))
    before = between(log, grabbed, undoes)
    messages = [line["message"] for line in before if "message" in line]
    print(f"messages: {messages}")
    if len(messages) != options.messages:
        print(f"FAILED: {len(messages)} messages, and not {options.messages}")
        return 1
    if len([line for line in before if line.get("undo") == "Drag"]) != 1 or dragged not in before:
        print("FAILED: not one change to undo")
        return 1
    if options.trace:
        trace = wait_for("the trace", lambda: first(log, "trace"))["trace"]
        return check_trace(options, trace, len(dragging), centers(before)[-1])
    print("passed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
