"""Draw the charts of docs/ (pages.py --charts)."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot, ticker, transforms  # noqa: E402

DOCS = Path(__file__).resolve().parents[3] / "docs"
PLAIN = "plain VTK"


def save(figure, name):
    figure.savefig(DOCS / name, dpi=90, bbox_inches="tight", metadata={"Software": None})
    pyplot.close(figure)


def set_ticks(axis, values):
    """Put plain numbers at these values of a logarithmic axis, and nothing between them."""
    axis.set_major_locator(ticker.FixedLocator(values))
    axis.set_major_formatter(
        ticker.EngFormatter(places=0, sep="") if values[-1] > 1e4
        else ticker.FormatStrFormatter("%g"))
    axis.set_minor_locator(ticker.NullLocator())


def label(axes, text, point, taken):
    """Write a text near a point where it covers no other text and no point, with a line to it."""
    renderer = axes.figure.canvas.get_renderer()
    places = [(6, 0, "left"), (-6, 0, "right")]
    places += [(0, up, "center") for up in (10, -10, 22, -22, 34, 46, 58)]
    for right, up, side in places:
        note = axes.annotate(
            text, point, xytext=(right, up), textcoords="offset points", fontsize=8, ha=side,
            va="center", arrowprops={"arrowstyle": "-", "color": "0.7"} if abs(up) > 10 else None)
        note.update_positions(renderer)
        box = matplotlib.text.Text.get_window_extent(note, renderer)
        if box.y0 > axes.bbox.y0 and not any(box.overlaps(other) for other in taken):
            break
        note.remove()
    taken.append(box)


def error_over_time(rows):
    """Wrong pixels over the time of a frame with a moving camera; a line joins the best."""
    figure, axes = pyplot.subplots(figsize=(7.5, 5))
    points = {
        row["variant"].split()[0]: (row["camera_moving_over_plain"], 100 * row["wrong_share"])
        for row in rows
    }
    times = [x for x, _ in points.values()]
    axes.set_xscale("log")
    axes.set_yscale("symlog", linthresh=0.01, linscale=0.3)
    axes.set_xlim(0.9 * min(times), 1.25 * max(times))  # room for names
    axes.set_ylim(-0.006, 2)
    best = [
        point for point in points.values()
        if not any(x <= point[0] and y <= point[1] and (x, y) != point for x, y in points.values())
    ]
    axes.plot(*zip(*points.values()), "o", color="0.6")
    axes.plot(*zip(*sorted(best)), "o-", color="tab:blue")
    radius = 5  # of a dot, in pixels
    taken = [
        transforms.Bbox([pixel - radius, pixel + radius])
        for pixel in axes.transData.transform(list(points.values()))
    ]
    for name, point in points.items():
        label(axes, name, point, taken)
    set_ticks(axes.xaxis, [x for x in (1, 1.5, 2, 3, 4, 6, 10) if x > 0.9 * min(times)])
    set_ticks(axes.yaxis, (0, 0.01, 0.03, 0.1, 0.3, 1))
    axes.set_xlabel("a frame with a moving camera, multiples of plain VTK's")
    axes.set_ylabel("wrong pixels, %")
    axes.grid(color="0.9")
    axes.set_axisbelow(True)
    save(figure, "figures/chart.png")


def growth(curves):
    """The time of a frame over each axis."""
    figure, all_axes = pyplot.subplots(1, len(curves), figsize=(3 * len(curves), 3.2))
    for axes, (name, contenders) in zip(all_axes, curves.items()):
        for contender, points in contenders.items():
            axes.loglog(*zip(*points), marker="o", markersize=3, label=contender)
        axes.set_title(name)
        axes.grid(color="0.9")
        axes.yaxis.set_minor_locator(ticker.NullLocator())
        set_ticks(axes.yaxis, (10, 20, 50, 100, 200, 500, 1000))
        set_ticks(axes.xaxis, [x for x, _ in points])
        axes.tick_params(labelsize=7)
    all_axes[0].set_ylabel("a frame, ms")
    all_axes[0].legend(fontsize=7)
    save(figure, "results/growth.png")


def hard_cases(rows):
    """The matrix: green is kept, red broken, grey refused, light grey has no part."""
    colours = {"kept": "#5aa864", "broken": "#d03b3b", "refused": "#c9c9c9", "none": "#f0f0f0"}
    cases = list(dict.fromkeys(row["case"] for row in rows))
    techniques = list(dict.fromkeys(row["technique"] for row in rows))
    figure, axes = pyplot.subplots(figsize=(0.26 * len(techniques), 0.2 * len(cases)))
    for row in rows:
        place = (techniques.index(row["technique"]), cases.index(row["case"]))
        axes.add_patch(pyplot.Rectangle(place, 0.9, 0.88, facecolor=colours[row["outcome"]]))
    axes.set_xlim(0, len(techniques))
    axes.set_ylim(len(cases), 0)
    axes.set_xticks([x + 0.46 for x in range(len(techniques))], techniques, fontsize=8,
                    rotation=50, ha="left", rotation_mode="anchor")
    axes.set_yticks([y + 0.46 for y in range(len(cases))], cases, fontsize=8)
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
    save(figure, "results/hard_cases.png")


def draw(table, curves):
    rows = [
        row for row in table("comparisons")
        if row["experiment"] == "bunny" and row["shadows"] == "hard" and row["variant"] != PLAIN
    ]
    error_over_time(rows)
    growth(curves)
    hard_cases(table("hard_cases"))
