# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Files that end too early or are damaged. VTK's readers of PLY and glTF end the process with some of them, and those of
PLY, STL and VTK's old format take others for models."""
import contextlib
import json
import mmap
import os
import struct
from typing import NamedTuple, Optional

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, vtkOutputWindow

from .messages import printable

CUT_OFF = "the file is cut off"

#: Of numpy and struct.
_LETTERS = {b"char": "b", b"uchar": "B", b"short": "h", b"ushort": "H", b"int": "i", b"uint": "I", b"float": "f",
            b"double": "d", b"int8": "b", b"uint8": "B", b"int16": "h", b"uint16": "H", b"int32": "i", b"uint32": "I",
            b"float32": "f", b"float64": "d"}
_REAL = b"float", b"double", b"float32", b"float64"
_LONGEST_HEADER = 1 << 20


def find(path):
    """What is wrong with the file, as far as it can be seen before VTK's reader has it, or None."""
    looks = {".ply": _in_ply, ".stl": _in_stl, ".gltf": _in_gltf}
    look = looks.get(path.suffix.lower())
    return look(path) if look else None


@contextlib.contextmanager
def in_what_is_said(path):
    """A list of what VTK's reader of its old format says to nobody where the file ends too early."""
    said = []

    def listen(_source, _event, text):
        if "Error reading" in text:
            said.append(f"{CUT_OFF} or damaged")

    listen.CallDataType = VTK_STRING
    window = vtkOutputWindow.GetInstance() if path.suffix.lower() == ".vtk" else None
    tag = window.AddObserver("WarningEvent", listen) if window else None
    try:
        yield said
    finally:
        if window:
            window.RemoveObserver(tag)


def find_in_cells(surface):
    """What is wrong with the cells that a reader made, or None. A cell of a file that was cut off may have any ids."""
    count = surface.GetNumberOfPoints()
    for cells in (surface.GetVerts(), surface.GetLines(), surface.GetPolys(), surface.GetStrips()):
        if cells.GetNumberOfCells() == 0:
            continue
        ends, ids = vtk_to_numpy(cells.GetOffsetsArray()), vtk_to_numpy(cells.GetConnectivityArray())
        if ends[0] != 0 or ends[-1] != len(ids) or (np.diff(ends) < 0).any():
            return "its faces do not have their points; the file is damaged or cut off"
        for id_ in (ids.min(initial=0), ids.max(initial=-1)):
            if not -1 < id_ < count and len(ids):
                return _bad_id(id_, count)
    return None


def _in_stl(path):
    with open(path, "rb") as file:
        head = file.read(1024)
    if len(head) < 84 or head.lstrip()[:5].lower() == b"solid" and not any(byte == 0 or byte > 127 for byte in head):
        return None  # text, which ends where it ends
    promised = int.from_bytes(head[80:84], "little")
    there = (os.path.getsize(path) - 84) // 50
    return f"{CUT_OFF}: its head promises {promised} triangles, and it has {there}" if there < promised else None


def _in_gltf(path):
    with open(path, "rb") as file:
        text = file.read()
    try:
        is_object = isinstance(json.loads(text.decode("utf-8-sig")), dict)
    except json.JSONDecodeError as error:
        return f"no JSON at line {error.lineno}, column {error.colno}; the file is damaged or cut off"
    except (UnicodeDecodeError, RecursionError):
        return "no JSON; the file is damaged"
    return None if is_object else "no glTF: its JSON is not an object"


class _Property(NamedTuple):
    name: bytes
    kind: np.dtype
    length: Optional[struct.Struct]  #: of a list, or None where it is one number
    is_ids: bool  #: of points


def _in_ply(path):
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as text:
        return _in_ply_text(text)


