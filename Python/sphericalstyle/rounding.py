# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Round a mesh with one call: sphericalstyle.round."""
import inspect
import sys

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkPolyData

from . import meshes, part_sizes, presets
from .messages import Error, Messages
from .properties import closest, properties, raise_errors
from .SphericalStyleFilters import vtkSphericalStyleFilter

#: Keywords for values of each point, and the index of vtkSphericalStyleFilter's input array.
ARRAYS = {"normals": 0, "roundness_factor": 1, "normal_blend": 2, "target_directions": 3, "region": 4, "center_id": 5}
#: Keywords for what comes in at a further port.
MESHES = ("centers", "rest_pose", "target_mesh")
#: Keywords for values of each part.
PARTS = ("parts", "part_roundness", "part_normal_blend")


def round(mesh, *, preset=None, **properties):  # noqa: A001, it is used as sphericalstyle.round
    """Returns a rounded copy of a mesh.

    mesh: a vtkPolyData, a PyVista mesh, an object with vertices and faces such as a trimesh, or a tuple of arrays
    (points, faces). The result is of the same kind. faces is an array of m x 3 or m x 4 point numbers, or a list of
    lists.

    preset: a name of sphericalstyle.presets.PRESETS. Properties given by keyword replace what it says.

    Other keywords are the properties of vtkSphericalStyleFilter, in lower case with underscores. Names of values are
    strings, such as keep_size="Volume". Keywords for values of each point take an array with one value, or one row,
    for each point, or the name of a point array of the mesh: region (0 or False: the point stays), roundness_factor,
    normal_blend, target_directions, normals and center_id. centers has a point for each number of center_id.
    center and radius set center_mode and radius_mode to "Custom", unless these are given too. rest_pose is a mesh with
    the same points and faces in another pose, from which details, thickness and radius are taken. target_mesh is a
    closed mesh that the model is drawn toward; it sets target to "Mesh", unless that is given too.

    part_roundness and part_normal_blend are dicts of parts and values that these have in place of the rest: part_roundness
    is a factor of roundness. parts is the part of each point, as sphericalstyle.parts gives it, which is called by default.

    Coarse flat panels are split first, so the result can have more points and faces than the mesh; its first points
    are those of the mesh. With refine_long_edges="Off" it always has the same.

    Raises TypeError for keywords and meshes that it does not know, ValueError for values that are out of range, and
    sphericalstyle.Error with the filter's message if the mesh cannot be rounded. The filter's warnings are Python
    warnings of the class sphericalstyle.StyleWarning.

    A box, as arrays:

    >>> import numpy as np
    >>> import sphericalstyle as ss
    >>> points = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 3)], dtype=float)
    >>> faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    >>> ball, triangles = ss.round((points, faces), preset="Pebble", roundness=5)
    >>> length, width = np.ptp(points, axis=0)[[2, 0]], np.ptp(ball, axis=0)[[2, 0]]
    >>> bool(length[0] / length[1] == 3 and width[0] / width[1] < 1.2)
    True

    A mesh of VTK, in which only the upper half may move:

    >>> from vtkmodules.util.numpy_support import vtk_to_numpy
    >>> from vtkmodules.vtkFiltersSources import vtkSphereSource
    >>> source = vtkSphereSource()
    >>> source.SetThetaResolution(40)
    >>> source.SetPhiResolution(40)
    >>> source.Update()
    >>> mesh = source.GetOutput()
    >>> z = vtk_to_numpy(mesh.GetPoints().GetData())[:, 2]
    >>> rounded = ss.round(mesh, roundness=0.5, region=z > 0)
    >>> new_z = vtk_to_numpy(rounded.GetPoints().GetData())[:, 2]
    >>> bool((new_z == z)[z <= 0].all() and (new_z != z).any())
    True

    What is misspelled is not ignored:

    >>> ss.round(mesh, roundnes=2)
    Traceback (most recent call last):
    TypeError: round() has no keyword 'roundnes'; did you mean 'roundness'?
    >>> ss.round(mesh, normal_blend=3)
    Traceback (most recent call last):
    ValueError: normal_blend must be 0 to 1; it is 3
    """
    surface, back = meshes.take(mesh)
    style, messages = execute(surface, preset, **properties)
    messages.warn()
    output = style.GetOutputDataObject(0)
    result = output.NewInstance()
    result.ShallowCopy(output)
    return back(result)


def execute(surface, preset=None, progress=None, **keywords):
    """The executed filter and its messages. What round() does, for a mesh of VTK.
    progress: is called with a share from 0 to 1. A keyword that is None has its default."""
    keywords = {keyword: value for keyword, value in keywords.items() if value is not None}
    style = make(preset, **keywords)
    style.SetController(None)  # with MPI, too, each process has a mesh of its own
    messages = Messages(style)
    if progress:
        style.AddObserver("ProgressEvent", lambda *_: progress(style.GetProgress()))
    surface, added = add_arrays(style, surface, keywords)
    style.SetInputData(surface)
    style.Update()
    raise_errors(messages)
    output = style.GetOutputDataObject(0)
    if isinstance(output, vtkPolyData) and output.GetNumberOfPoints() < surface.GetNumberOfPoints():
        raise Error("The filter gave no result and no reason.")
    for name in added:
        output.GetPointData().RemoveArray(name)
    return style, messages


