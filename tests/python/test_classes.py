"""The wrapped classes: a getter beside each setter, and events."""

import inspect
import re
import unittest

from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkLight

import gnomon
from scene import Scene

# Setters whose values are got one by one, and those that only others call.
GETTERS = {
    "vtkGnomonSun.SetDate": ["GetYear", "GetMonth", "GetDay"],
    "vtkGnomonSun.SetTime": ["GetHour", "GetMinute", "GetSecond", "GetZoneHours"],
    "vtkGnomonSun.SetPlace": ["GetLatitude", "GetLongitude"],
    "vtkGnomonSun.SetAir": ["GetPressure", "GetTemperature"],
    "vtkGnomonSun.SetNorthAndUp": ["GetNorth", "GetUp"],
    # Many directions at once.
    "vtkGnomonVisibilityFilter.AddDirections": ["GetNumberOfLights", "GetDirection", "GetHours"],
    "vtkGnomonVisibilityFilter.AddSunDay": ["GetNumberOfLights", "GetDirection", "GetHours"],
    "vtkGnomonVisibilityFilter.AddSunYear": ["GetNumberOfLights", "GetDirection", "GetHours"],
    "vtkGnomonShadowPass.SetShaderParameters": [],  # mappers call it
}


def own_methods(kind):
    return [name for name, value in vars(kind).items() if inspect.isroutine(value)]


class Getters(unittest.TestCase):
    def test_each_setter_has_a_getter(self):
        classes = [getattr(gnomon, name) for name in gnomon.__all__ if name.startswith("vtk")]
        setters = 0
        unused = set(GETTERS)
        for kind in classes:
            for name in own_methods(kind):
                match = re.fullmatch("(?:Set|Add)([A-Z].*)", name)
                if not match:
                    continue
                setters += 1
                key = f"{kind.__name__}.{name}"
                unused.discard(key)
                # SetKernelToBox is a value of SetKernel.
                of = re.fullmatch("(.*?)To[A-Z0-9].*", match[1])
                enumerated = of and hasattr(kind, "Set" + of[1])
                getters = GETTERS.get(key, ["Get" + (of[1] if enumerated else match[1])])
                for getter in getters:
                    self.assertTrue(hasattr(kind, getter), f"{key} has no {getter}")
        self.assertGreater(setters, 150)
        self.assertEqual(unused, set(), "are no setters")

    def test_keys_of_lights(self):
        keys = gnomon.vtkGnomonLightKeys
        light = vtkLight()
        self.assertIsNone(keys.GetTechnique(light))
        self.assertEqual(keys.GetMapSize(light), 0)
        size, up = [7.0, 7.0, 7.0], [7.0, 7.0, 7.0]
        self.assertFalse(keys.GetBox(light, size, up))
        self.assertEqual(size, [7.0, 7.0, 7.0])
        keys.SetTechnique(light, "nsm")
        keys.SetMapSize(light, 100000)
        keys.SetBox(light, 1, 2, 3, (0, 1, 0.5))
        self.assertEqual(keys.GetTechnique(light), "nsm")
        self.assertEqual(keys.GetMapSize(light), 16384)
        self.assertTrue(keys.GetBox(light, size, up))
        self.assertEqual((size, up), ([1.0, 2.0, 3.0], [0.0, 1.0, 0.5]))

    def test_pitch_and_yaw(self):
        placement = gnomon.vtkGnomonLightPlacement
        for pitch, yaw in ((0, 0), (30, 100), (-45, -170), (-90, 0), (90, 0)):
            for positional in (False, True):
                light = vtkLight()
                light.SetPositional(positional)
                placement.SetPitchAndYaw(light, pitch, yaw)
                found = [0.0, 0.0]
                placement.GetPitchAndYaw(light, found)
                self.assertAlmostEqual(found[0], pitch, places=5)
                self.assertAlmostEqual(found[1], yaw, places=5)

    def test_lights_of_the_filter(self):
        shadows = gnomon.vtkGnomonVisibilityFilter()
        shadows.AddDirection(0, 0, 2, 3.0)
        light = vtkLight()
        shadows.AddLight(light, 0.5)
        towards = [7.0, 7.0, 7.0]
        shadows.GetDirection(0, towards)
        self.assertEqual((towards, shadows.GetHours(0)), ([0.0, 0.0, 1.0], 3.0))
        self.assertIsNone(shadows.GetLight(0))
        shadows.GetDirection(1, towards)
        self.assertEqual((towards, shadows.GetHours(1)), ([0.0, 0.0, 0.0], 0.5))
        self.assertIs(shadows.GetLight(1), light)
        for index in (-1, 2):
            self.assertIsNone(shadows.GetLight(index))
            self.assertEqual(shadows.GetHours(index), 0.0)


