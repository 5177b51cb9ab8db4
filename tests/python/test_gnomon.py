"""The Python package: shadows by one call, data as NumPy arrays, pictures as tests."""

import contextlib
import gc
import io
import os
import tempfile
import unittest
import warnings
from unittest import mock

import numpy
from vtkmodules.vtkCommonCore import vtkObject, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkFiltersSources import vtkPointSource, vtkSphereSource
from vtkmodules.util.vtkConstants import VTK_DOUBLE, VTK_FLOAT
from vtkmodules.vtkRenderingCore import vtkLight, vtkLightKit, vtkRenderer, vtkVolume
from vtkmodules.vtkRenderingOpenGL2 import (
    vtkCameraPass,
    vtkDepthOfFieldPass,
    vtkEDLShading,
    vtkGaussianBlurPass,
    vtkPanoramicProjectionPass,
    vtkRenderPassCollection,
    vtkRenderStepsPass,
    vtkSequencePass,
    vtkShadowMapPass,
    vtkSobelGradientMagnitudePass,
)
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401

import gnomon
from gnomon.images import _pixels
from gnomon.lighting import lights_of
from scene import Scene, add


class Shadows(unittest.TestCase):
    def test_one_call_shows_exact_shadows(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer)
        shadows.KeepVisibilityOn()
        scene.window.Render()
        report = gnomon.report(shadows)
        self.assertEqual(report["lights"][0]["technique"], "silhouette")
        self.assertIn("rests", report["choice"])
        arrays = gnomon.visibility(shadows)
        self.assertEqual(arrays["light 0"].shape, (90, 120))
        self.assertEqual(arrays["position"].shape, (90, 120, 3))
        covered = arrays["coverage"] == 1
        # The ball's shadow lies on the side away from the sun.
        dark = covered & (arrays["light 0"] == 0) & (arrays["position"][..., 2] < 1e-6)
        self.assertGreater(dark.sum(), 50)
        self.assertLess(arrays["position"][dark][:, 0].mean(), -0.4)
        # The floor is the first prop, of one cell, the ball the second, of many.
        on_floor = covered & (arrays["position"][..., 2] < 1e-6)
        for name, kind in (("prop", "i"), ("cell", "i")):
            self.assertEqual((arrays[name].shape, arrays[name].dtype.kind), ((90, 120), kind))
            self.assertTrue((arrays[name][on_floor] == 0).all())
            self.assertTrue((arrays[name][~covered] == -1).all())
        self.assertTrue((arrays["prop"][covered & ~on_floor] == 1).all())
        self.assertGreater(len(numpy.unique(arrays["cell"][covered & ~on_floor])), 20)

    def test_arrays_outlive_frames_and_the_pass(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer, light_radius=2.0)
        shadows.KeepVisibilityOn()
        scene.window.Render()
        first = gnomon.visibility(shadows)["light 0"]
        copy = first.copy()
        scene.ball.SetPosition(0.3, 0, 0)
        scene.window.Render()
        second = gnomon.visibility(shadows)["light 0"]
        self.assertTrue((first == copy).all())
        self.assertFalse((first == second).all())
        gnomon.remove_shadows(scene.renderer)
        del shadows, scene
        gc.collect()
        self.assertTrue((first == copy).all())

    def test_wrong_settings_are_errors_while_warnings_are_off(self):
        for shown in (True, False):
            vtkObject.SetGlobalWarningDisplay(shown)
            try:
                for settings in ({"technique": "silhouete"}, {"light_radius": -3}, {"kernel": 1}):
                    with self.subTest(settings=settings), self.assertRaises(ValueError):
                        gnomon.add_shadows(vtkRenderer(), **settings)
                self.assertEqual(vtkObject.GetGlobalWarningDisplay(), shown)
            finally:
                vtkObject.GlobalWarningDisplayOn()

    def test_settings_say_why_they_are_refused(self):
        light = vtkLight()
        shadows = gnomon.vtkGnomonShadowPass()
        vtkObject.GlobalWarningDisplayOff()
        try:
            for taker, given in (
                (shadows, ()),
                (shadows.GetSettings(), ()),
                (gnomon.vtkGnomonLightKeys, (light,)),
            ):
                with self.subTest(taker=taker):
                    with self.assertRaisesRegex(ValueError, "Invalid value 'wide'"):
                        taker.SetSetting(*given, "map_size", "wide")
                    self.assertIn("Invalid value 'wide'", taker.GetSettingError())
                    with self.assertRaisesRegex(ValueError, "no setting 'mapsize'"):
                        taker.SetSetting(*given, "mapsize", "512")
                    self.assertIn("no setting 'mapsize'", taker.GetSettingError())
                    self.assertTrue(taker.SetSetting(*given, "map_size", "512"))
                    self.assertEqual(taker.GetSettingError(), "")
        finally:
            vtkObject.GlobalWarningDisplayOn()

    def test_a_pass_s_messages_are_warnings_while_those_of_vtk_are_off(self):
        scene = Scene()
        scene.ball.GetProperty().SetRepresentationToWireframe()
        gnomon.add_shadows(scene.renderer)
        vtkObject.GlobalWarningDisplayOff()
        try:
            with self.assertWarnsRegex(UserWarning, "without shadows: .*wireframe"):
                scene.window.Render()
        finally:
            vtkObject.GlobalWarningDisplayOn()

    def test_why_prints_what_is_known(self):
        def said_of(renderer):
            with contextlib.redirect_stdout(io.StringIO()) as output:
                gnomon.why(renderer)
            return output.getvalue()

        scene = Scene()
        self.assertIn("drawn by no pass", said_of(scene.renderer))
        gnomon.add_shadows(scene.renderer)
        self.assertIn("Nothing was drawn yet", said_of(scene.renderer))
        scene.window.Render()
        self.assertIn("nothing is left out", said_of(scene.renderer))
        scene.ball.GetProperty().SetOpacity(0.5)
        head = vtkLight()
        head.SetLightTypeToHeadlight()
        scene.renderer.AddLight(head)
        scene.window.Render()
        said = said_of(scene.renderer)
        self.assertIn("Light 1 casts nothing: a headlight.", said)
        self.assertIn("is translucent and casts nothing unless its key asks, or Set", said)
        steps = vtkRenderStepsPass()
        scene.renderer.SetPass(steps)
        scene.window.Render()
        self.assertIn("drawn by vtkRenderStepsPass", said_of(scene.renderer))

    def test_a_report_outlives_its_window(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer)
        shadows.KeepVisibilityOn()
        scene.window.Render()
        report, seen = gnomon.report(shadows), gnomon.visibility(shadows)
        scene.window.Finalize()
        self.assertEqual(gnomon.report(shadows), report)
        self.assertTrue((gnomon.visibility(shadows)["light 0"] == seen["light 0"]).all())

    def test_removed_shadows_leave_no_observer(self):
        renderer = vtkRenderer()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for _ in range(50):
                gnomon.add_shadows(renderer)
                gnomon.remove_shadows(renderer)
        for event in ("DeleteEvent", "StartEvent"):
            self.assertFalse(renderer.HasObserver(event))

    def test_nothing_is_kept_unless_asked_for(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer)
        scene.window.Render()
        self.assertEqual(gnomon.visibility(shadows), {})

    def test_a_lone_headlight_gives_way_to_a_key_light(self):
        for has_headlight in (False, True):
            with self.subTest(has_headlight=has_headlight):
                scene = Scene(has_sun=False)
                if has_headlight:
                    scene.window.Render()  # VTK creates one
                with self.assertWarnsRegex(UserWarning, "key light"):
                    shadows = gnomon.add_shadows(scene.renderer)
                scene.window.Render()
                self.assertTrue(gnomon.report(shadows)["lights"][0]["casts"])
                gnomon.remove_shadows(scene.renderer)
                self.assertIsNone(scene.renderer.GetPass())
                self.assertTrue(scene.renderer.GetAutomaticLightCreation())
                scene.window.Render()
                lights = scene.renderer.GetLights()
                self.assertEqual(lights.GetNumberOfItems(), 1)
                self.assertTrue(lights.GetItemAsObject(0).LightTypeIsHeadlight())

    def test_an_untouched_light_kit_gives_way_and_comes_back(self):
        for is_drawn in (False, True):  # which moves the headlight to the camera
            with self.subTest(is_drawn=is_drawn):
                scene = Scene(has_sun=False)
                vtkLightKit().AddLightsToRenderer(scene.renderer)
                kit = lights_of(scene.renderer)
                self.assertEqual(len(kit), 5)
                if is_drawn:
                    scene.window.Render()
                with self.assertWarnsRegex(UserWarning, "kit gave way"):
                    shadows = gnomon.add_shadows(scene.renderer)
                scene.window.Render()
                casts = [light["casts"] for light in gnomon.report(shadows)["lights"]]
                self.assertEqual(casts.count(True), 1)
                self.assertEqual(len(lights_of(scene.renderer)), 2)
                gnomon.remove_shadows(scene.renderer)
                self.assertEqual(lights_of(scene.renderer), kit)

    def test_lights_of_programs_are_never_touched(self):
        def dim(lights):
            lights[1].SetIntensity(0.5)

        def turn(lights):
            lights[2].SetPosition(1, 0, 0)

        def cast(lights):
            gnomon.vtkGnomonLightKeys.SetCasts(lights[0], False)

        def add_one(_lights):
            scene.renderer.AddLight(vtkLight())

        def keep(_lights):
            pass

        for change, settings in (
            (dim, {}), (turn, {}), (cast, {}), (add_one, {}), (keep, {"light": None})
        ):
            with self.subTest(change=change.__name__), warnings.catch_warnings():
                warnings.simplefilter("error")
                scene = Scene(has_sun=False)
                vtkLightKit().AddLightsToRenderer(scene.renderer)
                change(lights_of(scene.renderer))
                before = lights_of(scene.renderer)
                state = [str(light) for light in before]
                gnomon.add_shadows(scene.renderer, **settings)
                self.assertEqual(lights_of(scene.renderer), before)
                gnomon.remove_shadows(scene.renderer)
                self.assertEqual([str(light) for light in lights_of(scene.renderer)], state)
        scene = Scene(has_sun=False)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            gnomon.add_shadows(scene.renderer, light=None)
        self.assertEqual(lights_of(scene.renderer), [])
        with self.assertRaisesRegex(ValueError, "light: found 'sun'"):
            gnomon.add_shadows(scene.renderer, light="sun")

    def test_lights_are_placed_for_the_first_picture(self):
        scene = Scene(has_sun=False)
        with self.assertWarns(UserWarning):
            gnomon.add_shadows(scene.renderer)
        key = lights_of(scene.renderer)[0]
        first = key.GetPosition()
        scene.renderer.GetActiveCamera().Azimuth(120)
        scene.window.Render()
        second = key.GetPosition()
        self.assertNotEqual(first, second)
        scene.renderer.GetActiveCamera().Azimuth(120)
        scene.window.Render()
        self.assertEqual(key.GetPosition(), second)

    def test_a_light_that_a_program_moved_stays(self):
        scene = Scene(has_sun=False)
        with self.assertWarns(UserWarning):
            gnomon.add_shadows(scene.renderer)
        key = lights_of(scene.renderer)[0]
        key.SetPosition(1, 2, 3)
        scene.renderer.GetActiveCamera().Azimuth(120)
        scene.window.Render()
        self.assertEqual(key.GetPosition(), (1, 2, 3))

    def test_the_first_picture_shows_its_shadow(self):
        for view in ((0, -5, 6), (0, -5, 1), (4, 4, 3), (0.1, 0, 8)):
            with self.subTest(view=view):
                scene = Scene(has_sun=False)
                scene.renderer.GetActiveCamera().SetPosition(view)
                scene.renderer.ResetCameraClippingRange()
                with self.assertWarns(UserWarning):
                    shadows = gnomon.add_shadows(scene.renderer)
                shadows.KeepVisibilityOn()
                scene.window.Render()
                arrays = gnomon.visibility(shadows)
                on_floor = (arrays["prop"] == 0) & (arrays["light 0"] == 0)
                on_ball = (arrays["prop"] == 1)
                self.assertGreater(on_floor.sum(), 20)
                self.assertGreater(arrays["light 0"][on_ball].mean(), 0.5)

    def test_a_headlight_stays_away_from_lights_that_came_meanwhile(self):
        def switch_key_off(renderer):
            renderer.GetLights().GetItemAsObject(0).SwitchOff()

        def add_light(renderer):
            renderer.AddLight(vtkLight())

        def set_light(renderer):
            renderer.RemoveAllLights()
            renderer.AddLight(vtkLight())

        def add_dark_light(renderer):
            dark = vtkLight()
            dark.SwitchOff()
            renderer.AddLight(dark)

        for change, comes_back, others in (
            (lambda _: None, True, 0),
            (switch_key_off, True, 0),
            (add_dark_light, True, 1),
            (add_light, False, 1),
            (set_light, False, 1),
            (vtkRenderer.RemoveAllLights, False, 0),
        ):
            with self.subTest(change=change.__name__):
                renderer = Scene(has_sun=False).renderer
                head = vtkLight()
                head.SetLightTypeToHeadlight()
                renderer.AddLight(head)
                with self.assertWarnsRegex(UserWarning, "key light"):
                    gnomon.add_shadows(renderer)
                change(renderer)
                gnomon.remove_shadows(renderer)
                lights = renderer.GetLights()
                self.assertEqual(bool(lights.IsItemPresent(head)), comes_back)
                self.assertEqual(lights.GetNumberOfItems(), others + comes_back)

    def test_shadows_are_added_again_and_removed(self):
        scene = Scene()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            gnomon.add_shadows(scene.renderer, "nsm")
            shadows = gnomon.add_shadows(scene.renderer, "raytraced")
        scene.window.Render()
        self.assertEqual(gnomon.report(shadows)["lights"][0]["technique"], "raytraced")
        gnomon.remove_shadows(scene.renderer)
        gnomon.remove_shadows(scene.renderer)
        self.assertIsNone(scene.renderer.GetPass())

    def test_the_former_state_outlives_python_s_names(self):
        window = Scene(has_sun=False).window  # keeps the renderer, whose wrapper goes

        def renderer():
            return window.GetRenderers().GetFirstRenderer()

        with self.assertWarns(UserWarning):
            gnomon.add_shadows(renderer())
        gc.collect()
        gnomon.remove_shadows(renderer())
        self.assertIsNone(renderer().GetPass())
        self.assertTrue(renderer().GetAutomaticLightCreation())

    def test_an_empty_renderer_gets_its_light_when_it_shows_something(self):
        renderer = vtkRenderer()
        window = gnomon.images._off_screen()
        window.SetSize(80, 60)
        window.AddRenderer(renderer)
        with self.assertWarns(UserWarning):
            shadows = gnomon.add_shadows(renderer)
        window.Render()
        ball = vtkSphereSource()
        ball.SetCenter(5, 5, 5)
        add(renderer, ball)
        renderer.ResetCamera()
        window.Render()
        key = renderer.GetLights().GetItemAsObject(0)
        self.assertNotEqual(key.GetPosition(), (0.0, 0.0, 1.0))
        self.assertTrue(gnomon.report(shadows)["lights"][0]["casts"])

    def test_a_single_point_is_nothing_to_place_a_light_for(self):
        renderer = vtkRenderer()
        point = vtkPointSource()
        point.SetNumberOfPoints(1)
        point.SetRadius(0)
        add(renderer, point)
        messages, previous = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
        vtkOutputWindow.SetInstance(messages)
        with self.assertWarns(UserWarning):
            gnomon.add_shadows(renderer)
        vtkOutputWindow.SetInstance(previous)
        self.assertEqual(messages.GetOutput(), "")

    def test_another_pass_is_left_alone(self):
        scene = Scene()
        gnomon.add_shadows(scene.renderer)
        other = gnomon.vtkGnomonShadowPass()
        scene.renderer.SetPass(other)
        gnomon.remove_shadows(scene.renderer)
        self.assertIs(scene.renderer.GetPass(), other)

    def test_vtk_s_shadows_give_way_and_come_back(self):
        scene = Scene()
        passes, sequence, camera, edges = (
            vtkRenderPassCollection(), vtkSequencePass(), vtkCameraPass(), vtkEDLShading()
        )
        maps = vtkShadowMapPass()
        for each in (maps.GetShadowMapBakerPass(), maps):
            passes.AddItem(each)
        sequence.SetPasses(passes)
        camera.SetDelegatePass(sequence)
        edges.SetDelegatePass(camera)
        scene.renderer.SetPass(edges)
        scene.window.Render()
        names = "vtkCameraPass around vtkSequencePass"
        with self.assertWarnsRegex(UserWarning, f"gave way to shadows: {names}[.]") as warned:
            shadows = gnomon.add_shadows(scene.renderer)
        self.assertEqual(warned.filename, __file__)
        self.assertIs(edges.GetDelegatePass(), shadows)
        gnomon.remove_shadows(scene.renderer)
        self.assertIs(scene.renderer.GetPass(), edges)
        self.assertIs(edges.GetDelegatePass(), camera)

    def test_passes_of_the_guide_stand_around_the_shadow_pass(self):
        for kind in (
            vtkEDLShading,
            vtkDepthOfFieldPass,
            vtkGaussianBlurPass,
            vtkSobelGradientMagnitudePass,
            vtkPanoramicProjectionPass,
        ):
            with self.subTest(kind=kind.__name__):
                scene = Scene()
                scene.renderer.GetActiveCamera().SetPosition(0, -2, 2)
                scene.renderer.ResetCameraClippingRange()

                def picture(inner):
                    outer = kind()
                    outer.SetDelegatePass(inner)
                    scene.renderer.SetPass(outer)
                    scene.window.Render()  # the first one is empty with depth of field
                    pixels = _pixels(scene.window).astype(int)
                    outer.ReleaseGraphicsResources(scene.window)
                    return pixels

                plain = picture(vtkRenderStepsPass())
                for technique in ("silhouette", "pcf"):
                    inner = gnomon.vtkGnomonShadowPass()
                    inner.SetTechnique(technique)
                    changed = (abs(plain - picture(inner)) > 30).any(axis=2)
                    self.assertTrue(40 < changed.sum() < 2500, changed.sum())

    def test_lights_that_give_none_do_not_count(self):
        scene = Scene(has_sun=False)
        dark = vtkLight()
        dark.SwitchOff()
        head = vtkLight()
        head.SetLightTypeToHeadlight()
        scene.renderer.AddLight(dark)
        scene.renderer.AddLight(head)
        with self.assertWarns(UserWarning):
            gnomon.add_shadows(scene.renderer)
        gnomon.remove_shadows(scene.renderer)
        gnomon.vtkGnomonLightKeys.SetCasts(head, True)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            gnomon.add_shadows(scene.renderer)

    def test_a_plotter_is_its_active_renderer(self):
        scene = Scene()

        class Plotter:
            renderer = scene.renderer

        shadows = gnomon.add_shadows(Plotter())
        self.assertIs(scene.renderer.GetPass(), shadows)

    def test_objects_that_hold_a_vtk_object_stand_for_it(self):
        scene = Scene()

        def holder(name, held):
            return type("Holder", (), {name: held})()

        wrapped = holder("_vtk_obj", scene.renderer)  # as tvtk's
        figure = holder("scene", holder("renderer", wrapped))  # as Mayavi's
        for target in (wrapped, figure.scene, figure):
            shadows = gnomon.add_shadows(target)
            self.assertIs(scene.renderer.GetPass(), shadows)
            gnomon.remove_shadows(target)
            self.assertIsNone(scene.renderer.GetPass())

        mesh = holder("actor", scene.ball)  # as vedo's
        surface = holder("actor", holder("actor", holder("_vtk_obj", scene.ball)))  # as Mayavi's
        surface.scene = figure.scene
        props = gnomon.vtkGnomonPropKeys
        for prop in (mesh, surface):
            props.SetCasts(prop, False)
            self.assertFalse(props.GetCasts(scene.ball))
            props.SetCasts(scene.ball, True)
            self.assertTrue(props.GetCasts(prop))

        sun = scene.renderer.GetLights().GetItemAsObject(0)
        lamp = holder("source", holder("_vtk_obj", sun))  # as Mayavi's
        gnomon.vtkGnomonLightKeys.SetTechnique(lamp, "pcf")
        self.assertEqual(gnomon.vtkGnomonLightKeys.GetTechnique(sun), "pcf")
        gnomon.vtkGnomonLightPlacement.SetPitchAndYaw(lamp, -90, 0)
        self.assertEqual(sun.GetPosition()[0], 0)
        with self.assertRaisesRegex(TypeError, "found Mock"):  # holds objects without end
            gnomon.add_shadows(mock.Mock())
        with self.assertRaises((TypeError, ValueError)):  # VTK's words differ, by release
            props.SetCasts(holder("actor", None), True)

    def test_mistakes_change_nothing(self):
        scene = Scene(has_sun=False)
        with self.assertRaisesRegex(TypeError, "`_vtk_obj`, found str"):
            gnomon.add_shadows("renderer")
        with self.assertRaisesRegex(TypeError, "found vtkOpenGLLight"):
            gnomon.add_shadows(vtkLight())
        with self.assertRaisesRegex(ValueError, "kernel_sise"):
            gnomon.add_shadows(scene.renderer, kernel_sise=3)
        with self.assertRaisesRegex(ValueError, "technique"):
            gnomon.add_shadows(scene.renderer, "magic")
        self.assertIsNone(scene.renderer.GetPass())
        self.assertEqual(scene.renderer.GetLights().GetNumberOfItems(), 0)

    def test_a_setting_that_a_technique_lacks_is_said(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer, "nsm", kernel_size=3)
        scene.window.Render()
        self.assertIn("kernel_size", gnomon.report(shadows)["misfits"][0])

    def test_keys_of_lights(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer)
        light = scene.renderer.GetLights().GetItemAsObject(0)
        gnomon.vtkGnomonLightKeys.SetTechnique(light, "pcf")
        scene.window.Render()
        self.assertEqual(gnomon.report(shadows)["lights"][0]["technique"], "pcf")

    def test_settings_with_types(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer)
        settings = shadows.GetSettings()
        settings.SetTechnique("pcf")
        settings.SetKernelToBox()
        settings.SetKernelSize(5)
        scene.window.Render()
        light = gnomon.report(shadows)["lights"][0]
        self.assertEqual((light["technique"], light["kernel"]), ("pcf", "box"))
        self.assertEqual(settings.GetKernel(), gnomon.vtkGnomonShadowSettings.KERNEL_BOX)
        names = [settings.GetSettingName(i) for i in range(settings.GetNumberOfSettings())]
        self.assertIn("kernel_size", names)

    def test_progress_events_reach_python(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer, "penumbra", light_radius=5, moving_samples=4)
        told = []

        def note(_caller, _event, shown):
            told.append(shown)

        note.CallDataType = VTK_DOUBLE
        shadows.AddObserver("ProgressEvent", note)
        while shadows.GetProgress() < 1 or not told:
            scene.window.Render()
        self.assertEqual(told[-1], 1.0)
        self.assertEqual(len(told), 3)

    def test_reports_are_tables(self):
        from vtkmodules.vtkCommonDataModel import vtkTable

        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer)
        scene.window.Render()
        table = vtkTable()
        shadows.GetReportTable(table)
        self.assertEqual(table.GetNumberOfRows(), 1)
        self.assertEqual(table.GetValueByName(0, "technique").ToString(), "silhouette")
        self.assertEqual(table.GetValueByName(0, "casts").ToDouble(), 1.0)


    def test_glass_lets_light_through(self):
        scene = Scene()
        scene.ball.GetProperty().SetOpacity(0.5)

        def shades(glass):
            shadows = gnomon.add_shadows(scene.renderer, glass=glass)
            shadows.KeepVisibilityOn()
            scene.window.Render()
            seen = gnomon.visibility(shadows)
            light = next(name for name in seen if name.startswith("light"))
            return set(numpy.unique(seen[light].round(4)).tolist())

        self.assertLessEqual(shades(False), {0.0, 1.0})
        self.assertIn(0.25, shades(True))  # two walls of the ball

    def test_volumes_cast(self):
        scene = Scene()
        smoke = vtkImageData()
        smoke.SetDimensions(2, 2, 2)
        smoke.SetOrigin(-3.0, -3.0, 1.5)
        smoke.SetSpacing(6.0, 6.0, 1.0)
        smoke.AllocateScalars(VTK_FLOAT, 1)
        smoke.GetPointData().GetScalars().Fill(1.0)
        smoke.SetScalarComponentFromDouble(0, 0, 0, 0, 0.0)
        opacity = vtkPiecewiseFunction()
        opacity.AddPoint(0.0, 0.5)
        volume = vtkVolume()
        volume.SetMapper(vtkFixedPointVolumeRayCastMapper())
        volume.GetMapper().SetInputData(smoke)
        volume.GetProperty().SetScalarOpacity(opacity)
        scene.renderer.AddVolume(volume)

        def shades(volumes):
            shadows = gnomon.add_shadows(scene.renderer, volumes=volumes)
            shadows.KeepVisibilityOn()
            scene.window.Render()
            seen = gnomon.visibility(shadows)
            light = next(name for name in seen if name.startswith("light"))
            return numpy.unique(seen[light].round(3)).tolist()

        self.assertLessEqual(set(shades(False)), {0.0, 1.0})
        self.assertTrue(any(0.1 < value < 0.6 for value in shades(True)))

    def test_a_sky(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer, sky=0.4)
        self.assertEqual(shadows.GetSkyIntensity(), 0.4)
        scene.window.Render()
        self.assertEqual(gnomon.report(shadows)["sky_progress"], 1)
        with self.assertRaisesRegex(ValueError, "SkyIntensity"):
            gnomon.add_shadows(scene.renderer, sky=-1)
        self.assertIs(scene.renderer.GetPass(), shadows)


