#!/usr/bin/python3
"""Writes the page of tests/lab/pages/exact_price.sh, to the standard output, from its runs of
`gnomon compare`."""

import json
import sys
from pathlib import Path

MOTIONS = {"static": "nothing", "camera_moving": "camera", "light_moving": "light"}
PLAIN, VTK_SHADOWS = "plain VTK", "vtkShadowMapPass 1024"
EXACT = ("silhouette 1024", "raytraced")

HEAD = (
    "| scene | moving | plain VTK | vtkShadowMapPass | `nsm` | `silhouette` | `raytraced` "
    "| wrong pixels of vtkShadowMapPass, `nsm`, exact |\n|---|---|---|---|---|---|---|---|"
)

PAGE = """# What exact hard shadows cost

`silhouette` and `raytraced` show the same shadows, without a wrong pixel. Times are medians of
whole frames, drawn in turns, as multiples of plain VTK's. One sun, 1024 x 1024 pixels, maps of
1024 x 1024 texels. `tests/lab/pages/exact_price.sh` measures this.

{head}
{rows}

Measured on: {machine}.
"""


def rows_of(folder: Path, scene: str, digits: int = 1):
    """The table's rows of a scene. Plain VTK's milliseconds have so many digits after the point."""
    results = json.loads((folder / scene / "results.json").read_text())
    variants = {variant["name"]: variant for variant in results["variants"]}
    nsm = next(name for name in variants if name.startswith("nsm"))
    shown = (VTK_SHADOWS, nsm, *EXACT)
    shares = [variants[name]["error"]["wrong_share"] for name in (VTK_SHADOWS, nsm, EXACT[0])]
    wrong = ", ".join(f"{100 * share:.3f} %" for share in shares)
    for motion, moving in MOTIONS.items():
        times = {name: of["times"][motion]["frame_ms"] for name, of in variants.items()}
        ratios = [f"{times[name] / times[PLAIN]:.2f}" for name in shown]
        first = motion == "static"
        cells = [scene if first else "", moving, f"{times[PLAIN]:.{digits}f} ms", *ratios]
        yield f"| {' | '.join(cells)} | {wrong if first else ''} |"


def main():
    folder, machine, scenes = Path(sys.argv[1]), sys.argv[2], sys.argv[3:]
    rows = "\n".join(row for scene in scenes for row in rows_of(folder, scene))
    print(PAGE.format(head=HEAD, rows=rows, machine=machine), end="")


if __name__ == "__main__":
    main()
