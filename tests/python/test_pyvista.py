"""Shadows in PyVista's plotters. Skipped where there is no PyVista."""

import contextlib
import itertools
import os
import runpy
import sys
import tempfile
import unittest
import warnings
from unittest import mock

import gnomon
from gnomon.lighting import lights_of

try:
    import numpy
    import pyvista
except ImportError:
    pyvista = None

PROJECT = os.path.join(os.path.dirname(__file__), "..", "..")
GALLERY = os.path.join(PROJECT, "examples", "pyvista_gallery.py")
PICTURES = os.path.join(PROJECT, "docs", "figures", "pyvista")


def add_scene(plotter, has_sun=True):
    """A ball over a floor; the ball's actor."""
    plotter.add_mesh(pyvista.Plane(i_size=6, j_size=6), color="white")
    ball = plotter.add_mesh(pyvista.Sphere(center=(0, 0, 1)), color="white")
    if has_sun:
        plotter.add_light(pyvista.Light(position=(1, 0, 1.5), light_type="scene light"))
    plotter.camera_position = "xy"
    return ball


def plotter_of(**arguments):
    return pyvista.Plotter(off_screen=True, window_size=(200, 100), lighting="none", **arguments)


PASSES = {
    "ssao": lambda plotter: plotter.enable_ssao(radius=0.5, kernel_size=32),
    "edl": lambda plotter: plotter.enable_eye_dome_lighting(),
    "ssaa": lambda plotter: plotter.enable_anti_aliasing("ssaa"),
    "fxaa": lambda plotter: plotter.enable_anti_aliasing("fxaa"),
    "peeling": lambda plotter: plotter.enable_depth_peeling(8),
    "depth of field": lambda plotter: plotter.enable_depth_of_field(),
    "blur": lambda plotter: plotter.add_blurring(),
}
REFUSED = ({"ssaa", "fxaa"}, {"ssao", "depth of field"})  # which PyVista does not take together


def picture_of(plotter):
    plotter.render()  # PyVista does not know of a pass that comes or goes
    return plotter.screenshot()


def pictures_with(names):
    """A scene's picture with some of PASSES and "shadows", and with these removed again."""
    plotter = plotter_of()
    plotter.render_window.SetMultiSamples(0)  # with which VTK's peeling fails
    add_scene(plotter)
    plotter.add_mesh(pyvista.Plane(center=(2, 1, 1.5)), color="red", opacity=0.5)
    for name in names:
        {"shadows": gnomon.add_shadows, **PASSES}[name](plotter)
    picture_of(plotter)  # VTK's first one with a depth of field is black
    picture = picture_of(plotter)
    gnomon.remove_shadows(plotter)
    without = picture_of(plotter)
    plotter.close()
    return picture, without


def darker(before, after):
    """How many pixels of the second picture are clearly darker."""
    return int((before.astype(int) - after.astype(int) > 40).all(axis=2).sum())


def run_gallery(folder, has_shadows):
    with contextlib.ExitStack() as stack:
        stack.enter_context(warnings.catch_warnings())
        warnings.simplefilter("ignore")  # the default lights give way
        stack.enter_context(mock.patch.object(sys, "argv", [GALLERY, folder]))
        if not has_shadows:
            stack.enter_context(mock.patch("gnomon.add_shadows"))
        runpy.run_path(GALLERY)


def over_white(path):
    """A picture's colours over a white page."""
    image = pyvista.read(path)
    pixels = image.active_scalars.reshape(image.dimensions[1], image.dimensions[0], -1) * 1.0
    opacity = pixels[..., 3:] / 255 if pixels.shape[2] == 4 else 1
    return pixels[..., :3] * opacity + 255 * (1 - opacity)


