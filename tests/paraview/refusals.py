"""Do without what several processes cannot share, and say why.

    mpirun -np 3 pvbatch refusals.py DATA OUT

tests/paraview/run.sh looks for the reasons in what the processes print.
"""

import sys

from paraview.simple import Render, SaveScreenshot

import scenario


def picture(view, path):
    Render(view)
    SaveScreenshot(path, view, ImageResolution=[200, 150])
    return scenario.read_picture(path)


def make(shadows, data):
    view = scenario.make_view(shadows)
    scenario.show_parts(view, data, "bunny-random", 3)
    Render(view)
    scenario.set_camera(view, (1.4, -2.5, 2.1), (0, 0, 0.4))
    scenario.add_light(view, "sun", (0.7, 1.1, 2.4))
    return view


def differ(one, other):
    return int((one != other).any(axis=2).sum())


def main():
    data, out = sys.argv[1:]
    scenario.load_plugin()
    view, plain = make(True, data), make(False, data)
    shadows = picture(view, f"{out}/refusals-shadows.png")
    without = picture(plain, f"{out}/refusals-plain.png")
    scenario.check("shadows are drawn", differ(shadows, without) > 1000)

    def is_refused(name):
        now = picture(view, f"{out}/refusals-{name}.png")
        report = scenario.report(view)
        passes = differ(now, without) == 0 and report["route"] == "none"
        figures = f"{differ(now, without)} pixels differ from plain ParaView's"
        scenario.check(f"{name}: without shadows", passes, figures)

    def is_exact(name):
        changed = differ(picture(view, f"{out}/refusals-again.png"), shadows)
        scenario.check(f"{name}: exact shadows", changed == 0, f"{changed} pixels differ")

    # A technique that cannot be shared is replaced by one that can.
    view.Technique = "pcf"
    is_exact("another technique")
    view.Technique = "raytraced"

    # The first process alone has another light, which does not change its picture much.
    lights = view.GetClientSideObject().GetRenderer().GetLights()
    light = lights.GetItemAsObject(lights.GetNumberOfItems() - 1)
    place = light.GetPosition()
    light.SetPosition(place[0], place[1], place[2] + 1e-9)
    is_refused("other lights")
    light.SetPosition(place)
    is_exact("the same lights again")
    scenario.finish()


main()
