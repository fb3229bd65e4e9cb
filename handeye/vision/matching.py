"""Decides whether a part has the same place in a picture as in an earlier picture.

Nothing is assumed about the appearance of the part: the earlier picture is the model. A vidicon displaces each picture
slightly. Therefore the position of the part is compared with the position of its surroundings in the same picture. The
comparison measures how far the part has shifted relative to its surroundings, in fractions of a point. Any other
difference appears as changed points. This comparison is our addition to the vision of 1973.
"""

from typing import Final

import cv2
import numpy as np

from handeye.core.errors import BadArgument
from handeye.core.units import INCH
from handeye.ports.camera import COLUMNS, ROWS, Picture
from handeye.program.diagnosis.causes import DarkPart, FaintPicture, OutsidePicture, PartAstray
from handeye.program.program import Part
from handeye.vision.alignment import moved, shift, smooth
from handeye.vision.base import Failure, PartMatch, silhouettes
from handeye.vision.camera_model import View, in_picture

MOVED: Final = 0.03 * INCH
"""Largest apparent movement (m) of a part; up to this value, the part counts as unmoved.

From one picture to the next, a pump at rest seems to move by .02 to .07 mm. A pump that is pushed against its blocks
moves by .13 to .16 mm (worlds of seeds 3 and 15 at the nominal level). The limit must be below .05 in, because a base
that is .05 in away from its place is wrong (reference test 59).
"""
SPOT: Final = 5  # side of a square, points: a screw head is about as large
DIFFERENT: Final = 1.6
"""Mean difference in a square, in levels of the smoothed pictures, above which the centre of the square counts as
changed.

The noise of two pictures gives a mean of .3 (median of 17,500 squares). For each pair of pictures of a pump that is at
rest, or was pushed by up to .15 mm, we took the greatest mean of all squares. The median of these values is .88. The
largest value was 1.06 in 90 pairs (seed 15, OpenGL), and 1.08 in 36 pairs by ray casting. Such values have a Gumbel
distribution, here of location .86 and scale .05, so the limit is reached once in a million pairs. A screw whose head
is missing gives 3.7 to 5.6. A screw that stands 2.5 mm high gives .8 to 2.0, so most such screws are missed; a screw
behind the crank is not visible at all.
"""
FAINT: Final = 3.4
"""Least contrast (levels) that the part must have in the earlier picture: the difference between the 2nd and the 98th
percentile of the picture's levels.

Limits in levels mean something only in pictures of about the usual contrast. On a finished pump that the lamp lights,
the contrast is 5.8 to 10.2 levels, which is 1.4 to 1.84 times the mean difference that a missing head gives (13
directions and strengths of the lamp, five heads; heads in the shadow of the crank left out). So a missing head reaches
the limit `DIFFERENT` at a contrast of at most 2.95 levels. The limit is larger, to leave a margin for the noise.
Percentiles nearer the median depend on the direction of the lamp more than on how well a head can be seen: from the
10th to the 90th percentile, the contrast is .8 to 1.5 times the difference that a missing head gives.
"""
DARK: Final = 6.7
"""Least brightness (levels) of the part in the earlier picture: the median of the picture's levels on the part.

In the shadow of the arm, only the light of the room falls on the part. There, a missing head gives at least .27 times
the median (five directions and strengths of the lamp), and so reaches the limit `DIFFERENT` at a median of at most
5.9. The limit is larger, to leave a margin for the noise. On a finished pump that the lamp lights, the median is 9.1
to 11.1 levels (161 directions and strengths of the lamp). The contrast cannot show a shadow: the edge of the shadow
raises the contrast.
"""
BESIDE: Final = 12
"""Width (points) of a strip around the part. The strip counts neither as part nor as surroundings.

The strip contains the part's shadow. It also allows for an outline that is slightly displaced, because the
potentiometers of the mount do not give the exact aim.
"""


def match(
    before: Picture, after: Picture, view: View, part: Part, pose: tuple[float, float, float]
) -> PartMatch | Failure:
    """Compare two pictures of a part at `pose` (x, y in m, yaw in rad).

    Both pictures must be taken with the same aim, target voltage and arm position. The part must have an outline.
    """
    if part.outline is None:
        raise BadArgument("to compare pictures of a part, vision needs its outline; the program gives none")
    x, y, yaw = pose
    (corners,) = silhouettes(view, part, (x, y), np.array([yaw - part.at[3]]))
    hull = cv2.convexHull(corners.astype(np.float32))[:, 0]
    if not in_picture(hull):
        return Failure(cause=OutsidePicture())
    drawn = np.zeros((ROWS, COLUMNS), np.uint8)
    cv2.fillConvexPoly(drawn, np.rint(hull).astype(np.int32), 1)
    wide = cv2.dilate(drawn, np.ones((2 * BESIDE + 1, 2 * BESIDE + 1), np.uint8))
    its, around = drawn > 0, wide == 0
    low, middle, high = np.percentile(smooth(before)[its], (2, 50, 98))
    if (contrast := float(high - low)) < FAINT:  # a faint second picture differs from the first
        return Failure(cause=FaintPicture(contrast=round(contrast, 2), least=FAINT))
    if (brightness := float(middle)) < DARK:
        return Failure(cause=DarkPart(brightness=round(brightness, 2), least=DARK))
    background = shift(before, after, around)
    own = shift(before, after, its)
    z = part.at[2] + part.face
    there = view.project(np.array([[x, y, z]]))[0]
    first, second = view.back_project(np.array([there, there + (own - background)]), z)
    off = float(np.hypot(*(second - first)[:2]))  # on the plane of the face
    difference = cv2.blur(np.abs(moved(smooth(after), -own) - smooth(before)), (SPOT, SPOT))
    unlike = float((difference[its] > DIFFERENT).mean())
    wrong = off > MOVED or unlike > 0
    return PartMatch(
        cause=PartAstray(off=round(off, 6), unlike=round(unlike, 6)) if wrong else None,
        outline=tuple((float(u), float(v)) for u, v in hull + background),
        shift=off,
        unlike=unlike,
    )
