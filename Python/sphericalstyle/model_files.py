# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Read and write models, in Python with or without ParaView. Every failure is a ModelError with the message of the
reader or writer."""
import contextlib
import os
import pathlib
import secrets
import tempfile

import vtkmodules.vtkIOGeometry as geometry
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_DOUBLE, VTK_FLOAT, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkTriangleFilter
from vtkmodules.vtkIOGeometry import (vtkBYUReader, vtkBYUWriter, vtkGLTFReader, vtkGLTFWriter, vtkIVWriter,
                                      vtkOBJReader, vtkOBJWriter, vtkSTLReader, vtkSTLWriter)
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader, vtkPolyDataWriter
from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

from . import file_damage, meshes, obj_files
from .SphericalStyleFilters import vtk3MFWriter
from .messages import Error, Messages, printable

READERS = {
    ".ply": vtkPLYReader,
    ".stl": vtkSTLReader,
    ".obj": vtkOBJReader,
    ".vtk": vtkGenericDataObjectReader,
    ".vtp": vtkXMLPolyDataReader,
    ".glb": vtkGLTFReader,
    ".gltf": vtkGLTFReader,
    ".byu": vtkBYUReader,
}
if hasattr(geometry, "vtkOFFReader"):  # newer than VTK 9.2
    READERS[".off"] = geometry.vtkOFFReader

WRITERS = {
    ".ply": vtkPLYWriter,
    ".stl": vtkSTLWriter,
    ".obj": vtkOBJWriter,
    ".vtk": vtkPolyDataWriter,
    ".vtp": vtkXMLPolyDataWriter,
    ".glb": vtkGLTFWriter,
    ".gltf": vtkGLTFWriter,
    ".byu": vtkBYUWriter,
    ".iv": vtkIVWriter,
    ".3mf": vtk3MFWriter,
}


VOLUMES = (".vti", ".vtr", ".vts", ".vtu", ".vtm", ".pvtu", ".pvti", ".exo", ".ex2", ".e")  # of VTK, without a surface


#: Types of colors that are whole numbers, and the number for one.
COLORS = {VTK_UNSIGNED_CHAR: 255, VTK_UNSIGNED_SHORT: 65535}

#: The axis that points up in models of a format: in programs for printing and construction it is Z.
UP_AXES = {".stl": "Z"}


class ModelError(Error):
    """A file that cannot be read or written."""


def up_axis_of(path):
    """The axis that usually points up in models of this format."""
    return UP_AXES.get(pathlib.Path(path).suffix.lower(), "Y")


def place_in(folder, name):
    """The path of a file with this name in the folder. Makes the subfolders in the name. A link in the path must not
    lead out of the folder."""
    place = folder / name
    if not place.resolve().is_relative_to(folder.resolve()):
        raise ModelError(f"{printable(place)} leads out of {printable(folder)}")
    place.parent.mkdir(parents=True, exist_ok=True)
    return place


@contextlib.contextmanager
def whole(place):
    """A temporary path to write to, which nobody else has. The file gets its final name when it is complete, and is
    removed after a failure. Links are replaced, not followed."""
    # Some writers look at the ending, in lower case, and that of PLY adds it.
    part = place.with_name(f".{os.getpid()}-{secrets.token_hex(4)}.part{place.suffix.lower()}")
    try:
        yield part
        part.replace(place)
    except BaseException as error:
        with contextlib.suppress(OSError):
            part.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise ModelError(f"{printable(place)}: cannot be written: {error.strerror or error}") from None
        raise


def read(path):
    """The surface in a file, as a vtkPolyData. The ending of the name is the format: .ply, .stl, .obj, .vtk, .vtp, .glb,
    .gltf, .byu, with newer versions of VTK also .off. Raises a sphericalstyle.Error that says why if there is none.
    A StyleWarning says what of the file could not be used."""
    path = pathlib.Path(path)
    name, suffix = printable(path), path.suffix.lower()
    if suffix not in READERS:
        way_out = "; save its surface in ParaView, with Extract Surface or Contour" if suffix in VOLUMES else ""
        raise ModelError(f"{name}: cannot read files {printable(suffix) or 'without an ending'};"
                         f" known: {' '.join(sorted(READERS))}{way_out}")
    if not path.is_file():
        raise ModelError(f"{name}: no such file")
    if path.stat().st_size == 0:
        raise ModelError(f"{name}: the file is empty")
    reader = READERS[suffix]()
    messages = Messages(reader)
    with _safe_for_vtk(path, name, messages) as safe, file_damage.in_what_is_said(path) as said:
        _set_file_name(reader, safe)
        reader.Update()
    messages.raise_errors(f"{name}: cannot be read as {suffix}", ModelError)
    messages.warn()
    surface = reader.GetOutputDataObject(0)
    if isinstance(surface, vtkCompositeDataSet) and is_gltf(path):
        surface = _joined(surface)
    if surface is None:
        raise ModelError(f"{name}: cannot be read as {suffix}")
    if not isinstance(surface, vtkPolyData):
        raise ModelError(f"{name}: holds a {surface.GetClassName()}, not a surface (vtkPolyData);"
                        " take its surface first, in ParaView with Extract Surface")
    _raise_damage(name, said[0] if said else file_damage.find_in_cells(surface))
    _remove_misfits(surface.GetPointData(), surface.GetNumberOfPoints())
    if surface.GetNumberOfPolys() + surface.GetNumberOfStrips() == 0:
        raise ModelError(f"{name}: holds {surface.GetNumberOfPoints()} points and no faces")
    return surface


@contextlib.contextmanager
def _safe_for_vtk(path, name, messages):
    """The path of a file that VTK's reader does not read beyond its arrays: this one or, for a while, a copy without the
    texture coordinates or normals of which faces name some that are not there."""
    try:
        _raise_damage(name, file_damage.find(path))
        if is_gltf(path) and path.suffix != path.suffix.lower():  # VTK's reader looks at the ending
            if path.suffix.lower() == ".gltf":  # which has files beside it
                raise ModelError(f"{name}: cannot be read; give its name the ending .gltf in lower case")
            with tempfile.TemporaryDirectory() as folder:
                link = pathlib.Path(folder) / "model.glb"
                link.symlink_to(path.resolve())
                yield link
            return
        is_obj = path.suffix.lower() == ".obj"
        misfits = obj_files.misfits(path) if is_obj else {}
        left_out = obj_files.to_rewrite(path) if is_obj else None
        if not misfits and left_out is None:
            yield path
            return
        texts = [f"the face in line {misfit.line} names {obj_files.KINDS[of]} {misfit.number}, and the file has"
                 f" {misfit.count}{' before it' if misfit.number.startswith('-') else ''}"
                 for of, misfit in sorted(misfits.items())]
        if b"v" in misfits:
            raise ModelError(f"{name}: {texts[0]}; write it again with the program that made it, or without this face")
        messages.warnings += [f"{name}: {text}; read without its {obj_files.KINDS[of]}s"
                              for text, of in zip(texts, sorted(misfits))]
        with tempfile.NamedTemporaryFile(suffix=path.suffix) as copy:
            obj_files.copy_without(path, copy, {*misfits, *(left_out or ())})
            copy.flush()
            yield pathlib.Path(copy.name)
    except OSError as error:
        raise ModelError(f"{name}: cannot be read: {error.strerror}") from None


def _raise_damage(name, text):
    if text is not None:
        raise ModelError(f"{name}: {text}")


def _remove_misfits(data, count):
    """VTK's reader makes normals of an OBJ that no face names, in any number. What does not fit belongs to no point."""
    for k in reversed(range(data.GetNumberOfArrays())):
        if data.GetAbstractArray(k).GetNumberOfTuples() != count:
            data.RemoveArray(k)


