# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Larger heads and smaller hands with one call: sphericalstyle.resize."""
import collections.abc
import numbers

from . import meshes
from .messages import execute
from .surface_parts import parts as find_parts
from .SphericalStyleFilters import vtkPartSizesFilter


def _rows(sizes):
    """@raise TypeError for what is no dict of whole numbers and sizes"""
    if not isinstance(sizes, collections.abc.Mapping):
        raise TypeError(f"sizes must be a dict of parts and their sizes, such as {{0: 1.3}}, not {sizes!r}")
    for part, size in sizes.items():
        if not isinstance(part, numbers.Integral) or isinstance(part, bool):
            raise TypeError(f"sizes: parts are whole numbers, as sphericalstyle.parts gives them, not {part!r}")
        if not isinstance(size, numbers.Real):
            raise TypeError(f"sizes: the size of part {part} must be a number, not {size!r}")
    return sizes.items()


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

    Raises sphericalstyle.Error with the filter's message if the mesh cannot be used, ValueError for parts of another
    length, TypeError for sizes that are no dict of whole numbers and sizes.

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
    rows = _rows({} if sizes is None else sizes)
    surface, back = meshes.take(mesh, "resize")
    copy = surface.NewInstance()
    copy.ShallowCopy(surface)
    if parts is None:
        parts = find_parts(surface)
    ids = meshes.array_of(parts, "parts")
    if ids.GetNumberOfTuples() != surface.GetNumberOfPoints():
        raise ValueError(f"parts has {ids.GetNumberOfTuples()} values for {surface.GetNumberOfPoints()} points")
    name = "parts of resize()"
    ids.SetName(name)
    copy.GetPointData().AddArray(ids)
    filter_ = vtkPartSizesFilter()
    filter_.SetInputArrayToProcess(0, 0, 0, 0, name)
    for part, size in rows:
        filter_.SetPartSize(part, size)
    filter_.SetHeadHeight(head_height)
    filter_.SetHead(head)
    filter_.SetBlendWidth(blend_width)
    filter_.SetKeepOnGround(keep_on_ground)
    filter_.SetUpAxis("XYZ".index(str(up_axis).upper()))
    execute(filter_, copy)
    result = surface.NewInstance()
    result.ShallowCopy(filter_.GetOutput())
    result.GetPointData().RemoveArray(name)
    return back(result)