class Events(unittest.TestCase):
    def observe(self, caller, *events, call_data=None):
        """Note the names of events as they come, with their data if they have some."""
        told = []

        def note(found, event, *data):
            self.assertIs(found, caller)
            told.append((event, *data) if data else event)

        if call_data is not None:
            note.CallDataType = call_data
        return told, [caller.AddObserver(event, note) for event in events]

    def test_setters_tell_of_changes(self):
        shadows = gnomon.vtkGnomonShadowPass()
        told, observers = self.observe(shadows, "ModifiedEvent")
        shadows.SetRoute(shadows.ROUTE_IMAGE)
        shadows.SetRoute(shadows.ROUTE_IMAGE)
        shadows.SetSetting("kernel_size", "5")
        self.assertEqual(told, ["ModifiedEvent"] * 2)
        shadows.RemoveObserver(observers[0])
        self.assertFalse(shadows.HasObserver("ModifiedEvent"))
        shadows.SetRoute(shadows.ROUTE_AUTO)
        self.assertEqual(len(told), 2)

    def test_errors_reach_their_object(self):
        for shadows, misuse in (
            (gnomon.vtkGnomonShadowPass(), lambda it: it.SetTechnique("magic")),
            (gnomon.vtkGnomonVisibilityFilter(), lambda it: it.AddDirection(0, 0, 0)),
        ):
            told, _ = self.observe(shadows, "ErrorEvent", call_data="string0")
            misuse(shadows)
            self.assertEqual(len(told), 1)
            self.assertIn(shadows.GetClassName(), told[0][1])

    def test_a_pass_that_refines_tells_of_its_progress_and_its_end(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer, "penumbra", light_radius=5, moving_samples=4)
        told, _ = self.observe(shadows, "ProgressEvent", "EndEvent")
        for _ in range(20):
            scene.window.Render()
            if told[-1:] == ["EndEvent"]:
                break
        self.assertEqual(told[-2:], ["ProgressEvent", "EndEvent"])
        before = len(told)
        scene.window.Render()
        self.assertEqual(len(told), before, "a frame at rest")

    def test_complaints_of_frames_come_once(self):
        scene = Scene()
        shadows = gnomon.add_shadows(scene.renderer, "raytraced")
        told, _ = self.observe(shadows, "ErrorEvent", call_data="string0")
        for _ in range(2):
            shadows.SetRoute(shadows.ROUTE_INLINE)
            scene.window.Render()
            scene.window.Render()
            shadows.SetRoute(shadows.ROUTE_AUTO)
            scene.window.Render()
        self.assertEqual(len(told), 2)
        self.assertIn("inline route", told[0][1])

    def test_the_filter_tells_of_its_progress(self):
        shadows = self.filter()
        told, _ = self.observe(shadows, "StartEvent", "ProgressEvent", "EndEvent")
        shadows.Update()
        self.assertEqual((told[0], told[-1]), ("StartEvent", "EndEvent"))
        self.assertGreater(told.count("ProgressEvent"), 1)
        self.assertEqual(shadows.GetProgress(), 1.0)

    def test_the_filter_is_aborted_and_goes_on(self):
        shadows = self.filter()
        aborts = []

        def abort(caller, _event):
            if not aborts and caller.GetProgress() < 1:
                aborts.append(caller.GetProgress())
                caller.AbortExecuteOn()

        shadows.AddObserver("ProgressEvent", abort)
        shadows.Update()
        self.assertEqual(len(aborts), 1)
        self.assertIsNone(shadows.GetOutput().GetCellData().GetArray("Hours"))
        rays = shadows.GetNumberOfRays()
        shadows.Update()
        self.assertIsNotNone(shadows.GetOutput().GetCellData().GetArray("Hours"))
        self.assertGreater(shadows.GetNumberOfRays(), rays)

    @staticmethod
    def filter():
        plane = vtkPlaneSource()
        plane.SetResolution(100, 100)
        shadows = gnomon.vtkGnomonVisibilityFilter()
        shadows.SetInputConnection(plane.GetOutputPort())
        shadows.SetSamples(4)
        for i in range(200):
            shadows.AddDirection(0, i - 100, 100)
        return shadows


if __name__ == "__main__":
    unittest.main()
