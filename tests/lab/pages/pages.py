#!/usr/bin/python3
"""Make the pages and charts of docs/ from the tables in docs/results.

    tests/lab/pages/pages.py [--charts]

Each template of this folder's `templates` becomes a page, or the part of one between the marks
`<!-- NAME -->` and `<!-- end of NAME -->`. --charts draws the charts, too (python3-matplotlib).
"""

import csv
import math
import re
import statistics
import sys
import textwrap
from collections import Counter
from pathlib import Path

import jinja2

import conclusions

ROOT = Path(__file__).resolve().parents[3]
RESULTS = ROOT / "docs/results"

PAGES = {
    "results": "docs/results/README.md",
    "auto": "docs/results/auto.md",
    "conclusions": "docs/results/conclusions.md",
    "hard_cases": "docs/results/hard_cases.md",
    "cost": "docs/guide/cost-of-accuracy.md",
}
PARTS = {"figures": "README.md"}


def table(name):
    """Return the rows of docs/results/NAME.csv; figures are numbers, empty cells None."""

    def value(text):
        try:
            return float(text)
        except ValueError:
            return text or None

    with open(RESULTS / f"{name}.csv", newline="", encoding="utf-8") as file:
        return [
            {key: value(text) for key, text in row.items()} for row in csv.DictReader(file)
        ]


def where(rows, **cells):
    """Return the rows that have these cells."""
    return [row for row in rows if all(row[key] == cell for key, cell in cells.items())]


def of_study(rows, shadows, variant):
    """Return a variant's mean error and its mean multiples of plain VTK's time."""
    cases = {(row["scene"], row["view"]) for row in where(rows, shadows=shadows)}
    own = where(rows, shadows=shadows, variant=variant)
    if len(own) != len(cases):
        sys.exit(f"study.csv: {variant} took part in {len(own)} of {len(cases)} cases")
    error = "wrong_share" if shadows == "hard" else "rms_error"
    means = {"cases": len(cases), "error": statistics.mean(row[error] for row in own)}
    for motion in ("static", "camera_moving", "light_moving"):
        means[motion] = statistics.geometric_mean(row[f"{motion}_over_plain"] for row in own)
    return means


def growth():
    """Return the times over x of each axis that has a scale and each contender."""
    curves = {}
    for row in table("growth"):
        sides = str(row["case"]).replace(",", "").removesuffix(".0").split(" x ")
        if row["milliseconds"] is not None and all(side.isdigit() for side in sides):
            points = curves.setdefault(row["axis"], {}).setdefault(row["contender"], [])
            points.append((math.prod(map(int, sides)), row["milliseconds"]))
    return curves


def filled(text):
    """Wrap paragraphs and items; leave tables, headings, pictures and code as they are."""

    def unbroken(code_or_link):
        return code_or_link[0].replace(" ", "\0")

    def wrap(block):
        if block.startswith(("|", "#", "!", "<", "    ", "```")):
            return block
        items = block.replace("\n- ", "\n\0- ").split("\0")
        wrapped = [
            textwrap.fill(
                re.sub(r"`[^`]*`|\[[^]]*\]", unbroken, " ".join(item.split())),
                width=100, break_long_words=False, break_on_hyphens=False,
                subsequent_indent="  " if item.startswith("- ") else "")
            for item in items
        ]
        return "\n".join(wrapped).replace("\0", " ")

    return "\n\n".join(wrap(block) for block in re.split(r"\n\n+", text.strip()))


def put(page, name, text):
    """Replace the part of a page between a name's marks."""
    begin, end = f"<!-- {name} -->", f"<!-- end of {name} -->"
    before, rest = page.read_text(encoding="utf-8").split(begin)
    after = rest.split(end)[1]
    page.write_text(f"{before}{begin}\n\n{text}\n\n{end}{after}", encoding="utf-8")


def write_pages():
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "percent": lambda share, digits=3: f"{100 * share:.{digits}f} %",
        "fixed": lambda value, digits=2: "" if value is None else f"{value:.{digits}f}",
        "count": lambda value: f"{value:,.0f}",
        "total": lambda rows, key: sum(row[key] or 0 for row in rows),
        "sum_product": lambda rows, a, b: sum(row[a] * row[b] for row in rows),
    }
    environment.globals |= {
        "table": table,
        "where": where,
        "of_study": lambda shadows, variant: of_study(table("study"), shadows, variant),
        "conclusions": lambda: conclusions.rows(RESULTS / "conclusions.csv"),
        "machine": {row["results"]: row["machine"] for row in table("machines")},
        "tally": lambda rows, key: Counter(row[key] for row in rows),
    }
    for name, page in PAGES.items():
        text = environment.get_template(f"{name}.md.j2").render()
        (ROOT / page).write_text(filled(text) + "\n", encoding="utf-8")
    for name, page in PARTS.items():
        text = environment.get_template(f"{name}.md.j2").render()
        put(ROOT / page, name, filled(text))


def main():
    write_pages()
    if "--charts" in sys.argv[1:]:
        import charts

        charts.draw(table, growth())


if __name__ == "__main__":
    main()