def largest_move(surface):
    """The largest distance by which a point of the filter's output moved."""
    return surface.GetPointData().GetArray("Displacement").GetRange(-1)[1]


def run_writer(writer, path, data):
    """Writes the data with a VTK writer. Returns its messages, which may have warnings."""
    messages = Messages(writer)
    _set_file_name(writer, path)
    writer.SetInputDataObject(data)
    written = writer.Write()
    failure = f"{printable(path)}: cannot be written"
    told = any(text.startswith(failure) for text in messages.errors)
    messages.raise_errors(None if told else failure, ModelError)
    if written == 0:  # writers of images return nothing
        raise ModelError(failure)
    return messages


def write(path, mesh):
    """Writes a mesh of any kind that sphericalstyle.round takes, whole or not at all. The ending of the name is the
    format: .ply, .stl, .obj, .vtk, .vtp, .glb, .gltf, .byu, .iv or .3mf. A file that exists is replaced. Raises a
    sphericalstyle.Error that says why if it cannot be written, or has no faces. A StyleWarning says where the mesh of a .3mf is not the
    closed surface that a slicer wants; its unit is the millimeter."""
    path = pathlib.Path(path)
    surface, _ = meshes.take(mesh, "write")
    name, suffix = printable(path), path.suffix.lower()
    if suffix not in WRITERS:
        raise ModelError(cannot_write(path))
    if not isinstance(surface, vtkPolyData):
        raise ModelError(f"{name}: a {surface.GetClassName()} is not a surface (vtkPolyData)")
    if surface.GetNumberOfPolys() + surface.GetNumberOfStrips() == 0:  # read() would not take it, and some writers crash
        raise ModelError(f"{name}: cannot be written: the mesh has {surface.GetNumberOfPoints()} points and no faces")
    writer = WRITERS[suffix]()
    # Text has fewer digits. In .vtp the numbers stand in their elements and not behind all others, since VTK 9.2 and
    # earlier cannot read some of such files with today's expat (https://gitlab.kitware.com/vtk/vtk/-/issues/19258).
    for switch in ("SetFileTypeToBinary", "SetDataModeToBinary"):
        getattr(writer, switch, lambda: None)()
    data = surface
    if suffix in (".ply", ".byu") and surface.GetNumberOfStrips():  # which these writers leave out
        data = _triangulated(surface)
    if suffix == ".ply":
        _choose_colors(writer, surface)
    elif is_gltf(path):
        colored, has_colors = _with_float_colors(_triangulated(surface))
        data = _gltf_blocks(colored)
        switches = ["InlineDataOn"]
        if has_colors:
            switches.append("SaveActivePointColorOn")
        for switch in switches:
            getattr(writer, switch, lambda: None)()
    messages = None
    with whole(path) as part:
        try:
            if suffix == ".vtp":
                _write_text(writer, part, data)
            else:
                messages = run_writer(writer, part, data)
        except ModelError as error:
            raise ModelError(str(error).replace(printable(part), name, 1)) from None
        if not part.is_file() or suffix == ".glb" and not _starts_with(part, b"glTF"):
            raise ModelError(f"{name}: this version of VTK cannot write {suffix}")
    if suffix == ".3mf":
        messages.warn()


