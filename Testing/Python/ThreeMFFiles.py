# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads 3MF with Python's own modules, and refuses what the core specification 1.4 forbids."""
import re
import xml.etree.ElementTree as ElementTree
import zipfile
from typing import NamedTuple

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
PACKAGE = "http://schemas.openxmlformats.org/package/2006/"
NUMBER = re.compile(r"[-+]?([0-9]+(\.[0-9]+)?|\.[0-9]+)([eE][-+]?[0-9]+)?")  # ST_Number
INDEX = re.compile(r"[0-9]+")


class File(NamedTuple):
    unit: str
    points: list  #: of three texts each
    triangles: list  #: of three numbers each
    transform: list  #: four rows of three numbers that stand after the point with a 1, or the identity

    def placed(self):
        """The points as the file places them."""
        return [[sum(x * row[k] for x, row in zip([*map(float, point), 1], self.transform)) for k in range(3)]
                for point in self.points]


def children(element, *names):
    """The children, which have these names."""
    assert [child.tag for child in element] == [CORE + name for name in names], ElementTree.tostring(element)[:500]
    return list(element)


def attributes(element, pattern, names):
    assert list(element.keys()) == names and all(pattern.fullmatch(text) for text in element.attrib.values()), \
        element.attrib
    return [element.get(name) for name in names]


def load(path):
    """A file with one object."""
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None  # sums of all parts
        assert archive.namelist() == ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"]
        assert all(info.compress_type == zipfile.ZIP_DEFLATED and info.flag_bits == 0 for info in archive.infolist())
        parts = [ElementTree.fromstring(archive.read(name).decode("utf-8")) for name in archive.namelist()]
    types = {child.get("Extension"): child.get("ContentType") for child in parts[0]}
    assert parts[0].tag == f"{{{PACKAGE}content-types}}Types"
    assert {child.tag for child in parts[0]} == {f"{{{PACKAGE}content-types}}Default"}
    assert types == {"rels": "application/vnd.openxmlformats-package.relationships+xml",
                     "model": "application/vnd.ms-package.3dmanufacturing-3dmodel+xml"}, types
    relationship, = parts[1]
    assert (parts[1].tag, relationship.tag) == (f"{{{PACKAGE}relationships}}Relationships",
                                                f"{{{PACKAGE}relationships}}Relationship")
    assert relationship.get("Target") == "/3D/3dmodel.model" and relationship.get("Id")
    assert relationship.get("Type") == "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
    model = parts[2]
    assert model.tag == CORE + "model" and "requiredextensions" not in model.keys()
    metadata, resources, build = children(model, "metadata", "resources", "build")
    assert metadata.attrib == {"name": "Application"} and metadata.text == "SphericalStyle"
    item, = children(build, "item")
    object_, = children(resources, "object")
    transform = item.attrib.pop("transform", "1 0 0 0 1 0 0 0 1 0 0 0").split(" ")
    assert len(transform) == 12 and all(NUMBER.fullmatch(text) for text in transform), transform
    transform = [list(map(float, transform[k:k + 3])) for k in (0, 3, 6, 9)]
    assert item.attrib == {"objectid": "1"} and object_.attrib == {"id": "1", "type": "model"}
    mesh, = children(object_, "mesh")
    vertices, triangles = children(mesh, "vertices", "triangles")
    assert {child.tag for child in vertices} == {CORE + "vertex"}
    assert {child.tag for child in triangles} == {CORE + "triangle"}
    points = [attributes(vertex, NUMBER, ["x", "y", "z"]) for vertex in vertices]
    corners = [list(map(int, attributes(triangle, INDEX, ["v1", "v2", "v3"]))) for triangle in triangles]
    assert all(len(set(triangle)) == 3 and max(triangle) < len(points) for triangle in corners)
    assert {k for triangle in corners for k in triangle} == set(range(len(points))), "points of no triangle"
    return File(model.get("unit"), points, corners, transform)
