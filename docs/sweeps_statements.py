"""What the theses' tables show, as statements about cases of sweeps_page.py.

The theses: sweeps_theses.py. Moderno's statements are those of its tables 5 to 15 and of its
appendix, Morais' those of tables 17, 18 and 67 to 82 (traced and wrong pixels) and 20 to 25 and 83
to 102 (times).
"""

from collections.abc import Callable
from dataclasses import dataclass

import pandas as pd

import sweeps_theses as theses

# What columns call the variants
VARIANTS = {
    "crsm as_published=on": "crsm_published",
    "crsma as_published=on": "crsma_published",
    "crsma adjacency_ring=vertices": "crsma_vertices",
    "silhouette fit=once": "silhouette_fitted",
}
HYBRIDS = ["coherence", "crsm", "crsma", "silhouette", *VARIANTS]
Cases = pd.DataFrame


@dataclass(frozen=True)
class Statement:
    """A statement, and where it `holds`: an expression of cases' columns."""

    text: str
    holds: str
    thesis: str = ""  # in how many of its cases it holds
    figures: str = ""  # format of columns that is shown of cases in which it does not hold
    why: str | Callable[[Cases], str] = ""  # it does not hold in these
    views: str = ""  # regular expression of those that it is about; all if empty


def place(case: dict) -> str:
    """What a case is called, by the levels of its index."""
    words = [f"`{case['variant']}`"] if "variant" in case else []
    words += [str(case[level]) for level in ("view", "picture", "map") if level in case]
    return " ".join(words) + (f", contour {case['width']}" if "width" in case else "")


def check(cases: Cases, statements: list[Statement]) -> list[list[str]]:
    """Of each, in how many cases it holds, in how many of the thesis', in which not, and why."""
    rows = []
    for statement in statements:
        views = cases.index.get_level_values("view").astype(str)
        of = cases[views.str.match(statement.views)]
        failing = of[~of.eval(statement.holds)]
        places = [place(case) for case in failing.index.to_frame(index=False).to_dict("records")]
        if statement.figures:
            figures = map(statement.figures.format_map, failing.to_dict("records"))
            places = [f"{where} ({what})" for where, what in zip(places, figures)]
        elif len(failing) == len(of):
            places = ["all of them"]
        why = statement.why(failing) if callable(statement.why) else statement.why
        not_in = "; ".join(places) + (f". {why}" if len(failing) and why else "")
        held = len(of) - len(failing)
        rows.append([statement.text, f"{held} of {len(of)}", statement.thesis, not_in])
    return rows


def beside(cases: Cases, *levels: str) -> Cases:
    """Cases that differ in these levels only, side by side: columns are called NAME_LEVEL..."""
    wide = cases.unstack(list(levels)).rename(columns=VARIANTS)
    return wide.set_axis(["_".join(map(str, column)) for column in wide.columns], axis="columns")


def with_half_the_map(cases: Cases) -> Cases:
    """Cases of which there are some with half the map, with these' columns, called NAME_at_half."""
    half = cases.rename(index=lambda size: 2 * size, level="map").add_suffix("_at_half")
    return cases.join(half, how="inner")


# Morais: traced and wrong pixels. Of runs, side by side by variant:
OF_RUNS = [
    Statement("`coherence` traces less than `crsma` as published",
              "traced_coherence < traced_crsma_published", "all"),
    Statement("`crsma` as published traces no more than `crsm` as published",
              "traced_crsma_published <= traced_crsm_published", "all"),
    Statement("`crsma` traces no more than `crsm`", "traced_crsma <= traced_crsm"),
    Statement("`crsma` around vertices traces no more than across edges",
              "traced_crsma_vertices <= traced_crsma"),
    Statement("`silhouette` traces no more than `crsma`", "traced_silhouette <= traced_crsma"),
    Statement("`crsm`, `crsma`, `silhouette`: no wrong pixel",
              "wrong_crsm + wrong_crsma + wrong_crsma_vertices + wrong_silhouette"
              " + wrong_silhouette_fitted == 0"),
    Statement("`coherence` has fewer wrong pixels than `nsm`", "wrong_coherence < wrong_nsm"),
]
# Of variants, with half the map:
TRACED_BY_MAP = Statement("traced pixels fall with the map's size, from 1024 on",
                          "traced < traced_at_half")
