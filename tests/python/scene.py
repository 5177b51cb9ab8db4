"""A scene for tests."""

from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer

import gnomon


def add(renderer, source):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer.AddActor(actor)
    return actor


class Scene:
    """A ball over a floor, seen from above."""

    def __init__(self, has_sun=True):
        self.renderer = vtkRenderer()
        self.window = gnomon.images._off_screen()
        self.window.SetSize(120, 90)
        self.window.AddRenderer(self.renderer)
        floor = vtkPlaneSource()
        floor.SetOrigin(-3, -3, 0)
        floor.SetPoint1(3, -3, 0)
        floor.SetPoint2(-3, 3, 0)
        ball = vtkSphereSource()
        ball.SetCenter(0, 0, 1)
        ball.SetRadius(0.5)
        add(self.renderer, floor)
        self.ball = add(self.renderer, ball)
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(0, -5, 6)
        camera.SetFocalPoint(0, 0, 0)
        self.renderer.ResetCameraClippingRange()
        if has_sun:
            sun = vtkLight()
            sun.SetPosition(1, 0, 1.5)
            self.renderer.AddLight(sun)
