"""Frames of an animation: a lamp circles over a set of chess pieces, and their shadows turn.

Each frame is a picture at rest: with `auto`, its shadows are exact. The pass keeps what did not
change from frame to frame. Here only the light moves, so a frame computes new shadows and nothing
else. A program for movies makes one of the frames: ffmpeg -i frame_%03d.png movie.mp4

python3 moving_light.py [frame_%03d.png [width height [frames]]]
"""

import math
import sys

import gnomon
import vtk

# The outline of a piece from the foot to the top: radius and height.
PAWN = [(1.0, 0), (1.0, 0.25), (0.75, 0.4), (0.42, 0.75), (0.33, 1.5), (0.62, 1.65), (0.3, 1.75),
        (0.5, 2.0), (0.55, 2.25), (0.42, 2.55), (0, 2.7)]
QUEEN = [(1.2, 0), (1.2, 0.3), (0.9, 0.55), (0.55, 1.2), (0.42, 2.9), (0.8, 3.1), (0.45, 3.25),
         (0.6, 3.6), (0.85, 4.2), (0.5, 4.15), (0.25, 4.3), (0, 4.6)]


def make_piece(outline: "list[tuple[float, float]]") -> vtk.vtkPolyDataNormals:
    points = vtk.vtkPoints()
    lines = vtk.vtkCellArray()
    lines.InsertNextCell(len(outline))
    for radius, height in outline:
        lines.InsertCellPoint(points.InsertNextPoint(radius, 0, height))
    profile = vtk.vtkPolyData()
    profile.SetPoints(points)
    profile.SetLines(lines)
    turned = vtk.vtkRotationalExtrusionFilter()
    turned.SetInputData(profile)
    turned.SetResolution(48)
    turned.CappingOff()
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(turned.GetOutputPort())
    normals.SetFeatureAngle(50)
    return normals


def make_board() -> vtk.vtkPlaneSource:
    board = vtk.vtkPlaneSource()
    board.SetOrigin(-10, -10, 0)
    board.SetPoint1(10, -10, 0)
    board.SetPoint2(-10, 10, 0)
    board.SetResolution(8, 8)
    board.Update()
    colours = vtk.vtkUnsignedCharArray()
    colours.SetNumberOfComponents(3)
    for i in range(64):
        colours.InsertNextTuple3(*((222, 205, 175) if (i + i // 8) % 2 else (120, 84, 62)))
    board.GetOutput().GetCellData().SetScalars(colours)
    return board


def add(
    renderer: vtk.vtkRenderer,
    algorithm: vtk.vtkPolyDataAlgorithm,
    colour: "tuple[float, float, float]" = (1, 1, 1),
    x: float = 0.0,
    y: float = 0.0,
) -> None:
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(algorithm.GetOutputPort())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.SetPosition(x, y, 0)
    actor.GetProperty().SetColor(colour)
    actor.GetProperty().SetSpecular(0.2)
    actor.GetProperty().SetSpecularPower(40)
    renderer.AddActor(actor)


def main() -> None:
    pattern = sys.argv[1] if len(sys.argv) > 1 else "frame_%03d.png"
    size = [int(number) for number in sys.argv[2:4]] or [800, 600]
    frames = int(sys.argv[4]) if len(sys.argv) > 4 else 72

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(0.12, 0.13, 0.16)
    add(renderer, make_board())
    ivory, ebony = (0.95, 0.90, 0.80), (0.30, 0.26, 0.25)
    for outline, colour, x, y in ((QUEEN, ivory, -1.25, -1.25), (QUEEN, ebony, 3.75, 3.75),
                                  (PAWN, ivory, 1.25, -3.75), (PAWN, ivory, -6.25, 1.25),
                                  (PAWN, ebony, -3.75, 6.25), (PAWN, ebony, 6.25, -1.25)):
        add(renderer, make_piece(outline), colour, x, y)
    lamp = gnomon.vtkGnomonAreaLight()
    lamp.SetRadius(0.6)
    renderer.AddLight(lamp)
    gnomon.add_shadows(renderer, sky=0.2)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(-7, -22, 17)
    camera.SetFocalPoint(0, -0.8, 0)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCameraClippingRange()

    window = gnomon.vtkGnomonEGLRenderWindow()  # or, with a display, a vtkRenderWindow
    window.SetSize(size)
    window.AddRenderer(renderer)
    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    for frame in range(frames):
        angle = 2 * math.pi * frame / frames + 2.6
        lamp.SetPosition(13 * math.cos(angle), 13 * math.sin(angle), 11)
        window.Render()
        picture.Modified()  # the filter cannot see that the window has another picture
        writer.SetFileName(pattern % frame if "%" in pattern else pattern)
        writer.Write()


main()
