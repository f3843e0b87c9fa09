# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Move the center through a model and back, and make a movie of the result.

    python3 animate_center.py MODEL OUTPUT [--axis x|y|z] [--travel 0.2 0.8] [--frames 48] [--rate 24]
                                           [--roundness 2] [--normal-blend 0] [--detail-size 0.06]
                                           [--up y] [--view 25]

It also runs in pvpython. The extension of OUTPUT selects the format: .ogv (Ogg Theora) or .avi (Motion JPEG);
without an extension, OUTPUT is a folder for pictures 0000.png, 0001.png, ... The center moves along an axis
through the middle of the model and back, so that the movie can run in a loop. --travel gives the range of the
movement as fractions of the model's extent.
"""
import argparse
import math
import os
import pathlib
import sys

from vtkmodules.vtkIOFFMPEG import vtkFFMPEGWriter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOOggTheora import vtkOggTheoraWriter

from sphericalstyle import Error
from sphericalstyle.messages import Messages
from sphericalstyle.model_files import read, run_writer, whole
from sphericalstyle.model_pictures import image_of
from sphericalstyle.rounding import execute

SIZE = (640, 640)  # pixels
MOVIES = {".ogv": vtkOggTheoraWriter, ".avi": vtkFFMPEGWriter}


def parse():
    parser = argparse.ArgumentParser(description="Make a movie of the result while the center moves through a model.")
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--axis", choices="xyz", default="y", help="axis along which the center moves")
    parser.add_argument("--travel", type=float, nargs=2, default=[0.2, 0.8], metavar=("FROM", "TO"),
                        help="range of the movement, as fractions of the model's extent (default 0.2 0.8)")
    parser.add_argument("--frames", type=int, default=48)
    parser.add_argument("--rate", type=int, default=24, help="frames per second")
    parser.add_argument("--roundness", type=float, default=2.0)
    parser.add_argument("--normal-blend", type=float, default=0.0,
                        help="0, the default here: one ball around the center; at 1 the center has no effect")
    parser.add_argument("--detail-size", type=float, help="property of the filter; default: that of the filter")
    parser.add_argument("--up", choices="xyz", default="y", help="axis of the model that points up")
    parser.add_argument("--view", type=float, default=25.0,
                        help="angle of the camera around that axis, in degrees from the front")
    arguments = parser.parse_args()
    if arguments.output.suffix not in MOVIES and arguments.output.suffix:
        parser.error(f"OUTPUT: a movie ends in {' or '.join(MOVIES)}, a folder of pictures has no ending")
    if arguments.frames < 1 or arguments.rate < 1:
        parser.error("--frames and --rate: at least 1")
    return arguments


class Pictures:
    """Writes each picture to a file in a folder."""

    def __init__(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        self.folder, self.count = folder, 0

    def add(self, image):
        with whole(self.folder / f"{self.count:04d}.png") as part:
            run_writer(vtkPNGWriter(), part, image)
        self.count += 1

    def end(self):
        pass


class Movie:
    """Adds each picture to a movie."""

    def __init__(self, path, rate):
        self.path, self.writer = path, MOVIES[path.suffix]()
        self.messages = Messages(self.writer)
        self.writer.SetFileName(str(path))
        self.writer.SetRate(rate)
        self.writer.SetQuality(2)  # the best
        self.started = False

    def add(self, image):
        self.writer.SetInputData(image)
        if not self.started:
            self.writer.Start()
            self.started = True
        self.writer.Write()
        self.messages.raise_errors(f"{self.path}: cannot be written")

    def end(self):
        self.writer.End()
        self.messages.raise_errors(f"{self.path}: cannot be written")
        with open(self.path, "r+b") as file:  # VTK does not report a full disk
            size = file.seek(0, os.SEEK_END)
            file.write(bytes(4096))
            file.flush()
            file.truncate(size)


def centers(bounds, axis, travel, frames):
    """Yields positions along the axis through the middle of the box; the movement is slow where it turns."""
    length = bounds[2 * axis + 1] - bounds[2 * axis]
    for frame in range(frames):
        center = [0.5 * (bounds[2 * k] + bounds[2 * k + 1]) for k in range(3)]
        share = 0.5 - 0.5 * math.cos(2.0 * math.pi * frame / frames)
        center[axis] = bounds[2 * axis] + length * (travel[0] + share * (travel[1] - travel[0]))
        yield center


def main():
    arguments = parse()
    surface = read(arguments.model)
    axis = "xyz".index(arguments.axis)
    path = arguments.output
    output = Movie(path, arguments.rate) if path.suffix else Pictures(path)
    style, messages = execute(surface, roundness=arguments.roundness, normal_blend=arguments.normal_blend,
                              detail_size=arguments.detail_size)
    style.SetCenterModeToCustom()
    for center in centers(surface.GetBounds(), axis, arguments.travel, arguments.frames):
        style.SetCenter(center)
        style.Update()  # quick: the filter keeps everything that does not depend on the center
        messages.raise_errors("The filter failed:")
        messages.print_warnings()
        label = f"Center {arguments.axis} = {center[axis]:.3g}"
        output.add(image_of(SIZE, [[(style.GetOutput(), label)]], arguments.up, arguments.view, 18,
                            frame=surface))
    output.end()
    print(f"{path}: {arguments.frames} frames")


if __name__ == "__main__":
    try:
        main()
    except (Error, OSError, ValueError) as error:
        sys.exit(str(error))
