#!/usr/bin/python3
"""Measure frames of drags at 15 frames a second, plain and with shadows in turns.

    PYTHONPATH=... LD_LIBRARY_PATH=... drag_rate.py [WIDTH HEIGHT [TECHNIQUE...]]

Scenes as users have them, under a lamp with a size. A real interactor style drags the camera, with
events. Prints a line of CSV for each scene and technique: the median of plain frames, the median
and the 90th percentile with shadows in milliseconds, and the share of frames, from the tenth on,
within 1/15 second or 1.6 plain frames.
"""

import csv
import math
import random
import statistics
import sys
import time

import gnomon
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401: makes VTK's factories
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkMolecule, vtkMultiBlockDataSet, vtkPolyData)
from vtkmodules.vtkDomainsChemistry import vtkMoleculeMapper
from vtkmodules.vtkFiltersCore import vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkGlyph3DMapper, vtkLight, vtkPolyDataMapper, vtkRenderer)
from vtkmodules.vtkRenderingOpenGL2 import vtkCompositePolyDataMapper2
from vtkmodules.vtkRenderingUI import vtkGenericRenderWindowInteractor
import vtkmodules.vtkDomainsChemistryOpenGL2  # noqa: F401

RATE = 15.0  # frames a second
WARM, FRAMES = 10, 40


def places(count):
    drawn = random.Random(1)
    return [(drawn.uniform(-8, 8), drawn.uniform(-8, 8), drawn.uniform(0, 4))
            for _ in range(count)]


def ball(centre, radius, resolution):
    source = vtkSphereSource()
    source.SetCenter(*centre)
    source.SetRadius(radius)
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    source.Update()
    return source


def blocks():
    data = vtkMultiBlockDataSet()
    for i, place in enumerate(places(306)):
        data.SetBlock(i, ball(place, 0.4, 40).GetOutput())
    mapper = vtkCompositePolyDataMapper2()
    mapper.SetInputDataObject(data)
    return mapper


def tubes():
    points, lines = vtkPoints(), vtkCellArray()
    for i, (x, y, z) in enumerate(places(120)):
        lines.InsertNextCell(100)
        for k in range(100):
            lines.InsertCellPoint(points.InsertNextPoint(x, y, z))
            x += 0.1 * math.cos(z + 0.05 * k + i)
            y += 0.1 * math.sin(x + i)
            z += 0.05 * math.cos(y)
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetLines(lines)
    tube = vtkTubeFilter()
    tube.SetInputData(data)
    tube.SetRadius(0.06)
    tube.SetNumberOfSides(12)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(tube.GetOutputPort())
    return mapper


def glyphs():
    points = vtkPoints()
    for place in places(4000):
        points.InsertNextPoint(place)
    data = vtkPolyData()
    data.SetPoints(points)
    mapper = vtkGlyph3DMapper()
    mapper.SetInputData(data)
    mapper.SetSourceData(ball((0, 0, 0), 0.15, 12).GetOutput())
    mapper.ScalingOff()
    return mapper


def molecule():
    data = vtkMolecule()
    atoms = [data.AppendAtom(6 + i % 3, *place) for i, place in enumerate(places(400))]
    for one, other in zip(atoms, atoms[1:]):
        data.AppendBond(one, other, 1)
    mapper = vtkMoleculeMapper()
    mapper.SetInputData(data)
    mapper.UseBallAndStickSettings()
    return mapper


class View:
    """A window with a scene, and a style that drags its camera."""

    def __init__(self, make, size, technique):
        self.renderer, self.window = vtkRenderer(), gnomon.vtkGnomonEGLRenderWindow()
        self.window.SetSize(*size)
        self.window.AddRenderer(self.renderer)
        self.interactor = vtkGenericRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.window)
        self.interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
        self.interactor.SetDesiredUpdateRate(RATE)
        ground = vtkPlaneSource()
        ground.SetOrigin(-12, -12, -1)
        ground.SetPoint1(12, -12, -1)
        ground.SetPoint2(-12, 12, -1)
        plane = vtkPolyDataMapper()
        plane.SetInputConnection(ground.GetOutputPort())
        for mapper in (make(), plane):
            actor = vtkActor()
            actor.SetMapper(mapper)
            self.renderer.AddActor(actor)
        lamp = vtkLight()
        lamp.SetPositional(True)
        lamp.SetConeAngle(180)
        lamp.SetPosition(10, -8, 20)
        gnomon.vtkGnomonLightKeys.SetSetting(lamp, "light_radius", "2")
        self.renderer.AddLight(lamp)
        self.renderer.GetActiveCamera().SetPosition(0, -30, 18)
        self.renderer.GetActiveCamera().SetViewUp(0, 0, 1)
        self.renderer.ResetCamera()
        if technique:
            gnomon.add_shadows(self.renderer, technique)
        self.interactor.Initialize()
        self.window.Render()
        self.window.Render()
        self.mouse = [size[0] // 2, size[1] // 2]
        self.send("LeftButtonPressEvent")

    def send(self, event):
        self.interactor.SetEventInformation(*self.mouse, 0, 0, "", 0, None)
        self.interactor.InvokeEvent(event)

    def drag(self):
        """Return the milliseconds of a frame."""
        self.mouse[0] += 3
        self.mouse[1] += 1
        start = time.perf_counter()
        self.send("MouseMoveEvent")
        self.window.WaitForCompletion()
        return 1000.0 * (time.perf_counter() - start)


def main():
    size = tuple(map(int, sys.argv[1:3])) or (900, 700)
    rows = csv.writer(sys.stdout)
    rows.writerow(("scene", "technique", "plain", "median", "p90", "kept"))
    for make in (blocks, tubes, glyphs, molecule):
        for technique in sys.argv[3:] or ("auto",):
            views = [View(make, size, None), View(make, size, technique)]
            pairs = [[view.drag() for view in views] for _ in range(FRAMES)][WARM:]
            plain = statistics.median(first for first, _ in pairs)
            times = sorted(second for _, second in pairs)
            limit = max(1000.0 / RATE, 1.6 * plain)
            rows.writerow((make.__name__, technique, round(plain, 1),
                           round(statistics.median(times), 1),
                           round(times[int(0.9 * len(times))], 1),
                           round(sum(t <= limit for t in times) / len(times), 2)))
            sys.stdout.flush()


if __name__ == "__main__":
    main()
