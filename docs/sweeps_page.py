#!/usr/bin/python3
"""Prints the page of docs/sweeps.sh from its runs, folders VIEW.KIND.MAP of `gnomon compare`.

A kind is a picture's size (what is traced and wrong), `timed-` and a size, or `timed` (times),
`chain` or `fitted` (the selective chain). Without timed runs the page has no times.
"""

import argparse
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

import pandas as pd

import sweeps_theses as theses
from sweeps_statements import beside, chain_rows, less_time_rows, pixel_rows, time_rows

VIEWS = "bench-with bench-side bench-against trees-with trees-side trees-against flowers-with"
VIEWS += " flowers-side flowers-against atrium primitives-with primitives primitives-against"
READ_TO_UPLOAD = ["read receivers", "trace", "upload"]  # stages of all that traces
CHAIN_PIXELS = 1024 * 1024  # of a picture of the chain's

# What columns of pixels of the results are called here
COLUMNS = {
    "facing_pixels": "facing",
    "wrong_pixels": "wrong",
    "traced_pixels": "traced",
    "false_light_pixels": "false_light",
    "false_shadow_pixels": "false_shadow",
    "class hinted lit_pixels": "hinted_L",
    "class hinted in shadow_pixels": "hinted_S",
    "class confirmed by its texel_pixels": "by_texel",
    "class confirmed by neighbours_pixels": "by_neighbours",
    "class confirmed by adjacency_pixels": "by_adjacency",
    "class corrected_pixels": "corrected",
    "class traced, lit by its texel_pixels": "left_L",
    "class traced, in shadow by its texel_pixels": "left_S",
}

# What the chain's variants are called, by their settings without `contour`, with Moderno's names
# (3.2 to 3.6): the whole chain with hints of four texels and of nine; without hints, which is
# sound; with what is left lit; and its stages alone, all else lit.
CHAINS = {
    "": "TC4",
    "coherence=9": "TC9",
    "coherence=off": "sound",
    "leftovers=lit": "lit",
    "adjacency=off coherence=off leftovers=lit neighbours=1": "ST",
    "adjacency=off coherence=off leftovers=lit neighbours=4": "N4",
    "adjacency=off coherence=off leftovers=lit neighbours=9": "N9",
    "adjacency=edges coherence=off leftovers=lit neighbours=off": "A1",
    "adjacency=vertices coherence=off leftovers=lit neighbours=off": "A2",
}


def read_results(folder: Path, runs: Iterable[str]) -> pd.DataFrame:
    """The rows of all runs, with `view`, `kind` and `map` of their names."""
    frames = []
    for run in runs:
        path = folder / run / "results.csv"
        if not path.is_file():
            sys.exit(f"The run {run} is missing: there is no {path}.")
        view, kind, size = run.split(".")
        frames.append(pd.read_csv(path).assign(view=view, kind=kind, map=int(size)))
    results = pd.concat(frames, ignore_index=True).rename(columns=COLUMNS)
    results["view"] = pd.Categorical(results["view"], VIEWS.split(), ordered=True)
    # Behind a variant's settings are the map and, of `nsm`, where it looks up; of what is timed,
    # all maps are always drawn.
    ending = r" \d+( image)?$| bake=always"
    results["variant"] = results["variant"].str.replace(ending, "", regex=True)
    of_vtk = results["technique"].isin(["plain VTK", "vtkShadowMapPass"])
    return results[~of_vtk].sort_values("view", kind="stable")


