"""Shadows for VTK's renderers, from fast to exact.

>>> import gnomon
>>> shadows = gnomon.add_shadows(renderer)  # or a PyVista plotter
>>> window.Render()
>>> gnomon.report(shadows)["choice"]
'the picture rests: exact'

The classes are VTK's own wrappers of the C++ ones, whose docstrings they have:
vtkGnomonShadowPass, vtkGnomonShadowSettings, vtkGnomonLightKeys, vtkGnomonPropKeys,
vtkGnomonAreaLight, vtkGnomonLightPlacement, vtkGnomonLightSamplingPass, vtkGnomonEGLRenderWindow;
for shadow as data vtkGnomonVisibilityFilter and vtkGnomonSun.
"""

from __future__ import annotations

import json
import warnings
from typing import TYPE_CHECKING, Any

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401: the wrapped classes' superclasses
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer

from .GnomonLights import (
    vtkGnomonAreaLight,
    vtkGnomonLightKeys,
    vtkGnomonLightPlacement,
    vtkGnomonShadowSettings,
    vtkGnomonSun,
)
from .GnomonPlugin import (
    vtkGnomonEGLRenderWindow,
    vtkGnomonLightSamplingPass,
    vtkGnomonPropKeys,
    vtkGnomonShadowPass,
    vtkGnomonVisibilityFilter,
)
from .errors import raising, warn_of
from .holders import taking_holders, unwrap
from .images import assert_images_equal
from .why import reasons

if TYPE_CHECKING:
    from typing import Protocol

    import numpy

    from .data import (
        hours_lit as hours_lit,
        sky_view as sky_view,
        sun_path as sun_path,
    )
    from .figure import draw as draw

    class _HasRenderer(Protocol):
        """An object with a renderer, as a plotter of PyVista or vedo or a scene of Mayavi."""

        @property
        def renderer(self) -> vtkRenderer: ...

__all__ = [
    "add_shadows",
    "assert_images_equal",
    "draw",
    "hours_lit",
    "remove_shadows",
    "report",
    "sky_view",
    "sun_path",
    "visibility",
    "why",
    "vtkGnomonAreaLight",
    "vtkGnomonEGLRenderWindow",
    "vtkGnomonLightKeys",
    "vtkGnomonLightPlacement",
    "vtkGnomonLightSamplingPass",
    "vtkGnomonPropKeys",
    "vtkGnomonShadowPass",
    "vtkGnomonShadowSettings",
    "vtkGnomonSun",
    "vtkGnomonVisibilityFilter",
]

# State that remove_shadows() restores, by the renderer's address: Python's wrapper of a renderer
# goes when nothing in Python names it, and the renderer stays. Entries go with the renderers.
_before: dict[str, Any] = {}

