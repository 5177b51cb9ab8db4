"""Shadows for VTK's renderers, from fast to exact.

    import gnomon
    import pyvista

    plotter = pyvista.Plotter()
    plotter.add_mesh(pyvista.Plane(i_size=6, j_size=6), color="white")
    plotter.add_mesh(pyvista.Sphere(center=(0, 0, 1)), color="white")
    shadows = gnomon.add_shadows(plotter)
    shadows.light_radius = 0.5
    plotter.show()
    print(gnomon.report(plotter)["choice"])

add_shadows(plotter)     has a plotter or a vtkRenderer show shadows
remove_shadows(plotter)  takes them back
report(plotter)          what the last picture did
visibility(plotter)      its light and shadow as arrays
why(plotter)             prints why it lacks shadows

settings() and techniques() list what the attributes of `shadows` and the keywords of add_shadows
take. Without a renderer, hours_lit, sky_view, sun_path and draw take meshes.

The classes, each with its help(), wrap the C++ ones and raise their errors: vtkGnomonAreaLight,
vtkGnomonEGLRenderWindow, vtkGnomonFlatteringLights, vtkGnomonLightKeys, vtkGnomonLightPlacement,
vtkGnomonLightSamplingPass, vtkGnomonPropKeys, vtkGnomonShadowPass, vtkGnomonShadowSettings,
vtkGnomonSun, vtkGnomonVisibilityFilter.
"""

from __future__ import annotations

import contextlib
import json
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401: the wrapped classes' superclasses
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkRenderer

from ._version import __version__ as __version__
from .arguments import choice
from .attributes import Attribute, attributes_of, no_such
from .catalogue import Technique, settings, techniques
from .classes import subclass_of
from .errors import naming, warn_of
from .GnomonLights import (
    vtkGnomonAreaLight as vtkGnomonAreaLight,
    vtkGnomonLightKeys as vtkGnomonLightKeys,
    vtkGnomonLightPlacement as vtkGnomonLightPlacement,
    vtkGnomonShadowSettings as vtkGnomonShadowSettings,
    vtkGnomonSun as vtkGnomonSun,
)
from .GnomonPlugin import *  # noqa: F403: vtkGnomonEGLRenderWindow is absent without EGL
from .holders import unwrap
from .images import assert_images_equal, png_of
from .lighting import replace_default_lights, replace_lights
from .why import reasons

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Protocol

    import numpy

    from .data import (
        hours_lit as hours_lit,
        sky_patches as sky_patches,
        sky_view as sky_view,
        sun_path as sun_path,
    )
    from .figure import draw as draw

    class _HasRenderer(Protocol):
        """An object with a renderer, as a plotter of PyVista or vedo or a scene of Mayavi."""

        @property
        def renderer(self) -> vtkRenderer: ...

# The classes are left out, whose text help() would repeat with all that they inherit.
__all__ = [
    "add_shadows",
    "assert_images_equal",
    "draw",
    "hours_lit",
    "remove_shadows",
    "report",
    "settings",
    "shadows",
    "sky_patches",
    "sky_view",
    "sun_path",
    "techniques",
    "visibility",
    "why",
]

# State that remove_shadows() restores, by the renderer's address: Python's wrapper of a renderer
# goes when nothing in Python names it, and the renderer stays. Entries go with the renderers.
_before: dict[str, Any] = {}

