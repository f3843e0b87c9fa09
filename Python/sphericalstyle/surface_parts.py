# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The parts of a mesh with one call: sphericalstyle.parts."""
from . import meshes
from .properties import execute
from .SphericalStyleFilters import vtkSurfacePartsFilter


def parts(mesh, number=0):
    """Returns the part of each point of a mesh, such as head, hands and legs: an array of whole numbers, 0 for the
    largest part, -1 for points of no face.

    mesh: a vtkPolyData, a PyVista mesh, an object with vertices and faces such as a trimesh, or a tuple of arrays
    (points, faces).

    number: how many parts; 0: as many as are clearly there. sphericalstyle.StyleWarning tells where there are fewer or
    more.

    Raises sphericalstyle.Error with the filter's message if the mesh cannot be used, ValueError for a number that is
    out of range.

    A snowman, whose body and head become balls of their own:

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
    >>> int(ids.max()) + 1
    2
    >>> rounded = ss.round(snowman.GetOutput(), center_id=ids, normal_blend=0, detail_size=0)
    """
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy

    surface, _ = meshes.take(mesh, "parts")
    found = vtkSurfacePartsFilter()
    execute(found, surface, {"number": "NumberOfParts"}, number=number)
    ids = found.GetOutput().GetPointData().GetArray("PartId")  # none where there are no points
    return vtk_to_numpy(ids).copy() if ids else np.empty(0, int)
