# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round a mesh and show it: the driver of Utilities/demo.sh, which see.

usage: pvpython demo.py MESH OUTPUT_FOLDER [--up x|y|z] [--view DEGREES]
"""
import argparse
import csv
import math
import pathlib
import re
import sys
import time

import vtkmodules.vtkInteractionStyle  # noqa: F401, makes render windows work
import vtkmodules.vtkRenderingFreeType  # noqa: F401, makes text work
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, makes rendering work
from vtkmodules.vtkCommonCore import VTK_STRING
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals, vtkTriangleFilter
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLightKit, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)

from sphericalstyle import vtkSphericalStyleFilter

READERS = {
    ".ply": vtkPLYReader,
    ".stl": vtkSTLReader,
    ".obj": vtkOBJReader,
    ".vtk": vtkGenericDataObjectReader,
    ".vtp": vtkXMLPolyDataReader,
}
ROUNDNESS, DETAIL_SIZE = 0.5, 0.03  # of the main result
SERIES_ROUNDNESS = [0.0, 0.1, 0.5, 2.0, 5.0]  # columns
SERIES_DETAIL_SIZE = [0.0, 0.03]  # rows

CLAY = (0.88, 0.62, 0.47)
INK = (0.25, 0.22, 0.20)
RED = (0.80, 0.12, 0.10)
VIEW_ANGLE = 24.0  # degrees; narrow, so that near parts do not swell


class DemoError(Exception):
    """What went wrong, in words for the user."""


class Messages:
    """Errors and warnings of an algorithm, which VTK would print and go on."""

    warned = set()  # each warning once, though the series runs the filter ten times

    def __init__(self, algorithm):
        self.errors = []
        self.failed = False  # the executive's errors say no more than that
        algorithm.AddObserver("ErrorEvent", self._error)
        algorithm.AddObserver("WarningEvent", self._warning)
        algorithm.GetExecutive().AddObserver("ErrorEvent", self._failure)

    def _error(self, _source, _event, text):
        self.errors.append(self._plain(text))

    def _failure(self, _source, _event):
        self.failed = True

    def _warning(self, _source, _event, text):
        warning = self._plain(text)
        if warning not in self.warned:
            self.warned.add(warning)
            print(f"Warning: {warning}", file=sys.stderr)

    _error.CallDataType = VTK_STRING
    _warning.CallDataType = VTK_STRING

    @staticmethod
    def _plain(text):
        """Without source file, line and address."""
        return re.sub(r"^\w+: In .*\n\w+ \(0x[0-9a-f]+\): ", "", text.strip())

    def raise_errors(self, what):
        if self.errors or self.failed:
            raise DemoError("\n  ".join([what, *dict.fromkeys(self.errors)]))


def read(path):
    """The file's surface, or a DemoError that says why there is none."""
    suffix = path.suffix.lower()
    if suffix not in READERS:
        raise DemoError(f"{path}: cannot read files {suffix or 'without an ending'};"
                        f" known: {' '.join(sorted(READERS))}")
    if not path.is_file():
        raise DemoError(f"{path}: no such file")
    if path.stat().st_size == 0:
        raise DemoError(f"{path}: the file is empty")
    reader = READERS[suffix]()
    messages = Messages(reader)
    reader.SetFileName(str(path))
    reader.Update()
    messages.raise_errors(f"{path}: cannot be read as {suffix}")
    surface = reader.GetOutputDataObject(0)
    if surface is None:
        raise DemoError(f"{path}: cannot be read as {suffix}")
    if not isinstance(surface, vtkPolyData):
        raise DemoError(f"{path}: holds a {surface.GetClassName()}, not a surface (vtkPolyData);"
                        " take its surface first, in ParaView with Extract Surface")
    if surface.GetNumberOfPolys() + surface.GetNumberOfStrips() == 0:
        raise DemoError(f"{path}: holds {surface.GetNumberOfPoints()} points and no faces")
    return surface


