# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Drags the center in ParaView's real window with real mouse events, and looks at what the model does meanwhile.

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" python3 Testing/Window/drag.py build MODEL --pictures FOLDER

Prints updates per second; fails if the model does not follow while the button is down, if its center is not where the
handle was let go at the end, if there are not as many messages as expected, or if one undo does not take back the
whole drag. Needs xdotool, which sends the events; leaves with 77 without it.
"""
import argparse
import json
import os
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


def wait_for(what, condition, seconds=90):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = condition()
        if value is not None:
            return value
        time.sleep(0.1)
    raise SystemExit(f"drag: waited {seconds} s for {what}")


def read(path):
    """The lines so far; the last one may not be whole yet."""
    if not os.path.exists(path):
        return []
    with open(path) as file:
        return [json.loads(line) for line in file if line.endswith("\n")]


def updates(log, begin=0.0, end=numpy.inf):
    """The lines of executions; the first line is that of the handle."""
    return [line for line in read(log) if "center" in line and begin <= line["time"] <= end]


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


def drag(points, seconds, take_pictures):
    """Button down at the first point, up at the last. @return times of both, pictures of the screen on the way"""
    pause = ["sleep", f"{seconds / len(points):.4f}"]
    moves = [word for x, y in points[1:] for word in ["mousemove", str(x), str(y)] + pause]
    subprocess.run(["xdotool", "mousemove", *map(str, points[0]), "sleep", "0.5", "mousedown", "1"], check=True)
    begin = time.time()
    mouse = subprocess.Popen(["xdotool"] + moves)
    pictures = []
    while mouse.poll() is None:
        if take_pictures:
            pictures.append(ImageGrab.grab())
        time.sleep(0.25)
    end = time.time()
    subprocess.run(["xdotool", "mouseup", "1"], check=True)
    return begin, end, pictures


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
    parser.add_argument("model")
    parser.add_argument("--detail-size", type=float, default=0.06)
    parser.add_argument("--roundness", type=float, default=1.0)
    parser.add_argument("--normal-blend", type=float, default=0.0, help="0: the center does most")
    parser.add_argument("--handle", choices=("cross", "sphere"), default="cross",
                        help="sphere: the radius is custom, too")
    parser.add_argument("--messages", type=int, default=0, help="that are to come, however many updates there are")
    parser.add_argument("--trace", metavar="PVPYTHON", help="record a trace, and replay it with this program")
    parser.add_argument("--auto-apply", action="store_true", help="with ParaView's Auto Apply")
    parser.add_argument("--seconds", type=float, default=4.0, help="that the drag takes")
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
                        properties=properties_of(options),
                        sphere=options.handle == "sphere", released=PATH[-1], auto_apply=int(options.auto_apply),
                        trace=bool(options.trace))
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
    return os.path.join(os.path.abspath(options.build), "lib", "paraview-5.11", "plugins")


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


def check_trace(options, trace, during, center):
    """One change, that of the release, and a script of it moves the center to the same place."""
    properties = dict(properties_of(options), CenterMode="Custom")
    with tempfile.NamedTemporaryFile("w", suffix=".py") as script:
        script.write(REPLAY)
        script.flush()
        output = subprocess.run(
            [options.trace, "--dr", script.name, json.dumps([os.path.abspath(options.model), properties, trace])],
            env=dict(os.environ, PV_PLUGIN_PATH=plugin_path(options)), capture_output=True, text=True).stdout
    replayed = [json.loads(line.split(" ", 1)[1]) for line in output.splitlines() if line.startswith("replayed ")]
    print(f"trace: {trace.count('.Center = ')} changes of Center, replayed {replayed}, dragged to {center}")
    if during or trace.count(".Center = ") != 1 or not replayed or not numpy.allclose(replayed[0], center):
        print(f"FAILED: {len(during)} updates before the release, trace:\n{trace}")
        return 1
    print("passed")
    return 0


def watch(options, log):
    ready = wait_for("the rounded model", lambda: next((line for line in read(log) if "handle" in line), None))
    corner = wait_for("the view", view_corner)
    time.sleep(2)  # the first pictures of the window
    x, y = (round(corner[i] + ready["handle"][i]) for i in (0, 1))
    begin, end, pictures = drag([(x + right, y - up) for right, up in PATH], options.seconds,
                                options.pictures or options.strip)

    def center_is(center):
        return lambda: numpy.allclose(updates(log)[-1]["center"], center, atol=0.02 * ready["radius"]) or None

    wait_for("the model to be where the handle was let go", center_is(ready["released"]), 20)
    time.sleep(1)  # it may have been there before the button was up
    if options.pictures:
        save_pictures(pictures + [ImageGrab.grab()], options.pictures)
    if options.strip:
        save_strip(pictures, (x, y), options.strip)
    during = [line["time"] for line in updates(log, begin, end)]
    gaps = numpy.diff([begin, *during, end])
    print(f"{os.path.basename(options.model)}: {len(during)} updates in {end - begin:.1f} s, "
          f"{len(during) / (end - begin):.1f} per second, longest pause {1000 * gaps.max():.0f} ms")

    undone = time.time()
    subprocess.run(["xdotool", "key", "ctrl+z"], check=True)
    wait_for("undo of the whole drag", center_is(ready["center"]), 20)
    messages = [line["message"] for line in read(log) if "message" in line and line["time"] < undone]
    print(f"messages: {messages}")
    if len(messages) != options.messages:
        print(f"FAILED: {len(messages)} messages, and not {options.messages}")
        return 1
    if options.trace:
        trace = wait_for("the trace", lambda: next((line["trace"] for line in read(log) if "trace" in line), None))
        return check_trace(options, trace, during, updates(log, end=undone)[-1]["center"])
    if len(during) < 2:  # it would be one, after the button, without pqUpdateWhileDragging
        print("FAILED: the model did not follow")
        return 1
    print("passed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
