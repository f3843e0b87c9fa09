# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""glTF files, read and made with Python's own json and struct: nothing of ours and nothing of VTK."""
import base64
import copy
import json
import os
import shutil
import struct
import subprocess
import urllib.parse

import numpy as np

TYPES = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
VALIDATOR = """
const validator = require(process.argv[1] + "/gltf-validator"), fs = require("fs"), path = require("path");
Promise.all(process.argv.slice(2).map(file => validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
  externalResourceFunction: uri => fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(uri)))
    .then(bytes => new Uint8Array(bytes))
}))).then(reports => console.log(JSON.stringify(reports.map(report => report.issues))));
"""
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def find_module(name):
    """$SPHERICALSTYLE_NODE_MODULES, the folder node_modules of npm, if it has this package, or None."""
    modules = os.path.abspath(os.environ.get("SPHERICALSTYLE_NODE_MODULES") or os.devnull)
    return modules if os.path.isdir(os.path.join(modules, name)) else None


def find_validator():
    """The folder with Khronos' validator, or None where it or node is not there."""
    return find_module("gltf-validator") if shutil.which("node") else None


def validate(modules, files):
    """What Khronos' validator finds in each file: its "issues", such as numErrors and messages."""
    command = ["node", "-e", VALIDATOR, os.path.abspath(modules), *map(os.path.abspath, files)]
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)


def load(path):
    """The JSON of a .glb or .gltf and the bytes of its buffers, one after the other."""
    def content_of(uri):
        if uri.startswith("data:"):
            return base64.b64decode(uri.partition("base64,")[2])
        with open(os.path.join(os.path.dirname(path), urllib.parse.unquote(uri)), "rb") as file:
            return file.read()

    with open(path, "rb") as file:
        content = file.read()
    if content[:4] != b"glTF":
        root = json.loads(content)
        return root, b"".join(content_of(b["uri"])[:b["byteLength"]] for b in root.get("buffers", []))
    magic, version, length = struct.unpack("<4sII", content[:12])
    assert (version, length) == (2, len(content)) and length % 4 == 0
    size, kind = struct.unpack("<I4s", content[12:20])
    assert kind == b"JSON" and size % 4 == 0
    root, at, binary = json.loads(content[20:20 + size]), 20 + size, b""
    if at < length:
        size, kind = struct.unpack("<I4s", content[at:at + 8])
        assert kind == b"BIN\0" and size % 4 == 0
        binary = content[at + 8:at + 8 + size]
    return root, binary


def numbers(root, binary, accessor, exact=True):
    """The elements of an accessor, checked against what it says of them; bounds only where it is `exact`."""
    item = root["accessors"][accessor]
    view = root["bufferViews"][item["bufferView"]]
    components = COMPONENTS[item["type"]]
    first = view.get("byteOffset", 0) + item.get("byteOffset", 0)
    kind = np.dtype(TYPES[item["componentType"]])
    sizes = [buffer["byteLength"] for buffer in root["buffers"]]
    assert "byteStride" not in view and first % kind.itemsize == 0
    assert view.get("byteOffset", 0) + view["byteLength"] <= sizes[view["buffer"]] <= len(binary)
    first += sum(sizes[:view["buffer"]])
    values = np.frombuffer(binary, kind, item["count"] * components, first).reshape(item["count"], components)
    for key, end in (("min", np.min), ("max", np.max)):
        if exact and key in item:
            assert item[key] == end(values, axis=0).tolist(), (accessor, key)
    return values


def points(root, binary, weights, mesh=0, primitive=0, attribute="POSITION"):
    """Where a viewer shows the points of a primitive for these weights."""
    item = root["meshes"][mesh]["primitives"][primitive]
    result = numbers(root, binary, item["attributes"][attribute]).astype(float)
    assert len(weights) == len(item["targets"])
    for weight, target in zip(weights, item["targets"]):
        result = result + weight * numbers(root, binary, target[attribute])
    return result


def chain(places, w):
    """The weights of several targets where the slider is at w, as the page about glTF says."""
    return [np.interp(w, [0, *places], np.eye(len(places) + 1)[k + 1]) for k in range(len(places))]


def without_slider(root, binary, before):
    """What is left of a file with a slider when all is taken away that the slider has added to `before`: both are JSON.
    Equal to `before`, also in the order of keys, if nothing else has changed. `binary` is the buffer of `root`."""
    def shortened(holder, key, had):
        """A list as long as it was; removed where there was none."""
        if key in holder:
            holder[key] = holder[key][:len(had.get(key, []))]
        if key not in had:
            holder.pop(key, None)

    left = copy.deepcopy(root)
    for key in ("accessors", "bufferViews", "animations", "meshes"):
        shortened(left, key, before)
    for buffer, had in zip(left["buffers"], before["buffers"]):
        buffer["byteLength"] = had["byteLength"]
    left["buffers"] = left["buffers"][:len(before["buffers"])]
    for mesh, had in zip(left["meshes"], before["meshes"]):
        for primitive, own in zip(mesh["primitives"], had["primitives"]):
            shortened(primitive, "targets", own)
        shortened(mesh, "weights", had)
        extras = mesh.get("extras", {})
        extras.pop("sphericalStyle", None)
        shortened(extras, "targetNames", had.get("extras", {}))
        if "extras" not in had:
            assert not extras
            mesh.pop("extras", None)
    counts = {}  # of targets, by node
    for index, (node, had) in enumerate(zip(left.get("nodes", []), before.get("nodes", []))):
        shortened(node, "weights", had)
        if "mesh" not in had:
            continue
        counts[index] = [len(mesh["primitives"][0].get("targets", []))
                         for mesh in (before["meshes"][had["mesh"]], root["meshes"][node["mesh"]])]
        if node["mesh"] != had["mesh"]:  # shown more than once: each place has targets of its own
            own, copied = (meshes["meshes"][item["mesh"]] for meshes, item in ((before, had), (root, node)))
            assert node["mesh"] >= len(before["meshes"])
            assert [primitive["attributes"] for primitive in own["primitives"]] \
                == [primitive["attributes"] for primitive in copied["primitives"]]
            node["mesh"] = had["mesh"]
    for animation, had in zip(left.get("animations", []), before.get("animations", [])):
        for channel in had["channels"]:
            sampler, own = (item["samplers"][channel["sampler"]] for item in (animation, had))
            if channel["target"]["path"] == "weights" and sampler["output"] != own["output"]:
                few, many = counts[channel["target"]["node"]]
                shown, was = (numbers(root, binary, item["output"], exact=False) for item in (sampler, own))
                assert (shown.reshape(-1, many)[:, :few] == was.reshape(-1, few)).all()
                sampler["output"] = own["output"]
    return left


