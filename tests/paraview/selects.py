"""Compare what a view with shadows selects on several processes with what plain ParaView selects.

    mpirun -np 3 pvbatch selects.py DATA
"""

import sys

from paraview import servermanager
from paraview.simple import ClearSelection, ExtractSelection, Hide, Render
from paraview.simple import SelectSurfaceCells, SelectSurfacePoints, SetActiveSource

import scenario

RECTANGLES = ([60, 40, 140, 110], [100, 75, 101, 76], [0, 0, 199, 149])


def selected(shadows, data):
    """Return how many cells and points a view selects in each rectangle, and their bounds."""
    view = scenario.make_view(shadows)
    source, display = scenario.show_parts(view, data, "bunny-random", 3)
    Render(view)
    scenario.set_camera(view, (1.4, -2.5, 2.1), (0, 0, 0.4))
    scenario.add_light(view, "sun", (0.7, 1.1, 2.4))
    Render(view)
    found = []
    for select in (SelectSurfaceCells, SelectSurfacePoints):
        for rectangle in RECTANGLES:
            SetActiveSource(source)
            select(Rectangle=rectangle, View=view)
            selection = servermanager._getPyProxy(source.SMProxy.GetSelectionInput(0))
            if not selection:
                found.append((0, 0, ()))
                continue
            extracted = ExtractSelection(Input=source, Selection=selection)
            extracted.UpdatePipeline()
            information = extracted.GetDataInformation()
            count = information.GetNumberOfCells()
            found.append((count, information.GetNumberOfPoints(), information.GetBounds()))
            ClearSelection(source)
            Render(view)
    is_shadowed = not shadows or scenario.report(view)["route"] == "image"
    scenario.check(f"after selections, shadows {shadows}", is_shadowed)
    Hide(source, view)
    return found


def main():
    scenario.load_plugin()
    ours = selected(True, sys.argv[1])
    plain = selected(False, sys.argv[1])
    counts = ", ".join(f"{cells} cells, {points} points" for cells, points, _ in ours)
    scenario.check("selections are plain ParaView's", ours == plain and ours[0][0] > 0, counts)
    scenario.finish()


main()
