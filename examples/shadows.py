"""A sphere over a plane, with shadows, as a PNG; and how much of the plane they cover.

python3 shadows.py picture.png
"""

import sys

import gnomon
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonExecutionModel import vtkPolyDataAlgorithm
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkWindowToImageFilter,
)


def add(renderer: vtkRenderer, source: vtkPolyDataAlgorithm) -> None:
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer.AddActor(actor)


def main() -> None:
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(64)
    sphere.SetPhiResolution(32)
    add(renderer, sphere)
    plane = vtkPlaneSource()
    plane.SetOrigin(-2, -2, -0.5)
    plane.SetPoint1(2, -2, -0.5)
    plane.SetPoint2(-2, 2, -0.5)
    add(renderer, plane)
    renderer.GetActiveCamera().SetPosition(0, -5, 3)
    renderer.GetActiveCamera().SetFocalPoint(0, 0, -0.3)
    renderer.GetActiveCamera().SetViewUp(0, 0, 1)
    renderer.ResetCameraClippingRange()

    window = gnomon.vtkGnomonEGLRenderWindow()  # or, with a display, a vtkRenderWindow
    window.SetSize(640, 480)
    window.AddRenderer(renderer)

    shadows = gnomon.add_shadows(renderer)  # or a PyVista plotter
    shadows.keep_visibility = True
    window.Render()

    arrays = gnomon.visibility(shadows)
    on_plane = (arrays["coverage"] == 1) & (arrays["position"][..., 2] < -0.499)
    print(f"In shadow: {1 - arrays['light 0'][on_plane].mean():.1%} of the plane in sight.")

    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    writer = vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(sys.argv[1])
    writer.Write()


main()
