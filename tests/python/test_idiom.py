"""The package as Python programs meet it: attributes, dicts, `with`, help() and metadata."""

import contextlib
import importlib.metadata
import io
import math
import pydoc
import typing
import unittest
import warnings

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkRenderingCore import vtkLight, vtkLightKit
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass

import gnomon
from gnomon.attributes import Attribute
from gnomon.catalogue import Technique
from gnomon.images import _pixels
from gnomon.lighting import lights_of
from scene import Scene


def attributes():
    kind = gnomon.vtkGnomonShadowPass
    return {name: it for name, it in vars(kind).items() if isinstance(it, Attribute)}


class Attributes(unittest.TestCase):
    def test_attributes_are_what_the_methods_set(self):
        shadows = gnomon.vtkGnomonShadowPass()
        shadows.keep_visibility = True
        self.assertTrue(shadows.GetKeepVisibility())
        shadows.SetMaximumError(0.25)
        self.assertEqual(shadows.maximum_error, 0.25)
        shadows.sky_color = numpy.array((0.5, 0.25, 1.0))
        self.assertEqual(shadows.GetSkyColor(), (0.5, 0.25, 1.0))
        shadows.kernel_size = numpy.int64(5)
        self.assertEqual(shadows.GetSettings().GetKernelSize(), 5)
        shadows.SetSetting("snap", "off")
        self.assertIs(shadows.snap, False)
        for value in (True, 1, numpy.bool_(True), "on"):
            shadows.snap = False
            shadows.snap = value
            self.assertIs(shadows.snap, True)
        steps = vtkRenderStepsPass()
        shadows.delegate_pass = steps
        self.assertIs(shadows.GetDelegatePass(), steps)
        self.assertEqual(shadows.progress, 1.0)

    def test_each_attribute_takes_what_it_gives(self):
        shadows = gnomon.vtkGnomonShadowPass()
        self.assertGreater(len(attributes()), 70)
        for name, attribute in attributes().items():
            self.assertTrue(attribute.__doc__, name)
            if attribute.fset is None:
                continue
            value = getattr(shadows, name)
            setattr(shadows, name, value)
            self.assertEqual(getattr(shadows, name), value, name)

    def test_enumerations_have_names_and_vtk_s_numbers(self):
        shadows = gnomon.vtkGnomonShadowPass()
        kind = gnomon.vtkGnomonShadowPass
        for name, choices, of in (
            ("route", ("auto", "inline", "image", "deferred"), kind.GetRoute),
            ("casting", ("auto", "all", "brightest"), kind.GetCasting),
            ("interactive", ("auto", "off", "on"), kind.GetInteractive),
            ("sky_model", ("uniform", "dome", "overcast"), kind.GetSkyModel),
        ):
            for number, choice in enumerate(choices):
                setattr(shadows, name, choice)
                self.assertEqual((of(shadows), getattr(shadows, name)), (number, choice))
                setattr(shadows, name, 0)
                setattr(shadows, name, number)
                self.assertEqual(getattr(shadows, name), choice)

    def test_wrong_values_are_refused_by_name(self):
        shadows = gnomon.vtkGnomonShadowPass()
        for name, value in (
            ("route", "images"),
            ("casting", None),
            ("keep_visibility", "off"),
            ("keep_visibility", 2),
            ("maximum_error", 2.0),
            ("maximum_error", math.nan),
            ("time_budget", math.inf),
            ("sky_intensity", "bright"),
            ("sky_color", (1, 2)),
            ("sky_directions", 100),
            ("sky_directions", 2**40),
            ("technique", "magic"),
            ("technique", None),
            ("light_radius", math.nan),
            ("light_radius", -1),
            ("kernel_size", 2.5),
            ("kernel_size", [3]),
            ("snap", "maybe"),
            ("edge_samples", 5),
        ):
            before = getattr(shadows, name)
            with self.subTest(name=name, value=value):
                with self.assertRaisesRegex((TypeError, ValueError), f"^{name}: .*expected"):
                    setattr(shadows, name, value)
                self.assertEqual(getattr(shadows, name), before)

    def test_a_name_that_is_none_is_an_error_with_the_nearest_one(self):
        shadows = gnomon.vtkGnomonShadowPass()
        with self.assertRaisesRegex(AttributeError, "'kernel_sise', is it 'kernel_size'"):
            shadows.kernel_sise = 3
        with self.assertRaisesRegex(AttributeError, "progress"):
            shadows.progress = 0.5
        with self.assertRaisesRegex(ValueError, "'progress'"):
            gnomon.add_shadows(Scene().renderer, progress=0.5)

    def test_a_pass_that_only_its_renderer_holds_keeps_its_attributes(self):
        renderer = Scene().renderer
        gnomon.add_shadows(renderer)
        gnomon._before.clear()
        renderer.GetPass().light_radius = 0.5
        self.assertEqual(renderer.GetPass().light_radius, 0.5)


