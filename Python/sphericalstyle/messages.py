# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Errors and warnings of VTK's algorithms, for Python."""
import re
import sys
import warnings

from vtkmodules.vtkCommonCore import VTK_STRING


class Error(RuntimeError):
    """A mesh cannot be rounded, or a file cannot be read or written. The message says why."""


class StyleWarning(UserWarning):
    """What a filter has to say about a mesh that it took, or a reader about a file."""


def printable(text):
    """The text with escapes for control characters, line breaks, and bytes that are not text."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in str(text))


class Messages:
    """Collects errors and warnings of an algorithm; VTK would print them and continue."""

    printed = set()  # warnings, of all algorithms

    def __init__(self, algorithm):
        self.errors = []
        self.warnings = []
        self.failed = False  # the executive reports errors without details
        algorithm.AddObserver("ErrorEvent", self._error)
        algorithm.AddObserver("WarningEvent", self._warning)
        executive = algorithm.GetExecutive() if hasattr(algorithm, "GetExecutive") else None
        if executive:
            executive.AddObserver("ErrorEvent", self._failure)

    def _error(self, _source, _event, text):
        self.errors.append(self._plain(text))

    def _failure(self, _source, _event):
        self.failed = True

    def _warning(self, _source, _event, text):
        warning = self._plain(text)
        if warning not in self.warnings:
            self.warnings.append(warning)

    _error.CallDataType = VTK_STRING
    _warning.CallDataType = VTK_STRING

    @staticmethod
    def _plain(text):
        """The message without source file, line and address."""
        plain = re.sub(r"^\w+: In .*\n\w+ \(0x[0-9a-f]+\): ", "", text.strip())
        return "\n".join(map(printable, plain.splitlines()))

    def print_warnings(self):
        """Prints each warning once, although a series runs an algorithm many times."""
        for warning in self.warnings:
            if warning not in self.printed:
                self.printed.add(warning)
                print(f"Warning: {warning}", file=sys.stderr)

    def warn(self, stacklevel=3):
        """Each becomes a Python warning, by default of who calls our caller."""
        for text in self.warnings:
            warnings.warn(text, StyleWarning, stacklevel=stacklevel)

    def raise_errors(self, what=None, kind=Error):
        """Raises what was said, behind these words."""
        if self.errors or self.failed:
            raise kind("\n  ".join(filter(None, [what, *dict.fromkeys(self.errors)])))
