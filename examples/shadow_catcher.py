"""A figure for any page: a knot and its shadow, and nothing else, as a transparent PNG.

python3 shadow_catcher.py [picture.png [width height]]
"""

import sys

import gnomon
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy


def add(renderer: vtk.vtkRenderer, source: vtk.vtkPolyDataAlgorithm) -> vtk.vtkActor:
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    renderer.AddActor(actor)
    return actor


def make_knot() -> vtk.vtkTubeFilter:
    angles = numpy.linspace(4.2, 4.2 + 2 * numpy.pi, 400)  # the seam is hidden behind
    wave = 2 + numpy.cos(3 * angles)
    path = numpy.stack(
        [wave * numpy.cos(2 * angles), wave * numpy.sin(2 * angles), 1.6 + numpy.sin(3 * angles)],
        axis=1,
    )
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(path, deep=True))
    line = vtk.vtkLineSource()
    line.SetPoints(points)
    tube = vtk.vtkTubeFilter()
    tube.SetInputConnection(line.GetOutputPort())
    tube.SetRadius(0.55)
    tube.SetNumberOfSides(60)
    return tube


def main() -> None:
    path = sys.argv[1] if len(sys.argv) > 1 else "shadow_catcher.png"
    size = [int(number) for number in sys.argv[2:4]] or [800, 600]

    renderer = vtk.vtkRenderer()
    add(renderer, make_knot()).GetProperty().SetColor(0.95, 0.55, 0.25)
    plane = vtk.vtkPlaneSource()
    plane.SetOrigin(-50, -50, 0)
    plane.SetPoint1(50, -50, 0)
    plane.SetPoint2(-50, 50, 0)
    ground = add(renderer, plane)
    gnomon.vtkGnomonPropKeys.SetShadowCatcher(ground, True)

    sun = vtk.vtkLight()
    sun.SetPosition(-2, 1, 3)
    renderer.AddLight(sun)
    gnomon.add_shadows(renderer, sky=0.4, light_radius=6)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(4, -9, 8)
    camera.SetFocalPoint(0.3, -0.3, 0.6)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(38)
    renderer.ResetCameraClippingRange()

    renderer.SetBackground(0, 0, 0)
    renderer.SetBackgroundAlpha(0)
    window = gnomon.vtkGnomonEGLRenderWindow()  # or, with a display, a vtkRenderWindow
    window.SetSize(size)
    window.AddRenderer(renderer)
    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.SetInputBufferTypeToRGBA()
    picture.Update()
    # VTK has laid the picture over black. PNG files hold colours without what is behind them.
    rgba = vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars()).astype(float)
    rgba[:, :3] *= 255 / numpy.maximum(rgba[:, 3:], 1)
    straight = numpy_to_vtk(rgba.round().clip(0, 255).astype(numpy.uint8), deep=True)
    picture.GetOutput().GetPointData().SetScalars(straight)
    writer = vtk.vtkPNGWriter()
    writer.SetInputData(picture.GetOutput())
    writer.SetFileName(path)
    writer.Write()


main()
