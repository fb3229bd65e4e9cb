"""Defines the event with which the program of the rail support reports a screw."""

from typing import Final, Literal

from handeye.core.units import MILLIMETRE, Measures
from handeye.program.events import SystemEvent
from handeye.systems.ml.machine.spec import LINEAR, TORQUE_COUNT

Found = Literal["seated", "crossed", "lost", "not taken", "loose", "beside", "tightened"]
FOUND: Final[dict[int, Found]] = {
    70: "seated",
    71: "crossed",
    72: "lost",
    73: "not taken",
    74: "loose",
    75: "beside",
    76: "tightened",
}
"""What the program has found about a screw, by the code that it prints before the number of the screw."""
_ENDS: Final[dict[Found, str]] = {
    "seated": "is seated",
    "crossed": "is crossed or jammed: the screw stopped the screwdriver too early, so the program turns the screw out",
    "lost": "is no longer on the bit",
    "not taken": "turns, but no thread takes it",
    "loose": "is deep, but not tight yet",
    "beside": "is next to its hole",
    "tightened": "is tightened again",
}


class ScrewReported(SystemEvent, frozen=True, kw_only=True):
    """The program has judged a screw by the height of the bit, and by the torque of the screwdriver."""

    screw: int
    found: Found
    deeper: float
    """How far (m) the bit is below its height on a seated screw. For a screw that is `lost` or `beside`: how far the
    bit is below its height on a screw in the mouth of its thread.
    """
    torque: float  # N m; 0 if the clutch has not slipped

    def sentence(self, measures: Measures) -> str:
        way = "deeper" if self.deeper > 0 else "higher"
        where = "the mouth of its thread" if self.found in ("lost", "beside") else "its seat"
        torque = f", and the torque is {self.torque:.3f} N m" if self.torque else ""
        off = f"{abs(self.deeper) / MILLIMETRE:.2f} mm {way}"
        return f"screw {self.screw} {_ENDS[self.found]}; the bit is {off} than on a screw at {where}{torque}"


def reported(line: str, time: float) -> ScrewReported | None:
    """Return the report that a printed line makes of a screw, or None if the line reports no screw."""
    words = [*map(int, line.split()), 0, 0, 0, 0]
    if words[0] not in FOUND:
        return None
    _, screw, depth, torque = words[:4]
    return ScrewReported(
        time=time, screw=screw, found=FOUND[words[0]], deeper=depth * LINEAR, torque=torque * TORQUE_COUNT
    )


SUPPORT_EVENTS = (ScrewReported,)
