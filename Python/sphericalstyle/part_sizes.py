# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Larger heads and smaller hands with one call: sphericalstyle.resize. Rounder ones: round() with part_roundness."""
import collections.abc
import numbers

from . import meshes
from .properties import execute
from .surface_parts import parts as find_parts
from .SphericalStyleFilters import vtkPartSizesFilter


def _rows(values, keyword, example="{0: 1.3}"):
    """@raise TypeError for what is no dict of whole numbers and numbers"""
    if values is None:
        return ()
    if not isinstance(values, collections.abc.Mapping):
        raise TypeError(f"{keyword} must be a dict of parts and numbers, such as {example}, not {values!r}")
    for part, value in values.items():
        if not isinstance(part, numbers.Integral) or isinstance(part, bool):
            raise TypeError(f"{keyword}: parts are whole numbers, as sphericalstyle.parts gives them, not {part!r}")
        if not isinstance(value, numbers.Real):
            raise TypeError(f"{keyword}: the value of part {part} must be a number, not {value!r}")
    return values.items()


def _prepare(surface, parts):
    """A filter and its input: the surface with an array of the parts, whose name comes last."""
    copy = surface.NewInstance()
    copy.ShallowCopy(surface)
    ids = meshes.array_of(find_parts(surface) if parts is None else parts, "parts")
    if ids.GetNumberOfTuples() != surface.GetNumberOfPoints():
        way_out = "" if ids.GetNumberOfTuples() > surface.GetNumberOfPoints() else \
            "; where round() splits coarse panels, give the mesh the parts as point array PartId before, and no parts here"
        raise ValueError(f"parts has {ids.GetNumberOfTuples()} values for {surface.GetNumberOfPoints()} points{way_out}")
    name = "parts of sphericalstyle"
    ids.SetName(name)
    copy.GetPointData().AddArray(ids)
    filter_ = vtkPartSizesFilter()
    filter_.SetInputArrayToProcess(0, 0, 0, 0, name)
    return filter_, copy, name


def style_arrays(surface, parts, roundness, normal_blend):
    """The arrays with which vtkSphericalStyleFilter rounds parts of a vtkPolyData in another way. What round() does
    with part_roundness and part_normal_blend."""
    rows = _rows(roundness, "part_roundness", "{0: 2.0}"), _rows(normal_blend, "part_normal_blend", "{0: 0.5}")
    filter_, copy, _ = _prepare(surface, parts)
    for part, value in rows[0]:
        filter_.SetPartRoundness(part, value)
    for part, value in rows[1]:
        filter_.SetPartNormalBlend(part, value)
    execute(filter_, copy)
    made = filter_.GetOutput().GetPointData()
    # None of a part that is not there, of which there was a warning
    arrays = [made.GetArray(name) for name, given in zip(("PartRoundness", "PartNormalBlend"), rows) if given]
    return [array for array in arrays if array]


def resize(mesh, sizes=None, *, parts=None, head_height=0.0, head=-1, up_axis="Y", blend_width=0.05,
           keep_on_ground=False):
    """Returns a copy of a mesh whose parts have other sizes: a large head, small hands.

    mesh: a vtkPolyData, a PyVista mesh, an object with vertices and faces such as a trimesh, or a tuple of arrays
    (points, faces). The result is of the same kind.

    sizes: a dict of parts (whole numbers) and their sizes, as multiples of what they are. What hangs on the head alone,
    such as ears, has the size of the head unless it has one of its own.

    parts: the part of each point, as sphericalstyle.parts gives it, which this function calls by default. For a rounded
    mesh take the parts of the original, where they are easier to find.

    head_height: the height of the head over that of the rest, along up_axis ("X", "Y" or "Z"); .5 makes a figure
    three heads high. What hangs on the head alone counts for neither. 0: as sizes say. head: the part that is the head;
    -1: the highest one that is no ear or hand.

    blend_width: how far parts pass into each other, as a fraction of the diagonal of the bounds. keep_on_ground: the
    lowest point stays at its height.

    Raises sphericalstyle.Error with the filter's message if the mesh or a size cannot be used, ValueError for parts of
    another length and values of other keywords that are out of range, TypeError for values of another kind and sizes
    that are no dict of whole numbers and numbers.

    A snowman with a large head:

    >>> import sphericalstyle as ss
    >>> from vtkmodules.vtkFiltersCore import vtkAppendPolyData
    >>> from vtkmodules.vtkFiltersSources import vtkSphereSource
    >>> snowman = vtkAppendPolyData()
    >>> for radius, y in ((1.0, 0.0), (0.6, 1.35)):
    ...     ball = vtkSphereSource()
    ...     ball.SetThetaResolution(32)
    ...     ball.SetPhiResolution(32)
    ...     ball.SetRadius(radius)
    ...     ball.SetCenter(0.0, y, 0.0)
    ...     snowman.AddInputConnection(ball.GetOutputPort())
    >>> snowman.Update()
    >>> ids = ss.parts(snowman.GetOutput())
    >>> toy = ss.resize(ss.round(snowman.GetOutput(), preset="Soft"), {1: 1.6}, parts=ids)
    >>> bool(toy.GetLength() > snowman.GetOutput().GetLength())
    True
    """
    rows = _rows(sizes, "sizes")
    surface, back = meshes.take(mesh, "resize")
    filter_, copy, name = _prepare(surface, parts)
    for part, size in rows:
        filter_.SetPartSize(part, size)
    execute(filter_, copy, head_height=head_height, head=head, blend_width=blend_width, keep_on_ground=keep_on_ground,
            up_axis=up_axis)
    result = surface.NewInstance()
    result.ShallowCopy(filter_.GetOutput())
    result.GetPointData().RemoveArray(name)
    return back(result)