def rounded(surface, roundness, detail_size):
    """The executed filter; port 0 has the surface, port 1 the energies."""
    style = vtkSphericalStyleFilter()
    messages = Messages(style)
    style.SetInputData(surface)
    style.SetRoundness(roundness)
    style.SetDetailSize(detail_size)
    style.Update()
    messages.raise_errors("The filter failed:")
    if style.GetOutput().GetNumberOfPoints() != surface.GetNumberOfPoints():
        raise DemoError("The filter gave no result and no reason.")
    return style


def write(writer, path, surface):
    messages = Messages(writer)
    writer.SetFileName(str(path))
    writer.SetInputData(surface)
    written = writer.Write()
    messages.raise_errors(f"{path}: cannot be written")
    if not written:
        raise DemoError(f"{path}: cannot be written")


def write_table(path, table):
    columns = [table.GetColumn(c) for c in range(table.GetNumberOfColumns())]
    with open(path, "w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file)
        lines.writerow([column.GetName() for column in columns])
        for row in range(table.GetNumberOfRows()):
            lines.writerow([column.GetValue(row) for column in columns])


def triangle_count(surface):
    triangles = vtkTriangleFilter()
    triangles.PassLinesOff()
    triangles.PassVertsOff()
    triangles.SetInputData(surface)
    triangles.Update()
    return triangles.GetOutput().GetNumberOfPolys()


# ----------------------------------------------------------------------------------------- pictures
def actor_of(surface):
    """The surface in clay. Texture seams are closed first: shading would show them as cracks."""
    geometry = vtkPolyData()
    geometry.CopyStructure(surface)
    triangles = vtkTriangleFilter()
    triangles.PassLinesOff()
    triangles.PassVertsOff()
    triangles.SetInputData(geometry)
    seamless = vtkCleanPolyData()
    seamless.SetTolerance(0.0)
    seamless.SetInputConnection(triangles.GetOutputPort())
    normals = vtkPolyDataNormals()
    normals.SetFeatureAngle(60.0)  # edges of a box stay edges
    normals.SetInputConnection(seamless.GetOutputPort())
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    clay = actor.GetProperty()
    clay.SetColor(CLAY)
    clay.SetAmbient(0.14)
    clay.SetDiffuse(0.88)
    clay.SetSpecular(0.10)
    clay.SetSpecularPower(12.0)
    return actor


def axes_of(up):
    """(up, front): where models that stand along this axis usually look to."""
    return {
        "x": ((1, 0, 0), (0, 0, 1)),
        "y": ((0, 1, 0), (0, 0, 1)),
        "z": ((0, 0, 1), (0, -1, 0)),
    }[up]


def half_size(surface):
    """Half of what has to be seen of it: long models need more than the diagonal tells."""
    x0, x1, y0, y1, z0, z1 = surface.GetBounds()
    return max(0.45 * surface.GetLength(), 0.57 * max(x1 - x0, y1 - y0, z1 - z0))


def place_camera(renderer, surface, size, up, view):
    """From the front, turned by view degrees, a little from above; size: half of what is seen."""
    up, front = axes_of(up)
    bounds = surface.GetBounds()
    center = [0.5 * (bounds[2 * i] + bounds[2 * i + 1]) for i in range(3)]
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(center)
    camera.SetViewUp(up)
    distance = size / math.sin(math.radians(0.5 * VIEW_ANGLE))
    camera.SetPosition([c + distance * f for c, f in zip(center, front)])
    camera.SetViewAngle(VIEW_ANGLE)
    width, height = renderer.GetSize()
    camera.SetUseHorizontalViewAngle(width < height)  # the narrower side has to hold the model
    camera.Azimuth(view)
    camera.Elevation(14.0)
    camera.OrthogonalizeViewUp()
    camera.SetWindowCenter(0.0, -0.06)  # leaves the foot of the picture to the label
    renderer.ResetCameraClippingRange()


def soft_light(renderer):
    kit = vtkLightKit()
    kit.SetKeyLightIntensity(0.84)
    kit.SetKeyLightAngle(42.0, -28.0)
    kit.SetKeyToFillRatio(2.1)
    kit.SetKeyToBackRatio(2.6)
    kit.SetKeyToHeadRatio(3.6)
    kit.AddLightsToRenderer(renderer)


def add_text(renderer, text, x, y, points, font=None):
    """Centred at the fraction (x, y) of the renderer's part of the window. font: a TrueType file."""
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(x, y)
    style = actor.GetTextProperty()
    style.SetFontSize(points)
    style.SetColor(INK)
    style.SetJustificationToCentered()
    style.SetVerticalJustificationToCentered()
    if font:
        style.SetFontFamilyAsString("File")
        style.SetFontFile(font)
    renderer.AddActor2D(actor)


def lines_of(lines):
    """Thin red lines."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(lines)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(RED)
    actor.GetProperty().LightingOff()
    return actor


def picture(path, size, panels, up, view, points, make_actor=actor_of, font=None):
    """Write a PNG of rows of (surface, label[, lines[, view]]), all in the same scale, from the same
    side unless a panel has a view of its own. make_actor(surface): other than in clay. font: a
    TrueType file for labels that VTK's own fonts have no letters for."""
    surfaces = [panel[0] for row in panels for panel in row]
    seen = max(half_size(surface) for surface in surfaces)
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetSize(size)
    window.SetMultiSamples(8)
    for r, row in enumerate(panels):
        top = 1.0 - r / len(panels)
        for c, (surface, label, *more) in enumerate(row):
            renderer = vtkRenderer()
            renderer.SetViewport(c / len(row), top - 1.0 / len(panels), (c + 1) / len(row), top)
            renderer.SetBackground(1.0, 1.0, 1.0)
            renderer.AutomaticLightCreationOff()
            renderer.AddActor(make_actor(surface))
            if more and more[0]:
                renderer.AddActor(lines_of(more[0]))
            soft_light(renderer)
            window.AddRenderer(renderer)
            place_camera(renderer, surface, seen, up, more[1] if len(more) > 1 else view)
            add_text(renderer, label, 0.5, 0.045, points, font)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    write_png = vtkPNGWriter()
    messages = Messages(write_png)
    write_png.SetFileName(str(path))
    write_png.SetInputConnection(image.GetOutputPort())
    write_png.Write()
    messages.raise_errors(f"{path}: cannot be written")
    window.Finalize()


# ---------------------------------------------------------------------------------------------- run
def demo(arguments):
    surface = read(arguments.mesh)
    folder = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)

    start = time.perf_counter()
    style = rounded(surface, ROUNDNESS, DETAIL_SIZE)
    seconds = time.perf_counter() - start
    result = style.GetOutput()
    print(f"{arguments.mesh.name}: {surface.GetNumberOfPoints()} points, "
          f"{triangle_count(surface)} triangles, rounded in {seconds:.2f} s, "
          f"{style.GetNumberOfIterations()} iterations")

    series = []
    for detail_size in SERIES_DETAIL_SIZE:
        kept = f"details kept ({detail_size:g})" if detail_size else "details not kept"
        series.append([(rounded(surface, roundness, detail_size).GetOutput(),
                        f"Roundness {roundness:g}, {kept}") for roundness in SERIES_ROUNDNESS])

    files = {
        kind: folder / f"{arguments.mesh.stem}-{kind}"
        for kind in ("rounded.vtp", "rounded.ply", "energy.csv", "before-after.png", "series.png")
    }
    write(vtkXMLPolyDataWriter(), files["rounded.vtp"], result)
    write(vtkPLYWriter(), files["rounded.ply"], result)
    write_table(files["energy.csv"], style.GetOutputDataObject(1))
    before_after = [[(surface, "before"),
                     (result, f"after: Roundness {ROUNDNESS:g}, DetailSize {DETAIL_SIZE:g}")]]
    picture(files["before-after.png"], (1600, 900), before_after, arguments.up, arguments.view, 26)
    picture(files["series.png"], (2000, 900), series, arguments.up, arguments.view, 18)
    for file in files.values():
        print(f"  {file}")


def main():
    parser = argparse.ArgumentParser(description="Round a mesh and show it.")
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--up", choices="xyz", default="y", help="axis that points up")
    parser.add_argument("--view", type=float, default=25.0,
                        help="where the camera stands, degrees around the up axis from the front")
    try:
        demo(parser.parse_args())
    except (DemoError, OSError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
