"""Wrong arguments: each of each function is refused by its name, or gives a right result."""

import contextlib
import inspect
import io
import math
import os
import tempfile
import unittest
import warnings

import numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

import gnomon
from gnomon.data import polydata_of
from scene import Scene

SQUARE = ([[0, 0, 0], [3, 0, 0], [3, 3, 0], [0, 3, 0]], [[0, 1, 2], [0, 2, 3]])



def polydata_of_nan():
    polydata = polydata_of("mesh", SQUARE)
    polydata.GetPoints().SetPoint(0, 0, math.nan, 0)
    return polydata


WRONG = {
    "None": None,
    "an object": object(),
    "a function": bool,
    "a text": "text",
    "an empty text": "",
    "a number": 2.5,
    "a negative number": -1,
    "a large number": 10**400,
    "NaN": math.nan,
    "infinity": math.inf,
    "an empty list": [],
    "a list of texts": ["0", "0", "1"],
    "an empty array": numpy.zeros((0, 3)),
    "an array of another shape": numpy.zeros((2, 2)),
    "an array of NaN": numpy.full((3, 3), math.nan),
    "a vector of infinity": numpy.full(3, math.inf),
    "a null vector": numpy.zeros(3),
    "a mesh of NaN": (numpy.full((3, 3), math.nan), [[0, 1, 2]]),
    "polydata of NaN": polydata_of_nan(),
    "empty polydata": vtkPolyData(),
    "a mesh of float numbers": (SQUARE[0], [[0.0, 1.0, 2.5]]),
    "a mesh of other points": (SQUARE[0], [[0, 1, 4]]),
    "a missing file": "missing.png",
    "a missing folder": "missing/picture.png",
    "a JPEG file": "picture.jpg",
    "no picture": "text.png",
    "a folder": ".",
}
# Values that functions take, by argument: the first ones are those that None stands for.
OPTIONAL = {"technique", "light", "hours", "casters of hours_lit", "progress", "fill"}
TAKEN = {
    "sky": {"a number"},
    "fill": {"a number", "a negative number", "NaN", "infinity"},
    "latitude": {"a number", "a negative number"},
    "longitude": {"a number", "a negative number"},
    "minutes": {"a number"},
    "zone": {"a number", "a negative number"},
    "angular_diameter": {"a number"},
    "distance": {"a number"},
    "max_difference": {"a number"},
    "max_pixels": {"a number"},
    "path": {"a missing file", "no picture"},
    "progress": {"a function"},
    # Nothing receives, or casts.
    "receivers": {"empty polydata"},
    "surface": {"empty polydata"},
    "casters of hours_lit": {"empty polydata"},
    "casters of sky_view": {"an empty text", "an empty list", "an empty array"},
    "casters of sky_patches": {"an empty text", "an empty list", "an empty array"},
}


def valid_calls(scene):
    """Arguments of each function, of which all are right."""
    keywords = {"target": scene.renderer, "technique": "pcf", "light": None, "map_size": 64}
    return {
        "add_shadows": {
            **keywords, "sky": 0.4, "glass": True, "volumes": True, "keep_visibility": True,
            "casting": "all",
        },
        "shadows": keywords,
        "remove_shadows": {"target": scene.renderer},
        "report": {"shadows": scene.renderer},
        "visibility": {"shadows": scene.renderer, "origin": "upper", "fill": 0.0},
        "why": {"target": scene.renderer},
        "settings": {},
        "techniques": {},
        "hours_lit": {
            "receivers": SQUARE, "directions": [[0, 0, 1], [0, 1, 1]], "hours": [1.0, 2.0],
            "casters": SQUARE, "samples": 2, "angular_diameter": 0.5, "progress": bool,
        },
        "sky_view": {
            "surface": SQUARE, "casters": [SQUARE], "model": "dome", "directions": 64,
            "distance": 0.0, "up": (0, 0, 1), "progress": bool,
        },
        "sky_patches": {
            "surface": SQUARE, "casters": [SQUARE], "up": (0, 0, 1), "north": (0, 1, 0),
            "progress": bool,
        },
        "sun_path": {
            "latitude": 52, "longitude": 13, "date": "2026-12-21", "minutes": 60.0, "zone": 1.0,
            "times": True,
        },
        "draw": {
            "surfaces": [SQUARE], "direction": (0, 0, 1), "path": "picture.png",
            "seen_from": (1, 1, 1), "size": (16, 16), "sky": 0.0, "technique": "pcf",
            "map_size": 64,
        },
        "assert_images_equal": {
            "actual": "same.png", "baseline": "same.png", "max_difference": 0, "max_pixels": 0,
        },
    }


class Misuse(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        gnomon.draw([SQUARE], (0, 0, 1), "same.png", size=(16, 16))
        self.scene = Scene()

    @staticmethod
    def files():
        return {name: os.path.getsize(name) for name in os.listdir()}

    def call(self, name, arguments):
        """Call a function of the module; return its exception, or None."""
        gnomon.add_shadows(self.scene.renderer, light=None)
        try:
            with contextlib.redirect_stdout(io.StringIO()), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                result = getattr(gnomon, name)(**arguments)
                if name == "shadows":
                    with result:
                        pass
        except (TypeError, ValueError, AssertionError) as error:
            return error
        return None

    def test_each_wrong_argument_is_refused_by_its_name(self):
        calls = valid_calls(self.scene)
        self.assertEqual(sorted(calls), sorted(gnomon.__all__))
        tried, faults = 0, []
        for function, arguments in calls.items():
            parameters = inspect.signature(getattr(gnomon, function)).parameters.values()
            named = {it.name for it in parameters if it.kind != it.VAR_KEYWORD}
            self.assertLessEqual(named, set(arguments), function)
            self.assertIsNone(self.call(function, arguments), function)
            for argument in arguments:
                names = {argument, f"{argument} of {function}"}
                taken = set().union(*(TAKEN.get(name, ()) for name in names))
                for label, value in WRONG.items():
                    for name in os.listdir():
                        if name != "same.png":
                            os.remove(name)
                    with open("text.png", "w", encoding="utf-8") as file:
                        file.write("no picture")
                    before = self.files()
                    error = self.call(function, {**arguments, argument: value})
                    is_right = label in taken or value is None and names & OPTIONAL
                    tried += 1
                    if error is not None if is_right else argument not in str(error):
                        faults.append((function, argument, label, repr(error)))
                    # A picture that has no baseline is written beside it.
                    is_kept = argument == "baseline" and isinstance(error, AssertionError)
                    if not is_right and not is_kept and self.files() != before:
                        faults.append((function, argument, label, "wrote", self.files()))
        self.assertGreater(tried, 1000)
        self.assertEqual(faults, [])


if __name__ == "__main__":
    unittest.main()