if not TYPE_CHECKING:  # for which every name would exist, and classes made by a call would not
    _more = {
        "vtkGnomonEGLRenderWindow": {"_repr_png_": png_of},  # for notebooks
        "vtkGnomonShadowPass": attributes_of(vtkGnomonShadowPass),
    }
    for _name in [name for name in globals() if name.startswith("vtkGnomon")]:
        globals()[_name] = subclass_of(globals()[_name], _more.get(_name, {}))

    def __getattr__(name):
        # These need NumPy, which the rest can do without.
        if name in ("draw", "hours_lit", "sky_patches", "sky_view", "sun_path"):
            from . import data, figure

            return getattr(figure if name == "draw" else data, name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

    def __dir__():
        return [*__all__, "__version__", *(name for name in globals() if name[:9] == "vtkGnomon")]


def add_shadows(
    target: vtkRenderer | _HasRenderer,
    technique: Technique | None = None,
    light: Literal["auto", "key+fill"] | None = "auto",
    sky: float = 0.0,
    glass: bool = False,
    volumes: bool = False,
    keep_visibility: bool = False,
    casting: Literal["auto", "all", "brightest"] = "auto",
    **settings: str | float | bool,
) -> vtkGnomonShadowPass:
    """Have a renderer show shadows.

    Parameters
    ----------
    target : vtkRenderer or what has one
        A plotter of PyVista or vedo (its active subplot), a figure or scene of Mayavi, tvtk's.
    technique : str, optional
        A name of `techniques`; "auto", the default, is exact while the picture rests.
    light : str, optional
        "auto", the default, exchanges default lights for a key light and a fill light; "key+fill"
        exchanges all lights; None leaves all as they are.
    sky : float, optional
        Intensity of a sky: 0.4 brightens what is in shadow, but for corners.
    glass : bool, optional
        True has translucent props cast: vtkGnomonShadowPass.SetTranslucentCasters().
    volumes : bool, optional
        True has volumes cast: vtkGnomonShadowPass.SetVolumeCasters().
    keep_visibility : bool, optional
        True to keep the data that `visibility` returns.
    casting : str, optional
        Lights that cast: "auto", those of the scene, and the brightest of those that follow the
        camera; "all"; "brightest".
    **settings
        What lights fall back on, by the names of `settings`, as `light_radius=0.5`; and any other
        attribute of the pass.

    Returns
    -------
    vtkGnomonShadowPass
        The renderer's pass from now on. All settings are its attributes: `shadows.light_radius`.

    Notes
    -----
    Default lights are VTK's headlight, if no other light shines, and an untouched vtkLightKit, as
    PyVista's. They show no shadow, or too many. A key light and a fill light
    (vtkGnomonFlatteringLights) take their place, and a warning says so. They are placed for the
    first picture, and stay where they are when the camera moves. `remove_shadows` takes all of that
    back.

    The renderer's passes stay: those that work on the finished picture, as vtkSSAAPass, around the
    shadows, those that draw, as vtkSSAOPass, within. VTK's own shadows give way with a warning.
    Shadows also outlive `enable_ssao` and the like of PyVista.

    Raises
    ------
    TypeError
        For a target that is no renderer, and has none, and values of a wrong type.
    ValueError
        For a setting that does not exist, or a value that it does not take. Nothing changes then.
    """
    renderer = _renderer_of(target)
    if light is not None:
        choice("light", light, ("auto", "key+fill"))
    shadows = vtkGnomonShadowPass()
    if technique is not None:
        shadows.technique = technique
    with naming("sky"):
        shadows.sky_intensity = sky
    with naming("glass"):
        shadows.translucent_casters = glass
    with naming("volumes"):
        shadows.volume_casters = volumes
    shadows.keep_visibility = keep_visibility
    shadows.casting = casting
    for name, value in settings.items():
        _set(shadows, name, value)
    remove_shadows(renderer)
    address = _address_of(renderer)
    observers = [renderer.AddObserver("DeleteEvent", lambda *_: _before.pop(address, None))]
    lights = None
    if light is not None:
        lights = (replace_default_lights if light == "auto" else replace_lights)(renderer)
    _before[address] = (shadows, lights, observers)
    warn_of(shadows)
    shadows.Install(renderer)
    if hasattr(renderer, "_render_passes"):  # PyVista's, which makes its chain of passes by itself
        observers.append(renderer.AddObserver("ModifiedEvent", partial(_install, shadows)))
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
    shadows, lights, observers = _before.pop(_address_of(renderer))
    for observer in observers + (lights.observers if lights else []):
        renderer.RemoveObserver(observer)
    shadows.Uninstall(renderer)
    if lights:
        lights.give_back(renderer)


@contextlib.contextmanager
def shadows(
    target: vtkRenderer | _HasRenderer,
    technique: Technique | None = None,
    light: Literal["auto", "key+fill"] | None = "auto",
    **settings: Any,
) -> Iterator[vtkGnomonShadowPass]:
    """Have a renderer show shadows within a `with` statement.

    Afterwards it has the pass and the lights that it had before, other shadows included.

    Parameters
    ----------
    target : vtkRenderer or what has one
        As for `add_shadows`.
    technique : str, optional
        As for `add_shadows`.
    light : str, optional
        As for `add_shadows`.
    **settings
        The other keywords of `add_shadows`.

    Returns
    -------
    vtkGnomonShadowPass
        The renderer's pass within the statement.

    Raises
    ------
    TypeError, ValueError
        As `add_shadows`.
    """
    renderer = _renderer_of(target)
    former = _before.pop(_address_of(renderer), None)  # which add_shadows() would remove
    try:
        yield add_shadows(renderer, technique, light, **settings)
    finally:
        remove_shadows(renderer)
        if former:
            _before[_address_of(renderer)] = former


def report(shadows: vtkGnomonShadowPass | vtkRenderer | _HasRenderer) -> dict[str, Any]:
    """Return what the last frame of a pass did.

    Parameters
    ----------
    shadows : vtkGnomonShadowPass, vtkRenderer or what has one
        As `add_shadows` returns it, or as it takes it.

    Returns
    -------
    dict
        The JSON of vtkGnomonShadowPass.GetReportText(): "lights", a list with a dict for each
        light, "route", "choice", "stages" and so on.

    Raises
    ------
    TypeError
        For an object that is no pass or renderer, and has none.
    ValueError
        For a renderer without shadows.
    """
    return json.loads(_shadows_of(shadows).GetReportText())


def visibility(
    shadows: vtkGnomonShadowPass | vtkRenderer | _HasRenderer,
    origin: Literal["lower", "upper"] = "lower",
    fill: float | None = None,
) -> dict[str, numpy.ndarray]:
    """Return the visibility of the last frame, drawn while `shadows.keep_visibility` was True.

    Parameters
    ----------
    shadows : vtkGnomonShadowPass, vtkRenderer or what has one
        As `add_shadows` returns it, or as it takes it.
    origin : str
        Where row 0 is, as for matplotlib's `imshow`: "lower", the default, is the picture's bottom,
        "upper" its top.
    fill : float, optional
        What floats have where no surface was drawn, `numpy.nan` say. Without it they mean nothing
        there.

    Returns
    -------
    dict of str to numpy.ndarray
        Arrays of height x width (x 3): "light N" for each light that casts, by its number in the
        renderer, 1 lit, 0 in shadow; "position" in world coordinates; "normal"; "coverage", 1 where
        a surface was drawn; "prop", the surface's prop by its number in renderer.GetViewProps(), -1
        for nothing; "cell", by its number in the mapper's input where that is a polydata, else -1.
        They are the caller's own: later frames do not write into them. Empty where nothing was
        kept.

    Raises
    ------
    TypeError
        For an object that is no pass or renderer, and has none.
    ValueError
        For a renderer without shadows, and another origin.
    """
    from vtkmodules.util.numpy_support import vtk_to_numpy

    choice("origin", origin, ("lower", "upper"))
    if fill is not None:
        with naming("fill"):
            fill = float(fill)
    image = vtkImageData()
    _shadows_of(shadows).GetVisibilityImage(image)
    width, height, _ = image.GetDimensions()
    data = image.GetPointData()
    arrays = {}
    for i in range(data.GetNumberOfArrays()):
        array = vtk_to_numpy(data.GetArray(i))
        rows = array.reshape((height, width) + array.shape[1:])
        arrays[data.GetArrayName(i)] = rows[::-1] if origin == "upper" else rows
    if fill is not None and arrays:
        is_empty = arrays["coverage"] == 0
        for name, array in arrays.items():
            if name != "coverage" and array.dtype.kind == "f":
                array[is_empty] = fill
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
    found = _find_shadows(renderer)
    told = reasons(_chain_of(renderer), found and report(found))
    print("\n".join(told))


def _renderer_of(target):
    renderer = unwrap(target)
    if not isinstance(renderer, vtkRenderer):
        raise TypeError(
            "target: expected a vtkRenderer or an object that has one as `renderer`, `scene` or"
            f" `_vtk_obj`, found {type(target).__name__}"
        )
    return renderer


def _find_shadows(renderer):
    """Return the pass of a renderer's shadows, also of one that was replaced since; or None."""
    for each in _chain_of(renderer):
        if isinstance(each, vtkGnomonShadowPass):
            return each
    return _before.get(_address_of(renderer), [None])[0]


def _shadows_of(shadows):
    if isinstance(shadows, vtkGnomonShadowPass):
        return shadows
    with naming("shadows"):
        found = _find_shadows(_renderer_of(shadows))
        if found is None:
            raise ValueError("the renderer has none, call add_shadows first")
    return found


def _chain_of(renderer):
    """Return a renderer's pass, and those that it has within."""
    chain = []
    render_pass = renderer.GetPass()
    while render_pass is not None:
        chain.append(render_pass)
        render_pass = getattr(render_pass, "GetDelegatePass", lambda: None)()
    return chain


def _install(shadows, renderer, _event):
    """Install shadows again, where they are the renderer's and another chain has none."""
    is_present = _before.get(_address_of(renderer), [None])[0] is shadows
    if is_present and shadows not in _chain_of(renderer):
        shadows.Install(renderer)


def _set(shadows, name, value):
    attribute = getattr(type(shadows), name, None)
    if not isinstance(attribute, Attribute) or attribute.fset is None:
        raise ValueError(f"{name}: {no_such(name, dir(type(shadows)))}")
    setattr(shadows, name, value)


def _address_of(renderer):
    return renderer.GetAddressAsString("vtkRenderer")
