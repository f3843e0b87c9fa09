# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Write models as glTF with a slider that rounds them."""
import os
import pathlib
from typing import NamedTuple

from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import SphericalStyleFilters, meshes
from .messages import Messages, printable
from .model_files import ModelError, is_gltf, read, whole
from .properties import raise_errors, set_all
from .rounding import MESHES, PARTS, add_arrays, is_array, make


class Slider(NamedTuple):
    """What write_slider() has written."""
    targets: int  #: number of morph targets
    error: float  #: largest distance from the filter's result that was found, as a share of the model's diagonal
    jump: float  #: the same where the result changes faster than targets can follow; 0 if nowhere
    linear: bool  #: one target is all results


def write_slider(path, mesh, *, preset=None, maximum_roundness=5.0, tolerance=0.001, maximum_targets=32,
                 **properties):
    """Writes a model as .glb or .gltf with morph targets that round it: a slider in Blender, in a game
    engine or in a browser. Nothing is left of a file that existed.

    mesh: of any kind that sphericalstyle.round takes, or the path of a model. That of a .glb or .gltf is copied with
    the targets added, and keeps textures, materials, skins, other targets and animations.

    preset and other keywords are those of sphericalstyle.round. The slider is at roundness when the file is opened,
    and at 0, with a StyleWarning, if the mesh is a result of sphericalstyle.round: the file shows it as it looks. With
    detail_size=0 and keep_size="Off" there is one target, named Roundness, whose weight w is any roundness w / (1 - w)
    / sqrt(3). Otherwise there are some from 0 to maximum_roundness, so many that between them no point is farther from
    the filter's result than tolerance, a share of the model's diagonal, but no more than maximum_targets.

    Returns a Slider(targets, error, jump, linear). Raises what sphericalstyle.round raises, and a sphericalstyle.Error that
    says why if the file cannot be written.
    """
    path = pathlib.Path(path)
    name = printable(path)
    if not is_gltf(path):
        raise ModelError(f"{name}: only files .glb and .gltf have a slider")
    if not hasattr(SphericalStyleFilters, "vtkStyleGLTFWriter"):
        raise ModelError(f"{name}: this sphericalstyle was built without glTF (SPHERICALSTYLE_WITH_GLTF)")
    writer = SphericalStyleFilters.vtkStyleGLTFWriter()
    set_all(writer, {"maximum_roundness": maximum_roundness, "tolerance": tolerance, "maximum_targets": maximum_targets},
            {"maximum_targets": "MaximumNumberOfTargets"})
    properties = {keyword: value for keyword, value in properties.items() if value is not None}
    style = make(preset, "write_slider", ("maximum_roundness", "tolerance", "maximum_targets"), **properties)
    writer.SetStyle(style)
    if isinstance(mesh, (str, os.PathLike)) and is_gltf(pathlib.Path(mesh)):
        if not pathlib.Path(mesh).is_file():
            raise ModelError(f"{printable(mesh)}: no such file")
        arrays = [keyword for keyword, value in properties.items() if is_array(keyword, value) or keyword in MESHES + PARTS]
        if arrays:
            raise TypeError(f"{arrays[0]} needs a mesh; {printable(mesh)} is only copied")
        writer.SetSourceFileName(os.fsencode(mesh))
    else:
        surface = read(mesh) if isinstance(mesh, (str, os.PathLike)) else meshes.take(mesh, "write_slider")[0]
        if not isinstance(surface, vtkPolyData):
            raise ModelError(f"{name}: a {surface.GetClassName()} is not a surface (vtkPolyData)")
        surface, _ = add_arrays(style, surface, properties)
        writer.SetInputDataObject(surface)
    messages = Messages(writer)
    with whole(path) as part:
        writer.SetFileName(os.fsencode(part))
        written = writer.Write()
        messages.errors = [text.replace(printable(part), name) for text in messages.errors]
        if messages.errors or not written:
            raise_errors(messages)
    messages.warn()
    return Slider(writer.GetNumberOfTargets(), writer.GetLargestError(), writer.GetLargestJump(),
                  writer.GetLinear())
