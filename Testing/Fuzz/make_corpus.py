#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the seeds of the fuzz target: for each filter a few inputs, from mostly zeros (defaults and simple
surfaces) to bytes of every value. The same files at every call.

    make_corpus.py FOLDER
"""
import pathlib
import random
import sys

FILTERS = 18  # SubjectFromBytes in FuzzFilters.cxx
SHARES = 0.05, 0.2, 0.5, 1.0  # of bytes that are not zero


def seed(numbers, which, share):
    body = bytes(numbers.randrange(256) if numbers.random() < share else 0 for _ in range(numbers.randrange(60, 400)))
    return bytes([numbers.randrange(2), which]) + body


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    numbers = random.Random(1)
    for which in range(FILTERS):
        for k, share in enumerate(SHARES):
            (folder / f"seed-{which:02}-{k}").write_bytes(seed(numbers, which, share))


if __name__ == "__main__":
    main()
