# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Larger heads and smaller hands with one call: sphericalstyle.resize."""
from . import meshes
from .messages import execute
from .surface_parts import parts as find_parts
from .SphericalStyleFilters import vtkPartSizesFilter


def resize(mesh, sizes=None, *, parts=None, head_height=0.0, head=-1, up_axis="Y", blend_width=0.05,
           keep_on_ground=False):
    """Returns a copy of a mesh whose parts have other sizes: a large head, small hands.

    mesh: a vtkPolyData, a PyVista mesh, an object with vertices and faces such as a trimesh, or a tuple of arrays
    (points, faces). The result is of the same kind.

    sizes: a dict of parts and their sizes, as multiples of what they are.

    parts: the part of each point, as sphericalstyle.parts gives it; by default that of this mesh. For a rounded mesh
    take the parts of the original, where they are easier to find.

    head_height: the height of the head over that of the rest, along up_axis ("X", "Y" or "Z"); .5 makes a figure
    three heads high. 0: as sizes say. head: the part that is the head; -1: the highest one that is no ear or hand.

    blend_width: how far parts pass into each other, as a fraction of the diagonal of the bounds. keep_on_ground: the
    lowest point stays at its height.

    Raises sphericalstyle.Error with the filter's message if the mesh cannot be used, ValueError for parts of another
    length.

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
    for part, size in (sizes or {}).items():
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