def _write_text(writer, path, data):
    """By way of a string: the XML writer of VTK 9.6 aborts the process where a disk is full."""
    writer.WriteToOutputStringOn()
    run_writer(writer, path, data)
    path.write_bytes(writer.GetOutputString().encode())


def cannot_write(path):
    """Why a file with this ending cannot be written."""
    return (f"{printable(path)}: cannot write files {printable(path.suffix) or 'without an ending'};"
            f" known: {' '.join(sorted(WRITERS))}")


def is_gltf(path):
    return path.suffix.lower() in (".glb", ".gltf")


def _set_file_name(reader_or_writer, path):
    byu = hasattr(reader_or_writer, "SetGeometryFileName")
    (reader_or_writer.SetGeometryFileName if byu else reader_or_writer.SetFileName)(os.fsencode(path))


def _starts_with(path, magic):
    with open(path, "rb") as file:
        return file.read(len(magic)) == magic


def _joined(blocks):
    """All surfaces of composite data as one."""
    append = vtkAppendPolyData()
    iterator = blocks.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        if isinstance(iterator.GetCurrentDataObject(), vtkPolyData):
            append.AddInputData(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    append.Update()
    return append.GetOutput()


def _gltf_blocks(surface):
    """What the writer takes: a building with a surface."""
    building, buildings = vtkMultiBlockDataSet(), vtkMultiBlockDataSet()
    building.SetBlock(0, surface)
    buildings.SetBlock(0, building)
    return buildings


def _with_float_colors(surface):
    """The surface with its active scalars as shares of one, and whether they are colors: three or four to a point, whole
    numbers without a sign or shares. The writer takes any scalars for colors, and VTK 9.6 writes bytes that no program
    can read."""
    scalars = surface.GetPointData().GetScalars()
    if scalars is None or scalars.GetNumberOfComponents() not in (3, 4):
        return surface, False
    values = vtk_to_numpy(scalars)
    values = values / COLORS.get(scalars.GetDataType(), 1.0)
    if scalars.GetDataType() not in (*COLORS, VTK_FLOAT, VTK_DOUBLE) or not ((values >= 0) & (values <= 1)).all():
        return surface, False
    shares = numpy_to_vtk(values.astype("float32"), deep=True)
    shares.SetName(scalars.GetName())
    copy = vtkPolyData()
    copy.ShallowCopy(surface)
    copy.GetPointData().SetScalars(shares)
    return copy, True


def _choose_colors(writer, surface):
    """The writer of PLY wants to know which array has colors: bytes, three or four to a point or a cell."""
    for data in (surface.GetPointData(), surface.GetCellData()):
        arrays = [data.GetScalars(), *(data.GetArray(k) for k in range(data.GetNumberOfArrays()))]
        for array in arrays:
            if array and array.GetName() and array.GetDataType() == VTK_UNSIGNED_CHAR \
                    and array.GetNumberOfComponents() in (3, 4):
                writer.SetArrayName(array.GetName())
                writer.SetEnableAlpha(array.GetNumberOfComponents() == 4)
                return


def _triangulated(surface):
    triangles = vtkTriangleFilter()
    triangles.PassLinesOff()
    triangles.PassVertsOff()
    triangles.SetInputData(surface)
    triangles.Update()
    return triangles.GetOutput()


def triangle_count(surface):
    """Of all faces."""
    return _triangulated(surface).GetNumberOfPolys()
