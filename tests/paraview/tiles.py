"""Draw without shadows on a display of several tiles.

    pvpython tiles.py PORT     of a server of two tiles on this machine

tests/paraview/run.sh looks for the reason in what the processes print.
"""

import sys

from paraview.simple import Connect, Render, Show, Sphere

import scenario


def main():
    Connect("127.0.0.1", int(sys.argv[1]))
    scenario.load_plugin()
    scenario.load_plugin(remote=True)
    view = scenario.make_view()
    Show(Sphere(), view)
    scenario.add_light(view, "sun", (0.7, 1.1, 2.4))
    Render(view)
    report = scenario.report(view)
    scenario.check("tiles have no shadows", report["route"] == "", f"route '{report['route']}'")
    scenario.finish()


main()
