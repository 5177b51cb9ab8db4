"""The lines of Python that the pages of docs/guide show.

python3 guide.py FOLDER
"""

import os
import sys

import gnomon
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.util.vtkConstants import VTK_DOUBLE
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkCommonExecutionModel import vtkPolyDataAlgorithm
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkPlaneSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkLight,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
)


def add(renderer: vtkRenderer, source: vtkPolyDataAlgorithm) -> None:
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer.AddActor(actor)


def make_window() -> "tuple[gnomon.vtkGnomonEGLRenderWindow, vtkRenderer]":
    """A cube over a plane under a sun."""
    renderer = vtkRenderer()
    add(renderer, vtkCubeSource())
    plane = vtkPlaneSource()
    plane.SetOrigin(-2, -2, -0.5)
    plane.SetPoint1(2, -2, -0.5)
    plane.SetPoint2(-2, 2, -0.5)
    add(renderer, plane)
    sun = vtkLight()
    sun.SetPosition(2, -1, 3)
    renderer.AddLight(sun)
    renderer.GetActiveCamera().SetPosition(0, -6, 4)
    renderer.GetActiveCamera().SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    window = gnomon.vtkGnomonEGLRenderWindow()
    window.SetSize(160, 120)
    window.AddRenderer(renderer)
    return window, renderer


def read_arrays(window: vtkRenderWindow, renderer: vtkRenderer) -> gnomon.vtkGnomonShadowPass:
    """python.md"""
    shadows = gnomon.add_shadows(renderer, keep_visibility=True)
    shadows.light_radius = 0.5
    window.Render()
    print(gnomon.report(renderer)["choice"])
    dark = gnomon.visibility(renderer)["light 0"] < 0.5
    assert dark.any()
    return shadows


def observe(shadows: gnomon.vtkGnomonShadowPass) -> None:
    """python.md"""

    def note(caller: vtkObject, event: str, shown: float) -> None:
        print(f"{shown:.0%}")

    note.CallDataType = VTK_DOUBLE  # type: ignore[attr-defined]
    shadows.AddObserver("ProgressEvent", note)


def compare(window: vtkRenderWindow, baseline: str) -> None:
    """test_your_pictures.md"""
    gnomon.assert_images_equal(window, baseline, max_difference=8, max_pixels=20)


def main() -> None:
    window, renderer = make_window()
    observe(read_arrays(window, renderer))
    baseline = os.path.join(sys.argv[1], "guide.png")
    os.environ["GNOMON_REFRESH_BASELINES"] = "1"
    compare(window, baseline)
    del os.environ["GNOMON_REFRESH_BASELINES"]
    compare(window, baseline)


main()
