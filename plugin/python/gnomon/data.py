"""Shadow as data, for arrays."""

from __future__ import annotations

import contextlib
import ctypes
import datetime
import signal
import threading
from typing import TYPE_CHECKING, Any, Protocol, Union

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from . import GnomonPlugin
from .arguments import array, choice, number, switch
from .errors import naming, raising
from .GnomonLights import vtkGnomonSun
from .GnomonPlugin import vtkGnomonVisibilityFilter

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import ArrayLike

    class _HasFaces(Protocol):
        """A mesh of triangles, as trimesh's."""

        @property
        def vertices(self) -> Any: ...

        @property
        def faces(self) -> Any: ...

    Mesh = Union[tuple[ArrayLike, ArrayLike], vtkPolyData, _HasFaces]
    Progress = Union[Callable[[float], Any], bool, None]

_SKIES = ("uniform", "dome", "overcast")  # in the order of vtkGnomonVisibilityFilter.SkyModelType


def sun_path(
    latitude: float,
    longitude: float,
    date: str | datetime.date,
    minutes: float = 10.0,
    zone: float = 0.0,
    times: bool = False,
) -> tuple[numpy.ndarray, ...]:
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
    times : bool
        True to return the zone's time of each sun, too.

    Returns
    -------
    tuple of numpy.ndarray
        The k suns above the horizon: k x 3 unit vectors towards them (x east, y north, z up), and
        the hours that each stands for; what `hours_lit` takes. With `times`, k numpy.datetime64.

    Raises
    ------
    TypeError, ValueError
        For a date, a place or a step that does not exist.
    """
    with naming("date"):
        day = datetime.date.fromisoformat(str(date)[:10])
    sun = vtkGnomonSun()
    directions, hours, since = vtkDoubleArray(), vtkDoubleArray(), vtkDoubleArray()
    with naming("latitude, longitude"), raising(sun):
        sun.SetPlace(number("latitude", latitude), number("longitude", longitude))
    with naming("date"), raising(sun):
        sun.SetDate(day.year, day.month, day.day)
    with naming("zone"), raising(sun):
        sun.SetTime(12, 0, 0.0, number("zone", zone))
    with naming("minutes"), raising(sun):
        sun.MakeDayPath(number("minutes", minutes), directions, hours, since)
    path = vtk_to_numpy(directions), vtk_to_numpy(hours)
    if not switch("times", times):
        return path
    seconds = numpy.rint(vtk_to_numpy(since) * 3600).astype("timedelta64[s]")
    return (*path, numpy.datetime64(day, "s") + seconds)


def hours_lit(
    receivers: Mesh,
    directions: ArrayLike,
    hours: ArrayLike | None = None,
    casters: Mesh | None = None,
    samples: int = 1,
    angular_diameter: float = 0.0,
    progress: Progress = None,
) -> numpy.ndarray:
    """Return how long each triangle is lit, by vtkGnomonVisibilityFilter.

    Parameters
    ----------
    receivers : (points, triangles), vtkPolyData, or what has vertices and faces
        A pair: an array of n x 3 world coordinates, and one of m x 3 numbers of points,
        counter-clockwise as seen from the side that receives. Or PyVista's PolyData, whose polygons
        count, or a mesh of trimesh. They cast, too.
    directions : array of k x 3
        Towards the sun, or another light, in world coordinates, of any length.
    hours : array of k, optional
        How long each direction shines; an hour each if there is none.
    casters : mesh, optional
        Another mesh, of any of these kinds, that casts.
    samples : int
        Rays from a triangle in each direction; 1: from its middle.
    angular_diameter : float
        At which the light is seen, in degrees; the sun's is 0.53. It takes several samples.
    progress : callable or bool, optional
        Called with what is done, in [0, 1]. An exception ends the work. True shows a bar of tqdm.

    Returns
    -------
    numpy.ndarray
        Hours of each of the m triangles or polygons.

    Raises
    ------
    TypeError, ValueError
        For arrays of other shapes, numbers of points that do not exist, and what the filter
        refuses.
    KeyboardInterrupt
        After Ctrl-C on the main thread.
    """
    shadows = vtkGnomonVisibilityFilter()
    samples = number("samples", samples, 1, 4096, int)
    angular_diameter = number("angular_diameter", angular_diameter, 0, 89)
    shadows.SetInputData(0, polydata_of("receivers", receivers))
    if casters is not None:
        shadows.AddInputData(1, polydata_of("casters", casters))
    towards = array("directions", directions, (None, 3))
    count = len(towards)
    if count == 0:
        raise ValueError("directions: expected one or more, found none")
    shines = array("hours", numpy.ones(count) if hours is None else hours, (count,))
    with raising(shadows) as errors:
        shadows.AddDirections(numpy_to_vtk(towards), numpy_to_vtk(shines))
        shadows.SetSamples(samples)
        shadows.SetAngularDiameter(angular_diameter)
        shadows.ComputeReasonsOff()
        if not errors:
            _run(shadows, progress)
    data = shadows.GetOutput().GetCellData()
    return vtk_to_numpy(data.GetArray(shadows.GetHoursName()))


def sky_view(
    surface: Mesh,
    casters: Sequence[Mesh] = (),
    model: str = "uniform",
    directions: int = 1024,
    distance: float = 0.0,
    up: ArrayLike = (0.0, 0.0, 1.0),
    progress: Progress = None,
) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Return how much of the sky each cell sees, by vtkGnomonVisibilityFilter.

    Parameters
    ----------
    surface : (points, triangles), vtkPolyData, or what has vertices and faces
        As the receivers of `hours_lit`. It casts, too.
    casters : sequence of meshes, optional
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
    progress : callable or bool, optional
        As for `hours_lit`.

    Returns
    -------
    (numpy.ndarray, numpy.ndarray)
        Each cell's view, 1 where a horizontal surface sees all, and its standard error.

    Raises
    ------
    TypeError, ValueError
        For arrays of other shapes, numbers of points that do not exist, and what the filter
        refuses.
    KeyboardInterrupt
        After Ctrl-C on the main thread.
    """
    choice("model", model, _SKIES)
    directions = number("directions", directions, 16, 65536, int)
    upwards = array("up", up, (3,))
    shadows = _filter_of(surface, casters)
    with naming("distance"), raising(shadows):
        shadows.SetSkyDistance(number("distance", distance))
    with naming("directions"), raising(shadows):
        shadows.AddSky(_SKIES.index(model), directions)
    with naming("up"), raising(shadows):
        shadows.SetUp(upwards)
    with raising(shadows):
        _run(shadows, progress)
    data = shadows.GetOutput().GetCellData()
    view, error = (
        vtk_to_numpy(data.GetArray(name))
        for name in (shadows.GetSkyViewName(), shadows.GetSkyViewErrorName())
    )
    return view, error


