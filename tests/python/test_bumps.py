"""A normal map does not light the night side of a ball: as many pixels as without one are lit that
rays leave dark."""

import unittest

import numpy as np
from scene import Scene
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkPolyDataTangents, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkFiltersTexture import vtkTextureMapToSphere
from vtkmodules.vtkRenderingCore import vtkTexture, vtkWindowToImageFilter

import gnomon


def bumps():
    u = np.linspace(0, 24 * np.pi, 256)
    x, y = np.meshgrid(np.sin(u), np.cos(u))
    normal = np.stack([0.8 * x, 0.8 * y, np.ones_like(x)], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    image = vtkImageData()
    image.SetDimensions(256, 256, 1)
    values = ((normal + 1) * 127.5).astype(np.uint8).reshape(-1, 3)
    image.GetPointData().SetScalars(numpy_to_vtk(values, deep=1))
    texture = vtkTexture()
    texture.SetInputData(image)
    return texture


class BumpedScene(Scene):
    def __init__(self):
        super().__init__()
        self.window.SetMultiSamples(0)
        self.window.SetSize(320, 240)
        self.renderer.GetLights().GetItemAsObject(0).SetPosition(1, -0.4, 0.5)
        ball = vtkSphereSource()
        ball.SetCenter(0, 0, 1)
        ball.SetThetaResolution(64)
        ball.SetPhiResolution(32)
        source = ball
        for step in (vtkTextureMapToSphere(), vtkTriangleFilter(), vtkPolyDataTangents()):
            step.SetInputConnection(source.GetOutputPort())
            source = step
        self.ball.GetMapper().SetInputConnection(source.GetOutputPort())
        self.look = self.ball.GetProperty()
        self.look.SetInterpolationToPBR()

    def picture(self):
        self.window.Render()
        grab = vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.Update()
        values = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
        return values.reshape(240, 320, -1).max(2).astype(int)

    def false_light(self, technique, route):
        rays = gnomon.add_shadows(self.renderer, "raytraced")
        right = self.picture()
        rays.SetTechnique(technique)
        rays.SetRoute(route)
        return int((self.picture() - right > 20).sum())


class BumpsTest(unittest.TestCase):
    def test_false_light(self):
        for technique in ("nsm", "pcf", "vsm"):
            for route in (gnomon.vtkGnomonShadowPass.ROUTE_INLINE,
                          gnomon.vtkGnomonShadowPass.ROUTE_IMAGE):
                with self.subTest(technique=technique, route=route):
                    scene = BumpedScene()
                    smooth = scene.false_light(technique, route)
                    scene.look.SetNormalTexture(bumps())
                    self.assertLessEqual(scene.false_light(technique, route), smooth + 10)


if __name__ == "__main__":
    unittest.main()
