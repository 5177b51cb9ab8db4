"""All techniques side by side: one scene, a cell of the picture for each.

The cells share the scene and the camera; each renderer has a pass and a light of its own. Maps are
small here, so that the techniques show how they differ. Techniques for soft shadows get the light
as a disc, in the last cells, with the name in red.

python3 technique_table.py [picture.png [width height]]
"""

import sys

import gnomon
import vtk

COLUMNS, ROWS = 5, 5
SOFT = ("pcss", "montecarlo", "sampled", "penumbra")
WITHOUT_MAP = ("planar", "penumbra", "raytraced")


def add(
    renderers: "list[vtk.vtkRenderer]",
    algorithm: vtk.vtkPolyDataAlgorithm,
    colour: "tuple[float, float, float]",
) -> None:
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(algorithm.GetOutputPort())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(colour)
    actor.GetProperty().SetAmbient(0.25)  # ambient light is never shadowed
    for renderer in renderers:
        renderer.AddActor(actor)


def add_label(
    renderer: vtk.vtkRenderer, text: str, colour: "tuple[float, float, float]", font_size: int
) -> None:
    label = vtk.vtkTextActor()
    label.SetInput(text)
    label.SetPosition(font_size / 2, font_size / 3)
    label.GetTextProperty().SetFontSize(font_size)
    label.GetTextProperty().SetColor(colour)
    renderer.AddViewProp(label)


def main() -> None:
    path = sys.argv[1] if len(sys.argv) > 1 else "technique_table.png"
    size = [int(number) for number in sys.argv[2:4]] or [1000, 750]

    names = [name for name in gnomon.techniques() if name != "auto"]
    names.sort(key=lambda name: name in SOFT)  # stable: the rest stays in its order

    window = gnomon.vtkGnomonEGLRenderWindow()  # or, with a display, a vtkRenderWindow
    window.SetSize(size)
    camera = vtk.vtkCamera()
    camera.SetPosition(3.4, -7.5, 5.2)
    camera.SetFocalPoint(0.05, 0.0, 0.66)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(18)
    backdrop = vtk.vtkRenderer()  # of cells without a technique
    backdrop.SetBackground(0.93, 0.92, 0.89)
    window.AddRenderer(backdrop)
    renderers = []
    for i, name in enumerate([None, *names]):
        column, row = i % COLUMNS, ROWS - 1 - i // COLUMNS
        renderer = vtk.vtkRenderer()
        renderer.SetViewport(column / COLUMNS, row / ROWS, (column + 1) / COLUMNS, (row + 1) / ROWS)
        renderer.SetActiveCamera(camera)
        light = vtk.vtkLight()
        light.SetPosition(-0.55, -0.35, 0.9)  # directional: it shines towards the origin
        renderer.AddLight(light)
        is_soft = name in SOFT
        if name:
            shadows = gnomon.add_shadows(renderer, name)
            if name not in WITHOUT_MAP:
                shadows.map_size = 256
            if is_soft:
                gnomon.vtkGnomonLightKeys.SetSetting(light, "light_radius", 12)  # degrees
        colour = (0.7, 0.1, 0.1) if is_soft else (0, 0, 0)
        add_label(renderer, name or "no shadows", colour, max(size[1] // 40, 6))
        window.AddRenderer(renderer)
        renderers.append(renderer)

    torus = vtk.vtkParametricTorus()
    torus.SetRingRadius(0.75)
    torus.SetCrossSectionRadius(0.22)
    ring = vtk.vtkParametricFunctionSource()
    ring.SetParametricFunction(torus)
    ring.SetUResolution(48)
    ring.SetVResolution(24)
    up = vtk.vtkTransform()
    up.Translate(0.1, 0, 1.05)
    up.RotateZ(20)
    up.RotateX(70)
    placed = vtk.vtkTransformPolyDataFilter()
    placed.SetInputConnection(ring.GetOutputPort())
    placed.SetTransform(up)
    placed_normals = vtk.vtkPolyDataNormals()
    placed_normals.SetInputConnection(placed.GetOutputPort())
    add(renderers, placed_normals, (0.90, 0.55, 0.30))
    pole = vtk.vtkCubeSource()
    pole.SetBounds(-1.15, -1.0, -0.4, -0.25, 0, 1.1)
    add(renderers, pole, (0.45, 0.62, 0.80))
    ground = vtk.vtkPlaneSource()
    ground.SetOrigin(-20, -20, 0)
    ground.SetPoint1(20, -20, 0)
    ground.SetPoint2(-20, 20, 0)
    add(renderers, ground, (0.88, 0.87, 0.84))
    for renderer in renderers:
        renderer.ResetCameraClippingRange()

    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()


main()
