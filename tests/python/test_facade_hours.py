"""examples/facade_hours.py says the hours and draws the picture that it should, in a minute.

    python3 test_facade_hours.py FOLDER

FOLDER takes the picture. The baseline is what the example writes:

    python3 examples/facade_hours.py tests/baselines/facade_hours.png
"""

import os
import re
import shutil
import subprocess
import sys
import time

import gnomon

here = os.path.dirname(os.path.abspath(__file__))
folder = sys.argv[1]
picture = os.path.join(folder, "facade_hours.png")
if os.path.exists(picture):
    os.remove(picture)

start = time.monotonic()
example = os.path.join(here, "..", "..", "examples", "facade_hours.py")
command = [sys.executable, example, picture]
said = subprocess.run(command, check=True, capture_output=True, text=True)
seconds = time.monotonic() - start
print(said.stdout + said.stderr + f"{os.path.basename(example)} took {seconds:.1f} seconds.")

if not re.fullmatch(r"Hours of sun: 7\.0 of 7\.5\n", said.stdout) or said.stderr:
    sys.exit("Expected: Hours of sun: 7.0 of 7.5")
if seconds >= 60:
    sys.exit("Expected: less than a minute")
# Edges may differ by a pixel from one release of Mesa to the next.
baseline = shutil.copy(os.path.join(here, "..", "baselines", "facade_hours.png"),
                       os.path.join(folder, "baseline.png"))
gnomon.assert_images_equal(picture, baseline, max_difference=8, max_pixels=300)
