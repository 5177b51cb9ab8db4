"""Measure frames with shadows beside plain ParaView's, and write a table of them.

    mpirun -np 3 pvbatch measure.py TABLE
"""

import math
import pathlib
import statistics
import sys
import time

from paraview.simple import Contour, Render, Show, Wavelet

import scenario

SIZE = (1920, 1080)
WARM = 3
FRAMES = 15
STAGE_FRAMES = 5


def set_frame(view, number):
    """Move the camera around the data, a degree a frame."""
    angle = math.radians(number)
    scenario.set_camera(view, (300 * math.sin(angle), -300 * math.cos(angle), 200), (0, 0, 0))


def milliseconds(view, number):
    set_frame(view, number)
    start = time.perf_counter()
    Render(view)
    return 1000 * (time.perf_counter() - start)


class Case:
    """A shadow view's lights and settings, drawn in turn with a plain view."""

    def __init__(self, name, view, plain, lights, size, edge_samples=1):
        self.name = name
        for of in (view, plain):
            for number, light in enumerate(of.AdditionalLights):
                light.Enable = int(number < lights)
        view.LightSize = size
        view.EdgeSamples = edge_samples
        pairs = []
        for number in range(WARM + FRAMES):
            pairs.append((milliseconds(plain, number), milliseconds(view, number)))
        self.plain = statistics.median(pair[0] for pair in pairs[WARM:])
        self.shadows = statistics.median(pair[1] for pair in pairs[WARM:])
        self.ratio = statistics.median(pair[1] / pair[0] for pair in pairs[WARM:])
        report = scenario.report(view)
        self.bytes_shared = report["bytes_shared"] / (SIZE[0] * SIZE[1])
        self.is_shared = report["route"] == "image" and report["processes"] > 1
        self.stages = self.measure_stages(view)

    @staticmethod
    def measure_stages(view):
        """Return the median of each stage of the first process; OpenGL is waited for at its end."""
        view.MeasureStages = 1
        stages = {}
        for number in range(STAGE_FRAMES):
            milliseconds(view, number)
            sums = {}
            for stage in scenario.report(view)["stages"]:
                sums[stage["name"]] = sums.get(stage["name"], 0.0) + stage["milliseconds"]
            for name, sum_ in sums.items():
                stages.setdefault(name, []).append(sum_)
        view.MeasureStages = 0
        return {name: statistics.median(times[1:] or times) for name, times in stages.items()}


def rows_of(case):
    yield "plain_ms", f"{case.plain:.0f}"
    yield "shadows_ms", f"{case.shadows:.0f}"
    yield "over_plain", f"{case.ratio:.2f}"
    yield "bytes_a_pixel", f"{case.bytes_shared:.1f}"
    for name, milliseconds in case.stages.items():
        if milliseconds >= 0.05:
            yield f"{name} ms", f"{milliseconds:.1f}"


def main():
    scenario.load_plugin()
    wavelet = Wavelet(WholeExtent=[-69, 69, -69, 69, -69, 69])
    contour = Contour(Input=wavelet, ContourBy=["POINTS", "RTData"])
    contour.Isosurfaces = [-60.0 + 26.0 * number for number in range(10)]
    views = [scenario.make_view(shadows, SIZE) for shadows in (True, False)]
    for view in views:
        Show(contour, view).ColorArrayName = ["POINTS", ""]
        Render(view)
        scenario.add_light(view, "sun", (60, -80, 200))
        scenario.add_light(view, "sun", (-150, 30, 160))
        scenario.add_light(view, "point", (60, -160, 170))
    view, plain = views
    view.LightSamples = 16
    cases = [
        Case("a sun", view, plain, 1, 0.0),
        Case("a sun, 16 samples at edges", view, plain, 1, 0.0, edge_samples=16),
        Case("three lights", view, plain, 3, 0.0),
        Case("an area light of 16 samples", view, plain, 1, 1.0),
    ]
    rows = [f"{case.name!r},{what},{figure}" for case in cases for what, figure in rows_of(case)]
    text = "\n".join(["lights,what,figure", *rows]).replace("'", '"') + "\n"
    pathlib.Path(sys.argv[1]).write_text(text, encoding="utf-8")
    print(text)
    for case in cases:
        scenario.check(case.name, case.is_shared, f"{case.ratio:.2f} times a plain frame")
    scenario.check("a sun takes at most 3 plain frames", cases[0].ratio <= 3.0)
    scenario.check("at most 40 bytes a pixel", cases[0].bytes_shared <= 40.0)
    scenario.finish()


main()
