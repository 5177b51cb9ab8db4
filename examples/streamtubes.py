"""Stream tubes of a wind with two vortices, over a floor that catches their shadows.

Tubes that cross in the picture may be far apart in space. Their shadows on the floor and on each
other show the distance. Any polydata casts and
receives, the output of a tube filter, too.

python3 streamtubes.py [picture.png [width height]]
"""

import sys

import gnomon
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk


def make_flow() -> vtk.vtkImageData:
    """A field of velocities on a grid: a wind along x, in which two vortices climb."""
    n = (64, 48, 32)
    grid = vtk.vtkImageData()
    grid.SetDimensions(n)
    grid.SetSpacing(0.2, 0.2, 0.2)
    grid.SetOrigin(-6.3, -4.7, 0.0)
    xs, ys, zs = (0.2 * np.arange(n[0]) - 6.3, 0.2 * np.arange(n[1]) - 4.7, 0.2 * np.arange(n[2]))
    z, y, x = np.meshgrid(zs, ys, xs, indexing="ij")
    flow = np.stack([np.full_like(x, 1.0), np.zeros_like(x), np.zeros_like(x)], -1)
    for side in (-1, 1):
        dy, dz = y - side * (1.6 + 0.10 * x), z - (2.4 + 0.12 * x)
        swirl = side * 2.0 / (0.5 + dy**2 + dz**2)
        flow[..., 1] -= swirl * dz
        flow[..., 2] += swirl * dy
    velocity = numpy_to_vtk(flow.reshape(-1, 3), deep=True)
    velocity.SetName("velocity")
    grid.GetPointData().SetVectors(velocity)
    return grid


def add(
    renderer: vtk.vtkRenderer,
    algorithm: vtk.vtkPolyDataAlgorithm,
    colours: "vtk.vtkLookupTable | None" = None,
) -> vtk.vtkActor:
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(algorithm.GetOutputPort())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetDiffuse(0.85)
    renderer.AddActor(actor)
    if colours:
        mapper.SetLookupTable(colours)
        mapper.UseLookupTableScalarRangeOn()
    return actor


def main() -> None:
    path = sys.argv[1] if len(sys.argv) > 1 else "streamtubes.png"
    size = [int(number) for number in sys.argv[2:4]] or [800, 600]

    rake = vtk.vtkLineSource()
    rake.SetPoint1(-6.2, -2.7, 1.5)
    rake.SetPoint2(-6.2, 2.7, 1.5)
    rake.SetResolution(19)
    lines = vtk.vtkStreamTracer()
    lines.SetInputData(make_flow())
    lines.SetSourceConnection(rake.GetOutputPort())
    lines.SetMaximumPropagation(60)
    lines.SetIntegratorTypeToRungeKutta45()
    tubes = vtk.vtkTubeFilter()
    tubes.SetInputConnection(lines.GetOutputPort())
    tubes.SetRadius(0.09)
    tubes.SetNumberOfSides(10)
    tubes.CappingOn()
    speed = vtk.vtkArrayCalculator()
    speed.SetInputConnection(tubes.GetOutputPort())
    speed.AddVectorArrayName("velocity")
    speed.SetFunction("mag(velocity)")
    speed.SetResultArrayName("speed")

    colours = vtk.vtkColorTransferFunction()
    colours.AddRGBPoint(0.9, 0.16, 0.35, 0.62)
    colours.AddRGBPoint(1.4, 0.45, 0.72, 0.75)
    colours.AddRGBPoint(2.0, 0.97, 0.86, 0.55)
    colours.AddRGBPoint(2.6, 0.85, 0.35, 0.22)

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    add(renderer, speed, colours)
    floor = vtk.vtkPlaneSource()
    floor.SetOrigin(-40, -40, 0)
    floor.SetPoint1(40, -40, 0)
    floor.SetPoint2(-40, 40, 0)
    add(renderer, floor).GetProperty().SetColor(0.93, 0.92, 0.90)

    lamp = vtk.vtkLight()
    lamp.SetPosition(-0.35, -0.5, 1)  # directional: it shines towards the origin
    renderer.AddLight(lamp)
    gnomon.add_shadows(renderer, sky=0.25, light_radius=2)  # its disc, in degrees

    camera = renderer.GetActiveCamera()
    camera.SetPosition(7.6, -18, 11)
    camera.SetFocalPoint(0.8, -0.6, 1.0)
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
