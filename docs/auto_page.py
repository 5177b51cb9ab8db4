"""Writes docs/results/auto.md from the lines of gnomon_benchmark_auto.

python3 docs/auto_page.py auto.csv MACHINE
"""

import csv
import statistics
import sys

ALLOWED = 0.005
DEAREST = 1.3

HEAD = (
    "| scene | places | with maps | error kept | largest error | compared "
    "| at most 1.3 times the best | over the best: median | most |\n"
    "|---|---|---|---|---|---|---|---|---|"
)


def share(rows, keeps):
    return f"{100 * sum(keeps(row) for row in rows) / len(rows):.1f} %"


def line(name, rows):
    compared = [row for row in rows if row["best"]]
    if not compared:
        raise SystemExit(f"{name}: no place was compared")
    over = [float(row["over best"]) for row in compared]
    maps = [row for row in rows if row["technique"] == "nsm"]
    return (
        f"| {name} | {len(rows)} | {len(maps)} "
        f"| {share(rows, lambda row: float(row['wrong share']) <= ALLOWED)} "
        f"| {100 * max(float(row['wrong share']) for row in rows):.2f} % "
        f"| {len(compared)} | {share(compared, lambda row: float(row['over best']) <= DEAREST)} "
        f"| {statistics.median(over):.2f} | {max(over):.2f} |"
    )


def main():
    with open(sys.argv[1], newline="", encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    print("# How well `auto` chooses")
    print()
    print(
        "The camera moves by small steps from random places. The error is the share of wrong pixels in\n"
        "the last frame; 0.50 % is allowed. At the first places `auto` is compared with single\n"
        "techniques. The best one, known afterwards, is the fastest that keeps the error there\n"
        "with maps that are baked already: `nsm`, `lispsm`, `tsm` or `pssm` with maps of several\n"
        "sizes, `silhouette` or `raytraced`. Times are medians of ten frames, of `auto` and the\n"
        "two fastest single techniques in turns."
    )
    print()
    print(HEAD)
    for scene in scenes:
        print(line(f"`{scene}`", [row for row in rows if row["scene"] == scene]))
    print(line("all", rows))
    print()
    print(
        "`docs/auto.sh` measures this; [the table](auto.csv) has a line for each place that was\n"
        "compared, and for each where the error was not kept."
    )
    print()
    print(f"Measured on: {sys.argv[2]}.")


if __name__ == "__main__":
    main()