class Catalogue(unittest.TestCase):
    def test_techniques_are_those_that_lights_take(self):
        shadows = gnomon.vtkGnomonShadowPass()
        techniques = gnomon.techniques()
        self.assertEqual(list(techniques), list(typing.get_args(Technique)))
        for name, meaning in techniques.items():
            self.assertGreater(len(meaning), 20)
            self.assertNotIn("\n", meaning)
            shadows.technique = name
            self.assertEqual(shadows.GetTechnique(), name)

    def test_settings_are_what_lights_take(self):
        settings = gnomon.settings()
        typed = gnomon.vtkGnomonShadowSettings
        names = [typed.GetSettingName(i) for i in range(typed.GetNumberOfSettings())]
        self.assertEqual(list(settings), names)
        shadows = gnomon.vtkGnomonShadowPass()
        for name, setting in settings.items():
            with self.subTest(name=name):
                self.assertEqual(list(setting), ["type", "range", "unit", "default", "meaning",
                                                 "techniques"])
                self.assertEqual(getattr(shadows, name), setting["default"])
                self.assertLessEqual(set(setting["techniques"]), set(gnomon.techniques()))
                inside = [value for value in setting["range"] if value not in ("", math.inf)]
                for value in inside:
                    setattr(shadows, name, value)
                    self.assertEqual(getattr(shadows, name), value)
                    self.assertEqual(type(value).__name__, setting["type"]
                                     if setting["type"] != "choice" else type(value).__name__)
                beyond = [-1, math.nan, "none of these"]
                if setting["type"] in ("int", "float"):
                    beyond.append(setting["range"][1] + 1)
                for value in beyond:
                    with self.assertRaisesRegex((TypeError, ValueError), f"^{name}: "):
                        setattr(shadows, name, value)
        self.assertEqual(settings["contour"]["techniques"], ("selective",))
        self.assertEqual(settings["map_size"]["unit"], "texels")
        self.assertEqual(settings["light_radius"]["range"], (0.0, math.inf))
        self.assertEqual(settings["technique"]["default"], "auto")

    def test_dicts_are_the_caller_s_own(self):
        gnomon.settings()["map_size"].clear()
        gnomon.techniques().clear()
        self.assertTrue(gnomon.settings()["map_size"] and gnomon.techniques())

    def test_settings_of_lights_take_numbers(self):
        light, shadows = vtkLight(), gnomon.vtkGnomonShadowPass()
        keys = gnomon.vtkGnomonLightKeys
        for name, number, text in (
            ("light_radius", 0.5, "0.5"),
            ("light_radius", 2, "2"),
            ("light_radius", numpy.float64(0.1), "0.1"),
            ("light_seed", 1000000, "1000000"),
            ("light_radius", 1e6, "1000000"),
            ("light_radius", 1e12, "1e+12"),
            ("edge_samples", 4, "4"),
            ("snap", False, "off"),
            ("snap", 1, "on"),
        ):
            with self.subTest(name=name, number=number):
                self.assertTrue(keys.SetSetting(light, name, number))
                self.assertEqual(keys.GetSetting(light, name), text)
                for taker in (shadows, shadows.GetSettings()):
                    self.assertTrue(taker.SetSetting(name, number))
                    self.assertEqual(float(taker.GetSetting(name).replace("off", "0")
                                           .replace("on", "1")), number)
        self.assertTrue(keys.SetSetting(light, "snap", None))
        self.assertIsNone(keys.GetSetting(light, "snap"))


