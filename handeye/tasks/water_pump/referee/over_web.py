"""Judges whether the hand stands over the web of the base, between its two large holes. An exercise of the course uses
this referee (docs/course.md).
"""

from math import acos, hypot
from typing import Final

from handeye.cell.truth import Truth
from handeye.core.pose import inverse
from handeye.core.units import INCH, MILLIMETRE
from handeye.judge.finding import Findings
from handeye.judge.measured import SettledState, deg, mm
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.stanford_cell.dimensions import web_centre

OVER_WEB: Final = hypot(INCH / 3, INCH / 4) / MILLIMETRE
"""Greatest horizontal distance (mm) of the hand from the middle of the web. In 1973, vision was accurate to 1/3 inch
along x and 1/4 inch along y; this limit is the distance if both errors occur together.
"""
ACROSS_WEB: Final = 3.0
"""Greatest angle (deg) between the finger line and the line between the large holes. We chose this limit. It covers
the errors of the arm and of the pictures: two pictures determine the direction of the base to .26 deg (root mean
square).
"""


def judge_over_web(truth: Truth) -> Findings:
    """Measure how far the hand is from the middle of the web, and how far its finger line is turned from the line
    between the holes.
    """
    measured = SettledState(truth)
    X_BW, hand = inverse(measured.pose("base")), measured.data.site(f"{ARM}tool")
    x, y, _ = X_BW[:3, :3] @ hand.xpos + X_BW[:3, 3]
    fingers = X_BW[:3, :3] @ hand.xmat.reshape(3, 3)[:, 1]  # direction of the finger line, the hand's y axis
    return {
        "over_web": mm(
            hypot(x - web_centre(), y), OVER_WEB, "horizontal distance of the hand from the middle of the web"
        ),
        "across_web": deg(
            acos(max(-1.0, min(1.0, fingers[0]))),
            ACROSS_WEB,
            "angle between the finger line and the line of the holes",
        ),
    }