class Data(unittest.TestCase):
    """A square of two triangles under a smaller, higher one that shades one of its middles."""

    floor = ([[0, 0, 0], [3, 0, 0], [3, 3, 0], [0, 3, 0]], [[0, 1, 2], [0, 2, 3]])
    roof = ([[1.5, 0.5, 1], [2.5, 0.5, 1], [2.5, 1.5, 1], [1.5, 1.5, 1]], [[0, 1, 2], [0, 2, 3]])
    suns = [[0, 0, 1], [0, 0, 2], [1, 0, 0.5], [0, 0, -1]]

    def test_hours_of_triangles(self):
        hours = gnomon.hours_lit(self.floor, self.suns, [1.0, 2.0, 4.0, 8.0], casters=self.roof)
        self.assertEqual(list(hours), [4.0, 7.0])
        self.assertEqual(list(gnomon.hours_lit(self.floor, self.suns)), [3.0, 3.0])

    def test_samples_see_parts(self):
        (hours, _) = gnomon.hours_lit(self.floor, [[0, 0, 1]], casters=self.roof, samples=4096)
        self.assertAlmostEqual(hours, 1 - 1 / 4.5, delta=0.005)  # the roof covers 1 of 4.5

    def test_a_year_of_suns(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkDoubleArray

        sun = gnomon.vtkGnomonSun()
        sun.SetPlace(52.52, 13.405)
        sun.SetDate(2026, 6, 21)
        sun.SetTime(12, 0, 0.0, 2.0)
        directions, hours = vtkDoubleArray(), vtkDoubleArray()
        sun.MakeDayPath(10.0, directions, hours)
        lit = gnomon.hours_lit(self.floor, vtk_to_numpy(directions), vtk_to_numpy(hours))
        self.assertTrue(16.5 < lit[0] < 17.0, lit)  # the longest day in Berlin: 16.8 hours

    def test_the_path_of_a_day_is_the_sun_s(self):
        directions, hours = gnomon.sun_path(52.52, 13.405, "2026-12-21", minutes=30, zone=1)
        self.assertEqual(directions.shape, (len(hours), 3))
        self.assertTrue(7.2 < hours.sum() < 7.8, hours.sum())  # the shortest day in Berlin
        noon = directions[directions[:, 2].argmax()]
        self.assertTrue(abs(noon[0]) < 0.1 and noon[1] < 0, noon)  # in the south
        self.assertAlmostEqual(noon[2], numpy.sin(numpy.radians(90 - 52.52 - 23.44)), delta=0.002)

    def test_a_wall_hides_half_of_the_sky(self):
        wall = ([[1, -999, 0], [1, 999, 0], [1, 0, 999]], [[0, 1, 2]])
        ground = ([[0, 0, 0], [0.01, 0, 0], [0, 0.01, 0]], [[0, 1, 2]])
        for model in ("uniform", "dome", "overcast"):
            (view,), (error,) = gnomon.sky_view(ground, casters=[wall], model=model)
            self.assertAlmostEqual(view, 0.5, delta=0.01)
            self.assertTrue(0 < error < 0.01, error)
        facade = ([[0, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2]])  # looks at the wall
        view, error = gnomon.sky_view(facade, casters=[wall], model="overcast")
        self.assertAlmostEqual(view[0], 0, delta=0.01)
        from vtkmodules.vtkFiltersSources import vtkPlaneSource

        polydata = vtkPlaneSource()
        polydata.Update()
        (view,), _ = gnomon.sky_view(polydata.GetOutput(), [wall, self.roof], distance=1e-3)
        self.assertEqual(view, 1.0)

    def test_patches_of_the_sky_are_seen_or_hidden(self):
        wall = ([[1, -999, 0], [1, 999, 0], [1, 0, 999]], [[0, 1, 2]])
        facade = ([[0, 0, 0], [0.01, 0, 0], [0, 0.01, 0]], [[0, 1, 2]])
        seen, directions, angles = gnomon.sky_patches(facade, casters=[wall])
        self.assertEqual((seen.shape, seen.dtype), ((1, 145), bool))
        self.assertAlmostEqual(angles.sum(), 2 * numpy.pi)
        self.assertTrue(numpy.allclose(numpy.linalg.norm(directions, axis=1), 1))
        self.assertTrue(seen[:, directions[:, 0] < -1e-9].all())
        self.assertFalse(seen[:, directions[:, 0] > 0.5].any())

    def test_a_picture_of_arrays(self):
        # Seen from above, a roof of 1 x 1 beside its shadow, over a floor of 3 x 3.
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "roof.png")
            gnomon.draw([self.floor, self.roof], [1, 0, 1], path, [0, 0, 1], size=(200, 160))
            picture = _pixels(path).astype(int)
        self.assertEqual(picture.shape, (160, 200, 3))
        dark = (picture.max(axis=2) < 80).sum()
        shown = (picture != picture[0, 0]).any(axis=2).sum()
        self.assertAlmostEqual(dark / shown, 1 / 9, delta=0.005)

    def test_mistakes_are_said(self):
        for call, what in (
            (lambda: gnomon.sun_path(91, 0, "2026-12-21"), "no place"),
            (lambda: gnomon.sun_path(0, 0, "2026-02-30"), "day"),
            (lambda: gnomon.sun_path(0, 0, "2026-02-20", minutes=0), "step"),
            (lambda: gnomon.draw([self.floor], [0, 1], "x.png"), "direction: expected"),
            (lambda: gnomon.draw([self.floor], [0, 0, 1], "x.png", technique="none"), "."),
            (lambda: gnomon.hours_lit(self.floor, [[0, 0]]), "directions: expected"),
            (lambda: gnomon.hours_lit(self.floor, self.suns, [1]), "hours: expected"),
            (lambda: gnomon.hours_lit((self.floor[0], [[0, 1, 9]]), self.suns), "found 0 to 9"),
            (lambda: gnomon.hours_lit(self.floor, [[0, 0, 0]]), "."),
            (lambda: gnomon.hours_lit(self.floor, self.suns, [1, 2, 3, -4]), "."),
            (lambda: gnomon.sky_view(self.floor, [self.roof], "cloudy"), "model: found"),
            (lambda: gnomon.sky_view(self.floor, directions=100), "power of two"),
            (lambda: gnomon.sky_view(self.floor, [([[0, 0]], [])]), r"casters\[0\]' points"),
            (lambda: gnomon.sky_view(self.floor, distance=-1.0), "SkyDistance"),
            (lambda: gnomon.sky_view(self.floor, model="dome", up=(0, 0, 0)), "horizon"),
            (lambda: gnomon.sky_patches(self.floor, up=(0, 0, 0)), "up: expected"),
            (lambda: gnomon.sky_patches(self.floor, north=(0, 0, 1)), "north: .*two directions"),
        ):
            with self.assertRaisesRegex(ValueError, what):
                call()


