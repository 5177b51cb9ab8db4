"""Compare the visibility of several processes with that of one that draws all their parts.

    mpirun -np N pvbatch same_visibility.py shared DATA OUT     writes OUT/N/FRAME.vti
    pvbatch same_visibility.py alone DATA OUT N...              compares with them

DATA is of prepare.py. Where both show the same receiver, visibility must be equal bit for bit.
Other receivers are counted: OpenGL decides equal depths by the order of drawing. Depths may also
round differently: in "shifted" data, as VTK shifts vertices by their part's middle, and in turned
data, as the camera's range follows from the boxes of the turned parts.
"""

import json
import pathlib
import sys

import numpy as np
from paraview.simple import Contour, Delete, GhostCellsGenerator, Render, SaveData, SaveScreenshot
from paraview.simple import Show, Wavelet, XMLPartitionedPolydataReader

import scenario

SIZE = (200, 150)
DISTRIBUTIONS = (
    "block",
    "round-robin",
    "random",
    "ghosts",
    "doubles",
    "empty",
    "out-of-view",
    "shifted",
)


class Model:
    """Where a model's camera and lights are, relative to its middle and half its width."""

    def __init__(self, name, middle=(0, 0, 0), size=1.0, camera=(1, -2, 1), sun=(0.7, 1.1, 2.4)):
        self.name = name
        self.middle = np.asarray(middle, float)
        self.size = size
        self.camera = camera
        self.sun = sun

    def at(self, *place):
        return list(self.middle + self.size * np.asarray(place, float))


MODELS = {
    "bunny": Model("bunny", camera=(1.4, -2.5, 2.1)),
    "atrium": Model("atrium", camera=(0.9, -1.6, 0.9)),
    "terrain": Model("terrain", (3000, -2000, 100), 500.0, (1.1, -1.9, 1.5), sun=(0.7, 1.1, 0.5)),
    "contour": Model("contour", size=10.0, camera=(2.0, -3.1, 2.4)),
}


