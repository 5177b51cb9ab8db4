#!/usr/bin/python3
"""Runs a Python program written for plain VTK with Gnomon's shadows and without a display.

    main.py PROGRAM PREFIX

`with_shadows` adds two lines to the program. Gnomon's window stands in for VTK's. When the program
ends, its window shows the scene with shadows, with shadows by rays, and without Gnomon, all under
the same lights. PREFIX.py is the program with the two lines, PREFIX.shadows.png and
PREFIX.plain.png are two of the pictures. PREFIX.result is one line of fields between tabs:

- the light: "own", or "key" where Gnomon adds one;
- the pixels that shadows change by more than SEEN;
- the pixels that change at all, although all lights reach them;
- the pixels whose visibility or colours differ from those by rays;
- the kinds of props left out, and the number of other messages.

The program has one renderer, which it makes in a statement of its own.
"""

import re
import sys
import warnings
from pathlib import Path

import gnomon
import numpy
import vtk
from vtkmodules.util.numpy_support import vtk_to_numpy

SEEN = 8  # of 255
LEFT_OUT = "Visible and lit, but without shadows: "

windows = []


class Window(gnomon.vtkGnomonEGLRenderWindow):
    def __init__(self):
        windows.append(self)


class Interactor(vtk.vtkGenericRenderWindowInteractor):
    """An interactor without a user: the program continues."""

    def Initialize(self):
        self.GetRenderWindow().Render()

    def Start(self):
        self.Initialize()


def with_shadows(program):
    """Add the two lines to a program.

    `import gnomon` comes before its first import. `gnomon.add_shadows(RENDERER)` comes before the
    first statement that draws or starts the interactor, or else at the end.
    """
    renderer = re.search(r"^(\w+) *= *vtk\.vtkRenderer\(\)", program, re.M)[1]
    lines = program.splitlines()
    draws = re.compile(r"\w+\.(Render|Initialize|Start)\(\)")
    at = next((i for i, line in enumerate(lines) if draws.match(line)), len(lines))
    lines.insert(at, f"gnomon.add_shadows({renderer})")
    imports = re.compile(r"(import|from) ")
    at = next(i for i, line in enumerate(lines) if imports.match(line))
    lines.insert(at, "import gnomon")
    return "\n".join(lines) + "\n"


def picture_of(window, file=None):
    """Draw a window, and return its colours, row 0 at the bottom."""
    window.Render()
    reader = vtk.vtkWindowToImageFilter()
    reader.SetInput(window)
    reader.SetInputBufferTypeToRGB()
    reader.ReadFrontBufferOff()
    reader.ShouldRerenderOff()
    reader.Update()
    if file is not None:
        writer = vtk.vtkPNGWriter()
        writer.SetInputData(reader.GetOutput())
        writer.SetFileName(str(file))
        writer.Write()
    width, height, _ = reader.GetOutput().GetDimensions()
    colours = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return colours.reshape(height, width, -1).astype(int)


def visibility_of(window, shadows):
    """Draw a window, and return the least visibility of all lights at each pixel."""
    shadows.KeepVisibilityOn()
    window.Render()
    arrays = gnomon.visibility(shadows)
    shadows.KeepVisibilityOff()
    lights = [array for name, array in arrays.items() if name.startswith("light ")]
    covered = arrays["coverage"] != 0
    return numpy.where(covered, numpy.min(lights, axis=0).reshape(covered.shape), 1.0)


def told_by(messages):
    """Name the kinds of props that the pass's warning leaves out, and count other messages."""
    told, others = [], 0
    for message in re.split(r"\n\n+", messages.strip()):
        if LEFT_OUT in message:
            told += re.findall(r"\((.*?)\)", message.split(LEFT_OUT)[1])
        elif message:
            others += 1
    told = ["left out: " + ", ".join(told)] if told else []
    return ", ".join(told + ([f"**{others} other**"] if others else [])) or "none"


def main():
    program, prefix = Path(sys.argv[1]), sys.argv[2]
    text = with_shadows(program.read_text())
    Path(prefix + ".py").write_text(text)
    vtk.vtkRenderWindow, vtk.vtkRenderWindowInteractor = Window, Interactor
    messages = vtk.vtkStringOutputWindow()
    vtk.vtkOutputWindow.SetInstance(messages)
    sys.argv = [str(program)]
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        exec(compile(text, str(program), "exec"), {"__name__": "__main__"})
    has_key_light = any("key light" in str(warning.message) for warning in warned)

    window = windows[0]
    renderer = window.GetRenderers().GetFirstRenderer()
    shadows = renderer.GetPass()
    with_gnomon = picture_of(window, prefix + ".shadows.png")
    visibility = visibility_of(window, shadows)
    shadows.SetTechnique("raytraced")
    by_rays = picture_of(window)
    visibility_by_rays = visibility_of(window, shadows)
    renderer.SetPass(None)
    plain = picture_of(window, prefix + ".plain.png")

    change = numpy.abs(with_gnomon - plain).max(axis=2)
    other = (visibility != visibility_by_rays) | (with_gnomon != by_rays).any(axis=2)
    fields = [
        "key" if has_key_light else "own",
        (change > SEEN).sum(),
        (change[visibility == 1] > 0).sum(),
        other.sum(),
        told_by(messages.GetOutput()),
    ]
    Path(prefix + ".result").write_text("\t".join(str(field) for field in fields) + "\n")


if __name__ == "__main__":
    main()
