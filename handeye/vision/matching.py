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
from handeye.core.pose import Array
from handeye.core.units import INCH
from handeye.ports.camera import COLUMNS, ROWS, Picture
from handeye.program.diagnosis.causes import DarkPart, FaintPicture, OutsidePicture, PartAstray
from handeye.program.program import Part
from handeye.vision.alignment import Points, moved, shift, smooth
from handeye.vision.base import Failure, PartMatch, silhouettes
from handeye.vision.camera_model import View, in_picture
from handeye.vision.hole_search import hole_places

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
the limit `DIFFERENT` at a contrast of at most 2.95 levels. `FAINT` is larger than 2.95, to leave a margin for the
noise. Percentiles nearer the median depend on the direction of the lamp more than on how well a head can be seen: from
the 10th to the 90th percentile, the contrast is .8 to 1.5 times the difference that a missing head gives.
"""
DARK: Final = 7.6
"""Least brightness (levels) of the part in the earlier picture: the median of the levels near the screw holes. If the
part has no screw holes, the median is taken on the whole part.

In the shadow of the arm, only the light of the room falls on the part. There, a missing head gives .21 to .34 times
the brightness beside it (a finished pump in the shadow of the arm's column, 33 directions and strengths of the lamp).
So every missing head reaches the limit `DIFFERENT` at a brightness of 7.6, and most missing heads give a difference of
1.9 levels there. The noise hides one in twenty of the heads that give 1.9 levels. Where the lamp shines on the pump,
its face has 10 to 12 levels. The contrast cannot show a shadow: the edge of the shadow raises the contrast.

The sides of the part must not count: if the lamp is low behind the part, most of the silhouette is dark although the
lamp shines on the heads. If the shadow of the column hides three heads or more, the median is too low (99 % of the
pictures, with errors of the calibrated view of up to 16 points). If it hides two heads, the median is too low in 85 %
of the pictures, and if it hides one head, in 35 %. The crank hides one or two heads, too.
"""
NEAR: Final = 15
"""Radius (points) of the disc around a screw hole that counts as near the hole. The head of a screw is 8 points above
its hole, and the calibrated view may be wrong by as much.
"""
BESIDE: Final = 12
"""Width (points) of a strip around the part. The strip counts neither as part nor as surroundings.

The strip allows for the shadow of the part. It also allows for an outline that is slightly displaced, because the
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
    levels = smooth(before)
    low, high = np.percentile(levels[its], (2, 98))
    if (contrast := float(high - low)) < FAINT:  # a faint second picture differs from the first
        return Failure(cause=FaintPicture(contrast=round(contrast, 2), least=FAINT))
    heads = _near(view.project(hole_places(part, pose, screws=True))) if part.screw_holes else its
    if (brightness := float(np.median(levels[heads]))) < DARK:
        return Failure(cause=DarkPart(brightness=round(brightness, 2), least=DARK))
    background = shift(before, after, around)
    own = shift(before, after, its)
    z = part.at[2] + part.face
    there = view.project(np.array([[x, y, z]]))[0]
    first, second = view.back_project(np.array([there, there + (own - background)]), z)
    off = float(np.hypot(*(second - first)[:2]))  # on the plane of the face
    difference = cv2.blur(np.abs(moved(smooth(after), -own) - levels), (SPOT, SPOT))
    unlike = float((difference[its] > DIFFERENT).mean())
    wrong = off > MOVED or unlike > 0
    return PartMatch(
        cause=PartAstray(off=round(off, 6), unlike=round(unlike, 6)) if wrong else None,
        outline=tuple((float(u), float(v)) for u, v in hull + background),
        shift=off,
        unlike=unlike,
    )


def _near(holes: Array) -> Points:
    """Return a mask of the points near holes. `holes` are the centres of the holes in picture points, shape (n, 2)."""
    drawn = np.zeros((ROWS, COLUMNS), np.uint8)
    for u, v in np.rint(holes).astype(int).tolist():
        cv2.circle(drawn, (u, v), NEAR, 1, -1)
    return drawn > 0
