"""Nested isosurfaces of a molecule's density: each takes its share of a soft light.

python3 nested_surfaces.py [picture.png [width height]]
"""

import sys

import gnomon
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

ATOMS = [(0, 0, 0), (1.6, 0.4, 0.2), (-1.2, 1.1, -0.1), (-0.6, -1.5, 0.3), (2.5, -0.9, -0.2)]
SIDE = 96
LEVELS = [  # density, colour, opacity; VTK draws translucent surfaces in this order
    (0.80, (0.95, 0.55, 0.20), 1.0),
    (0.35, (0.30, 0.80, 0.55), 0.30),
    (0.12, (0.35, 0.60, 0.90), 0.18),
]


def make_density() -> vtk.vtkImageData:
    """The sum of Gaussian densities, in a box of 9 x 9 x 9."""
    axis = numpy.linspace(-4.5, 4.5, SIDE)
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij")
    squares = [(x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2 for a, b, c in ATOMS]
    density = numpy.exp(-numpy.array(squares) / 0.9).sum(axis=0)
    image = vtk.vtkImageData()
    image.SetDimensions(SIDE, SIDE, SIDE)
    image.SetOrigin(-4.5, -4.5, -4.5)
    image.SetSpacing([9 / (SIDE - 1)] * 3)
    image.GetPointData().SetScalars(numpy_to_vtk(density.ravel(), deep=True))
    return image


def main() -> None:
    path = sys.argv[1] if len(sys.argv) > 1 else "nested_surfaces.png"
    size = [int(number) for number in sys.argv[2:4]] or [800, 600]

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    density = make_density()
    for level, colour, opacity in LEVELS:
        contour = vtk.vtkFlyingEdges3D()
        contour.SetInputData(density)
        contour.SetValue(0, level)
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputConnection(contour.GetOutputPort())
        mapper.ScalarVisibilityOff()
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(colour)
        actor.GetProperty().SetOpacity(opacity)
        gnomon.vtkGnomonPropKeys.SetTransmits(actor, gnomon.vtkGnomonPropKeys.TRANSMITS_COLORED)
        renderer.AddActor(actor)
    plane = vtk.vtkPlaneSource()
    plane.SetOrigin(-60, -60, -2.6)
    plane.SetPoint1(60, -60, -2.6)
    plane.SetPoint2(-60, 60, -2.6)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(plane.GetOutputPort())
    ground = vtk.vtkActor()
    ground.SetMapper(mapper)
    renderer.AddActor(ground)

    sun = vtk.vtkLight()
    sun.SetPosition(-1.5, -0.5, 2)
    renderer.AddLight(sun)
    gnomon.add_shadows(renderer, sky=0.25, light_radius=6, glass=True)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(3, -12, 7)
    camera.SetFocalPoint(1.3, 0, -0.8)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(32)
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
