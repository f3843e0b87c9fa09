# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The properties of filters as keywords of Python, read from their classes."""
import difflib
import functools
import operator
import re
from typing import Any, NamedTuple

from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkPolyDataAlgorithm

from .messages import Messages
from .SphericalStyleFilters import vtkSphericalStyleFilter

VTK_INT_MAX = 2**31 - 1


class Property(NamedTuple):
    name: str  #: in VTK, such as "NormalBlend"
    keyword: str  #: in Python, such as "normal_blend"
    default: Any  #: a number, a tuple, a bool, or the name of a choice
    choices: tuple  #: names, in the order of their values; empty for others
    minimum: Any  #: None where the class has no bound of its own
    maximum: Any
    description: str  #: the class' own words

    @property
    def kind(self):
        """One of "choice", "switch", "vector", "integer" and "number"."""
        if self.choices:
            return "choice"
        kinds = {bool: "switch", tuple: "vector", int: "integer"}
        return kinds.get(type(self.default), "number")

    @property
    def range(self):
        """The values that it takes, in words."""
        if self.choices:
            return one_of(self.choices)
        if self.minimum is None:
            return {"switch": "True or False", "vector": "three numbers"}.get(self.kind, "a number")
        if self.maximum == VTK_INT_MAX:
            return f"{self.minimum} or more"
        return f"{self.minimum:g} to {self.maximum:g}"

    def set(self, style, value):
        """Sets it. @raise ValueError if the filter does not take this value, TypeError if it is of another kind"""
        if self.kind == "choice":
            self._choose(style, value)
            return
        value = self._converted(value)
        warned = style.AddObserver("WarningEvent", lambda *_: None)  # VTK would print it; here it is the exception
        try:
            getattr(style, "Set" + self.name)(value)
            taken = getattr(style, "Get" + self.name)() == value  # not for NaN
        except (OverflowError, ValueError):
            taken = False
        finally:
            style.RemoveObserver(warned)
        if not taken:
            raise ValueError(f"{self.keyword} must be {self.range}; it is {_text(value)}")

    def _choose(self, style, value):
        if not isinstance(value, str):
            raise TypeError(f"{self.keyword} must be {self.range}; it is {value!r}")
        choice = next((c for c in self.choices if _plain(c) == _plain(value)), None)
        if choice is None:
            raise ValueError(f"{self.keyword} must be {self.range}; it is {value!r}")
        if hasattr(style, f"Set{self.name}To{choice}"):
            getattr(style, f"Set{self.name}To{choice}")()
        else:
            getattr(style, "Set" + self.name)(self.choices.index(choice))

    def _converted(self, value):
        """@raise TypeError, ValueError for a number that is too large for a float"""
        try:
            if isinstance(value, str):
                raise TypeError
            if self.kind == "switch":
                if value not in (False, True):
                    raise TypeError
                return bool(value)
            if self.kind == "vector":
                x, y, z = map(float, value)
                return x, y, z
            return operator.index(value) if self.kind == "integer" else float(value)
        except OverflowError:
            raise ValueError(f"{self.keyword} must be {self.range}; it is too large") from None
        except (TypeError, ValueError):
            kind = "a whole number" if self.kind == "integer" else self.range if self.minimum is None else "a number"
            raise TypeError(f"{self.keyword} must be {kind}; it is {value!r}") from None


def _plain(name):
    return re.sub("(?<!^)[ _-]", "", name).lower()  # "-Z" is not "Z"


