#!/usr/bin/python3
"""Writes docs/guide/cost-of-accuracy.md, to the standard output, from the table of a
`gnomon study`."""

import csv
import math
import sys
from collections import defaultdict

MOTIONS = ("static", "camera_moving", "light_moving")
ERRORS = {"hard": "wrong_share", "soft": "rms_error"}

# What for, whose shadows, and which variant of the study.
CHOICES = [
    ("hard shadows, exact; the picture rests most of the time", "hard", "silhouette 1024"),
    ("the same, while much moves and maps do not pay", "hard", "raytraced"),
    ("fast hard shadows of small scenes", "hard", "nsm 1024"),
    ("fast hard shadows of large scenes", "hard", "pssm 1024"),
    ("smooth edges, whatever is in the light's way", "hard", "pcf 1024"),
    ("what VTK has", "hard", "vtkShadowMapPass 1024"),
    ("soft shadows, as exact as 64 rays", "soft", "penumbra"),
    ("the same with few rays, which show noise", "soft", "penumbra light_samples=16"),
    ("soft shadows that look right while much moves", "soft", "pcss 1024"),
]

PAGE = """# What accuracy costs

Exact hard shadows cost about a quarter of a frame while the picture rests, and another frame while
something moves. Fast ones are wrong in a few pixels of a thousand, at contacts and along edges, and
cost half a frame. So take the exact ones unless frames must follow a moving light or camera at once.

`gnomon study` measures this and draws it: error over time, the ways that no other one beats, and
the places where they are most wrong. `docs/study.sh` makes this page and
[its table](../results/study.csv).

| you want | technique | error | nothing moving | camera moving | light moving |
|---|---|---|---|---|---|
{rows}

Errors are those of all pixels that face a light, in the mean over {hard} scenes with hard shadows
and {soft} with soft ones: pixels that are lit in place of dark or dark in place of lit, and the root
mean square of soft visibility. Times are those of frames over plain VTK's without shadows, in the
geometric mean.

## With hard shadows

- Nothing moves: visibility is kept, so all techniques that compute images cost the same. Take an
  exact one.
- The camera moves: `silhouette` traces only what its map leaves open. `raytraced` needs no map, and
  beats it where casters change in every frame.
- The light moves: both trace all pixels, which takes less time than drawing a map of a large scene.
- Maps: what is wrong falls with the texel's size, not with filters. `pcf` and the filtered maps
  (`vsm`, `evsm`, `msm`) make edges smooth, and blur what is right as well.
- Several lights: [times grow](../results/growth.md#lights) by less than maps' do, since shaders fetch
  all exact hard shadows at once.

## With soft shadows

- `penumbra` shows what ray tracing shows, by the edges that each pixel sees of the light.
- `moving_samples` has it take few samples while something moves, and all of them at rest.
- `pcss` and the filtered maps are wrong by ten times as much. They look right where one caster
  hides the light, and wrong where several do.

## On what machine

Measured on: {machine}. Where OpenGL draws by hardware, maps and shading cost less and rays on the
processor as much as here; rays go to the GPU there (`TRACER_AUTO`). No GPU has measured this page.
"""


def mean(values):
    return sum(values) / len(values)


def main():
    table, machine = sys.argv[1], sys.argv[2]
    rows = defaultdict(list)
    scenes = defaultdict(set)
    with open(table, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            rows[row["shadows"], row["variant"]].append(row)
            scenes[row["shadows"]].add(row["scene"])
    lines = []
    for wish, shadows, variant in CHOICES:
        of = rows[shadows, variant]
        error = mean([float(row[ERRORS[shadows]]) for row in of])
        times = [
            math.exp(mean([math.log(float(row[f"{motion}_over_plain"])) for row in of]))
            for motion in MOTIONS
        ]
        text = f"{100 * error:.2f} %" if shadows == "hard" else f"{error:.4f} RMS"
        cells = [wish, f"`{variant}`", text, *(f"{time:.2f}" for time in times)]
        lines.append(f"| {' | '.join(cells)} |")
    print(
        PAGE.format(
            rows="\n".join(lines),
            hard=len(scenes["hard"]),
            soft=len(scenes["soft"]),
            machine=machine,
        ),
        end="",
    )


if __name__ == "__main__":
    main()