TRACED_BY_PICTURE = Statement(
    "the share of traced pixels is the same in 512 x 512 and 1024 x 1024 pixels, within 0.3 points",
    "points <= 0.3", figures="{points:.1f} points")
WRONG_BY_MAP = {
    "nsm": Statement("`nsm` has fewer wrong pixels with a larger map", "wrong < wrong_at_half"),
    "crsm as_published=on": Statement(
        "`crsm` as published has more wrong pixels with a larger map", "wrong >= wrong_at_half"),
    "crsma as_published=on": Statement(
        "`crsma` as published has more wrong pixels with a larger map", "wrong >= wrong_at_half"),
}


def pixel_rows(results: Cases) -> list[list[str]]:
    """Checks of Morais' tables of traced and wrong pixels."""
    runs = results[results["kind"].str.match(r"\d+x") & (results["variant"] != "raytraced")]
    runs = runs.assign(picture=runs["kind"], share=100 * runs["traced"] / runs["facing"])
    pixels = runs.set_index(["variant", "view", "picture", "map"])[["traced", "wrong", "share"]]
    by_map = with_half_the_map(pixels.xs("1024x1024", level="picture"))
    by_picture = beside(pixels.xs(1024, level="map"), "picture")
    by_picture["points"] = (by_picture["share_512x512"] - by_picture["share_1024x1024"]).abs()
    rows = check(beside(pixels, "variant"), OF_RUNS)
    rows += check(by_map.loc[HYBRIDS].query("map >= 2048"), [TRACED_BY_MAP])
    rows += check(by_picture.loc[HYBRIDS], [TRACED_BY_PICTURE])
    for variant, statement in WRONG_BY_MAP.items():
        rows += check(by_map.xs(variant, level="variant"), [statement])
    return rows


# Morais: times
COHERENCE_DRAWS = (
    "Its map, of triangles, is drawn on the CPU in double precision and has 24 bytes a texel; the"
    " thesis had a plain map of depths, and a GPU that looks it up")
NEIGHBOURS_DRAWN = (
    "Both are drawn on the CPU here, of the same triangles; in the thesis it is a geometry shader"
    " that makes maps with neighbours slow")
TIMES = [
    Statement("maps: `coherence` draws its own faster than `crsm` as published",
              "maps_coherence < maps_crsm_published", "16 of 16", why=COHERENCE_DRAWS),
    Statement("maps: `crsm` as published draws them faster than `crsma` as published",
              "maps_crsm_published < maps_crsma_published", "16 of 16", why=NEIGHBOURS_DRAWN),
    Statement("maps: `crsm` as published draws them faster than `crsm`",
              "maps_crsm_published < maps_crsm"),
    Statement("maps: `crsm` draws them faster than `crsma`", "maps_crsm < maps_crsma"),
    Statement("maps and resolve: `coherence` takes less than `crsm` and `crsma` as published",
              "whole_coherence < whole_crsm_published and whole_coherence < whole_crsma_published",
              "48 of 48", why=COHERENCE_DRAWS),
    Statement("maps and resolve: `crsma` as published takes less than `crsm` as published",
              "whole_crsma_published < whole_crsm_published", "23 of 48", why=NEIGHBOURS_DRAWN),
]


def time_rows(timed: Cases) -> list[list[str]]:
    """Checks of Morais' tables of times, of what is timed over maps and pictures."""
    runs = timed[timed["picture"] != ""].set_index(["view", "picture", "map", "variant"])
    return check(beside(runs[["maps", "whole"]], "variant"), TIMES)


def less_time_rows(timed: Cases) -> list[list[str]]:
    """How often each takes less than `raytraced`, and less of its time with twice the map."""

    def count(cases: Cases, less: str, thesis: str = "") -> str:
        if cases.empty:
            return ""
        held = f"{cases.eval(less).sum()} of {len(cases)}"
        return f"{held} ({theses.LESS_TIME.at[variant, thesis]})" if published and thesis else held

    rows = []
    for variant, of in timed.groupby("variant", sort=False):
        if variant in ("nsm", "raytraced"):
            continue
        published = variant in theses.LESS_TIME.index
        cells, views = of[of["picture"] != ""], of[of["picture"] == ""]
        # Maps are not timed side by side: of each, its share of the time of the rays beside it.
        square = cells[cells["picture"] == "1024x1024"].set_index(["view", "map"])
        share = square.eval("share = resolve / resolve_of_rays")[["share"]]
        rows.append([
            f"`{variant}`",
            count(cells, "whole < whole_of_rays", "than rays"),
            count(cells, "resolve < resolve_of_rays"),
            count(views, "resolve < resolve_of_rays"),
            count(with_half_the_map(share).query("map >= 2048"), "share < share_at_half",
                  "with twice the map"),
        ])
    return rows


