# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the report, with the camera, light and clay shading of the other examples."""
import html

import matplotlib.font_manager
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, makes rendering work
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkImagingCore import vtkImageMapToColors, vtkImageResize
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkColorTransferFunction, vtkPolyDataMapper, vtkTexture

from sphericalstyle import model_pictures

PANEL = (300, 280)  # pixels
FONT = matplotlib.font_manager.findfont("DejaVu Sans")  # has λ, unlike VTK's own fonts
SEQUENTIAL = [(0.96, 0.94, 0.90), (0.96, 0.75, 0.42), (0.85, 0.37, 0.20), (0.42, 0.10, 0.16)]
DIVERGING = [(0.15, 0.30, 0.58), (0.60, 0.72, 0.85), (0.95, 0.94, 0.92), (0.93, 0.66, 0.50),
             (0.66, 0.14, 0.13)]


def write(path, rows, array, limits, view, up, wires):
    """A PNG of the panels; returns HTML of the color bar, empty without an array."""
    limits = limits or _limits_of([panel[0] for row in rows for panel in row], array)
    colors = limits and _colors(limits)

    def actor_of(surface):
        data = _array_of(surface, array)
        if data is None:
            actor = model_pictures.actor_of(surface)
        elif data.GetNumberOfComponents() == 2:
            actor = _checkered(surface)
        else:
            actor = _colored(surface, array, colors, limits)
        if wires:
            actor.GetProperty().EdgeVisibilityOn()
            actor.GetProperty().SetEdgeColor(model_pictures.INK)
            actor.GetProperty().SetLineWidth(0.6)
        return actor

    size = (PANEL[0] * max(len(row) for row in rows), PANEL[1] * len(rows))
    model_pictures.picture(path, size, rows, up, view, 12, make_actor=actor_of, font=FONT)
    return _bar(array, limits) if limits else ""


def _array_of(surface, name):
    if not name:
        return None
    if name == "TCoords":
        return surface.GetPointData().GetTCoords()
    return surface.GetPointData().GetArray(name) or surface.GetCellData().GetArray(name)


def _limits_of(surfaces, name):
    ranges = [data.GetRange() for data in (_array_of(s, name) for s in surfaces)
              if data is not None and data.GetNumberOfComponents() == 1]
    return (min(low for low, _ in ranges), max(high for _, high in ranges)) if ranges else None


def _stops(limits):
    return DIVERGING if limits[0] == -limits[1] else SEQUENTIAL


def _colors(limits):
    colors, stops = vtkColorTransferFunction(), _stops(limits)
    for i, color in enumerate(stops):
        t = i / (len(stops) - 1)
        colors.AddRGBPoint(limits[0] + t * (limits[1] - limits[0]), *color)
    return colors


def _colored(surface, array, colors, limits):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(_shaded(surface))
    if surface.GetPointData().GetArray(array):
        mapper.SetScalarModeToUsePointFieldData()
    else:
        mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray(array)
    mapper.SetColorModeToMapScalars()
    mapper.SetLookupTable(colors)
    mapper.SetScalarRange(limits)
    mapper.InterpolateScalarsBeforeMappingOn()
    return _plain_actor(mapper)


def _checkered(surface):
    """A checkerboard over the texture coordinates, as in Fig. 4.9 of the thesis."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(_shaded(surface))
    mapper.ScalarVisibilityOff()
    actor = _plain_actor(mapper)
    board = vtkImageData()
    board.SetDimensions(2, 2, 1)
    board.AllocateScalars(3, 3)  # unsigned char, RGB
    for x in range(2):
        for y in range(2):
            for c, value in enumerate((235, 226, 214) if x == y else (178, 74, 52)):
                board.SetScalarComponentFromDouble(x, y, 0, c, value)
    texture = vtkTexture()
    texture.SetInputData(board)
    texture.RepeatOn()
    texture.InterpolateOff()
    many = vtkTransform()
    many.Scale(12.0, 6.0, 1.0)
    texture.SetTransform(many)
    actor.SetTexture(texture)
    return actor


def _shaded(surface):
    """Normals as for the clay shading of model_pictures. No points are merged, so that arrays still fit."""
    normals = vtkPolyDataNormals()
    normals.SetFeatureAngle(60.0)
    normals.ConsistencyOff()
    normals.SetInputData(surface)
    normals.Update()
    return normals.GetOutput()


def _plain_actor(mapper):
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.25)
    actor.GetProperty().SetDiffuse(0.75)
    return actor


def _bar(array, limits):
    """The color bar as SVG, since browsers do not print CSS backgrounds."""
    stops = _stops(limits)
    marks = "".join('<stop offset="{:.0%}" stop-color="rgb({:.0f}, {:.0f}, {:.0f})"/>'.format(
        i / (len(stops) - 1), *(255.0 * c for c in color)) for i, color in enumerate(stops))
    name = "diverging" if stops is DIVERGING else "sequential"
    low, high = (f"{value:.3g}" for value in limits)
    return (f'<span class="bar">{html.escape(array)}: {low} <svg width="180" height="12"><defs>'
            f'<linearGradient id="{name}">{marks}</linearGradient></defs>'
            f'<rect width="180" height="12" fill="url(#{name})"/></svg> {high}</span>')


def write_image(path, data, width=900):
    """A PNG of an image: colors as they are, one component in the colors of the pictures."""
    image = vtkImageResize()
    image.SetInputData(data)
    image.InterpolateOff()
    columns, rows, _ = data.GetDimensions()
    image.SetOutputDimensions(width, max(1, round(width * rows / columns)), 1)
    source = image
    if data.GetNumberOfScalarComponents() == 1:
        table = vtkLookupTable()
        low, high = data.GetScalarRange()
        table.SetNumberOfTableValues(256)
        table.SetTableRange(low, high)
        colors = _colors((0.0, 1.0))
        for i in range(256):
            table.SetTableValue(i, *colors.GetColor(i / 255.0), 1.0)
        source = vtkImageMapToColors()
        source.SetLookupTable(table)
        source.SetOutputFormatToRGB()
        source.SetInputConnection(image.GetOutputPort())
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputConnection(source.GetOutputPort())
    writer.Write()
