"""Shadows in PyVista's plotters. Skipped where there is no PyVista."""

import itertools
import os
import subprocess
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

EXAMPLE = os.path.join(os.path.dirname(__file__), "..", "..", "examples", "pyvista_shadows.py")


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

    @mock.patch("pyvista.OFF_SCREEN", True)
    def test_the_guide_s_lines_show_shadows(self):
        mesh = pyvista.Sphere()
        plotter = pyvista.Plotter(lighting="none")
        plotter.add_mesh(mesh)
        plotter.add_light(pyvista.Light(position=(8, 1, 4), light_type="scene light"))
        gnomon.add_shadows(plotter, light_radius=5)
        plotter.show()

    def test_the_example_shows_shadows(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture.png")
            subprocess.run([sys.executable, EXAMPLE, path], check=True)
            picture = pyvista.read(path).point_data.active_scalars.reshape(450, 1000, -1)[::-1]
        self.assertGreater((picture[:, :500] < 50).all(axis=2).sum(), 1000)
        self.assertGreater((picture[:, 500:] < 80).all(axis=2).sum(), 1000)


if __name__ == "__main__":
    unittest.main()
