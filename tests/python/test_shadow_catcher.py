"""examples/shadow_catcher.py draws a figure that can be laid over any page.

    python3 test_shadow_catcher.py FOLDER

FOLDER takes the figure. Where there is no knot it is black, and as opaque as its shadow. Over a
white page it is the baseline.
"""

import os
import shutil
import subprocess
import sys

import gnomon
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

here = os.path.dirname(os.path.abspath(__file__))
folder = sys.argv[1]
figure = os.path.join(folder, "shadow_catcher.png")
example = os.path.join(here, "..", "..", "examples", "shadow_catcher.py")
subprocess.run([sys.executable, example, figure, "160", "120"], check=True)

reader = vtkPNGReader()
reader.SetFileName(figure)
reader.Update()
pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(120, 160, 4)[::-1]
colour, opacity = pixels[..., :3].astype(float), pixels[..., 3] / 255
if not (0.2 < (opacity == 1).mean() < 0.5 and 0.1 < ((opacity > 0.3) & (opacity < 1)).mean() < 0.4):
    sys.exit("Expected an opaque knot, and a shadow that is not opaque")
if colour[opacity < 0.9].any():
    sys.exit("Expected black where the figure is transparent")
over_white = (colour * opacity[..., None] + 255 * (1 - opacity[..., None])).round()
baseline = shutil.copy(os.path.join(here, "..", "baselines", "shadow_catcher.png"),
                       os.path.join(folder, "shadow_catcher_baseline.png"))
gnomon.assert_images_equal(over_white.astype(numpy.uint8), baseline, 24, 384)