def chain_cases(results: pd.DataFrame, kind: str) -> pd.DataFrame:
    """What became of the contour's pixels: a row for each map, view and width.

    Pixels that a variant has are called COLUMN_CHAIN, shares in per cent have _pc in their names. L
    and S are the contour's pixels that are lit and in shadow by their texel (Moderno, 3.1.2), N
    both. The wrong ones in the contour are those beyond the wrong ones of the sound chain, which
    has none there (3.6).
    """
    runs = results[results["kind"] == kind].copy()
    runs["variant"] = runs["variant"].str.replace(" fit=once", "")
    chains = runs[runs["technique"] == "selective"].copy()
    chains["width"] = chains["variant"].str.extract(r"contour=(\d)", expand=False).astype(int)
    settings = chains["variant"].str.replace(r"^selective|contour=\d", "", regex=True)
    chains["chain"] = settings.str.split().str.join(" ").map(CHAINS.__getitem__)
    pixels = chains.set_index(["map", "view", "width", "chain"])[list(COLUMNS.values())]
    cases = beside(pixels, "chain")

    def of_map(variant: str, column: str) -> pd.Series:
        """What another variant has with the same map."""
        of = runs[runs["variant"] == variant].set_index(["map", "view"])[column]
        return of.loc[cases.index.droplevel("width")].set_axis(cases.index)

    # Tables 5 and 6. The status of the contour is taken to be wrong where `nsm` is.
    cases = cases.assign(plain=of_map("nsm", "wrong")).eval("""
        outside = wrong_sound
        caught = plain - outside
        L = hinted_L_TC4 + corrected_TC4 + left_L_TC4
        S = hinted_S_TC4 + by_texel_TC4 + by_neighbours_TC4 + by_adjacency_TC4 + left_S_TC4
        N = L + S
        contour_pc = 100 * N / @CHAIN_PIXELS
        plain_pc = 100 * plain / @CHAIN_PIXELS
        caught_pc = 100 * caught / plain
        status_pc = 100 * caught / N
    """)
    # Tables 12 to 14; what is left: 3.6 and 4.9
    cases = cases.eval("""
        after_N9_L = hinted_L_TC4 + corrected_TC4
        after_N9_S = hinted_S_TC4 + by_texel_TC4 + by_neighbours_TC4
        after_N9_pc = 100 * (after_N9_L + after_N9_S) / N
        after_N9_L_pc = 100 * after_N9_L / L
        after_N9_S_pc = 100 * after_N9_S / S
        after_A2_pc = 100 * (after_N9_L + after_N9_S + by_adjacency_TC4) / N
        after_A2_S_pc = 100 * (after_N9_S + by_adjacency_TC4) / S
        left = left_L_TC4 + left_S_TC4
        left_pc = 100 * left / N
        left_L_pc = 100 * left_L_TC4 / L
        left_S_pc = 100 * left_S_TC4 / S
        left_image_pc = 100 * left / @CHAIN_PIXELS
        wrong_hints = wrong_TC4 - outside
        end_pc = 100 * wrong_hints / N
    """)
    # Tables 7 and 8: wrong hints are what the sound chain does not have wrong
    for hints in ("TC4", "TC9") if kind == "chain" else ("TC4",):
        cases = cases.eval(f"""
            hinted_{hints} = hinted_L_{hints} + hinted_S_{hints}
            hinted_pc_{hints} = 100 * hinted_{hints} / N
            hinted_L_pc_{hints} = 100 * hinted_L_{hints} / L
            hinted_S_pc_{hints} = 100 * hinted_S_{hints} / S
            bad_hints_{hints} = wrong_{hints} - outside
            bad_hints_pc_{hints} = 100 * bad_hints_{hints} / N
            bad_hints_L_pc_{hints} = 100 * (false_light_{hints} - false_light_sound) / L
            bad_hints_S_pc_{hints} = 100 * (false_shadow_{hints} - false_shadow_sound) / S
            bad_of_hints_pc_{hints} = 100 * bad_hints_{hints} / hinted_{hints}
        """)
    if kind == "chain":
        # Table 15, and `coherence`, which hints at all of the picture
        cases["rays"] = of_map("coherence", "traced")
        cases["wrong_of_rays"] = of_map("coherence", "wrong")
        cases = cases.eval("""
            lit_pc = 100 * (wrong_lit - outside) / N
            lit_of_caught = (wrong_lit - outside) / caught
        """)
        # Tables 9 to 11
        for stage in ("ST", "N4", "N9", "A1", "A2"):
            cases = cases.eval(f"""
                error_{stage} = wrong_{stage} - outside
                error_pc_{stage} = 100 * error_{stage} / N
                confirmed_{stage} = by_texel_{stage} + by_neighbours_{stage} + by_adjacency_{stage}
                confirmed_pc_{stage} = 100 * confirmed_{stage} / S
                corrected_pc_{stage} = 100 * corrected_{stage} / L
            """)
    return cases.fillna(0)  # per cent of nothing


