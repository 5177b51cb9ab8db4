"""A scan-like volume that casts on the ground and on itself, below a bar that casts on both.

python3 volume_shadows.py [picture.png [width height]]
"""

import sys

import gnomon
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

SIDE = 96


def make_scan() -> vtk.vtkVolume:
    """A porous ball of radius 1."""
    axis = numpy.linspace(-1, 1, SIDE)
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij")
    pores = 0.6 + 0.4 * numpy.sin(8 * x) * numpy.sin(8 * y) * numpy.sin(8 * z)
    density = 255 * (1.1 - numpy.sqrt(x * x + y * y + z * z)) * pores
    image = vtk.vtkImageData()
    image.SetDimensions(SIDE, SIDE, SIDE)
    image.SetOrigin(-1, -1, -1)
    image.SetSpacing([2 / (SIDE - 1)] * 3)
    image.GetPointData().SetScalars(numpy_to_vtk(density.ravel().astype("f"), deep=True))
    mapper = vtk.vtkGPUVolumeRayCastMapper()
    mapper.SetInputData(image)
    opacity = vtk.vtkPiecewiseFunction()
    opacity.AddPoint(40, 0.0)
    opacity.AddPoint(70, 0.6)
    colour = vtk.vtkColorTransferFunction()
    colour.AddRGBPoint(40, 0.95, 0.60, 0.40)
    colour.AddRGBPoint(180, 1.00, 0.95, 0.85)
    scan = vtk.vtkVolume()
    scan.SetMapper(mapper)
    scan.GetProperty().SetScalarOpacity(opacity)
    scan.GetProperty().SetColor(colour)
    scan.GetProperty().SetScalarOpacityUnitDistance(0.04)
    scan.GetProperty().SetInterpolationTypeToLinear()
    scan.GetProperty().ShadeOn()  # lit by lights, and so in shadow
    scan.GetProperty().SetDiffuse(1)
    scan.GetProperty().SetSpecular(0)
    return scan


def add(renderer: vtk.vtkRenderer, source: vtk.vtkPolyDataAlgorithm) -> vtk.vtkActor:
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    renderer.AddActor(actor)
    return actor


def main() -> None:
    path = sys.argv[1] if len(sys.argv) > 1 else "volume_shadows.png"
    size = [int(number) for number in sys.argv[2:4]] or [800, 600]

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddVolume(make_scan())
    bar = vtk.vtkCubeSource()
    bar.SetBounds(-0.85, -0.72, -1.6, 0.6, 0.9, 1.03)
    add(renderer, bar).GetProperty().SetColor(0.35, 0.45, 0.6)
    plane = vtk.vtkPlaneSource()
    plane.SetOrigin(-30, -30, -1.0)
    plane.SetPoint1(30, -30, -1.0)
    plane.SetPoint2(-30, 30, -1.0)
    add(renderer, plane)

    sun = vtk.vtkLight()
    sun.SetPosition(-1.3, -1.2, 2)
    sun.SetIntensity(0.8)
    renderer.AddLight(sun)
    fill = vtk.vtkLight()
    fill.SetLightTypeToHeadlight()  # which casts no shadow
    fill.SetIntensity(0.35)
    renderer.AddLight(fill)
    gnomon.add_shadows(renderer, volumes=True)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(1.8, -4.6, 2.8)
    camera.SetFocalPoint(0.35, 0, -0.25)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(34)
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
