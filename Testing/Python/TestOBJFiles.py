# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""sphericalstyle.read with OBJ files whose faces name what is not there: VTK's reader, given such a file, crashes.

usage: TestOBJFiles.py FOLDER
"""
import os
import pathlib
import random
import sys
import warnings

import numpy as np

import sphericalstyle as ss
from sphericalstyle import obj_files
from SurfaceTesting import points

folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
file = folder / "model.obj"
POINTS = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
COORDINATES, NORMALS = "vt 0 0\nvt 1 0\n", "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\n"
CORNERS = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def write(text):
    file.write_bytes(text.encode())
    return file


def read(text):
    """The surface, and what is said of it."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        surface = ss.read(write(text))
    assert all(warning.category is ss.StyleWarning and warning.filename == __file__ for warning in said), said
    return surface, "\n".join(str(warning.message) for warning in said)


def arrays_of(surface):
    """In alphabetical order, without the one of VTK 9.3 and later that has the name of a material."""
    data = surface.GetPointData()
    return sorted(name for name in map(data.GetArrayName, range(data.GetNumberOfArrays())) if name != "wood")


# Texture coordinates or normals that are not there are left out, and the first face is named. Numbers far behind an
# array end the process where VTK looks them up, in each of these ways to write them. Of COORDINATES there are 2.
FAR = 100_000_000
for text, words in ((f"f 1/1 2/2 3/{FAR}\n", f"line 6 names texture coordinate {FAR}, and the file has 2"),
                    ("f 1/1 2/2 3/3\n", "line 6 names texture coordinate 3, and the file has 2"),
                    ("f 1/1 2/0 3/2\n", "line 6 names texture coordinate 0"),
                    ("f 1/1 2/-3 3/2\n", "line 6 names texture coordinate -3, and the file has 2 before it"),
                    (f"# one more\nf 1/1 2/2 3/{FAR}\n", "line 7 names"), (f"\t f 1/1 2/2 3/{FAR}\n", "line 6 names"),
                    (f"f\t1/1\t2/2 3/{FAR}\r\n", "line 6 names"), (f"f 1/1 2/2 \\\n3/{FAR}\n", "line 6 names"),
                    (f"# a backslash \\\nf 1/1 2/2 3/{FAR}\n", "line 7 names"), (f"f +1/1 2/2 3/+{FAR}\n", "line 6 names"),
                    (f"f 1/1 2/2 3/{FAR}.5\n", "line 6 names"), (f"f 1/1 2/2 3/ {FAR}\n", "line 6 names"),
                    (f"f 1/1 2/2 3/2\nusemtl wood\nf 1/1 2/2 3/{FAR}\n", "line 8 names"),
                    (f"f 1/1 2/2 3/2\nf 1/1 2/2 3/{FAR}", "line 7 names")):
    surface, said = read(POINTS + COORDINATES + text)
    assert words in said and said.endswith("read without its texture coordinates"), (text, said)
    assert surface.GetNumberOfPolys() == text.count("f ") + text.count("f\t"), text
    assert np.array_equal(points(surface), CORNERS) and arrays_of(surface) == [], text
for text, words, arrays in (
        (NORMALS + COORDINATES + f"f 1/1/1 2/2/2 3/{FAR}/3\n", "names texture coordinate", ["Normals"]),
        (NORMALS + COORDINATES + f"f 1/1/1 2/2/2 3/1/{FAR}\n", "names normal", ["TCoords"]),
        (NORMALS + f"f 1//1 2//2 3//{FAR}\n", f"names normal {FAR}, and the file has 3", []),
        # Many programs write numbers of texture coordinates without any.
        ("f 1/1 2/2 3/3\n", "names texture coordinate 1, and the file has 0", []),
        (NORMALS + "f 1/1/1 2/2/2 3/3/3\n", "names texture coordinate 1, and the file has 0", ["Normals"])):
    surface, said = read(POINTS + text)
    assert words in said and "\n" not in said, (text, said)
    assert np.array_equal(points(surface), CORNERS) and surface.GetNumberOfPolys() == 1, text
    assert arrays_of(surface) == arrays, (text, arrays_of(surface))
