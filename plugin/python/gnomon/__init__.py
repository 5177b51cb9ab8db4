"""Shadows for VTK's renderers, from fast to exact.

>>> import gnomon
>>> shadows = gnomon.add_shadows(renderer)  # or a PyVista plotter
>>> window.Render()
>>> gnomon.report(shadows)["choice"]
'the picture rests: exact'

The classes are VTK's own wrappers of the C++ ones, whose docstrings they have:
vtkGnomonShadowPass, vtkGnomonShadowSettings, vtkGnomonLightKeys, vtkGnomonPropKeys,
vtkGnomonAreaLight, vtkGnomonLightPlacement, vtkGnomonFlatteringLights, vtkGnomonLightSamplingPass,
vtkGnomonEGLRenderWindow;
for shadow as data vtkGnomonVisibilityFilter and vtkGnomonSun.
"""

from __future__ import annotations

import json
import warnings
from typing import TYPE_CHECKING, Any

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401: the wrapped classes' superclasses
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkRenderer

from .GnomonLights import (
    vtkGnomonAreaLight,
    vtkGnomonLightKeys,
    vtkGnomonLightPlacement,
    vtkGnomonShadowSettings,
    vtkGnomonSun,
)
from .GnomonPlugin import (
    vtkGnomonEGLRenderWindow,
    vtkGnomonFlatteringLights,
    vtkGnomonLightSamplingPass,
    vtkGnomonPropKeys,
    vtkGnomonShadowPass,
    vtkGnomonVisibilityFilter,
)
from .errors import raising, warn_of
from .holders import taking_holders, unwrap
from .images import assert_images_equal
from .lighting import replace_default_lights
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
    "vtkGnomonFlatteringLights",
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
    light: str | None = "auto",
    sky: float = 0.0,
    **settings: str | float | bool,
) -> vtkGnomonShadowPass:
    """Have a renderer show shadows.

    Parameters
    ----------
    target : vtkRenderer or what has one
        A plotter of PyVista or vedo (its active subplot), a figure or scene of Mayavi, tvtk's.
    technique : str, optional
        A name of vtkGnomonShadowPass.GetTechniqueName(), or "auto", the default.
    light : str, optional
        "auto", the default, exchanges default lights; None leaves all lights as they are.
    sky : float, optional
        vtkGnomonShadowPass.SetSkyIntensity(): 0.4 brightens what is in shadow, but for corners.
    **settings
        What lights fall back on: any setting of vtkGnomonLightKeys, as `light_radius=0.5`.

    Returns
    -------
    vtkGnomonShadowPass
        The renderer's pass from now on.

    Notes
    -----
    Default lights are VTK's headlight, if no other light shines, and an untouched vtkLightKit, as
    PyVista's. They show no shadow, or too many. A key light and a fill light
    (vtkGnomonFlatteringLights) take their place, and a warning says so. They are placed for the
    first picture, and stay where they are when the camera moves. `remove_shadows` takes all of that
    back.

    The renderer's own pass gives way, too. A warning names it and its delegates.

    Raises
    ------
    TypeError
        For a target that is no renderer, and has none.
    ValueError
        For a setting that does not exist, or a value that it does not take. Nothing changes then.
    """
    renderer = _renderer_of(target)
    if light not in ("auto", None):
        raise ValueError(f"light: found {light!r}, expected 'auto' or None")
    shadows = vtkGnomonShadowPass()
    if technique is not None:
        _set(shadows, "technique", technique)
    for name, value in settings.items():
        _set(shadows, name, value)
    with raising(shadows):
        shadows.SetSkyIntensity(sky)
    remove_shadows(renderer)
    address = _address_of(renderer)
    replaced = renderer.GetPass()
    if replaced is not None:
        chain = _name_chain(replaced)
        warnings.warn(f"The renderer's pass gave way to shadows: {chain}.", stacklevel=2)
        if renderer.GetRenderWindow() is not None:  # it may never draw again
            replaced.ReleaseGraphicsResources(renderer.GetRenderWindow())
    observers = [renderer.AddObserver("DeleteEvent", lambda *_: _before.pop(address, None))]
    lights = replace_default_lights(renderer) if light == "auto" else None
    _before[address] = (shadows, replaced, lights, observers)
    warn_of(shadows)
    renderer.SetPass(shadows)
    return shadows


def remove_shadows(target: vtkRenderer | _HasRenderer) -> None:
    """Give a renderer back the pass and the lights that it had before `add_shadows`.

    Default lights come back if none but the lights in their place gives light.

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
    for observer in observers + (lights.observers if lights else []):
        renderer.RemoveObserver(observer)
    if renderer.GetPass() is shadows:
        renderer.SetPass(render_pass)
    if lights:
        lights.give_back(renderer)


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
