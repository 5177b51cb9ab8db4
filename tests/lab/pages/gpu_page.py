#!/usr/bin/python3
"""Writes the page of tests/lab/pages/gpu.sh, to the standard output, from the folder of its results and the
names of the scenes with hard shadows."""

import json
import sys
from pathlib import Path

import auto_page
import exact_price_page

PAGE = """# Shadows on a GPU

OpenGL draws plain VTK's frame and all maps, Embree traces rays on the processor. `tests/lab/pages/gpu.sh`
measures this. Times are medians of whole frames, drawn in turns, as multiples of plain VTK's.

## Hard shadows

One sun, 1024 x 1024 pixels, maps of 1024 x 1024 texels.

{head}
{hard}

## Soft shadows

The sun of the bunny is a disk of 5 degrees. Techniques see 64 points of it, `montecarlo` 9. The
error is the root mean square error of visibility, against 4,096 points.

| technique | error | nothing moves | camera moves | light moves |
|---|---|---|---|---|
{soft}

## `auto` in motion

As in [the tables of software OpenGL](auto.md), at 512 x 512 pixels, with the shipped factors of
hardware.

{places}

{flights}

## Factors of costs

`gnomon calibrate` measured, in nanoseconds per triangle, pixel or texel:

```
{factors}
```

Measured on: {machine}.
"""


def soft_rows(folder: Path):
    """The table's rows of soft shadows."""
    variants = json.loads((folder / "soft" / "results.json").read_text())["variants"]
    plain = next(of for of in variants if of["name"] == exact_price_page.PLAIN)
    for of in variants:
        over = [
            of["times"][motion]["frame_ms"] / plain["times"][motion]["frame_ms"]
            for motion in exact_price_page.MOTIONS
        ]
        cells = [of["name"], f"{of['error']['rms_error']:.4f}", *(f"{value:.2f}" for value in over)]
        yield f"| {' | '.join(cells)} |"


def main():
    folder, scenes = Path(sys.argv[1]), sys.argv[2:]
    settings = json.loads((folder / scenes[0] / "results.json").read_text())["settings"]
    factors = (folder / "factors.txt").read_text().splitlines()
    hard = (row for scene in scenes for row in exact_price_page.rows_of(folder, scene, 2))
    print(
        PAGE.format(
            head=exact_price_page.HEAD,
            hard="\n".join(hard),
            soft="\n".join(soft_rows(folder)),
            places=auto_page.places_table(folder / "auto.csv"),
            flights=auto_page.flights_table(folder / "flights.csv"),
            factors="\n".join(line for line in factors if line and not line.startswith("#")),
            machine=f"{settings['Processor']};\nOpenGL by {settings['OpenGL']}",
        ),
        end="",
    )


if __name__ == "__main__":
    main()
