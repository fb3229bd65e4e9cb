"""Defines the layout of the bus: segments of ten microcomputers, the regenerators that connect segments, and
pages of status lines.
"""

from typing import Final, Literal

from handeye.core.errors import BadArgument
from handeye.core.record import Record
from handeye.ports.microbus import PAGE
from handeye.systems.sigma.protocol import COMPONENTS, NUMBERS, name_of

FAN_OUT: Final = 10  # microcomputers on a segment
PAGE_BITS: Final = 4  # output bits of the central computer that choose a page
MORE_PAGE_BITS: Final = 2  # output bits that 256 microcomputers need in addition

Kind = Literal["motor", "force", "hand", "sensor"]


class Place(Record, frozen=True, kw_only=True):
    """A microcomputer: its number and its segment. The number also determines the status lines."""

    number: int
    kind: Kind
    segment: int = 0
    length: int = 0  # number of bytes in the answer of a sensor


class Layout(Record, frozen=True, kw_only=True):
    """All microcomputers, and the connections between segments."""

    places: tuple[Place, ...]
    behind: tuple[int, ...] = (-1,)
    """For each segment, the next segment on the way to the central computer; -1 for the first segment, which is
    connected to the computer itself.
    """
    more_pages: bool = False  # two more output bits, for 256 microcomputers

    @property
    def reflexes(self) -> dict[tuple[int, int], int]:
        """For each component of each force microcomputer, the motor that this component can interrupt. If a force
        microcomputer has the number n, its three motors have the numbers n - 3 to n - 1.
        """
        motors = {place.number for place in self.places if place.kind == "motor"}
        wired = {
            (place.number, component): place.number - len(COMPONENTS) + component
            for place in self.places
            if place.kind == "force"
            for component in range(len(COMPONENTS))
        }
        return {pair: motor for pair, motor in wired.items() if motor in motors}

    @property
    def segments(self) -> list[list[int]]:
        """The numbers of the microcomputers on each segment."""
        return [[p.number for p in self.places if p.segment == s] for s in range(len(self.behind))]

    @property
    def pages(self) -> int:
        """Number of pages of status lines that can be selected."""
        return 1 << PAGE_BITS + (MORE_PAGE_BITS if self.more_pages else 0)

    def way(self, segment: int) -> tuple[int, ...]:
        """Return the segments on the way from the central computer to a segment, including that segment."""
        passed = [segment]
        while (segment := self.behind[segment]) >= 0:
            passed.append(segment)
        return tuple(reversed(passed))

    def check(self) -> None:
        """Raise BadArgument if the layout cannot be built."""
        if not self.behind or self.behind[0] != -1:
            raise BadArgument(
                "the first segment of a bus must be connected directly to the computer, without a regenerator"
            )
        for segment, towards in enumerate(self.behind[1:], start=1):
            if not 0 <= towards < segment:
                raise BadArgument(
                    f"segment {segment} must be behind an earlier segment, not behind segment {towards}"
                )
        numbers = [place.number for place in self.places]
        for place in self.places:
            if numbers.count(place.number) > 1:
                raise BadArgument(f"two microcomputers have the number {place.number}")
            if not 0 <= place.segment < len(self.behind):
                raise BadArgument(f"there is no segment {place.segment} for {name_of(place.number)}")
            if not 0 <= place.number < min(self.pages * PAGE, 256):
                more = (
                    "" if self.more_pages else "; with two more output bits, 256 microcomputers are possible"
                )
                raise BadArgument(
                    f"the status lines of microcomputer {place.number} are not connected: {self.pages} pages of "
                    f"{PAGE} connect only microcomputers 0 to {min(self.pages * PAGE, 256) - 1}{more}"
                )
        for segment in range(len(self.behind)):
            if (count := sum(place.segment == segment for place in self.places)) > FAN_OUT:
                raise BadArgument(
                    f"segment {segment} has {count} microcomputers, but it can drive only {FAN_OUT}; put the rest "
                    "behind a regenerator"
                )


def _kind(name: str) -> Kind:
    return "force" if name.startswith("FORCE") else "hand" if name.startswith("HAND") else "motor"


SUPERSIGMA: Final = Layout(
    places=tuple(Place(number=number, kind=_kind(name)) for name, number in NUMBERS.items())
)
"""The layout of SUPERSIGMA: two arms, which fill one segment."""

_FEEDING: Final[tuple[Kind, ...]] = ("motor", "motor", "hand", "motor", "sensor", "hand")
LINE: Final = Layout(
    places=(
        *SUPERSIGMA.places,
        *(Place(number=10 + place.number, kind=place.kind, segment=1) for place in SUPERSIGMA.places),
        *(
            Place(number=20 + place, kind=kind, segment=2, length=6 if kind == "sensor" else 0)
            for place, kind in enumerate(_FEEDING)
        ),
    ),
    behind=(-1, 0, 1),
)
"""An assembly line with 26 microcomputers: two SUPERSIGMAs, and a segment for the devices that bring and remove pieces.

"""
