"""Shadows among other passes: a chain that a program has made keeps what it shows."""

import itertools
import unittest
import warnings

from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkRenderer
from vtkmodules.vtkRenderingOpenGL2 import (
    vtkCameraPass,
    vtkDualDepthPeelingPass,
    vtkEDLShading,
    vtkOpenGLFXAAPass,
    vtkRenderPassCollection,
    vtkRenderStepsPass,
    vtkSequencePass,
    vtkSSAAPass,
    vtkSSAOPass,
    vtkTranslucentPass,
)

import gnomon
from gnomon.images import _pixels
from scene import Scene, add

KINDS = (vtkSSAOPass, vtkSSAAPass, vtkOpenGLFXAAPass, vtkEDLShading)


def steps(peels):
    """The pass that draws the props, with depth peeling if asked for."""
    result = vtkRenderStepsPass()
    if peels:
        peeling = vtkDualDepthPeelingPass()
        peeling.SetTranslucentPass(vtkTranslucentPass())
        result.SetTranslucentPass(peeling)
    return result


def chain(kinds, inner):
    """Passes from the outermost to the innermost, around another pass."""
    for kind in reversed(kinds):
        outer = kind()
        outer.SetDelegatePass(inner)
        inner = outer
    return inner


def chains():
    """All orders of some of the passes."""
    return [it for count in range(5) for it in itertools.permutations(KINDS, count)]


def parts_of(kinds):
    """Passes that are to be around shadows, and those within them."""
    inside = len(kinds)
    while inside > 0 and kinds[inside - 1] == vtkSSAOPass:
        inside -= 1
    return kinds[:inside], kinds[inside:]


def picture(scene, render_pass):
    """The picture by a pass, which takes the place of another for good."""
    if scene.renderer.GetPass() is not None:
        scene.renderer.GetPass().ReleaseGraphicsResources(scene.window)
    scene.renderer.SetPass(render_pass)
    return drawn(scene)


def drawn(scene):
    scene.window.Render()
    return _pixels(scene.window)


class Passes(unittest.TestCase):
    def test_shadows_find_their_place_in_each_chain(self):
        self.assertEqual(len(chains()), 65)
        for kinds in chains():
            outer, inner = parts_of(kinds)
            renderer = vtkRenderer()
            before = chain(kinds, vtkRenderStepsPass())
            renderer.SetPass(before)
            names = names_of(renderer)
            shadows = gnomon.add_shadows(renderer, light=None)
            self.assertEqual(
                names_of(renderer),
                [*names[: len(outer)], "vtkGnomonShadowPass", *names[len(outer) :]],
            )
            gnomon.remove_shadows(renderer)
            self.assertEqual(names_of(renderer), names)
            self.assertIs(renderer.GetPass(), before)
            self.assertIsNone(shadows.delegate_pass)

    def test_pictures_are_those_of_chains_by_hand(self):
        # Where vtkSSAOPass is not around opaque steps, VTK's own pictures differ from one run to
        # the next.
        compared = [
            (kinds, peels)
            for kinds, peels in itertools.product(chains(), (False, True))
            if vtkSSAOPass not in kinds or kinds[-1] == vtkSSAOPass and not peels
        ]
        self.assertEqual(len(compared), 48)
        scene = Scene()
        scene.window.SetMultiSamples(0)
        pane = vtkPlaneSource()
        pane.SetCenter(0, 0, 2)
        glass = add(scene.renderer, pane)
        glass.GetProperty().SetOpacity(0.5)
        for kinds, peels in compared:
            with self.subTest(kinds=[it.__name__ for it in kinds], peels=peels):
                glass.SetVisibility(peels)
                outer, inner = parts_of(kinds)
                shadows = gnomon.vtkGnomonShadowPass()
                shadows.SetDelegatePass(chain(inner, steps(peels)))
                by_hand = picture(scene, chain(outer, shadows))
                plain = picture(scene, chain(kinds, steps(peels)))
                gnomon.add_shadows(scene.renderer)
                composed = drawn(scene)
                self.assertTrue((composed == by_hand).all())
                self.assertGreater((plain.astype(int) - composed > 40).any(axis=2).sum(), 50)
                gnomon.remove_shadows(scene.renderer)
                self.assertTrue((drawn(scene) == plain).all())

    def test_passes_that_come_later_stay_when_shadows_go(self):
        for kind in KINDS:
            scene = Scene()
            shadows = gnomon.add_shadows(scene.renderer)
            outer = kind()
            outer.SetDelegatePass(shadows)
            scene.renderer.SetPass(outer)
            self.assertIn("choice", gnomon.report(scene.renderer))
            gnomon.remove_shadows(scene.renderer)
            self.assertIs(scene.renderer.GetPass(), outer)
            self.assertIsNone(outer.GetDelegatePass())

    def test_shadows_take_the_place_of_shadows(self):
        scene = Scene()
        first, edges, drawing = gnomon.vtkGnomonShadowPass(), vtkEDLShading(), steps(False)
        first.SetDelegatePass(drawing)
        edges.SetDelegatePass(first)
        scene.renderer.SetPass(edges)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            second = gnomon.add_shadows(scene.renderer)
        self.assertIs(edges.GetDelegatePass(), second)
        self.assertIs(second.GetDelegatePass(), drawing)
        gnomon.remove_shadows(scene.renderer)
        self.assertIs(edges.GetDelegatePass(), first)
        self.assertIsNone(second.GetDelegatePass())

    def test_a_delegate_that_a_program_chose_stays(self):
        scene = Scene()
        passes, before, chosen = vtkRenderPassCollection(), vtkSequencePass(), steps(False)
        passes.AddItem(chain([vtkEDLShading], steps(False)))
        before.SetPasses(passes)
        picture(scene, before)
        with self.assertWarnsRegex(UserWarning, "gave way to shadows: vtkSequencePass"):
            shadows = gnomon.add_shadows(scene.renderer, delegate_pass=chosen)
        self.assertIs(shadows.delegate_pass, chosen)
        gnomon.remove_shadows(scene.renderer)
        self.assertIs(scene.renderer.GetPass(), before)
        self.assertIs(shadows.delegate_pass, chosen)
        # It gave back the graphics of the window, which it may never use again.
        scene.renderer.SetPass(None)
        messages, previous = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
        vtkOutputWindow.SetInstance(messages)
        del before, passes
        vtkOutputWindow.SetInstance(previous)
        self.assertEqual(messages.GetOutput(), "")

    def test_a_pass_with_a_place_by_hand_keeps_it(self):
        renderer = vtkRenderer()
        shadows, camera = gnomon.vtkGnomonShadowPass(), vtkCameraPass()
        camera.SetDelegatePass(shadows)
        renderer.SetPass(camera)
        for change in (shadows.Install, shadows.Uninstall):
            change(renderer)
            self.assertEqual(names_of(renderer), ["vtkCameraPass", "vtkGnomonShadowPass"])
        shadows.Uninstall(vtkRenderer())


