"""Writes docs/results/auto.md from the lines of gnomon_benchmark_auto.

python3 tests/lab/pages/auto_page.py auto.csv flights.csv MACHINE
"""

import collections
import csv
import statistics
import sys

DEAREST = 1.3

PAGE = """# How well `auto` chooses

## From random places

The camera moves by small steps from random places. The error is that of the last frame.
At the first places `auto` is compared with single techniques. The best one, known
afterwards, is the fastest that keeps the error there with maps that are baked already.
Times are medians of ten frames, of `auto` and the two fastest single techniques in turns.

{places}

## With a time budget

The camera flies once around the scene in 180 frames; a third of the flight is under
load. A frame is possible if rays, or the coarsest map that keeps the error, take at
most 1.2 of the budget in that frame, and late if `auto` takes longer. Changes are those
between maps and rays. Where 100 % may be wrong, the budget alone counts.
[All figures](auto_flights.csv).

{flights}

`tests/lab/pages/auto.sh` measures this; [the table](auto.csv) has a line for each place that was
compared, and for each where the error was not kept.

Measured on: {machine}.
"""

HARD = """### Hard shadows

The error is the share of wrong pixels among those that face a light, of which some places
show few; 0.50 % is allowed. Single techniques are `nsm`, `lispsm`, `tsm` or `pssm` with
maps of several sizes (at most 2 GiB for all lights), `silhouette` or `raytraced`.

"""

SOFT = """### Soft shadows

The error is the root mean square of the difference from rays to 1,024 points of the light;
0.03 is allowed. Single techniques are `penumbra` or `raytraced` with 1, 4, 6, 8, 10, 12,
16, 32 or 64 samples, `pcss`, `montecarlo`, or `nsm` and `silhouette`, whose shadows are hard.

"""

PLACES_HEAD = (
    "| scene | places | {chosen} | error kept | largest error | compared "
    "| at most 1.3 times the best | over the best: median | most |\n"
    "|---|---|---|---|---|---|---|---|---|"
)

FLIGHTS_HEAD = (
    "| scene | error allowed | plain frames in the budget | possible | late "
    "| under load: possible | late | changes |\n"
    "|---|---|---|---|---|---|---|---|"
)


def share(rows, keeps):
    return f"{100 * sum(keeps(row) for row in rows) / len(rows):.1f} %"


def with_maps(rows):
    return str(sum(row["technique"] == "nsm" for row in rows))


def samples_of(row):
    """The samples of a choice; 1 if its shadows are hard."""
    return int(row["samples"])


def by_samples(taken):
    """Return a function: how many choices had each number of samples that was taken."""

    def counts(rows):
        found = collections.Counter(map(samples_of, rows))
        return ", ".join(str(found[samples]) for samples in taken)

    return counts


def percent(error):
    return f"{100 * error:.2f} %"


def place_line(name, rows, chosen, error):
    compared = [row for row in rows if row["best"]]
    if not compared:
        raise SystemExit(f"{name}: no place was compared")
    over = [float(row["over best"]) for row in compared]
    return (
        f"| {name} | {len(rows)} | {chosen(rows)} "
        f"| {share(rows, lambda row: float(row['error']) <= float(row['allowed']))} "
        f"| {error(max(float(row['error']) for row in rows))} "
        f"| {len(compared)} | {share(compared, lambda row: float(row['over best']) <= DEAREST)} "
        f"| {statistics.median(over):.2f} | {max(over):.2f} |"
    )


def flight_line(row):
    return (
        f"| `{row['scene']}` | {100 * float(row['error']):g} % | {row['plain frames']} "
        f"| {row['possible']} of {row['frames']} | {row['late']} "
        f"| {row['loaded possible']} of {row['loaded']} | {row['loaded late']} | {row['changes']} |"
    )


def read(path):
    with open(path, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def table(rows, head, chosen, error):
    """The lines of scenes whose errors are of one kind."""
    lines = [
        place_line(f"`{scene}`", [row for row in rows if row["scene"] == scene], chosen, error)
        for scene in dict.fromkeys(row["scene"] for row in rows)
    ]
    return "\n".join([head, *lines, place_line("all", rows, chosen, error)])


def places_table(path):
    """The tables of the places in the lines of gnomon_benchmark_auto."""
    rows = read(path)
    with_areas = {row["scene"] for row in rows if row["technique"] == "penumbra"}
    soft = [row for row in rows if row["scene"] in with_areas]
    hard = [row for row in rows if row["scene"] not in with_areas]
    taken = sorted({1, *map(samples_of, soft)})
    samples = f"hard, with {', '.join(map(str, taken[1:]))} samples"
    tables = [
        text + table(of, PLACES_HEAD.format(chosen=head), chosen, error)
        for text, of, head, chosen, error in (
            (HARD, hard, "with maps", with_maps, percent),
            (SOFT, soft, samples, by_samples(taken), "{:.3f}".format),
        )
        if of
    ]
    return "\n\n".join(tables)


def flights_table(path):
    """The table of flights in the lines of gnomon_benchmark_auto --budget."""
    return "\n".join([FLIGHTS_HEAD, *map(flight_line, read(path))])


def main():
    places, flights, machine = sys.argv[1:]
    print(
        PAGE.format(places=places_table(places), flights=flights_table(flights), machine=machine),
        end="",
    )


if __name__ == "__main__":
    main()