class Stage:
    """A view of a model with three lights."""

    def __init__(self, model, distribution, count, is_shared, data, out):
        self.model = model
        self.count = count
        self.is_shared = is_shared
        self.name = f"{model.name}-{distribution}"
        self.out = out / str(count) if is_shared else out / "alone"
        self.out.mkdir(parents=True, exist_ok=True)
        self.sources = []
        self.view = scenario.make_view(size=SIZE)
        self.display = self.show(distribution, data)
        self.bound = 0  # of a frame's pixels of other receivers, beside depth ties
        if distribution == "shifted":
            self.bound = 10
        else:
            self.display.CoordinateShiftScaleMethod = "Disable"
        at = model.at
        Render(self.view)  # the first one resets the camera
        scenario.set_camera(self.view, at(*model.camera), at(0, 0, 0.3))
        self.sun = scenario.add_light(self.view, "sun", at(*model.sun), at(0, 0, 0))
        self.spot = scenario.add_light(self.view, "spot", at(-0.9, 0.4, 2.6), at(0, 0, 0), 30.0)
        self.point = scenario.add_light(self.view, "point", at(0.4, -0.5, 2.2), at(0, 0, 0))
        self.lights = {"sun": self.sun, "spot": self.spot, "point": self.point}

    def show(self, distribution, data):
        """Show the data. What the processes have is in files; that of the contour they write."""
        path = f"{data}/{self.name}-{self.count}.pvtp".replace("shifted", "block")
        if self.model.name == "contour" and self.is_shared:
            source = Wavelet()
            self.sources.append(source)
            if distribution == "ghosts":
                source = GhostCellsGenerator(Input=source)
                self.sources.append(source)
            source = Contour(Input=source, ContourBy=["POINTS", "RTData"], ComputeNormals=0)
            source.Isosurfaces = [130.0, 200.0]
            SaveData(path, proxy=source, DataMode="Binary")
        else:
            source = XMLPartitionedPolydataReader(FileName=[path])
        self.sources.append(source)
        display = Show(source, self.view)
        display.ColorArrayName = ["POINTS", ""]
        return display

    def light(self, *kinds):
        for kind, light in self.lights.items():
            light.Enable = int(kind in kinds)

    def path(self, frame, ending="vti"):
        return str(self.out / f"{self.name}-{frame}.{ending}")

    def draw(self, frame, render=Render):
        """Draw a frame, and write its visibility and report."""
        self.view.VisibilityFile = self.path(frame)
        render(self.view)
        if self.is_shared:
            self.write_report(frame)
        return frame

    def write_report(self, frame):
        pathlib.Path(self.path(frame, "json")).write_text(json.dumps(scenario.report(self.view)))

    def few_frames(self):
        """Yield each frame once it is drawn."""
        self.light("sun")
        yield self.draw("sun")
        self.light("spot", "point")
        yield self.draw("spot-and-point")
        self.light("sun")
        self.turn_data()
        yield self.draw("moved-data")
        yield from self.smooth_edges()
        self.view.LightSize = 2.0
        self.view.LightSamples = 16
        yield self.draw("area-sun")

    def turn_data(self):
        self.display.Orientation = [0, 0, 6]
        self.display.Position = self.model.at(0.05, 0, 0.02) - self.model.middle
        self.bound = max(self.bound, 3)

    def smooth_edges(self):
        self.view.EdgeSamples = 16
        yield self.draw("smooth-edges")
        self.view.EdgeSamples = 1

    def all_frames(self):
        for kind in self.lights:
            self.light(kind)
            yield self.draw(kind)
        self.view.LightSize = 0.1 * self.model.size
        self.view.LightSamples = 16
        yield self.draw("area")
        self.light(*self.lights)
        self.view.LightSize = 0.0
        yield self.draw("three-lights")
        self.light("sun", "spot")
        self.view.LightSize = 0.05
        yield self.draw("two-area-lights")
        self.view.LightSize = 0.0
        self.view.CameraPosition = self.model.at(*(np.asarray(self.model.camera) * (1.1, 0.9, 0.8)))
        yield self.draw("moved-camera")
        self.sun.Position = self.model.at(*(np.asarray(self.model.sun) * (-1.2, 0.8, 0.9)))
        yield self.draw("moved-light")
        self.turn_data()
        yield self.draw("moved-data")
        self.sources[-1].UpdatePipeline()
        yield self.draw("at-rest")
        self.view.ViewSize = [203, 151]
        yield self.draw("odd-size")
        yield self.reduced("odd-reduced", (203, 151))
        self.view.ViewSize = list(SIZE)
        yield self.reduced("reduced", SIZE)
        self.light("sun")
        yield self.draw("still-again")
        yield from self.smooth_edges()
        self.screenshot()
        yield "screenshot"

    def reduced(self, frame, size):
        """Draw an interactive picture of half the size."""
        if self.is_shared:
            self.view.ImageReductionFactor = 2
            return self.draw(frame, lambda view: view.SMProxy.InteractiveRender())
        self.view.ViewSize = [size[0] // 2, size[1] // 2]
        self.draw(frame)
        self.view.ViewSize = list(size)
        return frame

    def screenshot(self):
        """Take a picture of twice the view's size; the visibility is that of its last part."""
        self.view.VisibilityFile = self.path("screenshot")
        SaveScreenshot(
            self.path("screenshot", "png"), self.view, ImageResolution=[2 * side for side in SIZE]
        )
        if self.is_shared:
            self.write_report("screenshot")

    def close(self):
        Delete(self.display)
        for source in reversed(self.sources):
            Delete(source)
        for light in self.lights.values():
            Delete(light)
        Delete(self.view)


def stages(count, is_shared, data, out):
    for model in MODELS.values():
        for distribution in DISTRIBUTIONS:
            if model.name == "contour" and distribution not in ("block", "ghosts", "shifted"):
                continue
            stage = Stage(model, distribution, count, is_shared, data, out)
            yield stage, stage.all_frames() if distribution == "block" else stage.few_frames()
            stage.close()


def compare_pictures(stage, shared):
    ours = scenario.read_picture(str(shared / f"{stage.name}-screenshot.png"))
    alone = scenario.read_picture(stage.path("screenshot", "png"))
    if ours.shape != alone.shape:
        scenario.check(f"{stage.name} screenshot", False, f"sizes {ours.shape}, {alone.shape}")
        return
    differences = np.abs(ours - alone).max(axis=2)
    figures = f"{(differences > 0).sum()} of {differences.size} pixels differ, "
    figures += f"{(differences > 2).sum()} by more than 2 of 255"
    passes = (differences > 2).sum() <= differences.size // 5000
    scenario.check(f"{stage.name} on {stage.count} processes, screenshot", passes, figures)


def main():
    mode, data, out = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    scenario.load_plugin()
    if mode == "shared":
        frames = 0
        for _, drawn in stages(scenario.processes(), True, data, out):
            frames += sum(1 for _ in drawn)
        scenario.check("frames are drawn", frames > 0, str(frames))
    else:
        for count in map(int, sys.argv[4:]):
            shared = out / str(count)
            for stage, drawn in stages(count, False, data, out):
                sums = scenario.Comparison(count)
                for frame in drawn:
                    path = str(shared / f"{stage.name}-{frame}")
                    report = json.loads(pathlib.Path(path + ".json").read_text())
                    ours = scenario.read_visibility(path + ".vti")
                    alone = scenario.read_visibility(stage.path(frame))
                    columns = SIZE[0] if frame == "smooth-edges" else None
                    sums.add(frame, ours, alone, report, stage.bound, columns)
                    if columns and not scenario.mixed_pixels(ours):
                        sums.faults.append(f"{frame}: no smooth edge")
                    if frame == "screenshot":
                        compare_pictures(stage, shared)
                scenario.check(f"{stage.name} on {count} processes", not sums.faults, str(sums))
    scenario.finish()


main()