class ChainMaker:
    """Makes a renderer's chain from the passes that are enabled, as PyVista's plotters do."""

    def __init__(self, renderer):
        self.renderer = renderer
        self.passes = []
        collection, sequence, self.camera = (
            vtkRenderPassCollection(), vtkSequencePass(), vtkCameraPass()
        )
        collection.AddItem(vtkRenderStepsPass())
        sequence.SetPasses(collection)
        self.camera.SetDelegatePass(sequence)

    def enable(self, kind):
        self.passes.append(kind())
        self.update()

    def disable(self):
        self.passes.pop()
        self.update()

    def update(self):
        top = self.camera
        for each in self.passes:
            each.SetDelegatePass(top)
            top = each
        self.renderer.SetPass(top if self.passes else None)


class Plotters(unittest.TestCase):
    def test_shadows_outlive_the_chains_of_a_plotter(self):
        scene = Scene()
        scene.renderer._render_passes = maker = ChainMaker(scene.renderer)
        plain = drawn(scene)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            shadows = gnomon.add_shadows(scene.renderer)
            alone = drawn(scene)
            pictures = []
            for kind in (vtkSSAOPass, vtkEDLShading, vtkSSAAPass):
                maker.enable(kind)
                pictures.append(drawn(scene))
                self.assertIn("vtkGnomonShadowPass", names_of(scene.renderer))
                self.assertGreater((alone != plain).any(axis=2).sum(), 50)
            for expected in reversed(pictures[:-1]):
                maker.disable()
                self.assertTrue((drawn(scene) == expected).all())
            maker.disable()
        self.assertIs(scene.renderer.GetPass(), shadows)
        self.assertTrue((drawn(scene) == alone).all())
        gnomon.remove_shadows(scene.renderer)
        self.assertTrue((drawn(scene) == plain).all())
        maker.enable(vtkEDLShading)
        self.assertNotIn("vtkGnomonShadowPass", names_of(scene.renderer))

    def test_shadows_of_a_block_outlive_them_alone(self):
        scene = Scene()
        scene.renderer._render_passes = maker = ChainMaker(scene.renderer)
        first = gnomon.add_shadows(scene.renderer)
        with gnomon.shadows(scene.renderer, "pcf") as second:
            self.assertIs(scene.renderer.GetPass(), second)
            maker.enable(vtkEDLShading)
            self.assertIs(scene.renderer.GetPass().GetDelegatePass(), second)
        maker.disable()
        self.assertIs(scene.renderer.GetPass(), first)


def names_of(renderer):
    names, each = [], renderer.GetPass()
    while each is not None:
        names.append(each.GetClassName())
        each = getattr(each, "GetDelegatePass", lambda: None)()
    return names


if __name__ == "__main__":
    unittest.main()
