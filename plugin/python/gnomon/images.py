"""Pictures compared with baselines, for tests."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter

from .arguments import number, path_of
from .errors import naming, raising

if TYPE_CHECKING:
    import numpy


def assert_images_equal(
    actual: vtkRenderWindow | str | os.PathLike | numpy.ndarray,
    baseline: str | os.PathLike,
    max_difference: int = 0,
    max_pixels: int = 0,
) -> None:
    """Fail unless a picture is its baseline: the counterpart of CMake's gnomon_add_image_test.

    Parameters
    ----------
    actual : vtkRenderWindow, str, os.PathLike or numpy.ndarray
        A window, which is drawn; a PNG file of colours, whose opacity does not count; or an array
        of height x width x 3 bytes, top row first.
    baseline : str or os.PathLike
        A PNG file. With the environment variable GNOMON_REFRESH_BASELINES set, `actual` is written
        there, and nothing is compared.
    max_difference : int
        What a channel may differ by, of 255.
    max_pixels : int
        How many pixels may differ by more.

    Raises
    ------
    TypeError, ValueError
        For an array of another shape or type, a file that holds no PNG picture, and a picture that
        cannot be written.
    AssertionError
        Says how many pixels differ, by how much, and where the first one is. The picture is then
        beside the baseline, as NAME-actual.png.
    """
    import numpy

    refreshes = os.environ.get("GNOMON_REFRESH_BASELINES", "0") not in ("", "0")
    baseline = path_of("baseline", baseline, ".png" if refreshes else "", not refreshes)
    number("max_difference", max_difference, 0, 255)
    number("max_pixels", max_pixels, 0)
    with naming("actual"):
        picture = _pixels(actual)
    if refreshes:
        _write(picture, baseline)
        return
    kept = os.path.splitext(baseline)[0] + "-actual.png"
    if not os.path.exists(baseline):
        _write(picture, kept)
        raise AssertionError(
            f"baseline: {baseline}: there is no such picture; the present one: {kept}"
        )
    with naming("baseline"):
        expected = _pixels(baseline)
    if picture.shape != expected.shape:
        _write(picture, kept)
        raise AssertionError(
            f"{baseline} has {_size(expected)} pixels, the picture {_size(picture)}: {kept}"
        )
    difference = abs(picture.astype(int) - expected.astype(int)).max(axis=2)
    rows, columns = numpy.nonzero(difference > max_difference)
    if len(rows) > max_pixels:
        _write(picture, kept)
        raise AssertionError(
            f"{len(rows)} pixels differ from {baseline} by more than {max_difference} "
            f"(by {difference.max()} at most), and {max_pixels} may; the first one from above is "
            f"at column {columns[0]}, row {rows[0]}: {kept}"
        )


def png_of(window):
    """Draw a window, and return its picture as the bytes of a PNG file."""
    return _encoded(_pixels(window))


def _off_screen():
    """A window that shows nothing: VTK's own in a Gnomon that is built without EGL."""
    import gnomon

    window = getattr(gnomon, "vtkGnomonEGLRenderWindow", vtkRenderWindow)()
    window.SetMultiSamples(0)
    window.SetOffScreenRendering(1)
    return window


def _size(picture):
    return f"{picture.shape[1]} x {picture.shape[0]}"


def _pixels(source):
    """An array of height x width x 3 bytes, top row first."""
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if isinstance(source, numpy.ndarray):
        if source.ndim != 3 or source.shape[2] != 3 or source.dtype != numpy.uint8:
            raise ValueError(
                "expected an array of height x width x 3 bytes, "
                f"found {source.shape} of {source.dtype}"
            )
        return source
    if isinstance(source, vtkRenderWindow):
        reader = vtkWindowToImageFilter()
        reader.SetInput(source)
        reader.SetInputBufferTypeToRGB()
        reader.ReadFrontBufferOff()
    else:
        source = path_of("path", source)
        if not os.path.exists(source):
            raise AssertionError(f"{source}: there is no such picture")
        reader = vtkPNGReader()
        reader.SetFileName(source)
    with raising(reader):
        reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    array = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1]
    if array.shape[2] < 3:
        array = numpy.repeat(array[..., :1], 3, axis=2)
    return array[..., :3].astype(numpy.uint8)


def _writer_of(picture):
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData

    image = vtkImageData()
    image.SetDimensions(picture.shape[1], picture.shape[0], 1)
    flat = numpy.ascontiguousarray(picture[::-1]).reshape(-1, 3)
    image.GetPointData().SetScalars(numpy_to_vtk(flat, deep=True))
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    return writer


def _encoded(picture):
    writer = _writer_of(picture)
    writer.WriteToMemoryOn()
    writer.Write()
    return bytes(writer.GetResult())


def _write(picture, path):
    os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
    writer = _writer_of(picture)
    writer.SetFileName(str(path))
    writer.Write()
    if writer.GetErrorCode() != 0 or not os.path.exists(path):
        raise ValueError(f"{path}: cannot be written")
