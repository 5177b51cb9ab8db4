"""The publications' conclusions, and which of them docs/results/conclusions.csv bears out."""

import csv
import math
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass

PCF = "pcf kernel=box kernel_size={0}"
DISC = "adaptive disc_grid={0} early_out=ring kernel_size={0}"
VSM, EUCLIDEAN = "vsm kernel_size=23", PCF.format(11) + " metric=euclidean"
CRSM, CRSMA = "crsm as_published=on", "crsma as_published=on"
CHAIN, UNHINTED = "selective fit=once", "selective coherence=off fit=once"
ALONE = "selective adjacency={} coherence=off fit=once leftovers=lit neighbours={}"
NINE, FOUR, ONE = (ALONE.format("off", texels) for texels in (9, 4, 1))
EDGES, VERTICES = (ALONE.format(ring, "off") for ring in ("edges", "vertices"))

NEAR, HIERARCHICAL, HIERARCHICAL_4 = (
    f"montecarlo mc_layers={of}"
    for of in (
        "near",
        "near_far",
        "near_far mc_rays=2",
    )
)
LINEAR, LINEAR_4 = (
    f"montecarlo mc_layers=eye{of} mc_search=linear" for of in ("", " mc_rays=2")
)


class Cases:
    """The rows of a run, by scene and map; variants without a map are in all of a scene's."""

    def __init__(self, rows):
        self.cases = defaultdict(dict)
        for row in rows:
            self.cases[row["scene"], row["map_size"]][row["variant"]] = {
                name: float(value or 0)
                for name, value in row.items()
                if name not in ("run", "scene", "map_size", "variant")
            }
        for scene in {scene for scene, _ in self.cases}:
            without = self.cases.pop((scene, ""), {})
            sizes = [case for case in self.cases if case[0] == scene]
            for case in sizes or [(scene, "")]:
                self.cases[case] |= without

    def each(self, value):
        """The value of each case, which is of a function of a variant and a column."""
        return [
            value(lambda variant, column, case=case: case[variant][column])
            for case in self.cases.values()
        ]

    def ratio(self, column, variant, over):
        return self.each(lambda at: at(variant, column) / at(over, column))

    def wrong_in_contour(self, variant, over):
        """The ratio of wrong pixels in the contour; the chain without hints has none there."""
        return self.each(lambda at: (at(variant, "wrong") - at(UNHINTED, "wrong"))
                         / (at(over, "wrong") - at(UNHINTED, "wrong")))

    def with_twice_the_map(self, value):
        """The value with the larger map over that with the smaller one."""
        values = defaultdict(dict)
        for (scene, size), case in self.cases.items():
            values[scene][int(size)] = value(
                lambda variant, column, case=case: case[variant][column])
        return [of[max(of)] / of[min(of)] for of in values.values()]


@dataclass(frozen=True)
class Conclusion:
    text: str
    source: str
    there: str
    run: str
    values: Callable[[Cases], list[float]]
    least: float = -math.inf
    most: float = math.inf
    percent: bool = False
    on_mean: bool = False
    why: str = ""

    def number(self, value):
        return f"{100 * value:.3g}" if self.percent else f"{value:.2f}".rstrip("0").rstrip(".")

    def row(self, runs):
        """Return the cells: text, source, figure there, figure here, verdict."""
        if not self.values:
            return [self.text, self.source, self.there, "", f"not measured: {self.why}"]
        values = self.values(runs[self.run])
        mean = sum(values) / len(values)
        judged = [mean] if self.on_mean else values
        held = sum(self.least <= value <= self.most for value in judged)
        verdict = "holds" if held == len(judged) else "holds not"
        if 0 < held < len(judged):
            verdict += f" in {held} of {len(judged)}"
        if held < len(judged) and self.why:
            verdict += f": {self.why}"
        span = f" ({self.number(min(values))}–{self.number(max(values))})"
        here = self.number(mean) + (span if len(values) > 1 else "")
        return [self.text, self.source, self.there, here + " %" * self.percent, verdict]


