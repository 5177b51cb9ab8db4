"""Attributes in snake_case, beside VTK's getters and setters."""

from __future__ import annotations

import difflib
import os.path
import re
from functools import wraps

from .arguments import choice, number, switch
from .catalogue import settings, value_of
from .errors import naming, raising

_READ_ONLY = ("Progress",)


class Attribute(property):
    """An attribute of a wrapped class.

    Parameters
    ----------
    type_name : str, optional
        What type checkers take; that of the getter, which the text names, by default.
    """

    def __init__(self, read, write, text, type_name=None):
        super().__init__(read, write)
        self.__doc__ = text  # or else it is this class's own
        self.type_name = type_name


def attributes_of(kind):
    """Return the members of the shadow pass in Python: an attribute for each number and setting.

    Each pair of a setter and a getter is one, and each setting of lights that name none. They
    refuse wrong values by a ValueError or TypeError, and other names by an AttributeError.
    """
    names = [name[3:] for name in vars(kind) if name.startswith("Set") and name != "SetSetting"]
    members = {
        _snake_case(name): _of_accessors(kind, name)
        for name in names + list(_READ_ONLY)
        if hasattr(kind, "Get" + name)
    }
    members |= {name: _of_setting(kind, name, it) for name, it in settings().items()}

    def set_known(self, name, value):
        if not hasattr(type(self), name):
            raise AttributeError(no_such(name, members))
        kind.__setattr__(self, name, value)

    @wraps(kind.SetSettings)
    def set_settings(self, settings):
        from . import vtkGnomonShadowSettings  # those that C++ makes do not raise what they report

        kind.SetSettings(self, settings or vtkGnomonShadowSettings())

    def start(self, **values):  # which newer VTK takes
        set_settings(self, None)
        kind.__init__(self, **values)

    own = {"__init__": start, "__setattr__": set_known, "SetSettings": set_settings}
    return {**members, **own}


def no_such(name, names):
    """Return the message of a name that is none, with the nearest one."""
    near = difflib.get_close_matches(name, names, 1)
    return f"there is no setting {name!r}" + (f", is it {near[0]!r}?" if near else "")


def _of_accessors(kind, name):
    attribute = _snake_case(name)
    getter, setter = getattr(kind, "Get" + name), getattr(kind, "Set" + name, None)
    choices = _choices_of(kind, name)
    signature, _, text = getter.__doc__.partition("\n\n")
    type_name = re.search(r"-> (.+)", signature)[1]

    def read(shadows):
        value = getter(shadows)
        return choices[value] if choices else value

    def write(shadows, value):
        if type_name == "bool":
            value = switch(attribute, value)  # VTK takes the truth of anything
        if choices and isinstance(value, str):
            value = choices.index(choice(attribute, value, choices))
        elif choices:
            value = number(attribute, value, 0, len(choices) - 1, int)
        with naming(attribute), raising(shadows):
            _call(setter, shadows, value, type_name)

    text = f"{getter.__name__}(){f', {setter.__name__}()' if setter else ''}\n\n{text.strip()}"
    return Attribute(
        read, write if setter else None, text, f"Literal{list(choices)}" if choices else None
    )


def _of_setting(kind, name, setting):
    choices = setting["range"]
    type_name = setting["type"] if setting["type"] != "choice" else f"Literal{list(choices)}"

    def read(shadows):
        text = kind.GetSetting(shadows, name)
        return value_of(setting["type"], text) if text else setting["default"]

    def write(shadows, value):
        if setting["type"] == "bool" and not isinstance(value, str):
            value = "on" if switch(name, value) else "off"
        with naming(name), raising(shadows):
            kind.SetSetting(shadows, name, str(value))

    domain = (
        "one of " + ", ".join(map(repr, choices))
        if setting["type"] in ("choice", "bool")
        else f"in [{choices[0]}, {choices[1]}]"
    )
    text = f"A setting of lights: {setting['meaning']}; {setting['unit']} {domain}."
    return Attribute(read, write, text.replace("  ", " "), type_name)


def _call(setter, shadows, value, type_name):
    try:
        setter(shadows, value)
    except (TypeError, OverflowError) as error:
        raise type(error)(f"found {value!r}, expected {type_name}") from None


def _choices_of(kind, name):
    """Return the names of an enumeration's values, in their order; none of another type."""
    of = getattr(kind, name + "Type", None)
    values = {key: value for key, value in vars(kind).items() if of and type(value) is of}
    prefix = os.path.commonprefix(list(values)).rpartition("_")[0] + "_"
    return [key[len(prefix) :].lower() for key, _ in sorted(values.items(), key=lambda it: it[1])]


def _snake_case(name):
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()
