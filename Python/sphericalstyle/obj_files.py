# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""OBJ files whose faces name points, texture coordinates or normals that the file does not have, or count them back
from their line. VTK's reader reads behind its arrays there; that of VTK 9.3 also where faces count back, that of 9.1
also where they name normals and there are none."""
import collections
import mmap
import re

import numpy as np

KINDS = {b"v": "point", b"vt": "texture coordinate", b"vn": "normal"}
COMMANDS = tuple(KINDS)

#: The first corner of a face that names a number which is not there: its line, the number as it stands, how many there
#: are.
Misfit = collections.namedtuple("Misfit", "line number count")

#: A corner as the reader takes it: with spaces before each number, and whatever is left until the next space.
_CORNER = re.compile(rb"\s*([+-]?\d+)(?:/\s*([+-]?\d+)(?:/\s*([+-]?\d+))?|//\s*([+-]?\d+))?\S*")
_FACES = b"f ", b"f\t", b"f\v", b"f\f"
_BACKWARD = re.compile(rb"^[^\S\n]*f\s[^\n]*-", re.MULTILINE)
_NORMAL = re.compile(rb"^[^\S\n]*vn\s", re.MULTILINE)
_NAMED_NORMAL = re.compile(rb"^[^\S\n]*f\s[^\n]*/[^\s/]*/", re.MULTILINE)
_BOM = b"\xef\xbb\xbf"  # of UTF-8; VTK's reader takes it for a part of the first command
_PIECE = 1 << 20  # bytes of a file that are looked at together
_ONLY_NUMBERS = bytes.maketrans(b"f/", b"  ")


def misfits(path):
    """The first misfit of each command of COMMANDS that has one. That there are no normals at all is none."""
    return {} if _surely_fits(path) else _find_misfits(path)


def to_rewrite(path):
    """What has to be left out of a copy that VTK's readers take, without misfits: normals that faces name where the
    file has none. None where no copy is needed: one is where a face counts back from its line, or may go on in the
    next, or where the file begins with a byte order mark."""
    with open(path, "rb") as file:
        if file.seek(0, 2) == 0:
            return None
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as text:
            if not _NORMAL.search(text) and _NAMED_NORMAL.search(text):
                return [b"vn"]
            return [] if text[:3] == _BOM or _BACKWARD.search(text) or text.find(b"\\") >= 0 else None


def copy_without(path, copy, left_out):
    """Writes the file into another one, without the lines of these commands, which faces do not name then, and with
    numbers that count from the beginning."""
    counts = collections.Counter()
    for _, command, rest in _commands(path):
        counts[command] += 1
        if command == b"f":
            rest = b" ".join(_written({of: _forward(number, counts[of]) for of, number in _numbers(corner)
                                       if of not in left_out}) for corner in _CORNER.finditer(rest))
        if command not in left_out:
            copy.write(b"%s %s\n" % (command, rest.strip()))


def _numbers(corner):
    """The command and the number of all that a corner names."""
    return [(of, given) for of, given in zip(COMMANDS, (corner[1], corner[2], corner[3] or corner[4])) if given]


def _forward(number, count):
    """A number counted from the beginning. count: how many there are before the line."""
    return b"%d" % (count + 1 + int(number)) if number.startswith(b"-") else number


def _written(numbers):
    """A corner."""
    return b"/".join(numbers.get(of, b"") for of in COMMANDS).rstrip(b"/")


def _surely_fits(path):
    """Whether there is no misfit, from the largest number of each kind. False also where a file is written in a way
    that few programs write."""
    counts, largest = collections.Counter(), dict.fromkeys(COMMANDS, 0)
    with open(path, "rb") as file:
        while lines := file.readlines(_PIECE):
            columns = _columns(b"".join([line for line in lines if line.startswith(_FACES)]))
            if columns is None:
                return False
            for command, column in columns.items():
                largest[command] = max(largest[command], column.max())
                lowest = column.min()
                if lowest <= 0 and (-lowest > counts[command] or not column.all()):  # counted back from the line
                    return False
            for start, count in collections.Counter([line[:3] for line in lines]).items():
                if start[:1].isspace() and not start.endswith(b"\n"):
                    return False
                counts[b"".join(start.split(None, 1)[:1])] += count
    return all(largest[command] <= counts[command] or not _counts(command, counts) for command in COMMANDS)


def _counts(command, counts):
    """Whether the reader looks the number up."""
    return command != b"vn" or counts[command] > 0


def _columns(faces):
    """The numbers of each kind in lines of faces. None where corners are not alike or not of digits alone."""
    if not faces:
        return {}
    shapes = set(faces.translate(None, b"0123456789-").split()) - {b"f"}
    slashes, pairs = faces.count(b"/"), faces.count(b"//")
    if not shapes:
        kinds, count = COMMANDS[:1], None
    elif shapes == {b"/"}:
        kinds, count = COMMANDS[:2], 2 * slashes
    elif shapes == {b"//"} and pairs == 0:
        kinds, count = COMMANDS, 3 * slashes // 2
    elif shapes == {b"//"} and 2 * pairs == slashes:
        kinds, count = COMMANDS[::2], slashes
    else:
        return None
    numbers = np.fromstring(faces.translate(_ONLY_NUMBERS), dtype=np.int64, sep=" ")
    if len(numbers) == 0 or len(numbers) != (count or len(numbers)):
        return None
    return dict(zip(kinds, numbers.reshape(-1, len(kinds)).T))


def _find_misfits(path):
    """As misfits, corner by corner."""
    totals = collections.Counter(command for _, command, _ in _commands(path))
    counts, found = collections.Counter(), {}
    for number, command, rest in _commands(path):
        counts[command] += 1
        for corner in _CORNER.finditer(rest) if command == b"f" else ():
            for of, given in _numbers(corner):
                if of not in found and _counts(of, totals):
                    count = counts[of] if given.startswith(b"-") else totals[of]
                    if not 1 <= abs(int(given)) <= count:
                        found[of] = Misfit(number, given.decode(), count)
    return found


def _commands(path):
    """Number, command and the rest of each line. A face whose line ends with a backslash goes on in the next."""
    with open(path, "rb") as file:
        lines = enumerate(file, 1)
        for number, line in lines:
            if number == 1:
                line = line.removeprefix(_BOM)
            command, rest = (*line.split(None, 1), b"", b"")[:2]
            while command == b"f" and rest.rstrip().endswith(b"\\"):
                rest = rest.rstrip()[:-1] + b" " + next(lines, (0, b""))[1]
            if command:
                yield number, command, rest
