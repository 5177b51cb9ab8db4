"""Shadow as data, for arrays."""

from __future__ import annotations

import contextlib
import datetime
import signal
import threading
from typing import TYPE_CHECKING

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from .errors import raising
from .GnomonLights import vtkGnomonSun
from .GnomonPlugin import vtkGnomonVisibilityFilter

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike

_SKIES = ("uniform", "dome", "overcast")  # in the order of vtkGnomonVisibilityFilter.SkyModelType


def sun_path(
    latitude: float,
    longitude: float,
    date: str | datetime.date,
    minutes: float = 10.0,
    zone: float = 0.0,
) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Return the suns of a day, from midnight to midnight, by vtkGnomonSun.

    Parameters
    ----------
    latitude : float
        Degrees to the north.
    longitude : float
        Degrees to the east.
    date : str or datetime.date
        As "2026-12-21".
    minutes : float
        From one sun to the next, in (0, 1440].
    zone : float
        Hours to the east of UTC, which say when midnight is.

    Returns
    -------
    (numpy.ndarray, numpy.ndarray)
        The k suns above the horizon: k x 3 unit vectors towards them (x east, y north, z up), and
        the hours that each stands for; what `hours_lit` takes.

    Raises
    ------
    ValueError
        For a date, a place or a step that does not exist.
    """
    day = datetime.date.fromisoformat(str(date))
    sun = vtkGnomonSun()
    directions, hours = vtkDoubleArray(), vtkDoubleArray()
    with raising(sun):
        sun.SetPlace(latitude, longitude)
        sun.SetDate(day.year, day.month, day.day)
        sun.SetTime(12, 0, 0.0, zone)
        sun.MakeDayPath(minutes, directions, hours)
    return vtk_to_numpy(directions), vtk_to_numpy(hours)


def hours_lit(
    receivers: tuple[ArrayLike, ArrayLike],
    directions: ArrayLike,
    hours: ArrayLike | None = None,
    casters: tuple[ArrayLike, ArrayLike] | None = None,
    samples: int = 1,
    angular_diameter: float = 0.0,
) -> numpy.ndarray:
    """Return how long each triangle is lit, by vtkGnomonVisibilityFilter.

    Parameters
    ----------
    receivers : (points, triangles)
        An array of n x 3 world coordinates, and one of m x 3 numbers of points, counter-clockwise
        as seen from the side that receives. They cast, too.
    directions : array of k x 3
        Towards the sun, or another light, in world coordinates, of any length.
    hours : array of k, optional
        How long each direction shines; an hour each if there is none.
    casters : (points, triangles), optional
        What else casts.
    samples : int
        Rays from a triangle in each direction; 1: from its middle.
    angular_diameter : float
        At which the light is seen, in degrees; the sun's is 0.53. It takes several samples.

    Returns
    -------
    numpy.ndarray
        Hours of each of the m triangles.

    Raises
    ------
    ValueError
        For arrays of other shapes, numbers of points that do not exist, and what the filter
        refuses.
    KeyboardInterrupt
        After Ctrl-C on the main thread.
    """
    shadows = vtkGnomonVisibilityFilter()
    shadows.SetInputData(0, _polydata("receivers", receivers))
    if casters is not None:
        shadows.AddInputData(1, _polydata("casters", casters))
    towards = _array("directions", directions, (None, 3), float)
    count = len(towards)
    shines = _array("hours", numpy.ones(count) if hours is None else hours, (count,), float)
    with raising(shadows) as errors:
        shadows.AddDirections(numpy_to_vtk(towards), numpy_to_vtk(shines))
        shadows.SetSamples(samples)
        shadows.SetAngularDiameter(angular_diameter)
        shadows.ComputeReasonsOff()
        if not errors:
            with _interruptible(shadows):
                shadows.Update()
    data = shadows.GetOutput().GetCellData()
    return vtk_to_numpy(data.GetArray(shadows.GetHoursName()))


def sky_view(
    surface: tuple[ArrayLike, ArrayLike] | vtkPolyData,
    casters: Sequence[tuple[ArrayLike, ArrayLike] | vtkPolyData] = (),
    model: str = "uniform",
    directions: int = 1024,
    distance: float = 0.0,
    up: ArrayLike = (0.0, 0.0, 1.0),
) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Return how much of the sky each cell sees, by vtkGnomonVisibilityFilter.

    Parameters
    ----------
    surface : (points, triangles) or vtkPolyData
        As the receivers of `hours_lit`; or polydata, whose polygons count. It casts, too.
    casters : sequence of the same, optional
        Other surfaces that hide the sky.
    model : str
        "uniform": as bright from everywhere, from below, too (ambient occlusion); "dome": as
        bright from everywhere above the horizon; "overcast": CIE's sky, three times as bright in
        the zenith as at the horizon.
    directions : int
        Rays from the middle of each cell, a power of two in [16, 65536].
    distance : float
        Length in world units beyond which nothing hides the sky; 0: no limit.
    up : array of 3
        Of the horizon, of any length.

    Returns
    -------
    (numpy.ndarray, numpy.ndarray)
        Each cell's view, 1 where a horizontal surface sees all, and its standard error.

    Raises
    ------
    ValueError
        For arrays of other shapes, numbers of points that do not exist, and what the filter
        refuses.
    KeyboardInterrupt
        After Ctrl-C on the main thread.
    """
    if model not in _SKIES:
        raise ValueError(f"model: expected one of {', '.join(_SKIES)}, found {model!r}")
    shadows = vtkGnomonVisibilityFilter()
    shadows.SetInputData(0, _polydata("surface", surface))
    for number, caster in enumerate(casters):
        shadows.AddInputData(1, _polydata(f"casters[{number}]", caster))
    with raising(shadows) as errors:
        shadows.SetUp(_array("up", up, (3,), float))
        shadows.SetSkyDistance(distance)
        shadows.AddSky(_SKIES.index(model), directions)
        if not errors:
            with _interruptible(shadows):
                shadows.Update()
    data = shadows.GetOutput().GetCellData()
    view, error = (
        vtk_to_numpy(data.GetArray(name))
        for name in (shadows.GetSkyViewName(), shadows.GetSkyViewErrorName())
    )
    return view, error


