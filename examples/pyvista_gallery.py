"""The programs of docs/guide/pyvista.md, each a function that makes a plotter; their pictures.

python3 pyvista_gallery.py FOLDER
"""

import os
import sys

import gnomon
import numpy
import pyvista


def first() -> pyvista.Plotter:
    plotter = pyvista.Plotter()
    plotter.add_mesh(pyvista.Sphere(), color="tomato", smooth_shading=True)
    plotter.add_floor(lighting=True, color="white", pad=2)
    gnomon.add_shadows(plotter)
    return plotter


def terrain() -> pyvista.Plotter:
    axis = numpy.linspace(-8, 8, 160)
    x, y = numpy.meshgrid(axis, axis)
    hills = pyvista.StructuredGrid(x, y, numpy.sin(x) * numpy.cos(0.7 * y))
    hills["height"] = hills.points[:, 2]
    plotter = pyvista.Plotter(lighting="none")
    plotter.add_mesh(hills, cmap="gist_earth", clim=(-1, 1), smooth_shading=True)
    plotter.add_light(pyvista.Light(position=(8, 2, 3), light_type="scene light"))
    gnomon.add_shadows(plotter, sky=0.4)
    return plotter


def glyphs() -> pyvista.Plotter:
    ball = pyvista.Sphere(theta_resolution=16, phi_resolution=16)
    ball["size"] = 1 + numpy.sin(9 * ball.points[:, 0])
    cones = ball.glyph(orient="Normals", scale="size", factor=0.3, geom=pyvista.Cone())
    plotter = pyvista.Plotter()
    plotter.add_mesh(ball, color="white")
    plotter.add_mesh(cones, color="gold")
    plotter.enable_ssao(radius=0.2)
    plotter.enable_anti_aliasing("ssaa")
    gnomon.add_shadows(plotter, light_radius=3)
    return plotter


def tubes() -> pyvista.Plotter:
    spiral = pyvista.examples.load_spline()
    plotter = pyvista.Plotter()
    plotter.add_mesh(spiral.tube(radius=0.1), scalars="arc_length")
    plotter.add_floor(lighting=True, color="tan", pad=1)
    plotter.enable_anti_aliasing("ssaa")
    gnomon.add_shadows(plotter, sky=0.2)
    return plotter


def glass() -> pyvista.Plotter:
    plotter = pyvista.Plotter()
    for value, color in (140, "skyblue"), (230, "red"):
        shell = pyvista.Wavelet().contour([value])
        plotter.add_mesh(shell, color=color, opacity=0.5, smooth_shading=True)
    plotter.add_floor(lighting=True, color="white", pad=1)
    plotter.enable_anti_aliasing("ssaa")
    plotter.enable_depth_peeling(8)
    gnomon.add_shadows(plotter, glass=True)
    return plotter


def volume() -> pyvista.Plotter:
    orbital = pyvista.examples.load_hydrogen_orbital(3, 2, 0)
    plotter = pyvista.Plotter()
    plotter.add_volume(orbital, cmap="coolwarm", clim=(-0.01, 0.01), opacity=[1, 0, 0, 0, 1])
    plotter.add_floor(lighting=True, color="white", pad=1)
    gnomon.add_shadows(plotter, volumes=True)
    return plotter


def subplots() -> pyvista.Plotter:
    plotter = pyvista.Plotter(shape=(1, 2), border=False)
    for column, radius in enumerate((0, 4)):
        plotter.subplot(0, column)
        plotter.add_mesh(pyvista.examples.load_ant(), color="silver")
        plotter.add_floor(lighting=True, color="white", pad=1)
        gnomon.add_shadows(plotter, light_radius=radius, light_samples=256)
    return plotter


def figure() -> pyvista.Plotter:
    plotter = pyvista.Plotter()
    plotter.add_mesh(pyvista.ParametricKlein(), color="skyblue", smooth_shading=True)
    paper = plotter.add_floor(lighting=True, pad=2)
    gnomon.vtkGnomonPropKeys.SetShadowCatcher(paper, True)
    gnomon.add_shadows(plotter, light_radius=4, sky=0.4)
    return plotter


def main() -> None:
    pyvista.OFF_SCREEN = True
    pyvista.global_theme.window_size = [400, 300]
    pyvista.global_theme.font.label_size = pyvista.global_theme.font.title_size = 12
    for program in (first, terrain, glyphs, tubes, glass, volume, subplots, figure):
        plotter = program()
        for renderer in plotter.renderers:
            renderer.view_isometric()
            renderer.camera.zoom(1.3)
        path = os.path.join(sys.argv[1], f"{program.__name__}.png")
        plotter.screenshot(path, transparent_background=program is figure)
        plotter.close()


main()