def with_times(results: pd.DataFrame) -> pd.DataFrame:
    """What is timed, in ms, with the times of `raytraced`; of kind `timed`, `picture` is empty.

    As in Morais' chapter 6: `maps` are drawn while the light moves; `light` and `resolve` are from
    receivers to visibility while the light moves, and while the camera does; `whole` is `maps` and
    `light`, `camera` what the table of all views has, and maps.
    """
    stages = [f"visibility: {stage}" for stage in ("estimate", *READ_TO_UPLOAD, "build")]
    timed = results[results["kind"].str.startswith("timed")].copy()
    timed["picture"] = timed["kind"].str.removeprefix("timed").str.removeprefix("-")

    def time(motion: str, *names: str) -> pd.Series:
        columns = [f"{motion}_moving_{name}_ms" for name in names]
        return timed.reindex(columns=columns).sum(axis="columns")

    timed["light"], timed["resolve"] = time("light", *stages), time("camera", *stages)
    timed["maps"] = time("light", "maps")
    timed["whole"] = timed["maps"] + timed["light"]
    for stage in READ_TO_UPLOAD:
        timed[stage] = time("camera", f"visibility: {stage}")
    timed["camera"] = time("camera", "maps") + timed[READ_TO_UPLOAD].sum(axis="columns")
    run = ["view", "kind", "map"]
    rays = timed[timed["variant"] == "raytraced"].set_index(run)[["whole", "resolve", "camera"]]
    return timed.join(rays, on=run, rsuffix="_of_rays")


