"""The window of drag.cxx in Python.

    drag.py [STYLE [plain] [SETTING=VALUE ...]]
"""

import json
import sys

import gnomon
import vtkmodules.vtkRenderingUI  # noqa: F401: opens the window
from vtkmodules import vtkInteractionStyle
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkFiltersSources import vtkConeSource, vtkPlaneSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkLight,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkRenderWindowInteractor,
)

# Not Switch, which has its styles' keys seen by them alone.
STYLES = """DrawPolygon Flight Image JoystickActor JoystickCamera MultiTouchCamera RubberBand2D
RubberBand3D RubberBandPick RubberBandZoom Terrain TrackballActor TrackballCamera Unicam"""


def add(renderer, source):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer.AddActor(actor)
    return actor


def shown_picture(window):
    width, height = window.GetSize()
    pixels = vtkUnsignedCharArray()
    window.GetPixelData(0, 0, width - 1, height - 1, 1, pixels, 0)
    return bytes(memoryview(pixels))


def main(style_name, *words):
    settings = dict(word.split("=") for word in words if word != "plain")
    renderer = vtkRenderer()
    plane = vtkPlaneSource()
    plane.SetOrigin(-1, -1, -0.6)
    plane.SetPoint1(1, -1, -0.6)
    plane.SetPoint2(-1, 1, -0.6)
    add(renderer, plane).PickableOff()
    cone = add(renderer, vtkConeSource())
    light = vtkLight()
    light.SetPosition(1, -1, 2)
    light.SetPositional(True)
    renderer.AddLight(light)
    camera = renderer.GetActiveCamera()

    def put_back():
        cone.SetPosition(0, 0, 0)
        cone.SetOrientation(0, 0, 0)
        cone.SetScale(1, 1, 1)
        camera.SetPosition(0, -3, 2)
        camera.SetFocalPoint(0, 0, 0)
        camera.SetViewUp(0, 0, 1)
        renderer.ResetCamera()

    put_back()
    if "plain" not in words:
        gnomon.add_shadows(renderer, **settings)

    window = vtkRenderWindow()
    window.SetSize(160, 120)
    window.SetMultiSamples(0)
    window.AddRenderer(renderer)
    interactor = vtkRenderWindowInteractor()
    interactor.SetRenderWindow(window)
    interactor.SetNumberOfFlyFrames(3)
    style = getattr(vtkInteractionStyle, f"vtkInteractorStyle{style_name}")()
    interactor.SetInteractorStyle(style)
    frames = 0

    def on_end(*_):
        nonlocal frames
        frames += 1

    def state():
        matrix = cone.GetMatrix()
        return {
            "position": camera.GetPosition(),
            "focal point": camera.GetFocalPoint(),
            "view up": camera.GetViewUp(),
            "cone": [matrix.GetElement(i, j) for i in range(4) for j in range(4)],
            "frames": frames,
        }

    def compare():
        shown = shown_picture(window)
        shadows = renderer.GetPass()
        if shadows:
            fresh = gnomon.vtkGnomonShadowPass()
            fresh.SetInteractive(fresh.INTERACTIVE_OFF)
            for setting in settings.items():
                fresh.SetSetting(*setting)
            renderer.SetPass(fresh)
        window.Render()
        while shadows and fresh.GetProgress() < 1:
            window.Render()
        new = shown_picture(window)
        renderer.SetPass(shadows)
        return {"different": sum(shown[i : i + 3] != new[i : i + 3] for i in range(0, len(new), 3))}

    def on_key(*_):
        key = interactor.GetKeySym()
        if key in ("F10", "F11", "F12"):
            print(json.dumps(dict(compare() if key == "F10" else state(), key=key)), flush=True)
        elif key == "F9":
            put_back()
            interactor.Render()

    window.AddObserver("EndEvent", on_end)
    style.AddObserver("KeyReleaseEvent", on_key)  # also while the style has the focus
    interactor.Initialize()
    window.Render()
    print("{}", flush=True)  # ready
    interactor.Start()


if __name__ == "__main__":
    if len(sys.argv) > 1:
        main(*sys.argv[1:])
    else:
        print(STYLES)
