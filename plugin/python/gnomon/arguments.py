"""Checks of arguments, whose exceptions name the argument and say what it should be."""

from __future__ import annotations

import math
import operator
import os

from .errors import naming


def number(name, value, least=-math.inf, most=math.inf, kind=float):
    """Return a finite number in [least, most], as a float or an int."""
    expected = {float: "a number", int: "an integer"}[kind]
    if math.isfinite(least) or math.isfinite(most):
        expected += f" in [{least}, {most}]"
    wrong = f"{name}: found {value!r}, expected {expected}"
    try:
        if isinstance(value, (str, bytes)):  # of which float() would take some
            raise TypeError
        converted = operator.index(value) if kind is int else float(value)
        is_finite = math.isfinite(converted)
    except (TypeError, ValueError):
        raise TypeError(wrong) from None
    except OverflowError:
        raise ValueError(wrong) from None
    if not (is_finite and least <= converted <= most):
        raise ValueError(wrong)
    return converted


def switch(name, value):
    """Return a truth value, of Python or NumPy, or the integer of one."""
    is_integer = type(value) is int and value in (0, 1)
    if not is_integer and type(value).__name__ not in ("bool", "bool_"):
        raise TypeError(f"{name}: found {value!r}, expected True or False")
    return bool(value)


def choice(name, value, choices):
    """Return one of some strings."""
    wrong = f"{name}: found {value!r}, expected {' or '.join(map(repr, choices))}"
    if not isinstance(value, str):
        raise TypeError(wrong)
    if value not in choices:
        raise ValueError(wrong)
    return value


def array(name, values, shape, kind=float):
    """Return finite numbers as a contiguous array; None in `shape` stands for any length."""
    import numpy

    with naming(name):
        found = numpy.asarray(values)
        fits = found.ndim == len(shape) and all(
            wanted in (None, length) for wanted, length in zip(shape, found.shape)
        )
        if not fits:
            wanted = " x ".join("n" if side is None else str(side) for side in shape)
            raise ValueError(f"expected an array of {wanted} numbers, found {found.shape}")
        if found.size and found.dtype.kind not in ("iuf" if kind is float else "iu"):
            expected = "numbers" if kind is float else "integers"
            raise TypeError(f"expected {expected}, found an array of {found.dtype}")
        if not numpy.isfinite(found).all():
            raise ValueError("expected finite numbers, found NaN or infinity")
        return numpy.ascontiguousarray(found, dtype=kind)


def path_of(name, path, ending="", needs_folder=True):
    """Return a path as a string, with a name's ending and in a folder that exists."""
    try:
        text = os.fsdecode(path)
    except TypeError:
        raise TypeError(f"{name}: found {type(path).__name__}, expected a path") from None
    if not text or not text.lower().endswith(ending) or os.path.isdir(text):
        raise ValueError(f"{name}: found {text!r}, expected the path of a {ending} file")
    folder = os.path.dirname(os.path.abspath(text))
    if needs_folder and not os.path.isdir(folder):
        raise ValueError(f"{name}: there is no folder {folder!r}, make it first")
    return text
