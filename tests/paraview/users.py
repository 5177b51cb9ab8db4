"""Draw what ParaView's users draw, beside what plain ParaView shows of it.

    [mpirun -np N] pvbatch users.py CASE OUT
    pvpython users.py CASE OUT PORT     of a server on this machine

A case is a function of CASES. Pictures go to the folder OUT. Lines "row,CASE,PROCESSES,WHAT,FIGURE"
are for the table of tests/paraview/run.sh.
"""

import pathlib
import re
import statistics
import sys
import time

import numpy as np
from paraview.simple import Box, Calculator, ColorBy, Connect, Contour, CreateView, Delete
from paraview.simple import GetActiveView, GetActiveViewOrCreate, Line, LoadState, Plane
from paraview.simple import PointSource, Render, ResetSession, Ruler, SaveScreenshot, SaveState
from paraview.simple import Show, Sphere, StreamTracer, Wavelet
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

import scenario

SIZE = (400, 300)
DARKER = 40  # of 255: in shadow


class Pictures:
    """The pictures of a case."""

    def __init__(self, case, out, is_client):
        self.case = case
        self.processes = "client" if is_client else scenario.processes()
        self.out = pathlib.Path(out)
        self.out.mkdir(parents=True, exist_ok=True)

    def path(self, view, name, processes=None):
        kind = "shadows" if getattr(view, "ShowShadows", 0) else "plain"
        name = name.replace(" ", "-")
        return str(self.out / f"{self.case}-{name}-{processes or self.processes}-{kind}.png")

    def take(self, view, name, size=SIZE):
        """Return a screenshot."""
        path = self.path(view, name)
        SaveScreenshot(path, view, ImageResolution=list(size))
        return scenario.read_picture(path)

    def shown(self, view, name):
        """Return the picture that the window shows, on the first process."""
        if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() > 0:
            return None
        window = vtkWindowToImageFilter()
        window.SetInput(view.GetClientSideObject().GetRenderWindow())
        window.ShouldRerenderOff()
        window.ReadFrontBufferOff()
        writer = vtkPNGWriter()
        writer.SetFileName(self.path(view, name))
        writer.SetInputConnection(window.GetOutputPort())
        writer.Write()
        return scenario.read_picture(self.path(view, name))

    def row(self, what, figure):
        print(f"row,{self.case},{self.processes},{what},{figure}", flush=True)


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


def show_box(view):
    """Show a box over a floor."""
    box = Box(XLength=2, YLength=2, ZLength=2, Center=[0, 0, 2])
    floor = Plane(Origin=[-5, -5, 0], Point1=[5, -5, 0], Point2=[-5, 5, 0], XResolution=40)
    show(box, view)
    show(floor, view)
    look(view, (6, -14, 12), (0, 0, 0.5))


def box_over_floor(view):
    """Show a box over a floor, under a sun."""
    show_box(view)
    return scenario.add_light(view, "sun", (-8, -3, 6))


def surface_lic(pictures):
    """A Surface LIC above a floor, drawn before the other props and after them."""
    wavelet = Wavelet(WholeExtent=[-10, 10, -10, 10, -10, 10])
    flow = Calculator(Input=wavelet, Function="coordsY*iHat-coordsX*jHat+0.3*kHat")
    flow.ResultArrayName = "flow"
    contour = Contour(Input=flow, ContourBy=["POINTS", "RTData"], Isosurfaces=[157.0])
    floor = Plane(Origin=[-25, -25, -12], Point1=[25, -25, -12], Point2=[-25, 25, -12])
    ball = Sphere(Radius=2.0, Center=[3, -6, 14], ThetaResolution=32, PhiResolution=32)

    def draw(shadows, order):
        view = scenario.make_view(shadows, SIZE)
        for source in (contour, floor, ball) if order == "first" else (floor, ball, contour):
            display = show(source, view)
            if source == contour:
                display.SelectInputVectors = ["POINTS", "flow"]
                display.Representation = "Surface LIC"
        look(view, (30, -70, 60), (0, 0, -4))
        scenario.add_light(view, "sun", (20, -30, 60))
        return pictures.take(view, order)

    plain = draw(False, "first")
    first = in_shadow(draw(True, "first"), plain)
    last = in_shadow(draw(True, "last"), plain)
    pictures.row("pixels in shadow", int(last.sum()))
    scenario.check("a LIC casts", 1000 < last.sum() < 6000, f"{last.sum()} pixels in shadow")
    others = int((first != last).sum())
    scenario.check("the order of props does not matter", others < 30, f"{others} pixels differ")


