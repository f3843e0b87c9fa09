# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the manual page of the program sphericalstyle, from its options, and the types of the wrapped classes.

usage: generate.py PROGRAM MANUAL TYPES
"""
import argparse
import importlib.machinery
import importlib.util
import pathlib
import sys


def load(program):
    """The module of the program, which finds the package by itself."""
    loader = importlib.machinery.SourceFileLoader("program", program)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("program", loader))
    loader.exec_module(module)


def escaped(text):
    return text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")


def options(parser):
    """The options, in their groups."""
    formatter = parser._get_formatter()
    for group in parser._action_groups:
        actions = [action for action in group._group_actions if action.help != argparse.SUPPRESS]
        if not actions:
            continue
        yield f".SS {group.title.capitalize()}"
        for action in actions:
            value = "" if action.nargs == 0 else " " + formatter._format_args(action, action.metavar or action.dest)
            names = ", ".join(action.option_strings) + value if action.option_strings else action.metavar
            yield f".TP\n.B {escaped(names)}\n{escaped(formatter._expand_help(action))}"


def manual(parser):
    """The page in the language of man."""
    yield f'.TH SPHERICALSTYLE 1 "" "sphericalstyle {sys.modules["sphericalstyle"].__version__}"'
    yield f".SH NAME\nsphericalstyle \\- round 3D models like toys\n.SH SYNOPSIS\n.nf"
    yield escaped((parser.usage % {"prog": parser.prog}).replace("       ", ""))
    yield f".fi\n.SH DESCRIPTION\n{escaped(parser.description)}\n.SH OPTIONS"
    yield from options(parser)
    for section in parser.epilog.split("\n\n"):
        title, _, text = section.partition(":\n")
        yield f".SH {title.upper()}\n.nf\n{escaped(text)}\n.fi"


def write_types(path):
    """With VTK's own script, where it is there."""
    try:
        from vtkmodules import generate_pyi
    except ImportError:
        path.write_text("from typing import Any\n\ndef __getattr__(name: str) -> Any: ...\n")
        return
    generate_pyi.main(["generate_pyi", "-p", "sphericalstyle", "-o", str(path.parent), path.stem])


if __name__ == "__main__":
    load(sys.argv[1])
    page = pathlib.Path(sys.argv[2])
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text("\n".join(manual(sys.modules["sphericalstyle.command_line"].make_parser())) + "\n")
    write_types(pathlib.Path(sys.argv[3]))