said = read(POINTS + COORDINATES + NORMALS + "f 1/3/4 2/2/2 3/1/1\n")[1]
assert "read without its normals" in said and "read without its texture coordinates" in said, said

# Points that are not there: no surface.
for text, words in ((POINTS + "f 1 2 4\n", "line 4 names point 4, and the file has 3; write it again"),
                    (POINTS + "f 1 2 3\nf 1 0 3\n", "line 5 names point 0"),
                    (POINTS + "f 1 2 99999999999999999999\n", "names point 99999999999999999999"),
                    (POINTS + "f -1 -2 -4\n", "names point -4, and the file has 3 before it"),
                    ("f -1 -2 -3\n" + POINTS, "line 1 names point -1, and the file has 0 before it"),
                    (POINTS + "f 1/9 2/9 9/9\n", "names point 9")):
    try:
        read(text)
    except ss.Error as error:
        assert words in str(error), (text, error)
    else:
        raise AssertionError(text)

# What is there is read as ever, without a word. So are files whose faces name normals where there are none at all.
ALL = POINTS + COORDINATES + NORMALS
for text, arrays in ((POINTS + COORDINATES + "f 1/1 2/2 3/1\n", ["TCoords"]),
                     (ALL + "f 1/1/1 2/2/1 3/1/3\n", ["Normals", "TCoords"]),
                     (POINTS + NORMALS + "f 1//1 2//3 3//1\n", ["Normals"]), (POINTS + "f 1//7 2//7 3//7\n", []),
                     ("f 1/1 2/2 3/1\n" + POINTS + COORDINATES, ["TCoords"]),
                     (POINTS + COORDINATES + "f -3/-1 -2/-1 -1/-2\n", ["TCoords"]),
                     (POINTS + COORDINATES + "f -3/-1 -2/-1 \\\n-1/-2\nv 9 9 9\nvt 1 1\n", ["TCoords"]),
                     ("\ufeff" + POINTS + "f 1 2 3\n", []), ("\ufeff# a comment\n" + POINTS + "f 1 2 3\n", []),
                     (POINTS + "f 1 2 3\n  \nf 3 2 1\n", [])):
    surface, said = read(text)
    assert not said and arrays_of(surface) == arrays, (text, said, arrays_of(surface))
    assert np.array_equal(points(surface), CORNERS) and surface.GetNumberOfPolys() > 0, text

# The quick look at a file and the look at each of its corners agree, where the quick one is sure; that is so with files
# in the usual forms.
rng = random.Random(3)
sure = wrong = 0
for _ in range(3000):
    form = rng.choice(["{0}", "{0}/{1}", "{0}//{2}", "{0}/{1}/{2}"])
    counts = [rng.randint(3, 6) for _ in range(3)]
    beyond, backward = rng.random() < 0.3, rng.random() < 0.2
    lines = [f"{kind} 0 0 0" for kind, count in zip(("v", "vt", "vn"), counts) for _ in range(count)]
    for _ in range(rng.randint(1, 4)):
        corners = []
        for _ in range(rng.randint(3, 5)):
            numbers = [rng.randint(1, count + beyond) * rng.choice([1, -backward or 1]) for count in counts]
            corners.append((rng.choice(["{0}", "{0}/{1}"]) if rng.random() < 0.01 else form).format(*numbers))
        lines.insert(rng.randint(3, len(lines)) if rng.random() < 0.1 else len(lines), "f " + " ".join(corners))
    write("\n".join(lines) + "\n")
    found = obj_files._find_misfits(file)
    quick = obj_files._surely_fits(file)
    assert not (quick and found), (lines, found)
    sure += quick
    wrong += bool(found)
assert sure > 1000 and wrong > 500, (sure, wrong)
os.remove(file)
