"""The wrapped classes: a getter beside each setter, None for objects, and events."""

import ast
import contextlib
import functools
import inspect
import math
import os
import re
import sys
import tempfile
import unittest
import warnings
from types import SimpleNamespace

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkObject
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer

import gnomon
from gnomon import vtkGnomonShadowSettings
from gnomon.errors import raising
from scene import Scene

# Setters whose values are got one by one, and those that only others call.
GETTERS = {
    "vtkGnomonVisibilityFilter.AddSky": ["GetSkyModel", "GetSkyDirections"],
    "vtkGnomonSun.SetDate": ["GetYear", "GetMonth", "GetDay"],
    "vtkGnomonSun.SetTime": ["GetHour", "GetMinute", "GetSecond", "GetZoneHours"],
    "vtkGnomonSun.SetPlace": ["GetLatitude", "GetLongitude"],
    "vtkGnomonSun.SetAir": ["GetPressure", "GetTemperature"],
    "vtkGnomonSun.SetNorthAndUp": ["GetNorth", "GetUp"],
    "vtkGnomonVisibilityFilter.AddDirection": ["GetNumberOfLights", "GetDirection", "GetHours"],
    "vtkGnomonVisibilityFilter.AddLight": ["GetNumberOfLights", "GetLight", "GetHours"],
    # Many directions at once.
    "vtkGnomonVisibilityFilter.AddDirections": ["GetNumberOfLights", "GetDirection", "GetHours"],
    "vtkGnomonVisibilityFilter.AddSkyPatches": ["GetNumberOfLights", "GetDirection", "GetHours"],
    "vtkGnomonVisibilityFilter.AddSunDay": ["GetNumberOfLights", "GetDirection", "GetHours"],
    "vtkGnomonVisibilityFilter.AddSunYear": ["GetNumberOfLights", "GetDirection", "GetHours"],
    "vtkGnomonShadowPass.SetShaderParameters": [],  # mappers call it
}

# Objects that may be None: it resets them, asks for nothing, or has nothing to release.
MAY_BE_NONE = {
    "vtkGnomonAreaLight.SetTexture(_arg)",
    "vtkGnomonLightKeys.SetSettings(settings)",
    "vtkGnomonLightSamplingPass.SetDelegatePass(pass_)",
    "vtkGnomonLightSamplingPass.ReleaseGraphicsResources(window)",
    "vtkGnomonShadowPass.SetSettings(settings)",
    "vtkGnomonShadowPass.SetDelegatePass(pass_)",
    "vtkGnomonShadowPass.SetController(controller)",
    "vtkGnomonShadowPass.ReleaseGraphicsResources(window)",
    "vtkGnomonSun.MakeDayPath(hours)",
    "vtkGnomonSun.MakeDayPath(times)",
    "vtkGnomonSun.MakeYearPath(hours)",
    "vtkGnomonSun.MakeYearPath(times)",
    "vtkGnomonVisibilityFilter.AddDirections(hours)",
    "vtkGnomonShadowPass.PreReplaceShaderValues(mapper)",
    "vtkGnomonShadowPass.PreReplaceShaderValues(prop)",
    "vtkGnomonShadowPass.SetShaderParameters(vao)",
}
# VTK's own, of more pixels than memory holds.
TAKES_ALL_MEMORY = {f"vtkGnomonEGLRenderWindow.GetZbufferData({it})"
                    for it in ("x1", "x2", "y1", "y2")}
if hasattr(gnomon, "vtkGnomonEGLRenderWindow"):
    MAY_BE_NONE.add("vtkGnomonEGLRenderWindow.SetInteractor(interactor)")


def own_methods(kind):
    """The names of methods in a class, and in the wrapped one that it may stand for."""
    return [name for each in kind.__mro__ if each.__name__ == kind.__name__
            for name, value in vars(each).items() if inspect.isroutine(value)]


class Getters(unittest.TestCase):
    def test_each_setter_has_a_getter(self):
        classes = [getattr(gnomon, name) for name in dir(gnomon) if name.startswith("vtk")]
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