def outside_or_hinted(failing: Cases) -> str:
    """What is left by contours of 4: outside of them, or wrong hints."""
    outside, hints = failing["outside_4"].sum(), failing["wrong_hints_4"].sum()
    return (
        f"Of what is left in these {100 * outside / (outside + hints):.0f} % are outside of the"
        " contour: what is finer than texels and has no edge in the map; the rest are wrong hints")


OTHER_SOLIDS = (
    "Sizes and places of the solids are not in the thesis: ours cast shadows with shorter edges")
# Moderno. Of views and maps, side by side by width:
CHAIN_BY_WIDTH = [
    Statement("a wider contour: more pixels are left", "left_2 < left_4 < left_6", "24 of 24",
              "{left_2:.0f}, {left_4:.0f}, {left_6:.0f}",
              "Where edges are smooth, what four texels do not agree about lies within a texel of"
              " them, and all of it is in the narrower contours already"),
    Statement("a wider contour: a smaller share of it is left",
              "left_pc_2 > left_pc_4 > left_pc_6", "24 of 24",
              "{left_pc_2:.1f} %, {left_pc_4:.1f} %, {left_pc_6:.1f} %"),
    Statement("a wider contour: a larger share of it is hinted",
              "hinted_pc_TC4_2 < hinted_pc_TC4_4 < hinted_pc_TC4_6", "23 of 24",
              "{hinted_pc_TC4_2:.1f} %, {hinted_pc_TC4_4:.1f} %, {hinted_pc_TC4_6:.1f} %",
              "It hardly changes with the width there, as in the thesis' own exception, of the"
              " flowers as well: most of what is hinted in the narrowest contour lies where a petal"
              " ends in the picture or turns away from the light, about which texels agree; wider"
              " contours reach the edges of shadows"),
    Statement("a wider contour: no smaller share of the wrong pixels is in it",
              "caught_pc_2 <= caught_pc_4 <= caught_pc_6", "24 of 24",
              "{caught_pc_2:.1f} %, {caught_pc_4:.1f} %, {caught_pc_6:.1f} %"),
    Statement("a wider contour: a smaller share of it is wrong by its status",
              "status_pc_2 > status_pc_4 > status_pc_6", "24 of 24",
              "{status_pc_2:.1f} %, {status_pc_4:.1f} %, {status_pc_6:.1f} %"),
    Statement("a wider contour: no more wrong pixels in the picture",
              "wrong_TC4_2 >= wrong_TC4_4 >= wrong_TC4_6", "",
              "{wrong_TC4_2:.0f}, {wrong_TC4_4:.0f}, {wrong_TC4_6:.0f}"),
    Statement("contour of 4: at most a tenth of the map's wrong pixels is left, with those of"
              " wrong hints",
              "remaining <= 0.1", "", "{remaining:.2f}", outside_or_hinted),
    Statement("long edges (primitives, trees): contours of 4 and 6 pixels have 1.95 to 1.98 and"
              " 2.88 to 2.95 times the pixels of that of 2",
              "1.945 <= ratio_4 < 1.985 and 2.875 <= ratio_6 < 2.955", "12 of 12",
              "{ratio_4:.2f}, {ratio_6:.2f} of {contour_pc_2:.1f} %",
              "In brackets the ratios, and what the contour of 2 is of the picture, in the thesis"
              " 2.0 to 2.6 % (trees). Edges that lie closer together than the contours are wide"
              " share them: the shadows of single leaves, where the thesis has large triangles. Of"
              " the primitives, pixels that are turned away from the light are missing, which the"
              " thesis counts",
              "primitives|trees"),
    Statement("primitives: 0.05 to 0.45 % of the picture are the map's wrong pixels",
              "0.045 <= plain_pc_2 < 0.455", "6 of 6", "{plain_pc_2:.3f} %",
              OTHER_SOLIDS + ", along which fewer pixels are wrong", "primitives"),
]
# Of all cases:
CHAIN = [
    Statement("more pixels are left that are lit by their texel than in shadow",
              "left_L_TC4 > left_S_TC4", "72 of 72"),
    Statement("a larger share is left of those that are lit by their texel than of those in shadow",
              "left_L_pc > left_S_pc", "72 of 72"),
    Statement("hints of nine texels are no more than those of four, and no more of them are wrong",
              "hinted_TC9 <= hinted_TC4 and bad_hints_TC9 <= bad_hints_TC4", "72 of 72"),
    Statement("the whole chain, the rest lit: at most 0.61 of the wrong pixels that `nsm` has in"
              " the contour",
              "lit_of_caught <= 0.61", "72 of 72", "{lit_of_caught:.2f}"),
    Statement("one stage, the rest lit: nine texels leave no more wrong pixels than four, four no"
              " more than one", "error_N9 <= error_N4 <= error_ST", "72 of 72"),
    Statement("one stage, the rest lit: `vertices` leaves no more wrong pixels than `edges`,"
              " `edges` no more than its texel alone",
              "error_A2 <= error_A1 <= error_ST", "72 of 72"),
    Statement("one stage, the rest lit: `vertices` confirms more pixels than nine texels",
              "confirmed_A2 > confirmed_N9", "68 of 72", "{confirmed_A2:.0f}, {confirmed_N9:.0f}",
              "In brackets both. Nine texels see several of the leaves that shade a pixel, whose"
              " triangles do not touch; the thesis has its four exceptions in the trees, too"),
    Statement("one stage, the rest lit: nine texels leave fewer wrong pixels than `vertices`",
              "error_N9 < error_A2", "52 of 72", "{more_confirmed:.0f}, {more_corrected:.0f}",
              "In brackets by how much more `vertices` confirms than nine texels, and how much"
              " more these correct: what is wrong is what is neither. The thesis has 15 of its 18"
              " cases of the primitives and 5 of those of the flowers so"),
    Statement("primitives: the contour is 1 to 3.5 % of the picture", "0.95 <= contour_pc <= 3.5",
              "18 of 18", "{contour_pc:.2f} %", OTHER_SOLIDS, "primitives"),
]
# Of views, side by side by map and width:
CHAIN_BY_VIEW = [
    Statement("the contour of 4 pixels has nine tenths of the wrong pixels, where the map has"
              " twice the picture's size", "caught_pc_2048_4 >= 90", "12 of 12",
              "{caught_pc_2048_4:.1f} %, that of 6 {caught_pc_2048_6:.1f} %",
              "Leaves and petals are finer than texels there: of what the map has not seen it"
              " shows no edge. A wider contour reaches more of it, and fitted maps see more: their"
              " table above"),
    Statement("`nsm`: twice the map (2048 for 1024) leaves 0.49 to 0.61 of its wrong pixels",
              "0.485 <= ratio < 0.615", "12 of 12", "{ratio:.2f} of {plain_1024_2:.0f}",
              "A few long straight edges are all there is, and how wrong each is depends on where"
              " it falls in its texels"),
]
# Of views and widths, side by side by map:
CHAIN_BY_MAP = [
    Statement("twice the map: a larger share of the contour is hinted",
              "hinted_pc_TC4_2048 > hinted_pc_TC4_1024", "36 of 36"),
    Statement("twice the map: a smaller share of the contour is left",
              "left_pc_2048 < left_pc_1024", "36 of 36"),
]


def chain_rows(cases: Cases) -> list[list[str]]:
    """Checks of Moderno's tables of the chain and its stages."""
    by_width = beside(cases, "width").eval("""
        ratio_4 = N_4 / N_2
        ratio_6 = N_6 / N_2
        remaining = wrong_TC4_4 / plain_4
    """)
    alone = cases.eval("""
        more_confirmed = confirmed_A2 - confirmed_N9
        more_corrected = corrected_N9 - corrected_A2
    """)
    by_view = beside(cases, "map", "width").eval("ratio = plain_2048_2 / plain_1024_2")
    rows = check(by_width, CHAIN_BY_WIDTH) + check(alone, CHAIN)
    return rows + check(by_view, CHAIN_BY_VIEW) + check(beside(cases, "map"), CHAIN_BY_MAP)