def sky_patches(
    surface: Mesh,
    casters: Sequence[Mesh] = (),
    up: ArrayLike = (0.0, 0.0, 1.0),
    north: ArrayLike = (0.0, 1.0, 0.0),
    progress: Progress = None,
) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """Return which of the sky's 145 patches (Tregenza 1987) each cell sees.

    Parameters
    ----------
    surface : (points, triangles), vtkPolyData, or what has vertices and faces
        As the receivers of `hours_lit`. It casts, too.
    casters : sequence of meshes, optional
        Other surfaces that hide the sky.
    up : array of 3
        Of the horizon, of any length.
    north : array of 3
        Of any length, not along up. Patches go from the horizon up, ring by ring; each ring begins
        in the north and goes on to the east.
    progress : callable or bool, optional
        As for `hours_lit`.

    Returns
    -------
    (numpy.ndarray, numpy.ndarray, numpy.ndarray)
        For each cell and patch whether the ray to the patch's middle is free, of shape
        (cells, 145); the patches' directions, of shape (145, 3); their solid angles in steradians.

    Raises
    ------
    TypeError, ValueError, KeyboardInterrupt
        As `sky_view`.
    """
    upwards, ahead = array("up", up, (3,)), array("north", north, (3,))
    if not upwards.any():
        raise ValueError("up: expected a vector with a length")
    shadows = _filter_of(surface, casters)
    with naming("north"), raising(shadows):
        shadows.AddSkyPatches(upwards, ahead)
    shadows.ComputeBitsOn()
    shadows.ComputeReasonsOff()
    with raising(shadows):
        _run(shadows, progress)
    count = shadows.GetNumberOfLights()
    directions = numpy.zeros((count, 3))
    for index, direction in enumerate(directions):
        shadows.GetDirection(index, direction)
    bits = vtk_to_numpy(shadows.GetOutput().GetCellData().GetArray(shadows.GetBitsName()))
    seen = numpy.unpackbits(bits, axis=1, count=count, bitorder="little").astype(bool)
    return seen, directions, numpy.array([shadows.GetHours(index) for index in range(count)])


