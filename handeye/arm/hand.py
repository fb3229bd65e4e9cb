"""A two-finger hand as data: what it weighs, how wide it opens, and the boxes it is made of.

The boxes are in the tool frame T, for what is checked before anything moves. They are those of the fingers and the
palm that meet things in the simulated cell; a test compares them. The wrist above the palm, round in the drawing, is
a box around it.
"""

from dataclasses import dataclass

from handeye.core.obb import Box


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspModel:
    """Figures of opening and closing the fingers."""

    speed: float
    """Rate of the opening when nothing is between the fingers, m/s."""
    centring: float
    """The same while an object is centred, m/s."""
    settle: int
    """Servo periods the fingers press before the gap is read; half of them after centring."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HandModel:
    """Two fingers that open and close together, and what carries them."""

    length: float
    """From the wrist centre to the finger tips, m."""
    mass: float
    """Of both fingers, kg; a part of the last link that its `mass` does not include."""
    centre: float
    """From the wrist centre to the fingers' mass centre along the approach direction, m."""
    gap_max: float
    """Greatest opening of the fingers, m."""
    gap_speed: float
    """Greatest rate of the opening, m/s."""
    grip: float
    """Greatest force of each finger, N."""
    finger_width: float
    """Across the finger line, m."""
    finger_thickness: float
    """Along the finger line, m."""
    finger_length: float
    """From the tip to the palm, m."""
    palm: Box
    wrist: Box
    grasp: GraspModel
    lamp: tuple[float, float, float] | None = None
    """Where the lamp is that shows the camera the hand, in T, m."""

    def boxes(self, gap: float) -> tuple[Box, ...]:
        """Both fingers at an opening (m) between them, the palm and the wrist."""
        x, inner, outer = self.finger_width / 2, gap / 2, gap / 2 + self.finger_thickness
        return (
            (-x, inner, -self.finger_length, x, outer, 0.0),
            (-x, -outer, -self.finger_length, x, -inner, 0.0),
            self.palm,
            self.wrist,
        )
