#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the seeds of the fuzz targets, the same files at every call: for each filter a few inputs, from mostly zeros
(defaults and simple surfaces) to bytes of every value, and small glTF files that have all that is read.

    make_corpus.py FOLDER
"""
import base64
import json
import pathlib
import random
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Python"))
from GLTFFiles import Maker, ball, figure  # noqa: E402

FILTERS = 18  # SubjectFromBytes in FuzzFilters.cxx
SHARES = 0.05, 0.2, 0.5, 1.0  # of bytes that are not zero
OF_SURFACE, AS_IT_IS, SOURCE_IS_TEXT, RESULT_IS_TEXT, WITH_DETAILS, KEEPS_SIZE, AGAIN = (
    1 << k for k in range(7))  # FuzzFiles.cxx


def some_bytes(numbers, share):
    return bytes(numbers.randrange(256) if numbers.random() < share else 0 for _ in range(numbers.randrange(60, 400)))


def seed(numbers, which, share):
    body = some_bytes(numbers, share)
    return bytes([numbers.randrange(2), which]) + body


def one_node(maker, primitive, **node):
    maker.root |= {"meshes": [{"primitives": [primitive]}], "nodes": [{"mesh": 0, **node}], "scenes": [{"nodes": [0]}]}
    return maker


def tetrahedron():
    maker = Maker(scene=0)
    P = maker.add([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    return one_node(maker, {"attributes": {"POSITION": P},
                            "indices": maker.add([0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2], np.uint8)})


def turned():
    P, N, F, _ = ball(columns=6, rows=4)
    maker = Maker()
    primitive = {"attributes": {"POSITION": maker.add(P), "NORMAL": maker.add(N)},
                 "indices": maker.add(F.ravel(), np.uint16)}
    return one_node(maker, primitive, translation=[1, 2, 3], rotation=[0, 0.6, 0, 0.8], scale=[-1, 2, 0.5])


def strips_and_fans():
    P, _, _, _ = ball(columns=4, rows=2)
    maker = Maker()
    places = maker.add(P)
    strip = maker.add([0, 5, 1, 6, 2, 7, 3, 8, 4, 9], np.uint16)
    one_node(maker, {"attributes": {"POSITION": places}, "indices": strip, "mode": 5})
    maker.root["meshes"][0]["primitives"] += [
        {"attributes": {"POSITION": places}, "indices": maker.add([12, 5, 6, 7, 8, 9], np.uint32), "mode": 6},
        {"attributes": {"POSITION": places}, "mode": 0}, {"attributes": {"POSITION": places}}]
    return maker


def sparse():
    P, _, F, _ = ball(columns=4, rows=3)
    maker = Maker()
    rows, values = maker.add([0, 3], np.uint16), maker.add([[0, 3, 0], [1, 2, 0]])
    part = {"count": 2, "indices": {"bufferView": rows, "componentType": 5123}, "values": {"bufferView": values}}
    grown = maker.add(P, sparse=part)
    zeros = len(maker.root["accessors"])
    maker.root["accessors"].append({"componentType": 5126, "count": len(P), "type": "VEC3", "sparse": part})
    return one_node(maker, {"attributes": {"POSITION": grown}, "indices": maker.add(F.ravel(), np.uint8),
                            "targets": [{"POSITION": zeros}]})


def inside(maker):
    """JSON, a 0 and the bytes of the buffer."""
    root = maker.root | {"buffers": [{"byteLength": len(maker.binary)}]}
    return json.dumps(root, separators=(",", ":")).encode() + b"\0" + maker.binary


def as_text(maker):
    uri = "data:application/octet-stream;base64," + base64.b64encode(maker.binary).decode()
    root = maker.root | {"buffers": [{"byteLength": len(maker.binary), "uri": uri}]}
    return json.dumps(root, separators=(",", ":")).encode()


def files():
    """All (name, flags, bytes)."""
    for make in tetrahedron, turned, strips_and_fans, sparse, figure:
        name = make.__name__.replace("_", "-")
        yield name, AGAIN, inside(make())
        yield name + "-size", KEEPS_SIZE | RESULT_IS_TEXT, inside(make())
        yield name + "-text", SOURCE_IS_TEXT | RESULT_IS_TEXT | AGAIN, as_text(make())
    yield "details", WITH_DETAILS, inside(figure())
    yield "other-chunk", AS_IT_IS, tetrahedron().bytes(b"\x04\0\0\0TEST1234")
    numbers = random.Random(2)
    for k, share in enumerate(SHARES):
        yield f"surface-{k}", OF_SURFACE | k << 3, some_bytes(numbers, share)


def main():
    folder = pathlib.Path(sys.argv[1])
    for name in "filters", "files":
        (folder / name).mkdir(parents=True, exist_ok=True)
    numbers = random.Random(1)
    for which in range(FILTERS):
        for k, share in enumerate(SHARES):
            (folder / "filters" / f"seed-{which:02}-{k}").write_bytes(seed(numbers, which, share))
    for name, flags, content in files():
        (folder / "files" / f"seed-{name}").write_bytes(bytes([flags]) + content)


if __name__ == "__main__":
    main()