def reduced(pictures):
    """Pictures of fewer pixels than the view has: factors, passes, and ways to draw."""
    looks = {
        "plain": {},
        "SSAO": {"UseAmbientOcclusion": 1},
        "tone mapping": {"UseToneMapping": 1},
        "FXAA": {"UseFXAA": 1},
    }
    for look_name, values in looks.items():
        views = [scenario.make_view(shadows, SIZE) for shadows in (False, True)]
        for view in views:
            box_over_floor(view)
            for name, value in values.items():
                setattr(view, name, value)
        shares = {}
        for factor in (1, 2, 3, 4):
            ways = {"still": None, "interactive": None, "larger": (600, 450), "smaller": (260, 194)}
            for way, size in ways.items():
                pair = []
                for view in views:
                    view.StillRenderImageReductionFactor = 1 if way == "interactive" else factor
                    view.ImageReductionFactor = factor
                    name = f"{look_name}-{way}-{factor}"
                    if size:
                        pair.append(pictures.take(view, name, size))
                        continue
                    (view.SMProxy.InteractiveRender if way == "interactive" else view.StillRender)()
                    pair.append(pictures.shown(view, name))
                if pair[0] is not None:
                    shares[factor, way] = in_shadow(pair[1], pair[0]).mean()
        if not shares:
            continue
        of = shares[1, "still"]
        wrong = {case: share for case, share in shares.items() if abs(share - of) > 0.25 * of}
        figures = f"{100 * of:.1f} % of the pixels are in shadow"
        figures += f", {len(shares) - len(wrong)} of {len(shares)} pictures show it {wrong or ''}"
        pictures.row(look_name, f"{len(shares) - len(wrong)} of {len(shares)}")
        scenario.check(f"reduced pictures, {look_name}", of > 0.01 and not wrong, figures)


def annotations(pictures):
    """Props without shadows by nature are noted in the report, and open no window of warnings."""

    def draw(shadows):
        view = scenario.make_view(shadows, SIZE)
        view.CenterAxesVisibility = 1
        view.OrientationAxesVisibility = 1
        view.AxesGrid.Visibility = 1
        show(floor, view)
        show(lines, view)
        show(ball, view)
        Show(ruler, view)
        look(view, (30, -70, 60), (0, 0, -4))
        return view

    wavelet = Wavelet(WholeExtent=[-10, 10, -10, 10, -10, 10])
    flow = Calculator(Input=wavelet, Function="coordsY*iHat-coordsX*jHat+0.3*kHat")
    flow.ResultArrayName = "flow"
    lines = StreamTracer(Input=flow, SeedType="Point Cloud", Vectors=["POINTS", "flow"])
    floor = Plane(Origin=[-25, -25, -12], Point1=[25, -25, -12], Point2=[-25, 25, -12])
    ball = Sphere(Radius=5.0, ThetaResolution=32, PhiResolution=32)
    ruler = Ruler(Point1=[-20, -20, -11], Point2=[20, -20, -11])
    plain, view = draw(False), draw(True)
    for of in (plain, view):
        scenario.add_light(of, "sun", (20, -30, 60))
    dark = in_shadow(pictures.take(view, "sun"), pictures.take(plain, "sun")).mean()
    scenario.check("a ball among annotations casts", 0.003 < dark < 0.1, f"{100 * dark:.1f} %")
    pictures.row("pixels in shadow", f"{100 * dark:.1f} %")
    notes = "; ".join(scenario.report(view)["notes"])
    for text in ("vtkPVGridAxes3DActor", "lines or points"):
        scenario.check(f"the report notes {text}", text in notes, notes)
    for coords in ("Headlight", "Ambient"):
        view.AdditionalLights[0].Coords = coords
        Render(view)
        notes = "; ".join(scenario.report(view)["notes"])
        scenario.check(f"the report notes a lone {coords}", "from the side" in notes, notes)


