# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of others as vtkPolyData, and the result back. numpy is imported only where there are arrays."""
import copy
import dataclasses
import sys

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkCompositeDataSet, vtkDataSet, vtkPolyData


def take(mesh, function="round"):
    """@return the mesh for VTK, and a function that makes a mesh of its kind of a result"""
    if isinstance(mesh, (vtkDataSet, vtkCompositeDataSet)):
        pyvista = sys.modules.get("pyvista")
        wraps = pyvista is not None and isinstance(mesh, pyvista.DataObject)
        return mesh, pyvista.wrap if wraps else lambda result: result
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        surface = surface_of(mesh.vertices, mesh.faces)
        return surface, lambda result: _object(mesh, surface, result)
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        points, faces = mesh
        if not hasattr(faces, "__len__") and hasattr(faces, "__iter__"):
            faces = list(faces)  # of a generator, which gives them once
        surface = surface_of(points, faces)
        return surface, lambda result: (_points(result), _faces(faces, surface, result))
    raise TypeError(f"{function}() takes a vtkPolyData, a PyVista mesh, an object with vertices and faces, or a tuple"
                    f" (points, faces), and not a {type(mesh).__name__}")


def surface_of(points, faces):
    """A vtkPolyData of arrays."""
    surface = vtkPolyData()
    vtk_points = vtkPoints()
    vtk_points.SetData(point_array(points, "points"))
    surface.SetPoints(vtk_points)
    surface.SetPolys(_cells(faces))
    return surface


def array_of(values, what):
    """A vtkDataArray of numbers, or of rows of numbers."""
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtk

    _refuse_masked(values, what)
    array = np.ascontiguousarray(values)
    if array.dtype.kind == "b":
        array = array.astype(np.uint8)
    elif array.dtype.kind == "f" and array.dtype.itemsize not in (4, 8):
        array = array.astype(np.float64)
    array = array.astype(array.dtype.newbyteorder("="), copy=False)  # VTK takes the bytes as they are
    if array.dtype.kind not in "iuf" or array.ndim not in (1, 2):
        raise ValueError(f"{what} must be an array with a number, or a row of numbers, for each point")
    return numpy_to_vtk(array, deep=True)


def _refuse_masked(values, what):
    import numpy as np

    if np.ma.is_masked(values):
        raise ValueError(f"{what} must have a value everywhere, and some are masked; fill them first")


def point_array(points, what):
    """n x 3 coordinates; those of single precision stay so."""
    import numpy as np

    array = np.asanyarray(points)  # which keeps a mask, for array_of to refuse
    if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "iuf":
        raise ValueError(f"{what} must be an array of n x 3 numbers; it is {_shape(array)}")
    return array_of(array if array.dtype in (np.float32, np.float64) else array.astype(np.float64), what)


def _shape(array):
    return f"{' x '.join(map(str, array.shape)) or 'one value'} of {array.dtype}"


def _cells(faces):
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray

    words = "faces must be an array of m x 3 or m x 4 point numbers, or a list of lists of point numbers"
    if isinstance(faces, np.ndarray):
        if faces.ndim != 2:
            raise ValueError(f"{words}; it is {_shape(faces)}")
        _refuse_masked(faces, "faces")
        sizes, numbers = np.full(len(faces), faces.shape[1]), faces.ravel()
    else:
        if not hasattr(faces, "__iter__"):
            raise TypeError(f"{words}, not {faces!r}")
        rows = [np.asarray(face) for face in faces]
        if any(row.ndim != 1 for row in rows):
            raise ValueError(words)
        sizes, numbers = np.array([len(row) for row in rows]), np.concatenate([np.empty(0, int), *rows])
    if numbers.size and numbers.dtype.kind not in "iu":
        raise ValueError(f"{words}; it has numbers of {numbers.dtype}")
    _refuse_counts(sizes, numbers)
    offsets = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(numbers, np.int64), deep=True))
    return cells


def _refuse_counts(sizes, numbers):
    """Refuses rows such as 3, a, b, c, which would be quads: all begin with their count of corners, and the point of
    that number occurs in some of them again, as it does in no quad."""
    if len(sizes) == 0 or (sizes != sizes[0]).any() or sizes[0] < 4:
        return
    rows, count = numbers.reshape(-1, sizes[0]), sizes[0] - 1
    if (rows[:, 0] == count).all() and (rows[:, 1:] == count).any():
        raise ValueError(f"each face begins with {count}, as if that were its count of corners, which faces of VTK and"
                         " PyVista have; leave that out, faces[:, 1:] of an array, or give the PyVista mesh itself")


def _points(surface):
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy

    points = surface.GetPoints()
    return vtk_to_numpy(points.GetData()).copy() if points else np.empty((0, 3))


def _structure(surface):
    """The point numbers of all faces, and where each face begins."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    polys = surface.GetPolys()
    return [vtk_to_numpy(array) for array in (polys.GetConnectivityArray(), polys.GetOffsetsArray())]


def _is_same(surface, result):
    import numpy as np

    return all(map(np.array_equal, _structure(surface), _structure(result)))


def _faces(faces, surface, result):
    """The faces of the result, as those that were given."""
    import numpy as np

    if _is_same(surface, result):
        return faces.copy() if isinstance(faces, np.ndarray) else [list(face) for face in faces]
    numbers, offsets = _structure(result)
    sizes = np.diff(offsets)
    if isinstance(faces, np.ndarray) and len(sizes) > 0 and (sizes == sizes[0]).all():
        fits = numbers.max() <= np.iinfo(faces.dtype).max
        return numbers.reshape(-1, sizes[0]).astype(faces.dtype if fits else numbers.dtype)
    return [face.tolist() for face in np.split(numbers, offsets[1:-1])]


def _object(mesh, surface, result):
    """A copy of the mesh with other vertices or, where faces were split, a new one of its class."""
    points = _points(result)
    same = _is_same(surface, result)
    if same:
        rounded = mesh.copy() if hasattr(mesh, "copy") else copy.deepcopy(mesh)
        if _set_vertices(rounded, points):
            return rounded
    faces = _faces(mesh.faces, surface, result)
    if dataclasses.is_dataclass(mesh):
        return dataclasses.replace(mesh, vertices=points, faces=faces)
    if hasattr(mesh, "_replace"):  # of a named tuple
        return mesh._replace(vertices=points, faces=faces)
    for kind in type(mesh).__mro__[:-1]:  # a box of trimesh is made of its extents, and a trimesh of vertices and faces
        for options in ({"process": False}, {}):  # a trimesh would merge vertices
            try:
                return kind(vertices=points, faces=faces, **options)
            except TypeError:
                continue
    name = type(mesh).__name__
    if same:
        raise TypeError(f"the vertices of a {name} cannot be set, and none can be made of vertices and faces; give them"
                        " as a tuple (vertices, faces)")
    raise TypeError(f"the faces were split, and a {name} cannot be made of vertices and faces;"
                    ' refine_long_edges="Off" keeps the faces')


def _set_vertices(mesh, points):
    """Whether the mesh takes these vertices. Some only log that they do not."""
    import numpy as np

    try:
        mesh.vertices = points
    except AttributeError:
        return False
    return np.array_equal(mesh.vertices, points)
