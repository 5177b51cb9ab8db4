"""Hills under the sun and a city with soft shadows, by PyVista, as a PNG.

python3 pyvista_shadows.py picture.png
"""

import sys

import gnomon
import numpy
import pyvista


def main() -> None:
    plotter = pyvista.Plotter(
        shape=(1, 2), off_screen=True, window_size=(1000, 450), lighting="none"
    )
    x, y = numpy.meshgrid(numpy.linspace(-6, 6, 121), numpy.linspace(-6, 6, 121))
    hills = pyvista.StructuredGrid(x, y, numpy.sin(x) * numpy.cos(0.7 * y))
    plotter.add_mesh(hills, color="tan", smooth_shading=True)
    sun = pyvista.Light(position=(8, 1, 4), intensity=0.7, light_type="scene light")
    fill = pyvista.Light(intensity=0.25, light_type="headlight")
    plotter.add_light(sun)
    plotter.add_light(fill)
    gnomon.add_shadows(plotter)  # of the active subplot

    plotter.subplot(0, 1)
    plotter.add_mesh(pyvista.Plane(i_size=12, j_size=12), color="lightgray")
    for i, j in numpy.ndindex(5, 5):
        size = 0.4 + (3 * i + 2 * j) % 5 / 4
        box = pyvista.Box((2 * i - 4.4, 2 * i - 3.6, 2 * j - 4.4, 2 * j - 3.6, 0, size))
        plotter.add_mesh(box, color="tan")
    plotter.add_light(sun)
    plotter.add_light(fill)
    gnomon.add_shadows(plotter, light_radius=5)  # degrees of the sky

    plotter.screenshot(sys.argv[1])


main()
