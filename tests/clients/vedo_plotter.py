"""A plotter of vedo, in vedo's own window, or without a display ("egl")."""

import sys

import gnomon
import vedo

import pictures


def main():
    plotter = vedo.Plotter(offscreen=True, size=(320, 240), screensize=(1920, 1080))
    if sys.argv[1:] == ["egl"]:
        window = gnomon.vtkGnomonEGLRenderWindow()
        window.SetSize(plotter.window.GetSize())
        for renderer in plotter.renderers:
            plotter.window.RemoveRenderer(renderer)
            window.AddRenderer(renderer)
        plotter.window = window

    ball = vedo.Sphere(pos=(0, 0, 1), r=0.5)
    ground = vedo.Plane(s=(6, 6)).lighting("default")
    plotter.add(ball, ground, vedo.Light((1, 0.3, 1.5)))
    plotter.show()

    def take_picture():
        plotter.render()
        return plotter.screenshot(asarray=True).copy()

    pictures.check_shadows(plotter, take_picture, ball, least=400)
    pictures.check_shadows(plotter.renderer, take_picture, ball, least=400)

    ground.lighting("off")
    plain = take_picture()
    gnomon.add_shadows(plotter)
    count = pictures.darker(plain, take_picture())
    pictures.tell("an unlit plane shows no shadow", count and f"{count} pixels are darker")
    plotter.close()
    pictures.end()


main()
