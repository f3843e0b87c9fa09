# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
# The classes of the filters are in SphericalStyleFilters.pyi, which the build writes.
import os
from typing import Any, Literal, Mapping, NamedTuple, Optional, Sequence, TypeVar, Union

from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import presets as presets
from .SphericalStyleFilters import *

__version__: str

class Error(RuntimeError): ...
class StyleWarning(UserWarning): ...

_Mesh = TypeVar("_Mesh")
_Array = Any  # of numpy, a list, or the name of a point array of the mesh

def round(
    mesh: _Mesh,
    /,
    *,
    preset: Optional[Literal["Soft", "Toy", "Chibi", "Puffy", "Chubby", "Ball", "Pebble"]] = ...,
    roundness: float = ...,
    normal_blend: Union[float, _Array] = ...,
    detail_size: float = ...,
    avoid_self_intersections: bool = ...,
    border_width: float = ...,
    center: Sequence[float] = ...,
    center_blend_width: float = ...,
    center_mode: Literal["PointMean", "AreaCentroid", "Custom"] = ...,
    edge_weighting: Literal["HalfEdge", "FullEdge", "IntrinsicDelaunay"] = ...,
    generate_displacement: bool = ...,
    generate_normals: bool = ...,
    generate_rotation: bool = ...,
    keep_on_ground: bool = ...,
    keep_size: Literal["Off", "Area", "Volume", "Extent"] = ...,
    maximum_edge_length: float = ...,
    maximum_number_of_iterations: int = ...,
    normal_radius: Literal["OwnThickness", "WholeModel"] = ...,
    number_of_threads: int = ...,
    output_points_precision: Literal["Single", "Double", "Default"] = ...,
    radius: float = ...,
    radius_mode: Literal["EqualArea", "EqualVolume", "Custom"] = ...,
    refine_long_edges: Literal["Off", "Automatic", "On"] = ...,
    reproduce_thesis: bool = ...,
    sphere_of: Literal["WholeModel", "Region"] = ...,
    spherical_weighting: Literal["Uniform", "Cotangent"] = ...,
    stop_rule: Literal["Converged", "Thesis", "FixedIterations"] = ...,
    symmetry: Literal["Off", "Automatic", "X", "Y", "Z"] = ...,
    target: Literal["Sphere", "Ellipsoid", "Capsule", "Cylinder", "RoundedBox", "Superquadric", "Mesh"] = ...,
    target_edges: float = ...,
    target_lengths: Sequence[float] = ...,
    tolerance: float = ...,
    transform_all_input_vectors: bool = ...,
    up_axis: Literal["X", "Y", "Z"] = ...,
    normals: Optional[_Array] = ...,
    roundness_factor: Optional[_Array] = ...,
    target_directions: Optional[_Array] = ...,
    region: Optional[_Array] = ...,
    center_id: Optional[_Array] = ...,
    centers: Optional[_Array] = ...,
    rest_pose: Any = ...,
    target_mesh: Any = ...,
    parts: Optional[_Array] = ...,
    part_roundness: Optional[Mapping[int, float]] = ...,
    part_normal_blend: Optional[Mapping[int, float]] = ...,
) -> _Mesh: ...
def read(path: Union[str, os.PathLike[str]]) -> vtkPolyData: ...
def write(path: Union[str, os.PathLike[str]], mesh: Any) -> None: ...
def parts(mesh: Any, number: int = ...) -> Any: ...
def resize(
    mesh: _Mesh,
    sizes: Optional[Mapping[int, float]] = ...,
    *,
    parts: Optional[_Array] = ...,
    head_height: float = ...,
    head: int = ...,
    up_axis: Literal["X", "Y", "Z"] = ...,
    blend_width: float = ...,
    keep_on_ground: bool = ...,
) -> _Mesh: ...
def deform(
    mesh: _Mesh,
    handles: Sequence[Union[Mapping[str, Any], Sequence[Any]]],
    *,
    independent: bool = ...,
    tolerance: Optional[float] = ...,
    maximum_iterations: Optional[int] = ...,
) -> _Mesh: ...
def printable(
    mesh: _Mesh,
    *,
    foot_area: float = ...,
    stability_angle: float = ...,
    minimum_thickness: float = ...,
    volume: float = ...,
    height: float = ...,
    close_holes: bool = ...,
    place_on_plate: bool = ...,
    up_axis: Literal["X", "Y", "Z"] = ...,
) -> _Mesh: ...

class _Slider(NamedTuple):
    targets: int
    error: float
    jump: float
    linear: bool

# Further keywords are those of round.
def write_slider(
    path: Union[str, os.PathLike[str]],
    mesh: Any,
    *,
    preset: Optional[str] = ...,
    maximum_roundness: float = ...,
    tolerance: float = ...,
    maximum_targets: int = ...,
    **properties: Any,
) -> _Slider: ...
def write_page(
    path: Union[str, os.PathLike[str]],
    mesh: Any,
    *,
    preset: Optional[str] = ...,
    maximum_roundness: float = ...,
    tolerance: float = ...,
    maximum_targets: int = ...,
    title: Optional[str] = ...,
    **properties: Any,
) -> None: ...