def views(pictures):
    """Views of all kinds have shadows, sources find these views, and plain states gain shadows."""
    def check(name, view):
        view.ShowShadows = 0
        plain = pictures.take(view, name)
        view.ShowShadows = 1
        judge(name, plain, pictures.take(view, name))

    def judge(name, plain, shadows):
        share = in_shadow(shadows, plain).mean()
        pictures.row(name, f"{100 * share:.1f} %")
        scenario.check(f"{name} shows shadows", 0.01 < share < 0.2, f"{100 * share:.1f} % of it")

    view = scenario.make_view(False, SIZE)
    box_over_floor(view)
    check("a render view", view)
    ruler = Ruler(Point1=[-4, -4, 0.1], Point2=[4, -4, 0.1])
    kind = Show(ruler, view).GetXMLName()
    scenario.check("a ruler is a ruler", kind == "RulerSourceRepresentation", kind)
    Delete(ruler)
    view.ShowShadows = 0
    if vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses() == 1:
        state = pathlib.Path(pictures.out / "state.pvsm")
        SaveState(str(state))
        text = state.read_text()
        for name in ("ShowShadows", "Technique", "LightSize", "LightSamples", "EdgeSamples"):
            text = re.sub(rf'<Property name="{name}".*?</Property>', "", text, flags=re.S)
        state.write_text(text)
        ResetSession()
        LoadState(str(state))
        view = GetActiveViewOrCreate("RenderView")
        check("a state of plain ParaView", view)
        SaveState(str(state))
        state.write_text(state.read_text().replace('type="RenderView"', 'type="GnomonShadowView"'))
        ResetSession()
        LoadState(str(state))
        view = GetActiveView()  # GetActiveViewOrCreate() would not take it for a RenderView
        kind = view.GetXMLName()
        scenario.check("an earlier view's name", kind == "GnomonShadowView", kind)
        scenario.check("a state keeps shadows", view.ShowShadows == 1, str(view.ShowShadows))
        check("a state of an earlier version", view)
    for kind in ("RenderViewWithEDL", "OrthographicSliceView"):
        view = scenario.make_view(False, SIZE, kind)
        box_over_floor(view)
        if kind == "RenderViewWithEDL":
            check(kind, view)
        Delete(view)
    view = CreateView("ComparativeRenderView")
    view.ViewSize = list(SIZE)
    view.UseLight = 1
    view.OrientationAxesVisibility = view.CenterAxesVisibility = 0
    show_box(view)
    plain = pictures.take(view, "comparative")
    view.ShowShadows = 1
    judge("a comparative view", plain, pictures.take(view, "comparative-with-shadows"))


def looks(pictures):
    """Strength of shadows, lights with a size, and which lights cast."""
    view = scenario.make_view(False, SIZE)
    sun = box_over_floor(view)
    plain = pictures.take(view, "plain")
    view.ShowShadows = 1
    full = pictures.take(view, "full")
    mask = in_shadow(full, plain)
    view.ShadowStrength = 0.5
    half = pictures.take(view, "half")
    ratio = half[mask].mean() / plain[mask].mean()
    scenario.check("half of a shadow", 0.45 < ratio < 0.55, f"{ratio:.2f} of the light")
    view.ShadowStrength = 1.0
    sun.Radius = 8.0
    view.LightSamples = 16
    soft = pictures.take(view, "soft")
    between = ((soft > full) & (soft < plain - 2)).any(axis=2).mean()
    pictures.row("pixels of a penumbra", f"{100 * between:.1f} %")
    scenario.check("a light's radius", between > 0.005, f"{100 * between:.1f} % of a penumbra")
    sun.Radius = 0.0
    again = int((pictures.take(view, "again") != full).any(axis=2).sum())
    scenario.check("a light without a radius", again == 0, f"{again} pixels differ")
    scenario.add_light(view, "sun", (5, -6, 8)).Intensity = 0.5
    counts = {}
    for name, casting in (("all", "All lights"), ("brightest", "The brightest light")):
        view.Casting = casting
        Render(view)
        counts[name] = sum(light["casts"] for light in scenario.report(view)["lights"])
    scenario.check("casting lights", counts == {"all": 2, "brightest": 1}, str(counts))


def terminators(pictures):
    """A coarse sphere has smooth edges of shadows, on several processes as on one."""
    view = scenario.make_view(True, SIZE)
    show(Sphere(Radius=2.5, ThetaResolution=10, PhiResolution=10), view)
    look(view, (6, -14, 12))
    scenario.add_light(view, "sun", (-8, -3, 6))
    smooth = pictures.take(view, "smooth")
    view.SmoothTerminators = 0
    differ = int((pictures.take(view, "as-it-is") != smooth).any(axis=2).sum())
    pictures.row("pixels of smooth terminators", differ)
    scenario.check("terminators", differ > 300, f"{differ} pixels differ")
    if pictures.processes != 1:
        alone = scenario.read_picture(pictures.path(view, "smooth", 1))
        unlike = int((np.abs(alone - smooth).max(axis=2) > DARKER).sum())
        pictures.row("pixels unlike those of one process", unlike)
        scenario.check("terminators of one process", unlike == 0, f"{unlike} pixels differ")


