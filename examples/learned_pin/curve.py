"""Draws the learning curve, curve.csv, as docs/pictures/learned_pin.svg. It needs the extra `plot`.

$ python -m examples.learned_pin.curve
"""

import csv
from pathlib import Path
from typing import Final

import matplotlib
from matplotlib.figure import Figure

from handeye.trials.figures import rate

CURVE: Final = Path(__file__).with_name("curve.csv")
PICTURE: Final = Path(__file__).parents[2] / "docs" / "pictures" / "learned_pin.svg"
STYLE: Final = {
    "svg.hashsalt": "handeye", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 10,
    "axes.spines.top": False, "axes.spines.right": False,
}  # fmt: skip
BLUE, RED, GREY = "#1f5fa8", "#c0392b", "#888888"


def drawn(rows: list[dict[str, str]]) -> Figure:
    """Return the drawing of the rows of curve.csv."""
    figure = Figure(figsize=(6.4, 3.4), layout="constrained")
    axes = figure.add_subplot()
    learned = rows[1:]  # in round 0, the teacher acts
    spent = [int(row["cpu_s"]) for row in learned]
    for row, at in zip(learned, spent, strict=True):
        found = rate(int(row["right"]), int(row["worlds"]))
        axes.plot(
            [at] * 2, [100 * share for share in found.wilson95 or ()], color=BLUE, alpha=0.3, linewidth=5
        )
        axes.annotate(
            f"round {row['round']}", (at, 100), (0, 8), textcoords="offset points", ha="center", color=GREY
        )
    for name, label, colour in (("right", "right", BLUE), ("false_done", "false done", RED)):
        shares = [100 * int(row[name]) / int(row["worlds"]) for row in learned]
        axes.plot(spent, shares, marker="o", color=colour)
        axes.annotate(
            label, (spent[-1], shares[-1]), (8, 0), textcoords="offset points", va="center", color=colour
        )
    axes.set(ylim=(-4, 112), xlim=(-15, spent[-1] * 1.15), yticks=range(0, 101, 20))
    axes.set_xlabel("processor time of the training so far, s")
    axes.set_ylabel("episodes in new worlds, %")
    return figure


if __name__ == "__main__":
    with CURVE.open(encoding="utf-8", newline="") as file, matplotlib.rc_context(STYLE):
        drawn(list(csv.DictReader(file))).savefig(PICTURE, metadata={"Date": None})
    print(f"wrote {PICTURE.name}")
