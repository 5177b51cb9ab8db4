"""Pictures of arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer

from .arguments import array, number, path_of
from .data import polydata_of
from .errors import naming, raising
from .images import _off_screen, _pixels, _write

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable

    from numpy.typing import ArrayLike

    from .catalogue import Technique
    from .data import Mesh


def draw(
    surfaces: Iterable[Mesh],
    direction: ArrayLike,
    path: str | os.PathLike[str],
    seen_from: ArrayLike = (0.8, -1.0, 0.6),
    size: tuple[int, int] = (640, 480),
    sky: float = 0.0,
    technique: Technique | None = None,
    **settings: Any,
) -> None:
    """Draw triangles under one sun with their shadows, as a PNG file. It needs no display.

    Parameters
    ----------
    surfaces : list of meshes
        Pairs of points and triangles, and the other kinds that `hours_lit` takes.
    direction : array of 3
        Towards the sun, in world coordinates, of any length: one of `sun_path`, say.
    path : str
        Where the picture is written: a name that ends in .png, in a folder that exists.
    seen_from : array of 3
        Towards the camera, in world coordinates. z is up; y, if it looks along z.
    size : (int, int)
        Width and height in pixels.
    sky : float, optional
        As add_shadows() takes it.
    technique : str, optional
        As add_shadows() takes it.
    **settings
        Those of `add_shadows`.

    Raises
    ------
    TypeError, ValueError
        For arrays of other shapes, settings that do not exist, and a picture that cannot be
        written.
    """
    from . import add_shadows

    path = path_of("path", path, ".png")
    width, height = (number("size", side, 1, 16384, int) for side in array("size", size, (2,), int))
    with naming("surfaces"):
        listed = list(surfaces)
        if not listed:
            raise ValueError("expected one or more meshes, found none")
    renderer = vtkRenderer()
    renderer.SetBackground(0.6, 0.75, 0.9)
    for index, surface in enumerate(listed):
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(polydata_of(f"surfaces[{index}]", surface))
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetAmbient(0.25)
        actor.GetProperty().SetDiffuse(0.75)
        renderer.AddActor(actor)
    sun = vtkLight()
    towards = array("direction", direction, (3,))
    place = array("seen_from", seen_from, (3,))
    for name, vector in (("direction", towards), ("seen_from", place)):
        if not vector.any():
            raise ValueError(f"{name}: expected a vector with a length")
    sun.SetPosition(towards)
    renderer.AddLight(sun)

    camera = renderer.GetActiveCamera()
    camera.SetPosition(place)
    camera.SetViewUp(*((0, 0, 1) if place[:2].any() else (0, 1, 0)))
    renderer.ResetCamera()
    window = _off_screen()
    window.SetSize(width, height)
    window.AddRenderer(renderer)
    shadows = add_shadows(renderer, technique, None, sky, **settings)
    with raising(window, shadows):
        picture = _pixels(window)
    _write(picture, path)
