"""Lights that take the place of default ones, and give it back."""

import warnings

from vtkmodules.vtkRenderingCore import vtkLight, vtkLightKit, vtkRenderer

from .GnomonLights import vtkGnomonLightKeys, vtkGnomonLightPlacement
from .GnomonPlugin import vtkGnomonFlatteringLights


class FlatteringLights:
    """A key light and a fill light in the place of a renderer's default lights.

    Attributes
    ----------
    observers : list of int
        Observers of the renderer, to be removed with the lights.
    """

    def __init__(self, renderer, replaced):
        self.observers = []
        self._before = lights_of(renderer)
        self._replaced = replaced
        self._creates = renderer.GetAutomaticLightCreation()
        self._key, self._fill = vtkLight(), vtkLight()
        for light in replaced:
            renderer.RemoveLight(light)
        renderer.AddLight(self._key)
        renderer.AddLight(self._fill)
        renderer.AutomaticLightCreationOff()
        self._placed = self._view = None
        self._place(renderer)
        self.observers.append(renderer.AddObserver("StartEvent", self._at_first_picture))

    def give_back(self, renderer):
        """Remove the lights; put the former ones back unless others give light."""
        present = lights_of(renderer)
        others = [light for light in present if light not in (self._key, self._fill)]
        renderer.RemoveLight(self._key)
        renderer.RemoveLight(self._fill)
        if self._key in present and not any(map(_gives_light, others)):
            former = [light for light in self._before if light in others + self._replaced]
            for light in others:
                renderer.RemoveLight(light)
            for light in former + [light for light in others if light not in former]:
                renderer.AddLight(light)
        renderer.SetAutomaticLightCreation(
            self._creates or renderer.GetAutomaticLightCreation()
        )

    def _at_first_picture(self, renderer, _event):
        """Place the lights for the first picture, which may be of another view or other props."""
        if self._placed in (None, self._places()) and self._view != _view_of(renderer):
            self._place(renderer)
        if self._placed is not None:
            renderer.RemoveObserver(self.observers.pop())

    def _place(self, renderer):
        """Place both lights for what is visible, unless nothing is, or a single point."""
        bounds = renderer.ComputeVisiblePropBounds()
        if not any(bounds[axis] < bounds[axis + 1] for axis in (0, 2, 4)):
            return
        if not renderer.IsActiveCameraCreated():
            renderer.ResetCamera()
        if vtkGnomonFlatteringLights().Make(renderer, self._key, self._fill):
            self._placed, self._view = self._places(), _view_of(renderer)

    def _places(self):
        return [(light.GetPosition(), light.GetFocalPoint()) for light in (self._key, self._fill)]


def replace_default_lights(renderer):
    """Exchange a renderer's default lights for flattering ones; None if a program made its own."""
    all_lights = lights_of(renderer)
    lit = [light for light in all_lights if _gives_light(light)]
    if not all_lights and renderer.GetAutomaticLightCreation() or _is_lone_headlight(lit):
        told = "The only light was a headlight, which shows no shadow: a key light and a fill"
        told += " light took its place."
    elif _is_default_kit(all_lights):
        told = "The default light kit gave way to a key light and a fill light."
    else:
        return None
    warnings.warn(f"{told} light=None leaves lights as they are.", stacklevel=3)
    return FlatteringLights(renderer, lit)


def replace_lights(renderer):
    """Exchange all lights that give light for flattering ones."""
    return FlatteringLights(renderer, [it for it in lights_of(renderer) if _gives_light(it)])


def lights_of(renderer):
    lights = renderer.GetLights()
    return [lights.GetItemAsObject(i) for i in range(lights.GetNumberOfItems())]


def _gives_light(light):
    return light.GetSwitch() and light.GetIntensity() != 0 and any(light.GetDiffuseColor())


def _is_lone_headlight(lit):
    return (
        len(lit) == 1
        and vtkGnomonLightPlacement.IsHeadlight(lit[0])
        and not lit[0].GetInformation().Has(vtkGnomonLightKeys.CASTS())
    )


def _is_default_kit(lights):
    """True if lights equal those of a vtkLightKit with its defaults, as PyVista's are.

    PyVista rounds their colours to 8 bits.
    """
    renderer = vtkRenderer()
    vtkLightKit().AddLightsToRenderer(renderer)
    kit = lights_of(renderer)
    return len(lights) == len(kit) and all(
        light.GetInformation().GetNumberOfKeys() == 0
        and all(abs(a - b) < 0.5 / 255 for a, b in zip(_numbers_of(light), _numbers_of(other)))
        for light, other in zip(lights, kit)
    )


def _numbers_of(light):
    """All that tells lights apart but a headlight's place, which pictures move to the camera."""
    return (
        light.GetLightType(),
        light.GetSwitch(),
        light.GetPositional(),
        light.GetIntensity(),
        light.GetShadowAttenuation(),
        *light.GetDiffuseColor(),
        *light.GetSpecularColor(),
        *(() if light.LightTypeIsHeadlight() else light.GetPosition() + light.GetFocalPoint()),
    )


def _view_of(renderer):
    """Return what the placing depends on: the camera, the picture's shape, the box of props."""
    camera = renderer.GetActiveCamera()
    window = renderer.GetRenderWindow()
    matrix = camera.GetViewTransformMatrix()
    return (
        [matrix.GetElement(row, column) for row in range(3) for column in range(4)],
        (camera.GetViewAngle(), camera.GetParallelProjection(), camera.GetParallelScale()),
        renderer.ComputeVisiblePropBounds(),
        window and window.GetSize(),
    )
