"""Ends of the process: by Ctrl-C, and under a limit of memory."""

import resource
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

import numpy

import gnomon
from scene import Scene


def start(case):
    """Run a case in a process of its own, and wait until it is about to begin."""
    child = subprocess.Popen([sys.executable, __file__, case], stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True)
    child.stdout.readline()
    return child


class Ends(unittest.TestCase):
    def test_ctrl_c_ends_hours_lit_and_sky_view_at_once(self):
        for case, after in (("many_hours", 0.0), ("many_hours", 0.3), ("many_views", 0.3)):
            child = start(case)
            time.sleep(after)
            child.send_signal(signal.SIGINT)
            begin = time.monotonic()
            try:
                said, _ = child.communicate(timeout=20)
            finally:
                child.kill()
            self.assertIn("KeyboardInterrupt", said)
            # A tenth of a second where nothing else runs.
            self.assertLess(time.monotonic() - begin, 2.0)

    def test_a_handler_that_goes_on_does_not_end_hours_lit(self):
        signals = []

        def note(*_):
            signals.append(1)

        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, note))
        alarm = signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
        self.addCleanup(signal.signal, signal.SIGALRM, alarm)
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        self.assertEqual(hours_of_grid(1000).min(), 1000.0)
        self.assertEqual(signals, [1])
        self.assertIs(signal.getsignal(signal.SIGINT), note)

    def test_a_process_ends_after_embree_was_refused_memory(self):
        for technique in ("raytraced", "auto"):
            child = start(technique)
            try:
                said, _ = child.communicate(timeout=20)
            finally:
                child.kill()
            self.assertIn("Embree cannot be started", said)
            self.assertEqual(child.returncode, 0, said)


def grid(side=200):
    """A flat grid of triangles."""
    x, y = numpy.meshgrid(numpy.arange(side), numpy.arange(side))
    points = numpy.stack([x, y, 0 * x], -1).reshape(-1, 3)
    corner = (numpy.arange(side - 1)[:, None] * side + numpy.arange(side - 1)).reshape(-1)
    triangles = numpy.concatenate(
        [corner[:, None] + (0, 1, side), corner[:, None] + (1, side + 1, side)])
    return points, triangles


def hours_of_grid(directions):
    """Hours of a flat grid under directions from above."""
    return gnomon.hours_lit(grid(), numpy.tile((0.1, 0.2, 1.0), (directions, 1)))


def many_hours():
    print("begins", flush=True)
    hours_of_grid(100000)


def many_views():
    mesh = grid(200)
    print("begins", flush=True)
    gnomon.sky_view(mesh, directions=65536, progress=float)


def draw_with_little_memory(technique):
    scene = Scene()
    scene.window.Render()
    gnomon.add_shadows(scene.renderer, technique)
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    limit = pages * resource.getpagesize() + 40 * 2**20
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    print("begins", flush=True)
    scene.window.Render()
    scene.window.Render()


if __name__ == "__main__":
    if sys.argv[1:] in (["many_hours"], ["many_views"]):
        globals()[sys.argv[1]]()
    elif sys.argv[1:]:
        draw_with_little_memory(sys.argv[1])
    else:
        unittest.main()