@contextlib.contextmanager
def _interruptible(algorithm):
    """Let Ctrl-C end an algorithm's execution by its exception.

    Python runs the handler of a signal in its own code only, here in the observer of the progress.
    VTK's wrappers end the program if an observer raises KeyboardInterrupt, so it waits for the end.
    """
    handler = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(handler):
        yield
        return
    raised = []

    def handle(*signal_and_frame):
        try:
            handler(*signal_and_frame)
        except BaseException as error:  # KeyboardInterrupt is no Exception
            raised.append(error)

    def abort(*_):
        if raised:
            algorithm.AbortExecuteOn()

    algorithm.AddObserver("ProgressEvent", abort)
    signal.signal(signal.SIGINT, handle)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)
    if raised:
        raise raised[0]


def _array(name, values, shape, kind):
    array = numpy.ascontiguousarray(values, dtype=kind)
    fits = array.ndim == len(shape) and all(
        wanted in (None, found) for wanted, found in zip(shape, array.shape)
    )
    if not fits:
        wanted = " x ".join("n" if side is None else str(side) for side in shape)
        raise ValueError(f"{name}: expected an array of {wanted} numbers, found {array.shape}")
    return array


def _polydata(name, mesh):
    if isinstance(mesh, vtkPolyData):
        return mesh
    points = _array(f"{name}' points", mesh[0], (None, 3), float)
    triangles = _array(f"{name}' triangles", mesh[1], (None, 3), numpy.int64)
    if triangles.size and (triangles.min() < 0 or triangles.max() >= len(points)):
        raise ValueError(
            f"{name}' triangles: expected numbers of points in [0, {len(points) - 1}], found "
            f"{triangles.min()} to {triangles.max()}"
        )
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(points, deep=True))
    cells = vtkCellArray()
    offsets = numpy.arange(0, triangles.size + 1, 3, dtype=numpy.int64)
    cells.SetData(
        numpy_to_vtkIdTypeArray(offsets, deep=True),
        numpy_to_vtkIdTypeArray(triangles.reshape(-1), deep=True),
    )
    polydata = vtkPolyData()
    polydata.SetPoints(vtk_points)
    polydata.SetPolys(cells)
    return polydata