def _in_ply_text(text):
    end = text.find(b"\nend_header", 0, _LONGEST_HEADER) + 1
    begin = text.find(b"\n", end) + 1
    if text[:3] != b"ply":
        return None  # VTK's reader says so itself
    if end == 0 or text[end:begin].split() != [b"end_header"]:
        return f"{CUT_OFF} or damaged: its head has no end"
    order, elements = None, []
    for line in text[:end].splitlines():
        words = line.split()
        kind = words[0] if words else b""
        if kind == b"format" and len(words) == 3:
            order = {b"ascii": "", b"binary_little_endian": "<", b"binary_big_endian": ">"}.get(words[1])
        elif kind == b"element" and len(words) == 3 and words[2].isdigit():
            elements.append((words[1].decode(errors="replace"), int(words[2]), []))
        elif kind == b"property" and elements and len(words) == (5 if words[1:2] == [b"list"] else 3):
            types = words[2:4] if len(words) == 5 else words[1:2]
            if any(type_ not in _LETTERS for type_ in types) or len(types) == 2 and types[0] in _REAL:
                return f"its head has an unknown type: {b' '.join(types).decode(errors='replace')}"
            kinds = [(order or "<") + _LETTERS[type_] for type_ in types]
            is_ids = len(types) == 2 and elements[-1][0] == "face" and words[4] in (b"vertex_indices", b"vertex_index")
            elements[-1][2].append(_Property(words[-1], np.dtype(kinds[-1]),
                                             struct.Struct(kinds[0]) if len(types) == 2 else None, is_ids))
        elif kind not in (b"ply", b"comment", b"obj_info"):
            return f"its head has a line that is none of PLY: {printable(line[:60].decode(errors='replace'))}"
    order_of = [name for name, _, _ in elements]
    needed = [name for name in order_of if name in ("vertex", "face", "tristrips")]
    if needed[:1] != ["vertex"] or len(set(needed)) != len(needed):
        return "its head has no points, or not in front, or names something twice"
    if order_of[:len(needed)] != needed:
        other = next(name for name in order_of if name not in needed)
        return f"\"{printable(other)}\" stands before its faces, which VTK's reader cannot pass over; write it without"
    for name, count, properties in elements:
        names = {property_.name for property_ in properties}
        if name == "vertex" and not names >= {b"x", b"y", b"z"}:
            return "its points have no x, y and z"
        if name == "face" and not any(property_.is_ids for property_ in properties):
            return "its faces have no list vertex_indices"
    if order is None:
        return "its head names no format: ascii, binary_little_endian or binary_big_endian"
    return (_in_bytes if order else _in_lines)(text, begin, elements, elements[0][1])


def _too_few(name, count, there):
    return f"{CUT_OFF}: its head promises {count} of \"{name}\", and it has {there}"


def _bad_list(name, k, length):
    return f"number {k} of \"{name}\" has a list of {length} numbers; the file is damaged"


def _bad_id(id_, points):
    return f"a face names point {id_}, and the file has {points} points; the file is damaged or cut off"


def _in_lines(text, begin, elements, points):
    """Where it is text. VTK's reader, too, wants each in a line of its own."""
    text.seek(begin)
    for name, count, properties in elements:
        for k in range(count):
            line = text.readline()
            if not line:
                return _too_few(name, count, k)
            words = line.split()
            at = 0
            for property_ in properties:
                if property_.length and at < len(words):
                    if not words[at].isdigit():
                        return _bad_list(name, k, printable(words[at].decode(errors="replace")))
                    ids = words[at + 1:at + 1 + int(words[at])] if property_.is_ids else ()
                    bad = next((word for word in ids if not word.isdigit() or int(word) >= points), None)
                    if bad is not None:
                        return _bad_id(printable(bad.decode(errors="replace")), points)
                    at += int(words[at])
                at += 1
            if at > len(words):
                return f"number {k} of \"{name}\" has {len(words)} of {at} numbers; the file is damaged or cut off"
    return None


def _in_bytes(text, begin, elements, points):
    at = begin
    for name, count, properties in elements:
        if count == 0:
            continue
        size, spans = _spans(text, at, properties)
        if size is not None and _are_alike(text, at, count, size, spans):
            bad = _id_out_of(text, at, count, size, spans, points)
            at += count * size
            if bad is not None:
                return _bad_id(bad, points)
            continue
        places = {}  # of rows with lists of the same lengths
        for k in range(count):
            size, spans = _spans(text, at, properties)
            if size is None and spans:
                return _bad_list(name, k, spans[-1][1])
            if size is None or at + size > len(text):
                return _too_few(name, count, k)
            places.setdefault((size, spans), []).append(at)
            at += size
        for (size, spans), begins in places.items():
            rows = np.frombuffer(text, np.uint8)[np.add.outer(begins, np.arange(size))]
            bad = _id_out_of(rows, 0, len(rows), size, spans, points)
            if bad is not None:
                return _bad_id(bad, points)
    return None


def _spans(text, at, properties):
    """The size of the row that begins here and its lists: (property, length, place in the row). None where the file ends
    before, or the last of these lists has a length below 0."""
    size, spans = 0, ()
    for property_ in properties:
        length = 1
        if property_.length:
            if at + size + property_.length.size > len(text):
                return None, ()
            length = property_.length.unpack_from(text, at + size)[0]
            spans += ((property_, length, size),)
            if length < 0:
                return None, spans
            size += property_.length.size
        size += length * property_.kind.itemsize
    return size, spans


def _are_alike(text, begin, count, size, spans):
    """Whether all rows are there and have lists as long as the first one's."""
    if begin + count * size > len(text):
        return False
    rows = np.ndarray((count, size), np.uint8, text, begin)
    heads = (rows[:, at:at + property_.length.size] for property_, _, at in spans)
    return all((head == head[0]).all() for head in heads)


def _id_out_of(text, begin, count, size, spans, points):
    """The first id in these rows that no point has, or None."""
    for property_, length, at in spans:
        if property_.is_ids and length:
            first = begin + at + property_.length.size
            ids = np.ndarray((count, length), property_.kind, text, first, (size, property_.kind.itemsize))
            if ids.min() < 0 or ids.max() >= points:
                return ids[(ids < 0) | (ids >= points)][0]
    return None
