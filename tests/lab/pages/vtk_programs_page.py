#!/usr/bin/python3
"""Writes docs/results/vtk_programs.md from what tests/lab/pages/vtk_programs.sh ran."""

import argparse
import collections
import csv
import re
from pathlib import Path

TECHNIQUES = ("nsm", "raytraced")
LEFT_OUT = "Visible and lit, but without shadows: "
HEADLIGHT = "headlight"
LEAST = 8  # of 255: smaller differences are rounding

PAGE = """# VTK's own programs with Gnomon

{summary}

Columns: pixels that `nsm` and `raytraced` make darker than plain VTK's by more than {least}/255, and
lighter if any; messages that plain VTK does not give ("left out": the warning of the pass).

| program | light | what is lit and casts | `nsm` | `raytraced` | messages | remark |
|---|---|---|---|---|---|---|
{rows}

Run on: {machine}.

## How the list was made

The programs are unchanged tests of VTK 9.1.0 that show something lit, whose data was at hand, and
that take less than a minute by software (TestFloor takes longer). Left out: TestPBRAnisotropy,
TestPBRClearCoat and TestPBRMapping, which an image alone lights; TestShadowMapBakerPass, which
reads the maps of its own pass. The column `shadows` of `tests/lab/pages/vtk_programs.tsv` was decided from the
pictures, with and without shadows. So the share of programs with shadows is no blind test.

## How the table is made

Each program's main function is compiled as `gnomonProgram`, and linked by hand to
`tests/lab/vtk_programs/main.cxx`. There, an object factory adds the two lines to each renderer, in
place of the program's own passes and shadows. A program without a light off the camera's axis gets
a key light, in all pictures. `tests/lab/pages/vtk_programs.sh` runs each program without Gnomon, by `nsm` and
by `raytraced`, and compares messages and the last picture of each window.
"""


def messages(path):
    """Counts the messages of a run, without addresses."""
    text = path.read_text(errors="replace") if path.exists() else ""
    blocks = re.split(r"\n(?=(?:ERROR|Warning|Generic Warning|Debug): In )", "\n" + text)
    clean = (re.sub(r"0x[0-9a-f]+|\d+ ms", "", block).strip() for block in blocks)
    return collections.Counter(block for block in clean if block)


def extra(out, name, technique):
    """Names the messages that plain VTK does not give: lists left out, and all others."""
    more = messages(out / f"{name}.{technique}.messages")
    more -= messages(out / f"{name}.plain.messages")
    left_out, others = [], []
    for text, count in more.items():
        if LEFT_OUT in text:
            kinds = text.split(LEFT_OUT)[1].split(". See")[0]
            reasons = re.findall(r"\((.*?)\)", kinds) or [kinds]
            left_out += [reason for reason in reasons if reason not in left_out]
        elif "only light" in text and HEADLIGHT in text:
            left_out.append("a headlight alone")
        else:
            others += [text] * count
    return left_out, others


def read(path):
    """Reads a PPM as VTK writes it."""
    data = path.read_bytes()
    header = re.match(rb"P6\s+(?:#.*\s+)*(\d+)\s+(\d+)\s+255\s", data)
    return data[header.end():]


def differences(plain, other):
    """Counts pixels with a darker channel, and those with lighter ones only."""
    if plain == other:
        return 0, 0
    dark, light = 0, 0
    step = 3 * 1024
    for start in range(0, len(plain), step):
        a, b = plain[start:start + step], other[start:start + step]
        if a == b:
            continue
        change = [y - x for x, y in zip(a, b)]
        for i in range(0, len(change), 3):
            pixel = change[i:i + 3]
            if min(pixel) < -LEAST:
                dark += 1
            elif max(pixel) > LEAST:
                light += 1
    return dark, light


def compare(out, name, technique):
    """Compares all windows of a program; None where a run failed or shows other windows."""
    if (out / f"{name}.{technique}.status").read_text().strip() != "0":
        return None
    total = [0, 0]
    windows = sorted(out.glob(f"{name}.plain.*.ppm"))
    for window in windows:
        other = Path(str(window).replace(".plain.", f".{technique}."))
        if not other.exists():
            return None
        a, b = read(window), read(other)
        if len(a) != len(b):
            return None
        for k, count in enumerate(differences(a, b)):
            total[k] += count
    return total if windows else None


def cell(counts):
    if counts is None:
        return "**failed**"
    return f"{counts[0]}, {counts[1]} lighter" if counts[1] else str(counts[0])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("machine")
    arguments = parser.parse_args()
    here = Path(__file__).parent
    out = arguments.out

    rows = []
    tally = collections.Counter()
    with open(here / "vtk_programs.tsv", newline="") as file:
        programs = list(csv.DictReader(file, delimiter="\t"))
    for program in programs:
        name = program["name"]
        lights = out / f"{name}.plain.lights"
        light = lights.read_text().strip() if lights.exists() else "?"
        tally[light] += 1
        counts = [compare(out, name, technique) for technique in TECHNIQUES]
        left_out, others = [], []
        for technique in TECHNIQUES:
            parts = extra(out, name, technique)
            left_out += [part for part in parts[0] if part not in left_out]
            others += [part for part in parts[1] if part not in others]
        told = ["left out: " + ", ".join(left_out)] if left_out else []
        if others:
            told.append(f"**{len(others)} other**")
            tally["other"] += 1
        for text in others:
            print(f"{name}: {text[:400]}\n")
        tally["failed"] += None in counts
        tally["shadows"] += all(count and count[0] for count in counts)
        tally["left out"] += bool(left_out)
        expected = program["shadows"] == "yes"
        tally["expected"] += expected
        tally["seen"] += expected and all(count and count[0] for count in counts)
        rows.append(
            f"| {name} | {light} | {program['what']} | {cell(counts[0])} | {cell(counts[1])} "
            f"| {', '.join(told) or 'none'} | {program['remark'] or ''} |")
    summary = (
        f"Of {tally['expected']} programs that show a surface in the way of another's light, "
        f"{tally['seen']} have shadows by\nboth techniques. Of all {len(rows)} programs, "
        f"{tally['failed'] or 'none'} fail, {tally['left out'] or 'none'} give the warning of what "
        f"is left out, and\n{tally['other'] or 'none'} give another message. {tally['own']} have "
        f"a light of their own off the camera's axis, and {tally['key']}\nget the key light.")
    text = PAGE.format(
        summary=summary, rows="\n".join(rows), machine=arguments.machine, least=LEAST)
    Path("docs/results/vtk_programs.md").write_text(text)


if __name__ == "__main__":
    main()
