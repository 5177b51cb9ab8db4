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
    ("hard shadows, exact", "hard", "silhouette 1024"),
    ("the same without a map", "hard", "raytraced"),
    ("fast hard shadows", "hard", "nsm 1024"),
    ("smooth edges", "hard", "pcf 1024"),
    ("VTK's own", "hard", "vtkShadowMapPass 1024"),
    ("soft shadows, as exact as 64 rays", "soft", "penumbra"),
    ("the same with few rays, which show noise", "soft", "penumbra light_samples=16"),
    ("soft shadows without rays", "soft", "pcss 1024"),
]

PAGE = """# What accuracy costs

Exact hard shadows (`silhouette`) take {exact[0]:.2f} times plain VTK's frame while the picture
rests, {exact[1]:.2f} times with the camera moving and {exact[2]:.2f} times with the light moving.
The plain map (`nsm`) takes {fast[0]:.2f}, {fast[1]:.2f} and {fast[2]:.2f}, and {wrong:.2f} % of its
pixels are wrong. So take exact shadows, unless frames must follow a moving camera at once.

| you want | technique | error | nothing moving | camera moving | light moving |
|---|---|---|---|---|---|
{rows}

Errors are means over {hard} scenes with hard shadows and {soft} with soft ones, of the pixels that
face a light: the share of wrong pixels, or the root mean square of soft visibility. Times are
geometric means of multiples of plain VTK's.

`tests/lab/pages/study.sh` makes this page and [its table](../results/study.csv) by `gnomon study`. It also
measures which [conclusions](../results/conclusions.md) of the publications hold here.

## Hard shadows

- Nothing moves: exact visibility is reused. Maps are looked up in every frame.
- The camera moves: `silhouette` traces the pixels that its map leaves open. `raytraced` traces all.
- The light moves: exact techniques trace all pixels, in less time than maps of large scenes take.
- A few of many props move: exact techniques trace only the tiles that may have changed.
- A large scene under a sun: `pssm` errs less than `nsm` at the same `map_size`. It bakes all splits
  whenever the camera moves, which takes about twice the time of `silhouette`.
- Maps: texels decide what is wrong, not filters. `pcf`, `vsm`, `evsm` and `msm` smooth edges, and
  blur what is right as well.
- Several lights: shaders fetch all exact hard shadows at once
  ([growth](../results/growth.md)).

## Soft shadows

- `penumbra` and `raytraced` show the same. With a moving camera `raytraced` takes {few:.1f} times as
  long with 16 samples and {many:.1f} times with 64.
- `moving_samples` has both take few samples while something moves.
- `pcss` errs {pcss:.0f} times as much: it merges casters at different depths.
- `sampled` and `montecarlo` take longer than `penumbra` and err more.

## How exact

Exact techniques equal `raytraced` bit for bit. `ExactScenesTest` compares the pixels of the
built-in scenes from random views; `GNOMON_EXACT_RUNS` sets how many. Rays by the GPU differ in one
pixel of a million.

## On what machine

Measured on: {machine}.
No GPU has measured this page.
"""


def mean(values):
    return sum(values) / len(values)


class Study:
    """The rows of a study by the kind of shadows and the variant."""

    def __init__(self, table):
        self.rows = defaultdict(list)
        self.cases = defaultdict(set)
        with open(table, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                self.rows[row["shadows"], row["variant"]].append(row)
                self.cases[row["shadows"]].add((row["scene"], row["view"]))

    def of(self, shadows, variant):
        rows = self.rows[shadows, variant]
        if not rows or len(rows) != len(self.cases[shadows]):
            sys.exit(f"{variant} took part in {len(rows)} of {len(self.cases[shadows])} cases")
        return rows

    def error(self, shadows, variant):
        return mean([float(row[ERRORS[shadows]]) for row in self.of(shadows, variant)])

    def times(self, shadows, variant):
        rows = self.of(shadows, variant)
        return [
            math.exp(mean([math.log(float(row[f"{motion}_over_plain"])) for row in rows]))
            for motion in MOTIONS
        ]


def line(study, wish, shadows, variant):
    error = study.error(shadows, variant)
    text = f"{100 * error:.2f} %" if shadows == "hard" else f"{error:.4f} RMS"
    times = [f"{time:.2f}" for time in study.times(shadows, variant)]
    return f"| {' | '.join([wish, f'`{variant}`', text, *times])} |"


def main():
    study, machine = Study(sys.argv[1]), sys.argv[2]
    print(
        PAGE.format(
            exact=study.times("hard", "silhouette 1024"),
            fast=study.times("hard", "nsm 1024"),
            wrong=100 * study.error("hard", "nsm 1024"),
            few=study.times("soft", "raytraced light_samples=16")[1]
            / study.times("soft", "penumbra light_samples=16")[1],
            many=study.times("soft", "raytraced")[1] / study.times("soft", "penumbra")[1],
            pcss=study.error("soft", "pcss 1024") / study.error("soft", "penumbra"),
            rows="\n".join(line(study, *choice) for choice in CHOICES),
            hard=len(study.cases["hard"]),
            soft=len(study.cases["soft"]),
            machine=machine,
        ),
        end="",
    )


if __name__ == "__main__":
    main()
