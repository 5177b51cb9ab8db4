#!/usr/bin/python3
"""Turn what programs print or draw into the tables of docs/results. measure.sh calls it.

    collect.py comparisons EXPERIMENT SCENE SHADOWS FOLDER   `gnomon compare -o FOLDER`
    collect.py conclusions FOLDER
    collect.py auto OPENGL FILE
    collect.py flights OPENGL FILE
    collect.py vtk_programs FOLDER
    collect.py rows NAME                  a table from the standard input, with tabs
    collect.py machine RESULTS MACHINE

Rows of an experiment, a run, a kind of OpenGL or a machine replace those with the same keys.
"""

import csv
import re
import statistics
import sys
from collections import Counter
from pathlib import Path

RESULTS = Path(__file__).resolve().parents[3] / "docs/results"
MOTIONS = ("static", "camera_moving", "light_moving")


def read(path, **options):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file, **options))


def write(name, rows, keys=()):
    """Replace the rows of a table that equal one of these in the keys; without keys, all."""
    path = RESULTS / f"{name}.csv"
    others = read(path) if keys and path.exists() else []
    replaced = {tuple(str(row[key]) for key in keys) for row in rows}
    rows = [row for row in others if tuple(row[key] for key in keys) not in replaced] + rows
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def comparisons(experiment, scene, shadows, folder):
    found = read(Path(folder) / "results.csv")
    plain = next(row for row in found if row["technique"] == "plain VTK")

    def share(row, column):
        return f"{float(row[column]) / float(row['facing_pixels']):.6g}"

    def over_plain(row, column):
        return f"{float(row[column]) / float(plain[column]):.2f}"

    write("comparisons", [
        {"experiment": experiment, "scene": scene, "shadows": shadows, "variant": row["variant"]}
        | {f"{name}_share": share(row, f"{name}_pixels")
           for name in ("wrong", "false_light", "false_shadow", "between")}
        | {name: f"{float(row[name]):.6g}" for name in ("mean_absolute_error", "rms_error")}
        | {f"{motion}_ms": f"{float(row[f'{motion}_ms']):.1f}" for motion in MOTIONS}
        | {f"{motion}_over_plain": over_plain(row, f"{motion}_ms") for motion in MOTIONS}
        for row in found
    ], keys=("experiment", "scene", "shadows"))


# Columns of the conclusions' table, and of which ones of results.csv each is the sum.
OF_CONCLUSIONS = {
    "facing": r"facing_pixels",
    "wrong": r"wrong_pixels",
    "false_shadow": r"false_shadow_pixels",
    "traced": r"traced_pixels",
    "hinted": r"class hinted .*",
    "left": r"class (traced, .*|left lit)_pixels",
    "contour": r"class (hinted|confirmed|corrected|traced,|left lit).*",
    "rms": r"rms_error",
    "mean_error": r"mean_absolute_error",
    "maps_ms": r"light_moving_maps_ms",
    "resolve_ms": r"light_moving_visibility: .*",
    "frame_ms": r"light_moving_ms",
}


def conclusions(folder):
    folder = Path(folder)
    names = ("run", "scene", "map_size", "variant", *OF_CONCLUSIONS)
    rows = []
    for results in sorted(folder.glob("*/results.csv")):
        run, scene = results.parent.name.split(".")
        for row in read(results):
            if row["technique"] in ("plain VTK", "vtkShadowMapPass"):
                continue
            sums = {
                name: sum(float(row[of] or 0) for of in row if re.fullmatch(pattern, of))
                for name, pattern in OF_CONCLUSIONS.items()
            }
            rows.append({
                "run": run, "scene": scene, "map_size": row["map_size"],
                "variant": re.sub(r"( \d+)?( inline| image)?$", "", row["variant"]),
            } | {name: f"{value:.6g}" for name, value in sums.items()})
    for fitting in folder.glob("fitting.txt"):
        for task, milliseconds in re.findall(
                r"^(\S.*?) {2,}([\d.]+)$", fitting.read_text(), re.MULTILINE):
            rows.append(
                {"run": "fitting", "scene": "bunny", "variant": task, "maps_ms": milliseconds})
    for md5 in folder.glob("md5.txt"):
        tests = md5.read_text()
        rows.append({
            "run": "md5", "variant": "ReducedMd5", "facing": tests.count("[       OK ]"),
            "wrong": len(re.findall(r"^\[  FAILED  \] \S+ \(", tests, re.MULTILINE)),
        })
    write("conclusions", [{name: row.get(name, "") for name in names} for row in rows],
          keys=("run",))


