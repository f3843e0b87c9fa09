# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Conversion between vtkPolyData or vtkTable and numpy."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from sphericalstyle import model_files


def surface(positions, faces):
    """A vtkPolyData in double precision."""
    faces = np.asarray(faces, dtype=np.int64)
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtk(np.arange(0, faces.size + 1, 3, dtype=np.int64), deep=True),
                  numpy_to_vtk(faces.ravel(), deep=True))
    result = vtkPolyData()
    result.SetPoints(_points(positions))
    result.SetPolys(cells)
    return result


def moved(original, positions):
    """A copy of the surface with other positions."""
    result = original.NewInstance()
    result.ShallowCopy(original)
    result.SetPoints(_points(positions))
    return result


def part(original, flags):
    """A surface of the flagged triangles and the points they use."""
    used, faces = np.unique(triangles(original)[flags], return_inverse=True)
    return surface(points(original)[used], faces.reshape(-1, 3))


def _points(positions):
    result = vtkPoints()
    result.SetData(numpy_to_vtk(np.array(positions, dtype=float), deep=True))
    return result


def points(surface):
    """n x 3, double."""
    return vtk_to_numpy(surface.GetPoints().GetData()).astype(float)


def triangles(surface):
    """m x 3; the surface has triangles only."""
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def array(surface, name):
    """A point array, or else a cell array, as numbers."""
    data = surface.GetPointData().GetArray(name) or surface.GetCellData().GetArray(name)
    if data is None:
        raise model_files.ModelError(f"There is no array {name}.")
    return vtk_to_numpy(data)


def with_array(surface, name, values):
    """A shallow copy with one more array, of the points or cells by its length."""
    result = surface.NewInstance()
    result.ShallowCopy(surface)
    data = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    data.SetName(name)
    of_points = len(values) == surface.GetNumberOfPoints()
    (result.GetPointData() if of_points else result.GetCellData()).AddArray(data)
    return result


def columns(table):
    """{name: numbers} of a vtkTable; columns of text are left out."""
    result = {}
    for c in range(table.GetNumberOfColumns()):
        column = table.GetColumn(c)
        if column.IsNumeric():
            result[column.GetName()] = vtk_to_numpy(column)
    return result