def make(preset=None, caller="round", others=(), **keywords):
    """A vtkSphericalStyleFilter with the preset and these properties, without a mesh. caller and others: the function
    that has these keywords, and those that are its own."""
    known = properties()
    for keyword in keywords:
        if keyword not in known and keyword not in ARRAYS and keyword not in MESHES + PARTS:
            names = [*known, *ARRAYS, *MESHES, *PARTS, "preset", *others]
            raise TypeError(f"{caller}() has no keyword '{keyword}'{closest(keyword, names)}")
    if hasattr(keywords.get("roundness"), "__len__") and not isinstance(keywords["roundness"], str):
        raise TypeError("roundness must be a number; roundness_factor takes an array with a factor for each point")
    style = vtkSphericalStyleFilter()
    if preset is not None:
        presets.apply(style, preset)
    for keyword in ("center", "radius"):
        if keyword in keywords:
            known[keyword + "_mode"].set(style, "Custom")
    if keywords.get("target_mesh") is not None:
        known["target"].set(style, "Mesh")
    for keyword, value in keywords.items():
        if keyword in known and not is_array(keyword, value):
            known[keyword].set(style, value)
    return style


def is_array(keyword, value):
    """Whether it is for values of each point."""
    return keyword in ARRAYS and (keyword not in properties() or isinstance(value, str) or hasattr(value, "__len__"))


def add_arrays(style, surface, keywords):
    """Tells the filter its arrays. @return the surface with those that it did not have yet, and their names"""
    arrays = {keyword: value for keyword, value in keywords.items() if is_array(keyword, value)}
    if "centers" in keywords:
        if "center_id" not in arrays:
            raise TypeError("centers needs center_id: the number of the center that each point belongs to")
        centers = vtkPolyData()
        points = vtkPoints()
        points.SetData(meshes.point_array(keywords["centers"], "centers"))
        centers.SetPoints(points)
        style.SetCentersData(centers)
    if keywords.get("rest_pose") is not None:
        style.SetRestPoseData(meshes.take(keywords["rest_pose"], "rest_pose")[0])
    if keywords.get("target_mesh") is not None:
        style.SetTargetMeshData(meshes.take(keywords["target_mesh"], "target_mesh")[0])
    for of_points, of_parts in (("roundness_factor", "part_roundness"), ("normal_blend", "part_normal_blend")):
        if of_points in arrays and keywords.get(of_parts):
            raise TypeError(f"{of_points} for each point and {of_parts} cannot be used together")
    added = []
    if "part_roundness" in keywords or "part_normal_blend" in keywords:
        if not isinstance(surface, vtkPolyData):
            raise TypeError(f"part_roundness and part_normal_blend are for surfaces, not for a {type(surface).__name__}")
        copy = vtkPolyData()
        copy.ShallowCopy(surface)
        for array in part_sizes.style_arrays(surface, *(keywords.get(keyword) for keyword in PARTS)):
            added += [] if copy.GetPointData().HasArray(array.GetName()) else [array.GetName()]
            copy.GetPointData().AddArray(array)
        surface = copy
    elif "parts" in keywords:
        raise TypeError("parts needs part_roundness or part_normal_blend: what is to be different for a part")
    for keyword, value in arrays.items():
        name = value
        if not isinstance(value, str):
            if not isinstance(surface, vtkPolyData):
                raise TypeError(f"{keyword} of a {type(surface).__name__} must be the name of an array")
            array = meshes.array_of(value, keyword)
            count = surface.GetNumberOfPoints()
            if array.GetNumberOfTuples() != count:
                raise ValueError(f"{keyword} must have a value for each of the {count} points;"
                                 f" it has {array.GetNumberOfTuples()}")
            name = keyword
            while surface.GetPointData().HasArray(name):
                name += "_"
            array.SetName(name)
            copy = vtkPolyData()
            copy.ShallowCopy(surface)
            copy.GetPointData().AddArray(array)
            surface = copy
            added.append(name)
        style.SetInputArrayToProcess(ARRAYS[keyword], 0, 0, vtkDataSet.FIELD_ASSOCIATION_POINTS, name)
    return surface, added


def _describe():
    """Gives round() the keywords and defaults of the filter, for help() and for editors that ask."""
    known = properties()
    keywords = [inspect.Parameter(keyword, inspect.Parameter.KEYWORD_ONLY, default=default) for keyword, default in
                [("preset", None), *((keyword, known[keyword].default) for keyword in known),
                 *((keyword, None) for keyword in [*ARRAYS, *MESHES, *PARTS] if keyword not in known)]]
    mesh = inspect.Parameter("mesh", inspect.Parameter.POSITIONAL_ONLY)
    round.__signature__ = inspect.Signature([mesh, *keywords])


def _register_accessor():
    """mesh.spherical_style.round(), where PyVista has accessors (from 0.48) and is there already."""
    register = getattr(sys.modules.get("pyvista"), "register_dataset_accessor", None)
    if register is None:
        return

    class SphericalStyleAccessor:
        """Rounds this mesh: see sphericalstyle.round."""

        def __init__(self, mesh):
            self._mesh = mesh

        def round(self, **keywords):
            """sphericalstyle.round of this mesh."""
            return round(self._mesh, **keywords)

    register("spherical_style", sys.modules["pyvista"].PolyData)(SphericalStyleAccessor)


_describe()
_register_accessor()