def _text(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


def one_of(names):
    """The names in words: "A", "B" or "C"."""
    quoted = [f'"{name}"' for name in names]
    return " or ".join([", ".join(quoted[:-1])] * (len(quoted) > 1) + quoted[-1:])


def keyword_of(name):
    """normal_blend of NormalBlend."""
    return re.sub("(?<!^)(?=[A-Z])", "_", name).lower()


def _description(method):
    """What the class' documentation says of the property, in one line."""
    text = (method.__doc__ or "").rpartition("C++: ")[2].partition("\n\n")[2]
    return " ".join(text.split())


def _choices(style, name):
    """The names of the values of an enumeration."""
    if name == "OutputPointsPrecision":  # VTK's own, without a setter for each
        values = {name: getattr(vtkAlgorithm, f"{name.upper()}_PRECISION") for name in ("Single", "Double", "Default")}
    else:
        values = {}
        for setter in dir(style):
            if setter.startswith(f"Set{name}To"):
                getattr(style, setter)()
                values[setter[len(f"Set{name}To"):]] = getattr(style, "Get" + name)()
    return tuple(sorted(values, key=values.get))


def _name_of(keyword):
    """NormalBlend of normal_blend."""
    return "".join(word.capitalize() for word in keyword.split("_"))


@functools.lru_cache(maxsize=None)
def _property(kind, name):
    style = kind()
    default = getattr(style, "Get" + name)()
    bounds = [getattr(style, f"Get{name}{end}Value", lambda: None)() for end in ("Min", "Max")]
    choices = _choices(style, name)
    if choices:
        default = choices[default]
    elif hasattr(style, name + "On"):
        default, bounds = bool(default), (None, None)
    return Property(name, keyword_of(name), default, choices, *bounds, _description(getattr(style, "Set" + name)))


@functools.lru_cache(maxsize=None)
def properties():
    """{keyword: Property} of vtkSphericalStyleFilter, the three that make the shape first."""
    style = vtkSphericalStyleFilter()
    own = set(dir(style)) - set(dir(vtkPolyDataAlgorithm)) - {"SetPreview"}  # for windows, while something is dragged
    names = [name[3:] for name in own if name.startswith("Set") and "Get" + name[3:] in own]
    names = [name for name in names if isinstance(getattr(style, "Get" + name)(), (int, float, tuple))]
    first = ["Roundness", "NormalBlend", "DetailSize"]
    return {keyword_of(name): _property(vtkSphericalStyleFilter, name) for name in first + sorted(set(names) - set(first))}


def set_all(algorithm, keywords, other_names=None):
    """Sets properties of an algorithm of ours, unless they are None. @return {name in VTK: keyword}
    keywords: {keyword: value}, other_names: {keyword: name in VTK} where they differ"""
    names = {}
    for keyword, value in keywords.items():
        name = (other_names or {}).get(keyword, _name_of(keyword))
        names[name] = keyword
        if value is not None:
            _property(type(algorithm), name)._replace(keyword=keyword).set(algorithm, value)
    return names


def execute(algorithm, surface, other_names=None, **keywords):
    """Executes a filter of ours on a surface, with these properties. Errors are raised, and warnings become those of
    who calls our caller."""
    if isinstance(surface, vtkCompositeDataSet):
        raise TypeError(f"this takes one surface; call it for each block of the {surface.GetClassName()}")
    if not isinstance(surface, vtkPolyData):
        raise TypeError(f"this takes a vtkPolyData, and not a {surface.GetClassName()}; take its surface first")
    names = set_all(algorithm, keywords, other_names)
    algorithm.SetController(None)  # with MPI, too, each process has a mesh of its own
    messages = Messages(algorithm)
    algorithm.SetInputData(surface)
    algorithm.Update()
    raise_errors(messages, names)
    messages.warn(stacklevel=4)


def raise_errors(messages, keywords=None):
    """An error of a property is a ValueError, as when Python finds it. keywords: {name in VTK: keyword}, by default
    those of vtkSphericalStyleFilter"""
    if keywords is None:
        keywords = {property_.name: keyword for keyword, property_ in properties().items()}
    for text in messages.errors:
        words = re.match(r"(\w+)( must be .*)", text)
        if words and words[1] in keywords:
            raise ValueError(keywords[words[1]] + words[2])
    messages.raise_errors(None if messages.errors else "The filter failed.")


def closest(word, names):
    """"; did you mean ...?" with the name that is closest to the word, or "" if none is close."""
    plain = {_plain(name): name for name in names}
    found = difflib.get_close_matches(_plain(word), plain, n=1, cutoff=0.6)
    return f"; did you mean '{plain[found[0]]}'?" if found else ""
