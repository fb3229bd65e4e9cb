"""The hand as boxes in the tool frame T, for what is checked before anything moves.

Sizes: those of the fingers and the palm that meet things in the simulated cell; a test compares them. The wrist
above the palm, round in the drawing, is a box around it.
"""

from typing import Final

from handeye.boxes import Box

FINGER_WIDTH: Final = 0.01905
"""m, across the finger line."""
FINGER_THICKNESS: Final = 0.01016
"""m, along the finger line."""
FINGER_LENGTH: Final = 0.0782
"""m, from the tip to the palm."""
PALM: Final[Box] = (-0.0381, -0.0635, -0.1055, 0.0381, 0.0635, -0.0815)
WRIST: Final[Box] = (-0.039, -0.050, -0.2540, 0.039, 0.050, -0.1055)


def hand_boxes(gap: float) -> tuple[Box, ...]:
    """Both fingers at an opening (m) between them, the palm and the wrist."""
    x, inner, outer = FINGER_WIDTH / 2, gap / 2, gap / 2 + FINGER_THICKNESS
    return (
        (-x, inner, -FINGER_LENGTH, x, outer, 0.0),
        (-x, -outer, -FINGER_LENGTH, x, -inner, 0.0),
        PALM,
        WRIST,
    )