def table(headings: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """A table of the page."""
    headings = list(headings)
    lines = [headings, ["---"] * len(headings), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def variant_rows(cells: pd.DataFrame) -> list[list[str]]:
    """Rows of cells, each behind its variant."""
    return [[f"`{variant}`", *row] for variant, row in zip(cells.index, cells.to_numpy())]


def uncertain(results: pd.DataFrame, picture: str) -> str:
    """Share of traced pixels and wrong pixels of each variant by map, means over the views."""
    of = results.query("kind == @picture and variant != 'raytraced'")
    of = of.assign(share=100 * of["traced"] / of["facing"])
    means = of.groupby(["variant", "map"])[["share", "wrong"]].mean()
    cells = means["share"].map("{:.1f} %, ".format) + means["wrong"].map("{:.0f}".format)
    cells = cells.unstack("map").loc[of["variant"].unique()]
    return table(["", *(f"map {size}: traced, wrong" for size in cells)], variant_rows(cells))


def uncertain_by_view(results: pd.DataFrame, picture: str, size: int) -> str:
    """The same of each view, of one picture and map; of `nsm` the wrong pixels alone."""
    of = results.query("kind == @picture and map == @size and variant != 'raytraced'")
    share = (100 * of["traced"] / of["facing"]).map("{:.1f}".format)
    wrong = of["wrong"].map("{:.0f}".format)
    both = (share + ", " + wrong).where(of["wrong"] > 0, share)
    cells = of.assign(cell=both.where(of["variant"] != "nsm", wrong))
    cells = cells.pivot(index="view", columns="variant", values="cell")
    cells = cells[of["variant"].unique()]
    rows = ([view, *row] for view, row in zip(cells.index, cells.to_numpy()))
    return table(["", *(f"`{variant}`" for variant in cells)], rows)


def times(timed: pd.DataFrame) -> str:
    """Means over the views, of what is timed in all of them."""
    of = timed.query("picture == '' and variant != 'nsm'").eval("ratio = camera / camera_of_rays")
    means = of.groupby("variant", sort=False)[["maps", *READ_TO_UPLOAD, "ratio"]].mean()
    cells = means.applymap("{:.1f} ms".format).assign(ratio=means["ratio"].map("{:.2f}".format))
    stages = ["maps drawn", "read back", "decided and traced", "uploaded"]
    return table(["", *stages, "over `raytraced`"], variant_rows(cells))


def times_of_view(timed: pd.DataFrame, view: str, motion: str) -> str:
    """Times of a view by picture and map; with those of drawing maps where the light moves."""
    of = timed.query("picture != '' and view == @view").copy()
    of["cell"] = of["picture"] + ", map " + of["map"].astype(str)
    of["ms"] = of["light" if motion == "light" else "resolve"].map("{:.1f}".format)
    if motion == "light":
        of["ms"] = of["maps"].map("{:.1f} + ".format) + of["ms"]
    cells = of.pivot(index="variant", columns="cell", values="ms")
    cells = cells.loc[of["variant"].unique(), of["cell"].unique()]
    return table(["", *cells], variant_rows(cells))


def stage_shares(timed: pd.DataFrame) -> str:
    """The least and the most that the stages make up of a frame."""
    shares = timed.filter(like="stage_share").stack()
    return (
        f"Stages make up {shares.min():.3f} to {shares.max():.3f} of a frame, and nine tenths or"
        f" more in {(shares >= 0.9).sum()} of {len(shares)} cases.")


def evenness(timed: pd.DataFrame) -> str:
    """What `raytraced`, which has no map, took of the same picture beside different maps."""
    of = timed.query("picture == '1024x1024' and variant == 'raytraced'")
    extremes = of.groupby("view", observed=True)["resolve"].agg(["min", "max"])
    took = "; ".join(f"{view} {least:.0f} to {most:.0f} ms"
                     for view, least, most in extremes.itertuples())
    return (
        "How even the machine was: `raytraced`, for which the map makes no difference, takes of"
        f" 1024 x 1024 pixels, from receivers to visibility: {took}.")


def chain_means(cases: pd.DataFrame) -> str:
    """Means over the 72 cases, the best and the worst of them, and what the thesis has."""
    rows = []
    for text, measure in theses.MEASURES.iterrows():
        share = cases[measure["share"]]
        extremes = [share.idxmin(), share.idxmax()]
        if measure["best"] == "most":
            extremes.reverse()
        shown = (f"{share[at]:.2f} ({at[1]} {at[0]}, {at[2]})" for at in extremes)
        rows.append([text, f"{share.mean():.2f}", *shown, measure["mean"], measure["range"]])
    unit = "per cent of the contour, if not said otherwise"
    return table([unit, "mean", "best", "worst", "thesis: mean", "thesis: least to most"], rows)


# How tables of groups call shares of chain_cases, in the order in which they have them
HEADINGS = {
    "plain_pc": "map's wrong pixels, of the image",
    "contour_pc": "contour, of the image",
    "caught_pc": "caught",
    "status_pc": "status wrong",
    "hinted_pc_TC4": "hinted",
    "bad_hints_pc_TC4": "wrong hints",
    "bad_of_hints_pc_TC4": "wrong, of hints",
    "error_pc_ST": "alone: its texel",
    "error_pc_N4": "four texels",
    "error_pc_N9": "nine texels",
    "error_pc_A1": "`edges`",
    "error_pc_A2": "`vertices`",
    "after_N9_pc": "settled after nine",
    "after_A2_pc": "after `vertices`",
    "left_pc": "left",
    "lit_pc": "wrong if lit",
}


def group_means(cases: pd.DataFrame, thesis: pd.DataFrame) -> str:
    """Means over the groups of a thesis' table, its rows below; the range of what is caught."""
    case = cases.index.to_frame(index=False).astype(str)
    case["scene"] = case["view"].str.split("-").str[0]
    first, second = thesis.index.name.split(", ")
    groups = cases.groupby((case[first] + ", " + case[second]).to_numpy())
    shares = [share for share in HEADINGS if share in thesis and share in cases]
    cells = groups[shares].mean().applymap("{:.2f}".format)
    extremes = groups["caught_pc"].agg(["min", "max"])
    cells["caught_pc"] += extremes["min"].map(" [{:.0f} to ".format)
    cells["caught_pc"] += extremes["max"].map("{:.0f}]".format)
    rows: list[list[str]] = []
    for group, figures in thesis[shares].iterrows():
        rows += [[group, *cells.loc[group]], ["thesis", *(f"*{figure}*" for figure in figures)]]
    return table([thesis.index.name, *(HEADINGS[share] for share in shares)], rows)


def strategies(cases: pd.DataFrame) -> str:
    """What whole strategies trace and leave wrong, in per cent of all pixels of twelve views."""

    def cell(strategy: pd.Series, what: str, size: int) -> str:
        of = cases.xs((size, int(strategy["width"])), level=("map", "width"))
        share = 100 * of[strategy[what]].sum() / (CHAIN_PIXELS * len(of)) if strategy[what] else 0
        return f"{share:.3f} ({strategy[f'{what} {size}']})"

    columns = [(what, size) for size in (1024, 2048) for what in ("rays", "wrong")]
    rows = ([label, *(cell(strategy, *column) for column in columns)]
            for label, strategy in theses.STRATEGIES.iterrows())
    return table(["", "map 1024: rays", "wrong", "map 2048: rays", "wrong"], rows)


def chain_by_view(cases: pd.DataFrame) -> str:
    """Wrong pixels of the map and of the chain, and what it traces of those that face the light."""
    share = (100 * cases["traced_TC4"] / cases["facing_TC4"]).map("{:.2f} %".format)
    cells = (cases["wrong_TC4"].map("{:.0f}, ".format) + share).unstack("width")
    plain = cases["plain"].xs(2, level="width").map("{:.0f}".format)
    rows = ([view, str(size), plain[size, view], *row]
            for (size, view), row in zip(cells.index, cells.to_numpy()))
    widths = ["2 pixels: wrong, traced", "4 pixels", "6 pixels"]
    return table(["view", "map", "`nsm`: wrong", *widths], rows)


def parts(results: pd.DataFrame, machine: str, view_frames: int, cell_frames: int) -> Iterator[str]:
    """The page, part by part."""
    timed = with_times(results)
    cases = chain_cases(results, "chain")
    checked = ["", "holds in", "thesis", "not in"]

    yield "# Sweeps over maps, pictures and views"
    yield f"Written by `docs/sweeps.sh`, on: {machine}."
    yield """\
Ten views: the garden's nine sides and the atrium, as in Morais' thesis. Twelve views: the garden's
and the three sides of the primitives, as in Moderno's. Traced is the share of the pixels that face
the light; wrong pixels are in pixels. Means come first, then [what the theses' tables
show](#what-the-theses-tables-show-here), then tables [view by view](#view-by-view)."""
    yield "## Means over ten views"
    for picture in ("512x512", "1024x1024", "1920x1080"):
        yield f"### {picture.replace('x', ' x ')} pixels"
        yield uncertain(results, picture)
    yield f"Morais' means, 1024 x 1024 pixels, map of 1024: {theses.TRACED}."
    if len(timed):
        yield "### Time, 1024 x 1024 pixels, maps of 1024"
        yield f"""\
Medians of {view_frames} frames. Maps are drawn in every frame while the light moves (`bake`
`always`); the other columns are of a camera that moves under a light that does not, for which they
are drawn once."""
        yield times(timed)
        yield stage_shares(timed)

    yield "## The selective chain: means over 72 cases"
    yield """\
Twelve views, maps of 1024 and 2048, contours of 2, 4 and 6 pixels; 1024 x 1024 pixels. Wrong hints,
and what is wrong in the contour after a stage, are told by the chain without hints, which has no
wrong pixel there. The wrong pixels of the map are those of `nsm`: of the chain's own status in the
contour alone no report tells them, only [tests](techniques/acceptance.md#the-stages-of-the-chain),
which hold how close they are to these. Pixels that are turned away from the light are not counted
in contours; in the thesis they are, as hinted. `edges` and `vertices` correct nothing: they are
asked for pixels in shadow alone."""
    yield chain_means(cases)
    yield """\
By map and width of the contour, per cent of the contour, means over twelve views [least to most];
below each row the thesis' one:"""
    yield group_means(cases, theses.BY_MAP_AND_WIDTH.drop(columns="plain_pc"))
    yield """\
The maps above lie over all casters. The thesis fits them to what the camera sees; the same with
`fit` `once`:"""
    yield group_means(chain_cases(results, "fitted"), theses.BY_MAP_AND_WIDTH)
    yield "By scene and map (over all casters), means over three views and three widths:"
    yield group_means(cases, theses.BY_SCENE)
    yield """\
What whole strategies trace and leave wrong, per cent of all pixels of the twelve views (the thesis
in brackets):"""
    yield strategies(cases)

    yield "## What the theses' tables show, here"
    yield """\
Cases are views, pictures and maps; those in which a statement does not hold are named, with the
reason. The thesis' column says in how many of its own cases it holds, where its tables tell."""
    yield "### Traced and wrong pixels (Morais)"
    yield table(checked, pixel_rows(results))
    if len(timed):
        yield "### Times (Morais)"
        yield """\
Of the [two views](#time-over-maps-and-pictures) that are timed over maps and pictures. Resolve is
from receivers to visibility."""
        yield table(checked, time_rows(timed))
        yield """\
How often each takes less than `raytraced`, and a smaller share of its time with twice the map, from
1024 on (the thesis in brackets; it compares the times themselves):"""
        headings = ["maps and resolve, light moving", "resolve, light static"]
        headings += ["the same, ten views, map 1024", "resolve, twice the map"]
        yield table(["", *headings], less_time_rows(timed))
        yield """\
Where they take longer: maps drawn on the CPU take longer than the rays that they save, so that they
pay where the light rests; where most pixels are traced (`crsm`, small maps), looking them up comes
on top of their rays. `coherence` and `selective` look every pixel up, on the CPU, too, where a
look-up with its triangle takes longer than a ray of Embree
([limits](techniques/selective.md#artefacts-and-limits)): a larger map has fewer rays, but not fewer
look-ups. In the thesis both were the GPU's. Maps are timed one after another, not side by side: what
twice the map saves in the atrium and by fitted maps, where few rays are left, is within what such
runs differ by."""
    yield "### The selective chain (Moderno)"
    yield table(checked, chain_rows(cases))
    ratio = cases["left_L_TC4"].sum() / cases["left_S_TC4"].sum()
    yield f"""\
Pixels that `selective` leaves: {ratio:.2f} that are lit by their texel to 1 in shadow (thesis:
{theses.LEFT_LIT_TO_SHADOW})."""

    yield "## View by view"
    yield "### Traced and wrong, 1024 x 1024 pixels, maps of 1024"
    yield """\
Per cent of the pixels that face the light, then wrong pixels where there are any; of `nsm` the
wrong pixels."""
    yield uncertain_by_view(results, "1024x1024", 1024)
    if len(timed):
        yield "### Time over maps and pictures"
        yield f"""\
In milliseconds, medians of {cell_frames} frames. `nsm` looks up on the (software) GPU. While the
light moves: maps drawn + from receivers to visibility, with `bake` `always`, by which `crsm` and
its kin draw their maps in these frames, too. While the camera moves and the light does not: from
receivers to visibility alone. Of two of the ten views, one of the garden and the atrium: a machine
must do nothing else while these are timed, and all ten would take five times as long."""
        yield evenness(timed)
        for view in timed.loc[timed["picture"] != "", "view"].unique():
            for motion in ("light", "camera"):
                yield f"#### {view}, {motion} moving"
                yield times_of_view(timed, view, motion)
    yield "### The selective chain"
    yield """\
Wrong pixels of the map and of the chain (default settings), and the share of the pixels that face
the light that it traces."""
    yield chain_by_view(cases)


def main() -> None:
    """Prints the page of the runs that are named."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--machine", required=True, help="what the runs were made on")
    parser.add_argument("--view-frames", type=int, required=True, help="frames of VIEW.timed.MAP")
    parser.add_argument(
        "--cell-frames", type=int, required=True, help="frames of VIEW.timed-SIZE.MAP")
    parser.add_argument("folder", type=Path, help="of the runs")
    parser.add_argument("runs", nargs="+", help="VIEW.KIND.MAP, all that the page is of")
    given = parser.parse_args()
    results = read_results(given.folder, given.runs)
    print("\n\n".join(parts(results, given.machine, given.view_frames, given.cell_frames)))


if __name__ == "__main__":
    main()
