# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The pictures follow the center up and down again, and the movies have all of them."""
import re
import struct

import numpy as np

from ExampleTesting import data, may_limit_files, output, pixels, run, run_badly, run_well

FRAMES, LABEL = 6, 70
model = data / "creature.vtp"

run_well("animate_center.py", model, output / "pictures", "--frames", FRAMES)
names = [f"{frame:04d}.png" for frame in range(FRAMES)]
assert sorted(file.name for file in (output / "pictures").iterdir()) == names
seen = [np.any(pixels(output / "pictures" / name)[LABEL:] < 250, axis=2) for name in names]
middle = [np.nonzero(picture)[0].mean() for picture in seen]  # height of what is seen
assert middle[0] < middle[1] < middle[2] < middle[3], middle
for up, down in ((1, 5), (2, 4)):
    assert np.mean(seen[up] != seen[down]) < 1e-3, (up, down)

# A movie of Motion JPEG counts its frames in the header, 48 bytes in; each is a JPEG.
text = run_well("animate_center.py", model, output / "movie.avi", "--frames", FRAMES, "--rate", 12)
assert f"{FRAMES} frames" in text, text
movie = (output / "movie.avi").read_bytes()
assert movie[:4] == b"RIFF" and movie[8:12] == b"AVI "
microseconds, frames = struct.unpack_from("<I", movie, 32)[0], struct.unpack_from("<I", movie, 48)[0]
assert frames == FRAMES and abs(microseconds - 1e6 / 12) < 2, (frames, microseconds)
assert len(re.findall(rb"\xff\xd8\xff", movie)) == FRAMES

# Ogg Theora counts in the last page: which frame the last key frame is, and in the lowest six bits how many
# follow it.
run_well("animate_center.py", model, output / "movie.ogv", "--frames", FRAMES)
movie = (output / "movie.ogv").read_bytes()
assert movie[:4] == b"OggS" and b"theora" in movie[:64]
granule = struct.unpack_from("<q", movie, movie.rindex(b"OggS") + 6)[0]
assert (granule >> 6) + (granule & 63) == FRAMES, granule

done = run("animate_center.py", model, output / "movie.xyz")
assert done.returncode == 2 and ".ogv" in done.stdout, done.stdout
assert not (output / "movie.xyz").exists()

if may_limit_files:  # a full disk
    assert "too large" in run_badly("animate_center.py", model, output / "full.ogv", "--frames", FRAMES,
                                    largest_file=len(movie) // 2)