class Shadows(unittest.TestCase):
    def test_shadows_last_as_long_as_their_block(self):
        scene = Scene()
        with gnomon.shadows(scene.renderer, "pcf", kernel_size=5) as shadows:
            self.assertIs(scene.renderer.GetPass(), shadows)
            self.assertEqual((shadows.technique, shadows.kernel_size), ("pcf", 5))
        self.assertIsNone(scene.renderer.GetPass())
        with self.assertRaisesRegex(RuntimeError, "x"), gnomon.shadows(scene.renderer):
            raise RuntimeError("x")
        self.assertIsNone(scene.renderer.GetPass())

    def test_other_shadows_come_back_after_a_block(self):
        scene = Scene(has_sun=False)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            first = gnomon.add_shadows(scene.renderer)
            lights = lights_of(scene.renderer)
            with gnomon.shadows(scene.renderer, "nsm") as inner:
                self.assertIs(scene.renderer.GetPass(), inner)
        self.assertIs(scene.renderer.GetPass(), first)
        self.assertEqual(lights_of(scene.renderer), lights)
        gnomon.remove_shadows(scene.renderer)
        self.assertEqual((scene.renderer.GetPass(), lights_of(scene.renderer)), (None, []))
        with self.assertRaises(ValueError), gnomon.shadows(scene.renderer, "magic"):
            pass

    def test_a_block_that_cannot_begin_leaves_other_shadows(self):
        scene = Scene()
        first = gnomon.add_shadows(scene.renderer)
        with self.assertRaises(ValueError), gnomon.shadows(scene.renderer, "magic"):
            pass
        self.assertIs(scene.renderer.GetPass(), first)
        gnomon.remove_shadows(scene.renderer)
        self.assertIsNone(scene.renderer.GetPass())

    def test_a_key_and_a_fill_light_take_the_place_of_all(self):
        scene = Scene()
        kit = vtkLightKit()
        kit.AddLightsToRenderer(scene.renderer)
        before = lights_of(scene.renderer)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            gnomon.add_shadows(scene.renderer, light="key+fill")
        self.assertEqual(len(lights_of(scene.renderer)), 2)
        self.assertFalse(set(lights_of(scene.renderer)) & set(before))
        gnomon.remove_shadows(scene.renderer)
        self.assertEqual(lights_of(scene.renderer), before)

    def test_keywords_are_the_pass_s_attributes(self):
        shadows = gnomon.add_shadows(
            Scene().renderer, keep_visibility=True, casting="brightest", sky=0.4, route="image"
        )
        self.assertEqual(
            (shadows.keep_visibility, shadows.casting, shadows.sky_intensity, shadows.route),
            (True, "brightest", 0.4, "image"),
        )

    def test_reports_and_arrays_of_what_has_shadows(self):
        scene = Scene()
        plotter = type("Plotter", (), {"renderer": scene.renderer})()
        shadows = gnomon.add_shadows(plotter, keep_visibility=True)
        scene.window.Render()
        for target in (scene.renderer, plotter):
            self.assertEqual(gnomon.report(target), gnomon.report(shadows))
            self.assertEqual(gnomon.visibility(target).keys(), gnomon.visibility(shadows).keys())
        gnomon.remove_shadows(plotter)
        for function in (gnomon.report, gnomon.visibility):
            with self.assertRaisesRegex(ValueError, "shadows: .*add_shadows"):
                function(plotter)

    def test_arrays_begin_at_the_bottom_or_at_the_top(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer, keep_visibility=True)
        scene.window.Render()
        lower = gnomon.visibility(shadows)
        upper = gnomon.visibility(shadows, origin="upper", fill=math.nan)
        rows, columns = numpy.nonzero(lower["coverage"])
        y = lower["position"][rows, columns][:, 1]
        self.assertLess(y[rows < 30].mean(), y[rows > 60].mean())  # the camera looks to +y
        for name, array in lower.items():
            covered = lower["coverage"] == 1
            turned = upper[name][::-1]
            self.assertTrue((turned[covered] == array[covered]).all(), name)
            if array.dtype.kind == "f" and name != "coverage":
                self.assertTrue(numpy.isnan(turned[~covered]).all(), name)
        self.assertTrue((upper["prop"][::-1] == lower["prop"]).all())
        self.assertTrue((upper["coverage"][::-1] == lower["coverage"]).all())
        self.assertFalse(lower["coverage"].all())
        with self.assertRaisesRegex(ValueError, "origin: found 'top'"):
            gnomon.visibility(shadows, origin="top")

    @unittest.skipUnless(hasattr(gnomon, "vtkGnomonEGLRenderWindow"), "built without EGL")
    def test_a_window_is_a_picture_in_notebooks(self):
        scene = Scene()
        gnomon.add_shadows(scene.renderer)
        png = scene.window._repr_png_()
        reader = vtkPNGReader()
        reader.SetMemoryBuffer(png)
        reader.SetMemoryBufferLength(len(png))
        reader.Update()
        data = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
        self.assertTrue((data.reshape(90, 120, 3)[::-1] == _pixels(scene.window)).all())


class Package(unittest.TestCase):
    def test_the_version_is_the_metadata_s(self):
        self.assertRegex(gnomon.__version__, r"^\d+\.\d+\.\d+$")
        self.assertEqual(importlib.metadata.version("gnomon"), gnomon.__version__)

    def test_dir_shows_what_there_is(self):
        modules = (gnomon.GnomonLights, gnomon.GnomonPlugin)
        classes = {name for module in modules for name in vars(module) if name[:3] == "vtk"}
        classes -= {"vtkGnomonNamedSettings"}  # a superclass
        self.assertEqual(sorted(dir(gnomon)), sorted([*gnomon.__all__, *classes, "__version__"]))
        self.assertLessEqual({"draw", "hours_lit", "sky_view", "sun_path"}, set(dir(gnomon)))
        for name in dir(gnomon):
            self.assertTrue(hasattr(gnomon, name), name)

    def test_help_begins_with_a_program_and_functions_and_is_short(self):
        text = pydoc.plain(pydoc.render_doc(gnomon))
        self.assertLess(len(text.splitlines()), 600)
        program, _, functions = gnomon.__doc__.partition("\n\n")[2].partition("\n\nadd_shadows")
        self.assertEqual(len(program.splitlines()), 10)
        self.assertEqual(len(("add_shadows" + functions.partition("\n\n")[0]).splitlines()), 5)
        for name in dir(gnomon):
            if name != "__version__":
                self.assertIn(name, text)

    def test_star_imports_and_help_of_classes_do(self):
        names = {}
        exec("from gnomon import *", names)
        self.assertIn("hours_lit", names)
        with contextlib.redirect_stdout(io.StringIO()) as output:
            pydoc.help(gnomon.vtkGnomonShadowPass.casting)
        self.assertIn("SetCasting", output.getvalue())


if __name__ == "__main__":
    unittest.main()
