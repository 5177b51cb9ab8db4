#!/usr/bin/python3
"""Writes docs/guide/cost-of-accuracy.md, to the standard output, from the table of a
`gnomon study`."""

import csv
import math
import sys
from collections import defaultdict

MOTIONS = ("static", "camera_moving", "light_moving")
ERRORS = {"hard": "wrong_share", "soft": "rms_error"}

# The wish, the kind of shadows, and the variant of the study.
CHOICES = [
    ("hard shadows, exact", "hard", "silhouette 1024"),
    ("the same without a map", "hard", "raytraced"),
    ("fast hard shadows", "hard", "nsm 1024"),
    ("smooth edges", "hard", "pcf 1024"),
    ("VTK's own", "hard", "vtkShadowMapPass 1024"),
    ("soft shadows; equals 64-sample ray tracing", "soft", "penumbra"),
    ("the same with 16 samples, which show noise", "soft", "penumbra light_samples=16"),
    ("soft shadows without rays", "soft", "pcss 1024"),
]

PAGE = """# What accuracy costs

Exact hard shadows (`silhouette`) take {exact[0]:.2f} times plain VTK's frame at rest and {exact[1]:.2f}
times while the camera moves. A plain map (`nsm`) takes {fast[0]:.2f} and {fast[1]:.2f}, and {wrong:.2f} % of its
pixels are wrong. So take exact shadows, unless frames must follow a moving camera at once.

| you want | technique | error | nothing moving | camera moving | light moving |
|---|---|---|---|---|---|
{rows}

Errors are means over {hard} scenes with hard shadows and {soft} with soft ones: the share of wrong
pixels, or the RMS error of soft visibility. Times are multiples of plain VTK's.
`tests/lab/pages/study.sh` makes this page and [its table](../results/study.csv).

- At rest exact visibility is reused. Where few props move, only tiles that may change are traced.
- While the camera moves, `pssm` takes about twice the time of `silhouette`, and `raytraced` takes
  {few:.1f} times as long as `penumbra` with 16 samples, {many:.1f} times with 64.
- `pcf`, `vsm`, `evsm` and `msm` smooth edges, and blur what is right as well.
- `pcss` errs {pcss:.0f} times as much: it merges casters at different depths.
- `sampled` and `montecarlo` take longer than `penumbra` and err more.

Measured on: {machine}.
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
