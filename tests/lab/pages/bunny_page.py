#!/usr/bin/python3
"""Writes the tables of tests/lab/pages/figures.sh from its two runs of `gnomon compare`: all of
them into docs/results/bunny.md, six rows into README.md."""

import csv
import sys
from pathlib import Path

MOTIONS = {"static": "static", "camera_moving": "camera moving", "light_moving": "light moving"}
PLAIN = "plain VTK"
BUNNY_PAGE, MAIN_PAGE = Path("docs/results/bunny.md"), Path("README.md")
BEGIN, END = "<!-- figures -->", "<!-- end of figures -->"

# README's rows: what for, the technique, and whether its lights have an area.
CHOICES = [
    ("speed; edges are jagged at a texel's scale", "nsm", False),
    ("smooth edges", "pcf", False),
    ("smaller errors of a map", "pssm", False),
    ("hard shadows, exact", "silhouette", False),
    ("soft shadows; equals 64-sample ray tracing", "penumbra", True),
    ("to compare: VTK's own", "vtkShadowMapPass", False),
]

PAGE = """# Error and time of all techniques on the bunny

`crsm`, `crsma` and `silhouette` show the hard shadows of ray tracing, `penumbra` its soft ones; all
others trade error for time. `tests/lab/pages/figures.sh` measures this and README.md's table.

The scene `bunny`, 1024 x 1024 pixels, maps of 1024 x 1024 texels. Errors are against ray tracing,
over the pixels that face the light; a wrong pixel's visibility is off by more than a half. Times
are medians of whole frames, in brackets as multiples of plain VTK's.

![Wrong pixels against time](../figures/chart.png)

## Hard shadows

| plain VTK | vtkShadowMapPass | `nsm` | `raytraced` |
|---|---|---|---|
| ![no shadows](../figures/plain-VTK.png) | ![light leaks in at the contact](../figures/vtkShadowMapPass-1024.png) | ![dark at the contact](../figures/nsm-1024-inline.png) | ![ray traced](../figures/raytraced.png) |

{hard}

## Soft shadows

The sun is a disk of 5 degrees. Techniques see 64 points of it, `montecarlo` 9. Errors are those of
visibility, against 4,096 points.

| `pcss` | `montecarlo` | `penumbra`, the same as ray tracing |
|---|---|---|
| ![wide far from the bunny](../figures/pcss.png) | ![nearly the same](../figures/montecarlo.png) | ![exact](../figures/penumbra.png) |

{soft}

Measured on: {machine}.
"""

README = """| you want | technique | at rest | camera moving | light moving | error |
|---|---|---|---|---|---|
{rows}

Costs are multiples of plain VTK's frame time. The error is the share of wrong pixels; for soft
shadows, the RMS error of visibility against 4,096 samples. `tests/lab/pages/figures.sh` measures
the bunny.

Measured on: {machine}."""


class Run:
    """The rows of a comparison, by the names of their variants."""

    def __init__(self, folder: Path):
        with open(folder / "results.csv", newline="", encoding="utf-8") as file:
            self.rows = {row["variant"]: row for row in csv.DictReader(file)}

    def of(self, technique: str) -> dict:
        return next(row for row in self.rows.values() if row["technique"] == technique)

    def ratios(self, row: dict) -> list[float]:
        plain = self.rows[PLAIN]
        return [float(row[f"{key}_ms"]) / float(plain[f"{key}_ms"]) for key in MOTIONS]

    def times(self, row: dict) -> list[str]:
        return [
            f"{float(row[f'{key}_ms']):.1f} ms ({ratio:.2f})"
            for key, ratio in zip(MOTIONS, self.ratios(row))
        ]


def share(row: dict, column: str) -> float:
    return 100.0 * float(row[column]) / float(row["facing_pixels"])


def line(cells: list[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def table(run: Run, heads: list[str], errors) -> str:
    """A row for each variant: its name, its errors, its times."""
    names = ["variant", *heads, *MOTIONS.values()]
    lines = [line(names), "|" + "---|" * len(names)]
    lines += [line([row["variant"], *errors(row), *run.times(row)]) for row in run.rows.values()]
    return "\n".join(lines)


def hard_errors(row: dict) -> list[str]:
    wrong = ("wrong_pixels", "false_light_pixels", "false_shadow_pixels")
    return [f"{share(row, column):.3f} %" for column in wrong] + [
        f"{share(row, 'between_pixels'):.2f} %"
    ]


def soft_errors(row: dict) -> list[str]:
    return [f"{float(row['mean_absolute_error']):.4f}", f"{float(row['rms_error']):.4f}"]


def costs(run: Run, row: dict) -> list[str]:
    return [f"{ratio:.2f}" for ratio in run.ratios(row)]


def error(row: dict, soft: bool) -> str:
    if soft:
        return f"{float(row['rms_error']):.4f} RMS"
    return f"{share(row, 'wrong_pixels'):.3f} %"


def readme_rows(hard: Run, soft: Run, machine: str) -> str:
    rows = []
    for wish, technique, is_soft in CHOICES:
        run = soft if is_soft else hard
        row = run.of(technique)
        rows.append(line([wish, f"`{technique}`", *costs(run, row), error(row, is_soft)]))
    return README.format(rows="\n".join(rows), machine=machine)


def main() -> None:
    hard, soft, machine = Run(Path(sys.argv[1])), Run(Path(sys.argv[2])), sys.argv[3]
    hard_heads = ["wrong pixels", "false light", "false shadow", "neither lit nor dark"]
    BUNNY_PAGE.write_text(
        PAGE.format(
            hard=table(hard, hard_heads, hard_errors),
            soft=table(soft, ["mean absolute error", "root mean square"], soft_errors),
            machine=machine,
        ),
        encoding="utf-8",
    )
    before, rest = MAIN_PAGE.read_text(encoding="utf-8").split(BEGIN)
    after = rest.split(END)[1]
    rows = readme_rows(hard, soft, machine)
    MAIN_PAGE.write_text(f"{before}{BEGIN}\n\n{rows}\n\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
