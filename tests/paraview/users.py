"""Draw what ParaView's users draw, beside what plain ParaView shows of it.

    [mpirun -np N] pvbatch users.py CASE OUT

A case is a function of CASES. Pictures go to the folder OUT. Lines "row,CASE,PROCESSES,WHAT,FIGURE"
are for the table of tests/paraview/run.sh.
"""

import pathlib
import sys

from paraview.simple import Calculator, Contour, Plane, Render, SaveScreenshot, Show, Sphere, Wavelet

import scenario

SIZE = (400, 300)
DARKER = 40  # of 255: in shadow


class Pictures:
    """The pictures of a case."""

    def __init__(self, case, out):
        self.case = case
        self.out = pathlib.Path(out)
        self.out.mkdir(parents=True, exist_ok=True)

    def take(self, view, name, size=SIZE):
        path = str(self.out / f"{self.case}-{name}-{scenario.processes()}.png")
        SaveScreenshot(path, view, ImageResolution=list(size))
        return scenario.read_picture(path)

    def row(self, what, figure):
        print(f"row,{self.case},{scenario.processes()},{what},{figure}", flush=True)


def in_shadow(picture, plain):
    """Return the pixels that are darker than in a plain picture."""
    return (plain - picture).max(axis=2) > DARKER


def look(view, position, focus=(0, 0, 0)):
    Render(view)  # the first one resets the camera
    scenario.set_camera(view, position, focus)
    view.CameraViewAngle = 30


def show(source, view, representation="Surface"):
    display = Show(source, view)
    display.ColorArrayName = ["POINTS", ""]
    display.Representation = representation
    return display


def surface_lic(pictures):
    """A Surface LIC above a floor, drawn before the other props and after them."""
    wavelet = Wavelet(WholeExtent=[-10, 10, -10, 10, -10, 10])
    flow = Calculator(Input=wavelet, Function="coordsY*iHat-coordsX*jHat+0.3*kHat")
    flow.ResultArrayName = "flow"
    contour = Contour(Input=flow, ContourBy=["POINTS", "RTData"], Isosurfaces=[157.0])
    floor = Plane(Origin=[-25, -25, -12], Point1=[25, -25, -12], Point2=[-25, 25, -12])
    ball = Sphere(Radius=2.0, Center=[3, -6, 14], ThetaResolution=32, PhiResolution=32)

    def draw(kind, order):
        view = scenario.make_view(kind, SIZE)
        for source in (contour, floor, ball) if order == "first" else (floor, ball, contour):
            display = show(source, view)
            if source == contour:
                display.SelectInputVectors = ["POINTS", "flow"]
                display.Representation = "Surface LIC"
        look(view, (30, -70, 60), (0, 0, -4))
        scenario.add_light(view, "sun", (20, -30, 60))
        return pictures.take(view, f"{kind}-{order}")

    plain = draw("RenderView", "first")
    first = in_shadow(draw("GnomonShadowView", "first"), plain)
    last = in_shadow(draw("GnomonShadowView", "last"), plain)
    pictures.row("pixels in shadow", int(last.sum()))
    scenario.check("a LIC casts", 1000 < last.sum() < 6000, f"{last.sum()} pixels in shadow")
    others = int((first != last).sum())
    scenario.check("the order of props does not matter", others < 30, f"{others} pixels differ")


CASES = {function.__name__: function for function in (surface_lic,)}


def main():
    case, out = sys.argv[1:]
    scenario.load_plugin()
    CASES[case](Pictures(case, out))
    scenario.finish()


main()
