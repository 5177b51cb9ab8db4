"""Parts that the clients in Python share: a scene, shadows as arguments say, and a line for each
frame, for drag.py to read. client.h is the same in C++."""

import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401: VTK's windows
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer

SIZE = (320, 240)  # of the window, in the screen's upper left corner


def fill(window, interactor):
    """Fill a window with the scene, and tell of its frames and its interactor's timers."""
    plane = vtkPlaneSource()
    plane.SetOrigin(-2, -2, 0)
    plane.SetPoint1(2, -2, 0)
    plane.SetPoint2(-2, 2, 0)
    sphere = vtkSphereSource()
    sphere.SetCenter(0, 0, 1)
    renderer = vtkRenderer()
    for source in (plane, sphere):
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(source.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        renderer.AddActor(actor)
    light = vtkLight()
    light.SetPosition(1, 1, 3)
    light.SetPositional(True)
    light.SetConeAngle(90)  # a point light
    renderer.AddLight(light)

    settings = dict(argument.split("=") for argument in sys.argv[1:])
    place = settings.pop("camera", "0,-6,4,0,0,1").split(",")
    camera = renderer.GetActiveCamera()
    camera.SetPosition(*map(float, place[:3]))
    camera.SetViewUp(*map(float, place[3:]))
    renderer.ResetCameraClippingRange()
    window.AddRenderer(renderer)
    interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
    shadows = None
    if settings:
        from gnomon import add_shadows

        shadows = add_shadows(renderer, **settings)

    def tell_frame(*_):
        progress = shadows.GetProgress() if shadows else 1
        place = (*camera.GetPosition(), *camera.GetViewUp())
        x = interactor.GetEventPosition()[0]
        print("frame", progress, x, ",".join(map(str, place)), flush=True)

    renderer.AddObserver("EndEvent", tell_frame)
    interactor.AddObserver("TimerEvent", lambda *_: print("timer", flush=True))
