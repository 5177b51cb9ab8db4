"""VTK's errors and warnings, for exceptions and Python's warnings."""

import sys
import threading
import warnings
from contextlib import contextmanager

from vtkmodules.vtkCommonCore import vtkObject

# The callers within raising(), of all threads, and VTK's switch of warnings before the first.
_watched: list[tuple[vtkObject, ...]] = []
_before = True
_lock = threading.Lock()


def _text_of(message):
    return message.split("): ", 1)[-1].strip()


@contextmanager
def naming(argument):
    """Begin the messages of exceptions with the name of the argument that is wrong."""
    try:
        yield
    except OverflowError as error:
        raise ValueError(f"{argument}: {error}") from None
    except (TypeError, ValueError, AssertionError) as error:
        error.args = (f"{argument}: {error}",)
        raise


@contextmanager
def raising(*callers):
    """Raise the first error that VTK objects report; gives a list of the errors.

    Many programs switch VTK's warnings off for the whole process, and VTK then reports nothing:
    here they are on.
    """
    global _before
    errors = []

    def take(_caller, _event, message):
        errors.append(_text_of(message))

    take.CallDataType = "string0"
    with _lock:
        if not _watched:
            _before = vtkObject.GetGlobalWarningDisplay()
            vtkObject.GlobalWarningDisplayOn()
        _watched.append(callers)
    observers = [(caller, caller.AddObserver("ErrorEvent", take)) for caller in callers]
    try:
        yield errors
    finally:
        for caller, observer in observers:
            caller.RemoveObserver(observer)
        with _lock:
            _watched.remove(callers)
            if not _watched:
                vtkObject.SetGlobalWarningDisplay(_before)
    if errors:
        raise ValueError(errors[0])


def warn_of(caller):
    """Have Python warn of what a pass says of its frames; calls of its methods raise it."""

    def warn(teller, event, message):
        if event == "ErrorEvent" and any(teller in callers for callers in _watched):
            return
        level, frame = 2, sys._getframe(1)  # the first one outside of the package
        while frame.f_back and frame.f_globals.get("__package__") == __package__:
            level, frame = level + 1, frame.f_back
        warnings.warn(_text_of(message), stacklevel=level)

    warn.CallDataType = "string0"
    for event in ("ErrorEvent", "WarningEvent"):
        caller.AddObserver(event, warn)
