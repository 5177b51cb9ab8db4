"""Terrain coloured by its hours of sun on a day, under the sun of one moment of that day.

The date and the place give the suns. vtkGnomonVisibilityFilter counts the hours that each point of
the terrain sees them, and needs no window. The pass then draws the shadows of the afternoon.

python3 terrain_sun_hours.py [picture.png [width height]]
"""

import sys

import gnomon
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

SIDE = 8000.0  # metres; x is east, y north, z up
RELIEF = 1500.0


def make_terrain() -> vtk.vtkPolyData:
    """Ridged gradient noise in six octaves."""
    square = vtk.vtkPlaneSource()
    square.SetPoint1(SIDE, 0, 0)
    square.SetPoint2(0, SIDE, 0)
    square.SetResolution(240, 240)
    square.Update()
    terrain = square.GetOutput()
    noise = vtk.vtkPerlinNoise()
    layer = vtk.vtkFloatArray()
    heights = 0.0
    for octave in range(6):
        noise.SetFrequency(2.0**octave / 3600, 2.0**octave / 3600, 1)
        noise.SetPhase(0.3, 0.1 + octave, 0.5)
        noise.EvaluateFunction(terrain.GetPoints().GetData(), layer)
        heights += 0.5 * 0.45**octave * (1 - np.abs(vtk_to_numpy(layer))) ** 2
    vtk_to_numpy(terrain.GetPoints().GetData())[:, 2] = RELIEF * heights
    terrain.GetPointData().SetNormals(None)  # newer VTK would keep those of the square
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(terrain)
    normals.SplittingOff()
    normals.Update()
    return normals.GetOutput()


def main() -> None:
    path = sys.argv[1] if len(sys.argv) > 1 else "terrain_sun_hours.png"
    size = [int(number) for number in sys.argv[2:4]] or [800, 600]

    sun = gnomon.vtkGnomonSun()
    sun.SetPlace(47.27, 11.39)  # Innsbruck: degrees north and east
    sun.SetDate(2026, 12, 21)
    sun.SetTime(14, 0, 0, 1)  # one hour east of UTC

    hours = gnomon.vtkGnomonVisibilityFilter()
    hours.SetInputData(make_terrain())
    hours.SetElementsToPoints()
    hours.AddSunDay(sun, 10)  # every ten minutes
    hours.Update()
    lit = hours.GetOutput()
    lit.GetPointData().SetActiveScalars("Hours")
    _, longest = lit.GetPointData().GetScalars().GetRange()

    colours = vtk.vtkColorTransferFunction()
    for share, colour in (
        (0.0, (0.28, 0.30, 0.62)),
        (0.35, (0.66, 0.42, 0.66)),
        (0.7, (0.95, 0.60, 0.46)),
        (1.0, (1.0, 0.92, 0.60)),
    ):
        colours.AddRGBPoint(share * longest, *colour)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(lit)
    mapper.SetLookupTable(colours)
    terrain = vtk.vtkActor()
    terrain.SetMapper(mapper)
    terrain.GetProperty().SetDiffuse(0.75)

    scale = vtk.vtkScalarBarActor()
    scale.SetLookupTable(colours)
    scale.SetTitle("Hours of sun\n ")
    scale.SetLabelFormat("%.0f")
    scale.SetNumberOfLabels(int(longest) + 1)
    scale.SetPosition(0.86, 0.45)
    scale.SetWidth(0.08)
    scale.SetHeight(0.5)
    scale.UnconstrainedFontSizeOn()
    for text in (scale.GetTitleTextProperty(), scale.GetLabelTextProperty()):
        text.SetColor(0, 0, 0)
        text.SetFontSize(size[1] // 34)
        text.BoldOff()

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(terrain)
    renderer.AddViewProp(scale)
    light = vtk.vtkLight()
    towards = [0.0, 0.0, 0.0]
    sun.GetDirection(towards)
    light.SetPosition(towards)  # directional: its focal point is the origin
    renderer.AddLight(light)
    gnomon.add_shadows(renderer, sky=0.45)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0.54 * SIDE, 0.35 * SIDE, 0)
    camera.SetPosition(0.70 * SIDE, -1.1 * SIDE, 9000)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCameraClippingRange()

    window = gnomon.vtkGnomonEGLRenderWindow()  # or, with a display, a vtkRenderWindow
    window.SetSize(size)
    window.AddRenderer(renderer)
    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()


main()
