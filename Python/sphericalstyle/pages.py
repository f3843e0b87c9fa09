# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Write a model as a web page with a slider that rounds it."""
import base64
import html
import json
import os
import pathlib
import struct
import tempfile

from . import presets
from .messages import printable
from .model_files import ModelError, read, whole
from .properties import properties as known_properties
from .sliders import write_slider

PAGES = (".html", ".htm")
TEMPLATE = pathlib.Path(__file__).with_name("page.html")


def write_page(path, mesh, *, preset=None, maximum_roundness=5.0, tolerance=0.005, maximum_targets=12, title=None,
               **properties):
    """Writes a model, not yet rounded, as a web page (.html) with a slider that rounds it and a button for each preset.
    The page is one file that needs no network. It shows shape and vertex colors, not textures.

    mesh and keywords are those of sphericalstyle.write_slider; all presets together have more targets, so fewer are the
    default. The page opens with these; the presets keep center, size, region and what else they do not set.
    title: of the page; by default the name of the file.
    """
    path = pathlib.Path(path)
    if path.suffix.lower() not in PAGES:
        raise ModelError(f"{printable(path)}: the name of a page ends in .html")
    if isinstance(mesh, (str, os.PathLike)):  # once, and of a .glb its shape alone
        mesh = read(mesh)
    known = known_properties()
    choices = [(name, item.description, name, {key: value for key, value in properties.items()
                                               if key not in known or known[key].name not in item.properties})
               for name, item in presets.PRESETS.items()]
    chosen = {key: value for key, value in properties.items() if value is not None}
    first = next(item for item in choices if item[0] == presets.name_of(preset or "Toy"))
    if first[3] != chosen:  # not just a preset
        first = ("As chosen", "What the page was made with", preset, properties)
    choices = [first] + [item for item in choices if item is not first]
    data = None
    with tempfile.TemporaryDirectory() as folder:
        for name, description, preset_, rest in choices:
            file = pathlib.Path(folder) / "model.glb"
            write_slider(file, mesh, preset=preset_, maximum_roundness=maximum_roundness, tolerance=tolerance,
                         maximum_targets=maximum_targets, **rest)
            root, binary = _load(file)
            if data is None:
                data = _model(root, binary, "XYZ".index(_up(properties)))
            data["presets"].append(_preset(root, binary, name, description))
    # One target alone goes on forever, so it has no end of its own.
    ends = [item["start"] if item["linear"] else item["places"][-1] for item in data["presets"]]
    if all(item["linear"] for item in data["presets"]):
        ends.append(maximum_roundness * 3 ** 0.5 / (1 + maximum_roundness * 3 ** 0.5))
    data["end"] = max(ends)
    # "</script>" and "@" cannot be in the data: names are ours, and numbers are base64.
    text = TEMPLATE.read_text(encoding="utf-8").replace("@DATA@", json.dumps(data))
    with whole(path) as part:
        part.write_text(text.replace("@TITLE@", html.escape(printable(title or path.stem))), encoding="utf-8")


def _up(properties):
    return str(properties.get("up_axis") or "Y").upper()


def _load(file):
    """JSON and buffer of a .glb of ours."""
    content = file.read_bytes()
    size, = struct.unpack_from("<I", content, 12)
    return json.loads(content[20:20 + size]), content[28 + size:]


def _numbers(root, binary, accessor):
    import numpy as np

    item = root["accessors"][accessor]
    view = root["bufferViews"][item["bufferView"]]
    kind = {5121: np.uint8, 5125: np.uint32, 5126: np.float32}[item["componentType"]]
    count = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[item["type"]]
    return np.frombuffer(binary, kind, item["count"] * count, view["byteOffset"]).reshape(-1, count)


def _text(array):
    return base64.b64encode(array.tobytes()).decode("ascii")


def _model(root, binary, up):
    """What all presets have in common."""
    import numpy as np

    primitive = root["meshes"][0]["primitives"][0]
    attributes = {name: _numbers(root, binary, k) for name, k in primitive["attributes"].items()}
    points = attributes["POSITION"]
    # Points at one place have one normal, unless an edge is hard there.
    rows = np.concatenate([points, attributes["NORMAL"]], axis=1)
    groups = np.unique(rows, axis=0, return_inverse=True)[1].reshape(-1)
    low, high = points.min(axis=0), points.max(axis=0)
    turn = np.roll(np.eye(3), up - 1, axis=1)  # its second row is up
    return {"points": _text(points), "corners": _text(_numbers(root, binary, primitive["indices"])),
            "groups": _text(groups.astype(np.uint32)),
            "colors": _text(attributes["COLOR_0"][:, :3]) if "COLOR_0" in attributes else None,
            "center": ((low + high) / 2).tolist(), "size": float(np.linalg.norm(high - low)) or 1.0,
            "up": turn.tolist(), "yaw": -0.5, "presets": []}


def _preset(root, binary, name, description):
    """Its targets, in steps of 1/32767 of the largest move."""
    import numpy as np

    mesh = root["meshes"][0]
    told = mesh["extras"]["sphericalStyle"]
    places = told.get("places", [1.0])
    scales, targets = [], []
    for target in mesh["primitives"][0]["targets"]:
        moves = _numbers(root, binary, target["POSITION"])
        scale = float(np.abs(moves).max()) / 32767 or 1.0
        scales.append(scale)
        targets.append(_text(np.rint(moves / scale).astype(np.int16)))
    # Of two neighbors with weights that sum to one, this is the place between them.
    start = sum(weight * place for weight, place in zip(mesh["weights"], places))
    return {"name": name, "description": description, "linear": "places" not in told, "places": places,
            "scales": scales, "targets": targets, "start": start}