def casters(pictures):
    """All looks of the Display panel cast: spheres, tubes, translucent surfaces and volumes."""
    floor = Plane(Origin=[-5, -5, 0], Point1=[5, -5, 0], Point2=[-5, 5, 0], XResolution=40)
    box = Box(XLength=2, YLength=2, ZLength=2, Center=[0, 0, 2])
    line = Line(Point1=[-3, -2, 2], Point2=[3, 2, 2], Resolution=6)
    points = PointSource(Center=[0, 0, 2], Radius=1.5, NumberOfPoints=10)

    def share(name, source, array=None, **properties):
        view = scenario.make_view(False, SIZE)
        show(floor, view)
        display = show(source, view)
        for key, value in properties.items():
            setattr(display, key, value)
        if array:
            ColorBy(display, ("POINTS", array))
        look(view, (6, -14, 12), (0, 0, 0.5))
        scenario.add_light(view, "sun", (-4, -3, 9))
        plain = pictures.take(view, name)
        view.ShowShadows = view.TranslucentCasts = view.VolumesCast = 1
        dark = in_shadow(pictures.take(view, name), plain).mean()
        pictures.row(name, f"{100 * dark:.1f} %")
        scenario.check(f"{name} casts", 0.001 < dark < 0.1, f"{100 * dark:.1f} % of the picture")
        Delete(view)

    share("tubes", line, RenderLinesAsTubes=1, LineWidth=12.0)
    share("spheres", points, RenderPointsAsSpheres=1, PointSize=24.0)
    if pictures.processes == 1:  # Debian's ParaView cannot redistribute data to order it
        share("a translucent box", box, Opacity=0.5)
        wave = Wavelet(WholeExtent=[-10, 10, -10, 10, -10, 10])
        place = {"Scale": [0.1, 0.1, 0.1], "Position": [0, 0, 2]}
        share("a volume", wave, "RTData", Representation="Volume", **place)


def dragging(pictures):
    """A soft light while the view is turned: frames beside those of a plain view."""

    def draw(shadows):
        view = scenario.make_view(shadows, (800, 600))
        wavelet = Wavelet(WholeExtent=[-20, 20, -20, 20, -20, 20])
        show(Contour(Input=wavelet, ContourBy=["POINTS", "RTData"], Isosurfaces=[130.0]), view)
        show(Plane(Origin=[-40, -40, -22], Point1=[40, -40, -22], Point2=[-40, 40, -22]), view)
        look(view, (80, -140, 120), (0, 0, -4))
        scenario.add_light(view, "sun", (20, -30, 60))
        return view

    def milliseconds(view):
        times = []
        for number in range(12):
            view.CameraPosition = [80 + number, -140, 120]
            start = time.perf_counter()
            view.SMProxy.InteractiveRender()
            times.append(1000 * (time.perf_counter() - start))
        return statistics.median(times[3:])

    plain, view = draw(False), draw(True)
    scenario.check("auto is the default", view.Technique == "auto", view.Technique)
    view.LightSize = 4.0
    times = {}
    for technique in ("raytraced", "auto"):
        view.Technique = technique
        times[technique], plain_time = milliseconds(view), milliseconds(plain)
        pictures.row(f"plain frames of {technique}", f"{times[technique] / plain_time:.1f}")
    text = ", ".join(f"{name} {value:.0f} ms" for name, value in times.items())
    text += f", plain {plain_time:.0f} ms"
    # The view asks its window for five frames a second.
    limit = max(1.2 * 200.0, 1.6 * plain_time)
    scenario.check("a drag keeps its rate", max(times.values()) < limit, text)


CASES = {
    function.__name__: function
    for function in (
        surface_lic,
        reduced,
        annotations,
        views,
        looks,
        terminators,
        casters,
        dragging,
    )
}


def main():
    case, out = sys.argv[1:3]
    if len(sys.argv) > 3:
        Connect("127.0.0.1", int(sys.argv[3]))
        scenario.load_plugin(remote=True)
    scenario.load_plugin()
    CASES[case](Pictures(case, out, len(sys.argv) > 3))
    scenario.finish()


if __name__ == "__main__":
    main()
