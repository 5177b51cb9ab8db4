"""A test of one's own pictures: unittest, with baselines in a folder beside this file.

A picture passes if at most MAX_PIXELS of its pixels differ from the baseline by more than
MAX_DIFFERENCE of 255. The first run, and any after a change that is meant, writes the baselines:

GNOMON_REFRESH_BASELINES=1 python3 image_test.py
python3 image_test.py
"""

import os
import shutil
import tempfile
import unittest

import gnomon
import vtk

BASELINES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "baselines")
MAX_DIFFERENCE = 16  # drivers round colours differently
MAX_PIXELS = 30  # and edges


def make_window(height: float) -> gnomon.vtkGnomonEGLRenderWindow:
    """The program under test: a cone over a plane, at a height."""
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    cone = vtk.vtkConeSource()
    cone.SetDirection(0, 0, 1)
    cone.SetCenter(0, 0, height + 0.5)
    cone.SetResolution(48)
    plane = vtk.vtkPlaneSource()
    plane.SetOrigin(-8, -8, 0)
    plane.SetPoint1(8, -8, 0)
    plane.SetPoint2(-8, 8, 0)
    for source, colour in ((cone, (0.85, 0.45, 0.25)), (plane, (0.85, 0.87, 0.9))):
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputConnection(source.GetOutputPort())
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(colour)
        actor.GetProperty().SetAmbient(0.25)  # ambient light is never shadowed
        renderer.AddActor(actor)
    sun = vtk.vtkLight()
    sun.SetPosition(-1, -0.5, 1.2)  # directional: it shines towards the origin
    renderer.AddLight(sun)
    gnomon.add_shadows(renderer)  # `auto` is exact off-screen: the same picture each time
    camera = renderer.GetActiveCamera()
    camera.SetPosition(1, -6, 4)
    camera.SetFocalPoint(0.4, 0, 0.6)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCameraClippingRange()
    window = gnomon.vtkGnomonEGLRenderWindow()
    window.SetSize(160, 120)
    window.SetMultiSamples(0)  # samples at edges depend on the driver
    window.AddRenderer(renderer)
    window.Render()
    return window


class Pictures(unittest.TestCase):
    def check(self, window: vtk.vtkRenderWindow, name: str) -> None:
        path = os.path.join(BASELINES, name + ".png")
        gnomon.assert_images_equal(window, path, MAX_DIFFERENCE, MAX_PIXELS)

    def test_a_cone_on_the_ground(self) -> None:
        self.check(make_window(0), "cone_on_the_ground")

    def test_a_cone_in_the_air(self) -> None:
        self.check(make_window(0.6), "cone_in_the_air")

    def test_the_baselines_tell_them_apart(self) -> None:
        """A test that cannot fail is worth nothing."""
        if "GNOMON_REFRESH_BASELINES" in os.environ:
            self.skipTest("it would write a wrong baseline")
        with tempfile.TemporaryDirectory() as folder:  # it leaves the new picture there
            path = shutil.copy(os.path.join(BASELINES, "cone_on_the_ground.png"), folder)
            with self.assertRaises(AssertionError):
                gnomon.assert_images_equal(make_window(0.6), path, MAX_DIFFERENCE, MAX_PIXELS)


if __name__ == "__main__":
    unittest.main()