def auto(opengl, path):
    """Sum up the places of each scene."""
    places = read(path)
    rows = []
    for scene in dict.fromkeys(row["scene"] for row in places):
        of = [row for row in places if row["scene"] == scene]
        compared = [float(row["over best"]) for row in of if row["best"]]
        soft = any(row["technique"] == "penumbra" for row in of)
        kept = [float(row["error"]) <= float(row["allowed"]) for row in of]
        samples = Counter(int(row["samples"]) for row in of)
        rows.append({
            "opengl": opengl, "shadows": "soft" if soft else "hard", "scene": scene,
            "places": len(of),
            "chosen": " ".join(f"{count}x{number}" for number, count in sorted(samples.items()))
            if soft else sum(row["technique"] == "nsm" for row in of),
            "kept_share": f"{statistics.mean(kept):.4g}",
            "largest_error": f"{max(float(row['error']) for row in of):.5g}",
            "compared": len(compared),
            "within_share": f"{statistics.mean(over <= 1.3 for over in compared):.4g}",
            "over_best_median": f"{statistics.median(compared):.2f}",
            "over_best_most": f"{max(compared):.2f}",
        })
    write("auto", rows, keys=("opengl", "scene"))


def flights(opengl, path):
    rows = [
        {"opengl": opengl} | {key.replace(" ", "_"): value for key, value in row.items()}
        for row in read(path)
    ]
    write("auto_flights", rows, keys=("opengl", "error", "plain_frames", "scene"))


def messages(path):
    """Count the messages of a run, without addresses."""
    text = path.read_text(errors="replace") if path.exists() else ""
    blocks = re.split(r"\n(?=(?:ERROR|Warning|Generic Warning|Debug): In )", "\n" + text)
    clean = (re.sub(r"0x[0-9a-f]+|\d+ ms", "", block).strip() for block in blocks)
    return Counter(block for block in clean if block)


def told(folder, name, technique):
    """Name what the pass says it leaves out, and count messages that plain VTK does not give."""
    more = messages(folder / f"{name}.{technique}.messages")
    more -= messages(folder / f"{name}.plain.messages")
    left_out, others = [], 0
    for text, count in more.items():
        if "without shadows: " in text:
            kinds = text.split("without shadows: ")[1].split(". See")[0]
            left_out += re.findall(r"\((.*?)\)", kinds) or [kinds]
        elif "only light" in text and "headlight" in text:
            left_out.append("a headlight alone")
        else:
            others += count
            print(f"{name}: {text[:400]}", file=sys.stderr)
    return left_out, others


def picture(path):
    """Read a PPM as VTK writes it."""
    data = path.read_bytes()
    header = re.match(rb"P6\s+(?:#.*\s+)*(\d+)\s+(\d+)\s+255\s", data)
    return data[header.end():]


def differences(folder, name, technique):
    """Count pixels that are darker, and lighter, by more than rounding; None if the run failed."""
    least = 8  # of 255
    windows = sorted(folder.glob(f"{name}.plain.*.ppm"))
    if (folder / f"{name}.{technique}.status").read_text().strip() != "0" or not windows:
        return None
    darker = lighter = 0
    for window in windows:
        other = Path(str(window).replace(".plain.", f".{technique}."))
        plain, shadowed = picture(window), picture(other) if other.exists() else b""
        if len(plain) != len(shadowed):
            return None
        change = [b - a for a, b in zip(plain, shadowed)]
        for i in range(0, len(change), 3):
            pixel = change[i:i + 3]
            darker += min(pixel) < -least
            lighter += min(pixel) >= -least and max(pixel) > least
    return darker, lighter


def vtk_programs(folder):
    folder = Path(folder)
    rows = []
    for program in read(Path(__file__).parent / "vtk_programs.tsv", delimiter="\t"):
        name = program["name"]
        row = {
            "program": name, "light": (folder / f"{name}.plain.lights").read_text().strip(),
            "shows": program["what"], "has_shadows": program["shadows"],
        }
        left_out, others = [], 0
        for technique in ("nsm", "raytraced"):
            counts = differences(folder, name, technique) or ("failed", "failed")
            row |= {f"{technique}_darker": counts[0], f"{technique}_lighter": counts[1]}
            left, more = told(folder, name, technique)
            left_out += [reason for reason in left if reason not in left_out]
            others += more
        text = ["left out: " + ", ".join(left_out)] if left_out else []
        text += [f"{others} other"] if others else []
        rows.append(row | {"messages": ", ".join(text), "remark": program["remark"]})
    write("vtk_programs", rows)


def rows_of(name):
    write(name, list(csv.DictReader(sys.stdin, delimiter="\t")))


def machine(results, name):
    write("machines", [{"results": results, "machine": name}], keys=("results",))


if __name__ == "__main__":
    commands = {
        "comparisons": comparisons, "conclusions": conclusions, "auto": auto, "flights": flights,
        "vtk_programs": vtk_programs, "rows": rows_of, "machine": machine,
    }
    if len(sys.argv) < 3 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    commands[sys.argv[1]](*sys.argv[2:])