class Images(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.baseline = os.path.join(self.folder.name, "ball.png")
        self.scene = Scene()
        gnomon.add_shadows(self.scene.renderer)
        self.scene.window.Render()
        with mock.patch.dict(os.environ, {"GNOMON_REFRESH_BASELINES": "1"}):
            gnomon.assert_images_equal(self.scene.window, self.baseline)

    def tearDown(self):
        self.folder.cleanup()

    def test_the_same_is_equal(self):
        gnomon.assert_images_equal(self.scene.window, self.baseline)
        gnomon.assert_images_equal(self.baseline, self.baseline)

    def test_others_are_not(self):
        self.scene.ball.SetPosition(0.2, 0, 0)
        with self.assertRaisesRegex(AssertionError, r"\d+ pixels differ"):
            gnomon.assert_images_equal(self.scene.window, self.baseline, max_difference=8)
        kept = self.baseline.replace(".png", "-actual.png")
        gnomon.assert_images_equal(kept, kept)
        gnomon.assert_images_equal(self.scene.window, self.baseline, 8, max_pixels=120 * 90)

    def test_sizes_and_files(self):
        with self.assertRaisesRegex(AssertionError, "120 x 90"):
            gnomon.assert_images_equal(numpy.zeros((4, 5, 3), numpy.uint8), self.baseline)
        with self.assertRaisesRegex(AssertionError, "no such picture"):
            gnomon.assert_images_equal(self.scene.window, self.baseline + ".none")
        for shape, kind in (((4, 5, 4), numpy.uint8), ((4, 5, 3), float), ((4, 5), numpy.uint8)):
            with self.assertRaisesRegex(ValueError, "found"):
                gnomon.assert_images_equal(numpy.zeros(shape, kind), self.baseline)


if __name__ == "__main__":
    unittest.main()
