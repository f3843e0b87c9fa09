# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Models ready for a 3D printer with one call: sphericalstyle.printable."""
from . import SphericalStyleFilters, meshes
from .messages import Error
from .properties import execute


def printable(mesh, *, foot_area=0.03, stability_angle=10.0, minimum_thickness=0.0, volume=0.0, height=0.0,
              close_holes=True, place_on_plate=True, up_axis="Y"):
    """Returns a copy of a mesh that can be printed: with a flat foot, standing, closed, and of the wanted size.

    mesh: a vtkPolyData, a PyVista mesh, an object with vertices and faces such as a trimesh, or a tuple of arrays
    (points, faces). The result is of the same kind, with other points and triangles.

    foot_area: the least area of the foot, as a fraction of the rectangle that the mesh covers on the ground. 0: no cut.
    stability_angle: by how many degrees it can be tilted before it falls over. For that the foot is made larger and the
    mesh leans, up to 10 degrees. 0: neither.

    minimum_thickness: thinner walls are made as thick as this, in the unit of the result. 0: they stay as they are.

    A foot, an angle or a wall that cannot be had comes as near as it can, with a warning.

    volume or height: what it is scaled to, in its own unit, which programs for printers take as millimeters; both 0: it
    keeps its volume.

    close_holes: fill the holes of an open mesh, which is an error with False. place_on_plate: turn up_axis ("X", "Y" or
    "Z") to z, and put the foot on z = 0 and the middle on x = y = 0.

    Raises sphericalstyle.Error with the filter's message if the mesh cannot be printed, ValueError for values that are
    out of range, TypeError for values of another kind.

    A ball on a foot, 40 high:

    >>> import sphericalstyle as ss
    >>> from vtkmodules.vtkFiltersSources import vtkSphereSource
    >>> ball = vtkSphereSource()
    >>> ball.SetThetaResolution(32)
    >>> ball.SetPhiResolution(32)
    >>> ball.Update()
    >>> toy = ss.printable(ball.GetOutput(), height=40)
    >>> [round(float(x), 3) for x in toy.GetBounds()[4:]]
    [0.0, 40.0]
    """
    if not hasattr(SphericalStyleFilters, "vtkPrintableFilter"):
        raise Error("this sphericalstyle was built without CGAL (SPHERICALSTYLE_WITH_CGAL), which printable() needs")
    surface, back = meshes.take(mesh, "printable")
    filter_ = SphericalStyleFilters.vtkPrintableFilter()
    execute(filter_, surface, foot_area=foot_area, stability_angle=stability_angle, minimum_thickness=minimum_thickness,
            volume=volume, height=height, close_holes=close_holes, place_on_plate=place_on_plate, up_axis=up_axis)
    result = filter_.GetOutput().NewInstance()
    result.ShallowCopy(filter_.GetOutput())
    return back(result)
