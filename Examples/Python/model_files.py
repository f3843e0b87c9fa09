# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Read, round and write models, in Python with or without ParaView. Every failure becomes a ModelError
with the message of the reader, filter or writer."""
import contextlib
import os
import re
import sys

from vtkmodules.vtkCommonCore import VTK_STRING
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from sphericalstyle import vtkSphericalStyleFilter

READERS = {
    ".ply": vtkPLYReader,
    ".stl": vtkSTLReader,
    ".obj": vtkOBJReader,
    ".vtk": vtkGenericDataObjectReader,
    ".vtp": vtkXMLPolyDataReader,
}


class ModelError(Exception):
    """A failure, with a message for the user."""


def printable(text):
    """The text with escapes for control characters, line breaks, and bytes that are not text."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in str(text))


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
    """A temporary path to write to. The file gets its final name when it is complete, and is removed after a failure.
    Links are replaced, not followed."""
    part = place.with_name(place.name + ".part")
    part.unlink(missing_ok=True)
    try:
        yield part
        part.replace(place)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


class Messages:
    """Collects errors and warnings of an algorithm; VTK would print them and continue."""

    warned = set()  # print each warning once, although a series runs the filter many times

    def __init__(self, algorithm):
        self.errors = []
        self.failed = False  # the executive reports errors without details
        algorithm.AddObserver("ErrorEvent", self._error)
        algorithm.AddObserver("WarningEvent", self._warning)
        algorithm.GetExecutive().AddObserver("ErrorEvent", self._failure)

    def _error(self, _source, _event, text):
        self.errors.append(self._plain(text))

    def _failure(self, _source, _event):
        self.failed = True

    def _warning(self, _source, _event, text):
        warning = self._plain(text)
        if warning not in self.warned:
            self.warned.add(warning)
            print(f"Warning: {warning}", file=sys.stderr)

    _error.CallDataType = VTK_STRING
    _warning.CallDataType = VTK_STRING

    @staticmethod
    def _plain(text):
        """The message without source file, line and address."""
        plain = re.sub(r"^\w+: In .*\n\w+ \(0x[0-9a-f]+\): ", "", text.strip())
        return "\n".join(map(printable, plain.splitlines()))

    def raise_errors(self, what):
        if self.errors or self.failed:
            raise ModelError("\n  ".join([what, *dict.fromkeys(self.errors)]))


def read(path):
    """The surface in the file. Raises a ModelError that says why if there is none."""
    name, suffix = printable(path), path.suffix.lower()
    if suffix not in READERS:
        suffix = printable(suffix)
        raise ModelError(f"{name}: cannot read files {suffix or 'without an ending'};"
                        f" known: {' '.join(sorted(READERS))}")
    if not path.is_file():
        raise ModelError(f"{name}: no such file")
    if path.stat().st_size == 0:
        raise ModelError(f"{name}: the file is empty")
    reader = READERS[suffix]()
    messages = Messages(reader)
    reader.SetFileName(os.fsencode(path))
    reader.Update()
    messages.raise_errors(f"{name}: cannot be read as {suffix}")
    surface = reader.GetOutputDataObject(0)
    if surface is None:
        raise ModelError(f"{name}: cannot be read as {suffix}")
    if not isinstance(surface, vtkPolyData):
        raise ModelError(f"{name}: holds a {surface.GetClassName()}, not a surface (vtkPolyData);"
                        " take its surface first, in ParaView with Extract Surface")
    if surface.GetNumberOfPolys() + surface.GetNumberOfStrips() == 0:
        raise ModelError(f"{name}: holds {surface.GetNumberOfPoints()} points and no faces")
    return surface


def rounded(surface, **properties):
    """The executed vtkSphericalStyleFilter; port 0 has the surface.
    properties: values by name, such as Roundness=0.5; None keeps the filter's default."""
    style = vtkSphericalStyleFilter()
    style.SetController(None)  # with MPI, too, each process has its own surface
    messages = Messages(style)
    style.SetInputData(surface)
    for name, value in properties.items():
        if value is None:
            continue
        getattr(style, "Set" + name)(value)
        taken = getattr(style, "Get" + name)()
        if value > taken or value < taken:  # the filter itself rejects NaN
            raise ModelError(f"{name} cannot be {value:g}; the nearest that can be is {taken:g}")
    style.Update()
    messages.raise_errors("The filter failed:")
    if style.GetOutput().GetNumberOfPoints() < surface.GetNumberOfPoints():  # splitting long edges adds points
        raise ModelError("The filter gave no result and no reason.")
    return style


def largest_move(surface):
    """The largest distance by which a point of the filter's output moved."""
    return surface.GetPointData().GetArray("Displacement").GetRange(-1)[1]


def write(writer, path, data):
    """Writes the data with a VTK writer."""
    messages = Messages(writer)
    writer.SetFileName(os.fsencode(path))
    writer.SetInputData(data)
    written = writer.Write()
    messages.raise_errors(f"{printable(path)}: cannot be written")
    if written == 0:  # writers of images return nothing
        raise ModelError(f"{printable(path)}: cannot be written")


def triangle_count(surface):
    triangles = vtkTriangleFilter()
    triangles.PassLinesOff()
    triangles.PassVertsOff()
    triangles.SetInputData(surface)
    triangles.Update()
    return triangles.GetOutput().GetNumberOfPolys()
