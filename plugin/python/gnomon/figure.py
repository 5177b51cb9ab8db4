"""Pictures of arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer

from .data import _array, _polydata
from .errors import raising
from .GnomonPlugin import vtkGnomonEGLRenderWindow
from .images import _pixels, _write

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable

    from numpy.typing import ArrayLike

    from .catalogue import Technique


def draw(
    surfaces: Iterable[tuple[ArrayLike, ArrayLike]],
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
    surfaces : list of (points, triangles)
        Arrays of n x 3 world coordinates, and of m x 3 numbers of points.
    direction : array of 3
        Towards the sun, in world coordinates, of any length: one of `sun_path`, say.
    path : str
        Where the picture is written.
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
    ValueError
        For arrays of other shapes, settings that do not exist, and a picture that cannot be
        written.
    """
    from . import add_shadows

    renderer = vtkRenderer()
    renderer.SetBackground(0.6, 0.75, 0.9)
    for surface in surfaces:
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(_polydata("surfaces", surface))
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetAmbient(0.25)
        actor.GetProperty().SetDiffuse(0.75)
        renderer.AddActor(actor)
    sun = vtkLight()
    towards = _array("direction", direction, (3,), float)
    if not towards.any():
        raise ValueError("direction: expected a vector with a length")
    sun.SetPosition(towards)
    renderer.AddLight(sun)

    camera = renderer.GetActiveCamera()
    place = _array("seen_from", seen_from, (3,), float)
    camera.SetPosition(place)
    camera.SetViewUp(*((0, 0, 1) if place[:2].any() else (0, 1, 0)))
    renderer.ResetCamera()
    window = vtkGnomonEGLRenderWindow()
    window.SetSize(*size)
    window.AddRenderer(renderer)
    shadows = add_shadows(renderer, technique, None, sky, **settings)
    with raising(window, shadows):
        picture = _pixels(window)
    _write(picture, str(path))