@unittest.skipUnless(pyvista, "there is no PyVista")
class PyVista(unittest.TestCase):
    def test_a_plotter_shows_shadows_and_none_again(self):
        plotter = plotter_of()
        add_scene(plotter)
        plain = picture_of(plotter)
        shadows = gnomon.add_shadows(plotter)
        self.assertIs(plotter.renderer.GetPass(), shadows)
        self.assertGreater(darker(plain, picture_of(plotter)), 50)
        self.assertEqual(gnomon.report(shadows)["lights"][0]["technique"], "silhouette")
        gnomon.remove_shadows(plotter)
        self.assertIsNone(plotter.renderer.GetPass())
        self.assertTrue((picture_of(plotter) == plain).all())
        plotter.close()

    def test_meshes_that_come_later_cast_and_receive(self):
        plotter = plotter_of()
        add_scene(plotter)
        gnomon.add_shadows(plotter)
        before = picture_of(plotter)
        plotter.add_mesh(pyvista.Sphere(center=(1.5, 1, 1)), color="white", name="late")
        after = picture_of(plotter)
        self.assertGreater(darker(before, after), 50)
        plotter.remove_actor("late")
        self.assertTrue((picture_of(plotter) == before).all())
        plotter.close()

    def test_each_subplot_by_itself(self):
        plotter = plotter_of(shape=(1, 2))
        add_scene(plotter)
        plotter.subplot(0, 1)
        add_scene(plotter)
        plain = picture_of(plotter)
        gnomon.add_shadows(plotter)  # of the right one, which is active
        right = picture_of(plotter)
        self.assertEqual(darker(plain[:, :100], right[:, :100]), 0)
        self.assertGreater(darker(plain[:, 100:], right[:, 100:]), 50)
        gnomon.add_shadows(plotter.renderers[0])
        both = picture_of(plotter)
        self.assertTrue((both[:, 102:] == right[:, 102:]).all())
        self.assertGreater(darker(plain[:, :100], both[:, :100]), 50)
        plotter.subplot(0, 1)
        gnomon.remove_shadows(plotter)
        self.assertTrue((picture_of(plotter)[:, 102:] == plain[:, 102:]).all())
        plotter.close()

    def test_visibility_names_actors_and_cells(self):
        plotter = plotter_of()
        ball = add_scene(plotter)
        shadows = gnomon.add_shadows(plotter)
        shadows.KeepVisibilityOn()
        picture_of(plotter)
        arrays = gnomon.visibility(shadows)
        props = plotter.renderer.GetViewProps()
        actors = [props.GetItemAsObject(i) for i in range(props.GetNumberOfItems())]
        on_ball = arrays["prop"] == actors.index(ball)
        self.assertGreater(on_ball.sum(), 50)
        self.assertTrue((arrays["position"][on_ball][:, 2] > 0.9).all())
        # The cells of the mesh that was added.
        cells = arrays["cell"][on_ball]
        centres = ball.mapper.dataset.cell_centers().points
        distances = numpy.linalg.norm(centres[cells] - arrays["position"][on_ball], axis=1)
        self.assertLess(distances.max(), 0.1)
        plotter.close()

    def test_all_orders_of_passes_and_shadows_give_the_same_picture(self):
        pairs = [
            pair for count in (1, 2) for pair in itertools.combinations(PASSES, count)
            if set(pair) not in REFUSED
        ]
        self.assertEqual(len(pairs), 26)
        for pair in pairs:
            plain, _ = pictures_with(pair)
            is_red = plain[..., 0] > plain[..., 1].astype(int) + 40
            self.assertGreater(is_red.sum(), 50, pair)
            pictures = []
            for order in itertools.permutations(("shadows", *pair)):
                with self.subTest(order=order):
                    picture, without = pictures_with(order)
                    self.assertGreater(darker(plain, picture), 50)
                    self.assertTrue((without == plain).all())
                    pictures.append(picture)
                    self.assertTrue((picture == pictures[0]).all())

    def test_the_default_lights_give_way_and_come_back(self):
        for is_drawn in (False, True):
            plotter = pyvista.Plotter(off_screen=True, window_size=(200, 100))
            add_scene(plotter, has_sun=False)
            if is_drawn:
                plain = picture_of(plotter)
            before = lights_of(plotter.renderer)
            with self.assertWarnsRegex(UserWarning, "kit gave way"):
                shadows = gnomon.add_shadows(plotter)
            picture_of(plotter)
            self.assertEqual(sum(light["casts"] for light in gnomon.report(shadows)["lights"]), 1)
            gnomon.remove_shadows(plotter)
            self.assertEqual(lights_of(plotter.renderer), before)
            if is_drawn:
                self.assertTrue((picture_of(plotter) == plain).all())
            plotter.close()

    def test_chosen_lights_stay_and_cast_on_request(self):
        for lighting, light, casting, count in (
            ("light kit", None, "auto", 1),
            ("light kit", None, "all", 4),  # a headlight's shadow is never seen
            ("three lights", "auto", "auto", 1),
            ("three lights", "auto", "all", 3),
            ("none", "auto", "auto", 0),
        ):
            with self.subTest(lighting=lighting, casting=casting):
                plotter = pyvista.Plotter(off_screen=True, lighting=lighting)
                add_scene(plotter, has_sun=False)
                before = lights_of(plotter.renderer)
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    shadows = gnomon.add_shadows(plotter, light=light, casting=casting)
                picture_of(plotter)
                casts = [light["casts"] for light in gnomon.report(shadows)["lights"]]
                self.assertEqual(casts.count(True), count)
                self.assertEqual(lights_of(plotter.renderer), before)
                plotter.close()

    def test_shown_pictures_and_transparent_ones_have_shadows(self):
        plotter = plotter_of()
        add_scene(plotter)
        plain = plotter.screenshot(transparent_background=True)
        gnomon.add_shadows(plotter)
        plotter.render()
        clear = plotter.screenshot(transparent_background=True)
        self.assertTrue((clear[..., 3] == plain[..., 3]).all())
        self.assertEqual((clear[0, 0, 3], clear[50, 100, 3]), (0, 255))
        self.assertGreater(darker(plain[..., :3], clear[..., :3]), 50)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture.png")
            plotter.show(screenshot=path)
            gnomon.assert_images_equal(plotter.screenshot(), path)
            self.assertGreater(darker(plain[..., :3], plotter.screenshot()), 50)
        plotter.close()

    def test_volumes_cast_shadows(self):
        plotter = plotter_of()
        ball = pyvista.ImageData(
            dimensions=(21, 21, 21), spacing=(0.1, 0.1, 0.1), origin=(-1, -1, 1)
        )
        ball["density"] = 1 - numpy.linalg.norm(ball.points - ball.center, axis=1)
        plotter.add_volume(ball, opacity=[0, 0.2], clim=(0, 1), show_scalar_bar=False)
        plotter.add_mesh(pyvista.Plane(i_size=8, j_size=8), color="white")
        plotter.add_light(pyvista.Light(position=(1, 0, 1), light_type="scene light"))
        plotter.camera_position = "xy"
        plain = picture_of(plotter)
        with self.assertWarnsRegex(UserWarning, "vtkVolume"), gnomon.shadows(plotter):
            self.assertEqual(darker(plain, picture_of(plotter)), 0)
        with gnomon.shadows(plotter, volumes=True):
            self.assertGreater(darker(plain, picture_of(plotter)), 50)
        plotter.close()

    def test_pictures_go_to_files_and_are_compared(self):
        plotter = plotter_of()
        add_scene(plotter)
        gnomon.add_shadows(plotter)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture.png")
            picture = plotter.screenshot(path)
            gnomon.assert_images_equal(picture, path)
        plotter.close()

    def test_the_gallery_s_pictures_are_the_guide_s(self):
        # Releases of PyVista and VTK differ in edges of surfaces and in volumes.
        for has_shadows in (True, False):
            with tempfile.TemporaryDirectory() as folder:
                run_gallery(folder, has_shadows)
                self.assertEqual(len(os.listdir(folder)), 8)
                self.assertEqual(sorted(os.listdir(folder)), sorted(os.listdir(PICTURES)))
                for name in os.listdir(folder):
                    found = over_white(os.path.join(folder, name))
                    expected = over_white(os.path.join(PICTURES, name))
                    differ = (abs(found - expected) > 32).any(axis=2).mean()
                    with self.subTest(picture=name, differ=differ):
                        self.assertEqual(differ < 0.01, has_shadows)


if __name__ == "__main__":
    unittest.main()
