# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Python lets one set any attribute of VTK's objects, so a misspelled property would be ignored. Here it is an error."""
from .properties import closest


def guard(namespace, names):
    """Makes objects of these classes refuse attributes that they do not have. Subclasses of one's own may have any.

    VTK 9.2 and later create an object of the class given to override() in place of the wrapped class.
    """
    for name in names:
        wrapped = namespace[name]
        if hasattr(wrapped, "override") and isinstance(wrapped, type) and not hasattr(wrapped, "IsAbstract"):
            _override(wrapped)


def _override(wrapped):
    def set_attribute(self, name, value):
        if not name.startswith("_") and not hasattr(type(self), name):
            raise AttributeError(f"{wrapped.__name__} has no attribute '{name}'{_hint(wrapped, name)}")
        super(guarded, self).__setattr__(name, value)

    body = {"__setattr__": set_attribute, "__doc__": wrapped.__doc__, "__module__": wrapped.__module__}
    # VTK would take a class of the same name for its own.
    guarded = type(wrapped.__name__ + "Object", (wrapped,), body)
    wrapped.override(guarded)


def _hint(wrapped, name):
    """The setter that was meant."""
    setters = {method[3:]: method for method in dir(wrapped) if method.startswith("Set")}
    found = closest(name, setters)
    return f"; did you mean {setters[found.split(chr(39))[1]]}()?" if found else ""