CONCLUSIONS = [
    Conclusion(
        "`nsm`: a map of twice the size has fewer wrong pixels", "Morais, tables 9 to 12, 36 to 58",
        "0.59 (0.47 to 0.72)", "hybrid",
        lambda of: of.with_twice_the_map(lambda at: at("nsm", "wrong")), most=1),
    Conclusion(
        "`coherence` (PCF) traces fewer pixels than CRSMA", "Morais, tables 14, 15, 59 to 66",
        "0.55 (0.48 to 0.65)", "hybrid", lambda of: of.ratio("traced", "coherence", CRSMA), most=1),
    Conclusion(
        "... and is wrong in some", "Morais, 5.5", "0.03 to 1.72 %", "hybrid",
        lambda of: of.each(lambda at: at("coherence", "wrong") / at("coherence", "facing")),
        least=1e-6, percent=True),
    Conclusion(
        "CRSM and CRSMA are wrong in up to 1 %", "Morais, 5.5", "0 to 0.27 %", "hybrid",
        lambda of: of.each(
            lambda at: max(at(CRSM, "wrong"), at(CRSMA, "wrong")) / at(CRSM, "facing")),
        most=0.01, percent=True,
        why="the published maps leave out faces that open sheets have alone, as leaves and cloth"),
    Conclusion(
        "`crsm` and `crsma`, as corrected here, have no wrong pixel",
        "[exact](../techniques/exact.md)", "", "hybrid",
        lambda of: of.each(lambda at: at("crsm", "wrong") + at("crsma", "wrong")), most=0),
    Conclusion(
        "CRSMA traces fewer pixels than CRSM", "Morais, tables 14, 15, 59 to 66",
        "0.70 (0.58 to 0.96)", "hybrid", lambda of: of.ratio("traced", CRSMA, CRSM), most=1),
    Conclusion(
        "`coherence` takes less time than full ray tracing, maps included", "Morais, 6.9",
        "0.66 (0.48 to 0.77)", "times", lambda of: of.each(
            lambda at: (at("coherence", "maps_ms") + at("coherence", "resolve_ms"))
            / at("raytraced", "resolve_ms")), most=1, on_mean=True,
        why="deciding by four texels on the CPU takes longer than Embree takes for all rays"),
    Conclusion(
        "CRSMA's maps take more time than they save", "Morais, 6.9", "1.36 (0.90 to 1.99)", "times",
        lambda of: of.each(
            lambda at: (at(CRSMA, "maps_ms") + at(CRSMA, "resolve_ms"))
            / at("raytraced", "resolve_ms")), least=1, on_mean=True),
    Conclusion(
        "a contour has 90 % of the map's wrong pixels", "Moderno, table 5", "95 % (82 to 100 %)",
        "chain", lambda of: of.each(
            lambda at: 1 - at(UNHINTED, "wrong") / at("nsm fit=once", "wrong")),
        least=0.9, percent=True, on_mean=True),
    Conclusion(
        "few pixels of the contour are hinted wrongly (TC)", "Moderno, table 14",
        "0.33 % (0 to 1.59 %)",
        "chain", lambda of: of.each(
            lambda at: (at(CHAIN, "wrong") - at(UNHINTED, "wrong")) / at(CHAIN, "contour")),
        most=0.0159, percent=True),
    Conclusion(
        "the chain TC, N9, A2 leaves a quarter of the contour to rays", "Moderno, 3.6",
        "23 % (5 to 50 %)", "chain",
        lambda of: of.each(lambda at: at(CHAIN, "left") / at(CHAIN, "contour")),
        most=0.25, percent=True, on_mean=True),
    Conclusion(
        "N9 is wrong in fewer pixels than N4, N4 than ST", "Moderno, tables 9, 10", "0.83, 0.53",
        "chain",
        lambda of: of.wrong_in_contour(NINE, FOUR) + of.wrong_in_contour(FOUR, ONE), most=1),
    Conclusion(
        "A2 is wrong in fewer pixels than A1, A1 than ST", "Moderno, tables 9, 11", "0.81, 0.74",
        "chain",
        lambda of: of.wrong_in_contour(VERTICES, EDGES) + of.wrong_in_contour(EDGES, ONE), most=1),
    Conclusion(
        "the hardware's filter of 2 x 2 texels costs nothing", "Rzeczkowski, 4.3.2",
        "0.99 to 1.03", "filters", lambda of: of.ratio("frame_ms", "pcf kernel_size=1", "nsm"),
        most=1.05, on_mean=True,
        why="comparing with each texel's own plane leaves no fetch to the hardware"),
    Conclusion(
        "adaptive PCF of 3 x 3 points takes less time than a box of as many", "Rzeczkowski, 4.3.2",
        "0.49 to 0.87", "filters",
        lambda of: of.ratio("frame_ms", DISC.format(3), PCF.format(3)), most=1, on_mean=True,
        why="of few points, reading the disc from its table outweighs the early out"),
    Conclusion(
        "adaptive PCF of 11 x 11 points takes less time than a box of as many",
        "Rzeczkowski, 4.3.2", "0.06 to 0.20", "filters",
        lambda of: of.ratio("frame_ms", DISC.format(11), PCF.format(11)), most=1, on_mean=True),
    Conclusion(
        "`vsm` is the fastest wide filter", "Rzeczkowski, 4.4", "a plot", "filters",
        lambda of: of.each(lambda at: at(VSM, "frame_ms") / min(
            at(PCF.format(11), "frame_ms"), at(DISC.format(11), "frame_ms"))), most=1,
        on_mean=True),
    Conclusion(
        "`pcss` takes about twice the time of adaptive PCF", "Rzeczkowski, 4.4", "2", "soft",
        lambda of: of.ratio("frame_ms", "pcss", DISC.format(11)), least=1.5, most=2.5,
        on_mean=True, why="`pcss` here filters casters at two depths apart from each other"),
    Conclusion(
        "`pcss` shows soft shadows best: error, over the best of box, adaptive PCF and `vsm`",
        "Rzeczkowski, 4.4", "by eye", "soft", lambda of: of.each(lambda at: at("pcss", "rms") / min(
            at(other, "rms") for other in (PCF.format(11), DISC.format(11), VSM))), most=1),
    Conclusion(
        "SampledAreaLight of 512 points takes more time than AreaLight (PCSS)", "Moschig, 5.1",
        "69", "soft", lambda of: of.ratio(
            "frame_ms", "sampled light_samples=512", "pcss pcss_samples=high"), least=1,
        on_mean=True),
    Conclusion(
        "... and has a smaller error", "Moschig, 5.2.2", "by eye", "soft", lambda of: of.ratio(
            "rms", "sampled light_samples=512", "pcss pcss_samples=high"), most=1),
    Conclusion(
        "16 Poisson points have a smaller error than a uniform grid", "Moschig, 5.2.4", "by eye",
        "filters",
        lambda of: of.ratio("rms", "pcf kernel=poisson kernel_size=4", PCF.format(4)), most=1),
    Conclusion(
        "16 Poisson points take less time than a uniform grid of as many", "Moschig, table 5.1",
        "0.60 to 0.63", "filters",
        lambda of: of.ratio("frame_ms", "pcf kernel=poisson kernel_size=4", PCF.format(4)), most=1,
        on_mean=True,
        why="there fewer of Poisson's are compared"),
    Conclusion(
        "8 samples a pass take less time than 1", "Moschig, 5.2.5", "a plot", "soft",
        lambda of: of.ratio("frame_ms", "sampled batch=8", "sampled batch=1"), most=1,
        on_mean=True),
    Conclusion(
        "a map of second depths takes less time", "Moschig, 5.1", "0.77 (frame)", "fitting",
        lambda of: of.ratio("maps_ms", "the same, second depths", "map of 1024"), most=1,
        on_mean=True),
    Conclusion(
        "distances need less bias than depths: false shadow without any", "Moschig, 5.2.8",
        "a plot", "metric",
        lambda of: of.ratio("false_shadow", EUCLIDEAN, PCF.format(11)), most=0.9,
        why="neither needs a bias, as the receiver's plane is followed to each texel"),
    Conclusion(
        "a reduction takes less time on the GPU than on the CPU", "Moschig, 5.2.6", "0.07",
        "fitting", lambda of: of.ratio("maps_ms", "fit of a sun", "its bounds on the CPU"), most=1,
        on_mean=True,
        why="OpenGL is software here, so that both run on the CPU"),
    Conclusion(
        "hierarchical search takes less time than linear", "Curtis, tables 4.1 to 4.4",
        "0.51 (0.32 to 0.66)", "montecarlo", lambda of: of.ratio(
            "frame_ms", HIERARCHICAL, LINEAR) + of.ratio(
            "frame_ms", HIERARCHICAL_4, LINEAR_4), most=1, on_mean=True),
    Conclusion(
        "9 rays take less than 9/4 of the time of 4, hierarchical", "Curtis, tables 4.1 to 4.4",
        "1.19 (1.11 to 1.33)", "montecarlo", lambda of: of.ratio(
            "frame_ms", HIERARCHICAL, HIERARCHICAL_4), most=2.25, on_mean=True),
    Conclusion(
        "a larger map slows hierarchical search more than linear", "Curtis, tables 4.1, 4.2",
        "1.30 (1.13 to 1.47)", "montecarlo",
        lambda of: of.with_twice_the_map(lambda at: at(HIERARCHICAL, "frame_ms")
                                         / at(LINEAR, "frame_ms")), least=1, on_mean=True),
    Conclusion(
        "more layers than two gain less than the second one: factor of errors over the second's",
        "Curtis, 5", "by eye", "montecarlo", lambda of: of.each(
            lambda at: at("montecarlo", "mean_error") * at(NEAR, "mean_error")
            / at(HIERARCHICAL, "mean_error") ** 2), least=1,
        why="four layers here hold single casters, two hold all between the first and the last"),
    Conclusion(
        "16 of MD5's 64 steps are random enough: tests that fail, of 4 here", "Curtis, 3.1",
        "4 of 15 (64 steps: 3)", "md5", lambda of: of.each(
            lambda at: at("ReducedMd5", "wrong")), most=0),
    Conclusion(
        "the hash takes less than a tenth of a frame", "Curtis, 4.3", "0 to 10 %", "", None,
        why="no setting takes it out"),
]


def rows(table):
    """Return the cells of each conclusion."""
    runs = defaultdict(list)
    with open(table, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            runs[row["run"]].append(row)
    cases = {run: Cases(of) for run, of in runs.items()}
    return [each.row(cases) for each in CONCLUSIONS]
