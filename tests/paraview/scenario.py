"""Parts that the scenarios share: views with shadows, data in parts, lights, reports, checks."""

import json
import os
import sys

import numpy as np
from paraview.simple import (
    AddLight,
    CreateView,
    Hide,
    LoadPlugin,
    Render,
    Show,
    XMLPartitionedPolydataReader,
)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkParallelCore import vtkMultiProcessController

PLUGIN = os.environ["GNOMON_PARAVIEW_PLUGIN"]

failures = 0


def check(name, passes, figures=""):
    """Print a line, and count what does not pass."""
    global failures
    failures += not passes
    print(f"{'ok  ' if passes else 'FAIL'} {name}{': ' if figures else ''}{figures}", flush=True)


def finish():
    """Print the line that tests/paraview/run.sh looks for."""
    print("passed" if failures == 0 else f"{failures} checks failed", flush=True)
    sys.stdout.flush()


def processes():
    """Return how many processes run the scenario."""
    return vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()


def load_plugin(remote=False):
    LoadPlugin(PLUGIN, remote=remote, ns=globals())


def make_view(shadows=True, size=(200, 150), kind="RenderView"):
    """Return a view without lights, annotations and levels of detail."""
    view = CreateView(kind)
    view.ShowShadows = int(shadows)
    view.ViewSize = list(size)
    view.UseLight = 0
    view.OrientationAxesVisibility = 0
    view.CenterAxesVisibility = 0
    view.LODThreshold = 1e6
    view.RemoteRenderThreshold = 0
    return view


def set_camera(view, position, focus, up=(0, 0, 1)):
    view.CameraPosition = list(position)
    view.CameraFocalPoint = list(focus)
    view.CameraViewUp = list(up)


def add_light(view, kind, position, focus=(0, 0, 0), cone=90.0):
    """Add a light: sun, spot or point."""
    light = AddLight(view=view)
    light.Coords = "Scene"
    light.Type = "Directional" if kind == "sun" else "Positional"
    light.ConeAngle = cone if kind == "spot" else 90.0
    light.Position = list(position)
    light.FocalPoint = list(focus)
    return light


def show_parts(view, folder, name, count):
    """Show a model that prepare.py has distributed over count processes."""
    reader = XMLPartitionedPolydataReader(FileName=[f"{folder}/{name}-{count}.pvtp"])
    return reader, Show(reader, view)


def report(view):
    """Return what the last frame of the first process did."""
    view.SMProxy.UpdatePropertyInformation()
    return json.loads(str(view.GetProperty("Report")[0]))


def read_visibility(path):
    """Return the arrays of a visibility file by name."""
    reader = vtkXMLImageDataReader()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput().GetPointData()
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    return {name: vtk_to_numpy(data.GetAbstractArray(name)) for name in names}


def read_picture(path):
    """Return a picture's colours, of shape (height, width, 3)."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    colours = vtk_to_numpy(image.GetPointData().GetScalars())
    return colours.reshape(height, width, -1)[:, :, :3].astype(int)


def mixed_pixels(visibility):
    """Return how many pixels are neither lit nor dark, of all lights."""
    lights = [values for name, values in visibility.items() if name.startswith("light ")]
    return sum(int(((values > 0) & (values < 1)).sum()) for values in lights)


def all_around(mask):
    """Return where a mask of pixels is true of a pixel and of all of its neighbours."""
    padded = np.pad(mask, 1, constant_values=True)
    rows, columns = mask.shape
    around = [padded[y : y + rows, x : x + columns] for y in range(3) for x in range(3)]
    return np.logical_and.reduce(around)


class Comparison:
    """Compares visibility of several processes with that of one, frame by frame."""

    def __init__(self, processes, needs_shadow=True):
        self.processes = processes
        self.needs_shadow = needs_shadow
        self.frames = self.pixels = self.shadowed = self.others = self.ties = self.wrong = 0
        self.faults = []

    def add(self, frame, shared, alone, report, bound=3, columns=None):
        """bound: how many pixels may show another receiver, beside depth ties. columns: of the
        picture, if pixels' visibility depends on their neighbours' receivers."""
        if shared.keys() != alone.keys() or len(shared["coverage"]) != len(alone["coverage"]):
            self.faults.append(f"{frame}: other arrays or sizes")
            return
        same = shared["coverage"] == alone["coverage"]
        for name in ("position", "normal"):
            same &= (shared[name] == alone[name]).all(axis=1)
        others = int((~same).sum())
        if columns:
            same = all_around(same.reshape(-1, columns)).reshape(-1)
        lights = [name for name in alone if name.startswith("light ")]
        wrong = sum(int((shared[name] != alone[name])[same].sum()) for name in lights)
        shadowed = sum(int((alone[name] < 1.0).sum()) for name in lights)
        self.frames += 1
        self.pixels += int(alone["coverage"].sum())
        self.shadowed += shadowed
        self.others += others
        self.ties += report["depth_ties"]
        self.wrong += wrong
        if wrong:
            self.faults.append(f"{frame}: {wrong} values differ")
        if others > report["depth_ties"] + bound:
            self.faults.append(f"{frame}: {others} other receivers, {report['depth_ties']} ties")
        if self.needs_shadow and not shadowed:
            self.faults.append(f"{frame}: no shadow")
        if report["processes"] != self.processes or report["route"] != "image":
            self.faults.append(f"{frame}: {report['processes']} processes, {report['route']}")

    def __str__(self):
        text = (
            f"{self.frames} frames, {self.pixels} pixels, {self.shadowed} shadowed, "
            f"{self.wrong} wrong, {self.others} of other receivers, {self.ties} depth ties"
        )
        return "; ".join([text] + self.faults)