class Nulls(unittest.TestCase):
    maxDiff = None

    def test_none_for_an_object_is_an_error(self):
        modules = (gnomon.GnomonLights, gnomon.GnomonPlugin)
        kinds = {value for module in modules for value in vars(module).values()
                 if inspect.isclass(value) and value.__name__.startswith("vtk")}
        ended = {}
        for kind in kinds:
            for name in set(own_methods(kind)) - {"SafeDownCast"}:
                for arguments in self.signatures(getattr(kind, name)):
                    for argument in [it for it, types in arguments if self.is_object(types)]:
                        values = [None if it == argument else self.example(types)
                                  for it, types in arguments]
                        key = f"{kind.__name__}.{name}({argument})"
                        ended[key] = self.end_of(kind, name, values)
        for key in MAY_BE_NONE:
            self.assertIn(ended.pop(key), ("returns", "TypeError"), key)
        self.assertGreater(len(ended), 30)
        self.assertEqual({k: end for k, end in ended.items() if end != "ValueError"}, {})

    def test_wrong_values_raise_with_the_argument_s_name_or_are_clamped(self):
        ended = {}
        with tempfile.TemporaryDirectory() as folder:
            for name in filter(re.compile("vtk").match, dir(gnomon)):
                kind = getattr(gnomon, name)
                for method in set(own_methods(kind)) - set(dir(vtkObject)):
                    for arguments in self.signatures(getattr(kind, method)):
                        for argument, types in arguments:
                            key = f"{name}.{method}({argument})"
                            if key not in TAKES_ALL_MEMORY:
                                call = functools.partial(self.end_of_wrong, kind, method,
                                                         arguments, argument, types)
                                ended[key] = self.in_a_process(call, folder)
            self.assertEqual(os.listdir(folder), [])
        self.assertGreater(len(ended), 200)
        self.assertEqual({k: end for k, end in ended.items() if end != "right"}, {})

    @classmethod
    def wrong(cls, types):
        """Values that few methods take for an argument."""
        if isinstance(types, ast.Tuple | ast.List):
            each = [of for of in types.elts if not isinstance(of, ast.Constant)]
            return [None, object(), 3.0, "x"] + [
                [value] * count for count in (0, 1, len(each), len(each) + 1)
                for value in cls.wrong(each[0])]
        wrong = {"float": [math.nan, math.inf, -math.inf, -1e300],
                 "int": [-1, 2**31 - 1, -(2**31), 2**31, 1.5],
                 "str": ["", "missing/folder", "\n"], "bool": []}
        return [None, object()] + wrong.get(types.id, [1])

    @classmethod
    def end_of_wrong(cls, kind, name, arguments, argument, types):
        """Tell how calls end that have a wrong value for an argument: "right", or what is wrong."""

        def call(it, wrong):
            """Call the method; return its exception, and the state before and afterwards."""
            values = [wrong if each == argument else cls.example(of, each)
                      for each, of in arguments]
            before, error = cls.state_of(it, name, values), None
            try:
                getattr(it, name)(*values)
            except Exception as raised:
                error = raised
            return error, before, cls.state_of(it, name, values)

        def new():
            try:
                return kind()
            except (TypeError, NotImplementedError):
                return kind  # an abstract one, with static methods

        def names_it(text):
            """True if an error's text names the argument or the setting."""
            setting = re.sub("^(Set|Add|Read)", "", name)
            if not argument.startswith("_arg"):  # else the method's name is that of the setting
                text = text.replace(name, "")
            found, *names = (re.sub("[^a-z0-9_]", "", each.lower())
                             for each in (text, argument, setting))
            return any(each in found or each in found.replace("_", "") for each in names)

        key = f"{kind.__name__}.{name}({argument})"
        is_vtks = hasattr(cls.vtk_class_of(kind), name)
        for wrong in cls.wrong(types):
            error, before, after = call(new(), wrong)
            it = new()
            for other in cls.wrong(types):
                call(it, other)
            later = call(it, wrong)[2]
            if is_vtks:
                continue  # it shall not crash
            told = f"{wrong!r}: {error!r}, {before} -> {after}, {later}"
            if error is None:
                is_finite = all(math.isfinite(number) for number in after if type(number) is float)
                may_be = wrong is not None or not cls.is_object(types) or key in MAY_BE_NONE
                if not (is_finite and may_be and after == later):
                    return told
            elif not (isinstance(error, (TypeError, ValueError)) and before == after
                      and names_it(str(error))):
                return told
        return "right"

    @staticmethod
    def state_of(it, name, values):
        """The values of a setter's getters, those that take the objects of a call included."""
        key = f"{getattr(it, '__name__', type(it).__name__)}.{name}"
        objects = [value for value in values if hasattr(value, "IsA")]
        state = []
        for getter in GETTERS.get(key, [re.sub("^(Set|Add)", "Get", name)]):
            if getter != name and hasattr(it, getter):
                with contextlib.suppress(TypeError, ValueError):
                    found = getattr(it, getter)(*objects)
                    state.extend(found if isinstance(found, tuple) else (found,))
        return [value for value in state if not hasattr(value, "IsA")]

    @staticmethod
    def vtk_class_of(kind):
        """The class of VTK that a class derives from, whose methods are VTK's."""
        return next(each for each in kind.__mro__ if each.__module__.startswith("vtkmodules"))

    @staticmethod
    def in_a_process(call, folder):
        """Return the text that a call returns, made in a folder by a process, as it may crash."""
        ours, theirs = os.pipe()
        child = os.fork()
        if child == 0:
            os.chdir(folder)
            os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # VTK's own errors
            try:
                os.write(theirs, call().encode())
            finally:
                os._exit(0)
        os.close(theirs)
        with open(ours, encoding="utf-8") as pipe:
            text = pipe.read()
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        return text if code >= 0 else f"signal {-code}"

    @staticmethod
    def signatures(method):
        """The arguments of each signature that a docstring begins with: names and types."""
        text = re.sub(r"\n[ \t]+", " ", (method.__doc__ or "").partition("\n\n")[0])
        for line in re.findall(rf"^{method.__name__}\(.*", text, re.MULTILINE):
            found = ast.parse(f"def {line}: ...").body[0].args.args
            yield [(each.arg, each.annotation) for each in found if each.arg != "self"]

    @staticmethod
    def is_object(types):
        return isinstance(types, ast.Name) and types.id.startswith("vtk")

    @classmethod
    def example(cls, types, argument=None):
        """A value of a type."""
        if argument == "name":
            return "map_size"
        if not isinstance(types, ast.Name):
            return [cls.example(each) for each in types.elts if each.__class__ != ast.Constant]
        if not cls.is_object(types):
            return {"str": "x", "int": 1, "float": 1.0, "bool": True}[types.id]
        return cls.object_of(next(vars(module)[types.id] for module in list(sys.modules.values())
                                  if types.id in vars(module)))

    @classmethod
    def object_of(cls, kind):
        """An object of a class; of an abstract one, of the first class below that is none."""
        try:
            return kind()
        except TypeError:
            return next(filter(None, map(cls.object_of, kind.__subclasses__())), None)

    @staticmethod
    def end_of(kind, name, values):
        """How a call ends, made in a process of its own, as it may crash."""
        ends = ["returns", "ValueError", "TypeError"]
        child = os.fork()
        if child == 0:
            os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # VTK's own errors
            try:
                getattr(kind(), name)(*values)
                os._exit(0)
            except Exception as error:
                os._exit(ends.index(type(error).__name__))
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        return ends[code] if code >= 0 else f"signal {-code}"