def _filter_of(surface, casters):
    """A filter for what a surface sees of a sky."""
    shadows = vtkGnomonVisibilityFilter()
    shadows.SetInputData(0, polydata_of("surface", surface))
    with naming("casters"):
        listed = list(casters)
    for index, caster in enumerate(listed):
        shadows.AddInputData(1, polydata_of(f"casters[{index}]", caster))
    return shadows


# Releases Python's lock, unlike VTK's wrappers, whose observers take it.
_update = ctypes.CDLL(GnomonPlugin.__file__).gnomonUpdate
_update.argtypes, _update.restype = [ctypes.c_void_p], None


def _run(algorithm, progress):
    """Execute an algorithm, which tells of its progress, until its end, Ctrl-C or an exception.

    Other threads go on meanwhile. Python runs the handler of a signal in its own code only, here in
    the observer of the progress. VTK's wrappers end the program if an observer raises
    KeyboardInterrupt, so exceptions wait for the end.
    """
    raised = []

    def calling(function, *arguments):
        try:
            function(*arguments)
        except BaseException as error:  # KeyboardInterrupt is no Exception
            raised.append(error)

    with _teller_of(progress) as tell, _handling_ctrl_c(calling):

        def observe(*_):
            if not raised:
                calling(tell, algorithm.GetProgress())
            if raised:
                algorithm.AbortExecuteOn()

        algorithm.AddObserver("ProgressEvent", observe)
        _update(int(algorithm.GetAddressAsString("").removeprefix("Addr="), 16))
    if raised:
        raise raised[0]


@contextlib.contextmanager
def _teller_of(progress):
    """Give the function that tells of progress."""
    if progress is None or progress is False:
        yield lambda done: None
    elif progress is not True:
        if not callable(progress):
            raise TypeError(f"progress: found {progress!r}, expected a function of a number")
        yield progress
    else:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            raise ValueError("progress: True needs tqdm, which is not installed") from None
        with tqdm(total=1.0, bar_format="{l_bar}{bar}| {elapsed}<{remaining}") as bar:
            yield lambda done: bar.update(done - bar.n)


@contextlib.contextmanager
def _handling_ctrl_c(calling):
    """Have Ctrl-C call its handler by `calling`, where this thread's signals have one."""
    handler = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(handler):
        yield
        return
    signal.signal(signal.SIGINT, lambda *given: calling(handler, *given))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)


def polydata_of(name, mesh):
    """Return a mesh of any kind as polydata."""
    if isinstance(mesh, vtkPolyData):
        if mesh.GetPoints() is not None:
            array(f"{name}' points", vtk_to_numpy(mesh.GetPoints().GetData()), (None, 3))
        return mesh
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        mesh = mesh.vertices, mesh.faces
    if not isinstance(mesh, (tuple, list)) or len(mesh) != 2:
        raise TypeError(
            f"{name}: found {type(mesh).__name__}, expected a pair of points and triangles, a"
            " vtkPolyData (extract_surface() makes one of PyVista's other data), or an object with"
            " vertices and faces"
        )
    points = array(f"{name}' points", mesh[0], (None, 3))
    triangles = array(f"{name}' triangles", mesh[1], (None, 3), numpy.int64)
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
