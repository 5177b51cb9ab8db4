"""The wrapped classes as the package has them."""

import re
from functools import wraps
from inspect import isroutine

from vtkmodules.vtkCommonCore import vtkObject

from .errors import raising
from .holders import unwrap


class _Class(type):
    """The class of these classes; objects that C++ makes are their instances, too."""

    def __instancecheck__(cls, it):
        is_derived = cls.__module__ != "gnomon"  # by a program
        return super().__instancecheck__(it) or not is_derived and isinstance(it, cls.__base__)


def subclass_of(kind, members):
    """Return a subclass of a wrapped class, with members of its own, whose methods raise errors.

    The first error that a method reports of its object and its arguments is a ValueError. Methods
    also take holders of VTK's objects. Those without arguments cannot fail, and those that VTK's
    own class has, too, are VTK's: they stay. Objects that C++ makes have the wrapped class.
    """
    lineage = [each for each in kind.__mro__ if each.__module__.startswith("gnomon.")]
    vtk_class = lineage[-1].__base__
    methods = {
        name: _raising(members.get(name, method))
        for each in reversed(lineage)
        for name, method in vars(each).items()
        if isroutine(method) and not hasattr(vtk_class, name) and _signatures_of(method)
    }
    own = {"__doc__": kind.__doc__, "__module__": "gnomon"}
    return _Class(kind.__name__, (kind,), {**members, **methods, **own})


def _raising(method):
    @wraps(method)
    def call(*given):
        given = [unwrap(it) for it in given]
        try:
            with raising(*(it for it in given if isinstance(it, vtkObject))):
                return method(*given)
        except (TypeError, OverflowError) as error:  # of VTK's wrappers, with an argument's number
            kind = TypeError if isinstance(error, TypeError) else ValueError
            raise kind(f"{error}: {_signatures_of(method)}") from None

    call.__qualname__ = method.__name__
    return call if f"{method.__name__}(self" in method.__doc__ else staticmethod(call)


def _signatures_of(method):
    """Return a wrapped method's signatures, with its arguments' names; empty without arguments."""
    found = re.findall(rf"^{method.__name__}\((.*?)\)\s*->", method.__doc__ or "", re.M | re.S)
    names = (", ".join(re.findall(r"(\w+):", arguments)) for arguments in found)
    return " or ".join(f"{method.__name__}({each})" for each in names if each)
