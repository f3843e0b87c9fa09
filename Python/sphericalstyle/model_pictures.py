# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of models, shaded like clay, side by side, in Python with or without ParaView."""
import ctypes
import math
import os

import vtkmodules.vtkInteractionStyle  # noqa: F401, makes render windows work
import vtkmodules.vtkRenderingFreeType  # noqa: F401, makes text work
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, makes rendering work
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals, vtkTriangleFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLightKit, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)

from . import presets
from .model_files import ModelError, run_writer

CLAY = (0.88, 0.62, 0.47)
INK = (0.25, 0.22, 0.20)
RED = (0.80, 0.12, 0.10)
VIEW_ANGLE = 24.0  # degrees; narrow, so that near parts do not look too large


def actor_of(surface):
    """The surface, shaded like clay. Closes texture seams first, which shading would show as cracks."""
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
    normals.SetFeatureAngle(60.0)  # keeps the edges of a box sharp
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
    """(up, front): the direction in which models with this up axis usually face."""
    return {
        "x": ((1, 0, 0), (0, 0, 1)),
        "y": ((0, 1, 0), (0, 0, 1)),
        "z": ((0, 0, 1), (0, -1, 0)),
    }[up]


def half_size(surface):
    """Half of the size that must be visible: long models need more than their diagonal suggests."""
    x0, x1, y0, y1, z0, z1 = surface.GetBounds()
    return max(0.45 * surface.GetLength(), 0.57 * max(x1 - x0, y1 - y0, z1 - z0))


def place_camera(renderer, surface, size, up, view, height=None):
    """Looks from the front, turned by view degrees and slightly from above. size: half of what is visible. height: of
    the tallest of several surfaces, if all are to stand on one ground."""
    bounds = surface.GetBounds()
    center = [0.5 * (bounds[2 * i] + bounds[2 * i + 1]) for i in range(3)]
    if height is not None:
        axis = "xyz".index(up)
        center[axis] = bounds[2 * axis] + 0.5 * height
    up, front = axes_of(up)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(center)
    camera.SetViewUp(up)
    distance = size / math.sin(math.radians(0.5 * VIEW_ANGLE))
    camera.SetPosition([c + distance * f for c, f in zip(center, front)])
    camera.SetViewAngle(VIEW_ANGLE)
    width, height = renderer.GetSize()
    camera.SetUseHorizontalViewAngle(width < height)  # the model must fit the narrower side
    camera.Azimuth(view)
    camera.Elevation(14.0)
    camera.OrthogonalizeViewUp()
    camera.SetWindowCenter(0.0, -0.06)  # leaves room for the label at the bottom
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
    """A text centered at the fraction (x, y) of the renderer's viewport. font: a TrueType file."""
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


def picture(path, size, panels, up, view, points, **options):
    """Write a PNG of panels; see image_of."""
    run_writer(vtkPNGWriter(), path, image_of(size, panels, up, view, points, **options))


def before_after(path, model, style, up, view, preset=None):
    """Writes a PNG with the model beside the result of an executed filter, on one ground and in one scale.
    preset: what its properties come from; without one, that which has the same."""
    preset = presets.name_of(preset) if preset else presets.shown_by(style)
    values = [f"{name} {getattr(style, 'Get' + name)():g}" for name in ("Roundness", "NormalBlend", "DetailSize")]
    label = "after: " + ", ".join([preset] * bool(preset) + values)
    picture(path, (1600, 900), [[(model, "before"), (style.GetOutput(), label)]], up, view, 24, ground=True)


def check_display():
    """@raise ModelError where VTK would end the program, since it has no display to make pictures with"""
    if vtkVersion.GetVTKMajorVersion() * 100 + vtkVersion.GetVTKMinorVersion() >= 904:
        return  # makes pictures without a display
    if vtkRenderWindow().GetClassName() != "vtkXOpenGLRenderWindow":
        return
    try:
        x11 = ctypes.CDLL("libX11.so.6")
    except OSError:
        return
    x11.XOpenDisplay.restype = ctypes.c_void_p
    display = x11.XOpenDisplay(None)
    if not display:
        place = os.environ.get("DISPLAY")
        raise ModelError(f"pictures need a display, and {f'{place} cannot be opened' if place else 'there is none'};"
                         " put xvfb-run -a before the command, or do without pictures")
    x11.XCloseDisplay(ctypes.c_void_p(display))


def image_of(size, panels, up, view, points, make_actor=actor_of, font=None, frame=None, ground=False):
    """A picture of rows of panels (surface, label[, lines[, view]]). All have the same scale, and the same
    view unless a panel has its own. make_actor(surface): replaces the clay shading. font: a TrueType
    file for labels with letters that VTK's own fonts lack. frame: a surface to set the camera for,
    instead of each panel's surface, in a series of pictures. ground: all surfaces stand on one level."""
    check_display()
    surfaces = [frame] if frame else [panel[0] for row in panels for panel in row]
    seen = max(half_size(surface) for surface in surfaces)
    heights = [surface.GetBounds()["xyz".index(up) * 2 + 1] - surface.GetBounds()["xyz".index(up) * 2]
               for surface in surfaces]
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
            place_camera(renderer, frame or surface, seen, up, more[1] if len(more) > 1 else view,
                         max(heights) if ground else None)
            add_text(renderer, label, 0.5, 0.045, points, font)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    image.Update()
    window.Finalize()
    return image.GetOutput()
