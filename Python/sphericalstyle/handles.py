# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Models bent, stretched or posed by handles with one call: sphericalstyle.deform."""
import collections.abc

from . import meshes
from .properties import execute
from .SphericalStyleFilters import vtkHandleDeformFilter

_KEYS = ("place", "radius", "to", "rotation")


def _numbers(value, count, what):
    """@raise TypeError, ValueError naming what is no row of so many numbers"""
    try:
        values = [float(x) for x in value]
    except (TypeError, ValueError):
        raise TypeError(f"{what} must be {count} numbers, not {value!r}") from None
    except OverflowError:
        raise ValueError(f"{what} must be {count} numbers; one is too large") from None
    if len(values) != count:
        raise ValueError(f"{what} must be {count} numbers, not {len(values)}")
    return values


def _row(number, handle):
    """The ten numbers of a handle. @raise TypeError, ValueError naming it by its number"""
    what = f"handle {number}"
    if isinstance(handle, collections.abc.Mapping):
        unknown = [key for key in handle if key not in _KEYS]
        if unknown or "place" not in handle:
            raise TypeError(f"{what} must have a place, and may have radius, to and rotation;"
                            f" it has {', '.join(map(str, handle)) or 'nothing'}")
        handle = [handle.get(key) for key in _KEYS]
    elif isinstance(handle, collections.abc.Sequence) and not isinstance(handle, str) and 0 < len(handle) <= len(_KEYS):
        handle = [*handle, *[None] * (len(_KEYS) - len(handle))]
    else:
        raise TypeError(f"{what} must be a dict, or a tuple (place, radius, to, rotation), not {handle!r}")
    place, radius, to, rotation = handle
    place = _numbers(place, 3, f"{what}: place")
    return [*place, *_numbers([0.0 if radius is None else radius], 1, f"{what}: radius"),
            *(place if to is None else _numbers(to, 3, f"{what}: to")),
            *_numbers((0.0, 0.0, 0.0) if rotation is None else rotation, 3, f"{what}: rotation")]


def deform(mesh, handles, *, independent=False, tolerance=None, maximum_iterations=None):
    """Returns a copy of a mesh that is bent, stretched or posed by handles; details are carried along.

    mesh: a vtkPolyData, a PyVista mesh, an object with vertices and faces such as a trimesh, or a tuple of arrays
    (points, faces). The result is of the same kind.

    handles: a list with a dict, or a tuple (place, radius, to, rotation), for each handle. It holds all points within
    radius of place, and always the nearest one. It turns them about place by rotation, a vector in degrees, so that
    (0, 0, 90) is a quarter about z, and then moves place to to. By default radius is 0, to is place and rotation
    nothing: {"place": (0, 0, 0), "radius": 0.2} pins its points. One handle alone moves the mesh as a whole.

    independent: whether parts of the mesh without a handle stay; by default they go along with those that they are near.

    tolerance: how much of what the energy can fall by may be missing at the end; maximum_iterations: how many
    iterations there may be. Both have defaults that fit.

    Raises sphericalstyle.Error with the filter's message if the mesh or the handles cannot be used, such as where two
    handles hold the same point; TypeError or ValueError for handles that are no such rows, and for values that are out
    of range or of another kind.

    A ball whose top is drawn up and turned by a quarter, while its bottom stays:

    >>> import sphericalstyle as ss
    >>> from vtkmodules.vtkFiltersSources import vtkSphereSource
    >>> ball = vtkSphereSource()
    >>> ball.SetThetaResolution(32)
    >>> ball.SetPhiResolution(32)
    >>> ball.Update()
    >>> bottom = {"place": (0, 0, -0.5), "radius": 0.2}
    >>> top = {"place": (0, 0, 0.5), "radius": 0.2, "to": (0, 0, 0.7), "rotation": (0, 0, 90)}
    >>> drop = ss.deform(ball.GetOutput(), [bottom, top])
    >>> [round(float(z), 3) for z in drop.GetBounds()[4:]]
    [-0.5, 0.7]
    """
    rows = [_row(number, handle) for number, handle in enumerate(handles, 1)]
    surface, back = meshes.take(mesh, "deform")
    filter_ = vtkHandleDeformFilter()
    for row in rows:
        filter_.AddHandle(row)
    if independent:
        filter_.SetComponentCouplingToIndependent()
    execute(filter_, surface, {"maximum_iterations": "MaximumNumberOfIterations"}, tolerance=tolerance,
            maximum_iterations=maximum_iterations)
    result = surface.NewInstance()
    result.ShallowCopy(filter_.GetOutput())
    return back(result)
