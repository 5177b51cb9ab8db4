"""A figure of Mayavi, in Mayavi's own window, or without a display ("egl")."""

import sys

import gnomon
import numpy
from mayavi import mlab
from tvtk.api import tvtk

import pictures


def main():
    if sys.argv[1:] == ["egl"]:
        tvtk.EGLRenderWindow = lambda: tvtk.to_tvtk(gnomon.vtkGnomonEGLRenderWindow())

    mlab.options.offscreen = True
    figure = mlab.figure(size=(320, 240))
    x, y = numpy.mgrid[-3:3:7j, -3:3:7j]
    mlab.mesh(x, y, 0 * x, color=(1, 1, 1))
    ball = mlab.points3d([0], [0], [1], scale_factor=1, resolution=16, color=(1, 1, 1))
    mlab.view(azimuth=-90, elevation=45, distance=10)

    def take_picture():
        figure.scene.render()
        return mlab.screenshot(figure).copy()

    pictures.check_shadows(figure, take_picture, ball, least=400)

    for light in figure.scene.light_manager.lights:
        light.activate = False
    sun = tvtk.Light(light_type="scene_light", position=(1, 0.3, 1.5))
    figure.scene.renderer.add_light(sun)
    for target in (figure, figure.scene, figure.scene.renderer):
        pictures.check_shadows(target, take_picture, ball, least=400)

    plain = take_picture()
    gnomon.vtkGnomonLightKeys.SetCasts(sun, False)
    gnomon.add_shadows(figure)
    count = pictures.darker(plain, take_picture())
    pictures.tell("a light that does not cast has no shadow", count and f"{count} are darker")
    mlab.close(all=True)
    pictures.end()


main()
