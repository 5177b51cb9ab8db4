"""A molecule's surface, cut open, and its atoms inside as impostors.

The surface is a contour of the sum of Gaussian densities around the atoms. vtkMoleculeMapper draws
an atom as an impostor: its shader turns a few triangles into a sphere. The pass traces the sphere,
not the triangles, so atoms have round shadows on the surface and on each other.

python3 molecule_surface.py [picture.png [width height]]
"""

import math
import sys

import gnomon
import vtk

ATOMS = 36  # of the backbone
CARBON, NITROGEN, OXYGEN = 6, 7, 8


def make_molecule() -> vtk.vtkMolecule:
    """A helix as in proteins: the backbone, its oxygen atoms, and side chains. In angstroms."""
    molecule = vtk.vtkMolecule()

    def add(element: int, radius: float, angle: float, height: float) -> None:
        x, y = radius * math.cos(angle), radius * math.sin(angle)
        molecule.AppendAtom(element, x, y, height)

    for i in range(ATOMS):
        angle = math.radians(100 / 3) * i  # 3.6 residues of three atoms a turn
        add((NITROGEN, CARBON, CARBON)[i % 3], 2.0, angle, 0.5 * i)
        if i % 3 == 1:
            for j in range(1 + i % 4):
                add(CARBON, 3.4 + 1.3 * j, angle + 0.2 * (j % 2), 0.5 * i + 0.3 * j)
        if i % 3 == 2:
            add(OXYGEN, 2.6, angle + 0.3, 0.5 * i + 1.1)
    return molecule


def make_surface(molecule: vtk.vtkMolecule) -> vtk.vtkPolyData:
    """A contour of the density, without its front quarter."""
    atoms = vtk.vtkPolyData()
    atoms.SetPoints(molecule.GetAtomicPositionArray())
    density = vtk.vtkGaussianSplatter()
    density.SetInputData(atoms)
    density.SetSampleDimensions(70, 70, 80)
    density.SetModelBounds(-12, 12, -12, 12, -5, 23)
    density.SetRadius(0.14)
    density.SetExponentFactor(-4)
    density.ScalarWarpingOff()
    density.SetAccumulationModeToSum()
    contour = vtk.vtkFlyingEdges3D()
    contour.SetInputConnection(density.GetOutputPort())
    contour.SetValue(0, 0.6)
    quarter = vtk.vtkBox()
    quarter.SetBounds(0, 20, -20, 0, -20, 40)
    cut = vtk.vtkClipPolyData()
    cut.SetInputConnection(contour.GetOutputPort())
    cut.SetClipFunction(quarter)
    cut.Update()
    return cut.GetOutput()


def main() -> None:
    path = sys.argv[1] if len(sys.argv) > 1 else "molecule_surface.png"
    size = [int(number) for number in sys.argv[2:4]] or [800, 600]

    molecule = make_molecule()
    atoms = vtk.vtkMoleculeMapper()
    atoms.SetInputData(molecule)
    atoms.UseVDWSpheresSettings()
    atoms.SetAtomicRadiusScaleFactor(0.75)
    surface = vtk.vtkPolyDataMapper()
    surface.SetInputData(make_surface(molecule))
    surface.ScalarVisibilityOff()

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for mapper in (atoms, surface):
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(0.72, 0.85, 0.80)
        actor.GetProperty().SetDiffuse(0.8)
        renderer.AddActor(actor)
    lamp = gnomon.vtkGnomonAreaLight()
    lamp.SetPosition(10, -36, 26)
    lamp.SetFocalPoint(0, 0, 8)
    lamp.SetRadius(2)
    renderer.AddLight(lamp)
    gnomon.add_shadows(renderer, sky=0.4, sky_distance=2)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(26, -34, 20)
    camera.SetFocalPoint(0, 0, 9.1)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(29.5)
    renderer.ResetCameraClippingRange()

    window = gnomon.vtkGnomonEGLRenderWindow()  # or, with a display, a vtkRenderWindow
    window.SetSize(size)
    window.AddRenderer(renderer)
    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()


main()