class Maker:
    """Makes a file bit by bit."""

    def __init__(self, **root):
        self.binary = b""
        self.root = {"asset": {"version": "2.0", "generator": "a test"}, "accessors": [], "bufferViews": [], **root}

    def add(self, values, kind=np.float32, bounds=False, target=None, **more):
        """@return the number of the new accessor"""
        values = np.asarray(values, kind)
        view = self.view(values, **({"target": target} if target else {}))
        components = values.shape[1] if values.ndim == 2 else 1
        names = {count: name for name, count in COMPONENTS.items()}
        code = next(code for code, known in TYPES.items() if np.dtype(known) == values.dtype)
        item = {"bufferView": view, "componentType": code, "count": len(values),
                "type": names[components], **more}
        if bounds:
            rows = values.reshape(len(values), -1)
            item |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        self.root["accessors"].append(item)
        return len(self.root["accessors"]) - 1

    def view(self, content, **more):
        """@return the number of the new buffer view"""
        self.binary += b"\0" * (-len(self.binary) % 4)
        first = len(self.binary)
        self.binary += bytes(content)
        size = len(self.binary) - first
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": first, "byteLength": size, **more})
        return len(self.root["bufferViews"]) - 1

    def bytes(self, more=b""):
        """The whole file. @param more  further chunks"""
        root = copy.deepcopy(self.root) | {"buffers": [{"byteLength": len(self.binary)}]}
        text = json.dumps(root).encode()
        text += b" " * (-len(text) % 4)
        binary = self.binary + b"\0" * (-len(self.binary) % 4)
        length = 12 + 8 + len(text) + 8 + len(binary) + len(more)
        return struct.pack("<4sIII4s", b"glTF", 2, length, len(text), b"JSON") + text \
            + struct.pack("<I4s", len(binary), b"BIN\0") + binary + more

    def save(self, path, more=b""):
        with open(path, "wb") as file:
            file.write(self.bytes(more))
        return path


def ball(center=(0, 0, 0), size=(1, 2, 0.7), columns=24, rows=12):
    """Points, normals, triangles and texture coordinates of an ellipsoid with a seam: the points of one meridian are
    there twice."""
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, columns + 1), np.linspace(0, np.pi, rows + 1))
    u[:, -1] = 0
    n = np.stack([np.sin(v) * np.cos(u), np.cos(v), np.sin(v) * np.sin(u)], axis=-1).reshape(-1, 3)
    ids = np.arange(len(n)).reshape(u.shape)
    a, b, c, d = ids[:-1, :-1], ids[:-1, 1:], ids[1:, 1:], ids[1:, :-1]
    triangles = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    uv = np.stack(np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1)), -1).reshape(-1, 2)
    return (np.asarray(center) + n * size).astype(np.float32), n.astype(np.float32), triangles, uv.astype(np.float32)


def figure():
    """A small file with bones, a target that moves, and a mesh that is shown twice."""
    P, N, F, _ = ball(columns=5, rows=3)
    maker = Maker(scene=0)
    indices = maker.add(F.ravel(), np.uint8)
    shape = {"POSITION": maker.add(P), "NORMAL": maker.add(N)}
    share = np.rint(127.5 * (1 + P[:, 1] / 2)).astype(np.uint8)
    zeros = np.zeros_like(share)
    skinned = shape | {
        "JOINTS_0": maker.add(np.stack([zeros, zeros + 1, zeros, zeros], axis=1), np.uint8),
        "WEIGHTS_0": maker.add(np.stack([255 - share, share, zeros, zeros], axis=1), np.uint8, normalized=True)}
    moved = maker.add(0.1 * N)
    bind = maker.add(np.tile(np.eye(4), (2, 1, 1)).reshape(2, 16))
    times, weights = maker.add([0, 1]), maker.add([0, 1])
    maker.root |= {
        "meshes": [{"primitives": [{"attributes": skinned, "indices": indices}]},
                   {"weights": [0.5], "extras": {"targetNames": ["Grin"]}, "primitives": [
                       {"attributes": shape, "indices": indices, "targets": [{"POSITION": moved}]}]}],
        "skins": [{"joints": [3, 4], "inverseBindMatrices": bind}],
        "nodes": [{"children": [1, 2, 3, 5]}, {"mesh": 0, "skin": 0}, {"mesh": 1, "translation": [4, 0, 0]},
                  {"children": [4]}, {"rotation": [0, 0, 0.6, 0.8]},
                  {"mesh": 1, "matrix": [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, -4, 0, 0, 1], "weights": [1]}],
        "scenes": [{"nodes": [0]}],
        "animations": [{"samplers": [{"input": times, "output": weights}],
                        "channels": [{"sampler": 0, "target": {"node": 2, "path": "weights"}}]}]}
    return maker
