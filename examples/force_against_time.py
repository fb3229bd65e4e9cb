"""Plot the force of a guarded motion against time, with the limit dashed and the trip as a dot, into force.svg.

    python force_against_time.py [RUN LINE]

RUN is the folder of a run, and LINE a line of its script with a motion that a force stops. The plot shows the last
motion of this line. Without arguments, the program makes a short run, in which the hand feels for the table.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

import handeye

WIDE, HIGH, LEFT, TOP = 640, 300, 50, 40  # size of the plot, and its corner, in points


def chart(times: np.ndarray, force: np.ndarray, limit: float, title: str) -> str:
    """The drawing, as SVG; times in s, forces in N."""
    most, least = 1.15 * max(limit, force.max()), min(0.0, 1.15 * force.min())
    x = LEFT + (times - times[0]) / np.ptp(times) * WIDE
    y, level = (TOP + (most - newtons) / (most - least) * HIGH for newtons in (force, limit))
    drawn = [f'<rect width="100%" height="100%" fill="white"/><text x="{LEFT}" y="22">{title}</text>']
    for newtons in np.arange(2 * np.ceil(least / 2), most, 2):
        at = TOP + (most - newtons) / (most - least) * HIGH
        drawn.append(f'<path d="M{LEFT} {at:.1f}h{WIDE}" stroke="#ddd"/>')
        drawn.append(f'<text x="{LEFT - 8}" y="{at + 4:.1f}" text-anchor="end">{newtons:.0f} N</text>')
    for second in np.arange(np.ceil(2 * times[0]) / 2, times[-1], 0.5):
        at = np.interp(second, times, x)
        drawn.append(f'<text x="{at:.1f}" y="{TOP + HIGH + 20}" text-anchor="middle">{second:.1f} s</text>')
    points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True))
    drawn.append(f'<polyline points="{points}" fill="none" stroke="#1f5fa8" stroke-width="2"/>')
    drawn.append(f'<path d="M{LEFT} {level:.1f}h{WIDE}" stroke="#b22" stroke-dasharray="7 5"/>')
    for a, b in zip(x[force > limit], y[force > limit], strict=True):
        drawn.append(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="5" fill="#b22"/>')
    size = f'width="{LEFT + WIDE + 20}" height="{TOP + HIGH + 35}" font-family="sans-serif" font-size="12"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size}>{"".join(drawn)}</svg>\n'


with tempfile.TemporaryDirectory() as folder:
    run, line = sys.argv[1:] or (f"{folder}/run", "7")
    if not sys.argv[1:]:
        handeye.assemble(script=Path(__file__).with_name("feel_for_the_table.al"), camera="ray", out=run)
    trace = handeye.open(run)
felt = trace.forces(line).motions()[-1]
title = f"line {line}: the hand presses until it feels more than {felt.limit[-1]:.1f} N"
Path("force.svg").write_text(chart(felt.times, felt.value, felt.limit[-1], title))