class Errors(unittest.TestCase):
    """Methods raise what they report."""

    def test_settings_of_a_pass_raise(self):
        shadows = gnomon.vtkGnomonShadowPass()
        held = vtkGnomonShadowSettings()
        for given in (held, None):
            shadows.SetSettings(given)
            self.assertEqual(shadows.GetSettings() is held, given is held)
            with self.assertRaisesRegex(ValueError, "'splits'"):
                shadows.GetSettings().SetSetting("splits", "many")

    def test_objects_that_cpp_makes_are_instances(self):
        class Lamp(gnomon.vtkGnomonAreaLight):
            def SetRadius(self, radius):
                super().SetRadius(radius)

        lamp, clone = Lamp(), gnomon.vtkGnomonAreaLight().ShallowClone()
        for kind, instances in ((gnomon.vtkGnomonAreaLight, [lamp, clone]), (Lamp, [lamp])):
            self.assertEqual([it for it in (lamp, clone, vtkLight()) if isinstance(it, kind)],
                             instances)
        with self.assertRaisesRegex(ValueError, "Radius"):
            lamp.SetRadius(math.nan)

    def test_calls_within_calls_raise_while_warnings_are_off(self):
        suns = [gnomon.vtkGnomonSun() for _ in range(2)]
        for outer_ends_first in (True, False):
            vtkObject.GlobalWarningDisplayOff()
            try:
                outer, inner = map(raising, suns)
                errors = [outer.__enter__(), inner.__enter__()]
                if outer_ends_first:
                    outer.__exit__(None, None, None)
                with self.assertRaises(ValueError):
                    suns[1].SetDate(0, 0, 0)
                self.assertEqual(list(map(len, errors)), [0, 1])
                with self.assertRaises(ValueError):
                    inner.__exit__(None, None, None)
                if not outer_ends_first:
                    outer.__exit__(None, None, None)
                self.assertFalse(vtkObject.GetGlobalWarningDisplay())
            finally:
                vtkObject.GlobalWarningDisplayOn()

    def test_an_exception_is_no_warning_too(self):
        shadows = gnomon.add_shadows(vtkRenderer(), light=None)
        with warnings.catch_warnings(record=True) as told:
            with self.assertRaisesRegex(ValueError, "'magic'"):
                shadows.SetTechnique("magic")
            with self.assertRaisesRegex(ValueError, "'magic'"):
                shadows.technique = "magic"
        self.assertEqual(told, [])

    def test_static_methods_take_objects_of_toolkits(self):
        light = vtkLight()
        keys = gnomon.vtkGnomonLightKeys()  # an object answers as its class does
        keys.SetCasts(SimpleNamespace(source=light), False)
        self.assertFalse(gnomon.vtkGnomonLightKeys.GetCasts(light))


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
            with self.assertRaises(ValueError):
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
