"""The claims on which the findings of the pump's referee rest."""

import math
from typing import Final, Literal

from handeye.core.units import INCH, OUNCE_FORCE
from handeye.proof.evidence import (
    Compared,
    Contact,
    Contacted,
    FreeTurn,
    Gripped,
    HeightWithin,
    Limits,
    Motion,
    Region,
    Released,
    Taken,
    ToolSet,
    TravelWithin,
    Turned,
    Went,
)
from handeye.proof.obligation import Claim, Phase
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions
from handeye.tasks.water_pump.obligations.places import (
    HARD,
    PUSH,
    SEATED,
    TORQUE,
    PumpPlaces,
    inches,
    point,
)

_CORNERS: Final = (1, 2, 5, 4)
"""Screw holes at the four corners of the face, numbered from 0."""


class PumpClaims:
    """The claims for a pump with a given number of screws. Holes and pins are numbered from 0."""

    def __init__(self, screws: int) -> None:
        self.places = PumpPlaces(screws)

    def head(self, hole: int) -> Claim:
        """Return the claim that the head of a screw is at its nominal height above the face of the base."""
        places = self.places
        top = base_top() + places.head_height
        where = places.over_hole(hole, 0.35 * INCH, top - 0.02 * INCH, top + 0.8 * INCH)
        high = places.head_height
        return Claim(
            says=f"the fingers feel the head {inches(high)} inch over the face of the base, with a tolerance of .02 "
            "inch",
            where=f"hole {hole + 1}",
            phases=(
                Phase(
                    by=(
                        HeightWithin(
                            of=places.touched(where),
                            over=places.face,
                            limits=Limits(high + SEATED.low, high + SEATED.high),
                        ),
                    ),
                    undone=places.drives(),
                ),
            ),
        )

    def driven(self, hole: int) -> Claim:
        """Return the claim that the torque stop ended the driving of a screw at a hole."""
        socket = self.places.socket(hole)
        return Claim(
            says="the torque stop ends the driving of a screw",
            where=f"hole {hole + 1}",
            phases=(
                Phase(
                    by=(Contacted(of=Contact(where=socket, torque=TORQUE)),),
                    undone=(ToolSet(to="backwards", where=socket),),
                ),
            ),
        )

    def tight(self, hole: int) -> Claim:
        """Return the claim that the screw at a hole was tightened. After all screws were in their threads, this screw
        was driven once more, and the torque stop ended the driving.
        """
        socket = self.places.socket(hole)
        driven = [self.threaded(each).phases[0].by for each in range(self.places.screws)]
        return Claim(
            says="after all screws have gone into their threads, the screwdriver turns the screw again until the "
            "torque stop ends the motion",
            where=f"hole {hole + 1}",
            phases=(
                Phase(
                    by=(Contacted(of=Contact(where=socket, torque=TORQUE)),),
                    undone=(*(one for each in driven for one in each), ToolSet(to="backwards", where=socket)),
                ),
            ),
        )

    def threaded(self, hole: int) -> Claim:
        """Return the claim that the hand went down by the length of the thread while it drove a screw at a hole."""
        socket = self.places.socket(hole)
        return Claim(
            says="while it drives a screw, the hand goes down by the length of the thread before the torque stop "
            "ends the motion",
            where=f"hole {hole + 1}",
            phases=(
                Phase(
                    by=(
                        TravelWithin(
                            of=Contact(where=socket, torque=TORQUE), limits=Limits(0.18 * INCH, 0.32 * INCH)
                        ),
                    ),
                    undone=(ToolSet(to="backwards", where=socket),),
                ),
            ),
        )

    def size(self, hole: int) -> Claim:
        """Return the claim that a screw stood at the right height above its thread before it was driven."""
        places, d = self.places, dimensions()
        row = d("dispenser.pitch") * places.screws
        dispenser = Region(at=point("dispenser.place"), radius=row, height=Limits(2 * INCH, 9 * INCH))
        force = Limits(20 * OUNCE_FORCE, 50 * OUNCE_FORCE)
        here = Contact(where=places.socket(hole), force=force)
        others = [places.socket(other) for other in range(places.screws) if other != hole]
        return Claim(
            says="before the screw is driven, its head is at the right height over the thread, to within .12 inch, "
            "as measured from the screw's place in the dispenser or from another screw",
            where=f"hole {hole + 1}",
            phases=(
                Phase(
                    by=(
                        HeightWithin(
                            of=here,
                            over=Contact(where=dispenser, force=force),
                            limits=Limits(-0.03 * INCH, 0.23 * INCH),
                        ),
                        *(
                            HeightWithin(
                                of=here,
                                over=Contact(where=other, force=force),
                                limits=Limits(-0.12 * INCH, 0.12 * INCH),
                            )
                            for other in others
                        ),
                    )
                ),
            ),
        )

    def against(self, block: Literal["far", "left"]) -> Claim:
        """Return the claim that a push brought the pump against a block, and that nothing has moved the pump since."""
        along = (0.0, 1.0, 0.0) if block == "far" else (-1.0, 0.0, 0.0)
        rim = Region(
            at=self.places.on_pump(0.0, 0.0),
            radius=3.0 * INCH,
            height=Limits(0.5 * INCH, base_top() + 0.3 * INCH),
        )
        push = TravelWithin(
            of=Contact(where=rim, along=along, force=PUSH), limits=Limits(0.15 * INCH, 0.45 * INCH)
        )
        moves = (*self.places.drives(), Turned(axis=self.places.axis))
        pump = Region(at=self.places.on_pump(0.0, 0.0), radius=0.5 * INCH, height=Limits(-0.01, 0.01))
        return Claim(
            says="a push brings the pump home against the block, and two pictures show that the pump still stands "
            "there",
            where=f"the {block} block",
            phases=(
                Phase(by=(push,), undone=moves),
                Phase(by=(Taken(role="after"),), undone=(*moves, Taken(role="before"))),
                Phase(by=(Compared(by="match", part=pump),), undone=moves),
            ),
        )

    def face(self, corner: int) -> Claim:
        """Return the claim that the face of the base, at one of four holes, has its nominal height above the table."""
        places = self.places
        limits = Limits(base_top() - 0.04 * INCH, base_top() + 0.04 * INCH)
        over = HeightWithin(of=self.corner(corner), over=places.table, limits=limits)
        return Claim(
            says=f"the fingers feel the face of the base {inches(base_top())} inches over the table, with a "
            "tolerance of .04 inch",
            where=f"hole {_CORNERS[corner] + 1}",
            phases=(Phase(by=(over,), undone=self.base_in_hand()),),
        )

    def level(self) -> Claim:
        """Return the claim that the table has the same height on two sides of the base."""
        places = self.places
        left, right = (
            places.touched(
                Region(at=places.on_pump(x * INCH, 0.0), radius=2 * INCH, height=Limits(0.0, 0.6 * INCH))
            )
            for x in (5.5, -4.0)
        )
        limits = Limits(-0.04 * INCH, 0.04 * INCH)
        return Claim(
            says="the fingers feel the table at the same height on both sides of the base, with a tolerance of .04 "
            "inch",
            phases=(
                Phase(
                    by=(
                        HeightWithin(of=left, over=right, limits=limits),
                        HeightWithin(of=right, over=left, limits=limits),
                    ),
                    undone=self.base_in_hand(),
                ),
            ),
        )

    def side(self, one: int, other: int) -> Claim:
        """Return the claim that the face has the same height at two holes on one side of the base."""
        first, second = self.corner(one), self.corner(other)
        limits = Limits(-0.02 * INCH, 0.02 * INCH)
        return Claim(
            says="the fingers feel that the face of the base is equally high at both corner holes of a side, with a "
            "tolerance of .02 inch",
            where=f"holes {_CORNERS[one] + 1} and {_CORNERS[other] + 1}",
            phases=(
                Phase(
                    by=(
                        HeightWithin(of=first, over=second, limits=limits),
                        HeightWithin(of=second, over=first, limits=limits),
                    ),
                    undone=self.base_in_hand(),
                ),
            ),
        )

    def corner(self, corner: int) -> Contact:
        """Return the contact of the hand with the bare face of the base near one of four holes."""
        low, high = base_top(), base_top() + 0.45 * INCH
        return self.places.touched(self.places.over_hole(_CORNERS[corner], 0.6 * INCH, low, high))

    def base_in_hand(self) -> tuple[Gripped | Released, ...]:
        low = Region(at=self.places.pump.at, radius=self.places.pump.radius, height=Limits(0.0, 0.9 * INCH))
        return Gripped(where=low), Released(where=low, least=0.5 * INCH)

    def gasket(self) -> Claim:
        """Return the claim that two pictures, taken before and after the gasket was laid on the base, show the gasket
        in its place.
        """
        laid, before = self.places.laid, Taken(role="before")
        pump = Region(at=self.places.on_pump(0.0, 0.0), radius=0.5 * INCH, height=Limits(-0.01, 0.01))
        lifted = (Gripped(where=laid), before)
        return Claim(
            says="two pictures, taken before and after the gasket was laid on the base, show the gasket in its place",
            phases=(
                Phase(by=(before,)),
                Phase(by=(Released(where=laid, least=1.0 * INCH),), undone=lifted),
                Phase(by=(Taken(role="after"),), undone=lifted),
                Phase(by=(Compared(by="inspect", part=pump),), undone=lifted),
            ),
        )

    def pin(self, number: int) -> Claim:
        """Return the claim that the end of a pin in its holder is at its nominal height above the table."""
        d = dimensions()
        x0, y0, x1, y1 = d.all("pin_holder.places")
        at = ((x0, y0), (x1, y1))[number]
        end = Region(at=at, radius=0.4 * INCH, height=Limits(3.4 * INCH, 4.6 * INCH))
        held = Region(at=at, radius=0.6 * INCH, height=Limits(1.5 * INCH, 3.95 * INCH))
        high = d("pin_holder.height") + d("pin.body_length")
        limits = Limits(high - 0.16 * INCH, high + 0.12 * INCH)
        by = HeightWithin(of=self.places.touched(end), over=self.places.table, limits=limits)
        return Claim(
            says="after letting go of the pin in the holder, the fingers feel that its end is 3.5 inches above the "
            "table, with a tolerance of .12 inch",
            where=f"pin {number + 1}",
            phases=(Phase(by=(by,), undone=(Gripped(where=held), Released(where=held))),),
        )

    def rack(self) -> Claim:
        """Return the claim that the end of the screwdriver in its rack is at its nominal height above the table."""
        at = point("rack.place")
        end = Region(at=at, radius=0.4 * INCH, height=Limits(8.1 * INCH, 9.2 * INCH))
        held = Region(at=at, radius=0.6 * INCH, height=Limits(5.5 * INCH, 8.05 * INCH))
        by = HeightWithin(
            of=self.places.touched(end), over=self.places.table, limits=Limits(7.95 * INCH, 8.25 * INCH)
        )
        return Claim(
            says="after letting go of the screwdriver in the rack, the fingers feel its end at a height of 8.1 "
            "inches over the table, with a tolerance of .15 inch",
            phases=(Phase(by=(by,), undone=(Gripped(where=held), Released(where=held))),),
        )

    def free(self) -> tuple[Claim, ...]:
        """Return the claims that the rotor turns freely: over each half of a turn, in each direction."""
        found = []
        ways: tuple[tuple[Literal[1, -1], str], ...] = ((1, "counter-clockwise"), (-1, "clockwise"))
        for sense, way in ways:
            for first, half in ((0.0, "far"), (math.pi, "near")):
                turn = FreeTurn(
                    axis=self.places.axis, arc=Limits(first, first + math.pi), sense=sense, force=HARD
                )
                found.append(
                    Claim(
                        says="the crank turns through half a circle and resists with less than 16 oz",
                        where=f"{way}, the {half} half",
                        phases=(Phase(by=(turn,), undone=self.places.drives()),),
                    )
                )
        return tuple(found)

    def bearing(self) -> Claim:
        """Return the claim that the end of the crank pin is at its nominal height above the face of the base."""
        radius = dimensions()("rotor.crank_radius")
        circle = Region(
            at=self.places.on_pump(0.0, 0.0),
            radius=radius + 0.3 * INCH,
            height=Limits(4.5 * INCH, 5.4 * INCH),
        )
        by = HeightWithin(
            of=self.places.touched(circle), over=self.places.face, limits=Limits(2.79 * INCH, 2.93 * INCH)
        )
        return Claim(
            says="the fingers feel that the end of the crank pin is 2.86 inches over the face of the base, with a "
            "tolerance of .07 inch",
            phases=(Phase(by=(by,), undone=self.places.drives()),),
        )

    def away(self) -> Claim:
        """Return the claim that the hand is at its parking place."""
        park = Region(at=(20 * INCH, 28 * INCH), radius=4 * INCH, height=Limits(6 * INCH, 30 * INCH))
        return Claim(
            says="the last motion takes the hand to its parking place",
            phases=(Phase(by=(Went(where=park),), undone=(Motion(),)),),
        )

    def motor_off(self) -> Claim:
        off = Phase(by=(ToolSet(to="off"),), undone=(ToolSet(to="on"),))
        return Claim(says="the screwdriver is switched off after its last use", phases=(off,), at_first=True)

    def released(self) -> Claim:
        opened = Phase(by=(Released(least=0.4 * INCH),), undone=(Gripped(),))
        return Claim(says="the fingers open after their last grip", phases=(opened,), at_first=True)

    def gentle(self) -> Claim:
        """Return the claim that no torque stop for driving a screw is set above the torque of the clutch."""
        strong = Contacted(of=Contact(where=self.places.pump, torque=Limits(TORQUE.high, math.inf)))
        return Claim(
            says="no screw is driven with a torque stop above 45.5 oz-in",
            phases=(Phase(undone=(strong,)),),
            at_first=True,
        )
