"""Meshes of all kinds, suns with times, and progress of long work."""

import contextlib
import importlib.util
import io
import os
import sys
import tempfile
import threading
import time
import unittest
from unittest import mock

import numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkPlaneSource

import gnomon
from gnomon.data import polydata_of
from gnomon.images import _pixels

FLOOR = ([[0, 0, 0], [3, 0, 0], [3, 3, 0], [0, 3, 0]], [[0, 1, 2], [0, 2, 3]])
ROOF = ([[1.5, 0.5, 1], [2.5, 0.5, 1], [2.5, 1.5, 1], [1.5, 1.5, 1]], [[0, 1, 2], [0, 2, 3]])


class Polydata(vtkPolyData):
    """A subclass, as PyVista's."""


class Trimesh:
    def __init__(self, pair):
        self.vertices, self.faces = numpy.array(pair[0], float), numpy.array(pair[1])


def subclass_of(pair):
    mesh = Polydata()
    mesh.ShallowCopy(polydata_of("mesh", pair))
    return mesh


KINDS = [
    list, tuple, lambda pair: polydata_of("mesh", pair), subclass_of, Trimesh,
    lambda pair: (numpy.asfortranarray(pair[0], "f4"), numpy.array(pair[1], numpy.uint8)),
]
with contextlib.suppress(ImportError):
    import pyvista

    KINDS.append(lambda pair: pyvista.make_tri_mesh(*map(numpy.array, pair)))
with contextlib.suppress(ImportError):
    import trimesh

    KINDS.append(lambda pair: trimesh.Trimesh(*pair, process=False))


class Meshes(unittest.TestCase):
    def test_all_kinds_of_meshes_have_the_same_hours_and_views(self):
        suns = [[0, 0, 1], [1, 0, 0.5]]
        hours = gnomon.hours_lit(FLOOR, suns, casters=ROOF)
        self.assertEqual(list(hours), [1.0, 2.0])
        view, error = gnomon.sky_view(FLOOR, [ROOF])
        for kind in KINDS:
            floor, roof = kind(FLOOR), kind(ROOF)
            with self.subTest(kind=type(floor).__name__):
                found = gnomon.hours_lit(floor, suns, casters=roof)
                self.assertEqual(list(found), list(hours))
                found = gnomon.sky_view(floor, [roof])
                self.assertTrue((found[0] == view).all() and (found[1] == error).all())

    def test_all_kinds_of_meshes_are_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            pictures = []
            for number, kind in enumerate(KINDS):
                path = os.path.join(folder, f"{number}.png")
                gnomon.draw([kind(FLOOR), kind(ROOF)], [1, 0, 1], path, size=(60, 40))
                pictures.append(_pixels(path))
        for picture in pictures:
            self.assertTrue((picture == pictures[0]).all())

    def test_polygons_have_hours(self):
        plane = vtkPlaneSource()
        plane.SetResolution(3, 2)
        plane.Update()
        self.assertEqual(list(gnomon.hours_lit(plane.GetOutput(), [[0, 0, 1]])), [1.0] * 6)

    def test_data_without_polygons_says_how_to_make_some(self):
        with self.assertRaisesRegex(TypeError, "receivers: .*extract_surface"):
            gnomon.hours_lit(vtkUnstructuredGrid(), [[0, 0, 1]])

    def test_suns_have_times_of_their_zone(self):
        directions, hours, times = gnomon.sun_path(
            52.52, 13.405, "2026-06-21", minutes=30, zone=2, times=True
        )
        self.assertEqual((times.dtype, len(times)), ("datetime64[s]", len(hours)))
        self.assertTrue((numpy.diff(times) == numpy.timedelta64(30, "m")).all())
        # In Berlin the middle of the sun rises at 4:50 and sets at 21:27 on the longest day.
        self.assertEqual(str(times[0]), "2026-06-21T05:15:00")
        self.assertEqual(str(times[-1]), "2026-06-21T21:15:00")
        noon = times[directions[:, 2].argmax()]
        self.assertEqual(str(noon), "2026-06-21T13:15:00")  # 54 minutes west of the zone's middle
        self.assertEqual(len(gnomon.sun_path(52.52, 13.405, "2026-06-21")), 2)


class Progress(unittest.TestCase):
    def test_progress_grows_to_one(self):
        for work in (hours_of_grid, view_of_grid):
            told = []
            work(told.append)
            self.assertGreater(len(told), 3)
            self.assertEqual((told, told[-1]), (sorted(told), 1.0))

    def test_other_threads_go_on(self):
        for work in (hours_of_grid, view_of_grid):
            ticks, told, is_done = [], [], threading.Event()

            def tick():
                while not is_done.wait(0.001):
                    ticks.append(time.monotonic())

            thread = threading.Thread(target=tick)
            thread.start()
            work(lambda done: told.append(time.monotonic()))
            is_done.set()
            thread.join()
            # With Python's lock held, it ticks only where progress is told.
            silent = []
            for begin, end in zip(told, told[1:]):
                times = [begin, *(it for it in ticks if begin < it < end), end]
                silent.append(numpy.diff(times).max() / (end - begin))
            self.assertLess(numpy.median(silent), 0.5)

    @unittest.skipUnless(importlib.util.find_spec("tqdm"), "there is no tqdm")
    def test_progress_is_a_bar_of_tqdm(self):
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            hours_of_grid(True)
        self.assertIn("100%", shown.getvalue())

    def test_a_bar_without_tqdm_is_refused(self):
        with mock.patch.dict(sys.modules, {"tqdm": None, "tqdm.auto": None}):
            with self.assertRaisesRegex(ValueError, "progress: .*tqdm"):
                hours_of_grid(True)

    def test_an_exception_of_progress_ends_the_work(self):
        for kind in (RuntimeError, KeyboardInterrupt):
            told = []

            def stop(done):
                told.append(done)
                raise kind("enough")

            begin = time.monotonic()
            with self.assertRaisesRegex(kind, "enough"):
                hours_of_grid(stop, directions=100000)
            self.assertLess(time.monotonic() - begin, 5)
            self.assertEqual(len(told), 1)


def grid(side=100):
    x, y = numpy.meshgrid(numpy.arange(side), numpy.arange(side))
    points = numpy.stack([x, y, 0 * x], -1).reshape(-1, 3)
    corner = (numpy.arange(side - 1)[:, None] * side + numpy.arange(side - 1)).reshape(-1)
    return points, corner[:, None] + (0, 1, side)


def hours_of_grid(progress, directions=1000):
    return gnomon.hours_lit(grid(), [[0.1, 0.2, 1.0]] * directions, progress=progress)


def view_of_grid(progress):
    return gnomon.sky_view(grid(), progress=progress)


if __name__ == "__main__":
    unittest.main()
