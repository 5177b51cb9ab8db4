"""VTK's errors and warnings, for exceptions and Python's warnings."""

import sys
import warnings
from contextlib import contextmanager

from vtkmodules.vtkCommonCore import vtkObject


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
    errors = []

    def take(_caller, _event, message):
        errors.append(_text_of(message))

    take.CallDataType = "string0"
    before = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOn()
    observers = [(caller, caller.AddObserver("ErrorEvent", take)) for caller in callers]
    try:
        yield errors
    finally:
        for caller, observer in observers:
            caller.RemoveObserver(observer)
        vtkObject.SetGlobalWarningDisplay(before)
    if errors:
        raise ValueError(errors[0])


def warn_of(caller):
    """Have Python warn of what a pass says of its frames."""

    def warn(_caller, _event, message):
        # The caller's line is one more frame away from add_shadows().
        is_inside = sys._getframe(1).f_globals.get("__package__") == __package__
        warnings.warn(_text_of(message), stacklevel=3 if is_inside else 2)

    warn.CallDataType = "string0"
    for event in ("ErrorEvent", "WarningEvent"):
        caller.AddObserver(event, warn)
