"""The library's techniques and settings, as dicts."""

from __future__ import annotations

import json
import math
from typing import Any, Literal

from .GnomonPlugin import vtkGnomonShadowPass

# The names of techniques(), for type checkers, which cannot call it.
Technique = Literal[
    "auto", "nsm", "pcf", "pcss", "esm", "vsm", "evsm", "msm", "adaptive", "lispsm", "tsm",
    "pssm", "planar", "sampled", "montecarlo", "coherence", "selective", "crsm", "crsma",
    "silhouette", "penumbra", "raytraced",
]  # fmt: skip


def techniques() -> dict[Technique, str]:
    """Return what each technique is, in a line, by its name.

    Returns
    -------
    dict of str to str
        Of each value of `technique`, for `add_shadows` and the attribute of its pass.
    """
    count = vtkGnomonShadowPass.GetNumberOfTechniques()
    names: list[Any] = [vtkGnomonShadowPass.GetTechniqueName(i) for i in range(count)]
    return {name: vtkGnomonShadowPass.GetTechniqueSummary(name) for name in ["auto", *names]}


def settings() -> dict[str, dict[str, Any]]:
    """Return all settings of lights' shadows, by name.

    Returns
    -------
    dict of str to dict
        Of each keyword that `add_shadows` takes for lights, and of each such attribute of its pass:
        "type" ("bool", "int", "float" or "choice"); "range" (the choices, or the least and the
        most); "unit", empty without one; "default"; "meaning", in a line; "techniques", the names
        of those that have the setting.
    """
    found = json.loads(vtkGnomonShadowPass.GetSettingsText())
    for setting in found.values():
        domain = setting["range"]
        if domain == ["off", "on"]:
            setting["type"] = "bool"
        setting["type"] = {"integer": "int", "real": "float"}.get(setting["type"], setting["type"])
        if setting["type"] in ("int", "float"):
            setting["range"] = tuple(math.inf if end is None else end for end in domain)
        else:
            setting["range"] = tuple(value_of(setting["type"], choice) for choice in domain)
        setting["default"] = value_of(setting["type"], setting["default"])
        setting["techniques"] = tuple(setting["techniques"])
    return found


def value_of(kind: str, text: str) -> bool | int | float | str:
    """Return the value that a setting's text stands for; choices may be numbers."""
    if kind == "bool":
        return text == "on"
    if kind == "float":
        return float(text)
    return int(text) if kind == "int" or text.isdigit() else text
