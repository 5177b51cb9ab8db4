"""Volumes that cast and receive: a scan below a bar, smoke, or a scan in a case of glass.

python3 volume_shadows.py [picture.png [width height [scan|smoke|case]]]
"""

import sys
from typing import Any

import gnomon
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

SIDE = 96

Samples = numpy.ndarray[Any, numpy.dtype[numpy.floating[Any]]]


def grid() -> list[Samples]:
    """Coordinates of the samples of a cube from -1 to 1, as x, y, z."""
    axis = numpy.linspace(-1, 1, SIDE)
    return list(numpy.meshgrid(axis, axis, axis, indexing="ij"))[::-1]


def porous_ball() -> Samples:
    """Densities of a ball of radius 1 with pores, as a scan has them: 40 is its surface."""
    x, y, z = grid()
    pores = 0.6 + 0.4 * numpy.sin(8 * x) * numpy.sin(8 * y) * numpy.sin(8 * z)
    return numpy.asarray(255 * (1.1 - numpy.sqrt(x * x + y * y + z * z)) * pores)


def plume() -> Samples:
    """Densities of smoke that rises from the ground and bends."""
    x, y, z = grid()
    up = (z + 1) / 2
    away = numpy.hypot(x + 0.6 - up * up, y + 0.1 * numpy.sin(5 * z))
    away *= 1 + 0.25 * numpy.sin(9 * x + 3 * z) * numpy.sin(9 * y) * numpy.sin(7 * z + 2 * x)
    density = numpy.clip(1 - away / (0.1 + 0.3 * up), 0, 1) * numpy.clip(4 * (1 - up), 0, 1)
    return numpy.asarray(255 * density)


def as_image(density: Samples) -> vtk.vtkImageData:
    image = vtk.vtkImageData()
    image.SetDimensions(SIDE, SIDE, SIDE)
    image.SetOrigin(-1, -1, -1)
    image.SetSpacing([2 / (SIDE - 1)] * 3)
    image.GetPointData().SetScalars(numpy_to_vtk(density.ravel().astype("f"), deep=True))
    return image


def make_volume(
    image: vtk.vtkImageData,
    opacities: list[tuple[float, float]],
    colours: list[tuple[float, float, float, float]],
) -> vtk.vtkVolume:
    """A volume that lights shade, with opacities per 0.04 and colours by density."""
    mapper = vtk.vtkGPUVolumeRayCastMapper()
    mapper.SetInputData(image)
    volume = vtk.vtkVolume()
    volume.SetMapper(mapper)
    look = volume.GetProperty()
    opacity = vtk.vtkPiecewiseFunction()
    for density, share in opacities:
        opacity.AddPoint(density, share)
    colour = vtk.vtkColorTransferFunction()
    for density, *rgb in colours:
        colour.AddRGBPoint(density, *rgb)
    look.SetScalarOpacity(opacity)
    look.SetColor(colour)
    look.SetScalarOpacityUnitDistance(0.04)
    look.SetInterpolationTypeToLinear()
    look.ShadeOn()  # lit by lights, and so in shadow
    look.SetDiffuse(1)
    look.SetSpecular(0)
    return volume


def add(renderer: vtk.vtkRenderer, source: vtk.vtkAlgorithm, *rgb: float) -> vtk.vtkActor:
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(rgb or (1, 1, 1))
    renderer.AddActor(actor)
    return actor


def box(*bounds: float) -> vtk.vtkCubeSource:
    source = vtk.vtkCubeSource()
    source.SetBounds(bounds)
    return source


TISSUE = [(40.0, 0.95, 0.60, 0.40), (180.0, 1.00, 0.95, 0.85)]


def add_scan(renderer: vtk.vtkRenderer) -> None:
    """A scan-like volume that casts on itself, below a bar that casts on it."""
    renderer.AddVolume(make_volume(as_image(porous_ball()), [(40, 0.0), (70, 0.6)], TISSUE))
    add(renderer, box(-0.85, -0.72, -1.6, 0.6, 0.9, 1.03), 0.35, 0.45, 0.6)


def add_smoke(renderer: vtk.vtkRenderer) -> None:
    """Smoke from a chimney."""
    smoke = make_volume(as_image(plume()), [(5, 0.0), (200, 0.3)], [(0, 0.9, 0.9, 0.92)])
    renderer.AddVolume(smoke)
    add(renderer, box(-0.85, -0.35, -0.25, 0.25, -1.0, -0.75), 0.6, 0.35, 0.3)


def add_case(renderer: vtk.vtkRenderer) -> None:
    """A translucent scan with a surface inside, in a case of tinted glass."""
    image = as_image(porous_ball())
    renderer.AddVolume(make_volume(image, [(40, 0.0), (70, 0.03)], TISSUE))
    core = vtk.vtkFlyingEdges3D()
    core.SetInputData(image)
    core.SetValue(0, 165)
    add(renderer, core, 0.85, 0.2, 0.15)
    glass = add(renderer, box(-1.1, 1.1, -1.1, 1.1, -0.99, 1.1), 0.4, 0.75, 0.65)
    glass.GetProperty().SetOpacity(0.25)
    gnomon.vtkGnomonPropKeys.SetTransmits(glass, gnomon.vtkGnomonPropKeys.TRANSMITS_COLORED)


def main() -> None:
    path = sys.argv[1] if len(sys.argv) > 1 else "volume_shadows.png"
    size = [int(number) for number in sys.argv[2:4]] or [800, 600]
    scenes = {"scan": add_scan, "smoke": add_smoke, "case": add_case}

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    scenes[sys.argv[4] if len(sys.argv) > 4 else "scan"](renderer)
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
    gnomon.add_shadows(renderer, volumes=True, glass=True)
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
