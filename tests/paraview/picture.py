"""Draw a picture; a client of a server draws what a batch of as many processes draws.

    mpirun -np 3 pvbatch picture.py DATA PICTURE
    pvpython picture.py DATA PICTURE BATCH'S PORT     of a server on this machine
"""

import sys

from paraview.simple import Connect, Render, SaveScreenshot

import scenario


def draw(data, path):
    """Draw a picture, and write it and its visibility."""
    view = scenario.make_view()
    scenario.show_parts(view, data, "bunny-random", 3)
    Render(view)
    scenario.set_camera(view, (1.4, -2.5, 2.1), (0, 0, 0.4))
    scenario.add_light(view, "sun", (0.7, 1.1, 2.4))
    Render(view)
    view.SMProxy.InteractiveRender()
    view.VisibilityFile = path + ".vti"
    Render(view)
    view.VisibilityFile = ""
    SaveScreenshot(path, view, ImageResolution=[200, 150])
    return view


def compare(view, path, batch_path):
    report = scenario.report(view)
    passes = report["processes"] == 3 and report["route"] == "image"
    scenario.check("the client has the server's report", passes, f"route '{report['route']}'")
    ours, batch = scenario.read_picture(path), scenario.read_picture(batch_path)
    differ = int((ours != batch).any(axis=2).sum()) if ours.shape == batch.shape else ours.size
    scenario.check("the client's picture is the batch's", differ == 0, f"{differ} pixels differ")
    ours = scenario.read_visibility(path + ".vti")
    batch = scenario.read_visibility(batch_path + ".vti")
    shadowed = int((ours["light 0"] < 1).sum())
    is_same = ours.keys() == batch.keys()
    is_same = is_same and all((ours[name] == batch[name]).all() for name in ours)
    figures = f"{shadowed} pixels in shadow"
    scenario.check("the server writes the batch's visibility", is_same and shadowed > 1000, figures)


def main():
    data, path = sys.argv[1:3]
    is_client = len(sys.argv) > 3
    if is_client:
        Connect("127.0.0.1", int(sys.argv[4]))
    scenario.load_plugin()
    if is_client:
        scenario.load_plugin(remote=True)
    view = draw(data, path)
    if is_client:
        compare(view, path, sys.argv[3])
    else:
        report = scenario.report(view)
        passes = report["processes"] == 3 and report["route"] == "image"
        scenario.check("the batch's picture", passes, f"{report['processes']} processes")
    scenario.finish()


main()