if not TYPE_CHECKING:  # for which every name would exist, and classes made by a call would not
    vtkGnomonLightKeys = taking_holders(vtkGnomonLightKeys)
    vtkGnomonLightPlacement = taking_holders(vtkGnomonLightPlacement)
    vtkGnomonPropKeys = taking_holders(vtkGnomonPropKeys)

    def __getattr__(name):
        # These need NumPy, which the rest can do without.
        if name in ("draw", "hours_lit", "sky_view", "sun_path"):
            from . import data, figure

            return getattr(figure if name == "draw" else data, name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def add_shadows(
    target: vtkRenderer | _HasRenderer,
    technique: str | None = None,
    **settings: str | float | bool,
) -> vtkGnomonShadowPass:
    """Have a renderer show shadows.

    Parameters
    ----------
    target : vtkRenderer or what has one
        A plotter of PyVista or vedo (its active subplot), a figure or scene of Mayavi, tvtk's.
    technique : str, optional
        A name of vtkGnomonShadowPass.GetTechniqueName(), or "auto", the default.
    **settings
        What lights fall back on: any setting of vtkGnomonLightKeys, as `light_radius=0.5`.

    Returns
    -------
    vtkGnomonShadowPass
        The renderer's pass from now on.

    Notes
    -----
    A headlight that is the only light shows no shadow. A key light beside the camera takes its
    place, and a warning says so; it stays where it is when the camera moves. In a renderer that
    shows nothing yet, it is placed when the first picture is drawn. `remove_shadows` takes all of
    that back.

    The renderer's own pass gives way, too. A warning names it and its delegates.

    Raises
    ------
    TypeError
        For a target that is no renderer, and has none.
    ValueError
        For a setting that does not exist, or a value that it does not take. Nothing changes then.
    """
    renderer = _renderer_of(target)
    shadows = vtkGnomonShadowPass()
    if technique is not None:
        _set(shadows, "technique", technique)
    for name, value in settings.items():
        _set(shadows, name, value)
    remove_shadows(renderer)
    address = _address_of(renderer)
    replaced = renderer.GetPass()
    if replaced is not None:
        chain = _name_chain(replaced)
        warnings.warn(f"The renderer's pass gave way to shadows: {chain}.", stacklevel=2)
        if renderer.GetRenderWindow() is not None:  # it may never draw again
            replaced.ReleaseGraphicsResources(renderer.GetRenderWindow())
    observers = [renderer.AddObserver("DeleteEvent", lambda *_: _before.pop(address, None))]
    _before[address] = (shadows, replaced, _replace_headlight(renderer, observers), observers)
    warn_of(shadows)
    renderer.SetPass(shadows)
    return shadows


def remove_shadows(target: vtkRenderer | _HasRenderer) -> None:
    """Give a renderer back the pass and the lights that it had before `add_shadows`.

    A headlight comes back if no light but the key light in its place gives light.

    Parameters
    ----------
    target : vtkRenderer or what has one
        As for `add_shadows`. A renderer without shadows stays as it is, and so does a pass that was
        set since.

    Raises
    ------
    TypeError
        For a target that is no renderer, and has none.
    """
    renderer = _renderer_of(target)
    if _address_of(renderer) not in _before:
        return
    shadows, render_pass, lights, observers = _before.pop(_address_of(renderer))
    for observer in observers:
        renderer.RemoveObserver(observer)
    if renderer.GetPass() is shadows:
        renderer.SetPass(render_pass)
    if lights is not None:
        key, headlight, creates = lights
        present = _lights_of(renderer)
        renderer.RemoveLight(key)
        is_alone = key in present and not any(map(_gives_light, _lights_of(renderer)))
        if headlight is not None and is_alone:
            renderer.AddLight(headlight)
        renderer.SetAutomaticLightCreation(creates or renderer.GetAutomaticLightCreation())


def report(shadows: vtkGnomonShadowPass) -> dict[str, Any]:
    """Return what the last frame of a pass did.

    Parameters
    ----------
    shadows : vtkGnomonShadowPass
        As `add_shadows` returns it.

    Returns
    -------
    dict
        The JSON of vtkGnomonShadowPass.GetReportText(): "lights", a list with a dict for each
        light, "route", "choice", "stages" and so on.
    """
    return json.loads(shadows.GetReportText())


def visibility(shadows: vtkGnomonShadowPass) -> dict[str, numpy.ndarray]:
    """Return the visibility of the last frame, drawn while `shadows.KeepVisibilityOn()`.

    Parameters
    ----------
    shadows : vtkGnomonShadowPass
        As `add_shadows` returns it.

    Returns
    -------
    dict of str to numpy.ndarray
        Arrays of height x width (x 3), row 0 at the bottom: "light N" for each light that casts, by
        its number in the renderer, 1 lit, 0 in shadow; "position" in world coordinates; "normal";
        "coverage", 1 where a surface was drawn; "prop", the surface's prop by its number in
        renderer.GetViewProps(), -1 for nothing; "cell", by its number in the mapper's input where
        that is a polydata, else -1. They are the caller's own: later frames do not
        write into them. Empty where nothing was kept.
    """
    from vtkmodules.util.numpy_support import vtk_to_numpy

    image = vtkImageData()
    shadows.GetVisibilityImage(image)
    width, height, _ = image.GetDimensions()
    data = image.GetPointData()
    arrays = {}
    for i in range(data.GetNumberOfArrays()):
        array = vtk_to_numpy(data.GetArray(i))
        arrays[data.GetArrayName(i)] = array.reshape((height, width) + array.shape[1:])
    return arrays


def why(target: vtkRenderer | _HasRenderer) -> None:
    """Print why a renderer shows no shadow, or not all: what its last frame reports.

    Parameters
    ----------
    target : vtkRenderer or what has one
        As for `add_shadows`.

    Raises
    ------
    TypeError
        For a target that is no renderer, and has none.
    """
    renderer = _renderer_of(target)
    shadows = _before.get(_address_of(renderer), [None])[0]
    if isinstance(renderer.GetPass(), vtkGnomonShadowPass):
        shadows = renderer.GetPass()
    told = reasons(renderer, shadows and report(shadows), _name_chain)
    print("\n".join(told))


def _renderer_of(target):
    renderer = unwrap(target)
    if not isinstance(renderer, vtkRenderer):
        raise TypeError(
            "expected a vtkRenderer or an object that has one as `renderer`, `scene` or `_vtk_obj`,"
            f" found {type(target).__name__}"
        )
    return renderer


def _name_chain(render_pass):
    names = []
    while render_pass is not None:
        names.append(render_pass.GetClassName())
        render_pass = getattr(render_pass, "GetDelegatePass", lambda: None)()
    return " around ".join(names)


def _set(shadows, name, value):
    is_switch = type(value).__name__ in ("bool", "bool_")  # NumPy's, too
    text = ("on" if value else "off") if is_switch else str(value)
    with raising(shadows):
        shadows.SetSetting(name, text)


def _address_of(renderer):
    return renderer.GetAddressAsString("vtkRenderer")


def _lights_of(renderer):
    lights = renderer.GetLights()
    return [lights.GetItemAsObject(i) for i in range(lights.GetNumberOfItems())]


def _gives_light(light):
    return light.GetSwitch() and light.GetIntensity() != 0 and any(light.GetDiffuseColor())


def _replace_headlight(renderer, observers):
    """Exchange a lone headlight for a key light.

    Returns the key light, the headlight (None where there was none yet), and whether the renderer
    creates lights; None if nothing is exchanged.
    """
    all_lights = _lights_of(renderer)
    lit = [light for light in all_lights if _gives_light(light)]
    creates = renderer.GetAutomaticLightCreation()
    casts = vtkGnomonLightKeys.CASTS()
    if len(lit) > 1 or (all_lights and not lit) or (not all_lights and not creates):
        return None
    if lit and (
        not vtkGnomonLightPlacement.IsHeadlight(lit[0]) or lit[0].GetInformation().Has(casts)
    ):
        return None
    warnings.warn(
        "The only light was a headlight, which shows no shadow: a key light took its place.",
        stacklevel=3,
    )
    headlight = lit[0] if lit else None
    if headlight is not None:
        renderer.RemoveLight(headlight)
    key = vtkLight()
    renderer.AddLight(key)
    renderer.AutomaticLightCreationOff()
    if not _place(key, renderer):

        def place_later(caller, _event):
            if _place(key, caller):
                caller.RemoveObserver(observer)

        observer = renderer.AddObserver("StartEvent", place_later)
        observers.append(observer)
    return key, headlight, creates


def _place(key, renderer):
    """Place a key light for what is visible; False if nothing is, or a single point."""
    bounds = renderer.ComputeVisiblePropBounds()
    if not any(bounds[axis] < bounds[axis + 1] for axis in (0, 2, 4)):
        return False
    if not renderer.IsActiveCameraCreated():
        renderer.ResetCamera()
    vtkGnomonLightPlacement.MakeKeyLight(key, renderer.GetActiveCamera(), bounds)
    return True
