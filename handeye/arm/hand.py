"""A two-finger hand as data: mass, opening, and its boxes in the tool frame T.

The boxes serve checks before anything moves. Those of fingers and palm are the collision shapes of the simulated cell,
as a test verifies. The wrist above the palm, round in the drawing, is a box around it.
"""

from dataclasses import dataclass

from handeye.core.obb import Box


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspModel:
    """Parameters of opening and closing the fingers."""

    speed: float  # m/s of the opening, free
    centring: float  # m/s of the opening while centring
    settle: int  # servo periods pressed before the gap is read; half of them after centring


@dataclass(frozen=True, slots=True, kw_only=True)
class HandModel:
    """Two fingers that open and close together, and what carries them; lengths in m."""

    length: float  # wrist centre to finger tips
    mass: float  # of both fingers, kg; not included in the last link's `mass`
    centre: float  # wrist centre to the fingers' mass centre, along the approach direction
    gap_max: float
    gap_speed: float  # m/s, at most
    grip: float  # N, of each finger at most
    finger_width: float
    finger_thickness: float
    finger_length: float  # from tip to palm
    palm: Box
    wrist: Box
    grasp: GraspModel
    lamp: tuple[float, float, float] | None = None  # in T; shows the camera the hand

    def boxes(self, gap: float) -> tuple[Box, ...]:
        """Boxes of both fingers at an opening (m), the palm and the wrist."""
        x, inner, outer = self.finger_width / 2, gap / 2, gap / 2 + self.finger_thickness
        return (
            (-x, inner, -self.finger_length, x, outer, 0.0),
            (-x, -outer, -self.finger_length, x, -inner, 0.0),
            self.palm,
            self.wrist,
        )
